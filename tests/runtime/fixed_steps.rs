//! Methods with steps of a fixed length: their orders, their invariants, and the machines that they refuse.

use crate::by_hand::constrained::{self, Constrained};
use crate::by_hand::double_pendulum::{DoublePendulum, DoublePendulumCoordinates};
use crate::by_hand::toy::{Toy, oscillator};
use lagrangian::{
    Error, FIXED_STEP_METHODS, Machine, Method, Quantity, Simulation, Singular, State, Stepper,
    System,
};

fn method(name: &str) -> &'static Method {
    Method::named(name).expect("it is listed")
}

/// A particle of 1 kg in a plane, braked by `drag` times its velocity. Its coordinates are `x`, its distance from the origin
/// divided by `σ = 1 + 0.3 t`, and the angle `θ` from an axis that turns at `Ω`. So the mass matrix depends on position and time,
/// and the bias has terms of degree two, one and zero in the rates.
#[derive(Clone, Copy, Debug)]
struct Turning {
    drag: f64,
}

const GROWTH: f64 = 0.3;
const TURN: f64 = 0.7;

/// `σ`, and the velocity along the radius and across it.
fn velocity(t: f64, [x, _]: &[f64; 2], [dx, turn]: &[f64; 2]) -> [f64; 3] {
    let scale = 1.0 + GROWTH * t;
    [scale, scale * dx + GROWTH * x, scale * x * (turn + TURN)]
}

impl Turning {
    /// Started at `(1, 0)` with the velocity `(0, 1)`, the particle moves straight to `(1, s)`, `s = (1 − e^(−c t))/c`.
    fn exact(&self, t: f64) -> [f64; 2] {
        let s = match self.drag {
            0.0 => t,
            c => -(-c * t).exp_m1() / c,
        };
        [
            (1.0 + s * s).sqrt() / (1.0 + GROWTH * t),
            s.atan() - TURN * t,
        ]
    }

    /// The greatest error of a coordinate.
    fn error(&self, t: f64, q: &[f64; 2]) -> f64 {
        let exact = self.exact(t);
        (q[0] - exact[0]).abs().max((q[1] - exact[1]).abs())
    }
}

impl Machine for Turning {
    type System = Self;

    fn name(&self) -> &str {
        "Turning"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn prepare(&self) -> Self {
        *self
    }

    fn start(&self) -> State<[f64; 2]> {
        State {
            t: 0.0,
            q: [1.0, 0.0],
            v: [-GROWTH, 1.0 - TURN],
        }
    }
}

impl System for Turning {
    type Vector = [f64; 2];
    type Matrix = [f64; 4];
    type Coordinates = [f64; 2];
    type Inputs = ();
    type Outputs = ();

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        [Quantity::new("x", "m"), Quantity::new("theta", "rad")].into_iter()
    }

    fn to_coordinates(&self, vector: &[f64; 2]) -> [f64; 2] {
        *vector
    }

    fn to_vector(&self, coordinates: &[f64; 2]) -> [f64; 2] {
        *coordinates
    }

    fn accelerations(
        &self,
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        u: &(),
        a: &mut [f64; 2],
    ) -> Result<(), Singular> {
        let (mut matrix, mut bias) = ([0.0; 4], [0.0; 2]);
        self.mass_matrix(t, q, &mut matrix);
        self.bias(t, q, v, &mut bias);
        self.applied(t, q, v, u, a);
        *a = [(a[0] - bias[0]) / matrix[0], (a[1] - bias[1]) / matrix[3]];
        Ok(())
    }

    fn mass_matrix(&self, t: f64, q: &[f64; 2], matrix: &mut [f64; 4]) {
        let scale = 1.0 + GROWTH * t;
        *matrix = [scale * scale, 0.0, 0.0, scale * scale * q[0] * q[0]];
    }

    fn bias(&self, t: f64, q: &[f64; 2], v: &[f64; 2], bias: &mut [f64; 2]) {
        let [scale, along, across] = velocity(t, q, v);
        let turn = v[1] + TURN;
        *bias = [
            scale * (2.0 * GROWTH * v[0] - across * turn),
            2.0 * scale * q[0] * along * turn,
        ];
    }

    fn applied(&self, t: f64, q: &[f64; 2], v: &[f64; 2], (): &(), applied: &mut [f64; 2]) {
        let [scale, along, across] = velocity(t, q, v);
        *applied = [along, across * q[0]].map(|rate| -self.drag * scale * rate);
    }

    fn kinetic_energy(&self, t: f64, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        let [_, along, across] = velocity(t, q, v);
        0.5 * (along * along + across * across)
    }

