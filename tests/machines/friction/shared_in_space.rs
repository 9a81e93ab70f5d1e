//! Contacts and guides in space that share a load: all of them hold up to the greatest load that any distribution of forces permits.
//!
//! The truths are closed forms of statics, and of one body that slides; where the motion depends on how a load is shared, equations of a body on feet that
//! yield alike, written by hand and integrated here.

use super::{assert_near, events, run, value};
use crate::support::library::machine;
use crate::support::random::SplitMix;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{MOREAU, Machine, Simulation};

const G: f64 = 9.81;

/// A body of 2 kg that a growing force pushes along the ground of a frame `bed`.
fn pushed(bed: &str, supports: &str, law: &str) -> InterpretedMachine {
    machine(&format!(
        "machine Pushed in space {{
            parameters {{ m: kg = 2, mu: 1 = 0.3, mu0: 1 = 0.36, c: N/s = 4, dir: rad = 0, d: m = 0, g: m/s^2 = 9.81 }}
            coordinates {{ x: m, y: m, z: m, yaw: rad, theta: rad, phi: rad }}
            frames {{
                {bed},
                held = bed.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi),
            }}
            bodies {{ body {{ mass: m, inertia: (0.02, 0.03, 0.04), frame: held }} }}
            gravity (0, 0, -g);
            forces {{ push {{ at: held.point(0, 0, d), force: c*t*bed.vector(cos(dir), sin(dir), 0) }} }}
            contacts {{ {supports} }}
        }}"
    ).replace("LAW", law))
}

const LAW: &str = "restitution: 0, friction: mu, static_friction: mu0";

/// The body lets go at `away` and slides with the remaining friction in the direction of its push.
#[track_caller]
fn lets_go(
    body: &InterpretedMachine,
    set: &[(&str, f64)],
    (away, kinetic): (f64, f64),
    direction: f64,
    name: &str,
) {
    for tolerance in [1e-6, 1e-10] {
        let until = away + 0.7321;
        let run = run(body, set, &[], (tolerance, until))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let known = events(&run);
        assert!(!known.is_empty(), "{name}: it lets go");
        for (what, t) in &known {
            // The instant is looked for 1e-9 of a step behind the place where it is seen.
            assert!((t - away).abs() < 1e-8, "{name}: {what} at {t}, not {away}");
        }
        let (left, surplus) = (until - away, 4.0 * away - kinetic);
        let way = (surplus * left * left / 2.0 + 4.0 * left * left * left / 6.0) / 2.0;
        let (sin, cos) = direction.sin_cos();
        let end = [value(&run.end().q, "x"), value(&run.end().q, "y")];
        assert_near(end[0], way * cos, 2e-7);
        assert_near(end[1], way * sin, 2e-7);
    }
}

/// A box on four corners, a table on five legs and a tripod hold μ₀ m g in every direction, wherever they are pushed.
#[test]
fn tables_let_go_as_points_do() {
    let supports = [
        "floor { corners: ((0.2, 0.15, 0), (0.2, -0.15, 0), (-0.2, 0.15, 0), (-0.2, -0.15, 0)), on: held, along: bed, LAW }",
        "floor { corners: ((0.3, 0, 0), (0.1, 0.3, 0), (-0.2, 0.2, 0), (-0.2, -0.2, 0), (0.1, -0.3, 0)), on: held, along: bed, LAW }",
        "floor { corners: ((0.2, 0, 0), (-0.1, 0.17320508075688773, 0), (-0.1, -0.17320508075688773, 0)), on: held, along: bed, LAW }",
    ];
    for support in supports {
        let body = pushed("bed = ground.shift(0, 0, 0)", support, LAW);
        for (direction, height) in [(0.0, 0.0), (0.7, 0.02), (-2.0, -0.03)] {
            let set = [("dir", direction), ("d", height)];
            let weight = 2.0 * G;
            let truth = (0.36 * weight / 4.0, 0.3 * weight);
            lets_go(&body, &set, truth, direction, support);
        }
    }
}

