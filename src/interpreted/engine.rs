//! Engines that execute the functions of a machine read from a spec: the interpreter, or machine code.

use std::sync::Arc;
use std::vec::Vec;

use crate::error::NoMachineCode;
use lagrangian_program::series::{Expander, Series};
use lagrangian_program::{Arguments, Interpreter, Program, Role};

/// The engine that executes the functions of an [`InterpretedMachine`](super::InterpretedMachine). All give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Engine {
    /// The interpreter, which is available everywhere.
    #[default]
    Interpreter,
    /// Machine code, compiled at the first call of a function.
    Jit,
    /// The interpreter, until a function has taken as much time as compiling it would take; then machine code, if available.
    Auto,
}

/// The machine code of a program, if it may have any, shared by all its systems.
#[derive(Clone, Debug, Default)]
pub(super) struct MachineCode {
    #[cfg(feature = "jit")]
    library: Option<(Arc<lagrangian_jit::Library>, lagrangian_jit::When)>,
    /// Code for several states at once, compiled on first use; `None` if that is not available.
    #[cfg(feature = "jit")]
    of_lanes: Arc<std::sync::OnceLock<Option<Arc<lagrangian_jit::Library>>>>,
}

/// The machine code of a series, shared by all systems of its machine.
#[derive(Clone, Debug, Default)]
pub(super) struct CodeOfSeries {
    #[cfg(feature = "jit")]
    library: Option<Arc<lagrangian_jit::SeriesLibrary>>,
}

/// The machine code of a series with the values of parameters, if it may have any.
#[derive(Clone, Debug)]
pub(super) struct CompiledSeries {
    #[cfg(feature = "jit")]
    library: Option<(Arc<lagrangian_jit::SeriesLibrary>, lagrangian_jit::When)>,
    #[cfg(feature = "jit")]
    running: Option<lagrangian_jit::SeriesRunning>,
}

/// The machine code of a program with the values of parameters.
#[derive(Clone, Debug)]
pub(super) struct Compiled {
    #[cfg(feature = "jit")]
    running: Option<lagrangian_jit::Running>,
}

#[cfg(feature = "jit")]
impl MachineCode {
    /// Prepares what an engine needs for a program.
    pub(super) fn new(
        engine: Engine,
        program: &Arc<Program>,
    ) -> Result<MachineCode, NoMachineCode> {
        use lagrangian_jit::{Library, When};
        use std::string::ToString;
        let when = match engine {
            Engine::Interpreter => return Ok(MachineCode::default()),
            Engine::Jit => When::Always,
            Engine::Auto => When::ItPays,
        };
        match Library::new(program.clone()) {
            Ok(library) => Ok(MachineCode {
                library: Some((Arc::new(library), when)),
                of_lanes: Arc::default(),
            }),
            Err(_) if engine == Engine::Auto => Ok(MachineCode::default()),
            Err(error) => Err(NoMachineCode {
                why: error.to_string(),
            }),
        }
    }

    /// Whether runs in lanes are worth compiling: if machine code was requested, or has paid off for one state.
    pub(super) fn pays_in_lanes(&self) -> bool {
        use lagrangian_jit::When;
        let library = self.library.as_ref();
        library.is_some_and(|(library, when)| match when {
            When::Always => true,
            When::ItPays => library.is_compiled(Role::Accelerations),
        })
    }

    /// The code for several states at once, each with its own parameters, if it is worth compiling.
    pub(super) fn of_lanes(
        &self,
        program: &Arc<Program>,
        lanes: usize,
    ) -> Option<Arc<lagrangian_jit::Library>> {
        if !self.pays_in_lanes() {
            return None;
        }
        let library = self.of_lanes.get_or_init(|| {
            let library = lagrangian_jit::Library::for_lanes(program.clone(), lanes, false);
            library.ok().map(Arc::new)
        });
        library.clone()
    }

    /// Prepares the code with the parameters of an interpreter.
    pub(super) fn prepared(&self, interpreter: &Interpreter<f64>) -> Compiled {
        let library = self.library.as_ref();
        let running = library.map(|(library, when)| {
            lagrangian_jit::Running::new(library.clone(), *when, interpreter)
        });
        Compiled { running }
    }
}

