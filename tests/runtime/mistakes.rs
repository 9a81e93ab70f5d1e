//! Errors of runs name the cause: the parameter, the coordinate, the time, the number.

use crate::by_hand::constrained::{Constrained, bead, circle, parallelogram, sleigh, winch};
use crate::by_hand::double_pendulum::DoublePendulum;
use crate::by_hand::tampered::{Slip, Tampered};
use crate::by_hand::toy::{Toy, ball, oscillator, pendulum};
use lagrangian::{
    At, Error, METHODS, Machine, Method, Pivot, Simulation, Solution, State, StepError, Stepper,
    System, UnknownName, Warning, check_equations,
};

fn error_of<const N: usize>(toy: &Toy<N>, until: f64) -> Error {
    Simulation::new(toy)
        .until(until)
        .run(toy.start())
        .map(|_| ())
        .unwrap_err()
}

#[test]
fn parameters_must_be_finite() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let machine = DoublePendulum {
            l2: value,
            ..Default::default()
        };
        let error = Simulation::new(&machine)
            .until(1.0)
            .run(machine.start())
            .unwrap_err();
        assert!(matches!(&error, Error::ParameterNotFinite { parameter, .. } if parameter == "l2"));
        assert!(error.to_string().contains("`l2`"));
    }
}

#[test]
fn of_two_near_names_the_one_in_the_same_case_is_meant() {
    let meant = |name: &str| UnknownName::new(name, ["M", "m", "length", "g"]).near;
    assert_eq!(meant("mm").as_deref(), Some("m"));
    assert_eq!(meant("MM").as_deref(), Some("M"));
    assert_eq!(meant("Lenght").as_deref(), Some("length"));
    assert_eq!(meant("G").as_deref(), Some("g"));
}

#[test]
fn start_values_must_be_finite() {
    let machine = DoublePendulum::default();
    let mut start = machine.start();
    start.q.theta2 = f64::NAN;
    let error = Simulation::new(&machine).until(1.0).run(start).unwrap_err();
    assert!(
        matches!(&error, Error::StartNotFinite { name, .. } if name == "theta2"),
        "{error}"
    );
    let mut start = machine.start();
    start.v.theta1 = f64::INFINITY;
    let error = Simulation::new(&machine).until(1.0).run(start).unwrap_err();
    assert!(matches!(&error, Error::StartNotFinite { name, .. } if name == "der(theta1)"));
    let start = State {
        t: f64::NAN,
        ..machine.start()
    };
    let error = Simulation::new(&machine).until(1.0).run(start).unwrap_err();
    assert!(matches!(&error, Error::StartNotFinite { name, .. } if name == "t"));
}

#[test]
fn inputs_must_be_finite() {
    let machine = DoublePendulum::default();
    let error = Simulation::new(&machine)
        .inputs(|t, _, _, u| u.torque = (2.0 - t).sqrt())
        .until(5.0)
        .run(machine.start())
        .unwrap_err();
    let Error::InputNotFinite { input, t, .. } = &error else {
        panic!("{error}")
    };
    assert_eq!(input, "torque");
    // The run ends where the root becomes undefined; ever shorter steps approach that to round-off.
    assert!((t - 2.0).abs() < 1e-12, "{t}");
}

