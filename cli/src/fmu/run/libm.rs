//! The functions of the crate `libm` that the runtime calls, from the C library: the same up to rounding.

use core::ffi::c_int;

macro_rules! functions {
    (($number:ty) $($name:ident $method:ident($($argument:ident)?);)*) => {$(
        #[inline]
        pub fn $name(x: $number $(, $argument: $number)?) -> $number {
            x.$method($($argument)?)
        }
    )*};
}

functions! {
    (f64)
    tan tan(); asin asin(); acos acos(); atan atan(); atan2 atan2(x2); sinh sinh(); cosh cosh(); tanh tanh();
    exp exp(); expm1 exp_m1(); log ln(); sqrt sqrt(); pow powf(exponent); sin sin(); cos cos(); ceil ceil();
    floor floor(); rint round_ties_even(); fmax max(other); hypot hypot(other);
}

functions! {
    (f32)
    tanf tan(); asinf asin(); acosf acos(); atanf atan(); atan2f atan2(x2); sinhf sinh(); coshf cosh();
    tanhf tanh(); expf exp(); logf ln(); sqrtf sqrt(); powf powf(exponent);
}

pub fn sincos(x: f64) -> (f64, f64) {
    x.sin_cos()
}

pub fn sincosf(x: f32) -> (f32, f32) {
    x.sin_cos()
}

pub fn ilogb(x: f64) -> c_int {
    // SAFETY: the function takes any number.
    unsafe { of_c::ilogb(x) }
}

pub fn ldexp(x: f64, n: c_int) -> f64 {
    // SAFETY: the function takes any numbers.
    unsafe { of_c::ldexp(x, n) }
}

mod of_c {
    use core::ffi::c_int;

    unsafe extern "C" {
        pub fn ilogb(x: f64) -> c_int;
        pub fn ldexp(x: f64, n: c_int) -> f64;
    }
}
