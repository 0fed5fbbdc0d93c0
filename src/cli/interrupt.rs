//! Ctrl-C: the first asks the solver to stop, the second ends the program.

use crate::control::Cancel;
use crate::platform::on_interrupt;

/// What a shell reports for a program ended by Ctrl-C.
const KILLED: i32 = 130;

/// A flag that the first Ctrl-C (or a request to terminate) raises.
pub(super) fn cancel_on_interrupt() -> Cancel {
    let cancel = Cancel::new();
    let raised = cancel.clone();
    on_interrupt(move || {
        if raised.is_cancelled() {
            std::process::exit(KILLED);
        }
        raised.cancel();
    });
    cancel
}
