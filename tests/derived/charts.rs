//! Machines from the macro whose points are in polar coordinates, in runs that pass the centre.

use std::f64::consts::PI;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    Charted, ContactEventKind, EnergyBalance, Error, METHODS, Machine, RADAU_OF_HIGH_ORDER,
    Simulation, State, TAYLOR,
};
use lagrangian_mechanics::Compiled;

lagrangian::machine! {
    /// A particle that nothing moves.
    machine Free in plane {
        parameters { m: kg = 2 }
        coordinates { s: m = 1, phi: rad, der(s): m/s = -1 }
        bodies { particle { mass: m, at: polar(s, phi) } }
        gravity none;
        methods { taylor }
        charts { particle: polar(s, phi) | cartesian(x, y) }
    }
}

lagrangian::machine! {
    /// Two particles on springs, the second of which hangs on a rod from the first; a wall with friction stops the first.
    machine Pair in plane {
        parameters { m: kg = 2, kx: N/m = 8, ky: N/m = 18, l: m = 0.5, wall: m = 0.6, e: 1 = 0.5, mu: 1 = 0.3, F: N = 0.7, b: N*m*s = 0.01 }
        coordinates { s: m = 0.5, phi: rad = 0.1, theta: rad = 0.4, der(s): m/s = -1 }
        inputs { u: N = 0 }
        bodies {
            a { mass: m, at: polar(s, phi) },
            b { mass: m/2, at: a.at + polar(l, theta) },
        }
        gravity none;
        springs { along { stiffness: kx, stretch: s*cos(phi) }, across { stiffness: ky, stretch: s*sin(phi) } }
        dampers { turning { damping: b, stretch: theta } }
        forces { radial { on: s, value: F*s/l + u } }
        contacts { stop { gap: wall - s*cos(phi), slip: der(s*sin(phi)), restitution: e, friction: mu } }
        outputs { height: m = s*sin(phi), momentum: kg*m^2/s = m*s^2*der(phi), out: m/s^2 = der(der(s*cos(phi))) }
        charts { first: polar(s, phi) | cartesian(x, y) }
    }
}

/// The state of a particle on the line x = 1 − t, y = d.
fn on_line(d: f64, t: f64) -> [f64; 4] {
    let (x, s) = (1.0 - t, (1.0 - t).hypot(d));
    [s, d.atan2(x), -x / s, d / (s * s)]
}

/// It moves on a straight line, however near this passes the centre; the steps do not notice.
#[test]
fn a_free_particle_passes_the_centre_on_a_straight_line() {
    let machine = Free::default();
    let cartesian = machine.in_cartesian();
    for method in METHODS.iter().chain(&RADAU_OF_HIGH_ORDER).chain([&TAYLOR]) {
        for d in [1e-12, 1e-3, 0.5] {
            let [s, phi, rate, turning] = on_line(d, 0.0);
            let start = State {
                t: 0.0,
                q: free::Coordinates { s, phi },
                v: free::Coordinates {
                    s: rate,
                    phi: turning,
                },
            };
            let run = Simulation::new(&cartesian)
                .method(method)
                .tolerance(1e-12)
                .until(3.0)
                .every(0.125)
                .energy_balance(true)
                .run_in_charts(&machine, start)
                .expect("it runs");
            assert_eq!(run.start(), start);
            assert!(run.cartesian().statistics().steps < 60);
            let balance = run.cartesian().energy_balance().expect("a balance");
            assert!(balance.residual().abs() < 1e-14);
            let samples = run
                .samples()
                .chain([run.at(1.75).expect("a state"), run.end()]);
            for State { t, q, v } in samples {
                let [s, phi, rate, turning] = on_line(d, t);
                // Rounding of the components, some units of 1e-16, as it is seen from the distance.
                let by = 1e-14 / s;
                assert!((q.s - s).abs() < 1e-14, "{d} {t}: {}", q.s);
                assert!((q.phi - phi).abs() < by, "{d} {t}: {} {phi}", q.phi);
                assert!((v.s - rate).abs() < by, "{d} {t}: {}", v.s);
                assert!((v.phi - turning).abs() < by / s, "{d} {t}: {}", v.phi);
            }
        }
    }
}

/// Exactly through the centre the angle jumps by π, and from the centre the particle leaves along its angle.
#[test]
fn a_free_particle_goes_through_the_centre_itself() {
    let machine = Free::default();
    let cartesian = machine.in_cartesian();
    let simulation = || Simulation::new(&cartesian).until(3.0);
    let run = simulation().run_in_charts(&machine, machine.start());
    let end = run.expect("it runs").end();
    assert!((end.q.s - 2.0).abs() < 1e-14 && (end.v.s - 1.0).abs() < 1e-14);
    assert!((end.q.phi.abs() - PI).abs() < 1e-14, "{}", end.q.phi);
    let at_centre = State {
        t: 0.0,
        q: free::Coordinates { s: 0.0, phi: 0.7 },
        v: free::Coordinates { s: 1.0, phi: 0.0 },
    };
    let run = simulation().run_in_charts(&machine, at_centre);
    let end = run.expect("it runs").end();
    assert!((end.q.s - 3.0).abs() < 1e-14 && (end.q.phi - 0.7).abs() < 1e-14);
}

