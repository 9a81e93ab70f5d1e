//! The recurrences as code: records the operations that the interpreter would compute.

mod arithmetic;

use std::collections::{BTreeSet, HashMap};

use lagrangian_program::series::{
    Arithmetic, Coefficient, Composition, Convolution, Level, MOST_IN_ONE_SUM, Order, Row, RowId,
    Series, Stream, TermOrder, is_inverse,
};

use super::code::{Code, Op, Operand, Part};
use super::{Carried, FEWEST_APPLIED, FinalCoefficients};

/// A group of coupled unknowns.
pub struct Block {
    members: Vec<u32>,
    /// Its factored matrix.
    matrix: Operand,
    /// How later orders are composed of sources, with the coefficients of these for each unknown.
    composition: Option<(Composition, Vec<Vec<Operand>>)>,
}

/// A recorder of the code of a series.
pub struct Recorder<'s> {
    series: &'s Series,
    pub code: Code,
    /// The part to which code is added.
    pub part: Part,
    /// The order being computed: 0, 1, 2, or 3 in the loop, whose order is that of positions.
    m: usize,
    /// How many orders the rows being computed are [ahead](Series::lead) of the accelerations.
    pub lead: usize,
    /// The names of parameters, while constants are computed; otherwise constants are read.
    parameters: Option<Vec<String>>,
    /// The names of inputs.
    inputs: Vec<String>,
    /// The rows that depend on parameters alone and are needed by the rest.
    pub constants: Vec<RowId>,
    pub first: Vec<Option<Operand>>,
    /// Coefficients of order 1 of positions.
    pub linear: Vec<Option<Operand>>,
    pub newest: Vec<Option<Operand>>,
    /// The coefficients times their order, where known.
    scaled: Vec<Option<Operand>>,
    low: Vec<Option<Operand>>,
    circular: HashMap<RowId, [Operand; 2]>,
    /// The gradients of rows by coordinates, at the start.
    gradients: Vec<Vec<Operand>>,
    /// The products of each kind of [pack](super::Pack).
    pub lanes: [Vec<Convolution>; 3],
    places: HashMap<Convolution, (usize, usize)>,
    pub carried: BTreeSet<Carried>,
    /// Rows of forces that sums use.
    forces: Vec<RowId>,
}

