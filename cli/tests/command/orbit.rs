//! `lagrangian orbit` against periods and multipliers in closed form and to 30 digits; the latter come from
//! `orbit/by_mpmath.py` and `orbit/woodpecker.py`.

use std::f64::consts::{PI, TAU};

use crate::support::{Scratch, json, lagrangian, number, root};
use serde_json::Value;

fn orbit(arguments: &[&str]) -> Value {
    json(&[&["orbit"], arguments, &["--json"]].concat())
}

/// The message of a call that fails, and its exit status.
fn refused(arguments: &[&str]) -> (i32, String) {
    let output = lagrangian(&[&["orbit"], arguments].concat());
    let said = String::from_utf8(output.stderr).expect("text");
    (output.status.code().expect("no signal"), said)
}

/// Multipliers, each with its error and whether it is trivial.
fn multipliers(found: &Value) -> Vec<(f64, f64, f64, bool)> {
    let all = found["multipliers"].as_array().expect("a list").iter();
    all.map(|one| {
        let trivial = one["trivial"].as_bool().expect("a truth");
        (
            number(&one["re"]),
            number(&one["im"]),
            number(&one["error"]),
            trivial,
        )
    })
    .collect()
}

/// The tolerance of steps is 1e-11. A period takes about a hundred steps, each of which may err by that much, and a multiplier of size μ
/// amplifies errors as the motion does: 1e-8 of the largest is ten times the resulting error.
const CLOSE: f64 = 1e-8;

fn assert_multipliers(found: &Value, exact: &[(f64, f64)]) {
    let all = multipliers(found);
    assert_eq!(all.len(), exact.len(), "{found:#}");
    let largest = exact
        .iter()
        .fold(1.0_f64, |most, (re, im)| most.max(re.hypot(*im)));
    for ((re, im, error, _), (exact_re, exact_im)) in all.iter().zip(exact) {
        let off = (re - exact_re).hypot(im - exact_im);
        assert!(
            off <= CLOSE * largest,
            "{re} + {im}i, not {exact_re} + {exact_im}i: {off:e}"
        );
        // The error that the command reports is a bound.
        assert!(off <= error + 1e-14, "{off:e}, said to be below {error:e}");
    }
}

#[test]
fn kapitzas_pendulum_upright_has_the_multipliers_of_mathieus_equation() {
    // Shaken with twice the amplitude that stabilizes it, with too little, and with so much that it swings at half the frequency.
    for (a, omega, exact, stability) in [
        (
            "0.1",
            "88",
            [
                (0.926_172_254_050_953, 0.377_100_723_714_734_8),
                (0.926_172_254_050_953, -0.377_100_723_714_734_8),
            ],
            "undecided",
        ),
        (
            "0.1",
            "30",
            [
                (1.629_408_829_591_548_4, 0.0),
                (0.613_719_517_065_999_2, 0.0),
            ],
            "unstable",
        ),
        (
            "0.5",
            "88",
            [
                (-2.378_748_545_901_472, 0.0),
                (-0.420_389_116_673_545_3, 0.0),
            ],
            "unstable",
        ),
    ] {
        let (a, omega) = (format!("a={a}"), format!("omega={omega}"));
        let found = orbit(&[
            "machines/kapitza_pendulum.machine",
            "--set",
            &a,
            "--set",
            &omega,
            "--start",
            "theta=0",
            "--period",
            "2*pi/omega",
        ]);
        assert_multipliers(&found, &exact);
        assert_eq!(found["stability"], stability);
        assert_eq!(found["autonomous"], false);
        assert_eq!(number(&found["at"]["q"]["theta"]), 0.0);
        // The flow preserves phase volume: the product of all multipliers is 1.
        let m: Vec<f64> = (found["monodromy"].as_array().unwrap().iter())
            .flat_map(|row| row.as_array().unwrap().iter().map(number))
            .collect();
        assert!((m[0] * m[3] - m[1] * m[2] - 1.0).abs() < CLOSE * 10.0);
    }
}

/// Kapitza's pendulum in the coordinates of its bob, on a rod from the shaken pivot: a rheonomic constraint.
#[test]
fn on_a_shaken_rod_the_multipliers_are_those_of_the_angle() {
    let spec = Scratch::new(
        "rod.machine",
        "machine Rod in plane {
            parameters { l: m = 1, a: m = 0.1, omega: rad/s = 88, g: m/s^2 = 9.81 }
            coordinates { x: m = 0, y: m = l + a }
            bodies { bob { mass: 2, at: (x, y) } }
            gravity (0, -g);
            constraints { rod: x^2 + (y - a*cos(omega*t))^2 = l^2 }
        }",
    );
    for (a, omega, exact) in [
        (
            "a=0.1",
            "omega=88",
            [
                (0.926_172_254_050_953, 0.377_100_723_714_734_8),
                (0.926_172_254_050_953, -0.377_100_723_714_734_8),
            ],
        ),
        (
            "a=0.5",
            "omega=88",
            [
                (-2.378_748_545_901_472, 0.0),
                (-0.420_389_116_673_545_3, 0.0),
            ],
        ),
    ] {
        let found = orbit(&[
            spec.path(),
            "--set",
            a,
            "--set",
            omega,
            "--period",
            "2*pi/omega",
        ]);
        assert_multipliers(&found, &exact);
        assert_eq!(found["states"], serde_json::json!(["x", "der(x)"]));
        assert!(number(&found["at"]["q"]["x"]).abs() < CLOSE);
    }
}

