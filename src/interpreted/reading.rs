//! Reads specs: from text to a machine that runs, or to all errors in the text.

use std::format;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};
use std::thread;
use std::vec;
use std::vec::Vec;

use lagrangian_mechanics::series::{ProvedSeries, SeriesText};
use lagrangian_mechanics::{Compiled, Proved};
use lagrangian_program::series::NoSeries;
use lagrangian_spec::diagnostic::{self, Code, Report, Severity};
use lagrangian_spec::source::{Disk, Files, Recorder, Sources, Span};
use lagrangian_symbolic::{Dag, Rational};

use super::InterpretedMachine;
use crate::error::{Diagnostic, Error, Note};

/// Stack size of the thread that derives the equations. Nothing recurses deeply, but unoptimized code has large frames,
/// and the caller's thread may have a small stack.
const STACK: usize = 64 << 20;

/// A spec to be read, with its settings; created by [`InterpretedMachine::from_text`] and [`InterpretedMachine::read`].
#[derive(Clone, Debug)]
#[must_use = "call `build()` to obtain a machine"]
pub struct Reading {
    spec: Spec,
    constants: Vec<(String, f64)>,
    series: bool,
}

/// The source of a spec.
#[derive(Clone, Debug)]
enum Spec {
    File(PathBuf),
    Text { name: String, text: String },
}

/// A program, its series if that was derived at once, and the texts from which it can be derived later.
type Derived = (Proved, Option<Result<ProvedSeries, NoSeries>>, SeriesText);

impl InterpretedMachine {
    /// The machine of a spec in a file.
    ///
    /// # Errors
    /// [`Error::Spec`], with everything that is wrong with the spec.
    ///
    /// ```no_run
    /// use lagrangian::interpreted::InterpretedMachine;
    /// use lagrangian::{Machine, Simulation};
    ///
    /// let crusher = InterpretedMachine::from_file("machines/vibrating_crusher.machine")?;
    /// let run = Simulation::new(&crusher).until(1.0).run(crusher.start())?;
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn from_file(path: impl AsRef<Path>) -> Result<InterpretedMachine, Error> {
        Self::read(path).build()
    }

    /// Reads a spec from a file with settings: call [`Reading::constant`] and others, then [`build`](Reading::build).
    pub fn read(path: impl AsRef<Path>) -> Reading {
        Reading::of(Spec::File(path.as_ref().into()))
    }

    /// The machine of a spec in a string. Specs that it extends are read from files in the working directory.
    ///
    /// ```
    /// use lagrangian::Error;
    /// use lagrangian::interpreted::InterpretedMachine;
    ///
    /// let text = "machine Chain in plane {
    ///     constants { N = 2 }
    ///     parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
    ///     coordinates { theta[1..N]: rad = 0.5 }
    ///     frames {
    ///         end[0] = ground,
    ///         end[i in 1..N] = end[i-1].shift(l*sin(theta[i]), -l*cos(theta[i])),
    ///     }
    ///     bodies { ball[i in 1..N] { mass: m, at: end[i].origin } }
    ///     gravity (0, -g);
    /// }";
    /// let mut chain = InterpretedMachine::from_text(text).constant("N", 3).build()?;
    /// assert_eq!(chain.program().dimension(), 3);
    /// chain.set("l", 0.5)?;
    ///
    /// let wrong = text.replace("sin(theta[i])", "sine(theta[i])");
    /// let Err(Error::Spec { diagnostics, .. }) = InterpretedMachine::from_text(wrong).build() else {
    ///     panic!("there is no `sine`");
    /// };
    /// assert_eq!((diagnostics[0].code.as_str(), diagnostics[0].line), ("unknown-function", 7));
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn from_text(text: impl Into<String>) -> Reading {
        Reading::of(Spec::Text {
            name: "spec".into(),
            text: text.into(),
        })
    }
}

impl Reading {
    fn of(spec: Spec) -> Reading {
        Reading {
            spec,
            constants: Vec::new(),
            series: false,
        }
    }

    /// The name of the text in messages; specs that it extends are looked for beside a file of this name.
    /// `spec` by default.
    pub fn named(mut self, name: impl Into<String>) -> Reading {
        if let Spec::Text { name: known, .. } = &mut self.spec {
            *known = name.into();
        }
        self
    }

    /// Gives a constant of the spec another value, mostly the size `N` of a family.
    pub fn constant(mut self, name: impl Into<String>, value: impl Into<f64>) -> Reading {
        self.constants.push((name.into(), value.into()));
        self
    }

