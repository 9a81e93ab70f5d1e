//! Random machines in space, each written in two ways: bodies rotated by three angles or by a quaternion, and surfaces in two frames.

use lagrangian::Simulation;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian_program::{Arguments, Interpreter, Role};

use super::Tally;
use super::evaluation::compile;
use super::random::Random;

/// A varying number: its value, its rate and its acceleration.
type Moving = [f64; 3];

fn product(a: Moving, b: Moving) -> Moving {
    [
        a[0] * b[0],
        a[1] * b[0] + a[0] * b[1],
        a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2],
    ]
}

/// The quaternion (Hamilton) product.
fn turned(p: [Moving; 4], q: [Moving; 4]) -> [Moving; 4] {
    let rows: [[(usize, usize, f64); 4]; 4] = [
        [(0, 0, 1.0), (1, 1, -1.0), (2, 2, -1.0), (3, 3, -1.0)],
        [(0, 1, 1.0), (1, 0, 1.0), (2, 3, 1.0), (3, 2, -1.0)],
        [(0, 2, 1.0), (2, 0, 1.0), (3, 1, 1.0), (1, 3, -1.0)],
        [(0, 3, 1.0), (3, 0, 1.0), (1, 2, 1.0), (2, 1, -1.0)],
    ];
    rows.map(|row| {
        row.iter().fold([0.0; 3], |sum, (i, k, sign)| {
            let part = product(p[*i], q[*k]);
            [0, 1, 2].map(|n| sum[n] + sign * part[n])
        })
    })
}

/// The quaternion of a rotation about an axis of the frame: cosine and sine of half the angle.
fn about(axis: usize, [angle, rate, acceleration]: Moving) -> [Moving; 4] {
    let (sin, cos) = (angle / 2.0).sin_cos();
    let (w, b) = (rate / 2.0, acceleration / 2.0);
    let mut numbers = [[0.0; 3]; 4];
    numbers[0] = [cos, -sin * w, -sin * b - cos * w * w];
    numbers[1 + axis] = [sin, cos * w, cos * b - sin * w * w];
    numbers
}

/// A solid that hangs on a spring and is driven by a torque, whose rotation is described by `turn`.
fn solid(coordinates: &str, turn: &str, numbers: &[f64]) -> String {
    let [mass, a, b, c, off, px, py, pz, stiffness, damping, torque] = numbers else {
        unreachable!("eleven numbers")
    };
    format!(
        "machine Solid in space {{
            constants {{ one_m: m = 1, one_s: s = 1 }}
            coordinates {{ x: m, y: m, z: m, {coordinates} }}
            frames {{ body = ground.shift(x, y, z){turn} }}
            bodies {{ body {{
                mass: {mass:?}*1*kg, inertia: ({a:?}*1*kg*m^2, {b:?}*1*kg*m^2, {c:?}*1*kg*m^2, {off:?}*1*kg*m^2, 0, 0),
                frame: body, at: body.point({px:?}*one_m, {py:?}*one_m, {pz:?}*one_m),
            }} }}
            gravity (0, 0, -9.81*one_m/one_s^2);
            springs {{ hung {{
                stiffness: {stiffness:?}*1*N/m, length: 0.5*one_m,
                from: (0, 0, 2*one_m), to: body.point({pz:?}*one_m, {px:?}*one_m, 0),
            }} }}
            dampers {{ slow {{
                damping: {damping:?}*1*N*s/m, from: (3*one_m, 0, 0), to: body.point(0, {py:?}*one_m, {px:?}*one_m),
            }} }}
            torques {{ driven {{ on: body, torque: {torque:?}*1*N*m*body.vector(0, 1, 0) }} }}
        }}"
    )
}

/// Accelerations and energies in a state, in f64.
fn at(text: &str, q: &[f64], v: &[f64]) -> Result<(Vec<f64>, [f64; 2]), String> {
    let program = compile(text, &[])?;
    let mut interpreter: Interpreter<f64> = Interpreter::new(&program, &[]);
    let arguments = Arguments {
        t: 0.0,
        q,
        v,
        u: &[],
        a: &[],
    };
    let mut call = |role: Role, count: usize| {
        let mut results = vec![0.0; count];
        let done = interpreter.call(role, arguments, &mut results);
        done.map(|()| results)
            .map_err(|_| format!("no {}", role.name()))
    };
    let accelerations = call(Role::Accelerations, q.len())?;
    let energies = [
        call(Role::KineticEnergy, 1)?[0],
        call(Role::PotentialEnergy, 1)?[0],
    ];
    Ok((accelerations, energies))
}

