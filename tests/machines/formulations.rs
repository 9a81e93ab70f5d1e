//! Formulations of the equations of a machine with constraints, compared: by Radau IIA methods in equal steps, whose ends are known from elsewhere.
//!
//! `cargo test --workspace --test machines formulations -- --nocapture` prints the table of `docs/benchmarks.md`.

mod collocation;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

use self::collocation::{Formulation, Problem, Radau};
use crate::support::known_runs::KnownRun;
use crate::support::library;
use crate::support::states::{numbers, state};
use lagrangian::{Machine, Method, Simulation, System};
use lagrangian_machines::{
    AndrewsSqueezer, ClosedPendulum, DoublePendulum, FourBar, ParticlePendulum,
};

/// A run whose end is known, coordinates and then rates.
struct Case<M> {
    name: &'static str,
    machine: M,
    start: Vec<f64>,
    end: Vec<f64>,
    until: f64,
}

/// Errors and counts of a run in equal steps.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    /// The errors of coordinates and rates relative to 1 + |y|, and of multipliers relative to the largest.
    errors: [f64; 3],
    evaluations: usize,
    projections: usize,
    residuals: [f64; 2],
    /// The change of the total energy, in J.
    energy: f64,
}

impl<M: Machine> Case<M> {
    fn run(&self, formulation: Formulation, stages: usize, steps: usize) -> Outcome {
        let system = self.machine.prepare();
        let problem = Problem::new(&system, formulation);
        let n = self.start.len() / 2;
        let (q, v) = self.start.split_at(n);
        let radau = Radau::with_stages(stages);
        let end = problem.run(&radau, [q, v], (self.until, steps));
        let energy = end.energy - problem.energy(0.0, q, v);
        let (q, v) = self.end.split_at(n);
        let multipliers = problem.multipliers(self.until, q, v);
        let largest = multipliers
            .iter()
            .fold(0.0, |most, x| f64::max(most, x.abs()));
        let error = |found: &[f64], exact: &[f64], size: &dyn Fn(f64) -> f64| {
            let pairs = found.iter().zip(exact);
            let errors = pairs.map(|(found, exact)| (found - exact).abs() / size(*exact));
            errors.fold(0.0, f64::max)
        };
        let relative = |exact: f64| 1.0 + exact.abs();
        Outcome {
            errors: [
                error(&end.q, q, &relative),
                error(&end.v, v, &relative),
                error(&end.multipliers, &multipliers, &|_| largest),
            ],
            evaluations: end.evaluations,
            projections: end.projections,
            residuals: end.residuals,
            energy: energy.abs(),
        }
    }

    /// Runs in `steps` and in twice as many steps, prints a row, and returns the orders that errors show and the outcome of the latter.
    fn row(&self, formulation: Formulation, stages: usize, steps: usize) -> ([f64; 3], Outcome) {
        let [coarse, fine] = [1, 2].map(|times| self.run(formulation, stages, times * steps));
        let orders = [0, 1, 2].map(|i| (coarse.errors[i] / fine.errors[i]).log2());
        let system = self.machine.prepare();
        let (n, m) = (system.coordinates().len(), system.constraints().len());
        let [q, v, multipliers] = fine.errors;
        let [position, rate] = fine.residuals;
        println!(
            "| {}, {stages} stages | {} | {:.1}, {:.1}, {:.1} | {q:.1e} | {v:.1e} | {multipliers:.1e} | {position:.0e} | {rate:.0e} | {:.1e} | {} | {} | {} |",
            self.name,
            formulation.name(),
            orders[0],
            orders[1],
            orders[2],
            fine.energy,
            fine.evaluations,
            fine.projections,
            formulation.unknowns(n, m)
        );
        (orders, fine)
    }
}

/// Two particles on rods for 1 s. The truth is the same pendulum in its two angles, by Taylor series at the limit of rounding: other coordinates, without
/// constraints, by another method.
fn particles() -> Case<ParticlePendulum> {
    let angles = DoublePendulum::default();
    let start = state(&angles, 0.0, &[2.0 * FRAC_PI_3, FRAC_PI_2], &[0.0; 2]);
    let run = Simulation::new(&angles)
        .method(Method::TAYLOR)
        .tolerance(1e-15)
        .until(1.0)
        .run(start)
        .expect("it swings");
    let end = numbers(run.system(), run.end());
    let [one, other] = [0, 1].map(|i| {
        let ((sin, cos), rate) = (end[i].sin_cos(), end[2 + i]);
        [sin, -cos, rate * cos, rate * sin]
    });
    let machine = ParticlePendulum::default();
    Case {
        name: "two particles on rods",
        start: numbers(&machine.prepare(), &machine.start()),
        end: vec![
            one[0],
            one[1],
            one[0] + other[0],
            one[1] + other[1],
            one[2],
            one[3],
            one[2] + other[2],
            one[3] + other[3],
        ],
        until: 1.0,
        machine,
    }
}