/// A skate on a slope that turns at ω goes down by `g sin²(ωt)/(2ω²)` and back up, and across by `g (ωt − sin(2ωt)/2)/(2ω²)`. With speed u along
/// the blade and φ(0) = 0, in general
///
/// ```text
/// u̇ = g cos φ,   x(T) = x₀ + ∫ u cos φ dt,   y(T) = y₀ + ∫ u sin φ dt
/// ```
///
/// The derivatives by the start at u(0) = 0 and ωT = 2π are ∂y/∂ω = −2πg/ω³, ∂φ/∂ω = T, ∂u/∂ω = gT/ω; all others are those of the identity.
#[test]
fn a_skate_on_a_slope_has_its_monodromy_in_closed_form() {
    let spec = Scratch::new(
        "skate.machine",
        "machine Skate in plane {
            parameters { g: m/s^2 = 1 }
            coordinates { x: m, y: m, phi: rad }
            bodies { skate { mass: 3, inertia: 0.7, at: (x, y), angle: phi } }
            gravity (g, 0);
            constraints { blade: cos(phi)*der(y) = sin(phi)*der(x) }
        }",
    );
    let across = (PI / 4.0).to_string();
    let found = orbit(&[
        spec.path(),
        "--rate",
        "phi=2.1",
        "--keep",
        "phi,der(x)",
        "--period",
        "pi*s",
        "--advance",
        "phi=2*pi",
        "--advance",
        &format!("y={across}"),
    ]);
    assert_eq!(
        found["states"],
        serde_json::json!(["x", "y", "phi", "der(x)", "der(phi)"])
    );
    assert!((number(&found["at"]["v"]["phi"]) - 2.0).abs() < CLOSE);
    let turned = number(&found["at"]["q"]["phi"]);
    assert!(turned.abs() < CLOSE, "{turned}");
    let mut exact = [[0.0; 5]; 5];
    for (k, row) in exact.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    (exact[1][4], exact[2][4], exact[3][4]) = (-PI / 4.0, PI, PI / 2.0);
    for (row, exact) in found["monodromy"].as_array().unwrap().iter().zip(exact) {
        for (x, exact) in row.as_array().unwrap().iter().zip(exact) {
            assert!((number(x) - exact).abs() < 10.0 * CLOSE, "{found:#}");
        }
    }
    assert_eq!(found["multipliers"].as_array().unwrap().len(), 5);
}

/// The period of a free pendulum is an elliptic integral, also when its bob has two coordinates and the start is projected onto the rod.
#[test]
fn a_pendulum_on_a_rod_has_the_period_of_its_angle() {
    let spec = Scratch::new(
        "bob.machine",
        "machine Bob in plane {
            parameters { l: m = 0.8, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.6, y: m = -0.5 }
            bodies { bob { mass: 0.3, at: (x, y) } }
            gravity (0, -g);
            constraints { rod: x^2 + y^2 = l^2 }
        }",
    );
    let found = orbit(&[spec.path(), "--keep", "x,der(x)"]);
    let x = number(&found["at"]["q"]["x"]);
    assert_eq!(x, 0.6);
    let half = 0.5 * (0.6_f64 / 0.8).asin();
    // T = 2π √(l/g) / agm(1, cos(θ₀/2)).
    let (mut a, mut b) = (1.0, half.cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    let exact = TAU * (0.8_f64 / 9.81).sqrt() / a;
    assert!((number(&found["period"]) - exact).abs() < CLOSE);
    let all = multipliers(&found);
    assert_eq!(all.len(), 2);
    for (re, im, error, _) in all {
        assert!((re - 1.0).hypot(im) < CLOSE.max(error), "{found:#}");
    }
    assert_eq!(found["family"], 1);
}

#[test]
fn upright_is_found_from_beside_it() {
    let found = orbit(&[
        "machines/kapitza_pendulum.machine",
        "--start",
        "theta=0.05",
        "--period",
        "2*pi/omega",
    ]);
    assert!(number(&found["at"]["q"]["theta"]).abs() < 1e-9, "{found:#}");
}

#[test]
fn upright_doubles_its_period_where_mathieus_equation_does() {
    let found = orbit(&[
        "machines/kapitza_pendulum.machine",
        "--start",
        "theta=0",
        "--period",
        "2*pi/omega",
        "--along",
        "a=0.42..0.5:5",
    ]);
    let changes = found["changes"].as_array().expect("a list");
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert_eq!(changes[0]["change"], "period doubling");
    // b₁(2a/l) = −4g/(l ω²) at the change of stability.
    let exact = 0.456_149_688_466_770_1;
    let between = changes[0]["between"].as_array().expect("a list");
    let (low, high) = (number(&between[0]), number(&between[1]));
    // The bracket has 20 bisections of 0.02. A multiplier counts as outside the unit circle once its distance exceeds its error, and the
    // distance grows as the square root of the parameter's.
    assert!(low - 1e-6 <= exact && exact <= high + 1e-6, "{low} {high}");
}

const SWING: &str = "machine Swing in plane {
    parameters { l: m = 1, g: m/s^2 = 9.81 }
    coordinates { theta: rad = 2 }
    bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
    gravity (0, -g);
}";

#[test]
fn a_pendulums_period_is_an_elliptic_integral() {
    let spec = Scratch::new("swing.machine", SWING);
    for (start, exact) in [
        ("theta=2", 2.665_870_942_834_925),
        ("theta=0.5", 2.037_867_915_158_168_8),
    ] {
        let found = orbit(&[spec.path(), "--start", start, "--keep", "theta,der(theta)"]);
        assert!(
            (number(&found["period"]) / exact - 1.0).abs() < CLOSE,
            "{found:#}"
        );
        assert_eq!(found["family"], 1);
        assert_eq!(found["stability"], "undecided");
        // Both multipliers are 1, since energy is conserved; the multiplier across the motion is as accurate as M.
        assert_multipliers(&found, &[(1.0, 0.0), (1.0, 0.0)]);
        assert_eq!(multipliers(&found).iter().filter(|one| one.3).count(), 1);
    }
    // The inverse problem: the amplitude that has a given period.
    let found = orbit(&[
        spec.path(),
        "--start",
        "theta=1.8",
        "--period",
        "2.665870942834925",
    ]);
    let q = number(&found["at"]["q"]["theta"]);
    let v = number(&found["at"]["v"]["theta"]);
    // The energy ½ v² − g cos q equals −g cos 2.
    let energy = 0.5 * v * v - 9.81 * q.cos();
    assert!((energy + 9.81 * 2.0_f64.cos()).abs() < 1e-6, "{found:#}");
}

#[test]
fn units_and_coordinates_do_not_matter() {
    // The same pendulum in another angle, of half the size, and with its length in mm.
    let spec = Scratch::new("swing.machine", SWING);
    let other = Scratch::new(
        "other.machine",
        "machine Other in plane {
            parameters { l: mm = 1000, g: m/s^2 = 9.81 }
            coordinates { half: rad = 0.9 }
            bodies { bob { mass: 3, at: l*(sin(2*half), -cos(2*half)) } }
            gravity (0, -g);
        }",
    );
    let one = orbit(&[
        spec.path(),
        "--start",
        "theta=1.8",
        "--rate",
        "theta=0.3",
        "--period",
        "2.6",
    ]);
    let two = orbit(&[other.path(), "--rate", "half=0.15", "--period", "2.6"]);
    // The orbit that is selected from the family, and its starting point, are the nearest in the metric of inertia, so they do not depend
    // on the coordinates.
    for part in ["q", "v"] {
        let (one, two) = (
            number(&one["at"][part]["theta"]),
            number(&two["at"][part]["half"]),
        );
        assert!((one - 2.0 * two).abs() < 1e-6, "{part}: {one} {two}");
    }
}

