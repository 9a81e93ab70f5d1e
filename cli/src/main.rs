//! The command `lagrangian`: one command for each question about a machine.
//!
//! Exit status 0 when all is well, 1 when the machine or the run is at fault, 2 when the call is.

mod brachistochrone;
mod call;
mod check;
mod contacts;
mod derive;
mod diagnostics;
mod evaluate;
mod failure;
mod library;
mod modes;
mod output;
mod plot;
mod reading;
mod recording;
mod report;
mod simulate;
mod table;

use std::process::ExitCode;

use clap::Parser;

use call::{Call, Command};

fn main() -> ExitCode {
    let call = Call::parse();
    let (json, result) = match &call.command {
        Command::Check(call) => (call.spec.json, check::run(call)),
        Command::Derive(call) => (call.spec.json, derive::run(call)),
        Command::Library(call) => (call.spec.json, library::run(call)),
        // Its result is JSON in any case.
        Command::Evaluate(call) => (true, evaluate::run(call)),
        Command::Simulate(call) => (call.spec.json, simulate::run(call)),
        Command::Modes(call) => (call.spec.json, modes::run(call)),
        Command::Brachistochrone(call) => (call.spec.json, brachistochrone::run(call)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(json),
    }
}
