//! Straight-line code as statements of a language with operators: the part that Rust and C share.
//!
//! Every value that is used more than once becomes a variable. A value that is used once is written inside the
//! expression that uses it, as long as the expression stays readable. The order of operations inside an expression is
//! that of the program, so rounding is the same as if every value were a variable.

use std::collections::BTreeMap;

use lagrangian_symbolic::sorting::sort_by;
use lagrangian_symbolic::{self as symbolic, Rational};

use super::layout::{Writer, width};
use super::names::{Scope, word};
use lagrangian_program as program;
use lagrangian_program::{
    Contracted, Contraction, Contractions, EliminationStep, Function, Guard, Op, Pack,
    PackedOperation, PackedStatement, Source, Value,
};

mod repeats;

pub use repeats::{ArrayElement, Loops, Plan, fill, runs, statements_with_loops};

/// The longest expression that is inlined into another one.
const LONGEST_INLINE: usize = 72;

/// The longest expression with a method call that is inlined into another one: rustfmt breaks longer ones.
const LONGEST_CALL: usize = 58;

/// How a language writes everything except operators.
pub trait Language {
    /// A rational number.
    fn constant(&self, value: &Rational) -> Expression;
    /// π.
    fn pi(&self) -> Expression;
    /// The expression for an argument that needs no variable; `None` where it needs one.
    fn argument(&self, source: Source) -> Option<Expression>;
    /// The name that a variable for an argument should have, and the text of its value.
    fn variable(&self, source: Source) -> (String, String);
    /// A function of one argument, `a.sqrt()`.
    fn unary(&self, function: symbolic::Function, argument: &Expression) -> Expression;
    /// A function of two arguments, `a.atan2(b)`.
    fn binary(&self, function: symbolic::Function, a: &Expression, b: &Expression) -> Expression;
    /// `let name = value;`
    fn bind(&self, writer: &mut Writer, name: &str, value: &str);
    /// Writes sine, cosine or both of a variable or an argument.
    fn sin_cos(
        &self,
        writer: &mut Writer,
        sin: Option<&str>,
        cos: Option<&str>,
        angle: &Expression,
    );
    /// Writes an early return for a vanishing pivot.
    fn guard(&self, writer: &mut Writer, guard: &Guard, names: [&str; 2]);
    /// A free identifier for a variable, as close to `name` as possible.
    fn identifier(&self, scope: &mut Scope, name: &str) -> String;
    /// The name of an angle within the names of its sine and cosine: `theta1`, also for `n(q[0])`.
    fn angle_name(&self, angle: &str) -> String {
        word(angle.trim_start_matches("r#"), char::is_alphanumeric)
    }
    /// The name for a bound constant that has one, such as `zero`.
    fn constant_name(&self, value: &Rational) -> Option<&'static str>;
    /// The rounding error of a product or a sum.
    fn error(&self, of: Rounded, a: &Expression, b: &Expression) -> Expression;
    /// A fused product and sum; `None` where the language computes them separately.
    fn contraction(
        &self,
        _kind: Contracted,
        _factors: [&Expression; 2],
        _term: &Expression,
    ) -> Option<Expression> {
        None
    }
    /// Whether code is written for speed: with [`sin_cos_all`](Language::sin_cos_all), and with products contracted.
    fn is_for_speed(&self) -> bool {
        false
    }
    /// Writes sines and cosines of several angles at once, with names for those that are used.
    fn sin_cos_all(&self, _writer: &mut Writer, _angles: &[Angle]) {}
    /// Writes a comment: the next statement computes these values of an elimination.
    fn steps(&self, writer: &mut Writer, steps: &[EliminationStep]);
    /// Two operations of the same kind in one statement, with their operands slot by slot; `None` where the
    /// language writes them separately.
    fn pack(&self, _what: PackedOperation, _operands: &[[Expression; 2]]) -> Option<String> {
        None
    }
}

/// An operation whose rounding error is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounded {
    /// `a·b`
    Product,
    /// `a + b`
    Sum,
}

/// An angle, and the names of its sine and cosine where they are used.
pub struct Angle {
    /// The angle: a variable or an argument.
    pub angle: Expression,
    /// The variable for its sine.
    pub sin: Option<String>,
    /// The variable for its cosine.
    pub cos: Option<String>,
}

