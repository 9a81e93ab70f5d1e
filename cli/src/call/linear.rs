//! Arguments of `modes` and `linearize`.

use std::path::PathBuf;

use clap::Args;
use lagrangian_spec::token::normalized;

use super::arguments::{Arguments, SetName, with_spec};
use super::{Assignment, Keep, Spec, Start, assignment, number};

/// Where an equilibrium or a steady motion is sought.
#[derive(Debug, Args)]
pub struct Search {
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Let a coordinate turn at a constant rate, as in `--steady phi=150`; without a number, at its rate at the start; with
    /// `phi=solve`, at a rate that is to be found.
    #[arg(long = "steady", value_name = "NAME[=RATE]", value_parser = steady, allow_hyphen_values = true)]
    pub steady: Vec<Steady>,
}

impl Search {
    /// The names that it sets.
    fn names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(self.steady.iter().map(|s| ("--steady", s.name.as_str())));
        names
    }
}

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub struct Modes {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub search: Search,
    /// Follow the motion along a range of a parameter, an input, or the rate of a coordinate, as in `--vary roll=0..10:101`, and report
    /// the values at which modes change their kind.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true)]
    pub vary: Option<Vary>,
    /// Write the motions along `--vary` to a table, `.csv` or `.parquet`, with a row for each mode.
    #[arg(long, value_name = "FILE", requires = "vary")]
    pub out: Option<PathBuf>,
    /// Draw frequencies and growth rates along `--vary`, and the root locus, as SVG.
    #[arg(long, value_name = "FILE.svg", requires = "vary")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Modes {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        self.search.names()
    }

    fn varied(&self) -> Result<Vec<String>, String> {
        Ok(self.vary.iter().map(|vary| vary.name.clone()).collect())
    }
}

/// Arguments of `linearize`.
#[derive(Debug, Args)]
pub struct Linearize {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub search: Search,
    /// Linearize about the start as it is, with its rates, whether or not the machine stays there.
    #[arg(long, conflicts_with_all = ["steady", "along"])]
    pub here: bool,
    /// The inputs of the model; all inputs of the machine if not given.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = observed)]
    pub inputs: Vec<String>,
    /// The outputs of the model: outputs of the spec, coordinates, `der(x)`, `der(x,2)`, `multiplier(rod)`; by default the outputs of the
    /// spec or, if it has none, its coordinates.
    #[arg(long, value_name = "NAME,…")]
    pub outputs: Vec<String>,
    /// Write the model: `.json`, `.npz` for NumPy, `.mat` for MATLAB, or `.csv`, a file for each matrix, NAME.A.csv and so on.
    /// With `--along`, a table `.csv` or `.parquet` with a row for each eigenvalue.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw gain and phase over the frequency, from each input to each output, as SVG.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "along")]
    pub bode: Option<PathBuf>,
    /// Draw the frequency response in the complex plane, from each input to each output, as SVG.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "along")]
    pub nyquist: Option<PathBuf>,
    /// Follow the eigenvalues along a range of a parameter, an input, or the rate of a coordinate, as in
    /// `--along omega=10..300:200`.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true, requires = "out",
        conflicts_with_all = ["inputs", "outputs"])]
    pub along: Option<Vary>,
}

impl Arguments for Linearize {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        self.search.names()
    }

    fn varied(&self) -> Result<Vec<String>, String> {
        Ok(self.along.iter().map(|along| along.name.clone()).collect())
    }
}

pub(super) fn observed(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("expected a name".into()),
        name => Ok(normalized(name).into_owned()),
    }
}

/// `name=from..to:count`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// The name of the varied quantity.
    pub name: String,
    /// The first and the last value.
    pub ends: [Assignment; 2],
    /// The number of values; at least 2.
    pub count: usize,
}

impl Vary {
    /// The values in a unit, at equal intervals from the first to the last.
    ///
    /// # Errors
    /// If an end is invalid, or both are the same.
    pub fn values(&self, option: &str, unit: &str) -> Result<Vec<f64>, String> {
        let [from, to] = &self.ends;
        let (from, to) = (from.value(option, unit)?, to.value(option, unit)?);
        if from == to {
            return Err(format!(
                "{option} {}: the range from {from} to {to} is empty",
                self.name
            ));
        }
        let last = self.count - 1;
        let value = |k: usize| match k {
            _ if k == last => to,
            _ => from + (to - from) * (k as f64 / last as f64),
        };
        Ok((0..=last).map(value).collect())
    }
}

/// The most values of a continuation: more than a drawing can resolve.
const MOST_VALUES: f64 = 1e5;

/// Reads `name=from..to:count`.
pub(super) fn vary(text: &str) -> Result<Vary, String> {
    let wanted = "expected NAME=FROM..TO:COUNT, as in roll=0..10:101";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (range, count) = range.rsplit_once(':').ok_or(wanted)?;
    let (from, to) = range.split_once("..").ok_or(wanted)?;
    let end = |value: &str| assignment(&format!("{name}={value}"));
    let ends = [end(from)?, end(to)?];
    let values = number(count)?;
    if !(2.0..=MOST_VALUES).contains(&values) || values.fract() != 0.0 {
        return Err(format!(
            "`{}` is not a valid number of values: expected a whole number from 2 to {MOST_VALUES}",
            count.trim()
        ));
    }
    Ok(Vary {
        name: ends[0].name.clone(),
        ends,
        count: values as usize,
    })
}

/// `name`, `name=rate` or `name=solve`.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// The name of a coordinate.
    pub name: String,
    /// Its rate.
    pub rate: SteadyRate,
}

/// The rate of a coordinate that moves steadily.
#[derive(Clone, Debug, PartialEq)]
pub enum SteadyRate {
    /// The rate of the start.
    Start,
    /// A value.
    Given(Assignment),
    /// The rate that balances the machine, which is to be found.
    Solved,
}

fn steady(text: &str) -> Result<Steady, String> {
    if !text.contains('=') {
        let name = normalized(text.trim()).into_owned();
        let rate = SteadyRate::Start;
        return if name.is_empty() {
            Err("expected the name of a coordinate".into())
        } else {
            Ok(Steady { name, rate })
        };
    }
    let set = assignment(text)?;
    let name = set.name.clone();
    let rate = match set.value.as_str() {
        "solve" => SteadyRate::Solved,
        _ => SteadyRate::Given(set),
    };
    Ok(Steady { name, rate })
}
