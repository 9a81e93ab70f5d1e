//! Guides beside unilateral contacts: closed forms, impulses by hand, and the same machines written in other ways.

use std::fmt::Write;

use crate::support::random::SplitMix;
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{
    ContactEventKind, ContactTrouble, Error, Machine, Method, Simulation, Solution, State, System,
};

/// The tolerance of a step, relative and absolute.
const TOLERANCE: f64 = 1e-11;

pub(super) fn machine(text: &str, settings: &[(&str, f64)]) -> InterpretedMachine {
    let mut machine = InterpretedMachine::from_text(text)
        .build()
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    for (parameter, value) in settings {
        machine.set(parameter, *value).expect("a parameter");
    }
    machine
}

pub(super) fn run_to(
    machine: &InterpretedMachine,
    until: f64,
) -> Result<Solution<InterpretedMachine>, Error> {
    Simulation::new(machine)
        .method(Method::named("dop853").expect("a method"))
        .tolerance(TOLERANCE)
        .energy_balance(true)
        .until(until)
        .run_interpreted(machine.start())
}

/// Runs a machine and checks that its energy balance closes, and that no impact creates energy.
pub(super) fn run(machine: &InterpretedMachine, until: f64) -> Solution<InterpretedMachine> {
    let run = run_to(machine, until).unwrap_or_else(|error| panic!("{error}"));
    is_booked(&run);
    run
}

#[track_caller]
fn is_booked(run: &Solution<InterpretedMachine>) {
    let balance = run.energy_balance().expect("a balance");
    let residual = balance.residual();
    // The tolerance in each step, times the energy exchanged, and rounding.
    let of_steps = TOLERANCE * run.statistics().steps as f64 * balance.exchanged;
    assert!(
        residual.abs() <= balance.explained.max(of_steps),
        "{residual:e} of {:e}",
        balance.explained
    );
    if run.system().unilateral_contacts().len() == 0 {
        return;
    }
    let booked: f64 = (run.contact_energies().iter())
        .map(|own| own.impact_loss + own.friction_loss + own.damping_loss)
        .sum();
    let lost = balance.dissipated;
    assert!(
        (booked - lost).abs() <= 1e-12 * (lost.abs() + balance.exchanged),
        "each contact {booked}, together {lost}"
    );
}

#[track_caller]
pub(super) fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} for {expected}, to {tolerance:e}"
    );
}

pub(super) fn events(
    run: &Solution<InterpretedMachine>,
    contact: &str,
) -> Vec<(ContactEventKind, f64)> {
    let own = run.contact_events().iter();
    let own = own.filter(|event| event.contact == contact);
    own.map(|event| (event.kind, event.state.t)).collect()
}

pub(super) fn q(state: &State<Named>, name: &str) -> f64 {
    state.q.get(name).expect("a coordinate")
}

pub(super) fn v(state: &State<Named>, name: &str) -> f64 {
    state.v.get(name).expect("a coordinate")
}

/// A block on a rail between two stops.
pub(super) const BLOCK_AND_STOP: &str = "machine BlockAndStop in plane {
    parameters { m: kg = 2, L: m = 1, mu: 1 = 0.2, mu0: 1 = 0.25, e: 1 = 0.7, g: m/s^2 = 9.81, v0: m/s = 3 }
    coordinates { x: m, der(x): m/s = v0 }
    frames { seat = ground.shift(x, 0) }
    bodies { block { mass: m, frame: seat } }
    gravity (0, -g);
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu, static_friction: mu0 } }
    contacts { stop { gap: L - x, restitution: e } }
}";

/// `v₁² = v₀² − 2 μ g L` at the stop, `e v₁` after it, and rest where that is used up.
#[test]
fn a_guided_block_is_braked_rebounds_and_stops() {
    let run = run(&machine(BLOCK_AND_STOP, &[]), 10.0);
    let (braking, e, v0) = (0.2 * 9.81, 0.7, 3.0_f64);
    let v1 = (v0 * v0 - 2.0 * braking).sqrt();
    let hit = (v0 - v1) / braking;
    let stop = hit + e * v1 / braking;
    let way = (e * v1).powi(2) / (2.0 * braking);
    let [(ContactEventKind::Impact, t)] = events(&run, "stop")[..] else {
        panic!("{:?}", run.contact_events());
    };
    assert_near(t, hit, 1e-12);
    let of_rail = events(&run, "rail");
    let [
        (ContactEventKind::Reverses, turned),
        (ContactEventKind::Sticks, stopped),
    ] = of_rail[..]
    else {
        panic!("{of_rail:?}");
    };
    assert_eq!(turned, t);
    assert_near(stopped, stop, 1e-11);
    assert_near(q(run.end(), "x"), 1.0 - way, 1e-11);
    assert_near(v(run.end(), "x"), 0.0, 1e-15);
    // The impact is along the rail, and takes nothing from it.
    let [stop_energies, rail] = run.contact_energies() else {
        panic!("two contacts");
    };
    assert_near(
        stop_energies.impact_loss,
        0.5 * 2.0 * v1 * v1 * (1.0 - e * e),
        1e-11,
    );
    assert_near(rail.impact_loss, 0.0, 1e-12);
    let rubbed = 2.0 * braking * (1.0 + way);
    assert_near(rail.friction_loss, rubbed, 1e-10);
}

