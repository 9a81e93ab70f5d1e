//! Zeros in disguise: a factor that is zero must not be used to solve for a coordinate or as a divisor.

use lagrangian_mechanics::{Equations, dependents, equations::constraints};
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::Dag;

use crate::harness::compiled;
use crate::machines::assert_proved;

/// Expressions that are zero for all lengths and angles, but do not look it.
const ZEROS: [&str; 4] = [
    "((2*l1*l2 + 2*l1*(l1 - (l1 + l2)))/(l1*l2))",
    "((l1 + l2)^2 - l1^2 - l2^2 - 2*l1*l2)/(l1*l2)",
    "(cos(a - b) - cos(a)*cos(b) - sin(a)*sin(b))",
    "(tan(a)*cos(a) - sin(a) + sin(2*b) - 2*sin(b)*cos(b))",
];

/// Two pendulums, a particle and a block, with further lines.
fn machine(lines: &str) -> String {
    format!(
        "machine Disguised in plane {{
            parameters {{
                m: kg = 1.3, l1: m = 0.7, l2: m = 0.4, k: N/m = 3, g: m/s^2 = 9.81, tau: s = 0.6,
            }}
            coordinates {{ a: rad = 0.3, b: rad = 0.5, x: m = 0.2, y: m = 0.2, w: m = 0.9 }}
            gravity (0, -g);
            {lines}
        }}"
    )
}

const BODIES: &str = "bodies {
    one { mass: m, at: polar(l1, a) }, two { mass: 2*m, at: polar(l2, b) },
    three { mass: 3*m, at: (x, y) }, four { mass: m/2, at: (w, l1*a) },
}";

/// Constraints in which a coefficient decides what is solved for; the factor ZERO is zero.
const PLACES: [&str; 7] = [
    "tie: x - y + ZERO*w = 0",
    "tie: ZERO*w + x - l1*sin(a) = 0",
    "tie: x*y - l1*l2 + ZERO*l1^2*a + ZERO*w^2 = 0",
    "tie: der(x) - 2*der(y) + ZERO*der(w) = 0",
    "tie: der(x)*cos(b) - der(y) + ZERO*der(w) = 0",
    "tie: x - l2*sin(b) + ZERO*tau*der(w) = 0",
    "tie: x - y = 0, other: (1 + ZERO)*w - y + ZERO*l1*a = 0",
];

#[test]
fn no_coordinate_is_settled_by_a_zero() {
    for (place, zero) in PLACES.iter().flat_map(|p| ZEROS.map(|zero| (p, zero))) {
        let constraint = place.replace("ZERO", zero);
        let text = machine(&format!("{BODIES} constraints {{ {constraint} }}"));
        println!("{constraint}");
        compiled(&text, &[], |machine| {
            assert_proved(machine);
            let model = &machine.model;
            let constraints = constraints(model);
            // The same coordinates are settled as without the zero, which removes `w` from
            // all constraints but the last.
            let settled = dependents(model, &constraints);
            let is_w = |i: usize| model.coordinates[i].name.to_string() == "w";
            let may_be_w = place.contains("other");
            assert!(
                may_be_w || settled.iter().all(|d| !is_w(d.coordinate)),
                "{constraint}"
            );
            // If no rates remain, it is a constraint of positions.
            let is_holonomic = !place.contains("der") || place.contains("tau");
            assert_eq!(
                constraints[0].position.is_some(),
                is_holonomic,
                "{constraint}"
            );
        });
    }
}

#[test]
fn what_moves_nothing_has_no_inertia_however_it_is_written() {
    for zero in ZEROS {
        let bodies = BODIES.replace(
            "four { mass: m/2, at: (w, l1*a) }",
            &format!("four {{ mass: m/2, at: (x + {zero}*w, y) }}"),
        );
        let text = machine(&format!(
            "{bodies} springs {{ s {{ stiffness: k, stretch: w }} }}"
        ));
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let files = &mut InMemory::default();
        let model = lagrangian_spec::model(
            &dag,
            "test.machine",
            &text,
            &[],
            files,
            &mut sources,
            &mut report,
        );
        let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        assert!(Equations::derive(&model, &mut report).is_none(), "{zero}");
        let said: Vec<_> = report
            .diagnostics()
            .iter()
            .map(|d| (d.code, d.message.clone()))
            .collect();
        let [(Code::NoInertia, message)] = &said[..] else {
            panic!("{zero}: {said:?}");
        };
        assert!(message.contains("`w`"), "{message}");
    }
}

/// A constraint that vanishes identically determines nothing, and its multiplier must not be decided by rounding: a
/// direct call of the program reports that the multipliers are not unique.
#[test]
fn a_constraint_that_is_zero_throughout_is_not_solved_for() {
    for zero in ZEROS {
        let constraints = format!("constraints {{ tie: x^2 + y^2 = l1^2, none: {zero}*w = 0 }}");
        compiled(
            &machine(&format!("{BODIES} {constraints}")),
            &[],
            |machine| {
                let program = &machine.program;
                let parameters = [1.3, 0.7, 0.4, 3.0, 9.81, 0.6];
                let mut interpreter = Interpreter::new(program, &parameters);
                let (q, v) = ([0.3, 0.5, 0.42, 0.56, 0.9], [0.1, -0.2, 0.4, -0.3, 0.5]);
                let arguments = Arguments {
                    t: 0.0,
                    q: &q,
                    v: &v,
                    u: &[],
                    a: &[],
                };
                let refused = interpreter.call(Role::Accelerations, arguments, &mut [0.0; 5]);
                // The index counts the second constraint after the five coordinates.
                assert_eq!(
                    refused.map_err(|singular| singular.coordinate),
                    Err(6),
                    "{zero}"
                );
                let mut rows = [1.0; 10];
                assert_eq!(
                    interpreter.call(Role::ConstraintMatrix, arguments, &mut rows),
                    Ok(())
                );
                assert_eq!(rows[5..], [0.0; 5], "{zero}");
            },
        );
    }
}
