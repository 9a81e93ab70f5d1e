//! The scripts of `examples/maps/` at small sizes, against known results for their subjects.

use std::collections::HashMap;
use std::process::Command;

use crate::support::{Scratch, lagrangian, root};

/// The rows of a table written by a script: numbers and texts by the names of columns.
struct Table(Vec<HashMap<String, String>>);

impl Table {
    fn read(folder: &Scratch, name: &str) -> Table {
        let path = folder.0.with_file_name(name);
        let text = std::fs::read_to_string(path).expect("a table");
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().expect("names").split(',').collect();
        let rows = lines.map(|line| {
            let cells = line.split(',').map(str::to_owned);
            names
                .iter()
                .map(|name| (*name).to_owned())
                .zip(cells)
                .collect()
        });
        Table(rows.collect())
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        let cells = self.0.iter().map(|row| row[name].parse());
        cells.map(|cell| cell.expect("a number")).collect()
    }
}

/// Runs a script; returns the folder that it writes to.
fn run(script: &str, size: &[&str], drawing: &str) -> Scratch {
    let folder = Scratch::new("started", "");
    let out = folder.0.parent().expect("a folder");
    let output = Command::new("sh")
        .current_dir(root())
        .env("LAGRANGIAN", env!("CARGO_BIN_EXE_lagrangian"))
        .arg(format!("examples/maps/{script}.sh"))
        .arg(out)
        .args(size)
        .output()
        .expect("a shell");
    assert!(output.status.success(), "{output:?}");
    for ending in ["svg", "html"] {
        assert!(
            out.join(format!("{drawing}.{ending}")).is_file(),
            "{drawing}.{ending}"
        );
    }
    folder
}

#[test]
fn a_pendulum_stands_upside_down_where_kapitza_says() {
    let folder = run("upright_pendulum", &["6"], "upright");
    let table = Table::read(&folder, "upright.csv");
    let (a, omega, tilt) = (
        table.numbers("a"),
        table.numbers("omega"),
        table.numbers("tilt"),
    );
    let mut both = [0; 2];
    for k in 0..tilt.len() {
        // a² ω² > 2 g l; the next order in a/l, which is at most 0.2 here, is 7/16·(2 a/l)²·… < 5 %.
        let share = a[k] * omega[k] / (2.0_f64 * 9.81).sqrt();
        match share {
            s if s > 1.1 => {
                both[0] += 1;
                assert!(tilt[k] < 0.05, "{share}: {}", tilt[k]);
            }
            s if s < 0.9 => {
                both[1] += 1;
                assert!(tilt[k] > 1.5, "{share}: {}", tilt[k]);
            }
            _ => {}
        }
    }
    assert!(both[0] > 8 && both[1] > 8, "{both:?}");
}

#[test]
fn a_double_pendulum_flips_only_where_it_has_the_energy() {
    let folder = run("flip_time", &["13", "4"], "flips");
    // The map command reads the Parquet table itself; the flips are drawn from it, and its rows are those of a text table.
    let csv = folder.0.with_file_name("flips.csv");
    let output = lagrangian(&[
        "sweep",
        "machines/double_pendulum.machine",
        "--vary",
        "start(theta1)=-3.1..3.1:13",
        "--vary",
        "start(theta2)=-3.1..3.1:13",
        "--until",
        "4",
        "--tolerance",
        "1e-6",
        "--until-event",
        "flip=cos(theta1/2)*cos(theta2/2)",
        "--out",
        csv.to_str().expect("text"),
    ]);
    assert!(output.status.success(), "{output:?}");
    let table = Table::read(&folder, "flips.csv");
    let starts = ["start(theta1)", "start(theta2)"].map(|name| table.numbers(name));
    let t = table.numbers("t");
    let (mut flips, mut rests) = (0, 0);
    for (k, row) in table.0.iter().enumerate() {
        let (one, two) = (starts[0][k], starts[1][k]);
        // For equal bobs on equal rods V = −m g l (2 cos θ1 + cos θ2), and a flip needs at least −1 m g l, at θ1 = 0, θ2 = π.
        let can = -(2.0 * one.cos() + two.cos()) >= -1.0;
        let has = row["status"] == "event flip";
        assert!(can || !has, "({one}, {two}) flips at {} s", t[k]);
        flips += usize::from(has);
        rests += usize::from(!can);
        // The opposite start has the mirrored motion, until chaos amplifies round-off.
        let mirror = t.len() - 1 - k;
        if t[k] < 2.0 {
            assert!(
                (t[k] - t[mirror]).abs() < 1e-3,
                "({one}, {two}): {} and {} s",
                t[k],
                t[mirror]
            );
        }
    }
    assert!(flips > 20 && rests > 20, "{flips} flips, {rests} cannot");
}

