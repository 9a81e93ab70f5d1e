//! Solves `M a = f` for the accelerations, specialised to the zero, constant and varying entries of M.
//!
//! M = L D Lᵀ without row exchanges, in an order determined here. M is symmetric and positive
//! definite wherever the coordinates describe the machine, and for such a matrix every order is
//! backward stable: the computed factors are those of M + ΔM with |ΔM| ≤ γ |L| |D| |Lᵀ| ≤ γ' √(Mᵢᵢ
//! Mⱼⱼ) (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002, theorems
//! 10.3 and 10.4). So the cheapest order may be taken.
//!
//! The order is that of minimum degree, weighted by stages: operations whose operands depend on
//! parameters alone are free, because they are done once. Zeros never appear in the code, and
//! uncoupled blocks separate by themselves.
//!
//! Bilateral constraints are further rows and columns, `M a − Gᵀ λ = f` and `G a = γ`, which is
//! symmetric in `a` and `−λ`. The whole matrix is indefinite, so not every order is stable. A
//! constraint is eliminated after all its coordinates; its pivot is then `−G M⁻¹ Gᵀ` over what is
//! eliminated already, which has one sign wherever the constraints are independent. So a long chain
//! that forms a loop is eliminated from its ends, like a tree.
//!
//! Which pivots may be divided by is decided at a random point of a prime field, where nothing is
//! rounded and every zero is recognized. Constraints that depend on others leave a pivot of 0: their
//! multipliers are 0 here, and a guard that always fails reports that the multipliers are not unique.
//! If M is singular and constraints hold the massless parts, `M + Gᵀ W G` takes its place, which has
//! the same motion and the same multipliers since the constraints determine `G a` ([`System::held_constraints`]).
//!
//! W. F. Tinney and J. W. Walker, *Direct solutions of sparse network equations by optimally
//! ordered triangular factorization*, Proc. IEEE 55 (1967) 1801–1809, scheme 2.

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_symbolic::Rational;

use super::graph::{Graph, Scaled};
use super::steps::EliminationStep;
use super::{Shape, Source};

/// A pivot must exceed this multiple of n·2⁻⁵² times its diagonal entry.
///
/// The pivot dᵢ, which remains of Mᵢᵢ after elimination, has an error of at most (n + 1)·2⁻⁵³·Mᵢᵢ from the elimination
/// (theorem 10.3), slightly more than half of n·2⁻⁵²·Mᵢᵢ. The rest allows for relative errors of 7n·2⁻⁵³ in the entries of
/// M, more than the roundings on the way from the ground to a body of any machine seen. A smaller pivot may be nothing but
/// error, and the accelerations would have no correct digit.
const PIVOT_MARGIN: f64 = 4.0;

/// The fraction of a diagonal entry that may be rounding error in a pivot of an n×n matrix.
pub fn pivot_tolerance(n: usize) -> f64 {
    PIVOT_MARGIN * n as f64 * f64::EPSILON
}

/// Accelerations, and the pivots that must not vanish, in the order of elimination.
pub struct Solution {
    /// `a`, in the order of the coordinates.
    pub accelerations: Vec<Scaled>,
    /// The multipliers of the constraints.
    pub multipliers: Vec<Scaled>,
    /// The pivots that must not vanish, in the order of elimination.
    pub pivots: Vec<Pivot>,
    /// The elimination step of each pivot.
    pub columns: Vec<Column>,
    /// The values of the elimination, for comments.
    pub steps: Vec<(Scaled, EliminationStep)>,
}

/// A pivot of the elimination.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Pivot {
    /// The coordinate that is eliminated; indices beyond the coordinates are those of constraints.
    pub coordinate: usize,
    /// Its value.
    pub pivot: Scaled,
    /// The diagonal entry from which it was reduced.
    pub scale: Scaled,
}

