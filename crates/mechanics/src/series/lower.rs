//! Lowers the expressions of the residuals to the rows of a series.

use lagrangian_program::series::{
    ContactRows, ContactSeries, ContactState, Level, MOST_ROWS, NoSeries, Row, RowId, Series,
};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::normal::readable;
use lagrangian_symbolic::sorting::{sort_by, sort_by_key};
use lagrangian_symbolic::{Dag, Expr, Function as Call, Id, Node, Rational, Symbol, reachable};
use rustc_hash::FxHashMap;

use super::residual::{Closed, ClosedContact, Derivative, Form, residual, split};
use crate::equations::kinetic_energies;
use crate::equations::shorter::is_as_accurate;

/// The largest number of coordinates of machines whose equations are derived in several forms. Their number of terms grows with the cube of the
/// number of coordinates; for more of them positions have always been the shorter form.
const MOST_WITH_CHOICE: usize = 6;

/// The largest number of terms of a kinetic energy that is multiplied out.
const MOST_TERMS: usize = 200;

/// The series of a machine's motion in different forms, not yet proved, the one with the fastest steps first.
pub(super) fn series<'d>(model: &Model<'d>) -> Result<Vec<Series>, NoSeries> {
    let mut found = vec![in_form(model, Form::Positions)?];
    let momenta = momenta(model).into_iter();
    found.extend(momenta.filter_map(|form| in_form(model, form).ok()));
    // Stable: positions come first unless another form is faster.
    sort_by(&mut found, |one, other| {
        one.cycles().total_cmp(&other.cycles())
    });
    Ok(found)
}

/// The series of a machine's motion with these contacts in different forms, not yet proved, the one first that has the fastest steps if this is what they do.
pub(super) fn contact_series<'d>(
    model: &Model<'d>,
    contacts: &[Option<ClosedContact<'d>>],
    states: &[ContactState],
) -> Vec<ContactSeries> {
    let forms = [Form::Positions].into_iter().chain(momenta(model));
    let mut found = Vec::new();
    for form in forms {
        if let Ok(series) = with_contacts(model, form, contacts) {
            let cycles = series.with(states).map_or(f64::INFINITY, |of| of.cycles());
            found.push((cycles, series));
        }
    }
    found.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    found.into_iter().map(|(_, series)| series).collect()
}

/// The forms of the equations by momenta that are considered.
fn momenta<'d>(model: &Model<'d>) -> Vec<Form<'d>> {
    if model.coordinates.len() > MOST_WITH_CHOICE {
        return Vec::new();
    }
    let [in_frames, without_spin] = kinetic_energies(model);
    let mut energies = vec![in_frames, without_spin];
    let multiplied_out = readable(in_frames, MOST_TERMS);
    if is_as_accurate(model, [in_frames, multiplied_out], None) {
        energies.push(multiplied_out);
    }
    energies.dedup();
    energies.into_iter().map(Form::Momenta).collect()
}

/// The series in one form of the equations.
fn in_form<'d>(model: &Model<'d>, form: Form<'d>) -> Result<Series, NoSeries> {
    let residual = residual(model, form, &[])?;
    let mut lowering = Lowering::of(model, &residual.derivatives);
    for (k, multiplier) in (model.coordinates.len() as u32..).zip(&residual.multipliers) {
        lowering.sources.insert(*multiplier, Row::Acceleration(k));
    }
    let mut residuals = Vec::new();
    for &row in &residual.rows {
        residuals.push(lowering.expression(row)?);
    }
    let counts = [
        model.coordinates.len(),
        model.parameters.len(),
        model.inputs.len(),
    ];
    Series::of_rows(lowering.rows, residuals, counts)
}

