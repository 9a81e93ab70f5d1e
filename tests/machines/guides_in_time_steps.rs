//! Guides beside unilateral contacts in time stepping: closed forms, the same machines written without guides, and runs that locate every event.

use crate::support::random::SplitMix;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{ContactEventKind, Machine, Method, Simulation, Solution, System};

use super::guides_and_contacts::{
    BLOCK_AND_STOP, LINKAGE, OBLIQUE, PAINLEVES_ROD, PENDULUM_AND_WALL, assert_near, events,
    machine, of_library, q, v,
};

fn run_by(
    machine: &InterpretedMachine,
    method: &str,
    (longest, tolerance): (f64, f64),
    until: f64,
) -> Solution<InterpretedMachine> {
    Simulation::new(machine)
        .method(Method::named(method).expect("a method"))
        .longest_step(longest)
        .tolerance(tolerance)
        .energy_balance(true)
        .until(until)
        .run_interpreted(machine.start())
        .unwrap_or_else(|error| panic!("{method}: {error}"))
}

/// By time stepping in steps of this length.
fn stepped(machine: &InterpretedMachine, h: f64, until: f64) -> Solution<InterpretedMachine> {
    run_by(machine, "moreau", (h, 1e-9), until)
}

/// With every event located.
fn located(machine: &InterpretedMachine, until: f64) -> Solution<InterpretedMachine> {
    run_by(machine, "dop853", (f64::INFINITY, 1e-11), until)
}

/// What each contact has lost, with the name.
fn losses(run: &Solution<InterpretedMachine>) -> Vec<(String, f64)> {
    let contacts = run.system().unilateral_contacts();
    let names: Vec<String> = contacts.map(|contact| contact.name.to_owned()).collect();
    let energies = run.contact_energies().iter();
    let lost = energies.map(|own| own.impact_loss + own.friction_loss);
    names.into_iter().zip(lost).collect()
}

/// The lines of contacts together are what is dissipated.
#[track_caller]
fn is_booked(run: &Solution<InterpretedMachine>) {
    let balance = run.energy_balance().expect("a balance");
    let booked: f64 = losses(run).iter().map(|(_, lost)| lost).sum();
    assert_near(
        booked,
        balance.dissipated,
        1e-12 * (balance.dissipated.abs() + balance.exchanged),
    );
}

/// A block slides to and fro between two stops until friction has stopped it: `v² − 2 μ g s` on each way s, and e v at a stop. Forces are constant, so that only the instants of impacts
/// are off, by less than a step, and so the way by less than `(1 + e) v h` and what friction does meanwhile.
#[test]
fn a_block_between_two_stops_is_off_by_less_than_steps_of_its_rates() {
    let text = BLOCK_AND_STOP.replace(
        "stop { gap: L - x, restitution: e }",
        "stop { gap: L - x, restitution: e }, back { gap: L + x, restitution: e }",
    );
    let (mu, g, e) = (0.05, 9.81, 0.8);
    let machine = machine(&text, &[("mu", mu), ("mu0", mu), ("e", e), ("v0", 5.0)]);
    // Where it stops, from a side with a rate towards the other one.
    let (mut square, mut way, mut impacts, mut passed) = (25.0, 1.0, 0, 0.0);
    let end = loop {
        let left = square - 2.0 * mu * g * way;
        let towards = if impacts % 2 == 0 { 1.0 } else { -1.0 };
        if left < 0.0 {
            break towards * (1.0 - way + square / (2.0 * mu * g));
        }
        (square, way) = (e * e * left, 2.0);
        passed += left.sqrt();
        impacts += 1;
    };
    assert!(impacts > 3, "{impacts}");
    let mut errors = Vec::new();
    for h in [4e-3, 1e-3, 2.5e-4] {
        let run = stepped(&machine, h, 12.0);
        let found = [events(&run, "stop").len(), events(&run, "back").len()];
        assert_eq!(found.iter().sum::<usize>(), impacts, "{h}");
        let error = (q(run.end(), "x") - end).abs();
        // What an impact is off grows no more: rates shrink. Rates of the last way decide with 1/(μ g) where it ends.
        let bound = (1.0 + e) * h * passed * (1.0 + 5.0 / (mu * g));
        assert!(error <= bound, "{h}: {error:e} of {bound:e}");
        assert_near(v(run.end(), "x"), 0.0, 1e-15);
        is_booked(&run);
        // All work of friction is that of the guide, and the energy balance closes to rounding.
        let balance = run.energy_balance().expect("a balance");
        assert!(balance.residual().abs() <= 1e-12 * balance.exchanged);
        errors.push(error);
    }
    println!("{errors:?}");
}

