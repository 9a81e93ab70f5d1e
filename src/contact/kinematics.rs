//! The kinematics of contacts at one state: gaps, rates, their rows and biases.

use std::sync::Arc;
use std::vec::Vec;

use crate::{ContactQuantity, System, Vector};

/// A gap within this of its scale is closed, and a rate within this of its scale is rest.
pub(crate) const ROUNDING: f64 = 1e-12;

/// The terms of a gap count at least as much as a turn by this angle, in rad, changes it: lengths that no coordinate multiplies cancel in a closed gap, and
/// those that an angle turns tell how large they are.
const LEAST_TURN: f64 = 1.0 / 16.0;

/// Gaps, rates and all that belongs to them at a state.
#[derive(Clone, Debug)]
pub(super) struct ContactKinematics {
    pub n: usize,
    /// Infinite for contacts that have not been evaluated because they are far, whose other numbers are 0.
    pub gaps: Vec<f64>,
    pub rates: Vec<f64>,
    /// Two rows of each contact, or of each of `some`.
    rows: Vec<f64>,
    pub biases: Vec<f64>,
    pub coefficients: Vec<f64>,
    /// The contacts that have been evaluated, if these are not all.
    some: Option<SomeContacts>,
    /// Time and state, which rounding is relative to.
    at: (f64, Vec<f64>, Vec<f64>),
    /// How large each coordinate is at least as part of a gap: [`LEAST_TURN`] for an angle, which turns lengths of the machine, and else 0.
    least: Arc<[f64]>,
    /// Bound on what squares of rates that cancel add to an acceleration.
    most_of_squares: f64,
    /// The contacts with faces of polygons.
    with_face: Arc<[usize]>,
    /// The numbers of faces, three each.
    face_numbers: Vec<f64>,
    /// Where contacts with faces of polygons are on these; empty where no contact is one.
    pub faces: Vec<Option<OnFace>>,
}

/// Which contacts have been evaluated.
#[derive(Clone, Debug, Default)]
struct SomeContacts {
    which: Vec<usize>,
    /// For each contact its place among these, or [`NOWHERE`].
    places: Vec<usize>,
    /// The rows of the others.
    zeros: Vec<f64>,
    /// Memory for a quantity of these.
    numbers: Vec<f64>,
}

/// The place of a contact that has not been evaluated.
const NOWHERE: usize = usize::MAX;

/// Where a corner is on a face of a polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnFace {
    /// How far it is outside of the face, in m.
    pub height: f64,
    /// How far it is beyond the ends of that, in m, and how fast that grows.
    pub beyond: f64,
    pub beyond_rate: f64,
}

/// Writes a quantity of some contacts, one after the other. Of machines that evaluate no single contacts, all are evaluated, in memory `all`.
/// Of faces `which` are all contacts that have any.
pub(super) fn write_some<S: System>(
    system: &S,
    quantity: ContactQuantity,
    which: &[usize],
    (t, q, v): (f64, &S::Vector, &S::Vector),
    all: &mut Vec<f64>,
    numbers: &mut Vec<f64>,
) {
    let width = quantity.width(q.as_slice().len());
    numbers.clear();
    numbers.resize(width * which.len(), 0.0);
    if system.single_contacts().is_some() {
        return system.of_contacts(quantity, which, (t, q, v), numbers);
    }
    if quantity == ContactQuantity::Face {
        return system.contact_faces(t, q, v, numbers);
    }
    all.clear();
    all.resize(width * system.unilateral_contacts().len(), 0.0);
    match quantity {
        ContactQuantity::Gap => system.gaps(t, q, all),
        ContactQuantity::Rates => system.contact_rates(t, q, v, all),
        ContactQuantity::Rows => system.contact_matrix(t, q, all),
        ContactQuantity::Bias => system.contact_bias(t, q, v, all),
        _ => system.contact_coefficients(t, q, v, all),
    }
    for (to, contact) in numbers.chunks_exact_mut(width).zip(which) {
        to.copy_from_slice(&all[width * contact..][..width]);
    }
}

/// The contacts of a machine with faces of polygons.
pub(super) fn contacts_with_face<S: System>(system: &S) -> Arc<[usize]> {
    let contacts = system.unilateral_contacts().enumerate();
    contacts
        .filter_map(|(k, contact)| contact.has_face.then_some(k))
        .collect()
}

