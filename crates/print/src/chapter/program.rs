//! The cost of the code.

use super::{Chapter, code, counted, head, words};
use crate::document::{Block, Words};
use lagrangian_mechanics::Route;
use lagrangian_program::{Candidate, cycles};

impl Chapter<'_, '_> {
    pub(super) fn program(&self) -> Vec<Block> {
        let program = &self.compiled.program;
        let functions = program
            .all_functions()
            .filter(|function| !function.results.is_empty());
        let rows = functions.map(|function| {
            let counts = function.counts();
            let numbers = [
                counts.multiplications,
                counts.additions,
                counts.divisions,
                counts.sincos,
                counts.other,
            ];
            let name: Words = words![code(program.title(function.role))];
            let numbers = numbers.map(|n| words![n.to_string()]);
            [name].into_iter().chain(numbers).collect()
        });
        let head = head(&[
            "",
            "multiplications",
            "additions",
            "divisions",
            "sine–cosine pairs",
            "other",
        ]);
        let route = match self.compiled.equations.route {
            Route::Projected => {
                "The code does not differentiate energies: it projects accelerations onto the directions in which the coordinates \
                 move, which takes fewer operations and gives the same equations."
            }
            Route::Lagrange => {
                "The code is generated from Lagrange's equations of the approximated energies."
            }
        };
        let words = words![
            route,
            " The operations of one call of each function; ",
            code("prepare"),
            " is called once for each set of parameters:",
        ];
        let mut blocks = vec![Block::Paragraph(words), Block::Table(head, rows.collect())];
        blocks.extend(self.acceleration_candidates());
        blocks
    }

    /// The candidates among which the program of the accelerations was chosen.
    fn acceleration_candidates(&self) -> Vec<Block> {
        let program = &self.compiled.program;
        let Some(choice) = program.choice(program.solving()) else {
            return Vec::new();
        };
        let words = words![
            "The accelerations were generated in ",
            counted(choice.candidates.len(), "form"),
            ". The first of the following was chosen: among those whose rounding error is at most twice the smallest, it has \
             the least sum of the cycles that a processor is estimated to take for a call alone and for one among others \
             that run side by side. The last column is the typical relative error of the result at states around the start; \
             1 is the largest relative error of rounding a single number:",
        ];
        let head = head(&["", "mul", "add", "div", "alone", "among others", "rounding"]);
        let row = |candidate: &Candidate| {
            let Candidate {
                form,
                counts,
                cost,
                rounding,
            } = candidate;
            let numbers = [
                counts.multiplications.to_string(),
                counts.additions.to_string(),
                counts.divisions.to_string(),
                cycles(cost.single_call()),
                cycles(cost.throughput),
                rounding.map_or_else(|| "–".to_owned(), |rounding| rounding.to_string()),
            ];
            let form = words![form.to_string()];
            let numbers = numbers.into_iter().map(|number| words![number]);
            [form].into_iter().chain(numbers).collect()
        };
        let candidates = [choice.chosen()].into_iter().chain(choice.others());
        let rows = candidates.map(row).collect();
        vec![Block::Paragraph(words), Block::Table(head, rows)]
    }
}
