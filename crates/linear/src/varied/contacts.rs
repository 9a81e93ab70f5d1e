//! Unilateral contacts with their derivatives: contact forces while the phase stays the same, and impulses at impacts.
//!
//! Both follow from one system of linear equations over dual numbers, for forces and accelerations or for impulses
//! and changes of rates:
//!
//! ```text
//! M Δ − Gᵀ μ − Σ cⱼ λⱼ = k,   G Δ = 0,   wⱼ Δ = bⱼ                                                  (E67)
//! ```
//!
//! where `wⱼ` is the row of a closed contact, or the tangential row of a sticking one; `cⱼ` is `wⱼ` with the friction of a slipping
//! contact added; and `k` holds the forces of compliant contacts. A guide beside contacts has no row along its normal, but its reaction N is a form of
//! all forces F, (E81), which is one more equation for it; its friction, where it slips, is a multiple of N, whose sign the run knows:
//!
//! ```text
//! N − ρ Δ − χ μ − κ F = ν + ρ a₀ + χ λ₀,      F_t = −μ sgn(w) sgn(N) N
//! ```
//!
//! with a₀ and λ₀ the accelerations and multipliers without contact forces; in an impact the right-hand side is 0.

use lagrangian::{Compliance, ContactMode, Singular, System};
use lagrangian_program::{Arguments, Interpreter, Role, Shape};
use lagrangian_scalar::Dual;

type Number = Dual<f64>;

/// Pivots below this fraction of their row are round-off: the distribution of the load is not unique.
const INDEPENDENT: f64 = 1e-12;

const ZERO: Number = Dual {
    value: 0.0,
    derivative: 0.0,
};

/// The states of unilateral contacts between two changes of a run.
#[derive(Clone, Debug, Default)]
pub struct Phase {
    /// The mode of each contact.
    pub modes: Vec<ContactMode>,
    /// The force law of each compliant contact.
    pub compliances: Vec<Option<Compliance>>,
    /// Whether each contact is the rolling friction of the contact before it.
    pub rolls: Vec<bool>,
    /// Whether each contact has friction.
    pub has_friction: Vec<bool>,
    /// The loading history of each layer.
    pub layers: Vec<Layer>,
    /// How many constraints the machine has.
    pub constraints: usize,
    /// For each guide, which stand behind the other contacts, the sign of its reaction.
    pub sides: Vec<f64>,
}

/// The loading history of a layer.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    /// Whether it is being loaded beyond its greatest depth.
    pub is_loaded: bool,
    /// The greatest depth so far, in m, with its derivative in each direction.
    pub depth: Vec<Number>,
}

impl Phase {
    /// The phase in which all contacts of a machine are open.
    pub fn open<S: System>(system: &S, directions: usize) -> Phase {
        let contacts = || system.unilateral_contacts();
        let layer = Layer {
            is_loaded: false,
            depth: vec![ZERO; directions],
        };
        Phase {
            modes: vec![ContactMode::Open; contacts().len()],
            compliances: contacts().map(|contact| contact.compliance).collect(),
            rolls: contacts()
                .map(|contact| contact.is_rolling_resistance)
                .collect(),
            has_friction: contacts().map(|contact| contact.has_friction).collect(),
            layers: vec![layer; contacts().len()],
            constraints: system.constraints().len(),
            sides: vec![1.0; system.guides()],
        }
    }

    /// The number of a guide among the guides, if this contact is one.
    pub(crate) fn guide(&self, contact: usize) -> Option<usize> {
        contact.checked_sub(self.modes.len() - self.sides.len())
    }

    /// The guides as contacts.
    fn guides(&self) -> std::ops::Range<usize> {
        self.modes.len() - self.sides.len()..self.modes.len()
    }

    /// Whether all contacts are open.
    pub fn is_free(&self) -> bool {
        self.modes.iter().all(|mode| *mode == ContactMode::Open)
    }

    pub(crate) fn is_closed(&self, contact: usize) -> bool {
        self.modes[contact] != ContactMode::Open
    }

