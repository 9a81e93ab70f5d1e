//! The parts of machines, and the library machines that demonstrate them, run end to end, against closed forms.

use serde_json::Value;

use super::collisions::{close, is_good, number, simulate};
use crate::support::Scratch;

/// A run with a tolerance of 1e-13 has an error of at most a thousand times that if the motion is not sensitive, because the
/// errors of some hundred steps accumulate.
const WITHIN: f64 = 1e-10;

/// A run with given initial rates.
fn pushed(spec: &str, until: f64, rates: &[&str]) -> Value {
    let until = format!("{until:?}");
    let mut arguments = vec![
        "simulate",
        spec,
        "--until",
        &until,
        "--json",
        "--tolerance",
        "1e-13",
    ];
    for rate in rates {
        arguments.extend(["--rate", rate]);
    }
    let output = crate::support::lagrangian(&arguments);
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&output.stderr)))
}

fn run(name: &str, text: &str, until: f64) -> Value {
    let spec = Scratch::new(&format!("{name}.machine"), text);
    simulate(spec.path(), until, &[])
}

/// y = −(v²/g) ln cosh(g t/v), with v² = 2 m g/(ρ c A); in an upward wind the ball falls slower by the velocity of the wind.
#[test]
fn a_ball_falls_no_faster_than_its_drag_lets_it() {
    let spec = "machine Ball in plane {
        parameters { m: kg = 2, g: m/s^2 = 9.81, rho: kg/m^3 = 1.2, c: 1 = 0.5, A: m^2 = 0.8, w: m/s = 3 }
        coordinates { y: m, z: m, der(z): m/s = 3 }
        bodies { still { mass: m, at: (0, y) }, lifted { mass: m, at: (1, z) } }
        gravity (0, -g);
        drag {
            still { at: still.at, coefficient: c, area: A, density: rho },
            lifted { at: lifted.at, coefficient: c, area: A, density: rho, wind: (0, w) },
        }
    }";
    let run = run("ball", spec, 3.0);
    is_good(&run);
    let (m, g, t) = (2.0, 9.81, 3.0);
    let terminal = f64::sqrt(2.0 * m * g / (1.2 * 0.5 * 0.8));
    let fallen = terminal * terminal / g * f64::cosh(g * t / terminal).ln();
    let speed = terminal * f64::tanh(g * t / terminal);
    close(number(&run["q"]["y"]), -fallen, WITHIN);
    close(number(&run["v"]["y"]), -speed, WITHIN);
    close(number(&run["q"]["z"]), -fallen + 3.0 * t, WITHIN);
    // The energy balance counts the dissipation of the drag as work of a force.
    close(number(&run["energy_residual"]), 0.0, WITHIN);
}

/// The sun of a planetary gear: its torque accelerates I₁ + I_c/i² + …, with the ring held and i = 1 + z₃/z₁.
#[test]
fn a_planetary_gear_turns_as_its_reduced_inertia_says() {
    let spec = "machine Planetary in plane {
        parameters { z1: 1 = 20, z2: 1 = 30, z3: 1 = 80, r: m = 0.1, J: kg*m^2 = 0.02, m: kg = 1, M: N*m = 3 }
        coordinates { sun: rad, arm: rad, turned: rad }
        frames { carrier = ground.turn(arm), planet = carrier.shift(r, 0).turn(turned) }
        bodies {
            sun { mass: m, inertia: J, at: (0, 0), angle: sun },
            carrier { mass: m, inertia: J, frame: carrier },
            planet { mass: m, inertia: J, frame: planet },
        }
        transmissions {
            inner { turns: (planet, sun), teeth: (z2, z1), carrier: arm },
            outer { turns: (planet, 0*rad), teeth: (z2, -z3), carrier: arm },
        }
        torques { drive { on: sun, torque: M } }
    }";
    let run = run("planetary", spec, 2.0);
    is_good(&run);
    // The arm turns i times slower than the sun, the planet at ω_c (1 − z₃/z₂).
    let (arm, planet) = (1.0 / 5.0, (1.0 - 80.0 / 30.0) / 5.0);
    let reduced = 0.02 * (1.0 + arm * arm + planet * planet) + 0.01 * arm * arm;
    let turned = 0.5 * 3.0 / reduced * 4.0;
    close(number(&run["q"]["sun"]), turned, WITHIN * turned);
    close(number(&run["q"]["arm"]), turned * arm, WITHIN * turned);
}