/// A limit cycle in closed form: x = cos t, on which the energy is constant.
const CIRCLE: &str = "machine Circle in plane {
    parameters { d: N*s/m = 1, size: m = 1, speed: m/s = 1 }
    coordinates { x: m = 1.5 }
    bodies { ball { mass: 1, at: (x, 0) } }
    springs { back { stiffness: 1, stretch: x } }
    forces { feed { on: x, value: d*(1 - (x/size)^2 - (der(x)/speed)^2)*der(x) } }
}";

#[test]
fn a_limit_cycle_in_closed_form() {
    let spec = Scratch::new("circle.machine", CIRCLE);
    // On the cycle the divergence 1 − x² − 3 v² is −2 sin² t, whose integral over a period is −2π.
    for more in [&["--near", "6"][..], &[], &["--settle", "20"]] {
        let found = orbit(&[&[spec.path()], more].concat());
        assert!(
            (number(&found["period"]) / TAU - 1.0).abs() < CLOSE,
            "{found:#}"
        );
        assert_multipliers(&found, &[(1.0, 0.0), ((-TAU).exp(), 0.0)]);
        assert_eq!(found["stability"], "stable");
        assert_eq!(found["family"], 0);
        let (q, v) = (
            number(&found["at"]["q"]["x"]),
            number(&found["at"]["v"]["x"]),
        );
        assert!((q.hypot(v) - 1.0).abs() < CLOSE);
    }
}

#[test]
fn van_der_pols_cycle_has_its_period_to_ten_digits() {
    let spec = Scratch::new(
        "vdp.machine",
        "machine VanDerPol in plane {
            parameters { mu: N*s/m = 1, size: m = 1 }
            coordinates { x: m = 2 }
            bodies { ball { mass: 1, at: (x, 0) } }
            springs { back { stiffness: 1, stretch: x } }
            forces { feed { on: x, value: mu*(1 - (x/size)^2)*der(x) } }
        }",
    );
    let found = orbit(&[spec.path()]);
    assert!(
        (number(&found["period"]) / 6.663_286_859_323_13 - 1.0).abs() < 1e-10,
        "{found:#}"
    );
    assert_multipliers(&found, &[(1.0, 0.0), (8.596_950_636_038_052e-4, 0.0)]);
    // With der(x) = 0 at the start, the orbit begins at its greatest x, 2.0086198608748431.
    let kept = orbit(&[spec.path(), "--keep", "der(x)"]);
    assert!(
        (number(&kept["at"]["q"]["x"]) - 2.008_619_860_874_843).abs() < CLOSE,
        "{kept:#}"
    );
    assert_eq!(number(&kept["at"]["v"]["x"]), 0.0);
    assert_eq!(found["periods"], 1);
    // Two and three turns of it are periodic too, which is said.
    for (near, turns) in [("13.3", 2), ("20", 3)] {
        let longer = orbit(&[spec.path(), "--near", near]);
        let period = f64::from(turns) * number(&found["period"]);
        assert!(
            (number(&longer["period"]) / period - 1.0).abs() < 1e-9,
            "{longer:#}"
        );
        assert_eq!(longer["periods"], turns);
    }
}

/// The roots of λ² + 3λ + 1 = 0.
const AT_REST: [f64; 2] = [-0.381_966_011_250_105, -2.618_033_988_749_895];

#[test]
fn van_der_pols_cycle_is_the_same_with_states_of_first_order() {
    let spec = Scratch::new(
        "vdp.machine",
        "machine VanDerPol in plane {
            parameters { mu: 1/s = 1, k: 1/s^2 = 1, size: m = 1 }
            // What is at rest beside the states: e^{λt} with λ² + 3λ + 1 = 0.
            coordinates { rest: m }
            bodies { block { mass: 1, at: (rest, 0) } }
            gravity none;
            springs { back { stiffness: 1, stretch: rest } }
            dampers { oil { damping: 3, stretch: rest } }
            states {
                x: m = 2, der(x) = y,
                y: m/s = 0, der(y) = mu*(1 - (x/size)^2)*y - k*x,
            }
        }",
    );
    let found = orbit(&[spec.path()]);
    assert!(
        (number(&found["period"]) / 6.663_286_859_323_13 - 1.0).abs() < 1e-10,
        "{found:#}"
    );
    assert_eq!(
        found["states"],
        serde_json::json!(["rest", "der(rest)", "x", "y"])
    );
    let beside = AT_REST.map(|rate| ((rate * 6.663_286_859_323_13).exp(), 0.0));
    let own = (8.596_950_636_038_052e-4, 0.0);
    assert_multipliers(&found, &[(1.0, 0.0), beside[0], own, beside[1]]);
    let kept = orbit(&[spec.path(), "--keep", "y"]);
    assert!(
        (number(&kept["at"]["states"]["x"]) - 2.008_619_860_874_843).abs() < CLOSE,
        "{kept:#}"
    );
    assert_eq!(number(&kept["at"]["states"]["y"]), 0.0);
    // The text output lists the states by name and does not mention their integrals.
    let said = lagrangian(&["orbit", spec.path(), "--keep", "y"]);
    let said = String::from_utf8(said.stdout).expect("text");
    assert!(
        said.contains("\n  x    = 2.00861986")
            && said.contains("\n  y    = 0")
            && !said.contains("integral"),
        "{said}"
    );
    let (status, said) = refused(&[spec.path(), "--advance", "x=1"]);
    assert_eq!(status, 2, "{said}");
    assert!(said.contains("returns to its value"), "{said}");
}

