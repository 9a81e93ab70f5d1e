//! What the code costs.

use super::{Chapter, code, head, words};
use crate::emit::document::{Block, Words};
use crate::mechanics::Route;

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
                "The code differentiates no energy: it projects accelerations on the directions in which coordinates move, \
                 which takes fewer operations and gives the same equations."
            }
            Route::Lagrange => {
                "The code is made from Lagrange's equations of the approximated energies."
            }
        };
        let words = words![
            route,
            " What one call of each function costs; ",
            code("prepare"),
            " is called once for a set of parameters:",
        ];
        vec![Block::Paragraph(words), Block::Table(head, rows.collect())]
    }
}