/// Atwood's machine with a movable pulley: the load on the movable pulley falls with a = g (M/2 − m)/(M/2 + 2 m), the other rises
/// twice as fast.
#[test]
fn a_rope_over_pulleys_holds_its_loads_as_atwoods_machine() {
    let spec = "machine Atwood in plane {
        parameters { M: kg = 3, m: kg = 1, h: m = 4, g: m/s^2 = 9.81 }
        coordinates { y: m = 2, z: m = 0.5 }
        assume { y < h, z < h }
        bodies { heavy { mass: M, at: (0, y) }, light { mass: m, at: (1, z) } }
        gravity (0, -g);
        ropes { rope { path: ((0, h), heavy.at, (0, h), (1, h), light.at), length: 8.5 } }
    }";
    let run = run("atwood", spec, 0.8);
    is_good(&run);
    let fallen = 0.5 * 9.81 * (1.5 - 1.0) / (1.5 + 2.0) * 0.64;
    close(number(&run["q"]["y"]), 2.0 - fallen, WITHIN);
    close(number(&run["q"]["z"]), 0.5 + 2.0 * fallen, WITHIN);
}

/// The centre of a ball on a turntable moves on a circle, with 2/7 of the rate of the turntable (J. A. Burns, *Ball rolling on a
/// turntable: analog for charged particle dynamics*, Am. J. Phys. 49 (1981) 56–58).
#[test]
fn a_ball_on_a_turntable_goes_round_twice_in_seven_turns() {
    let spec = "machine Turntable in space {
        parameters { m: kg = 0.2, r: m = 0.03, J: kg*m^2 = 0.000072, Omega: rad/s = 3, g: m/s^2 = 9.81 }
        coordinates {
            x: m = 0.2, y: m, a: rad, b: rad = 1, c: rad, der(b): rad/s = 20, PUSH
        }
        frames {
            table = ground.turn(z, Omega*t),
            ball = ground.shift(x, y, r).turn(z, a).turn(x, b).turn(z, c),
        }
        bodies { ball { mass: m, inertia: (J, J, J), frame: ball } }
        gravity (0, 0, -g);
        wheels { ball { wheel: ball, radius: r, on: table } }
    }";
    // Slip is 0 where ẋ = r ω_y − Ω y and ẏ = −r ω_x + Ω x: at rest ω_x = Ω x/r = 20 rad/s and ω_y = 0, with
    // ω_x = ċ sin b sin a + ḃ cos a and ω_y = ḃ sin a − ċ sin b cos a.
    // The ball turns by less than 2 rad from b = 1, so its angles are not singular.
    let until = 0.05;
    let still = run("turntable", &spec.replace("PUSH", ""), until);
    is_good(&still);
    // v̇ = 2/7 Ω e_z × v: from rest it stays at rest.
    close(number(&still["q"]["x"]), 0.2, WITHIN);
    close(number(&still["q"]["y"]), 0.0, WITHIN);
    // Pushed at 0.5 m/s along x, it moves on a circle of radius v/(2/7 Ω).
    // ω_y = −ċ sin b = ẋ/r.
    let turning = -0.5 / 0.03 / f64::sin(1.0);
    let push = format!("der(x): m/s = 0.5, der(c): rad/s = {turning:?},");
    let run = run("pushed", &spec.replace("PUSH", &push), until);
    is_good(&run);
    let rate = 2.0 / 7.0 * 3.0;
    let (sin, cos) = f64::sin_cos(rate * until);
    close(number(&run["q"]["x"]), 0.2 + 0.5 / rate * sin, WITHIN);
    close(number(&run["q"]["y"]), 0.5 / rate * (1.0 - cos), WITHIN);
}

