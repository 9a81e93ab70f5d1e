//! Steps between frames: displacements along axes, and rotations about them.

use nalgebra::Matrix3;

use super::number::{Angle, Number};

/// If the sine or cosine of the middle one of three angles is below this, the other two cannot be separated.
const SINGULAR: f64 = 1e-12;

/// Angles this small are round-off.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Successive rotations about axes of the frame itself, 0 to 2.
pub type Turns = Vec<(usize, Angle)>;

/// The axes of a frame.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// A product in the shortest form: empty for 0, the value itself, or its negative.
fn scaled(factor: f64, value: &str) -> String {
    match factor {
        0.0 => "0".to_owned(),
        1.0 => bare(value).to_owned(),
        -1.0 => format!("-{value}"),
        _ => format!("{}*{value}", Number::computed(factor)),
    }
}

/// A value without its brackets, which it needs only after a sign or a factor.
fn bare(value: &str) -> &str {
    let inner = value
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'));
    inner.unwrap_or(value)
}

/// A displacement along an axis.
pub fn slide(axis: &[f64; 3], value: &str) -> String {
    let [x, y, z] = axis.map(|factor| scaled(factor, value));
    format!(".shift({x}, {y}, {z})")
}

/// A rotation about any axis: one about an axis of the frame, between rotations there and back.
pub fn turn(axis: &[f64; 3], value: &str) -> Vec<String> {
    let (there, index, sign) = straightened(axis);
    let value = match sign {
        "" => bare(value).to_owned(),
        sign => format!("{sign}{value}"),
    };
    conjugated(&there, vec![format!(".turn({}, {value})", AXES[index])])
}

/// Steps between constant rotations and their inverses.
pub fn conjugated(there: &[(usize, Angle)], steps: Vec<String>) -> Vec<String> {
    let step = |axis: usize, angle: &Angle| format!(".turn({}, {angle})", AXES[axis]);
    let lead = there.iter().map(|(axis, angle)| step(*axis, angle));
    let back = there
        .iter()
        .rev()
        .map(|(axis, angle)| step(*axis, &angle.negated()));
    lead.chain(steps).chain(back).collect()
}

/// The rotation by a constant angle about any axis.
pub fn conjugating(axis: &[f64; 3], angle: Angle) -> Turns {
    let (there, index, sign) = straightened(axis);
    let angle = if sign.is_empty() {
        angle
    } else {
        angle.negated()
    };
    let back = there
        .iter()
        .rev()
        .map(|(axis, angle)| (*axis, angle.negated()));
    let lead = there.iter().cloned().chain([(index, angle)]);
    lead.chain(back).collect()
}

/// Constant rotations that bring one of a frame's axes to a unit vector: the rotations, the axis, and `-` if it is brought
/// to the opposite vector.
pub fn straightened(axis: &[f64; 3]) -> (Turns, usize, &'static str) {
    let [x, y, z] = *axis;
    let of = Angle::computed;
    for (last, along) in axis.iter().enumerate() {
        if along.abs() == 1.0 && axis.iter().filter(|x| **x != 0.0).count() == 1 {
            return (Vec::new(), last, if *along < 0.0 { "-" } else { "" });
        }
    }
    let (there, last) = match (x == 0.0, y == 0.0, z == 0.0) {
        // The rotation about x takes z to (0, -sin, cos).
        (true, ..) => (vec![(0, of((-y).atan2(z)))], 2),
        (_, true, _) => (vec![(1, of(x.atan2(z)))], 2),
        (.., true) => (vec![(2, of(y.atan2(x)))], 0),
        // Rotations about z, then y, take z to (sin β cos α, sin β sin α, cos β).
        _ => (vec![(2, of(y.atan2(x))), (1, of(x.hypot(y).atan2(z)))], 2),
    };
    (there, last, "")
}

/// The angles of three successive rotations about axes of the frame itself that lead to a frame with these axes as columns. Where
/// the middle one leaves the other two undetermined, the last is 0.
pub fn angles(rotation: &Matrix3<f64>, sequence: [usize; 3]) -> [Angle; 3] {
    let [first, middle, last] = sequence;
    let r = |i: usize, j: usize| rotation[(i, j)];
    let is_proper = first == last;
    let third = 3 - first - middle;
    // 1 if first, middle and the third axis are in cyclic order, as x, y and z are.
    let order = if (middle + 3 - first) % 3 == 1 {
        1.0
    } else {
        -1.0
    };
    let (sin, cos) = if is_proper {
        (r(first, middle).hypot(r(first, third)), r(first, first))
    } else {
        (order * r(first, last), r(last, last).hypot(r(middle, last)))
    };
    let middle_angle = sin.atan2(cos);
    let is_singular = if is_proper {
        sin <= SINGULAR
    } else {
        cos <= SINGULAR
    };
    let (start, end) = match (is_proper, is_singular) {
        (_, true) => ((order * r(third, middle)).atan2(r(middle, middle)), 0.0),
        (true, false) => (
            r(middle, first).atan2(-order * r(third, first)),
            r(first, middle).atan2(order * r(first, third)),
        ),
        (false, false) => (
            (-order * r(middle, last)).atan2(r(last, last)),
            (-order * r(first, middle)).atan2(r(first, first)),
        ),
    };
    [start, middle_angle, end].map(Angle::computed)
}

