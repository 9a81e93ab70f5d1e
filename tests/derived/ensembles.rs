//! Many trajectories side by side: each equals the trajectory computed alone, bit for bit.

use crate::support::random::SplitMix;
use lagrangian::{
    Arrival, Batched, Ensemble, Machine, Method, State, StepError, Stepper, System, Trajectory,
    Work,
};
use lagrangian_machines::{
    CartPole, Crusher9, DoublePendulum, FourBar, VibratingCrusher, cart_pole,
};

type Alone<S> = Result<(State<<S as System>::Coordinates>, Work), StepError>;

/// Computes one trajectory alone with the stepper.
fn alone<S: System + Clone + 'static>(
    trajectory: &Trajectory<S>,
    method: &'static Method,
    tolerance: f64,
) -> Alone<S> {
    let mut stepper = Stepper::builder(trajectory.system.clone())
        .method(method)
        .tolerance(tolerance)
        .inputs(trajectory.inputs.clone())
        .start(trajectory.start.clone())?;
    stepper.advance_to(trajectory.end)?;
    Ok((stepper.state(), stepper.work()))
}

/// Asserts that all trajectories, stepped `W` at a time, equal those stepped alone.
fn assert_same<S: Batched<W> + 'static, const W: usize>(
    trajectories: &[Trajectory<S>],
    method: &'static Method,
    tolerance: f64,
) where
    S::Coordinates: PartialEq,
{
    let mut arrived: Vec<Option<Result<Arrival<S::Coordinates>, StepError>>> =
        trajectories.iter().map(|_| None).collect();
    Ensemble::<W>::new()
        .method(method)
        .tolerance(tolerance)
        .run(trajectories.iter().cloned(), |index, arrival| {
            assert!(arrived[index].is_none(), "{index} arrived twice");
            arrived[index] = Some(arrival);
        });
    for (index, (trajectory, arrival)) in trajectories.iter().zip(arrived).enumerate() {
        let arrival = arrival.expect("all of them arrive");
        let name = method.tableau.name;
        match (alone(trajectory, method, tolerance), arrival) {
            (Ok((state, work)), Ok(arrival)) => {
                assert_eq!(state, arrival.end, "{index} by {name}");
                assert_eq!(work, arrival.work, "{index} by {name}");
            }
            // The exact point at which a trajectory failed need not agree to the bit.
            (Err(one), Err(other)) => assert_eq!(
                std::mem::discriminant(&one),
                std::mem::discriminant(&other),
                "{index} by {name}: {one}, {other}"
            ),
            (one, other) => panic!("{index} by {name}: {one:?}, {other:?}"),
        }
    }
}

/// The seed of this run: a new one each time, unless `SEED` is set.
fn seed() -> u64 {
    let clock = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(0, |since| since.as_nanos() as u64);
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(clock);
    println!("SEED={seed}");
    seed
}

#[test]
fn each_trajectory_is_what_it_is_alone() {
    let mut random = SplitMix::new(seed());
    let pendulums: Vec<_> = (0..23)
        .map(|_| {
            let machine = DoublePendulum {
                l1: random.uniform(0.2, 3.0),
                m2: random.uniform(0.1, 2.0),
                ..Default::default()
            };
            let mut start = Machine::start(&machine);
            start.q.theta1 = random.uniform(-3.0, 3.0);
            start.v.theta2 = random.uniform(-5.0, 5.0);
            start.t = random.uniform(-1.0, 1.0);
            // Some trajectories end immediately, and some run backward.
            let end = start.t + [0.0, 0.02, 3.0, -1.0][(random.next() % 4) as usize];
            Trajectory::new(Machine::prepare(&machine), start, end)
        })
        .collect();
    for method in [Method::DOP853, Method::DOPRI5, Method::BS32] {
        assert_same::<_, 4>(&pendulums, method, 1e-7);
    }
    assert_same::<_, 2>(&pendulums, Method::DOP853, 1e-10);
    assert_same::<_, 8>(&pendulums, Method::DOP853, 1e-10);
    // These tolerances select order 20 and order 12.
    assert_same::<_, 2>(&pendulums, Method::TAYLOR, 1e-10);
    assert_same::<_, 4>(&pendulums, Method::TAYLOR, 1e-4);
    assert_same::<_, 8>(&pendulums, Method::TAYLOR, 1e-14);
    assert_same::<_, 8>(&pendulums, Method::TAYLOR, 1e-7);
    assert_same::<_, 8>(&pendulums[..3], Method::TAYLOR, 1e-10);
    // Fewer trajectories than lanes, and none at all.
    assert_same::<_, 8>(&pendulums[..3], Method::DOP853, 1e-10);
    assert_same::<_, 8>(&pendulums[..0], Method::DOP853, 1e-10);
}

