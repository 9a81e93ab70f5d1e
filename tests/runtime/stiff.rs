//! Stiff machines integrated by `radau5`, tested against closed forms and against the rigid machines that they tend to.

use crate::by_hand::constrained::Constrained;
use crate::by_hand::toy::{Toy, pendulum};
use lagrangian::{
    Crossing, DefaultInputs, Machine, Method, NoBalance, RADAU_OF_HIGH_ORDER, Simulation, Solution,
    Stepper, Tolerance, Warning,
};
use std::f64::consts::PI;

fn radau5() -> &'static Method {
    Method::named("radau5").expect("it is listed")
}

fn run<M: Machine>(machine: &M, tolerance: f64, until: f64) -> Solution<M> {
    run_by(radau5(), machine, tolerance, until)
}

fn run_by<M: Machine>(
    method: &'static Method,
    machine: &M,
    tolerance: f64,
    until: f64,
) -> Solution<M> {
    Simulation::new(machine)
        .method(method)
        .tolerance(tolerance)
        .until(until)
        .energy_balance(true)
        .run(machine.start())
        .expect("it runs")
}

/// The bound on the sum of the errors of all steps, each of which is at most `tolerance`.
fn limit<M: Machine>(run: &Solution<M>, tolerance: f64) -> f64 {
    run.statistics().steps as f64 * tolerance
}

/// Derivatives by differences have half the digits, so each iteration of Newton's method leaves that fraction of the
/// error, even in a linear machine.
fn roundoff_of_differences() -> f64 {
    2.0 * f64::EPSILON.sqrt()
}

/// One step of length `h`, with a tolerance as large as the motion itself.
fn one_step(machine: &Toy<1>, h: f64) -> [f64; 2] {
    one_step_by(radau5(), machine, h)
}

fn one_step_by(method: &'static Method, machine: &Toy<1>, h: f64) -> [f64; 2] {
    let tolerance = Tolerance {
        relative: 1.0,
        absolute: [1.0],
    };
    let start = (0.0, machine.start.0, machine.start.1);
    let mut stepper = Stepper::new(
        machine,
        DefaultInputs,
        NoBalance,
        method,
        tolerance,
        start,
        h,
    )
    .unwrap();
    stepper.set_first_step(h);
    stepper.step().unwrap();
    assert!(stepper.is_done());
    [stepper.q()[0], stepper.v()[0]]
}

/// `x'' = −p x'`: each step multiplies the rate by the method's stability function, which is the Padé approximant
/// (2, 3) of the exponential. E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., 1996,
/// table IV.3.1 and section IV.5.
#[test]
fn a_step_damps_as_its_stability_function_says_and_never_rings() {
    for p in [0.1, 1.0, 10.0, 1e3, 1e5, 1e7, 1e9] {
        let damped = Toy {
            p,
            ..Toy::new(([0.0], [1.0]), |_, _, v, _, p| [-p * v[0]])
        };
        let z = -p;
        let exact = (1.0 + 2.0 * z / 5.0 + z * z / 20.0)
            / (1.0 - 3.0 * z / 5.0 + 3.0 * z * z / 20.0 - z * z * z / 60.0);
        let [_, v] = one_step(&damped, 1.0);
        assert!((v - exact).abs() <= roundoff_of_differences(), "{p}: {v:e}");
        // L-stability: a motion with very strong damping vanishes within a step.
        assert!(p < 1e3 || v.abs() < 4.0 / p + roundoff_of_differences());
    }
}

/// The Padé approximant of the exponential with the degrees `k` and `j`: section IV.3, eqs. (3.28) to (3.30).
fn pade(k: u32, j: u32, z: f64) -> f64 {
    let sum = |degree: u32, z: f64| {
        let (mut term, mut sum) = (1.0, 1.0);
        for i in 0..degree {
            term *= z * f64::from(degree - i) / (f64::from(k + j - i) * f64::from(i + 1));
            sum += term;
        }
        sum
    };
    sum(k, z) / sum(j, -z)
}

