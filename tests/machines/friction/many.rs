//! Many guided contacts in one machine: more than can be examined in all combinations of their states.

use super::*;
use lagrangian::{ContactForce, contact_forces, unilateral_forces};
use lagrangian_spec::diagnostic::Code;

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
    let bodies = join(&|i| format!("b{i} {{ mass: {i}/3*kg, frame: slab{i} }}"));
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

/// The weight of slabs and of what lies on them, in units of g kg.
fn weights(count: usize) -> Vec<f64> {
    let on = |i: usize| (i..=count).map(|j| j as f64 / 3.0).sum();
    (1..=count + 1).map(on).collect()
}

/// Slabs on a ground that begins to move: which surfaces slip is asked for all of them at once, at the start, where nothing slips yet, 5¹²
/// combinations of states. Each passes on the forces that accelerate what lies on it, up to μ times its weight; no other motion obeys the
/// law, since the friction of slabs does not change what they weigh.
#[test]
fn twelve_slabs_in_a_stack_begin_to_slide_together() {
    let mu = [
        0.9, 0.29, 0.5, 0.28, 0.285, 0.2, 0.7, 0.21, 0.19, 0.6, 0.1, 0.3,
    ];
    let (driven, until) = (3.0, 0.7);
    let weights = weights(mu.len());
    let mut both = Vec::new();
    for is_relative in [false, true] {
        let machine = stack(&mu, "A*t^2/2", is_relative);
        let run = run(&machine, &[], &[], (1e-10, until)).expect("it runs");
        let contacts = run.observe(0.5 * until).expect("in the run").contacts;
        let mut below = driven;
        let rates = (1..=mu.len()).map(|i| value(&run.end().v, &format!("x{i}")) / until);
        let accelerations: Vec<f64> = rates
            .map(|rate| {
                below = if is_relative { below + rate } else { rate };
                below
            })
            .collect();
        let mut passed_on = 0.0;
        for i in (0..mu.len()).rev() {
            passed_on += (i + 1) as f64 / 3.0 * accelerations[i];
            let slip = accelerations[i] - if i == 0 { driven } else { accelerations[i - 1] };
            let most = mu[i] * G * weights[i];
            // Sums of rates that are rounded in some hundred steps, times up to 26 kg.
            assert_near(contacts[i].friction, passed_on, 1e-10);
            if contacts[i].sticks {
                assert_near(slip, 0.0, 1e-11);
                assert!(passed_on.abs() <= most, "{i}: {passed_on}, {most}");
            } else {
                assert!(slip.abs() > 1e-3, "{i}: {slip}");
                assert_near(passed_on, -slip.signum() * most, 1e-10);
            }
        }
        let sticking = contacts.iter().filter(|contact| contact.sticks).count();
        assert!((2..=10).contains(&sticking), "{sticking}");
        both.push(accelerations);
    }
    for (one, other) in both[0].iter().zip(&both[1]) {
        assert_near(*one, *other, 1e-11);
    }
}

/// As the ground is driven harder and harder, the surfaces of a stack break away from the top to the bottom: with the slab above sliding, each
/// when `m a = μ₀ g W − μ₀' g W'`, with the weights W on it and W' on the slab above.
#[test]
fn the_surfaces_of_a_stack_break_away_one_after_the_other() {
    let mu = [0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0];
    let machine = stack(&mu[..8], "J*t^3/6", false);
    let run = run(&machine, &[], &[], (1e-10, 21.0)).expect("it runs");
    let weights = weights(8);
    let known = events(&run);
    assert_eq!(known.len(), 8, "{known:?}");
    for (i, (name, t)) in (0..8).rev().zip(&known) {
        assert_eq!(name, &format!("s{} slides", i + 1));
        let mass = (i + 1) as f64 / 3.0;
        let most = G * (mu[i] * weights[i] - mu[i + 1] * weights[i + 1]) / mass;
        // The margin is linear in time; it differs from the closed form by the rounding of forces of up to 120 N, which change by 1 N/s.
        assert_near(*t, most / 3.0, 1e-12);
    }
}

