//! Pontryagin's conditions as a boundary value problem, collocated at Gauss points.
//!
//! For states x, multipliers π, controls z and `H(x, π, z)`, with `y = (x, π)` and an end at an unknown time T:
//!
//! ```text
//! ẋ = ∂H/∂π     π̇ = −∂H/∂x     ∂H/∂z = 0     H = 1
//! ```
//!
//! On every stretch y is the polynomial that satisfies the first two conditions at the Gauss points; the error at its end
//! is of order 2 s. U. Ascher, R. Mattheij, R. Russell, *Numerical Solution of Boundary Value Problems* (1995), ch. 5.
//! Newton's method is exact: the second derivatives of H come from dual numbers. The unknowns at Gauss points are
//! eliminated for each stretch, then the stretches one after the other, so that the last system has only as many equations
//! as there are boundary conditions.

mod along;

use super::Terrain;
use super::budget::Budget;
use super::hamiltonian::Driven;
use super::pontryagin::Pontryagin;
use super::rule::{POINTS, Rule, through};
use crate::linear::{Lu, dot};
use crate::solution::Brachistochrone;

/// The most Newton iterations; a good guess needs five.
const MOST: usize = 30;

/// The iteration ends with a step this small, relative to the greatest value of each quantity: its square is below round-off.
const LAST: f64 = 1e-10;

/// Limits for continuation from one machine to another: a step that needs more iterations than this is too long, and this
/// tolerance is enough on the way.
const ON_THE_WAY: (usize, f64) = (10, 1e-4);

/// A quantity that moves by less than this fraction of the largest one is scaled by that fraction, because
/// round-off of the others affects it.
const STILL: f64 = 1e-3;

/// How many times a Newton step may be halved.
const HALVINGS: usize = 6;

/// Rates of y, from the derivatives of H.
fn rates<T: Clone>(slopes: &[T], m: usize, negative: impl Fn(&T) -> T) -> Vec<T> {
    let ahead = slopes[m..2 * m].iter().cloned();
    ahead.chain(slopes[..m].iter().map(negative)).collect()
}

/// States, multipliers and controls at a Gauss point.
#[derive(Clone, Debug)]
pub struct Stage {
    pub y: Vec<f64>,
    pub z: Vec<f64>,
}

/// The extra boundary conditions of a conservative motion from rest to rest.
///
/// Without losses `½ W² + V(q)` is constant for any control. So a multiple of its gradient may be added to the
/// multipliers, `p + α ∂V`, `λ + α W`, which are not unique; and with W = 0 at the end, the end is automatically
/// level with the start. The following two conditions replace λ = 0 and one of the coordinates of the end:
///
/// ```text
/// p·∂V = 0 at the start        W = 0 at the end
/// ```
#[derive(Clone, Debug)]
pub struct Level {
    /// `∂V` at the start.
    pub from: Vec<f64>,
    /// The coordinate of the end that the others determine: the one along which the potential rises most.
    pub follows: usize,
}

/// A motion: its duration, the ends of equal time stretches, and the Gauss points.
#[derive(Clone, Debug)]
pub struct Path {
    /// Present if it ends at rest.
    pub level: Option<Level>,
    pub time: f64,
    pub nodes: Vec<Vec<f64>>,
    pub stages: Vec<Vec<Stage>>,
    /// The control at the end.
    pub last: Vec<f64>,
}

/// The linearization of a stretch.
struct Stretch {
    /// Changes of the stages, a row for each number: constant, by the change of the start, by the change of T.
    inner: Vec<Vec<f64>>,
    /// Changes of the end, in the same form.
    outer: Vec<Vec<f64>>,
}

