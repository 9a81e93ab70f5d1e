//! Numbers of 120 digits, in which the reference is computed.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use astro_float_num::{BigFloat, Consts, Radix, RoundingMode};

/// Bits of a number: 120 digits, of which two nested central differences leave 38 (see `truth.rs`).
const BITS: usize = 400;
const ROUND: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("memory for π"));
}

/// A number of 120 digits.
#[derive(Clone, Debug)]
pub struct Number(BigFloat);

impl Number {
    pub fn zero() -> Number {
        Number::of(0.0)
    }

    pub fn of(x: f64) -> Number {
        Number(BigFloat::from_f64(x, BITS))
    }

    /// 10 to a negative power, the step of a difference.
    pub fn tenth(power: u32) -> Number {
        let text = format!("1e-{power}");
        CONSTANTS.with_borrow_mut(|c| Number(BigFloat::parse(&text, Radix::Dec, BITS, ROUND, c)))
    }

    pub fn sin_cos(&self) -> (Number, Number) {
        CONSTANTS.with_borrow_mut(|c| {
            (
                Number(self.0.sin(BITS, ROUND, c)),
                Number(self.0.cos(BITS, ROUND, c)),
            )
        })
    }

    pub fn sqrt(&self) -> Number {
        Number(self.0.sqrt(BITS, ROUND))
    }

    pub fn abs(&self) -> Number {
        Number(self.0.abs())
    }

    /// The nearest `f64`, through the decimal text; only for comparing small differences.
    pub fn to_f64(&self) -> f64 {
        let text = CONSTANTS.with_borrow_mut(|c| self.0.format(Radix::Dec, ROUND, c));
        text.expect("a number").parse().expect("a number")
    }

    pub fn exceeds(&self, other: &Number) -> bool {
        self.0.cmp(&other.0).is_some_and(|order| order > 0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl $trait<&Number> for &Number {
            type Output = Number;
            fn $method(self, other: &Number) -> Number {
                Number(self.0.$method(&other.0, BITS, ROUND))
            }
        }
        impl $trait<Number> for Number {
            type Output = Number;
            fn $method(self, other: Number) -> Number {
                (&self).$method(&other)
            }
        }
        impl $trait<&Number> for Number {
            type Output = Number;
            fn $method(self, other: &Number) -> Number {
                (&self).$method(other)
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number(self.0.neg())
    }
}
