//! The parts that all emitted machines share, as one macro: conversions between names and rows of numbers, and the implementations
//! of the traits of machines.
//!
//! ```text
//! machine Pendulum "Pendulum" over S, R;          its struct, its name, and letters for types of numbers
//! parameters { m, l } [                           its fields, and a row for each number:
//!     m: "m" "kg" = 1.0;                          variable, name, unit, default
//!     l: "l" "m" = 1.0;
//! ]
//! coordinates 1 Coordinates { theta } […]         how many; fields and rows without defaults
//! inputs Inputs { u } […] over S                  `over S` where there are any
//! outputs Outputs { force } […]                   without any, `Outputs {} [], defined here` if there is no struct yet
//! prepared Prepared { k0, k1 }                    its fields
//! series series                                   the field for Taylor series, where there is one
//! singular singular                               the field that says whether the parameters are singular, where they can be
//! accelerations { (p, t, q, v, u) Accelerations { p, q } }    a call as a value; or `none`, or `friction`
//! system {
//!     costs series_cost(p) = [6.4, 9.6];              with a series, the costs of its steps
//!     more powers_cost(p) = [0.2, 3.1, 4.2];          and, with work or losses, what these add to an evaluation and to steps
//!     number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);   a method of `System`: what it gives, what it is
//!     vector bias(p, t, q, v);                                    given, and the call; zeros where there is no call
//! }
//! absent [MAY_SLIDE]                              constants of `System` that are `false`
//! intervals [yes]                                 where slips, or bounds of gaps, depend on prepared values, whose rounding counts then
//! batch_series {                                  the series in lanes, where there is one: the type of what it keeps, and the call
//!     Lists<Lanes<N>>;
//!     (p, t, q, v, u, lists, coefficients) Series { p, q, v, lists, coefficients }
//! }
//! lanes [N]                                       a letter for the number of lanes, where there is `Batched`
//! numbers [yes]                                   where there are `MachineIn` and `SystemIn`
//! ```
//!
//! Fields are written as in a pattern, `{ m, length: [length_1, length_2] }`, which is also an expression, so the same tokens
//! destructure and construct the struct. The emitter chooses all names, since it knows the name of the machine; everything else has
//! its full path, since a machine may be called `Result` or `f64`.

mod method;

