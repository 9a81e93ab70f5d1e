//! How inputs are set while a machine runs.

use crate::piece::{NoPiece, Piece};
use crate::{Real, System, SystemIn};

/// How a machine's inputs are set while it runs.
///
/// Must depend on its arguments alone: a step is tried more than once, and looks ahead. A law that
/// reads a cell may change between steps, if the stepper is told
/// ([`Stepper::inputs_changed`](crate::Stepper::inputs_changed)): it goes on with the acceleration at the end of the last step, which
/// is another one then.
pub trait InputLaw<S: System> {
    /// Sets the inputs for an instant. `inputs` holds the defaults, or what this very law set
    /// before.
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs);

    /// Whether the inputs are the same at all times and states: then the motion may be expanded in a series. False by
    /// default.
    fn is_constant(&self) -> bool {
        false
    }

    /// The piece of time that a run enters at `t`, later or earlier, in which the inputs are smooth enough for a method of this
    /// order: a step of a [`Simulation`](crate::Simulation) ends where it ends. All of time by default.
    ///
    /// # Errors
    /// Where the inputs are not known from there on.
    fn piece(&self, _t: f64, _forward: bool, _order: u32) -> Result<Piece, NoPiece<'_>> {
        Ok(Piece::ALL)
    }

    /// Sets the inputs for an instant of a piece: at its ends what they tend to from within. As [`set`](Self::set) by default.
    #[inline(always)]
    fn set_in(
        &self,
        _piece: Piece,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        inputs: &mut S::Inputs,
    ) {
        self.set(system, t, q, v, inputs);
    }

    /// Whether the inputs are the same at all times and states within each [piece](Self::piece). As
    /// [`is_constant`](Self::is_constant) by default.
    fn is_constant_in_pieces(&self) -> bool {
        self.is_constant()
    }

    /// Whether it leaves some inputs as they are, so that somebody else may set these:
    /// [`sampled`](crate::Simulation::sampled). False by default.
    fn is_partial(&self) -> bool {
        false
    }

    /// Whether it sets nothing at all, and so need not be called. False by default.
    #[doc(hidden)]
    fn sets_nothing(&self) -> bool {
        false
    }
}

/// Everything but `set`, as another law has it.
macro_rules! as_of {
    ($self:ident, $law:expr) => {
        fn is_constant(&$self) -> bool {
            $law.is_constant()
        }

        fn piece(&$self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
            $law.piece(t, forward, order)
        }

        #[inline(always)]
        fn set_in(
            &$self,
            piece: Piece,
            system: &S,
            t: f64,
            q: &S::Vector,
            v: &S::Vector,
            inputs: &mut S::Inputs,
        ) {
            $law.set_in(piece, system, t, q, v, inputs);
        }

        fn is_constant_in_pieces(&$self) -> bool {
            $law.is_constant_in_pieces()
        }

        fn is_partial(&$self) -> bool {
            $law.is_partial()
        }

        fn sets_nothing(&$self) -> bool {
            $law.sets_nothing()
        }
    };
}

impl<S: System, L: InputLaw<S>> InputLaw<S> for &L {
    #[inline(always)]
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        (**self).set(system, t, q, v, inputs);
    }

    as_of!(self, (**self));
}

/// How a machine's inputs are set while it runs in numbers `N` by an [`ExplicitStepper`](crate::ExplicitStepper): an [`InputLaw`]
/// for numbers of any kind. Must depend on its arguments alone.
pub trait InputLawIn<S: SystemIn<N>, N: Real> {
    /// Sets the inputs for an instant. `inputs` holds the defaults.
    fn set(&self, system: &S, t: N, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs);
}

/// The inputs keep the defaults of the description.
#[derive(Clone, Copy, Debug, Default)]
pub struct DefaultInputs;

impl<S: System> InputLaw<S> for DefaultInputs {
    #[inline(always)]
    fn set(&self, _: &S, _: f64, _: &S::Vector, _: &S::Vector, _: &mut S::Inputs) {}

    fn is_constant(&self) -> bool {
        true
    }

    fn is_partial(&self) -> bool {
        true
    }

    fn sets_nothing(&self) -> bool {
        true
    }
}

/// The inputs are what a function makes of time and state: `|t, q, v, u| u.torque = -k * q.theta`.
#[derive(Clone, Copy, Debug)]
pub struct InputFunction<F>(pub F);

impl<S, F> InputLaw<S> for InputFunction<F>
where
    S: System,
    F: Fn(f64, &S::Coordinates, &S::Coordinates, &mut S::Inputs),
{
    #[inline]
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        *inputs = system.default_inputs();
        (self.0)(
            t,
            &system.to_coordinates(q),
            &system.to_coordinates(v),
            inputs,
        );
    }
}

impl<S, N, F> InputLawIn<S, N> for InputFunction<F>
where
    S: SystemIn<N>,
    N: Real,
    F: Fn(N, &S::Coordinates, &S::Coordinates, &mut S::Inputs),
{
    #[inline]
    fn set(&self, system: &S, t: N, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        (self.0)(
            t,
            &system.to_coordinates(q),
            &system.to_coordinates(v),
            inputs,
        );
    }
}

