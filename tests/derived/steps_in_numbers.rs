//! Steps in `f32`, in `f64`, in double-doubles and in dual numbers.

use lagrangian::scalar::{DoubleDouble, Dual, Scalar};
use lagrangian::{
    DefaultInputs, ExplicitStepper, HeldInputs, InputFunction, Machine, MachineIn, Method,
    NoBalance, Real, Sensitive, Simulation, State, StepError, Stepper, System, SystemIn, Tolerance,
};
use lagrangian_machines::{CartPole, DoublePendulum, TwoBodyOrbit, cart_pole, two_body_orbit};

/// Explicit methods from the list of methods.
const EXPLICIT: [&Method; 3] = [Method::DOP853, Method::DOPRI5, Method::BS32];

/// Kepler's orbit of semi-major axis 1 and eccentricity e with gravitational parameter 1: distance and direction at the eccentric
/// anomaly `u`, and the time since the pericentre, `u − e sin u`.
fn kepler<N: Scalar>(e: N, u: N) -> (N, [N; 2]) {
    let half = (u * N::from_f64(0.5)).tan();
    let direction = ((N::ONE + e) / (N::ONE - e)).sqrt() * half;
    let two = N::from_f64(2.0);
    (
        u - e * u.sin(),
        [N::ONE - e * u.cos(), two * direction.atan()],
    )
}

/// Two bodies of total mass 1 at the pericentre of such an orbit, where φ′ = √((1 + e)/(1 − e)³).
fn orbit<N: Scalar>(e: f64) -> (TwoBodyOrbit<N>, State<two_body_orbit::Coordinates<N>>) {
    let machine = TwoBodyOrbit {
        m1: 0.75,
        m2: 0.25,
        ..Default::default()
    };
    let e = N::from_f64(e);
    let near = N::ONE - e;
    let rate = ((N::ONE + e) / (near * near * near)).sqrt();
    let start = State {
        t: 0.0,
        q: two_body_orbit::Coordinates::from_array([near, N::ZERO]),
        v: two_body_orbit::Coordinates::from_array([N::ZERO, rate]),
    };
    (machine.map(N::from_f64), start)
}

/// The error of the orbit of e = 1/8 at u = 1, with steps of the fixed length `h` if one is given.
fn off<N: Real + PartialOrd>(method: &'static Method, tolerance: f64, h: Option<f64>) -> f64 {
    let e = 0.125;
    let (machine, start) = orbit::<N>(e);
    let (t, place) = kepler(N::from_f64(e), N::ONE);
    let mut builder = ExplicitStepper::builder(MachineIn::prepare(&machine))
        .method(method)
        .tolerance(tolerance);
    if let Some(h) = h {
        builder = builder.first_step(h).longest_step(h);
    }
    let mut stepper = builder.start(start).expect("accelerations");
    stepper.advance_to(t).expect("a run");
    let differences = [0, 1].map(|i| (stepper.q()[i] - place[i]).abs().to_f64());
    differences[0].max(differences[1])
}

/// In 32 digits the error of a method of order p falls by 2^p where the steps are halved, far below what `f64`
/// resolves, until rounding limits it.
#[test]
fn order_eight_goes_on_to_28_digits_in_double_doubles() {
    let mut last = f64::INFINITY;
    let mut seen = 0;
    for halvings in 4..12 {
        let h = 2.0_f64.powi(-halvings);
        let error = off::<DoubleDouble>(Method::DOP853, 1e30, Some(h));
        // Below this, rounding and the thirty published digits of the coefficients contribute.
        if last < 1e-8 && error > 1e-27 {
            let order = (last / error).log2();
            assert!(
                (order - 8.0).abs() < 0.5,
                "{error:e} after {last:e}: {order}"
            );
            seen += 1;
        }
        last = error;
        if error < 1e-28 {
            assert!(seen >= 3, "{seen}");
            return;
        }
    }
    panic!("{last:e} is the least error");
}