#[test]
fn settings_must_make_sense() {
    let toy = oscillator();
    let simulation = || Simulation::new(&toy).until(1.0);
    let setting_of = |simulation: Simulation<'_, Toy<1>>| match simulation.run(toy.start()) {
        Err(Error::InvalidSetting { setting, .. }) => setting,
        other => panic!("{other:?}"),
    };
    for bad in [0.0, -1e-9, f64::NAN, f64::INFINITY] {
        assert_eq!(setting_of(simulation().absolute(bad)), "absolute");
        assert_eq!(
            setting_of(simulation().absolute_of("x", bad)),
            "absolute_of"
        );
        assert_eq!(setting_of(simulation().first_step(bad)), "first_step");
        assert_eq!(setting_of(simulation().every(bad)), "every");
    }
    for bad in [-1e-9, f64::NAN, f64::INFINITY, 1.0] {
        assert_eq!(setting_of(simulation().relative(bad)), "relative");
    }
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(setting_of(simulation().longest_step(bad)), "longest_step");
    }
    assert_eq!(setting_of(simulation().until(f64::INFINITY)), "until");
    assert_eq!(
        Simulation::new(&toy).run(toy.start()).unwrap_err(),
        Error::NoEnd
    );
    let unknown = simulation()
        .absolute_of("w", 1e-9)
        .run(toy.start())
        .unwrap_err();
    assert_eq!(unknown, Error::UnknownCoordinate { name: "w".into() });
}

#[test]
fn a_motion_that_runs_into_what_is_undefined_ends_there() {
    // v' = −1 − √x from x = 1: the root is undefined beyond x = 0, and nothing is wrong before.
    let toy = Toy::new(([1.0, 1.0], [0.0, 0.0]), |_, q, _, _, _| {
        [0.0, -1.0 - q[1].sqrt()]
    });
    for method in &METHODS {
        let (run, error) = Simulation::new(&toy)
            .method(method)
            .until(10.0)
            .run_as_far_as_possible(toy.start())
            .unwrap();
        let Some(Error::NotFinite { coordinate, t }) = error else {
            panic!("{error:?}")
        };
        assert_eq!(coordinate, "y");
        assert!(t > 1.0 && t < 1.2, "{t}");
        // The partial run leads up to that time.
        assert!(run.end().t <= t && run.end().q[1] >= 0.0 && run.end().q[1] < 1e-3);
        assert!(run.at(1.0).is_ok());
    }
}

#[test]
fn an_undefined_start_says_so_at_once() {
    let toy = Toy::new(([0.0], [0.0]), |_, q, _, _, _| [1.0 / q[0]]);
    let error = error_of(&toy, 1.0);
    assert_eq!(
        error,
        Error::NotFinite {
            coordinate: "x".into(),
            t: 0.0
        }
    );
}

#[test]
fn a_singular_mass_matrix_names_coordinate_and_time() {
    let toy = Toy {
        inertia: |q| q[0],
        ..Toy::new(([0.0], [0.0]), |_, _, _, _, _| [0.0])
    };
    let error = error_of(&toy, 1.0);
    assert!(
        matches!(&error, Error::SingularMassMatrix { coordinate, t: 0.0, .. } if coordinate == "x")
    );

    // During the run: no inertia at x ≤ 0.5, which is reached at t = 0.5.
    let toy = Toy {
        inertia: |q| if q[0] <= 0.5 { 0.0 } else { 1.0 },
        ..Toy::new(([1.0], [-1.0]), |_, _, _, _, _| [0.0])
    };
    let Error::SingularMassMatrix { t, .. } = error_of(&toy, 1.0) else {
        panic!()
    };
    assert!((t - 0.5).abs() < 1e-12, "{t}");
}

