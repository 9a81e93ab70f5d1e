//! Runs of machines whose program projects states onto the constraints by a function, compared with runs by the general method.

use crate::support::library;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::scalar::projection::ProjectionLayout;
use lagrangian::{Machine, Method, Simulation, System};
use lagrangian_mechanics::Compiled;
use lagrangian_program::Role;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

/// Machines of the library with the time for which they run.
const MACHINES: [(&str, f64); 5] = [
    ("andrews_squeezer", 0.01),
    ("chaplygin_sleigh", 2.0),
    ("closed_pendulum", 1.0),
    ("flyball_governor", 1.0),
    ("four_bar", 1.0),
];

/// A machine with the function and without it.
fn both(file: &str) -> [InterpretedMachine; 2] {
    let path = library::path(file);
    let (name, text) = Disk.read(&path, None).expect("the library is there");
    [true, false].map(|for_runs| {
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let (to, files) = (&mut sources, &mut Disk);
        let model = lagrangian_spec::model(&dag, &name, &text, &[], files, to, &mut report);
        let compiled = model.and_then(|model| {
            if for_runs {
                Compiled::for_runs(model, &mut report)
            } else {
                Compiled::new(model, &mut report)
            }
        });
        let compiled = compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        let has_function = compiled.program.function(Role::Projection).is_some();
        assert_eq!(has_function, for_runs, "{file}");
        InterpretedMachine::new(compiled.program)
    })
}

/// Both methods stop at residuals far below any tolerance. Their displacements differ by a part as large as the residual r before, which the tolerance
/// limits: `c r²` in each step, and the sum over some tens of steps, as the motion carries it on, is far below the tolerance.
#[test]
fn runs_end_where_those_by_the_general_method_do() {
    for (file, until) in MACHINES {
        let [with, without] = both(file);
        for method in [Method::DOP853, Method::DOPRI5] {
            for tolerance in [1e-4, 1e-7, 1e-10] {
                let ends = [&with, &without].map(|machine| {
                    let run = Simulation::new(machine).method(method).tolerance(tolerance);
                    let run = run.until(until).run(machine.start());
                    let run = run.unwrap_or_else(|error| panic!("{file}, {tolerance:e}: {error}"));
                    let residual = run.statistics().constraint_residual;
                    assert!(residual <= 1e-13, "{file}, {tolerance:e}: {residual:e}");
                    let end = run.end();
                    [end.q.values.clone(), end.v.values.clone()].concat()
                });
                for (one, other) in ends[0].iter().zip(&ends[1]) {
                    let bound = tolerance * (1.0 + one.abs()) + 1e-11 * (1.0 + one.abs());
                    let difference = (one - other).abs();
                    assert!(difference <= bound, "{file}, {tolerance:e}: {difference:e}");
                }
            }
        }
    }
}

/// Newton's method with these corrections converges quadratically to states that the functions of the constraints accept.
#[test]
fn corrections_remove_residuals_to_second_order() {
    for (file, _) in MACHINES {
        let [machine, _] = both(file);
        let system = machine.prepare();
        let start = machine.start();
        let (n, m) = (start.q.values.len(), system.constraints().len());
        let layout = ProjectionLayout {
            coordinates: n,
            constraints: m,
        };
        let mut numbers = vec![0.0; layout.len()];
        let (mut residuals, mut q, mut v) = (vec![0.0; m], start.q.values, start.v.values);
        let greatest = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // First onto the constraints, then away from them by two distances.
        let mut correct = |q: &mut Vec<f64>, v: &mut Vec<f64>| {
            assert_eq!(
                system.projection(0.0, q, v, &mut numbers),
                Ok(true),
                "{file}"
            );
            for (q, by) in q.iter_mut().zip(&numbers[layout.moves_of_coordinates()]) {
                *q += by;
            }
            system.constraint_positions(0.0, q, &mut residuals);
            let positions = greatest(&residuals);
            // The rates are corrected in the pose that has been reached.
            assert_eq!(
                system.projection(0.0, q, v, &mut numbers),
                Ok(true),
                "{file}"
            );
            for (v, by) in v.iter_mut().zip(&numbers[layout.moves_of_rates()]) {
                *v += by;
            }
            system.constraint_rates(0.0, q, v, &mut residuals);
            [positions, greatest(&residuals)]
        };
        for _ in 0..6 {
            correct(&mut q, &mut v);
        }
        let speed = 1.0 + greatest(&v);
        let left = [1e-3, 1e-5].map(|distance| {
            let (mut q, mut v) = (q.clone(), v.clone());
            for (j, q) in q.iter_mut().enumerate() {
                *q += distance * (j as f64 * 0.618 + 1.0).sin();
            }
            for (j, v) in v.iter_mut().enumerate() {
                *v += distance * speed * (j as f64 * 0.414 + 2.0).sin();
            }
            correct(&mut q, &mut v)
        });
        // A hundredth of the distance leaves a ten-thousandth of the residual, or rounding. Residuals of rates vanish at once.
        assert!(left[1][0] <= 1e-3 * left[0][0] + 1e-13, "{file}: {left:?}");
        for [_, rates] in left {
            assert!(rates <= 1e-12 * speed, "{file}: {rates:e}");
        }
    }
}
