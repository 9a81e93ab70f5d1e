//! Machines with bilateral constraints.

use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::prove;
use lagrangian_program::{Arguments, Candidate, Interpreter, Op, Program, Role, Singular, Source};

use crate::harness::{compiled, differentiated};
use crate::machines::assert_proved;

/// A particle on a circle, in Cartesian coordinates.
const PENDULUM: &str = "machine Pendulum in plane {
    parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
    coordinates { x: m = -1, y: m }
    bodies { bob { mass: m, at: (x, y) } }
    gravity (0, -g);
    constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0 }
}";

/// A closed chain of four bars on ground, in absolute angles.
const FOUR_BAR: &str = "machine FourBar in plane {
    parameters {
        a: m = 1, b: m = 1.2, c: m = 0.9, d: m = 1.3, m1: kg = 1, m2: kg = 2, m3: kg = 1.5, g: m/s^2 = 9.81,
    }
    coordinates { q1: rad = 1, q2: rad = 0.3, q3: rad = 1.2 }
    define { A = polar(a, q1), B = polar(a, q1) + polar(b, q2), C = (d, 0) + polar(c, q3) }
    bodies {
        crank   { mass: m1, inertia: m1*a^2/12, at: polar(a/2, q1), angle: q1 },
        coupler { mass: m2, inertia: m2*b^2/12, at: A + polar(b/2, q2), angle: q2 },
        rocker  { mass: m3, inertia: m3*c^2/12, at: (d, 0) + polar(c/2, q3), angle: q3 },
    }
    gravity (0, -g);
    constraints { along: dot(B - C, (1, 0)) = 0, across: dot(B - C, (0, 1)) = 0 }
}";

/// A bead on a wire that bends with time, and a skate whose blade turns with time.
const MOVING: &str = "machine Moving in plane {
    parameters { m: kg = 2, J: kg*m^2 = 0.3, a: m = 0.2, w: rad/s = 3, k: N/m = 4, b: N*s/m = 0.5 }
    coordinates { x: m, y: m, X: m, Y: m, phi: rad }
    inputs { F: N = 1 }
    bodies {
        bead { mass: m, at: (x, y) },
        skate { mass: m, inertia: J, at: (X, Y) + polar(a, phi), angle: phi },
    }
    springs { between { stiffness: k, from: (x, y), to: (X, Y), length: a } }
    dampers { drag { damping: b, stretch: x } }
    forces { push { at: (X, Y), force: (F, 0) } }
    constraints {
        wire: y = a*sin(w*t)*cos(x/a),
        blade: -der(X)*sin(phi + w*t) + der(Y)*cos(phi + w*t) = a*w*cos(w*t),
    }
}";

/// A cylinder that rolls in a cylinder on a sliding platform, and one that rolls on its outside.
const ROLLING: &str = "machine Rolling in plane {
    parameters {
        M: kg = 5, m: kg = 1, J: kg*m^2 = 0.2, R: m = 1, r: m = 0.2, h: m = 0.1, g: m/s^2 = 9.81, k: N/m = 100,
    }
    coordinates { x: m, theta: rad, s: m = R - r, phi: rad, alpha: rad, u: m = R + r, psi: rad, beta: rad }
    assume { s > 0 }
    frames { platform = ground.shift(x, 0).turn(theta) }
    bodies {
        platform { mass: M, inertia: M*R^2, frame: platform },
        inner { mass: m, inertia: J, at: platform.point(h, 0) + polar(s, phi), angle: alpha },
        outer { mass: m, inertia: J, at: platform.point(h, 0) + polar(u, psi), angle: beta },
    }
    springs { back { stiffness: k, stretch: x } }
    gravity (0, -g);
    circles {
        bore { on: platform, center: (h, 0), radius: R },
        wheel { on: inner, center: (0, 0), radius: r },
        rim { on: outer, center: (0, 0), radius: r },
    }
    rolling {
        inside { circle: wheel, inside: bore },
        outside { circle: rim, outside: bore },
    }
}";