/// A block on a rail that hits a wall which stands obliquely: its normal has the angle `slope` to the normal of the rail.
pub(super) const OBLIQUE: &str = "machine Oblique in plane {
    parameters { m: kg = 2, L: m = 1, mu: 1 = 0.2, e: 1 = 0.7, g: m/s^2 = 9.81, v0: m/s = 3, slope: rad = 2 }
    coordinates { x: m, der(x): m/s = v0 }
    frames { seat = ground.shift(x, 0), wall = ground.shift(L, 0).turn(slope) }
    bodies { block { mass: m, frame: seat } }
    gravity (0, -g);
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    contacts { stop { point: (0, 0), on: block, along: wall, restitution: e LAW } }
}";

/// The wall presses along `n = (−sin β, cos β)`, the rail takes `N = −Λ cos β` and rubs with `μ |N|`:
/// `m (v⁺ − v⁻) = −Λ sin β + μ Λ |cos β|` with `v⁺ = −e v⁻`.
#[test]
fn an_oblique_wall_loads_the_rail_by_an_impulse_of_either_sign() {
    let (m, mu, e) = (2.0, 0.2, 0.7);
    for slope in [1.2_f64, 2.0, 2.6] {
        let law = OBLIQUE.replace("LAW", "");
        let run = run(&machine(&law, &[("slope", slope)]), 0.5);
        let v1 = (9.0 - 2.0 * mu * 9.81_f64).sqrt();
        let (sin, cos) = slope.sin_cos();
        let impulse = m * (1.0 + e) * v1 / (sin - mu * cos.abs());
        let impact = |name: &str| {
            let mut own = run.contact_events().iter();
            let own = own.find(|event| event.contact == name && event.impact.is_some());
            own.and_then(|event| event.impact).expect("an impact")
        };
        let (wall, rail) = (impact("stop"), impact("rail"));
        assert_near(wall.impulse[0], impulse, 1e-11 * impulse);
        assert_near(rail.impulse[0], -impulse * cos, 1e-11 * impulse);
        assert_near(rail.impulse[1], mu * impulse * cos.abs(), 1e-11 * impulse);
        assert_near(rail.slip[0], v1, 1e-11);
        assert_near(rail.slip[1], -e * v1, 1e-11);
        assert_eq!(rail.gap_rate, [0.0; 2]);
        let lost = 0.5 * m * v1 * v1 * (1.0 - e * e);
        assert_near(wall.loss + rail.loss, lost, 1e-11 * lost);
        // −½ F (w⁻ + w⁺)
        let rubbed = -0.5 * mu * impulse * cos.abs() * v1 * (1.0 - e);
        assert_near(rail.loss, rubbed, 1e-11 * lost);
    }
}

/// The same machine with a contact that is never closed, whose gap is this.
fn with_contact_far_away(text: &str, gap: &str) -> String {
    let end = text.trim_end().rfind('}').expect("the end of a machine");
    let mut longer = text[..end].to_owned();
    write!(
        longer,
        "parameters {{ far_away: m = 1000 }} contacts {{ far {{ gap: {gap}, restitution: 0 }} }} }}"
    )
    .expect("text");
    longer
}