/// With `s` stages, the stability function is the Padé approximant with the degrees `s − 1` and `s`, of order `2 s − 1`.
#[test]
fn a_step_of_high_order_damps_as_its_stability_function_says() {
    for (method, stages) in RADAU_OF_HIGH_ORDER.iter().zip([5, 7]) {
        for p in [0.1, 1.0, 10.0, 30.0, 1e3, 1e6] {
            let damped = Toy {
                p,
                ..Toy::new(([0.0], [1.0]), |_, _, v, _, p| [-p * v[0]])
            };
            let exact = pade(stages - 1, stages, -p);
            let [_, v] = one_step_by(method, &damped, 1.0);
            let name = method.tableau.name;
            assert!(
                (v - exact).abs() <= roundoff_of_differences(),
                "{name}, {p}: {v:e}"
            );
        }
    }
    // Checks the general formula against that of the test above.
    let z: f64 = -3.0;
    let exact = (1.0 + 2.0 * z / 5.0 + z * z / 20.0)
        / (1.0 - 3.0 * z / 5.0 + 3.0 * z * z / 20.0 - z * z * z / 60.0);
    assert!((pade(2, 3, z) - exact).abs() < 1e-15);
}

/// At fine tolerances the runs agree with the closed form, between steps too, and take far fewer steps than order 5 does.
#[test]
fn radau_of_high_order_follows_stiff_machines_at_fine_tolerances() {
    for p in [1e2, 1e4, 1e6] {
        let dragged = dragged(p);
        let steps = [radau5(), &RADAU_OF_HIGH_ORDER[0], &RADAU_OF_HIGH_ORDER[1]].map(|method| {
            let tolerance = 1e-11;
            let run = run_by(method, &dragged, tolerance, 10.0);
            let name = method.tableau.name;
            for i in 0..=100 {
                let state = run.at(0.1 * f64::from(i)).unwrap();
                let exact = [1.0 - state.t.cos(), state.t.sin()];
                let limit = 10.0 * tolerance + limit(&run, tolerance);
                assert!(
                    (state.q[0] - exact[0]).abs() <= limit,
                    "{name} {p} {}",
                    state.t
                );
                assert!(
                    (state.v[0] - exact[1]).abs() <= limit,
                    "{name} {p} {}",
                    state.t
                );
            }
            assert!(run.warnings().is_empty(), "{name} {p}");
            println!("{p:e}, {name}: {:?}", run.statistics());
            run.statistics().steps
        });
        // The number of steps of a method whose error estimate is of order h^k grows as 1e-11^(−1/k): k is 4, 6 and 8.
        assert!(
            10 * steps[1] < steps[0] && 2 * steps[2] < steps[1],
            "{p}: {steps:?}"
        );
    }
}

/// A stiff spring that rotates couples the stages, which are solved for together; the motion is that of the same machine
/// in polar coordinates.
#[test]
fn radau_of_high_order_follows_a_stiff_spring_that_turns() {
    for method in &RADAU_OF_HIGH_ORDER {
        let tolerance = 1e-9;
        let polar = run_by(method, &elastic_in_polar(1e6), tolerance, 2.0);
        let cartesian = run_by(method, &elastic_in_cartesian(1e6), tolerance, 2.0);
        let [r, theta] = polar.end().q;
        let exact = [(1.0 + r) * theta.sin(), -(1.0 + r) * theta.cos()];
        let limit = limit(&polar, tolerance) + limit(&cartesian, tolerance);
        for (x, exact) in cartesian.end().q.iter().zip(exact) {
            let name = method.tableau.name;
            assert!((x - exact).abs() <= limit, "{name}: {x} and {exact}");
        }
    }
}

