//! Bushings: elastic joints between two frames in the plane, with three stiffnesses, three dampings and a preload.
//!
//! The deformation is the pose of the second frame relative to the first: the displacement (x, y) of
//! its origin in the axes of the first, and the relative angle φ.
//!
//! ```text
//! V = ½ kx x² + ½ ky y² + ½ kφ φ² − Fx x − Fy y − M φ,    D = ½ bx ẋ² + ½ by ẏ² + ½ bφ φ̇²
//! ```
//!
//! So at zero displacement the preload (Fx, Fy, M) is the load on the second frame, in the axes of the
//! first. A common motion of both frames stores and dissipates no energy.

use lagrangian_symbolic::Expr;
use lagrangian_symbolic::sorting::sort_by_key;

use super::damper::DAMPING;
use super::spring::STIFFNESS;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::circles::terms;
use crate::model::element::{Contribution, Deformation, Drawing, Energy, Shape, Site};
use crate::model::{PoseChange, PoseId, Space, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, limit, limits};
use crate::syntax::{Expression, ExpressionKind, Form, Record, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "bushings",
    item: "a bushing",
    noun: "bushing",
    form: Form::Records(&["from", "to", "stiffness", "damping", "preload"]),
    help: "a bushing is `name { from: frame, to: frame, stiffness: (kx, ky, kphi) }`, and where \
           needed `damping: (bx, by, bphi)` and `preload: (Fx, Fy, M)`",
};

static PRELOAD: Limit = limit(
    stage::TIME,
    "a preload",
    "what depends on coordinates or velocities belongs under `forces` or `potentials`",
);

/// The values of a field: two along the axes, and one about them.
struct Values {
    field: &'static str,
    /// The units of the values along the axes, and of the value about them.
    units: [Unit; 2],
    reason: &'static str,
    limit: &'static Limit,
    bound: Option<BoundKind<'static>>,
}

const STIFFNESSES: Values = Values {
    field: "stiffness",
    units: [Unit::base(1, 0, -2), Unit::JOULE],
    reason: "the stiffnesses of a bushing are in N/m, N/m and N*m",
    limit: &STIFFNESS,
    bound: Some(BoundKind::Stiffness),
};

const DAMPINGS: Values = Values {
    field: "damping",
    units: [Unit::base(1, 0, -1), Unit::base(1, 2, -1)],
    reason: "the dampings of a bushing are in N*s/m, N*s/m and N*m*s",
    limit: &DAMPING,
    bound: Some(BoundKind::Damping),
};

const PRELOADS: Values = Values {
    field: "preload",
    units: [Unit::NEWTON, Unit::JOULE],
    reason: "the preload of a bushing is in N, N and N*m",
    limit: &PRELOAD,
    bound: None,
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    if resolver.space == Space::Space {
        let message = "bushings exist only in the plane";
        resolver.error(Code::WrongSpace, resolver.span(member), message);
        return None;
    }
    let ends = ["from", "to"].map(|end| {
        let end = resolver.field(member, record, end)?;
        let scope = resolver.scope(member, &limits::POINT);
        Some((resolver.frame(end, scope)?, end.span))
    });
    let stiffness = resolver.field(member, record, STIFFNESSES.field);
    let stiffness =
        stiffness.and_then(|written| three_values(resolver, member, written, &STIFFNESSES));
    let damping = optional(resolver, member, record, &DAMPINGS);
    let preload = optional(resolver, member, record, &PRELOADS);
    let [Some((from, _)), Some((to, span))] = ends else {
        return None;
    };
    if from == to {
        let message = "a bushing joins two frames, but both of its ends are the same frame";
        resolver.error(Code::ConflictingFields, span, message);
        return None;
    }

    let measures = relative_pose(resolver, from, to);
    let deformations = |coefficients: [Expr<'d>; 3]| {
        let pairs = coefficients.into_iter().zip(measures).enumerate();
        // A direction without stiffness or damping adds no term.
        let pairs = pairs.filter(|(_, (coefficient, _))| !coefficient.is_zero());
        pairs.map(|(k, (coefficient, measure))| {
            Energy::Quadratic(Deformation {
                coefficient,
                measure,
                torsional: k == 2,
            })
        })
    };
    let stored = deformations(stiffness?).map(Contribution::Stored);
    let dissipated = deformations(damping?).map(Contribution::Dissipated);
    let work = preload?.into_iter().zip(measures);
    let work = work.map(|(force, measure)| force * measure);
    let work = resolver.dag.sum(work);
    let preloaded = (!work.is_zero()).then(|| Contribution::Stored(Energy::Given(-work)));
    let contributions = stored.chain(preloaded).chain(dissipated);
    Some(Resolved::of(contributions).drawn(Drawing {
        shape: Shape::Coil,
        site: Site::At(resolver.origin(to).components),
    }))
}

/// Three optional values, zero if left out.
fn optional<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    values: &Values,
) -> Option<[Expr<'d>; 3]> {
    match record.get(values.field) {
        Some(written) => three_values(resolver, member, written, values),
        None => Some([resolver.dag.zero(); 3]),
    }
}

