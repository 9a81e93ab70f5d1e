//! Radau IIA methods in steps of a fixed length for the equations of a machine with constraints, in each of the formulations of the literature.
//!
//! The equations are those that the runtime has of a machine: M, f, g, G and accelerations of a [`System`]. All formulations share stages, Newton's
//! method and its end, so that nothing but the formulation differs.

use lagrangian::{System, Vector};

/// What is solved for at the stages of a step. With `Q`, `V` the state of a stage and `U`, `A` the slopes of coordinates and rates there:
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// `U = V`, `M A = f + Gᵀ λ`, `g(Q) = 0`.
    Index3,
    /// `U = V`, `M A = f + Gᵀ λ`, `G V + ∂g/∂t = 0`.
    Index2,
    /// `U = V + Gᵀ μ`, `M A = f + Gᵀ λ`, `G V + ∂g/∂t = 0`, `g(Q) = 0`: C. W. Gear, B. Leimkuhler, G. K. Gupta, *Automatic integration of
    /// Euler–Lagrange equations with constraints*, J. Comput. Appl. Math. 12 & 13 (1985) 77–90.
    Stabilized,
    /// `U = V` and the accelerations with the multipliers eliminated, `M A = f + Gᵀ λ`, `G A = γ`.
    Index1,
    /// As before, and each step ends with the projection onto the constraints, as in the runtime.
    Projected,
}

impl Formulation {
    pub const ALL: [Self; 5] = [
        Self::Index3,
        Self::Index2,
        Self::Stabilized,
        Self::Index1,
        Self::Projected,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Index3 => "index 3",
            Self::Index2 => "index 2",
            Self::Stabilized => "index 2, stabilized",
            Self::Index1 => "index 1",
            Self::Projected => "index 1, projected",
        }
    }

    /// The number of unknowns of one linear system of a Newton iteration, of `n` coordinates and `m` constraints: after the stages are decoupled by the
    /// eigenvectors of the method, and positions and rates are eliminated, there is one real system and a complex one for each pair of eigenvalues.
    pub fn unknowns(self, n: usize, m: usize) -> usize {
        match self {
            Self::Index3 | Self::Index2 => n + m,
            Self::Stabilized => n + 2 * m,
            Self::Index1 | Self::Projected => n,
        }
    }
}

/// Radau IIA with two or three stages: its nodes, and its matrix row after row, whose last row is that of the weights.
///
/// E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., 1996, tables IV.5.5 and IV.5.6.
pub struct Radau {
    c: Vec<f64>,
    a: Vec<Vec<f64>>,
}

impl Radau {
    pub fn with_stages(stages: usize) -> Self {
        let r = 6f64.sqrt();
        let a = match stages {
            2 => vec![vec![5.0 / 12.0, -1.0 / 12.0], vec![3.0 / 4.0, 1.0 / 4.0]],
            3 => vec![
                vec![
                    (88.0 - 7.0 * r) / 360.0,
                    (296.0 - 169.0 * r) / 1800.0,
                    (-2.0 + 3.0 * r) / 225.0,
                ],
                vec![
                    (296.0 + 169.0 * r) / 1800.0,
                    (88.0 + 7.0 * r) / 360.0,
                    (-2.0 - 3.0 * r) / 225.0,
                ],
                vec![(16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0],
            ],
            _ => panic!("two or three stages"),
        };
        let c = a.iter().map(|row| row.iter().sum()).collect();
        Self { c, a }
    }

    pub fn stages(&self) -> usize {
        self.c.len()
    }
}

/// The end of a run.
#[derive(Clone, Debug)]
pub struct End {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub multipliers: Vec<f64>,
    /// Evaluations of the equations at a stage, those for derivatives left out.
    pub evaluations: usize,
    /// Solutions of the linear equations of a Newton iteration.
    pub solutions: usize,
    /// Evaluations of constraints by projections.
    pub projections: usize,
    /// The largest `|g|` and `|G v + ∂g/∂t|` at the end of a step.
    pub residuals: [f64; 2],
    /// The total energy.
    pub energy: f64,
}

/// Newton's method ends with a change below this, relative to the largest number of its kind: it converges at least by a factor of 1000 at the step
/// lengths used, so that the remaining change is below the rounding of a step.
const ENOUGH: f64 = 1e-11;

/// Newton's method gives up after so many iterations.
const MOST_ROUNDS: usize = 30;

/// A machine in one formulation.
pub struct Problem<'s, S: System> {
    system: &'s S,
    u: S::Inputs,
    n: usize,
    m: usize,
    formulation: Formulation,
}