    fn potential_energy(&self, _: f64, _: &[f64; 2], (): &()) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, t: f64, q: &[f64; 2], v: &[f64; 2], (): &()) -> f64 {
        2.0 * self.drag * self.kinetic_energy(t, q, v)
    }

    fn default_inputs(&self) {}

    fn outputs(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 2], (): &()) {}
}

/// Two step lengths, the second half the first, whose errors are far above rounding.
fn lengths(method: &Method) -> [f64; 2] {
    let h = match method.tableau.order {
        1 | 2 => 1.0 / 64.0,
        4 => 1.0 / 16.0,
        6 => 0.25,
        _ => 0.5,
    };
    [h, 0.5 * h]
}

/// The error of a method of order `p` falls by `2^p` when the steps are halved, up to terms of higher order.
fn check_order(name: &str, what: &str, order: u32, [of_h, of_half]: [f64; 2]) {
    let found = (of_h / of_half).log2();
    let floor = 1e-13;
    assert!(of_half > floor, "{name}, {what}: {of_half:e} is rounding");
    assert!(
        (-0.5..1.0).contains(&(found - f64::from(order))),
        "{name}, {what}: {of_h:e} and {of_half:e} fall with the power {found}, and not {order}"
    );
}

#[test]
fn each_method_has_its_order_where_inertia_changes_with_place_and_time() {
    let machine = Turning { drag: 0.5 };
    for method in &FIXED_STEP_METHODS {
        let errors = lengths(method).map(|h| {
            let mut stepper = Stepper::builder(machine)
                .method(method)
                .longest_step(h)
                .start(machine.start())
                .unwrap();
            stepper.advance_to(2.0).unwrap();
            machine.error(2.0, stepper.q())
        });
        check_order(method.tableau.name, "the end", method.tableau.order, errors);
    }
}

/// The residuals of the energy balance with steps of two lengths fall with the order of the method.
fn check_books<M: Machine>(
    machine: &M,
    method: &'static Method,
    (lengths, until): ([f64; 2], f64),
) {
    let residuals = lengths.map(|h| {
        let run = Simulation::new(machine)
            .method(method)
            .longest_step(h)
            .until(until)
            .energy_balance(true)
            .run(machine.start())
            .unwrap();
        run.energy_balance().unwrap().residual().abs()
    });
    let Method { tableau, .. } = method;
    check_order(tableau.name, "the books", tableau.order, residuals);
}

/// Without drag the particle keeps its energy; with drag the energy balance accounts for the loss.
#[test]
fn the_books_close_with_the_order_of_the_method() {
    let machine = Turning { drag: 0.5 };
    for method in &FIXED_STEP_METHODS {
        check_books(&machine, method, (lengths(method), 2.0));
    }
}

/// Lengths of steps in which the leading term of the error dominates and exceeds round-off, for constraints whose motions have periods of about 2 s.
fn lengths_with_constraints(method: &Method) -> [f64; 2] {
    let h = match method.tableau.order {
        1 | 2 => 1.0 / 128.0,
        4 => 1.0 / 32.0,
        6 => 1.0 / 16.0,
        _ => 1.0 / 8.0,
    };
    [h, 0.5 * h]
}

/// A winch does work on its load by the reaction of a moving constraint.
#[test]
fn the_books_of_moving_constraints_close_with_the_order_of_the_method() {
    let machine = constrained::winch();
    for method in &FIXED_STEP_METHODS {
        let lengths = lengths_with_constraints(method);
        check_books(&machine, method, (lengths, 1.0));
    }
}

/// Within a step, the motion is the quintic or the cubic through its ends.
#[test]
fn the_motion_within_steps_is_of_the_order_that_is_stated() {
    let machine = Turning { drag: 0.0 };
    for name in ["gauss6", "gauss8", "rk4"] {
        let method = method(name);
        let errors = [0.125, 0.0625].map(|h| {
            let run = Simulation::new(&machine)
                .method(method)
                .longest_step(h)
                .until(2.0)
                .run(machine.start())
                .unwrap();
            let at = |part: f64| {
                let t = 1.0 + part * h;
                machine.error(t, &run.at(t).unwrap().q)
            };
            at(0.3).max(at(0.6))
        });
        let found = (errors[0] / errors[1]).log2();
        let least = f64::from(method.tableau.dense_order) + 0.5;
        assert!(
            found > least,
            "{name}: {errors:?} fall with the power {found}"
        );
    }
}

