//! Random numbers, and reference values with 448 bits.

#![allow(
    dead_code,
    reason = "each test file compiles its own copy and uses a part"
)]

use astro_float_num::{BigFloat, Consts, RoundingMode};

/// Bits of the reference values: after a cancellation of 2⁻¹¹⁰ they still have three times the bits
/// of the numbers under test.
pub const BITS: usize = 448;

pub const ROUND: RoundingMode = RoundingMode::ToEven;

/// SplitMix64, as in the OOPSLA 2014 paper by Steele, Lea and Flood.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.0;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Of random sign, with a magnitude from 2^low to 2^high.
    pub fn scaled(&mut self, low: f64, high: f64) -> f64 {
        let magnitude = self.between(low, high).exp2();
        if self.bits() & 1 == 0 {
            magnitude
        } else {
            -magnitude
        }
    }
}

pub fn big(x: f64) -> BigFloat {
    BigFloat::from_f64(x, BITS)
}

pub fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.add(b, BITS, ROUND)
}

pub fn sub(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.sub(b, BITS, ROUND)
}

pub fn mul(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.mul(b, BITS, ROUND)
}

pub fn div(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.div(b, BITS, ROUND)
}

pub fn sqrt(a: &BigFloat) -> BigFloat {
    a.sqrt(BITS, ROUND)
}

/// A reference function of one number with [`BITS`] bits.
pub type Truth = fn(&BigFloat, &mut Consts) -> BigFloat;

macro_rules! truth {
    ($($name:ident),*) => {
        $(pub fn $name(x: &BigFloat, constants: &mut Consts) -> BigFloat {
            x.$name(BITS, ROUND, constants)
        })*
    };
}
truth!(sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, ln);

pub fn constants() -> Consts {
    Consts::new().expect("memory for the constants of the truth")
}

/// The reference for atan2 by the half-angle formula 2 atan(y/(√(x² + y²) + x)),
/// or its other form for x < 0.
pub fn atan2(y: &BigFloat, x: &BigFloat, constants: &mut Consts) -> BigFloat {
    let length = sqrt(&add(&mul(x, x), &mul(y, y)));
    let tan_of_half = if x.is_negative() {
        div(&sub(&length, x), y)
    } else {
        div(y, &add(&length, x))
    };
    mul(&big(2.0), &atan(&tan_of_half, constants))
}

/// The smallest e with |a − b| < 2^e |b|; `i32::MIN` if they are equal.
pub fn error_exponent(a: &BigFloat, b: &BigFloat) -> i32 {
    let difference = sub(a, b);
    if difference.is_zero() {
        return i32::MIN;
    }
    div(&difference, b).exponent().unwrap_or(i32::MAX)
}