impl Path {
    /// A guess from the closed form of a machine with frozen coefficients; `None` where its multipliers are infinite.
    pub fn guess<T: Terrain>(
        system: &Driven<T>,
        motion: &Brachistochrone,
        stretches: usize,
    ) -> Option<Path> {
        let time = motion.time();
        let p = motion.constants();
        if !p.iter().all(|p| p.is_finite()) {
            return None;
        }
        let m = system.states();
        let mut before = 0.0;
        let mut at = |t: f64| -> Stage {
            let moment = motion.at(t);
            let z = system.control(&moment.q, &moment.direction, before);
            before = z[0];
            let w = system.measure(&moment.q, &moment.v, &z);
            let mut y = moment.q;
            y.push(w);
            y.extend(&p);
            y.push(0.0);
            // H must be 1, and it is linear in the last multiplier.
            let without = system.value(&y, &z);
            y[2 * m - 1] = 1.0;
            let with = system.value(&y, &z);
            y[2 * m - 1] = (1.0 - without) / (with - without);
            Stage { y, z }
        };
        let h = time / stretches as f64;
        let rule = Rule::new();
        let mut nodes = std::vec![at(0.0).y];
        let mut stages = Vec::new();
        let mut last = Vec::new();
        for k in 0..stretches {
            let start = h * k as f64;
            stages.push(rule.points.map(|c| at(start + c * h)).to_vec());
            let end = at(h * (k + 1) as f64);
            nodes.push(end.y);
            last = end.z;
        }
        Some(Path {
            level: None,
            time,
            nodes,
            stages,
            last,
        })
    }

    /// The positions at `count` equal intervals of time after the start.
    pub fn places(&self, count: usize) -> Vec<Vec<f64>> {
        let n = self.nodes[0].len() / 2 - 1;
        let points = Rule::new().points;
        let place = |k: usize| {
            let part = k as f64 / count as f64 * self.stretches() as f64;
            let stretch = (part as usize).min(self.stretches() - 1);
            let mut known = std::vec![(0.0, &self.nodes[stretch][..n])];
            let inner = points.iter().zip(&self.stages[stretch]);
            known.extend(inner.map(|(c, stage)| (*c, &stage.y[..n])));
            through(&known, part - stretch as f64)
        };
        (0..=count).map(place).collect()
    }

    /// The number of stretches.
    pub fn stretches(&self) -> usize {
        self.stages.len()
    }

    /// This path on twice as many stretches, by evaluating its polynomials.
    pub fn halved(&self) -> Path {
        let points = Rule::new().points;
        let mut nodes = std::vec![self.nodes[0].clone()];
        let mut stages = Vec::new();
        for (k, old) in self.stages.iter().enumerate() {
            let mut known = std::vec![(0.0, self.nodes[k].as_slice())];
            known.extend(
                points
                    .iter()
                    .zip(old)
                    .map(|(c, stage)| (*c, stage.y.as_slice())),
            );
            let controls = points.iter().zip(old);
            let controls: Vec<(f64, &[f64])> = controls
                .map(|(c, stage)| (*c, stage.z.as_slice()))
                .collect();
            for half in [0.0, 0.5] {
                let stage = |c: f64| Stage {
                    y: through(&known, half + c / 2.0),
                    z: through(&controls, half + c / 2.0),
                };
                stages.push(points.map(stage).to_vec());
            }
            nodes.push(through(&known, 0.5));
            nodes.push(self.nodes[k + 1].clone());
        }
        Path {
            level: self.level.clone(),
            time: self.time,
            nodes,
            stages,
            last: self.last.clone(),
        }
    }

    /// The path between these ends, by Newton's method. `None` if it fails, finds a motion that stops on its way, or
    /// exceeds the budget.
    pub fn corrected(
        self,
        system: &impl Pontryagin,
        from: &[f64],
        to: &[f64],
        budget: &Budget,
    ) -> Option<Path> {
        self.converged(system, [from, to], budget, (MOST, LAST))
    }

    /// [`corrected`](Self::corrected) to a few digits, for continuation from a guess that is near.
    pub fn nearly_corrected(
        self,
        system: &impl Pontryagin,
        from: &[f64],
        to: &[f64],
        budget: &Budget,
    ) -> Option<Path> {
        self.converged(system, [from, to], budget, ON_THE_WAY)
    }

    /// Newton's method with a limit on iterations, until a step is smaller than `small`.
    fn converged(
        mut self,
        system: &impl Pontryagin,
        [from, to]: [&[f64]; 2],
        budget: &Budget,
        (most, small): (usize, f64),
    ) -> Option<Path> {
        let scales = self.scales(system);
        let mut residual = self.residuals(system, from, to, &scales);
        for _ in 0..most {
            if budget.is_spent() {
                return None;
            }
            let step = self.step(system, from, to)?;
            let size = self.size(&step, &scales);
            if !size.is_finite() {
                return None;
            }
            let mut part = 1.0;
            for halving in 0..=HALVINGS {
                let next = self.moved(&step, part);
                let left = next.residuals(system, from, to, &scales);
                // A step at the level of round-off cannot reduce the residual, and is accepted.
                if left < residual || size < small {
                    (self, residual) = (next, left);
                    break;
                }
                if halving == HALVINGS {
                    return None;
                }
                part /= 2.0;
            }
            if size < small {
                return self.is_motion(system).then_some(self);
            }
        }
        None
    }

