//! The Taylor series of the motion: one sweep over all products of an order, and straight code for the rest.
//!
//! ```text
//! order 0, 1, 2     straight: values, then first coefficients of positions, the mass matrix, the first accelerations
//! order k + 2       w = Σ a_j b_{k+2−j} of every product at once, over coefficients of earlier orders
//!                   what follows from w and the newest coefficients; residuals; accelerations; what these change
//! ```
//!
//! Arithmetic is that of the interpreter (`lagrangian-program`, `series/recurrence.rs`), in the same order, and so are its
//! bits. Factors of products lie in packs, `a0` and `b0`, that one order fills after the other; so the sum over orders is a
//! loop over packs, which a compiler turns into vector instructions, and code does not grow with the order.

mod arithmetic;
mod code;

use std::collections::BTreeMap;
use std::sync::Arc;

use lagrangian_program::series::{
    Arithmetic, Convolution, Level, Order, Row, RowId, Series, Stream,
};

use super::Emitter;
use super::types::Types;
use crate::layout::Layout;
use arithmetic::Symbolic;
use code::{Code, Part, X};

/// How many streams lie in a pack.
const WIDTH: usize = 24;

/// Above so many products, what accelerations change in forces is a matrix times them.
const FEWEST_APPLIED: usize = 32;

/// Above so many unknowns, that act on each other, the accelerations are solved for by a loop.
const MOST_STRAIGHT: usize = 3;

/// A variable that one order leaves to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Carried {
    /// The newest coefficient of a row.
    Plain(RowId),
    /// A coefficient of a row times its order.
    Weighted(RowId),
    /// What one of these two held an order before.
    Older(RowId, bool),
    /// The newest coefficient of a rate.
    Rate(u32),
}

impl Carried {
    fn name(self) -> String {
        match self {
            Carried::Plain(row) => format!("y{}", row.0),
            Carried::Weighted(row) => format!("z{}", row.0),
            Carried::Older(row, false) => format!("older_y{}", row.0),
            Carried::Older(row, true) => format!("older_z{}", row.0),
            Carried::Rate(i) => format!("r{i}"),
        }
    }
}

/// The code of a series.
struct Written {
    code: Code,
    /// What the parameters decide, by rows.
    constants: Vec<RowId>,
    /// Streams of positions and forces, and of everything else, in the order of their lanes.
    lanes: [Vec<Convolution>; 2],
    /// For each carried variable what it begins with, and what an order leaves in it.
    carried: BTreeMap<Carried, [X; 2]>,
    /// For each list of lanes what is kept of both factors: at the start, and of each order.
    kept: [[Vec<[X; 2]>; 2]; 2],
    /// The coefficients of the coordinates of order 2, and of each order.
    motion: [Vec<X>; 2],
    /// The matrix by which accelerations change forces, column by column.
    applied: Option<Vec<Vec<X>>>,
}

