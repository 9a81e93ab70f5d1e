//! Double-double numbers compared with numbers of 448 bits.

use crate::common::{
    BITS, ROUND, Random, Truth, add, atan2, big, constants, div, error_exponent, mul, sqrt,
};
use astro_float_num::BigFloat;
use lagrangian_scalar::{DoubleDouble, Scalar};

/// The error bound of the functions, 64u² = 2⁻¹⁰⁰, which is derived at each of them.
const FUNCTION: i32 = -100;

const POINTS: usize = 200;

fn exact(x: DoubleDouble) -> BigFloat {
    add(&big(x.hi()), &big(x.lo()))
}

/// A double-double with this high word and a random low word.
fn double(hi: f64, random: &mut Random) -> DoubleDouble {
    DoubleDouble::from(hi) + DoubleDouble::from(hi * random.between(-1.0, 1.0) * 2f64.powi(-54))
}

/// Checks a function of one number; `argument` draws the arguments.
fn check(
    name: &str,
    function: fn(DoubleDouble) -> DoubleDouble,
    truth: Truth,
    argument: impl Fn(&mut Random) -> f64,
) {
    let mut constants = constants();
    let mut worst = i32::MIN;
    for seed in 0..POINTS as u64 {
        let mut random = Random(seed);
        let hi = argument(&mut random);
        let x = double(hi, &mut random);
        let result = function(x);
        let error = error_exponent(&exact(result), &truth(&exact(x), &mut constants));
        assert!(
            error <= FUNCTION,
            "{name}({x:?}), seed {seed}: {result:?} is off by 2^{error}"
        );
        worst = worst.max(error);
    }
    println!("{name}: worst error below 2^{worst}");
}

#[test]
fn arithmetic_keeps_its_bounds() {
    let u_squared = -106;
    for seed in 0..2000 {
        let mut random = Random(seed);
        let exponent = random.between(0.0, 400.0);
        let [a, b] = [0, 1].map(|_| {
            let hi = random.scaled(-exponent, exponent);
            double(hi, &mut random)
        });
        let (x, y) = (exact(a), exact(b));
        // The bounds are 3u², 5u², 15u², 4u²; `error_exponent` rounds up to a power of 2.
        assert!(
            error_exponent(&exact(a + b), &add(&x, &y)) <= u_squared + 2,
            "seed {seed}"
        );
        assert!(
            error_exponent(&exact(a * b), &mul(&x, &y)) <= u_squared + 3,
            "seed {seed}"
        );
        assert!(
            error_exponent(&exact(a / b), &div(&x, &y)) <= u_squared + 4,
            "seed {seed}"
        );
        let (a, x) = (a.abs(), x.abs());
        assert!(
            error_exponent(&exact(a.sqrt()), &sqrt(&x)) <= u_squared + 2,
            "seed {seed}"
        );
    }
}

#[test]
fn sums_that_cancel_are_as_accurate() {
    for seed in 0..2000 {
        let mut random = Random(seed);
        let a = random.scaled(-3.0, 3.0);
        let a = double(a, &mut random);
        let b = a + DoubleDouble::from(random.scaled(-106.0, -40.0));
        let truth = add(&exact(a), &exact(-b));
        assert!(
            truth.is_zero() || error_exponent(&exact(a - b), &truth) <= -104,
            "seed {seed}"
        );
    }
}

#[test]
fn sines_and_cosines() {
    for range in [1.0, 20.0, 1e5, 1e15] {
        let argument = move |random: &mut Random| random.between(-range, range);
        check("sin", DoubleDouble::sin, crate::common::sin, argument);
        check("cos", DoubleDouble::cos, crate::common::cos, argument);
        check("tan", DoubleDouble::tan, crate::common::tan, argument);
    }
    check("sin", DoubleDouble::sin, crate::common::sin, |random| {
        random.scaled(-300.0, 0.0)
    });
}

#[test]
fn sines_next_to_multiples_of_a_quarter_turn() {
    let mut constants = constants();
    for seed in 0..POINTS as u64 {
        let mut random = Random(seed);
        let quarters = random.scaled(0.0, 45.0).round();
        let x = DoubleDouble::from(quarters) * DoubleDouble::pi() / DoubleDouble::from(2.0);
        let (sin, cos) = x.sin_cos();
        let truth = exact(x);
        let sin_error = error_exponent(&exact(sin), &crate::common::sin(&truth, &mut constants));
        let cos_error = error_exponent(&exact(cos), &crate::common::cos(&truth, &mut constants));
        assert!(
            sin_error <= FUNCTION && cos_error <= FUNCTION,
            "{quarters}, seed {seed}"
        );
    }
}

#[test]
fn inverse_functions() {
    let near = |random: &mut Random| random.between(-1.0, 1.0);
    let tiny = |random: &mut Random| random.scaled(-300.0, -1.0);
    let next_to_one = |random: &mut Random| 1.0 - random.scaled(-50.0, -3.0).abs();
    for argument in [near, tiny, next_to_one] {
        check("asin", DoubleDouble::asin, crate::common::asin, argument);
        check("acos", DoubleDouble::acos, crate::common::acos, argument);
        check("atan", DoubleDouble::atan, crate::common::atan, argument);
    }
    check("atan", DoubleDouble::atan, crate::common::atan, |random| {
        random.scaled(0.0, 1000.0)
    });
    assert_eq!(DoubleDouble::from(-1.0).acos(), DoubleDouble::pi());
    assert!(!DoubleDouble::from(1.5).asin().is_finite());
}