/// An error that stops a run uses the names of the machine and the terms of mechanics, and says what can be done.
#[test]
fn singular_equations_are_told_with_what_to_do() {
    let singular = |ratio: f64| Error::SingularMassMatrix {
        coordinate: "phi".into(),
        ratio,
        t: 0.5,
    };
    let dependent = |ratio: f64| Error::DependentConstraint {
        constraint: "rod".into(),
        ratio,
        t: 0.5,
    };
    let fork = Error::Fork {
        constraint: "rod".into(),
        left: 0.0,
        t: 0.5,
    };
    let contradicting = Error::InconsistentConstraints {
        constraint: "rod".into(),
        with: vec!["wall".into()],
        residual: 0.25,
        t: 0.5,
    };
    for (error, needed) in [
        (
            singular(3e-17),
            ["`phi` has no kinetic energy", "moment of inertia"],
        ),
        (
            singular(0.0),
            ["`phi` has no kinetic energy", "moment of inertia"],
        ),
        // A negative pivot with a negative diagonal element, and with a positive one.
        (
            singular(1.0),
            ["`phi` has negative kinetic energy", "moments of inertia"],
        ),
        (
            singular(-0.5),
            ["`phi` has negative kinetic energy", "moments of inertia"],
        ),
        (
            singular(f64::INFINITY),
            [
                "no finite value in the row of the coordinate `phi`",
                "overflow",
            ],
        ),
        (
            dependent(f64::INFINITY),
            ["row of the constraint `rod`", "overflow"],
        ),
        (
            dependent(3e-17),
            [
                "`rod` becomes dependent on others",
                "Leave out a constraint",
            ],
        ),
        (
            fork,
            ["`rod` becomes dependent on the others", "with rates along"],
        ),
        (
            contradicting,
            ["`rod` contradicts `wall`", "residual is 2.5e-1"],
        ),
    ] {
        let text = error.to_string();
        assert!(text.contains("t = 0.5 s"), "{text}");
        for needed in needed {
            assert!(text.contains(needed), "{text}");
        }
    }
}

/// A name that is kept is checked even if there are no constraints for whose sake it could be kept.
#[test]
fn a_kept_coordinate_that_does_not_exist_is_told_without_constraints() {
    let machine = DoublePendulum::default();
    let run = |name: &str| {
        let simulation = Simulation::new(&machine).until(0.1).keep(name);
        simulation.run(machine.start())
    };
    assert!(run("theta1").is_ok() && run("der(theta2)").is_ok());
    for name in ["nope", "der(nope)"] {
        let error = run(name).unwrap_err();
        assert!(matches!(error, Error::UnknownCoordinate { .. }), "{error}");
    }
}

#[test]
fn a_machine_whose_mass_vanishes_is_singular() {
    let machine = DoublePendulum {
        m2: 0.0,
        ..Default::default()
    };
    let error = Simulation::new(&machine)
        .until(1.0)
        .run(machine.start())
        .unwrap_err();
    let Error::SingularMassMatrix { coordinate, .. } = &error else {
        panic!("{error}")
    };
    assert_eq!(coordinate, "theta2");
}