#[test]
fn accelerations_and_multipliers_obey_the_equations_of_the_first_kind() {
    for text in [PENDULUM, FOUR_BAR, MOVING, ROLLING] {
        compiled(text, &[], assert_proved);
    }
}

#[test]
fn derivatives_are_those_of_accelerations_that_obey_the_constraints() {
    for text in [PENDULUM, FOUR_BAR, MOVING, ROLLING] {
        differentiated(text, &[], assert_proved);
    }
}

#[test]
fn stages_leave_the_constraints_kept() {
    for text in [PENDULUM, FOUR_BAR, MOVING, ROLLING] {
        let end = text.rfind('}').expect("the end");
        let staged = format!("{} stages {{ time, coordinates }} }}", &text[..end]);
        compiled(&staged, &[], assert_proved);
    }
}

/// Accelerations and multipliers at a state.
fn solved(
    program: &Program,
    parameters: &[f64],
    [q, v]: [&[f64]; 2],
) -> Result<(Vec<f64>, Vec<f64>), Singular> {
    let arguments = Arguments {
        t: 0.0,
        q,
        v,
        u: &[],
        a: &[],
    };
    let mut a = vec![0.0; q.len()];
    let mut multipliers = vec![0.0; program.constraints.len()];
    let mut interpreter = Interpreter::new(program, parameters);
    interpreter.call(Role::Accelerations, arguments, &mut a)?;
    interpreter.call(Role::Multipliers, arguments, &mut multipliers)?;
    Ok((a, multipliers))
}

#[test]
fn a_rod_pulls_as_much_as_weight_and_turning_ask_for() {
    compiled(PENDULUM, &[], |machine| {
        let (m, l, g) = (2.0, 0.5, 9.81);
        let (sin, cos) = 0.7_f64.sin_cos();
        let omega = 3.0;
        let q = [l * sin, -l * cos];
        let v = [l * omega * cos, l * omega * sin];
        let (a, multipliers) = solved(&machine.program, &[m, l, g], [&q, &v]).expect("regular");
        // The constraint is scaled so that its gradient has length 1; a multiplier that presses
        // outwards is positive.
        let tension = m * (g * cos + l * omega * omega);
        assert!((multipliers[0] + tension).abs() < 1e-14 * tension);
        let turning = -g / l * sin;
        let expected = [
            l * (turning * cos - omega * omega * sin),
            l * (turning * sin + omega * omega * cos),
        ];
        for (a, expected) in a.iter().zip(expected) {
            assert!((a - expected).abs() < 1e-14 * 20.0);
        }
    });
}

/// Section 1.3 of the reference problems by hand: gap and slip of circles in polar coordinates.
#[test]
fn circles_touch_and_slip_as_drawn_by_hand() {
    compiled(ROLLING, &[], |machine| {
        let program = &machine.program;
        let names: Vec<_> = program
            .constraints
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        assert_eq!(
            names,
            ["inside.gap", "inside.slip", "outside.gap", "outside.slip"]
        );
        let (big, r) = (1.0, 0.2);
        let parameters = [5.0, 1.0, 0.2, big, r, 0.1, 9.81, 100.0];
        let q = [0.3, 0.2, 0.7, 1.1, -0.4, 1.3, 2.0, 0.9];
        let v = [0.5, -0.6, 0.15, 1.7, 2.5, -0.25, 0.8, -1.4];
        let [
            _,
            theta_dot,
            s_dot,
            phi_dot,
            alpha_dot,
            u_dot,
            psi_dot,
            beta_dot,
        ] = v;
        let (s, u) = (q[2], q[5]);
        let mut interpreter = Interpreter::new(program, &parameters);
        let arguments = Arguments {
            t: 0.0,
            q: &q,
            v: &v,
            u: &[],
            a: &[],
        };
        let mut call = |role| {
            let mut results = [0.0; 4];
            assert_eq!(interpreter.call(role, arguments, &mut results), Ok(()));
            results
        };
        let close = |found: [f64; 4], expected: [f64; 4]| {
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        };
        close(
            call(Role::ConstraintPositions),
            [big - r - s, 0.0, u - r - big, 0.0],
        );
        close(
            call(Role::ConstraintRates),
            [
                -s_dot,
                s * phi_dot + r * alpha_dot - big * theta_dot,
                u_dot,
                u * psi_dot - r * beta_dot - big * theta_dot,
            ],
        );
    });
}

