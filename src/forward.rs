//! Forwards methods of a system that wraps another one to that system.

/// Implements methods of [`System`](crate::System) by calling the wrapped system, by name.
///
/// The wrapper defines how to reach the wrapped system and its vectors: `wrapped(&self)` returns the system;
/// `own(&self, vector)` returns one of its vectors, by value or by reference; `put` and `put_matrix` let a function write
/// one, `(&self, to, |own| …)`. Names of coordinates, assumptions, constraints and contacts are forwarded by wrappers whose
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
    (@ mass_matrix) => {
        fn mass_matrix(&self, t: f64, q: &Self::Vector, matrix: &mut Self::Matrix) {
            let q = self.own(q);
            self.put_matrix(matrix, |own| self.wrapped().mass_matrix(t, &q, own));
        }
    };
    (@ bias) => {
        fn bias(&self, t: f64, q: &Self::Vector, v: &Self::Vector, bias: &mut Self::Vector) {
            let (q, v) = (self.own(q), self.own(v));
            self.put(bias, |own| self.wrapped().bias(t, &q, &v, own));
        }
    };
    (@ applied) => { crate::forward::forward!(@ of_inputs applied); };
    (@ forces) => { crate::forward::forward!(@ of_inputs forces); };
    (@ of_inputs $method:ident) => {
        fn $method(
            &self,
            t: f64,
            q: &Self::Vector,
            v: &Self::Vector,
            u: &Self::Inputs,
            forces: &mut Self::Vector,
        ) {
            let (q, v) = (self.own(q), self.own(v));
            self.put(forces, |own| self.wrapped().$method(t, &q, &v, u, own));
        }
    };
    (@ kinetic_energy) => {
        fn kinetic_energy(&self, t: f64, q: &Self::Vector, v: &Self::Vector) -> f64 {
            self.wrapped().kinetic_energy(t, &self.own(q), &self.own(v))
        }
    };
    (@ state_energy) => {
        fn state_energy(&self, t: f64, q: &Self::Vector, v: &Self::Vector) -> f64 {
            self.wrapped().state_energy(t, &self.own(q), &self.own(v))
        }
    };
    (@ potential_energy) => {
        fn potential_energy(&self, t: f64, q: &Self::Vector, u: &Self::Inputs) -> f64 {
            self.wrapped().potential_energy(t, &self.own(q), u)
        }
    };
    (@ dissipation) => { crate::forward::forward!(@ power dissipation); };
    (@ dissipation_rate) => { crate::forward::forward!(@ power dissipation_rate); };
    (@ power $method:ident) => {
        fn $method(&self, t: f64, q: &Self::Vector, v: &Self::Vector, u: &Self::Inputs) -> f64 {
            self.wrapped().$method(t, &self.own(q), &self.own(v), u)
        }
    };
    (@ work_rate) => {
        fn work_rate(
            &self,
            t: f64,
            q: &Self::Vector,
            v: &Self::Vector,
            a: &Self::Vector,
            u: &Self::Inputs,
        ) -> f64 {
            self.wrapped()
                .work_rate(t, &self.own(q), &self.own(v), &self.own(a), u)
        }
    };
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
    (@ constraint_positions) => { crate::forward::forward!(@ of_place constraint_positions); };
    (@ constraint_matrix) => { crate::forward::forward!(@ of_place constraint_matrix); };
    (@ gaps) => { crate::forward::forward!(@ of_place gaps); };
    (@ of_place $method:ident) => {
        fn $method(&self, t: f64, q: &Self::Vector, to: &mut [f64]) {
            self.wrapped().$method(t, q, to);
        }
    };
    (@ constraint_rates) => { crate::forward::forward!(@ of_state constraint_rates); };
    (@ constraint_bias) => { crate::forward::forward!(@ of_state constraint_bias); };
    (@ contact_rates) => { crate::forward::forward!(@ of_state contact_rates); };
    (@ contact_faces) => { crate::forward::forward!(@ of_state contact_faces); };
    (@ contact_bias) => { crate::forward::forward!(@ of_state contact_bias); };
    (@ contact_coefficients) => { crate::forward::forward!(@ of_state contact_coefficients); };
    (@ of_state $method:ident) => {
        fn $method(&self, t: f64, q: &Self::Vector, v: &Self::Vector, to: &mut [f64]) {
            self.wrapped().$method(t, q, v, to);
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
    (@ contact_matrix) => { crate::forward::forward!(@ of_place contact_matrix); };
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