    /// The contact that provides the normal force of a contact: itself, or for rolling friction the contact before it.
    pub(crate) fn presses(&self, contact: usize) -> usize {
        if self.rolls[contact] {
            contact - 1
        } else {
            contact
        }
    }
}

/// A machine at a state, with a derivative of everything in one direction.
pub(crate) struct DualState<'i> {
    interpreter: &'i mut Interpreter<Number>,
    t: Number,
    q: Vec<Number>,
    pub v: Vec<Number>,
    u: &'i [Number],
    pub gaps: Vec<Number>,
    /// Normal and tangential rates of each contact.
    pub rates: Vec<Number>,
    rows: Vec<Number>,
    biases: Vec<Number>,
    /// Normal and tangential restitution, friction and static friction of each contact.
    coefficients: Vec<Number>,
    mass: Vec<Number>,
    /// The constraint rows of the machine.
    held: Vec<Number>,
    /// For each guide the coefficients of its reaction: of accelerations, multipliers, and forces along all directions.
    guides: Vec<Number>,
}

/// Forces, each by its direction: of each contact there is a normal and then a tangential one.
pub(crate) type Acts = Vec<(usize, Number)>;

/// Accelerations and contact forces.
pub(crate) struct Reaction {
    pub a: Vec<Number>,
    /// Normal and tangential force of each contact.
    pub forces: Vec<[Number; 2]>,
}

/// A prescribed change of the rate or acceleration along `row`, and the forces that act for each unit of the unknown force that brings it
/// about.
pub(crate) struct Sought {
    pub acts: Acts,
    pub row: Vec<Number>,
    pub change: Number,
}

/// The unknown reaction of a guide: the friction for each unit of it, and what it is without changes and forces.
#[derive(Clone, Default)]
pub(crate) struct SoughtReaction {
    pub acts: Acts,
    pub load: Option<Number>,
}

/// A solution of (E67).
pub(crate) struct Response {
    /// The changes of accelerations or rates.
    pub change: Vec<Number>,
    /// The sought forces or impulses.
    pub forces: Vec<Number>,
    /// The reactions of guides.
    pub reactions: Vec<Number>,
}