/// A body in a V groove whose sides have the angle β: by statics it is wedged in up to `μ₀ m g/(cos β √(1 − μ₀² tan² β))`, and it slides with
/// `μ m g/cos β`.
#[test]
fn a_body_in_a_groove_is_held_by_wedging() {
    let side = |name: &str, y: f64, frame: &str| {
        format!(
            "{name} {{ corners: ((0.2, {y}, 0), (-0.2, {y}, 0)), on: held, along: {frame}, LAW }}"
        )
    };
    for beta in [0.3_f64, 0.7] {
        // The points are where their sides are.
        let sides = [side("one", 0.1, "high"), side("other", -0.1, "low")].join(", ");
        let bed = format!(
            "bed = ground.shift(0, 0, 0), high = bed.shift(0, 0.1, 0).turn(x, {beta}), low = bed.shift(0, -0.1, 0).turn(x, -{beta})"
        );
        let body = pushed(&bed, &sides, LAW);
        let (weight, wedged) = (2.0 * G, 0.36 * beta.tan());
        let most = 0.36 * weight / (beta.cos() * (1.0 - wedged * wedged).sqrt());
        let truth = (most / 4.0, 0.3 * weight / beta.cos());
        lets_go(&body, &[], truth, 0.0, "groove");
    }
}

/// Two blocks of 1 kg and 2 kg, joined by a rod, on surfaces that hold them from both sides: together they hold μ₁ N₁ + μ₂ N₂ = 5 N + 4 N
/// along the rod, and slide with 3 N + 2 N.
#[test]
fn guides_on_surfaces_hold_together() {
    for is_on_surface in [true, false] {
        let second = if is_on_surface {
            "table2 { body: b2, on: ground, normal: (0, 0, 1), friction: 0.1, static_friction: 0.2 }"
        } else {
            "rail { body: b2, on: ground, direction: (1, 0, 0), friction: 0.1, static_friction: 0.2 }"
        };
        let coordinates = if is_on_surface {
            "x2: m = 1, y2: m"
        } else {
            "x2: m = 1"
        };
        let at = if is_on_surface {
            "(x2, y2, 0)"
        } else {
            "(x2, 0, 0)"
        };
        let blocks = machine(&format!(
            "machine Blocks in space {{
                parameters {{ F: N = 0, c: N/s = 4 }}
                coordinates {{ x1: m, y1: m, {coordinates} }}
                bodies {{ b1 {{ mass: 1, at: (x1, y1, 0) }}, b2 {{ mass: 2, at: {at} }} }}
                gravity (0, 0, -10);
                forces {{ push {{ at: b1.at, force: (F + c*t, 0, 0) }} }}
                constraints {{ rod: x2 - x1 = 1 }}
                sliding {{ table {{ body: b1, on: ground, normal: (0, 0, 1), friction: 0.3, static_friction: 0.5 }}, {second} }}
            }}"
        ));
        let away = 9.0 / 4.0;
        let held = run(&blocks, &[("F", 8.9), ("c", 0.0)], &[], (1e-9, 2.0)).expect("it runs");
        assert!(held.events().is_empty(), "{:?}", events(&held));
        let run = run(&blocks, &[], &[], (1e-10, away + 1.0)).expect("it runs");
        let known = events(&run);
        assert!(!known.is_empty(), "they let go");
        for (what, t) in &known {
            assert!((t - away).abs() < 1e-8, "{what} at {t}");
        }
        // 3 kg with 9 N + c τ against 5 N.
        let expected = (4.0 / 2.0 + 4.0 / 6.0) / 3.0;
        assert_near(value(&run.end().q, "x1"), expected, 1e-7);
    }
}

/// The coefficient of static friction of a foot over that of kinetic friction.
const STATIC: f64 = 1.25;

/// A body of 2 kg on feet, pushed by the force `4 N/s · t` along `push` at `at`, both relative to its centre of mass in height `height` over the ground.
#[derive(Debug)]
struct OnFeet {
    height: f64,
    feet: Vec<[f64; 2]>,
    friction: Vec<f64>,
    at: [f64; 3],
    push: [f64; 3],
}

