//! Base angles, of which all angles of an expression are multiples.

use std::collections::BTreeMap;

use crate::normal::polynomial::Monomial;
use crate::rational::Rational;

/// Sines of higher multiples are not expanded: sin 50ωt is a sine and not a polynomial of degree 50.
const HIGHEST_MULTIPLE: i64 = 16;

/// The base angle of every monomial that occurs in angles.
#[derive(Default)]
pub(super) struct Angles(BTreeMap<Monomial, Multiples>);

struct Multiples {
    /// The greatest common divisor of all coefficients so far, positive.
    unit: Rational,
    /// The largest coefficient so far.
    largest: Rational,
    /// Whether the unit is too small, so that every coefficient is a base angle of its own.
    apart: bool,
}

impl Angles {
    /// Returns `(unit, n)` with `coefficient = n·unit`, n not 0; and whether earlier results for
    /// this monomial are no longer valid.
    pub(super) fn split(
        &mut self,
        monomial: &Monomial,
        coefficient: &Rational,
    ) -> (Rational, i64, bool) {
        let size = coefficient.abs();
        let sign = if coefficient.is_negative() { -1 } else { 1 };
        let mut changed = false;
        let known = self.0.entry(monomial.clone()).or_insert_with(|| Multiples {
            unit: size.clone(),
            largest: size.clone(),
            apart: false,
        });
        if !known.apart {
            let unit = known.unit.gcd(&size);
            let largest = known.largest.clone().max(size.clone());
            let highest = largest
                .checked_div(&unit)
                .and_then(|multiple| multiple.as_integer());
            known.apart = highest.is_none_or(|multiple| multiple > HIGHEST_MULTIPLE);
            changed = known.apart || unit != known.unit;
            (known.unit, known.largest) = (unit, largest);
        }
        let multiple = size
            .checked_div(&known.unit)
            .and_then(|multiple| multiple.as_integer());
        match multiple {
            Some(multiple) if !known.apart => (known.unit.clone(), sign * multiple, changed),
            _ => (size, sign, changed),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_angle_is_the_greatest_common_divisor() {
        let ratio = |n, d| Rational::new(n, d).expect("not over 0");
        assert_eq!(ratio(1, 2).gcd(&ratio(1, 3)), ratio(1, 6));
        assert_eq!(ratio(-6, 1).gcd(&ratio(4, 1)), ratio(-2, 1));
        let mut angles = Angles::default();
        let one = Monomial::new();
        assert_eq!(angles.split(&one, &ratio(2, 1)), (ratio(2, 1), 1, false));
        assert_eq!(angles.split(&one, &ratio(-1, 1)), (ratio(1, 1), -1, true));
        assert_eq!(angles.split(&one, &ratio(2, 1)), (ratio(1, 1), 2, false));
        assert_eq!(angles.split(&one, &ratio(50, 1)), (ratio(50, 1), 1, true));
        assert_eq!(angles.split(&one, &ratio(2, 1)), (ratio(2, 1), 1, false));
    }
}
