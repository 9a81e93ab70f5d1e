//! The functions of a program that were chosen among drafts, and those that follow from the accelerations chosen.

use super::{Lowering, LoweringInput};
use crate::lower::accelerations::{derivatives, multipliers};
use crate::lower::choosing::{Draft, chosen_draft};
use crate::lower::projection::projection;
use crate::lower::stages;
use crate::states;
use lagrangian_program::choose::{Candidate, Choice};
use lagrangian_program::graph::Graph;
use lagrangian_program::rounding::States;
use lagrangian_program::{Role, rounding};
use lagrangian_spec::model::{Model, Stages, Variable};
use lagrangian_symbolic::sorting::sort_by_key;

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
    /// derivatives, the multipliers, and the projection onto the constraints.
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
        let projection = if lowering.constraints > 0 && model.projects && model.contacts.is_empty()
        {
            projection(lowering, source, at_once)
        } else {
            Vec::new()
        };
        self.take(multipliers, &lowering.graph);
        self.take(projection, &lowering.graph);
        self.drafts.extend(derivatives);
        self.drafts.extend(staged);
        self.choices.extend(staged_choice);
        granted
    }

    /// The functions and the choices in the order of roles.
    pub fn in_order(mut self) -> (Vec<Draft>, Vec<Choice>) {
        sort_by_key(&mut self.drafts, |draft| draft.function.role);
        sort_by_key(&mut self.choices, Choice::role);
        (self.drafts, self.choices)
    }
}
