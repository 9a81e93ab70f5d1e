//! Velocities and accelerations of bodies, by differentiating their positions.

use lagrangian_symbolic::{Dag, Expr, Symbol, Tangent};

use lagrangian_spec::model::circles::planar_angle;
use lagrangian_spec::model::{
    Body, Inertia, Model, Pose, PoseChange, PoseId, Rotation, Space, quaternion,
};

/// The independent variables: `t`, and `q`, `v` (with `a`) in the order of the coordinates.
pub(super) struct Variables<'d> {
    pub t: Symbol,
    pub q: Vec<Symbol>,
    pub v: Vec<Symbol>,
    pub a: Vec<Symbol>,
    /// `v` and `a`.
    expressions: Vec<[Expr<'d>; 2]>,
}

impl<'d> Variables<'d> {
    pub fn of(model: &Model<'d>) -> Variables<'d> {
        let symbol = |e: Expr| e.as_symbol().expect("variables of a model are symbols");
        let list = &model.coordinates;
        Variables {
            t: symbol(model.time),
            q: list.iter().map(|c| symbol(c.q)).collect(),
            v: list.iter().map(|c| symbol(c.v)).collect(),
            a: list.iter().map(|c| symbol(c.a)).collect(),
            expressions: list.iter().map(|c| [c.v, c.a]).collect(),
        }
    }

    /// The total time derivative, eq. (E8): `D = ∂/∂t + Σ vᵢ ∂/∂qᵢ + Σ aᵢ ∂/∂vᵢ`.
    ///
    /// It always includes explicit time.
    pub fn total(&self, model: &Model<'d>) -> Tangent<'d> {
        let rates = self
            .v
            .iter()
            .zip(&self.expressions)
            .map(|(&v, &[_, a])| (v, a));
        Tangent::new(
            model.dag,
            &self.kinematic(model).chain(rates).collect::<Vec<_>>(),
        )
    }

    /// The total time derivative of a motion without accelerations: (E8) with `a = 0`.
    ///
    /// For an expression in `q` and `t` only it *is* the total derivative; applied twice it gives
    /// the acceleration without the terms linear in `a`.
    pub fn without_acceleration(&self, model: &Model<'d>) -> Tangent<'d> {
        Tangent::new(model.dag, &self.kinematic(model).collect::<Vec<_>>())
    }

    /// The total time derivative of an expression in coordinates, first-order states and time; states change at their given rates.
    pub fn along_states(&self, model: &Model<'d>) -> Tangent<'d> {
        let states = self.v.iter().zip(&model.coordinates);
        let states = states.filter_map(|(&v, c)| Some((v, c.rate?)));
        Tangent::new(
            model.dag,
            &self.kinematic(model).chain(states).collect::<Vec<_>>(),
        )
    }

    /// `∂/∂t`, with `q` held.
    pub fn explicit_time(&self, model: &Model<'d>) -> Tangent<'d> {
        Tangent::new(model.dag, &[(self.t, model.dag.one())])
    }

    /// `Σ vᵢ ∂/∂qᵢ`, with `t` held: the variation along the virtual displacement `v`.
    pub fn virtual_motion(&self, model: &Model<'d>) -> Tangent<'d> {
        let rates = self
            .q
            .iter()
            .zip(&self.expressions)
            .map(|(&q, &[v, _])| (q, v));
        Tangent::new(model.dag, &rates.collect::<Vec<_>>())
    }

    /// `Σ vᵢ ∂/∂vᵢ`, with `q` and `t` held.
    pub fn virtual_rates(&self, model: &Model<'d>) -> Tangent<'d> {
        let rates = self
            .v
            .iter()
            .zip(&self.expressions)
            .map(|(&symbol, &[v, _])| (symbol, v));
        Tangent::new(model.dag, &rates.collect::<Vec<_>>())
    }

    /// `∂/∂qⱼ`.
    pub fn partial(&self, model: &Model<'d>, j: usize) -> Tangent<'d> {
        Tangent::new(model.dag, &[(self.q[j], model.dag.one())])
    }

    /// `ṫ = 1`, `q̇ = v`.
    fn kinematic(&self, model: &Model<'d>) -> impl Iterator<Item = (Symbol, Expr<'d>)> {
        let rates = self
            .q
            .iter()
            .zip(&self.expressions)
            .map(|(&q, &[v, _])| (q, v));
        std::iter::once((self.t, model.dag.one())).chain(rates)
    }
}

/// The motion of one body: the velocity of its mass centre and its angular velocity.
///
/// The caller decides along which axes they are given. The angular velocity has no component if
/// rotation carries no energy, one in the plane, three in space.
#[derive(Clone, Debug)]
pub(super) struct Motion<'d> {
    pub linear: Vec<Expr<'d>>,
    pub angular: Vec<Expr<'d>>,
}

/// The motion of every body if coordinates and time change at the given `rate`, directly from positions
/// and axes: the mass centre in ground axes, the angular velocity by (E9) in the body's own axes.
pub(super) fn literal_motion<'d>(model: &Model<'d>, rate: &mut Tangent<'d>) -> Vec<Motion<'d>> {
    let motion = |body: &Body<'d>| {
        let linear = body.at.iter().map(|&x| rate.of(x)).collect();
        let angular = match body.inertia {
            Inertia::Particle => Vec::new(),
            Inertia::Planar(_) => vec![planar_angle(model, body).map(|angle| rate.of(angle))]
                .into_iter()
                .flatten()
                .collect(),
            Inertia::Tensor(_) => match body.rotation {
                Rotation::Frame(pose) => angular_velocity_of_axes(model, pose, rate).to_vec(),
                Rotation::Angle(_) | Rotation::Unspecified => Vec::new(),
            },
        };
        Motion { linear, angular }
    };
    model.bodies.iter().map(motion).collect()
}

/// The angular velocity of every body that has an orientation: in the plane one number, in space its components in the
/// axes of the body's own frame, eq. (E10). Empty if the spec gives no orientation.
pub fn angular_velocities<'d>(model: &Model<'d>) -> Vec<Vec<Expr<'d>>> {
    let rate = &mut Variables::of(model).without_acceleration(model);
    let frame = |body: &Body<'d>| match body.rotation {
        Rotation::Frame(pose) => Some(pose),
        Rotation::Angle(_) | Rotation::Unspecified => None,
    };
    let twists = match model.space {
        Space::Plane => Vec::new(),
        Space::Space => {
            let turning = model.bodies.iter().filter_map(frame);
            Chains::to(model, turning, std::iter::empty()).velocities(model, rate)
        }
    };
    let of_body = |body: &Body<'d>| match model.space {
        Space::Plane => {
            let angle = planar_angle(model, body).into_iter();
            angle.map(|angle| rate.of(angle)).collect()
        }
        Space::Space => {
            frame(body).map_or_else(Vec::new, |pose| twists[pose.index()].angular.to_vec())
        }
    };
    model.bodies.iter().map(of_body).collect()
}

/// Angular velocity of a frame in its own axes, eq. (E9): `ω₁ = e₃·ė₂`, `ω₂ = e₁·ė₃`, `ω₃ = e₂·ė₁`.
///
/// These are the entries below the diagonal, cyclically, of `AᵀȦ`, which is skew-symmetric since
/// `AᵀA = 1`.
pub(super) fn angular_velocity_of_axes<'d>(
    model: &Model<'d>,
    pose: PoseId,
    rate: &mut Tangent<'d>,
) -> [Expr<'d>; 3] {
    let axes = &model.poses[pose.index()].axes;
    let mut dot_rate = |k: usize, l: usize| {
        model
            .dag
            .sum(axes[k].iter().zip(&axes[l]).map(|(&e, &f)| e * rate.of(f)))
    };
    [dot_rate(2, 1), dot_rate(0, 2), dot_rate(1, 0)]
}

/// A vector in space, in the axes of some frame.
pub(super) type Vector<'d> = [Expr<'d>; 3];

