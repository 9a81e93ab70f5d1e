//! Drafts of a function, and the choice among them.

use lagrangian_program::choose::{Basis, Candidate, Choice, Form};
use lagrangian_program::graph::{Graph, Id, Scaled};
use lagrangian_program::net::Net;
use lagrangian_program::rounding::States;
use lagrangian_program::schedule::{Code, LARGEST_FACTORED, schedule};
use lagrangian_program::solve::Pivot;
use lagrangian_program::{EliminationStep, Function, Guard, Role, Rounding, Shape, solve};

/// A function before its code is written.
pub(super) struct PlannedFunction {
    pub role: Role,
    pub shape: Shape,
    pub results: Vec<Scaled>,
    pub pivots: Vec<Pivot>,
    /// The number of rows of the system that the pivots belong to.
    pub rows: usize,
    /// The steps of the elimination that finds the results.
    pub steps: Vec<(Scaled, EliminationStep)>,
}

/// A candidate form of a function, before one of them is chosen.
pub(super) struct Draft {
    pub form: Form,
    pub function: Function,
    /// The nodes that its `Read(Prepared(k))` refer to.
    pub prepared: Vec<Id>,
    /// Pivots that depend on parameters alone.
    pub known_pivots: Vec<Pivot>,
}

impl Draft {
    pub fn is_same(&self, other: &Draft) -> bool {
        let [a, b] = [&self.function, &other.function];
        let is_same = a.code == b.code && a.results == b.results && a.guards == b.guards;
        is_same && self.prepared == other.prepared
    }
}

impl PlannedFunction {
    /// The function in its alternative forms: with common pairs shared, and with factors taken out
    /// of sums before that.
    pub fn drafts(self, graph: &mut Graph, basis: Basis) -> Vec<Draft> {
        let net = self.net(graph, true);
        let mut factored = net.clone();
        let has_factors = net.size() <= LARGEST_FACTORED && factored.factor();
        let mut drafts = vec![self.draft(Some(graph), net, basis, false)];
        if has_factors {
            drafts.push(self.draft(Some(graph), factored, basis, true));
        }
        drafts
    }

    /// The function in its only form, for functions of parameters.
    pub fn only(self, graph: &mut Graph) -> Draft {
        let net = self.net(graph, false);
        self.draft(None, net, Basis::Derived, false)
    }

    pub fn net(&self, graph: &mut Graph, cut: bool) -> Net {
        let guarded = self.pivots.iter().flat_map(|p| [p.pivot, p.scale]);
        let values: Vec<Scaled> = self.results.iter().copied().chain(guarded).collect();
        Net::of_elimination(graph, &values, &self.steps, cut)
    }

    /// The function of a net. If the graph is given, values that depend on parameters alone are prepared.
    pub fn draft(
        &self,
        graph: Option<&mut Graph>,
        mut net: Net,
        basis: Basis,
        factored: bool,
    ) -> Draft {
        net.share_pairs();
        let Code {
            code,
            roots,
            prepared,
            steps,
        } = schedule(&net, graph);
        let (results, guarded) = roots.split_at(self.results.len());
        let guards = self
            .pivots
            .iter()
            .zip(guarded.chunks_exact(2))
            .map(|(p, values)| Guard {
                pivot: values[0],
                scale: values[1],
                tolerance: solve::pivot_tolerance(self.rows),
                coordinate: p.coordinate,
            })
            .collect();
        Draft {
            form: Form {
                role: self.role,
                basis,
                reduced: false,
                factored,
            },
            function: Function {
                role: self.role,
                code,
                shape: self.shape,
                results: results.to_vec(),
                guards,
                steps,
            },
            prepared,
            known_pivots: Vec::new(),
        }
    }
}

/// The draft that is chosen, and the record of the choice if there was one.
pub(super) fn chosen_draft(
    mut drafts: Vec<Draft>,
    graph: &Graph,
    states: &States,
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> (Option<Draft>, Option<Choice>) {
    let mut different: Vec<Draft> = Vec::with_capacity(drafts.len());
    for draft in drafts.drain(..) {
        if !different.iter().any(|other| draft.is_same(other)) {
            different.push(draft);
        }
    }
    if different.len() < 2 {
        return (different.pop(), None);
    }
    let roundings = roundings(&different.iter().collect::<Vec<_>>(), graph, states);
    let candidate = |(index, draft): (usize, &Draft)| Candidate {
        form: draft.form,
        counts: draft.function.counts(),
        cost: draft.function.cost(),
        rounding: roundings.as_ref().map(|roundings| roundings[index]),
    };
    let candidates: Vec<Candidate> = different.iter().enumerate().map(candidate).collect();
    let chosen = choose(&candidates).min(candidates.len() - 1);
    let draft = different.swap_remove(chosen);
    (Some(draft), Some(Choice { candidates, chosen }))
}

/// The effect of round-off on the results of each draft, including the values prepared for it.
pub(super) fn roundings(
    drafts: &[&Draft],
    graph: &Graph,
    states: &States,
) -> Option<Vec<Rounding>> {
    let all = drafts.iter().flat_map(|draft| draft.prepared.iter());
    let mut ids: Vec<Id> = all.copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let roots: Vec<(Id, bool)> = ids.iter().map(|&id| (id, false)).collect();
    let Code { code, roots, .. } = schedule(&Net::new(graph, &roots, false), None);
    let prepare = Function {
        role: Role::Prepare,
        code,
        shape: Shape::Vector(roots.len()),
        results: roots,
        guards: Vec::new(),
        steps: Vec::new(),
    };
    let reading = drafts.iter().map(|draft| {
        let place = |id: &Id| ids.binary_search(id).unwrap_or(0);
        let prepared = draft.prepared.iter().map(place).collect();
        (&draft.function, prepared)
    });
    let functions: Vec<(&Function, Vec<usize>)> = reading.collect();
    states.roundings(&prepare, &functions)
}
