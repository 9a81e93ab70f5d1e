//! `simulate --precision dd`, `--validated` and `--global-error`, against end states with more digits: from extrapolation in binary128 (two
//! resolutions agree to 4e-21 for the double pendulum and 8e-26 for the crusher), and from closed forms.

use serde_json::Value;

use crate::support::{Scratch, json, lagrangian};

/// A known end state: the call of the command, and the names with their numbers.
struct Known {
    call: &'static [&'static str],
    /// Coordinates, then rates.
    names: &'static [&'static str],
    end: &'static [&'static str],
    /// The error of these numbers.
    error: f64,
    /// The scale of the error of each number, in addition to its size.
    scales: &'static [f64],
}

/// The double pendulum 100 s after rest at (0.3, 0.5) rad, which is not chaotic.
const REGULAR: Known = Known {
    call: &[
        "machines/double_pendulum.machine",
        "--until",
        "100",
        "--start",
        "theta1=0.3",
        "--start",
        "theta2=0.5",
    ],
    names: &["theta1", "theta2"],
    end: &[
        "0.1568362029256774608952189535",
        "0.1549800061482846913584054161",
        "0.7581220395333524674810571735",
        "0.9338915929100755708546461654",
    ],
    error: 1e-20,
    scales: &[1.0; 4],
};

/// The same pendulum 10 s after rest at (2, 2.5) rad, where it multiplies every error by 10⁹.
const CHAOTIC: Known = Known {
    call: &[
        "machines/double_pendulum.machine",
        "--until",
        "10",
        "--start",
        "theta1=2",
        "--start",
        "theta2=2.5",
    ],
    names: &["theta1", "theta2"],
    end: &[
        "-0.7531288742949123893982122328",
        "1.627933082053701835561554578",
        "-4.0873688513441880650215025",
        "-8.869702578387531735668069548",
    ],
    error: 1e-19,
    scales: &[1.0; 4],
};

/// The crusher after 5 s.
const CRUSHER: Known = Known {
    call: &[
        "machines/crusher9.machine",
        "--until",
        "5",
        "--rate",
        "x=0.05",
        "--rate",
        "y=-0.03",
        "--rate",
        "theta=0.02",
        "--rate",
        "phi1=2",
        "--rate",
        "theta1=1",
        "--rate",
        "phi2=-3",
        "--rate",
        "theta2=-2",
    ],
    names: &[
        "x", "y", "theta", "s1", "phi1", "theta1", "s2", "phi2", "theta2",
    ],
    end: &[
        "0.06145283273805227510136737529",
        "0.4241214737780232413153200169",
        "-1.209985523340049481970345949",
        "0.1455123597444114492826119317",
        "5.967265586494525128131223913",
        "5.0",
        "0.1036735412132180923702475683",
        "-15.9766278485484829123169667",
        "-10.0",
        "-0.09462865728282268521632893372",
        "0.228207198914713414747289637",
        "-0.5249274085360239320948923577",
        "0.1100939663714541980174367722",
        "-0.2019782217149329347742263169",
        "1.0",
        "0.0059859895538211664776422265",
        "-2.701996137911471140233655696",
        "-2.0",
    ],
    error: 1e-23,
    scales: &[
        0.02, 0.02, 0.1, 0.03, 3.2, 3.2, 0.02, 3.2, 3.2, 0.5, 0.5, 1.0, 0.3, 5.0, 10.0, 0.3, 5.0,
        10.0,
    ],
};

fn answer(arguments: &[&str]) -> Value {
    json(&[&["simulate"], arguments, &["--json"]].concat())
}

fn refused(arguments: &[&str]) -> (i32, String) {
    let output = lagrangian(&[&["simulate"], arguments].concat());
    let said = String::from_utf8(output.stderr).expect("text");
    (output.status.code().expect("no signal"), said)
}

