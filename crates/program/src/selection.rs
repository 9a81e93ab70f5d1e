//! Programs of some functions of a program.

use super::{Function, Op, Program, Role, Shape, Source, Value};
use lagrangian_units::Stages;

impl Program {
    /// This machine with the given functions, in addition to [`prepare`](Program::prepare) and
    /// [`start`](Program::start), and with only the prepared values that these read.
    ///
    /// A mass matrix of n coordinates has n² prepared values; accelerations that are eliminated
    /// along a chain read a few for each link.
    pub fn with_only(&self, roles: &[Role]) -> Program {
        let mut functions: Vec<Function> = self.functions.clone();
        functions.retain(|function| roles.contains(&function.role));
        let mut choices = self.choices.clone();
        choices.retain(|choice| roles.contains(&choice.role()));
        let mut selected = Program {
            functions,
            choices,
            stages: Stages::default(),
            ..self.clone()
        };
        selected.keep_read_slots();
        selected
    }

    /// Drops the prepared values that no function reads.
    pub(super) fn keep_read_slots(&mut self) {
        let mut slots: Vec<Option<u32>> = vec![None; self.prepare.results.len()];
        for op in self.functions.iter().flat_map(|function| &function.code) {
            if let Op::Read(Source::Prepared(slot)) = op {
                slots[*slot as usize] = Some(0);
            }
        }
        let kept = slots.iter_mut().filter_map(Option::as_mut);
        kept.zip(0..).for_each(|(slot, number)| *slot = number);
        let functions = self.functions.iter_mut();
        for op in functions.flat_map(|function| &mut function.code) {
            if let Op::Read(Source::Prepared(slot)) = op {
                *slot = slots[*slot as usize].expect("what is read is kept");
            }
        }
        let is_kept = |slot: usize| slots[slot].is_some();
        let results = self.prepare.results.iter().enumerate();
        let results = results.filter(|(slot, _)| is_kept(*slot));
        let results: Vec<Value> = results.map(|(_, value)| *value).collect();
        let formulas = std::mem::take(&mut self.prepared).into_iter().enumerate();
        let formulas = formulas.filter(|(slot, _)| is_kept(*slot));
        self.prepared = formulas.map(|(_, formula)| formula).collect();
        self.prepare = without_unused(Function {
            shape: Shape::Vector(results.len()),
            results,
            ..self.prepare.clone()
        });
    }
}

impl Program {
    /// This machine with some of the functions, in addition to [`prepare`](Program::prepare) and
    /// [`start`](Program::start), and with all prepared values.
    pub fn with_functions(&self, is_kept: impl Fn(Role) -> bool) -> Program {
        let functions = self.functions.iter().filter(|f| is_kept(f.role));
        Program {
            name: self.name.clone(),
            docs: String::new(),
            parameters: self.parameters.clone(),
            coordinates: self.coordinates.clone(),
            quaternions: self.quaternions.clone(),
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            assumptions: self.assumptions.clone(),
            constraints: self.constraints.clone(),
            contacts: self.contacts.clone(),
            reaction_axes: self.reaction_axes,
            second_tangents: self.second_tangents,
            unilateral: self.unilateral.clone(),
            kept: self.kept.clone(),
            derivatives: self.derivatives.clone(),
            stages: self.stages,
            prepare: self.prepare.clone(),
            prepared: self.prepared.clone(),
            start: self.start.clone(),
            functions: functions.cloned().collect(),
            choices: Vec::new(),
        }
    }
}

/// A function with only the operations that a result or a guard needs.
pub(super) fn without_unused(function: Function) -> Function {
    let Function {
        code,
        mut results,
        mut guards,
        mut steps,
        role,
        shape,
    } = function;
    let mut is_used = vec![false; code.len()];
    let guarded = guards.iter().flat_map(|guard| [guard.pivot, guard.scale]);
    for value in results.iter().copied().chain(guarded) {
        is_used[value.index()] = true;
    }
    for (index, op) in code.iter().enumerate().rev() {
        if is_used[index] {
            op.operands()
                .for_each(|operand| is_used[operand.index()] = true);
        }
    }
    let mut place = vec![Value(0); code.len()];
    let mut left: Vec<Op> = Vec::new();
    for (index, op) in code.iter().enumerate().filter(|(index, _)| is_used[*index]) {
        place[index] = Value(left.len() as u32);
        left.push(op.with_operands(|operand| place[operand.index()]));
    }
    for value in &mut results {
        *value = place[value.index()];
    }
    for guard in &mut guards {
        guard.pivot = place[guard.pivot.index()];
        guard.scale = place[guard.scale.index()];
    }
    steps.retain(|(value, _)| is_used[value.index()]);
    for (value, _) in &mut steps {
        *value = place[value.index()];
    }
    steps.sort_unstable();
    steps.dedup();
    Function {
        role,
        shape,
        code: left,
        results,
        guards,
        steps,
    }
}
