//! Finds pairs of a term to drop and a term to add that are one term with a misprint.
//!
//! The distance of two terms is the total of the misprints that lead from one to the other:
//!
//! | misprint | distance |
//! | --- | --- |
//! | the sign | 1 |
//! | the numerical coefficient | 1 |
//! | a factor too many or missing, or in another power | 1 |
//! | a dot too many or missing: `x`, `der(x)` | 1 |
//! | another index: `s1`, `s2`; `m`, `m0` | 1 |
//! | sine for cosine, or another angle in it | 1 |
//! | a different bracket | 1 |
//! | any other factor for another | 2 |
//!
//! Two terms at a distance of at most two that share a factor, up to such misprints, form a change. Among all
//! assignments of terms to drop to terms to add, the one with the smallest sum of distances is taken, where a term
//! that stays alone costs more than a change. Ties are broken by the fewest misprints in factors that depend on the
//! motion, then by the smallest distance of positions in the two lists.

use lagrangian_symbolic::{Expr, Function, Node, Rational};

use lagrangian_spec::model::stage;

/// The largest distance of a change.
const MISPRINTS: u64 = 2;

/// The most terms that are assigned: the time grows with the cube of their number.
const TERMS: usize = 150;

/// The changes among terms to drop and terms to add, as pairs of indices in the two lists, in the order of the first.
pub(super) fn pairs(drop: &[Expr<'_>], add: &[Expr<'_>]) -> Vec<(usize, usize)> {
    if drop.is_empty() || add.is_empty() || drop.len() + add.len() > TERMS {
        return Vec::new();
    }
    let [from, to] = [drop, add].map(|list| list.iter().map(|&e| Term::of(e)).collect::<Vec<_>>());
    // Criteria are ordered by weight: each outweighs the largest total of the later ones, which is that of `TERMS`
    // misprints or `TERMS²` positions.
    const MISPRINT: u64 = 1 << 32;
    const MOVING: u64 = 1 << 16;
    const { assert!(TERMS * TERMS < MOVING as usize) };
    let cost = |i: usize, j: usize| match to.get(j) {
        Some(to) => match from[i].distance(to) {
            Some((slips, moving)) => slips * MISPRINT + moving * MOVING + i.abs_diff(j) as u64,
            None => 3 * MISPRINTS * MISPRINT,
        },
        // The cost of staying alone.
        None => (MISPRINTS + 1) * MISPRINT,
    };
    let places = assignment(drop.len(), add.len() + drop.len(), cost);
    let joined = places.into_iter().enumerate();
    joined.filter(|&(_, j)| j < add.len()).collect()
}

/// A power, as base and exponent.
pub(super) type Factor<'d> = (Expr<'d>, i32);

/// A product, as its factors.
pub(super) struct Term<'d> {
    /// The numerical coefficient.
    pub coefficient: Rational,
    /// All other factors.
    pub factors: Vec<Factor<'d>>,
}

