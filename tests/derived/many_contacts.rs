//! Machines with many contacts, of which a run evaluates those that are near: with the same results, in every engine.

use lagrangian::interpreted::{Engine, InterpretedMachine};
use lagrangian::{
    ContactEvent, ContactEventKind, ContactQuantity, Machine, Method, Simulation, Solution, System,
};

use std::sync::atomic::Ordering;

use crate::by_hand::train::{BALLS, PAIRS, Train};
use crate::support::random::SplitMix;

lagrangian::machine! {
    /// Discs that fall into a bowl.
    machine Heap in plane {
        parameters { m: kg = 0.05, r[i in 1..7]: m = 0.05, d: m = 0.12, R: m = 0.4, e: 1 = 0.3, mu: 1 = 0.3, g: m/s^2 = 9.81 }
        coordinates {
            x[i in 1..7]: m = d*sqrt(i)*cos(2.4*i*rad),
            y[i in 1..7]: m = d*sqrt(i)*sin(2.4*i*rad),
            theta[i in 1..7]: rad,
        }
        bodies { disc[i in 1..7] { mass: m, inertia: m*r[i]^2/2, at: (x[i], y[i]), angle: theta[i] } }
        circles {
            bowl { on: ground, center: (0, 0), radius: R },
            rim[i in 1..7] { on: disc[i], center: (0, 0), radius: r[i] },
        }
        gravity (0, -g);
        contacts {
            wall[i in 1..7] { circle: rim[i], inside: bowl, restitution: e, friction: mu },
            pair { circles: rim, restitution: e, friction: mu },
        }
    }
}

/// Grains between which layers are crushed, in a bowl with a layer.
const LAYERS: &str = "machine Grains in plane {
    parameters { m: kg = 0.05, r[i in 1..6]: m = 0.05, d: m = 0.12, R: m = 0.4, k1: N/m = 400, k2: N/m = 1000, mu: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates {
        x[i in 1..6]: m = d*sqrt(i)*cos(2.4*i*rad),
        y[i in 1..6]: m = d*sqrt(i)*sin(2.4*i*rad),
        theta[i in 1..6]: rad,
    }
    bodies { disc[i in 1..6] { mass: m, inertia: m*r[i]^2/2, at: (x[i], y[i]), angle: theta[i] } }
    circles {
        bowl { on: ground, center: (0, 0), radius: R },
        rim[i in 1..6] { on: disc[i], center: (0, 0), radius: r[i] },
    }
    gravity (0, -g);
    contacts {
        wall[i in 1..6] { circle: rim[i], inside: bowl, compliance: layer(k1, k2), friction: mu },
        pair { circles: rim, compliance: layer(k1, k2), friction: mu },
    }
}";

const HEAP: &str = "machine Heap in plane {
    parameters { m: kg = 0.05, r[i in 1..7]: m = 0.05, d: m = 0.12, R: m = 0.4, e: 1 = 0.3, mu: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates {
        x[i in 1..7]: m = d*sqrt(i)*cos(2.4*i*rad),
        y[i in 1..7]: m = d*sqrt(i)*sin(2.4*i*rad),
        theta[i in 1..7]: rad,
    }
    bodies { disc[i in 1..7] { mass: m, inertia: m*r[i]^2/2, at: (x[i], y[i]), angle: theta[i] } }
    circles {
        bowl { on: ground, center: (0, 0), radius: R },
        rim[i in 1..7] { on: disc[i], center: (0, 0), radius: r[i] },
    }
    gravity (0, -g);
    contacts {
        wall[i in 1..7] { circle: rim[i], inside: bowl, restitution: e, friction: mu },
        pair { circles: rim, restitution: e, friction: mu },
    }
}";

/// Boxes whose corners meet a floor that moves, discs in space, and gaps that are given: whatever contacts are made of.
const BOXES: &str = "machine Boxes in plane {
    constants { N = 5 }
    parameters { a: m = 0.1, g: m/s^2 = 9.81, w: rad/s = 40, b: m = 0.01, far: m = 2 }
    coordinates { x[i in 1..N]: m = 0.3*i, y[i in 1..N]: m = 0.4 + 0.1*i, p[i in 1..N]: rad = 0.3*i }
    frames { floor = ground.shift(0, b*sin(w*t)) }
    bodies { box[i in 1..N] { mass: 1, inertia: 0.002, at: (x[i], y[i]), angle: p[i] } }
    gravity (0, -g);
    contacts {
        foot[i in 1..N] { corners: ((-a, -a), (a, -a), (a, a), (-a, a)), on: box[i], along: floor, restitution: 0.4, friction: 0.2 },
        post[i in 1..N] { gap: far - x[i], restitution: 0.5 },
    }
}";

