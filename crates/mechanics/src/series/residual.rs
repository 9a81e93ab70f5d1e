//! Derives the equations of motion of a model in the forms that series need.
//!
//! ```text
//! Rᵢ = Σ w ∂p/∂qᵢ p̈ − Qᵢ − Σ λ ∂g/∂qᵢ                   by positions
//! Rᵢ = d/dt ∂T/∂vᵢ − ∂T/∂qᵢ − Qᵢ − Σ λ ∂g/∂qᵢ           by momenta
//! ```
//!
//! The first is the shorter one for chains, and wherever velocities of several coordinates add up. In the second the momenta are rows, whose
//! derivatives cost no product either. It is the shorter one where velocities are taken along axes that turn: that of a top contains the sine of neither its
//! precession nor its spin, angles that may grow by many radians in a step. In the first, inertia is that of
//! scalar positions `p(q, t)` of constant weights `w`: coordinates of mass centres, angles in the plane, and in space
//! the components of a body's axes, weighted by its pseudo-inertia `J = ½ tr(I) 1 − I`: `½ ωᵀI ω = ½ Σ Jₖₗ ėₖ·ėₗ`. Second
//! derivatives are symbols of their own and are not expanded: in a series `p̈` follows from `p` without a product.
//! `equations/projected.rs` shows that the sum is Lagrange's equation; J. M. Hollerbach, *A recursive Lagrangian formulation
//! of manipulator dynamics*, IEEE Trans. SMC 10 (1980) 730–736, has it with the matrices of the poses.

use lagrangian_symbolic::{Dag, Expr, Id, Node, Symbol, reverse};
use rustc_hash::FxHashMap;

use lagrangian_program::series::NoSeries;
use lagrangian_spec::model::element::{Constraint, Energy, Load};
use lagrangian_spec::model::{Body, Coordinate, Inertia, Model, Rotation, Space, stage};

/// The residuals of the equations of motion, and the meanings of the symbols in them.
pub(super) struct Residual<'d> {
    /// One for each coordinate, then one for each constraint: linear in accelerations and multipliers.
    pub rows: Vec<Expr<'d>>,
    /// The symbols of the multipliers.
    pub multipliers: Vec<Symbol>,
    /// Symbols that stand for the first or second derivative of an expression of coordinates and time.
    pub derivatives: FxHashMap<Symbol, Derivative<'d>>,
}

/// The form of the inertia in the equations.
#[derive(Clone, Copy)]
pub(super) enum Form<'d> {
    /// By the second derivatives of positions.
    Positions,
    /// By the derivatives of momenta, from a form of the kinetic energy.
    Momenta(Expr<'d>),
}

/// A derivative with respect to time.
#[derive(Clone, Copy)]
pub(super) struct Derivative<'d> {
    /// Of positions, or of rates: then it is the first one.
    pub of: Expr<'d>,
    pub is_second: bool,
}

/// A closed contact, with the symbols of its forces.
#[derive(Clone, Copy)]
pub(super) struct Closed<'d> {
    /// The gap, with the force along the normal; `None` for a contact that has those of another one.
    pub normal: Option<[Expr<'d>; 2]>,
    /// With friction the slip, with the force along the tangent.
    pub tangent: Option<[Expr<'d>; 2]>,
}

/// A closed contact with what is known of its forces.
#[derive(Clone, Copy)]
pub(super) struct ClosedContact<'d> {
    pub closed: Closed<'d>,
    /// Its force along the normal, or that of the contact that carries it.
    pub force: Expr<'d>,
    /// μ.
    pub friction: Expr<'d>,
}