impl<'s, S: System> Problem<'s, S> {
    pub fn new(system: &'s S, formulation: Formulation) -> Self {
        Self {
            system,
            u: system.default_inputs(),
            n: system.coordinates().len(),
            m: system.constraints().len(),
            formulation,
        }
    }

    /// The number of slopes and multipliers of a stage, `U`, `A` and, where they are not eliminated or absent, λ and μ.
    fn width(&self) -> usize {
        let multipliers = match self.formulation {
            Formulation::Index3 | Formulation::Index2 => self.m,
            Formulation::Stabilized => 2 * self.m,
            Formulation::Index1 | Formulation::Projected => 0,
        };
        2 * self.n + multipliers
    }

    fn eliminates_multipliers(&self) -> bool {
        matches!(
            self.formulation,
            Formulation::Index1 | Formulation::Projected
        )
    }

    fn vector(&self, numbers: &[f64]) -> S::Vector {
        let mut vector = S::Vector::zeros(self.n);
        vector.as_mut_slice().copy_from_slice(numbers);
        vector
    }

    fn constraint_matrix(&self, t: f64, q: &[f64]) -> Vec<f64> {
        let mut matrix = vec![0.0; self.n * self.m];
        self.system
            .constraint_matrix(t, &self.vector(q), &mut matrix);
        matrix
    }

    fn mass_matrix(&self, t: f64, q: &[f64]) -> Vec<f64> {
        let mut matrix = S::Matrix::zeros(self.n * self.n);
        self.system.mass_matrix(t, &self.vector(q), &mut matrix);
        matrix.as_slice().to_vec()
    }

    fn positions(&self, t: f64, q: &[f64]) -> Vec<f64> {
        let mut g = vec![0.0; self.m];
        self.system.constraint_positions(t, &self.vector(q), &mut g);
        g
    }