fn machine(text: &str) -> InterpretedMachine {
    match InterpretedMachine::from_text(text).build() {
        Ok(machine) => machine,
        Err(error) => panic!("{error}"),
    }
}

fn run<M: Machine>(machine: &M, until: f64, method: &str) -> Solution<M> {
    let method_by_name = Method::named(method).expect("a method");
    let mut simulation = Simulation::new(machine)
        .method(method_by_name)
        .until(until)
        .energy_balance(true);
    if method == "moreau" {
        simulation = simulation.longest_step(1e-3);
    }
    match simulation.run(machine.start()) {
        Ok(run) => run,
        Err(error) => panic!("{error}"),
    }
}

/// What happened: when, to which contact, and what.
fn told<C>(events: &[ContactEvent<C>]) -> Vec<(u64, String, ContactEventKind)> {
    let told =
        |event: &ContactEvent<C>| (event.state.t.to_bits(), event.contact.clone(), event.kind);
    events.iter().map(told).collect()
}

/// The numbers of single contacts are those of all contacts together, to the bit, in the interpreter, in machine code and in compiled code, which has no
/// functions for all of them.
#[test]
fn numbers_of_single_contacts_are_those_of_all() {
    let mut random = SplitMix::new(20);
    for text in [HEAP, BOXES, LAYERS] {
        for engine in [Engine::Interpreter, Engine::Jit] {
            let mut machine = machine(text);
            if machine.set_engine(engine).is_err() {
                continue;
            }
            let system = machine.prepare();
            let n = machine.program().dimension();
            for _ in 0..20 {
                let mut numbers =
                    || -> Vec<f64> { (0..n).map(|_| random.uniform(-1.0, 1.0)).collect() };
                let (q, v) = (numbers(), numbers());
                singles_are_those_of_all((&system, &q, &v), (&system, &q, &v), 0.3);
            }
        }
    }
    let (system, whole) = (Heap::default().prepare(), machine(HEAP).prepare());
    for _ in 0..20 {
        let [q, v]: [[f64; 21]; 2] =
            [(); 2].map(|()| std::array::from_fn(|_| random.uniform(-1.0, 1.0)));
        let of_whole = (&whole, &q.to_vec(), &v.to_vec());
        singles_are_those_of_all((&system, &q, &v), of_whole, 0.3);
        let m = system.unilateral_contacts().len();
        let bounds = |least: &dyn Fn(&mut [f64])| {
            let mut bounds = vec![0.0; m];
            least(&mut bounds);
            bounds
        };
        let high = q.map(|q| q + 0.1);
        let (found, expected) = (
            bounds(&|to| system.least_gaps([0.3, 0.4], [&q, &high], to)),
            bounds(&|to| whole.least_gaps([0.3, 0.4], [&q.to_vec(), &high.to_vec()], to)),
        );
        for (found, expected) in found.iter().zip(&expected) {
            // Prepared values are intervals of their rounding here, and of that of their formulas there: numbers of up to 3 m.
            let rounding = 16.0 * f64::EPSILON;
            assert!(found == expected || (found - expected).abs() <= rounding);
        }
    }
}

