//! `lagrangian modes` against textbooks: closed forms for eigenfrequencies, damping and shapes.

mod support;

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use serde_json::Value;
use support::{Scratch, lagrangian};

/// Newton's method ends within 1e-10 of the equilibrium and takes one more step; frequencies of well-conditioned machines then
/// carry some hundred roundings.
const CLOSE: f64 = 1e-12;

fn modes(arguments: &[&str]) -> Value {
    let call: Vec<&str> = ["modes"]
        .iter()
        .chain(arguments)
        .chain(&["--json"])
        .copied()
        .collect();
    let output = lagrangian(&call);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{text}");
    serde_json::from_str(&text).expect("JSON")
}

fn said(arguments: &[&str]) -> (bool, String, String) {
    let call: Vec<&str> = ["modes"].iter().chain(arguments).copied().collect();
    let output = lagrangian(&call);
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
    (
        output.status.success(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no number: {value}"))
}

fn close(found: f64, exact: f64) {
    assert!(
        (found - exact).abs() <= CLOSE * exact.abs().max(1e-3),
        "{found}, not {exact}"
    );
}

/// `(re, im)` of every mode.
fn eigenvalues(result: &Value) -> Vec<(f64, f64)> {
    let modes = result["modes"].as_array().expect("a list");
    modes
        .iter()
        .map(|mode| (number(&mode["re"]), number(&mode["im"])))
        .collect()
}

fn assert_eigenvalues(result: &Value, exact: &[(f64, f64)]) {
    let found = eigenvalues(result);
    assert_eq!(found.len(), exact.len(), "{found:?}");
    for ((re, im), (exact_re, exact_im)) in found.into_iter().zip(exact) {
        let size = exact_re.hypot(*exact_im).max(1e-3);
        assert!(
            (re - exact_re).abs() <= CLOSE * size && (im - exact_im).abs() <= CLOSE * size,
            "{re} + {im}i, not {exact_re} + {exact_im}i"
        );
    }
}

fn shape(result: &Value, mode: usize, name: &str) -> f64 {
    let entry = &result["modes"][mode]["shape"][name];
    assert_eq!(number(&entry[1]), 0.0, "{name} has a phase");
    number(&entry[0])
}

const PENDULUM: &str = "machines/simple_pendulum.machine";

#[test]
fn a_pendulum_swings_with_the_root_of_g_over_l() {
    let found = modes(&[PENDULUM, "--start", "theta=0.5", "--set", "l=0.7"]);
    let omega = (9.81_f64 / 0.7).sqrt();
    assert_eigenvalues(&found, &[(0.0, omega)]);
    let mode = &found["modes"][0];
    close(number(&mode["frequency"]), omega / TAU);
    assert_eq!((number(&mode["damping"]), number(&mode["re"])), (0.0, 0.0));
    assert_eq!(number(&found["equilibrium"]["free"]), 0.0);
}

#[test]
fn a_pendulum_on_its_head_falls_with_the_same_root() {
    let found = modes(&[PENDULUM, "--start", "theta=3"]);
    close(number(&found["equilibrium"]["q"]["theta"]), PI);
    let rate = 9.81_f64.sqrt();
    assert_eigenvalues(&found, &[(-rate, 0.0), (rate, 0.0)]);
    assert_eq!(found["modes"][1]["kind"], "growing");
    assert!(found["modes"][1]["damping"].is_null());
}

#[test]
fn a_double_pendulum_has_the_modes_of_the_textbook() {
    let spec = "machines/double_pendulum.machine";
    let found = modes(&[spec, "--start", "theta1=0.3", "--start", "theta2=-0.2"]);
    let root = |sign: f64| (9.81 * (2.0 + sign * 2.0_f64.sqrt())).sqrt();
    assert_eigenvalues(&found, &[(0.0, root(-1.0)), (0.0, root(1.0))]);
    // θ₂ = ±√2 θ₁.
    close(shape(&found, 0, "theta1"), FRAC_1_SQRT_2);
    close(shape(&found, 1, "theta1"), -FRAC_1_SQRT_2);
    assert_eq!(shape(&found, 0, "theta2"), 1.0);
}

#[test]
fn a_train_has_the_waves_of_its_closed_form_and_rides_freely() {
    let spec = "machines/spring_mass_train.machine";
    let found = modes(&[spec, "--const", "N=6", "--set", "pull=0"]);
    let omega = |j: i32| 2.0 * 400.0_f64.sqrt() * (PI * f64::from(j) / 12.0).sin();
    let exact: Vec<(f64, f64)> = (0..6).map(|j| (0.0, omega(j))).collect();
    assert_eigenvalues(&found, &exact);
    assert_eq!(found["modes"][0]["kind"], "free");
    assert_eq!(number(&found["equilibrium"]["free"]), 1.0);
    // The ride: all cars alike. Mode j: cos(π j (i − 1/2)/N).
    for i in 1..=6 {
        close(shape(&found, 0, &format!("u[{i}]")), 1.0);
        let wave = |i: i32| (PI * 2.0 * (f64::from(i) - 0.5) / 6.0).cos();
        close(shape(&found, 2, &format!("u[{i}]")), wave(i) / wave(1));
    }
}

/// An oscillator with m = 2, and a spring and a damper to choose.
const OSCILLATOR: &str = "machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 50, b: N*s/m = 4, g: m/s^2 = 9.81 }
    coordinates { x: m = 0.3 }
    bodies { block { mass: m, at: (0, -x) } }
    gravity (0, -g);
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: b, stretch: x } }
}";

