// @generated from machines/four_bar.machine by `cargo xtask generate`; edits are lost.

//! A four-bar linkage: crank, coupler and rocker, all uniform, on a ground bar of length d.
//! Angles are
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
//! | `constraint_bias` | 12 | 4 | 0 | 3 | 0 | 22 |
//! | `accelerations` | 68 | 35 | 3 | 3 | 0 | 112 |
//! | `multipliers` | 58 | 27 | 3 | 3 | 0 | 94 |
//! | `projection` | 61 | 38 | 3 | 3 | 0 | 108 |
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

/// A four-bar linkage: crank, coupler and rocker, all uniform, on a ground bar of length d.
/// Angles are
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

impl<S: ::lagrangian::emitted::Scalar> FourBar<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.a * self.a;
        let t1 = S::from_f64(0.5) * self.g;
        let m2_g = self.m2 * self.g;
        let t2 = self.b * self.m2;
        let t3 = self.c * self.m3;
        let t4 = self.m1 * t0;
        let t5 = t1 * self.m1;
        let t6 = self.b * t2;
        let t7 = self.c * t3;
        let half_a_b_m2 = t2 * (self.a * S::from_f64(0.5));
        let t8 = S::from_ratio(1, 3);
        let k6 = t4 * t8 + self.m2 * t0;
        let t9 = S::from_ratio(1, 12);
        let t10 = S::from_ratio(1, 6);
        let t11 = (self.m1 + self.m2 * S::from_f64(4.0)) * (t0 * S::from_f64(0.25));
        let k5 = t7 * t8;
        let half_b = self.b * S::from_f64(0.5);
        let k0 = t6 * t9;
        let half_a_m1_g = self.a * t5;
        let k1 = t4 * t10;
        let k2 = t10 * t7;
        let k3 = t11 + t9 * t4;
        let k4 = t6 * t8;
        let minus_a = -self.a;
        let minus_half_a_b_m2 = -half_a_b_m2;
        let k7 = -(self.a * (m2_g + t5));
        let minus_half_b_m2_g = -(t2 * t1);
        let minus_half_c_m3_g = -(t1 * t3);
        let minus_b = -self.b;
        let minus_c = -self.c;
        let k8 = S::from_f64(3.0) / (self.m3 * (self.c * self.c));
        let k9 = S::ONE / k6;
        let pivots = [(2, k5, k5), (0, k6, k6)];
        Prepared {
            a: self.a,
            b: self.b,
            c: self.c,
            d: self.d,
            m2: self.m2,
            half_b,
            k0,
            m2_g,
            half_a_m1_g,
            k1,
            k2,
            half_a_b_m2,
            k3,
            k4,
            k5,
            k6,
            minus_a,
            minus_half_a_b_m2,
            k7,
            minus_half_b_m2_g,
            minus_half_c_m3_g,
            minus_b,
            minus_c,
            k8,
            k9,
            singular: PIVOTS.vanished(pivots),
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
    half_b: S,
    /// `(1/12)*b^2*m2`
    k0: S,
    /// `m2*g`
    m2_g: S,
    /// `0.5*a*m1*g`
    half_a_m1_g: S,
    /// `(1/6)*a^2*m1`
    k1: S,
    /// `(1/6)*c^2*m3`
    k2: S,
    /// `0.5*a*b*m2`
    half_a_b_m2: S,
    /// `(1/12)*a^2*m1 + 0.25*a^2*(m1 + 4*m2)`
    k3: S,
    /// `(1/3)*b^2*m2`
    k4: S,
    /// `(1/3)*c^2*m3`
    k5: S,
    /// `a^2*m2 + (1/3)*a^2*m1`
    k6: S,
    /// `-a`
    minus_a: S,
    /// `-0.5*a*b*m2`
    minus_half_a_b_m2: S,
    /// `-a*(m2*g + 0.5*m1*g)`
    k7: S,
    /// `-0.5*b*m2*g`
    minus_half_b_m2_g: S,
    /// `-0.5*c*m3*g`
    minus_half_c_m3_g: S,
    /// `-b`
    minus_b: S,
    /// `-c`
    minus_c: S,
    /// `3/c^2/m3`
    k8: S,
    /// `1/(a^2*m2 + (1/3)*a^2*m1)`
    k9: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 5);

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
    let m21 = (sin_coupler * sin_crank + cos_coupler * cos_crank) * p.half_a_b_m2;
    let zero = S::ZERO;
    [[p.k3, m21, zero], [m21, p.k4, zero], [zero, zero, p.k5]]
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
    let h_crank = t0 * (coupler_dot * (p.minus_half_a_b_m2 * coupler_dot));
    let h_coupler = t0 * (crank_dot * (crank_dot * p.half_a_b_m2));
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
    let q_crank = p.k7 * cos_crank;
    let q_coupler = p.minus_half_b_m2_g * cos_coupler;
    let q_rocker = p.minus_half_c_m3_g * cos_rocker;
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
    let t2 = sin_coupler * (cos_crank * p.half_a_b_m2);
    let t3 = cos_coupler * (sin_crank * p.half_a_b_m2);
    let f_crank = t0 * t2 - (t0 * t3 - cos_crank * p.k7);
    let f_coupler = t1 * t3 - (t1 * t2 - cos_coupler * p.minus_half_b_m2_g);
    let f_rocker = cos_rocker * p.minus_half_c_m3_g;
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
    let g1_1 = p.minus_a * sin_crank;
    let g1_2 = p.minus_b * sin_coupler;
    let g1_3 = sin_rocker * p.c;
    let g2_1 = cos_crank * p.a;
    let g2_2 = cos_coupler * p.b;
    let g2_3 = cos_rocker * p.minus_c;
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
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
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

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix multiplied out, factored.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Row after row, an unknown is eliminated from the rows that follow. Comments name these
    /// numbers where they are computed, up to signs and factors that depend on parameters alone;
    /// sums are over the rows `k` before, in the last line over those after:
    ///
    /// ```text
    /// l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
    /// d[i] = M[i, i] - sum l[i, k]^2*d[k]
    /// z[i] = f[i] - sum l[i, k]*z[k]
    /// a[i] = z[i]/d[i] - sum l[k, i]*a[k]
    /// ```
    ///
    /// The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for
    /// two constraints, and `f` for `gamma`. Their unknowns are the multipliers.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 3], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
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
    // Eliminates crank from row along: l[along, crank].
    let t9 = t4 * n(p.k9);
    // Eliminates rocker from row along: l[along, rocker].
    let t10 = t6 * n(p.k8);
    // Eliminates crank from row across: l[across, crank].
    let t11 = t3 * n(p.k9);
    // Eliminates rocker from row across: l[across, rocker].
    let t12 = t8 * n(p.k8);
    let t13 = cos_coupler.mul_add(cos_crank, sin_coupler * sin_crank);
    let t14 = n(p.half_a_b_m2) * t13;
    let t15 = cos_coupler.mul_sub(sin_crank, sin_coupler * cos_crank);
    // Eliminates crank from row coupler: l[coupler, crank].
    let t16 = n(p.k9) * t14;
    let t17 = t9.neg_mul_add(t14, t5);
    let t18 = t11.neg_mul_add(t14, t7);
    let t19 = cos_rocker * n(p.minus_half_c_m3_g);
    // Row coupler: pivot d[coupler].
    let t20 = t14.neg_mul_add(t16, n(p.k4));
    let t21 = (t1 * n(p.half_a_b_m2)).mul_sub(t15, cos_crank * n(p.k7));
    let t22 = cos_coupler * n(p.minus_half_b_m2_g);
    let t23 = t2.neg_mul_add(t8, t0.mul_add(t3, t1 * t7));
    let t24 = t2.neg_mul_add(t6, t0.mul_add(t4, t1 * t5));
    let t25 = N::ONE / t20;
    let t26 = (t0 * n(p.half_a_b_m2)).mul_add(t15, t22);
    // Row coupler: right-hand side z[coupler].
    let t27 = t16.mul_add(t21, t26);
    // Eliminates coupler from row along: l[along, coupler].
    let t28 = t17 * t25;
    // Eliminates coupler from row across: l[across, coupler].
    let t29 = t18 * t25;
    // Row along: pivot d[along].
    let t30 = t17.mul_add(t28, t6.mul_add(t10, t4 * t9));
    let t31 = t17.mul_add(t29, t6.mul_add(t12, t4 * t11));
    let t32 = t9.neg_mul_add(t21, t10.neg_mul_add(t19, t23));
    // Row along: right-hand side z[along].
    let t33 = t27.mul_add(t28, t32);
    let t34 = t11.mul_add(t21, t12.mul_add(t19, t24));
    let t35 = t18.mul_add(t29, t8.mul_add(t12, t3 * t11));
    let t36 = N::ONE / t30;
    // Eliminates along from row across: l[across, along].
    let t37 = t31 * t36;
    // Row across: pivot d[across].
    let t38 = t31.neg_mul_add(t37, t35);
    // Row across: right-hand side z[across].
    let t39 = t33.mul_add(t37, t27.neg_mul_add(t29, t34)) / t38;
    // Back substitution: lambda[along].
    let t40 = t37.mul_add(t39, t33 * t36);
    // Back substitution: a[coupler].
    let t41 = t28.mul_sub(t40, t29.mul_add(t39, t25 * t27));
    let t42 = t9.neg_mul_add(t40, t11.mul_sub(t39, n(p.k9) * t21));
    // Back substitution: a[crank].
    let crank_ddot = t16.mul_add(t41, t42);
    let coupler_ddot = -t41;
    // Back substitution: a[rocker].
    let rocker_ddot = t10.mul_sub(t40, t12.mul_sub(t39, n(p.k8) * t19));
    let sound = PIVOTS.hold(t20, n(p.k4))
        & PIVOTS.hold(t30, t30)
        & PIVOTS.hold(t38, t35)
        & coupler_ddot.is_finite();
    if !sound {
        let pivots = [(1, t20, n(p.k4)), (3, t30, t30), (4, t38, t35)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        crank_ddot.store(),
        coupler_ddot.store(),
        rocker_ddot.store(),
    ];
    Ok(accelerations)
}

