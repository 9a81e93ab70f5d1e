// @generated from machines/four_bar.machine by `cargo xtask generate`; edits are lost.

//! A four-bar linkage: crank, coupler and rocker, all uniform, on a ground bar of length d. Angles
//! are
//! absolute. With the lengths given the crank turns over and the rocker swings.
//!
//! 3 coordinates, 9 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 29 | 11 | 2 | 0 | 0 | 42 |
//! | `start` | 8 | 7 | 3 | 0 | 2 | 20 |
//! | `mass_matrix` | 3 | 1 | 0 | 2 | 0 | 8 |
//! | `bias` | 8 | 1 | 0 | 2 | 0 | 13 |
//! | `applied` | 3 | 0 | 0 | 3 | 0 | 6 |
//! | `forces` | 13 | 4 | 0 | 3 | 0 | 22 |
//! | `constraint_positions` | 6 | 5 | 0 | 3 | 0 | 17 |
//! | `constraint_rates` | 9 | 4 | 0 | 3 | 0 | 19 |
//! | `constraint_matrix` | 6 | 0 | 0 | 3 | 0 | 12 |
//! | `constraint_drift` | 12 | 4 | 0 | 3 | 0 | 22 |
//! | `accelerations` | 68 | 36 | 3 | 3 | 0 | 113 |
//! | `multipliers` | 58 | 28 | 3 | 3 | 0 | 95 |
//! | `kinetic_energy` | 16 | 6 | 0 | 2 | 0 | 26 |
//! | `potential_energy` | 5 | 3 | 0 | 3 | 0 | 11 |
//!
//! Sine and cosine of one angle count once; subtractions and changes of sign are additions. A
//! function that is not here gives zeros.

// A program uses some of it.
#![allow(dead_code, unreachable_pub)]
// Names and numbers are those of the description.
#![allow(non_snake_case, non_camel_case_types)]
#![allow(clippy::approx_constant, clippy::upper_case_acronyms)]
// Formulas are written as derived.
#![allow(clippy::let_and_return, clippy::too_many_arguments)]
#![allow(clippy::just_underscores_and_digits, clippy::excessive_precision)]
#![allow(clippy::pedantic, clippy::nursery)]
// What the description says is no Markdown.
#![allow(rustdoc::all)]

/// A four-bar linkage: crank, coupler and rocker, all uniform, on a ground bar of length d. Angles
/// are
/// absolute. With the lengths given the crank turns over and the rocker swings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar<S = f64> {
    /// Lengths of crank, coupler and rocker, distance of the fixed pins. Unit: `m`. Default: 0.3.
    pub a: S,
    /// `b`. Unit: `m`. Default: 0.8.
    pub b: S,
    /// `c`. Unit: `m`. Default: 0.6.
    pub c: S,
    /// `d`. Unit: `m`. Default: 1.
    pub d: S,
    /// `m1`. Unit: `kg`. Default: 1.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 2.
    pub m2: S,
    /// `m3`. Unit: `kg`. Default: 1.5.
    pub m3: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
    /// Rate of the crank when the run starts. Unit: `rad/s`. Default: 12.
    pub omega: S,
}

impl Default for FourBar {
    fn default() -> Self {
        Self {
            a: 0.3,
            b: 0.8,
            c: 0.6,
            d: 1.0,
            m1: 1.0,
            m2: 2.0,
            m3: 1.5,
            g: 9.81,
            omega: 12.0,
        }
    }
}

