//! Taylor series of the motion: steps of an order that a tolerance asks for.

use super::Tableau;

/// Steps by the Taylor series of the motion through their beginning, of order 12 or 20 by the tolerance.
///
/// À. Jorba, M. Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*, Exp.
/// Math. 14 (2005) 99–117. There are no stages: what stands here are nodes and weights of Gauss's and Radau's quadrature
/// with the beginning of the step among its nodes, exact up to degree 28, for the work and the dissipation along
/// the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "taylor",
    title: "Taylor series",
    order: 20,
    error_power: 21,
    dense_order: 20,
    stages: 15,
    c: &[
        0.0,
        0.016224765901399762,
        0.053697299939724615,
        0.11065719118048446,
        0.18461026055652535,
        0.2723235471107353,
        0.36996331162959606,
        0.47326213866012695,
        0.5777053426924298,
        0.6787282560110638,
        0.771915729350742,
        0.8531951323187863,
        0.9190145003180448,
        0.9664985954679869,
        0.9935832392071815,
        1.0,
    ],
    a: &[
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[],
        &[
            0.0044444444444444444,
            0.02710139002432225,
            0.04756479973024045,
            0.06593773125247582,
            0.08142723865191631,
            0.09335757291972545,
            0.10120759351530921,
            0.10463430407384729,
            0.10348798012477688,
            0.09781875152255806,
            0.08787443632122384,
            0.07408976350173363,
            0.05706760174487638,
            0.03755419638025322,
            0.016432195792296767,
        ],
    ],
    error: &[],
    coarse_error: None,
    dense: &[],
    step_change: (0.1, 10.0),
    smoothing: 0.0,
    stability: None,
    spectrum: None,
};
