//! Contacts in space, where friction has two directions, against closed forms and against equivalent machines.

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::{Scratch, json, lagrangian};

const G: f64 = 9.81;

fn settings(pairs: &[(&str, f64)]) -> Vec<String> {
    let said = pairs
        .iter()
        .map(|(name, value)| format!("{name}={value:?}"));
    said.collect()
}

fn run(spec: &str, until: f64, pairs: &[(&str, f64)]) -> Value {
    let settings = settings(pairs);
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    simulate(spec, until, &settings)
}

/// A ball slips at u = v − r ω × n. The slip keeps its direction and decreases by 7/2 μ g per second: after 2|u|/(7 μ g) the ball rolls,
/// at v − 2/7 u, and until then its path is a parabola (G.-G. Coriolis, 1835). The spin about the vertical is constant.
#[test]
fn a_cue_ball_slips_along_a_parabola_until_it_rolls() {
    let spec = "machines/contacts/cue_ball.machine";
    let (m, r, mu) = (0.21, 0.03075, 0.2);
    for (v, w) in [
        ([2.0, 0.0], [40.0, -30.0, 60.0]),
        ([1.0, 0.5], [0.0; 3]),
        // With so much back spin that it returns.
        ([0.4, 0.3], [35.0, -50.0, 0.0]),
    ] {
        let pairs = [
            ("vx", v[0]),
            ("vy", v[1]),
            ("wx", w[0]),
            ("wy", w[1]),
            ("wz", w[2]),
        ];
        let slip: [f64; 2] = [v[0] - r * w[1], v[1] + r * w[0]];
        let speed = slip[0].hypot(slip[1]);
        let rolls = 2.0 * speed / (7.0 * mu * G);
        let until = 1.25 * rolls;
        let run = run(spec, until, &pairs);
        is_good(&run);
        let sticks = events(&run, "sticks");
        assert_eq!(sticks.len(), 1, "{}", run["contact_events"]);
        assert_eq!(sticks[0]["contact"], "cloth");
        close(number(&sticks[0]["t"]), rolls, 1e-12);
        for (name, k) in [("x", 0), ("y", 1)] {
            let after = v[k] - 2.0 / 7.0 * slip[k];
            let braked = mu * G * slip[k] / speed;
            let place = v[k] * rolls - 0.5 * braked * rolls * rolls;
            close(number(&sticks[0]["q"][name]), place, 1e-12);
            close(number(&run["v"][name]), after, 1e-12);
            close(
                number(&run["q"][name]),
                place + after * (until - rolls),
                1e-12,
            );
        }
        // The energy dissipated by friction: half the effective mass of slip, 2/7 m, times the square of the slip.
        close(number(&run["dissipated"]), speed * speed * m / 7.0, 1e-11);
        close(number(&run["energy_residual"]), 0.0, 1e-11);
    }
}

/// A cue ball in time stepping has this motion up to the error of its steps, which is of at least first order: halved if the step is halved.
#[test]
fn by_time_stepping_a_cue_ball_rolls_at_the_same_rates() {
    let (r, v, w) = (0.03075, [2.0, 0.0], [40.0, -30.0]);
    let slip: [f64; 2] = [v[0] - r * w[1], v[1] + r * w[0]];
    let error = |step: &str| {
        let output = lagrangian(&[
            "simulate",
            "machines/contacts/cue_ball.machine",
            "--until",
            "0.6",
            "--method",
            "moreau",
            "--longest-step",
            step,
            "--json",
        ]);
        let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(run["error"], Value::Null, "{run:#}");
        let missed = |k: usize, name: &str| {
            let after = v[k] - 2.0 / 7.0 * slip[k];
            (number(&run["v"][name]) - after).abs()
        };
        missed(0, "x").max(missed(1, "y"))
    };
    let [whole, half] = ["5e-4", "2.5e-4"].map(error);
    // It rotates by 0.04 in a step, and its angles by more: the error is some squares of that, times 2 m/s.
    assert!(whole < 0.03, "{whole:e}");
    assert!(half < 0.6 * whole, "{half:e} of {whole:e}");
}