#[test]
fn lower_orders_are_theirs_beyond_the_digits_of_f64() {
    for (method, order, [from, to]) in
        [(Method::DOPRI5, 5.0, [8, 11]), (Method::BS32, 3.0, [9, 12])]
    {
        let error =
            |halvings: i32| off::<DoubleDouble>(method, 1e30, Some(2.0_f64.powi(-halvings)));
        let found = (error(from) / error(to)).log2() / f64::from(to - from);
        assert!(
            (found - order).abs() < 0.2,
            "{}: {found}",
            method.tableau.name
        );
    }
    assert!(off::<DoubleDouble>(Method::DOPRI5, 1e30, Some(2.0_f64.powi(-11))) < 1e-17);
}

/// A motion that does not amplify errors errs by at most the sum of the errors of its steps, of which
/// there are fewer than a thousand.
#[test]
fn tolerances_are_kept_in_every_number() {
    for (error, tolerance) in [
        (off::<f32>(Method::DOP853, 1e-5, None), 1e-5),
        (off::<f32>(Method::BS32, 1e-4, None), 1e-4),
        (off::<f64>(Method::DOP853, 1e-10, None), 1e-10),
        (off::<DoubleDouble>(Method::DOP853, 1e-20, None), 1e-20),
        (off::<DoubleDouble>(Method::DOP853, 1e-29, None), 1e-29),
    ] {
        assert!(error < 1000.0 * tolerance, "{error:e} at {tolerance:e}");
    }
}

/// Compares the state and the work counts of the stepper in `f64` with those of the generic stepper, bit for bit.
fn assert_same_bits<M>(machine: &M, inputs: <M::System as System>::Inputs, ends: [f64; 3])
where
    M: Machine,
    M::System: 'static
        + SystemIn<
            f64,
            Vector = <M::System as System>::Vector,
            Coordinates = <M::System as System>::Coordinates,
            Inputs = <M::System as System>::Inputs,
        >,
{
    for method in EXPLICIT {
        let mut one = Stepper::builder(machine.prepare())
            .method(method)
            .tolerance(1e-8)
            .inputs(inputs.clone())
            .start(machine.start())
            .expect("accelerations");
        let mut other = ExplicitStepper::builder(machine.prepare())
            .method(method)
            .tolerance(1e-8)
            .inputs(inputs.clone())
            .start(machine.start())
            .expect("accelerations");
        for end in ends {
            one.advance_to(end).expect("a run");
            other.advance_to(end).expect("a run");
            let name = method.tableau.name;
            assert_eq!(
                (one.q(), one.v(), one.a()),
                (other.q(), other.v(), other.a()),
                "{name}"
            );
            assert_eq!((one.t(), one.work()), (other.t(), other.work()), "{name}");
            // The interpolants of the last step agree as well.
            let curves = (one.interpolant(), other.interpolant());
            let (Ok(of_one), Ok(of_other)) = curves else {
                panic!("{name}: {curves:?}")
            };
            for theta in [0.0, 0.21, 0.5, 1.0] {
                assert_eq!(of_one.state_at(theta), of_other.state_at(theta), "{name}");
                assert_eq!(one.hermite(theta), other.hermite(theta), "{name}");
            }
            assert_eq!(
                (
                    one.t_before(),
                    one.q_before(),
                    one.v_before(),
                    one.a_before()
                ),
                (
                    other.t_before(),
                    other.q_before(),
                    other.v_before(),
                    other.a_before()
                ),
                "{name}"
            );
            assert_eq!(one.work(), other.work(), "{name}");
            one.set_inputs(inputs.clone());
            other.set_inputs(inputs.clone());
        }
    }
}

#[test]
fn f64_has_the_bits_of_the_stepper() {
    let ends = [3.0, 3.5, -1.0];
    let of_pendulum = lagrangian_machines::double_pendulum::Inputs::default();
    assert_same_bits(&DoublePendulum::default(), of_pendulum, ends);
    let pushed = cart_pole::Inputs { push: 3.0 };
    assert_same_bits(&CartPole::default(), pushed, ends);
}

