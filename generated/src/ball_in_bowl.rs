// @generated from machines/ball_in_bowl.machine by `cargo xtask generate`; edits are lost.

//! A ball that rolls without slip in a spherical bowl, which turns about its vertical axis.
//! The ball
//! is turned by three angles; that it touches is one constraint, that it does not slip two.
//!
//! 6 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 8 | 7 | 3 | 0 | 0 | 18 |
//! | `mass_matrix` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `bias` | 7 | 0 | 0 | 1 | 0 | 8 |
//! | `forces` | 7 | 0 | 0 | 1 | 0 | 8 |
//! | `constraint_positions` | 5 | 3 | 0 | 0 | 0 | 8 |
//! | `constraint_rates` | 31 | 17 | 0 | 2 | 0 | 52 |
//! | `constraint_matrix` | 31 | 6 | 0 | 2 | 0 | 41 |
//! | `constraint_bias` | 67 | 40 | 0 | 2 | 0 | 111 |
//! | `accelerations` | 182 | 102 | 4 | 2 | 0 | 292 |
//! | `multipliers` | 164 | 86 | 4 | 2 | 0 | 258 |
//! | `kinetic_energy` | 15 | 8 | 0 | 1 | 0 | 25 |
//! | `potential_energy` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `work_rate` | 19 | 13 | 0 | 1 | 0 | 34 |
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

/// A ball that rolls without slip in a spherical bowl, which turns about its vertical axis.
/// The ball
/// is turned by three angles; that it touches is one constraint, that it does not slip two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallInBowl<S = f64> {
    /// `m`. Unit: `kg`. Default: 0.3.
    pub m: S,
    /// `r`. Unit: `m`. Default: 0.05.
    pub r: S,
    /// Inertia of the ball about any axis; that of a uniform one. Unit: `kg*m^2`. Default: 0.0003.
    pub J: S,
    /// Radius of the bowl. Unit: `m`. Default: 0.55.
    pub R: S,
    /// Rate at which the bowl turns. Unit: `rad/s`. Default: 2.
    pub Omega: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BallInBowl<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.r - self.R;
        let m_g = self.m * self.g;
        let k0 = S::ONE / t0;
        let k1 = self.r * k0;
        let k3 = k0 * k0;
        let k5 = k0 * k1;
        let k6 = k0 * k5;
        let k2 = k0 * (self.R * self.Omega);
        let k4 = t0 * S::from_f64(0.5);
        let minus_J = -self.J;
        let minus_m_g = -m_g;
        let k7 = -k0;
        let k8 = -k5;
        let k9 = -k3;
        let k10 = -k6;
        let inverse_J = S::ONE / self.J;
        let inverse_m = S::ONE / self.m;
        let pivots = [
            (2, self.m, self.m),
            (4, self.J, self.J),
            (0, self.m, self.m),
            (1, self.m, self.m),
            (3, self.J, self.J),
        ];
        Prepared {
            m: self.m,
            J: self.J,
            g: self.g,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            m_g,
            k6,
            minus_J,
            minus_m_g,
            k7,
            k8,
            k9,
            k10,
            inverse_J,
            inverse_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let x = S::from_ratio(3, 10);
        let zero = S::ZERO;
        let z = S::from_ratio(-2, 5);
        let y_rate = S::from_ratio(3, 5);
        let q = [x, zero, z, zero, zero, zero];
        let v = [zero, y_rate, zero, zero, zero, self.Omega];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`BallInBowl`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Centre of the ball, from that of the bowl. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `z`. Unit: `m`.
    pub z: S,
    /// Angles of the ball, about x, then y, then z of itself. Unit: `rad`.
    pub a: S,
    /// `b`. Unit: `rad`.
    pub b: S,
    /// `c`. Unit: `rad`.
    pub c: S,
}