#[test]
fn a_block_sticks_again_where_its_swing_brings_it_back_to_the_belts_speed() {
    let folder = run("stick_slip_regions", &["7"], "stick");
    let table = Table::read(&folder, "stick.csv");
    let (belt, damping, share) = (
        table.numbers("v_b"),
        table.numbers("d"),
        table.numbers("share"),
    );
    let mut both = [0; 2];
    for k in 0..share.len() {
        // m = k = g = 1. The block breaks away at x = μ0 − d v, and swings about μ: z'' + d z' + z = 0.
        let (v, d) = (belt[k], damping[k]);
        let (z, rate) = (0.5 - d * v, v);
        let omega = (1.0 - d * d / 4.0).sqrt();
        let b = (rate + d / 2.0 * z) / omega;
        // The rate of z = e^{−dt/2} (z cos ωt + b sin ωt), shortly after the break-away.
        let rate = |t: f64| {
            let (s, c) = (omega * t).sin_cos();
            (-d * t / 2.0).exp() * ((b * omega - d / 2.0 * z) * c - (z * omega + d / 2.0 * b) * s)
        };
        // After the first turning point, within one more half period.
        let turn = std::f64::consts::PI / omega;
        let back = (0..2000).map(|i| rate(turn * (1.0 + f64::from(i) / 2000.0 * 1.2)));
        let reached = back.fold(f64::NEG_INFINITY, f64::max) / v;
        match reached {
            r if r > 1.01 => {
                both[0] += 1;
                assert!(
                    share[k] > 1.0 - 1e-6,
                    "v = {v}, d = {d}: {reached}, {}",
                    share[k]
                );
            }
            r if r < 0.99 => {
                both[1] += 1;
                assert!(
                    share[k] < 1.0 - 1e-3,
                    "v = {v}, d = {d}: {reached}, {}",
                    share[k]
                );
            }
            _ => {}
        }
    }
    assert!(both[0] > 5 && both[1] > 5, "{both:?}");
}

#[test]
fn a_driven_pendulum_doubles_its_period_where_the_book_says() {
    let folder = run("bifurcations", &["13"], "pendulum");
    let table = Table::read(&folder, "pendulum.csv");
    let samples = Table::read(&folder, "pendulum.samples.csv");
    let torque = table.numbers("g");
    let mut rates: Vec<Vec<f64>> = vec![Vec::new(); torque.len()];
    for (run, rate) in samples
        .numbers("run")
        .iter()
        .zip(samples.numbers("der(theta)"))
    {
        rates[*run as usize].push(rate);
    }
    let kinds = rates.iter_mut().map(|rates| {
        rates.sort_by(f64::total_cmp);
        1 + rates
            .windows(2)
            .filter(|pair| pair[1] - pair[0] > 1e-4)
            .count()
    });
    let kinds: Vec<usize> = kinds.collect();
    let of = |g: f64| {
        let place = torque.iter().position(|other| (other - g).abs() < 1e-9);
        kinds[place.expect("a torque of the sweep")]
    };
    // Baker and Gollub, figures 3.3 to 3.6: period one at 0.9 and 1.35, two at 1.45, chaos at 1.15 and 1.5, for q = 2, ω = 2/3.
    assert_eq!([of(0.9), of(1.35), of(1.45)], [1, 1, 2], "{kinds:?}");
    assert!(of(1.15) > 20 && of(1.5) > 20, "{kinds:?}");
}