/// `x'' = −ω² x`: each step multiplies `x − i x'/ω` by `R(iω)`, whose modulus is below 1 for every frequency.
#[test]
fn a_step_of_a_spring_turns_as_its_stability_function_says() {
    for omega in [0.1, 1.0, 10.0, 1e3, 1e5] {
        let spring = Toy {
            p: omega,
            ..Toy::new(([0.0], [omega]), |_, q, _, _, p| [-p * p * q[0]])
        };
        let z2 = -omega * omega;
        // Numerator and denominator at z = iω: the even powers are real, the odd ones imaginary.
        let [above_re, above_im] = [1.0 + z2 / 20.0, 0.4 * omega];
        let [below_re, below_im] = [1.0 + 0.15 * z2, -0.6 * omega - z2 * omega / 60.0];
        let square = below_re * below_re + below_im * below_im;
        let re = (above_re * below_re + above_im * below_im) / square;
        let im = (above_im * below_re - above_re * below_im) / square;
        let [x, v] = one_step(&spring, 1.0);
        // One step takes −i to −i R.
        let turned = v / omega;
        assert!((x - im).abs() <= roundoff_of_differences(), "{omega}: {x}");
        assert!((turned - re).abs() <= roundoff_of_differences(), "{omega}");
        assert!(x.hypot(turned) < 1.0);
    }
}

/// A block dragged along by a damper `p`, `x'' = −p (x' − sin t) + cos t` with `x' = sin t`: A. Prothero and A. Robinson,
/// *On the stability and accuracy of one-step methods for solving stiff systems*, Math. Comp. 28 (1974) 145–162.
fn dragged(p: f64) -> Toy<1> {
    Toy {
        p,
        // The damper acts between the block and the body that drags it.
        work_rate: |t, _, v, _, p| (-p * (v[0] - t.sin()) + t.cos()) * v[0],
        ..Toy::new(([0.0], [0.0]), |t, _, v, _, p| {
            [-p * (v[0] - t.sin()) + t.cos()]
        })
    }
}

#[test]
fn what_a_damper_drags_along_takes_no_more_steps_however_strong_it_is() {
    for tolerance in [1e-5, 1e-8] {
        let mut steps = Vec::new();
        for p in [1e2, 1e4, 1e6, 1e8, 1e10] {
            let dragged = dragged(p);
            let run = run(&dragged, tolerance, 10.0);
            // Compares the motion between steps, too.
            for i in 0..=100 {
                let state = run.at(0.1 * f64::from(i)).unwrap();
                let exact = [1.0 - state.t.cos(), state.t.sin()];
                let limit = 10.0 * tolerance + limit(&run, tolerance);
                assert!((state.q[0] - exact[0]).abs() <= limit, "{p} {}", state.t);
                assert!((state.v[0] - exact[1]).abs() <= limit, "{p} {}", state.t);
            }
            steps.push(run.statistics().steps);
            assert!(run.warnings().is_empty());
        }
        // From p = 1e4 on the damper is stiff, and the number of steps no longer depends on p.
        assert!(
            steps[1..].iter().all(|n| *n <= steps[1] + steps[1] / 10),
            "{steps:?}"
        );
    }
}

/// A force that jumps at rest, `x'' = 0.3 cos 0.2t − 0.1 sign x'`: at the start its difference quotient is that of a very stiff damper.
fn rubbed() -> Toy<1> {
    Toy {
        work_rate: |t, _, v, _, _| 0.3 * (0.2 * t).cos() * v[0] - 0.1 * v[0].abs(),
        ..Toy::new(([0.0], [0.0]), |t, _, v, _, _| {
            let sign = if v[0] == 0.0 { 0.0 } else { v[0].signum() };
            [0.3 * (0.2 * t).cos() - 0.1 * sign]
        })
    }
}

/// Its motion while x' is positive, which it is for 5 s: `x' = 1.5 sin 0.2t − 0.1 t`.
fn rubbed_exactly(t: f64) -> [f64; 2] {
    [
        7.5 * (1.0 - (0.2 * t).cos()) - 0.05 * t * t,
        1.5 * (0.2 * t).sin() - 0.1 * t,
    ]
}

