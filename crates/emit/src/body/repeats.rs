//! Statements with loops: repeated code is written once.
//!
//! The body of a loop is that of its first iteration. Each of its inputs is a variable that the end of the body
//! sets again (*carried*), an element of an array at an increasing or decreasing index, or a variable defined
//! before the loop. Values that are needed after the loop are stored in an array with one element for each
//! iteration or, if only those of the last iteration are needed, in a variable.

use std::collections::BTreeSet;

use lagrangian_symbolic::Rational;
use rustc_hash::FxHashMap;

use super::{Body, Expression, Language};
use crate::layout::{Layout, Writer};
use crate::names::Scope;
use lagrangian_program::{
    Contraction, Function, Guard, Op, Operand, Repeat, Source, StatementKind, Statements, Value,
};

/// The smallest number of elements that are copied by a loop; fewer are written out.
const FEWEST_COPIES: usize = 4;

/// An element of an array: the text before its index, the index, and the text after it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArrayElement {
    prefix: String,
    index: usize,
    suffix: String,
}

impl ArrayElement {
    /// The element with the text `prefix`, an index, and the text `suffix`.
    pub fn new(before: impl Into<String>, index: usize, after: impl Into<String>) -> ArrayElement {
        ArrayElement {
            prefix: before.into(),
            index,
            suffix: after.into(),
        }
    }

    /// Its text.
    pub fn text(&self) -> String {
        self.at(&self.index.to_string())
    }

    /// Another element of the same array.
    fn at(&self, index: &str) -> String {
        format!("{}{index}{}", self.prefix, self.suffix)
    }

    /// The distance to another element of the same array.
    fn to(&self, other: &ArrayElement) -> Option<i64> {
        let is_same = self.prefix == other.prefix && self.suffix == other.suffix;
        is_same.then(|| other.index as i64 - self.index as i64)
    }
}

/// Elements of one array at equal distances.
#[derive(Clone, Debug)]
pub struct StridedElements {
    /// The number of elements of a list before it.
    pub start: usize,
    /// The number of its elements.
    pub count: usize,
    /// The first element and the distance from each to the next; `None` for a single element that is in no array.
    pub first: Option<(ArrayElement, i64)>,
}

impl StridedElements {
    /// The element for a counter that starts at 0.
    pub fn text(&self, counter: &str) -> Option<String> {
        let (first, step) = self.first.as_ref()?;
        Some(first.at(&counted(first.index, *step, counter)))
    }
}

/// `first + step·counter`.
fn counted(first: usize, step: i64, counter: &str) -> String {
    let multiple = match step.unsigned_abs() {
        1 => counter.to_owned(),
        size => format!("{size} * {counter}"),
    };
    match (first, step) {
        (_, 0) => first.to_string(),
        (0, 1..) => multiple,
        (_, 1..) => format!("{multiple} + {first}"),
        _ => format!("{first} - {multiple}"),
    }
}

/// Splits a list of elements into runs, each the longest that starts at its first element.
pub fn runs(list: &[Vec<ArrayElement>]) -> Vec<StridedElements> {
    let mut runs = Vec::new();
    let mut start = 0;
    while start < list.len() {
        let longest = longest(&list[start..]).filter(|run| run.count >= FEWEST_COPIES);
        let run = longest.unwrap_or(StridedElements {
            start: 0,
            count: 1,
            first: None,
        });
        runs.push(StridedElements { start, ..run });
        start += runs.last().map_or(1, |run| run.count);
    }
    runs
}

/// The longest run at the beginning of a list, with at least two elements.
fn longest(list: &[Vec<ArrayElement>]) -> Option<StridedElements> {
    let (first, second) = (list.first()?, list.get(1)?);
    let pairs = first
        .iter()
        .flat_map(|a| second.iter().map(move |b| (a, b)));
    let all = pairs.filter_map(|(a, b)| {
        let step = a.to(b)?;
        let is_next = |(i, places): (usize, &Vec<ArrayElement>)| {
            places
                .iter()
                .any(|place| a.to(place) == Some(step * i as i64))
        };
        let count = list.iter().enumerate().take_while(|&x| is_next(x)).count();
        Some(StridedElements {
            start: 0,
            count,
            first: Some((a.clone(), step)),
        })
    });
    all.max_by_key(|run| run.count)
}

