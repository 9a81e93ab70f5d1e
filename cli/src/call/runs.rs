//! Arguments of commands that analyse runs, existing ones or runs made for the analysis.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lagrangian_symbolic::Rational;

use super::{
    Assignment, Keep, Start, assignment, constant, interval, number, positive, steps, tolerance,
};

/// How a spec is run that stands where a table may.
#[derive(Debug, Args)]
pub struct Runs {
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Derive a spec with another value of a constant, as in `--const N=8`.
    #[arg(long = "const", value_name = "NAME=VALUE", value_parser = constant)]
    pub constants: Vec<(String, Rational)>,
    /// Run a spec to this time, in s; with a table beside it, to the end of the table where left out.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub until: Option<f64>,
    /// Record a spec's motion at this interval, in s; without it, 1000 times, or at the rows of the table beside it.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Relative and absolute tolerance of each step of a spec's run; 1e-9 where left out.
    #[arg(long, value_name = "TOLERANCE", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// The integration method of a spec's run: dop853, which is taken where left out, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME")]
    pub method: Option<String>,
    /// How many steps a spec's run may take; ten million where left out.
    #[arg(long, value_name = "N", value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: Option<usize>,
    /// Drive an input while a spec runs, as in `simulate`.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
}

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// The first run, by whose range differences are measured: a table `.csv` or `.parquet`, or a spec.
    #[arg(value_name = "FIRST")]
    pub first: PathBuf,
    /// The second run.
    #[arg(value_name = "SECOND")]
    pub second: PathBuf,
    #[command(flatten)]
    pub runs: Runs,
    /// Set a parameter or an input of the second run, a spec, in place of what `--set` says of it.
    #[arg(long = "set-second", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub second_parameters: Vec<Assignment>,
    /// Set a coordinate at the start of the second run.
    #[arg(long = "start-second", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub second_coordinates: Vec<Assignment>,
    /// Set the velocity of a coordinate at the start of the second run.
    #[arg(long = "rate-second", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub second_rates: Vec<Assignment>,
    /// The tolerance of the second run.
    #[arg(long = "tolerance-second", value_name = "TOLERANCE", value_parser = tolerance, allow_hyphen_values = true)]
    pub second_tolerance: Option<f64>,
    /// The integration method of the second run.
    #[arg(long = "method-second", value_name = "NAME")]
    pub second_method: Option<String>,
    /// Which quantities are compared; where left out all that both runs have, but for the residual of the energy balance.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// How values between rows are found: `cubic`, with the rates of a coordinate where the table has them, or `linear`.
    #[arg(long, value_enum, default_value_t = Interpolation::Cubic)]
    pub interpolation: Interpolation,
    /// End with exit status 1 where a quantity differs by more than this share of its range, as in `--within 1e-6`.
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    pub within: Option<f64>,
    /// What `--within` lets pass whatever the range is: differences of so much in the unit of the quantity.
    #[arg(long, value_name = "NUMBER", value_parser = positive, requires = "within")]
    pub floor: Option<f64>,
    /// Write the differences to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw both runs and their differences as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

/// How values between rows are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Interpolation {
    /// By cubics.
    Cubic,
    /// By straight lines.
    Linear,
}

/// Which part of one run is looked at.
#[derive(Debug, Args)]
pub struct Part {
    /// The run: a table `.csv` or `.parquet`, or a spec.
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
    #[command(flatten)]
    pub runs: Runs,
    /// Look at these quantities; at the coordinates where left out, and of a table at every column that has one of rates.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// Look at the run from this time on, in s.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub after: Option<f64>,
}

/// Arguments of `spectrum`.
#[derive(Debug, Args)]
pub struct Spectrum {
    #[command(flatten)]
    pub part: Part,
    /// By what values are multiplied before they are transformed.
    #[arg(long, value_enum, default_value_t = Windows::Hann)]
    pub window: Windows,
    /// How many lines are told at most.
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub lines: usize,
    /// Lines below this share of the greatest are not told.
    #[arg(long, value_name = "SHARE", default_value_t = 1e-3, value_parser = positive)]
    pub least: f64,
    /// Write the amplitudes to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the amplitudes over the frequency as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

/// Windows of spectra.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Windows {
    /// Hann's: for most.
    Hann,
    /// None: for whole periods.
    None,
    /// Blackman's and Harris's: for lines a ten-thousandth of others.
    BlackmanHarris,
}

/// Arguments of `peaks`.
#[derive(Debug, Args)]
pub struct Peaks {
    #[command(flatten)]
    pub part: Part,
    /// Leave out ripples: maxima and minima from which the curve goes to one side by no more than this, in the unit of the quantity;
    /// where left out, an estimate of the error of one step.
    #[arg(long, value_name = "NUMBER", value_parser = positive)]
    pub ripple: Option<f64>,
    /// Write all maxima and minima to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `section`.
#[derive(Debug, Args)]
pub struct Section {
    #[command(flatten)]
    pub part: Part,
    /// Look once every so often, as in `--every-period 2*pi/omega`: of a spec an expression of parameters, of a table a number in s.
    #[arg(
        long = "every-period",
        value_name = "TIME",
        allow_hyphen_values = true,
        conflicts_with = "crossing"
    )]
    pub period: Option<String>,
    /// Look where something passes 0, or with `NAME=VALUE` this value: of a spec any formula of its language, of a table a column.
    #[arg(long, value_name = "FORMULA|NAME=VALUE", allow_hyphen_values = true)]
    pub crossing: Option<String>,
    /// In which direction it passes.
    #[arg(long, value_enum, default_value_t = Direction::Up)]
    pub direction: Direction,
    /// Write the points to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the points as SVG: the second quantity of `--of` over the first; where left out the rate of the first coordinate over it.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

/// In which direction something passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Direction {
    /// From less to greater.
    Up,
    /// From greater to less.
    Down,
    /// In both.
    Both,
}
