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
//! contact added; and `k` holds the forces of compliant contacts.

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
        }
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
}

/// Accelerations and contact forces.
pub(crate) struct Reaction {
    pub a: Vec<Number>,
    /// Normal and tangential force of each contact.
    pub forces: Vec<[Number; 2]>,
}

/// A prescribed change of the rate or acceleration along `row`, and the direction `along` in which the unknown
/// force that brings it about acts.
pub(crate) struct Sought {
    pub along: Vec<Number>,
    pub row: Vec<Number>,
    pub change: Number,
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

    /// The accelerations without contact forces.
    pub fn free(&mut self) -> Result<Vec<Number>, Singular> {
        let mut a = vec![ZERO; self.q.len()];
        let arguments = Arguments {
            t: self.t,
            q: &self.q,
            v: &self.v,
            u: self.u,
            a: &[],
        };
        self.interpreter
            .call(Role::Accelerations, arguments, &mut a)
            .map_err(|_| none())?;
        Ok(a)
    }

    /// `c` of a closed contact: its normal plus the friction in proportion to it, that of rolling friction on it included.
    fn along(&self, phase: &Phase, contact: usize) -> Vec<Number> {
        let mut along = self.row(2 * contact).to_vec();
        for k in [contact, contact + 1] {
            let is_own = phase.modes.len() > k && phase.presses(k) == contact;
            if is_own && let ContactMode::Slides(sign) = phase.modes[k] {
                let share = Dual::constant(-sign) * self.coefficients(k)[2];
                add(&mut along, share, self.row(2 * k + 1));
            }
        }
        along
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
        let n = self.q.len();
        let free = self.free()?;
        let mut forces = vec![[ZERO; 2]; phase.modes.len()];
        let mut known = vec![ZERO; n];
        let (mut sought, mut places) = (Vec::new(), Vec::new());
        for k in (0..phase.modes.len()).filter(|k| phase.is_closed(*k)) {
            if !phase.rolls[k] {
                let along = self.along(phase, k);
                match self.compliant_force(phase, k, direction) {
                    Some(force) => {
                        add(&mut known, force, &along);
                        forces[k][0] = force;
                    }
                    None => {
                        sought.push(Sought {
                            along,
                            row: self.row(2 * k).to_vec(),
                            change: ZERO - self.acceleration(2 * k, &free),
                        });
                        places.push((k, 0));
                    }
                }
            }
            if phase.modes[k] == ContactMode::Sticks && phase.has_friction[k] {
                let row = self.row(2 * k + 1).to_vec();
                sought.push(Sought {
                    along: row.clone(),
                    row,
                    change: ZERO - self.acceleration(2 * k + 1, &free),
                });
                places.push((k, 1));
            }
        }
        let (change, found) = self.respond(&sought, &known).ok_or_else(none)?;
        for ((k, part), force) in places.into_iter().zip(found) {
            forces[k][part] = force;
        }
        for k in 0..phase.modes.len() {
            if let ContactMode::Slides(sign) = phase.modes[k] {
                let share = Dual::constant(-sign) * self.coefficients(k)[2];
                forces[k][1] = share * forces[phase.presses(k)][0];
            }
        }
        let a = free.into_iter().zip(change);
        Ok(Reaction {
            a: a.map(|(a, by)| a + by).collect(),
            forces,
        })
    }

    /// Solves (E67) for Δ and the forces λ of the sought changes; `None` where the forces are not unique.
    pub fn respond(
        &self,
        sought: &[Sought],
        known: &[Number],
    ) -> Option<(Vec<Number>, Vec<Number>)> {
        let n = self.q.len();
        let m = self.held.len() / n.max(1);
        let size = n + m + sought.len();
        let width = size + 1;
        let mut rows = vec![ZERO; size * width];
        for i in 0..n {
            let row = &mut rows[i * width..][..width];
            row[..n].copy_from_slice(&self.mass[i * n..][..n]);
            for j in 0..m {
                row[n + j] = ZERO - self.held[j * n + i];
            }
            for (j, sought) in sought.iter().enumerate() {
                row[n + m + j] = ZERO - sought.along[i];
            }
            row[size] = known[i];
        }
        for j in 0..m {
            rows[(n + j) * width..][..n].copy_from_slice(&self.held[j * n..][..n]);
        }
        for (j, sought) in sought.iter().enumerate() {
            let row = &mut rows[(n + m + j) * width..][..width];
            row[..n].copy_from_slice(&sought.row);
            row[size] = sought.change;
        }
        let mut accelerations = eliminate(&mut rows, size)?;
        let forces = accelerations.split_off(n + m);
        accelerations.truncate(n);
        Some((accelerations, forces))
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
pub(crate) fn add(to: &mut [Number], times: Number, row: &[Number]) {
    for (to, by) in to.iter_mut().zip(row) {
        *to = *to + times * *by;
    }
}

fn dot(a: &[Number], b: &[Number]) -> Number {
    let pairs = a.iter().zip(b);
    pairs.fold(ZERO, |sum, (a, b)| sum + *a * *b)
}
