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

impl Default for AsymmetricTop {
    fn default() -> Self {
        Self {
            m: 2.0,
            A: 0.02,
            B: 0.04,
            C: 0.03,
        }
    }
}

impl<S> AsymmetricTop<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> AsymmetricTop<R> {
        AsymmetricTop {
            m: f(self.m),
            A: f(self.A),
            B: f(self.B),
            C: f(self.C),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> AsymmetricTop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.B - self.C;
        let k2 = self.A - self.B;
        let k1 = self.A - self.C;
        let k3 = self.A + k0;
        let k4 = k0 * S::from_f64(2.0);
        let k5 = k2 * S::from_f64(2.0);
        let k6 = self.A - k0;
        let k7 = -self.A;
        let k8 = S::ONE / self.A;
        let k9 = k0 * k0;
        let singular = if vanishes(self.A, self.A, 2.6645352591003757e-15) {
            Some(singular(2, self.A, self.A))
        } else {
            None
        };
        Prepared {
            A: self.A,
            B: self.B,
            C: self.C,
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
            singular,
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

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 3] {
        [self.yaw, self.pitch, self.roll]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 3]) -> Self {
        Self {
            yaw: q[0],
            pitch: q[1],
            roll: q[2],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            yaw: f(self.yaw),
            pitch: f(self.pitch),
            roll: f(self.roll),
        }
    }
}

/// What can be set while a [`AsymmetricTop`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

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
    k0: S,
    /// `A - C`
    k1: S,
    /// `A - B`
    k2: S,
    /// `A + B - C`
    k3: S,
    /// `2*(B - C)`
    k4: S,
    /// `2*(A - B)`
    k5: S,
    /// `A - B + C`
    k6: S,
    /// `-A`
    k7: S,
    /// `1/A`
    k8: S,
    /// `(B - C)^2`
    k9: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

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
    let t1 = t0 * p.k0;
    let m11 = p.A - cos_pitch * (cos_pitch * p.k2) - t0 * t1;
    let m21 = sin_roll * t1;
    let m22 = cos_roll * (cos_roll * p.k0) + p.C;
    let m31 = sin_pitch * p.k7;
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
    let t0 = p.k4 * cos_roll;
    let t1 = cos_roll * p.k0;
    let t2 = sin_pitch * yaw_dot;
    let t3 = cos_pitch * yaw_dot;
    let t4 = cos_roll * t0;
    let t5 = sin_roll * t1;
    let t6 = t0 * (roll_dot * sin_roll);
    let t7 = pitch_dot * t5;
    let t8 = t4 + p.k6;
    let t9 = cos_pitch * (roll_dot * (t4 - p.k3) + t2 * (t4 + p.k5)) - sin_pitch * t7;
    let h_yaw = pitch_dot * t9 + t6 * (cos_pitch * t3);
    let h_pitch = -(t3 * (t2 * (p.k2 + cos_roll * t1) - roll_dot * t8) + pitch_dot * t6);
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
    let f_roll = cos_pitch * (t0 * p.A) - t6 * (t5 * p.k0);
    let t7 = t5 * (t2 * p.k2) + (t5 * roll_dot + cos_roll * t3) * p.C;
    let t8 = t6 * (t2 * p.k1) + (t6 * roll_dot + sin_roll * t3) * p.B;
    let f_yaw = t1 * t8 + (t4 * t7 - sin_pitch * f_roll);
    let f_pitch = cos_roll * t8 - sin_roll * t7;
    [f_yaw, f_pitch, f_roll]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine, pivots ahead.
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
        let t10 = t2.mul_add(n(p.B), t1 * n(p.C));
        let t11 = cos_pitch * cos_pitch;
        let t12 = N::ONE / t10;
        let t13 = sin_roll * n(p.k0);
        let t14 = t7.mul_add(roll_dot, sin_roll * t4);
        let t15 = n(p.B).mul_add(t14, t7 * (t3 * n(p.k1)));
        let t16 = roll_dot.mul_add(t9, cos_roll * t4);
        let t17 = n(p.C).mul_add(t16, t9 * (t3 * n(p.k2)));
        let t18 = t7.neg_mul_add(t9 * n(p.k0), cos_pitch * (t0 * n(p.A)));
        let t19 = t5 * t12;
        let t20 = t12 * sin_roll.mul_sub(t17, cos_roll * t15);
        let t21 = t5.mul_add(t5 * n(p.C), sin_pitch * (sin_pitch * n(p.A)));
        let t22 = t11 * t2.mul_add(n(p.C), t6);
        let t23 = t19.neg_mul_add(t1 * (t5 * n(p.k9)), t22);
        let t24 = sin_roll.mul_add(t15, cos_roll * t17);
        let t25 = cos_pitch * t20.mul_add(cos_roll * t13, t24);
        let yaw_ddot = N::ONE / t23 * t25;
        let pitch_ddot = -yaw_ddot.mul_add(t19 * t13, t20);
        let roll_ddot = sin_pitch.mul_add(yaw_ddot, n(p.k8) * t18);
        let t26 = t11.mul_add(t6, t21);
        let sound = t10.exceeds(N::from_f64(2.6645352591003757e-15) * t10)
            & t23.exceeds(N::from_f64(2.6645352591003757e-15) * t26)
            & pitch_ddot.is_finite();
        if !sound {
            check(t10, t10, 2.6645352591003757e-15, 1)?;
            check(t23, t26, 2.6645352591003757e-15, 0)?;
        }
        let accelerations = [yaw_ddot.store(), pitch_ddot.store(), roll_ddot.store()];
        Ok(accelerations)
    }
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