/// Straight along an axis of the plane, a ball in space moves as a disc in the plane with the inertia of a ball.
#[test]
fn a_ball_that_moves_in_a_plane_has_the_numbers_of_the_plane() {
    let pairs = [("m", 7.0), ("r", 0.108), ("mu", 0.1)];
    let plane = run(
        "machines/contacts/bowling_ball.machine",
        3.0,
        &[&pairs[..], &[("speed", 8.0), ("spin", 5.0)]].concat(),
    );
    let rest = [
        ("vx", 8.0),
        ("vy", 0.0),
        ("wx", 0.0),
        ("wy", -5.0),
        ("wz", 0.0),
    ];
    let space = run(
        "machines/contacts/cue_ball.machine",
        3.0,
        &[&pairs[..], &rest[..]].concat(),
    );
    is_good(&plane);
    is_good(&space);
    let stops = |run: &Value| number(&events(run, "sticks")[0]["t"]);
    close(stops(&space), stops(&plane), 1e-13);
    close(number(&space["q"]["x"]), number(&plane["q"]["x"]), 1e-12);
    close(
        number(&space["q"]["b"]),
        -number(&plane["q"]["theta"]),
        1e-10,
    );
    close(
        number(&space["dissipated"]),
        number(&plane["dissipated"]),
        1e-10,
    );
    for rest in ["y", "a", "c"] {
        assert_eq!(number(&space["q"][rest]), 0.0);
    }
}

/// A rubber ball that falls with spin, by Moreau's law: Λₙ = (1 + e) m v and Λₜ = (1 + eₜ) 2/7 m u, or μ Λₙ if that is less.
#[test]
fn a_ball_bounces_with_spin() {
    let (m, r, e, v) = (0.21, 0.03075, 0.5, [0.7, -0.4]);
    let w = [25.0, 60.0, 10.0];
    let height = 0.2;
    for (mu, et) in [(2.0, 0.6), (0.1, 0.6), (1.0, 0.0)] {
        let spec = Scratch::new(
            "cue_ball.machine",
            std::fs::read_to_string(
                crate::support::root().join("machines/contacts/cue_ball.machine"),
            )
            .expect("it is there")
            .replace(
                "friction: mu }",
                &format!("friction: mu, tangential_restitution: {et:?} }}"),
            )
            .replace("z: m = r", &format!("z: m = r + {height:?}"))
            .as_str(),
        );
        let falls = (2.0 * height / G).sqrt();
        let pairs = [
            ("vx", v[0]),
            ("vy", v[1]),
            ("wx", w[0]),
            ("wy", w[1]),
            ("wz", w[2]),
            ("mu", mu),
        ];
        let run = run(spec.path(), 1.2 * falls, &pairs);
        is_good(&run);
        let impacts = events(&run, "impact");
        assert_eq!(impacts.len(), 1);
        let impact = impacts[0];
        close(number(&impact["t"]), falls, 1e-13);
        let slip: [f64; 2] = [v[0] - r * w[1], v[1] + r * w[0]];
        let speed = slip[0].hypot(slip[1]);
        let normal = (1.0 + e) * m * G * falls;
        let taken = (2.0 / 7.0 * m * (1.0 + et) * speed).min(mu * normal);
        close(number(&impact["impulse"][0]), normal, 1e-13);
        let mut lost = 0.5 * m * (1.0 - e * e) * (G * falls).powi(2);
        for (k, name) in ["x", "y"].into_iter().enumerate() {
            let impulse = -taken * slip[k] / speed;
            close(number(&impact["impulse"][1 + k]), impulse, 1e-13);
            close(number(&run["v"][name]), v[k] + impulse / m, 1e-12);
            lost -= impulse * (slip[k] + 3.5 / m * impulse / 2.0);
        }
        close(number(&impact["loss"]), lost, 1e-12);
        close(number(&run["impact_loss"]), lost, 1e-12);
    }
}

