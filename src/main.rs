//! The `squeezefilm` program: arguments to command.

use std::process::ExitCode;

fn main() -> ExitCode {
    squeezefilm::cli::run(std::env::args_os())
}
