// @generated from machines/asymmetric_top.machine by `cargo xtask generate`; edits are lost.

//! A rigid body with three different moments of inertia, on which nothing acts: a book thrown
//! into the air, seen from its mass centre.
//!
//! Conserved: energy, and the angular momentum as a vector of the ground. Its components along
//! the body's own axes obey Euler's equations, which Jacobi's elliptic functions solve (L. D.
//! Landau, E. M. Lifshitz, Mechanics, section 37). Turning about the axis of the least moment
//! and about that of the greatest is steady. About the middle one, here z, it is not (L.
//! Poinsot, 1834): a body spun about z tumbles over, again and again after the same time (V.
//! Dzhanibekov, 1985), and the smaller the first wobble the longer that takes.
//!
//! The angles are yaw, pitch and roll. They fail where pitch is a right angle: there the body's
//! x axis is vertical, and yaw and roll turn about one line. A body spun about the vertical
//! that starts with its z axis or its y axis near to it never gets there, however it tumbles:
//! its x axis would have to carry all of the angular momentum.
//!
//! 3 coordinates, 4 parameters, 4 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 3 | 6 | 1 | 0 | 0 | 10 |
//! | `mass_matrix` | 9 | 3 | 0 | 2 | 0 | 16 |
//! | `bias` | 25 | 12 | 0 | 2 | 0 | 41 |
//! | `forces` | 28 | 11 | 0 | 2 | 0 | 43 |
//! | `accelerations` | 54 | 19 | 2 | 2 | 0 | 79 |
//! | `kinetic_energy` | 13 | 5 | 0 | 2 | 0 | 22 |
//! | `output_momentum_x` | 18 | 7 | 0 | 3 | 0 | 31 |
//! | `output_momentum_y` | 18 | 7 | 0 | 3 | 0 | 31 |
//! | `output_momentum_z` | 13 | 5 | 0 | 2 | 0 | 22 |
//! | `output_upright` | 1 | 0 | 0 | 2 | 0 | 3 |
//! | `assumption_0` | 0 | 0 | 0 | 1 | 0 | 1 |
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

/// A rigid body with three different moments of inertia, on which nothing acts: a book thrown
/// into the air, seen from its mass centre.
///
/// Conserved: energy, and the angular momentum as a vector of the ground. Its components along
/// the body's own axes obey Euler's equations, which Jacobi's elliptic functions solve (L. D.
/// Landau, E. M. Lifshitz, Mechanics, section 37). Turning about the axis of the least moment
/// and about that of the greatest is steady. About the middle one, here z, it is not (L.
/// Poinsot, 1834): a body spun about z tumbles over, again and again after the same time (V.
/// Dzhanibekov, 1985), and the smaller the first wobble the longer that takes.
///
/// The angles are yaw, pitch and roll. They fail where pitch is a right angle: there the body's
/// x axis is vertical, and yaw and roll turn about one line. A body spun about the vertical
/// that starts with its z axis or its y axis near to it never gets there, however it tumbles:
/// its x axis would have to carry all of the angular momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsymmetricTop<S = f64> {
    /// Mass. Nothing depends on it, since nothing weighs. Unit: `kg`. Default: 2.
    pub m: S,
    /// Moments of inertia about the body's x, y and z axes: the least, the greatest, the
    /// middle one. Unit: `kg*m^2`. Default: 0.02.
    pub A: S,
    /// `B`. Unit: `kg*m^2`. Default: 0.04.
    pub B: S,
    /// `C`. Unit: `kg*m^2`. Default: 0.03.
    pub C: S,
}

