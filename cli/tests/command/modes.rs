//! `lagrangian modes` against textbooks: closed forms for eigenfrequencies, damping and shapes.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use crate::support::{Scratch, lagrangian, number};
use serde_json::Value;

/// Newton's method ends within 1e-10 of the equilibrium and takes one more step; frequencies of well-conditioned machines then
/// have an error of about a hundred roundings.
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
    // The free motion: all cars move alike. Mode j: cos(π j (i − 1/2)/N).
    for i in 1..=6 {
        close(shape(&found, 0, &format!("u[{i}]")), 1.0);
        let wave = |i: i32| (PI * 2.0 * (f64::from(i) - 0.5) / 6.0).cos();
        close(shape(&found, 2, &format!("u[{i}]")), wave(i) / wave(1));
    }
}

/// An oscillator with m = 2, whose spring and damper are parameters.
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
    // The mass hangs m g/k below the free end of the spring.
    close(number(&found["equilibrium"]["q"]["x"]), 2.0 * 9.81 / 50.0);
    let (omega, ratio) = (5.0_f64, 4.0 / (2.0 * (2.0_f64 * 50.0).sqrt()));
    assert_eigenvalues(
        &found,
        &[(-ratio * omega, omega * (1.0 - ratio * ratio).sqrt())],
    );
    close(number(&found["modes"][0]["damping"]), ratio);
    // With three times the critical damping there are two decays, −ω (r ± √(r² − 1)).
    let found = modes(&[spec.path(), "--set", "b=60"]);
    let root = 8.0_f64.sqrt();
    assert_eigenvalues(
        &found,
        &[(-omega * (3.0 - root), 0.0), (-omega * (3.0 + root), 0.0)],
    );
    // Without a spring the mass falls; there is no equilibrium.
    let (fine, _, error) = said(&[spec.path(), "--set", "k=0"]);
    assert!(
        !fine && error.contains("nothing balances the acceleration 9.810e0 of `x`"),
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
    // The common centre of mass stays in place: (M + m) x + m l θ = 0.
    close(shape(&found, 2, "x"), -0.1 * 0.5 / 1.1);
}

/// The bob moves in a circle at `cos θ = g/(l w²)` and nods with `w √(1 + 3 cos² θ)`: C. Huygens; see the header of the spec.
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

/// Steady precession with the rate w at the angle θ and the momentum p about the axis: from V″ of the effective potential, `ω² =
/// (p/I − 2 w cos θ)² + w² sin² θ`, with `p w = m g l + I w² cos θ`.
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

/// A mass on springs on a table that rotates with w: relative to the table it moves with |ω ± w|, also above the critical speed.
/// A damper that rotates with the table makes the fast table unstable, which the undamped one is not (A. L. Kimball, 1924).
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
    // A quarter turn in phase: y is 90° off.
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
    // Below the critical speed, 5 rad/s, no mode grows.
    let found = modes(&[spec.path(), "--set", "b=0.4", "--set", "w=4"]);
    assert!(eigenvalues(&found).iter().all(|(re, _)| *re < 0.0));
}

/// The crusher of the benchmarks without its drive, against mass, damping and stiffness matrices that are typed in here.
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
        // Angles without stiffness stay exactly where they are.
        assert_eq!([phi1, theta1, phi2, theta2], [0.4, 0.0, 1.3, 0.0]);
        close(s1, 0.15);
        close(s2, 0.10);
        assert!((x + 0.05 * theta).abs() <= 1e-15 && (y + 0.35 * theta).abs() <= 1e-15);
        assert_eq!(number(&found["equilibrium"]["free"]), 5.0);

        // The derivative of each point's position by each coordinate.
        let turned = |x: f64, y: f64| {
            let (sin, cos) = theta.sin_cos();
            [-(sin * x + cos * y), cos * x - sin * y]
        };
        let along = |phi: f64| [phi.cos(), phi.sin()];
        let across = |s: f64, phi: f64| [-s * phi.sin(), s * phi.cos()];
        // The debalance is at (x0 + e, y0), whichever parameter disables the drive; polar(e, 0) keeps its direction in space.
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
                // Amplitudes converge to 1e-12 of the largest, while the entries of their rows may be small.
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

/// The roots of λ² + c λ + k, without cancellation.
fn roots(c: f64, k: f64) -> [f64; 2] {
    let fast = -0.5 * (c + (c * c - 4.0 * k).sqrt());
    [k / fast, fast]
}

/// Both decays of heavily overdamped oscillators, each with full relative accuracy; likewise for two masses between three
/// spring-damper pairs, which move together, λ² + b λ + k, or against one another, λ² + 3 b λ + 3 k.
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

/// A soft spring beside a stiff one. If they act on different masses, both frequencies are exact. If they share a mass, the soft
/// one is accurate within the stated bound, until it falls below the round-off of the sum of both stiffnesses; beyond that the
/// motion is reported as free, with a bound above its true frequency.
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
                // 32 roundings of the entries (each row has 2 k, and ω² beside it), divided by 2 ω; eigenvectors distribute them
                // equally within a factor of 2.
                let limit = 16.0 * f64::EPSILON * (2.0 * stiff + exact * exact) / exact;
                assert!(error <= 2.0 * limit, "{stiff}: {mode}");
            }
        }
    }
    assert!(resolved >= 13 && told >= 2, "{resolved} {told}");
    let (_, text, _) = said(&[chained.path(), "--set", "stiff=1e10"]);
    assert!(text.contains("accurate only to "), "{text}");
    let (_, text, _) = said(&[chained.path(), "--set", "stiff=1e16"]);
    assert!(text.contains("free, or slower than "), "{text}");
}

/// Two masses joined by a spring in the plane, which starts at a wrong length: the direction across the spring is stiff there,
/// but free at the equilibrium.
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
    // The spring has only shortened: its direction is unchanged.
    assert!((0.3 * (q("x2") - q("x1")) - 0.6 * (q("y2") - q("y1"))).abs() <= 1e-14);
    assert_eq!(number(&found["equilibrium"]["free"]), 3.0);
    assert_eigenvalues(&found, &[(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 10.0)]);
}

