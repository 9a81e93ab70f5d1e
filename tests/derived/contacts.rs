//! Machines of macros whose parts collide or yield.
#![cfg(all(feature = "std", feature = "macros"))]

use lagrangian::{Compliance, ContactEventKind, METHODS, Simulation, System};

lagrangian::machine! {
    /// A mass between a wall that yields and one at which it bounces.
    machine Between in plane {
        parameters { m: kg = 2, k: N/m = 800, e: 1 = 0.5 }
        coordinates { x: m = -1, der(x): m/s = 3 }
        bodies { block { mass: m, at: (x, 0) } }
        contacts {
            spring { gap: -x, compliance: linear(k, 0) },
            wall   { gap: x + 2, restitution: e, order: sequence },
        }
    }
}

/// It closes after 1/3 s, is sent back after half a period of π/20 s, reaches the wall 2/3 s later and leaves it with half its
/// speed: by every method, each to its tolerance.
#[test]
fn a_machine_of_a_macro_yields_and_bounces() {
    let machine = Between::default();
    let system = machine.prepare();
    let laws: Vec<_> = system.unilateral_contacts().map(|c| c.compliance).collect();
    assert_eq!(laws, [Some(Compliance::Linear), None]);
    for method in &METHODS {
        let run = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-10)
            .energy_balance(true)
            .until(1.5)
            .run(machine.start())
            .expect("it runs");
        let half = std::f64::consts::PI / 20.0;
        let expected = [
            (ContactEventKind::Closes, 1.0 / 3.0),
            (ContactEventKind::Opens, 1.0 / 3.0 + half),
            (ContactEventKind::Impact, 1.0 + half),
        ];
        let events = run.contact_events();
        assert_eq!(
            events.len(),
            expected.len(),
            "{}: {events:?}",
            method.tableau.name
        );
        for (event, (kind, t)) in events.iter().zip(expected) {
            assert_eq!(event.kind, kind);
            let error = event.state.t - t;
            // At most 10⁴ steps, each within the tolerance, of 3 m/s.
            assert!(
                error.abs() < 1e-6,
                "{}: {kind:?} {error:e}",
                method.tableau.name
            );
        }
        assert!(
            (run.end().v.x - 1.5).abs() < 3e-6,
            "{}",
            method.tableau.name
        );
        let balance = run.energy_balance().expect("it was kept");
        assert!(
            balance.residual().abs() < 2e-5,
            "{}: {balance:?}",
            method.tableau.name
        );
    }
}
