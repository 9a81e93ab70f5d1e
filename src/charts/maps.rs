//! The maps between polar and Cartesian coordinates and their rates.

use crate::scalar::Scalar;

/// Replaces polar coordinates and their rates by Cartesian ones, for each point of a machine (the indices of its distance and its angle):
/// `x = s cos φ`, `y = s sin φ`. Lengths in m, angles in rad, times in s.
pub fn to_cartesian(points: &[[usize; 2]], q: &mut [f64], v: &mut [f64]) {
    for &[i, j] in points {
        let ([s, phi], [s_rate, phi_rate]) = ([q[i], q[j]], [v[i], v[j]]);
        let (sin, cos) = Scalar::sin_cos(phi);
        (q[i], q[j]) = (s * cos, s * sin);
        v[i] = s_rate * cos - s * phi_rate * sin;
        v[j] = s_rate * sin + s * phi_rate * cos;
    }
}

/// Replaces Cartesian coordinates and their rates by polar ones, for each point of a machine (the indices of its two components). The
/// distance is not negative, and the angle is between −π and π. At the centre itself, where polar coordinates have no other value, the
/// angle is that of the velocity, the rate of the distance is the speed, and that of the angle is 0.
pub fn to_polar(points: &[[usize; 2]], q: &mut [f64], v: &mut [f64]) {
    for &[i, j] in points {
        let (place, rate) = ([q[i], q[j]], [v[i], v[j]]);
        let (s, rates) = distance_and_rates(place, rate);
        let [x, y] = if s > 0.0 { place } else { rate };
        (q[i], q[j]) = (s, Scalar::atan2(y, x));
        [v[i], v[j]] = rates;
    }
}

/// The distance of a point from the centre, and the rates of this and of its angle.
pub(super) fn distance_and_rates([x, y]: [f64; 2], [vx, vy]: [f64; 2]) -> (f64, [f64; 2]) {
    let s = length([x, y]);
    if s > 0.0 {
        let (cos, sin) = (x / s, y / s);
        // The sum with 0 makes -0 an ordinary 0.
        (s, [cos * vx + sin * vy, (cos * vy - sin * vx) / s + 0.0])
    } else {
        (s, [length([vx, vy]), 0.0])
    }
}

/// `√(x² + y²)`, without overflow and underflow of the squares.
pub(super) fn length([x, y]: [f64; 2]) -> f64 {
    let size = Scalar::max(Scalar::abs(x), Scalar::abs(y));
    // Not a number, or nothing to scale by.
    if !(size > 0.0 && size.is_finite()) {
        return size;
    }
    let (x, y) = (x / size, y / size);
    size * Scalar::sqrt(x * x + y * y)
}
