//! Many guided contacts in one machine: more than can be examined in all combinations of their states.

use super::*;
use lagrangian::{ContactForce, contact_forces};

const G: f64 = 9.81;

/// Slabs in a stack on a ground that travels in a given way, with coordinates that are absolute, or relative to the slab below.
fn stack(mu: &[f64], travel: &str, is_relative: bool) -> InterpretedMachine {
    let join = |line: &dyn Fn(usize) -> String| {
        let lines: Vec<String> = (1..=mu.len()).map(line).collect();
        lines.join(", ")
    };
    let below = |i: usize| match i {
        1 => "floor".to_owned(),
        i => format!("slab{}", i - 1),
    };
    let coordinates = join(&|i| format!("x{i}: m"));
    let frames = join(&|i| {
        let from = if is_relative {
            below(i)
        } else {
            "ground".to_owned()
        };
        format!("slab{i} = {from}.shift(x{i}, 0)")
    });
    let bodies = join(&|i| format!("b{i} {{ mass: {i}/3, frame: slab{i} }}"));
    let sliding = join(&|i| {
        let on = below(i).replace("slab", "b");
        let mu = mu[i - 1];
        format!("s{i} {{ body: b{i}, on: {on}, direction: (1, 0), friction: {mu} }}")
    });
    machine(&format!(
        "machine Stack in plane {{
            parameters {{ A: m/s^2 = 3, J: m/s^3 = 3, g: m/s^2 = {G} }}
            coordinates {{ {coordinates} }}
            frames {{ floor = ground.shift({travel}, 0), {frames} }}
            bodies {{ {bodies} }}
            gravity (0, -g);
            sliding {{ {sliding} }}
        }}"
    ))
}

/// Each surface of a stack passes on at most μ times the weight above it, so that no slab is accelerated by more than μ g of any surface below
/// it: a slab moves with the least of these and of the acceleration of the ground. All contacts are asked at once, at the start, where nothing
/// slips yet: 5¹² combinations of states.
#[test]
fn twelve_slabs_in_a_stack_move_with_the_least_friction_below_them() {
    let mu = [
        0.9, 0.29, 0.5, 0.28, 0.285, 0.2, 0.7, 0.21, 0.19, 0.6, 0.1, 0.3,
    ];
    let (driven, until) = (3.0, 0.7);
    for is_relative in [false, true] {
        let machine = stack(&mu, "A*t^2/2", is_relative);
        let run = run(&machine, &[], &[], (1e-10, until)).expect("it runs");
        let contacts = run.observe(0.5 * until).expect("in the run").contacts;
        let mut below = driven;
        for (i, mu) in mu.iter().enumerate() {
            let own = f64::min(below, mu * G);
            let rate = if is_relative { own - below } else { own } * until;
            let found = value(&run.end().v, &format!("x{}", i + 1));
            // Each rate is a sum of some hundred rounded steps.
            assert_near(found, rate, 1e-12);
            assert_eq!(contacts[i].sticks, own == below, "{contacts:?}");
            below = own;
        }
    }
}

/// As the ground is driven harder and harder, one surface after the other breaks away, each when the acceleration of what is below it reaches
/// its own μ₀ g.
#[test]
fn the_surfaces_of_a_stack_break_away_one_after_the_other() {
    let mu = [0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1];
    let machine = stack(&mu, "J*t^3/6", false);
    let run = run(&machine, &[], &[], (1e-10, 3.2)).expect("it runs");
    let known = events(&run);
    assert_eq!(known.len(), mu.len(), "{known:?}");
    for (i, (name, t)) in (1..=mu.len()).rev().zip(&known) {
        assert_eq!(name, &format!("s{i} slides"));
        // The margin of friction is linear in time; its terms are rounded a few times each.
        assert_near(*t, mu[i - 1] * G / 3.0, 1e-13);
    }
}

/// Wedges on wedges: the reaction of each depends on the friction of all.
struct Wedges {
    slopes: Vec<f64>,
    masses: Vec<f64>,
    mu: Vec<f64>,
}

impl Wedges {
    fn drawn(random: &mut SplitMix, count: usize) -> Wedges {
        let mut list = |from: f64, to: f64| -> Vec<f64> {
            (0..count).map(|_| random.uniform(from, to)).collect()
        };
        Wedges {
            slopes: list(-0.3, 0.3),
            masses: list(0.5, 2.0),
            mu: list(0.05, 0.25),
        }
    }