/// The first step by `method`, of length `h` at most.
fn first_step<'m>(
    machine: &'m Toy<1>,
    method: &'static Method,
    tolerance: f64,
    h: f64,
) -> Stepper<'m, Toy<1>> {
    let absolute = [tolerance];
    let relative = tolerance;
    let start = (0.0, machine.start.0, machine.start.1);
    let tolerance = Tolerance { relative, absolute };
    let mut stepper = Stepper::new(
        machine,
        DefaultInputs,
        NoBalance,
        method,
        tolerance,
        start,
        5.0,
    )
    .unwrap();
    stepper.set_first_step(h);
    stepper.step().unwrap();
    stepper
}

fn radau_methods() -> [&'static Method; 3] {
    let [nine, thirteen] = &RADAU_OF_HIGH_ORDER;
    [radau5(), nine, thirteen]
}

/// The acceleration at the start itself, 0.3 m/s², belongs to neither side of the jump, and does not count in the motion that follows.
#[test]
fn the_motion_within_a_first_step_from_a_jump_is_as_accurate_as_its_end() {
    let rubbed = rubbed();
    for method in radau_methods() {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            for h in [0.01, 0.1, 1.0] {
                let mut stepper = first_step(&rubbed, method, tolerance, h);
                let (step, interpolant) = (stepper.last_step(), stepper.interpolant().unwrap());
                for i in 0..=100 {
                    let theta = 0.01 * f64::from(i);
                    let (q, v) = interpolant.state_at(theta);
                    let [x, rate] = rubbed_exactly(theta * step);
                    // The root mean square of two errors is at most the tolerance, at sizes of at most 1.
                    let limit = 2.0_f64.sqrt() * 2.0 * tolerance;
                    let name = method.tableau.name;
                    assert!(
                        (q[0] - x).abs() <= limit && (v[0] - rate).abs() <= limit,
                        "{name} {tolerance} {h} {theta}: {q:?} {v:?}, and not {x} {rate}"
                    );
                }
                // 0.3 − 0.1, and nothing evaluated across the jump.
                assert!((stepper.a_before()[0] - 0.2).abs() <= 1e-9);
                assert!(stepper.work().evaluations <= 30);
            }
        }
    }
}

/// The rate of a block that a damper brakes falls from 1 to 0. In a step far longer than this takes, the motion between its ends cannot follow,
/// but it does not leave these bounds by more than the polynomial through rates at the stages that are 0: `(1 − θ/c₁)(1 − θ/c₂) …`, which is
/// between −1 and 1.
#[test]
fn a_transient_in_a_first_step_does_not_swing_the_motion_within_it() {
    for p in [1e6, 1e8, 1e10] {
        let damped = Toy {
            p,
            ..Toy::new(([0.0], [1.0]), |_, _, v, _, p| [-p * v[0]])
        };
        for method in radau_methods() {
            let mut stepper = first_step(&damped, method, 1e-3, 1.0);
            let interpolant = stepper.interpolant().unwrap();
            for i in 0..=100 {
                let (q, v) = interpolant.state_at(0.01 * f64::from(i));
                assert!(v[0].abs() <= 1.0 && q[0].abs() <= 1.0, "{p}: {q:?} {v:?}");
                let (q, _) = stepper.hermite(0.01 * f64::from(i));
                assert!(q[0].abs() <= 1.0, "{p}: {q:?}");
            }
        }
    }
}

