//! The page in a browser: its controls are pressed, and where it puts every body is held against the model's own
//! expressions in double-double.
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

/// What the page promises between stored states: this part of what a coordinate spans, and for angles no more than this.
const INTERPOLATION: f64 = 2e-4;

/// How many stored states are asked for, and as many instants between them.
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

/// What the document is after its scripts have run for so many seconds of their own time.
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
            // Only what lies beside the page, for the one that shows it in a frame.
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

/// The text of an element without elements in it, by its id.
fn text_of(html: &str, tag: &str, id: &str) -> Option<String> {
    let (_, rest) = html.split_once(&format!("<{tag} id=\"{id}\">"))?;
    let (text, _) = rest.split_once(&format!("</{tag}>"))?;
    let plain = text.replace("&lt;", "<").replace("&gt;", ">");
    Some(plain.replace("&nbsp;", "\u{a0}").replace("&amp;", "&"))
}

/// What scripts that are added to a page write into it.
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

/// Looks at the page of a machine: nothing goes wrong, everything has a place, something is drawn.
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

/// Presses every control of the page of a machine, and compares its positions.
fn check(spec: &str, options: &[&str]) {
    let until: f64 = options[0].parse().expect("the end of the run");
    let tolerance = TOLERANCE.to_string();
    let call = ["--tolerance", &tolerance, "--until"];
    let page = Page::of(spec, &[&call, options].concat());
    let states = page.states().len();
    // Stored states first, then instants between them, those in the middle among them.
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

/// Where the bodies are, by the expressions of the model in double-double, and how far the page may be from that.
struct Truth {
    model: Model<'static>,
    run: Solution<InterpretedMachine>,
    parameters: Vec<f64>,
    coordinates: Vec<Symbol>,
    /// The mass centres of all bodies, component by component; and their derivatives by the coordinates.
    components: Vec<Expr<'static>>,
    slopes: Vec<Vec<Expr<'static>>>,
    /// Between what each coordinate stays.
    extremes: Vec<(f64, f64)>,
}

impl Truth {
    fn new(spec: &str, until: f64) -> Truth {
        let path = root().join(spec);
        let path = path.to_str().expect("text");
        let (_, text) = Disk.read(path, None).expect("a spec");
        // It lives as long as the test does.
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

    /// For each body and component the position at time `t`, and the error that is allowed: by the roundoff of what is
    /// stored, and by interpolation.
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
                // Slopes change a little over such errors; the functions of a browser are exact to a few units in the
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

/// The narrowest window of a browser is wider than a phone: the page is shown in a frame.
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

/// Every function that an expression can hold, where it places a body.
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
