//! Tests identities, and whether expressions really depend on the symbols in them, at points of a prime field.
//!
//! Sines and cosines cancel in ways that no local rule detects: the angle by which a top has spun
//! about its own axis occurs in the position of each of its particles and in none of its equations.
//! So identities are not derived but tested: two expressions are evaluated at points of a prime
//! field, where nothing is rounded. Different values prove a difference; equal values at a random
//! point leave a probability of about the degree of the expressions over 2⁴⁰ that they differ after
//! all (J. T. Schwartz, *Fast probabilistic algorithms for verification of polynomial identities*,
//! J. ACM 27 (1980) 701–717).
//!
//! The points are fixed, so the same machine gives the same equations.

use std::collections::{BTreeMap, BTreeSet};

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_symbolic::{
    Dag, Expr, Function, Node, Stage, Symbol, evaluate, evaluation_work, reachable, reverse,
    substitute,
};

/// The number of points that must agree.
const POINTS: usize = 3;

/// The number of points that must agree if an expression contains signs or roots: a sign has two values, and so has the quotient of a number and the root
/// of its square, so each point leaves a probability of ½.
const POINTS_WITH_SIGNS: usize = 64;

/// The number of points that are tried for each one that counts: a square root exists at every second point.
const TRIALS: usize = 16;

/// The largest [work](evaluation_work) of the tests of one machine: some seconds. Whatever is
/// undecided then stays as it is.
const WORK_LIMIT: usize = 30_000_000;

/// Whether two expressions are equal, as far as the prime field can tell; `None` if they have no
/// values at any point.
pub fn equal(a: Expr<'_>, b: Expr<'_>) -> Option<bool> {
    let dag = a.dag();
    let needed = needed_points(dag, &[a, b]);
    let mut agreeing = 0;
    for seed in 0..(TRIALS * needed) as u64 {
        let values = evaluate(dag, &[a, b], |symbol| random_value(seed, symbol));
        if values.iter().all(|value| value.is_finite()) {
            if values[0] != values[1] {
                return Some(false);
            }
            agreeing += 1;
            if agreeing == needed {
                return Some(true);
            }
        }
    }
    None
}

/// Whether an expression is zero, as far as the prime field can tell; `None` if it has no value at any point.
pub fn is_zero(expression: Expr<'_>) -> Option<bool> {
    if expression.is_zero() {
        Some(true)
    } else {
        equal(expression, expression.dag().zero())
    }
}

/// Replaces expressions that are identically zero by 0, whatever their form:
/// `1 - sin(x)^2 - cos(x)^2`.
pub fn write_zeros<'d>(dag: &'d Dag, expressions: &mut [Expr<'d>]) {
    // One evaluation of all leaves only a few to be tested one by one.
    let values = evaluate(dag, expressions, |symbol| random_value(0, symbol));
    for (expression, value) in expressions.iter_mut().zip(values) {
        let is_suspect = value == Residue::ZERO || !value.is_finite();
        if is_suspect && is_zero(*expression) == Some(true) {
            *expression = dag.zero();
        }
    }
}

/// Whether all of these may be divided by: none is zero at a random point. `names` are symbols in them
/// with their meanings, which contain none of these symbols.
///
/// An expression that has no value at any point tried is not known to be zero.
pub fn are_divisors<'d>(
    dag: &'d Dag,
    divisors: &[Expr<'d>],
    names: &[(Expr<'d>, Expr<'d>)],
) -> bool {
    for seed in 0..TRIALS as u64 {
        let mut known: BTreeMap<Symbol, Residue> = BTreeMap::new();
        let meanings: Vec<Expr<'d>> = names.iter().map(|(_, meaning)| *meaning).collect();
        let values = evaluate(dag, &meanings, |symbol| random_value(seed, symbol));
        for ((name, _), value) in names.iter().zip(values) {
            known.extend(name.as_symbol().map(|symbol| (symbol, value)));
        }
        let value = |symbol: Symbol| known.get(&symbol).copied();
        let values = evaluate(dag, divisors, |s| {
            value(s).unwrap_or_else(|| random_value(seed, s))
        });
        if values.contains(&Residue::ZERO) {
            return false;
        }
        if values.iter().all(|value| value.is_finite()) {
            return true;
        }
    }
    true
}