impl<'i> DualState<'i> {
    /// Evaluates the machine at a state; `state` lists time, coordinates and rates.
    pub fn new(
        interpreter: &'i mut Interpreter<Number>,
        state: Vec<Number>,
        u: &'i [Number],
        phase: &Phase,
    ) -> Result<DualState<'i>, Singular> {
        let (n, contacts) = ((state.len() - 1) / 2, phase.modes.len());
        let (t, q, v) = (state[0], state[1..=n].to_vec(), state[n + 1..].to_vec());
        let mut call = |role: Role, count: usize| -> Result<Vec<Number>, Singular> {
            let mut results = vec![ZERO; count];
            let arguments = Arguments {
                t,
                q: &q,
                v: &v,
                u,
                a: &[],
            };
            interpreter
                .call(role, arguments, &mut results)
                .map_err(|_| none())?;
            Ok(results)
        };
        let lower = call(Role::MassMatrix, Shape::Symmetric(n).len())?;
        let mut mass = vec![ZERO; n * n];
        for (index, entry) in lower.iter().enumerate() {
            let (i, j) = Shape::place(index);
            mass[i * n + j] = *entry;
            mass[j * n + i] = *entry;
        }
        Ok(DualState {
            gaps: call(Role::Gaps, contacts)?,
            rates: call(Role::ContactRates, 2 * contacts)?,
            rows: call(Role::ContactMatrix, 2 * contacts * n)?,
            biases: call(Role::ContactBias, 2 * contacts)?,
            coefficients: call(Role::ContactCoefficients, 4 * contacts)?,
            held: call(Role::ConstraintMatrix, phase.constraints * n)?,
            guides: match phase.sides.len() {
                0 => Vec::new(),
                guides => call(
                    Role::GuideMatrix,
                    guides * (n + phase.constraints + 2 * contacts),
                )?,
            },
            mass,
            interpreter,
            t,
            q,
            v,
            u,
        })
    }

    /// The row of a direction; each contact has a normal and then a tangential one.
    pub fn row(&self, direction: usize) -> &[Number] {
        let n = self.q.len();
        &self.rows[direction * n..][..n]
    }

    /// Normal and tangential restitution, friction and static friction.
    pub fn coefficients(&self, contact: usize) -> [Number; 4] {
        [0, 1, 2, 3].map(|i| self.coefficients[4 * contact + i])
    }

    /// The rate of change of the rate in a direction, for accelerations `a`.
    pub fn acceleration(&self, direction: usize, a: &[Number]) -> Number {
        self.biases[direction] + dot(self.row(direction), a)
    }

    fn call(&mut self, role: Role, count: usize) -> Result<Vec<Number>, Singular> {
        let mut results = vec![ZERO; count];
        let arguments = Arguments {
            t: self.t,
            q: &self.q,
            v: &self.v,
            u: self.u,
            a: &[],
        };
        self.interpreter
            .call(role, arguments, &mut results)
            .map_err(|_| none())?;
        Ok(results)
    }

    /// The accelerations without contact forces.
    pub fn free(&mut self) -> Result<Vec<Number>, Singular> {
        self.call(Role::Accelerations, self.q.len())
    }

    /// The reactions of the guides to these accelerations without contact forces, and what friction they bring with them.
    fn loaded_guides(
        &mut self,
        phase: &Phase,
        free: &[Number],
    ) -> Result<Vec<SoughtReaction>, Singular> {
        let count = phase.sides.len();
        if count == 0 {
            return Ok(Vec::new());
        }
        let loads = self.call(Role::GuideLoads, count)?;
        let multipliers = match phase.constraints {
            0 => Vec::new(),
            m => self.call(Role::Multipliers, m)?,
        };
        let reactions = phase.guides().zip(loads).enumerate();
        let reactions = reactions.map(|(guide, (k, load))| {
            let [by_accelerations, by_multipliers, _] = self.form_of_guide(guide);
            let load = load + dot(by_accelerations, free) + dot(by_multipliers, &multipliers);
            SoughtReaction {
                acts: self.friction_of_guide(phase, k).into_iter().collect(),
                load: Some(load),
            }
        });
        Ok(reactions.collect())
    }

    /// The friction of a guide for each unit of its reaction, if it slips.
    fn friction_of_guide(&self, phase: &Phase, contact: usize) -> Option<(usize, Number)> {
        let side = phase.sides[phase.guide(contact)?];
        match phase.modes[contact] {
            ContactMode::Slides(sign) => {
                let share = Dual::constant(-sign * side) * self.coefficients(contact)[2];
                Some((2 * contact + 1, share))
            }
            _ => None,
        }
    }

    /// The coefficients of the reaction of a guide: of accelerations, multipliers, and forces.
    fn form_of_guide(&self, guide: usize) -> [&[Number]; 3] {
        let (n, directions) = (self.q.len(), self.rates.len());
        let m = self.held.len() / n.max(1);
        let own = &self.guides[guide * (n + m + directions)..][..n + m + directions];
        let (by_accelerations, rest) = own.split_at(n);
        let (by_multipliers, by_forces) = rest.split_at(m);
        [by_accelerations, by_multipliers, by_forces]
    }

    /// The forces of a closed contact for each unit of its normal force: that force, and the friction in proportion to it, that of rolling friction on it
    /// included.
    fn acts(&self, phase: &Phase, contact: usize) -> Acts {
        let mut acts = vec![(2 * contact, Dual::constant(1.0))];
        for k in [contact, contact + 1] {
            let is_own = phase.modes.len() > k && phase.presses(k) == contact;
            if is_own && let ContactMode::Slides(sign) = phase.modes[k] {
                let share = Dual::constant(-sign) * self.coefficients(k)[2];
                acts.push((2 * k + 1, share));
            }
        }
        acts
    }

    /// The force of a compliant contact.
    fn compliant_force(&self, phase: &Phase, contact: usize, direction: usize) -> Option<Number> {
        let [first, second, ..] = self.coefficients(contact);
        let (depth, rate) = (ZERO - self.gaps[contact], ZERO - self.rates[2 * contact]);
        // d^(3/2), whose slope is 0 at d = 0.
        let root = depth.value.max(0.0).sqrt();
        let power = Dual {
            value: depth.value * root,
            derivative: 1.5 * root * depth.derivative,
        };
        let layer = &phase.layers[contact];
        let one = Dual::constant(1.0);
        Some(match phase.compliances[contact]? {
            Compliance::Linear => first * depth + second * rate,
            Compliance::Hertz => first * power,
            Compliance::HuntCrossley => first * power * (one + second * rate),
            Compliance::Layer if layer.is_loaded => first * depth,
            Compliance::Layer => {
                let lost = layer.depth[direction] * (one - first / second);
                second * (depth - lost)
            }
        })
    }

    /// The depth of penetration of a contact.
    pub fn depth(&self, contact: usize) -> Number {
        ZERO - self.gaps[contact]
    }

    /// Accelerations and contact forces while the phase stays the same.
    ///
    /// # Errors
    /// If the forces are not unique.
    pub fn reaction(&mut self, phase: &Phase, direction: usize) -> Result<Reaction, Singular> {
        let free = self.free()?;
        let mut forces = vec![[ZERO; 2]; phase.modes.len()];
        let guides = self.loaded_guides(phase, &free)?;
        let mut known = Acts::new();
        let (mut sought, mut places) = (Vec::new(), Vec::new());
        for k in (0..phase.modes.len()).filter(|k| phase.is_closed(*k)) {
            if !phase.rolls[k] && phase.guide(k).is_none() {
                let acts = self.acts(phase, k);
                match self.compliant_force(phase, k, direction) {
                    Some(force) => {
                        known.extend(acts.into_iter().map(|(of, share)| (of, force * share)));
                        forces[k][0] = force;
                    }
                    None => {
                        sought.push(Sought {
                            acts,
                            row: self.row(2 * k).to_vec(),
                            change: ZERO - self.acceleration(2 * k, &free),
                        });
                        places.push((k, 0));
                    }
                }
            }
            if phase.modes[k] == ContactMode::Sticks && phase.has_friction[k] {
                sought.push(Sought {
                    acts: vec![(2 * k + 1, Dual::constant(1.0))],
                    row: self.row(2 * k + 1).to_vec(),
                    change: ZERO - self.acceleration(2 * k + 1, &free),
                });
                places.push((k, 1));
            }
        }
        let response = self.respond(&sought, &known, &guides).ok_or_else(none)?;
        for ((k, part), force) in places.into_iter().zip(response.forces) {
            forces[k][part] = force;
        }
        for (k, reaction) in phase.guides().zip(response.reactions) {
            forces[k][0] = reaction;
            if let Some((_, share)) = self.friction_of_guide(phase, k) {
                forces[k][1] = share * reaction;
            }
        }
        for k in 0..phase.guides().start {
            if let ContactMode::Slides(sign) = phase.modes[k] {
                let share = Dual::constant(-sign) * self.coefficients(k)[2];
                forces[k][1] = share * forces[phase.presses(k)][0];
            }
        }
        let a = free.into_iter().zip(response.change);
        Ok(Reaction {
            a: a.map(|(a, by)| a + by).collect(),
            forces,
        })
    }

    /// Solves (E67) for Δ, the forces λ of the sought changes, and the reactions of guides, with known forces; `None` where the forces are not unique.
    pub fn respond(
        &self,
        sought: &[Sought],
        known: &[(usize, Number)],
        guides: &[SoughtReaction],
    ) -> Option<Response> {
        let n = self.q.len();
        let m = self.held.len() / n.max(1);
        let first_guide = n + m + sought.len();
        let size = first_guide + guides.len();
        let width = size + 1;
        let along = |acts: &[(usize, Number)]| {
            let mut along = vec![ZERO; n];
            for (direction, share) in acts {
                add(&mut along, *share, self.row(*direction));
            }
            along
        };
        let unknown: Vec<&Acts> = sought
            .iter()
            .map(|sought| &sought.acts)
            .chain(guides.iter().map(|guide| &guide.acts))
            .collect();
        let columns: Vec<Vec<Number>> = unknown.iter().map(|acts| along(acts)).collect();
        let given = along(known);
        let mut rows = vec![ZERO; size * width];
        for i in 0..n {
            let row = &mut rows[i * width..][..width];
            row[..n].copy_from_slice(&self.mass[i * n..][..n]);
            for j in 0..m {
                row[n + j] = ZERO - self.held[j * n + i];
            }
            for (j, column) in columns.iter().enumerate() {
                row[n + m + j] = ZERO - column[i];
            }
            row[size] = given[i];
        }
        for j in 0..m {
            rows[(n + j) * width..][..n].copy_from_slice(&self.held[j * n..][..n]);
        }
        for (j, sought) in sought.iter().enumerate() {
            let row = &mut rows[(n + m + j) * width..][..width];
            row[..n].copy_from_slice(&sought.row);
            row[size] = sought.change;
        }
        for (guide, reaction) in guides.iter().enumerate() {
            let [by_accelerations, by_multipliers, by_forces] = self.form_of_guide(guide);
            let by = |acts: &[(usize, Number)]| {
                let terms = acts
                    .iter()
                    .map(|(direction, share)| by_forces[*direction] * *share);
                terms.fold(ZERO, |sum, term| sum + term)
            };
            let row = &mut rows[(first_guide + guide) * width..][..width];
            for (to, by) in row
                .iter_mut()
                .zip(by_accelerations.iter().chain(by_multipliers))
            {
                *to = ZERO - *by;
            }
            for (to, acts) in row[n + m..].iter_mut().zip(&unknown) {
                *to = ZERO - by(acts);
            }
            row[first_guide + guide] = row[first_guide + guide] + Dual::constant(1.0);
            row[size] = reaction.load.unwrap_or(ZERO) + by(known);
        }
        let mut change = eliminate(&mut rows, size)?;
        let reactions = change.split_off(first_guide);
        let forces = change.split_off(n + m);
        change.truncate(n);
        Some(Response {
            change,
            forces,
            reactions,
        })
    }
}