#[test]
fn damping_is_a_share_of_the_critical_one() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let found = modes(&[spec.path()]);
    // It hangs m g/k deep.
    close(number(&found["equilibrium"]["q"]["x"]), 2.0 * 9.81 / 50.0);
    let (omega, ratio) = (5.0_f64, 4.0 / (2.0 * (2.0_f64 * 50.0).sqrt()));
    assert_eigenvalues(
        &found,
        &[(-ratio * omega, omega * (1.0 - ratio * ratio).sqrt())],
    );
    close(number(&found["modes"][0]["damping"]), ratio);
    // Three times overdamped: two decays, −ω (r ± √(r² − 1)).
    let found = modes(&[spec.path(), "--set", "b=60"]);
    let root = 8.0_f64.sqrt();
    assert_eigenvalues(
        &found,
        &[(-omega * (3.0 - root), 0.0), (-omega * (3.0 + root), 0.0)],
    );
    // No spring: it falls, and nothing holds it.
    let (fine, _, error) = said(&[spec.path(), "--set", "k=0"]);
    assert!(
        !fine && error.contains("nothing takes the acceleration 9.810e0 of `x` away"),
        "{error}"
    );
}

/// `λ² = (M + m) g/(M l)` for a point at the end of a massless pole.
#[test]
fn a_cart_pole_falls_at_its_closed_form_and_rolls_freely() {
    let still = ["--set", "rail=0", "--set", "hinge=0", "--set", "J=0"];
    let call: Vec<&str> = ["machines/cart_pole.machine"]
        .iter()
        .chain(&still)
        .copied()
        .collect();
    let found = modes(&call);
    let rate = (1.1_f64 * 9.81 / 0.5).sqrt();
    assert_eigenvalues(&found, &[(0.0, 0.0), (-rate, 0.0), (rate, 0.0)]);
    assert!(number(&found["equilibrium"]["q"]["theta"]).abs() <= 1e-15);
    assert_eq!(
        (shape(&found, 0, "x"), shape(&found, 0, "theta")),
        (1.0, 0.0)
    );
    // The masses' common centre stays where it is: (M + m) x + m l θ = 0.
    close(shape(&found, 2, "x"), -0.1 * 0.5 / 1.1);
}

