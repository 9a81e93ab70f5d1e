use super::circle::{ODD_ORDER, ODD_ROOT};
use super::*;

/// The number of points at which every identity is tried.
const POINTS: u64 = 20;

/// Checks an identity between expressions of three symbols at random points, skipping those where a
/// side is undefined.
fn identity(sides: impl Fn(Residue, Residue, Residue) -> (Residue, Residue)) {
    let mut defined = 0;
    for seed in 0..POINTS {
        let [x, y, z] = [0, 1, 2].map(|index| Residue::random(seed, index));
        let (left, right) = sides(x, y, z);
        if left.is_finite() && right.is_finite() {
            assert_eq!(left, right, "seed {seed}");
            defined += 1;
        }
    }
    assert!(defined > 0, "undefined at every point");
}

/// Checks that an equation fails wherever both sides are defined.
fn no_identity(sides: impl Fn(Residue, Residue, Residue) -> (Residue, Residue)) {
    let mut defined = 0;
    for seed in 0..POINTS {
        let [x, y, z] = [0, 1, 2].map(|index| Residue::random(seed, index));
        let (left, right) = sides(x, y, z);
        if left.is_finite() && right.is_finite() {
            assert_ne!(left, right, "seed {seed}");
            defined += 1;
        }
    }
    assert!(defined > 0, "undefined at every point");
}

fn int(n: i64) -> Residue {
    Residue::from_ratio(n, 1)
}

fn ratio(n: i64, d: i64) -> Residue {
    Residue::from_ratio(n, d)
}

#[test]
fn the_circle_has_a_generator() {
    // Order 2⁶¹: its 2⁶⁰-th power is −1. Norm 1.
    assert_eq!(GENERATOR.pow(1 << 60), -Field::ONE);
    assert_eq!(GENERATOR.norm(), 1);
    assert_eq!(GENERATOR.pow(1 << 59), Field { re: 0, im: 1 });
    let four_plus_i = Field { re: 4, im: 1 };
    let point = four_plus_i * four_plus_i.conjugate().inverse().unwrap();
    assert_eq!(GENERATOR, point.pow(7));
}

#[test]
fn the_odd_roots_have_full_order() {
    let primes = [3, 5, 7, 11, 13, 31, 41, 61, 151, 331, 1321];
    assert_eq!(primes.iter().product::<i64>() * 3 * 5, ODD_ORDER);
    assert_eq!(ODD_ROOT.pow(ODD_ORDER as u64), Field::ONE);
    for q in primes {
        assert_ne!(ODD_ROOT.pow((ODD_ORDER / q) as u64), Field::ONE, "{q}");
    }
}

#[test]
fn it_is_a_field() {
    identity(|x, y, z| ((x + y) * z, x * z + y * z));
    identity(|x, y, _| (x / y * y, x));
    identity(|x, y, _| ((x * x - y * y) / (x - y), x + y));
    identity(|x, _, _| (x + x * ratio(-1, 3), x * ratio(2, 3)));
    let root = int(3).sqrt() + int(2).sqrt();
    identity(|x, y, z| ((x + root * y) / (z - root) * (z - root), x + root * y));
}

#[test]
fn addition_theorems() {
    identity(|x, y, _| ((x + y).sin(), x.sin() * y.cos() + x.cos() * y.sin()));
    identity(|x, y, _| ((x - y).cos(), x.cos() * y.cos() + x.sin() * y.sin()));
    identity(|x, y, z| {
        (
            (x * y + z).sin(),
            (x * y).sin() * z.cos() + (y * x).cos() * z.sin(),
        )
    });
    identity(|x, _, _| (x.sin().powi(2) + x.cos().powi(2), Residue::ONE));
    identity(|x, _, _| (int(2) * (x / int(2)).sin() * (x / int(2)).cos(), x.sin()));
    identity(|x, _, _| {
        (
            (x + x + x).sin(),
            int(3) * x.sin() - int(4) * x.sin().powi(3),
        )
    });
    identity(|x, _, _| {
        (
            (x * ratio(1, 3)).cos().powi(3) * int(4) - (x / int(3)).cos() * int(3),
            x.cos(),
        )
    });
    identity(|x, _, _| ((-x).sin(), -x.sin()));
    identity(|x, y, z| {
        (
            (x * x / (y + z) - x).cos(),
            ((x * x - x * y - z * x) / (z + y)).cos(),
        )
    });
    identity(|x, y, _| {
        (
            (x + y).tan(),
            (x.tan() + y.tan()) / (int(1) - x.tan() * y.tan()),
        )
    });
}