/// Wedges on wedges: the reaction of each depends on the friction of all.
struct Wedges {
    slopes: Vec<f64>,
    masses: Vec<f64>,
    mu: Vec<f64>,
    /// By how much each is lifted, in N.
    lifts: Vec<f64>,
}

impl Wedges {
    /// So many wedges, each of which is lifted by up to a given force.
    fn drawn(random: &mut SplitMix, count: usize, lift: f64) -> Wedges {
        let mut list = |from: f64, to: f64| -> Vec<f64> {
            (0..count).map(|_| random.uniform(from, to)).collect()
        };
        Wedges {
            slopes: list(-0.05, 0.05),
            masses: list(0.5, 2.0),
            mu: list(0.05, 0.25),
            lifts: list(0.0, lift),
        }
    }

    /// What each wedge says, and what it stands on.
    fn lines(&self, line: &dyn Fn(usize, [f64; 2]) -> String) -> String {
        let angles = self.slopes.iter().enumerate();
        let lines = angles.map(|(i, slope)| line(i, [slope.cos(), slope.sin()]));
        lines.collect::<Vec<_>>().join(", ")
    }

    fn forces(&self) -> String {
        let lift = |i: usize| format!("l{i} {{ at: b{i}.at, force: (0*N, {}*N) }}", self.lifts[i]);
        self.lines(&|i, _| lift(i))
    }