/// A mass meets an undamped elastic stop at the speed v: it stops at the depth v √(m/k), and leaves after π √(m/k).
#[test]
fn a_stop_is_half_a_swing_of_its_spring() {
    let spec = "machine Buffer in plane {
        parameters { m: kg = 2, k: N/m = 5000, l: m = 0.5 }
        coordinates { x: m = 0.1, der(x): m/s = 2 }
        bodies { block { mass: m, at: (x, 0) } }
        stops { end { on: x, above: l, stiffness: k } }
    }";
    let swing = std::f64::consts::PI * f64::sqrt(2.0 / 5000.0);
    // There and back at 2 m/s, and half a period in the stop.
    let run = run("buffer", spec, 0.4 + swing);
    is_good(&run);
    close(number(&run["q"]["x"]), 0.1, 1e-8);
    close(number(&run["v"]["x"]), -2.0, 1e-8);
}

/// The planetary gear of the library, with three planets: the torque on the sun accelerates the inertia of all wheels and of the
/// carrier, reduced to the sun.
#[test]
fn the_planetary_gear_of_the_library_obeys_willis() {
    let run = simulate("machines/parts/planetary_gear.machine", 0.5, &[]);
    is_good(&run);
    let (z1, z2, z3, m) = (20.0, 30.0, 80.0, 2e-3);
    let r: f64 = m * (z1 + z2) / 2.0;
    let (of_sun, of_planet) = (
        0.3 * f64::powi(m * z1, 2) / 8.0,
        0.5 * f64::powi(m * z2, 2) / 8.0,
    );
    // The rates of the carrier, and of a planet in the fixed frame.
    let (arm, planet) = (1.0 / 5.0, (1.0 - z3 / z2) / 5.0);
    let reduced =
        of_sun + (4e-4 + 3.0 * 0.5 * r * r) * arm * arm + 3.0 * of_planet * planet * planet;
    let turned = 0.5 * (3.0 - 10.0 * arm) / reduced * 0.25;
    close(number(&run["q"]["sun"]), turned, WITHIN * turned.abs());
    close(
        number(&run["q"]["arm"]),
        turned * arm,
        WITHIN * turned.abs(),
    );
    for i in 1..=3 {
        // The rate of the planet relative to the carrier.
        let own = number(&run["q"][format!("planet[{i}]")]);
        close(own, turned * (planet - arm), WITHIN * turned.abs());
    }
}

/// The door swings to one stop, half a period in it, and back to the other.
#[test]
fn the_door_of_the_library_goes_to_and_fro() {
    let (inertia, a, rate) = (25.0 * 0.81 / 3.0, 80_f64.to_radians(), 1.2);
    let period = 4.0 * a / rate + 2.0 * std::f64::consts::PI * f64::sqrt(inertia / 4000.0);
    for (part, sign) in [(0.5, -1.0), (1.0, 1.0)] {
        let run = simulate("machines/parts/stopped_door.machine", part * period, &[]);
        is_good(&run);
        // Across the edge of a stop, where the force is not smooth, only the error estimate keeps steps within the tolerance.
        close(number(&run["q"]["phi"]), 0.0, 1e-8);
        close(number(&run["v"]["phi"]), sign * rate, 1e-8);
    }
}

#[test]
fn the_parachutist_of_the_library_falls_as_the_hyperbolic_cosine() {
    let run = simulate("machines/parts/parachutist.machine", 3.0, &[]);
    is_good(&run);
    let terminal = f64::sqrt(2.0 * 95.0 * 9.81 / (1.2 * 1.4 * 25.0));
    let fallen = terminal * terminal / 9.81 * f64::ln(f64::cosh(9.81 * 3.0 / terminal));
    close(number(&run["q"]["y"]), 800.0 - fallen, WITHIN * 800.0);
    close(number(&run["q"]["x"]), 0.0, WITHIN);
    // In a wind, the motion relative to the air is that in still air with the opposite initial velocity.
    let windy = simulate("machines/parts/parachutist.machine", 3.0, &["w=4"]);
    let carried = pushed("machines/parts/parachutist.machine", 3.0, &["x=-4"]);
    close(
        number(&windy["q"]["x"]),
        number(&carried["q"]["x"]) + 12.0,
        WITHIN * 12.0,
    );
    close(
        number(&windy["q"]["y"]),
        number(&carried["q"]["y"]),
        WITHIN * 800.0,
    );
}

