//! Functions that compiled code calls: sines and cosines, and functions without an instruction.

use lagrangian_native::{Lanes, Number};
use lagrangian_scalar::{Kernel, Scalar};
use lagrangian_symbolic::Function as Named;

use super::lower::{Arithmetic, CallKind};

/// A function on numbers in memory: the address of the arguments, that of the results, and the number of arguments, each
/// as long as a register.
type External = unsafe extern "sysv64" fn(*const f64, *mut f64, u32);

/// The address of the function for this number of lanes and arguments; `None` for what is written in line.
pub fn address(
    kind: CallKind,
    arithmetic: Arithmetic,
    lanes: usize,
    arguments: usize,
) -> Option<usize> {
    let function: External = match (kind, lanes) {
        (CallKind::Circular, 4) if arithmetic == Arithmetic::Fused => rows::<4>,
        (CallKind::Circular, 8) if arithmetic == Arithmetic::Fused => rows::<8>,
        (CallKind::Circular, _) if arithmetic == Arithmetic::Fused => {
            const FEW: [External; 8] = [
                few::<1>, few::<2>, few::<3>, few::<4>, few::<5>, few::<6>, few::<7>, few::<8>,
            ];
            match arguments.checked_sub(1).and_then(|index| FEW.get(index)) {
                Some(few) => *few,
                None => many,
            }
        }
        (CallKind::Circular, 4) => plain_sines::<4>,
        (CallKind::Circular, 8) => plain_sines::<8>,
        (CallKind::Circular, _) => plain_sines::<1>,
        (CallKind::Named(function), 4) => named::<4>(function),
        (CallKind::Named(function), 8) => named::<8>(function),
        (CallKind::Named(function), _) => named::<1>(function),
        (CallKind::Matrix(_), _) => return None,
    };
    Some(function as usize)
}

/// Sines and cosines of up to eight angles of one state. Angles are loaded one by one: a wide load of numbers that were
/// just stored separately defeats store forwarding and takes 20 to 30 ns longer.
///
/// # Safety
/// `from` must hold K angles, and `to` must have space for 2K results.
unsafe extern "sysv64" fn few<const K: usize>(from: *const f64, to: *mut f64, _: u32) {
    f64::run(Few::<K> { from, to });
}

/// At most two registers large, so that it is passed in registers to the function compiled for the processor.
struct Few<const K: usize> {
    from: *const f64,
    to: *mut f64,
}

impl<const K: usize> Kernel<f64> for Few<K> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) {
        let mut angles = [N::ZERO; K];
        for (index, angle) in angles.iter_mut().enumerate() {
            // SAFETY: the caller of `few` guarantees K angles. Volatile, because the compiler would merge the loads.
            *angle = N::load(unsafe { self.from.add(index).read_volatile() });
        }
        let all = N::sin_cos_all(angles);
        for (index, (sin, cos)) in all.into_iter().enumerate() {
            // SAFETY: the caller of `few` guarantees space for K sines followed by K cosines.
            unsafe {
                self.to.add(index).write(sin.store());
                self.to.add(K + index).write(cos.store());
            }
        }
    }
}

/// Sines and cosines of many angles of one state, eight at a time.
///
/// # Safety
/// `from` must hold `count` angles, and `to` must have space for twice as many results.
unsafe extern "sysv64" fn many(from: *const f64, to: *mut f64, count: u32) {
    let count = count as usize;
    // SAFETY: guaranteed by the caller; results are stored after the angles.
    let (angles, results) = unsafe {
        (
            std::slice::from_raw_parts(from, count),
            std::slice::from_raw_parts_mut(to, 2 * count),
        )
    };
    let (sines, cosines) = results.split_at_mut(count);
    Lanes::<8>::run(Many {
        angles,
        sines,
        cosines,
    });
}

struct Many<'a> {
    angles: &'a [f64],
    sines: &'a mut [f64],
    cosines: &'a mut [f64],
}

impl Kernel<Lanes<8>> for Many<'_> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = Lanes<8>>>(self) {
        let (angles, rest) = self.angles.as_chunks::<8>();
        let (sines, last_sines) = self.sines.as_chunks_mut::<8>();
        let (cosines, last_cosines) = self.cosines.as_chunks_mut::<8>();
        let wholes = sines.iter_mut().zip(cosines);
        for (eight, (sines, cosines)) in angles.iter().zip(wholes) {
            let (sin, cos) = N::load(Lanes(*eight)).sin_cos();
            *sines = sin.store().0;
            *cosines = cos.store().0;
        }
        if !rest.is_empty() {
            let mut eight = [0.0; 8];
            for (angle, own) in eight.iter_mut().zip(rest) {
                *angle = *own;
            }
            let (sin, cos) = N::load(Lanes(eight)).sin_cos();
            let pairs = sin.store().0.into_iter().zip(cos.store().0);
            let places = last_sines.iter_mut().zip(last_cosines);
            for ((sine, cosine), (sin, cos)) in places.zip(pairs) {
                *sine = sin;
                *cosine = cos;
            }
        }
    }
}