/// Whether an expression is a function of parameters alone, whatever symbols occur in it.
pub fn is_free_of_motion(expression: Expr<'_>) -> bool {
    constants(expression.dag(), &[expression])[0].is_some()
}

/// A basis of the null space of a matrix, at a point where all entries have a value: one vector for each
/// dependent column, with 1 in this column. `None` if the entries have no value at any point tried.
pub fn null_space<'d>(dag: &'d Dag, rows: &[Vec<Expr<'d>>]) -> Option<Vec<Vec<Residue>>> {
    let all: Vec<Expr<'d>> = rows.iter().flatten().copied().collect();
    let width = rows.first().map_or(0, Vec::len);
    let mut points = (0..TRIALS as u64).map(|seed| evaluate(dag, &all, |s| random_value(seed, s)));
    let values = points.find(|values| values.iter().all(|x| x.is_finite()))?;
    let rows = values.chunks(width.max(1)).map(<[_]>::to_vec);
    Some(lagrangian_symbolic::null_space(rows.collect(), width))
}

fn subtract(row: &mut [Residue], factor: Residue, other: &[Residue]) {
    if factor != Residue::ZERO {
        for (x, y) in row.iter_mut().zip(other) {
            if *y != Residue::ZERO {
                *x = *x - factor * *y;
            }
        }
    }
}

/// The sign of an expression, if it is the same everywhere: that of a number times a square.
///
/// In the field a sign is the Legendre symbol, and that of `c x²` is that of `c` at every point. It need
/// not be the sign of the number `c`, which is determined at a point where the expression has a real value.
pub fn constant_sign(expression: Expr<'_>) -> Option<bool> {
    let dag = expression.dag();
    let mut signs = Vec::new();
    for seed in 0..(TRIALS * POINTS_WITH_SIGNS) as u64 {
        let value = evaluate(dag, &[expression], |symbol| random_value(seed, symbol))[0];
        if value.is_finite() && value != Residue::ZERO {
            signs.push(value.sign());
        }
        let is_other = |sign: &Residue| *sign != signs[0];
        if signs.iter().any(is_other) {
            return None;
        }
        if signs.len() == POINTS_WITH_SIGNS {
            break;
        }
    }
    if signs.len() < POINTS_WITH_SIGNS {
        return None;
    }
    /// Far above round-off.
    const ZERO_TOLERANCE: f64 = 1e-9;
    let real =
        (0..TRIALS as u32).map(|point| evaluate(dag, &[expression], |s| sample_value(point, s))[0]);
    let clear: Vec<f64> = real
        .filter(|x| x.is_finite() && x.abs() > ZERO_TOLERANCE)
        .collect();
    let positive = *clear.first()? > 0.0;
    clear
        .iter()
        .all(|x| (*x > 0.0) == positive)
        .then_some(positive)
}

/// Whether the last of some rows is a linear combination of the others, wherever all have values;
/// false if they have no values anywhere.
pub fn is_combination<'d>(dag: &'d Dag, rows: &[Vec<Expr<'d>>]) -> bool {
    let all: Vec<Expr<'d>> = rows.iter().flatten().copied().collect();
    let width = rows.first().map_or(0, Vec::len);
    let mut points = (0..TRIALS as u64).map(|seed| evaluate(dag, &all, |s| random_value(seed, s)));
    let Some(values) = points.find(|values| values.iter().all(|x| x.is_finite())) else {
        return false;
    };
    let mut rows: Vec<Vec<Residue>> = values.chunks(width.max(1)).map(<[_]>::to_vec).collect();
    let Some(mut last) = rows.pop() else {
        return false;
    };
    while let Some(row) = rows.pop() {
        let Some(pivot) = row.iter().position(|x| *x != Residue::ZERO) else {
            continue;
        };
        for other in rows.iter_mut().chain([&mut last]) {
            let factor = other[pivot] / row[pivot];
            subtract(other, factor, &row);
        }
    }
    last.iter().all(|x| *x == Residue::ZERO)
}