#[test]
fn every_machine_of_the_library_is_answered_in_numbers_or_words() {
    let folder = crate::support::root().join("machines");
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
        text.contains("unstable, grows by a factor of e in 0.319275 s"),
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
    // Every other angle of the cylinder is an equilibrium as well.
    assert_eq!(result["equilibrium"]["free"], 1);
    assert!(number(&result["equilibrium"]["q"]["phi"]).abs() < 1e-12);
    close(number(&result["modes"][0]["shape"]["theta"][0]), -0.08);
}

/// N windows move as a single pendulum, `((N + 1)/3 + N) l ψ″ = −((N + 1)/2 + N) g sin ψ`.
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

/// `(m + J/r²) ẍ + b ẋ + k x = 0`; a rolling wheel is in equilibrium at any angle.
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

// Steady motions of machines with constraints.

fn mode_number(result: &Value, mode: usize, key: &str) -> f64 {
    number(&result["modes"][mode][key])
}

/// The steady motion has `cos α = g (m + M)/(m l Ω²)`. Its oscillations follow from the second derivative of the effective potential
/// `p²/(2 I(α)) + V(α)`, where `I = J + 2 m l² sin² α`, and `μ = 2 m l² + 4 M l² sin² α` is the inertia of α̇:
/// `μ ω² = Ω² (I'²/I − I''/2) + 2 (m + M) g l cos α`.
#[test]
fn a_governor_stands_and_nods_as_its_effective_potential_says() {
    let spec = "machines/flyball_governor.machine";
    let (l, ball, sleeve, shaft, g) = (0.2_f64, 0.5, 2.0, 0.02, 9.81);
    let check = |result: &Value| {
        let (alpha, speed) = (
            number(&result["equilibrium"]["q"]["alpha"]),
            number(&result["equilibrium"]["v"]["phi"]),
        );
        close(
            alpha.cos(),
            g * (ball + sleeve) / (ball * l * speed * speed),
        );
        close(
            number(&result["equilibrium"]["q"]["s"]),
            2.0 * l * alpha.cos(),
        );
        let (sin, cos) = alpha.sin_cos();
        let inertia = shaft + 2.0 * ball * l * l * sin * sin;
        let (slope, bend) = (
            4.0 * ball * l * l * sin * cos,
            4.0 * ball * l * l * (2.0 * alpha).cos(),
        );
        let pull = speed * speed * (slope * slope / inertia - bend / 2.0);
        let weight = 2.0 * (ball + sleeve) * g * l * cos;
        let mass = 2.0 * ball * l * l + 4.0 * sleeve * l * l * sin * sin;
        assert_eigenvalues(
            result,
            &[(0.0, 0.0), (0.0, ((pull + weight) / mass).sqrt())],
        );
        assert_eq!(result["equilibrium"]["free"], 1);
        assert_eq!(result["equilibrium"]["drifts"], 1);
    };
    for speed in ["--steady", "phi=18", "--steady", "phi=25"].chunks(2) {
        check(&modes(&[spec, speed[0], speed[1]]));
    }
    // The speed at which the arms stand at the given angle.
    let sleeve_at = format!("s={:?}", 0.4 * 0.9_f64.cos());
    let found = modes(&[
        spec,
        "--steady",
        "phi=solve",
        "--start",
        "alpha=0.9",
        "--start",
        &sleeve_at,
    ]);
    close(number(&found["equilibrium"]["q"]["alpha"]), 0.9);
    check(&found);
}

/// Moments of inertia about the axis and across it, divided by m r²: a uniform disc, and a hoop.
const WHEELS: [(f64, f64); 2] = [(0.5, 0.25), (1.0, 0.5)];

/// Upright: `(A + m r²) λ² = m g r − C (C + m r²) Ω²/A`, so a disc is stable above `Ω² = g/(3 r)`, and a hoop above `g/(4 r)`.
#[test]
fn a_wheel_stays_upright_above_its_critical_speed() {
    let (m, r, g) = (1.0_f64, 0.1, 9.81);
    for (about, across) in WHEELS {
        let unit = m * r * r;
        let critical = (g / r * across / (about * (about + 1.0))).sqrt();
        close(
            critical * critical * r / g,
            if about < 0.75 { 1.0 / 3.0 } else { 0.25 },
        );
        let [about_is, across_is] = [
            format!("C={:?}", about * unit),
            format!("A={:?}", across * unit),
        ];
        for share in [0.0, 0.5, 0.9, 1.1, 3.0] {
            let speed = share * critical;
            let roll = format!("roll={speed:?}");
            let found = modes(&[
                "machines/rolling_coin.machine",
                "--set",
                &about_is,
                "--set",
                &across_is,
                "--start",
                "lean=0",
                "--steady",
                &roll,
            ]);
            assert_eq!(number(&found["equilibrium"]["steps"]), 0.0);
            assert_eq!(number(&found["equilibrium"]["q"]["lean"]), 0.0);
            // The wheel rolls straight ahead.
            close(number(&found["equilibrium"]["v"]["x"]), r * speed);
            let square = (m * g * r - unit * about * (about + 1.0) * speed * speed / across)
                / (unit * (across + 1.0));
            let (free, rate) = ((0.0, 0.0), square.abs().sqrt());
            if square > 0.0 {
                assert_eigenvalues(&found, &[free, free, (-rate, 0.0), (rate, 0.0)])
            } else {
                assert_eigenvalues(&found, &[free, free, (0.0, rate)])
            }
            // The motion is the same at any place of the table, in any direction, and at any angle of the wheel.
            assert_eq!(found["equilibrium"]["free"], 4);
        }
    }
}

