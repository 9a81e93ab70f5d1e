//! Calls of one state.

use std::sync::Arc;

use lagrangian_program::{Arguments, Interpreter, Role};

use super::Library;
use super::code::{Rows, Workspace};
use super::library::Recent;

/// When functions are compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// At their first call.
    Always,
    /// When interpreting them has taken as long as compiling would.
    ItPays,
}

/// A machine with its parameters, executed as machine code where that pays off.
#[derive(Clone, Debug)]
pub struct Running {
    library: Arc<Library>,
    when: When,
    prepared: Vec<f64>,
    /// Whether the parameters leave the machine without accelerations.
    is_singular: bool,
    at_time: Vec<f64>,
    at_position: Vec<f64>,
    workspace: Workspace,
    /// The indices of recently called functions.
    recent: Recent,
}

impl Running {
    /// Takes a library and the parameters of an interpreter of the same program.
    pub fn new(library: Arc<Library>, when: When, interpreter: &Interpreter<f64>) -> Running {
        Running {
            library,
            when,
            prepared: interpreter.prepared().to_vec(),
            is_singular: interpreter.singular().is_some(),
            at_time: Vec::new(),
            at_position: Vec::new(),
            workspace: Workspace::default(),
            recent: Recent::default(),
        }
    }

    /// Runs a function and returns true if it has been compiled and its guards hold. Otherwise returns false, and the caller
    /// must use the interpreter, for results or for the error.
    #[inline]
    pub fn call(&mut self, role: Role, arguments: Arguments<'_, f64>, results: &mut [f64]) -> bool {
        // These two read parameters.
        let has_none =
            matches!(role, Role::Prepare | Role::Start) || self.is_singular && role.inverts();
        if has_none {
            return false;
        }
        let Some(place) = self.recent.place(&self.library, role) else {
            return false;
        };
        let code = match self.when {
            When::Always => self.library.code_at(place),
            When::ItPays => self.library.code_where_it_pays(place),
        };
        let Some(code) = code else {
            return false;
        };
        let left = [self.at_time.as_slice(), self.at_position.as_slice()];
        let rows = Rows::of_one(&arguments, &self.prepared, left);
        code.run(&mut self.workspace, &rows, 0, &mut results.into()) == Some(1)
    }

    /// Stores the results of [`Role::AtTime`] or [`Role::AtPosition`] for calls of the next stage.
    pub fn set_stage_results(&mut self, role: Role, values: &[f64]) {
        let left = match role {
            Role::AtTime => &mut self.at_time,
            _ => &mut self.at_position,
        };
        left.clear();
        left.extend_from_slice(values);
    }
}
