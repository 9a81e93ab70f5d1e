//! Variants of the crusher: one with two debalances that shake along a line, and one driven by a
//! motor whose speed is free.

use lagrangian::{Coordinates, Machine, Simulation, Solution, State};
use lagrangian_machines::{
    FrozenCrusher, MotorCrusher, TwoDebalanceCrusher, VibratingCrusher, frozen_crusher,
};

const TOLERANCE: f64 = 1e-10;

fn run<M: Machine>(machine: &M, start: State<Coordinates<M>>, until: f64) -> Solution<M> {
    Simulation::new(machine)
        .tolerance(TOLERANCE)
        .energy_balance(true)
        .until(until)
        .run(start)
        .unwrap()
}

/// The bound on the sum of the errors of a run: each step errs by the tolerance at most, and the
/// oscillators are damped.
fn drift<M: Machine>(run: &Solution<M>) -> f64 {
    run.statistics().steps as f64 * TOLERANCE
}

/// The frozen crusher after 0.06 s, coordinates and then rates, computed by extrapolation
/// in quadruple precision. By then the mortar's centre has passed the platform's at a
/// distance of 2 mm, at 200 rad/s.
const FROZEN_AT_60_MS: [f64; 18] = [
    5.122_159_817_223_441e-3,
    2.739_762_041_120_331e-2,
    1.212_784_420_417_975_5e-3,
    2.649_821_689_009_802e-2,
    -1.436_679_207_135_935,
    0.16,
    8.982_204_629_154_248e-3,
    -0.598_237_655_679_712_9,
    -0.32,
    -0.195_504_489_749_138_77,
    0.728_664_273_208_062,
    0.187_242_183_436_155_45,
    0.762_548_679_289_872_3,
    6.030_085_791_713_851,
    1.0,
    -0.013_582_411_562_410_19,
    3.718_393_653_941_497_3,
    -2.0,
];

#[test]
fn the_frozen_crusher_goes_where_a_higher_precision_says() {
    let crusher = FrozenCrusher::default();
    let q = [0.0, 0.0, 0.0, 5e-3, 0.3, 0.1, 0.01, -0.8, -0.2];
    let v = [0.02, -0.03, 0.01, 0.05, 2.0, 1.0, -0.02, 3.0, -2.0];
    let start = State {
        q: frozen_crusher::Coordinates::from_array(q),
        v: frozen_crusher::Coordinates::from_array(v),
        ..crusher.start()
    };
    const FINE: f64 = 1e-13;
    let simulation = Simulation::new(&crusher).tolerance(FINE).until(0.06);
    let run = simulation.run(start).unwrap();
    let drift = run.statistics().steps as f64 * FINE;
    let (q, v) = (run.end().q.to_array(), run.end().v.to_array());
    for (found, exact) in q.iter().chain(&v).zip(FROZEN_AT_60_MS) {
        // At a distance of 2 mm an error of position becomes an error of the angle 500 times as
        // large. The exact machine differs by a thousand times that.
        let limit = 500.0 * drift * (1.0 + exact.abs());
        assert!((found - exact).abs() <= limit, "{found} instead of {exact}");
    }
}

/// `x` at `t` of `M x″ + B x′ + K x = F cos ωt`, started at rest at 0: the steady oscillation minus
/// the free one with the same initial values.
fn oscillator([mass, damping, stiffness, force, omega]: [f64; 5], t: f64) -> f64 {
    let detuned = stiffness - mass * omega * omega;
    let lossy = damping * omega;
    let squared = detuned * detuned + lossy * lossy;
    let (cosine, sine) = (force * detuned / squared, force * lossy / squared);
    let decay = damping / (2.0 * mass);
    let free = (stiffness / mass - decay * decay).sqrt();
    let steady = cosine * (omega * t).cos() + sine * (omega * t).sin();
    let amplitude = (decay * cosine + omega * sine) / free;
    steady - (-decay * t).exp() * (cosine * (free * t).cos() + amplitude * (free * t).sin())
}