/// What polar and Cartesian coordinates do not share is refused.
#[test]
fn starts_and_parameters_that_do_not_fit_are_refused() {
    let machine = Free::default();
    let cartesian = machine.in_cartesian();
    assert_eq!(cartesian, free::cartesian::Free { m: 2.0 });
    let run = |machine: &Free, s: f64| {
        let mut start = machine.start();
        start.q.s = s;
        let simulation = Simulation::new(&cartesian).until(1.0);
        simulation
            .run_in_charts(machine, start)
            .map(|run| run.end())
    };
    assert!(run(&machine, 1.0).is_ok());
    let error = run(&machine, -1.0).expect_err("no distance");
    assert!(matches!(error, Error::NegativeDistance { .. }), "{error}");
    assert!(error.to_string().contains("`phi` changed by pi"), "{error}");
    let error = run(&machine, f64::NAN).expect_err("no number");
    assert!(
        matches!(&error, Error::StartNotFinite { name, .. } if name == "s"),
        "{error}"
    );
    let error = run(&Free { m: 3.0 }, 1.0).expect_err("other parameters");
    assert!(matches!(error, Error::OtherParameters { .. }), "{error}");
}

/// The spec of the machine `Pair`, from this file.
fn spec_of_pair() -> String {
    let text = include_str!("charts.rs");
    let from = text.find("machine Pair").expect("the machine");
    let end = text[from..].find("\n    }\n}\n").expect("its end");
    format!("{}\n}}", &text[from..from + end])
}

/// The command runs the interpreted program of the same machine: the numbers are the same to the last bit, with impacts, friction,
/// an input and energy books, and by every method.
#[test]
fn a_run_has_the_numbers_of_the_command() {
    let machine = Pair::default();
    let cartesian = machine.in_cartesian();
    let (dag, mut report) = (lagrangian_symbolic::Dag::new(), Default::default());
    let mut sources = Default::default();
    let text = spec_of_pair();
    let files = &mut lagrangian_spec::source::Disk;
    let model = lagrangian_spec::model(&dag, "pair", &text, &[], files, &mut sources, &mut report);
    let compiled = model.and_then(|model| Compiled::in_charts(model, &mut report));
    let (_, other) = compiled.expect("a machine");
    let interpreted = InterpretedMachine::new(other.expect("a chart").program.clone());
    for method in &METHODS {
        let run = Simulation::new(&cartesian)
            .method(method)
            .until(3.0)
            .every(0.25)
            .inputs(|t, _, _, u| u.u = 0.1 * t)
            .energy_balance(true)
            .run_in_charts(&machine, machine.start())
            .expect("it runs");
        let own = Simulation::new(&interpreted)
            .method(method)
            .until(3.0)
            .every(0.25)
            .inputs(|t, _, _, u| u.values[0] = 0.1 * t)
            .energy_balance(true)
            .run({
                let begun = run.cartesian().start();
                let mut start = interpreted.start();
                start.q.values.copy_from_slice(&begun.q.to_array());
                start.v.values.copy_from_slice(&begun.v.to_array());
                start
            })
            .expect("it runs");
        assert_eq!(own.samples().len(), run.samples().len());
        for (own, sample) in own.samples().iter().zip(run.cartesian().samples()) {
            assert_eq!(own.q.values, sample.q.to_array());
            assert_eq!(own.v.values, sample.v.to_array());
        }
        let (events, of_run) = (own.contact_events(), run.contact_events());
        assert_eq!(events.len(), of_run.len());
        assert!(
            events
                .iter()
                .any(|event| event.kind == ContactEventKind::Impact)
        );
        for (own, event) in events.iter().zip(of_run) {
            assert_eq!((own.kind, own.state.t), (event.kind, event.state.t));
            let (x, [s, phi]) = (own.state.q.values[0], [event.state.q.s, event.state.q.phi]);
            assert!((s * phi.cos() - x).abs() < 1e-14);
            if event.kind == ContactEventKind::Impact {
                // At the wall.
                assert!((x - machine.wall).abs() < 1e-8);
            }
        }
        let [own_balance, balance] =
            [own.energy_balance(), run.cartesian().energy_balance()].map(|of| of.expect("books"));
        let books = |of: &EnergyBalance| [of.start, of.end, of.work, of.dissipated, of.exchanged];
        assert_eq!(books(&own_balance), books(&balance));
        assert!(balance.residual().abs() < 1e-7, "{}", balance.residual());
        let observed = run.cartesian().observe(1.0).expect("an observation");
        let state = run.at(1.0).expect("a state");
        let height = state.q.s * state.q.phi.sin();
        assert!((observed.outputs.height - height).abs() < 1e-14);
        let momentum = machine.m * state.q.s * state.q.s * state.v.phi;
        assert!((observed.outputs.momentum - momentum).abs() < 1e-13);
    }
}

/// Runs in lanes have the bits of runs alone, with their own turns; one that cannot begin does not concern the others.
#[test]
fn runs_in_lanes_pass_the_centre_as_alone() {
    let machines: Vec<Free> = (1..=12).map(|m| Free { m: f64::from(m) }).collect();
    let cartesian: Vec<_> = machines.iter().map(Charted::in_cartesian).collect();
    let start = |k: usize| {
        let [s, phi, rate, turning] = on_line(1e-3 * k as f64, 0.0);
        State {
            t: 0.0,
            q: free::Coordinates {
                s: if k == 5 { -s } else { s },
                phi,
            },
            v: free::Coordinates {
                s: rate,
                phi: turning,
            },
        }
    };
    let runs = || {
        (1..12).map(|k| {
            (
                Simulation::new(&cartesian[k]).until(3.0),
                &machines[k],
                start(k),
            )
        })
    };
    let together = Simulation::run_in_charts_and_lanes(runs().collect());
    for (k, (made, (simulation, machine, start))) in together.into_iter().zip(runs()).enumerate() {
        let alone = simulation.run_in_charts(machine, start);
        match (made, alone) {
            (Ok((made, None)), Ok(alone)) => {
                assert_eq!(made.end(), alone.end());
                assert_eq!(made.at(1.3), alone.at(1.3));
            }
            (made, alone) => {
                assert_eq!(k, 4);
                assert_eq!(made.err(), alone.err());
            }
        }
    }
}