/// Position along the ground and angle, and their rates.
type Planar = [f64; 6];

const MASS: f64 = 2.0;
const INERTIA: f64 = 0.04;

impl OnFeet {
    fn drawn(random: &mut SplitMix) -> OnFeet {
        let count = 3 + (random.next() % 3) as usize;
        let foot = |k: usize, random: &mut SplitMix| {
            let angle =
                (k as f64 + random.uniform(-0.3, 0.3)) * std::f64::consts::TAU / count as f64;
            let radius = random.uniform(0.2, 0.4);
            [radius * angle.cos(), radius * angle.sin()]
        };
        let feet = (0..count).map(|k| foot(k, random)).collect();
        let same = random.uniform(0.2, 0.6);
        let differ = random.next().is_multiple_of(3);
        let friction = (0..count)
            .map(|_| {
                if differ {
                    random.uniform(0.2, 0.6)
                } else {
                    same
                }
            })
            .collect();
        let direction = random.uniform(0.0, std::f64::consts::TAU);
        OnFeet {
            height: random.uniform(0.0, 0.05),
            feet,
            friction,
            at: [0; 3].map(|_| random.uniform(-0.08, 0.08)),
            push: [direction.cos(), direction.sin(), random.uniform(-0.3, 0.0)],
        }
    }

