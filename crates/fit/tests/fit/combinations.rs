//! Combinations of parameters that data determine when the parameters themselves cannot be told
//! apart, for cases known by hand.

use lagrangian_fit::combinations::{CombinationForm, combinations};
use nalgebra::DMatrix;

fn names(all: &[&str]) -> Vec<String> {
    all.iter().map(|name| (*name).to_owned()).collect()
}

/// The combinations that are reported for residuals given as functions.
fn told(x: &[f64], null: &[&[f64]], names_of: &[&str], of: fn(&[f64]) -> Vec<f64>) -> Vec<String> {
    let null = DMatrix::from_fn(x.len(), null.len(), |j, i| null[i][j]);
    let mut is_same = |from: &[f64], to: &[f64]| {
        let (here, there) = (of(from), of(to));
        here.iter()
            .zip(&there)
            .all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs())
    };
    let found = combinations(x, x, &null, 1e-12, &mut is_same);
    found.iter().map(|c| c.formula(&names(names_of))).collect()
}

#[test]
fn quotients_are_found() {
    let of = |x: &[f64]| vec![x[0] / x[2], x[1] / x[2]];
    assert_eq!(
        told(&[3.0, 0.5, 2.0], &[&[3.0, 0.5, 2.0]], &["k", "c", "m"], of),
        ["k/m", "c/m"]
    );
    let of = |x: &[f64]| vec![x[0] * x[0] / x[1]];
    assert_eq!(
        told(&[3.0, 0.5], &[&[3.0, 1.0]], &["a", "b"], of),
        ["a/b^(1/2)"]
    );
}

#[test]
fn sums_are_found() {
    let of = |x: &[f64]| vec![x[0] + x[1]];
    assert_eq!(
        told(&[1.0, 2.0], &[&[1.0, -1.0]], &["m1", "m2"], of),
        ["m1 + m2"]
    );
    // At equal numbers the null direction is also that of a product, and a trial step decides.
    assert_eq!(
        told(&[1.0, 1.0], &[&[1.0, -1.0]], &["m1", "m2"], of),
        ["m1 + m2"]
    );
    let of = |x: &[f64]| vec![x[0] + 0.3 * x[1], x[2]];
    let found = told(&[1.0, 2.0, 5.0], &[&[0.3, -1.0, 0.0]], &["J", "m", "g"], of);
    assert_eq!(found, ["J + 0.3*m"]);
}

#[test]
fn what_is_neither_is_local() {
    let of = |x: &[f64]| vec![x[2] / (x[0] + x[1])];
    let null = DMatrix::from_columns(&[
        nalgebra::DVector::from_vec(vec![1.0, -1.0, 0.0]),
        nalgebra::DVector::from_vec(vec![1.0, 0.0, 2.0]),
    ]);
    // k/(m1 + m2) at 1, 2, 6.
    let x = [1.0, 2.0, 6.0];
    let mut is_same = |from: &[f64], to: &[f64]| (of(to)[0] - of(from)[0]).abs() <= 1e-12;
    let found = combinations(&x, &x, &null, 1e-12, &mut is_same);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].kind, CombinationForm::Local);
    // Its gradient is that of k/(m1 + m2), up to a factor: (−k, −k, m1 + m2) ~ (1, 1, −1/2).
    assert_eq!(found[0].terms, [(0, 1.0), (1, 1.0), (2, -0.5)]);
}
