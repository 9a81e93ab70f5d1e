//! Intervals enclose the true values, which are computed in double-double.

use crate::common::Random;
use lagrangian_scalar::{DoubleDouble, Interval, Scalar};

const CHAINS: u64 = 3000;
const CHAIN_LENGTH: usize = 40;

fn encloses(interval: Interval, truth: DoubleDouble) -> bool {
    DoubleDouble::from(interval.lo()) <= truth && truth <= DoubleDouble::from(interval.hi())
}

type Unary = (
    &'static str,
    fn(Interval) -> Interval,
    fn(DoubleDouble) -> DoubleDouble,
);
type Binary = (
    &'static str,
    fn(Interval, Interval) -> Interval,
    fn(DoubleDouble, DoubleDouble) -> DoubleDouble,
);

macro_rules! both {
    ($name:ident) => {
        (stringify!($name), Interval::$name, DoubleDouble::$name)
    };
}

const UNARY: &[Unary] = &[
    both!(sin),
    both!(cos),
    both!(tan),
    both!(asin),
    both!(acos),
    both!(atan),
    both!(sinh),
    both!(cosh),
    both!(tanh),
    both!(exp),
    both!(ln),
    both!(sqrt),
    both!(abs),
    both!(sign),
    ("cube", |x| x.powi(3), |x| x.powi(3)),
    ("inverse square", |x| x.powi(-2), |x| x.powi(-2)),
];

const BINARY: &[Binary] = &[
    ("+", |a, b| a + b, |a, b| a + b),
    ("-", |a, b| a - b, |a, b| a - b),
    ("*", |a, b| a * b, |a, b| a * b),
    ("/", |a, b| a / b, |a, b| a / b),
    both!(min),
    both!(max),
    both!(atan2),
    both!(powf),
];

#[test]
fn chains_of_operations_enclose_the_truth() {
    let mut finite = 0;
    for seed in 0..CHAINS {
        let mut random = Random(seed);
        let mut values = Vec::new();
        for _ in 0..4 {
            let x = random.scaled(-6.0, 6.0);
            let radius = match random.bits() % 3 {
                0 => 0.0,
                1 => random.scaled(-50.0, -10.0).abs(),
                _ => random.scaled(-5.0, 2.0).abs(),
            };
            values.push((Interval::new(x - radius, x + radius), DoubleDouble::from(x)));
        }
        for _ in 0..CHAIN_LENGTH {
            let mut pick = || (random.bits() >> 16) as usize;
            let (a, b) = (values[pick() % values.len()], values[pick() % values.len()]);
            let operation = pick() % (UNARY.len() + 2 * BINARY.len());
            let (name, interval, truth) = match UNARY.get(operation) {
                Some((name, interval, truth)) => (name, interval(a.0), truth(a.1)),
                None => {
                    let (name, interval, truth) = &BINARY[operation % BINARY.len()];
                    (name, interval(a.0, b.0), truth(a.1, b.1))
                }
            };
            if !interval.is_finite() {
                continue;
            }
            assert!(
                truth.is_finite() && encloses(interval, truth),
                "seed {seed}: {name} of {a:?}, {b:?} gives {interval:?} without {truth:?}"
            );
            finite += 1;
            // For smaller values double-double loses its second word, for larger
            // ones the accuracy of its sine.
            if truth.to_f64().abs() > 1e-150 && truth.to_f64().abs() < 1e15 {
                values.push((interval, truth));
            }
        }
    }
    assert!(
        finite > CHAINS as usize * CHAIN_LENGTH / 2,
        "only {finite} were finite"
    );
}

/// The errors on which the widening relies: below 1 unit in the last place, or 2
/// where functions are composed.
#[test]
fn the_errors_of_libm_are_below_half_of_the_widening() {
    let check = |name: &str, limit: f64, result: f64, truth: DoubleDouble| {
        let ulp = result.abs().next_up() - result.abs();
        let error = ((DoubleDouble::from(result) - truth) / DoubleDouble::from(ulp)).abs();
        assert!(error < DoubleDouble::from(limit), "{name}: {error:?} units");
    };
    for seed in 0..20_000 {
        let mut random = Random(seed);
        let range = [1.0, 10.0, 300.0, 1e6][seed as usize % 4];
        let (x, y) = (random.between(-range, range), random.between(-range, range));
        let (near, positive) = (random.between(-1.0, 1.0), x.abs().max(1e-300));
        let double = DoubleDouble::from;
        check("sin", 1.0, libm::sin(x), double(x).sin());
        check("cos", 1.0, libm::cos(x), double(x).cos());
        check("tan", 2.0, libm::tan(x), double(x).tan());
        check("asin", 1.0, libm::asin(near), double(near).asin());
        check("acos", 1.0, libm::acos(near), double(near).acos());
        check("atan", 1.0, libm::atan(x), double(x).atan());
        check("atan2", 2.0, libm::atan2(y, x), double(y).atan2(double(x)));
        check("ln", 1.0, libm::log(positive), double(positive).ln());
        if range < 1e6 {
            check("exp", 1.0, libm::exp(x), double(x).exp());
            check("sinh", 2.0, libm::sinh(x), double(x).sinh());
            check("cosh", 2.0, libm::cosh(x), double(x).cosh());
            check("tanh", 2.0, libm::tanh(x), double(x).tanh());
        }
        check(
            "pow",
            2.0,
            libm::pow(positive, 20.0 * near),
            double(positive).powf(double(20.0 * near)),
        );
    }
}