    fn rates(&self, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; self.m];
        let [q, v] = [q, v].map(|x| self.vector(x));
        self.system.constraint_rates(t, &q, &v, &mut rates);
        rates
    }

    fn accelerations(&self, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
        let [q, v] = [q, v].map(|x| self.vector(x));
        let mut a = q.zeros_like();
        let solved = self.system.accelerations(t, &q, &v, &self.u, &mut a);
        solved.expect("the mass matrix is regular");
        a.as_slice().to_vec()
    }

    pub fn multipliers(&self, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
        let [q, v] = [q, v].map(|x| self.vector(x));
        let mut multipliers = vec![0.0; self.m];
        let solved = self
            .system
            .multipliers(t, &q, &v, &self.u, &mut multipliers);
        solved.expect("the constraints are independent");
        multipliers
    }

    pub fn energy(&self, t: f64, q: &[f64], v: &[f64]) -> f64 {
        let [q, v] = [q, v].map(|x| self.vector(x));
        self.system.kinetic_energy(t, &q, &v) + self.system.potential_energy(t, &q, &self.u)
    }

    /// What is to vanish at a stage, with its constraints divided by `h²` or `h`, so that all rows are of one size by the accelerations.
    fn residual(&self, t: f64, h: f64, [q, v]: [&[f64]; 2], x: &[f64]) -> Vec<f64> {
        let (n, m) = (self.n, self.m);
        let (slope, rest) = x.split_at(n);
        let (a, multipliers) = rest.split_at(n);
        let mut residual: Vec<f64> = slope.iter().zip(v).map(|(u, v)| u - v).collect();
        if self.eliminates_multipliers() {
            let exact = self.accelerations(t, q, v);
            residual.extend(a.iter().zip(&exact).map(|(a, exact)| a - exact));
            return residual;
        }
        let (lambda, mu) = multipliers.split_at(m);
        let g = self.constraint_matrix(t, q);
        let mass = self.mass_matrix(t, q);
        let mut forces = S::Vector::zeros(n);
        let [q_vector, v_vector] = [q, v].map(|x| self.vector(x));
        self.system
            .forces(t, &q_vector, &v_vector, &self.u, &mut forces);
        let reaction =
            |k: usize, by: &[f64]| -> f64 { (0..m).map(|row| g[row * n + k] * by[row]).sum() };
        let is_stabilized = self.formulation == Formulation::Stabilized;
        if is_stabilized {
            for (k, residual) in residual.iter_mut().enumerate() {
                *residual -= reaction(k, mu);
            }
        }
        for k in 0..n {
            let inertia: f64 = (0..n).map(|j| mass[k * n + j] * a[j]).sum();
            residual.push(inertia - forces.as_slice()[k] - reaction(k, lambda));
        }
        let positions = self.positions(t, q);
        let rates = self.rates(t, q, v);
        match self.formulation {
            Formulation::Index3 => residual.extend(positions.iter().map(|g| g / (h * h))),
            _ => residual.extend(rates.iter().map(|rate| rate / h)),
        }
        if is_stabilized {
            residual.extend(positions.iter().map(|g| g / h));
        }
        residual
    }

    /// Takes `steps` steps of equal length.
    pub fn run(&self, radau: &Radau, [q, v]: [&[f64]; 2], (until, steps): (f64, usize)) -> End {
        let h = until / steps as f64;
        let (n, m, stages) = (self.n, self.m, radau.stages());
        let mut end = End {
            q: q.to_vec(),
            v: v.to_vec(),
            multipliers: self.multipliers(0.0, q, v),
            evaluations: 0,
            solutions: 0,
            projections: 0,
            residuals: [0.0; 2],
            energy: 0.0,
        };
        let mut first = [v, &self.accelerations(0.0, q, v), &end.multipliers].concat();
        first.resize(2 * n + 2 * m, 0.0);
        first.truncate(self.width());
        let mut x = vec![first; stages];
        for step in 0..steps {
            let t = h * step as f64;
            if step > 0 {
                x = predicted(&radau.c, &x);
            }
            self.solve_stages(radau, (t, h), &mut x, &mut end);
            let weights = &radau.a[stages - 1];
            for (weight, x) in weights.iter().zip(&x) {
                for k in 0..n {
                    end.q[k] += h * weight * x[k];
                    end.v[k] += h * weight * x[n + k];
                }
            }
            let t = h * (step + 1) as f64;
            if self.formulation == Formulation::Projected {
                self.project(t, &mut end);
            }
            let most = |residuals: Vec<f64>, before: f64| {
                residuals
                    .iter()
                    .fold(before, |most, x| f64::max(most, x.abs()))
            };
            end.residuals[0] = most(self.positions(t, &end.q), end.residuals[0]);
            end.residuals[1] = most(self.rates(t, &end.q, &end.v), end.residuals[1]);
        }
        end.multipliers = if self.eliminates_multipliers() {
            self.multipliers(until, &end.q, &end.v)
        } else {
            x[stages - 1][2 * n..][..m].to_vec()
        };
        end.energy = self.energy(until, &end.q, &end.v);
        end
    }

    /// Coordinates and rates of a stage.
    fn state(&self, row: &[f64], h: f64, end: &End, x: &[Vec<f64>]) -> [Vec<f64>; 2] {
        let n = self.n;
        let mut state = [end.q.clone(), end.v.clone()];
        for (weight, x) in row.iter().zip(x) {
            for k in 0..n {
                state[0][k] += h * weight * x[k];
                state[1][k] += h * weight * x[n + k];
            }
        }
        state
    }

    /// Newton's method for all stages, with the derivatives at its first guess.
    fn solve_stages(&self, radau: &Radau, (t, h): (f64, f64), x: &mut [Vec<f64>], end: &mut End) {
        let (n, m, stages, width) = (self.n, self.m, radau.stages(), self.width());
        let mut matrix = Matrix::new(stages * width);
        for i in 0..stages {
            let t = t + radau.c[i] * h;
            let state = self.state(&radau.a[i], h, end, x);
            let by_state = self.by_state(t, h, &state, &x[i]);
            let by_own = self.by_unknowns(t, &state[0]);
            for row in 0..width {
                for (j, weight) in radau.a[i].iter().enumerate() {
                    for (k, by) in by_state.iter().take(2 * n).enumerate() {
                        matrix.add(i * width + row, j * width + k, h * weight * by[row]);
                    }
                }
                for k in 0..width {
                    matrix.add(i * width + row, i * width + k, by_own[row * width + k]);
                }
            }
        }
        matrix.factor();
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ROUNDS {
            let mut change = Vec::new();
            for i in 0..stages {
                let [q, v] = self.state(&radau.a[i], h, end, x);
                let t = t + radau.c[i] * h;
                change.extend(self.residual(t, h, [&q, &v], &x[i]));
            }
            end.evaluations += stages;
            matrix.solve(&mut change);
            end.solutions += 1;
            for (x, change) in x.iter_mut().zip(change.chunks_exact(width)) {
                for (x, change) in x.iter_mut().zip(change) {
                    *x -= change;
                }
            }
            // Slopes of coordinates, accelerations and multipliers have sizes of their own; μ vanishes along the motion.
            let kinds = [0..n, n..2 * n, 2 * n..width.min(2 * n + m)];
            let sizes = kinds.map(|kind| {
                let greatest = |rows: &mut dyn Iterator<Item = &[f64]>| {
                    rows.flat_map(|row| &row[kind.clone()])
                        .fold(0.0, |most: f64, x| most.max(x.abs()))
                };
                let of_change = greatest(&mut change.chunks_exact(width));
                of_change / greatest(&mut x.iter().map(Vec::as_slice)).max(f64::MIN_POSITIVE)
            });
            let size = sizes.into_iter().fold(0.0, f64::max);
            // Where rounding hides the solution, changes become no smaller.
            if size <= ENOUGH || (size > 0.5 * before && size < 1e-3) {
                return;
            }
            before = size;
        }
        panic!(
            "{:?} does not converge at {t} s with steps of {h} s",
            self.formulation
        );
    }

    /// Derivatives of the residual of a stage by its coordinates and rates, column after column, by central differences.
    fn by_state(&self, t: f64, h: f64, state: &[Vec<f64>; 2], x: &[f64]) -> Vec<Vec<f64>> {
        let columns = (0..2 * self.n).map(|k| {
            let (level, k) = (k / self.n, k % self.n);
            let by = 1e-6 * (1.0 + state[level][k].abs());
            let at = |by: f64| {
                let mut state = state.clone();
                state[level][k] += by;
                self.residual(t, h, [&state[0], &state[1]], x)
            };
            let pairs = at(by).into_iter().zip(at(-by));
            pairs
                .map(|(above, below)| (above - below) / (2.0 * by))
                .collect()
        });
        columns.collect()
    }

    /// Derivatives of the residual of a stage by its own slopes and multipliers, row after row.
    fn by_unknowns(&self, t: f64, q: &[f64]) -> Vec<f64> {
        let (n, m, width) = (self.n, self.m, self.width());
        let mut matrix = vec![0.0; width * width];
        for k in 0..n {
            matrix[k * width + k] = 1.0;
        }
        if self.eliminates_multipliers() {
            for k in n..width {
                matrix[k * width + k] = 1.0;
            }
            return matrix;
        }
        let (mass, g) = (self.mass_matrix(t, q), self.constraint_matrix(t, q));
        for i in 0..n {
            for j in 0..n {
                matrix[(n + i) * width + n + j] = mass[i * n + j];
            }
            for row in 0..m {
                matrix[(n + i) * width + 2 * n + row] = -g[row * n + i];
                if self.formulation == Formulation::Stabilized {
                    matrix[i * width + 2 * n + m + row] = -g[row * n + i];
                }
            }
        }
        matrix
    }

    /// Projects the end of a step onto the constraints, by the smallest displacement in the metric of inertia.
    fn project(&self, t: f64, end: &mut End) {
        let (n, m) = (self.n, self.m);
        for level in 0..2 {
            for _ in 0..5 {
                let off = match level {
                    0 => self.positions(t, &end.q),
                    _ => self.rates(t, &end.q, &end.v),
                };
                end.projections += 1;
                let (mass, g) = (
                    self.mass_matrix(t, &end.q),
                    self.constraint_matrix(t, &end.q),
                );
                let mut bordered = Matrix::new(n + m);
                for i in 0..n {
                    for j in 0..n {
                        bordered.add(i, j, mass[i * n + j]);
                    }
                    for row in 0..m {
                        bordered.add(i, n + row, g[row * n + i]);
                        bordered.add(n + row, i, g[row * n + i]);
                    }
                }
                bordered.factor();
                let mut change = vec![0.0; n];
                change.extend(off);
                bordered.solve(&mut change);
                let y = [&mut end.q, &mut end.v][level].iter_mut();
                let mut moved: f64 = 0.0;
                for (y, change) in y.zip(&change) {
                    *y -= change;
                    moved = moved.max(change.abs() / (1.0 + y.abs()));
                }
                // Rates are projected by a linear equation; coordinates by a method that converges quadratically.
                if level == 1 || moved < 1e-8 {
                    break;
                }
            }
        }
    }
}