#[test]
fn a_force_that_jumps_where_a_run_starts_is_not_taken_for_a_stiff_one() {
    let rubbed = rubbed();
    for method in radau_methods() {
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-7] {
            let run = run_by(method, &rubbed, tolerance, 5.0);
            let end = run.end();
            let exact = [
                7.5 * (1.0 - 1.0_f64.cos()) - 1.25,
                1.5 * 1.0_f64.sin() - 0.5,
            ];
            // Sizes are at most 2.2 m and 0.8 m/s, and an error of x' lasts for at most 5 s.
            let of_rate = 1.8 * limit(&run, tolerance);
            let of_place = 3.2 * limit(&run, tolerance) + 5.0 * of_rate;
            assert!(
                (end.q[0] - exact[0]).abs() <= of_place,
                "{tolerance} {end:?}"
            );
            assert!(
                (end.v[0] - exact[1]).abs() <= of_rate,
                "{tolerance} {end:?}"
            );
        }
    }
}

#[test]
fn an_explicit_method_is_held_short_there_and_says_what_helps() {
    let dragged = dragged(1e5);
    let explicit = Simulation::new(&dragged)
        .tolerance(1e-5)
        .until(1.0)
        .run(dragged.start())
        .unwrap();
    let steps = explicit.statistics().steps;
    assert!(steps > 100 * run(&dragged, 1e-5, 1.0).statistics().steps);
    let [warning @ Warning::Stiff { .. }] = explicit.warnings() else {
        panic!("{:?}", explicit.warnings())
    };
    assert!(warning.to_string().contains("radau5"), "{warning}");
}

#[test]
fn events_of_a_stiff_motion_are_found_on_time() {
    let dragged = dragged(1e8);
    let run = Simulation::new(&dragged)
        .method(radau5())
        .tolerance(1e-8)
        .until(10.0)
        .until_event("turns back", Crossing::Falling, |state| state.v[0])
        .run(dragged.start())
        .unwrap();
    // x' = sin t falls through 0 at π, with slope 1; the run ends there with a step of its own.
    assert!((run.end().t - PI).abs() <= limit(&run, 1e-8));
    assert!(run.end().v[0].abs() <= limit(&run, 1e-8));
}

#[test]
fn energy_is_accounted_for_in_a_strongly_damped_machine() {
    // While the block is dragged along, the force p (sin t − x') of the damper does work on it and dissipates energy.
    let stiff = Toy {
        p: 1e6,
        work_rate: |t, _, v, _, p| (p * (t.sin() - v[0]) + t.cos()) * v[0],
        ..dragged(1e6)
    };
    let run = run(&stiff, 1e-8, 10.0);
    let balance = run.energy_balance().unwrap();
    // The error of the powers at the stages is p times the error that Newton's method leaves in a
    // rate, 1e-8 of the tolerance.
    assert!(balance.residual().abs() <= limit(&run, 1e-8), "{balance:?}");
    // T = ½ sin² t
    let exact = 0.5 * 10.0_f64.sin().powi(2);
    assert!((balance.work - exact).abs() <= limit(&run, 1e-8));
}

/// A bob of 1 kg on a spring of length 1 m and stiffness `k`, in polar coordinates `(r − 1, θ)`. It starts at rest at 1
/// rad, with the spring in equilibrium.
fn elastic_in_polar(k: f64) -> Toy<2> {
    Toy {
        p: k,
        ..Toy::new(([G * 1.0_f64.cos() / k, 1.0], [0.0; 2]), |_, q, v, _, k| {
            let r = 1.0 + q[0];
            [
                r * v[1] * v[1] + G * q[1].cos() - k * q[0],
                -(2.0 * v[0] * v[1] + G * q[1].sin()) / r,
            ]
        })
    }
}

/// The elastic pendulum in Cartesian coordinates, in which the stiff direction rotates.
fn elastic_in_cartesian(k: f64) -> Toy<2> {
    let r = 1.0 + G * 1.0_f64.cos() / k;
    let (sin, cos) = 1.0_f64.sin_cos();
    Toy {
        p: k,
        ..Toy::new(([r * sin, -r * cos], [0.0; 2]), |_, q, _, _, k| {
            let r = q[0].hypot(q[1]);
            let pull = -k * (r - 1.0) / r;
            [pull * q[0], pull * q[1] - G]
        })
    }
}

