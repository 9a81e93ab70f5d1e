//! Checks the invariants of a program that its module lists. A program that fails reveals a bug of the compiler.

use rustc_hash::FxHashSet;

use super::quantity::Argument;
use super::{Function, Op, Program, Role, Source, Value};

impl Program {
    /// Checks the invariants of the [module](super), and returns the first violation.
    pub fn verify(&self) -> Result<(), String> {
        if self.prepare.role != Role::Prepare || self.start.role != Role::Start {
            return Err("prepare and start are not where they belong".into());
        }
        if self.prepared.len() != self.prepare.results.len() {
            return Err("not every prepared value has its formula".into());
        }
        if !self.functions.is_sorted_by(|a, b| a.role < b.role) {
            return Err("functions are out of order".into());
        }
        for role in [Role::AtTime, Role::AtPosition, Role::AccelerationsAt] {
            if self.function(role).is_some() != self.staged_roles().contains(&role) {
                return Err("stages are not those that are asked for".into());
            }
        }
        for function in self.all_functions() {
            self.verify_function(function)
                .map_err(|what| format!("{}: {what}", function.role.name()))?;
        }
        Ok(())
    }

    fn verify_function(&self, function: &Function) -> Result<(), String> {
        let Function {
            code,
            shape,
            results,
            guards,
            ..
        } = function;
        if shape.len() != results.len() {
            return Err(format!("{shape:?} has {} results", results.len()));
        }
        let is_missing = |(value, _): &&(Value, _)| value.index() >= code.len();
        if let Some((value, step)) = function.steps.iter().find(is_missing) {
            return Err(format!("{step:?} is {value:?}, which does not exist"));
        }
        let roots = || {
            results
                .iter()
                .copied()
                .chain(guards.iter().flat_map(|guard| [guard.pivot, guard.scale]))
        };
        if let Some(value) = roots().find(|value| value.index() >= code.len()) {
            return Err(format!("{value:?} does not exist"));
        }
        let mut used = vec![false; code.len()];
        roots().for_each(|value| used[value.index()] = true);
        let mut seen = FxHashSet::default();
        for (index, op) in code.iter().enumerate().rev() {
            if let Some(operand) = op.operands().find(|operand| operand.index() >= index) {
                return Err(format!("{op:?} at {index} reads {operand:?}"));
            }
            if !used[index] {
                return Err(format!("{op:?} at {index} is of no use"));
            }
            op.operands()
                .for_each(|operand| used[operand.index()] = true);
            if !seen.insert(op) {
                return Err(format!("{op:?} at {index} is there twice"));
            }
            if let Op::Read(source) = op {
                self.verify_read(function.role, *source)?;
            }
        }
        if !matches!(function.role, Role::Prepare | Role::Start) {
            check_prepared_operations(code)?;
        }
        match guards
            .iter()
            .find(|guard| guard.coordinate >= self.dimension() + self.constraints.len())
        {
            Some(guard) => Err(format!("{guard:?} is of no coordinate and no constraint")),
            None => Ok(()),
        }
    }

    fn verify_read(&self, role: Role, source: Source) -> Result<(), String> {
        let parameters_only = matches!(role, Role::Prepare | Role::Start);
        let n = self.dimension();
        let argument = match source {
            Source::Time => Some(Argument::Time),
            Source::Coordinate(_) => Some(Argument::Coordinates),
            Source::Velocity(_) => Some(Argument::Velocities),
            Source::Acceleration(_) => Some(Argument::Accelerations),
            Source::Input(_) => Some(Argument::Inputs),
            Source::Parameter(_)
            | Source::Prepared(_)
            | Source::AtTime(_)
            | Source::AtPosition(_) => None,
        };
        if argument.is_some_and(|argument| !role.row().of.contains(&argument)) {
            return Err(format!("{source:?} is nothing that it may depend on"));
        }
        // The results of a stage are read by the next one only.
        let roles = self.staged_roles();
        let next = |before| {
            let mut pairs = roles.windows(2);
            pairs.any(|pair| pair[0] == before && pair[1] == role)
        };
        let left = |before| match self.function(before) {
            Some(function) if next(before) => function.results.len(),
            _ => 0,
        };
        let (index, len, is_parameter) = match source {
            Source::Parameter(index) => (index, self.parameters.len(), true),
            Source::Prepared(index) => (index, self.prepare.results.len(), false),
            Source::Time => (0, 1, false),
            Source::Coordinate(index) | Source::Velocity(index) | Source::Acceleration(index) => {
                (index, n, false)
            }
            Source::Input(index) => (index, self.inputs.len(), false),
            Source::AtTime(index) => (index, left(Role::AtTime), false),
            Source::AtPosition(index) => (index, left(Role::AtPosition), false),
        };
        if index as usize >= len || is_parameter != parameters_only {
            return Err(format!("{source:?} cannot be read here"));
        }
        Ok(())
    }
}

/// Checks that no operation has only constants and prepared values as operands. The sign for the
/// error of a rounded difference is exempt: it costs less than one more prepared value.
pub(crate) fn check_prepared_operations(code: &[Op]) -> Result<(), String> {
    let known = |value: Value| {
        matches!(
            code[value.index()],
            Op::Constant(_) | Op::Pi | Op::Read(Source::Prepared(_))
        )
    };
    let is_sign = |op: &Op| matches!(op, Op::Neg(a) if !matches!(code[a.index()], Op::Constant(_)));
    let idle =
        |op: &&Op| op.operands().next().is_some() && op.operands().all(known) && !is_sign(op);
    match code.iter().find(idle) {
        Some(op) => Err(format!("{op:?} could have been prepared")),
        None => Ok(()),
    }
}
