//! The energy balance, integrated along the motion.

#[cfg(feature = "std")]
use std::vec::Vec;

use crate::System;
use crate::compensated::Sum;
use crate::methods::MAX_STAGES;

/// Integrals along a motion: none, or those of its energy balance.
///
/// The two implementations are [`NoBalance`], which compiles to nothing, and [`EnergyIntegrals`]; there are no others, since the
/// steps of a run and its quadratures must have the same weights.
pub trait Quadratures<S: System>: Clone + sealed::Sealed {
    /// Evaluates the powers at one stage of a step.
    #[doc(hidden)]
    fn stage(
        &mut self,
        stage: usize,
        system: &S,
        at: (f64, &S::Vector, &S::Vector, &S::Vector),
        u: &S::Inputs,
    );

    /// Takes the powers at one stage of a step that were evaluated elsewhere: work and losses, in W.
    #[doc(hidden)]
    #[inline(always)]
    fn take(&mut self, _stage: usize, _work: f64, _lost: f64) {}

    /// Adds powers to those of a stage: work and losses, in W.
    #[doc(hidden)]
    #[inline(always)]
    fn add(&mut self, _stage: usize, _work: f64, _lost: f64) {}

    /// Adds the work and losses of an instant, in J.
    #[doc(hidden)]
    #[inline(always)]
    fn add_instantaneous(&mut self, _work: f64, _lost: f64) {}

    /// Sets the share of each unilateral contact in the powers of a stage, in W; contacts without an entry have none.
    #[doc(hidden)]
    #[cfg(feature = "std")]
    fn set_contact_shares(&mut self, _stage: usize, _of_each: &[ContactShare]) {}

    /// Adds the share of a unilateral contact in the work and losses of an instant, in J.
    #[doc(hidden)]
    #[cfg(feature = "std")]
    fn add_instantaneous_share(&mut self, _contact: usize, _part: ContactShare) {}

    /// Adds a step of length `h` whose stages have the weights `b`; the stage after them is the first of the next step.
    #[doc(hidden)]
    fn advance(&mut self, h: f64, b: &[f64]);

    /// Undoes the last step, with weights `b`.
    #[doc(hidden)]
    fn retreat(&mut self, b: &[f64]);

    /// Mutable access to the integrals of the energy balance.
    #[doc(hidden)]
    fn integrals_mut(&mut self) -> Option<&mut EnergyIntegrals> {
        None
    }

    /// The integrals of the energy balance, if it is kept.
    fn integrals(&self) -> Option<&EnergyIntegrals>;
}

/// The share of a unilateral contact: powers in W, or energies in J.
#[cfg(feature = "std")]
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactShare {
    /// Losses by its friction, without impacts.
    pub friction: f64,
    /// Losses in its compliance, by damping or by the energy left when it opens; for a layer the work that crushes it.
    pub compliance_loss: f64,
    /// Work that prescribed motion does against its forces.
    pub work: f64,
}

#[cfg(feature = "std")]
impl ContactShare {
    fn of([friction, compliance_loss, work]: [f64; 3]) -> ContactShare {
        ContactShare {
            friction,
            compliance_loss,
            work,
        }
    }

    fn numbers(self) -> [f64; 3] {
        [self.friction, self.compliance_loss, self.work]
    }
}

mod sealed {
    /// Prevents implementations elsewhere.
    pub trait Sealed {}
    impl Sealed for super::NoBalance {}
    impl Sealed for super::EnergyIntegrals {}
    impl Sealed for Option<super::EnergyIntegrals> {}
}

/// No energy balance is kept, at no cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBalance;

impl<S: System> Quadratures<S> for NoBalance {
    #[inline(always)]
    fn stage(
        &mut self,
        _stage: usize,
        _system: &S,
        _at: (f64, &S::Vector, &S::Vector, &S::Vector),
        _u: &S::Inputs,
    ) {
    }

    #[inline(always)]
    fn advance(&mut self, _h: f64, _b: &[f64]) {}

    #[inline(always)]
    fn retreat(&mut self, _b: &[f64]) {}

    fn integrals(&self) -> Option<&EnergyIntegrals> {
        None
    }
}