pub(super) fn of_library(name: &str) -> String {
    let path = format!("{}/../machines/{name}.machine", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a machine of the library")
}

const FEWEST: &str = "machine Fewest in plane {
    parameters { M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
    coordinates { x: m, phi: rad = 1.2 }
    frames { cart = ground.shift(x, 0) }
    bodies { cart { mass: M, frame: cart }, bob { mass: m, at: cart.origin + l*(sin(phi), -cos(phi)) } }
    gravity (0, -g);
    sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
}";

const HELD: &str = "machine Held in plane {
    parameters { M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
    coordinates { x: m, a: m = l*sin(1.2), b: m = -l*cos(1.2) }
    frames { cart = ground.shift(x, 0) }
    bodies { cart { mass: M, frame: cart }, bob { mass: m, at: (a, b) } }
    gravity (0, -g);
    sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
    constraints { rod: norm(bob.at - cart.at) = l }
}";

const SHAKEN: &str = "machine Shaken in plane {
    parameters { m: kg = 1, a: m = 0.01, w: rad/s = 40, mu: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates { x: m, der(x): m/s = 3 }
    frames { rail = ground.shift(0, a*cos(w*t)), seat = rail.shift(x, 0) }
    bodies { block { mass: m, frame: seat } }
    gravity (0, -g);
    sliding { rail { body: block, on: rail, direction: (1, 0), friction: mu } }
}";

/// Guides beside a contact that never closes move as they do alone, where another law of friction decides: with sticking and sliding, reactions that change their
/// sides, several guides that load each other, constraints, and a base that is driven.
#[test]
fn guides_beside_an_open_contact_move_as_they_do_alone() {
    let cases = [
        (
            of_library("block_on_incline"),
            "far_away - s",
            &[("rate", 0.05)][..],
            8.0,
        ),
        (of_library("stick_slip"), "far_away + x", &[], 30.0),
        (of_library("wedge_and_block"), "far_away + s", &[], 0.7),
        (
            of_library("prisms"),
            "far_away + dot(slider.at, (0, 1))",
            &[],
            1.0,
        ),
        (FEWEST.to_owned(), "far_away + x", &[], 6.0),
        (HELD.to_owned(), "far_away + dot(bob.at, (0, 1))", &[], 6.0),
        (SHAKEN.to_owned(), "far_away + x", &[], 0.4),
    ];
    for (text, gap, settings, until) in cases {
        let alone = machine(&text, settings);
        let beside = machine(&with_contact_far_away(&text, gap), settings);
        let (one, other) = (run(&alone, until), run(&beside, until));
        let guides = alone.prepare().contacts().len();
        for place in 0..=20 {
            let t = until * f64::from(place) / 20.0;
            let [a, b] = [&one, &other].map(|run| run.at(t).expect("in the run"));
            for (a, b) in a.q.values.iter().zip(&b.q.values) {
                assert_near(*b, *a, 1e-8);
            }
            for (a, b) in a.v.values.iter().zip(&b.v.values) {
                assert_near(*b, *a, 1e-7);
            }
            let a = one.observe(t).expect("in the run").contacts;
            let b = other.observe(t).expect("in the run").unilateral;
            for (a, b) in a.iter().zip(&b[b.len() - guides..]) {
                assert_eq!(a.sticks, b.sticks, "{} at {t}", alone.program().name);
                assert_near(b.normal, a.normal, 1e-6 * (1.0 + a.normal.abs()));
                assert_near(b.friction, a.friction, 1e-6 * (1.0 + a.normal.abs()));
                assert!(b.closed && b.gap == 0.0);
            }
        }
        let [a, b] = [&one, &other].map(|run| run.energy_balance().expect("a balance"));
        assert_near(b.dissipated, a.dissipated, 1e-8 * (1.0 + a.dissipated));
        assert_near(b.work, a.work, 1e-8 * (1.0 + a.work.abs()));
        let times = |run: &Solution<InterpretedMachine>, beside: bool| -> Vec<f64> {
            if beside {
                run.contact_events()
                    .iter()
                    .map(|event| event.state.t)
                    .collect()
            } else {
                run.events().iter().map(|event| event.state.t).collect()
            }
        };
        let (of_one, of_other) = (times(&one, false), times(&other, true));
        assert_eq!(of_one.len(), of_other.len(), "{}", alone.program().name);
        for (a, b) in of_one.iter().zip(&of_other) {
            assert_near(*b, *a, 1e-8);
        }
    }
}

/// Without friction a guide is none: the machine is the same without it.
#[test]
fn a_guide_without_friction_is_no_guide() {
    let rail =
        "    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }\n";
    let with = OBLIQUE.replace("LAW", ", friction: 0.3");
    assert!(with.contains(rail));
    let without = with.replace(rail, "");
    for (mu, is_same) in [(0.0, true), (0.1, false)] {
        let [one, other] = [&with, &without].map(|text| run(&machine(text, &[("mu", mu)]), 2.0));
        let apart = (q(one.end(), "x") - q(other.end(), "x")).abs();
        assert_eq!(apart < 1e-9, is_same, "{mu}: {apart:e}");
    }
}

/// A block that is held on its rail by its weight is a block on a floor: with a floor as a contact, which has no restitution, everything is the same, the impact
/// with a wall that presses it down included, by each law of several contacts at once.
#[test]
fn a_guide_that_presses_to_one_side_is_a_contact() {
    let on_floor = "machine OnFloor in plane {
        parameters { m: kg = 2, L: m = 1, mu: 1 = 0.2, e: 1 = 0.7, g: m/s^2 = 9.81, v0: m/s = 3, slope: rad = 2 }
        coordinates { x: m, der(x): m/s = v0, y: m }
        frames { seat = ground.shift(x, y), wall = ground.shift(L, 0).turn(slope) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        contacts {
            rail { point: (0, 0), on: block, along: ground, restitution: 0, friction: mu LAW },
            stop { point: (0, 0), on: block, along: wall, restitution: e LAW },
        }
    }";
    let mut random = SplitMix::new(seed(3));
    for law in ["", ", law: poisson_glocker"] {
        for _ in 0..6 {
            let settings = [
                ("slope", random.uniform(1.6, 2.4)),
                ("mu", random.uniform(0.0, 0.4)),
                ("e", random.uniform(0.0, 1.0)),
                ("v0", random.uniform(3.0, 5.0)),
            ];
            let [one, other] = [OBLIQUE, on_floor].map(|text| {
                let machine = machine(&text.replace("LAW", law), &settings);
                run_to(&machine, 3.0).unwrap_or_else(|error| panic!("{error} {settings:?}"))
            });
            for place in 0..=12 {
                let t = f64::from(place) / 4.0;
                let [a, b] = [&one, &other].map(|run| run.at(t).expect("in the run"));
                assert_near(q(&a, "x"), q(&b, "x"), 1e-9);
                assert_near(v(&a, "x"), v(&b, "x"), 1e-9);
            }
            let losses = |run: &Solution<InterpretedMachine>, name: &str| {
                let system = run.system();
                let mut names = system
                    .unilateral_contacts()
                    .map(|contact| contact.name.to_owned());
                let place = names.position(|own| own == name).expect("a contact");
                let own = run.contact_energies()[place];
                [own.impact_loss, own.friction_loss]
            };
            for name in ["rail", "stop"] {
                let [a, b] = [&one, &other].map(|run| losses(run, name));
                for (a, b) in a.into_iter().zip(b) {
                    assert_near(a, b, 1e-8);
                }
            }
        }
    }
}

fn seed(default: u64) -> u64 {
    let given = std::env::var("SEED").ok();
    given.and_then(|seed| seed.parse().ok()).unwrap_or(default)
}

/// A cart on a rail with a pendulum whose bob hits a wall, which stands at an angle.
pub(super) const PENDULUM_AND_WALL: &str = "machine PendulumAndWall in plane {
    parameters {
        M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, e: 1 = 0.5, g: m/s^2 = 9.81, L: m = 0.5, b: rad = 0.3,
        phi0: rad = -1.2, v0: m/s = 0,
    }
    coordinates { x: m, der(x): m/s = v0, phi: rad = phi0 }
    frames { cart = ground.shift(x, 0) }
    bodies { cart { mass: M, frame: cart }, bob { mass: m, at: cart.origin + l*(sin(phi), -cos(phi)) } }
    gravity (0, -g);
    sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
    contacts { wall { gap: L - dot(bob.at, (cos(b), sin(b))), restitution: e LAW } }
}";

