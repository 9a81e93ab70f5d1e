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

mod frozen;
mod in_space;
mod values;
mod vector;

use std::rc::Rc;

use lagrangian_scalar::{Dual, Scalar};
use lagrangian_symbolic::{Expr, Id, Symbol, evaluate};
use rustc_hash::FxHashMap;

use frozen::Frozen;
use lagrangian_spec::model::element::{Energy, Load, Sliding};
use lagrangian_spec::model::polygons::{Corner, Polygon};
use lagrangian_spec::model::{
    ApproximationKind, Body, Circle, Contact, ContactGeometry, FrameOrBody, Inertia, Model, PoseId,
    Rotation, Space, Surface, quaternion,
};
use values::Values;
use vector::{difference, dot, ground, point, quotient, scaled};

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
            let [gap, slip] = on_surface(model, circle, rolling.circles.surface, &x);
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

    /// The contacts of a point or a circle; `pair` is that of the corner before, since the corners of a polygon follow one another.
    fn unilateral<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        x: &Values<'_, Varied<R>>,
        pair: &mut Option<PolygonPair<'d, R>>,
    ) -> Vec<LiteralUnilateral<R>> {
        let model = self.model;
        let touch = self.touch(contact, x, pair);
        let here = |e: Expr<'d>| x.value(e).value.value;
        let known = |e: Option<Expr<'d>>| e.map_or(R::ZERO, here);
        let friction = contact.friction;
        let nothing = Varied::<R>::ZERO;
        let [first, second] = contact.response.coefficients();
        let mut all = vec![LiteralUnilateral {
            opening: of_position(touch.face.map_or(touch.gap, |(opening, _)| opening)),
            gap: of_position(touch.gap),
            face: touch.face.map(|(_, beyond)| {
                let rate = beyond.derivative.value.value;
                [touch.gap.value.value.value, beyond.value.value.value, rate]
            }),
            // Without friction the slip is not used.
            slip: of_rate(friction.map_or(nothing, |_| touch.slip)),
            coefficients: [
                here(first),
                here(second),
                known(friction),
                known(contact.static_friction.or(friction)),
            ],
        }];
        if let (Some(_), Some(across)) = (friction, touch.across) {
            all.push(LiteralUnilateral {
                slip: of_rate(across),
                ..all[0]
            });
        }
        if let (ContactGeometry::Circles(touching), Some(resistance)) =
            (&contact.geometry, contact.rolling_resistance)
        {
            let angular_velocity =
                |circle: usize| centre_and_angular_velocity(model, &model.circles[circle], x).1;
            let own = angular_velocity(touching.circle);
            let other = match touching.surface {
                Surface::Inside(other) | Surface::Outside(other) => angular_velocity(other),
                Surface::Along(pose) => x.rate(model.poses[pose.index()].angle),
            };
            all.push(LiteralUnilateral {
                opening: of_position(touch.gap),
                gap: of_position(touch.gap),
                face: None,
                slip: of_rate(own - other),
                coefficients: [R::ZERO, R::ZERO, here(resistance), here(resistance)],
            });
        }
        all
    }

    /// The relative motion of what touches in a contact.
    fn touch<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        x: &Values<'_, Varied<R>>,
        pair: &mut Option<PolygonPair<'d, R>>,
    ) -> Touch<R> {
        let model = self.model;
        let of_round = |round: &Circle<'d>, surface: Surface| {
            let (gap, slip, across) = match model.space {
                Space::Plane => {
                    let [gap, slip] = on_surface(model, round, surface, x);
                    (gap, slip.value, None)
                }
                Space::Space => {
                    let (gap, [slip, across]) = in_space::gap_and_slip(model, round, surface, x);
                    (gap, slip, Some(across))
                }
            };
            Touch {
                gap,
                slip,
                across,
                face: None,
            }
        };
        match &contact.geometry {
            ContactGeometry::Corner(corner) => {
                let known = pair.take().filter(|pair| pair.is_of(corner));
                let of_corner = known.unwrap_or_else(|| PolygonPair::new(model, corner, x));
                let corner_motion = of_corner.corner(corner.corner);
                *pair = Some(of_corner);
                Touch {
                    gap: corner_motion.height,
                    slip: corner_motion.slip,
                    across: None,
                    face: Some((corner_motion.opening, corner_motion.beyond)),
                }
            }
            ContactGeometry::Circles(touching) => {
                of_round(&model.circles[touching.circle], touching.surface)
            }
            ContactGeometry::Point { point, surface } => of_round(point, *surface),
            ContactGeometry::Expressions { gap, slip, across } => Touch {
                gap: x.at(*gap),
                slip: x.value(*slip),
                across: across.map(|across| x.value(across)),
                face: None,
            },
        }
    }

    fn sliding<R: Scalar>(
        &self,
        sliding: &Sliding<'d>,
        x: &Values<'_, Varied<R>>,
    ) -> LiteralSliding<R> {
        match self.model.space {
            Space::Plane => self.sliding_along::<R, 2>(sliding, x),
            Space::Space => self.sliding_along::<R, 3>(sliding, x),
        }
    }

    /// A guided contact in a space of this dimension.
    fn sliding_along<R: Scalar, const N: usize>(
        &self,
        sliding: &Sliding<'d>,
        x: &Values<'_, Varied<R>>,
    ) -> LiteralSliding<R> {
        let model = self.model;
        let body = &model.bodies[sliding.body];
        let at = x.vector::<N>(match body.rotation {
            Rotation::Frame(pose) => &model.poses[pose.index()].origin,
            Rotation::Angle(_) | Rotation::Unspecified => &body.at,
        });
        let origin = x.vector::<N>(match sliding.on {
            FrameOrBody::Frame(pose) => &model.poses[pose.index()].origin,
            FrameOrBody::Body(on) => &model.bodies[on].at,
        });
        let arm = difference(at, origin);
        let carried = carried(model, model.rotation(sliding.on), vector::value(arm), x);
        let velocity = difference(vector::rate(arm), carried);
        let direction = vector::value(x.vector::<N>(&sliding.direction));
        let along = quotient(direction, dot(direction, direction).sqrt());
        let slip = dot(along, velocity);
        let axes: Vec<[Varied<R>; N]> = match model.space {
            Space::Plane => vec![turned_left(along)],
            Space::Space => ground::<Varied<R>, N>().to_vec(),
        };
        let side = match &sliding.normal {
            Some(normal) if model.space == Space::Plane => {
                let normal = vector::value(x.vector::<N>(normal));
                dot(normal, axes[0]).value.value
            }
            _ => R::ONE,
        };
        let reference_direction = match (sliding.tangent, &sliding.normal) {
            (Some(_), Some(normal)) => {
                let normal = here(vector::value(x.vector::<N>(normal)));
                quotient(normal, dot(normal, normal).sqrt())
            }
            _ => here(along),
        };
        let mut off_along = Vec::with_capacity(axes.len());
        let mut axes_here = Vec::with_capacity(axes.len());
        for &axis in &axes {
            off_along.push(dot(axis, velocity).value.derivative);
            axes_here.push(here(axis).to_vec());
        }
        let friction = sliding.friction;
        let static_friction = sliding.static_friction.unwrap_or(friction);
        LiteralSliding {
            reference_direction: reference_direction.to_vec(),
            slip: slip.value.value,
            slip_rate: slip.derivative.value,
            slip_along: slip.value.derivative,
            off_along,
            axes: axes_here,
            side,
            coefficients: here(vector::value(x.vector(&[friction, static_friction]))),
        }
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

/// The expressions that the kinetic energy needs.
fn kinetic<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    let mut roots = Vec::new();
    for body in &model.bodies {
        roots.push(body.mass);
        roots.extend(&body.at);
        match (&body.inertia, &body.rotation) {
            (Inertia::Particle, _) => {}
            (Inertia::Planar(inertia), _) => {
                roots.push(*inertia);
                roots.extend(angle(model, body));
            }
            (Inertia::Tensor(tensor), rotation) => {
                roots.extend(tensor);
                if let Rotation::Frame(pose) = rotation {
                    roots.extend(model.poses[pose.index()].axes.iter().flatten());
                }
            }
        }
    }
    roots
}

