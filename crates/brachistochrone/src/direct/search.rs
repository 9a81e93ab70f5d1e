//! The search for the fastest motion: several starts, each improved as a polygon, then as a smooth motion.

use std::cmp::Ordering;

use lagrangian_scalar::Dual;

use super::budget::{Budget, Counted};
use super::collocation::{Level, Path};
use super::continuation::continue_path;
use super::descent::{Descent, Polygon, Stop, Traversal};
use super::frozen::frozen;
use super::hamiltonian::Driven;
use super::motion::Sought;
use super::ways::{PIECES, guessed, initial_paths};
use super::{SKEW, Terrain, between, rows, symmetric};
use crate::error::Unsolved;
use crate::linear::{Cholesky, Matrix, dot};
use crate::trial::{Outcome, Start, Trial};

/// The duration has converged when halving changes it by less than this fraction; at order 8 it is then accurate to
/// the last digits.
const SETTLED: f64 = 1e-12;

/// Numbers of pieces of a polygon and of the stretches of the smooth motion made from it, the cheapest first.
const LEVELS: [[usize; 2]; 3] = [[16, 8], [32, 16], [64, 32]];

/// The most stretches.
const STRETCHES: usize = 256;

/// The relative difference between the durations of a polygon and its smooth motion: 16 pieces are accurate to
/// about a thousandth.
const NEAR: f64 = 0.03;

/// Paths closer to each other than this fraction of their length are the same: smooth ones, and polygons.
const SAME: [f64; 2] = [1e-5, 0.03];

/// The default budget, in numbers with which inertia or resistance is evaluated: some seconds for an interpreted machine,
/// a fraction of a second for a compiled one.
const BUDGET: u64 = 4_000_000;

/// Settings of a search for the fastest motion.
#[derive(Clone, Debug)]
pub struct Search {
    guesses: Vec<Vec<Vec<f64>>>,
    stretches: Option<usize>,
    budget: u64,
}

impl Default for Search {
    fn default() -> Self {
        Search {
            guesses: Vec::new(),
            stretches: None,
            budget: BUDGET,
        }
    }
}

/// The polygon to which a start led.
struct Candidate {
    trial: usize,
    polygon: Polygon,
    traversal: Traversal,
}

/// A smooth motion, with the last change of its duration.
struct Smooth {
    trial: usize,
    path: Path,
    change: f64,
}

impl Search {
    /// The default search: from the straight path and paths on either side of it, with a budget of some seconds.
    pub fn new() -> Search {
        Search::default()
    }

    /// Adds a start: a path through these places, at least two. Its ends are moved to the ends of the problem, so a
    /// solution for nearby ends may be used.
    pub fn guess(mut self, places: Vec<Vec<f64>>) -> Search {
        self.guesses.push(places);
        self
    }

    /// Uses this many equal time stretches instead of as many as convergence needs, for studies of the error.
    pub fn stretches(mut self, stretches: usize) -> Search {
        self.stretches = Some(stretches.max(1));
        self
    }

    /// Sets the budget, in evaluations of [`Terrain::inertia`] and [`Terrain::resistance`], each counted once for every real
    /// component of the number type; the continuation from the machine without friction may use as much again. Work that has
    /// started is finished, so the budget may be exceeded somewhat. The default is 4 million.
    pub fn budget(mut self, evaluations: u64) -> Search {
        self.budget = evaluations;
        self
    }

