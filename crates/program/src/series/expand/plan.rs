//! What an expander reads of a series.

use super::super::{Composition, Convolution, Level, Row, RowId, Series, Source, TermOrder};

/// A sum over orders: where its factors begin, among the coefficients or their multiples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    pub(super) factors: [(usize, bool); 2],
    pub(super) along: TermOrder,
}

/// What an expander reads of a series: the same for every type of number, so that it is made by code that is compiled once.
pub(super) struct Plan {
    pub(super) by_level: [Vec<u32>; 3],
    pub(super) later: Vec<[bool; 2]>,
    pub(super) compositions: Vec<Option<Composition>>,
    pub(super) changed_by_newest: [Vec<u32>; 3],
    pub(super) scaled: Vec<bool>,
    pub(super) sums: Vec<Vec<Sum>>,
    pub(super) weighted_places: Vec<Option<usize>>,
    /// The number of weighted coefficients.
    pub(super) weighted: usize,
    pub(super) places: Vec<usize>,
    /// The number of partial derivatives.
    pub(super) gradients: usize,
    /// For each block its unknowns, and for each unknown its index among them.
    pub(super) blocks: Vec<[Vec<u32>; 2]>,
}

impl Plan {
    pub(super) fn of(series: &Series, width: usize) -> Plan {
        let rows = series.rows.len();
        let all = || (0..rows as u32).map(RowId);
        let at_level = |level: Level| -> Vec<u32> {
            let rows = all().filter(|row| series.level(*row) == level);
            rows.map(|row| row.0).collect()
        };
        let streams = series.streams();
        let changes = |row: &u32| !series.depends[*row as usize].is_empty();
        let mut changed = [Level::Position, Level::Rate, Level::Acceleration].map(at_level);
        changed.iter_mut().for_each(|rows| rows.retain(changes));
        changed[2].retain(|row| streams[*row as usize] != [false; 2]);
        let mut scaled: Vec<bool> = streams.iter().map(|[_, weighted]| *weighted).collect();
        for row in &series.rows {
            if let Row::Second(of) = row {
                scaled[of.index()] = true;
            }
        }
        let mut weighted = 0;
        let mut take = |count: usize| {
            weighted += count;
            weighted - count
        };
        let weighted_places = streams.iter().map(|[_, is]| is.then(|| take(width)));
        let weighted_places: Vec<Option<usize>> = weighted_places.collect();
        let mut gradients = 0;
        let mut places = Vec::with_capacity(rows);
        for depends in &series.depends {
            places.push(gradients);
            gradients += depends.len();
        }
        let sums = all().map(|row| {
            let sums = series.convolutions(row).into_iter();
            let sum = |sum: Convolution| Sum {
                along: sum.along,
                factors: sum.factors.map(|stream| {
                    let row = stream.row.index();
                    match weighted_places[row] {
                        Some(place) if stream.weighted => (place, true),
                        _ => (row * width, false),
                    }
                }),
            };
            sums.map(sum).collect()
        });
        let block = |members: Vec<u32>| {
            let mut place = vec![0; series.unknowns()];
            for (at, member) in (0..).zip(&members) {
                place[*member as usize] = at;
            }
            [members, place]
        };
        let blocks = series.blocks();
        let compositions = blocks.iter().map(|members| series.composition(members));
        let compositions: Vec<Option<Composition>> = compositions.collect();
        Plan {
            by_level: [Level::Position, Level::Rate, Level::Acceleration].map(at_level),
            later: later_forces(series, &compositions),
            compositions,
            changed_by_newest: changed,
            scaled,
            sums: sums.collect(),
            weighted,
            places,
            gradients,
            blocks: blocks.into_iter().map(block).collect(),
            weighted_places,
        }
    }
}

/// Which rows have forces of later orders, by themselves and as sums of compositions.
fn later_forces(series: &Series, compositions: &[Option<Composition>]) -> Vec<[bool; 2]> {
    let mut later: Vec<[bool; 2]> = series
        .later_forces()
        .into_iter()
        .map(|is| [is, false])
        .collect();
    for composition in compositions.iter().flatten() {
        for source in composition.sources.iter().flatten() {
            if let Source::Sum(row) = source {
                later[row.index()][1] = true;
            }
        }
    }
    later
}