/// `u × w`.
pub(super) fn cross<'d>(u: &Vector<'d>, w: &Vector<'d>) -> Vector<'d> {
    [
        u[1] * w[2] - u[2] * w[1],
        u[2] * w[0] - u[0] * w[2],
        u[0] * w[1] - u[1] * w[0],
    ]
}

/// The sum of vectors, component by component.
pub(super) fn add<'d>(vectors: &[&Vector<'d>]) -> Vector<'d> {
    let dag = vectors[0][0].dag();
    [0, 1, 2].map(|k| dag.sum(vectors.iter().map(|vector| vector[k])))
}

/// `I ω` for a tensor `xx, yy, zz, xy, xz, yz`.
pub(super) fn apply_tensor<'d>(tensor: &[Expr<'d>; 6], w: &Vector<'d>) -> Vector<'d> {
    let [xx, yy, zz, xy, xz, yz] = *tensor;
    let dag = w[0].dag();
    [
        dag.sum([xx * w[0], xy * w[1], xz * w[2]]),
        dag.sum([xy * w[0], yy * w[1], yz * w[2]]),
        dag.sum([xz * w[0], yz * w[1], zz * w[2]]),
    ]
}

/// The velocity of the origin of a frame in space and its angular velocity, in the frame's own axes.
#[derive(Clone, Debug)]
pub(super) struct Twist<'d> {
    pub linear: Vector<'d>,
    pub angular: Vector<'d>,
}