    /// Whether the machine moves all the way, with a positive multiplier of speed.
    fn is_motion(&self, system: &impl Pontryagin) -> bool {
        let m = system.states();
        let count = self.stretches();
        let moves = match self.level {
            Some(_) => &self.nodes[1..count],
            None => &self.nodes[1..],
        };
        let before = &self.nodes[..count];
        // In a conservative motion the sign of this multiplier is arbitrary.
        let saves = self.level.is_some() || before.iter().all(|y| y[2 * m - 1] > 0.0);
        self.time > 0.0 && moves.iter().all(|y| y[m - 1] > 0.0) && saves
    }

    /// The scale of each unknown.
    fn scales(&self, system: &impl Pontryagin) -> Vec<f64> {
        let greatest = |k: usize| {
            let sizes = self.nodes.iter().map(|y| y[k].abs());
            sizes.fold(f64::MIN_POSITIVE, f64::max)
        };
        let mut scales: Vec<f64> = (0..2 * system.states()).map(greatest).collect();
        // A coordinate may end near its start, and its multiplier may vanish; because H is 1, travel and
        // multiplier are scaled by the greatest rate instead. A coordinate that does not move is scaled by a
        // fraction of the largest travel.
        let n = system.states() - 1;
        let mut travels = std::vec![0.0_f64; n];
        for stage in self.stages.iter().flatten() {
            let (_, slopes) = system.slopes(&stage.y, &stage.z);
            for (travel, rate) in travels.iter_mut().zip(&slopes[n + 1..]) {
                *travel = travel.max(self.time * rate.abs());
            }
        }
        let most = travels
            .iter()
            .fold(f64::MIN_POSITIVE, |most, x| most.max(*x));
        for (i, travel) in travels.iter().enumerate() {
            let travel = travel.max(STILL * most);
            scales[i] = scales[i].max(travel);
            scales[n + 1 + i] = scales[n + 1 + i].max(self.time / travel);
        }
        scales
    }

    /// The residuals of the conditions, relative to the scales.
    fn residuals(&self, system: &impl Pontryagin, from: &[f64], to: &[f64], scales: &[f64]) -> f64 {
        let (m, n) = (system.states(), from.len());
        let rule = Rule::new();
        let h = self.time / self.stretches() as f64;
        let mut most = 0.0_f64;
        // `f64::max` would ignore NaN.
        let mut take = |x: f64| {
            most = if x.abs() > most || x.is_nan() {
                x.abs()
            } else {
                most
            }
        };
        for (k, stages) in self.stages.iter().enumerate() {
            let slopes: Vec<Vec<f64>> = stages
                .iter()
                .map(|stage| system.slopes(&stage.y, &stage.z).1)
                .collect();
            let rates: Vec<Vec<f64>> = slopes.iter().map(|s| rates(s, m, |x| -x)).collect();
            for i in 0..2 * m {
                let sum = |weights: &[f64; POINTS]| -> f64 {
                    weights
                        .iter()
                        .zip(&rates)
                        .map(|(w, rate)| w * rate[i])
                        .sum()
                };
                for (stage, weights) in stages.iter().zip(&rule.upto) {
                    take((stage.y[i] - self.nodes[k][i] - h * sum(weights)) / scales[i]);
                }
                let end = self.nodes[k][i] + h * sum(&rule.whole);
                take((end - self.nodes[k + 1][i]) / scales[i]);
            }
            slopes
                .iter()
                .flat_map(|s| &s[2 * m..])
                .for_each(|x| take(*x));
        }
        let (first, last) = (&self.nodes[0], &self.nodes[self.stretches()]);
        for i in 0..n {
            take((first[i] - from[i]) / scales[i]);
            take((last[i] - to[i]) / scales[i]);
        }
        take(first[n] / scales[n]);
        match &self.level {
            Some(level) => {
                take(last[n] / scales[n]);
                let shares = (0..n).map(|i| level.from[i] * scales[m + i]);
                let size: f64 = shares.map(f64::abs).sum();
                take(dot(&level.from, &first[m..m + n]) / size);
            }
            None => take(last[2 * m - 1] / scales[2 * m - 1]),
        }
        let (value, slopes) = system.slopes(last, &self.last);
        take(value - 1.0);
        slopes[2 * m..].iter().for_each(|x| take(*x));
        most
    }

