//! Arguments of `check` and `derive`.

use std::path::PathBuf;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use lagrangian_languages::script::{DIALECTS, Dialect};

use super::Spec;
use super::arguments::{Arguments, with_spec};

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub spec: Spec,
    /// Exit with status 1 if there are warnings.
    #[arg(long)]
    pub deny_warnings: bool,
    /// Exit with status 1 if a published formula differs from the derived one.
    #[arg(long)]
    pub strict: bool,
    /// Measure the accuracy of the machine's program by comparison with arithmetic of 30 digits.
    #[arg(long)]
    pub accuracy: bool,
}

impl Arguments for Check {
    with_spec!();
}

/// Arguments of `derive`.
#[derive(Debug, Args)]
pub struct Derive {
    #[command(flatten)]
    pub spec: Spec,
    /// The form of the output.
    #[arg(long = "as", value_enum, default_value_t = Form::Markdown)]
    pub form: Form,
    /// Write it to a file instead of standard output.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

impl Arguments for Derive {
    with_spec!();
}

/// The forms of a derivation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The equations, for reading.
    Markdown,
    /// The equations, for typesetting.
    Latex,
    /// The equations, as a page for a browser.
    Html,
    /// The code that `machine!` emits.
    Rust,
    /// The operations, one on each line, with their counts.
    Program,
    /// The code as C99.
    C,
    /// The operations in a language for computation.
    Script(&'static Dialect),
}

impl Form {
    /// All forms, those of [`DIALECTS`] last.
    const ALL: [Form; 6 + DIALECTS.len()] = {
        let mut all = [Form::Markdown; 6 + DIALECTS.len()];
        (all[1], all[2], all[3]) = (Form::Latex, Form::Html, Form::Rust);
        (all[4], all[5]) = (Form::Program, Form::C);
        let mut k = 0;
        while k < DIALECTS.len() {
            all[6 + k] = Form::Script(&DIALECTS[k]);
            k += 1;
        }
        all
    };
}

impl ValueEnum for Form {
    fn value_variants<'a>() -> &'a [Form] {
        static ALL: [Form; Form::ALL.len()] = Form::ALL;
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self {
            Form::Markdown => ("markdown", "The equations, for reading"),
            Form::Latex => ("latex", "The equations, for typesetting"),
            Form::Html => ("html", "The equations, as a page for a browser"),
            Form::Rust => ("rust", "The code that `machine!` emits"),
            Form::Program => (
                "program",
                "The operations, one on each line, with their counts",
            ),
            Form::C => ("c", "The code as C99"),
            Form::Script(dialect) => (dialect.name, dialect.summary),
        };
        Some(PossibleValue::new(name).help(help))
    }
}