impl<S> FourBar<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> FourBar<R> {
        FourBar {
            a: f(self.a),
            b: f(self.b),
            c: f(self.c),
            d: f(self.d),
            m1: f(self.m1),
            m2: f(self.m2),
            m3: f(self.m3),
            g: f(self.g),
            omega: f(self.omega),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> FourBar<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.a * self.a;
        let t1 = S::from_f64(0.5) * self.g;
        let k2 = self.m2 * self.g;
        let t2 = self.b * self.m2;
        let t3 = self.c * self.m3;
        let t4 = self.m1 * t0;
        let t5 = t1 * self.m1;
        let t6 = self.b * t2;
        let k4 = t1 * t3;
        let t7 = self.c * t3;
        let k7 = t2 * (self.a * S::from_f64(0.5));
        let t8 = S::from_ratio(1, 3);
        let pivot_0 = t4 * t8 + self.m2 * t0;
        let t9 = S::from_ratio(1, 12);
        let k12 = t2 * t1;
        let k11 = self.a * (k2 + t5);
        let t10 = S::from_ratio(1, 6);
        let t11 = (self.m1 + self.m2 * S::from_f64(4.0)) * (t0 * S::from_f64(0.25));
        let k10 = t7 * t8;
        let k0 = self.b * S::from_f64(0.5);
        let k1 = t6 * t9;
        let k3 = self.a * t5;
        let k5 = t4 * t10;
        let k6 = t10 * t7;
        let k8 = t11 + t9 * t4;
        let k9 = t6 * t8;
        let k13 = -self.a;
        let k14 = -k7;
        let k15 = -k11;
        let k16 = -k12;
        let k17 = -k4;
        let k18 = -self.b;
        let k19 = -self.c;
        let k20 = S::from_f64(3.0) / (self.m3 * (self.c * self.c));
        let k21 = S::ONE / pivot_0;
        let singular = if vanishes(k10, k10, 4.440892098500626e-15) {
            Some(singular(2, k10, k10))
        } else if vanishes(pivot_0, pivot_0, 4.440892098500626e-15) {
            Some(singular(0, pivot_0, pivot_0))
        } else {
            None
        };
        Prepared {
            a: self.a,
            b: self.b,
            c: self.c,
            d: self.d,
            m2: self.m2,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            k9,
            k10,
            k11,
            k12,
            k13,
            k14,
            k15,
            k16,
            k17,
            k18,
            k19,
            k20,
            k21,
            singular,
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let t0 = self.a - self.d;
        let t1 = S::ONE / t0;
        let t2 = self.b * self.b - self.c * self.c;
        let t3 = t0 * t0;
        let t4 = t1 * S::from_f64(0.5);
        let coupler_rate = t1 * (self.a * self.omega);
        let zero = S::ZERO;
        let coupler = (-(t4 * (t2 + t3) / self.b)).acos();
        let rocker = S::pi() - (-(t4 * (t3 - t2) / self.c)).acos();
        let q = [zero, coupler, rocker];
        let v = [self.omega, coupler_rate, coupler_rate];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`FourBar`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `crank`. Unit: `rad`.
    pub crank: S,
    /// `coupler`. Unit: `rad`.
    pub coupler: S,
    /// `rocker`. Unit: `rad`.
    pub rocker: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 3] {
        [self.crank, self.coupler, self.rocker]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 3]) -> Self {
        Self {
            crank: q[0],
            coupler: q[1],
            rocker: q[2],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            crank: f(self.crank),
            coupler: f(self.coupler),
            rocker: f(self.rocker),
        }
    }
}

/// What can be set while a [`FourBar`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`FourBar`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`FourBar`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `a`
    a: S,
    /// `b`
    b: S,
    /// `c`
    c: S,
    /// `d`
    d: S,
    /// `m2`
    m2: S,
    /// `0.5*b`
    k0: S,
    /// `(1/12)*b^2*m2`
    k1: S,
    /// `m2*g`
    k2: S,
    /// `0.5*a*m1*g`
    k3: S,
    /// `0.5*c*m3*g`
    k4: S,
    /// `(1/6)*a^2*m1`
    k5: S,
    /// `(1/6)*c^2*m3`
    k6: S,
    /// `0.5*a*b*m2`
    k7: S,
    /// `(1/12)*a^2*m1 + 0.25*a^2*(m1 + 4*m2)`
    k8: S,
    /// `(1/3)*b^2*m2`
    k9: S,
    /// `(1/3)*c^2*m3`
    k10: S,
    /// `a*(m2*g + 0.5*m1*g)`
    k11: S,
    /// `0.5*b*m2*g`
    k12: S,
    /// `-a`
    k13: S,
    /// `-0.5*a*b*m2`
    k14: S,
    /// `-a*(m2*g + 0.5*m1*g)`
    k15: S,
    /// `-0.5*b*m2*g`
    k16: S,
    /// `-0.5*c*m3*g`
    k17: S,
    /// `-b`
    k18: S,
    /// `-c`
    k19: S,
    /// `3/c^2/m3`
    k20: S,
    /// `1/(a^2*m2 + (1/3)*a^2*m1)`
    k21: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[crank, crank] = 1/3*a^2*m1 + a^2*m2