/// The residuals of a machine's equations of motion, with these contacts closed: their forces are further multipliers.
pub(super) fn residual<'d>(
    model: &Model<'d>,
    form: Form<'d>,
    closed: &[Closed<'d>],
) -> Result<Residual<'d>, NoSeries> {
    if !model.approximations.is_empty() {
        return Err(NoSeries::Approximations);
    }
    if !model.sliding().is_empty() {
        return Err(NoSeries::Friction);
    }
    let constraints = model.constraints();
    let of_velocities = |c: &&Constraint<'d>| c.expression.stage() > stage::POSITION;
    if !model.rolling().is_empty() || constraints.iter().any(of_velocities) {
        return Err(NoSeries::Constraints);
    }
    let dag = model.dag;
    let mut rates = Rates::of(model);
    let mut loads = Loads {
        on_positions: Vec::new(),
        on_rates: Vec::new(),
        on_coordinates: vec![Vec::new(); model.coordinates.len()],
    };
    match form {
        Form::Positions => loads.add_inertia(model, &mut rates),
        Form::Momenta(kinetic_energy) => {
            loads.add_momenta(model, kinetic_energy, &mut rates);
            loads.add_weights(model);
        }
    }
    loads.add_energies(model, &mut rates);
    loads.add_quaternions(model, &mut rates);
    for load in model.loads() {
        loads.add_load(model, load);
    }
    for (i, coordinate) in model.coordinates.iter().enumerate() {
        if let Some(rate) = coordinate.rate {
            let q = coordinate.q;
            loads.on_positions.push((q, rates.second(q)));
            loads.on_coordinates[i].push(-rate);
        }
    }
    // M a = f + Gᵀ λ, and −d²g/dt² = 0, with this sign for the matrix to be symmetric.
    let (mut multipliers, mut held) = (Vec::new(), Vec::new());
    for (k, constraint) in constraints.iter().enumerate() {
        let multiplier = dag.symbol(&format!("multiplier {k}"), stage::ACCELERATION);
        multipliers.extend(multiplier.as_symbol());
        loads
            .on_positions
            .push((constraint.expression, -multiplier));
        held.push(-rates.second(constraint.expression));
    }
    // Forces along the slip do work on it, and −dγ/dt = 0 if it is held.
    for contact in closed {
        if let Some([gap, force]) = contact.normal {
            multipliers.extend(force.as_symbol());
            loads.on_positions.push((gap, -force));
            held.push(-rates.second(gap));
        }
        if let Some([slip, force]) = contact.tangent {
            multipliers.extend(force.as_symbol());
            loads.on_rates.push((slip, -force));
            held.push(-rates.first(slip));
        }
    }
    Ok(Residual {
        rows: loads.by_coordinate(model).into_iter().chain(held).collect(),
        derivatives: rates.derivatives,
        multipliers,
    })
}

/// What the terms of the residuals are made of: pairs of a function and the load on it.
struct Loads<'d> {
    /// Loads on functions of positions: `load·∂function/∂qᵢ`.
    on_positions: Vec<(Expr<'d>, Expr<'d>)>,
    /// Loads on functions of rates: `load·∂function/∂vᵢ`.
    on_rates: Vec<(Expr<'d>, Expr<'d>)>,
    /// Loads on each coordinate itself.
    on_coordinates: Vec<Vec<Expr<'d>>>,
}

impl<'d> Loads<'d> {
    /// Inertia and weight of the bodies.
    fn add_inertia(&mut self, model: &Model<'d>, rates: &mut Rates<'_, 'd>) {
        for body in &model.bodies {
            for (k, &at) in body.at.iter().enumerate() {
                let fall = model.gravity().map_or(model.dag.zero(), |g| g[k]);
                let load = body.mass * (rates.second(at) - fall);
                self.on_positions.push((at, load));
            }
            rotation_loads(model, body, rates, &mut self.on_positions);
        }
    }

    /// Inertia of the bodies by Lagrange's equations of the second kind.
    fn add_momenta(&mut self, model: &Model<'d>, kinetic: Expr<'d>, rates: &mut Rates<'_, 'd>) {
        let one = [(kinetic, model.dag.one())];
        let momenta = reverse(model.dag, &one, &symbols(model, |c| c.v));
        let by_positions = reverse(model.dag, &one, &symbols(model, |c| c.q));
        let all = self
            .on_coordinates
            .iter_mut()
            .zip(momenta)
            .zip(by_positions);
        for ((loads, momentum), by_position) in all {
            loads.push(rates.first(momentum));
            loads.push(-by_position);
        }
    }

    /// Weight of the bodies.
    fn add_weights(&mut self, model: &Model<'d>) {
        let Some(g) = model.gravity() else {
            return;
        };
        for body in &model.bodies {
            let components = body.at.iter().zip(g);
            self.on_positions
                .extend(components.map(|(&at, &g)| (at, -body.mass * g)));
        }
    }