const G: f64 = 9.81;

/// The state after `t` seconds of the rigid pendulum that both tend to.
fn rigid(t: f64) -> [f64; 2] {
    let rod = Toy {
        p: G.sqrt(),
        ..pendulum(1.0)
    };
    let run = Simulation::new(&rod)
        .tolerance(1e-13)
        .until(t)
        .run(rod.start())
        .unwrap();
    [run.end().q[0], run.end().v[0]]
}

/// A spherical pendulum that passes beside its lowest point, in the angles from there and about the vertical; `p` is the rate of the second at the start.
///
/// Its angular momentum `sin² θ φ̇` about the vertical is conserved. At the lowest point φ turns by half a turn at once, so the motion looks stiff there and
/// nowhere else. Each tenth of the distance takes as many steps as the one before.
#[test]
fn a_motion_past_a_pole_of_its_coordinates_is_not_taken_for_stiff_afterwards() {
    let tolerance = 1e-10;
    let passing = |p: f64| {
        let beside = Toy {
            p,
            ..Toy::new(([1.0, 0.0], [0.0, p]), |_, q, v, _, _| {
                let (sin, cos) = q[0].sin_cos();
                [
                    sin * cos * v[1] * v[1] - G * sin,
                    -2.0 * cos / sin * v[0] * v[1],
                ]
            })
        };
        let run = run_by(&RADAU_OF_HIGH_ORDER[0], &beside, tolerance, 1.0);
        let momentum = |q: &[f64; 2], v: &[f64; 2]| q[0].sin().powi(2) * v[1];
        let change = momentum(&run.end().q, &run.end().v) - momentum(&[1.0, 0.0], &[0.0, p]);
        assert!(change.abs() <= limit(&run, tolerance), "{p:e}: {change:e}");
        run.statistics().steps
    };
    let (far, near) = (passing(1e-6), passing(1e-10));
    assert!(near <= 2 * far, "{far} {near}");
}

#[test]
fn a_pendulum_on_a_stiffer_and_stiffer_spring_tends_to_the_pendulum() {
    let [theta, omega] = rigid(5.0);
    let tolerance = 1e-7;
    let mut steps = [Vec::new(), Vec::new()];
    for k in [1e6, 1e8, 1e10, 1e12] {
        let polar = run(&elastic_in_polar(k), tolerance, 5.0);
        let cartesian = run(&elastic_in_cartesian(k), tolerance, 5.0);
        // The spring stretches by mg (3 cos θ − 2 cos 1)/k, which slows the swing: the phase, 5 √g rad, is behind by a
        // fraction of ½ · 3 g/k.
        let gives = 3.0 * G / k * (1.0 + 2.5 * G.sqrt() * omega.abs());
        for (run, place) in [
            (&polar, polar.end().q[1]),
            (
                &cartesian,
                cartesian.end().q[0].atan2(-cartesian.end().q[1]),
            ),
        ] {
            let error = (place - theta).abs();
            assert!(error <= gives + limit(run, tolerance), "{k:e}: {error:e}");
        }
        steps[0].push(polar.statistics().steps);
        steps[1].push(cartesian.statistics().steps);
        // Each iteration takes three evaluations, and a step a few iterations; where the stiff direction rotates, some
        // iterations take fifteen more for the derivatives at the stages.
        let each = |run: &Solution<Toy<2>>| run.statistics().evaluations / run.statistics().steps;
        assert!(each(&polar) <= 15 && each(&cartesian) <= 45);
    }
    for steps in steps {
        let [.., stiff, stiffer, stiffest] = steps[..] else {
            panic!()
        };
        let most = stiff + stiff / 10;
        assert!(stiffer <= most && stiffest <= most, "{steps:?}");
    }
}