/// A decimal number as an integer in units of 1e-32.
fn units(decimal: &str) -> i128 {
    let (text, sign) = match decimal.strip_prefix('-') {
        Some(text) => (text, -1),
        None => (decimal, 1),
    };
    let (text, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let exponent: i32 = exponent.parse().expect("an exponent");
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    let digits = format!("{whole}{part}");
    let places = 32 + exponent - part.len() as i32;
    let digits: i128 = digits.parse().expect("digits");
    let size = if places >= 0 {
        digits * 10_i128.pow(places.unsigned_abs())
    } else {
        digits
            / 10_i128
                .checked_pow(places.unsigned_abs())
                .unwrap_or(i128::MAX)
    };
    sign * size
}

impl Known {
    /// Every number of an answer with its known value and the scale of its error.
    fn each<'a>(&'a self, answer: &'a Value) -> impl Iterator<Item = (&'a Value, &'a str, f64)> {
        let n = self.names.len();
        let numbers = (0..2 * n).map(move |i| {
            let level = if i < n { "q" } else { "v" };
            &answer[level][self.names[i % n]]
        });
        let known = self.end.iter().zip(self.scales);
        numbers
            .zip(known)
            .map(|(found, (exact, scale))| (found, *exact, *scale))
    }

    /// The largest true error of an end state in `f64`.
    fn error_of(&self, answer: &Value) -> f64 {
        let error = |(found, exact, _): (&Value, &str, f64)| {
            let found = found.as_f64().expect("a number");
            // The nearest f64 is accurate enough; rounding errors are not tested.
            let exact: f64 = exact.parse().expect("a number");
            // The scale is the end that was found, as in the command's definition. If the error is as large as the numbers, this differs from
            // the known end.
            (found - exact).abs() / (1.0 + found.abs())
        };
        self.each(answer).map(error).fold(0.0, f64::max)
    }
}

#[test]
fn runs_in_double_double_end_where_binary128_says() {
    for known in [REGULAR, CRUSHER, CHAOTIC] {
        let found = answer(&[known.call, &["--precision", "dd"]].concat());
        for (found, exact, scale) in known.each(&found) {
            let text = found.as_str().expect("a decimal");
            let off = (units(text) - units(exact)).unsigned_abs() as f64 * 1e-32;
            assert!(off < known.error * (scale + 1.0), "{text} and {exact}");
        }
        // A hundred steps with the coarser tolerance, 5e-28 each, multiplied by 10⁹ where the motion is chaotic.
        let difference = found["difference"].as_f64().expect("a number");
        assert!(difference < 1e-16, "{difference}");
        assert_eq!(found["method"], "taylor");
    }
}

/// A speed and a distance that pass zero along a line are roots of squares, whose series continue with the other sign.
///
/// A ball is thrown up in air. With `b = ρ c A/2m` and `w = √(g/b)` it rises for `τ = w/g·atan(v₀/w)` to `h = w²/2g·ln(1 + v₀²/w²)`; a time s later
/// it is at `h − w²/g·ln cosh(gs/w)` and falls with `w tanh(gs/w)`. A mass on a band falls through the point that holds the band: with ω² = k/m it moves
/// as `y = e + A cos ωt + B sin ωt` about `e = l − g/ω²` above this point, and about `e = −l − g/ω²` below it. The numbers are those of mpmath with 50 digits.
#[test]
fn runs_in_double_double_pass_zeros_of_speeds_and_distances() {
    let ball = "machine Ball in plane {
        parameters { m: kg = 0.125, g: m/s^2 = 9.75, area: m^2 = 0.015625, rho: kg/m^3 = 1 }
        coordinates { x: m, y: m, der(y): m/s = 20 }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        drag { air { at: ball.at, coefficient: 0.5, area: area, density: rho } }
    }";
    let band = "machine Band in plane {
        parameters { m: kg = 1, g: m/s^2 = 9.75, k: N/m = 8, l: m = 0.5 }
        coordinates { x: m, y: m = 0.25 }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        springs { band { stiffness: k, from: ground.origin, to: ball.at, length: l } }
    }";
    for (name, spec, until, y, rate) in [
        (
            "ball.machine",
            ball,
            "3",
            "3.7136621472841380643502569712528",
            "-11.813675622260569169402822379936",
        ),
        (
            "band.machine",
            band,
            "1",
            "-3.1396798376333899289873116475106",
            "-3.2947654957804182194653231239663",
        ),
    ] {
        let scratch = Scratch::new(name, spec);
        let call = [scratch.path(), "--until", until];
        let found = answer(&[&call[..], &["--precision", "dd"]].concat());
        assert_eq!(found["method"], "taylor");
        for (found, exact) in [(&found["q"]["y"], y), (&found["v"]["y"], rate)] {
            let text = found.as_str().expect("a decimal");
            let off = (units(text) - units(exact)).unsigned_abs() as f64 * 1e-32;
            // The step over the zero may have a thousand times the bound on the last terms, a hundredth of 5e-30 (1 + 20), as a defect, and there are some
            // hundred other steps; the motion multiplies errors by less than ten.
            assert!(off < 1e-25, "{name}: {text} and {exact}");
        }
        // The estimate of an ordinary run uses such a run.
        let found = answer(&[&call[..], &["--global-error"]].concat());
        let rate: f64 = rate.parse().expect("a number");
        let error = (found["v"]["y"].as_f64().expect("a number") - rate).abs();
        let estimate = found["global_error"]["errors"]["der(y)"]
            .as_f64()
            .expect("a number");
        assert!(
            (estimate - error).abs() < 1e-14,
            "{name}: {estimate:e} and {error:e}"
        );
    }
}