    fn machine(&self) -> InterpretedMachine {
        let count = self.slopes.len();
        let join = |line: &dyn Fn(usize) -> String| {
            let lines: Vec<String> = (0..count).map(line).collect();
            lines.join(", ")
        };
        let below = |i: usize, word: &str| match i {
            0 => "ground".to_owned(),
            i => format!("{word}{}", i - 1),
        };
        let coordinates = join(&|i| format!("x{i}: m"));
        let frames = join(&|i| {
            let (sin, cos) = self.slopes[i].sin_cos();
            format!("f{i} = {}.shift({cos}*x{i}, {sin}*x{i})", below(i, "f"))
        });
        let bodies = join(&|i| format!("b{i} {{ mass: {}, frame: f{i} }}", self.masses[i]));
        let sliding = join(&|i| {
            let (sin, cos) = self.slopes[i].sin_cos();
            let (on, mu) = (below(i, "b"), self.mu[i]);
            format!("s{i} {{ body: b{i}, on: {on}, direction: ({cos}, {sin}), friction: {mu} }}")
        });
        machine(&format!(
            "machine Wedges in plane {{
                parameters {{ g: m/s^2 = {G} }}
                coordinates {{ {coordinates} }}
                frames {{ {frames} }}
                bodies {{ {bodies} }}
                gravity (0, -g);
                sliding {{ {sliding} }}
            }}"
        ))
    }

    /// Asserts that these accelerations and forces obey the laws of Newton and Coulomb.
    fn assert_laws(&self, v: &[f64], a: &[f64], forces: &[ContactForce], case: usize) {
        let count = self.slopes.len();
        let mut acceleration = [0.0; 2];
        let accelerations: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let (sin, cos) = self.slopes[i].sin_cos();
                acceleration = [acceleration[0] + cos * a[i], acceleration[1] + sin * a[i]];
                acceleration
            })
            .collect();
        // What each wedge exerts on the one above it, from the top.
        let mut load = [0.0; 2];
        for i in (0..count).rev() {
            let (m, [x, y]) = (self.masses[i], accelerations[i]);
            load = [load[0] + m * x, load[1] + m * (y + G)];
            let (sin, cos) = self.slopes[i].sin_cos();
            let along = cos * load[0] + sin * load[1];
            let normal = cos * load[1] - sin * load[0];
            // All terms are at most some 300 N and are rounded in some hundred operations.
            assert_near(forces[i].friction, along, 1e-9);
            assert_near(forces[i].normal, normal, 1e-9);
            let most = self.mu[i] * normal.abs();
            let way = if v[i] != 0.0 { v[i] } else { a[i] };
            if forces[i].sticks {
                assert_eq!(v[i], 0.0);
                assert_near(a[i], 0.0, 1e-9);
                assert!(along.abs() <= most + 1e-9, "case {case}: {forces:?}");
            } else {
                assert_near(along, -way.signum() * most, 1e-9);
            }
        }
    }
}

/// Ten wedges on each other, some of which rest when they are asked, obey the laws of Newton and Coulomb.
#[test]
fn ten_wedges_obey_the_laws_of_newton_and_coulomb() {
    let mut random = SplitMix::new(11);
    let (mut sticking, mut sliding) = (0, 0);
    for case in 0..4 {
        let wedges = Wedges::drawn(&mut random, 10);
        let machine = wedges.machine();
        let system = machine.prepare();
        for _ in 0..25 {
            let q = vec![0.0; 10];
            let v: Vec<f64> = (0..10)
                .map(|_| {
                    let v = random.uniform(-0.5, 0.5);
                    if v.abs() < 0.3 { 0.0 } else { v }
                })
                .collect();
            let u = system.default_inputs();
            let (mut a, mut forces) = (vec![0.0; 10], vec![ContactForce::default(); 10]);
            let at = At {
                t: 0.0,
                q: &q,
                v: &v,
                u: &u,
            };
            contact_forces(&system, at, &mut a, &mut [], &mut forces).expect("one motion");
            wedges.assert_laws(&v, &a, &forces, case);
            let rest = (0..10).filter(|i| v[*i] == 0.0);
            for i in rest {
                sticking += usize::from(forces[i].sticks);
                sliding += usize::from(!forces[i].sticks);
            }
        }
    }
    assert!(sticking > 100 && sliding > 100, "{sticking}, {sliding}");
}

/// Blocks in a row, linked by springs, the first of which is pulled: each breaks away when the force of the spring before it exceeds its
/// friction by that of the spring behind it, which is then still relaxed.
#[test]
fn a_row_of_blocks_is_pulled_by_a_spring() {
    let count = 9;
    let line = |line: &dyn Fn(usize) -> String| {
        let lines: Vec<String> = (0..count).map(line).collect();
        lines.join(", ")
    };
    let before = |i: usize| {
        if i == 0 {
            "V*t".to_owned()
        } else {
            format!("x{}", i - 1)
        }
    };
    let row = machine(&format!(
        "machine Row in plane {{
            parameters {{ m: kg = 1, k: N/m = 100, V: m/s = 0.1, mu: 1 = 0.2, g: m/s^2 = {G} }}
            coordinates {{ {} }}
            frames {{ {} }}
            bodies {{ {} }}
            gravity (0, -g);
            springs {{ {} }}
            dampers {{ {} }}
            sliding {{ {} }}
        }}",
        line(&|i| format!("x{i}: m")),
        line(&|i| format!("f{i} = ground.shift(x{i}, 0)")),
        line(&|i| format!("b{i} {{ mass: m, frame: f{i} }}")),
        line(&|i| format!("k{i} {{ stiffness: k, stretch: {} - x{i} }}", before(i))),
        line(&|i| format!(
            "d{i} {{ damping: 10*N*s/m, stretch: {} - x{i} }}",
            before(i)
        )),
        line(&|i| format!("s{i} {{ body: b{i}, on: ground, direction: (1, 0), friction: mu }}")),
    ));
    let run = run(&row, &[], &[], (1e-9, 150.0)).expect("it runs");
    let (m, k, speed, mu) = (1.0, 100.0, 0.1, 0.2);
    let known = events(&run);
    let first = known
        .iter()
        .find(|(name, _)| name == "s0 slides")
        .expect("it slides");
    // k V t + d V = μ m g.
    let at = (mu * m * G - 10.0 * speed) / (k * speed);
    assert_near(first.1, at, 1e-12);
    // In the end all are pulled along steadily, and each spring holds the friction of all blocks behind it.
    for i in 0..count {
        let x = |i: usize| value(&run.end().q, &format!("x{i}"));
        let ahead = if i == 0 { speed * 150.0 } else { x(i - 1) };
        let stretch = mu * m * G * (count - i) as f64 / k;
        assert_near(value(&run.end().v, &format!("x{i}")), speed, 1e-6);
        assert_near(ahead - x(i), stretch, 1e-6);
    }
}
