//! The effect of the friction forces of the contacts, eqs. (E32)–(E34): `M a = f + Gᵀλ + Σ τᵀF`.
//!
//! The friction forces themselves are not computed here, since they depend on what sticks and what
//! slides. But everything is linear in them. So the elimination of `M` takes one more column for
//! each contact, and a caller that knows the state of the contacts is left with a system of as many
//! equations as contacts: `M + D(sign)`, eliminated as far as it is independent of signs, without a
//! pivot that depends on one.

use crate::SlidingEquation;
use crate::lower::derivatives::{Solved, inverses, of_elimination, solve_by_steps};
use crate::lower::{Draft, Lowering, LoweringInput, PlannedFunction};
use lagrangian_program::graph::{Graph, Scaled};
use lagrangian_program::solve::{self, Elimination};
use lagrangian_program::{Basis, FrictionLayout, Role, Shape};

/// The drafts for [`Role::Friction`], from the equations as derived and multiplied out.
pub(super) fn friction<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
) -> Vec<Draft> {
    let contacts: Vec<Contact> = source
        .sliding
        .iter()
        .map(|sliding| Contact::of(lowering, sliding))
        .collect();
    let mut drafts = Vec::new();
    let mut before = None;
    for (basis, quantities) in [
        (Basis::Derived, source.quantities),
        (Basis::Expanded, source.expanded),
    ] {
        let Some(system) = lowering.system(quantities, source.quantities) else {
            continue;
        };
        if before.as_ref() == Some(&system) {
            continue;
        }
        let elimination = Elimination::of(&lowering.graph, &system);
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        let solved = of_elimination(solution, &system);
        let layout = FrictionLayout {
            coordinates: system.coordinates,
            constraints: system.forces.len() - system.coordinates,
            contacts: contacts.len(),
            axes: lowering.model.space.reaction_axes(),
        };
        let results = results(&mut lowering.graph, layout, &solved, &contacts);
        let known = |pivot: &solve::Pivot| pivot.pivot.is_known() && pivot.scale.is_known();
        let (known_pivots, pivots): (Vec<_>, Vec<_>) = solved.pivots.into_iter().partition(known);
        let planned = PlannedFunction {
            role: Role::Friction,
            shape: Shape::Vector(layout.len()),
            results,
            pivots,
            rows: system.forces.len(),
        };
        for mut draft in planned.drafts(&mut lowering.graph, basis) {
            draft.known_pivots.clone_from(&known_pivots);
            drafts.push(draft);
        }
        before = Some(system);
    }
    drafts
}

/// The nodes of a contact.
struct Contact {
    row: Vec<Scaled>,
    bias: Scaled,
    reactions: Vec<Component>,
    friction: Scaled,
    static_friction: Scaled,
    /// In space the unit vector that determines the pressing part of the reaction.
    reference_direction: Vec<Scaled>,
}

/// A component of the reaction of a contact.
struct Component {
    load: Scaled,
    by_accelerations: Vec<Scaled>,
    by_multipliers: Vec<Scaled>,
    by_friction_forces: Vec<Scaled>,
}

impl Contact {
    fn of<'d>(lowering: &mut Lowering<'_, 'd>, sliding: &SlidingEquation<'d>) -> Contact {
        let mut many = |expressions: &[_]| {
            lowering.lower(expressions);
            lowering.values(expressions)
        };
        let telling = match sliding.reactions.len() {
            1 => Vec::new(),
            _ => many(&sliding.reference_direction()),
        };
        let mut one = |expression| many(&[expression])[0];
        Contact {
            bias: one(sliding.bias),
            friction: one(sliding.friction),
            static_friction: one(sliding.static_friction),
            reference_direction: telling,
            row: many(&sliding.row),
            reactions: sliding
                .reactions
                .iter()
                .map(|reaction| Component {
                    load: many(&[reaction.load])[0],
                    by_accelerations: many(&reaction.by_accelerations),
                    by_multipliers: many(&reaction.by_multipliers),
                    by_friction_forces: many(&reaction.by_friction_forces),
                })
                .collect(),
        }
    }
}

/// All results, part by part.
fn results(
    graph: &mut Graph,
    layout: FrictionLayout,
    solved: &Solved,
    contacts: &[Contact],
) -> Vec<Scaled> {
    let inverses = inverses(graph, solved);
    let mut all = Vec::with_capacity(layout.len());
    for part in 0..=contacts.len() {
        let (accelerations, multipliers) = match part.checked_sub(1) {
            None => (solved.accelerations.clone(), solved.multipliers.clone()),
            Some(k) => {
                let mut right = contacts[k].row.clone();
                right.resize(layout.coordinates + layout.constraints, Scaled::ZERO);
                let mut answers = solve_by_steps(graph, solved, &inverses, right);
                let multipliers = answers.split_off(layout.coordinates);
                // The system is symmetric in a and −λ.
                let multipliers = multipliers.into_iter().map(Scaled::negated);
                (answers, multipliers.collect())
            }
        };
        let mut combine = |start: Scaled, pairs: [(&[Scaled], &[Scaled]); 2]| {
            let mut terms = vec![start];
            for (coefficients, values) in pairs {
                let products = coefficients.iter().zip(values);
                terms.extend(products.map(|(&c, &x)| graph.product(&[(c, 1), (x, 1)])));
            }
            let sum = graph.sum(&terms);
            graph.opaque(sum)
        };
        let slips: Vec<Scaled> = contacts
            .iter()
            .map(|contact| {
                let start = if part == 0 {
                    contact.bias
                } else {
                    Scaled::ZERO
                };
                combine(start, [(&contact.row, &accelerations), (&[], &[])])
            })
            .collect();
        let reactions = contacts.iter().flat_map(|contact| &contact.reactions);
        let normals: Vec<Scaled> = reactions
            .map(|reaction| {
                let start = match part.checked_sub(1) {
                    None => reaction.load,
                    Some(k) => reaction.by_friction_forces[k],
                };
                let by = [
                    (
                        reaction.by_accelerations.as_slice(),
                        accelerations.as_slice(),
                    ),
                    (reaction.by_multipliers.as_slice(), multipliers.as_slice()),
                ];
                combine(start, by)
            })
            .collect();
        all.extend(accelerations);
        all.extend(multipliers);
        all.extend(slips);
        all.extend(normals);
    }
    all.extend(contacts.iter().map(|contact| contact.friction));
    all.extend(contacts.iter().map(|contact| contact.static_friction));
    if layout.axes != 1 {
        all.extend(
            contacts
                .iter()
                .flat_map(|contact| &contact.reference_direction),
        );
    }
    all
}
