//! The equations of motion of a machine with given parameters: the traits [`System`] and [`Staged`].
//!
//! Both are implemented by the code that `machine!` emits and by the interpreter. Letters: `q` coordinates, `v = dq/dt`, `a = dv/dt`, `u`
//! inputs, `t` time; SI units, angles in radians.

use core::fmt::Debug;

use crate::series_memory::SeriesMemory;
use crate::{
    Assumption, Constraint, ContactQuantity, Pivot, Quantity, Singular, UnilateralContact, Vector,
};

/// The largest number of coefficients of each coordinate that emitted code computes in [`System::series`].
pub(crate) const SERIES_ROWS: usize = 24;

/// The largest number of guided contacts of a machine, as many as [`System::second_tangents`] has bits. Without the feature `std` it is 6.
pub const MOST_CONTACTS: usize = 64;

/// The equations of motion `M(q, t) a = f(q, v, t, u)` of a machine with given parameters, solved
/// for the accelerations `a`, and what can be observed of the motion.
///
/// Integrators call only [`accelerations`](Self::accelerations) unless more is requested; a quantity that is not requested costs nothing.
///
/// A system written by hand needs its five types, its coordinates, its accelerations, its default inputs and its outputs. The other methods
/// have defaults: either there is nothing (no constraints, no damping), or the value is unknown and returned as NaN, and a run that needs
/// it ends with an error.
///
/// ```
/// use lagrangian::{Quantity, Singular, System};
///
/// /// Duffing's oscillator, x″ = x − x³.
/// #[derive(Clone)]
/// struct Duffing;
///
/// impl System for Duffing {
///     type Vector = [f64; 1];
///     type Matrix = [f64; 1];
///     type Coordinates = f64;
///     type Inputs = ();
///     type Outputs = ();
///
///     fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
///         [Quantity::new("x", "m")].into_iter()
///     }
///
///     fn to_coordinates(&self, vector: &[f64; 1]) -> f64 {
///         vector[0]
///     }
///
///     fn to_vector(&self, x: &f64) -> [f64; 1] {
///         [*x]
///     }
///
///     fn accelerations(&self, _t: f64, q: &[f64; 1], _v: &[f64; 1], _u: &(), a: &mut [f64; 1]) -> Result<(), Singular> {
///         a[0] = q[0] - q[0].powi(3);
///         Ok(())
///     }
///
///     fn default_inputs(&self) {}
///
///     fn outputs(&self, _t: f64, _q: &[f64; 1], _v: &[f64; 1], _a: &[f64; 1], _u: &()) {}
/// }
/// assert!(Duffing.kinetic_energy(0.0, &[1.0], &[0.0]).is_nan());
/// ```
pub trait System {
    /// One number per coordinate, in the order of the description: `[f64; N]` or `Vec<f64>`.
    type Vector: Vector;

    /// The square mass matrix, row after row: `[f64; N * N]` or `Vec<f64>`.
    type Matrix: Vector;

    /// The coordinates by name: a struct with a field for each, an array for a family. The rates use the same type.
    type Coordinates: Clone + Debug;

    /// The inputs by name, which the user sets while the machine runs. A struct without fields if there are none.
    type Inputs: Clone + Debug;

    /// The outputs by name, which the description defines. A struct without fields if there are none.
    type Outputs: Clone + Debug;

    /// Names and units of the coordinates, in order.
    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>>;

    /// Puts the numbers of a vector under the names of the coordinates.
    fn to_coordinates(&self, vector: &Self::Vector) -> Self::Coordinates;

    /// Puts the numbers of named coordinates into a vector.
    fn to_vector(&self, coordinates: &Self::Coordinates) -> Self::Vector;

    /// Accelerations `a = M⁻¹ f`, the solution of the equations of motion.
    ///
    /// Arguments that are not finite give accelerations that are not finite. The only error is a mass matrix that cannot be inverted.
    fn accelerations(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        u: &Self::Inputs,
        a: &mut Self::Vector,
    ) -> Result<(), Singular>;

    /// The number of equations of motion that `check_equations` checks at the start of a run: one for each coordinate, or 0 if the mass
    /// matrix and the forces do not cover all coordinates.
    #[inline]
    fn equations(&self) -> usize {
        self.coordinates().len()
    }

