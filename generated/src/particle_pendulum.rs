// @generated from machines/particle_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A double pendulum in Cartesian coordinates: two particles that two rods hold. The constraints
//! are
//! scaled so that their multipliers are the forces in the rods, positive where a rod presses.
//!
//! 4 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 9 | 4 | 4 | 0 | 0 | 17 |
//! | `start` | 3 | 1 | 0 | 1 | 0 | 5 |
//! | `constraint_positions` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `constraint_rates` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `constraint_matrix` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `constraint_drift` | 6 | 4 | 0 | 0 | 0 | 10 |
//! | `accelerations` | 37 | 19 | 2 | 0 | 0 | 58 |
//! | `multipliers` | 32 | 18 | 2 | 0 | 0 | 52 |
//! | `kinetic_energy` | 6 | 3 | 0 | 0 | 0 | 9 |
//! | `potential_energy` | 2 | 1 | 0 | 0 | 0 | 3 |
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

/// A double pendulum in Cartesian coordinates: two particles that two rods hold. The constraints
/// are
/// scaled so that their multipliers are the forces in the rods, positive where a rod presses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticlePendulum<S = f64> {
    /// `m1`. Unit: `kg`. Default: 1.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// `l1`. Unit: `m`. Default: 1.
    pub l1: S,
    /// `l2`. Unit: `m`. Default: 1.
    pub l2: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for ParticlePendulum {
    fn default() -> Self {
        Self {
            m1: 1.0,
            m2: 1.0,
            l1: 1.0,
            l2: 1.0,
            g: 9.81,
        }
    }
}