#[test]
fn wrong_equations_fail() {
    no_identity(|x, y, _| ((x + y).sin(), x.sin() * y.cos() - x.cos() * y.sin()));
    no_identity(|x, _, _| ((-x).sin(), x.sin()));
    no_identity(|x, _, _| (x.sin(), x));
    no_identity(|x, _, _| (x.sin(), (x * ratio(1_000_001, 1_000_000)).sin()));
    no_identity(|x, _, _| ((x / int(1 << 20)).sin(), x.sin() / int(1 << 20)));
    no_identity(|x, y, _| (x.min(y), x.max(y)));
    no_identity(|x, _, _| (x.sqrt(), -x.sqrt()));
}

#[test]
fn pi_is_half_a_turn() {
    let pi = Residue::pi();
    identity(|x, _, _| ((x + pi).sin(), -x.sin()));
    identity(|x, _, _| ((x + pi / int(2)).cos(), -x.sin()));
    identity(|x, _, _| ((pi * ratio(1, 2) - x).sin(), x.cos()));
    identity(|x, _, _| ((int(7) * pi - x).sin(), x.sin()));
    identity(|x, _, _| ((x + pi).cos() * (x - pi).cos(), x.cos().powi(2)));
    assert_eq!(pi.sin(), Residue::ZERO);
    assert_eq!(pi.cos(), -Residue::ONE);
    assert_eq!((pi / int(4)).sin(), int(2).sqrt() / int(2));
    assert_eq!((pi / int(3)).cos(), ratio(1, 2));
    assert_eq!((pi / int(3)).sin(), int(3).sqrt() / int(2));
    assert_eq!((pi / int(6)).tan(), Residue::ONE / int(3).sqrt());
    assert_eq!((pi / int(5)).cos(), (int(1) + int(5).sqrt()) / int(4));
    assert_eq!(
        (pi / int(12)).cos(),
        (int(6).sqrt() + int(2).sqrt()) / int(4)
    );
    assert!(!(pi / int(2)).tan().is_finite());
}

/// Angles that are written with many decimals are those of all theorems: π/4 to 17 decimals, here as 78539816339744831 of 10¹⁷.
#[test]
fn angles_may_have_twenty_decimals() {
    let eighth = ratio(78_539_816_339_744_831, 100_000_000_000_000_000);
    let small = eighth / int(1000);
    for angle in [eighth, small] {
        identity(|x, _, _| {
            let (sin, cos) = angle.sin_cos();
            ((x + angle).sin(), x.sin() * cos + x.cos() * sin)
        });
        identity(|x, y, _| ((x + angle - (y + angle)).cos(), (x - y).cos()));
        no_identity(|x, _, _| ((x + angle).sin(), (x - angle).sin()));
    }
    no_identity(|x, _, _| ((x + eighth).sin(), (x + small).sin()));
}

#[test]
fn three_phases_cancel() {
    let third = int(2) * Residue::pi() / int(3);
    identity(|x, _, _| {
        (
            x.cos() + (x + third).cos() + (x - third).cos(),
            Residue::ZERO,
        )
    });
    no_identity(|x, _, _| ((x + third).cos(), (x - third).cos()));
    // 17 does not divide p − 1: the only known property of π/17 is that 17 of them are π.
    let small = Residue::pi() / int(17);
    no_identity(|x, _, _| ((x + small).cos(), (x - small).cos()));
    no_identity(|x, _, _| ((x + small).cos(), x.cos()));
    identity(|x, _, _| ((x + int(17) * small).cos(), -x.cos()));
}

#[test]
fn pi_times_a_symbol_is_no_multiple_of_pi() {
    // If π were a number of half turns in the angle, sin(2πft) would be 0 at every point.
    let pi = Residue::pi();
    no_identity(|f, t, _| ((int(2) * pi * f * t).sin(), Residue::ZERO));
    no_identity(|x, y, _| ((pi * x).cos(), (pi * y).cos()));
    no_identity(|x, _, _| (pi * x, ratio(355, 113) * x));
    identity(|f, t, _| {
        (
            (int(2) * pi * f * t).sin(),
            int(2) * (pi * t * f).sin() * (f * pi * t).cos(),
        )
    });
}

