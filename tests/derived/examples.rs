//! Every example runs and gives the right answer.
//!
//! The examples are modules of this one program, which saves linking each of them separately.

#[path = "../../examples/balance.rs"]
mod balance;
#[path = "../../examples/bounce.rs"]
mod bounce;
#[path = "../../examples/computed_torque.rs"]
mod computed_torque;
#[path = "../../examples/digits.rs"]
mod digits;
#[path = "../../examples/drag.rs"]
mod drag;
#[path = "../../examples/edited_spec.rs"]
mod edited_spec;
#[path = "../../examples/energy.rs"]
mod energy;
#[path = "../../examples/ensemble.rs"]
mod ensemble;
#[path = "../../examples/fit.rs"]
mod fit;
#[path = "../../examples/generic.rs"]
mod generic;
#[path = "../../examples/isolation.rs"]
mod isolation;
#[path = "../../examples/lqr.rs"]
mod lqr;
#[path = "../../examples/microcontroller.rs"]
mod microcontroller;
#[path = "../../examples/numbers.rs"]
mod numbers;
#[path = "../../examples/own_method.rs"]
mod own_method;
#[path = "../../examples/pendulum.rs"]
mod pendulum;
#[path = "../../examples/realtime.rs"]
mod realtime;
#[path = "../../examples/single_steps.rs"]
mod single_steps;
#[path = "../../examples/sweep.rs"]
mod sweep;
#[path = "../../examples/variants.rs"]
mod variants;

/// A bound on the error of a run of fewer than `STEPS` steps, each within `tolerance`, in
/// motions that do not amplify errors.
fn limit(tolerance: f64) -> f64 {
    const STEPS: f64 = 1000.0;
    STEPS * tolerance
}

#[test]
fn every_example_is_here() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    for entry in std::fs::read_dir(folder).expect("the examples") {
        let entry = entry.expect("an entry");
        let name = entry.file_name();
        let name = name.to_str().expect("plain names");
        // The rest are the manifest and scripts of commands, which the tests of the command run.
        let Some(example) = name.strip_suffix(".rs") else {
            continue;
        };
        let line = format!("#[path = \"../../examples/{name}\"]");
        assert!(include_str!("examples.rs").contains(&line), "{name}");
        let row = format!("name = \"{example}\"\npath = \"{name}\"\n");
        assert!(
            include_str!("../../examples/Cargo.toml").contains(&row),
            "{name}"
        );
    }
}

/// A useful program takes fewer than sixty lines.
#[test]
fn programs_of_some_use_are_short() {
    for name in [
        "drag",
        "edited_spec",
        "fit",
        "generic",
        "lqr",
        "microcontroller",
        "own_method",
        "realtime",
        "sweep",
    ] {
        let path = format!("{}/../examples/{name}.rs", env!("CARGO_MANIFEST_DIR"));
        let lines = std::fs::read_to_string(path)
            .expect("it is text")
            .lines()
            .count();
        assert!(lines < 60, "{name}: {lines}");
    }
}

#[test]
fn the_period_grows_with_the_amplitude() {
    pendulum::main().unwrap();
    for amplitude in [0.01, 1.0, 3.0] {
        let [simulated, exact] = pendulum::period(amplitude).unwrap();
        // At the bottom the angular velocity is √(2 g/l (1 − cos θ₀)), 0.04 rad/s for the smallest swing.
        let off = limit(1e-12) / (0.044 * f64::min(amplitude, 1.0) / 0.01);
        assert!((simulated - exact).abs() < off, "{simulated} {exact}");
    }
}

#[test]
fn the_controller_balances_the_pole() {
    balance::main().unwrap();
    let [x, theta] = *balance::balance(0.2).unwrap().last().unwrap();
    assert!(x.abs() < 0.05 && theta.abs() < 0.01, "{x} {theta}");
}

#[test]
fn a_floor_is_transmitted_as_in_the_textbook() {
    isolation::main().unwrap();
    for damping in [200.0, 1600.0] {
        let [simulated, exact] = isolation::transmitted(damping).unwrap();
        // In units of the amplitude of the floor, 1 mm.
        assert!((simulated - exact).abs() < limit(1e-12) / 1e-3);
    }
}