/// M[coupler, crank] = 1/2*a*b*m2*cos(coupler - crank)
/// M[coupler, coupler] = 1/3*b^2*m2
/// M[rocker, rocker] = 1/3*c^2*m3
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let crank = q[0];
    let coupler = q[1];
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_crank, cos_crank) = crank.sin_cos();
    let m21 = (sin_coupler * sin_crank + cos_coupler * cos_crank) * p.k7;
    let zero = S::ZERO;
    [[p.k8, m21, zero], [m21, p.k9, zero], [zero, zero, p.k10]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[crank] = -1/2*a*b*m2*sin(coupler - crank)*der(coupler)^2
/// h[coupler] = 1/2*a*b*m2*sin(coupler - crank)*der(crank)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let crank = q[0];
    let coupler = q[1];
    let crank_dot = v[0];
    let coupler_dot = v[1];
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_crank, cos_crank) = crank.sin_cos();
    let t0 = sin_coupler * cos_crank - cos_coupler * sin_crank;
    let h_crank = t0 * (coupler_dot * (p.k14 * coupler_dot));
    let h_coupler = t0 * (crank_dot * (crank_dot * p.k7));
    let zero = S::ZERO;
    [h_crank, h_coupler, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[crank] = -1/2*(m1 + 2*m2)*a*g*cos(crank)
/// Q[coupler] = -1/2*b*m2*g*cos(coupler)
/// Q[rocker] = -1/2*c*m3*g*cos(rocker)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let cos_crank = crank.cos();
    let cos_coupler = coupler.cos();
    let cos_rocker = rocker.cos();
    let q_crank = p.k15 * cos_crank;
    let q_coupler = p.k16 * cos_coupler;
    let q_rocker = p.k17 * cos_rocker;
    [q_crank, q_coupler, q_rocker]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let crank_dot = v[0];
    let coupler_dot = v[1];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let cos_rocker = rocker.cos();
    let t0 = coupler_dot * coupler_dot;
    let t1 = crank_dot * crank_dot;
    let t2 = sin_coupler * (cos_crank * p.k7);
    let t3 = cos_coupler * (sin_crank * p.k7);
    let f_crank = t0 * t2 - (t0 * t3 + cos_crank * p.k11);
    let f_coupler = t3 * t1 - (t2 * t1 + cos_coupler * p.k12);
    let f_rocker = p.k17 * cos_rocker;
    [f_crank, f_coupler, f_rocker]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along] = a*cos(crank) + b*cos(coupler) - c*cos(rocker) - d
/// g[across] = a*sin(crank) + b*sin(coupler) - c*sin(rocker)
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> [S; 2] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_rocker, cos_rocker) = rocker.sin_cos();
    let g1 = p.b * cos_coupler + p.a * cos_crank - (p.c * cos_rocker + p.d);
    let g2 = p.b * sin_coupler + p.a * sin_crank - p.c * sin_rocker;
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along] = c*sin(rocker)*der(rocker) - a*sin(crank)*der(crank) - b*sin(coupler)*der(coupler)
/// phi[across] = a*cos(crank)*der(crank) + b*cos(coupler)*der(coupler) - c*cos(rocker)*der(rocker)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let crank_dot = v[0];
    let coupler_dot = v[1];
    let rocker_dot = v[2];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_rocker, cos_rocker) = rocker.sin_cos();
    let t0 = crank_dot * p.a;
    let t1 = coupler_dot * p.b;
    let t2 = rocker_dot * p.c;
    let phi1 = t2 * sin_rocker - (t1 * sin_coupler + t0 * sin_crank);
    let phi2 = t1 * cos_coupler + t0 * cos_crank - t2 * cos_rocker;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along, crank] = -a*sin(crank)
