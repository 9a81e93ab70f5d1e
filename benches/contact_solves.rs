//! Contact problems solved per second: the forces of all contacts of a pile at one instant, with the residual of each solution.
//!
//! ```text
//! cargo bench --bench contact_solves
//! ```
//!
//! The piles are a column of discs without friction, whose normal forces are the weights above; a leaning tower of blocks with Coulomb
//! friction, each with two corners on the block below; and the same in space, with four corners and friction cones. Towers can share their
//! loads in several ways. The residual is computed here from accelerations and forces alone. For the equations of motion it is relative to the
//! weight; for each condition of each contact, forces are relative to the weight and accelerations to that of gravity.

mod timing;

use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem};
use lagrangian::{At, Machine, System, UnilateralForce, unilateral_forces};
use timing::median_of;

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.5;

fn main() {
    println!("| contacts | n | time of a problem | problems a second | residual |");
    println!("| --- | --: | --: | --: | --: |");
    for n in [1, 2, 5, 10, 20, 50, 100] {
        row("frictionless, a column of discs", n, &column(n));
    }
    for n in [2, 4, 10, 20, 50, 100] {
        row("Coulomb in the plane, a tower", n, &tower_in_plane(n / 2));
    }
    for n in [4, 8, 20, 40, 100] {
        row("cones in space, a tower", n, &tower_in_space(n / 4));
    }
}

/// Discs of radius 1 stacked on each other.
fn column(n: usize) -> String {
    let mut pairs = String::new();
    for k in 1..n {
        let _ = write!(
            pairs,
            "pair{k} {{ circle: rim[{}], outside: rim[{k}], restitution: 0 }}, ",
            k + 1
        ); // cannot fail
    }
    format!(
        "machine Column in plane {{
            constants {{ N = {n} }}
            coordinates {{ y[i in 1..N]: m = 2*i - 1 }}
            bodies {{ disc[i in 1..N] {{ mass: 1, at: (0, y[i]) }} }}
            circles {{ rim[i in 1..N] {{ on: disc[i], center: (0, 0), radius: 1 }} }}
            gravity (0, -{GRAVITY});
            contacts {{ floor {{ circle: rim[1], along: ground, restitution: 0 }}, {pairs} }}
        }}"
    )
}

/// Blocks of 1 m by 2 cm stacked on ground that slopes down at 0.1 rad.
fn tower_in_plane(blocks: usize) -> String {
    let corners = "corners: ((-0.5, -0.01), (0.5, -0.01))";
    let law = format!("restitution: 0, friction: {FRICTION}");
    let mut seats = String::new();
    for k in 1..blocks {
        let _ = write!(
            seats,
            "seat{k} {{ {corners}, on: held[{}], along: top[{k}], {law} }}, ",
            k + 1
        ); // cannot fail
    }
    format!(
        "machine Tower in plane {{
            constants {{ N = {blocks} }}
            coordinates {{ x[i in 1..N]: m, y[i in 1..N]: m = (2*i - 1)/100, theta[i in 1..N]: rad }}
            frames {{ held[i in 1..N] = ground.shift(x[i], y[i]).turn(theta[i]), top[i in 1..N] = held[i].shift(0, 0.01) }}
            bodies {{ block[i in 1..N] {{ mass: 1, inertia: 1.0004/12, frame: held[i] }} }}
            gravity ({GRAVITY}*sin(0.1), -{GRAVITY}*cos(0.1));
            contacts {{ floor {{ {corners}, on: held[1], along: ground, {law} }}, {seats} }}
        }}"
    )
}

/// Square blocks stacked on ground that slopes down at 0.1 rad, in a direction between their sides.
fn tower_in_space(blocks: usize) -> String {
    let corners =
        "corners: ((-0.5, -0.5, -0.01), (0.5, -0.5, -0.01), (0.5, 0.5, -0.01), (-0.5, 0.5, -0.01))";
    let law = format!("restitution: 0, friction: {FRICTION}");
    let mut seats = String::new();
    for k in 1..blocks {
        let _ = write!(
            seats,
            "seat{k} {{ {corners}, on: held[{}], along: top[{k}], {law} }}, ",
            k + 1
        ); // cannot fail
    }
    format!(
        "machine Tower in space {{
            constants {{ N = {blocks} }}
            coordinates {{
                x[i in 1..N]: m, y[i in 1..N]: m, z[i in 1..N]: m = (2*i - 1)/100, a[i in 1..N]: rad, b[i in 1..N]: rad, c[i in 1..N]: rad,
            }}
            frames {{
                held[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(x, a[i]).turn(y, b[i]).turn(z, c[i]),
                top[i in 1..N] = held[i].shift(0, 0, 0.01),
            }}
            bodies {{ block[i in 1..N] {{ mass: 1, inertia: (1.0004/12, 1.0004/12, 1/6), frame: held[i] }} }}
            gravity ({GRAVITY}*sin(0.1)*0.8, {GRAVITY}*sin(0.1)*0.6, -{GRAVITY}*cos(0.1));
            contacts {{ floor {{ {corners}, on: held[1], along: ground, {law} }}, {seats} }}
        }}"
    )
}

