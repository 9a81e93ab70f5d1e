//! Derives the same equations at lower cost, by projecting accelerations on the directions in which
//! coordinates move bodies.
//!
//! A body's inertia force acts along `∂x/∂qᵢ`, and so
//!
//! ```text
//! d/dt ∂T/∂vᵢ − ∂T/∂qᵢ = Σ m ẍ·∂x/∂qᵢ + Σ (I α + ω×I ω)·∂ω/∂vᵢ
//! ```
//!
//! Proof: let `u = Dp` be the rate of a scalar position `p(q, t)` of constant weight `w`, with
//! `T = ½ Σ w u²`. Then `∂u/∂vᵢ = ∂p/∂qᵢ` (cancellation of dots) and `d/dt ∂p/∂qᵢ = ∂u/∂qᵢ`
//! (exchange of derivatives), hence
//!
//! ```text
//! d/dt ∂T/∂vᵢ − ∂T/∂qᵢ = Σ w [D(u ∂p/∂qᵢ) − u ∂u/∂qᵢ] = Σ w (Du) ∂p/∂qᵢ
//! ```
//!
//! This requires a constant `w`. For a rigid body in space, divided into particles fixed in it, the
//! same sum over particles is `m ẍ·∂x/∂qᵢ` for the mass centre and `(I α + ω×I ω)·∂ω/∂vᵢ` for the
//! rest, along any axes: Kane's equations. T. R. Kane and D. A. Levinson, *Dynamics: Theory and
//! Applications*, 1985, ch. 4 and 6.
//!
//! It is cheap because a sum `Σ load·∂p/∂qᵢ` for *all* `i` is one reverse sweep over the graph of
//! the positions. For a chain of links the graph is a chain too, and the forward and reverse sweep
//! together are the recursive Newton–Euler algorithm, linear in the number of links. Frames in
//! space carry their velocities in their own axes (E10), where a turn is four multiplications;
//! there the reverse sweep runs over `u(v)` instead of `p(q)`, since `∂u/∂vᵢ` is the same.

mod nodes;

use lagrangian_symbolic::{Dag, Expr, Symbol, Tangent, reverse};

use super::InertialPair;
use super::composite::Composite;
use super::energy;
use super::kinematics::{
    self, AccelerationMatrix, Chains, Twist, Variables, Vector, add, apply_tensor, cross, vector,
};
use super::symmetric::Symmetric;
use lagrangian_spec::model::circles::rotation_angle;
use lagrangian_spec::model::element::{Energy, Load};
use lagrangian_spec::model::{Body, FrameOrBody, Model, PoseChange, PoseId, Space};
use nodes::{InertiaNodes, NodeValues, frame_of, group_by_frame, inertia_nodes, lengths};

/// The nodes that carry a machine's inertia, in the form that is cheapest to differentiate.
pub(super) struct Projection<'a, 'd> {
    model: &'a Model<'d>,
    x: &'a Variables<'d>,
    chains: Chains,
    bodies: Vec<InertiaNodes<'d>>,
    /// The inertia of the same bodies, grouped by carrier: points, or frames to which it is fixed.
    inertial: Vec<InertiaNodes<'d>>,
    composites: Vec<(PoseId, Composite<'d>)>,
}

/// Loads with the nodes on which they act: `Σ load·∂node/∂x`, by virtual work.
#[derive(Default)]
pub(super) struct Loads<'d> {
    /// On functions of `q`: `load·∂node/∂qᵢ`.
    on_positions: Vec<(Expr<'d>, Expr<'d>)>,
    /// On functions of `v`: `load·∂node/∂vᵢ`.
    on_rates: Vec<(Expr<'d>, Expr<'d>)>,
    /// On coordinates directly.
    on_coordinates: Vec<(usize, Expr<'d>)>,
}

impl<'a, 'd> Projection<'a, 'd> {
    pub fn of(model: &'a Model<'d>, x: &'a Variables<'d>) -> Projection<'a, 'd> {
        let bodies: Vec<InertiaNodes<'d>> = model
            .bodies
            .iter()
            .map(|b| inertia_nodes(model, b))
            .collect();
        let turning = bodies
            .iter()
            .filter_map(|body| body.tensor.map(|(_, pose)| pose));
        let twisted = model.loads().filter_map(|load| match load {
            Load::Torque { on, .. } => frame_of(model.rotation(*on)),
            Load::Point { .. } | Load::Coordinate { .. } | Load::Along { .. } => None,
        });
        let moving = bodies
            .iter()
            .filter_map(|body| body.centre.map(|(_, pose, _)| pose));
        let (mut inertial, composites) = group_by_frame(model, &bodies);
        inertial.extend(lengths(model));
        let carried_by_frames = composites.iter().map(|(pose, _)| *pose);
        let carried = composites
            .iter()
            .filter(|(_, composite)| composite.depends_on_origin_motion());
        let moving = moving.chain(carried.map(|(pose, _)| *pose));
        let chains = Chains::to(
            model,
            turning.chain(twisted).chain(carried_by_frames),
            moving,
        );
        Projection {
            model,
            x,
            chains,
            bodies,
            inertial,
            composites,
        }
    }

