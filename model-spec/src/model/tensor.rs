//! Tensors of inertia that no body has.

use lagrangian_symbolic::sorting::sort_by;

/// How far a tensor may violate the conditions on a body, relative to its largest entry: data have few digits.
const SLACK: f64 = 1e-6;

/// Jacobi's rotations converge quadratically: from the third sweep on each one doubles the digits, so that these leave a wide margin.
const SWEEPS: usize = 10;

/// Why no body has the tensor Ixx, Iyy, Izz, Ixy, Ixz, Iyz, if so. Moments that are negative or unknown are not its concern.
///
/// With the density ρ and the position r from the mass centre, I = tr(E) 1 − E with E = ∫ ρ r rᵀ dV, which has no negative principal
/// values; so no principal moment exceeds the sum of the other two, and one equals it if the body is flat or a rod.
pub(super) fn flaw(tensor: [f64; 6]) -> Option<String> {
    let largest = tensor.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if tensor[..3].iter().any(|moment| *moment < 0.0) || !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // Scaled to entries near 1 by a power of two, which rounds nothing.
    let scale = 2.0_f64.powi(largest.log2().floor() as i32);
    let [a, b, c] = principal_moments(tensor.map(|entry| entry / scale));
    let [x, y, z] = [a, b, c].map(|moment| moment * scale);
    (c > a + b + SLACK * (largest / scale)).then(|| {
        format!(
            "no body has this inertia: its principal moments are {x:.4e}, {y:.4e} and {z:.4e} kg*m^2, and none can exceed the sum of \
             the other two"
        )
    })
}

/// The principal moments in increasing order, by Jacobi's method (G. H. Golub and C. F. Van Loan, *Matrix Computations*, section 8.5).
fn principal_moments([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    let mut matrix = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    for (p, q, r) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)].repeat(SWEEPS) {
        let off = matrix[p][q];
        // What is exactly 0 needs no rotation, and would divide by itself.
        if off == 0.0 {
            continue;
        }
        let theta = (matrix[q][q] - matrix[p][p]) / (2.0 * off);
        let tan = theta.signum() / (theta.abs() + theta.hypot(1.0));
        let cos = 1.0 / tan.hypot(1.0);
        let sin = tan * cos;
        matrix[p][p] -= tan * off;
        matrix[q][q] += tan * off;
        let [at_p, at_q] = [matrix[p][r], matrix[q][r]];
        let [at_p, at_q] = [cos * at_p - sin * at_q, sin * at_p + cos * at_q];
        for (i, j, entry) in [(p, q, 0.0), (p, r, at_p), (q, r, at_q)] {
            matrix[i][j] = entry;
            matrix[j][i] = entry;
        }
    }
    let mut moments = [matrix[0][0], matrix[1][1], matrix[2][2]];
    sort_by(&mut moments, f64::total_cmp);
    moments
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass of 1 at (1, 2, 2) has the moments 0, 9 and 9 about the origin. With the other sign of its products the tensor is that of no
    /// body: E then has the determinant of [[1, −2, −2], [−2, 4, −4], [−2, −4, 4]], which is −64.
    #[test]
    fn principal_moments_of_a_particle() {
        let particle = [8.0, 5.0, 5.0, -2.0, -2.0, -4.0];
        let found = principal_moments(particle);
        let off = found.iter().zip([0.0, 9.0, 9.0]);
        let off = off.fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()));
        // Three sweeps of three rotations, each with some ten roundings of numbers up to 9.
        assert!(off <= 90.0 * 9.0 * f64::EPSILON, "{found:?}");
        assert_eq!(flaw(particle), None);
        assert!(flaw([8.0, 5.0, 5.0, 2.0, 2.0, 4.0]).is_some());
    }

    #[test]
    fn what_no_body_has() {
        for (tensor, is_fine) in [
            ([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], true),
            ([0.0; 6], true),
            ([1.0, 1.0, 0.0, 0.0, 0.0, 0.0], true),
            // A plate, also with moments that were rounded.
            ([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], true),
            ([0.1, 0.2, 0.1 + 0.2, 0.0, 0.0, 0.0], true),
            ([1.0, 2.0, 3.000_001, 0.0, 0.0, 0.0], true),
            ([1e-300, 2e-300, 3e-300, 0.0, 0.0, 0.0], true),
            ([1e300, 2e300, 3e300, 0.0, 0.0, 0.0], true),
            ([f64::NAN, 1.0, 5.0, 0.0, 0.0, 0.0], true),
            ([1.0, 1.0, 5.0, 0.0, 0.0, 0.0], false),
            ([0.0, 0.0, 1.0, 0.0, 0.0, 0.0], false),
            ([1e300, 1e300, 2.5e300, 0.0, 0.0, 0.0], false),
            ([1e-300, 5e-300, 1e-300, 0.0, 0.0, 0.0], false),
            // A plate with a product across it.
            ([1.0, 2.0, 3.0, 0.0, 0.1, 0.0], false),
            ([1.0, 1.0, 1.0, 2.0, 0.0, 0.0], false),
            ([0.0, 0.0, 0.0, 1.0, 0.0, 0.0], false),
        ] {
            assert_eq!(flaw(tensor).is_none(), is_fine, "{tensor:?}");
        }
    }
}