/// The precedence of an expression's outermost operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Precedence {
    /// `a + b`, `a - b`
    Sum,
    /// `a * b`, `a / b`
    Product,
    /// `-a`
    Sign,
    /// A name, a number, a call.
    Atom,
}

/// An expression as text.
#[derive(Clone, Debug)]
pub struct Expression {
    /// The text.
    pub text: String,
    /// Its outermost operator.
    pub precedence: Precedence,
    /// Whether it is as short and as cheap as a name.
    pub is_leaf: bool,
}

impl Expression {
    /// A name, or a number that is as short as one.
    pub fn leaf(text: impl Into<String>) -> Expression {
        Expression {
            text: text.into(),
            precedence: Precedence::Atom,
            is_leaf: true,
        }
    }

    /// A call.
    pub fn call(text: impl Into<String>) -> Expression {
        Expression {
            text: text.into(),
            precedence: Precedence::Atom,
            is_leaf: false,
        }
    }

    /// A sum.
    pub fn sum(text: impl Into<String>) -> Expression {
        Expression {
            precedence: Precedence::Sum,
            ..Expression::call(text)
        }
    }

    /// The text, in parentheses if its operator binds less tightly than `least`.
    pub fn at_least(&self, least: Precedence) -> String {
        if self.precedence >= least {
            self.text.clone()
        } else {
            format!("({})", self.text)
        }
    }

    fn operation(
        operator: &str,
        binding: Precedence,
        a: &Expression,
        b: &Expression,
    ) -> Expression {
        // `a - (b - c)` keeps its parentheses, `(a - b) - c` needs none.
        let tighter = if binding == Precedence::Sum {
            Precedence::Product
        } else {
            Precedence::Sign
        };
        let text = format!("{} {operator} {}", a.at_least(binding), b.at_least(tighter));
        Expression {
            text,
            precedence: binding,
            is_leaf: false,
        }
    }
}

/// Writes the statements of a function and returns the texts of its results.
///
/// `wanted` holds the names of results that become variables; a scalar result does not.
pub fn statements(
    writer: &mut Writer,
    language: &impl Language,
    function: &Function,
    scope: Scope,
    wanted: &[String],
) -> Vec<Expression> {
    let mut body = Body::new(writer, language, function, scope, wanted);
    body.read_arguments();
    body.all_angles();
    let mut guards = function.guards.iter().peekable();
    for index in 0..function.code.len() {
        body.operation(Value(index as u32));
        while let Some(guard) = guards.next_if(|guard| body.is_ready(guard, index)) {
            let pivot = body.bound(guard.pivot);
            let scale = body.bound(guard.scale);
            language.guard(body.writer, guard, [&pivot, &scale]);
        }
    }
    body.results()
}

/// The results and guards of a function whose guards the caller checks.
pub struct Unchecked {
    /// The results.
    pub results: Vec<Expression>,
    /// The pivot and the scale of each guard.
    pub guards: Vec<[String; 2]>,
    /// The index of the result that is computed last.
    pub latest: usize,
}

/// Writes the statements of a function without its guards, which the caller checks after everything else. If `packs` is
/// given, operations are written in pairs.
pub fn unchecked(
    writer: &mut Writer,
    language: &impl Language,
    function: &Function,
    scope: Scope,
    wanted: &[String],
    packs: Option<&[PackedStatement]>,
) -> Unchecked {
    let mut body = Body::new(writer, language, function, scope, wanted);
    body.read_arguments();
    body.all_angles();
    match packs {
        Some(statements) => body.in_pairs(statements),
        None => (0..function.code.len()).for_each(|index| body.operation(Value(index as u32))),
    }
    let results = body.results();
    let guards = function.guards.iter();
    let guards = guards.map(|guard| [guard.pivot, guard.scale].map(|value| body.bound(value)));
    let ready = program::ready_times(function);
    let places = 0..function.results.len();
    let latest = places.max_by_key(|&place| ready[function.results[place].index()]);
    Unchecked {
        guards: guards.collect(),
        results,
        latest: latest.unwrap_or(0),
    }
}

/// Whether an expression is too long to be inlined into another one.
fn is_long(text: &str) -> bool {
    let longest = if text.contains(".mul_") || text.contains(".neg_mul_") {
        LONGEST_CALL
    } else {
        LONGEST_INLINE
    };
    width(text) > longest
}

