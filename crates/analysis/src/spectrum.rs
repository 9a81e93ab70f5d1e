//! The spectrum of a curve and its dominant frequencies.

use std::f64::consts::{PI, TAU};

use num_complex::Complex;

use crate::transform::transform;

/// The window function by which values are multiplied before the transform, to reduce leakage of frequencies that do not fit a
/// whole number of times into the time span. Windows are sums of cosines, periodic in the number of samples.
///
/// F. J. Harris, *On the use of windows for harmonic analysis with the discrete Fourier transform*, Proc. IEEE 66 (1978) 51–83.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// Rectangular: the narrowest lines, with side lobes of a fifth of them.
    None,
    /// Hann: lines two bins wide on each side, side lobes of 1/37 that fall off with the cube of the distance.
    Hann,
    /// Blackman–Harris with four terms: lines four bins wide on each side, side lobes of 1/40 000.
    BlackmanHarris,
}

impl Window {
    /// All windows.
    pub const ALL: [Window; 3] = [Window::Hann, Window::None, Window::BlackmanHarris];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Window::None => "none",
            Window::Hann => "hann",
            Window::BlackmanHarris => "blackman-harris",
        }
    }

    /// The coefficients a of `Σ (−1)ʲ aⱼ cos(2πjn/N)`.
    fn terms(self) -> &'static [f64] {
        match self {
            Window::None => &[1.0],
            Window::Hann => &[0.5, 0.5],
            Window::BlackmanHarris => &[0.35875, 0.48829, 0.14128, 0.01168],
        }
    }

    /// The weight of a sample.
    fn weight(self, n: usize, count: usize) -> f64 {
        let angle = TAU * n as f64 / count as f64;
        let terms = self.terms().iter().enumerate();
        terms
            .map(|(j, a)| if j % 2 == 0 { *a } else { -a } * (j as f64 * angle).cos())
            .sum()
    }

    /// The transform of `e^{2πi x n/N}` under the window at frequency 0, relative to that at x = 0: the response of
    /// the window to a line x bins away.
    fn leakage(self, x: f64, count: usize) -> Complex<f64> {
        let terms = self.terms();
        let mut sum = terms[0] * dirichlet(x, count);
        for (j, a) in terms.iter().enumerate().skip(1) {
            let sign = if j % 2 == 0 { 0.5 } else { -0.5 };
            let j = j as f64;
            sum += (dirichlet(x - j, count) + dirichlet(x + j, count)) * (sign * a);
        }
        sum / terms[0]
    }
}

/// `1/N Σ e^{2πi x n/N}` over n from 0 to N − 1, which has the period N.
fn dirichlet(x: f64, count: usize) -> Complex<f64> {
    let count = count as f64;
    let x = x - count * (x / count).round();
    let below = (PI * x / count).sin();
    if below == 0.0 {
        Complex::new(1.0, 0.0)
    } else {
        // The sine of π x is computed from the distance of x to the nearest integer, so that it is exactly 0 at integers.
        let nearest = x.round();
        let sine = (PI * (x - nearest)).sin() * if nearest % 2.0 == 0.0 { 1.0 } else { -1.0 };
        Complex::from_polar(sine / (count * below), PI * x * (count - 1.0) / count)
    }
}

/// The amplitudes of a curve at the frequencies k/(N h).
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Frequencies, in Hz, from 0 to half of the sampling rate.
    pub frequencies: Vec<f64>,
    /// Amplitudes in the unit of the curve: a sine of amplitude A at one of the frequencies has A there. The mean is subtracted
    /// before the transform and stored in `mean`.
    pub amplitudes: Vec<f64>,
    /// The mean of the samples, in the unit of the curve.
    pub mean: f64,
    /// The distance between frequencies, in Hz: the reciprocal of the duration of all samples.
    pub resolution: f64,
    /// The transform, divided by N/2 times the mean weight.
    transform: Vec<Complex<f64>>,
    /// The sines and cosines of πk/N, at all frequencies of the transform and three beyond them.
    half_angles: Vec<(f64, f64)>,
    window: Window,
    count: usize,
}

/// A sinusoidal component of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Its frequency, in Hz, interpolated between those of the spectrum.
    pub frequency: f64,
    /// Its amplitude, in the unit of the curve.
    pub amplitude: f64,
    /// Its phase φ in `A cos(2π f (t − t₀) + φ)`, in rad, with t₀ the first sample.
    pub phase: f64,
}