#[test]
fn a_circuit_on_a_sine_has_its_phase_and_forgets_by_its_time_constant() {
    // τ u′ = U sin Ωt − u: u = U (sin Ωt − Ωτ cos Ωt)/(1 + Ω²τ²), and a deviation from it decays as e^{−t/τ}.
    let spec = Scratch::new(
        "filter.machine",
        "machine Filter in plane {
            parameters { R: ohm = 1e3, C: F = 1e-6, U: V = 2, Omega: rad/s = 2000 }
            // What is at rest beside the circuit: e^{λt} with λ² + 3λ + 1 = 0.
            coordinates { rest: m }
            bodies { block { mass: 1, at: (rest, 0) } }
            gravity none;
            springs { back { stiffness: 1, stretch: rest } }
            dampers { oil { damping: 3, stretch: rest } }
            states { u: V = 0, der(u) = (U*sin(Omega*t) - u)/(R*C) }
        }",
    );
    let found = orbit(&[spec.path(), "--period", "2*pi/Omega"]);
    let (turn, period) = (2.0, TAU / 2000.0); // Ωτ
    let start = -2.0 * turn / (1.0 + turn * turn);
    assert!((number(&found["at"]["states"]["u"]) - start).abs() < CLOSE);
    let with = |tau: f64| {
        let [slow, fast] = AT_REST.map(|rate| ((rate * period).exp(), 0.0));
        [slow, fast, ((-period / tau).exp(), 0.0)]
    };
    assert_multipliers(&found, &with(1e-3));
    assert_eq!(found["stability"], "stable");
    // The search starts from the settled state, or follows the orbit as a resistance varies.
    let settled = orbit(&[spec.path(), "--period", "2*pi/Omega", "--settle", "0.02"]);
    assert!((number(&settled["at"]["states"]["u"]) - start).abs() < CLOSE);
    let along = orbit(&[
        spec.path(),
        "--period",
        "2*pi/Omega",
        "--along",
        "R=1e3..2e3:3",
    ]);
    let points = along["points"].as_array().expect("a list");
    for (point, tau) in points.iter().zip([1e-3, 1.5e-3, 2e-3]) {
        assert_multipliers(point, &with(tau));
    }
    // A time that is not a period is reported with the state that does not come back.
    let (_, said) = refused(&[spec.path(), "--period", "3/Omega"]);
    assert!(said.contains("the rate of `u` is different"), "{said}");
}

#[test]
fn a_driven_oscillator_answers_as_its_frequency_response_says() {
    // x″ + 2 δ x′ + ω₀² x = F cos Ω t: amplitude F/|ω₀² − Ω² + 2iδΩ|, multipliers e^{(−δ ± iω) T}.
    let spec = Scratch::new(
        "driven.machine",
        "machine Driven in plane {
            parameters { k: N/m = 4, d: N*s/m = 0.4, f: N = 3, Omega: rad/s = 1.5 }
            coordinates { x: m = 0.1 }
            bodies { ball { mass: 1, at: (x, 0) } }
            springs { back { stiffness: k, stretch: x } }
            dampers { oil { damping: d, stretch: x } }
            forces { drive { on: x, value: f*cos(Omega*t) } }
        }",
    );
    let found = orbit(&[spec.path(), "--period", "2*pi/Omega"]);
    let (delta, drive) = (0.2, 1.5_f64);
    let (re, im) = (4.0 - drive * drive, 2.0 * delta * drive);
    let size = 3.0 / re.hypot(im);
    let phase = im.atan2(re);
    let (q, v) = (
        number(&found["at"]["q"]["x"]),
        number(&found["at"]["v"]["x"]),
    );
    assert!((q - size * phase.cos()).abs() < CLOSE, "{found:#}");
    assert!((v - drive * size * phase.sin()).abs() < CLOSE);
    let (period, omega) = (TAU / drive, (4.0 - delta * delta).sqrt());
    let modulus = (-delta * period).exp();
    let angle = (omega * period).rem_euclid(TAU);
    let angle = if angle > PI { TAU - angle } else { angle };
    let (re, im) = (modulus * angle.cos(), modulus * angle.sin());
    assert_multipliers(&found, &[(re, im), (re, -im)]);
    assert_eq!(found["stability"], "stable");
    // A linear machine needs one iteration, and one more to detect convergence.
    assert!(found["rounds"].as_u64().expect("a count") <= 2);
    // It answers with the period of the drive, also if twice that is given.
    assert_eq!(found["periods"], 1);
    let twice = orbit(&[spec.path(), "--period", "4*pi/Omega"]);
    assert_eq!(twice["periods"], 2);
}

/// What is crushed stays so: a motion that crushes a layer in its first period does not return, although coordinates and rates may after that period.
#[test]
fn a_motion_that_crushes_a_layer_does_not_return() {
    let wall = |wall: &str| {
        let text = "machine Wall in plane {
            parameters { k: N/m = 40, c: N*s/m = 0.8, F: N = 4, w: rad/s = 5, k1: N/m = 300, k2: N/m = 900, l: m = 0.1 }
            coordinates { x: m }
            bodies { mass { mass: 1, at: (x, 0) } }
            springs { back { stiffness: k, stretch: x } }
            dampers { oil { damping: c, stretch: x } }
            forces { drive { on: x, value: F*cos(w*t + 3) } }
            contacts { wall { gap: l - x, compliance: WALL } }
        }";
        text.replace("WALL", wall)
    };
    let layer = Scratch::new("layer.machine", &wall("layer(k1, k2)"));
    let settled = ["--period", "2*pi/w", "--settle", "100"];
    let (status, said) = refused(&[&[layer.path()][..], &settled].concat());
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("crushes the layer of `wall`"), "{said}");
    // Without the wall in reach, and where unloading gives back everything, the motion returns.
    let far = orbit(&[&[layer.path(), "--set", "l=1"][..], &settled].concat());
    assert_eq!(far["stability"], "stable");
    let same = orbit(&[&[layer.path(), "--set", "k2=300"][..], &settled].concat());
    let spring = Scratch::new("spring.machine", &wall("linear(k1, 0*c)"));
    let spring = orbit(&[&[spring.path()][..], &settled].concat());
    for (part, name) in [("q", "x"), ("v", "x")] {
        let [own, other] = [&same, &spring].map(|found| number(&found["at"][part][name]));
        assert!((own - other).abs() < CLOSE, "{own} {other}");
    }
}