#[test]
fn the_angle_of_a_point() {
    let mut constants = constants();
    for seed in 0..POINTS as u64 {
        let mut random = Random(seed);
        let (y, x) = (random.scaled(-100.0, 100.0), random.scaled(-100.0, 100.0));
        let (y, x) = (double(y, &mut random), double(x, &mut random));
        let truth = atan2(&exact(y), &exact(x), &mut constants);
        let error = error_exponent(&exact(y.atan2(x)), &truth);
        assert!(
            error <= FUNCTION,
            "atan2({y:?}, {x:?}), seed {seed}: 2^{error}"
        );
    }
    let (zero, one) = (DoubleDouble::ZERO, DoubleDouble::ONE);
    assert_eq!(zero.atan2(one), zero);
    assert_eq!(zero.atan2(-one), DoubleDouble::pi());
    assert_eq!(zero.atan2(zero), zero);
}

#[test]
fn exponentials_and_logarithms() {
    let any = |random: &mut Random| random.between(-600.0, 700.0);
    let medium = |random: &mut Random| random.between(-3.0, 3.0);
    let tiny = |random: &mut Random| random.scaled(-300.0, 0.0);
    let next_to_one = |random: &mut Random| 1.0 + random.scaled(-50.0, -1.5);
    let positive = |random: &mut Random| random.scaled(-800.0, 1000.0).abs();
    for argument in [any, medium, tiny] {
        check("exp", DoubleDouble::exp, crate::common::exp, argument);
        check("sinh", DoubleDouble::sinh, crate::common::sinh, argument);
        check("cosh", DoubleDouble::cosh, crate::common::cosh, argument);
        check("tanh", DoubleDouble::tanh, crate::common::tanh, argument);
    }
    check("ln", DoubleDouble::ln, crate::common::ln, next_to_one);
    check("ln", DoubleDouble::ln, crate::common::ln, positive);
}

#[test]
fn powers() {
    let mut constants = constants();
    for seed in 0..POINTS as u64 {
        let mut random = Random(seed);
        let (x, y) = (
            random.scaled(-20.0, 20.0).abs(),
            random.between(-30.0, 30.0),
        );
        let (x, y) = (double(x, &mut random), double(y, &mut random));
        let truth = exact(x).pow(&exact(y), BITS, ROUND, &mut constants);
        let error = error_exponent(&exact(x.powf(y)), &truth);
        // 2⁻¹⁰⁰ (1 + |y ln x|), |y ln x| < 30·20 ln 2 < 2⁹.
        assert!(error <= FUNCTION + 9, "{x:?}^{y:?}, seed {seed}: 2^{error}");
    }
    let minus_two = DoubleDouble::from(-2.0);
    assert_eq!(minus_two.powf(3.0.into()), DoubleDouble::from(-8.0));
    assert!(!minus_two.powf(0.5.into()).is_finite());
}

#[test]
fn constants_to_the_last_bit() {
    let mut cache = constants();
    let pi = cache.pi(BITS, ROUND);
    assert!(error_exponent(&exact(DoubleDouble::pi()), &pi) <= -106);
    for seed in 0..POINTS as u64 {
        let mut random = Random(seed);
        let (n, d) = (random.bits() as i64, (random.bits() >> 1).max(1) as i64);
        let truth = div(&BigFloat::from_i64(n, BITS), &BigFloat::from_i64(d, BITS));
        let ratio = DoubleDouble::from_ratio(n, d);
        assert!(
            error_exponent(&exact(ratio), &truth) <= -102,
            "{n}/{d}, seed {seed}"
        );
    }
}

#[test]
fn order_and_signs() {
    let one = DoubleDouble::ONE;
    let more = one + DoubleDouble::from(1e-30);
    assert!(more > one && more.exceeds(one) && !one.exceeds(one));
    assert_eq!((one.max(more), one.min(more)), (more, one));
    assert_eq!((more - one).sign(), one);
    assert_eq!((one - more).sign(), -one);
    assert_eq!((one - more).abs(), more - one);
    assert_eq!((more.hi(), more.lo()), (1.0, 1e-30));
}

#[test]
fn what_is_undefined_stays_undefined() {
    let undefined = DoubleDouble::ONE / DoubleDouble::ZERO;
    let x = DoubleDouble::from(2.0);
    for result in [
        undefined,
        x / undefined,
        undefined * DoubleDouble::ZERO,
        DoubleDouble::from(f64::MAX) + DoubleDouble::from(f64::MAX),
        DoubleDouble::from(f64::MAX) * x,
        undefined.sin(),
        undefined.exp(),
        undefined.tanh(),
        undefined.atan(),
        undefined.sqrt(),
        undefined.sign(),
        undefined.min(x),
        x.min(undefined),
        x.max(undefined),
        (-x).sqrt(),
        (-x).ln(),
        DoubleDouble::ZERO.ln(),
        DoubleDouble::from(1e300).sin(),
        DoubleDouble::from(1e300).exp(),
    ] {
        assert!(!result.is_finite(), "{result:?}");
        assert_ne!(result, result);
    }
    // The largest numbers themselves can be divided.
    let large = DoubleDouble::from(f64::MAX);
    assert_eq!((large / large).hi(), 1.0);
    assert_eq!(
        (large.sqrt() / DoubleDouble::from(f64::MAX.sqrt())).hi(),
        1.0
    );
    assert_eq!(DoubleDouble::from(-1000.0).exp(), DoubleDouble::ZERO);
}
