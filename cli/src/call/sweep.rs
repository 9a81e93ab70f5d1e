//! Arguments of `sweep` and `map`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{Assignment, Keep, Spec, Start, assignment, count, number, steps, tolerance};
use crate::heading;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Integrate each run to this time, in s; if it is before 0, backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Relative and absolute tolerance of each step; by default 1e-9.
    #[arg(long, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// The integration method: auto, the default, with which each run chooses its methods as in `simulate`; dop853, dopri5, bs32, radau5 for stiff machines, or
    /// taylor for smooth ones.
    #[arg(long, value_name = "NAME")]
    pub method: Option<String>,
    /// The maximum number of steps of each run; by default ten million.
    #[arg(long, value_name = "N", value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: Option<usize>,
    /// Vary a parameter, an input, `start(q)` or `rate(q)`: `omega=50..150:101` (101 values; append `:log` for a geometric grid),
    /// `omega=50,60,90`, or, to be sampled, `omega=50..150`, `omega~normal(100,5)`, `~uniform(a,b)`, `~loguniform(a,b)`,
    /// `~triangular(a,b,peak)`. Several are combined as a full grid, in which the last one changes fastest.
    #[arg(long, value_name = "NAME=VALUES", allow_hyphen_values = true)]
    pub vary: Vec<String>,
    /// The number of sets of values to sample from the given ranges and distributions.
    #[arg(long, value_name = "N", value_parser = count, allow_hyphen_values = true)]
    pub samples: Option<u64>,
    /// How values are sampled; by default `sobol`.
    #[arg(long, value_enum)]
    pub design: Option<Design>,
    /// The seed of the sampling; 0, the default, gives the Sobol sequence itself.
    #[arg(long, value_parser = seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,
    /// Take the values of these together, the first with the first and so on, instead of crossing them, as in `--together m,omega`.
    #[arg(long, value_name = "NAME,…")]
    pub together: Vec<String>,
    /// Take the runs from a table `.csv` or `.parquet`: one row for each run, with columns named after what is varied.
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Drive an input while the machine runs: by a formula in time, coordinates, rates, parameters, other inputs and outputs,
    /// `--input 'u=0.5*N*sin(10*rad/s*t)'`; by a controller that evaluates one every so often, `--input
    /// 'u=-5*N*s/m*der(x),every=1*ms,delay=0.2*ms'`; or by a table `.csv` or `.parquet` with columns `t` and the input's name,
    /// `--input u=table.csv[:COLUMN][,hold|linear|cubic][,end=hold|error|repeat]`.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// Watch for sign changes of a formula, as in `--event top=theta-pi`.
    #[arg(long = "event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub events: Vec<Assignment>,
    /// End the run at the first instant at which a formula changes sign.
    #[arg(long = "until-event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub ends: Vec<Assignment>,
    /// What is recorded of the motion besides its end: `at=0.5,1` records the states at these times; `every=0.01` writes samples to a
    /// second file, and `event=NAME` a sample at every event of that name.
    #[arg(long, value_name = "end|at=T,…|every=T|event=NAME,…")]
    pub record: Vec<String>,
    /// Reduce each motion to a number, as in `--reduce 'peak = max(abs(x))'`: max, min, range, mean, rms, integral, first, last,
    /// when_max, when_min of a formula; count, first, last of an event.
    #[arg(long = "reduce", value_name = "NAME=F(FORMULA)", value_parser = assignment, allow_hyphen_values = true)]
    pub reductions: Vec<Assignment>,
    /// Ignore the motion before this time, in s, in these reductions.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub after: Option<f64>,
    /// Where the rows are written: a table `.csv` or `.parquet`, or a folder, in which the chunks remain. An interrupted sweep is resumed.
    #[arg(long, value_name = "FILE|FOLDER")]
    pub out: Option<PathBuf>,
    /// Start over, even if part of the sweep already exists.
    #[arg(long)]
    pub fresh: bool,
    /// The number of threads; by default one for each core.
    #[arg(long, value_name = "N", value_parser = count, allow_hyphen_values = true)]
    pub threads: Option<u64>,
    /// Stop after this many runs, rounded up to whole chunks; the same command resumes the sweep.
    #[arg(long, value_name = "RUNS", value_parser = count, allow_hyphen_values = true)]
    pub limit: Option<u64>,
    /// Write the plan without running it. `lagrangian sweep PLAN.json` then runs it.
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["out", "fresh", "threads", "limit", "strict"])]
    pub plan: Option<PathBuf>,
    /// Run only this chunk of a plan, for job arrays: `lagrangian sweep PLAN.json --chunk 17 --out FOLDER`.
    #[arg(long, value_name = "K")]
    pub chunk: Option<u64>,
    /// Exit with status 1 if a run failed.
    #[arg(long)]
    pub strict: bool,
}

impl Arguments for Sweep {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(names_in([
            ("--input", &self.inputs),
            ("--event", &self.events),
            ("--until-event", &self.ends),
            ("--reduce", &self.reductions),
        ]));
        names
    }

    fn varied(&self) -> Result<Vec<String>, String> {
        let ends = ['=', '~'];
        let varied = self.vary.iter().filter_map(|text| text.split(ends).next());
        let mut names: Vec<String> = varied.map(|name| name.trim().to_owned()).collect();
        let table = self.table.iter();
        names.extend(table.flat_map(|path| heading::names_in(path)));
        Ok(names)
    }
}

/// Arguments of `map`.
#[derive(Debug, Args)]
pub struct Map {
    /// The rows of a sweep, `.csv` or `.parquet`.
    #[arg(value_name = "TABLE")]
    pub table: PathBuf,
    /// The columns of the table to plot, as in `--of peak,effort`.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    pub of: Vec<String>,
    /// The varied parameters to plot over: curves over one, colours over two; all of them if not given.
    #[arg(long, value_name = "NAME[,NAME]", value_delimiter = ',')]
    pub over: Vec<String>,
    /// Plot only the rows with this value, as in `--only m2=0.5`.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub only: Vec<Assignment>,
    /// Plot the samples that belong to the table, one dot each: a bifurcation diagram if they were recorded at events.
    #[arg(long)]
    pub samples: bool,
    /// The drawing.
    #[arg(long, value_name = "FILE.svg", required_unless_present = "report")]
    pub plot: Option<PathBuf>,
    /// A page that shows the numbers under the pointer and can enlarge parts of the drawing.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
}

impl Arguments for Map {
    fn own_names(&self) -> Vec<SetName<'_>> {
        names_in([("--only", &self.only)])
    }
}

/// How values are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Design {
    /// Independent random samples.
    Random,
    /// A Latin hypercube: as many strata of each variable as there are sets, with one value in each.
    Latin,
    /// The Sobol sequence, which fills the range evenly.
    Sobol,
}

/// Parses a seed.
fn seed(text: &str) -> Result<u64, String> {
    let number = text.trim().parse();
    number.map_err(|_| "expected a whole number from 0 to 2^64 - 1".into())
}
