//! Arguments of commands that analyse runs, existing ones or runs made for the analysis.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lagrangian::Crossing;

use super::arguments::{Arguments, SetName, names_in};
use super::{Assignment, Runs, assignment, count, number, positive, tolerance};

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Compare {
    /// The first run, relative to whose range differences are reported: a table `.csv` or `.parquet`, or a spec.
    #[arg(value_name = "FIRST")]
    pub first: PathBuf,
    /// The second run.
    #[arg(value_name = "SECOND")]
    pub second: PathBuf,
    #[command(flatten)]
    pub runs: Runs,
    /// Set a parameter or an input of the second run, if that is a spec, in place of the value from `--set`.
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
    /// The quantities to compare; by default all that both runs have, except the residual of the energy balance.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// How values between rows are interpolated: `cubic`, with the rates of a coordinate where the table has them, or `linear`.
    #[arg(long, value_enum, default_value_t = Interpolation::Cubic)]
    pub interpolation: Interpolation,
    /// Exit with status 1 if a quantity differs by more than this fraction of its range, as in `--within 1e-6`.
    #[arg(long, value_name = "SHARE", value_parser = positive, allow_hyphen_values = true)]
    pub within: Option<f64>,
    /// Differences that `--within` accepts whatever the range is, in the unit of the quantity.
    #[arg(long, value_name = "NUMBER", value_parser = positive, requires = "within", allow_hyphen_values = true)]
    pub floor: Option<f64>,
    /// Write the differences to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw both runs and their differences as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Compare {
    fn runs(&self) -> Option<&Runs> {
        Some(&self.runs)
    }

    fn own_names(&self) -> Vec<SetName<'_>> {
        names_in([
            ("--set-second", &self.second_parameters),
            ("--start-second", &self.second_coordinates),
            ("--rate-second", &self.second_rates),
        ])
    }
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
    /// The quantities to analyse; by default the coordinates, which in a table are the columns that have a column of rates.
    #[arg(long, value_name = "NAME,…")]
    pub of: Vec<String>,
    /// Analyse the run from this time on, in s.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub after: Option<f64>,
}

/// Arguments of `spectrum`.
#[derive(Debug, Args)]
pub struct Spectrum {
    #[command(flatten)]
    pub part: Part,
    /// The window by which values are multiplied before they are transformed.
    #[arg(long, value_enum, default_value_t = Windows::Hann)]
    pub window: Windows,
    /// The maximum number of lines to report.
    #[arg(long, value_name = "N", default_value = "8", value_parser = count, allow_hyphen_values = true)]
    pub lines: u64,
    /// Leave out lines below this fraction of the greatest one.
    #[arg(long, value_name = "SHARE", default_value = "1e-3", value_parser = positive, allow_hyphen_values = true)]
    pub least: f64,
    /// Write the amplitudes to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the amplitudes over the frequency as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Spectrum {
    fn runs(&self) -> Option<&Runs> {
        Some(&self.part.runs)
    }
}

/// Windows of spectra.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Windows {
    /// The Hann window, for most purposes.
    Hann,
    /// No window, for whole periods.
    None,
    /// The Blackman–Harris window, for lines that are a ten-thousandth of others.
    BlackmanHarris,
}

/// Arguments of `peaks`.
#[derive(Debug, Args)]
pub struct Peaks {
    #[command(flatten)]
    pub part: Part,
    /// Leave out ripples: maxima and minima from which the curve departs to one side by no more than this, in the unit of the quantity;
    /// by default an estimate of the error of one step.
    #[arg(long, value_name = "NUMBER", value_parser = positive, allow_hyphen_values = true)]
    pub ripple: Option<f64>,
    /// Write all maxima and minima to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

impl Arguments for Peaks {
    fn runs(&self) -> Option<&Runs> {
        Some(&self.part.runs)
    }
}

/// Arguments of `section`.
#[derive(Debug, Args)]
pub struct Section {
    #[command(flatten)]
    pub part: Part,
    /// Sample once in each period, as in `--every-period 2*pi/omega`: for a spec an expression of parameters, for a table a number in s.
    #[arg(
        long = "every-period",
        value_name = "TIME",
        allow_hyphen_values = true,
        conflicts_with = "crossing"
    )]
    pub period: Option<String>,
    /// Sample where a quantity passes 0 or, with `NAME=VALUE`, this value: for a spec any formula of its language, for a table a column.
    #[arg(long, value_name = "FORMULA|NAME=VALUE", allow_hyphen_values = true)]
    pub crossing: Option<String>,
    /// The direction in which it passes.
    #[arg(long, value_enum, default_value_t = Direction::Up, conflicts_with = "period")]
    pub direction: Direction,
    /// Write the points to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the points as SVG: the second quantity of `--of` over the first; by default the rate of the first coordinate over it.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Section {
    fn runs(&self) -> Option<&Runs> {
        Some(&self.part.runs)
    }
}

/// In which direction something passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Direction {
    /// Upward, from less to greater.
    Up,
    /// Downward, from greater to less.
    Down,
    /// In both directions.
    Both,
}

impl Direction {
    /// The crossing of zero, of a function, in this direction.
    pub fn crossing(self) -> Crossing {
        match self {
            Direction::Up => Crossing::Rising,
            Direction::Down => Crossing::Falling,
            Direction::Both => Crossing::Any,
        }
    }
}