/// The same motion of a guide and of a floor under a block that its weight presses down, to rounding, by laws for a step and laws for an instant, with and without static friction.
#[test]
fn a_guide_that_presses_to_one_side_steps_as_a_contact_does() {
    let floor = |text: &str, law: &str| {
        let rail = text.find("    sliding").expect("a guide");
        let end = rail + text[rail..].find('\n').expect("a line");
        let friction = &text[rail..end];
        let friction = &friction[friction.find("friction").expect("friction")..];
        let friction = &friction[..friction.find('}').expect("an end")];
        let contacts = format!(
            "contacts {{ rail {{ point: (0, 0), on: block, along: ground, restitution: 0, {friction} {law} }},"
        );
        let text = format!("{}{}", &text[..rail], &text[end..]);
        text.replace("contacts {", &contacts)
            .replace("v0 }\n    frames", "v0, y: m }\n    frames")
            .replace("ground.shift(x, 0)", "ground.shift(x, y)")
    };
    let upright = BLOCK_AND_STOP.replace("restitution: e", "restitution: e LAW");
    let cases = [
        (upright.as_str(), ""),
        (upright.as_str(), ", law: poisson_glocker"),
        (upright.as_str(), ", order: sequence"),
        (OBLIQUE, ", law: poisson_glocker"),
    ];
    let mut random = SplitMix::new(3);
    for (text, law) in cases {
        for _ in 0..6 {
            let mu = random.uniform(0.0, 0.4);
            let mut settings = vec![
                ("mu", mu),
                ("e", random.uniform(0.3, 1.0)),
                ("v0", random.uniform(4.0, 6.0)),
            ];
            if text == OBLIQUE {
                settings.push(("slope", random.uniform(1.6, 2.4)));
            } else {
                settings.push(("mu0", mu * random.uniform(1.0, 2.0)));
            }
            let texts = [
                text.replace("LAW", law),
                floor(text, law).replace("LAW", law),
            ];
            let [guide, floor] = texts.map(|text| stepped(&machine(&text, &settings), 1e-3, 2.0));
            for place in 0..=20 {
                let t = f64::from(place) / 10.0;
                let [a, b] = [&guide, &floor].map(|run| run.at(t).expect("in the run"));
                // Rounding of two thousand steps.
                assert_near(q(&a, "x"), q(&b, "x"), 1e-11);
                assert_near(v(&a, "x"), v(&b, "x"), 1e-11);
            }
            let mut of_each = [&guide, &floor].map(losses);
            of_each
                .iter_mut()
                .for_each(|of| of.sort_by(|a, b| a.0.cmp(&b.0)));
            for ((name, a), (_, b)) in of_each[0].iter().zip(&of_each[1]) {
                assert!((a - b).abs() <= 1e-9, "{name}: {a} and {b} {settings:?}");
            }
        }
    }
}