    /// Also derives the Taylor series of the motion, which the method [`TAYLOR`](crate::TAYLOR) needs; without this it is derived when a run first
    /// needs it. A run that [chooses its method](crate::Simulation::automatic) then considers series from its start on.
    pub fn with_series(mut self) -> Reading {
        self.series = true;
        self
    }

    /// Reads the spec, derives its equations, and proves the program that computes them.
    ///
    /// # Errors
    /// [`Error::Spec`], with everything that is wrong with the spec.
    pub fn build(self) -> Result<InterpretedMachine, Error> {
        let derived = thread::Builder::new()
            .stack_size(STACK)
            .spawn(move || self.derive())
            .map(thread::JoinHandle::join);
        match derived {
            Ok(Ok(machine)) => {
                let (program, series, text) = machine?;
                let machine = InterpretedMachine::new(program);
                let for_contacts = text.clone();
                let machine = match series {
                    Some(series) => machine.with_series(series),
                    None => machine.with_series_on_demand(move || text.derive()),
                };
                Ok(machine
                    .with_contact_series_on_demand(move || for_contacts.derive_with_contacts()))
            }
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(error) => Err(unreadable(
                "",
                format!("no thread could be started to derive it: {error}"),
            )),
        }
    }

    fn derive(self) -> Result<Derived, Error> {
        let (name, text) = match self.spec {
            Spec::Text { name, text } => (name, text),
            Spec::File(path) => {
                let path = path.to_string_lossy();
                Disk.read(&path, None)
                    .map_err(|reason| unreadable(&path, reason))?
            }
        };
        let mut constants = Vec::new();
        for (constant, value) in self.constants {
            let Some(value) = Rational::parse_decimal(&value.to_string()) else {
                let message =
                    format!("the constant `{constant}` is set to {value}, which is not a number");
                return Err(refused(&name, Code::NumberOutOfRange, message));
            };
            constants.push((constant, value));
        }
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let mut disk = Disk;
        let mut files = Recorder::new(&mut disk);
        let model = lagrangian_spec::model(
            &dag,
            &name,
            &text,
            &constants,
            &mut files,
            &mut sources,
            &mut report,
        );
        let files = files.read;
        match model.and_then(|model| Compiled::for_runs(model, &mut report)) {
            Some(compiled) => {
                let derived = self.series.then(|| ProvedSeries::derive(&compiled.model));
                let text = SeriesText {
                    name,
                    text,
                    constants,
                    files,
                    ..SeriesText::default()
                };
                Ok((compiled.program, derived, text))
            }
            None => Err(everything_wrong(&report, &sources)),
        }
    }
}

/// The errors of a report, without its warnings.
fn everything_wrong(report: &Report, sources: &Sources) -> Error {
    let place = |span: Span| {
        let (line, column) = sources.line_column(span);
        (sources.name(span.source).to_string(), line, column)
    };
    let of = |diagnostic: &diagnostic::Diagnostic| {
        let (file, line, column) = place(diagnostic.span);
        let notes = diagnostic.notes.iter().map(|(span, message)| {
            let (file, line, column) = place(*span);
            let message = message.clone();
            Note {
                file,
                line,
                column,
                message,
            }
        });
        Diagnostic {
            code: diagnostic.code.as_str().into(),
            message: diagnostic.message.clone(),
            help: diagnostic.help.clone(),
            file,
            line,
            column,
            words: sources.words(diagnostic.span).into(),
            notes: notes.collect(),
        }
    };
    let errors = report.diagnostics().into_iter();
    let errors = errors.filter(|diagnostic| diagnostic.code.severity() == Severity::Error);
    Error::Spec {
        diagnostics: errors.map(of).collect(),
        omitted: report.omitted(),
    }
}

/// The error for a file that cannot be read.
fn unreadable(file: &str, reason: String) -> Error {
    let message = format!("cannot read `{file}`: {reason}");
    refused(file, Code::UnreadableFile, message)
}

/// An error without a place in the text.
fn refused(file: &str, code: Code, message: String) -> Error {
    Error::Spec {
        diagnostics: vec![Diagnostic {
            code: code.as_str().into(),
            message,
            help: None,
            file: file.into(),
            line: 1,
            column: 1,
            words: String::new(),
            notes: Vec::new(),
        }],
        omitted: 0,
    }
}
