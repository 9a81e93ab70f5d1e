//! Straight-line code under construction: operations with their dependencies, of which only the needed ones are written.

use std::collections::HashMap;

use lagrangian_program::series::is_inverse;

use crate::layout::{Layout, Writer};

/// A number in the code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operand {
    /// 0.
    Zero,
    /// 1.
    One,
    /// −1.
    MinusOne,
    /// The result of an operation.
    Value(u32),
}

/// The part of the code that contains an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// Before the loop over orders.
    Start,
    /// In the loop over orders.
    Order,
}

/// An operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A value that exists already, by its text.
    Given(String),
    /// An infix operation such as `a + b`.
    Infix(&'static str, Operand, Operand),
    /// `−a`.
    Negative(Operand),
    /// `a.method(b, c)`.
    Method(&'static str, Vec<Operand>),
    /// Sines and cosines of several angles.
    Circular(Vec<Operand>),
    /// A sine or cosine of several: the index of the angle, and whether it is the cosine.
    Member(Operand, usize, bool),
    /// The factored matrix of coupled unknowns: its entries row by row, how many of the unknowns are coordinates,
    /// and their indices.
    Factored(Vec<Operand>, usize, Vec<u32>),
    /// The solution for a matrix and right-hand sides.
    Solved(Operand, Vec<Operand>),
    /// An element of a matrix, or of a solution without an inverse: an array of stored numbers.
    Element(Operand, usize),
    /// The matrix of forces times numbers, and the length of its columns.
    Applied(usize, Vec<Operand>),
    /// An element of such a product, or of a solution by an inverse: an array of numbers in registers.
    OfRegisters(Operand, usize),
}

impl Op {
    fn operands(&self) -> Vec<Operand> {
        match self {
            Op::Given(_) => Vec::new(),
            Op::Infix(_, a, b) => vec![*a, *b],
            Op::Negative(a) | Op::Member(a, ..) | Op::Element(a, _) | Op::OfRegisters(a, _) => {
                vec![*a]
            }
            Op::Method(_, all)
            | Op::Circular(all)
            | Op::Factored(all, ..)
            | Op::Applied(_, all) => all.clone(),
            Op::Solved(matrix, all) => [*matrix].into_iter().chain(all.iter().copied()).collect(),
        }
    }
}

/// Operations in the order of execution.
#[derive(Debug)]
pub struct Code {
    /// The type of the numbers.
    number: String,
    /// The first letter of the names of results.
    letter: char,
    ops: Vec<(Op, Part)>,
    known: HashMap<Op, u32>,
    is_needed: Vec<bool>,
}

impl Code {
    pub fn new(number: &str, letter: char) -> Code {
        Code {
            number: number.to_owned(),
            letter,
            ops: Vec::new(),
            known: HashMap::new(),
            is_needed: Vec::new(),
        }
    }

    pub fn number(&self) -> &str {
        &self.number
    }

    pub fn push(&mut self, op: Op, part: Part) -> Operand {
        if let Some(known) = self.known.get(&op) {
            return Operand::Value(*known);
        }
        let id = self.ops.len() as u32;
        self.known.insert(op.clone(), id);
        self.ops.push((op, part));
        Operand::Value(id)
    }

    /// Marks the operations that these values need; others are not written.
    pub fn prune(&mut self, wanted: impl Iterator<Item = Operand>) {
        self.is_needed = vec![false; self.ops.len()];
        let mut open: Vec<Operand> = wanted.collect();
        while let Some(x) = open.pop() {
            if let Operand::Value(id) = x
                && !std::mem::replace(&mut self.is_needed[id as usize], true)
            {
                open.extend(self.ops[id as usize].0.operands());
            }
        }
    }

    /// The text of a number.
    pub fn text(&self, x: Operand) -> String {
        match x {
            Operand::Zero => format!("{}::ZERO", self.number),
            Operand::One => format!("{}::ONE", self.number),
            Operand::MinusOne => format!("-{}::ONE", self.number),
            Operand::Value(id) => format!("{}{id}", self.letter),
        }
    }

    /// The text of a number as the receiver of a method call.
    fn receiver(&self, x: Operand) -> String {
        match x {
            // A method call binds more tightly than the sign.
            Operand::MinusOne => format!("(-{}::ONE)", self.number),
            _ => self.text(x),
        }
    }

    /// An array of stored numbers, padded with zeros to a length.
    pub fn kept(&self, all: &[Operand], length: usize) -> Layout {
        let rest = length.saturating_sub(all.len());
        let all = all
            .iter()
            .copied()
            .chain(std::iter::repeat_n(Operand::Zero, rest));
        Layout::array(all.map(|x| format!("{}.store()", self.receiver(x))))
    }

    /// Writes the operations of a part, for a machine with this number of coordinates.
    pub fn write(&self, writer: &mut Writer, part: Part, runtime: &str, coordinates: usize) {
        let text = |x: &Operand| self.text(*x);
        let list = |all: &[Operand]| -> Vec<String> { all.iter().map(text).collect() };
        let number = &self.number;
        for (id, (op, at)) in self.ops.iter().enumerate() {
            if *at != part || !self.is_needed[id] {
                continue;
            }
            let name = format!("{}{id}", self.letter);
            let value = match op {
                Op::Given(given) => given.clone(),
                Op::Infix(sign, a, b) => format!("{} {sign} {}", text(a), text(b)),
                Op::Negative(a) => format!("-{}", text(a)),
                Op::Method(method, all) => {
                    let (of, others) = (self.receiver(all[0]), list(&all[1..]));
                    format!("{of}.{method}({})", others.join(", "))
                }
                Op::Circular(all) => {
                    let angles = Layout::array(list(all));
                    writer.expression(&format!("let angles{id} = "), &angles, ";");
                    format!("{number}::sin_cos_all(angles{id})")
                }
                Op::Member(of, at, is_cos) => {
                    format!("{}[{at}].{}", text(of), usize::from(*is_cos))
                }
                Op::Factored(entries, held, members) => {
                    let matrix = (entries.as_slice(), *held, members.as_slice());
                    self.write_factored(writer, id, matrix, (runtime, coordinates));
                    continue;
                }
                Op::Solved(matrix, right) => {
                    self.write_solved(writer, id, *matrix, right, runtime);
                    continue;
                }
                Op::Element(of, at) => format!("n({}[{at}])", text(of)),
                Op::OfRegisters(of, at) => format!("{}[{at}]", text(of)),
                Op::Applied(length, all) => {
                    let arguments = Layout::array(list(all));
                    writer.expression(&format!("let factors{id} = "), &arguments, ";");
                    let count = all.len();
                    let call = call(
                        format!("{runtime}::series::apply::<{number}, {length}, {count}>("),
                        ["&forces".to_owned(), format!("&factors{id}")],
                    );
                    writer.expression(&format!("let {name} = "), &call, ";");
                    continue;
                }
            };
            writer.expression(&format!("let {name} = "), &Layout::Atom(value), ";");
        }
    }

    /// Writes the factors of a matrix with these `entries`, of which the last rows are those of `held` constraints, and the error of a pivot
    /// that vanishes, with the number of the member.
    fn write_factored(
        &self,
        writer: &mut Writer,
        id: usize,
        (entries, held, members): (&[Operand], usize, &[u32]),
        (runtime, coordinates): (&str, usize),
    ) {
        let (name, number) = (format!("{}{id}", self.letter), &self.number);
        writer.expression(&format!("let mut {name} = "), &self.kept(entries, 0), ";");
        let count = members.len();
        let members = Layout::array(members.iter().map(u32::to_string));
        writer.expression(&format!("let members{id} = "), &members, ";");
        let factor = call(
            format!("{runtime}::series::factor::<{number}>("),
            [count.to_string(), held.to_string(), format!("&mut {name}")],
        );
        writer.expression("let factored = ", &factor, ";");
        writer.open("if let Err(vanished) = factored {");
        let error = call(
            format!("{runtime}::series::singular("),
            [
                "vanished".to_owned(),
                format!("&members{id}"),
                coordinates.to_string(),
            ],
        );
        writer.expression("let singular = ", &error, ";");
        writer.line("return Err(singular);");
        writer.close("}");
    }

    /// Writes the solution of a factored system with this right-hand side.
    fn write_solved(
        &self,
        writer: &mut Writer,
        id: usize,
        matrix: Operand,
        right: &[Operand],
        runtime: &str,
    ) {
        let (name, number) = (format!("{}{id}", self.letter), &self.number);
        let (matrix, count) = (self.text(matrix), right.len());
        if is_inverse(count) {
            let sides = right.iter().map(|x| self.text(*x));
            let call = Layout::List(
                format!("{runtime}::series::solved::<{number}, {count}>("),
                vec![Layout::Atom(format!("&{matrix}")), Layout::array(sides)],
                ")",
            );
            writer.expression(&format!("let {name} = "), &call, ";");
            return;
        }
        writer.expression(&format!("let mut {name} = "), &self.kept(right, 0), ";");
        writer.line(format!("let mut scratch{id} = {name};"));
        writer.line(format!(
            "let (x, scratch) = (&mut {name}, &mut scratch{id});"
        ));
        writer.line(format!(
            "{runtime}::series::solve::<{number}>({count}, &{matrix}, x, scratch);"
        ));
    }
}

/// The call of a function, which begins with its name and a bracket.
fn call<const N: usize>(function: String, arguments: [String; N]) -> Layout {
    Layout::List(function, arguments.map(Layout::Atom).to_vec(), ")")
}
