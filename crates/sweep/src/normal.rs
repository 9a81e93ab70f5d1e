//! The quantile of the normal distribution.

/// The value below which the standard normal distribution has probability `p`, between 0 and 1; relative error 1e-15.
///
/// M. J. Wichura, *Algorithm AS 241: The percentage points of the normal distribution*, Applied Statistics 37 (1988)
/// 477–484, routine PPND16.
pub(crate) fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(CENTRAL, r);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = libm::sqrt(-libm::log(tail));
    let size = if r <= 5.0 {
        ratio(INTERMEDIATE, r - 1.6)
    } else {
        ratio(TAIL, r - 5.0)
    };
    size.copysign(q)
}

/// Numerator and denominator, constant terms first.
type Ratio = [[f64; 8]; 2];

fn ratio([above, below]: Ratio, r: f64) -> f64 {
    let value = |c: [f64; 8]| c.iter().rev().fold(0.0, |sum, c| sum * r + c);
    value(above) / value(below)
}

const CENTRAL: Ratio = [
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
];

const INTERMEDIATE: Ratio = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        0.000_774_545_014_278_341_4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        0.000_547_593_808_499_534_5,
        1.050_750_071_644_416_9e-9,
    ],
];

const TAIL: Ratio = [
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        0.001_242_660_947_388_078_4,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        0.000_786_869_131_145_613_3,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_7e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The distribution function, by the complementary error function.
    #[test]
    fn it_inverts_the_integral() {
        let tails = (1..160).map(|k| libm::exp2(-f64::from(k) / 4.0));
        for p in tails.chain((1..100).map(|k| f64::from(k) / 200.0)) {
            let x = quantile(p);
            let back = 0.5 * libm::erfc(-x / core::f64::consts::SQRT_2);
            // In the tail a relative error of 1e-15 in x changes p by x² times as much, because x is about φ/Φ there.
            let bound = 4e-15 * (1.0 + x * x);
            assert!((back / p - 1.0).abs() < bound, "{p} {x} {back}");
            if 1.0 - (1.0 - p) == p {
                assert_eq!(quantile(1.0 - p), -x);
            }
        }
        assert_eq!(quantile(0.5), 0.0);
    }
}