/// The load rises with (M/R − m g)/(m + J/R² + J₁/r²).
#[test]
fn the_hoist_of_the_library_lifts_by_its_reduced_mass() {
    let run = simulate("machines/parts/hoist.machine", 1.5, &[]);
    is_good(&run);
    // For discs J/R² is half their mass.
    let rises = (700.0 / 0.3 - 200.0 * 9.81) / (200.0 + 40.0 + 10.0);
    let lifted = 0.5 * rises * 1.5 * 1.5;
    close(number(&run["q"]["y"]), 1.0 + lifted, WITHIN);
    close(number(&run["q"]["x"]), 1.7, WITHIN);
    close(number(&run["q"]["drum"]), -lifted / 0.3, WITHIN);
    // The rope passes to the other side of the sheave, which turns to the left.
    close(number(&run["q"]["sheave"]), lifted / 0.2, WITHIN);
}

/// When the load swings, the rope rolls off the sheave and onto it. With ψ the direction of the hanging part and ℓ its length,
/// the load is at `c + r n + ℓ e`, and `ℓ = ℓ₀ + r (ψ − ψ₀) + R φ` with φ the angle of the drum: a machine with two coordinates
/// and no constraint by a rope.
#[test]
fn a_load_swings_on_the_involute_of_its_sheave() {
    let free = "machine Involute in plane {
        parameters {
            m: kg = 200, md: kg = 80, ms: kg = 20, R: m = 0.3, r: m = 0.2, J: kg*m^2 = md*R^2/2, J1: kg*m^2 = ms*r^2/2,
            a: m = 1.5, H: m = 6, M: N*m = 700, hung: m = 5, g: m/s^2 = 9.81,
        }
        coordinates { psi: rad = -pi/2, drum: rad, der(psi): rad/s = 0.3 }
        define { length = hung + r*(psi + pi/2) + R*drum }
        bodies {
            load { mass: m, at: (a, H) + r*(-sin(psi), cos(psi)) + polar(length, psi) },
            drum { mass: md, inertia: J, at: (0, 0), angle: drum },
        }
        rotors { sheave { inertia: J1, angle: -R/r*drum } }
        gravity (0, -g);
        torques { winch { on: drum, torque: -M } }
        outputs {
            x: m = a - r*sin(psi) + length*cos(psi),
            y: m = H + r*cos(psi) + length*sin(psi),
        }
    }";
    let free = run("involute", free, 2.0);
    is_good(&free);
    // The load starts at 5 m · 0.3 rad/s along x; a pendulum of that length swings by a third of a radian.
    let tied = pushed("machines/parts/hoist.machine", 2.0, &["x=1.5"]);
    is_good(&tied);
    let (psi, turned) = (number(&free["q"]["psi"]), number(&free["q"]["drum"]));
    let length = 5.0 + 0.2 * (psi + std::f64::consts::FRAC_PI_2) + 0.3 * turned;
    assert!(
        (psi + std::f64::consts::FRAC_PI_2).abs() > 0.05,
        "it swings: {psi}"
    );
    // The rope constrains rates, so its length has the same error as positions: some hundred steps of 1e-13.
    let x = 1.5 - 0.2 * psi.sin() + length * psi.cos();
    let y = 6.0 + 0.2 * psi.cos() + length * psi.sin();
    close(number(&tied["q"]["x"]), x, WITHIN);
    close(number(&tied["q"]["y"]), y, WITHIN);
    close(number(&tied["q"]["drum"]), turned, WITHIN);
    close(number(&tied["q"]["sheave"]), -1.5 * turned, WITHIN);
}

/// A rope from a hook down under a movable pulley, up over a fixed one and down to a counterweight.
const TACKLE: &str = "machine Tackle in plane {
    parameters { M: kg = 3, m: kg = 1, p: m = 0.3, q: m = 0.1, g: m/s^2 = 9.81, L: m = 2 + 1.5 + 0.4*pi }
    coordinates { x: m, y: m = -1, X: m = p + 2*q, Y: m = -1.5 }
    bodies { block { mass: M, at: (x, y) }, counterweight { mass: m, at: (X, Y) } }
    gravity (0, -g);
    ropes { rope { path: ((-p, 0), block.at, (p + q, 0), counterweight.at), radii: (0, p, -q, 0), length: L } }
}";