/// A ball that leaps over a wavy floor and bounces on its crests, between which it flies for the time T = 2 √(2 (h − A)/g): it advances by a wave in that
/// time. Other leaps over a crest return to their height and speeds as well, but not to the same place of a wave.
#[test]
fn a_ball_leaps_over_waves_by_whole_waves() {
    let floor = |slip: &str| {
        let text = "machine Waves in plane {
            parameters { g: m/s^2 = 9.81, A: m = 0.02, wave: m = 0.5, w: rad/s = 5, mu: 1 = 0.3, u: m/s = 1 }
            coordinates { x: m = -0.25, y: m = 0.5, der(x): m/s = 0.8 }
            bodies { ball { mass: 1, at: (x, y) } }
            gravity (0, -g);
            contacts { floor { gap: y - A*cos(2*pi*x/wave), restitution: 1 SLIP } }
        }";
        text.replace("SLIP", slip)
    };
    let smooth = Scratch::new("smooth.machine", &floor(""));
    let leap = [smooth.path(), "--near", "0.63", "--keep", "y,der(y)"];
    let found = orbit(&[&leap[..], &["--advance", "x=0.5"]].concat());
    let period = 2.0 * (2.0 * (0.5 - 0.02) / 9.81_f64).sqrt();
    assert!((number(&found["period"]) - period).abs() < CLOSE);
    assert!((number(&found["at"]["v"]["x"]) - 0.5 / period).abs() < CLOSE);
    let (status, said) = refused(&[&leap[..], &["--advance", "x=0.2"]].concat());
    assert_eq!(status, 1, "{said}");
    for words in ["is not the same", "the contact `floor` touches differs"] {
        assert!(said.contains(words), "{said}");
    }
    // Friction that changes with time drives it.
    let rubs = floor(", slip: der(x) - u, friction: mu*(1 + 0.9*sin(w*t))");
    let rubs = Scratch::new("rubs.machine", &rubs);
    let (_, said) = refused(&[rubs.path(), "--near", "0.63"]);
    assert!(said.contains("change with time"), "{said}");
    // A belt that runs steadily does not: the ball goes along with it.
    let belt = Scratch::new("belt.machine", &floor(", slip: der(x) - u, friction: mu"));
    let period = 2.0 * (2.0 * 0.5 / 9.81_f64).sqrt();
    let along = format!("x={period:?}");
    let along = ["--set", "A=0", "--rate", "x=1", "--advance", &along];
    let near = [belt.path(), "--near", "0.63", "--keep", "y,der(y)"];
    let found = orbit(&[&near[..], &along].concat());
    assert_eq!(found["autonomous"], true);
    assert!((number(&found["period"]) - period).abs() < CLOSE);
    assert!((number(&found["at"]["v"]["x"]) - 1.0).abs() < CLOSE);
}

#[test]
fn a_wheel_that_turns_has_an_orbit_up_to_whole_turns() {
    // An unbalanced wheel that turns freely: φ advances by 2π, with ½ J φ′² + m g e sin φ constant.
    let spec = Scratch::new(
        "wheel.machine",
        "machine Wheel in plane {
            parameters { m: kg = 1, e: m = 0.1, g: m/s^2 = 9.81 }
            coordinates { phi: rad = 0 }
            bodies { weight { mass: m, at: e*(cos(phi), sin(phi)) } }
            gravity (0, -g);
        }",
    );
    let keep = [
        "--rate",
        "phi=20",
        "--keep",
        "phi,der(phi)",
        "--near",
        "0.3",
    ];
    let found = orbit(&[&[spec.path(), "--advance", "phi=2*pi"], &keep[..]].concat());
    // T = ∫ dφ/√(ω² − 2 (g/e) sin φ) has a smooth periodic integrand: the trapezoidal rule with 64 points is exact to rounding.
    let places = 64;
    let sum: f64 = (0..places)
        .map(|k| TAU * f64::from(k) / f64::from(places))
        .map(|phi| 1.0 / (400.0 - 2.0 * 98.1 * phi.sin()).sqrt())
        .sum();
    let exact = sum * TAU / f64::from(places);
    assert!(
        (number(&found["period"]) / exact - 1.0).abs() < CLOSE,
        "{found:#}"
    );
    let (status, said) = refused(&[&[spec.path(), "--advance", "phi=3"], &keep[..]].concat());
    assert_eq!(status, 1);
    assert!(
        said.contains("whole turns") && said.contains("`phi`"),
        "{said}"
    );
}

#[test]
fn what_cannot_be_is_said_with_what_helps() {
    let rods = |rods: &str| {
        let text = "machine Twice in plane {
            coordinates { x: m = 0.6, y: m = -0.8 }
            bodies { bob { mass: 1, at: (x, y) } }
            gravity (0, -9.81*m/s^2);
            constraints { RODS }
        }";
        text.replace("RODS", rods)
    };
    let once = Scratch::new("once.machine", &rods("rod: x^2 + y^2 = 1*m^2"));
    let twice = rods("rod: x^2 + y^2 = 1*m^2, again: 2*x^2 + 2*y^2 = 2*m^2");
    let twice = Scratch::new("twice.machine", &twice);
    let spec = Scratch::new("swing.machine", SWING);
    let kapitza = "machines/kapitza_pendulum.machine";
    for (arguments, status, words) in [
        (
            &[kapitza][..],
            1,
            &["change with time", "--period", "omega = 0"][..],
        ),
        (
            &[kapitza, "--near", "0.07"],
            1,
            &["change with time", "--period"],
        ),
        (
            &[kapitza, "--period", "0.05"],
            1,
            &["not with the period 0.05 s", "`theta`"],
        ),
        (&[kapitza, "--period", "theta"], 2, &["--period"]),
        (
            &[kapitza, "--period", "-1*s"],
            2,
            &["--period", "greater than 0"],
        ),
        (
            &[
                kapitza,
                "--period",
                "2*pi/omega",
                "--along",
                "omga=80..90:3",
            ],
            2,
            &["--along", "omega"],
        ),
        (&[spec.path(), "--start", "theta=0"], 1, &["at rest"]),
        (&[spec.path(), "--advance", "phi=1"], 2, &["phi"]),
        (&[twice.path()], 1, &["constraint `again`", "leave it out"]),
        (&[once.path(), "--keep", "x,y"], 1, &["kept", "--keep"]),
        (&["machines/stick_slip.machine"], 1, &["sliding"]),
        (
            &[spec.path(), "--out", "orbit.txt"],
            2,
            &["--out", "`.json`"],
        ),
    ] {
        let (found, said) = refused(arguments);
        assert_eq!(found, status, "{arguments:?}: {said}");
        for word in words {
            assert!(said.contains(word), "{arguments:?}: {said}");
        }
    }
}

