//! The classical Runge–Kutta method, in steps of a fixed length, for loops of a fixed rate.

use super::Tableau;

/// E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., 1993, section II.1, table 1.2.
///
/// A step takes four evaluations and one at its end, which is the first of the next. The motion within a step is the cubic
/// through its ends.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "rk4",
    title: "Runge–Kutta 4",
    order: 4,
    error_power: 1,
    dense_order: 3,
    stages: 4,
    c: &[0.0, 0.5, 0.5, 1.0, 1.0],
    a: &[
        &[],
        &[0.5],
        &[0.0, 0.5],
        &[0.0, 0.0, 1.0],
        &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    ],
    error: &[],
    coarse_error: None,
    dense: &[],
    step_change: (1.0, 1.0),
    smoothing: 0.0,
    stability: None,
    spectrum: None,
};
