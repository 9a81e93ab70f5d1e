//! The program `lagrangian`; see the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(lagrangian_cli::command(std::env::args_os()))
}
