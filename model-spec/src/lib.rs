//! The compiler: from the text of a machine to its equations, its program, and code.
//!
//! ```text
//! text or tokens ─▶ Spec ─▶ Model ─▶ Equations ─▶ Program ─▶ Rust, Markdown, LaTeX, C, numbers
//! ```
//!
//! Each stage is a plain value: print it, compare it, test it alone. A stage reads the one before
//! it and never edits it; whatever is wrong with a spec goes into one [`Report`].

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

/// What a text says: its tokens, and the tree that they make.
///
/// `name` is what messages call the text, and what the path of an `extends` in it is relative to.
pub fn parse(sources: &mut Sources, name: &str, text: &str, report: &mut Report) -> Spec {
    let source = sources.add(name, text);
    let tokens = token::lex(source, text, report);
    Spec::parse(&tokens, source, report)
}

/// What a text means: [`parse`], then [`Model::resolve`].
///
/// `constants` replaces the values of constants, by name. There is a model only if nothing is wrong
/// with the spec; the report says what is.
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