    /// The fastest motion of a machine from rest at one position to another: the fastest of those to which the starts lead.
    ///
    /// # Errors
    /// Why there is no fastest motion, or none was found; see [`Unsolved`].
    pub fn solve<T: Terrain>(
        &self,
        terrain: T,
        from: &[f64],
        to: &[f64],
    ) -> Result<Sought<T>, Unsolved> {
        self.refuse_lists(terrain.coordinates(), from, to)?;
        let frame = frame(&terrain, from)?;
        let skew = skew(&terrain, from, to);
        refuse_loops(from.len(), skew)?;
        let smooth = terrain.with_friction(0.0);
        let smooth = smooth.filter(|smooth| differs(&terrain, smooth, from, to));
        let budget = Budget::new(self.budget);
        let counted = Counted::new(&terrain, &budget);
        let starts = self.starts(&counted, from, to);
        let rise = rise(&terrain, from, to);
        let falls = is_potential(&terrain, &starts);
        // With a potential the end must be below the start; no path changes that. Ends count as level within round-off.
        let looks = rise.work <= 1e-9 * rise.size || !falls || skew.1 > SKEW;
        let is_level = rise.work.abs() <= 1e-9 * rise.size.max(drop(&terrain, &starts));
        let level = if is_level && skew.1 <= SKEW && conserves(&terrain, &starts) {
            level(&terrain, from, to)
        } else {
            None
        };
        let hunt = SearchState {
            system: Driven::new(counted.clone(), frame.clone()),
            descent: Descent::new(counted, skew.1 > SKEW, level.is_some()),
            budget: &budget,
            ends: [from, to],
            level,
            stretches: self.stretches,
        };
        let mut tried = Vec::new();
        let motions = if looks {
            let mut motions = hunt.continue_from(starts, &mut tried);
            if let Some(smooth) = smooth.filter(|_| may_be_improved(&motions, &tried)) {
                budget.allow(budget.spent() + self.budget);
                let smooth = Counted::new(&smooth, &budget);
                let starts = self.starts(&smooth, from, to);
                let without = SearchState {
                    system: Driven::new(smooth.clone(), frame.clone()),
                    descent: Descent::new(smooth, false, false),
                    level: None,
                    ..hunt
                };
                hunt.add_motions_with_friction(&without, starts, &mut motions, &mut tried);
            }
            // Closed forms have no finite multipliers if the ends are level.
            if motions.is_empty() && hunt.level.is_none() {
                let (outcome, smooth) = hunt.continued_from_frozen(tried.len());
                tried.push(Trial {
                    start: Start::Frozen,
                    outcome,
                });
                motions.extend(smooth);
            }
            fastest(motions)
        } else {
            None
        };
        let Some(Smooth { path, change, .. }) = motions else {
            return Err(if falls && rise.work >= 0.0 {
                Unsolved::NotBelow { rise: rise.work }
            } else {
                Unsolved::NotFound { tried }
            });
        };
        let ends = [from.to_vec(), to.to_vec()];
        Ok(Sought {
            system: Driven::new(terrain, frame),
            path,
            change,
            ends,
            tried,
            evaluations: budget.spent(),
        })
    }

    /// The guesses, the straight path, and paths beside it.
    fn starts(&self, terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Vec<(Start, Polygon)> {
        let guesses = self.guesses.iter();
        let guesses = guesses.map(|places| (Start::Guess, guessed(terrain, places, from, to)));
        guesses.chain(initial_paths(terrain, from, to)).collect()
    }

    fn refuse_lists(&self, n: usize, from: &[f64], to: &[f64]) -> Result<(), Unsolved> {
        let places = self.guesses.iter().flatten().map(|place| place.as_slice());
        let places = places.map(|place| ("a position of the guess", place));
        let ends = [("the start", from), ("the end", to)];
        for (what, list) in ends.into_iter().chain(places) {
            let length = list.len();
            if length != n || n == 0 {
                let expected = n.max(1);
                return Err(Unsolved::Size {
                    list: what,
                    expected,
                    found: length,
                });
            }
            if !list.iter().all(|x| x.is_finite()) {
                return Err(Unsolved::NotFinite { list: what });
            }
        }
        if let Some(short) = self.guesses.iter().find(|places| places.len() < 2) {
            return Err(Unsolved::Size {
                list: "the guess",
                expected: 2,
                found: short.len(),
            });
        }
        if from == to {
            Err(Unsolved::SameEnds)
        } else {
            Ok(())
        }
    }
}

/// The state of a search.
struct SearchState<'a, T> {
    system: Driven<Counted<'a, T>>,
    descent: Descent<'a, T>,
    budget: &'a Budget,
    ends: [&'a [f64]; 2],
    /// Present where the end is level with the start and there are no losses.
    level: Option<Level>,
    stretches: Option<usize>,
}

impl<T: Terrain> SearchState<'_, T> {
    /// Adds the motions to which these starts lead.
    fn continue_from(&self, starts: Vec<(Start, Polygon)>, tried: &mut Vec<Trial>) -> Vec<Smooth> {
        let mut motions: Vec<Smooth> = Vec::new();
        for candidate in self.candidates(starts, tried) {
            let trial = candidate.trial;
            let (outcome, smooth) = self.smoothed(candidate, &motions);
            tried[trial].outcome = outcome;
            motions.extend(smooth);
        }
        motions
    }

