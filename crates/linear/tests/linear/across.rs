//! Derivatives of runs across impacts, against closed forms differentiated by dual numbers, against Liouville's theorem, and
//! against central differences of runs, which are independent of saltation matrices.

mod guides;

use lagrangian::Method;
use lagrangian::interpreted::{InterpretedMachine, Signals};
use lagrangian::{Machine, Simulation, State};
use lagrangian_linear::across::{Across, NoDerivatives, Wanted, run};
use lagrangian_linear::varied::{Direction, Varied};
use lagrangian_scalar::{Dual, Scalar};

use crate::{machine_with, of};

/// The number by which a motion is differentiated.
#[derive(Clone, Copy, Debug)]
enum By<'a> {
    Parameter(&'a str),
    Start(usize),
    Rate(usize),
}

/// The scale of the number: derivatives are taken by the number divided by its scale.
fn size(machine: &InterpretedMachine, by: By<'_>) -> f64 {
    match by {
        By::Parameter(name) => match machine.parameter_values()[parameter(machine, name)].abs() {
            0.0 => 1.0,
            size => size,
        },
        By::Start(_) | By::Rate(_) => 1.0,
    }
}

fn parameter(machine: &InterpretedMachine, name: &str) -> usize {
    let slots = machine.program().parameters.iter();
    let mut names = slots.map(|slot| slot.name.to_string());
    names.position(|own| own == name).expect("a parameter")
}

fn across<'m>(
    machine: &'m InterpretedMachine,
    signals: &'m Signals,
    by: &[By<'_>],
    until: f64,
    tolerance: f64,
) -> Result<Across<'m>, NoDerivatives> {
    let n = machine.program().dimension();
    let directions: Vec<Direction> = (by.iter())
        .map(|by| {
            let mut direction = Direction::of_start(machine);
            if let By::Parameter(name) = *by {
                direction.parameters[parameter(machine, name)] = size(machine, *by);
            }
            direction
        })
        .collect();
    let varied = Varied {
        machine,
        directions: directions.clone(),
        signals,
        phase: None,
    };
    let mut start = varied.start();
    for (k, by) in by.iter().enumerate() {
        match by {
            By::Start(i) => start.q[(k + 1) * n + i] = 1.0,
            By::Rate(i) => start.v[(k + 1) * n + i] = 1.0,
            By::Parameter(_) => {}
        }
    }
    let wanted = Wanted {
        machine,
        signals,
        directions,
        method: <&Method>::default(),
        tolerance,
        until,
        most_steps: 1_000_000,
    };
    run(&wanted, &start)
}

/// The end of a run with a changed number.
fn ends(machine: &InterpretedMachine, by: By<'_>, change: f64, until: f64) -> State<Vec<f64>> {
    let mut machine = machine.clone();
    if let By::Parameter(name) = by {
        let index = parameter(&machine, name);
        let value = machine.parameter_values()[index];
        machine.set(name, value + change).expect("a parameter");
    }
    let mut start = machine.start();
    match by {
        By::Start(i) => start.q.values[i] += change,
        By::Rate(i) => start.v.values[i] += change,
        By::Parameter(_) => {}
    }
    let run = Simulation::new(&machine)
        .tolerance(1e-13)
        .until(until)
        .run_interpreted(start)
        .expect("a run");
    let end = run.end();
    State {
        t: end.t,
        q: end.q.values.clone(),
        v: end.v.values.clone(),
    }
}