impl OnFace {
    /// From the three numbers that a machine gives for a contact.
    pub fn new(numbers: &[f64]) -> OnFace {
        OnFace {
            height: numbers[0],
            beyond: numbers[1],
            beyond_rate: numbers[2],
        }
    }
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
    /// Memory for evaluations. `least` are the [`least_sizes`], `with_face` the [`contacts_with_face`].
    pub fn new(least: &Arc<[f64]>, with_face: &Arc<[usize]>, contacts: usize) -> ContactKinematics {
        let (n, m) = (least.len(), contacts);
        let zeros = |count: usize| std::vec![0.0; count];
        ContactKinematics {
            n,
            gaps: zeros(m),
            rates: zeros(2 * m),
            rows: Vec::new(),
            biases: zeros(2 * m),
            coefficients: zeros(4 * m),
            some: None,
            at: (0.0, zeros(n), zeros(n)),
            least: least.clone(),
            most_of_squares: 0.0,
            with_face: with_face.clone(),
            face_numbers: Vec::new(),
            faces: Vec::new(),
        }
    }

    /// Evaluates gaps and rates at a state, and where contacts are on faces: of the `near` contacts only, if these are known.
    pub fn evaluate_gaps<S: System>(
        &mut self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
        near: Option<&[usize]>,
    ) {
        if let Some(near) = near {
            self.begin_some(near);
            self.write_some_gaps(system, place);
            return;
        }
        self.some = None;
        let (t, q, v) = place;
        system.gaps(t, q, &mut self.gaps);
        system.contact_rates(t, q, v, &mut self.rates);
        self.faces.clear();
        if !self.with_face.is_empty() {
            self.face_numbers.resize(3 * self.with_face.len(), 0.0);
            system.contact_faces(t, q, v, &mut self.face_numbers);
            self.faces.resize(self.gaps.len(), None);
            for (k, own) in (self.with_face.iter()).zip(self.face_numbers.chunks_exact(3)) {
                self.faces[*k] = Some(OnFace::new(own));
            }
        }
    }

    /// Evaluates all of it at a state: of the `near` contacts only, if these are known.
    pub fn evaluate<S: System>(
        &mut self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
        near: Option<&[usize]>,
    ) {
        self.evaluate_gaps(system, place, near);
        let (t, q, v) = place;
        if near.is_some() {
            self.write_some_others(system, place);
        } else {
            self.rows.resize(2 * self.gaps.len() * self.n, 0.0);
            system.contact_matrix(t, q, &mut self.rows);
            system.contact_bias(t, q, v, &mut self.biases);
            system.contact_coefficients(t, q, v, &mut self.coefficients);
        }
        self.at.0 = t;
        self.at.1.copy_from_slice(q.as_slice());
        self.at.2.copy_from_slice(v.as_slice());
        let squares = self.biases.iter().step_by(2).map(|bias| bias.abs());
        self.most_of_squares = 16.0 * squares.sum::<f64>();
    }

    /// Evaluates the rows of all contacts at a place, and nothing else.
    pub fn evaluate_rows<S: System>(&mut self, system: &S, (t, q): (f64, &S::Vector)) {
        self.some = None;
        self.rows.resize(2 * self.gaps.len() * self.n, 0.0);
        system.contact_matrix(t, q, &mut self.rows);
    }

    /// Clears what is known of the contacts before these are evaluated.
    fn begin_some(&mut self, which: &[usize]) {
        let (n, m) = (self.n, self.gaps.len());
        let mut some = self.some.take().unwrap_or_else(|| SomeContacts {
            which: (0..m).collect(),
            places: std::vec![NOWHERE; m],
            zeros: std::vec![0.0; n],
            numbers: Vec::new(),
        });
        for k in some.which.drain(..) {
            self.gaps[k] = f64::INFINITY;
            self.rates[2 * k..][..2].fill(0.0);
            self.biases[2 * k..][..2].fill(0.0);
            self.coefficients[4 * k..][..4].fill(0.0);
            some.places[k] = NOWHERE;
        }
        some.which.extend_from_slice(which);
        for (place, k) in which.iter().enumerate() {
            some.places[*k] = place;
        }
        self.faces.clear();
        self.some = Some(some);
    }