    /// Adds the motions found by continuation in friction, from those of the machine without friction.
    fn add_motions_with_friction(
        &self,
        without: &Self,
        starts: Vec<(Start, Polygon)>,
        found: &mut Vec<Smooth>,
        tried: &mut Vec<Trial>,
    ) {
        let mut ignored = Vec::new();
        let mut none = true;
        for candidate in without.candidates(starts, &mut ignored) {
            let Ok((_, path)) = without.corrected(candidate) else {
                continue;
            };
            none = false;
            let trial = tried.len();
            let time = Some(path.time);
            let (outcome, smooth) = self.continued_in_friction(trial, path, found);
            tried.push(Trial {
                start: Start::Frictionless { time },
                outcome,
            });
            found.extend(smooth);
        }
        if none {
            let outcome = if self.budget.is_spent() {
                Outcome::Unfinished
            } else {
                Outcome::Nothing
            };
            tried.push(Trial {
                start: Start::Frictionless { time: None },
                outcome,
            });
        }
    }

    /// The motion of the machine itself, continued from one of the machine without friction.
    fn continued_in_friction(
        &self,
        trial: usize,
        path: Path,
        known: &[Smooth],
    ) -> (Outcome, Option<Smooth>) {
        let [from, to] = self.ends;
        let corrected = |path: Path, share: f64| {
            let machine = self.system.terrain.uncounted().with_friction(share)?;
            let system = self.system.of(Counted::new(&machine, self.budget));
            path.nearly_corrected(&system, from, to, self.budget)
        };
        let (path, part) = continue_path(path, corrected, self.budget);
        let exact = |path: Path| path.corrected(&self.system, from, to, self.budget);
        match (path.and_then(exact), part) {
            (Some(path), _) => self.classified(trial, path, known),
            (None, _) if self.budget.is_spent() => (Outcome::Unfinished, None),
            (None, part) => (Outcome::Lost { part }, None),
        }
    }

    /// Distinct polygons of locally least time, the fastest first; every start is recorded as a trial.
    fn candidates(&self, starts: Vec<(Start, Polygon)>, tried: &mut Vec<Trial>) -> Vec<Candidate> {
        let mut candidates: Vec<Candidate> = Vec::new();
        for (start, mut polygon) in starts {
            let trial = tried.len();
            let made_traversable = self.descent.made_traversable(&mut polygon);
            let traversed = made_traversable.and_then(|_| self.descent.fastest(&mut polygon));
            let outcome = match traversed {
                Ok(traversal) => {
                    let same = candidates.iter().find(|known| {
                        let far =
                            distance(&self.system.terrain, &known.polygon.places, &polygon.places);
                        far < SAME[1]
                            && (known.traversal.time() / traversal.time() - 1.0).abs() < NEAR
                    });
                    match same {
                        Some(known) => Outcome::Same { trial: known.trial },
                        None => {
                            candidates.push(Candidate {
                                trial,
                                polygon,
                                traversal,
                            });
                            Outcome::Unfinished
                        }
                    }
                }
                Err(Stop::Lacks(energy)) => Outcome::Lacks { energy },
                Err(Stop::Spent) => Outcome::Unfinished,
            };
            tried.push(Trial { start, outcome });
        }
        candidates.sort_by(|a, b| a.traversal.time().total_cmp(&b.traversal.time()));
        candidates
    }

    /// The smooth motion near a polygon.
    fn smoothed(&self, candidate: Candidate, known: &[Smooth]) -> (Outcome, Option<Smooth>) {
        match self.corrected(candidate) {
            Ok((trial, path)) => self.classified(trial, path, known),
            Err(outcome) => (outcome, None),
        }
    }

