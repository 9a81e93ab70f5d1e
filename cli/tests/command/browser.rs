//! The page in a browser: the test operates its controls, and compares its
//! positions of all bodies with the model's own expressions in double-double.
//!
//! Needs Chromium or Chrome: on the path, or named by the environment variable `CHROMIUM`.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::support::{Page, Scratch, root};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, Simulation, Solution};
use lagrangian_mechanics::Compiled;
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::{Dag, Expr, Symbol, evaluate};
use serde_json::Value;

const TOLERANCE: f64 = 1e-11;

/// The page's bound on the interpolation error between stored states, as a fraction of a coordinate's range; for angles it is also
/// the absolute bound.
const INTERPOLATION: f64 = 2e-4;

/// The number of stored states that are compared, and of instants between them.
const ASKED: usize = 12;

fn browser() -> PathBuf {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let names = [
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
        "chrome",
    ];
    let found = std::env::split_paths(&path)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|file| file.is_file());
    named
        .or(found)
        .expect("Chromium or Chrome on the path, or its file in CHROMIUM")
}

/// The document after its scripts have run for this many seconds of virtual time.
fn loaded(page: &Path) -> String {
    let profile = Scratch::new("profile", "");
    let folder = profile.0.parent().expect("a folder");
    let output = Command::new(browser())
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--window-size=1300,900",
            "--virtual-time-budget=60000",
            // A page that shows another one in a frame may read the files beside it.
            "--allow-file-access-from-files",
        ])
        .arg(format!("--user-data-dir={}", folder.display()))
        .arg("--dump-dom")
        .arg(format!("file://{}", page.display()))
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .expect("the browser runs");
    String::from_utf8(output.stdout).expect("text")
}

/// The text of the element with this id, which contains no elements.
fn text_of(html: &str, tag: &str, id: &str) -> Option<String> {
    let (_, rest) = html.split_once(&format!("<{tag} id=\"{id}\">"))?;
    let (text, _) = rest.split_once(&format!("</{tag}>"))?;
    let plain = text.replace("&lt;", "<").replace("&gt;", ">");
    Some(plain.replace("&nbsp;", "\u{a0}").replace("&amp;", "&"))
}

/// The result that scripts added to a page write into it.
fn verdict(page: &Page, scripts: &str) -> Value {
    let watch = include_str!("browser/watch.js");
    let html = page
        .html
        .replacen("<head>", &format!("<head><script>{watch}</script>"), 1);
    let html = html.replacen("</body>", &format!("{scripts}</body>"), 1);
    let file = Scratch::new("watched.html", &html);
    let verdict = text_of(&loaded(&file.0), "pre", "verdict").expect("a verdict");
    serde_json::from_str(&verdict).expect("JSON")
}

/// Checks the page of a machine: there are no errors, everything has a position, and something is drawn.
fn look(spec: &str, options: &[&str]) {
    let page = Page::of(spec, options);
    let script = include_str!("browser/look.js");
    let verdict = verdict(&page, &format!("<script type=\"module\">{script}</script>"));
    assert_eq!(verdict["wrong"], serde_json::json!([]), "{spec}");
    assert_eq!(verdict["finite"], true, "{spec}");
    let coloured = verdict["coloured"].as_array().expect("numbers").iter();
    assert!(
        coloured.clone().all(|count| count.as_u64() > Some(30)),
        "{spec}: {verdict}"
    );
    let curves = verdict["curves"].as_array().expect("numbers").iter();
    assert!(
        curves.clone().all(|length| length.as_u64() > Some(5)),
        "{spec}: {verdict}"
    );
    assert!(verdict["formulas"].as_u64() > Some(3), "{spec}: {verdict}");
}

