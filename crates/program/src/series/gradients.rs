//! The gradients of rows at the start, as operations to be written or compiled. [`Expander`](super::Expander) computes the same numbers in
//! one flat list.

use super::recurrence::Arithmetic;
use super::{Row, RowId, Series};

impl Series {
    /// The gradient of each row by the unknowns on which it depends, at the start, by the chain rule; empty for rows that depend on none.
    /// `multiply_add` gives `a b + c`, and may simplify it where these are 0 or ±1.
    pub fn gradients<A: Arithmetic>(
        &self,
        to: &mut A,
        mut multiply_add: impl FnMut(&mut A, [A::X; 3]) -> A::X,
    ) -> Vec<Vec<A::X>> {
        let mut gradients: Vec<Vec<A::X>> = vec![Vec::new(); self.rows.len()];
        for index in 0..self.rows.len() {
            let row = RowId(index as u32);
            let depends = &self.depends[index];
            if depends.is_empty() {
                continue;
            }
            let mut own = vec![to.zero(); depends.len()];
            let mut add = |to: &mut A, of: RowId, slope: A::X| {
                if !self.propagates(row, of) {
                    return;
                }
                let terms = self.depends[of.index()].iter().zip(&gradients[of.index()]);
                for (unknown, &g) in terms {
                    if let Ok(at) = depends.binary_search(unknown) {
                        own[at] = multiply_add(to, [slope, g, own[at]]);
                    }
                }
            };
            match &self.rows[index] {
                Row::Coordinate(_) | Row::Rate(_) | Row::Acceleration(_) => own[0] = to.one(),
                Row::Sum(terms) => {
                    for (c, of) in terms {
                        let slope = match c {
                            Some(c) => to.first(*c),
                            None => to.one(),
                        };
                        add(to, *of, slope);
                    }
                }
                _ => {
                    for (of, slope) in self.slopes(row, to).into_iter().flatten() {
                        add(to, of, slope);
                    }
                }
            }
            gradients[index] = own;
        }
        gradients
    }
}
