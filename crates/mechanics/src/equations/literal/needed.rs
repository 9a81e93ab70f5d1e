//! The expressions that the literal equations evaluate: those of energies, and those that say where everything is.

use super::values::Values;
use super::vector;
use super::vector::dot;
use super::{Varied, angle};
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::element::{Energy, Load, Sliding};
use lagrangian_spec::model::polygons::Corner;
use lagrangian_spec::model::{
    Contact, ContactGeometry, FrameOrBody, Inertia, Model, PoseId, Rotation, Surface, quaternion,
};
use lagrangian_symbolic::Expr;

/// The expressions that the kinetic energy needs.
pub(super) fn kinetic<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
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
pub(super) fn lengths<R: Scalar>(model: &Model<'_>, x: &Values<'_, Varied<R>>) -> [R; 3] {
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
pub(super) fn energies<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
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
pub(super) fn geometry<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
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
