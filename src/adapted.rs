//! A machine with a force beside those of its description.

use core::fmt::{self, Debug};

use crate::at::At;
use crate::constraints::algebra::{backward, cholesky, forward as solve_lower};
use crate::forward::forward;
use crate::{
    Coordinates, Inputs, Machine, Pivot, Quantity, Singular, State, StepError, System, Vector,
    least_multipliers,
};

/// A machine with a generalized force `τ` beside those of its description, for forces that the language cannot express: a
/// measured characteristic, a controller's own model, or the opposite of a force that is to be removed.
///
/// The function receives time, coordinates, rates and inputs, and adds to a force for each coordinate, which is initially 0: in
/// N for a length, in N·m for an angle. With it `M a = f + τ + Gᵀ λ`, the power `Σ τᵢ vᵢ` is part of the
/// [work](System::work_rate), and the energy balance closes as without it. Accelerations cost one more factorization of the mass
/// matrix than those of the machine.
///
/// It is a [`Machine`] itself, so everything that runs machines runs it. What is derived from the description alone is missing:
/// it has neither a Taylor series nor derivatives of the accelerations.
///
/// ```
/// use lagrangian::{Adapted, Machine, Simulation};
///
/// lagrangian::machine! {
///     machine Ball in plane {
///         parameters { m: kg = 0.5, g: m/s^2 = 10 }
///         coordinates { y: m }
///         bodies { ball { mass: m, at: (0, y) } }
///         gravity (0, -g);
///     }
/// }
///
/// // Drag that grows with the square of the speed: the ball comes to fall at √(m g/c).
/// let c = 0.05;
/// let falling = Adapted::new(Ball::default(), move |_t, _q, v, _u, force| force.y = -c * v.y * v.y.abs())?;
/// let run = Simulation::new(&falling).until(20.0).energy_balance(true).run(falling.start())?;
/// assert!((run.end().v.y + (0.5 * 10.0 / c).sqrt()).abs() < 1e-7);
/// # Ok::<(), lagrangian::Error>(())
/// ```
#[derive(Clone, Copy)]
#[must_use = "this is a machine: run it in a simulation"]
pub struct Adapted<M, F> {
    machine: M,
    force: F,
}

const NO_WORKSPACE: Singular = Singular {
    at: Pivot::NoWorkspace,
    ratio: 0.0,
};

/// The error for a machine with guided contacts: their normal reactions depend on every force, and they are computed from the
/// forces of the description only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HasFriction;

impl fmt::Display for HasFriction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no further force can act on a machine with friction at guides: the reactions of its guides are derived from the \
             forces of its description; write the force there"
        )
    }
}

impl core::error::Error for HasFriction {}

impl<M, F> Adapted<M, F>
where
    M: Machine,
    F: Fn(f64, &Coordinates<M>, &Coordinates<M>, &Inputs<M>, &mut Coordinates<M>) + Clone,
{
    /// `machine` with the additional force that `force(t, q, v, u, τ)` adds to `τ`.
    ///
    /// # Errors
    /// If the machine has friction at guides.
    pub fn new(machine: M, force: F) -> Result<Self, HasFriction> {
        let system = machine.prepare();
        match system.contacts().len() + system.guides() {
            0 => Ok(Self { machine, force }),
            _ => Err(HasFriction),
        }
    }

    /// The machine without the additional force.
    pub fn machine(&self) -> &M {
        &self.machine
    }
}

impl<M: Debug, F> Debug for Adapted<M, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("Adapted");
        shown
            .field("machine", &self.machine)
            .finish_non_exhaustive()
    }
}

impl<M, F> Machine for Adapted<M, F>
where
    M: Machine,
    F: Fn(f64, &Coordinates<M>, &Coordinates<M>, &Inputs<M>, &mut Coordinates<M>) + Clone,
{
    type System = AdaptedSystem<M::System, F>;

    fn name(&self) -> &str {
        self.machine.name()
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        self.machine.parameters()
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        self.machine.parameter_mut(index)
    }

    fn prepare(&self) -> Self::System {
        AdaptedSystem {
            system: self.machine.prepare(),
            force: self.force.clone(),
        }
    }

    fn start(&self) -> State<Coordinates<M>> {
        self.machine.start()
    }
}

/// The equations of motion of an [`Adapted`] machine.
#[derive(Clone, Copy)]
pub struct AdaptedSystem<S, F> {
    system: S,
    force: F,
}

impl<S: Debug, F> Debug for AdaptedSystem<S, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("AdaptedSystem");
        shown.field("system", &self.system).finish_non_exhaustive()
    }
}