#[test]
fn two_debalances_shake_along_their_line_and_nowhere_else() {
    let crusher = TwoDebalanceCrusher::default();
    let start = crusher.start();
    let run = run(&crusher, start, 3.0);
    let force = 2.0 * crusher.m0 * crusher.e * crusher.omega.powi(2);
    let line = [
        crusher.m + 2.0 * crusher.m0,
        2.0 * crusher.bx,
        2.0 * crusher.cx,
        force,
        crusher.omega,
    ];
    // The rounding of two forces that cancel, as a displacement of the springs and as
    // a rotation about the centre.
    let rounding = 10.0 * f64::EPSILON;
    let across = rounding * force / (2.0 * crusher.cy);
    let spring = 2.0 * (crusher.cx * crusher.yc.powi(2) + crusher.cy * crusher.xc.powi(2));
    let turned = rounding * force * crusher.x0.hypot(crusher.y0) / spring;
    let mut farthest = 0.0_f64;
    for state in run.every(0.01).unwrap() {
        let exact = oscillator(line, state.t);
        farthest = farthest.max(exact.abs());
        let q = state.q;
        assert!((q.x - exact).abs() <= drift(&run), "{}: {}", state.t, q.x);
        // Mortar and pestle stay at rest in space.
        assert!((q.s1 + q.x - start.q.s1).abs() <= drift(&run));
        assert!((q.s2 - start.q.s2).abs() <= drift(&run));
        assert!(q.y.abs() <= across && q.theta.abs() <= turned);
        assert!((q.s1 * q.phi1).abs() <= across && (q.s2 * q.phi2).abs() <= across);
    }
    assert!(farthest > 6e-3 && farthest < start.q.s1);
}

#[test]
fn two_debalances_turn_the_platform_unless_they_lie_alike() {
    // Turned out of the line, the machine is not mirror-symmetric.
    let crusher = TwoDebalanceCrusher::default();
    let mut start = crusher.start();
    start.q.theta = 0.01;
    let run = run(&crusher, start, 1.0);
    let states = run.every(0.01).unwrap();
    assert!(states.iter().any(|state| state.q.y.abs() > 1e-6));
}

/// A motor crusher with its debalance at the centre and the mortar far from the platform.
fn centred(breakdown: f64) -> (MotorCrusher, State<Coordinates<MotorCrusher>>) {
    let crusher = MotorCrusher {
        x0: 0.0,
        y0: 0.0,
        Mk: breakdown,
        ..Default::default()
    };
    let mut start = crusher.start();
    start.q.s1 = 0.2;
    (crusher, start)
}

/// Kloss's formula for the torque, in his form.
fn torque(crusher: &MotorCrusher, speed: f64) -> f64 {
    let slip = (crusher.omega - speed) / crusher.omega;
    2.0 * crusher.Mk / (slip / crusher.sk + crusher.sk / slip)
}

/// The radius of the circle on which a debalance at the centre, turning at
/// constant speed, drives the platform.
fn radius(crusher: &MotorCrusher, speed: f64) -> f64 {
    let detuned = 2.0 * crusher.cx - (crusher.m + crusher.m0) * speed * speed;
    crusher.m0 * crusher.e * speed * speed / detuned.hypot(2.0 * crusher.bx * speed)
}

/// The torque that drives this motion.
fn load(crusher: &MotorCrusher, speed: f64) -> f64 {
    2.0 * crusher.bx * speed * radius(crusher, speed).powi(2)
}

/// The lowest speed above which the motor's torque no longer exceeds the load.
fn steady_speed(crusher: &MotorCrusher) -> f64 {
    let spare = |speed: f64| torque(crusher, speed) - load(crusher, speed);
    let speeds = (1..10_000).map(|k| crusher.omega * f64::from(k) * 1e-4);
    let mut above = speeds
        .clone()
        .find(|&speed| spare(speed) <= 0.0)
        .expect("it has no torque at the synchronous speed");
    let mut below = above - crusher.omega * 1e-4;
    while above - below > 4.0 * f64::EPSILON * above {
        let middle = 0.5 * (below + above);
        if spare(middle) > 0.0 {
            below = middle;
        } else {
            above = middle;
        }
    }
    above
}