fn pendulum() -> (DoublePendulum, State<DoublePendulumCoordinates>) {
    let machine = DoublePendulum::default();
    let mut start = machine.start();
    (start.q.theta1, start.q.theta2) = (0.3, 0.5);
    (machine, start)
}

/// The largest error of the energy in each quarter of a long run.
fn errors_of_energy(name: &str, h: f64, steps: usize) -> [f64; 4] {
    let (machine, start) = pendulum();
    let system = machine.prepare();
    let mut stepper = Stepper::builder(machine.prepare())
        .method(method(name))
        .longest_step(h)
        .start(start)
        .unwrap();
    let energy = |q: &[f64; 2], v: &[f64; 2]| {
        system.kinetic_energy(0.0, q, v) + system.potential_energy(0.0, q, &system.default_inputs())
    };
    let at_start = energy(stepper.q(), stepper.v());
    stepper.set_end(h * steps as f64);
    let mut worst = [0.0_f64; 4];
    for step in 0..steps {
        stepper.step().unwrap();
        let error = (energy(stepper.q(), stepper.v()) - at_start).abs();
        let quarter = &mut worst[4 * step / steps];
        *quarter = quarter.max(error);
    }
    worst
}

/// The mass matrix of the double pendulum depends on its position, so the energy would drift with a method that is symplectic in
/// the rates instead of the momenta.
#[test]
fn the_energy_of_symplectic_methods_does_not_drift() {
    for name in ["gauss4", "gauss6", "gauss8", "rattle"] {
        let [first, .., last] = errors_of_energy(name, 0.05, 4000);
        assert!(last < 1.2 * first, "{name}: {first:e} J, then {last:e} J");
    }
    // The comparison shows that the test can detect drift: with `rk4` each quarter adds as much.
    let [first, .., last] = errors_of_energy("rk4", 0.05, 4000);
    assert!(last > 3.0 * first, "rk4: {first:e} J, then {last:e} J");
}

#[test]
fn symmetric_methods_come_back_to_the_start() {
    let (machine, start) = pendulum();
    for name in ["gauss4", "gauss6", "gauss8", "rattle"] {
        let mut stepper = Stepper::builder(machine.prepare())
            .method(method(name))
            .longest_step(0.0625)
            .start(start)
            .unwrap();
        stepper.advance_to(10.0).unwrap();
        let away = (stepper.q()[0] - 0.3).abs();
        assert!(away > 1e-3, "{name}: it has moved");
        stepper.advance_to(0.0).unwrap();
        // Rounding in 320 steps, amplified by this motion at most ten times.
        let limit = 320.0 * 10.0 * f64::EPSILON;
        for (y, exact) in [
            (stepper.q()[0], 0.3),
            (stepper.q()[1], 0.5),
            (stepper.v()[0], 0.0),
            (stepper.v()[1], 0.0),
        ] {
            assert!((y - exact).abs() < limit, "{name}: {y} and not {exact}");
        }
    }
}

/// A spherical pendulum of 1 m and 1 kg, whose rod is a constraint.
fn spherical() -> Constrained<3, 1, 9> {
    Constrained {
        coordinates: [("x", "m"), ("y", "m"), ("z", "m")],
        constraints: [("rod", true)],
        p: 9.81,
        start: ([0.6, 0.0, -0.8], [0.0, 1.5, 0.0]),
        mass: [1.0; 3],
        forces: |_, _, _, g| [0.0, 0.0, -g],
        positions: |_, q, _| [0.5 * (q.iter().map(|x| x * x).sum::<f64>() - 1.0)],
        matrix: |_, q, _| [*q],
        by_time: |_, _, _| [0.0],
        constraint_bias: |_, _, v, _| [-v.iter().map(|v| v * v).sum::<f64>()],
        potential_energy: |q, g| g * q[2],
        on_stack: true,
    }
}

#[test]
fn symplectic_methods_keep_constraints_and_the_momenta_of_symmetries_to_rounding() {
    for name in ["rattle", "gauss4", "gauss6", "gauss8"] {
        keeps_constraints_and_momenta(method(name));
    }
}

