// @generated from machines/upright_top.machine by `cargo xtask generate`; edits are lost.

//! A symmetrical top on a fixed point that stands upright, is pushed, and falls, since it spins too
//! slowly to sleep; it rises again,
//! and each time passes through the upright position. It is turned by a quaternion, since any three
//! angles are singular at some
//! orientation, and the usual ones of a top at just this one.
//!
//! Conserved: energy, and angular momentum about the vertical and about the top's axis, which are
//! the same here. The greatest
//! lean follows from these (F. Klein, A. Sommerfeld, Über die Theorie des Kreisels, 1897, chapter
//! IV). The top would sleep, that is,
//! stay upright, with a spin above sqrt(4 (A + m l²) m g l)/C, 79.9 rad/s.
//!
//! 4 coordinates, 7 parameters, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 19 | 7 | 1 | 0 | 0 | 27 |
//! | `start` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `mass_matrix` | 43 | 18 | 1 | 0 | 0 | 62 |
//! | `bias` | 66 | 35 | 1 | 0 | 0 | 102 |
//! | `applied` | 41 | 23 | 2 | 0 | 0 | 66 |
//! | `forces` | 77 | 42 | 2 | 0 | 0 | 121 |
//! | `accelerations` | 76 | 42 | 2 | 0 | 0 | 120 |
//! | `kinetic_energy` | 26 | 15 | 1 | 0 | 0 | 42 |
//! | `potential_energy` | 6 | 4 | 1 | 0 | 0 | 11 |
//! | `output_vertical_momentum` | 52 | 32 | 1 | 0 | 0 | 85 |
//! | `output_axial_momentum` | 50 | 31 | 1 | 0 | 0 | 82 |
//! | `output_upright` | 5 | 4 | 1 | 0 | 0 | 10 |
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

/// A symmetrical top on a fixed point that stands upright, is pushed, and falls, since it spins too
/// slowly to sleep; it rises again,
/// and each time passes through the upright position. It is turned by a quaternion, since any three
/// angles are singular at some
/// orientation, and the usual ones of a top at just this one.
///
/// Conserved: energy, and angular momentum about the vertical and about the top's axis, which are
/// the same here. The greatest
/// lean follows from these (F. Klein, A. Sommerfeld, Über die Theorie des Kreisels, 1897, chapter
/// IV). The top would sleep, that is,
/// stay upright, with a spin above sqrt(4 (A + m l²) m g l)/C, 79.9 rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UprightTop<S = f64> {
    /// `m`. Unit: `kg`. Default: 0.2.
    pub m: S,
    /// Distance of the mass centre from the fixed point. Unit: `m`. Default: 0.05.
    pub l: S,
    /// Inertia about the mass centre: across the axis of the top, and about it. Unit: `kg*m^2`.
    /// Default: 0.00015.
    pub A: S,
    /// `C`. Unit: `kg*m^2`. Default: 0.0002.
    pub C: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
    /// The spin with which it is let go, and how fast it is pushed over. Unit: `rad/s`.
    /// Default: 60.
    pub spin: S,
    /// `push`. Unit: `rad/s`. Default: 1.
    pub push: S,
}

