//! Drafts of functions, and the choice among them.

use super::{Lowering, LoweringInput};
use crate::lower::accelerations::{derivatives, multipliers};
use crate::lower::{stages, states};
use lagrangian_program::choose::{Basis, Candidate, Choice, Form};
use lagrangian_program::graph::{Graph, Id, Scaled};
use lagrangian_program::net::Net;
use lagrangian_program::rounding::States;
use lagrangian_program::schedule::{Code, LARGEST_FACTORED, schedule};
use lagrangian_program::solve::Pivot;
use lagrangian_program::{
    EliminationStep, Function, Guard, Role, Rounding, Shape, rounding, solve,
};
use lagrangian_spec::model::{Model, Stages, Variable};

/// The functions of a program, each in the form that was chosen.
pub(super) struct ChosenFunctions<'c> {
    pub choose: &'c dyn Fn(&[Candidate]) -> usize,
    /// The states at which the effect of round-off on candidates is estimated.
    pub states: States,
    pub drafts: Vec<Draft>,
    pub choices: Vec<Choice>,
}

/// What a program has of what a spec requests.
pub(super) struct Granted {
    pub stages: Stages,
    pub derivatives: Vec<Variable>,
}

impl<'c> ChosenFunctions<'c> {
    pub fn new(model: &Model<'_>, choose: &'c dyn Fn(&[Candidate]) -> usize) -> Self {
        ChosenFunctions {
            choose,
            states: states::around_start(model, 1, rounding::STATES),
            drafts: Vec::new(),
            choices: Vec::new(),
        }
    }

    /// Chooses one of the drafts of a function; without drafts there is no function.
    pub fn take(&mut self, candidates: Vec<Draft>, graph: &Graph) {
        let (draft, choice) = chosen_draft(candidates, graph, &self.states, self.choose);
        self.choices.extend(choice);
        self.drafts.extend(draft);
    }

    /// Adds the functions that are made from the accelerations, which were taken last: the accelerations in stages, their
    /// derivatives, and the multipliers.
    pub fn add_functions_of_accelerations<'d>(
        &mut self,
        lowering: &mut Lowering<'_, 'd>,
        source: LoweringInput<'_, 'd>,
    ) -> Granted {
        let mut granted = Granted {
            stages: Stages::default(),
            derivatives: Vec::new(),
        };
        let last = self.drafts.last();
        let Some(at_once) = last.filter(|last| last.form.role == Role::Accelerations) else {
            return granted;
        };
        let model = lowering.model;
        let (staged, staged_choice) = if model.stages.is_empty() {
            (Vec::new(), None)
        } else {
            stages::staged(lowering, source, at_once, &self.states, self.choose)
        };
        if !staged.is_empty() {
            granted.stages = model.stages;
        }
        let derivatives = derivatives(lowering, source, at_once);
        if derivatives.is_some() {
            granted.derivatives.clone_from(&model.derivatives);
        }
        let multipliers = if lowering.constraints == 0 {
            Vec::new()
        } else {
            multipliers(lowering, source, at_once)
        };
        self.take(multipliers, &lowering.graph);
        self.drafts.extend(derivatives);
        self.drafts.extend(staged);
        self.choices.extend(staged_choice);
        granted
    }

    /// The functions and the choices in the order of roles.
    pub fn in_order(mut self) -> (Vec<Draft>, Vec<Choice>) {
        self.drafts.sort_by_key(|draft| draft.function.role);
        self.choices.sort_by_key(Choice::role);
        (self.drafts, self.choices)
    }
}

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