/// The impulses on the cart and its pendulum by hand: `M (v⁺ − v⁻) = w Λ + τ F` with `γ⁺ = −e γ⁻`, and the vertical momentum of the bob gives N. Of all states of
/// the rail, which may stick, or slip forwards or backwards, one goes with Coulomb's law.
#[test]
fn impulses_on_a_cart_and_its_pendulum_are_those_by_hand() {
    let (heavy, m, e) = (2.0, 1.0, 0.5);
    let mut random = SplitMix::new(seed(5));
    let (mut stuck, mut down) = (0, 0);
    for _ in 0..40 {
        let (b, mu) = (random.uniform(-0.9, 0.9), random.uniform(0.1, 1.0));
        let settings = [("b", b), ("mu", mu), ("v0", random.uniform(-1.0, 1.0))];
        let text = PENDULUM_AND_WALL.replace("LAW", "");
        let run = run_to(&machine(&text, &settings), 1.5).expect("it runs");
        let all = run.contact_events();
        let Some(wall) = all.iter().find(|event| event.contact == "wall") else {
            continue;
        };
        let rail = (all.iter()).find(|event| {
            event.contact == "rail" && event.state.t == wall.state.t && event.impact.is_some()
        });
        let Some(rail) = rail.and_then(|event| event.impact) else {
            panic!("the rail takes part: {all:?}");
        };
        let gap = wall.impact.expect("an impact").gap_rate[0];
        let phi = q(&wall.state, "phi");
        let (sin, cos) = phi.sin_cos();
        // γ = −(cos b) ẋ − (cos φ cos b + sin φ sin b) φ̇, with a length of 1
        let w = [-b.cos(), -(phi - b).cos()];
        let before = [rail.slip[0], (gap - w[0] * rail.slip[0]) / w[1]];
        let matrix = [[heavy + m, m * cos], [m * cos, m]];
        let det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        let solve = |f: [f64; 2]| {
            [
                (matrix[1][1] * f[0] - matrix[0][1] * f[1]) / det,
                (matrix[0][0] * f[1] - matrix[1][0] * f[0]) / det,
            ]
        };
        let (by_wall, by_rail) = (solve(w), solve([1.0, 0.0]));
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        // N = m sin φ Δφ̇ + Λ sin b, as a form of Λ and F
        let n = [m * sin * by_wall[1] + b.sin(), m * sin * by_rail[1]];
        let needed = -(1.0 + e) * gap;
        let mut found = Vec::new();
        // It sticks: Δẋ = −ẋ.
        let (g, h) = ([dot(w, by_wall), dot(w, by_rail)], [by_wall[0], by_rail[0]]);
        let d = g[0] * h[1] - g[1] * h[0];
        let sticking = [
            (needed * h[1] + before[0] * g[1]) / d,
            (-before[0] * g[0] - needed * h[0]) / d,
        ];
        if sticking[1].abs() <= mu * dot(n, sticking).abs() && sticking[0] >= 0.0 {
            found.push(sticking);
        }
        for sign in [-1.0, 1.0] {
            for side in [-1.0, 1.0] {
                // F = −μ sign side N, and N = n₀ Λ + n₁ F.
                let by = -mu * sign * side;
                let share = by * n[0] / (1.0 - by * n[1]);
                let impulse = needed / (g[0] + share * g[1]);
                let both = [impulse, share * impulse];
                let after = before[0] + dot(h, both);
                if impulse >= 0.0 && side * dot(n, both) >= 0.0 && sign * after > 0.0 {
                    found.push(both);
                }
            }
        }
        let own = [wall.impact.expect("an impact").impulse[0], rail.impulse[1]];
        let is_own = |one: &[f64; 2]| (0..2).all(|i| (one[i] - own[i]).abs() <= 1e-9 * own[0]);
        assert!(found.iter().any(is_own), "{own:?} is none of {found:?}");
        assert_near(rail.impulse[0], dot(n, own), 1e-9 * own[0]);
        stuck += usize::from(rail.slip[1] == 0.0 || rail.slip[1].abs() < 1e-12);
        down += usize::from(rail.impulse[0] < 0.0);
    }
    assert!(
        stuck > 3 && down > 3,
        "{stuck} stick, {down} are pressed from above"
    );
}