    /// A Newton step.
    fn step(&self, system: &impl Pontryagin, from: &[f64], to: &[f64]) -> Option<Step> {
        let m = system.states();
        let stretches: Option<Vec<Stretch>> = (0..self.stretches())
            .map(|k| self.stretch(system, k))
            .collect();
        let stretches = stretches?;
        // Changes of a node: constant, by the change of the first node, by the change of T.
        let width = 2 * m + 2;
        let mut chain: Vec<Vec<Vec<f64>>> = Vec::new();
        let mut first = std::vec![std::vec![0.0; width]; 2 * m];
        for (i, row) in first.iter_mut().enumerate() {
            row[1 + i] = 1.0;
        }
        chain.push(first);
        for stretch in &stretches {
            let before = &chain[chain.len() - 1];
            chain.push(composed(&stretch.outer, before));
        }
        let end = &self.nodes[self.stretches()];
        let (slopes, second) = system.curvatures(end, &self.last);
        let (value, _) = system.slopes(end, &self.last);
        let slopes_at_end = (slopes.as_slice(), value);
        let (matrix, right) = self.conditions_at_ends([from, to], &chain, slopes_at_end);
        let unknown = Lu::new(matrix)?.solve(&right);
        let known: Vec<f64> = [1.0].into_iter().chain(unknown.iter().copied()).collect();
        let at = |rows: &Vec<Vec<f64>>| -> Vec<f64> {
            rows.iter().map(|row| dot(row, &known)).collect()
        };
        let nodes: Vec<Vec<f64>> = chain.iter().map(at).collect();
        let stages = stretches.iter().zip(&nodes).map(|(stretch, node)| {
            let known = [1.0].into_iter().chain(node.iter().copied());
            let known: Vec<f64> = known.chain([unknown[2 * m]]).collect();
            let changes = stretch.inner.iter().map(|row| dot(row, &known));
            changes.collect::<Vec<f64>>()
        });
        let stages = stages.collect();
        let controls: Vec<Vec<f64>> = second[2 * m..]
            .iter()
            .map(|r| r[2 * m..].to_vec())
            .collect();
        let end_change = &nodes[self.stretches()];
        let right: Vec<f64> = (2 * m..slopes.len())
            .map(|i| -slopes[i] - dot(&second[i][..2 * m], end_change))
            .collect();
        Some(Step {
            time: unknown[2 * m],
            last: Lu::new(controls)?.solve(&right),
            nodes,
            stages,
        })
    }

    /// The conditions at both ends, in the change of the first node and in the change of the time: rows and right sides. `chain` are the
    /// changes of each node, and the slopes and the value are those of Hamilton's function at the last one.
    fn conditions_at_ends(
        &self,
        [from, to]: [&[f64]; 2],
        chain: &[Vec<Vec<f64>>],
        (slopes, value): (&[f64], f64),
    ) -> (Vec<Vec<f64>>, Vec<f64>) {
        let n = from.len();
        let m = chain[0].len() / 2;
        let width = 2 * m + 2;
        let (start, end) = (&self.nodes[0], &self.nodes[self.stretches()]);
        let last = &chain[chain.len() - 1];
        let mut matrix = Vec::new();
        let mut right = Vec::new();
        let mut demand = |row: &[f64], change: f64| {
            matrix.push(row[1..].to_vec());
            right.push(change - row[0]);
        };
        let follows = self.level.as_ref().map(|level| level.follows);
        for i in 0..n {
            demand(&chain[0][i], from[i] - start[i]);
            if follows != Some(i) {
                demand(&last[i], to[i] - end[i]);
            }
        }
        demand(&chain[0][n], -start[n]);
        match &self.level {
            Some(level) => {
                demand(&last[n], -end[n]);
                let along: Vec<f64> = (0..width)
                    .map(|column| {
                        (0..n)
                            .map(|i| level.from[i] * chain[0][m + i][column])
                            .sum()
                    })
                    .collect();
                demand(&along, -dot(&level.from, &start[m..m + n]));
            }
            None => demand(&last[2 * m - 1], -end[2 * m - 1]),
        }
        let by_end: Vec<f64> = (0..width)
            .map(|column| (0..2 * m).map(|i| slopes[i] * last[i][column]).sum())
            .collect();
        demand(&by_end, 1.0 - value);
        (matrix, right)
    }

