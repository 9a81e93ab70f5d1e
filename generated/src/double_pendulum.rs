// @generated from machines/double_pendulum.machine by `cargo xtask generate`; edits are lost.

//! Two point masses on massless rods, hanging one from the other. Angles are absolute, from the
//! downward vertical. From large angles the motion is chaotic; energy is conserved throughout.
//!
//! 2 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 14 | 6 | 1 | 0 | 0 | 21 |
//! | `start` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `mass_matrix` | 3 | 1 | 0 | 2 | 0 | 8 |
//! | `bias` | 8 | 1 | 0 | 2 | 0 | 13 |
//! | `applied` | 2 | 0 | 0 | 2 | 0 | 4 |
//! | `forces` | 12 | 4 | 0 | 2 | 0 | 20 |
//! | `accelerations` | 18 | 8 | 1 | 2 | 0 | 31 |
//! | `kinetic_energy` | 11 | 4 | 0 | 2 | 0 | 19 |
//! | `potential_energy` | 4 | 3 | 0 | 2 | 0 | 9 |
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

/// Two point masses on massless rods, hanging one from the other. Angles are absolute, from the
/// downward vertical. From large angles the motion is chaotic; energy is conserved throughout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum<S = f64> {
    /// Mass of the upper and of the lower bob. Unit: `kg`. Default: 1.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// Length of the upper and of the lower rod. Unit: `m`. Default: 1.
    pub l1: S,
    /// `l2`. Unit: `m`. Default: 1.
    pub l2: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> DoublePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l1 * self.l1;
        let t1 = self.g * self.m1;
        let m2_g = self.g * self.m2;
        let t2 = self.l2 * self.m2;
        let t3 = self.m1 * t0;
        let m2_l1_l2 = self.l1 * t2;
        let m2_l2_g = self.g * t2;
        let pivot_0 = t3 + self.m2 * t0;
        let m1_l1_g = self.l1 * t1;
        let half_m1_l1_squared = t3 * S::from_f64(0.5);
        let half_m2 = self.m2 * S::from_f64(0.5);
        let k0 = t0 * (self.m1 + self.m2);
        let m2_l2_squared = self.l2 * t2;
        let minus_m2_l1_l2 = -m2_l1_l2;
        let k1 = -(self.l1 * (t1 + m2_g));
        let minus_m2_l2_g = -m2_l2_g;
        let k2 = S::ONE / pivot_0;
        let c0 = self.g;
        let c1 = self.l1;
        let c2 = -c1;
        let c3 = self.l2;
        let c4 = -c3;
        let c5 = self.m1;
        let c6 = -c5;
        let c7 = self.m2;
        let c8 = -c7;
        let c9 = c5 * c1;
        let c10 = c7 * c3;
        let pivots = [(0, pivot_0, pivot_0)];
        Prepared {
            l1: self.l1,
            l2: self.l2,
            m1_l1_g,
            m2_g,
            half_m1_l1_squared,
            half_m2,
            m2_l1_l2,
            k0,
            m2_l2_squared,
            m2_l2_g,
            minus_m2_l1_l2,
            k1,
            minus_m2_l2_g,
            k2,
            singular: PIVOTS.vanished(pivots),
            series: [c0, c2, c1, c3, c4, c6, c8, c9, c7, c10],
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta1 = S::pi() * S::from_ratio(2, 3);
        let theta2 = S::pi() * S::from_f64(0.5);
        let q = [theta1, theta2];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`DoublePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `theta1`. Unit: `rad`.
    pub theta1: S,
    /// `theta2`. Unit: `rad`.
    pub theta2: S,
}

/// The parameters of a [`DoublePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l1`
    l1: S,
    /// `l2`
    l2: S,
    /// `m1*l1*g`
    m1_l1_g: S,
    /// `m2*g`
    m2_g: S,
    /// `0.5*m1*l1^2`
    half_m1_l1_squared: S,
    /// `0.5*m2`
    half_m2: S,
    /// `m2*l1*l2`
    m2_l1_l2: S,
    /// `l1^2*(m1 + m2)`
    k0: S,
    /// `m2*l2^2`
    m2_l2_squared: S,
    /// `m2*l2*g`
    m2_l2_g: S,
    /// `-m2*l1*l2`
    minus_m2_l1_l2: S,
    /// `-l1*(m2*g + m1*g)`
    k1: S,
    /// `-m2*l2*g`
    minus_m2_l2_g: S,
    /// `1/(m1*l1^2 + m2*l1^2)`
    k2: S,
    /// What the Taylor series takes from the parameters.
    series: [S; 10],
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[theta1, theta1] = m1*l1^2 + m2*l1^2
/// M[theta2, theta1] = m2*l1*l2*cos(theta2 - theta1)
/// M[theta2, theta2] = m2*l2^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let m21 = (cos_theta2 * cos_theta1 + sin_theta2 * sin_theta1) * p.m2_l1_l2;
    [[p.k0, m21], [m21, p.m2_l2_squared]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta1] = -m2*l1*l2*sin(theta2 - theta1)*der(theta2)^2
/// h[theta2] = m2*l1*l2*sin(theta2 - theta1)*der(theta1)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let t0 = cos_theta2 * sin_theta1 - sin_theta2 * cos_theta1;
    let h_theta1 = t0 * (theta2_dot * (theta2_dot * p.m2_l1_l2));
    let h_theta2 = t0 * (theta1_dot * (p.minus_m2_l1_l2 * theta1_dot));
    [h_theta1, h_theta2]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta1] = -(m1 + m2)*l1*g*sin(theta1)
/// Q[theta2] = -m2*l2*g*sin(theta2)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let sin_theta1 = theta1.sin();
    let sin_theta2 = theta2.sin();
    let q_theta1 = p.k1 * sin_theta1;
    let q_theta2 = p.minus_m2_l2_g * sin_theta2;
    [q_theta1, q_theta2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let t0 = theta2_dot * theta2_dot;
    let t1 = theta1_dot * theta1_dot;
    let t2 = sin_theta2 * (cos_theta1 * p.m2_l1_l2);
    let t3 = cos_theta2 * (sin_theta1 * p.m2_l1_l2);
    let f_theta1 = t0 * t2 - (t0 * t3 - sin_theta1 * p.k1);
    let f_theta2 = t1 * t3 - (sin_theta2 * p.m2_l2_g + t1 * t2);
    [f_theta1, f_theta2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 2], v: &'a [S; 2] })
        -> Result<[S; 2], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta1 = n(q[0]);
    let theta2 = n(q[1]);
    let theta1_dot = n(v[0]);
    let theta2_dot = n(v[1]);
    let angles = [theta2, theta1];
    let circular = N::sin_cos_all(angles);
    let (sin_theta2, cos_theta2) = circular[0];
    let (sin_theta1, cos_theta1) = circular[1];
    let t0 = cos_theta2.mul_sub(sin_theta1, sin_theta2 * cos_theta1);
    let t1 = sin_theta2.mul_add(sin_theta1, cos_theta2 * cos_theta1);
    let t2 = n(p.m2_l1_l2) * t1;
    let t3 = theta2_dot * (n(p.m2_l1_l2) * theta2_dot);
    let t4 = t3.mul_sub(t0, sin_theta1 * n(p.k1));
    let t5 = theta1_dot * (n(p.m2_l1_l2) * theta1_dot);
    // Eliminates theta1 from row theta2: l[theta2, theta1].
    let t6 = t2 * n(p.k2);
    let t7 = t5.neg_mul_add(t0, sin_theta2 * n(p.m2_l2_g));
    // Row theta2: pivot d[theta2].
    let t8 = t2.neg_mul_add(t6, n(p.m2_l2_squared));
    // Row theta2: right-hand side z[theta2].
    let t9 = t4.neg_mul_add(t6, t7) / t8;
    // Back substitution: a[theta1].
    let theta1_ddot = t6.mul_sub(t9, t4 * n(p.k2));
    let theta2_ddot = -t9;
    let sound = PIVOTS.hold(t8, n(p.m2_l2_squared)) & theta2_ddot.is_finite();
    if !sound {
        let pivots = [(1, t8, n(p.m2_l2_squared))];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [theta1_ddot.store(), theta2_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m1 + m2)*l1^2*der(theta1)^2 + m2*l1*l2*cos(theta2 - theta1)*der(theta1)*der(theta2)
///     + 1/2*m2*l2^2*der(theta2)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let t0 = theta1_dot * p.l1;
    let t1 = theta2_dot * p.l2;
    let t2 = t1 * cos_theta2 + t0 * cos_theta1;
    let t3 = t1 * sin_theta2 + t0 * sin_theta1;
    let t4 = theta1_dot * (theta1_dot * p.half_m1_l1_squared);
    p.half_m2 * (t3 * t3 + t2 * t2) + t4
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -(m1 + m2)*l1*g*cos(theta1) - m2*l2*g*cos(theta2)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta1 = q[0];
    let theta2 = q[1];
    let cos_theta1 = theta1.cos();
    let cos_theta2 = theta2.cos();
    let t0 = p.m2_g * (cos_theta2 * p.l2 + cos_theta1 * p.l1);
    -(t0 + cos_theta1 * p.m1_l1_g)
}

/// The coefficients of which products are made, order by order, while the Taylor series is
/// computed. What they hold before that does not matter.
pub struct Lists<S> {
    a0: ::lagrangian::emitted::series::Pack<S, 8>,
    b0: ::lagrangian::emitted::series::Pack<S, 8>,
}

impl<S: Copy + Default> Default for Lists<S> {
    fn default() -> Self {
        Self {
            a0: Default::default(),
            b0: Default::default(),
        }
    }
}

::lagrangian::emitted::fast_function! {
    /// The Taylor series of the motion through a state: row `j` of `coefficients` becomes
    /// `q⁽ʲ⁾/j!`. The time is the sum of two numbers.
    pub struct Series<'a, S> {
        p: &'a Prepared<S>,
        q: &'a [S; 2],
        v: &'a [S; 2],
        lists: &'a mut Lists<S>,
        coefficients: &'a mut [[S; 2]],
    } -> Result<(), ::lagrangian::emitted::Singular> = series_in;
}

#[inline(always)]
fn series_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Series<'_, S>,
) -> Result<(), ::lagrangian::emitted::Singular> {
    let Series {
        p,
        q,
        v,
        lists,
        coefficients,
    } = call;
    let n = N::load;
    let x0 = n(q[0]);
    let x1 = n(q[1]);
    let angles2 = [x0, x1];
    let x2 = N::sin_cos_all(angles2);
    let x3 = x2[0].0;
    let x4 = x2[0].1;
    let x5 = x2[1].0;
    let x6 = x2[1].1;
    let x7 = n(v[0]);
    let x8 = x7 * x4;
    let x9 = x7 * x3;
    let x10 = -x9;
    let x11 = n(v[1]);
    let x12 = x11 * x6;
    let x13 = x11 * x5;
    let x14 = -x13;
    let x15 = x7 * x10;
    let x17 = N::from_f64(0.5);
    let x18 = x17 * x15;
    let x19 = x7 * x8;
    let x20 = -x19;
    let x21 = x17 * x20;
    let x22 = x11 * x14;
    let x23 = x17 * x22;
    let x24 = x11 * x12;
    let x25 = -x24;
    let x26 = x17 * x25;
    let x27 = n(p.series[0]);
    let x28 = n(p.series[1]);
    let x29 = x28.mul_add(x20, x27);
    let x30 = n(p.series[2]);
    let x31 = x30 * x15;
    let x32 = n(p.series[3]);
    let x33 = x32.mul_add(x22, x31);
    let x34 = x28 * x20;
    let x35 = n(p.series[4]);
    let x36 = x35.mul_add(x25, x34);
    let x37 = x27 + x36;
    let x38 = n(p.series[5]);
    let x39 = x38 * x29;
    let x40 = n(p.series[6]);
    let x41 = x40.mul_add(x37, x39);
    let x42 = n(p.series[7]);
    let x43 = x42 * x15;
    let x44 = n(p.series[8]);
    let x45 = x44.mul_add(x33, x43);
    let x46 = x3 * x41;
    let x47 = x4 * x45;
    let x48 = x30 * x47;
    let x49 = x28.mul_add(x46, x48);
    let x50 = x5 * x37;
    let x51 = x6 * x33;
    let x52 = n(p.series[9]);
    let x53 = x52 * x51;
    let x54 = x52.mul_add(x50, x53);
    let x55 = -x3;
    let x56 = x28 * x55;
    let x57 = -x5;
    let x58 = x30 * x4;
    let x59 = x32 * x6;
    let x60 = x35 * x57;
    let x61 = x38 * x56;
    let x62 = x40.mul_add(x56, x61);
    let x63 = x40 * x60;
    let x64 = x42 * x4;
    let x65 = x44.mul_add(x58, x64);
    let x66 = x44 * x59;
    let x67 = x3 * x62;
    let x68 = x3 * x63;
    let x69 = x4 * x65;
    let x70 = x4 * x66;
    let x71 = x30 * x69;
    let x72 = x30 * x70;
    let x73 = x28.mul_add(x67, x71);
    let x74 = x28.mul_add(x68, x72);
    let x75 = x5 * x56;
    let x76 = x5 * x60;
    let x77 = x6 * x58;
    let x78 = x6 * x59;
    let x79 = x52 * x77;
    let x80 = x52 * x78;
    let x81 = x52.mul_add(x75, x79);
    let x82 = x52.mul_add(x76, x80);
    let mut x83 = [x73.store(), x74.store(), x81.store(), x82.store()];
    let members83 = [0, 1];
    let factored = ::lagrangian::emitted::series::factor::<N>(2, 2, &mut x83);
    if let Err(vanished) = factored {
        let singular = ::lagrangian::emitted::series::singular(vanished, &members83, 2);
        return Err(singular);
    }
    let x84 = n(x83[0]);
    let x85 = -x84;
    let x86 = n(x83[2]);
    let x87 = -x86;
    let x88 = x52 * x87;
    let x89 = x6 * x88;
    let x90 = x5 * x88;
    let x91 = x30 * x85;
    let x92 = x28 * x85;
    let x93 = x4 * x91;
    let x94 = x3 * x92;
    let x95 = x42 * x93;
    let x96 = x44.mul_add(x93, x89);
    let x97 = x38 * x94;
    let x98 = x40.mul_add(x94, x90);
    let x99 = x28 * x98;
    let x100 = x35 * x98;
    let x101 = x30.mul_add(x96, x95);
    let x102 = x32 * x96;
    let x103 = x28.mul_add(x97, x99);
    let x104 = n(x83[1]);
    let x105 = -x104;
    let x106 = n(x83[3]);
    let x107 = -x106;
    let x108 = x52 * x107;
    let x109 = x6 * x108;
    let x110 = x5 * x108;
    let x111 = x30 * x105;
    let x112 = x28 * x105;
    let x113 = x4 * x111;
    let x114 = x3 * x112;
    let x115 = x42 * x113;
    let x116 = x44.mul_add(x113, x109);
    let x117 = x38 * x114;
    let x118 = x40.mul_add(x114, x110);
    let x119 = x28 * x118;
    let x120 = x35 * x118;
    let x121 = x30.mul_add(x116, x115);
    let x122 = x32 * x116;
    let x123 = x28.mul_add(x117, x119);
    let x124 = -x49;
    let x125 = -x54;
    let x126 = x84 * x124;
    let x127 = x86.mul_add(x125, x126);
    let x128 = x104 * x124;
    let x129 = x106.mul_add(x125, x128);
    let x130 = x127 * x17;
    let x131 = x129 * x17;
    let x132 = x58.mul_add(x127, x33);
    let x133 = x59.mul_add(x129, x132);
    let x134 = x56.mul_add(x127, x37);
    let x135 = x60.mul_add(x129, x134);
    let x136 = x62.mul_add(x127, x41);
    let x137 = x63.mul_add(x129, x136);
    let x138 = x65.mul_add(x127, x45);
    let x139 = x66.mul_add(x129, x138);
    let x140 = x4 * x17;
    let x141 = x140.mul_add(x127, x18);
    let x142 = x55 * x17;
    let x143 = x142.mul_add(x127, x21);
    let x144 = x6 * x17;
    let x145 = x144.mul_add(x129, x23);
    let x146 = x57 * x17;
    let x147 = x146.mul_add(x129, x26);
    let second = [x130.store(), x131.store()];
    for (row, x) in coefficients.iter_mut().zip([*q, *v, second]) {
        *row = x;
    }
    const A0: [usize; 8] = [0, 0, 1, 1, 2, 3, 4, 5];
    const B0: [usize; 8] = [0, 1, 2, 3, 1, 0, 3, 2];
    ::lagrangian::emitted::series::keep::<N, 8, 8>(
        &mut lists.a0.0,
        2,
        [
            x127.store(),
            x127.store(),
            x129.store(),
            x129.store(),
            x137.store(),
            x139.store(),
            x135.store(),
            x133.store(),
        ],
        &A0,
    );
    ::lagrangian::emitted::series::keep::<N, 8, 8>(
        &mut lists.b0.0,
        2,
        [
            x143.store(),
            x141.store(),
            x147.store(),
            x145.store(),
            x141.store(),
            x143.store(),
            x145.store(),
            x147.store(),
        ],
        &B0,
    );
    let mut y6 = x141;
    let mut y7 = x143;
    let mut y15 = x145;
    let mut y16 = x147;
    let mut y18 = x133;
    let mut y22 = x135;
    let mut y25 = x137;
    let mut y26 = x139;
    let mut acceleration0 = x127;
    let mut acceleration1 = x129;
    let count = coefficients.len().min(::lagrangian::emitted::series::ROWS);
    for order in 3..count {
        let w0 = ::lagrangian::emitted::series::sweep::<N, 8, 8>(
            [&lists.a0.0, &lists.b0.0],
            order - 2,
            [&A0, &B0],
        );
        let x148 = w0[0];
        let x149 = acceleration0;
        let x150 = N::from_ratio(1, order as i64 - 2);
        let x151 = x149 * x150;
        let x152 = x151.mul_add(x10, x148);
        let x153 = y7;
        let x154 = x7.mul_add(x153, x152);
        let x156 = N::from_ratio(1, order as i64);
        let x157 = x156 * x154;
        let x158 = w0[1];
        let x159 = x151.mul_add(x8, x158);
        let x160 = y6;
        let x161 = x7.mul_add(x160, x159);
        let x162 = -x161;
        let x163 = x156 * x162;
        let x164 = w0[2];
        let x165 = acceleration1;
        let x166 = x165 * x150;
        let x167 = x166.mul_add(x14, x164);
        let x168 = y16;
        let x169 = x11.mul_add(x168, x167);
        let x170 = x156 * x169;
        let x171 = w0[3];
        let x172 = x166.mul_add(x12, x171);
        let x173 = y15;
        let x174 = x11.mul_add(x173, x172);
        let x175 = -x174;
        let x176 = x156 * x175;
        let x177 = N::from_f64((order - 1) as f64);
        let x180 = x28 * x177;
        let x181 = x180 * x162;
        let x183 = x30 * x177;
        let x184 = x183 * x154;
        let x185 = x32 * x177;
        let x186 = x185.mul_add(x169, x184);
        let x188 = x35 * x177;
        let x189 = x188.mul_add(x175, x181);
        let x190 = x38 * x181;
        let x191 = x40.mul_add(x189, x190);
        let x192 = x42 * x177;
        let x193 = x192 * x154;
        let x194 = x44.mul_add(x186, x193);
        let x195 = w0[4];
        let x196 = y25;
        let x197 = x196.mul_add(x8, x195);
        let x199 = w0[5];
        let x200 = y26;
        let x201 = x200.mul_add(x10, x199);
        let x205 = w0[6];
        let x206 = y22;
        let x207 = x206.mul_add(x12, x205);
        let x209 = w0[7];
        let x210 = y18;
        let x211 = x210.mul_add(x14, x209);
        let x215 = x92 * x197;
        let x216 = x91 * x201;
        let x217 = x207 + x211;
        let x218 = x88.mul_add(x217, x215);
        let x219 = x101 * x177;
        let x220 = x219.mul_add(x154, x216);
        let x221 = x103 * x177;
        let x222 = x221.mul_add(x162, x218);
        let x223 = x102 * x177;
        let x224 = x223.mul_add(x169, x220);
        let x225 = x100 * x177;
        let x226 = x225.mul_add(x175, x222);
        let x227 = x226 + x224;
        let x228 = x112 * x197;
        let x229 = x111 * x201;
        let x230 = x108.mul_add(x217, x228);
        let x231 = x121 * x177;
        let x232 = x231.mul_add(x154, x229);
        let x233 = x123 * x177;
        let x234 = x233.mul_add(x162, x230);
        let x235 = x122 * x177;
        let x236 = x235.mul_add(x169, x232);
        let x237 = x120 * x177;
        let x238 = x237.mul_add(x175, x234);
        let x239 = x238 + x236;
        let x240 = N::from_ratio(1, order as i64 - 1);
        let x241 = N::divisor(order as i64 * (order as i64 - 1));
        let x242 = x227 * x240;
        let x243 = x227.over(x241);
        let x244 = x239 * x240;
        let x245 = x239.over(x241);
        let x246 = x240 * x156;
        let x247 = x58.mul_add(x227, x186);
        let x248 = x59.mul_add(x239, x247);
        let x249 = x56.mul_add(x227, x189);
        let x250 = x60.mul_add(x239, x249);
        let x251 = x62.mul_add(x227, x191);
        let x252 = x63.mul_add(x239, x251);
        let x253 = x65.mul_add(x227, x194);
        let x254 = x66.mul_add(x239, x253);
        let x255 = x4 * x246;
        let x256 = x255.mul_add(x227, x157);
        let x257 = x55 * x246;
        let x258 = x257.mul_add(x227, x163);
        let x259 = x6 * x246;
        let x260 = x259.mul_add(x239, x170);
        let x261 = x57 * x246;
        let x262 = x261.mul_add(x239, x176);
        if let Some(row) = coefficients.get_mut(order) {
            *row = [x243.store(), x245.store()];
        }
        ::lagrangian::emitted::series::keep::<N, 8, 8>(
            &mut lists.a0.0,
            order,
            [
                x242.store(),
                x242.store(),
                x244.store(),
                x244.store(),
                x252.store(),
                x254.store(),
                x250.store(),
                x248.store(),
            ],
            &A0,
        );
        ::lagrangian::emitted::series::keep::<N, 8, 8>(
            &mut lists.b0.0,
            order,
            [
                x258.store(),
                x256.store(),
                x262.store(),
                x260.store(),
                x256.store(),
                x258.store(),
                x260.store(),
                x262.store(),
            ],
            &B0,
        );
        y6 = x256;
        y7 = x258;
        y15 = x260;
        y16 = x262;
        y18 = x248;
        y22 = x250;
        y25 = x252;
        y26 = x254;
        acceleration0 = x227;
        acceleration1 = x239;
    }
    Ok(())
}

::lagrangian::emitted::implement! {
    machine DoublePendulum "DoublePendulum" over S, R;
    parameters { m1, m2, l1, l2, g } [
        m1: "m1" "kg" = 1.0;
        m2: "m2" "kg" = 1.0;
        l1: "l1" "m" = 1.0;
        l2: "l2" "m" = 1.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { theta1, theta2 } [
        theta1: "theta1" "rad";
        theta2: "theta2" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        l1, l2, m1_l1_g, m2_g, half_m1_l1_squared, half_m2, m2_l1_l2, k0, m2_l2_squared, m2_l2_g,
        minus_m2_l1_l2, k1, minus_m2_l2_g, k2,
    }
    series series
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        series_in_lists series(p, t, q, v, u, lists, coefficients) = Series {
            p,
            q,
            v,
            lists,
            coefficients,
        };
        costs series_cost(p) = [5.6, 8.4];
        boolean series_may_branch(p) = false;
        boolean has_powers(p) = false;
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    batch_series {
        Lists<::lagrangian::emitted::Lanes<N>>;
        (p, t, q, v, u, lists, coefficients) Series {
            p,
            q,
            v,
            lists,
            coefficients,
        }
    }
    lanes [N]
    numbers [yes]
}
