//! The discrete Fourier transform, of any number of samples.

use std::f64::consts::PI;

use num_complex::Complex;

/// `Σ xₙ e^{−2πi k n/N}` for k from 0 to N/2: the others are conjugate to these.
///
/// Any N becomes a convolution with e^{−πi n²/N}, which powers of two do (L. I. Bluestein, *A linear filtering approach to the
/// computation of discrete Fourier transform*, IEEE Trans. Audio Electroacoust. 18 (1970) 451–455).
pub fn transform(samples: &[f64]) -> Vec<Complex<f64>> {
    let count = samples.len();
    let size = (2 * count).next_power_of_two();
    // n² modulo 2N, so that angles keep their digits.
    let chirp: Vec<Complex<f64>> = (0..count as u64)
        .map(|n| {
            let turn = (n * n) % (2 * count as u64);
            Complex::from_polar(1.0, -PI * turn as f64 / count as f64)
        })
        .collect();
    let nothing = Complex::new(0.0, 0.0);
    let (mut values, mut kernel) = (vec![nothing; size], vec![nothing; size]);
    for (n, (x, chirp)) in samples.iter().zip(&chirp).enumerate() {
        values[n] = chirp * x;
        kernel[n] = chirp.conj();
        kernel[(size - n) % size] = chirp.conj();
    }
    let factors = factors(size);
    radix_two(&mut values, &factors);
    radix_two(&mut kernel, &factors);
    for (x, kernel) in values.iter_mut().zip(&kernel) {
        // Conjugated, the transform goes back.
        *x = (*x * kernel).conj();
    }
    radix_two(&mut values, &factors);
    let back = values.iter().zip(&chirp).take(count / 2 + 1);
    back.map(|(x, chirp)| x.conj() / size as f64 * chirp)
        .collect()
}

/// `e^{−2πi k/N}` for k below N/2.
fn factors(size: usize) -> Vec<Complex<f64>> {
    let half = 0..size / 2;
    half.map(|k| Complex::from_polar(1.0, -2.0 * PI * k as f64 / size as f64))
        .collect()
}

/// The transform of 2ᵐ numbers in their place (J. W. Cooley, J. W. Tukey, *An algorithm for the machine calculation of complex Fourier
/// series*, Math. Comp. 19 (1965) 297–301).
fn radix_two(values: &mut [Complex<f64>], factors: &[Complex<f64>]) {
    let size = values.len();
    let bits = size.trailing_zeros();
    for k in 0..size {
        let reversed = (k.reverse_bits() >> (usize::BITS - bits.max(1))) & (size - 1);
        if k < reversed {
            values.swap(k, reversed);
        }
    }
    let mut half = 1;
    while half < size {
        let stride = size / (2 * half);
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (k, (low, high)) in low.iter_mut().zip(high).enumerate() {
                let turned = *high * factors[k * stride];
                (*low, *high) = (*low + turned, *low - turned);
            }
        }
        half *= 2;
    }
}
