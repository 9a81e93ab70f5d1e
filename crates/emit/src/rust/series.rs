//! The Taylor series of the motion: one sweep over all products of an order, and straight code for the rest.
//!
//! ```text
//! order 0, 1, 2     straight: values, then first coefficients of positions, the mass matrix, the first accelerations
//! order k + 2       w = Σ a_j b_{k+2−j} of every product at once, over coefficients of earlier orders; of rates that are differentiated r = Σ a_j b_{k+1−j}
//!                   what follows from w and the newest coefficients; residuals; accelerations; what these change
//! ```
//!
//! The arithmetic is that of the interpreter (`lagrangian-program`, `series/recurrence.rs`) in the same order, and so are its
//! bits. Factors of products are stored in packs, `a0` and `b0`, to which each order appends. So the sum over orders is a loop
//! over packs, which a compiler vectorizes, and the code does not grow with the order. A list that is a factor of several
//! products is stored in a pack once for each. For several trajectories at once, whose numbers fill registers by themselves, it
//! is stored and read once, at the index given by the constants `A0` and `B0`. The caller provides the packs, so that they need
//! not be cleared in every step.

mod code;
mod recorder;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use lagrangian_program::series::{
    Arithmetic, Convolution, Level, Order, Row, RowId, Series, Stream,
};

use super::Emitter;
use super::kernel::FastFunction;
use super::types::Types;
use crate::layout::Layout;
use code::{Code, Operand, Part};
use recorder::Recorder;

/// The number of lists in a pack.
const WIDTH: usize = 24;

/// Above this number of products, the effect of accelerations on forces is computed by a matrix.
const FEWEST_APPLIED: usize = 32;

/// A variable that one order passes to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Carried {
    /// The newest coefficient of a row.
    Plain(RowId),
    /// A coefficient of a row times its order.
    Weighted(RowId),
    /// The value of one of these two one order before.
    Older(RowId, bool),
    /// The newest coefficient of an acceleration. That of the rate follows in the next order, since a product here would lengthen the
    /// dependency chain by a move of its result into another register.
    Acceleration(u32),
}

impl Carried {
    fn name(self) -> String {
        match self {
            Carried::Plain(row) => format!("y{}", row.0),
            Carried::Weighted(row) => format!("z{}", row.0),
            Carried::Older(row, false) => format!("older_y{}", row.0),
            Carried::Older(row, true) => format!("older_z{}", row.0),
            Carried::Acceleration(i) => format!("acceleration{i}"),
        }
    }
}

/// The code of a series.
struct SeriesCode {
    code: Code,
    /// The rows that depend on parameters alone.
    constants: Vec<RowId>,
    packs: Vec<Pack>,
    /// For each carried variable its initial value, and its value after each order.
    carried: BTreeMap<Carried, [Operand; 2]>,
    /// For each list of products what is stored of both factors: at the start, and after each order.
    kept: [[Vec<[Operand; 2]>; 2]; 3],
    /// The coefficients of order 2 of the coordinates, and those of each order.
    motion: [Vec<Operand>; 2],
    /// The matrix of the effect of accelerations on forces, column by column.
    applied: Option<Vec<Vec<Operand>>>,
}

/// How many orders the rows of each kind of [`Pack`] are [ahead](Series::lead) of the accelerations.
const LEADS: [usize; 3] = [2, 0, 1];

/// The names of the sums of products of each kind of [`Pack`].
const SUMS: [&str; 3] = ["w", "s", "r"];

/// The lists of up to [`WIDTH`] products side by side: of their first factors, and of their second.
struct Pack {
    /// 0 for positions, and for forces along them, 2 for rates that are [ahead](Series::rates_are_ahead), 1 for everything else.
    kind: usize,
    number: usize,
    /// The range of its products among those of its kind.
    range: Range<usize>,
    /// The number of lists that it has room for.
    width: usize,
    /// For each product the index of its factor among the distinct lists of a side.
    places: [Vec<usize>; 2],
}

impl Pack {
    /// Divides these products into packs.
    fn all(lanes: &[Vec<Convolution>; 3]) -> Vec<Pack> {
        let mut packs = Vec::new();
        for (kind, lanes) in lanes.iter().enumerate() {
            for (number, products) in lanes.chunks(WIDTH).enumerate() {
                let start = number * WIDTH;
                packs.push(Pack {
                    kind,
                    number,
                    range: start..start + products.len(),
                    width: padded(products.len()),
                    places: [0, 1].map(|side| places(products, side)),
                });
            }
        }
        packs
    }

