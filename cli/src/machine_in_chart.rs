//! The machine of a run in the Cartesian coordinates that its spec names.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::SeriesText;
use lagrangian_spec::source::Sources;
use lagrangian_sweep::charts::{ChartedPoints, Charts};

use crate::call;
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::reading::{self, ChartUse, InCharts};

/// The machine of a run with its start, in the Cartesian coordinates that `charts` of the spec names, if it names any and they can express
/// all that the call gives; otherwise in those of the spec.
pub struct MachineInChart<'d> {
    pub compiled: Compiled<'d>,
    pub machine: InterpretedMachine,
    pub start: State<Named>,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    pub charts: Option<Charts>,
    /// The texts from which the series of the machine can be derived.
    pub series: SeriesText,
    /// The texts of the spec.
    pub sources: Sources,
}

impl<'d> MachineInChart<'d> {
    /// A compiled machine with the parameters and the start of a call.
    ///
    /// # Errors
    /// If the call is invalid, or gives what the Cartesian coordinates cannot express where they are [required](ChartUse::Required): a
    /// negative distance at the start, or a distance or an angle that is kept there.
    pub fn new(
        InCharts {
            compiled,
            cartesian,
            series,
            sources,
        }: InCharts<'d>,
        start: &call::Start,
        keep: &call::Keep,
        chart_use: ChartUse,
    ) -> Result<MachineInChart<'d>, Failure> {
        let machine = reading::machine(&compiled, start)?;
        reading::check_parameters(&machine)?;
        let mut stated = machine.start();
        set_start(&mut stated, start)?;
        reading::check_kept(&stated, keep)?;
        if let Some(cartesian) = cartesian {
            let machine = reading::machine(&cartesian, &start.parameters_alone())?;
            let points = ChartedPoints::of(&compiled.model);
            let checked = points.check_kept(&keep.names);
            match checked.and_then(|()| Charts::begin(&points, machine.start(), &stated)) {
                Ok((charts, start)) => {
                    return Ok(MachineInChart {
                        compiled: cartesian,
                        machine,
                        start,
                        charts: Some(charts),
                        series,
                        sources,
                    });
                }
                Err(why) if chart_use == ChartUse::Required => return Err(Failure::Call(why)),
                Err(_) => {}
            }
        }
        Ok(MachineInChart {
            compiled,
            machine,
            start: stated,
            charts: None,
            series,
            sources,
        })
    }
}
