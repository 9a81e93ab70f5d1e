//! The numbers of single contacts, by parts of the functions that compute those of all.
//!
//! A run with many contacts needs the numbers of a few at a time: those of the closed contacts at each stage of a step, and those of
//! the near ones at each sample within it. The part of a contact consists of the operations on which its numbers depend, so that it gives the same
//! bits. Contacts of the same kind, such as the pairs of a pile of discs, have the same operations on different arguments: one function
//! with a list of arguments for each contact serves all of them, and is compiled once.

use lagrangian_symbolic::Rational;
use lagrangian_units::Stages;
use rustc_hash::FxHashMap;

use super::{Function, Op, Program, Role, Shape, Slot, Source, Value};

/// The fewest unilateral contacts of a machine that has parts. The functions for all contacts of a smaller one cost no more than
/// the calls of its parts.
pub const FEWEST: usize = 16;

/// The quantities of contacts, in the order of [`ContactParts::part`].
pub const QUANTITIES: [Role; 6] = [
    Role::Gaps,
    Role::ContactRates,
    Role::ContactMatrix,
    Role::ContactBias,
    Role::ContactCoefficients,
    Role::ContactFaces,
];

/// The parts of all contacts of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactParts {
    /// The functions, each a [`Role::ContactPart`]. They read nothing but the time and coordinates, which here are the arguments of a part:
    /// as many as the longest list has. There are no parameters and no prepared values.
    pub program: Program,
    parts: [Vec<ContactPart>; QUANTITIES.len()],
    gap_arguments: Vec<bool>,
}

/// How a quantity of a contact is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactPart {
    /// The index of its function, [`Role::ContactPart`]; `None` if all its numbers are 0.
    pub function: Option<usize>,
    /// The arguments of this contact.
    pub arguments: Vec<Source>,
    /// Where the results stand among its numbers. The others are 0.
    pub places: Vec<u32>,
}

impl ContactParts {
    /// The parts of the contacts of a machine, if it has [many](FEWEST).
    pub fn of(program: &Program) -> Option<ContactParts> {
        if program.unilateral.len() < FEWEST {
            return None;
        }
        let mut functions = Functions::default();
        let parts = QUANTITIES.map(|role| parts_of(program, role, &mut functions));
        let all = parts.iter().flatten();
        let longest = all.map(|part| part.arguments.len()).max().unwrap_or(0);
        let parts = ContactParts {
            gap_arguments: gap_arguments(program),
            program: program_of(program, functions.all, longest),
            parts,
        };
        // Without parts all contacts are evaluated together, which is right in any case.
        parts.agree_with(program).then_some(parts)
    }

    /// Whether the parts compute what the functions of a program compute for all contacts: each number by the same operations on the
    /// same arguments, none of which is other than the time, a coordinate, a velocity or a prepared value.
    pub fn agree_with(&self, program: &Program) -> bool {
        let mut known = FxHashMap::default();
        let all = QUANTITIES.into_iter().zip(&self.parts);
        all.into_iter().all(|(role, parts)| {
            let Some(whole) = program.function(role) else {
                return parts.iter().all(|part| part.function.is_none());
            };
            let Some(of_whole) = numbered(&mut known, &whole.code, Some) else {
                return false;
            };
            (0..).zip(parts).all(|(contact, part)| {
                let (width, first) = numbers(program, role, contact);
                let expected = &whole.results[first..first + width];
                let expected = expected.iter().map(|value| of_whole[value.index()]);
                self.numbers_of(part, width, &mut known)
                    .is_some_and(|found| expected.eq(found))
            })
        })
    }

    /// The numbers that a part computes, `width` of them, by the index of their operations among those known; `None` if it cannot be
    /// called.
    fn numbers_of(
        &self,
        part: &ContactPart,
        width: usize,
        known: &mut FxHashMap<Op, Value>,
    ) -> Option<Vec<Value>> {
        let zero = numbered(known, &[Op::Constant(Rational::ZERO)], Some)?[0];
        let mut found = vec![zero; width];
        let Some(index) = part.function else {
            return Some(found);
        };
        let function = self.program.function(Role::ContactPart(index))?;
        let argument = |source| match source {
            Source::Time => Some(source),
            Source::Coordinate(place) => {
                let argument = part.arguments.get(place as usize).copied();
                argument.filter(|argument| {
                    matches!(
                        argument,
                        Source::Coordinate(_) | Source::Velocity(_) | Source::Prepared(_)
                    )
                })
            }
            _ => None,
        };
        let values = numbered(known, &function.code, argument)?;
        for (place, result) in part.places.iter().zip(&function.results) {
            *found.get_mut(*place as usize)? = values[result.index()];
        }
        Some(found)
    }

    /// For each coordinate, and last for the time, whether any gap depends on it.
    pub fn gap_arguments(&self) -> &[bool] {
        &self.gap_arguments
    }

    /// The part of a contact, by the index of the quantity among [`QUANTITIES`].
    pub fn part(&self, quantity: usize, contact: usize) -> Option<&ContactPart> {
        self.parts.get(quantity)?.get(contact)
    }
}

/// The index of each operation among those known, which are the same if they and all that they depend on are the same. The sources of
/// arguments are replaced; `None` if one has no place among the arguments of a part.
fn numbered(
    known: &mut FxHashMap<Op, Value>,
    code: &[Op],
    source: impl Fn(Source) -> Option<Source>,
) -> Option<Vec<Value>> {
    let mut values: Vec<Value> = Vec::with_capacity(code.len());
    for op in code {
        let op = match op {
            Op::Read(read) => Op::Read(source(*read)?),
            op => op.with_operands(|operand| values[operand.index()]),
        };
        let next = Value(known.len() as u32);
        values.push(*known.entry(op).or_insert(next));
    }
    Some(values)
}

