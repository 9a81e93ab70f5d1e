//! Sine and cosine compared with 106-bit values: within the bound that `sincos.rs`
//! proves, everywhere up to 100 000.
//!
//! ```text
//! cargo test -p lagrangian-native --test sines -- --nocapture
//! ```

use lagrangian_native::Number;
use lagrangian_scalar::{DoubleDouble, Kernel, Scalar};

/// The bound in units in the last place, of which rounding alone takes 0.5.
const ULPS: f64 = if cfg!(feature = "strict-libm") {
    1.0
} else {
    0.96
};

struct Sines<'a>(&'a [f64]);

impl Kernel<f64> for Sines<'_> {
    type Output = Vec<(f64, f64)>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Vec<(f64, f64)> {
        let mut all = Vec::with_capacity(self.0.len());
        for x in self.0 {
            let (sin, cos) = N::load(*x).sin_cos();
            all.push((sin.store(), cos.store()));
        }
        all
    }
}

fn sines(angles: &[f64]) -> Vec<(f64, f64)> {
    f64::run(Sines(angles))
}

/// The distance from the true value in units of its last place.
fn ulps(found: f64, truth: DoubleDouble) -> f64 {
    let place = 2.0_f64.powi(truth.hi().abs().log2().floor() as i32 - 52);
    ((DoubleDouble::from(found) - truth).hi() / place).abs()
}

/// Prints the largest errors of sine and cosine with their angles, and asserts the bound.
fn worst(name: &str, angles: &[f64]) {
    let mut worst = [(0.0, 0.0); 2];
    for (x, (sin, cos)) in angles.iter().zip(sines(angles)) {
        let (true_sin, true_cos) = DoubleDouble::from(*x).sin_cos();
        for (worst, error) in worst
            .iter_mut()
            .zip([ulps(sin, true_sin), ulps(cos, true_cos)])
        {
            assert!(error <= ULPS, "{error} ulp at {x:e}");
            if error > worst.0 {
                *worst = (error, *x);
            }
        }
    }
    let [(sin, at_sin), (cos, at_cos)] = worst;
    let n = angles.len();
    println!(
        "{name}, {n} angles: sine {sin:.3} ulp at {at_sin:e}, cosine {cos:.3} ulp at {at_cos:e}"
    );
}

/// n numbers in an interval by multiples of the golden ratio, which are more
/// evenly spaced than random ones.
fn between(low: f64, high: f64, n: u32) -> impl Iterator<Item = f64> {
    let golden = 0.618_033_988_749_894_9;
    (0..n).map(move |i| low + (high - low) * (f64::from(i) * golden).fract())
}

#[test]
fn the_bound_holds_in_every_octave() {
    let mut angles = Vec::new();
    for exponent in -900..=16 {
        // More angles where the function is not trivial.
        let n = if exponent < -30 { 20 } else { 6000 };
        let low = 2.0_f64.powi(exponent);
        angles.extend(between(low, (2.0 * low).min(1e5), n));
    }
    angles.push(1e5);
    for i in (0..angles.len()).step_by(2) {
        angles[i] = -angles[i];
    }
    worst("octaves", &angles);
}

#[test]
fn the_bound_holds_within_a_turn() {
    let angles: Vec<f64> = between(-7.0, 7.0, 400_000).collect();
    worst("a turn", &angles);
}

/// Here sines are small and the reduced angle has lost most of its digits, but the
/// remaining ones must be right.
#[test]
fn the_bound_holds_next_to_every_multiple_of_a_right_angle() {
    let mut angles = Vec::new();
    for k in 1..=63_661 {
        let near = f64::from(k) * std::f64::consts::FRAC_PI_2;
        angles.extend((-2..=2).map(|i| f64::from_bits(near.to_bits().wrapping_add_signed(i))));
    }
    worst("multiples of π/2", &angles);
}

/// The bound holds half way between multiples of a right angle, where the quarter changes.
#[test]
fn the_bound_holds_where_quarters_meet() {
    let mut angles = Vec::new();
    for k in 0..63_661 {
        let near = (f64::from(k) + 0.5) * std::f64::consts::FRAC_PI_2;
        angles.extend((-1..=1).map(|i| f64::from_bits(near.to_bits().wrapping_add_signed(i))));
    }
    worst("odd multiples of π/4", &angles);
}

/// sin x = x − x³/6 + … and cos x = 1 − x²/2 + … differ from x and 1 by less than half a unit in the
/// last place for x up to 2⁻²⁷.
#[test]
fn small_angles_are_their_own_sines() {
    let mut angles = vec![0.0, 5e-324, 1e-310, f64::MIN_POSITIVE, 2.0_f64.powi(-27)];
    angles.extend((-1074..-27).map(|exponent| 2.0_f64.powi(exponent)));
    angles.extend((-1000..-27).map(|exponent| 1.999 * 2.0_f64.powi(exponent - 1)));
    for i in 0..angles.len() {
        angles.push(-angles[i]);
    }
    for (x, (sin, cos)) in angles.iter().zip(sines(&angles)) {
        assert_eq!(sin.to_bits(), x.to_bits(), "sin {x:e}");
        assert_eq!(cos, 1.0, "cos {x:e}");
    }
}

#[test]
fn large_angles_are_left_to_the_scalar_library() {
    let mut angles = vec![1e22, f64::MAX, 2.0_f64.powi(60), 1e5_f64.next_up()];
    angles.extend(between(1e5 + 1.0, 1e9, 1000));
    for i in 0..angles.len() {
        angles.push(-angles[i]);
    }
    for (x, found) in angles.iter().zip(sines(&angles)) {
        assert_eq!(found, Scalar::sin_cos(*x), "{x:e}");
    }
}

#[test]
fn what_is_no_angle_has_no_sine() {
    for (sin, cos) in sines(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]) {
        assert!(sin.is_nan() && cos.is_nan());
    }
}
