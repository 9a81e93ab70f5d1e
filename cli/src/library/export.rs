// The exports of the library. This file is not a module of the command: `library.rs` includes its text at the root of the generated
// file, beside the module `machine` of the machine, the module `alone` for one state, and the modules of the crates
// `lagrangian-scalar` and `lagrangian-native`.

use core::cell::UnsafeCell;
use core::ffi::{CStr, c_char, c_int};
use core::ptr::null;

use lanes::Lanes;
use machine::{COORDINATES, INPUTS, PARAMETERS, Prepared};
use vector::Register;
use scalar::{Kernel, Piece, Scalar};

/// The functions of `libm` that generated code may call, from the C library. Sines and cosines up to 1e5 rad are polynomials
/// of this library if the processor has fused multiply-add.
mod libm {
    macro_rules! functions {
        ($($name:ident $method:ident($($argument:ident)?);)*) => {$(
            pub fn $name(x: f64 $(, $argument: f64)?) -> f64 {
                x.$method($($argument)?)
            }
        )*};
    }

    functions! {
        tan tan(); asin asin(); acos acos(); atan atan(); atan2 atan2(x2); sinh sinh(); cosh cosh(); tanh tanh();
        exp exp(); log ln(); sqrt sqrt(); pow powf(exponent);
    }

    pub fn sincos(x: f64) -> (f64, f64) {
        x.sin_cos()
    }
}

/// A number, with the registers of the target processor for it.
pub trait Number: Copy {
    fn run<K: Kernel<Self>>(kernel: K) -> K::Output;
}

macro_rules! numbers {
    ($($stored:ty: $register:ident, $fused:ty, $plain:ty;)*) => {$(
        impl Number for $stored {
            #[inline(always)]
            fn run<K: Kernel<Self>>(kernel: K) -> K::Output {
                #[cfg(all(target_arch = "x86_64", target_feature = "avx2", target_feature = "fma"))]
                return kernel.run::<Register<x86::$register>>();
                #[cfg(target_arch = "aarch64")]
                return kernel.run::<Register<$fused>>();
                #[cfg(not(any(
                    all(target_arch = "x86_64", target_feature = "avx2", target_feature = "fma"),
                    target_arch = "aarch64",
                )))]
                return kernel.run::<$plain>();
            }
        }
    )*};
}

numbers! {
    f64: One, f64, f64;
    Lanes<2>: Two, [f64; 2], plain::Plain<2>;
    Lanes<4>: Four, [f64; 4], plain::Plain<4>;
}

#[cfg(target_feature = "avx512vl")]
numbers! { Lanes<8>: Eight, [f64; 8], plain::Plain<8>; }
#[cfg(not(target_feature = "avx512vl"))]
numbers! { Lanes<8>: TwiceFour, [f64; 8], plain::Plain<8>; }

/// How many of eight states a long program evaluates at once: as many as fit in a register. A pair of registers for one
/// number would be spilled to memory, and compile time would grow with the square of the program.
#[cfg(target_feature = "avx512vl")]
const IN_A_REGISTER: usize = 8;
#[cfg(not(target_feature = "avx512vl"))]
const IN_A_REGISTER: usize = 4;

/// The mass matrix cannot be inverted, or constraints depend on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular;

/// The pivots of a machine's eliminations, as in `lagrangian::emitted`, but without the index of the row.
#[derive(Clone, Copy)]
pub struct Pivots {
    pub coordinates: usize,
    pub tolerance: f64,
}

impl Pivots {
    /// The pivots of eliminations with this number of rows; the factor is `PIVOT_MARGIN` of `lagrangian-program`.
    pub const fn new(coordinates: usize, rows: usize) -> Pivots {
        Pivots { coordinates, tolerance: 4.0 * rows as f64 * f64::EPSILON }
    }

