//! Unilateral contacts with their derivatives: what they press while nothing changes, and what impacts do.
//!
//! Both are one system of linear equations over dual numbers, with forces and accelerations, or impulses and changes of rates:
//!
//! ```text
//! M Δ − Gᵀ μ − Σ cⱼ λⱼ = k,   G Δ = 0,   wⱼ Δ = bⱼ                                                  (E67)
//! ```
//!
//! where `wⱼ` is the row of a contact that is closed, or of one that sticks, `cⱼ` is `wⱼ` with the friction of a contact that slips, and `k` what
//! yields presses.

use lagrangian::{Compliance, ContactMode, Singular, System};
use lagrangian_program::{Arguments, Interpreter, Role, Shape};
use lagrangian_scalar::Dual;

type Number = Dual<f64>;

/// Pivots below this share of their row are rounding: forces share a load in several ways.
const INDEPENDENT: f64 = 1e-12;

const ZERO: Number = Dual {
    value: 0.0,
    derivative: 0.0,
};

/// What unilateral contacts do between two changes of a run.
#[derive(Clone, Debug, Default)]
pub struct Phase {
    /// What each contact does.
    pub modes: Vec<ContactMode>,
    /// By which law each contact presses, if it yields.
    pub compliances: Vec<Option<Compliance>>,
    /// Whether each contact is the rolling of the contact before it.
    pub rolls: Vec<bool>,
    /// Whether each contact has friction.
    pub rubs: Vec<bool>,
    /// What each layer went through.
    pub layers: Vec<Layer>,
    /// How many constraints the machine has.
    pub constraints: usize,
}

/// What a layer went through.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    /// Whether it is loaded further.
    pub is_loaded: bool,
    /// How deep it was pressed at most, in m, with its derivative in each direction.
    pub depth: Vec<Number>,
}

impl Phase {
    /// The contacts of a machine, all open.
    pub fn open<S: System>(system: &S, directions: usize) -> Phase {
        let contacts = || system.unilateral_contacts();
        let layer = Layer {
            is_loaded: false,
            depth: vec![ZERO; directions],
        };
        Phase {
            modes: vec![ContactMode::Open; contacts().len()],
            compliances: contacts().map(|contact| contact.compliance).collect(),
            rolls: contacts().map(|contact| contact.rolls).collect(),
            rubs: contacts().map(|contact| contact.rubs).collect(),
            layers: vec![layer; contacts().len()],
            constraints: system.constraints().len(),
        }
    }

    /// Whether nothing touches.
    pub fn is_free(&self) -> bool {
        self.modes.iter().all(|mode| *mode == ContactMode::Open)
    }

    pub(crate) fn is_closed(&self, contact: usize) -> bool {
        self.modes[contact] != ContactMode::Open
    }

    /// The contact whose normal force is that of a contact: itself, or the one whose rolling it is.
    pub(crate) fn presses(&self, contact: usize) -> usize {
        if self.rolls[contact] {
            contact - 1
        } else {
            contact
        }
    }
}

/// A machine at a state, with a derivative of everything in one direction.
pub(crate) struct Place<'i> {
    interpreter: &'i mut Interpreter<Number>,
    t: Number,
    q: Vec<Number>,
    pub v: Vec<Number>,
    u: &'i [Number],
    pub gaps: Vec<Number>,
    /// Rates along normal and tangent of each contact.
    pub rates: Vec<Number>,
    rows: Vec<Number>,
    drifts: Vec<Number>,
    /// Restitution along normal and tangent, friction and static friction of each contact.
    coefficients: Vec<Number>,
    mass: Vec<Number>,
    /// Rows of the constraints of the machine.
    held: Vec<Number>,
}

/// Accelerations, and what contacts press.
pub(crate) struct Reaction {
    pub a: Vec<Number>,
    /// Along normal and tangent, of each contact.
    pub forces: Vec<[Number; 2]>,
}

/// A direction whose rate, or acceleration, is to change by so much; and along what the force acts that does it.
pub(crate) struct Sought {
    pub along: Vec<Number>,
    pub row: Vec<Number>,
    pub change: Number,
}