impl<S: ::lagrangian::emitted::Scalar> AsymmetricTop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let B_minus_C = self.B - self.C;
        let A_minus_B = self.A - self.B;
        let A_minus_C = self.A - self.C;
        let A_plus_B_minus_C = self.A + B_minus_C;
        let k0 = B_minus_C * S::from_f64(2.0);
        let k1 = A_minus_B * S::from_f64(2.0);
        let A_minus_B_plus_C = self.A - B_minus_C;
        let minus_A = -self.A;
        let inverse_A = S::ONE / self.A;
        let k2 = B_minus_C * B_minus_C;
        let pivots = [(2, self.A, self.A)];
        Prepared {
            A: self.A,
            B: self.B,
            C: self.C,
            B_minus_C,
            A_minus_C,
            A_minus_B,
            A_plus_B_minus_C,
            k0,
            k1,
            A_minus_B_plus_C,
            minus_A,
            inverse_A,
            k2,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let roll = S::from_ratio(1, 100);
        let q = [zero, zero, roll];
        let v = [S::from_f64(10.0), zero, zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`AsymmetricTop`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Turn about the vertical, then about the body's y axis, then about its x axis.
    /// Spun about the middle axis, but for a wobble of a hundredth. Unit: `rad`.
    pub yaw: S,
    /// `pitch`. Unit: `rad`.
    pub pitch: S,
    /// `roll`. Unit: `rad`.
    pub roll: S,
}

/// What can be observed of a [`AsymmetricTop`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum along the ground's axes: conserved. Unit: `J*s`.
    pub momentum_x: S,
    /// `momentum_y`. Unit: `J*s`.
    pub momentum_y: S,
    /// `momentum_z`. Unit: `J*s`.
    pub momentum_z: S,
    /// Cosine of the angle between the body's z axis and the vertical: -1 where it stands
    /// on its head. Unit: `1`.
    pub upright: S,
}

/// The parameters of a [`AsymmetricTop`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `A`
    A: S,
    /// `B`
    B: S,
    /// `C`
    C: S,
    /// `B - C`
    B_minus_C: S,
    /// `A - C`
    A_minus_C: S,
    /// `A - B`
    A_minus_B: S,
    /// `A + B - C`
    A_plus_B_minus_C: S,
    /// `2*(B - C)`
    k0: S,
    /// `2*(A - B)`
    k1: S,
    /// `A - B + C`
    A_minus_B_plus_C: S,
    /// `-A`
    minus_A: S,
    /// `1/A`
    inverse_A: S,
    /// `(B - C)^2`
    k2: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 3);