/// It runs in a circle at `cos θ = g/(l w²)` and nods with `w √(1 + 3 cos² θ)`: C. Huygens; in the header of the spec.
#[test]
fn a_conical_pendulum_nods_as_huygens_knew() {
    let w = 4.6_f64;
    let steady = format!("phi={w}");
    let found = modes(&[
        "machines/spherical_pendulum.machine",
        "--start",
        "theta=0.9",
        "--steady",
        &steady,
    ]);
    let cos = 9.81 / (w * w);
    close(number(&found["equilibrium"]["q"]["theta"]), cos.acos());
    assert_eq!(number(&found["equilibrium"]["v"]["phi"]), w);
    assert_eigenvalues(
        &found,
        &[(0.0, 0.0), (0.0, w * (1.0 + 3.0 * cos * cos).sqrt())],
    );
}

/// About a steady precession w at θ, with the momentum p about the axis: from V″ of the effective potential,
/// `ω² = (p/I − 2 w cos θ)² + w² sin² θ`, and `p w = m g l + I w² cos θ`.
#[test]
fn a_top_in_steady_precession_nods_as_its_effective_potential_says() {
    let (m, l, g, across, about) = (15.0, 1.0, 9.81, 0.234_375, 0.468_75);
    let inertia: f64 = across + m * l * l;
    let (theta, w) = (1.1_f64, 2.0);
    let momentum = m * g * l / w + inertia * w * theta.cos();
    let spin = momentum / about - w * theta.cos();
    let [psi, phi] = [format!("psi={w}"), format!("phi={spin}")];
    let found = modes(&[
        "machines/heavy_top.machine",
        "--start",
        "theta=1",
        "--steady",
        &psi,
        "--steady",
        &phi,
    ]);
    close(number(&found["equilibrium"]["q"]["theta"]), theta);
    let omega = (momentum / inertia - 2.0 * w * theta.cos()).hypot(w * theta.sin());
    assert_eigenvalues(&found, &[(0.0, 0.0), (0.0, 0.0), (0.0, omega)]);
}

/// A mass on springs in a table that turns with w: seen from the table it moves with |ω ± w|, above the critical speed too.
/// A damper that turns along makes the fast table unstable, which the undamped one is not (A. L. Kimball, 1924).
const WHIRL: &str = "machine Whirl in plane {
    parameters { m: kg = 2, k: N/m = 50, b: N*s/m = 0, w: rad/s = 8 }
    coordinates { x: m = 0.1, y: m = 0.2 }
    frames { table = ground.turn(w*t) }
    bodies { mass { mass: m, at: table.point(x, y) } }
    springs { a { stiffness: k, stretch: x }, b { stiffness: k, stretch: y } }
    dampers { a { damping: b, stretch: x }, b { damping: b, stretch: y } }
}";

#[test]
fn a_whirling_mass_has_sum_and_difference_of_two_frequencies() {
    let spec = Scratch::new("whirl.machine", WHIRL);
    let found = modes(&[spec.path()]);
    assert_eigenvalues(&found, &[(0.0, 3.0), (0.0, 13.0)]);
    // Turned by a quarter: y is 90° off.
    let entry = &found["modes"][0]["shape"]["y"];
    assert_eq!(number(&entry[0]), 0.0);
    close(number(&entry[1]).abs(), 1.0);
    // With z = x + i y on the table: λ² + (2 i w + b/m) λ + k/m − w² = 0.
    let found = modes(&[spec.path(), "--set", "b=0.4"]);
    let growing = eigenvalues(&found).into_iter().filter(|(re, _)| *re > 0.0);
    let growing: Vec<(f64, f64)> = growing.collect();
    assert_eq!(growing.len(), 1);
    let (re, im) = growing[0];
    let residual = [-1.0, 1.0].map(|sign| {
        let (w, c, k) = (8.0, 0.2, 25.0 - 64.0);
        // (re + s i im)² + (c + 2 i w)(re + s i im) + k
        let y = sign * im;
        let real = re * re - y * y + c * re - 2.0 * w * y + k;
        let imaginary = 2.0 * re * y + c * y + 2.0 * w * re;
        real.hypot(imaginary)
    });
    assert!(residual[0].min(residual[1]) <= 1e-12 * 64.0, "{residual:?}");
    // Below the critical speed, 5 rad/s, nothing grows.
    let found = modes(&[spec.path(), "--set", "b=0.4", "--set", "w=4"]);
    assert!(eigenvalues(&found).iter().all(|(re, _)| *re < 0.0));
}