    /// Whether a pivot exceeds its tolerance times the diagonal element in all lanes; NaN does not.
    #[inline(always)]
    pub fn hold<N: Scalar>(self, pivot: N, diagonal: N) -> bool {
        pivot.exceeds(N::from_f64(self.tolerance) * diagonal)
    }

    #[inline(always)]
    pub fn vanished<N: Scalar, const K: usize>(self, pivots: [(usize, N, N); K]) -> Option<Singular> {
        let all_hold = pivots.iter().all(|&(_, pivot, diagonal)| self.hold(pivot, diagonal));
        if all_hold { None } else { Some(Singular) }
    }

    #[inline(always)]
    pub fn check<N: Scalar, const K: usize>(self, pivots: [(usize, N, N); K]) -> Result<(), Singular> {
        match self.vanished(pivots) {
            Some(singular) => Err(singular),
            None => Ok(()),
        }
    }
}

const N: usize = COORDINATES.len();
const P: usize = PARAMETERS.len();
const U: usize = INPUTS.len();

/// The result of `eval_setup`, aligned such that no register load crosses cache lines.
#[repr(align(64))]
struct Slot<T>(UnsafeCell<Option<T>>);

// SAFETY: the header requires that `eval_setup` is not called while another function of the library runs.
unsafe impl<T> Sync for Slot<T> {}

static ONE: Slot<alone::Prepared<f64>> = Slot(UnsafeCell::new(None));

/// The values of a table.
fn values<const K: usize>(table: &[(&CStr, &CStr, f64); K]) -> [f64; K] {
    table.map(|(_, _, value)| value)
}

/// # Safety
/// `p` must be null or point to the parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eval_setup(p: *const f64) {
    // SAFETY: guaranteed by the caller.
    let row = match unsafe { p.cast::<[f64; P]>().as_ref() } {
        Some(row) => *row,
        None => values(&PARAMETERS),
    };
    // SAFETY: no other function of the library runs.
    unsafe {
        *ONE.0.get() = Some(alone::prepared(&row));
        set_up_lanes(&machine::prepared(&row));
    }
}

/// The values of the inputs, which follow the parameters.
///
/// # Safety
/// `p` must be null or point to parameters and inputs.
#[inline(always)]
unsafe fn given(p: *const f64) -> [f64; U] {
    if U == 0 || p.is_null() {
        return values(&INPUTS);
    }
    // SAFETY: guaranteed by the caller.
    unsafe { p.add(P).cast::<[f64; U]>().read() }
}

/// # Safety
/// `y` and `qdd` must point to as many numbers as the header says, without overlap; `p` must be null or point to
/// parameters and inputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eval(y: *const f64, t: f64, p: *const f64, qdd: *mut f64) {
    // SAFETY: guaranteed by the caller; the slot is not written meanwhile.
    unsafe {
        let ([q, v], a) = (&*y.cast::<[[f64; N]; 2]>(), &mut *qdd.cast::<[f64; N]>());
        let prepared = (*ONE.0.get()).as_ref();
        if !prepared.is_some_and(|prepared| alone::evaluate(prepared, t, q, v, &given(p), a)) {
            *a = [f64::NAN; N];
        }
    }
}

