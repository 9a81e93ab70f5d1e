//! The command line as a user calls it.

mod brachistochrone;
mod browser;
mod collisions;
mod command_line;
mod compliance;
mod constraints;
mod contacts;
mod exported;
mod fit;
mod fmu;
mod impacts;
mod import;
mod library;
mod linearize;
mod map;
mod modes;
mod orbit;
mod parts;
mod report;
mod runs;
mod scripts;
mod signals;
mod states;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
mod time_stepping;
mod without_inertia;
