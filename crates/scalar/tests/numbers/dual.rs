//! Derivatives compared with differences in double-double, with closed forms, and exactly in the prime field.

use crate::common::Random;
use lagrangian_scalar::{DoubleDouble, Dual, Jet, Residue, Scalar};

type Function<S> = fn(S) -> S;

/// Every function of one number, with the range on which it is tested.
fn functions<S: Scalar>() -> Vec<(&'static str, Function<S>, f64, f64)> {
    fn half<S: Scalar>() -> S {
        S::from_ratio(1, 2)
    }
    vec![
        ("sin", |x| x.sin(), -3.0, 3.0),
        ("cos", |x| x.cos(), -3.0, 3.0),
        ("tan", |x| x.tan(), -1.2, 1.2),
        ("asin", |x| x.asin(), -0.9, 0.9),
        ("acos", |x| x.acos(), -0.9, 0.9),
        ("atan", |x| x.atan(), -3.0, 3.0),
        ("sinh", |x| x.sinh(), -3.0, 3.0),
        ("cosh", |x| x.cosh(), -3.0, 3.0),
        ("tanh", |x| x.tanh(), -3.0, 3.0),
        ("exp", |x| x.exp(), -3.0, 3.0),
        ("ln", |x| x.ln(), 0.2, 3.0),
        ("sqrt", |x| x.sqrt(), 0.2, 3.0),
        ("abs", |x| x.abs(), 0.1, 3.0),
        ("abs", |x| x.abs(), -3.0, -0.1),
        ("sign", |x| x.sign(), 0.1, 3.0),
        ("min", |x| x.min(x * x), 1.1, 3.0),
        ("max", |x| x.max(x * x), 1.1, 3.0),
        ("quotient", |x| (x + S::ONE) / (x * x + half()), -3.0, 3.0),
        ("difference", |x| (half::<S>() - x) * -x, -3.0, 3.0),
        ("cube", |x| x.powi(3), -3.0, 3.0),
        ("inverse square", |x| x.powi(-2), 0.2, 3.0),
        ("x^0", |x| x.powi(0), -3.0, 3.0),
        ("x^2.5", |x| x.powf(S::from_ratio(5, 2)), 0.2, 3.0),
        (
            "negative cubed",
            |x| x.powf(S::from_ratio(3, 1)),
            -3.0,
            -0.2,
        ),
        ("0.5^x", |x| half::<S>().powf(x), -3.0, 3.0),
        ("x^x", |x| x.powf(x), 0.2, 3.0),
        (
            "atan2 of both",
            |x| x.sin().atan2(x.cos() + half()),
            -2.0,
            2.0,
        ),
    ]
}

#[test]
fn derivatives_equal_differences() {
    let step = DoubleDouble::from(2f64.powi(-35));
    for ((name, function, low, high), (_, dual, ..)) in functions::<DoubleDouble>()
        .into_iter()
        .zip(functions::<Dual<DoubleDouble>>())
    {
        for seed in 0..50 {
            let x = DoubleDouble::from(Random(seed).between(low, high));
            let result = dual(Dual::variable(x));
            assert_eq!(result.value, function(x), "{name}");
            let difference = (function(x + step) - function(x - step)) / (step + step);
            // Truncation error step² f‴/6 with |f‴| ≤ 10⁴ on these ranges: 1.5e-18. Rounding error 2⁻¹⁰⁰
            // |f|/step: below 1e-18.
            let error = (result.derivative - difference).abs().to_f64();
            assert!(
                error < 1e-17,
                "{name}′({x:?}), seed {seed}: off by {error:e}"
            );
        }
    }
}

#[test]
fn kinks_have_the_mean_slope() {
    let zero = Dual::variable(0.0);
    assert_eq!(zero.abs(), Dual::constant(0.0));
    let x = Dual::variable(2.0);
    assert_eq!(x.min(Dual::constant(2.0)).derivative, 0.5);
    assert_eq!(x.max(Dual::constant(3.0)), Dual::constant(3.0));
    assert_eq!(x.min(Dual::constant(3.0)), x);
}