/// Operates every control of the page of a machine, and compares its positions.
fn check(spec: &str, options: &[&str]) {
    let until: f64 = options[0].parse().expect("the end of the run");
    let tolerance = TOLERANCE.to_string();
    let call = ["--tolerance", &tolerance, "--until"];
    let page = Page::of(spec, &[&call, options].concat());
    let states = page.states().len();
    // Stored states first, then instants between them, including midpoints.
    let chosen = |k: usize| k * (states - 2) / (ASKED - 1);
    let stored = (0..ASKED).map(|k| page.time(chosen(k)));
    let between = (0..ASKED).map(|k| {
        let (a, b) = (page.time(chosen(k)), page.time(chosen(k) + 1));
        a + (b - a) * (0.5 - 0.03 * k as f64)
    });
    let asked: Vec<f64> = stored.chain(between).collect();

    let script = format!(
        "<script type=\"application/json\" id=\"asked\">{}</script>\n<script type=\"module\">{}</script>",
        serde_json::json!(asked),
        include_str!("browser/press.js")
    );
    let verdict = verdict(&page, &script);
    assert_eq!(verdict["ended"], Value::Null, "{}", verdict["ended"]);
    assert_eq!(verdict["wrong"], serde_json::json!([]), "{spec}");
    assert_eq!(verdict["failed"], serde_json::json!([]), "{spec}");
    assert!(verdict["count"].as_u64() > Some(60), "{}", verdict["count"]);

    let truth = Truth::new(spec, until);
    let positions = verdict["positions"].as_array().expect("positions");
    assert_eq!(positions.len(), asked.len());
    for (index, (t, bodies)) in asked.iter().zip(positions).enumerate() {
        let interpolated = index >= ASKED;
        for (body, (seen, expected)) in bodies
            .as_array()
            .expect("bodies")
            .iter()
            .zip(truth.at(*t, interpolated))
            .enumerate()
        {
            for (k, (position, error)) in expected.into_iter().enumerate() {
                let seen = seen[k].as_f64().expect("a number");
                assert!(
                    (seen - position).abs() <= error,
                    "{spec}, body {body}, component {k}, t = {t}: {seen}, not {position} ± {error:.1e}"
                );
            }
        }
    }
}

/// The positions of the bodies by the expressions of the model in double-double, and the error that the page may have.
struct Truth {
    model: Model<'static>,
    run: Solution<InterpretedMachine>,
    parameters: Vec<f64>,
    coordinates: Vec<Symbol>,
    /// The components of the mass centres of all bodies, and their derivatives by the coordinates.
    components: Vec<Expr<'static>>,
    slopes: Vec<Vec<Expr<'static>>>,
    /// The range of each coordinate.
    extremes: Vec<(f64, f64)>,
}

impl Truth {
    fn new(spec: &str, until: f64) -> Truth {
        let path = root().join(spec);
        let path = path.to_str().expect("text");
        let (_, text) = Disk.read(path, None).expect("a spec");
        // It must live as long as the test.
        let dag: &'static Dag = Box::leak(Box::default());
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let files = &mut Disk;
        let model = lagrangian_spec::model(dag, path, &text, &[], files, &mut sources, &mut report);
        let compiled = Compiled::new(model.expect("a good spec"), &mut report).expect("derivable");
        let machine = InterpretedMachine::new(compiled.program.clone());
        let run = Simulation::new(&machine)
            .tolerance(TOLERANCE)
            .until(until)
            .run(machine.start())
            .expect("the run");
        let model = compiled.model;
        let coordinates: Vec<Symbol> = model
            .coordinates
            .iter()
            .map(|coordinate| coordinate.q.as_symbol().expect("a symbol"))
            .collect();
        let bodies = model.bodies.iter();
        let components: Vec<Expr<'static>> = bodies.flat_map(|body| body.at.clone()).collect();
        let slopes = components
            .iter()
            .map(|x| coordinates.iter().map(|symbol| x.diff(*symbol)).collect())
            .collect();
        let instants = run.every(until.abs() / 4000.0).expect("instants");
        let extremes = (0..coordinates.len())
            .map(|i| {
                let values = instants.iter().map(|state| state.q.values[i]);
                values.fold((f64::MAX, f64::MIN), |(low, high), x| {
                    (low.min(x), high.max(x))
                })
            })
            .collect();
        Truth {
            parameters: machine.parameter_values().to_vec(),
            model,
            run,
            coordinates,
            components,
            slopes,
            extremes,
        }
    }

