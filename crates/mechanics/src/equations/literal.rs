//! Evaluates Lagrange's equations of the second kind numerically, without expanding them: the
//! reference with which every program is compared before it leaves the compiler.
//!
//! ```text
//! w·(d/dt ∂T/∂v − ∂T/∂q) = w·Q
//! ```
//!
//! is needed as a number, at a state `q, v, t` with accelerations `a` and for a direction `w`. No
//! derivative is formed symbolically. The positions of the bodies are evaluated over numbers with
//! three infinitesimals δ, τ, ε, each of which has the square 0:
//!
//! * `δ` turns positions into velocities: `q + δ v`, `t + δ` gives `x + δ ẋ`;
//! * `τ` gives rates along the motion: `q + τ v`, `v + τ a`, `t + τ`;
//! * `ε` varies in the direction `w`: `v + ε w`, and `q − τε w`.
//!
//! `T`, composed from velocities as in (E1), is then a number with `τ` and `ε` in it, and by the
//! chain rule its coefficient of `τε` is
//!
//! ```text
//! Σ wᵢ (d/dt ∂T/∂vᵢ) − Σ wᵢ ∂T/∂qᵢ
//! ```
//!
//! Nothing is assumed about `T`; it need not even be that of a body, so the approximated energies
//! of (E16) and (E17) are treated in the same way. In the same evaluation the coefficient of `τε`
//! in `V` is `−w·∂V/∂q`, that of `ε` in `D` is `w·∂D/∂v`, that of `−τε` in a point its displacement
//! along `w`, that of `δτ` in a constraint its second derivative along the motion, and that of `ε`
//! in a velocity its derivative along `w`.
//!
//! One random direction proves all equations: two different linear forms of `w` agree at a random `w`
//! with probability 1/(2⁶¹ − 1) (J. T. Schwartz, *Fast probabilistic algorithms for verification of
//! polynomial identities*, J. ACM 27 (1980) 701–717). So the equations cost as much as evaluating the
//! positions of the bodies, with eight numbers for each value.
//!
//! This module shares only the [`Model`] and the evaluation of expressions with the derivation; it
//! uses no velocity, no derivative and no simplification of [`super::projected`].

mod contacts;
mod energy;
mod frozen;
mod in_space;
mod needed;
mod values;
mod vector;

use lagrangian_scalar::{Dual, Scalar};
use lagrangian_symbolic::{Expr, Id, Symbol, evaluate};
use rustc_hash::FxHashMap;

use contacts::on_surface;
use energy::{dissipation, energies_of, kinetic_energy, potential_energy};
use frozen::Frozen;
use lagrangian_spec::model::element::Load;
use lagrangian_spec::model::{
    ApproximationKind, Body, Circle, FrameOrBody, Model, PoseId, Rotation, Space,
};
use needed::{energies, geometry, kinetic, lengths};
use values::Values;
use vector::{dot, ground, point, scaled};

/// A state of a machine with its accelerations and inputs.
#[derive(Clone, Debug)]
pub(crate) struct State<R> {
    pub t: R,
    pub q: Vec<R>,
    pub v: Vec<R>,
    pub a: Vec<R>,
    pub u: Vec<R>,
    pub parameters: Vec<R>,
}

/// The values of Lagrange's equations at a state, for a direction `w`.
#[derive(Clone, Debug)]
pub(crate) struct Literal<R> {
    /// `T`, eq. (E1).
    pub kinetic_energy: R,
    /// `V`, eq. (E2).
    pub potential_energy: R,
    /// `D`, eq. (E3).
    pub dissipation: R,
    /// `E`, eq. (E59).
    pub state_energy: R,
    /// `d(T + V + E)/dt` along the motion, on which states change at their given rates.
    pub energy_rate: R,
    /// The power lost in addition to dissipation.
    pub power_loss: R,
    /// `w·(d/dt ∂T/∂v − ∂T/∂q)`.
    pub inertia: R,
    /// `w·Q`, eq. (E6).
    pub applied: R,
    /// The share of the lengths of quaternions in `v·(M a − f)`, which is not power.
    pub length_power: R,
    pub constraints: Vec<LiteralConstraint<R>>,
    pub sliding: Vec<LiteralSliding<R>>,
    pub unilateral: Vec<LiteralUnilateral<R>>,
}