/// Balance of a coin that rolls in a circle, at the angle θ of its axis from the vertical, with ψ̇ about the vertical and n about its axis:
/// `A ψ̇² sin θ cos θ − (C + m r²) n ψ̇ sin θ − m g r cos θ = 0` (J. I. Neimark and N. A. Fufaev, *Dynamics of Nonholonomic
/// Systems*, 1972, chapter 2, section 5).
fn off_balance([about, across]: [f64; 2], theta: f64, turn: f64, spin: f64) -> f64 {
    let (m, r, g) = (1.0, 0.1, 9.81);
    let (sin, cos) = theta.sin_cos();
    across * turn * turn * sin * cos - (about + m * r * r) * spin * turn * sin - m * g * r * cos
}

/// The frequency at which such a coin wobbles. The other two equations have the integrals `A sin θ δψ̇ = (C n − 2 A ψ̇ cos θ)
/// δθ` and `(C + m r²) δn = m r² ψ̇ sin θ δθ`; with these, `(A + m r²) δθ̈` is the change of the balance.
fn wobble([about, across]: [f64; 2], theta: f64, turn: f64, spin: f64) -> f64 {
    let (m, r, g) = (1.0, 0.1, 9.81);
    let (sin, cos) = theta.sin_cos();
    let rolling = about + m * r * r;
    let by_turn = (about * spin - 2.0 * across * turn * cos) / (across * sin);
    let by_spin = m * r * r * turn * sin / rolling;
    let change = across * turn * turn * (2.0 * theta).cos() + m * g * r * sin
        - rolling * spin * turn * cos
        + (2.0 * across * turn * sin * cos - rolling * spin * sin) * by_turn
        - rolling * turn * sin * by_spin;
    (-change / (across + m * r * r)).sqrt()
}

#[test]
fn a_coin_goes_round_and_wobbles_as_its_equations_say() {
    let spec = "machines/rolling_coin.machine";
    let inertia = [0.005, 0.0025];
    // First lean and roll are given, and the turn follows; then turn and roll are given, and the lean follows.
    for (lean, roll) in [(-0.2, "8.437"), (-0.7, "13"), (0.4, "7"), (-1.2, "26")] {
        let lean_is = format!("lean={lean}");
        let start = if lean > 0.0 {
            "heading=-1.5"
        } else {
            "heading=1.5"
        };
        let roll_is = format!("roll={roll}");
        let found = modes(&[
            spec,
            "--start",
            &lean_is,
            "--rate",
            start,
            "--steady",
            "heading=solve",
            "--steady",
            &roll_is,
        ]);
        let at = &found["equilibrium"];
        assert_eq!(number(&at["q"]["lean"]), lean);
        let turn = number(&at["v"]["heading"]);
        let theta = PI / 2.0 - lean;
        let spin = number(&at["v"]["roll"]) + turn * theta.cos();
        assert!(
            off_balance(inertia, theta, turn, spin).abs() <= 1e-14,
            "{at}"
        );
        let exact = wobble(inertia, theta, turn, spin);
        assert_eigenvalues(&found, &[(0.0, 0.0), (0.0, 0.0), (0.0, exact)]);
        assert_eq!(at["free"], 4);
        assert_eq!(at["drifts"], 2);
        // The place on the table is not part of the shape, because the direction of rolling turns.
        assert!(found["modes"][2]["shape"].get("x").is_none());

        let [turn_is, roll_is] = [format!("heading={turn:?}"), format!("roll={roll}")];
        let nearby = format!("lean={:?}", lean * 0.9);
        let found = modes(&[
            spec, "--start", &nearby, "--steady", &turn_is, "--steady", &roll_is,
        ]);
        close(number(&found["equilibrium"]["q"]["lean"]), lean);
        close(mode_number(&found, 2, "im"), exact);
    }
}

/// An independent algorithm: a run of the machine itself. A deviation from the steady motion by ε times a mode has grown by
/// e^{λT} after one period, up to ε².
#[test]
fn a_run_beside_a_steady_motion_grows_as_its_mode() {
    const OFF: f64 = 1e-5;
    let spec = "machines/rolling_coin.machine";
    let (r, roll) = (0.1, 9.0);
    let found = modes(&[
        spec,
        "--start",
        "lean=-0.5",
        "--rate",
        "heading=2",
        "--steady",
        "heading=solve",
        "--steady",
        "roll=9",
    ]);
    let turn = number(&found["equilibrium"]["v"]["heading"]);
    let omega = mode_number(&found, 2, "im");
    let part = |name: &str| {
        let entry = &found["modes"][2]["shape"][name];
        (OFF * number(&entry[0]), OFF * number(&entry[1]))
    };
    // The real part of the component, and that of iω times it, its rate.
    let [heading, lean, turning] = ["heading", "lean", "roll"].map(part);
    let rate = |(_, im): (f64, f64)| -omega * im;
    let q = [heading.0, -0.5 + lean.0, turning.0];
    let v = [turn + rate(heading), rate(lean), roll + rate(turning)];
    let along = [q[0].cos(), q[0].sin()].map(|share| r * v[2] * share);
    let period = TAU / omega;
    let sets = [
        ("--start", "heading", q[0]),
        ("--start", "lean", q[1]),
        ("--start", "roll", q[2]),
        ("--rate", "heading", v[0]),
        ("--rate", "lean", v[1]),
        ("--rate", "roll", v[2]),
        ("--rate", "x", along[0]),
        ("--rate", "y", along[1]),
        ("--until", "", period),
    ];
    let mut call = vec![
        "simulate".to_owned(),
        spec.to_owned(),
        "--json".to_owned(),
        "--tolerance=1e-13".to_owned(),
    ];
    for (option, name, value) in sets {
        call.push(option.to_owned());
        call.push(if name.is_empty() {
            format!("{value:?}")
        } else {
            format!("{name}={value:?}")
        });
    }
    let call: Vec<&str> = call.iter().map(String::as_str).collect();
    let output = lagrangian(&call);
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let off = |found: f64, exact: f64| {
        // A few terms of second order, and the tolerance of some steps.
        assert!(
            (found - exact).abs() <= 200.0 * OFF * OFF,
            "{found}, not {exact}"
        );
    };
    off(number(&run["q"]["lean"]), q[1]);
    off(number(&run["q"]["heading"]), q[0] + turn * period);
    off(number(&run["v"]["heading"]), v[0]);
    off(number(&run["v"]["roll"]), v[2]);
    assert!(lean.0.hypot(lean.1) > 0.1 * OFF);
}

