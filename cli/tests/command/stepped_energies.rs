//! Energies in time stepping, against closed forms, and against runs that find every event.

use serde_json::Value;

use crate::collisions::{close, events, number, simulate};
use crate::support::Scratch;
use crate::time_stepping::step;

const G: f64 = 9.81;

/// A ball that bounces alone moves as it does by the closed form, however long the steps are: forces are constant, and the instants of its impacts are known in the steps.
#[test]
fn a_ball_that_bounces_alone_moves_as_by_the_closed_form() {
    let (e, until) = (0.8, 2.7);
    let fall = (2.0 / G).sqrt();
    let (mut t, mut speed) = (fall, e * G * fall);
    while t + 2.0 * speed / G < until {
        t += 2.0 * speed / G;
        speed *= e;
    }
    let left = until - t;
    let height = speed * left - 0.5 * G * left * left;
    for h in [0.03, 7e-3, 1e-3] {
        let run = step("machines/contacts/bouncing_ball.machine", until, h, &[]);
        assert!(events(&run, "impact").len() >= 4, "{run:#}");
        // Each step adds a rounding of each term, and each of some impacts what rounding makes of its instant.
        let within = 64.0 * f64::EPSILON * (until / h + 100.0);
        close(number(&run["q"]["y"]), height, within);
        close(number(&run["v"]["y"]), speed - G * left, 10.0 * within);
    }
}

/// Numbers between −1 and 1 that look drawn at random.
fn drawn(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The half edges of the box and its mass.
const A: f64 = 0.1;
const C: f64 = 0.06;
const M: f64 = 1.0;

fn box_on_floor(law: &str) -> String {
    format!(
        "machine Box in plane {{
            parameters {{ m: kg = {M:?}, a: m = {A:?}, c: m = {C:?}, e: 1 = 0.8, mu: 1 = 0.3, g: m/s^2 = {G} }}
            coordinates {{ x: m, y: m = 0.2, phi: rad = 0.3 }}
            frames {{ held = ground.shift(x, y).turn(phi) }}
            bodies {{ box {{ mass: m, inertia: m/3*(a^2 + c^2), frame: held }} }}
            gravity (0, -g);
            contacts {{ floor {{ corners: ((a, -c), (-a, -c), (a, c), (-a, c)), on: held, along: ground, restitution: e, friction: mu, {law} }} }}
        }}"
    )
}

/// The energies in the rows of a table of a box.
fn energies(table: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(table).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let column = |name: &str| {
        let found = names.iter().position(|known| known.starts_with(name));
        found.unwrap_or_else(|| panic!("no {name} in {names:?}"))
    };
    let column = column("total energy");
    let energy = |line: &str| {
        let own = line.split(',').nth(column).expect("a cell");
        own.parse().expect("a number")
    };
    lines.map(energy).collect()
}

/// A box that is thrown on a floor bounces ever lower on its corners and comes to rest, by every law of impact and for every friction. Its energy does not grow from step to step but by what
/// rounding makes of the second order of a step: within a step a corner that falls back to the floor, or whose slip ends, has a rate up to `g h` of its own, and with it the energy `m (g h)²/2`.
/// `SEED` begins the random numbers.
#[test]
fn boxes_that_bounce_come_to_rest_and_gain_no_energy() {
    let of_environment = std::env::var("SEED")
        .ok()
        .and_then(|text| text.parse().ok());
    let mut seed: u64 = of_environment.unwrap_or(0x2545_f491_4f6c_dd1d);
    println!("SEED={seed}");
    let table = Scratch::new("box.csv", "");
    for law in [
        "law: newton",
        "law: stronge",
        "law: poisson",
        "law: poisson_glocker",
    ] {
        let spec = Scratch::new("box.machine", &box_on_floor(law));
        for mu in [0.0, 0.1, 0.3, 0.8] {
            let h = 2e-3;
            let mut draw = |scale: f64| scale * drawn(&mut seed);
            let start = [
                ("--start", format!("y={:?}", 0.2 + draw(0.07))),
                ("--start", format!("phi={:?}", draw(1.5))),
                ("--rate", format!("x={:?}", draw(1.0))),
                ("--rate", format!("y={:?}", draw(1.0))),
                ("--rate", format!("phi={:?}", draw(6.0))),
            ];
            let (every, friction) = (format!("{h:?}"), format!("mu={mu:?}"));
            let mut more = vec!["--set", &friction, "--every", &every, "--out", table.path()];
            more.extend(start.iter().flat_map(|(name, value)| [*name, value]));
            let run = step(spec.path(), 6.0, h, &more);
            assert_eq!(
                run["warnings"].as_array().map(Vec::len),
                Some(0),
                "{law} {start:?}: {run:#}"
            );
            for (name, rate) in run["v"].as_object().expect("rates") {
                let slides = mu == 0.0 && name == "x";
                assert!(
                    slides || number(rate).abs() <= 1e-9,
                    "{law} {mu} {start:?}: der({name}) = {rate}"
                );
            }
            let mut least = f64::INFINITY;
            for energy in energies(table.path()) {
                let gained = energy - least;
                let most = 0.5 * M * (G * h).powi(2);
                assert!(
                    gained <= most,
                    "{law} {mu} {start:?}: {gained:e} of {most:e}"
                );
                least = least.min(energy);
            }
        }
    }
}

/// A box that falls onto one of its corners and rocks comes to rest when it does so by events. It has some 30 impacts before its bounces are shorter than a step. Each is up to half a step off, and its rate by
/// `g h/2`, which makes the bounces that follow longer by `h/(1 − e)`.
#[test]
fn a_box_comes_to_rest_as_by_events() {
    let spec = Scratch::new("box.machine", &box_on_floor("law: newton"));
    let exact = simulate(spec.path(), 4.0, &[]);
    let events = exact["contact_events"].as_array().expect("events");
    let until = number(&events.last().expect("an event")["t"]);
    for h in [1e-3, 2.5e-4] {
        let within = 30.0 * h / (1.0 - 0.8);
        let fastest = |run: &Value| {
            let rates = ["x", "y", "phi"].map(|name| number(&run["v"][name]).abs());
            rates.into_iter().fold(0.0, f64::max)
        };
        let rests = step(spec.path(), until + within, h, &[]);
        close(fastest(&rests), 0.0, 1e-9);
        let moves = step(spec.path(), until - within, h, &[]);
        assert!(fastest(&moves) > 1e-6, "{moves:#}");
    }
}