impl<'d> Term<'d> {
    pub fn of(term: Expr<'d>) -> Term<'d> {
        let dag = term.dag();
        let (coefficient, product) = match term.node() {
            Node::Sum(inner) if inner.len() == 1 => (inner[0].1.clone(), dag.expr(inner[0].0)),
            Node::Constant(value) => (value, dag.one()),
            _ => (Rational::ONE, term),
        };
        let factors = match product.node() {
            Node::Product(factors) => factors.iter().map(|&(id, n)| (dag.expr(id), n)).collect(),
            _ if product.is_one() => Vec::new(),
            _ => vec![(product, 1)],
        };
        Term {
            coefficient,
            factors,
        }
    }

    /// The distance to another term, and the number of misprinted factors that depend on the motion; `None` if the
    /// distance is too large, or the terms share no factor.
    fn distance(&self, other: &Term<'d>) -> Option<(u64, u64)> {
        let mut slips = 0;
        slips += u64::from(self.coefficient.is_negative() != other.coefficient.is_negative());
        slips += u64::from(self.coefficient.abs() != other.coefficient.abs());
        let (mut here, mut there) = (self.factors.clone(), other.factors.clone());
        let (mut common, mut moving) = (0, 0);
        let moves = |factor: &Factor<'d>| u64::from(factor.0.stage() > stage::PARAMETER);
        // Equal factors are matched first, then factors that differ only in their power, then those that
        // differ by a misprint.
        let alike: [fn(&Factor<'d>, &Factor<'d>) -> bool; 3] = [
            |a, b| a == b,
            |a, b| a.0 == b.0,
            |a, b| a.1 == b.1 && differ_by_a_misprint(a.0, b.0),
        ];
        for (alike, price) in alike.into_iter().zip([0, 1, 1]) {
            here.retain(|factor| {
                let found = there.iter().position(|other| alike(factor, other));
                if let Some(place) = found {
                    there.remove(place);
                    slips += price;
                    moving += price * moves(factor);
                    common += 1;
                }
                found.is_none()
            });
        }
        let (fewer, more) = (here.len().min(there.len()), here.len().max(there.len()));
        slips += (2 * fewer + (more - fewer)) as u64;
        moving += here.iter().chain(&there).map(moves).sum::<u64>();
        (common > 0 && slips <= MISPRINTS).then_some((slips, moving))
    }
}

/// Whether two factors differ by a single misprint.
pub(super) fn differ_by_a_misprint(a: Expr<'_>, b: Expr<'_>) -> bool {
    let dag = a.dag();
    match (a.node(), b.node()) {
        (Node::Symbol(a), Node::Symbol(b)) => {
            let [a, b] = [a, b].map(|symbol| dag.name(symbol));
            let ((dots_a, name_a), (dots_b, name_b)) = (undotted(&a), undotted(&b));
            let (letters_a, letters_b) = (without_index(name_a), without_index(name_b));
            if dots_a == dots_b {
                letters_a == letters_b
            } else {
                name_a == name_b
            }
        }
        (Node::Function(f, x), Node::Function(g, y)) => {
            let circular = |f| matches!(f, Function::Sin | Function::Cos);
            f == g || (x == y && circular(f) && circular(g))
        }
        (Node::Sum(_), Node::Sum(_)) => true,
        _ => false,
    }
}

/// The number of derivatives of a name, and the name itself: `der(der(x))` is `x` with two dots.
fn undotted(name: &str) -> (usize, &str) {
    let (mut dots, mut rest) = (0, name);
    while let Some(inside) = rest
        .strip_prefix("der(")
        .and_then(|rest| rest.strip_suffix(')'))
    {
        (dots, rest) = (dots + 1, inside);
    }
    (dots, rest)
}

/// A name without trailing digits, or without the index of a member of a family: `phi` for `phi1`, `q` for `q[3]`.
fn without_index(name: &str) -> &str {
    let base = name.split('[').next().unwrap_or(name);
    base.trim_end_matches(|c: char| c.is_ascii_digit())
}

/// Assigns to each row a different column such that the sum of costs is minimal; there must be at least as many
/// columns as rows.
///
/// H. W. Kuhn, *The Hungarian method for the assignment problem*, Naval Res. Logist. Quart. 2 (1955) 83–97, in the form
/// that adds rows one by one along shortest augmenting paths (R. Jonker, A. Volgenant, Computing 38 (1987) 325–340).
fn assignment(rows: usize, columns: usize, cost: impl Fn(usize, usize) -> u64) -> Vec<usize> {
    let cost = |row: usize, column: usize| i64::try_from(cost(row, column)).unwrap_or(i64::MAX / 4);
    // Dual variables: no pair costs less than the sum of both, and an assigned pair costs exactly that.
    let (mut of_row, mut of_column) = (vec![0i64; rows], vec![0i64; columns]);
    let mut row_in: Vec<Option<usize>> = vec![None; columns];
    for newcomer in 0..rows {
        let mut shortest = vec![i64::MAX; columns];
        let mut before: Vec<Option<usize>> = vec![None; columns];
        let mut settled = vec![false; columns];
        let (mut row, mut last) = (newcomer, None);
        let end = loop {
            for column in (0..columns).filter(|&column| !settled[column]) {
                let reduced_cost = cost(row, column) - of_row[row] - of_column[column];
                if reduced_cost < shortest[column] {
                    (shortest[column], before[column]) = (reduced_cost, last);
                }
            }
            let open = (0..columns).filter(|&column| !settled[column]);
            let Some(nearest) = open.min_by_key(|&column| shortest[column]) else {
                return Vec::new(); // fewer columns than rows
            };
            let step = shortest[nearest];
            // Updates the dual variables of the rows and columns on the tree, so that its edges stay tight.
            of_row[newcomer] += step;
            for column in 0..columns {
                if !settled[column] {
                    shortest[column] -= step;
                } else if let Some(row) = row_in[column] {
                    of_row[row] += step;
                    of_column[column] -= step;
                }
            }
            settled[nearest] = true;
            last = Some(nearest);
            match row_in[nearest] {
                Some(next) => row = next,
                None => break nearest,
            }
        };
        let mut column = end;
        loop {
            let previous = before[column];
            row_in[column] = match previous {
                Some(previous) => row_in[previous],
                None => Some(newcomer),
            };
            match previous {
                Some(previous) => column = previous,
                None => break,
            }
        }
    }
    let mut column_of = vec![0; rows];
    for (column, row) in row_in.into_iter().enumerate() {
        if let Some(row) = row {
            column_of[row] = column;
        }
    }
    column_of
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The minimal sum of costs, by exhaustive search.
    fn least(rows: usize, columns: usize, cost: &dyn Fn(usize, usize) -> u64) -> u64 {
        fn from(
            row: usize,
            rows: usize,
            taken: &mut Vec<bool>,
            cost: &dyn Fn(usize, usize) -> u64,
        ) -> u64 {
            if row == rows {
                return 0;
            }
            let mut best = u64::MAX;
            for column in 0..taken.len() {
                if !std::mem::replace(&mut taken[column], true) {
                    best = best.min(cost(row, column) + from(row + 1, rows, taken, cost));
                    taken[column] = false;
                }
            }
            best
        }
        from(0, rows, &mut vec![false; columns], cost)
    }

    #[test]
    fn no_other_assignment_costs_less() {
        for seed in 0..300u64 {
            let rows = 1 + (seed % 5) as usize;
            let columns = rows + (seed / 5 % 3) as usize;
            // Only few different costs, so that there are ties.
            let cost = |row: usize, column: usize| {
                let mixed = (seed * 31 + row as u64 * 7 + column as u64 * 3 + 1)
                    .wrapping_mul(0x9E37_79B9_7F4A_7C15);
                (mixed >> 40) % (2 + seed % 9)
            };
            let columns_of = assignment(rows, columns, cost);
            let mut distinct = columns_of.clone();
            distinct.sort_unstable();
            distinct.dedup();
            assert_eq!(distinct.len(), rows, "seed {seed}");
            let total: u64 = columns_of
                .iter()
                .enumerate()
                .map(|(r, &c)| cost(r, c))
                .sum();
            assert_eq!(total, least(rows, columns, &cost), "seed {seed}");
        }
    }
}