/// The crusher of the benchmarks without its drive, by mass, damping and stiffness matrices that are typed in here.
#[test]
fn a_crusher_at_rest_stays_where_nothing_holds_it_and_swings_where_springs_do() {
    const NAMES: [&str; 9] = [
        "x", "y", "theta", "s1", "phi1", "theta1", "s2", "phi2", "theta2",
    ];
    let spec = "machines/crusher9.machine";
    for stop in ["e=0", "w=0", "m0=0"] {
        let found = modes(&[spec, "--set", stop]);
        let q = NAMES.map(|name| number(&found["equilibrium"]["q"][name]));
        let [x, y, theta, s1, phi1, theta1, s2, phi2, theta2] = q;
        // Free angles do not move at all.
        assert_eq!([phi1, theta1, phi2, theta2], [0.4, 0.0, 1.3, 0.0]);
        close(s1, 0.15);
        close(s2, 0.10);
        assert!((x + 0.05 * theta).abs() <= 1e-15 && (y + 0.35 * theta).abs() <= 1e-15);
        assert_eq!(number(&found["equilibrium"]["free"]), 5.0);

        // How each point moves with each coordinate.
        let turned = |x: f64, y: f64| {
            let (sin, cos) = theta.sin_cos();
            [-(sin * x + cos * y), cos * x - sin * y]
        };
        let along = |phi: f64| [phi.cos(), phi.sin()];
        let across = |s: f64, phi: f64| [-s * phi.sin(), s * phi.cos()];
        // The debalance hangs at (x0 + e, y0), whatever stops it; polar(e, 0) keeps its direction in space.
        let points: [(f64, [[f64; 2]; 9]); 4] = {
            let none = [0.0; 2];
            let (e1, e2) = ([1.0, 0.0], [0.0, 1.0]);
            let m0 = if stop == "m0=0" { 0.0 } else { 25.0 };
            let (a1, c1) = (along(phi1), across(s1, phi1));
            let (a2, c2) = (along(phi2), across(s2, phi2));
            [
                (450.0, [e1, e2, none, none, none, none, none, none, none]),
                (
                    m0,
                    [
                        e1,
                        e2,
                        turned(0.10, -0.25),
                        none,
                        none,
                        none,
                        none,
                        none,
                        none,
                    ],
                ),
                (120.0, [e1, e2, none, a1, c1, none, none, none, none]),
                (60.0, [e1, e2, none, a1, c1, none, a2, c2, none]),
            ]
        };
        let mut mass = [[0.0; 9]; 9];
        for (m, by) in points {
            for i in 0..9 {
                for j in 0..9 {
                    mass[i][j] += m * (by[i][0] * by[j][0] + by[i][1] * by[j][1]);
                }
            }
        }
        for (i, inertia) in [(2, 60.0), (5, 2.4), (8, 0.5)] {
            mass[i][i] += inertia;
        }
        let squares = |terms: [(f64, [f64; 9]); 4]| {
            let mut matrix = [[0.0; 9]; 9];
            for (c, by) in terms {
                for i in 0..9 {
                    for j in 0..9 {
                        matrix[i][j] += c * by[i] * by[j];
                    }
                }
            }
            matrix
        };
        let radial = |i: usize| std::array::from_fn(|j| f64::from(u8::from(i == j)));
        let x_of = |y: f64| [1.0, 0.0, -y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let y_of = |x: f64| [0.0, 1.0, x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let stiffness = squares([
            (2e5, x_of(-0.05)),
            (1.6e5, y_of(0.35)),
            (5e4, radial(3)),
            (2e4, radial(6)),
        ]);
        let damping = squares([
            (400.0, x_of(0.04)),
            (350.0, y_of(0.35)),
            (60.0, radial(3)),
            (30.0, radial(6)),
        ]);

        let found = found["modes"].as_array().expect("a list");
        let kinds: Vec<&str> = found
            .iter()
            .filter_map(|mode| mode["kind"].as_str())
            .collect();
        assert_eq!(
            kinds[..6],
            ["free", "free", "free", "free", "free", "decaying"]
        );
        assert_eq!(kinds[6..], ["oscillation"; 4]);
        for mode in found {
            let (re, im) = (number(&mode["re"]), number(&mode["im"]));
            let amplitude = |name: &str| {
                let entry = &mode["shape"][name];
                (number(&entry[0]), number(&entry[1]))
            };
            let shape = NAMES.map(amplitude);
            for i in 0..9 {
                let (mut left, mut size) = ((0.0, 0.0), 0.0);
                for j in 0..9 {
                    // λ² M + λ C + K
                    let real =
                        (re * re - im * im) * mass[i][j] + re * damping[i][j] + stiffness[i][j];
                    let imaginary = 2.0 * re * im * mass[i][j] + im * damping[i][j];
                    let (a, b) = shape[j];
                    left.0 += real * a - imaginary * b;
                    left.1 += real * b + imaginary * a;
                    let terms = (re * re + im * im) * mass[i][j].abs()
                        + re.hypot(im) * damping[i][j].abs()
                        + stiffness[i][j].abs();
                    size += terms * a.hypot(b);
                }
                // Amplitudes are settled to 1e-12 of the largest; their rows may be small.
                let row: f64 = stiffness[i].iter().chain(&mass[i]).map(|x| x.abs()).sum();
                let limit = 1e-12 * (size + row * (1.0 + re * re + im * im));
                assert!(
                    left.0.hypot(left.1) <= limit,
                    "{stop}: row {i} of {mode}: {left:?}"
                );
            }
        }
    }
}

/// The roots of λ² + c λ + k, none by a difference.
fn roots(c: f64, k: f64) -> [f64; 2] {
    let fast = -0.5 * (c + (c * c - 4.0 * k).sqrt());
    [k / fast, fast]
}

/// Both decays of heavily overdamped oscillators, each to its own digits; and so in two masses between three spring-damper
/// pairs, which move together, λ² + b λ + k, or against one another, λ² + 3 b λ + 3 k.
#[test]
fn a_slow_decay_is_as_exact_as_a_fast_one() {
    const TWO: &str = "machine Two in plane {
        parameters { m: kg = 1, k: N/m = 1, b: N*s/m = 1 }
        coordinates { x: m = 0.1, y: m }
        bodies { one { mass: m, at: (x, 0) }, other { mass: m, at: (y, 0) } }
        springs {
            a { stiffness: k, stretch: x }, b { stiffness: k, stretch: y - x }, c { stiffness: k, stretch: y }
        }
        dampers { a { damping: b, stretch: x }, b { damping: b, stretch: y - x }, c { damping: b, stretch: y } }
    }";
    let one = Scratch::new("oscillator.machine", OSCILLATOR);
    let two = Scratch::new("two.machine", TWO);
    for (b, k) in [
        (1e4, 1.0),
        (1e8, 1.0),
        (1e9, 1e-3),
        (1e3, 1e-14),
        (1e12, 1e4),
        (1e-3, 1e-28),
    ] {
        let [b_is, k_is] = [format!("b={b:e}"), format!("k={k:e}")];
        let set = ["--set", &b_is, "--set", &k_is];
        let check = |call: &[&str], mut exact: Vec<f64>| {
            let call: Vec<&str> = call.iter().chain(&set).copied().collect();
            let found = modes(&call);
            assert_eq!(number(&found["lost"]["modes"]), 0.0);
            let found = eigenvalues(&found);
            exact.sort_by(|x, y| y.total_cmp(x));
            assert_eq!(found.len(), exact.len(), "{b} {k}: {found:?}");
            for ((re, im), exact) in found.into_iter().zip(exact) {
                assert_eq!(im, 0.0);
                // A few roundings in the entries and in the closed form.
                let limit = 16.0 * f64::EPSILON * exact.abs();
                assert!(
                    (re - exact).abs() <= limit,
                    "b={b} k={k}: {re}, not {exact}"
                );
            }
        };
        let together = roots(b, k).into_iter();
        let all = together.chain(roots(3.0 * b, 3.0 * k)).collect();
        check(&[two.path()], all);
        check(
            &[one.path(), "--set", "g=0"],
            roots(b / 2.0, k / 2.0).to_vec(),
        );
    }
}

/// A soft spring beside a stiff one: exact where they have nothing to do with each other; where they share a mass, right within
/// the bound that is said, up to where the soft one has left the digits of their sum. There the motion is called free, with a
/// bound above its true frequency.
#[test]
fn a_soft_spring_beside_a_stiff_one_is_resolved_or_it_is_said() {
    const APART: &str = "machine Apart in plane {
        parameters { m: kg = 1, soft: N/m = 1, stiff: N/m = 1 }
        coordinates { x: m = 0.1, y: m = 0.1 }
        bodies { one { mass: m, at: (x, y) } }
        springs { a { stiffness: soft, stretch: x }, b { stiffness: stiff, stretch: y } }
    }";
    const CHAINED: &str = "machine Chained in plane {
        parameters { m: kg = 1, soft: N/m = 1, stiff: N/m = 1 }
        coordinates { x: m = 0.1, y: m }
        bodies { one { mass: m, at: (x, 0) }, other { mass: m, at: (y, 0) } }
        springs { a { stiffness: soft, stretch: x }, b { stiffness: stiff, stretch: y - x } }
    }";
    let apart = Scratch::new("apart.machine", APART);
    let chained = Scratch::new("chained.machine", CHAINED);
    let (mut resolved, mut told) = (0, 0);
    for exponent in [2, 4, 6, 8, 10, 12, 14, 16, 18] {
        let stiff = 10.0_f64.powi(exponent);
        let set = format!("stiff={stiff:e}");
        let found = modes(&[apart.path(), "--set", &set]);
        for ((re, im), exact) in eigenvalues(&found).into_iter().zip([1.0, stiff.sqrt()]) {
            assert_eq!(re, 0.0);
            assert!(
                (im - exact).abs() <= 8.0 * f64::EPSILON * exact,
                "{im}, not {exact}"
            );
        }

        // ω⁴ − (1 + 2 k) ω² + k = 0
        let fast = 0.5 * (1.0 + 2.0 * stiff + 1.0_f64.hypot(2.0 * stiff));
        let exact = [(stiff / fast).sqrt(), fast.sqrt()];
        let found = modes(&[chained.path(), "--set", &set]);
        let listed = found["modes"].as_array().expect("a list");
        assert_eq!(listed.len(), 2, "{found}");
        for (mode, exact) in listed.iter().zip(exact) {
            let (re, im, error) = (
                number(&mode["re"]),
                number(&mode["im"]),
                number(&mode["error"]),
            );
            if mode["kind"] == "free" {
                told += 1;
                assert!(error >= exact, "{stiff}: {error} hides {exact}");
            } else {
                resolved += 1;
                assert!(
                    re.abs() <= error && (im - exact).abs() <= error,
                    "{stiff}: {mode}"
                );
                // 32 roundings of the entries, 2 k in each row with ω² beside them, over 2 ω; vectors are shared out
                // equally within a factor of 2.
                let limit = 16.0 * f64::EPSILON * (2.0 * stiff + exact * exact) / exact;
                assert!(error <= 2.0 * limit, "{stiff}: {mode}");
            }
        }
    }
    assert!(resolved >= 13 && told >= 2, "{resolved} {told}");
    let (_, text, _) = said(&[chained.path(), "--set", "stiff=1e10"]);
    assert!(text.contains("known no better than to "), "{text}");
    let (_, text, _) = said(&[chained.path(), "--set", "stiff=1e16"]);
    assert!(
        text.contains("free, nothing brings it back faster than "),
        "{text}"
    );
}

