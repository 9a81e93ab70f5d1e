//! Machines driven from the command line: by formulas, tables and sampled controllers, against closed forms.

use crate::support::{Page, Scratch, lagrangian};
use serde_json::Value;

/// A mass of 1 kg on a spring of 9 N/m.
const DRIVEN: &str = "machine Driven in plane {
    parameters { mass: kg = 1, k: N/m = 9 }
    coordinates { x: m = 0.25 }
    inputs { push: N, wind: N, w[1..2]: N }
    bodies { block { mass: mass, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    forces { hand { on: x, value: push + wind + w[1] } }
    outputs { pull: N = k*x, load: N = push, a: m/s^2 = der(der(x)) }
    gravity none;
}
";

struct Said {
    status: i32,
    out: String,
    error: String,
}

fn simulate(spec: &str, arguments: &[&str]) -> Said {
    let output = lagrangian(&[&["simulate", spec], arguments].concat());
    let text = |bytes| String::from_utf8(bytes).expect("text");
    Said {
        status: output.status.code().expect("no signal"),
        out: text(output.stdout),
        error: text(output.stderr),
    }
}

fn summary(spec: &str, arguments: &[&str]) -> Value {
    let said = simulate(spec, &[arguments, &["--json"]].concat());
    assert_eq!(said.status, 0, "{}", said.error);
    serde_json::from_str(&said.out).expect("JSON")
}

/// Position and rate at the end.
fn end(document: &Value) -> [f64; 2] {
    let of = |what: &str| document[what]["x"].as_f64().expect("a number");
    [of("q"), of("v")]
}

/// The state of x″ + 9 x = u with constant u, after a time from an initial state.
fn swung([x, v]: [f64; 2], u: f64, t: f64) -> [f64; 2] {
    let (sin, cos) = (3.0 * t).sin_cos();
    let (middle, c) = (u / 9.0, x - u / 9.0);
    [middle + c * cos + v / 3.0 * sin, v * cos - 3.0 * c * sin]
}

fn near(found: [f64; 2], known: [f64; 2], within: f64) {
    let off = found.iter().zip(known).map(|(x, y)| (x - y).abs());
    let off = off.fold(0.0, f64::max);
    assert!(off < within, "{found:?} {known:?}");
}

#[test]
fn a_formula_drives_an_input() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    // x″ + 9 x = 5 sin 2t: 5/(9 − 4) sin 2t and the free oscillation.
    let force = "push=5*N*sin(2*rad/s*t)";
    let formula = summary(
        spec.path(),
        &["--until", "4", "--tolerance", "1e-12", "--input", force],
    );
    let t = 4.0_f64;
    let known = [
        0.25 * (3.0 * t).cos() + (2.0 * t).sin() - 2.0 / 3.0 * (3.0 * t).sin(),
        -0.75 * (3.0 * t).sin() + 2.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos(),
    ];
    near(end(&formula), known, 1e-10);
    assert_eq!(formula["inputs"]["push"], "5*N*sin(2*rad/s*t)");
    assert!(formula["energy_residual"].as_f64().unwrap().abs() < 1e-9);
    // One input depends on another, in either order; it may also contain an output that depends on neither.
    let call = [
        "--until",
        "4",
        "--tolerance",
        "1e-12",
        "--input",
        "wind=push/4 - pull",
        "--input",
        force,
    ];
    let [x, _] = end(&summary(spec.path(), &call));
    // x″ + 18 x = 6.25 sin 2t
    let (w, c) = (18.0_f64.sqrt(), 6.25 / 14.0);
    let known = 0.25 * (w * t).cos() + c * (2.0 * t).sin() - 2.0 * c / w * (w * t).sin();
    assert!((x - known).abs() < 1e-10, "{x} {known}");
    // A family is driven by its name.
    let family = summary(
        spec.path(),
        &["--until", "0.7", "--tolerance", "1e-12", "--input", "w=2"],
    );
    near(end(&family), swung([0.25, 0.0], 2.0, 0.7), 1e-11);
}