/// The expression with only parameters in it, if it is a function of these alone.
pub fn as_function_of_parameters(expression: Expr<'_>) -> Option<Expr<'_>> {
    let mut settled = [expression];
    remove_spurious_symbols(expression.dag(), &mut settled);
    (settled[0].stage() <= Stage::PARAMETER && !settled[0].is_undefined()).then_some(settled[0])
}

/// The symbols among `candidates` that occur in the expressions although none depends on them.
///
/// With 0 substituted for these symbols all expressions keep their values.
pub fn cyclic<'d>(dag: &'d Dag, expressions: &[Expr<'d>], candidates: &[Symbol]) -> Vec<Symbol> {
    // The derivatives of a random combination of the expressions, all from one sweep, leave only a
    // few to be tested one by one.
    let combined: Vec<_> = (1..)
        .map(|n: i64| dag.int(n * n + 7 * n + 1))
        .zip(expressions)
        .collect();
    let seeds: Vec<_> = combined
        .into_iter()
        .map(|(weight, &e)| (e, weight))
        .collect();
    let slopes = reverse(dag, &seeds, candidates);
    let nodes = reachable(dag, expressions);
    let standing: BTreeSet<Symbol> = nodes
        .iter()
        .filter_map(|&id| dag.expr(id).as_symbol())
        .collect();
    let suspects = candidates
        .iter()
        .zip(constants(dag, &slopes))
        .filter(|&(symbol, slope)| slope == Some(Residue::ZERO) && standing.contains(symbol))
        .map(|(&symbol, _)| symbol)
        .collect();
    irrelevant(dag, expressions, suspects)
}

/// The symbols of a list on which none of the expressions depends: with 0 substituted for them all
/// keep their values.
pub fn irrelevant<'d>(
    dag: &'d Dag,
    expressions: &[Expr<'d>],
    mut cyclic: Vec<Symbol>,
) -> Vec<Symbol> {
    let needed = needed_points(dag, expressions);
    if evaluation_work(dag, expressions).saturating_mul(needed * cyclic.len()) > WORK_LIMIT {
        return Vec::new();
    }
    let mut agreeing = 0;
    for seed in 0..(TRIALS * needed) as u64 {
        if agreeing == needed || cyclic.is_empty() {
            return cyclic;
        }
        let at = |zero: Option<Symbol>| {
            evaluate(dag, expressions, |symbol| match zero {
                Some(zero) if zero == symbol => Residue::ZERO,
                _ => random_value(seed, symbol),
            })
        };
        let unchanged = at(None);
        if unchanged.iter().all(|value| value.is_finite()) {
            cyclic.retain(|&symbol| at(Some(symbol)) == unchanged);
            agreeing += 1;
        }
    }
    Vec::new()
}

/// The expressions with 0 substituted for symbols on which they do not depend; unchanged if that
/// has no value.
pub fn with_zeros_for<'d>(
    dag: &'d Dag,
    expressions: Vec<Expr<'d>>,
    symbols: &[Symbol],
) -> Vec<Expr<'d>> {
    let zeros: Vec<_> = symbols.iter().map(|&symbol| (symbol, dag.zero())).collect();
    let shorter = substitute(dag, &expressions, &zeros);
    let has_value = !shorter.iter().any(|expression| expression.is_undefined());
    if has_value { shorter } else { expressions }
}

/// Rewrites every expression that depends on parameters alone so that nothing else occurs in it;
/// expressions that are zero become the constant 0.
pub fn remove_spurious_symbols<'d>(dag: &'d Dag, expressions: &mut [Expr<'d>]) {
    let constants = constants(dag, expressions);
    for (expression, constant) in expressions.iter_mut().zip(constants) {
        if let Some(value) = constant {
            let symbols = expression.symbols().into_iter();
            let varying = symbols.filter(|&symbol| dag.stage_of(symbol) > Stage::PARAMETER);
            let zeros: Vec<_> = varying.map(|symbol| (symbol, dag.zero())).collect();
            let settled = substitute(dag, &[*expression], &zeros);
            if value == Residue::ZERO && is_zero(*expression) == Some(true) {
                *expression = dag.zero();
            } else if evaluate(dag, &settled, |symbol| {
                random_unless_parameter(dag, 0, symbol)
            }) == [value]
            {
                *expression = settled[0];
            }
        }
    }
}