impl<S: ::lagrangian::emitted::Scalar> UprightTop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let t1 = self.l * t0;
        let m_l_g = t0 * self.g;
        let A_plus_m_l_squared = t1 + self.A;
        let t2 = t1 * S::from_f64(2.0) + (self.C + self.A * S::from_f64(2.0));
        let t3 = S::from_ratio(4, 3);
        let k0 = A_plus_m_l_squared - self.C;
        let four_A = self.A * S::from_f64(4.0);
        let four_C = self.C * S::from_f64(4.0);
        let four_m_l_squared = t1 * S::from_f64(4.0);
        let k1 = A_plus_m_l_squared * S::from_f64(4.0);
        let k2 = S::from_f64(4.0) * (self.C - A_plus_m_l_squared);
        let two_m_l_g = m_l_g * S::from_f64(2.0);
        let k3 = t3 * (t2 - self.C * S::from_f64(3.0));
        let k4 = self.C * S::from_f64(8.0);
        let k5 = t2 * S::from_ratio(2, 3);
        let four_m_l_g = S::from_f64(4.0) * m_l_g;
        let k6 = t3 * t2;
        let k7 = t3 * (t2 - A_plus_m_l_squared * S::from_f64(3.0));
        let k8 = S::from_f64(0.5) / A_plus_m_l_squared;
        Prepared {
            C: self.C,
            A_plus_m_l_squared,
            k0,
            four_A,
            four_C,
            four_m_l_squared,
            m_l_g,
            k1,
            k2,
            two_m_l_g,
            k3,
            k4,
            k5,
            four_m_l_g,
            k6,
            k7,
            k8,
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let one = S::ONE;
        let zero = S::ZERO;
        let e_1_rate = S::from_f64(0.5) * self.push;
        let e_3_rate = S::from_f64(0.5) * self.spin;
        let q = [one, zero, zero, zero];
        let v = [zero, e_1_rate, zero, e_3_rate];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`UprightTop`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// The turn of the top: the cosine of half its angle, and the sine of that along its axis.
    /// Unit: `1`. Members: `e[0]` to `e[3]`.
    pub e: [S; 4],
}

/// What can be observed of a [`UprightTop`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the vertical: conserved. Unit: `J*s`.
    pub vertical_momentum: S,
    /// Angular momentum about the top's axis: conserved. Unit: `J*s`.
    pub axial_momentum: S,
    /// The cosine of its lean. Unit: `1`.
    pub upright: S,
}

/// The parameters of a [`UprightTop`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `C`
    C: S,
    /// `A + m*l^2`
    A_plus_m_l_squared: S,
    /// `A - C + m*l^2`
    k0: S,
    /// `4*A`
    four_A: S,
    /// `4*C`
    four_C: S,
    /// `4*m*l^2`
    four_m_l_squared: S,
    /// `m*l*g`
    m_l_g: S,
    /// `4*(A + m*l^2)`
    k1: S,
    /// `4*(C - (A + m*l^2))`
    k2: S,
    /// `2*m*l*g`
    two_m_l_g: S,
    /// `(4/3)*(C + 2*A + 2*m*l^2 - 3*C)`
    k3: S,
    /// `8*C`
    k4: S,
    /// `(2/3)*(C + 2*A + 2*m*l^2)`
    k5: S,
    /// `4*m*l*g`
    four_m_l_g: S,
    /// `(4/3)*(C + 2*A + 2*m*l^2)`
    k6: S,
    /// `(4/3)*(C + 2*A + 2*m*l^2 - 3*(A + m*l^2))`
    k7: S,
    /// `0.5/(A + m*l^2)`
    k8: S,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(4, 4);