/// Mass matrix `M`.
///
/// ```text
/// M[yaw, yaw] = A*sin(pitch)^2 + C*cos(roll)^2*cos(pitch)^2 + B*sin(roll)^2*cos(pitch)^2
/// M[pitch, yaw] = -(C - B)*cos(roll)*sin(roll)*cos(pitch)
/// M[pitch, pitch] = B*cos(roll)^2 + C*sin(roll)^2
/// M[roll, yaw] = -A*sin(pitch)
/// M[roll, roll] = A
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let pitch = q[1];
    let roll = q[2];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let t0 = cos_pitch * cos_roll;
    let t1 = t0 * p.B_minus_C;
    let m11 = p.A - cos_pitch * (cos_pitch * p.A_minus_B) - t0 * t1;
    let m21 = sin_roll * t1;
    let m22 = cos_roll * (cos_roll * p.B_minus_C) + p.C;
    let m31 = sin_pitch * p.minus_A;
    let zero = S::ZERO;
    [[m11, m21, m31], [m21, m22, zero], [m31, zero, p.A]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[yaw] = 2*A*sin(pitch)*cos(pitch)*der(yaw)*der(pitch)
///     - 2*C*sin(pitch)*cos(roll)^2*cos(pitch)*der(yaw)*der(pitch)
///     - 2*B*sin(pitch)*sin(roll)^2*cos(pitch)*der(yaw)*der(pitch)
///     + 2*(B - C)*cos(roll)*sin(roll)*cos(pitch)^2*der(yaw)*der(roll)
///     - (B - C)*sin(pitch)*cos(roll)*sin(roll)*der(pitch)^2
///     + (B - C)*cos(pitch)*cos(2*roll)*der(pitch)*der(roll) - A*cos(pitch)*der(pitch)*der(roll)
/// h[pitch] = C*sin(pitch)*cos(roll)^2*cos(pitch)*der(yaw)^2
///     + B*sin(pitch)*sin(roll)^2*cos(pitch)*der(yaw)^2 - A*sin(pitch)*cos(pitch)*der(yaw)^2
///     + (B - C)*cos(pitch)*cos(2*roll)*der(yaw)*der(roll) + A*cos(pitch)*der(yaw)*der(roll)
///     - 2*(B - C)*cos(roll)*sin(roll)*der(pitch)*der(roll)
/// h[roll] = (C - B)*(sin(roll)*cos(pitch)*der(yaw) +
///     cos(roll)*der(pitch))*(cos(roll)*cos(pitch)*der(yaw) - sin(roll)*der(pitch))
///     - A*cos(pitch)*der(yaw)*der(pitch)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let t0 = p.k0 * cos_roll;
    let t1 = cos_roll * p.B_minus_C;
    let t2 = sin_pitch * yaw_dot;
    let t3 = cos_pitch * yaw_dot;
    let t4 = cos_roll * t0;
    let t5 = sin_roll * t1;
    let t6 = t0 * (roll_dot * sin_roll);
    let t7 = pitch_dot * t5;
    let t8 = t4 + p.A_minus_B_plus_C;
    let t9 = t3 * (t2 * (p.A_minus_B + cos_roll * t1) - roll_dot * t8);
    let t10 = cos_pitch * (roll_dot * (t4 - p.A_plus_B_minus_C) + t2 * (t4 + p.k1));
    let h_yaw = pitch_dot * (t10 - sin_pitch * t7) + t6 * (cos_pitch * t3);
    let h_pitch = -(t9 + pitch_dot * t6);
    let h_roll = pitch_dot * t7 - t3 * (pitch_dot * t8 + t5 * t3);
    [h_yaw, h_pitch, h_roll]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let t0 = yaw_dot * pitch_dot;
    let t1 = cos_pitch * sin_roll;
    let t2 = roll_dot - sin_pitch * yaw_dot;
    let t3 = sin_pitch * t0;
    let t4 = cos_pitch * cos_roll;
    let t5 = yaw_dot * t1 + cos_roll * pitch_dot;
    let t6 = sin_roll * pitch_dot - t4 * yaw_dot;
    let f_roll = cos_pitch * (t0 * p.A) - t6 * (t5 * p.B_minus_C);
    let t7 = t5 * (t2 * p.A_minus_B) + (t5 * roll_dot + cos_roll * t3) * p.C;
    let t8 = t6 * (t2 * p.A_minus_C) + (t6 * roll_dot + sin_roll * t3) * p.B;
    let f_yaw = t1 * t8 + (t4 * t7 - sin_pitch * f_roll);
    let f_pitch = cos_roll * t8 - sin_roll * t7;
    [f_yaw, f_pitch, f_roll]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine, pivots ahead.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
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
    let pitch = n(q[1]);
    let roll = n(q[2]);
    let yaw_dot = n(v[0]);
    let pitch_dot = n(v[1]);
    let roll_dot = n(v[2]);
    let angles = [roll, pitch];
    let circular = N::sin_cos_all(angles);
    let (sin_roll, cos_roll) = circular[0];
    let (sin_pitch, cos_pitch) = circular[1];
    let t0 = yaw_dot * pitch_dot;
    let t1 = sin_roll * sin_roll;
    let t2 = cos_roll * cos_roll;
    let t3 = sin_pitch.neg_mul_add(yaw_dot, roll_dot);
    let t4 = sin_pitch * t0;
    let t5 = cos_pitch * cos_roll;
    let t6 = n(p.B) * t1;
    let t7 = t5.neg_mul_add(yaw_dot, sin_roll * pitch_dot);
    let t8 = cos_roll * pitch_dot;
    let t9 = cos_pitch.mul_add(sin_roll * yaw_dot, t8);
    // Eliminates pitch: inertia d[pitch].
    let t10 = t2.mul_add(n(p.B), t1 * n(p.C));
    let t11 = cos_pitch * cos_pitch;
    let t12 = N::ONE / t10;
    let t13 = sin_roll * n(p.B_minus_C);
    let t14 = t7.mul_add(roll_dot, sin_roll * t4);
    let t15 = n(p.B).mul_add(t14, t7 * (t3 * n(p.A_minus_C)));
    let t16 = roll_dot.mul_add(t9, cos_roll * t4);
    let t17 = n(p.C).mul_add(t16, t9 * (t3 * n(p.A_minus_B)));
    let t18 = cos_pitch * (t0 * n(p.A));
    let t19 = t5 * t12;
    // Eliminates pitch: alone z[pitch].
    let t20 = t12 * sin_roll.mul_sub(t17, cos_roll * t15);
    let t21 = t5.mul_add(t5 * n(p.C), sin_pitch * (sin_pitch * n(p.A)));
    let t22 = t11 * t2.mul_add(n(p.C), t6);
    // Eliminates yaw: inertia d[yaw].
    let t23 = t19.neg_mul_add(t1 * (t5 * n(p.k2)), t22);
    let t24 = sin_roll.mul_add(t15, cos_roll * t17);
    let t25 = cos_pitch * t20.mul_add(cos_roll * t13, t24);
    let yaw_ddot = N::ONE / t23 * t25;
    let t26 = n(p.inverse_A) * t7.neg_mul_add(t9 * n(p.B_minus_C), t18);
    // Back substitution: a[pitch].
    let pitch_ddot = -yaw_ddot.mul_add(t19 * t13, t20);
    let roll_ddot = sin_pitch.mul_add(yaw_ddot, t26);
    let t27 = t11.mul_add(t6, t21);
    let sound = PIVOTS.hold(t10, t10) & PIVOTS.hold(t23, t27) & pitch_ddot.is_finite();
    if !sound {
        let pivots = [(1, t10, t10), (0, t23, t27)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [yaw_ddot.store(), pitch_ddot.store(), roll_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*A*(der(roll) - sin(pitch)*der(yaw))^2
///     + 1/2*B*(sin(roll)*cos(pitch)*der(yaw) + cos(roll)*der(pitch))^2
///     + 1/2*C*(cos(roll)*cos(pitch)*der(yaw) - sin(roll)*der(pitch))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let t0 = cos_pitch * yaw_dot;
    let t1 = roll_dot - sin_pitch * yaw_dot;
    let t2 = t0 * sin_roll + cos_roll * pitch_dot;
    let t3 = sin_roll * pitch_dot - t0 * cos_roll;
    let t4 = t3 * (t3 * p.C) + (t2 * (t2 * p.B) + t1 * (t1 * p.A));
    S::from_f64(0.5) * t4
}

/// Angular momentum along the ground's axes: conserved. Unit: `J*s`.
///
/// ```text
/// momentum_x = A*cos(pitch)*cos(yaw)*(der(roll) - sin(pitch)*der(yaw)) +
///     B*(sin(pitch)*sin(roll)*cos(yaw) - cos(roll)*sin(yaw))*(sin(roll)*cos(pitch)*der(yaw) +
///     cos(roll)*der(pitch)) + C*(sin(pitch)*cos(roll)*cos(yaw) +
///     sin(roll)*sin(yaw))*(cos(roll)*cos(pitch)*der(yaw) - sin(roll)*der(pitch))
/// ```
pub fn output_momentum_x<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let yaw = q[0];
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_yaw, cos_yaw) = yaw.sin_cos();
    let t0 = cos_pitch * yaw_dot;
    let t1 = cos_yaw * sin_pitch;
    let t2 = (sin_yaw * cos_roll - sin_roll * t1) * p.B;
    let t3 = (roll_dot - sin_pitch * yaw_dot) * (cos_yaw * (cos_pitch * p.A));
    let t4 = (sin_yaw * sin_roll + cos_roll * t1) * p.C;
    let t5 = t3 - (sin_roll * t0 + cos_roll * pitch_dot) * t2;
    t5 - (sin_roll * pitch_dot - cos_roll * t0) * t4
}

/// `momentum_y`. Unit: `J*s`.
///
/// ```text
/// momentum_y = A*cos(pitch)*sin(yaw)*(der(roll) - sin(pitch)*der(yaw)) +
///     B*(sin(pitch)*sin(roll)*sin(yaw) + cos(roll)*cos(yaw))*(sin(roll)*cos(pitch)*der(yaw) +
///     cos(roll)*der(pitch)) + C*(sin(pitch)*cos(roll)*sin(yaw) -
///     sin(roll)*cos(yaw))*(cos(roll)*cos(pitch)*der(yaw) - sin(roll)*der(pitch))
/// ```
pub fn output_momentum_y<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let yaw = q[0];
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_yaw, cos_yaw) = yaw.sin_cos();
    let t0 = cos_pitch * yaw_dot;
    let t1 = sin_yaw * sin_pitch;
    let t2 = (sin_roll * t1 + cos_yaw * cos_roll) * p.B;
    let t3 = (roll_dot - sin_pitch * yaw_dot) * (sin_yaw * (cos_pitch * p.A));
    let t4 = (cos_roll * t1 - cos_yaw * sin_roll) * p.C;
    let t5 = (sin_roll * t0 + cos_roll * pitch_dot) * t2 + t3;
    t5 - (sin_roll * pitch_dot - cos_roll * t0) * t4
}

