//! Parts of machines, compared with equations typed in by hand and with the same parts
//! written out as basic elements.

use lagrangian_mechanics::{Compiled, constraints};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;
use lagrangian_spec::model::element::Load;
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::{Dag, evaluate, nearest};

use crate::by_hand::{assert_agreement, mutate};
use crate::harness::{derived, resolved};

/// Two carts on rails at a distance with a cylinder between them, and a motor between two arms.
const DRIVEN: &str = r#"
machine Driven in plane {
    parameters { m: kg = 3, J: kg*m^2 = 0.2, I: kg*m^2 = 0.5, h: m = 0.4, a: m = 0.3, b: N*m*s = 0.1 }
    coordinates { x: m = 0.1, y: m = 0.7, alpha: rad = 0.3, beta: rad = 0.5 }
    inputs { F: N, M: N*m }
    frames { arm = ground.turn(alpha), hand = arm.shift(a, 0).turn(beta) }
    bodies {
        left { mass: m, at: (x, 0) }, right { mass: 2*m, at: (y, h) },
        arm { mass: 1, inertia: I, frame: arm }, hand { mass: 1, inertia: J, frame: hand },
    }
    gravity none;
    actuators {
        cylinder { from: left.at, to: right.at, force: F },
        motor { from: arm, to: hand, torque: M - b*der(beta) },
        base { from: ground, to: arm, torque: 2*M },
    }
    define { distance = sqrt((y - x)^2 + h^2) }
    published "by hand" {
        equation x: m*der(der(x)) + F*(y - x)/distance = 0,
        equation y: 2*m*der(der(y)) - F*(y - x)/distance = 0,
        force alpha = 2*M,
        force beta = M - b*der(beta),
    }
}
"#;

/// A shaft in a frame that turns, with a torque between the two about the shaft's tilted axis.
const SHAFT: &str = r#"
machine Shaft in space {
    parameters { m: kg = 3, A: kg*m^2 = 0.2, C: kg*m^2 = 0.5, tilt: rad = 0.4, b: N*m*s = 0.1 }
    coordinates { yaw: rad = 0.3, spin: rad = 0.5, roll: rad = 0.1 }
    inputs { M: N*m, N: N*m }
    frames { housing = ground.turn(z, yaw).turn(x, roll), shaft = housing.turn(y, tilt).turn(z, spin) }
    bodies {
        housing { mass: m, inertia: (A, A, A), frame: housing },
        shaft { mass: m, inertia: (A, A, C), frame: shaft },
    }
    gravity none;
    actuators {
        motor { from: housing, to: shaft, torque: 2*M - b*der(spin), axis: shaft.vector(0, 0, 1) },
        // Twice the unit vector is the same axis.
        yaw { from: ground, to: housing, torque: N, axis: (0, 0, 2) },
    }
    published "by hand" {
        force yaw = N,
        force roll = 0,
        force spin = 2*M - b*der(spin),
    }
}
"#;

/// A pendulum in wind, a falling ball, and a joint between stops.
const HELD_BACK: &str = r#"
machine HeldBack in plane {
    parameters {
        m: kg = 1, l: m = 2, c: 1 = 0.47, A: m^2 = 0.03, rho: kg/m^3 = 1.2, w: m/s = 3,
        k: N/m = 4000, kphi: N*m = 50, d: N*s/m^2 = 300, top: m = 0.5, J: kg*m^2 = 0.1, last: rad = 0.3,
    }
    coordinates { phi: rad = 0.4, z: m = 0.6, psi: rad = 0.1 }
    bodies {
        bob { mass: m, at: l*(sin(phi), -cos(phi)) },
        ball { mass: m, at: (5, z) },
        flap { mass: 1, inertia: J, at: (0, 0), angle: psi },
    }
    gravity none;
    drag {
        bob { at: bob.at, coefficient: c, area: A, density: rho },
        ball { at: ball.at, coefficient: c, area: A, density: rho, wind: (0, w) },
    }
    stops {
        ball { on: z, above: top, below: -top/2, stiffness: k, damping: d },
        flap { on: psi, above: last, stiffness: kphi },
    }
    published "by hand" {
        force phi = -1/2*rho*c*A*l^3*abs(der(phi))*der(phi),
        force z = -1/2*rho*c*A*abs(der(z) - w)*(der(z) - w)
            - (k*(z - top) + d*(z - top)*der(z))*(1 + sign(z - top))/2
            + (k*(-top/2 - z) - d*(-top/2 - z)*der(z))*(1 + sign(-top/2 - z))/2,
        force psi = -kphi*(psi - last)*(1 + sign(psi - last))/2,
        potential_energy = 1/2*k*max(0, z - top)^2 + 1/2*k*max(0, -top/2 - z)^2
            + 1/2*kphi*max(0, psi - last)^2,
    }
}
"#;