#[test]
fn flights_shrink_by_the_restitution() {
    bounce::main().unwrap();
    let times = bounce::bounces(0.5, 3).unwrap();
    let fall = f64::sqrt(2.0 / 9.81);
    for (time, falls) in times.into_iter().zip([1.0, 2.0, 2.5]) {
        // Velocities are of the order of 1 m/s.
        assert!((time - falls * fall).abs() < limit(1e-12), "{time}");
    }
}

#[test]
fn the_arm_follows_the_law() {
    computed_torque::main().unwrap();
    for t in [0.7, 1.5] {
        let exact = (1.0 + 4.0 * t) * f64::exp(-4.0 * t);
        for left in computed_torque::left(t).unwrap() {
            assert!((left - exact).abs() < limit(1e-11), "{left} {exact}");
        }
    }
}

#[test]
fn the_balance_of_energy_closes() {
    energy::main().unwrap();
    for tolerance in [1e-7, 1e-10] {
        let (balance, exact) = energy::balance(tolerance).unwrap();
        assert!(exact > 10.0, "it works: {exact} J");
        // Energies and works are of the order of 10 J; a position error changes them by less than 100 J per metre.
        assert!(balance.residual().abs() < 100.0 * limit(tolerance));
        assert!((balance.work - exact).abs() < 100.0 * limit(tolerance));
    }
}

#[test]
fn each_number_is_as_exact_as_it_is() {
    numbers::main().unwrap();
    let machine = numbers::Pendulum::default();
    // −19.5 sin 1, from the sine's series in sixty digits: the nearest f64 and the remainder.
    let (near, rest) = (-16.408_684_203_753_98, -1.456_707_817_747_586e-16);
    let a = numbers::acceleration(machine).unwrap();
    assert!((a - near).abs() <= 4.0 * f64::EPSILON * near.abs());
    let single = numbers::acceleration(machine.map(|x| x as f32)).unwrap();
    assert!((f64::from(single) - near).abs() <= 4.0 * f64::from(f32::EPSILON) * near.abs());
    let wide = machine.map(lagrangian::Scalar::from_f64);
    let wide: lagrangian::scalar::DoubleDouble = numbers::acceleration(wide).unwrap();
    let off = (wide.hi() - near) + (wide.lo() - rest);
    assert!(
        off.abs() < 16.0 * f64::EPSILON.powi(2) * near.abs(),
        "{off:e}"
    );
    // a is proportional to 1/l.
    let slope = numbers::by_length().unwrap().derivative;
    assert!((slope + near / 0.5).abs() <= 8.0 * f64::EPSILON * slope.abs());
}

#[test]
fn a_motion_is_as_exact_as_its_numbers() {
    use lagrangian::scalar::{DoubleDouble, Dual, Scalar};
    digits::main().unwrap();
    let machine = digits::Oscillator::default();
    let exact = DoubleDouble::from_f64(20.0).cos();
    let (x, _) = digits::at(&machine, 10.0).unwrap();
    assert!((x - exact.hi()).abs() < limit(1e-9));
    let (x, _) = digits::at(&machine.map(|x| x as f32), 10.0).unwrap();
    assert!((f64::from(x) - exact.hi()).abs() < limit(1e-5));
    let ten = DoubleDouble::from_f64(10.0);
    let (x, steps) = digits::at(&machine.map(DoubleDouble::from_f64), ten).unwrap();
    assert!((x - exact).to_f64().abs() < steps as f64 * 2e-24);
    // ∂x/∂k = −t sin ωt /(2 m ω)
    let mut varied = machine.map(Dual::constant);
    varied.k = Dual::variable(machine.k);
    let (x, _) = digits::at(&varied, Dual::constant(10.0)).unwrap();
    assert!((x.derivative + 10.0 * 20.0_f64.sin() / 8.0).abs() < 10.0 * limit(1e-9));
}