/// On a slope a puck is braked along its slip, whose direction φ changes: with κ = μ/tan α, v (cos φ + κ) decreases by g sin α (κ² − 1)
/// per second, and the puck rests when it reaches zero. For κ = 1 it never rests, and approaches half its initial speed if it was thrown
/// across the slope.
#[test]
fn a_puck_turns_into_the_fall_line() {
    let spec = "machines/contacts/puck_on_slope.machine";
    for (alpha, v, phi, mu) in [
        (0.4_f64, 3.0, 2.0_f64, 0.6_f64),
        (0.2, 1.0, 1.2, 0.3),
        (0.3, 2.0, 3.0, 0.5),
    ] {
        let kappa = mu / alpha.tan();
        let rests = v * (phi.cos() + kappa) / (G * alpha.sin() * (kappa * kappa - 1.0));
        let pairs = [
            ("alpha", alpha),
            ("v", v),
            ("phi", phi),
            ("mu", mu),
            ("mu0", mu),
        ];
        let run = run(spec, 1.5 * rests, &pairs);
        is_good(&run);
        let told = run["contact_events"].as_array().expect("events");
        assert_eq!(told.len(), 1, "{told:?}");
        assert_eq!(told[0]["kind"], "sticks");
        // The last of its slip is braked by g cos α (μ − tan α), so an error of 1e-12 in its speed shifts the time.
        close(number(&told[0]["t"]), rests, 1e-9 * rests);
        for name in ["x", "y", "z"] {
            close(number(&run["v"][name]), 0.0, 1e-14);
        }
        // Friction has dissipated the work of the weight and the initial energy.
        let m = 0.16;
        let weight = m * G * alpha.sin() * number(&run["q"]["x"]);
        close(number(&run["dissipated"]), 0.5 * m * v * v + weight, 1e-10);
    }
    let alpha = 0.3_f64;
    let pairs = [
        ("alpha", alpha),
        ("v", 2.0),
        ("phi", std::f64::consts::FRAC_PI_2),
        ("mu", alpha.tan()),
        ("mu0", alpha.tan()),
    ];
    for until in [0.1, 1.0, 20.0] {
        let run = run(spec, until, &pairs);
        is_good(&run);
        let [x, y] = ["x", "y"].map(|name| number(&run["v"][name]));
        close(x.hypot(y) + x, 2.0, 1e-10);
    }
}

/// A block that is pulled by a growing force of constant direction breaks away when the force reaches μ₀ N, in that direction, and is then
/// braked by μ N.
#[test]
fn what_sticks_breaks_away_along_what_pulls() {
    let (mu, mu0, rate, m) = (0.25, 0.4, 3.0, 1.5);
    let pull: [f64; 2] = [0.6, -0.8];
    let spec = Scratch::new(
        "pulled.machine",
        "machine Pulled in space {
            parameters { m: kg = 1.5, g: m/s^2 = 9.81, k: N/s = 3, mu: 1 = 0.25, mu0: 1 = 0.4 }
            coordinates { x: m, y: m, z: m }
            bodies { block { mass: m, at: (x, y, z) } }
            gravity (0, 0, -g);
            forces { rope { at: (x, y, z), force: (0.6*k*t, -0.8*k*t, 0) } }
            contacts { floor { gap: z, slip: (der(x), der(y)), restitution: 0, friction: mu, static_friction: mu0 } }
        }",
    );
    let breaks = mu0 * m * G / rate;
    let until = breaks + 1.0;
    let run = run(spec.path(), until, &[]);
    is_good(&run);
    let told = run["contact_events"].as_array().expect("events");
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!(told[0]["kind"], "slips");
    close(number(&told[0]["t"]), breaks, 1e-12 * breaks);
    // v = ∫ (k t/m − μ g) dt from that instant.
    let speed = rate / m * 0.5 * (until * until - breaks * breaks) - mu * G * (until - breaks);
    for (k, name) in ["x", "y"].into_iter().enumerate() {
        close(number(&told[0]["direction"][k]), pull[k], 1e-12);
        close(number(&run["v"][name]), speed * pull[k], 1e-11);
    }
}

