//! `lagrangian fmu` of machines with contacts and guides, whose units make runs: importers in C get closed forms, and what `simulate` prints.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::fmu::{attribute, files, run, text, unit};
use super::support::{Scratch, lagrangian, root};

/// A unit and its importer, which are ready to run.
struct Imported {
    at: Scratch,
    /// The references of the variables.
    references: BTreeMap<String, usize>,
    description: String,
}

impl Imported {
    /// Makes a unit of a spec by the command, and compiles an importer of it.
    fn new(spec: &str, version: &str, options: &[&str]) -> Imported {
        let at = Scratch::new("Machine.fmu", "");
        let made = unit(spec, &at, &[&["--fmi", version], options].concat());
        let token = made["token"].as_str().expect("a token");
        let kinds: Vec<&str> = made["kinds"]
            .as_array()
            .expect("kinds")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        assert_eq!(kinds, ["cs"]);
        let folder = at.0.parent().expect("a folder");
        let files = files(&at.0);
        assert!(files.keys().all(|name| !name.starts_with("sources/")));
        for (name, content) in &files {
            let name = name.rsplit('/').next().expect("a name");
            fs::write(folder.join(name), content).expect("a file");
        }
        fs::write(folder.join("script.c"), include_str!("fmu/script.c")).expect("a file");
        let headers = root().join("cli/src/fmu/headers");
        let mut cc = Command::new("cc");
        cc.current_dir(folder)
            .args(["-std=gnu11", "-Wall", "-Werror", "-O1"]);
        cc.arg(format!("-DTOKEN=\"{token}\""))
            .arg(format!("-DVERSION={version}"));
        cc.arg("-I").arg(headers);
        cc.args([
            "script.c",
            "./Machine.so",
            "-o",
            "script",
            "-lm",
            "-Wl,-rpath,.",
        ]);
        run(&mut cc, "");
        let description = text(&files, "modelDescription.xml");
        let references = references(&description);
        Imported {
            at,
            references,
            description,
        }
    }

    fn folder(&self) -> &Path {
        self.at.0.parent().expect("a folder")
    }

    /// The reference of a variable.
    fn of(&self, name: &str) -> usize {
        let known = || format!("{name} of {:?}", self.references.keys());
        *self
            .references
            .get(name)
            .unwrap_or_else(|| panic!("{}", known()))
    }

    /// What the importer prints for these calls, and what the unit says.
    fn calls(&self, script: &str) -> (Vec<f64>, String) {
        let mut command = Command::new("./script");
        command.current_dir(self.folder());
        let (printed, said, is_good) = by_pipe(&mut command, script);
        assert!(is_good, "{said}\n{script}");
        let numbers = printed.lines().map(|line| line.parse().expect("a number"));
        (numbers.collect(), said)
    }
}

/// Runs a command with this input; returns what it prints, what it says, and whether it went well.
fn by_pipe(command: &mut Command, input: &str) -> (String, String, bool) {
    use std::io::Write as _;
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = pipes.stderr(Stdio::piped()).spawn().expect("it runs");
    let mut pipe = child.stdin.take().expect("a pipe");
    pipe.write_all(input.as_bytes()).expect("a reader");
    drop(pipe);
    let output = child.wait_with_output().expect("it ends");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        text(&output.stdout),
        text(&output.stderr),
        output.status.success(),
    )
}

/// The references of all variables by name.
fn references(description: &str) -> BTreeMap<String, usize> {
    let value = |line: &str, name: &str| -> Option<String> {
        let (_, rest) = line.split_once(&format!(" {name}=\""))?;
        Some(rest.split('"').next()?.replace("&apos;", "'"))
    };
    let lines = description.lines();
    let variable = |line: &str| {
        Some((
            value(line, "name")?,
            value(line, "valueReference")?.parse().ok()?,
        ))
    };
    lines.filter_map(variable).collect()
}

