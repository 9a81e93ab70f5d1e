//! The registers of x86-64: AVX2 with fused multiply-add, and AVX-512.
//!
//! The types here are valid only on a processor that has their instructions. Code outside the crate cannot
//! name them; kernels receive them from [`run`], which checks the processor first. Every SAFETY comment
//! below relies on this.

mod side_by_side;

use core::arch::x86_64::*;
use core::marker::PhantomData;

use crate::circular::{Circular, Sines, sin_cos_beyond_each};
use crate::sincos::{is_near, sin_cos_near};
use crate::vector::{Register, Vector};
use crate::{Kernel, Lanes, Piece};
use side_by_side::{convolve, store_four};

/// A type of this module, and whether the processor has it.
pub trait Native: Sines {
    /// Whether the processor has the instructions. The result is cached, and constant where the build's target
    /// features include them.
    fn is_here() -> bool;
}

/// Runs a kernel in registers `V`, or returns it where the processor lacks them.
#[inline(always)]
pub fn run<V: Native, K: Kernel<V::Stored>>(kernel: K) -> Result<K::Output, K> {
    if V::is_here() {
        Ok(V::call(Whole::<V, K>(kernel, PhantomData)))
    } else {
        Err(kernel)
    }
}

/// A kernel as a single piece.
struct Whole<V, K>(K, PhantomData<V>);

impl<V: Sines, K: Kernel<V::Stored>> Piece for Whole<V, K> {
    type Output = K::Output;

    #[inline(always)]
    fn run(self) -> K::Output {
        self.0.run::<Register<V>>()
    }
}

/// Compiled as a separate function that may use AVX2, together with everything inlined into it.
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
fn with_avx2<P: Piece>(piece: P) -> P::Output {
    piece.run()
}

/// Compiled as a separate function that may use AVX-512, together with everything inlined into it.
#[inline(never)]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
fn with_avx512<P: Piece>(piece: P) -> P::Output {
    piece.run()
}

macro_rules! is_here {
    ($($feature:tt),*) => {{
        #[cfg(feature = "std")]
        let here = true $(&& std::arch::is_x86_feature_detected!($feature))*;
        #[cfg(not(feature = "std"))]
        let here = true $(&& cfg!(target_feature = $feature))*;
        here
    }};
}

#[inline(always)]
fn has_avx2() -> bool {
    is_here!("avx2", "fma")
}

#[inline(always)]
fn has_avx512() -> bool {
    is_here!("avx512f", "avx512dq", "avx512vl", "avx2", "fma")
}