/// Two equal balls that collide: along the line of centres with e, across it with 1/7 m of the slip as impulse, or μ times
/// the normal impulse.
#[test]
fn balls_meet_with_friction() {
    let (m, r, e) = (0.2, 0.05, 0.8);
    for (mu, below) in [
        (0.05, 0.0_f64),
        (1.0, 0.0),
        (0.2, 0.03),
        (0.2, -0.06),
        (1.0, 0.1),
    ] {
        // The second ball flies past at a height that is lower by `below`, and spins.
        let spec = Scratch::new(
            "balls.machine",
            &format!(
                "machine Balls in space {{
                    constants {{ N = 2 }}
                    parameters {{ m: kg = {m:?}, r: m = {r:?}, mu: 1 = {mu:?} }}
                    coordinates {{
                        x[i in 1..N]: m = (i - 1)*0.5, y[i in 1..N]: m, z[i in 1..N]: m = (i - 1)*({below:?}),
                        a[i in 1..N]: rad, b[i in 1..N]: rad, c[i in 1..N]: rad,
                        der(x[1]): m/s = 3, der(y[1]): m/s = 0.02,
                        der(a[2]): rad/s = 4, der(b[2]): rad/s = -20, der(c[2]): rad/s = 15,
                    }}
                    frames {{ ball[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(x, a[i]).turn(y, b[i]).turn(z, c[i]) }}
                    bodies {{ ball[i in 1..N] {{ mass: m, inertia: (2/5*m*r^2, 2/5*m*r^2, 2/5*m*r^2), frame: ball[i] }} }}
                    spheres {{ ball[i in 1..N] {{ on: ball[i], center: (0, 0, 0), radius: r }} }}
                    contacts {{ every {{ spheres: ball, restitution: {e:?}, friction: mu }} }}
                }}"
            ),
        );
        let run = run(spec.path(), 0.3, &[]);
        is_good(&run);
        if below.abs() >= 2.0 * r {
            assert_eq!(events(&run, "impact").len(), 0);
            continue;
        }
        let impact = events(&run, "impact")[0];
        let q = |name: &str| number(&impact["q"][name]);
        let line = ["x", "y", "z"].map(|c| q(&format!("{c}[2]")) - q(&format!("{c}[1]")));
        let distance = line.iter().map(|c| c * c).sum::<f64>().sqrt();
        close(distance, 2.0 * r, 1e-15);
        let n = line.map(|c| c / distance);
        // The velocity of the second ball's point minus the first's. The second has rotated about axes through its own centre, so its
        // angular velocity is unchanged.
        let spin = [4.0, -20.0, 15.0];
        let turned = [
            spin[1] * n[2] - spin[2] * n[1],
            spin[2] * n[0] - spin[0] * n[2],
            spin[0] * n[1] - spin[1] * n[0],
        ];
        let first = [3.0, 0.02, 0.0];
        let relative: [f64; 3] = [0, 1, 2].map(|k| -first[k] - r * turned[k]);
        let opens: f64 = (0..3).map(|k| relative[k] * n[k]).sum();
        let slip = [0, 1, 2].map(|k| relative[k] - opens * n[k]);
        let speed = slip.iter().map(|c| c * c).sum::<f64>().sqrt();
        // Inverse inertia: 1/m of each along the line, and 7/2 of that across it.
        let normal = -(1.0 + e) * opens * m / 2.0;
        let tangential = (speed * m / 7.0).min(mu * normal);
        close(number(&impact["impulse"][0]), normal, 1e-13);
        let across = number(&impact["impulse"][1]).hypot(number(&impact["impulse"][2]));
        close(across, tangential, 1e-13);
        for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
            let impulse = normal * n[k] - tangential * slip[k] / speed;
            close(number(&run["v"][&format!("{name}[2]")]), impulse / m, 1e-12);
            close(
                number(&run["v"][&format!("{name}[1]")]),
                first[k] - impulse / m,
                1e-12,
            );
        }
    }
}

/// With sufficient friction a ball in a rotating bowl rolls as the machine with a rolling constraint does.
#[test]
fn a_ball_in_a_turning_bowl_rolls_as_by_its_constraints() {
    let rolls = run("machines/ball_in_bowl.machine", 1.0, &[]);
    let touches = run("machines/contacts/ball_in_turning_bowl.machine", 1.0, &[]);
    is_good(&touches);
    assert_eq!(
        touches["contact_events"].as_array().map(Vec::len),
        Some(0),
        "{}",
        touches["contact_events"]
    );
    for name in ["x", "y", "z", "a", "b", "c"] {
        for of in ["q", "v"] {
            let scale = 1.0 + number(&rolls[of][name]).abs();
            close(
                number(&touches[of][name]),
                number(&rolls[of][name]),
                1e-10 * scale,
            );
        }
    }
}