/// Runs a machine in which no impact and no friction creates energy, with its books closed, and counts its impacts.
pub(super) fn never_gains_energy(text: &str, settings: &[(&str, f64)], until: f64) -> usize {
    let run = run_to(&machine(text, settings), until)
        .unwrap_or_else(|error| panic!("{error} {settings:?}"));
    is_booked(&run);
    assert_eq!(run.warnings(), [], "{settings:?}");
    let (mut impacts, mut losses) = (0, std::collections::BTreeMap::new());
    for event in run.contact_events() {
        if let Some(impact) = event.impact {
            *losses.entry(event.state.t.to_bits()).or_insert(0.0) += impact.loss;
            impacts += 1;
        }
    }
    let exchanged = run.energy_balance().expect("a balance").exchanged;
    for (t, loss) in losses {
        let t = f64::from_bits(t);
        assert!(loss >= -1e-12 * exchanged, "{loss:e} at {t} {settings:?}");
    }
    for own in run.contact_energies() {
        assert!(own.friction_loss >= -1e-12 * exchanged);
    }
    impacts
}

/// With one restitution, or none, no impact and no friction creates energy, and what is lost is booked, whatever the machine.
#[test]
fn random_carts_with_pendulums_never_gain_energy() {
    let mut random = SplitMix::new(seed(7));
    let mut impacts = 0;
    for case in 0..24 {
        let law = [
            ", law: poisson_glocker",
            "",
            ", slip: dot(der(bob.at), (-sin(b), cos(b))), friction: 0.3, law: poisson_glocker",
        ][case % 3];
        let text = PENDULUM_AND_WALL.replace("LAW", law);
        let e = if case % 3 == 1 {
            0.0
        } else {
            random.uniform(0.0, 1.0)
        };
        let b = random.uniform(-0.9, 0.9);
        let settings = [
            ("M", random.uniform(0.5, 3.0)),
            ("b", b),
            ("mu", random.uniform(0.0, 0.7)),
            // On its side of the wall: sin(φ − b) < 1/2.
            ("phi0", random.uniform(-1.5, 0.2).min(b + 0.4)),
            ("v0", random.uniform(-1.0, 2.0)),
            ("e", e),
        ];
        impacts += never_gains_energy(&text, &settings, 3.0);
    }
    assert!(impacts > 20, "{impacts}");
}

/// A block on a rail that is pressed up and down by a force. As a block between a floor and a ceiling it has a little play, and tends to the guide as that does.
#[test]
fn a_guide_is_a_pair_of_opposite_contacts_without_play() {
    let head = "parameters { m: kg = 1, mu: 1 = 0.2, P: N = 30, w: rad/s = 9, g: m/s^2 = 9.81, L: m = 1, e: 1 = 0.6, play: m = 1e-6 }";
    let force = "forces { up { at: block.at, force: (0, P*sin(w*t)) } }";
    let stop = "restitution: e";
    let guide = machine(
        &format!(
            "machine Guided in plane {{ {head}
                coordinates {{ x: m, der(x): m/s = 3 }}
                frames {{ seat = ground.shift(x, 0) }}
                bodies {{ block {{ mass: m, frame: seat }} }}
                gravity (0, -g);
                {force}
                sliding {{ rail {{ body: block, on: ground, direction: (1, 0), friction: mu }} }}
                contacts {{ stop {{ gap: L - x, {stop} }} }}
            }}"
        ),
        &[],
    );
    let run_of = |play: f64| {
        let with_play = machine(
            &format!(
                "machine Between in plane {{ {head}
                    coordinates {{ x: m, der(x): m/s = 3, y: m }}
                    frames {{ seat = ground.shift(x, y) }}
                    bodies {{ block {{ mass: m, frame: seat }} }}
                    gravity (0, -g);
                    {force}
                    contacts {{
                        below {{ gap: y, slip: der(x), restitution: 0, friction: mu }},
                        above {{ gap: play - y, slip: der(x), restitution: 0, friction: mu }},
                        stop {{ gap: L - x, {stop} }},
                    }}
                }}"
            ),
            &[("play", play)],
        );
        run_to(&with_play, 1.0).expect("it runs")
    };
    let exact = run(&guide, 1.0);
    let error = |play: f64| {
        let run = run_of(play);
        (q(exact.end(), "x") - q(run.end(), "x")).abs()
    };
    // Each way across takes a time of (6 play/j)^⅓ with a jerk j, in which nothing rubs.
    let errors = [1e-6, 1e-9, 1e-12].map(error);
    assert!(errors[0] < 0.02, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.2 * pair[0], "{errors:?}");
    }
}

/// Impacts in sequence, with the guide in each.
#[test]
fn impacts_in_sequence_load_the_guide_each() {
    let text = PENDULUM_AND_WALL.replace("LAW", ", order: sequence");
    let one = run(&machine(&text, &[]), 1.0);
    let other = run(&machine(&PENDULUM_AND_WALL.replace("LAW", ""), &[]), 1.0);
    assert!(!one.contact_events().is_empty());
    assert_near(q(one.end(), "x"), q(other.end(), "x"), 1e-10);
}

