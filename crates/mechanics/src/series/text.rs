//! Series of machines that are kept as texts.

use std::thread;

use lagrangian_program::series::NoSeries;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{ReadTexts, Sources};
use lagrangian_symbolic::{Dag, Rational};

use super::{ProvedContactSeries, ProvedSeries};

/// Stack size of the thread that derives a series. Nothing recurses deeply, but unoptimized code has large frames, and the caller's thread may have a
/// small stack.
const STACK: usize = 64 << 20;

/// The texts of a spec, from which any thread can derive the series of its machine. A model would do, but it belongs to one thread.
#[derive(Clone, Debug, Default)]
pub struct SeriesText {
    /// The name of the spec, to which paths in it are relative.
    pub name: String,
    /// The spec.
    pub text: String,
    /// The values of constants that differ from those in the spec.
    pub constants: Vec<(String, Rational)>,
    /// Parameters that are given values although the spec has formulas for them.
    pub given: Vec<String>,
    /// What the spec reads from files.
    pub files: ReadTexts,
    /// Whether the machine is meant in the other charts that the spec names.
    pub in_charts: bool,
}

impl SeriesText {
    /// Derives the series, and proves it.
    ///
    /// # Errors
    /// Why there is none. It is unproved if the texts are not those of a machine.
    pub fn derive(&self) -> Result<ProvedSeries, NoSeries> {
        self.derive_by(ProvedSeries::derive)
    }

    /// Derives the series while contacts are closed, and proves it.
    ///
    /// # Errors
    /// As [`derive`](Self::derive).
    pub fn derive_with_contacts(&self) -> Result<ProvedContactSeries, NoSeries> {
        self.derive_by(ProvedContactSeries::derive)
    }

    fn derive_by<P: Send>(&self, by: fn(&Model<'_>) -> Result<P, NoSeries>) -> Result<P, NoSeries> {
        let derive = || {
            let dag = Dag::new();
            let model = self.model(&dag).ok_or(NoSeries::Unproved)?;
            by(&model)
        };
        thread::scope(|scope| {
            let thread = thread::Builder::new().stack_size(STACK);
            match thread.spawn_scoped(scope, derive) {
                Ok(thread) => thread
                    .join()
                    .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
                Err(_) => derive(),
            }
        })
    }

    fn model<'d>(&self, dag: &'d Dag) -> Option<Model<'d>> {
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let spec = lagrangian_spec::parse(&mut sources, &self.name, &self.text, &mut report);
        let spec = spec.with_given(self.given.iter().cloned());
        let (constants, files) = (&self.constants, &mut self.files.clone());
        let model =
            Model::resolve_with(spec, dag, constants, &[], files, &mut sources, &mut report)?;
        if self.in_charts {
            model.cartesian.map(|machine| *machine)
        } else {
            Some(model)
        }
    }
}
