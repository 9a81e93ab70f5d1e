//! The derivatives of accelerations: [`Linearize`], by the state, and [`Differentiate`], by parameters and inputs too.

use crate::{Quantity, Singular, System};

/// Equations of motion with derivatives of their accelerations with respect to the state, as linearization about an equilibrium needs them.
/// Implicit methods do not use them: they take finite differences of the accelerations that the run evaluates, which include the effects of
/// constraints and contacts.
///
/// Implemented by the code of a description with `derivatives { coordinates, rates }`, and by the
/// interpreter for every machine.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not provide the derivatives of its accelerations with respect to the state",
    label = "needs the derivatives of the accelerations",
    note = "add the line `derivatives {{ coordinates, rates }}` to the description of the machine"
)]
pub trait Linearize: System {
    /// The accelerations `a(t, q, v, u)` and, row after row, their derivatives
    /// `∂aᵢ/∂qⱼ` and `∂aᵢ/∂vⱼ`, which are exact to rounding and not finite differences.
    #[expect(
        clippy::too_many_arguments,
        reason = "a state, and the three things that are asked of it"
    )]
    fn linearize(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        u: &Self::Inputs,
        a: &mut Self::Vector,
        by_coordinates: &mut Self::Matrix,
        by_rates: &mut Self::Matrix,
    ) -> Result<(), Singular>;
}

/// Equations of motion with derivatives of their accelerations with respect to parameters and inputs as well.
///
/// Implemented by the code of a description with `derivatives { coordinates, rates, … }`, and by the interpreter.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not provide the derivatives of its accelerations with respect to the state, parameters and inputs",
    label = "needs the derivatives of the accelerations",
    note = "add the line `derivatives {{ coordinates, rates }}` to the description of the machine, with the names of the parameters and \
            with `inputs`, where it is to be differentiated with respect to these"
)]
pub trait Differentiate: Linearize {
    /// Names and units of the inputs and parameters with respect to which the accelerations are differentiated, in the order of the
    /// columns: those in the description's `derivatives`.
    fn variables(&self) -> impl ExactSizeIterator<Item = Quantity<'_>>;

    /// [`linearize`](Linearize::linearize) and, row after row, the derivatives with respect to the [`variables`](Self::variables). Columns
    /// that do not fit into `by_variables` are left out.
    #[expect(
        clippy::too_many_arguments,
        reason = "a state, and the four things that are asked of it"
    )]
    fn differentiate(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        u: &Self::Inputs,
        a: &mut Self::Vector,
        by_coordinates: &mut Self::Matrix,
        by_rates: &mut Self::Matrix,
        by_variables: &mut [f64],
    ) -> Result<(), Singular>;
}