/// A ball falls from rest in air: its series has no numbers at the start, where its speed is zero. It falls `w²/g·ln cosh(gt/w)` with the rate `w tanh(gt/w)`, where
/// `w² = 312 m²/s²`, in mpmath with 50 digits.
#[test]
fn a_start_from_rest_in_air_is_run_without_a_series() {
    let spec = "machine Ball in plane {
        parameters { m: kg = 0.125, g: m/s^2 = 9.75, area: m^2 = 0.015625, rho: kg/m^3 = 1 }
        coordinates { x: m, y: m }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        drag { air { at: ball.at, coefficient: 0.5, area: area, density: rho } }
    }";
    let scratch = Scratch::new("ball.machine", spec);
    let call = [scratch.path(), "--until", "1", "--precision", "dd"];
    let found = answer(&call);
    assert_eq!(found["method"], "dop853");
    for (found, exact) in [
        (&found["q"]["y"], "-4.6458617579777800601979869305497"),
        (&found["v"]["y"], "-8.867202545269664106348341965747"),
    ] {
        let text = found.as_str().expect("a decimal");
        let off = (units(text) - units(exact)).unsigned_abs() as f64 * 1e-32;
        // The tolerance of a step is 1e-24, and there are hundreds of steps.
        assert!(off < 1e-20, "{text} and {exact}");
    }
}

#[test]
fn digits_are_those_of_the_number() {
    let spec = "machine Free in plane {
        coordinates { x: m = 0.1, y: m = -3e25 }
        bodies { ball { mass: 1, at: (x, y) } }
    }";
    let scratch = Scratch::new("free.machine", spec);
    let found = answer(&[
        scratch.path(),
        "--until",
        "1",
        "--precision",
        "dd",
        "--rate",
        "x=0.7",
    ]);
    // The exact values of the nearest f64, 0.1 and 0.7, and of their sum.
    assert_eq!(found["v"]["x"], "0.699999999999999955591079014994");
    assert_eq!(found["q"]["x"], "0.799999999999999961142194138120");
    assert_eq!(found["q"]["y"], "-30000000000000000570425344.0000");
    assert_eq!(found["v"]["y"], "0");
}

#[test]
fn explicit_methods_run_in_double_double_too() {
    let call = [
        "machines/double_pendulum.machine",
        "--until",
        "1",
        "--precision",
        "dd",
    ];
    let series = answer(&call);
    let explicit = answer(&[&call[..], &["--method", "dop853", "--tolerance", "1e-22"]].concat());
    for name in ["theta1", "theta2"] {
        let [one, other] =
            [&series, &explicit].map(|run| units(run["q"][name].as_str().expect("a decimal")));
        assert!(
            (one - other).unsigned_abs() as f64 * 1e-32 < 1e-19,
            "{name}"
        );
    }
}