/// The system to solve: the lower triangle of M row by row and f, followed by the rows of G, each
/// with zeros up to the diagonal, and γ.
#[derive(Clone, PartialEq)]
pub struct System {
    /// The triangle.
    pub matrix: Vec<Scaled>,
    /// The right-hand side.
    pub forces: Vec<Scaled>,
    /// The number of rows of coordinates.
    pub coordinates: usize,
    /// Constraints whose squares are part of M and f, `M + Σ wₖ gₖ gₖᵀ` and `f + Σ wₖ γₖ gₖ`, with
    /// their weights.
    pub held_constraints: Vec<(usize, Scaled)>,
}

impl System {
    /// The lower triangle at a random point where all of it has a value.
    fn at_random(&self, graph: &Graph) -> Option<Vec<Residue>> {
        /// A square root exists at half of all points.
        const TRIALS: u64 = 16;
        let at = |seed| graph.evaluate(&self.matrix, |source| random(seed, source));
        (0..TRIALS)
            .map(at)
            .find(|values| values.iter().all(|value| value.is_finite()))
    }

    /// The row of a constraint.
    pub fn row(&self, constraint: usize) -> &[Scaled] {
        let start = Shape::index(self.coordinates + constraint, 0);
        &self.matrix[start..start + self.coordinates]
    }

    /// This system with a regular M, if constraints hold massless parts: each of these constraints
    /// adds as much inertia along it as its coordinates have together.
    pub fn regularized(mut self, graph: &mut Graph) -> System {
        let n = self.coordinates;
        let count = self.forces.len() - n;
        if count == 0 {
            return self;
        }
        let Some(values) = self.at_random(graph) else {
            return self;
        };
        let entry = |i: usize, j: usize| values[Shape::index(i.max(j), i.min(j))];
        let rows = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect());
        let free = lagrangian_symbolic::null_space(rows.collect(), n);
        let mut matrix = self.matrix.clone();
        let mut forces = self.forces.clone();
        for k in 0..count {
            let along = |direction: &Vec<Residue>| {
                let products = (0..n).map(|j| entry(n + k, j) * direction[j]);
                products.fold(Residue::ZERO, |sum, x| sum + x)
            };
            if free
                .iter()
                .all(|direction| along(direction) == Residue::ZERO)
            {
                continue;
            }
            let row = self.row(k).to_vec();
            let own = (0..n).filter(|&j| !row[j].is_zero());
            let inertia = own.clone().fold(Residue::ZERO, |sum, j| sum + entry(j, j));
            let inert: Vec<usize> = if inertia == Residue::ZERO {
                (0..n).collect()
            } else {
                own.clone().collect()
            };
            let inertia = inert.iter().map(|&j| self.matrix[Shape::index(j, j)]);
            let inertia = graph.sum(&inertia.collect::<Vec<_>>());
            let squares: Vec<Scaled> = own.clone().map(|j| graph.product(&[(row[j], 2)])).collect();
            let squares = graph.sum(&squares);
            let weight = graph.quotient(inertia, squares);
            let weight = graph.opaque(weight);
            let weighted: Vec<Scaled> = row
                .iter()
                .map(|g| {
                    let weighted = graph.product(&[(weight, 1), (*g, 1)]);
                    graph.opaque(weighted)
                })
                .collect();
            for i in own.clone() {
                for j in own.clone().take_while(|j| *j <= i) {
                    let place = &mut matrix[Shape::index(i, j)];
                    let product = graph.product(&[(weighted[i], 1), (row[j], 1)]);
                    *place = total(graph, &[*place, product]);
                }
                let product = graph.product(&[(weighted[i], 1), (self.forces[n + k], 1)]);
                forces[i] = total(graph, &[forces[i], product]);
            }
            self.held_constraints.push((k, weight));
        }
        self.matrix = matrix;
        self.forces = forces;
        self
    }
}