fn keeps_constraints_and_momenta(method: &'static Method) {
    let machine = spherical();
    // At order 8 a longer step, in which the error of the energy exceeds round-off.
    let (h, steps) = match method.tableau.order {
        8 => (0.1, 1000),
        _ => (0.02, 5000),
    };
    let mut stepper = Stepper::builder(machine.prepare())
        .method(method)
        .longest_step(h)
        .start(machine.start())
        .unwrap();
    stepper.set_end(h * f64::from(steps));
    let energy =
        |q: &[f64; 3], v: &[f64; 3]| 0.5 * v.iter().map(|v| v * v).sum::<f64>() + 9.81 * q[2];
    let at_start = energy(stepper.q(), stepper.v());
    let mut worst = [0.0_f64; 2];
    for step in 0..steps {
        stepper.step().unwrap();
        let (q, v) = (stepper.q(), stepper.v());
        // The angular momentum is 0.9 kg m²/s.
        let momentum = q[0] * v[1] - q[1] * v[0];
        let limit = f64::EPSILON * (16.0 + 4.0 * f64::from(step));
        assert!((momentum - 0.9).abs() < limit, "{step}: {momentum}");
        let length: f64 = q.iter().map(|x| x * x).sum();
        let along: f64 = q.iter().zip(v).map(|(q, v)| q * v).sum();
        assert!((length - 1.0).abs() < 1e-14, "{step}: {length}");
        assert!(along.abs() < 1e-13, "{step}: {along}");
        let half = usize::from(2 * step >= steps);
        worst[half] = worst[half].max((energy(q, v) - at_start).abs());
    }
    assert!(worst[1] < 1.2 * worst[0], "{worst:?} J");
}

/// Machines with stationary constraints and one with a moving constraint, compared with the default method at its finest tolerance.
#[test]
fn methods_with_constraints_have_their_order() {
    fn check<const N: usize, const M: usize, const NN: usize>(machine: &Constrained<N, M, NN>) {
        let run = |method: &'static Method, h: f64, tolerance: f64| {
            let run = Simulation::new(machine)
                .method(method)
                .longest_step(h)
                .tolerance(tolerance)
                .until(1.0)
                .run(machine.start());
            run.unwrap().end().q
        };
        let exact = run(Method::DOP853, f64::INFINITY, 1e-13);
        for method in &FIXED_STEP_METHODS {
            let errors = lengths_with_constraints(method).map(|h| {
                let q = run(method, h, 1e-13);
                let errors = q.iter().zip(&exact).map(|(q, exact)| (q - exact).abs());
                errors.fold(0.0, f64::max)
            });
            let Method { tableau, .. } = method;
            check_order(tableau.name, "constraints", tableau.order, errors);
        }
    }
    check(&spherical());
    check(&constrained::winch());
}

/// For `x″ = −ω² x` with `ω h = 1000`, generalized-α keeps 0.8 of the amplitude in each step.
#[test]
fn generalized_alpha_damps_what_is_too_fast_for_its_steps() {
    let stiff = Toy {
        p: 1e4,
        ..oscillator()
    };
    let run = |name: &str| {
        let mut stepper = Stepper::builder(stiff)
            .method(method(name))
            .longest_step(0.1)
            .start(stiff.start())
            .unwrap();
        stepper.advance_to(10.0).map(|()| stepper.q()[0])
    };
    let left = run("generalized-alpha").unwrap();
    // Two eigenvalues of modulus 0.8 are nearly equal, so the amplitude is at most 100² times 0.8¹⁰⁰.
    assert!(left.abs() < 1e4 * 0.8_f64.powi(100), "{left:e}");
    // An explicit method grows without bound, which shows that the test can tell.
    assert!(!run("rk4").is_ok_and(|x| x.abs() <= 1.0));
}

/// The force `push`, in N, on a mass of 1 kg that dry friction of 0.1 N brakes.
fn rubbed(push: f64, rate: f64) -> Toy<1> {
    Toy {
        p: push,
        ..Toy::new(([0.0], [rate]), |t, _, v, _, push| {
            let sign = if v[0] == 0.0 { 0.0 } else { v[0].signum() };
            [push * (0.2 * t).cos() - 0.1 * sign]
        })
    }
}

/// Generalized-α from rest where the force jumps: `x' = 5 p sin 0.2t − 0.1 t` while that is positive. At the jump a difference quotient is that
/// of a very stiff damper, and no iteration with it moves anything: the mass stayed behind by its whole motion.
#[test]
fn generalized_alpha_keeps_its_order_from_a_force_that_jumps_at_rest() {
    let errors = [0.1, 0.05].map(|h| {
        let run = Simulation::new(&rubbed(0.3, 0.0))
            .method(method("generalized-alpha"))
            .longest_step(h)
            .tolerance(1e-9)
            .until(5.0)
            .run(rubbed(0.3, 0.0).start())
            .unwrap();
        let exact = 7.5 * (1.0 - 1.0_f64.cos()) - 1.25;
        (run.end().q[0] - exact).abs()
    });
    check_order("generalized-alpha", "from a jump", 2, errors);
}