/// The inputs are what was set last, and stay so.
#[derive(Clone, Debug)]
pub struct HeldInputs<I>(pub I);

impl<S: System> InputLaw<S> for HeldInputs<S::Inputs> {
    #[inline(always)]
    fn set(&self, _: &S, _: f64, _: &S::Vector, _: &S::Vector, inputs: &mut S::Inputs) {
        inputs.clone_from(&self.0);
    }

    fn is_constant(&self) -> bool {
        true
    }
}

impl<S: SystemIn<N>, N: Real> InputLawIn<S, N> for HeldInputs<S::Inputs> {
    #[inline(always)]
    fn set(&self, _: &S, _: N, _: &S::Vector, _: &S::Vector, inputs: &mut S::Inputs) {
        inputs.clone_from(&self.0);
    }
}

/// Inputs that are set in whatever way: of one type for all laws, at the price of a call through a pointer at each evaluation. Copies
/// share the law.
#[cfg(feature = "std")]
pub struct AnyInputs<'a, S: System>(std::sync::Arc<dyn InputLaw<S> + Send + Sync + 'a>);

#[cfg(feature = "std")]
impl<'a, S: System> AnyInputs<'a, S> {
    /// The inputs of this law.
    pub fn new(law: impl InputLaw<S> + Send + Sync + 'a) -> Self {
        Self(std::sync::Arc::new(law))
    }
}

#[cfg(feature = "std")]
impl<S: System> Default for AnyInputs<'_, S> {
    /// The defaults of the description.
    fn default() -> Self {
        Self::new(DefaultInputs)
    }
}

#[cfg(feature = "std")]
impl<S: System> Clone for AnyInputs<'_, S> {
    fn clone(&self) -> Self {
        Self(std::sync::Arc::clone(&self.0))
    }
}

#[cfg(feature = "std")]
impl<S: System> core::fmt::Debug for AnyInputs<'_, S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("AnyInputs").finish_non_exhaustive()
    }
}

#[cfg(feature = "std")]
impl<S: System> InputLaw<S> for AnyInputs<'_, S> {
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        self.0.set(system, t, q, v, inputs);
    }

    as_of!(self, self.0);
}

/// The law of a simulation, whatever its type: a run is compiled once for a machine, and not again for each law that drives it. Of
/// inputs that keep their defaults it knows so, and makes no call.
#[cfg(feature = "std")]
pub(crate) struct Law<'r, S: System>(Option<&'r dyn InputLaw<S>>);

#[cfg(feature = "std")]
impl<'r, S: System> Law<'r, S> {
    pub fn of(law: &'r impl InputLaw<S>) -> Self {
        Self((!law.sets_nothing()).then_some(law as &dyn InputLaw<S>))
    }
}

#[cfg(feature = "std")]
impl<S: System> InputLaw<S> for Law<'_, S> {
    #[inline(always)]
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        if let Some(law) = self.0 {
            law.set(system, t, q, v, inputs);
        }
    }

    fn is_constant(&self) -> bool {
        self.0.is_none_or(InputLaw::is_constant)
    }

    fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        match self.0 {
            Some(law) => law.piece(t, forward, order),
            None => Ok(Piece::ALL),
        }
    }

    #[inline(always)]
    fn set_in(
        &self,
        piece: Piece,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        inputs: &mut S::Inputs,
    ) {
        if let Some(law) = self.0 {
            law.set_in(piece, system, t, q, v, inputs);
        }
    }

    fn is_constant_in_pieces(&self) -> bool {
        self.0.is_none_or(InputLaw::is_constant_in_pieces)
    }

    fn is_partial(&self) -> bool {
        self.0.is_none_or(InputLaw::is_partial)
    }

    fn sets_nothing(&self) -> bool {
        self.0.is_none()
    }
}

/// The law of a simulation within a piece of time, and what a sampled controller holds.
#[cfg(feature = "std")]
#[derive(Debug)]
pub(crate) struct Held<'r, L, I> {
    pub law: &'r L,
    /// What a sampled controller holds; the law may set other inputs beside these.
    pub held: Option<I>,
    /// Where the run is.
    pub piece: Piece,
}

#[cfg(feature = "std")]
impl<L, I: Clone> Clone for Held<'_, L, I> {
    fn clone(&self) -> Self {
        Self {
            law: self.law,
            held: self.held.clone(),
            piece: self.piece,
        }
    }
}

#[cfg(feature = "std")]
impl<S: System, L: InputLaw<S>> InputLaw<S> for Held<'_, L, S::Inputs> {
    #[inline(always)]
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        if let Some(held) = &self.held {
            inputs.clone_from(held);
            if !self.law.is_partial() {
                return;
            }
        }
        self.law.set_in(self.piece, system, t, q, v, inputs);
    }

    fn is_constant(&self) -> bool {
        (self.held.is_some() && !self.law.is_partial()) || self.law.is_constant_in_pieces()
    }
}
