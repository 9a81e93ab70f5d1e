//! The traits of a machine in numbers of any kind: [`MachineIn`] and [`SystemIn`].

use core::fmt::Debug;

use crate::{Quantity, Real, Singular, State, Vector};

/// The parameters of a machine, in numbers `N`: `f32`, `f64`, double-doubles, or dual numbers of these.
///
/// Emitted code implements it for machines without constraints and contacts. The method `map` of a machine converts it to other
/// numbers: `machine.map(DoubleDouble::from_f64)`.
///
/// ```
/// use lagrangian::scalar::{DoubleDouble, Scalar};
/// use lagrangian::{ExplicitStepper, MachineIn, Real, StepError, SystemIn, Vector};
///
/// lagrangian::machine! {
///     machine Oscillator in plane {
///         parameters { m: kg = 2, k: N/m = 8 }
///         coordinates { x: m = 1 }
///         bodies { block { mass: m, at: (x, 0) } }
///         springs { spring { stiffness: k, stretch: x } }
///     }
/// }
///
/// /// The first coordinate after one second, in whatever numbers.
/// fn after_one_second<N: Real, M: MachineIn<N>>(machine: &M) -> Result<N, StepError> {
///     let mut stepper = ExplicitStepper::builder(machine.prepare()).start(machine.start())?;
///     stepper.advance_to(N::ONE)?;
///     Ok(stepper.q().as_slice()[0])
/// }
///
/// let machine = Oscillator::default();
/// let exact = DoubleDouble::from_f64(2.0).cos(); // cos √(k/m) t
/// assert!((after_one_second(&machine)? - exact.hi()).abs() < 1e-7);
/// assert!((after_one_second(&machine.map(|x| x as f32))? - exact.hi() as f32).abs() < 1e-3);
/// assert!((after_one_second(&machine.map(DoubleDouble::from_f64))? - exact).to_f64().abs() < 1e-22);
/// # Ok::<(), StepError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a machine in the numbers `{N}`",
    note = "a machine that `machine!` derives is one in f32, f64, double-doubles and dual numbers, where it has no constraints and \
            no contacts; `machine.map(…)` takes it to other numbers"
)]
pub trait MachineIn<N: Real> {
    /// The equations of motion for one set of parameters.
    type System: SystemIn<N>;

    /// Computes what depends on the parameters alone, once.
    fn prepare(&self) -> Self::System;

    /// The start values of the description, at `t = 0`.
    fn start(&self) -> State<<Self::System as SystemIn<N>>::Coordinates>;
}

/// The equations of motion of a machine without constraints and contacts, in numbers `N`: only what explicit methods need. For `f64`,
/// [`System`](crate::System) has the rest.
///
/// By hand, for x″ = −x in any numbers:
///
/// ```
/// use lagrangian::scalar::Dual;
/// use lagrangian::{ExplicitStepper, Quantity, Real, Singular, State, SystemIn};
///
/// struct Circle;
///
/// impl<N: Real> SystemIn<N> for Circle {
///     type Vector = [N; 1];
///     type Coordinates = N;
///     type Inputs = ();
///
///     fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
///         [Quantity::new("x", "m")].into_iter()
///     }
///
///     fn to_coordinates(&self, vector: &[N; 1]) -> N {
///         vector[0]
///     }
///
///     fn to_vector(&self, x: &N) -> [N; 1] {
///         [*x]
///     }
///
///     fn accelerations(&self, _t: N, q: &[N; 1], _v: &[N; 1], _u: &(), a: &mut [N; 1]) -> Result<(), Singular> {
///         a[0] = -q[0];
///         Ok(())
///     }
///
///     fn default_inputs(&self) {}
/// }
///
/// // How x = v₀ sin t after 1 s depends on the rate at the start.
/// let start = State { t: 0.0, q: Dual::constant(0.0), v: Dual::variable(1.0) };
/// let mut stepper = ExplicitStepper::builder(Circle).tolerance(1e-12).start(start)?;
/// stepper.advance_to(Dual::constant(1.0))?;
/// assert!((stepper.q()[0].derivative - 1.0_f64.sin()).abs() < 1e-10);
/// # Ok::<(), lagrangian::StepError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "the accelerations of `{Self}` are not known in the numbers `{N}`",
    note = "a machine that `machine!` derives knows them in f32, f64, double-doubles and dual numbers, where it has no constraints \
            and no contacts"
)]
pub trait SystemIn<N: Real> {
    /// One number per coordinate, in the order of the description.
    type Vector: Vector<N>;

    /// The coordinates by name. The rates use the same type.
    type Coordinates: Clone + Debug;

    /// The inputs by name.
    type Inputs: Clone + Debug;

    /// Names and units of the coordinates, in order.
    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>>;

    /// Puts the numbers of a vector under the names of the coordinates.
    fn to_coordinates(&self, vector: &Self::Vector) -> Self::Coordinates;

    /// Puts the numbers of named coordinates into a vector.
    fn to_vector(&self, coordinates: &Self::Coordinates) -> Self::Vector;

    /// Accelerations `a = M⁻¹ f`, at time `t` in s.
    ///
    /// # Errors
    /// If the mass matrix cannot be inverted.
    fn accelerations(
        &self,
        t: N,
        q: &Self::Vector,
        v: &Self::Vector,
        u: &Self::Inputs,
        a: &mut Self::Vector,
    ) -> Result<(), Singular>;

    /// The values of inputs that nobody sets.
    fn default_inputs(&self) -> Self::Inputs;
}