/// G[along, coupler] = -b*sin(coupler)
/// G[along, rocker] = c*sin(rocker)
/// G[across, crank] = a*cos(crank)
/// G[across, coupler] = b*cos(coupler)
/// G[across, rocker] = -c*cos(rocker)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 6] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_rocker, cos_rocker) = rocker.sin_cos();
    let g1_1 = p.k13 * sin_crank;
    let g1_2 = p.k18 * sin_coupler;
    let g1_3 = sin_rocker * p.c;
    let g2_1 = cos_crank * p.a;
    let g2_2 = cos_coupler * p.b;
    let g2_3 = cos_rocker * p.k19;
    [g1_1, g1_2, g1_3, g2_1, g2_2, g2_3]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = a*cos(crank)*der(crank)^2 + b*cos(coupler)*der(coupler)^2
///     - c*cos(rocker)*der(rocker)^2
/// gamma[across] = a*sin(crank)*der(crank)^2 + b*sin(coupler)*der(coupler)^2
///     - c*sin(rocker)*der(rocker)^2
/// ```
pub fn constraint_drift<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let crank_dot = v[0];
    let coupler_dot = v[1];
    let rocker_dot = v[2];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let (sin_rocker, cos_rocker) = rocker.sin_cos();
    let t0 = crank_dot * (crank_dot * p.a);
    let t1 = coupler_dot * (coupler_dot * p.b);
    let t2 = rocker_dot * (rocker_dot * p.c);
    let gamma1 = t1 * cos_coupler + t0 * cos_crank - t2 * cos_rocker;
    let gamma2 = t1 * sin_coupler + t0 * sin_crank - t2 * sin_rocker;
    [gamma1, gamma2]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass matrix