/// The equations of motion at a state, for a direction `w`.
#[derive(Clone, Debug)]
pub(crate) struct Dynamics<R> {
    /// As [`Literal::inertia`].
    pub inertia: R,
    /// As [`Literal::applied`].
    pub applied: R,
    /// As [`Literal::length_power`].
    pub length_power: R,
    /// The constraints that are given as expressions.
    pub constraints: Vec<LiteralConstraint<R>>,
}

/// A unilateral contact at a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LiteralUnilateral<R> {
    /// The distance by which it is open.
    pub opening: LiteralConstraint<R>,
    /// The gap, as a constraint of positions that would hold it at 0; for a polygon the gap to the face that touches.
    pub gap: LiteralConstraint<R>,
    /// For a polygon, the distance of the corner outside the face, its distance beyond the ends of the face, and
    /// the rate of the latter.
    pub face: Option<[R; 3]>,
    /// The slip, as a constraint of velocities that would hold it at 0.
    pub slip: LiteralConstraint<R>,
    /// `e`, `eₜ`, `μ` and `μ₀`.
    pub coefficients: [R; 4],
}

/// A contact at a state whose gap is smooth.
pub(crate) struct SmoothContact<R> {
    pub contact: LiteralUnilateral<R>,
    /// Whether it is the rolling resistance or the second tangent of the one before it.
    pub is_carried: bool,
}

/// A bilateral constraint at a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LiteralConstraint<R> {
    /// `g`; 0 if only velocities are constrained.
    pub position: R,
    /// `φ`.
    pub rate: R,
    /// `dφ/dt` with the accelerations in it.
    pub acceleration: R,
    /// `w·∂φ/∂v`.
    pub along: R,
    /// The derivative of `g` along `w` with respect to the rates, which is 0 if it really constrains positions.
    pub by_rates: R,
}

/// A guided contact at a state.
#[derive(Clone, Debug)]
pub(crate) struct LiteralSliding<R> {
    /// `w`, the slip velocity.
    pub slip: R,
    /// `dw/dt` with the accelerations in it.
    pub slip_rate: R,
    /// The derivative of the slip along the direction.
    pub slip_along: R,
    /// The directions of the reaction's components: in the plane the direction of the guide turned left, of length 1; in
    /// space the ground axes.
    pub axes: Vec<Vec<R>>,
    /// The derivatives of the velocities along these.
    pub off_along: Vec<R>,
    /// The product of the direction turned left with the normal in the spec; 1 if none is given, and in space.
    pub side: R,
    /// `μ` and `μ₀`.
    pub coefficients: [R; 2],
    /// In space the unit vector that determines the pressing part of the reaction: the normal of a surface, or the tangent of a curve.
    pub reference_direction: Vec<R>,
}

/// Numbers with τ outside and ε inside.
type Varied<R> = Dual<Dual<R>>;

/// Numbers with δ, τ and ε.
type Moving<R> = Dual<Varied<R>>;

/// Numbers with two orders in small coordinates; see [`Lagrange::small`].
type Small<R> = Dual<Dual<Varied<R>>>;

/// The meaning of a symbol.
#[derive(Clone, Copy)]
enum Meaning {
    Time,
    Parameter(usize),
    Coordinate(usize),
    Rate(usize),
    Acceleration(usize),
    Input(usize),
}

/// The equations of a model, prepared for evaluation.
pub(crate) struct Lagrange<'m, 'd> {
    pub model: &'m Model<'d>,
    meanings: FxHashMap<Symbol, Meaning>,
    /// All expressions that are evaluated along the motion: first those of the potential energy and the dissipation, then those of
    /// the kinetic energy, then all others.
    pub roots: Vec<Expr<'d>>,
    /// The number of expressions for the potential energy and the dissipation.
    energies: usize,
    /// The number of expressions for all energies.
    all_energies: usize,
    /// The index of each expression among the roots.
    places: FxHashMap<Id, usize>,
    /// For each constraint of the model whether it constrains positions.
    holonomic: Vec<bool>,
    /// Whether each coordinate counts as small.
    small: Vec<bool>,
    /// Whether each coordinate is frozen.
    frozen: Vec<bool>,
}

