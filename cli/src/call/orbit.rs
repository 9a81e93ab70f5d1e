//! Arguments of `orbit` and `sensitivities`.

use std::path::PathBuf;

use clap::Args;

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
    /// The period, an expression of numbers, units and parameters, as in `--period 2*pi/omega`: that of what drives the machine or a
    /// multiple of it; or, of a machine that nothing drives, that which the motion is to have.
    #[arg(
        long,
        value_name = "TIME",
        allow_hyphen_values = true,
        conflicts_with = "near"
    )]
    pub period: Option<String>,
    /// About how long the period is, in s, of a machine that nothing drives; where left out, as long as the motion takes from the
    /// start to where it comes nearest to it.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub near: Option<f64>,
    /// What a coordinate goes on by in a period, as in `--advance phi=2*pi`; nothing where left out.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub advance: Vec<Assignment>,
    /// Coordinates on which nothing depends and that go on in a period as far as they do, as in `--shift y`; where neither this nor
    /// `--advance` is given all of them.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = super::observed)]
    pub shift: Vec<String>,
    /// Let the motion run for this long first, in s, so that an orbit that attracts is near; with `--period` for as many whole periods
    /// as that takes.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub settle: Option<f64>,
    /// Relative and absolute tolerance of each step.
    #[arg(long, default_value_t = 1e-11, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// Follow the orbit along values of a parameter or an input, as in `--along omega=10..300:200`.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true)]
    pub along: Option<Vary>,
    /// Write the orbit: `.json`, `.npz` for NumPy, `.mat` for MATLAB; `.csv` or `.parquet` for the motion over one period. Along a range a
    /// table `.csv` or `.parquet` with a row for each multiplier.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the motion over one period as SVG; along a range the moduli of the multipliers.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
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
    /// By what: parameters, inputs, `start(x)`, `rate(x)`; the name of a family stands for all its members.
    #[arg(long, value_name = "NAME,…", required = true)]
    pub by: Vec<String>,
    /// Of what: coordinates, `der(x)`, outputs; where left out the outputs of the spec, or, if it has none, its coordinates.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// Integrate to this time, in s; before 0 backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: f64,
    /// Relative and absolute tolerance of each step, of the motion and of its derivatives.
    #[arg(long, default_value_t = 1e-9, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// The integration method: dop853, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    pub method: String,
    /// How many steps the run may take.
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
