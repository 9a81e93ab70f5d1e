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

use lagrangian_scalar::{Dual, Scalar};
use lagrangian_symbolic::{Expr, Id, Symbol, evaluate};
use rustc_hash::FxHashMap;

use frozen::Frozen;
use lagrangian_spec::model::element::{Energy, Load, Sliding};
use lagrangian_spec::model::polygons::{Corner, Polygon};
use lagrangian_spec::model::{
    ApproximationKind, Body, Circle, Contact, ContactGeometry, Inertia, Model, Place, PoseId,
    Rotation, Space, Surface, Touching, quaternion,
};

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
    /// All expressions that are evaluated along the motion.
    pub roots: Vec<Expr<'d>>,
    /// Those that the kinetic energy needs.
    kinetic: Vec<Expr<'d>>,
    /// Those that the other energies need.
    energies: Vec<Expr<'d>>,
    /// For each constraint of the model whether it constrains positions.
    holonomic: Vec<bool>,
    /// Whether each coordinate counts as small.
    small: Vec<bool>,
    /// Whether each coordinate is frozen.
    frozen: Vec<bool>,
}

/// A number along a motion: a value and its rate.
trait Path: Scalar {
    type Base: Scalar;
    fn value(self) -> Self::Base;
    fn rate(self) -> Self::Base;
}

impl<S: Scalar> Path for Dual<S> {
    type Base = S;
    fn value(self) -> S {
        self.value
    }
    fn rate(self) -> S {
        self.derivative
    }
}

impl<S: Scalar> Path for Frozen<S> {
    type Base = S;
    fn value(self) -> S {
        self.moving.value
    }
    fn rate(self) -> S {
        self.moving.derivative
    }
}

