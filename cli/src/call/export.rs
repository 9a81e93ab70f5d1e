//! Arguments of `library` and `fmu`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::arguments::{Arguments, SetName, names_in, with_spec};
use super::{Assignment, Spec, assignment, lanes, tolerance};

/// Arguments of `library`.
#[derive(Debug, Args)]
pub struct Library {
    #[command(flatten)]
    pub spec: Spec,
    /// Where to write the library; its C header is written beside it.
    #[arg(long, value_name = "FILE.so")]
    pub out: PathBuf,
    /// The numbers of states that further functions besides `eval` evaluate at once: 2, 4, 8, or several of them, as in
    /// `--lanes 4,8`.
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "4", value_parser = lanes)]
    pub lanes: Vec<u8>,
    /// The processor to compile for, as rustc names it: x86-64-v3 for any processor with AVX2.
    #[arg(long, value_name = "NAME", default_value = "native")]
    pub target_cpu: String,
    /// Also write the single Rust file from which it is compiled.
    #[arg(long, value_name = "FILE.rs")]
    pub source: Option<PathBuf>,
    /// Write repeated parts out instead of as loops: longer code with bitwise the same results.
    #[arg(long)]
    pub straight: bool,
}

impl Arguments for Library {
    with_spec!();
}

/// Arguments of `fmu`.
#[derive(Debug, Args)]
pub struct Fmu {
    #[command(flatten)]
    pub spec: Spec,
    /// Where to write the unit.
    #[arg(long, value_name = "FILE.fmu")]
    pub out: PathBuf,
    /// Which version of the interface: 3 or 2.
    #[arg(long, value_name = "VERSION", default_value = "3", value_parser = clap::value_parser!(u8).range(2..=3))]
    pub fmi: u8,
    /// The interfaces of the unit: model exchange (`me`), co-simulation (`cs`), or both, which is the default, except for machines with contacts or
    /// guides, whose units have co-simulation only.
    #[arg(long, value_name = "KIND,…", value_enum, value_delimiter = ',')]
    pub kind: Option<Vec<UnitKind>>,
    /// The variables that are outputs, as in `--outputs theta1,energy.kinetic`, in place of the outputs of the spec or the coordinates.
    #[arg(long, value_name = "NAME,…", value_parser = names)]
    pub outputs: Option<Names>,
    /// Watch for sign changes of a formula, as in `--event low=theta1`: an event indicator for importers that integrate, and an output
    /// `event.low` that counts them.
    #[arg(long = "event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub events: Vec<Assignment>,
    /// The integration method of the unit in co-simulation: `dop853` of order 8, the default, or `dopri5` of order 5, whose steps are cheaper, for
    /// communication points that are close together.
    #[arg(long, value_enum)]
    pub method: Option<UnitMethod>,
    /// Relative and absolute tolerance of co-simulation, unless the importer gives one.
    #[arg(long, default_value = "1e-9", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// Change the default of a parameter or an input, as in `--set omega=120`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub parameters: Vec<Assignment>,
    /// Change the start value of a coordinate.
    #[arg(long = "start", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub coordinates: Vec<Assignment>,
    /// Change the velocity of a coordinate at the start.
    #[arg(long = "rate", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub rates: Vec<Assignment>,
    /// The C compiler, in place of `cc` or the one that the variable CC names.
    #[arg(long, value_name = "COMMAND")]
    pub cc: Option<String>,
    /// Build libraries for these platforms instead of this one, as in `--target x86_64-linux-gnu,x86_64-windows-gnu`: the compiler is
    /// called with `--target=TRIPLE`, as Clang expects it, or with the triple in place of `{}` in --cc, as in `--cc '{}-gcc'`.
    #[arg(
        long,
        value_name = "TRIPLE,…",
        value_delimiter = ',',
        conflicts_with = "sources_only"
    )]
    pub target: Vec<String>,
    /// Include no library, for importers that compile the sources.
    #[arg(long, conflicts_with = "cc")]
    pub sources_only: bool,
}

impl Arguments for Fmu {
    with_spec!();

    fn own_names(&self) -> Vec<SetName<'_>> {
        names_in([
            ("--set", &self.parameters),
            ("--start", &self.coordinates),
            ("--rate", &self.rates),
            ("--event", &self.events),
        ])
    }
}

/// Names separated by commas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names(pub Vec<String>);

/// Parses names separated by commas; `der(q,2)` and quoted text are one name.
pub(super) fn names(text: &str) -> Result<Names, String> {
    let (mut names, mut depth, mut quoted) = (vec![String::new()], 0, false);
    for c in text.chars() {
        match c {
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth -= 1,
            '\'' => quoted = !quoted,
            ',' if !quoted && depth == 0 => {
                names.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(name) = names.last_mut() {
            name.push(c);
        }
    }
    let names: Vec<String> = names.iter().map(|name| name.trim().to_owned()).collect();
    if names.iter().any(String::is_empty) {
        Err("expected names, with commas between them".into())
    } else {
        Ok(Names(names))
    }
}

/// Who integrates a functional mock-up unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitKind {
    /// Model exchange: the importer integrates.
    #[value(name = "me")]
    ModelExchange,
    /// Co-simulation: the unit integrates.
    #[value(name = "cs")]
    CoSimulation,
}

impl UnitKind {
    /// The name in `--kind`.
    pub fn name(self) -> &'static str {
        match self {
            UnitKind::ModelExchange => "me",
            UnitKind::CoSimulation => "cs",
        }
    }

    /// The name in the standard.
    pub fn words(self) -> &'static str {
        match self {
            UnitKind::ModelExchange => "model exchange",
            UnitKind::CoSimulation => "co-simulation",
        }
    }
}

/// How a unit integrates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitMethod {
    /// Dormand and Prince's method of order 8.
    Dop853,
    /// Dormand and Prince's method of order 5.
    Dopri5,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comma_between_brackets_is_part_of_a_name() {
        let list = |text: &str| names(text).map(|Names(names)| names);
        let three = ["q", "der(q,2)", "'assume(max(a, b) > 0)'"].map(str::to_owned);
        assert_eq!(
            list("q, der(q,2),'assume(max(a, b) > 0)'"),
            Ok(three.to_vec())
        );
        assert!(list("q,,v").is_err());
    }
}
