//! Rounding errors of programs.

use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape, Slot};
use lagrangian_scalar::{DoubleDouble, Scalar};

use crate::harness::{all_machines, machine, program};

/// A state: coordinates, velocities and inputs.
struct State {
    q: Vec<f64>,
    v: Vec<f64>,
    u: Vec<f64>,
}

const TIME: f64 = 0.3;

/// A program run over numbers of some type.
struct Runner<'a, S> {
    program: &'a Program,
    interpreter: Interpreter<S>,
}

impl<'a, S: Scalar<Stored = S>> Runner<'a, S> {
    fn new(program: &'a Program, parameters: &[f64]) -> Runner<'a, S> {
        let parameters: Vec<S> = parameters.iter().map(|&p| S::from_f64(p)).collect();
        Runner {
            program,
            interpreter: Interpreter::new(program, &parameters),
        }
    }

    fn call(&mut self, role: Role, state: &State) -> Vec<S> {
        let wide = |list: &[f64]| list.iter().map(|&x| S::from_f64(x)).collect::<Vec<S>>();
        let (q, v, u) = (wide(&state.q), wide(&state.v), wide(&state.u));
        let arguments = Arguments {
            t: S::from_f64(TIME),
            q: &q,
            v: &v,
            u: &u,
            a: &[],
        };
        let len = self
            .program
            .function(role)
            .expect("the function")
            .results
            .len();
        let mut results = vec![S::ZERO; len];
        self.interpreter
            .call(role, arguments, &mut results)
            .expect("a regular state");
        results
    }
}

/// The condition number of a matrix, given by its lower triangle, with rows and columns scaled to a unit diagonal.
fn condition(lower: &[f64], n: usize) -> f64 {
    let entry = |i: usize, j: usize| {
        lower[Shape::index(i, j)] / (lower[Shape::index(i, i)] * lower[Shape::index(j, j)]).sqrt()
    };
    let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let mut left: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect();
    let mut inverse: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| unit(i, j)).collect())
        .collect();
    let norm = |m: &[Vec<f64>]| {
        m.iter()
            .map(|row| row.iter().map(|x| x.abs()).sum())
            .fold(0.0, f64::max)
    };
    let size: f64 = norm(&left);
    // Gauss–Jordan elimination without row exchanges, as the matrix is positive definite.
    for k in 0..n {
        let pivot = left[k][k];
        for m in [&mut left, &mut inverse] {
            m[k].iter_mut().for_each(|x| *x /= pivot);
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = left[i][k];
            for m in [&mut left, &mut inverse] {
                let row = m[k].clone();
                m[i].iter_mut().zip(row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    size * norm(&inverse)
}

/// The default values of a program's parameters.
fn defaults(program: &Program) -> Vec<f64> {
    let default = |p: &Slot| p.default.as_ref().map_or(1.0, |default| default.value);
    program.parameters.iter().map(default).collect()
}

/// The largest error of accelerations over some states, in condition numbers of M times 2⁻⁵³.
fn worst_error(program: &Program, parameters: &[f64]) -> f64 {
    let n = program.dimension();
    let (mut fast, mut exact) = (
        Runner::<f64>::new(program, parameters),
        Runner::<DoubleDouble>::new(program, parameters),
    );
    let mut worst = 0.0_f64;
    for seed in 1..50 {
        let number = |i: usize| ((seed * 37 + i * 101) % 89) as f64 / 60.0 + 0.1;
        let list = |from: usize, len: usize, shift: f64| {
            (from..from + len).map(|i| number(i) - shift).collect()
        };
        let state = State {
            q: list(0, n, 0.0),
            v: list(n, n, 0.8),
            u: list(2 * n, program.inputs.len(), 0.0),
        };
        let a = fast.call(Role::Accelerations, &state);
        let b = exact.call(Role::Accelerations, &state);
        let condition = condition(&fast.call(Role::MassMatrix, &state), n);
        // Errors are in the norm in which M is scaled: √Mᵢᵢ aᵢ.
        let diagonal = fast.call(Role::MassMatrix, &state);
        let scale = |i: usize| diagonal[Shape::index(i, i)].sqrt();
        let size = (0..n)
            .map(|i| scale(i) * b[i].to_f64().abs())
            .fold(0.0, f64::max);
        let error = |i: usize| scale(i) * (DoubleDouble::from_f64(a[i]) - b[i]).to_f64().abs();
        let error = (0..n).map(error).fold(0.0, f64::max);
        worst = worst.max(error / size / condition * 2f64.powi(53));
    }
    worst
}

/// The bound for n elimination steps and the rounding of the phase of a drive, which is a few tens of radians.
fn bound(program: &Program) -> f64 {
    4.0 * program.dimension() as f64 + 40.0
}

#[test]
fn rounding_errors_are_those_of_a_backward_stable_solution() {
    for name in all_machines() {
        machine(&name, &[], |machine| {
            let program = &machine.program;
            // With constraints, the condition of M is not the one that matters.
            if !program.constraints.is_empty() || !program.contacts.is_empty() {
                return;
            }
            let worst = worst_error(program, &defaults(program));
            println!("{name}: {worst:.2} condition numbers in units of 2^-53");
            assert!(worst < bound(program), "{name}: {worst}");
        });
    }
}

/// Eight bars hung on one another, whose mass centres may be anywhere.
const BARS: &str = "machine Bars in plane {
    parameters {
        g: m/s^2 = 9.81,
        l[1..8]: m = 0.4, c[1..8]: m = 0.28, m[1..8]: kg = 1.3, I[1..8]: kg*m^2 = 0.03,
    }
    ASSUMPTIONS
    coordinates { q[1..8]: rad }
    frames {
        hinge[0] = ground,
        hinge[i in 1..8] = hinge[i-1].shift(l[i]*sin(q[i]), -l[i]*cos(q[i])),
    }
    bodies {
        bar[i in 1..8] {
            mass: m[i], inertia: I[i], at: hinge[i-1].origin + c[i]*(sin(q[i]), -cos(q[i])), angle: q[i],
        },
    }
    gravity (0, -g);
}";

#[test]
fn a_bar_without_length_is_a_machine_still() {
    let bars = program(&BARS.replace("ASSUMPTIONS", ""));
    let place = |name: &str| {
        bars.parameters
            .iter()
            .position(|p| p.name.to_string() == name)
    };
    let length = place("l[5]").expect("the length of a bar");
    for short in [1e-2, 1e-4, 1e-6, 1e-9, 0.0] {
        let mut parameters = defaults(&bars);
        parameters[length] = short;
        let worst = worst_error(&bars, &parameters);
        println!("a bar of {short} m: {worst:.2} condition numbers in units of 2^-53");
        assert!(worst < bound(&bars), "a bar of {short} m: {worst}");
    }
}

#[test]
fn centres_of_mass_between_the_joints_save_operations() {
    let operations = |assumed: &str| {
        let bars = program(&BARS.replace("ASSUMPTIONS", assumed));
        let accelerations = bars.function(Role::Accelerations).expect("the function");
        let counts = accelerations.counts();
        assert!(worst_error(&bars, &defaults(&bars)) < bound(&bars));
        counts.multiplications + counts.additions
    };
    let anywhere = operations("");
    for assumed in [
        "assume { c[i] > 0 for i in 1..8, c[i] <= l[i] for i in 1..8 }",
        "assume { l[i] > c[i] for i in 1..8, 0 < c[i] for i in 1..8 }",
    ] {
        assert!(operations(assumed) + 5 * 8 < anywhere, "{assumed}");
    }
    // Each of these assumptions is too weak.
    for assumed in [
        "assume { c[i] >= 0 for i in 1..8, c[i] <= l[i] for i in 1..8 }",
        "assume { c[i] > 0 for i in 1..8, l[i] > 0 for i in 1..8 }",
        "assume { l[i] > 0 for i in 1..8, c[i] <= l[i] for i in 1..8 }",
    ] {
        assert_eq!(operations(assumed), anywhere, "{assumed}");
    }
}

/// Discs that roll on each other, each at two coordinates and an angle.
const DISCS: &str = "machine Discs in plane {
    parameters { r: m = 0.1, s: m = 0.2 }
    coordinates { x: m, y: m = 0.3, p: rad, X: m, Y: m, P: rad }
    bodies { a { mass: 2*kg, inertia: 1*kg*m^2, at: (x, y), angle: p }, b { mass: 2*kg, inertia: 1*kg*m^2, at: (X, Y), angle: P } }
    circles { ca { on: a, center: (0, 0), radius: r }, cb { on: b, center: (0, 0), radius: s } }
    rolling { roll { circle: ca, outside: cb } }
}";

/// A disc that rolls along a line, in frames turned by 16/64 and by −31/64.
const TURNED: &str = "machine Turned in plane {
    parameters { r: m = 0.1 }
    coordinates { x: m, y: m, p: rad }
    frames { one = ground.turn(0.25), line = one.turn(-0.484375) }
    bodies { a { mass: 2*kg, inertia: 1*kg*m^2, frame: one.shift(x, y).turn(p) } }
    circles { c { on: a, center: (0, 0), radius: r } }
    rolling { roll { circle: c, along: line } }
}";

