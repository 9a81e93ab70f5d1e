//! The dependencies of computed variables, from what the program reads: a result that does not read a number does not depend on it.

use std::collections::BTreeSet;

use lagrangian_program::{Function, Op, Program, Role, Source, Value};

use super::Unit;
use super::variables::{VariableKind, Variables};

/// The dependencies of the functions of a machine.
pub struct Dependencies<'a> {
    program: &'a Program,
    variables: &'a Variables,
    /// For each prepared value the parameters on which it depends.
    prepared: Vec<BTreeSet<Source>>,
    /// For each acceleration its dependencies.
    accelerations: Vec<BTreeSet<Source>>,
    /// The number of outputs before the formulas of events.
    shown: usize,
}

impl<'a> Dependencies<'a> {
    /// Analyses the machine of a unit.
    pub fn new(unit: &'a Unit<'_>) -> Dependencies<'a> {
        let program = unit.program;
        let mut dependencies = Dependencies {
            program,
            variables: &unit.variables,
            prepared: reads(&program.prepare),
            accelerations: Vec::new(),
            shown: program.outputs.len() - unit.events.len(),
        };
        let accelerations = dependencies.results(Role::Accelerations);
        dependencies.accelerations = accelerations;
        dependencies
    }

    /// The references of the variables on which a variable depends, with the kind of dependency; with `at_start` the
    /// dependencies at initialization, which include parameters.
    pub fn of(&self, reference: usize, at_start: bool) -> Vec<(usize, &'static str)> {
        let n = self.program.dimension();
        let kind = self.variables.all[reference].kind;
        // A rate is the derivative of its coordinate, and itself a state.
        let state = match kind {
            VariableKind::Coordinate(i) => Some(1 + i),
            VariableKind::Rate(i) => Some(1 + n + i),
            _ => None,
        };
        if let Some(state) = state {
            return vec![(state, "constant")];
        }
        let result_of = |role| self.results(role).into_iter().next().unwrap_or_default();
        let sources = match kind {
            VariableKind::Acceleration(i) => self.accelerations.get(i).cloned().unwrap_or_default(),
            VariableKind::Output(i) => result_of(Role::Output(i)),
            VariableKind::Multiplier(i) => {
                let all = self.results(Role::Multipliers);
                all.into_iter().nth(i).unwrap_or_default()
            }
            // Of runs, which have no lists of dependencies.
            VariableKind::OfContact(..) => BTreeSet::new(),
            VariableKind::KineticEnergy => result_of(Role::KineticEnergy),
            VariableKind::PotentialEnergy => result_of(Role::PotentialEnergy),
            VariableKind::Fact(i) => result_of(Role::Assumption(i)),
            VariableKind::Event(i) => result_of(Role::Output(self.shown + i)),
            // A count does not change while other variables change.
            VariableKind::Count(_)
            | VariableKind::Time
            | VariableKind::Parameter(_)
            | VariableKind::Input(_)
            | VariableKind::Coordinate(_)
            | VariableKind::Rate(_) => BTreeSet::new(),
        };
        let references = sources.into_iter().filter_map(|source| {
            let parameters = 1 + 3 * n;
            Some(match source {
                Source::Time => 0,
                Source::Coordinate(i) => 1 + i as usize,
                Source::Velocity(i) => 1 + n + i as usize,
                Source::Parameter(i) if at_start => parameters + i as usize,
                Source::Input(i) => parameters + self.program.parameters.len() + i as usize,
                _ => return None,
            })
        });
        let references: BTreeSet<usize> = references.collect();
        references.into_iter().map(|k| (k, "dependent")).collect()
    }

    /// For each result of a function its dependencies, where accelerations and prepared values are replaced by their own.
    fn results(&self, role: Role) -> Vec<BTreeSet<Source>> {
        let Some(function) = self.program.function(role) else {
            return Vec::new();
        };
        let resolved = |sources: BTreeSet<Source>| -> BTreeSet<Source> {
            let mut all = BTreeSet::new();
            for source in sources {
                match source {
                    Source::Prepared(i) => {
                        all.extend(self.prepared.get(i as usize).into_iter().flatten())
                    }
                    Source::Acceleration(i) => {
                        all.extend(self.accelerations.get(i as usize).into_iter().flatten());
                    }
                    source => all.extend([source]),
                }
            }
            all
        };
        reads(function).into_iter().map(resolved).collect()
    }
}

/// For each result of a function the arguments that it reads.
fn reads(function: &Function) -> Vec<BTreeSet<Source>> {
    let of = |result: &Value| {
        let mut is_needed = vec![false; result.index() + 1];
        is_needed[result.index()] = true;
        let mut sources = BTreeSet::new();
        for index in (0..=result.index()).rev() {
            if !is_needed[index] {
                continue;
            }
            match &function.code[index] {
                Op::Read(source) => sources.extend([*source]),
                op => op.operands().for_each(|x| is_needed[x.index()] = true),
            }
        }
        sources
    };
    function.results.iter().map(of).collect()
}