lagrangian::machine! {
    machine Swing in plane {
        parameters { l: m = 0.5, b: N*m*s = 0.1, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 1.5 }
        bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
        dissipations { pivot: 1/2*b*der(theta)^2 }
        gravity (0, -g);
        derivatives { coordinates, rates, l, b }
    }
}

/// The derivative of a run by parameters and by its start, tested against the variational equations, which another
/// implementation integrates.
#[test]
fn a_dual_run_is_the_derivative_of_the_motion() {
    let (tolerance, end) = (1e-11, 2.0);
    let swing = Swing::default();
    let sensitive = Sensitive::new(&swing)
        .by("l")
        .and_then(|s| s.by("b"))
        .and_then(|s| s.by_start("theta"));
    let sensitive = sensitive.expect("variables");
    let run = Simulation::new(&sensitive)
        .tolerance(tolerance)
        .until(end)
        .run(sensitive.start())
        .expect("a run");
    let by = &run.end().q.by;
    for (k, exact) in by.iter().enumerate() {
        let mut machine = swing.map(Dual::constant);
        let mut start = MachineIn::start(&machine);
        match k {
            0 => machine.l = Dual::variable(swing.l),
            1 => machine.b = Dual::variable(swing.b),
            _ => start.q.theta = Dual::variable(start.q.theta.value),
        }
        let mut stepper = ExplicitStepper::builder(MachineIn::prepare(&machine))
            .tolerance(tolerance)
            .start(start)
            .expect("accelerations");
        stepper.advance_to(Dual::constant(end)).expect("a run");
        let found = stepper.state().q.theta.derivative;
        let steps = stepper.work().steps as f64;
        // Each of the two runs errs by the sum of its steps' errors, which a damped swing does not amplify.
        let limit = 2.0 * steps * tolerance * (1.0 + exact.theta.abs());
        assert!(
            (found - exact.theta).abs() < limit,
            "{k}: {found}, not {}",
            exact.theta
        );
    }
    // The derivative by the end time of the run is the rate at the end.
    let machine = swing.map(Dual::constant);
    let mut stepper = ExplicitStepper::builder(MachineIn::prepare(&machine))
        .tolerance(tolerance)
        .start(MachineIn::start(&machine))
        .expect("accelerations");
    stepper.advance_to(Dual::variable(end)).expect("a run");
    let (q, v) = (stepper.q()[0], stepper.v()[0]);
    assert!((q.derivative - v.value).abs() < 1e-8, "{q:?} {v:?}");
}

/// x″ = 1/(1 − t), which has no value beyond t = 1.
struct Bounded;

impl<N: Real> SystemIn<N> for Bounded {
    type Vector = [N; 1];
    type Coordinates = N;
    type Inputs = ();

    fn coordinates(&self) -> impl ExactSizeIterator<Item = lagrangian::Quantity<'_>> {
        [lagrangian::Quantity::new("x", "m")].into_iter()
    }

    fn to_coordinates(&self, vector: &[N; 1]) -> N {
        vector[0]
    }

    fn to_vector(&self, x: &N) -> [N; 1] {
        [*x]
    }

    fn accelerations(
        &self,
        t: N,
        _q: &[N; 1],
        _v: &[N; 1],
        _u: &(),
        a: &mut [N; 1],
    ) -> Result<(), lagrangian::Singular> {
        a[0] = (N::ONE - t).sqrt();
        Ok(())
    }

    fn default_inputs(&self) {}
}

