//! Guides beside contacts: derivatives against closed forms, and against differences of runs.

use lagrangian::interpreted::{InterpretedMachine, Signals};
use lagrangian::{Machine, Simulation};
use lagrangian_scalar::{Dual, Scalar};

use super::{By, across, agrees};
use crate::of;

/// A block that is braked on its rail, rebounds from a stop, and comes to rest.
const BLOCK_AND_STOP: &str = "machine BlockAndStop in plane {
    parameters { m: kg = 2, L: m = 1, mu: 1 = 0.2, e: 1 = 0.7, g: m/s^2 = 9.81, v0: m/s = 3 }
    coordinates { x: m, der(x): m/s = v0 }
    bodies { block { mass: m, at: (x, 0) } }
    gravity (0, -g);
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    contacts { stop { gap: L - x, restitution: e } }
}";

/// `v₁² = v₀² − 2 μ g L` at the stop and `e v₁` after it; in between a parabola, and in the end rest at `L − (e v₁)²/(2 μ g)`.
#[test]
fn a_guided_block_changes_as_its_closed_form_does() {
    let machine = of("block_and_stop.machine", BLOCK_AND_STOP);
    let signals = Signals::default();
    let names = ["L", "mu", "e", "g", "v0"];
    let values = [1.0, 0.2, 0.7, 9.81, 3.0];
    let run = across(&machine, &signals, &names.map(By::Parameter), 2.0, 1e-12);
    let run = run.expect("derivatives");
    for k in 0..names.len() {
        let mut numbers = values.map(Dual::<f64>::constant);
        numbers[k].derivative = numbers[k].value;
        let [length, mu, e, g, v0] = numbers;
        let number = Dual::<f64>::constant;
        let two = number(2.0);
        let braking = mu * g;
        let v1 = (v0 * v0 - two * braking * length).sqrt();
        let hit = (v0 - v1) / braking;
        let before = |t: f64| number(t) * (v0 - braking * number(t) / two);
        let after = |t: f64| {
            let later = number(t) - hit;
            length - later * (e * v1 - braking * later / two)
        };
        let rest = length - e * v1 * e * v1 / (two * braking);
        // It hits the stop at 0.388 s and rests from 1.187 s on.
        for (t, truth) in [
            (0.3, before(0.3)),
            (0.5, after(0.5)),
            (1.1, after(1.1)),
            (1.5, rest),
            (2.0, rest),
        ] {
            let own = run.at(t).expect("a state").q[1 + k];
            let off = (own - truth.derivative).abs();
            // Parabolas are followed exactly; the instant of rest is found by the slip, to round-off.
            assert!(
                off < 1e-9 * truth.derivative.abs().max(1.0),
                "{t} {}: {own} {truth:?}",
                names[k]
            );
        }
    }
}

/// A block that is pulled off its rail ever harder, until the rail holds it down.
const LIFTED: &str = "machine Lifted in plane {
    parameters { m: kg = 2, L: m = 20, mu: 1 = 0.2, g: m/s^2 = 9.81, v0: m/s = 3, p: N/s = 10 }
    coordinates { x: m, der(x): m/s = v0 }
    bodies { block { mass: m, at: (x, 0) } }
    gravity (0, -g);
    forces { pull { at: block.at, force: (0, p*t) } }
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    contacts { stop { gap: L - x, restitution: 0 } }
}";