/// Names and units.
const PARAMETERS: [(&str, &str); 4] = [
    ("m", "kg"),
    ("A", "kg*m^2"),
    ("B", "kg*m^2"),
    ("C", "kg*m^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 3] = [("yaw", "rad"), ("pitch", "rad"), ("roll", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 4] = [
    ("momentum_x", "J*s"),
    ("momentum_y", "J*s"),
    ("momentum_z", "J*s"),
    ("upright", "1"),
];

impl ::lagrangian::emitted::Machine for AsymmetricTop {
    type System = Prepared;

    fn name(&self) -> &str {
        "AsymmetricTop"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.A, self.B, self.C];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.A),
            2 => Some(&mut self.B),
            3 => Some(&mut self.C),
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
    const MAY_BE_CONSTRAINED: bool = false;
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

    fn applied(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = [0.0; 3];
    }

    fn forces(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = forces(self, q, v);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 3], v: &[f64; 3]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
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
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [
            outputs.momentum_x,
            outputs.momentum_y,
            outputs.momentum_z,
            outputs.upright,
        ];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &[f64; 3], _: &Inputs) -> Outputs {
        outputs(self, q, v)
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; 3],
        _: &[f64; 3],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        let facts = [assumption("cos(pitch) > 0", true, assumption_0(q))];
        facts.into_iter()
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
            A: lanes(|p| p.A),
            B: lanes(|p| p.B),
            C: lanes(|p| p.C),
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

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for AsymmetricTop<S> {
    type System = Prepared<S>;

    fn prepare(&self) -> Prepared<S> {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        Self::start(self)
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::SystemIn<S> for Prepared<S> {
    type Vector = [S; 3];
    type Coordinates = Coordinates<S>;
    type Inputs = Inputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 3]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 3] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs {
        Inputs {}
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 3],
        v: &[S; 3],
        _: &Inputs,
        result: &mut [S; 3],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, q, v }, result)
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

/// A fact and by how much it holds.
fn assumption(text: &str, strict: bool, margin: f64) -> ::lagrangian::emitted::Assumption<'_> {
    ::lagrangian::emitted::Assumption {
        text,
        margin,
        strict,
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
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
