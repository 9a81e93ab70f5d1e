//! Parts that machines are made of, run from end to end, against closed forms.

use serde_json::Value;

use super::collisions::{close, is_good, number, simulate};
use crate::support::Scratch;

/// A run at a tolerance of 1e-13, whose state is good to a thousand times that where the motion is not
/// sensitive: errors of some hundred steps add up.
const WITHIN: f64 = 1e-10;

fn run(name: &str, text: &str, until: f64) -> Value {
    let spec = Scratch::new(&format!("{name}.machine"), text);
    simulate(spec.path(), until, &[])
}

/// y = −(v²/g) ln cosh(g t/v), with v² = 2 m g/(ρ c A); in a wind from below the ball falls as much slower.
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
    // What the drag takes stands in the books as work of a force.
    close(number(&run["energy_residual"]), 0.0, WITHIN);
}

/// The sun of a planetary gear: its torque turns I₁ + I_c/i² + …, with the ring held and i = 1 + z₃/z₁.
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

/// Atwood's machine, with a block: the heavier load in the bight of the rope falls with
/// a = g (M/2 − m)/(M/2 + 2 m), the other rises twice as fast.
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

/// The centre of a ball on a turntable goes round on a circle at 2/7 of its rate (J. A. Burns, *Ball rolling on a
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
    // Pushed at 0.5 m/s along x, it is on a circle of radius v/(2/7 Ω).
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

/// A mass meets a stop without damping at the speed v: it is stopped at the depth v √(m/k), and back
/// after π √(m/k).
#[test]
fn a_stop_is_half_a_swing_of_its_spring() {
    let spec = "machine Buffer in plane {
        parameters { m: kg = 2, k: N/m = 5000, l: m = 0.5 }
        coordinates { x: m = 0.1, der(x): m/s = 2 }
        bodies { block { mass: m, at: (x, 0) } }
        stops { end { on: x, above: l, stiffness: k } }
    }";
    let swing = std::f64::consts::PI * f64::sqrt(2.0 / 5000.0);
    // There and back at 2 m/s, and half a swing.
    let run = run("buffer", spec, 0.4 + swing);
    is_good(&run);
    close(number(&run["q"]["x"]), 0.1, 1e-8);
    close(number(&run["v"]["x"]), -2.0, 1e-8);
}