/// Implements [`Vector`] by intrinsics.
macro_rules! register {
    (
        $(#[$doc:meta])*
        $name:ident: $raw:ty, $lanes:literal lanes, mask $mask:ty, $here:ident, $with:ident, pairs $pairs:literal;
        $load:ident $store:ident $splat:ident $first:ident
        $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident
        $mul_add:ident $mul_sub:ident $neg_mul_add:ident $and:ident $xor:ident;
        shift_left |$x:ident| $shift_left:expr;
        is_odd |$odd:ident| $is_odd:expr;
        compare $compare:ident;
        select |$which:ident, $yes:ident, $no:ident| $select:expr;
        mask_and $mask_and:ident;
        all |$every:ident| $all:expr;
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $name($raw);

        impl Native for $name {
            #[inline(always)]
            fn is_here() -> bool {
                $here()
            }
        }

        // SAFETY, of every block: values of this type exist only where the processor has been checked (see the
        // module). Loads and stores are as long as the register.
        impl Vector for $name {
            type Stored = Lanes<$lanes>;
            type Mask = $mask;

            const ZERO: Self = $name::constant(0.0);
            const ONE: Self = $name::constant(1.0);
            const PAIRS_AT_ONCE: usize = $pairs;

            register!(@ load(stored: Lanes<$lanes>) -> Self { $name($load(stored.0.as_ptr())) });
            register!(@ splat(x: f64) -> Self { $name($splat(x)) });
            register!(@ add(self, b: Self) -> Self { $name($add(self.0, b.0)) });
            register!(@ sub(self, b: Self) -> Self { $name($sub(self.0, b.0)) });
            register!(@ mul(self, b: Self) -> Self { $name($mul(self.0, b.0)) });
            register!(@ div(self, b: Self) -> Self { $name($div(self.0, b.0)) });
            register!(@ mul_add(self, b: Self, c: Self) -> Self {
                $name($mul_add(self.0, b.0, c.0))
            });
            register!(@ mul_sub(self, b: Self, c: Self) -> Self {
                $name($mul_sub(self.0, b.0, c.0))
            });
            register!(@ neg_mul_add(self, b: Self, c: Self) -> Self {
                $name($neg_mul_add(self.0, b.0, c.0))
            });
            register!(@ sqrt(self) -> Self { $name($sqrt(self.0)) });
            register!(@ and(self, b: Self) -> Self { $name($and(self.0, b.0)) });
            register!(@ xor(self, b: Self) -> Self { $name($xor(self.0, b.0)) });
            register!(@ less(self, b: Self) -> $mask { $compare::<_CMP_LT_OQ>(self.0, b.0) });
            register!(@ at_most(self, b: Self) -> $mask { $compare::<_CMP_LE_OQ>(self.0, b.0) });
            register!(@ is_odd(self) -> $mask { let $odd = self.0; $is_odd });
            register!(@ select($which: $mask, $yes: Self, $no: Self) -> Self {
                let ($yes, $no) = ($yes.0, $no.0);
                $name($select)
            });
            register!(@ mask_and(a: $mask, b: $mask) -> $mask { $mask_and(a, b) });
            register!(@ all($every: $mask) -> bool { $all });
            register!(@ first(self) -> f64 { $first(self.0) });
            register!(@ call<P: Piece>(piece: P) -> P::Output { $with(piece) });

            #[inline(always)]
            fn store(self) -> Lanes<$lanes> {
                let mut stored = Lanes([0.0; $lanes]);
                // SAFETY: as above.
                unsafe { $store(stored.0.as_mut_ptr(), self.0) };
                stored
            }
            #[inline(always)]
            fn shift_left<const PLACES: u32>(self) -> Self {
                let $x = self.0;
                // SAFETY: as above.
                $name(unsafe { $shift_left })
            }
            #[inline(always)]
            fn map(self, f: impl Fn(f64) -> f64) -> Self {
                Self::load(Lanes(self.store().0.map(f)))
            }
            #[inline(always)]
            fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
                let (a, b) = (self.store(), other.store());
                Self::load(Lanes(core::array::from_fn(|i| f(a[i], b[i]))))
            }
        }

        impl Sines for $name {
            #[inline(always)]
            fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self) {
                let (sin, cos) = sin_cos_beyond_each(angle.store(), sin.store(), cos.store());
                (Self::load(sin), Self::load(cos))
            }
        }

        impl $name {
            const fn constant(x: f64) -> Self {
                // SAFETY: both are that many `f64`, for which every bit pattern is valid.
                $name(unsafe { core::mem::transmute::<[f64; $lanes], $raw>([x; $lanes]) })
            }
        }
    };
    (
        @ $method:ident $(<$P:ident: $bound:ident>)? ($($arguments:tt)*) -> $result:ty {
            $($body:tt)*
        }
    ) => {
        #[inline(always)]
        fn $method $(<$P: $bound>)? ($($arguments)*) -> $result {
            // SAFETY: as above.
            unsafe { $($body)* }
        }
    };
}

register! {
    /// Two numbers.
    Two: __m128d, 2 lanes, mask __m128d, has_avx2, with_avx2, pairs 4;
    _mm_loadu_pd _mm_storeu_pd _mm_set1_pd _mm_cvtsd_f64
    _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd
    _mm_fmadd_pd _mm_fmsub_pd _mm_fnmadd_pd _mm_and_pd _mm_xor_pd;
    shift_left |x| _mm_castsi128_pd(
        _mm_sll_epi64(_mm_castpd_si128(x), _mm_cvtsi32_si128(PLACES as i32))
    );
    is_odd |x| _mm_castsi128_pd(_mm_slli_epi64::<63>(_mm_castpd_si128(x)));
    compare _mm_cmp_pd;
    select |mask, yes, no| _mm_blendv_pd(no, yes, mask);
    mask_and _mm_and_pd;
    all |mask| _mm_movemask_pd(mask) == 0b11;
}

register! {
    /// Four numbers.
    Four: __m256d, 4 lanes, mask __m256d, has_avx2, with_avx2, pairs 4;
    _mm256_loadu_pd _mm256_storeu_pd _mm256_set1_pd _mm256_cvtsd_f64
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd
    _mm256_fmadd_pd _mm256_fmsub_pd _mm256_fnmadd_pd _mm256_and_pd _mm256_xor_pd;
    shift_left |x| _mm256_castsi256_pd(
        _mm256_sll_epi64(_mm256_castpd_si256(x), _mm_cvtsi32_si128(PLACES as i32))
    );
    is_odd |x| _mm256_castsi256_pd(_mm256_slli_epi64::<63>(_mm256_castpd_si256(x)));
    compare _mm256_cmp_pd;
    select |mask, yes, no| _mm256_blendv_pd(no, yes, mask);
    mask_and _mm256_and_pd;
    all |mask| _mm256_movemask_pd(mask) == 0b1111;
}