impl<'i> Place<'i> {
    /// Time, coordinates and rates are one list.
    pub fn new(
        interpreter: &'i mut Interpreter<Number>,
        state: Vec<Number>,
        u: &'i [Number],
        phase: &Phase,
    ) -> Result<Place<'i>, Singular> {
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
        Ok(Place {
            gaps: call(Role::Gaps, contacts)?,
            rates: call(Role::ContactRates, 2 * contacts)?,
            rows: call(Role::ContactMatrix, 2 * contacts * n)?,
            drifts: call(Role::ContactDrift, 2 * contacts)?,
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

    /// The row of a direction: of a contact its normal, then its tangent.
    pub fn row(&self, direction: usize) -> &[Number] {
        let n = self.q.len();
        &self.rows[direction * n..][..n]
    }

    /// Restitution along normal and tangent, friction and static friction.
    pub fn coefficients(&self, contact: usize) -> [Number; 4] {
        [0, 1, 2, 3].map(|i| self.coefficients[4 * contact + i])
    }

    /// How fast the rate in a direction changes with accelerations.
    pub fn acceleration(&self, direction: usize, a: &[Number]) -> Number {
        self.drifts[direction] + dot(self.row(direction), a)
    }

    /// What the machine would do if nothing touched.
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

    /// `c` of a contact that presses: its normal with the friction that goes along with it, of itself and of what leans on it.
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

    /// What a contact that yields presses.
    fn pressed(&self, phase: &Phase, contact: usize, direction: usize) -> Option<Number> {
        let [first, second, ..] = self.coefficients(contact);
        let (depth, rate) = (ZERO - self.gaps[contact], ZERO - self.rates[2 * contact]);
        // d^(3/2), which is flat where it begins.
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

    /// How deep a contact is pressed.
    pub fn depth(&self, contact: usize) -> Number {
        ZERO - self.gaps[contact]
    }

    /// Accelerations and forces while everything stays as it is.
    ///
    /// # Errors
    /// Where the forces are not the only ones.
    pub fn reaction(&mut self, phase: &Phase, direction: usize) -> Result<Reaction, Singular> {
        let n = self.q.len();
        let free = self.free()?;
        let mut forces = vec![[ZERO; 2]; phase.modes.len()];
        let mut known = vec![ZERO; n];
        let (mut sought, mut places) = (Vec::new(), Vec::new());
        for k in (0..phase.modes.len()).filter(|k| phase.is_closed(*k)) {
            if !phase.rolls[k] {
                let along = self.along(phase, k);
                match self.pressed(phase, k, direction) {
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
            if phase.modes[k] == ContactMode::Sticks && phase.rubs[k] {
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

    /// (E67): Δ and the forces λ of what is sought; none where they are not the only ones.
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
        let mut found = eliminate(&mut rows, size)?;
        let forces = found.split_off(n + m);
        found.truncate(n);
        Some((found, forces))
    }
}

/// There are no accelerations, or no forces that are the only ones. Why is said where runs are made.
fn none() -> Singular {
    Singular::new(0, 0.0, 1.0)
}

/// Gauss's elimination with scaled rows and partial pivoting; rows end with the right-hand side. None where a pivot is rounding.
fn eliminate(rows: &mut [Number], size: usize) -> Option<Vec<Number>> {
    let width = size + 1;
    for row in rows.chunks_exact_mut(width) {
        let scale = row[..size]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.value.abs()));
        if scale == 0.0 {
            return None;
        }
        // A power of two rounds nothing.
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
    let mut found = vec![ZERO; size];
    for k in (0..size).rev() {
        let row = &rows[k * width..][..width];
        let known = (k + 1..size).fold(row[size], |sum, j| sum - row[j] * found[j]);
        found[k] = known / row[k];
    }
    Some(found)
}

/// Adds so many times a row.
pub(crate) fn add(to: &mut [Number], times: Number, row: &[Number]) {
    for (to, by) in to.iter_mut().zip(row) {
        *to = *to + times * *by;
    }
}

fn dot(a: &[Number], b: &[Number]) -> Number {
    let pairs = a.iter().zip(b);
    pairs.fold(ZERO, |sum, (a, b)| sum + *a * *b)
}