/// Sines and cosines of the angles of several states.
///
/// # Safety
/// `from` must hold `count` rows of angles, and `to` must have space for twice as many results, at addresses with
/// the alignment of rows.
unsafe extern "sysv64" fn rows<const N: usize>(from: *const f64, to: *mut f64, count: u32)
where
    Lanes<N>: Number,
{
    let count = count as usize;
    // SAFETY: guaranteed by the caller; results are stored after the angles.
    let (angles, results) = unsafe {
        (
            std::slice::from_raw_parts(from.cast::<Lanes<N>>(), count),
            std::slice::from_raw_parts_mut(to.cast::<Lanes<N>>(), 2 * count),
        )
    };
    let (sines, cosines) = results.split_at_mut(count);
    Lanes::<N>::run(Rows {
        angles,
        sines,
        cosines,
    });
}

struct Rows<'a, const N: usize> {
    angles: &'a [Lanes<N>],
    sines: &'a mut [Lanes<N>],
    cosines: &'a mut [Lanes<N>],
}

/// How many angles are tested together for being small.
const AT_ONCE: usize = 4;

impl<const L: usize> Kernel<Lanes<L>> for Rows<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = Lanes<L>>>(self) {
        let (angles, rest) = self.angles.as_chunks::<AT_ONCE>();
        let (sines, last_sines) = self.sines.as_chunks_mut::<AT_ONCE>();
        let (cosines, last_cosines) = self.cosines.as_chunks_mut::<AT_ONCE>();
        let wholes = sines.iter_mut().zip(cosines);
        for (angles, (sines, cosines)) in angles.iter().zip(wholes) {
            together::<N, AT_ONCE, L>(*angles, sines, cosines);
        }
        match *rest {
            [a] => together::<N, 1, L>([a], last_sines, last_cosines),
            [a, b] => together::<N, 2, L>([a, b], last_sines, last_cosines),
            [a, b, c] => together::<N, 3, L>([a, b, c], last_sines, last_cosines),
            _ => {}
        }
    }
}

/// Sines and cosines of K angles, with one test for whether all are small.
#[inline(always)]
fn together<N: Scalar<Stored = Lanes<L>>, const K: usize, const L: usize>(
    angles: [Lanes<L>; K],
    sines: &mut [Lanes<L>],
    cosines: &mut [Lanes<L>],
) {
    let mut loaded = [N::ZERO; K];
    for (to, angle) in loaded.iter_mut().zip(angles) {
        *to = N::load(angle);
    }
    let places = sines.iter_mut().zip(cosines);
    for ((sin, cos), (sine, cosine)) in N::sin_cos_all(loaded).into_iter().zip(places) {
        *sine = sin.store();
        *cosine = cos.store();
    }
}

/// Sines and cosines of `libm`.
///
/// # Safety
/// `from` must hold `count` rows of L angles, and `to` must have space for twice as many results.
unsafe extern "sysv64" fn plain_sines<const L: usize>(from: *const f64, to: *mut f64, count: u32) {
    let count = L * count as usize;
    for index in 0..count {
        // SAFETY: guaranteed by the caller.
        unsafe {
            let (sin, cos) = Scalar::sin_cos(from.add(index).read());
            to.add(index).write(sin);
            to.add(count + index).write(cos);
        }
    }
}

/// A function applied to each number of a row, or of two rows if it has two arguments.
fn named<const L: usize>(function: Named) -> External {
    macro_rules! one {
        ($method:ident) => {{
            /// # Safety
            /// `from` must hold a row, and `to` must have space for a row.
            unsafe extern "sysv64" fn each<const L: usize>(from: *const f64, to: *mut f64, _: u32) {
                for lane in 0..L {
                    // SAFETY: guaranteed by the caller.
                    unsafe { to.add(lane).write(Scalar::$method(from.add(lane).read())) };
                }
            }
            each::<L>
        }};
    }
    macro_rules! two {
        ($method:ident) => {{
            /// # Safety
            /// `from` must hold two rows, and `to` must have space for a row.
            unsafe extern "sysv64" fn each<const L: usize>(from: *const f64, to: *mut f64, _: u32) {
                for lane in 0..L {
                    // SAFETY: guaranteed by the caller.
                    unsafe {
                        let (a, b) = (from.add(lane).read(), from.add(L + lane).read());
                        to.add(lane).write(Scalar::$method(a, b));
                    }
                }
            }
            each::<L>
        }};
    }
    match function {
        Named::Sin => one!(sin),
        Named::Cos => one!(cos),
        Named::Tan => one!(tan),
        Named::Asin => one!(asin),
        Named::Acos => one!(acos),
        Named::Atan => one!(atan),
        Named::Sinh => one!(sinh),
        Named::Cosh => one!(cosh),
        Named::Tanh => one!(tanh),
        Named::Exp => one!(exp),
        Named::Ln => one!(ln),
        Named::Sqrt => one!(sqrt),
        Named::Abs => one!(abs),
        Named::Sign => one!(sign),
        Named::Atan2 => two!(atan2),
        Named::Min => two!(min),
        Named::Max => two!(max),
        Named::Pow => two!(powf),
    }
}