/// Compares numbers of single contacts of a system with those of all contacts of the same machine, each at the same state.
fn singles_are_those_of_all<S: System, W: System>(
    (system, q, v): (&S, &S::Vector, &S::Vector),
    whole: (&W, &W::Vector, &W::Vector),
    t: f64,
) {
    use lagrangian::Vector;
    assert!(system.single_contacts().is_some(), "it has many contacts");
    let (n, m) = (q.as_slice().len(), system.unilateral_contacts().len());
    for (quantity, width) in [
        (ContactQuantity::Gap, 1),
        (ContactQuantity::Rates, 2),
        (ContactQuantity::Rows, 2 * n),
        (ContactQuantity::Bias, 2),
        (ContactQuantity::Coefficients, 4),
    ] {
        let all = numbers_of_all(whole, quantity, (t, width * m));
        let own = numbers_of_all((system, q, v), quantity, (t, width * m));
        let are_same = |a: &f64, b: &f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        for (i, (own, all)) in own.iter().zip(&all).enumerate() {
            assert!(are_same(own, all), "{quantity:?} {i}: {own:e}, not {all:e}");
        }
        // Every third contact: numbers of the others must not appear among these.
        let which: Vec<usize> = (0..m).filter(|k| k % 3 == 1).collect();
        let mut some = vec![f64::NAN; width * which.len()];
        system.of_contacts(quantity, &which, (t, q, v), &mut some);
        assert!(some.iter().any(|x| *x != 0.0), "{quantity:?} are not all 0");
        for (own, k) in some.chunks_exact(width).zip(&which) {
            for (own, all) in own.iter().zip(&all[width * k..][..width]) {
                assert!(
                    are_same(own, all),
                    "{quantity:?} of {k}: {own:e}, not {all:e}"
                );
            }
        }
    }
}

/// A quantity of all contacts, so many numbers.
fn numbers_of_all<S: System>(
    (system, q, v): (&S, &S::Vector, &S::Vector),
    quantity: ContactQuantity,
    (t, count): (f64, usize),
) -> Vec<f64> {
    let mut all = vec![0.0; count];
    match quantity {
        ContactQuantity::Gap => system.gaps(t, q, &mut all),
        ContactQuantity::Rates => system.contact_rates(t, q, v, &mut all),
        ContactQuantity::Rows => system.contact_matrix(t, q, &mut all),
        ContactQuantity::Bias => system.contact_bias(t, q, v, &mut all),
        _ => system.contact_coefficients(t, q, v, &mut all),
    }
    all
}

/// No gap in a box is below its bound there, and where the box is a point the bound is the gap but for rounding.
#[test]
fn no_gap_is_below_its_bound() {
    let mut random = SplitMix::new(21);
    for text in [HEAP, BOXES] {
        let machine = machine(text);
        let system = machine.prepare();
        let (n, m) = (
            machine.program().dimension(),
            system.unilateral_contacts().len(),
        );
        let (mut least, mut gaps) = (vec![0.0; m], vec![0.0; m]);
        let mut bounded = 0;
        for case in 0..200 {
            let size = [0.0, 1e-9, 1e-3, 0.1, 3.0][case % 5];
            let low: Vec<f64> = (0..n).map(|_| random.uniform(-2.0, 2.0)).collect();
            let high: Vec<f64> = low
                .iter()
                .map(|low| low + size * random.uniform(0.0, 1.0))
                .collect();
            let t = random.uniform(0.0, 3.0);
            let t = [t, t + 0.01 * size];
            system.least_gaps(t, [&low, &high], &mut least);
            bounded += least.iter().filter(|least| least.is_finite()).count();
            for _ in 0..20 {
                let between =
                    |(low, high): (&f64, &f64)| low + (high - low) * random.uniform(0.0, 1.0);
                let q: Vec<f64> = low.iter().zip(&high).map(between).collect();
                let q: Vec<f64> = q
                    .iter()
                    .zip(low.iter().zip(&high))
                    .map(|(q, (low, high))| q.clamp(*low, *high))
                    .collect();
                let at = t[0] + (t[1] - t[0]) * random.uniform(0.0, 1.0);
                system.gaps(at.clamp(t[0], t[1]), &q, &mut gaps);
                for (k, (gap, least)) in gaps.iter().zip(&least).enumerate() {
                    assert!(gap >= least, "contact {k}: {gap:e}, not at least {least:e}");
                    // Some ten operations on numbers of up to 5 m.
                    let rounding = 100.0 * f64::EPSILON * 5.0;
                    assert!(size > 0.0 || least.is_infinite() || gap - least <= rounding);
                }
            }
        }
        assert!(bounded > 100 * m, "most gaps have bounds");
    }
}