::lagrangian::emitted::fast_function! {
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Row after row, an unknown is eliminated from the rows that follow. Comments name these
    /// numbers where they are computed, up to signs and factors that depend on parameters alone;
    /// sums are over the rows `k` before, in the last line over those after:
    ///
    /// ```text
    /// l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
    /// d[i] = M[i, i] - sum l[i, k]^2*d[k]
    /// z[i] = f[i] - sum l[i, k]*z[k]
    /// a[i] = z[i]/d[i] - sum l[k, i]*a[k]
    /// ```
    ///
    /// The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for
    /// two constraints, and `f` for `gamma`. Their unknowns are the multipliers.
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 2], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
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
    // Eliminates crank from row along: l[along, crank].
    let t9 = t4 * n(p.k9);
    // Eliminates rocker from row along: l[along, rocker].
    let t10 = t6 * n(p.k8);
    // Eliminates crank from row across: l[across, crank].
    let t11 = t3 * n(p.k9);
    // Eliminates rocker from row across: l[across, rocker].
    let t12 = t8 * n(p.k8);
    let t13 = cos_coupler.mul_add(cos_crank, sin_coupler * sin_crank);
    let t14 = n(p.half_a_b_m2) * t13;
    let t15 = cos_coupler.mul_sub(sin_crank, sin_coupler * cos_crank);
    // Eliminates crank from row coupler: l[coupler, crank].
    let t16 = n(p.k9) * t14;
    let t17 = t9.neg_mul_add(t14, t5);
    let t18 = t11.neg_mul_add(t14, t7);
    let t19 = cos_rocker * n(p.minus_half_c_m3_g);
    // Row coupler: pivot d[coupler].
    let t20 = t14.neg_mul_add(t16, n(p.k4));
    let t21 = (t1 * n(p.half_a_b_m2)).mul_sub(t15, cos_crank * n(p.k7));
    let t22 = cos_coupler * n(p.minus_half_b_m2_g);
    let t23 = t2.neg_mul_add(t8, t0.mul_add(t3, t1 * t7));
    let t24 = t2.neg_mul_add(t6, t0.mul_add(t4, t1 * t5));
    let t25 = N::ONE / t20;
    let t26 = (t0 * n(p.half_a_b_m2)).mul_add(t15, t22);
    // Row coupler: right-hand side z[coupler].
    let t27 = t16.mul_add(t21, t26);
    // Eliminates coupler from row along: l[along, coupler].
    let t28 = t17 * t25;
    // Eliminates coupler from row across: l[across, coupler].
    let t29 = t18 * t25;
    // Row along: pivot d[along].
    let t30 = t17.mul_add(t28, t6.mul_add(t10, t4 * t9));
    let t31 = t17.mul_add(t29, t6.mul_add(t12, t4 * t11));
    let t32 = t9.neg_mul_add(t21, t10.neg_mul_add(t19, t23));
    // Row along: right-hand side z[along].
    let t33 = t27.mul_add(t28, t32);
    let t34 = t11.mul_add(t21, t12.mul_add(t19, t24));
    let t35 = t18.mul_add(t29, t8.mul_add(t12, t3 * t11));
    let t36 = N::ONE / t30;
    // Eliminates along from row across: l[across, along].
    let t37 = t31 * t36;
    // Row across: pivot d[across].
    let t38 = t31.neg_mul_add(t37, t35);
    // Row across: right-hand side z[across].
    let lambda2 = t33.mul_add(t37, t27.neg_mul_add(t29, t34)) / t38;
    // Back substitution: lambda[along].
    let lambda1 = t37.mul_add(lambda2, t33 * t36);
    let sound = PIVOTS.hold(t20, n(p.k4))
        & PIVOTS.hold(t30, t30)
        & PIVOTS.hold(t38, t35)
        & lambda1.is_finite();
    if !sound {
        let pivots = [(1, t20, n(p.k4)), (3, t30, t30), (4, t38, t35)];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store()];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 27], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 27], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
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
    let r7 = cos_crank * n(p.a);
    let t0 = sin_crank * n(p.a);
    let t1 = sin_coupler * n(p.b);
    let r6 = sin_rocker * n(p.c);
    let t2 = cos_rocker * n(p.c);
    let r8 = cos_coupler * n(p.b);
    let t3 = r7 * n(p.k9);
    let t4 = t0 * n(p.k9);
    let t5 = r6 * n(p.k8);
    let t6 = t2 * n(p.k8);
    let t7 = sin_coupler.mul_add(sin_crank, cos_coupler * cos_crank);
    let t8 = t7 * n(p.half_a_b_m2);
    let r1 = t1 + t0 - r6;
    let r0 = r8 + r7 - (t2 + n(p.d));
    let t9 = n(p.k9) * t8;
    let t10 = t8.neg_mul_add(t4, t1);
    let t11 = t8.neg_mul_add(t3, r8);
    let t12 = t1.mul_add(coupler_dot, t0 * crank_dot);
    let t13 = r6 * rocker_dot;
    let t14 = t8.neg_mul_add(t9, n(p.k4));
    let t15 = t12 - t13;
    let t16 = N::ONE / t14;
    let t17 = r8.mul_add(coupler_dot, r7 * crank_dot);
    let r3 = t2.neg_mul_add(rocker_dot, t17);
    let t18 = t16 * t10;
    let t19 = t16 * t11;
    let r23 = t10.mul_add(t18, t0.mul_add(t4, r6 * t5));
    let t20 = t10.mul_add(t19, t0.mul_add(t3, r6 * t6));
    let r26 = t11.mul_add(t19, r7.mul_add(t3, t2 * t6));
    let t21 = N::ONE / r23;
    let t22 = t21 * t20;
    let r24 = t20.neg_mul_add(t22, r26);
    let t23 = N::ONE / r24;
    let t24 = r0.mul_add(t22, r1) * t23;
    let t25 = t23 * t15.neg_mul_add(t22, r3);
    let t26 = t22.mul_add(t24, r0 * t21);
    let r21 = t22.neg_mul_add(t25, t15 * t21);
    let r14 = t18.mul_sub(t26, t19 * t24);
    let t27 = t18.mul_add(r21, t19 * t25);
    let r2 = t13 - t12;
    let r4 = sin_crank * n(p.minus_a);
    let r5 = sin_coupler * n(p.minus_b);
    let r9 = cos_rocker * n(p.minus_c);
    let r13 = -t9.mul_add(r14, t4.neg_mul_add(t26, t3 * t24));
    let r15 = t5.neg_mul_add(t26, t6 * t24);
    let r16 = t9.mul_sub(t27, t4.mul_add(r21, t3 * t25));
    let r17 = -t27;
    let r18 = t5.mul_add(r21, t6 * t25);
    let r19 = -t26;
    let r20 = -t24;
    let r22 = -t25;
    let sound =
        PIVOTS.hold(t14, n(p.k4)) & PIVOTS.hold(r23, r23) & PIVOTS.hold(r24, r26) & r13.is_finite();
    if !sound {
        let pivots = [(1, t14, n(p.k4)), (3, r23, r23), (4, r24, r26)];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        r6.store(),
        r7.store(),
        r8.store(),
        r9.store(),
        n(p.k6).store(),
        n(p.k4).store(),
        n(p.k5).store(),
        r13.store(),
        r14.store(),
        r15.store(),
        r16.store(),
        r17.store(),
        r18.store(),
        r19.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        r23.store(),
        r26.store(),
    ];
    Ok(projection)
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
    let t1 = p.half_b * coupler_dot;
    let t2 = t1 * sin_coupler + t0 * sin_crank;
    let t3 = t1 * cos_coupler + t0 * cos_crank;
    let t4 = (t3 * t3 + t2 * t2) * p.m2 + coupler_dot * (coupler_dot * p.k0);
    let t5 = rocker_dot * (rocker_dot * p.k2) + crank_dot * (crank_dot * p.k1);
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
    let t0 = sin_crank * p.half_a_m1_g - sin_rocker * p.minus_half_c_m3_g;
    t0 + (sin_crank * p.a + sin_coupler * p.half_b) * p.m2_g
}

::lagrangian::emitted::implement! {
    machine FourBar "FourBar" over S, R;
    parameters { a, b, c, d, m1, m2, m3, g, omega } [
        a: "a" "m" = 0.3;
        b: "b" "m" = 0.8;
        c: "c" "m" = 0.6;
        d: "d" "m" = 1.0;
        m1: "m1" "kg" = 1.0;
        m2: "m2" "kg" = 2.0;
        m3: "m3" "kg" = 1.5;
        g: "g" "m/s^2" = 9.81;
        omega: "omega" "rad/s" = 12.0;
    ]
    coordinates 3 Coordinates { crank, coupler, rocker } [
        crank: "crank" "rad";
        coupler: "coupler" "rad";
        rocker: "rocker" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        a, b, c, d, m2, half_b, k0, m2_g, half_a_m1_g, k1, k2, half_a_b_m2, k3, k4, k5, k6, minus_a,
        minus_half_a_b_m2, k7, minus_half_b_m2_g, minus_half_c_m3_g, minus_b, minus_c, k8, k9,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [("along", "m", "N", true), ("across", "m", "N", true)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(3, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
