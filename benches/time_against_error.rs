//! Time against true error: how long a run takes to be how exact, by every method, over all
//! tolerances.
//!
//! `cargo bench --bench time_against_error [-- FILE.svg]` prints a table and draws it.
#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

#[path = "../tests/support/mod.rs"]
mod support;

use std::fmt::Write;
use std::process::ExitCode;

use lagrangian::{Coordinates, Machine, Method, Simulation, State, System, Vector};
use lagrangian_machines::{
    AndrewsSqueezer, ClosedPendulum, Crusher9, DoublePendulum, FourBar, crusher9, double_pendulum,
};
use support::known_ends::{
    CHAOTIC_AT_10, CHAOTIC_START, CRUSHER_AT_5, CRUSHER_RANGES, CRUSHER_RATES, REGULAR_AT_100,
    REGULAR_START,
};

/// Runs of one setting; the quickest counts, for everything else on the computer only adds.
const REPEATS: usize = 7;

/// A run whose end is known to more digits than `f64` has: by Gragg–Bulirsch–Stoer extrapolation in
/// binary128, two resolutions of which agree to 4e-21; of the four-bar linkage and the five-link
/// pendulum, by Taylor's method in 64-bit mantissas, whose resolutions agree to 2e-14 and 1e-17.
struct Case<M: Machine> {
    name: &'static str,
    machine: M,
    start: State<Coordinates<M>>,
    until: f64,
    /// Coordinates, then rates, at the end.
    end: Vec<f64>,
    /// What an error is measured by, besides the size of the number.
    scales: Vec<f64>,
}

/// One setting of one case.
struct Point {
    method: &'static Method,
    tolerance: f64,
    evaluations: usize,
    seconds: f64,
    error: f64,
}

/// The methods whose steps a tolerance asks for.
fn controlled() -> impl Iterator<Item = &'static Method> {
    Method::all().filter(|method| !method.has_fixed_steps())
}

impl<M: Machine> Case<M> {
    fn points(&self) -> Vec<Point> {
        let tolerances = (6..=30).map(|half| 10_f64.powf(-0.5 * f64::from(half)));
        // Of compiled machines those have series that ask for them.
        let settings = controlled().flat_map(|method| tolerances.clone().map(move |t| (method, t)));
        settings
            .filter_map(|(method, tolerance)| self.point(method, tolerance))
            .collect()
    }

    /// None if the tolerance takes more steps than anybody would want.
    fn point(&self, method: &'static Method, tolerance: f64) -> Option<Point> {
        let mut seconds = f64::INFINITY;
        let mut last = None;
        for _ in 0..REPEATS {
            let run = Simulation::new(&self.machine)
                .method(method)
                .tolerance(tolerance)
                .max_steps(100_000)
                .forget_steps()
                .until(self.until)
                .run(self.start.clone())
                .ok()?;
            seconds = seconds.min(run.statistics().seconds);
            last = Some(run);
        }
        let run = last?;
        let error = self.error(run.system(), run.end());
        Some(Point {
            method,
            tolerance,
            evaluations: run.statistics().evaluations,
            seconds,
            error,
        })
    }

    fn error(&self, system: &M::System, end: &State<Coordinates<M>>) -> f64 {
        let (q, v) = (system.to_vector(&end.q), system.to_vector(&end.v));
        let found = q.as_slice().iter().chain(v.as_slice());
        let errors = found.zip(&self.end).zip(&self.scales);
        errors
            .map(|((y, exact), scale)| (y - exact).abs() / (scale + exact.abs()))
            .fold(0.0, f64::max)
    }
}

/// The classic double pendulum: unit masses and lengths, g = 9.81, from rest.
fn pendulum(
    name: &'static str,
    theta: [f64; 2],
    until: f64,
    end: [f64; 4],
) -> Case<DoublePendulum> {
    let machine = DoublePendulum::default();
    let start = State {
        t: 0.0,
        q: double_pendulum::Coordinates::from_array(theta),
        v: double_pendulum::Coordinates::from_array([0.0; 2]),
    };
    Case {
        name,
        machine,
        start,
        until,
        end: end.to_vec(),
        scales: vec![1.0; 4],
    }
}

fn crusher() -> Case<Crusher9> {
    let machine = Crusher9::default();
    Case {
        name: "crusher, 5 s",
        start: State {
            v: crusher9::Coordinates::from_array(CRUSHER_RATES),
            ..machine.start()
        },
        machine,
        until: 5.0,
        end: CRUSHER_AT_5.to_vec(),
        scales: CRUSHER_RANGES.to_vec(),
    }
}

/// A mechanism that constraints close, from where its spec starts it.
fn closed<M: Machine>(name: &'static str, machine: M, until: f64, end: &[f64]) -> Case<M> {
    Case {
        name,
        start: machine.start(),
        machine,
        until,
        end: end.to_vec(),
        scales: vec![1.0; end.len()],
    }
}

