//! Laws that set the inputs while a machine runs.

use crate::piece::{NoPiece, Piece};
use crate::{Real, System, SystemIn};

/// A law that sets the inputs of a machine while it runs.
///
/// It must depend on its arguments alone, because steps are tried more than once and evaluate it ahead of time. A law that reads a
/// cell may change between steps, if the stepper is notified ([`Stepper::inputs_changed`](crate::Stepper::inputs_changed)): otherwise
/// the stepper would use the acceleration at the end of the last step, which is outdated then.
pub trait InputLaw<S: System> {
    /// Sets the inputs for an instant. `inputs` holds the defaults, or what this law set before.
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs);

    /// Whether the inputs are the same at all times and states, so that the motion may be expanded in a series. False by default.
    fn is_constant(&self) -> bool {
        false
    }

    /// The piece of time that a run enters at `t`, forward or backward in time, in which the inputs are smooth enough for a method of
    /// this order. Steps of a [`Simulation`](crate::Simulation) end at the end of the piece. By default all of time.
    ///
    /// # Errors
    /// If the inputs are not known from there on.
    fn piece(&self, _t: f64, _forward: bool, _order: u32) -> Result<Piece, NoPiece<'_>> {
        Ok(Piece::ALL)
    }

    /// Sets the inputs for an instant of a piece, and at its ends the limits from within. By default calls [`set`](Self::set).
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

    /// Whether the inputs are the same at all times and states within each [piece](Self::piece). By
    /// default [`is_constant`](Self::is_constant).
    fn is_constant_in_pieces(&self) -> bool {
        self.is_constant()
    }

    /// Whether it leaves some inputs unchanged, which a [`sampled`](crate::Simulation::sampled) controller may then set.
    /// False by default.
    fn is_partial(&self) -> bool {
        false
    }

    /// Whether it sets nothing and need not be called. False by default.
    #[doc(hidden)]
    fn sets_nothing(&self) -> bool {
        false
    }
}

/// Forwards everything except `set` to another law.
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

/// A law that sets the inputs in numbers `N` for an [`ExplicitStepper`](crate::ExplicitStepper): an [`InputLaw`] for numbers of any
/// kind. It must depend on its arguments alone.
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

/// The inputs are a function of time and state: `|t, q, v, u| u.torque = -k * q.theta`.
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

/// The inputs are constant until others are set.
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

/// A law of any type behind a pointer, at the cost of an indirect call at each evaluation. Clones share the law.
#[cfg(feature = "std")]
pub struct AnyInputs<'a, S: System>(std::sync::Arc<dyn InputLaw<S> + Send + Sync + 'a>);

#[cfg(feature = "std")]
impl<'a, S: System> AnyInputs<'a, S> {
    /// Wraps a law.
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

/// The law of a simulation, of any type, so that a run is compiled once for a machine and not for each law. It makes no call for
/// inputs that keep their defaults.
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

/// The law of a simulation within a piece of time, and the inputs of a sampled controller.
#[cfg(feature = "std")]
#[derive(Debug)]
pub(crate) struct LawInPiece<'r, L, I> {
    pub law: &'r L,
    /// The inputs of a sampled controller; the law may set other inputs.
    pub sampled: Option<I>,
    /// The piece of time that contains the present time.
    pub piece: Piece,
}

#[cfg(feature = "std")]
impl<L, I: Clone> Clone for LawInPiece<'_, L, I> {
    fn clone(&self) -> Self {
        Self {
            law: self.law,
            sampled: self.sampled.clone(),
            piece: self.piece,
        }
    }
}

#[cfg(feature = "std")]
impl<S: System, L: InputLaw<S>> InputLaw<S> for LawInPiece<'_, L, S::Inputs> {
    #[inline(always)]
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        if let Some(held) = &self.sampled {
            inputs.clone_from(held);
            if !self.law.is_partial() {
                return;
            }
        }
        self.law.set_in(self.piece, system, t, q, v, inputs);
    }

    fn is_constant(&self) -> bool {
        (self.sampled.is_some() && !self.law.is_partial()) || self.law.is_constant_in_pieces()
    }
}