    /// Springs and dampers.
    fn add_energies(&mut self, model: &Model<'d>, rates: &mut Rates<'_, 'd>) {
        let one = model.dag.one();
        for energy in model.stored() {
            match energy {
                Energy::Quadratic(deformation) => {
                    let (k, s) = (deformation.coefficient, deformation.measure);
                    self.on_positions.push((s, k * s));
                    self.on_positions.push((k, s.square() / 2));
                }
                Energy::Given(value) => self.on_positions.push((*value, one)),
            }
        }
        for energy in model.dissipated() {
            match energy {
                Energy::Quadratic(deformation) => {
                    let (b, s) = (deformation.coefficient, deformation.measure);
                    let rate = rates.first(s);
                    self.on_positions.push((s, b * rate));
                    self.on_rates.push((b, rate.square() / 2));
                }
                Energy::Given(value) => self.on_rates.push((*value, one)),
            }
        }
    }

    /// The inertia of the lengths of quaternions, eq. (E74), and the load on them, eq. (E75).
    fn add_quaternions(&mut self, model: &Model<'d>, rates: &mut Rates<'_, 'd>) {
        for four in &model.quaternions {
            let size = four.log_length();
            let e_rates = four.e.map(|e| rates.first(e));
            let load = four.inertia * rates.second(size) - four.load(&e_rates);
            self.on_positions.push((size, load));
        }
    }

    /// An applied force or torque.
    fn add_load(&mut self, model: &Model<'d>, load: &Load<'d>) {
        match load {
            Load::Point { at, force } => {
                let components = at.iter().zip(force);
                self.on_positions
                    .extend(components.map(|(&at, &force)| (at, -force)));
            }
            Load::Coordinate { coordinate, value } => {
                self.on_coordinates[*coordinate].push(-*value);
            }
            Load::Along { measure, force, .. } => self.on_positions.push((*measure, -*force)),
            Load::Torque { on, torque } => match (model.space, model.rotation(*on)) {
                (Space::Plane, rotation) => {
                    let angle = planar_angle(model, rotation);
                    self.on_positions
                        .extend(angle.map(|angle| (angle, -torque[0])));
                }
                // The rotation is ½ Σ e × δe, in ground axes.
                (Space::Space, Rotation::Frame(pose)) => {
                    for e in &model.poses[pose.index()].axes {
                        for (k, &component) in torque.iter().enumerate() {
                            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                            self.on_positions.push((e[last], -component * e[next] / 2));
                            self.on_positions.push((e[next], component * e[last] / 2));
                        }
                    }
                }
                (Space::Space, _) => {}
            },
        }
    }

    /// The residual of each coordinate.
    fn by_coordinate(mut self, model: &Model<'d>) -> Vec<Expr<'d>> {
        let dag = model.dag;
        let acts = |(_, load): &(Expr<'d>, Expr<'d>)| !load.is_zero();
        self.on_positions.retain(acts);
        self.on_rates.retain(acts);
        let by_positions = reverse(dag, &self.on_positions, &symbols(model, |c| c.q));
        let by_rates = reverse(dag, &self.on_rates, &symbols(model, |c| c.v));
        let all = by_positions.into_iter().zip(by_rates);
        let all = all.zip(self.on_coordinates);
        all.map(|((q, v), direct)| dag.sum([q, v].into_iter().chain(direct)))
            .collect()
    }
}

/// The symbols of a variable of every coordinate.
fn symbols<'d>(model: &Model<'d>, of: fn(&Coordinate<'d>) -> Expr<'d>) -> Vec<Symbol> {
    let coordinates = model.coordinates.iter();
    coordinates.filter_map(|c| of(c).as_symbol()).collect()
}

/// The inertia loads on the rotation of a body.
fn rotation_loads<'d>(
    model: &Model<'d>,
    body: &Body<'d>,
    rates: &mut Rates<'_, 'd>,
    loads: &mut Vec<(Expr<'d>, Expr<'d>)>,
) {
    match (&body.inertia, &body.rotation) {
        (&Inertia::Planar(inertia), _) => {
            if let Some(angle) = planar_angle(model, body.rotation) {
                loads.push((angle, inertia * rates.second(angle)));
            }
        }
        (&Inertia::Tensor([xx, yy, zz, xy, xz, yz]), &Rotation::Frame(pose)) => {
            let axes = &model.poses[pose.index()].axes;
            let half = |a: Expr<'d>, b: Expr<'d>, c: Expr<'d>| (a + b - c) / 2;
            let pseudo = [
                [half(yy, zz, xx), -xy, -xz],
                [-xy, half(zz, xx, yy), -yz],
                [-xz, -yz, half(xx, yy, zz)],
            ];
            for (k, row) in pseudo.iter().enumerate() {
                for component in 0..3 {
                    let terms = row.iter().zip(axes);
                    let terms = terms.map(|(&j, axis)| {
                        if j.is_zero() {
                            j
                        } else {
                            j * rates.second(axis[component])
                        }
                    });
                    let terms: Vec<Expr<'d>> = terms.collect();
                    loads.push((axes[k][component], model.dag.sum(terms)));
                }
            }
        }
        _ => {}
    }
}

