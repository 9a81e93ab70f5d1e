//! The accelerations from `M a = f`, specialised to what is zero, constant or varying in M.
//!
//! M = L D Lᵀ without exchange of rows, in an order found here. M is symmetric and positive
//! definite wherever the coordinates describe the machine, and for such a matrix every order is
//! backward stable: the computed factors are those of M + ΔM with |ΔM| ≤ γ |L| |D| |Lᵀ| ≤ γ' √(Mᵢᵢ
//! Mⱼⱼ) (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002, theorems
//! 10.3 and 10.4). So the order may be the one that is cheapest to run.
//!
//! The order is that of minimum degree with a weight for stages: operations whose operands only
//! parameters decide are free, because they are done once. Zeros stay out of the code altogether;
//! blocks that are not coupled fall apart by themselves.
//!
//! Bilateral constraints are further rows and columns, `M a − Gᵀ λ = f` and `G a = γ`, which is
//! symmetric in `a` and `−λ`. The whole is not definite, so not every order will do; a constraint is
//! eliminated once all its coordinates are, and then its pivot is `−G M⁻¹ Gᵀ` of what is
//! eliminated already: of one sign wherever the constraints say different things. So a long chain
//! that closes is eliminated from its ends, as a tree is.
//!
//! W. F. Tinney and J. W. Walker, *Direct solutions of sparse network equations by optimally
//! ordered triangular factorization*, Proc. IEEE 55 (1967) 1801–1809, scheme 2.

use super::Shape;
use super::graph::{Graph, Scaled};

/// How many times n·2⁻⁵² of its diagonal entry a pivot must exceed.
///
/// What is left of Mᵢᵢ in the pivot dᵢ carries an error of at most (n + 1)·2⁻⁵³·Mᵢᵢ from the
/// elimination (theorem 10.3), half of n·2⁻⁵²·Mᵢᵢ and a little; the rest allows for entries of M
/// that are wrong by 7n·2⁻⁵³ of themselves, more than the roundings on the way from the ground to a
/// body of any machine seen. A pivot below that may be nothing but error: there, accelerations
/// would have no correct digit.
const PIVOT_MARGIN: f64 = 4.0;

/// The share of a diagonal entry that may be rounding error in a pivot of an n×n matrix.
pub(super) fn pivot_tolerance(n: usize) -> f64 {
    PIVOT_MARGIN * n as f64 * f64::EPSILON
}

/// Accelerations, and the pivots that must not vanish, in the order of elimination.
pub(super) struct Solution {
    pub(super) accelerations: Vec<Scaled>,
    /// Of the constraints.
    pub(super) multipliers: Vec<Scaled>,
    pub(super) pivots: Vec<Pivot>,
    /// What was done with each pivot.
    pub(super) columns: Vec<Column>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Pivot {
    pub(super) coordinate: usize,
    pub(super) pivot: Scaled,
    pub(super) scale: Scaled,
}

/// What is solved: the lower triangle of M row by row and f; behind them the rows of G, each with
/// zeros up to the diagonal, and γ.
#[derive(Clone, PartialEq)]
pub(super) struct System {
    pub(super) matrix: Vec<Scaled>,
    pub(super) forces: Vec<Scaled>,
    /// How many rows are of coordinates.
    pub(super) coordinates: usize,
}

/// Solves `M a = f + Gᵀ λ`, `G a = γ`.
pub(super) fn solve(graph: &mut Graph, system: &System, elimination: Elimination) -> Solution {
    let System {
        matrix,
        forces,
        coordinates,
    } = system;
    let (n, is_constraint) = (forces.len(), |row: usize| row >= *coordinates);
    let mut left = Entries::new(matrix, n);
    // The diagonal of G M⁻¹ Gᵀ.
    let mut compliance: Vec<Vec<Scaled>> = vec![Vec::new(); n - coordinates];
    let mut pivots = Vec::with_capacity(n);
    let mut reduced: Vec<Vec<Scaled>> = forces.iter().map(|force| vec![*force]).collect();
    let mut columns: Vec<Column> = Vec::with_capacity(n);
    let mut eliminated = vec![false; n];
    for k in elimination.order {
        eliminated[k] = true;
        let pivot = left.total(graph, k, k);
        pivots.push(match is_constraint(k) {
            false => Pivot {
                coordinate: k,
                pivot,
                scale: matrix[Shape::index(k, k)],
            },
            true => Pivot {
                coordinate: k,
                pivot: pivot.negated(),
                scale: total(graph, &compliance[k - coordinates]),
            },
        });
        // Column k of what is left of M: u, of which l = u/d.
        let mut column = Vec::new();
        for i in (0..n).filter(|i| !eliminated[*i]) {
            let u = left.total(graph, i, k);
            if !u.is_zero() {
                let l = graph.quotient(u, pivot);
                column.push((i, u, graph.whole(l)));
            }
        }
        // Mᵢⱼ −= lᵢ uⱼ.
        for (position, &(i, _, l)) in column.iter().enumerate() {
            for &(j, u, _) in &column[..=position] {
                let product = graph.product(&[(l, 1), (u, 1)]);
                left.subtract(i, j, product);
                if i == j && is_constraint(i) && !is_constraint(k) {
                    compliance[i - coordinates].push(product);
                }
            }
        }
        // fᵢ −= lᵢ fₖ.
        let force = total(graph, &reduced[k]);
        for &(i, _, l) in &column {
            reduced[i].push(graph.product(&[(l, 1), (force, 1)]).negated());
        }
        let scaled = graph.quotient(force, pivot);
        columns.push(Column {
            k,
            scaled,
            below: column.iter().map(|&(i, _, l)| (i, l)).collect(),
        });
    }
    // aₖ = fₖ/dₖ − Σ lᵢ aᵢ, last pivot first.
    let mut accelerations = vec![Scaled::ZERO; n];
    for Column { k, scaled, below } in columns.iter().rev() {
        let mut terms = vec![*scaled];
        terms.extend(
            below
                .iter()
                .map(|&(i, l)| graph.product(&[(l, 1), (accelerations[i], 1)]).negated()),
        );
        accelerations[*k] = total(graph, &terms);
    }
    let multipliers = accelerations.split_off(*coordinates);
    Solution {
        accelerations,
        multipliers: multipliers.into_iter().map(Scaled::negated).collect(),
        pivots,
        columns,
    }
}

/// One step of the elimination: `scaled` is fₖ/dₖ, `below` holds the rows i and multipliers lᵢ.
pub(super) struct Column {
    k: usize,
    scaled: Scaled,
    pub(super) below: Vec<(usize, Scaled)>,
}

/// The sum, as one value that is computed once.
fn total(graph: &mut Graph, terms: &[Scaled]) -> Scaled {
    let sum = graph.sum(terms);
    graph.whole(sum)
}

/// What is left of M while it is eliminated: for each entry of the lower triangle its terms.
struct Entries {
    n: usize,
    terms: Vec<Vec<Scaled>>,
}

impl Entries {
    fn new(matrix: &[Scaled], n: usize) -> Entries {
        let terms = matrix.iter().map(|entry| {
            if entry.is_zero() {
                vec![]
            } else {
                vec![*entry]
            }
        });
        Entries {
            n,
            terms: terms.collect(),
        }
    }

