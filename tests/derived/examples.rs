//! Every example runs, and answers its question rightly.
//!
//! The examples are modules of this one program: one more link, instead of one for each of them.
#![cfg(feature = "interpreter")]

#[path = "../../examples/balance.rs"]
mod balance;
#[path = "../../examples/bounce.rs"]
mod bounce;
#[path = "../../examples/computed_torque.rs"]
mod computed_torque;
#[path = "../../examples/energy.rs"]
mod energy;
#[path = "../../examples/isolation.rs"]
mod isolation;
#[path = "../../examples/numbers.rs"]
mod numbers;
#[path = "../../examples/pendulum.rs"]
mod pendulum;
#[path = "../../examples/single_steps.rs"]
mod single_steps;
#[path = "../../examples/variants.rs"]
mod variants;

/// What a run may be off by whose steps, fewer than `STEPS`, each keep `tolerance`, in motions that do not multiply errors.
fn limit(tolerance: f64) -> f64 {
    const STEPS: f64 = 1000.0;
    STEPS * tolerance
}

#[test]
fn every_example_is_here() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for entry in std::fs::read_dir(folder).expect("the examples") {
        let name = entry.expect("an entry").file_name();
        let line = format!("#[path = \"../../examples/{}\"]", name.to_string_lossy());
        assert!(include_str!("examples.rs").contains(&line), "{name:?}");
    }
}

#[test]
fn the_period_grows_with_the_amplitude() {
    pendulum::main().unwrap();
    for amplitude in [0.01, 1.0, 3.0] {
        let [simulated, exact] = pendulum::period(amplitude).unwrap();
        // At the bottom it turns by √(2 g/l (1 − cos θ₀)) a second, 0.04 for the smallest swing.
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
        // In units of the floor's amplitude, 1 mm.
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
        // Energies and works are of the order of 10 J, and change with errors by less than 100 J per metre.
        assert!(balance.residual().abs() < 100.0 * limit(tolerance));
        assert!((balance.work - exact).abs() < 100.0 * limit(tolerance));
    }
}

#[test]
fn each_number_is_as_exact_as_it_is() {
    numbers::main().unwrap();
    let machine = numbers::Pendulum::default();
    // −19.5 sin 1, by its series in sixty digits: its nearest f64, and what that lacks.
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
    let mut crusher = variants::read("machines/cushioned_crusher.machine").unwrap();
    // The same spec, compiled: the same operations in the same order.
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
    assert!(variants::read("machines/no-such.machine").is_err());
}