/// A line whose amplitude is less than this fraction of the spectrum at its frequency belongs to the leakage
/// of a greater one.
const OWN: f64 = 0.5;

/// A line this close to half of the sampling rate, in frequencies of the spectrum, is taken to be there: during the samples its amplitude and its phase
/// cannot be told apart.
const INDISTINCT: f64 = 0.05;

/// How many times all lines are refined with the others subtracted.
const ROUNDS: usize = 8;

/// Closer to a line than this many frequencies, divided by π, its response is computed from the distance itself. Beyond it the
/// round-off of a difference of angles is at most ε N/CLOSE of the response, which is less than a hundredth of the line there.
const CLOSE: f64 = 200.0;

/// The smallest number of samples of a spectrum.
pub const LEAST: usize = 4;

impl Spectrum {
    /// The spectrum of samples that are `step` seconds apart. `None` with fewer than [`LEAST`] samples, or where
    /// one is not finite.
    pub fn new(values: &[f64], step: f64, window: Window) -> Option<Spectrum> {
        let count = values.len();
        if count < LEAST || values.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mean = values.iter().sum::<f64>() / count as f64;
        let weighted: Vec<f64> = values
            .iter()
            .enumerate()
            .map(|(n, x)| (x - mean) * window.weight(n, count))
            .collect();
        let mut transform = transform(&weighted);
        let scale = 2.0 / (count as f64 * window.terms()[0]);
        for x in &mut transform {
            *x *= scale;
        }
        let resolution = 1.0 / (count as f64 * step);
        let is_edge = |k: usize| k == 0 || 2 * k == count;
        Some(Spectrum {
            frequencies: (0..transform.len())
                .map(|k| k as f64 * resolution)
                .collect(),
            // At 0 and at half of the sampling rate the line coincides with its image.
            amplitudes: transform
                .iter()
                .enumerate()
                .map(|(k, x)| x.norm() * if is_edge(k) { 0.5 } else { 1.0 })
                .collect(),
            mean,
            resolution,
            half_angles: (0..transform.len() + 3)
                .map(|k| (PI * k as f64 / count as f64).sin_cos())
                .collect(),
            transform,
            window,
            count,
        })
    }

    /// The greatest lines by amplitude: at most `most` of them, and none below the fraction `least` of the greatest.
    ///
    /// A line is a local maximum of the amplitudes that remains one after greater lines are subtracted together with their
    /// leakage. Its frequency and amplitude are those of the sine that has this response under the window, which is exact for
    /// sines further apart than the width of a line.
    pub fn lines(&self, most: usize, least: f64) -> Vec<Line> {
        let mut tops: Vec<usize> = (1..self.amplitudes.len())
            .filter(|&k| {
                let [below, here, above] =
                    [k - 1, k, k + 1].map(|k| self.amplitudes.get(k).copied().unwrap_or(0.0));
                here > below && here >= above
            })
            .collect();
        tops.sort_by(|a, b| self.amplitudes[*b].total_cmp(&self.amplitudes[*a]));
        let Some(greatest) = tops.first().map(|k| self.amplitudes[*k]) else {
            return Vec::new();
        };
        let mut waves: Vec<(usize, Wave)> = Vec::new();
        let mut left = self.transform.clone();
        // The mean of the samples of a truncated sine differs from that of the sine, and has leakage of its own.
        let mut still = Wave {
            place: 0.0,
            amplitude: Complex::new(0.0, 0.0),
        };
        for top in tops {
            if waves.len() == most || self.amplitudes[top] < least * greatest {
                break;
            }
            if left[top].norm() < OWN * self.amplitudes[top] || self.amplitudes[top] == 0.0 {
                continue;
            }
            let wave = self.wave(&left, top);
            self.add(&mut left, wave, -1.0);
            waves.push((top, wave));
            // Lines found under the leakage of others are refined without it.
            for _ in 0..ROUNDS {
                self.add(&mut left, still, 1.0);
                // The wave coincides with its image there.
                still.amplitude = Complex::new(0.5 * left[0].re, 0.0);
                self.add(&mut left, still, -1.0);
                for (top, previous) in &mut waves {
                    if previous.place == self.half_rate() {
                        self.add(&mut left, *previous, 1.0);
                        *previous = self.wave(&left, *top);
                        self.add(&mut left, *previous, -1.0);
                        continue;
                    }
                    // Adds the wave alone, without its image, whose leakage also remains here.
                    self.add_one(&mut left, previous.place, previous.amplitude);
                    let wave = self.wave(&left, *top);
                    self.add_one(&mut left, -previous.place, previous.amplitude.conj());
                    self.add(&mut left, wave, -1.0);
                    *previous = wave;
                }
            }
        }
        let mut lines: Vec<Line> = waves
            .into_iter()
            .map(|(top, wave)| match wave.amplitude.norm() {
                // A wave so close to its image that both cancel is what the spectrum shows.
                0.0 => Line {
                    frequency: self.frequencies[top],
                    amplitude: self.amplitudes[top],
                    phase: self.transform[top].arg(),
                },
                amplitude => Line {
                    frequency: wave.place * self.resolution,
                    amplitude,
                    phase: wave.amplitude.arg(),
                },
            })
            .collect();
        lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        lines
    }