    fn machine(&self) -> InterpretedMachine {
        let (h, [px, py, pz], [fx, fy, fz]) = (self.height, self.at, self.push);
        let feet = self.feet.iter().zip(&self.friction).enumerate();
        let feet: Vec<String> = feet
            .map(|(k, ([x, y], mu))| {
                let at_rest = STATIC * mu;
                format!("c{k} {{ point: ({x}, {y}, {}), on: held, along: ground, restitution: 0, friction: {mu}, static_friction: {at_rest} }}", -h)
            })
            .collect();
        machine(&format!(
            "machine Feet in space {{
                parameters {{ rate: N/s = 4 }}
                coordinates {{ x: m, y: m, z: m = {h}, yaw: rad, theta: rad, phi: rad }}
                frames {{ held = ground.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi) }}
                bodies {{ body {{ mass: {MASS}, inertia: (0.03, 0.02, {INERTIA}), frame: held }} }}
                gravity (0, 0, -{G});
                forces {{ push {{ at: held.point({px}, {py}, {pz}), force: rate*t*ground.vector({fx}, {fy}, {fz}) }} }}
                contacts {{ {} }}
            }}",
            feet.join(", ")
        ))
    }

    /// The accelerations of a body that stays upright, with feet that slip in the direction in which they move at these rates. `None` if it does not stay upright.
    fn accelerations(&self, t: f64, yaw: f64, rates: [f64; 3]) -> Option<[f64; 3]> {
        let (sin, cos) = yaw.sin_cos();
        let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
        let feet: Vec<[f64; 2]> = self.feet.iter().map(|foot| turned(*foot)).collect();
        let slips: Vec<[f64; 2]> = (feet.iter())
            .map(|[x, y]| {
                let [u, v] = [rates[0] - rates[2] * y, rates[1] + rates[2] * x];
                [u / u.hypot(v), v / u.hypot(v)]
            })
            .collect();
        let [x, y] = turned([self.at[0], self.at[1]]);
        let [fx, fy, fz] = self.push.map(|part| 4.0 * t * part);
        let tilting = [y * fz - self.at[2] * fy, self.at[2] * fx - x * fz];
        let pressing = self.pressing(&feet, &slips, [fz - MASS * G, tilting[0], tilting[1]])?;
        let mut sums = [fx, fy, x * fy - y * fx];
        for (((foot, slip), mu), normal) in
            feet.iter().zip(&slips).zip(&self.friction).zip(pressing)
        {
            let force = slip.map(|part| -mu * normal * part);
            sums[0] += force[0];
            sums[1] += force[1];
            sums[2] += foot[0] * force[1] - foot[1] * force[0];
        }
        Some([sums[0] / MASS, sums[1] / MASS, sums[2] / INERTIA])
    }

    /// The normal forces that balance a load (a force and two moments), as springs that are all the same would press: of all choices of feet that press
    /// the one in which they do, and a small motion of the body lifts the others.
    fn pressing(&self, feet: &[[f64; 2]], slips: &[[f64; 2]], load: [f64; 3]) -> Option<Vec<f64>> {
        let spring = |[x, y]: [f64; 2]| [1.0, x, y];
        for choice in (0..1 << feet.len()).rev() {
            let presses = |k: &usize| choice >> k & 1 == 1;
            let mut matrix = [[0.0; 3]; 3];
            for k in (0..feet.len()).filter(presses) {
                let lever = self.height * self.friction[k];
                let [x, y] = feet[k];
                let acts = [1.0, y - lever * slips[k][1], lever * slips[k][0] - x];
                for (row, act) in matrix.iter_mut().zip(acts) {
                    row.iter_mut()
                        .zip(spring(feet[k]))
                        .for_each(|(entry, by)| *entry += act * by);
                }
            }
            let Some(sinks) = solved(matrix, load.map(|part| -part)) else {
                continue;
            };
            let depth = |k: usize| {
                spring(feet[k])
                    .iter()
                    .zip(sinks)
                    .map(|(by, z)| by * z)
                    .sum::<f64>()
            };
            if (0..feet.len()).all(|k| presses(&k) == (depth(k) >= 0.0)) {
                return Some((0..feet.len()).map(|k| depth(k).max(0.0)).collect());
            }
        }
        None
    }

    /// The accelerations with which it begins to slide, in the direction of which every foot slips. `None` if they are not found, or if a foot hardly slips.
    ///
    /// For given normal forces `M a − F + ∂D/∂a` vanishes, with the power D of friction, where a convex function is least: small enough steps down lead there.
    fn beginning(&self, t: f64) -> Option<[f64; 3]> {
        let (mut a, mut part, mut before) =
            ([self.push[0], self.push[1], 0.01], 0.5, f64::INFINITY);
        for _ in 0..20_000 {
            let next = self.accelerations(t, 0.0, a)?;
            let change = [0, 1, 2].map(|i| next[i] - a[i]);
            let size = change.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if size < 1e-13 {
                let slips = |[x, y]: &[f64; 2]| (a[0] - a[2] * y).hypot(a[1] + a[2] * x) > 0.05;
                return self.feet.iter().all(slips).then_some(a);
            }
            if size > before {
                part *= 0.7;
            }
            before = size;
            a = [0, 1, 2].map(|i| a[i] + part * change[i]);
        }
        None
    }

    /// Where it is after it has slid from rest for a time, by the classical method of Runge and Kutta. The direction of a slip that begins
    /// settles at a rate of the order of 1/t after the beginning, so the steps are graded: the first is 10⁻¹² of the time.
    fn slides(&self, from: f64, time: f64) -> Option<Planar> {
        let a = self.beginning(from)?;
        let rates = |t: f64, state: &Planar| -> Option<Planar> {
            let moves = [state[3], state[4], state[5]];
            let along = if moves == [0.0; 3] { a } else { moves };
            let [x, y, turn] = self.accelerations(t, state[2], along)?;
            Some([moves[0], moves[1], moves[2], x, y, turn])
        };
        const STEPS: usize = 1000;
        let after = |step: usize| time * (step as f64 / STEPS as f64).powi(4);
        let mut state = [0.0; 6];
        for step in 0..STEPS {
            let (t, h) = (from + after(step), after(step + 1) - after(step));
            let moved =
                |by: &Planar, part: f64| [0, 1, 2, 3, 4, 5].map(|i| state[i] + part * h * by[i]);
            let first = rates(t, &state)?;
            let second = rates(t + 0.5 * h, &moved(&first, 0.5))?;
            let third = rates(t + 0.5 * h, &moved(&second, 0.5))?;
            let fourth = rates(t + h, &moved(&third, 1.0))?;
            state = [0, 1, 2, 3, 4, 5].map(|i| {
                state[i] + h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i])
            });
        }
        Some(state)
    }
}