/// A block that rests at an oblique wall: how much wall and rail hold of each other is undetermined, and the block is held as long as some of it permits. A force that
/// pulls it off grows until the friction of the rail alone does not hold it, `P = μ₀ m g`, and then it leaves the wall at once.
#[test]
fn a_block_at_rest_at_an_oblique_wall_is_held_as_long_as_any_forces_permit() {
    let text = "machine Pulled in plane {
        parameters { m: kg = 2, mu: 1 = 0.2, mu0: 1 = 0.25, g: m/s^2 = 9.81, slope: rad = 2, p: N/s = 3 }
        coordinates { x: m }
        frames { seat = ground.shift(x, 0), wall = ground.turn(slope) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        forces { pull { at: block.at, force: (-p*t, 0) } }
        sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu, static_friction: mu0 } }
        contacts { stop { point: (0, 0), on: block, along: wall, restitution: 0 } }
    }";
    for slope in [1.2, 2.0] {
        let run = run(&machine(text, &[("slope", slope)]), 2.0);
        let leaves = 0.25 * 2.0 * 9.81 / 3.0;
        let all: Vec<_> = run.contact_events().iter().collect();
        let of_rail = events(&run, "rail");
        let [(ContactEventKind::Slips, t)] = of_rail[..] else {
            panic!("{slope}: {all:?}");
        };
        assert_near(t, leaves, 1e-9);
        let [(ContactEventKind::Lifts, lifted)] = events(&run, "stop")[..] else {
            panic!("{slope}: {all:?}");
        };
        assert_near(lifted, leaves, 1e-9);
        // Then x = −∫∫ (p t − μ m g)/m
        let after = 2.0 - leaves;
        let way =
            (3.0 * leaves - 0.2 * 2.0 * 9.81) * after.powi(2) / 4.0 + 3.0 * after.powi(3) / 12.0;
        assert_near(q(run.end(), "x"), -way, 1e-8);
    }
}

/// A cart with a pendulum, thrown against a stop.
const PULLED_BY_ITS_PENDULUM: &str = "machine Pulled in plane {
    parameters { M: kg = 1.85, m: kg = 0.57, l: m = 0.98, d: m = 0.7, mu: 1 = 0.1, g: m/s^2 = 9.81 }
    coordinates { COORDINATES, a: rad = -0.758, der(x): m/s = -2.44 }
    frames { seat = ground.shift(SEAT) }
    bodies { cart { mass: M, frame: seat }, bob { mass: m, at: cart.at + l*(sin(a), -cos(a)) } }
    gravity (0, -g);
    SUPPORT
    contacts { back { gap: x + d, law: poisson_glocker, restitution: 0 } }
}";

/// The events of a run, those of each instant together.
fn instants(run: &Solution<InterpretedMachine>) -> Vec<(f64, Vec<String>)> {
    let mut instants: Vec<(f64, Vec<String>)> = Vec::new();
    for event in run.contact_events() {
        let told = format!("{} {:?}", event.contact, event.kind);
        match instants.last_mut() {
            Some((t, all)) if *t == event.state.t => all.push(told),
            _ => instants.push((event.state.t, vec![told])),
        }
    }
    for (_, all) in &mut instants {
        all.sort();
    }
    instants
}

/// This machine with the cart on a guide, and on a floor that is a contact.
fn on_rail_and_floor(text: &str) -> [String; 2] {
    let guide = "sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }";
    let floor = "contacts { rail { gap: y, slip: der(x), friction: mu, law: poisson_glocker, restitution: 0 } }";
    [("x: m", "x, 0", guide), ("x: m, y: m", "x, y", floor)].map(|(coordinates, seat, support)| {
        text.replace("COORDINATES", coordinates)
            .replace("SEAT", seat)
            .replace("SUPPORT", support)
    })
}

fn run_by(
    machine: &InterpretedMachine,
    method: &str,
    tolerance: f64,
) -> Solution<InterpretedMachine> {
    Simulation::new(machine)
        .method(Method::named(method).expect("a method"))
        .tolerance(tolerance)
        .until(2.0)
        .run_interpreted(machine.start())
        .unwrap_or_else(|error| panic!("{method} at {tolerance:e}: {error}"))
}

/// The tolerance in each step; and the instant at which a shared load lets go is looked for a share of 1e-9 of a step later.
fn error_of_steps(run: &Solution<InterpretedMachine>, tolerance: f64) -> f64 {
    let steps = run.statistics().steps as f64;
    tolerance * steps + 1e-9 / steps
}

/// What happens at each instant, without the time.
fn told(instants: &[(f64, Vec<String>)]) -> Vec<Vec<String>> {
    instants.iter().map(|(_, told)| told.clone()).collect()
}