/// Implements the traits of a machine: see the module documentation of `src/emitted/implement.rs`.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_machine {
    (
        machine $Machine:ident $name:literal over $S:ident, $R:ident;
        parameters $parameters:tt $parameter_rows:tt
        coordinates $n:literal $Coordinates:ident $coordinates:tt $coordinate_rows:tt
        inputs $Inputs:ident $inputs:tt $input_rows:tt $(over $Over:ident)? $(, defined $inputs_here:ident)?
        outputs $Outputs:ident $outputs:tt $output_rows:tt $(, defined $outputs_here:ident)?
        prepared $Prepared:ident { $($field:ident),* $(,)? }
        $(series $series:ident)?
        $(singular $singular:ident)?
        accelerations $accelerations:tt
        system { $($kind:ident $method:ident($($argument:ident),*) $(= $value:expr)?;)* }
        absent [$($absent:ident)*]
        intervals $intervals:tt
        $(batch_series $batch_series:tt)?
        lanes $lanes:tt
        numbers $numbers:tt
    ) => {
        $crate::implement_part! { default $Machine $parameters $parameter_rows }
        $crate::implement_part! { map $Machine $parameters $parameter_rows $S $R }
        $crate::implement_part! { rows $n $Coordinates $coordinates $coordinate_rows $S }
        $crate::implement_part! { map $Coordinates $coordinates $coordinate_rows $S $R }
        $($crate::implement_part! {
            $inputs_here $Inputs "The inputs of a machine that has none."
        })?
        $($crate::implement_part! {
            $outputs_here $Outputs "The outputs of a machine that has none."
        })?
        $(
            $crate::implement_part! { default $Inputs $inputs $input_rows }
            $crate::implement_part! { map $Inputs $inputs $input_rows $Over $R }
        )?
        $crate::implement_part! {
            machine $Machine $name $parameters $parameter_rows $Prepared $Coordinates
        }

        #[allow(unused_variables)]
        impl $crate::emitted::System for $Prepared {
            type Vector = [::core::primitive::f64; $n];
            type Matrix = [::core::primitive::f64; $n * $n];
            type Coordinates = $Coordinates;
            type Inputs = $Inputs;
            type Outputs = $Outputs;
            $(const $absent: ::core::primitive::bool = false;)*

            $crate::implement_part! {
                coordinates $coordinate_rows [::core::primitive::f64; $n], $Coordinates
            }

            fn accelerations(
                &self,
                t: ::core::primitive::f64,
                q: &[::core::primitive::f64; $n],
                v: &[::core::primitive::f64; $n],
                u: &$Inputs,
                result: &mut [::core::primitive::f64; $n],
            ) -> ::core::result::Result<(), $crate::emitted::Singular> {
                $crate::implement_part! {
                    accelerations $accelerations [::core::primitive::f64] [0.0; $n] (self, t, q, v, u) result
                }
            }

            fn default_inputs(&self) -> $Inputs {
                <$Inputs as ::core::default::Default>::default()
            }

            $crate::implement_part! { values input_values $Inputs $inputs $input_rows }
            $crate::implement_part! { values output_values $Outputs $outputs $output_rows }
            $($crate::implement_method! {
                [$n $Inputs $Outputs] $kind $method($($argument),*) $(= $value)?
            })*
        }

        $crate::implement_intervals! { $intervals $Prepared { $($field,)* $($series,)? $($singular,)? } }
        $crate::implement_lanes! {
            $lanes $n $Prepared { $($field,)* $($series,)? $($singular,)? } [$($singular)?]
            $Inputs $inputs $input_rows [$($Over)?] $accelerations [$($batch_series)?]
        }
        $crate::implement_numbers! {
            $numbers $S $n $Machine $Prepared $Coordinates $coordinate_rows
            $Inputs $inputs $input_rows [$($Over)?] $accelerations
        }
    };
}

/// Implements `Charted` for a machine that has a second chart: its fields, which are those of the machine in Cartesian coordinates too,
/// and for each point the indices of its distance and its angle.
///
/// ```text
/// machine Particle { m, kx, ky } in cartesian::Particle;
/// points [[0, 1]]
/// ```
#[doc(hidden)]
#[macro_export]
macro_rules! implement_charted {
    (
        machine $Machine:ident { $($fields:tt)* } in $chart:ident::$Cartesian:ident;
        points [$($point:expr),*]
    ) => {
        impl $crate::emitted::Charted for $Machine {
            type Cartesian = $chart::$Cartesian;

            fn in_cartesian(&self) -> $chart::$Cartesian {
                let $Machine { $($fields)* } = *self;
                $chart::$Cartesian { $($fields)* }
            }

            fn points(&self) -> &[[::core::primitive::usize; 2]] {
                const { &[$($point),*] }
            }
        }
    };
}