    /// The names of both sides.
    fn names(&self) -> [String; 2] {
        let letters = [["a", "b"], ["c", "d"], ["e", "f"]][self.kind];
        letters.map(|letter| format!("{letter}{}", self.number))
    }

    /// The name of the sums of its products.
    fn sums(&self) -> String {
        format!("{}{}", SUMS[self.kind], self.number)
    }

    /// The room and the number of its products, as arguments of functions.
    fn sizes(&self) -> String {
        format!("{}, {}", self.width, self.range.len())
    }
}

/// For each product the index of its factor among the distinct lists of a side, in the order of their occurrence.
fn places(products: &[Convolution], side: usize) -> Vec<usize> {
    let mut known: Vec<Stream> = Vec::new();
    let place = |product: &Convolution| {
        let factor = product.factors[side];
        let place = known.iter().position(|other| *other == factor);
        place.unwrap_or_else(|| {
            known.push(factor);
            known.len() - 1
        })
    };
    products.iter().map(place).collect()
}

impl Emitter<'_> {
    /// The series, if it is requested.
    fn series(&self) -> Option<Arc<Series>> {
        let series = self.options.series.as_ref()?;
        Some(series.series().clone())
    }

    fn generate(&self, series: &Series) -> SeriesCode {
        written(series, &self.types.register, &self.inputs.paths)
    }

    /// The array type in which numbers are stored.
    fn array(&self, length: usize) -> String {
        format!("[{}; {length}]", self.types.scalar)
    }

    /// The constants of the series in `prepare`: their field, its type and its value.
    pub(super) fn constants_of_series(&mut self) -> Option<(String, Layout)> {
        let series = self.series()?;
        let constants = self.generate(&series).constants;
        if constants.is_empty() {
            return None;
        }
        let scalar = self.types.scalar.clone();
        let paths = self.parameters.paths.clone();
        let mut symbolic = Recorder::of_constants(&series, &scalar, &paths);
        let texts: Vec<Operand> = constants.iter().map(|row| symbolic.first(*row)).collect();
        let Recorder { mut code, .. } = symbolic;
        code.prune(texts.iter().copied());
        code.write(&mut self.writer, Part::Start, "", 0);
        let values = texts.iter().map(|x| code.text(*x));
        Some(("series".to_owned(), Layout::array(values)))
    }

    /// The number of constants of the series.
    pub(super) fn number_of_constants_of_series(&self) -> Option<usize> {
        let series = self.series()?;
        let count = self.generate(&series).constants.len();
        (count > 0).then_some(count)
    }

    /// The packs of the series.
    fn packs_of_series(&self, series: &Series) -> Vec<Pack> {
        Pack::all(&Recorder::new(series, &self.types.register, &self.inputs.paths).lanes)
    }

    /// Whether the series is requested and keeps lists of coefficients.
    pub(super) fn has_lists_of_series(&self) -> bool {
        let packs = self.series().map(|series| self.packs_of_series(&series));
        packs.is_some_and(|packs| !packs.is_empty())
    }

    /// The type of the packs of the series for a number type; the unit type if there are none.
    pub(super) fn lists_of_series(&self, scalar: &str) -> String {
        let packs = self.series().map(|series| self.packs_of_series(&series));
        if packs.is_none_or(|packs| packs.is_empty()) {
            "()".to_owned()
        } else {
            format!("{}<{scalar}>", self.types.lists)
        }
    }

    /// Writes the struct of the packs.
    fn struct_of_lists(&mut self, packs: &[Pack]) {
        if packs.is_empty() {
            return;
        }
        let runtime = self.options.runtime.clone();
        let Types { scalar, lists, .. } = self.types.clone();
        let [copy, default] = ["Copy", "Default"].map(|name| self.types.known(name));
        self.writer.gap();
        self.docs(
            "The coefficients of which products are made, order by order, while the Taylor series is computed. What they hold \
             before that does not matter.",
        );
        self.writer.open(format!("pub struct {lists}<{scalar}> {{"));
        for pack in packs {
            for name in pack.names() {
                let width = pack.width;
                self.writer.line(format!(
                    "{name}: {runtime}::series::Pack<{scalar}, {width}>,"
                ));
            }
        }
        self.writer.close("}");
        self.writer.gap();
        self.writer.open(format!(
            "impl<{scalar}: {copy} + {default}> {default} for {lists}<{scalar}> {{"
        ));
        self.writer.signature("fn default", &[], Some("Self"));
        let names = packs.iter().flat_map(Pack::names);
        let zeros = Layout::Atom(format!("{default}::default()"));
        let fields = names.map(|name| (name, zeros.clone()));
        let value = Layout::Struct("Self".into(), fields.collect());
        self.writer.expression("", &value, "");
        self.writer.close("}");
        self.writer.close("}");
    }

    /// Writes the kernel.
    pub(super) fn series_kernel(&mut self) {
        let Some(series) = self.series() else {
            return;
        };
        let written = self.generate(&series);
        self.struct_of_lists(&written.packs);
        let runtime = &self.options.runtime;
        let fast = FastFunction {
            docs: "The Taylor series of the motion through a state: row `j` of `coefficients` becomes `q⁽ʲ⁾/j!`. The time is the \
                   sum of two numbers."
                .to_owned(),
            name: None,
            call: self.types.series.clone(),
            fields: self.fields_of_series(&series),
            result: format!("{}<(), {runtime}::Singular>", self.types.known("Result")),
            code: "series_in".to_owned(),
        };
        self.fast_function(&fast);
        self.open_fast_function(&fast, true);
        self.series_code(&written);
        self.writer.line("Ok(())");
        self.writer.close("}");
    }

    fn fields_of_series(&self, series: &Series) -> Vec<(String, String)> {
        let Types {
            prepared,
            scalar,
            inputs,
            lists,
            ..
        } = &self.types;
        let vector = self.array(self.program.dimension());
        let reads = |row: fn(&Row) -> bool| series.rows.iter().any(row);
        let all = [
            (
                self.number_of_constants_of_series().is_some(),
                "p",
                format!("&{prepared}<{scalar}>"),
            ),
            (reads(|row| matches!(row, Row::Time)), "t", self.array(2)),
            (true, "q", format!("&{vector}")),
            (true, "v", format!("&{vector}")),
            (
                reads(|row| matches!(row, Row::Input(_))),
                "u",
                format!("&{inputs}<{scalar}>"),
            ),
            (
                !self.packs_of_series(series).is_empty(),
                "lists",
                format!("&mut {lists}<{scalar}>"),
            ),
            (true, "coefficients", format!("&mut [{vector}]")),
        ];
        let used = all.into_iter().filter(|(is_used, ..)| *is_used);
        used.map(|(_, name, kind)| (name.to_owned(), kind))
            .collect()
    }

    /// The call of the series as a value, if the series is requested.
    pub(super) fn call_of_series(&self) -> Option<Layout> {
        let series = self.series()?;
        let names = self.fields_of_series(&series).into_iter();
        let fields = names.map(|(name, _)| {
            let value = Layout::Atom(name.clone());
            (name, value)
        });
        Some(Layout::Struct(self.types.series.clone(), fields.collect()))
    }

    fn series_code(&mut self, written: &SeriesCode) {
        let runtime = self.options.runtime.clone();
        let register = self.types.register.clone();
        let n = self.program.dimension();
        let SeriesCode { code, packs, .. } = written;
        code.write(&mut self.writer, Part::Start, &runtime, n);
        if let Some(columns) = &written.applied {
            let columns = columns.iter().map(|column| code.kept(column, 0));
            self.writer
                .expression("let forces = ", &Layout::nested(columns), ";");
        }
        let [second, later] = &written.motion;
        self.writer
            .expression("let second = ", &code.kept(second, 0), ";");
        self.writer
            .open("for (row, x) in coefficients.iter_mut().zip([*q, *v, second]) {");
        self.writer.line("*row = x;");
        self.writer.close("}");
        let usize = self.types.known("usize");
        for pack in packs {
            for (name, places) in pack.names().iter().zip(&pack.places) {
                let places = Layout::array(places.iter().map(usize::to_string));
                let (name, count) = (name.to_uppercase(), pack.range.len());
                self.writer.expression(
                    &format!("const {name}: [{usize}; {count}] = "),
                    &places,
                    ";",
                );
            }
        }
        for pack in packs.iter().filter(|pack| pack.kind != 1) {
            self.write_stored(written, pack, "2", |[first, _]| first);
        }
        for (carried, [first, _]) in &written.carried {
            let (name, first) = (carried.name(), code.text(*first));
            self.writer.line(format!("let mut {name} = {first};"));
        }
        self.writer.line(format!(
            "let count = coefficients.len().min({runtime}::series::ROWS);"
        ));
        self.writer.open("for order in 3..count {");
        for pack in packs {
            let [a, b] = pack.names();
            let [of_a, of_b] = [&a, &b].map(|name| name.to_uppercase());
            let call = Layout::List(
                format!("{runtime}::series::sweep::<{register}, {}>(", pack.sizes()),
                [
                    format!("[&lists.{a}.0, &lists.{b}.0]"),
                    ["order - 2", "order - 2", "order - 1"][pack.kind].to_owned(),
                    format!("[&{of_a}, &{of_b}]"),
                ]
                .map(Layout::Atom)
                .to_vec(),
                ")",
            );
            let sums = pack.sums();
            self.writer
                .expression(&format!("let {sums} = "), &call, ";");
        }
        code.write(&mut self.writer, Part::Order, &runtime, n);
        self.writer
            .open("if let Some(row) = coefficients.get_mut(order) {");
        self.writer.expression("*row = ", &code.kept(later, 0), ";");
        self.writer.close("}");
        for pack in packs {
            let at = ["order", "order - 1", "order"][pack.kind];
            self.write_stored(written, pack, at, |[_, kept]| kept);
        }
        for (carried, [_, last]) in &written.carried {
            let (name, last) = (carried.name(), code.text(*last));
            self.writer.line(format!("{name} = {last};"));
        }
        self.writer.close("}");
    }

    /// Writes what both sides of a pack store at the start, or after each order.
    fn write_stored(
        &mut self,
        written: &SeriesCode,
        pack: &Pack,
        at: &str,
        which: fn([Operand; 2]) -> Operand,
    ) {
        let register = &self.types.register;
        let runtime = &self.options.runtime;
        for (side, name) in pack.names().iter().enumerate() {
            let kept = written.kept[pack.kind][side][pack.range.clone()].iter();
            let kept: Vec<Operand> = kept.copied().map(which).collect();
            let call = Layout::List(
                format!("{runtime}::series::keep::<{register}, {}>(", pack.sizes()),
                vec![
                    Layout::Atom(format!("&mut lists.{name}.0")),
                    Layout::Atom(at.to_owned()),
                    written.code.kept(&kept, pack.width),
                    Layout::Atom(format!("&{}", name.to_uppercase())),
                ],
                ")",
            );
            self.writer.expression("", &call, ";");
        }
    }
}

