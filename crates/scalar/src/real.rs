//! `f64` and `f32` as scalars, by `libm`: the same bits on every platform.

use crate::Scalar;

macro_rules! scalar_by_libm {
    ($float:ty, $pi:expr, $splitter:expr, $sincos:path, $tan:path, $asin:path, $acos:path, $atan:path, $atan2:path, $sinh:path, $cosh:path,
     $tanh:path, $exp:path, $log:path, $sqrt:path, $pow:path) => {
        impl Scalar for $float {
            type Stored = Self;

            #[inline(always)]
            fn load(stored: Self) -> Self {
                stored
            }
            #[inline(always)]
            fn store(self) -> Self {
                self
            }

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn from_ratio(numerator: i64, denominator: i64) -> Self {
                (numerator as f64 / denominator as f64) as $float
            }
            #[inline(always)]
            fn pi() -> Self {
                $pi
            }
            #[inline(always)]
            fn product_error(self, b: Self) -> Self {
                // T. J. Dekker, *A floating-point technique for extending the available precision*,
                // Numer. Math. 18 (1971) 224–242: halves of the significands multiply exactly.
                let halves = |x: Self| {
                    let c = $splitter * x;
                    let high = c - (c - x);
                    (high, x - high)
                };
                let ((a1, a0), (b1, b0)) = (halves(self), halves(b));
                let error = a0 * b0 - (((self * b - a1 * b1) - a0 * b1) - a1 * b0);
                // Numbers close to the largest cannot be split.
                if error.is_finite() { error } else { 0.0 }
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sincos(self)
            }
            #[inline(always)]
            fn tan(self) -> Self {
                $tan(self)
            }
            #[inline(always)]
            fn asin(self) -> Self {
                $asin(self)
            }
            #[inline(always)]
            fn acos(self) -> Self {
                $acos(self)
            }
            #[inline(always)]
            fn atan(self) -> Self {
                $atan(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $atan2(self, x)
            }
            #[inline(always)]
            fn sinh(self) -> Self {
                $sinh(self)
            }
            #[inline(always)]
            fn cosh(self) -> Self {
                $cosh(self)
            }
            #[inline(always)]
            fn tanh(self) -> Self {
                $tanh(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $exp(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $log(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                $pow(self, exponent)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn sign(self) -> Self {
                // `signum` is 1 at 0, but mechanics needs 0 there. NaN stays NaN.
                if self == 0.0 { 0.0 } else { self.signum() }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // Unlike `f64::min`, an undefined operand gives an undefined result.
                if self < other || self.is_nan() {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other || self.is_nan() {
                    self
                } else {
                    other
                }
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            #[inline(always)]
            fn exceeds(self, bound: Self) -> bool {
                self > bound
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }
        }
    };
}

scalar_by_libm!(
    f64,
    core::f64::consts::PI,
    134_217_729.0, // 2^27 + 1
    libm::sincos,
    libm::tan,
    libm::asin,
    libm::acos,
    libm::atan,
    libm::atan2,
    libm::sinh,
    libm::cosh,
    libm::tanh,
    libm::exp,
    libm::log,
    libm::sqrt,
    libm::pow
);
scalar_by_libm!(
    f32,
    core::f32::consts::PI,
    4097.0, // 2^12 + 1
    libm::sincosf,
    libm::tanf,
    libm::asinf,
    libm::acosf,
    libm::atanf,
    libm::atan2f,
    libm::sinhf,
    libm::coshf,
    libm::tanhf,
    libm::expf,
    libm::logf,
    libm::sqrtf,
    libm::powf
);