/// multiplied out, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 3],
    /// As `accelerations` takes it.
    pub v: &'a [S; 3],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 3], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let crank = n(q[0]);
        let coupler = n(q[1]);
        let rocker = n(q[2]);
        let crank_dot = n(v[0]);
        let coupler_dot = n(v[1]);
        let rocker_dot = n(v[2]);
        let angles = [coupler, crank, rocker];
        let circular = N::sin_cos_all(angles);
        let (sin_coupler, cos_coupler) = circular[0];
        let (sin_crank, cos_crank) = circular[1];
        let (sin_rocker, cos_rocker) = circular[2];
        let t0 = crank_dot * crank_dot;
        let t1 = coupler_dot * coupler_dot;
        let t2 = rocker_dot * rocker_dot;
        let t3 = cos_crank * n(p.a);
        let t4 = sin_crank * n(p.a);
        let t5 = sin_coupler * n(p.b);
        let t6 = sin_rocker * n(p.c);
        let t7 = cos_coupler * n(p.b);
        let t8 = cos_rocker * n(p.c);
        let t9 = cos_coupler * sin_crank;
        let t10 = n(p.k21) * t4;
        let t11 = n(p.k20) * t6;
        let t12 = n(p.k21) * t3;
        let t13 = n(p.k20) * t8;
        let t14 = sin_coupler * cos_crank;
        let t15 = sin_coupler.mul_add(sin_crank, cos_coupler * cos_crank);
        let t16 = n(p.k7) * t15;
        let t17 = n(p.k21) * t16;
        let t18 = t16.neg_mul_add(t10, t5);
        let t19 = t12.neg_mul_add(t16, t7);
        let t20 = cos_rocker * n(p.k4);
        let t21 = t16.neg_mul_add(t17, n(p.k9));
        let t22 = (t9 - t14).mul_add(t1 * n(p.k7), cos_crank * n(p.k11));
        let t23 = t8.neg_mul_add(t2, t1.mul_add(t7, t3 * t0));
        let t24 = t6.neg_mul_add(t2, t1.mul_add(t5, t4 * t0));
        let t25 = N::ONE / t21;
        let t26 = (t14 - t9).mul_add(n(p.k7) * t0, cos_coupler * n(p.k12));
        let t27 = t22.neg_mul_add(t17, t26);
        let t28 = t25 * t18;
        let t29 = t25 * t19;
        let t30 = t18.mul_add(t28, t4.mul_add(t10, t6 * t11));
        let t31 = t29.mul_add(t18, t12.mul_add(t4, t13 * t6));
        let t32 = t22.neg_mul_add(t10, t11.mul_add(t20, t23));
        let t33 = t28.neg_mul_add(t27, t32);
        let t34 = t22.mul_add(t12, t13.neg_mul_add(t20, t24));
        let t35 = t19.mul_add(t29, t3.mul_add(t12, t8 * t13));
        let t36 = N::ONE / t30;
        let t37 = t36 * t31;
        let t38 = t31.neg_mul_add(t37, t35);
        let t39 = t37.mul_add(t33, t29.mul_add(t27, t34)) / t38;
        let t40 = t37.mul_add(t39, t36 * t33);
        let t41 = t28.mul_add(t40, t29.neg_mul_add(t39, t25 * t27));
        let t42 = t10.neg_mul_add(t40, t12.mul_sub(t39, n(p.k21) * t22));
        let crank_ddot = t17.mul_add(t41, t42);
        let coupler_ddot = -t41;
        let rocker_ddot = t11.mul_sub(t40, t13.mul_add(t39, n(p.k20) * t20));
        let sound = t21.exceeds(N::from_f64(4.440892098500626e-15) * n(p.k9))
            & t30.exceeds(N::from_f64(4.440892098500626e-15) * t30)
            & t38.exceeds(N::from_f64(4.440892098500626e-15) * t35)
            & coupler_ddot.is_finite();
        if !sound {
            check(t21, n(p.k9), 4.440892098500626e-15, 1)?;
            check(t30, t30, 4.440892098500626e-15, 3)?;
            check(t38, t35, 4.440892098500626e-15, 4)?;
        }
        let accelerations = [
            crank_ddot.store(),
            coupler_ddot.store(),
            rocker_ddot.store(),
        ];
        Ok(accelerations)
    }
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 3],
    /// As `multipliers` takes it.
    pub v: &'a [S; 3],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let crank = n(q[0]);
        let coupler = n(q[1]);
        let rocker = n(q[2]);
        let crank_dot = n(v[0]);
        let coupler_dot = n(v[1]);
        let rocker_dot = n(v[2]);
        let angles = [coupler, crank, rocker];
        let circular = N::sin_cos_all(angles);
        let (sin_coupler, cos_coupler) = circular[0];
        let (sin_crank, cos_crank) = circular[1];
        let (sin_rocker, cos_rocker) = circular[2];
        let t0 = crank_dot * crank_dot;
        let t1 = coupler_dot * coupler_dot;
        let t2 = rocker_dot * rocker_dot;
        let t3 = cos_crank * n(p.a);
        let t4 = sin_crank * n(p.a);
        let t5 = sin_coupler * n(p.b);
        let t6 = sin_rocker * n(p.c);
        let t7 = cos_coupler * n(p.b);
        let t8 = cos_rocker * n(p.c);
        let t9 = cos_coupler * sin_crank;
        let t10 = n(p.k21) * t4;
        let t11 = n(p.k20) * t6;
        let t12 = n(p.k21) * t3;
        let t13 = n(p.k20) * t8;
        let t14 = sin_coupler * cos_crank;
        let t15 = sin_coupler.mul_add(sin_crank, cos_coupler * cos_crank);
        let t16 = n(p.k7) * t15;
        let t17 = n(p.k21) * t16;
        let t18 = t16.neg_mul_add(t10, t5);
        let t19 = t16.neg_mul_add(t12, t7);
        let t20 = cos_rocker * n(p.k4);
        let t21 = t16.neg_mul_add(t17, n(p.k9));
        let t22 = (t9 - t14).mul_add(n(p.k7) * t1, cos_crank * n(p.k11));
        let t23 = t8.neg_mul_add(t2, t7.mul_add(t1, t3 * t0));
        let t24 = t6.neg_mul_add(t2, t5.mul_add(t1, t4 * t0));
        let t25 = N::ONE / t21;
        let t26 = (t14 - t9).mul_add(n(p.k7) * t0, cos_coupler * n(p.k12));
        let t27 = t17.neg_mul_add(t22, t26);
        let t28 = t25 * t18;
        let t29 = t25 * t19;
        let t30 = t18.mul_add(t28, t4.mul_add(t10, t6 * t11));
        let t31 = t18.mul_add(t29, t4.mul_add(t12, t6 * t13));
        let t32 = t10.neg_mul_add(t22, t11.mul_add(t20, t23));
        let t33 = t28.neg_mul_add(t27, t32);
        let t34 = t12.mul_add(t22, t13.neg_mul_add(t20, t24));
        let t35 = t19.mul_add(t29, t3.mul_add(t12, t8 * t13));
        let t36 = N::ONE / t30;
        let t37 = t36 * t31;
        let t38 = t31.neg_mul_add(t37, t35);
        let lambda2 = t37.mul_add(t33, t29.mul_add(t27, t34)) / t38;
        let lambda1 = t37.mul_add(lambda2, t36 * t33);
        let sound = t21.exceeds(N::from_f64(4.440892098500626e-15) * n(p.k9))
            & t30.exceeds(N::from_f64(4.440892098500626e-15) * t30)
            & t38.exceeds(N::from_f64(4.440892098500626e-15) * t35)
            & lambda1.is_finite();
        if !sound {
            check(t21, n(p.k9), 4.440892098500626e-15, 1)?;
            check(t30, t30, 4.440892098500626e-15, 3)?;
            check(t38, t35, 4.440892098500626e-15, 4)?;
        }
        let multipliers = [lambda1.store(), lambda2.store()];
        Ok(multipliers)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/6*(m1 + 3*m2)*a^2*der(crank)^2 + 1/2*a*b*m2*cos(coupler - crank)*der(crank)*der(coupler)