/// The contributions of the lengths of quaternions to the inertia and to the applied forces, along `w`: eqs. (E74) and (E75). They
/// are not energies of the machine. The third value is the first minus the second, along the velocity itself.
fn lengths<R: Scalar>(model: &Model<'_>, x: &Values<'_, Varied<R>>) -> [R; 3] {
    let half = Varied::<R>::from_ratio(1, 2);
    let two = R::from_ratio(2, 1);
    let mut all = [R::ZERO; 3];
    for four in &model.quaternions {
        let of_time = x.vector::<4>(&four.e);
        let (e, e_rate) = (vector::value(of_time), vector::rate(of_time));
        let square = dot(e, e);
        let growing = dot(e, e_rate) / square;
        let inertia = x.value(four.inertia);
        let energy = half * inertia * growing * growing;
        // The change of half the logarithm of the square along w: q contains w with the coefficient −τε.
        let s = square.value.value;
        let moved = -(square.derivative.derivative / (two * s));
        let rate = R::from_ratio(quaternion::RATE, 1);
        let fast = dot(e_rate, e_rate).value.value / s;
        let back = (rate * rate + fast) * (s - R::ONE) / (s + R::ONE);
        let load = -(inertia.value.value * (two * rate * growing.value.value + back));
        let left = inertia.value.value * growing.derivative.value - load;
        all = [
            all[0] + energy.derivative.derivative,
            all[1] + load * moved,
            all[2] + left * growing.value.value,
        ];
    }
    all
}