    /// The conditions on a stretch, solved for the changes at its points.
    fn stretch(&self, system: &impl Pontryagin, k: usize) -> Option<Stretch> {
        let h = 1.0 / self.stretches() as f64;
        linearized(
            system,
            &self.nodes[k],
            &self.stages[k],
            &self.nodes[k + 1],
            h,
            self.time,
        )
    }

    /// The derivative of the end of each stretch by its start at fixed duration: matrices by rows.
    pub fn transitions(&self, system: &impl Pontryagin) -> Option<Vec<Vec<Vec<f64>>>> {
        let wide = 2 * system.states();
        let rows = |stretch: Stretch| -> Vec<Vec<f64>> {
            let outer = stretch.outer.iter();
            outer.map(|row| row[1..=wide].to_vec()).collect()
        };
        (0..self.stretches())
            .map(|k| self.stretch(system, k).map(rows))
            .collect()
    }

    /// Linear extrapolation from another path through this one, by this fraction of the difference.
    pub fn beyond(&self, other: &Path, part: f64) -> Path {
        let ahead = |to: &[f64], from: &[f64]| -> Vec<f64> {
            let pairs = to.iter().zip(from);
            pairs.map(|(to, from)| to + part * (to - from)).collect()
        };
        let stages = self.stages.iter().zip(&other.stages).map(|(to, from)| {
            let pairs = to.iter().zip(from);
            let stages = pairs.map(|(to, from)| Stage {
                y: ahead(&to.y, &from.y),
                z: ahead(&to.z, &from.z),
            });
            stages.collect()
        });
        let nodes = self.nodes.iter().zip(&other.nodes);
        Path {
            level: self.level.clone(),
            time: self.time + part * (self.time - other.time),
            nodes: nodes.map(|(to, from)| ahead(to, from)).collect(),
            stages: stages.collect(),
            last: ahead(&self.last, &other.last),
        }
    }

    fn moved(&self, step: &Step, part: f64) -> Path {
        let added = |x: &[f64], change: &[f64]| -> Vec<f64> {
            x.iter().zip(change).map(|(x, d)| x + part * d).collect()
        };
        let nodes = self.nodes.iter().zip(&step.nodes);
        let stages = self.stages.iter().zip(&step.stages);
        Path {
            level: self.level.clone(),
            time: self.time + part * step.time,
            nodes: nodes.map(|(y, change)| added(y, change)).collect(),
            stages: stages
                .map(|(stages, change)| moved(stages, change, part))
                .collect(),
            last: added(&self.last, &step.last),
        }
    }

    /// The largest component of a step, relative to the scales.
    fn size(&self, step: &Step, scales: &[f64]) -> f64 {
        let nodes = step.nodes.iter().flat_map(|y| y.iter().zip(scales));
        let sizes = nodes.map(|(change, scale)| (change / scale).abs());
        let time = (step.time / self.time).abs();
        sizes.fold(
            time,
            |most, x| if x > most || x.is_nan() { x } else { most },
        )
    }
}

/// Changes of all unknowns of a path.
struct Step {
    time: f64,
    nodes: Vec<Vec<f64>>,
    stages: Vec<Vec<f64>>,
    last: Vec<f64>,
}

fn moved(stages: &[Stage], change: &[f64], part: f64) -> Vec<Stage> {
    let mut changes = change.iter();
    let mut added = |x: &[f64]| -> Vec<f64> {
        let pairs = x.iter().zip(changes.by_ref());
        pairs.map(|(x, d)| x + part * d).collect()
    };
    let mut moved = Vec::new();
    for stage in stages {
        let y = added(&stage.y);
        let z = added(&stage.z);
        moved.push(Stage { y, z });
    }
    moved
}