#[test]
fn a_force_that_jumps_is_refused() {
    // With sign(v) in the force, the variational equations do not describe the difference of runs.
    let spec = Scratch::new(
        "bang.machine",
        "machine Bang in plane {
            parameters { f: N = 0.2, d: N*s/m = 0.1, v: m/s = 0.3 }
            coordinates { x: m = 1 }
            bodies { ball { mass: 1, at: (x, 0) } }
            springs { back { stiffness: 1, stretch: x } }
            dampers { oil { damping: d, stretch: x } }
            forces { feed { on: x, value: f*sign(der(x) + v) } }
        }",
    );
    let (status, said) = refused(&[
        spec.path(),
        "--near",
        "6.3",
        "--start",
        "x=3",
        "--settle",
        "200",
    ]);
    assert_eq!(status, 1, "{said}");
    assert!(
        said.contains("jumps") || said.contains("no orbit"),
        "{said}"
    );
}

const WOODPECKER: &str = "machines/contacts/woodpecker.machine";

/// The woodpecker's cycle for a restitution of its beak, by `orbit/woodpecker.py`: the angle `turn` at which the bird turns while the sleeve is
/// jammed, `period`, `way`, and the `multiplier` that is neither 1 nor 0.
fn by_hand(restitution: &str, what: &str) -> f64 {
    let path = root().join("cli/tests/command/orbit/woodpecker.json");
    let text = std::fs::read_to_string(path).expect("the cycles");
    let all: Value = serde_json::from_str(&text).expect("JSON");
    let digits = all[restitution][what].as_str().expect("digits");
    digits.parse().expect("a number")
}

/// The woodpecker returns to its state except for its height, which decreases: four impacts of its sleeve, a peck, slip, stick, and free flight.
/// While the sleeve is jammed one number determines the state, so three of five multipliers are 0. The toy starts with its sleeve touching the
/// pole; the period begins in free flight.
///
/// R. I. Leine, Ch. Glocker and D. H. van Campen (*Nonlinear Dynamics of the Woodpecker Toy*, DETC2001/VIB-21608) print a period of 0.1452 s,
/// which these equations of theirs reproduce only to 0.6 %: it is that of a beat that begins at −0.532 rad, and −0.839 is slow to settle. They
/// print −0.53 rad for the angle at which the bird turns.
#[test]
fn the_woodpecker_has_the_cycle_of_its_equations_by_hand() {
    for more in [
        &[][..],
        &["--near", "0.146"],
        &["--settle", "2"],
        &["--shift", "y"],
    ] {
        let found = orbit(&[&[WOODPECKER][..], more].concat());
        let period = number(&found["period"]);
        let exact = by_hand("0.5", "period");
        assert!((period / exact - 1.0).abs() < CLOSE, "{found:#}");
        let way = number(&found["advance"]["y"]);
        let exact = by_hand("0.5", "way");
        assert!((way - exact).abs() < CLOSE, "{found:#}");
        let (zero, beat) = ((0.0, 0.0), (by_hand("0.5", "multiplier"), 0.0));
        assert_multipliers(&found, &[(1.0, 0.0), beat, zero, zero, zero]);
        assert_eq!(
            found["states"],
            serde_json::json!(["phiM", "phiS", "der(y)", "der(phiM)", "der(phiS)"])
        );
        assert_eq!(found["stability"], "stable");
        assert_eq!(found["family"], 0);
    }
    assert_eq!((by_hand("0.5", "turn") * 100.0).round(), -53.0);
    let said = lagrangian(&["orbit", WOODPECKER]);
    let said = String::from_utf8(said.stdout).expect("text");
    assert!(
        said.contains("nothing depends on y, which advances by -0.0194454 m in a period"),
        "{said}"
    );
    // Requiring y to come back, or keeping a coordinate of a start in contact, is refused by name.
    let (status, said) = refused(&[WOODPECKER, "--advance", "y=0"]);
    assert_eq!(status, 1, "{said}");
    assert!(
        said.contains("nothing depends on `y`: with --shift y"),
        "{said}"
    );
    let (status, said) = refused(&[WOODPECKER, "--keep", "phiS"]);
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("the contact `lower` is closed"), "{said}");
}

/// The next angle at which the bird turns after it has turned at `s` while the sleeve is jammed, by a run that ends before the sleeve slips
/// again. Until then only the bird oscillates, `(J + m l²) φ″ = −c (φ − φ_M) − m g l`, and its angle and rate determine the turn.
fn next_turn(s: f64) -> f64 {
    let start = format!("phiS={s:?}");
    let output = lagrangian(&[
        "simulate",
        WOODPECKER,
        "--start",
        &start,
        "--rate",
        "y=0",
        "--rate",
        "phiS=0",
        "--until",
        "0.146",
        "--tolerance",
        "1e-12",
        "--json",
    ]);
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let [q, v] = ["q", "v"].map(|of| number(&run[of]["phiS"]));
    // The sleeve is jammed, so its rate is zero up to rounding.
    assert!(number(&run["v"]["y"]).abs() < 1e-14, "{run:#}");
    let (mass, arm, spring) = (4.5e-3, 0.015, 0.0056);
    let rest = -0.0006 / 0.0058 - mass * 9.81 * arm / spring;
    let omega = f64::sqrt(spring / (7e-7 + mass * arm * arm));
    rest - (q - rest).hypot(v / omega)
}

/// An independent algorithm: differences of runs from beat to beat, without derivatives.
#[test]
fn from_beat_to_beat_the_woodpecker_changes_by_its_multiplier() {
    // The error of about a thousand steps with tolerance 1e-12; one in ten has an event.
    let exact = 1e-9;
    let turn = by_hand("0.5", "turn");
    let next = next_turn(turn);
    assert!((next - turn).abs() < exact, "{next}");
    let slope = |h: f64| (next_turn(turn + h) - next_turn(turn - h)) / (2.0 * h);
    let (coarse, fine) = (slope(2e-4), slope(1e-4));
    // The error of the finer difference is a third of the difference between both.
    let known = (coarse - fine).abs() + exact / 1e-4;
    assert!(known < 1e-3, "{known}");
    let off = fine - by_hand("0.5", "multiplier");
    assert!(off.abs() < known, "{fine}, known up to {known}");
}