/// The expressions that potential energy and dissipation need.
fn energies<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    let mut roots: Vec<Expr<'d>> = Vec::new();
    for energy in model.stored().chain(model.dissipated()) {
        match energy {
            Energy::Quadratic(of) => roots.extend([of.coefficient, of.measure]),
            Energy::Given(value) => roots.push(*value),
        }
    }
    if let Some(gravity) = model.gravity() {
        roots.extend(gravity);
        for body in &model.bodies {
            roots.push(body.mass);
            roots.extend(&body.at);
        }
    }
    roots
}

/// The expressions that forces, constraints and guides need.
fn geometry<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    let mut geometry = Geometry {
        model,
        roots: Vec::new(),
    };
    for load in model.loads() {
        geometry.add_load(load);
    }
    for four in &model.quaternions {
        geometry.roots.extend(four.e);
        geometry.roots.push(four.inertia);
    }
    let roots = &mut geometry.roots;
    roots.extend(model.coordinates.iter().filter_map(|c| c.rate));
    roots.extend(model.losses());
    roots.extend(model.constraints().into_iter().map(|c| c.expression));
    if !model.rolling().is_empty() || !model.contacts.is_empty() {
        geometry.add_circles();
    }
    for contact in &model.contacts {
        geometry.add_contact(contact);
    }
    for rolling in model.rolling() {
        geometry.add_surface(rolling.circles.surface);
    }
    for sliding in model.sliding() {
        geometry.add_sliding(sliding);
    }
    geometry.roots
}

/// A list of expressions that grows by those of items of a machine.
struct Geometry<'m, 'd> {
    model: &'m Model<'d>,
    roots: Vec<Expr<'d>>,
}