    /// Writes gaps and rates of the contacts that are evaluated, and where these are on faces.
    fn write_some_gaps<S: System>(&mut self, system: &S, state: (f64, &S::Vector, &S::Vector)) {
        let Some(SomeContacts { which, numbers, .. }) = &mut self.some else {
            return;
        };
        numbers.resize(2 * which.len(), 0.0);
        let own = &mut numbers[..which.len()];
        system.of_contacts(ContactQuantity::Gap, which, state, own);
        for (k, gap) in which.iter().zip(own) {
            self.gaps[*k] = *gap;
        }
        system.of_contacts(ContactQuantity::Rates, which, state, numbers);
        for (k, rates) in which.iter().zip(numbers.chunks_exact(2)) {
            self.rates[2 * k..][..2].copy_from_slice(rates);
        }
        if self.with_face.is_empty() {
            return;
        }
        self.faces.resize(self.gaps.len(), None);
        let mut own = [0.0; 3];
        for &k in which.iter().filter(|k| self.with_face.contains(k)) {
            system.of_contacts(ContactQuantity::Face, &[k], state, &mut own);
            self.faces[k] = Some(OnFace::new(&own));
        }
    }

    /// Writes rows, biases and coefficients of the contacts that are evaluated.
    fn write_some_others<S: System>(&mut self, system: &S, state: (f64, &S::Vector, &S::Vector)) {
        let Some(SomeContacts { which, numbers, .. }) = &mut self.some else {
            return;
        };
        self.rows.resize(2 * which.len() * self.n, 0.0);
        system.of_contacts(ContactQuantity::Rows, which, state, &mut self.rows);
        numbers.resize(2 * which.len(), 0.0);
        system.of_contacts(ContactQuantity::Bias, which, state, numbers);
        for (k, biases) in which.iter().zip(numbers.chunks_exact(2)) {
            self.biases[2 * k..][..2].copy_from_slice(biases);
        }
        numbers.resize(4 * which.len(), 0.0);
        system.of_contacts(ContactQuantity::Coefficients, which, state, numbers);
        for (k, own) in which.iter().zip(numbers.chunks_exact(4)) {
            self.coefficients[4 * k..][..4].copy_from_slice(own);
        }
    }

    /// Whether this is the state that was evaluated.
    pub fn is_at(&self, t: f64, q: &[f64], v: &[f64]) -> bool {
        let is_same = |known: &[f64], now: &[f64]| {
            let mut pairs = known.iter().zip(now);
            pairs.all(|(known, now)| known.to_bits() == now.to_bits())
        };
        self.at.0.to_bits() == t.to_bits() && is_same(&self.at.1, q) && is_same(&self.at.2, v)
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
        // A corner that is inside the other polygon by less than it is behind its face has come in by another face: it does not touch this one. Corners of the other
        // polygon touch then.
        if face.height < 2.0 * self.gaps[contact].min(0.0) - rounding {
            return false;
        }
        let stays = face.beyond_rate <= self.rate_rounding(2 * contact);
        face.beyond < -rounding || (face.beyond <= rounding && stays)
    }

    /// How far a contact is outside of what it touches: of a corner of a polygon outside of its face, wherever that ends.
    pub fn height(&self, contact: usize) -> f64 {
        let face = self.on_face(contact);
        face.map_or(self.gaps[contact], |face| face.height)
    }

    pub fn row(&self, direction: usize) -> &[f64] {
        let direction = match &self.some {
            None => direction,
            Some(some) => match some.places[direction / 2] {
                NOWHERE => return &some.zeros,
                place => 2 * place + direction % 2,
            },
        };
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
        // These are the square of a rate at rest, and the round-off of squares of rates that cancel.
        let left = ROUNDING * rate * (ROUNDING * rate / length);
        let cancelled = 64.0 * f64::EPSILON * own * (own / length);
        (left + cancelled).min(self.most_of_squares)
    }

    /// What walls that move by themselves do against the forces of a contact, in W, or against its impulses, in J, if nothing else moves by itself.
    pub fn work_of_walls(&self, contact: usize, forces: [f64; 2]) -> f64 {
        let (_, _, v) = &self.at;
        let of_direction = |part: usize| {
            // This is the rate that there would be if the machine were at rest.
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