impl<S, F> AdaptedSystem<S, F>
where
    S: System,
    F: Fn(f64, &S::Coordinates, &S::Coordinates, &S::Inputs, &mut S::Coordinates),
{
    fn wrapped(&self) -> &S {
        &self.system
    }

    fn own<'v>(&self, vector: &'v S::Vector) -> &'v S::Vector {
        vector
    }

    fn put(&self, to: &mut S::Vector, write: impl FnOnce(&mut S::Vector)) {
        write(to);
    }

    fn put_matrix(&self, to: &mut S::Matrix, write: impl FnOnce(&mut S::Matrix)) {
        write(to);
    }

    /// The additional force `τ`.
    fn additional_force(&self, t: f64, q: &S::Vector, v: &S::Vector, u: &S::Inputs) -> S::Vector {
        let named = |vector: &S::Vector| self.system.to_coordinates(vector);
        let mut force = named(&q.zeros_like());
        (self.force)(t, &named(q), &named(v), u, &mut force);
        self.system.to_vector(&force)
    }

    /// All accelerations and multipliers, if constraints take up a part of the force.
    fn constrained(
        &self,
        At { t, q, v, u }: At<'_, S>,
        a: &mut S::Vector,
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        least_multipliers(self, t, q, v, u, a, multipliers).map_err(|error| match error {
            StepError::Singular { singular, .. } => singular,
            StepError::Inconsistent { constraint, .. } => {
                Singular::constraint(constraint, 0.0, 1.0)
            }
            _ => NO_WORKSPACE,
        })
    }

    /// Whether the machine computes the power of its reactions from its accelerations, as a machine with moving constraints does:
    /// `v·Gᵀλ = v·(M a − f)`. Then that power already includes the additional force.
    ///
    /// In this case the work rate is linear in `a`, and its slope exceeds that of the drives, which is `∂T/∂v` at rest, by `M v`:
    /// along `v` these are `T₁` and `2 T₂`, with the parts `T₂` and `T₁` of `T` of second and first order in `v`.
    fn work_rate_includes_reactions(
        &self,
        At { t, q, v, u }: At<'_, S>,
        a: &S::Vector,
        work_rate: f64,
    ) -> bool {
        let mut back = v.clone();
        back.as_mut_slice().iter_mut().for_each(|v| *v = -*v);
        let [forth, back, rest] =
            [v, &back, &q.zeros_like()].map(|v| self.system.kinetic_energy(t, q, v));
        let (first, twice_second) = (0.5 * (forth - back), forth + back - 2.0 * rest);
        if twice_second == 0.0 {
            return false;
        }
        // So far that round-off of the work rate is negligible relative to the difference.
        let far = 1.0 + work_rate.abs() / twice_second;
        let mut ahead = a.clone();
        for (a, v) in ahead.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *a += far * v;
        }
        let slope = (self.system.work_rate(t, q, v, &ahead, u) - work_rate) / far;
        slope - first > 0.5 * twice_second
    }

    fn add(to: &mut S::Vector, from: &S::Vector) {
        for (to, from) in to.as_mut_slice().iter_mut().zip(from.as_slice()) {
            *to += from;
        }
    }
}

impl<S, F> System for AdaptedSystem<S, F>
where
    S: System,
    F: Fn(f64, &S::Coordinates, &S::Coordinates, &S::Inputs, &mut S::Coordinates),
{
    type Vector = S::Vector;
    type Matrix = S::Matrix;
    type Coordinates = S::Coordinates;
    type Inputs = S::Inputs;
    type Outputs = S::Outputs;
    const MAY_BE_CONSTRAINED: bool = S::MAY_BE_CONSTRAINED;
    const MAY_SLIDE: bool = S::MAY_SLIDE;
    const MAY_COLLIDE: bool = S::MAY_COLLIDE;

    forward!(
        coordinates,
        to_coordinates,
        to_vector,
        equations,
        mass_matrix,
        bias,
        observed,
        default_inputs,
        input_values,
        outputs,
        output_values,
        assumptions,
        constraints,
        constraint_positions,
        constraint_rates,
        constraint_matrix,
        constraint_bias,
        unilateral_contacts,
        gaps,
        contact_rates,
        contact_matrix,
        contact_faces,
        contact_bias,
        contact_coefficients,
        single_contacts,
        kept_at_start,
        with_workspace,
    );

    /// The accelerations of the machine and `M⁻¹ τ`; with constraints, which take up a part of `τ`, all are computed anew.
    fn accelerations(
        &self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        u: &S::Inputs,
        a: &mut S::Vector,
    ) -> Result<(), Singular> {
        let m = self.system.constraints().len();
        if m != 0 {
            return self.with_workspace(m, |multipliers| match multipliers {
                Some(multipliers) => self.constrained(At { t, q, v, u }, a, &mut multipliers[..m]),
                None => Err(NO_WORKSPACE),
            });
        }
        self.system.accelerations(t, q, v, u, a)?;
        let mut by_force = self.additional_force(t, q, v, u);
        let n = q.as_slice().len();
        let mut matrix = S::Matrix::zeros(n * n);
        if matrix.as_slice().len() != n * n {
            // Without a mass matrix the response to a force is unknown.
            return Err(Singular::new(0, 0.0, 1.0));
        }
        self.system.mass_matrix(t, q, &mut matrix);
        let mut shares = q.zeros_like();
        cholesky(matrix.as_mut_slice(), shares.as_mut_slice())?;
        solve_lower(matrix.as_slice(), by_force.as_mut_slice());
        backward(matrix.as_slice(), by_force.as_mut_slice());
        Self::add(a, &by_force);
        Ok(())
    }

    fn applied(
        &self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        u: &S::Inputs,
        applied: &mut S::Vector,
    ) {
        self.system.applied(t, q, v, u, applied);
        Self::add(applied, &self.additional_force(t, q, v, u));
    }

    fn forces(&self, t: f64, q: &S::Vector, v: &S::Vector, u: &S::Inputs, forces: &mut S::Vector) {
        self.system.forces(t, q, v, u, forces);
        Self::add(forces, &self.additional_force(t, q, v, u));
    }

    fn work_rate(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &S::Vector, u: &S::Inputs) -> f64 {
        let force = self.additional_force(t, q, v, u);
        let own = self.system.work_rate(t, q, v, a, u);
        if self.system.constraints().len() != 0
            && self.work_rate_includes_reactions(At { t, q, v, u }, a, own)
        {
            return own;
        }
        let rows = force.as_slice().iter().zip(v.as_slice());
        own + rows.map(|(force, v)| force * v).sum::<f64>()
    }

    fn multipliers(
        &self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        u: &S::Inputs,
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        if multipliers.is_empty() {
            return Ok(());
        }
        self.constrained(At { t, q, v, u }, &mut q.zeros_like(), multipliers)
    }

    fn check_series(&self) -> Result<(), &str> {
        Err("a further force acts on it that is not part of its description")
    }
}
