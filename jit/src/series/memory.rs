//! The memory of a step by series: numbers of the step, and a record for each order.
//!
//! ```text
//! numbers of the step   time, state, inputs, constants, sums over orders, all that one part of the code passes to another
//! record of order n     factors of sums over orders; numbers that follow from n; coefficients of order n of positions, and of order n − 2
//!                       of what depends on accelerations
//! ```
//!
//! For one state a register holds several sums over orders, whose factors lie side by side. For several states it holds one sum of each of them, and
//! each number here stands for one of every state; then a list of coefficients is stored once, however many sums it is a factor of.

use std::collections::{HashMap, HashSet};

use lagrangian_program::series::{Convolution, RowId, Series, Stream, TermOrder};

use crate::emit::Pack;
use crate::lower::{Base, Location};

/// Where in a record the number of the order stands, its reciprocal, and both parts of the divisor `n (n − 1)`.
pub const NUMBERS: [u32; 4] = [0, 1, 2, 3];

/// The place of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// Among the numbers of the step.
    Fixed(u32),
    /// In the record of so many orders ago.
    Record(u32, u32),
}

/// Places in records have codes until the length of a record is known.
const CODES: u32 = 1 << 28;

impl Place {
    /// As the argument of a part, with a code for places in records.
    pub fn to_location(self) -> Location {
        match self {
            Place::Fixed(slot) => Location::Argument(Base::Coordinates, slot),
            Place::Record(back, slot) => Location::Argument(Base::Velocities, CODES * back + slot),
        }
    }

    /// The place in records that has this code.
    pub fn of_record(code: u32) -> Place {
        Place::Record(code / CODES, code % CODES)
    }

    /// The argument of a part, and the index in it; that of records begins two orders ago.
    pub fn to_argument(self, stride: u32) -> (Base, u32) {
        match self {
            Place::Fixed(slot) => (Base::Coordinates, slot),
            Place::Record(back, slot) => (Base::Velocities, (2 - back) * stride + slot),
        }
    }
}

impl From<(Base, u32)> for Location {
    fn from((base, index): (Base, u32)) -> Location {
        Location::Argument(base, index)
    }
}

/// The lists of both factors of a sum over orders.
#[derive(Clone, Copy, Debug)]
pub struct Lane {
    /// 0 for positions, and for forces along them, 2 for rates that are [ahead](Series::rates_are_ahead), 1 for everything else.
    pub kind: usize,
    /// The places of the factors in a record.
    pub slots: [u32; 2],
    /// Where the sum is stored.
    sum: u32,
}

/// The memory under construction.
pub struct Memory {
    lanes: Vec<(Convolution, Lane)>,
    lane_of: HashMap<Convolution, usize>,
    /// Where the list of a factor is, of each kind of sums, if it is stored once.
    list_of: HashMap<(usize, Stream), u32>,
    /// The packs of each kind.
    pub packs: [Vec<Pack>; 3],
    inputs: [u32; 4],
    fixed: u32,
    /// The constants, and where each is.
    pub constants: Vec<(RowId, u32)>,
    constant_of: HashMap<RowId, u32>,
    rows: Vec<(RowId, bool, u32)>,
    row_of: HashMap<(RowId, bool), u32>,
    motion: u32,
    rates: u32,
    record: u32,
}

impl Memory {
    /// For a series and registers of this number of sums over orders: 1 for several states.
    pub fn new(series: &Series, width: u32) -> Memory {
        let n = series.dimension() as u32;
        let mut kinds: [Vec<Convolution>; 3] = Default::default();
        let mut known = HashSet::new();
        for row in (0..series.rows.len() as u32).map(RowId) {
            for convolution in series.convolutions(row) {
                let kind = match convolution.along {
                    TermOrder::Other => 1 + series.lead(row),
                    _ => 0,
                };
                if known.insert(convolution) {
                    kinds[kind].push(convolution);
                }
            }
        }
        let mut memory = Memory {
            lanes: Vec::new(),
            lane_of: HashMap::new(),
            list_of: HashMap::new(),
            packs: Default::default(),
            inputs: [0; 4],
            fixed: 0,
            constants: Vec::new(),
            constant_of: HashMap::new(),
            rows: Vec::new(),
            row_of: HashMap::new(),
            motion: 0,
            rates: 0,
            record: (NUMBERS.len() as u32).next_multiple_of(width),
        };
        for (kind, convolutions) in kinds.into_iter().enumerate() {
            for some in convolutions.chunks(width as usize) {
                memory.pack(kind, some, width);
            }
        }
        let inputs = [2, n, n, series.inputs as u32];
        memory.inputs = inputs.map(|count| memory.take(count));
        memory.motion = memory.record;
        memory.rates = memory.motion + n;
        memory.record = memory.rates + n;
        memory
    }