    /// For each body and component the position at time `t`, and the allowed error: from the rounding of stored values,
    /// and from interpolation.
    fn at(&self, t: f64, interpolated: bool) -> Vec<Vec<(f64, f64)>> {
        let q = self.run.at(t).expect("within the run").q.values;
        let value = |symbol: Symbol| {
            let is = |expression: Expr<'_>| expression.as_symbol() == Some(symbol);
            if is(self.model.time) {
                return DoubleDouble::from_f64(t);
            }
            if let Some(i) = self.coordinates.iter().position(|other| *other == symbol) {
                return DoubleDouble::from_f64(q[i]);
            }
            let mut parameters = self.model.parameters.iter();
            let place = parameters.position(|parameter| is(parameter.symbol));
            DoubleDouble::from_f64(self.parameters[place.expect("a parameter")])
        };
        let allowed = |i: usize| {
            let (low, high) = self.extremes[i];
            // Half a unit in the last of 24 binary digits.
            let stored = low.abs().max(high.abs()) * 2.0_f64.powi(-24);
            let between = INTERPOLATION * (high - low);
            match (interpolated, self.model.coordinates[i].unit_text.as_str()) {
                (false, _) => stored,
                (true, "rad") => stored + between.min(INTERPOLATION),
                (true, _) => stored + between,
            }
        };
        let positions = evaluate(self.model.dag, &self.components, value);
        let with_errors: Vec<(f64, f64)> = positions
            .iter()
            .zip(&self.slopes)
            .map(|(position, slopes)| {
                let slopes = evaluate(self.model.dag, slopes, value);
                let slopes = slopes.iter().enumerate();
                let error: f64 = slopes.map(|(i, slope)| slope.hi().abs() * allowed(i)).sum();
                // A margin for the change of slopes over such errors; the functions of a browser are accurate to a few units in the
                // last of 53 binary digits.
                let error = 1.05 * error + 1e-13 * (1.0 + position.hi().abs());
                (position.hi(), error)
            })
            .collect();
        let dimension = self.model.space.dimension();
        with_errors
            .chunks(dimension)
            .map(<[(f64, f64)]>::to_vec)
            .collect()
    }
}

#[test]
#[ignore = "needs Chromium"]
fn a_double_pendulum_moves() {
    check("machines/double_pendulum.machine", &["4"]);
}

#[test]
#[ignore = "needs Chromium"]
fn a_crusher_moves_and_its_debalance_turns_with_time_itself() {
    check("machines/cushioned_crusher.machine", &["1"]);
}

#[test]
#[ignore = "needs Chromium"]
fn a_chain_moves() {
    check("machines/chain_relative.machine", &["2"]);
}

#[test]
#[ignore = "needs Chromium"]
fn an_arm_moves_in_space() {
    check("machines/six_joint_arm.machine", &["1.5"]);
}

#[test]
#[ignore = "needs Chromium"]
fn every_machine_of_the_library_is_drawn() {
    let folder = std::fs::read_dir(root().join("machines")).expect("the library");
    let files = folder.map(|entry| entry.expect("a file").path());
    let mut seen = 0;
    for file in files.filter(|file| file.extension().is_some_and(|end| end == "machine")) {
        look(file.to_str().expect("text"), &["--until", "0.4"]);
        seen += 1;
    }
    assert!(seen >= 9, "{seen}");
}

/// In the plane and in space, with the forces of their contacts.
#[test]
#[ignore = "needs Chromium"]
fn machines_whose_parts_collide_are_drawn() {
    for machine in ["colliding_crusher", "dropped_box", "shaken_box"] {
        let spec = format!("machines/contacts/{machine}.machine");
        look(&spec, &["--until", "0.4"]);
    }
}

#[test]
#[ignore = "needs Chromium"]
fn a_machine_that_does_not_move_is_drawn() {
    let text = "machine Still in plane {
    parameters { m: kg = 1 }
    coordinates { x: m }
    bodies { still { mass: m, at: (x, 0) } }
}
";
    let spec = Scratch::new("still.machine", text);
    look(spec.path(), &["--until", "1"]);
    look("machines/double_pendulum.machine", &["--until", "0"]);
}

