//! Machines held by constraints: parts without inertia of their own, and machines that cannot move at all. The reference
//! is the system of M, G, f and γ, solved with row exchanges.

use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape, Singular};

use crate::harness::{compiled, differentiated};
use crate::machines::assert_proved;

/// Points without mass on springs and dampers, tied to masses by strings and rods.
const TIED: [&str; 4] = [
    "machine Spring in plane {
        parameters { l: m = 1.2, k: N/m = 3, m: kg = 2 }
        coordinates { x: m = 0.6, s: m = 0.4 }
        bodies { b { mass: m, at: (x, 0) } }
        springs { a { stiffness: k, stretch: s } }
        constraints { tie: s*cos(s/l) = x^2/l }
    }",
    "machine Point in plane {
        parameters { m: kg = 2, l: m = 0.8, k: N/m = 30, c: N*s/m = 0.7, g: m/s^2 = 9.81, w: rad/s = 4 }
        coordinates { x: m = 0.5, y: m = -0.6, X: m = 0.1, Y: m = 0.2 }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        springs { left { stiffness: k, from: (-1, 0), to: (X, Y) }, up { stiffness: k, stretch: Y } }
        dampers { drag { damping: c, stretch: X } }
        constraints { rod: norm((x - X, y - Y)) = l, slot: Y = 0.2*sin(X/l + w*t)*l }
    }",
    "machine Series in plane {
        parameters { m: kg = 1.5, k: N/m = 7, r: m = 0.3, J: kg*m^2 = 0.02 }
        coordinates { x: m = 0.3, p: m = 0.1, q: m = 0.2, phi: rad = 0.4 }
        bodies { cart { mass: m, at: (x, 0) }, wheel { mass: m, inertia: J, at: (0, 1), angle: phi } }
        springs { a { stiffness: k, stretch: p }, b { stiffness: 2*k, stretch: q - x } }
        constraints { one: p*cos(phi) + q^2/r = x + r, two: der(q)*cos(p/r) = r*der(phi) + der(p) }
    }",
    "machine Turned in plane {
        parameters { m: kg = 1, l: m = 0.5, c: N*m = 2, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.3, y: m = -0.4, psi: rad = 0.6 }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        torsion_springs { hinge { stiffness: c, twist: psi } }
        constraints { across: x*cos(psi) + y*sin(psi) = 0.1*l }
    }",
];

fn call(
    program: &Program,
    role: Role,
    len: usize,
    state: [&[f64]; 2],
) -> Result<Vec<f64>, Singular> {
    let parameters = program.parameters.iter();
    let parameters: Vec<f64> = parameters
        .map(|p| p.default.as_ref().expect("a default").value)
        .collect();
    let mut results = vec![0.0; len];
    let [q, v] = state;
    let arguments = Arguments {
        t: 0.4,
        q,
        v,
        u: &[],
        a: &[],
    };
    Interpreter::new(program, &parameters)
        .call(role, arguments, &mut results)
        .map(|()| results)
}

/// Solves `M a − Gᵀ λ = f`, `G a = γ` by Gaussian elimination with row exchanges and scaled rows.
fn solved(program: &Program, state: [&[f64]; 2]) -> Vec<f64> {
    let (n, m) = (program.dimension(), program.constraints.len());
    let get = |role, len| call(program, role, len, state).expect("nothing is divided");
    let matrix = get(Role::MassMatrix, Shape::Symmetric(n).len());
    let rows = get(Role::ConstraintMatrix, n * m);
    let right = [get(Role::Forces, n), get(Role::ConstraintBias, m)].concat();
    let entry = |i: usize, j: usize| match (i < n, j < n) {
        (true, true) => matrix[Shape::index(i.max(j), i.min(j))],
        (true, false) => -rows[(j - n) * n + i],
        (false, true) => rows[(i - n) * n + j],
        (false, false) => 0.0,
    };
    let mut work: Vec<Vec<f64>> = (0..n + m)
        .map(|i| (0..n + m).map(|j| entry(i, j)).chain([right[i]]).collect())
        .collect();
    for k in 0..n + m {
        let best = (k..n + m).max_by(|&a, &b| work[a][k].abs().total_cmp(&work[b][k].abs()));
        work.swap(k, best.expect("a row"));
        let row = work[k].clone();
        for (i, other) in work.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k] / row[k];
            assert!(factor.is_finite(), "row {i} of a singular system");
            other
                .iter_mut()
                .zip(&row)
                .for_each(|(x, y)| *x -= factor * y);
        }
    }
    (0..n + m).map(|k| work[k][n + m] / work[k][k]).collect()
}

