//! The equations of motion of interpreted machines in numbers of any kind.

use std::sync::Arc;
use std::vec::Vec;

use lagrangian_program::{Arguments, Interpreter, Program, Role};
use lagrangian_scalar::Scalar;

use super::InterpretedMachine;
use super::named::{Names, quantities};
use super::system::singular_row;
use crate::error::NoNumbers;
use crate::shared_workspace::SharedWorkspace;
use crate::{Quantity, Real, Singular, SystemIn};

/// The equations of motion of an [`InterpretedMachine`] in numbers `N`: double-doubles, `f32`, or dual numbers.
///
/// An [`ExplicitStepper`](crate::ExplicitStepper) runs them. Parameters and inputs are the `f64` of the machine.
#[derive(Clone, Debug)]
pub struct InterpretedSystemIn<N: Clone> {
    program: Arc<Program>,
    names: Arc<Names>,
    inputs: Vec<N>,
    interpreter: SharedWorkspace<Interpreter<N>>,
}

impl InterpretedMachine {
    /// Checks that the machine can be run in other numbers than `f64`.
    pub(super) fn check_numbers(&self) -> Result<(), NoNumbers> {
        let program = &self.program;
        let reason = if !program.unilateral.is_empty() {
            "it has contacts that close and open"
        } else if !program.contacts.is_empty() {
            "it has contacts with friction"
        } else if !program.constraints.is_empty() {
            "it has constraints"
        } else {
            return Ok(());
        };
        Err(NoNumbers { why: reason.into() })
    }

    /// The equations of motion in numbers of any kind.
    ///
    /// # Errors
    /// If the machine has constraints or contacts.
    pub fn prepare_in<N: Real + Scalar<Stored = N>>(
        &self,
    ) -> Result<InterpretedSystemIn<N>, NoNumbers> {
        self.check_numbers()?;
        let numbers =
            |values: &[f64]| -> Vec<N> { values.iter().map(|x| N::from_f64(*x)).collect() };
        let interpreter = Interpreter::new(&self.program, &numbers(&self.parameters));
        Ok(InterpretedSystemIn {
            program: self.program.clone(),
            names: self.names.clone(),
            inputs: numbers(&self.inputs),
            interpreter: SharedWorkspace::new(interpreter),
        })
    }
}

impl<N: Real + Scalar<Stored = N>> SystemIn<N> for InterpretedSystemIn<N> {
    type Vector = Vec<N>;
    type Coordinates = Vec<N>;
    type Inputs = Vec<N>;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        quantities(&self.names.coordinates)
    }

    fn to_coordinates(&self, vector: &Vec<N>) -> Vec<N> {
        vector.clone()
    }

    fn to_vector(&self, coordinates: &Vec<N>) -> Vec<N> {
        coordinates.clone()
    }

    fn accelerations(
        &self,
        t: N,
        q: &Vec<N>,
        v: &Vec<N>,
        u: &Vec<N>,
        a: &mut Vec<N>,
    ) -> Result<(), Singular> {
        let arguments = Arguments { t, q, v, u, a: &[] };
        let called = (self.interpreter.lock()).call(Role::Accelerations, arguments, a);
        called.map_err(|singular| singular_row(&self.program, singular))
    }

    fn default_inputs(&self) -> Vec<N> {
        self.inputs.clone()
    }
}