fn planar_angle<'d>(model: &Model<'d>, rotation: Rotation<'d>) -> Option<Expr<'d>> {
    match rotation {
        Rotation::Unspecified => None,
        Rotation::Angle(angle) => Some(angle),
        Rotation::Frame(pose) => Some(model.poses[pose.index()].angle),
    }
}

/// Time derivatives of positions and momenta, as linear sums over symbols of derivatives.
struct Rates<'m, 'd> {
    model: &'m Model<'d>,
    /// The first and second derivatives of coordinates and time, and the first of rates.
    known: FxHashMap<Id, [Expr<'d>; 2]>,
    derivatives: FxHashMap<Symbol, Derivative<'d>>,
}

impl<'m, 'd> Rates<'m, 'd> {
    fn of(model: &'m Model<'d>) -> Rates<'m, 'd> {
        let dag = model.dag;
        let coordinates = model.coordinates.iter().map(|c| (c.q.id(), [c.v, c.a]));
        let rates = model.coordinates.iter().map(|c| (c.v.id(), [c.a, c.a]));
        let time = (model.time.id(), [dag.one(), dag.zero()]);
        Rates {
            model,
            known: coordinates.chain(rates).chain([time]).collect(),
            derivatives: FxHashMap::default(),
        }
    }

    fn first(&mut self, of: Expr<'d>) -> Expr<'d> {
        self.linear(of, false)
    }

    fn second(&mut self, position: Expr<'d>) -> Expr<'d> {
        self.linear(position, true)
    }

    /// The derivative of a sum, with constant factors taken out. It does not recurse, since expressions may be
    /// nested to any depth.
    fn linear(&mut self, of: Expr<'d>, twice: bool) -> Expr<'d> {
        let dag = self.model.dag;
        let mut terms = Vec::new();
        let mut open = vec![(dag.one(), of)];
        while let Some((coefficient, e)) = open.pop() {
            if e.stage() <= stage::PARAMETER {
                continue;
            }
            if let Some(known) = self.known.get(&e.id()) {
                terms.push(coefficient * known[usize::from(twice)]);
                continue;
            }
            match e.node() {
                Node::Sum(parts) => {
                    for (part, c) in parts.iter() {
                        open.push((coefficient * dag.constant(c.clone()), dag.expr(*part)));
                    }
                }
                Node::Product(factors) => match split(dag, &factors) {
                    (Some(constant), varying) => open.push((coefficient * constant, varying)),
                    (None, _) => terms.push(coefficient * self.symbol(e, twice)),
                },
                _ => terms.push(coefficient * self.symbol(e, twice)),
            }
        }
        dag.sum(terms)
    }

    /// The symbol that stands for a derivative.
    fn symbol(&mut self, of: Expr<'d>, twice: bool) -> Expr<'d> {
        let (mark, stage) = if twice {
            ("dd", stage::ACCELERATION)
        } else if of.stage() > stage::POSITION {
            ("d", stage::ACCELERATION)
        } else {
            ("d", stage::VELOCITY)
        };
        // Names in a spec contain no spaces.
        let name = format!("{mark} of {}", of.id().index());
        let symbol = self.model.dag.symbol(&name, stage);
        if let Some(key) = symbol.as_symbol() {
            self.derivatives.insert(
                key,
                Derivative {
                    of,
                    is_second: twice,
                },
            );
        }
        symbol
    }
}

/// The constant factors, if there are any, and the others.
pub(super) fn split<'d>(dag: &'d Dag, factors: &[(Id, i32)]) -> (Option<Expr<'d>>, Expr<'d>) {
    let power = |&(id, n): &(Id, i32)| dag.expr(id).powi(n);
    let is_constant = |(id, _): &&(Id, i32)| dag.expr(*id).stage() <= stage::PARAMETER;
    let (constant, varying): (Vec<_>, Vec<_>) = factors.iter().partition(is_constant);
    let product = |factors: &[&(Id, i32)]| dag.product(factors.iter().map(|&f| power(f)));
    let found = (!constant.is_empty()).then(|| product(&constant));
    (found, product(&varying))
}
