//! Models against a second algorithm: the derivatives of the accelerations that the program itself computes in `f64`, by a
//! different elimination from that of the models.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod across;
mod contacts;

use std::path::Path;
use std::time::SystemTime;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Linearize, Machine, System};
use lagrangian_linear::model::{LinearModel, Observed, Request, about, along};
use lagrangian_linear::response::response;
use lagrangian_linear::search::{MOST_STEPS, Wanted};
use lagrangian_linear::steady;
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;
use nalgebra::{Complex, DMatrix};

/// A machine of the library.
fn machine(name: &str) -> InterpretedMachine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let path = path.join(format!("{name}.machine"));
    let text = std::fs::read_to_string(&path).expect("a spec");
    of(&path.to_string_lossy(), &text)
}

/// A machine of the library with other values of parameters.
fn machine_with(name: &str, set: &[(&str, f64)]) -> InterpretedMachine {
    let mut machine = machine(name);
    for (name, value) in set {
        machine.set(name, *value).expect("a parameter");
    }
    machine
}

fn of(name: &str, text: &str) -> InterpretedMachine {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(&dag, name, text, &[], &mut Disk, &mut sources, &mut report);
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    let compiled = compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    InterpretedMachine::new(compiled.program.clone())
}

/// Pseudorandom numbers between −1 and 1. The seed is new in every run, and printed where a test fails.
fn random() -> impl FnMut() -> f64 {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    let seed = std::env::var("LINEAR_SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let mut state: u64 = seed.unwrap_or(now.map_or(1, |now| now.as_nanos() as u64));
    println!("LINEAR_SEED={state}");
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// All inputs, and all coordinates as outputs.
fn everything(machine: &InterpretedMachine) -> Request {
    let n = machine.prepare().coordinates().len();
    Request {
        inputs: (0..machine.program().inputs.len()).collect(),
        outputs: (0..n).map(Observed::Coordinate).collect(),
    }
}

/// Derivatives of accelerations by coordinates and rates, with n rows.
fn slopes(machine: &InterpretedMachine, q: &[f64], v: &[f64]) -> DMatrix<f64> {
    let (system, n) = (machine.prepare(), q.len());
    let (mut a, mut by_q, mut by_v) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    let (q, v, u) = (q.to_vec(), v.to_vec(), system.default_inputs());
    let found = system.linearize(0.0, &q, &v, &u, &mut a, &mut by_q, &mut by_v);
    found.expect("a regular state");
    DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, _) => f64::from(u8::from(j == n + i)),
        (false, true) => by_q[(i - n) * n + j],
        (false, false) => by_v[(i - n) * n + j - n],
    })
}

/// The tolerance is some thousand roundings of the largest number: elimination in `f64` loses as many where masses
/// differ by a factor of a thousand.
fn assert_close(found: &DMatrix<f64>, exact: &DMatrix<f64>, name: &str) {
    let size = exact.amax().max(found.amax());
    let off = (found - exact).amax();
    assert!(
        off <= 1e4 * f64::EPSILON * size,
        "{name}: off by {off:e} of {size:e}"
    );
}