/// `momentum_z`. Unit: `J*s`.
///
/// ```text
/// momentum_z = A*sin(pitch)^2*der(yaw) + C*cos(roll)^2*cos(pitch)^2*der(yaw)
///     + B*sin(roll)^2*cos(pitch)^2*der(yaw) + (B - C)*cos(roll)*sin(roll)*cos(pitch)*der(pitch)
///     - A*sin(pitch)*der(roll)
/// ```
pub fn output_momentum_z<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let pitch = q[1];
    let roll = q[2];
    let yaw_dot = v[0];
    let pitch_dot = v[1];
    let roll_dot = v[2];
    let (sin_roll, cos_roll) = roll.sin_cos();
    let (sin_pitch, cos_pitch) = pitch.sin_cos();
    let t0 = cos_pitch * cos_roll;
    let t1 = cos_pitch * sin_roll;
    let t2 = (roll_dot - sin_pitch * yaw_dot) * (sin_pitch * p.A);
    let t3 = (sin_roll * pitch_dot - t0 * yaw_dot) * (t0 * p.C) + t2;
    (yaw_dot * t1 + cos_roll * pitch_dot) * (t1 * p.B) - t3
}

/// Cosine of the angle between the body's z axis and the vertical: -1 where it stands
/// on its head. Unit: `1`.
///
/// ```text
/// upright = cos(roll)*cos(pitch)
/// ```
pub fn output_upright<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let pitch = q[1];
    let roll = q[2];
    let cos_pitch = pitch.cos();
    let cos_roll = roll.cos();
    cos_pitch * cos_roll
}

