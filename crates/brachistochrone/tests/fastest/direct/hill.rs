//! A particle on a smooth surface with a hill in its way; the reference is a family of rays from the start.

use lagrangian_brachistochrone::Unsolved;
use lagrangian_brachistochrone::direct::{Outcome, Search, Sought, Start, Terrain};
use lagrangian_scalar::Scalar;

use crate::terrains::{Any, solve};

const G: f64 = 9.81;

/// A particle of 1 kg at `(x, y, z)` with `z = h exp(−(x² + k y²)/w²) − s x`. The start, at (−1, 0), is lower than the top.
#[derive(Clone, Debug)]
pub struct Hill {
    height: f64,
    width: f64,
    slope: f64,
    /// With 0 the hill is an endless ridge.
    round: f64,
}

const HILL: Hill = Hill {
    height: 0.6,
    width: 0.5,
    slope: 0.5,
    round: 1.0,
};

const FROM: [f64; 2] = [-1.0, 0.0];

impl Hill {
    /// `z`, its slopes, and `z_xx, z_xy, z_yy`.
    fn surface<N: Scalar>(&self, q: &[N]) -> (N, [N; 2], [N; 3]) {
        let number = N::from_f64;
        let [x, y] = [q[0], q[1]];
        let k = number(self.round);
        let b = number(1.0 / (self.width * self.width));
        let top = number(self.height) * (-(b * (x * x + k * y * y))).exp();
        let two = number(2.0);
        // ∂ ln top
        let [ahead, aside] = [-(two * b * x), -(two * b * k * y)];
        let slope = number(self.slope);
        let slopes = [top * ahead - slope, top * aside];
        let bends = [
            top * (ahead * ahead - two * b),
            top * ahead * aside,
            top * (aside * aside - two * b * k),
        ];
        (top - slope * x, slopes, bends)
    }
}

impl Terrain for Hill {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let (_, [a, b], _) = self.surface(q);
        vec![N::ONE + a * a, a * b, a * b, N::ONE + b * b]
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let (_, slopes, [xx, xy, yy]) = self.surface(q);
        let two = N::from_f64(2.0);
        let lift = xx * v[0] * v[0] + two * xy * v[0] * v[1] + yy * v[1] * v[1];
        let up = lift + N::from_f64(G);
        slopes.map(|slope| slope * up).to_vec()
    }
}

/// Rays of the fastest motion. By Snell's law in every tangent plane, the force across the path is reversed: with the acceleration `a` of a
/// particle that moves freely on the surface and the unit tangent t, the acceleration along the surface is `2 t (t·a) − a`. All rays start
/// from rest along `a`, each with its own change j of the acceleration across it.
struct Rays {
    hill: Hill,
    /// For each j, j itself and the points at equal times.
    all: Vec<(f64, Vec<[f64; 2]>)>,
}

/// The duration of the rays in s, the number of steps, and the number of steps between kept points; rays that must
/// hit a point take `STEPS` steps.
const LONG: f64 = 2.0;
const COARSE: usize = 400;
const KEPT: usize = 4;
const STEPS: usize = 2000;

impl Rays {
    fn new(hill: &Hill) -> Rays {
        let rays = 1501;
        let ray = |k: usize| {
            let angle = std::f64::consts::PI * (k as f64 + 0.5) / rays as f64;
            let j = -20.0 / angle.tan();
            let points = trace(hill, j, LONG, COARSE);
            (j, points.into_iter().step_by(KEPT).collect())
        };
        Rays {
            hill: hill.clone(),
            all: (0..rays).map(ray).collect(),
        }
    }

    /// The times of all rays through a point, in ascending order.
    fn through(&self, to: [f64; 2]) -> Vec<f64> {
        let miss = |i: usize, k: usize| {
            let q = self.all[i].1[k];
            (q[0] - to[0]).hypot(q[1] - to[1])
        };
        let [rays, count] = [self.all.len(), self.all[0].1.len()];
        let mut times: Vec<f64> = Vec::new();
        for i in 1..rays - 1 {
            for k in 1..count - 1 {
                let here = miss(i, k);
                let beside = (0..9).map(|n| miss(i + n / 3 - 1, k + n % 3 - 1));
                if here > 0.3 || beside.into_iter().any(|there| there < here) {
                    continue;
                }
                let t = LONG * k as f64 / (count - 1) as f64;
                let Some(t) = self.hit(to, self.all[i].0, t) else {
                    continue;
                };
                if times.iter().all(|known| (known - t).abs() > 1e-5) {
                    times.push(t);
                }
            }
        }
        times.sort_by(f64::total_cmp);
        times
    }