/// With all parts hanging vertically the wrapped arcs are constant, and the pulleys move as Atwood's.
#[test]
fn a_tackle_of_pulleys_with_radii_that_hangs_is_atwoods_machine() {
    let run = run("tackle", TACKLE, 0.5);
    is_good(&run);
    let (heavy, light) = (3.0, 1.0);
    let a = 9.81 * (heavy / 2.0 - light) / (heavy / 2.0 + 2.0 * light);
    close(number(&run["q"]["y"]), -1.0 - 0.5 * a * 0.25, WITHIN);
    close(number(&run["q"]["Y"]), -1.5 + a * 0.25, WITHIN);
    close(number(&run["q"]["x"]), 0.0, WITHIN);
    close(number(&run["q"]["X"]), 0.5, WITHIN);
}

/// The length of a rope from the angles of its tangents, as constructed with compasses: a straight part is inclined at asin(h/d)
/// to the line of centres.
fn drawn(path: &[([f64; 2], f64)]) -> f64 {
    let parts: Vec<(f64, f64)> = path
        .windows(2)
        .map(|ends| {
            let (dx, dy) = (ends[1].0[0] - ends[0].0[0], ends[1].0[1] - ends[0].0[1]);
            let (d, h) = (dx.hypot(dy), ends[1].1 - ends[0].1);
            ((d * d - h * h).sqrt(), dy.atan2(dx) - (h / d).asin())
        })
        .collect();
    let straight: f64 = parts.iter().map(|(length, _)| length).sum();
    let arcs = (1..path.len() - 1).map(|k| {
        let turn = (parts[k].1 - parts[k - 1].1) * path[k].1.signum();
        path[k].1.abs() * turn.rem_euclid(std::f64::consts::TAU)
    });
    straight + arcs.sum::<f64>()
}

/// During large swings the rope keeps the length of the construction, and does no work.
#[test]
fn a_tackle_that_swings_keeps_the_length_of_its_rope() {
    let spec = Scratch::new("swinging.machine", TACKLE);
    for until in [0.3, 0.6, 0.9] {
        let run = pushed(spec.path(), until, &["x=1.2", "X=-0.7"]);
        is_good(&run);
        let at = |name: &str| number(&run["q"][name]);
        assert!(at("x").abs() > 0.05, "{run:#}");
        let path = [
            ([-0.3, 0.0], 0.0),
            ([at("x"), at("y")], 0.3),
            ([0.4, 0.0], -0.1),
            ([at("X"), at("Y")], 0.0),
        ];
        let length = 3.5 + 0.4 * std::f64::consts::PI;
        // Constraints are satisfied to 1e-13 of their terms.
        close(drawn(&path), length, 1e-11);
        close(number(&run["energy_residual"]), 0.0, WITHIN);
    }
}

/// On a heavy pulley without slip, the tensions on both sides differ by what accelerates the pulley.
#[test]
fn a_pulley_with_inertia_takes_its_share_of_the_pull() {
    let spec = "machine Atwood in plane {
        parameters { M: kg = 3, m: kg = 1, r: m = 0.25, J: kg*m^2 = 0.125, g: m/s^2 = 9.81 }
        coordinates { y: m = -1, z: m = -2, turn: rad }
        bodies {
            heavy { mass: M, at: (-r, y) }, light { mass: m, at: (r, z) },
            wheel { mass: 4, inertia: J, at: (0, 0), angle: turn },
        }
        gravity (0, -g);
        ropes { rope { path: (heavy.at, wheel.at, light.at), radii: (0, -r, 0), turns: (0, wheel, 0), length: 3 + pi*r } }
        outputs { before: N = M*(g + der(der(y))) }
    }";
    let end = run("pulley", spec, 0.4);
    is_good(&end);
    // J/r² is 2 kg.
    let a = 9.81 * (3.0 - 1.0) / (3.0 + 1.0 + 2.0);
    close(number(&end["q"]["y"]), -1.0 - 0.5 * a * 0.16, WITHIN);
    close(number(&end["q"]["z"]), -2.0 + 0.5 * a * 0.16, WITHIN);
    // The heavy end's fall turns the wheel to the left.
    close(number(&end["q"]["turn"]), 0.5 * a * 0.16 / 0.25, WITHIN);
    let spec = Scratch::new("pulley.machine", spec);
    let output = crate::support::lagrangian(&["evaluate", spec.path()]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let behind = -number(&found[0]["multipliers"]["rope"]);
    let difference = -number(&found[0]["multipliers"]["rope.pulley1"]);
    close(behind, 9.81 + a, WITHIN);
    close(behind + difference, 3.0 * (9.81 - a), WITHIN);
    close(
        number(&found[0]["outputs"]["before"]),
        3.0 * (9.81 - a),
        WITHIN,
    );
}

