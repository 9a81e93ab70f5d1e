//! The effect of the friction forces of the contacts, eqs. (E32)–(E34): `M a = f + Gᵀλ + Σ τᵀF`.
//!
//! The friction forces themselves are not computed here, since they depend on what sticks and what
//! slides. But everything is linear in them. So the elimination of `M` takes one more column for
//! each contact, and a caller that knows the state of the contacts is left with a system of as many
//! equations as contacts: `M + D(sign)`, eliminated as far as it is independent of signs, without a
//! pivot that depends on one.

use crate::SlidingEquation;
use crate::lower::choosing::{Draft, PlannedFunction};
use crate::lower::derivatives::{Solved, inverses, of_elimination, solve_by_steps};
use crate::lower::{Lowering, LoweringInput};
use lagrangian_program::graph::{Graph, Scaled};
use lagrangian_program::solve::{self, Elimination};
use lagrangian_program::{Basis, EliminationStep, FrictionLayout, FrictionPart, Role, Shape};

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
        // With friction forces, the accelerations are others.
        let mut steps = solved.labels;
        steps.retain(|(_, step)| !matches!(step, EliminationStep::Solution(_)));
        let planned = PlannedFunction {
            role: Role::Friction,
            shape: Shape::Vector(layout.len()),
            results,
            pivots,
            rows: system.forces.len(),
            steps,
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
    let alone = (solved.accelerations.clone(), solved.multipliers.clone());
    let starts = Starts {
        slip_rate: &|contact| contact.bias,
        reaction: &|component| component.load,
    };
    let mut parts = vec![part(graph, contacts, alone, starts)];
    for (k, contact) in contacts.iter().enumerate() {
        let mut right = contact.row.clone();
        right.resize(layout.coordinates + layout.constraints, Scaled::ZERO);
        let mut accelerations = solve_by_steps(graph, solved, &inverses, right);
        let multipliers = accelerations.split_off(layout.coordinates);
        // The system is symmetric in a and −λ.
        let multipliers = multipliers.into_iter().map(Scaled::negated).collect();
        let starts = Starts {
            slip_rate: &|_| Scaled::ZERO,
            reaction: &|component| component.by_friction_forces[k],
        };
        parts.push(part(graph, contacts, (accelerations, multipliers), starts));
    }
    let each = |of: fn(&Contact) -> Scaled| contacts.iter().map(of).collect();
    let coefficients = [each(|one| one.friction), each(|one| one.static_friction)];
    let directions = contacts.iter().flat_map(|one| &one.reference_direction);
    let directions = directions.copied().collect();
    FrictionLayout::arrange(parts, coefficients, directions).collect()
}

/// The values that accelerations and multipliers of 0 leave.
struct Starts<'s> {
    slip_rate: &'s dyn Fn(&Contact) -> Scaled,
    reaction: &'s dyn Fn(&Component) -> Scaled,
}

/// A part of the response: these accelerations and multipliers, and the slip rates and reactions that follow from them.
fn part(
    graph: &mut Graph,
    contacts: &[Contact],
    (accelerations, multipliers): (Vec<Scaled>, Vec<Scaled>),
    starts: Starts<'_>,
) -> FrictionPart<Vec<Scaled>> {
    let mut combine = |start: Scaled, pairs: [(&[Scaled], &[Scaled]); 2]| {
        let mut terms = vec![start];
        for (coefficients, values) in pairs {
            let products = coefficients.iter().zip(values);
            terms.extend(products.map(|(&c, &x)| graph.product(&[(c, 1), (x, 1)])));
        }
        let sum = graph.sum(&terms);
        graph.opaque(sum)
    };
    let mut slip_rates = Vec::with_capacity(contacts.len());
    for contact in contacts {
        let by = [(&contact.row[..], &accelerations[..]), (&[], &[])];
        slip_rates.push(combine((starts.slip_rate)(contact), by));
    }
    let mut normals = Vec::new();
    for component in contacts.iter().flat_map(|contact| &contact.reactions) {
        let by = [
            (&component.by_accelerations[..], &accelerations[..]),
            (&component.by_multipliers[..], &multipliers[..]),
        ];
        normals.push(combine((starts.reaction)(component), by));
    }
    FrictionPart {
        accelerations,
        multipliers,
        slip_rates,
        normals,
    }
}
