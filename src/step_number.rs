//! The numbers in which explicit methods take steps.

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

use lagrangian_native::{Lanes, Number};
use lagrangian_scalar::{DoubleDouble, Dual, Scalar};

/// The numbers in which a machine can be run by an [`ExplicitStepper`](crate::ExplicitStepper): `f32`, `f64`,
/// [`DoubleDouble`], and [`Dual`] numbers of these.
pub trait Real: Number + Scalar<Stored = Self> + StepNumber {}

impl<N: Number + Scalar<Stored = N> + StepNumber> Real for N {}

/// The operations on numbers that a step needs: `f32`, `f64`, [`DoubleDouble`], [`Dual`] numbers of these, and [`Lanes`], which
/// hold several trajectories side by side.
///
/// The length of a step and its acceptance are decided in `f64`, for each trajectory separately.
pub trait StepNumber:
    sealed::Sealed
    + Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// One `T` for each trajectory.
    type Each<T: Copy + Debug>: Copy + Debug + AsRef<[T]> + AsMut<[T]>;

    /// 0.
    const NOTHING: Self;
    /// The number of numbers in one whose errors count: 2 in a dual number.
    const PARTS: usize;
    /// Whether it has more digits than `f64`, so that coefficients of methods need more as well.
    const IS_WIDE: bool;
    /// The distance from 1 to the next larger number.
    const EPSILON: f64;
    /// The length below which a step is too small, in s.
    const LEAST_STEP: f64;
    /// The default tolerance.
    const TOLERANCE: f64;

    /// One value for each trajectory.
    fn each<T: Copy + Debug>(of: impl FnMut(usize) -> T) -> Self::Each<T>;
    /// A number from `f64`, one for each trajectory.
    fn gather(numbers: Self::Each<f64>) -> Self;
    /// The nearest `f64`, for each trajectory.
    fn rounded(self) -> Self::Each<f64>;
    /// `self` times a coefficient of a method, which is the sum of an `f64` and its remainder.
    fn weighted(self, coefficient: f64, beyond: f64) -> Self;
    /// For each trajectory, whether it is finite.
    fn are_finite(self) -> Self::Each<bool>;
    /// For each trajectory, whether two numbers are the same.
    fn are_same(self, other: Self) -> Self::Each<bool>;
    /// `self` where `condition` holds, otherwise `other`.
    fn where_true(self, condition: &Self::Each<bool>, other: Self) -> Self;
    /// For each trajectory the squares of these errors, relative to the tolerance for a number whose values at the two ends of a
    /// step are `sizes`: `absolute + relative |y|`. For a dual number, the sums of the squares for the value and for the derivative.
    fn squared_errors<const K: usize>(
        errors: [Self; K],
        sizes: [Self; 2],
        absolute: Self,
        relative: f64,
    ) -> [Self::Each<f64>; K];
}

mod sealed {
    use super::{DoubleDouble, Dual, Lanes};

    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for DoubleDouble {}
    impl<N: Sealed> Sealed for Dual<N> {}
    impl<const W: usize> Sealed for Lanes<W> {}
}

/// The tolerable error of a number.
#[inline(always)]
fn tolerable([before, now]: [f64; 2], absolute: f64, relative: f64) -> f64 {
    let (before, now) = (before.abs(), now.abs());
    // Not `max`, which costs more because it ignores NaN.
    let size = if before > now { before } else { now };
    absolute + relative * size
}

/// The items that are the same for all numbers with one trajectory.
macro_rules! one_trajectory {
    () => {
        type Each<T: Copy + Debug> = [T; 1];

        const NOTHING: Self = <Self as Scalar>::ZERO;

        #[inline(always)]
        fn each<T: Copy + Debug>(mut of: impl FnMut(usize) -> T) -> [T; 1] {
            [of(0)]
        }

        #[inline(always)]
        fn gather([number]: [f64; 1]) -> Self {
            Self::from_f64(number)
        }

        #[inline(always)]
        fn rounded(self) -> [f64; 1] {
            [self.to_f64()]
        }

        #[inline(always)]
        fn are_finite(self) -> [bool; 1] {
            [Scalar::is_finite(self)]
        }

        #[inline(always)]
        fn are_same(self, other: Self) -> [bool; 1] {
            [self == other]
        }

        #[inline(always)]
        fn where_true(self, &[condition]: &[bool; 1], other: Self) -> Self {
            if condition { self } else { other }
        }
    };
}

/// Implements `StepNumber` for numbers whose errors are measured in `f64`.
macro_rules! simple {
    ($($number:ty: $is_wide:literal, $epsilon:expr, $least:literal, $tolerance:literal, |$of:ident, $coefficient:ident, $beyond:ident| $weighted:expr;)*) => {$(
        impl StepNumber for $number {
            one_trajectory!();
            const PARTS: usize = 1;
            const IS_WIDE: bool = $is_wide;
            const EPSILON: f64 = $epsilon;
            const LEAST_STEP: f64 = $least;
            const TOLERANCE: f64 = $tolerance;

            #[inline(always)]
            fn weighted(self, $coefficient: f64, $beyond: f64) -> Self {
                let $of = self;
                $weighted
            }

            #[inline(always)]
            fn squared_errors<const K: usize>(
                errors: [Self; K],
                sizes: [Self; 2],
                absolute: Self,
                relative: f64,
            ) -> [[f64; 1]; K] {
                let sizes = sizes.map(Self::to_f64);
                let tolerable = tolerable(sizes, absolute.to_f64(), relative);
                errors.map(|error| {
                    let error = error.to_f64() / tolerable;
                    [error * error]
                })
            }
        }
    )*};
}

