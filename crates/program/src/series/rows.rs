//! Operands and dependencies of rows.

use super::{Level, NoSeries, Row, RowId, Series, Stream};
use lagrangian_symbolic::sorting::sort_by_key;

impl Series {
    /// The series with these rows, operands before their users, and these of them as residuals, of a machine with so many coordinates, parameters and inputs; without unused rows.
    /// The matrix of its unknowns is taken to be symmetric.
    ///
    /// # Errors
    /// If accelerations do not occur linearly.
    pub fn of_rows(
        rows: Vec<Row>,
        residuals: Vec<RowId>,
        [coordinates, parameters, inputs]: [usize; 3],
    ) -> Result<Series, NoSeries> {
        let mut levels = Vec::with_capacity(rows.len());
        for row in &rows {
            levels.push(row.level(&levels));
        }
        let series = Series {
            depends: Vec::new(),
            exact: Vec::new(),
            rows,
            levels,
            residuals,
            coordinates,
            parameters,
            inputs,
            rates_are_ahead: false,
            is_symmetric: true,
        };
        series.pruned().ordered_by_time().with_dependences()
    }

    /// The series without unused rows.
    fn pruned(self) -> Series {
        let mut needed = vec![false; self.rows.len()];
        let mut open: Vec<RowId> = self.residuals.clone();
        while let Some(row) = open.pop() {
            if !std::mem::replace(&mut needed[row.index()], true) {
                self.rows[row.index()].for_each_operand(|operand| open.push(operand));
            }
        }
        let mut place = vec![RowId(0); self.rows.len()];
        let mut count = 0;
        for (place, _) in place.iter_mut().zip(&needed).filter(|(_, needed)| **needed) {
            *place = RowId(count);
            count += 1;
        }
        let kept = |index: &usize| needed[*index];
        let rows = self.rows.into_iter().enumerate();
        let rows = rows.filter(|(index, _)| kept(index));
        Series {
            rows: rows.map(|(_, row)| row.renumbered(&place)).collect(),
            levels: (0..self.levels.len())
                .filter(kept)
                .map(|index| self.levels[index])
                .collect(),
            residuals: self.residuals.iter().map(|r| place[r.index()]).collect(),
            depends: vec![Vec::new(); count as usize],
            exact: vec![false; count as usize],
            ..self
        }
    }

    /// The series with the unknowns that change each row.
    ///
    /// # Errors
    /// If accelerations do not occur linearly.
    fn with_dependences(mut self) -> Result<Series, NoSeries> {
        self.rates_are_ahead = self.rows.iter().any(|row| match row {
            Row::First(of) => self.levels[of.index()] == Level::Rate,
            _ => false,
        });
        for index in 0..self.rows.len() {
            let level = self.levels[index];
            let row = &self.rows[index];
            let mut found: Vec<u32> = match *row {
                Row::Coordinate(i) | Row::Acceleration(i) => vec![i],
                Row::Rate(i) if self.rates_are_ahead => vec![i],
                Row::Second(of) => self.depends[of.index()].clone(),
                Row::First(of) if self.rates_are_ahead => self.depends[of.index()].clone(),
                _ if level != Level::Constant && (level != Level::Rate || self.rates_are_ahead) => {
                    let mut found = Vec::new();
                    let mut varying = 0;
                    row.for_each_operand(|operand| {
                        // The partner of a pair has the same argument.
                        if self.levels[operand.index()] == level && operand.index() < index {
                            found.extend(&self.depends[operand.index()]);
                            varying += 1;
                        }
                    });
                    let is_linear = match row {
                        Row::Sum(_) => true,
                        Row::Product(..) => varying <= 1,
                        Row::Quotient(_, under) => self.levels[under.index()] < level,
                        _ => false,
                    };
                    if level == Level::Acceleration && !is_linear {
                        return Err(NoSeries::NotLinear);
                    }
                    found
                }
                _ => Vec::new(),
            };
            found.sort_unstable();
            found.dedup();
            self.depends[index] = found;
            self.exact[index] = match row {
                Row::Time => true,
                Row::Sum(terms) => terms.iter().any(|(_, row)| self.exact[row.index()]),
                _ => false,
            };
        }
        Ok(self)
    }

    /// The series with the terms of each sum in the order in which they become known, so that the latest is added last.
    fn ordered_by_time(mut self) -> Series {
        let mut ready = vec![0_u32; self.rows.len()];
        for index in 0..self.rows.len() {
            if let Row::Sum(terms) = &mut self.rows[index] {
                sort_by_key(terms, |(_, row)| {
                    (self.levels[row.index()], ready[row.index()], *row)
                });
            }
            let mut after = 0;
            self.rows[index].for_each_operand(|operand| {
                let is_before = operand.index() < index;
                if is_before && self.levels[operand.index()] > Level::Constant {
                    after = after.max(ready[operand.index()]);
                }
            });
            ready[index] = after + 1;
        }
        self
    }

