//! Bogacki–Shampine 3(2): cheap steps for coarse tolerances and motions that are not smooth.

use super::Tableau;
use super::digits::coefficients;

coefficients! {
    c: [0.0, 1.0 / 2.0, 3.0 / 4.0, 1.0],
    a: [
        [],
        [1.0 / 2.0],
        [0.0, 3.0 / 4.0],
        [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0],
    ],
    error: [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0],
    coarse_error: [],
    dense: [],
}

/// Bogacki–Shampine 3(2), first same as last.
///
/// P. Bogacki and L. F. Shampine, *A 3(2) pair of Runge–Kutta formulas*, Appl. Math. Lett. 2 (1989)
/// 321–325. Dense output is the cubic through both ends.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "bs32",
    title: "Bogacki–Shampine 3(2)",
    order: 3,
    error_power: 3,
    dense_order: 3,
    stages: 3,
    c: C,
    a: A,
    // b − b̂ with b̂ = (7/24, 1/4, 1/3, 1/8)
    error: ERROR,
    coarse_error: None,
    dense: DENSE,
    step_change: (0.2, 10.0),
    smoothing: 0.0,
    stability: None,
    spectrum: None,
};