impl Emitter<'_> {
    /// The series, if it is asked for.
    fn series(&self) -> Option<Arc<Series>> {
        let series = self.options.series.as_ref()?;
        Some(series.series().clone())
    }

    fn written(&self, series: &Series) -> Written {
        written(series, &self.types.register, &self.inputs.paths)
    }

    /// The type that a number is kept as.
    fn array(&self, length: usize) -> String {
        format!("[{}; {length}]", self.types.scalar)
    }

    /// The constants of the series, in `prepare`: their field, its type and its value.
    pub(super) fn constants_of_series(&mut self) -> Option<(String, Layout)> {
        let series = self.series()?;
        let constants = self.written(&series).constants;
        if constants.is_empty() {
            return None;
        }
        let scalar = self.types.scalar.clone();
        let paths = self.parameters.paths.clone();
        let mut symbolic = Symbolic::of_constants(&series, &scalar, &paths);
        let texts: Vec<X> = constants.iter().map(|row| symbolic.first(*row)).collect();
        let Symbolic { mut code, .. } = symbolic;
        code.prune(texts.iter().copied());
        code.write(&mut self.writer, Part::Start, "", 0);
        let values = texts.iter().map(|x| code.text(*x));
        Some(("series".to_owned(), Layout::array(values)))
    }

    /// How many constants the series has.
    pub(super) fn number_of_constants_of_series(&self) -> Option<usize> {
        let series = self.series()?;
        let count = self.written(&series).constants.len();
        (count > 0).then_some(count)
    }

    /// The kernel.
    pub(super) fn series_kernel(&mut self) {
        let Some(series) = self.series() else {
            return;
        };
        let written = self.written(&series);
        let runtime = self.options.runtime.clone();
        let Types {
            scalar, register, ..
        } = self.types.clone();
        let call = self.types.series.clone();
        let fields = self.fields_of_series(&series);
        let copy = self.types.known("Copy");
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        self.writer.gap();
        self.docs(
            "The Taylor series of the motion through a state, to be run with whatever instructions the processor has: row \
             `j` of `coefficients` becomes `q⁽ʲ⁾/j!`. The time is the sum of two numbers.",
        );
        self.writer
            .open(format!("pub struct {call}<'a, {scalar}> {{"));
        for (name, kind) in &fields {
            self.writer
                .line(format!("{name}: {},", super::kernel::with_lifetime(kind)));
        }
        self.writer.close("}");
        self.writer.gap();
        self.writer.open(format!(
            "impl<{scalar}: {copy}> {runtime}::scalar::Kernel<{scalar}> for {call}<'_, {scalar}> {{"
        ));
        self.writer.line(format!("type Output = {result};"));
        self.writer.gap();
        self.writer.line("#[inline(always)]");
        self.writer.signature(
            &format!("fn run<{register}: {runtime}::Scalar<Stored = {scalar}>>"),
            &["self".to_owned()],
            Some("Self::Output"),
        );
        let names = fields
            .iter()
            .map(|(name, _)| (name.clone(), Layout::Atom(name.clone())));
        let names = Layout::Struct("Self".into(), names.collect());
        self.writer.expression("let ", &names, " = self;");
        self.writer.line(format!("let n = {register}::load;"));
        self.series_code(&written);
        self.writer.line("Ok(())");
        self.writer.close("}");
        self.writer.close("}");
    }

    fn fields_of_series(&self, series: &Series) -> Vec<(String, String)> {
        let Types {
            prepared,
            scalar,
            inputs,
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
            (true, "coefficients", format!("&mut [{vector}]")),
        ];
        let used = all.into_iter().filter(|(is_used, ..)| *is_used);
        used.map(|(_, name, kind)| (name.to_owned(), kind))
            .collect()
    }

    /// The call of the series as a value, if it is asked for.
    pub(super) fn call_of_series(&self) -> Option<Layout> {
        let series = self.series()?;
        let names = self.fields_of_series(&series).into_iter();
        let fields = names.map(|(name, _)| (name.clone(), Layout::Atom(name)));
        Some(Layout::Struct(self.types.series.clone(), fields.collect()))
    }

    fn series_code(&mut self, written: &Written) {
        let runtime = self.options.runtime.clone();
        let register = self.types.register.clone();
        let n = self.program.dimension();
        let code = &written.code;
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
        let mut packs = Vec::new();
        for (kind, names) in [["a", "b"], ["c", "d"]].into_iter().enumerate() {
            for (pack, lanes) in written.lanes[kind].chunks(WIDTH).enumerate() {
                let names = names.map(|name| format!("{name}{pack}"));
                let from = pack * WIDTH;
                packs.push((kind, names, from..from + lanes.len(), padded(lanes.len())));
            }
        }
        for (kind, names, range, width) in &packs {
            for (side, name) in names.iter().enumerate() {
                self.writer.line(format!(
                    "let zeros = [[{register}::ZERO.store(); {width}]; {runtime}::series::ROWS];"
                ));
                self.writer.line(format!(
                    "let mut {name} = {runtime}::series::Aligned(zeros);"
                ));
                if *kind == 0 {
                    let first = written.kept[*kind][side][range.clone()].iter();
                    let first: Vec<X> = first.map(|[first, _]| *first).collect();
                    let first = code.kept(&first, *width);
                    self.writer
                        .expression(&format!("{name}.0[2] = "), &first, ";");
                }
            }
        }
        for (carried, [first, _]) in &written.carried {
            let (name, first) = (carried.name(), code.text(*first));
            self.writer.line(format!("let mut {name} = {first};"));
        }
        self.writer.line(format!(
            "let count = coefficients.len().min({runtime}::series::ROWS);"
        ));
        self.writer.open("for order in 3..count {");
        for (kind, [a, b], range, width) in &packs {
            let name = format!("{}{}", ["w", "s"][*kind], range.start / WIDTH);
            let call = Layout::List(
                format!("{runtime}::series::sweep::<{register}, {width}>("),
                [format!("&{a}.0"), format!("&{b}.0"), "order - 2".to_owned()]
                    .map(Layout::Atom)
                    .to_vec(),
                ")",
            );
            self.writer
                .expression(&format!("let {name} = "), &call, ";");
        }
        code.write(&mut self.writer, Part::Order, &runtime, n);
        self.writer
            .open("if let Some(row) = coefficients.get_mut(order) {");
        self.writer.expression("*row = ", &code.kept(later, 0), ";");
        self.writer.close("}");
        for (kind, names, range, width) in &packs {
            let at = ["order", "order - 1"][*kind];
            for (side, name) in names.iter().enumerate() {
                let kept = written.kept[*kind][side][range.clone()].iter();
                let kept: Vec<X> = kept.map(|[_, kept]| *kept).collect();
                self.writer
                    .open(format!("if let Some(kept) = {name}.0.get_mut({at}) {{"));
                let kept = code.kept(&kept, *width);
                self.writer.expression("*kept = ", &kept, ";");
                self.writer.close("}");
            }
        }
        for (carried, [_, last]) in &written.carried {
            let (name, last) = (carried.name(), code.text(*last));
            self.writer.line(format!("{name} = {last};"));
        }
        self.writer.close("}");
    }
}

