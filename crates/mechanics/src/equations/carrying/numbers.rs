//! The numbers in which (E38) is tested, of the prime field or ordinary, and linear algebra over them.

use std::ops::{Add, Div, Mul, Neg, Sub};

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::identity;
use lagrangian_symbolic::Symbol;

use super::WORK_LIMIT;

/// Ordinary numbers count as zero below this, relative to the largest of their kind. They replace
/// the prime field only if that has no values.
const ZERO_TOLERANCE: f64 = 1e-9;

/// The numbers of points that are tried for forces without a value at the first point: in the prime
/// field, and then, for those without values there, in ordinary numbers.
const FORCE_TRIALS: [u64; 2] = [16, 4];

/// The kind of numbers in which (E38) is tested.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Numbers {
    OfField,
    Real,
}

impl Numbers {
    /// The number of points that are tried for forces.
    pub(super) fn force_trials(self) -> u64 {
        match self {
            Numbers::OfField => FORCE_TRIALS[0],
            Numbers::Real => FORCE_TRIALS[1],
        }
    }

    /// A number of this kind.
    pub(super) fn number(self, x: f64) -> Value {
        match self {
            Numbers::OfField => Residue::from_f64(x).into(),
            Numbers::Real => x.into(),
        }
    }
}

/// A number in which (E38) is tested. Both kinds are one type, so that the test is compiled once.
///
/// 0 and 1 are constants of the field, and stand for those of the other kind too; no other numbers of both kinds meet.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value {
    OfField(Residue),
    Real(f64),
}

impl Value {
    pub(super) const ZERO: Value = Value::OfField(Residue::ZERO);
    pub(super) const ONE: Value = Value::OfField(Residue::ONE);

    /// Its magnitude, or 0 if it counts as zero beside numbers of this size.
    pub(super) fn size_relative_to(self, size: f64) -> f64 {
        match self {
            Value::OfField(x) => f64::from(x != Residue::ZERO),
            Value::Real(x) if x.abs() > ZERO_TOLERANCE * size => x.abs(),
            Value::Real(_) => 0.0,
        }
    }

    pub(super) fn is_finite(self) -> bool {
        match self {
            Value::OfField(x) => x.is_finite(),
            Value::Real(x) => x.is_finite(),
        }
    }
}

impl From<Residue> for Value {
    fn from(x: Residue) -> Value {
        Value::OfField(x)
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Value {
        Value::Real(x)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident,)*) => {$(
        impl $trait for Value {
            type Output = Value;
            fn $method(self, other: Value) -> Value {
                match (self, other) {
                    (Value::OfField(x), Value::OfField(y)) => Value::OfField(x.$method(y)),
                    (Value::Real(x), Value::Real(y)) => Value::Real(x.$method(y)),
                    (Value::Real(x), Value::OfField(y)) => Value::Real(x.$method(y.to_f64())),
                    (Value::OfField(x), Value::Real(y)) => Value::Real(x.to_f64().$method(y)),
                }
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div,);

impl Neg for Value {
    type Output = Value;
    fn neg(self) -> Value {
        match self {
            Value::OfField(x) => Value::OfField(-x),
            Value::Real(x) => Value::Real(-x),
        }
    }
}

/// Numbers over which expressions are evaluated.
pub(super) trait Number: Scalar + Into<Value> {
    /// A value for a symbol.
    fn random(point: u64, symbol: Symbol) -> Self;
}

impl Number for Residue {
    fn random(point: u64, symbol: Symbol) -> Residue {
        identity::random_value(point, symbol)
    }
}

impl Number for f64 {
    fn random(point: u64, symbol: Symbol) -> f64 {
        identity::sample_value(point as u32 + 1, symbol)
    }
}

pub(super) fn dot(u: &[Value], v: &[Value]) -> Value {
    let terms = u.iter().zip(v).map(|(&u, &v)| u * v);
    terms.fold(Value::ZERO, |sum, term| sum + term)
}

/// A column as a linear combination of others, by Gaussian elimination; none if it is not one.
/// Undetermined coefficients are 0.
pub(super) fn combination(
    columns: Vec<Vec<Value>>,
    target: Vec<Value>,
    size: f64,
) -> Option<Vec<Value>> {
    let width = columns.len();
    let height = target.len();
    if height.saturating_mul(width).saturating_mul(width) > WORK_LIMIT {
        return None;
    }
    let mut rows: Vec<Vec<Value>> = (0..height)
        .map(|row| {
            let entries = columns.iter().map(|column| column[row]);
            entries.chain([target[row]]).collect()
        })
        .collect();
    let mut pivots = Vec::new();
    for column in 0..width {
        let done = pivots.len();
        let candidates = (done..height).map(|row| (row, rows[row][column].size_relative_to(size)));
        let most = candidates.fold(
            (done, 0.0),
            |most, next| if next.1 > most.1 { next } else { most },
        );
        if most.1 == 0.0 {
            continue;
        }
        rows.swap(done, most.0);
        let own = rows[done].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(row, _)| *row != done) {
            if row[column].size_relative_to(0.0) == 0.0 {
                continue;
            }
            let factor = row[column] / own[column];
            for (to, &from) in row[column..].iter_mut().zip(&own[column..]) {
                *to = *to - factor * from;
            }
        }
        pivots.push(column);
    }
    let is_met = |row: &Vec<Value>| row[width].size_relative_to(size) == 0.0;
    if !rows[pivots.len()..].iter().all(is_met) {
        return None;
    }
    let mut solved = vec![Value::ZERO; width];
    for (row, column) in rows.iter().zip(pivots) {
        solved[column] = row[width] / row[column];
    }
    Some(solved)
}