#[test]
fn models_at_random_states_have_the_derivatives_of_the_program() {
    let mut next = random();
    for name in [
        "cart_pole",
        "double_pendulum",
        "heavy_top",
        "two_joint_arm",
        "spring_mass_train",
        "elastic_pendulum",
    ] {
        let machine = machine(name);
        let start = machine.start();
        let q: Vec<f64> = start.q.values.iter().map(|q| q + 0.1 * next()).collect();
        let v: Vec<f64> = start.v.values.iter().map(|v| v + next()).collect();
        let model = about(&machine, (0.0, &q, &v), &everything(&machine));
        let model = model.unwrap_or_else(|none| panic!("{name}: {none:?}"));
        assert_close(&model.a, &slopes(&machine, &q, &v), name);
        // Accelerations are affine in the inputs of these machines.
        let (system, n) = (machine.prepare(), q.len());
        let accelerations = |input: Option<usize>| {
            let (mut u, mut a) = (system.default_inputs(), vec![0.0; n]);
            if let Some(input) = input {
                u.values[input] += 1.0;
            }
            let found = system.accelerations(0.0, &q, &v, &u, &mut a);
            found.expect("a regular state");
            a
        };
        let (still, size) = (accelerations(None), model.b.amax().max(1.0));
        for j in 0..model.b.ncols() {
            let pushed = accelerations(Some(j));
            for (i, (pushed, still)) in pushed.iter().zip(&still).enumerate() {
                let size = size.max(pushed.abs());
                let off = (model.b[(n + i, j)] - (pushed - still)).abs();
                assert!(off <= 1e4 * f64::EPSILON * size, "{name}: {off:e}");
                assert_eq!(model.b[(i, j)], 0.0);
            }
        }
        for (k, x) in model.drift.iter().enumerate() {
            let exact = if k < n { v[k] } else { still[k - n] };
            let size = still.iter().fold(1.0, |size: f64, a| size.max(a.abs()));
            assert!(
                (x - exact).abs() <= 1e4 * f64::EPSILON * size,
                "{name}: {x}, not {exact}"
            );
        }
    }
}

/// At an equilibrium of a machine with constraints, `J basis = basis A` with the derivatives J of its accelerations.
#[test]
fn independent_directions_stay_on_the_constraints() {
    for name in ["four_bar", "slider_crank", "particle_pendulum"] {
        let machine = machine(name);
        let q = machine.start().q.values;
        let n = q.len();
        let wanted = Wanted {
            steady: vec![false; n],
            solved: vec![false; n],
            rates: vec![0.0; n],
            steps: MOST_STEPS,
        };
        let motion = steady::motion(&machine, &q, &wanted);
        let motion = motion.unwrap_or_else(|_| panic!("{name} has no equilibrium"));
        let model = along(&machine, &motion, &everything(&machine));
        let model = model.unwrap_or_else(|none| panic!("{name}: {none:?}"));
        assert!(model.is_reduced && model.a.nrows() < 2 * n);
        let whole = slopes(&machine, &model.q, &model.v);
        assert_close(&(&model.basis * &model.a), &(whole * &model.basis), name);
        // With all coordinates as outputs, C is the upper half of the basis.
        assert_eq!(model.c, model.basis.rows(0, n).into_owned());
    }
}

/// The response of the oscillator, 1/(m (iω)² + c iω + k), and that of its acceleration.
#[test]
fn frequency_responses_are_those_of_the_textbook() {
    let text = "machine Oscillator in plane {
        parameters { m: kg = 2, k: N/m = 4, c: N*s/m = 1 }
        coordinates { x: m }
        inputs { push: N = 0 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        dampers { damper { damping: c, stretch: x } }
        forces { push { on: x, value: push } }
    }";
    let machine = of("oscillator", text);
    let request = Request {
        inputs: vec![0],
        outputs: vec![Observed::Coordinate(0), Observed::Acceleration(0)],
    };
    let model: LinearModel = about(&machine, (0.0, &[0.0], &[0.0]), &request).expect("a model");
    for omega in [0.0, 1e-3, 1.0, 2.0_f64.sqrt(), 40.0, 1e6] {
        let s = Complex::new(0.0, omega);
        let exact = Complex::new(1.0, 0.0) / (s * s * 2.0 + s + 4.0);
        let found = response(&model, omega).expect("no pole");
        assert!((found[(0, 0)] - exact).norm() <= 1e-14 * exact.norm());
        // Far above the resonance the response is a small difference from D = 1/m.
        assert!(
            (found[(1, 0)] - s * s * exact).norm() <= 1e-14 * 0.5_f64.max((s * s * exact).norm())
        );
    }
}