impl<'d> Geometry<'_, 'd> {
    fn add_pose(&mut self, pose: PoseId) {
        let pose = &self.model.poses[pose.index()];
        let axes = pose.axes.iter().flatten();
        self.roots.extend(pose.origin.iter().chain(axes));
        self.roots.push(pose.angle);
    }

    fn add_body(&mut self, index: usize) {
        let body = &self.model.bodies[index];
        self.roots.extend(&body.at);
        match body.rotation {
            Rotation::Unspecified => {}
            Rotation::Angle(angle) => self.roots.push(angle),
            Rotation::Frame(frame) => self.add_pose(frame),
        }
    }

    fn add_place(&mut self, place: FrameOrBody) {
        match place {
            FrameOrBody::Frame(frame) => self.add_pose(frame),
            FrameOrBody::Body(index) => self.add_body(index),
        }
    }

    fn add_load(&mut self, load: &Load<'d>) {
        match load {
            Load::Point { at, force } => self.roots.extend(at.iter().chain(force)),
            Load::Coordinate { coordinate, value } => {
                let q = self.model.coordinates[*coordinate].q;
                self.roots.extend([q, *value]);
            }
            Load::Along { measure, force, .. } => self.roots.extend([*measure, *force]),
            Load::Torque { on, torque } => {
                self.roots.extend(torque);
                self.add_place(*on);
            }
        }
    }

    /// All circles, and the points of contacts.
    fn add_circles(&mut self) {
        let contacts = self.model.contacts.iter();
        let points = contacts.filter_map(|contact| match &contact.geometry {
            ContactGeometry::Point { point, .. } => Some(point),
            _ => None,
        });
        for circle in self.model.circles.iter().chain(points) {
            self.roots.extend(&circle.center);
            self.roots.push(circle.radius);
            self.add_place(circle.on);
        }
    }

    /// The frame of a line or plane; circles are added by [`add_circles`](Self::add_circles).
    fn add_surface(&mut self, surface: Surface) {
        if let Surface::Along(frame) = surface {
            self.add_pose(frame);
        }
    }

    fn add_contact(&mut self, contact: &Contact<'d>) {
        match &contact.geometry {
            ContactGeometry::Circles(touching) => self.add_surface(touching.surface),
            ContactGeometry::Point { surface, .. } => self.add_surface(*surface),
            ContactGeometry::Corner(Corner {
                polygon: own,
                other_polygon: other,
                ..
            }) => {
                for polygon in [own, other] {
                    self.add_place(polygon.on);
                    self.roots.extend(polygon.corners.iter().flatten());
                }
            }
            ContactGeometry::Expressions { gap, slip, across } => {
                self.roots.extend([*gap, *slip]);
                self.roots.extend(across);
            }
        }
        self.roots.extend(contact.response.coefficients());
        self.roots.extend(contact.friction);
        self.roots.extend(contact.static_friction);
        self.roots.extend(contact.rolling_resistance);
    }

    fn add_sliding(&mut self, sliding: &Sliding<'d>) {
        self.add_body(sliding.body);
        self.add_place(sliding.on);
        let normal = sliding.normal.iter().flatten();
        self.roots.extend(sliding.direction.iter().chain(normal));
        self.roots.push(sliding.friction);
        self.roots.extend(sliding.static_friction);
    }
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

/// `T`, `V` and `D`.
fn energies_of<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> [S; 3] {
    [
        kinetic_energy(model, x),
        potential_energy(model, x),
        dissipation(model, x),
    ]
}

/// `½ Σ m ẋ·ẋ + ½ Σ ωᵀI ω`, with the angular velocity of (E9).
fn kinetic_energy<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let mut twice_the_energy = S::ZERO;
    for body in &model.bodies {
        let mut square = S::ZERO;
        for &at in &body.at {
            let rate = x.rate(at);
            square = square + rate * rate;
        }
        twice_the_energy = twice_the_energy + x.value(body.mass) * square;
        match (&body.inertia, &body.rotation) {
            (&Inertia::Planar(inertia), _) => {
                if let Some(angle) = angle(model, body) {
                    let rate = x.rate(angle);
                    twice_the_energy = twice_the_energy + x.value(inertia) * rate * rate;
                }
            }
            (Inertia::Tensor(tensor), &Rotation::Frame(pose)) => {
                let e = &model.poses[pose.index()].axes;
                let dot = |k: usize, l: usize| {
                    let mut sum = S::ZERO;
                    for (&a, &b) in e[k].iter().zip(&e[l]) {
                        sum = sum + x.value(a) * x.rate(b);
                    }
                    sum
                };
                let w = [dot(2, 1), dot(0, 2), dot(1, 0)];
                let [xx, yy, zz, xy, xz, yz] = vector::value(x.vector(tensor));
                let twice = |e| e + e;
                twice_the_energy = twice_the_energy
                    + xx * w[0] * w[0]
                    + yy * w[1] * w[1]
                    + zz * w[2] * w[2]
                    + twice(xy * w[0] * w[1])
                    + twice(xz * w[0] * w[2])
                    + twice(yz * w[1] * w[2]);
            }
            (Inertia::Particle | Inertia::Tensor(_), _) => {}
        }
    }
    twice_the_energy * S::from_ratio(1, 2)
}

/// `Σ ½ c s² + Σ U − Σ m g·x`.
fn potential_energy<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let half = S::from_ratio(1, 2);
    let mut energy = S::ZERO;
    for stored in model.stored() {
        energy = energy
            + match stored {
                Energy::Quadratic(of) => {
                    let deformation = x.value(of.measure);
                    half * x.value(of.coefficient) * deformation * deformation
                }
                Energy::Given(value) => x.value(*value),
            };
    }
    if let Some(gravity) = model.gravity() {
        for body in &model.bodies {
            let mut along = S::ZERO;
            for (&g, &at) in gravity.iter().zip(&body.at) {
                along = along + x.value(g) * x.value(at);
            }
            energy = energy - x.value(body.mass) * along;
        }
    }
    energy
}

