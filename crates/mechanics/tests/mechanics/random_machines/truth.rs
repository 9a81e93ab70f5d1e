//! The equations of motion of a random machine from differences of its energies in 120 digits, without algebra, rules of
//! differentiation, or code shared with the compiler.
//!
//! Velocities are central differences with step 10⁻³⁰ (truncation error 10⁻⁶⁰, rounding 10⁻⁹⁰). T is quadratic in the
//! speeds, so differences in these are exact for any step. The outer differences, in time and along the coordinates, have
//! step 10⁻²⁰: truncation error 10⁻⁴⁰, and 10⁻⁶⁰/10⁻²⁰ = 10⁻⁴⁰ from the inner ones. The results have 38 correct digits if
//! derivatives are of order one.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over i and j read like the formulas"
)]

use super::machine::{Machine, Step, Stretch};
use super::number::Number;

const INNER: u32 = 30;
const OUTER: u32 = 20;

/// M, h, Q and a at a state.
pub struct Truth {
    pub mass_matrix: Vec<Vec<Number>>,
    pub bias: Vec<Number>,
    pub applied: Vec<Number>,
    pub accelerations: Vec<Number>,
    pub kinetic_energy: Number,
    pub potential_energy: Number,
    pub dissipation: Number,
}

type Vector = [Number; 3];
type Matrix = [[Number; 3]; 3];

/// Origin and axes of a frame; `axes[i][k]` is the i-th ground component of axis k.
#[derive(Clone)]
struct Pose {
    origin: Vector,
    axes: Matrix,
}

impl Truth {
    pub fn at(machine: &Machine, q: &[f64], v: &[f64], t: f64) -> Truth {
        let numbers = |x: &[f64]| x.iter().map(|x| Number::of(*x)).collect::<Vec<_>>();
        let (q, v, t) = (numbers(q), numbers(v), Number::of(t));
        let n = q.len();
        let kinetic = |q: &[Number], v: &[Number], t: &Number| kinetic_energy(machine, q, v, t);
        let base = kinetic(&q, &v, &t);

        // M_ij = ∂²T/∂vᵢ∂vⱼ, exact for a quadratic function.
        let single: Vec<Number> = (0..n)
            .map(|i| kinetic(&q, &shifted(&v, i, &Number::of(1.0)), &t))
            .collect();
        let mut mass_matrix = vec![vec![Number::zero(); n]; n];
        for i in 0..n {
            for j in 0..=i {
                let both = shifted(&shifted(&v, i, &Number::of(1.0)), j, &Number::of(1.0));
                let entry = kinetic(&q, &both, &t) - &single[i] - &single[j] + &base;
                mass_matrix[i][j] = entry.clone();
                mass_matrix[j][i] = entry;
            }
        }

        // hᵢ = d/dt ∂T/∂vᵢ − ∂T/∂qᵢ with v held constant.
        let step = Number::tenth(OUTER);
        let momentum = |i: usize, q: &[Number], t: &Number| {
            let up = kinetic(q, &shifted(&v, i, &Number::of(1.0)), t);
            let down = kinetic(q, &shifted(&v, i, &Number::of(-1.0)), t);
            (up - down) / Number::of(2.0)
        };
        let later = moved(&q, &v, &step);
        let earlier = moved(&q, &v, &-step.clone());
        let two_steps = Number::of(2.0) * &step;
        let bias = (0..n).map(|i| {
            let rate = momentum(i, &later, &(&t + &step)) - momentum(i, &earlier, &(&t - &step));
            let slope = kinetic(&shifted(&q, i, &step), &v, &t)
                - kinetic(&shifted(&q, i, &-step.clone()), &v, &t);
            (rate - slope) / &two_steps
        });
        let bias: Vec<Number> = bias.collect();

        // Qᵢ = −∂V/∂qᵢ − ∂D/∂vᵢ + Σ F·∂x/∂qᵢ.
        let applied = (0..n).map(|i| {
            let (up, down) = (shifted(&q, i, &step), shifted(&q, i, &-step.clone()));
            let potential =
                potential_energy(machine, &up, &t) - potential_energy(machine, &down, &t);
            let one = Number::of(1.0);
            let dissipation = dissipation(machine, &q, &shifted(&v, i, &one), &t)
                - dissipation(machine, &q, &shifted(&v, i, &-one.clone()), &t);
            let mut sum = -(potential / &two_steps) - dissipation / Number::of(2.0);
            let (above, below) = (centres(machine, &up, &t), centres(machine, &down, &t));
            for force in &machine.forces {
                let size = &v[force.velocity] + &t.sin_cos().1;
                for (k, component) in force.force.iter().enumerate() {
                    let lever = (&above[force.body][k] - &below[force.body][k]) / &two_steps;
                    sum = sum + Number::of(*component) * &size * &lever;
                }
            }
            sum
        });
        let applied: Vec<Number> = applied.collect();

        let forces: Vec<Number> = applied
            .iter()
            .zip(&bias)
            .map(|(applied, bias)| applied - bias)
            .collect();
        let accelerations = solve(mass_matrix.clone(), forces);
        Truth {
            accelerations,
            kinetic_energy: base,
            potential_energy: potential_energy(machine, &q, &t),
            dissipation: dissipation(machine, &q, &v, &t),
            mass_matrix,
            bias,
            applied,
        }
    }
}