/// The positions of constraints are compared with formulas in double-doubles. A difference of coordinates, its square, a sum, a root and two further
/// differences are each rounded once, and so are a product with the sine of a constant angle and this sine.
#[test]
fn gaps_of_circles_lose_no_digits_to_their_place_or_to_turned_frames() {
    let wide = DoubleDouble::from_f64;
    let (mut discs, mut turned) = (0.0_f64, 0.0_f64);
    let programs = [program(DISCS), program(TURNED)];
    let radii = [defaults(&programs[0]), defaults(&programs[1])];
    let mut runners = [0, 1].map(|k| Runner::<f64>::new(&programs[k], &radii[k]));
    for seed in 1..50 {
        let number = |i: usize| ((seed * 37 + i * 101) % 89) as f64 / 60.0 + 0.1;
        let far = 1000.0 * number(7);
        let q = vec![
            far + number(0),
            far - number(1),
            number(2),
            far - number(3),
            far + number(4),
            number(5),
        ];
        let [dx, dy] = [0, 1].map(|i| wide(q[i]) - wide(q[i + 3]));
        let distance = (dx * dx + dy * dy).sqrt();
        let radii_sum = wide(radii[0][0]) + wide(radii[0][1]);
        let v = vec![0.0; 6];
        let gap = runners[0].call(Role::ConstraintPositions, &State { q, v, u: vec![] })[0];
        let error = (wide(gap) - (distance - radii_sum)).to_f64().abs();
        discs = discs.max(error / (distance + radii_sum).to_f64());

        let (q, v) = (vec![number(0), number(1), number(2)], vec![0.0; 3]);
        let (sine, cosine) = (wide(0.484375).sin(), wide(0.484375).cos());
        let (x, y) = (wide(q[0]), wide(q[1]));
        let expected = x * sine + y * cosine - wide(radii[1][0]);
        let size = (x.abs() + y.abs()).to_f64();
        let gap = runners[1].call(Role::ConstraintPositions, &State { q, v, u: vec![] })[0];
        turned = turned.max((wide(gap) - expected).to_f64().abs() / size);
    }
    let unit = 2f64.powi(-53);
    println!(
        "{:.2} and {:.2} units of 2^-53",
        discs / unit,
        turned / unit
    );
    assert!(discs <= 6.0 * unit, "{discs:e}");
    assert!(turned <= 6.0 * unit, "{turned:e}");
}