simple! {
    f32: false, f32::EPSILON as f64, 1e-36, 1e-5, |x, coefficient, _beyond| coefficient as f32 * x;
    f64: false, f64::EPSILON, 1e-290, 1e-9, |x, coefficient, _beyond| coefficient * x;
    // The sum of two has an error of at most 2⁻¹⁰⁴.
    DoubleDouble: true, f64::EPSILON * f64::EPSILON, 1e-260, 1e-24,
        |x, coefficient, beyond| (Self::from_f64(coefficient) + Self::from_f64(beyond)) * x;
}

/// The derivative of a run is that of its steps with their lengths held fixed. So it is exact, to rounding, as the derivative of
/// the computed result, and its error is controlled like that of the run.
impl<N: Scalar + StepNumber<Each<f64> = [f64; 1]>> StepNumber for Dual<N> {
    one_trajectory!();
    const PARTS: usize = 2 * N::PARTS;
    const IS_WIDE: bool = N::IS_WIDE;
    const EPSILON: f64 = N::EPSILON;
    const LEAST_STEP: f64 = N::LEAST_STEP;
    const TOLERANCE: f64 = N::TOLERANCE;

    #[inline(always)]
    fn weighted(self, coefficient: f64, beyond: f64) -> Self {
        Self {
            value: self.value.weighted(coefficient, beyond),
            derivative: self.derivative.weighted(coefficient, beyond),
        }
    }

    #[inline(always)]
    fn squared_errors<const K: usize>(
        errors: [Self; K],
        sizes: [Self; 2],
        absolute: Self,
        relative: f64,
    ) -> [[f64; 1]; K] {
        // The tolerance does not depend on the variable: the derivative has the tolerance of the value.
        let [mut squares, derivatives] =
            [|of: Self| of.value, |of: Self| of.derivative].map(|part| {
                N::squared_errors(errors.map(part), sizes.map(part), absolute.value, relative)
            });
        for ([square], [derivative]) in squares.iter_mut().zip(derivatives) {
            *square += derivative;
        }
        squares
    }
}

// Loops and no closures, since functions that are called for each lane are not inlined into code for wide registers.
impl<const W: usize> StepNumber for Lanes<W> {
    type Each<T: Copy + Debug> = [T; W];

    const NOTHING: Self = Lanes::splat(0.0);
    const PARTS: usize = 1;
    const IS_WIDE: bool = false;
    const EPSILON: f64 = f64::EPSILON;
    const LEAST_STEP: f64 = 1e-290;
    const TOLERANCE: f64 = 1e-9;

    #[inline(always)]
    fn each<T: Copy + Debug>(mut of: impl FnMut(usize) -> T) -> [T; W] {
        let mut each = [of(0); W];
        for (lane, one) in each.iter_mut().enumerate().skip(1) {
            *one = of(lane);
        }
        each
    }

    #[inline(always)]
    fn gather(numbers: [f64; W]) -> Self {
        Lanes(numbers)
    }

    #[inline(always)]
    fn rounded(self) -> [f64; W] {
        self.0
    }

    #[inline(always)]
    fn weighted(self, coefficient: f64, _beyond: f64) -> Self {
        let mut product = self;
        for lane in &mut product.0 {
            *lane *= coefficient;
        }
        product
    }

    #[inline(always)]
    fn are_finite(self) -> [bool; W] {
        let mut finite = [false; W];
        for (finite, lane) in finite.iter_mut().zip(&self.0) {
            *finite = lane.is_finite();
        }
        finite
    }

    #[inline(always)]
    fn are_same(self, other: Self) -> [bool; W] {
        let mut same = [false; W];
        for (same, (one, other)) in same.iter_mut().zip(self.0.iter().zip(&other.0)) {
            *same = one == other;
        }
        same
    }

    #[inline(always)]
    fn where_true(self, condition: &[bool; W], other: Self) -> Self {
        let mut chosen = other;
        for ((chosen, one), condition) in chosen.0.iter_mut().zip(self.0).zip(condition) {
            *chosen = if *condition { one } else { *chosen };
        }
        chosen
    }

    #[inline(always)]
    fn squared_errors<const K: usize>(
        errors: [Self; K],
        [before, now]: [Self; 2],
        absolute: Self,
        relative: f64,
    ) -> [[f64; W]; K] {
        let mut scale = [0.0; W];
        for (lane, scale) in scale.iter_mut().enumerate() {
            let sizes = [before.0[lane], now.0[lane]];
            *scale = tolerable(sizes, absolute.0[lane], relative);
        }
        let mut squares = [[0.0; W]; K];
        for (squares, error) in squares.iter_mut().zip(errors) {
            for ((square, error), scale) in squares.iter_mut().zip(error.0).zip(scale) {
                let error = error / scale;
                *square = error * error;
            }
        }
        squares
    }
}