/// Two values along the axes, and one about them. They are not a vector, since their units differ.
fn three_values<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    written: &'a Expression,
    values: &Values,
) -> Option<[Expr<'d>; 3]> {
    let parts = match &written.kind {
        ExpressionKind::Tuple(parts) => &parts[..],
        ExpressionKind::Error => return None,
        _ => std::slice::from_ref(written),
    };
    let [x, y, angle] = parts else {
        let message = format!(
            "expected three values, two along the axes and one for the rotation, found {}",
            parts.len()
        );
        let diagnostic = Diagnostic::new(Code::WrongDimension, written.span, message);
        let help = format!("write `{}: (…, …, …)`", values.field);
        resolver.push(diagnostic.help(help));
        return None;
    };
    let [along, about] = values.units;
    let found = [(x, along), (y, along), (angle, about)].map(|(part, unit)| {
        let scope = resolver.scope(member, values.limit);
        let scalar = resolver.scalar_in(part, unit, values.reason, scope)?;
        if let Some(bound) = values.bound {
            resolver.bound(bound, scalar.expr, part.span);
        }
        Some(scalar.expr)
    });
    let [Some(x), Some(y), Some(angle)] = found else {
        return None;
    };
    Some([x, y, angle])
}

/// The largest number of steps from frame to frame that are followed. Frames farther apart are
/// measured from the ground, so that bushings on every link of a long chain do not take as many
/// traversals of it.
const FRAME_STEP_LIMIT: usize = 64;

/// The pose of the frame `to` relative to `from`: x, y and φ. Their common base is left out.
///
/// On the way from one to the other every shift was made in the axes of some frame of angle ψ, and so is
/// turned by ψ minus the angle of `from`: nothing in it has to cancel, and a frame that is built on
/// `from` by a shift alone is displaced by that shift.
fn relative_pose<'d>(resolver: &Resolver<'_, 'd, '_>, from: PoseId, to: PoseId) -> [Expr<'d>; 3] {
    let (dag, base) = (resolver.dag, resolver.pose(from).angle);
    let less_base = |angle: Expr<'d>| {
        let base = terms(base).into_iter().map(|term| -term);
        dag.sum(terms(angle).into_iter().chain(base))
    };
    let shifts = shifts_between(resolver, from, to).unwrap_or_else(|| {
        let [from, to] = [from, to].map(|frame| resolver.pose(frame).origin.clone());
        vec![
            Shift::new(dag.zero(), from, true),
            Shift::new(dag.zero(), to, false),
        ]
    });
    let (mut x, mut y) = (Vec::new(), Vec::new());
    let mut left = &shifts[..];
    // Shifts along the same axes are combined.
    while let Some(first) = left.first() {
        let count = left
            .iter()
            .take_while(|shift| shift.angle == first.angle)
            .count();
        let (group, others) = left.split_at(count);
        left = others;
        let along = |k: usize| dag.sum(group.iter().flat_map(|shift| shift.terms(k)));
        let shift = [along(0), along(1)];
        let turned = less_base(first.angle);
        let (sin, cos) = (turned.sin(), turned.cos());
        x.extend([cos * shift[0], -(sin * shift[1])]);
        y.extend([sin * shift[0], cos * shift[1]]);
    }
    [dag.sum(x), dag.sum(y), less_base(resolver.pose(to).angle)]
}

/// A shift on the way, in the axes of a frame that is turned by an angle.
struct Shift<'d> {
    angle: Expr<'d>,
    displacement: Vec<Expr<'d>>,
    /// Whether it lies between `from` and the common base of both frames, and counts with the opposite sign.
    is_reversed: bool,
}

impl<'d> Shift<'d> {
    fn new(angle: Expr<'d>, by: Vec<Expr<'d>>, is_back: bool) -> Shift<'d> {
        Shift {
            angle,
            displacement: by,
            is_reversed: is_back,
        }
    }

    /// The terms of a component.
    fn terms(&self, k: usize) -> impl Iterator<Item = Expr<'d>> {
        let is_back = self.is_reversed;
        let signed = move |term: Expr<'d>| if is_back { -term } else { term };
        terms(self.displacement[k]).into_iter().map(signed)
    }
}

/// The shifts on the way from one frame to another, with their angles; nothing if the way is long.
fn shifts_between<'d>(
    resolver: &Resolver<'_, 'd, '_>,
    from: PoseId,
    to: PoseId,
) -> Option<Vec<Shift<'d>>> {
    let mut shifts = Vec::new();
    let (mut near, mut far) = ((from, true), (to, false));
    for _ in 0..FRAME_STEP_LIMIT {
        if near.0 == far.0 {
            sort_by_key(&mut shifts, |shift: &Shift<'d>| shift.angle.id());
            return Some(shifts);
        }
        // A frame is made after its parent, so the later of the two is not an ancestor of the other.
        if near.0 > far.0 {
            std::mem::swap(&mut near, &mut far);
        }
        let (frame, is_back) = far;
        let pose = resolver.pose(frame);
        if let PoseChange::Shift(by) = &pose.step {
            let angle = resolver.pose(pose.parent).angle;
            shifts.push(Shift::new(angle, by.clone(), is_back));
        }
        let relaxed = resolver.relaxed_by(frame);
        shifts.extend(relaxed.map(|by| Shift::new(resolver.dag.zero(), by, is_back)));
        far.0 = pose.parent;
    }
    None
}
