//! The methods of `System` in emitted machines: one arm for each kind of result.

/// A method of `System`, by the kind of its result.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_method {
    // A number.
    ($types:tt number $method:ident($($x:ident),*)) => {
        $crate::implement_method! { $types number $method($($x),*) = 0.0 }
    };
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        number $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*
        ) -> ::core::primitive::f64 {
            let $p = self;
            $value
        }
    };

    // One number for each coordinate.
    ([$n:literal $($types:tt)*] vector $method:ident($($x:ident),*)) => {
        $crate::implement_method! { [$n $($types)*] vector $method($($x),*) = [0.0; $n] }
    };
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        vector $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64; $n],
        ) {
            let $p = self;
            *result = $value;
        }
    };

    // A square matrix, row after row.
    ([$n:literal $($types:tt)*] matrix $method:ident($($x:ident),*)) => {
        $crate::implement_method! { [$n $($types)*] matrix $method($($x),*) = [[0.0; $n]; $n] }
    };
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        matrix $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64; $n * $n],
        ) {
            let $p = self;
            $crate::emitted::fill(result, $value.as_flattened());
        }
    };

    // Numbers, as many as fit into the slice.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        numbers $method:ident($p:ident $(, $x:ident)*) $(= $value:expr)?
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64],
        ) {
            let $p = self;
            result.fill(0.0);
            $($crate::emitted::fill(result, &$value);)?
        }
    };

    // Numbers from an elimination: an error if a pivot vanishes.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        solved $method:ident($p:ident $(, $x:ident)*) $(= $value:expr)?
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64],
        ) -> ::core::result::Result<(), $crate::emitted::Singular> {
            let $p = self;
            $($crate::emitted::fill(result, &$value?);)?
            ::core::result::Result::Ok(())
        }
    };

    // The same in place, by a call as a value, of a function that not every machine has: whether it is there.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        solved_in_place $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64],
        ) -> ::core::result::Result<::core::primitive::bool, $crate::emitted::Singular> {
            let $p = self;
            $crate::emitted::run_into($value, result)
        }
    };

    // The multipliers of a machine with guided contacts.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        with_friction $method:ident($p:ident $(, $x:ident)*)
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*,
            result: &mut [::core::primitive::f64],
        ) -> ::core::result::Result<(), $crate::emitted::Singular> {
            $crate::emitted::multipliers_with_friction(self $(, $x)*, result)
        }
    };

    // The outputs.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        outputs $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*
        ) -> $Outputs {
            let $p = self;
            $value
        }
    };

    // Assumptions: text, whether it is strict, its margin.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        facts $method:ident($p:ident $(, $x:ident)*) = $value:expr
    ) => {
        fn $method(
            &self $(, $x: $crate::implement_part!(argument $x $n $Inputs))*
        ) -> impl ::core::iter::ExactSizeIterator<Item = $crate::emitted::Assumption<'_>> {
            let $p = self;
            $crate::emitted::assumptions($value)
        }
    };

    // Whether assumptions hold within bounds: whether they are strict, and their margins. The arguments are those that they depend on.
    (
        [$n:literal $Inputs:ident $Outputs:ident] bounds $method:ident($($x:ident),*) = $value:expr
    ) => {
        fn $method(
            &self,
            t: [::core::primitive::f64; 2],
            q: [&[::core::primitive::f64; $n]; 2],
            v: [&[::core::primitive::f64; $n]; 2],
        ) -> ::core::primitive::bool {
            $(let $x = $crate::implement_part!(bounded $x t q v);)*
            $crate::emitted::hold($value)
        }
    };

    // Bilateral constraints: name, unit, unit of the multiplier, whether positions are constrained.
    ($types:tt constraints $method:ident($p:ident) = $value:expr) => {
        fn $method(
            &self,
        ) -> impl ::core::iter::ExactSizeIterator<Item = $crate::emitted::Constraint<'_>> {
            const ROWS: &[$crate::emitted::ConstraintRow] = &$value;
            ROWS.iter().map($crate::emitted::constraint)
        }
    };

    // Names.
    ($types:tt names $method:ident($p:ident) = $value:expr) => {
        fn $method(
            &self,
        ) -> impl ::core::iter::ExactSizeIterator<Item = &::core::primitive::str> {
            const NAMES: &[&::core::primitive::str] = &$value;
            NAMES.iter().copied()
        }
    };

    // A count.
    ($types:tt count $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> ::core::primitive::usize {
            $value
        }
    };

    // A bit for each of some things.
    ($types:tt bits $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> ::core::primitive::u64 {
            $value
        }
    };

    // Unilateral contacts.
    ($types:tt contacts $method:ident($p:ident) = $value:expr) => {
        fn $method(
            &self,
        ) -> impl ::core::iter::ExactSizeIterator<Item = $crate::emitted::UnilateralContact<'_>> {
            const CONTACTS: &[$crate::emitted::UnilateralContact<'static>] = &$value;
            CONTACTS.iter().copied()
        }
    };

    // What single contacts are computed by: for each coordinate and for the time whether a gap depends on it.
    ($types:tt gap_arguments $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> ::core::option::Option<&[::core::primitive::bool]> {
            const ARGUMENTS: &[::core::primitive::bool] = &$value;
            ::core::option::Option::Some(ARGUMENTS)
        }
    };

    // Numbers of single contacts, as a `ContactParts`.
    ([$n:literal $Inputs:ident $Outputs:ident] parts $method:ident($p:ident) = $value:expr) => {
        fn $method(
            &self,
            quantity: $crate::emitted::ContactQuantity,
            which: &[::core::primitive::usize],
            (t, q, v): (
                ::core::primitive::f64,
                &[::core::primitive::f64; $n],
                &[::core::primitive::f64; $n],
            ),
            numbers: &mut [::core::primitive::f64],
        ) {
            let $p = self;
            $value.write(quantity, which, (t, q, v), numbers);
        }
    };

    // Lower bounds of gaps, by a `ContactParts` in intervals; prepared values are an argument where gaps depend on them.
    (
        [$n:literal $Inputs:ident $Outputs:ident] least $method:ident($($x:ident),*) = $value:expr
    ) => {
        fn $method(
            &self,
            t: [::core::primitive::f64; 2],
            q: [&[::core::primitive::f64; $n]; 2],
            result: &mut [::core::primitive::f64],
        ) {
            let t = $crate::scalar::Interval::new(t[0], t[1]);
            let q = $crate::emitted::intervals(q);
            $(let $x = $crate::implement_part!(between $x self);)*
            $value.write_least_gaps((t, &q), result);
        }
    };

    // The ranges of the slips; the arguments are those that the slips depend on.
    (
        [$n:literal $Inputs:ident $Outputs:ident] ranges $method:ident($($x:ident),*) = $value:expr
    ) => {
        fn $method(
            &self,
            t: ::core::primitive::f64,
            q: &[::core::primitive::f64; $n],
            v: &[::core::primitive::f64; $n],
            result: &mut [[::core::primitive::f64; 2]],
        ) {
            $(let $x = $crate::implement_part!(rounded $x self t q v);)*
            $crate::emitted::fill_ranges(result, &$value);
        }
    };

    // A workspace with this length.
    ($types:tt workspace $method:ident($p:ident) = $length:expr) => {
        fn $method<R>(
            &self,
            length: ::core::primitive::usize,
            work: impl ::core::ops::FnOnce(
                ::core::option::Option<&mut [::core::primitive::f64]>,
            ) -> R,
        ) -> R {
            let mut workspace = [0.0; $length];
            work(workspace.get_mut(..length))
        }
    };

    // The Taylor series of the motion, with a call as a value.
    (
        $types:tt
        series $method:ident($p:ident, $t:ident, $q:ident, $v:ident, $u:ident, $coefficients:ident)
            = $value:expr
    ) => {
        $crate::implement_method! {
            $types expansion $method($p, $t, $q, $v, $u, $coefficients) [] = $value
        }
    };

    // A Taylor series that writes lists which need not be cleared: with lists of its own, and with those that the caller keeps.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        series_in_lists $method:ident(
            $p:ident, $t:ident, $q:ident, $v:ident, $u:ident, $lists:ident, $coefficients:ident
        ) = $value:expr
    ) => {
        $crate::implement_method! {
            [$n $Inputs $Outputs] expansion $method($p, $t, $q, $v, $u, $coefficients) [$lists] = $value
        }

        fn series_with(
            &self,
            memory: &mut $crate::emitted::series::SeriesMemory,
            $t: [::core::primitive::f64; 2],
            ($q, $v): (
                &[::core::primitive::f64; $n],
                &[::core::primitive::f64; $n],
            ),
            $u: &$Inputs,
            $coefficients: &mut [[::core::primitive::f64; $n]],
        ) -> ::core::result::Result<(), $crate::emitted::Singular> {
            let $p = self;
            let ::core::option::Option::Some($lists) = memory.lists() else {
                return $p.$method($t, $q, $v, $u, $coefficients);
            };
            $crate::emitted::series::leave_out_late_rows($coefficients);
            <::core::primitive::f64 as $crate::emitted::Number>::run($value)
        }
    };

    // What every machine with a Taylor series has, with lists that are made for a call if it needs any.
    (
        [$n:literal $Inputs:ident $Outputs:ident]
        expansion $method:ident($p:ident, $t:ident, $q:ident, $v:ident, $u:ident, $coefficients:ident)
            [$($lists:ident)?] = $value:expr
    ) => {
        fn check_series(&self) -> ::core::result::Result<(), &::core::primitive::str> {
            ::core::result::Result::Ok(())
        }

        fn $method(
            &self,
            $t: [::core::primitive::f64; 2],
            $q: &[::core::primitive::f64; $n],
            $v: &[::core::primitive::f64; $n],
            $u: &$Inputs,
            $coefficients: &mut [[::core::primitive::f64; $n]],
        ) -> ::core::result::Result<(), $crate::emitted::Singular> {
            let $p = self;
            $crate::emitted::series::leave_out_late_rows($coefficients);
            $(let $lists = &mut ::core::default::Default::default();)?
            <::core::primitive::f64 as $crate::emitted::Number>::run($value)
        }
    };

    // The costs of a step by the series, in evaluations of the accelerations.
    ($types:tt costs $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> ::core::option::Option<[::core::primitive::f64; 2]> {
            ::core::option::Option::Some($value)
        }
    };

    // What powers add to these costs.
    ($types:tt more $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> [::core::primitive::f64; 3] {
            $value
        }
    };

    // A boolean.
    ($types:tt boolean $method:ident($p:ident) = $value:expr) => {
        fn $method(&self) -> ::core::primitive::bool {
            $value
        }
    };
}