    fn subtract(&mut self, i: usize, j: usize, term: Scaled) {
        self.terms[Shape::index(i, j)].push(term.negated());
    }

    fn total(&self, graph: &mut Graph, i: usize, j: usize) -> Scaled {
        total(graph, &self.terms[Shape::index(i, j)])
    }
}

/// What kind of number an entry is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Zero,
    /// Decided by parameters: work on such entries is done once.
    Known,
    Varying,
}

/// The kinds of all entries, and which rows are left.
struct Pattern {
    kinds: Vec<Vec<Kind>>,
    left: Vec<usize>,
}

impl Pattern {
    fn new(entries: &Entries) -> Pattern {
        let kind = |i, j| match entries.terms[Shape::index(i, j)].first() {
            None => Kind::Zero,
            Some(entry) if entry.is_known() => Kind::Known,
            Some(_) => Kind::Varying,
        };
        let kinds = (0..entries.n)
            .map(|i| (0..entries.n).map(|j| kind(i, j)).collect())
            .collect();
        Pattern {
            kinds,
            left: (0..entries.n).collect(),
        }
    }

    /// The rows that eliminating k changes: how many are known, how many vary.
    fn neighbours(&self, k: usize) -> (usize, usize) {
        let count = |kind| {
            self.left
                .iter()
                .filter(|&&i| i != k && self.kinds[i][k] == kind)
                .count()
        };
        (count(Kind::Known), count(Kind::Varying))
    }

    /// The multiplications that eliminating k takes at run time: for the multipliers, for the rest
    /// of the matrix, for the right-hand side and the solution.
    fn cost(&self, k: usize) -> usize {
        let (known, varying) = self.neighbours(k);
        let all = known + varying;
        let pairs = |m: usize| m * (m + 1) / 2;
        if self.kinds[k][k] == Kind::Varying {
            all + pairs(all) + 2 * all
        } else {
            varying + pairs(all) - pairs(known) + 2 * all
        }
    }

    fn eliminate(&mut self, k: usize) {
        self.left.retain(|&i| i != k);
        let touched: Vec<usize> = self
            .left
            .iter()
            .copied()
            .filter(|&i| self.kinds[i][k] != Kind::Zero)
            .collect();
        for &i in &touched {
            for &j in &touched {
                let known = [(k, k), (i, k), (j, k)]
                    .iter()
                    .all(|&(a, b)| self.kinds[a][b] == Kind::Known);
                let change = if known { Kind::Known } else { Kind::Varying };
                self.kinds[i][j] = self.kinds[i][j].max(change);
            }
        }
    }
}

/// The order in which coordinates are eliminated: each time the cheapest one; the first one, if
/// several are.
pub(super) struct Elimination {
    order: Vec<usize>,
    /// How many multiplications it will take at run time.
    pub(super) multiplications: usize,
}

impl Elimination {
    /// The order for a system.
    pub(super) fn of(system: &System) -> Elimination {
        let n = system.forces.len();
        let mut pattern = Pattern::new(&Entries::new(&system.matrix, n));
        let whole = pattern.kinds.clone();
        // A constraint waits for all its coordinates.
        let is_ready = |k: usize, left: &[usize]| {
            let waits_for = |&&i: &&usize| i < system.coordinates && whole[k][i] != Kind::Zero;
            k < system.coordinates || left.iter().find(waits_for).is_none()
        };
        let mut elimination = Elimination {
            order: Vec::with_capacity(n),
            multiplications: 0,
        };
        let next = |pattern: &Pattern| {
            let ready = pattern.left.iter().filter(|k| is_ready(**k, &pattern.left));
            ready.map(|&k| (pattern.cost(k), k)).min()
        };
        while let Some((cost, k)) = next(&pattern) {
            elimination.order.push(k);
            elimination.multiplications += cost;
            pattern.eliminate(k);
        }
        elimination
    }
}
