//! Calls of 4 or 8 states at once.

use std::sync::Arc;

use lagrangian_native::Lanes;
use lagrangian_program::{Interpreter, Role};

use super::Library;
use super::arguments::SeveralArguments;
use super::code::{Results, Rows, Workspace};
use super::library::Recent;

/// A machine in N lanes, 4 or 8, executed as machine code.
///
/// The results of a lane are those of a single state, bit for bit, whatever the other lanes hold.
#[derive(Clone, Debug)]
pub struct Several<const N: usize> {
    library: Arc<Library>,
    /// In the arrangement of the layout: one number for all lanes, or one for each.
    known: Vec<f64>,
    /// A bit for each lane whose parameters allow accelerations.
    regular: u32,
    at_time: Vec<Lanes<N>>,
    at_position: Vec<Lanes<N>>,
    workspace: Workspace,
    /// The indices of recently called functions.
    recent: Recent,
}

impl<const N: usize> Several<N> {
    const ALL: u32 = match N {
        4 => 0b1111,
        8 => 0b1111_1111,
        _ => panic!("there is code for 4 or 8 lanes"),
    };

    /// All lanes have the parameters of an interpreter of the program. `None` if the library is for another number of lanes,
    /// or for separate parameters.
    pub fn shared(library: Arc<Library>, interpreter: &Interpreter<f64>) -> Option<Self> {
        let layout = library.layout();
        if layout.stride != N || layout.known_stride == layout.stride && layout.lanes != N {
            return None;
        }
        let copies = layout.known_stride;
        let known = interpreter.prepared().iter();
        let known = known.flat_map(|value| std::iter::repeat_n(*value, copies));
        Some(Several {
            known: known.collect(),
            regular: match interpreter.singular() {
                Some(_) => 0,
                None => Self::ALL,
            },
            ..Several::empty(library)
        })
    }

    /// Each lane has its own parameters; computes the values that depend on these alone. `None` if the library is for
    /// another number of lanes or for shared parameters, or if the number of parameters is not that of the program.
    pub fn each(library: Arc<Library>, parameters: &[Lanes<N>]) -> Option<Self> {
        let layout = library.layout();
        if layout.stride != N || layout.known_stride != N {
            return None;
        }
        let mut several = Several::empty(library);
        let program = several.library.program();
        if parameters.len() != program.parameters.len() {
            return None;
        }
        let mut prepared = vec![Lanes::splat(0.0); program.prepare.results.len()];
        several.known = parameters.iter().flat_map(|lanes| lanes.0).collect();
        let nothing = SeveralArguments {
            t: Lanes::splat(0.0),
            q: &[],
            v: &[],
            u: &[],
            a: &[],
        };
        several.regular = several.run(Role::Prepare, nothing, &mut prepared)?;
        several.known = prepared.iter().flat_map(|lanes| lanes.0).collect();
        Some(several)
    }

    /// Each lane has its own parameters, at first those of this interpreter of the program, until [`put`](Self::put)
    /// replaces them. `None` if the library is for another number of lanes or for shared parameters.
    pub fn each_from(library: Arc<Library>, interpreter: &Interpreter<f64>) -> Option<Self> {
        let layout = library.layout();
        if layout.stride != N || layout.known_stride != N {
            return None;
        }
        let mut several = Several::empty(library);
        several.known = vec![0.0; interpreter.prepared().len() * N];
        for lane in 0..N {
            several.put(lane, interpreter);
        }
        Some(several)
    }

    /// Replaces the parameters of a lane by those of an interpreter of the program; for values made
    /// by [`each_from`](Self::each_from).
    ///
    /// # Panics
    /// If there is no such lane, or if lanes share their parameters.
    pub fn put(&mut self, lane: usize, interpreter: &Interpreter<f64>) {
        assert!(lane < N && self.library.layout().known_stride == N);
        for (known, value) in self.known.chunks_exact_mut(N).zip(interpreter.prepared()) {
            known[lane] = *value;
        }
        match interpreter.singular() {
            Some(_) => self.regular &= !(1 << lane),
            None => self.regular |= 1 << lane,
        }
    }

    fn empty(library: Arc<Library>) -> Self {
        Several {
            library,
            known: Vec::new(),
            regular: Self::ALL,
            at_time: Vec::new(),
            at_position: Vec::new(),
            workspace: Workspace::default(),
            recent: Recent::default(),
        }
    }

    /// Runs a function in all lanes. The result has a bit for each lane, the lowest for the first, which is set if the
    /// lane has a value. (Other lanes have meaningless results; evaluating such a state alone gives its error.) `None` if
    /// the program lacks the function, the system provided no pages for it, or an argument is too short.
    pub fn call(
        &mut self,
        role: Role,
        arguments: SeveralArguments<'_, N>,
        results: &mut [Lanes<N>],
    ) -> Option<u32> {
        if matches!(role, Role::Prepare | Role::Start) {
            return None; // they read parameters
        }
        let held = self.run(role, arguments, results)?;
        Some(if role.inverts() {
            held & self.regular
        } else {
            held
        })
    }

    #[inline]
    fn run(
        &mut self,
        role: Role,
        arguments: SeveralArguments<'_, N>,
        results: &mut [Lanes<N>],
    ) -> Option<u32> {
        let place = self.recent.place(&self.library, role)?;
        let code = self.library.code_at(place)?;
        let layout = self.library.layout();
        let left = [self.at_time.as_slice(), self.at_position.as_slice()];
        let rows = Rows::of_several(&arguments, &self.known, layout.known_stride, left);
        let mut to = Results::from(results);
        let mut held = 0;
        for first in (0..N).step_by(layout.lanes) {
            held |= code.run(&mut self.workspace, &rows, first, &mut to)? << first;
        }
        Some(held)
    }

    /// Stores the results of [`Role::AtTime`] or [`Role::AtPosition`] for calls of the next stage.
    pub fn set_stage_results(&mut self, role: Role, values: &[Lanes<N>]) {
        let left = match role {
            Role::AtTime => &mut self.at_time,
            _ => &mut self.at_position,
        };
        left.clear();
        left.extend_from_slice(values);
    }
}
