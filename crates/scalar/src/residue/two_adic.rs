//! 2-adic numbers with a known number of bits.
//!
//! A 2-adic number is a series Σ b_k 2^k that begins at some k and never ends towards larger k; it
//! is represented by its value modulo a power of two. Odd numbers have inverses, so every rational
//! is a 2-adic number. F. Q. Gouvêa, *p-adic Numbers*, 3rd ed., Springer 2020, chapter 4.

use core::ops::{Add, Div, Mul, Neg};

/// Exponents beyond this become undefined; no angle comes close.
const EXPONENT_LIMIT: i64 = 1 << 24;

/// A 2-adic number, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub enum TwoAdic {
    /// Exactly 0.
    Zero,
    /// A multiple of 2^precision, otherwise unknown.
    Vanishing { precision: i32 },
    /// 2^exponent · mantissa; the mantissa is odd, and its lowest `bits` ≤ 128 bits are known, the
    /// others are kept 0.
    Known {
        mantissa: u128,
        exponent: i32,
        bits: u32,
    },
    /// No value: something was divided by a number that may be 0, or no value was ever assigned.
    Undefined,
}

use TwoAdic::{Known, Undefined, Vanishing, Zero};

/// The lowest `bits` bits of x.
const fn low_bits(x: u128, bits: u32) -> u128 {
    if bits >= 128 {
        x
    } else {
        x & ((1 << bits) - 1)
    }
}

impl TwoAdic {
    pub const ONE: TwoAdic = Known {
        mantissa: 1,
        exponent: 0,
        bits: 128,
    };

    /// The image of an integer.
    pub fn integer(n: i64) -> TwoAdic {
        if n == 0 {
            return Zero;
        }
        TwoAdic::from_bits(n as i128 as u128, 0, 128)
    }

    /// An odd number given by its bits.
    pub fn odd(mantissa: u128) -> TwoAdic {
        Known {
            mantissa: mantissa | 1,
            exponent: 0,
            bits: 128,
        }
    }

    /// 2^exponent · mantissa, with `bits` bits of the mantissa known (if 128, the mantissa is an
    /// integer in two's complement, and the bits above are unknown).
    pub fn from_bits(mantissa: u128, exponent: i64, bits: u32) -> TwoAdic {
        let mantissa = low_bits(mantissa, bits);
        if exponent.abs() > EXPONENT_LIMIT {
            return Undefined;
        }
        if mantissa == 0 {
            return Vanishing {
                precision: (exponent + bits as i64) as i32,
            };
        }
        let zeros = mantissa.trailing_zeros();
        Known {
            mantissa: mantissa >> zeros,
            exponent: (exponent + zeros as i64) as i32,
            bits: bits - zeros,
        }
    }

    /// self · 2^n.
    pub fn scaled(self, n: i32) -> TwoAdic {
        match self {
            Zero => Zero,
            Undefined => Undefined,
            Vanishing { precision } => Self::from_bits(0, precision as i64 + n as i64, 0),
            Known {
                mantissa,
                exponent,
                bits,
            } => Self::from_bits(mantissa, exponent as i64 + n as i64, bits),
        }
    }

    /// self mod 2^n, if it is an integer known that far; `n` ≤ 64.
    pub fn modulo_power_of_two(self, n: u32) -> Option<u64> {
        match self {
            Zero => Some(0),
            Undefined => None,
            Vanishing { precision } => (precision >= n as i32).then_some(0),
            Known {
                mantissa,
                exponent,
                bits,
            } => {
                let known = exponent as i64 + bits as i64;
                if exponent < 0 || known < n as i64 {
                    None
                } else if exponent >= n as i32 {
                    Some(0)
                } else {
                    Some(low_bits(mantissa << exponent, n) as u64)
                }
            }
        }
    }
}

/// The inverse of an odd number modulo 2¹²⁸, by Newton: x ← x(2 − mx) doubles the correct bits, and
/// m·m ≡ 1 (mod 8).
fn inverse_of_odd(m: u128) -> u128 {
    (0..6).fold(m, |x, _| {
        x.wrapping_mul(2u128.wrapping_sub(m.wrapping_mul(x)))
    })
}

impl Neg for TwoAdic {
    type Output = TwoAdic;
    fn neg(self) -> TwoAdic {
        match self {
            Known {
                mantissa,
                exponent,
                bits,
            } => Known {
                mantissa: low_bits(mantissa.wrapping_neg(), bits),
                exponent,
                bits,
            },
            other => other,
        }
    }
}

impl Add for TwoAdic {
    type Output = TwoAdic;
    fn add(self, other: TwoAdic) -> TwoAdic {
        match (self, other) {
            (Undefined, _) | (_, Undefined) => Undefined,
            (Zero, x) | (x, Zero) => x,
            (Vanishing { precision: a }, Vanishing { precision: b }) => Vanishing {
                precision: a.min(b),
            },
            (Vanishing { precision }, Known { .. }) => other + Vanishing { precision },
            (
                Known {
                    mantissa,
                    exponent,
                    bits,
                },
                Vanishing { precision },
            ) => {
                if precision <= exponent {
                    return Vanishing { precision };
                }
                let bits = bits.min((precision - exponent) as u32);
                TwoAdic::from_bits(mantissa, exponent as i64, bits)
            }
            (
                Known {
                    mantissa: m,
                    exponent: e,
                    bits,
                },
                Known {
                    mantissa: other_m,
                    exponent: other_e,
                    bits: other_bits,
                },
            ) => {
                if other_e < e {
                    return other + self;
                }
                // Now e ≤ other_e. The sum is known as far as both are.
                let shift = (other_e - e) as u32;
                let shifted = other_m.checked_shl(shift).unwrap_or(0);
                let known = bits.min(other_bits.saturating_add(shift));
                TwoAdic::from_bits(m.wrapping_add(shifted), e as i64, known)
            }
        }
    }
}

impl Mul for TwoAdic {
    type Output = TwoAdic;
    fn mul(self, other: TwoAdic) -> TwoAdic {
        match (self, other) {
            (Undefined, _) | (_, Undefined) => Undefined,
            (Zero, _) | (_, Zero) => Zero,
            (Vanishing { precision: a }, Vanishing { precision: b }) => {
                TwoAdic::from_bits(0, a as i64 + b as i64, 0)
            }
            (Vanishing { precision: a }, Known { exponent: b, .. })
            | (Known { exponent: a, .. }, Vanishing { precision: b }) => {
                TwoAdic::from_bits(0, a as i64 + b as i64, 0)
            }
            (
                Known {
                    mantissa: m,
                    exponent: e,
                    bits,
                },
                Known {
                    mantissa: other_m,
                    exponent: other_e,
                    bits: other_bits,
                },
            ) => {
                // The product of odd numbers is odd.
                let exponent = e + other_e;
                if exponent.unsigned_abs() > EXPONENT_LIMIT as u32 {
                    return Undefined;
                }
                let bits = bits.min(other_bits);
                Known {
                    mantissa: low_bits(m.wrapping_mul(other_m), bits),
                    exponent,
                    bits,
                }
            }
        }
    }
}

impl Div for TwoAdic {
    type Output = TwoAdic;
    fn div(self, other: TwoAdic) -> TwoAdic {
        match other {
            Zero | Vanishing { .. } | Undefined => Undefined,
            Known {
                mantissa,
                exponent,
                bits,
            } => {
                let inverse = Known {
                    mantissa: low_bits(inverse_of_odd(mantissa), bits),
                    exponent: -exponent,
                    bits,
                };
                self * inverse
            }
        }
    }
}