    /// The place of half of the sampling rate, where a wave coincides with its image.
    fn half_rate(&self) -> f64 {
        0.5 * self.count as f64
    }

    /// The wave that matches a transform at a frequency and at its greater neighbour. At half of the sampling rate the transform is that of the wave and
    /// its image, elsewhere that of the wave alone.
    fn wave(&self, transform: &[Complex<f64>], top: usize) -> Wave {
        let size = |k: usize| transform.get(k).map_or(0.0, |x| x.norm());
        let (below, above) = (size(top - 1), size(top + 1));
        // The line is shifted towards the greater neighbour.
        let side = if above >= below { 1.0 } else { -1.0 };
        if size(top) == 0.0 {
            return Wave {
                place: top as f64,
                amplitude: Complex::new(0.0, 0.0),
            };
        }
        let ratio = above.max(below) / size(top);
        // The ratio of neighbour to peak grows with the shift of the line, for shifts from 0 to 1.
        let leakage = |x: f64| self.window.leakage(x, self.count).norm();
        let at_rest = leakage(1.0);
        let shift = if ratio <= at_rest {
            0.0
        } else {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if leakage(1.0 - middle) < ratio * leakage(middle) {
                    low = middle
                } else {
                    high = middle
                }
            }
            0.5 * (low + high)
        };
        let mut place = top as f64 + side * shift;
        let is_half_rate = (place - self.half_rate()).abs() < INDISTINCT;
        if is_half_rate {
            place = self.half_rate();
        }
        let mut amplitude = transform[top] / self.window.leakage(place - top as f64, self.count);
        if is_half_rate {
            amplitude = Complex::new(0.5 * amplitude.re, 0.0);
        }
        Wave { place, amplitude }
    }

    /// Adds the response of the window to a wave, and to its image at the negative frequency.
    fn add(&self, transform: &mut [Complex<f64>], wave: Wave, factor: f64) {
        self.add_one(transform, wave.place, wave.amplitude * factor);
        self.add_one(transform, -wave.place, wave.amplitude.conj() * factor);
    }

    /// Adds the response of the window to one of them.
    ///
    /// The response of a rectangular window is `sin(πx)/N e^{iπx} (cot(πx/N) − i)`, and the factor before the parenthesis is the same
    /// for all x that are a whole number apart. The cotangent of a difference follows from sines and cosines of its parts, except
    /// close to the line, where it would lose digits.
    fn add_one(&self, transform: &mut [Complex<f64>], place: f64, amplitude: Complex<f64>) {
        let terms = self.window.terms();
        let beside = terms.len() - 1;
        let count = self.count as f64;
        let past = PI * (place - place.round());
        let factor = Complex::from_polar(past.sin() / count, past);
        let (sine, cosine) = (PI * place / count).sin_cos();
        let rectangular = |k: isize| {
            let (sine_of_k, cosine_of_k) = self.half_angles[k.unsigned_abs()];
            let sine_of_k = if k < 0 { -sine_of_k } else { sine_of_k };
            let below = sine * cosine_of_k - cosine * sine_of_k;
            if below.abs() * count < CLOSE {
                return dirichlet(place - k as f64, self.count);
            }
            factor * Complex::new((cosine * cosine_of_k + sine * sine_of_k) / below, -1.0)
        };
        let first = -(beside as isize);
        let last = (transform.len() + beside) as isize;
        let responses: Vec<Complex<f64>> = (first..last).map(rectangular).collect();
        let amplitude = amplitude / terms[0];
        for (x, around) in transform.iter_mut().zip(responses.windows(2 * beside + 1)) {
            let mut sum = around[beside] * terms[0];
            for (j, a) in terms.iter().enumerate().skip(1) {
                let half = if j % 2 == 0 { 0.5 * a } else { -0.5 * a };
                sum += (around[beside - j] + around[beside + j]) * half;
            }
            *x += amplitude * sum;
        }
    }
}