/// A block that is pressed up and down, on a guide and between a floor and a ceiling without any play. How two such contacts share a load is undetermined, and the rule for that, (E79), lets at most
/// one of them press: the definition of a guide. The motions agree to rounding.
#[test]
fn a_guide_is_a_pair_of_opposite_contacts_without_any_play() {
    let head = "parameters { H: m = 1, m: kg = 1, mu: 1 = 0.2, mu0: 1 = 0.2, P: N = 30, w: rad/s = 9, g: m/s^2 = 9.81, L: m = 1, e: 1 = 0.6 }";
    let force = "gravity (0, -g); forces { up { at: block.at, force: (0, P*sin(w*t)) } }";
    let guide = format!(
        "machine Guided in plane {{ {head}
            coordinates {{ x: m, der(x): m/s = 3 }}
            frames {{ seat = ground.shift(x, 0) }}
            bodies {{ block {{ mass: m, frame: seat }} }}
            {force}
            sliding {{ rail {{ body: block, on: ground, direction: (1, 0), friction: mu, static_friction: mu0 }} }}
            contacts {{ stop {{ gap: L - x, restitution: e }} }}
        }}"
    );
    let pair = format!(
        "machine Between in plane {{ {head}
            coordinates {{ x: m, der(x): m/s = 3, y: m = H }}
            frames {{ seat = ground.shift(x, y) }}
            bodies {{ block {{ mass: m, frame: seat }} }}
            {force}
            contacts {{
                below {{ gap: y - H, slip: der(x), restitution: 0, friction: mu, static_friction: mu0 }},
                above {{ gap: H - y, slip: der(x), restitution: 0, friction: mu, static_friction: mu0 }},
                stop {{ gap: L - x, restitution: e }},
            }}
        }}"
    );
    let mut random = SplitMix::new(4);
    let (mut switches, mut rests) = (0, 0);
    let h = 1e-3;
    for case in 0..12 {
        let mu = random.uniform(0.1, 0.4);
        let settings = [
            ("mu", mu),
            ("mu0", mu * [1.0, 1.4][case % 2]),
            ("P", random.uniform(12.0, 40.0)),
            ("w", random.uniform(5.0, 30.0)),
            ("e", random.uniform(0.4, 1.0)),
        ];
        let [one, other] = [&guide, &pair].map(|text| stepped(&machine(text, &settings), h, 1.0));
        for place in 0..=50 {
            let t = f64::from(place) / 50.0;
            let [a, b] = [&one, &other].map(|run| run.at(t).expect("in the run"));
            assert_near(q(&a, "x"), q(&b, "x"), 1e-10);
            assert_near(v(&a, "x"), v(&b, "x"), 1e-10);
        }
        let [of_one, of_other] = [&one, &other].map(losses);
        assert_near(of_one[1].1, of_other[0].1 + of_other[1].1, 1e-9);
        // The mean reaction of a step is that in its middle: the forces are, and nothing else moves the block across its rail.
        let get = |name: &str| {
            settings
                .iter()
                .find(|(own, _)| *own == name)
                .expect("set")
                .1
        };
        for step in [10_u32, 300, 700, 990] {
            let t = (f64::from(step) + 0.5) * h;
            let rail = &one.observe(t).expect("in the run").unilateral[1];
            assert!(rail.closed && rail.gap == 0.0);
            let normal = 9.81 - get("P") * (get("w") * t).sin();
            assert_near(rail.normal, normal, 1e-9);
            if !rail.sticks {
                assert_near(rail.friction.abs(), mu * normal.abs(), 1e-9);
            }
        }
        let of_rail = events(&one, "rail");
        let count = |kind| of_rail.iter().filter(|(own, _)| *own == kind).count();
        switches += count(ContactEventKind::Switches);
        rests += count(ContactEventKind::Sticks);
        let known = |kind: ContactEventKind| {
            use ContactEventKind::{Reverses, Slips, Sticks, Switches};
            matches!(kind, Reverses | Slips | Sticks | Switches)
        };
        assert!(of_rail.iter().all(|(kind, _)| known(*kind)), "{of_rail:?}");
        is_booked(&one);
    }
    assert!(switches > 20 && rests > 5, "{switches} {rests}");
}

