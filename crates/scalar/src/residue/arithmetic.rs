//! Sums, products and quotients of residues.
//!
//! The operands are large: functions that read them in place save copies.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Residue;
use super::ratio::Ratio;
use super::two_adic::TwoAdic;

impl Add for Residue {
    type Output = Residue;
    #[inline]
    fn add(self, other: Residue) -> Residue {
        sum(&self, &other)
    }
}

impl Neg for Residue {
    type Output = Residue;
    fn neg(self) -> Residue {
        let ratio = self.ratio.negative();
        Residue {
            field: -self.field,
            two_adic: -self.two_adic,
            // Losing track of π costs recognition, never correctness.
            ratio: ratio.unwrap_or(Ratio::ZERO),
            is_rational: self.is_rational && ratio.is_some(),
            ..self
        }
    }
}

impl Sub for Residue {
    type Output = Residue;
    #[inline]
    fn sub(self, other: Residue) -> Residue {
        sum(&self, &-other)
    }
}

impl Mul for Residue {
    type Output = Residue;
    #[inline]
    fn mul(self, other: Residue) -> Residue {
        product(&self, &other)
    }
}

impl Div for Residue {
    type Output = Residue;
    fn div(self, other: Residue) -> Residue {
        if !self.defined || !other.defined {
            return Residue::UNDEFINED;
        }
        let Some(inverse) = other.field.inverse() else {
            return Residue::UNDEFINED;
        };
        let ratio = other.rational().and_then(Ratio::inverse);
        let inverse = Residue {
            field: inverse,
            two_adic: TwoAdic::ONE / other.two_adic,
            ratio: ratio.unwrap_or(Ratio::ZERO),
            is_rational: ratio.is_some(),
            ..other
        };
        product(&self, &inverse)
    }
}

fn sum(a: &Residue, b: &Residue) -> Residue {
    if !a.defined || !b.defined {
        return Residue::UNDEFINED;
    }
    let constant = a.constant && b.constant;
    // Most derivatives that dual numbers add are 0.
    if a.is_exactly(0) {
        return Residue { constant, ..*b };
    }
    if b.is_exactly(0) {
        return Residue { constant, ..*a };
    }
    let is_rational = a.is_rational && b.is_rational;
    let ratio = if is_rational {
        a.ratio.plus(b.ratio)
    } else {
        let (a, b) = (a.turn(), b.turn());
        match (a.is_zero(), b.is_zero()) {
            (true, true) => Some(Ratio::ZERO),
            _ => a.plus(b),
        }
    };
    Residue {
        field: a.field + b.field,
        two_adic: a.two_adic + b.two_adic,
        ratio: ratio.unwrap_or(Ratio::ZERO),
        is_rational: is_rational && ratio.is_some(),
        constant,
        defined: true,
    }
}

fn product(a: &Residue, b: &Residue) -> Residue {
    if !a.defined || !b.defined {
        return Residue::UNDEFINED;
    }
    // Most derivatives that dual numbers multiply are 0, many others 1. 0 times a symbol is 0 for every choice of it.
    for (a, b) in [(a, b), (b, a)] {
        if a.is_exactly(0) {
            return *a;
        }
        if a.is_exactly(1) {
            let constant = a.constant && b.constant;
            return Residue { constant, ..*b };
        }
    }
    let is_rational = a.is_rational && b.is_rational;
    let ratio = match (a.rational(), b.rational()) {
        (Some(a), Some(b)) => a.times(b),
        (Some(by), None) | (None, Some(by)) => {
            let turn = if a.is_rational { b.ratio } else { a.ratio };
            if turn.is_zero() {
                Some(Ratio::ZERO)
            } else {
                turn.times(by)
            }
        }
        (None, None) => None,
    };
    Residue {
        field: a.field * b.field,
        two_adic: a.two_adic * b.two_adic,
        ratio: ratio.unwrap_or(Ratio::ZERO),
        is_rational: is_rational && ratio.is_some(),
        constant: a.constant && b.constant,
        defined: true,
    }
}
