//! Radau IIA of order 5: for machines with parts that are far stiffer, or far more strongly damped,
//! than the time scale of their motion.

use super::{Conjugates, Spectrum, Tableau};

/// √6.
const R: f64 = 2.449_489_742_783_178;

/// Radau IIA with three stages: collocation at the zeros of Radau's polynomial, L-stable.
///
/// E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., 1996, section IV.5,
/// table 5.6; the error estimate is that of eq. (IV.8.19), with `γ₀` the real eigenvalue, before it
/// is [filtered](Spectrum::real).
///
/// The first stage here is the beginning of the step. The new point does not depend on it, but the
/// error estimate and dense output do. Since the last node is at the end, the acceleration there is the
/// slope of the collocation polynomial, which is smooth however stiff the machine is.
///
/// Dense output is the quadrature of the cubic through the accelerations at 0, c₁, c₂ and 1. Beyond the
/// cubic through both ends that is `h θ² (1 − θ)² · ¼ k[0, c₁, c₂, 1]`, with the third divided
/// difference; the weight of the node at 0 in the whole step is 0, so it meets the end exactly.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "radau5",
    title: "Radau IIA 5",
    order: 5,
    error_power: 4,
    dense_order: 4,
    stages: 4,
    c: &[0.0, (4.0 - R) / 10.0, (4.0 + R) / 10.0, 1.0, 1.0],
    a: &[
        &[],
        &[
            0.0,
            (88.0 - 7.0 * R) / 360.0,
            (296.0 - 169.0 * R) / 1800.0,
            (-2.0 + 3.0 * R) / 225.0,
        ],
        &[
            0.0,
            (296.0 + 169.0 * R) / 1800.0,
            (88.0 + 7.0 * R) / 360.0,
            (-2.0 - 3.0 * R) / 225.0,
        ],
        &[0.0, (16.0 - R) / 36.0, (16.0 + R) / 36.0, 1.0 / 9.0],
        &[0.0, (16.0 - R) / 36.0, (16.0 + R) / 36.0, 1.0 / 9.0],
    ],
    // γ₀, and ⅓ γ₀ (−13 − 7√6, −13 + 7√6, −1) A
    error: &[
        SPECTRUM.real,
        -0.428_298_294_115_368_1,
        0.245_039_074_384_916_53,
        -0.091_629_609_865_225_8,
    ],
    coarse_error: None,
    dense: &[&[
        -2.5,
        3.895_195_511_812_306,
        -2.228_528_845_145_639,
        5.0 / 6.0,
    ]],
    step_change: (0.2, 8.0),
    smoothing: 0.0,
    stability: None,
    spectrum: Some(SPECTRUM),
};

/// The spectrum of the matrix of the three stages. With `x = ∛81` and `y = ∛9` the eigenvalues are
/// `(6 + x − y)/30` and `(12 − x + y)/60 ± i √3 (x + y)/60` (section IV.8); the vectors are scaled so
/// that the last entries of the right ones are 1.
const SPECTRUM: Spectrum = Spectrum {
    real: 0.274_888_829_595_677_4,
    left_of_real: &[
        4.178_718_591_551_905,
        0.327_682_820_761_062_4,
        0.523_376_445_499_449_6,
    ],
    right_of_real: &[0.094_438_762_488_975_24, 0.250_213_122_965_333_3, 1.0],
    pairs: &[Conjugates {
        value: [0.162_555_585_202_161_3, 0.184_949_324_407_140_77],
        left: &[
            [-2.089_359_295_775_952_4, 0.251_436_317_472_893_4],
            [-0.163_841_410_380_531_2, -1.285_963_474_927_802_7],
            [0.238_311_777_250_275_22, 0.298_019_602_414_112_47],
        ],
        right: &[
            [-0.141_255_295_020_954_2, -0.030_029_194_105_147_424],
            [0.204_129_352_293_799_93, 0.382_942_112_757_261_9],
            [1.0, 0.0],
        ],
    }],
};