    // <quantities: forces>
    /// Mass matrix `M`. It is written in full, row after row. By default unknown: NaN.
    ///
    /// Needed for constraints, for contacts and wherever the equations are used without being solved.
    fn mass_matrix(&self, _t: f64, _q: &Self::Vector, matrix: &mut Self::Matrix) {
        matrix.as_mut_slice().fill(f64::NAN);
    }

    /// Bias `h`: velocity products and explicit time in the inertia forces. By default unknown: NaN.
    fn bias(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, bias: &mut Self::Vector) {
        bias.as_mut_slice().fill(f64::NAN);
    }

    /// Applied generalized forces `Q`. They are `−∂V/∂q − ∂D/∂v + …`. By default unknown: NaN.
    fn applied(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
        applied: &mut Self::Vector,
    ) {
        applied.as_mut_slice().fill(f64::NAN);
    }
    // </quantities>

    /// The right-hand side `f = Q − h` of `M a = f`. By default the difference of [`applied`](Self::applied) and
    /// [`bias`](Self::bias).
    fn forces(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        u: &Self::Inputs,
        forces: &mut Self::Vector,
    ) {
        let mut bias = forces.zeros_like();
        self.bias(t, q, v, &mut bias);
        self.applied(t, q, v, u, forces);
        for (force, bias) in forces.as_mut_slice().iter_mut().zip(bias.as_slice()) {
            *force -= bias;
        }
    }

    // <quantities: observed>
    /// Kinetic energy `T`, in J. By default unknown, NaN, and then a run has no energy balance.
    fn kinetic_energy(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector) -> f64 {
        f64::NAN
    }

    /// Potential energy `V`, in J. By default unknown, NaN, and then a run has no energy balance.
    fn potential_energy(&self, _t: f64, _q: &Self::Vector, _u: &Self::Inputs) -> f64 {
        f64::NAN
    }

    /// Energy `E` that states of first order store, in J. It is known as far as the description states it; by default it is 0.
    fn state_energy(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector) -> f64 {
        0.0
    }

    /// Dissipation function `D`, in W. It is that of Rayleigh. By default 0: nothing is damped.
    fn dissipation(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, _u: &Self::Inputs) -> f64 {
        0.0
    }

    /// Power `P` supplied by drives, forces and inputs, in W. It is the power of everything that is neither in `T + V` nor in `D`: drives
    /// (explicit time), applied forces, inputs, moving constraints (`−λ·∂g/∂t`, with the multipliers that belong to these accelerations),
    /// and the supply of first-order states that store energy. Along every motion `d(T + V + E)/dt = work_rate − dissipation_rate`. By
    /// default 0; if that is wrong, the energy balance shows it.
    fn work_rate(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _a: &Self::Vector,
        _u: &Self::Inputs,
    ) -> f64 {
        0.0
    }

    /// Power `R` dissipated by dampers, in W. It is `Σ vᵢ ∂D/∂vᵢ`, and the losses that the description names. By default 0.
    fn dissipation_rate(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
    ) -> f64 {
        0.0
    }
    // </quantities>

    /// Whether [`work_rate`](Self::work_rate) or [`dissipation_rate`](Self::dissipation_rate) may differ from 0 at any state. By default `true`; where
    /// it is `false`, a step need not be followed for the energy balance.
    #[doc(hidden)]
    #[inline(always)]
    fn has_powers(&self) -> bool {
        true
    }

    /// [`to_coordinates`](Self::to_coordinates) into memory that holds coordinates of this machine already.
    #[doc(hidden)]
    #[inline(always)]
    fn copy_to_coordinates(&self, vector: &Self::Vector, coordinates: &mut Self::Coordinates) {
        *coordinates = self.to_coordinates(vector);
    }

    /// The values of inputs that nobody sets: the defaults of the description.
    fn default_inputs(&self) -> Self::Inputs;

    /// Names, units and values of the inputs, in the order of the description. By default empty.
    fn input_values(
        &self,
        _inputs: &Self::Inputs,
    ) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    /// The outputs of the description.
    fn outputs(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        a: &Self::Vector,
        u: &Self::Inputs,
    ) -> Self::Outputs;

    /// Names, units and values of the outputs, in the order of the description. By default empty.
    fn output_values(
        &self,
        _outputs: &Self::Outputs,
    ) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    /// The facts that the description assumes, with the margins by which they hold at this state. By default empty.
    ///
    /// The equations may have been simplified by these facts, so a run ends where one of them ceases to hold.
    fn assumptions(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        core::iter::empty()
    }

