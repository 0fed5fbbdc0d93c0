//! The window without a console behind it, for Windows: `squeezefilm gui` with the same arguments, errors in a message box.
#![cfg_attr(windows, windows_subsystem = "windows")]

use std::process::ExitCode;

fn main() -> ExitCode {
    squeezefilm::cli::run_window(std::env::args_os(), |text| {
        rfd::MessageDialog::new()
            .set_level(rfd::MessageLevel::Error)
            .set_title("squeezefilm")
            .set_description(text)
            .show();
    })
}
