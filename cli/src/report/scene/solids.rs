//! The uniform solids that have the mass and the inertia of a body in space.

use super::Solid;

/// The uniform cylinder, or otherwise the box, with this mass and inertia `xx, yy, zz, xy, xz, yz`.
///
/// A cylinder of radius R and height 2h has m R²/2 about its axis and m (R²/4 + h²/3) across it; a box of sides 2a, 2b, 2c
/// has m (b² + c²)/3 about the first axis. A tensor that no solid has (A > B + C) gives sides of 0.
pub(super) fn solid_in_space(mass: f64, inertia: &[f64]) -> Option<Solid> {
    let &[xx, yy, zz, xy, xz, yz] = inertia else {
        return None;
    };
    let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let (moments, axes) = principal(tensor);
    let largest = moments.iter().fold(0.0_f64, |a, b| a.max(*b));
    if !(mass > 0.0 && largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let equal = |a: f64, b: f64| (a - b).abs() < 1e-9 * largest;
    let root = |x: f64| if x > 0.0 { x.sqrt() } else { 0.0 };
    for (axis, [b, c]) in [(2, [0, 1]), (0, [1, 2]), (1, [2, 0])] {
        if equal(moments[b], moments[c]) && !equal(moments[axis], moments[b]) {
            let radius = root(2.0 * moments[axis] / mass);
            let half = root(3.0 * (moments[b] / mass - radius * radius / 4.0));
            return Some(Solid::Cylinder {
                axis: axes[axis],
                radius,
                half,
            });
        }
    }
    let half = [0, 1, 2].map(|axis| {
        let others = moments.iter().sum::<f64>() - 2.0 * moments[axis];
        root(1.5 * others / mass)
    });
    Some(Solid::Box { axes, half })
}

/// Principal moments and axes of a symmetric tensor, by Jacobi rotations. G. H. Golub and C. F. Van Loan, *Matrix
/// Computations*, 4th ed. (2013), section 8.5.
fn principal(mut a: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    // The rows of `v` are the axes.
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Convergence is quadratic: a few sweeps reach round-off.
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let tan = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            for row in &mut a {
                let (x, y) = (row[p], row[q]);
                (row[p], row[q]) = (cos * x - sin * y, sin * x + cos * y);
            }
            for k in 0..3 {
                let (x, y) = (a[p][k], a[q][k]);
                (a[p][k], a[q][k]) = (cos * x - sin * y, sin * x + cos * y);
                let (x, y) = (v[p][k], v[q][k]);
                (v[p][k], v[q][k]) = (cos * x - sin * y, sin * x + cos * y);
            }
        }
    }
    ([a[0][0], a[1][1], a[2][2]], v)
}
