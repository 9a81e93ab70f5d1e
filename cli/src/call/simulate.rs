//! Arguments of `evaluate` and `simulate`.

use std::path::PathBuf;

use clap::Args;

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{
    Assignment, Keep, Precision, Spec, Start, assignment, count, interval, number, steps,
    wide_tolerance,
};

/// Arguments of `evaluate`.
#[derive(Debug, Args)]
pub struct Evaluate {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// A JSON list of points {"t", "q", "v", "states", "parameters", "inputs"}, or `-` for standard input; without it, the only point is
    /// the start.
    #[arg(long, value_name = "POINTS.json")]
    pub at: Option<PathBuf>,
}

impl Arguments for Evaluate {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        self.start.names()
    }
}

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Drive an input while the machine runs: by a formula in time, coordinates, rates, parameters, other inputs and outputs,
    /// `--input 'u=0.5*N*sin(10*rad/s*t)'`; by a controller that evaluates one every so often, `--input
    /// 'u=-5*N*s/m*der(x),every=1*ms,delay=0.2*ms'`; or by a table `.csv` or `.parquet` with columns `t` and the input's name,
    /// `--input u=table.csv[:COLUMN][,hold|linear|cubic][,end=hold|error|repeat]`.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// Integrate to this time, in s; if it is before 0, backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: f64,
    /// Relative and absolute tolerance of each step; by default 1e-9, and in double-double what its digits allow.
    #[arg(long, value_parser = wide_tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// The arithmetic of the run; in double-double the end is printed with 30 digits, for machines without constraints and contacts.
    #[arg(long, value_enum, value_name = "NUMBERS", default_value_t = Precision::F64)]
    pub precision: Precision,
    /// Enclose the motion: print bounds that are proved to contain it, for machines with a Taylor series and without constraints
    /// and contacts.
    #[arg(long, conflicts_with = "precision")]
    pub validated: bool,
    /// Estimate the error at the end of the run, from a run in double-double where the machine allows one, otherwise from a run at a
    /// finer tolerance.
    #[arg(long)]
    pub global_error: bool,
    /// The integration method: auto, which begins with dop853, and continues with taylor in a long run where this costs less, with radau5,
    /// radau9 or radau13 where the machine is stiff, and with moreau where contacts meet too often for each instant to be found; dop853,
    /// dopri5, bs32; radau5, radau9 and radau13 for stiff machines; taylor for smooth ones; or, in steps of --longest-step, moreau for many
    /// contacts that open and close, rk4, semi-implicit-euler, gauss4, gauss6, gauss8, rattle or generalized-alpha.
    #[arg(long, value_name = "NAME", default_value = "auto")]
    pub method: String,
    /// With auto: choose as one of this many runs, which share the derivation of a series; a row of a sweep of so many runs has the bits
    /// of this run.
    #[arg(long, value_name = "RUNS", value_parser = count, allow_hyphen_values = true)]
    pub one_of: Option<u64>,
    /// The maximum length of a step, in s; the length of all steps of methods that have no error control.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub longest_step: Option<f64>,
    /// The maximum number of steps of the run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Record the motion at this interval, in s; without it, 1000 times.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write the motion to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the motion as SVG: coordinates, outputs, energies, and the residual of the energy balance.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Write a page with an animation of the machine, its curves, parameters and equations; one file, for any browser.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Embed the machine in the page of --report, where sliders for parameters, inputs and start values run it again.
    #[arg(long, requires = "report")]
    pub live: bool,
}

impl Arguments for Simulate {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(names_in([("--input", &self.inputs)]));
        names
    }
}