#[test]
fn what_has_no_inertia_is_held_by_constraints() {
    for text in TIED {
        compiled(text, &[], |machine| {
            assert_proved(machine);
            let program = &machine.program;
            let (n, m) = (program.dimension(), program.constraints.len());
            for point in 0..20 {
                let number = |k: usize, low: f64, high: f64| {
                    low + (high - low) * (0.618_034 * (7 * point + 3 * k + 1) as f64).fract()
                };
                let q: Vec<f64> = (0..n).map(|k| number(k, 0.2, 0.7)).collect();
                let v: Vec<f64> = (0..n).map(|k| number(k + n, -1.0, 1.0)).collect();
                let state = [&q[..], &v[..]];
                let truth = solved(program, state);
                let a = call(program, Role::Accelerations, n, state).expect("regular");
                let multipliers = call(program, Role::Multipliers, m, state).expect("regular");
                let largest = truth.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                for (found, truth) in a.iter().chain(&multipliers).zip(&truth) {
                    // A few hundred operations, with a condition number of a few hundred.
                    assert!(
                        (found - truth).abs() < 1e-10 * largest,
                        "{}: {found} {truth}",
                        program.name
                    );
                }
            }
        });
    }
}

#[test]
fn derivatives_pass_through_the_same_elimination() {
    for text in TIED {
        differentiated(text, &[], assert_proved);
    }
}

#[test]
fn what_nothing_holds_is_refused() {
    let free = TIED[0].replace("constraints { tie: s*cos(s/l) = x^2/l }", "");
    let (dag, mut sources) = (
        lagrangian_symbolic::Dag::new(),
        lagrangian_spec::source::Sources::new(),
    );
    let mut report = lagrangian_spec::diagnostic::Report::new();
    let files = &mut lagrangian_spec::source::InMemory::default();
    let model = lagrangian_spec::model(
        &dag,
        "test.machine",
        &free,
        &[],
        files,
        &mut sources,
        &mut report,
    );
    let model = model.expect("it is read");
    assert!(lagrangian_mechanics::Equations::derive(&model, &mut report).is_none());
}

/// Machines that cannot move: the constraints determine their coordinates, and the multipliers balance the forces.
#[test]
fn a_machine_that_cannot_move_has_reactions() {
    let of = |constraints: &str| {
        format!(
            "machine Held in plane {{
                parameters {{ m: kg = 3, g: m/s^2 = 10 }}
                coordinates {{ x: m = 1, y: m = 2 }}
                bodies {{ b {{ mass: m, at: (x, y) }} }}
                gravity (0, -g);
                constraints {{ {constraints} }}
            }}"
        )
    };
    // The rod from (0, 0) to (1, 2) and the one from (2, 0) carry 30 N: each has 2/√5 of its force upwards.
    let rod = 15.0 * 5.0_f64.sqrt() / 2.0;
    for (constraints, expected) in [
        ("one: x = 1, two: y = 2", [0.0, 30.0]),
        ("one: x + y = 3, two: x - y = -1", [15.0, -15.0]),
        (
            "one: norm((x, y)) = sqrt(5), two: norm((x - 2, y)) = sqrt(5)",
            [rod, rod],
        ),
    ] {
        compiled(&of(constraints), &[], |machine| {
            assert_proved(machine);
            let state = [&[1.0, 2.0][..], &[0.0, 0.0][..]];
            let a = call(&machine.program, Role::Accelerations, 2, state).expect("regular");
            let multipliers = call(&machine.program, Role::Multipliers, 2, state).expect("regular");
            for (found, expected) in a
                .into_iter()
                .chain(multipliers)
                .zip([[0.0; 2], expected].concat())
            {
                assert!(
                    (found - expected).abs() < 1e-13,
                    "{constraints}: {found} {expected}"
                );
            }
        });
    }
}

/// With redundant constraints the program reports that the multipliers are not unique; the runtime chooses among them.
#[test]
fn constraints_that_leave_no_freedom_may_say_it_twice() {
    let of = |coordinates: &str, at: &str, constraints: &str| {
        format!(
            "machine Twice in plane {{
                coordinates {{ {coordinates} }}
                bodies {{ b {{ mass: 1, at: {at} }} }}
                gravity (0, -10);
                constraints {{ {constraints} }}
            }}"
        )
    };
    for text in [
        of("x: m = 1", "(x, 0)", "one: x = 1, two: x = 1"),
        of(
            "x: m = 1",
            "(0, x)",
            "one: 2*x = 2, two: x = 1, three: 3*x = 3",
        ),
        of(
            "x: m = 1, y: m = 2",
            "(x, y)",
            "one: x = 1, two: y = 2, three: x + y = 3",
        ),
        of(
            "x: m = 1, y: m = 2",
            "(x, y)",
            "one: x^2 + y^2 = 5, two: 2*x^2 + 2*y^2 = 10",
        ),
        of(
            "x: m = 1, y: m = 2",
            "(x, y)",
            "one: x = 1, two: der(x) = 0, three: y = 2, four: der(y) = 0",
        ),
    ] {
        compiled(&text, &[], |machine| {
            let program = &machine.program;
            let n = program.dimension();
            let (q, v) = (vec![1.0, 2.0], vec![0.0; 2]);
            let state = [&q[..n], &v[..n]];
            let refused = call(program, Role::Accelerations, n, state).map_err(|s| s.coordinate);
            let at = refused.expect_err("there are more multipliers than these");
            assert!((n..n + program.constraints.len()).contains(&at), "{text}");
            assert!(
                call(program, Role::Multipliers, program.constraints.len(), state).is_err(),
                "{text}"
            );
        });
    }
}