/// A run whose end is known to 30 digits.
fn known<M>(name: &'static str, reference: &str, machine: M) -> Case<M> {
    let known = KnownRun::named(reference);
    Case {
        name,
        machine,
        start: known.start,
        end: known.end.iter().map(|x| x.hi()).collect(),
        until: known.until,
    }
}

/// The orders of coordinates, rates and multipliers.
///
/// E. Hairer, C. Lubich, M. Roche, *The Numerical Solution of Differential-Algebraic Systems by Runge–Kutta Methods*, Lecture Notes in Mathematics 1409, 1989;
/// L. Jay, *Collocation methods for differential-algebraic equations of index 3*, Numer. Math. 65 (1993) 407–421. Where the multipliers are eliminated, the
/// equations are ordinary ones, and multipliers follow from the state.
fn orders(formulation: Formulation, stages: usize) -> [usize; 3] {
    let full = 2 * stages - 1;
    match formulation {
        Formulation::Index3 => [full, stages, stages - 1],
        Formulation::Index2 | Formulation::Stabilized => [full, full, stages],
        Formulation::Index1 | Formulation::Projected => [full; 3],
    }
}

#[test]
fn each_formulation_has_its_orders() {
    let case = particles();
    for stages in [2, 3] {
        for formulation in Formulation::ALL {
            let (found, _) = case.row(formulation, stages, 100);
            let exact = orders(formulation, stages);
            for (found, exact) in found.iter().zip(exact) {
                // A quarter, so that no other integer is as near.
                assert!(
                    (found - exact as f64).abs() < 0.25,
                    "{formulation:?}, {stages}: {found} and not {exact}"
                );
            }
        }
    }
}

/// In equal steps, and with no more evaluations, the projection after each step leaves smaller errors than stabilization by Gear, Leimkuhler and Gupta: in
/// coordinates, rates and multipliers.
fn projects_better<M: Machine>(case: &Case<M>, steps: usize) {
    let rows = Formulation::ALL.map(|formulation| case.row(formulation, 3, steps).1);
    let [_, _, stabilized, _, projected] = rows;
    assert!(
        projected.evaluations <= stabilized.evaluations,
        "{}: {projected:?}, {stabilized:?}",
        case.name
    );
    for (projected, stabilized) in projected.errors.iter().zip(stabilized.errors) {
        assert!(
            *projected <= stabilized,
            "{}: {projected:e}, {stabilized:e}",
            case.name
        );
    }
}

#[test]
fn projection_is_more_accurate_than_stabilization_in_equal_steps() {
    projects_better(&particles(), 100);
    let closed = ClosedPendulum::default();
    projects_better(
        &known("five links between pins", "closed_pendulum", closed),
        100,
    );
    let squeezer = AndrewsSqueezer::default();
    projects_better(
        &known("Andrews' squeezer", "andrews_squeezer", squeezer),
        200,
    );
    projects_better(
        &known("four-bar linkage", "four_bar", FourBar::default()),
        1000,
    );
}

/// A slider-crank on an elastic shaft, which is stiff: its damper of 1e4 N m s settles inertias of 0.01 to 0.05 kg m² in 1 to 5 µs, and steps are 2 ms long.
const SHAFT: &str = include_str!("formulations/shaft.machine");

/// Errors of a stiff machine fall to the order of the stages. The greatest of coordinates and rates, and those of multipliers, are smaller with projection. The
/// truth is Radau IIA with seven stages, at a tolerance of 1e-13.
#[test]
fn projection_is_as_accurate_where_a_machine_is_stiff() {
    let machine = library::machine(SHAFT);
    let until = 0.2;
    let run = Simulation::new(&machine)
        .method(Method::named("radau13").expect("a method"))
        .tolerance(1e-13)
        .until(until)
        .run(machine.start())
        .expect("it turns");
    let case = Case {
        name: "slider-crank on a stiff shaft",
        start: numbers(run.system(), run.start()),
        end: numbers(run.system(), run.end()),
        until,
        machine: machine.clone(),
    };
    let rows = Formulation::ALL.map(|formulation| case.row(formulation, 3, 50).1);
    let [_, _, stabilized, _, projected] = rows;
    let worst = |of: Outcome| f64::max(of.errors[0], of.errors[1]);
    assert!(
        worst(projected) <= worst(stabilized),
        "{projected:?}, {stabilized:?}"
    );
    assert!(projected.errors[2] <= stabilized.errors[2]);
}
