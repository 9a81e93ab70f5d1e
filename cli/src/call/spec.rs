//! Arguments that many commands share: the spec, start values, and how equations are evaluated.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lagrangian_spec::token::normalized;
use lagrangian_symbolic::Rational;

use super::{Assignment, assignment, constant, interval, positive, steps, tolerance};

/// Which machine, of which size.
#[derive(Debug, Args)]
pub struct Spec {
    /// The spec, a `.machine` file.
    #[arg(value_name = "SPEC")]
    pub path: PathBuf,
    /// Derive the machine with another value of a constant, as in `--const N=8`.
    #[arg(long = "const", value_name = "NAME=VALUE", value_parser = constant)]
    pub constants: Vec<(String, Rational)>,
    /// The parameters to which the call gives values: none of them follows from others.
    #[arg(skip)]
    pub given: Vec<String>,
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

/// Which parameters the machine has, and where it starts.
#[derive(Debug, Args)]
pub struct Start {
    /// Set a parameter, as in `--set omega=120` or `--set omega=1500*rpm`, or an input; a bare number is in the unit that the
    /// spec declares.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub parameters: Vec<Assignment>,
    /// Set a coordinate at the start, as in `--start phi=30*deg`; the name of a family sets every member.
    #[arg(long = "start", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub coordinates: Vec<Assignment>,
    /// Set the velocity of a coordinate at the start; 0 if not given.
    #[arg(long = "rate", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub rates: Vec<Assignment>,
    #[command(flatten)]
    pub running: Running,
}

impl Start {
    /// The parameters without the start, for a machine in other coordinates.
    pub fn parameters_alone(&self) -> Start {
        Start {
            parameters: self.parameters.clone(),
            coordinates: Vec::new(),
            rates: Vec::new(),
            running: self.running,
        }
    }
}

/// How it is run.
#[derive(Clone, Copy, Debug, Args)]
pub struct Running {
    /// How the equations are evaluated; the results are the same to the last bit.
    #[arg(long, value_enum, default_value_t = Engine::Auto)]
    pub engine: Engine,
}

/// What runs the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// The interpreter until machine code is worth compiling, or throughout where machine code is not available.
    Auto,
    /// The interpreter.
    Interpreter,
    /// Machine code from the first call on.
    Jit,
}

/// The numbers that a run is made in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// Double precision, with 53 bits.
    F64,
    /// Double-double: sums of two such numbers, with about 106 bits or 32 digits.
    Dd,
}

/// Which numbers of a start stay as they are.
#[derive(Debug, Args)]
pub struct Keep {
    /// If the start does not satisfy the constraints, keep these values, as in `--keep theta,der(phi)`, and correct the others: in
    /// place of those that the spec keeps; `none` keeps no value.
    #[arg(long = "keep", value_name = "NAME,…", value_delimiter = ',', value_parser = kept)]
    pub names: Vec<String>,
}

fn kept(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("expected the name of a coordinate, or der(NAME)".into()),
        name => Ok(normalized(name).into_owned()),
    }
}

/// How a spec is run that stands where a table may.
#[derive(Debug, Args)]
pub struct Runs {
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Derive a spec with another value of a constant, as in `--const N=8`.
    #[arg(long = "const", value_name = "NAME=VALUE", value_parser = constant)]
    pub constants: Vec<(String, Rational)>,
    /// Run a spec to this time, in s; if it is compared with a table, by default to the end of the table.
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Record a spec's motion at this interval, in s; without it, 1000 times. A spec that is compared with a table is recorded at its rows.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Relative and absolute tolerance of each step of a spec's run; by default 1e-9.
    #[arg(long, value_name = "TOLERANCE", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// The integration method of a spec's run: dop853, the default, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME")]
    pub method: Option<String>,
    /// The maximum number of steps of a spec's run; by default ten million.
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