impl<'m, 'd> Lagrange<'m, 'd> {
    /// The equations of a model. `holonomic` says which constraints constrain positions; a
    /// constraint that contains rates may do so if these cancel.
    pub fn of(model: &'m Model<'d>, holonomic: impl Fn(usize) -> bool) -> Lagrange<'m, 'd> {
        let n = model.coordinates.len();
        let kinds = |kind: ApproximationKind| {
            let mut is = vec![false; n];
            let all = model.approximations.iter().filter(|a| a.kind == kind);
            all.for_each(|a| is[a.coordinate] = true);
            is
        };
        let mut roots = energies(model);
        let energies = roots.len();
        roots.extend(kinetic(model));
        let all_energies = roots.len();
        roots.extend(geometry(model));
        let mut places = FxHashMap::default();
        for (place, root) in roots.iter().enumerate() {
            places.entry(root.id()).or_insert(place);
        }
        Lagrange {
            model,
            meanings: meanings(model),
            roots,
            energies,
            all_energies,
            places,
            holonomic: (0..model.constraints().len()).map(holonomic).collect(),
            small: kinds(ApproximationKind::Small),
            frozen: kinds(ApproximationKind::Frozen),
        }
    }

    /// The values of expressions at a state.
    pub fn values<R: Scalar>(&self, expressions: &[Expr<'d>], at: &State<R>) -> Vec<R> {
        self.values_with(expressions, at, &[])
    }

    /// The values of expressions at a state, with values for further symbols.
    pub fn values_with<R: Scalar>(
        &self,
        expressions: &[Expr<'d>],
        at: &State<R>,
        more: &[(Expr<'d>, R)],
    ) -> Vec<R> {
        evaluate(self.model.dag, expressions, |symbol| {
            let is = |(e, _): &&(Expr<'d>, R)| e.as_symbol() == Some(symbol);
            if let Some((_, value)) = more.iter().find(is) {
                return *value;
            }
            match self.meanings.get(&symbol) {
                Some(Meaning::Time) => at.t,
                Some(&Meaning::Parameter(i)) => at.parameters[i],
                Some(&Meaning::Coordinate(i)) => at.q[i],
                Some(&Meaning::Rate(i)) => at.v[i],
                Some(&Meaning::Acceleration(i)) => at.a[i],
                Some(&Meaning::Input(i)) => at.u[i],
                None => undefined(),
            }
        })
    }

    /// The values of the first `count` expressions along a motion.
    fn along<S: Scalar>(
        &self,
        count: usize,
        value: impl FnMut(Symbol) -> Dual<S>,
    ) -> Values<'_, S> {
        Values {
            places: &self.places,
            values: evaluate(self.model.dag, &self.roots[..count], value),
        }
    }

    /// The values of the equations at a state, for the direction `w`.
    pub fn at<R: Scalar>(&self, at: &State<R>, w: &[R]) -> Literal<R> {
        let model = self.model;
        let x = self.along(self.roots.len(), |symbol| self.moving(symbol, at, w));
        let energies = match [&self.frozen, &self.small].map(|list| list.contains(&true)) {
            [false, false] => energies_of(model, &x),
            [true, false] => [
                self.frozen_energy(|symbol| self.moving(symbol, at, w)),
                potential_energy(model, &x),
                dissipation(model, &x),
            ],
            [is_frozen, true] => self.approximated(at, w, is_frozen),
        };
        let dynamics = self.dynamics_of(at, w, &x, energies);
        let [t, v, d] = energies;
        let stored = self.stored(at);
        let mut power_loss = R::ZERO;
        for power in model.losses() {
            power_loss = power_loss + x.value(power).value.value;
        }
        let mut sliding = Vec::new();
        for s in model.sliding() {
            sliding.push(self.sliding(s, &x));
        }
        let mut unilateral = Vec::new();
        let mut pair = None;
        for contact in &model.contacts {
            unilateral.extend(self.unilateral(contact, &x, &mut pair));
        }
        let mut constraints = dynamics.constraints;
        for rolling in model.rolling() {
            let circle = &model.circles[rolling.circles.circle];
            let surface = rolling.circles.surface;
            let [gap, slip] = on_surface(model, circle, surface, false, &x);
            constraints.extend([of_position(gap), of_rate(slip.value)]);
        }
        Literal {
            kinetic_energy: t.value.value,
            potential_energy: v.value.value,
            dissipation: d.value.value,
            state_energy: stored.value,
            energy_rate: t.derivative.value + v.derivative.value + stored.derivative,
            power_loss,
            inertia: dynamics.inertia,
            applied: dynamics.applied,
            length_power: dynamics.length_power,
            constraints,
            sliding,
            unilateral,
        }
    }

    /// The equations of motion alone, for a machine without approximations, rolling and sliding; none for others. Numbers that only
    /// such machines need (power series) are thus not instantiated for contacts.
    pub fn dynamics<R: Scalar>(&self, at: &State<R>, w: &[R]) -> Option<Dynamics<R>> {
        let model = self.model;
        let is_exact = model.approximations.is_empty();
        if !is_exact || !model.rolling().is_empty() || !model.sliding().is_empty() {
            return None;
        }
        let x = self.along(self.roots.len(), |symbol| self.moving(symbol, at, w));
        Some(self.dynamics_of(at, w, &x, energies_of(model, &x)))
    }

    /// The equations of motion, given `T`, `V` and `D`.
    fn dynamics_of<R: Scalar>(
        &self,
        at: &State<R>,
        w: &[R],
        x: &Values<'_, Varied<R>>,
        [t, v, d]: [Varied<R>; 3],
    ) -> Dynamics<R> {
        let model = self.model;
        let [of_length, on_length, length_power] = lengths(model, x);
        let (mut changing, mut rates) = (R::ZERO, R::ZERO);
        for (i, coordinate) in model.coordinates.iter().enumerate() {
            if let Some(rate) = coordinate.rate {
                changing = changing + w[i] * at.a[i];
                rates = rates + w[i] * x.value(rate).value.value;
            }
        }
        let force = self.virtual_work(x);
        let mut constraints = Vec::new();
        for (constraint, holonomic) in model.constraints().into_iter().zip(&self.holonomic) {
            let value = x.at(constraint.expression);
            constraints.push(if *holonomic {
                of_position(value)
            } else {
                of_rate(value.value)
            });
        }
        Dynamics {
            inertia: changing + t.derivative.derivative + of_length,
            applied: v.derivative.derivative - d.value.derivative + force + rates + on_length,
            length_power,
            constraints,
        }
    }

    /// The energy stored in first-order states, with its rate along the motion.
    fn stored<R: Scalar>(&self, at: &State<R>) -> Dual<R> {
        let model = self.model;
        let energies: Vec<Expr<'d>> = model.energies_of_states().collect();
        if energies.is_empty() {
            return Dual::constant(R::ZERO);
        }
        let rates: Vec<Expr<'d>> = model.coordinates.iter().filter_map(|c| c.rate).collect();
        let rates = self.values(&rates, at);
        // The accelerations, but for states their rates.
        let mut a = at.a.clone();
        let mut states = 0;
        for (i, coordinate) in model.coordinates.iter().enumerate() {
            if coordinate.rate.is_some() {
                a[i] = rates[states];
                states += 1;
            }
        }
        let values = evaluate(model.dag, &energies, |symbol| {
            match self.meanings.get(&symbol) {
                Some(Meaning::Time) => Dual {
                    value: at.t,
                    derivative: R::ONE,
                },
                Some(&Meaning::Coordinate(i)) => Dual {
                    value: at.q[i],
                    derivative: at.v[i],
                },
                Some(&Meaning::Rate(i)) => Dual {
                    value: at.v[i],
                    derivative: a[i],
                },
                Some(&Meaning::Parameter(i)) => Dual::constant(at.parameters[i]),
                Some(&Meaning::Input(i)) => Dual::constant(at.u[i]),
                Some(&Meaning::Acceleration(i)) => Dual::constant(at.a[i]),
                None => undefined(),
            }
        });
        let mut sum = Dual::constant(R::ZERO);
        for energy in values {
            sum = sum + energy;
        }
        sum
    }

    /// `w·∂D/∂v` alone.
    pub fn damping<R: Scalar>(&self, at: &State<R>, w: &[R]) -> R {
        let model = self.model;
        let dissipation = if self.small.contains(&true) {
            let x = self.along(self.energies, |symbol| self.small(symbol, at, w));
            expanded(dissipation(model, &x))
        } else {
            let x = self.along(self.energies, |symbol| self.moving(symbol, at, w));
            dissipation(model, &x)
        };
        dissipation.value.derivative
    }

    /// A symbol as a number with δ, τ and ε.
    fn moving<R: Scalar>(&self, symbol: Symbol, at: &State<R>, w: &[R]) -> Moving<R> {
        let fixed = |value| Dual::constant(Dual::constant(Dual::constant(value)));
        match self.meanings.get(&symbol) {
            Some(Meaning::Time) => {
                let one = Dual::constant(Dual::constant(R::ONE));
                Dual {
                    value: time(at),
                    derivative: one,
                }
            }
            Some(&Meaning::Coordinate(i)) => Dual {
                value: coordinate(at, w, i),
                derivative: rate(at, w, i),
            },
            Some(&Meaning::Rate(i)) => Dual::constant(rate(at, w, i)),
            Some(&Meaning::Parameter(i)) => fixed(at.parameters[i]),
            Some(&Meaning::Input(i)) => fixed(at.u[i]),
            Some(&Meaning::Acceleration(i)) => fixed(at.a[i]),
            None => undefined(),
        }
    }

    /// The kinetic energy with velocities frozen by (E16).
    fn frozen_energy<S: Scalar>(&self, moving: impl Fn(Symbol) -> Dual<S>) -> S {
        let roots = &self.roots[..self.all_energies];
        let frozen = evaluate(self.model.dag, roots, |symbol| {
            let moving = moving(symbol);
            let still = match self.meanings.get(&symbol) {
                Some(&Meaning::Coordinate(i)) if self.frozen[i] => S::ZERO,
                _ => moving.value,
            };
            Frozen {
                moving,
                at_zero: still,
            }
        });
        let mut values = Vec::with_capacity(frozen.len());
        for value in &frozen {
            values.push(value.moving);
        }
        let places = &self.places;
        kinetic_energy(self.model, &Values { places, values })
    }

    /// The energies and the dissipation to second order in small coordinates, (E17), with
    /// velocities that may be frozen.
    fn approximated<R: Scalar>(&self, at: &State<R>, w: &[R], is_frozen: bool) -> [Varied<R>; 3] {
        let model = self.model;
        let of_state = |symbol| self.small(symbol, at, w);
        let x = self.along(self.all_energies, of_state);
        let kinetic_energy = if is_frozen {
            self.frozen_energy(of_state)
        } else {
            kinetic_energy(model, &x)
        };
        [
            expanded(kinetic_energy),
            expanded(potential_energy(model, &x)),
            expanded(dissipation(model, &x)),
        ]
    }

    /// A symbol as in [`Self::moving`], with small coordinates and their rates multiplied by the
    /// sum of two more infinitesimals.
    fn small<R: Scalar>(&self, symbol: Symbol, at: &State<R>, w: &[R]) -> Dual<Small<R>> {
        let Dual { value, derivative } = self.moving(symbol, at, w);
        let is_small = match self.meanings.get(&symbol) {
            Some(&Meaning::Coordinate(i) | &Meaning::Rate(i)) => self.small[i],
            _ => false,
        };
        let scaled = |x: Varied<R>| {
            if is_small {
                Dual {
                    value: Dual {
                        value: Varied::<R>::ZERO,
                        derivative: x,
                    },
                    derivative: Dual {
                        value: x,
                        derivative: Varied::<R>::ZERO,
                    },
                }
            } else {
                Dual::constant(Dual::constant(x))
            }
        };
        Dual {
            value: scaled(value),
            derivative: scaled(derivative),
        }
    }

    /// The virtual work of forces and torques along `w`.
    fn virtual_work<R: Scalar>(&self, x: &Values<'_, Varied<R>>) -> R {
        let model = self.model;
        let here = |e: Expr<'d>| x.value(e).value.value;
        // The displacement along w: q contains w with the coefficient −τε.
        let moved = |e: Expr<'d>| -x.value(e).derivative.derivative;
        let mut work = R::ZERO;
        for load in model.loads() {
            match load {
                Load::Point { at, force } => {
                    for (&at, &force) in at.iter().zip(force) {
                        work = work + here(force) * moved(at);
                    }
                }
                &Load::Coordinate { coordinate, value } => {
                    work = work + here(value) * moved(model.coordinates[coordinate].q);
                }
                &Load::Along { measure, force, .. } => work = work + here(force) * moved(measure),
                Load::Torque { on, torque } => match (model.space, model.rotation(*on)) {
                    (Space::Plane, rotation) => {
                        if let Some(angle) = rotation_angle(model, rotation) {
                            work = work + here(torque[0]) * moved(angle);
                        }
                    }
                    (Space::Space, Rotation::Frame(pose)) => {
                        // The rotation is ½ Σ e × δe, in ground axes.
                        for e in &model.poses[pose.index()].axes {
                            for (k, &torque) in torque.iter().enumerate() {
                                let (next, last) = (e[(k + 1) % 3], e[(k + 2) % 3]);
                                let turn = here(next) * moved(last) - here(last) * moved(next);
                                work = work + here(torque) * turn * R::from_ratio(1, 2);
                            }
                        }
                    }
                    (Space::Space, _) => {}
                },
            }
        }
        work
    }
}

/// `f + f₁ + ½ f₂`, where `f₁` is the coefficient of either infinitesimal of [`Lagrange::small`] and
/// `f₂` that of their product.
fn expanded<R: Scalar>(f: Small<R>) -> Varied<R> {
    let half = Varied::<R>::from_ratio(1, 2);
    f.value.value + f.value.derivative + half * f.derivative.derivative
}

/// An undefined value.
fn undefined<S: Scalar>() -> S {
    S::ONE / S::ZERO
}

/// `t + τ`.
fn time<R: Scalar>(at: &State<R>) -> Varied<R> {
    Dual {
        value: Dual::constant(at.t),
        derivative: Dual::constant(R::ONE),
    }
}

/// `q + τ v − τε w`.
fn coordinate<R: Scalar>(at: &State<R>, w: &[R], i: usize) -> Varied<R> {
    Dual {
        value: Dual::constant(at.q[i]),
        derivative: Dual {
            value: at.v[i],
            derivative: -w[i],
        },
    }
}

/// `v + τ a + ε w`.
fn rate<R: Scalar>(at: &State<R>, w: &[R], i: usize) -> Varied<R> {
    Dual {
        value: Dual {
            value: at.v[i],
            derivative: w[i],
        },
        derivative: Dual::constant(at.a[i]),
    }
}

/// A constraint of positions: `g` with its derivatives.
fn of_position<R: Scalar>(g: Moving<R>) -> LiteralConstraint<R> {
    LiteralConstraint {
        position: g.value.value.value,
        by_rates: g.value.value.derivative,
        ..of_rate(g.derivative)
    }
}

/// A constraint of velocities.
fn of_rate<R: Scalar>(phi: Varied<R>) -> LiteralConstraint<R> {
    LiteralConstraint {
        position: R::ZERO,
        rate: phi.value.value,
        acceleration: phi.derivative.value,
        along: phi.value.derivative,
        by_rates: R::ZERO,
    }
}

fn meanings(model: &Model<'_>) -> FxHashMap<Symbol, Meaning> {
    let mut meanings = FxHashMap::default();
    let mut set = |e: Expr<'_>, meaning| {
        if let Some(symbol) = e.as_symbol() {
            meanings.insert(symbol, meaning);
        }
    };
    set(model.time, Meaning::Time);
    for (i, parameter) in model.parameters.iter().enumerate() {
        set(parameter.symbol, Meaning::Parameter(i));
    }
    for (i, input) in model.inputs.iter().enumerate() {
        set(input.symbol, Meaning::Input(i));
    }
    for (i, coordinate) in model.coordinates.iter().enumerate() {
        set(coordinate.q, Meaning::Coordinate(i));
        set(coordinate.v, Meaning::Rate(i));
        set(coordinate.a, Meaning::Acceleration(i));
    }
    meanings
}

/// The angle of a body in the plane.
fn angle<'d>(model: &Model<'d>, body: &Body<'d>) -> Option<Expr<'d>> {
    rotation_angle(model, body.rotation)
}

fn rotation_angle<'d>(model: &Model<'d>, rotation: Rotation<'d>) -> Option<Expr<'d>> {
    match rotation {
        Rotation::Unspecified => None,
        Rotation::Angle(angle) => Some(angle),
        Rotation::Frame(pose) => Some(model.poses[pose.index()].angle),
    }
}

/// The numbers without infinitesimals.
fn here<R: Scalar, const N: usize>(u: [Varied<R>; N]) -> [R; N] {
    let mut here = [R::ZERO; N];
    for k in 0..N {
        here[k] = u[k].value.value;
    }
    here
}

/// A vector of the plane turned left by a right angle.
fn turned_left<S: Scalar, const N: usize>(u: [S; N]) -> [S; N] {
    let mut turned = u;
    [turned[0], turned[1]] = [-u[1], u[0]];
    turned
}

/// The velocity at `arm` from a point that is at rest on something with this rotation.
fn carried<R: Scalar, const N: usize>(
    model: &Model<'_>,
    rotation: Rotation<'_>,
    arm: [Varied<R>; N],
    x: &Values<'_, Varied<R>>,
) -> [Varied<R>; N] {
    let rest = [Varied::<R>::ZERO; N];
    match (model.space, rotation) {
        (Space::Plane, rotation) => match rotation_angle(model, rotation) {
            Some(angle) => scaled(x.rate(angle), turned_left(arm)),
            None => rest,
        },
        // `ω × r = Σ ėₖ (eₖ·r)` over the axes of the base.
        (Space::Space, Rotation::Frame(pose)) => {
            let (mut rates, mut along) = ([rest; N], rest);
            for (k, axis) in model.poses[pose.index()].axes.iter().enumerate() {
                let axis = x.vector::<N>(axis);
                rates[k] = vector::rate(axis);
                along[k] = dot(vector::value(axis), arm);
            }
            point(rest, rates, along)
        }
        (Space::Space, _) => rest,
    }
}

/// How far along the line of centres the touching points are from the centre of the first circle or sphere and from that of the other.
fn touching_point<R: Scalar>(
    [small, large]: [Varied<R>; 2],
    distance: Varied<R>,
    (is_inside, yields): (bool, bool),
) -> [Varied<R>; 2] {
    match (is_inside, yields) {
        (true, false) => [small, large],
        (true, true) => [small, distance + small],
        (false, false) => [-small, large],
        (false, true) => {
            let past = distance * large / (small + large);
            [past - distance, past]
        }
    }
}

/// The centre of a circle, and the angular velocity of what it is fixed to.
fn centre_and_angular_velocity<R: Scalar>(
    model: &Model<'_>,
    circle: &Circle<'_>,
    x: &Values<'_, Varied<R>>,
) -> ([Moving<R>; 2], Varied<R>) {
    point_and_angular_velocity(model, circle.on, &circle.center, x)
}

/// The position of a point fixed to a frame or a body, and the angular velocity of that.
fn point_and_angular_velocity<R: Scalar>(
    model: &Model<'_>,
    on: FrameOrBody,
    coordinates: &[Expr<'_>],
    x: &Values<'_, Varied<R>>,
) -> ([Moving<R>; 2], Varied<R>) {
    let of_pose = |pose: PoseId| {
        let axes = &model.poses[pose.index()].axes;
        [x.vector::<2>(&axes[0]), x.vector::<2>(&axes[1])]
    };
    let (origin, axes, turned) = match on {
        FrameOrBody::Frame(pose) => {
            let frame = &model.poses[pose.index()];
            (&frame.origin, of_pose(pose), Some(frame.angle))
        }
        FrameOrBody::Body(body) => {
            let body = &model.bodies[body];
            let axes = match body.rotation {
                Rotation::Unspecified => ground(),
                Rotation::Angle(angle) => {
                    let (sin, cos) = x.at(angle).sin_cos();
                    [[cos, sin], [-sin, cos]]
                }
                Rotation::Frame(pose) => of_pose(pose),
            };
            (&body.at, axes, angle(model, body))
        }
    };
    let centre = point(x.vector(origin), axes, x.vector(coordinates));
    let turning = turned.map_or(Varied::<R>::ZERO, |angle| x.rate(angle));
    (centre, turning)
}
