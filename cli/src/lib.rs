//! The command `lagrangian`: one subcommand for each question about a machine.
//!
//! It is also a library, so that other programs can run the command ([`command`]), run it on a spec in memory ([`answer`]), and
//! make its pages from runs of their own ([`report::Report`]).
//!
//! Exit status: 0 for success, 1 if the machine or the run fails or a file cannot be written, 2 if the call is invalid, 130 if the
//! user interrupted a run, 141 if the reader of standard output has closed it.

mod brachistochrone;
mod call;
mod check;
mod collisions;
mod compare;
mod contacts;
mod derive;
mod diagnostics;
mod drawing;
mod evaluate;
mod exactness;
mod exit;
mod failure;
mod fit;
mod fmu;
mod global_error;
mod heading;
mod host;
mod import;
mod inputs;
mod interrupt;
mod library;
mod linearize;
mod machine_in_chart;
mod map;
mod methods;
mod modes;
mod numbers;
mod orbit;
mod other_chart;
mod output;
mod peaks;
mod placed;
mod plot;
mod precise;
mod progress;
mod reading;
mod recording;
pub mod report;
mod runs;
mod section;
mod sensitivities;
mod simulate;
mod spectrum;
mod sweep;
mod table;
mod text_table;

use std::ffi::OsString;
use std::io;

use call::{Call, Command};
use failure::Failure;

pub use host::{Answer, answer};

/// 128 plus the number of SIGPIPE, the status with which other commands end after writing to a closed pipe.
const CLOSED_PIPE: u8 = 141;

/// Runs the command `lagrangian` with these arguments, of which the first is its name. It writes to the standard streams of the
/// process and handles its Ctrl-C. Returns the exit status.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let status = match Call::read(arguments) {
        Ok(call) => {
            // The result of `evaluate` is JSON in any case.
            let json =
                call.command.arguments().json() || matches!(call.command, Command::Evaluate(_));
            progress::begin(json);
            status(&call, json)
        }
        Err(message) => {
            let printed = message.print();
            // Help and version are results, written to standard output.
            if !message.use_stderr() {
                output::record_result(printed);
            }
            message.exit_code() as u8 // 2, or 0
        }
    };
    progress::end();
    match output::finish() {
        Ok(()) => status,
        // A reader that closes the pipe (`| head`) needs no more output.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => match status {
            0 => CLOSED_PIPE,
            status => status,
        },
        Err(error) => {
            output::print_error(format_args!(
                "error: cannot write to standard output: {error}"
            ));
            status.max(1)
        }
    }
}

/// Executes a call; returns the exit status.
fn status(call: &Call, json: bool) -> u8 {
    progress::now("deriving the equations");
    let result = call.check().map_err(Failure::Call);
    let result = result.and_then(|()| match &call.command {
        Command::Check(call) => check::run(call),
        Command::Derive(call) => derive::run(call),
        Command::Library(call) => library::run(call),
        Command::Fmu(call) => fmu::run(call),
        Command::Evaluate(call) => evaluate::run(call),
        Command::Simulate(call) => simulate::run(call),
        Command::Sweep(call) => sweep::run(call),
        Command::Map(call) => map::run(call),
        Command::Modes(call) => modes::run(call),
        Command::Linearize(call) => linearize::run(call),
        Command::Orbit(call) => orbit::run(call),
        Command::Sensitivities(call) => sensitivities::run(call),
        Command::Compare(call) => compare::run(call),
        Command::Spectrum(call) => spectrum::run(call),
        Command::Peaks(call) => peaks::run(call),
        Command::Section(call) => section::run(call),
        Command::Fit(call) => fit::run(call),
        Command::Brachistochrone(call) => brachistochrone::run(call),
        Command::Import(call) => import::run(call),
    });
    match result {
        Ok(()) => 0,
        Err(failure) => failure.report(json),
    }
}