/// `Σ ½ b ṡ² + Σ R`.
fn dissipation<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let half = S::from_ratio(1, 2);
    let mut dissipation = S::ZERO;
    for dissipated in model.dissipated() {
        dissipation = dissipation
            + match dissipated {
                Energy::Quadratic(of) => {
                    let rate = x.rate(of.measure);
                    half * x.value(of.coefficient) * rate * rate
                }
                Energy::Given(value) => x.value(*value),
            };
    }
    dissipation
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

/// The relative motion of what touches in a contact.
struct Touch<R> {
    gap: Moving<R>,
    slip: Varied<R>,
    /// The other component of the slip, in space.
    across: Option<Varied<R>>,
    /// Of a corner of a polygon its distance outside the other polygon, and its distance beyond the ends of the face.
    face: Option<(Moving<R>, Moving<R>)>,
}

/// The position of a corner of a polygon relative to another polygon.
struct CornerOnPolygon<R> {
    /// Its distance outside the polygon.
    opening: Moving<R>,
    /// Its distance outside the face that separates best.
    height: Moving<R>,
    /// Its distance beyond the ends of that face.
    beyond: Moving<R>,
    /// Its slip velocity along the face, in the direction that points outwards if it is turned left.
    slip: Varied<R>,
}

/// A polygon relative to another one, in ground axes.
struct PolygonPair<'d, R> {
    polygons: [Rc<Polygon<'d>>; 2],
    /// The corners of the first.
    points: Vec<[Moving<R>; 2]>,
    /// The corners of the other, at which its faces begin.
    ends: Vec<[Moving<R>; 2]>,
    /// Unit vectors along these faces.
    edges: Vec<[Moving<R>; 2]>,
    /// 1 for the face that separates best, else 0.
    weights: Vec<Moving<R>>,
    /// The angular velocity of the other.
    turning: Varied<R>,
}

impl<'d, R: Scalar> PolygonPair<'d, R> {
    fn new(model: &Model<'d>, corner: &Corner<'d>, x: &Values<'_, Varied<R>>) -> Self {
        let [first, other] = [&corner.polygon, &corner.other_polygon];
        let corners = |polygon: &Polygon<'_>| {
            let mut corners = Vec::with_capacity(polygon.corners.len());
            for at in &polygon.corners {
                corners.push(point_and_angular_velocity(model, polygon.on, at, x).0);
            }
            corners
        };
        let (points, ends) = (corners(first), corners(other));
        let (_, turning) = point_and_angular_velocity(model, other.on, &other.corners[0], x);
        let faces = ends.len();
        let mut edges = Vec::with_capacity(faces);
        for k in 0..faces {
            let edge = difference(ends[(k + 1) % faces], ends[k]);
            edges.push(scaled(Moving::<R>::ONE / dot(edge, edge).sqrt(), edge));
        }
        let mut pair = PolygonPair {
            polygons: [first.clone(), other.clone()],
            points,
            ends,
            edges,
            weights: vec![Moving::<R>::ZERO; faces],
            turning,
        };
        let mut separations = Vec::with_capacity(faces);
        for k in 0..faces {
            let mut distances = Vec::with_capacity(pair.points.len());
            for &point in &pair.points {
                distances.push(pair.distance(k, point));
            }
            separations.push(extreme(&distances, Moving::min));
        }
        let half = Moving::<R>::from_ratio(1, 2);
        // From the last face to the first: `left` is 1 as long as no later face separates better than all before it, else 0.
        let mut so_far = separations.clone();
        for k in 1..faces {
            so_far[k] = so_far[k - 1].max(separations[k]);
        }
        let mut left = Moving::<R>::ONE;
        for k in (1..faces).rev() {
            let is_better = half * (Moving::<R>::ONE + (separations[k] - so_far[k - 1]).sign());
            pair.weights[k] = left * is_better;
            left = left * (Moving::<R>::ONE - is_better);
        }
        pair.weights[0] = left;
        pair
    }

    /// Whether these are the polygons of a corner.
    fn is_of(&self, corner: &Corner<'d>) -> bool {
        let [first, other] = &self.polygons;
        Rc::ptr_eq(first, &corner.polygon) && Rc::ptr_eq(other, &corner.other_polygon)
    }

    /// The distance of a point outside the line along a face.
    fn distance(&self, face: usize, point: [Moving<R>; 2]) -> Moving<R> {
        let (arm, edge) = (difference(point, self.ends[face]), self.edges[face]);
        arm[0] * edge[1] - arm[1] * edge[0]
    }

    /// The position and motion of a corner of the first polygon.
    fn corner(&self, corner: usize) -> CornerOnPolygon<R> {
        let place = self.points[corner];
        let faces = self.ends.len();
        let mut distances = Vec::with_capacity(faces);
        for k in 0..faces {
            distances.push(self.distance(k, place));
        }
        let mut corner_on_polygon = CornerOnPolygon {
            opening: extreme(&distances, Moving::max),
            height: Moving::<R>::ZERO,
            beyond: Moving::<R>::ZERO,
            slip: Varied::<R>::ZERO,
        };
        for k in 0..faces {
            let weight = self.weights[k];
            let mut others = distances.clone();
            others.remove(k);
            corner_on_polygon.height = corner_on_polygon.height + weight * distances[k];
            corner_on_polygon.beyond =
                corner_on_polygon.beyond + weight * extreme(&others, Moving::max);
            // The polygon's own point under the corner moves with the end of the face, and turns about it.
            let arm = difference(place, self.ends[k]);
            let carried = scaled(self.turning, turned_left(vector::value(arm)));
            let velocity = difference(vector::rate(arm), carried);
            let slip = dot(vector::value(self.edges[k]), velocity);
            corner_on_polygon.slip = corner_on_polygon.slip - weight.value * slip;
        }
        corner_on_polygon
    }
}

