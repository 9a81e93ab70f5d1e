//! The series of a machine while unilateral contacts are closed, proved.
//!
//! It is proved for each contact alone, closed in every way in which it can be. As the residuals are linear in the forces of contacts, with coefficients that do not
//! depend on the other forces, this proves it for all sets of closed contacts.

use std::ops::Deref;
use std::sync::Arc;

use lagrangian_program::series::{ContactSeries, ContactState, NoSeries, Series};
use lagrangian_scalar::{Ball, Residue};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Contact, ContactGeometry, Model, stage};
use lagrangian_symbolic::{Function as Call, Node, reachable};

use super::residual::{Closed, ClosedContact};
use super::{compare, is_smooth, lower};
use crate::equations::UnilateralEquation;
use crate::equations::literal::Lagrange;
use crate::equations::unilateral::unilateral;
use crate::{POINTS, STATES};

/// The largest number of contacts of a machine, with rolling resistances and second tangents: each of them is proved alone.
pub const MOST_CLOSED: usize = 24;

/// The series of a machine with contacts that was proved to obey its equations of motion, whichever contacts are closed.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedContactSeries(Arc<ContactSeries>);

impl Deref for ProvedContactSeries {
    type Target = Arc<ContactSeries>;
    fn deref(&self) -> &Arc<ContactSeries> {
        &self.0
    }
}

impl ProvedContactSeries {
    /// Derives the series of a machine while rigid contacts are closed, and proves it. Contacts of polygons are without one, and so are those that
    /// yield, whose forces are not constraints.
    ///
    /// # Errors
    /// Why there is none.
    pub fn derive(model: &Model<'_>) -> Result<ProvedContactSeries, NoSeries> {
        let contacts = contacts(model)?;
        let states = in_turn(&contacts);
        let first = states.last().map_or(&[][..], |(_, states)| states);
        let forms = lower::contact_series(model, &contacts, first);
        let machine = Lagrange::of(model, |_| true);
        let proved = forms
            .into_iter()
            .find_map(|series| proved(series, &contacts, &machine));
        proved.ok_or(NoSeries::Unproved)
    }

    /// Proves a series of a machine while contacts are closed.
    ///
    /// # Errors
    /// If it does not obey the equations of motion whichever of its contacts are closed, or if no state was found at which they can be compared.
    pub fn new(series: ContactSeries, model: &Model<'_>) -> Result<ProvedContactSeries, NoSeries> {
        let count = series.contacts.iter().flatten().count();
        let contacts = contacts(model)?;
        let machine = Lagrange::of(model, |_| true);
        let is_whole = |proved: &ProvedContactSeries| {
            let contacts = proved.contacts.iter();
            contacts.flatten().count() == count
        };
        let proved = proved(series, &contacts, &machine).filter(is_whole);
        proved.ok_or(NoSeries::Unproved)
    }
}

/// The contacts of a machine with symbols for their forces; `None` for those that have no series while they are closed.
fn contacts<'d>(model: &Model<'d>) -> Result<Vec<Option<ClosedContact<'d>>>, NoSeries> {
    let is_rigid_and_smooth = |contact: &Contact<'_>| {
        let is_corner = matches!(contact.geometry, ContactGeometry::Corner(_));
        !is_corner && contact.response.compliance().is_none()
    };
    if !model.contacts.iter().any(is_rigid_and_smooth) {
        return Err(NoSeries::Contacts);
    }
    let equations = unilateral(model, &mut Report::new()).ok_or(NoSeries::TooLarge)?;
    if equations.len() > MOST_CLOSED {
        return Err(NoSeries::TooLarge);
    }
    let mut all: Vec<Option<ClosedContact<'d>>> = Vec::with_capacity(equations.len());
    let mut own = model.contacts.iter();
    let mut is_corner = false;
    for (k, equation) in equations.iter().enumerate() {
        let is_carried = equation.is_rolling_resistance || equation.is_second_tangent;
        if !is_carried {
            let geometry = own.next().map(|contact| &contact.geometry);
            is_corner = matches!(geometry, Some(ContactGeometry::Corner(_)) | None);
        }
        let carrier = if is_carried {
            all.last().copied().flatten()
        } else {
            None
        };
        let may_close =
            !is_corner && is_smooth_contact(equation) && is_carried == carrier.is_some();
        all.push(may_close.then(|| of_contact(model, k, equation, carrier)));
    }
    if all.iter().all(Option::is_none) {
        return Err(NoSeries::Contacts);
    }
    Ok(all)
}

