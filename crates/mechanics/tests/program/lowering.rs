//! How single formulas are lowered to operations.

use lagrangian_program::{Op, Role, Source};

use crate::harness::{counts_of_output, program, program_of_output};

#[test]
fn what_parameters_decide_is_prepared() {
    let program = program_of_output("a: 1 = 2, b: 1 = 3", "a*b^2/(a + b)*sin(a)*x");
    let output = program.function(Role::Output(0)).expect("the output");
    assert_eq!(output.counts().to_string(), "1 mul");
    assert!(
        program
            .prepared
            .iter()
            .any(|formula| formula == "a*b^2*sin(a)/(a + b)"),
        "{:?}",
        program.prepared
    );
}

#[test]
fn a_common_parameter_moves_out_of_a_sum() {
    // p·x² + p·y² takes no more than x² + y² and one multiplication, which is merged with that by q.
    assert_eq!(
        counts_of_output("p: 1 = 2, q: 1 = 3", "q*(p*x^2 + p*y^2)*sin(x)"),
        "4 mul, 1 add, 1 sincos"
    );
}

#[test]
fn terms_with_the_same_varying_part_are_one() {
    assert_eq!(
        counts_of_output("p: 1 = 2, q: 1 = 3", "p*(x*y) + q*(y*x)"),
        "2 mul"
    );
}

#[test]
fn a_bare_parameter_is_prepared_as_it_is() {
    let program = program_of_output("p: 1 = 2", "p*x");
    let output = program.function(Role::Output(0)).expect("the output");
    let read = |op: &Op| match op {
        Op::Read(Source::Prepared(index)) => Some(program.prepared[*index as usize].as_str()),
        _ => None,
    };
    assert_eq!(output.code.iter().find_map(read), Some("p"));
}

#[test]
fn one_division_stays_a_division_and_several_share_a_reciprocal() {
    assert_eq!(counts_of_output("", "sin(x)/y"), "1 div, 1 sincos");
    // (sin x + cos x·r)·r with r = 1/(1 + y).
    assert_eq!(
        counts_of_output("", "sin(x)/(1 + y) + cos(x)/(1 + y)^2"),
        "2 mul, 2 add, 1 div, 1 sincos"
    );
}

#[test]
fn sine_and_cosine_of_opposite_angles_are_computed_once() {
    assert_eq!(
        counts_of_output("", "sin(x - y)*cos(y - x)"),
        "1 mul, 1 add, 1 sincos"
    );
}

#[test]
fn common_factors_are_multiplied_once() {
    // x·y, then its products with the sine and with the cosine, and the final product.
    assert_eq!(
        counts_of_output("", "(x*y*sin(x) + 1)*(x*y*cos(y) + 2)"),
        "4 mul, 2 add, 2 sincos"
    );
}

#[test]
fn common_terms_are_added_once() {
    // x + y, then the additions of 1 and 2, and the product.
    assert_eq!(
        counts_of_output("", "(x + y + 1)*(x + y + 2)"),
        "1 mul, 3 add"
    );
}

#[test]
fn powers_are_repeated_squares() {
    assert_eq!(counts_of_output("", "x^2"), "1 mul");
    assert_eq!(counts_of_output("", "x^8"), "3 mul");
    assert_eq!(counts_of_output("", "x^64"), "6 mul");
    assert_eq!(counts_of_output("", "x^(-3)"), "2 mul, 1 div");
}

#[test]
fn signs_cost_nothing_inside_sums() {
    assert_eq!(
        counts_of_output("", "x*y - sin(x) - cos(y)"),
        "1 mul, 2 add, 2 sincos"
    );
    assert_eq!(counts_of_output("", "-(sin(x) - y)"), "1 add, 1 sincos");
}

#[test]
fn long_sums_are_balanced() {
    let terms: Vec<String> = (1..=64).map(|k| format!("sin({k}*x)")).collect();
    let program = program_of_output("", &terms.join(" + "));
    let output = program.function(Role::Output(0)).expect("the output");
    let mut depth = vec![0; output.code.len()];
    for (index, op) in output.code.iter().enumerate() {
        let below = op
            .operands()
            .map(|operand| depth[operand.index()])
            .max()
            .unwrap_or(0);
        depth[index] = below + usize::from(matches!(op, Op::Add(..) | Op::Sub(..)));
    }
    // 64 terms need at least 6 levels.
    assert!(depth[output.results[0].index()] >= 6);
}

#[test]
fn what_is_zero_costs_nothing() {
    let free = program(
        "machine Free in plane {
            parameters { m: kg = 1, J: kg*m^2 = 2 }
            coordinates { x: m, y: m, phi: rad }
            bodies { disc { mass: m, inertia: J, at: (x, y), angle: phi } }
        }",
    );
    for function in &free.functions {
        if function.role != Role::KineticEnergy {
            assert_eq!(function.counts().ops(), 0, "{}", function.role.name());
        }
    }
}

#[test]
fn a_listing_says_what_is_what() {
    let program = program(
        "machine Pendulum in plane {
            parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
            coordinates { phi: rad = pi/3 }
            bodies { bob { mass: m, at: l*(sin(phi), -cos(phi)) } }
            gravity (0, -g);
            outputs { height: m = -l*cos(phi) }
        }",
    );
    let listing = program.to_string();
    for line in [
        "program Pendulum",
        "start()  // 1 mul",
        "accelerations(prepared, q)  // ",
        "accelerations[phi]",
        "  mass_matrix[phi, phi] = prepared[",
        "output height(prepared, q)  // 1 mul, 1 sincos",
    ] {
        assert!(listing.contains(line), "{line}\n{listing}");
    }
}

#[test]
fn what_turns_out_to_be_known_late_is_prepared() {
    // Some terms cancel only when they have become operations, which leaves a sum that depends on parameters alone.
    // Tested with every choice of angles, and with the program split into stages.
    let charts = ["x", "x + z", "2*x - z"];
    for (first, second) in charts.iter().flat_map(|a| charts.map(|b| (*a, b))) {
        for stages in [
            "",
            "stages { coordinates }",
            "derivatives { coordinates, rates }",
        ] {
            let text = format!(
                "machine Late in plane {{
                    parameters {{ m: kg = 2, l: m = 1 }}
                    coordinates {{ x: rad = 2.5, y: rad = 0.2, z: rad = -1.2 }}
                    frames {{
                        a = ground.turn({first}), b = a.shift(l, l), c = b.turn(y - ({second})),
                        d = ground.turn(z), e = d.shift(l, l),
                    }}
                    bodies {{
                        one {{ mass: m, inertia: m*l^2, frame: c, at: c.point(l, l) }},
                        other {{ mass: m, inertia: m*l^2, frame: e, at: e.point(l, l) }},
                        third {{ mass: m, inertia: m*l^2, frame: a }},
                    }}
                    {stages}
                }}"
            );
            assert_eq!(program(&text).verify(), Ok(()), "{text}");
        }
    }
}
