//! The ends of steps by Taylor series of several steppers, in vector lanes.
//!
//! Each stepper moves to the end of its step and examines it alone. The motions through these ends are expanded together, which is most of the work, and powers along
//! the steps are also evaluated together. The numbers of a lane have the bits of a single run.

use std::vec;
use std::vec::Vec;

use super::super::Stepper;
use super::{Evaluate, LaneMask, WIDTH, Wide, put, take};
use crate::balance::Quadratures;
use crate::inputs::InputLaw;
use crate::methods::{MAX_STAGES, Method};
use crate::scalar::{Kernel, Scalar};
use crate::stages::in_blocks;
use crate::step_error::StepError;
use crate::taylor::{Coefficients, motion};
use crate::{System, Vector};
use lagrangian_native::{Lanes, Number};

/// The ends of the steps that are being attempted, and the motions through them.
pub(super) struct Expansions {
    t: [Wide; 2],
    q: Vec<Wide>,
    v: Vec<Wide>,
    coefficients: Vec<Vec<Wide>>,
    /// Whether the step of each lane has reached its end.
    reached: [Result<(), StepError>; WIDTH],
    /// The lanes in which it has.
    lanes: LaneMask,
    /// `None` if no powers are integrated.
    powers: Option<Powers>,
}

/// The powers along the steps that are being attempted.
struct Powers {
    method: &'static Method,
    /// The times at the beginnings of steps, in two parts, and their lengths.
    before: [Wide; 2],
    h: Wide,
    /// The series of the steps.
    coefficients: Vec<Vec<Wide>>,
    /// A state with its accelerations.
    at: [Vec<Wide>; 3],
    /// Work and losses at each stage, up to the end.
    of_stages: [[Wide; 2]; MAX_STAGES],
    /// The lanes in which they are known within the steps, and at the ends.
    known: [LaneMask; 2],
}

impl Expansions {
    /// For steppers like this one; `None` if its method is not by series.
    pub fn new<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        of: &Stepper<'_, S, L, A>,
    ) -> Option<Self> {
        let rows = of.taylor.as_ref()?.of_step().len();
        let zeros = vec![Lanes::splat(0.0); of.now.q.as_slice().len()];
        let coefficients = vec![zeros.clone(); rows];
        let powers = of.takes_powers().then(|| Powers {
            method: of.method,
            before: [Lanes::splat(0.0); 2],
            h: Lanes::splat(0.0),
            coefficients: coefficients.clone(),
            at: [(); 3].map(|()| zeros.clone()),
            of_stages: [[Lanes::splat(0.0); 2]; MAX_STAGES],
            known: [0; 2],
        });
        Some(Self {
            t: [Lanes::splat(0.0); 2],
            q: zeros.clone(),
            v: zeros,
            coefficients,
            reached: [Ok(()); WIDTH],
            lanes: 0,
            powers,
        })
    }

    /// Whether a stepper computes as many coefficients, and powers if those do.
    pub fn are_compatible_with<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &self,
        of: &Stepper<'_, S, L, A>,
    ) -> bool {
        let rows = of.taylor.as_ref().map(|taylor| taylor.of_step().len());
        rows == Some(self.coefficients.len()) && of.takes_powers() == self.powers.is_some()
    }

    /// Lets a stepper go to the end of a step of length `h`, and puts this into a lane.
    pub fn put<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        lane: usize,
        of: &mut Stepper<'_, S, L, A>,
        (h, last): (f64, bool),
    ) {
        self.reached[lane] = of.advance_in_series(h, last);
        (self.t[0][lane], self.t[1][lane]) = (of.now.t, of.now.t_low);
        put(&mut self.q, lane, &of.now.q);
        put(&mut self.v, lane, &of.now.v);
        if let (Some(powers), Some(taylor)) = (&mut self.powers, &of.taylor) {
            powers.before[0][lane] = of.before.t;
            powers.before[1][lane] = of.before.t_low;
            powers.h[lane] = h;
            for (row, of_step) in powers.coefficients.iter_mut().zip(taylor.of_step()) {
                put(row, lane, of_step);
            }
        }
    }

    /// Expands the motions of these lanes, and evaluates the powers; returns those in which they have coefficients.
    pub fn expand(&mut self, which: LaneMask, machines: &mut impl Evaluate) -> LaneMask {
        let reached = self.reached.iter().enumerate();
        self.lanes = reached.fold(0, |mask, (lane, reached)| {
            mask | LaneMask::from(reached.is_ok()) << lane
        }) & which;
        if let Some(powers) = &mut self.powers {
            powers.known = [0; 2];
        }
        let first = self.lanes.trailing_zeros() as usize;
        if first >= WIDTH {
            return 0;
        }
        // A state without a series would leave all lanes without one.
        for lane in (0..WIDTH).filter(|lane| self.lanes >> lane & 1 == 0) {
            for row in (self.t.iter_mut()).chain(&mut self.q).chain(&mut self.v) {
                row[lane] = row[first];
            }
        }
        if let Some(powers) = &mut self.powers {
            powers.known[0] = self.lanes & powers.along(machines);
        }
        let at = (self.t, self.q.as_slice(), self.v.as_slice());
        let expanded = self.lanes & machines.series(at, &mut self.coefficients);
        if let (Some(powers), Some(second)) = (&mut self.powers, self.coefficients.get(2)) {
            let at = (self.t[0], self.q.as_slice(), self.v.as_slice());
            powers.known[1] = expanded & powers.at_end(at, second, machines);
        }
        expanded
    }

    /// Ends the step of a lane, whose length is `h`: with the coefficients of the lane, or else with those that it finds alone. Returns its error, like
    /// [`attempt_in_series`](Stepper::attempt_in_series).
    pub fn end<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        lane: usize,
        to: &mut Stepper<'_, S, L, A>,
        (h, has_coefficients): (f64, bool),
    ) -> Result<f64, StepError> {
        self.reached[lane]?;
        let has = |mask: LaneMask| has_coefficients && mask >> lane & 1 == 1;
        let [along, at_end] = (self.powers.as_ref()).map_or([0; 2], |powers| powers.known);
        let stages = to.method.tableau.stages;
        match &self.powers {
            Some(powers) if has(along) => {
                for (i, [work, lost]) in powers.of_stages.iter().enumerate().take(stages).skip(1) {
                    to.take_powers(i, [work[lane], lost[lane]]);
                }
            }
            _ => to.take_powers_along_series(h),
        }
        match &mut to.taylor {
            Some(taylor) if has_coefficients => {
                to.control.work.evaluations += 1;
                let rows = taylor.coefficients_ahead().iter_mut();
                for (to, from) in rows.zip(&self.coefficients) {
                    take(to, lane, from);
                }
            }
            _ => to.expand_ahead()?,
        }
        let error = to.compare_in_series(h)?;
        if error == 0.0 {
            match &self.powers {
                Some(powers) if has(at_end) => {
                    let [work, lost] = powers.of_stages[stages];
                    to.take_powers(stages, [work[lane], lost[lane]]);
                }
                _ => to.take_powers_at_end(),
            }
        }
        Ok(error)
    }
}