/// Parts of `implement_machine`.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_part {
    // A struct of no numbers.
    (here $Type:ident $docs:literal) => {
        #[doc = $docs]
        #[derive(
            ::core::clone::Clone,
            ::core::marker::Copy,
            ::core::fmt::Debug,
            ::core::default::Default,
            ::core::cmp::PartialEq,
        )]
        pub struct $Type {}
    };

    // `Default`, if every number has a default.
    (
        default $Type:ident { $($fields:tt)* }
        [$($x:ident: $name:literal $unit:literal = $default:expr;)*]
    ) => {
        impl ::core::default::Default for $Type {
            fn default() -> Self {
                $(let $x = $default;)*
                $Type { $($fields)* }
            }
        }
    };
    (default $($incomplete:tt)*) => {};

    // `map`.
    (
        map $Type:ident { $($fields:tt)* }
        [$($x:ident: $name:literal $unit:literal $(= $default:expr)?;)*] $S:ident $R:ident
    ) => {
        impl<$S> $Type<$S> {
            /// These values as other numbers.
            pub fn map<$R>(self, f: impl ::core::ops::Fn($S) -> $R) -> $Type<$R> {
                let $Type { $($fields)* } = self;
                let values: [$S; _] = [$($x),*];
                let [$($x),*] = values.map(f);
                $Type { $($fields)* }
            }
        }
    };

    // Named coordinates and rows of numbers.
    (
        rows $n:literal $Type:ident { $($fields:tt)* }
        [$($x:ident: $name:literal $unit:literal;)*] $S:ident
    ) => {
        impl<$S: ::core::marker::Copy> $Type<$S> {
            /// The numbers in the order of the description: the order of `q` in every function here.
            pub fn to_array(self) -> [$S; $n] {
                let $Type { $($fields)* } = self;
                [$($x),*]
            }

            /// Names for numbers in the order of the description.
            pub fn from_array(q: [$S; $n]) -> Self {
                let [$($x),*] = q;
                $Type { $($fields)* }
            }
        }
    };

    // `Machine`.
    (
        machine $Machine:ident $machine:literal { $($fields:tt)* }
        [$($x:ident: $name:literal $unit:literal $(= $default:expr)?;)*]
        $Prepared:ident $Coordinates:ident
    ) => {
        impl $crate::emitted::Machine for $Machine {
            type System = $Prepared;

            fn name(&self) -> &::core::primitive::str {
                $machine
            }

            fn parameters(
                &self,
            ) -> impl ::core::iter::ExactSizeIterator<
                Item = ($crate::emitted::Quantity<'_>, ::core::primitive::f64),
            > {
                let $Machine { $($fields)* } = *self;
                $crate::emitted::values(
                    const { &[$($crate::emitted::Quantity::new($name, $unit)),*] },
                    [$($x),*],
                )
            }

            fn parameter_mut(
                &mut self,
                index: ::core::primitive::usize,
            ) -> ::core::option::Option<&mut ::core::primitive::f64> {
                let $Machine { $($fields)* } = self;
                let parameters: [&mut ::core::primitive::f64; _] = [$($x),*];
                parameters.into_iter().nth(index)
            }

            fn prepare(&self) -> $Prepared {
                Self::prepare(self)
            }

            fn start(&self) -> $crate::emitted::State<$Coordinates> {
                Self::start(self)
            }
        }
    };

    // The methods on coordinates that `System` and `SystemIn` share.
    (
        coordinates [$($x:ident: $name:literal $unit:literal;)*] $Vector:ty, $Coordinates:ty
    ) => {
        fn coordinates(
            &self,
        ) -> impl ::core::iter::ExactSizeIterator<Item = $crate::emitted::Quantity<'_>> {
            const NAMES: &[$crate::emitted::Quantity<'static>] =
                &[$($crate::emitted::Quantity::new($name, $unit)),*];
            NAMES.iter().copied()
        }

        fn to_coordinates(&self, vector: &$Vector) -> $Coordinates {
            <$Coordinates>::from_array(*vector)
        }

        fn to_vector(&self, coordinates: &$Coordinates) -> $Vector {
            coordinates.to_array()
        }
    };

    // The accelerations in numbers of one type.
    (
        accelerations { ($p:ident, $t:ident, $q:ident, $v:ident, $u:ident) $call:expr }
        [$Number:ty] $zeros:tt ($($given:tt),*) $result:ident
    ) => {{
        let ($p, $t, $q, $v, $u) = ($($given),*);
        <$Number as $crate::emitted::Number>::run_in_place($call, $result)
    }};
    (accelerations none [$Number:ty] $zeros:tt ($($given:tt),*) $result:ident) => {{
        *$result = $zeros;
        ::core::result::Result::Ok(())
    }};
    (accelerations friction [$Number:ty] $zeros:tt ($($given:tt),*) $result:ident) => {
        $crate::emitted::accelerations_with_friction($($given),*, $result)
    };

    // The Taylor series in lanes.
    (batch_series [] $N:ident) => {
        type SeriesLists = ();
    };
    (
        batch_series [{
            $Lists:ty;
            ($p:ident, $t:ident, $q:ident, $v:ident, $u:ident, $lists:ident, $coefficients:ident)
            $series:expr
        }]
        $N:ident
    ) => {
        type SeriesLists = $Lists;

        fn batch_series(
            $p: &Self::Batch,
            $t: [$crate::emitted::Lanes<$N>; 2],
            $q: &Self::Vectors,
            $v: &Self::Vectors,
            $u: &Self::BatchInputs,
            $lists: &mut Self::SeriesLists,
            $coefficients: &mut [Self::Vectors],
        ) -> ::core::result::Result<(), $crate::emitted::Singular> {
            <$crate::emitted::Lanes<$N> as $crate::emitted::Number>::run($series)
        }
    };

    // Values with their names.
    (
        values $method:ident $Type:ident { $($fields:tt)* }
        [$($x:ident: $name:literal $unit:literal $(= $default:expr)?;)*]
    ) => {
        fn $method(
            &self,
            values: &$Type,
        ) -> impl ::core::iter::ExactSizeIterator<
            Item = ($crate::emitted::Quantity<'_>, ::core::primitive::f64),
        > {
            let $Type { $($fields)* } = *values;
            $crate::emitted::values(
                const { &[$($crate::emitted::Quantity::new($name, $unit)),*] },
                [$($x),*],
            )
        }
    };

    // The type of inputs over other numbers; without inputs it has no type parameter.
    (over [] $Inputs:ident $R:ty) => { $Inputs };
    (over [$Over:ident] $Inputs:ident $R:ty) => { $Inputs<$R> };

    // The type of an argument of a method of `System`, by its letter.
    (argument t $n:literal $Inputs:ident) => { ::core::primitive::f64 };
    (argument u $n:literal $Inputs:ident) => { &$Inputs };
    (argument $x:ident $n:literal $Inputs:ident) => { &[::core::primitive::f64; $n] };

    // An argument of the slips, as an interval of its rounding.
    // An argument of assumptions, as an interval.
    (bounded t $t:ident $q:ident $v:ident) => { $crate::scalar::Interval::new($t[0], $t[1]) };
    (bounded q $t:ident $q:ident $v:ident) => { &$crate::emitted::intervals($q) };
    (bounded v $t:ident $q:ident $v:ident) => { &$crate::emitted::intervals($v) };

    (rounded p $p:tt $t:ident $q:ident $v:ident) => { &$p.rounded() };
    (rounded t $p:tt $t:ident $q:ident $v:ident) => { $crate::emitted::rounded($t) };
    (rounded q $p:tt $t:ident $q:ident $v:ident) => { &$q.map($crate::emitted::rounded) };
    (rounded v $p:tt $t:ident $q:ident $v:ident) => { &$v.map($crate::emitted::rounded) };

    // The prepared values that gaps depend on, as intervals of their rounding.
    (between p $p:tt) => { &$p.rounded() };
}

/// Prepared values as intervals of their rounding.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_intervals {
    ([] $($rest:tt)*) => {};
    ([yes] $Prepared:ident { $($field:ident,)* }) => {
        impl $Prepared {
            fn rounded(&self) -> $Prepared<$crate::scalar::Interval> {
                $Prepared {
                    $($field: $crate::emitted::PreparedField::rounded(self.$field)),*
                }
            }
        }
    };
}

