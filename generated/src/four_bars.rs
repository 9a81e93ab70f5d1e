// @generated from machines/four_bars.machine by `cargo xtask generate`; edits are lost.

//! N four-bar linkages in a row, all bars equal: N + 1 cranks on ground, joined by N
//! couplers. While
//! the couplers stay level it is a pendulum. Where the cranks lie level too, the constraints
//! depend on
//! each other, and every window could as well leave the parallelogram.
//!
//! 5 coordinates, 4 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 16 | 4 | 1 | 0 | 0 | 21 |
//! | `start` | 1 | 1 | 1 | 0 | 0 | 3 |
//! | `mass_matrix` | 6 | 2 | 0 | 4 | 0 | 16 |
//! | `bias` | 16 | 2 | 0 | 4 | 0 | 26 |
//! | `applied` | 5 | 0 | 0 | 5 | 0 | 10 |
//! | `forces` | 25 | 8 | 0 | 5 | 0 | 42 |
//! | `constraint_positions` | 4 | 10 | 0 | 5 | 0 | 24 |
//! | `constraint_rates` | 14 | 8 | 0 | 5 | 0 | 32 |
//! | `constraint_matrix` | 12 | 0 | 0 | 5 | 0 | 22 |
//! | `constraint_bias` | 19 | 8 | 0 | 5 | 0 | 37 |
//! | `accelerations` | 158 | 86 | 6 | 5 | 0 | 260 |
//! | `multipliers` | 139 | 70 | 6 | 5 | 0 | 225 |
//! | `projection` | 162 | 98 | 6 | 5 | 0 | 276 |
//! | `kinetic_energy` | 27 | 12 | 0 | 4 | 0 | 47 |
//! | `potential_energy` | 6 | 6 | 0 | 5 | 0 | 17 |
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

/// N four-bar linkages in a row, all bars equal: N + 1 cranks on ground, joined by N
/// couplers. While
/// the couplers stay level it is a pendulum. Where the cranks lie level too, the constraints
/// depend on
/// each other, and every window could as well leave the parallelogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBars<S = f64> {
    /// Length and mass of a bar. Unit: `m`. Default: 1.
    pub l: S,
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
    /// Speed of the tops when the run starts. Unit: `m/s`. Default: 1.
    pub v0: S,
}

