//! Gaps, rates, and what they are made of: the kinematics of contacts at one state.

use std::sync::Arc;
use std::vec::Vec;

use crate::{System, Vector};

/// A gap within this of its scale is closed, and a rate within this of its scale is rest.
pub(crate) const ROUNDING: f64 = 1e-12;

/// The terms of a gap count at least as much as a turn by this angle, in rad, changes it: lengths that no coordinate multiplies cancel in a closed gap, and
/// those that an angle turns tell how large they are.
const LEAST_TURN: f64 = 1.0 / 16.0;

/// Gaps, rates and all that belongs to them at a state.
#[derive(Clone, Debug)]
pub(super) struct ContactKinematics {
    pub n: usize,
    pub gaps: Vec<f64>,
    pub rates: Vec<f64>,
    pub rows: Vec<f64>,
    pub biases: Vec<f64>,
    pub coefficients: Vec<f64>,
    /// Time and state, which rounding is relative to.
    at: (f64, Vec<f64>, Vec<f64>),
    /// How large each coordinate is at least as part of a gap: [`LEAST_TURN`] for an angle, which turns lengths of the machine, and else 0.
    least: Arc<[f64]>,
    /// Bound on what squares of rates that cancel add to an acceleration.
    most_of_squares: f64,
    /// The numbers of faces, three each.
    face_numbers: Vec<f64>,
    /// Where contacts with faces of polygons are on these; empty where no contact is one.
    pub faces: Vec<Option<OnFace>>,
}

/// Where a corner is on a face of a polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnFace {
    /// How far it is outside of the face, in m.
    pub height: f64,
    /// How far it is beyond the ends of that, in m, and how fast that grows.
    pub beyond: f64,
    pub beyond_rate: f64,
}

/// Writes where the contacts that are with faces of polygons are on these; nothing where no contact is one. `numbers` is memory for this.
pub(super) fn write_faces<S: System>(
    system: &S,
    (t, q, v): (f64, &S::Vector, &S::Vector),
    numbers: &mut Vec<f64>,
    faces: &mut Vec<Option<OnFace>>,
) {
    faces.clear();
    let with_face = |one: &crate::UnilateralContact<'_>| one.has_face;
    let count = system.unilateral_contacts().filter(with_face).count();
    if count == 0 {
        return;
    }
    numbers.resize(3 * count, 0.0);
    system.contact_faces(t, q, v, numbers);
    let mut all = numbers.chunks_exact(3);
    let mut next = || {
        let own = all.next()?;
        Some(OnFace {
            height: own[0],
            beyond: own[1],
            beyond_rate: own[2],
        })
    };
    let contacts = system.unilateral_contacts();
    faces.extend(contacts.map(|contact| if contact.has_face { next() } else { None }));
}

/// How large each coordinate is at least as part of a gap: see [`LEAST_TURN`]. A gap at angles of 0 is no better known than beside it: without their
/// lengths its rounding would be nothing where all coordinates are 0, and bounces would end nowhere.
pub(super) fn least_sizes<S: System>(system: &S) -> Arc<[f64]> {
    let least = |unit| if unit == "rad" { LEAST_TURN } else { 0.0 };
    let coordinates = system.coordinates();
    coordinates
        .map(|coordinate| least(coordinate.unit))
        .collect()
}

impl ContactKinematics {
    /// Memory for evaluations. `least` are the [`least_sizes`].
    pub fn new(least: &Arc<[f64]>, contacts: usize) -> ContactKinematics {
        let (n, m) = (least.len(), contacts);
        let zeros = |count: usize| std::vec![0.0; count];
        ContactKinematics {
            n,
            gaps: zeros(m),
            rates: zeros(2 * m),
            rows: zeros(2 * m * n),
            biases: zeros(2 * m),
            coefficients: zeros(4 * m),
            at: (0.0, zeros(n), zeros(n)),
            least: least.clone(),
            most_of_squares: 0.0,
            face_numbers: Vec::new(),
            faces: Vec::new(),
        }
    }