/// With a harder peck the beats begin to alternate: the multiplier passes −1 steeply between e = 0.64854 and 0.64856, by `orbit/woodpecker.py`;
/// and the unstable cycle beyond is followed.
#[test]
fn the_woodpecker_doubles_its_beat_where_its_map_does() {
    let found = orbit(&[WOODPECKER, "--near", "0.146", "--along", "e=0.5..0.66:3"]);
    let changes = found["changes"].as_array().expect("a list");
    assert_eq!(changes.len(), 1, "{changes:?}");
    assert_eq!(changes[0]["change"], "period doubling");
    let between = changes[0]["between"].as_array().expect("a list");
    let (low, high) = (number(&between[0]), number(&between[1]));
    assert!(0.64854 < low && high < 0.64856, "{changes:?}");
    let points = found["points"].as_array().expect("a list");
    for (point, restitution) in points.iter().zip(["0.5", "0.58", "0.66"]) {
        let off = number(&point["period"]) / by_hand(restitution, "period") - 1.0;
        assert!(off.abs() < CLOSE, "{point}");
        let off = multipliers(point)[1].0 - by_hand(restitution, "multiplier");
        assert!(off.abs() < 2.0 * CLOSE, "{point}");
    }
}

/// Two masses joined by a spring move on together. In the period of their oscillation, `2π √(mn/((m+n) k))`, the mass in front advances as far
/// as the momentum determines.
#[test]
fn what_nothing_depends_on_goes_on_by_its_momentum() {
    let spec = Scratch::new(
        "pair.machine",
        "machine Pair in plane {
            parameters { m: kg = 2, n: kg = 1, k: N/m = 6, l: m = 1 }
            coordinates { x: m, s: m = 0.1, der(x): m/s = 0.5 }
            bodies { first { mass: m, at: (x, 0) }, second { mass: n, at: (x + l + s, 0) } }
            gravity none;
            springs { spring { stiffness: k, stretch: s } }
        }",
    );
    let found = orbit(&[spec.path()]);
    assert!(
        (number(&found["period"]) - TAU / 3.0).abs() < CLOSE,
        "{found:#}"
    );
    assert!(
        (number(&found["advance"]["x"]) - PI / 3.0).abs() < CLOSE,
        "{found:#}"
    );
    assert_eq!(
        found["states"],
        serde_json::json!(["s", "der(x)", "der(s)"])
    );
    assert_multipliers(&found, &[(1.0, 0.0), (1.0, 0.0), (1.0, 0.0)]);
    // The family has two parameters, energy and momentum.
    assert_eq!(found["family"], 2);
    // Whatever the start, M is 1 within its error: at starts that differ by one rounding, and at others.
    for k in 0..40 {
        let start = match k % 2 {
            0 => f64::from_bits(0.1_f64.to_bits() + k / 2),
            _ => 0.05 + 0.0031 * k as f64,
        };
        let found = orbit(&[spec.path(), "--start", &format!("s={start:?}")]);
        assert_eq!(found["family"], 2, "{start:?}: {found:#}");
    }
    // If x must come back, the momentum is zero.
    let back = orbit(&[spec.path(), "--advance", "x=0", "--near", "2"]);
    assert_eq!(back["advance"], serde_json::json!({}));
    let momentum = 3.0 * number(&back["at"]["v"]["x"]) + number(&back["at"]["v"]["s"]);
    assert!(momentum.abs() < CLOSE, "{back:#}");
    for (arguments, status, words) in [
        (
            &["--shift", "s"][..],
            1,
            &["depend on `s`", "--advance"][..],
        ),
        (&["--shift", "z"], 2, &["`z`", "there are: x, s"]),
        (
            &["--shift", "x", "--advance", "x=1"],
            2,
            &["--shift x", "--advance"],
        ),
    ] {
        let (found, said) = refused(&[&[spec.path()][..], arguments].concat());
        assert_eq!(found, status, "{arguments:?}: {said}");
        for word in words {
            assert!(said.contains(word), "{arguments:?}: {said}");
        }
    }
}

#[test]
fn files_hold_what_is_printed() {
    let spec = Scratch::new("circle.machine", CIRCLE);
    let out = spec.0.with_file_name("orbit.json");
    let printed = orbit(&[spec.path(), "--out", out.to_str().unwrap()]);
    let text = std::fs::read_to_string(&out).unwrap();
    let written: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(written, printed);
    let table = spec.0.with_file_name("orbit.csv");
    let plot = spec.0.with_file_name("orbit.svg");
    orbit(&[
        spec.path(),
        "--out",
        table.to_str().unwrap(),
        "--plot",
        plot.to_str().unwrap(),
    ]);
    let text = std::fs::read_to_string(&table).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    // One period: it ends at its start.
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    assert!((last[0] - number(&printed["period"])).abs() < 1e-9);
    assert!((first[1] - last[1]).abs() < CLOSE && (first[2] - last[2]).abs() < CLOSE);
    assert!(std::fs::read_to_string(&plot).unwrap().contains("</svg>"));
}

/// A body that hangs from a fixed point and turns about the vertical once in each period: its four numbers (a quaternion) come back with the
/// opposite sign. Its tilts in the ground's axes, as one complex number η, obey A η'' − i C ω η' + m g l η = 0, so the multipliers are e^{i s T}
/// with A s² − C ω s − m g l = 0, as complex pairs, and twice 1, for the turn and its rate.
#[test]
fn a_top_that_turns_round_comes_back_with_the_other_sign() {
    let spec = "machine Hanging in space {
        parameters { m: kg = 2, l: m = 0.3, A: kg*m^2 = 0.25, C: kg*m^2 = 0.1, g: m/s^2 = 9.81 }
        coordinates { e[0]: 1 = 2, e[1..3]: 1, der(e[3]): 1/s = 7 }
        frames { top = ground.turn(e[0], e[1], e[2], e[3]) }
        bodies { top { mass: m, inertia: (A - m*l^2, A - m*l^2, C), frame: top, at: top.point(0, 0, -l) } }
        gravity (0, 0, -g);
    }";
    let spec = Scratch::new("hanging.machine", spec);
    let omega = 7.0; // twice 7/s over the length of 2
    let period = TAU / omega;
    let found = orbit(&[spec.path(), "--period", &format!("{period:?}")]);
    assert!((number(&found["period"]) - period).abs() <= 1e-9);
    let (a, c, stiffness) = (0.25, 0.1, 2.0 * 9.81 * 0.3);
    let root = (c * c * omega * omega + 4.0 * a * stiffness).sqrt();
    let mut known: Vec<(f64, f64)> = Vec::new();
    for s in [
        (c * omega + root) / (2.0 * a),
        (c * omega - root) / (2.0 * a),
    ] {
        let (sin, cos) = (s * period).sin_cos();
        known.extend([(cos, sin), (cos, -sin)]);
    }
    known.extend([(1.0, 0.0); 2]);
    let all = multipliers(&found);
    assert_eq!(all.len(), 6, "{found:#}");
    for (re, im) in known {
        let near = all.iter().map(|(x, y, ..)| (x - re).hypot(y - im));
        let least = near.fold(f64::INFINITY, f64::min);
        // The multiplier 1 is double, and if the second is not trivial, an error of 1e-9 in the matrix moves both by its square root.
        let bound = if im == 0.0 { 1e-4 } else { CLOSE };
        assert!(least <= bound, "{re} + {im}i: {least:e}\n{found:#}");
    }
}