/// A run that leaves out far contacts has the events and the bits of one that evaluates all: located or stepped over, interpreted, in machine code,
/// or compiled.
#[test]
fn far_contacts_change_no_bit() {
    for (text, method, until) in [
        (HEAP, "dop853", 0.25),
        (HEAP, "moreau", 0.5),
        (BOXES, "dop853", 0.45),
        (BOXES, "moreau", 0.5),
        (LAYERS, "dop853", 0.4),
    ] {
        let whole = machine(text).without_single_contacts();
        let expected = run(&whole, until, method);
        assert!(expected.contact_events().len() > 20, "something happens");
        for engine in [Engine::Interpreter, Engine::Jit] {
            let mut machine = machine(text);
            if machine.set_engine(engine).is_err() {
                continue;
            }
            let found = run(&machine, until, method);
            assert_eq!(
                told(found.contact_events()),
                told(expected.contact_events())
            );
            assert_eq!(found.end().q, expected.end().q);
            assert_eq!(found.end().v, expected.end().v);
            assert_eq!(found.contact_energies(), expected.contact_energies());
            assert_eq!(
                found.statistics().evaluations,
                expected.statistics().evaluations
            );
        }
        if text == HEAP {
            let found = run(&Heap::default(), until, method);
            assert_eq!(
                told(found.contact_events()),
                told(expected.contact_events())
            );
            assert_eq!(found.end().q.to_array().to_vec(), expected.end().q.values);
        }
    }
}

/// A hammer that moves by itself and flies through a row of balls, in steps as long as the row: it hits ball `i` at `i d/V`, each once, whatever the unit of
/// length is. Behind it, balls fly on at twice its speed.
#[test]
fn what_flies_through_everything_hits_everything() {
    for (d, speed) in [(1.0, 1.0), (1.0, 1e3), (1e-9, 1e-9), (1e6, 1e9)] {
        let text = format!(
            "machine Row in plane {{
                constants {{ N = 20 }}
                parameters {{ d: m = {d:e}, V: m/s = {speed:e} }}
                coordinates {{ x[i in 1..N]: m = i*d }}
                bodies {{ ball[i in 1..N] {{ mass: 1, at: (x[i], 0) }} }}
                contacts {{ hit[i in 1..N] {{ gap: x[i] - V*t, restitution: 1 }} }}
            }}"
        );
        let machine = machine(&text);
        let run = run(&machine, 21.0 * d / speed, "dop853");
        let events = run.contact_events();
        assert_eq!(events.len(), 20, "{d} {speed}: {:?}", told(events));
        for (event, i) in events.iter().zip(1..) {
            assert_eq!(event.kind, ContactEventKind::Impact);
            let t = f64::from(i) * d / speed;
            // The instant is that of a linear function, to the rounding of time.
            assert!(
                (event.state.t - t).abs() <= 64.0 * f64::EPSILON * t,
                "{:e}",
                event.state.t - t
            );
        }
        for v in &run.end().v.values {
            assert!((v - 2.0 * speed).abs() <= 64.0 * f64::EPSILON * speed);
        }
    }
}

/// Arms on a wheel that turns by itself hit balls at rest on the line that their tips reach at 0.9 of their length, at the angles `asin 0.9` behind their own:
/// bounds of gaps hold for what turns, however fast.
#[test]
fn what_turns_hits_everything() {
    let text = "machine Wheel in plane {
        constants { N = 16 }
        parameters { L: m = 2, w: rad/s = 300, phi: rad = 0.2 }
        coordinates { y[i in 1..N]: m = 0.9*L }
        bodies { ball[i in 1..N] { mass: 1, at: (0, y[i]) } }
        contacts { hit[i in 1..N] { gap: y[i] - L*sin(w*t - phi*i), restitution: 1 } }
    }";
    let machine = machine(text);
    // The last arm has come by, and the first one not again.
    let until = (1.3 + 0.2 * 16.0) / 300.0;
    let run = Simulation::new(&machine)
        .longest_step(0.5 / 300.0)
        .until(until)
        .run(machine.start())
        .unwrap_or_else(|error| panic!("{error}"));
    let events = run.contact_events();
    assert_eq!(events.len(), 16, "{:?}", told(events));
    for (event, i) in events.iter().zip(1..) {
        let t = (0.9_f64.asin() + 0.2 * f64::from(i)) / 300.0;
        // The position of a ball at rest is exact; the sine of the arm is known to some units of round-off, at a slope of 0.44.
        assert!(
            (event.state.t - t).abs() <= 1e-13 * t,
            "{:e}",
            event.state.t - t
        );
    }
}