/// The polynomials through the stages of a step, at the stages of the next one.
fn predicted(c: &[f64], x: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let at = |place: f64| {
        let mut sum = vec![0.0; x[0].len()];
        for (own, x) in x.iter().enumerate() {
            let others = (0..c.len()).filter(|other| *other != own);
            let weight: f64 = others
                .map(|other| (place - c[other]) / (c[own] - c[other]))
                .product();
            for (sum, x) in sum.iter_mut().zip(x) {
                *sum += weight * x;
            }
        }
        sum
    };
    c.iter().map(|c| at(1.0 + c)).collect()
}

/// A square matrix, row after row, and its elimination with partial pivoting.
struct Matrix {
    n: usize,
    entries: Vec<f64>,
    order: Vec<usize>,
}

impl Matrix {
    fn new(n: usize) -> Self {
        Self {
            n,
            entries: vec![0.0; n * n],
            order: (0..n).collect(),
        }
    }

    fn add(&mut self, i: usize, j: usize, by: f64) {
        self.entries[i * self.n + j] += by;
    }

    fn factor(&mut self) {
        let n = self.n;
        for k in 0..n {
            let size = |i: &usize| self.entries[i * n + k].abs();
            let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)));
            let pivot = pivot.expect("a row");
            for j in 0..n {
                self.entries.swap(k * n + j, pivot * n + j);
            }
            self.order.swap(k, pivot);
            let (above, below) = self.entries.split_at_mut((k + 1) * n);
            let above = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                if row[k] != 0.0 {
                    let factor = row[k] / above[k];
                    row[k] = factor;
                    for (entry, above) in row[k + 1..].iter_mut().zip(&above[k + 1..]) {
                        *entry -= factor * above;
                    }
                }
            }
        }
    }

    fn solve(&self, x: &mut Vec<f64>) {
        let n = self.n;
        let mut y: Vec<f64> = self.order.iter().map(|row| x[*row]).collect();
        for i in 0..n {
            let known: f64 = (0..i).map(|j| self.entries[i * n + j] * y[j]).sum();
            y[i] -= known;
        }
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|j| self.entries[i * n + j] * y[j]).sum();
            y[i] = (y[i] - known) / self.entries[i * n + i];
        }
        *x = y;
    }
}