/// The minimum width of a browser window is wider than a phone, so the page is shown in a frame.
#[test]
#[ignore = "needs Chromium"]
fn a_phone_shows_all_of_it() {
    for machine in ["double_pendulum", "cushioned_crusher", "six_joint_arm"] {
        let spec = format!("machines/{machine}.machine");
        let page = Page::of(&spec, &["--until", "0.5"]);
        let file = Scratch::new("page.html", &page.html);
        let frame = file.0.with_file_name("frame.html");
        let text = "<!doctype html><iframe src=\"page.html\" style=\"width: 360px; height: 700px\"></iframe>
            <script>
            addEventListener('load', () => setTimeout(() => {
              const frame = document.querySelector('iframe');
              const page = frame.contentDocument;
              const verdict = document.createElement('pre');
              verdict.id = 'verdict';
              const out = [...page.querySelectorAll('body *')].filter((element) =>
                element.getBoundingClientRect().right > page.documentElement.clientWidth + 0.5 && !element.closest('.scroll, .table, .formula'));
              verdict.textContent = JSON.stringify({
                title: page.title,
                wide: [frame.contentWindow.innerWidth, page.documentElement.scrollWidth],
                out: out.map((element) => element.outerHTML.slice(0, 80)),
              });
              document.body.append(verdict);
            }, 2000));
            </script>";
        std::fs::write(&frame, text).expect("a file");
        let verdict = text_of(&loaded(&frame), "pre", "verdict").expect("a verdict");
        let verdict: Value = serde_json::from_str(&verdict).expect("JSON");
        assert!(!verdict["title"].as_str().unwrap_or_default().is_empty());
        let [has, needs] = [0, 1].map(|k| verdict["wide"][k].as_f64());
        assert!(has == Some(360.0) && needs <= has, "{machine}: {verdict}");
        assert_eq!(verdict["out"], serde_json::json!([]), "{machine}");
    }
}

#[test]
#[ignore = "needs Chromium"]
fn a_run_backward_in_time_moves() {
    check("machines/cart_pole.machine", &["-2"]);
}

/// Every function of expressions is used in the position of a body.
#[test]
#[ignore = "needs Chromium"]
fn every_function_places_a_body() {
    let text = "machine Functions in plane {
    parameters { m: kg = 1, k: N/m = 5, L: m = 1, a: 1 = 0.7, w: rad/s = 3 }
    coordinates { q: 1 = 0.4, p: 1 = 0.3 }
    define { s = sin(q)/2, far = 2 + s^2 }
    bodies {
        circular { mass: m, at: L*(asin(s) + atan2(s, far), acos(s) + atan(q)) },
        hyperbolic { mass: m, at: L*(sinh(q) + tanh(p), cosh(p) - pi) },
        powers { mass: m, at: L*(exp(p) + q^5, ln(far) - far^a) },
        kinks { mass: m, at: L*(sqrt(far) - 3/4*abs(q - 9), sign(q + 9)*q) },
        choices { mass: m, at: L*(min(q, p + 9), max(q - 9, p)) },
        quotients { mass: m, at: L*(tan(q/3), 1/far^3 + cos(w*t)*q/far) },
    }
    springs { one { stiffness: k, stretch: L*q }, other { stiffness: k, stretch: L*p } }
}
";
    let spec = Scratch::new("functions.machine", text);
    check(spec.path(), &["1"]);
}

/// The final coordinates and rates of a run by the command.
fn end_of(spec: &str, until: f64, tolerance: f64, options: &[String]) -> Vec<f64> {
    let until = format!("{until:?}");
    let tolerance = format!("{tolerance:?}");
    let call = [
        "simulate",
        spec,
        "--until",
        &until,
        "--tolerance",
        &tolerance,
        "--json",
    ];
    let options = options.iter().map(String::as_str);
    let all: Vec<&str> = call.into_iter().chain(options).collect();
    let output = crate::support::lagrangian(&all);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{spec}: {said}");
    let end: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let numbers = |of: &str| -> Vec<f64> {
        let values = end[of].as_object().expect("numbers").values();
        values.map(|x| x.as_f64().expect("a number")).collect()
    };
    [numbers("q"), numbers("v")].concat()
}