    /// The unknowns in groups that are not coupled, each in the order of the unknowns.
    pub fn blocks(&self) -> Vec<Vec<u32>> {
        let count = self.unknowns();
        let mut group: Vec<usize> = (0..count).collect();
        let residuals = self.residuals.iter().enumerate();
        for (i, row) in residuals.filter(|(_, row)| self.level(**row) == Level::Acceleration) {
            for &other in &self.depends[row.index()] {
                let (one, two) = (group[i], group[other as usize]);
                let (low, high) = (one.min(two), one.max(two));
                group
                    .iter_mut()
                    .filter(|g| **g == high)
                    .for_each(|g| *g = low);
            }
        }
        let mut blocks: Vec<Vec<u32>> = Vec::new();
        let mut place = vec![None; count];
        for (i, group) in (0..).zip(group) {
            match place[group] {
                Some(at) => {
                    let block: &mut Vec<u32> = &mut blocks[at];
                    block.push(i);
                }
                None => {
                    place[group] = Some(blocks.len());
                    blocks.push(vec![i]);
                }
            }
        }
        blocks
    }

    /// The rows whose earlier coefficients are needed by sums over orders: as they are, and multiplied by their orders.
    pub fn streams(&self) -> Vec<[bool; 2]> {
        let mut streams = vec![[false; 2]; self.rows.len()];
        for index in 0..self.rows.len() {
            for convolution in self.convolutions(RowId(index as u32)) {
                for Stream { row, weighted } in convolution.factors {
                    streams[row.index()][usize::from(weighted)] = true;
                }
            }
        }
        streams
    }
}

impl Row {
    /// Its level, where those of all earlier rows are known.
    pub fn level(&self, levels: &[Level]) -> Level {
        let mut level = match self {
            Row::Time | Row::Coordinate(_) | Row::Input(_) => Level::Position,
            Row::Rate(_) | Row::First(_) => Level::Rate,
            Row::Acceleration(_) | Row::Second(_) => Level::Acceleration,
            _ => Level::Constant,
        };
        self.for_each_operand(|operand| {
            if let Some(&of) = levels.get(operand.index()) {
                level = level.max(of);
            }
        });
        match self {
            Row::First(of) if levels[of.index()] == Level::Rate => Level::Acceleration,
            _ => level,
        }
    }

    /// Calls `visit` with every row that it is made from.
    pub fn for_each_operand(&self, mut visit: impl FnMut(RowId)) {
        match self {
            Row::Number(_)
            | Row::Pi
            | Row::Parameter(_)
            | Row::Input(_)
            | Row::Time
            | Row::Coordinate(_)
            | Row::Rate(_)
            | Row::Acceleration(_) => {}
            Row::First(a) | Row::Second(a) | Row::Square(a) | Row::Sqrt(a) => visit(*a),
            Row::TanhSlope(a) | Row::Exp(a) => visit(*a),
            Row::Sum(terms) => {
                for (coefficient, row) in terms {
                    coefficient.iter().for_each(|c| visit(*c));
                    visit(*row);
                }
            }
            Row::Constant(_, a, b) | Row::Primitive(_, a, b) => {
                [*a, *b].into_iter().for_each(visit)
            }
            Row::Product(a, b) | Row::Quotient(a, b) | Row::Power(a, b) => {
                [*a, *b].into_iter().for_each(visit)
            }
            Row::Sin(a, b) | Row::Cos(a, b) | Row::Sinh(a, b) | Row::Cosh(a, b) => {
                [*a, *b].into_iter().for_each(visit)
            }
            Row::Tanh(a, b) => [*a, *b].into_iter().for_each(visit),
            Row::Atan2(a, b, c) => [*a, *b, *c].into_iter().for_each(visit),
        }
    }

    /// This row with its operands renumbered.
    fn renumbered(self, place: &[RowId]) -> Row {
        self.with_operands(|row| place[row.index()])
    }

    /// This row with other operands.
    pub(super) fn with_operands(mut self, mut place: impl FnMut(RowId) -> RowId) -> Row {
        let mut to = |row: &mut RowId| *row = place(*row);
        match &mut self {
            Row::Number(_)
            | Row::Pi
            | Row::Parameter(_)
            | Row::Input(_)
            | Row::Time
            | Row::Coordinate(_)
            | Row::Rate(_)
            | Row::Acceleration(_) => {}
            Row::First(a) | Row::Second(a) | Row::Square(a) | Row::Sqrt(a) => to(a),
            Row::TanhSlope(a) | Row::Exp(a) => to(a),
            Row::Sum(terms) => {
                for (coefficient, row) in terms {
                    coefficient.iter_mut().for_each(&mut to);
                    to(row);
                }
            }
            Row::Constant(_, a, b)
            | Row::Primitive(_, a, b)
            | Row::Product(a, b)
            | Row::Quotient(a, b)
            | Row::Power(a, b)
            | Row::Sin(a, b)
            | Row::Cos(a, b)
            | Row::Sinh(a, b)
            | Row::Cosh(a, b)
            | Row::Tanh(a, b) => [a, b].into_iter().for_each(to),
            Row::Atan2(a, b, c) => [a, b, c].into_iter().for_each(to),
        }
        self
    }
}
