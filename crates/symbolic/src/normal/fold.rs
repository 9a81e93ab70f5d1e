//! Joins terms that expansion separated: the addition theorems, applied from right to left.

use crate::arena::Arena;
use crate::node::{Factor, Term};
use crate::node::{Function, Id, Node};
use crate::normal::polynomial::{self, Monomial, Polynomial};
use crate::rational::Rational;

/// Joins pairs of terms into one until no pair is left.
pub(super) fn fold(arena: &mut Arena, mut polynomial: Polynomial) -> Polynomial {
    loop {
        let before = polynomial.len();
        // Squares first: cos a cos b + sin a sin b may be hidden by a sin² that was reduced.
        for rule in [fold_squares, fold_angles] {
            let monomials: Vec<Monomial> = polynomial
                .iter()
                .map(|(monomial, _)| monomial.clone())
                .collect();
            for monomial in monomials {
                // It may have been joined with another term in the meantime.
                if let Some(coefficient) = polynomial.coefficient(&monomial).cloned()
                    && let Some(join) = rule(arena, &polynomial, &monomial, &coefficient)
                {
                    join.apply(&mut polynomial, &monomial, &coefficient);
                }
            }
        }
        if polynomial.len() == before {
            return polynomial;
        }
    }
}

/// A term and its partner, to be replaced by one term.
struct Join {
    partner: Monomial,
    result: Monomial,
    coefficient: Rational,
}

impl Join {
    fn apply(self, polynomial: &mut Polynomial, monomial: &Monomial, coefficient: &Rational) {
        polynomial.add(monomial.clone(), &-coefficient);
        polynomial.remove(&self.partner);
        polynomial.add(self.result, &self.coefficient);
    }
}

/// X − X cos² a = X sin² a, X sin² a + X cos² a = X, X cos² a − X sin² a = X cos 2a.
fn fold_squares(
    arena: &mut Arena,
    polynomial: &Polynomial,
    monomial: &Monomial,
    coefficient: &Rational,
) -> Option<Join> {
    for &(id, _) in monomial.iter().filter(|(_, power)| *power >= 2) {
        let Some((Function::Cos, angle)) = circular(arena, id) else {
            continue;
        };
        let rest = polynomial::times(monomial, &[(id, -2)])?;
        let sine = arena.function(Function::Sin, &[angle]);
        let with_sine = polynomial::times(&rest, &[(sine, 2)])?;
        match (
            polynomial.coefficient(&rest),
            polynomial.coefficient(&with_sine),
        ) {
            (Some(other), _) if *other == -coefficient => {
                return Some(Join {
                    partner: rest,
                    result: with_sine,
                    coefficient: other.clone(),
                });
            }
            (_, Some(other)) if other == coefficient => {
                return Some(Join {
                    partner: with_sine,
                    result: rest,
                    coefficient: other.clone(),
                });
            }
            (Some(other), _) if other + other == -coefficient => {
                let (scale, double) = joined(arena, Function::Cos, angle, angle, 1)?;
                let result = polynomial::times(&rest, &double)?;
                return Some(Join {
                    partner: rest,
                    result,
                    coefficient: &scale * &-other,
                });
            }
            (_, Some(other)) if *other == -coefficient => {
                let (scale, double) = joined(arena, Function::Cos, angle, angle, 1)?;
                let result = polynomial::times(&rest, &double)?;
                return Some(Join {
                    partner: with_sine,
                    result,
                    coefficient: &scale * coefficient,
                });
            }
            _ => {}
        }
    }
    None
}

/// X cos a cos b ± X sin a sin b = X cos(a ∓ b), X sin a cos b ± X cos a sin b = X sin(a ± b).
fn fold_angles(
    arena: &mut Arena,
    polynomial: &Polynomial,
    monomial: &Monomial,
    coefficient: &Rational,
) -> Option<Join> {
    let factors: Vec<(Id, Function, Id)> = monomial
        .iter()
        .filter(|(_, power)| *power >= 1)
        .filter_map(|&(id, _)| circular(arena, id).map(|(function, angle)| (id, function, angle)))
        .collect();
    for (index, &(first, f, a)) in factors.iter().enumerate() {
        for &(second, g, b) in &factors[index + 1..] {
            // sin a sin b is found from its partner cos a cos b.
            if a == b || (f, g) == (Function::Sin, Function::Sin) {
                continue;
            }
            let partners =
                [(other(f), a), (other(g), b)].map(|(f, x)| (arena.function(f, &[x]), 1));
            let rest = polynomial::times(monomial, &sorted([(first, -1), (second, -1)]))?;
            let partner = polynomial::times(&rest, &sorted(partners))?;
            let Some(found) = polynomial.coefficient(&partner) else {
                continue;
            };
            let same = found == coefficient;
            if !same && *found != -coefficient {
                continue;
            }
            let (scale, joined) = match (f, g) {
                (Function::Cos, Function::Cos) => {
                    joined(arena, Function::Cos, b, a, if same { -1 } else { 1 })?
                }
                (Function::Sin, _) => {
                    joined(arena, Function::Sin, a, b, if same { 1 } else { -1 })?
                }
                _ => joined(arena, Function::Sin, b, a, if same { 1 } else { -1 })?,
            };
            let result = polynomial::times(&rest, &joined)?;
            return Some(Join {
                partner,
                result,
                coefficient: &scale * coefficient,
            });
        }
    }
    None
}

/// f(a + sign·b) as a multiple of a monomial.
fn joined(arena: &mut Arena, f: Function, a: Id, b: Id, sign: i64) -> Option<(Rational, Monomial)> {
    // The terms of both in one sum, so that φ₁ + φ₂ and φ₃ give φ₁ + φ₂ + φ₃.
    let mut terms = linear_terms(arena, a, &Rational::ONE);
    terms.extend(linear_terms(arena, b, &Rational::from(sign)));
    let angle = arena.sum(&terms);
    let value = arena.function(f, &[angle]);
    let (scale, id) = match arena.node(value) {
        Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
        _ => (Rational::ONE, value),
    };
    // A constant cannot be a factor of a monomial; two different angles never add up to one.
    matches!(arena.node(id), Node::Function(..)).then(|| (scale, vec![(id, 1)]))
}

fn linear_terms(arena: &Arena, id: Id, factor: &Rational) -> Vec<Term> {
    match arena.node(id) {
        Node::Sum(terms) => terms.iter().map(|(id, c)| (*id, c * factor)).collect(),
        _ => vec![(id, factor.clone())],
    }
}

fn circular(arena: &Arena, id: Id) -> Option<(Function, Id)> {
    match arena.node(id) {
        Node::Function(function @ (Function::Sin | Function::Cos), arguments) => {
            Some((*function, arguments[0]))
        }
        _ => None,
    }
}

fn other(function: Function) -> Function {
    if function == Function::Sin {
        Function::Cos
    } else {
        Function::Sin
    }
}

fn sorted(mut factors: [Factor; 2]) -> [Factor; 2] {
    factors.sort_unstable();
    factors
}