#[test]
fn an_ensemble_finds_what_goes_over_the_top() {
    ensemble::main();
    // From ½ l² ω² = 2 g l: the bob just reaches the top at rest.
    let exact = 2.0 * (9.81_f64 / 0.5).sqrt();
    let found = ensemble::least_rates(&[0.5], 0.05)[0];
    assert!(
        found > exact && found - exact <= 0.05 + 1e-9,
        "{found} after {exact}"
    );
}

#[test]
fn single_steps_follow_the_cosine() {
    single_steps::main().unwrap();
    let mut seen = 0;
    let steps = single_steps::steps(2.0, |t, x| {
        assert!((x - t.cos()).abs() < limit(1e-10));
        seen += 1;
    });
    assert_eq!(seen, 21);
    assert!(steps.unwrap() < 1000);
}

#[test]
fn a_spec_runs_without_a_compiler() {
    variants::main().unwrap();
    let file = crate::support::library::path("cushioned_crusher");
    let mut crusher = lagrangian::interpreted::InterpretedMachine::from_file(file).unwrap();
    // The same spec compiled performs the same operations in the same order.
    let machine = lagrangian_machines::CushionedCrusher {
        omega: 110.0,
        ..Default::default()
    };
    let run = lagrangian::Simulation::new(&machine).until(1.0).every(1e-3);
    let run = run.run(machine.start()).unwrap();
    let mut greatest: f64 = 0.0;
    for state in run.samples() {
        greatest = greatest.max(run.observe_state(state).unwrap().outputs.crushing_force);
    }
    crusher.set("omega", 110.0).unwrap();
    assert_eq!(variants::greatest_force(&crusher).unwrap(), greatest);
}

#[test]
fn the_regulator_is_that_of_riccati_and_balances() {
    lqr::main().unwrap();
    let k = lqr::gain().unwrap();
    // At the optimum, no change of a gain lowers the cost of the linearized motion from this start, which `cost` computes.
    let machine = lqr::Balancer::default();
    let g = machine.g;
    // At rest upright, M x″ = u − m g θ and l θ″ = −(u − (M + m) g θ)/M.
    let (a_x, a_theta) = (
        -machine.m * g / machine.M,
        (machine.M + machine.m) * g / (machine.M * machine.l),
    );
    let (b_x, b_theta) = (1.0 / machine.M, -1.0 / (machine.M * machine.l));
    let cost = |k: [f64; 4]| {
        let (mut x, mut sum) = ([0.3, 0.1, 0.0, 0.0], 0.0);
        for _ in 0..4000 {
            let u = -(0..4).map(|i| k[i] * x[i]).sum::<f64>();
            sum += 10.0 * x[0] * x[0] + 10.0 * x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + u * u;
            // One sampling period later, by a hundred steps of the midpoint rule.
            const PARTS: usize = 100;
            let h = 0.02 / PARTS as f64;
            for _ in 0..PARTS {
                let rates = |x: [f64; 4]| {
                    [
                        x[2],
                        x[3],
                        a_x * x[1] + b_x * u,
                        a_theta * x[1] + b_theta * u,
                    ]
                };
                let middle: [f64; 4] = core::array::from_fn(|i| x[i] + 0.5 * h * rates(x)[i]);
                x = core::array::from_fn(|i| x[i] + h * rates(middle)[i]);
            }
        }
        sum
    };
    let best = cost(k);
    assert!(best.is_finite());
    for i in 0..4 {
        for by in [0.97, 1.03] {
            let mut other = k;
            other[i] *= by;
            assert!(cost(other) > best, "{i} {by}: {} {best}", cost(other));
        }
    }
    let [x, theta] = lqr::balanced(10.0).unwrap();
    assert!(x.abs() < 1e-2 && theta.abs() < 1e-2, "{x} {theta}");
}