/// The smallest or the largest of some numbers, compared from the last to the first; 0 of none.
fn extreme<S: Scalar>(all: &[S], pick: fn(S, S) -> S) -> S {
    let Some(&last) = all.last() else {
        return S::ZERO;
    };
    let mut extreme = last;
    for k in (0..all.len() - 1).rev() {
        extreme = pick(extreme, all[k]);
    }
    extreme
}

/// The distance of a circle from touching a surface, and the slip velocity of the touching points.
fn on_surface<R: Scalar>(
    model: &Model<'_>,
    circle: &Circle<'_>,
    surface: Surface,
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    match surface {
        Surface::Inside(other) => on_circle(model, circle, &model.circles[other], true, x),
        Surface::Outside(other) => on_circle(model, circle, &model.circles[other], false, x),
        Surface::Along(pose) => on_line(model, circle, pose, x),
    }
}

/// The distance of a circle from touching another, inside or outside of it, and the slip velocity
/// of the touching points, along the direction from the other's centre turned left.
fn on_circle<R: Scalar>(
    model: &Model<'_>,
    first: &Circle<'_>,
    other: &Circle<'_>,
    is_inside: bool,
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    let (centre, omega) = centre_and_angular_velocity(model, first, x);
    let (other_centre, other_omega) = centre_and_angular_velocity(model, other, x);
    let line = difference(centre, other_centre);
    let distance = dot(line, line).sqrt();
    let (small, large) = (x.at(first.radius), x.at(other.radius));
    let gap = if is_inside {
        large - small - distance
    } else {
        distance - small - large
    };
    // The touching point: the first circle's at c ± r e, the other's at R e.
    let e = quotient(vector::value(line), distance.value);
    let arm = if is_inside { small.value } else { -small.value };
    let rate = dot(turned_left(e), vector::rate(line));
    let slip = rate + arm * omega - large.value * other_omega;
    [gap, Dual::constant(slip)]
}

/// Gap and slip of a circle on the first axis of a frame, on the side of the second axis.
fn on_line<R: Scalar>(
    model: &Model<'_>,
    circle: &Circle<'_>,
    pose: PoseId,
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    let frame = &model.poses[pose.index()];
    let (centre, omega) = centre_and_angular_velocity(model, circle, x);
    let line = difference(centre, x.vector(&frame.origin));
    let (along, across) = (x.vector(&frame.axes[0]), x.vector(&frame.axes[1]));
    let radius = x.at(circle.radius);
    let gap = dot(across, line) - radius;
    let rate = dot(vector::value(along), vector::rate(line));
    [gap, Dual::constant(rate + radius.value * omega)]
}