    /// Mass matrix, eq. (E12): `Mᵢⱼ = Σ w ∂p/∂qᵢ ∂p/∂qⱼ`, which is (E4).
    ///
    /// Column `j` is the projected momentum of a machine that moves with `vⱼ = 1`, one reverse
    /// sweep. Nothing if they become too large.
    pub fn mass_matrix(&self) -> Option<Symmetric<Expr<'d>>> {
        let coasting = &mut self.x.without_acceleration(self.model);
        let (actual, twists) = (
            self.velocities_of(&self.inertial, coasting),
            self.twists(coasting),
        );
        let n = self.x.q.len();
        let mut columns: Vec<Vec<Expr<'d>>> = Vec::with_capacity(n);
        for j in 0..n {
            if self.model.dag.is_exhausted() {
                return None;
            }
            let rate = &mut self.x.partial(self.model, j);
            let motion = self.velocities_of(&self.inertial, rate);
            let mut momenta = Loads::default();
            for ((body, actual), motion) in self.inertial.iter().zip(&actual).zip(&motion) {
                momenta.on_body(body, actual, body.momentum(motion));
            }
            let moving = self.twists(rate);
            for (pose, composite) in &self.composites {
                momenta.on_frame(
                    &twists[pose.index()],
                    composite.momentum(&moving[pose.index()]),
                );
            }
            columns.push(self.project(&momenta, j..n));
        }
        let model = self.model;
        Some(Symmetric::from_lower(n, |i, j| {
            if i == j {
                with_state(model, i, columns[j][0])
            } else {
                columns[j][i - j]
            }
        }))
    }