/// A random value of an argument, the same for the same seed.
fn random(seed: u64, source: Source) -> Residue {
    let (kind, index) = match source {
        Source::Time => (0, 0),
        Source::Parameter(index) => (1, index),
        Source::Prepared(index) => (2, index),
        Source::Coordinate(index) => (3, index),
        Source::Velocity(index) => (4, index),
        Source::Input(index) => (5, index),
        Source::Acceleration(index) => (6, index),
        Source::AtTime(index) => (7, index),
        Source::AtPosition(index) => (8, index),
    };
    Residue::random(seed, kind << 32 | u64::from(index))
}

/// Solves `M a = f + Gᵀ λ`, `G a = γ`.
pub fn solve(graph: &mut Graph, system: &System, elimination: Elimination) -> Solution {
    let System {
        matrix,
        forces,
        coordinates,
        ..
    } = system;
    let (n, is_constraint) = (forces.len(), |row: usize| row >= *coordinates);
    let mut left = Entries::new(matrix, n);
    // The diagonal of G M⁻¹ Gᵀ.
    let mut compliance: Vec<Vec<Scaled>> = vec![Vec::new(); n - coordinates];
    let mut pivots = Vec::with_capacity(n);
    let mut reduced: Vec<Vec<Scaled>> = forces.iter().map(|force| vec![*force]).collect();
    let mut columns: Vec<Column> = Vec::with_capacity(n);
    let mut eliminated = vec![false; n];
    let mut steps: Vec<(Scaled, EliminationStep)> = Vec::new();
    for k in elimination.order {
        eliminated[k] = true;
        if elimination.dependent.contains(&k) {
            pivots.push(Pivot {
                coordinate: k,
                pivot: Scaled::ZERO,
                scale: graph.constant(&Rational::ONE),
            });
            columns.push(Column {
                k,
                scaled: Scaled::ZERO,
                below: Vec::new(),
            });
            continue;
        }
        let pivot = left.total(graph, k, k);
        steps.push((pivot, EliminationStep::Pivot(k)));
        let (own, scale) = if is_constraint(k) {
            let scale = total(graph, &compliance[k - coordinates]);
            (pivot.negated(), scale)
        } else {
            (pivot, matrix[Shape::index(k, k)])
        };
        pivots.push(Pivot {
            coordinate: k,
            pivot: own,
            scale,
        });
        let matters = |i: &usize| !eliminated[*i] && !elimination.dependent.contains(i);
        let column = left.column(graph, k, pivot, (0..n).filter(matters));
        let factors = column
            .iter()
            .map(|&(i, _, l)| (l, EliminationStep::Factor(i, k)));
        steps.extend(factors);
        let products = left.subtract_column(graph, &column);
        if !is_constraint(k) {
            let of_constraints = products.into_iter().filter(|(i, _)| is_constraint(*i));
            of_constraints.for_each(|(i, product)| compliance[i - coordinates].push(product));
        }
        // fᵢ −= lᵢ fₖ.
        let force = total(graph, &reduced[k]);
        if reduced[k].len() > 1 {
            steps.push((force, EliminationStep::Load(k)));
        }
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
    let mut accelerations = back_substituted(graph, &columns, n, &mut steps);
    let multipliers = accelerations.split_off(*coordinates);
    Solution {
        accelerations,
        multipliers: multipliers.into_iter().map(Scaled::negated).collect(),
        pivots,
        columns,
        steps,
    }
}

/// Back substitution, `aₖ = fₖ/dₖ − Σ lᵢ aᵢ`, last pivot first.
fn back_substituted(
    graph: &mut Graph,
    columns: &[Column],
    n: usize,
    steps: &mut Vec<(Scaled, EliminationStep)>,
) -> Vec<Scaled> {
    let mut accelerations = vec![Scaled::ZERO; n];
    for Column { k, scaled, below } in columns.iter().rev() {
        let mut terms = vec![*scaled];
        terms.extend(
            below
                .iter()
                .map(|&(i, l)| graph.product(&[(l, 1), (accelerations[i], 1)]).negated()),
        );
        accelerations[*k] = total(graph, &terms);
        if terms.len() > 1 {
            steps.push((accelerations[*k], EliminationStep::Solution(*k)));
        }
    }
    accelerations
}

/// One step of the elimination: `scaled` is fₖ/dₖ, `below` holds the rows i and multipliers lᵢ.
pub struct Column {
    k: usize,
    scaled: Scaled,
    /// The rows below it, and the multipliers with which it was subtracted from them.
    pub below: Vec<(usize, Scaled)>,
}

/// The sum, as one value that is computed once.
fn total(graph: &mut Graph, terms: &[Scaled]) -> Scaled {
    let sum = graph.sum(terms);
    graph.opaque(sum)
}

/// The Schur complement of M during elimination: for each entry of the lower triangle its terms.
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

    /// Column k below its pivot d, in these rows: u, of which l = u/d, where it is not zero.
    fn column(
        &self,
        graph: &mut Graph,
        k: usize,
        pivot: Scaled,
        rows: impl Iterator<Item = usize>,
    ) -> Vec<(usize, Scaled, Scaled)> {
        let mut column = Vec::new();
        for i in rows {
            let u = self.total(graph, i, k);
            if !u.is_zero() {
                let l = graph.quotient(u, pivot);
                column.push((i, u, graph.opaque(l)));
            }
        }
        column
    }

    /// Mᵢⱼ −= lᵢ uⱼ; returns what was subtracted from each entry of the diagonal.
    fn subtract_column(
        &mut self,
        graph: &mut Graph,
        column: &[(usize, Scaled, Scaled)],
    ) -> Vec<(usize, Scaled)> {
        let mut of_diagonal = Vec::with_capacity(column.len());
        for (position, &(i, _, l)) in column.iter().enumerate() {
            for &(j, u, _) in &column[..=position] {
                let product = graph.product(&[(l, 1), (u, 1)]);
                self.subtract(i, j, product);
                if i == j {
                    of_diagonal.push((i, product));
                }
            }
        }
        of_diagonal
    }

    fn total(&self, graph: &mut Graph, i: usize, j: usize) -> Scaled {
        total(graph, &self.terms[Shape::index(i, j)])
    }
}