#[test]
fn what_has_no_run_in_double_double_is_refused_with_the_reason() {
    let dd = ["--until", "1", "--precision", "dd"];
    for (call, reason) in [
        (&["machines/four_bar.machine"][..], "it has constraints"),
        (
            &["machines/block_on_incline.machine"],
            "it has contacts with friction",
        ),
        (
            &["machines/contacts/bouncing_ball.machine"],
            "it has contacts that close and open",
        ),
        (
            &["machines/double_pendulum.machine", "--out", "x.csv"],
            "cannot be used with --out",
        ),
        (
            &["machines/double_pendulum.machine", "--method", "radau5"],
            "the method `radau5` is not available",
        ),
        (
            &["machines/cart_pole.machine", "--input", "push=1*N"],
            "--input is not supported",
        ),
        (
            &["machines/double_pendulum.machine", "--tolerance", "1e-32"],
            "the limit of round-off",
        ),
    ] {
        let (status, said) = refused(&[call, &dd].concat());
        assert!(status != 0 && said.contains(reason), "{call:?}: {said}");
    }
    let fine = [
        "machines/double_pendulum.machine",
        "--until",
        "1",
        "--tolerance",
        "1e-20",
    ];
    let (status, said) = refused(&fine);
    assert!(
        status == 2 && said.contains("--precision dd"),
        "{status}: {said}"
    );
}

#[test]
fn enclosures_contain_the_ends_that_are_known() {
    // The whole run of 100 s takes minutes in a development build. Its first second, compared with a run in double-double, proves the same.
    for (spec, until, widest) in [
        ("machines/double_pendulum.machine", "1", 1e-10),
        ("machines/crusher9.machine", "0.05", 1e-9),
        ("machines/elastic_pendulum.machine", "1", 1e-10),
        ("machines/two_body_orbit.machine", "0.5", 1e-9),
    ] {
        let call = [spec, "--until", until];
        let found = answer(&[&call[..], &["--validated"]].concat());
        let exact = answer(&[&call[..], &["--precision", "dd"]].concat());
        for level in ["q", "v"] {
            for (name, bounds) in found[level].as_object().expect("numbers") {
                let [lo, hi] = [0, 1].map(|i| bounds[i].as_f64().expect("a number"));
                let text = exact[level][name].as_str().expect("a decimal");
                // The bounds enclose decimals of 30 digits, whose nearest f64 may equal a bound.
                let number: f64 = text.parse().expect("a number");
                assert!(
                    lo <= number && number <= hi,
                    "{spec} {name}: {text} in [{lo}, {hi}]"
                );
                assert!(
                    hi - lo < widest * (1.0 + number.abs()),
                    "{spec} {name}: {}",
                    hi - lo
                );
            }
        }
    }
}