/// `Batched`: several systems in vector lanes.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_lanes {
    ([] $($rest:tt)*) => {};
    (
        [$N:ident] $n:literal $Prepared:ident { $($field:ident,)* } [$($singular:ident)?]
        $Inputs:ident { $($inputs:tt)* } [$($x:ident: $name:literal $unit:literal $(= $default:expr)?;)*]
        $over:tt $accelerations:tt [$($series:tt)?]
    ) => {
        #[allow(unused_variables)]
        impl<const $N: ::core::primitive::usize> $crate::emitted::Batched<$N> for $Prepared
        where
            $crate::emitted::Lanes<$N>: $crate::emitted::Number,
        {
            type Batch = $Prepared<$crate::emitted::Lanes<$N>>;
            type Vectors = [$crate::emitted::Lanes<$N>; $n];
            type BatchInputs =
                $crate::implement_part!(over $over $Inputs $crate::emitted::Lanes<$N>);

            fn batch(systems: [&Self; $N]) -> Self::Batch {
                $Prepared {
                    $($field: $crate::emitted::PreparedField::side_by_side(
                        systems.map(|system| system.$field),
                    )),*
                }
            }

            fn batch_inputs(inputs: [&$Inputs; $N]) -> Self::BatchInputs {
                let rows = inputs.map(|inputs| {
                    let $Inputs { $($inputs)* } = *inputs;
                    [$($x),*]
                });
                let [$($x),*] = $crate::emitted::side_by_side(rows);
                $Inputs { $($inputs)* }
            }

            fn inputs_of_lane(
                inputs: &Self::BatchInputs,
                lane: ::core::primitive::usize,
            ) -> $Inputs {
                let $Inputs { $($inputs)* } = *inputs;
                let inputs: [$crate::emitted::Lanes<$N>; _] = [$($x),*];
                let [$($x),*] = inputs.map(|input| input[lane]);
                $Inputs { $($inputs)* }
            }

            fn is_singular(&self) -> ::core::primitive::bool {
                false $(|| self.$singular.is_some())?
            }

            fn batch_accelerations(
                system: &Self::Batch,
                t: $crate::emitted::Lanes<$N>,
                q: &Self::Vectors,
                v: &Self::Vectors,
                u: &Self::BatchInputs,
                result: &mut Self::Vectors,
            ) -> ::core::result::Result<(), $crate::emitted::Singular> {
                $crate::implement_part! {
                    accelerations $accelerations [$crate::emitted::Lanes<$N>]
                    [$crate::emitted::Lanes::splat(0.0); $n] (system, t, q, v, u) result
                }
            }

            $crate::implement_part! { batch_series [$($series)?] $N }
        }
    };
}

