//! Arguments of `brachistochrone`.

use std::path::PathBuf;

use clap::Args;

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{Assignment, Running, Spec, assignment};

/// Arguments of `brachistochrone`.
#[derive(Debug, Args)]
pub struct Brachistochrone {
    #[command(flatten)]
    pub spec: Spec,
    /// Set a parameter, as in `--set mu1=0.1`, or an input.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub parameters: Vec<Assignment>,
    /// Where the motion starts, as in `--from q1=0,q2=0`; by default at the spec's start values.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, allow_hyphen_values = true)]
    pub from: Vec<Assignment>,
    /// Where the motion ends, as in `--to q1=8,q2=4.75`; coordinates that are not given take their values from `brachistochrone { … }`
    /// in the spec or, without that section, from the start.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, allow_hyphen_values = true)]
    pub to: Vec<Assignment>,
    /// Take the values of `--from` and `--to` as normal coordinates, in the order of the coordinates.
    #[arg(long)]
    pub natural: bool,
    /// Also search near this path: a table `.csv` with a column for each coordinate and a row for each position, as written by `--out`
    /// here and in `simulate`. Its ends are moved to the requested ones.
    #[arg(long, value_name = "FILE.csv")]
    pub guess: Option<PathBuf>,
    /// Write the motion to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the path, the power of friction, and the control forces as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Write a page that shows the motion beside that of the machine without control forces.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    #[command(flatten)]
    pub running: Running,
}

impl Arguments for Brachistochrone {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        names_in([
            ("--set", &self.parameters),
            ("--from", &self.from),
            ("--to", &self.to),
        ])
    }
}