fn row(what: &str, n: usize, text: &str) {
    let machine = match InterpretedMachine::from_text(text).build() {
        Ok(machine) => machine,
        Err(error) => panic!("{error}"),
    };
    let (system, start) = (machine.prepare(), machine.start());
    let inputs = system.default_inputs();
    let at = At {
        t: 0.0,
        q: &start.q.values,
        v: &start.v.values,
        u: &inputs,
    };
    let mut a = vec![0.0; start.q.values.len()];
    let (time, solved) = median_of(5, || unilateral_forces(&system, at, &mut a));
    match solved {
        Ok(forces) => {
            let touching = system.unilateral_contacts().zip(&forces);
            let touching =
                touching.filter(|(contact, force)| !contact.is_second_tangent && force.closed);
            let missed = residual(&system, &start.q.values, &a, &forces);
            let few = match touching.count() {
                closed if closed == n => String::new(),
                closed => format!(" ({closed} stay closed)"),
            };
            println!(
                "| {what} | {n}{few} | {:.3} ms | {:.0} | {missed:.0e} |",
                1e3 * time,
                1.0 / time
            );
        }
        Err(error) => println!("| {what} | {n} | {:.3} ms | none: {error} | |", 1e3 * time),
    }
}

/// The largest violation of the equations of motion or of a contact condition, at rest.
fn residual(
    system: &InterpretedSystem,
    q: &Vec<f64>,
    a: &[f64],
    forces: &[UnilateralForce],
) -> f64 {
    let n = q.len();
    let still = vec![0.0; n];
    let mut rows = vec![0.0; 2 * forces.len() * n];
    system.contact_matrix(0.0, q, &mut rows);
    let rows: Vec<&[f64]> = rows.chunks(n).collect();
    let dot = |row: &[f64]| row.iter().zip(a).map(|(w, a)| w * a).sum::<f64>();
    let mut mass = vec![0.0; n * n];
    system.mass_matrix(0.0, q, &mut mass);
    let mut missing = vec![0.0; n];
    system.forces(0.0, q, &still, &system.default_inputs(), &mut missing);
    // The sum of all forces of gravity, along the vertical and the slope.
    let weight: f64 = missing.iter().map(|force| force.abs()).sum();
    let is_across: Vec<bool> = system
        .unilateral_contacts()
        .map(|contact| contact.is_second_tangent)
        .collect();
    for (k, force) in forces.iter().enumerate() {
        let normal = if is_across[k] { 0.0 } else { force.normal };
        for i in 0..n {
            missing[i] += rows[2 * k][i] * normal + rows[2 * k + 1][i] * force.friction;
        }
    }
    for (i, missing) in missing.iter_mut().enumerate() {
        *missing -= dot(&mass[i * n..][..n]);
    }
    let mut worst = missing
        .iter()
        .fold(0.0_f64, |worst, x| worst.max(x.abs() / weight));
    for (k, force) in forces.iter().enumerate() {
        if is_across[k] {
            continue;
        }
        let (normal, opening) = (force.normal / weight, dot(rows[2 * k]) / GRAVITY);
        // One of the two is 0 and the other positive, so the smaller one is the error in either case.
        worst = worst.max(normal.min(opening).abs());
        let pair = [
            Some(k),
            (k + 1 < forces.len() && is_across[k + 1]).then_some(k + 1),
        ];
        let rubs = system
            .unilateral_contacts()
            .nth(k)
            .is_some_and(|contact| contact.has_friction);
        let friction = if rubs { FRICTION } else { 0.0 };
        let of_each = |of: &dyn Fn(usize) -> f64| pair.map(|k| k.map_or(0.0, of));
        let rubbing = of_each(&|k| forces[k].friction / weight);
        let sliding = of_each(&|k| {
            if rubs {
                dot(rows[2 * k + 1]) / GRAVITY
            } else {
                0.0
            }
        });
        // Friction minus the acceleration of the slip, projected onto the friction disc, must give the friction itself.
        let wanted = [0, 1].map(|i| rubbing[i] - sliding[i]);
        let (radius, length) = (friction * normal.max(0.0), wanted[0].hypot(wanted[1]));
        let share = if length > radius {
            radius / length
        } else {
            1.0
        };
        for (wanted, rubbing) in wanted.iter().zip(rubbing) {
            worst = worst.max((share * wanted - rubbing).abs());
        }
    }
    worst
}
