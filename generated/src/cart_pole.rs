// @generated from machines/cart_pole.machine by `cargo xtask generate`; edits are lost.

//! A cart on a rail with a pole hinged to it; a motor pushes the cart. The pole's angle is measured
//! from the upward vertical, so that a controller balances it at zero.
//!
//! 2 coordinates, 7 parameters, 1 input, 2 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 8 | 4 | 1 | 0 | 0 | 13 |
//! | `mass_matrix` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `bias` | 3 | 0 | 0 | 1 | 0 | 4 |
//! | `applied` | 3 | 2 | 0 | 1 | 0 | 6 |
//! | `forces` | 6 | 3 | 0 | 1 | 0 | 10 |
//! | `accelerations` | 12 | 7 | 1 | 1 | 0 | 22 |
//! | `kinetic_energy` | 12 | 4 | 0 | 1 | 0 | 18 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `dissipation` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `work_rate` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `dissipation_rate` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `output_tip` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_hinge_force` | 5 | 2 | 0 | 1 | 0 | 9 |
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

/// A cart on a rail with a pole hinged to it; a motor pushes the cart. The pole's angle is measured
/// from the upward vertical, so that a controller balances it at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartPole<S = f64> {
    /// Mass of the cart. Unit: `kg`. Default: 1.
    pub cart: S,
    /// Mass of the pole. Unit: `kg`. Default: 0.1.
    pub pole: S,
    /// Half the length of the pole. Unit: `m`. Default: 0.5.
    pub l: S,
    /// Inertia of the pole about its mass centre: pole (2 l)^2 / 12 for a uniform one. Unit:
    /// `kg*m^2`. Default: 1/120.
    pub J: S,
    /// Viscous friction of the rail and of the hinge. Unit: `N*s/m`. Default: 0.05.
    pub rail: S,
    /// `hinge`. Unit: `N*m*s`. Default: 0.001.
    pub hinge: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> CartPole<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let cart_plus_pole = self.pole + self.cart;
        let pole_l = self.pole * self.l;
        let two_l = self.l * S::from_f64(2.0);
        let l_squared = self.l * self.l;
        let pole_l_g = pole_l * self.g;
        let half_hinge = self.hinge * S::from_f64(0.5);
        let half_rail = self.rail * S::from_f64(0.5);
        let half_cart = S::from_f64(0.5) * self.cart;
        let J_plus_pole_l_squared = self.J + self.l * pole_l;
        let minus_pole_l = -pole_l;
        let minus_pole = -self.pole;
        let k0 = S::ONE / cart_plus_pole;
        let pivots = [(0, cart_plus_pole, cart_plus_pole)];
        Prepared {
            l: self.l,
            J: self.J,
            rail: self.rail,
            hinge: self.hinge,
            two_l,
            l_squared,
            pole_l_g,
            half_hinge,
            half_rail,
            pole_l,
            half_cart,
            cart_plus_pole,
            J_plus_pole_l_squared,
            minus_pole_l,
            minus_pole,
            k0,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let theta = S::from_ratio(1, 20);
        let q = [zero, theta];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`CartPole`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
}

/// What can be set while a [`CartPole`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Force of the motor on the cart. Unit: `N`. Default: 0.
    pub push: S,
}

/// What can be observed of a [`CartPole`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the pole's tip above the hinge. Unit: `m`.
    pub tip: S,
    /// Force of the pole on the hinge along the rail. Unit: `N`.
    pub hinge_force: S,
}

/// The parameters of a [`CartPole`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `J`
    J: S,
    /// `rail`
    rail: S,
    /// `hinge`
    hinge: S,
    /// `2*l`
    two_l: S,
    /// `l^2`
    l_squared: S,
    /// `pole*l*g`
    pole_l_g: S,
    /// `0.5*hinge`
    half_hinge: S,
    /// `0.5*rail`
    half_rail: S,
    /// `pole*l`
    pole_l: S,
    /// `0.5*cart`
    half_cart: S,
    /// `cart + pole`
    cart_plus_pole: S,
    /// `J + pole*l^2`
    J_plus_pole_l_squared: S,
    /// `-pole*l`
    minus_pole_l: S,
    /// `-pole`
    minus_pole: S,
    /// `1/(cart + pole)`
    k0: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = cart + pole