/// The time integrals of the powers of a machine, by the same method and steps as its motion. They do not affect the choice of
/// steps; if a step is too long for them, a run integrates them again along it.
#[derive(Clone, Debug, Default)]
pub struct EnergyIntegrals {
    /// The integrals of the work rate, its absolute value, and dissipation rate.
    own: Integrals,
    /// The integrals of the shares of each unilateral contact; empty until one has a share.
    #[cfg(feature = "std")]
    of_contacts: Vec<Integrals>,
}

/// Three powers and their integrals.
#[derive(Clone, Copy, Debug, Default)]
struct Integrals {
    /// The powers at each stage.
    rates: [[f64; 3]; MAX_STAGES],
    sums: [Sum; 3],
    sums_before: [Sum; 3],
    /// The last step's contribution to the sums.
    last: [f64; 3],
}

impl Integrals {
    fn add_instantaneous(&mut self, by: [f64; 3]) {
        for (sum, by) in self.sums.iter_mut().zip(by) {
            *sum = sum.plus(by);
        }
    }

    #[inline]
    fn advance(&mut self, h: f64, b: &[f64]) {
        self.sums_before = self.sums;
        for (i, sum) in self.sums.iter_mut().enumerate() {
            let mean: f64 = b
                .iter()
                .zip(&self.rates)
                .map(|(weight, rate)| weight * rate[i])
                .sum();
            self.last[i] = h * mean;
            *sum = sum.plus(self.last[i]);
        }
        self.rates.swap(0, b.len());
    }

    fn retreat(&mut self, b: &[f64]) {
        self.sums = self.sums_before;
        self.rates.swap(0, b.len());
    }

    #[cfg(feature = "std")]
    fn replace_last(&mut self, by: [f64; 3]) {
        for ((sum, last), by) in self.sums.iter_mut().zip(&mut self.last).zip(by) {
            *sum = sum.plus(by - *last);
            *last = by;
        }
    }
}

impl EnergyIntegrals {
    /// Work done on the machine so far by drives, applied forces and inputs, in J.
    pub fn work(&self) -> f64 {
        self.own.sums[0].high
    }

    /// The integral of the absolute value of the work rate, in J: work that is done and returned counts twice.
    pub fn absolute_work(&self) -> f64 {
        self.own.sums[1].high
    }

    /// Energy lost in dampers and by friction so far, in J.
    pub fn dissipated(&self) -> f64 {
        self.own.sums[2].high
    }

    /// The energies of a unilateral contact so far, in J.
    #[cfg(feature = "std")]
    pub(crate) fn of_contact(&self, contact: usize) -> ContactShare {
        let sums = self.of_contacts.get(contact).map(|of| of.sums);
        ContactShare::of(sums.unwrap_or_default().map(|sum| sum.high))
    }

    /// Its powers at the beginning of the next step, in W.
    #[cfg(feature = "std")]
    pub(crate) fn power_of(&self, contact: usize) -> ContactShare {
        let rates = self.of_contacts.get(contact).map(|of| of.rates[0]);
        ContactShare::of(rates.unwrap_or_default())
    }

    /// All powers at a stage of the last step, in W: work rate, its absolute value and dissipation rate, then three for each
    /// unilateral contact.
    #[cfg(feature = "std")]
    pub(crate) fn rates(&self, stage: usize) -> impl Iterator<Item = [f64; 3]> {
        let all = core::iter::once(&self.own).chain(&self.of_contacts);
        all.map(move |of| of.rates[stage])
    }

    /// Replaces the integrals over the last step, which used the weights of the method, by others, in J, in the order
    /// of [`rates`](Self::rates).
    #[cfg(feature = "std")]
    pub(crate) fn replace_last(&mut self, by: &[[f64; 3]]) {
        let all = core::iter::once(&mut self.own).chain(&mut self.of_contacts);
        for (of, by) in all.zip(by) {
            of.replace_last(*by);
        }
    }

    /// By how much [`replace_last`](Self::replace_last) would change the integrals of the machine, in J.
    #[cfg(feature = "std")]
    pub(crate) fn change_of_last(&self, by: &[[f64; 3]]) -> [f64; 3] {
        let by = by.first().copied().unwrap_or(self.own.last);
        core::array::from_fn(|i| by[i] - self.own.last[i])
    }

    #[cfg(feature = "std")]
    fn at_least(&mut self, contacts: usize) {
        if self.of_contacts.len() < contacts {
            self.of_contacts.resize(contacts, Integrals::default());
        }
    }
}