/// Lanes as registers hold them.
fn padded(lanes: usize) -> usize {
    match lanes {
        0..=2 => 2,
        _ => lanes.next_multiple_of(4),
    }
}

/// Writes a series.
fn written(series: &Series, number: &str, inputs: &[String]) -> Written {
    let mut to = Symbolic::new(series, number, inputs);
    let rows = || (0..series.rows.len() as u32).map(RowId);
    let at = |level: Level| -> Vec<RowId> {
        let rows = rows().filter(|row| series.level(*row) == level);
        rows.collect()
    };
    let [positions, rates, forces] = [Level::Position, Level::Rate, Level::Acceleration].map(at);
    let others: Vec<RowId> = rates.into_iter().chain(forces).collect();

    // Orders 0, 1 and 2.
    to.values_of_positions(&positions);
    to.begin(Part::Start, 1);
    for row in &positions {
        to.coefficient(*row, Order::First);
    }
    to.linear = to.newest.clone();
    to.begin(Part::Start, 2);
    for row in &positions {
        to.coefficient(*row, Order::Later);
    }
    to.begin_others(0);
    for row in &others {
        to.value(*row);
    }
    to.differentiate();
    let matrices = to.matrices();
    let a = to.accelerations(&matrices);
    let applied = to.matrix_of_forces();
    let half = to.made("from_f64(0.5)");
    let start = to.finals(&a, [X::One, half], false);
    let lanes = to.lanes.clone();
    let factors = |kind: usize, side: usize| -> Vec<Stream> {
        let lanes = lanes[kind].iter();
        lanes.map(|convolution| convolution.factors[side]).collect()
    };
    let mut kept: [[Vec<[X; 2]>; 2]; 2] = Default::default();
    for (kind, sides) in kept.iter_mut().enumerate() {
        for (side, list) in sides.iter_mut().enumerate() {
            to.is_of_positions = kind == 0;
            for stream in factors(kind, side) {
                let first = match kind {
                    0 => to.kept(&start, stream, 2),
                    _ => X::Zero,
                };
                list.push([first, first]);
            }
        }
    }
    to.is_of_positions = true;
    let mut carried = BTreeMap::new();
    for which in to.carried.clone() {
        carried.insert(which, to.carried_by(which, &start, 2));
    }

    // Every order after these.
    to.begin(Part::Order, 3);
    for row in &positions {
        to.coefficient(*row, Order::Later);
    }
    to.begin_others(3);
    for row in &others {
        to.coefficient(*row, Order::Later);
    }
    let a = to.accelerations(&matrices);
    let over_v = to.made("from_ratio(1, order as i64 - 1)");
    let over_q = to.made("from_ratio(1, order as i64)");
    let later = to.finals(&a, [over_v, over_q], applied.is_some());
    for (kind, sides) in kept.iter_mut().enumerate() {
        to.is_of_positions = kind == 0;
        for (side, list) in sides.iter_mut().enumerate() {
            for (stream, kept) in factors(kind, side).into_iter().zip(list) {
                kept[1] = to.kept(&later, stream, 3);
            }
        }
    }
    to.is_of_positions = true;
    // What was held an order before asks for what holds it now.
    for which in to.carried.clone() {
        if let Carried::Older(row, weighted) = which {
            to.carry(Stream { row, weighted });
        }
    }
    let mut variables = BTreeMap::new();
    for which in to.carried.clone() {
        let known = carried.get(&which).copied();
        to.part = Part::Start;
        let first = known.unwrap_or_else(|| to.carried_by(which, &start, 2));
        to.part = Part::Order;
        variables.insert(which, [first, to.carried_by(which, &later, 3)]);
    }
    let motion = [start.motion, later.motion];
    let Symbolic {
        mut code,
        constants,
        ..
    } = to;
    let all = motion.iter().flatten().copied();
    let all = all.chain(kept.iter().flatten().flatten().flatten().copied());
    let all = all.chain(variables.values().flatten().copied());
    let all: Vec<X> = all
        .chain(applied.iter().flatten().flatten().copied())
        .collect();
    code.prune(all.into_iter());
    Written {
        code,
        constants,
        lanes,
        carried: variables,
        kept,
        motion,
        applied,
    }
}

/// Coefficients that are final: those of rows, and of coordinates and their rates.
struct Finals {
    rows: Vec<Option<X>>,
    motion: Vec<X>,
    rates: Vec<X>,
}
