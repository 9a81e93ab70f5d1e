//! Functions of expressions, in normal form.

use core::cmp::Ordering;

use crate::arena::Arena;
use crate::node::{Function, Id, Node, Term};
use crate::rational::Rational;

impl Arena {
    /// A function of its arguments.
    pub(crate) fn function(&mut self, function: Function, arguments: &[Id]) -> Id {
        if arguments.contains(&Arena::UNDEFINED) {
            return Arena::UNDEFINED;
        }
        match *arguments {
            [x] if function.arity() == 1 => self.function_of_one(function, x),
            [x, y] if function.arity() == 2 => self.function_of_two(function, x, y),
            _ => Arena::UNDEFINED,
        }
    }

    fn function_of_one(&mut self, function: Function, x: Id) -> Id {
        use Function::*;
        match function {
            Sin | Cos => self.circular(function, x),
            Tan => {
                let (sine, cosine) = (self.circular(Sin, x), self.circular(Cos, x));
                self.product(&[(sine, 1), (cosine, -1)])
            }
            Asin | Atan | Sinh | Tanh => {
                let (sign, x) = self.split_sign(x);
                let value = match (function, self.as_constant(x)) {
                    (_, Some(value)) if value.is_zero() => Arena::ZERO,
                    (Asin, Some(value)) if value.is_one() => self.turn(1, 2),
                    (Asin, Some(value)) if value > Rational::ONE => Arena::UNDEFINED,
                    (Atan, Some(value)) if value.is_one() => self.turn(1, 4),
                    _ => self.function_node(function, &[x]),
                };
                self.scaled(sign, value)
            }
            Acos => match self.as_constant(x) {
                Some(value) if value.abs() > Rational::ONE => Arena::UNDEFINED,
                Some(value) if value.is_zero() => self.turn(1, 2),
                Some(value) if value.is_one() => Arena::ZERO,
                Some(value) if value == Rational::MINUS_ONE => Arena::PI,
                _ => self.function_node(Acos, &[x]),
            },
            Cosh => {
                let (_, x) = self.split_sign(x);
                if x == Arena::ZERO {
                    Arena::ONE
                } else {
                    self.function_node(Cosh, &[x])
                }
            }
            Exp => {
                if x == Arena::ZERO {
                    return Arena::ONE;
                }
                self.inverse(Ln, x)
                    .unwrap_or_else(|| self.function_node(Exp, &[x]))
            }
            Ln => match self.as_constant(x) {
                Some(value) if value.is_zero() || value.is_negative() => Arena::UNDEFINED,
                Some(value) if value.is_one() => Arena::ZERO,
                _ => self
                    .inverse(Exp, x)
                    .unwrap_or_else(|| self.function_node(Ln, &[x])),
            },
            Sqrt => match self.as_constant(x) {
                Some(value) if value.is_negative() => Arena::UNDEFINED,
                Some(value) => match value.sqrt() {
                    Some(root) => self.constant(root),
                    None => self.function_node(Sqrt, &[x]),
                },
                None => self.function_node(Sqrt, &[x]),
            },
            Abs | Sign => {
                // |c·x| = |c|·|x| and sign(c·x) = sign(c)·sign(x).
                let (sign, x) = self.split_sign(x);
                let (scale, x) = self.split_multiple(x);
                let value = match self.as_constant(x) {
                    // Only 0 and 1 are not multiples of something else; both equal their own sign and magnitude.
                    Some(_) => x,
                    None if x == Arena::PI && function == Sign => Arena::ONE,
                    None if x == Arena::PI => Arena::PI,
                    None => self.function_node(function, &[x]),
                };
                self.scaled(if function == Abs { scale } else { sign }, value)
            }
            Atan2 | Min | Max | Pow => Arena::UNDEFINED,
        }
    }

    fn function_of_two(&mut self, function: Function, x: Id, y: Id) -> Id {
        use Function::*;
        match function {
            Atan2 => match (self.as_constant(x), self.as_constant(y)) {
                (Some(sine), Some(cosine)) if sine.is_zero() => match cosine.cmp(&Rational::ZERO) {
                    Ordering::Greater => Arena::ZERO,
                    Ordering::Less => Arena::PI,
                    Ordering::Equal => Arena::UNDEFINED,
                },
                (Some(sine), Some(cosine)) if cosine.is_zero() => {
                    self.turn(if sine.is_negative() { -1 } else { 1 }, 2)
                }
                _ => self.function_node(Atan2, &[x, y]),
            },
            Min | Max => {
                if x == y {
                    return x;
                }
                if let (Some(a), Some(b)) = (self.as_constant(x), self.as_constant(y)) {
                    return if (a < b) == (function == Min) { x } else { y };
                }
                self.function_node(function, &[x.min(y), x.max(y)])
            }
            Pow => self.power(x, y),
            _ => Arena::UNDEFINED,
        }
    }

    /// x^y: integer and half-integer exponents are powers of the node and of its root.
    fn power(&mut self, x: Id, y: Id) -> Id {
        let Some(exponent) = self.as_constant(y) else {
            return if x == Arena::ONE {
                x
            } else {
                self.function_node(Function::Pow, &[x, y])
            };
        };
        let integer = |value: &Rational| i32::try_from(value.as_integer()?).ok();
        if let Some(power) = integer(&exponent) {
            return self.product(&[(x, power)]);
        }
        if let Some(power) = integer(&(&exponent + &exponent)) {
            let root = self.function(Function::Sqrt, &[x]);
            return self.product(&[(root, power)]);
        }
        match self.as_constant(x) {
            Some(base) if base.is_one() => x,
            Some(base) if base.is_zero() && exponent.is_negative() => Arena::UNDEFINED,
            Some(base) if base.is_zero() => x,
            // A negative number to a fractional power; an integer power this large is not representable either.
            Some(base) if base.is_negative() || exponent.is_integer() => Arena::UNDEFINED,
            _ => self.function_node(Function::Pow, &[x, y]),
        }
    }