#[test]
fn each_has_its_own_inputs_and_its_own_drive() {
    let mut random = SplitMix::new(seed());
    let pushed: Vec<_> = (0..13)
        .map(|_| {
            let machine = CartPole::default();
            let inputs = cart_pole::Inputs {
                push: random.uniform(-20.0, 20.0),
            };
            Trajectory::of(&machine, random.uniform(0.1, 2.0)).inputs(inputs)
        })
        .collect();
    assert_same::<_, 4>(&pushed, Method::DOP853, 1e-9);
    let driven: Vec<_> = (0..6)
        .map(|_| {
            let machine = VibratingCrusher {
                omega: random.uniform(50.0, 200.0),
                ..Default::default()
            };
            Trajectory::of(&machine, random.uniform(0.05, 0.2))
        })
        .collect();
    assert_same::<_, 4>(&driven, Method::DOP853, 1e-8);
    // The series of this machine depend on time as well.
    let driven: Vec<_> = (0..11)
        .map(|_| {
            let machine = Crusher9 {
                w: random.uniform(50.0, 200.0),
                ..Default::default()
            };
            let mut trajectory = Trajectory::of(&machine, 0.0);
            trajectory.start.t = random.uniform(-10.0, 10.0);
            trajectory.end = trajectory.start.t + random.uniform(-0.1, 0.1);
            trajectory
        })
        .collect();
    for tolerance in [1e-4, 1e-9, 1e-13] {
        assert_same::<_, 2>(&driven, Method::TAYLOR, tolerance);
        assert_same::<_, 4>(&driven, Method::TAYLOR, tolerance);
        assert_same::<_, 8>(&driven, Method::TAYLOR, tolerance);
    }
}

lagrangian::machine! {
    /// A ball that is thrown up in air.
    machine Ball in plane {
        parameters { m: kg = 0.125, g: m/s^2 = 9.75, area: m^2 = 0.015625, rho: kg/m^3 = 1 }
        coordinates { x: m, y: m, der(y): m/s = 20 }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        drag { air { at: ball.at, coefficient: 0.5, area: area, density: rho } }
        methods { taylor }
    }
}

/// The speed of a ball is the root of a square: where it passes zero, its series continues with the other sign, and the step must be a shorter one. The closed form is that
/// of `cli/tests/command/precise.rs`.
#[test]
fn a_speed_passes_zero_in_lanes() {
    let balls: Vec<_> = (0..7)
        .map(|i| {
            let mut trajectory = Trajectory::of(&Ball::default(), 3.0);
            trajectory.start.v.y = 20.0 - 2.5 * f64::from(i);
            trajectory
        })
        .collect();
    for tolerance in [1e-4, 1e-9, 1e-13] {
        assert_same::<_, 4>(&balls, Method::TAYLOR, tolerance);
        let mut first = None;
        Ensemble::<4>::new()
            .method(Method::TAYLOR)
            .tolerance(tolerance)
            .run(balls.iter().take(1).cloned(), |_, arrived| {
                first = arrived.ok()
            });
        let Arrival { end, work, .. } = first.expect("it arrives");
        assert!(work.rejected > 0, "{work:?}");
        let errors = [end.q.y - 3.713662147284138, end.v.y + 11.81367562226057];
        // As for a single run: the step over the zero may have a defect of a thousand tolerances.
        assert!(
            errors
                .iter()
                .all(|error| error.abs() < 1e3 * tolerance * 21.0 + 1e-12),
            "{tolerance:e}: {errors:?}"
        );
    }
}