fn of_contact<'d>(
    model: &Model<'d>,
    k: usize,
    equation: &UnilateralEquation<'d>,
    carrier: Option<ClosedContact<'d>>,
) -> ClosedContact<'d> {
    // Names in a spec contain no spaces.
    let symbol = |name: &str| {
        model
            .dag
            .symbol(&format!("{name} {k}"), stage::ACCELERATION)
    };
    let force = carrier.map_or_else(|| symbol("normal force"), |carrier| carrier.force);
    let [_, slip] = &equation.directions;
    ClosedContact {
        closed: Closed {
            normal: carrier.is_none().then_some([equation.gap, force]),
            tangent: (equation.has_friction).then(|| [slip.rate, symbol("tangential force")]),
        },
        force,
        friction: equation.coefficients[2],
    }
}

/// Whether a contact is rigid, and its gap, slip and friction have series wherever they have values.
fn is_smooth_contact(equation: &UnilateralEquation<'_>) -> bool {
    let [_, slip] = &equation.directions;
    let all = [equation.gap, slip.rate, equation.coefficients[2]];
    let dag = equation.gap.dag();
    let nodes = reachable(dag, &all);
    equation.compliance.is_none()
        && !equation.is_guide
        && nodes.iter().all(|id| match dag.node(*id) {
            Node::Function(call, _) => !matches!(
                call,
                Call::Tan | Call::Abs | Call::Sign | Call::Min | Call::Max
            ),
            _ => true,
        })
}

/// For each contact the ways in which it can be closed, as the states of all contacts: those that carry it are closed with it.
fn in_turn(contacts: &[Option<ClosedContact<'_>>]) -> Vec<(usize, Vec<ContactState>)> {
    let mut all = Vec::new();
    for (k, contact) in contacts.iter().enumerate() {
        let Some(contact) = contact else {
            continue;
        };
        let ways: &[ContactState] = match contact.closed.tangent {
            None => &[ContactState::Slips(0)],
            Some(_) => &[
                ContactState::Slips(1),
                ContactState::Slips(-1),
                ContactState::Sticks,
            ],
        };
        for way in ways {
            let mut states = vec![ContactState::Open; contacts.len()];
            states[k] = *way;
            if contact.closed.normal.is_none()
                && let Some(j) = k.checked_sub(1)
            {
                let has_friction = contacts[j].is_some_and(|of| of.closed.tangent.is_some());
                states[j] = match has_friction {
                    true => ContactState::Sticks,
                    false => ContactState::Slips(0),
                };
            }
            all.push((k, states));
        }
    }
    all
}

/// The series, without the contacts for which no state was found at which it can be compared with the equations; `None` if it does not obey them.
fn proved(
    mut series: ContactSeries,
    contacts: &[Option<ClosedContact<'_>>],
    machine: &Lagrange<'_, '_>,
) -> Option<ProvedContactSeries> {
    for (k, states) in in_turn(contacts) {
        let of_state = series.with(&states).map(Arc::new);
        match of_state.and_then(|series| is_proved(&series, machine, &states)) {
            Some(true) => {}
            Some(false) => return None,
            None => series.contacts[k] = None,
        }
    }
    // What is carried by a contact without a series has none.
    for k in 1..series.contacts.len() {
        let is_carried = series.contacts[k].is_some_and(|of| of.is_carried);
        if is_carried && series.contacts[k - 1].is_none() {
            series.contacts[k] = None;
        }
    }
    Some(ProvedContactSeries(Arc::new(series)))
}

/// Whether a series obeys the equations of motion while contacts do this; `None` if that is not known.
fn is_proved(
    series: &Arc<Series>,
    machine: &Lagrange<'_, '_>,
    states: &[ContactState],
) -> Option<bool> {
    match compare::<Residue>(series, machine, states, POINTS) {
        Some(true) if is_smooth(machine) => Some(true),
        _ => compare::<Ball>(series, machine, states, STATES),
    }
}