/// The series with contacts in one form of the equations.
fn with_contacts<'d>(
    model: &Model<'d>,
    form: Form<'d>,
    contacts: &[Option<ClosedContact<'d>>],
) -> Result<ContactSeries, NoSeries> {
    let closed: Vec<Closed<'d>> = contacts.iter().flatten().map(|of| of.closed).collect();
    let residual = residual(model, form, &closed)?;
    let mut lowering = Lowering::of(model, &residual.derivatives);
    let mut indices = FxHashMap::default();
    for (k, multiplier) in (model.coordinates.len() as u32..).zip(&residual.multipliers) {
        lowering.sources.insert(*multiplier, Row::Acceleration(k));
        indices.insert(*multiplier, k);
    }
    let index = |force: Expr<'d>| force.as_symbol().and_then(|key| indices.get(&key).copied());
    let mut rows_of_contacts = Vec::with_capacity(contacts.len());
    for contact in contacts {
        let Some(contact) = contact else {
            rows_of_contacts.push(None);
            continue;
        };
        let normal = index(contact.force).ok_or(NoSeries::NotLinear)?;
        let tangent = match contact.closed.tangent {
            Some([_, force]) => {
                // Before the row of the force, which is this one or its opposite where the contact slips.
                let friction = lowering.expression(contact.friction * contact.force)?;
                Some((index(force).ok_or(NoSeries::NotLinear)?, friction))
            }
            None => None,
        };
        rows_of_contacts.push(Some(ContactRows {
            normal,
            is_carried: contact.closed.normal.is_none(),
            tangent,
        }));
    }
    let mut residuals = Vec::new();
    for &row in &residual.rows {
        residuals.push(lowering.expression(row)?);
    }
    Ok(ContactSeries {
        rows: lowering.rows,
        residuals,
        contacts: rows_of_contacts,
        coordinates: model.coordinates.len(),
        constraints: model.constraints().len(),
        parameters: model.parameters.len(),
        inputs: model.inputs.len(),
    })
}

/// Converts expressions to rows.
struct Lowering<'m, 'd> {
    dag: &'d Dag,
    derivatives: &'m FxHashMap<Symbol, Derivative<'d>>,
    sources: FxHashMap<Symbol, Row>,
    rows: Vec<Row>,
    levels: Vec<Level>,
    /// The rows by their content, so that nothing is computed twice.
    known: FxHashMap<Row, RowId>,
    of_node: FxHashMap<Id, RowId>,
}

impl<'m, 'd> Lowering<'m, 'd> {
    fn of(
        model: &Model<'d>,
        derivatives: &'m FxHashMap<Symbol, Derivative<'d>>,
    ) -> Lowering<'m, 'd> {
        let mut sources = FxHashMap::default();
        let mut set = |e: Expr<'d>, row: Row| sources.extend(e.as_symbol().map(|key| (key, row)));
        set(model.time, Row::Time);
        for (i, parameter) in (0..).zip(&model.parameters) {
            set(parameter.symbol, Row::Parameter(i));
        }
        for (i, input) in (0..).zip(&model.inputs) {
            set(input.symbol, Row::Input(i));
        }
        for (i, coordinate) in (0..).zip(&model.coordinates) {
            set(coordinate.q, Row::Coordinate(i));
            set(coordinate.v, Row::Rate(i));
            set(coordinate.a, Row::Acceleration(i));
        }
        Lowering {
            dag: model.dag,
            derivatives,
            sources,
            rows: Vec::new(),
            levels: Vec::new(),
            known: FxHashMap::default(),
            of_node: FxHashMap::default(),
        }
    }

    /// The row of an expression, after those of all its parts.
    fn expression(&mut self, e: Expr<'d>) -> Result<RowId, NoSeries> {
        for id in reachable(self.dag, &[e]) {
            if !self.of_node.contains_key(&id) {
                let row = self.node(id)?;
                self.of_node.insert(id, row);
            }
        }
        Ok(self.of_node[&e.id()])
    }

    fn node(&mut self, id: Id) -> Result<RowId, NoSeries> {
        match self.dag.node(id) {
            Node::Constant(value) => self.push(Row::Number(value)),
            Node::Pi => self.push(Row::Pi),
            Node::Symbol(symbol) => match self.derivatives.get(&symbol) {
                // Positions and momenta contain no derivatives, so this recursion is one level deep.
                Some(&Derivative {
                    of,
                    is_second: twice,
                }) => {
                    let of = self.expression(of)?;
                    self.push(if twice {
                        Row::Second(of)
                    } else {
                        Row::First(of)
                    })
                }
                None => match self.sources.get(&symbol) {
                    Some(row) => self.push(row.clone()),
                    None => Err(NoSeries::NotLinear),
                },
            },
            Node::Sum(terms) => {
                let mut sum = Vec::new();
                for (term, coefficient) in terms.iter() {
                    let coefficient = if coefficient.is_one() {
                        None
                    } else {
                        Some(self.push(Row::Number(coefficient.clone()))?)
                    };
                    self.add_term(&mut sum, coefficient, *term)?;
                }
                self.sum(sum)
            }
            Node::Product(factors) => match split(self.dag, &factors) {
                (Some(constant), varying) if !varying.is_one() => {
                    let mut sum = Vec::new();
                    let constant = self.expression(constant)?;
                    let varying = self.expression(varying)?;
                    self.add_row(&mut sum, Some(constant), varying)?;
                    self.sum(sum)
                }
                _ => self.product(&factors),
            },
            Node::Function(call, arguments) => {
                let arguments: Vec<RowId> = arguments.iter().map(|id| self.of_node[id]).collect();
                self.function(
                    call,
                    arguments[0],
                    *arguments.last().unwrap_or(&arguments[0]),
                )
            }
        }
    }