/// The frames that a traversal of the chains of frames has to visit.
pub(super) struct Chains {
    /// The requested frames and all their ancestors, by pose.
    needed: Vec<bool>,
    /// Those for which the motion of the origin is requested too.
    needed_origin: Vec<bool>,
}

impl Chains {
    /// The chains from the ground to the frames whose rotation is needed, and to those whose
    /// origins are needed.
    pub fn to<'d>(
        model: &Model<'d>,
        turning: impl Iterator<Item = PoseId>,
        moving: impl Iterator<Item = PoseId>,
    ) -> Chains {
        let upwards = |ends: &mut dyn Iterator<Item = PoseId>| {
            let mut needed = vec![false; model.poses.len()];
            ends.for_each(|pose| needed[pose.index()] = true);
            // Parents come first, so a backward traversal meets every child before its parent.
            for index in (0..needed.len()).rev() {
                if needed[index] {
                    needed[model.poses[index].parent.index()] = true;
                }
            }
            needed
        };
        let needed_origin = upwards(&mut moving.into_iter());
        let mut needed = upwards(&mut turning.into_iter());
        needed
            .iter_mut()
            .zip(&needed_origin)
            .for_each(|(any, &origin)| *any |= origin);
        Chains {
            needed,
            needed_origin,
        }
    }

    /// Velocities of frames in their own axes, eq. (E10), if coordinates and time change at the given `rate`.
    ///
    /// From parent to child, with the shift `r` and the axis `e` and angle `φ` of the turn:
    ///
    /// ```text
    /// shift:  ω' = ω            u' = u + ω×r + ṙ
    /// turn:   ω' = Rᵀω + e φ̇    u' = Rᵀu
    /// ```
    ///
    /// For a turn by a quaternion, (E73), its angular velocity replaces e φ̇.
    ///
    /// The result has one entry for each pose; poses that were not requested are at rest.
    pub fn velocities<'d>(&self, model: &Model<'d>, rate: &mut Tangent<'d>) -> Vec<Twist<'d>> {
        let zero = [model.dag.zero(); 3];
        let mut twists: Vec<Twist<'d>> = Vec::with_capacity(model.poses.len());
        for (index, pose) in model.poses.iter().enumerate() {
            let mut twist = match twists.get(pose.parent.index()) {
                Some(parent) if self.needed[index] => parent.clone(),
                _ => Twist {
                    linear: zero,
                    angular: zero,
                },
            };
            match &pose.step {
                PoseChange::Shift(r) if self.needed_origin[index] => {
                    twist.linear = velocity_at(&twist, &vector(r), rate);
                }
                &PoseChange::Turn { axis, angle } if self.needed[index] => {
                    if self.needed_origin[index] {
                        twist.linear = rotated(&twist.linear, axis, angle);
                    }
                    twist.angular = rotated(&twist.angular, axis, angle);
                    twist.angular[axis] = twist.angular[axis] + rate.of(angle);
                }
                PoseChange::Quaternion(e) if self.needed[index] => {
                    let axes = quaternion::axes(e);
                    if self.needed_origin[index] {
                        twist.linear = components_along(&axes, &twist.linear);
                    }
                    let own = quaternion::angular_velocity(e, &e.map(|e| rate.of(e)));
                    twist.angular = add(&[&components_along(&axes, &twist.angular), &own]);
                }
                PoseChange::Ground
                | PoseChange::Shift(_)
                | PoseChange::Turn { .. }
                | PoseChange::Quaternion(_) => {}
            }
            twists.push(twist);
        }
        twists
    }

    /// Accelerations of frames in their own axes, eq. (E11), given their velocities at the same `rate`.
    ///
    /// ```text
    /// shift:  α' = α                        a' = a + α×r + ω×(ω×r + 2 ṙ) + r̈
    /// turn:   α' = Rᵀα + e φ̈ + φ̇ ω'×e       a' = Rᵀa
    /// ```
    ///
    /// `ground` is the acceleration of the ground: zero, or `−g`, which has the same effect on
    /// every body as gravity.
    pub fn accelerations<'d>(
        &self,
        model: &Model<'d>,
        ground: Vector<'d>,
        velocities: &[Twist<'d>],
        rate: &mut Tangent<'d>,
    ) -> Vec<Twist<'d>> {
        let zero = [model.dag.zero(); 3];
        let mut accelerations: Vec<Twist<'d>> = Vec::with_capacity(model.poses.len());
        for (index, pose) in model.poses.iter().enumerate() {
            let mut here = match accelerations.get(pose.parent.index()) {
                Some(parent) if self.needed[index] => parent.clone(),
                _ => Twist {
                    linear: ground,
                    angular: zero,
                },
            };
            let omega = &velocities[index].angular;
            match &pose.step {
                PoseChange::Shift(r) if self.needed_origin[index] => {
                    let turning = AccelerationMatrix::of(omega, &here.angular);
                    here.linear = shifted_acceleration(&here, omega, &turning, &vector(r), rate);
                }
                &PoseChange::Turn { axis, angle } if self.needed[index] => {
                    if self.needed_origin[index] {
                        here.linear = rotated(&here.linear, axis, angle);
                    }
                    here.angular = rotated(&here.angular, axis, angle);
                    let angle_rate = rate.of(angle);
                    let (next, last) = others(axis);
                    here.angular[axis] = here.angular[axis] + rate.twice(angle);
                    // ω'×e: for e = z it is (ω_y, −ω_x, 0).
                    here.angular[next] = here.angular[next] + angle_rate * omega[last];
                    here.angular[last] = here.angular[last] - angle_rate * omega[next];
                }
                PoseChange::Quaternion(e) if self.needed[index] => {
                    let axes = quaternion::axes(e);
                    if self.needed_origin[index] {
                        here.linear = components_along(&axes, &here.linear);
                    }
                    let rates = e.map(|e| rate.of(e));
                    let own = quaternion::angular_velocity(e, &rates);
                    let faster =
                        quaternion::angular_acceleration(e, &rates, &e.map(|e| rate.twice(e)));
                    let carried = cross(omega, &own);
                    here.angular =
                        add(&[&components_along(&axes, &here.angular), &faster, &carried]);
                }
                PoseChange::Ground
                | PoseChange::Shift(_)
                | PoseChange::Turn { .. }
                | PoseChange::Quaternion(_) => {}
            }
            accelerations.push(here);
        }
        accelerations
    }

    /// A vector of the ground in the axes of every requested frame.
    pub fn ground_vector_in_axes<'d>(
        &self,
        model: &Model<'d>,
        ground: Vector<'d>,
    ) -> Vec<Vector<'d>> {
        let mut vectors: Vec<Vector<'d>> = Vec::with_capacity(model.poses.len());
        for (index, pose) in model.poses.iter().enumerate() {
            let parent = vectors.get(pose.parent.index()).copied().unwrap_or(ground);
            vectors.push(match pose.step {
                PoseChange::Turn { axis, angle } if self.needed[index] => {
                    rotated(&parent, axis, angle)
                }
                PoseChange::Quaternion(e) if self.needed[index] => {
                    components_along(&quaternion::axes(&e), &parent)
                }
                _ => parent,
            });
        }
        vectors
    }
}

