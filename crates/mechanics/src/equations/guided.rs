//! Guides beside unilateral contacts: the same law of contact for both.
//!
//! ```text
//! reaction   N = ν + ρ·a + χ·λ + Σ κ F                                                   (E81)
//! ```
//!
//! A guide is a contact that is never open: its gap and the row of its normal are 0, and its slip and its row are those of (E32). Instead of a
//! displacement along its normal, which the machine does not have, it has its reaction (E33), in which the forces `F` are those along all directions of
//! the contacts, the friction of the guides among them.

use super::Equations;
use super::sliding::SlidingEquation;
use super::unilateral::{DirectionEquation, UnilateralEquation};
use lagrangian_spec::model::{ImpactLaw, ImpactOrder, Model, Painleve};

/// Turns the guides of a plane machine that has unilateral contacts into contacts, behind the others.
pub(super) fn beside_contacts<'d>(model: &Model<'d>, equations: &mut Equations<'d>) {
    if equations.unilateral.is_empty() {
        return;
    }
    let guides = std::mem::take(&mut equations.sliding);
    let (law, order) = equations
        .unilateral
        .iter()
        .find(|contact| contact.compliance.is_none())
        .map_or_else(Default::default, |rigid| (rigid.law, rigid.order));
    let zero = model.dag.zero();
    let reactions = guides.iter().filter_map(|guide| guide.reactions.first());
    let reactions = reactions.map(|reaction| reaction.clone().with_friction_of_contacts(zero));
    equations.guides.extend(reactions);
    let contacts = guides
        .into_iter()
        .map(|guide| contact(model, guide, (law, order)));
    equations.unilateral.extend(contacts);
}

/// A guide as a contact.
fn contact<'d>(
    model: &Model<'d>,
    guide: SlidingEquation<'d>,
    (law, order): (ImpactLaw, ImpactOrder),
) -> UnilateralEquation<'d> {
    let zero = model.dag.zero();
    let normal = DirectionEquation {
        rate: zero,
        row: vec![zero; guide.row.len()],
        bias: zero,
    };
    let tangent = DirectionEquation {
        rate: guide.slip,
        row: guide.row,
        bias: guide.bias,
    };
    UnilateralEquation {
        name: guide.name,
        gap: zero,
        directions: [normal, tangent],
        coefficients: [zero, zero, guide.friction, guide.static_friction],
        law,
        order,
        painleve: Painleve::default(),
        compliance: None,
        has_friction: true,
        is_rolling_resistance: false,
        is_second_tangent: false,
        face: None,
        is_guide: true,
    }
}
