//! A counter-based random number generator: each number is a function of its purpose, not the next one of a stream.
//!
//! J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, *Parallel random numbers: as easy as 1, 2, 3*, 2011: Philox4x32-10.

/// The purpose of a random number; numbers for different purposes are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Purpose {
    /// A value of a random design.
    Value = 0,
    /// The position within a stratum of a Latin hypercube.
    Position = 1,
    /// A round of the permutation of strata.
    Round = 2,
    /// The digits by which a Sobol sequence is shifted.
    Shift = 3,
}

/// Ten rounds of Philox4x32.
pub(crate) fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    const MULTIPLIERS: [u64; 2] = [0xD251_1F53, 0xCD9E_8D57];
    const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
    for _ in 0..10 {
        let [c0, c1, c2, c3] = counter;
        let [p0, p1] = [
            MULTIPLIERS[0] * u64::from(c0),
            MULTIPLIERS[1] * u64::from(c2),
        ];
        let (high, low) = (|p: u64| (p >> 32) as u32, |p: u64| p as u32);
        counter = [
            high(p1) ^ c1 ^ key[0],
            low(p1),
            high(p0) ^ c3 ^ key[1],
            low(p0),
        ];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// 64 random bits for a variable of a run.
pub(crate) fn bits(seed: u64, run: u64, variable: u32, purpose: Purpose) -> u64 {
    let (low, high) = (|x: u64| x as u32, |x: u64| (x >> 32) as u32);
    let counter = [low(run), high(run), variable, purpose as u32];
    let drawn = philox(counter, [low(seed), high(seed)]);
    u64::from(drawn[0]) | u64::from(drawn[1]) << 32
}

/// A number strictly between 0 and 1: the middle of one of 2⁵² equal intervals.
pub(crate) fn between(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1u64 << 52) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known answers that the authors publish with their library Random123 (kat_vectors).
    #[test]
    fn known_answers_are_met() {
        let all = u32::MAX;
        assert_eq!(
            philox([0; 4], [0; 2]),
            [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]
        );
        assert_eq!(
            philox([all; 4], [all; 2]),
            [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
        );
        assert_eq!(
            philox(
                [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344],
                [0xa409_3822, 0x299f_31d0]
            ),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }
}