/// Angular velocities and velocities of points, as outputs and by hand.
const MOVING: &str = r#"
machine Moving in space {
    parameters { m: kg = 1, l: m = 0.7, s: m = 0.2 }
    coordinates { a: rad = 0.3, b: rad = 0.5, u: m = 0.1 }
    frames { f = ground.turn(z, a).shift(u, 0, l).turn(x, b), level = ground.with_origin(f.point(0, s, 0)) }
    bodies { part { mass: m, inertia: (1, 2, 3), frame: f }, mark { mass: m, at: level.point(s, 0, 0) } }
    gravity none;
    outputs {
        along: rad/s = dot(f.spin, f.vector(1, 0, 0)),
        up: rad/s = dot(f.spin, (0, 0, 1)),
        across: rad/s = dot(f.spin, f.vector(0, 0, 1)) - der(a)*cos(b),
        fixed: m/s = norm(part.velocity(f.point(0, s, l)) - der(f.point(0, s, l))),
        seen: m = norm(f.with_origin(mark.at).origin - mark.at),
        corner: m = dot(level.point(0, 0, l) - f.point(0, s, 0), (0, 0, 1)) - l,
    }
}
"#;

const MOVING_IN_PLANE: &str = r#"
machine Moving in plane {
    parameters { m: kg = 1, l: m = 0.7, s: m = 0.2 }
    coordinates { a: rad = 0.3, b: rad = 0.5, x: m = 0.1 }
    frames { f = ground.shift(x, 0).turn(a).shift(l, 0).turn(b) }
    bodies {
        part { mass: m, inertia: 1, frame: f },
        disc { mass: m, inertia: 1, at: (x, l), angle: a*a },
    }
    gravity none;
    outputs {
        along: rad/s = f.spin - der(a) - der(b),
        disc: rad/s = disc.spin - 2*a*der(a),
        fixed: m/s = norm(part.velocity(f.point(s, l)) - der(f.point(s, l))),
        below: m/s = dot(disc.velocity(disc.at - (0, s)), (1, 0)) - der(x) - 2*a*der(a)*s,
        still: m/s = dot(disc.velocity((0, 0)), (0, 1)) + 2*a*der(a)*x,
    }
}
"#;

#[test]
fn actuators_are_what_is_typed_by_hand() {
    assert_agreement(DRIVEN, 4);
    assert_agreement(SHAFT, 3);
}

#[test]
fn drag_and_stops_are_what_is_typed_by_hand() {
    assert_agreement(HELD_BACK, 4);
}

#[test]
fn every_wrong_sign_and_coefficient_of_them_is_found() {
    for (text, least) in [(DRIVEN, 30), (SHAFT, 2)] {
        let (made, survivors) = mutate(text);
        assert!(survivors.is_empty(), "not found: {survivors:?}");
        assert!(made >= least, "{made} mutants");
    }
    // The square of (1 + sign)/2 is (1 + sign)/2 itself, so some changes in the
    // terms of stops change nothing.
    let (made, survivors) = mutate(HELD_BACK);
    let others = survivors.iter().filter(|text| !text.starts_with("force z"));
    assert_eq!(others.count(), 0, "{survivors:?}");
    assert!(made >= 60, "{made} mutants");
}

/// Below, between and above its bounds a stop exerts the force of its formula, in numbers.
#[test]
fn a_stop_pushes_beyond_its_bounds_alone() {
    derived(HELD_BACK, |model, equations| {
        let (z, rate) = (&model.coordinates[1], 1.5);
        let force = |at: f64| {
            let value = |symbol| match Some(symbol) {
                found if found == z.q.as_symbol() => at,
                found if found == z.v.as_symbol() => rate,
                found => {
                    let mut all = model.parameters.iter();
                    let parameter = all.find(|p| p.symbol.as_symbol() == found);
                    parameter.and_then(|p| p.default).map_or(0.0, nearest)
                }
            };
            evaluate(model.dag, &[equations.applied[1]], value)[0]
        };
        // −½ ρ c A |w| w of w = ż − 3 = −1.5.
        let drag = 0.5 * 1.2 * 0.47 * 0.03 * 1.5 * 1.5;
        // A dozen rounding units of a few thousand newtons.
        let close = |at: f64, expected: f64| {
            let error = (force(at) - drag - expected).abs();
            assert!(error < 12.0 * 2000.0 * f64::EPSILON, "{at}: {error:e}");
        };
        close(0.1, 0.0);
        close(0.5, 0.0);
        close(0.75, -(4000.0 * 0.25 + 300.0 * 0.25 * rate));
        close(-0.5, 4000.0 * 0.25 - 300.0 * 0.25 * rate);
    });
}

