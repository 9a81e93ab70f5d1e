//! The Taylor series of a machine's motion: given with the machine, or derived when something first needs it.

use core::fmt;
use std::boxed::Box;
use std::format;
use std::string::{String, ToString};
use std::sync::{Arc, OnceLock};

use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_program::series::{NoSeries, Series};
use lagrangian_program::{Program, Role};

use super::engine::CodeOfSeries;

/// The time to derive and to prove a series, and that of an evaluation of the accelerations in a run with its energy balance, in ns: for any machine, and
/// for each operation of its accelerations. Their ratio is within a factor of four for most machines of the library (`docs/benchmarks.md`).
const DERIVING: [f64; 2] = [2e6, 25e3];
const EVALUATING: [f64; 2] = [200.0, 0.5];

/// What the work of drives and the losses of dampers add to that of an evaluation, and the projection onto constraints.
const WITH_POWERS: f64 = 300.0;
const WITH_CONSTRAINTS: f64 = 1000.0;

/// Derives a series, in any thread.
type Derive = dyn Fn() -> Result<ProvedSeries, NoSeries> + Send + Sync;

/// The series of a machine, shared by its clones and by their systems, so that it is derived and compiled once for all of them.
#[derive(Clone)]
pub(super) struct MotionSeries(Arc<Shared>);

struct Shared {
    known: OnceLock<Known>,
    /// `None` if it was given.
    derive: Option<Box<Derive>>,
}

/// A series, or why there is none.
#[derive(Debug)]
pub(super) struct Known {
    pub series: Result<Arc<Series>, String>,
    /// Its machine code.
    pub code: CodeOfSeries,
    /// The costs of its steps, once something has asked for them.
    costs: OnceLock<Option<[f64; 2]>>,
}

impl Known {
    pub(super) fn of(series: Result<Arc<Series>, String>) -> Known {
        let code = series.as_ref().map(CodeOfSeries::new);
        Known {
            code: code.unwrap_or_default(),
            costs: OnceLock::new(),
            series,
        }
    }

    fn derived(series: Result<ProvedSeries, NoSeries>) -> Known {
        Known::of(match series {
            Ok(series) => Ok(series.series().clone()),
            Err(reason) => Err(reason.to_string()),
        })
    }
}

impl MotionSeries {
    fn known_to_be(known: Known) -> MotionSeries {
        MotionSeries(Arc::new(Shared {
            known: known.into(),
            derive: None,
        }))
    }

    /// There is none, for this reason.
    pub(super) fn none(reason: &str) -> MotionSeries {
        MotionSeries::known_to_be(Known::of(Err(reason.into())))
    }

    /// This one.
    pub(super) fn given(series: Result<ProvedSeries, NoSeries>) -> MotionSeries {
        MotionSeries::known_to_be(Known::derived(series))
    }

    /// The one that `derive` returns.
    pub(super) fn on_demand(derive: Box<Derive>) -> MotionSeries {
        MotionSeries(Arc::new(Shared {
            known: OnceLock::new(),
            derive: Some(derive),
        }))
    }

    /// Whether it is derived on demand. That it has been derived already makes no difference: otherwise a run would depend on those before it.
    pub(super) fn is_on_demand(&self) -> bool {
        self.0.derive.is_some()
    }

    /// The series, which is derived now if it was not before.
    pub(super) fn known(&self) -> &Known {
        let Shared { known, derive } = &*self.0;
        known.get_or_init(|| match derive {
            Some(derive) => Known::derived(derive()),
            None => Known::of(Err("its series was not derived".into())),
        })
    }

    /// The series, if it has been derived.
    pub(super) fn if_known(&self) -> Option<&Known> {
        self.0.known.get()
    }

    /// The costs of its steps ([`System::series_cost`](crate::System::series_cost)), rounded as in emitted code.
    pub(super) fn cost(&self, program: &Program) -> Option<[f64; 2]> {
        let Known { series, costs, .. } = self.known();
        let series = series.as_ref().ok()?;
        *costs.get_or_init(|| series.cost(program).map(rounded))
    }

    /// What powers add to them ([`System::powers_cost`](crate::System::powers_cost)).
    pub(super) fn cost_of_powers(&self, program: &Program) -> Option<[f64; 3]> {
        let series = self.known().series.as_ref().ok()?;
        series.cost_of_powers(program).map(rounded)
    }
}

/// Costs as emitted code has them.
fn rounded<const N: usize>(costs: [f64; N]) -> [f64; N] {
    costs.map(|cost| format!("{cost:.1}").parse().unwrap_or(cost))
}

/// About how many evaluations of the accelerations take as long as the derivation of the series of a machine with this program
/// ([`System::series_derivation`](crate::System::series_derivation)).
pub(super) fn derivation(program: &Program) -> f64 {
    let function = program.function(Role::Accelerations);
    let operations = function.map_or(0, |function| function.code.len());
    let time = |[fixed, of_each]: [f64; 2]| fixed + of_each * operations as f64;
    let mut evaluating = time(EVALUATING);
    if program.has_powers() != [false; 2] {
        evaluating += WITH_POWERS;
    }
    if !program.constraints.is_empty() {
        evaluating += WITH_CONSTRAINTS;
    }
    time(DERIVING) / evaluating
}

impl fmt::Debug for MotionSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.known.get() {
            Some(known) => known.series.fmt(f),
            None => f.write_str("not derived yet"),
        }
    }
}