///     + 1/6*b^2*m2*der(coupler)^2 + 1/6*c^2*m3*der(rocker)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let crank = q[0];
    let coupler = q[1];
    let crank_dot = v[0];
    let coupler_dot = v[1];
    let rocker_dot = v[2];
    let (sin_crank, cos_crank) = crank.sin_cos();
    let (sin_coupler, cos_coupler) = coupler.sin_cos();
    let t0 = crank_dot * p.a;
    let t1 = p.k0 * coupler_dot;
    let t2 = t1 * sin_coupler + t0 * sin_crank;
    let t3 = t1 * cos_coupler + t0 * cos_crank;
    let t4 = (t3 * t3 + t2 * t2) * p.m2 + coupler_dot * (coupler_dot * p.k1);
    let t5 = rocker_dot * (rocker_dot * p.k6) + crank_dot * (crank_dot * p.k5);
    t4 * S::from_f64(0.5) + t5
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*(m1 + 2*m2)*a*g*sin(crank) + 1/2*b*m2*g*sin(coupler) + 1/2*c*m3*g*sin(rocker)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let crank = q[0];
    let coupler = q[1];
    let rocker = q[2];
    let sin_crank = crank.sin();
    let sin_coupler = coupler.sin();
    let sin_rocker = rocker.sin();
    let t0 = p.k2 * (p.k0 * sin_coupler + sin_crank * p.a);
    t0 + (p.k4 * sin_rocker + sin_crank * p.k3)
}