/// A ball at the bottom of a rotating bowl: `z = x + i y` obeys `z̈ − i k Ω R/(R − r) ż + g (1 − k)/(R − r) z = 0` with `k =
/// J/(J + m r²)`; on a rotating table a ball goes round with kΩ (S. Earnshaw, *Dynamics*, 1844).
#[test]
fn a_ball_in_a_turning_bowl_has_two_frequencies() {
    let found = modes(&["machines/ball_in_bowl.machine"]);
    let (m, r, inertia, bowl, turn, g) = (0.3_f64, 0.05, 3e-4, 0.55, 2.0, 9.81);
    let k = inertia / (inertia + m * r * r);
    let half = 0.5 * k * turn * bowl / (bowl - r);
    let root = (half * half + g * (1.0 - k) / (bowl - r)).sqrt();
    let listed: Vec<f64> = eigenvalues(&found)
        .iter()
        .map(|(_, im)| *im)
        .filter(|im| *im > 0.0)
        .collect();
    assert_eq!(listed.len(), 2);
    // The two rolling constraints act along and across the meridian, whose length vanishes at the bottom; accuracy is
    // lost in proportion.
    for (found, exact) in listed.iter().zip([root - half, root + half]) {
        assert!(
            (found - exact).abs() <= 1e-6 * exact,
            "{found}, not {exact}"
        );
    }
}

/// The sleigh goes straight with its mass centre in front: `φ̈ = −m a u/(J + m a²) φ̇`; backward it turns round.
#[test]
fn a_sleigh_goes_straight_with_its_mass_centre_in_front() {
    let spec = "machines/chaplygin_sleigh.machine";
    let rate = 0.3 / (0.05 + 0.09);
    for (speed, exact) in [("x=2", -2.0 * rate), ("x=-2", 2.0 * rate)] {
        let found = modes(&[spec, "--steady", speed]);
        assert_eigenvalues(&found, &[(0.0, 0.0), (0.0, 0.0), (exact, 0.0)]);
        // All headings are equivalent, and so are all speeds.
        assert_eq!(found["equilibrium"]["free"], 3);
        assert_eq!(found["equilibrium"]["drifts"], 1);
    }
}

#[test]
fn what_cannot_be_steady_is_told_at_the_word() {
    let coin = "machines/rolling_coin.machine";
    let governor = "machines/flyball_governor.machine";
    let refused = |call: &[&str], part: &str| {
        let (good, _, error) = said(call);
        assert!(!good && error.contains(part), "{call:?}: {error}");
    };
    refused(&[governor, "--steady", "s=1"], "`s` cannot turn steadily");
    refused(
        &[
            coin, "--steady", "heading", "--steady", "roll", "--steady", "x",
        ],
        "the rate of `roll` follows from the others",
    );
    refused(&[coin, "--steady", "lean=1"], "`lean` cannot turn steadily");
    refused(
        &[governor, "--steady", "psi=1"],
        "no coordinate named `psi`",
    );
    refused(
        &[governor, "--steady", "phi=fast"],
        "or `solve`, to find the rate",
    );
    refused(&[governor, "--steady", "=3"], "expected a name before `=`");
    // Below the speed at which the balls begin to rise they hang: there is a steady motion, at alpha = 0.
    let found = modes(&[governor, "--steady", "phi=5"]);
    assert!(number(&found["equilibrium"]["q"]["alpha"]).abs() < 1e-12);
}

// Machines with equilibria at any position.

/// Weights that balance each other at every angle, up to the rounding of their moments.
#[test]
fn a_balanced_beam_stays_at_the_angle_at_which_it_is_left() {
    for (m, l, long) in [
        (0.7, 0.1, 1.0),
        (0.3, 0.1, 0.3),
        (1.1, 0.3, 3.3),
        (0.7, 0.3, 2.1),
    ] {
        let other = m * l / long;
        // The decimals make both moments equal up to rounding.
        let spec = Scratch::new(
            "beam.machine",
            &format!(
                "machine Beam in plane {{
                    parameters {{ m: kg = {m}, M: kg = {other:.3}, l: m = {l}, L: m = {long}, g: m/s^2 = 9.81 }}
                    coordinates {{ x: m = 0.3, th: rad = 0.37 }}
                    bodies {{
                        a {{ mass: m, at: (x + l*cos(th), l*sin(th)) }},
                        b {{ mass: M, at: (x - L*cos(th), -L*sin(th)) }},
                    }}
                    gravity (0, -g);
                }}"
            ),
        );
        let found = modes(&[spec.path()]);
        let at = &found["equilibrium"];
        assert_eq!([number(&at["q"]["x"]), number(&at["q"]["th"])], [0.3, 0.37]);
        assert_eq!((number(&at["steps"]), number(&at["free"])), (0.0, 2.0));
        assert_eigenvalues(&found, &[(0.0, 0.0); 2]);
        assert!(
            found["modes"]
                .as_array()
                .expect("a list")
                .iter()
                .all(|mode| mode["kind"] == "free")
        );
    }
}

/// The seed of this run: different each time, or `SEED`.
fn seed() -> u64 {
    let clock = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(1, |now| now.as_nanos() as u64);
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(clock);
    println!("SEED={seed}");
    seed
}

