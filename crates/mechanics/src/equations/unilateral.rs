//! Unilateral contacts: gaps, their rates, and slip velocities.
//!
//! ```text
//! gap        g(q, t) ≥ 0,   γₙ = Dg = wₙ v + ∂g/∂t,   wₙ = ∂γₙ/∂v                     (E51)
//! slip       γₜ = wₜ v + b(q, t),                     wₜ = ∂γₜ/∂v                      (E52)
//! rates      dγ/dt = w a + δ,                         δ = Dγ at a = 0                  (E53)
//! rolling    γ = ω − ω′, of circles that resist it
//! polygons   g = maxₖ dₖ(p),   γ of the face that separates best                      (E77)
//! across     γₜ along a second tangent, in space
//! motion     M a = f + Gᵀλ + Σ wₙᵀ λₙ + Σ wₜᵀ λₜ
//! ```
//!
//! `D` is the total time derivative (E8), so a moving wall is in `γ` and in `δ`. Contact forces,
//! sticking, and the rates after an impact are found by the run.

use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::{Variables, gradient};
use super::refusal::refuse_large_contact;
use super::shorter::shorter;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::identity;
use lagrangian_spec::model::circles::{self, Meeting, RelativeMotion};
use lagrangian_spec::model::{
    self, Circle, Compliance, ContactGeometry, ImpactLaw, ImpactOrder, Model, Painleve, Space,
    Surface, polygons, spheres,
};

/// A unilateral contact.
#[derive(Clone, Debug)]
pub struct UnilateralEquation<'d> {
    /// Its name.
    pub name: String,
    /// `g(q, t)`, in m.
    pub gap: Expr<'d>,
    /// Along the normal, and along the tangent.
    pub directions: [DirectionEquation<'d>; 2],
    /// `e` and `eₜ`, or the parameters of a force law; `μ` and `μ₀`.
    pub coefficients: [Expr<'d>; 4],
    /// The impact law, if it is rigid.
    pub law: ImpactLaw,
    /// Whether simultaneous impacts are solved together or one after the other.
    pub order: ImpactOrder,
    /// What happens if friction leaves no consistent motion (Painlevé's paradox).
    pub painleve: Painleve,
    /// The force law, if it is compliant.
    pub compliance: Option<Compliance>,
    /// Whether there is friction.
    pub has_friction: bool,
    /// Whether it is the rolling resistance of the preceding contact: see [`Unilateral`](lagrangian_program::Unilateral).
    pub is_rolling_resistance: bool,
    /// Whether it is the second tangent of the preceding contact, in space: see [`Unilateral`](lagrangian_program::Unilateral).
    pub is_second_tangent: bool,
    /// For a corner on a face of a polygon, its distance outside the face, its distance beyond the ends of the face, and the
    /// rate of the latter.
    pub face: Option<[Expr<'d>; 3]>,
    /// Whether it is a guide: see [`Unilateral`](lagrangian_program::Unilateral).
    pub is_guide: bool,
}

/// A direction of a contact.
#[derive(Clone, Debug)]
pub struct DirectionEquation<'d> {
    /// `γ(q, v, t)`, in m/s.
    pub rate: Expr<'d>,
    /// `w(q, t)`, one entry for each coordinate.
    pub row: Vec<Expr<'d>>,
    /// `δ(q, v, t)`.
    pub bias: Expr<'d>,
}

/// The unilateral contacts of a machine, in their order; `None` if they are too large to be derived, with the first one that is in the report.
pub(crate) fn unilateral<'d>(
    model: &Model<'d>,
    report: &mut Report,
) -> Option<Vec<UnilateralEquation<'d>>> {
    let x = Variables::of(model);
    let mut coasting = x.without_acceleration(model);
    let mut all = Vec::with_capacity(model.contacts.len());
    for contact in &model.contacts {
        all.extend(of_contact(model, (&x, &mut coasting), contact));
        if model.dag.is_exhausted() {
            refuse_large_contact(model, contact, report);
            return None;
        }
    }
    Some(all)
}

/// The relative motion of what touches.
struct Touch<'d> {
    gap: Expr<'d>,
    slip: Expr<'d>,
    /// The other component of the slip, in space.
    across: Option<Expr<'d>>,
    /// Of a corner of a polygon the rate of the gap.
    corner_rate: Option<Expr<'d>>,
    /// What [`UnilateralEquation::face`] holds.
    face: Option<[Expr<'d>; 3]>,
}

