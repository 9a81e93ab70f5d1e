//! The series of a machine, compiled when that pays off.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, OnceLock};

use lagrangian_program::series::Series;

use super::{SeriesCode, When, work};

/// The series of a machine as machine code, shared by all that expand it.
#[derive(Debug)]
pub struct SeriesLibrary {
    series: Arc<Series>,
    /// The number of expansions after which compiling pays off, and the number of interpreted ones so far.
    pays_after: u32,
    calls: AtomicU32,
    /// `None` inside if machine code is not available.
    code: OnceLock<Option<Arc<SeriesCode>>>,
    /// The code for several states at once, likewise.
    of_lanes: OnceLock<Option<Arc<SeriesCode>>>,
}

impl SeriesLibrary {
    /// A series; nothing is compiled yet.
    pub fn new(series: Arc<Series>) -> SeriesLibrary {
        SeriesLibrary {
            pays_after: work::expansions_until_it_pays(&series),
            series,
            calls: AtomicU32::new(0),
            code: OnceLock::new(),
            of_lanes: OnceLock::new(),
        }
    }

    /// Whether the code for one state has been compiled.
    pub fn is_compiled(&self) -> bool {
        matches!(self.code.get(), Some(Some(_)))
    }

    /// The code for 4 or 8 states at once, each with its own parameters, compiled by the first call; all calls must be for one number of states. `None`
    /// if there can be none.
    pub fn code_of_lanes(&self, lanes: usize) -> Option<Arc<SeriesCode>> {
        let code = self.of_lanes.get_or_init(|| {
            let code = SeriesCode::for_lanes(&self.series, lanes);
            code.ok().map(Arc::new)
        });
        code.clone()
    }

    /// Counts an expansion, and returns the code for it: compiled now, or once enough expansions have been made. `None` if it is interpreted,
    /// or if there can be no code.
    pub fn code(&self, when: When) -> Option<Arc<SeriesCode>> {
        if let Some(code) = self.code.get() {
            return code.clone();
        }
        if when == When::ItPays {
            // Concurrent threads may lose counts, which only delays compilation.
            let calls = self.calls.load(Ordering::Relaxed);
            if calls < self.pays_after {
                self.calls.store(calls + 1, Ordering::Relaxed);
                return None;
            }
        }
        let code = self.code.get_or_init(|| {
            let code = SeriesCode::new(&self.series);
            code.ok().map(Arc::new)
        });
        code.clone()
    }
}
