// @generated from machines/rattleback.machine by `cargo xtask generate`; edits are lost.

//! A rattleback, or Celtic stone: half an ellipsoid that rolls on a table, its axes of
//! inertia rotated
//! relative to those of its shape. Spun in one sense, it begins to rattle and reverses its spin.
//!
//! 6 coordinates, 10 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 11 | 4 | 1 | 0 | 0 | 16 |
//! | `start` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 13 | 6 | 0 | 2 | 0 | 23 |
//! | `bias` | 33 | 17 | 0 | 2 | 0 | 54 |
//! | `forces` | 33 | 18 | 0 | 2 | 0 | 55 |
//! | `constraint_positions` | 9 | 4 | 0 | 2 | 1 | 18 |
//! | `constraint_rates` | 70 | 33 | 1 | 3 | 1 | 111 |
//! | `constraint_matrix` | 62 | 32 | 1 | 3 | 1 | 102 |
//! | `constraint_bias` | 199 | 109 | 2 | 3 | 1 | 317 |
//! | `accelerations` | 353 | 206 | 8 | 3 | 1 | 574 |
//! | `multipliers` | 334 | 200 | 8 | 3 | 1 | 549 |
//! | `kinetic_energy` | 27 | 14 | 0 | 2 | 0 | 45 |
//! | `potential_energy` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// A rattleback, or Celtic stone: half an ellipsoid that rolls on a table, its axes of
/// inertia rotated
/// relative to those of its shape. Spun in one sense, it begins to rattle and reverses its spin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rattleback<S = f64> {
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// Half axes of the ellipsoid. Unit: `m`. Default: 0.2.
    pub a: S,
    /// `b`. Unit: `m`. Default: 0.03.
    pub b: S,
    /// `c`. Unit: `m`. Default: 0.02.
    pub c: S,
    /// Height of the ellipsoid's centre above the mass centre. Unit: `m`. Default: 0.01.
    pub h: S,
    /// Inertias about the mass centre along the axes of the shape, and what couples the first two.
    /// Unit: `kg*m^2`. Default: 0.0002.
    pub A: S,
    /// `B`. Unit: `kg*m^2`. Default: 0.0016.
    pub B: S,
    /// `C`. Unit: `kg*m^2`. Default: 0.0017.
    pub C: S,
    /// `D`. Unit: `kg*m^2`. Default: -0.00002.
    pub D: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> Rattleback<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let a_squared = self.a * self.a;
        let b_squared = self.b * self.b;
        let c_squared = self.c * self.c;
        let m_g = self.m * self.g;
        let B_minus_C = self.B - self.C;
        let A_minus_C = self.A - self.C;
        let A_minus_B = self.A - self.B;
        let two_a_squared = a_squared * S::from_f64(2.0);
        let two_c_squared = c_squared * S::from_f64(2.0);
        let two_b_squared = b_squared * S::from_f64(2.0);
        let half_c_squared = c_squared * S::from_f64(0.5);
        let half_a_squared = a_squared * S::from_f64(0.5);
        let half_b_squared = b_squared * S::from_f64(0.5);
        let two_D = self.D * S::from_f64(2.0);
        let minus_m_g = -m_g;
        let inverse_m = S::ONE / self.m;
        let pivots = [
            (0, self.m, self.m),
            (1, self.m, self.m),
            (2, self.m, self.m),
        ];
        Prepared {
            m: self.m,
            h: self.h,
            A: self.A,
            B: self.B,
            C: self.C,
            D: self.D,
            g: self.g,
            a_squared,
            b_squared,
            c_squared,
            m_g,
            B_minus_C,
            A_minus_C,
            A_minus_B,
            two_a_squared,
            two_c_squared,
            two_b_squared,
            half_c_squared,
            half_a_squared,
            half_b_squared,
            two_D,
            minus_m_g,
            inverse_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let z = self.c - self.h;
        let q = [zero, zero, z, zero, zero, zero];
        let v = [zero, zero, zero, S::from_f64(-5.0), zero, zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Rattleback`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Mass centre. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `z`. Unit: `m`.
    pub z: S,
    /// Spin about the vertical, then roll and pitch of what spins. Unit: `rad`.
    pub psi: S,
    /// `roll`. Unit: `rad`.
    pub roll: S,
    /// `pitch`. Unit: `rad`.
    pub pitch: S,
}

/// The parameters of a [`Rattleback`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `h`
    h: S,
    /// `A`
    A: S,
    /// `B`
    B: S,
    /// `C`
    C: S,
    /// `D`
    D: S,
    /// `g`
    g: S,
    /// `a^2`
    a_squared: S,
    /// `b^2`
    b_squared: S,
    /// `c^2`
    c_squared: S,
    /// `m*g`
    m_g: S,
    /// `B - C`
    B_minus_C: S,
    /// `A - C`
    A_minus_C: S,
    /// `A - B`
    A_minus_B: S,
    /// `2*a^2`
    two_a_squared: S,
    /// `2*c^2`
    two_c_squared: S,
    /// `2*b^2`
    two_b_squared: S,
    /// `0.5*c^2`
    half_c_squared: S,
    /// `0.5*a^2`
    half_a_squared: S,
    /// `0.5*b^2`
    half_b_squared: S,
    /// `2*D`
    two_D: S,
    /// `-m*g`
    minus_m_g: S,
    /// `1/m`
    inverse_m: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(6, 9);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[z, z] = m
/// M[psi, psi] = A*cos(roll)^2*sin(pitch)^2 + C*cos(roll)^2*cos(pitch)^2
///     - 2*D*cos(roll)*sin(pitch)*sin(roll) + B*sin(roll)^2
/// M[roll, psi] = (C - A)*cos(roll)*sin(pitch)*cos(pitch) + D*sin(roll)*cos(pitch)
/// M[roll, roll] = C*sin(pitch)^2 + A*cos(pitch)^2
/// M[pitch, psi] = B*sin(roll) - D*cos(roll)*sin(pitch)
/// M[pitch, roll] = D*cos(pitch)
/// M[pitch, pitch] = B
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [[S; 6]; 6] {
    let roll = q[4];
    let pitch = q[5];
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let t0 = cos_roll * cos_roll;
    let t1 = cos_roll * sin_pitch;
    let t2 = cos_pitch * p.A_minus_C;
    let m65 = cos_pitch * p.D;
    let t3 = cos_pitch * t2;
    let zero = S::ZERO;
    let m44 = t0 * p.A_minus_B + p.B - (t1 * (sin_roll * p.two_D) + t0 * t3);
    let m54 = sin_roll * m65 - t1 * t2;
    let m55 = t3 + p.C;
    let m64 = sin_roll * p.B - t1 * p.D;
    [
        [p.m, zero, zero, zero, zero, zero],
        [zero, p.m, zero, zero, zero, zero],
        [zero, zero, p.m, zero, zero, zero],
        [zero, zero, zero, m44, m54, m64],
        [zero, zero, zero, m54, m55, m65],
        [zero, zero, zero, m64, m65, p.B],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[psi] = …
/// h[roll] = A*cos(roll)*sin(pitch)^2*sin(roll)*der(psi)^2
///     + C*cos(roll)*sin(roll)*cos(pitch)^2*der(psi)^2 - B*cos(roll)*sin(roll)*der(psi)^2
///     + D*sin(pitch)*cos(2*roll)*der(psi)^2 - (A - C)*cos(roll)*cos(2*pitch)*der(psi)*der(pitch)
///     - B*cos(roll)*der(psi)*der(pitch) - 2*D*sin(pitch)*sin(roll)*der(psi)*der(pitch)
///     - 2*(A - C)*sin(pitch)*cos(pitch)*der(roll)*der(pitch) - D*sin(pitch)*der(pitch)^2
/// h[pitch] = D*cos(roll)*sin(roll)*cos(pitch)*der(psi)^2 + B*cos(roll)*der(psi)*der(roll)
///     + 2*D*sin(pitch)*sin(roll)*der(psi)*der(roll) + (A - C)*(cos(pitch)*der(roll) -
///     cos(roll)*sin(pitch)*der(psi))*(cos(roll)*cos(pitch)*der(psi) + sin(pitch)*der(roll))
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let roll = q[4];
    let pitch = q[5];
    let psi_dot = v[3];
    let roll_dot = v[4];
    let pitch_dot = v[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let t0 = psi_dot * roll_dot;
    let t1 = cos_pitch * cos_roll;
    let t2 = sin_pitch * cos_roll;
    let t3 = sin_roll * t0;
    let t4 = sin_roll * psi_dot + pitch_dot;
    let t5 = cos_roll * t0;
    let t6 = t1 * psi_dot + sin_pitch * roll_dot;
    let t7 = cos_pitch * roll_dot - t2 * psi_dot;
    let t8 = t6 * t4;
    let t9 = t6 * t7;
    let t10 = sin_pitch * t3 - t6 * pitch_dot;
    let t11 = t7 * (t4 * p.A_minus_B) + (cos_pitch * t3 - t7 * pitch_dot) * p.C;
    let t12 = t11 - p.D * (t7 * t7 - t4 * t4);
    let h_pitch = p.D * (t8 + t10) + (t9 * p.A_minus_C + t5 * p.B);
    let t13 = p.D * (t5 - t9) + (t10 * p.A - t8 * p.B_minus_C);
    let zero = S::ZERO;
    let h_psi = sin_roll * h_pitch - (t2 * t13 + t1 * t12);
    let h_roll = cos_pitch * t13 - sin_pitch * t12;
    [zero, zero, zero, h_psi, h_roll, h_pitch]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[z] = -m*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 6] {
    let zero = S::ZERO;
    [zero, zero, p.minus_m_g, zero, zero, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let roll = q[4];
    let pitch = q[5];
    let psi_dot = v[3];
    let roll_dot = v[4];
    let pitch_dot = v[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let t0 = psi_dot * roll_dot;
    let t1 = cos_pitch * cos_roll;
    let t2 = sin_pitch * cos_roll;
    let t3 = sin_roll * t0;
    let t4 = sin_roll * psi_dot + pitch_dot;
    let t5 = cos_roll * t0;
    let t6 = t1 * psi_dot + sin_pitch * roll_dot;
    let t7 = cos_pitch * roll_dot - t2 * psi_dot;
    let t8 = t6 * t4;
    let t9 = t6 * t7;
    let t10 = sin_pitch * t3 - t6 * pitch_dot;
    let t11 = t7 * (t4 * p.A_minus_B) + (cos_pitch * t3 - t7 * pitch_dot) * p.C;
    let t12 = t11 - p.D * (t7 * t7 - t4 * t4);
    let t13 = p.D * (t8 + t10) + (t9 * p.A_minus_C + t5 * p.B);
    let t14 = p.D * (t5 - t9) + (t10 * p.A - t8 * p.B_minus_C);
    let zero = S::ZERO;
    let f_psi = t2 * t14 + t1 * t12 - sin_roll * t13;
    let f_roll = sin_pitch * t12 - cos_pitch * t14;
    let f_pitch = -t13;
    [zero, zero, p.minus_m_g, f_psi, f_roll, f_pitch]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[touching] = z + h*cos(roll)*cos(pitch)
///     - sqrt(a^2*cos(roll)^2*sin(pitch)^2 + c^2*cos(roll)^2*cos(pitch)^2 + b^2*sin(roll)^2)
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
) -> [S; 3] {
    let z = q[2];
    let roll = q[4];
    let pitch = q[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let t0 = sin_pitch * cos_roll;
    let t1 = cos_pitch * cos_roll;
    let t2 = sin_roll * (sin_roll * p.b_squared) + t0 * (t0 * p.a_squared);
    let g1 = t1 * p.h + z - (t1 * (t1 * p.c_squared) + t2).sqrt();
    let zero = S::ZERO;
    [g1, zero, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[touching] = der(z) - h*sin(roll)*cos(pitch)*der(roll) - h*cos(roll)*sin(pitch)*der(pitch) -
///     1/2*(2*b^2*cos(roll)*sin(roll)*der(roll) +
///     (2*a^2*cos(roll)^2*sin(pitch)*cos(pitch)*der(pitch) -
///     2*a^2*cos(roll)*sin(pitch)^2*sin(roll)*der(roll)) +
///     (-2*c^2*cos(roll)*sin(roll)*cos(pitch)^2*der(roll) -
///     2*c^2*cos(roll)^2*sin(pitch)*cos(pitch)*der(pitch)))/sqrt(a^2*cos(roll)^2*sin(pitch)^2 +
///     c^2*cos(roll)^2*cos(pitch)^2 + b^2*sin(roll)^2)
/// phi[along] = …
/// phi[across] = …
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 3] {
    let psi = q[3];
    let roll = q[4];
    let pitch = q[5];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let psi_dot = v[3];
    let roll_dot = v[4];
    let pitch_dot = v[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = sin_pitch * p.a_squared;
    let t1 = sin_roll * p.b_squared;
    let t2 = sin_pitch * cos_roll;
    let t3 = cos_pitch * cos_roll;
    let t4 = cos_pitch * sin_roll;
    let t5 = sin_pitch * sin_roll;
    let t6 = sin_roll * t1;
    let t7 = t2 * pitch_dot;
    let t8 = t3 * psi_dot + sin_pitch * roll_dot;
    let t9 = t7 * t3;
    let t10 = cos_pitch * roll_dot - t2 * psi_dot;
    let t11 = cos_pitch * (cos_pitch * p.c_squared) + sin_pitch * t0;
    let t12 = t5 * cos_psi + cos_pitch * sin_psi;
    let t13 = pitch_dot + sin_roll * psi_dot;
    let t14 = t4 * cos_psi - sin_pitch * sin_psi;
    let t15 = sin_pitch * cos_psi + t4 * sin_psi;
    let t16 = cos_pitch * cos_psi - t5 * sin_psi;
    let t17 = t4 * roll_dot;
    let t18 = cos_roll * t13;
    let t19 = sin_roll * (cos_roll * (roll_dot * p.two_b_squared));
    let t20 = cos_roll * (sin_pitch * t10 - cos_pitch * t8) - sin_roll * t13;
    let t21 = (t5 * (t2 * roll_dot) - t9) * p.two_a_squared - t19;
    let t22 = S::ONE / (t11 * (cos_roll * cos_roll) + t6).sqrt();
    let t23 = p.h - t22 * (p.c_squared * t3);
    let t24 = cos_roll * t22;
    let t25 = t22 * (S::from_f64(0.5) * ((t9 + t17 * t3) * p.two_c_squared + t21));
    let t26 = cos_roll * (cos_pitch * t23 - t22 * (t2 * t0)) - t6 * t22;
    let t27 = t20 * (t24 * (t1 * cos_psi - t0 * t12) + t14 * t23);
    let t28 = t20 * (t24 * (t1 * sin_psi + t0 * t16) + t23 * t15);
    let phi1 = t25 + (z_dot - (t7 + t17) * p.h);
    let phi2 = t26 * (cos_psi * t18 + t10 * t12 - t8 * t14) - t27 + x_dot;
    let phi3 = y_dot - (t26 * (t8 * t15 + t10 * t16 - sin_psi * t18) + t28);
    [phi1, phi2, phi3]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[touching, z] = 1
/// G[touching, roll] = -b^2*cos(roll)*sin(roll)/sqrt(a^2*cos(roll)^2*sin(pitch)^2 +
///     c^2*cos(roll)^2*cos(pitch)^2 + b^2*sin(roll)^2) - sin(roll)*(h*cos(pitch) -
///     a^2*cos(roll)*sin(pitch)^2/sqrt(a^2*cos(roll)^2*sin(pitch)^2 + c^2*cos(roll)^2*cos(pitch)^2
///     + b^2*sin(roll)^2) - c^2*cos(roll)*cos(pitch)^2/sqrt(a^2*cos(roll)^2*sin(pitch)^2 +
///     c^2*cos(roll)^2*cos(pitch)^2 + b^2*sin(roll)^2))
/// G[touching, pitch] = (c^2 - a^2)*cos(roll)^2*sin(pitch)*cos(pitch)/sqrt((c^2 -
///     a^2)*cos(roll)^2*cos(pitch)^2 + (a^2 - b^2)*cos(roll)^2 + b^2) - h*cos(roll)*sin(pitch)
/// G[along, x] = 1
/// G[along, psi] = …
/// G[along, roll] = …
/// G[along, pitch] = …
/// G[across, y] = 1
/// G[across, psi] = …
/// G[across, roll] = …
/// G[across, pitch] = …
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [S; 18] {
    let psi = q[3];
    let roll = q[4];
    let pitch = q[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = sin_pitch * cos_roll;
    let t1 = sin_roll * p.b_squared;
    let t2 = cos_pitch * cos_roll;
    let t3 = sin_pitch * sin_roll;
    let t4 = cos_pitch * sin_roll;
    let t5 = t0 * p.a_squared;
    let t6 = sin_roll * t1;
    let t7 = t2 * p.c_squared;
    let t8 = t3 * cos_psi + cos_pitch * sin_psi;
    let t9 = cos_pitch * cos_psi - t3 * sin_psi;
    let t10 = cos_psi * t4 - sin_pitch * sin_psi;
    let t11 = sin_pitch * cos_psi + sin_psi * t4;
    let t12 = S::ONE / (t2 * t7 + (t6 + t0 * t5)).sqrt();
    let t13 = t7 * t12;
    let t14 = t5 * t12;
    let t15 = cos_roll * t12;
    let t16 = p.h - t13;
    let t17 = t1 * t15;
    let t18 = t2 * t16 - (t6 * t12 + t0 * t14);
    let t19 = t17 * cos_psi + (t16 * t10 - t14 * t8);
    let t20 = cos_roll * t18;
    let t21 = t17 * sin_psi + (t14 * t9 + t16 * t11);
    let t22 = t2 * t19 - t18 * t10;
    let t23 = t2 * t21 - t18 * t11;
    let t24 = t0 * t19 - t18 * t8;
    let t25 = t18 * t9 + t0 * t21;
    let t26 = t17 + sin_roll * (cos_pitch * p.h - cos_pitch * t13 - sin_pitch * t14);
    let g2_6 = sin_roll * t19 + cos_psi * t20;
    let g3_6 = sin_psi * t20 + sin_roll * t21;
    let zero = S::ZERO;
    let one = S::ONE;
    let g1_5 = -t26;
    let g1_6 = -(t2 * t14 + sin_pitch * (cos_roll * p.h - t7 * t15));
    let g2_4 = t0 * t24 + (sin_roll * g2_6 + t2 * t22);
    let g2_5 = sin_pitch * t22 - cos_pitch * t24;
    let g3_4 = t0 * t25 + (sin_roll * g3_6 + t2 * t23);
    let g3_5 = sin_pitch * t23 - cos_pitch * t25;
    [
        zero, zero, one, zero, g1_5, g1_6, one, zero, zero, g2_4, g2_5, g2_6, zero, one, zero,
        g3_4, g3_5, g3_6,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[touching] = …
/// gamma[along] = …
/// gamma[across] = …
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 3] {
    let psi = q[3];
    let roll = q[4];
    let pitch = q[5];
    let psi_dot = v[3];
    let roll_dot = v[4];
    let pitch_dot = v[5];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = roll_dot * roll_dot;
    let t1 = p.b_squared * psi_dot;
    let t2 = cos_pitch * cos_pitch;
    let t3 = sin_pitch * p.a_squared;
    let t4 = sin_roll * p.b_squared;
    let t5 = cos_roll * cos_roll;
    let t6 = cos_pitch * pitch_dot;
    let t7 = sin_roll * roll_dot;
    let t8 = sin_pitch * cos_roll;
    let t9 = cos_roll * roll_dot;
    let t10 = t2 * p.c_squared;
    let t11 = sin_pitch * t3;
    let t12 = sin_roll * t4;
    let t13 = sin_pitch * pitch_dot;
    let t14 = cos_roll * t6;
    let t15 = cos_roll * t7;
    let t16 = sin_pitch * t7;
    let t17 = cos_pitch * cos_psi;
    let t18 = cos_psi * t9;
    let t19 = sin_roll * psi_dot;
    let t20 = sin_roll * t6;
    let t21 = t8 * t14;
    let t22 = sin_psi * t9;
    let t23 = cos_pitch * sin_psi;
    let t24 = t12 + t5 * (t10 + t11);
    let t25 = sin_psi * t13 - psi_dot * t17;
    let t26 = cos_pitch * t7;
    let t27 = cos_psi * t13 + psi_dot * t23;
    let t28 = (t8 * t16 - t21) * p.two_a_squared - p.two_b_squared * t15;
    let t29 = t28 + (t21 + t2 * t15) * p.two_c_squared;
    let t30 = sin_pitch * sin_pitch - t2;
    let t31 = t7 * t8;
    let t32 = t6 * p.two_a_squared;
    let t33 = cos_pitch * roll_dot;
    let t34 = sin_pitch * cos_psi;
    let t35 = t25 - (cos_psi * t20 + sin_pitch * (t18 - sin_psi * t19));
    let t36 = sin_pitch * sin_psi;
    let t37 = pitch_dot + t19;
    let t38 = t16 - t14;
    let t39 = t27 + (sin_psi * t20 + sin_pitch * (t22 + cos_psi * t19));
    let t40 = S::ONE / t24 * t29;
    let t41 = pitch_dot * pitch_dot * t5;
    let t42 = t31 * (t6 * p.two_c_squared);
    let t43 = sin_roll * sin_roll - t5;
    let t44 = t31 * t32;
    let t45 = S::ONE / t24.sqrt();
    let t46 = t40 * p.half_a_squared;
    let t47 = t23 + sin_roll * t34;
    let t48 = p.a_squared * t6;
    let t49 = t40 * p.half_b_squared;
    let t50 = cos_roll * (p.c_squared * t13 - cos_pitch * p.half_c_squared * t40);
    let t51 = cos_pitch * cos_roll;
    let t52 = t33 - psi_dot * t8;
    let t53 = roll_dot * t13 - psi_dot * t38;
    let t54 = t26 + pitch_dot * t8;
    let t55 = cos_psi * t37;
    let t56 = sin_psi * t37;
    let t57 = t17 - sin_roll * t36;
    let t58 = t3 * t47;
    let t59 = cos_psi * t4;
    let t60 = t45 * (p.c_squared * t26 + t50);
    let t61 = sin_roll * t17 - t36;
    let t62 = sin_pitch * roll_dot + psi_dot * t51;
    let t63 = roll_dot * t6 - psi_dot * t54;
    let t64 = cos_roll * psi_dot;
    let t65 = t34 + sin_roll * t23;
    let t66 = t3 * t57;
    let t67 = sin_psi * t4;
    let t68 = t9 * t17 - sin_roll * t27 - (sin_psi * t6 + psi_dot * t34);
    let t69 = p.h - t45 * (p.c_squared * t51);
    let t70 = t9 * t23 - sin_roll * t25 + (cos_psi * t6 - psi_dot * t36);
    let t71 = t43 * (t0 * t11) - t44 - (t44 + t41 * (p.a_squared * t30));
    let t72 = t7 * t13;
    let t73 = cos_roll * (sin_pitch * (p.a_squared * t35 - t46 * t47) - t47 * t48);
    let t74 = sin_roll * (sin_psi * t1 - cos_psi * t49) - p.b_squared * t18;
    let t75 = cos_roll * t45;
    let t76 = p.b_squared * t22 + sin_roll * (cos_psi * t1 + sin_psi * t49);
    let t77 = cos_roll * (sin_pitch * (p.a_squared * t39 - t46 * t57) - t48 * t57);
    let t78 = t42 + t41 * (p.c_squared * t30) + (t42 + t43 * (t0 * t10)) + t71;
    let t79 = t38 * t52 + t8 * t53 + t9 * (t19 + t37) - (t54 * t62 - t51 * t63);
    let t80 = t8 * (t16 * p.two_a_squared - cos_roll * (t32 + sin_pitch * t46));
    let t81 = t47 * t53 + t35 * t52 + (t7 * t55 + (t56 - t18) * t64);
    let t82 = cos_roll * (cos_pitch * t69 - t45 * (t3 * t8)) - t12 * t45;
    let t83 = t53 * t57 + t39 * t52 - (t7 * t56 - t64 * (t22 + t55));
    let t84 = t78 * S::from_f64(2.0) - t0 * p.two_b_squared * t43;
    let t85 = t45 * (t7 * t58 + t73 - (t7 * t59 + cos_roll * t74));
    let t86 = cos_roll * (sin_pitch * t52 - cos_pitch * t62) - sin_roll * t37;
    let t87 = t45 * (t80 - sin_roll * (p.two_b_squared * t9 + sin_roll * t49));
    let t88 = t87 - (t26 * t69 + cos_roll * (t13 * t69 - cos_pitch * t60));
    let t89 = t45 * (t7 * t67 - cos_roll * t76 + (t7 * t66 + t77));
    let t90 = t79 * (t61 * t69 + t75 * (t59 - t58));
    let t91 = t88 * (t47 * t52 + cos_roll * t55 - t61 * t62);
    let t92 = t88 * (t52 * t57 + t62 * t65 - cos_roll * t56);
    let t93 = t86 * (t89 - (t60 * t65 + t69 * t70));
    let t94 = t45 * (S::from_f64(0.5) * (t84 - t40 * (t29 * S::from_f64(0.5))));
    let t95 = t91 - (t61 * t63 + t62 * t68 + t81) * t82;
    let t96 = t79 * (t65 * t69 + t75 * (t66 + t67)) + t93;
    let gamma1 = p.h * (t9 * t33 - t72 - (t72 - pitch_dot * t14)) + t94;
    let gamma2 = (t60 * t61 + t68 * t69 + t85) * t86 - t90 - t95;
    let gamma3 = t92 - t82 * (t83 - (t63 * t65 + t62 * t70)) - t96;
    [gamma1, gamma2, gamma3]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix, factored.
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 6], v: &'a [S; 6] })
        -> Result<[S; 6], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 6], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let psi = n(q[3]);
    let roll = n(q[4]);
    let pitch = n(q[5]);
    let psi_dot = n(v[3]);
    let roll_dot = n(v[4]);
    let pitch_dot = n(v[5]);
    let angles = [pitch, roll, psi];
    let circular = N::sin_cos_all(angles);
    let (sin_pitch, cos_pitch) = circular[0];
    let (sin_roll, cos_roll) = circular[1];
    let (sin_psi, cos_psi) = circular[2];
    let t0 = n(p.b_squared) * psi_dot;
    let t1 = roll_dot * roll_dot;
    let t2 = cos_pitch * cos_pitch;
    let t3 = sin_pitch * n(p.a_squared);
    let t4 = sin_roll * n(p.b_squared);
    let t5 = cos_roll * cos_roll;
    let t6 = cos_pitch * cos_roll;
    let t7 = sin_pitch * cos_roll;
    let t8 = t2 * n(p.c_squared);
    let t9 = sin_pitch * t3;
    let t10 = sin_roll * t4;
    let t11 = sin_pitch * sin_pitch;
    let t12 = sin_roll * cos_psi;
    let t13 = t7.neg_mul_add(n(p.A), sin_roll * n(p.D));
    let t14 = t8 + t9;
    let t15 = t7.neg_mul_add(n(p.D), sin_roll * n(p.B));
    let t16 = cos_psi * t4;
    let t17 = sin_pitch * sin_psi;
    let t18 = t5.mul_add(t14, t10);
    let t19 = sin_pitch.mul_add(t12, cos_pitch * sin_psi);
    let t20 = n(p.C).mul_add(t11, t2 * n(p.A));
    let t21 = cos_pitch * t7.mul_add(n(p.C), t13);
    let t22 = sin_roll * sin_psi;
    let t23 = t3 * t19;
    let t24 = sin_pitch.neg_mul_add(t13, t6 * (cos_pitch * n(p.C)));
    // Row psi: pivot d[psi].
    let t25 = cos_roll.mul_add(t24, sin_roll * t15);
    let t26 = cos_pitch.mul_sub(t12, t17);
    let t27 = sin_roll * roll_dot;
    let t28 = pitch_dot * t6;
    let t29 = sin_pitch.neg_mul_add(t22, cos_pitch * cos_psi);
    let t30 = sin_psi * t4;
    let t31 = N::ONE / t25;
    let t32 = sin_pitch * t27;
    let t33 = t7 * t28;
    let t34 = t3 * t29;
    let t35 = sin_pitch * cos_psi;
    let t36 = cos_roll * roll_dot;
    let t37 = cos_pitch * t27;
    let t38 = cos_pitch.mul_add(t22, t35);
    let t39 = cos_pitch * psi_dot;
    let t40 = cos_pitch * pitch_dot;
    let t41 = t27 * (cos_roll * n(p.two_b_squared));
    let t42 = sin_pitch * pitch_dot;
    let t43 = cos_psi * t36;
    let t44 = sin_psi * t36;
    let t45 = sin_roll * psi_dot;
    let t46 = N::ONE / t18.sqrt();
    // Eliminates psi from row roll: l[roll, psi].
    let t47 = t21 * t31;
    // Eliminates psi from row pitch: l[pitch, psi].
    let t48 = t15 * t31;
    let t49 = t7.mul_sub(t32, t33).mul_sub(n(p.two_a_squared), t41);
    let t50 = t6.mul_add(t37, t33).mul_add(n(p.two_c_squared), t49);
    // Row roll: pivot d[roll].
    let t51 = t21.neg_mul_add(t47, t20);
    let t52 = t21.neg_mul_add(t48, cos_pitch * n(p.D));
    let t53 = N::ONE / t18 * t50;
    let t54 = cos_psi.mul_add(t42, sin_psi * t39);
    let t55 = psi_dot.neg_mul_add(t22, t43);
    let t56 = N::ONE / t51;
    let t57 = sin_psi.mul_sub(t42, cos_psi * t39);
    let t58 = t27 * t42;
    let t59 = t27 * t39;
    let t60 = psi_dot * t7;
    let t61 = pitch_dot + t45;
    let t62 = psi_dot * t32;
    let t63 = cos_pitch * n(p.half_c_squared);
    let t64 = cos_roll * t46;
    let t65 = roll_dot * t6;
    let t66 = t57 - sin_pitch.mul_add(t55, t12 * t40);
    let t67 = t11 - t2;
    let t68 = t6 * t58;
    let t69 = t6.neg_mul_add(n(p.c_squared) * t46, n(p.h));
    let t70 = sin_pitch.mul_add(psi_dot.mul_add(t12, t44), t22 * t40);
    let t71 = t54 + t70;
    let t72 = cos_pitch.mul_sub(roll_dot, t60);
    let t73 = t26.mul_add(t69, (t16 - t23) * t64);
    // Eliminates roll from row pitch: l[pitch, roll].
    let t74 = t52 * t56;
    let t75 = t14.neg_mul_add(t64, cos_pitch * n(p.h));
    let t76 = t38.mul_add(t69, (t30 + t34) * t64);
    let t77 = t53 * n(p.half_a_squared);
    let t78 = t53 * n(p.half_b_squared);
    let t79 = cos_pitch.mul_sub(t69, t3 * t7 * t46);
    let t80 = cos_roll.mul_sub(t79, t10 * t46);
    // Row pitch: pivot d[pitch].
    let t81 = t52.neg_mul_add(t74, t15.neg_mul_add(t48, n(p.B)));
    let t82 = sin_roll * n(p.b_squared).mul_add(t64, t75);
    let t83 = cos_roll.mul_add(t69, n(p.a_squared) * t6 * t64);
    let t84 = t26.neg_mul_add(t80, t6 * t73);
    let t85 = cos_roll * t80;
    let t86 = t19.neg_mul_add(t80, t7 * t73);
    let t87 = N::ONE / t81;
    // Eliminates roll from row touching: l[touching, roll].
    let t88 = t56 * t82;
    let t89 = t38.neg_mul_add(t80, t6 * t76);
    let t90 = cos_psi.mul_add(t85, sin_roll * t73);
    let t91 = t29.mul_add(t80, t7 * t76);
    let t92 = t52.neg_mul_add(t88, sin_pitch * t83);
    let t93 = t63.neg_mul_add(t53, n(p.c_squared) * t42);
    let t94 = sin_psi.mul_add(t85, sin_roll * t76);
    let t95 = cos_psi * t61;
    let t96 = cos_pitch.mul_add(t84, sin_pitch * t86);
    let t97 = cos_roll.mul_add(t96, sin_roll * t90);
    let t98 = sin_psi * t61;
    let t99 = n(p.a_squared) * t40;
    let t100 = pitch_dot * pitch_dot * t5;
    // Eliminates psi from row along: l[along, psi].
    let t101 = t31 * t97;
    let t102 = n(p.two_c_squared) * t68;
    let t103 = sin_roll.mul_sub(sin_roll, t5);
    let t104 = n(p.two_a_squared) * t68;
    // Eliminates pitch from row touching: l[touching, pitch].
    let t105 = t87 * t92;
    let t106 = sin_pitch.mul_sub(t84, cos_pitch * t86);
    let t107 = t21.neg_mul_add(t101, t106);
    let t108 = psi_dot.mul_add(t6, sin_pitch * roll_dot);
    let t109 = t46 * cos_roll.mul_add(t93, n(p.c_squared) * t37);
    let t110 = roll_dot.mul_sub(t40, pitch_dot.mul_add(t60, t59));
    let t111 = roll_dot.mul_sub(t42, psi_dot.neg_mul_add(t28, t62));
    let t112 = cos_roll * psi_dot;
    // Row touching: pivot d[touching].
    let t113 = t92.mul_add(t105, t82.mul_add(t88, n(p.inverse_m)));
    // Eliminates roll from row along: l[along, roll].
    let t114 = t56 * t107;
    let t115 = cos_pitch.mul_add(t89, sin_pitch * t91);
    let t116 = cos_roll.mul_add(t115, sin_roll * t94);
    let t117 = psi_dot * t36;
    let t118 = t61 * t108;
    let t119 = sin_roll.neg_mul_add(t54, cos_psi * t65);
    let t120 = t119 - sin_psi.mul_add(t40, psi_dot * t35);
    let t121 = t19.neg_mul_add(t77, n(p.a_squared) * t66);
    let t122 = cos_psi.neg_mul_add(t78, sin_psi * t0);
    let t123 = t100.mul_add(n(p.c_squared) * t67, t102);
    let t124 = t100.mul_add(n(p.a_squared) * t67, t104);
    let t125 = sin_psi.mul_add(t78, cos_psi * t0);
    let t126 = t29.neg_mul_add(t77, n(p.a_squared) * t71);
    let t127 = sin_roll.neg_mul_add(t57, sin_psi * t65);
    let t128 = cos_psi.mul_sub(t40, psi_dot * t17) + t127;
    let t129 = N::ONE / t113;
    let t130 = t52.neg_mul_add(t114, t15.neg_mul_add(t101, t90));
    // Eliminates psi from row across: l[across, psi].
    let t131 = t31 * t116;
    let t132 = pitch_dot.neg_mul_add(t72, t59);
    let t133 = t72 * t108;
    let t134 = pitch_dot.neg_mul_add(t108, t62);
    let t135 = sin_pitch.mul_add(t77, t40 * n(p.two_a_squared));
    let t136 = (t98 - t43).mul_add(t112, t27 * t95);
    let t137 = sin_pitch.mul_sub(t121, t19 * t99);
    let t138 = sin_roll.mul_sub(t122, n(p.b_squared) * t43);
    let t139 = t7.mul_add(t111, t72 * (t32 - t28));
    let t140 = t103.mul_sub(t1 * t9, t104) - t124;
    let t141 = sin_roll.mul_add(t125, n(p.b_squared) * t44);
    let t142 = sin_pitch.mul_sub(t126, t29 * t99);
    let t143 = t112.neg_mul_add(t44 + t95, t27 * t98);
    // Eliminates pitch from row along: l[along, pitch].
    let t144 = t87 * t130;
    let t145 = sin_pitch.mul_sub(t89, cos_pitch * t91);
    let t146 = t21.neg_mul_add(t131, t145);
    let t147 = n(p.C).mul_add(t132, t72 * (t61 * n(p.A_minus_B)));
    let t148 = n(p.D).neg_mul_add(t72.mul_sub(t72, t61 * t61), t147);
    let t149 = sin_roll * sin_roll.mul_add(t78, n(p.two_b_squared) * t36);
    let t150 = cos_roll.neg_mul_add(t135, t32 * n(p.two_a_squared));
    let t151 = t42.mul_sub(t69, cos_pitch * t109);
    let t152 = t66.mul_add(t72, t19 * t111) + t136;
    let t153 = cos_roll.mul_add(t138, t16 * t27);
    let t154 = t6.neg_mul_add(t110, t108 * pitch_dot.mul_add(t7, t37));
    let t155 = t36.mul_add(t45 + t61, t139) - t154;
    let t156 = t123 + t103.mul_add(t1 * t8, t102) + t140;
    let t157 = t1 * n(p.two_b_squared) * t103;
    let t158 = cos_roll.neg_mul_add(t141, t27 * t30);
    let t159 = t71.mul_add(t72, t29 * t111) - t143;
    let t160 = t92.mul_add(t144, t82 * t114);
    // Eliminates roll from row across: l[across, roll].
    let t161 = t56 * t146;
    let t162 = n(p.A).mul_sub(t134, t118 * n(p.B_minus_C));
    let t163 = n(p.D).mul_add(t117 - t133, t162);
    let t164 = t133.mul_add(n(p.A_minus_C), n(p.B) * t117);
    let t165 = n(p.D).mul_add(t118 + t134, t164);
    let t166 = cos_roll.mul_add(t151, t37 * t69);
    let t167 = t46.mul_sub(t7.mul_sub(t150, t149), t166);
    let t168 = cos_roll.mul_add(t137, t23 * t27) - t153;
    let t169 = sin_pitch.mul_sub(t72, cos_pitch * t108);
    let t170 = cos_roll.mul_sub(t169, sin_roll * t61);
    let t171 = t156.mul_sub(N::from_f64(2.0), t157);
    let t172 = t158 + cos_roll.mul_add(t142, t27 * t34);
    let t173 = t97.mul_add(t101, n(p.inverse_m));
    let t174 = t130.mul_add(t144, t107 * t114) + t173;
    // Eliminates touching from row along: l[along, touching].
    let t175 = t129 * t160;
    let t176 = t52.neg_mul_add(t161, t15.neg_mul_add(t131, t94));
    let t177 = t26.neg_mul_add(t108, t19.mul_add(t72, cos_roll * t95));
    let t178 = t80 * (t108.mul_add(t120, t26 * t110) + t152);
    let t179 = t46.mul_add(t168, t69.mul_add(t120, t26 * t109));
    let t180 = t53.neg_mul_add(t50 * N::from_f64(0.5), t171);
    let t181 = t1.mul_sub(t6, t58) - pitch_dot.neg_mul_add(t28, t58);
    let t182 = t46.mul_sub(t172, t69.mul_add(t128, t38 * t109));
    let t183 = cos_roll.neg_mul_add(t98, t29.mul_add(t72, t38 * t108));
    let t184 = t80 * (t159 - t108.mul_add(t128, t38 * t110));
    // Row along: pivot d[along].
    let t185 = t160.neg_mul_add(t175, t174);
    // Eliminates pitch from row across: l[across, pitch].
    let t186 = t87 * t176;
    let t187 = cos_pitch.mul_add(t148, sin_pitch * t163);
    let t188 = cos_roll.mul_sub(t187, sin_roll * t165);
    let t189 = N::ONE / t185;
    let t190 = t92.mul_add(t186, t82 * t161);
    let t191 = sin_pitch.mul_sub(t148, cos_pitch * t163);
    // Row roll: right-hand side z[roll].
    let t192 = t47.neg_mul_add(t188, t191);
    let t193 = t167.mul_sub(t177, t178) - t179.mul_sub(t170, t73 * t155);
    let t194 = t46.mul_add(N::from_f64(0.5) * t180, n(p.h) * t181);
    let t195 = t170.mul_add(t182, t76 * t155) - t167.mul_sub(t183, t184);
    // Eliminates touching from row across: l[across, touching].
    let t196 = t129 * t190;
    // Row pitch: right-hand side z[pitch].
    let t197 = t74.mul_add(t192, t48.mul_add(t188, t165));
    let t198 = t130.mul_add(t186, t107.mul_add(t161, t97 * t131));
    let t199 = t160.neg_mul_add(t196, t198);
    let t200 = t116.mul_add(t131, n(p.inverse_m));
    let t201 = t176.mul_add(t186, t146 * t161) + t200;
    let t202 = t114.mul_add(t192, t101.mul_add(t188, t193));
    // Row touching: right-hand side z[touching].
    let t203 = t105.neg_mul_add(t197, t88.mul_add(t192, t194 + n(p.g)));
    let t204 = t161.mul_add(t192, t131.mul_add(t188, t195));
    // Eliminates along from row across: l[across, along].
    let t205 = t189 * t199;
    // Row along: right-hand side z[along].
    let t206 = t175.neg_mul_add(t203, t144.neg_mul_add(t197, t202));
    // Row across: pivot d[across].
    let t207 = t199.neg_mul_add(t205, t190.neg_mul_add(t196, t201));
    let t208 = t196.neg_mul_add(t203, t186.neg_mul_add(t197, t204));
    // Row across: right-hand side z[across].
    let t209 = t205.neg_mul_add(t206, t208) / t207;
    // Back substitution: lambda[along].
    let t210 = t205.neg_mul_add(t209, t189 * t206);
    let t211 = t196.neg_mul_add(t209, t129 * t203);
    // Back substitution: lambda[touching].
    let t212 = t175.neg_mul_add(t210, t211);
    let t213 = t144.mul_add(t210, t186.mul_add(t209, t87 * t197));
    // Back substitution: a[pitch].
    let t214 = t105.mul_add(t212, t213);
    let t215 = t114.neg_mul_add(t210, t161.neg_mul_add(t209, t56 * t192));
    // Back substitution: a[roll].
    let roll_ddot = t74.mul_add(t214, t88.neg_mul_add(t212, t215));
    let t216 = t101.neg_mul_add(t210, t131.neg_mul_add(t209, t31 * t188));
    // Back substitution: a[x].
    let x_ddot = -(n(p.inverse_m) * t210);
    // Back substitution: a[y].
    let y_ddot = -(n(p.inverse_m) * t209);
    let z_ddot = n(p.inverse_m).mul_sub(t212, n(p.g));
    // Back substitution: a[psi].
    let psi_ddot = t47.neg_mul_add(roll_ddot, t48.mul_add(t214, t216));
    let pitch_ddot = -t214;
    let sound = PIVOTS.hold(t25, t25)
        & PIVOTS.hold(t51, t20)
        & PIVOTS.hold(t81, n(p.B))
        & PIVOTS.hold(t113, t113)
        & PIVOTS.hold(t185, t174)
        & PIVOTS.hold(t207, t201)
        & psi_ddot.is_finite();
    if !sound {
        let pivots = [
            (3, t25, t25),
            (4, t51, t20),
            (5, t81, n(p.B)),
            (6, t113, t113),
            (7, t185, t174),
            (8, t207, t201),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        x_ddot.store(),
        y_ddot.store(),
        z_ddot.store(),
        psi_ddot.store(),
        roll_ddot.store(),
        pitch_ddot.store(),
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
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 6], v: &'a [S; 6] })
        -> Result<[S; 3], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let psi = n(q[3]);
    let roll = n(q[4]);
    let pitch = n(q[5]);
    let psi_dot = n(v[3]);
    let roll_dot = n(v[4]);
    let pitch_dot = n(v[5]);
    let angles = [pitch, roll, psi];
    let circular = N::sin_cos_all(angles);
    let (sin_pitch, cos_pitch) = circular[0];
    let (sin_roll, cos_roll) = circular[1];
    let (sin_psi, cos_psi) = circular[2];
    let t0 = sin_pitch * cos_roll;
    let t1 = sin_roll * sin_roll;
    let t2 = cos_pitch * cos_roll;
    let t3 = t2 * n(p.c_squared);
    let t4 = t0.neg_mul_add(n(p.D), sin_roll * n(p.B));
    let t5 = t0.neg_mul_add(n(p.A), sin_roll * n(p.D));
    let t6 = sin_pitch * (sin_pitch * n(p.C));
    let t7 = cos_pitch.mul_add(cos_pitch * n(p.A), t6);
    let t8 = sin_roll * cos_psi;
    let t9 = cos_pitch.mul_add(t5, t0 * (cos_pitch * n(p.C)));
    let t10 = sin_roll * roll_dot;
    let t11 = t2 * pitch_dot;
    let t12 = t0.mul_add(t0 * n(p.a_squared), t1 * n(p.b_squared));
    let t13 = t2.mul_add(t3, t12);
    let t14 = cos_pitch.mul_sub(t8, sin_pitch * sin_psi);
    let t15 = sin_pitch.mul_add(t8, cos_pitch * sin_psi);
    let t16 = sin_roll * sin_psi;
    let t17 = sin_pitch * t10;
    let t18 = t0 * t11;
    let t19 = t10 * n(p.two_b_squared);
    // Row psi: pivot d[psi].
    let t20 = t0.neg_mul_add(t5, t2.mul_add(t2 * n(p.C), sin_roll * t4));
    let t21 = cos_pitch.mul_add(t16, sin_pitch * cos_psi);
    let t22 = cos_pitch * t10;
    let t23 = N::ONE / t20;
    let t24 = sin_pitch.neg_mul_add(t16, cos_pitch * cos_psi);
    let t25 = cos_pitch * pitch_dot;
    let t26 = sin_pitch * psi_dot;
    let t27 = t0.mul_sub(t17, t18);
    let t28 = t0 * pitch_dot;
    let t29 = cos_pitch * psi_dot;
    let t30 = sin_pitch * pitch_dot;
    let t31 = cos_roll * roll_dot;
    let t32 = n(p.two_a_squared).mul_sub(t27, cos_roll * t19);
    let t33 = n(p.two_c_squared).mul_add(t2.mul_add(t22, t18), t32);
    let t34 = t22 * t28;
    let t35 = t0 * roll_dot;
    let t36 = N::ONE / t13 * t33;
    let t37 = t0.neg_mul_add(psi_dot, cos_pitch * roll_dot);
    let t38 = sin_roll.mul_add(psi_dot, pitch_dot);
    let t39 = N::ONE / t13.sqrt();
    // Eliminates psi from row roll: l[roll, psi].
    let t40 = t23 * t9;
    // Eliminates psi from row pitch: l[pitch, psi].
    let t41 = t4 * t23;
    let t42 = psi_dot * t17;
    let t43 = t28 * t28;
    let t44 = n(p.c_squared) * t22;
    let t45 = t2 * roll_dot;
    // Row roll: pivot d[roll].
    let t46 = t9.neg_mul_add(t40, t7);
    let t47 = t9.neg_mul_add(t41, cos_pitch * n(p.D));
    let t48 = n(p.two_a_squared) * t34;
    let t49 = t36 * n(p.half_b_squared);
    let t50 = N::ONE / t46;
    let t51 = cos_roll * psi_dot;
    let t52 = cos_psi * t31;
    let t53 = sin_psi * t31;
    let t54 = cos_roll * t39;
    let t55 = t3 * t39;
    let t56 = n(p.b_squared) * t39;
    let t57 = t0 * t39;
    let t58 = n(p.a_squared) * t39;
    let t59 = psi_dot * t22;
    let t60 = t2.mul_add(psi_dot, sin_pitch * roll_dot);
    let t61 = n(p.two_c_squared) * t34;
    let t62 = n(p.b_squared) * t54;
    let t63 = n(p.h) - t55;
    let t64 = n(p.a_squared) * t57;
    let t65 = t11 * t11;
    let t66 = t62 * t8;
    // Eliminates roll from row pitch: l[pitch, roll].
    let t67 = t50 * t47;
    let t68 = cos_pitch.neg_mul_add(t55, cos_pitch * n(p.h));
    let t69 = t16 * t62;
    // Row pitch: pivot d[pitch].
    let t70 = t47.neg_mul_add(t67, t4.neg_mul_add(t41, n(p.B)));
    let t71 = t0.neg_mul_add(t64, t2.mul_sub(t63, t1 * t56));
    let t72 = sin_pitch.neg_mul_add(t64, t68);
    let t73 = sin_roll.mul_add(t72, sin_roll * t62);
    let t74 = sin_pitch * t3.neg_mul_add(t54, cos_roll * n(p.h));
    let t75 = t64.neg_mul_add(t15, t63.mul_add(t14, t66));
    let t76 = N::ONE / t70;
    let t77 = cos_roll * t71;
    let t78 = t69 + t64.mul_add(t24, t63 * t21);
    // Eliminates roll from row touching: l[touching, roll].
    let t79 = t50 * t73;
    let t80 = t2.mul_sub(t75, t71 * t14);
    let t81 = t0.mul_sub(t75, t71 * t15);
    let t82 = t2.mul_sub(t78, t71 * t21);
    let t83 = t47.neg_mul_add(t79, t2.mul_add(t64, t74));
    let t84 = t0.mul_add(t78, t71 * t24);
    let t85 = t57 * n(p.two_a_squared);
    let t86 = sin_roll.mul_add(t75, cos_psi * t77);
    let t87 = cos_psi * t38;
    let t88 = cos_psi.mul_add(t35, t8.mul_sub(t25, t16 * t26));
    let t89 = sin_psi.mul_sub(t30, cos_psi * t29) - t88;
    let t90 = sin_psi * t38;
    let t91 = t15 * t58;
    let t92 = sin_roll.mul_add(t86, t0.mul_add(t81, t2 * t80));
    let t93 = t54 * t49;
    let t94 = sin_psi.mul_add(t35, t8.mul_add(t26, t16 * t25));
    let t95 = t94 + sin_psi.mul_add(t29, cos_psi * t30);
    let t96 = t24 * t58;
    // Eliminates psi from row along: l[along, psi].
    let t97 = t23 * t92;
    // Eliminates pitch from row touching: l[touching, pitch].
    let t98 = t76 * t83;
    let t99 = sin_psi.mul_add(t77, sin_roll * t78);
    let t100 = sin_pitch.mul_sub(t80, cos_pitch * t81);
    let t101 = t9.neg_mul_add(t97, t100);
    let t102 = roll_dot * t45;
    let t103 = t17.mul_sub(n(p.a_squared) * t17, t48);
    let t104 = n(p.a_squared).mul_add(t43, t48);
    let t105 = t39 * t36;
    let t106 = t36 * (t57 * n(p.half_a_squared));
    let t107 = cos_psi.mul_sub(t45, t16.mul_add(t29, t8 * t30));
    let t108 = t107 - cos_psi.mul_add(t26, sin_psi * t25);
    let t109 = roll_dot.mul_sub(t30, psi_dot.neg_mul_add(t11, t42));
    let t110 = t56 * t10;
    let t111 = sin_psi.mul_add(t45, t8.mul_sub(t29, t16 * t30));
    let t112 = cos_psi.mul_sub(t25, sin_psi * t26) + t111;
    // Row touching: pivot d[touching].
    let t113 = t83.mul_add(t98, t73.mul_add(t79, n(p.inverse_m)));
    // Eliminates roll from row along: l[along, roll].
    let t114 = t50 * t101;
    let t115 = sin_roll.mul_add(t99, t0.mul_add(t84, t2 * t82));
    let t116 = t60 * t38;
    let t117 = n(p.c_squared).mul_add(t43, t61);
    let t118 = t35.neg_mul_add(n(p.a_squared) * t35, t103);
    let t119 = t57.mul_add(n(p.c_squared) * pitch_dot, t39 * t44);
    let t120 = t105.neg_mul_add(t2 * n(p.half_c_squared), t119);
    let t121 = roll_dot.mul_sub(t25, psi_dot.mul_add(t28, t59));
    let t122 = N::ONE / t113;
    let t123 = t47.neg_mul_add(t114, t4.neg_mul_add(t97, t86));
    // Eliminates psi from row across: l[across, psi].
    let t124 = t23 * t115;
    let t125 = t37.neg_mul_add(pitch_dot, t59);
    let t126 = t60 * t37;
    let t127 = psi_dot * t31;
    let t128 = t60.neg_mul_add(pitch_dot, t42);
    let t129 = t3.neg_mul_add(t102, t22.mul_add(t44, t61));
    let t130 = n(p.two_b_squared) * t10.mul_sub(t10, t31 * t31);
    let t131 = t118 - n(p.a_squared).neg_mul_add(t65, t104);
    let t132 = pitch_dot * t17;
    let t133 = t51.mul_add(t90, t10.mul_sub(t87, t51 * t52));
    let t134 = t0.mul_add(t109, t37.mul_sub(t17, t37 * t11));
    let t135 = t66.mul_add(psi_dot, t16 * t93);
    let t136 = t51.neg_mul_add(t87, t10.mul_sub(t90, t51 * t53));
    // Eliminates pitch from row along: l[along, pitch].
    let t137 = t76 * t123;
    let t138 = sin_pitch.mul_sub(t82, cos_pitch * t84);
    let t139 = t9.neg_mul_add(t124, t138);
    let t140 = n(p.C).mul_add(t125, t37 * (t38 * n(p.A_minus_B)));
    let t141 = n(p.D).neg_mul_add(t37.mul_sub(t37, t38 * t38), t140);
    let t142 = n(p.c_squared).neg_mul_add(t65, t117) + t129;
    let t143 = N::from_f64(2.0).mul_sub(t131, t130);
    let t144 = t0.neg_mul_add(t106, t17.mul_sub(t85, t11 * t85));
    let t145 = t133 + t15.mul_add(t109, t37 * t89);
    let t146 = t64.mul_add(t89, t17 * t91) - t15.mul_add(t106, t11 * t91);
    let t147 = t69.mul_sub(psi_dot, t8 * t93);
    let t148 = t2.neg_mul_add(t121, t60.mul_add(t28, t60 * t22));
    let t149 = t10.mul_add(t51, t31 * t38) + t134 - t148;
    let t150 = t64.mul_add(t95, t17 * t96) - t24.mul_add(t106, t11 * t96);
    let t151 = t24.mul_add(t109, t37 * t95) - t136;
    let t152 = t137.mul_add(t83, t114 * t73);
    // Eliminates roll from row across: l[across, roll].
    let t153 = t50 * t139;
    let t154 = n(p.A).mul_sub(t128, t116 * n(p.B_minus_C));
    let t155 = n(p.D).mul_add(t127 - t126, t154);
    let t156 = t2.neg_mul_add(t120, t63.mul_add(t28, t63 * t22));
    let t157 = t144 - t54.mul_add(t19, t39 * (t1 * t49)) - t156;
    let t158 = t14.mul_add(t120, t63 * t108) + t146;
    let t159 = t2.neg_mul_add(t60, t0.mul_sub(t37, sin_roll * t38));
    let t160 = t16.mul_sub(t110, t62 * t53) - t135 + t150;
    let t161 = t92.mul_add(t97, n(p.inverse_m));
    let t162 = t123.mul_add(t137, t101 * t114) + t161;
    // Eliminates touching from row along: l[along, touching].
    let t163 = t122 * t152;
    let t164 = t47.neg_mul_add(t153, t4.neg_mul_add(t124, t99));
    let t165 = t126.mul_add(n(p.A_minus_C), n(p.B) * t127);
    let t166 = n(p.D).mul_add(t116 + t128, t165);
    let t167 = t39 * N::from_f64(2.0).mul_add(t142, t143);
    let t168 = t14.neg_mul_add(t60, cos_roll.mul_add(t87, t15 * t37));
    let t169 = t71 * (t14.mul_add(t121, t60 * t108) + t145);
    let t170 = t158 - (t8.mul_sub(t110, t62 * t52) + t147);
    let t171 = t160 - t21.mul_add(t120, t63 * t112);
    let t172 = cos_roll.neg_mul_add(t90, t21.mul_add(t60, t24 * t37));
    let t173 = t71 * (t151 - t21.mul_add(t121, t60 * t112));
    // Row along: pivot d[along].
    let t174 = t152.neg_mul_add(t163, t162);
    // Eliminates pitch from row across: l[across, pitch].
    let t175 = t76 * t164;
    let t176 = sin_roll.neg_mul_add(t166, t0.mul_add(t155, t2 * t141));
    let t177 = n(p.h) * (t102 - t132 - pitch_dot.neg_mul_add(t11, t132));
    let t178 = t105.neg_mul_add(N::from_f64(0.5) * t33, t167);
    let t179 = N::ONE / t174;
    let t180 = t175.mul_add(t83, t153 * t73);
    let t181 = sin_pitch.mul_sub(t141, cos_pitch * t155);
    // Row roll: right-hand side z[roll].
    let t182 = t40.neg_mul_add(t176, t181);
    let t183 = t157.mul_sub(t168, t169) - t159.mul_sub(t170, t75 * t149);
    let t184 = t159.mul_add(t171, t78 * t149) - t157.mul_sub(t172, t173);
    // Eliminates touching from row across: l[across, touching].
    let t185 = t122 * t180;
    // Row pitch: right-hand side z[pitch].
    let t186 = t67.mul_add(t182, t41.mul_add(t176, t166));
    let t187 = N::from_f64(0.5).mul_add(t178, t177) + n(p.g);
    let t188 = t175.mul_add(t123, t153.mul_add(t101, t124 * t92));
    let t189 = t152.neg_mul_add(t185, t188);
    // Row touching: right-hand side z[touching].
    let t190 = t98.neg_mul_add(t186, t79.mul_add(t182, t187));
    let t191 = t114.mul_add(t182, t97.mul_add(t176, t183));
    let t192 = t153.mul_add(t182, t124.mul_add(t176, t184));
    let t193 = t115.mul_add(t124, n(p.inverse_m));
    let t194 = t164.mul_add(t175, t139 * t153) + t193;
    // Eliminates along from row across: l[across, along].
    let t195 = t179 * t189;
    // Row along: right-hand side z[along].
    let t196 = t163.neg_mul_add(t190, t137.neg_mul_add(t186, t191));
    let t197 = t179 * t196;
    let t198 = t185.neg_mul_add(t190, t175.neg_mul_add(t186, t192));
    // Row across: pivot d[across].
    let t199 = t189.neg_mul_add(t195, t180.neg_mul_add(t185, t194));
    // Row across: right-hand side z[across].
    let t200 = t195.neg_mul_add(t196, t198) / t199;
    let t201 = t195 * t200;
    let t202 = t185.neg_mul_add(t200, t122 * t190);
    // Back substitution: lambda[along]; Back substitution: lambda[touching].
    let lambda1 = t163.neg_mul_add(t197 - t201, t202);
    let lambda2 = t201 - t197;
    let lambda3 = -t200;
    let sound = PIVOTS.hold(t20, t20)
        & PIVOTS.hold(t46, t7)
        & PIVOTS.hold(t70, n(p.B))
        & PIVOTS.hold(t113, t113)
        & PIVOTS.hold(t174, t162)
        & PIVOTS.hold(t199, t194)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (3, t20, t20),
            (4, t46, t7),
            (5, t70, n(p.B)),
            (6, t113, t113),
            (7, t174, t162),
            (8, t199, t194),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store(), lambda3.store()];
    Ok(multipliers)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*m*der(z)^2 + 1/2*(cos(pitch)*der(roll) -
///     cos(roll)*sin(pitch)*der(psi))*(A*(cos(pitch)*der(roll) - cos(roll)*sin(pitch)*der(psi)) +
///     D*(sin(roll)*der(psi) + der(pitch))) + 1/2*(sin(roll)*der(psi) +
///     der(pitch))*(D*(cos(pitch)*der(roll) - cos(roll)*sin(pitch)*der(psi)) +
///     B*(sin(roll)*der(psi) + der(pitch)))
///     + 1/2*C*(cos(roll)*cos(pitch)*der(psi) + sin(pitch)*der(roll))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> S {
    let roll = q[4];
    let pitch = q[5];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let psi_dot = v[3];
    let roll_dot = v[4];
    let pitch_dot = v[5];
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let t0 = cos_roll * psi_dot;
    let t1 = sin_roll * psi_dot + pitch_dot;
    let t2 = cos_pitch * roll_dot - sin_pitch * t0;
    let t3 = cos_roll * y_dot + sin_roll * z_dot;
    let t4 = cos_roll * z_dot - sin_roll * y_dot;
    let t5 = cos_pitch * t0 + sin_pitch * roll_dot;
    let t6 = cos_pitch * x_dot - sin_pitch * t4;
    let t7 = sin_pitch * x_dot + cos_pitch * t4;
    let t8 = t5 * (t5 * p.C) + t2 * (t1 * p.D + t2 * p.A);
    let t9 = (t7 * t7 + (t3 * t3 + t6 * t6)) * p.m;
    (t9 + (t1 * (t1 * p.B + t2 * p.D) + t8)) * S::from_f64(0.5)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*g*z
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let z = q[2];
    p.m_g * z
}

::lagrangian::emitted::implement! {
    machine Rattleback "Rattleback" over S, R;
    parameters { m, a, b, c, h, A, B, C, D, g } [
        m: "m" "kg" = 1.0;
        a: "a" "m" = 0.2;
        b: "b" "m" = 0.03;
        c: "c" "m" = 0.02;
        h: "h" "m" = 0.01;
        A: "A" "kg*m^2" = 0.0002;
        B: "B" "kg*m^2" = 0.0016;
        C: "C" "kg*m^2" = 0.0017;
        D: "D" "kg*m^2" = -2e-5;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 6 Coordinates { x, y, z, psi, roll, pitch } [
        x: "x" "m";
        y: "y" "m";
        z: "z" "m";
        psi: "psi" "rad";
        roll: "roll" "rad";
        pitch: "pitch" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, h, A, B, C, D, g, a_squared, b_squared, c_squared, m_g, B_minus_C, A_minus_C, A_minus_B,
        two_a_squared, two_c_squared, two_b_squared, half_c_squared, half_a_squared, half_b_squared,
        two_D, minus_m_g, inverse_m,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p);
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
        constraints constraints(p) = [
            ("touching", "m", "N", true),
            ("along", "m/s", "N", false),
            ("across", "m/s", "N", false),
        ];
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(6, 3);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