/// Mass matrix `M`.
///
/// ```text
/// M[e[0], e[0]] = 4/3*(2*m*l^2 + 2*A + C)*e[0]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[1]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[2]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*C*e[3]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[1], e[0]] = 4/3*(C - m*l^2 - A)*e[0]*e[1]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     - 4*(C - m*l^2 - A)*e[2]*e[3]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[1], e[1]] = 4*(m*l^2 + A)*e[0]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4/3*(2*m*l^2 + 2*A + C)*e[1]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*C*e[2]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[3]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[2], e[0]] = 4/3*(C - m*l^2 - A)*e[0]*e[2]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(C - m*l^2 - A)*e[1]*e[3]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[2], e[1]] = -8/3*(C - m*l^2 - A)*e[1]*e[2]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[2], e[2]] = 4*(m*l^2 + A)*e[0]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*C*e[1]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4/3*(2*m*l^2 + 2*A + C)*e[2]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[3]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[3], e[0]] = -8/3*(C - m*l^2 - A)*e[0]*e[3]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[3], e[1]] = 4*(C - m*l^2 - A)*e[0]*e[2]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4/3*(C - m*l^2 - A)*e[1]*e[3]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[3], e[2]] = 4/3*(C - m*l^2 - A)*e[2]*e[3]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     - 4*(C - m*l^2 - A)*e[0]*e[1]/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// M[e[3], e[3]] = 4*C*e[0]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[1]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4*(m*l^2 + A)*e[2]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     + 4/3*(2*m*l^2 + 2*A + C)*e[3]^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> [[S; 4]; 4] {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let t0 = e_1 * e_1;
    let t1 = e_0 * e_0;
    let t2 = e_3 * e_3;
    let t3 = e_2 * e_2;
    let t4 = e_1 * e_0;
    let t5 = e_3 * e_2;
    let t6 = e_3 * e_1;
    let t7 = e_2 * e_0;
    let t8 = t0 + t1 + (t2 + t3);
    let t9 = S::ONE / (t8 * t8);
    let t10 = t9 * p.k1;
    let t11 = t9 * p.k3;
    let t12 = t0 * t10 + t3 * t10;
    let t13 = t2 * t10 + t1 * t10;
    let m11 = t12 + t9 * (t2 * p.four_C + t1 * p.k6);
    let m21 = -(t9 * (t5 * p.k2 - t4 * p.k7));
    let m22 = t13 + t9 * (t0 * p.k6 + t3 * p.four_C);
    let m31 = t9 * (p.k7 * t7 + p.k2 * t6);
    let m32 = t11 * (e_2 * e_1);
    let m33 = t13 + t9 * (t0 * p.four_C + t3 * p.k6);
    let m41 = t11 * (e_3 * e_0);
    let m42 = t9 * (p.k2 * t7 + p.k7 * t6);
    let m43 = t9 * (p.k7 * t5 - t4 * p.k2);
    let m44 = t12 + t9 * (t2 * p.k6 + t1 * p.four_C);
    [
        [m11, m21, m31, m41],
        [m21, m22, m32, m42],
        [m31, m32, m33, m43],
        [m41, m42, m43, m44],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[e[0]] = …
/// h[e[1]] = …
/// h[e[2]] = …
/// h[e[3]] = …
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4], v: &[S; 4]) -> [S; 4] {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_1 * e_1_dot + e_0 * e_0_dot + (e_3 * e_3_dot + e_2 * e_2_dot);
    let t1 = e_2 * e_1_dot + e_0 * e_3_dot - (e_1 * e_2_dot + e_3 * e_0_dot);
    let t2 = S::ONE / (e_1 * e_1 + e_0 * e_0 + (e_3 * e_3 + e_2 * e_2));
    let t3 = t0 * p.k1;
    let t4 = e_1 * e_3_dot + e_0 * e_2_dot - (e_3 * e_1_dot + e_2 * e_0_dot);
    let t5 = p.k2 * t1;
    let t6 = e_3 * e_2_dot + e_0 * e_1_dot - (e_2 * e_3_dot + e_1 * e_0_dot);
    let t7 = e_3_dot * e_3_dot + e_2_dot * e_2_dot;
    let t8 = t2 * t2;
    let t9 = S::from_f64(2.0) * (e_1_dot * e_1_dot + e_0_dot * e_0_dot + t7);
    let t10 = t8 * (t3 * t6 - t5 * t4);
    let t11 = t8 * (t5 * t6 + t4 * t3);
    let t12 = (t9 - t2 * (t0 * (t0 * S::from_f64(4.0)))) * (t2 * p.k5);
    let t13 = t8 * p.k4 * (t0 * t1);
    let t14 = S::from_f64(2.0) * (e_0 * t10 - e_3 * t11) + e_2 * t13 - e_1 * t12;
    let t15 = S::from_f64(2.0) * (e_1 * t11 - e_2 * t10) + e_0 * t13 - e_3 * t12;
    let t16 = e_0 * t12 + (S::from_f64(2.0) * (e_1 * t10 + e_2 * t11) + e_3 * t13);
    let t17 = e_2 * t12 + (e_1 * t13 - S::from_f64(2.0) * (e_3 * t10 + e_0 * t11));
    let h_e_0 = t2 * t16;
    let h_e_1 = -(t2 * t14);
    let h_e_2 = t2 * t17;
    let h_e_3 = -(t2 * t15);
    [h_e_0, h_e_1, h_e_2, h_e_3]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[e[0]] = 4*m*l*g*e[2]*(e[1]*e[3] - e[0]*e[2])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2 -
///     4/3*(2*m*l^2 + (2*A + C))*e[0]*(2*(e[0]*der(e[0]) + e[1]*der(e[1]) + e[2]*der(e[2]) +
///     e[3]*der(e[3]))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + ((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) -
///     1)*((der(e[0])^2 + der(e[1])^2 + der(e[2])^2 + der(e[3])^2)/(e[0]^2 + e[1]^2 + e[2]^2 +
///     e[3]^2) + 1)/((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + 1))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)
///     - 4*m*l*g*e[1]*(e[0]*e[1] + e[2]*e[3])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// Q[e[1]] = 4*m*l*g*e[0]*(e[0]*e[1] + e[2]*e[3])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2 -
///     4/3*(2*m*l^2 + (2*A + C))*e[1]*(2*(e[0]*der(e[0]) + e[1]*der(e[1]) + e[2]*der(e[2]) +
///     e[3]*der(e[3]))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + ((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) -
///     1)*((der(e[0])^2 + der(e[1])^2 + der(e[2])^2 + der(e[3])^2)/(e[0]^2 + e[1]^2 + e[2]^2 +
///     e[3]^2) + 1)/((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + 1))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)
///     + 4*m*l*g*e[3]*(e[1]*e[3] - e[0]*e[2])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// Q[e[2]] = 4*m*l*g*e[3]*(e[0]*e[1] + e[2]*e[3])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2 -
///     4/3*(2*m*l^2 + (2*A + C))*e[2]*(2*(e[0]*der(e[0]) + e[1]*der(e[1]) + e[2]*der(e[2]) +
///     e[3]*der(e[3]))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + ((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) -
///     1)*((der(e[0])^2 + der(e[1])^2 + der(e[2])^2 + der(e[3])^2)/(e[0]^2 + e[1]^2 + e[2]^2 +
///     e[3]^2) + 1)/((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + 1))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)
///     - 4*m*l*g*e[0]*(e[1]*e[3] - e[0]*e[2])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// Q[e[3]] = -4/3*(2*m*l^2 + (2*A + C))*e[3]*(2*(e[0]*der(e[0]) + e[1]*der(e[1]) + e[2]*der(e[2]) +
///     e[3]*der(e[3]))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + ((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) -
///     1)*((der(e[0])^2 + der(e[1])^2 + der(e[2])^2 + der(e[3])^2)/(e[0]^2 + e[1]^2 + e[2]^2 +
///     e[3]^2) + 1)/((e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2) + 1))/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)
///     - 4*m*l*g*e[1]*(e[1]*e[3] - e[0]*e[2])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
///     - 4*m*l*g*e[2]*(e[0]*e[1] + e[2]*e[3])/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> [S; 4] {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_1 * e_1 + e_0 * e_0 + (e_3 * e_3 + e_2 * e_2);
    let t1 = e_3_dot * e_3_dot + e_2_dot * e_2_dot;
    let t2 = S::ONE / t0;
    let t3 = e_1 * e_1_dot + e_0 * e_0_dot + (e_3 * e_3_dot + e_2 * e_2_dot);
    let t4 = t2 * t2;
    let t5 = S::ONE + t2 * (e_1_dot * e_1_dot + e_0_dot * e_0_dot + t1);
    let t6 = t4 * (e_3 * e_1 - e_2 * e_0);
    let t7 = t4 * (e_1 * e_0 + e_3 * e_2);
    let t8 = (S::ONE - t0) * t5 / (t0 + S::ONE) - t2 * (t3 * S::from_f64(2.0));
    let t9 = t2 * p.k6 * t8;
    let q_e_0 = p.four_m_l_g * (e_2 * t6 - e_1 * t7) + e_0 * t9;
    let q_e_1 = p.four_m_l_g * (e_0 * t7 + e_3 * t6) + e_1 * t9;
    let q_e_2 = e_2 * t9 - p.four_m_l_g * (e_0 * t6 - e_3 * t7);
    let q_e_3 = e_3 * t9 - p.four_m_l_g * (e_2 * t7 + e_1 * t6);
    [q_e_0, q_e_1, q_e_2, q_e_3]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4], v: &[S; 4]) -> [S; 4] {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_1 * e_1 + e_0 * e_0 + (e_3 * e_3 + e_2 * e_2);
    let t1 = e_1 * e_1_dot + e_0 * e_0_dot + (e_3 * e_3_dot + e_2 * e_2_dot);
    let t2 = e_2 * e_1_dot + e_0 * e_3_dot - (e_1 * e_2_dot + e_3 * e_0_dot);
    let t3 = S::ONE / t0;
    let t4 = e_3_dot * e_3_dot + e_2_dot * e_2_dot;
    let t5 = e_1_dot * e_1_dot + e_0_dot * e_0_dot + t4;
    let t6 = p.k1 * t1;
    let t7 = p.k2 * t2;
    let t8 = e_1 * e_3_dot + e_0 * e_2_dot - (e_3 * e_1_dot + e_2 * e_0_dot);
    let t9 = e_3 * e_2_dot + e_0 * e_1_dot - (e_2 * e_3_dot + e_1 * e_0_dot);
    let t10 = t3 * t1;
    let t11 = t3 * (p.two_m_l_g * (e_1 * e_0 + e_3 * e_2) + t3 * (t6 * t9 - t7 * t8));
    let t12 = t3 * (t3 * (t7 * t9 + t8 * t6) - p.two_m_l_g * (e_3 * e_1 - e_2 * e_0));
    let t13 = t10 * (t2 * (t3 * p.k4));
    let t14 = (S::ONE - t0) * (S::ONE + t3 * t5) / (t0 + S::ONE);
    let t15 = (S::from_f64(2.0) * t5 - t10 * (t1 * S::from_f64(4.0))) * (t3 * p.k5);
    let t16 = p.k6 * (t14 - S::from_f64(2.0) * t10) - t15;
    let t17 = e_0 * t16 - (S::from_f64(2.0) * (e_1 * t11 + e_2 * t12) + e_3 * t13);
    let t18 = S::from_f64(2.0) * (e_0 * t11 - e_3 * t12) + e_2 * t13 + e_1 * t16;
    let t19 = e_2 * t16 - (e_1 * t13 - S::from_f64(2.0) * (e_3 * t11 + e_0 * t12));
    let t20 = S::from_f64(2.0) * (e_1 * t12 - e_2 * t11) + e_0 * t13 + e_3 * t16;
    let f_e_0 = t3 * t17;
    let f_e_1 = t3 * t18;
    let f_e_2 = t3 * t19;
    let f_e_3 = t3 * t20;
    [f_e_0, f_e_1, f_e_2, f_e_3]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine, factored.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 4], v: &'a [S; 4] })
        -> Result<[S; 4], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    let e_0 = n(q[0]);
    let e_1 = n(q[1]);
    let e_2 = n(q[2]);
    let e_3 = n(q[3]);
    let e_0_dot = n(v[0]);
    let e_1_dot = n(v[1]);
    let e_2_dot = n(v[2]);
    let e_3_dot = n(v[3]);
    let t0 = e_1.mul_add(e_1, e_0 * e_0) + e_3.mul_add(e_3, e_2 * e_2);
    let t1 = e_3_dot.mul_add(e_3_dot, e_2_dot * e_2_dot);
    let t2 = e_1_dot.mul_add(e_1_dot, e_0_dot * e_0_dot) + t1;
    let t3 = e_1.mul_add(e_2_dot, e_3 * e_0_dot);
    let t4 = e_2.mul_add(e_1_dot, e_0 * e_3_dot) - t3;
    let t5 = e_3.mul_add(e_3_dot, e_2 * e_2_dot);
    let t6 = e_1.mul_add(e_1_dot, e_0 * e_0_dot) + t5;
    let t7 = N::ONE / t0;
    let t8 = n(p.k2) * t4;
    let t9 = n(p.k1) * t6;
    let t10 = e_3.mul_add(e_1_dot, e_2 * e_0_dot);
    let t11 = e_1.mul_add(e_3_dot, e_0 * e_2_dot) - t10;
    let t12 = e_2.mul_add(e_3_dot, e_1 * e_0_dot);
    let t13 = e_3.mul_add(e_2_dot, e_0 * e_1_dot) - t12;
    let t14 = t7 * t6;
    let t15 = t7 * n(p.k1);
    let t16 = t7 * n(p.four_C);
    let t17 = n(p.two_m_l_g) * e_3.mul_sub(e_1, e_2 * e_0);
    let t18 = n(p.two_m_l_g) * e_1.mul_add(e_0, e_3 * e_2);
    let t19 = t14 * N::from_f64(2.0);
    let t20 = N::from_f64(2.0) * t2;
    let t21 = t7 * n(p.k6);
    let t22 = t7 * t7.mul_sub(t8.mul_add(t13, t9 * t11), t17);
    let t23 = t7 * t7.mul_add(t13.mul_sub(t9, t8 * t11), t18);
    let t24 = t19 * (t7 * t4);
    let t25 = t14.neg_mul_add(t6 * N::from_f64(4.0), t20);
    let t26 = (N::ONE - t0) * t7.mul_add(t2, N::ONE) / (t0 + N::ONE);
    let t27 = t25 * (t7 * N::from_ratio(2, 3));
    let t28 = N::from_ratio(4, 3).mul_sub(t26 - t19, t27);
    let t29 = N::from_f64(0.75) * t28;
    let t30 = n(p.k8).mul_add(e_2.mul_add(t22, e_1 * t23), e_3 * t24);
    let t31 = n(p.k8).mul_add(e_0.mul_sub(t23, e_3 * t22), e_2 * t24);
    let t32 = n(p.k8).mul_sub(e_3.mul_add(t23, e_0 * t22), e_1 * t24);
    let t33 = n(p.k8).mul_add(e_1.mul_sub(t22, e_2 * t23), e_0 * t24);
    let e_0_ddot = e_0.mul_sub(t29, t30);
    let e_1_ddot = e_1.mul_add(t29, t31);
    let e_2_ddot = e_2.mul_add(t29, t32);
    let e_3_ddot = e_3.mul_add(t29, t33);
    let sound = PIVOTS.hold(t15, t15)
        & PIVOTS.hold(t15, t15)
        & PIVOTS.hold(t16, t16)
        & PIVOTS.hold(t21, t21)
        & e_3_ddot.is_finite();
    if !sound {
        let pivots = [(0, t15, t15), (1, t15, t15), (2, t16, t16), (3, t21, t21)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        e_0_ddot.store(),
        e_1_ddot.store(),
        e_2_ddot.store(),
        e_3_ddot.store(),
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 2*A*(e[0]*der(e[1]) - e[1]*der(e[0]) + e[3]*der(e[2]) - e[2]*der(e[3]))^2/(e[0]^2 + e[1]^2 +
///     e[2]^2 + e[3]^2)^2 + 2*A*(e[0]*der(e[2]) - e[2]*der(e[0]) - e[3]*der(e[1]) +
///     e[1]*der(e[3]))^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2 + 2*C*(e[2]*der(e[1]) -
///     e[3]*der(e[0]) - e[1]*der(e[2]) + e[0]*der(e[3]))^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2 +
///     1/2*m*(4*l^2*(e[0]*der(e[1]) - e[1]*der(e[0]) + e[3]*der(e[2]) - e[2]*der(e[3]))^2/(e[0]^2 +
///     e[1]^2 + e[2]^2 + e[3]^2)^2 + 4*l^2*(e[0]*der(e[2]) - e[2]*der(e[0]) - e[3]*der(e[1]) +
///     e[1]*der(e[3]))^2/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> S {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_1 * e_1 + e_0 * e_0 + (e_3 * e_3 + e_2 * e_2);
    let t1 = e_3 * e_2_dot + e_0 * e_1_dot - (e_2 * e_3_dot + e_1 * e_0_dot);
    let t2 = e_2 * e_1_dot + e_0 * e_3_dot - (e_1 * e_2_dot + e_3 * e_0_dot);
    let t3 = e_1 * e_3_dot + e_0 * e_2_dot - (e_3 * e_1_dot + e_2 * e_0_dot);
    let t4 = S::ONE / (t0 * t0);
    let t5 = t3 * t3 + t1 * t1;
    let t6 = t4 * (t5 * p.four_A + t2 * (t2 * p.four_C));
    S::from_f64(0.5) * (t4 * (p.four_m_l_squared * t5) + t6)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*l*g*(1 - 2*(e[1]^2 + e[2]^2)/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2))
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> S {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let t0 = e_2 * e_2 + e_1 * e_1;
    let t1 = S::ONE - t0 * S::from_f64(2.0) / (t0 + (e_3 * e_3 + e_0 * e_0));
    p.m_l_g * t1
}

/// Angular momentum about the vertical: conserved. Unit: `J*s`.
///
/// ```text
/// vertical_momentum = …
/// ```
pub fn output_vertical_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> S {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_2 * e_2;
    let t1 = e_1 * e_1;
    let t2 = e_3 * e_3;
    let t3 = t0 + t1;
    let t4 = e_3 * e_0;
    let t5 = e_2 * e_1;
    let t6 = e_2 * e_0;
    let t7 = e_1 * e_3;
    let t8 = e_2 * e_3;
    let t9 = e_1 * e_0;
    let t10 = e_3 * e_2_dot + e_0 * e_1_dot - (e_2 * e_3_dot + e_1 * e_0_dot);
    let t11 = e_1 * e_3_dot + e_0 * e_2_dot - (e_3 * e_1_dot + e_2 * e_0_dot);
    let t12 = S::ONE / (t3 + (t2 + e_0 * e_0));
    let t13 = e_2 * e_1_dot + e_0 * e_3_dot - (e_1 * e_2_dot + e_3 * e_0_dot);
    let t14 = t6 + t7;
    let t15 = t8 - t9;
    let t16 = t12 * S::from_f64(4.0);
    let t17 = t12 * S::from_f64(2.0);
    let t18 = S::ONE - t3 * t17;
    let t19 = (S::ONE - t17 * (t0 + t2)) * (S::from_f64(2.0) * t10);
    let t20 = t16 * (t11 * (t9 + t8) + t10 * (t7 - t6));
    let t21 = (S::ONE - t17 * (t1 + t2)) * (S::from_f64(2.0) * t11);
    let t22 = t12 * (t20 + t18 * (S::from_f64(2.0) * t13));
    let t23 = (t16 * (t13 * t14 + t11 * (t5 - t4)) + t19) * (t12 * t14);
    let t24 = t17 * ((t16 * (t15 * t13 + t10 * (t4 + t5)) + t21) * (t12 * t15) + t23);
    t22 * p.A_plus_m_l_squared - (t24 + t18 * t22) * (t18 * p.k0)
}

/// Angular momentum about the top's axis: conserved. Unit: `J*s`.
///
/// ```text
/// axial_momentum = …
/// ```
pub fn output_axial_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> S {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let e_0_dot = v[0];
    let e_1_dot = v[1];
    let e_2_dot = v[2];
    let e_3_dot = v[3];
    let t0 = e_2 * e_2;
    let t1 = e_1 * e_1;
    let t2 = e_3 * e_3;
    let t3 = t0 + t1;
    let t4 = e_3 * e_0;
    let t5 = e_2 * e_1;
    let t6 = e_2 * e_0;
    let t7 = e_1 * e_3;
    let t8 = e_1 * e_3_dot + e_0 * e_2_dot - (e_3 * e_1_dot + e_2 * e_0_dot);
    let t9 = e_2 * e_1_dot + e_0 * e_3_dot - (e_1 * e_2_dot + e_3 * e_0_dot);
    let t10 = e_2 * e_3;
    let t11 = S::ONE / (t3 + (t2 + e_0 * e_0));
    let t12 = e_1 * e_0;
    let t13 = e_3 * e_2_dot + e_0 * e_1_dot - (e_2 * e_3_dot + e_1 * e_0_dot);
    let t14 = t6 + t7;
    let t15 = t10 - t12;
    let t16 = t11 * S::from_f64(4.0);
    let t17 = t11 * S::from_f64(2.0);
    let t18 = S::ONE - t3 * t17;
    let t19 = (S::ONE - t17 * (t0 + t2)) * (S::from_f64(2.0) * t13);
    let t20 = (S::ONE - t17 * (t1 + t2)) * (S::from_f64(2.0) * t8);
    let t21 = t16 * (t8 * (t12 + t10) + t13 * (t7 - t6));
    let t22 = (t16 * (t15 * t9 + t13 * (t4 + t5)) + t20) * (t11 * t15);
    let t23 = t17 * (t22 + (t16 * (t9 * t14 + t8 * (t5 - t4)) + t19) * (t11 * t14));
    (t23 + (t21 + t18 * (S::from_f64(2.0) * t9)) * (t11 * t18)) * p.C
}

/// The cosine of its lean. Unit: `1`.
///
/// ```text
/// upright = 1 - 2*(e[1]^2 + e[2]^2)/(e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2)
/// ```
pub fn output_upright<S: ::lagrangian::emitted::Scalar>(q: &[S; 4]) -> S {
    let e_0 = q[0];
    let e_1 = q[1];
    let e_2 = q[2];
    let e_3 = q[3];
    let t0 = e_2 * e_2 + e_1 * e_1;
    S::ONE - t0 * S::from_f64(2.0) / (t0 + (e_3 * e_3 + e_0 * e_0))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> Outputs<S> {
    Outputs {
        vertical_momentum: output_vertical_momentum(p, q, v),
        axial_momentum: output_axial_momentum(p, q, v),
        upright: output_upright(q),
    }
}

::lagrangian::emitted::implement! {
    machine UprightTop "UprightTop" over S, R;
    parameters { m, l, A, C, g, spin, push } [
        m: "m" "kg" = 0.2;
        l: "l" "m" = 0.05;
        A: "A" "kg*m^2" = 0.00015;
        C: "C" "kg*m^2" = 0.0002;
        g: "g" "m/s^2" = 9.81;
        spin: "spin" "rad/s" = 60.0;
        push: "push" "rad/s" = 1.0;
    ]
    coordinates 4 Coordinates { e: [e_0, e_1, e_2, e_3] } [
        e_0: "e[0]" "1";
        e_1: "e[1]" "1";
        e_2: "e[2]" "1";
        e_3: "e[3]" "1";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { vertical_momentum, axial_momentum, upright } [
        vertical_momentum: "vertical_momentum" "J*s";
        axial_momentum: "axial_momentum" "J*s";
        upright: "upright" "1";
    ]
    prepared Prepared {
        C, A_plus_m_l_squared, k0, four_A, four_C, four_m_l_squared, m_l_g, k1, k2, two_m_l_g, k3,
        k4, k5, four_m_l_g, k6, k7, k8,
    }
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