    /// Whether the margins of all [`assumptions`](Self::assumptions) are linear in time, coordinates and rates, and depend on nothing else
    /// that changes. Then a few evaluations suffice to show that they hold throughout a step by Taylor series. By default `false`: unknown.
    #[inline(always)]
    fn has_linear_assumptions(&self) -> bool {
        false
    }

    /// Whether all [`assumptions`](Self::assumptions) are known to hold at all states within bounds: the lowest and the highest time in s, coordinates
    /// and rates. By default `false`: unknown.
    #[inline(always)]
    fn assumptions_hold_within(
        &self,
        _t: [f64; 2],
        _q: [&Self::Vector; 2],
        _v: [&Self::Vector; 2],
    ) -> bool {
        false
    }

    /// Whether there may be constraints. Emitted code says `false` for a machine without any, and no code for constraints is then
    /// compiled for it.
    #[doc(hidden)]
    const MAY_BE_CONSTRAINED: bool = true;

    /// Whether there may be guided contacts with friction; `false` leaves out their code.
    #[doc(hidden)]
    const MAY_SLIDE: bool = true;

    /// Whether there may be unilateral contacts; `false` leaves out their code.
    #[doc(hidden)]
    const MAY_COLLIDE: bool = true;

    /// The bilateral constraints, in the order of the rows below. By default
    /// there are none, and then the methods that follow need not be implemented.
    ///
    /// The accelerations of a machine with constraints obey them: `M a = f + Gᵀ λ`, `G a = γ`.
    #[inline(always)]
    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        core::iter::empty()
    }

    // <quantities: constraints>
    /// Residuals `g` of the constraints of positions; 0 for those of velocities alone. There is one for each constraint, and all are 0 if
    /// the state satisfies the constraints.
    #[inline(always)]
    fn constraint_positions(&self, _t: f64, _q: &Self::Vector, _positions: &mut [f64]) {}

    /// Residuals `φ = G v + ∂g/∂t` of the constraints at the level of velocities. There is one for each constraint, and all are 0 if the
    /// state satisfies the constraints.
    #[inline(always)]
    fn constraint_rates(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, _rates: &mut [f64]) {}

    /// Constraint matrix `G`, the derivatives of `φ` by the rates. It is written row after row.
    #[inline(always)]
    fn constraint_matrix(&self, _t: f64, _q: &Self::Vector, _matrix: &mut [f64]) {}

    /// Right-hand side `γ` of `G a = γ`. It is the condition on the accelerations under which the rates of the constraints stay constant.
    #[inline(always)]
    fn constraint_bias(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, _bias: &mut [f64]) {}
    // </quantities>

    /// Lagrange's multipliers `λ` of `M a = f + Gᵀ λ`, by the same elimination
    /// as the accelerations. An error if the constraints are linearly dependent.
    #[inline(always)]
    fn multipliers(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
        _multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        Ok(())
    }

    /// The projection of a state onto the constraints, to first order: the numbers that
    /// [`ProjectionLayout`](lagrangian_scalar::projection::ProjectionLayout) lists. `false` if the machine has no such function; then
    /// projections take more time.
    ///
    /// # Errors
    /// If the constraints are linearly dependent at this state.
    #[doc(hidden)]
    #[inline(always)]
    fn projection(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _numbers: &mut [f64],
    ) -> Result<bool, Singular> {
        Ok(false)
    }

    /// The names of the guided contacts with friction. By default there are none, and then the methods that follow need not be implemented.
    ///
    /// A machine with contacts finds its accelerations by
    /// [`accelerations_with_friction`](crate::accelerations_with_friction).
    #[inline(always)]
    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        core::iter::empty()
    }

    /// The number of components of the normal reaction of a guided contact: in the plane one, along the normal; in space three, along the
    /// axes of the ground, since there a guide can press in any direction across its tangent.
    #[inline(always)]
    fn reaction_axes(&self) -> usize {
        1
    }

    /// The guided contacts that are second tangents of surfaces, as a bit mask: if bit `k` is set, contact `k` slides on the same surface
    /// as contact `k − 1`, at right angles to it. It has the normal reaction and the coefficients of that contact, and the two obey
    /// Coulomb's law together. None by default.
    #[inline(always)]
    fn second_tangents(&self) -> u64 {
        0
    }

    // <quantities: guided contacts>
    /// Slips `w` of the guided contacts, in m/s. There is one for each contact, along its direction.
    #[inline(always)]
    fn slips(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, _slips: &mut [f64]) {}

    /// Slip matrix `τ`, the derivatives of the slips by the rates. It is written row after row.
    #[inline(always)]
    fn slip_matrix(&self, _t: f64, _q: &Self::Vector, _matrix: &mut [f64]) {}

    /// Rates `dw/dt` of the slips where all accelerations are 0.
    #[inline(always)]
    fn slip_bias(&self, _t: f64, _q: &Self::Vector, _v: &Self::Vector, _bias: &mut [f64]) {}
    // </quantities>

    /// Lower and upper bound of each slip, in m/s, given the rounding of the state, of the parameters and of the evaluation of the slips: a
    /// contact whose slip may be 0 sticks to within round-off. Bounds that are not finite carry no information.
    ///
    /// By default the effect of rounding is unknown, and both bounds equal the slip.
    fn slip_ranges(&self, t: f64, q: &Self::Vector, v: &Self::Vector, ranges: &mut [[f64; 2]]) {
        let mut slips = [0.0; MOST_CONTACTS];
        let slips = &mut slips[..ranges.len().min(MOST_CONTACTS)];
        self.slips(t, q, v, slips);
        for (range, slip) in ranges.iter_mut().zip(slips) {
            *range = [*slip; 2];
        }
    }

    /// The response to the friction forces `F` of the `k` contacts, which is affine: first the part without friction, then the increment
    /// per unit of each force. Each of these `1 + k` parts holds the accelerations, the multipliers of the constraints, `dw/dt` of each
    /// contact, and the [components](Self::reaction_axes) of the normal reaction `N` of each. Then follow the `k` coefficients `μ` of
    /// sliding and the `k` coefficients `μ₀` of sticking. In space there follow `k` unit vectors: the tangent of a curve, along which `N`
    /// has no component, or the normal of a surface, which is the direction of `N`.
    ///
    /// An error only if the machine is singular without friction.
    #[inline(always)]
    fn friction(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
        _parts: &mut [f64],
    ) -> Result<(), Singular> {
        Ok(())
    }

    /// The unilateral contacts, whose gaps open and close. By default there
    /// are none, and then the methods that follow need not be implemented.
    ///
    /// [`accelerations`](Self::accelerations) are those with all contacts open; a [`Simulation`](crate::Simulation) finds the effect of
    /// the closed ones.
    #[inline(always)]
    fn unilateral_contacts(&self) -> impl ExactSizeIterator<Item = UnilateralContact<'_>> {
        core::iter::empty()
    }

    // <quantities: unilateral contacts>
    /// Gaps `g` of the unilateral contacts, in m: positive where they are open.
    ///
    /// By default this, and each quantity of all contacts that follows, is that of [`of_contacts`](Self::of_contacts), one contact after
    /// the other, if [`single_contacts`](Self::single_contacts) are known.
    #[inline(always)]
    fn gaps(&self, t: f64, q: &Self::Vector, gaps: &mut [f64]) {
        write_each(self, ContactQuantity::Gap, (t, q, q), gaps);
    }

    /// Rates `γ` at which the gaps of unilateral contacts open and at which these slip, in m/s. There are two for each contact: `dg/dt`, at
    /// which its gap opens, and its slip rate.
    #[inline(always)]
    fn contact_rates(&self, t: f64, q: &Self::Vector, v: &Self::Vector, rates: &mut [f64]) {
        write_each(self, ContactQuantity::Rates, (t, q, v), rates);
    }

    /// Derivatives of the rates of unilateral contacts by the rates of the coordinates. They are written row after row, in the order of
    /// [`contact_rates`](Self::contact_rates).
    #[inline(always)]
    fn contact_matrix(&self, t: f64, q: &Self::Vector, matrix: &mut [f64]) {
        write_each(self, ContactQuantity::Rows, (t, q, q), matrix);
    }

    /// Rates `dγ/dt` of unilateral contacts where all accelerations are 0.
    #[inline(always)]
    fn contact_bias(&self, t: f64, q: &Self::Vector, v: &Self::Vector, bias: &mut [f64]) {
        write_each(self, ContactQuantity::Bias, (t, q, v), bias);
    }

    /// Coefficients of unilateral contacts: restitution along the normal and along the tangent (for compliant contacts the parameters of
    /// their force), friction, static friction. The law of a compliant contact is its [`Compliance`](crate::Compliance).
    #[inline(always)]
    fn contact_coefficients(
        &self,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        coefficients: &mut [f64],
    ) {
        write_each(self, ContactQuantity::Coefficients, (t, q, v), coefficients);
    }

    /// For each unilateral contact of a corner with a face of a polygon: the distance of the corner outside the face, and its distance
    /// beyond the ends of the face, negative between them, both in m; the rate of the second, in m/s. There are three numbers for each
    /// contact that is [with a face](UnilateralContact::has_face). The [gap](Self::gaps) is the larger of the first two;
    /// [rates](Self::contact_rates) are those of the face.
    #[inline(always)]
    fn contact_faces(&self, t: f64, q: &Self::Vector, v: &Self::Vector, faces: &mut [f64]) {
        write_each(self, ContactQuantity::Face, (t, q, v), faces);
    }
    // </quantities>

    /// How many of the unilateral contacts are guides: so many, behind all others. By default there are none.
    ///
    /// A guide holds its body from both sides, so that it is never open. Its gap, its rate along the normal and the row of that are 0; along
    /// its tangent it slips, with friction, like any contact. What presses is its normal reaction `N`, of either sign,
    ///
    /// ```text
    /// N = ν + ρ·a + χ·λ + Σ κ F,
    /// ```
    ///
    /// where `λ` are the multipliers of the constraints and `F` the forces along the normals and tangents of all contacts. The accelerations of the system
    /// are those without friction in guides. A machine whose guides are not beside unilateral contacts has them as [`contacts`](Self::contacts).
    #[inline(always)]
    fn guides(&self) -> usize {
        0
    }

    // <quantities: guides>
    /// What a unit of each acceleration, of each multiplier, and of a force along each direction of the unilateral contacts adds to the
    /// normal reactions of guides beside these. For each guide its `ρ`, with a number for each coordinate, its `χ`, with one for each
    /// constraint, and its `κ`, with two for each unilateral contact, along the normal and the tangent. There, the numbers for normals of
    /// guides are 0. [`guides`](Self::guides) defines these letters.
    #[inline(always)]
    fn guide_matrix(&self, _t: f64, _q: &Self::Vector, _matrix: &mut [f64]) {}

    /// The normal reactions of guides beside unilateral contacts where all accelerations, multipliers and forces of contacts are 0, in N.
    /// They are the `ν` of [`guides`](Self::guides).
    #[inline(always)]
    fn guide_loads(
        &self,
        _t: f64,
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
        _loads: &mut [f64],
    ) {
    }
    // </quantities>

    /// For each coordinate, and last for the time, whether any gap depends on it; `None` if [`of_contacts`](Self::of_contacts) and
    /// [`least_gaps`](Self::least_gaps) are not implemented, as by default. If they are, a run evaluates only the contacts that are near: with
    /// few contacts, evaluating all of them costs no more.
    #[inline(always)]
    fn single_contacts(&self) -> Option<&[bool]> {
        None
    }

    /// Writes a quantity of some unilateral contacts, by their indices, at a time and a state: their numbers one after the other, with the
    /// bits of the method for all contacts, if that is implemented too. Gaps and rows do not depend on the rates. Called only if [`single_contacts`](Self::single_contacts) are known.
    #[inline(always)]
    fn of_contacts(
        &self,
        _quantity: ContactQuantity,
        _which: &[usize],
        _state: (f64, &Self::Vector, &Self::Vector),
        _numbers: &mut [f64],
    ) {
    }

    /// Writes for each unilateral contact a number that its [gap](Self::gaps), in m, is at least, whenever the time is between two times,
    /// and each coordinate between two values; `-∞` where none is known. It includes the rounding of the evaluation of the gap. Called only if
    /// [`single_contacts`](Self::single_contacts) are known.
    #[inline(always)]
    fn least_gaps(&self, _t: [f64; 2], _q: [&Self::Vector; 2], least: &mut [f64]) {
        least.fill(f64::NEG_INFINITY);
    }

    /// The numbers that stay fixed when a start that violates the constraints is moved onto them: coordinates, `"theta"`, and rates,
    /// `"der(theta)"`. None by default. [`Simulation::keep`](crate::Simulation::keep) replaces them.
    #[inline(always)]
    fn kept_at_start(&self) -> impl ExactSizeIterator<Item = &str> {
        core::iter::empty()
    }

    /// Whether the machine has the Taylor series of its motion, [`series`](Self::series). By default it has none.
    ///
    /// # Errors
    /// The reason why it has none, as the end of a sentence whose subject is the machine: `it has constraints`.
    #[inline(always)]
    fn check_series(&self) -> Result<(), &str> {
        Err("its spec does not request one with `methods { taylor }`")
    }

    /// Computes the Taylor series of the motion through a state: row `j` of `coefficients` becomes `q⁽ʲ⁾/j!`, in SI units. There are at
    /// least three rows. Emitted code computes 24 rows and fills further ones with NaN. The time is the sum of two numbers, the second of
    /// which is the rounding error of the first. The first two rows are `q` and `v`; twice the third is the acceleration.
    ///
    /// Called only if [`check_series`](Self::check_series) succeeds.
    ///
    /// An error if the mass matrix cannot be inverted.
    #[inline(always)]
    fn series(
        &self,
        _t: [f64; 2],
        _q: &Self::Vector,
        _v: &Self::Vector,
        _u: &Self::Inputs,
        _coefficients: &mut [Self::Vector],
    ) -> Result<(), Singular> {
        Ok(())
    }

    /// [`series`](Self::series) with memory that is kept from call to call, in which emitted code writes what it need not clear each time.
    #[doc(hidden)]
    #[inline(always)]
    fn series_with(
        &self,
        _memory: &mut SeriesMemory,
        t: [f64; 2],
        (q, v): (&Self::Vector, &Self::Vector),
        u: &Self::Inputs,
        coefficients: &mut [Self::Vector],
    ) -> Result<(), Singular> {
        self.series(t, q, v, u, coefficients)
    }

    /// [`series`](Self::series) while unilateral contacts do this, of which at least one is closed; `None` if the motion has no series then, as by default. Of the directions in
    /// which closed contacts hold, 2k for the gap and 2k + 1 for the slip of contact k, some may be `dependent` on the others.
    #[cfg(feature = "std")]
    #[doc(hidden)]
    #[inline(always)]
    fn closed_series(
        &self,
        (_contacts, _dependent): (&[crate::ContactMode], &[usize]),
        _t: [f64; 2],
        (_q, _v): (&Self::Vector, &Self::Vector),
        _u: &Self::Inputs,
        _coefficients: &mut [Self::Vector],
    ) -> Option<Result<(), Singular>> {
        None
    }

    /// Whether the series of the motion may be that of another motion beyond some instant within a step, since a root of a quantity that may vanish
    /// occurs in it. By default `true`; emitted code says `false` where there is none.
    #[doc(hidden)]
    #[inline(always)]
    fn series_may_branch(&self) -> bool {
        true
    }

    /// The cost of a step by [`series`](Self::series), as a multiple of the cost of one evaluation of the accelerations in a step of
    /// `dop853`, with 12 and with 20 coefficients of the accelerations. It is an estimate from operation counts, by which
    /// [`Simulation::automatic`](https://docs.rs/lagrangian/latest/lagrangian/struct.Simulation.html#method.automatic) chooses. If it is
    /// unknown, `None`, the series is never chosen.
    #[inline(always)]
    fn series_cost(&self) -> Option<[f64; 2]> {
        None
    }

    /// What the powers of an energy balance add to these costs, in the same unit: to an evaluation, and to a step by series with 12 and with 20 coefficients. An
    /// estimate from operation counts, too; 0 where there are [no powers](Self::has_powers).
    #[doc(hidden)]
    #[inline(always)]
    fn powers_cost(&self) -> [f64; 3] {
        [0.0; 3]
    }

    /// If the series is derived only when [`check_series`](Self::check_series) is called for the first time: about how many evaluations of the
    /// accelerations in steps of `dop853` take as long; infinite where there is no series for certain. A run that chooses its method does not call it
    /// before. It is an estimate from operation counts, and the same whether the series has been derived or not.
    #[doc(hidden)]
    #[inline(always)]
    fn series_derivation(&self) -> Option<f64> {
        None
    }

    /// Calls `work` with the workspace in which a state is projected onto the constraints: `length` numbers of any value, or `None` if
    /// there is no workspace.
    ///
    /// By default it is allocated for each call, and without `std` there is none. A machine that knows its size hands out an array, whose
    /// length [`constraint_workspace`](crate::constraint_workspace) gives.
    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        #[cfg(feature = "std")]
        {
            work(Some(&mut std::vec![0.0; length]))
        }
        #[cfg(not(feature = "std"))]
        {
            let _ = length;
            work(None)
        }
    }
}