impl<'s> Recorder<'s> {
    pub fn new(series: &'s Series, number: &str, inputs: &[String]) -> Recorder<'s> {
        let none = || vec![None; series.rows.len()];
        let streams = series.streams();
        let rows = (0..series.rows.len() as u32).map(RowId);
        let is_force = |row: &RowId| {
            series.level(*row) == Level::Acceleration
                && streams[row.index()] != [false; 2]
                && !series.depends[row.index()].is_empty()
        };
        let mut symbolic = Recorder {
            series,
            code: Code::new(number, 'x'),
            part: Part::Start,
            m: 0,
            lead: 2,
            parameters: None,
            inputs: inputs.to_vec(),
            constants: Vec::new(),
            first: none(),
            linear: none(),
            newest: none(),
            scaled: none(),
            low: none(),
            circular: HashMap::new(),
            gradients: vec![Vec::new(); series.rows.len()],
            lanes: [(); 3].map(|()| Vec::new()),
            places: HashMap::new(),
            carried: BTreeSet::new(),
            forces: rows.clone().filter(is_force).collect(),
        };
        for row in rows {
            for convolution in series.convolutions(row) {
                symbolic.take_lane(convolution, series.lead(row));
            }
        }
        symbolic
    }

    /// Records the constants, from parameters with these names.
    pub fn of_constants(series: &'s Series, number: &str, parameters: &[String]) -> Recorder<'s> {
        Recorder {
            code: Code::new(number, 'c'),
            parameters: Some(parameters.to_vec()),
            ..Recorder::new(series, number, &[])
        }
    }

    fn take_lane(&mut self, convolution: Convolution, lead: usize) {
        if self.places.contains_key(&convolution) {
            return;
        }
        let kind = match convolution.along {
            TermOrder::Other => 1 + lead,
            _ => 0,
        };
        self.places
            .insert(convolution, (kind, self.lanes[kind].len()));
        self.lanes[kind].push(convolution);
        if kind == 0 {
            let [a, b] = convolution.factors;
            self.carry(a);
            if convolution.along == TermOrder::Position {
                self.carry(b);
            }
        }
    }

    pub fn carry(&mut self, Stream { row, weighted }: Stream) {
        self.carried
            .insert(match (weighted, &self.series.rows[row.index()]) {
                (true, Row::Coordinate(i)) => Carried::Acceleration(*i),
                (true, _) => Carried::Weighted(row),
                (false, _) => Carried::Plain(row),
            });
    }

    fn push(&mut self, op: Op) -> Operand {
        self.code.push(op, self.part)
    }

    /// A value that exists already, whenever it is needed.
    fn existing_value(&mut self, text: String) -> Operand {
        self.push(Op::Given(text))
    }

    /// `of::<N>(…)`.
    pub fn constructed(&mut self, function: &str) -> Operand {
        let text = format!("{}::{function}", self.code.number());
        self.existing_value(text)
    }

    fn variable(&mut self, carried: Carried) -> Operand {
        if let Carried::Weighted(row) = carried
            && let Row::Coordinate(i) = self.series.rows[row.index()]
        {
            return self.rate_before(i);
        }
        self.carried.insert(carried);
        self.existing_value(carried.name())
    }

    /// The newest coefficient of a rate, one order before.
    fn rate_before(&mut self, coordinate: u32) -> Operand {
        let a = self.variable(Carried::Acceleration(coordinate));
        let over = self.constructed("from_ratio(1, order as i64 - 2)");
        self.multiply(a, over)
    }

    /// The current order plus `more`, as a number.
    fn order(&mut self, more: usize) -> Operand {
        match self.m {
            3 => {
                let less = 2 - self.lead;
                let function = match less - more.min(less) {
                    0 if more == less => "from_f64(order as f64)".to_owned(),
                    0 => format!("from_f64((order + {}) as f64)", more - less),
                    less => format!("from_f64((order - {less}) as f64)"),
                };
                self.constructed(&function)
            }
            m => match m + more {
                0 => Operand::Zero,
                1 => Operand::One,
                m => self.constructed(&format!("from_f64({m}.0)")),
            },
        }
    }

    /// Begins an order of positions.
    pub fn begin(&mut self, part: Part, m: usize) {
        (self.part, self.m, self.lead) = (part, m, 2);
        self.clear_level(Level::Position);
    }

    /// Begins an order of rows that depend on rates.
    pub fn begin_rates(&mut self, m: usize) {
        (self.m, self.lead) = (m, usize::from(self.series.rates_are_ahead));
        self.clear_level(Level::Rate);
    }

    /// Begins an order of rows that depend on accelerations.
    pub fn begin_forces(&mut self, m: usize) {
        (self.m, self.lead) = (m, 0);
        self.clear_level(Level::Acceleration);
    }

    fn clear_level(&mut self, level: Level) {
        for index in 0..self.series.rows.len() {
            if self.series.levels[index] == level {
                (self.newest[index], self.scaled[index]) = (None, None);
            }
        }
    }

    /// Records the values of positions at the start, with as many sines at once as possible.
    pub fn values_of_positions(&mut self, positions: &[RowId]) {
        let angle = |row: &RowId| match self.series.rows[row.index()] {
            Row::Sin(a, _) | Row::Cos(a, _) => Some(a),
            _ => None,
        };
        // Rows that depend on a sine wait until all sines are computed together.
        let mut waits = vec![false; self.series.rows.len()];
        let mut angles = Vec::new();
        for row in positions {
            let mut is_late = false;
            self.series.rows[row.index()].for_each_operand(|operand| {
                is_late |= operand.index() < row.index() && waits[operand.index()];
            });
            if let Some(a) = angle(row) {
                if !waits[a.index()] && !angles.contains(&a) {
                    angles.push(a);
                }
                is_late = true;
            }
            waits[row.index()] = is_late;
        }
        let (early, late): (Vec<RowId>, Vec<RowId>) =
            positions.iter().partition(|row| !waits[row.index()]);
        for row in early {
            self.value(row);
        }
        let values: Vec<Operand> = angles.iter().map(|row| self.first(*row)).collect();
        if !values.is_empty() {
            let all = self.push(Op::Circular(values));
            for (at, row) in angles.into_iter().enumerate() {
                let [sin, cos] = [false, true].map(|cos| self.push(Op::Member(all, at, cos)));
                let turned = self.corrected_sin_cos(row, [sin, cos]);
                self.circular.insert(row, turned);
            }
        }
        for row in late {
            self.value(row);
        }
    }

    /// The value of a row at the start.
    pub fn value(&mut self, row: RowId) {
        if let Row::Time = self.series.rows[row.index()] {
            let low = self.existing_value("n(t[1])".into());
            self.low[row.index()] = Some(low);
        }
        let value = self.series.value(row, self);
        self.first[row.index()] = Some(value);
        self.newest[row.index()] = Some(value);
    }

    /// Corrects sine and cosine for the rounding error of the angle.
    fn corrected_sin_cos(&mut self, row: RowId, [sin, cos]: [Operand; 2]) -> [Operand; 2] {
        let low = if self.series.exact[row.index()] {
            self.low[row.index()].unwrap_or(Operand::Zero)
        } else {
            Operand::Zero
        };
        match low {
            Operand::Zero => [sin, cos],
            _ => [
                self.multiply_add(low, cos, sin),
                self.push(Op::Method("neg_mul_add", vec![low, sin, cos])),
            ],
        }
    }

    /// Records the coefficient of a row at the current order.
    pub fn coefficient(&mut self, row: RowId, order: Order) {
        let Coefficient { plain, weighted } = self.series.coefficient(row, order, self);
        self.newest[row.index()] = Some(plain);
        self.scaled[row.index()] = weighted;
    }

    /// Records the gradients of all rows at the start.
    pub fn differentiate(&mut self) {
        let series = self.series;
        self.gradients = series.gradients(self, |to, [a, b, c]| to.multiply_add(a, b, c));
    }

    /// Records the factored matrices of coupled unknowns.
    pub fn matrices(&mut self) -> Vec<Block> {
        let mut matrices = Vec::new();
        for members in self.series.blocks() {
            let entries = self.series.matrix(&members, &self.gradients).into_iter();
            let entries = entries
                .map(|entry| entry.unwrap_or(Operand::Zero))
                .collect();
            let held = members
                .iter()
                .filter(|row| (**row as usize) < self.series.dimension());
            let op = Op::Factored(entries, held.count(), members.clone());
            let matrix = self.push(op);
            let composition = self.series.composition(&members);
            let composition = composition.map(|composition| {
                let count = members.len();
                let of_unknown = |unknown: usize| {
                    composition.coefficients(self, |to, residual| {
                        to.push(Op::Element(matrix, residual * count + unknown))
                    })
                };
                let coefficients = (0..count).map(of_unknown).collect();
                (composition, coefficients)
            });
            matrices.push(Block {
                members,
                matrix,
                composition,
            });
        }
        matrices
    }

    /// Records the solution for the accelerations of the current order.
    pub fn accelerations(&mut self, matrices: &[Block]) -> Vec<Operand> {
        let mut all = vec![Operand::Zero; self.series.unknowns()];
        for block in matrices {
            let Block {
                members, matrix, ..
            } = block;
            if let Some((composition, coefficients)) = &block.composition
                && self.part == Part::Order
            {
                for (member, coefficients) in members.iter().zip(coefficients) {
                    let sum = |to: &mut Self, row| to.convolution(row, 0);
                    all[*member as usize] =
                        composition.unknown(self.series, self, coefficients, sum);
                }
                continue;
            }
            let residuals = members
                .iter()
                .map(|row| self.series.residuals[*row as usize]);
            let mut right = Vec::new();
            for row in residuals.collect::<Vec<_>>() {
                let residual = self.newest(row);
                right.push(self.negate(residual));
            }
            let count = members.len();
            let found: Vec<Operand> = match count {
                ..=MOST_IN_ONE_SUM => (0..count)
                    .map(|i| {
                        let mut sum = Operand::Zero;
                        for (j, known) in right.iter().enumerate() {
                            let part = std::mem::replace(&mut self.part, Part::Start);
                            let element = self.push(Op::Element(*matrix, j * count + i));
                            self.part = part;
                            sum = self.multiply_add(element, *known, sum);
                        }
                        sum
                    })
                    .collect(),
                _ => {
                    let solved = self.push(Op::Solved(*matrix, right));
                    let element = if is_inverse(count) {
                        Op::OfRegisters
                    } else {
                        Op::Element
                    };
                    (0..count).map(|i| self.push(element(solved, i))).collect()
                }
            };
            for (member, x) in members.iter().zip(found) {
                all[*member as usize] = x;
            }
        }
        all
    }

    /// Records the effect of accelerations on forces as the columns of a matrix, if that is worthwhile.
    pub fn matrix_of_forces(&mut self) -> Option<Vec<Vec<Operand>>> {
        let count = self
            .forces
            .iter()
            .map(|row| self.series.depends[row.index()].len());
        if count.sum::<usize>() <= FEWEST_APPLIED {
            return None;
        }
        let column = |unknown: u32| -> Vec<Operand> {
            let entry = |row: &RowId| {
                let depends = &self.series.depends[row.index()];
                match depends.binary_search(&unknown) {
                    Ok(at) => self.gradients[row.index()][at],
                    Err(_) => Operand::Zero,
                }
            };
            self.forces.iter().map(entry).collect()
        };
        let columns = (0..self.series.unknowns() as u32).map(column);
        Some(columns.collect())
    }

    /// The final coefficients of an order, once the accelerations are known: `[over_v, over_q]` are the reciprocals of the orders
    /// of rates and coordinates, and `product` is the product of both orders as a divisor, if it is not the reciprocal of `over_q`.
    pub fn final_coefficients(
        &mut self,
        a: &[Operand],
        [over_v, over_q]: [Operand; 2],
        product: Option<Operand>,
        is_applied: bool,
    ) -> FinalCoefficients {
        let series = self.series;
        let mut finals = FinalCoefficients {
            rows: self.newest.clone(),
            accelerations: a.to_vec(),
            motion: Vec::new(),
            rates: Vec::new(),
        };
        for &a in &a[..series.dimension()] {
            let rate = self.multiply(a, over_v);
            finals.rates.push(rate);
            // A quotient: products with rounded reciprocals have errors of a fixed sign, which add up over the steps of a long run.
            finals.motion.push(match product {
                Some(product) => match a {
                    Operand::Zero => a,
                    _ => self.push(Op::Method("over", vec![a, product])),
                },
                None => self.multiply(rate, over_q),
            });
        }
        let share = self.multiply(over_v, over_q);
        let applied = if is_applied {
            Some(self.push(Op::Applied(self.forces.len(), a.to_vec())))
        } else {
            None
        };
        let adds_to_known = series.adds_to_forces();
        for (at, row) in self.forces.clone().into_iter().enumerate() {
            let known = self.newest(row);
            finals.rows[row.index()] = Some(match applied {
                _ if adds_to_known => self.change(row, a, known),
                Some(applied) => {
                    let change = self.push(Op::OfRegisters(applied, at));
                    self.add(known, change)
                }
                None => {
                    let change = self.change(row, a, Operand::Zero);
                    self.add(known, change)
                }
            });
        }
        for index in 0..series.rows.len() {
            let row = RowId(index as u32);
            if series.lead(row) == 0 || series.depends[index].is_empty() {
                continue;
            }
            let share = [over_v, share][series.lead(row) - 1];
            finals.rows[index] = Some(match series.rows[index] {
                Row::Coordinate(i) => finals.motion[i as usize],
                Row::Rate(i) => finals.rates[i as usize],
                _ => {
                    let known = self.newest[index].unwrap_or(Operand::Zero);
                    match series.depends[index][..] {
                        // This order of factors shortens the dependency chain by one multiplication.
                        [i] => {
                            let slope = self.multiply(self.gradients[index][0], share);
                            self.multiply_add(slope, a[i as usize], known)
                        }
                        _ => {
                            let change = self.change(row, a, Operand::Zero);
                            self.multiply_add(share, change, known)
                        }
                    }
                }
            });
        }
        finals
    }

    /// The gradient of a row times the newest accelerations, added to a number.
    fn change(&mut self, row: RowId, a: &[Operand], known: Operand) -> Operand {
        let series = self.series;
        let mut sum = known;
        for (at, i) in series.depends[row.index()].iter().enumerate() {
            let g = self.gradients[row.index()][at];
            sum = self.multiply_add(g, a[*i as usize], sum);
        }
        sum
    }

    /// What a stream stores of an order that is final, in packs of rows with the present lead; the order of positions began as `m`.
    pub fn kept(
        &mut self,
        finals: &FinalCoefficients,
        Stream { row, weighted }: Stream,
        m: usize,
    ) -> Operand {
        let lead = self.series.lead(row);
        if lead > self.lead {
            return self.of_order_before(row, weighted, m);
        }
        let plain = finals.rows[row.index()].unwrap_or(Operand::Zero);
        if !weighted {
            return plain;
        }
        match self.series.rows[row.index()] {
            Row::Coordinate(i) => finals.rates[i as usize],
            _ => {
                let before = (self.m, self.lead);
                (self.m, self.lead) = (if m < 3 { m + lead - 2 } else { m }, lead);
                let order = self.order(0);
                (self.m, self.lead) = before;
                self.multiply(order, plain)
            }
        }
    }

    /// The final coefficient of a row that is further ahead than the present ones, at their order. The order of positions began as `m`.
    fn of_order_before(&mut self, row: RowId, weighted: bool, m: usize) -> Operand {
        if m < 3 {
            // Only rates that are ahead begin at the start: their order 1 there is that of these coefficients.
            return self.linear[row.index()].unwrap_or(Operand::Zero);
        }
        self.variable(match (self.series.lead(row) - self.lead, weighted) {
            (1, false) => Carried::Plain(row),
            (1, true) => Carried::Weighted(row),
            (_, weighted) => Carried::Older(row, weighted),
        })
    }
}

impl Recorder<'_> {
    /// The value of a carried variable once an order is final.
    pub fn carried_by(
        &mut self,
        carried: Carried,
        finals: &FinalCoefficients,
        m: usize,
    ) -> Operand {
        let stream = |row: RowId, weighted: bool| Stream { row, weighted };
        match carried {
            Carried::Plain(row) => self.kept(finals, stream(row, false), m),
            Carried::Weighted(row) => self.kept(finals, stream(row, true), m),
            Carried::Older(row, _) if m < 3 => self.linear[row.index()].unwrap_or(Operand::Zero),
            Carried::Older(row, weighted) => self.variable(if weighted {
                Carried::Weighted(row)
            } else {
                Carried::Plain(row)
            }),
            Carried::Acceleration(i) => finals.accelerations[i as usize],
        }
    }
}