/// Solves three equations by Cramer's rule, if their determinant is more than rounding.
fn solved(matrix: [[f64; 3]; 3], right: [f64; 3]) -> Option<[f64; 3]> {
    let determinant = |m: [[f64; 3]; 3]| {
        let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
        m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
    };
    let whole = determinant(matrix);
    let column = |j: usize| {
        let mut with = matrix;
        with.iter_mut()
            .zip(right)
            .for_each(|(row, right)| row[j] = right);
        determinant(with) / whole
    };
    (whole.abs() > 1e-10).then(|| [0, 1, 2].map(column))
}

/// Bodies on three to five feet, which turn as they slide: with four and five feet their friction depends on how they share the load.
#[test]
fn bodies_on_feet_turn_as_on_feet_that_yield_alike() {
    let (mut random, mut compared) = (SplitMix::new(49), [0; 6]);
    for case in 0..60 {
        let body = OnFeet::drawn(&mut random);
        let machine = body.machine();
        let run_until = |until: f64| {
            run(&machine, &[], &[], (1e-11, until))
                .unwrap_or_else(|error| panic!("case {case}: {body:?}: {error}"))
        };
        // At which load it lets go is for other tests: here it is looked for.
        let first = |quarter: usize| events(&run_until(0.25 * quarter as f64)).first().cloned();
        let Some((_, away)) = (1..40).find_map(first) else {
            continue;
        };
        let Some(expected) = body.slides(away, 0.25) else {
            continue;
        };
        let found = run_until(away + 0.25);
        for (i, name) in ["x", "y", "yaw"].into_iter().enumerate() {
            let state = found.end();
            // The instant at which it lets go is known to 1e-8 s.
            assert_near(value(&state.q, name), expected[i], 1e-8);
            assert_near(value(&state.v, name), expected[3 + i], 1e-7);
        }
        let balance = found.energy_balance().expect("kept");
        assert!(balance.relative().abs() < 1e-9, "case {case}: {balance:?}");
        compared[body.feet.len()] += 1;
    }
    assert!(
        compared.iter().skip(3).all(|count| *count >= 5),
        "{compared:?}"
    );
}

/// A plate on five feet that slides and turns: how they share the load is the same in time stepping, whose steps of two lengths are extrapolated, as in a run that
/// integrates the motion. Three of the feet would carry it also, and turn it otherwise by a few thousandths.
#[test]
fn time_steps_share_the_load_of_feet_that_turn() {
    let plate = machine(
        "machine Plate in space {
            coordinates { x: m, y: m, z: m = 0.05, yaw: rad, theta: rad, phi: rad, der(x): m/s = 1, der(yaw): rad/s = 6 }
            frames { held = ground.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi) }
            bodies { body { mass: 2, inertia: (0.03, 0.02, 0.04), frame: held } }
            gravity (0, 0, -9.81);
            contacts { floor {
                corners: ((0.3, 0.1, -0.05), (0.2, -0.25, -0.05), (-0.3, 0.2, -0.05), (-0.1, -0.2, -0.05), (0, 0.3, -0.05)),
                on: held, along: ground, restitution: 0, friction: 0.3,
            } }
        }",
    );
    const UNTIL: f64 = 0.05;
    let exact = run(&plate, &[], &[], (1e-10, UNTIL)).expect("it slides");
    let stepped = [1e-3, 5e-4].map(|step| {
        Simulation::new(&plate)
            .method(&MOREAU)
            .longest_step(step)
            .until(UNTIL)
            .run(plate.start())
            .expect("it slides")
    });
    for name in ["x", "y", "yaw"] {
        let truth = value(&exact.end().q, name);
        let [coarse, fine] = [0, 1].map(|k| value(&stepped[k].end().q, name));
        // The error of the first order cancels; what remains is of the second.
        assert_near(2.0 * fine - coarse, truth, 1e-6);
    }
}