/// Writes a quantity of all contacts that have it, one after the other, by [`System::of_contacts`]; nothing where that is not implemented.
fn write_each<S: System + ?Sized>(
    system: &S,
    quantity: ContactQuantity,
    state: (f64, &S::Vector, &S::Vector),
    numbers: &mut [f64],
) {
    if system.single_contacts().is_none() {
        return;
    }
    let width = quantity.width(state.1.as_slice().len());
    let contacts = system.unilateral_contacts().enumerate();
    let have_it = contacts.filter(|(_, one)| quantity != ContactQuantity::Face || one.has_face);
    for ((contact, _), own) in have_it.zip(numbers.chunks_exact_mut(width.max(1))) {
        system.of_contacts(quantity, &[contact], state, own);
    }
}

/// Equations of motion that are evaluated in stages, so that what stays the same is not computed again: implicit methods, impacts and
/// friction iterate over rates while time and coordinates stay, and many states may share one time.
///
/// Implemented by the code of a description with `stages { time, coordinates }` or one of the two, and by the interpreter for every
/// machine. A stage that the description does not request passes its arguments on.
///
/// The accelerations agree with those of [`System::accelerations`] to rounding; sums and products are evaluated in another order.
///
/// ```
/// use lagrangian::{Staged, System};
///
/// lagrangian::machine! {
///     machine Braked in plane {
///         parameters { m: kg = 1, l: m = 1, b: N*m*s = 5, g: m/s^2 = 9.75 }
///         coordinates { theta: rad }
///         bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
///         gravity (0, -g);
///         dissipations { brake: b*der(theta)^2/2 }
///         stages { coordinates }
///     }
/// }
///
/// # fn main() -> Result<(), lagrangian::Singular> {
/// // A step that is implicit in the rates, v = v0 + h a(q, v): the place is evaluated once.
/// let brake = Braked::default().prepare();
/// let (h, v0, u) = (0.05, 2.0, brake.default_inputs());
/// let at = brake.at_position(&brake.at_time(0.0), &[0.5])?;
/// let (mut v, mut a) = ([v0], [0.0]);
/// for _ in 0..40 {
///     brake.accelerations_at(&at, &v, &u, &mut a)?;
///     v[0] = v0 + h * a[0];
/// }
/// // a = -b v - g sin q, so v = (v0 - h g sin q)/(1 + h b).
/// let exact = (v0 - h * 9.75 * 0.5_f64.sin()) / (1.0 + h * 5.0);
/// assert!((v[0] - exact).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "the accelerations of `{Self}` are not evaluated in stages",
    label = "needs stages",
    note = "add the line `stages {{ time, coordinates }}` to the description of the machine, or one of the two"
)]
pub trait Staged: System {
    /// The values that the next stage needs of the time.
    type AtTime: Clone + Debug;