/// A wheel on an inclined road that a lift tilts; its mass centre is off the axle.
const TILTED: &str = "machine Tilted in plane {
    parameters { m: kg = 2, J: kg*m^2 = 0.1, r: m = 0.3, e: m = 0.1, h: m = 1, g: m/s^2 = 9.81 }
    coordinates { tilt: rad = 0.2, x: m = 0.5, y: m = 1, phi: rad = 0.1 }
    frames { road = ground.shift(0, h).turn(tilt), wheel = ground.shift(x, y).turn(phi) }
    bodies {
        lift { mass: m, inertia: J, frame: road },
        wheel { mass: m, inertia: J, frame: wheel },
    }
    gravity (0, -g);
    circles { tyre { on: wheel, center: (e, 0), radius: r } }
    rolling { on_road { circle: tyre, along: road } }
}";

#[test]
fn a_wheel_rolls_along_a_line_as_drawn_by_hand() {
    compiled(TILTED, &[], |machine| {
        assert_proved(machine);
        let (r, e, h) = (0.3, 0.1, 1.0);
        let [tilt, x, y, phi] = [0.2_f64, 0.5, 1.7, 0.9];
        let [tilt_dot, x_dot, y_dot, phi_dot] = [0.7, -0.4, 1.1, 2.3];
        // The centre along the road and across it, with complex numbers: c = e^{-i tilt} (z - i h).
        let centre = [x + e * phi.cos(), y - h + e * phi.sin()];
        let centre_dot = [
            x_dot - e * phi.sin() * phi_dot,
            y_dot + e * phi.cos() * phi_dot,
        ];
        let (sin, cos) = tilt.sin_cos();
        let across = cos * centre[1] - sin * centre[0];
        // The wheel's point of contact is r below its centre; the road's point moves across the road.
        let slip = cos * centre_dot[0] + sin * centre_dot[1] + r * phi_dot;
        let across_dot = cos * centre_dot[1]
            - sin * centre_dot[0]
            - (cos * centre[0] + sin * centre[1]) * tilt_dot;
        let mut interpreter = Interpreter::new(&machine.program, &[2.0, 0.1, r, e, h, 9.81]);
        let arguments = Arguments {
            t: 0.0,
            q: &[tilt, x, y, phi],
            v: &[tilt_dot, x_dot, y_dot, phi_dot],
            u: &[],
            a: &[],
        };
        for (role, expected) in [
            (Role::ConstraintPositions, [across - r, 0.0]),
            (Role::ConstraintRates, [across_dot, slip]),
        ] {
            let mut found = [0.0; 2];
            assert_eq!(interpreter.call(role, arguments, &mut found), Ok(()));
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        }
    });
}

/// A disc rolls down an incline with the acceleration ⅔ g sin α.
#[test]
fn a_disc_rolls_down_an_incline_with_two_thirds_of_its_weight() {
    let text = "machine Incline in plane {
        parameters { m: kg = 3, r: m = 0.2, alpha: rad = 0.5, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m, phi: rad }
        frames { road = ground.turn(-alpha) }
        bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: phi } }
        gravity (0, -g);
        circles { rim { on: disc, center: (0, 0), radius: r } }
        rolling { down { circle: rim, along: road } }
    }";
    compiled(text, &[], |machine| {
        assert_proved(machine);
        let (m, r, alpha, g) = (3.0, 0.2, 0.5_f64, 9.81);
        let (sin, cos) = alpha.sin_cos();
        let q = [r * sin, r * cos, 0.0];
        let parameters = [m, r, alpha, g];
        let (a, multipliers) =
            solved(&machine.program, &parameters, [&q, &[0.0; 3]]).expect("regular");
        let down = 2.0 / 3.0 * g * sin;
        let expected = [down * cos, -down * sin, -down / r];
        for (a, expected) in a.iter().zip(expected) {
            assert!((a - expected).abs() < 1e-14 * 50.0, "{a} {expected}");
        }
        // The normal force balances the weight; friction points up the road and is a
        // third of the downhill force.
        assert!((multipliers[0] - m * g * cos).abs() < 1e-14 * 50.0);
        assert!((multipliers[1] + m * g * sin / 3.0).abs() < 1e-14 * 50.0);
    });
}