/// Points anywhere in the plane, joined by springs at their natural lengths or by rods but not to the ground: this is an exact
/// equilibrium, which must not move, with the three free motions of a rigid body.
#[test]
fn what_floats_stays_where_it_is_and_is_told_as_free() {
    let seed = seed();
    let mut state = seed | 1;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for case in 0..12 {
        let count = 3 + (next() * 3.0) as usize;
        let size = 10.0_f64.powf(4.0 * next() - 2.0);
        // Centred away from the origin too, with points far enough apart that the springs and rods determine the shape.
        let points: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let angle = (i as f64 + 0.6 * next()) * TAU / count as f64;
                let radius = size * (0.7 + 0.6 * next());
                [
                    radius * angle.cos() + 8.0 * size,
                    radius * angle.sin() - 3.0 * size,
                ]
            })
            .collect();
        let (mut coordinates, mut bodies) = (String::new(), String::new());
        let (mut springs, mut rods) = (String::new(), String::new());
        for (i, [x, y]) in points.iter().enumerate() {
            let mass = 0.5 + 4.0 * next();
            coordinates += &format!("x{i}: m = {x:?}, y{i}: m = {y:?}, ");
            bodies += &format!("p{i} {{ mass: {mass:?}, at: (x{i}, y{i}) }}, ");
            for (j, [u, v]) in points.iter().enumerate().take(i) {
                let length = (x - u).hypot(y - v);
                let stiffness = 10.0_f64.powf(4.0 * next());
                // At most two rods; more would leave no oscillations.
                if case % 2 == 1 && j + 1 == i && i < 3 {
                    rods += &format!("r{i}: norm(p{i}.at - p{j}.at) = {length:?}, ");
                } else {
                    springs += &format!(
                        "s{i}_{j} {{ stiffness: {stiffness:?}, from: p{i}.at, to: p{j}.at, length: {length:?} }}, "
                    );
                }
            }
        }
        let rods = if rods.is_empty() {
            rods
        } else {
            format!("constraints {{ {rods} }}")
        };
        let spec = Scratch::new(
            "floating.machine",
            &format!(
                "machine Floating in plane {{ coordinates {{ {coordinates} }} bodies {{ {bodies} }}
                 springs {{ {springs} }} {rods} }}"
            ),
        );
        let found = modes(&[spec.path()]);
        let at = &found["equilibrium"];
        let context = format!("seed {seed}, case {case}: {found:#}");
        // Printed decimals read back as the numbers that were written; rods are satisfied after the smallest change
        // that rounding needs.
        for (i, point) in points.iter().enumerate() {
            for (name, x) in ["x", "y"].into_iter().zip(point) {
                let off = number(&at["q"][&format!("{name}{i}")]) - x;
                assert!(
                    off.abs() <= 64.0 * f64::EPSILON * 10.0 * size.max(1.0),
                    "{context}"
                );
            }
        }
        assert_eq!(number(&at["steps"]), 0.0, "{context}");
        assert_eq!(number(&at["free"]), 3.0, "{context}");
        let kinds = found["modes"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|mode| mode["kind"].as_str());
        let kinds: Vec<_> = kinds.flatten().collect();
        assert!(kinds[..3] == ["free"; 3], "{context}");
        assert!(
            kinds[3..].iter().all(|kind| *kind == "oscillation"),
            "{context}"
        );
        let held = if case % 2 == 1 { 2 } else { 0 };
        assert_eq!(kinds.len(), 2 * count - held, "{context}");
    }
}

// Motions along a range of a parameter.

fn varied(arguments: &[&str]) -> Value {
    modes(arguments)
}

/// Critical values, each with the numbers of growing and oscillating motions before and after it.
fn critical(result: &Value) -> Vec<(f64, Value, Value)> {
    let listed = result["critical"].as_array().expect("a list");
    let entry = |c: &Value| {
        (
            number(&c["value"]),
            c["growing"].clone(),
            c["oscillating"].clone(),
        )
    };
    listed.iter().map(entry).collect()
}

/// The accuracy of bisection is limited by round-off: λ² passes through 0 with a nonzero slope, and is known to some roundings
/// of its terms.
const LOCATED: f64 = 1e-12;

fn located(found: f64, exact: f64) {
    assert!(
        (found - exact).abs() <= LOCATED * exact.abs(),
        "{found}, not {exact}"
    );
}

#[test]
fn a_wheel_has_the_critical_speed_of_its_closed_form() {
    let spec = "machines/rolling_coin.machine";
    for (about, across) in WHEELS {
        let [about_is, across_is] = [
            format!("C={:?}", about * 0.01),
            format!("A={:?}", across * 0.01),
        ];
        let found = varied(&[
            spec,
            "--set",
            &about_is,
            "--set",
            &across_is,
            "--start",
            "lean=0",
            "--vary",
            "roll=0..10:11",
        ]);
        let exact = (9.81 / 0.1 * across / (about * (about + 1.0))).sqrt();
        let critical = critical(&found);
        assert_eq!(critical.len(), 1, "{found}");
        located(critical[0].0, exact);
        assert_eq!(critical[0].1, serde_json::json!([1, 0]));
        assert_eq!(critical[0].2, serde_json::json!([0, 1]));
        // Every motion of the branch equals the motion computed separately.
        for motion in found["motions"].as_array().expect("a list") {
            let speed = number(&motion["value"]);
            assert_eq!(number(&motion["equilibrium"]["v"]["roll"]), speed);
            let roll = format!("roll={speed:?}");
            let alone = modes(&[
                spec, "--set", &about_is, "--set", &across_is, "--start", "lean=0", "--steady",
                &roll,
            ]);
            assert_eq!(eigenvalues(motion), eigenvalues(&alone));
        }
    }
}