/// The reaction m g − p t changes its sign, and the friction μ |m g − p t| its derivative.
#[test]
fn a_block_whose_rail_comes_to_hold_it_down_changes_as_its_closed_form_does() {
    let machine = of("lifted.machine", LIFTED);
    assert_eq!(
        kinds(&machine, 3.0),
        [lagrangian::ContactEventKind::Switches]
    );
    let signals = Signals::default();
    let names = ["m", "mu", "g", "v0", "p"];
    let until = 3.0;
    let run = across(&machine, &signals, &names.map(By::Parameter), until, 1e-12);
    let run = run.expect("derivatives");
    for k in 0..names.len() {
        let mut numbers = [2.0, 0.2, 9.81, 3.0, 10.0].map(Dual::<f64>::constant);
        numbers[k].derivative = numbers[k].value;
        let [m, mu, g, v0, p] = numbers;
        let [two, six] = [2.0, 6.0].map(Dual::<f64>::constant);
        let turns = m * g / p;
        let v1 = v0 - mu * (g * turns - p * turns * turns / (two * m));
        let x1 =
            v0 * turns - mu * (g * turns * turns / two - p * turns * turns * turns / (six * m));
        let later = Dual::constant(until) - turns;
        let truth = x1 + v1 * later - mu * p * later * later * later / (six * m);
        let own = run.end().q[1 + k];
        // The method follows a cubic exactly.
        assert!(
            (own - truth.derivative).abs() < 1e-9 * truth.value,
            "{}: {own} {truth:?}",
            names[k]
        );
    }
}

/// A mass on a spring and a rail, which a force drives against a stop.
const RUBBED: &str = "machine Rubbed in plane {
    parameters {
        m: kg = 1, k: N/m = 4, d: N*s/m = 0.1, F: N = 4, w: rad/s = 2.8, L: m = 0.3, e: 1 = 0.8, mu: 1 = 0.05, g: m/s^2 = 9.81,
    }
    coordinates { x: m = 1, der(x): m/s = 0.5 }
    bodies { mass { mass: m, at: (x, 0) } }
    gravity (0, -g);
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: d, stretch: x } }
    forces { drive { on: x, value: F*cos(w*t) } }
    sliding { rail { body: mass, on: ground, direction: (1, 0), friction: mu } }
    contacts { stop { gap: x + L, restitution: e } }
}";

/// Areas in the state plane shrink by exp(−d t/m) in time, by e² in an impact, and by a⁺/a⁻ where the slip reverses, with the accelerations `a` before and
/// after: there δv⁺ = δv⁻ + (a⁻ − a⁺) δt with δt = −δv⁻/a⁻.
#[test]
fn a_rubbed_oscillator_shrinks_areas_as_liouville_says() {
    use lagrangian::ContactEventKind::{Impact, Reverses};
    let machine = of("rubbed.machine", RUBBED);
    let signals = Signals::default();
    let until = 9.0;
    let base = Simulation::new(&machine)
        .tolerance(1e-12)
        .until(until)
        .run_interpreted(machine.start())
        .expect("a run");
    let (mut truth, mut impacts, mut reversals) = ((-0.1 * until).exp(), 0, 0);
    for event in base.contact_events() {
        let (t, x) = (event.state.t, event.state.q.values[0]);
        match (event.contact.as_str(), event.kind) {
            ("stop", Impact) => {
                truth *= 0.8 * 0.8;
                impacts += 1;
            }
            // A reversal by an impact is not one of this kind.
            ("rail", Reverses) if event.state.v.values[0].abs() < 1e-9 => {
                let [drive, rubs] = [4.0 * (2.8 * t).cos() - 4.0 * x, 0.05 * 9.81];
                truth *= (drive - event.direction * rubs) / (drive + event.direction * rubs);
                reversals += 1;
            }
            ("rail", Reverses) => {}
            (contact, kind) => panic!("{contact} {kind:?}"),
        }
    }
    assert!(impacts >= 3 && reversals >= 3, "{impacts} {reversals}");
    let run = across(
        &machine,
        &signals,
        &[By::Start(0), By::Rate(0)],
        until,
        1e-12,
    );
    let run = run.expect("derivatives");
    let (q, v) = (&run.end().q, &run.end().v);
    let determinant = q[1] * v[2] - q[2] * v[1];
    // Products of derivatives of about 1, each with the error of some hundred steps.
    assert!((determinant - truth).abs() < 1e-8, "{determinant} {truth}");
}