/// Of balls on a line only neighbours meet. Each flight is 0.8 m long, in steps of 0.05 m: a pair that is 1.8 m apart and more is never evaluated by
/// itself, since a box has room for eight steps, or 0.5 m with its margin, around a step. All pairs together are evaluated at the start, and bounds
/// once in eight steps, after a few smaller boxes at the start.
#[test]
fn pairs_that_are_far_are_not_evaluated() {
    let run = |is_single: bool, until: f64| {
        let train = Train {
            is_single,
            ..Train::default()
        };
        let run = Simulation::new(&train)
            .method(Method::named("dop853").expect("a method"))
            .longest_step(0.05)
            .until(until)
            .run(train.start())
            .unwrap_or_else(|error| panic!("{error}"));
        (train, run)
    };
    let (_, expected) = run(false, 10.0);
    let (train, found) = run(true, 10.0);
    assert_eq!(found.contact_events().len(), BALLS - 1);
    assert_eq!(
        told(found.contact_events()),
        told(expected.contact_events())
    );
    assert_eq!(
        (found.end().q, found.end().v),
        (expected.end().q, expected.end().v)
    );
    for (event, k) in found.contact_events().iter().zip(1..) {
        let t = 0.8 * f64::from(k);
        assert!((event.state.t - t).abs() < 1e-13, "{:e}", event.state.t - t);
    }
    let counted = |of: &std::sync::atomic::AtomicUsize| of.load(Ordering::Relaxed);
    for i in 0..BALLS {
        for j in i + 1..BALLS {
            let times = counted(&train.asked.each[i][j]);
            assert_eq!(times > 0, j == i + 1, "pair {i} {j}: {times} times");
        }
    }
    let bounds = counted(&train.asked.bounds);
    assert!(
        bounds <= found.statistics().steps / 8 + 4,
        "{bounds} bounds"
    );
    // How often all are evaluated does not depend on how long the run is.
    let (shorter, _) = run(true, 3.0);
    assert_eq!(
        counted(&train.asked.together),
        counted(&shorter.asked.together)
    );
}

/// Layers between balls on a line, which only neighbours crush: a ball leaves the layer that it has crushed at `e = √(k₁/k₂)` of the rate at which it came, so
/// that balls of equal mass go on at `(1 − e)/2` and `(1 + e)/2` of it. Of the bounds of gaps nothing but the layers that are near is evaluated.
#[test]
fn layers_that_are_far_are_not_evaluated() {
    let run = |is_single: bool, until: f64| {
        let train = Train {
            is_single,
            layers: Some([4e3, 1.6e4]),
            ..Train::default()
        };
        let run = Simulation::new(&train)
            .method(Method::named("dop853").expect("a method"))
            .longest_step(0.05)
            .energy_balance(true)
            .until(until)
            .run(train.start())
            .unwrap_or_else(|error| panic!("{error}"));
        (train, run)
    };
    // The second ball reaches the third 0.8 m later, at less than 0.8 + 0.8/0.75 s.
    let (_, first) = run(true, 1.5);
    let [v1, v2, ..] = first.end().v;
    for (v, expected) in [(v1, 0.25), (v2, 0.75)] {
        // A tolerance of 1e-9 in each of some hundred steps, and a rate of change of up to 45 m/s² within errors of instants.
        assert!((v - expected).abs() < 1e-6, "{v}, not {expected}");
    }
    let crushed: f64 = first
        .contact_energies()
        .iter()
        .map(|own| own.crushing_work)
        .sum();
    // Of the energy of the relative motion, m/4 u², the part 1 − e² is lost.
    assert!((crushed - 0.25 * 0.75).abs() < 1e-6, "{crushed}");

    let (_, expected) = run(false, 6.0);
    let (train, found) = run(true, 6.0);
    assert!(found.contact_events().len() >= 8);
    assert_eq!(
        told(found.contact_events()),
        told(expected.contact_events())
    );
    assert_eq!(
        (found.end().q, found.end().v),
        (expected.end().q, expected.end().v)
    );
    assert_eq!(found.contact_energies(), expected.contact_energies());
    let counted = |of: &std::sync::atomic::AtomicUsize| of.load(Ordering::Relaxed);
    // A run that evaluates all pairs does so at four looks at each step.
    let steps = found.statistics().steps;
    let together = counted(&train.asked.together);
    assert!(together < steps, "{together} in {steps} steps");
    let single = train
        .asked
        .each
        .iter()
        .flatten()
        .map(counted)
        .sum::<usize>();
    assert!(single < PAIRS * steps, "{single} in {steps} steps");
    assert!(counted(&train.asked.each[0][1]) > 0);
}