/// How a language writes loops and arrays.
pub trait Loops: Language {
    /// The array elements that an argument is, if any.
    fn places(&self, source: Source) -> Vec<ArrayElement>;
    /// An array of numbers.
    fn array(&self, writer: &mut Writer, name: &str, items: Layout);
    /// An array of `count` numbers, to be set.
    fn array_to_set(&self, writer: &mut Writer, name: &str, number: &str, count: usize);
    /// A variable that may be set again.
    fn variable_to_set(&self, writer: &mut Writer, name: &str, value: &str);
    /// Sets a variable or an element.
    fn set(&self, writer: &mut Writer, target: &str, value: &str);
    /// The head of a loop that counts from 0; without a name the counter is not used.
    fn open_loop(&self, writer: &mut Writer, counter: Option<&str>, count: usize);
    /// A guard whose coordinate depends on the counter.
    fn guard_of(&self, writer: &mut Writer, guard: &Guard, names: [&str; 2], coordinate: &str);
    /// Writes the sines and cosines of all angles of an array; returns the elements that hold those of the
    /// angle at an index.
    fn all_circular(
        &self,
        writer: &mut Writer,
        name: &str,
        angles: &str,
        at: usize,
    ) -> [ArrayElement; 2];
}

/// The loops of a function.
#[derive(Clone, Debug)]
pub struct Plan {
    statements: Statements,
    repeats: Vec<Repeat>,
}

impl Plan {
    /// The loops of a function with at least `shortest` statements, if it has any.
    pub fn of(function: &Function, is_for_speed: bool, shortest: usize) -> Option<Plan> {
        if function.code.len() < shortest {
            return None;
        }
        let mut statements = Statements::of(function, is_for_speed);
        if statements.statements.len() < shortest {
            return None;
        }
        let repeats = statements.repeats(function);
        (!repeats.is_empty()).then_some(Plan {
            statements,
            repeats,
        })
    }

    /// The number of statements that are written.
    pub(crate) fn len(&self) -> usize {
        let saved = self.repeats.iter().map(|r| r.period * (r.count - 1));
        self.statements.statements.len() - saved.sum::<usize>()
    }

    /// The number of statements without loops.
    pub(crate) fn len_straight(&self) -> usize {
        self.statements.statements.len()
    }

    /// The prepared values that loops count through, each list in the order of a loop.
    pub fn prepared(&self, function: &Function) -> Vec<Vec<u32>> {
        let slot = |value: &Value| match function.op(*value) {
            Op::Read(Source::Prepared(slot)) => Some(*slot),
            _ => None,
        };
        let operands = self
            .repeats
            .iter()
            .flat_map(|repeat| repeat.operands.iter().flatten());
        let columns = operands.filter_map(|operand| match operand {
            Operand::Column(column) => column.iter().map(slot).collect(),
            _ => None,
        });
        columns.collect()
    }
}

/// Writes the statements of a function with repeated code as loops. Returns the texts of its results and the
/// arrays that hold them.
pub fn statements_with_loops(
    writer: &mut Writer,
    language: &impl Loops,
    function: &Function,
    scope: Scope,
    plan: &Plan,
) -> Vec<(Expression, Vec<ArrayElement>)> {
    let mut body = Body::new(writer, language, function, scope, &[]);
    body.set_leaf_texts();
    let used_outside = plan.used_outside(function);
    let mut repeats = plan.repeats.iter().peekable();
    let mut index = 0;
    while index < plan.statements.statements.len() {
        match repeats.next_if(|repeat| repeat.start == index) {
            Some(repeat) => {
                body.repeat(plan, repeat, &used_outside);
                index = repeat.end();
            }
            None => {
                body.statement(plan, index);
                index += 1;
            }
        }
    }
    let results = function.results.iter();
    let of = |value: &Value| {
        let name = Expression::leaf(body.bound(*value));
        (name, body.places[value.index()].clone())
    };
    results.map(of).collect()
}

impl Plan {
    /// Which values that a loop computes are used outside of it.
    fn used_outside(&self, function: &Function) -> Vec<bool> {
        let mut used = vec![false; function.code.len()];
        for value in &function.results {
            used[value.index()] = true;
        }
        let mut home = vec![None; function.code.len()];
        let of_statement = |statement: usize| {
            let mut repeats = self.repeats.iter();
            repeats.position(|repeat| (repeat.start..repeat.end()).contains(&statement))
        };
        for (index, statement) in self.statements.statements.iter().enumerate() {
            for value in statement.defines.into_iter().flatten() {
                home[value.index()] = of_statement(index);
            }
        }
        for (index, statement) in self.statements.statements.iter().enumerate() {
            for operand in &statement.operands {
                if home[operand.index()] != of_statement(index) {
                    used[operand.index()] = true;
                }
            }
        }
        for (angle, _) in &self.statements.angles {
            used[angle.index()] = true;
        }
        used
    }
}

