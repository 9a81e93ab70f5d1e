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
use lagrangian_symbolic::Expr;

/// The normal reaction of a guide beside unilateral contacts, as a linear form.
#[derive(Clone, Debug)]
pub struct GuideEquation<'d> {
    /// `ν(q, v, t, u)`, in N: its value without accelerations, multipliers and forces of contacts.
    pub load: Expr<'d>,
    /// `ρ(q, t)`, the coefficients of the accelerations.
    pub by_accelerations: Vec<Expr<'d>>,
    /// `χ(q, t)`, the coefficients of the multipliers of the constraints.
    pub by_multipliers: Vec<Expr<'d>>,
    /// `κ(q, t)`, the coefficients of the forces along the normal and the tangent of each contact, guides included.
    pub by_forces: Vec<Expr<'d>>,
}

impl<'d> GuideEquation<'d> {
    /// The coefficients, in the order in which a program states them.
    pub fn coefficients(&self) -> impl Iterator<Item = Expr<'d>> {
        let lists = [
            &self.by_accelerations,
            &self.by_multipliers,
            &self.by_forces,
        ];
        lists.into_iter().flatten().copied()
    }
}

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
    for guide in &guides {
        let Some(reaction) = guide.reactions.first() else {
            continue;
        };
        let by_guides = (reaction.by_friction_forces.iter()).flat_map(|by| [zero, *by]);
        equations.guides.push(GuideEquation {
            load: reaction.load,
            by_accelerations: reaction.by_accelerations.clone(),
            by_multipliers: reaction.by_multipliers.clone(),
            by_forces: (reaction.by_contact_forces.iter().copied())
                .chain(by_guides)
                .collect(),
        });
    }
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