impl<'d> Touch<'d> {
    fn of(
        model: &Model<'d>,
        coasting: &mut Tangent<'d>,
        contact: &model::Contact<'d>,
    ) -> Touch<'d> {
        match &contact.geometry {
            ContactGeometry::Corner(corner) => {
                let touching = polygons::relative_motion(model, corner, coasting);
                let beyond_rate = coasting.of(touching.beyond);
                Touch {
                    gap: touching.gap,
                    slip: touching.slip,
                    across: None,
                    corner_rate: Some(touching.rate),
                    // A corner that yields has no ends of faces to leave.
                    face: (!corner.yields).then_some([
                        touching.height,
                        touching.beyond,
                        beyond_rate,
                    ]),
                }
            }
            ContactGeometry::Circles(touching) => {
                let circle = &model.circles[touching.circle];
                Touch::of_round(model, coasting, (circle, touching.surface), contact)
            }
            ContactGeometry::Point { point, surface } => {
                Touch::of_round(model, coasting, (point, *surface), contact)
            }
            &ContactGeometry::Expressions { gap, slip, across } => Touch {
                gap,
                slip,
                across,
                corner_rate: None,
                face: None,
            },
        }
    }

    /// Of a circle, or in space of a sphere.
    fn of_round(
        model: &Model<'d>,
        coasting: &mut Tangent<'d>,
        (round, surface): (&Circle<'d>, Surface),
        contact: &model::Contact<'d>,
    ) -> Touch<'d> {
        // What yields is penetrated while it presses; rigid bodies touch at one place.
        let meeting = match contact.response.compliance() {
            Some(_) if contact.friction.is_some() => Meeting::Common,
            _ => Meeting::Nearest,
        };
        let (gap, slip, across) = match model.space {
            Space::Plane => {
                let RelativeMotion { gap, slip } =
                    circles::relative_motion(model, round, surface, meeting, coasting);
                (gap, slip, None)
            }
            Space::Space => {
                let spheres::RelativeMotion { gap, slip } =
                    spheres::relative_motion(model, round, surface, meeting, coasting);
                (gap, slip[0], Some(slip[1]))
            }
        };
        Touch {
            gap,
            slip,
            across,
            corner_rate: None,
            face: None,
        }
    }
}

/// The equations of a contact: its own, and those of its second tangent or its rolling resistance if it has one.
fn of_contact<'d>(
    model: &Model<'d>,
    (x, coasting): (&Variables<'d>, &mut Tangent<'d>),
    contact: &model::Contact<'d>,
) -> Vec<UnilateralEquation<'d>> {
    let touch = Touch::of(model, coasting, contact);
    let at = touch.gap;
    let shorter = |e: Expr<'d>| shorter(model, (e, at));
    let zero = model.dag.zero();
    let has_friction = contact.friction.is_some();
    let (gap, rate, slip) = match touch.corner_rate {
        // These select among features, and multiplied out they would be long.
        Some(rate) => (
            touch.gap,
            rate,
            if has_friction { touch.slip } else { zero },
        ),
        None => {
            let gap = shorter(touch.gap);
            let slip = if has_friction {
                shorter(touch.slip)
            } else {
                zero
            };
            (gap, coasting.of(gap), slip)
        }
    };
    let friction = contact.friction.unwrap_or(zero);
    let [first, second] = contact.response.coefficients();
    let own = UnilateralEquation {
        name: contact.name.to_string(),
        gap,
        directions: [rate, slip].map(|rate| direction(model, (x, &mut *coasting), rate)),
        coefficients: [
            first,
            second,
            friction,
            contact.static_friction.unwrap_or(friction),
        ],
        law: contact.response.impact_law().unwrap_or_default(),
        order: contact.response.order().unwrap_or_default(),
        painleve: contact.response.painleve(),
        compliance: contact.response.compliance(),
        has_friction,
        is_rolling_resistance: false,
        is_second_tangent: false,
        face: touch.face,
        is_guide: false,
    };
    let further = match (touch.across, &contact.geometry, contact.rolling_resistance) {
        (Some(across), ..) if has_friction => {
            let across = direction(model, (x, &mut *coasting), shorter(across));
            Some(second_tangent(&own, across))
        }
        (_, ContactGeometry::Circles(touching), Some(resistance)) => {
            let rate = shorter(circles::rolling_rate(model, touching, coasting));
            let turning = direction(model, (x, &mut *coasting), rate);
            Some(rolling(&own, turning, resistance))
        }
        _ => None,
    };
    [own].into_iter().chain(further).collect()
}

/// The second tangent of a contact: it shares the gap and the normal of that contact; only the other component of the slip is its
/// own.
fn second_tangent<'d>(
    first: &UnilateralEquation<'d>,
    across: DirectionEquation<'d>,
) -> UnilateralEquation<'d> {
    let [normal, _] = first.directions.clone();
    UnilateralEquation {
        name: format!("{}.across", first.name),
        directions: [normal, across],
        painleve: Painleve::default(),
        compliance: None,
        is_second_tangent: true,
        ..first.clone()
    }
}

/// The rolling resistance of a contact: it shares the gap and the normal of that contact; only an angular velocity is its own.
fn rolling<'d>(
    contact: &UnilateralEquation<'d>,
    turning: DirectionEquation<'d>,
    resistance: Expr<'d>,
) -> UnilateralEquation<'d> {
    let zero = resistance.dag().zero();
    let [normal, _] = contact.directions.clone();
    UnilateralEquation {
        name: format!("{}.rolling", contact.name),
        directions: [normal, turning],
        coefficients: [zero, zero, resistance, resistance],
        painleve: Painleve::default(),
        compliance: None,
        has_friction: true,
        is_rolling_resistance: true,
        ..contact.clone()
    }
}

fn direction<'d>(
    model: &Model<'d>,
    (x, coasting): (&Variables<'d>, &mut Tangent<'d>),
    rate: Expr<'d>,
) -> DirectionEquation<'d> {
    let mut row = gradient(model.dag, rate, &x.v);
    identity::write_zeros(model.dag, &mut row);
    DirectionEquation {
        rate,
        row,
        bias: coasting.of(rate),
    }
}