/// A double pendulum of two particles whose elbow is held by a torsion spring `k` and a damper of 0.01 s times that. It
/// starts at rest 1 rad from the vertical, with the elbow bent as far as the spring lets it.
///
/// Its stiff direction rotates, and its rods are constraints.
fn elbow(k: f64) -> Constrained<4, 2, 16> {
    // The lower particle follows θ'' = −⅗ g sin θ if the elbow exerts the torque −⅕ g sin θ on it.
    let bent = 1.0 + 0.2 * G * 1.0_f64.sin() / k;
    let [(s1, c1), (s2, c2)] = [1.0_f64, bent].map(f64::sin_cos);
    Constrained {
        p: k,
        start: ([s1, -c1, s1 + s2, -c1 - c2], [0.0; 4]),
        forces: |_, [x1, y1, x2, y2], [vx1, vy1, vx2, vy2], k| {
            let (wx, wy) = (x2 - x1, y2 - y1);
            let bend = (x1 * wy - y1 * wx).atan2(x1 * wx + y1 * wy);
            // Derivatives of the angles of both rods by their end points.
            let (u2, w2) = (x1 * x1 + y1 * y1, wx * wx + wy * wy);
            let (upper, lower) = ([-y1 / u2, x1 / u2], [-wy / w2, wx / w2]);
            let rate =
                lower[0] * (vx2 - vx1) + lower[1] * (vy2 - vy1) - upper[0] * vx1 - upper[1] * vy1;
            let torque = -k * (bend + 0.01 * rate);
            [
                -torque * (lower[0] + upper[0]),
                -torque * (lower[1] + upper[1]) - G,
                torque * lower[0],
                torque * lower[1] - G,
            ]
        },
        ..crate::by_hand::constrained::double_pendulum([1.0, 1.0])
    }
}

#[test]
fn a_stiff_machine_with_constraints_tends_to_the_rigid_one() {
    // Particles at 1 m and 2 m on one rigid bar: θ'' = −⅗ g sin θ.
    let bar = Toy {
        p: (0.6 * G).sqrt(),
        ..pendulum(1.0)
    };
    let exact = Simulation::new(&bar)
        .tolerance(1e-13)
        .until(5.0)
        .run(bar.start())
        .unwrap();
    let theta = exact.end().q[0];
    for tolerance in [1e-6, 1e-8] {
        let mut steps = Vec::new();
        for k in [1e2, 1e4, 1e6, 1e8, 1e10] {
            let run = run(&elbow(k), tolerance, 5.0);
            let residual = run.statistics().constraint_residual;
            assert!(residual <= 1e-13, "{k:e}: {residual:e}");
            let [x, y, ..] = run.end().q;
            let error = (x.atan2(-y) - theta).abs();
            // The compliance of the spring causes an error of the order of 1/k, multiplied by the number of
            // radians that the bar swings.
            assert!(
                error <= 10.0 * G / k + limit(&run, tolerance),
                "{k:e}: {error:e}"
            );
            // As for the elastic pendulum. The energies of this machine leave out those of its spring, so that no quadrature explains the residual of
            // their balance: attempts to must not cost more than the motion.
            let (count, evaluations) = (run.statistics().steps, run.statistics().evaluations);
            assert!(
                evaluations <= 45 * count,
                "{k:e}: {evaluations} in {count} steps"
            );
            steps.push(run.statistics().steps);
        }
        let [.., stiff, stiffer, stiffest] = steps[..] else {
            panic!()
        };
        let most = stiff + stiff / 10;
        assert!(stiffer <= most && stiffest <= most, "{steps:?}");
    }
}