/// A vector of the ground in the axes of one frame: `Rᵀ` for each turn on the way there; or, far
/// from the ground, its products with the axes, so that a vector on every link of a long chain does
/// not take as many traversals of the chain.
pub(super) fn along_axes<'d>(model: &Model<'d>, pose: PoseId, ground: &[Expr<'d>]) -> Vector<'d> {
    const MOST_ROTATIONS: usize = 64;
    let mut turns = Vec::new();
    let mut here = pose;
    while here != PoseId::GROUND && turns.len() <= MOST_ROTATIONS {
        let Pose { parent, step, .. } = &model.poses[here.index()];
        turns.extend(match step {
            PoseChange::Turn { .. } | PoseChange::Quaternion(_) => Some(step),
            PoseChange::Ground | PoseChange::Shift(_) => None,
        });
        here = *parent;
    }
    if here != PoseId::GROUND {
        let axes = &model.poses[pose.index()].axes;
        return [0, 1, 2].map(|k| {
            model
                .dag
                .sum(axes[k].iter().zip(ground).map(|(&e, &g)| e * g))
        });
    }
    let turn = |vector, step: &PoseChange<'d>| match step {
        &PoseChange::Turn { axis, angle } => rotated(&vector, axis, angle),
        PoseChange::Quaternion(e) => components_along(&quaternion::axes(e), &vector),
        PoseChange::Ground | PoseChange::Shift(_) => vector,
    };
    turns.into_iter().rev().fold(vector(ground), turn)
}