#[test]
fn a_constraint_that_says_nothing_new_is_named() {
    let twice = PENDULUM.replace(" = 0 }", " = 0, again: x^2 + y^2 = l^2 }");
    compiled(&twice, &[], |machine| {
        let program = &machine.program;
        let state: [&[f64]; 2] = [&[0.6, -0.8], &[0.8, 0.6]];
        let singular = solved(program, &[1.0, 1.0, 9.81], state).expect_err("twice");
        // The index counts after the coordinates; the pivot is nothing but rounding.
        assert_eq!(singular.coordinate, 2 + 1);
        assert!(singular.ratio.abs() < 1e-14);
    });
}

/// In line, the bars of a parallelogram may continue in two ways.
#[test]
fn a_parallelogram_in_line_has_constraints_that_depend_on_each_other() {
    compiled(FOUR_BAR, &[], |machine| {
        let parameters = [1.0, 1.5, 1.0, 1.5, 1.0, 1.0, 1.0, 9.81];
        let at = |q1: f64| {
            let q = [q1, 0.0, q1];
            solved(&machine.program, &parameters, [&q, &[0.2, 0.0, 0.2]])
        };
        assert!(at(0.1).is_ok());
        assert_eq!(
            at(0.0).map_err(|singular| singular.coordinate >= 3),
            Err(true)
        );
    });
}

/// The work of the accelerations: operations, divisions, and the coordinates
/// of the state that they read.
fn work(text: &str) -> (usize, usize, Vec<usize>) {
    compiled(text, &[], |machine| {
        let accelerations = machine.program.function(Role::Accelerations);
        let accelerations = accelerations.expect("the function");
        let counts = accelerations.counts();
        let read = accelerations.code.iter().filter_map(|op| match op {
            Op::Read(Source::Coordinate(i) | Source::Velocity(i)) => Some(*i as usize),
            _ => None,
        });
        let mut read: Vec<usize> = read.collect();
        read.sort_unstable();
        read.dedup();
        (
            counts.multiplications + counts.additions,
            counts.divisions,
            read,
        )
    })
}

#[test]
fn a_coordinate_that_a_constraint_fixes_is_not_there() {
    let fixed = "machine Fixed in plane {
        parameters { m: kg = 2, R: m = 1, r: m = 0.2, g: m/s^2 = 9.81 }
        coordinates { s: m = R - r, phi: rad }
        bodies { ball { mass: m, at: polar(s, phi) } }
        gravity (0, -g);
        constraints { touches: s = R - r }
    }";
    let minimal = fixed
        .replace("s: m = R - r, ", "")
        .replace("polar(s, phi)", "polar(R - r, phi)")
        .replace("constraints { touches: s = R - r }", "");
    let ((ops, divisions, read), free) = (work(fixed), work(&minimal));
    assert_eq!((ops, divisions), (free.0, free.1));
    assert_eq!((read, free.2), (vec![1], vec![0]));
    compiled(fixed, &[], assert_proved);
}