/// The kind of an entry.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum EntryKind {
    Zero,
    /// Dependent on parameters alone: operations on such entries are done once.
    Known,
    Varying,
}

/// The kinds of all entries, and the remaining rows.
struct Pattern {
    kinds: Vec<Vec<EntryKind>>,
    remaining: Vec<usize>,
}

impl Pattern {
    fn new(entries: &Entries) -> Pattern {
        let kind = |i, j| match entries.terms[Shape::index(i, j)].first() {
            None => EntryKind::Zero,
            Some(entry) if entry.is_known() => EntryKind::Known,
            Some(_) => EntryKind::Varying,
        };
        let kinds = (0..entries.n)
            .map(|i| (0..entries.n).map(|j| kind(i, j)).collect())
            .collect();
        Pattern {
            kinds,
            remaining: (0..entries.n).collect(),
        }
    }

    /// The rows that eliminating k changes: the numbers of known and of varying ones.
    fn neighbours(&self, k: usize) -> (usize, usize) {
        let count = |kind| {
            self.remaining
                .iter()
                .filter(|&&i| i != k && self.kinds[i][k] == kind)
                .count()
        };
        (count(EntryKind::Known), count(EntryKind::Varying))
    }

    /// The multiplications that eliminating k takes at run time: for the multipliers, for the rest
    /// of the matrix, for the right-hand side and the solution.
    fn cost(&self, k: usize) -> usize {
        let (known, varying) = self.neighbours(k);
        let all = known + varying;
        let pairs = |m: usize| m * (m + 1) / 2;
        if self.kinds[k][k] == EntryKind::Varying {
            all + pairs(all) + 2 * all
        } else {
            varying + pairs(all) - pairs(known) + 2 * all
        }
    }

