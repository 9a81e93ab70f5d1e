//! The command line as a user calls it.

mod books;
mod brachistochrone;
mod browser;
mod choosing;
mod collisions;
mod command_line;
mod compliance;
mod constraints;
mod contacts;
mod derived_parameters;
mod exported;
mod fit;
mod fmu;
mod host;
mod impacts;
mod import;
mod in_space;
mod library;
mod linearize;
mod map;
mod modes;
mod orbit;
mod parts;
mod precise;
mod report;
mod rolling;
mod runs;
mod scripts;
mod signals;
mod states;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
mod tables;
mod time_stepping;
mod without_inertia;
