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

/// A point that hits the floor at the start, at (1, −1) m/s: with e = 1/2 and μ = 0.3 it leaves at (0.55, 0.5) m/s, so that
/// `1 − (0.55² + 0.5²)/2` J are lost from there on, also in a run that ends where it begins.
#[test]
fn an_impact_at_the_start_is_lost_from_there_on() {
    let spec = Scratch::new(
        "hit.machine",
        "machine Hit in plane {
            coordinates { x: m, y: m, der(x): m/s = 1, der(y): m/s = -1 }
            bodies { point { mass: 1, at: (x, y) } }
            gravity (0, -9.81);
            contacts { floor { gap: y, slip: der(x), restitution: 0.5, friction: 0.3 } }
        }",
    );
    let loss = 1.0 - 0.5 * (0.55 * 0.55 + 0.5 * 0.5);
    for until in [0.0, 0.01] {
        let run = simulate(spec.path(), until, &[]);
        is_booked(&run, 1e-14);
        close(of_contact(&run, "floor", "impact_loss"), loss, 1e-14);
        close(number(&run["dissipated"]), loss, 1e-14);
    }
    let rows = table(spec.path(), "0.01", "0.0025", "dop853");
    assert_eq!(rows.len(), 5);
    for [_, lost, all] in rows {
        close(lost + all, 1.0, 1e-14);
    }
}

/// What slides from the start has lost μ m g (v t − μ g t²/2) at t, also within the first step, and with
/// methods whose last stage is the end of a step.
#[test]
fn friction_takes_its_part_from_the_start_on() {
    let spec = Scratch::new(
        "slides.machine",
        "machine Slides in plane {
            coordinates { x: m, y: m, der(x): m/s = 3 }
            bodies { block { mass: 1, at: (x, y) } }
            gravity (0, -9.81);
            contacts { floor { gap: y, slip: der(x), restitution: 0, friction: 0.3 } }
        }",
    );
    let brake = 0.3 * 9.81;
    for (until, every, method) in [
        ("0.02", "0.002", "dop853"),
        ("1", "0.1", "radau5"),
        ("1", "0.1", "radau9"),
    ] {
        let rows = table(spec.path(), until, every, method);
        assert_eq!(rows.len(), 11);
        for [t, lost, all] in rows {
            close(lost, brake * (3.0 * t - 0.5 * brake * t * t), 1e-13);
            close(lost + all, 4.5, 1e-13);
        }
    }
}

/// For each row of a table, the time, what `floor` has taken, and the energy that is left.
fn table(spec: &str, until: &str, every: &str, method: &str) -> Vec<[f64; 3]> {
    let out = Scratch::new("table.csv", "");
    let made = lagrangian(&[
        "simulate",
        spec,
        "--until",
        until,
        "--every",
        every,
        "--method",
        method,
        "--out",
        out.path(),
    ]);
    assert!(made.status.success(), "{made:?}");
    let table = std::fs::read_to_string(out.path()).expect("a table");
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let columns = ["t [s]", "lost(floor) [J]", "total energy [J]"].map(|name| {
        let column = header.iter().position(|own| *own == name);
        column.unwrap_or_else(|| panic!("{header:?}"))
    });
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            columns.map(|column| cells[column].parse().expect("a number"))
        })
        .collect()
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
