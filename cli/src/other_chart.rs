//! Searches in the Cartesian coordinates that a spec names for polar ones, where those in the polar ones end at the centre.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_sweep::charts::{ChartedPoints, Charts};

use crate::call;
use crate::failure::Failure;
use crate::{output, reading};

/// A machine in the Cartesian coordinates that its spec names, with the start of a search in these.
pub struct OtherChart<'d> {
    /// The machine as it was derived.
    pub compiled: Compiled<'d>,
    /// The machine with the parameters of the call.
    pub machine: InterpretedMachine,
    /// The start of the call.
    pub start: State<Named>,
}

impl<'d> OtherChart<'d> {
    /// The machine of a call in the other chart; `None` if it cannot be made in it, since a formula of the call needs a polar coordinate,
    /// one is kept, or a distance at the start is negative.
    pub fn of(
        compiled: &Compiled<'d>,
        model: Option<Box<Model<'d>>>,
        (start, keep): (&call::Start, &call::Keep),
        stated: &State<Named>,
    ) -> Option<OtherChart<'d>> {
        let model = model.filter(|model| model.uncharted.is_empty())?;
        let points = ChartedPoints::of(&compiled.model);
        points.check_kept(&keep.names).ok()?;
        // Its warnings would be those of the spec, which are printed.
        let mut report = Report::new();
        let cartesian = Compiled::new(*model, &mut report)?;
        compiled.check_chart(&cartesian, &mut report)?;
        let machine = reading::machine(&cartesian, &start.parameters_alone()).ok()?;
        let (_, start) = Charts::begin(&points, machine.start(), stated).ok()?;
        Some(OtherChart {
            compiled: cartesian,
            machine,
            start,
        })
    }
}

/// The result of a search in the coordinates of the spec or, where that fails, in the other chart; a note says so. If both fail, the failure is
/// that of the first.
pub fn search<T>(
    found: Result<T, Failure>,
    in_other: impl FnOnce() -> Option<Result<T, Failure>>,
) -> Result<T, Failure> {
    let failure = match found {
        Err(failure @ Failure::Run(_)) => failure,
        found => return found,
    };
    match in_other() {
        Some(Ok(found)) => {
            output::print_error(format_args!(
                "note: {}; this is in the Cartesian coordinates that `charts` names",
                failure.message()
            ));
            Ok(found)
        }
        _ => Err(failure),
    }
}