#[test]
fn frames_turn_and_points_move_as_their_positions_say() {
    let rest = |text: &str, expected: [Option<&str>; 6]| {
        resolved(text, |model| {
            let value = |name: &str| {
                let found = model.outputs.iter().find(|o| o.name.to_string() == name);
                found.expect("an output").value
            };
            for output in &model.outputs {
                let name = output.name.to_string();
                let place = model.outputs.iter().position(|o| o.name == output.name);
                let by_hand = match expected[place.expect("an output")] {
                    None => model.dag.zero(),
                    Some(coordinate) => {
                        let found = model.coordinates.iter();
                        let mut found = found.filter(|c| c.name.to_string() == coordinate);
                        found.next().expect("a coordinate").v
                    }
                };
                assert_eq!(identity::equal(value(&name), by_hand), Some(true), "{name}");
            }
        });
    };
    // ω = ȧ e_z + ḃ e_x′.
    rest(MOVING, [Some("b"), Some("a"), None, None, None, None]);
    rest(MOVING_IN_PLANE, [None; 6]);
}

/// Asserts that constraints have the same row, drift and position as constraints written by hand, in the
/// order of their names.
fn same_constraints(text: &str, elements: &str, written: &str) {
    let both = text
        .replace("ELEMENTS", elements)
        .replace("WRITTEN", written);
    resolved(&both, |model| {
        let all = constraints(model);
        assert!(
            all.len().is_multiple_of(2) && !all.is_empty(),
            "{}",
            all.len()
        );
        for one in &all {
            let Some(name) = one.name.strip_prefix("by_hand_") else {
                continue;
            };
            let other = all
                .iter()
                .find(|other| other.name.replace('.', "_") == name);
            let other = other.unwrap_or_else(|| panic!("no {name}"));
            assert_eq!(one.unit, other.unit, "{name}");
            let same = |a, b| assert_eq!(identity::equal(a, b), Some(true), "{name}");
            same(one.rate, other.rate);
            same(one.bias, other.bias);
            one.row
                .iter()
                .zip(&other.row)
                .for_each(|(&a, &b)| same(a, b));
            assert_eq!(one.position.is_some(), other.position.is_some(), "{name}");
            if let (Some(a), Some(b)) = (one.position, other.position) {
                same(a, b);
            }
        }
    });
}

const WHEELWORK: &str = r#"
machine Wheelwork in plane {
    parameters { J: kg*m^2 = 0.1, m: kg = 2, z1: 1 = 17, z2: 1 = 51, r: m = 0.05, R: m = 0.2, i: 1 = 4, p: m = 0.01 }
    coordinates {
        phi1: rad, phi2: rad, phi3: rad, phi4: rad, arm: rad, turned: rad, ring: rad, x: m = 0.2, y: m = -1,
    }
    frames { arm = ground.turn(arm), planet = arm.shift(R, 0).turn(turned) }
    bodies {
        one { mass: m, inertia: J, at: (0, 0), angle: phi1 }, two { mass: m, inertia: J, at: (0, 0), angle: phi2 },
        three { mass: m, inertia: J, at: (0, 0), angle: phi3 }, four { mass: m, inertia: J, at: (0, 0), angle: phi4 },
        arm { mass: m, inertia: J, frame: arm }, planet { mass: m, inertia: J, frame: planet },
        ring { mass: m, inertia: J, at: (0, 0), angle: ring },
        load { mass: m, at: (x, y) },
    }
    gravity (0, -9.81);
    ELEMENTS
    constraints { WRITTEN }
}
"#;

