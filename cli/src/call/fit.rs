//! Arguments of `fit`.

use std::collections::BTreeSet;
use std::path::PathBuf;

use clap::Args;
use lagrangian_spec::token::normalized;

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{Assignment, Keep, Spec, Start, assignment, count, observed, steps, tolerance};
use crate::failure::Failure;

/// The most searches for `--starts`.
const MOST_SEARCHES: u64 = 10_000;

/// The names in the lists of an option.
///
/// # Errors
/// If one is not a name: the option, and what was expected.
pub fn names_of_option(option: &str, lists: &[String]) -> Result<Vec<String>, Failure> {
    names_of(lists).map_err(|why| Failure::Call(format!("{option}: {why}")))
}

/// Parses a number of searches.
fn searches(text: &str) -> Result<u64, String> {
    match count(text) {
        Ok(count) if count <= MOST_SEARCHES => Ok(count),
        _ => Err(format!("expected a whole number from 1 to {MOST_SEARCHES}")),
    }
}

/// The names in a list of outputs; the comma in `der(x,2)` is inside brackets.
pub fn names_of(lists: &[String]) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    for list in lists {
        let (mut depth, mut start) = (0_usize, 0);
        for (place, letter) in list.char_indices().chain([(list.len(), ',')]) {
            match letter {
                '(' | '[' => depth += 1,
                ')' | ']' => depth = depth.saturating_sub(1),
                ',' if depth == 0 || place == list.len() => {
                    names.push(observed(&list[start..place])?);
                    start = place + 1;
                }
                _ => {}
            }
        }
    }
    Ok(names)
}

/// Refuses a list of an option that names something twice, also by the name of its family.
///
/// # Errors
/// If a name occurs twice: which.
pub fn refuse_twice<'a>(
    option: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Result<(), String> {
    let mut seen = BTreeSet::new();
    match names.into_iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(format!("{option} names `{name}` more than once")),
        None => Ok(()),
    }
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct Fit {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// A measured motion: a table `.csv` or `.parquet` with `t` and columns named like those of a run, in which an empty cell means no
    /// measurement; repeat the option for each experiment. Values that apply to this experiment alone may follow: `--data
    /// 'run.csv,start(phi)=30*deg,load=2,torque=run.csv:u'`.
    #[arg(long, value_name = "FILE[,NAME=VALUE…]", required = true)]
    pub data: Vec<String>,
    /// What is fitted: parameters, and start values of coordinates as `start(phi)` and of rates as `rate(phi)`, separately for
    /// each experiment.
    #[arg(long = "fit", value_name = "NAME,…", required = true)]
    pub sought: Vec<String>,
    /// The range within which a fitted number is sought, as in `--bounds k=100..1e4`; one end may be omitted, as in `k=0..`.
    #[arg(long, value_name = "NAME=LEAST..GREATEST", value_parser = bounds, allow_hyphen_values = true)]
    pub bounds: Vec<Bounds>,
    /// The standard deviation of a measured column, as in `--sigma phi=0.5*deg`; or `--sigma auto`, which estimates those of all
    /// columns from their residuals.
    #[arg(long = "sigma", value_name = "NAME=VALUE|auto", value_parser = sigma, allow_hyphen_values = true)]
    pub sigmas: Vec<SigmaOption>,
    /// The columns to fit to; by default all that are coordinates, rates or outputs.
    #[arg(long, value_name = "NAME,…")]
    pub columns: Vec<String>,
    /// Drive an input in all experiments, as in `simulate`: by a formula, a controller or a table.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// The number of searches: the first from the values of the spec and the call, the others from values between the bounds, or within
    /// a factor of 3; the best result is reported.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = searches, allow_hyphen_values = true)]
    pub starts: u64,
    /// Relative and absolute tolerance of each step.
    #[arg(long, default_value = "1e-9", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// The integration method: dop853, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    pub method: String,
    /// The maximum number of steps of each run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Write a variant of the spec with the fitted values.
    #[arg(long, value_name = "FILE.machine")]
    pub out: Option<PathBuf>,
    /// Write measured and computed values and their residuals to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Draw measured and computed values, and the residuals, as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl Arguments for Fit {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(names_in([("--input", &self.inputs)]));
        names.extend(self.bounds.iter().map(|b| ("--bounds", b.name.as_str())));
        names.extend(self.sigmas.iter().map(|sigma| match sigma {
            SigmaOption::Estimated => ("--sigma", "auto"),
            SigmaOption::Given(set) => ("--sigma", set.name.as_str()),
        }));
        names
    }

    fn varied(&self) -> Result<Vec<String>, String> {
        names_of(&self.sought)
    }
}

/// `name=least..greatest`.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The name of the bounded number.
    pub name: String,
    /// The lower and the upper bound, if given.
    pub ends: [Option<Assignment>; 2],
}

fn bounds(text: &str) -> Result<Bounds, String> {
    let wanted = "expected NAME=LEAST..GREATEST, as in k=100..1e4, or k=0..";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (low, high) = range.split_once("..").ok_or(wanted)?;
    let name = match name.trim() {
        "" => return Err(wanted.into()),
        name => normalized(name).into_owned(),
    };
    let end = |value: &str| match value.trim() {
        "" => None,
        value => Some(Assignment {
            name: name.clone(),
            value: value.to_owned(),
        }),
    };
    let ends = [end(low), end(high)];
    match ends {
        [None, None] => Err(wanted.into()),
        ends => Ok(Bounds { name, ends }),
    }
}

/// A parsed `--sigma`.
#[derive(Clone, Debug, PartialEq)]
pub enum SigmaOption {
    /// Standard deviations are estimated.
    Estimated,
    /// One standard deviation is given.
    Given(Assignment),
}

fn sigma(text: &str) -> Result<SigmaOption, String> {
    match text.trim() {
        "auto" => Ok(SigmaOption::Estimated),
        text => Ok(SigmaOption::Given(
            assignment(text).map_err(|_| "expected NAME=VALUE, or `auto`")?,
        )),
    }
}
