//! The checks of pivots: a constant for each tolerance, and lists of the pivots compared with it.

use super::Emitter;
use super::language::number;
use crate::layout::Layout;
use lagrangian_program::solve::pivot_tolerance;
use lagrangian_program::{Function, Guard};

impl Emitter<'_> {
    /// The tolerances of all pivots, without duplicates.
    fn tolerances(&self) -> Vec<f64> {
        let mut tolerances = Vec::new();
        let guards = self.program.all_functions().flat_map(|f| &f.guards);
        for tolerance in guards.map(|guard| guard.tolerance) {
            if !tolerances.contains(&tolerance) {
                tolerances.push(tolerance);
            }
        }
        tolerances
    }

    /// The name of the constant for a guard.
    pub(super) fn pivots_of(&self, guard: &Guard) -> String {
        let tolerances = self.tolerances();
        let place = tolerances.iter().position(|of| *of == guard.tolerance);
        match place {
            None | Some(0) => "PIVOTS".to_owned(),
            Some(place) => format!("PIVOTS_{place}"),
        }
    }

    /// Writes the constants.
    pub(super) fn pivots(&mut self) {
        let path = format!("{}::Pivots", self.options.runtime);
        for (place, tolerance) in self.tolerances().into_iter().enumerate() {
            let name = match place {
                0 => "PIVOTS".to_owned(),
                place => format!("PIVOTS_{place}"),
            };
            self.writer.gap();
            self.docs(
                "A pivot of an elimination that is not above this share of its diagonal element may be rounding errors alone.",
            );
            let coordinates = self.program.dimension().to_string();
            let rows = (tolerance / pivot_tolerance(1)).round() as usize;
            let value = if pivot_tolerance(rows) == tolerance {
                let items = [coordinates, rows.to_string()];
                Layout::List(
                    format!("{path}::new("),
                    items.map(Layout::Atom).to_vec(),
                    ")",
                )
            } else {
                let fields = [
                    ("coordinates", coordinates),
                    ("tolerance", number(tolerance)),
                ];
                let fields = fields.map(|(name, value)| (name.to_owned(), Layout::Atom(value)));
                Layout::Struct(path.clone(), fields.to_vec())
            };
            self.writer
                .expression(&format!("const {name}: {path} = "), &value, ";");
        }
    }

    /// The pivots of a function grouped by constant: row, pivot, diagonal element.
    pub(super) fn lists_of_pivots(
        &self,
        function: &Function,
        pivots: &[[String; 2]],
    ) -> Vec<(String, Layout)> {
        let guards: Vec<(&Guard, &[String; 2])> = function.guards.iter().zip(pivots).collect();
        let is_alike = |a: &(&Guard, _), b: &(&Guard, _)| a.0.tolerance == b.0.tolerance;
        let lists = guards.chunk_by(is_alike).map(|chunk| {
            let row = |(guard, [pivot, scale]): &(&Guard, &[String; 2])| {
                let items = [guard.coordinate.to_string(), pivot.clone(), scale.clone()];
                Layout::List("(".into(), items.map(Layout::Atom).to_vec(), ")")
            };
            let list = Layout::nested(chunk.iter().map(row));
            (self.pivots_of(chunk[0].0), list)
        });
        lists.collect()
    }
}
