//! Forwards methods of a system that wraps another one to that system.

/// Implements methods of [`System`](crate::System) by calling the wrapped system, by name.
///
/// The wrapper defines how to reach the wrapped system and its vectors: `wrapped(&self)` returns the system;
/// `own(&self, vector)` returns one of its vectors, by value or by reference; `put` and `put_matrix` let a function write
/// one, `(&self, to, |own| …)`. `observed` are all quantities that only observe a state, with exception of those of accelerations. Names of coordinates, assumptions, constraints and contacts are forwarded by wrappers whose
/// vectors are those of the wrapped system.
macro_rules! forward {
    ($($method:ident),+ $(,)?) => { $(crate::forward::forward!(@ $method);)+ };

    (@ coordinates) => {
        fn coordinates(&self) -> impl ExactSizeIterator<Item = crate::Quantity<'_>> {
            self.wrapped().coordinates()
        }
    };
    (@ to_coordinates) => {
        fn to_coordinates(&self, vector: &Self::Vector) -> Self::Coordinates {
            self.wrapped().to_coordinates(vector)
        }
    };
    (@ to_vector) => {
        fn to_vector(&self, coordinates: &Self::Coordinates) -> Self::Vector {
            self.wrapped().to_vector(coordinates)
        }
    };
    (@ accelerations) => {
        #[inline(always)]
        fn accelerations(
            &self,
            t: f64,
            q: &Self::Vector,
            v: &Self::Vector,
            u: &Self::Inputs,
            a: &mut Self::Vector,
        ) -> Result<(), crate::Singular> {
            self.wrapped().accelerations(t, q, v, u, a)
        }
    };
    (@ equations) => {
        fn equations(&self) -> usize {
            self.wrapped().equations()
        }
    };
    // <quantities: forwarded>
    (@ mass_matrix) => { crate::forward::forward!(@ matrix mass_matrix t q); };
    (@ bias) => { crate::forward::forward!(@ vector bias t q v); };
    (@ applied) => { crate::forward::forward!(@ vector applied t q v u); };
    (@ forces) => { crate::forward::forward!(@ vector forces t q v u); };
    (@ constraint_positions) => { crate::forward::forward!(@ numbers constraint_positions t q); };
    (@ constraint_rates) => { crate::forward::forward!(@ numbers constraint_rates t q v); };
    (@ constraint_matrix) => { crate::forward::forward!(@ numbers constraint_matrix t q); };
    (@ constraint_bias) => { crate::forward::forward!(@ numbers constraint_bias t q v); };
    (@ slips) => { crate::forward::forward!(@ numbers slips t q v); };
    (@ slip_matrix) => { crate::forward::forward!(@ numbers slip_matrix t q); };
    (@ slip_bias) => { crate::forward::forward!(@ numbers slip_bias t q v); };
    (@ gaps) => { crate::forward::forward!(@ numbers gaps t q); };
    (@ contact_rates) => { crate::forward::forward!(@ numbers contact_rates t q v); };
    (@ contact_matrix) => { crate::forward::forward!(@ numbers contact_matrix t q); };
    (@ contact_bias) => { crate::forward::forward!(@ numbers contact_bias t q v); };
    (@ contact_coefficients) => { crate::forward::forward!(@ numbers contact_coefficients t q v); };
    (@ contact_faces) => { crate::forward::forward!(@ numbers contact_faces t q v); };
    (@ guide_matrix) => { crate::forward::forward!(@ numbers guide_matrix t q); };
    (@ guide_loads) => { crate::forward::forward!(@ numbers guide_loads t q v u); };
    (@ kinetic_energy) => { crate::forward::forward!(@ number kinetic_energy t q v); };
    (@ potential_energy) => { crate::forward::forward!(@ number potential_energy t q u); };
    (@ state_energy) => { crate::forward::forward!(@ number state_energy t q v); };
    (@ dissipation) => { crate::forward::forward!(@ number dissipation t q v u); };
    (@ work_rate) => { crate::forward::forward!(@ number work_rate t q v a u); };
    (@ dissipation_rate) => { crate::forward::forward!(@ number dissipation_rate t q v u); };
    (@ observed) => {
        crate::forward::forward!(@ kinetic_energy);
        crate::forward::forward!(@ potential_energy);
        crate::forward::forward!(@ state_energy);
        crate::forward::forward!(@ dissipation);
        crate::forward::forward!(@ dissipation_rate);
    };
    // </quantities>

    // Quantities, by the kind of their numbers and the letters of their arguments.
    (@ number $method:ident $($x:ident)*) => {
        fn $method(&self, $($x: crate::forward::forward!(@ type $x)),*) -> f64 {
            self.wrapped().$method($(crate::forward::forward!(@ given self $x $x)),*)
        }
    };
    (@ vector $method:ident $($x:ident)*) => {
        fn $method(
            &self,
            $($x: crate::forward::forward!(@ type $x),)*
            to: &mut Self::Vector,
        ) {
            self.put(to, |own| {
                self.wrapped().$method($(crate::forward::forward!(@ given self $x $x),)* own);
            });
        }
    };
    (@ matrix $method:ident $($x:ident)*) => {
        fn $method(
            &self,
            $($x: crate::forward::forward!(@ type $x),)*
            to: &mut Self::Matrix,
        ) {
            self.put_matrix(to, |own| {
                self.wrapped().$method($(crate::forward::forward!(@ given self $x $x),)* own);
            });
        }
    };
    (@ numbers $method:ident $($x:ident)*) => {
        fn $method(&self, $($x: crate::forward::forward!(@ type $x),)* to: &mut [f64]) {
            self.wrapped().$method($(crate::forward::forward!(@ given self $x $x),)* to);
        }
    };
    (@ type t) => { f64 };
    (@ type u) => { &Self::Inputs };
    (@ type $x:ident) => { &Self::Vector };
    (@ given $wrapper:ident t $x:ident) => { $x };
    (@ given $wrapper:ident u $x:ident) => { $x };
    (@ given $wrapper:ident $letter:ident $x:ident) => { &$wrapper.own($x) };

    (@ default_inputs) => {
        fn default_inputs(&self) -> Self::Inputs {
            self.wrapped().default_inputs()
        }
    };
    (@ input_values) => {
        fn input_values(
            &self,
            inputs: &Self::Inputs,
        ) -> impl ExactSizeIterator<Item = (crate::Quantity<'_>, f64)> {
            self.wrapped().input_values(inputs)
        }
    };
    (@ outputs) => {
        fn outputs(
            &self,
            t: f64,
            q: &Self::Vector,
            v: &Self::Vector,
            a: &Self::Vector,
            u: &Self::Inputs,
        ) -> Self::Outputs {
            self.wrapped()
                .outputs(t, &self.own(q), &self.own(v), &self.own(a), u)
        }
    };
    (@ output_values) => {
        fn output_values(
            &self,
            outputs: &Self::Outputs,
        ) -> impl ExactSizeIterator<Item = (crate::Quantity<'_>, f64)> {
            self.wrapped().output_values(outputs)
        }
    };
    (@ assumptions) => {
        fn assumptions(
            &self,
            t: f64,
            q: &Self::Vector,
            v: &Self::Vector,
            u: &Self::Inputs,
        ) -> impl ExactSizeIterator<Item = crate::Assumption<'_>> {
            self.wrapped().assumptions(t, q, v, u)
        }
    };
    (@ constraints) => {
        fn constraints(&self) -> impl ExactSizeIterator<Item = crate::Constraint<'_>> {
            self.wrapped().constraints()
        }
    };
    (@ unilateral_contacts) => {
        fn unilateral_contacts(
            &self,
        ) -> impl ExactSizeIterator<Item = crate::UnilateralContact<'_>> {
            self.wrapped().unilateral_contacts()
        }
    };
    (@ single_contacts) => {
        fn single_contacts(&self) -> Option<&[bool]> {
            self.wrapped().single_contacts()
        }

        fn of_contacts(
            &self,
            quantity: crate::ContactQuantity,
            which: &[usize],
            state: (f64, &Self::Vector, &Self::Vector),
            numbers: &mut [f64],
        ) {
            self.wrapped().of_contacts(quantity, which, state, numbers);
        }

        fn least_gaps(&self, t: [f64; 2], q: [&Self::Vector; 2], least: &mut [f64]) {
            self.wrapped().least_gaps(t, q, least);
        }
    };
    (@ kept_at_start) => {
        fn kept_at_start(&self) -> impl ExactSizeIterator<Item = &str> {
            self.wrapped().kept_at_start()
        }
    };
    (@ with_workspace) => {
        fn with_workspace<R>(
            &self,
            length: usize,
            work: impl FnOnce(Option<&mut [f64]>) -> R,
        ) -> R {
            self.wrapped().with_workspace(length, work)
        }
    };
}
pub(crate) use forward;