#[test]
fn gears_and_belts_are_their_equations() {
    same_constraints(
        WHEELWORK,
        "transmissions {
            gear { turns: (one, phi2), teeth: (z1, z2) },
            belt { turns: (two, three), belt: (r, R), offset: 0.1 },
            worm { turns: (phi3, four), ratio: i },
            rack { turns: (x, four), ratio: r },
            planet { turns: (planet, ring), teeth: (z1, -z2), carrier: arm },
            rates { turns: (der(phi1), der(phi4)), ratio: -2 },
        }",
        // The planet's frame turns by both angles.
        "by_hand_gear: phi1 = -z2/z1*phi2,
         by_hand_belt: phi2 = R/r*phi3 + 0.1,
         by_hand_worm: phi3 = i*phi4,
         by_hand_rack: x = r*phi4,
         by_hand_planet: turned = z2/z1*(ring - arm),
         by_hand_rates: der(phi1) = -2*der(phi4),",
    );
}

#[test]
fn ropes_are_as_long_as_their_parts() {
    same_constraints(
        WHEELWORK,
        "ropes {
            tackle { path: ((0, 0), load.at, (R, 0)), length: 3 - r*phi1 },
            plumb { path: (planet.origin, load.at), length: 2 },
        }",
        "by_hand_tackle: sqrt(x^2 + y^2) + sqrt((x - R)^2 + y^2) = 3 - r*phi1,
         by_hand_plumb: sqrt((x - R*cos(arm))^2 + (y - R*sin(arm))^2) = 2,",
    );
}

/// A coin whose coordinates keep it on the ground, one whose coordinates do not, and balls, one of them
/// on a plate that turns.
const ROLLING: &str = r#"
machine Rolling in space {
    parameters { m: kg = 1, r: m = 0.1, A: kg*m^2 = 0.0025, C: kg*m^2 = 0.005 }
    coordinates {
        x: m, y: m, heading: rad = 0.4, lean: rad = -0.2, roll: rad,
        u: m, v: m, w: m = 0.1, a: rad, b: rad, c: rad, plate: rad,
        o: m, p: m,
    }
    assume { cos(b) > 0 }
    frames {
        track = ground.shift(x, y, 0).turn(z, heading),
        coin = track.turn(x, lean).shift(0, 0, r).turn(y, roll),
        free = ground.shift(u, v, w).turn(z, a).turn(x, b).turn(y, c),
        ball = ground.shift(u, v, w).turn(z, a).turn(x, b).turn(z, c),
        plate = ground.turn(z, plate),
        marble = ground.shift(o, p, r).turn(z, a).turn(x, b).turn(z, c),
    }
    bodies {
        coin { mass: m, inertia: (A, C, A), frame: coin },
        free { mass: m, inertia: (A, C, A), frame: free },
        ball { mass: m, inertia: (A, A, A), frame: ball },
        plate { mass: m, inertia: (A, A, A), frame: plate },
        marble { mass: m, inertia: (A, A, A), frame: marble },
    }
    gravity (0, 0, -9.81);
    ELEMENTS
    constraints { WRITTEN }
}
"#;

#[test]
fn wheels_and_balls_do_not_slip() {
    // The point of contact is at rest, by the velocities of the textbook: for a coin ẋ = r φ̇ cos ψ,
    // ẏ = r φ̇ sin ψ without the part from its lean; for a ball ẋ = r ω_y, ẏ = −r ω_x.
    same_constraints(
        ROLLING,
        "wheels {
            coin { wheel: coin, radius: r, axis: y, on: ground },
            free { wheel: free, radius: r, axis: y, on: ground },
            marble { wheel: marble, radius: r, on: plate },
        }",
        "by_hand_coin_x: der(x) - r*der(roll)*cos(heading) = 0,
         by_hand_coin_y: der(y) - r*der(roll)*sin(heading) = 0,
         by_hand_free_gap: w - r*cos(b) = 0,
         by_hand_free_x: der(u - r*sin(b)*sin(a)) - r*der(c)*cos(a) = 0,
         by_hand_free_y: der(v + r*sin(b)*cos(a)) - r*der(c)*sin(a) = 0,
         by_hand_marble_x: (der(o) - r*(der(b)*sin(a) - der(c)*sin(b)*cos(a)) + der(plate)*p)*cos(plate)
            + (der(p) + r*(der(b)*cos(a) + der(c)*sin(b)*sin(a)) - der(plate)*o)*sin(plate) = 0,
         by_hand_marble_y: (der(p) + r*(der(b)*cos(a) + der(c)*sin(b)*sin(a)) - der(plate)*o)*cos(plate)
            - (der(o) - r*(der(b)*sin(a) - der(c)*sin(b)*cos(a)) + der(plate)*p)*sin(plate) = 0,",
    );
}