#[test]
fn extremes_inside_are_found() {
    let sine = |lo, hi| Interval::new(lo, hi).sin();
    assert_eq!(sine(1.0, 2.0).hi(), 1.0);
    assert!(sine(1.0, 1.5).hi() < 0.9975);
    assert_eq!(sine(4.0, 5.0).lo(), -1.0);
    assert_eq!(sine(-100.0, 100.0), Interval::new(-1.0, 1.0));
    assert_eq!(Interval::new(-1.0, 0.5).cos().hi(), 1.0);
    assert_eq!(Interval::new(3.0, 3.5).cos().lo(), -1.0);
    assert_eq!(Interval::new(100.0, 101.0).cos().hi(), 1.0); // 32π = 100.53
    assert!(!Interval::new(1.5, 1.6).tan().is_finite());
    assert!(Interval::new(1.6, 4.7).tan().is_finite());
    assert_eq!(Interval::new(-2.0, 1.0).abs(), Interval::new(0.0, 2.0));
    assert_eq!(Interval::new(-2.0, 1.0).powi(2), Interval::new(0.0, 4.0));
    assert_eq!(Interval::new(-2.0, 1.0).powi(3), Interval::new(-8.0, 1.0));
    assert_eq!(Interval::new(-2.0, 0.0).sign(), Interval::new(-1.0, 0.0));
}

#[test]
fn angles_jump_behind_the_origin() {
    let pi = Interval::pi().hi();
    let behind = Interval::new(-2.0, -1.0);
    assert_eq!(
        Interval::new(-1.0, 1.0).atan2(behind),
        Interval::new(-pi, pi)
    );
    assert!(Interval::new(0.0, 1.0).atan2(behind).lo() > 2.0);
    assert!(Interval::new(-0.0, 1.0).atan2(behind).lo() > 2.0);
    assert!(Interval::new(-1.0, -0.1).atan2(behind).hi() < -1.5);
    assert!(Interval::new(-1.0, 1.0).atan2(-behind).hi() < 0.8);
}

#[test]
fn exact_operations_stay_exact() {
    let number = |x: f64| Interval::from(x);
    assert_eq!(number(3.0) * number(0.5) + number(1.0), number(2.5));
    assert_eq!(number(3.0) / number(4.0), Interval::from_ratio(3, 4));
    assert_eq!(number(9.0).sqrt(), number(3.0));
    assert_eq!(number(2.0).powi(-3), number(0.125));
    let third = Interval::from_ratio(1, 3);
    assert_eq!(third.hi(), third.lo().next_up());
    assert_eq!(
        (third.width(), third.contains(1.0 / 3.0)),
        (third.hi() - third.lo(), true)
    );
    let large = Interval::from_ratio(i64::MAX, 1);
    assert!(large.lo() < large.hi() && large.hi() == 2f64.powi(63));
}

#[test]
fn what_is_unknown_stays_unknown() {
    let one = Interval::ONE;
    let unknown = one / Interval::new(-1.0, 1.0);
    for result in [
        unknown,
        one / unknown,
        unknown * Interval::ZERO,
        unknown - unknown,
        -unknown,
        unknown.sin(),
        unknown.tan(),
        unknown.atan(),
        unknown.tanh(),
        unknown.exp(),
        unknown.abs(),
        unknown.sign(),
        unknown.powi(0),
        unknown.min(one),
        one.max(unknown),
        one.atan2(unknown),
        one.powf(unknown),
        Interval::from(f64::MAX) + Interval::from(f64::MAX),
        Interval::from(f64::MAX) * Interval::from(2.0),
        Interval::from(f64::NAN),
        Interval::new(2.0, 1.0),
        Interval::new(-1.0, 1.0).sqrt(),
        Interval::new(0.0, 1.0).ln(),
        Interval::new(0.0, 2.0).asin(),
        Interval::from(1000.0).exp(),
    ] {
        assert!(!result.is_finite(), "{result:?}");
        assert_ne!(result, result);
        assert!(!result.exceeds(Interval::from(-f64::MAX)));
    }
    assert!(Interval::new(1.0, 2.0).exceeds(Interval::new(0.0, 0.5)));
    assert!(!Interval::new(1.0, 2.0).exceeds(Interval::new(0.0, 1.0)));
    assert!(!Interval::new(1.0, 2.0).exceeds(unknown));
}

/// Bounds at the ends of the range of `f64`, where the errors of products cannot be represented.
#[test]
fn tiny_and_huge_products_are_enclosed() {
    for seed in 0..5000 {
        let mut random = Random(seed);
        let (a, b) = (random.scaled(-540.0, -480.0), random.scaled(-540.0, -480.0));
        let product = Interval::from(a) * Interval::from(b);
        // The same product scaled by 2¹⁰⁰⁰ is exact in double-double.
        let truth = DoubleDouble::from(a * 2f64.powi(500)) * DoubleDouble::from(b * 2f64.powi(500));
        let scaled = |x: f64| DoubleDouble::from(x * 2f64.powi(1000));
        assert!(
            scaled(product.lo()) <= truth && truth <= scaled(product.hi()),
            "seed {seed}"
        );
        let quotient = Interval::from(a * b) / Interval::from(b);
        if quotient.is_finite() && a * b != 0.0 {
            let truth = scaled(a * b) / DoubleDouble::from(b * 2f64.powi(500));
            let scaled = |x: f64| DoubleDouble::from(x * 2f64.powi(500));
            assert!(
                scaled(quotient.lo()) <= truth && truth <= scaled(quotient.hi()),
                "seed {seed}"
            );
        }
    }
}
