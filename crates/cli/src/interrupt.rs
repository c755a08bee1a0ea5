//! Ctrl-C, and being asked to end.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on an interruption sets the flag that is returned, so that work
/// can stop in good order; a second one ends the process at once.
///
/// Where a signal was to be ignored (`nohup`, or a job in the background of a
/// script), it goes on being ignored.
pub(crate) fn watch() -> &'static AtomicBool {
    if !signals_are_ignored() {
        // It fails where another handler is set already: then ours is.
        let _ = ctrlc::set_handler(|| {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                std::process::exit(crate::INTERRUPTED.into());
            }
        });
    }
    &INTERRUPTED
}

/// Whether there was an interruption.
pub(crate) fn happened() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Whether hangups or interruptions are ignored, as far as the system says:
/// on Linux, signal n is bit n - 1 of a hexadecimal number.
fn signals_are_ignored() -> bool {
    const HANGUP_AND_INTERRUPTION: u64 = 0b11;
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.unwrap_or(0) & HANGUP_AND_INTERRUPTION != 0
}