#[test]
fn the_crusher_over_speed_is_the_crusher_at_each_speed() {
    let folder = run("crusher_over_speed", &["2"], "crusher");
    let table = Table::read(&folder, "crusher.csv");
    let run = folder.0.with_file_name("run.csv");
    let output = lagrangian(&[
        "simulate",
        "machines/cushioned_crusher.machine",
        "--set",
        "omega=60",
        "--until",
        "4",
        // The motion amplifies errors by a thousand in each second, so that only the run of the row itself will do.
        "--one-of",
        "2",
        "--every",
        "0.0002",
        "--out",
        run.to_str().expect("text"),
    ]);
    assert!(output.status.success(), "{output:?}");
    let text = std::fs::read_to_string(&run).expect("a table");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let place = |name: &str| {
        let own = names
            .iter()
            .position(|header| header.split(" [").next() == Some(name));
        own.unwrap_or_else(|| panic!("{name} in {names:?}"))
    };
    let rows = lines.map(|line| {
        line.split(',')
            .map(|cell| cell.parse().expect("a number"))
            .collect()
    });
    let rows: Vec<Vec<f64>> = rows.filter(|row: &Vec<f64>| row[0] >= 2.0).collect();
    // With the trapezoidal rule and the largest of 10 000 samples, 500 per revolution: to 1e-4 of the values.
    let of = |row: &Vec<f64>, name: &str| row[place(name)];
    let power = |row: &Vec<f64>| {
        let slip = of(row, "s2") * of(row, "der(phi2)") + 0.17 * of(row, "der(theta2)")
            - 0.20 * of(row, "der(theta1)");
        6000.0 * of(row, "der(s2)").powi(2) + 300.0 * slip * slip
    };
    let steps = rows
        .windows(2)
        .map(|pair| 0.5 * (power(&pair[0]) + power(&pair[1])) * (pair[1][0] - pair[0][0]));
    let mean = steps.sum::<f64>() / (rows[rows.len() - 1][0] - rows[0][0]);
    let largest = |name: &str| rows.iter().map(|row| of(row, name)).fold(0.0, f64::max);
    for (name, expected) in [
        ("power", mean),
        ("amplitude", largest("amplitude")),
        ("force", largest("crushing_force")),
    ] {
        let found = table.numbers(name)[0];
        assert!(
            (found - expected).abs() < 1e-3 * expected,
            "{name}: {found}, {expected}"
        );
    }
}

/// The numbers of collisions and the work of crushing are those of single runs: from their events, and from the dissipation of their
/// contacts up to each time.
#[test]
fn the_layered_crusher_over_speed_is_the_crusher_at_each_speed() {
    let size = ["2", "0.4"];
    let folder = run("layered_crusher_over_speed", &size, "layered_crusher");
    let table = Table::read(&folder, "layered_crusher.csv");
    let simulate = |until: &str| -> serde_json::Value {
        let output = lagrangian(&[
            "simulate",
            "machines/contacts/layered_crusher.machine",
            "--set",
            "w=180",
            "--until",
            until,
            "--json",
        ]);
        serde_json::from_slice(&output.stdout).expect("a document")
    };
    let (half, whole) = (simulate("0.2"), simulate("0.4"));
    let events = whole["contact_events"].as_array().expect("events").iter();
    let impacts = events.filter(|event| {
        let t = event["t"].as_f64().expect("a time");
        event["contact"] == "outer" && event["kind"] == "impact" && t >= 0.2
    });
    let impacts = impacts.count() as f64 / 0.2;
    assert!(impacts > 0.0);
    assert_eq!(table.numbers("impacts")[1], impacts);
    let taken = |run: &serde_json::Value| -> f64 {
        let contacts = run["unilateral_contacts"].as_array().expect("contacts");
        let bed = contacts
            .iter()
            .find(|own| own["name"] == "bed")
            .expect("a bed");
        let parts = [
            "impact_loss",
            "friction_loss",
            "damping_loss",
            "crushing_work",
        ];
        parts
            .iter()
            .map(|part| bed[part].as_f64().expect("a number"))
            .sum()
    };
    let power = (taken(&whole) - taken(&half)) / 0.2;
    let found = table.numbers("crushing")[1];
    assert!((found - power).abs() < 1e-4 * power, "{found} {power}");
}