impl<S: ::lagrangian::emitted::Scalar> FourBars<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let t1 = self.l * t0;
        let t2 = t0 * self.g;
        let t3 = S::ONE / (self.m * (self.l * self.l));
        let half_l_squared_m = S::from_f64(0.5) * t1;
        let k2 = t1 * S::from_ratio(4, 3);
        let k3 = t1 * S::from_ratio(1, 3);
        let half_l = self.l * S::from_f64(0.5);
        let k0 = t1 * S::from_ratio(1, 12);
        let m_g = self.m * self.g;
        let k1 = t1 * S::from_ratio(1, 6);
        let minus_l = -self.l;
        let minus_half_l_squared_m = -half_l_squared_m;
        let k4 = -(t2 * S::from_f64(1.5));
        let minus_half_l_m_g = -(S::from_f64(0.5) * t2);
        let k5 = t3 * S::from_f64(3.0);
        let k6 = t3 * S::from_f64(0.75);
        let pivots = [(2, k3, k3), (0, k2, k2), (4, k3, k3)];
        Prepared {
            l: self.l,
            m: self.m,
            half_l,
            k0,
            m_g,
            k1,
            half_l_squared_m,
            k2,
            k3,
            minus_l,
            minus_half_l_squared_m,
            k4,
            minus_half_l_m_g,
            k5,
            k6,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let crank_0 = S::pi() * S::from_f64(0.5);
        let crank_0_rate = -(self.v0 / self.l);
        let zero = S::ZERO;
        let q = [crank_0, crank_0, crank_0, zero, zero];
        let v = [crank_0_rate, crank_0_rate, crank_0_rate, zero, zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`FourBars`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `crank`. Unit: `rad`. Members: `crank[0]` to `crank[2]`.
    pub crank: [S; 3],
    /// `coupler`. Unit: `rad`. Members: `coupler[1]` to `coupler[2]`.
    pub coupler: [S; 2],
}

/// The parameters of a [`FourBars`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `m`
    m: S,
    /// `0.5*l`
    half_l: S,
    /// `(1/12)*l^2*m`
    k0: S,
    /// `m*g`
    m_g: S,
    /// `(1/6)*l^2*m`
    k1: S,
    /// `0.5*l^2*m`
    half_l_squared_m: S,
    /// `(4/3)*l^2*m`
    k2: S,
    /// `(1/3)*l^2*m`
    k3: S,
    /// `-l`
    minus_l: S,
    /// `-0.5*l^2*m`
    minus_half_l_squared_m: S,
    /// `-1.5*l*m*g`
    k4: S,
    /// `-0.5*l*m*g`
    minus_half_l_m_g: S,
    /// `3/l^2/m`
    k5: S,
    /// `0.75/l^2/m`
    k6: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(5, 9);

/// Mass matrix `M`.
///
/// ```text
/// M[crank[0], crank[0]] = 4/3*l^2*m
/// M[crank[1], crank[1]] = 4/3*l^2*m
/// M[crank[2], crank[2]] = 1/3*l^2*m
/// M[coupler[1], crank[0]] = 1/2*l^2*m*cos(coupler[1] - crank[0])
/// M[coupler[1], coupler[1]] = 1/3*l^2*m
/// M[coupler[2], crank[1]] = 1/2*l^2*m*cos(coupler[2] - crank[1])
/// M[coupler[2], coupler[2]] = 1/3*l^2*m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let t0 = sin_coupler_1 * sin_crank_0 + cos_coupler_1 * cos_crank_0;
    let t1 = sin_coupler_2 * sin_crank_1 + cos_coupler_2 * cos_crank_1;
    let zero = S::ZERO;
    let m41 = p.half_l_squared_m * t0;
    let m52 = p.half_l_squared_m * t1;
    [
        [p.k2, zero, zero, m41, zero],
        [zero, p.k2, zero, zero, m52],
        [zero, zero, p.k3, zero, zero],
        [m41, zero, zero, p.k3, zero],
        [zero, m52, zero, zero, p.k3],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[crank[0]] = -1/2*l^2*m*sin(coupler[1] - crank[0])*der(coupler[1])^2
/// h[crank[1]] = -1/2*l^2*m*sin(coupler[2] - crank[1])*der(coupler[2])^2
/// h[coupler[1]] = 1/2*l^2*m*sin(coupler[1] - crank[0])*der(crank[0])^2
/// h[coupler[2]] = 1/2*l^2*m*sin(coupler[2] - crank[1])*der(crank[1])^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let crank_0_dot = v[0];
    let crank_1_dot = v[1];
    let coupler_1_dot = v[3];
    let coupler_2_dot = v[4];
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let t0 = sin_coupler_1 * cos_crank_0 - cos_coupler_1 * sin_crank_0;
    let t1 = sin_coupler_2 * cos_crank_1 - cos_coupler_2 * sin_crank_1;
    let h_crank_0 = t0 * (coupler_1_dot * (p.minus_half_l_squared_m * coupler_1_dot));
    let h_crank_1 = t1 * (coupler_2_dot * (p.minus_half_l_squared_m * coupler_2_dot));
    let zero = S::ZERO;
    let h_coupler_1 = t0 * (crank_0_dot * (p.half_l_squared_m * crank_0_dot));
    let h_coupler_2 = t1 * (crank_1_dot * (p.half_l_squared_m * crank_1_dot));
    [h_crank_0, h_crank_1, zero, h_coupler_1, h_coupler_2]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[crank[0]] = -3/2*l*m*g*cos(crank[0])
/// Q[crank[1]] = -3/2*l*m*g*cos(crank[1])
/// Q[crank[2]] = -1/2*l*m*g*cos(crank[2])
/// Q[coupler[1]] = -1/2*l*m*g*cos(coupler[1])
/// Q[coupler[2]] = -1/2*l*m*g*cos(coupler[2])
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let cos_crank_0 = crank_0.cos();
    let cos_crank_1 = crank_1.cos();
    let cos_crank_2 = crank_2.cos();
    let cos_coupler_1 = coupler_1.cos();
    let cos_coupler_2 = coupler_2.cos();
    let q_crank_0 = p.k4 * cos_crank_0;
    let q_crank_1 = p.k4 * cos_crank_1;
    let q_crank_2 = p.minus_half_l_m_g * cos_crank_2;
    let q_coupler_1 = p.minus_half_l_m_g * cos_coupler_1;
    let q_coupler_2 = p.minus_half_l_m_g * cos_coupler_2;
    [q_crank_0, q_crank_1, q_crank_2, q_coupler_1, q_coupler_2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let crank_0_dot = v[0];
    let crank_1_dot = v[1];
    let coupler_1_dot = v[3];
    let coupler_2_dot = v[4];
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let cos_crank_2 = crank_2.cos();
    let t0 = coupler_1_dot * coupler_1_dot;
    let t1 = coupler_2_dot * coupler_2_dot;
    let t2 = crank_0_dot * crank_0_dot;
    let t3 = crank_1_dot * crank_1_dot;
    let t4 = sin_coupler_1 * (cos_crank_0 * p.half_l_squared_m);
    let t5 = cos_coupler_1 * (sin_crank_0 * p.half_l_squared_m);
    let t6 = sin_coupler_2 * (cos_crank_1 * p.half_l_squared_m);
    let t7 = cos_coupler_2 * (sin_crank_1 * p.half_l_squared_m);
    let f_crank_0 = t0 * t4 - (t0 * t5 - cos_crank_0 * p.k4);
    let f_crank_1 = t1 * t6 - (t1 * t7 - cos_crank_1 * p.k4);
    let f_crank_2 = cos_crank_2 * p.minus_half_l_m_g;
    let f_coupler_1 = t2 * t5 - (t2 * t4 - cos_coupler_1 * p.minus_half_l_m_g);
    let f_coupler_2 = t3 * t7 - (t3 * t6 - cos_coupler_2 * p.minus_half_l_m_g);
    [f_crank_0, f_crank_1, f_crank_2, f_coupler_1, f_coupler_2]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along[1]] = l*(cos(crank[0]) - cos(crank[1]) + cos(coupler[1]) - 1)
/// g[along[2]] = l*(cos(crank[1]) - cos(crank[2]) + cos(coupler[2]) - 1)
/// g[across[1]] = l*(sin(crank[0]) - sin(crank[1]) + sin(coupler[1]))
/// g[across[2]] = l*(sin(crank[1]) - sin(crank[2]) + sin(coupler[2]))
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
) -> [S; 4] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_crank_2, cos_crank_2) = crank_2.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let g1 = p.minus_l * (cos_crank_1 + S::ONE - (cos_coupler_1 + cos_crank_0));
    let g2 = p.minus_l * (S::ONE + cos_crank_2 - (cos_crank_1 + cos_coupler_2));
    let g3 = p.l * (sin_coupler_1 + sin_crank_0 - sin_crank_1);
    let g4 = p.l * (sin_crank_1 + sin_coupler_2 - sin_crank_2);
    [g1, g2, g3, g4]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along[1]] = l*(sin(crank[1])*der(crank[1]) - sin(crank[0])*der(crank[0]) -
///     sin(coupler[1])*der(coupler[1]))
/// phi[along[2]] = l*(sin(crank[2])*der(crank[2]) - sin(crank[1])*der(crank[1]) -
///     sin(coupler[2])*der(coupler[2]))
/// phi[across[1]] = l*(cos(crank[0])*der(crank[0]) - cos(crank[1])*der(crank[1]) +
///     cos(coupler[1])*der(coupler[1]))
/// phi[across[2]] = l*(cos(crank[1])*der(crank[1]) - cos(crank[2])*der(crank[2]) +
///     cos(coupler[2])*der(coupler[2]))
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 4] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let crank_0_dot = v[0];
    let crank_1_dot = v[1];
    let crank_2_dot = v[2];
    let coupler_1_dot = v[3];
    let coupler_2_dot = v[4];
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let (sin_crank_2, cos_crank_2) = crank_2.sin_cos();
    let t0 = crank_1_dot * sin_crank_1;
    let t1 = crank_1_dot * cos_crank_1;
    let t2 = coupler_1_dot * sin_coupler_1 + crank_0_dot * sin_crank_0 - t0;
    let t3 = t0 + coupler_2_dot * sin_coupler_2 - crank_2_dot * sin_crank_2;
    let phi1 = p.minus_l * t2;
    let phi2 = p.minus_l * t3;
    let phi3 = p.l * (coupler_1_dot * cos_coupler_1 + crank_0_dot * cos_crank_0 - t1);
    let phi4 = p.l * (t1 + coupler_2_dot * cos_coupler_2 - crank_2_dot * cos_crank_2);
    [phi1, phi2, phi3, phi4]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along[1], crank[0]] = -l*sin(crank[0])