/// With hanging balls, `λ² = Ω² − g (m + M)/(m l)`. The branch of raised arms is followed down to the same speed, but
/// not beyond it.
#[test]
fn a_governor_is_followed_along_its_branch() {
    let spec = "machines/flyball_governor.machine";
    let exact = (9.81_f64 * 2.5 / (0.5 * 0.2)).sqrt();
    let sleeve = ["--start", "alpha=0", "--start", "s=0.4"];
    let call = [&[spec], &sleeve[..], &["--vary", "phi=5..30:6"]].concat();
    let critical_values = critical(&varied(&call));
    assert_eq!(critical_values.len(), 1);
    located(critical_values[0].0, exact);
    assert_eq!(critical_values[0].1, serde_json::json!([0, 1]));

    let found = varied(&[spec, "--vary", "der(phi)=40..16:25"]);
    let mut last = f64::INFINITY;
    for motion in found["motions"].as_array().expect("a list") {
        let (speed, alpha) = (
            number(&motion["value"]),
            number(&motion["equilibrium"]["q"]["alpha"]),
        );
        close(alpha.cos(), exact * exact / (speed * speed));
        assert!(alpha < last);
        last = alpha;
    }
    assert!(critical(&found).is_empty());
}

/// A rotor on a soft shaft with internal damping, which rotates with the rotor: it whirls above `w = √(k/m) (1 +
/// c_s/c_r)`, where c_s is the external damping (A. L. Kimball, 1924), at the frequency √(k/m), which is √(k/m) − w
/// relative to the rotating table.
#[test]
fn a_rotor_with_inner_damping_whirls_above_its_limit() {
    let spec = Scratch::new(
        "rotor.machine",
        "machine Rotor in plane {
            parameters { m: kg = 2, k: N/m = 50, inner: N*s/m = 0.4, outer: N*s/m = 0.3, w: rad/s = 1 }
            coordinates { x: m, y: m }
            frames { table = ground.turn(w*t) }
            bodies { mass { mass: m, at: table.point(x, y) } }
            springs { a { stiffness: k, stretch: x }, b { stiffness: k, stretch: y } }
            dampers {
                a { damping: inner, stretch: x }, b { damping: inner, stretch: y },
                c { damping: outer, from: ground.point(0, 0), to: mass.at },
            }
            forces { brake { at: mass.at, force: (0, 0) } }
        }",
    );
    // External damping, as a force against the velocity in space, which does not act on the angle of the rotating table.
    let text = std::fs::read_to_string(spec.path()).expect("the spec");
    let text = text
        .replace(
            "c { damping: outer, from: ground.point(0, 0), to: mass.at },",
            "",
        )
        .replace(
            "forces { brake { at: mass.at, force: (0, 0) } }",
            "dissipations { outside: outer/2*((der(x) - w*y)^2 + (der(y) + w*x)^2) }",
        );
    std::fs::write(spec.path(), text).expect("the spec");
    let found = varied(&[spec.path(), "--vary", "w=1..20:20"]);
    let critical = critical(&found);
    let exact = 5.0 * (1.0 + 0.3 / 0.4);
    let growing: Vec<_> = critical
        .iter()
        .filter(|c| c.1 == serde_json::json!([0, 1]))
        .collect();
    assert_eq!(growing.len(), 1, "{:#}", found["critical"]);
    located(growing[0].0, exact);
}

