//! A machine in a second chart: a module of its own within that of the machine, and the way from one to the other.

use std::collections::BTreeMap;

use super::{Emitter, Options};
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_mechanics::{Compiled, Proved};
use lagrangian_program::{Program, Role};

/// A machine in the Cartesian coordinates that its spec names beside polar ones, proved to be the same machine.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Its program.
    program: Proved,
    /// The formulas that its documentation shows.
    formulas: BTreeMap<Role, Vec<String>>,
    /// The Taylor series of its motion, if the spec asks for it.
    series: Option<ProvedSeries>,
    /// For each point the indices of its distance and its angle, and of its components.
    points: Vec<[usize; 2]>,
}

impl Options {
    /// The settings for a machine, and for the same machine in its second chart, if it has one.
    pub fn of(compiled: &Compiled<'_>, cartesian: Option<&Compiled<'_>>) -> Options {
        Options {
            formulas: compiled.formulas(),
            series: compiled.series.clone(),
            chart: cartesian.map(|cartesian| Chart {
                program: cartesian.program.clone(),
                formulas: cartesian.formulas(),
                series: cartesian.series.clone(),
                points: compiled.chart_points(),
            }),
            ..Options::default()
        }
    }
}

/// The second chart of any program, also of a placeholder.
pub(super) struct ChartOf<'a> {
    pub(super) program: &'a Program,
    pub(super) options: Options,
    pub(super) points: &'a [[usize; 2]],
}

impl<'a> ChartOf<'a> {
    pub(super) fn of(options: &'a Options) -> Option<ChartOf<'a>> {
        let chart = options.chart.as_ref()?;
        let options = Options {
            formulas: chart.formulas.clone(),
            series: chart.series.clone(),
            ..options.without_chart()
        };
        Some(ChartOf {
            program: &chart.program,
            options,
            points: &chart.points,
        })
    }
}

impl Options {
    /// The settings that do not depend on the chart.
    pub(super) fn without_chart(&self) -> Options {
        Options {
            runtime: self.runtime.clone(),
            longest_whole: self.longest_whole,
            shortest_rolled: self.shortest_rolled,
            shortest_packed: self.shortest_packed,
            marks: self.marks,
            ..Options::default()
        }
    }
}

impl Emitter<'_> {
    /// Writes the module of the second chart, and the implementation of the trait that leads to it.
    pub(super) fn second_chart(&mut self, chart: &ChartOf<'_>) {
        let (module, machine) = (self.types.chart.clone(), self.types.machine.clone());
        self.writer.gap();
        let docs = format!(
            "[`{}`] in the Cartesian coordinates that its description names.",
            self.program.name
        );
        self.docs(&docs);
        self.writer.open(format!("pub mod {module} {{"));
        let mut inner = Emitter::new(chart.program, &chart.options);
        inner.is_within = true;
        inner.writer = std::mem::take(&mut self.writer);
        let other = inner.types.machine.clone();
        inner.write_module();
        self.writer = inner.writer;
        self.writer.close("}");
        self.writer.gap();
        let runtime = self.options.runtime.clone();
        self.writer.open(format!("{runtime}::charted! {{"));
        let fields = self.fields_of_parameters();
        self.filled(
            &format!("machine {machine} {{"),
            &fields,
            &format!("}} in {module}::{other};"),
            false,
        );
        let points = chart.points.iter().map(|[s, phi]| format!("[{s}, {phi}]"));
        let points: Vec<String> = points.collect();
        self.writer.line(format!("points [{}]", points.join(", ")));
        self.writer.close("}");
    }
}