/// Compares derivatives at the end of a run with differences of runs over `h`; differences over `h/2` tell how
/// accurate these are.
fn agrees_with_differences(name: &str, set: &[(&str, f64)], by: &[By<'_>], until: f64, h: f64) {
    agrees(&machine_with(name, set), name, by, until, h);
}

/// Compares derivatives of any machine at the end of a run with differences of runs.
fn agrees(machine: &InterpretedMachine, name: &str, by: &[By<'_>], until: f64, h: f64) {
    let signals = Signals::default();
    let run = across(machine, &signals, by, until, 1e-12);
    let run = run.unwrap_or_else(|why| panic!("{name}: {why}"));
    assert!(run.changes() > 0, "{name}: nothing happens");
    let n = machine.program().dimension();
    for (k, by) in by.iter().enumerate() {
        let size = size(machine, *by);
        let difference = |h: f64| -> Vec<f64> {
            let [more, less] = [h, -h].map(|h| ends(machine, *by, h * size, until));
            let pairs = (more.q.iter().chain(&more.v)).zip(less.q.iter().chain(&less.v));
            pairs.map(|(a, b)| (a - b) / (2.0 * h)).collect()
        };
        let (coarse, fine) = (difference(h), difference(0.5 * h));
        let part = (k + 1) * n..(k + 2) * n;
        let own = run.end().q[part.clone()].iter().chain(&run.end().v[part]);
        let largest = fine.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (i, (own, (coarse, fine))) in own.zip(coarse.iter().zip(&fine)).enumerate() {
            // The error of the finer difference is a third of the difference between both, plus the tolerance of a
            // run divided by the distance.
            let known = 2.0 * (coarse - fine).abs() + 1e-13 * 1e3 * largest / h;
            assert!(
                (own - fine).abs() <= known.max(1e-9 * largest),
                "{name}: number {i} by {by:?}: {own:e}, and by differences {fine:e} within {known:e}"
            );
        }
    }
}

/// The height at a given time of a ball that falls from `h` and bounces: its flights are parabolas.
fn bouncing<N: Scalar>([h, e, g]: [N; 3], t: f64, value: fn(N) -> f64) -> N {
    let two = N::from_f64(2.0);
    let mut speed = (two * g * h).sqrt();
    let mut begins = (two * h / g).sqrt();
    let t = N::from_f64(t);
    loop {
        speed = speed * e;
        let flight = two * speed / g;
        if value(t) < value(begins + flight) {
            let later = t - begins;
            return speed * later - g * later * later / two;
        }
        begins = begins + flight;
    }
}

#[test]
fn a_bouncing_ball_changes_as_its_parabolas_do() {
    let machine = machine_with("contacts/bouncing_ball", &[]);
    let signals = Signals::default();
    let by = [By::Start(0), By::Parameter("e"), By::Parameter("g")];
    // √(2h/g) = 0.4515 s, and bouncing ends at 4.06 s.
    let run = across(&machine, &signals, &by, 3.9, 1e-12).expect("derivatives");
    for t in [0.3, 0.9, 1.7, 2.9, 3.3, 3.7, 3.9] {
        let at = run.at(t).expect("a state");
        for k in 0..3 {
            let mut numbers = [1.0, 0.8, 9.81].map(Dual::constant);
            numbers[k].derivative = numbers[k].value;
            let truth = if t < 0.45 {
                let [h, _, g] = numbers;
                h - g * Dual::constant(t * t / 2.0)
            } else {
                bouncing(numbers, t, |x| x.value)
            };
            let off = at.q[1 + k] - truth.derivative;
            // Each of n bounces amplifies the error of the steps before it.
            assert!(
                off.abs() < 1e-9 * truth.derivative.abs().max(1.0),
                "t = {t}, {k}: {} {}",
                at.q[1 + k],
                truth.derivative
            );
        }
    }
}

#[test]
fn a_ball_that_rests_no_longer_changes() {
    let machine = machine_with("contacts/bouncing_ball", &[]);
    let signals = Signals::default();
    let by = [By::Start(0), By::Parameter("e")];
    let run = across(&machine, &signals, &by, 5.0, 1e-11).expect("derivatives");
    let end = run.end();
    for k in 1..=2 {
        assert!(end.q[k].abs() < 1e-7 && end.v[k].abs() < 1e-7, "{end:?}");
    }
}

#[test]
fn a_ball_that_slips_and_then_rolls_changes_as_its_closed_form_does() {
    let machine = machine_with("contacts/bowling_ball", &[]);
    let signals = Signals::default();
    let by = [
        By::Parameter("mu"),
        By::Parameter("speed"),
        By::Parameter("g"),
    ];
    let until = 5.0;
    let run = across(&machine, &signals, &by, until, 1e-12).expect("derivatives");
    for k in 0..3 {
        let mut numbers = [0.1, 8.0, 9.81].map(Dual::constant);
        numbers[k].derivative = numbers[k].value;
        let [mu, speed, g] = numbers;
        let number = Dual::<f64>::constant;
        // From 2 v/(7 μ g) on it rolls with 5/7 of its initial speed.
        let rolls = number(2.0 / 7.0) * speed / (mu * g);
        let slipped = speed * rolls - number(0.5) * mu * g * rolls * rolls;
        let truth = slipped + number(5.0 / 7.0) * speed * (number(until) - rolls);
        let (own, truth) = (run.end().q[3 * (k + 1)], truth.derivative);
        assert!(
            (own - truth).abs() < 1e-9 * truth.abs(),
            "{k}: {own} {truth}"
        );
    }
}

/// Two stones that skim over a floor, dropped from heights `h` and `2 h`: the friction of each impact is μ times its impulse, and so until the stones
/// slow down as if they slid all the time.
const SKIMMING: &str = "machine Skimming in plane {
    parameters { m: kg = 0.3, e: 1 = 0.5, g: m/s^2 = 9.81, mu: 1 = 0.1, h: m = 0.2, speed: m/s = 2.3 }
    coordinates { x[1..2]: m, y[1]: m = h, y[2]: m = 2*h, der(x): m/s = speed }
    bodies { stone[i in 1..2] { mass: m, at: (x[i], y[i]) } }
    gravity (0, -g);
    contacts { floor[i in 1..2] { gap: y[i], slip: der(x[i]), restitution: e, friction: mu } }
}";

/// How far such a stone comes by the time `t`, at which it slides.
fn skims<N: Scalar>([e, g, mu, h, speed]: [N; 5], t: f64) -> N {
    let (one, two) = (N::ONE, N::from_f64(2.0));
    let falls = (two * g * h).sqrt();
    // The impact n comes with the rate `falls eⁿ`, and a flight of `2 falls eⁿ/g` follows it with the next rate; geometric series sum them up.
    let lost = mu * (one + e) * falls / (one - e);
    let flown = falls / g * speed
        + two * falls / g * ((speed - lost) * e / (one - e) + lost * e * e / (one - e * e));
    let slides = N::from_f64(t) - falls / g * (one + e) / (one - e);
    flown + (speed - lost) * slides - mu * g * slides * slides / two
}

/// The last impacts of a sequence are weaker than the round-off of the slip, and the other stone is at rest on the floor meanwhile.
#[test]
fn stones_that_skim_and_then_slide_change_as_their_closed_form_does() {
    let machine = of("skimming.machine", SKIMMING);
    let signals = Signals::default();
    let names = ["e", "g", "mu", "h", "speed"];
    let values = [0.5, 9.81, 0.1, 0.2, 2.3];
    let until = 1.2;
    let run = across(&machine, &signals, &names.map(By::Parameter), until, 1e-12);
    let run = run.expect("derivatives");
    for k in 0..5 {
        let mut numbers = values.map(Dual::constant);
        numbers[k].derivative = numbers[k].value;
        let [e, g, mu, h, speed] = numbers;
        for (stone, height) in [h, h + h].into_iter().enumerate() {
            let truth = skims([e, g, mu, height, speed], until).derivative;
            let own = run.end().q[4 * (k + 1) + stone];
            // A sequence ends when the rates are 1e-9 of the first, after n = 30 impacts. The remainders of the sums change by less than
            // n eⁿ⁻¹ (1 + e)/(1 − e) times their terms, which are below 1 m here.
            let bound = 30.0 * 2e-9 * 3.0;
            assert!((own - truth).abs() < bound, "{}: {own} {truth}", names[k]);
        }
    }
}

/// Areas in the state plane shrink by e² in an impact, and by exp(−d t/m) in between.
#[test]
fn an_impact_oscillator_shrinks_areas_as_liouville_says() {
    let set = [("d", 0.1), ("F", 1.5), ("w", 2.8), ("e", 0.8)];
    let machine = machine_with("contacts/impact_oscillator", &set);
    let signals = Signals::default();
    let until = 7.0;
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
    let impacts = i32::try_from(run.changes()).expect("a few impacts");
    assert!(impacts >= 3);
    let truth = 0.8_f64.powi(2 * impacts) * (-0.1 * until).exp();
    assert!((determinant - truth).abs() < 1e-9, "{determinant} {truth}");
}

/// The saltation matrix of A. B. Nordmark, J. Sound Vib. 145 (1991) 279–297: across an impact δx⁺ = −e δx⁻ and δv⁺
/// = −e δv⁻ + (a⁺ + e a⁻)/v⁻ δx⁻, for instants shortly before and after it with no other change in between.
#[test]
fn an_impact_oscillator_has_the_saltation_matrix_of_nordmark() {
    let set = [("F", 1.5), ("w", 2.8), ("e", 0.6), ("k", 4.0)];
    let machine = machine_with("contacts/impact_oscillator", &set);
    let signals = Signals::default();
    let start = machine.start();
    let first = Simulation::new(&machine)
        .tolerance(1e-13)
        .until(3.0)
        .run_interpreted(start)
        .expect("a run");
    let impact = &first.contact_events()[0];
    let t = impact.state.t;
    let told = impact.impact.expect("an impact");
    let [before, after] = told.gap_rate;
    assert!((after + 0.6 * before).abs() < 1e-12);
    // At the stop the spring is unstretched.
    let a = 1.5 * (2.8 * t).cos();
    let truth = [[-0.6, 0.0], [(a + 0.6 * a) / before, -0.6]];
    // These instants are so near to the impact that the motion in between contributes only δt.
    let by = [By::Start(0), By::Rate(0)];
    let near = 1e-7;
    let matrix = |until: f64| {
        let run = across(&machine, &signals, &by, until, 1e-13).expect("derivatives");
        let (q, v) = (run.end().q.clone(), run.end().v.clone());
        nalgebra::Matrix2::new(q[1], q[2], v[1], v[2])
    };
    let found = matrix(t + near) * matrix(t - near).try_inverse().expect("a regular matrix");
    for i in 0..2 {
        for j in 0..2 {
            let off = found[(i, j)] - truth[i][j];
            assert!(off.abs() < 20.0 * near, "{i}, {j}: {found}");
        }
    }
}

#[test]
fn machines_of_the_library_change_as_differences_of_runs_do() {
    use By::{Parameter, Rate, Start};
    // Slip stops, reverses and begins; contacts lift off; corners of a box, a beak, and a pestle in a mortar touch.
    agrees_with_differences(
        "contacts/disc_over_hump",
        &[],
        &[Parameter("tilt"), Parameter("mu"), Parameter("g")],
        1.6,
        1e-5,
    );
    agrees_with_differences(
        "contacts/shaken_box",
        &[],
        &[
            Start(0),
            Rate(0),
            Parameter("A"),
            Parameter("w"),
            Parameter("e"),
        ],
        0.5,
        1e-6,
    );
    agrees_with_differences(
        "contacts/rolling_out",
        &[("h", 0.02)],
        &[Parameter("rho"), Parameter("speed"), Parameter("h")],
        2.0,
        1e-5,
    );
    agrees_with_differences(
        "contacts/woodpecker",
        &[],
        &[Parameter("c"), Parameter("mu"), Parameter("e")],
        0.1,
        1e-6,
    );
    agrees_with_differences(
        "contacts/colliding_crusher",
        &[],
        &[Parameter("w"), Parameter("eN"), Parameter("mu"), Start(0)],
        0.06,
        1e-7,
    );
    agrees_with_differences(
        "contacts/layered_crusher",
        &[],
        &[Parameter("k1"), Parameter("k2"), Parameter("w")],
        0.06,
        1e-6,
    );
}

#[test]
fn what_has_no_derivative_is_refused_by_name() {
    let refused = |name: &str, set: &[(&str, f64)], by: &[By<'_>], until: f64| -> String {
        let machine = machine_with(name, set);
        let signals = Signals::default();
        match across(&machine, &signals, by, until, 1e-10) {
            Ok(_) => panic!("{name} has derivatives"),
            Err(why) => why.to_string(),
        }
    };
    // The first ball hits the second while that touches the third: the result depends on which pair collides first.
    let said = refused("contacts/newtons_cradle", &[], &[By::Start(2)], 2.0);
    assert!(said.contains("`right` touches at the start"), "{said}");
    // A block that falls flat hits the ground with both corners at once.
    let said = refused(
        "contacts/rocking_block",
        &[("tilt", 0.0)],
        &[By::Start(1)],
        0.1,
    );
    assert!(said.contains("at the start"), "{said}");
    // The oscillator swings from 1 m to −1 m, where it grazes a stop with zero speed.
    let said = refused(
        "contacts/impact_oscillator",
        &[("stop", -1.0 + 3e-9)],
        &[By::Start(0)],
        2.0,
    );
    assert!(
        said.contains("grazed") || said.contains("with zero speed"),
        "{said}"
    );
}