/// Defines the functions for several states at once, and how many of these are evaluated together; `library.rs`
/// writes the call.
macro_rules! several {
    ($($name:ident: $lanes:literal by $width:expr;)*) => {
        /// # Safety
        /// No other function of the library may run.
        unsafe fn set_up_lanes(prepared: &Prepared) {
            // SAFETY: guaranteed by the caller.
            $(unsafe { *$name::SLOT.0.get() = Some(prepared.map(Lanes::splat)) };)*
        }

        $(
            mod $name {
                use super::*;

                const WIDTH: usize = $width;

                pub static SLOT: Slot<Prepared<Lanes<WIDTH>>> = Slot(UnsafeCell::new(None));

                /// # Safety
                /// As for `eval`; `t` must point to a time for each state.
                #[unsafe(no_mangle)]
                pub unsafe extern "C" fn $name(y: *const f64, t: *const f64, p: *const f64, qdd: *mut f64) {
                    // SAFETY: as for `eval`; lanes are aligned as single numbers, and every index is within the states.
                    unsafe {
                        let prepared = (*SLOT.0.get()).as_ref();
                        let inputs = given(p).map(Lanes::splat);
                        let all = prepared.is_some_and(|prepared| {
                            if WIDTH == $lanes {
                                let [q, v] = &*y.cast::<[[Lanes<WIDTH>; N]; 2]>();
                                let a = &mut *qdd.cast::<[Lanes<WIDTH>; N]>();
                                return machine::evaluate(prepared, *t.cast::<Lanes<WIDTH>>(), q, v, &inputs, a);
                            }
                            let mut a = [Lanes::splat(0.0); N];
                            let mut state = [[Lanes::splat(0.0); N]; 2];
                            (0..$lanes).step_by(WIDTH).all(|first| {
                                for (i, numbers) in state.as_flattened_mut().iter_mut().enumerate() {
                                    *numbers = y.add($lanes * i + first).cast::<Lanes<WIDTH>>().read();
                                }
                                let [q, v] = &state;
                                let at = t.add(first).cast::<Lanes<WIDTH>>().read();
                                let is_regular = machine::evaluate(prepared, at, q, v, &inputs, &mut a);
                                for (i, numbers) in a.iter().enumerate() {
                                    qdd.add($lanes * i + first).cast::<Lanes<WIDTH>>().write(*numbers);
                                }
                                is_regular
                            })
                        });
                        if !all {
                            one_by_one(y, t, p, qdd);
                        }
                    }
                }

                /// Evaluates states one by one if one of them has no accelerations, or an angle too large for lanes, so
                /// that the others get the same results as alone.
                ///
                /// # Safety
                /// As for the function above: everything is read again, so that nothing needs to be kept for this case.
                #[cold]
                #[inline(never)]
                unsafe fn one_by_one(y: *const f64, t: *const f64, p: *const f64, qdd: *mut f64) {
                    for lane in 0..$lanes {
                        // SAFETY: guaranteed by the caller.
                        unsafe {
                            let row = |i: usize| *y.add($lanes * i + lane);
                            let state: [f64; 2 * N] = core::array::from_fn(row);
                            let mut a = [0.0; N];
                            eval(state.as_ptr(), *t.add(lane), p, a.as_mut_ptr());
                            for (i, number) in a.into_iter().enumerate() {
                                *qdd.add($lanes * i + lane) = number;
                            }
                        }
                    }
                }
            }
        )*
    };
}

macro_rules! tables {
    ($($table:ident: $count:ident { $($column:ident: $type:ty = $pattern:pat => $value:expr, else $none:expr;)* })*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $count() -> c_int {
            $table.len() as c_int
        }
        $(
            #[unsafe(no_mangle)]
            pub extern "C" fn $column(i: c_int) -> $type {
                match usize::try_from(i).ok().and_then(|i| $table.get(i)) {
                    Some($pattern) => $value,
                    None => $none,
                }
            }
        )*
    )*};
}

tables! {
    COORDINATES: coordinates {
        coordinate_name: *const c_char = (name, ..) => name.as_ptr(), else null();
        coordinate_unit: *const c_char = (_, unit, _) => unit.as_ptr(), else null();
    }
    PARAMETERS: parameters {
        parameter_name: *const c_char = (name, ..) => name.as_ptr(), else null();
        parameter_unit: *const c_char = (_, unit, _) => unit.as_ptr(), else null();
        parameter_default: f64 = (.., value) => *value, else f64::NAN;
    }
    INPUTS: inputs {
        input_name: *const c_char = (name, ..) => name.as_ptr(), else null();
        input_unit: *const c_char = (_, unit, _) => unit.as_ptr(), else null();
        input_default: f64 = (.., value) => *value, else f64::NAN;
    }
}