    /// The smooth path near a polygon, on a few stretches, with the index of its trial; or the outcome if there is none.
    fn corrected(&self, candidate: Candidate) -> Result<(usize, Path), Outcome> {
        let Candidate {
            trial,
            mut polygon,
            mut traversal,
        } = candidate;
        for [pieces, stretches] in LEVELS {
            while polygon.places.len() <= pieces {
                polygon = polygon.halved();
                // An obstacle that long pieces skipped may block shorter ones.
                let made_traversable = self.descent.made_traversable(&mut polygon);
                match made_traversable.and_then(|_| self.descent.fastest(&mut polygon)) {
                    Ok(finer) => traversal = finer,
                    Err(Stop::Lacks(energy)) => return Err(Outcome::Lacks { energy }),
                    Err(Stop::Spent) => return Err(Outcome::Unfinished),
                }
            }
            let stretches = self.stretches.unwrap_or(stretches);
            let [from, to] = self.ends;
            let path = Path::along(
                &self.system,
                &polygon,
                &traversal,
                (stretches, self.level.clone()),
            );
            let path = path.and_then(|path| path.corrected(&self.system, from, to, self.budget));
            // Newton's method may have converged to another path.
            let near = |path: &Path| (path.time / traversal.time() - 1.0).abs() < NEAR;
            if let Some(path) = path.filter(near) {
                return Ok((trial, path));
            }
            if self.budget.is_spent() {
                return Err(Outcome::Unfinished);
            }
        }
        Err(Outcome::NotSmooth {
            time: traversal.time(),
        })
    }

    /// The path with converged duration, if it is new and a local minimum.
    fn classified(&self, trial: usize, path: Path, known: &[Smooth]) -> (Outcome, Option<Smooth>) {
        let Some((path, change)) = self.refine(path) else {
            return (Outcome::Unfinished, None);
        };
        let same = known.iter().find(|known| {
            let [one, other] = [&known.path, &path].map(|path| path.places(PIECES));
            distance(&self.system.terrain, &one, &other) < SAME[0]
        });
        if let Some(known) = same {
            return (Outcome::Same { trial: known.trial }, None);
        }
        let time = path.time;
        let sought = Sought {
            system: self.system.clone(),
            path,
            change,
            ends: self.ends.map(<[f64]>::to_vec),
            tried: Vec::new(),
            evaluations: 0,
        };
        match sought.refused() {
            Some(since) => (Outcome::NotLeast { time, since }, None),
            None => {
                let path = sought.path;
                let smooth = Smooth {
                    trial,
                    path,
                    change,
                };
                (Outcome::Found { time }, Some(smooth))
            }
        }
    }

    /// Halves the stretches until the duration converges, or the budget is exhausted; returns the path with the
    /// last change of duration, in s.
    fn refine(&self, mut path: Path) -> Option<(Path, f64)> {
        let mut change = f64::INFINITY;
        let most = self.stretches.unwrap_or(STRETCHES);
        let [from, to] = self.ends;
        while path.stretches() < most {
            let finer = path.halved().corrected(&self.system, from, to, self.budget);
            let Some(finer) = finer else {
                break;
            };
            let before = change;
            change = (finer.time - path.time).abs();
            path = finer;
            // Otherwise round-off is reached, and halving improves nothing.
            if change <= SETTLED * path.time || (change >= before && change <= 1e-10 * path.time) {
                break;
            }
        }
        (self.stretches.is_some() || change <= 1e-6 * path.time).then_some((path, change))
    }

    /// A motion from the closed forms of frozen machines.
    fn continued_from_frozen(&self, trial: usize) -> (Outcome, Option<Smooth>) {
        let [from, to] = self.ends;
        let mut reached = 0.0_f64;
        let terrain = &self.system.terrain;
        for frozen in frozen(terrain, from, to) {
            if self.budget.is_spent() {
                return (Outcome::Unfinished, None);
            }
            let system = |part| self.system.of(frozen.towards(terrain, part));
            let motion = frozen.problem.solve(from, to).ok();
            let stretches = self.stretches.unwrap_or(LEVELS[0][1]);
            let start = motion.and_then(|motion| Path::guess(&system(0.0), &motion, stretches));
            let Some(start) = start else {
                continue;
            };
            let corrected =
                |path: Path, part: f64| path.nearly_corrected(&system(part), from, to, self.budget);
            let (path, part) = continue_path(start, corrected, self.budget);
            reached = reached.max(part);
            let exact = |path: Path| path.corrected(&self.system, from, to, self.budget);
            if let Some(path) = path.and_then(exact) {
                return self.classified(trial, path, &[]);
            }
        }
        (Outcome::Lost { part: reached }, None)
    }
}

/// Among equally fast ones, as mirror images are, the first.
fn fastest(found: Vec<Smooth>) -> Option<Smooth> {
    let by_time = |a: &Smooth, b: &Smooth| a.path.time.total_cmp(&b.path.time);
    found
        .into_iter()
        .reduce(|best, next| match by_time(&next, &best) {
            Ordering::Less => next,
            _ => best,
        })
}