/// The parameters of a [`BallInBowl`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `g`
    g: S,
    /// `1/(r - R)`
    k0: S,
    /// `r/(r - R)`
    k1: S,
    /// `R*Omega/(r - R)`
    k2: S,
    /// `1/(r - R)^2`
    k3: S,
    /// `0.5*(r - R)`
    k4: S,
    /// `r/(r - R)^2`
    k5: S,
    /// `m*g`
    m_g: S,
    /// `r/(r - R)^3`
    k6: S,
    /// `-J`
    minus_J: S,
    /// `-m*g`
    minus_m_g: S,
    /// `-1/(r - R)`
    k7: S,
    /// `-r/(r - R)^2`
    k8: S,
    /// `-1/(r - R)^2`
    k9: S,
    /// `-r/(r - R)^3`
    k10: S,
    /// `1/J`
    inverse_J: S,
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
/// M[a, a] = J
/// M[b, b] = J
/// M[c, a] = J*sin(b)
/// M[c, c] = J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [[S; 6]; 6] {
    let b = q[4];
    let sin_b = b.sin();
    let zero = S::ZERO;
    let m64 = p.J * sin_b;
    [
        [p.m, zero, zero, zero, zero, zero],
        [zero, p.m, zero, zero, zero, zero],
        [zero, zero, p.m, zero, zero, zero],
        [zero, zero, zero, p.J, zero, m64],
        [zero, zero, zero, zero, p.J, zero],
        [zero, zero, zero, m64, zero, p.J],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[a] = J*cos(b)*der(b)*der(c)
/// h[b] = -J*cos(b)*der(a)*der(c)
/// h[c] = J*cos(b)*der(a)*der(b)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let b = q[4];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let cos_b = b.cos();
    let t0 = cos_b * p.J * b_dot;
    let zero = S::ZERO;
    let h_a = t0 * c_dot;
    let h_b = cos_b * (c_dot * (a_dot * p.minus_J));
    let h_c = t0 * a_dot;
    [zero, zero, zero, h_a, h_b, h_c]
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
    let b = q[4];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let cos_b = b.cos();
    let t0 = p.minus_J * cos_b * b_dot;
    let zero = S::ZERO;
    let f_a = t0 * c_dot;
    let f_b = cos_b * (c_dot * (a_dot * p.J));
    let f_c = t0 * a_dot;
    [zero, zero, p.minus_m_g, f_a, f_b, f_c]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[touching] = 1/2*r - 1/2*x^2/(r - R) - 1/2*y^2/(r - R) - 1/2*z^2/(r - R) - 1/2*R
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
) -> [S; 3] {
    let x = q[0];
    let y = q[1];
    let z = q[2];
    let g1 = p.k4 * (S::ONE - (z * z + (y * y + x * x)) * p.k3);
    let zero = S::ZERO;
    [g1, zero, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[touching] = -x*der(x)/(r - R) - y*der(y)/(r - R) - z*der(z)/(r - R)
/// phi[around] = (x*(der(y) + r*(x*(sin(a)*der(b) + cos(a)*cos(b)*der(c))/(R - r) - z*(der(a) +
///     sin(b)*der(c))/(R - r)) - R*Omega*x/(R - r)) - y*(der(x) + r*(z*(cos(a)*der(b) -
///     sin(a)*cos(b)*der(c))/(R - r) - y*(sin(a)*der(b) + cos(a)*cos(b)*der(c))/(R - r)) +
///     R*Omega*y/(R - r)))/(R - r)
/// phi[down] = (z*(x*(der(x) + r*(z*(cos(a)*der(b) - sin(a)*cos(b)*der(c))/(R - r) -
///     y*(sin(a)*der(b) + cos(a)*cos(b)*der(c))/(R - r)) + R*Omega*y/(R - r)) + y*(der(y) +
///     r*(x*(sin(a)*der(b) + cos(a)*cos(b)*der(c))/(R - r) - z*(der(a) + sin(b)*der(c))/(R - r)) -
///     R*Omega*x/(R - r))) - (x^2 + y^2)*(der(z) + r*(y*(der(a) + sin(b)*der(c))/(R - r) -
///     x*(cos(a)*der(b) - sin(a)*cos(b)*der(c))/(R - r))))/(R - r)^2
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 3] {
    let x = q[0];
    let y = q[1];
    let z = q[2];
    let a_ = q[3];
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = cos_b * c_dot;
    let t1 = sin_b * c_dot + a_dot;
    let t2 = t0 * cos_a_ + sin_a_ * b_dot;
    let t3 = cos_a_ * b_dot - t0 * sin_a_;
    let t4 = y_dot + x * p.k2 - p.k1 * (x * t2 - z * t1);
    let t5 = x_dot - y * p.k2 - p.k1 * (z * t3 - y * t2);
    let t6 = (y * y + x * x) * (z_dot - p.k1 * (y * t1 - x * t3));
    let phi1 = p.k7 * (z * z_dot + (y * y_dot + x * x_dot));
    let phi2 = p.k7 * (x * t4 - y * t5);
    let phi3 = (z * (y * t4 + x * t5) - t6) * p.k3;
    [phi1, phi2, phi3]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[touching, x] = x/(R - r)
/// G[touching, y] = y/(R - r)
/// G[touching, z] = z/(R - r)
/// G[around, x] = y/(r - R)
/// G[around, y] = x/(R - r)
/// G[around, a] = -r*x*z/(r - R)^2
/// G[around, b] = r*x^2*sin(a)/(r - R)^2 + r*y^2*sin(a)/(r - R)^2 - r*y*z*cos(a)/(r - R)^2
/// G[around, c] = r*y*z*sin(a)*cos(b)/(r - R)^2 - r*x*z*sin(b)/(r - R)^2
///     + cos(a)*cos(b)*(r*x^2/(R - r)^2 + r*y^2/(R - r)^2)
/// G[down, x] = x*z/(r - R)^2
/// G[down, y] = y*z/(r - R)^2
/// G[down, z] = -(x^2 + y^2)/(R - r)^2
/// G[down, a] = r*y*z^2/(r - R)^3 - r*y*(x^2 + y^2)/(R - r)^3
/// G[down, b] = cos(a)*(r*x*z^2/(R - r)^3 + r*x*(x^2 + y^2)/(R - r)^3)
/// G[down, c] = sin(b)*(-r*y*z^2/(R - r)^3 - r*y*(x^2 + y^2)/(R - r)^3)
///     - sin(a)*cos(b)*(r*x*z^2/(R - r)^3 + r*x*(x^2 + y^2)/(R - r)^3)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [S; 18] {
    let x = q[0];
    let y = q[1];
    let z = q[2];
    let a_ = q[3];
    let b = q[4];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = y * z;
    let t1 = x * z;
    let g1_1 = p.k7 * x;
    let t2 = y * y + x * x;
    let t3 = t2 + z * z;
    let t4 = y * t3;
    let t5 = x * t3;
    let t6 = sin_a_ * cos_b;
    let g1_2 = p.k7 * y;
    let g1_3 = p.k7 * z;
    let zero = S::ZERO;
    let g2_1 = y * p.k0;
    let g2_4 = t1 * p.k8;
    let g2_5 = p.k5 * (sin_a_ * t2 - t0 * cos_a_);
    let g2_6 = p.k5 * (z * (y * t6 - x * sin_b) + cos_b * (cos_a_ * t2));
    let g3_1 = t1 * p.k3;
    let g3_2 = t0 * p.k3;
    let g3_3 = t2 * p.k9;
    let g3_4 = t4 * p.k6;
    let g3_5 = cos_a_ * (t5 * p.k10);
    let g3_6 = p.k6 * (sin_b * t4 + t6 * t5);
    [
        g1_1, g1_2, g1_3, zero, zero, zero, g2_1, g1_1, zero, g2_4, g2_5, g2_6, g3_1, g3_2, g3_3,
        g3_4, g3_5, g3_6,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[touching] = der(x)^2/(r - R) + der(y)^2/(r - R) + der(z)^2/(r - R)
/// gamma[around] = …
/// gamma[down] = …
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 3] {
    let x = q[0];
    let y = q[1];
    let z = q[2];
    let a_ = q[3];
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = cos_a_ * b_dot;
    let t1 = sin_a_ * b_dot;
    let t2 = cos_b * c_dot;
    let t3 = sin_b * c_dot;
    let t4 = t2 * a_dot;
    let t5 = t0 - sin_a_ * t2;
    let t6 = cos_a_ * t2 + t1;
    let t7 = t3 + a_dot;
    let t8 = b_dot * t2;
    let t9 = cos_a_ * t4 - t3 * t1 + a_dot * t1;
    let t10 = t0 * a_dot - (t3 * t0 + sin_a_ * t4);
    let t11 = x_dot - y * p.k2 - p.k1 * (z * t5 - y * t6);
    let t12 = y_dot + p.k2 * x - p.k1 * (t6 * x - z * t7);
    let t13 = p.k1 * (z_dot * t5 - t9 * z - (t10 * y + y_dot * t6)) + y_dot * p.k2;
    let t14 = x_dot * p.k2 - p.k1 * (t10 * x + x_dot * t6 - (z * t8 + z_dot * t7));
    let t15 = (y_dot * y + x_dot * x) * S::from_f64(2.0);
    let t16 = (y * t8 + y_dot * t7 - (x_dot * t5 - t9 * x)) * (p.k1 * (y * y + x * x));
    let t17 = z * (y * t14 + y_dot * t12 + (x_dot * t11 - t13 * x));
    let t18 = t16 - (z_dot - p.k1 * (y * t7 - t5 * x)) * t15;
    let gamma1 = p.k0 * (z_dot * z_dot + (y_dot * y_dot + x_dot * x_dot));
    let gamma2 = p.k0 * (x * t14 + x_dot * t12 - (y_dot * t11 - y * t13));
    let gamma3 = p.k9 * (t18 + (t17 + z_dot * (y * t12 + t11 * x)));
    [gamma1, gamma2, gamma3]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix multiplied out.
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
    let x = n(q[0]);
    let y = n(q[1]);
    let z = n(q[2]);
    let a_ = n(q[3]);
    let b = n(q[4]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let z_dot = n(v[2]);
    let a_dot = n(v[3]);
    let b_dot = n(v[4]);
    let c_dot = n(v[5]);
    let angles = [b, a_];
    let circular = N::sin_cos_all(angles);
    let (sin_b, cos_b) = circular[0];
    let (sin_a_, cos_a_) = circular[1];
    let t0 = x * n(p.k0);
    let t1 = y * n(p.k0);
    let t2 = z * x;
    let t3 = z * n(p.k0);
    let t4 = z * y;
    let t5 = b_dot * a_dot;
    // Eliminates x from row touching: l[touching, x]; Eliminates y from row around: l[around, y].
    let t6 = n(p.inverse_m) * t0;
    let t7 = y.mul_add(y, x * x);
    // Eliminates y from row touching: l[touching, y]; Eliminates x from row around: l[around, x].
    let t8 = n(p.inverse_m) * t1;
    let t9 = t2 * n(p.k5);
    // Eliminates z from row touching: l[touching, z].
    let t10 = n(p.inverse_m) * t3;
    let t11 = n(p.k3) * t2;
    let t12 = t4 * n(p.k3);
    let t13 = n(p.k3) * t7;
    // Eliminates a from row around: l[around, a].
    let t14 = n(p.inverse_J) * t9;
    // Eliminates x from row down: l[down, x].
    let t15 = n(p.inverse_m) * t11;
    // Eliminates y from row down: l[down, y].
    let t16 = n(p.inverse_m) * t12;
    let t17 = y.mul_add(t7, z * t4);
    let t18 = t1.mul_add(t8, t0 * t6);
    // Eliminates z from row down: l[down, z].
    let t19 = n(p.inverse_m) * t13;
    let t20 = x.mul_add(t7, z * t2);
    let t21 = n(p.k6) * t17;
    // Row touching: pivot d[touching].
    let t22 = t3.mul_add(t10, t18);
    let t23 = t8.mul_sub(t0, t1 * t6);
    // Eliminates a from row down: l[down, a].
    let t24 = n(p.inverse_J) * t21;
    let t25 = N::ONE / t22;
    let t26 = t19.mul_sub(t3, t16.mul_add(t1, t15 * t0));
    let t27 = z_dot.mul_add(z_dot, y_dot.mul_add(y_dot, x_dot * x_dot));
    // Row touching: right-hand side z[touching].
    let t28 = n(p.k0).mul_sub(t27, t10 * n(p.m_g));
    // Eliminates touching from row around: l[around, touching].
    let t29 = t25 * t23;
    // Eliminates touching from row down: l[down, touching].
    let t30 = t25 * t26;
    let t31 = t24.mul_add(t9, t16.mul_sub(t0, t15 * t1));
    let t32 = sin_b * n(p.J);
    let t33 = cos_b * c_dot;
    let t34 = sin_b * c_dot;
    let t35 = sin_a_ * cos_b;
    // Eliminates a from row c: l[c, a].
    let t36 = n(p.inverse_J) * t32;
    let t37 = t33 * a_dot;
    let t38 = b_dot * t34;
    let t39 = sin_a_.neg_mul_add(t33, cos_a_ * b_dot);
    // Row c: pivot d[c].
    let t40 = t32.neg_mul_add(t36, n(p.J));
    let t41 = cos_a_.mul_add(t33, sin_a_ * b_dot);
    let t42 = a_dot + t34;
    let t43 = n(p.k5) * t7.mul_sub(sin_a_, t4 * cos_a_);
    let t44 = N::ONE / t40;
    let t45 = t4.mul_add(t35, cos_b.mul_sub(t7 * cos_a_, t2 * sin_b));
    let t46 = n(p.k5).mul_add(t45, t32 * t14);
    let t47 = t33 * b_dot;
    let t48 = cos_a_.mul_sub(t5, cos_a_.mul_add(t38, sin_a_ * t37));
    let t49 = sin_a_.mul_add(t5, cos_a_.mul_sub(t37, sin_a_ * t38));
    // Eliminates b from row around: l[around, b].
    let t50 = n(p.inverse_J) * t43;
    let t51 = y.neg_mul_add(n(p.k2), x_dot);
    let t52 = n(p.k1).neg_mul_add(z.mul_sub(t39, y * t41), t51);
    let t53 = cos_a_ * (t20 * n(p.k6));
    // Eliminates c from row around: l[around, c].
    let t54 = t44 * t46;
    let t55 = z.neg_mul_add(t49, z_dot * t39);
    let t56 = x.mul_add(n(p.k2), y_dot);
    let t57 = n(p.k1).neg_mul_add(x.mul_sub(t41, z * t42), t56);
    let t58 = t55 - y.mul_add(t48, y_dot * t41);
    let t59 = n(p.k1).mul_add(t58, y_dot * n(p.k2));
    let t60 = x.mul_add(t48, x_dot * t41) - z.mul_add(t47, z_dot * t42);
    let t61 = n(p.k1).neg_mul_add(t60, x_dot * n(p.k2));
    // Eliminates b from row down: l[down, b].
    let t62 = t53 * n(p.inverse_J);
    let t63 = n(p.k6).mul_sub(t20.mul_add(t35, sin_b * t17), t32 * t24);
    let t64 = n(p.J) * t47;
    let t65 = t46.mul_add(t54, t18) + t43.mul_add(t50, t9 * t14);
    let t66 = n(p.J) * t37;
    // Row around: pivot d[around].
    let t67 = t23.neg_mul_add(t29, t65);
    // Eliminates c from row down: l[down, c].
    let t68 = t44 * t63;
    let t69 = x.neg_mul_add(t49, x_dot * t39);
    let t70 = n(p.k1).neg_mul_add(y.mul_sub(t42, x * t39), z_dot);
    let t71 = N::ONE / t67;
    let t72 = x.neg_mul_add(t59, x_dot * t52);
    // Row c: right-hand side z[c].
    let t73 = t36.neg_mul_add(t64, cos_b * (n(p.J) * t5));
    let t74 = t70 * (y.mul_add(y_dot, x * x_dot) * N::from_f64(2.0));
    let t75 = y.mul_add(t47, y_dot * t42) - t69;
    let t76 = y.mul_add(t61, y_dot * t57) + t72;
    let t77 = t62.neg_mul_add(t66, t30.mul_add(t28, t19 * n(p.m_g)));
    let t78 = t62.mul_add(t43, t23.neg_mul_add(t30, t31));
    let t79 = t68.neg_mul_add(t46, t78);
    let t80 = y.neg_mul_add(t59, y_dot * t52);
    let t81 = t50.neg_mul_add(t66, t14.neg_mul_add(t64, t29 * t28));
    let t82 = z.mul_add(t76, z_dot * y.mul_add(t57, x * t52));
    let t83 = t12.mul_add(t16, t11 * t15) + t53.mul_add(t62, t13 * t19);
    let t84 = t83 + t63.mul_add(t68, t21 * t24);
    let t85 = x.mul_add(t61, x_dot * t57) - t80;
    // Row around: right-hand side z[around].
    let t86 = n(p.k0).mul_add(t85, t54.mul_add(t73, t81));
    // Eliminates around from row down: l[down, around].
    let t87 = t71 * t79;
    let t88 = t68.neg_mul_add(t73, t24.neg_mul_add(t64, t77));
    let t89 = n(p.k3).mul_add(t75.mul_sub(t7 * n(p.k1), t74) + t82, t88);
    // Row down: pivot d[down].
    let t90 = t79.neg_mul_add(t87, t26.neg_mul_add(t30, t84));
    // Row down: right-hand side z[down].
    let t91 = t87.neg_mul_add(t86, t89) / t90;
    // Back substitution: lambda[around].
    let t92 = t87.neg_mul_add(t91, t71 * t86);
    let t93 = t68.mul_add(t91, t44 * t73);
    // Back substitution: lambda[touching].
    let t94 = t29.mul_add(t92, t30.mul_add(t91, t25 * t28));
    let t95 = t54 * t92;
    let t96 = t14.mul_add(t92, t24.mul_add(t91, n(p.inverse_J) * t64));
    // Back substitution: a[x].
    let x_ddot = -t6.mul_add(t94, t8.neg_mul_add(t92, t15 * t91));
    // Back substitution: a[y].
    let y_ddot = -t8.mul_add(t94, t6.mul_add(t92, t16 * t91));
    // Back substitution: a[z].
    let z_ddot = -t10.mul_add(t94, t19.neg_mul_add(t91, n(p.g)));
    // Back substitution: a[c]; Back substitution: a[a].
    let a_ddot = t36.mul_sub(t93 - t95, t96);
    // Back substitution: a[b].
    let b_ddot = t50.mul_add(t92, t62.mul_add(t91, n(p.inverse_J) * t66));
    let c_ddot = t95 - t93;
    let sound = PIVOTS.hold(t22, t22)
        & PIVOTS.hold(t40, n(p.J))
        & PIVOTS.hold(t67, t65)
        & PIVOTS.hold(t90, t84)
        & a_ddot.is_finite();
    if !sound {
        let pivots = [
            (6, t22, t22),
            (5, t40, n(p.J)),
            (7, t67, t65),
            (8, t90, t84),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        x_ddot.store(),
        y_ddot.store(),
        z_ddot.store(),
        a_ddot.store(),
        b_ddot.store(),
        c_ddot.store(),
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
    let x = n(q[0]);
    let y = n(q[1]);
    let z = n(q[2]);
    let a_ = n(q[3]);
    let b = n(q[4]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let z_dot = n(v[2]);
    let a_dot = n(v[3]);
    let b_dot = n(v[4]);
    let c_dot = n(v[5]);
    let angles = [b, a_];
    let circular = N::sin_cos_all(angles);
    let (sin_b, cos_b) = circular[0];
    let (sin_a_, cos_a_) = circular[1];
    let t0 = x * n(p.k0);
    let t1 = y * n(p.k0);
    let t2 = z * x;
    let t3 = z * n(p.k0);
    let t4 = z * y;
    let t5 = b_dot * a_dot;
    // Eliminates x from row touching: l[touching, x]; Eliminates y from row around: l[around, y].
    let t6 = n(p.inverse_m) * t0;
    let t7 = y.mul_add(y, x * x);
    // Eliminates y from row touching: l[touching, y]; Eliminates x from row around: l[around, x].
    let t8 = n(p.inverse_m) * t1;
    let t9 = t2 * n(p.k5);
    // Eliminates z from row touching: l[touching, z].
    let t10 = n(p.inverse_m) * t3;
    let t11 = n(p.k3) * t2;
    let t12 = t4 * n(p.k3);
    let t13 = n(p.k3) * t7;
    // Eliminates a from row around: l[around, a].
    let t14 = n(p.inverse_J) * t9;
    // Eliminates x from row down: l[down, x].
    let t15 = n(p.inverse_m) * t11;
    // Eliminates y from row down: l[down, y].
    let t16 = n(p.inverse_m) * t12;
    let t17 = y.mul_add(t7, z * t4);
    let t18 = t1.mul_add(t8, t0 * t6);
    // Eliminates z from row down: l[down, z].
    let t19 = n(p.inverse_m) * t13;
    let t20 = x.mul_add(t7, z * t2);
    let t21 = n(p.k6) * t17;
    // Row touching: pivot d[touching].
    let t22 = t3.mul_add(t10, t18);
    let t23 = t8.mul_sub(t0, t1 * t6);
    // Eliminates a from row down: l[down, a].
    let t24 = n(p.inverse_J) * t21;
    let t25 = N::ONE / t22;
    let t26 = t19.mul_sub(t3, t16.mul_add(t1, t15 * t0));
    let t27 = z_dot.mul_add(z_dot, y_dot.mul_add(y_dot, x_dot * x_dot));
    // Row touching: right-hand side z[touching].
    let t28 = n(p.k0).mul_sub(t27, t10 * n(p.m_g));
    // Eliminates touching from row around: l[around, touching].
    let t29 = t25 * t23;
    // Eliminates touching from row down: l[down, touching].
    let t30 = t25 * t26;
    let t31 = t24.mul_add(t9, t16.mul_sub(t0, t15 * t1));
    let t32 = sin_b * n(p.J);
    let t33 = cos_b * c_dot;
    let t34 = sin_b * c_dot;
    let t35 = sin_a_ * cos_b;
    // Eliminates a from row c: l[c, a].
    let t36 = n(p.inverse_J) * t32;
    let t37 = t33 * a_dot;
    let t38 = b_dot * t34;
    let t39 = sin_a_.neg_mul_add(t33, cos_a_ * b_dot);
    // Row c: pivot d[c].
    let t40 = t32.neg_mul_add(t36, n(p.J));
    let t41 = cos_a_.mul_add(t33, sin_a_ * b_dot);
    let t42 = a_dot + t34;
    let t43 = n(p.k5) * t7.mul_sub(sin_a_, t4 * cos_a_);
    let t44 = N::ONE / t40;
    let t45 = t4.mul_add(t35, cos_b.mul_sub(t7 * cos_a_, t2 * sin_b));
    let t46 = n(p.k5).mul_add(t45, t32 * t14);
    let t47 = t33 * b_dot;
    let t48 = cos_a_.mul_sub(t5, cos_a_.mul_add(t38, sin_a_ * t37));
    let t49 = sin_a_.mul_add(t5, cos_a_.mul_sub(t37, sin_a_ * t38));
    // Eliminates b from row around: l[around, b].
    let t50 = n(p.inverse_J) * t43;
    let t51 = y.neg_mul_add(n(p.k2), x_dot);
    let t52 = n(p.k1).neg_mul_add(z.mul_sub(t39, y * t41), t51);
    let t53 = cos_a_ * (t20 * n(p.k6));
    // Eliminates c from row around: l[around, c].
    let t54 = t44 * t46;
    let t55 = z.neg_mul_add(t49, z_dot * t39);
    let t56 = x.mul_add(n(p.k2), y_dot);
    let t57 = n(p.k1).neg_mul_add(x.mul_sub(t41, z * t42), t56);
    let t58 = t55 - y.mul_add(t48, y_dot * t41);
    let t59 = n(p.k1).mul_add(t58, y_dot * n(p.k2));
    let t60 = x.mul_add(t48, x_dot * t41) - z.mul_add(t47, z_dot * t42);
    let t61 = n(p.k1).neg_mul_add(t60, x_dot * n(p.k2));
    // Eliminates b from row down: l[down, b].
    let t62 = t53 * n(p.inverse_J);
    let t63 = n(p.k6).mul_sub(t20.mul_add(t35, sin_b * t17), t32 * t24);
    let t64 = n(p.J) * t47;
    let t65 = t46.mul_add(t54, t18) + t43.mul_add(t50, t9 * t14);
    let t66 = n(p.J) * t37;
    // Row around: pivot d[around].
    let t67 = t23.neg_mul_add(t29, t65);
    // Eliminates c from row down: l[down, c].
    let t68 = t44 * t63;
    let t69 = x.neg_mul_add(t49, x_dot * t39);
    let t70 = n(p.k1).neg_mul_add(y.mul_sub(t42, x * t39), z_dot);
    let t71 = N::ONE / t67;
    let t72 = x.neg_mul_add(t59, x_dot * t52);
    // Row c: right-hand side z[c].
    let t73 = t36.neg_mul_add(t64, cos_b * (n(p.J) * t5));
    let t74 = t70 * (y.mul_add(y_dot, x * x_dot) * N::from_f64(2.0));
    let t75 = y.mul_add(t47, y_dot * t42) - t69;
    let t76 = y.mul_add(t61, y_dot * t57) + t72;
    let t77 = t62.neg_mul_add(t66, t30.mul_add(t28, t19 * n(p.m_g)));
    let t78 = t62.mul_add(t43, t23.neg_mul_add(t30, t31));
    let t79 = t68.neg_mul_add(t46, t78);
    let t80 = y.neg_mul_add(t59, y_dot * t52);
    let t81 = t50.neg_mul_add(t66, t14.neg_mul_add(t64, t29 * t28));
    let t82 = z.mul_add(t76, z_dot * y.mul_add(t57, x * t52));
    let t83 = t12.mul_add(t16, t11 * t15) + t53.mul_add(t62, t13 * t19);
    let t84 = t83 + t63.mul_add(t68, t21 * t24);
    let t85 = x.mul_add(t61, x_dot * t57) - t80;
    // Row around: right-hand side z[around].
    let t86 = n(p.k0).mul_add(t85, t54.mul_add(t73, t81));
    // Eliminates around from row down: l[down, around].
    let t87 = t71 * t79;
    let t88 = t68.neg_mul_add(t73, t24.neg_mul_add(t64, t77));
    let t89 = n(p.k3).mul_add(t75.mul_sub(t7 * n(p.k1), t74) + t82, t88);
    // Row down: pivot d[down].
    let t90 = t79.neg_mul_add(t87, t26.neg_mul_add(t30, t84));
    // Row down: right-hand side z[down].
    let t91 = t87.neg_mul_add(t86, t89) / t90;
    // Back substitution: lambda[around].
    let lambda2 = t87.neg_mul_add(t91, t71 * t86);
    // Back substitution: lambda[touching].
    let lambda1 = t29.mul_add(lambda2, t30.mul_add(t91, t25 * t28));
    let lambda3 = -t91;
    let sound = PIVOTS.hold(t22, t22)
        & PIVOTS.hold(t40, n(p.J))
        & PIVOTS.hold(t67, t65)
        & PIVOTS.hold(t90, t84)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (6, t22, t22),
            (5, t40, n(p.J)),
            (7, t67, t65),
            (8, t90, t84),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store(), lambda3.store()];
    Ok(multipliers)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*m*der(z)^2 + 1/2*J*der(a)^2 + J*sin(b)*der(a)*der(c)
///     + 1/2*J*der(b)^2 + 1/2*J*der(c)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> S {
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = cos_b * a_dot;
    let t1 = sin_b * a_dot + c_dot;
    let t2 = cos_b * x_dot - sin_b * z_dot;
    let t3 = cos_b * z_dot + sin_b * x_dot;
    let t4 = (t1 * t1 + (b_dot * b_dot + t0 * t0)) * p.J;
    ((t3 * t3 + (t2 * t2 + y_dot * y_dot)) * p.m + t4) * S::from_f64(0.5)
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

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = m*der(x)*der(der(x)) + m*der(y)*der(der(y)) + m*der(z)*der(der(z)) + J*der(a)*der(der(a))
///     + J*der(b)*der(der(b)) + J*sin(b)*der(a)*der(der(c))
///     - der(c)*(-J*sin(b)*der(der(a)) - J*der(der(c)) - J*cos(b)*der(a)*der(b)) + m*g*der(z)
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
    a: &[S; 6],
) -> S {
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let z_ddot = a[2];
    let a_ddot = a[3];
    let b_ddot = a[4];
    let c_ddot = a[5];
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = b_dot * a_dot;
    let t1 = cos_b * (sin_b * t0 - b_dot * (sin_b * a_dot - c_dot));
    let t2 = c_dot * (sin_b * a_ddot + (cos_b * t0 + c_ddot));
    let t3 = t2 + b_dot * (b_ddot - cos_b * (c_dot * a_dot));
    let t4 = p.m * (y_ddot * y_dot + x_ddot * x_dot) + (p.m * z_ddot + p.m_g) * z_dot;
    (a_dot * (t1 + (a_ddot + sin_b * c_ddot)) + t3) * p.J + t4
}

::lagrangian::emitted::implement! {
    machine BallInBowl "BallInBowl" over S, R;
    parameters { m, r, J, R, Omega, g } [
        m: "m" "kg" = 0.3;
        r: "r" "m" = 0.05;
        J: "J" "kg*m^2" = 0.0003;
        R: "R" "m" = 0.55;
        Omega: "Omega" "rad/s" = 2.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 6 Coordinates { x, y, z, a, b, c } [
        x: "x" "m";
        y: "y" "m";
        z: "z" "m";
        a: "a" "rad";
        b: "b" "rad";
        c: "c" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, J, g, k0, k1, k2, k3, k4, k5, m_g, k6, minus_J, minus_m_g, k7, k8, k9, k10, inverse_J,
        inverse_m,
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
        number work_rate(p, t, q, v, a, u) = work_rate(p, q, v, a);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [
            ("touching", "m", "N", true),
            ("around", "m/s", "N", false),
            ("down", "m/s", "N", false),
        ];
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(6, 3);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