/// The wave `Re(A e^{2πi x n/N})` of samples n.
#[derive(Clone, Copy, Debug)]
struct Wave {
    place: f64,
    amplitude: Complex<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(waves: &[(f64, f64, f64)], count: usize, step: f64) -> Vec<f64> {
        let value = |t: f64| -> f64 {
            let waves = waves.iter();
            waves
                .map(|(f, a, phase)| a * (TAU * f * t + phase).cos())
                .sum()
        };
        (0..count).map(|n| value(n as f64 * step)).collect()
    }

    #[test]
    fn the_transform_is_the_sum_that_defines_it() {
        // An even and an odd number of samples, against the direct sum.
        for count in [32, 27] {
            let values: Vec<f64> = (0..count).map(|n| ((n * n) % 17) as f64 - 3.0).collect();
            for window in Window::ALL {
                let spectrum = Spectrum::new(&values, 0.1, window).unwrap();
                let mean = values.iter().sum::<f64>() / count as f64;
                let total: f64 = (0..count).map(|n| window.weight(n, count)).sum();
                for (k, amplitude) in spectrum.amplitudes.iter().enumerate() {
                    let (mut re, mut im) = (0.0, 0.0);
                    for (n, x) in values.iter().enumerate() {
                        let angle = TAU * ((k * n) % count) as f64 / count as f64;
                        re += (x - mean) * window.weight(n, count) * angle.cos();
                        im += (x - mean) * window.weight(n, count) * angle.sin();
                    }
                    let multiplicity = if k == 0 || 2 * k == count { 1.0 } else { 2.0 };
                    let sum = multiplicity * f64::hypot(re, im) / total;
                    // `count` terms of size 20, divided by a mean weight of a third.
                    let bound = 20.0 * 3.0 * 8.0 * count as f64 * f64::EPSILON;
                    assert!(
                        (amplitude - sum).abs() < bound,
                        "{window:?} {k}: {amplitude} {sum}"
                    );
                }
                assert!((spectrum.resolution - 1.0 / (0.1 * count as f64)).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn leakage_by_differences_of_angles_is_that_of_the_window() {
        // Both the line and its image, also near half of the sampling rate, where the image comes close.
        for count in [4001, 4096] {
            for window in Window::ALL {
                let values = samples(&[(1.0, 1.0, 0.0)], count, 0.01);
                let spectrum = Spectrum::new(&values, 0.01, window).unwrap();
                for place in [0.0, 0.3, 100.0, 1234.56, 2000.25, -1234.56, -2047.9] {
                    let mut leakage = vec![Complex::new(0.0, 0.0); spectrum.transform.len()];
                    spectrum.add_one(&mut leakage, place, Complex::new(0.6, -0.8));
                    for (k, x) in leakage.iter().enumerate() {
                        let seen = window.leakage(place - k as f64, count);
                        let error = (x - Complex::new(0.6, -0.8) * seen).norm();
                        // Both formulas round the angle π x, of up to N/2 π, and differences of angles: ε N/CLOSE of a response of
                        // 1/CLOSE, up to four of them, with the weights of Blackman and Harris divided by the first.
                        let angle = 4.0 * PI * count as f64 * f64::EPSILON / CLOSE;
                        let bound = 8.0 * (angle + 8.0 * f64::EPSILON);
                        assert!(error < bound, "{window:?} {place} {k}: {x} {seen}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_sine_between_frequencies_has_its_frequency_and_its_amplitude() {
        for window in Window::ALL {
            for f in [3.0, 3.1, 3.37, 3.5, 3.99] {
                let values = samples(&[(f, 2.0, 0.7)], 512, 1.0 / 64.0);
                let spectrum = Spectrum::new(&values, 1.0 / 64.0, window).unwrap();
                let lines = spectrum.lines(5, 1e-3);
                assert_eq!(lines.len(), 1, "{window:?} {f}: {lines:?}");
                // Each round reduces an error by the leakage of the image or of the mean, at least 24 bins away, relative to the
                // line: 1/(24 π) without a window. Eight rounds leave 1e-15, in addition to the round-off of the transform.
                let bound = 1e-11;
                let line = lines[0];
                assert!(
                    (line.frequency - f).abs() < bound,
                    "{window:?} {f}: {line:?}"
                );
                assert!(
                    (line.amplitude - 2.0).abs() < 4.0 * bound,
                    "{window:?} {f}: {line:?}"
                );
                assert!(
                    (line.phase - 0.7).abs() < 8.0 * bound,
                    "{window:?} {f}: {line:?}"
                );
            }
        }
    }

    #[test]
    fn samples_that_alternate_are_a_line_at_half_of_the_sampling_rate() {
        for window in Window::ALL {
            // Beside a mean, and beside another line.
            for other in [0.0, 0.5] {
                let mut values = samples(&[(3.37, other, 0.7)], 512, 1.0 / 64.0);
                for (n, x) in values.iter_mut().enumerate() {
                    *x += 0.25 + if n % 2 == 0 { -2.0 } else { 2.0 };
                }
                let lines = Spectrum::new(&values, 1.0 / 64.0, window)
                    .unwrap()
                    .lines(5, 1e-3);
                assert_eq!(
                    lines.len(),
                    if other == 0.0 { 1 } else { 2 },
                    "{window:?}: {lines:?}"
                );
                // As in the test of a sine between frequencies.
                let (line, bound) = (lines[0], 4e-11);
                assert_eq!(line.frequency, 32.0);
                assert!((line.amplitude - 2.0).abs() < bound, "{window:?}: {line:?}");
                assert!(
                    (line.phase.abs() - PI).abs() < bound,
                    "{window:?}: {line:?}"
                );
            }
        }
    }

    #[test]
    fn small_lines_are_told_from_the_feet_of_great_ones() {
        // Without a window the second line is below the side lobes of the first; the third is a thousandth of it.
        let waves = [(5.23, 1.0, 0.0), (9.41, 0.02, 1.0), (14.77, 0.001, 2.0)];
        let values = samples(&waves, 1024, 1.0 / 64.0);
        let spectrum = Spectrum::new(&values, 1.0 / 64.0, Window::Hann).unwrap();
        let lines = spectrum.lines(8, 3e-4);
        assert_eq!(lines.len(), 3, "{lines:?}");
        for (line, (f, a, _)) in lines.iter().zip(waves) {
            assert!((line.frequency - f).abs() < 1e-3, "{line:?}");
            assert!((line.amplitude - a).abs() < 1e-2 * a, "{line:?}");
        }
    }

    #[test]
    fn a_damped_oscillation_is_one_line() {
        // x = e^{−δt} cos ωt has |X| = ½/√(δ² + (Ω − ω)²) near ω: one maximum, without ripples beside it.
        let step = 1.0 / 64.0;
        let values: Vec<f64> = (0..2048)
            .map(|n| n as f64 * step)
            .map(|t| (-0.5 * t).exp() * (TAU * 4.0 * t).cos())
            .collect();
        let spectrum = Spectrum::new(&values, step, Window::Hann).unwrap();
        let lines = spectrum.lines(8, 0.05);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!((lines[0].frequency - 4.0).abs() < spectrum.resolution);
    }

    #[test]
    fn what_has_no_spectrum_is_told() {
        assert!(Spectrum::new(&[1.0, 2.0, 3.0], 1.0, Window::Hann).is_none());
        assert!(Spectrum::new(&[1.0, f64::NAN, 3.0, 4.0], 1.0, Window::Hann).is_none());
        let still = Spectrum::new(&[2.0; 8], 1.0, Window::Hann).unwrap();
        assert_eq!(still.lines(4, 0.1), []);
        assert_eq!(still.mean, 2.0);
    }
}