#[test]
fn roots_are_multiplicative() {
    identity(|x, _, _| (x.sqrt().powi(2), x));
    identity(|x, y, _| {
        (
            (x * y).sqrt() + x.sqrt() - x.sqrt(),
            x.sqrt() * y.sqrt() + y.sqrt() - y.sqrt(),
        )
    });
    identity(|x, _, _| ((x * x).sqrt(), x.abs()));
    identity(|x, y, _| ((x * x * y).sqrt(), x.abs() * y.sqrt()));
    identity(|x, _, _| (x.powf(ratio(3, 2)), x * x.sqrt()));
    assert_eq!(int(9).sqrt(), int(3));
    assert_eq!(int(27).sqrt(), int(3) * int(3).sqrt());
    assert_eq!(int(21).sqrt(), int(3).sqrt() * int(7).sqrt());
    assert_eq!(ratio(3, 4).sqrt().powi(2), ratio(3, 4));
    assert_eq!((int(3).sqrt() * int(3).sqrt()), int(3));
    assert!((int(1) + int(3).sqrt()).sqrt().is_finite());
    assert!(!int(-4).sqrt().is_finite());
    identity(|x, y, _| {
        let complex = x + y * int(3).sqrt();
        (complex.sqrt().powi(2), complex)
    });
}

#[test]
fn signs() {
    identity(|x, _, _| (x.abs() * x.abs(), x * x));
    identity(|x, _, _| (x.sign() * x.abs(), x));
    identity(|x, y, _| ((x * y).sign(), x.sign() * y.sign()));
    identity(|x, _, _| ((-x).abs(), x.abs()));
    identity(|x, _, _| ((-x).sign(), -x.sign()));
    identity(|x, y, _| (x.min(y) + x.max(y), x + y));
    identity(|x, y, _| (x.min(y), y.min(x)));
    identity(|x, y, _| (x.min(y), -(-x).max(-y)));
    identity(|x, y, _| (x.min(y) * x.max(y), x * y));
    // A known rational has its true sign: 3 is not a square modulo p, but it is positive.
    assert_eq!(int(-3).abs(), int(3));
    assert_eq!(int(3).sign(), int(1));
    assert_eq!(int(3).max(int(5)), int(5));
    assert_eq!(int(0).sign(), int(0));
}

#[test]
fn inverse_functions() {
    identity(|x, _, _| (x.asin().sin(), x));
    identity(|x, _, _| (x.acos().cos(), x));
    identity(|x, _, _| (x.asin().cos(), (int(1) - x * x).sqrt()));
    identity(|x, _, _| (x.atan().tan(), x));
    identity(|x, _, _| ((int(2) * x.atan()).sin(), int(2) * x / (int(1) + x * x)));
    identity(|x, y, _| (y.atan2(x).sin(), y / (x * x + y * y).sqrt()));
    identity(|x, y, z| {
        (
            (y.atan2(x) + z).cos() * (x * x + y * y).sqrt(),
            x * z.cos() - y * z.sin(),
        )
    });
    identity(|x, _, _| (x.asin() + x.acos(), Residue::pi() / int(2)));
    identity(|x, _, _| ((-x).asin(), -x.asin()));
    identity(|x, _, _| ((-x).atan(), -x.atan()));
    identity(|x, y, _| ((-y).atan2(x), -y.atan2(x)));
    identity(|x, y, z| ((y * z * z).atan2(x * z * z), y.atan2(x)));
    // atan agrees with asin where both directions exist.
    identity(|x, _, _| {
        let root = (int(1) + x * x).sqrt();
        (x.atan() + root - root, (x / root).asin())
    });
    assert_eq!(int(1).atan(), Residue::pi() / int(4));
    assert_eq!(int(1).asin(), Residue::pi() / int(2));
    assert_eq!(int(-1).acos(), Residue::pi());
    assert_eq!(int(0).atan2(int(-4)), Residue::pi());
    assert!(!int(0).atan2(int(0)).is_finite());
    no_identity(|x, _, _| (x.atan(), x.asin()));
}

