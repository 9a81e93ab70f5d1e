//! Pontryagin's function, and its derivatives by dual numbers.

use lagrangian_scalar::{Dual, Scalar};

/// An optimal control problem, given by its Pontryagin function.
pub trait Pontryagin {
    /// The number of states, which is also that of multipliers.
    fn states(&self) -> usize;
    /// The number of controls.
    fn controls(&self) -> usize;
    /// `H`.
    fn value<N: Scalar>(&self, y: &[N], z: &[N]) -> N;

    /// `H` and its derivatives by y and z.
    fn slopes(&self, y: &[f64], z: &[f64]) -> (f64, Vec<f64>) {
        let mut numbers: Vec<Dual<f64>> = y.iter().chain(z).map(|x| Dual::constant(*x)).collect();
        let mut value = 0.0;
        let slopes = (0..numbers.len()).map(|i| {
            numbers[i].derivative = 1.0;
            let (y, z) = numbers.split_at(y.len());
            let dual = self.value(y, z);
            numbers[i].derivative = 0.0;
            value = dual.value;
            dual.derivative
        });
        let slopes = slopes.collect();
        (value, slopes)
    }

    /// Second derivatives of H by y and z, by rows; and the first.
    fn curvatures(&self, y: &[f64], z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let flat = |x: &f64| Dual::constant(Dual::constant(*x));
        let mut numbers: Vec<Dual<Dual<f64>>> = y.iter().chain(z).map(flat).collect();
        let count = numbers.len();
        let mut slopes = std::vec![0.0; count];
        let mut second = std::vec![std::vec![0.0; count]; count];
        for i in 0..count {
            numbers[i].derivative = Dual::constant(1.0);
            for j in 0..=i {
                numbers[j].value.derivative = 1.0;
                let (y, z) = numbers.split_at(y.len());
                let slope = self.value(y, z).derivative;
                numbers[j].value.derivative = 0.0;
                slopes[i] = slope.value;
                (second[i][j], second[j][i]) = (slope.derivative, slope.derivative);
            }
            numbers[i].derivative = Dual::constant(0.0);
        }
        (slopes, second)
    }
}