/// A table with other units and semicolons, the same table as Parquet, and the motion under both. The summary and the page
/// report the source of each input, and the table of the run contains the input.
#[test]
fn tables_drive_inputs() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    let at = |name: &str| spec.0.with_file_name(name);
    let text = "# what was measured\n\nt [ms]; wind; force [kN] # of the motor\n0; 0; 0.004\n500; 1; -0.002\n 1200;1; 0.001\n";
    std::fs::write(at("push.csv"), text).expect("a file");
    let held = |t: f64| {
        let mut state = swung([0.25, 0.0], 4.0, t.min(0.5));
        if t > 0.5 {
            state = swung(state, -2.0, t.min(1.2) - 0.5);
        }
        if t > 1.2 {
            state = swung(state, 1.0, t - 1.2);
        }
        state
    };
    let input = format!("push={}:force,hold", at("push.csv").display());
    let out = at("run.csv");
    let out = out.to_str().expect("text");
    let call = [
        "--until",
        "2",
        "--tolerance",
        "1e-12",
        "--every",
        "0.1",
        "--input",
        &input,
    ];
    for method in ["dop853", "dopri5", "radau5", "taylor"] {
        let found = summary(spec.path(), &[&call[..], &["--method", method]].concat());
        let within = if method == "radau5" { 1e-8 } else { 1e-10 };
        near(end(&found), held(2.0), within);
        assert_eq!(found["warnings"], Value::Array(Vec::new()), "{method}");
    }
    let said = simulate(spec.path(), &[&call[..], &["--out", out]].concat());
    assert_eq!(said.status, 0, "{}", said.error);
    assert!(
        said.out.contains(&format!("  inputs\n    {} = ", "push")),
        "{}",
        said.out
    );
    let rows = std::fs::read_to_string(out).expect("a table");
    let mut lines = rows.lines();
    let header: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let place = |name: &str| header.iter().position(|head| *head == name).expect(name);
    let [x, push, load] = ["x [m]", "push [N]", "load [N]"].map(place);
    assert!(!rows.contains("--input") && !header.iter().any(|head| head.contains("formula")));
    for line in lines {
        let cells: Vec<f64> = line
            .split(',')
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        let t = cells[0];
        // At a knot the value is the new one, however the time is rounded.
        let known = match t {
            _ if t < 0.5 - 1e-12 => 4.0,
            _ if t < 1.2 - 1e-12 => -2.0,
            _ => 1.0,
        };
        assert_eq!((cells[push], cells[load]), (known, known), "{t}");
        assert!((cells[x] - held(t)[0]).abs() < 1e-10, "{t}");
    }
    // The table of a run drives the next one: as comma-separated text and as Parquet with the same bits.
    let parquet = at("run.parquet");
    let parquet = parquet.to_str().expect("text");
    let said = simulate(spec.path(), &[&call[..], &["--out", parquet]].concat());
    assert_eq!(said.status, 0, "{}", said.error);
    let again = |file: &str| {
        let input = format!("push={file}");
        let mut found = summary(spec.path(), &["--until", "2", "--input", &input]);
        found["seconds"] = Value::Null;
        found["inputs"] = Value::Null;
        found
    };
    assert_eq!(again(out), again(parquet));
    // A sweep gives the same run.
    let rows = at("rows.csv");
    let output = lagrangian(&[
        "sweep",
        spec.path(),
        "--until",
        "2",
        "--tolerance",
        "1e-12",
        "--input",
        &input,
        "--vary",
        "mass=1,2",
        "--out",
        rows.to_str().expect("text"),
    ]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let rows = std::fs::read_to_string(rows).expect("rows");
    let [x, v] = end(&summary(spec.path(), &call));
    let mut lines = rows
        .lines()
        .map(|line| line.split(',').collect::<Vec<&str>>());
    let head = lines.next().expect("a head");
    let place = |name: &str| head.iter().position(|head| *head == name).expect(name);
    let first = lines.next().expect("a row");
    assert_eq!(first[place("x")], format!("{x:?}"));
    assert_eq!(first[place("der(x)")], format!("{v:?}"));
    let page = Page::of(spec.path(), &call);
    assert!(page.html.contains("push.csv:force,hold"));
}

/// A controller at 20 Hz whose output acts 12 ms later, together with a table: a recursion of constant forces.
#[test]
fn a_sampled_formula_holds_until_the_next() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    let wind = spec.0.with_file_name("wind.csv");
    std::fs::write(&wind, "t,wind\n0,1\n0.31,-1\n").expect("a file");
    let wind = format!("wind={},hold", wind.display());
    let call = ["--until", "0.995", "--tolerance", "1e-12", "--input", &wind];
    let sampled = [
        "--input",
        "push=wind/2 - 4*N*s/m*der(x),every=50*ms,delay=12*ms",
    ];
    let found = end(&summary(spec.path(), &[&call[..], &sampled].concat()));
    let mut instants: Vec<(f64, i32)> = vec![(0.31, 2), (0.995, 3)];
    for k in 0..20 {
        instants.extend([(0.05 * f64::from(k), 0), (0.05 * f64::from(k) + 0.012, 1)]);
    }
    instants.sort_by(|one, other| one.0.total_cmp(&other.0));
    let (mut state, mut push, mut wind, mut now, mut set) = ([0.25, 0.0], 0.0, 1.0, 0.0, 0.0);
    for (t, what) in instants {
        state = swung(state, push + wind, t - now);
        now = t;
        match what {
            0 => set = wind / 2.0 - 4.0 * state[1],
            1 => push = set,
            2 => wind = -1.0,
            _ => {}
        }
    }
    near(found, state, 1e-10);
}