    /// The values that the accelerations need of time and coordinates.
    type AtPosition: Clone + Debug;

    /// Computes the values that depend on time alone.
    fn at_time(&self, t: f64) -> Self::AtTime;

    /// Computes the values that depend on time and coordinates alone. An error if the accelerations do not exist there.
    fn at_position(
        &self,
        at: &Self::AtTime,
        q: &Self::Vector,
    ) -> Result<Self::AtPosition, Singular>;

    /// The accelerations `a` at rates `v` and inputs `u`. An error only if the description does not make the coordinates a stage.
    fn accelerations_at(
        &self,
        at: &Self::AtPosition,
        v: &Self::Vector,
        u: &Self::Inputs,
        a: &mut Self::Vector,
    ) -> Result<(), Singular>;
}

impl Singular {
    /// Name of the coordinate or constraint at which elimination stopped.
    pub fn name<'s, S: System>(&self, system: &'s S) -> &'s str {
        let name = match self.at {
            Pivot::Coordinate(index) => system.coordinates().nth(index).map(|row| row.name),
            Pivot::Constraint(index) => system.constraints().nth(index).map(|row| row.name),
            Pivot::Contact(index) | Pivot::NotDifferentiated(index) => {
                let mut unilateral = system.unilateral_contacts();
                let guide = system.contacts().nth(index);
                guide.or_else(|| unilateral.nth(index).map(|contact| contact.name))
            }
            Pivot::NoWorkspace => None,
        };
        name.unwrap_or("?")
    }
}