    fn eliminate(&mut self, k: usize) {
        self.remaining.retain(|&i| i != k);
        let touched: Vec<usize> = self
            .remaining
            .iter()
            .copied()
            .filter(|&i| self.kinds[i][k] != EntryKind::Zero)
            .collect();
        for &i in &touched {
            for &j in &touched {
                let known = [(k, k), (i, k), (j, k)]
                    .iter()
                    .all(|&(a, b)| self.kinds[a][b] == EntryKind::Known);
                let change = if known {
                    EntryKind::Known
                } else {
                    EntryKind::Varying
                };
                self.kinds[i][j] = self.kinds[i][j].max(change);
            }
        }
    }
}

/// A system at a random point during elimination; without numbers if no point was found.
struct Numbers {
    lower: Option<Vec<Residue>>,
}

impl Numbers {
    fn is_zero(&self, i: usize, j: usize) -> bool {
        let index = Shape::index(i.max(j), i.min(j));
        let entry = self.lower.as_ref().map(|lower| lower[index]);
        entry == Some(Residue::ZERO)
    }

    /// Eliminates row k, whose pivot is not zero, from the remaining rows.
    fn eliminate(&mut self, k: usize, left: &[usize]) {
        let Some(lower) = &mut self.lower else {
            return;
        };
        let index = |i: usize, j: usize| Shape::index(i.max(j), i.min(j));
        let pivot = lower[index(k, k)];
        let column = left.iter().map(|&i| (i, lower[index(i, k)]));
        let column: Vec<(usize, Residue)> = column.filter(|(_, u)| *u != Residue::ZERO).collect();
        for (position, &(i, u)) in column.iter().enumerate() {
            let l = u / pivot;
            for &(j, other) in &column[..=position] {
                let entry = &mut lower[index(i, j)];
                *entry = *entry - l * other;
            }
        }
    }
}

/// The order in which coordinates are eliminated: the cheapest one at each step, or the first in
/// case of a tie.
pub struct Elimination {
    order: Vec<usize>,
    /// Rows that depend on those before them.
    dependent: Vec<usize>,
    /// The number of multiplications at run time.
    pub multiplications: usize,
}

impl Elimination {
    /// The order for a system.
    pub fn of(graph: &Graph, system: &System) -> Elimination {
        Elimination::ordered(graph, system, false)
    }

    /// The order in which all coordinates are eliminated before the first constraint: the scales of the pivots of constraints are then the
    /// diagonal of `G M⁻¹ Gᵀ`.
    pub fn of_coordinates_first(graph: &Graph, system: &System) -> Elimination {
        Elimination::ordered(graph, system, true)
    }

    fn ordered(graph: &Graph, system: &System, coordinates_first: bool) -> Elimination {
        let n = system.forces.len();
        let mut numbers = Numbers {
            lower: system.at_random(graph),
        };
        let mut pattern = Pattern::new(&Entries::new(&system.matrix, n));
        let kinds = pattern.kinds.clone();
        // A constraint waits for all its coordinates.
        let is_ready = |k: usize, left: &[usize]| {
            let waits_for = |&&i: &&usize| {
                i < system.coordinates && (coordinates_first || kinds[k][i] != EntryKind::Zero)
            };
            k < system.coordinates || left.iter().find(waits_for).is_none()
        };
        let mut elimination = Elimination {
            order: Vec::with_capacity(n),
            dependent: Vec::new(),
            multiplications: 0,
        };
        let next = |pattern: &Pattern, numbers: &Numbers| {
            let ready = pattern
                .remaining
                .iter()
                .filter(|k| is_ready(**k, &pattern.remaining));
            ready
                .map(|&k| (numbers.is_zero(k, k), pattern.cost(k), k))
                .min()
        };
        while let Some((is_zero, cost, k)) = next(&pattern, &numbers) {
            elimination.order.push(k);
            if is_zero {
                elimination.dependent.push(k);
                pattern.remaining.retain(|&i| i != k);
            } else {
                elimination.multiplications += cost;
                pattern.eliminate(k);
                numbers.eliminate(k, &pattern.remaining);
            }
        }
        elimination
    }
}