/// A bead on a wire that is bent and shaken, a wheel that rolls, a spring between them, and forces on
/// coordinates that depend on others.
const SETTLED: &str = "machine Settled in plane {
    parameters {
        m: kg = 2, J: kg*m^2 = 0.3, r: m = 0.2, l: m = 1, w: rad/s = 3, A: m = 0.1, k: N/m = 4, F: N = 3, g: m/s^2 = 9.8,
    }
    coordinates { y: m, x: m, X: m, phi: rad, theta: rad, s: m = l }
    bodies {
        bead { mass: m, at: (x, y) },
        wheel { mass: m, inertia: J, at: (X, r), angle: -phi },
        arm { mass: m, inertia: J, at: (X, r) + polar(s, theta), angle: theta + phi },
    }
    gravity (0, -g);
    springs { between { stiffness: k, from: (x, y), to: (X, r) }, twisted { stiffness: k, stretch: r*phi + x } }
    forces { push { on: y, value: F }, turn { on: phi, value: F*r } }
    constraints {
        wire: y = x^2/l + A*sin(w*t),
        rolls: der(X) = r*der(phi) + A*w/7,
        length: s = l,
    }
}";

/// A cam turned by a rack, and a follower lifted by the cam: the constraint of rates determines the
/// angle, and this determines the lift.
const CAM: &str = "machine Cam in plane {
    parameters { m: kg = 2, J: kg*m^2 = 0.3, r: m = 0.2, e: m = 0.05, h: m = 0.3, k: N/m = 40, g: m/s^2 = 9.8 }
    coordinates { x: m, phi: rad = 0.4, y: m = h + e*sin(0.4) }
    bodies {
        rack { mass: m, at: (x, 0) },
        cam { mass: m, inertia: J, at: (0, r), angle: -phi },
        follower { mass: m, at: (x/3, y) },
    }
    gravity (0, -g);
    springs { back { stiffness: k, stretch: x }, above { stiffness: k, from: (x, 0), to: (0, y) } }
    constraints { meshes: der(x) = r*der(phi), lifts: y = h + e*sin(phi) }
}";

#[test]
fn every_way_to_obey_constraints_is_right() {
    for text in [PENDULUM, FOUR_BAR, MOVING, ROLLING, SETTLED, CAM] {
        compiled(text, &[], |machine| {
            let (model, equations) = (&machine.model, &machine.equations);
            let (expanded, oracle) = (equations.expanded(), Oracle::derive(model));
            let choice = machine.program.choice(Role::Accelerations);
            for wanted in 0..choice.map_or(1, |choice| choice.candidates.len()) {
                let choose = |all: &[Candidate]| match all[0].form.role {
                    Role::Accelerations => wanted,
                    _ => wanted % all.len(),
                };
                let program =
                    lagrangian_mechanics::lower_by(model, equations, expanded.as_ref(), &choose);
                assert_eq!(prove(&program, model, &oracle), Ok(()), "{text}: {wanted}");
            }
        });
    }
}

#[test]
fn coordinates_that_constraints_settle_are_put_in() {
    compiled(SETTLED, &[], |machine| {
        assert_proved(machine);
        let choice = machine
            .program
            .choice(Role::Accelerations)
            .expect("a choice");
        assert!(choice.chosen().form.reduced);
        assert!(choice.candidates.iter().any(|c| !c.form.reduced));
    });
    // Both candidates are correct, whichever is chosen.
    compiled(SETTLED, &[], |machine| {
        let (model, equations) = (&machine.model, &machine.equations);
        let choices = machine
            .program
            .choice(Role::Accelerations)
            .expect("a choice");
        for wanted in 0..choices.candidates.len() {
            let choose = |all: &[Candidate]| match all[0].form.role {
                Role::Accelerations => wanted,
                _ => 0,
            };
            let program = lagrangian_mechanics::lower_by(
                model,
                equations,
                equations.expanded().as_ref(),
                &choose,
            );
            assert_eq!(prove(&program, model, &Oracle::derive(model)), Ok(()));
        }
    });
}

#[test]
fn what_is_not_constrained_knows_nothing_of_constraints() {
    compiled(
        "machine Free in plane { coordinates { x: m } bodies { ball { mass: 1, at: (x, 0) } } }",
        &[],
        |machine| {
            let is_of_constraints =
                |role: Role| role.name().starts_with("constraint") || role == Role::Multipliers;
            let mut functions = machine.program.functions.iter();
            assert!(!functions.any(|function| is_of_constraints(function.role)));
        },
    );
}