/// The same motion in four numbers (a quaternion) and in three angles has the same period and multipliers: a body with three different moments
/// of inertia that swings far about one of its axes.
#[test]
fn a_body_swings_by_four_numbers_as_by_angles() {
    let machine = |coordinates: &str, turns: &str| {
        let text = format!(
            "machine Swinging in space {{
                parameters {{ m: kg = 2, l: m = 0.3, A: kg*m^2 = 0.05, B: kg*m^2 = 0.03, C: kg*m^2 = 0.06, g: m/s^2 = 9.81 }}
                coordinates {{ {coordinates} }}
                frames {{ body = ground{turns} }}
                bodies {{ body {{ mass: m, inertia: (A, B, C), frame: body, at: body.point(0, 0, -l) }} }}
                gravity (0, 0, -g);
            }}"
        );
        Scratch::new("swinging.machine", &text)
    };
    let (sin, cos) = 0.6_f64.sin_cos();
    let four = machine(
        &format!("e[0]: 1 = {cos:?}, e[1]: 1 = {sin:?}, e[2..3]: 1"),
        ".turn(e[0], e[1], e[2], e[3])",
    );
    let three = machine(
        "a: rad = 1.2, b: rad, c: rad",
        ".turn(x, a).turn(y, b).turn(z, c)",
    );
    let [four, three] = [four, three].map(|spec| orbit(&[spec.path()]));
    let [period, known] = [&four, &three].map(|found| number(&found["period"]));
    assert!((period - known).abs() <= 1e-9 * known, "{period} {known}");
    let [found, known] = [&four, &three].map(multipliers);
    assert_eq!(found.len(), known.len());
    let largest = known
        .iter()
        .fold(1.0_f64, |most, (x, y, ..)| most.max(x.hypot(*y)));
    for (re, im, _, trivial) in &known {
        let near = found.iter().map(|(x, y, ..)| (x - re).hypot(y - im));
        let least = near.fold(f64::INFINITY, f64::min);
        // Near 1, which is a double multiplier, the square root of an error of 1e-9.
        let is_double = *trivial || (re - 1.0).hypot(*im) < 1e-3;
        let bound = if is_double { 1e-4 } else { CLOSE * largest };
        assert!(least <= bound, "{re} + {im}i: {least:e}\n{four:#}{three:#}");
    }
}

/// A mass on a rail with friction and a spring, driven against a stop, returns after a period of the drive. The product of its multipliers is e² for each impact, times
/// exp(−d t/m), times a⁺/a⁻ for each reversal of the slip, with the accelerations before and after it at the state that `simulate` prints.
#[test]
fn an_orbit_with_a_guide_and_a_stop_shrinks_areas_as_liouville_says() {
    let text = "machine Rubbed in plane {
        parameters {
            m: kg = 1, k: N/m = 4, d: N*s/m = 0.1, F: N = 4, w: rad/s = 2.8, L: m = 0.3, e: 1 = 0.6, mu: 1 = 0.05, g: m/s^2 = 9.81,
        }
        coordinates { x: m = 0.5, der(x): m/s = 0.5 }
        bodies { mass { mass: m, at: (x, 0) } }
        gravity (0, -g);
        springs { spring { stiffness: k, stretch: x } }
        dampers { damper { damping: d, stretch: x } }
        forces { drive { on: x, value: F*cos(w*t) } }
        sliding { rail { body: mass, on: ground, direction: (1, 0), friction: mu } }
        contacts { stop { gap: x + L, restitution: e } }
    }";
    let spec = Scratch::new("rubbed.machine", text);
    let found = orbit(&[spec.path(), "--period", "2*pi/w", "--settle", "60"]);
    let period = TAU / 2.8;
    let start = |name: &str, of: &str| format!("{name}={:?}", number(&found["at"][of]["x"]));
    let (q, v) = (start("x", "q"), start("x", "v"));
    let until = format!("{:?}", number(&found["period"]));
    let run = json(&[
        "simulate",
        spec.path(),
        "--until",
        &until,
        "--start",
        &q,
        "--rate",
        &v,
        "--tolerance",
        "1e-11",
        "--method",
        "dop853",
        "--json",
    ]);
    assert!(
        (number(&run["q"]["x"]) - number(&found["at"]["q"]["x"])).abs() < 1e-8,
        "{run:#}"
    );
    let mut product = (-0.1 * number(&found["period"])).exp();
    let mut impacts = 0;
    for event in run["contact_events"].as_array().expect("events") {
        let (t, x) = (number(&event["t"]), number(&event["q"]["x"]));
        match (event["contact"].as_str(), event["kind"].as_str()) {
            (Some("stop"), Some("impact")) => {
                product *= 0.6 * 0.6;
                impacts += 1;
            }
            (Some("rail"), Some("reverses")) if number(&event["v"]["x"]).abs() < 1e-9 => {
                let [drive, rubs] = [4.0 * (2.8 * t).cos() - 4.0 * x, 0.05 * 9.81];
                let direction = number(&event["direction"]);
                product *= (drive - direction * rubs) / (drive + direction * rubs);
            }
            (Some("rail"), Some("reverses")) => {}
            other => panic!("{other:?}"),
        }
    }
    assert!(impacts > 0 && (number(&found["period"]) / period).fract() < 1e-9);
    let all = multipliers(&found);
    let [re, im] = all.iter().fold([1.0, 0.0], |[a, b], (re, im, ..)| {
        [a * re - b * im, a * im + b * re]
    });
    assert!(
        (re - product).abs() < CLOSE && im.abs() < CLOSE,
        "{re} {im}, not {product}: {found:#}"
    );
}