fn shifted(x: &[Number], i: usize, by: &Number) -> Vec<Number> {
    let mut x = x.to_vec();
    x[i] = &x[i] + by;
    x
}

/// q + v·s.
fn moved(q: &[Number], v: &[Number], s: &Number) -> Vec<Number> {
    q.iter().zip(v).map(|(q, v)| q + &(v * s)).collect()
}

fn zeros() -> Vector {
    [Number::zero(), Number::zero(), Number::zero()]
}

fn poses(machine: &Machine, q: &[Number], t: &Number) -> Vec<Pose> {
    let one = |i, j| {
        if i == j {
            Number::of(1.0)
        } else {
            Number::zero()
        }
    };
    let axes = std::array::from_fn(|i| std::array::from_fn(|j| one(i, j)));
    let mut poses = vec![Pose {
        origin: zeros(),
        axes,
    }];
    for frame in &machine.frames {
        let mut pose = poses[frame.parent].clone();
        match &frame.step {
            Step::Shift(shift) => {
                let shift: [Number; 3] = std::array::from_fn(|k| shift[k].at(q, t));
                pose.origin = point(&pose, &shift);
            }
            Step::Turn(axis, angle) => {
                let (sin, cos) = angle.at(q, t).sin_cos();
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                for row in &mut pose.axes {
                    let (old_a, old_b) = (row[a].clone(), row[b].clone());
                    row[a] = &old_a * &cos + &old_b * &sin;
                    row[b] = &old_b * &cos - &old_a * &sin;
                }
            }
        }
        poses.push(pose);
    }
    poses
}

fn point(pose: &Pose, local: &[Number; 3]) -> Vector {
    std::array::from_fn(|i| {
        (0..3).fold(pose.origin[i].clone(), |sum, k| {
            sum + &pose.axes[i][k] * &local[k]
        })
    })
}

fn body_poses(machine: &Machine, q: &[Number], t: &Number) -> Vec<Pose> {
    let poses = poses(machine, q, t);
    machine
        .bodies
        .iter()
        .map(|body| {
            let pose = &poses[body.frame];
            let centre = point(pose, &std::array::from_fn(|k| Number::of(body.offset[k])));
            Pose {
                origin: centre,
                axes: pose.axes.clone(),
            }
        })
        .collect()
}

fn centres(machine: &Machine, q: &[Number], t: &Number) -> Vec<Vector> {
    body_poses(machine, q, t)
        .into_iter()
        .map(|pose| pose.origin)
        .collect()
}

