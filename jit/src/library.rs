//! The functions of a program, each compiled when first needed.

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, OnceLock};

use lagrangian_program::{Function, Program, Role};

use super::code::{Code, Layout};
use super::unavailable::Unavailable;
use super::{Level, work};

/// A program's functions as machine code, for one state or several at once; shared by all that run it.
#[derive(Debug)]
pub struct Library {
    program: Arc<Program>,
    layout: Layout,
    /// In the order of roles.
    functions: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    role: Role,
    /// The number of calls after which compiling pays off, and the number of interpreted calls so far.
    pays_after: u32,
    calls: AtomicU32,
    /// `None` inside if the system provided no pages.
    code: OnceLock<Option<Code>>,
}

/// The indices of recently called functions: a run calls the same few again and again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recent {
    places: [usize; 8],
    oldest: usize,
}

impl Default for Recent {
    fn default() -> Self {
        Recent {
            places: [usize::MAX; 8],
            oldest: 0,
        }
    }
}

impl Recent {
    /// The index of a function in `library`, which must always be the same one.
    #[inline]
    pub fn place(&mut self, library: &Library, role: Role) -> Option<usize> {
        let mut known = self.places.iter();
        if let Some(place) = known.find(|place| library.role_at(**place) == Some(role)) {
            return Some(*place);
        }
        let place = library.place(role)?;
        self.places[self.oldest] = place;
        self.oldest = (self.oldest + 1) % self.places.len();
        Some(place)
    }
}

impl Library {
    /// A program for one state at a time. Only its shortest function is compiled at once, to find out whether
    /// compilation is possible.
    ///
    /// # Errors
    /// If machine code is not available here.
    pub fn new(program: Arc<Program>) -> Result<Library, Unavailable> {
        let level = Level::here().ok_or(Unavailable::Processor)?;
        Library::of(program, Library::one(level))
    }

    /// A program for N states at once, 4 or 8, all with the same parameters or each with its own.
    ///
    /// # Errors
    /// If machine code is not available here, or not for this number of states.
    pub fn for_lanes(
        program: Arc<Program>,
        lanes: usize,
        is_shared: bool,
    ) -> Result<Library, Unavailable> {
        let level = Level::here().ok_or(Unavailable::Processor)?;
        let layout = Library::several(level, lanes, is_shared).ok_or(Unavailable::Processor)?;
        Library::of(program, layout)
    }

    /// A program in a layout that [`one`](Self::one) or [`several`](Self::several) returned.
    ///
    /// # Errors
    /// If the processor lacks the level, or the system provides no pages.
    pub fn of(program: Arc<Program>, layout: Layout) -> Result<Library, Unavailable> {
        if !Level::all().any(|level| level == layout.level) {
            return Err(Unavailable::Processor);
        }
        let shortest = program
            .all_functions()
            .min_by_key(|function| function.code.len());
        if let Some(shortest) = shortest {
            Code::new(shortest, shortest.role.is_fast(), layout)?;
        }
        let mut functions: Vec<Entry> = program
            .all_functions()
            .map(|function| Entry {
                role: function.role,
                pays_after: work::calls_until_it_pays(function),
                calls: AtomicU32::new(0),
                code: OnceLock::new(),
            })
            .collect();
        functions.sort_by_key(|entry| entry.role);
        Ok(Library {
            program,
            layout,
            functions,
        })
    }

    /// The layout for one state.
    pub fn one(level: Level) -> Layout {
        Layout {
            level,
            lanes: 1,
            stride: 1,
            known_stride: 1,
        }
    }

    /// The layout for 4 or 8 states; `None` for other numbers.
    pub fn several(level: Level, lanes: usize, is_shared: bool) -> Option<Layout> {
        if lanes != 4 && lanes != 8 {
            return None;
        }
        // Without AVX-512, eight lanes are two groups of four with a stride of eight.
        let own = match level {
            Level::Avx512 => lanes,
            Level::Avx2 => 4,
        };
        let known_stride = match (is_shared, level) {
            (true, Level::Avx512) => 1,
            (true, Level::Avx2) => own,
            (false, _) => lanes,
        };
        Some(Layout {
            level,
            lanes: own,
            stride: lanes,
            known_stride,
        })
    }

    /// The program.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The arrangement of the states' numbers in memory.
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// The code of a function, compiled if necessary; `None` if the program lacks the function.
    pub fn code(&self, role: Role) -> Option<&Code> {
        self.code_at(self.place(role)?)
    }

    /// Whether a function has been compiled.
    pub fn is_compiled(&self, role: Role) -> bool {
        let entry = self.place(role).and_then(|place| self.functions.get(place));
        entry.is_some_and(|entry| matches!(entry.code.get(), Some(Some(_))))
    }

    /// The index of a function.
    pub(crate) fn place(&self, role: Role) -> Option<usize> {
        let functions = &self.functions;
        functions
            .binary_search_by_key(&role, |entry| entry.role)
            .ok()
    }

    /// The function at an index.
    pub(crate) fn role_at(&self, place: usize) -> Option<Role> {
        self.functions.get(place).map(|entry| entry.role)
    }

    /// Counts a call of the function at an index, and returns its code once enough calls have been made to make compiling worthwhile.
    #[inline]
    pub(crate) fn code_where_it_pays(&self, place: usize) -> Option<&Code> {
        let entry = self.functions.get(place)?;
        if let Some(code) = entry.code.get() {
            return code.as_ref();
        }
        // Concurrent threads may lose counts, which only delays compilation.
        let calls = entry.calls.load(Ordering::Relaxed);
        if calls < entry.pays_after {
            entry.calls.store(calls + 1, Ordering::Relaxed);
            return None;
        }
        self.code_at(place)
    }

    /// The code of the function at an index.
    pub(crate) fn code_at(&self, place: usize) -> Option<&Code> {
        let entry = self.functions.get(place)?;
        let code = entry.code.get_or_init(|| {
            let function: &Function = self.program.function(entry.role)?;
            Code::new(function, entry.role.is_fast(), self.layout).ok()
        });
        code.as_ref()
    }
}
