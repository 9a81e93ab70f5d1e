//! Unilateral contacts along an orbit: which start is allowed, and which contact prevents another.

use super::{NoOrbit, Period, Search};
use lagrangian::interpreted::Named;
use lagrangian::{Compliance, ContactMode, Machine, Simulation, State, System};
use nalgebra::DVector;

impl Search<'_> {
    /// What contacts are at a state: their gaps, their normal and tangential rates, and the coefficients of their laws.
    pub(super) fn touches(&self, t: f64, q: &[f64], v: &[f64]) -> [Vec<f64>; 3] {
        let system = self.machine.prepare();
        let contacts = system.unilateral_contacts().len();
        let (q, v) = (q.to_vec(), v.to_vec());
        let mut found = [1, 2, 4].map(|numbers| vec![0.0; numbers * contacts]);
        let [gaps, rates, coefficients] = &mut found;
        system.gaps(t, &q, gaps);
        system.contact_rates(t, &q, &v, rates);
        system.contact_coefficients(t, &q, &v, coefficients);
        found
    }

    /// Whether contacts change with time: their walls move, other than a belt does at a constant speed, or the coefficients of their laws change.
    pub(super) fn walls_move(&self) -> bool {
        let start = &self.sought.start;
        let rest = vec![0.0; self.n];
        let at = |later: f64| {
            let found = self.touches(start.t + later, &start.q.values, &rest);
            found.concat()
        };
        let now = at(0.0);
        let changes =
            |(now, later): (&f64, &f64)| now != later && !(now.is_nan() && later.is_nan());
        [0.37, 1.91, 17.3].into_iter().any(|later| {
            let later = at(later);
            now.iter().zip(&later).any(changes)
        })
    }

    /// The name of a contact that is not the same at two times and states, which have the same rates.
    pub(super) fn other_contact(&self, places: [(f64, &DVector<f64>); 2]) -> Option<String> {
        // The rounding of the period, or of a turn, changes a phase by as much.
        const SAME: f64 = 1e-6;
        let system = self.machine.prepare();
        let [here, there] = places.map(|(t, x)| {
            let (q, v) = x.as_slice().split_at(self.n);
            self.touches(t, q, v)
        });
        let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // Gaps are lengths, and rates speeds; coefficients have nothing in common.
        let sizes = [Some(largest(&here[0])), Some(largest(&here[1])), None];
        let mut kinds = here.iter().zip(&there).zip(sizes);
        let contact = kinds.find_map(|((here, there), size)| {
            let differs = |(here, there): (&f64, &f64)| {
                (here - there).abs() > SAME * size.unwrap_or(here.abs().max(there.abs()))
            };
            let at = here.iter().zip(there).position(differs)?;
            Some(at * system.unilateral_contacts().len() / here.len())
        })?;
        let contact = system.unilateral_contacts().nth(contact)?;
        Some(contact.name.to_owned())
    }

    /// Checks that no contact is closed at the start: only there do neighbouring states differ in every
    /// number of the state.
    pub(super) fn check_open(&self, x: &DVector<f64>) -> Result<(), NoOrbit> {
        let system = self.machine.prepare();
        let mut gaps = vec![0.0; system.unilateral_contacts().len()];
        let q = x.as_slice()[..self.n].to_vec();
        system.gaps(self.sought.start.t, &q, &mut gaps);
        // Guides are never open.
        let contacts = gaps.len() - system.guides();
        let mut contacts = system.unilateral_contacts().zip(&gaps).take(contacts);
        match contacts.find(|(_, gap)| **gap <= 0.0) {
            Some((contact, _)) => Err(NoOrbit::Refused(format!(
                "the contact `{}` is closed where the period begins, at the start or where the search has led: start from a state of \
                 the orbit at which no contact is closed",
                contact.name
            ))),
            None => Ok(()),
        }
    }

    /// Checks that the motion crushes no layer. A run begins with layers that nothing has crushed yet, and what is crushed stays so: the depth of a
    /// layer does not return, even if coordinates and rates do, and the next period is another motion.
    pub(super) fn check_uncrushed(&self, x: &DVector<f64>, period: f64) -> Result<(), NoOrbit> {
        let system = self.machine.prepare();
        let mut contacts = system.unilateral_contacts();
        if !contacts.any(|contact| contact.compliance == Some(Compliance::Layer)) {
            return Ok(());
        }
        let start = self.named(x);
        let run = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance)
            .until(start.t + period)
            .run_interpreted(start)
            .map_err(|error| NoOrbit::Run(error.to_string()))?;
        let works = run.crushing_work();
        let mut contacts = system.unilateral_contacts().zip(works);
        match contacts.find(|(_, work)| *work > 0.0) {
            Some((contact, work)) => Err(NoOrbit::Refused(format!(
                "the motion crushes the layer of `{}` by {work:.3e} J in a period, so that it does not return to its start, where nothing is crushed \
                 yet; once nothing more is crushed, the layer is a spring that pushes: give it `linear(k2, 0)` behind the thickness that is lost",
                contact.name
            ))),
            None => Ok(()),
        }
    }

    /// A state on the motion from `x` at which no contact is closed, and every guide slips, shifted to the time of the start: the middle of the
    /// longest such interval within a period or, where the period is not known, within a limited number of steps. `None`
    /// where there is none.
    pub(super) fn find_open_state(
        &self,
        x: &DVector<f64>,
    ) -> Result<Option<State<Named>>, NoOrbit> {
        let failed = |error: lagrangian::Error| NoOrbit::Run(error.to_string());
        let start = self.named(x);
        let t = start.t;
        let until = match self.sought.period {
            Period::Given(period) | Period::Near(period) => t + period,
            Period::Sought => t + 1e9,
        };
        let (run, _) = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance)
            .max_steps(STEPS_TO_OPEN)
            .until(until)
            .run_interpreted_as_far_as_possible(start)
            .map_err(failed)?;
        let guides = run.system().guides();
        let phases: Vec<(f64, bool)> = run
            .contact_phases()
            .map(|phase| {
                let contacts = phase.modes.len() - guides;
                let is_open = phase.modes.iter().enumerate().all(|(k, mode)| match mode {
                    ContactMode::Open => true,
                    ContactMode::Slides(sign) => k >= contacts && *sign != 0.0,
                    _ => false,
                });
                (phase.since, is_open)
            })
            .collect();
        // The last phase has no end.
        let ended = phases.windows(2).filter(|pair| pair[0].1);
        let spans = ended.map(|pair| (pair[0].0, pair[1].0));
        let longest = spans.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        let Some((from, to)) = longest.filter(|(from, to)| to > from) else {
            return Ok(None);
        };
        let state = run.at(0.5 * (from + to)).map_err(failed)?;
        Ok(Some(State { t, ..state }))
    }
}

/// The most steps of a run that should reach a state at which no contact is closed.
const STEPS_TO_OPEN: usize = 4_000;
