//! Derivatives of motions in the two charts of a machine with polar coordinates.
//!
//! A motion in Cartesian coordinates is continued with its derivatives through the centre, where polar coordinates have none. At its
//! start its derivatives are mapped to the Cartesian coordinates, and where results are needed back to polar ones, both by the derivative
//! of the map between the coordinates and their rates. Nothing else is needed, since the map is smooth and does not change with time.

use lagrangian_scalar::{Dual, Scalar};

/// A state with its derivatives in each direction: coordinates or rates, values and then the derivatives.
type Lists<'a> = [&'a mut [f64]; 2];

/// Replaces polar coordinates, their rates and the derivatives of both by those of Cartesian coordinates. `q` and `v` are the numbers of a
/// machine with `dimension` coordinates, followed by their derivatives in each direction; `points` has for each point the indices of its
/// distance and its angle.
pub fn to_cartesian(points: &[[usize; 2]], dimension: usize, [q, v]: Lists<'_>) {
    each(points, dimension, [q, v], |[s, phi], [ds, dphi]| {
        let (sin, cos) = phi.sin_cos();
        let place = [s * cos, s * sin];
        let rate = [ds * cos - s * dphi * sin, ds * sin + s * dphi * cos];
        [place, rate]
    });
}

/// Replaces Cartesian coordinates, their rates and the derivatives of both by those of polar coordinates, whose angle is between −π and π. At
/// the centre itself they are not a number.
pub fn to_polar(points: &[[usize; 2]], dimension: usize, [q, v]: Lists<'_>) {
    each(points, dimension, [q, v], |[x, y], [dx, dy]| {
        let s = (x * x + y * y).sqrt();
        let (cos, sin) = (x / s, y / s);
        let place = [s, Scalar::atan2(y, x)];
        let rate = [cos * dx + sin * dy, (cos * dy - sin * dx) / s];
        [place, rate]
    });
}

/// Applies a map to each point, with its derivatives in each direction.
fn each(
    points: &[[usize; 2]],
    n: usize,
    [q, v]: Lists<'_>,
    map: impl Fn([Dual<f64>; 2], [Dual<f64>; 2]) -> [[Dual<f64>; 2]; 2],
) {
    for &[i, j] in points {
        let own = [[q[i], q[j]], [v[i], v[j]]];
        for from in (n..q.len()).step_by(n) {
            let dual = |value: f64, derivative: f64| Dual { value, derivative };
            let place = [dual(own[0][0], q[from + i]), dual(own[0][1], q[from + j])];
            let rate = [dual(own[1][0], v[from + i]), dual(own[1][1], v[from + j])];
            let [place, rate] = map(place, rate);
            (q[from + i], q[from + j]) = (place[0].derivative, place[1].derivative);
            (v[from + i], v[from + j]) = (rate[0].derivative, rate[1].derivative);
        }
        let [place, rate] = own.map(|pair| pair.map(Dual::constant));
        let [place, rate] = map(place, rate);
        (q[i], q[j]) = (place[0].value, place[1].value);
        (v[i], v[j]) = (rate[0].value, rate[1].value);
    }
}

#[cfg(test)]
mod tests {
    use super::{to_cartesian, to_polar};

    /// The derivatives of `x = s cos φ`, `y = s sin φ` and of their rates, typed by hand.
    #[test]
    fn derivatives_are_mapped_and_return() {
        let ([s, phi], [ds, dphi]) = ([0.7_f64, 2.0_f64], [-0.3_f64, 1.1_f64]);
        let (sin, cos) = phi.sin_cos();
        // A number before the point, and the directions of s and of φ̇.
        let q = vec![5.0, s, phi, 0.5, 1.0, 0.0, 0.25, 0.0, 0.0];
        let v = vec![6.0, ds, dphi, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        let (mut x, mut w) = (q.clone(), v.clone());
        to_cartesian(&[[1, 2]], 3, [&mut x, &mut w]);
        let expected_x = [5.0, s * cos, s * sin, 0.5, cos, sin, 0.25, 0.0, 0.0];
        let expected_w = [
            6.0,
            ds * cos - s * dphi * sin,
            ds * sin + s * dphi * cos,
            0.0,
            -dphi * sin,
            dphi * cos,
            0.0,
            -s * sin,
            s * cos,
        ];
        let close = |found: &[f64], expected: &[f64]| {
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{found} {expected}");
            }
        };
        close(&x, &expected_x);
        close(&w, &expected_w);
        to_polar(&[[1, 2]], 3, [&mut x, &mut w]);
        for (found, expected) in x.iter().chain(&w).zip(q.iter().chain(&v)) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }
}