/// The number of lanes, rounded up to registers.
fn padded(lanes: usize) -> usize {
    match lanes {
        0..=2 => 2,
        _ => lanes.next_multiple_of(4),
    }
}

/// The rows of a series, by what they depend on.
struct RowsByLevel {
    positions: Vec<RowId>,
    rates: Vec<RowId>,
    forces: Vec<RowId>,
}

impl RowsByLevel {
    fn of(series: &Series) -> RowsByLevel {
        let at = |level: Level| -> Vec<RowId> {
            let rows = (0..series.rows.len() as u32).map(RowId);
            rows.filter(|row| series.level(*row) == level).collect()
        };
        RowsByLevel {
            positions: at(Level::Position),
            rates: at(Level::Rate),
            forces: at(Level::Acceleration),
        }
    }
}

impl Recorder<'_> {
    /// The rows up to the order 2 of the coordinates.
    fn first_orders(&mut self, series: &Series, rows: &RowsByLevel) {
        let RowsByLevel {
            positions,
            rates,
            forces,
        } = rows;
        self.values_of_positions(positions);
        self.begin(Part::Start, 1);
        for row in positions {
            self.coefficient(*row, Order::First);
        }
        self.linear = self.newest.clone();
        if series.rates_are_ahead {
            self.begin_rates(0);
            rates.iter().for_each(|row| self.value(*row));
        }
        self.begin(Part::Start, 2);
        for row in positions {
            self.coefficient(*row, Order::Later);
        }
        if series.rates_are_ahead {
            self.begin_rates(1);
            let order = Order::First;
            rates.iter().for_each(|row| self.coefficient(*row, order));
        } else {
            self.begin_rates(0);
            rates.iter().for_each(|row| self.value(*row));
        }
        self.begin_forces(0);
        forces.iter().for_each(|row| self.value(*row));
        self.differentiate();
    }

    /// The rows of any higher order.
    fn later_orders(&mut self, rows: &RowsByLevel) {
        self.begin(Part::Order, 3);
        for row in &rows.positions {
            self.coefficient(*row, Order::Later);
        }
        self.begin_rates(3);
        for row in &rows.rates {
            self.coefficient(*row, Order::Later);
        }
        self.begin_forces(3);
        for row in &rows.forces {
            self.coefficient(*row, Order::Later);
        }
    }

    /// What is carried from one order to the next, at the start and later; `known` is what was needed of the start before.
    fn carried_values(
        &mut self,
        [start, later]: [&FinalCoefficients; 2],
        known: &BTreeMap<Carried, Operand>,
    ) -> BTreeMap<Carried, [Operand; 2]> {
        // A value of one order before requires the current value to be carried too.
        for which in self.carried.clone() {
            if let Carried::Older(row, weighted) = which {
                self.carry(Stream { row, weighted });
            }
        }
        let mut carried = BTreeMap::new();
        for which in self.carried.clone() {
            self.part = Part::Start;
            let known = known.get(&which).copied();
            let first = known.unwrap_or_else(|| self.carried_by(which, start, 2));
            self.part = Part::Order;
            carried.insert(which, [first, self.carried_by(which, later, 3)]);
        }
        carried
    }
}

