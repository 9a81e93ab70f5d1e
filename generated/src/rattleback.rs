// @generated from machines/rattleback.machine by `cargo xtask generate`; edits are lost.

//! A rattleback, or Celtic stone: half an ellipsoid that rolls on a table, its axes of inertia
//! turned
//! against those of its shape. Spun one way it begins to rattle and turns round.
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
//! | `constraint_bias` | 199 | 110 | 2 | 3 | 1 | 318 |
//! | `accelerations` | 353 | 207 | 8 | 3 | 1 | 575 |
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

/// A rattleback, or Celtic stone: half an ellipsoid that rolls on a table, its axes of inertia
/// turned
/// against those of its shape. Spun one way it begins to rattle and turns round.
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
        let k0 = self.a * self.a;
        let k1 = self.b * self.b;
        let k2 = self.c * self.c;
        let k3 = self.m * self.g;
        let k4 = self.B - self.C;
        let k5 = self.A - self.C;
        let k6 = self.A - self.B;
        let k7 = k0 * S::from_f64(2.0);
        let k8 = k2 * S::from_f64(2.0);
        let k9 = k1 * S::from_f64(2.0);
        let k10 = k2 * S::from_f64(0.5);
        let k11 = k0 * S::from_f64(0.5);
        let k12 = k1 * S::from_f64(0.5);
        let k13 = self.D * S::from_f64(2.0);
        let k14 = -k3;
        let k15 = S::ONE / self.m;
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