    /// The loads of inertia at `a = 0`, times `sign`; their projection is the bias, eq. (E13):
    /// `hᵢ = Σ w (D²p) ∂p/∂qᵢ`, which is (E5).
    ///
    /// With `gravity` the loads include it, as an acceleration of the ground.
    pub fn bias_loads(&self, sign: i64, gravity: bool) -> Loads<'d> {
        self.inertia_loads(&mut self.x.without_acceleration(self.model), sign, gravity)
    }

    /// The residual of the equations of motion at given accelerations, `f − M a`, eq. (E25): inertia and
    /// gravity reversed, and the applied loads, in one sweep. This is recursive Newton–Euler, linear in the
    /// number of links.
    pub fn residual(&self) -> Vec<Expr<'d>> {
        let mut loads = self.inertia_loads(&mut self.x.total(self.model), -1, true);
        self.add_applied(&mut loads);
        let coordinates = self.model.coordinates.iter().enumerate();
        let states = coordinates.filter(|(_, c)| c.rate.is_some());
        loads
            .on_coordinates
            .extend(states.map(|(i, state)| (i, -state.a)));
        self.project(&loads, 0..self.x.q.len())
    }

    fn inertia_loads(&self, rate: &mut Tangent<'d>, sign: i64, gravity: bool) -> Loads<'d> {
        let velocities = self.velocities_of(&self.inertial, rate);
        let mut loads = Loads::default();
        let demands = self.inertia(&self.inertial, rate, gravity);
        for ((body, velocity), load) in self.inertial.iter().zip(&velocities).zip(demands) {
            loads.on_body(body, velocity, load.scaled(sign));
        }
        let (twists, accelerations) = self.motion(rate, gravity);
        for (pose, composite) in &self.composites {
            let (twist, here) = (&twists[pose.index()], &accelerations[pose.index()]);
            let turning = AccelerationMatrix::of(&twist.angular, &here.angular);
            let demand = composite.inertia_wrench(&turning, &here.linear);
            loads.on_frame(twist, demand.map(|vector| vector.map(|x| sign * x)));
        }
        loads
    }

    /// Adds the applied loads without gravity, eq. (E14): `Qᵢ = Σ F·∂x/∂qᵢ`, which is (E6).
    ///
    /// A spring pulls with `−c s` along its deformation, a damper with `−b ṡ`; forces and torques act at
    /// their points and bodies. A coefficient that depends on coordinates or rates gives a term of its own.
    pub fn add_applied(&self, loads: &mut Loads<'d>) {
        let (model, rate) = (self.model, &mut self.x.without_acceleration(self.model));
        for energy in model.stored() {
            match energy {
                Energy::Quadratic(deformed) => {
                    let (c, s) = (deformed.coefficient, deformed.measure);
                    loads.on_positions.push((s, -c * s));
                    loads.on_positions.push((c, -s.square() / 2));
                }
                Energy::Given(value) => loads.on_positions.push((*value, model.dag.int(-1))),
            }
        }
        for energy in model.dissipated() {
            match energy {
                Energy::Quadratic(damped) => {
                    let (b, s_rate) = (damped.coefficient, rate.of(damped.measure));
                    loads.on_positions.push((damped.measure, -b * s_rate));
                    loads.on_rates.push((b, -s_rate.square() / 2));
                }
                Energy::Given(value) => loads.on_rates.push((*value, model.dag.int(-1))),
            }
        }
        self.add_forces(loads);
        self.add_state_rates(loads);
        self.add_lengths(loads);
    }

    /// Adds the load that restores the lengths of quaternions, eq. (E75). It acts on the lengths alone, and has no power.
    pub fn add_lengths(&self, loads: &mut Loads<'d>) {
        let rate = &mut self.x.without_acceleration(self.model);
        for four in &self.model.quaternions {
            let load = four.load(&four.e.map(|e| rate.of(e)));
            loads.on_positions.push((four.log_length(), load));
        }
    }

    /// Adds the rates of first-order states, eq. (E57): the rate of a state stands in the row of the
    /// coordinate whose rate the state is.
    pub fn add_state_rates(&self, loads: &mut Loads<'d>) {
        let coordinates = self.model.coordinates.iter().enumerate();
        let rates = coordinates.filter_map(|(i, c)| Some((i, c.rate?)));
        loads.on_coordinates.extend(rates);
    }

    /// Adds `Σ m g·∂x/∂qᵢ`, at the nodes that carry the inertia.
    pub fn add_gravity(&self, loads: &mut Loads<'d>) {
        let Some(g) = self.model.gravity() else {
            return;
        };
        let coasting = &mut self.x.without_acceleration(self.model);
        let velocities = self.velocities_of(&self.inertial, coasting);
        let along = match self.model.space {
            Space::Plane => Vec::new(),
            Space::Space => self.chains.ground_vector_in_axes(self.model, vector(g)),
        };
        let twists = self.twists(coasting);
        for (pose, composite) in &self.composites {
            let g = &along[pose.index()];
            let loads_here = [
                g.map(|g_k| composite.mass * g_k),
                cross(&composite.moment, g),
            ];
            loads.on_frame(&twists[pose.index()], loads_here);
        }
        for (body, velocity) in self.inertial.iter().zip(velocities) {
            for point in &body.points {
                loads
                    .on_positions
                    .extend(point.gravity.map(|g| (point.position, point.weight * g)));
            }
            if let (Some((mass, pose, _)), Some(linear)) = (body.centre, velocity.linear) {
                let g = &along[pose.index()];
                loads
                    .on_rates
                    .extend((0..3).map(|k| (linear[k], mass * g[k])));
            }
        }
    }

    /// Adds `Σ F·∂x/∂qᵢ + Σ F ∂s/∂qᵢ + Σ M·∂ω/∂vᵢ + Fᵢ`: the virtual work of applied forces and torques.
    pub fn add_forces(&self, loads: &mut Loads<'d>) {
        self.add_loads(self.model.loads(), loads);
    }

    /// Adds the virtual work of some forces and torques.
    pub fn add_loads<'l>(&self, acting: impl Iterator<Item = &'l Load<'d>>, loads: &mut Loads<'d>)
    where
        'd: 'l,
    {
        let mut twists = None;
        for load in acting {
            match load {
                Load::Point { at, force } => {
                    let components = at.iter().copied().zip(force.iter().copied());
                    loads.on_positions.extend(components);
                }
                Load::Coordinate { coordinate, value } => {
                    loads.on_coordinates.push((*coordinate, *value));
                }
                Load::Along { measure, force, .. } => loads.on_positions.push((*measure, *force)),
                Load::Torque { on, torque } => {
                    self.add_torque(*on, torque, &mut twists, loads);
                }
            }
        }
    }

    /// Adds `M·∂ω/∂vᵢ` of a torque. `twists` are the velocities of all frames in space, once they have been needed.
    fn add_torque(
        &self,
        on: FrameOrBody,
        torque: &[Expr<'d>],
        twists: &mut Option<Vec<Twist<'d>>>,
        loads: &mut Loads<'d>,
    ) {
        let rotation = self.model.rotation(on);
        match self.model.space {
            Space::Plane => {
                let angle = rotation_angle(self.model, rotation);
                loads
                    .on_positions
                    .extend(angle.map(|angle| (angle, torque[0])));
            }
            Space::Space => {
                let twists = twists.get_or_insert_with(|| {
                    self.twists(&mut self.x.without_acceleration(self.model))
                });
                if let Some(pose) = frame_of(rotation) {
                    let turning = twists[pose.index()].angular;
                    let along = kinematics::along_axes(self.model, pose, torque);
                    loads.on_rates.extend(turning.into_iter().zip(along));
                }
            }
        }
    }

    /// The reverse sweep: `Σ load·∂node/∂qᵢ` over all loads, for the coordinates in `range`.
    pub fn project(&self, loads: &Loads<'d>, range: std::ops::Range<usize>) -> Vec<Expr<'d>> {
        let dag = self.model.dag;
        let sweep = |loads: &[(Expr<'d>, Expr<'d>)], wrt: &[Symbol]| {
            let acting: Vec<_> = loads
                .iter()
                .copied()
                .filter(|(_, load)| !load.is_zero())
                .collect();
            reverse(dag, &acting, wrt)
        };
        let over_q = sweep(&loads.on_positions, &self.x.q[range.clone()]);
        let over_v = sweep(&loads.on_rates, &self.x.v[range.clone()]);
        let mut direct: Vec<Vec<Expr<'d>>> = vec![Vec::new(); range.len()];
        for &(coordinate, value) in &loads.on_coordinates {
            if let Some(terms) = coordinate
                .checked_sub(range.start)
                .and_then(|i| direct.get_mut(i))
            {
                terms.push(value);
            }
        }
        let all = over_q.into_iter().zip(over_v).zip(direct);
        all.map(|((q, v), direct)| dag.sum([q, v].into_iter().chain(direct)))
            .collect()
    }

    /// Inertia and loads on velocities. In the plane the loads are `applied`, without gravity, and the
    /// inertia forces are derived from the rates of the velocities; in space the loads are `forces`,
    /// which include the bias and gravity.
    ///
    /// A load on a position acts on its velocity: `∂(Dp)/∂vᵢ = ∂p/∂qᵢ`. In space the inertia forces of
    /// a motion without accelerations are a load, computed from the ground to the tips in axes that
    /// turn, and only the contribution of the accelerations remains to be solved for.
    pub fn unprojected(&self, applied: &Loads<'d>, forces: &Loads<'d>) -> super::Unprojected<'d> {
        let rate = &mut self.x.without_acceleration(self.model);
        let drifts = self.model.space == Space::Plane;
        let loads = if drifts { applied } else { forces };
        let velocities = self.velocities_of(&self.inertial, rate);
        let mut inertia = Vec::new();
        for (body, velocity) in self.inertial.iter().zip(&velocities) {
            let points = body.points.iter().zip(&velocity.points);
            inertia.extend(points.map(|(point, &u)| InertialPair {
                free_fall: point.gravity.filter(|g| drifts && !g.is_zero()),
                ..InertialPair::without_gravity(u, u, point.weight)
            }));
            let mut add = |[u, w, weight]: [Expr<'d>; 3]| {
                inertia.push(InertialPair::without_gravity(u, w, weight));
            };
            if let (Some((mass, ..)), Some(linear)) = (body.centre, velocity.linear) {
                linear.into_iter().for_each(|u| add([u, u, mass]));
            }
            if let (Some((tensor, _)), Some([x, y, z])) = (body.tensor, velocity.angular) {
                let [xx, yy, zz, xy, xz, yz] = tensor;
                let moments = [[x, x, xx], [y, y, yy], [z, z, zz]];
                let products = [[x, y, 2 * xy], [x, z, 2 * xz], [y, z, 2 * yz]];
                moments.into_iter().chain(products).for_each(add);
            }
        }
        let twists = self.twists(rate);
        for (pose, composite) in &self.composites {
            let pairs = composite.pairs(&twists[pose.index()]).into_iter();
            inertia.extend(pairs.map(|[u, w, weight]| InertialPair::without_gravity(u, w, weight)));
        }
        let states = self.model.coordinates.iter().filter(|c| c.rate.is_some());
        let one = self.model.dag.one();
        inertia.extend(states.map(|c| InertialPair::without_gravity(c.v, c.v, one)));
        let mut acting = Vec::new();
        acting.extend(
            loads
                .on_positions
                .iter()
                .map(|&(p, load)| (rate.of(p), load)),
        );
        acting.extend(&loads.on_rates);
        let velocity = |i: usize| self.model.coordinates[i].v;
        acting.extend(
            loads
                .on_coordinates
                .iter()
                .map(|&(i, load)| (velocity(i), load)),
        );
        inertia.retain(|pair| !pair.weight.is_zero());
        acting.retain(|(_, load)| !load.is_zero());
        super::Unprojected {
            inertia,
            loads: acting,
            has_bias_accelerations: drifts,
        }
    }

    /// The power of loads along the actual motion but with time held: `Σ load·Σ vᵢ ∂node/∂qᵢ`.
    pub fn power(&self, loads: &Loads<'d>) -> Expr<'d> {
        let coordinates = &self.model.coordinates;
        let along_q = &mut self.x.virtual_motion(self.model);
        let along_v = &mut self.x.virtual_rates(self.model);
        let mut powers = Vec::new();
        powers.extend(
            loads
                .on_positions
                .iter()
                .map(|&(node, load)| load * along_q.of(node)),
        );
        powers.extend(
            loads
                .on_rates
                .iter()
                .map(|&(node, load)| load * along_v.of(node)),
        );
        powers.extend(
            loads
                .on_coordinates
                .iter()
                .map(|&(i, load)| load * coordinates[i].v),
        );
        self.model.dag.sum(powers)
    }

    /// Kinetic energy of every body, eq. (E1), in the axes that are cheapest.
    pub fn kinetic_energies(&self) -> Vec<Expr<'d>> {
        let velocities = self.velocities(&mut self.x.without_acceleration(self.model));
        let energy =
            |((body, carrier), velocity): ((&Body<'d>, &InertiaNodes<'d>), &NodeValues<'d>)| {
                energy::kinetic_energy(body, &carrier.motion(self.model, velocity))
            };
        self.model
            .bodies
            .iter()
            .zip(&self.bodies)
            .zip(&velocities)
            .map(energy)
            .collect()
    }

    /// The same energies, with bodies of revolution in axes that do not spin with them: those from which their last turns about their own axis begin.
    pub fn kinetic_energies_without_spin(&self) -> Vec<Expr<'d>> {
        let rate = &mut self.x.without_acceleration(self.model);
        let twists = self.twists(rate);
        let mut velocities = self.velocities(rate);
        let bodies = self.model.bodies.iter().zip(&self.bodies);
        let energy =
            |((body, nodes), velocity): ((&Body<'d>, &InertiaNodes<'d>), &mut NodeValues<'d>)| {
                if let Some((axis, spinning)) = nodes.revolution() {
                    let (pose, spin) = self.before_spin(spinning, axis, rate);
                    let twist = &twists[pose.index()];
                    let mut angular = twist.angular;
                    angular[axis] = angular[axis] + spin;
                    velocity.angular = Some(angular);
                    if let Some((_, _, r)) = nodes.centre.filter(|(_, at, _)| *at == spinning) {
                        velocity.linear = Some(kinematics::velocity_at(twist, &r, rate));
                    }
                }
                energy::kinetic_energy(body, &nodes.motion(self.model, velocity))
            };
        bodies.zip(&mut velocities).map(energy).collect()
    }

    /// The frame from which the last turns about an axis of a frame begin, and the sum of their rates.
    fn before_spin(
        &self,
        mut pose: PoseId,
        axis: usize,
        rate: &mut Tangent<'d>,
    ) -> (PoseId, Expr<'d>) {
        let mut spin = self.model.dag.zero();
        while let PoseChange::Turn { axis: about, angle } = self.model.poses[pose.index()].step
            && about == axis
        {
            spin = spin + rate.of(angle);
            pose = self.model.poses[pose.index()].parent;
        }
        (pose, spin)
    }

    /// Power of everything that is driven by explicit time, eq. (E19): `Σ w (D²p) ∂p/∂t`, the inertia
    /// force of what is driven times the velocity at which it is driven. It contains accelerations.
    pub fn drive_power(&self) -> Expr<'d> {
        let driven = self.velocities(&mut self.x.explicit_time(self.model));
        if driven.iter().all(NodeValues::is_at_rest) {
            return self.model.dag.zero();
        }
        let rate = &mut self.x.total(self.model);
        let inertia = self.inertia(&self.bodies, rate, false);
        let velocities = driven.iter().flat_map(|driven| driven.components());
        let loads = inertia.iter().flat_map(|load| load.components());
        self.model.dag.sum(
            velocities
                .zip(loads)
                .map(|(velocity, load)| load * velocity),
        )
    }

    /// The motion of every body at a rate.
    fn velocities(&self, rate: &mut Tangent<'d>) -> Vec<NodeValues<'d>> {
        self.velocities_of(&self.bodies, rate)
    }

    fn velocities_of(
        &self,
        list: &[InertiaNodes<'d>],
        rate: &mut Tangent<'d>,
    ) -> Vec<NodeValues<'d>> {
        let twists = self.twists(rate);
        let velocity = |body: &InertiaNodes<'d>| NodeValues {
            points: body
                .points
                .iter()
                .map(|point| rate.of(point.position))
                .collect(),
            linear: body
                .centre
                .map(|(_, pose, r)| kinematics::velocity_at(&twists[pose.index()], &r, rate)),
            angular: body.tensor.map(|(_, pose)| twists[pose.index()].angular),
        };
        list.iter().map(velocity).collect()
    }

    /// The velocities of frames in space at a rate.
    fn twists(&self, rate: &mut Tangent<'d>) -> Vec<Twist<'d>> {
        match self.model.space {
            Space::Plane => Vec::new(),
            Space::Space => self.chains.velocities(self.model, rate),
        }
    }

    /// The velocities of frames in space at a rate, and their accelerations; with `gravity` the ground accelerates by `−g`.
    fn motion(&self, rate: &mut Tangent<'d>, gravity: bool) -> (Vec<Twist<'d>>, Vec<Twist<'d>>) {
        let model = self.model;
        let gravity = model.gravity().filter(|_| gravity);
        match model.space {
            Space::Plane => (Vec::new(), Vec::new()),
            Space::Space => {
                let ground = gravity.map_or([model.dag.zero(); 3], |g| vector(g).map(|g_k| -g_k));
                let twists = self.chains.velocities(model, rate);
                let accelerations = self.chains.accelerations(model, ground, &twists, rate);
                (twists, accelerations)
            }
        }
    }

    /// The forces required by inertia: `m ẍ`, and by (E15) `τ = I α + ω×I ω`. Whether accelerations
    /// are included depends on the rate; with `gravity` the ground accelerates by `−g`.
    fn inertia(
        &self,
        list: &[InertiaNodes<'d>],
        rate: &mut Tangent<'d>,
        gravity: bool,
    ) -> Vec<NodeValues<'d>> {
        let (twists, accelerations) = self.motion(rate, gravity);
        let gravity = self.model.gravity().filter(|_| gravity);
        let mut load = |body: &InertiaNodes<'d>| {
            let points = body.points.iter().map(|point| {
                let (acceleration, weight) =
                    (rate.twice(point.position), gravity.and(point.gravity));
                point.weight * weight.map_or(acceleration, |g| acceleration - g)
            });
            NodeValues {
                points: points.collect(),
                linear: body.centre.map(|(mass, pose, r)| {
                    let (here, omega) =
                        (&accelerations[pose.index()], &twists[pose.index()].angular);
                    kinematics::acceleration_at(here, omega, &r, rate).map(|a_k| mass * a_k)
                }),
                angular: body.tensor.map(|(tensor, pose)| {
                    let omega = &twists[pose.index()].angular;
                    let spin = cross(omega, &apply_tensor(&tensor, omega));
                    add(&[
                        &apply_tensor(&tensor, &accelerations[pose.index()].angular),
                        &spin,
                    ])
                }),
            }
        };
        list.iter().map(&mut load).collect()
    }
}