/// A coin on a surface with friction rolls as by constraints, too; its point of contact is given by expressions.
#[test]
fn a_coin_that_does_not_slip_rolls_as_by_its_constraints() {
    let rolls = run("machines/rolling_coin.machine", 1.0, &[]);
    let touches = run("machines/contacts/spinning_coin.machine", 1.0, &[]);
    is_good(&touches);
    assert_eq!(touches["contact_events"].as_array().map(Vec::len), Some(0));
    for name in ["heading", "lean", "roll"] {
        for of in ["q", "v"] {
            let scale = 1.0 + number(&rolls[of][name]).abs();
            close(
                number(&touches[of][name]),
                number(&rolls[of][name]),
                1e-10 * scale,
            );
        }
    }
}

/// Without rotation out of the plane, a box falls as one in the plane does: its corners lie in pairs behind each other, and share
/// the normal force.
#[test]
fn a_box_that_falls_in_a_plane_has_the_numbers_of_the_plane() {
    let plane = Scratch::new(
        "plane.machine",
        "machine Plane in plane {
            parameters { m: kg = 0.8, a: m = 0.1, c: m = 0.04, h: m = 0.3, e: 1 = 0.2, mu: 1 = 0.4, g: m/s^2 = 9.81 }
            coordinates { x: m, z: m = h, theta: rad = -0.3, der(x): m/s = 0.5 }
            frames { held = ground.shift(x, z).turn(theta) }
            bodies { box { mass: m, inertia: m/3*(a^2 + c^2), frame: held } }
            gravity (0, -g);
            contacts {
                floor { corners: ((a, c), (a, -c), (-a, c), (-a, -c)), on: held, along: ground, restitution: e, friction: mu },
            }
        }",
    );
    let plane = run(plane.path(), 0.5, &[]);
    let pairs = [("roll", 0.0), ("turning", 0.0)];
    let space = run("machines/contacts/dropped_box.machine", 0.5, &pairs);
    is_good(&plane);
    is_good(&space);
    let first = |run: &Value| number(&events(run, "impact")[0]["t"]);
    close(first(&space), first(&plane), 1e-14);
    close(number(&space["q"]["x"]), number(&plane["q"]["x"]), 1e-10);
    close(number(&space["q"]["z"]), number(&plane["q"]["z"]), 1e-10);
    close(
        number(&space["q"]["theta"]),
        -number(&plane["q"]["theta"]),
        1e-9,
    );
    close(
        number(&space["impact_loss"]),
        number(&plane["impact_loss"]),
        1e-9,
    );
}

/// A dropped box comes to rest on the floor, and the energy balance contains its initial energy.
#[test]
fn a_dropped_box_comes_to_rest() {
    let spec = "machines/contacts/dropped_box.machine";
    let run = run(spec, 1.0, &[]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    close(number(&run["q"]["z"]), 0.04, 1e-12);
    for name in ["x", "y", "z", "yaw", "theta", "phi"] {
        close(number(&run["v"][name]), 0.0, 1e-10);
    }
    close(number(&run["energy_residual"]), 0.0, 1e-9);
    let had = 0.5 * 0.8 * 0.25 + 0.8 * G * (0.3 - 0.04);
    assert!(number(&run["dissipated"]) > had);
}

/// Features that only exist for a single direction of friction are refused at their position.
#[test]
fn what_is_not_known_in_space_is_refused() {
    for (added, message) in [
        (
            "law: poisson",
            "`law: poisson` with friction is for the plane only",
        ),
        (
            "law: stronge",
            "`law: stronge` with friction is for the plane only",
        ),
        (
            "painleve: impact",
            "`painleve: impact` is for contacts with one direction of slip",
        ),
        (
            "rolling_resistance: 1e-3*m",
            "`rolling_resistance` cannot be combined with `sphere`",
        ),
    ] {
        let text = std::fs::read_to_string(
            crate::support::root().join("machines/contacts/cue_ball.machine"),
        );
        let text = text
            .expect("it is there")
            .replace("friction: mu }", &format!("friction: mu, {added} }}"));
        let spec = Scratch::new("refused.machine", &text);
        let output = lagrangian(&["check", spec.path()]);
        assert_eq!(output.status.code(), Some(1));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(message), "{said}");
    }
}

