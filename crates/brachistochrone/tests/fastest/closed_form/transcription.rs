//! The fastest motion by a direct method that does not use Euler's equations: a polyline whose time is minimized.
//!
//! Under the conditions (17), in coordinates `z` in which `A = a + sym d` measures lengths, a straight piece from `z` to
//! `z + s` changes the speed by `V² ← V² − 2 ρ·s`. A corner that turns by `x` changes it by `V ← V exp(−Ω x)`, as the skew part
//! of `d` acts on turns. Both are exact, so every polyline is a possible motion of the machine, and no faster than the fastest.

use super::paper::Machine;

/// The plane in which the machine moves as a point.
struct Plane {
    /// The end point.
    end: [f64; 2],
    /// The gradient `ρ` of the potential and constant friction.
    slope: [f64; 2],
    /// Ω.
    skew: f64,
}

impl Plane {
    fn of(machine: &Machine, end: [f64; 2]) -> Plane {
        let Machine { a, b, c, d } = machine;
        let metric = |i: usize, j: usize| a[i][j] + (d[i][j] + d[j][i]) / 2.0;
        // A = L Lᵀ, z = Lᵀ q.
        let l11 = metric(0, 0).sqrt();
        let l21 = metric(0, 1) / l11;
        let l22 = (metric(1, 1) - l21 * l21).sqrt();
        let first = (b[0] + c[0]) / l11;
        Plane {
            end: [l11 * end[0] + l21 * end[1], l22 * end[1]],
            slope: [first, (b[1] + c[1] - l21 * first) / l22],
            skew: (d[0][1] - d[1][0]) / 2.0 / (l11 * l22),
        }
    }

    /// The time along a polyline whose pieces take about equal times. Its corners are off the straight line by `offsets` times
    /// the length of that line. The time is infinite if the polyline goes up too far.
    fn time(&self, offsets: &[f64]) -> f64 {
        let pieces = offsets.len() + 1;
        let [x, y] = self.end;
        let corner = |i: usize| {
            let along = (i as f64 / pieces as f64).powi(2);
            let across = match i {
                0 => 0.0,
                i => offsets.get(i - 1).copied().unwrap_or(0.0),
            };
            [along * x - across * y, along * y + across * x]
        };
        let (mut time, mut speed, mut before) = (0.0, 0.0_f64, None);
        for i in 0..pieces {
            let ([x0, y0], [x1, y1]) = (corner(i), corner(i + 1));
            let (dx, dy) = (x1 - x0, y1 - y0);
            if let Some((bx, by)) = before {
                let turn = f64::atan2(bx * dy - by * dx, bx * dx + by * dy);
                speed *= (-self.skew * turn).exp();
            }
            let square = speed * speed - 2.0 * (self.slope[0] * dx + self.slope[1] * dy);
            if square <= 0.0 {
                return f64::INFINITY;
            }
            let faster = square.sqrt();
            time += 2.0 * dx.hypot(dy) / (speed + faster);
            (speed, before) = (faster, Some((dx, dy)));
        }
        time
    }

    /// Minimizes the time by Newton's method with differences.
    fn least(&self, offsets: &mut [f64]) -> f64 {
        const STEP: f64 = 1e-4;
        let n = offsets.len();
        let mut best = self.time(offsets);
        for _ in 0..30 {
            let at = |moves: &[(usize, f64)]| {
                let mut there = offsets.to_vec();
                moves.iter().for_each(|&(i, by)| there[i] += by);
                self.time(&there)
            };
            let slope = |i: usize| (at(&[(i, STEP)]) - at(&[(i, -STEP)])) / (2.0 * STEP);
            let second = |i: usize, j: usize| {
                let [up, down] = [STEP, -STEP].map(|by| {
                    if i == j {
                        return (at(&[(i, by)]) - best) / by;
                    }
                    (at(&[(i, by), (j, STEP)]) - at(&[(i, by), (j, -STEP)])) / (2.0 * STEP)
                });
                if i == j {
                    (up - down) / STEP
                } else {
                    (up - down) / (2.0 * STEP)
                }
            };
            let row = |i: usize| {
                let mut row: Vec<f64> = (0..n).map(|j| second(i, j)).collect();
                row.push(-slope(i));
                row
            };
            let rows: Vec<Vec<f64>> = (0..n).map(row).collect();
            let step = eliminated(rows);
            let mut part = 1.0;
            let before = (offsets.to_vec(), best);
            while part > 1e-3 {
                for ((x, before), by) in offsets.iter_mut().zip(&before.0).zip(&step) {
                    *x = before + part * by;
                }
                best = self.time(offsets);
                if best <= before.1 {
                    break;
                }
                part /= 2.0;
            }
            if best >= before.1 - 1e-15 {
                offsets.copy_from_slice(&before.0);
                return before.1;
            }
        }
        best
    }
}

/// Solves linear equations whose right-hand sides are the last column; near a minimum no pivoting is needed.
fn eliminated(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let own = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k] / own[k];
            assert!(factor.is_finite(), "row {i} of {n}");
            for (x, own) in row.iter_mut().zip(&own) {
                *x -= factor * own;
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

/// The least times of polylines with 4, 8, 16, … pieces from rest at the origin to an end.
pub fn least_times(machine: &Machine, end: [f64; 2], doublings: usize) -> Vec<f64> {
    let plane = Plane::of(machine, end);
    // Starts with the best of several arches.
    let arch = |height: f64| {
        [1, 2, 3]
            .map(|i| height * 4.0 * (i as f64 / 4.0).powi(2) * (1.0 - (i as f64 / 4.0).powi(2)))
    };
    let arches = (-20..=20).map(|k| arch(f64::from(k) / 20.0));
    let first = arches.min_by(|a, b| plane.time(a).total_cmp(&plane.time(b)));
    let mut offsets = first.expect("there are some").to_vec();
    let mut times = vec![plane.least(&mut offsets)];
    for _ in 0..doublings {
        // New corners are on the parabola in time through their neighbours.
        let known = |i: usize| {
            i.checked_sub(1)
                .and_then(|i| offsets.get(i))
                .copied()
                .unwrap_or(0.0)
        };
        let finer: Vec<f64> = (1..2 * (offsets.len() + 1))
            .map(|i| match i % 2 {
                0 => known(i / 2),
                _ => 0.5 * (known(i / 2) + known(i / 2 + 1)),
            })
            .collect();
        offsets = finer;
        times.push(plane.least(&mut offsets));
    }
    times
}
