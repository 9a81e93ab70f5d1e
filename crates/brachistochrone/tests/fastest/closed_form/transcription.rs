//! The fastest motion in the bluntest way: a polyline whose time is made least, with nothing known of Euler's equations.
//!
//! Under the conditions (17) and in coordinates `z` in which `A = a + sym d` measures lengths, a straight piece from `z` to
//! `z + s` changes the speed by `V² ← V² − 2 ρ·s`, and a corner that turns by `x` by `V ← V exp(−Ω x)`, as friction by the skew
//! part of `d` goes with the turn. Both are exact, so a polyline is a motion of the machine: no slower than the fastest.

use super::paper::Machine;

/// The plane in which the machine is a point.
struct Plane {
    /// The end.
    end: [f64; 2],
    /// What falls: `ρ`.
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

    /// The time along a polyline whose corners are off the straight way by `offsets`, times its length; about equally long in
    /// time. Infinite where it leads up too far.
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

    /// Makes the time least by Newton's method with differences.
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

/// The solution of equations with their right-hand sides behind them; what is near a minimum needs no search for pivots.
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

/// The least times from rest at the origin to an end, of polylines with 4, 8, 16, … pieces.
pub fn least_times(machine: &Machine, end: [f64; 2], doublings: usize) -> Vec<f64> {
    let plane = Plane::of(machine, end);
    // From the best of some arches.
    let arch = |height: f64| {
        [1, 2, 3]
            .map(|i| height * 4.0 * (i as f64 / 4.0).powi(2) * (1.0 - (i as f64 / 4.0).powi(2)))
    };
    let arches = (-20..=20).map(|k| arch(f64::from(k) / 20.0));
    let first = arches.min_by(|a, b| plane.time(a).total_cmp(&plane.time(b)));
    let mut offsets = first.expect("there are some").to_vec();
    let mut times = vec![plane.least(&mut offsets)];
    for _ in 0..doublings {
        // In between, by the parabola in time through the neighbours.
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
