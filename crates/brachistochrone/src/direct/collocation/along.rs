//! A guess of the fastest motion from an improved polygon.

use super::super::Terrain;
use super::super::descent::{Polygon, Traversal};
use super::super::hamiltonian::Driven;
use super::super::pontryagin::Pontryagin;
use super::super::rule::{POINTS, Rule, sloping};
use super::{Level, Path, Stage};

/// The polynomials of an initial guess interpolate the ends of this many pieces.
const NEAR: usize = 4;

/// A point of a motion for which multipliers are not known yet.
struct PointWithoutMultipliers {
    q: Vec<f64>,
    w: f64,
    z: Vec<f64>,
    /// `F = Ẇ`.
    force: f64,
    /// `∂F/∂W`.
    slope: f64,
}

impl Path {
    /// A guess from an improved polygon; `None` where the multipliers are not finite.
    ///
    /// Positions are taken from a polynomial through the ends of a few pieces, `q₀ + t² u(t)`, since a motion from rest
    /// starts like this. Its rates give the control and W; λ obeys an equation that is linear because H = 1:
    ///
    /// ```text
    /// λ̇ = −∂H/∂W = −(1 − λ F)/W − λ ∂F/∂W        F = Ẇ        λ = 1/F at rest, 0 at the end
    /// ```
    ///
    /// For a motion that ends at rest λ is 0 half-way instead. Then p follows from H = 1 and ∂H/∂z = 0.
    pub fn along<T: Terrain>(
        system: &Driven<T>,
        polygon: &Polygon,
        traversal: &Traversal,
        (stretches, level): (usize, Option<Level>),
    ) -> Option<Path> {
        let (n, m) = (system.n(), system.states());
        let time = traversal.time();
        let h = time / stretches as f64;
        let rule = Rule::new();
        let moments = (0..stretches).flat_map(|k| {
            let start = h * k as f64;
            [start]
                .into_iter()
                .chain(rule.points.map(|c| start + c * h))
        });
        let moments: Vec<f64> = moments.chain([time]).collect();
        let states = points_along(system, (polygon, traversal), &moments, level.is_some());
        let last = moments.len() - 1;
        let zero = match level {
            Some(_) => last / 2,
            None => last,
        };
        let lambdas = lambdas(&moments, &states, zero);
        let mut last_stages: Vec<Stage> = Vec::new();
        for k in (0..moments.len()).rev() {
            let PointWithoutMultipliers { q, w, z, .. } = &states[k];
            let (p, z) = match (k, last_stages.last()) {
                // At rest the values are those of the point after it.
                (0, Some(after)) => (after.y[m..m + n].to_vec(), after.z.clone()),
                _ if k == last && level.is_some() => {
                    let before = &states[k - 1];
                    system.multipliers(&before.q, before.w, &before.z, lambdas[k - 1])?
                }
                _ => system.multipliers(q, *w, z, lambdas[k])?,
            };
            let mut y = q.clone();
            y.push(*w);
            y.extend(p);
            y.push(lambdas[k]);
            if !y.iter().chain(&z).all(|x| x.is_finite()) {
                return None;
            }
            last_stages.push(Stage { y, z });
        }
        last_stages.reverse();
        let last = last_stages.pop()?;
        let mut nodes: Vec<Vec<f64>> = Vec::new();
        let mut stages = Vec::new();
        for stretch in last_stages.chunks(POINTS + 1) {
            nodes.push(stretch[0].y.clone());
            stages.push(stretch[1..].to_vec());
        }
        nodes.push(last.y);
        Some(Path {
            level,
            time,
            nodes,
            stages,
            last: last.z,
        })
    }
}

/// Positions, W and controls of a motion along a polygon at these moments.
fn points_along<T: Terrain>(
    system: &Driven<T>,
    (polygon, traversal): (&Polygon, &Traversal),
    moments: &[f64],
    ends_at_rest: bool,
) -> Vec<PointWithoutMultipliers> {
    let (n, m) = (system.n(), system.states());
    let time = traversal.time();
    let mut known: Vec<(f64, Vec<f64>)> = Vec::new();
    let mut t = 0.0;
    for (place, piece) in polygon.places[1..].iter().zip(&traversal.times) {
        t += piece;
        let ahead = place.iter().zip(&polygon.places[0]);
        known.push((t, ahead.map(|(q, from)| (q - from) / (t * t)).collect()));
    }
    let near = |t: f64| -> Vec<(f64, &[f64])> {
        let after = known.partition_point(|(at, _)| *at < t);
        let count = known.len().min(NEAR);
        let first = after.saturating_sub(count / 2).min(known.len() - count);
        let some = known[first..first + count].iter();
        some.map(|(t, u)| (*t, u.as_slice())).collect()
    };
    let mut before = 0.0;
    let mut states: Vec<PointWithoutMultipliers> = Vec::new();
    for t in moments {
        let u = sloping(&near(*t), *t);
        let q: Vec<f64> = (0..n)
            .map(|i| polygon.places[0][i] + t * t * u[i].value)
            .collect();
        // Dividing the rate by t keeps its direction, also at t = 0.
        let v = u.iter().map(|u| 2.0 * u.value + t * u.derivative);
        let v: Vec<f64> = v.collect();
        let (z, w) = match states.last() {
            // At rest the control is that of the point before.
            Some(known) if ends_at_rest && *t == time => (known.z.clone(), 0.0),
            _ => {
                let z = system.control(&q, &v, before);
                let w = t * system.measure(&q, &v, &z);
                (z, w)
            }
        };
        before = z[0];
        let mut y = q.clone();
        y.push(w);
        y.resize(2 * m, 0.0);
        y[2 * m - 1] = 1.0;
        let mut alone = z.clone();
        if !system.is_plane() {
            alone[n] = 0.0;
        }
        let (force, slopes) = system.slopes(&y, &alone);
        states.push(PointWithoutMultipliers {
            q,
            w,
            z,
            force,
            slope: slopes[n],
        });
    }
    states
}

/// λ at these moments, from the one at which it is 0, by the trapezoidal rule.
fn lambdas(moments: &[f64], states: &[PointWithoutMultipliers], zero: usize) -> Vec<f64> {
    let mut lambdas = std::vec![0.0; moments.len()];
    let last = moments.len() - 1;
    // One step of the rule, from a moment where it is known to a neighbouring one.
    let beside = |known: usize, k: usize, lambda: f64| {
        let half = 0.5 * (moments[known] - moments[k]);
        let [there, here] = [&states[known], &states[k]];
        let ahead = lambda * (1.0 - half * (there.force / there.w - there.slope));
        (ahead + half * (1.0 / here.w + 1.0 / there.w))
            / (1.0 + half * (here.force / here.w - here.slope))
    };
    for k in (0..zero).rev() {
        lambdas[k] = match k {
            0 => 1.0 / states[k].force,
            _ => beside(k + 1, k, lambdas[k + 1]),
        };
    }
    for k in zero + 1..=last {
        lambdas[k] = if k == last {
            1.0 / states[k].force
        } else {
            beside(k - 1, k, lambdas[k - 1])
        };
    }
    lambdas
}
