//! Numbers of single contacts of an interpreted machine.

use std::sync::Arc;
use std::vec;
use std::vec::Vec;

use lagrangian_program::contact_parts::ContactParts;
use lagrangian_program::{Arguments, Interpreter, Role, Source};

use super::engine::MachineCode;
use super::running::{Running, at};
use crate::ContactQuantity;

/// The parts of the contacts of a machine, with the values of its parameters and memory for their arguments and results.
#[derive(Clone, Debug)]
pub(super) struct RunningParts {
    parts: Arc<ContactParts>,
    running: Running,
    prepared: Vec<f64>,
    arguments: Vec<f64>,
    results: Vec<f64>,
}

impl RunningParts {
    /// For a machine with these prepared values.
    pub(super) fn new(
        parts: Arc<ContactParts>,
        machine_code: &MachineCode,
        prepared: &[f64],
    ) -> RunningParts {
        let interpreter = Interpreter::new(&parts.program, &[]);
        let functions = parts.program.functions.iter();
        let most = functions.map(|function| function.results.len()).max();
        RunningParts {
            running: Running {
                compiled: machine_code.prepared(&interpreter),
                interpreter,
            },
            prepared: prepared.to_vec(),
            arguments: vec![0.0; parts.program.dimension()],
            results: vec![0.0; most.unwrap_or(0)],
            parts,
        }
    }

    /// Writes a quantity of some contacts, one after the other; each has as many numbers.
    pub(super) fn write(
        &mut self,
        quantity: ContactQuantity,
        which: &[usize],
        (t, q, v): (f64, &[f64], &[f64]),
        numbers: &mut [f64],
    ) {
        let Self {
            parts,
            running,
            prepared,
            arguments,
            results,
        } = self;
        numbers.fill(0.0);
        let width = numbers.len() / which.len().max(1);
        let each = numbers.chunks_exact_mut(width.max(1));
        for (numbers, contact) in each.zip(which) {
            let Some(part) = parts.part(quantity as usize, *contact) else {
                continue;
            };
            let Some(function) = part.function else {
                continue;
            };
            for (argument, source) in arguments.iter_mut().zip(&part.arguments) {
                *argument = match *source {
                    Source::Coordinate(i) => q[i as usize],
                    Source::Velocity(i) => v[i as usize],
                    Source::Prepared(i) => prepared[i as usize],
                    // Nothing else is an argument of a quantity of contacts.
                    _ => f64::NAN,
                };
            }
            let arguments: Arguments<'_, f64> = at(t, arguments, &[], &[]);
            let results = &mut results[..part.places.len()];
            // Nothing is divided by a pivot.
            let _ = running.call(Role::ContactPart(function), arguments, results);
            for (place, result) in part.places.iter().zip(results) {
                numbers[*place as usize] = *result;
            }
        }
    }
}