/// Whether nothing was found, or a trial may lead to a faster motion than those found.
fn may_be_improved(found: &[Smooth], tried: &[Trial]) -> bool {
    let best = found.iter().map(|smooth| smooth.path.time);
    let best = best.fold(f64::INFINITY, f64::min);
    found.is_empty()
        || tried
            .iter()
            .any(|trial| trial.shorter_duration_of_unfinished(best).is_some())
}

/// Whether two machines differ anywhere on the straight path, at rest.
fn differs<T: Terrain>(one: &T, other: &T, from: &[f64], to: &[f64]) -> bool {
    let rest = std::vec![0.0; from.len()];
    [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().any(|part| {
        let q = between(from, to, part);
        one.inertia(&q) != other.inertia(&q)
            || one.resistance(&q, &rest) != other.resistance(&q, &rest)
    })
}

/// The greatest distance between corresponding corners of two paths, in the metric at the middle, relative to the length.
fn distance(terrain: &impl Terrain, one: &[Vec<f64>], other: &[Vec<f64>]) -> f64 {
    let n = one[0].len();
    let metric = symmetric(terrain.inertia(&one[one.len() / 2]), n);
    let apart = |x: &[f64], y: &[f64]| -> f64 {
        let d: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
        let square: f64 = metric
            .chunks(n)
            .zip(&d)
            .map(|(row, x)| x * dot(row, &d))
            .sum();
        square.max(0.0).sqrt()
    };
    let total: f64 = one.windows(2).map(|pair| apart(&pair[0], &pair[1])).sum();
    let pairs = one.iter().zip(other);
    pairs.map(|(x, y)| apart(x, y)).fold(0.0, f64::max) / total
}

/// Columns orthonormal in the metric `sym A` of the start, which define the frame of directions.
fn frame(terrain: &impl Terrain, from: &[f64]) -> Result<Matrix, Unsolved> {
    let n = from.len();
    let even = rows(&symmetric(terrain.inertia(from), n), n);
    let factor = Cholesky::new(&even)
        .map_err(|(coordinate, ratio)| Unsolved::FrictionOutweighsInertia { coordinate, ratio })?;
    // Columns of L⁻ᵀ: solutions of Lᵀ f = e.
    Ok((0..n)
        .map(|k| {
            let mut unit = std::vec![0.0; n];
            unit[k] = 1.0;
            factor.solve_upper(&unit)
        })
        .collect())
}

/// The two coordinates for which the skew part of `A` is greatest on the straight path, and its size relative to
/// the inertia of both.
fn skew(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> ([usize; 2], f64) {
    let n = from.len();
    let mut most = ([0, 0], 0.0_f64);
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let inertia = terrain.inertia(&between(from, to, part));
        for i in 0..n {
            for j in 0..i {
                let skew = 0.5 * (inertia[i * n + j] - inertia[j * n + i]).abs();
                let skew = skew / (inertia[i * n + i] * inertia[j * n + j]).abs().sqrt();
                if skew > most.1 {
                    most = ([j, i], skew);
                }
            }
        }
    }
    most
}

/// With three coordinates or more there is no fastest motion if friction makes `A` skew.
fn refuse_loops(n: usize, (coordinates, skew): ([usize; 2], f64)) -> Result<(), Unsolved> {
    if n > 2 && skew > SKEW {
        Err(Unsolved::LoopsFeed { coordinates, skew })
    } else {
        Ok(())
    }
}

/// The work against all resistance at rest, in J.
struct ResistanceWork {
    work: f64,
    /// The sum of the absolute values of its terms.
    size: f64,
}

/// The work along the straight path.
fn rise(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> ResistanceWork {
    let polygon: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    let rest = std::vec![0.0; from.len()];
    let steps = 64;
    let mut rise = ResistanceWork {
        work: 0.0,
        size: 0.0,
    };
    // The two-point Gauss rule makes the work accurate to the last digits.
    for k in 0..steps {
        for z in [-1.0, 1.0] {
            let part = (f64::from(k) + 0.5 + 0.5 * z / 3.0_f64.sqrt()) / f64::from(steps);
            let force = terrain.resistance(&between(from, to, part), &rest);
            let work = 0.5 * dot(&force, &polygon) / f64::from(steps);
            rise.work += work;
            rise.size += work.abs();
        }
    }
    rise
}

/// How far the lowest of the corners is below the start, in J: the scale by which levels are compared.
fn drop(terrain: &impl Terrain, ways: &[(Start, Polygon)]) -> f64 {
    let ends = ways
        .iter()
        .flat_map(|(_, polygon)| polygon.places.split_first());
    let depths = ends.flat_map(|(start, others)| {
        let middle = others.get(others.len() / 2);
        middle.map(|place| rise(terrain, start, place).work.abs())
    });
    depths.fold(0.0, f64::max)
}

/// The extra conditions of a motion from rest to rest; `None` where no force acts at one of the ends.
fn level(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Option<Level> {
    let rest = std::vec![0.0; from.len()];
    let [from, to] = [from, to].map(|q| terrain.resistance(q, &rest));
    let drives = |force: &[f64]| force.iter().any(|f| *f != 0.0);
    let by_size = |i: &usize, j: &usize| to[*i].abs().total_cmp(&to[*j].abs());
    let follows = (0..to.len()).max_by(by_size)?;
    (drives(&from) && drives(&to)).then_some(Level { from, follows })
}

/// Whether the machine is conservative along these paths: there is a potential, and in motion
/// `v·R(q, v) = v·R(q, 0) + ½ v·∂A[v] v` for both directions of v.
fn conserves(terrain: &impl Terrain, ways: &[(Start, Polygon)]) -> bool {
    ways.iter().all(|(_, polygon)| {
        let places = polygon.places.iter().step_by(3);
        places
            .into_iter()
            .all(|q| is_passive(terrain, q) && !is_dissipative(terrain, q))
    })
}

/// Whether motion dissipates energy at a position.
fn is_dissipative(terrain: &impl Terrain, q: &[f64]) -> bool {
    let gains = excess_power(terrain, q);
    gains.iter().any(|[gain, size]| *gain < -1e-9 * size)
}

/// Whether forces at rest have a potential, and velocity-dependent forces supply no energy, everywhere on these paths.
fn is_potential(terrain: &impl Terrain, ways: &[(Start, Polygon)]) -> bool {
    ways.iter().all(|(_, polygon)| {
        let places = polygon.places.iter().step_by(3);
        places.into_iter().all(|q| is_passive(terrain, q))
    })
}

/// At one position: the force at rest is free of curl, and in motion `v·R(q, v) ≥ v·R(q, 0) + ½ v·∂A[v] v`.
fn is_passive(terrain: &impl Terrain, q: &[f64]) -> bool {
    let n = q.len();
    let still = std::vec![Dual::constant(0.0); n];
    let unit = |i: usize| {
        let mut unit = std::vec![0.0; n];
        unit[i] = 1.0;
        unit
    };
    let slopes: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let force = terrain.resistance(&dual(q, &unit(i)), &still);
            force.iter().map(|f| f.derivative).collect()
        })
        .collect();
    let size = slopes
        .iter()
        .flatten()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    let curls = (0..n * n).any(|k| {
        let [one, other] = [slopes[k / n][k % n], slopes[k % n][k / n]];
        (one - other).abs() > 1e-9 * size
    });
    let feeds = excess_power(terrain, q)
        .iter()
        .any(|[gain, size]| *gain > 1e-9 * size);
    !curls && !feeds
}

/// `v·R(q, 0) + ½ v·∂A[v] v − v·R(q, v)` for velocities along each coordinate in both directions, and the
/// size of its terms.
fn excess_power(terrain: &impl Terrain, q: &[f64]) -> Vec<[f64; 2]> {
    let n = q.len();
    let gain = |k: usize| {
        let mut v = std::vec![0.0; n];
        v[k / 2] = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let [moving, rest] =
            [v.clone(), std::vec![0.0; n]].map(|rate| dot(&terrain.resistance(q, &rate), &v));
        let inertia = terrain.inertia(&dual(q, &v));
        let bent: f64 = (0..n * n)
            .map(|e| inertia[e].derivative * v[e / n] * v[e % n])
            .sum();
        let gain = rest + 0.5 * bent - moving;
        [gain, rest.abs() + bent.abs() + moving.abs()]
    };
    (0..2 * n).map(gain).collect()
}

/// A position as dual numbers whose derivatives are this velocity.
fn dual(q: &[f64], v: &[f64]) -> Vec<Dual<f64>> {
    let pairs = q.iter().zip(v);
    pairs
        .map(|(value, derivative)| Dual {
            value: *value,
            derivative: *derivative,
        })
        .collect()
}