#[test]
fn a_pole_of_the_motion_ends_it_where_it_is() {
    // x'' = 6 x² with x = 1/(1 − t)²: infinite at t = 1.
    let toy = Toy::new(([5.0, 1.0], [0.0, 2.0]), |_, q, _, _, _| {
        [0.0, 6.0 * q[1] * q[1]]
    });
    for method in &METHODS {
        let run = Simulation::new(&toy)
            .method(method)
            .until(2.0)
            .run(toy.start());
        match run.unwrap_err() {
            Error::StepTooSmall {
                coordinate,
                t,
                step,
            } => {
                assert_eq!(coordinate, "y");
                assert!((t - 1.0).abs() < 1e-6 && step < 1e-6, "{t} {step}");
            }
            Error::NotFinite { coordinate, t } => {
                assert_eq!(coordinate, "y");
                assert!((t - 1.0).abs() < 1e-6, "{t}");
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_kink_is_passed_and_noise_is_not() {
    // A jump of the acceleration only costs some short steps.
    let jump = Toy::new(([1.0], [0.0]), |_, q, _, _, _| {
        [if q[0] > 0.0 { -1.0 } else { 2.0 }]
    });
    Simulation::new(&jump)
        .tolerance(1e-10)
        .until(3.0)
        .run(jump.start())
        .unwrap();
    // No step can follow an acceleration without any smoothness.
    let noise = Toy::new(([1.0], [0.0]), |t, _, _, _, _| {
        [
            f64::from_bits(t.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 12 | 0x3FF << 52)
                * 1e6,
        ]
    });
    let start = State {
        t: 1.0,
        ..noise.start()
    };
    let error = Simulation::new(&noise)
        .tolerance(1e-13)
        .until(2.0)
        .run(start)
        .unwrap_err();
    let Error::StepTooSmall {
        coordinate,
        t,
        step,
    } = error
    else {
        panic!("{error}")
    };
    assert!(coordinate == "x" && t >= 1.0 && step < 1e-13);
}

#[test]
fn absurd_tolerances_neither_hang_nor_panic() {
    let toy = pendulum(1.0);
    for tolerance in [f64::MIN_POSITIVE, 1e-300, 1e-100, 1e100, 1e300] {
        let run = Simulation::new(&toy)
            .relative(1e-9)
            .absolute(tolerance)
            .until(1.0);
        assert!(run.run(toy.start()).is_ok(), "{tolerance}");
    }
}

/// A motion that overflows ends there, even if its accelerations stay finite: x = v t exceeds 1.8e308 after 1.8 s.
#[test]
fn a_motion_beyond_all_numbers_ends_with_an_error() {
    let free = Toy::new(([0.0], [1e308]), |_, _, _, _, _| [0.0]);
    let is_meant = |method: &&Method| method.tableau.name != "taylor" && !method.has_fixed_steps();
    for method in Method::all().filter(is_meant) {
        let run = Simulation::new(&free).method(method).until(10.0);
        let error = run.run(free.start()).map(|_| ());
        let name = method.tableau.name;
        let Err(Error::NotFinite { t, .. }) = error else {
            panic!("{name}: {error:?}")
        };
        assert!(t <= 2.0, "{name}: {t}");
        let mut stepper = Stepper::builder(free)
            .method(method)
            .start(free.start())
            .unwrap();
        let error = stepper.advance_to(10.0).unwrap_err();
        assert!(
            matches!(error, StepError::NotFinite { .. }),
            "{name}: {error}"
        );
        // The stepper stays at the end of the last good step.
        let (t, x) = (stepper.t(), stepper.q()[0]);
        assert!(
            (x - 1e308 * t).abs() <= 1e-12 * x && t <= 1.8,
            "{name}: {t} {x}"
        );
    }
}

/// With steps of 1e-150 s the end is out of reach, so the stepper stops after its maximum number of steps.
#[test]
fn a_stepper_takes_no_more_steps_than_it_may() {
    let fast = Toy::new(([1.0], [0.0]), |_, q, _, _, _| [-1e300 * q[0]]);
    for method in [Method::DOP853, Method::DOPRI5, Method::BS32] {
        let builder = Stepper::builder(fast).method(method).max_steps(50);
        let mut stepper = builder.start(fast.start()).unwrap();
        for times in 1..3 {
            let error = stepper.advance_to(1.0).unwrap_err();
            assert!(
                matches!(error, StepError::TooManySteps { steps: 50, .. }),
                "{error}"
            );
            assert_eq!(stepper.work().steps, 50 * times);
        }
    }
}

/// A length that is not a valid step length sets no bound.
#[test]
fn lengths_of_steps_that_are_none_are_passed_over() {
    let toy = oscillator();
    for length in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
        let mut stepper = Stepper::builder(toy)
            .longest_step(length)
            .first_step(length)
            .start(toy.start())
            .unwrap();
        stepper.advance_to(0.5).unwrap();
        stepper.set_longest_step(length);
        stepper.advance_to(1.0).unwrap();
        assert!((stepper.q()[0] - 1.0_f64.cos()).abs() < 1e-8, "{length}");
    }
}

#[test]
fn too_many_steps_are_too_many() {
    let toy = oscillator();
    let error = Simulation::new(&toy)
        .max_steps(10)
        .until(1e3)
        .run(toy.start())
        .unwrap_err();
    let Error::TooManySteps {
        steps: 10,
        t,
        until: 1e3,
    } = error
    else {
        panic!("{error}")
    };
    assert!(t > 0.0 && t < 1e3);
    // A limit equal to the number of steps needed is enough.
    let steps = Simulation::new(&toy)
        .until(50.0)
        .run(toy.start())
        .unwrap()
        .statistics()
        .steps;
    assert!(
        Simulation::new(&toy)
            .until(50.0)
            .max_steps(steps)
            .run(toy.start())
            .is_ok()
    );
    assert!(
        Simulation::new(&toy)
            .until(50.0)
            .max_steps(steps - 1)
            .run(toy.start())
            .is_err()
    );
}

#[test]
fn an_assumption_that_ends_ends_the_run_and_is_named() {
    let toy = Toy {
        assumption: Some(("x > 0.5", |q| q[0] - 0.5)),
        ..ball()
    };
    for method in &METHODS {
        let (run, error) = Simulation::new(&toy)
            .method(method)
            .until(3.0)
            .every(0.1)
            .energy_balance(true)
            .run_as_far_as_possible(toy.start())
            .unwrap();
        let Some(Error::AssumptionEnded { assumption, t }) = error else {
            panic!("{error:?}")
        };
        assert_eq!(assumption, "x > 0.5");
        let exact = (2.0 * 1.5 / 9.81_f64).sqrt();
        assert!((t - exact).abs() < 1e-13, "{t}");
        assert_eq!(run.end().t, t);
        assert!(run.energy_balance().unwrap().residual().abs() < 1e-12);
        assert_eq!(run.samples().len(), 7);
    }
}

#[test]
fn an_assumption_that_ends_and_holds_again_within_a_step_ends_the_run() {
    let toy = Toy {
        assumption: Some(("x < 3.8", |q| 3.8 - q[0])),
        ..Toy::new(([2.0], [6.0]), |_, _, _, _, _| [-9.81])
    };
    // x = 2 + 6 t − ½ 9.81 t² is above 3.8 from 0.527 s to 0.696 s; a step that ends later has x below 3.8 at both ends.
    let exact = (6.0 - (36.0 - 2.0 * 9.81 * 1.8_f64).sqrt()) / 9.81;
    for method in &METHODS {
        let (run, error) = Simulation::new(&toy)
            .method(method)
            .first_step(1.2)
            .until(1.2)
            .run_as_far_as_possible(toy.start())
            .unwrap();
        let Some(Error::AssumptionEnded { assumption, t }) = error else {
            panic!("{error:?}")
        };
        assert_eq!(assumption, "x < 3.8");
        // The round-off of ½ 9.81 1.2², summed with the coefficients of the continuous extension (a thousand in all for DOP853), is
        // 2e-12 m; the ball passes at 0.8 m/s.
        assert!((t - exact).abs() < 2e-12, "{t}");
        assert_eq!(run.end().t, t);
        assert!((run.end().q[0] - 3.8).abs() < 2e-12);
    }
}

/// x = 2 + 6 t − ½ 9.81 t² is at most 3.83486: an assumption that ends a billionth below this ends the run, one that
/// ends a billionth above does not.
#[test]
fn an_assumption_that_hardly_ends_within_a_step_ends_the_run() {
    const HIGHEST: f64 = 2.0 + 18.0 / 9.81;
    let below: fn(&[f64; 1]) -> f64 = |q| HIGHEST - 1e-9 - q[0];
    let above: fn(&[f64; 1]) -> f64 = |q| HIGHEST + 1e-9 - q[0];
    let not_linear: fn(&[f64; 1]) -> f64 = |q| (HIGHEST - 1e-9).powi(3) - q[0].powi(3);
    let at = 6.0 / 9.81 - (2e-9 / 9.81_f64).sqrt();
    for method in &METHODS {
        for i in 0..20 {
            for (fact, ends) in [(below, true), (above, false), (not_linear, true)] {
                let toy = Toy {
                    assumption: Some(("x is low", fact)),
                    ..Toy::new(([2.0], [6.0]), |_, _, _, _, _| [-9.81])
                };
                let end = 0.62 + 0.05 * f64::from(i);
                let (run, error) = Simulation::new(&toy)
                    .method(method)
                    .first_step(end)
                    .until(end)
                    .run_as_far_as_possible(toy.start())
                    .unwrap();
                let name = method.tableau.name;
                let ended = matches!(error, Some(Error::AssumptionEnded { .. }));
                assert_eq!(ended, ends, "{name} to {end} s");
                let late = run.end().t - if ends { at } else { end };
                assert!(late.abs() < 1e-7, "{name} to {end} s: {late:e}");
            }
        }
    }
}

#[test]
fn an_assumption_must_hold_at_the_start() {
    let toy = Toy {
        assumption: Some(("x > 2", |q| q[0] - 2.0)),
        ..ball()
    };
    let error = error_of(&toy, 3.0);
    assert_eq!(
        error,
        Error::AssumptionEnded {
            assumption: "x > 2".into(),
            t: 0.0
        }
    );
}

#[test]
fn times_outside_of_a_run_are_refused() {
    let toy = oscillator();
    let run = Simulation::new(&toy).until(1.0).run(toy.start()).unwrap();
    for t in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
        assert!(
            matches!(
                run.at(t),
                Err(Error::OutsideRun {
                    from: 0.0,
                    to: 1.0,
                    ..
                })
            ),
            "{t}"
        );
    }
    assert!(run.at_each([0.0, 0.5, 1.0]).is_ok());
    assert!(matches!(run.every(0.0), Err(Error::InvalidSetting { .. })));
}

#[test]
fn forgotten_steps_are_not_made_up() {
    let toy = oscillator();
    let run = Simulation::new(&toy)
        .forget_steps()
        .every(0.25)
        .until(1.0)
        .run(toy.start())
        .unwrap();
    assert_eq!(run.at(0.5).unwrap_err(), Error::StepsForgotten);
    assert_eq!(run.at(1.0).unwrap(), *run.end());
    assert_eq!(run.steps().count(), 0);
    let times: Vec<_> = run.samples().iter().map(|state| state.t).collect();
    assert_eq!(times, [0.0, 0.25, 0.5, 0.75, 1.0]);
}

#[test]
fn tolerances_below_roundoff_are_raised_with_a_warning() {
    let toy = pendulum(1.0);
    let run = Simulation::new(&toy)
        .tolerance(1e-16)
        .until(1.0)
        .run(toy.start())
        .unwrap();
    let [Warning::ToleranceRaised { asked, used }] = run.warnings() else {
        panic!()
    };
    assert!(*asked == 1e-16 && *used > 2e-15 && *used < 3e-15);
}

/// 2³⁶ rad is followed by the number 2⁻¹⁶ rad above it.
#[test]
fn an_angle_that_has_too_few_digits_is_reported() {
    let pendulum = lagrangian_machines::DoublePendulum::default();
    let run = |turned: f64| {
        let mut start = pendulum.start();
        start.q.theta2 = turned;
        let run = Simulation::new(&pendulum).until(1e-3).run(start).unwrap();
        run.warnings().to_vec()
    };
    let [
        Warning::LargeAngle {
            name,
            angle,
            spacing,
        },
    ] = &run(2_f64.powi(36))[..]
    else {
        panic!()
    };
    assert_eq!(name, "theta2");
    assert!((angle - 2_f64.powi(36)).abs() < 1e-2);
    assert_eq!(*spacing, 2_f64.powi(-16));
    assert_eq!(run(2_f64.powi(30)), []);
}

#[test]
fn stiffness_is_noticed() {
    // A strong damper: x decays at the rate 10⁵/s, within a time that is short for the drive.
    let stiff = Toy::new(([0.0], [0.0]), |t, _, v, _, _| [-1e5 * (v[0] - t.sin())]);
    for method in METHODS
        .iter()
        .filter(|method| method.tableau.stability.is_some())
    {
        let run = Simulation::new(&stiff)
            .method(method)
            .tolerance(1e-6)
            .until(1.0)
            .run(stiff.start())
            .unwrap();
        let [Warning::Stiff { t }] = run.warnings() else {
            panic!("{:?}", run.warnings())
        };
        assert!(*t > 0.0 && *t < 1.0);
    }
    let mild = pendulum(1.0);
    let run: Solution<_> = Simulation::new(&mild)
        .tolerance(1e-8)
        .until(2000.0)
        .run(mild.start())
        .unwrap();
    assert!(run.statistics().steps > 2000 && run.warnings().is_empty());
}

#[test]
fn a_run_of_no_length_is_a_run() {
    let toy = oscillator();
    let run = Simulation::new(&toy)
        .until(0.0)
        .every(0.1)
        .energy_balance(true)
        .run(toy.start())
        .unwrap();
    assert_eq!(*run.end(), toy.start());
    assert_eq!(run.at(0.0).unwrap(), toy.start());
    assert_eq!(run.statistics().steps, 0);
    assert_eq!(run.samples().len(), 1);
    assert_eq!(run.every(0.1).unwrap().len(), 1);
    assert_eq!(run.energy_balance().unwrap().residual(), 0.0);
}

#[test]
fn a_run_of_one_unit_in_the_last_place_is_a_run() {
    let toy = oscillator();
    let start = State {
        t: 1e9,
        ..toy.start()
    };
    let until = 1e9_f64.next_up();
    let run = Simulation::new(&toy).until(until).run(start).unwrap();
    assert_eq!((run.end().t, run.statistics().steps), (until, 1));
}

#[test]
fn a_machine_without_coordinates_stands_still() {
    let nothing = Toy::<0>::new(([], []), |_, _, _, _, _| []);
    let run = Simulation::new(&nothing)
        .until(5.0)
        .run(nothing.start())
        .unwrap();
    assert_eq!(run.end().t, 5.0);
    assert!(run.at(2.0).is_ok());
}

#[test]
fn unknown_methods_are_told_the_known() {
    assert!(Method::named("rk5").is_none());
    let message = Error::UnknownMethod { name: "rk5".into() }.to_string();
    assert!(
        message
            .contains("there are `dop853`, `dopri5`, `bs32`, `radau5`, `taylor`, `moreau`, `rk4`"),
        "{message}"
    );
}

/// The name of the row that is reported as violated at the start, if any, and whether it is a constraint.
fn violated<const N: usize, const M: usize, const NN: usize>(
    machine: Constrained<N, M, NN>,
    slip: Slip,
) -> Option<(String, bool)> {
    let machine = Tampered { machine, slip };
    // The start is in motion, so that every multiplier is nonzero.
    let mut start = machine.start();
    for (i, v) in start.v.iter_mut().enumerate() {
        *v += 0.3 + 0.1 * i as f64;
    }
    match check_equations(
        &machine,
        At {
            t: 0.0,
            q: &start.q,
            v: &start.v,
            u: &(),
        },
    ) {
        Ok(()) => None,
        Err(Error::EquationsViolated {
            row,
            is_constraint,
            residual,
            terms,
            ..
        }) => {
            assert!(residual.abs() > 1e-8 * terms, "{residual:e} {terms:e}");
            Some((row, is_constraint))
        }
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn machines_whose_functions_contradict_each_other_are_not_run() {
    fn each<const N: usize, const M: usize, const NN: usize>(machine: Constrained<N, M, NN>) {
        assert_eq!(violated(machine, Slip::None), None);
        // The change is far above rounding, yet too small to see in a plot.
        for i in 0..N {
            let found = violated(machine, Slip::Acceleration(i, 1e-4));
            assert!(found.is_some(), "acceleration {i} of {machine:?}");
        }
        for k in 0..M {
            let found = violated(machine, Slip::Multiplier(k, -1.0));
            assert!(found.is_some(), "multiplier {k} of {machine:?}");
            let (name, is_constraint) = violated(machine, Slip::ConstraintBias(k, 1e-3)).unwrap();
            assert!(is_constraint && name == machine.constraints[k].0, "{name}");
        }
    }
    each(circle::<1>());
    each(winch());
    each(bead());
    // The run is refused before its first step.
    let wrong = Tampered {
        machine: sleigh(),
        slip: Slip::Acceleration(0, 0.5),
    };
    let refused = Simulation::new(&wrong).until(1.0).run(wrong.start());
    let error = refused.unwrap_err();
    assert!(matches!(error, Error::EquationsViolated { .. }), "{error}");
    assert!(
        error
            .to_string()
            .contains("do not satisfy the equations of motion to within rounding")
    );
}

#[test]
fn honest_machines_are_run_however_ill_conditioned() {
    // Masses from 10⁻¹² to 10¹² kg on one rod, in any position.
    for [light, heavy] in [[1e-12, 1e12], [1e-6, 1.0], [1e9, 1e-9]] {
        for turn in 0..50 {
            let angle = 0.13 * f64::from(turn);
            let machine = Constrained {
                mass: [light, heavy, 1.0, light],
                ..parallelogram(angle)
            };
            assert_eq!(violated(machine, Slip::None), None, "{light:e} {angle}");
            let circle = Constrained {
                mass: [light, heavy],
                start: ([angle.cos(), angle.sin()], [-angle.sin(), angle.cos()]),
                ..circle::<3>()
            };
            assert_eq!(violated(circle, Slip::None), None, "{light:e} {angle}");
        }
    }
    // At rest in equilibrium, the forces consist of rounding only.
    let pendulum = DoublePendulum::default();
    for tilt in [0.0, 1e-17, 1e-12, 3e-9] {
        let system = pendulum.prepare();
        let u = system.default_inputs();
        let at = At {
            t: 0.0,
            q: &[tilt, -tilt],
            v: &[0.0, 0.0],
            u: &u,
        };
        assert_eq!(check_equations(&system, at), Ok(()));
    }
}

#[test]
fn stiffness_is_told_while_the_run_is_under_way() {
    let stiff = Toy::new(([0.0], [0.0]), |t, _, v, _, _| [-1e5 * (v[0] - t.sin())]);
    let mut told = None;
    let run = Simulation::new(&stiff)
        .tolerance(1e-6)
        .until(1.0)
        .progress(|progress| {
            if progress.stiff_since.is_some() && told.is_none() {
                told = Some(progress);
            }
        })
        .run(stiff.start())
        .unwrap();
    let told = told.unwrap();
    assert_eq!(told.stiff_since, run.statistics().stiff_since);
    assert!(told.steps <= 1100 && run.statistics().steps > 10_000);
    let implicit = Simulation::new(&stiff)
        .method(Method::named("radau5").unwrap())
        .tolerance(1e-6)
        .until(1.0)
        .run(stiff.start())
        .unwrap();
    assert_eq!(implicit.statistics().stiff_since, None);
}

/// A machine with contacts that provides no workspace for them cannot be evaluated; the error must not blame friction.
#[test]
fn contacts_without_room_are_told_so() {
    for length in [None, Some(0), Some(1)] {
        let tight = Tampered {
            machine: circle::<0>(),
            slip: Slip::Workspace(length),
        };
        let start = tight.start();
        let mut a = [0.0; 2];
        let singular = tight.accelerations(0.0, &start.q, &start.v, &(), &mut a);
        let singular = singular.unwrap_err();
        assert_eq!((singular.at, singular.ratio), (Pivot::NoWorkspace, 0.0));
        assert!(
            singular.to_string().contains("provides no workspace"),
            "{singular}"
        );
        let refused = Simulation::new(&tight).until(1.0).run(start);
        let error = refused.unwrap_err();
        assert!(
            matches!(error, Error::NoWorkspaceForContacts { .. }),
            "{error}"
        );
        let text = error.to_string();
        assert!(text.contains("no workspace for its contacts"), "{text}");
    }
}