/// Two masses on a spring, in the plane: its length is off, and so the direction across is stiff until it is not.
#[test]
fn newtons_method_ends_where_equilibria_are_not_alone() {
    const PAIR: &str = "machine Pair in plane {
        parameters { m: kg = 2, k: N/m = 100, l: m = 0.5 }
        coordinates { x1: m, y1: m, x2: m = 0.6, y2: m = 0.3 }
        bodies { one { mass: m, at: (x1, y1) }, other { mass: m, at: (x2, y2) } }
        springs { spring { stiffness: k, from: one.at, to: other.at, length: l } }
    }";
    let spec = Scratch::new("pair.machine", PAIR);
    let found = modes(&[spec.path()]);
    let q = |name| number(&found["equilibrium"]["q"][name]);
    close((q("x2") - q("x1")).hypot(q("y2") - q("y1")), 0.5);
    // It has only shortened: the direction is the same.
    assert!((0.3 * (q("x2") - q("x1")) - 0.6 * (q("y2") - q("y1"))).abs() <= 1e-14);
    assert_eq!(number(&found["equilibrium"]["free"]), 3.0);
    assert_eigenvalues(&found, &[(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 10.0)]);
}

#[test]
fn every_machine_of_the_library_is_answered_in_numbers_or_words() {
    let folder = support::root().join("machines");
    let mut answered = 0;
    for entry in std::fs::read_dir(folder).expect("the library") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "machine") {
            continue;
        }
        let (fine, text, error) = said(&[path.to_str().expect("text")]);
        let shown = path.display();
        assert!(fine != error.starts_with("error: "), "{shown}: {error}");
        assert!(fine == text.starts_with("equilibrium, "), "{shown}: {text}");
        assert!(!error.contains("panicked"), "{shown}: {error}");
        answered += usize::from(fine);
    }
    assert!(answered >= 8, "{answered}");
}

