//! The front end of the compiler: parses the text of a machine and resolves it into a [`Model`].
//!
//! ```text
//! text or tokens ─▶ Spec ─▶ Model ─▶ Equations ─▶ Program ─▶ Rust, Markdown, LaTeX, C, numbers
//! ```
//!
//! Each stage is a plain value that can be printed, compared and tested alone. A stage reads the
//! one before it and never edits it; every error in a spec is collected in one [`Report`].

pub mod diagnostic;
mod elements;
pub mod identity;
pub mod model;
pub mod resolve;
pub mod source;
pub mod syntax;
pub mod token;

pub use lagrangian_units as unit;

use diagnostic::Report;
use lagrangian_symbolic::{Dag, Rational};
use model::Model;
use source::{Files, Sources};
use syntax::Spec;

/// Lexes and parses a text into its syntax tree.
///
/// Messages refer to the text as `name`, and the path of an `extends` in it is relative to `name`.
pub fn parse(sources: &mut Sources, name: &str, text: &str, report: &mut Report) -> Spec {
    let source = sources.add(name, text);
    let tokens = token::lex(source, text, report);
    Spec::parse(&tokens, source, report)
}

/// Reads a text into a model: [`parse`], then [`Model::resolve`].
///
/// `constants` replaces the values of constants, by name. Returns a model only if the spec has no
/// errors; the report lists them.
///
/// ```
/// use lagrangian_spec::{diagnostic::Report, source::{InMemory, Sources}};
///
/// let text = "machine Ball in plane {
///     parameters { m: kg = 1, g: m/s^2 = 9.81 }
///     coordinates { x: m, y: m = 2 }
///     bodies { ball { mass: m, at: (x, y) } }
///     gravity (0, -g);
/// }";
/// let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
/// let files = &mut InMemory::new();
/// let ball = lagrangian_spec::model(&dag, "ball.machine", text, &[], files, &mut sources, &mut report)
///     .ok_or_else(|| report.render_short(&sources))?;
/// assert_eq!(ball.coordinates[1].unit.to_string(), "m");
/// # Ok::<(), String>(())
/// ```
pub fn model<'d>(
    dag: &'d Dag,
    name: &str,
    text: &str,
    constants: &[(String, Rational)],
    files: &mut dyn Files,
    sources: &mut Sources,
    report: &mut Report,
) -> Option<Model<'d>> {
    let spec = parse(sources, name, text, report);
    Model::resolve(spec, dag, constants, files, sources, report)
}