/// `MachineIn` and `SystemIn`: the machine in numbers of any kind.
#[doc(hidden)]
#[macro_export]
macro_rules! implement_numbers {
    ([] $($rest:tt)*) => {};
    (
        [yes] $S:ident $n:literal $Machine:ident $Prepared:ident $Coordinates:ident $coordinate_rows:tt
        $Inputs:ident { $($inputs:tt)* } [$($x:ident: $name:literal $unit:literal $(= $default:expr)?;)*]
        $over:tt $accelerations:tt
    ) => {
        impl<$S: $crate::emitted::Real> $crate::emitted::MachineIn<$S> for $Machine<$S> {
            type System = $Prepared<$S>;

            fn prepare(&self) -> $Prepared<$S> {
                Self::prepare(self)
            }

            fn start(&self) -> $crate::emitted::State<$Coordinates<$S>> {
                Self::start(self)
            }
        }

        #[allow(unused_variables)]
        impl<$S: $crate::emitted::Real> $crate::emitted::SystemIn<$S> for $Prepared<$S> {
            type Vector = [$S; $n];
            type Coordinates = $Coordinates<$S>;
            type Inputs = $crate::implement_part!(over $over $Inputs $S);

            $crate::implement_part! { coordinates $coordinate_rows [$S; $n], $Coordinates<$S> }

            fn default_inputs(&self) -> $crate::implement_part!(over $over $Inputs $S) {
                let $Inputs { $($inputs)* } = <$Inputs as ::core::default::Default>::default();
                let inputs: [::core::primitive::f64; _] = [$($x),*];
                let [$($x),*] = inputs.map(<$S as $crate::emitted::Scalar>::from_f64);
                $Inputs { $($inputs)* }
            }

            fn accelerations(
                &self,
                t: $S,
                q: &[$S; $n],
                v: &[$S; $n],
                u: &$crate::implement_part!(over $over $Inputs $S),
                result: &mut [$S; $n],
            ) -> ::core::result::Result<(), $crate::emitted::Singular> {
                $crate::implement_part! {
                    accelerations $accelerations [$S]
                    [<$S as $crate::emitted::Scalar>::ZERO; $n] (self, t, q, v, u) result
                }
            }
        }
    };
}