/// Runs up, and compares the mean speed and the distance of the platform's centre from its rest
/// position with those of the steady motion.
fn check_steady(breakdown: f64) -> f64 {
    let (crusher, start) = centred(breakdown);
    let run = run(&crusher, start, 20.0);
    let speed = steady_speed(&crusher);
    let mean = |from: f64, to: f64| {
        let [a, b] = [from, to].map(|t| run.at(t).unwrap().q.psi);
        (b - a) / (to - from)
    };
    // The transient of running up decays by the same factor in each second.
    let (before, last) = (mean(18.0, 19.0), mean(19.0, 20.0));
    let limit = 2.0 * (before - last).abs() + drift(&run);
    assert!(
        (last - speed).abs() <= limit,
        "{last} instead of {speed}, {limit:e}"
    );
    assert!(limit < 1e-5 * speed, "not steady yet: {limit:e}");
    let end = run.end().q;
    let circle = radius(&crusher, speed);
    assert!((end.x.hypot(end.y) - circle).abs() <= circle * limit);
    speed / crusher.omega
}

#[test]
fn a_motor_runs_at_the_speed_where_its_torque_is_the_load() {
    assert!(check_steady(400.0) > 0.9);
}

#[test]
fn a_weak_motor_hangs_at_resonance() {
    // At full speed the weak motor would suffice, as the load is lower there than at resonance.
    let (weak, _) = centred(120.0);
    assert!(load(&weak, 0.95 * weak.omega) < torque(&weak, 0.95 * weak.omega));
    assert!(check_steady(120.0) < 0.25);
}

#[test]
fn what_the_motor_gives_is_what_the_machine_gets() {
    // The debalance is off the centre, so that speed and torque vary within each revolution.
    let crusher = MotorCrusher::default();
    let run = run(&crusher, crusher.start(), 5.0);
    let balance = run.energy_balance().unwrap();
    assert!(balance.relative().abs() <= 1e-8, "{balance:?}");
    // Computes the work again by Simpson's rule over each hundredth of a revolution.
    let power = |t: f64| {
        let speed = run.at(t).unwrap().v.psi;
        torque(&crusher, speed) * speed
    };
    const INTERVALS: u32 = 12_500;
    let width = 5.0 / f64::from(INTERVALS);
    let work: f64 = (0..INTERVALS)
        .map(|k| {
            let t = f64::from(k) * width;
            width / 6.0 * (power(t) + 4.0 * power(t + 0.5 * width) + power(t + width))
        })
        .sum();
    assert!(balance.dissipated > 1e3);
    // Simpson's rule errs by (width/2)⁴/180 times the fourth derivative: relative to the
    // varying part of the power by (ω width/2)⁴/180, and by 16 times that for the second
    // harmonic of the debalance's force.
    let share = 16.0 * (0.5 * crusher.omega * width).powi(4) / 180.0;
    assert!((work - balance.work).abs() <= share * balance.work + drift(&run) * balance.work);
}

#[test]
fn a_strong_motor_turns_as_told() {
    const FINE: f64 = 1e-13;
    const UNTIL: f64 = 0.5;
    let told = VibratingCrusher::default();
    let simulation = Simulation::new(&told).tolerance(FINE).until(UNTIL);
    let told = simulation.run(told.start()).unwrap();
    // The distance of the platform's centre from its position with prescribed speed, the angle by
    // which the debalance is behind, and the error of the distance.
    let off = |breakdown: f64| {
        let crusher = MotorCrusher {
            Mk: breakdown,
            ..Default::default()
        };
        let mut start = crusher.start();
        start.v.psi = crusher.omega;
        let simulation = Simulation::new(&crusher).tolerance(FINE).until(UNTIL);
        let run = simulation.run(start).unwrap();
        let (motor, told) = (run.end().q, told.end().q);
        let distance = (motor.x - told.x).hypot(motor.y - told.y);
        let error = run.statistics().steps as f64 * FINE;
        (distance, (motor.psi - crusher.omega * UNTIL).abs(), error)
    };
    // The load turns the debalance back by an angle that is inversely proportional to the torque:
    // ten times the torque gives a tenth of the distance, up to the square of the angle.
    let ((near, angle, _), (nearer, _, error)) = (off(1e5), off(1e6));
    let limit = 10.0 * (angle + 2.0 * error / nearer);
    assert!(limit < 1.0 && nearer > 0.0);
    let ratio = near / nearer;
    assert!((ratio - 10.0).abs() <= limit, "{ratio}, {limit}");
}
