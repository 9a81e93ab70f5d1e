//! The series of a machine with unilateral contacts, of which some are closed.
//!
//! The rows of all contacts are derived once: each contact has the force along its normal as a further unknown, with the acceleration of its gap as
//! residual, and one with friction also the force along its tangent, with the acceleration of its slip. Which of these unknowns there are in a motion follows from what
//! each contact does, and [`ContactSeries::with`] takes the others out of the rows:
//!
//! ```text
//! open      λₙ = 0               λₜ = 0
//! slips     d²g/dt² = 0          λₜ = −σ μ λₙ     where σ = ±1 is the direction of the slip
//! sticks    d²g/dt² = 0          dγₜ/dt = 0
//! ```
//!
//! Where contacts that stick share their load in several ways, some of these conditions follow from the others. The motion is that with any independent ones, and without the forces of the rest.
//!
//! A slip makes the matrix of the unknowns unsymmetric.

use lagrangian_symbolic::Rational;

use super::{Row, RowId, Series, is_inverse};

/// What a contact does during a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactState {
    /// It is open.
    Open,
    /// It is closed, and slips in this direction along its tangent, 1 or −1; 0 where it has no friction.
    Slips(i8),
    /// It is closed, and does not slip.
    Sticks,
    /// The same, where its slip vanishes if those of other contacts do: without a force along its tangent.
    SticksAlongNormal,
    /// The same, where its gap stays closed if those of other contacts do: without a force along its normal.
    SticksAlongTangent,
}

/// The unknowns of a contact among those of a [`ContactSeries`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactRows {
    /// The force along its normal. A contact that is carried by another one, as a rolling resistance is, has that of the other one.
    pub normal: u32,
    /// Whether it is carried by another one.
    pub is_carried: bool,
    /// With friction, the force along its tangent, and the row of μ λₙ.
    pub tangent: Option<(u32, RowId)>,
}

/// The series of a machine's motion whichever of its unilateral contacts are closed.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSeries {
    /// The rows with the unknowns of all contacts. The row of μ λₙ of a contact is before that of its force along the tangent.
    pub rows: Vec<Row>,
    /// The rows of the residuals: of each coordinate, of each constraint, and of the unknowns of each contact in turn.
    pub residuals: Vec<RowId>,
    /// The contacts; `None` for those that have no series while they are closed.
    pub contacts: Vec<Option<ContactRows>>,
    /// The number of coordinates.
    pub coordinates: usize,
    /// The number of constraints.
    pub constraints: usize,
    /// The number of parameters.
    pub parameters: usize,
    /// The number of inputs.
    pub inputs: usize,
}

/// What an unknown is in a set of closed contacts.
#[derive(Clone, Copy)]
enum Unknown {
    /// It is 0, and removed.
    Vanishes,
    /// It is kept, with this index.
    Kept(u32),
    /// It is this row, or with `true` its opposite.
    Follows(RowId, bool),
}

impl ContactSeries {
    /// The series of the motion in which contacts do this; `None` if there is none. The unknowns of contacts are in the order of the contacts, that along
    /// the normal first.
    pub fn with(&self, states: &[ContactState]) -> Option<Series> {
        let known = self.coordinates + self.constraints;
        let mut unknowns: Vec<Unknown> = (0..known as u32).map(Unknown::Kept).collect();
        unknowns.resize(self.residuals.len(), Unknown::Vanishes);
        let mut is_kept = vec![false; self.residuals.len()];
        is_kept[..known].fill(true);
        let mut is_symmetric = true;
        for (state, contact) in states.iter().zip(&self.contacts) {
            if *state == ContactState::Open {
                continue;
            }
            let contact = contact.as_ref()?;
            // The force along the normal of what is carried is that of what carries it.
            if *state != ContactState::SticksAlongTangent && !contact.is_carried {
                is_kept[contact.normal as usize] = true;
            }
            match (*state, contact.tangent) {
                (ContactState::Sticks | ContactState::SticksAlongTangent, Some((tangent, _))) => {
                    is_kept[tangent as usize] = true;
                }
                (ContactState::Slips(0), Some(_)) => return None,
                (ContactState::Slips(sign), Some((tangent, friction))) => {
                    is_symmetric = false;
                    unknowns[tangent as usize] = Unknown::Follows(friction, sign > 0);
                }
                _ => {}
            }
        }
        let mut kept = Vec::new();
        for (place, _) in is_kept.iter().enumerate().filter(|(_, is)| **is) {
            unknowns[place] = Unknown::Kept(kept.len() as u32);
            kept.push(place);
        }
        let mut narrowed = Narrowed::default();
        for (index, row) in self.rows.iter().enumerate() {
            let place = narrowed.row(index, row, &unknowns)?;
            narrowed.places.push(place);
        }
        let mut residuals = Vec::with_capacity(kept.len());
        for place in kept {
            residuals.push(narrowed.places[self.residuals[place].index()]?);
        }
        let counts = [self.coordinates, self.parameters, self.inputs];
        let mut series = Series::of_rows(narrowed.rows, residuals, counts).ok()?;
        series.is_symmetric = is_symmetric;
        let is_small = || series.blocks().iter().all(|block| is_inverse(block.len()));
        (is_symmetric || is_small()).then_some(series)
    }
}

/// The rows from which the vanishing unknowns have been removed.
#[derive(Default)]
struct Narrowed {
    rows: Vec<Row>,
    /// For each row of the [`ContactSeries`] so far its place among these; `None` where it is 0.
    places: Vec<Option<RowId>>,
}

impl Narrowed {
    fn push(&mut self, row: Row) -> RowId {
        self.rows.push(row);
        RowId(self.rows.len() as u32 - 1)
    }

    /// The place of a row, if it is not 0; `None` if the vanishing unknowns cannot be removed from it.
    #[expect(clippy::option_option, reason = "a failure, or a row that is 0")]
    fn row(&mut self, index: usize, row: &Row, unknowns: &[Unknown]) -> Option<Option<RowId>> {
        if let Row::Acceleration(unknown) = row {
            return Some(match unknowns[*unknown as usize] {
                Unknown::Vanishes => None,
                Unknown::Kept(unknown) => Some(self.push(Row::Acceleration(unknown))),
                Unknown::Follows(other, is_opposite) => match *self.places.get(other.index())? {
                    Some(other) if is_opposite => {
                        let minus = self.push(Row::Number(Rational::MINUS_ONE));
                        Some(self.push(Row::Sum(vec![(Some(minus), other)])))
                    }
                    other => other,
                },
            });
        }
        let vanishes = |row: &RowId| row.index() < index && self.places[row.index()].is_none();
        let mut row = row.clone();
        match &mut row {
            Row::Sum(terms) => {
                terms.retain(|(_, term)| !vanishes(term));
                match terms[..] {
                    [] => return Some(None),
                    [(None, only)] => return Some(self.places[only.index()]),
                    _ => {}
                }
            }
            Row::Product(a, b) if vanishes(a) || vanishes(b) => return Some(None),
            Row::Quotient(a, _) if vanishes(a) => return Some(None),
            _ => {}
        }
        let mut is_whole = true;
        let next = self.rows.len();
        let places = &self.places;
        let row = row.with_operands(|operand| match places.get(operand.index()) {
            Some(Some(place)) => *place,
            Some(None) => {
                is_whole = false;
                operand
            }
            // The partner of a pair, which follows it.
            None => RowId((next + operand.index() - index) as u32),
        });
        is_whole.then(|| Some(self.push(row)))
    }
}