/// A page that integrates: a slider moves, the curve changes, and the values shown are the command's. Both satisfy the tolerance in
/// each step, so they differ at most by the sum of all these errors, each multiplied by the growth of the distance between nearby
/// motions. The growth is measured by runs of the command whose starts differ by a millionth.
#[test]
#[ignore = "needs Chromium"]
fn a_page_runs_its_machine_again() {
    for (spec, until, changes) in [
        (
            "machines/double_pendulum.machine",
            "2",
            &[("m1", 1.7), ("g", 3.7), ("theta1", 0.9)][..],
        ),
        (
            "machines/cart_pole.machine",
            "1",
            &[("push", 2.5), ("der(x)", 0.3)],
        ),
        // Driven at 100 rad/s.
        ("machines/vibrating_crusher.machine", "0.5", &[("m", 620.0)]),
        // With holonomic constraints, onto which the start is projected, and with a nonholonomic one.
        (
            "machines/four_bar.machine",
            "1",
            &[("b", 0.85), ("crank", 0.2), ("der(crank)", 5.0)],
        ),
        (
            "machines/chaplygin_sleigh.machine",
            "1",
            &[("J", 0.09), ("der(phi)", 1.4)],
        ),
        // With a first-order state, and with rotation by a quaternion.
        (
            "machines/dc_motor.machine",
            "0.05",
            &[("R", 0.8), ("U", 10.0), ("i", 2.0), ("der(phi)", 20.0)],
        ),
        ("machines/upright_top.machine", "1", &[("spin", 50.0)]),
    ] {
        let page = Page::of(spec, &["--tolerance", "1e-11", "--until", until, "--live"]);
        let table = |names: &[&str]| -> Vec<String> {
            let data = page.html.split_once("id=\"live-data\">").expect("data").1;
            let data = data.split_once("</script>").expect("its end").0;
            let data: Value = serde_json::from_str(data).expect("JSON");
            let all = names
                .iter()
                .flat_map(|name| data[*name].as_array().expect("a list").clone());
            all.filter(|one| one["hidden"] == false)
                .filter_map(|one| Some(one["name"].as_str()?.to_owned()))
                .collect()
        };
        let states = table(&["states"]);
        let asked: serde_json::Map<String, Value> = changes
            .iter()
            .map(|(name, x)| ((*name).to_owned(), Value::from(*x)))
            .collect();
        let script = format!(
            "<script type=\"application/json\" id=\"asked\">{}</script>\n<script type=\"module\">{}</script>",
            serde_json::json!([asked]),
            include_str!("browser/live.js")
        );
        let verdict = verdict(&page, &script);
        assert_eq!(verdict["wrong"], serde_json::json!([]), "{spec}");
        assert_eq!(verdict["moved"], true, "{spec}");
        let run = &verdict["runs"][0];
        let status = run["status"].as_str().expect("words");
        assert_eq!(run["changed"], true, "{spec}: {status}");
        let steps = status
            .strip_prefix("Run again in this page: ")
            .expect("it ran");
        let steps: f64 = steps
            .split(' ')
            .next()
            .expect("a count")
            .parse()
            .expect("a number");
        let numbers = |of: &Value| -> Vec<f64> {
            let list = of.as_array().expect("numbers").iter();
            list.map(|x| x.as_f64().expect("a number")).collect()
        };
        // First-order states follow the rates of the coordinates.
        let n = numbers(&run["states"]).len() / numbers(&run["times"]).len() / 2;
        let options: Vec<String> = changes
            .iter()
            .flat_map(|(name, x)| {
                let option = match states.iter().position(|state| state == name) {
                    None => format!("--set\n{name}={x:?}"),
                    Some(i) if i < n || i >= 2 * n => format!("--start\n{name}={x:?}"),
                    Some(i) => format!("--rate\n{}={x:?}", states[i - n]),
                };
                option.split('\n').map(str::to_owned).collect::<Vec<_>>()
            })
            .collect();
        let (found, times) = (numbers(&run["states"]), numbers(&run["times"]));
        let begin = &found[..2 * n];
        for k in [times.len() / 2, times.len() - 1] {
            let known = end_of(spec, times[k], 1e-11, &options);
            let size = known.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            let mut growth = 1.0f64;
            // With constraints the given start is not the initial state of a motion, because it is projected; so the changed
            // parameters are varied by a millionth more instead.
            let is_held = page.html.contains("function constraint_matrix(");
            for at in (0..options.len()).step_by(2).filter(|_| is_held) {
                let mut moved = options.clone();
                let (name, _) = options[at + 1].split_once('=').expect("a value");
                moved[at + 1] = format!("{name}={:?}", changes[at / 2].1 + 1e-6);
                let parted = end_of(spec, times[k], 1e-11, &moved);
                let most = parted.iter().zip(&known).map(|(x, y)| (x - y).abs());
                growth += most.fold(0.0, f64::max) / 1e-6;
            }
            for i in (0..2 * n).filter(|_| !is_held) {
                let (option, name) = if i < n {
                    ("--start", &states[i])
                } else {
                    ("--rate", &states[i - n])
                };
                let mut moved: Vec<String> = options.clone();
                let mark = format!("{name}=");
                // Options and their values alternate.
                let mut pairs = moved.chunks(2);
                let said = pairs.position(|pair| pair[0] == option && pair[1].starts_with(&mark));
                if let Some(at) = said {
                    moved.drain(2 * at..2 * at + 2);
                }
                moved.extend([option.to_owned(), format!("{name}={:?}", begin[i] + 1e-6)]);
                let parted = end_of(spec, times[k], 1e-11, &moved);
                let most = parted.iter().zip(&known).map(|(x, y)| (x - y).abs());
                growth += most.fold(0.0, f64::max) / 1e-6;
            }
            let bound = 2.0 * steps * 1e-11 * (1.0 + size) * growth;
            for (x, y) in found[2 * n * k..][..2 * n].iter().zip(&known) {
                assert!(
                    (x - y).abs() <= bound,
                    "{spec}, at {}: {x} {y}, bound {bound:e}",
                    times[k]
                );
            }
            println!("{spec}, at {} s: bound {bound:e}", times[k]);
            assert!(bound < 0.01, "{spec}: nothing would break {bound:e}");
        }
        // After the reset, the first run, which the page stores in single precision.
        let back = numbers(&verdict["back"]);
        assert_eq!(back.len(), found.len());
        let end = end_of(spec, times[times.len() - 1], 1e-11, &[]);
        for (x, y) in back[back.len() - 2 * n..].iter().zip(&end) {
            assert!((x - y).abs() <= 1e-6 * (1.0 + y.abs()), "{spec}: {x} {y}");
        }
    }
}