#[test]
fn what_has_no_equilibrium_is_told_why() {
    let crusher = "machines/vibrating_crusher.machine";
    let (fine, _, error) = said(&[crusher]);
    assert!(
        !fine && error.contains("its equations change with time"),
        "{error}"
    );
    assert!(
        error.contains("--set omega=0") && !error.contains("--set m1=0"),
        "{error}"
    );
    let found = modes(&[crusher, "--set", "omega=0"]);
    assert!(eigenvalues(&found).iter().all(|(re, _)| *re <= 0.0));

    let (fine, _, error) = said(&[PENDULUM, "--steady", "theta=3"]);
    assert!(
        !fine && error.contains("`theta` cannot turn steadily"),
        "{error}"
    );
    let (fine, _, error) = said(&[PENDULUM, "--steady", "phi=3"]);
    assert!(
        !fine && error.contains("no coordinate named `phi`"),
        "{error}"
    );
}

#[test]
fn a_reader_sees_what_moves_and_how() {
    let (fine, text, error) = said(&[PENDULUM, "--start", "theta=0.5"]);
    assert!(fine, "{error}");
    assert!(text.contains("theta  0 rad, moved by -0.5\n"), "{text}");
    assert!(
        text.contains("mode 1: 0.498488 Hz, 3.13209 rad/s, damping ratio 0\n"),
        "{text}"
    );
    let (_, text, _) = said(&[PENDULUM, "--start", "theta=3"]);
    assert!(
        text.contains("unstable, grows by e in 0.319275 s"),
        "{text}"
    );
}