/// A bead that slides along a great circle inside a shell, without gravity, has the normal force m v²/R, so dv/dt = −μ v²/R: its speed is
/// u/(1 + μ u t/R), and its angle is log(1 + μ u t/R)/μ. No field of tangents is continuous on a sphere: where the one used jumps, 5/16 R
/// above the centre, the bead must move as anywhere else.
#[test]
fn a_bead_passes_the_place_where_tangents_of_a_sphere_jump() {
    let spec = Scratch::new(
        "shell.machine",
        "machine Shell in space {
            parameters { m: kg = 0.3, R: m = 1.5, mu: 1 = 0.2, v: m/s = 0, w: m/s = 0 }
            coordinates { x: m = R, y: m, z: m, der(y): m/s = v, der(z): m/s = w }
            frames { bead = ground.shift(x, y, z) }
            bodies { bead { mass: m, frame: bead } }
            spheres { shell { on: ground, center: (0, 0, 0), radius: R } }
            contacts { wall { point: (0, 0, 0), on: bead, inside: shell, restitution: 0, friction: mu } }
        }",
    );
    let (r, mu, u, until) = (1.5_f64, 0.2, 4.5, 4.0);
    let around = (1.0 + mu * u * until / r).ln() / mu;
    let rate = u / (1.0 + mu * u * until / r);
    let slides = |angle: f64| {
        let along = [angle.cos(), angle.sin()];
        let run = run(
            spec.path(),
            until,
            &[("v", u * along[0]), ("w", u * along[1])],
        );
        is_good(&run);
        assert_eq!(run["contact_events"].as_array().map(Vec::len), Some(0));
        let (cos, sin) = (around.cos(), around.sin());
        for (name, q, v) in [
            ("x", cos, -sin),
            ("y", sin * along[0], cos * along[0]),
            ("z", sin * along[1], cos * along[1]),
        ] {
            close(number(&run["q"][name]), r * q, 1e-10);
            close(number(&run["v"][name]), rate * v, 1e-10);
        }
    };
    // There is no jump in the plane of the equator; the others are meridians, up and down, and circles that pass the jump twice.
    for angle in [0.0, 90.0, -90.0, 89.9, 70.0, 45.0, 30.0, 20.0, 18.3, -45.0] {
        slides(f64::to_radians(angle));
    }
}

