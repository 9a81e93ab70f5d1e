//! Ctrl-C, which ends a run where it is: what there is of it is written, and said.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

use crate::host;

/// The exit status of a command that was interrupted: 128 and the number of the signal.
pub const STATUS: u8 = 128 + SIGINT as u8;

/// A flag that Ctrl-C sets. A second press quits the command at once.
pub fn flag() -> Arc<AtomicBool> {
    Interrupt::watch().0
}

/// Whether somebody pressed Ctrl-C since this was made. A second press quits the command at once.
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Begins to watch. Where that cannot be done, Ctrl-C quits as ever; within another program it is that program's.
    pub fn watch() -> Interrupt {
        if let Some(stop) = host::stop() {
            return Interrupt(stop);
        }
        let pressed = Arc::new(AtomicBool::new(false));
        // In this order: the second time, not the first.
        let quits = flag::register_conditional_shutdown(SIGINT, STATUS.into(), pressed.clone());
        if quits.is_ok() {
            let _ = flag::register(SIGINT, pressed.clone());
        }
        Interrupt(pressed)
    }

    /// Whether it was pressed.
    pub fn came(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