/// By how much `cos(pitch) > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let pitch = q[1];
    let cos_pitch = pitch.cos();
    cos_pitch
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Outputs<S> {
    Outputs {
        momentum_x: output_momentum_x(p, q, v),
        momentum_y: output_momentum_y(p, q, v),
        momentum_z: output_momentum_z(p, q, v),
        upright: output_upright(q),
    }
}

::lagrangian::emitted::implement! {
    machine AsymmetricTop "AsymmetricTop" over S, R;
    parameters { m, A, B, C } [
        m: "m" "kg" = 2.0;
        A: "A" "kg*m^2" = 0.02;
        B: "B" "kg*m^2" = 0.04;
        C: "C" "kg*m^2" = 0.03;
    ]
    coordinates 3 Coordinates { yaw, pitch, roll } [
        yaw: "yaw" "rad";
        pitch: "pitch" "rad";
        roll: "roll" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { momentum_x, momentum_y, momentum_z, upright } [
        momentum_x: "momentum_x" "J*s";
        momentum_y: "momentum_y" "J*s";
        momentum_z: "momentum_z" "J*s";
        upright: "upright" "1";
    ]
    prepared Prepared {
        A, B, C, B_minus_C, A_minus_C, A_minus_B, A_plus_B_minus_C, k0, k1, A_minus_B_plus_C,
        minus_A, inverse_A, k2,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v);
        facts assumptions(p, t, q, v, u) = [("cos(pitch) > 0", true, assumption_0(q))];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