register! {
    /// Four numbers where AVX-512 provides 32 registers instead of 16. The arithmetic is the same, with fewer
    /// spills to memory.
    FourOfMany: __m256d, 4 lanes, mask __m256d, has_avx512, with_avx512, pairs 8;
    _mm256_loadu_pd _mm256_storeu_pd _mm256_set1_pd _mm256_cvtsd_f64
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd
    _mm256_fmadd_pd _mm256_fmsub_pd _mm256_fnmadd_pd _mm256_and_pd _mm256_xor_pd;
    shift_left |x| _mm256_castsi256_pd(
        _mm256_sll_epi64(_mm256_castpd_si256(x), _mm_cvtsi32_si128(PLACES as i32))
    );
    is_odd |x| _mm256_castsi256_pd(_mm256_slli_epi64::<63>(_mm256_castpd_si256(x)));
    compare _mm256_cmp_pd;
    select |mask, yes, no| _mm256_blendv_pd(no, yes, mask);
    mask_and _mm256_and_pd;
    all |mask| _mm256_movemask_pd(mask) == 0b1111;
}

register! {
    /// Eight numbers, of AVX-512.
    Eight: __m512d, 8 lanes, mask __mmask8, has_avx512, with_avx512, pairs 8;
    _mm512_loadu_pd _mm512_storeu_pd _mm512_set1_pd _mm512_cvtsd_f64
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd
    _mm512_fmadd_pd _mm512_fmsub_pd _mm512_fnmadd_pd _mm512_and_pd _mm512_xor_pd;
    shift_left |x| _mm512_castsi512_pd(_mm512_slli_epi64::<PLACES>(_mm512_castpd_si512(x)));
    is_odd |x| _mm512_movepi64_mask(_mm512_slli_epi64::<63>(_mm512_castpd_si512(x)));
    compare _mm512_cmp_pd_mask;
    select |mask, yes, no| _mm512_mask_blend_pd(mask, no, yes);
    mask_and _kand_mask8;
    all |mask| _kortestc_mask8_u8(mask, mask) == 1;
}

/// Eight numbers in two registers of four.
#[derive(Clone, Copy)]
pub struct TwiceFour(Four, Four);

impl Native for TwiceFour {
    #[inline(always)]
    fn is_here() -> bool {
        has_avx2()
    }
}

/// Operations on both halves.
macro_rules! both {
    ($($method:ident($($argument:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)*) -> Self {
            TwiceFour(self.0.$method($($argument.0),*), self.1.$method($($argument.1),*))
        }
    )*};
}

impl Vector for TwiceFour {
    type Stored = Lanes<8>;
    type Mask = (<Four as Vector>::Mask, <Four as Vector>::Mask);

    const ZERO: Self = TwiceFour(Four::ZERO, Four::ZERO);
    const ONE: Self = TwiceFour(Four::ONE, Four::ONE);
    const PAIRS_AT_ONCE: usize = 4;

    both!(
        add(b),
        sub(b),
        mul(b),
        div(b),
        mul_add(b, c),
        mul_sub(b, c),
        neg_mul_add(b, c),
        sqrt(),
        and(b),
        xor(b),
    );