/// Values by the nodes of their expressions.
type Values<P> = FxHashMap<Id, P>;

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
        let (kinetic, energies) = (kinetic(model), energies(model));
        let mut roots = kinetic.clone();
        roots.extend(&energies);
        roots.extend(geometry(model));
        Lagrange {
            model,
            meanings: meanings(model),
            roots,
            kinetic,
            energies,
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

    /// The values of the equations at a state, for the direction `w`.
    pub fn at<R: Scalar>(&self, at: &State<R>, w: &[R]) -> Literal<R> {
        let model = self.model;
        let of_state = |symbol| self.moving(symbol, at, w);
        let values = all(model, &self.roots, of_state);
        let x = |e: Expr<'d>| values[&e.id()];
        let [t, v, d] = match [&self.frozen, &self.small].map(|list| list.contains(&true)) {
            [false, false] => [
                kinetic_energy(model, &x),
                potential_energy(model, &x),
                dissipation(model, &x),
            ],
            [true, false] => [
                self.frozen_energy(|symbol| self.moving(symbol, at, w)),
                potential_energy(model, &x),
                dissipation(model, &x),
            ],
            [is_frozen, true] => self.approximated(at, w, is_frozen),
        };
        let force = self.virtual_work(&x);
        let [of_length, on_length, of_lengths] = lengths(model, &x);
        let states = model.coordinates.iter().enumerate();
        let states = states.filter_map(|(i, c)| Some((i, c.rate?)));
        let stored = self.stored(at);
        let changing = states.clone().map(|(i, _)| w[i] * at.a[i]);
        let rates = states.map(|(i, rate)| w[i] * x(rate).value.value.value);
        Literal {
            kinetic_energy: t.value.value,
            potential_energy: v.value.value,
            dissipation: d.value.value,
            state_energy: stored.value,
            energy_rate: t.derivative.value + v.derivative.value + stored.derivative,
            power_loss: sum(model.losses().map(|power| x(power).value.value.value)),
            inertia: sum(changing) + t.derivative.derivative + of_length,
            applied: v.derivative.derivative - d.value.derivative + force + sum(rates) + on_length,
            length_power: of_lengths,
            constraints: self.constraints(&x),
            sliding: model
                .sliding()
                .into_iter()
                .map(|s| self.sliding(s, &x))
                .collect(),
            unilateral: model
                .contacts
                .iter()
                .flat_map(|contact| self.unilateral(contact, &x))
                .collect(),
        }
    }

    /// The energy stored in first-order states, with its rate along the motion.
    fn stored<R: Scalar>(&self, at: &State<R>) -> Dual<R> {
        let model = self.model;
        let energies: Vec<Expr<'d>> = model.energies_of_states().collect();
        if energies.is_empty() {
            return Dual::constant(R::ZERO);
        }
        let rates_of_states: Vec<Expr<'d>> =
            model.coordinates.iter().filter_map(|c| c.rate).collect();
        let mut rates_of_states = self.values(&rates_of_states, at).into_iter();
        let rates = model.coordinates.iter().zip(&at.a);
        let rates: Vec<R> = rates
            .map(|(c, &a)| c.rate.and_then(|_| rates_of_states.next()).unwrap_or(a))
            .collect();
        let values = all(model, &energies, |symbol| {
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
                    derivative: rates[i],
                },
                Some(&Meaning::Parameter(i)) => Dual::constant(at.parameters[i]),
                Some(&Meaning::Input(i)) => Dual::constant(at.u[i]),
                Some(&Meaning::Acceleration(i)) => Dual::constant(at.a[i]),
                None => undefined(),
            }
        });
        energies
            .iter()
            .fold(Dual::constant(R::ZERO), |sum, energy| {
                sum + values[&energy.id()]
            })
    }

    /// `w·∂D/∂v` alone.
    pub fn damping<R: Scalar>(&self, at: &State<R>, w: &[R]) -> R {
        let model = self.model;
        let dissipation = if self.small.contains(&true) {
            let values = all(model, &self.energies, |symbol| self.small(symbol, at, w));
            expanded(dissipation(model, &|e: Expr<'d>| values[&e.id()]))
        } else {
            let values = all(model, &self.energies, |symbol| self.moving(symbol, at, w));
            dissipation(model, &|e: Expr<'d>| values[&e.id()])
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
        let values = all(self.model, &self.kinetic, |symbol| {
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
        kinetic_energy(self.model, &|e: Expr<'d>| values[&e.id()])
    }

    /// The energies and the dissipation to second order in small coordinates, (E17), with
    /// velocities that may be frozen.
    fn approximated<R: Scalar>(&self, at: &State<R>, w: &[R], is_frozen: bool) -> [Varied<R>; 3] {
        let model = self.model;
        let of_state = |symbol| self.small(symbol, at, w);
        let mut roots = self.energies.clone();
        if !is_frozen {
            roots.extend(&self.kinetic);
        }
        let values = all(model, &roots, of_state);
        let x = |e: Expr<'d>| values[&e.id()];
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
    fn virtual_work<R: Scalar>(&self, x: &impl Fn(Expr<'d>) -> Moving<R>) -> R {
        let model = self.model;
        let here = |e: Expr<'d>| x(e).value.value.value;
        // The displacement along w: q contains w with the coefficient −τε.
        let moved = |e: Expr<'d>| -x(e).value.derivative.derivative;
        let of_torque = |on: Place, torque: &[Expr<'d>]| {
            let mut work = R::ZERO;
            match (model.space, model.rotation(on)) {
                (Space::Plane, rotation) => {
                    if let Some(angle) = rotation_angle(model, rotation) {
                        work = here(torque[0]) * moved(angle);
                    }
                }
                (Space::Space, Rotation::Frame(pose)) => {
                    // The rotation is ½ Σ e × δe, in ground axes.
                    for e in &model.poses[pose.index()].axes {
                        for (k, &torque) in torque.iter().enumerate() {
                            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                            let turn =
                                here(e[next]) * moved(e[last]) - here(e[last]) * moved(e[next]);
                            work = work + here(torque) * turn * R::from_ratio(1, 2);
                        }
                    }
                }
                (Space::Space, _) => {}
            }
            work
        };
        let of_load = |load: &Load<'d>| match load {
            Load::Point { at, force } => {
                let pairs = at.iter().zip(force);
                sum(pairs.map(|(&at, &force)| here(force) * moved(at)))
            }
            &Load::Coordinate { coordinate, value } => {
                here(value) * moved(model.coordinates[coordinate].q)
            }
            &Load::Along { measure, force, .. } => here(force) * moved(measure),
            Load::Torque { on, torque } => of_torque(*on, torque),
        };
        sum(model.loads().map(of_load))
    }

    fn constraints<R: Scalar>(
        &self,
        x: &impl Fn(Expr<'d>) -> Moving<R>,
    ) -> Vec<LiteralConstraint<R>> {
        let model = self.model;
        let mut all: Vec<LiteralConstraint<R>> = model
            .constraints()
            .into_iter()
            .zip(&self.holonomic)
            .map(|(constraint, holonomic)| {
                if *holonomic {
                    of_position(x(constraint.expression))
                } else {
                    of_rate(x(constraint.expression).value)
                }
            })
            .collect();
        for rolling in model.rolling() {
            let circle = &model.circles[rolling.circles.circle];
            let [gap, slip] = on_surface(model, circle, rolling.circles.surface, x);
            all.extend([of_position(gap), of_rate(slip.value)]);
        }
        all
    }

    fn unilateral<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        x: &impl Fn(Expr<'d>) -> Moving<R>,
    ) -> Vec<LiteralUnilateral<R>> {
        let model = self.model;
        let touch = |round: &Circle<'d>, surface: Surface| match model.space {
            Space::Plane => {
                let [gap, slip] = on_surface(model, round, surface, x);
                (gap, slip.value, None)
            }
            Space::Space => {
                let (gap, [slip, across]) = in_space::gap_and_slip(model, round, surface, x);
                (gap, slip, Some(across))
            }
        };
        let mut of_face = None;
        let (gap, slip, across) = match &contact.geometry {
            ContactGeometry::Corner(corner) => {
                let corner_motion = on_polygon(model, corner, x);
                of_face = Some((corner_motion.opening, corner_motion.beyond));
                (corner_motion.height, corner_motion.slip, None)
            }
            ContactGeometry::Circles(touching) => {
                touch(&model.circles[touching.circle], touching.surface)
            }
            ContactGeometry::Point { point, surface } => touch(point, *surface),
            ContactGeometry::Expressions { gap, slip, across } => (
                x(*gap),
                x(*slip).value,
                across.map(|across| x(across).value),
            ),
        };
        let here = |e: Expr<'d>| x(e).value.value.value;
        let known = |e: Option<Expr<'d>>| e.map_or(R::ZERO, here);
        let friction = contact.friction;
        let nothing = Varied::<R>::ZERO;
        let mut all = vec![LiteralUnilateral {
            opening: of_position(of_face.map_or(gap, |(open, _)| open)),
            gap: of_position(gap),
            face: of_face.map(|(_, beyond)| {
                let rate = beyond.derivative.value.value;
                [gap.value.value.value, beyond.value.value.value, rate]
            }),
            // Without friction the slip is not used.
            slip: of_rate(friction.map_or(nothing, |_| slip)),
            coefficients: [
                here(contact.response.coefficients()[0]),
                here(contact.response.coefficients()[1]),
                known(friction),
                known(contact.static_friction.or(friction)),
            ],
        }];
        if let (Some(_), Some(across)) = (friction, across) {
            all.push(LiteralUnilateral {
                slip: of_rate(across),
                ..all[0]
            });
        }
        if let (ContactGeometry::Circles(touching), Some(resistance)) =
            (&contact.geometry, contact.rolling_resistance)
        {
            let (_, own) = centre_and_angular_velocity(model, &model.circles[touching.circle], x);
            let other = match touching.surface {
                Surface::Inside(other) | Surface::Outside(other) => {
                    centre_and_angular_velocity(model, &model.circles[other], x).1
                }
                Surface::Along(pose) => x(model.poses[pose.index()].angle).derivative,
            };
            all.push(LiteralUnilateral {
                opening: of_position(gap),
                gap: of_position(gap),
                face: None,
                slip: of_rate(own - other),
                coefficients: [R::ZERO, R::ZERO, here(resistance), here(resistance)],
            });
        }
        all
    }

    fn sliding<R: Scalar>(
        &self,
        sliding: &Sliding<'d>,
        x: &impl Fn(Expr<'d>) -> Moving<R>,
    ) -> LiteralSliding<R> {
        let model = self.model;
        let here = |e: Expr<'d>| x(e).value;
        let body = &model.bodies[sliding.body];
        let at = match body.rotation {
            Rotation::Frame(pose) => &model.poses[pose.index()].origin,
            Rotation::Angle(_) | Rotation::Unspecified => &body.at,
        };
        let origin = match sliding.on {
            Place::Frame(pose) => &model.poses[pose.index()].origin,
            Place::Body(on) => &model.bodies[on].at,
        };
        let dimension = at.len();
        let arm: Vec<Varied<R>> = (0..dimension)
            .map(|k| here(at[k]) - here(origin[k]))
            .collect();
        let rotation = model.rotation(sliding.on);
        let carried: Vec<Varied<R>> = match (model.space, rotation) {
            (Space::Plane, rotation) => {
                let turned = rotation_angle(model, rotation);
                let turning = turned.map_or(Varied::<R>::ZERO, |angle| x(angle).derivative);
                vec![-(turning * arm[1]), turning * arm[0]]
            }
            // `ω × r = Σ ėₖ (eₖ·r)` over the axes of the base.
            (Space::Space, Rotation::Frame(pose)) => {
                let axes = &model.poses[pose.index()].axes;
                let along =
                    |axis: &Vec<Expr<'d>>| sum(axis.iter().zip(&arm).map(|(&e, &r)| here(e) * r));
                let along: Vec<Varied<R>> = axes.iter().map(along).collect();
                let component = |i: usize| {
                    sum(axes
                        .iter()
                        .zip(&along)
                        .map(|(e, &r)| x(e[i]).derivative * r))
                };
                (0..dimension).map(component).collect()
            }
            (Space::Space, _) => vec![Varied::<R>::ZERO; dimension],
        };
        let velocity: Vec<Varied<R>> = (0..dimension)
            .map(|k| x(at[k]).derivative - x(origin[k]).derivative - carried[k])
            .collect();
        let direction: Vec<Varied<R>> = sliding.direction.iter().map(|&e| here(e)).collect();
        let length = sum(direction.iter().map(|&e| e * e)).sqrt();
        let along: Vec<Varied<R>> = direction.into_iter().map(|e| e / length).collect();
        let dot = |u: &[Varied<R>], v: &[Varied<R>]| sum(u.iter().zip(v).map(|(&a, &b)| a * b));
        let slip = dot(&along, &velocity);
        let axes: Vec<Vec<Varied<R>>> = match model.space {
            Space::Plane => vec![vec![-along[1], along[0]]],
            Space::Space => (0..dimension)
                .map(|k| {
                    (0..dimension)
                        .map(|i| Varied::<R>::from_ratio(i64::from(i == k), 1))
                        .collect()
                })
                .collect(),
        };
        let side = match &sliding.normal {
            Some(normal) if model.space == Space::Plane => {
                let normal: Vec<Varied<R>> = normal.iter().map(|&e| here(e)).collect();
                dot(&normal, &axes[0]).value.value
            }
            _ => R::ONE,
        };
        let telling: Vec<R> = match (sliding.tangent, &sliding.normal) {
            (Some(_), Some(normal)) => {
                let normal: Vec<R> = normal.iter().map(|&e| here(e).value.value).collect();
                let square = normal.iter().fold(R::ZERO, |sum, &x| sum + x * x);
                let length = square.sqrt();
                normal.into_iter().map(|x| x / length).collect()
            }
            _ => along.iter().map(|e| e.value.value).collect(),
        };
        LiteralSliding {
            reference_direction: telling,
            slip: slip.value.value,
            slip_rate: slip.derivative.value,
            slip_along: slip.value.derivative,
            off_along: axes
                .iter()
                .map(|axis| dot(axis, &velocity).value.derivative)
                .collect(),
            axes: axes
                .iter()
                .map(|axis| axis.iter().map(|x| x.value.value).collect())
                .collect(),
            side,
            coefficients: [
                sliding.friction,
                sliding.static_friction.unwrap_or(sliding.friction),
            ]
            .map(|e| here(e).value.value),
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

/// The values of expressions by their nodes.
fn all<'d, P: Scalar>(
    model: &Model<'d>,
    roots: &[Expr<'d>],
    value: impl FnMut(Symbol) -> P,
) -> Values<P> {
    let values = evaluate(model.dag, roots, value);
    roots.iter().map(|root| root.id()).zip(values).collect()
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
fn lengths<'d, R: Scalar>(model: &Model<'d>, x: &impl Fn(Expr<'d>) -> Moving<R>) -> [R; 3] {
    let half = Varied::<R>::from_ratio(1, 2);
    let two = R::from_ratio(2, 1);
    let mut all = [R::ZERO; 3];
    for four in &model.quaternions {
        let e = four.e.map(|e| x(e).value);
        let e_rate = four.e.map(|e| x(e).derivative);
        let square = sum(e.map(|e| e * e));
        let growing = sum((0..4).map(|k| e[k] * e_rate[k])) / square;
        let inertia = x(four.inertia).value;
        let energy = half * inertia * growing * growing;
        // The change of half the logarithm of the square along w: q contains w with the coefficient −τε.
        let s = square.value.value;
        let moved = -(square.derivative.derivative / (two * s));
        let rate = R::from_ratio(quaternion::RATE, 1);
        let fast = sum(e_rate.map(|rate| rate * rate)).value.value / s;
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
    let mut roots: Vec<Expr<'d>> = Vec::new();
    let pose = |pose: PoseId, roots: &mut Vec<Expr<'d>>| {
        let pose = &model.poses[pose.index()];
        roots.extend(pose.origin.iter().chain(pose.axes.iter().flatten()));
        roots.push(pose.angle);
    };
    let body = |index: usize, roots: &mut Vec<Expr<'d>>| {
        let body = &model.bodies[index];
        roots.extend(&body.at);
        match body.rotation {
            Rotation::Unspecified => {}
            Rotation::Angle(angle) => roots.push(angle),
            Rotation::Frame(frame) => pose(frame, roots),
        }
    };
    let place = |place: Place, roots: &mut Vec<Expr<'d>>| match place {
        Place::Frame(frame) => pose(frame, roots),
        Place::Body(index) => body(index, roots),
    };
    for load in model.loads() {
        match load {
            Load::Point { at, force } => roots.extend(at.iter().chain(force)),
            Load::Coordinate { coordinate, value } => {
                roots.extend([model.coordinates[*coordinate].q, *value]);
            }
            Load::Along { measure, force, .. } => roots.extend([*measure, *force]),
            Load::Torque { on, torque } => {
                roots.extend(torque);
                place(*on, &mut roots);
            }
        }
    }
    for four in &model.quaternions {
        roots.extend(four.e);
        roots.push(four.inertia);
    }
    roots.extend(model.coordinates.iter().filter_map(|c| c.rate));
    roots.extend(model.losses());
    roots.extend(model.constraints().into_iter().map(|c| c.expression));
    if !model.rolling().is_empty() || !model.contacts.is_empty() {
        let points = model
            .contacts
            .iter()
            .filter_map(|contact| match &contact.geometry {
                ContactGeometry::Point { point, .. } => Some(point),
                _ => None,
            });
        for circle in model.circles.iter().chain(points) {
            roots.extend(&circle.center);
            roots.push(circle.radius);
            place(circle.on, &mut roots);
        }
    }
    for contact in &model.contacts {
        match &contact.geometry {
            ContactGeometry::Circles(Touching {
                surface: Surface::Along(frame),
                ..
            })
            | ContactGeometry::Point {
                surface: Surface::Along(frame),
                ..
            } => pose(*frame, &mut roots),
            ContactGeometry::Corner(Corner {
                polygon: own,
                other_polygon: other,
                ..
            }) => {
                for polygon in [own, other] {
                    place(polygon.on, &mut roots);
                    roots.extend(polygon.corners.iter().flatten());
                }
            }
            ContactGeometry::Expressions { gap, slip, across } => {
                roots.extend([*gap, *slip]);
                roots.extend(across);
            }
            _ => {}
        }
        roots.extend(contact.response.coefficients());
        roots.extend(contact.friction);
        roots.extend(contact.static_friction);
        roots.extend(contact.rolling_resistance);
    }
    for rolling in model.rolling() {
        if let Surface::Along(frame) = rolling.circles.surface {
            pose(frame, &mut roots);
        }
    }
    for sliding in model.sliding() {
        body(sliding.body, &mut roots);
        place(sliding.on, &mut roots);
        roots.extend(
            sliding
                .direction
                .iter()
                .chain(sliding.normal.iter().flatten()),
        );
        roots.push(sliding.friction);
        roots.extend(sliding.static_friction);
    }
    roots
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

fn sum<S: Scalar>(terms: impl IntoIterator<Item = S>) -> S {
    terms.into_iter().fold(S::ZERO, |sum, term| sum + term)
}

/// `½ Σ m ẋ·ẋ + ½ Σ ωᵀI ω`, with the angular velocity of (E9).
fn kinetic_energy<'d, P: Path>(model: &Model<'d>, x: &impl Fn(Expr<'d>) -> P) -> P::Base {
    let of_body = |body: &Body<'d>| {
        let speed = sum(body.at.iter().map(|&at| {
            let rate = x(at).rate();
            rate * rate
        }));
        let turning = match (&body.inertia, &body.rotation) {
            (Inertia::Particle, _) => P::Base::ZERO,
            (&Inertia::Planar(inertia), _) => match angle(model, body) {
                Some(angle) => {
                    let rate = x(angle).rate();
                    x(inertia).value() * rate * rate
                }
                None => P::Base::ZERO,
            },
            (Inertia::Tensor(tensor), &Rotation::Frame(pose)) => {
                let e = &model.poses[pose.index()].axes;
                let dot = |k: usize, l: usize| {
                    let pairs = e[k].iter().zip(&e[l]);
                    sum(pairs.map(|(&a, &b)| x(a).value() * x(b).rate()))
                };
                let w = [dot(2, 1), dot(0, 2), dot(1, 0)];
                let [xx, yy, zz, xy, xz, yz] = tensor.map(|entry| x(entry).value());
                let twice = |e| e + e;
                xx * w[0] * w[0]
                    + yy * w[1] * w[1]
                    + zz * w[2] * w[2]
                    + twice(xy * w[0] * w[1])
                    + twice(xz * w[0] * w[2])
                    + twice(yz * w[1] * w[2])
            }
            (Inertia::Tensor(_), _) => P::Base::ZERO,
        };
        x(body.mass).value() * speed + turning
    };
    sum(model.bodies.iter().map(of_body)) * P::Base::from_ratio(1, 2)
}

/// `Σ ½ c s² + Σ U − Σ m g·x`.
fn potential_energy<'d, P: Path>(model: &Model<'d>, x: &impl Fn(Expr<'d>) -> P) -> P::Base {
    let here = |e: Expr<'d>| x(e).value();
    let half = P::Base::from_ratio(1, 2);
    let stored = model.stored().map(|energy| match energy {
        Energy::Quadratic(of) => {
            let deformation = here(of.measure);
            half * here(of.coefficient) * deformation * deformation
        }
        Energy::Given(value) => here(*value),
    });
    let weights = model.gravity().into_iter().flat_map(|gravity| {
        model.bodies.iter().map(|body| {
            let along = gravity.iter().zip(&body.at);
            -(here(body.mass) * sum(along.map(|(&g, &at)| here(g) * here(at))))
        })
    });
    sum(stored.chain(weights))
}

/// `Σ ½ b ṡ² + Σ R`.
fn dissipation<'d, P: Path>(model: &Model<'d>, x: &impl Fn(Expr<'d>) -> P) -> P::Base {
    let half = P::Base::from_ratio(1, 2);
    sum(model.dissipated().map(|energy| match energy {
        Energy::Quadratic(of) => {
            let rate = x(of.measure).rate();
            half * x(of.coefficient).value() * rate * rate
        }
        Energy::Given(value) => x(*value).value(),
    }))
}

/// The centre of a circle, and the angular velocity of what it is fixed to.
fn centre_and_angular_velocity<'d, R: Scalar>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> ([Moving<R>; 2], Varied<R>) {
    let [c, d] = [0, 1].map(|k| circle.center[k]);
    point_and_angular_velocity(model, circle.on, [c, d], x)
}

/// The position of a point fixed to a frame or a body, and the angular velocity of that.
fn point_and_angular_velocity<'d, R: Scalar>(
    model: &Model<'d>,
    on: Place,
    point: [Expr<'d>; 2],
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> ([Moving<R>; 2], Varied<R>) {
    let of_pose = |pose: PoseId| {
        let pose = &model.poses[pose.index()];
        [0, 1].map(|k| [0, 1].map(|l| x(pose.axes[k][l])))
    };
    let ground = [
        [Moving::<R>::ONE, Moving::<R>::ZERO],
        [Moving::<R>::ZERO, Moving::<R>::ONE],
    ];
    let (origin, axes, turned) = match on {
        Place::Frame(pose) => {
            let frame = &model.poses[pose.index()];
            (&frame.origin, of_pose(pose), Some(frame.angle))
        }
        Place::Body(body) => {
            let body = &model.bodies[body];
            let axes = match body.rotation {
                Rotation::Unspecified => ground,
                Rotation::Angle(angle) => {
                    let (sin, cos) = x(angle).sin_cos();
                    [[cos, sin], [-sin, cos]]
                }
                Rotation::Frame(pose) => of_pose(pose),
            };
            (&body.at, axes, angle(model, body))
        }
    };
    let [c, d] = point.map(x);
    let centre = [0, 1].map(|l| x(origin[l]) + c * axes[0][l] + d * axes[1][l]);
    let turning = turned.map_or(Varied::<R>::ZERO, |angle| x(angle).derivative);
    (centre, turning)
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

/// The position of a corner of a polygon relative to another polygon: distances from lines through two corners of the latter,
/// all in ground axes.
fn on_polygon<'d, R: Scalar>(
    model: &Model<'d>,
    corner: &Corner<'d>,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> CornerOnPolygon<R> {
    let Corner {
        corner,
        polygon: own,
        other_polygon: other,
    } = corner;
    let corners = |polygon: &Polygon<'d>| -> Vec<[Moving<R>; 2]> {
        let place =
            |at: &Vec<Expr<'d>>| point_and_angular_velocity(model, polygon.on, [at[0], at[1]], x).0;
        polygon.corners.iter().map(place).collect()
    };
    let (points, ends) = (corners(own), corners(other));
    let (_, turning) = point_and_angular_velocity(
        model,
        other.on,
        [other.corners[0][0], other.corners[0][1]],
        x,
    );
    let faces = ends.len();
    // Unit vectors along the faces.
    let edges: Vec<[Moving<R>; 2]> = (0..faces)
        .map(|k| {
            let [a, b] = [0, 1].map(|i| ends[(k + 1) % faces][i] - ends[k][i]);
            let scale = Moving::<R>::ONE / (a * a + b * b).sqrt();
            [a * scale, b * scale]
        })
        .collect();
    let distance = |k: usize, point: [Moving<R>; 2]| {
        let arm = [0, 1].map(|i| point[i] - ends[k][i]);
        arm[0] * edges[k][1] - arm[1] * edges[k][0]
    };
    let fold = |mut all: Vec<Moving<R>>, pick: fn(Moving<R>, Moving<R>) -> Moving<R>| {
        let first = all.pop().unwrap_or(Moving::<R>::ZERO);
        all.into_iter().rev().fold(first, pick)
    };
    let separations: Vec<Moving<R>> = (0..faces)
        .map(|k| {
            fold(
                points.iter().map(|at| distance(k, *at)).collect(),
                Moving::min,
            )
        })
        .collect();
    let half = Moving::<R>::from_ratio(1, 2);
    // From the last face to the first: `left` is 1 as long as no later face separates better than all before it, else 0.
    let mut so_far: Vec<Moving<R>> = Vec::with_capacity(faces);
    for &separation in &separations {
        let best = so_far
            .last()
            .map_or(separation, |&best| best.max(separation));
        so_far.push(best);
    }
    let mut left = Moving::<R>::ONE;
    let mut weights = vec![Moving::<R>::ZERO; faces];
    for k in (1..faces).rev() {
        let is_better = half * (Moving::<R>::ONE + (separations[k] - so_far[k - 1]).sign());
        weights[k] = left * is_better;
        left = left * (Moving::<R>::ONE - is_better);
    }
    weights[0] = left;
    let place = points[*corner];
    let mut corner_on_polygon = CornerOnPolygon {
        opening: fold(
            (0..faces).map(|k| distance(k, place)).collect(),
            Moving::max,
        ),
        height: Moving::<R>::ZERO,
        beyond: Moving::<R>::ZERO,
        slip: Varied::<R>::ZERO,
    };
    for (k, &weight) in weights.iter().enumerate() {
        let others = (0..faces).filter(|j| *j != k);
        corner_on_polygon.height = corner_on_polygon.height + weight * distance(k, place);
        corner_on_polygon.beyond = corner_on_polygon.beyond
            + weight * fold(others.map(|j| distance(j, place)).collect(), Moving::max);
        // The polygon's own point under the corner moves with the end of the face, and turns about it.
        let arm = [0, 1].map(|i| (place[i] - ends[k][i]).value);
        let carried = [-(turning * arm[1]), turning * arm[0]];
        let along = [0, 1].map(|i| {
            let velocity = place[i].derivative - ends[k][i].derivative - carried[i];
            -edges[k][i].value * velocity
        });
        corner_on_polygon.slip = corner_on_polygon.slip + weight.value * (along[0] + along[1]);
    }
    corner_on_polygon
}

/// The distance of a circle from touching a surface, and the slip velocity of the touching points.
fn on_surface<'d, R: Scalar>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    surface: Surface,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> [Moving<R>; 2] {
    match surface {
        Surface::Inside(other) => on_circle(model, circle, &model.circles[other], true, x),
        Surface::Outside(other) => on_circle(model, circle, &model.circles[other], false, x),
        Surface::Along(pose) => on_line(model, circle, pose, x),
    }
}

/// The distance of a circle from touching another, inside or outside of it, and the slip velocity
/// of the touching points, along the direction from the other's centre turned left.
fn on_circle<'d, R: Scalar>(
    model: &Model<'d>,
    first: &Circle<'d>,
    other: &Circle<'d>,
    is_inside: bool,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> [Moving<R>; 2] {
    let (centre, omega) = centre_and_angular_velocity(model, first, x);
    let (other_centre, other_omega) = centre_and_angular_velocity(model, other, x);
    let line = [0, 1].map(|k| centre[k] - other_centre[k]);
    let distance = (line[0] * line[0] + line[1] * line[1]).sqrt();
    let (small, large) = (x(first.radius), x(other.radius));
    let gap = if is_inside {
        large - small - distance
    } else {
        distance - small - large
    };
    // The touching point: the first circle's at c ± r e, the other's at R e.
    let e = line.map(|c| c.value / distance.value);
    let tangent = [-e[1], e[0]];
    let arm = if is_inside { small.value } else { -small.value };
    let rate = tangent[0] * line[0].derivative + tangent[1] * line[1].derivative;
    let slip = rate + arm * omega - large.value * other_omega;
    [gap, Dual::constant(slip)]
}

/// Gap and slip of a circle on the first axis of a frame, on the side of the second axis.
fn on_line<'d, R: Scalar>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    pose: PoseId,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> [Moving<R>; 2] {
    let frame = &model.poses[pose.index()];
    let (centre, omega) = centre_and_angular_velocity(model, circle, x);
    let line = [0, 1].map(|k| centre[k] - x(frame.origin[k]));
    let [along, across] = [0, 1].map(|k| [0, 1].map(|l| x(frame.axes[k][l])));
    let radius = x(circle.radius);
    let gap = across[0] * line[0] + across[1] * line[1] - radius;
    let rate = along[0].value * line[0].derivative + along[1].value * line[1].derivative;
    [gap, Dual::constant(rate + radius.value * omega)]
}
