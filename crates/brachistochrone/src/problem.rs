//! The problem: a machine near its motion, given by constant numbers.

use super::error::Unsolved;
use super::linear::{Cholesky, Matrix, dot, times};

/// A skew part `½ (d_αβ − d_βα)` below this fraction of the inertia of both coordinates is round-off in the given `d`.
const SKEW: f64 = 1e-13;

/// A sliding guide, which determines a friction force: a contact that slides one way while it is pressed together.
///
/// Slip `τ·v > 0`, reaction `N = ν + ρ·v̇ > 0`, friction `μ N` against the slip: `b = Σ μ ν τ`, `d_αβ = Σ μ τ_α ρ_β`.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// Name, for messages.
    pub name: String,
    /// `τ`: the slip per unit of each velocity.
    pub along: Vec<f64>,
    /// `ν`: the reaction without accelerations, in N.
    pub load: f64,
    /// `ρ`: the reaction per unit of each acceleration.
    pub weights: Vec<f64>,
    /// `μ`, the coefficient of friction.
    pub friction: f64,
}

/// A machine with constant masses, a linear potential and constant friction coefficients: the conditions (17).
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub(super) mass: Matrix,
    pub(super) slope: Vec<f64>,
    pub(super) loads: Vec<f64>,
    pub(super) reactive: Matrix,
    pub(super) guides: Vec<Guide>,
}

impl Problem {
    /// A machine without friction: its mass matrix `a` and the slopes `c_α = ∂Π/∂q^α` of its potential energy.
    ///
    /// # Errors
    /// If sizes differ, a number is not finite, or the matrix is not symmetric and positive definite.
    pub fn new(mass: &[Vec<f64>], slope: &[f64]) -> Result<Problem, Unsolved> {
        let n = slope.len();
        check("the mass matrix", mass, n)?;
        check_list("the slope of the potential", slope, n)?;
        for row in 0..n {
            for column in 0..row {
                let (one, other) = (mass[row][column], mass[column][row]);
                // Two ways to sum the same products differ by some roundings of the diagonal.
                let scale = (mass[row][row].abs() * mass[column][column].abs()).sqrt();
                if (one - other).abs() > 64.0 * f64::EPSILON * scale {
                    return Err(Unsolved::NotSymmetric { row, column });
                }
            }
        }
        let mass = mass.to_vec();
        Cholesky::new(&mass)
            .map_err(|(coordinate, ratio)| Unsolved::NoInertia { coordinate, ratio })?;
        Ok(Problem {
            mass,
            slope: slope.to_vec(),
            loads: std::vec![0.0; n],
            reactive: std::vec![std::vec![0.0; n]; n],
            guides: Vec::new(),
        })
    }

    /// Adds friction of the power `−b·v − v·d v̇`.
    ///
    /// # Errors
    /// If sizes differ or a number is not finite.
    pub fn with_friction(mut self, b: &[f64], d: &[Vec<f64>]) -> Result<Problem, Unsolved> {
        let n = self.slope.len();
        check_list("b", b, n)?;
        check("d", d, n)?;
        self.loads.iter_mut().zip(b).for_each(|(sum, b)| *sum += b);
        for (row, d) in self.reactive.iter_mut().zip(d) {
            row.iter_mut().zip(d).for_each(|(sum, d)| *sum += d);
        }
        Ok(self)
    }

    /// Adds the friction of a guide, whose reaction and slip the solution then reports.
    ///
    /// # Errors
    /// If sizes differ or a number is not finite.
    pub fn with_guide(self, guide: Guide) -> Result<Problem, Unsolved> {
        let n = self.slope.len();
        check_list("the slip of a guide", &guide.along, n)?;
        check_list("the weights of a guide", &guide.weights, n)?;
        check_list(
            "load and friction of a guide",
            &[guide.load, guide.friction],
            2,
        )?;
        let scaled = |by: f64, list: &[f64]| -> Vec<f64> { list.iter().map(|x| by * x).collect() };
        let b = scaled(guide.friction * guide.load, &guide.along);
        let rows = guide.along.iter();
        let d: Matrix = rows
            .map(|slip| scaled(guide.friction * slip, &guide.weights))
            .collect();
        let mut problem = self.with_friction(&b, &d)?;
        problem.guides.push(guide);
        Ok(problem)
    }

    /// The number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.slope.len()
    }

    /// The guides, in the order in which they were added.
    pub fn guides(&self) -> &[Guide] {
        &self.guides
    }

    /// Normal coordinates (18)–(19): columns `k_γ` with `k_γ·a k_π = δ_γπ`, so that `q = Σ k_γ q^γ`.
    ///
    /// The first is along (1, …, 1), the others along the first coordinates, orthogonalized against those before it,
    /// with a positive first entry: for two coordinates this is the paper's (24).
    pub fn normal_coordinates(&self) -> Vec<Vec<f64>> {
        let n = self.coordinates();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for column in 0..n {
            let mut k: Vec<f64> = match column {
                0 => std::vec![1.0; n],
                _ => (0..n)
                    .map(|i| f64::from(u8::from(i + 1 == column)))
                    .collect(),
            };
            // Orthogonalizing once leaves round-off of the removed components, so it is done twice.
            for _ in 0..2 {
                for before in &columns {
                    let part = dot(before, &times(&self.mass, &k));
                    k.iter_mut()
                        .zip(before)
                        .for_each(|(k, before)| *k -= part * before);
                }
                let length = dot(&k, &times(&self.mass, &k)).sqrt();
                k.iter_mut().for_each(|k| *k /= length);
            }
            let first = k.iter().find(|x| x.abs() > f64::EPSILON);
            if first.is_some_and(|first| *first < 0.0) {
                k.iter_mut().for_each(|k| *k = -*k);
            }
            columns.push(k);
        }
        columns
    }

    /// Converts normal coordinates to those of the machine.
    pub fn from_normal(&self, normal: &[f64]) -> Vec<f64> {
        let columns = self.normal_coordinates();
        let mut q = std::vec![0.0; self.coordinates()];
        for (column, value) in columns.iter().zip(normal) {
            q.iter_mut().zip(column).for_each(|(q, k)| *q += k * value);
        }
        q
    }

    /// Converts coordinates of the machine to normal ones: `q^γ = k_γ·a q`.
    pub fn to_normal(&self, q: &[f64]) -> Vec<f64> {
        let momenta = times(&self.mass, q);
        let columns = self.normal_coordinates();
        columns.iter().map(|column| dot(column, &momenta)).collect()
    }
}

