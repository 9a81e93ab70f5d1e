//! The discrete Fourier transform of any number of samples.

use num_complex::Complex;
use realfft::RealFftPlanner;

/// `Σ xₙ e^{−2πi k n/N}` for k from 0 to N/2; the remaining values are conjugate to these.
pub fn transform(samples: &[f64]) -> Vec<Complex<f64>> {
    if samples.is_empty() {
        return Vec::new();
    }
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(samples.len());
    let (mut values, mut result) = (samples.to_vec(), plan.make_output_vec());
    // It fails only if lengths differ from those of the plan.
    if plan.process(&mut values, &mut result).is_err() {
        result.fill(Complex::new(f64::NAN, f64::NAN));
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of `numpy.fft.rfft` of NumPy 2.4.6 for n³ mod 11 − 4.
    #[test]
    fn numbers_are_those_of_numpy() {
        let of_seven = [
            (6.0, 0.0),
            (-10.295_896_943_239_772, 2.526_812_202_551_116_4),
            (-3.862_936_660_457_275, 4.457_776_499_689_055),
            (-2.841_166_396_302_952_5, 9.630_340_013_304_762),
        ];
        let of_ten = [
            (5.0, 0.0),
            (-11.545_084_971_874_736, -4.755_282_581_475_767),
            (-6.809_016_994_374_947_5, 4.392_011_317_473_087),
            (-5.954_915_028_125_263, 2.938_926_261_462_366),
            (-5.690_983_005_625_052_5, 1.400_084_492_874_738_7),
            (15.0, 0.0),
        ];
        for (count, exact) in [(7, &of_seven[..]), (10, &of_ten[..])] {
            let samples: Vec<f64> = (0..count)
                .map(|n| f64::from(n * n * n % 11) - 4.0)
                .collect();
            let found = transform(&samples);
            assert_eq!(found.len(), exact.len());
            for (found, exact) in found.iter().zip(exact) {
                let off = (found - Complex::new(exact.0, exact.1)).norm();
                // Sums of ten numbers of size 6.
                assert!(off < 60.0 * 4.0 * f64::EPSILON, "{found} {exact:?}");
            }
        }
        assert!(transform(&[]).is_empty());
        assert_eq!(transform(&[3.0]), [Complex::new(3.0, 0.0)]);
    }
}
