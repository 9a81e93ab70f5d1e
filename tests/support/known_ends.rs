//! End states of runs to more digits than `f64` holds, computed by Gragg–Bulirsch–Stoer extrapolation in binary128. Two
//! resolutions agree to 4e-21 (double pendulum) and 8e-26 (crusher).

#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

use std::f64::consts::PI;

/// `machines/double_pendulum.machine` with its default parameters, 100 s after it starts from rest at [`REGULAR_START`]:
/// angles (rad), then rates (rad/s).
pub const REGULAR_AT_100: [f64; 4] = [
    0.1568362029256774608952189535,
    0.1549800061482846913584054161,
    0.7581220395333524674810571735,
    0.9338915929100755708546461654,
];
pub const REGULAR_START: [f64; 2] = [0.3, 0.5];

/// The same machine 10 s after it starts from rest at [`CHAOTIC_START`].
pub const CHAOTIC_AT_10: [f64; 4] = [
    -0.7531288742949123893982122328,
    1.627933082053701835561554578,
    -4.0873688513441880650215025,
    -8.869702578387531735668069548,
];
pub const CHAOTIC_START: [f64; 2] = [2.0, 2.5];

/// `machines/crusher9.machine` 5 s after it starts with the rates [`CRUSHER_RATES`]: coordinates, then rates.
pub const CRUSHER_AT_5: [f64; 18] = [
    0.06145283273805227510136737529,
    0.4241214737780232413153200169,
    -1.209985523340049481970345949,
    0.1455123597444114492826119317,
    5.967265586494525128131223913,
    5.0,
    0.1036735412132180923702475683,
    -15.9766278485484829123169667,
    -10.0,
    -0.09462865728282268521632893372,
    0.228207198914713414747289637,
    -0.5249274085360239320948923577,
    0.1100939663714541980174367722,
    -0.2019782217149329347742263169,
    1.0,
    0.0059859895538211664776422265,
    -2.701996137911471140233655696,
    -2.0,
];
pub const CRUSHER_RATES: [f64; 9] = [0.05, -0.03, 0.02, 0.0, 2.0, 1.0, 0.0, -3.0, -2.0];

/// Half the range of each number of the crusher's state; errors are relative to these.
pub const CRUSHER_RANGES: [f64; 18] = [
    0.02, 0.02, 0.1, 0.03, PI, PI, 0.02, PI, PI, 0.5, 0.5, 1.0, 0.3, 5.0, 10.0, 0.3, 5.0, 10.0,
];