/// M[theta, x] = pole*l*cos(theta)
/// M[theta, theta] = pole*l^2 + J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta = q[1];
    let cos_theta = theta.cos();
    let m21 = p.pole_l * cos_theta;
    [[p.cart_plus_pole, m21], [m21, p.J_plus_pole_l_squared]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = -pole*l*sin(theta)*der(theta)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[1];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let h_x = sin_theta * (theta_dot * (theta_dot * p.minus_pole_l));
    let zero = S::ZERO;
    [h_x, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = push - rail*der(x)
/// Q[theta] = pole*l*g*sin(theta) - hinge*der(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let q_x = u.push - x_dot * p.rail;
    let q_theta = p.pole_l_g * sin_theta - theta_dot * p.hinge;
    [q_x, q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let t0 = sin_theta * (theta_dot * (theta_dot * p.pole_l));
    let f_x = t0 + (u.push - x_dot * p.rail);
    let f_theta = sin_theta * p.pole_l_g - theta_dot * p.hinge;
    [f_x, f_theta]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out.
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
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 2],
        v: &'a [S; 2],
        u: &'a Inputs<S>,
    }) -> Result<[S; 2], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v, u } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[1]);
    let x_dot = n(v[0]);
    let theta_dot = n(v[1]);
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = n(p.pole_l) * cos_theta;
    let t1 = x_dot.neg_mul_add(n(p.rail), n(u.push));
    let t2 = theta_dot * (n(p.pole_l) * theta_dot);
    let t3 = sin_theta.mul_add(t2, t1);
    let t4 = theta_dot * n(p.hinge);
    // Eliminates x from row theta: l[theta, x].
    let t5 = n(p.k0) * t0;
    // Row theta: pivot d[theta].
    let t6 = t0.neg_mul_add(t5, n(p.J_plus_pole_l_squared));
    // Row theta: right-hand side z[theta].
    let t7 = t5.mul_add(t3, sin_theta.neg_mul_add(n(p.pole_l_g), t4));
    let t8 = t7 / t6;
    // Back substitution: a[x].
    let x_ddot = t5.mul_add(t8, n(p.k0) * t3);
    let theta_ddot = -t8;
    let sound = PIVOTS.hold(t6, n(p.J_plus_pole_l_squared)) & theta_ddot.is_finite();
    if !sound {
        let pivots = [(1, t6, n(p.J_plus_pole_l_squared))];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [x_ddot.store(), theta_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(cart + pole)*der(x)^2 + pole*l*cos(theta)*der(x)*der(theta)
///     + 1/2*(pole*l^2 + J)*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * theta_dot;
    let t1 = x_dot + cos_theta * (theta_dot * p.l);
    let t2 = (t1 * t1 + sin_theta * (sin_theta * (t0 * p.l_squared))) * p.minus_pole;
    x_dot * (x_dot * p.half_cart) + (t0 * p.J - t2) * S::from_f64(0.5)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = pole*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.pole_l_g * cos_theta
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*rail*der(x)^2 + 1/2*hinge*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let theta_dot = v[1];
    x_dot * (x_dot * p.half_rail) + theta_dot * (theta_dot * p.half_hinge)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = der(x)*push
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 2], u: &Inputs<S>) -> S {
    let x_dot = v[0];
    u.push * x_dot
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = rail*der(x)^2 + hinge*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let theta_dot = v[1];
    x_dot * (x_dot * p.rail) + theta_dot * (theta_dot * p.hinge)
}

/// Height of the pole's tip above the hinge. Unit: `m`.
///
/// ```text
/// tip = 2*l*cos(theta)
/// ```
pub fn output_tip<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.two_l * cos_theta
}

/// Force of the pole on the hinge along the rail. Unit: `N`.
///
/// ```text
/// hinge_force = -pole*(der(der(x)) + (l*cos(theta)*der(der(theta)) - l*sin(theta)*der(theta)^2))
/// ```
pub fn output_hinge_force<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    a: &[S; 2],
) -> S {
    let theta = q[1];
    let theta_dot = v[1];
    let x_ddot = a[0];
    let theta_ddot = a[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = (cos_theta * theta_ddot - sin_theta * (theta_dot * theta_dot)) * p.l;
    p.minus_pole * (t0 + x_ddot)
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    a: &[S; 2],
) -> Outputs<S> {
    Outputs {
        tip: output_tip(p, q),
        hinge_force: output_hinge_force(p, q, v, a),
    }
}

::lagrangian::emitted::implement! {
    machine CartPole "CartPole" over S, R;
    parameters { cart, pole, l, J, rail, hinge, g } [
        cart: "cart" "kg" = 1.0;
        pole: "pole" "kg" = 0.1;
        l: "l" "m" = 0.5;
        J: "J" "kg*m^2" = 0.008333333333333333;
        rail: "rail" "N*s/m" = 0.05;
        hinge: "hinge" "N*m*s" = 0.001;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { x, theta } [
        x: "x" "m";
        theta: "theta" "rad";
    ]
    inputs Inputs { push } [
        push: "push" "N" = 0.0;
    ] over S
    outputs Outputs { tip, hinge_force } [
        tip: "tip" "m";
        hinge_force: "hinge_force" "N";
    ]
    prepared Prepared {
        l, J, rail, hinge, two_l, l_squared, pole_l_g, half_hinge, half_rail, pole_l, half_cart,
        cart_plus_pole, J_plus_pole_l_squared, minus_pole_l, minus_pole, k0,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v, u);
        vector forces(p, t, q, v, u) = forces(p, q, v, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(v, u);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v, a);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