#[test]
fn nested_duals_have_second_derivatives() {
    let x = Dual::variable(Dual::variable(0.7));
    let second = |y: Dual<Dual<f64>>| y.derivative.derivative;
    // sin″ = −sin, (x⁵)″ = 20x³, to a few rounding units.
    assert!((second(x.sin()) + 0.7f64.sin()).abs() < 1e-15);
    assert!((second(x.powi(5)) - 20.0 * 0.7f64.powi(3)).abs() < 1e-14);
}

#[test]
fn derivatives_of_identities_are_identities() {
    for seed in 0..10 {
        let x = Dual::variable(Residue::random(seed, 0));
        let y = Dual::constant(Residue::random(seed, 1));
        let (sin, cos) = x.sin_cos();
        assert_eq!(sin * sin + cos * cos, Dual::ONE);
        assert_eq!((x + y).sin(), sin * y.cos() + cos * y.sin());
        assert_eq!(x.tan(), sin / cos);
        assert_eq!(x.powi(-3), Dual::ONE / (x * x * x));
        assert_eq!((x * y).cosh().powi(2) - (y * x).sinh().powi(2), Dual::ONE);
    }
}

#[test]
fn what_is_undefined_shows() {
    let zero = Dual::variable(0.0);
    assert!(!zero.sqrt().is_finite()); // vertical slope
    assert!(!(Dual::ONE / zero).is_finite());
    assert!(Dual::variable(2.0).exceeds(Dual::ONE));
    assert_eq!(Dual::<f64>::pi().to_f64(), core::f64::consts::PI);
    assert!(Dual::variable(1.5).powi(i32::MIN).is_finite());
}

/// The coefficients of a jet are derivatives over factorials, compared with nested dual numbers, which do not use
/// series: exactly in the prime field where it has the function, and to 32 digits elsewhere.
#[test]
fn jets_are_derivatives_over_factorials() {
    type Third<S> = Dual<Dual<Dual<S>>>;
    fn third<S: Scalar>(x: S) -> Third<S> {
        let inner = Dual::variable(x);
        let middle = Dual {
            value: inner,
            derivative: Dual::constant(S::ONE),
        };
        Dual {
            value: middle,
            derivative: Dual::constant(Dual::constant(S::ONE)),
        }
    }
    fn coefficients<S: Scalar>(of: Third<S>) -> [S; 4] {
        [
            of.value.value.value,
            of.value.value.derivative,
            of.value.derivative.derivative * S::from_ratio(1, 2),
            of.derivative.derivative.derivative * S::from_ratio(1, 6),
        ]
    }
    let mut random = Random(17);
    let jets = functions::<Jet<DoubleDouble, 4>>();
    let duals = functions::<Third<DoubleDouble>>();
    for ((name, jet, low, high), (_, dual, ..)) in jets.into_iter().zip(duals) {
        for _ in 0..20 {
            let x = DoubleDouble::from(random.between(low, high));
            let found = jet(Jet::variable(x)).0;
            for (k, exact) in coefficients(dual(third(x))).into_iter().enumerate() {
                let difference = (found[k] - exact).to_f64().abs();
                let size = 1.0 + exact.to_f64().abs();
                assert!(difference < 1e-25 * size, "{name} at {x:?}: order {k}");
            }
        }
    }
    let x = Residue::random(3, 1);
    let function = |x: Jet<Residue, 4>| x.sin() * x.cos() / (x * x + Scalar::from_ratio(1, 3));
    let dual = |x: Third<Residue>| x.sin() * x.cos() / (x * x + Scalar::from_ratio(1, 3));
    assert_eq!(function(Jet::variable(x)).0, coefficients(dual(third(x))));
}
