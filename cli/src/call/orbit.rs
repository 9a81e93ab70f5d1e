//! Arguments of `orbit` and `sensitivities`.

use std::path::PathBuf;

use clap::Args;

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{
    Assignment, Keep, Spec, Start, Vary, assignment, interval, number, positive, steps, tolerance,
    vary,
};

/// Arguments of `orbit`.
#[derive(Debug, Args)]
pub struct Orbit {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// The period, an expression of numbers, units and parameters, as in `--period 2*pi/omega`: that of the drive or a multiple of it
    /// or, for a machine that nothing drives, the period that the motion is to have.
    #[arg(
        long,
        value_name = "TIME",
        allow_hyphen_values = true,
        conflicts_with = "near"
    )]
    pub period: Option<String>,
    /// The approximate period, in s, for a machine that nothing drives; by default the time that the motion takes from the start until
    /// it comes closest to it again.
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub near: Option<f64>,
    /// How far a coordinate advances in a period, as in `--advance phi=2*pi`; by default it does not advance.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub advance: Vec<Assignment>,
    /// Coordinates on which nothing depends and that may advance by any amount in a period, as in `--shift y`; if neither this nor
    /// `--advance` is given, all of them.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = super::observed)]
    pub shift: Vec<String>,
    /// First let the motion run for this long, in s, so that it approaches an attracting orbit; with `--period`, for as many whole
    /// periods as this takes.
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub settle: Option<f64>,
    /// Relative and absolute tolerance of each step.
    #[arg(long, default_value = "1e-11", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// Follow the orbit along a range of a parameter or an input, as in `--along omega=10..300:200`.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true)]
    pub along: Option<Vary>,
    /// Write the orbit: `.json`, `.npz` for NumPy, `.mat` for MATLAB; `.csv` or `.parquet` for the motion over one period. With `--along`,
    /// a table `.csv` or `.parquet` with a row for each multiplier.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the motion over one period as SVG or, with `--along`, the moduli of the multipliers.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Orbit {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(names_in([("--advance", &self.advance)]));
        names
    }

    fn varied(&self) -> Result<Vec<String>, String> {
        Ok(self.along.iter().map(|along| along.name.clone()).collect())
    }
}

/// Arguments of `sensitivities`.
#[derive(Debug, Args)]
pub struct Sensitivities {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// What to differentiate with respect to: parameters, inputs, `start(x)`, `rate(x)`; the name of a family stands for all its members.
    #[arg(long, value_name = "NAME,…", required = true)]
    pub by: Vec<String>,
    /// What to differentiate: coordinates, `der(x)`, outputs; by default the outputs of the spec or, if it has none, its coordinates.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// Integrate to this time, in s; if it is before 0, backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: f64,
    /// Relative and absolute tolerance of each step, of the motion and of its derivatives.
    #[arg(long, default_value = "1e-9", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// The integration method: dop853, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    pub method: String,
    /// The maximum number of steps of the run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Record at this interval, in s; without it, 1000 times.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write values and derivatives to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the derivatives as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Sensitivities {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        self.start.names()
    }
}