/// The plane that contains the motion, orthonormal in the metric `A = a + sym d`.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// The direction of steepest descent, and the direction across it towards which the motion turns.
    pub(super) axes: [Vec<f64>; 2],
    /// The axes as covectors, `A f`.
    pub(super) coaxes: [Vec<f64>; 2],
    /// `R`: the acceleration along the steepest descent.
    pub(super) drive: f64,
    /// `κ`.
    pub(super) kappa: f64,
    /// `|Δq|`.
    pub(super) length: f64,
    /// The angle between the first direction and the end, in rad.
    pub(super) angle: f64,
}

impl Frame {
    pub(super) fn new(problem: &Problem, way: &[f64]) -> Result<Frame, Unsolved> {
        let n = way.len();
        let Problem { mass, reactive, .. } = problem;
        let inertia: Matrix = (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| mass[i][j] + 0.5 * (reactive[i][j] + reactive[j][i]))
                    .collect()
            })
            .collect();
        let factor = Cholesky::new(&inertia).map_err(|(coordinate, ratio)| {
            Unsolved::FrictionOutweighsInertia { coordinate, ratio }
        })?;
        let slope: Vec<f64> = (0..n)
            .map(|i| problem.slope[i] + problem.loads[i])
            .collect();
        let descent = factor.solve(&slope);
        let drive = dot(&descent, &slope).sqrt();
        if drive.is_nan() || drive <= 0.0 {
            return Err(Unsolved::NothingDrives);
        }
        let down: Vec<f64> = descent.iter().map(|x| -x / drive).collect();
        let down_covector = times(&inertia, &down);
        let ahead = dot(&down_covector, way);
        let skew = |i: usize, j: usize| 0.5 * (reactive[i][j] - reactive[j][i]);
        let mut kappa = 0.0;
        let mut across = match n {
            // The vector orthogonal to the covector, of length 1; it is the same to the last digit for any end.
            2 => {
                let root = factor.root_of_determinant();
                let across = std::vec![-down_covector[1] / root, down_covector[0] / root];
                // Ω(f₁, f₂) of a skew form in two variables.
                kappa = skew(0, 1) * (down[0] * across[1] - down[1] * across[0]);
                across
            }
            _ => {
                refuse_loops(&inertia, &skew)?;
                let mut across = way.to_vec();
                for _ in 0..2 {
                    let along = dot(&down_covector, &across);
                    across
                        .iter_mut()
                        .zip(&down)
                        .for_each(|(x, down)| *x -= along * down);
                }
                let length = dot(&across, &times(&inertia, &across)).sqrt();
                // For a path straight down the horizontal component is round-off and defines no direction.
                let scale = if length > 8.0 * f64::EPSILON * ahead.abs() {
                    1.0 / length
                } else {
                    0.0
                };
                across.iter().map(|x| x * scale).collect()
            }
        };
        let mut aside = dot(&times(&inertia, &across), way);
        let (sin, cos) = kappa.atan().sin_cos();
        let mut angle = (aside * cos - ahead * sin).atan2(ahead * cos + aside * sin);
        if angle < 0.0 {
            across.iter_mut().for_each(|x| *x = -*x);
            (kappa, aside, angle) = (-kappa, -aside, -angle);
        }
        let across_covector = times(&inertia, &across);
        Ok(Frame {
            axes: [down, across],
            coaxes: [down_covector, across_covector],
            drive,
            kappa,
            length: ahead.hypot(aside),
            angle,
        })
    }
}

/// With three coordinates or more, a skew part of `d` amplifies the speed along a loop of directions.
fn refuse_loops(inertia: &Matrix, skew: &impl Fn(usize, usize) -> f64) -> Result<(), Unsolved> {
    let n = inertia.len();
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| [j, i]));
    let relative = |[i, j]: [usize; 2]| skew(i, j).abs() / (inertia[i][i] * inertia[j][j]).sqrt();
    let most = pairs.max_by(|one, other| relative(*one).total_cmp(&relative(*other)));
    match most {
        Some(coordinates) if relative(coordinates) > SKEW => Err(Unsolved::LoopsFeed {
            coordinates,
            skew: relative(coordinates),
        }),
        _ => Ok(()),
    }
}

fn check(name: &'static str, matrix: &[Vec<f64>], n: usize) -> Result<(), Unsolved> {
    if matrix.len() != n {
        let found = matrix.len();
        return Err(Unsolved::Size {
            list: name,
            expected: n,
            found,
        });
    }
    matrix.iter().try_for_each(|row| check_list(name, row, n))
}

pub(super) fn check_list(name: &'static str, list: &[f64], n: usize) -> Result<(), Unsolved> {
    if list.len() != n || n == 0 {
        return Err(Unsolved::Size {
            list: name,
            expected: n.max(1),
            found: list.len(),
        });
    }
    if list.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(Unsolved::NotFinite { list: name })
    }
}