impl<S: System> Quadratures<S> for EnergyIntegrals {
    #[inline]
    fn stage(
        &mut self,
        stage: usize,
        system: &S,
        (t, q, v, a): (f64, &S::Vector, &S::Vector, &S::Vector),
        u: &S::Inputs,
    ) {
        let work_rate = system.work_rate(t, q, v, a, u);
        self.own.rates[stage] = [
            work_rate,
            work_rate.abs(),
            system.dissipation_rate(t, q, v, u),
        ];
    }

    fn take(&mut self, stage: usize, work: f64, lost: f64) {
        self.own.rates[stage] = [work, work.abs(), lost];
    }

    #[inline]
    fn add(&mut self, stage: usize, work: f64, lost: f64) {
        let [rate, absolute, dissipation] = &mut self.own.rates[stage];
        *rate += work;
        *absolute = rate.abs();
        *dissipation += lost;
    }

    fn add_instantaneous(&mut self, work: f64, lost: f64) {
        self.own.add_instantaneous([work, work.abs(), lost]);
    }

    #[cfg(feature = "std")]
    fn set_contact_shares(&mut self, stage: usize, of_each: &[ContactShare]) {
        self.at_least(of_each.len());
        for (k, of) in self.of_contacts.iter_mut().enumerate() {
            of.rates[stage] = of_each.get(k).copied().unwrap_or_default().numbers();
        }
    }

    #[cfg(feature = "std")]
    fn add_instantaneous_share(&mut self, contact: usize, part: ContactShare) {
        self.at_least(contact + 1);
        self.of_contacts[contact].add_instantaneous(part.numbers());
    }

    #[inline]
    fn advance(&mut self, h: f64, b: &[f64]) {
        self.own.advance(h, b);
        #[cfg(feature = "std")]
        for of in &mut self.of_contacts {
            of.advance(h, b);
        }
    }

    fn retreat(&mut self, b: &[f64]) {
        self.own.retreat(b);
        #[cfg(feature = "std")]
        for of in &mut self.of_contacts {
            of.retreat(b);
        }
    }

    fn integrals(&self) -> Option<&EnergyIntegrals> {
        Some(self)
    }

    fn integrals_mut(&mut self) -> Option<&mut EnergyIntegrals> {
        Some(self)
    }
}

/// Whether the balance is kept is known at run time. A simulation is compiled once for both: the test at each stage is negligible
/// beside an evaluation, and a second copy of the whole run would double the build time.
impl<S: System> Quadratures<S> for Option<EnergyIntegrals> {
    #[inline(always)]
    fn stage(
        &mut self,
        stage: usize,
        system: &S,
        at: (f64, &S::Vector, &S::Vector, &S::Vector),
        u: &S::Inputs,
    ) {
        if let Some(integrals) = self {
            integrals.stage(stage, system, at, u);
        }
    }

    #[inline(always)]
    fn add(&mut self, stage: usize, work: f64, lost: f64) {
        if let Some(integrals) = self {
            Quadratures::<S>::add(integrals, stage, work, lost);
        }
    }

    #[inline(always)]
    fn take(&mut self, stage: usize, work: f64, lost: f64) {
        if let Some(integrals) = self {
            Quadratures::<S>::take(integrals, stage, work, lost);
        }
    }

    #[inline(always)]
    fn add_instantaneous(&mut self, work: f64, lost: f64) {
        if let Some(integrals) = self {
            Quadratures::<S>::add_instantaneous(integrals, work, lost);
        }
    }

    #[cfg(feature = "std")]
    fn set_contact_shares(&mut self, stage: usize, of_each: &[ContactShare]) {
        if let Some(integrals) = self {
            Quadratures::<S>::set_contact_shares(integrals, stage, of_each);
        }
    }

    #[cfg(feature = "std")]
    fn add_instantaneous_share(&mut self, contact: usize, part: ContactShare) {
        if let Some(integrals) = self {
            Quadratures::<S>::add_instantaneous_share(integrals, contact, part);
        }
    }

    #[inline(always)]
    fn advance(&mut self, h: f64, b: &[f64]) {
        if let Some(integrals) = self {
            Quadratures::<S>::advance(integrals, h, b);
        }
    }