    fn pack(&mut self, kind: usize, convolutions: &[Convolution], width: u32) {
        if width == 1 {
            for convolution in convolutions {
                self.pack_alone(kind, *convolution);
            }
            return;
        }
        let width = if convolutions.len() <= 4 { 4 } else { width };
        let [a, b] = [0, 1].map(|side| self.record + side * width);
        let sums = self.take(width);
        self.record += 2 * width;
        for (at, convolution) in (0..).zip(convolutions) {
            self.lane_of.insert(*convolution, self.lanes.len());
            let lane = Lane {
                kind,
                slots: [a + at, b + at],
                sum: sums + at,
            };
            self.lanes.push((*convolution, lane));
        }
        self.packs[kind].push(Pack {
            width,
            slots: [a, b],
            sums,
        });
    }

    /// A sum in a register of its own.
    fn pack_alone(&mut self, kind: usize, convolution: Convolution) {
        let slots = convolution.factors.map(|stream| {
            let next = self.record;
            let slot = *self.list_of.entry((kind, stream)).or_insert(next);
            self.record += u32::from(slot == next);
            slot
        });
        let sum = self.take(1);
        self.lane_of.insert(convolution, self.lanes.len());
        self.lanes.push((convolution, Lane { kind, slots, sum }));
        self.packs[kind].push(Pack {
            width: 1,
            slots,
            sums: sum,
        });
    }

    /// Takes so many numbers of the step.
    pub fn take(&mut self, count: u32) -> u32 {
        self.fixed += count;
        self.fixed - count
    }

    /// Where the time begins, in two parts.
    pub fn time(&self) -> u32 {
        self.inputs[0]
    }

    /// Where the coordinates begin.
    pub fn coordinates(&self) -> u32 {
        self.inputs[1]
    }

    /// Where the rates at the start begin.
    pub fn velocities(&self) -> u32 {
        self.inputs[2]
    }

    /// Where the inputs begin.
    pub fn inputs(&self) -> u32 {
        self.inputs[3]
    }

    /// Where in a record the coefficients of coordinates begin.
    pub fn motion(&self) -> u32 {
        self.motion
    }

    /// Where in a record the coefficients of rates begin, of an order that is lower by one.
    pub fn rates(&self) -> u32 {
        self.rates
    }

    /// The place of a row that depends on parameters alone.
    pub fn constant(&mut self, row: RowId) -> u32 {
        if let Some(known) = self.constant_of.get(&row) {
            return *known;
        }
        let slot = self.take(1);
        self.constant_of.insert(row, slot);
        self.constants.push((row, slot));
        slot
    }

    /// The place in a record of the coefficients of a row, or of their multiples by the order.
    pub fn of_row(&mut self, row: RowId, weighted: bool) -> u32 {
        let next = self.record;
        let slot = *self.row_of.entry((row, weighted)).or_insert(next);
        if slot == next {
            self.rows.push((row, weighted, slot));
            self.record += 1;
        }
        slot
    }

    /// The place of a sum over orders.
    pub fn sum(&self, convolution: &Convolution) -> Place {
        let lane = self.lane_of.get(convolution);
        Place::Fixed(lane.map_or(0, |at| self.lanes[*at].1.sum))
    }

    /// All sums over orders.
    pub fn lanes(&self) -> Vec<(Convolution, Lane)> {
        self.lanes.clone()
    }

    /// The rows whose coefficients are in records.
    pub fn rows(&self) -> Vec<(RowId, bool, u32)> {
        self.rows.clone()
    }

    /// The length of a record, in whole lines of a cache.
    pub fn stride(&self) -> u32 {
        self.record.next_multiple_of(8)
    }

    /// Where the first record is, that of order 0.
    pub fn records(&self) -> u32 {
        self.fixed.next_multiple_of(8)
    }
}
