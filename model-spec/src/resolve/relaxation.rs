//! Relaxes the guides of a machine.
//!
//! A guide holds a body on a line, and its reaction is found by releasing the body: the frame of the
//! body, with everything built on it, may move off by a displacement that is a coordinate of its
//! own. The spec is resolved once more with these displacements, so that springs, points and outputs
//! attached to the body depend on them. If they are zero, it is the original machine.
//!
//! # Why the spec is resolved twice
//!
//! To resolve it only once, with the displacements in it, and to substitute 0 for them afterwards, would give another machine:
//!
//! * Decisions of the resolver hold for the machine with its guides: a wheel whose height is identically its radius has no
//!   constraint of its gap, a slip that vanishes identically is no constraint, a drag force is along a coordinate. With
//!   displacements such identities do not hold, and a substitution cannot undo the decision.
//! * Terms of sums and factors of products are in the order of their construction. With displacements between them the order
//!   differs, and with it the last bits of the programs of all machines with guides.
//! * The displaced frame, and whether it carries the centre of its body, is known only when bodies are resolved, and by then
//!   the origins of frames are parts of other expressions.
//! * The substitution would have to reach every expression of a [`Model`]; one that it misses would be a wrong answer without a
//!   message.

use lagrangian_symbolic::{Expr, Stage};
use rustc_hash::FxHashMap;

use super::Resolver;
use super::value::{MemberId, Vector};
use crate::model::element::Sliding;
use crate::model::{Coordinate, Model, Name, Pose, PoseId, Rotation, stage};
use crate::source::Span;
use crate::unit::{Unit, rate_name};

/// A relaxed guide.
pub(super) struct RelaxedGuide<'d> {
    name: String,
    span: Span,
    /// The frame that moves off, with everything built on it.
    frame: Option<PoseId>,
    /// The index of the body whose mass centre moves off by itself, because it is not built on that frame.
    body: Option<usize>,
    /// The displacement in ground axes: symbols of each component, of its rate, and of its acceleration.
    pub displacement: Vec<[Expr<'d>; 3]>,
}

/// The guides of a machine, in the order of its contacts; a surface is one guide with two contacts.
pub(super) fn guides<'d>(model: &Model<'d>) -> Vec<RelaxedGuide<'d>> {
    let sliding = model.sliding().into_iter();
    // Both tangents of a surface belong to one guide.
    let sliding = sliding.filter(|one| !one.is_second());
    sliding.map(|one| guide(model, one)).collect()
}

fn guide<'d>(model: &Model<'d>, sliding: &Sliding<'d>) -> RelaxedGuide<'d> {
    let body = &model.bodies[sliding.body];
    let frame = match body.rotation {
        Rotation::Frame(pose) if pose != PoseId::GROUND => Some(pose),
        _ => None,
    };
    let place = body.local.as_ref().map(|local| local.pose);
    let is_carried = frame.is_some_and(|frame| {
        place.is_some_and(|mut place| {
            while place != frame && place != PoseId::GROUND {
                place = model.poses[place.index()].parent;
            }
            place == frame
        })
    });
    let name = sliding.name.to_string();
    let component = |axis: &str| {
        let symbol = |of: &str, stage| model.dag.symbol(&format!("{of}({name}.{axis})"), stage);
        [
            symbol("relaxed", stage::POSITION),
            symbol("relaxed_rate", stage::VELOCITY),
            symbol("relaxed_acceleration", stage::ACCELERATION),
        ]
    };
    let axes = ["x", "y", "z"].iter().take(model.space.dimension());
    RelaxedGuide {
        span: sliding.span,
        frame,
        body: (!is_carried).then_some(sliding.body),
        displacement: axes.map(|axis| component(axis)).collect(),
        name,
    }
}

/// The symbols of a machine by name; the relaxed machine uses the same ones.
pub(super) fn symbols<'d>(model: &Model<'d>) -> FxHashMap<String, Expr<'d>> {
    let parameters = model
        .parameters
        .iter()
        .map(|p| (p.name.to_string(), p.symbol));
    let inputs = model.inputs.iter().map(|i| (i.name.to_string(), i.symbol));
    let coordinates = model.coordinates.iter().flat_map(|c| {
        let name = c.name.to_string();
        let rate = rate_name(&name, "");
        let acceleration = rate_name(&rate, "");
        [(name, c.q), (rate, c.v), (acceleration, c.a)]
    });
    parameters.chain(inputs).chain(coordinates).collect()
}

impl<'d> Resolver<'_, 'd, '_> {
    /// A symbol of the machine: a new one, or that of the machine that is being relaxed.
    pub(super) fn symbol(&self, name: &str, stage: Stage) -> Expr<'d> {
        let known = self.symbols.get(name).copied();
        known.unwrap_or_else(|| self.dag.symbol(name, stage))
    }

    /// Displaces a new pose by the guides of its frame. Poses are numbered in the order in which
    /// they are made, which is the same the second time.
    pub(super) fn relax_pose(&self, id: PoseId, pose: &mut Pose<'d>) {
        for by in self.relaxed_by(id) {
            for (x, by) in pose.origin.iter_mut().zip(by) {
                *x = *x + by;
            }
        }
    }

    /// The displacements of a pose from its parent by guides, in ground axes.
    pub fn relaxed_by(&self, id: PoseId) -> impl Iterator<Item = Vec<Expr<'d>>> {
        let guides = self
            .guides
            .iter()
            .filter(move |guide| guide.frame == Some(id));
        guides.map(|guide| guide.displacement.iter().map(|&[by, ..]| by).collect())
    }

    /// The mass centre of a body, displaced by the guides of the body unless its frame carries it.
    pub(super) fn relaxed_centre(&self, member: MemberId, mut centre: Vector<'d>) -> Vector<'d> {
        let body = self.ordinal(member);
        for guide in &self.guides {
            if guide.body.is_some() && guide.body == body {
                centre.local = None;
                for (x, &[by, ..]) in centre.components.iter_mut().zip(&guide.displacement) {
                    *x = *x + by;
                }
            }
        }
        centre
    }

    /// The displacements, as coordinates.
    pub(super) fn relaxed_coordinates(&self) -> Vec<Coordinate<'d>> {
        let of_guide = |guide: &RelaxedGuide<'d>| {
            let coordinate = |&[q, v, a]: &[Expr<'d>; 3]| Coordinate {
                name: Name {
                    base: guide.name.clone(),
                    index: None,
                },
                docs: String::new(),
                unit: Unit::METRE,
                unit_text: "m".into(),
                start: self.dag.zero(),
                start_rate: self.dag.zero(),
                rate: None,
                q,
                v,
                a,
                span: guide.span,
            };
            guide
                .displacement
                .iter()
                .map(coordinate)
                .collect::<Vec<_>>()
        };
        self.guides.iter().flat_map(of_guide).collect()
    }
}