/// The table shows at each sample what is set there, however its time is rounded, also at a sample that ends the run; with a
/// delay of one period, what was set one sample earlier.
#[test]
fn the_value_of_a_sample_holds_at_its_row() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    let out = spec.0.with_file_name("run.csv");
    let out = out.to_str().expect("text");
    for late in [0_i32, 1] {
        let push = format!("push=1*N/s*t,every=0.1,delay={}", f64::from(late) / 10.0);
        let call = ["--until", "1", "--every", "0.02", "--input", &push];
        let said = simulate(spec.path(), &[&call[..], &["--out", out]].concat());
        assert_eq!(said.status, 0, "{}", said.error);
        let rows = std::fs::read_to_string(out).expect("a table");
        let mut lines = rows.lines();
        let header: Vec<&str> = lines.next().expect("a head").split(',').collect();
        let place = header.iter().position(|head| *head == "push [N]");
        let place = place.expect("a column");
        let cells = lines.map(|line| line.split(',').nth(place).expect("a cell"));
        let found: Vec<f64> = cells.map(|cell| cell.parse().expect("a number")).collect();
        assert_eq!(found.len(), 51);
        for (row, found) in (0..).zip(found) {
            let known = f64::from((row / 5 - late).max(0)) / 10.0;
            // The time of the sample is rounded once more.
            assert!((found - known).abs() <= f64::EPSILON, "{row}: {found}");
        }
    }
}