    /// sin x or cos x.
    fn circular(&mut self, function: Function, x: Id) -> Id {
        let (sign, x) = self.split_sign(x);
        let value = match self.circular_value(function, x) {
            Some(value) => value,
            None => self.function_node(function, &[x]),
        };
        if function == Function::Sin {
            self.scaled(sign, value)
        } else {
            value
        }
    }

    /// sin x or cos x, if it is simpler than a function of x.
    fn circular_value(&mut self, function: Function, x: Id) -> Option<Id> {
        let (turns, others) = self.split_pi(x)?;
        let sixths = (&turns * &Rational::from(6)).as_integer();
        if others.is_empty() {
            // cos x = sin(x + π/2), that is three sixths of π later.
            let later = if function == Function::Sin { 0 } else { 3 };
            let (numerator, denominator) = match (sixths? + later).rem_euclid(12) {
                0 | 6 => (0, 1),
                1 | 5 => (1, 2),
                3 => (1, 1),
                7 | 11 => (-1, 2),
                9 => (-1, 1),
                _ => return None,
            };
            return Some(self.constant(Rational::new(numerator, denominator)?));
        }
        if turns.is_zero() {
            let inverse = if function == Function::Sin {
                Function::Asin
            } else {
                Function::Acos
            };
            return self.inverse(inverse, x);
        }
        let quarters = (&turns * &Rational::from(2)).as_integer()?.rem_euclid(4);
        let (negative, turned) = match (function, quarters) {
            (Function::Sin, 0) | (Function::Cos, 3) => (false, Function::Sin),
            (Function::Sin, 1) | (Function::Cos, 0) => (false, Function::Cos),
            (Function::Sin, 2) | (Function::Cos, 1) => (true, Function::Sin),
            _ => (true, Function::Cos),
        };
        let rest = self.sum(&others);
        let value = self.circular(turned, rest);
        Some(if negative {
            self.scaled(Rational::MINUS_ONE, value)
        } else {
            value
        })
    }

    /// x as a multiple of π and other terms; `None` for a constant other than 0.
    fn split_pi(&self, x: Id) -> Option<(Rational, Vec<Term>)> {
        match self.node(x) {
            Node::Constant(value) => value.is_zero().then(|| (Rational::ZERO, Vec::new())),
            Node::Pi => Some((Rational::ONE, Vec::new())),
            Node::Sum(terms) => {
                let mut turns = Rational::ZERO;
                let mut others = terms.to_vec();
                others.retain(|(id, coefficient)| {
                    let is_pi = *id == Arena::PI;
                    if is_pi {
                        turns = coefficient.clone();
                    }
                    !is_pi
                });
                Some((turns, others))
            }
            _ => Some((Rational::ZERO, vec![(x, Rational::ONE)])),
        }
    }

    /// The argument of x, if x is this function of something.
    fn inverse(&self, function: Function, x: Id) -> Option<Id> {
        match self.node(x) {
            Node::Function(inner, arguments) if *inner == function => Some(arguments[0]),
            _ => None,
        }
    }

    /// x = ±x′, with the same x′ for x and −x.
    fn split_sign(&mut self, x: Id) -> (Rational, Id) {
        let terms = match self.node(x) {
            Node::Constant(value) if value.is_negative() => {
                let positive = -value;
                return (Rational::MINUS_ONE, self.constant(positive));
            }
            Node::Sum(terms) => terms.clone(),
            _ => return (Rational::ONE, x),
        };
        if let [(inner, coefficient)] = &*terms {
            let (sign, inner) = self.split_sign(*inner);
            let positive = self.scaled(coefficient.abs(), inner);
            return (&sign * &coefficient.signum(), positive);
        }
        // The youngest term is positive: sin(φ₂ − φ₁) rather than −sin(φ₁ − φ₂).
        if terms
            .last()
            .is_none_or(|(_, coefficient)| !coefficient.is_negative())
        {
            return (Rational::ONE, x);
        }
        let opposite: Vec<Term> = terms
            .iter()
            .map(|(id, coefficient)| (*id, -coefficient))
            .collect();
        (Rational::MINUS_ONE, self.sum(&opposite))
    }

    /// x = c·x′ with a constant c, if x is a multiple or a constant.
    fn split_multiple(&self, x: Id) -> (Rational, Id) {
        match self.node(x) {
            Node::Constant(value) if !value.is_zero() => (value.clone(), Arena::ONE),
            Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
            _ => (Rational::ONE, x),
        }
    }

    fn as_constant(&self, x: Id) -> Option<Rational> {
        match self.node(x) {
            Node::Constant(value) => Some(value.clone()),
            _ => None,
        }
    }

    /// `numerator·π/denominator`.
    fn turn(&mut self, numerator: i64, denominator: i64) -> Id {
        match Rational::new(numerator, denominator) {
            Some(multiple) => self.scaled(multiple, Arena::PI),
            None => Arena::UNDEFINED,
        }
    }
}
