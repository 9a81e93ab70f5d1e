//! Ctrl-C ends a run early; the results up to then are written and reported.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

use crate::host;

/// The exit status of an interrupted command: 128 plus the number of the signal.
pub const STATUS: u8 = 128 + SIGINT as u8;

/// A flag that Ctrl-C sets. A second press ends the command at once.
pub fn flag() -> Arc<AtomicBool> {
    Interrupt::watch().0
}

/// Whether Ctrl-C was pressed since this was created. A second press ends the command at once.
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Starts to watch. If that is not possible, Ctrl-C ends the command as usual; inside another program, that
    /// program handles it.
    pub fn watch() -> Interrupt {
        if let Some(stop) = host::stop() {
            return Interrupt(stop);
        }
        let pressed = Arc::new(AtomicBool::new(false));
        // In this order, so that the second press ends the command, not the first.
        let quits = flag::register_conditional_shutdown(SIGINT, STATUS.into(), pressed.clone());
        if quits.is_ok() {
            let _ = flag::register(SIGINT, pressed.clone());
        }
        Interrupt(pressed)
    }

    /// Whether Ctrl-C was pressed.
    pub fn was_pressed(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