/// Damping from zero to far beyond the critical `b = 2 √(k m)`, at which the oscillation ends.
#[test]
fn critical_damping_is_where_an_oscillation_ends() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let folder = std::path::Path::new(spec.path())
        .parent()
        .expect("a folder");
    let [table, drawing] = ["modes.csv", "modes.svg"].map(|name| folder.join(name));
    let [table, drawing] = [&table, &drawing].map(|path| path.to_str().expect("text"));
    let call = [
        spec.path(),
        "--vary",
        "b=1..60:60",
        "--out",
        table,
        "--plot",
        drawing,
    ];
    let found = varied(&call);
    let critical = critical(&found);
    assert_eq!(critical.len(), 1, "{:#}", found["critical"]);
    located(critical[0].0, 2.0 * (2.0_f64 * 50.0).sqrt());
    assert_eq!(
        (&critical[0].1, &critical[0].2),
        (&serde_json::json!([0, 0]), &serde_json::json!([1, 0]))
    );
    // λ = −b/(2 m) at the double root; each root is known to the square root of the rounding.
    assert!((number(&found["critical"][0]["re"]) + 5.0).abs() < 1e-6);

    let rows = std::fs::read_to_string(table).expect("a table");
    let mut rows = rows.lines();
    assert_eq!(
        rows.next(),
        Some("b [N*s/m],mode,re [1/s],im [1/s],error [1/s],frequency [Hz],x [m],der(x) [m/s]")
    );
    for row in rows {
        let numbers: Vec<f64> = row
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        let (b, re, im) = (numbers[0], numbers[2], numbers[3]);
        // The real and imaginary parts of m λ² + b λ + k = 0.
        let real = 2.0 * (re * re - im * im) + b * re + 50.0;
        assert!(
            real.abs() < 1e-9 && (4.0 * re * im + b * im).abs() < 1e-9,
            "{row}"
        );
        close(numbers[6], 2.0 * 9.81 / 50.0);
    }
    let drawing = std::fs::read_to_string(drawing).expect("a drawing");
    // Two panels have a point for each mode, the third has one for each oscillation.
    let motions = found["motions"].as_array().expect("a list");
    let lambdas: Vec<(f64, f64)> = motions.iter().flat_map(eigenvalues).collect();
    let oscillations = lambdas.iter().filter(|(_, im)| *im > 0.0).count();
    assert_eq!(
        drawing.matches("<circle").count(),
        2 * lambdas.len() + oscillations
    );
    assert!((19..=20).contains(&oscillations));

    let (good, text, error) = said(&call);
    assert!(good, "{error}");
    assert!(
        text.contains("equilibria along b from 1 to 60 N*s/m, 60 values:"),
        "{text}"
    );
    assert!(
        text.contains("critical b = 20 N*s/m: 1 mode oscillates before it, none after it"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_varied_is_told_at_the_word() {
    let coin = "machines/rolling_coin.machine";
    let refused = |call: &[&str], part: &str| {
        let (good, _, error) = said(call);
        assert!(!good && error.contains(part), "{call:?}: {error}");
    };
    refused(
        &[coin, "--vary", "rolls=0..1:5"],
        "no parameter, input or coordinate named `rolls`",
    );
    refused(
        &[coin, "--vary", "roll=0..1"],
        "expected NAME=FROM..TO:COUNT",
    );
    refused(
        &[coin, "--vary", "roll=1..1:5"],
        "the range from 1 to 1 is empty",
    );
    refused(
        &[coin, "--vary", "roll=0..1:1"],
        "`1` is not a valid number of values",
    );
    refused(
        &[coin, "--vary", "roll=0..fast:5"],
        "nothing is named `fast`",
    );
    refused(
        &[coin, "--vary", "roll=0..3*m:5"],
        "expected rad/s, found m",
    );
    refused(&[coin, "--plot", "a.svg"], "--vary");
    refused(
        &[coin, "--vary", "roll=0..1:5", "--steady", "roll=3"],
        "both give the rate of `roll`",
    );
    refused(
        &[coin, "--vary", "roll=0..1:5", "--steady", "roll=solve"],
        "leave out one of them",
    );
    refused(
        &[coin, "--vary", "m=1..2:5", "--set", "m=3"],
        "both give `m` a value",
    );
    refused(&[coin, "--vary", "m=1..-2:5"], "a mass must be positive");
    refused(&[coin, "--vary", "m=1..2:5", "--out", "a.txt"], "`.csv`");
}

/// A bob on a ring, which a spring pulls to the top or the bottom, from a start beside the ring. The kept coordinates determine
/// where the search begins.
#[test]
fn what_is_kept_of_the_start_says_from_where_to_look() {
    let spec = |keep: &str| {
        let text = format!(
            "machine Ring in plane {{ parameters {{ k: N/m = 1 }} coordinates {{ x: m = 0.6, y: m = 3 }} \
             bodies {{ bob {{ mass: 1, at: (x, y) }} }} gravity none; springs {{ s {{ stiffness: k, stretch: x }} }} \
             constraints {{ ring: x^2 + y^2 = 1 }} {keep} }}"
        );
        Scratch::new("ring.machine", &text)
    };
    let free = spec("");
    for arguments in [&[][..], &["--keep", "x"]] {
        let found = modes(&[&[free.path()], arguments].concat());
        close(number(&found["equilibrium"]["q"]["y"]), 1.0);
    }
    // No point of the ring has y = 3: the nearest is at x = 0.
    let off = "with `y` kept, `ring` is 8.0000e0 m^2 off";
    let kept = spec("keep { y }");
    for call in [&[free.path(), "--keep", "y"][..], &[kept.path()]] {
        let (ok, _, error) = said(call);
        assert!(!ok && error.contains(off), "{error}");
    }
    let found = modes(&[kept.path(), "--keep", "none"]);
    close(number(&found["equilibrium"]["q"]["y"]), 1.0);
    let (ok, _, error) = said(&[free.path(), "--keep", "z"]);
    assert!(
        !ok && error.contains("--keep z: no coordinate named `z`"),
        "{error}"
    );
}

/// Five bars in a row between two pins, from any initial hang. At its ends each bar has the same horizontal force H, and
/// vertical forces that grow by one weight from bar to bar, so the moments about the middle of bar i require `(V + (i − 1) m g)
/// cos qᵢ = H sin qᵢ`, with the same V and H for all; in addition the chain must be closed.
#[test]
fn a_row_of_bars_finds_an_equilibrium_from_everywhere() {
    let (weight, count) = (9.81, 5);
    let balanced = |found: &Value| {
        let q = |i: usize| number(&found["equilibrium"]["q"][format!("q[{}]", i + 1)]);
        let q: Vec<f64> = (0..count).map(q).collect();
        let along: f64 = q.iter().map(|q| q.cos()).sum();
        let across: f64 = q.iter().map(|q| q.sin()).sum();
        assert!((along - 2.0).abs() < 1e-11 && across.abs() < 1e-11, "{q:?}");
        // V and H by least squares, and the residuals.
        let rows = q
            .iter()
            .enumerate()
            .map(|(i, q)| (q.cos(), -q.sin(), -(i as f64) * weight * q.cos()));
        let rows: Vec<_> = rows.collect();
        let sum = |of: &dyn Fn(&(f64, f64, f64)) -> f64| rows.iter().map(of).sum::<f64>();
        let (aa, ab, bb) = (
            sum(&|r| r.0 * r.0),
            sum(&|r| r.0 * r.1),
            sum(&|r| r.1 * r.1),
        );
        let (ac, bc) = (sum(&|r| r.0 * r.2), sum(&|r| r.1 * r.2));
        let det = aa * bb - ab * ab;
        let (v, h) = ((ac * bb - bc * ab) / det, (aa * bc - ab * ac) / det);
        for row in &rows {
            let residual = row.0 * v + row.1 * h - row.2;
            assert!(
                residual.abs() < 1e-9 * (v.abs() + h.abs() + weight),
                "{q:?}: {residual:e}"
            );
        }
        q
    };
    let spec = "machines/closed_pendulum.machine";
    // From the start of the spec it reaches the hanging equilibrium: the middle bar is level, and slopes grow by equal amounts
    // from bar to bar.
    let q = balanced(&modes(&[spec]));
    assert!(q[2].abs() < 1e-12 && q[4] > q[3] && q[3] > 0.0, "{q:?}");
    close(q[4].tan(), 2.0 * q[3].tan());
    let seed = seed();
    let mut state = seed | 1;
    for _ in 0..20 {
        let starts: Vec<String> = (1..=count)
            .map(|i| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                let angle = ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * PI;
                format!("q[{i}]={angle}")
            })
            .collect();
        let starts = starts.iter().flat_map(|start| ["--start", start]);
        balanced(&modes(&[&[spec], &starts.collect::<Vec<_>>()[..]].concat()));
    }
    // A start from which undamped steps onto the constraints diverge: the bars point away from the further end.
    let starts = [
        -2.3002486615949675,
        -2.7192228265533185,
        -1.5063724829066498,
        -2.7992930164200147,
        -2.648044628332261,
    ];
    let starts: Vec<String> = starts
        .iter()
        .enumerate()
        .map(|(i, angle)| format!("q[{}]={angle}", i + 1))
        .collect();
    let starts = starts.iter().flat_map(|start| ["--start", start]);
    balanced(&modes(&[&[spec], &starts.collect::<Vec<_>>()[..]].concat()));
}

/// A spring between the pivot and the end of a rope of the length r: with `r > 0` their distance is r.
const PULLED: &str = "machine Pulled in plane {
    coordinates { r: m = START }
    assume { r > 0 }
    bodies { bob { mass: 1, at: (r, 0) } }
    springs {
        own { stiffness: 10, from: ground.origin, to: bob.at, length: 0.5 },
        other { stiffness: 20, stretch: r + 1 },
    }
    gravity none;
}
";