/// The velocity of a point `r` of a frame, in its axes: `u + ω×r + ṙ`.
pub(super) fn velocity_at<'d>(
    frame: &Twist<'d>,
    r: &Vector<'d>,
    rate: &mut Tangent<'d>,
) -> Vector<'d> {
    add(&[
        &frame.linear,
        &cross(&frame.angular, r),
        &r.map(|r_k| rate.of(r_k)),
    ])
}

/// The acceleration of a point `r` of a frame, in its axes: `a + α×r + ω×(ω×r + 2 ṙ) + r̈`.
pub(super) fn acceleration_at<'d>(
    frame: &Twist<'d>,
    omega: &Vector<'d>,
    r: &Vector<'d>,
    rate: &mut Tangent<'d>,
) -> Vector<'d> {
    let relative = add(&[&cross(omega, r), &r.map(|r_k| 2 * rate.of(r_k))]);
    let spinning = cross(omega, &relative);
    add(&[
        &frame.linear,
        &cross(&frame.angular, r),
        &spinning,
        &r.map(|r_k| rate.twice(r_k)),
    ])
}

/// The acceleration of the origin of a frame that is shifted by `r`.
fn shifted_acceleration<'d>(
    here: &Twist<'d>,
    omega: &Vector<'d>,
    turning: &AccelerationMatrix<'d>,
    r: &Vector<'d>,
    rate: &mut Tangent<'d>,
) -> Vector<'d> {
    add(&[
        &here.linear,
        &turning.apply(r),
        &cross(omega, &r.map(|r_k| 2 * rate.of(r_k))),
        &r.map(|r_k| rate.twice(r_k)),
    ])
}