/// A rope that lifts off its pulley would need a pushing force: the run ends there.
#[test]
fn a_rope_that_leaves_its_pulley_ends_the_run() {
    let end = |spec: &str, until: &str, rate: &str| {
        let spec = Scratch::new("lifted.machine", spec);
        let call = [
            "simulate",
            spec.path(),
            "--until",
            until,
            "--rate",
            rate,
            "--json",
        ];
        let output = crate::support::lagrangian(&call);
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    };
    let hung = "machine Lifted in plane {
        parameters { m: kg = 1, r: m = 0.1, R: m = 0.05, J: kg*m^2 = 0.1, g: m/s^2 = 9.81 }
        coordinates { x: m = 1, y: m = -0.3, drum: rad }
        bodies { load { mass: m, at: (x, y) }, drum { mass: 1, inertia: J, at: (-1, -0.2), angle: drum } }
        gravity (0, -g);
        ropes { rope { ROPE } }
    }";
    // A rope from a drum, and with a length of its own.
    let wound = "path: (drum.at, (0, 0), load.at), radii: (R, -r, 0), turns: (drum, 0, 0)";
    let length = drawn(&[([-1.0, -0.2], 0.0), ([0.0, 0.0], -0.1), ([1.0, -0.3], 0.0)]);
    let tied =
        format!("path: ((-1, -0.2), (0, 0), load.at), radii: (0, -r, 0), length: {length:?}");
    for rope in [wound, &tied] {
        let spec = hung.replace("ROPE", rope);
        let thrown = end(&spec, "0.3", "y=5");
        let why = thrown["error"].as_str().unwrap_or_default();
        assert!(why.contains("wraps around pulley 1"), "{thrown:#}");
        // Released from rest, the rope keeps touching.
        let dropped = end(&spec, "0.05", "y=0");
        assert_eq!(dropped["error"], Value::Null, "{dropped:#}");
    }
}

/// An actuator between two masses on one line pushes them apart, whichever is ahead, with a constant force: x = x₀ ∓ F t²/(2 m). Its direction is a difference of
/// coordinates over the root of its square, which depends on neither coordinate but for its sign. On a rail, the line is written with sines of a constant angle.
#[test]
fn an_actuator_on_a_line_pushes_apart_whichever_end_is_ahead() {
    let places = [
        ("(x, 0*m)", "(y, 0*m)"),
        ("(3/5*x, 4/5*x)", "(3/5*y, 4/5*y)"),
        ("rail.point(x, 0.1)", "rail.point(y, 0.1)"),
    ];
    for (a, b) in places {
        for (x, y) in [(0.1, 0.6), (0.6, 0.1), (-0.6, -0.1)] {
            let spec = format!(
                "machine Line in plane {{
                    coordinates {{ x: m = {x:?}, y: m = {y:?} }}
                    frames {{ rail = ground.turn(25*deg) }}
                    bodies {{ a {{ mass: 2, at: {a} }}, b {{ mass: 2, at: {b} }} }}
                    actuators {{ push {{ from: a.at, to: b.at, force: 0.5 }} }}
                }}"
            );
            let run = run("line", &spec, 1.0);
            let moved = if x < y { -0.125 } else { 0.125 };
            close(number(&run["q"]["x"]), x + moved, WITHIN);
            close(number(&run["q"]["y"]), y - moved, WITHIN);
        }
    }
}