    /// Adds `coefficient·term` to a sum, with the constant factors taken out of the term.
    fn add_term(
        &mut self,
        sum: &mut Vec<(Option<RowId>, RowId)>,
        coefficient: Option<RowId>,
        term: Id,
    ) -> Result<(), NoSeries> {
        let row = self.of_node[&term];
        self.add_row(sum, coefficient, row)
    }

    /// Adds `coefficient·row` to a sum; if the row is a multiple of another, or a sum, its terms are added.
    fn add_row(
        &mut self,
        sum: &mut Vec<(Option<RowId>, RowId)>,
        coefficient: Option<RowId>,
        row: RowId,
    ) -> Result<(), NoSeries> {
        let varies = self.levels[row.index()] > Level::Constant;
        let terms = match &self.rows[row.index()] {
            Row::Sum(terms) if varies && terms.len() == 1 => terms.clone(),
            _ => vec![(None, row)],
        };
        for (inner, row) in terms {
            let coefficient = match (coefficient, inner) {
                (Some(a), Some(b)) => Some(self.push(Row::Product(a, b))?),
                (a, b) => a.or(b),
            };
            sum.push((coefficient, row));
        }
        Ok(())
    }

    /// A sum in which each row occurs once.
    fn sum(&mut self, terms: Vec<(Option<RowId>, RowId)>) -> Result<RowId, NoSeries> {
        let mut gathered: Vec<(RowId, Vec<Option<RowId>>)> = Vec::new();
        let mut place: FxHashMap<RowId, usize> = FxHashMap::default();
        for (coefficient, row) in terms {
            let at = *place.entry(row).or_insert_with(|| {
                gathered.push((row, Vec::new()));
                gathered.len() - 1
            });
            gathered[at].1.push(coefficient);
        }
        let mut sum = Vec::new();
        for (row, coefficients) in gathered {
            let coefficient = match coefficients[..] {
                [one] => one,
                _ => {
                    let one = self.push(Row::Number(Rational::ONE))?;
                    let terms = coefficients.into_iter().map(|c| (None, c.unwrap_or(one)));
                    Some(self.push(Row::Sum(terms.collect()))?)
                }
            };
            sum.push((coefficient, row));
        }
        match sum[..] {
            [(None, row)] => Ok(row),
            _ => self.push(Row::Sum(sum)),
        }
    }

    /// The product of powers of rows; the rows with fewer dependencies come first, so that more is shared and
    /// no order waits long.
    fn product(&mut self, factors: &[(Id, i32)]) -> Result<RowId, NoSeries> {
        let mut above = Vec::new();
        let mut below = Vec::new();
        for &(id, power) in factors {
            let row = self.power(self.of_node[&id], power.unsigned_abs())?;
            if power > 0 { &mut above } else { &mut below }.push(row);
        }
        let above = self.multiplied(above)?;
        match self.multiplied(below)? {
            None => match above {
                Some(row) => Ok(row),
                None => self.push(Row::Number(Rational::ONE)),
            },
            Some(under) => {
                let over = match above {
                    Some(row) => row,
                    None => self.push(Row::Number(Rational::ONE))?,
                };
                self.push(Row::Quotient(over, under))
            }
        }
    }

    fn multiplied(&mut self, mut rows: Vec<RowId>) -> Result<Option<RowId>, NoSeries> {
        sort_by_key(&mut rows, |row| (self.levels[row.index()], *row));
        let mut rows = rows.into_iter();
        let Some(mut product) = rows.next() else {
            return Ok(None);
        };
        for row in rows {
            product = if row == product {
                self.push(Row::Square(row))?
            } else {
                self.push(Row::Product(product, row))?
            };
        }
        Ok(Some(product))
    }

    /// A positive power, by squaring.
    fn power(&mut self, row: RowId, exponent: u32) -> Result<RowId, NoSeries> {
        let (mut square, mut left) = (row, exponent);
        let mut product = None;
        loop {
            if left & 1 == 1 {
                product = Some(match product {
                    None => square,
                    Some(product) => self.push(Row::Product(product, square))?,
                });
            }
            left >>= 1;
            match (left, product) {
                (0, Some(product)) => return Ok(product),
                (0, None) => return self.push(Row::Number(Rational::ONE)),
                _ => square = self.push(Row::Square(square))?,
            }
        }
    }