/// The error for a missing or non-unique solution. The caller explains the cause.
fn none() -> Singular {
    Singular::new(0, 0.0, 1.0)
}

/// Gaussian elimination with scaled rows and partial pivoting; rows end with the right-hand side. `None` where a
/// pivot is round-off.
fn eliminate(rows: &mut [Number], size: usize) -> Option<Vec<Number>> {
    let width = size + 1;
    for row in rows.chunks_exact_mut(width) {
        let scale = row[..size]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.value.abs()));
        if scale == 0.0 {
            return None;
        }
        // Scaling by a power of two is exact.
        let by = Dual::constant(scale.log2().round().exp2().recip());
        row.iter_mut().for_each(|x| *x = *x * by);
    }
    for k in 0..size {
        let pivot = (k..size).max_by(|a, b| {
            let of = |i: &usize| rows[i * width + k].value.abs();
            of(a).total_cmp(&of(b))
        })?;
        if rows[pivot * width + k].value.abs() <= INDEPENDENT {
            return None;
        }
        for j in 0..width {
            rows.swap(k * width + j, pivot * width + j);
        }
        let (above, below) = rows.split_at_mut((k + 1) * width);
        let own = &above[k * width..];
        for row in below.chunks_exact_mut(width) {
            let factor = row[k] / own[k];
            for j in k..width {
                row[j] = row[j] - factor * own[j];
            }
        }
    }
    let mut solution = vec![ZERO; size];
    for k in (0..size).rev() {
        let row = &rows[k * width..][..width];
        let known = (k + 1..size).fold(row[size], |sum, j| sum - row[j] * solution[j]);
        solution[k] = known / row[k];
    }
    Some(solution)
}

/// Adds a multiple of a row.
fn add(to: &mut [Number], times: Number, row: &[Number]) {
    for (to, by) in to.iter_mut().zip(row) {
        *to = *to + times * *by;
    }
}

fn dot(a: &[Number], b: &[Number]) -> Number {
    let pairs = a.iter().zip(b);
    pairs.fold(ZERO, |sum, (a, b)| sum + *a * *b)
}