/// A slider-crank mechanism driven through an elastic shaft: flywheel φ₀, crank φ₁ of 0.1 m, rod φ₂ of 0.3 m, slider x on
/// a spring. The shaft is a spring `k` with a damper of 0.01 s times that. It starts at 20 rad/s, with the shaft twisted
/// as the initial acceleration `start` of the flywheel requires.
fn shaft(k: f64, start: f64) -> Constrained<4, 2, 16> {
    Constrained {
        coordinates: [
            ("phi0", "rad"),
            ("phi1", "rad"),
            ("phi2", "rad"),
            ("x", "m"),
        ],
        constraints: [("along", true), ("across", true)],
        p: k,
        start: (
            [FLYWHEEL * start / -k, 0.0, 0.0, CRANK + ROD],
            [20.0, 20.0, -20.0 * CRANK / ROD, 0.0],
        ),
        mass: [FLYWHEEL, 0.02, 0.01, 1.5],
        forces: |_, [phi0, phi1, _, x], [w0, w1, ..], k| {
            let torque = k * (phi1 - phi0 + 0.01 * (w1 - w0));
            [torque, -torque, 0.0, -400.0 * (x - ROD)]
        },
        positions: |_, [_, phi1, phi2, x], _| {
            [
                x - CRANK * phi1.cos() - ROD * phi2.cos(),
                CRANK * phi1.sin() + ROD * phi2.sin(),
            ]
        },
        matrix: |_, [_, phi1, phi2, _], _| {
            [
                [0.0, CRANK * phi1.sin(), ROD * phi2.sin(), 1.0],
                [0.0, CRANK * phi1.cos(), ROD * phi2.cos(), 0.0],
            ]
        },
        by_time: |_, _, _| [0.0; 2],
        constraint_bias: |_, [_, phi1, phi2, _], [_, w1, w2, _], _| {
            [
                -CRANK * phi1.cos() * w1 * w1 - ROD * phi2.cos() * w2 * w2,
                CRANK * phi1.sin() * w1 * w1 + ROD * phi2.sin() * w2 * w2,
            ]
        },
        potential_energy: |_, _| 0.0,
        on_stack: true,
    }
}

const FLYWHEEL: f64 = 0.5;
const CRANK: f64 = 0.1;
const ROD: f64 = 0.3;

/// The same mechanism with the flywheel rigidly on the crank: φ₀ is not coupled and has an inertia of its own.
fn rigid_shaft() -> Constrained<4, 2, 16> {
    let shaft = shaft(1.0, 0.0);
    Constrained {
        mass: [1.0, FLYWHEEL + shaft.mass[1], shaft.mass[2], shaft.mass[3]],
        forces: |_, [.., x], _, _| [0.0, 0.0, 0.0, -400.0 * (x - ROD)],
        ..shaft
    }
}

#[test]
fn a_slider_crank_on_a_stiffer_and_stiffer_shaft_takes_no_more_steps() {
    let rigid = rigid_shaft();
    let reference = Simulation::new(&rigid)
        .tolerance(1e-13)
        .until(2.0)
        .run(rigid.start())
        .unwrap();
    // The initial acceleration when the flywheel is rigidly on the crank.
    let start = reference.observe(0.0).unwrap().a[1];
    let tolerance = 1e-8;
    let mut steps = Vec::new();
    for k in [1e2, 1e4, 1e6, 1e8, 1e10] {
        let run = run(&shaft(k, start), tolerance, 2.0);
        let residual = run.statistics().constraint_residual;
        assert!(residual <= 1e-13, "{k:e}: {residual:e}");
        // The shaft transmits up to m a² ω² = 6 N m for the slider's inertia and 4 N m for its spring, and twists by their
        // sum over k. A shaft of 100 N m/rad vibrates too strongly for this comparison.
        let error = (run.end().q[1] - reference.end().q[1]).abs();
        let most = 10.0 / k + limit(&run, tolerance);
        assert!(k < 1e4 || error <= most, "{k:e}: {error:e}");
        steps.push(run.statistics().steps);
    }
    let [.., stiff, stiffer, stiffest] = steps[..] else {
        panic!()
    };
    let most = stiff + stiff / 10;
    assert!(stiffer <= most && stiffest <= most, "{steps:?}");
}