impl<'d> Loads<'d> {
    /// Adds loads at the nodes that carry the inertia of a body that moves with the given velocity.
    fn on_body(
        &mut self,
        body: &InertiaNodes<'d>,
        velocity: &NodeValues<'d>,
        load: NodeValues<'d>,
    ) {
        let positions = body.points.iter().map(|point| point.position);
        self.on_positions.extend(positions.zip(load.points));
        let vectors = [
            (velocity.linear, load.linear),
            (velocity.angular, load.angular),
        ];
        for (velocity, load) in vectors {
            self.on_rates.extend(
                velocity
                    .into_iter()
                    .flatten()
                    .zip(load.into_iter().flatten()),
            );
        }
    }

    /// Adds loads on the motion of a frame: a force, and a moment about its origin.
    fn on_frame(&mut self, twist: &Twist<'d>, [force, moment]: [Vector<'d>; 2]) {
        self.on_rates.extend(twist.linear.into_iter().zip(force));
        self.on_rates.extend(twist.angular.into_iter().zip(moment));
    }

    /// Loads derived from a potential and a dissipation function.
    pub fn of_energies(dag: &'d Dag, potential: Expr<'d>, dissipation: Expr<'d>) -> Loads<'d> {
        Loads {
            on_positions: vec![(potential, dag.int(-1))],
            on_rates: vec![(dissipation, dag.int(-1))],
            on_coordinates: Vec::new(),
        }
    }
}

/// An entry of the diagonal of the mass matrix: the row of a state gives its rate, `1 ṡ = f`.
pub(super) fn with_state<'d>(model: &Model<'d>, i: usize, entry: Expr<'d>) -> Expr<'d> {
    match model.coordinates[i].rate {
        Some(_) => entry + 1,
        None => entry,
    }
}