/// Generates the code of a series.
fn written(series: &Series, number: &str, inputs: &[String]) -> SeriesCode {
    let mut to = Recorder::new(series, number, inputs);
    let rows = RowsByLevel::of(series);
    to.first_orders(series, &rows);
    let matrices = to.matrices();
    let a = to.accelerations(&matrices);
    let applied = to.matrix_of_forces();
    let half = to.constructed("from_f64(0.5)");
    let start = to.final_coefficients(&a, [Operand::One, half], None, false);
    let lanes = to.lanes.clone();
    let factors = |kind: usize, side: usize| -> Vec<Stream> {
        let lanes = lanes[kind].iter();
        lanes.map(|convolution| convolution.factors[side]).collect()
    };
    let mut kept: [[Vec<[Operand; 2]>; 2]; 3] = Default::default();
    for (kind, sides) in kept.iter_mut().enumerate() {
        for (side, list) in sides.iter_mut().enumerate() {
            to.lead = LEADS[kind];
            for stream in factors(kind, side) {
                let first = match kind {
                    1 => Operand::Zero,
                    _ => to.kept(&start, stream, 2),
                };
                list.push([first, first]);
            }
        }
    }
    to.lead = 2;
    let mut carried = BTreeMap::new();
    for which in to.carried.clone() {
        carried.insert(which, to.carried_by(which, &start, 2));
    }

    to.later_orders(&rows);
    let a = to.accelerations(&matrices);
    let over_v = to.constructed("from_ratio(1, order as i64 - 1)");
    let over_q = to.constructed("from_ratio(1, order as i64)");
    let product = to.constructed("divisor(order as i64 * (order as i64 - 1))");
    let over = [over_v, over_q];
    let later = to.final_coefficients(&a, over, Some(product), applied.is_some());
    for (kind, sides) in kept.iter_mut().enumerate() {
        to.lead = LEADS[kind];
        for (side, list) in sides.iter_mut().enumerate() {
            for (stream, kept) in factors(kind, side).into_iter().zip(list) {
                kept[1] = to.kept(&later, stream, 3);
            }
        }
    }
    to.lead = 2;
    let carried = to.carried_values([&start, &later], &carried);
    let motion = [start.motion, later.motion];
    let Recorder {
        mut code,
        constants,
        ..
    } = to;
    let all = motion.iter().flatten().copied();
    let all = all.chain(kept.iter().flatten().flatten().flatten().copied());
    let all = all.chain(carried.values().flatten().copied());
    let all: Vec<Operand> = all
        .chain(applied.iter().flatten().flatten().copied())
        .collect();
    code.prune(all.into_iter());
    SeriesCode {
        code,
        constants,
        packs: Pack::all(&lanes),
        carried,
        kept,
        motion,
        applied,
    }
}

/// Final coefficients: of rows, and of coordinates, their rates and their accelerations.
struct FinalCoefficients {
    rows: Vec<Option<Operand>>,
    accelerations: Vec<Operand>,
    motion: Vec<Operand>,
    rates: Vec<Operand>,
}