#[test]
fn an_enclosure_of_a_closed_form_contains_it_and_a_damaged_one_does_not() {
    // x = cos t, to 1e-16 at 20 s: cos 20 = 0.408082061813391986...
    let spec = "machine Oscillator in plane {
        parameters { k: N/m = 1 }
        coordinates { x: m = 1 }
        bodies { block { mass: 1, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
    }";
    let scratch = Scratch::new("oscillator.machine", spec);
    let bounds = |set: &str| {
        let found = answer(&[scratch.path(), "--until", "20", "--validated", "--set", set]);
        [0, 1].map(|i| found["q"]["x"][i].as_f64().expect("a number"))
    };
    let exact = 0.408_082_061_813_391_98;
    let [lo, hi] = bounds("k=1");
    assert!(lo < exact && exact < hi && hi - lo < 1e-13, "[{lo}, {hi}]");
    // A stiffness with an error of 1e-12 moves the end by 9e-12, which the bounds resolve.
    let [lo, hi] = bounds("k=1.000000000001");
    assert!(!(lo <= exact && exact <= hi), "[{lo}, {hi}]");
}

#[test]
fn an_enclosure_that_ends_says_where_and_the_bounds_there_hold() {
    // In chaotic motion the bounds grow by a factor e in each Lyapunov time. A run ends when they become too wide, instead of giving wrong bounds.
    let call = [
        "simulate",
        "machines/double_pendulum.machine",
        "--until",
        "60",
        "--validated",
        "--json",
        "--max-steps",
        "40",
    ];
    let output = lagrangian(&call);
    assert!(!output.status.success());
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let t = found["t"].as_f64().expect("a number");
    assert!(t > 0.1 && t < 60.0, "{found:#}");
    let until = format!("{t:?}");
    let exact = answer(&[
        "machines/double_pendulum.machine",
        "--until",
        &until,
        "--precision",
        "dd",
    ]);
    for name in ["theta1", "theta2"] {
        let [lo, hi] = [0, 1].map(|i| found["q"][name][i].as_f64().expect("a number"));
        let number: f64 = exact["q"][name]
            .as_str()
            .expect("a decimal")
            .parse()
            .expect("a number");
        assert!(
            lo <= number && number <= hi,
            "{name}: {number} in [{lo}, {hi}]"
        );
    }
}

#[test]
fn what_has_no_enclosure_is_refused_with_the_reason() {
    for (call, reason) in [
        (&["machines/four_bar.machine"][..], "it has constraints"),
        (
            &["machines/stick_slip.machine"],
            "it has contacts with friction",
        ),
        (
            &["machines/double_pendulum.machine", "--method", "dop853"],
            "not by `dop853`",
        ),
        (
            &["machines/double_pendulum.machine", "--tolerance", "1e-9"],
            "has no --tolerance",
        ),
    ] {
        let (status, said) = refused(&[call, &["--until", "1", "--validated"]].concat());
        assert!(status != 0 && said.contains(reason), "{call:?}: {said}");
    }
}

#[test]
fn the_global_error_is_estimated_to_a_tenth_where_the_machine_runs_in_double_double() {
    for known in [REGULAR, CHAOTIC, CRUSHER] {
        for tolerance in ["1e-6", "1e-9", "1e-12"] {
            let call = [known.call, &["--tolerance", tolerance, "--global-error"]].concat();
            let found = answer(&call);
            let estimate = found["global_error"]["greatest"]
                .as_f64()
                .expect("a number");
            let truth = known.error_of(&found);
            let factor = estimate / truth;
            println!(
                "{} {tolerance}: estimate {estimate:.2e}, true {truth:.2e}, factor {factor:.4}",
                known.call[0]
            );
            // In addition to the estimate, the roundings of the known end, about 1e-16.
            assert!(
                (estimate - truth).abs() < 0.1 * truth + 1e-15,
                "{estimate} and {truth}"
            );
        }
    }
}

#[test]
fn the_global_error_of_a_machine_with_constraints_is_estimated_by_a_finer_run() {
    // The known end is accurate to 1e-13.
    let known = [
        ("q", "crank", 127.706_727_238_734_03),
        ("v", "crank", 8.956_708_571_057_673),
    ];
    for tolerance in ["1e-7", "1e-9", "1e-11"] {
        let call = [
            "machines/four_bar.machine",
            "--until",
            "10",
            "--tolerance",
            tolerance,
            "--global-error",
        ];
        let found = answer(&call);
        for (level, name, exact) in known {
            let truth = (found[level][name].as_f64().expect("a number") - exact).abs();
            let told = match level {
                "q" => name.to_owned(),
                _ => format!("der({name})"),
            };
            let estimate = found["global_error"]["errors"][&told]
                .as_f64()
                .expect("a number");
            println!(
                "four_bar {tolerance} {told}: estimate {estimate:.2e}, true {truth:.2e}, factor {:.4}",
                estimate / truth
            );
            assert!(
                estimate > 0.5 * truth && estimate < 2.0 * truth + 1e-10,
                "{estimate} and {truth}"
            );
        }
    }
}

#[test]
fn where_rounding_is_reached_it_is_said() {
    let call = ["--tolerance", "2.3e-15", "--global-error"];
    let fine = answer(&[CHAOTIC.call, &call].concat());
    assert_eq!(fine["global_error"]["is_rounding"], true, "{fine:#}");
    let coarse = answer(&[CHAOTIC.call, &["--tolerance", "1e-9", "--global-error"]].concat());
    assert_eq!(coarse["global_error"]["is_rounding"], false, "{coarse:#}");
    let output = lagrangian(&[&["simulate"], CHAOTIC.call, &call].concat());
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("the limit of round-off is reached"), "{text}");
}