#[cfg(feature = "jit")]
impl Compiled {
    /// Calls machine code. Returns false if there is none for the function; then the interpreter has to be called.
    #[inline]
    pub(super) fn call(
        &mut self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> bool {
        let running = self.running.as_mut();
        running.is_some_and(|running| running.call(role, arguments, results))
    }

    /// Like [`Interpreter::stand`].
    pub(super) fn set_stage_results(&mut self, role: Role, values: &[f64]) {
        if let Some(running) = &mut self.running {
            running.set_stage_results(role, values);
        }
    }
}

#[cfg(feature = "jit")]
impl CodeOfSeries {
    /// For a series.
    pub(super) fn new(series: &Arc<Series>) -> CodeOfSeries {
        if !series.is_symmetric {
            return CodeOfSeries::default();
        }
        let library = lagrangian_jit::SeriesLibrary::new(series.clone());
        CodeOfSeries {
            library: Some(Arc::new(library)),
        }
    }

    /// Whether runs in lanes are worth compiling: if machine code was requested, or has paid off for one state.
    pub(super) fn pays_in_lanes(&self, engine: &MachineCode) -> bool {
        use lagrangian_jit::When;
        let engine = engine.library.as_ref().map(|(_, when)| *when);
        engine
            .zip(self.library.as_ref())
            .is_some_and(|(when, library)| match when {
                When::Always => true,
                When::ItPays => library.is_compiled(),
            })
    }

    /// The code for several states at once, each with its own parameters, if it is worth compiling.
    pub(super) fn of_lanes(
        &self,
        engine: &MachineCode,
        lanes: usize,
    ) -> Option<Arc<lagrangian_jit::SeriesCode>> {
        if !self.pays_in_lanes(engine) {
            return None;
        }
        self.library.as_ref()?.code_of_lanes(lanes)
    }

    /// Prepares the code for the engine of a machine.
    pub(super) fn prepared(&self, engine: &MachineCode) -> CompiledSeries {
        let when = engine.library.as_ref().map(|(_, when)| *when);
        CompiledSeries {
            library: self.library.clone().zip(when),
            running: None,
        }
    }
}

#[cfg(feature = "jit")]
impl CompiledSeries {
    /// Expands the motion through a state by machine code, for the parameters and orders of an expander. Returns false if there is none; then
    /// the expander has to be used.
    pub(super) fn expand(
        &mut self,
        expander: &Expander<f64>,
        (t, state): ([f64; 2], [&[f64]; 3]),
        coefficients: &mut [Vec<f64>],
    ) -> bool {
        if self.running.is_none() {
            let library = self.library.as_ref();
            let code = library.and_then(|(library, when)| library.code(*when));
            let running = code.map(|code| lagrangian_jit::SeriesRunning::new(code, expander));
            self.running = running;
        }
        let running = self.running.as_mut();
        running.is_some_and(|running| running.expand(t, state, coefficients))
    }
}

#[cfg(not(feature = "jit"))]
impl CodeOfSeries {
    pub(super) fn new(_: &Arc<Series>) -> CodeOfSeries {
        CodeOfSeries {}
    }

    pub(super) fn pays_in_lanes(&self, _: &MachineCode) -> bool {
        false
    }

    pub(super) fn prepared(&self, _: &MachineCode) -> CompiledSeries {
        CompiledSeries {}
    }
}

#[cfg(not(feature = "jit"))]
impl CompiledSeries {
    #[inline(always)]
    pub(super) fn expand(
        &mut self,
        _: &Expander<f64>,
        _: ([f64; 2], [&[f64]; 3]),
        _: &mut [Vec<f64>],
    ) -> bool {
        false
    }
}

#[cfg(not(feature = "jit"))]
impl MachineCode {
    pub(super) fn new(engine: Engine, _: &Arc<Program>) -> Result<MachineCode, NoMachineCode> {
        match engine {
            Engine::Jit => Err(NoMachineCode {
                why: "this build has no machine code: it was built without the feature jit".into(),
            }),
            Engine::Interpreter | Engine::Auto => Ok(MachineCode {}),
        }
    }

    pub(super) fn pays_in_lanes(&self) -> bool {
        false
    }

    pub(super) fn prepared(&self, _: &Interpreter<f64>) -> Compiled {
        Compiled {}
    }
}

#[cfg(not(feature = "jit"))]
impl Compiled {
    #[inline(always)]
    pub(super) fn call(&mut self, _: Role, _: Arguments<'_, f64>, _: &mut [f64]) -> bool {
        false
    }

    #[inline(always)]
    pub(super) fn set_stage_results(&mut self, _: Role, _: &[f64]) {}
}