/// The composition of two linear maps, each with rows `constant, by y, by T`.
fn composed(after: &[Vec<f64>], before: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (count, width) = (before.len(), before[0].len());
    let row = |row: &Vec<f64>| {
        let entry = |column: usize| {
            let sum: f64 = (0..count).map(|i| row[1 + i] * before[i][column]).sum();
            match column {
                0 => row[0] + sum,
                _ if column + 1 == width => row[1 + count] + sum,
                _ => sum,
            }
        };
        (0..width).map(entry).collect()
    };
    after.iter().map(row).collect()
}

/// The linearized conditions on a stretch of length `h T`.
fn linearized(
    system: &impl Pontryagin,
    start: &[f64],
    stages: &[Stage],
    end: &[f64],
    h: f64,
    time: f64,
) -> Option<Stretch> {
    let (m, c) = (system.states(), system.controls());
    let (rule, wide) = (Rule::new(), 2 * m + c);
    let size = POINTS * wide;
    let curvatures: Vec<(Vec<f64>, Vec<Vec<f64>>)> = stages
        .iter()
        .map(|stage| system.curvatures(&stage.y, &stage.z))
        .collect();
    let rate: Vec<Vec<f64>> = curvatures
        .iter()
        .map(|(s, _)| rates(s, m, |x| -x))
        .collect();
    let turn = |row: &Vec<f64>| row.iter().map(|x| -x).collect::<Vec<f64>>();
    let by: Vec<Vec<Vec<f64>>> = curvatures.iter().map(|(_, s)| rates(s, m, turn)).collect();
    let mut matrix = std::vec![std::vec![0.0; size]; size];
    let mut right = std::vec![std::vec![0.0; 2 * m + 2]; size];
    for (j, stage) in stages.iter().enumerate() {
        for i in 0..2 * m {
            let row = j * wide + i;
            matrix[row][row] = 1.0;
            let mut ahead = 0.0;
            for l in 0..POINTS {
                let weight = h * rule.upto[j][l];
                ahead += weight * rate[l][i];
                for column in 0..wide {
                    matrix[row][l * wide + column] -= time * weight * by[l][i][column];
                }
            }
            right[row][0] = start[i] + time * ahead - stage.y[i];
            right[row][1 + i] = 1.0;
            right[row][2 * m + 1] = ahead;
        }
        for i in 0..c {
            let row = j * wide + 2 * m + i;
            matrix[row][j * wide..(j + 1) * wide].copy_from_slice(&curvatures[j].1[2 * m + i]);
            right[row][0] = -curvatures[j].0[2 * m + i];
        }
    }
    let factors = Lu::new(matrix)?;
    let mut inner = std::vec![std::vec![0.0; 2 * m + 2]; size];
    for column in 0..2 * m + 2 {
        let side: Vec<f64> = right.iter().map(|row| row[column]).collect();
        for (row, x) in inner.iter_mut().zip(factors.solve(&side)) {
            row[column] = x;
        }
    }
    let outer = (0..2 * m).map(|i| {
        let mut row = std::vec![0.0; 2 * m + 2];
        row[0] = start[i] - end[i];
        row[1 + i] = 1.0;
        for l in 0..POINTS {
            let weight = h * rule.whole[l];
            row[0] += time * weight * rate[l][i];
            row[2 * m + 1] += weight * rate[l][i];
            for column in 0..wide {
                let slope = time * weight * by[l][i][column];
                for (x, change) in row.iter_mut().zip(&inner[l * wide + column]) {
                    *x += slope * change;
                }
            }
        }
        row
    });
    let outer = outer.collect();
    Some(Stretch { inner, outer })
}

/// Integrates one stretch of length `time` from a known start, by Newton's method from a guess of its points;
/// returns the end.
pub fn advanced(
    system: &impl Pontryagin,
    start: &[f64],
    mut stages: Vec<Stage>,
    time: f64,
) -> Vec<f64> {
    let m = system.states();
    let mut end = start.to_vec();
    // Convergence is quadratic, and the guess has five digits.
    for _ in 0..3 {
        let Some(stretch) = linearized(system, start, &stages, &end, 1.0, time) else {
            break;
        };
        let change: Vec<f64> = stretch.inner.iter().map(|row| row[0]).collect();
        stages = moved(&stages, &change, 1.0);
        for (y, row) in end.iter_mut().zip(&stretch.outer) {
            *y += row[0];
        }
    }
    debug_assert_eq!(end.len(), 2 * m);
    end
}