#[test]
fn a_state_beyond_the_assumptions_is_told() {
    let warning = "the machine assumes `r > 0`, which does not hold here";
    // With the distance r the forces 10 (r - 0.5) and 20 (r + 1) balance at r = -1/2; the true distance there is 1/2, so that the
    // first spring has no force and nothing rests there.
    let spec = Scratch::new("pulled.machine", &PULLED.replace("START", "-0.5"));
    let calls: [&[&str]; 3] = [&["modes"], &["linearize"], &["linearize", "--here"]];
    for call in calls {
        let output = lagrangian(&[&call[..1], &[spec.path()], &call[1..]].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(error.contains(warning), "{call:?} {error}");
    }
    let evaluate = |point: &str| -> Value {
        let points = Scratch::new("points.json", point);
        let output = lagrangian(&["evaluate", spec.path(), "--at", points.path()]);
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let found = evaluate("[{\"q\": [-0.5]}, {\"q\": [0.5]}]");
    assert_eq!(found[0]["warnings"], serde_json::json!([warning]));
    assert_eq!(found[1]["warnings"], Value::Null);
}

/// A parameter with a formula is varied like one without, and what the spec assumes is asked at every value.
#[test]
fn a_formula_gives_way_to_a_range_and_assumptions_are_asked_along_it() {
    let pendulum = |length: &str| {
        let text = format!(
            "machine P in plane {{
                parameters {{ m: kg = 1, l: m = 1, long: m{length}, g: m/s^2 = 9.81 }}
                coordinates {{ phi: rad = 0.1 }}
                bodies {{ bob {{ mass: m, at: (long*sin(phi), -long*cos(phi)) }} }}
                gravity (0, -g);
                assume {{ long < 2.5 }}
            }}"
        );
        Scratch::new("long.machine", &text)
    };
    let (derived, typed) = (pendulum(" = 2*l"), pendulum(" = 2"));
    let warning = "warning: at 1 of 3 values, the first of which is long = 3: the machine assumes `long < 2.5`, which does not hold here";
    let out = derived.0.with_file_name("along.csv");
    let out = out.to_str().expect("text");
    let asked = |call: &[&str]| {
        let output = lagrangian(call);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{call:?}: {said}");
        assert!(said.contains(warning), "{call:?}: {said}");
        String::from_utf8(output.stdout).expect("text")
    };
    let range = "long=1..3:3";
    let modes = |spec: &str| asked(&["modes", spec, "--vary", range, "--json"]);
    assert_eq!(modes(derived.path()), modes(typed.path()));
    let along = |spec: &str| {
        asked(&["linearize", spec, "--along", range, "--out", out]);
        std::fs::read_to_string(out).expect("a table")
    };
    let table = along(derived.path());
    assert_eq!(table, along(typed.path()));
    // ω² = g/l at each of the three; `im` is the fourth column.
    let rows: Vec<Vec<f64>> = (table.lines().skip(1))
        .map(|line| {
            line.split(',')
                .map(|x| x.parse().expect("a number"))
                .collect()
        })
        .collect();
    assert_eq!(rows.len(), 3, "{table}");
    for row in rows {
        close(row[3], (9.81_f64 / row[0]).sqrt());
    }
}

/// A pendulum on a cart, in Cartesian coordinates. By the second spelling of a constraint the bob has no part along the rod's normal:
/// (x − X) cos φ + y sin φ = 0, which follows from the other constraint where φ = 0, and there says nothing about y. So the constraints
/// have no linear approximation at the equilibrium: the modes that were printed decayed, for a pendulum that swings.
#[test]
fn constraints_that_depend_on_each_other_at_the_equilibrium_are_refused() {
    let pendulum = |along: &str| {
        let text = format!(
            "machine Pendulum in plane {{
                parameters {{
                    m: kg = 1, M: kg = 2, l: m = 0.5, g: m/s^2 = 9.81, k: N/m = 20, b: N*s/m = 1.5, c: N*m*s = 0.05,
                }}
                coordinates {{ x: m = l*sin(0.2), y: m = -l*cos(0.2), X: m, phi: rad = 0.2 }}
                bodies {{
                    cart {{ mass: M, at: (X, 0) }},
                    bob {{ mass: m, inertia: 0.02, at: (x, y), angle: phi }},
                }}
                gravity (0, -g);
                springs {{ spring {{ stiffness: k, stretch: X }} }}
                dampers {{ rail {{ damping: b, stretch: X }}, hinge {{ damping: c, stretch: phi }} }}
                constraints {{ across: x - X = l*sin(phi), along: {along} }}
            }}"
        );
        Scratch::new("pendulum.machine", &text)
    };
    let good = pendulum("y = -l*cos(phi)");
    let output = lagrangian(&["modes", good.path()]);
    assert!(output.status.success(), "{output:?}");
    let bad = pendulum("(x - X)*cos(phi) + y*sin(phi) = 0");
    for call in [["modes", bad.path()], ["linearize", bad.path()]] {
        let output = lagrangian(&call);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.contains("depends on the others where the search ends"),
            "{said}"
        );
    }
}