impl<L: Loops> Body<'_, L> {
    /// Sets the texts of arguments and constants.
    fn set_leaf_texts(&mut self) {
        for index in 0..self.function.code.len() {
            let value = Value(index as u32);
            match self.function.op(value) {
                Op::Read(source) => {
                    let places = self.language.places(*source);
                    let text = match (places.first(), self.language.argument(*source)) {
                        (Some(place), _) => Expression::leaf(place.text()),
                        (None, Some(argument)) => argument,
                        (None, None) => Expression::leaf(self.language.variable(*source).1),
                    };
                    self.texts[index] = Some(text);
                    self.places[index] = places;
                }
                Op::Constant(_) | Op::Pi => self.operation(value),
                _ => {}
            }
        }
    }

    /// Writes a statement that is not part of a loop.
    fn statement(&mut self, plan: &Plan, index: usize) {
        let statement = &plan.statements.statements[index];
        match statement.kind {
            StatementKind::AllCircular => self.all_circular(&plan.statements.angles),
            StatementKind::Guard(_) => {
                let guard = &self.function.guards[statement.guard];
                let names = [guard.pivot, guard.scale].map(|value| self.bound(value));
                let [pivot, scale] = names.each_ref().map(String::as_str);
                self.language.guard(self.writer, guard, [pivot, scale]);
            }
            _ => {
                let value = statement.defines.into_iter().flatten().next();
                self.operation(value.expect("an operation defines a value"));
            }
        }
    }

    fn all_circular(&mut self, angles: &[(Value, [Option<Value>; 2])]) {
        let (name, circular) = ("angles".to_owned(), "circular".to_owned());
        let values: Vec<Value> = angles.iter().map(|(angle, _)| *angle).collect();
        self.fill(&name, &values);
        for (at, (_, pair)) in angles.iter().enumerate() {
            let mut silent = Writer::default();
            let writer = if at == 0 {
                &mut *self.writer
            } else {
                &mut silent
            };
            let places = self.language.all_circular(writer, &circular, &name, at);
            for (value, place) in pair.iter().zip(places) {
                if let Some(value) = value {
                    self.record_element(*value, place);
                }
            }
        }
    }

    /// Records the array element that holds a value.
    fn record_element(&mut self, value: Value, place: ArrayElement) {
        self.texts[value.index()] = Some(Expression::leaf(place.text()));
        self.places[value.index()] = vec![place];
    }

    /// Writes an array of values.
    fn fill(&mut self, name: &str, values: &[Value]) {
        let places: Vec<Vec<ArrayElement>> = values
            .iter()
            .map(|value| self.places[value.index()].clone())
            .collect();
        let runs = runs(&places);
        let texts: Vec<String> = values.iter().map(|value| self.text(*value).text).collect();
        fill(
            self.writer,
            self.language,
            name,
            &runs,
            &texts,
            &str::to_owned,
            &mut self.scope,
        );
    }

    /// Adds a value beyond those of the function.
    fn alias(&mut self, text: String) -> Value {
        self.texts.push(Some(Expression::leaf(text)));
        Value(self.texts.len() as u32 - 1)
    }

    fn repeat(&mut self, plan: &Plan, repeat: &Repeat, used_outside: &[bool]) {
        let Repeat {
            start,
            period,
            count,
            ref operands,
        } = *repeat;
        let body = &plan.statements.statements[start..start + period];
        let language = self.language;
        let counter = language.identifier(&mut self.scope.clone(), "i");
        let names = self.names_of_operands(repeat, &counter);
        let stored = self.storage(plan, repeat, used_outside, &names.carried);
        let is_counted = names.is_counted
            || (stored.iter()).any(|(_, stored)| matches!(stored, StoredValue::All(..)))
            || body
                .iter()
                .any(|statement| matches!(statement.kind, StatementKind::Guard(_)));
        // A value that is set at the end of the body becomes a variable as soon as it is known.
        let set: BTreeSet<Value> = (names.carried.iter())
            .map(|(value, _)| *value)
            .chain(stored.iter().map(|(value, _)| *value))
            .collect();
        for value in &set {
            self.uses[value.index()] += 2;
        }
        language.open_loop(self.writer, is_counted.then_some(counter.as_str()), count);
        for (offset, operands) in operands.iter().enumerate().take(period) {
            let of: Vec<Value> = operands.iter().map(|x| names.aliases[x]).collect();
            self.step_in_loop(plan, repeat, offset, &of, &counter);
        }
        self.end_iteration(&stored, &names.carried, &counter);
        self.writer.close("}");
        for value in set {
            self.uses[value.index()] -= 2;
        }
        self.record_stored(stored);
    }

    /// Names the operands of a loop, and writes the variables and arrays that they need before it.
    fn names_of_operands<'p>(&mut self, repeat: &'p Repeat, counter: &str) -> OperandNames<'p> {
        let language = self.language;
        let mut names = OperandNames::default();
        for operand in repeat.operands.iter().flatten() {
            if names.aliases.contains_key(operand) {
                continue;
            }
            let alias = match operand {
                Operand::Same(value) => *value,
                Operand::Invariant(value) => {
                    self.bound(*value);
                    *value
                }
                Operand::Carried(value, first) => {
                    let first = self.text(*first).text;
                    let name = language.identifier(&mut self.scope, &format!("c{}", self.names));
                    self.names += 1;
                    language.variable_to_set(self.writer, &name, &first);
                    names.carried.push((*value, name.clone()));
                    self.alias(name)
                }
                Operand::Column(column) => {
                    names.is_counted = true;
                    let places: Vec<Vec<ArrayElement>> = column
                        .iter()
                        .map(|value| self.places[value.index()].clone())
                        .collect();
                    let run = longest(&places).filter(|run| run.count == repeat.count);
                    let text = match run.and_then(|run| run.text(counter)) {
                        Some(text) => text,
                        None => {
                            let name =
                                language.identifier(&mut self.scope, &format!("g{}", self.names));
                            self.names += 1;
                            self.fill(&name, column);
                            format!("{name}[{counter}]")
                        }
                    };
                    self.alias(text)
                }
            };
            names.aliases.insert(operand, alias);
        }
        names
    }

    /// Declares the variables and arrays for the values of a loop that are used after it: of all iterations, or of the last.
    fn storage(
        &mut self,
        plan: &Plan,
        repeat: &Repeat,
        used_outside: &[bool],
        carried: &[(Value, String)],
    ) -> Vec<(Value, StoredValue)> {
        let Repeat {
            start,
            period,
            count,
            ..
        } = *repeat;
        let statements = &plan.statements.statements;
        let language = self.language;
        let mut stored: Vec<(Value, StoredValue)> = Vec::new();
        for (offset, statement) in statements[start..start + period].iter().enumerate() {
            for (which, value) in statement.defines.iter().enumerate() {
                let Some(value) = *value else { continue };
                let at = |iteration: usize| {
                    statements[start + iteration * period + offset].defines[which]
                        .expect("iterations are alike")
                };
                let is_used = |iteration: &usize| used_outside[at(*iteration).index()];
                let used: Vec<usize> = (0..count).filter(is_used).collect();
                let all: Vec<Value> = (0..count).map(at).collect();
                let name = match used.as_slice() {
                    [] => continue,
                    [only] if *only + 1 == count => {
                        if let Some((_, name)) = carried.iter().find(|(of, _)| *of == value) {
                            stored
                                .push((value, StoredValue::Carried(name.clone(), all[count - 1])));
                            continue;
                        }
                        let name =
                            language.identifier(&mut self.scope, &format!("c{}", self.names));
                        let zero = language.constant(&Rational::ZERO).text;
                        language.variable_to_set(self.writer, &name, &zero);
                        stored.push((value, StoredValue::Last(name, all[count - 1])));
                        self.names += 1;
                        continue;
                    }
                    _ => language.identifier(&mut self.scope, &format!("a{}", self.names)),
                };
                self.names += 1;
                let zero = language.constant(&Rational::ZERO).text;
                language.array_to_set(self.writer, &name, &zero, count);
                stored.push((value, StoredValue::All(name, all)));
            }
        }
        stored
    }

    /// Writes a statement of a loop, with these operands.
    fn step_in_loop(
        &mut self,
        plan: &Plan,
        repeat: &Repeat,
        offset: usize,
        of: &[Value],
        counter: &str,
    ) {
        let (statements, first) = (&plan.statements.statements, repeat.start + offset);
        let statement = &statements[first];
        match &statement.kind {
            StatementKind::Guard(_) => {
                let at = |iteration: usize| {
                    &self.function.guards[statements[first + iteration * repeat.period].guard]
                };
                let coordinates = [at(0), at(1)].map(|guard| guard.coordinate);
                let stride = coordinates[1] as i64 - coordinates[0] as i64;
                let coordinate = counted(coordinates[0], stride, counter);
                let guard = at(0);
                let names = [of[0], of[1]].map(|value| self.bound(value));
                let [pivot, scale] = names.each_ref().map(String::as_str);
                (self.language).guard_of(self.writer, guard, [pivot, scale], &coordinate);
            }
            StatementKind::Contraction(kind) => {
                let sum = Contraction {
                    kind: *kind,
                    factors: [of[0], of[1]],
                    term: of[2],
                };
                let expression = self.contraction(sum);
                self.define_in_loop(statement.defines[0], expression);
            }
            StatementKind::Operation(op) => {
                let mut operands = of.iter();
                let op = op.with_operands(|_| {
                    *operands
                        .next()
                        .expect("as many operands as the operation has")
                });
                let expression = self.expression(op);
                self.define_in_loop(statement.defines[0], expression);
            }
            StatementKind::Circular => self.circular_in_loop(of[0], statement.defines),
            StatementKind::AllCircular => unreachable!("what happens once is in no loop"),
        }
    }

    /// Stores the values of an iteration that are used after it.
    fn end_iteration(
        &mut self,
        stored: &[(Value, StoredValue)],
        carried: &[(Value, String)],
        counter: &str,
    ) {
        let language = self.language;
        for (value, stored) in stored {
            let name = self.bound(*value);
            match stored {
                StoredValue::All(array, _) => {
                    language.set(self.writer, &format!("{array}[{counter}]"), &name)
                }
                StoredValue::Last(variable, _) => language.set(self.writer, variable, &name),
                StoredValue::Carried(..) => {}
            }
        }
        let new: Vec<String> = carried
            .iter()
            .map(|(value, _)| self.bound(*value))
            .collect();
        for ((_, name), value) in carried.iter().zip(new) {
            language.set(self.writer, name, &value);
        }
    }

    /// Records where the values of a loop are found after it.
    fn record_stored(&mut self, stored: Vec<(Value, StoredValue)>) {
        for (_, stored) in stored {
            match stored {
                StoredValue::All(array, values) => {
                    for (iteration, value) in values.into_iter().enumerate() {
                        self.record_element(
                            value,
                            ArrayElement::new(format!("{array}["), iteration, "]"),
                        );
                    }
                }
                StoredValue::Last(name, value) | StoredValue::Carried(name, value) => {
                    self.texts[value.index()] = Some(Expression::leaf(name));
                }
            }
        }
    }

    fn define_in_loop(&mut self, value: Option<Value>, expression: Expression) {
        self.define(value.expect("an operation defines a value"), expression);
    }

    fn circular_in_loop(&mut self, angle: Value, defines: [Option<Value>; 2]) {
        self.bound(angle);
        let angle = self.text(angle);
        let base = self.language.angle_name(&angle.text);
        let mut names = [None, None];
        for ((name, function), value) in names.iter_mut().zip(["sin", "cos"]).zip(defines) {
            let Some(value) = value else { continue };
            let free = self
                .language
                .identifier(&mut self.scope, &format!("{function}_{base}"));
            self.texts[value.index()] = Some(Expression::leaf(free.clone()));
            *name = Some(free);
        }
        let [sin, cos] = names.each_ref().map(Option::as_deref);
        self.language.sin_cos(self.writer, sin, cos, &angle);
    }
}

