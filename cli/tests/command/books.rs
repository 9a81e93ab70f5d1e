//! The energy dissipated in contacts: each kind of loss is listed separately, and their sum is what the
//! energy balance says.

use serde_json::Value;

use crate::collisions::{close, is_good, number, simulate};
use crate::support::{Scratch, lagrangian};

/// A quantity of the contact with this name.
fn of_contact(run: &Value, contact: &str, what: &str) -> f64 {
    let contacts = run["unilateral_contacts"].as_array().expect("contacts");
    let own = contacts.iter().find(|own| own["name"] == contact);
    number(&own.unwrap_or_else(|| panic!("no {contact}: {run:#}"))[what])
}

/// Checks that the losses of all contacts add up to those of the energy balance, for machines without dampers
/// of their own.
fn is_booked(run: &Value, within: f64) {
    is_good(run);
    let contacts = run["unilateral_contacts"].as_array().expect("contacts");
    let sum = |what: &str| -> f64 {
        let own = contacts.iter().map(|own| own[what].as_f64());
        own.map(|own| own.unwrap_or(0.0)).sum()
    };
    for what in ["impact_loss", "friction_loss"] {
        close(sum(what), number(&run[what]), 1e-12 * (1.0 + sum(what)));
    }
    let crushing = run["crushing_work"].as_f64().unwrap_or(0.0);
    close(sum("crushing_work"), crushing, 1e-12 * (1.0 + crushing));
    let all = number(&run["impact_loss"])
        + number(&run["friction_loss"])
        + number(&run["damping_loss"])
        + crushing;
    close(all, number(&run["dissipated"]), within);
    close(number(&run["energy_residual"]), 0.0, within);
}

/// A ball that comes to rest has lost m g h in its impacts, and nothing else.
#[test]
fn impacts_take_what_a_ball_fell_from() {
    let run = simulate("machines/contacts/bouncing_ball.machine", 5.0, &[]);
    is_booked(&run, 1e-12);
    let lost = 0.1 * 9.81;
    close(of_contact(&run, "floor", "impact_loss"), lost, 1e-12);
    close(of_contact(&run, "floor", "friction_loss"), 0.0, 0.0);
    close(number(&run["damping_loss"]), 0.0, 1e-12);
}

/// A sphere that slips until it rolls has lost m v²/7 by friction. Before that, at t, the loss is μ m g (v t − 7/4
/// μ g t²).
#[test]
fn friction_takes_what_a_ball_loses_until_it_rolls() {
    let spec = "machines/contacts/bowling_ball.machine";
    let run = simulate(spec, 5.0, &[]);
    is_booked(&run, 1e-10);
    close(of_contact(&run, "lane", "friction_loss"), 64.0, 1e-10);
    let out = Scratch::new("ball.csv", "");
    let made = lagrangian(&[
        "simulate",
        spec,
        "--until",
        "2",
        "--every",
        "0.125",
        "--tolerance",
        "1e-12",
        "--out",
        out.path(),
    ]);
    assert!(made.status.success(), "{made:?}");
    let table = std::fs::read_to_string(out.path()).expect("a table");
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = header.iter().position(|name| *name == "lost(lane) [J]");
    let column = column.unwrap_or_else(|| panic!("{header:?}"));
    let rows: Vec<[f64; 2]> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            [cells[0], cells[column]].map(|cell| cell.parse().expect("a number"))
        })
        .collect();
    assert!(rows.len() > 12);
    for [t, lost] in rows {
        let truth = 0.1 * 7.0 * 9.81 * (8.0 * t - 1.75 * 0.1 * 9.81 * t * t);
        close(lost, truth, 1e-9);
    }
}

/// Rolling resistance dissipates ¾ m v², and friction nothing, if a disc does not slip.
#[test]
fn rolling_resistance_has_a_line_of_its_own() {
    let run = simulate("machines/contacts/rolling_out.machine", 5.0, &[]);
    is_booked(&run, 1e-10);
    close(
        of_contact(&run, "floor.rolling", "friction_loss"),
        1.5,
        1e-10,
    );
    close(of_contact(&run, "floor", "friction_loss"), 0.0, 1e-12);
}

/// The work of a shaken box on the ball in it is done by its walls.
#[test]
fn walls_that_move_do_their_work_through_contacts() {
    let run = simulate("machines/contacts/shaken_box.machine", 3.0, &[]);
    is_booked(&run, 1e-12);
    let by_walls = of_contact(&run, "left", "work") + of_contact(&run, "right", "work");
    assert!(by_walls.abs() > 1e-4);
    close(by_walls, number(&run["work"]), 1e-13);
}

/// A damped spring dissipates the difference of the kinetic energies before and after the contact, by its damper or by the
/// energy that it holds when the contact opens.
#[test]
fn damping_of_a_contact_takes_what_a_bounce_loses() {
    let spec = Scratch::new(
        "wall.machine",
        "machine Wall in plane {
            parameters { m: kg = 2, k: N/m = 800, b: N*s/m = 40 }
            coordinates { x: m = -1, der(x): m/s = 3 }
            bodies { block { mass: m, at: (x, 0) } }
            contacts { wall { gap: -x, compliance: linear(k, b) } }
        }",
    );
    let run = simulate(spec.path(), 1.0, &[]);
    is_booked(&run, 1e-10);
    let after = number(&run["v"]["x"]);
    close(
        of_contact(&run, "wall", "damping_loss"),
        9.0 - after * after,
        1e-10,
    );
}

/// The crusher with a layer: impacts of the shell, friction of both contacts, crushing, and the dampers of the suspension.
#[test]
fn a_crushers_energy_is_all_accounted_for() {
    let run = simulate("machines/contacts/layered_crusher.machine", 0.3, &[]);
    is_booked(&run, 1e-5);
    assert!(of_contact(&run, "bed", "crushing_work") > 10.0);
    assert!(of_contact(&run, "bed", "friction_loss") > 0.1);
    assert!(of_contact(&run, "outer", "impact_loss") > 1.0);
}

/// With time stepping, too, a block that slides to rest loses its energy by friction, not in impacts.
#[test]
fn friction_is_no_impact_in_time_stepping() {
    let spec = Scratch::new(
        "slide.machine",
        "machine Slide in plane {
            coordinates { x: m, y: m, der(x): m/s = 1 }
            bodies { block { mass: 2, at: (x, y) } }
            gravity (0, -10);
            contacts { floor { gap: y, slip: der(x), restitution: 0, friction: 0.5 } }
        }",
    );
    let output = lagrangian(&[
        "simulate",
        spec.path(),
        "--until",
        "1",
        "--method",
        "moreau",
        "--longest-step",
        "1e-3",
        "--json",
    ]);
    let text = String::from_utf8(output.stdout).expect("text");
    let run: Value = serde_json::from_str(&text).expect("a document");
    // Half of m v², except for the last step, in which it stops.
    close(of_contact(&run, "floor", "friction_loss"), 1.0, 2e-2);
    close(of_contact(&run, "floor", "impact_loss"), 0.0, 2e-2);
    close(number(&run["dissipated"]), 1.0, 1e-9);
}