    /// Wedges that may leave each other, and lie on each other, some also below the one on which they lie, as in a slot.
    fn touching(&self, is_in_slot: bool) -> InterpretedMachine {
        let to = |word: &str, i: usize| match i {
            0 => format!("{word}0"),
            i => format!("({word}{i} - {word}{})", i - 1),
        };
        let rate = |word: &str, i: usize| match i {
            0 => format!("der({word}0)"),
            i => format!("(der({word}{i}) - der({word}{}))", i - 1),
        };
        let contacts = self.lines(&|i, [cos, sin]| {
            let mu = self.mu[i];
            let above = format!("{cos}*{} - ({sin})*{}", to("y", i), to("x", i));
            let slip = format!("{cos}*{} + ({sin})*{}", rate("x", i), rate("y", i));
            let one = |word: &str, gap: String| {
                format!("{word}{i} {{ gap: {gap}, slip: {slip}, restitution: 0, friction: {mu} }}")
            };
            if is_in_slot {
                [one("c", above.clone()), one("d", format!("-({above})"))].join(", ")
            } else {
                one("c", above)
            }
        });
        machine(&format!(
            "machine Touching in plane {{
                parameters {{ g: m/s^2 = {G} }}
                coordinates {{ {} }}
                bodies {{ {} }}
                gravity (0, -g);
                forces {{ {} }}
                contacts {{ {contacts} }}
            }}",
            self.lines(&|i, _| format!("x{i}: m, y{i}: m")),
            self.lines(&|i, _| format!("b{i} {{ mass: {}*kg, at: (x{i}, y{i}) }}", self.masses[i])),
            self.forces(),
        ))
    }

    /// The same motion as that of the ground coordinates of all wedges.
    fn in_the_plane(&self, along: &[f64]) -> Vec<f64> {
        let (mut x, mut y) = (0.0, 0.0);
        let places = self.slopes.iter().zip(along);
        let places = places.flat_map(|(slope, along)| {
            (x, y) = (x + slope.cos() * along, y + slope.sin() * along);
            [x, y]
        });
        places.collect()
    }

    fn machine(&self) -> InterpretedMachine {
        let below = |i: usize, word: &str| match i {
            0 => "ground".to_owned(),
            i => format!("{word}{}", i - 1),
        };
        let sliding = self.lines(&|i, [cos, sin]| {
            let (on, mu) = (below(i, "b"), self.mu[i]);
            format!("s{i} {{ body: b{i}, on: {on}, direction: ({cos}, {sin}), friction: {mu} }}")
        });
        machine(&format!(
            "machine Wedges in plane {{
                parameters {{ g: m/s^2 = {G} }}
                coordinates {{ {} }}
                frames {{ {} }}
                bodies {{ {} }}
                gravity (0, -g);
                forces {{ {} }}
                sliding {{ {sliding} }}
            }}",
            self.lines(&|i, _| format!("x{i}: m")),
            self.lines(&|i, [cos, sin]| {
                format!("f{i} = {}.shift({cos}*x{i}, {sin}*x{i})", below(i, "f"))
            }),
            self.lines(&|i, _| format!("b{i} {{ mass: {}*kg, frame: f{i} }}", self.masses[i])),
            self.forces(),
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
            load = [load[0] + m * x, load[1] + m * (y + G) - self.lifts[i]];
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

/// Rates of wedges, some of which rest.
fn rates(random: &mut SplitMix, count: usize, rest: f64) -> Vec<f64> {
    let rate = |_| {
        let v = random.uniform(-0.5, 0.5);
        if v.abs() < rest { 0.0 } else { v }
    };
    (0..count).map(rate).collect()
}

/// Accelerations and forces of wedges on guides.
fn guided(system: &impl System<Vector = Vec<f64>>, v: &Vec<f64>) -> (Vec<f64>, Vec<ContactForce>) {
    let (mut a, mut forces) = (v.clone(), vec![ContactForce::default(); v.len()]);
    let at = At {
        t: 0.0,
        q: &vec![0.0; v.len()],
        v,
        u: &system.default_inputs(),
    };
    contact_forces(system, at, &mut a, &mut [], &mut forces).expect("one motion");
    (a, forces)
}

/// Ten wedges on each other, some of which rest when they are asked, and some of which are pulled off the one below, obey the laws of Newton
/// and Coulomb.
#[test]
fn ten_wedges_obey_the_laws_of_newton_and_coulomb() {
    let mut random = SplitMix::new(11);
    let (mut sticking, mut sliding, mut pulled) = (0, 0, 0);
    for case in 0..4 {
        let wedges = Wedges::drawn(&mut random, 10, 25.0);
        let machine = wedges.machine();
        let system = machine.prepare();
        for _ in 0..25 {
            let v = rates(&mut random, 10, 0.3);
            let (a, forces) = guided(&system, &v);
            wedges.assert_laws(&v, &a, &forces, case);
            for i in (0..10).filter(|i| v[*i] == 0.0) {
                sticking += usize::from(forces[i].sticks);
                sliding += usize::from(!forces[i].sticks);
            }
            pulled += forces.iter().filter(|force| force.normal < 0.0).count();
        }
    }
    let all = [sticking, sliding, pulled];
    assert!(all.iter().all(|number| *number > 50), "{all:?}");
}

/// Wedges that are pressed onto each other are on guides, or lie on each other: both machines have the same accelerations and forces, whatever
/// sticks.
#[test]
fn wedges_on_guides_move_as_wedges_that_lie_on_each_other() {
    let mut random = SplitMix::new(12);
    let mut compared = 0;
    for _ in 0..3 {
        let wedges = Wedges::drawn(&mut random, 8, 0.0);
        let (machine, touching) = (wedges.machine(), wedges.touching(false));
        let (system, touching) = (machine.prepare(), touching.prepare());
        for _ in 0..20 {
            let v = rates(&mut random, 8, 0.3);
            let (a, forces) = guided(&system, &v);
            if forces.iter().any(|force| force.normal < 0.0) {
                continue;
            }
            let mut a_of_all = vec![0.0; 16];
            let at = At {
                t: 0.0,
                q: &vec![0.0; 16],
                v: &wedges.in_the_plane(&v),
                u: &touching.default_inputs(),
            };
            let others = unilateral_forces(&touching, at, &mut a_of_all).expect("they have forces");
            for (one, other) in wedges.in_the_plane(&a).iter().zip(&a_of_all) {
                assert_near(*one, *other, 1e-9);
            }
            for (one, other) in forces.iter().zip(&others) {
                assert_near(one.normal, other.normal, 1e-9);
                assert_near(one.friction, other.friction, 1e-9);
                assert_eq!(one.sticks, other.sticks);
                compared += usize::from(one.sticks);
            }
        }
    }
    assert!(compared > 50, "{compared}");
}

/// Wedges in slots without play touch on both sides, of which the one presses that the guide presses on. What slides determines how both sides
/// share the load: with the least forces. What sticks could be wedged in.
#[test]
fn guides_are_pairs_of_opposite_contacts() {
    let mut random = SplitMix::new(13);
    let mut pulled = 0;
    for _ in 0..4 {
        let wedges = Wedges::drawn(&mut random, 3, 25.0);
        let (machine, touching) = (wedges.machine(), wedges.touching(true));
        let (system, touching) = (machine.prepare(), touching.prepare());
        for _ in 0..20 {
            let v = rates(&mut random, 3, 0.0);
            let (a, forces) = guided(&system, &v);
            let mut a_of_all = vec![0.0; 6];
            let at = At {
                t: 0.0,
                q: &vec![0.0; 6],
                v: &wedges.in_the_plane(&v),
                u: &touching.default_inputs(),
            };
            let others = unilateral_forces(&touching, at, &mut a_of_all).expect("they have forces");
            for (one, other) in wedges.in_the_plane(&a).iter().zip(&a_of_all) {
                assert_near(*one, *other, 1e-8);
            }
            for (one, [above, below]) in forces.iter().zip(others.as_chunks().0) {
                assert_near(one.normal, above.normal - below.normal, 1e-8);
                assert_near(one.normal.abs(), above.normal + below.normal, 1e-8);
                assert_near(one.friction, above.friction + below.friction, 1e-8);
                pulled += usize::from(one.normal < 0.0);
            }
        }
    }
    assert!(pulled > 50, "{pulled}");
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
            parameters {{ M: kg = 1, k: N/m = 100, V: m/s = 0.1, mu: 1 = 0.2, g: m/s^2 = {G} }}
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
        line(&|i| format!("b{i} {{ mass: M, frame: f{i} }}")),
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

/// Blocks on the ground, each of which slides to rest by itself.
fn blocks(count: usize) -> String {
    let line = |line: &dyn Fn(usize) -> String| {
        let lines: Vec<String> = (0..count).map(line).collect();
        lines.join(", ")
    };
    format!(
        "machine Blocks in plane {{
            parameters {{ g: m/s^2 = {G} }}
            coordinates {{ {} }}
            bodies {{ {} }}
            gravity (0, -g);
            sliding {{ {} }}
        }}",
        line(&|i| format!("x{i}: m = 0, der(x{i}): m/s = {}", 1 + i % 5)),
        line(&|i| format!("b{i} {{ mass: 1, at: (x{i}, 0) }}")),
        line(&|i| format!("s{i} {{ body: b{i}, on: ground, direction: (1, 0), friction: 0.5 }}")),
    )
}

/// Each of the most guides that a machine may have stops at v/(μ g), after v²/(2 μ g); one more is refused by name.
#[test]
fn as_many_guides_as_are_allowed_stop_at_their_times() {
    let run = run(&machine(&blocks(64)), &[], &[], (1e-9, 1.2)).expect("it runs");
    let known = events(&run);
    assert_eq!(known.len(), 64, "{known:?}");
    for i in 0..64 {
        let speed = (1 + i % 5) as f64;
        let name = format!("s{i} sticks");
        let (_, t) = known
            .iter()
            .find(|(event, _)| *event == name)
            .expect("it stops");
        assert_near(*t, speed / (0.5 * G), 1e-12);
        assert_near(
            value(&run.end().q, &format!("x{i}")),
            speed * speed / G,
            1e-12,
        );
    }
    let Err(errors) = spelling::read(&blocks(65)) else {
        panic!("65 are too many");
    };
    let [(code, message)] = &errors[..] else {
        panic!("{errors:?}");
    };
    assert_eq!(*code, Code::TooLarge);
    assert_eq!(message, "65 contacts that stick or slide are too many");
}