impl Powers {
    /// Evaluates the powers within the steps; returns the lanes in which they are known.
    fn along(&mut self, machines: &mut impl Evaluate) -> LaneMask {
        let tableau = &self.method.tableau;
        let mut known = LaneMask::MAX;
        for (stage, c) in tableau.c.iter().enumerate().take(tableau.stages).skip(1) {
            let tau = Lanes::splat(*c) * self.h;
            let [q, v, a] = &mut self.at;
            <Wide as Number>::run(Along {
                coefficients: &self.coefficients,
                tau,
                at: [&mut *q, &mut *v, &mut *a],
            });
            let t = self.before[0] + (self.before[1] + tau);
            let (powers, fine) = machines.powers((t, q, v), a);
            self.of_stages[stage] = powers;
            known &= fine;
        }
        known
    }

    /// Evaluates the powers at the ends, where the second coefficients of coordinates are these.
    fn at_end(
        &mut self,
        at: (Wide, &[Wide], &[Wide]),
        second: &[Wide],
        machines: &mut impl Evaluate,
    ) -> LaneMask {
        let [.., a] = &mut self.at;
        for (a, c) in a.iter_mut().zip(second) {
            *a = Lanes::splat(2.0) * *c;
        }
        let (powers, fine) = machines.powers(at, a);
        self.of_stages[self.method.tableau.stages] = powers;
        fine
    }
}

/// The states and accelerations of all lanes at times after those of their series, as a kernel: [`state_with_accelerations`](crate::taylor::state_with_accelerations).
struct Along<'a> {
    coefficients: &'a [Vec<Wide>],
    tau: Wide,
    at: [&'a mut [Wide]; 3],
}

/// Coefficients of all lanes.
struct Rows<'a>(&'a [Vec<Wide>]);

impl<N: Scalar<Stored = Wide>> Coefficients<N> for Rows<'_> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn block<const B: usize>(&self, j: usize, start: usize) -> [N; B] {
        let row = &self.0[j];
        let mut block = [N::ZERO; B];
        for (k, number) in block.iter_mut().enumerate() {
            *number = N::load(row[start + k]);
        }
        block
    }
}

impl Kernel<Wide> for Along<'_> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = Wide>>(self) {
        let Self {
            coefficients,
            tau,
            at: [q, v, a],
        } = self;
        let tau = N::load(tau);
        in_blocks!(a.len(), |start, B| {
            let [by_q, by_v, there] = motion::<B, 3, N>(&Rows(coefficients), start, tau);
            for k in 0..B {
                q[start + k] = (N::load(coefficients[0][start + k]) + by_q[k]).store();
                v[start + k] = (N::load(coefficients[1][start + k]) + by_v[k]).store();
                a[start + k] = there[k].store();
            }
        });
    }
}