    /// Newton's method for j and the time.
    fn hit(&self, to: [f64; 2], mut j: f64, mut t: f64) -> Option<f64> {
        let end = |j: f64, t: f64| trace(&self.hill, j, t, STEPS)[STEPS];
        for _ in 0..20 {
            let q = end(j, t);
            let [dj, dt] = [1e-5 * (1.0 + j.abs()), 1e-6];
            let slopes = [(j + dj, t, dj), (j, t + dt, dt)].map(|(j, t, d)| {
                let there = end(j, t);
                [(there[0] - q[0]) / d, (there[1] - q[1]) / d]
            });
            let miss = [to[0] - q[0], to[1] - q[1]];
            let det = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
            let step = [
                (miss[0] * slopes[1][1] - miss[1] * slopes[1][0]) / det,
                (slopes[0][0] * miss[1] - slopes[0][1] * miss[0]) / det,
            ];
            j += step[0];
            t += step[1];
            if !(t > 0.1 && t < 1.5 * LONG && j.is_finite()) {
                return None;
            }
            if step[1].abs() < 1e-9 && miss[0].hypot(miss[1]) < 1e-8 {
                return Some(t);
            }
        }
        None
    }
}

/// Positions at equal times on the ray with this j, by the classical Runge–Kutta method.
fn trace(hill: &Hill, j: f64, until: f64, steps: usize) -> Vec<[f64; 2]> {
    let free = |q: [f64; 2]| {
        // a = −S⁻¹ g ∇z, and S⁻¹ ∇z = ∇z/(1 + |∇z|²).
        let (_, [a, b], _) = hill.surface(&q);
        let by = -G / (1.0 + a * a + b * b);
        [by * a, by * b]
    };
    let rate = |[x, y, u, w]: [f64; 4]| {
        let (_, [a, b], [xx, xy, yy]) = hill.surface(&[x, y]);
        let metric = |p: [f64; 2], r: [f64; 2]| {
            p[0] * r[0] + p[1] * r[1] + (a * p[0] + b * p[1]) * (a * r[0] + b * r[1])
        };
        let force = free([x, y]);
        let v = [u, w];
        let part = 2.0 * metric(v, force) / metric(v, v);
        // The term of the Christoffel symbols: ∇z (v·z″ v)/(1 + |∇z|²).
        let lift = (xx * u * u + 2.0 * xy * u * w + yy * w * w) / (1.0 + a * a + b * b);
        [
            u,
            w,
            part * u - force[0] - lift * a,
            part * w - force[1] - lift * b,
        ]
    };
    // At the start ∂z/∂y is 0 and y is the direction across; the series is accurate to the fourth power of the first step.
    let h = until / steps as f64;
    let force = free(FROM);
    let mut state = [
        FROM[0] + 0.5 * force[0] * h * h,
        FROM[1] + j * h * h * h / 6.0,
        force[0] * h,
        0.5 * j * h * h,
    ];
    let mut points = vec![FROM, [state[0], state[1]]];
    for _ in 1..steps {
        let moved = |by: [f64; 4], part: f64| {
            let mut next = state;
            next.iter_mut()
                .zip(by)
                .for_each(|(x, d)| *x += part * h * d);
            next
        };
        let k1 = rate(state);
        let k2 = rate(moved(k1, 0.5));
        let k3 = rate(moved(k2, 0.5));
        let k4 = rate(moved(k3, 1.0));
        for i in 0..4 {
            state[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
        points.push([state[0], state[1]]);
    }
    points
}

#[track_caller]
fn found(to: [f64; 2]) -> Sought<Any> {
    solve(HILL, &FROM, &to).unwrap_or_else(|error| panic!("{to:?}: {error}"))
}

/// The search reaches every end behind the hill, beside it and on its slope. Its motion is the fastest of all rays through the end, and the
/// other motions that it finds are rays, too.
#[test]
fn every_end_about_a_hill_is_reached_along_the_first_ray() {
    let rays = Rays::new(&HILL);
    for x in [0.3, 0.6, 1.2] {
        for y in [0.0, 0.1, 0.6] {
            let to = [x, y];
            let motion = found(to);
            let times = rays.through(to);
            // Steps of a thousandth of a second, started by a series accurate to the fourth power: errors of 1e-7 and less.
            let near = |time: f64| times.iter().any(|ray| (ray - time).abs() < 2e-6);
            assert!(
                (times[0] - motion.time()).abs() < 2e-6,
                "{to:?}: {} of {times:?}",
                motion.time()
            );
            for other in motion.others() {
                assert!(near(other), "{to:?}: {other} of {times:?}");
            }
            assert!(motion.doubts().is_empty(), "{to:?}: {:?}", motion.trials());
        }
    }
}

#[test]
fn mirrored_ends_have_mirrored_motions() {
    for to in [[0.6, 0.3], [1.2, 0.05], [0.9, 0.6]] {
        let [one, other] = [to, [to[0], -to[1]]].map(found);
        let difference = (one.time() - other.time()).abs();
        assert!(difference < 1e-12, "{to:?}: {difference:e}");
        for part in [0.1, 0.5, 0.9] {
            let [a, b] = [&one, &other].map(|motion| motion.at(part * motion.time()).q);
            let miss = (a[0] - b[0]).hypot(a[1] + b[1]);
            assert!(miss < 1e-10, "{to:?}: {miss:e}");
        }
    }
}

/// Exactly behind the hill there are two paths of equal time, on the left and on the right.
#[test]
fn both_ways_round_a_hill_are_found() {
    let motion = found([1.0, 0.0]);
    let others = motion.others();
    assert_eq!(others.len(), 1, "{:?}", motion.trials());
    assert!((others[0] - motion.time()).abs() < 1e-12);
    // The start is lower than the top, so no motion passes over it.
    let straight = &motion.trials()[0];
    assert_eq!(straight.start, Start::Straight);
    assert!(
        matches!(straight.outcome, Outcome::Lacks { energy } if energy > 0.0 && energy < 2.0 * G)
    );
    // A little to one side, the path on that side is faster and the other one slower.
    let motion = found([1.0, 0.1]);
    assert!(motion.at(0.7 * motion.time()).q[1] > 0.1);
    let others = motion.others();
    assert!(others.len() == 1 && others[0] > motion.time() + 0.01);
}

#[test]
fn a_guess_is_a_start_and_its_ends_are_moved() {
    // The guess on the far side leads to a slower motion, but the search returns the faster one.
    let to = [1.0, 0.3];
    let both = found(to);
    let guess = vec![vec![-1.0, 0.0], vec![0.0, -0.8], vec![1.1, -0.1]];
    let motion = Search::new()
        .guess(guess)
        .solve(Any::from(HILL), &FROM, &to)
        .expect("a motion");
    assert_eq!(motion.time(), both.time());
    assert_eq!(motion.trials()[0].start, Start::Guess);
    let Outcome::Found { time } = motion.trials()[0].outcome else {
        panic!("{:?}", motion.trials());
    };
    assert!((time - both.others()[0]).abs() < 1e-10 && time > both.time());
    for (guess, what) in [
        (vec![vec![-1.0, 0.0]], "the guess"),
        (vec![vec![-1.0, 0.0], vec![1.0]], "a position of the guess"),
    ] {
        let error = Search::new()
            .guess(guess)
            .solve(Any::from(HILL), &FROM, &to)
            .err();
        assert!(matches!(error, Some(Unsolved::Size { list: found, .. }) if found == what));
    }
}

/// The search has a budget of work, which it exceeds only by what it has begun.
#[test]
fn a_search_ends_with_its_budget() {
    let ridge = Hill { round: 0.0, ..HILL };
    let error = solve(ridge, &FROM, &[1.0, 0.0]).map(|motion| motion.time());
    let Err(Unsolved::NotFound { tried }) = error else {
        panic!("{error:?}");
    };
    // From below the ridge no motion passes it, and every start reports that.
    // The ridge has the same height everywhere: from z at the start to its crest, where 2 b x h exp(−b x²) = −s.
    let height = |x: f64| 0.6 * (-4.0 * x * x).exp() - 0.5 * x;
    let crest = (0..=20_000).map(|k| height(-0.2 + 1e-5 * f64::from(k)));
    let lacking = G * (crest.fold(f64::MIN, f64::max) - height(-1.0));
    for trial in &tried[..tried.len() - 1] {
        let Outcome::Lacks { energy } = trial.outcome else {
            panic!("{tried:?}");
        };
        // The 256 points of a path miss the crest by little, and the slope there is 0.
        assert!((energy / lacking - 1.0).abs() < 1e-3, "{energy} {lacking}");
    }
    assert_eq!(tried[tried.len() - 1].start, Start::Frozen);
    let text = Unsolved::NotFound { tried }.to_string();
    assert!(
        text.contains("the straight path: cannot be travelled from rest"),
        "{text}"
    );
    let cut = Search::new()
        .budget(1000)
        .solve(Any::from(HILL), &FROM, &[1.0, 0.3]);
    let Err(Unsolved::NotFound { tried }) = cut.map(|motion| motion.time()) else {
        panic!("a motion within a budget of nothing");
    };
    assert!(
        tried
            .iter()
            .any(|trial| trial.outcome == Outcome::Unfinished)
    );
    let done = found([1.0, 0.3]).evaluations();
    println!("{done} evaluations");
    assert!(done < 4_000_000, "{done}");
}