/// The names of the operands in the body of a loop.
#[derive(Default)]
struct OperandNames<'p> {
    aliases: FxHashMap<&'p Operand, Value>,
    /// The variables that carry a value from one iteration to the next.
    carried: Vec<(Value, String)>,
    /// Whether an operand depends on the counter.
    is_counted: bool,
}

/// How a value that a loop computes is kept.
enum StoredValue {
    /// In an array, with the values of all iterations.
    All(String, Vec<Value>),
    /// In a variable, with the value of the last iteration.
    Last(String, Value),
    /// In a variable that is carried anyway, with the value of the last iteration.
    Carried(String, Value),
}

/// Writes an array of numbers, some of which are elements of other arrays; `wrap` is applied to each.
pub fn fill(
    writer: &mut Writer,
    language: &impl Loops,
    name: &str,
    runs: &[StridedElements],
    texts: &[String],
    wrap: &dyn Fn(&str) -> String,
    scope: &mut Scope,
) {
    if runs.iter().all(|run| run.first.is_none()) {
        let items = texts.iter().map(|text| wrap(text));
        return language.array(writer, name, Layout::array(items));
    }
    let counter = language.identifier(&mut scope.clone(), "i");
    let zero = language.constant(&Rational::ZERO).text;
    language.array_to_set(writer, name, &wrap(&zero), texts.len());
    for run in runs {
        match run.text(&counter) {
            Some(text) => {
                language.open_loop(writer, Some(&counter), run.count);
                let to = format!("{name}[{}]", counted(run.start, 1, &counter));
                language.set(writer, &to, &wrap(&text));
                writer.close("}");
            }
            None => {
                let to = format!("{name}[{}]", run.start);
                language.set(writer, &to, &wrap(&texts[run.start]));
            }
        }
    }
}