/// Compares a solid rotated by three angles about any axes, away from their singularity, with the same solid rotated by
/// the equivalent quaternion.
pub fn solids(mut random: Random, _: usize, tally: &mut Tally) {
    let first = random.below(3);
    let second = (first + 1 + random.below(2)) % 3;
    // The third axis is either the first again, or the remaining one; the angles are singular at a second angle of 0, or of
    // a quarter turn.
    let again = random.chance(50);
    let third = if again { first } else { 3 - first - second };
    let middle = if again { (0.5, 2.6) } else { (-1.0, 1.0) };
    let mut any = |low: f64, high: f64| random.number(low, high);
    let numbers = [
        any(0.5, 2.0),
        any(0.5, 0.7),
        any(0.5, 0.7),
        any(0.5, 0.7),
        any(-0.1, 0.1),
        any(-0.5, 0.5),
        any(-0.5, 0.5),
        any(-0.5, 0.5),
        any(1.0, 9.0),
        any(0.1, 2.0),
        any(-3.0, 3.0),
    ];
    let angles = [any(-3.0, 3.0), any(middle.0, middle.1), any(-3.0, 3.0)];
    let [rates, place, velocity] = [0, 1, 2].map(|_| [0; 3].map(|_| any(-1.0, 1.0)));
    let axes = [first, second, third];
    let turn: String = axes
        .iter()
        .zip(["a", "b", "c"])
        .map(|(axis, name)| format!(".turn({}, {name})", ["x", "y", "z"][*axis]))
        .collect();
    let by_angles = solid("a: rad, b: rad, c: rad", &turn, &numbers);
    let by_numbers = solid(
        "e[0]: 1 = 1, e[1..3]: 1",
        ".turn(e[0], e[1], e[2], e[3])",
        &numbers,
    );
    let found = at(
        &by_angles,
        &[place, angles].concat(),
        &[velocity, rates].concat(),
    );
    let (accelerations, energies) = match found {
        Ok(found) => found,
        Err(error) => {
            tally.failures.push(format!("{error}\n{by_angles}"));
            return;
        }
    };
    let parts = [0, 1, 2].map(|k| about(axes[k], [angles[k], rates[k], accelerations[3 + k]]));
    let exact = turned(turned(parts[0], parts[1]), parts[2]);
    let [e, rates_of_e, accelerations_of_e] = [0, 1, 2].map(|n| exact.map(|number| number[n]));
    let q = [&place[..], &e].concat();
    let v = [&velocity[..], &rates_of_e].concat();
    let (found, energies_found) = match at(&by_numbers, &q, &v) {
        Ok(found) => found,
        Err(error) => {
            tally.failures.push(format!("{error}\n{by_numbers}"));
            return;
        }
    };
    let wanted = [&accelerations[..3], &accelerations_of_e].concat();
    let all = wanted.iter().chain(&energies);
    let size = all.fold(1.0, |most: f64, x| most.max(x.abs()));
    // One rounding for each of some thousand operations; angles are divided by the sine of the middle angle, which is above 0.47.
    let bound = 4096.0 * f64::EPSILON * size;
    let pairs = found.iter().zip(&wanted);
    for (k, (found, wanted)) in pairs
        .chain(energies_found.iter().zip(&energies))
        .enumerate()
    {
        let off = (found - wanted).abs();
        if off.is_nan() || off > bound {
            tally.failures.push(format!(
                "{k}: {found} by four numbers and {wanted} by angles: {off:e}, {bound:e} may be; {q:?} {v:?}\n{by_numbers}\n{by_angles}"
            ));
        }
    }
    tally.count(if again {
        "first axis again"
    } else {
        "three axes"
    });
}

/// A puck between two planes: its normal is given in the ground's axes or in the slope's, with any length and to either side, and its
/// coordinates along the slope are rotated about the normal.
pub fn surfaces(mut random: Random, _: usize, tally: &mut Tally) {
    let mut any = |low: f64, high: f64| random.number(low, high);
    let (slope, about, mu, scale) = (any(0.1, 1.0), any(-3.0, 3.0), any(0.05, 0.5), any(0.5, 3.0));
    let (x, y) = (any(-2.0, 2.0), any(2.0, 3.0));
    let (sin, cos) = about.sin_cos();
    let puck = |frame: &str, normal: &str, [x, y]: [f64; 2]| {
        format!(
            "machine Puck in space {{
                parameters {{ m: kg = 1, mu: 1 = {mu:?}, g: m/s^2 = 9.81, alpha: rad = {slope:?}, about: rad = {about:?} }}
                coordinates {{ x: m, y: m, der(x): m/s = {x:?}, der(y): m/s = {y:?} }}
                frames {{ slope = {frame}, puck = slope.shift(x, y, 0) }}
                bodies {{ puck {{ mass: m, frame: puck }} }}
                gravity (0, 0, -g);
                sliding {{ slot {{ body: puck, on: ground, normal: {normal}, friction: mu }} }}
                outputs {{ down: m = dot(puck.origin, (cos(alpha), 0, -sin(alpha))), across: m = dot(puck.origin, (0, 1, 0)) }}
            }}"
        )
    };
    let one = puck("ground.turn(y, alpha)", "slope.vector(0, 0, 1)", [x, y]);
    // The velocity has other components along the rotated axes.
    let turned = [cos * x + sin * y, cos * y - sin * x];
    let other = puck(
        "ground.turn(y, alpha).turn(z, about)",
        &format!("-{scale:?}*(sin(alpha), 0, cos(alpha))"),
        turned,
    );
    let run = |text: &str| -> Result<[f64; 4], String> {
        let machine = InterpretedMachine::new(compile(text, &[])?);
        let solution = Simulation::new(&machine).until(0.3).tolerance(1e-12);
        let solution = solution.run(lagrangian::Machine::start(&machine));
        let solution = solution.map_err(|error| error.to_string())?;
        let end = solution.end();
        let [q, v] = [&end.q.values, &end.v.values];
        Ok([q[0], q[1], v[0], v[1]])
    };
    let ([a, b], all) = match (run(&one), run(&other)) {
        (Ok(one), Ok(other)) => ([one, other], format!("{one:?} {other:?}\n{other:?}")),
        (one_ended, other_ended) => {
            tally
                .failures
                .push(format!("{one_ended:?} {other_ended:?}\n{one}\n{other}"));
            return;
        }
    };
    // Back along the axes of the slope.
    let back = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
    let wanted = [back(b[0], b[1]), back(b[2], b[3])].concat();
    // The puck slides throughout: friction takes at most half of g for 0.3 s. There are some tens of steps, each with an error of the
    // tolerance for numbers below 10.
    for (found, wanted) in a.iter().zip(&wanted) {
        let off = (found - wanted).abs();
        if off.is_nan() || off > 1e-9 {
            tally
                .failures
                .push(format!("{off:e}: {all}\n{one}\n{other}"));
            return;
        }
    }
    tally.count("surfaces");
}