// Machines with constraints.

#[test]
fn a_pendulum_on_a_rod_swings_as_its_angle_does() {
    for again in ["", ", again: x^2 + y^2 = l^2"] {
        let spec = Scratch::new(
            "rod.machine",
            &format!(
                "machine Rod in plane {{
                    parameters {{ m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }}
                    coordinates {{ x: m = 0.3, y: m = -0.4 }}
                    bodies {{ bob {{ mass: m, at: (x, y) }} }}
                    gravity (0, -g);
                    constraints {{ rod: (x^2 + y^2 - l^2)/(2*l) = 0{again} }}
                }}"
            ),
        );
        let result = modes(&[spec.path()]);
        let found = &result["equilibrium"];
        close(number(&found["q"]["y"]), -0.5);
        assert!(number(&found["q"]["x"]).abs() < 1e-12);
        assert_eq!(found["free"], 0);
        assert_eigenvalues(&result, &[(0.0, (9.81_f64 / 0.5).sqrt())]);
        close(number(&result["modes"][0]["shape"]["x"][0]), 1.0);
        assert_eq!(number(&result["modes"][0]["shape"]["y"][0]), 0.0);
    }
}

/// Section 1.7 of the reference problems: `ω² = g/((R − r)(1 + J/(m r²)))`.
#[test]
fn a_cylinder_rocks_in_another_as_published() {
    let result = modes(&["machines/rolling_cylinder.machine"]);
    assert_eigenvalues(&result, &[(0.0, 16.416_622_506_030_116)]);
    // It might as well touch with another side.
    assert_eq!(result["equilibrium"]["free"], 1);
    assert!(number(&result["equilibrium"]["q"]["phi"]).abs() < 1e-12);
    close(number(&result["modes"][0]["shape"]["theta"][0]), -0.08);
}