struct Body<'a, L> {
    writer: &'a mut Writer,
    language: &'a L,
    function: &'a Function,
    scope: Scope,
    /// How many times each value is used.
    uses: Vec<u32>,
    /// The elements of arrays that hold each value, for loops that count through them.
    places: Vec<Vec<ArrayElement>>,
    /// The names wanted for values.
    wanted: Vec<Option<&'a str>>,
    /// The text of each value written so far.
    texts: Vec<Option<Expression>>,
    temporaries: usize,
    /// The number of loop names used so far.
    names: usize,
    /// Whether results become variables.
    binds_results: bool,
    /// Which products are fused into the sums that use them.
    contractions: Contractions,
    /// The steps of an elimination that no comment has named yet, by value.
    steps: BTreeMap<Value, Vec<EliminationStep>>,
}

impl<'a, L: Language> Body<'a, L> {
    fn new(
        writer: &'a mut Writer,
        language: &'a L,
        function: &'a Function,
        scope: Scope,
        wanted: &'a [String],
    ) -> Body<'a, L> {
        let n = function.code.len();
        let contractions = if language.is_for_speed() {
            Contractions::of(function)
        } else {
            Contractions::none(function)
        };
        let mut names = vec![None; n];
        for (value, name) in function.results.iter().zip(wanted) {
            names[value.index()].get_or_insert(name.as_str());
        }
        let mut steps: BTreeMap<Value, Vec<EliminationStep>> = BTreeMap::new();
        for (value, step) in &function.steps {
            steps.entry(*value).or_default().push(*step);
        }
        Body {
            writer,
            language,
            function,
            scope,
            uses: program::uses(function),
            places: vec![Vec::new(); n],
            wanted: names,
            texts: vec![None; n],
            temporaries: 0,
            names: 0,
            binds_results: !wanted.is_empty(),
            contractions,
            steps,
        }
    }

    /// Writes variables for the arguments that are used.
    fn read_arguments(&mut self) {
        let mut reads: Vec<(Source, usize)> = Vec::new();
        for (index, op) in self.function.code.iter().enumerate() {
            if let Op::Read(source) = *op {
                match self.language.argument(source) {
                    Some(argument) => self.texts[index] = Some(argument),
                    None => reads.push((source, index)),
                }
            }
        }
        sort_by(&mut reads, Ord::cmp);
        for (source, index) in reads {
            let (name, value) = self.language.variable(source);
            let name = self.language.identifier(&mut self.scope, &name);
            self.language.bind(self.writer, &name, &value);
            self.texts[index] = Some(Expression::leaf(name));
        }
    }

    /// Whether the operands of a guard are computed after the operation at an index.
    fn is_ready(&self, guard: &Guard, index: usize) -> bool {
        let is_argument = |value: Value| matches!(self.function.op(value), Op::Read(_));
        let is_there = |value: Value| value.index() <= index || is_argument(value);
        is_there(guard.pivot) && is_there(guard.scale)
    }

    /// Writes together all sines and cosines whose angles need only arguments and sums and products of them.
    fn all_angles(&mut self) {
        if !self.language.is_for_speed() {
            return;
        }
        let code = &self.function.code;
        let angles = program::early_angles(self.function);
        if angles.is_empty() {
            return;
        }
        let mut is_needed = vec![false; code.len()];
        angles
            .iter()
            .for_each(|angle| is_needed[angle.index()] = true);
        for (index, op) in code.iter().enumerate().rev() {
            if is_needed[index] {
                op.operands()
                    .for_each(|operand| is_needed[operand.index()] = true);
            }
        }
        for index in (0..code.len()).filter(|&index| is_needed[index]) {
            self.operation(Value(index as u32));
        }
        let named: Vec<Angle> = angles
            .into_iter()
            .map(|angle| self.name_angle(angle))
            .collect();
        self.language.sin_cos_all(self.writer, &named);
    }

    fn operation(&mut self, value: Value) {
        if self.texts[value.index()].is_some() || self.contractions.is_part(value) {
            return; // written before, the cosine to a sine, or part of the sum that uses it
        }
        let expression = match self.function.op(value).clone() {
            _ if let Some(sum) = self.contractions.sum(value) => self.contraction(sum),
            Op::Sin(angle) | Op::Cos(angle) => return self.sin_cos(angle),
            op => self.expression(op),
        };
        self.define(value, expression);
    }

    /// Writes the operations of a function in pairs.
    fn in_pairs(&mut self, statements: &[PackedStatement]) {
        for (index, op) in self.function.code.iter().enumerate() {
            if matches!(op, Op::Constant(_) | Op::Pi) {
                self.operation(Value(index as u32));
            }
        }
        for statement in statements {
            match statement {
                PackedStatement::One(value) => self.operation(*value),
                PackedStatement::Two(pack) => self.pack(pack),
            }
        }
    }

    /// Writes two operations in one statement.
    fn pack(&mut self, pack: &Pack) {
        for value in pack.operands.iter().flatten() {
            if is_long(&self.text(*value).text) {
                self.bound(*value);
            }
        }
        let operands = pack.operands.iter();
        let operands: Vec<[Expression; 2]> = operands
            .map(|pair| pair.map(|value| self.text(value)))
            .collect();
        let Some(text) = self.language.pack(pack.operation, &operands) else {
            return pack
                .values
                .into_iter()
                .for_each(|value| self.operation(value));
        };
        let mut steps = Vec::new();
        for value in pack.values {
            self.take_steps(value, &mut steps);
        }
        self.comment(&steps);
        let names = pack.values.map(|value| {
            let name = self.name(value);
            self.language.identifier(&mut self.scope, &name)
        });
        self.language
            .bind(self.writer, &format!("[{}]", names.join(", ")), &text);
        for (value, name) in pack.values.into_iter().zip(names) {
            self.texts[value.index()] = Some(Expression::leaf(name));
        }
    }

    /// Defines the text of a value, as a variable if it is used more than once.
    fn define(&mut self, value: Value, expression: Expression) {
        let is_cheap = expression.is_leaf || matches!(self.function.op(value), Op::Pi);
        self.texts[value.index()] = Some(expression);
        if self.uses[value.index()] > 1 && !is_cheap {
            self.bound(value);
        }
    }

    /// The expression of an operation other than sine and cosine.
    fn expression(&mut self, op: Op) -> Expression {
        let language = self.language;
        match op {
            Op::Constant(rational) => language.constant(&rational),
            Op::Pi => language.pi(),
            // All arguments were written before.
            Op::Read(source) => Expression::leaf(language.variable(source).1),
            Op::Sin(a) => self.combine([a], |[a]| language.unary(symbolic::Function::Sin, a)),
            Op::Cos(a) => self.combine([a], |[a]| language.unary(symbolic::Function::Cos, a)),
            Op::Add(a, b) => self.combine([a, b], |[a, b]| {
                Expression::operation("+", Precedence::Sum, a, b)
            }),
            Op::Sub(a, b) => self.combine([a, b], |[a, b]| {
                Expression::operation("-", Precedence::Sum, a, b)
            }),
            Op::Mul(a, b) => self.combine([a, b], |[a, b]| {
                Expression::operation("*", Precedence::Product, a, b)
            }),
            Op::Div(a, b) => self.combine([a, b], |[a, b]| {
                Expression::operation("/", Precedence::Product, a, b)
            }),
            Op::Neg(a) => self.combine([a], |[a]| Expression {
                text: format!("-{}", a.at_least(Precedence::Atom)),
                precedence: Precedence::Sign,
                is_leaf: false,
            }),
            Op::ProductError(a, b) => {
                self.combine([a, b], |[a, b]| language.error(Rounded::Product, a, b))
            }
            Op::SumError(a, b) => self.combine([a, b], |[a, b]| language.error(Rounded::Sum, a, b)),
            Op::Unary(function, a) => self.combine([a], |[a]| language.unary(function, a)),
            Op::Binary(function, a, b) => {
                self.combine([a, b], |[a, b]| language.binary(function, a, b))
            }
        }
    }

    /// A sum with the product that is contracted into it.
    fn contraction(&mut self, sum: Contraction) -> Expression {
        let language = self.language;
        let [a, b] = sum.factors;
        self.combine([a, b, sum.term], |[a, b, c]| {
            language
                .contraction(sum.kind, [a, b], c)
                .expect("a language that is for speed contracts")
        })
    }

    /// An expression of operands, which become variables where it would get too long.
    fn combine<const K: usize>(
        &mut self,
        operands: [Value; K],
        write: impl Fn([&Expression; K]) -> Expression,
    ) -> Expression {
        loop {
            let texts = operands.map(|operand| self.text(operand));
            let expression = write(texts.each_ref());
            let bindable = operands
                .into_iter()
                .zip(texts)
                .filter(|(_, operand)| !operand.is_leaf);
            let longest = bindable.max_by_key(|(_, operand)| width(&operand.text));
            match longest {
                Some((operand, _)) if is_long(&expression.text) => {
                    self.bound(operand);
                }
                _ => return expression,
            }
        }
    }

    /// Writes sine and cosine of an angle, or the one that the function uses.
    fn sin_cos(&mut self, angle: Value) {
        let Angle { angle, sin, cos } = self.name_angle(angle);
        self.language
            .sin_cos(self.writer, sin.as_deref(), cos.as_deref(), &angle);
    }

    /// Names the sine and the cosine of an angle, or the one that the function uses.
    fn name_angle(&mut self, angle: Value) -> Angle {
        self.bound(angle);
        let argument = self.text(angle);
        let position = |wanted: Op| self.function.code.iter().position(|op| *op == wanted);
        let (sin, cos) = (position(Op::Sin(angle)), position(Op::Cos(angle)));
        let base = self.language.angle_name(&argument.text);
        let mut name = |function: &str, index: Option<usize>| {
            let index = index?;
            let name = format!("{function}_{base}");
            let name = self.language.identifier(&mut self.scope, &name);
            self.texts[index] = Some(Expression::leaf(name.clone()));
            Some(name)
        };
        Angle {
            sin: name("sin", sin),
            cos: name("cos", cos),
            angle: argument,
        }
    }

    /// The text of a value that has been written.
    fn text(&self, value: Value) -> Expression {
        self.texts[value.index()]
            .clone()
            .expect("operands come before what uses them")
    }

    /// The name of a value, which becomes a variable if it is not one yet.
    fn bound(&mut self, value: Value) -> String {
        let expression = self.text(value);
        if expression.is_leaf {
            return expression.text;
        }
        let name = self.name(value);
        self.bind(value, &name, &expression.text)
    }

    /// A name for the variable of a value: the wanted one, or the next number.
    fn name(&mut self, value: Value) -> String {
        let wanted = self.wanted.get(value.index()).copied().flatten();
        wanted.map(str::to_owned).unwrap_or_else(|| {
            self.temporaries += 1;
            format!("t{}", self.temporaries - 1)
        })
    }

    fn bind(&mut self, value: Value, name: &str, text: &str) -> String {
        let mut steps = Vec::new();
        self.take_steps(value, &mut steps);
        self.comment(&steps);
        let name = self.language.identifier(&mut self.scope, name);
        self.language.bind(self.writer, &name, text);
        self.texts[value.index()] = Some(Expression::leaf(name.clone()));
        name
    }

    /// Takes the steps of an elimination that the expression of a value contains.
    fn take_steps(&mut self, value: Value, steps: &mut Vec<EliminationStep>) {
        if self.steps.is_empty() {
            return;
        }
        let operands = self.function.op(value).operands();
        for operand in operands {
            // Another operand is a variable, which has its own statement.
            let is_inside = match &self.texts[operand.index()] {
                Some(text) => !text.is_leaf,
                None => self.contractions.is_part(operand),
            };
            if is_inside {
                self.take_steps(operand, steps);
            }
        }
        steps.extend(self.steps.remove(&value).into_iter().flatten());
    }

    /// Writes a comment that names steps of an elimination.
    fn comment(&mut self, steps: &[EliminationStep]) {
        if !steps.is_empty() {
            self.language.steps(self.writer, steps);
        }
    }

    fn results(&mut self) -> Vec<Expression> {
        let results = self.function.results.iter();
        results.map(|&value| self.result(value)).collect()
    }

    fn result(&mut self, value: Value) -> Expression {
        if self.binds_results {
            let text = self.bound(value);
            // A matrix is easier to read with `zero` than with `S::ZERO`.
            let named = match self.function.op(value) {
                Op::Constant(rational) => self.language.constant_name(rational),
                _ => None,
            };
            if let Some(name) = named.filter(|name| !text.starts_with(name)) {
                self.bind(value, name, &text);
            }
        }
        self.text(value)
    }
}