/// The end of a run by the command, coordinates before rates.
fn simulated(spec: &str, options: &[&str]) -> Vec<f64> {
    let output =
        lagrangian(&[&["simulate", spec, "--method", "dop853", "--json"], options].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let end: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let numbers = |of: &Value| -> Vec<f64> {
        let values = of.as_object().expect("names").values();
        values.map(|x| x.as_f64().expect("a number")).collect()
    };
    [numbers(&end["q"]), numbers(&end["v"])].concat()
}

/// A ball that is dropped from 1 m bounces with e = 0.8 until t = √(2h/g) (1 + e)/(1 − e), and lies then: all within steps of the importer. Its height, its
/// rate and the force of the floor are those of the closed form.
#[test]
fn a_bouncing_ball_is_imported() {
    let spec = "machines/contacts/bouncing_ball.machine";
    let (g, e, h, m) = (9.81_f64, 0.8_f64, 1.0_f64, 0.1_f64);
    let fall = (2.0 * h / g).sqrt();
    let exact = |t: f64| -> [f64; 2] {
        let (mut since, mut up) = (fall, e * g * fall);
        if t <= fall {
            return [h - 0.5 * g * t * t, -g * t];
        }
        // Flights of the lengths 2 v/g, whose speeds form a geometric series.
        while t > since + 2.0 * up / g && up > 1e-9 {
            since += 2.0 * up / g;
            up *= e;
        }
        if up <= 1e-9 {
            return [0.0, 0.0];
        }
        let s = t - since;
        [up * s - 0.5 * g * s * s, up - g * s]
    };
    for version in ["3", "2"] {
        let ball = Imported::new(spec, version, &[]);
        let steps = 100;
        let time = |k: usize| 5.0 * k as f64 / steps as f64;
        let (y, v, force) = (ball.of("y"), ball.of("der(y)"), ball.of("'normal(floor)'"));
        let mut script = "new 0\nbegin 0 0 1e-10\n".to_owned();
        for k in 1..=steps {
            let _ = writeln!(
                script,
                "step 0 {:?}\nget 0 {y}\nget 0 {v}\nget 0 {force}",
                time(k)
            );
        }
        script.push_str("free 0\n");
        let (found, _) = ball.calls(&script);
        for (k, found) in (1..).zip(found.chunks(3)) {
            let [height, rate] = exact(time(k));
            // Flights are parabolas, which the method follows exactly; each of some 25 bounces is located to the round-off of time, some 1e-15 s, which a
            // bounce multiplies by (1 + e) g, and the state by no more than the tolerance of the steps.
            assert!((found[0] - height).abs() < 1e-9, "{k}: {found:?} {height}");
            assert!((found[1] - rate).abs() < 1e-8, "{k}: {found:?} {rate}");
            // It lies from 4.0635 s on.
            let pressing = if time(k) > fall * (1.0 + e) / (1.0 - e) {
                m * g
            } else {
                0.0
            };
            assert!(
                (found[2] - pressing).abs() < 1e-12,
                "{k}: {found:?} {pressing}"
            );
        }
        // It is told what such a unit cannot do.
        let flags = ["canGetAndSetFMUState", "canGetAndSetFMUstate"];
        let is_said = |flag: &&str| ball.description.contains(&format!("{flag}=\"false\""));
        assert!(flags.iter().any(is_said));
        assert!(!ball.description.contains("ModelExchange"));
        if version == "3" {
            let restitution = attribute(&ball.description, ball.of("e"), "variability");
            assert_eq!(restitution.as_deref(), Some("fixed"));
        }
        let e = ball.of("e");
        let script = format!(
            "new 0\nset 0 {e} 0.5\nbegin 0 0 1e-9\ntry 0 {e} 0.6\nsave 0\nstep 0 0.6\nget 0 {v}\nfree 0\n"
        );
        let (found, said) = ball.calls(&script);
        assert!(
            (found[0] - (0.5 * g * fall - g * (0.6 - fall))).abs() < 1e-8,
            "{found:?}"
        );
        assert!(
            said.contains("are fixed once it has been initialized"),
            "{said}"
        );
    }
}

/// A block on a rail with friction, between two stops: a motor pushes it to and fro.
const BETWEEN_STOPS: &str = "machine BetweenStops in plane {
    parameters { m: kg = 2, L: m = 0.5, e: 1 = 0.6, mu: 1 = 0.2, g: m/s^2 = 9.81 }
    coordinates { x: m = 0.1 }
    inputs { push: N = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    gravity (0, -g);
    forces { motor { on: x, value: push } }
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    contacts {
        right { gap: L - x, restitution: e },
        left { gap: L + x, restitution: e },
    }
    outputs { pull: N = m*der(der(x)) }
}";

/// A guide beside stops, and inputs that jump at communication points: the motion is that of the equations by hand, m a = u ∓ μ m g between impacts, and
/// at rest for |u| ≤ μ m g.
#[test]
fn a_guide_beside_stops_follows_its_inputs() {
    let spec = Scratch::new("between_stops.machine", BETWEEN_STOPS);
    let block = Imported::new(spec.path(), "3", &[]);
    let (m, length, e, friction) = (2.0_f64, 0.5, 0.6, 0.2 * 9.81);
    let pushes = [10.0, 10.0, -12.0, 0.0, 3.0, 0.0, 30.0, 1.0];
    // By hand: until it stops or meets a stop, with constant accelerations.
    let (mut x, mut v) = (0.1_f64, 0.0_f64);
    let mut expected = Vec::new();
    for push in pushes {
        let mut left = 0.25_f64;
        while left > 0.0 {
            let sign = if v != 0.0 {
                v.signum()
            } else {
                f64::signum(push)
            };
            if v == 0.0 && f64::abs(push) <= m * friction {
                break;
            }
            let a = push / m - sign * friction;
            let wall = sign * length;
            // Times to rest and to the stop.
            let rest = if a * sign < 0.0 {
                -v / a
            } else {
                f64::INFINITY
            };
            let root = (v * v + 2.0 * a * (wall - x)).sqrt();
            let stop = if root.is_nan() {
                f64::INFINITY
            } else {
                2.0 * (wall - x) / (v + sign * root)
            };
            let h = left.min(rest).min(stop);
            x += v * h + 0.5 * a * h * h;
            v += a * h;
            left -= h;
            if h == rest {
                v = 0.0;
            } else if h == stop {
                v *= -e;
            }
        }
        expected.push([x, v]);
    }
    let [of_x, of_v, push] = ["x", "der(x)", "push"].map(|name| block.of(name));
    let [pressing, rubbing, slip, pull] =
        ["'normal(rail)'", "'friction(rail)'", "'slip(rail)'", "pull"].map(|name| block.of(name));
    let mut script = "new 0\nset 0 PUSH 0\nbegin 0 0 1e-11\n".replace("PUSH", &push.to_string());
    for (k, u) in (1..).zip(pushes) {
        let t = 0.25 * f64::from(k);
        let _ = writeln!(script, "set 0 {push} {u:?}\nstep 0 {t:?}");
        for reference in [of_x, of_v, pressing, rubbing, slip, pull] {
            let _ = writeln!(script, "get 0 {reference}");
        }
    }
    let (found, _) = block.calls(&script);
    for ((found, [x, v]), push) in found.chunks(6).zip(&expected).zip(pushes) {
        // Constant accelerations are followed exactly, and each instant is found to round-off.
        assert!(
            (found[0] - x).abs() < 1e-10 && (found[1] - v).abs() < 1e-9,
            "{found:?} {x} {v}"
        );
        assert!((found[2] - m * 9.81).abs() < 1e-11, "{found:?}");
        assert!((found[4] - v).abs() < 1e-9, "{found:?}");
        let rubbing = match v {
            0.0 => -push,
            v => -v.signum() * m * friction,
        };
        assert!((found[3] - rubbing).abs() < 1e-9, "{found:?} {rubbing}");
        assert!((found[5] - (push + rubbing)).abs() < 1e-9, "{found:?}");
    }
    assert!(expected.iter().any(|[_, v]| *v == 0.0) && expected.iter().any(|[_, v]| *v < 0.0));
}

/// Units of a crusher that collides, of a block that sticks and slips, and of a ball that slides and rolls in space move as in `simulate`, with other parameters and
/// starts, two at once, and again after a reset.
#[test]
fn units_move_as_the_command_says() {
    for (spec, until, set) in [
        (
            "machines/contacts/colliding_crusher.machine",
            0.3,
            ("eN", 0.4),
        ),
        ("machines/stick_slip.machine", 2.0, ("m", 1.2)),
        ("machines/contacts/cue_ball.machine", 1.0, ("mu", 0.25)),
    ] {
        let machine = Imported::new(spec, "3", &[]);
        let value = format!("{}={:?}", set.0, set.1);
        let end = format!("{until:?}");
        let known = simulated(
            spec,
            &["--until", &end, "--set", &value, "--tolerance", "1e-12"],
        );
        let steps = 10;
        let parameter = machine.of(set.0);
        let begin = |i: usize| format!("set {i} {parameter} {:?}\nbegin {i} 0 1e-12\n", set.1);
        let mut script = format!("new 0\nnew 1\n{}{}", begin(0), begin(1));
        for k in 1..=steps {
            let t = until * f64::from(k) / f64::from(steps);
            let _ = writeln!(script, "step 0 {t:?}\nstep 1 {t:?}");
        }
        let state = |i: usize| -> String {
            (1..=known.len())
                .map(|k| format!("get {i} {k}\n"))
                .collect()
        };
        let _ = write!(script, "{}{}reset 0\n{}", state(0), state(1), begin(0));
        for k in 1..=steps {
            let _ = writeln!(
                script,
                "step 0 {:?}",
                until * f64::from(k) / f64::from(steps)
            );
        }
        let _ = write!(script, "{}free 0\nfree 1\n", state(0));
        let (found, _) = machine.calls(&script);
        let largest = known.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let [one, two, again] = [0, 1, 2].map(|i| &found[i * known.len()..][..known.len()]);
        assert!(one == two && one == again, "{spec}");
        for (k, (x, y)) in one.iter().zip(&known).enumerate() {
            // The tolerance of a step, times some hundred steps, and ten impacts that multiply an error by a few each.
            assert!((x - y).abs() <= 1e-8 * largest, "{spec} {k}: {x} {y}");
        }
    }
}

/// What such a unit cannot be is refused, with what to do instead; and a start that no run can begin at is said by the unit.
#[test]
fn what_a_unit_with_a_run_cannot_be_is_said() {
    let spec = "machines/contacts/bouncing_ball.machine";
    let out = Scratch::new("Ball.fmu", "");
    for (options, instead) in [
        (&["--kind", "me,cs"][..], "write --kind cs"),
        (&["--sources-only"], "leave it out"),
        (&["--target", "aarch64-linux-gnu"], "call the command there"),
        (&["--event", "low=y-r"], "make the formula an output"),
    ] {
        let output = lagrangian(&[&["fmu", spec, "--out", out.path()], options].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && said.contains(instead), "{said}");
    }
    let ball = Imported::new(spec, "3", &["--kind", "cs"]);
    let y = ball.of("y");
    let mut command = Command::new("./script");
    command.current_dir(ball.folder());
    let (_, said, is_good) = by_pipe(
        &mut command,
        &format!("new 0\nset 0 {y} -0.1\nbegin 0 0 1e-9\n"),
    );
    assert!(
        !is_good && said.contains("`floor`") && said.contains("status 3"),
        "{said}"
    );
}