/// G[along[1], crank[1]] = l*sin(crank[1])
/// G[along[1], coupler[1]] = -l*sin(coupler[1])
/// G[along[2], crank[1]] = -l*sin(crank[1])
/// G[along[2], crank[2]] = l*sin(crank[2])
/// G[along[2], coupler[2]] = -l*sin(coupler[2])
/// G[across[1], crank[0]] = l*cos(crank[0])
/// G[across[1], crank[1]] = -l*cos(crank[1])
/// G[across[1], coupler[1]] = l*cos(coupler[1])
/// G[across[2], crank[1]] = l*cos(crank[1])
/// G[across[2], crank[2]] = -l*cos(crank[2])
/// G[across[2], coupler[2]] = l*cos(coupler[2])
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 20] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_crank_2, cos_crank_2) = crank_2.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let g1_1 = p.minus_l * sin_crank_0;
    let g1_2 = sin_crank_1 * p.l;
    let zero = S::ZERO;
    let g1_4 = p.minus_l * sin_coupler_1;
    let g2_2 = p.minus_l * sin_crank_1;
    let g2_3 = p.l * sin_crank_2;
    let g2_5 = p.minus_l * sin_coupler_2;
    let g3_1 = cos_crank_0 * p.l;
    let g3_2 = p.minus_l * cos_crank_1;
    let g3_4 = p.l * cos_coupler_1;
    let g4_2 = cos_crank_1 * p.l;
    let g4_3 = p.minus_l * cos_crank_2;
    let g4_5 = p.l * cos_coupler_2;
    [
        g1_1, g1_2, zero, g1_4, zero, zero, g2_2, g2_3, zero, g2_5, g3_1, g3_2, zero, g3_4, zero,
        zero, g4_2, g4_3, zero, g4_5,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along[1]] = -l*(cos(crank[1])*der(crank[1])^2 - cos(crank[0])*der(crank[0])^2 -
///     cos(coupler[1])*der(coupler[1])^2)
/// gamma[along[2]] = -l*(cos(crank[2])*der(crank[2])^2 - cos(crank[1])*der(crank[1])^2 -
///     cos(coupler[2])*der(coupler[2])^2)
/// gamma[across[1]] = -l*(sin(crank[1])*der(crank[1])^2 - sin(crank[0])*der(crank[0])^2 -
///     sin(coupler[1])*der(coupler[1])^2)
/// gamma[across[2]] = -l*(sin(crank[2])*der(crank[2])^2 - sin(crank[1])*der(crank[1])^2 -
///     sin(coupler[2])*der(coupler[2])^2)
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 4] {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let crank_0_dot = v[0];
    let crank_1_dot = v[1];
    let crank_2_dot = v[2];
    let coupler_1_dot = v[3];
    let coupler_2_dot = v[4];
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let (sin_crank_2, cos_crank_2) = crank_2.sin_cos();
    let t0 = crank_0_dot * crank_0_dot;
    let t1 = crank_1_dot * crank_1_dot;
    let t2 = coupler_1_dot * coupler_1_dot;
    let t3 = coupler_2_dot * coupler_2_dot;
    let t4 = crank_2_dot * crank_2_dot;
    let t5 = t1 * cos_crank_1;
    let t6 = t1 * sin_crank_1;
    let gamma1 = p.l * (t2 * cos_coupler_1 + t0 * cos_crank_0 - t5);
    let gamma2 = p.l * (t5 + t3 * cos_coupler_2 - t4 * cos_crank_2);
    let gamma3 = p.l * (t2 * sin_coupler_1 + t0 * sin_crank_0 - t6);
    let gamma4 = p.l * (t6 + t3 * sin_coupler_2 - t4 * sin_crank_2);
    [gamma1, gamma2, gamma3, gamma4]
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 5], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let crank_0 = n(q[0]);
    let crank_1 = n(q[1]);
    let crank_2 = n(q[2]);
    let coupler_1 = n(q[3]);
    let coupler_2 = n(q[4]);
    let crank_0_dot = n(v[0]);
    let crank_1_dot = n(v[1]);
    let crank_2_dot = n(v[2]);
    let coupler_1_dot = n(v[3]);
    let coupler_2_dot = n(v[4]);
    let angles = [coupler_1, crank_0, coupler_2, crank_1, crank_2];
    let circular = N::sin_cos_all(angles);
    let (sin_coupler_1, cos_coupler_1) = circular[0];
    let (sin_crank_0, cos_crank_0) = circular[1];
    let (sin_coupler_2, cos_coupler_2) = circular[2];
    let (sin_crank_1, cos_crank_1) = circular[3];
    let (sin_crank_2, cos_crank_2) = circular[4];
    let t0 = crank_0_dot * crank_0_dot;
    let t1 = crank_1_dot * crank_1_dot;
    let t2 = coupler_1_dot * coupler_1_dot;
    let t3 = coupler_2_dot * coupler_2_dot;
    let t4 = crank_2_dot * crank_2_dot;
    let t5 = cos_crank_0 * n(p.l);
    let t6 = sin_crank_0 * n(p.l);
    let t7 = sin_crank_1 * n(p.l);
    let t8 = sin_coupler_2 * n(p.l);
    let t9 = sin_coupler_1 * sin_crank_0;
    let t10 = sin_crank_2 * n(p.l);
    let t11 = sin_coupler_2 * sin_crank_1;
    // Eliminates crank[0] from row across[1]: l[across[1], crank[0]].
    let t12 = t5 * n(p.k6);
    // Eliminates crank[0] from row along[1]: l[along[1], crank[0]].
    let t13 = t6 * n(p.k6);
    let t14 = cos_crank_1 * n(p.l);
    // Eliminates coupler[2] from row along[2]: l[along[2], coupler[2]].
    let t15 = t8 * n(p.k5);
    let t16 = cos_coupler_2 * n(p.l);
    let t17 = cos_coupler_1.mul_add(cos_crank_0, t9);
    let t18 = n(p.half_l_squared_m) * t17;
    // Eliminates crank[2] from row along[2]: l[along[2], crank[2]].
    let t19 = t10 * n(p.k5);
    let t20 = cos_coupler_2.mul_add(cos_crank_1, t11);
    let t21 = n(p.half_l_squared_m) * t20;
    // Eliminates coupler[2] from row across[2]: l[across[2], coupler[2]].
    let t22 = n(p.k5) * t16;
    let t23 = cos_crank_2 * n(p.l);
    // Eliminates crank[0] from row coupler[1]: l[coupler[1], crank[0]].
    let t24 = n(p.k6) * t18;
    let t25 = t13.neg_mul_add(t18, sin_coupler_1 * n(p.l));
    // Eliminates coupler[2] from row crank[1]: l[crank[1], coupler[2]].
    let t26 = n(p.k5) * t21;
    let t27 = t15.neg_mul_add(t21, t7);
    let t28 = t12.neg_mul_add(t18, cos_coupler_1 * n(p.l));
    // Row coupler[1]: pivot d[coupler[1]].
    let t29 = t18.neg_mul_add(t24, n(p.k3));
    // Row crank[1]: pivot d[crank[1]].
    let t30 = t21.neg_mul_add(t26, n(p.k2));
    let t31 = t21.neg_mul_add(t22, t14);
    // Eliminates crank[2] from row across[2]: l[across[2], crank[2]].
    let t32 = n(p.k5) * t23;
    let t33 = N::ONE / t29;
    let t34 = N::ONE / t30;
    let t35 = cos_crank_1 * t1;
    let t36 = sin_coupler_1 * cos_crank_0;
    let t37 = cos_coupler_1.mul_sub(sin_crank_0, t36);
    let t38 = sin_crank_1 * t1;
    let t39 = cos_coupler_2 * sin_crank_1;
    let t40 = sin_coupler_2.mul_sub(cos_crank_1, t39);
    let t41 = t2 * n(p.half_l_squared_m);
    let t42 = t41.mul_sub(t37, cos_crank_0 * n(p.k4));
    let t43 = cos_crank_2 * n(p.minus_half_l_m_g);
    let t44 = cos_coupler_2 * n(p.minus_half_l_m_g);
    let t45 = (t1 * n(p.half_l_squared_m)).mul_sub(t40, t44);
    let t46 = t3 * n(p.half_l_squared_m);
    // Eliminates coupler[1] from row along[1]: l[along[1], coupler[1]].
    let t47 = t25 * t33;
    // Eliminates coupler[1] from row across[1]: l[across[1], coupler[1]].
    let t48 = t28 * t33;
    // Eliminates crank[1] from row along[1]: l[along[1], crank[1]].
    let t49 = t7 * t34;
    // Eliminates crank[1] from row along[2]: l[along[2], crank[1]].
    let t50 = t27 * t34;
    // Eliminates crank[1] from row across[1]: l[across[1], crank[1]].
    let t51 = t14 * t34;
    // Eliminates crank[1] from row across[2]: l[across[2], crank[1]].
    let t52 = t31 * t34;
    let t53 = cos_coupler_1 * n(p.minus_half_l_m_g);
    let t54 = t7 * t50;
    let t55 = t27.mul_add(t50, t10.mul_add(t19, t8 * t15));
    let t56 = t7 * t52;
    // Row along[1]: pivot d[along[1]].
    let t57 = t7.mul_add(t49, t25.mul_add(t47, t6 * t13));
    let t58 = t7.mul_add(t51, t25.mul_add(t48, t6 * t12));
    let t59 = cos_coupler_2.mul_add(t3, t35);
    let t60 = sin_coupler_2.mul_add(t3, t38);
    let t61 = t14.mul_add(t51, t28.mul_add(t48, t5 * t12));
    // Row crank[1]: right-hand side z[crank[1]].
    let t62 = t26.mul_add(t45, t46.mul_add(t40, cos_crank_1 * n(p.k4)));
    let t63 = N::ONE / t57;
    let t64 = cos_crank_0.mul_add(t0, cos_coupler_1 * t2) - t35;
    let t65 = (t0 * n(p.half_l_squared_m)).mul_add(t37, t53);
    // Row coupler[1]: right-hand side z[coupler[1]].
    let t66 = t24.mul_add(t42, t65);
    let t67 = sin_crank_0.mul_add(t0, sin_coupler_1 * t2) - t38;
    let t68 = cos_crank_2.neg_mul_add(t4, t59);
    let t69 = sin_crank_2.neg_mul_add(t4, t60);
    let t70 = t49.neg_mul_add(t62, n(p.l).mul_sub(t64, t13 * t42));
    // Row along[1]: right-hand side z[along[1]].
    let t71 = t47.mul_add(t66, t70);
    let t72 = t48.neg_mul_add(t66, n(p.l).mul_add(t67, t12 * t42));
    let t73 = t15.neg_mul_add(t45, n(p.l).mul_sub(t68, t19 * t43));
    let t74 = t22.mul_add(t45, n(p.l).mul_add(t69, t32 * t43));
    let t75 = t31.mul_add(t52, t23.mul_add(t32, t16 * t22));
    // Eliminates along[1] from row along[2]: l[along[2], along[1]].
    let t76 = t54 * t63;
    // Eliminates along[1] from row across[1]: l[across[1], along[1]].
    let t77 = t58 * t63;
    // Eliminates along[1] from row across[2]: l[across[2], along[1]].
    let t78 = t56 * t63;
    // Row along[2]: pivot d[along[2]].
    let t79 = t54.neg_mul_add(t76, t55);
    let t80 = t54.neg_mul_add(t77, t27 * t51);
    let t81 = t27.mul_add(t52, t10.mul_add(t32, t8 * t22));
    let t82 = t54.neg_mul_add(t78, t81);
    // Row along[2]: right-hand side z[along[2]].
    let t83 = t71.mul_add(t76, t50.mul_add(t62, t73));
    let t84 = N::ONE / t79;
    // Eliminates along[2] from row across[1]: l[across[1], along[2]].
    let t85 = t80 * t84;
    // Eliminates along[2] from row across[2]: l[across[2], along[2]].
    let t86 = t82 * t84;
    // Row across[1]: pivot d[across[1]].
    let t87 = t80.neg_mul_add(t85, t58.neg_mul_add(t77, t61));
    let t88 = t80.neg_mul_add(t86, t58.neg_mul_add(t78, t14 * t52));
    let t89 = t71.mul_add(t77, t51.mul_add(t62, t72));
    // Row across[1]: right-hand side z[across[1]].
    let t90 = t83.neg_mul_add(t85, t89);
    let t91 = t71.neg_mul_add(t78, t52.neg_mul_add(t62, t74));
    let t92 = N::ONE / t87;
    // Eliminates across[1] from row across[2]: l[across[2], across[1]].
    let t93 = t88 * t92;
    let t94 = t82.neg_mul_add(t86, t56.neg_mul_add(t78, t75));
    // Row across[2]: pivot d[across[2]].
    let t95 = t88.neg_mul_add(t93, t94);
    // Row across[2]: right-hand side z[across[2]].
    let t96 = t90.mul_add(t93, t83.mul_add(t86, t91)) / t95;
    // Back substitution: lambda[across[1]].
    let t97 = t93.mul_add(t96, t90 * t92);
    // Back substitution: lambda[along[2]].
    let t98 = t85.neg_mul_add(t97, t86.mul_add(t96, t83 * t84));
    let t99 = t77.mul_add(t97, t78.neg_mul_add(t96, t63 * t71));
    // Back substitution: lambda[along[1]].
    let t100 = t76.mul_add(t98, t99);
    let t101 = t51.mul_sub(t97, t52.mul_add(t96, t34 * t62));
    let t102 = t50.mul_add(t98, t101);
    let t103 = t49 * t100;
    // Back substitution: a[coupler[1]].
    let t104 = t47.mul_sub(t100, t48.mul_add(t97, t33 * t66));
    let t105 = t13.neg_mul_add(t100, t12.mul_sub(t97, n(p.k6) * t42));
    let t106 = t15.neg_mul_add(t98, t22.mul_sub(t96, n(p.k5) * t45));
    // Back substitution: a[crank[0]].
    let crank_0_ddot = t24.mul_add(t104, t105);
    let crank_1_ddot = t103 - t102;
    // Back substitution: a[crank[2]].
    let crank_2_ddot = t19.mul_sub(t98, t32.mul_sub(t96, n(p.k5) * t43));
    let coupler_1_ddot = -t104;
    // Back substitution: a[crank[1]]; Back substitution: a[coupler[2]].
    let coupler_2_ddot = t26.mul_add(t102 - t103, t106);
    let sound = PIVOTS.hold(t29, n(p.k3))
        & PIVOTS.hold(t30, n(p.k2))
        & PIVOTS.hold(t57, t57)
        & PIVOTS.hold(t79, t55)
        & PIVOTS.hold(t87, t61)
        & PIVOTS.hold(t95, t75)
        & coupler_2_ddot.is_finite();
    if !sound {
        let pivots = [
            (3, t29, n(p.k3)),
            (1, t30, n(p.k2)),
            (5, t57, t57),
            (6, t79, t55),
            (7, t87, t61),
            (8, t95, t75),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        crank_0_ddot.store(),
        crank_1_ddot.store(),
        crank_2_ddot.store(),
        coupler_1_ddot.store(),
        coupler_2_ddot.store(),
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
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 4], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let crank_0 = n(q[0]);
    let crank_1 = n(q[1]);
    let crank_2 = n(q[2]);
    let coupler_1 = n(q[3]);
    let coupler_2 = n(q[4]);
    let crank_0_dot = n(v[0]);
    let crank_1_dot = n(v[1]);
    let crank_2_dot = n(v[2]);
    let coupler_1_dot = n(v[3]);
    let coupler_2_dot = n(v[4]);
    let angles = [coupler_1, crank_0, coupler_2, crank_1, crank_2];
    let circular = N::sin_cos_all(angles);
    let (sin_coupler_1, cos_coupler_1) = circular[0];
    let (sin_crank_0, cos_crank_0) = circular[1];
    let (sin_coupler_2, cos_coupler_2) = circular[2];
    let (sin_crank_1, cos_crank_1) = circular[3];
    let (sin_crank_2, cos_crank_2) = circular[4];
    let t0 = crank_0_dot * crank_0_dot;
    let t1 = crank_1_dot * crank_1_dot;
    let t2 = coupler_1_dot * coupler_1_dot;
    let t3 = coupler_2_dot * coupler_2_dot;
    let t4 = crank_2_dot * crank_2_dot;
    let t5 = cos_crank_0 * n(p.l);
    let t6 = sin_crank_0 * n(p.l);
    let t7 = sin_crank_1 * n(p.l);
    let t8 = sin_coupler_2 * n(p.l);
    let t9 = sin_coupler_1 * sin_crank_0;
    let t10 = sin_crank_2 * n(p.l);
    let t11 = sin_coupler_2 * sin_crank_1;
    // Eliminates crank[0] from row across[1]: l[across[1], crank[0]].
    let t12 = t5 * n(p.k6);
    // Eliminates crank[0] from row along[1]: l[along[1], crank[0]].
    let t13 = t6 * n(p.k6);
    let t14 = cos_crank_1 * n(p.l);
    // Eliminates coupler[2] from row along[2]: l[along[2], coupler[2]].
    let t15 = t8 * n(p.k5);
    let t16 = cos_coupler_2 * n(p.l);
    let t17 = cos_coupler_1.mul_add(cos_crank_0, t9);
    let t18 = n(p.half_l_squared_m) * t17;
    // Eliminates crank[2] from row along[2]: l[along[2], crank[2]].
    let t19 = t10 * n(p.k5);
    let t20 = cos_coupler_2.mul_add(cos_crank_1, t11);
    let t21 = n(p.half_l_squared_m) * t20;
    // Eliminates coupler[2] from row across[2]: l[across[2], coupler[2]].
    let t22 = n(p.k5) * t16;
    let t23 = cos_crank_2 * n(p.l);
    // Eliminates crank[0] from row coupler[1]: l[coupler[1], crank[0]].
    let t24 = n(p.k6) * t18;
    let t25 = t13.neg_mul_add(t18, sin_coupler_1 * n(p.l));
    // Eliminates coupler[2] from row crank[1]: l[crank[1], coupler[2]].
    let t26 = n(p.k5) * t21;
    let t27 = t15.neg_mul_add(t21, t7);
    let t28 = t12.neg_mul_add(t18, cos_coupler_1 * n(p.l));
    // Row coupler[1]: pivot d[coupler[1]].
    let t29 = t18.neg_mul_add(t24, n(p.k3));
    // Row crank[1]: pivot d[crank[1]].
    let t30 = t21.neg_mul_add(t26, n(p.k2));
    let t31 = t21.neg_mul_add(t22, t14);
    // Eliminates crank[2] from row across[2]: l[across[2], crank[2]].
    let t32 = n(p.k5) * t23;
    let t33 = N::ONE / t29;
    let t34 = N::ONE / t30;
    let t35 = cos_crank_1 * t1;
    let t36 = sin_coupler_1 * cos_crank_0;
    let t37 = cos_coupler_1.mul_sub(sin_crank_0, t36);
    let t38 = sin_crank_1 * t1;
    let t39 = cos_coupler_2 * sin_crank_1;
    let t40 = sin_coupler_2.mul_sub(cos_crank_1, t39);
    let t41 = t2 * n(p.half_l_squared_m);
    let t42 = t41.mul_sub(t37, cos_crank_0 * n(p.k4));
    let t43 = cos_crank_2 * n(p.minus_half_l_m_g);
    let t44 = cos_coupler_2 * n(p.minus_half_l_m_g);
    let t45 = (t1 * n(p.half_l_squared_m)).mul_sub(t40, t44);
    let t46 = t3 * n(p.half_l_squared_m);
    // Eliminates coupler[1] from row along[1]: l[along[1], coupler[1]].
    let t47 = t25 * t33;
    // Eliminates coupler[1] from row across[1]: l[across[1], coupler[1]].
    let t48 = t28 * t33;
    // Eliminates crank[1] from row along[1]: l[along[1], crank[1]].
    let t49 = t7 * t34;
    // Eliminates crank[1] from row along[2]: l[along[2], crank[1]].
    let t50 = t27 * t34;
    // Eliminates crank[1] from row across[1]: l[across[1], crank[1]].
    let t51 = t14 * t34;
    // Eliminates crank[1] from row across[2]: l[across[2], crank[1]].
    let t52 = t31 * t34;
    let t53 = cos_coupler_1 * n(p.minus_half_l_m_g);
    let t54 = t7 * t50;
    let t55 = t27.mul_add(t50, t10.mul_add(t19, t8 * t15));
    let t56 = t7 * t52;
    // Row along[1]: pivot d[along[1]].
    let t57 = t7.mul_add(t49, t25.mul_add(t47, t6 * t13));
    let t58 = t7.mul_add(t51, t25.mul_add(t48, t6 * t12));
    let t59 = cos_coupler_2.mul_add(t3, t35);
    let t60 = sin_coupler_2.mul_add(t3, t38);
    let t61 = t14.mul_add(t51, t28.mul_add(t48, t5 * t12));
    // Row crank[1]: right-hand side z[crank[1]].
    let t62 = t26.mul_add(t45, t46.mul_add(t40, cos_crank_1 * n(p.k4)));
    let t63 = N::ONE / t57;
    let t64 = cos_crank_0.mul_add(t0, cos_coupler_1 * t2) - t35;
    let t65 = (t0 * n(p.half_l_squared_m)).mul_add(t37, t53);
    // Row coupler[1]: right-hand side z[coupler[1]].
    let t66 = t24.mul_add(t42, t65);
    let t67 = sin_crank_0.mul_add(t0, sin_coupler_1 * t2) - t38;
    let t68 = cos_crank_2.neg_mul_add(t4, t59);
    let t69 = sin_crank_2.neg_mul_add(t4, t60);
    let t70 = t49.neg_mul_add(t62, n(p.l).mul_sub(t64, t13 * t42));
    // Row along[1]: right-hand side z[along[1]].
    let t71 = t47.mul_add(t66, t70);
    let t72 = t48.neg_mul_add(t66, n(p.l).mul_add(t67, t12 * t42));
    let t73 = t15.neg_mul_add(t45, n(p.l).mul_sub(t68, t19 * t43));
    let t74 = t22.mul_add(t45, n(p.l).mul_add(t69, t32 * t43));
    let t75 = t31.mul_add(t52, t23.mul_add(t32, t16 * t22));
    // Eliminates along[1] from row along[2]: l[along[2], along[1]].
    let t76 = t54 * t63;
    // Eliminates along[1] from row across[1]: l[across[1], along[1]].
    let t77 = t58 * t63;
    // Eliminates along[1] from row across[2]: l[across[2], along[1]].
    let t78 = t56 * t63;
    // Row along[2]: pivot d[along[2]].
    let t79 = t54.neg_mul_add(t76, t55);
    let t80 = t54.neg_mul_add(t77, t27 * t51);
    let t81 = t27.mul_add(t52, t10.mul_add(t32, t8 * t22));
    let t82 = t54.neg_mul_add(t78, t81);
    // Row along[2]: right-hand side z[along[2]].
    let t83 = t71.mul_add(t76, t50.mul_add(t62, t73));
    let t84 = N::ONE / t79;
    // Eliminates along[2] from row across[1]: l[across[1], along[2]].
    let t85 = t80 * t84;
    // Eliminates along[2] from row across[2]: l[across[2], along[2]].
    let t86 = t82 * t84;
    // Row across[1]: pivot d[across[1]].
    let t87 = t80.neg_mul_add(t85, t58.neg_mul_add(t77, t61));
    let t88 = t80.neg_mul_add(t86, t58.neg_mul_add(t78, t14 * t52));
    let t89 = t71.mul_add(t77, t51.mul_add(t62, t72));
    // Row across[1]: right-hand side z[across[1]].
    let t90 = t83.neg_mul_add(t85, t89);
    let t91 = t71.neg_mul_add(t78, t52.neg_mul_add(t62, t74));
    let t92 = N::ONE / t87;
    // Eliminates across[1] from row across[2]: l[across[2], across[1]].
    let t93 = t88 * t92;
    let t94 = t82.neg_mul_add(t86, t56.neg_mul_add(t78, t75));
    // Row across[2]: pivot d[across[2]].
    let t95 = t88.neg_mul_add(t93, t94);
    // Row across[2]: right-hand side z[across[2]].
    let lambda4 = t90.mul_add(t93, t83.mul_add(t86, t91)) / t95;
    // Back substitution: lambda[across[1]].
    let lambda3 = t93.mul_add(lambda4, t90 * t92);
    // Back substitution: lambda[along[2]].
    let lambda2 = t85.neg_mul_add(lambda3, t86.mul_add(lambda4, t83 * t84));
    let t96 = t77.mul_add(lambda3, t78.neg_mul_add(lambda4, t63 * t71));
    // Back substitution: lambda[along[1]].
    let lambda1 = t76.mul_add(lambda2, t96);
    let sound = PIVOTS.hold(t29, n(p.k3))
        & PIVOTS.hold(t30, n(p.k2))
        & PIVOTS.hold(t57, t57)
        & PIVOTS.hold(t79, t55)
        & PIVOTS.hold(t87, t61)
        & PIVOTS.hold(t95, t75)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (3, t29, n(p.k3)),
            (1, t30, n(p.k2)),
            (5, t57, t57),
            (6, t79, t55),
            (7, t87, t61),
            (8, t95, t75),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [
        lambda1.store(),
        lambda2.store(),
        lambda3.store(),
        lambda4.store(),
    ];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 59], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 59], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let crank_0 = n(q[0]);
    let crank_1 = n(q[1]);
    let crank_2 = n(q[2]);
    let coupler_1 = n(q[3]);
    let coupler_2 = n(q[4]);
    let crank_0_dot = n(v[0]);
    let crank_1_dot = n(v[1]);
    let crank_2_dot = n(v[2]);
    let coupler_1_dot = n(v[3]);
    let coupler_2_dot = n(v[4]);
    let angles = [coupler_1, crank_0, crank_1, coupler_2, crank_2];
    let circular = N::sin_cos_all(angles);
    let (sin_coupler_1, cos_coupler_1) = circular[0];
    let (sin_crank_0, cos_crank_0) = circular[1];
    let (sin_crank_1, cos_crank_1) = circular[2];
    let (sin_coupler_2, cos_coupler_2) = circular[3];
    let (sin_crank_2, cos_crank_2) = circular[4];
    let r18 = cos_crank_0 * n(p.l);
    let r21 = cos_coupler_1 * n(p.l);
    let t0 = sin_crank_0 * n(p.l);
    let r9 = sin_crank_1 * n(p.l);
    let t1 = sin_coupler_2 * n(p.l);
    let t2 = cos_coupler_1 * cos_crank_0;
    let r15 = sin_crank_2 * n(p.l);
    let t3 = r18 * n(p.k6);
    let r24 = cos_crank_1 * n(p.l);
    let t4 = cos_crank_1 * cos_coupler_2;
    let t5 = n(p.k6) * t0;
    let t6 = n(p.k5) * t1;
    let r27 = cos_coupler_2 * n(p.l);
    let t7 = sin_coupler_1.mul_add(sin_crank_0, t2);
    let t8 = n(p.half_l_squared_m) * t7;
    let t9 = r15 * n(p.k5);
    let t10 = sin_crank_1.mul_add(sin_coupler_2, t4);
    let t11 = n(p.half_l_squared_m) * t10;
    let t12 = r27 * n(p.k5);
    let t13 = cos_crank_2 * n(p.l);
    let t14 = n(p.k6) * t8;
    let t15 = t8.neg_mul_add(t5, sin_coupler_1 * n(p.l));
    let t16 = t8.neg_mul_add(t3, r21);
    let t17 = n(p.k5) * t11;
    let t18 = t11.neg_mul_add(t6, r9);
    let t19 = t11.neg_mul_add(t12, r24);
    let t20 = n(p.k5) * t13;
    let t21 = t8.neg_mul_add(t14, n(p.k3));
    let t22 = sin_crank_1 * crank_1_dot;
    let t23 = t11.neg_mul_add(t17, n(p.k2));
    let t24 = N::ONE / t21;
    let t25 = cos_crank_1 * crank_1_dot;
    let t26 = N::ONE / t23;
    let t27 = sin_crank_0 * crank_0_dot;
    let t28 = cos_crank_0 * crank_0_dot;
    let t29 = cos_crank_1 + N::ONE - (cos_coupler_1 + cos_crank_0);
    let t30 = N::ONE + cos_crank_2 - (cos_crank_1 + cos_coupler_2);
    let t31 = sin_coupler_1.mul_add(coupler_1_dot, t27) - t22;
    let t32 = sin_coupler_2.mul_add(coupler_2_dot, t22);
    let t33 = sin_crank_2.neg_mul_add(crank_2_dot, t32);
    let t34 = cos_coupler_2.mul_add(coupler_2_dot, t25);
    let t35 = t29 * n(p.l);
    let r2 = n(p.l) * (sin_coupler_1 + sin_crank_0 - sin_crank_1);
    let t36 = t24 * t15;
    let t37 = t24 * t16;
    let r3 = n(p.l) * (sin_crank_1 + sin_coupler_2 - sin_crank_2);
    let r6 = n(p.l) * (cos_coupler_1.mul_add(coupler_1_dot, t28) - t25);
    let t38 = r9 * t26;
    let t39 = t26 * t18;
    let t40 = r24 * t26;
    let t41 = t26 * t19;
    let r7 = n(p.l) * cos_crank_2.neg_mul_add(crank_2_dot, t34);
    let t42 = r9 * t39;
    let r56 = t18.mul_add(t39, t1.mul_add(t6, r15 * t9));
    let t43 = r9 * t41;
    let r51 = r9.mul_add(t38, t15.mul_add(t36, t0 * t5));
    let t44 = r9.mul_add(t40, t15.mul_add(t37, t0 * t3));
    let r57 = r24.mul_add(t40, t16.mul_add(t37, r18 * t3));
    let r58 = t19.mul_add(t41, r27.mul_add(t12, t13 * t20));
    let t45 = n(p.l) * t31;
    let t46 = N::ONE / r51;
    let t47 = t46 * t42;
    let t48 = t46 * t44;
    let t49 = t46 * t43;
    let r52 = t42.neg_mul_add(t47, r56);
    let t50 = t42.neg_mul_add(t48, t18 * t40);
    let t51 = t18.mul_add(t41, t1.mul_add(t12, r15 * t20));
    let t52 = t42.neg_mul_add(t49, t51);
    let t53 = t35.mul_add(t47, t30 * n(p.l));
    let t54 = N::ONE / r52;
    let t55 = t47.mul_add(t45, n(p.l) * t33);
    let t56 = t54 * t50;
    let t57 = t54 * t52;
    let r53 = t50.neg_mul_add(t56, t44.neg_mul_add(t48, r57));
    let t58 = t50.neg_mul_add(t57, t44.neg_mul_add(t49, r24 * t41));
    let t59 = t53.mul_add(t56, t35.neg_mul_add(t48, r2));
    let t60 = t56.mul_add(t55, t48.neg_mul_add(t45, r6));
    let t61 = N::ONE / r53;
    let t62 = t61 * t58;
    let t63 = t52.neg_mul_add(t57, t43.neg_mul_add(t49, r58));
    let r54 = t58.neg_mul_add(t62, t63);
    let t64 = t53.neg_mul_add(t57, t35.mul_add(t49, r3));
    let t65 = t57.neg_mul_add(t55, t49.mul_add(t45, r7));
    let t66 = N::ONE / r54;
    let t67 = t59.mul_add(t62, t64) * t66;
    let t68 = t66 * t62.mul_add(t60, t65);
    let t69 = t62.mul_add(t67, t59 * t61);
    let t70 = t62.mul_add(t68, t61 * t60);
    let r44 = t56.mul_add(t69, t57.neg_mul_add(t67, t53 * t54));
    let r48 = t56.mul_add(t70, t57.neg_mul_add(t68, t54 * t55));
    let t71 = t48.neg_mul_add(t69, t49.mul_add(t67, t35 * t46));
    let r43 = t47.mul_add(r44, t71);
    let t72 = t48.neg_mul_add(t70, t49.mul_add(t68, t46 * t45));
    let r47 = t47.mul_add(r48, t72);
    let t73 = t39.neg_mul_add(r44, t40.mul_sub(t69, t41 * t67));
    let r34 = t38.mul_add(r43, t73);
    let t74 = t36.mul_add(r43, t37 * t69);
    let t75 = t39.neg_mul_add(r48, t40.mul_sub(t70, t41 * t68));
    let r39 = t38.mul_add(r47, t75);
    let t76 = t36.mul_add(r47, t37 * t70);
    let r0 = n(p.minus_l) * t29;
    let r1 = n(p.minus_l) * t30;
    let r4 = n(p.minus_l) * t31;
    let r5 = n(p.minus_l) * t33;
    let r8 = n(p.minus_l) * sin_crank_0;
    let zero = N::ZERO;
    let r11 = n(p.minus_l) * sin_coupler_1;
    let r14 = n(p.minus_l) * sin_crank_1;
    let r17 = n(p.minus_l) * sin_coupler_2;
    let r19 = n(p.minus_l) * cos_crank_1;
    let r25 = n(p.minus_l) * cos_crank_2;
    let r33 = t14.mul_sub(t74, t5.mul_add(r43, t3 * t69));
    let r35 = t9.mul_add(r44, t20 * t67);
    let r36 = -t74;
    let r37 = -t17.mul_add(r34, t6.mul_add(r44, t12 * t67));
    let r38 = t14.mul_sub(t76, t5.mul_add(r47, t3 * t70));
    let r40 = t9.mul_add(r48, t20 * t68);
    let r41 = -t76;
    let r42 = -t17.mul_add(r39, t6.mul_add(r48, t12 * t68));
    let r45 = -t69;
    let r46 = -t67;
    let r49 = -t70;
    let r50 = -t68;
    let sound = PIVOTS.hold(t21, n(p.k3))
        & PIVOTS.hold(t23, n(p.k2))
        & PIVOTS.hold(r51, r51)
        & PIVOTS.hold(r52, r56)
        & PIVOTS.hold(r53, r57)
        & PIVOTS.hold(r54, r58)
        & r42.is_finite();
    if !sound {
        let pivots = [
            (3, t21, n(p.k3)),
            (1, t23, n(p.k2)),
            (5, r51, r51),
            (6, r52, r56),
            (7, r53, r57),
            (8, r54, r58),
        ];
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
        zero.store(),
        r11.store(),
        zero.store(),
        zero.store(),
        r14.store(),
        r15.store(),
        zero.store(),
        r17.store(),
        r18.store(),
        r19.store(),
        zero.store(),
        r21.store(),
        zero.store(),
        zero.store(),
        r24.store(),
        r25.store(),
        zero.store(),
        r27.store(),
        n(p.k2).store(),
        n(p.k2).store(),
        n(p.k3).store(),
        n(p.k3).store(),
        n(p.k3).store(),
        r33.store(),
        r34.store(),
        r35.store(),
        r36.store(),
        r37.store(),
        r38.store(),
        r39.store(),
        r40.store(),
        r41.store(),
        r42.store(),
        r43.store(),
        r44.store(),
        r45.store(),
        r46.store(),
        r47.store(),
        r48.store(),
        r49.store(),
        r50.store(),
        r51.store(),
        r52.store(),
        r53.store(),
        r54.store(),
        r51.store(),
        r56.store(),
        r57.store(),
        r58.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 2/3*l^2*m*der(crank[0])^2
///     + 1/2*l^2*m*cos(coupler[1] - crank[0])*der(crank[0])*der(coupler[1])
///     + 2/3*l^2*m*der(crank[1])^2
///     + 1/2*l^2*m*cos(coupler[2] - crank[1])*der(crank[1])*der(coupler[2])
///     + 1/6*l^2*m*der(crank[2])^2 + 1/6*l^2*m*der(coupler[1])^2 + 1/6*l^2*m*der(coupler[2])^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> S {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let crank_0_dot = v[0];
    let crank_1_dot = v[1];
    let crank_2_dot = v[2];
    let coupler_1_dot = v[3];
    let coupler_2_dot = v[4];
    let (sin_crank_1, cos_crank_1) = crank_1.sin_cos();
    let (sin_crank_0, cos_crank_0) = crank_0.sin_cos();
    let (sin_coupler_2, cos_coupler_2) = coupler_2.sin_cos();
    let (sin_coupler_1, cos_coupler_1) = coupler_1.sin_cos();
    let t0 = crank_1_dot * p.l;
    let t1 = p.l * crank_0_dot;
    let t2 = p.half_l * coupler_2_dot;
    let t3 = p.half_l * coupler_1_dot;
    let t4 = crank_1_dot * crank_1_dot + crank_0_dot * crank_0_dot;
    let t5 = t2 * sin_coupler_2 + t0 * sin_crank_1;
    let t6 = t3 * sin_coupler_1 + t1 * sin_crank_0;
    let t7 = t2 * cos_coupler_2 + t0 * cos_crank_1;
    let t8 = t3 * cos_coupler_1 + t1 * cos_crank_0;
    let t9 = p.m * (t8 * t8 + t6 * t6) + coupler_1_dot * (p.k0 * coupler_1_dot);
    let t10 = p.m * (t7 * t7 + t5 * t5) + coupler_2_dot * (coupler_2_dot * p.k0) + t9;
    t10 * S::from_f64(0.5) + (crank_2_dot * crank_2_dot + t4) * p.k1
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 3/2*l*m*g*sin(crank[0]) + 3/2*l*m*g*sin(crank[1]) + 1/2*l*m*g*sin(crank[2])
///     + 1/2*l*m*g*sin(coupler[1]) + 1/2*l*m*g*sin(coupler[2])
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let crank_0 = q[0];
    let crank_1 = q[1];
    let crank_2 = q[2];
    let coupler_1 = q[3];
    let coupler_2 = q[4];
    let sin_crank_1 = crank_1.sin();
    let sin_crank_0 = crank_0.sin();
    let sin_coupler_2 = coupler_2.sin();
    let sin_coupler_1 = coupler_1.sin();
    let sin_crank_2 = crank_2.sin();
    let t0 = sin_crank_0 * p.l + sin_coupler_1 * p.half_l;
    let t1 = (sin_crank_2 + (sin_crank_1 + sin_crank_0)) * p.minus_half_l_m_g;
    (sin_crank_1 * p.l + sin_coupler_2 * p.half_l + t0) * p.m_g - t1
}

::lagrangian::emitted::implement! {
    machine FourBars "FourBars" over S, R;
    parameters { l, m, g, v0 } [
        l: "l" "m" = 1.0;
        m: "m" "kg" = 1.0;
        g: "g" "m/s^2" = 9.81;
        v0: "v0" "m/s" = 1.0;
    ]
    coordinates 5 Coordinates {
        crank: [crank_0, crank_1, crank_2], coupler: [coupler_1, coupler_2],
    } [
        crank_0: "crank[0]" "rad";
        crank_1: "crank[1]" "rad";
        crank_2: "crank[2]" "rad";
        coupler_1: "coupler[1]" "rad";
        coupler_2: "coupler[2]" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        l, m, half_l, k0, m_g, k1, half_l_squared_m, k2, k3, minus_l, minus_half_l_squared_m, k4,
        minus_half_l_m_g, k5, k6,
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
        constraints constraints(p) = [
            ("along[1]", "m", "N", true),
            ("along[2]", "m", "N", true),
            ("across[1]", "m", "N", true),
            ("across[2]", "m", "N", true),
        ];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 4);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
