//! Inertia tensors: rotation to other axes, and a check that a body can have them.

use lagrangian_scalar::{DoubleDouble, Scalar};
use nalgebra::{Matrix3, SymmetricEigen};

use super::number::{Angle, Number};
use super::steps::Turns;

/// How far a tensor may violate the conditions on a body, relative to its largest entry: files give few digits.
const SLACK: f64 = 1e-6;

type Rotation = [[DoubleDouble; 3]; 3];

/// The entries Ixx, Iyy, Izz, Ixy, Ixz, Iyz.
pub type Tensor = [Number; 6];

/// The matrix positions of these entries.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

fn matrix<T: Copy>(entries: [T; 6]) -> [[T; 3]; 3] {
    let [xx, yy, zz, xy, xz, yz] = entries;
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// Why no body can have this tensor, if so.
pub fn flaw(tensor: &Tensor) -> Option<String> {
    let rows = matrix(tensor.each_ref().map(|entry| entry.value));
    let largest = rows.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    // Scaled to entries near 1, whatever the units.
    let scaled = Matrix3::from_fn(|i, j| rows[i][j] / largest);
    let mut moments: Vec<f64> = SymmetricEigen::new(scaled)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    moments.sort_by(f64::total_cmp);
    let [a, b, c] = moments[..] else {
        return None;
    };
    let shown = format!(
        "its principal moments are {:.4e}, {:.4e} and {:.4e} kg m²",
        a * largest,
        b * largest,
        c * largest
    );
    if a < -SLACK {
        return Some(format!("{shown}, and no body has a negative one"));
    }
    (c > (a + b) + SLACK)
        .then(|| format!("{shown}, but for a body none can exceed the sum of the other two"))
}

/// The tensor in the axes of a frame, from one in rotated axes: R I Rᵀ. Computed with 106 bits and rounded once; without rotation
/// the digits are kept.
pub fn rotated(tensor: &Tensor, turns: &Turns) -> Tensor {
    if turns.iter().all(|(_, angle)| angle.is_zero()) {
        return tensor.clone();
    }
    let mut rotation = about(0, &Angle::Twelfths(0));
    for (axis, angle) in turns {
        rotation = times(&rotation, &about(*axis, angle));
    }
    let entries = tensor
        .each_ref()
        .map(|entry| DoubleDouble::from(entry.value));
    let half = times(&rotation, &matrix(entries));
    PLACES.map(|(i, j)| {
        let entry = (0..3).fold(DoubleDouble::ZERO, |sum, k| {
            sum + half[i][k] * rotation[j][k]
        });
        Number::computed(entry.hi())
    })
}

fn times(a: &Rotation, b: &Rotation) -> Rotation {
    let entry =
        |i: usize, j: usize| (0..3).fold(DoubleDouble::ZERO, |sum, k| sum + a[i][k] * b[k][j]);
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The rotation about an axis of the frame, 0 to 2.
fn about(axis: usize, angle: &Angle) -> Rotation {
    let (sin, cos) = sin_cos(angle);
    let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
    let mut rotation = [[DoubleDouble::ZERO; 3]; 3];
    rotation[axis][axis] = DoubleDouble::ONE;
    rotation[next][next] = cos;
    rotation[next][last] = -sin;
    rotation[last][next] = sin;
    rotation[last][last] = cos;
    rotation
}

fn sin_cos(angle: &Angle) -> (DoubleDouble, DoubleDouble) {
    let (zero, one) = (DoubleDouble::ZERO, DoubleDouble::ONE);
    match angle {
        Angle::Twelfths(k) if k % 6 == 0 => match (k / 6).rem_euclid(4) {
            0 => (zero, one),
            1 => (one, zero),
            2 => (zero, -one),
            _ => (-one, zero),
        },
        Angle::Twelfths(k) => {
            let angle = DoubleDouble::pi() * DoubleDouble::from_ratio(i64::from(*k), 12);
            (angle.sin(), angle.cos())
        }
        Angle::Radians(number) => {
            let angle = DoubleDouble::from(number.value);
            (angle.sin(), angle.cos())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers<const N: usize>(texts: [&str; N]) -> [Number; N] {
        texts.map(|text| Number::read(text).expect(text))
    }

    fn turns(rpy: [&str; 3]) -> Turns {
        let [roll, pitch, yaw] = numbers(rpy).map(|number| Angle::of(&number));
        vec![(2, yaw), (1, pitch), (0, roll)]
    }

    fn texts(tensor: &Tensor) -> [String; 6] {
        tensor.each_ref().map(Number::to_string)
    }

    #[test]
    fn quarter_turns_change_places_and_signs() {
        let tensor = numbers(["1", "2.5", "3", "0.1", "0.2", "0.3"]);
        let half_pi = "1.5707963267948966";
        // A rotation about z takes x to y and y to -x.
        let about_z = rotated(&tensor, &turns(["0", "0", half_pi]));
        assert_eq!(texts(&about_z), ["2.5", "1", "3", "-0.1", "-0.3", "0.2"]);
        let about_x = rotated(&tensor, &turns([half_pi, "0", "0"]));
        assert_eq!(texts(&about_x), ["1", "3", "2.5", "-0.2", "0.1", "-0.3"]);
        assert_eq!(rotated(&tensor, &turns(["0", "0", "0"])), tensor);
    }

    /// A rod along its own z axis has the tensor m l²/12 (1 - u uᵀ), where u is the direction of z.
    #[test]
    fn a_rod_in_any_direction() {
        let (roll, pitch, yaw): (f64, f64, f64) = (0.3, -0.7, 1.9);
        let rod = numbers(["0.25", "0.25", "0", "0", "0", "0"]);
        let turned = rotated(&rod, &turns(["0.3", "-0.7", "1.9"]));
        let (flat, height) = (roll.cos() * pitch.sin(), roll.cos() * pitch.cos());
        let u = [
            yaw.cos() * flat + yaw.sin() * roll.sin(),
            yaw.sin() * flat - yaw.cos() * roll.sin(),
            height,
        ];
        for (entry, (i, j)) in turned.iter().zip(PLACES) {
            let unit = if i == j { 1.0 } else { 0.0 };
            let exact = 0.25 * (unit - u[i] * u[j]);
            // About ten roundings of numbers below 0.25.
            assert!((entry.value - exact).abs() <= 10.0 * 0.25 * f64::EPSILON);
        }
    }

    #[test]
    fn what_no_body_has() {
        for (tensor, is_fine) in [
            (["1", "1", "1", "0", "0", "0"], true),
            (["0", "0", "0", "0", "0", "0"], true),
            (["1", "1", "0", "0", "0", "0"], true),
            (["1", "2", "3", "0", "0", "0"], true),
            (["1", "2", "3.000001", "0", "0", "0"], true),
            (["1", "2", "3.1", "0", "0", "0"], false),
            (["1", "1", "-1e-3", "0", "0", "0"], false),
            (["1e-9", "1e-9", "1e-9", "2e-9", "0", "0"], false),
            (["0", "0", "0", "1", "0", "0"], false),
        ] {
            assert_eq!(flaw(&numbers(tensor)).is_none(), is_fine, "{tensor:?}");
        }
    }
}