/// With Taylor series: one trajectory without mass, one that starts at NaN, one whose numbers overflow and one that never
/// reaches its end leave the others unchanged.
#[test]
fn the_failure_of_one_series_is_none_of_another() {
    let good = DoublePendulum::default();
    let mut trajectories: Vec<_> = (1..12)
        .map(|i| Trajectory::of(&good, 0.25 * f64::from(i)))
        .collect();
    let massless = DoublePendulum { m2: 0.0, ..good };
    trajectories.insert(1, Trajectory::of(&massless, 1.0));
    let mut nowhere = Trajectory::of(&good, 1.0);
    nowhere.start.v.theta1 = f64::NAN;
    trajectories.insert(3, nowhere);
    let mut fast = Trajectory::of(&good, 1.0);
    fast.start.v.theta2 = 1e160;
    trajectories.insert(4, fast);
    let mut fast = Trajectory::of(&good, 1.0);
    fast.start.v.theta2 = 1e20;
    trajectories.insert(6, fast);
    assert_same::<_, 4>(&trajectories, Method::TAYLOR, 1e-9);
    assert_same::<_, 8>(&trajectories, Method::TAYLOR, 1e-6);
    let mut failed = 0;
    Ensemble::<8>::new()
        .method(Method::TAYLOR)
        .run(trajectories, |_, arrived| {
            failed += usize::from(arrived.is_err())
        });
    assert!((3..=4).contains(&failed), "{failed} failed");
    let series = Ensemble::<2>::new().method(Method::TAYLOR);
    series.run([Trajectory::of(&CartPole::default(), 1.0)], |_, arrived| {
        let error = arrived.expect_err("it has no series");
        assert!(matches!(error, StepError::NoSeries { .. }), "{error}");
    });
    series
        .max_steps(5)
        .run([Trajectory::of(&good, 10.0)], |_, arrived| {
            let error = arrived.expect_err("it does not get there");
            assert!(
                matches!(error, StepError::TooManySteps { steps: 5, .. }),
                "{error}"
            );
        });
}

/// A trajectory without accelerations and one that starts at NaN leave the others unchanged.
#[test]
fn the_failure_of_one_is_none_of_another() {
    let good = CartPole::default();
    let mut trajectories: Vec<_> = (1..9)
        .map(|i| Trajectory::of(&good, 0.25 * f64::from(i)))
        .collect();
    let massless = CartPole {
        cart: 0.0,
        pole: 0.0,
        ..good
    };
    trajectories.insert(1, Trajectory::of(&massless, 1.0));
    let mut nowhere = Trajectory::of(&good, 1.0);
    nowhere.start.v = cart_pole::Coordinates::from_array([f64::NAN; 2]);
    trajectories.insert(3, nowhere);
    assert_same::<_, 4>(&trajectories, Method::DOP853, 1e-9);
    assert_same::<_, 4>(&trajectories, Method::DOPRI5, 1e-9);
    let mut failed = 0;
    Ensemble::<4>::new().run(trajectories, |_, arrived| {
        failed += usize::from(arrived.is_err())
    });
    assert_eq!(failed, 2);
}

#[test]
fn what_an_ensemble_does_not_do_is_said() {
    let mut said = Vec::new();
    Ensemble::<2>::new().run([Trajectory::of(&FourBar::default(), 1.0)], |_, arrived| {
        said.push(arrived.expect_err("it has constraints"))
    });
    let pendulum = DoublePendulum::default();
    let endless = Trajectory::of(&pendulum, f64::INFINITY);
    let long = Trajectory::of(&pendulum, 10.0);
    Ensemble::<2>::new()
        .max_steps(5)
        .run([endless, long.clone()], |_, arrived| {
            said.push(arrived.expect_err("neither gets there"))
        });
    Ensemble::<2>::new()
        .method(Method::RADAU5)
        .run([long], |_, arrived| {
            said.push(arrived.expect_err("it is implicit"))
        });
    assert!(
        matches!(
            said[..],
            [
                StepError::NotFree { .. },
                StepError::NoTime { .. },
                StepError::TooManySteps { steps: 5, .. },
                StepError::NotExplicit { .. },
            ]
        ),
        "{said:?}"
    );
}

#[test]
fn an_ensemble_allocates_nothing() {
    let machine = DoublePendulum::default();
    let mut sum = 0.0;
    let count = allocation_counter::measure(|| {
        let trajectories = (1..20).map(|i| Trajectory::of(&machine, 0.1 * f64::from(i)));
        Ensemble::<4>::new().run(trajectories, |_, arrived| {
            sum += arrived.map_or(f64::NAN, |arrival| arrival.end.q.theta1);
        });
    });
    assert!(sum.is_finite());
    assert_eq!(count.count_total, 0);
}
