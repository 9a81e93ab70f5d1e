//! The same machine at several states, or with several sets of parameters, at once.

use lagrangian_native::Lanes;

use crate::{Singular, System, Vector};

/// `N` systems of one kind, evaluated at once, in the lanes of the processor's registers: for
/// sweeps over parameters or start values, where one evaluation does not wait for another. `N` is
/// 2, 4 or 8.
///
/// A lane's result is that of the system alone, bit for bit, whatever the other lanes hold.
///
/// No lane stops the others. One whose parameters leave it without accelerations gets NaN; one
/// whose mass matrix becomes singular on the way gets what division by a vanished pivot gives.
/// There is no error: where [`System::accelerations`] refuses because rounding has left too little
/// of a pivot, a lane may hold numbers of no worth.
///
/// ```
/// use lagrangian::{Lanes, Several};
/// use lagrangian_machines::DoublePendulum;
///
/// // Four pendulums, each with another upper rod, in the same state.
/// let lengths = [0.5, 1.0, 1.5, 2.0];
/// let systems = lengths.map(|l1| DoublePendulum { l1, ..Default::default() }.prepare());
/// let four = Several::new(systems.each_ref());
///
/// let q = [Lanes::splat(0.3), Lanes::splat(-0.2)];
/// let v = [Lanes::splat(0.0); 2];
/// let u = four.default_inputs(&systems[0]);
/// let a = four.accelerations(Lanes::splat(0.0), &q, &v, &u);
/// assert!(a[0][0].abs() > a[0][3].abs()); // the shortest starts fastest
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Several<S: Abreast<N>, const N: usize> {
    equations: S::Several,
    /// The lanes that have no accelerations at all, where there are any.
    singular: Option<[bool; N]>,
}

impl<S: Abreast<N>, const N: usize> Several<S, N> {
    /// A system for each lane.
    pub fn new(systems: [&S; N]) -> Self {
        let singular = systems.map(S::is_singular);
        Several {
            equations: S::abreast(systems),
            singular: singular.contains(&true).then_some(singular),
        }
    }

    /// The same system in every lane.
    pub fn of(system: &S) -> Self {
        Several::new([system; N])
    }

    /// What emitted functions take for these systems.
    pub fn equations(&self) -> &S::Several {
        &self.equations
    }

    /// Accelerations `a = M⁻¹ f` of every lane: at time `t`, coordinates `q`, rates `v` and inputs
    /// `u` of that lane.
    pub fn accelerations(
        &self,
        t: Lanes<N>,
        q: &S::Vectors,
        v: &S::Vectors,
        u: &S::SeveralInputs,
    ) -> S::Vectors {
        // No lane stops the others, so there is no error; were there one, it would concern all of
        // them.
        let (mut a, is_error) = match S::accelerations_abreast(&self.equations, t, q, v, u) {
            Ok(a) => (a, false),
            Err(_) => (S::Vectors::ZEROS, true),
        };
        if is_error || self.singular.is_some() {
            let undefined = self.singular.filter(|_| !is_error).unwrap_or([true; N]);
            for row in a.as_mut() {
                for (number, _) in row.0.iter_mut().zip(undefined).filter(|(_, is)| *is) {
                    *number = f64::NAN;
                }
            }
        }
        a
    }

    /// A vector for each lane, side by side.
    pub fn vectors(&self, vectors: [&S::Vector; N]) -> S::Vectors {
        let mut rows = S::Vectors::ZEROS;
        for (lane, vector) in vectors.iter().enumerate() {
            for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
                row[lane] = *number;
            }
        }
        rows
    }

    /// Inputs for each lane, side by side.
    pub fn inputs(&self, inputs: [&S::Inputs; N]) -> S::SeveralInputs {
        S::inputs_abreast(inputs)
    }

    /// The inputs that nobody sets, in every lane.
    pub fn default_inputs(&self, system: &S) -> S::SeveralInputs {
        S::inputs_abreast([&system.default_inputs(); N])
    }
}

/// Equations of motion of which `N` can be evaluated at once, by [`Several`]. Emitted code
/// implements it.
pub trait Abreast<const N: usize>: System {
    /// The equations of `N` systems.
    type Several: Clone + Copy + core::fmt::Debug;
    /// One row of lanes per coordinate, in the order of the description.
    type Vectors: LaneVector<N>;
    /// The inputs of `N` systems by name.
    type SeveralInputs;

    /// The equations of these systems.
    fn abreast(systems: [&Self; N]) -> Self::Several;

    /// Inputs for each of them.
    fn inputs_abreast(inputs: [&Self::Inputs; N]) -> Self::SeveralInputs;

    /// Whether the parameters alone leave the system without accelerations.
    fn is_singular(&self) -> bool;

    /// [`System::accelerations`] of every lane.
    fn accelerations_abreast(
        several: &Self::Several,
        t: Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::SeveralInputs,
    ) -> Result<Self::Vectors, Singular>;
}

/// `[Lanes<N>; D]`: a row of `N` lanes for each of D coordinates.
pub trait LaneVector<const N: usize>: Copy + AsRef<[Lanes<N>]> + AsMut<[Lanes<N>]> {
    /// Zeros everywhere.
    const ZEROS: Self;
}

impl<const N: usize, const D: usize> LaneVector<N> for [Lanes<N>; D] {
    const ZEROS: Self = [Lanes::splat(0.0); D];
}
