//! A machine whose functions contradict each other.

use super::constrained::Constrained;
use lagrangian::{
    Assumption, Constraint, Machine, Quantity, Singular, State, System, accelerations_with_friction,
};

/// The mistake in a [`Tampered`] machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slip {
    /// No mistake.
    None,
    /// The acceleration of this coordinate is off by this much.
    Acceleration(usize, f64),
    /// The multiplier of this constraint is off by this factor.
    Multiplier(usize, f64),
    /// The bias `γ` of this constraint is off by this much in one of
    /// the two functions that give it.
    ConstraintBias(usize, f64),
    /// The machine has a contact, but no workspace to evaluate it, or one of this many numbers.
    Workspace(Option<usize>),
}

/// A machine typed in by hand with a mistake in one of its functions.
#[derive(Clone, Copy, Debug)]
pub struct Tampered<const N: usize, const M: usize, const NN: usize> {
    pub machine: Constrained<N, M, NN>,
    pub slip: Slip,
}

impl<const N: usize, const M: usize, const NN: usize> Machine for Tampered<N, M, NN> {
    type System = Self;

    fn name(&self) -> &str {
        "Tampered"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        self.machine.parameters()
    }

    fn prepare(&self) -> Self {
        *self
    }

    fn start(&self) -> State<[f64; N]> {
        self.machine.start()
    }
}

impl<const N: usize, const M: usize, const NN: usize> System for Tampered<N, M, NN> {
    type Vector = [f64; N];
    type Matrix = [f64; NN];
    type Coordinates = [f64; N];
    type Inputs = ();
    type Outputs = ();
    // This compiles out all code that handles unilateral contacts.
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        System::coordinates(&self.machine)
    }

    fn to_coordinates(&self, vector: &[f64; N]) -> [f64; N] {
        *vector
    }

    fn to_vector(&self, coordinates: &[f64; N]) -> [f64; N] {
        *coordinates
    }

    fn accelerations(
        &self,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        u: &(),
        a: &mut [f64; N],
    ) -> Result<(), Singular> {
        if let Slip::Workspace(_) = self.slip {
            return accelerations_with_friction(self, t, q, v, u, a);
        }
        self.machine.accelerations(t, q, v, u, a)?;
        if let Slip::Acceleration(i, by) = self.slip {
            a[i] += by;
        }
        Ok(())
    }

    fn mass_matrix(&self, t: f64, q: &[f64; N], matrix: &mut [f64; NN]) {
        self.machine.mass_matrix(t, q, matrix);
    }

    fn bias(&self, t: f64, q: &[f64; N], v: &[f64; N], bias: &mut [f64; N]) {
        self.machine.bias(t, q, v, bias);
    }

    fn applied(&self, t: f64, q: &[f64; N], v: &[f64; N], u: &(), applied: &mut [f64; N]) {
        self.machine.applied(t, q, v, u, applied);
    }

    fn forces(&self, t: f64, q: &[f64; N], v: &[f64; N], u: &(), forces: &mut [f64; N]) {
        System::forces(&self.machine, t, q, v, u, forces);
    }

    fn kinetic_energy(&self, t: f64, q: &[f64; N], v: &[f64; N]) -> f64 {
        self.machine.kinetic_energy(t, q, v)
    }

    fn potential_energy(&self, t: f64, q: &[f64; N], u: &()) -> f64 {
        System::potential_energy(&self.machine, t, q, u)
    }

    fn dissipation(&self, _: f64, _: &[f64; N], _: &[f64; N], (): &()) -> f64 {
        0.0
    }

    fn work_rate(&self, t: f64, q: &[f64; N], v: &[f64; N], a: &[f64; N], u: &()) -> f64 {
        self.machine.work_rate(t, q, v, a, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; N], _: &[f64; N], (): &()) -> f64 {
        0.0
    }

    fn default_inputs(&self) {}

    fn input_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn outputs(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &[f64; N], (): &()) {}

    fn output_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; N],
        _: &[f64; N],
        (): &(),
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        System::constraints(&self.machine)
    }

    fn constraint_positions(&self, t: f64, q: &[f64; N], residuals: &mut [f64]) {
        self.machine.constraint_positions(t, q, residuals);
    }

    fn constraint_rates(&self, t: f64, q: &[f64; N], v: &[f64; N], residuals: &mut [f64]) {
        self.machine.constraint_rates(t, q, v, residuals);
    }

    fn constraint_matrix(&self, t: f64, q: &[f64; N], matrix: &mut [f64]) {
        self.machine.constraint_matrix(t, q, matrix);
    }

    fn constraint_bias(&self, t: f64, q: &[f64; N], v: &[f64; N], bias: &mut [f64]) {
        self.machine.constraint_bias(t, q, v, bias);
        if let Slip::ConstraintBias(k, by) = self.slip {
            bias[k] += by;
        }
    }

    fn multipliers(
        &self,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        u: &(),
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        self.machine.multipliers(t, q, v, u, multipliers)?;
        if let Slip::Multiplier(k, factor) = self.slip {
            multipliers[k] *= factor;
        }
        Ok(())
    }

    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        let has = matches!(self.slip, Slip::Workspace(_));
        has.then_some("pad").into_iter()
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut values = vec![0.0; length];
        match self.slip {
            Slip::Workspace(length) => work(length.map(|length| &mut values[..length])),
            _ => work(Some(&mut values)),
        }
    }
}