/// Dry friction of 0.1 N holds a mass that 0.05 N push, and one that 0.3 N brake turns with other accelerations before and after. No step of
/// any length ends on a jump, and the message does not ask for shorter ones.
#[test]
fn generalized_alpha_says_that_it_cannot_end_a_step_on_a_jump() {
    let run = |machine: Toy<1>, h: f64| {
        Simulation::new(&machine)
            .method(method("generalized-alpha"))
            .longest_step(h)
            .until(5.0)
            .run(machine.start())
            .map(|run| run.end().q[0])
    };
    for h in [1e-1, 1e-2, 1e-3] {
        let said = run(rubbed(0.05, 0.0), h).unwrap_err().to_string();
        assert!(
            said.contains("`sliding`") && !said.contains("take shorter"),
            "{h}: {said}"
        );
    }
    // Whether a step ends where no acceleration satisfies its equations depends on where steps end.
    let mut refused = 0;
    for part in 0..20 {
        let machine = rubbed(-0.3, 1.0 + 1e-4 * f64::from(part));
        match run(machine, 1e-2) {
            Err(error) => {
                assert!(error.to_string().contains("`sliding`"), "{error}");
                refused += 1;
            }
            Ok(x) => {
                // Turns at the root of v₀ − 1.5 sin 0.2t − 0.1 t, and then goes back with friction the other way.
                let v = machine.start.1[0];
                let rate = |t: f64| v - 1.5 * (0.2 * t).sin() - 0.1 * t;
                let turn = (0..60).fold([0.0, 5.0], |[a, b], _| {
                    let middle = 0.5 * (a + b);
                    if rate(middle) > 0.0 {
                        [middle, b]
                    } else {
                        [a, middle]
                    }
                })[0];
                let place = |t: f64, v: f64, friction: f64| {
                    v * t + 7.5 * ((0.2 * t).cos() - 1.0) + 0.5 * friction * t * t
                };
                let left = 5.0 - turn;
                let exact = place(turn, v, -0.1)
                    + 7.5 * (1.0_f64.cos() - (0.2 * turn).cos())
                    + 1.5 * (0.2 * turn).sin() * left
                    + 0.05 * left * left;
                // The step in which it turns has the wrong friction for a part of it: 0.2 h for 5 s at most.
                assert!((x - exact).abs() <= 0.2 * 1e-2 * 5.0, "{part}: {x} {exact}");
            }
        }
    }
    assert!(refused > 0);
}

#[test]
fn what_a_method_of_fixed_steps_cannot_follow_is_refused() {
    for name in ["rattle", "gauss6"] {
        let twice = constrained::circle::<2>();
        let run = Simulation::new(&twice)
            .method(method(name))
            .longest_step(1e-2)
            .until(1.0);
        let said = run.run(twice.start()).unwrap_err().to_string();
        assert!(said.contains("depend on each other"), "{said}");

        let sleigh = constrained::sleigh();
        let run = Simulation::new(&sleigh)
            .method(method(name))
            .longest_step(1e-2)
            .until(1.0);
        let said = run.run(sleigh.start()).unwrap_err().to_string();
        assert!(said.contains("constraints on rates"), "{said}");
    }

    // A system by hand that does not provide its mass matrix.
    let toy = oscillator();
    for name in ["gauss4", "rattle"] {
        let run = Simulation::new(&toy)
            .method(method(name))
            .longest_step(1e-2)
            .until(1.0);
        let said = run.run(toy.start()).unwrap_err().to_string();
        assert!(said.contains("mass matrix"), "{said}");
    }

    let run = Simulation::new(&toy).method(method("rk4")).until(1.0);
    let error = run.run(toy.start()).unwrap_err();
    let is_meant = matches!(
        &error,
        Error::InvalidSetting {
            setting: "longest_step",
            ..
        }
    );
    assert!(is_meant, "{error}");
}

/// If a step is too long for fixed-point iteration, the step fails with an error.
#[test]
fn stages_that_are_not_found_are_told() {
    let machine = DoublePendulum {
        g: 1e6,
        ..Default::default()
    };
    let mut start = machine.start();
    (start.q.theta1, start.q.theta2) = (0.3, 0.5);
    let mut stepper = Stepper::builder(machine.prepare())
        .method(method("gauss6"))
        .longest_step(1.0)
        .start(start)
        .unwrap();
    let error = stepper.advance_to(2.0).unwrap_err().to_string();
    assert!(error.contains("take shorter steps"), "{error}");
    assert_eq!(stepper.t(), 0.0);
    assert_eq!(stepper.q(), &[0.3, 0.5]);
}