/// A cart stands at a stop, on a guide or a floor with friction that shares its load with the stop. Its pendulum pulls it off: while it is held, the rod pulls with
/// `T = m (g cos φ + l φ̇²)`, and both let go at one instant, where `T sin φ = μ (M g + T cos φ)`. Which of the two is seen to do so first is for rounding to say, and
/// must not matter.
#[test]
fn a_stop_and_friction_that_share_a_load_let_go_together() {
    let machines = on_rail_and_floor(PULLED_BY_ITS_PENDULUM).map(|text| machine(&text, &[]));
    let best = run_by(&machines[0], "dop853", 1e-13);
    let (of_best, error_of_best) = (instants(&best), 10.0 * error_of_steps(&best, 1e-13));
    for machine in &machines {
        for method in ["dop853", "dopri5", "radau9"] {
            for tolerance in [1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
                let run = run_by(machine, method, tolerance);
                // The pendulum and what follows the times of events enlarge errors of steps.
                let bound = 10.0 * error_of_steps(&run, tolerance) + error_of_best;
                let found = instants(&run);
                assert_eq!(told(&found), told(&of_best), "{method} at {tolerance:e}");
                let [.., (_, let_go), (_, stopped)] = &found[..] else {
                    panic!("{found:?}");
                };
                assert_eq!(let_go[..], ["back Lifts", "rail Slips"]);
                assert_eq!(stopped[..], ["rail Sticks"]);
                for ((t, _), (of_best, _)) in found.iter().zip(&of_best) {
                    assert_near(*t, *of_best, bound);
                }
                for name in ["x", "a"] {
                    assert_near(q(run.end(), name), q(best.end(), name), bound);
                    assert_near(v(run.end(), name), v(best.end(), name), bound);
                }
                let mut all = run.contact_events().iter();
                let lifts = all.find(|event| event.kind == ContactEventKind::Lifts);
                let state = &lifts.expect("it lifts").state;
                let (sin, cos) = q(state, "a").sin_cos();
                let pull = 0.57 * (9.81 * cos + 0.98 * v(state, "a").powi(2));
                let limit = 0.1 * (1.85 * 9.81 + pull * cos);
                // The pull grows by 5 N in a second.
                assert_near(pull * sin, limit, 5.0 * bound);
            }
        }
    }
}

/// An oblique wall presses the cart down on its guide or floor. Where it lets go with the friction, as above, its gap opens with the third power of time, since nothing accelerates the
/// cart yet. What rounding has left of its rate is of either sign, and does not close the wall again.
#[test]
fn an_oblique_wall_that_lets_go_with_friction_does_not_close_again() {
    let (heavy, m, l, g, mu) = (
        0.6915505090848807,
        0.3172192503437447,
        0.98,
        9.81,
        0.2530792088235413,
    );
    let settings = [
        ("M", heavy),
        ("m", m),
        ("d", 0.34557457878175823),
        ("mu", mu),
    ];
    for place in 0..12 {
        let slope = -0.49931988441863107 + 0.02 * f64::from(place);
        let wall =
            format!("point: (0, 0), on: cart, along: ground.shift(-d, 0).turn(-pi/2 + {slope})");
        let text = (PULLED_BY_ITS_PENDULUM.replace("-0.758", "1.3491237998920744"))
            .replace("-2.44", "-2.848152943110237")
            .replace("gap: x + d", &wall);
        for text in on_rail_and_floor(&text) {
            let machine = machine(&text, &settings);
            for method in ["dop853", "dopri5", "radau9"] {
                let run = run_by(&machine, method, 1e-12);
                let all = instants(&run);
                let lets_go = |told: &[String]| told.contains(&"back Lifts".to_owned());
                let released: Vec<_> = all.iter().filter(|(_, told)| lets_go(told)).collect();
                assert!(!released.is_empty(), "{method}, {slope}: {all:?}");
                for (t, told) in released {
                    assert_eq!(told[..], ["back Lifts", "rail Slips"], "{method}, {slope}");
                    let state = run.at(*t).expect("in the run");
                    let (sin, cos) = q(&state, "a").sin_cos();
                    let pull = m * (g * cos + l * v(&state, "a").powi(2));
                    // Forces of some 20 N are known to 1e-11 of themselves; and the instant is looked for a share of 1e-9 of a step later, which is no longer than 0.1 s, while
                    // the pull grows by less than 50 N in a second.
                    assert_near(pull * sin, mu * (heavy * g + pull * cos), 1e-8);
                }
            }
        }
    }
}

/// Random carts at stops, upright or oblique, with static friction or without, do the same whatever the method; and on a floor the same as on a guide, unless they jump.
#[test]
fn random_carts_at_stops_do_the_same_by_each_method() {
    let mut random = SplitMix::new(seed(11));
    let mut let_go = 0;
    for case in 0..24 {
        let settings = [
            ("M", random.uniform(0.5, 3.0)),
            ("m", random.uniform(0.2, 1.5)),
            ("d", random.uniform(0.1, 0.8)),
            ("mu", random.uniform(0.03, 0.4)),
        ];
        let (a, v0) = (random.uniform(-1.4, 1.4), random.uniform(-3.0, -1.0));
        let mut text = (PULLED_BY_ITS_PENDULUM.replace("-0.758", &a.to_string()))
            .replace("-2.44", &v0.to_string());
        let (is_oblique, b) = (case % 2 == 1, random.uniform(-0.5, 0.5));
        if is_oblique {
            let wall =
                format!("point: (0, 0), on: cart, along: ground.shift(-d, 0).turn(-pi/2 + {b})");
            text = text.replace("gap: x + d", &wall);
        }
        let of_each = on_rail_and_floor(&text).map(|text| {
            let text = if case % 3 == 0 {
                text.replace("friction: mu", "friction: mu, static_friction: 1.3*mu")
            } else {
                text
            };
            let machine = machine(&text, &settings);
            let runs = ["dop853", "dopri5", "radau9"].map(|method| run_by(&machine, method, 1e-12));
            let of_first = instants(&runs[0]);
            for run in &runs[1..] {
                assert_eq!(told(&instants(run)), told(&of_first), "{settings:?} {text}");
                // What a random machine makes of errors of steps is not known; impacts and pendulums do not make a hundred times as much of them.
                let bound = error_of_steps(run, 1e-12) + error_of_steps(&runs[0], 1e-12);
                assert_near(q(run.end(), "x"), q(runs[0].end(), "x"), 100.0 * bound);
            }
            (of_first, q(runs[0].end(), "x"))
        });
        let [(rail, x), (floor, x_of_floor)] = of_each;
        let together = ["back Lifts", "rail Slips"];
        let_go += usize::from(rail.iter().any(|(_, told)| told[..] == together));
        if !floor
            .iter()
            .any(|(_, told)| told.contains(&"rail Lifts".to_owned()))
        {
            assert_eq!(told(&rail), told(&floor), "{settings:?}");
            assert_near(x_of_floor, x, 1e-9);
        }
    }
    assert!(let_go > 3, "{let_go}");
}

