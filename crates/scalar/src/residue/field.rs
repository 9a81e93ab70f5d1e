//! The field GF(p²), p = 2⁶¹ − 1: numbers `re + i·im` with i² = −1.
//!
//! p is a Mersenne prime and p ≡ 3 (mod 4), so −1 has no root in GF(p) and adjoining i gives a
//! field. Nearly every value is in GF(p), `im = 0`; roots such as √3 and the angles π/3, π/5, …
//! need the rest.

use core::ops::{Add, Mul, Neg, Sub};

/// The prime, 2⁶¹ − 1.
pub const P: u64 = (1 << 61) - 1;

/// x mod p for x < 2¹²², by 2⁶¹ ≡ 1.
const fn reduce(x: u128) -> u64 {
    let folded = (x as u64 & P) + (x >> 61) as u64;
    if folded >= P { folded - P } else { folded }
}

/// a + b in GF(p).
const fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

/// −a in GF(p).
const fn neg(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}

/// a·b in GF(p).
pub const fn mul(a: u64, b: u64) -> u64 {
    reduce(a as u128 * b as u128)
}

/// a^n in GF(p).
pub fn pow(mut a: u64, mut n: u64) -> u64 {
    let mut result = 1;
    while n > 0 {
        if n & 1 == 1 {
            result = mul(result, a);
        }
        a = mul(a, a);
        n >>= 1;
    }
    result
}

/// The root of `a` in GF(p) that is a square itself, a^((p+1)/4), if `a` has a root.
///
/// Exactly one of r and −r is a square, since −1 is not; choosing it makes √(ab) = √a·√b for all
/// squares a, b.
pub fn root(a: u64) -> Option<u64> {
    // (p + 1)/4 = 2⁵⁹.
    let r = (0..59).fold(a, |r, _| mul(r, r));
    (mul(r, r) == a).then_some(r)
}

/// An element re + i·im of GF(p²).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    pub re: u64,
    pub im: u64,
}

impl Field {
    pub const ZERO: Field = Field::real(0);
    pub const ONE: Field = Field::real(1);

    /// An element of GF(p); `re < p`.
    pub const fn real(re: u64) -> Field {
        Field { re, im: 0 }
    }

    /// The image of an integer.
    pub fn integer(n: i64) -> Field {
        let magnitude = Field::real(reduce(n.unsigned_abs() as u128));
        if n < 0 { -magnitude } else { magnitude }
    }

    /// The image of 2^n for positive or negative n: 2⁶¹ = 1.
    pub fn power_of_two(n: i32) -> Field {
        Field::real(1 << n.rem_euclid(61))
    }

    pub fn is_zero(self) -> bool {
        self == Field::ZERO
    }

    pub fn conjugate(self) -> Field {
        Field {
            re: self.re,
            im: neg(self.im),
        }
    }

    /// re² + im², which is zero only for zero.
    pub fn norm(self) -> u64 {
        add(mul(self.re, self.re), mul(self.im, self.im))
    }

    /// self times i.
    pub fn times_i(self) -> Field {
        Field {
            re: neg(self.im),
            im: self.re,
        }
    }

    /// Half of self.
    pub fn half(self) -> Field {
        self * Field::power_of_two(-1)
    }

    /// 1/self, by Fermat: x^(p−2) = 1/x in GF(p).
    pub fn inverse(self) -> Option<Field> {
        if self.is_zero() {
            return None;
        }
        if self == Field::ONE {
            return Some(self); // most denominators
        }
        if self == Field::real(2) {
            return Some(Field::ONE.half()); // many others
        }
        if self.im == 0 {
            return Some(Field::real(pow(self.re, P - 2)));
        }
        Some(self.conjugate() * Field::real(pow(self.norm(), P - 2)))
    }

    pub fn pow(mut self, mut n: u64) -> Field {
        let mut result = Field::ONE;
        while n > 0 {
            if n & 1 == 1 {
                result = result * self;
            }
            self = self * self;
            n >>= 1;
        }
        result
    }

    /// A root whose real part (imaginary part, if the real part is 0) is a square in GF(p); unique.
    ///
    /// With self = a + ib = (c + id)²: c² = (a ± √(a²+b²))/2 and d = b/(2c). The product of the two
    /// candidates for c² is −b²/4, which is not a square, so exactly one of them is a square. No
    /// root exists if the norm a² + b² has none.
    pub fn root(self) -> Option<Field> {
        if self.im == 0 {
            return match root(self.re) {
                Some(r) => Some(Field::real(r)),
                None => root(neg(self.re)).map(|r| Field { re: 0, im: r }),
            };
        }
        let norm_root = root(self.norm())?;
        let half = 1 << 60;
        let c = root(mul(half, add(self.re, norm_root)))
            .or_else(|| root(mul(half, add(self.re, neg(norm_root)))))?;
        let d = mul(mul(self.im, half), pow(c, P - 2));
        Some(Field { re: c, im: d })
    }

    /// The sign that agrees with [`root`](Field::root): √(x²) = sign(x)·x. −1, 0 or 1.
    pub fn sign(self) -> i64 {
        let decisive = if self.re == 0 { self.im } else { self.re };
        match (decisive, root(decisive)) {
            (0, _) => 0,
            (_, Some(_)) => 1,
            (_, None) => -1,
        }
    }

    /// The canonical one of x and −x, and whether that is −x.
    pub fn canonical(self) -> (Field, bool) {
        let decisive = if self.re == 0 { self.im } else { self.re };
        if decisive > P / 2 {
            (-self, true)
        } else {
            (self, false)
        }
    }
}

impl Add for Field {
    type Output = Field;
    fn add(self, other: Field) -> Field {
        Field {
            re: add(self.re, other.re),
            im: add(self.im, other.im),
        }
    }
}

impl Sub for Field {
    type Output = Field;
    fn sub(self, other: Field) -> Field {
        self + -other
    }
}

impl Neg for Field {
    type Output = Field;
    fn neg(self) -> Field {
        Field {
            re: neg(self.re),
            im: neg(self.im),
        }
    }
}

impl Mul for Field {
    type Output = Field;
    fn mul(self, other: Field) -> Field {
        if self.im == 0 && other.im == 0 {
            return Field::real(mul(self.re, other.re));
        }
        Field {
            re: add(mul(self.re, other.re), neg(mul(self.im, other.im))),
            im: add(mul(self.re, other.im), mul(self.im, other.re)),
        }
    }
}