#[test]
fn what_cannot_drive_an_input_is_refused() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    let folder = spec.0.parent().expect("a folder");
    let tables = [
        (
            "empty.csv",
            "t,push\n0,1\n0.5,\n",
            "empty.csv, line 3, column 5: the cell of `push` is empty",
        ),
        (
            "comma.csv",
            "t;push\n0;1,5\n",
            "comma.csv, line 2, column 3: `1,5` in `push` is not a finite number; the decimal mark",
        ),
        (
            "back.csv",
            "t,push\n1,0\n # later\n1,0\n",
            "back.csv, line 4, column 1: this time is not later",
        ),
        (
            "unit.csv",
            "t, push [m]\n0,1\n",
            "unit.csv, line 1, column 4: the unit `m` of `push`: expected N, found m",
        ),
        ("bare.csv", "t,push [1]\n0,1\n", "the unit `1` of `push`"),
        ("three.csv", "t,push [3]\n0,1\n", "expected a unit"),
        ("short.csv", "t,a,push\n0,1\n", "short.csv, line 2"),
        ("long.csv", "t,push\n0,1,2\n", "more cells than the header"),
        ("name.csv", "t,pusch\n0,1\n", "did you mean `pusch`?"),
        (
            "slash.csv",
            "t/s,push\n0,1\n",
            "in brackets, after a space: `t [s]`",
        ),
        (
            "round.csv",
            "t,push (kN)\n0,1\n",
            "in brackets, after a space: `push [kN]`",
        ),
        (
            "close.csv",
            "t,push[kN]\n0,1\n",
            "in brackets, after a space: `push [kN]`",
        ),
        ("none.csv", "", "it is empty"),
        ("head.csv", "t,push\n", "no rows"),
        (
            "twice.csv",
            "t,push,push\n0,1,1\n",
            "twice.csv, line 1, column 8: a second column",
        ),
        ("quote.csv", "t,push\n0,\"1\n", "a quote is not closed"),
        (
            "nan.csv",
            "t,push\n0,nan\n",
            "`nan` in `push` is not a finite number",
        ),
    ];
    for (name, text, why) in tables {
        std::fs::write(folder.join(name), text).expect("a file");
        let input = format!("push={}", folder.join(name).display());
        let said = simulate(spec.path(), &["--until", "1", "--input", &input]);
        assert_eq!(said.status, 2, "{name}: {}", said.error);
        assert!(said.error.contains(why), "{name}: {}", said.error);
    }
    // Also where the column is named as it stands there: the number would be taken in the unit of the input.
    let slash = folder.join("slash.csv");
    std::fs::write(&slash, "t,push/kN\n0,1\n").expect("a file");
    let input = format!("push={}:push/kN", slash.display());
    let said = simulate(spec.path(), &["--until", "1", "--input", &input]);
    assert_eq!(said.status, 2, "{}", said.error);
    assert!(said.error.contains("`push [kN]`"), "{}", said.error);
    std::fs::write(folder.join("latin.csv"), b"t,push\n0,1 # \xe9\n").expect("a file");
    let latin = format!("push={}", folder.join("latin.csv").display());
    std::fs::write(folder.join("good.csv"), "t,push\n0,1\n1,2\n").expect("a file");
    let good = folder.join("good.csv").display().to_string();
    let error = format!("push={good},end=error");
    let ring = format!("push={good},cubic,end=repeat");
    for (arguments, status, why) in [
        (&["--input", "pusch=1"][..], 2, "did you mean `push`?"),
        (&["--input", "push=x"], 2, "--input push: "),
        (&["--input", "push=3*m"], 2, "expected N, found m"),
        (&["--input", "push=load"], 2, "depends on the input itself"),
        (
            &["--input", "push=wind", "--input", "wind=push"],
            2,
            "depend on each other",
        ),
        (&["--input", "push=mass*a"], 2, "accelerations"),
        (
            &["--input", "push=1", "--input", "push=2"],
            2,
            "more than once",
        ),
        (
            &["--input", "push=1", "--set", "push=2"],
            2,
            "driven by --input",
        ),
        (
            &["--input", "push=1,every=1", "--input", "wind=1,every=2"],
            2,
            "must have the same period and the same delay",
        ),
        (&["--input", "push=1,every=1*m"], 2, "expected s, found m"),
        (&["--input", "push=none.csv"], 2, "cannot read none.csv"),
        (
            &["--input", &latin],
            2,
            "latin.csv, line 2, column 7: this is not UTF-8",
        ),
        (
            &["--input", &ring],
            2,
            "must end with the value with which it begins",
        ),
        (
            &["--input", &error],
            1,
            "the table of input push covers only a part of the run: it has no value next to t = ",
        ),
        (&["--input", "push=1,every=1e-300"], 2, "greater than 0"),
        (
            &["--input", &format!("push={good}"), "--out", &good],
            2,
            "the table of an input",
        ),
    ] {
        let said = simulate(spec.path(), &[&["--until", "2"], arguments].concat());
        assert_eq!(said.status, status, "{arguments:?}: {}", said.error);
        assert!(said.error.contains(why), "{arguments:?}: {}", said.error);
    }
    assert_eq!(
        std::fs::read_to_string(&good).expect("the table"),
        "t,push\n0,1\n1,2\n"
    );
    // An input without a power series is reported, and the run uses another method.
    let call = [
        "--until",
        "0.5",
        "--method",
        "taylor",
        "--input",
        "push=1*N*sin(1*rad/s*t)",
    ];
    let said = simulate(spec.path(), &call);
    assert_eq!(said.status, 0);
    assert!(
        said.error
            .contains("no Taylor series: input `push` changes continuously"),
        "{}",
        said.error
    );
    let warnings = &summary(spec.path(), &call)["warnings"];
    let first = warnings[0].as_str().expect("a warning");
    assert!(
        first.starts_with("no Taylor series: input `push` changes continuously")
            && first.ends_with("dop853 is used"),
        "{first}"
    );
}

/// The required friction of a rolling contact follows the input, not its default: |T|/N of a disc that is pulled at its centre
/// with F has T = F/3.
#[test]
fn friction_that_rolling_needs_follows_the_inputs() {
    let text = "machine Disc in plane {
        parameters { m: kg = 3, r: m = 0.5, g: m/s^2 = 10 }
        coordinates { x: m, y: m = r, phi: rad }
        inputs { pull: N }
        frames { body = ground.shift(x, y).turn(phi) }
        bodies { disc { mass: m, inertia: 1/2*m*r^2, frame: body } }
        circles { rim { on: body, center: (0, 0), radius: r } }
        gravity (0, -g);
        forces { rope { on: x, value: pull } }
        rolling { wheel { circle: rim, along: ground } }
    }";
    let spec = Scratch::new("disc.machine", text);
    let table = spec.0.with_file_name("pull.csv");
    std::fs::write(&table, "t,pull\n0,9\n0.5,18\n0.8,0\n").expect("a file");
    let input = format!("pull={},hold", table.display());
    let found = summary(spec.path(), &["--until", "1", "--input", &input]);
    let needed = found["contacts"][0]["friction_needed"]
        .as_f64()
        .expect("a number");
    assert!((needed - 6.0 / 30.0).abs() < 1e-9, "{needed}");
    assert!((found["v"]["x"].as_f64().expect("a number") - (4.5 + 5.4) / 4.5).abs() < 1e-9);
}