/// A slide on an arm that turns on a carriage: two guides, of which one carries the other, and five contacts.
pub(super) const LINKAGE: &str = "machine Linkage in plane {
    parameters { m: kg = 2, mu: 1 = 0.3, g: m/s^2 = 9.81, v0: m/s = 2, h: m = 0.1, e: 1 = 0.3, phi0: rad = 0.3, s0: m = 0.5 }
    coordinates { x: m, der(x): m/s = v0, phi: rad = phi0, s: m = s0 }
    frames { seat = ground.shift(x, 0), arm = seat.turn(phi), tip = arm.shift(s, 0) }
    bodies {
        block { mass: m, frame: seat },
        rod { mass: m/2, inertia: m/2*h^2, frame: arm.shift(h, 0) },
        slide { mass: m/4, inertia: m*h^2/10, frame: tip },
    }
    gravity (0, -g);
    sliding {
        rail { body: block, on: ground, direction: (1, 0), friction: mu },
        along { body: slide, on: arm, direction: arm.vector(1, 0), friction: mu },
    }
    contacts {
        right { point: (0, 0), on: slide, along: ground.shift(1.5, 0).turn(pi/2), restitution: e, friction: mu LAW },
        left { point: (0, 0), on: slide, along: ground.shift(-1.5, 0).turn(-pi/2), restitution: e, friction: mu LAW },
        floor { point: (0, 0), on: slide, along: ground.shift(0, -0.4), restitution: e, friction: mu LAW },
        inner { gap: s - 2*h, restitution: e LAW },
        outer { gap: 10*h - s, restitution: e LAW },
    }
}";

/// Linkages fall on the floor, hit walls and the ends of their arms, and come to rest with their books closed.
#[test]
fn random_linkages_never_gain_energy() {
    let mut random = SplitMix::new(seed(9));
    let mut impacts = 0;
    for case in 0..16 {
        let (law, e) = [
            (", law: poisson_glocker", random.uniform(0.0, 1.0)),
            ("", 0.0),
        ][case % 2];
        let settings = [
            ("mu", random.uniform(0.0, 0.5)),
            ("e", e),
            ("v0", random.uniform(-3.0, 3.0)),
            ("h", random.uniform(0.06, 0.12)),
            ("m", random.uniform(0.5, 4.0)),
            ("phi0", random.uniform(-0.6, 1.5)),
            ("s0", random.uniform(0.3, 0.55)),
        ];
        impacts += never_gains_energy(&LINKAGE.replace("LAW", law), &settings, 2.0);
    }
    assert!(impacts > 50, "{impacts}");
}

/// P. Painlevé's rod, whose tip slides in a guide.
pub(super) const PAINLEVES_ROD: &str = "machine Rod in plane {
        parameters { m: kg = 1, l: m = 1, mu: 1 = 0.5, g: m/s^2 = 9.81, far_away: m = 100, w0: rad/s = 0 }
        coordinates { x: m, theta: rad = 1.1071487177940904, der(x): m/s = -1, der(theta): rad/s = w0 }
        frames { tip = ground.shift(x, 0), rod = tip.turn(theta) }
        bodies { rod { mass: m, inertia: m*l^2/12, frame: rod, at: rod.point(l/2, 0) } }
        gravity (0, -g);
        sliding { rail { body: rod, on: ground, direction: (1, 0), friction: mu } }
        contacts { far { gap: far_away + x, restitution: 0 } }
    }";

/// The rod, pushed to the side to which it leans, has no motion where `1 + 3 cos θ (cos θ − μ sin θ) < 0`, that is for μ above 4/3 at
/// `tan θ = 2`, and several where it turns so fast that it would lift.
#[test]
fn where_friction_leaves_no_motion_or_several_the_run_ends() {
    for (mu, w0, moves) in [(1.3, 0.0, true), (1.35, 0.0, false), (1.35, 6.0, false)] {
        let result = run_to(&machine(PAINLEVES_ROD, &[("mu", mu), ("w0", w0)]), 1e-3);
        match result {
            Ok(_) if moves => {}
            Err(Error::Contact {
                contact,
                trouble: ContactTrouble::Paradox,
                t,
                ..
            }) if !moves => {
                assert_eq!((contact.as_str(), t), ("rail", 0.0));
            }
            other => panic!("{mu} {w0}: {:?}", other.map(|run| run.end().t)),
        }
    }
}