    #[inline(always)]
    fn load(stored: Lanes<8>) -> Self {
        let [a, b, c, d, e, f, g, h] = stored.0;
        TwiceFour(
            Four::load(Lanes([a, b, c, d])),
            Four::load(Lanes([e, f, g, h])),
        )
    }
    #[inline(always)]
    fn store(self) -> Lanes<8> {
        let (Lanes([a, b, c, d]), Lanes([e, f, g, h])) = (self.0.store(), self.1.store());
        Lanes([a, b, c, d, e, f, g, h])
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        TwiceFour(Four::splat(x), Four::splat(x))
    }
    #[inline(always)]
    fn shift_left<const PLACES: u32>(self) -> Self {
        TwiceFour(self.0.shift_left::<PLACES>(), self.1.shift_left::<PLACES>())
    }
    #[inline(always)]
    fn is_odd(self) -> Self::Mask {
        (self.0.is_odd(), self.1.is_odd())
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        (self.0.less(other.0), self.1.less(other.1))
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self::Mask {
        (self.0.at_most(other.0), self.1.at_most(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        TwiceFour(
            Four::select(mask.0, yes.0, no.0),
            Four::select(mask.1, yes.1, no.1),
        )
    }
    #[inline(always)]
    fn mask_and(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        (Four::mask_and(a.0, b.0), Four::mask_and(a.1, b.1))
    }
    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        Four::all(mask.0) & Four::all(mask.1)
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        TwiceFour(self.0.map(&f), self.1.map(&f))
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        TwiceFour(self.0.zip(other.0, &f), self.1.zip(other.1, &f))
    }
    #[inline(always)]
    fn first(self) -> f64 {
        self.0.first()
    }
    #[inline(always)]
    fn call<P: Piece>(piece: P) -> P::Output {
        Four::call(piece)
    }
}

/// One number, whose angles are computed four at a time.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct One(f64);

impl Native for One {
    #[inline(always)]
    fn is_here() -> bool {
        has_avx2()
    }
}

/// Operations that are those of a plain number.
macro_rules! plain {
    ($($method:ident($($argument:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)*) -> Self {
            One(Vector::$method(self.0 $(, $argument.0)*))
        }
    )*};
}

/// Operations on two numbers at once. A compiler keeps a pair that is used as a pair in its register and removes the
/// moves written here.
macro_rules! in_one_register {
    ($($each:ident($($argument:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $each($($argument: [Self; 2]),*) -> [Self; 2] {
            $(let $argument = Two::of($argument);)*
            in_one_register!(@ $each $($argument),*).numbers()
        }
    )*};
    (@ add_each $a:ident, $b:ident) => { $a.add($b) };
    (@ sub_each $a:ident, $b:ident) => { $a.sub($b) };
    (@ mul_each $a:ident, $b:ident) => { $a.mul($b) };
    (@ div_each $a:ident, $b:ident) => { $a.div($b) };
    (@ mul_add_each $a:ident, $b:ident, $c:ident) => { $a.mul_add($b, $c) };
    (@ mul_sub_each $a:ident, $b:ident, $c:ident) => { $a.mul_sub($b, $c) };
    (@ neg_mul_add_each $a:ident, $b:ident, $c:ident) => { $a.neg_mul_add($b, $c) };
}

impl Two {
    #[inline(always)]
    fn of([first, second]: [One; 2]) -> Two {
        // SAFETY: as above.
        Two(unsafe { _mm_set_pd(second.0, first.0) })
    }

    #[inline(always)]
    fn numbers(self) -> [One; 2] {
        // SAFETY: as above.
        unsafe {
            let second = _mm_unpackhi_pd(self.0, self.0);
            [One(_mm_cvtsd_f64(self.0)), One(_mm_cvtsd_f64(second))]
        }
    }
}

impl Vector for One {
    type Stored = f64;
    type Mask = bool;

    const ZERO: Self = One(0.0);
    const ONE: Self = One(1.0);
    const PAIRS_AT_ONCE: usize = 0;

    plain!(
        add(b),
        sub(b),
        mul(b),
        div(b),
        mul_add(b, c),
        mul_sub(b, c),
        neg_mul_add(b, c),
        and(b),
        xor(b),
    );

    /// Not that of `libm`, which is written in instructions without the VEX prefix: among others with it, each of them waits until the
    /// upper halves of a register have been merged, some 150 ns.
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as above.
        One(unsafe {
            let x = _mm_set_sd(self.0);
            _mm_cvtsd_f64(_mm_sqrt_sd(x, x))
        })
    }

    in_one_register!(
        add_each(a, b),
        sub_each(a, b),
        mul_each(a, b),
        div_each(a, b),
        mul_add_each(a, b, c),
        mul_sub_each(a, b, c),
        neg_mul_add_each(a, b, c),
    );

    #[inline(always)]
    fn load(stored: f64) -> Self {
        One(stored)
    }
    #[inline(always)]
    fn store(self) -> f64 {
        self.0
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        One(x)
    }
    #[inline(always)]
    fn shift_left<const PLACES: u32>(self) -> Self {
        One(self.0.shift_left::<PLACES>())
    }
    #[inline(always)]
    fn is_odd(self) -> bool {
        self.0.is_odd()
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self.0 <= other.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn mask_and(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        One(f(self.0))
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        One(f(self.0, other.0))
    }
    #[inline(always)]
    fn first(self) -> f64 {
        self.0
    }
    #[inline(always)]
    fn call<P: Piece>(piece: P) -> P::Output {
        Four::call(piece)
    }
}

impl Sines for TwiceFour {
    #[inline(always)]
    fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self) {
        let first = Four::sin_cos_beyond(angle.0, sin.0, cos.0);
        let second = Four::sin_cos_beyond(angle.1, sin.1, cos.1);
        (TwiceFour(first.0, second.0), TwiceFour(first.1, second.1))
    }
}

impl Sines for One {
    #[inline(always)]
    fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self) {
        let (sin, cos) = Sines::sin_cos_beyond(angle.0, sin.0, cos.0);
        (One(sin), One(cos))
    }
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Register<One>; K]) -> Circular<One, K> {
        let mut all = [(Register(One::ZERO), Register(One::ONE)); K];
        // Straight-line code for as many angles as most states have, so that angles stay in registers; a loop for the rest.
        macro_rules! straight {
            ($($start:literal)*) => {$(
                if const { $start < K } {
                    four_sines(&angles, &mut all, $start);
                }
            )*};
        }
        straight!(0 4 8 12 16 20 24 28);
        let mut start = 32;
        while start < K {
            four_sines(&angles, &mut all, start);
            start += 4;
        }
        all
    }
    /// For a single number, an angle beyond the polynomials costs only its own sine.
    #[inline(always)]
    fn sin_cos_all_near<const K: usize>(angles: [Register<One>; K]) -> (Circular<One, K>, bool) {
        (Self::sin_cos_all(angles), true)
    }
    /// In whole registers, as they are read: a register that is read soon after its numbers were stored one by one waits until all of
    /// them have reached the cache. A series with few products is bound by its dependency chain, which this lengthened.
    #[inline(always)]
    fn store_all<const P: usize>(row: &mut [f64; P], numbers: [f64; P]) {
        macro_rules! registers {
            ($($start:literal)*) => {$(
                if const { $start + 4 <= P } {
                    store_four(row, &numbers, $start);
                }
            )*};
        }
        match const { P } {
            12 | 16 | 20 | 24 => {
                registers!(0 4 8 12 16 20);
            }
            _ => *row = numbers,
        }
    }
    /// Each register holds up to four of the lists side by side. A compiler left to vectorize this splits them.
    #[inline(always)]
    fn convolve_all<const P: usize>(a: &[[f64; P]], b: &[[f64; P]]) -> [Register<One>; P] {
        let mut sums = [Register(One::ZERO); P];
        match const { P } {
            2 => convolve::<__m128d, 1, P>(a, b, 0, &mut sums),
            4 => convolve::<__m256d, 1, P>(a, b, 0, &mut sums),
            8 => convolve::<__m256d, 2, P>(a, b, 0, &mut sums),
            12 => convolve::<__m256d, 3, P>(a, b, 0, &mut sums),
            16 => convolve::<__m256d, 4, P>(a, b, 0, &mut sums),
            20 => convolve::<__m256d, 5, P>(a, b, 0, &mut sums),
            24 => convolve::<__m256d, 6, P>(a, b, 0, &mut sums),
            _ => {
                let mut start = 0;
                while start + 4 <= P {
                    convolve::<__m256d, 1, P>(a, b, start, &mut sums);
                    start += 4;
                }
                while start < P {
                    convolve::<f64, 1, P>(a, b, start, &mut sums);
                    start += 1;
                }
            }
        }
        sums
    }
}

