//! The parts of a fast function that do not depend on what it computes: its call as a value, the implementation of
//! [`Kernel`](crate::scalar::Kernel) for this value, and the public function that chooses the arithmetic.
//!
//! ```text
//! fast_function! {
//!     /// Documentation of `accelerations`.
//!     pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 2] })
//!         -> [S; 2] = accelerations_in;
//! }
//!
//! #[inline(always)]
//! fn accelerations_in<S: Copy, N: Scalar<Stored = S>>(call: Accelerations<'_, S>) -> [S; 2] {
//!     let Accelerations { p, q } = call;
//!     …
//! }
//! ```
//!
//! The code itself is a function of its own, generic over the numbers `N` in registers. Without arguments, `(Accelerations)`, the
//! call only says which numbers it is for. If callers choose the arithmetic themselves, `pub struct Series<'a, S> { … } -> …`
//! takes the place of the public function.

/// Defines a function that is called often: see the documentation of `src/fast_function.rs`.
#[doc(hidden)]
#[macro_export]
macro_rules! fast_function {
    (
        $(#[$docs:meta])*
        pub fn $name:ident<$($a:lifetime,)? $S:ident>($Call:ident { $($x:ident: $Type:ty),+ $(,)? })
            -> $Result:ty = $code:ident;
    ) => {
        $(#[$docs])*
        pub fn $name<$($a,)? $S: $crate::Number>($($x: $Type),+) -> $Result {
            <$S as $crate::Number>::run($Call { $($x),+ })
        }

        $crate::fast_function! {
            #[doc = ::core::concat!("A call of [`", ::core::stringify!($name), "`].")]
            pub struct $Call<$($a,)? $S> { $($x: $Type),+ } -> $Result = $code;
        }
    };

    (
        $(#[$docs:meta])*
        pub fn $name:ident<$S:ident>($Call:ident) -> $Result:ty = $code:ident;
    ) => {
        $(#[$docs])*
        pub fn $name<$S: $crate::Number>() -> $Result {
            <$S as $crate::Number>::run($Call(::core::marker::PhantomData::<$S>))
        }

        #[doc = ::core::concat!("A call of [`", ::core::stringify!($name), "`].")]
        pub struct $Call<$S>(::core::marker::PhantomData<$S>);

        impl<$S: ::core::marker::Copy> $crate::scalar::Kernel<$S> for $Call<$S> {
            type Output = $Result;

            #[inline(always)]
            fn run<Register: $crate::scalar::Scalar<Stored = $S>>(self) -> $Result {
                $code::<$S, Register>(self)
            }
        }
    };

    (
        $(#[$docs:meta])*
        pub struct $Call:ident<$($a:lifetime,)? $S:ident> { $($x:ident: $Type:ty),+ $(,)? }
            -> $Result:ty = $code:ident;
    ) => {
        $(#[$docs])*
        ///
        /// It is run with whatever instructions the processor has.
        pub struct $Call<$($a,)? $S> {
            $(
                #[doc = ::core::concat!("The argument `", ::core::stringify!($x), "`.")]
                pub $x: $Type,
            )+
        }

        impl<$($a,)? $S: ::core::marker::Copy> $crate::scalar::Kernel<$S> for $Call<$($a,)? $S> {
            type Output = $Result;

            #[inline(always)]
            fn run<Register: $crate::scalar::Scalar<Stored = $S>>(self) -> $Result {
                $code::<$S, Register>(self)
            }
        }
    };
}