/// Rotations that lead to a frame with these axes as columns: none, one, or three.
pub fn turns(rotation: &Matrix3<f64>) -> Turns {
    // Cardan angles and Euler angles are never both singular.
    let is_steep = rotation[(2, 0)].abs() > 0.9;
    let sequence = if is_steep { [2, 0, 2] } else { [2, 1, 0] };
    let angles = angles(rotation, sequence);
    let turns = sequence.into_iter().zip(angles);
    turns
        .filter(|(_, angle)| angle.value().abs() > ROUNDING)
        .collect()
}

/// The axes, as columns, of a rotated frame.
pub fn axes(turns: &Turns) -> Matrix3<f64> {
    turns
        .iter()
        .fold(Matrix3::identity(), |axes, (axis, angle)| {
            let (sin, cos) = match angle {
                Angle::Twelfths(k) if k % 6 == 0 => {
                    [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]
                        [(k / 6).rem_euclid(4) as usize]
                }
                angle => angle.value().sin_cos(),
            };
            let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
            let mut turn = Matrix3::identity();
            turn[(next, next)] = cos;
            turn[(next, last)] = -sin;
            turn[(last, next)] = sin;
            turn[(last, last)] = cos;
            axes * turn
        })
}

/// The unit quaternion that leads to a frame with these axes as columns, with a positive largest component (S. W. Shepperd,
/// *Quaternion from rotation matrix*, J. Guidance and Control 1 (1978) 223–224).
pub fn quaternion(rotation: &Matrix3<f64>) -> [f64; 4] {
    let r = |i: usize, j: usize| rotation[(i, j)];
    let trace = rotation.trace();
    // 4 times the squares of the components; the largest follows from a root, and the others from products with it.
    let squares = [
        1.0 + trace,
        1.0 - trace + 2.0 * r(0, 0),
        1.0 - trace + 2.0 * r(1, 1),
        1.0 - trace + 2.0 * r(2, 2),
    ];
    let products = [
        [
            squares[0],
            r(2, 1) - r(1, 2),
            r(0, 2) - r(2, 0),
            r(1, 0) - r(0, 1),
        ],
        [
            r(2, 1) - r(1, 2),
            squares[1],
            r(1, 0) + r(0, 1),
            r(0, 2) + r(2, 0),
        ],
        [
            r(0, 2) - r(2, 0),
            r(1, 0) + r(0, 1),
            squares[2],
            r(2, 1) + r(1, 2),
        ],
        [
            r(1, 0) - r(0, 1),
            r(0, 2) + r(2, 0),
            r(2, 1) + r(1, 2),
            squares[3],
        ],
    ];
    let largest = (0..4).max_by(|&a, &b| squares[a].total_cmp(&squares[b]));
    let row = products[largest.unwrap_or(0)];
    let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
    row.map(|x| {
        if (x / length).abs() <= ROUNDING {
            0.0
        } else {
            x / length
        }
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    /// Every sequence of angles that a file may use reproduces the axes from which it was computed.
    #[test]
    fn angles_lead_to_the_axes_that_they_are_of() {
        let turned = |list: [(usize, f64); 3]| {
            axes(
                &list
                    .map(|(axis, angle)| (axis, Angle::computed(angle)))
                    .to_vec(),
            )
        };
        for angles_of in [
            [0.3, -1.1, 2.4],
            [-2.0, 0.7, 0.1],
            [0.0, FRAC_PI_2, 0.4],
            [0.5, 0.0, 0.0],
            [1.0, -FRAC_PI_2, 0.2],
            [0.3, PI, 0.1],
        ] {
            for sequence in [
                [0, 1, 2],
                [2, 1, 0],
                [2, 0, 2],
                [1, 2, 0],
                [1, 0, 1],
                [0, 2, 0],
            ] {
                let place = |i: usize| (sequence[i], angles_of[i]);
                let goal = turned([place(0), place(1), place(2)]);
                let euler_angles = angles(&goal, sequence);
                let place = |i: usize| (sequence[i], euler_angles[i].value());
                let again = turned([place(0), place(1), place(2)]);
                // About ten roundings of numbers up to 1, and of angles up to pi.
                assert!((again - goal).amax() <= 1e-14, "{angles_of:?} {sequence:?}");
                assert!(
                    (axes(&turns(&goal)) - goal).amax() <= 1e-14,
                    "{angles_of:?}"
                );
            }
        }
    }
}