impl<S> ParticlePendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> ParticlePendulum<R> {
        ParticlePendulum {
            m1: f(self.m1),
            m2: f(self.m2),
            l1: f(self.l1),
            l2: f(self.l2),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> ParticlePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k1 = S::ONE / self.l1;
        let k4 = S::ONE / self.l2;
        let k6 = self.m1 * self.g;
        let k7 = self.m2 * self.g;
        let k0 = self.l1 * self.l1;
        let k2 = k1 * S::from_f64(0.5);
        let k3 = self.l2 * self.l2;
        let k5 = S::from_f64(0.5) * k4;
        let k8 = self.m1 * S::from_f64(0.5);
        let k9 = self.m2 * S::from_f64(0.5);
        let k10 = -k6;
        let k11 = -k7;
        let k12 = -k4;
        let k13 = -k1;
        let k14 = S::ONE / self.m1;
        let k15 = S::ONE / self.m2;
        let k16 = self.g * k1;
        let singular = if vanishes(self.m1, self.m1, 5.329070518200751e-15) {
            Some(singular(0, self.m1, self.m1))
        } else if vanishes(self.m1, self.m1, 5.329070518200751e-15) {
            Some(singular(1, self.m1, self.m1))
        } else if vanishes(self.m2, self.m2, 5.329070518200751e-15) {
            Some(singular(2, self.m2, self.m2))
        } else if vanishes(self.m2, self.m2, 5.329070518200751e-15) {
            Some(singular(3, self.m2, self.m2))
        } else {
            None
        };
        Prepared {
            m1: self.m1,
            m2: self.m2,
            g: self.g,
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let y1 = self.l1 * S::from_f64(0.5);
        let t0 = S::from_ratio(2, 3) * S::pi();
        let sin_t0 = t0.sin();
        let x1 = self.l1 * sin_t0;
        let x2 = x1 + self.l2;
        let q = [x1, y1, x2, y1];
        let v = [S::ZERO; 4];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ParticlePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x1`. Unit: `m`.
    pub x1: S,
    /// `y1`. Unit: `m`.
    pub y1: S,
    /// `x2`. Unit: `m`.
    pub x2: S,
    /// `y2`. Unit: `m`.
    pub y2: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 4] {
        [self.x1, self.y1, self.x2, self.y2]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 4]) -> Self {
        Self {
            x1: q[0],
            y1: q[1],
            x2: q[2],
            y2: q[3],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            x1: f(self.x1),
            y1: f(self.y1),
            x2: f(self.x2),
            y2: f(self.y2),
        }
    }
}

/// What can be set while a [`ParticlePendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ParticlePendulum`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`ParticlePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m1`
    m1: S,
    /// `m2`
    m2: S,
    /// `g`
    g: S,
    /// `l1^2`
    k0: S,
    /// `1/l1`
    k1: S,
    /// `0.5/l1`
    k2: S,
    /// `l2^2`
    k3: S,
    /// `1/l2`
    k4: S,
    /// `0.5/l2`
    k5: S,
    /// `m1*g`
    k6: S,
    /// `m2*g`
    k7: S,
    /// `0.5*m1`
    k8: S,
    /// `0.5*m2`
    k9: S,
    /// `-m1*g`
    k10: S,
    /// `-m2*g`
    k11: S,
    /// `-1/l2`
    k12: S,
    /// `-1/l1`
    k13: S,
    /// `1/m1`
    k14: S,
    /// `1/m2`
    k15: S,
    /// `g/l1`
    k16: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x1, x1] = m1
/// M[y1, y1] = m1
/// M[x2, x2] = m2
/// M[y2, y2] = m2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 4]; 4] {
    let zero = S::ZERO;
    [
        [p.m1, zero, zero, zero],
        [zero, p.m1, zero, zero],
        [zero, zero, p.m2, zero],
        [zero, zero, zero, p.m2],
    ]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[y1] = -m1*g
/// Q[y2] = -m2*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [zero, p.k10, zero, p.k11]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [zero, p.k10, zero, p.k11]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[upper_rod] = 1/2*x1^2/l1 + 1/2*y1^2/l1 - 1/2*l1
/// g[lower_rod] = 1/2*((x2 - x1)^2 + (y2 - y1)^2 - l2^2)/l2
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
) -> [S; 2] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let g1 = p.k2 * (y1 * y1 + (x1 * x1 - p.k0));
    let g2 = p.k5 * (t1 * t1 + (t0 * t0 - p.k3));
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[upper_rod] = x1*der(x1)/l1 + y1*der(y1)/l1
/// phi[lower_rod] = 1/2*(2*(x2 - x1)*(der(x2) - der(x1)) + 2*(y2 - y1)*(der(y2) - der(y1)))/l2
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> [S; 2] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let phi1 = (y1_dot * y1 + x1_dot * x1) * p.k1;
    let phi2 = ((y1_dot - y2_dot) * (y1 - y2) + (x1_dot - x2_dot) * (x1 - x2)) * p.k4;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[upper_rod, x1] = x1/l1
/// G[upper_rod, y1] = y1/l1
/// G[lower_rod, x1] = -(x2 - x1)/l2
/// G[lower_rod, y1] = -(y2 - y1)/l2
/// G[lower_rod, x2] = (x2 - x1)/l2
/// G[lower_rod, y2] = (y2 - y1)/l2
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> [S; 8] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let g1_1 = p.k1 * x1;
    let g1_2 = p.k1 * y1;
    let zero = S::ZERO;
    let g2_1 = p.k4 * t0;
    let g2_2 = p.k4 * t1;
    let g2_3 = t0 * p.k12;
    let g2_4 = t1 * p.k12;
    [g1_1, g1_2, zero, zero, g2_1, g2_2, g2_3, g2_4]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[upper_rod] = -der(x1)^2/l1 - der(y1)^2/l1
/// gamma[lower_rod] = -1/2*(2*(der(x2) - der(x1))^2 + 2*(der(y2) - der(y1))^2)/l2
/// ```
pub fn constraint_drift<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> [S; 2] {
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let t0 = x1_dot - x2_dot;
    let t1 = y1_dot - y2_dot;
    let gamma1 = p.k13 * (y1_dot * y1_dot + x1_dot * x1_dot);
    let gamma2 = p.k12 * (t1 * t1 + t0 * t0);
    [gamma1, gamma2]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along the
/// machine, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 4],
    /// As `accelerations` takes it.
    pub v: &'a [S; 4],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 4], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let x1 = n(q[0]);
        let y1 = n(q[1]);
        let x2 = n(q[2]);
        let y2 = n(q[3]);
        let x1_dot = n(v[0]);
        let y1_dot = n(v[1]);
        let x2_dot = n(v[2]);
        let y2_dot = n(v[3]);
        let t0 = x1 - x2;
        let t1 = y1 - y2;
        let t2 = x1_dot - x2_dot;
        let t3 = y1_dot - y2_dot;
        let t4 = n(p.k14) * (n(p.k1) * x1);
        let t5 = n(p.k14) * (n(p.k1) * y1);
        let t6 = n(p.k4) * t0;
        let t7 = n(p.k4) * t1;
        let t8 = n(p.k15) * t6;
        let t9 = n(p.k14) * t6;
        let t10 = n(p.k15) * t7;
        let t11 = n(p.k14) * t7;
        let t12 = y1_dot.mul_add(y1_dot, x1_dot * x1_dot);
        let t13 = n(p.k1).neg_mul_add(t12, y1 * n(p.k16));
        let t14 = n(p.k1) * y1.mul_add(t5, x1 * t4);
        let t15 = n(p.k4) * t5.mul_add(t1, t4 * t0);
        let t16 = N::ONE / t14;
        let t17 = n(p.k4) * t1.mul_add(t10 + t11, t0 * (t8 + t9));
        let t18 = t16 * t15;
        let t19 = t15.neg_mul_add(t18, t17);
        let t20 = t18.mul_add(t13, n(p.k4) * t3.mul_add(t3, t2 * t2)) / t19;
        let t21 = t18.mul_add(t20, t16 * t13);
        let x1_ddot = t4.mul_sub(t21, t9 * t20);
        let y1_ddot = t5.mul_sub(t21, t11.mul_add(t20, n(p.g)));
        let x2_ddot = t8 * t20;
        let y2_ddot = t10.mul_sub(t20, n(p.g));
        let sound = t14.exceeds(N::from_f64(5.329070518200751e-15) * t14)
            & t19.exceeds(N::from_f64(5.329070518200751e-15) * t17)
            & y1_ddot.is_finite();
        if !sound {
            check(t14, t14, 5.329070518200751e-15, 4)?;
            check(t19, t17, 5.329070518200751e-15, 5)?;
        }
        let accelerations = [
            x1_ddot.store(),
            y1_ddot.store(),
            x2_ddot.store(),
            y2_ddot.store(),
        ];
        Ok(accelerations)
    }
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 4],
    /// As `multipliers` takes it.
    pub v: &'a [S; 4],
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
        let x1 = n(q[0]);
        let y1 = n(q[1]);
        let x2 = n(q[2]);
        let y2 = n(q[3]);
        let x1_dot = n(v[0]);
        let y1_dot = n(v[1]);
        let x2_dot = n(v[2]);
        let y2_dot = n(v[3]);
        let t0 = n(p.k1) * x1;
        let t1 = n(p.k1) * y1;
        let t2 = x1_dot - x2_dot;
        let t3 = y1_dot - y2_dot;
        let t4 = n(p.k14) * t1;
        let t5 = n(p.k4) * (x1 - x2);
        let t6 = n(p.k4) * (y1 - y2);
        let t7 = n(p.k14) * t5;
        let t8 = n(p.k14) * t6;
        let t9 = t6 * n(p.k15);
        let t10 = t1.mul_add(t4, t0 * (n(p.k14) * t0));
        let t11 = y1_dot.mul_add(y1_dot, x1_dot * x1_dot);
        let t12 = n(p.k1).mul_sub(t11, t4 * n(p.k6));
        let t13 = N::ONE / t10;
        let t14 = t1.mul_add(t8, t0 * t7);
        let t15 = t6.mul_add(t9, t5 * (t5 * n(p.k15)));
        let t16 = t6.mul_add(t8, t5 * t7) + t15;
        let t17 = t9.mul_add(n(p.k7), n(p.k4) * t3.mul_add(t3, t2 * t2));
        let t18 = t13 * t14;
        let t19 = t14.neg_mul_add(t18, t16);
        let t20 = t18.neg_mul_add(t12, t8.neg_mul_add(n(p.k6), t17)) / t19;
        let lambda1 = t18.mul_sub(t20, t13 * t12);
        let lambda2 = -t20;
        let sound = t10.exceeds(N::from_f64(5.329070518200751e-15) * t10)
            & t19.exceeds(N::from_f64(5.329070518200751e-15) * t16)
            & lambda2.is_finite();
        if !sound {
            check(t10, t10, 5.329070518200751e-15, 4)?;
            check(t19, t16, 5.329070518200751e-15, 5)?;
        }
        let multipliers = [lambda1.store(), lambda2.store()];
        Ok(multipliers)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m1*der(x1)^2 + 1/2*m1*der(y1)^2 + 1/2*m2*der(x2)^2 + 1/2*m2*der(y2)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let t0 = p.k8 * (y1_dot * y1_dot + x1_dot * x1_dot);
    p.k9 * (y2_dot * y2_dot + x2_dot * x2_dot) + t0
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m1*g*y1 + m2*g*y2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> S {
    let y1 = q[1];
    let y2 = q[3];
    p.k7 * y2 + p.k6 * y1
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("m1", "kg"),
    ("m2", "kg"),
    ("l1", "m"),
    ("l2", "m"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 4] = [("x1", "m"), ("y1", "m"), ("x2", "m"), ("y2", "m")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// Names, units, units of multipliers, whether positions are constrained.
const CONSTRAINTS: [(&str, &str, &str, bool); 2] =
    [("upper_rod", "m", "N", true), ("lower_rod", "m", "N", true)];

impl ::lagrangian::emitted::Machine for ParticlePendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "ParticlePendulum"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m1, self.m2, self.l1, self.l2, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m1),
            1 => Some(&mut self.m2),
            2 => Some(&mut self.l1),
            3 => Some(&mut self.l2),
            4 => Some(&mut self.g),
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
    type Vector = [f64; 4];
    type Matrix = [f64; 16];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 4]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 4] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 4],
        v: &[f64; 4],
        _: &Inputs,
        result: &mut [f64; 4],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, _: &[f64; 4], matrix: &mut [f64; 16]) {
        let rows = mass_matrix(self);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, _: &[f64; 4], _: &[f64; 4], result: &mut [f64; 4]) {
        *result = [0.0; 4];
    }

    fn applied(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &Inputs, result: &mut [f64; 4]) {
        *result = applied(self);
    }

    fn forces(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &Inputs, result: &mut [f64; 4]) {
        *result = forces(self);
    }

    fn constraint_positions(&self, _: f64, q: &[f64; 4], to: &mut [f64]) {
        fill(to, &constraint_positions(self, q));
    }

    fn constraint_rates(&self, _: f64, q: &[f64; 4], v: &[f64; 4], to: &mut [f64]) {
        fill(to, &constraint_rates(self, q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 4], to: &mut [f64]) {
        fill(to, &constraint_matrix(self, q));
    }

    fn constraint_drift(&self, _: f64, _: &[f64; 4], v: &[f64; 4], to: &mut [f64]) {
        fill(to, &constraint_drift(self, v));
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; 4], v: &[f64; 4]) -> f64 {
        kinetic_energy(self, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 4], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &[f64; 4], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &Inputs) -> f64 {
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

    fn outputs(&self, _: f64, _: &[f64; 4], _: &[f64; 4], _: &[f64; 4], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 4],
        _: &[f64; 4],
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
        q: &[f64; 4],
        v: &[f64; 4],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &multipliers(self, q, v)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::constraint_workspace(4, 2)];
        work(room.get_mut(..length))
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 4];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            m1: lanes(|p| p.m1),
            m2: lanes(|p| p.m2),
            g: lanes(|p| p.g),
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
    if let Some(constraint) = coordinate.checked_sub(4) {
        return ::lagrangian::emitted::Singular::constraint(constraint, pivot, diagonal);
    }
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