/// With ever shorter steps, the motion is that of runs that locate every event: carts with pendulums at oblique walls, as coordinates have it and by a constraint, a rail that is shaken, and
/// linkages of two guides of which one carries the other. Where impacts fall within a step is at random, and each error too: sums over some runs fall as a method of order 1 has it, by
/// half of that at least.
#[test]
fn time_steps_converge_to_located_events() {
    let held = "machine Held in plane {
        parameters { M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, e: 1 = 0.5, g: m/s^2 = 9.81, L: m = 0.5, v0: m/s = 0 }
        coordinates { x: m, a: m = -l*sin(1.2), b: m = -l*cos(1.2), der(x): m/s = v0, der(a): m/s = v0 }
        frames { cart = ground.shift(x, 0) }
        bodies { cart { mass: M, frame: cart }, bob { mass: m, at: (a, b) } }
        gravity (0, -g);
        sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }
        constraints { rod: norm(bob.at - cart.at) = l }
        contacts { wall { gap: L - dot(bob.at, (cos(0.3), sin(0.3))), restitution: e } }
    }";
    let shaken = "machine Shaken in plane {
        parameters { L: m = 0.4, m: kg = 1, a: m = 0.01, w: rad/s = 40, mu: 1 = 0.3, e: 1 = 0.5, g: m/s^2 = 9.81, v0: m/s = 0 }
        coordinates { x: m, der(x): m/s = 3 + v0 }
        frames { rail = ground.shift(0, a*cos(w*t)), seat = rail.shift(x, 0) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        sliding { rail { body: block, on: rail, direction: (1, 0), friction: mu } }
        contacts { stop { gap: L - x, restitution: e } }
    }";
    let glocker = ", law: poisson_glocker";
    let cases = [
        (PENDULUM_AND_WALL.replace("LAW", ""), 1.0),
        (PENDULUM_AND_WALL.replace("LAW", glocker), 1.0),
        (PENDULUM_AND_WALL.replace("LAW", ", order: sequence"), 1.0),
        (PENDULUM_AND_WALL.replace("LAW", ", law: stronge"), 1.0),
        (PENDULUM_AND_WALL.replace("LAW", ", law: poisson"), 1.0),
        (held.to_owned(), 1.0),
        (shaken.to_owned(), 0.4),
        (LINKAGE.replace("LAW", ""), 0.8),
        (LINKAGE.replace("LAW", glocker), 0.8),
    ];
    for (text, until) in cases {
        let mut sums = [0.0; 2];
        let mut impacts = 0;
        for start in 0..8 {
            let v0 = 0.11 * f64::from(start);
            let machine = machine(&text, &[("v0", v0)]);
            let exact = located(&machine, until);
            impacts += exact
                .contact_events()
                .iter()
                .filter(|event| event.impact.is_some())
                .count();
            for (h, sum) in [2e-3, 2.5e-4].into_iter().zip(&mut sums) {
                let run = stepped(&machine, h, until);
                is_booked(&run);
                let pairs = run.end().q.values.iter().zip(&exact.end().q.values);
                *sum += pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            }
        }
        println!("{sums:?} {impacts}");
        assert!(impacts >= 8, "{impacts} impacts");
        assert!(sums[1] < 0.25 * sums[0], "{sums:?} {text}");
    }
}

/// In machines of which no contact ever closes time stepping does with guides what runs do that have another law of friction: with static friction, reactions that change
/// their sides, and guides that load each other.
#[test]
fn guides_step_to_what_they_do_without_contacts() {
    let cases = [
        (
            "block_on_incline",
            "far_away - s",
            &[("rate", 0.05)][..],
            8.0,
        ),
        ("stick_slip", "far_away + x", &[], 6.0),
        ("wedge_and_block", "far_away + s", &[], 0.7),
        ("prisms", "far_away + dot(slider.at, (0, 1))", &[], 1.0),
    ];
    for (name, gap, settings, until) in cases {
        let text = of_library(name);
        let end = text.trim_end().rfind('}').expect("the end of a machine");
        let beside = format!(
            "{} parameters {{ far_away: m = 1000 }} contacts {{ far {{ gap: {gap}, restitution: 0 }} }} }}",
            &text[..end]
        );
        let [alone, beside] = [text, beside].map(|text| machine(&text, settings));
        let exact = located(&alone, until);
        let mut errors = Vec::new();
        for h in [4e-3, 5e-4] {
            let run = stepped(&beside, h, until);
            let mut error = 0.0_f64;
            for place in 1..=8 {
                let t = until * f64::from(place) / 8.0;
                let [a, b] = [&exact, &run].map(|run| run.at(t).expect("in the run"));
                let pairs = a.q.values.iter().zip(&b.q.values);
                error = pairs.fold(error, |most, (a, b)| most.max((a - b).abs()));
            }
            errors.push(error);
        }
        println!("{name} {errors:?}");
        // What accelerates uniformly is exact.
        assert!(
            errors[1] < 0.25 * errors[0] || errors[0] < 1e-12,
            "{name}: {errors:?}"
        );
    }
}

