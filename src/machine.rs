//! The parameters of a machine that an engineer sets: the trait [`Machine`], from which the equations of motion, a [`System`], follow.
//!
//! It is implemented by the code that `machine!` emits and by the interpreter.

use crate::{Quantity, State, System};

/// The parameters of a machine: a plain struct with a named field for each.
///
/// ```
/// # mod by_hand { include!("../tests/by_hand/double_pendulum.rs"); }
/// # use by_hand::DoublePendulum;
/// use lagrangian::{Machine, System};
///
/// let machine = DoublePendulum { l1: 0.5, ..Default::default() };
/// let start = machine.start(); //      the start values of the description, at t = 0
/// let system = machine.prepare(); //   whatever depends on parameters alone is computed here, once
/// assert_eq!(start.q.theta1, 0.1);
/// assert_eq!(system.coordinates().len(), 2);
/// ```
pub trait Machine {
    /// The equations of motion for one set of parameters.
    type System: System;

    /// The machine's name, as its description spells it.
    fn name(&self) -> &str;

    /// Every parameter with its value, in the order of the description.
    ///
    /// Simulations refuse parameters that are not finite, by name.
    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)>;

    /// Mutable access to the parameter with this index, in the order of [`parameters`](Self::parameters). The default returns `None`: a
    /// machine written by hand that does not implement this cannot be set by name.
    fn parameter_mut(&mut self, _index: usize) -> Option<&mut f64> {
        None
    }

    /// The value of the parameter of this name; a member of a family is named `m[2]`.
    ///
    /// # Errors
    /// If there is no such name; the error holds the name that was probably meant.
    #[cfg(feature = "std")]
    fn get(&self, name: &str) -> Result<f64, crate::UnknownName> {
        let found = self.parameters().find(|(of, _)| of.name == name);
        match found {
            Some((_, value)) => Ok(value),
            None => Err(crate::UnknownName::new(
                name,
                self.parameters().map(|(of, _)| of.name),
            )),
        }
    }

    /// Sets the parameter of this name; the name of a family sets all its members.
    ///
    /// # Errors
    /// If there is no such name; the error holds the name that was probably meant, and nothing is changed.
    ///
    /// ```
    /// use lagrangian::Machine;
    /// use lagrangian_machines::DoublePendulum;
    ///
    /// let mut pendulum = DoublePendulum::default();
    /// pendulum.set("l1", 0.5)?;
    /// assert_eq!((pendulum.l1, pendulum.get("l1")?), (0.5, 0.5));
    /// let unknown = pendulum.set("L1", 0.5).unwrap_err();
    /// assert_eq!(unknown.near.as_deref(), Some("l1"));
    /// # Ok::<(), lagrangian::UnknownName>(())
    /// ```
    #[cfg(feature = "std")]
    fn set(&mut self, name: &str, value: f64) -> Result<(), crate::UnknownName> {
        let meant =
            |of: &str| of == name || of.split_once('[').is_some_and(|(base, _)| base == name);
        let names: std::vec::Vec<std::string::String> =
            self.parameters().map(|(of, _)| of.name.into()).collect();
        let mut found = false;
        for (index, of) in names.iter().enumerate() {
            if meant(of)
                && let Some(parameter) = self.parameter_mut(index)
            {
                *parameter = value;
                found = true;
            }
        }
        if found {
            return Ok(());
        }
        let can_be_set =
            |(index, _): &(usize, &std::string::String)| self.parameter_mut(*index).is_some();
        let known: std::vec::Vec<_> = names.iter().enumerate().filter(can_be_set).collect();
        let known = known.iter().map(|(_, name)| name.as_str());
        Err(crate::UnknownName::new(name, known))
    }

    /// Computes what depends on the parameters alone, once.
    fn prepare(&self) -> Self::System;

    /// The start values of the description, at rest and `t = 0`.
    fn start(&self) -> State<Coordinates<Self>>;
}

/// The named coordinates of machine `M`: `q` and `v` of its states.
pub type Coordinates<M> = <<M as Machine>::System as System>::Coordinates;

/// The named inputs of machine `M`.
pub type Inputs<M> = <<M as Machine>::System as System>::Inputs;

/// The named outputs of machine `M`.
pub type Outputs<M> = <<M as Machine>::System as System>::Outputs;