/// For each coordinate, and last for the time, whether any gap depends on it.
fn gap_arguments(program: &Program) -> Vec<bool> {
    let n = program.dimension();
    let mut are_read = vec![false; n + 1];
    let code = program
        .function(Role::Gaps)
        .map_or(&[][..], |gaps| &gaps.code);
    for op in code {
        match op {
            Op::Read(Source::Time) => are_read[n] = true,
            Op::Read(Source::Coordinate(i)) => are_read[*i as usize] = true,
            _ => {}
        }
    }
    are_read
}

/// How many numbers of a quantity a contact has, and where they begin in the function for all contacts.
fn numbers(program: &Program, role: Role, contact: usize) -> (usize, usize) {
    let width = match role {
        Role::Gaps => 1,
        Role::ContactRates | Role::ContactBias => 2,
        Role::ContactMatrix => 2 * program.dimension(),
        Role::ContactCoefficients => 4,
        _ => {
            let before = &program.unilateral[..contact];
            let faces = before.iter().filter(|one| one.has_face).count();
            let width = if program.unilateral[contact].has_face {
                3
            } else {
                0
            };
            return (width, 3 * faces);
        }
    };
    (width, contact * width)
}

/// The parts of a quantity.
fn parts_of(program: &Program, role: Role, functions: &mut Functions) -> Vec<ContactPart> {
    let contacts = 0..program.unilateral.len();
    let Some(function) = program.function(role) else {
        return contacts.map(|_| ContactPart::default()).collect();
    };
    let is_zero =
        |value: &Value| matches!(function.op(*value), Op::Constant(value) if value.is_zero());
    let part = |contact: usize| {
        let (width, first) = numbers(program, role, contact);
        let own = function.results[first..first + width].iter().zip(0..);
        let own = own.filter(|(value, _)| !is_zero(value));
        let (results, places): (Vec<Value>, Vec<u32>) = own.unzip();
        if results.is_empty() {
            return ContactPart::default();
        }
        let (code, results, arguments) = without_others(function, &results);
        ContactPart {
            function: Some(functions.add(code, results)),
            arguments,
            places,
        }
    };
    contacts.map(part).collect()
}

/// The functions of parts, each once.
#[derive(Default)]
struct Functions {
    all: Vec<(Vec<Op>, Vec<Value>)>,
    index_of: FxHashMap<(Vec<Op>, Vec<Value>), usize>,
}

impl Functions {
    fn add(&mut self, code: Vec<Op>, results: Vec<Value>) -> usize {
        let own = (code, results);
        if let Some(index) = self.index_of.get(&own) {
            return *index;
        }
        let index = self.all.len();
        self.all.push(own.clone());
        self.index_of.insert(own, index);
        index
    }
}

/// The operations on which values of a function depend, the places of the values among these, and the arguments that they read in place of
/// coordinates.
///
/// An operation follows its operands, the first before the second, whatever the order in the function is, so that the parts of
/// contacts that are alike are equal.
fn without_others(function: &Function, wanted: &[Value]) -> (Vec<Op>, Vec<Value>, Vec<Source>) {
    let (mut code, mut arguments) = (Vec::new(), Vec::new());
    let mut places: FxHashMap<Value, Value> = FxHashMap::default();
    // The last value first; whether its operands have been placed.
    let mut open: Vec<(Value, bool)> = wanted.iter().rev().map(|value| (*value, false)).collect();
    while let Some((value, is_ready)) = open.pop() {
        if places.contains_key(&value) {
            continue;
        }
        let op = function.op(value);
        let operands: Vec<Value> = op.operands().collect();
        if !is_ready && !operands.is_empty() {
            open.push((value, true));
            open.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            continue;
        }
        let op = match op {
            Op::Read(Source::Time) => op.clone(),
            Op::Read(source) => {
                arguments.push(*source);
                Op::Read(Source::Coordinate(arguments.len() as u32 - 1))
            }
            op => op.with_operands(|operand| places[&operand]),
        };
        places.insert(value, Value(code.len() as u32));
        code.push(op);
    }
    let results = wanted.iter().map(|value| places[value]).collect();
    (code, results, arguments)
}

/// The program of these functions, with so many coordinates.
fn program_of(
    program: &Program,
    functions: Vec<(Vec<Op>, Vec<Value>)>,
    coordinates: usize,
) -> Program {
    let nothing = |role: Role| Function {
        role,
        code: Vec::new(),
        shape: Shape::Vector(0),
        results: Vec::new(),
        guards: Vec::new(),
        steps: Vec::new(),
    };
    let functions = functions.into_iter().enumerate();
    let functions = functions.map(|(index, (code, results))| Function {
        code,
        shape: Shape::Vector(results.len()),
        results,
        ..nothing(Role::ContactPart(index))
    });
    let slot: Option<&Slot> = program.coordinates.first();
    Program {
        parameters: Vec::new(),
        coordinates: slot
            .into_iter()
            .cycle()
            .take(coordinates)
            .cloned()
            .collect(),
        quaternions: Vec::new(),
        inputs: Vec::new(),
        outputs: Vec::new(),
        assumptions: Vec::new(),
        constraints: Vec::new(),
        contacts: Vec::new(),
        unilateral: Vec::new(),
        kept: Vec::new(),
        derivatives: Vec::new(),
        stages: Stages::default(),
        prepare: nothing(Role::Prepare),
        prepared: Vec::new(),
        start: nothing(Role::Start),
        functions: functions.collect(),
        ..program.with_functions(|_| false)
    }
}