#[test]
fn what_cannot_be_done_is_said() {
    let start = State {
        t: 0.0,
        q: DoubleDouble::ZERO,
        v: DoubleDouble::ZERO,
    };
    let with = |method| {
        ExplicitStepper::builder(Bounded)
            .method(method)
            .start(start)
            .err()
    };
    for method in [Method::RADAU5, Method::TAYLOR] {
        assert_eq!(with(method), Some(StepError::NotExplicit { t: 0.0 }));
    }
    let own: &'static Method = Box::leak(Box::new(
        Method::try_new(lagrangian::methods::Tableau {
            name: "kutta38",
            title: "Kutta's 3/8 rule",
            order: 4,
            error_power: 4,
            dense_order: 3,
            stages: 4,
            c: &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 1.0],
            a: &[
                &[],
                &[1.0 / 3.0],
                &[-1.0 / 3.0, 1.0],
                &[1.0, -1.0, 1.0],
                &[1.0 / 8.0, 3.0 / 8.0, 3.0 / 8.0, 1.0 / 8.0],
            ],
            error: &[1.0 / 24.0, -1.0 / 8.0, 1.0 / 8.0, 1.0 / 8.0, -1.0 / 6.0],
            coarse_error: None,
            dense: &[],
            step_change: (0.2, 5.0),
            smoothing: 0.0,
            stability: None,
            spectrum: None,
        })
        .expect("a method"),
    ));
    assert_eq!(with(own), Some(StepError::FewDigits { t: 0.0 }));
    let mut narrow = ExplicitStepper::builder(Bounded)
        .method(own)
        .start(State {
            t: 0.0,
            q: 0.0,
            v: 0.0,
        })
        .expect("its digits are enough");
    let none = narrow.advance_to(f64::NAN);
    assert!(matches!(none, Err(StepError::NoTime { .. })), "{none:?}");
    // The run goes as far as accelerations exist, and the error states where they end.
    let beyond = narrow
        .advance_to(2.0)
        .expect_err("there are none beyond 1 s");
    assert!(
        matches!(
            beyond,
            StepError::NotFinite { .. } | StepError::StepTooSmall { .. }
        ),
        "{beyond:?}"
    );
    assert!(
        (narrow.t() - 1.0).abs() < 1e-9 && narrow.t() <= 1.0,
        "{}",
        narrow.t()
    );
    // x = t²/2 − …: ∫∫ √(1 − s) = (2/3) t − (4/15) (1 − (1 − t)^(5/2)) at t = 1.
    assert!((narrow.q()[0] - (2.0 / 3.0 - 4.0 / 15.0)).abs() < 1e-6);
}

#[test]
fn steps_in_numbers_allocate_nothing() {
    let machine = DoublePendulum::default().map(DoubleDouble::from_f64);
    let count = allocation_counter::measure(|| {
        let mut stepper = ExplicitStepper::builder(MachineIn::prepare(&machine))
            .start(MachineIn::start(&machine))
            .expect("accelerations");
        stepper
            .advance_to(DoubleDouble::from_f64(0.1))
            .expect("a run");
    });
    assert_eq!(count.count_total, 0);
}

/// The core's own stepper, whose input law is a type parameter, takes the same steps as one whose inputs are set directly.
#[test]
fn held_and_default_inputs_are_one() {
    let machine = CartPole::default();
    let system = Machine::prepare(&machine);
    let start = Machine::start(&machine);
    let at = || (0.0, start.q.to_array(), start.v.to_array());
    let tolerance = || Tolerance {
        relative: 1e-9,
        absolute: [1e-9; 2],
    };
    let held = HeldInputs(cart_pole::Inputs::default());
    let mut one = Stepper::new(
        &system,
        held,
        NoBalance,
        Method::DOP853,
        tolerance(),
        at(),
        1.0,
    )
    .expect("a start");
    let mut other = Stepper::new(
        &system,
        DefaultInputs,
        NoBalance,
        Method::DOP853,
        tolerance(),
        at(),
        1.0,
    )
    .expect("a start");
    one.advance_to(1.0)
        .and(other.advance_to(1.0))
        .expect("a run");
    assert_eq!(
        (one.q(), one.v(), one.work()),
        (other.q(), other.v(), other.work())
    );
}

/// The eccentric anomaly `u` at a given time since the pericentre, from `u − e sin u = t` by Newton's method.
fn anomaly<N: Scalar>(e: N, t: N) -> N {
    let mut u = t;
    for _ in 0..12 {
        u = u - (u - e * u.sin() - t) / (N::ONE - e * u.cos());
    }
    u
}