/// The rotation of a frame, as the matrix `W = α× + ω×ω×` that gives the acceleration `W r` of its
/// points, entry by entry, so that common parts of several points and tensors are computed once.
pub(super) struct AccelerationMatrix<'d> {
    /// `α`.
    alpha: Vector<'d>,
    /// `ωᵢ²`.
    squares: Vector<'d>,
    /// `ω_y ω_z`, `ω_z ω_x`, `ω_x ω_y`.
    products: Vector<'d>,
}

impl<'d> AccelerationMatrix<'d> {
    pub fn of(omega: &Vector<'d>, alpha: &Vector<'d>) -> AccelerationMatrix<'d> {
        AccelerationMatrix {
            alpha: *alpha,
            squares: omega.map(|w| w.square()),
            products: [0, 1, 2].map(|k| {
                let (next, last) = others(k);
                omega[next] * omega[last]
            }),
        }
    }

    /// `W` below the diagonal, cyclically: `ωᵢ ωⱼ + αₖ` in row `j` and column `i`.
    fn below(&self, k: usize) -> Expr<'d> {
        self.products[k] + self.alpha[k]
    }

    /// `W` above it: `ωᵢ ωⱼ − αₖ` in row `i` and column `j`.
    fn above(&self, k: usize) -> Expr<'d> {
        self.products[k] - self.alpha[k]
    }

    /// `W r = α×r + ω×(ω×r)`.
    pub fn apply(&self, r: &Vector<'d>) -> Vector<'d> {
        [0, 1, 2].map(|k| {
            let (next, last) = others(k);
            let outward = self.squares[next] + self.squares[last];
            r[0].dag().sum([
                -(outward * r[k]),
                self.above(last) * r[next],
                self.below(next) * r[last],
            ])
        })
    }

    /// `J α + ω×J ω` for a tensor `xx, yy, zz, xy, xz, yz`, eq. (E15), in the entries of `W`:
    ///
    /// ```text
    /// J_xx α_x + (J_zz − J_yy) ω_y ω_z + J_yz (ω_y² − ω_z²) + J_xz W_yx − J_xy W_zx
    /// ```
    pub fn inertia_moment(&self, tensor: &[Expr<'d>; 6]) -> Vector<'d> {
        let [xx, yy, zz, xy, xz, yz] = *tensor;
        let (diagonal, off) = ([xx, yy, zz], [yz, xz, xy]);
        [0, 1, 2].map(|k| {
            let (next, last) = others(k);
            xx.dag().sum([
                diagonal[k] * self.alpha[k],
                (diagonal[last] - diagonal[next]) * self.products[k],
                off[k] * (self.squares[next] - self.squares[last]),
                off[next] * self.below(last),
                -(off[last] * self.above(next)),
            ])
        })
    }
}

/// The other two axes, in cyclic order.
pub(super) fn others(axis: usize) -> (usize, usize) {
    ((axis + 1) % 3, (axis + 2) % 3)
}

/// `Rᵀu`: the components of a vector in axes that are turned by `angle` about one of them.
fn rotated<'d>(u: &Vector<'d>, axis: usize, angle: Expr<'d>) -> Vector<'d> {
    let (next, last) = others(axis);
    let (sin, cos) = (angle.sin(), angle.cos());
    let mut result = *u;
    result[next] = cos * u[next] + sin * u[last];
    result[last] = cos * u[last] - sin * u[next];
    result
}

/// The components of a vector in other axes, which are given in the present ones.
fn components_along<'d>(axes: &[Vector<'d>; 3], u: &Vector<'d>) -> Vector<'d> {
    axes.map(|axis| u[0].dag().sum((0..3).map(|k| axis[k] * u[k])))
}

/// Three components as an array.
pub(super) fn vector<'d>(components: &[Expr<'d>]) -> Vector<'d> {
    [0, 1, 2].map(|k| components[k])
}

/// All partial derivatives, by one reverse sweep.
pub(super) fn gradient<'d>(dag: &'d Dag, of: Expr<'d>, wrt: &[Symbol]) -> Vec<Expr<'d>> {
    lagrangian_symbolic::reverse(dag, &[(of, dag.one())], wrt)
}