/// A plate on three feet slides down a slope, as it is pushed ever harder. On one slope its slip and its rotation fade together, and it comes to rest as a whole;
/// on the other one it comes to turn about one foot, which then sticks until it is pushed away. Where rates are as small as errors of steps, these
/// would say in what direction a foot slips: the instants converge with the tolerance.
#[test]
fn plates_come_to_rest_or_turn_about_a_foot() {
    let plate = |rate: f64,
                 turns: [f64; 3],
                 skew: [f64; 2],
                 weight: [f64; 3],
                 push: ([f64; 3], [f64; 2]),
                 feet: [[f64; 2]; 3],
                 h: f64,
                 friction: [f64; 2]| {
        let at: Vec<String> = feet
            .iter()
            .enumerate()
            .map(|(i, [x, y])| {
                let [kinetic, at_rest] = friction;
                format!("c{i} {{ point: ({x:?}, {y:?}, {:?}), on: held, along: plane, restitution: 0, friction: {kinetic:?}, static_friction: {at_rest:?} }}", -h)
            })
            .collect();
        let ([px, py, pz], [dx, dy]) = push;
        Scratch::new(
            "plate.machine",
            &format!(
                "machine Plate in space {{
                    parameters {{ rate: N/s = {rate:?} }}
                    coordinates {{ x: m, y: m, z: m = {h:?}, yaw: rad, theta: rad, phi: rad }}
                    frames {{
                        plane = ground.shift(0.3, -0.2, 0.1).turn(x, {:?}).turn(y, {:?}).turn(z, {:?}),
                        held = plane.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi),
                        skew = held.turn(x, {:?}).turn(y, {:?}),
                    }}
                    bodies {{ plate {{ mass: 2, inertia: (0.03, 0.02, 0.04), frame: skew }} }}
                    forces {{
                        weight {{ at: held.point(0, 0, 0), force: 19.62*plane.vector({:?}, {:?}, {:?}) }},
                        push {{ at: held.point({px:?}, {py:?}, {pz:?}), force: rate*t*plane.vector({dx:?}, {dy:?}, 0) }},
                    }}
                    contacts {{ {} }}
                }}",
                turns[0], turns[1], turns[2], skew[0], skew[1], weight[0], weight[1], weight[2], at.join(", ")
            ),
        )
    };
    let stops = plate(
        3.284,
        [0.4966, -0.4555, 0.3602],
        [0.223, 0.1942],
        [7.441e-06, 0.3564, -0.9343],
        ([0.04128, -0.04736, -0.008655], [-0.4542, -0.8909]),
        [[0.2933, -0.02628], [-0.05429, 0.3491], [-0.03657, -0.3112]],
        0.03282,
        [0.3083, 0.359],
    );
    let turns = plate(
        5.872,
        [0.3431, -0.3646, 0.4195],
        [-0.02551, -0.4127],
        [-0.04928, 0.1046, -0.9933],
        ([0.01111, 0.1872, 0.01738], [0.8344, 0.5512]),
        [[0.2948, -0.03725], [-0.1715, 0.1161], [-0.1429, -0.2592]],
        0.09578,
        [0.1129, 0.1212],
    );
    for (spec, resting) in [(&stops, 3), (&turns, 1)] {
        let sticks = |tolerance: &str| {
            let run = json(&[
                "simulate",
                spec.path(),
                "--until",
                "3",
                "--tolerance",
                tolerance,
                "--max-steps",
                "2000",
                "--json",
            ]);
            is_good(&run);
            let stopped = events(&run, "sticks");
            assert_eq!(stopped.len(), resting, "{run:#}");
            let t = number(&stopped[0]["t"]);
            assert!(stopped.iter().all(|event| number(&event["t"]) == t));
            t
        };
        let exact = sticks("1e-13");
        // A slip of 15 tolerances in m/s is braked by some 0.5 m/s², and errors of steps add up beside that.
        for (tolerance, within) in [
            ("1e-6", 1e-3),
            ("1e-8", 1e-5),
            ("1e-10", 1e-7),
            ("1e-12", 1e-9),
        ] {
            close(sticks(tolerance), exact, within);
        }
    }
}

/// A table falls on its feet and turns on one of them, whose slip fades without turning and stops: at the same instant, however small the tolerance, and in
/// few steps.
#[test]
fn a_table_comes_to_rest_on_one_foot() {
    let spec = Scratch::new(
        "table.machine",
        "machine Table in space {
            parameters { g: m/s^2 = 9.81 }
            coordinates { x: m, y: m, z: m = 0.436, yaw: rad = 0.75, th: rad = 0.171, ph: rad = -0.35,
                der(x): m/s = 1.288, der(y): m/s = 0.38, der(yaw): rad/s = -5.36 }
            frames { held = ground.shift(x, y, z).turn(z, yaw).turn(y, th).turn(x, ph) }
            bodies { box { mass: 2.813, inertia: (0.0457019, 0.0259293, 0.0437187), frame: held } }
            gravity (0, 0, -g);
            contacts {
                foot { corners: ((0.113, 0, -0.122), (0, 0.184, -0.122), (-0.113, 0, -0.122), (0, -0.184, -0.122)), on: held, along: ground,
                    restitution: 0.2, friction: 1, static_friction: 1.5 }
            }
        }",
    );
    let sticks = |tolerance: &str| {
        let arguments = ["simulate", spec.path(), "--until", "0.72", "--json"];
        let run = json(
            &[
                &arguments[..],
                &["--tolerance", tolerance, "--max-steps", "2000"],
            ]
            .concat(),
        );
        is_good(&run);
        let sticks = events(&run, "sticks");
        number(&sticks.last().expect("a foot that stops")["t"])
    };
    let exact = sticks("1e-12");
    // A slip of some 40 tolerances in m/s, with rates of several rad/s, is braked by 0.23 m/s².
    for (tolerance, within) in [("1e-9", 1e-6), ("1e-11", 1e-8)] {
        close(sticks(tolerance), exact, within);
    }
}