/// Dense output in 32 digits: its error in the middle of a step is bounded by the order of the step and the order of the
/// interpolant, far below what `f64` resolves.
#[test]
fn dense_output_has_its_order_beyond_the_digits_of_f64() {
    let e = 0.125;
    let number = DoubleDouble::from_f64;
    // Errors within a step are of order `dense_order + 1`; those at its ends are of the order of the method.
    for (method, order, [from, to]) in [
        (Method::DOP853, 8.0, [6, 9]),
        (Method::DOPRI5, 5.0, [8, 11]),
        (Method::BS32, 3.0, [9, 12]),
    ] {
        let error = |halvings: i32| {
            let h = 2.0_f64.powi(-halvings);
            let (machine, start) = orbit::<DoubleDouble>(e);
            let builder = ExplicitStepper::builder(MachineIn::prepare(&machine)).method(method);
            let builder = builder.tolerance(1e30).first_step(h).longest_step(h);
            let mut stepper = builder.start(start).expect("accelerations");
            stepper.advance_to(number(0.25)).expect("a run");
            stepper.advance_to(number(0.25 + h)).expect("a step");
            assert_eq!(stepper.t_before(), number(0.25));
            let t = number(0.25 + 0.5 * h);
            let (_, place) = kepler(number(e), anomaly(number(e), t));
            let state = stepper.state_at(t).expect("it is in the step");
            let q = state.q.to_array();
            let off = [0, 1].map(|i| (q[i] - place[i]).abs().to_f64());
            off[0].max(off[1])
        };
        let errors = [error(from), error(to)];
        let found = (errors[0] / errors[1]).log2() / f64::from(to - from);
        let name = method.tableau.name;
        assert!((found - order).abs() < 0.3, "{name}: {found}, {errors:?}");
    }
}

/// The state at a fixed time within the last step carries correct derivatives: its derivative by a parameter agrees with the
/// variational equations, and its derivative by the end time is zero, although the length of that step depends on the end time.
#[test]
fn dense_output_of_dual_numbers_is_the_derivative_at_a_time() {
    let tolerance = 1e-11;
    let swing = Swing::default();
    let sensitive = Sensitive::new(&swing).by("l").expect("a parameter");
    let run = Simulation::new(&sensitive)
        .tolerance(tolerance)
        .until(2.0)
        .run(sensitive.start())
        .expect("a run");
    let stepper = |machine: &Swing<Dual<f64>>, end: Dual<f64>| {
        let mut stepper = ExplicitStepper::builder(MachineIn::prepare(machine))
            .tolerance(tolerance)
            .start(MachineIn::start(machine))
            .expect("accelerations");
        stepper.advance_to(end).expect("a run");
        stepper
    };
    let mut machine = swing.map(Dual::constant);
    let mut fixed = stepper(&machine, Dual::variable(2.0));
    machine.l = Dual::variable(swing.l);
    let mut varied = stepper(&machine, Dual::constant(2.0));
    let from = varied.t_before().value.max(fixed.t_before().value);
    // Both runs err by the sum of their steps' errors; dense output of order 7 errs by about ten times the error of a step.
    let limit = 1e3 * tolerance * varied.work().steps as f64;
    for part in [0.2, 0.5, 0.9] {
        let t = from + part * (2.0 - from);
        let exact = run.at(t).expect("it is in the run").q.by[0].theta;
        let found = varied
            .state_at(Dual::constant(t))
            .expect("in the step")
            .q
            .theta;
        assert!(
            (found.derivative - exact).abs() < limit,
            "{found:?} {exact}"
        );
        let by_end = fixed.state_at(Dual::constant(t)).expect("in the step");
        assert!(by_end.q.theta.derivative.abs() < limit, "{by_end:?}");
        // At a time that varies, the derivative is the rate.
        let moving = fixed.state_at(Dual::variable(t)).expect("in the step");
        let rate = by_end.v.theta.value;
        assert!(
            (moving.q.theta.derivative - rate).abs() < limit,
            "{moving:?} {rate}"
        );
    }
}