    #[inline(always)]
    fn retreat(&mut self, b: &[f64]) {
        if let Some(integrals) = self {
            Quadratures::<S>::retreat(integrals, b);
        }
    }

    fn integrals(&self) -> Option<&EnergyIntegrals> {
        self.as_ref()
    }

    fn integrals_mut(&mut self) -> Option<&mut EnergyIntegrals> {
        self.as_mut()
    }
}

/// The energy balance of a run.
///
/// `residual = (T + V)(now) − (T + V)(then) − work + dissipated` is 0 for exact equations that are solved exactly; it reveals a
/// wrong term in the equations of motion or in an energy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct EnergyBalance {
    /// Kinetic and potential energy at the start, in J.
    pub start: f64,
    /// Kinetic and potential energy at the end, in J.
    pub end: f64,
    /// Work done on the machine by drives, applied forces and inputs, in J.
    pub work: f64,
    /// Energy lost in dampers and by friction, in J.
    pub dissipated: f64,
    /// The energy exchanged during the run, in J, the scale of [`relative`](Self::relative): the largest kinetic energy at the end
    /// of any step, `∫ |work rate| dt` and the energy dissipated.
    pub exchanged: f64,
    /// How large the residual may be by tolerance and rounding, in J, with a margin of 20.
    ///
    /// After the error of a step the motion continues on another trajectory, whose balance closes, so the errors of steps add up in
    /// the residual and none is amplified. In a step of tolerance `δ` an energy changes by at most
    /// `√(2n) (|∂T/∂v| δv + |∂(T + V)/∂q| δq)`, which is bounded by kinetic energy, applied forces and accelerations at its end, in
    /// the metric of inertia; for implicit methods the change of the powers by `δ` over the length of the step is added. Rounding
    /// contributes some units in the last place of the energies at each step, and the round-off of the potential energy, which is
    /// measured by moving coordinates by theirs. Infinite for a method with steps of a fixed length, since nothing bounds their error.
    pub explained: f64,
}

impl EnergyBalance {
    /// `end − start − work + dissipated`, in J.
    pub fn residual(&self) -> f64 {
        self.end - self.start - self.work + self.dissipated
    }

    /// The residual relative to the energy exchanged; 0 where nothing moved.
    pub fn relative(&self) -> f64 {
        let residual = self.residual();
        // If no energy was exchanged, only round-off of the potential energy can be missing.
        if self.exchanged == 0.0 {
            residual
        } else {
            residual / self.exchanged
        }
    }
}

/// The energy balance of a unilateral contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactEnergies {
    /// Lost in its impacts, including their friction, in J.
    pub impact_loss: f64,
    /// Lost by friction while it was closed, in J; for the rolling of a contact, by rolling resistance.
    pub friction_loss: f64,
    /// Lost in its compliance without crushing: by damping, and the energy that it still stored when it opened, in J.
    pub damping_loss: f64,
    /// Work that crushed its layer, in J.
    pub crushing_work: f64,
    /// Work that prescribed motion did against its forces, in J: moving walls, driven bodies, moving constraints. A part of the work of the drives.
    pub work: f64,
}

impl ContactEnergies {
    /// The total loss, in J.
    pub fn lost(&self) -> f64 {
        self.impact_loss + self.friction_loss + self.damping_loss + self.crushing_work
    }
}

/// Energies of a machine at an instant of a run whose balance is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Energies {
    /// Time, in s.
    pub t: f64,
    /// Kinetic energy, in J.
    pub kinetic: f64,
    /// Potential energy, including the energy stored by compliant contacts and first-order states, in J.
    pub potential: f64,
    /// Work done since the start by drives, applied forces and inputs, in J.
    pub work: f64,
    /// Energy lost in dampers and by friction since the start, in J.
    pub dissipated: f64,
}

impl Energies {
    /// Whether all of them are finite.
    #[cfg(feature = "std")]
    pub(crate) fn are_finite(&self) -> bool {
        let all = [self.kinetic, self.potential, self.work, self.dissipated];
        all.iter().all(|energy| energy.is_finite())
    }

    /// The residual of the energy balance since `start`, in J.
    pub fn residual_since(&self, start: &Self) -> f64 {
        (self.kinetic + self.potential)
            - (start.kinetic + start.potential)
            - (self.work - start.work)
            + (self.dissipated - start.dissipated)
    }
}