/// A pendulum on a cart whose bob hits a wall: the reaction of the rail changes with the swing, and takes its share of each impact.
const PENDULUM_AND_WALL: &str = "machine PendulumAndWall in plane {
    parameters {
        M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, e: 1 = 0.5, g: m/s^2 = 9.81, L: m = 0.5, b: rad = 0.3,
        phi0: rad = -1.2, v0: m/s = 0,
    }
    coordinates { x: m, der(x): m/s = v0, phi: rad = phi0 }
    frames { cart = ground.shift(x, 0) }
    bodies { cart { mass: M, frame: cart }, bob { mass: m, at: cart.origin + l*(sin(phi), -cos(phi)) } }
    gravity (0, -g);
    sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
    contacts { wall { gap: L - dot(bob.at, (cos(b), sin(b))), restitution: e } }
}";

/// The machine with the bob on a rod, a constraint whose multiplier loads the rail.
const HELD: &str = "machine Held in plane {
    parameters {
        M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, e: 1 = 0.5, g: m/s^2 = 9.81, L: m = 0.5, b: rad = 0.3, v0: m/s = 0,
    }
    coordinates { x: m, der(x): m/s = v0, p: m = -l*sin(1.2), q: m = -l*cos(1.2) }
    frames { cart = ground.shift(x, 0) }
    bodies { cart { mass: M, frame: cart }, bob { mass: m, at: (p, q) } }
    gravity (0, -g);
    sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
    constraints { rod: norm(bob.at - cart.at) = l }
    contacts { wall { gap: L - dot(bob.at, (cos(b), sin(b))), restitution: e } }
}";

fn with(name: &str, text: &str, set: &[(&str, f64)]) -> InterpretedMachine {
    let mut machine = of(name, text);
    for (parameter, value) in set {
        machine.set(parameter, *value).expect("a parameter");
    }
    machine
}

/// The kinds of events of the rail in a run.
fn kinds(machine: &InterpretedMachine, until: f64) -> Vec<lagrangian::ContactEventKind> {
    let run = Simulation::new(machine)
        .tolerance(1e-12)
        .until(until)
        .run_interpreted(machine.start())
        .expect("a run");
    let own = run.contact_events().iter();
    own.filter(|event| event.contact == "rail")
        .map(|event| event.kind)
        .collect()
}

#[test]
fn a_cart_and_its_pendulum_change_as_differences_of_runs_do() {
    use By::Parameter;
    use lagrangian::ContactEventKind::{Impact, Reverses, Slips, Sticks};
    let mut seen = Vec::new();
    for set in [
        &[][..],
        // The impact stops the cart, or turns it round; a slippery and a rough rail; a light cart that the pendulum lifts, so that the rail holds it down.
        &[("mu", 0.6), ("v0", 0.4)],
        &[("mu", 0.05), ("b", -0.4)],
        &[("v0", -1.0), ("b", 0.6), ("e", 0.8)],
        &[("M", 0.05), ("phi0", -2.9), ("g", 4.0)],
    ] {
        let machine = with("pendulum_and_wall.machine", PENDULUM_AND_WALL, set);
        seen.extend(kinds(&machine, 1.2));
        let by = ["mu", "e", "m", "b", "g", "L"].map(Parameter);
        let mut by = [&by[..], &[By::Start(1), By::Rate(1)]].concat();
        // A cart at rest sticks at first, and has no neighbours that slip.
        if set.iter().any(|(name, _)| *name == "v0") {
            by.push(By::Rate(0));
        }
        agrees(
            &machine,
            &format!("a pendulum and a wall, {set:?}"),
            &by,
            1.2,
            1e-6,
        );
    }
    for kind in [Impact, Sticks, Slips, Reverses] {
        assert!(seen.contains(&kind), "no {kind:?}: {seen:?}");
    }
    let machine = with("held.machine", HELD, &[]);
    let by = ["mu", "e", "m", "b", "L"].map(Parameter);
    agrees(&machine, "a pendulum on a rod", &by, 1.0, 1e-6);
}