#[test]
fn the_farthest_throw_without_drag_is_at_half_a_right_angle() {
    sweep::main().unwrap();
    let mut ball = sweep::Ball::default();
    let (with_drag, _) = sweep::best(&ball, 89).unwrap();
    ball.drag = 0.0;
    let (angle, range) = sweep::best(&ball, 89).unwrap();
    assert!((angle.to_degrees() - 45.0).abs() < 1e-9 && with_drag < angle);
    // v²/g
    assert!((range - 900.0 / 9.81).abs() < 1e-6);
}

#[test]
fn a_loop_in_real_time_is_a_run() {
    realtime::main().unwrap();
    let mut last = None;
    realtime::ticks(500, |state, _| last = Some(*state)).unwrap();
    let machine = lagrangian_machines::DoublePendulum::default();
    let run = lagrangian::Simulation::new(&machine)
        .tolerance(1e-12)
        .until(0.5);
    let run = run.run(machine.start()).unwrap();
    let (found, exact) = (last.unwrap(), run.end());
    for (found, exact) in found.q.to_array().iter().zip(exact.q.to_array()) {
        assert!((found - exact).abs() < limit(1e-8), "{found} {exact}");
    }
}

#[test]
fn a_fit_finds_the_parameters_again() {
    fit::main().unwrap();
    let other = fit::Pendulum {
        l: 0.93,
        b: 0.07,
        ..Default::default()
    };
    let found = fit::fit(fit::Pendulum::default(), &fit::angles(&other).unwrap()).unwrap();
    assert!((found.l - 0.93).abs() < 1e-8 && (found.b - 0.07).abs() < 1e-8);
}

#[test]
fn a_slip_in_an_edited_spec_has_its_place() {
    edited_spec::main().unwrap();
    let text =
        "machine M in plane {\n  coordinates { x: m }\n  bodies { b { mass: 1, at: (xx, 0) } }\n}";
    let error = edited_spec::last_angle(text, 1).unwrap_err();
    let marks = edited_spec::marks(&error);
    assert!(
        marks
            .iter()
            .any(|(line, column, _)| (*line, *column) == (3, 30)),
        "{marks:?}"
    );
}

#[test]
fn motions_part_as_machines_do() {
    generic::main().unwrap();
    // For an oscillator of 1 rad/s, after a quarter of its period, the difference is (cos t, −sin t) of the same length.
    let oscillator = crate::by_hand::toy::oscillator();
    let grown = generic::parting(&oscillator, std::f64::consts::FRAC_PI_2).unwrap();
    assert!((grown - 1.0).abs() < 1e-4, "{grown}");
}

#[test]
fn a_method_of_ones_own_has_its_order() {
    own_method::main().unwrap();
    let method = own_method::three_eighths().unwrap();
    let (exact, _) = own_method::swing(lagrangian::Method::DOP853, 1e-13).unwrap();
    let [coarse, fine] =
        [1e-6, 1e-9].map(|tolerance| own_method::swing(method, tolerance).unwrap());
    assert!((fine.0 - exact).abs() < limit(1e-9));
    // The error of a step falls as h⁴, so a tolerance of a thousandth takes 1000^(1/4) = 5.6 times the steps.
    let more = fine.1 as f64 / coarse.1 as f64;
    assert!((4.0..7.5).contains(&more), "{more}");
}

#[test]
fn firmware_follows_its_shaft() {
    microcontroller::main().unwrap();
    let machine = microcontroller::Drive::default();
    let mut model = microcontroller::firmware::Model::new(&machine).unwrap();
    let mut twist = 0.0;
    for _ in 0..5000 {
        twist = model.tick(1.0).unwrap();
    }
    // Both turn with angular acceleration 1/(J₁ + J₂); the shaft transmits the wheel's share of the torque.
    let exact = machine.wheel / (machine.motor + machine.wheel) / machine.stiffness;
    assert!((twist - exact).abs() < 1e-4, "{twist} {exact}");
}

#[test]
fn drag_of_a_table_takes_the_energy() {
    drag::main().unwrap();
    let [(early, _), (late, balance)] = [5.0, 15.0].map(|t| drag::swing(t).unwrap());
    assert!(late < early && early < 1.5);
    assert!(balance.work < -0.01 && balance.residual().abs() < 1e-7);
}