/// A motor on an arm, behind a gear; and one on a slide, as a mass.
const GEARED: &str = r#"
machine Geared in space {
    parameters { A: kg*m^2 = 0.2, m: kg = 2, n: 1 = 50, Jm: kg*m^2 = 1e-4, mm: kg = 0.3, k: N/m = 4 }
    coordinates { phi: rad = 0.3, psi: rad = 0.2, s: m = 0.1 }
    frames { arm = ground.turn(x, phi), hand = arm.turn(z, psi) }
    bodies { hand { mass: m, inertia: (A, A, 2*A), frame: hand }, slide { mass: m, at: (0, s, 0) } }
    gravity none;
    rotors {
        motor { inertia: Jm, angle: n*phi },
        // On the arm, it turns with both.
        wrist { inertia: Jm, angle: n*psi - phi },
        screw { inertia: mm, angle: s },
    }
    springs { spring { stiffness: k, stretch: s } }
    published "by hand" {
        kinetic_energy = 1/2*A*der(phi)^2 + A*der(psi)^2 + 1/2*m*der(s)^2 + 1/2*Jm*n^2*der(phi)^2
            + 1/2*Jm*(n*der(psi) - der(phi))^2 + 1/2*mm*der(s)^2,
        equation phi: (A + Jm*n^2 + Jm)*der(der(phi)) - n*Jm*der(der(psi)) = 0,
        equation psi: (2*A + Jm*n^2)*der(der(psi)) - n*Jm*der(der(phi)) = 0,
        equation s: (m + mm)*der(der(s)) + k*s = 0,
    }
}
"#;

#[test]
fn rotors_are_what_is_typed_by_hand() {
    assert_agreement(GEARED, 4);
    let (made, survivors) = mutate(GEARED);
    assert!(survivors.is_empty(), "not found: {survivors:?}");
    assert!(made >= 15, "{made} mutants");
}

/// In the plane a rotor is a body whose mass centre does not move.
#[test]
fn a_rotor_is_a_wheel_that_stays_where_it_is() {
    let machine = |rotor: &str| {
        format!(
            "machine Winch in plane {{
                parameters {{ m: kg = 3, J: kg*m^2 = 2, r: m = 0.1 }}
                coordinates {{ y: m, phi: rad }}
                bodies {{ load {{ mass: m, at: (0, y) }} {rotor} }}
                gravity (0, -9.81);
                springs {{ rope {{ stiffness: 1000, stretch: y - r*phi }} }}
            }}"
        )
    };
    let shown = |rotor: &str| {
        derived(&machine(rotor), |_, equations| {
            let (matrix, forces) = (&equations.mass_matrix, &equations.forces);
            let entries = (0..2).flat_map(|i| (0..2).map(move |j| matrix.get(i, j).to_string()));
            let forces = forces.iter().map(|force| force.to_string());
            entries.chain(forces).collect::<Vec<_>>()
        })
    };
    assert_eq!(
        shown("} rotors { drum { inertia: J, angle: phi + y/r }"),
        shown(", drum { mass: 5, inertia: J, at: (1, 2), angle: phi + y/r }"),
    );
}

/// Rows that rise, stay and fall, unevenly spaced, with a row at which the slope changes its sign.
const ROWS: [[f64; 2]; 7] = [
    [-2.0, 1.0],
    [-0.5, 1.5],
    [0.0, 4.0],
    [1.0, 4.0],
    [3.25, 2.5],
    [4.0, 3.0],
    [6.0, -1.0],
];

/// Value and slope between these rows, from `scipy.interpolate.PchipInterpolator(x, y)(at)` and its
/// `derivative()(at)`, SciPy 1.17.1.
const BY_SCIPY: [[f64; 3]; 13] = [
    [-2.0, 1.0, 0.0],
    [-1.75, 1.0116305329719963, 0.09485094850948506],
    [-0.75, 1.3359304426377596, 0.5826558265582655],
    [-0.5, 1.5, 0.7317073170731708],
    [-0.125, 3.626524390243902, 5.3963414634146325],
    [0.5, 4.0, 0.0],
    [1.0, 4.0, 0.0],
    [2.0, 3.374485596707819, -0.9876543209876543],
    [3.5, 2.6296296296296293, 0.8888888888888888],
    [3.75, 2.8703703703703702, 0.8888888888888888],
    [4.5, 2.7443181818181817, -1.018939393939394],
    [5.875, -0.5222833806818182, -3.703835227272727],
    [6.0, -1.0, -3.9393939393939394],
];

