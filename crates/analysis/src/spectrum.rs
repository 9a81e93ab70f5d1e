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

/// `1/N Σ e^{2πi x n/N}` over n from 0 to N − 1, which has the period N: `sin(πx) e^{iπx} e^{−iπx/N}/(N sin(πx/N))`.
fn dirichlet(x: f64, count: usize) -> Complex<f64> {
    let count = count as f64;
    let x = x - count * (x / count).round();
    let (below, beside) = (PI * x / count).sin_cos();
    if below == 0.0 {
        return Complex::new(1.0, 0.0);
    }
    // sin(πx) e^{iπx} has the period 1. It is computed from the distance of x to the nearest integer, so that it is exactly 0 at integers.
    let (sine, cosine) = (PI * (x - x.round())).sin_cos();
    let whole = Complex::new(cosine, sine) * Complex::new(beside, -below);
    whole * (sine / (count * below))
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
        let mut found = Waves {
            spectrum: self,
            waves: Vec::new(),
            still: 0.0,
        };
        for top in tops {
            if found.waves.len() == most || self.amplitudes[top] < least * greatest {
                break;
            }
            let left = found.left(top).norm();
            if left < OWN * self.amplitudes[top] || self.amplitudes[top] == 0.0 {
                continue;
            }
            let around = [top - 1, top, top + 1].map(|k| found.left(k));
            found.waves.push((top, self.wave(around, top)));
            // Lines found under the leakage of others are refined without it.
            for _ in 0..ROUNDS {
                found.refine();
            }
        }
        let mut lines: Vec<Line> = found
            .waves
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

    /// The wave that matches a transform at a frequency and at its greater neighbour, from the values below, at and above the frequency. At
    /// half of the sampling rate the transform is that of the wave and its image, elsewhere that of the wave alone.
    fn wave(&self, around: [Complex<f64>; 3], top: usize) -> Wave {
        let [below, here, above] = around.map(|x| x.norm());
        // The line is shifted towards the greater neighbour.
        let side = if above >= below { 1.0 } else { -1.0 };
        if here == 0.0 {
            return Wave {
                place: top as f64,
                amplitude: Complex::new(0.0, 0.0),
            };
        }
        let ratio = above.max(below) / here;
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
        let mut amplitude = around[1] / self.window.leakage(place - top as f64, self.count);
        if is_half_rate {
            amplitude = Complex::new(0.5 * amplitude.re, 0.0);
        }
        Wave { place, amplitude }
    }

    /// The response of the window at a frequency to a wave without its image.
    fn response(&self, wave: Wave, k: usize) -> Complex<f64> {
        wave.amplitude * self.window.leakage(wave.place - k as f64, self.count)
    }
}

/// The wave `Re(A e^{2πi x n/N})` of samples n.
#[derive(Clone, Copy, Debug)]
struct Wave {
    place: f64,
    amplitude: Complex<f64>,
}

impl Wave {
    /// Its image at the negative frequency.
    fn image(self) -> Wave {
        Wave {
            place: -self.place,
            amplitude: self.amplitude.conj(),
        }
    }
}

/// The waves found in a transform, which are subtracted from it. They are few, and the rest is needed only next to them, so it is
/// computed where it is needed.
struct Waves<'a> {
    spectrum: &'a Spectrum,
    /// Each with the frequency at which it was found.
    waves: Vec<(usize, Wave)>,
    /// The amplitude at frequency 0, where a wave coincides with its image: the mean of the samples of a truncated sine differs from
    /// that of the sine, and has leakage of its own.
    still: f64,
}

impl Waves<'_> {
    /// What remains of the transform at a frequency without all waves and the mean; 0 beyond its ends.
    fn left(&self, k: usize) -> Complex<f64> {
        if k >= self.spectrum.transform.len() {
            return Complex::new(0.0, 0.0);
        }
        self.rest(k)
            - self.still
                * self
                    .spectrum
                    .window
                    .leakage(-(k as f64), self.spectrum.count)
    }

    /// What remains at a frequency of the transform without all waves.
    fn rest(&self, k: usize) -> Complex<f64> {
        let both =
            |wave: Wave| self.spectrum.response(wave, k) + self.spectrum.response(wave.image(), k);
        let waves = self.waves.iter();
        self.spectrum.transform[k] - waves.map(|(_, wave)| both(*wave)).sum::<Complex<f64>>()
    }

    /// Computes the mean without all waves, and then each wave without the others and the mean.
    fn refine(&mut self) {
        self.still = self.rest(0).re;
        for index in 0..self.waves.len() {
            let (top, previous) = self.waves[index];
            let is_half_rate = previous.place == self.spectrum.half_rate();
            let around = [top - 1, top, top + 1].map(|k| {
                if k >= self.spectrum.transform.len() {
                    return Complex::new(0.0, 0.0);
                }
                let mut own = self.spectrum.response(previous, k);
                // There the wave and its image are found together; elsewhere the image, whose leakage also remains here, stays subtracted.
                if is_half_rate {
                    own += self.spectrum.response(previous.image(), k);
                }
                self.left(k) + own
            });
            self.waves[index].1 = self.spectrum.wave(around, top);
        }
    }
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
    fn the_response_of_a_window_is_the_sum_that_defines_it() {
        for count in [400, 401] {
            for window in Window::ALL {
                for x in [
                    0.0, 1.0, -2.0, 0.3, -0.7, 17.0, 123.45, -199.99, 200.0, 331.2,
                ] {
                    let mut sum = Complex::new(0.0, 0.0);
                    for n in 0..count {
                        let angle = TAU * x * n as f64 / count as f64;
                        sum += window.weight(n, count) * Complex::from_polar(1.0, angle);
                    }
                    sum /= count as f64 * window.terms()[0];
                    let response = window.leakage(x, count);
                    // The angles of the sum, up to 2π x, are rounded.
                    let bound = 4.0 * (TAU * 332.0 + 8.0) * f64::EPSILON;
                    assert!(
                        (response - sum).norm() < bound,
                        "{window:?} {x} {count}: {response} {sum}"
                    );
                }
            }
        }
    }

    #[test]
    fn lines_of_many_samples_take_as_long_as_those_of_few() {
        // A response that is needed at every frequency would take minutes here.
        let waves: Vec<(f64, f64, f64)> = (1..=24)
            .map(|k| (f64::from(k) * 3.37, 1.0 / f64::from(k), f64::from(k)))
            .collect();
        let (count, step) = (1 << 18, 1e-3);
        let lines = Spectrum::new(&samples(&waves, count, step), step, Window::Hann)
            .unwrap()
            .lines(24, 1e-3);
        assert_eq!(lines.len(), 24);
        for (line, (f, a, _)) in lines.iter().zip(waves) {
            // Lines are 880 frequencies apart, where the Hann window leaves some 1e-9 of each, which is subtracted.
            assert!((line.frequency - f).abs() < 1e-9, "{line:?}");
            assert!((line.amplitude - a).abs() < 1e-9, "{line:?}");
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