/// A machine that a page cannot run is refused with the reason; a page without `--live` contains no code for it.
#[test]
fn pages_that_compute_are_of_machines_that_they_can_run() {
    for (spec, options, words) in [
        (
            "machines/block_on_incline.machine",
            &["--report", "x.html", "--live"][..],
            "sticks or slides",
        ),
        (
            "machines/four_bar.machine",
            &["--report", "x.html", "--live", "--keep", "crank"],
            "`keep { crank }` in place of --keep",
        ),
        ("machines/double_pendulum.machine", &["--live"], "--report"),
        (
            "machines/double_pendulum.machine",
            &["--report", "x.html", "--live", "--method", "radau5"],
            "the page supports only explicit methods",
        ),
        (
            "machines/cart_pole.machine",
            &["--report", "x.html", "--live", "--input", "push=1*N"],
            "at the values of its sliders: leave out --input",
        ),
        (
            "machines/contacts/bouncing_ball.machine",
            &["--report", "x.html", "--live"],
            "leave out --live, and the page shows the run",
        ),
    ] {
        let all = [&["simulate", spec, "--until", "0.1"], options].concat();
        let output = crate::support::lagrangian(&all);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{spec}: {said}");
        assert!(said.contains(words), "{spec}: {said}");
        assert!(!root().join("x.html").exists());
    }
    let at = crate::support::Scratch::new("bricard.html", "older");
    let call = [
        "simulate",
        "machines/bricard.machine",
        "--until",
        "0.1",
        "--live",
        "--report",
        at.path(),
    ];
    let output = crate::support::lagrangian(&call);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("is redundant given"), "{said}");
    let help = "`machine BricardPage extends \"bricard.machine\" { remove constraints.";
    assert!(said.contains(help), "{said}");
    assert_eq!(std::fs::read_to_string(&at.0).expect("a file"), "older");
    let page = Page::of("machines/simple_pendulum.machine", &["--until", "0.1"]);
    assert!(!page.html.contains("sliders") && !page.html.contains("Integrator"));
}