/// Sine and cosine of all numbers of a register.
#[inline(always)]
fn sin_cos<V: Sines>(x: V) -> (V, V) {
    let (sin, cos) = sin_cos_near(x);
    if V::all(is_near(x)) {
        (sin, cos)
    } else {
        V::sin_cos_beyond(x, sin, cos)
    }
}

/// Sines and cosines of up to four angles, starting at an index.
#[inline(always)]
fn four_sines<const K: usize>(
    angles: &[Register<One>; K],
    all: &mut Circular<One, K>,
    start: usize,
) {
    // A partly filled register is padded with 0.
    let angle = |i: usize| if i < K { angles[i].0.0 } else { 0.0 };
    let x = [
        angle(start),
        angle(start + 1),
        angle(start + 2),
        angle(start + 3),
    ];
    let (sin, cos) = if K - start > 2 {
        let (sin, cos) = sin_cos(Four::load(Lanes(x)));
        (sin.store().0, cos.store().0)
    } else {
        let (sin, cos) = sin_cos(Two::load(Lanes([x[0], x[1]])));
        let (Lanes([s0, s1]), Lanes([c0, c1])) = (sin.store(), cos.store());
        ([s0, s1, 0.0, 0.0], [c0, c1, 1.0, 1.0])
    };
    for (pair, (sin, cos)) in all.iter_mut().skip(start).zip(sin.into_iter().zip(cos)) {
        *pair = (Register(One(sin)), Register(One(cos)));
    }
}