#[test]
fn the_motion_within_a_step_is_told_or_refused() {
    let machine = CartPole::default();
    let mut stepper = ExplicitStepper::builder(Machine::prepare(&machine))
        .start(Machine::start(&machine))
        .expect("accelerations");
    assert!(matches!(
        stepper.interpolant(),
        Err(StepError::OutsideStep { .. })
    ));
    assert_eq!(stepper.state_at(0.0).expect("now"), stepper.state());
    stepper.advance_to(1.0).expect("a run");
    assert!(matches!(
        stepper.state_at(1.5),
        Err(StepError::OutsideStep { to: 1.0, .. })
    ));
    stepper.set_inputs(cart_pole::Inputs { push: 1.0 });
    assert_eq!(
        stepper.interpolant().err(),
        Some(StepError::Changed { t: 1.0 })
    );
}

/// An input law in the numbers of the run gives the bits of the `f64` stepper,
/// and in dual numbers the derivative of machine and controller together.
#[test]
fn a_law_sets_the_inputs_in_every_number() {
    fn gains<N: Real>(
        gain: N,
    ) -> impl Fn(N, &cart_pole::Coordinates<N>, &cart_pole::Coordinates<N>, &mut cart_pole::Inputs<N>)
    {
        move |_t, q, v, u| {
            let number = N::from_f64;
            u.push = gain * q.theta + number(8.0) * v.theta + number(1.5) * q.x + number(3.0) * v.x;
        }
    }
    let machine = CartPole::default();
    let mut start = Machine::start(&machine);
    start.q.theta = 0.2;
    let system = Machine::prepare(&machine);
    let tolerance = Tolerance {
        relative: 1e-11,
        absolute: [1e-11; 2],
    };
    let at = (0.0, start.q.to_array(), start.v.to_array());
    let law = InputFunction(gains(40.0));
    let mut one =
        Stepper::new(&system, law, NoBalance, Method::DOP853, tolerance, at, 2.0).expect("a start");
    one.advance_to(2.0).expect("a run");
    let controlled = |gain: f64| {
        let mut stepper = ExplicitStepper::builder(Machine::prepare(&machine))
            .tolerance(1e-11)
            .input_law(InputFunction(gains(gain)))
            .start(start)
            .expect("accelerations");
        stepper.advance_to(2.0).expect("a run");
        stepper
    };
    let other = controlled(40.0);
    assert_eq!(
        (one.q(), one.v(), one.work()),
        (other.q(), other.v(), other.work())
    );
    let [q, v] = [other.q(), other.v()];
    let push = 40.0 * q[1] + 8.0 * v[1] + 1.5 * q[0] + 3.0 * v[0];
    assert_eq!(other.inputs().push, push);

    let in_duals = machine.map(Dual::constant);
    let mut from = MachineIn::start(&in_duals);
    from.q.theta = Dual::constant(0.2);
    let mut dual = ExplicitStepper::builder(MachineIn::prepare(&in_duals))
        .tolerance(1e-11)
        .input_law(InputFunction(gains(Dual::variable(40.0))))
        .start(from)
        .expect("accelerations");
    dual.advance_to(Dual::constant(2.0)).expect("a run");
    // The error of a central difference with increment 0.01 is 1e-4/6 of the third derivative, which a gain of 40 makes small.
    let quotient = (controlled(40.01).q()[1] - controlled(39.99).q()[1]) / 0.02;
    let found = dual.q()[1].derivative;
    assert!(
        (found - quotient).abs() < 1e-6 * (1.0 + quotient.abs()),
        "{found} {quotient}"
    );
}

#[test]
fn the_way_to_a_time_has_so_many_steps() {
    let machine = CartPole::default();
    let mut start = Machine::start(&machine);
    start.v.x = 1e300;
    let mut stepper = ExplicitStepper::builder(Machine::prepare(&machine))
        .max_steps(100)
        .start(start)
        .expect("accelerations");
    let error = stepper.advance_to(1.0).expect_err("steps are short");
    assert!(
        matches!(error, StepError::TooManySteps { steps: 100, .. }),
        "{error}"
    );
    assert_eq!(stepper.work().steps, 100);
}
