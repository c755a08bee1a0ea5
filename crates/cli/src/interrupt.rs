//! Ctrl-C, and being asked to end.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on an interruption sets the flag that is returned, so that work
/// can stop in good order; a second one ends the process at once.
pub(crate) fn watch() -> &'static AtomicBool {
    // It fails where another handler is set already: then ours is.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(1);
        }
    });
    &INTERRUPTED
}
