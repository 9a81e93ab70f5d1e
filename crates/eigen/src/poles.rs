//! Poles: the eigenvalues of A.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix};

use crate::precise;

/// An eigenvalue of a real matrix.
#[derive(Clone, Debug)]
pub struct Pole {
    /// λ, in 1/s: set to exactly real, imaginary or zero where it is so within its error.
    pub lambda: Complex<f64>,
    /// Bound on the error of λ, in 1/s.
    pub error: f64,
    /// Its eigenvector, scaled to a largest entry of 1.
    pub shape: Vec<Complex<f64>>,
}

/// All eigenvalues of a matrix whose entries are known up to `bounds`, slow oscillations before fast ones. Both of each
/// conjugate pair are listed, the one above the real axis first. `None` where the iterations do not converge.
pub fn poles(a: &DMatrix<f64>, bounds: &DMatrix<f64>) -> Option<Vec<Pole>> {
    let n = a.nrows();
    if n == 0 {
        return Some(Vec::new());
    }
    let mut balanced = a.clone();
    let scales = balance_parlett_reinsch(&mut balanced);
    let bounds = DMatrix::from_fn(n, n, |i, j| bounds[(i, j)] * scales[j] / scales[i]);
    // An entry is typically a sum of as many terms as there are states.
    let roundings = 8.0 * n as f64;
    let mut poles = Vec::with_capacity(n);
    for pair in precise::pairs(&balanced, &(bounds / roundings))? {
        let error = roundings * pair.error;
        let settle = |x: f64| if x.abs() <= error { 0.0 } else { x };
        let raw = pair.lambda;
        let lambda = Complex::new(settle(raw.re), settle(raw.im));
        let shape = pair.right.iter().zip(scales.iter()).map(|(x, d)| x * *d);
        let shape: Vec<Complex<f64>> = shape.collect();
        let largest = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
        let unit = shape.iter().find(|x| x.norm() >= (1.0 - 1e-9) * largest);
        let unit = unit.copied().unwrap_or(Complex::new(1.0, 0.0));
        let shape: Vec<Complex<f64>> = shape.iter().map(|x| x / unit).collect();
        let conjugate = Pole {
            lambda: lambda.conj(),
            error,
            shape: shape.iter().map(|x| x.conj()).collect(),
        };
        poles.push(Pole {
            lambda,
            error,
            shape,
        });
        // A pair that is real within its error is a double eigenvalue.
        if raw.im > 0.0 {
            poles.push(conjugate);
        }
    }
    // The two of a conjugate pair stay adjacent because their keys are equal bit for bit.
    poles.sort_by(|a, b| {
        let key = |pole: &Pole| (pole.lambda.im.abs(), pole.lambda.norm(), pole.lambda.re);
        let ((a1, a2, a3), (b1, b2, b3)) = (key(a), key(b));
        a1.total_cmp(&b1)
            .then(a2.total_cmp(&b2))
            .then(a3.total_cmp(&b3))
            .then(b.lambda.im.total_cmp(&a.lambda.im))
    });
    Some(poles)
}