/// Names and units.
const PARAMETERS: [(&str, &str); 9] = [
    ("a", "m"),
    ("b", "m"),
    ("c", "m"),
    ("d", "m"),
    ("m1", "kg"),
    ("m2", "kg"),
    ("m3", "kg"),
    ("g", "m/s^2"),
    ("omega", "rad/s"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 3] = [("crank", "rad"), ("coupler", "rad"), ("rocker", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// Names, units, units of multipliers, whether positions are constrained.
const CONSTRAINTS: [(&str, &str, &str, bool); 2] =
    [("along", "m", "N", true), ("across", "m", "N", true)];

impl ::lagrangian::emitted::Machine for FourBar {
    type System = Prepared;

    fn name(&self) -> &str {
        "FourBar"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [
            self.a, self.b, self.c, self.d, self.m1, self.m2, self.m3, self.g, self.omega,
        ];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.a),
            1 => Some(&mut self.b),
            2 => Some(&mut self.c),
            3 => Some(&mut self.d),
            4 => Some(&mut self.m1),
            5 => Some(&mut self.m2),
            6 => Some(&mut self.m3),
            7 => Some(&mut self.g),
            8 => Some(&mut self.omega),
            _ => None,
        }
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::emitted::System for Prepared {
    type Vector = [f64; 3];
    type Matrix = [f64; 9];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 3]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 3] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 3],
        v: &[f64; 3],
        _: &Inputs,
        result: &mut [f64; 3],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 3], matrix: &mut [f64; 9]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 3], v: &[f64; 3], result: &mut [f64; 3]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 3], _: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = forces(self, q, v);
    }

    fn constraint_positions(&self, _: f64, q: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_positions(self, q));
    }

    fn constraint_rates(&self, _: f64, q: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_rates(self, q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_matrix(self, q));
    }

    fn constraint_drift(&self, _: f64, q: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_drift(self, q, v));
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 3], v: &[f64; 3]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 3], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 3],
        _: &[f64; 3],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        ::core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Constraint<'_>> {
        CONSTRAINTS.iter().map(constraint)
    }

    fn multipliers(
        &self,
        _: f64,
        q: &[f64; 3],
        v: &[f64; 3],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &multipliers(self, q, v)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::constraint_workspace(3, 2)];
        work(room.get_mut(..length))
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 3];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            a: lanes(|p| p.a),
            b: lanes(|p| p.b),
            c: lanes(|p| p.c),
            d: lanes(|p| p.d),
            m2: lanes(|p| p.m2),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            k5: lanes(|p| p.k5),
            k6: lanes(|p| p.k6),
            k7: lanes(|p| p.k7),
            k8: lanes(|p| p.k8),
            k9: lanes(|p| p.k9),
            k10: lanes(|p| p.k10),
            k11: lanes(|p| p.k11),
            k12: lanes(|p| p.k12),
            k13: lanes(|p| p.k13),
            k14: lanes(|p| p.k14),
            k15: lanes(|p| p.k15),
            k16: lanes(|p| p.k16),
            k17: lanes(|p| p.k17),
            k18: lanes(|p| p.k18),
            k19: lanes(|p| p.k19),
            k20: lanes(|p| p.k20),
            k21: lanes(|p| p.k21),
            singular: None,
        }
    }

    fn batch_inputs(_: [&Inputs; N]) -> Self::BatchInputs {
        Inputs {}
    }

    fn inputs_of_lane(_: &Self::BatchInputs, _: usize) -> Inputs {
        Inputs {}
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q, v },
            result,
        )
    }
}

/// A name with its unit.
fn quantity<'a>(&(name, unit): &'a (&'a str, &'a str)) -> ::lagrangian::emitted::Quantity<'a> {
    ::lagrangian::emitted::Quantity { name, unit }
}

/// Names and units beside values.
fn quantities<'a, const N: usize>(
    names: &'a [(&'a str, &'a str); N],
    values: [f64; N],
) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'a>, f64)> {
    names.iter().map(quantity).zip(values)
}

/// A constraint, as it is called.
fn constraint<'a>(
    &(name, unit, multiplier_unit, holonomic): &'a (&'a str, &'a str, &'a str, bool),
) -> ::lagrangian::emitted::Constraint<'a> {
    ::lagrangian::emitted::Constraint {
        name,
        unit,
        multiplier_unit,
        holonomic,
    }
}

/// Writes numbers where there is room for them.
fn fill(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element,
/// in any of several lanes.
#[inline(always)]
fn check<N: ::lagrangian::emitted::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<(), ::lagrangian::emitted::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.exceeds(bound) {
        true => Ok(()),
        false => Err(singular(coordinate, pivot, diagonal)),
    }
}

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::emitted::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    !pivot.exceeds(bound)
}

/// The share of a pivot that is no rounding, for the message.
#[cold]
fn singular<S: ::lagrangian::emitted::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::emitted::Singular {
    let [pivot, diagonal] = [pivot, diagonal].map(|x| x.to_f64());
    if let Some(constraint) = coordinate.checked_sub(3) {
        return ::lagrangian::emitted::Singular::constraint(constraint, pivot, diagonal);
    }
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