    fn function(&mut self, call: Call, a: RowId, b: RowId) -> Result<RowId, NoSeries> {
        let [level_a, level_b] = [a, b].map(|row| self.levels[row.index()]);
        if level_a.max(level_b) == Level::Constant {
            return self.push(Row::Constant(call, a, b));
        }
        let one = Row::Number(Rational::ONE);
        match call {
            Call::Sin => Ok(self.pair(a, Row::Sin, Row::Cos)?[0]),
            Call::Cos => Ok(self.pair(a, Row::Sin, Row::Cos)?[1]),
            Call::Sinh => Ok(self.pair(a, Row::Sinh, Row::Cosh)?[0]),
            Call::Cosh => Ok(self.pair(a, Row::Sinh, Row::Cosh)?[1]),
            Call::Tanh => {
                let next = RowId(self.rows.len() as u32 + 1);
                let candidate = Row::Tanh(a, next);
                if let Some(known) = self.tanh_of(a) {
                    return Ok(known);
                }
                let tanh = self.push(candidate)?;
                self.push(Row::TanhSlope(tanh))?;
                Ok(tanh)
            }
            Call::Exp => self.push(Row::Exp(a)),
            Call::Sqrt => self.push(Row::Sqrt(a)),
            Call::Ln => self.push(Row::Primitive(call, a, a)),
            Call::Atan => {
                let (one, square) = (self.push(one)?, self.push(Row::Square(a))?);
                let slope = self.push(Row::Sum(vec![(None, one), (None, square)]))?;
                self.push(Row::Primitive(call, a, slope))
            }
            Call::Asin | Call::Acos => {
                let minus = self.push(Row::Number(Rational::MINUS_ONE))?;
                let (one, square) = (self.push(one)?, self.push(Row::Square(a))?);
                let inside = self.push(Row::Sum(vec![(None, one), (Some(minus), square)]))?;
                let mut slope = self.push(Row::Sqrt(inside))?;
                if call == Call::Acos {
                    slope = self.push(Row::Sum(vec![(Some(minus), slope)]))?;
                }
                self.push(Row::Primitive(call, a, slope))
            }
            Call::Atan2 => {
                let squares = [self.push(Row::Square(a))?, self.push(Row::Square(b))?];
                let over = self.push(Row::Sum(squares.map(|square| (None, square)).to_vec()))?;
                self.push(Row::Atan2(a, b, over))
            }
            Call::Pow if level_b == Level::Constant => self.push(Row::Power(a, b)),
            Call::Pow => {
                let ln = match level_a {
                    Level::Constant => self.push(Row::Constant(Call::Ln, a, a))?,
                    _ => self.push(Row::Primitive(Call::Ln, a, a))?,
                };
                let exponent = self.push(Row::Product(ln, b))?;
                self.push(Row::Exp(exponent))
            }
            Call::Tan | Call::Abs | Call::Sign | Call::Min | Call::Max => {
                Err(NoSeries::Function(call))
            }
        }
    }

    fn tanh_of(&self, a: RowId) -> Option<RowId> {
        let is = |row: &Row| matches!(row, Row::Tanh(of, _) if *of == a);
        let index_of_row = self.rows.iter().position(is);
        index_of_row.map(|index| RowId(index as u32))
    }

    /// Two rows that are derivatives of each other.
    fn pair(
        &mut self,
        a: RowId,
        first: fn(RowId, RowId) -> Row,
        second: fn(RowId, RowId) -> Row,
    ) -> Result<[RowId; 2], NoSeries> {
        // The first row of a pair is identified by its argument, with the row after it as its partner.
        let next = self.rows.len() as u32;
        let places = [RowId(next), RowId(next + 1)];
        let key = first(a, a);
        if let Some(&known) = self.known.get(&key) {
            return Ok([known, RowId(known.0 + 1)]);
        }
        self.push(first(a, places[1]))?;
        self.push(second(a, places[0]))?;
        self.known.insert(key, places[0]);
        Ok(places)
    }

    fn push(&mut self, row: Row) -> Result<RowId, NoSeries> {
        if let Some(&known) = self.known.get(&row) {
            return Ok(known);
        }
        if self.rows.len() == MOST_ROWS {
            return Err(NoSeries::TooLarge);
        }
        let level = row.level(&self.levels);
        let id = RowId(self.rows.len() as u32);
        self.known.insert(row.clone(), id);
        self.rows.push(row);
        self.levels.push(level);
        Ok(id)
    }
}