    /// Evaluates gaps and rates at a state, and where contacts are on faces.
    pub fn evaluate_gaps<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        system.gaps(t, q, &mut self.gaps);
        system.contact_rates(t, q, v, &mut self.rates);
        write_faces(system, (t, q, v), &mut self.face_numbers, &mut self.faces);
    }

    /// Evaluates all of it at a state.
    pub fn evaluate<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        self.evaluate_gaps(system, t, q, v);
        system.contact_matrix(t, q, &mut self.rows);
        system.contact_bias(t, q, v, &mut self.biases);
        system.contact_coefficients(t, q, v, &mut self.coefficients);
        self.at.0 = t;
        self.at.1.copy_from_slice(q.as_slice());
        self.at.2.copy_from_slice(v.as_slice());
        let squares = self.biases.iter().step_by(2).map(|bias| bias.abs());
        self.most_of_squares = 16.0 * squares.sum::<f64>();
    }

    /// Whether this is the state that was evaluated.
    pub fn is_at(&self, t: f64, q: &[f64], v: &[f64]) -> bool {
        self.at.0 == t && self.at.1 == q && self.at.2 == v
    }

    /// Below which the gap of a contact is closed. Asked of few contacts: it takes the whole row of one.
    pub fn gap_rounding(&self, contact: usize) -> f64 {
        let (t, q, _) = &self.at;
        let direction = 2 * contact;
        let row = self.row(direction);
        let terms = terms(row, q).max(terms(row, &self.least));
        ROUNDING * terms + 8.0 * f64::EPSILON * (t * self.rates[direction]).abs()
    }

    /// What round-off makes of the gap of a contact: of each of its terms a unit.
    pub fn gap_roundoff(&self, contact: usize) -> f64 {
        self.gap_rounding(contact) * (f64::EPSILON / ROUNDING)
    }

    /// How large the terms of a rate are together.
    pub fn rate_terms(&self, direction: usize) -> f64 {
        let (_, _, v) = &self.at;
        terms(self.row(direction), v) + self.rates[direction].abs()
    }

    /// The error of a rate of a contact if the rates of coordinates have these.
    pub fn rate_error(&self, direction: usize, errors: &[f64]) -> f64 {
        terms(self.row(direction), errors)
    }

    /// Below which a rate is rest.
    pub fn rate_rounding(&self, direction: usize) -> f64 {
        let rounding = ROUNDING * self.rate_terms(direction);
        match self.on_face(direction / 2) {
            // A face that lies on another one turns by rounding, and what slides along it has so much of a rate.
            Some(face) if direction.is_multiple_of(2) => {
                rounding + ROUNDING * face.beyond_rate.abs()
            }
            _ => rounding,
        }
    }

    /// Bound on the rounding of a rate that changes with an acceleration whose terms have this size: that of its own terms, and what the terms of the
    /// acceleration make of the rounding of time. Where a machine is locked these terms cancel, and all its rates are rounding.
    pub fn rate_rounding_in_time(&self, direction: usize, acceleration_terms: f64) -> f64 {
        self.rate_rounding(direction) + 8.0 * f64::EPSILON * self.at.0.abs() * acceleration_terms
    }

    /// Whether the gap of a contact is no more than rounding.
    pub fn is_gap_closed(&self, contact: usize) -> bool {
        self.gaps[contact] <= self.gap_rounding(contact)
    }

    /// Where a corner is on a face of a polygon, if it is one.
    pub fn on_face(&self, contact: usize) -> Option<OnFace> {
        self.faces.get(contact).copied().flatten()
    }

    /// Whether a contact is where it may touch. A corner on the end of a face, within rounding, is on that face unless it leaves it.
    pub fn is_within(&self, contact: usize, q: &[f64]) -> bool {
        let Some(face) = self.on_face(contact) else {
            return true;
        };
        // The coordinate along the face need not be one of those that move the corner off it.
        let size = q.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let rounding = self.gap_rounding(contact) + ROUNDING * size;
        let stays = face.beyond_rate <= self.rate_rounding(2 * contact);
        face.beyond < -rounding || (face.beyond <= rounding && stays)
    }

    /// How far a contact is outside of what it touches: of a corner of a polygon outside of its face, wherever that ends.
    pub fn height(&self, contact: usize) -> f64 {
        let face = self.on_face(contact);
        face.map_or(self.gaps[contact], |face| face.height)
    }

    pub fn row(&self, direction: usize) -> &[f64] {
        &self.rows[direction * self.n..][..self.n]
    }

    /// How fast a rate of a contact changes with these accelerations, and how large the terms of that are.
    pub fn acceleration(&self, direction: usize, a: &[f64]) -> [f64; 2] {
        let bias = self.biases[direction];
        let terms = self.row(direction).iter().zip(a).map(|(w, a)| w * a);
        [
            bias + terms.clone().sum::<f64>(),
            bias.abs() + terms.map(f64::abs).sum::<f64>(),
        ]
    }

    /// The round-off of the acceleration of a gap, in m/s², where rates of size `rate` are known to [`ROUNDING`] of it.
    ///
    /// The acceleration contains squares of rates divided by a radius of curvature, and rates at rest are not exactly 0. The radius is estimated
    /// by the terms of the gap, or by the distance travelled at this rate until now. This may be too large, but by less than the factor
    /// between round-off and [`ROUNDING`]. The result is at most 16 times the sum of these squares.
    pub fn acceleration_rounding(&self, contact: usize, rate: f64) -> f64 {
        let (t, q, v) = &self.at;
        let row = self.row(2 * contact);
        let own = terms(row, v);
        let rate = rate.max(own);
        let length = terms(row, q).max(rate * t.abs());
        if length == 0.0 {
            return 0.0;
        }
        // The square of a rate at rest, and the round-off of squares of rates that cancel.
        let left = ROUNDING * rate * (ROUNDING * rate / length);
        let cancelled = 64.0 * f64::EPSILON * own * (own / length);
        (left + cancelled).min(self.most_of_squares)
    }

    /// What walls that move by themselves do against the forces of a contact, in W, or against its impulses, in J, if nothing else moves by itself.
    pub fn work_of_walls(&self, contact: usize, forces: [f64; 2]) -> f64 {
        let (_, _, v) = &self.at;
        let of_direction = |part: usize| {
            // The rate that there would be if the machine were at rest.
            let direction = 2 * contact + part;
            let by_machine = self.row(direction).iter().zip(v);
            let at_rest = self.rates[direction] - by_machine.map(|(w, v)| w * v).sum::<f64>();
            -forces[part] * at_rest
        };
        of_direction(0) + of_direction(1)
    }

    pub fn friction(&self, contact: usize) -> [f64; 2] {
        let own = &self.coefficients[4 * contact..][..4];
        [own[2], own[3]]
    }

    pub fn restitution(&self, contact: usize) -> [f64; 2] {
        let own = &self.coefficients[4 * contact..][..4];
        [own[0], own[1]]
    }
}

/// How large the terms of a rate, or of a place, are together.
fn terms(row: &[f64], y: &[f64]) -> f64 {
    row.iter().zip(y).map(|(w, y)| (w * y).abs()).sum()
}