/// N windows are one pendulum, `((N + 1)/3 + N) l ψ″ = −((N + 1)/2 + N) g sin ψ`.
#[test]
fn windows_swing_as_one_pendulum() {
    let start = ["crank[0]", "crank[1]", "crank[2]"].map(|crank| format!("{crank}=-1.2"));
    let call: Vec<&str> = ["machines/four_bars.machine"]
        .into_iter()
        .chain(start.iter().flat_map(|set| ["--start", set]))
        .collect();
    let result = modes(&call);
    close(number(&result["equilibrium"]["q"]["crank[1]"]), -PI / 2.0);
    assert_eigenvalues(&result, &[(0.0, (9.81 * 3.5_f64 / 3.0).sqrt())]);
}

/// `(m + J/r²) ẍ + b ẋ + k x = 0`; what rolls may stand on any side.
#[test]
fn a_wheel_on_a_spring_has_the_inertia_of_its_turning_too() {
    let spec = Scratch::new(
        "wheel.machine",
        "machine Wheel in plane {
            parameters { m: kg = 2, J: kg*m^2 = 0.1, r: m = 0.25, k: N/m = 50, b: N*s/m = 3, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.2, y: m = r, phi: rad }
            bodies { wheel { mass: m, inertia: J, at: (x, y), angle: phi } }
            gravity (0, -g);
            springs { back { stiffness: k, stretch: x } }
            dampers { drag { damping: b, stretch: x } }
            circles { tyre { on: wheel, center: (0, 0), radius: r } }
            rolling { road { circle: tyre, along: ground } }
        }",
    );
    let result = modes(&[spec.path()]);
    let inertia = 2.0 + 0.1 / (0.25 * 0.25);
    let decay: f64 = 3.0 / (2.0 * inertia);
    let frequency = (50.0 / inertia - decay * decay).sqrt();
    assert_eigenvalues(&result, &[(-decay, frequency)]);
    assert_eq!(result["equilibrium"]["free"], 1);
    close(number(&result["modes"][0]["shape"]["phi"][0]), 1.0);
    close(number(&result["modes"][0]["shape"]["x"][0]), -0.25);
}

#[test]
fn steady_rotation_with_constraints_is_refused() {
    let (good, _, error) = said(&["machines/flyball_governor.machine", "--steady", "phi=10"]);
    assert!(!good);
    assert!(
        error.contains("constraints") || error.contains("psi"),
        "{error}"
    );
}