/// A disc driven by a motor whose torque is a table, and outputs of a table at any place.
const BY_TABLE: &str = r#"
machine ByTable in plane {
    parameters { J: kg*m^2 = 0.1 }
    coordinates { phi: rad, x: 1, y: m }
    bodies { disc { mass: 1, inertia: J, at: (0, 0), angle: phi }, point { mass: 1, at: (x*one, y) } }
    constants { one: m = 1 }
    torques { motor { on: disc, torque: table("motor.csv:torque", der(phi)) } }
    outputs {
        value: 1 = table("rows.csv", x),
        slope: 1/s = der(table("rows.csv", x)),
        held: 1 = table("rows.csv", x, hold),
    }
}
"#;

fn by_table<R>(look: impl for<'d> FnOnce(&Model<'d>) -> R) -> R {
    let rows = ROWS.map(|[x, y]| format!("{x}, {y}\n")).concat();
    // A straight line from 2 N m at rest to zero at 1200 rpm, with a row at
    // negative speed on the same line.
    let motor = "speed [rpm]; current [A]; torque [N*mm]\n-600; 0; 3000\n0; 0; 2000\n1200; 1; 0\n";
    let mut files = InMemory::new()
        .with("rows.csv", format!("x, y\n{rows}"))
        .with("motor.csv", motor);
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let (name, constants) = ("test.machine", &[]);
    let model = lagrangian_spec::model(
        &dag,
        name,
        BY_TABLE,
        constants,
        &mut files,
        &mut sources,
        &mut report,
    );
    look(&model.unwrap_or_else(|| panic!("{}", report.render_short(&sources))))
}

fn outputs_at(model: &Model<'_>, at: f64) -> Vec<f64> {
    let x = &model.coordinates[1];
    let outputs: Vec<_> = model.outputs.iter().map(|output| output.value).collect();
    evaluate(model.dag, &outputs, |symbol| match () {
        () if Some(symbol) == x.q.as_symbol() => at,
        () if Some(symbol) == x.v.as_symbol() => 1.0,
        () => 0.0,
    })
}

#[test]
fn a_table_is_the_monotone_cubic_of_scipy() {
    // Seven intervals of ten operations each, on numbers below 6.
    let tolerance = 7.0 * 10.0 * 6.0 * f64::EPSILON;
    by_table(|model| {
        for [at, value, slope] in BY_SCIPY {
            let found = outputs_at(model, at);
            assert!((found[0] - value).abs() < tolerance, "{at}: {found:?}");
            assert!((found[1] - slope).abs() < tolerance, "{at}: {found:?}");
            assert!((found[2] - value).abs() < tolerance, "{at}: {found:?}");
        }
        // Beyond its ends the table keeps the values at the ends.
        assert!((outputs_at(model, -3.0)[2] - 1.0).abs() < tolerance);
        assert!((outputs_at(model, 60.0)[2] + 1.0).abs() < tolerance);
    });
}

#[test]
fn a_table_is_in_the_units_of_its_file_and_ends_where_that_ends() {
    by_table(|model| {
        let texts: Vec<_> = model
            .assumptions
            .iter()
            .map(|fact| fact.text.as_str())
            .collect();
        assert_eq!(
            texts,
            [
                "der(phi) >= -600 rpm, the end of motor.csv",
                "der(phi) <= 1200 rpm, the end of motor.csv",
                "x >= -2, the end of rows.csv",
                "x <= 6, the end of rows.csv",
            ]
        );
        let torque = model.loads().find_map(|load| match load {
            Load::Torque { torque, .. } => Some(torque[0]),
            _ => None,
        });
        let torque = torque.expect("a torque");
        let rate = model.coordinates[0].v.as_symbol();
        for speed in [-50.0, 0.0, 10.0, 125.0] {
            let found = evaluate(model.dag, &[torque], |symbol| {
                if Some(symbol) == rate { speed } else { 0.0 }
            });
            let full = 1200.0 * std::f64::consts::TAU / 60.0;
            // Three intervals of ten operations each, on a few N m.
            let tolerance = 3.0 * 10.0 * 4.0 * f64::EPSILON;
            assert!(
                (found[0] - 2.0 * (1.0 - speed / full)).abs() < tolerance,
                "{speed}: {found:?}"
            );
        }
    });
}

#[test]
fn a_machine_with_a_table_is_proved() {
    by_table(|model| {
        let mut report = Report::new();
        let compiled = Compiled::new(model.clone(), &mut report);
        assert!(compiled.is_some(), "{:?}", report.diagnostics());
    });
}