/// T = Σ ½ m ẋ² + ½ ωᵀ I ω, with ẋ and Ṙ from central differences along the motion, ω from RᵀṘ.
fn kinetic_energy(machine: &Machine, q: &[Number], v: &[Number], t: &Number) -> Number {
    let step = Number::tenth(INNER);
    let now = body_poses(machine, q, t);
    let later = body_poses(machine, &moved(q, v, &step), &(t + &step));
    let earlier = body_poses(machine, &moved(q, v, &-step.clone()), &(t - &step));
    let two_steps = Number::of(2.0) * &step;
    let half = Number::of(0.5);
    let mut energy = Number::zero();
    for (k, body) in machine.bodies.iter().enumerate() {
        let mass = Number::of(body.mass);
        for i in 0..3 {
            let rate = (&later[k].origin[i] - &earlier[k].origin[i]) / &two_steps;
            energy = energy + &half * &mass * &rate * &rate;
        }
        let Some(entries) = &body.inertia else {
            continue;
        };
        // (RᵀṘ)_ab = −ε_abc ω_c: component c is entry (b, a) for (a, b, c) cyclic.
        let spin = |a: usize, b: usize| {
            (0..3).fold(Number::zero(), |sum, i| {
                let rate = (&later[k].axes[i][a] - &earlier[k].axes[i][a]) / &two_steps;
                sum + &now[k].axes[i][b] * &rate
            })
        };
        let omega = [spin(1, 2), spin(2, 0), spin(0, 1)];
        let entry = |i: usize, j: usize| match (i.min(j), i.max(j)) {
            (0, 1) => 3,
            (0, 2) => 4,
            (1, 2) => 5,
            _ => i,
        };
        if machine.spatial {
            for i in 0..3 {
                for j in 0..3 {
                    energy =
                        energy + &half * &Number::of(entries[entry(i, j)]) * &omega[i] * &omega[j];
                }
            }
        } else {
            energy = energy + &half * &Number::of(entries[0]) * &omega[2] * &omega[2];
        }
    }
    energy
}

fn stretch(machine: &Machine, stretch: &Stretch, q: &[Number], t: &Number, length: bool) -> Number {
    match stretch {
        Stretch::Linear(linear) => linear.at(q, t),
        Stretch::Bodies(a, b, free) => {
            let centres = centres(machine, q, t);
            let square = (0..3).fold(Number::zero(), |sum, i| {
                let d = &centres[*a][i] - &centres[*b][i];
                sum + &d * &d
            });
            square.sqrt() - Number::of(if length { *free } else { 0.0 })
        }
    }
}

/// V = Σ ½ k s² − Σ m g·x.
fn potential_energy(machine: &Machine, q: &[Number], t: &Number) -> Number {
    let mut energy = Number::zero();
    for (body, centre) in machine.bodies.iter().zip(centres(machine, q, t)) {
        let dimension = if machine.spatial { 3 } else { 2 };
        for i in 0..dimension {
            energy = energy - Number::of(body.mass) * Number::of(machine.gravity[i]) * &centre[i];
        }
    }
    for spring in &machine.springs {
        let s = stretch(machine, &spring.stretch, q, t, true);
        energy = energy + Number::of(0.5 * spring.stiffness) * &s * &s;
    }
    energy
}

/// D = Σ ½ b (ds/dt)².
fn dissipation(machine: &Machine, q: &[Number], v: &[Number], t: &Number) -> Number {
    let step = Number::tenth(INNER);
    let mut sum = Number::zero();
    for damper in &machine.dampers {
        let later = stretch(
            machine,
            &damper.stretch,
            &moved(q, v, &step),
            &(t + &step),
            false,
        );
        let earlier = stretch(
            machine,
            &damper.stretch,
            &moved(q, v, &-step.clone()),
            &(t - &step),
            false,
        );
        let rate = (later - earlier) / (Number::of(2.0) * &step);
        sum = sum + Number::of(0.5 * damper.damping) * &rate * &rate;
    }
    sum
}

/// Gaussian elimination with row pivoting.
fn solve(mut matrix: Vec<Vec<Number>>, mut right: Vec<Number>) -> Vec<Number> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).fold(k, |best, i| {
            if matrix[i][k].abs().exceeds(&matrix[best][k].abs()) {
                i
            } else {
                best
            }
        });
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for i in k + 1..n {
            let factor = &matrix[i][k] / &matrix[k][k];
            for j in k..n {
                matrix[i][j] = &matrix[i][j] - &(&factor * &matrix[k][j]);
            }
            right[i] = &right[i] - &(&factor * &right[k]);
        }
    }
    for k in (0..n).rev() {
        let known = (k + 1..n).fold(Number::zero(), |sum, j| sum + &matrix[k][j] * &right[j]);
        right[k] = (&right[k] - &known) / &matrix[k][k];
    }
    right
}