#[test]
fn exponentials() {
    identity(|x, _, _| (x.exp() * (-x).exp(), Residue::ONE));
    identity(|x, _, _| (x.cosh().powi(2) - x.sinh().powi(2), Residue::ONE));
    identity(|x, _, _| ((-x).sinh(), -x.sinh()));
    identity(|x, _, _| ((-x).cosh(), x.cosh()));
    identity(|x, _, _| (x.tanh() * x.cosh(), x.sinh()));
    identity(|x, y, _| ((x + y).ln() - (y + x).ln(), Residue::ZERO));
    identity(|x, y, _| ((x * x - y * y).powf(x), ((x + y) * (x - y)).powf(x)));
    no_identity(|x, y, _| (x.powf(y), y.powf(x)));
    assert_eq!(int(0).exp(), Residue::ONE);
    assert_eq!(int(1).ln(), Residue::ZERO);
}

#[test]
fn floating_point_constants_are_exact() {
    for x in [0.75, -3.0, 0.1, 1e300, 5e-324, f64::MAX, -1.5e-9] {
        let twice = Residue::from_f64(x) + Residue::from_f64(x);
        assert_eq!(twice, Residue::from_f64(x) * int(2));
    }
    assert_eq!(Residue::from_f64(0.75), ratio(3, 4));
    assert_eq!(Residue::from_f64(-0.0), Residue::ZERO);
    assert_ne!(Residue::from_f64(0.1), ratio(1, 10));
    assert_eq!(
        Residue::from_f64(5e-324) * Residue::from_f64(2f64.powi(1000)),
        Residue::from_f64(2f64.powi(-74))
    );
    // Too many halvings for an exact angle: opaque, but still a sine and still odd.
    let x = Residue::random(3, 0);
    let (sin, cos) = (x * Residue::from_f64(0.1)).sin_cos();
    assert_eq!(sin * sin + cos * cos, Residue::ONE);
    assert_eq!((-x * Residue::from_f64(0.1)).sin(), -sin);
}

#[test]
fn what_is_undefined_stays_undefined() {
    let zero = Residue::random(1, 1) - Residue::random(1, 1);
    let undefined = Residue::ONE / zero;
    let x = Residue::random(1, 2);
    for result in [
        undefined,
        undefined * Residue::ZERO,
        x - undefined,
        undefined.sin(),
        undefined.powi(0) * undefined,
        undefined.exp(),
        undefined.atan2(x),
        x.min(undefined),
        undefined.sign(),
        Residue::from_f64(f64::NAN),
        Residue::from_ratio(1, 0),
        Residue::from_ratio(1, P as i64),
        zero.ln(),
    ] {
        assert!(!result.is_finite());
        assert_ne!(result, result);
        assert!(result.to_f64().is_nan());
    }
}

#[test]
fn extremes_do_not_panic() {
    let extremes = [
        Residue::from_ratio(i64::MIN, 1),
        Residue::from_ratio(i64::MAX, i64::MAX - 1),
        Residue::from_ratio(1, i64::MAX),
        Residue::from_f64(f64::MAX),
        Residue::from_f64(5e-324),
        Residue::pi() * Residue::from_ratio(i64::MAX, 3),
        Residue::pi() * Residue::from_ratio(i64::MIN, 1),
        Residue::pi().powi(3),
        Residue::random(0, 0).powi(i32::MIN),
        Residue::from_f64(1e-300).powi(i32::MAX),
        Residue::ZERO,
    ];
    for a in extremes {
        for b in extremes {
            let sum = a + b - a * b / (a - b);
            let _ = (sum.sin_cos(), a.atan2(b), a.powf(b), a.min(b), a.max(b));
        }
        let _ = (
            -a,
            a.sqrt(),
            a.sin_cos(),
            a.tan(),
            a.asin(),
            a.acos(),
            a.ln(),
        );
        let _ = (a.exp(), a.tanh(), a.abs(), a.sign(), a.to_f64());
        assert_eq!(
            (a + Residue::ONE - a - Residue::ONE).is_finite(),
            a.is_finite()
        );
    }
}