fn main() -> ExitCode {
    let regular = pendulum(
        "double pendulum, regular, 100 s",
        REGULAR_START,
        100.0,
        REGULAR_AT_100,
    );
    let chaotic = pendulum(
        "double pendulum, chaotic, 10 s",
        CHAOTIC_START,
        10.0,
        CHAOTIC_AT_10,
    );
    let crusher = crusher();
    let four_bar = closed(
        "four-bar linkage, 10 s",
        FourBar::default(),
        10.0,
        &[
            127.706727238734034,
            0.264982342180569,
            2.223460105630880,
            8.956708571057673,
            -0.651087510065570,
            4.733833590786719,
        ],
    );
    let five_links = closed(
        "five-link pendulum, 2 s",
        ClosedPendulum::default(),
        2.0,
        &[
            -0.6903013997507062590,
            -1.666516406019056136,
            -0.2774484363529711450,
            1.627660829310782490,
            1.137795839578224454,
            0.3494834116071452420,
            1.232930582693645329,
            0.3388175752150544740,
            2.296904466447944176,
            -0.8268732502550627055,
        ],
    );
    let squeezer = closed(
        "Andrews' squeezer, 0.03 s",
        AndrewsSqueezer::default(),
        0.03,
        &[
            15.81077119515370709712,
            -15.75637105841183946973,
            0.04082224011964580485828,
            -0.5347301163420795937702,
            0.5244099658799540693717,
            0.5347301163420795937702,
            1.048080741041937873069,
            1139.920302259106064198,
            -1424.379295177540073196,
            11.03291191061859374533,
            19.29337410503204083163,
            0.5735699148295024538177,
            -19.29337410503204083163,
            0.3231791492491308749908,
        ],
    );
    let cases = [
        (crusher.name, crusher.points()),
        (regular.name, regular.points()),
        (chaotic.name, chaotic.points()),
        (four_bar.name, four_bar.points()),
        (five_links.name, five_links.points()),
        (squeezer.name, squeezer.points()),
    ];

    println!("| case | method | tolerance | evaluations | microseconds | error |");
    println!("| --- | --- | --: | --: | --: | --: |");
    for (name, points) in &cases {
        for Point {
            method,
            tolerance,
            evaluations,
            seconds,
            error,
        } in points
        {
            println!(
                "| {name} | {} | {tolerance:.1e} | {evaluations} | {:.1} | {error:.2e} |",
                method.tableau.name,
                seconds * 1e6
            );
        }
    }

    // Cargo adds `--bench` to the arguments.
    let file = std::env::args()
        .skip(1)
        .find(|argument| !argument.starts_with("--"));
    if let Some(file) = file
        && let Err(error) = std::fs::write(&file, drawing(&cases))
    {
        eprintln!("{file}: {error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

/// Size of a panel and its margins, in pixels.
const PANEL: [f64; 2] = [360.0, 320.0];
const MARGIN: [f64; 2] = [64.0, 48.0];
const IN_A_ROW: usize = 3;
const COLORS: [&str; 5] = ["#1b6ca8", "#c8553d", "#588157", "#8a5a9e", "#b8860b"];

/// Error to the right, from 1 to 10⁻¹⁵; time upward, from 10 µs to 1 s; both logarithmic. Down and
/// to the right is better.
fn drawing(cases: &[(&str, Vec<Point>)]) -> String {
    let mut svg = String::new();
    let rows = cases.len().div_ceil(IN_A_ROW) as f64;
    let width = IN_A_ROW as f64 * (PANEL[0] + MARGIN[0]) + 16.0;
    let height = rows * (PANEL[1] + 2.0 * MARGIN[1]);
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\"><rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
    );
    for (i, (name, points)) in cases.iter().enumerate() {
        let left = MARGIN[0] + (i % IN_A_ROW) as f64 * (PANEL[0] + MARGIN[0]);
        let top = MARGIN[1] + (i / IN_A_ROW) as f64 * (PANEL[1] + 2.0 * MARGIN[1]);
        let x = |error: f64| left + PANEL[0] * (-error.log10() / 15.0).clamp(0.0, 1.0);
        let y = |time: f64| top + PANEL[1] * (1.0 - (time.log10() + 5.0) / 5.0).clamp(0.0, 1.0);
        let text = |svg: &mut String, x: f64, y: f64, anchor: &str, text: &str| {
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"
            );
        };
        text(
            &mut svg,
            left + PANEL[0] / 2.0,
            top - 12.0,
            "middle",
            &name.replace('\'', "’"),
        );
        for power in 0..=5 {
            let (error, time) = (10_f64.powi(-3 * power), 10_f64.powi(power - 5));
            for line in [
                [x(error), y(1e-5), x(error), y(1.0)],
                [x(1.0), y(time), x(1e-15), y(time)],
            ] {
                let [x1, y1, x2, y2] = line;
                let _ = writeln!(
                    svg,
                    "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#ddd\"/>"
                );
            }
            text(
                &mut svg,
                x(error),
                y(1e-5) + 16.0,
                "middle",
                &format!("1e-{}", 3 * power),
            );
            let time = ["10 µs", "100 µs", "1 ms", "10 ms", "0.1 s", "1 s"][power as usize];
            text(
                &mut svg,
                left - 6.0,
                y(10_f64.powi(power - 5)) + 4.0,
                "end",
                time,
            );
        }
        text(
            &mut svg,
            left + PANEL[0] / 2.0,
            y(1e-5) + 34.0,
            "middle",
            "error at the end",
        );
        for (method, color) in controlled().zip(COLORS) {
            let name = method.tableau.name;
            let mine = points
                .iter()
                .filter(|point| point.method.tableau.name == name);
            let mut line = String::new();
            for Point { error, seconds, .. } in mine {
                let _ = write!(line, "{:.1},{:.1} ", x(*error), y(*seconds));
                let _ = writeln!(
                    svg,
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\" fill=\"{color}\"/>",
                    x(*error),
                    y(*seconds)
                );
            }
            let _ = writeln!(
                svg,
                "<polyline points=\"{line}\" fill=\"none\" stroke=\"{color}\"/>"
            );
        }
    }
    for (i, (method, color)) in controlled().zip(COLORS).enumerate() {
        let (x, y) = (MARGIN[0] + 12.0, MARGIN[1] + 18.0 + 16.0 * i as f64);
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{y}\" fill=\"{color}\">{}</text>",
            method.tableau.title
        );
    }
    svg.push_str("</svg>\n");
    svg
}