/// The row of blocks on one rail, with `N` of them, a stop at one end or both, and restitution between all.
fn row(start: &str, rail: &str, settings: &str, contacts: &str) -> String {
    format!(
        "machine Row in plane {{
            constants {{ N = 5 }}
            parameters {{ m: kg = 1, d: m = 0.1, g: m/s^2 = 9.81, {settings} }}
            coordinates {{ {start} }}
            frames {{ rail = {rail}, seat[i in 1..N] = rail.shift(s[i], 0) }}
            bodies {{ block[i in 1..N] {{ mass: m*(1 + 0.3*i), frame: seat[i] }} }}
            gravity (0, -g);
            sliding {{ on_rail[i in 1..N] {{ body: block[i], on: ground, direction: rail.vector(1, 0), friction: mu }} }}
            contacts {{ pair[i in 1..N-1] {{ gap: s[i+1] - s[i] - d/2, restitution: e }}, {contacts} }}
        }}"
    )
}

/// Runs by events, or by time stepping where that is not possible in reasonable time.
fn handed_over(text: &str, until: f64) -> Solution<InterpretedMachine> {
    let machine = machine(text, &[]);
    Simulation::new(&machine)
        .method(Method::named("dop853").expect("a method"))
        .hand_over()
        .tolerance(1e-9)
        .energy_balance(true)
        .until(until)
        .run_interpreted(machine.start())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Blocks that slide down an inclined rail onto a stop and each other come to rest in contact by ever more impacts in ever less time: the run goes over to time stepping. In the end they lie on
/// each other, and all of their energy is lost.
#[test]
fn blocks_that_pile_up_on_an_inclined_rail_are_handed_over_to_time_steps() {
    let text = row(
        "s[i in 1..N]: m = i*d*(1 + 0.1*i)",
        "ground.turn(0.6)",
        "mu: 1 = 0.2, e: 1 = 0.6",
        "stop { gap: s[1], restitution: e }",
    );
    let run = handed_over(&text, 4.0);
    assert!(
        run.handovers()
            .first()
            .is_some_and(|first| first.step.is_some()),
        "{:?}",
        run.handovers()
    );
    let mut lost = 0.0;
    for i in 1..=5 {
        let k = f64::from(i);
        let [from, to] = [0.1 * k * (1.0 + 0.1 * k), 0.05 * (k - 1.0)];
        // What is closed when time stepping begins or ends is closed to rounding, and each step removes its penetration.
        assert_near(q(run.end(), &format!("s[{i}]")), to, 1e-9);
        assert_near(v(run.end(), &format!("s[{i}]")), 0.0, 1e-12);
        lost += (1.0 + 0.3 * k) * 9.81 * 0.6_f64.sin() * (from - to);
    }
    is_booked(&run);
    let balance = run.energy_balance().expect("a balance");
    assert_near(balance.dissipated, lost, 1e-9 * lost);
}

/// P. Painlevé's rod, whose tip slides in a guide, in a state from which no motion goes on, or several do: as with contacts, the impulses of a step stop the slip at once, by an amount that does not
/// vanish with the step, and lose energy. (Runs by events end there.)
#[test]
fn a_guide_in_painleves_paradox_is_stopped_by_an_impulse() {
    for w0 in [0.0, 6.0] {
        let machine = machine(PAINLEVES_ROD, &[("mu", 1.35), ("w0", w0)]);
        for h in [1e-5, 1e-6] {
            let run = stepped(&machine, h, 100.0 * h);
            // M = [1, −½ sin θ; −½ sin θ, 1/3]: an impulse along the rail that stops the tip turns the rod by 3/2 sin θ of that.
            assert_near(v(run.end(), "x"), 0.0, 1e-12);
            let turned = w0 + 1.5 * 0.8_f64.sqrt();
            // The weight and the rates turn it meanwhile, by less than 100 rad/s².
            assert_near(v(run.end(), "theta"), turned, 100.0 * 100.0 * h);
            assert!(run.energy_balance().expect("a balance").dissipated > 0.1);
        }
    }
}