/// For each expression that depends on parameters alone its value at a point; the point is the same for all.
fn constants(dag: &Dag, expressions: &[Expr<'_>]) -> Vec<Option<Residue>> {
    // One more, since the first has nothing to agree with.
    let needed = needed_points(dag, expressions) + 1;
    let mut trials: Vec<Trial> = varying(dag, expressions)
        .into_iter()
        .map(|varies| Trial {
            varies,
            ..Trial::default()
        })
        .collect();
    let mut left = WORK_LIMIT / evaluation_work(dag, expressions).max(1);
    for seed in 0..(TRIALS * needed) as u64 {
        let is_open = |&i: &usize| !trials[i].varies && trials[i].agreeing < needed;
        let open: Vec<usize> = (0..expressions.len()).filter(is_open).collect();
        if open.is_empty() || left == 0 {
            break;
        }
        left -= 1;
        let roots: Vec<Expr<'_>> = open.iter().map(|&i| expressions[i]).collect();
        let values = evaluate(dag, &roots, |symbol| {
            random_unless_parameter(dag, seed, symbol)
        });
        open.iter()
            .zip(values)
            .for_each(|(&i, value)| trials[i].add(value));
    }
    let constant = |trial: Trial| {
        trial
            .first
            .filter(|_| !trial.varies && trial.agreeing >= needed)
    };
    trials.into_iter().map(constant).collect()
}

/// The expressions that certainly depend on more than parameters: ordinary numbers show large
/// differences, at a hundredth of the cost.
fn varying(dag: &Dag, expressions: &[Expr<'_>]) -> Vec<bool> {
    /// Far above round-off.
    const ZERO_TOLERANCE: f64 = 1e-6;
    let at = |point: u32| {
        evaluate(dag, expressions, |symbol| {
            let fixed = dag.stage_of(symbol) <= Stage::PARAMETER;
            sample_value(if fixed { 0 } else { point }, symbol)
        })
    };
    let differ = |(a, b): (f64, f64)| (a - b).abs() > ZERO_TOLERANCE * (1.0 + a.abs() + b.abs());
    at(1).into_iter().zip(at(2)).map(differ).collect()
}

/// A number between ½ and 1½ for a symbol: fractional parts of multiples of √2, √3, …, which are uniformly
/// distributed (H. Weyl, *Über die Gleichverteilung von Zahlen mod. Eins*, Math. Ann. 77 (1916) 313–352).
pub fn sample_value(point: u32, symbol: Symbol) -> f64 {
    let root = (symbol.index() as f64 + 2.0).sqrt() * std::f64::consts::E;
    0.5 + (f64::from(point + 1) * root).fract()
}

/// The knowledge about an expression after some points with the same parameters.
#[derive(Clone, Default)]
struct Trial {
    first: Option<Residue>,
    agreeing: usize,
    varies: bool,
}

impl Trial {
    fn add(&mut self, value: Residue) {
        if value.is_finite() {
            self.varies |= *self.first.get_or_insert(value) != value;
            self.agreeing += 1;
        }
    }
}

/// A value for a symbol.
pub fn random_value(seed: u64, symbol: Symbol) -> Residue {
    Residue::random(seed, symbol.index() as u64)
}

/// Keeps parameters the same, and gives everything else a new value at every point.
fn random_unless_parameter(dag: &Dag, seed: u64, symbol: Symbol) -> Residue {
    let seed = if dag.stage_of(symbol) > Stage::PARAMETER {
        seed
    } else {
        u64::MAX
    };
    random_value(seed, symbol)
}

/// The number of points that prove something about the expressions.
fn needed_points(dag: &Dag, expressions: &[Expr<'_>]) -> usize {
    use Function::{Abs, Acos, Asin, Atan2, Max, Min, Pow, Sign, Sqrt};
    // The root of a square, as of the distance of two points on a line, is an absolute value, whatever its form.
    let is_sign = |id| {
        let with_roots = matches!(
            dag.node(id),
            Node::Function(Sqrt | Pow | Asin | Acos | Atan2, _)
        );
        with_roots || matches!(dag.node(id), Node::Function(Abs | Max | Min | Sign, _))
    };
    let signs = reachable(dag, expressions).into_iter().any(is_sign);
    if signs { POINTS_WITH_SIGNS } else { POINTS }
}