/// What can be set while a [`Rattleback`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`Rattleback`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

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
    k0: S,
    /// `b^2`
    k1: S,
    /// `c^2`
    k2: S,
    /// `m*g`
    k3: S,
    /// `B - C`
    k4: S,
    /// `A - C`
    k5: S,
    /// `A - B`
    k6: S,
    /// `2*a^2`
    k7: S,
    /// `2*c^2`
    k8: S,
    /// `2*b^2`
    k9: S,
    /// `0.5*c^2`
    k10: S,
    /// `0.5*a^2`
    k11: S,
    /// `0.5*b^2`
    k12: S,
    /// `2*D`
    k13: S,
    /// `-m*g`
    k14: S,
    /// `1/m`
    k15: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 6,
    tolerance: 7.993605777301127e-15,
};

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
    let t2 = cos_pitch * p.k5;
    let m65 = cos_pitch * p.D;
    let t3 = cos_pitch * t2;
    let zero = S::ZERO;
    let m44 = t0 * p.k6 + p.B - (t1 * (sin_roll * p.k13) + t0 * t3);
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
    let t11 = t7 * (t4 * p.k6) + (cos_pitch * t3 - t7 * pitch_dot) * p.C;
    let t12 = t11 - p.D * (t7 * t7 - t4 * t4);
    let h_pitch = p.D * (t8 + t10) + (t9 * p.k5 + t5 * p.B);
    let t13 = p.D * (t5 - t9) + (t10 * p.A - t8 * p.k4);
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
    [zero, zero, p.k14, zero, zero, zero]
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
    let t11 = t7 * (t4 * p.k6) + (cos_pitch * t3 - t7 * pitch_dot) * p.C;
    let t12 = t11 - p.D * (t7 * t7 - t4 * t4);
    let t13 = p.D * (t8 + t10) + (t9 * p.k5 + t5 * p.B);
    let t14 = p.D * (t5 - t9) + (t10 * p.A - t8 * p.k4);
    let zero = S::ZERO;
    let f_psi = t2 * t14 + t1 * t12 - sin_roll * t13;
    let f_roll = sin_pitch * t12 - cos_pitch * t14;
    let f_pitch = -t13;
    [zero, zero, p.k14, f_psi, f_roll, f_pitch]
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
    let t2 = t1 * (t1 * p.k2) + (sin_roll * (sin_roll * p.k1) + t0 * (t0 * p.k0));
    let g1 = t1 * p.h + z - t2.sqrt();
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
    let t0 = sin_pitch * p.k0;
    let t1 = sin_roll * p.k1;
    let t2 = sin_pitch * cos_roll;
    let t3 = cos_pitch * cos_roll;
    let t4 = cos_pitch * sin_roll;
    let t5 = sin_pitch * sin_roll;
    let t6 = sin_roll * t1;
    let t7 = t2 * pitch_dot;
    let t8 = t3 * psi_dot + sin_pitch * roll_dot;
    let t9 = t7 * t3;
    let t10 = cos_pitch * roll_dot - t2 * psi_dot;
    let t11 = cos_pitch * (cos_pitch * p.k2) + sin_pitch * t0;
    let t12 = t5 * cos_psi + cos_pitch * sin_psi;
    let t13 = pitch_dot + sin_roll * psi_dot;
    let t14 = t4 * cos_psi - sin_pitch * sin_psi;
    let t15 = sin_pitch * cos_psi + t4 * sin_psi;
    let t16 = cos_pitch * cos_psi - t5 * sin_psi;
    let t17 = t4 * roll_dot;
    let t18 = cos_roll * t13;
    let t19 = sin_roll * (cos_roll * (roll_dot * p.k9));
    let t20 = cos_roll * (sin_pitch * t10 - cos_pitch * t8) - sin_roll * t13;
    let t21 = (t9 + t17 * t3) * p.k8 + ((t5 * (t2 * roll_dot) - t9) * p.k7 - t19);
    let t22 = S::ONE / (t11 * (cos_roll * cos_roll) + t6).sqrt();
    let t23 = p.h - t22 * (p.k2 * t3);
    let t24 = cos_roll * t22;
    let t25 = cos_roll * (cos_pitch * t23 - t22 * (t2 * t0)) - t6 * t22;
    let t26 = t20 * (t24 * (t1 * cos_psi - t0 * t12) + t14 * t23);
    let t27 = t20 * (t24 * (t1 * sin_psi + t0 * t16) + t23 * t15);
    let phi1 = t22 * (S::from_f64(0.5) * t21) + (z_dot - (t7 + t17) * p.h);
    let phi2 = t25 * (cos_psi * t18 + t10 * t12 - t8 * t14) - t26 + x_dot;
    let phi3 = y_dot - (t25 * (t8 * t15 + t10 * t16 - sin_psi * t18) + t27);
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
    let t1 = sin_roll * p.k1;
    let t2 = cos_pitch * cos_roll;
    let t3 = sin_pitch * sin_roll;
    let t4 = cos_pitch * sin_roll;
    let t5 = t0 * p.k0;
    let t6 = sin_roll * t1;
    let t7 = t2 * p.k2;
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
    let t1 = p.k1 * psi_dot;
    let t2 = cos_pitch * cos_pitch;
    let t3 = sin_pitch * p.k0;
    let t4 = sin_roll * p.k1;
    let t5 = cos_roll * cos_roll;
    let t6 = cos_pitch * pitch_dot;
    let t7 = sin_roll * roll_dot;
    let t8 = sin_pitch * cos_roll;
    let t9 = cos_roll * roll_dot;
    let t10 = t2 * p.k2;
    let t11 = sin_pitch * t3;
    let t12 = sin_roll * t4;
    let t13 = sin_pitch * pitch_dot;
    let t14 = cos_roll * t6;
    let t15 = cos_roll * t7;
    let t16 = sin_pitch * t7;
    let t17 = cos_pitch * cos_psi;
    let t18 = t9 * cos_psi;
    let t19 = sin_roll * psi_dot;
    let t20 = sin_roll * t6;
    let t21 = t14 * t8;
    let t22 = t9 * sin_psi;
    let t23 = cos_pitch * sin_psi;
    let t24 = t5 * (t10 + t11) + t12;
    let t25 = t13 * sin_psi;
    let t26 = psi_dot * t17;
    let t27 = cos_pitch * t7;
    let t28 = psi_dot * t23 + t13 * cos_psi;
    let t29 = p.k8 * (t21 + t2 * t15) + (p.k7 * (t8 * t16 - t21) - t15 * p.k9);
    let t30 = sin_pitch * sin_pitch - t2;
    let t31 = t7 * t8;
    let t32 = t6 * p.k7;
    let t33 = cos_pitch * roll_dot;
    let t34 = sin_pitch * cos_psi;
    let t35 = t25 - t26 - (sin_pitch * (t18 - t19 * sin_psi) + cos_psi * t20);
    let t36 = sin_pitch * sin_psi;
    let t37 = pitch_dot + t19;
    let t38 = t16 - t14;
    let t39 = t28 + (sin_pitch * (t22 + t19 * cos_psi) + sin_psi * t20);
    let t40 = S::ONE / t24 * t29;
    let t41 = t5 * (pitch_dot * pitch_dot);
    let t42 = t31 * (t6 * p.k8);
    let t43 = sin_roll * sin_roll - t5;
    let t44 = t31 * t32;
    let t45 = S::ONE / t24.sqrt();
    let t46 = t40 * p.k11;
    let t47 = sin_roll * t34 + t23;
    let t48 = t6 * p.k0;
    let t49 = t40 * p.k12;
    let t50 = cos_pitch * cos_roll;
    let t51 = t33 - t8 * psi_dot;
    let t52 = t13 * roll_dot - psi_dot * t38;
    let t53 = pitch_dot * t8 + t27;
    let t54 = t37 * cos_psi;
    let t55 = t37 * sin_psi;
    let t56 = t17 - sin_roll * t36;
    let t57 = t3 * t47;
    let t58 = t4 * cos_psi;
    let t59 = t45 * (cos_roll * (t13 * p.k2 - t40 * (cos_pitch * p.k10)) + p.k2 * t27);
    let t60 = sin_roll * t17 - t36;
    let t61 = t50 * psi_dot + sin_pitch * roll_dot;
    let t62 = roll_dot * t6 - psi_dot * t53;
    let t63 = cos_roll * psi_dot;
    let t64 = t34 + sin_roll * t23;
    let t65 = t3 * t56;
    let t66 = t4 * sin_psi;
    let t67 = t9 * t17 - sin_roll * t28 - (psi_dot * t34 + t6 * sin_psi);
    let t68 = p.h - t45 * (p.k2 * t50);
    let t69 = t6 * cos_psi - psi_dot * t36 + (sin_roll * (t26 - t25) + t9 * t23);
    let t70 = t43 * (t11 * t0) - t44 - (t44 + t41 * (p.k0 * t30));
    let t71 = t13 * t7;
    let t72 = cos_roll * (sin_roll * (sin_psi * t1 - cos_psi * t49) - p.k1 * t18);
    let t73 = cos_roll * t45;
    let t74 = cos_roll * (sin_roll * (cos_psi * t1 + sin_psi * t49) + p.k1 * t22);
    let t75 = t42 + t41 * (p.k2 * t30) + (t42 + t43 * (t10 * t0)) + t70;
    let t76 = cos_roll * (sin_pitch * (p.k0 * t35 - t47 * t46) - t47 * t48) + t7 * t57;
    let t77 = t9 * (t19 + t37) + (t51 * t38 + t8 * t52) - (t61 * t53 - t50 * t62);
    let t78 = t8 * (p.k7 * t16 - cos_roll * (t32 + sin_pitch * t46));
    let t79 = t63 * (t55 - t18) + t7 * t54 + (t52 * t47 + t51 * t35);
    let t80 = cos_roll * (cos_pitch * t68 - t45 * (t3 * t8)) - t12 * t45;
    let t81 = t52 * t56 + t51 * t39 - (t7 * t55 - t63 * (t54 + t22));
    let t82 = cos_roll * (sin_pitch * (p.k0 * t39 - t46 * t56) - t48 * t56) + t7 * t65;
    let t83 = t75 * S::from_f64(2.0) - t43 * (p.k9 * t0);
    let t84 = cos_roll * (sin_pitch * t51 - cos_pitch * t61) - sin_roll * t37;
    let t85 = t45 * (t78 - sin_roll * (sin_roll * t49 + t9 * p.k9));
    let t86 = t85 - (cos_roll * (t13 * t68 - cos_pitch * t59) + t27 * t68);
    let t87 = t84 * (t45 * (t76 - (t72 + t7 * t58)) + (t68 * t67 + t60 * t59));
    let t88 = t86 * (cos_roll * t54 + t51 * t47 - t61 * t60);
    let t89 = t86 * (t61 * t64 + t51 * t56 - cos_roll * t55);
    let t90 = t84 * (t45 * (t7 * t66 - t74 + t82) - (t68 * t69 + t59 * t64));
    let t91 = t45 * (S::from_f64(0.5) * (t83 - t40 * (S::from_f64(0.5) * t29)));
    let t92 = t87 - t77 * (t73 * (t58 - t57) + t60 * t68);
    let t93 = t77 * (t73 * (t66 + t65) + t68 * t64) + t90;
    let gamma1 = (t33 * t9 - t71 - (t71 - pitch_dot * t14)) * p.h + t91;
    let gamma2 = t92 - (t88 - t80 * (t62 * t60 + t61 * t67 + t79));
    let gamma3 = t89 - t80 * (t81 - (t62 * t64 + t61 * t69)) - t93;
    [gamma1, gamma2, gamma3]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass matrix,
/// factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> Result<[S; 6], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 6],
    /// As `accelerations` takes it.
    pub v: &'a [S; 6],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 6], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
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
        let t0 = n(p.k1) * psi_dot;
        let t1 = roll_dot * roll_dot;
        let t2 = cos_pitch * cos_pitch;
        let t3 = sin_pitch * n(p.k0);
        let t4 = sin_roll * n(p.k1);
        let t5 = cos_roll * cos_roll;
        let t6 = cos_roll * cos_pitch;
        let t7 = cos_roll * sin_pitch;
        let t8 = t2 * n(p.k2);
        let t9 = sin_pitch * t3;
        let t10 = sin_roll * t4;
        let t11 = sin_pitch * sin_pitch;
        let t12 = sin_roll * cos_psi;
        let t13 = t7.neg_mul_add(n(p.A), sin_roll * n(p.D));
        let t14 = t8 + t9;
        let t15 = t7.neg_mul_add(n(p.D), sin_roll * n(p.B));
        let t16 = t4 * cos_psi;
        let t17 = sin_pitch * sin_psi;
        let t18 = t5.mul_add(t14, t10);
        let t19 = sin_pitch.mul_add(t12, cos_pitch * sin_psi);
        let t20 = n(p.A).mul_add(t2, n(p.C) * t11);
        let t21 = cos_pitch * n(p.C).mul_add(t7, t13);
        let t22 = sin_roll * sin_psi;
        let t23 = t3 * t19;
        let t24 = sin_pitch.neg_mul_add(t13, t6 * (cos_pitch * n(p.C)));
        let t25 = cos_roll.mul_add(t24, sin_roll * t15);
        let t26 = cos_pitch.mul_sub(t12, t17);
        let t27 = sin_roll * roll_dot;
        let t28 = t6 * pitch_dot;
        let t29 = sin_pitch.neg_mul_add(t22, cos_pitch * cos_psi);
        let t30 = t4 * sin_psi;
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
        let t41 = t27 * (cos_roll * n(p.k9));
        let t42 = sin_pitch * pitch_dot;
        let t43 = cos_psi * t36;
        let t44 = sin_psi * t36;
        let t45 = cos_psi * t39;
        let t46 = sin_roll * psi_dot;
        let t47 = N::ONE / t18.sqrt();
        let t48 = t31 * t21;
        let t49 = t15 * t31;
        let t50 = n(p.k7).mul_sub(t7.mul_sub(t32, t33), t41);
        let t51 = n(p.k8).mul_add(t6.mul_add(t37, t33), t50);
        let t52 = sin_psi * t42;
        let t53 = t21.neg_mul_add(t48, t20);
        let t54 = t21.neg_mul_add(t49, cos_pitch * n(p.D));
        let t55 = N::ONE / t18 * t51;
        let t56 = sin_psi.mul_add(t39, cos_psi * t42);
        let t57 = t22.neg_mul_add(psi_dot, t43);
        let t58 = N::ONE / t53;
        let t59 = t27 * t42;
        let t60 = t27 * t39;
        let t61 = t7 * psi_dot;
        let t62 = t46 + pitch_dot;
        let t63 = psi_dot * t32;
        let t64 = cos_roll * t47;
        let t65 = t6 * roll_dot;
        let t66 = t52 - t45 - sin_pitch.mul_add(t57, t12 * t40);
        let t67 = t11 - t2;
        let t68 = t6 * t59;
        let t69 = t6.neg_mul_add(n(p.k2) * t47, n(p.h));
        let t70 = sin_pitch.mul_add(t12.mul_add(psi_dot, t44), t22 * t40);
        let t71 = t56 + t70;
        let t72 = cos_pitch.mul_sub(roll_dot, t61);
        let t73 = t69.mul_add(t26, t64 * (t16 - t23));
        let t74 = t58 * t54;
        let t75 = t14.neg_mul_add(t64, cos_pitch * n(p.h));
        let t76 = t69.mul_add(t38, t64 * (t30 + t34));
        let t77 = t55 * n(p.k11);
        let t78 = t55 * n(p.k12);
        let t79 = cos_pitch.mul_sub(t69, t47 * (t7 * t3));
        let t80 = cos_roll.mul_sub(t79, t10 * t47);
        let t81 = t54.neg_mul_add(t74, t15.neg_mul_add(t49, n(p.B)));
        let t82 = sin_roll * n(p.k1).mul_add(t64, t75);
        let t83 = t80.neg_mul_add(t26, t6 * t73);
        let t84 = cos_roll * t80;
        let t85 = t80.neg_mul_add(t19, t7 * t73);
        let t86 = N::ONE / t81;
        let t87 = t58 * t82;
        let t88 = t80.neg_mul_add(t38, t6 * t76);
        let t89 = cos_psi.mul_add(t84, sin_roll * t73);
        let t90 = t80.mul_add(t29, t7 * t76);
        let t91 = sin_pitch * cos_roll.mul_add(t69, t64 * (t6 * n(p.k0)));
        let t92 = t54.neg_mul_add(t87, t91);
        let t93 = t55.neg_mul_add(cos_pitch * n(p.k10), n(p.k2) * t42);
        let t94 = sin_psi.mul_add(t84, sin_roll * t76);
        let t95 = cos_psi * t62;
        let t96 = sin_pitch.mul_add(t85, cos_pitch * t83);
        let t97 = cos_roll.mul_add(t96, sin_roll * t89);
        let t98 = sin_psi * t62;
        let t99 = n(p.k0) * t40;
        let t100 = t5 * (pitch_dot * pitch_dot);
        let t101 = t31 * t97;
        let t102 = n(p.k8) * t68;
        let t103 = sin_roll.mul_sub(sin_roll, t5);
        let t104 = n(p.k7) * t68;
        let t105 = t86 * t92;
        let t106 = sin_pitch.mul_sub(t83, cos_pitch * t85);
        let t107 = t21.neg_mul_add(t101, t106);
        let t108 = t6.mul_add(psi_dot, sin_pitch * roll_dot);
        let t109 = t47 * cos_roll.mul_add(t93, n(p.k2) * t37);
        let t110 = roll_dot.mul_sub(t40, t61.mul_add(pitch_dot, t60));
        let t111 = roll_dot.mul_sub(t42, psi_dot.neg_mul_add(t28, t63));
        let t112 = cos_roll * psi_dot;
        let t113 = t92.mul_add(t105, t82.mul_add(t87, n(p.k15)));
        let t114 = t58 * t107;
        let t115 = sin_pitch.mul_add(t90, cos_pitch * t88);
        let t116 = cos_roll.mul_add(t115, sin_roll * t94);
        let t117 = psi_dot * t36;
        let t118 = t108 * t62;
        let t119 = sin_roll.neg_mul_add(t56, cos_psi * t65);
        let t120 = t119 - t35.mul_add(psi_dot, sin_psi * t40);
        let t121 = t19.neg_mul_add(t77, n(p.k0) * t66);
        let t122 = cos_psi.neg_mul_add(t78, sin_psi * t0);
        let t123 = t100.mul_add(n(p.k2) * t67, t102);
        let t124 = t100.mul_add(n(p.k0) * t67, t104);
        let t125 = sin_psi.mul_add(t78, cos_psi * t0);
        let t126 = t29.neg_mul_add(t77, n(p.k0) * t71);
        let t127 = sin_roll.mul_add(t45 - t52, sin_psi * t65);
        let t128 = cos_psi.mul_sub(t40, t17 * psi_dot) + t127;
        let t129 = N::ONE / t113;
        let t130 = t54.neg_mul_add(t114, t15.neg_mul_add(t101, t89));
        let t131 = t31 * t116;
        let t132 = t72.neg_mul_add(pitch_dot, t60);
        let t133 = t108 * t72;
        let t134 = t108.neg_mul_add(pitch_dot, t63);
        let t135 = sin_pitch.mul_add(t77, n(p.k7) * t40);
        let t136 = t112.mul_add(t98 - t43, t27 * t95);
        let t137 = sin_pitch.mul_sub(t121, t19 * t99);
        let t138 = sin_roll.mul_sub(t122, n(p.k1) * t43);
        let t139 = t7.mul_add(t111, t72 * (t32 - t28));
        let t140 = t103.mul_sub(t9 * t1, t104) - t124;
        let t141 = sin_roll.mul_add(t125, n(p.k1) * t44);
        let t142 = sin_pitch.mul_sub(t126, t29 * t99);
        let t143 = t112.neg_mul_add(t95 + t44, t27 * t98);
        let t144 = t86 * t130;
        let t145 = sin_pitch.mul_sub(t88, cos_pitch * t90);
        let t146 = t21.neg_mul_add(t131, t145);
        let t147 = n(p.C).mul_add(t132, t72 * (t62 * n(p.k6)));
        let t148 = n(p.D).neg_mul_add(t72.mul_sub(t72, t62 * t62), t147);
        let t149 = sin_roll * sin_roll.mul_add(t78, t36 * n(p.k9));
        let t150 = cos_roll.neg_mul_add(t135, t32 * n(p.k7));
        let t151 = t69.mul_sub(t42, cos_pitch * t109);
        let t152 = t136 + t19.mul_add(t111, t72 * t66);
        let t153 = cos_roll.mul_add(t138, t16 * t27);
        let t154 = t6.neg_mul_add(t110, t108 * t7.mul_add(pitch_dot, t37));
        let t155 = t36.mul_add(t46 + t62, t139) - t154;
        let t156 = t123 + t103.mul_add(t8 * t1, t102) + t140;
        let t157 = cos_roll.neg_mul_add(t141, t30 * t27);
        let t158 = t29.mul_add(t111, t72 * t71) - t143;
        let t159 = t144.mul_add(t92, t114 * t82);
        let t160 = t58 * t146;
        let t161 = n(p.A).mul_sub(t134, t118 * n(p.k4));
        let t162 = n(p.D).mul_add(t117 - t133, t161);
        let t163 = t133.mul_add(n(p.k5), n(p.B) * t117);
        let t164 = n(p.D).mul_add(t118 + t134, t163);
        let t165 = cos_roll.mul_add(t151, t69 * t37);
        let t166 = t47.mul_sub(t7.mul_sub(t150, t149), t165);
        let t167 = cos_roll.mul_add(t137, t23 * t27) - t153;
        let t168 = sin_pitch.mul_sub(t72, cos_pitch * t108);
        let t169 = cos_roll.mul_sub(t168, sin_roll * t62);
        let t170 = t156.mul_sub(N::from_f64(2.0), t103 * (t1 * n(p.k9)));
        let t171 = t157 + cos_roll.mul_add(t142, t34 * t27);
        let t172 = t130.mul_add(t144, t107 * t114);
        let t173 = t172 + t97.mul_add(t101, n(p.k15));
        let t174 = t129 * t159;
        let t175 = t54.neg_mul_add(t160, t15.neg_mul_add(t131, t94));
        let t176 = t26.neg_mul_add(t108, cos_roll.mul_add(t95, t19 * t72));
        let t177 = t80 * (t108.mul_add(t120, t26 * t110) + t152);
        let t178 = t47.mul_add(t167, t69.mul_add(t120, t26 * t109));
        let t179 = t55.neg_mul_add(N::from_f64(0.5) * t51, t170);
        let t180 = t6.mul_sub(t1, t59) - pitch_dot.neg_mul_add(t28, t59);
        let t181 = t47.mul_sub(t171, t69.mul_add(t128, t38 * t109));
        let t182 = cos_roll.neg_mul_add(t98, t29.mul_add(t72, t38 * t108));
        let t183 = t80 * (t158 - t108.mul_add(t128, t38 * t110));
        let t184 = t159.neg_mul_add(t174, t173);
        let t185 = t86 * t175;
        let t186 = sin_pitch.mul_add(t162, cos_pitch * t148);
        let t187 = cos_roll.mul_sub(t186, sin_roll * t164);
        let t188 = N::ONE / t184;
        let t189 = t185.mul_add(t92, t160 * t82);
        let t190 = sin_pitch.mul_sub(t148, cos_pitch * t162);
        let t191 = t48.neg_mul_add(t187, t190);
        let t192 = t166.mul_sub(t176, t177) - t169.mul_sub(t178, t73 * t155);
        let t193 = t47.mul_add(N::from_f64(0.5) * t179, n(p.h) * t180);
        let t194 = t169.mul_add(t181, t76 * t155) - t166.mul_sub(t182, t183);
        let t195 = t129 * t189;
        let t196 = t74.mul_add(t191, t49.mul_add(t187, t164));
        let t197 = t185.mul_add(t130, t160.mul_add(t107, t131 * t97));
        let t198 = t159.neg_mul_add(t195, t197);
        let t199 = t175.mul_add(t185, t146 * t160);
        let t200 = t199 + t116.mul_add(t131, n(p.k15));
        let t201 = t114.mul_add(t191, t101.mul_add(t187, t192));
        let t202 = t105.neg_mul_add(t196, t87.mul_add(t191, n(p.g) + t193));
        let t203 = t160.mul_add(t191, t131.mul_add(t187, t194));
        let t204 = t188 * t198;
        let t205 = t174.neg_mul_add(t202, t144.neg_mul_add(t196, t201));
        let t206 = t198.neg_mul_add(t204, t189.neg_mul_add(t195, t200));
        let t207 = t195.neg_mul_add(t202, t185.neg_mul_add(t196, t203));
        let t208 = t204.neg_mul_add(t205, t207) / t206;
        let t209 = t204.neg_mul_add(t208, t188 * t205);
        let t210 = t195.neg_mul_add(t208, t129 * t202);
        let t211 = t174.neg_mul_add(t209, t210);
        let t212 = t144.mul_add(t209, t185.mul_add(t208, t86 * t196));
        let t213 = t105.mul_add(t211, t212);
        let t214 = t114.neg_mul_add(t209, t160.neg_mul_add(t208, t58 * t191));
        let roll_ddot = t74.mul_add(t213, t87.neg_mul_add(t211, t214));
        let t215 = t101.neg_mul_add(t209, t131.neg_mul_add(t208, t31 * t187));
        let x_ddot = -(n(p.k15) * t209);
        let y_ddot = -(n(p.k15) * t208);
        let z_ddot = n(p.k15).mul_sub(t211, n(p.g));
        let psi_ddot = t48.neg_mul_add(roll_ddot, t49.mul_add(t213, t215));
        let pitch_ddot = -t213;
        let sound = PIVOTS.hold(t25, t25)
            & PIVOTS.hold(t53, t20)
            & PIVOTS.hold(t81, n(p.B))
            & PIVOTS.hold(t113, t113)
            & PIVOTS.hold(t184, t173)
            & PIVOTS.hold(t206, t200)
            & psi_ddot.is_finite();
        if !sound {
            let pivots = [
                (3, t25, t25),
                (4, t53, t20),
                (5, t81, n(p.B)),
                (6, t113, t113),
                (7, t184, t173),
                (8, t206, t200),
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
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 6],
    /// As `multipliers` takes it.
    pub v: &'a [S; 6],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 3], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
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
        let t3 = t2 * n(p.k2);
        let t4 = t0.neg_mul_add(n(p.D), sin_roll * n(p.B));
        let t5 = t0.neg_mul_add(n(p.A), sin_roll * n(p.D));
        let t6 = sin_pitch * (sin_pitch * n(p.C));
        let t7 = cos_pitch.mul_add(cos_pitch * n(p.A), t6);
        let t8 = sin_roll * cos_psi;
        let t9 = cos_pitch.mul_add(t5, t0 * (cos_pitch * n(p.C)));
        let t10 = sin_roll * roll_dot;
        let t11 = t2 * pitch_dot;
        let t12 = t2.mul_add(t3, t0.mul_add(t0 * n(p.k0), t1 * n(p.k1)));
        let t13 = cos_pitch.mul_sub(t8, sin_pitch * sin_psi);
        let t14 = sin_pitch.mul_add(t8, cos_pitch * sin_psi);
        let t15 = sin_roll * sin_psi;
        let t16 = sin_pitch * t10;
        let t17 = t0 * t11;
        let t18 = t10 * n(p.k9);
        let t19 = t0.neg_mul_add(t5, t2.mul_add(t2 * n(p.C), sin_roll * t4));
        let t20 = cos_pitch.mul_add(t15, sin_pitch * cos_psi);
        let t21 = cos_pitch * t10;
        let t22 = N::ONE / t19;
        let t23 = sin_pitch.neg_mul_add(t15, cos_pitch * cos_psi);
        let t24 = cos_pitch * pitch_dot;
        let t25 = sin_pitch * psi_dot;
        let t26 = t0 * pitch_dot;
        let t27 = cos_pitch * psi_dot;
        let t28 = sin_pitch * pitch_dot;
        let t29 = cos_roll * roll_dot;
        let t30 = n(p.k7).mul_sub(t0.mul_sub(t16, t17), cos_roll * t18);
        let t31 = n(p.k8).mul_add(t2.mul_add(t21, t17), t30);
        let t32 = t21 * t26;
        let t33 = t0 * roll_dot;
        let t34 = N::ONE / t12 * t31;
        let t35 = t0.neg_mul_add(psi_dot, cos_pitch * roll_dot);
        let t36 = sin_roll.mul_add(psi_dot, pitch_dot);
        let t37 = N::ONE / t12.sqrt();
        let t38 = t22 * t9;
        let t39 = t4 * t22;
        let t40 = psi_dot * t16;
        let t41 = t26 * t26;
        let t42 = n(p.k2) * t21;
        let t43 = t2 * roll_dot;
        let t44 = t9.neg_mul_add(t38, t7);
        let t45 = t9.neg_mul_add(t39, cos_pitch * n(p.D));
        let t46 = n(p.k7) * t32;
        let t47 = t34 * n(p.k12);
        let t48 = N::ONE / t44;
        let t49 = cos_roll * psi_dot;
        let t50 = cos_psi * t29;
        let t51 = sin_psi * t29;
        let t52 = cos_roll * t37;
        let t53 = t3 * t37;
        let t54 = n(p.k1) * t37;
        let t55 = t0 * t37;
        let t56 = n(p.k0) * t37;
        let t57 = psi_dot * t21;
        let t58 = t2.mul_add(psi_dot, sin_pitch * roll_dot);
        let t59 = n(p.k8) * t32;
        let t60 = n(p.k1) * t52;
        let t61 = n(p.h) - t53;
        let t62 = n(p.k0) * t55;
        let t63 = t11 * t11;
        let t64 = t60 * t8;
        let t65 = t48 * t45;
        let t66 = cos_pitch.neg_mul_add(t53, cos_pitch * n(p.h));
        let t67 = t15 * t60;
        let t68 = t45.neg_mul_add(t65, t4.neg_mul_add(t39, n(p.B)));
        let t69 = t0.neg_mul_add(t62, t2.mul_sub(t61, t1 * t54));
        let t70 = sin_pitch.neg_mul_add(t62, t66);
        let t71 = sin_roll.mul_add(t70, sin_roll * t60);
        let t72 = sin_pitch * t3.neg_mul_add(t52, cos_roll * n(p.h));
        let t73 = t62.neg_mul_add(t14, t61.mul_add(t13, t64));
        let t74 = N::ONE / t68;
        let t75 = cos_roll * t69;
        let t76 = t67 + t62.mul_add(t23, t61 * t20);
        let t77 = t48 * t71;
        let t78 = t2.mul_sub(t73, t69 * t13);
        let t79 = t0.mul_sub(t73, t69 * t14);
        let t80 = t2.mul_sub(t76, t69 * t20);
        let t81 = t45.neg_mul_add(t77, t2.mul_add(t62, t72));
        let t82 = t0.mul_add(t76, t69 * t23);
        let t83 = t55 * n(p.k7);
        let t84 = sin_roll.mul_add(t73, cos_psi * t75);
        let t85 = cos_psi * t36;
        let t86 = cos_psi.mul_add(t33, t8.mul_sub(t24, t15 * t25));
        let t87 = sin_psi.mul_sub(t28, cos_psi * t27) - t86;
        let t88 = sin_psi * t36;
        let t89 = t14 * t56;
        let t90 = sin_roll.mul_add(t84, t0.mul_add(t79, t2 * t78));
        let t91 = t52 * t47;
        let t92 = sin_psi.mul_add(t33, t8.mul_add(t25, t15 * t24));
        let t93 = t92 + sin_psi.mul_add(t27, cos_psi * t28);
        let t94 = t23 * t56;
        let t95 = t22 * t90;
        let t96 = t74 * t81;
        let t97 = sin_psi.mul_add(t75, sin_roll * t76);
        let t98 = sin_pitch.mul_sub(t78, cos_pitch * t79);
        let t99 = t9.neg_mul_add(t95, t98);
        let t100 = roll_dot * t43;
        let t101 = t16.mul_sub(n(p.k0) * t16, t46);
        let t102 = t37 * t34;
        let t103 = t34 * (t55 * n(p.k11));
        let t104 = cos_psi.mul_sub(t43, t15.mul_add(t27, t8 * t28));
        let t105 = t104 - cos_psi.mul_add(t25, sin_psi * t24);
        let t106 = roll_dot.mul_sub(t28, psi_dot.neg_mul_add(t11, t40));
        let t107 = t54 * t10;
        let t108 = sin_psi.mul_add(t43, t8.mul_sub(t27, t15 * t28));
        let t109 = cos_psi.mul_sub(t24, sin_psi * t25) + t108;
        let t110 = t81.mul_add(t96, t71.mul_add(t77, n(p.k15)));
        let t111 = t48 * t99;
        let t112 = sin_roll.mul_add(t97, t0.mul_add(t82, t2 * t80));
        let t113 = t58 * t36;
        let t114 = n(p.k0).neg_mul_add(t63, n(p.k0).mul_add(t41, t46));
        let t115 = t55.mul_add(n(p.k2) * pitch_dot, t37 * t42);
        let t116 = t102.neg_mul_add(t2 * n(p.k10), t115);
        let t117 = roll_dot.mul_sub(t24, psi_dot.mul_add(t26, t57));
        let t118 = N::ONE / t110;
        let t119 = t45.neg_mul_add(t111, t4.neg_mul_add(t95, t84));
        let t120 = t22 * t112;
        let t121 = t35.neg_mul_add(pitch_dot, t57);
        let t122 = t58 * t35;
        let t123 = psi_dot * t29;
        let t124 = t58.neg_mul_add(pitch_dot, t40);
        let t125 = n(p.k2).neg_mul_add(t63, n(p.k2).mul_add(t41, t59));
        let t126 = t33.neg_mul_add(n(p.k0) * t33, t101) - t114;
        let t127 = n(p.k9) * t10.mul_sub(t10, t29 * t29);
        let t128 = pitch_dot * t16;
        let t129 = t49.mul_add(t88, t10.mul_sub(t85, t49 * t50));
        let t130 = t0.mul_add(t106, t35.mul_sub(t16, t35 * t11));
        let t131 = t64.mul_add(psi_dot, t15 * t91);
        let t132 = t49.neg_mul_add(t85, t10.mul_sub(t88, t49 * t51));
        let t133 = t74 * t119;
        let t134 = sin_pitch.mul_sub(t80, cos_pitch * t82);
        let t135 = t9.neg_mul_add(t120, t134);
        let t136 = n(p.C).mul_add(t121, t35 * (t36 * n(p.k6)));
        let t137 = n(p.D).neg_mul_add(t35.mul_sub(t35, t36 * t36), t136);
        let t138 = t125 + t3.neg_mul_add(t100, t21.mul_add(t42, t59));
        let t139 = N::from_f64(2.0).mul_sub(t126, t127);
        let t140 = t0.neg_mul_add(t103, t16.mul_sub(t83, t11 * t83));
        let t141 = t129 + t14.mul_add(t106, t35 * t87);
        let t142 = t62.mul_add(t87, t16 * t89) - t14.mul_add(t103, t11 * t89);
        let t143 = t67.mul_sub(psi_dot, t8 * t91);
        let t144 = t2.neg_mul_add(t117, t58.mul_add(t26, t58 * t21));
        let t145 = t10.mul_add(t49, t29 * t36) + t130 - t144;
        let t146 = t62.mul_add(t93, t16 * t94) - t23.mul_add(t103, t11 * t94);
        let t147 = t23.mul_add(t106, t35 * t93) - t132;
        let t148 = t133.mul_add(t81, t111 * t71);
        let t149 = t48 * t135;
        let t150 = n(p.A).mul_sub(t124, t113 * n(p.k4));
        let t151 = n(p.D).mul_add(t123 - t122, t150);
        let t152 = t2.neg_mul_add(t116, t61.mul_add(t26, t61 * t21));
        let t153 = t140 - t52.mul_add(t18, t37 * (t1 * t47)) - t152;
        let t154 = t13.mul_add(t116, t61 * t105) + t142;
        let t155 = t2.neg_mul_add(t58, t0.mul_sub(t35, sin_roll * t36));
        let t156 = t15.mul_sub(t107, t60 * t51) - t131 + t146;
        let t157 = t119.mul_add(t133, t99 * t111);
        let t158 = t157 + t90.mul_add(t95, n(p.k15));
        let t159 = t118 * t148;
        let t160 = t45.neg_mul_add(t149, t4.neg_mul_add(t120, t97));
        let t161 = t122.mul_add(n(p.k5), n(p.B) * t123);
        let t162 = n(p.D).mul_add(t113 + t124, t161);
        let t163 = t37 * N::from_f64(2.0).mul_add(t138, t139);
        let t164 = t13.neg_mul_add(t58, cos_roll.mul_add(t85, t14 * t35));
        let t165 = t69 * (t13.mul_add(t117, t58 * t105) + t141);
        let t166 = t154 - (t8.mul_sub(t107, t60 * t50) + t143);
        let t167 = t156 - t20.mul_add(t116, t61 * t109);
        let t168 = cos_roll.neg_mul_add(t88, t20.mul_add(t58, t23 * t35));
        let t169 = t69 * (t147 - t20.mul_add(t117, t58 * t109));
        let t170 = t148.neg_mul_add(t159, t158);
        let t171 = t74 * t160;
        let t172 = sin_roll.neg_mul_add(t162, t0.mul_add(t151, t2 * t137));
        let t173 = n(p.h) * (t100 - t128 - pitch_dot.neg_mul_add(t11, t128));
        let t174 = t102.neg_mul_add(N::from_f64(0.5) * t31, t163);
        let t175 = N::ONE / t170;
        let t176 = t171.mul_add(t81, t149 * t71);
        let t177 = sin_pitch.mul_sub(t137, cos_pitch * t151);
        let t178 = t38.neg_mul_add(t172, t177);
        let t179 = t153.mul_sub(t164, t165) - t155.mul_sub(t166, t73 * t145);
        let t180 = t155.mul_add(t167, t76 * t145) - t153.mul_sub(t168, t169);
        let t181 = t118 * t176;
        let t182 = t65.mul_add(t178, t39.mul_add(t172, t162));
        let t183 = N::from_f64(0.5).mul_add(t174, t173) + n(p.g);
        let t184 = t171.mul_add(t119, t149.mul_add(t99, t120 * t90));
        let t185 = t148.neg_mul_add(t181, t184);
        let t186 = t96.neg_mul_add(t182, t77.mul_add(t178, t183));
        let t187 = t111.mul_add(t178, t95.mul_add(t172, t179));
        let t188 = t149.mul_add(t178, t120.mul_add(t172, t180));
        let t189 = t160.mul_add(t171, t135 * t149);
        let t190 = t189 + t112.mul_add(t120, n(p.k15));
        let t191 = t175 * t185;
        let t192 = t159.neg_mul_add(t186, t133.neg_mul_add(t182, t187));
        let t193 = t175 * t192;
        let t194 = t181.neg_mul_add(t186, t171.neg_mul_add(t182, t188));
        let t195 = t185.neg_mul_add(t191, t176.neg_mul_add(t181, t190));
        let t196 = t191.neg_mul_add(t192, t194) / t195;
        let t197 = t191 * t196;
        let t198 = t181.neg_mul_add(t196, t118 * t186);
        let lambda1 = t159.neg_mul_add(t193 - t197, t198);
        let lambda2 = t197 - t193;
        let lambda3 = -t196;
        let sound = PIVOTS.hold(t19, t19)
            & PIVOTS.hold(t44, t7)
            & PIVOTS.hold(t68, n(p.B))
            & PIVOTS.hold(t110, t110)
            & PIVOTS.hold(t170, t158)
            & PIVOTS.hold(t195, t190)
            & lambda1.is_finite();
        if !sound {
            let pivots = [
                (3, t19, t19),
                (4, t44, t7),
                (5, t68, n(p.B)),
                (6, t110, t110),
                (7, t170, t158),
                (8, t195, t190),
            ];
            PIVOTS.check(pivots)?;
        }
        let multipliers = [lambda1.store(), lambda2.store(), lambda3.store()];
        Ok(multipliers)
    }
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
    p.k3 * z
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
    inputs Inputs {} []
    outputs Outputs {} []
    prepared Prepared {
        m, h, A, B, C, D, g, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15,
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
