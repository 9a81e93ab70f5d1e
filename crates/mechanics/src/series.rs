//! The Taylor series of a machine's motion, proved.
//!
//! The equations of motion in the forms of `residual.rs` become the rows of a [`Series`]; of several forms the one with the fastest steps is taken
//! ([`Series::cycles`]). Its first coefficients are
//! substituted into Lagrange's equations, evaluated literally over [`Jet`]s, truncated power series in time. The
//! residual along one random direction must vanish in every coefficient. The numbers are those of the prime field
//! first; `Ball`s if the machine has functions whose laws do not hold in the field, and if the field finds a
//! difference, as for [programs](crate::Proved).

mod closed;
mod lower;
mod residual;
mod text;

use std::ops::Deref;
use std::sync::Arc;

use lagrangian_program::series::{ContactState, Expander, NoSeries, Series};
use lagrangian_scalar::{Ball, Jet, Residue};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Function as Call, Node, reachable};

pub use closed::{MOST_CLOSED, ProvedContactSeries};
pub use text::SeriesText;

use crate::equations::literal::{Lagrange, SmoothContact, State};
use crate::proof::number::{Number, ZeroTest};
use crate::{POINTS, STATES};

/// The number of coefficients of the equations that are compared. A recurrence is one rule for all orders;
/// five of them cover both halves of every square, and every term of a sum that leaves out its ends.
const ORDERS: usize = 5;

/// The largest number of states to try.
const MOST_STATES: u64 = 96;

/// A series that was proved to obey the equations of motion of its machine.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedSeries(Arc<Series>);

impl ProvedSeries {
    /// Derives the series of a machine's motion, and proves it. With unilateral contacts it is the motion while all of them are open.
    ///
    /// # Errors
    /// Why there is none.
    pub fn derive(model: &Model<'_>) -> Result<ProvedSeries, NoSeries> {
        let mut forms = lower::series(model)?.into_iter();
        let proved = forms.find_map(|series| ProvedSeries::new(series, model).ok());
        proved.ok_or(NoSeries::Unproved)
    }

    /// Proves a series of a machine's motion.
    ///
    /// # Errors
    /// If it does not obey the equations of motion, or if no state was found at which they can
    /// be compared.
    pub fn new(series: Series, model: &Model<'_>) -> Result<ProvedSeries, NoSeries> {
        let series = Arc::new(series);
        if is_proved(&series, model) {
            Ok(ProvedSeries(series))
        } else {
            Err(NoSeries::Unproved)
        }
    }

    /// The series.
    pub fn series(&self) -> &Arc<Series> {
        &self.0
    }
}

impl Deref for ProvedSeries {
    type Target = Series;
    fn deref(&self) -> &Series {
        &self.0
    }
}

/// Whether a series obeys the equations of motion of its machine.
fn is_proved(series: &Arc<Series>, model: &Model<'_>) -> bool {
    // A machine with constraints of velocities has no series.
    let machine = Lagrange::of(model, |_| true);
    match compare::<Residue>(series, &machine, &[], POINTS) {
        Some(true) if is_smooth(&machine) => true,
        _ => compare::<Ball>(series, &machine, &[], STATES) == Some(true),
    }
}

/// Whether all functions in the equations of a machine obey their laws in a field.
fn is_smooth(machine: &Lagrange<'_, '_>) -> bool {
    let dag = machine.model.dag;
    let nodes = reachable(dag, &machine.roots);
    nodes.iter().all(|&id| match dag.node(id) {
        Node::Function(call, _) => matches!(call, Call::Sin | Call::Cos),
        _ => true,
    })
}

/// Whether the equations hold at `states` states while the contacts do this, or all are open if nothing is said of them; nothing if they do not have values at
/// that many.
fn compare<R: Number>(
    series: &Arc<Series>,
    machine: &Lagrange<'_, '_>,
    contacts: &[ContactState],
    states: usize,
) -> Option<bool> {
    let mut good = 0;
    for number in 0..MOST_STATES {
        let at = R::state(number, machine);
        let w = (0..at.q.len() as u64).map(|i| R::random(number + 7919, i));
        let w: Vec<R> = w.collect();
        match holds(series, machine, contacts, &at, &w) {
            Some(false) => return Some(false),
            Some(true) => good += 1,
            None => {}
        }
        if good == states {
            return Some(true);
        }
    }
    None
}

/// Whether the equations hold at a state along a direction; nothing if they have no value.
fn holds<R: Number>(
    series: &Arc<Series>,
    machine: &Lagrange<'_, '_>,
    contacts: &[ContactState],
    at: &State<R>,
    w: &[R],
) -> Option<bool> {
    let mut expander = Expander::new(series.clone(), &at.parameters, ORDERS);
    let t = [at.t, R::ZERO];
    expander.expand(t, &at.q, &at.v, &at.u).ok()?;
    let moving = motion(&expander, at);
    let w: Vec<Jets<R>> = w.iter().map(|&x| Jet::constant(x)).collect();
    let literal = machine.dynamics(&moving, &w)?;
    let count = series.unknowns() - series.dimension();
    let mut multipliers = (0..count).map(|k| {
        let series = expander.multiplier(k);
        Jet(std::array::from_fn(|order| series[order]))
    });
    let (mut held, mut vanishing) = (literal.applied, Vec::new());
    for constraint in &literal.constraints {
        held = held + multipliers.next()? * constraint.along;
        vanishing.push(constraint.acceleration);
    }
    if contacts.iter().any(|state| *state != ContactState::Open) {
        let literal = machine.smooth_contacts(&moving, &w);
        let of_contacts = contacts.iter().zip(literal);
        let forces = forces_of_contacts(of_contacts, &mut multipliers, &mut vanishing)?;
        held = held + forces;
    }
    let mut pairs: Vec<(R, R, f64)> = Vec::new();
    for rate in vanishing {
        // Accelerations and velocity products cancel in the residual, so their size is its scale.
        for (order, rate) in rate.0.into_iter().enumerate() {
            let sizes = moving.a.iter().map(|a| a.0[order].size());
            pairs.push((rate, R::ZERO, 1.0 + sizes.sum::<f64>()));
        }
    }
    for (inertia, held) in std::iter::zip(literal.inertia.0, held.0) {
        pairs.push((inertia, held, inertia.size() + held.size()));
    }
    are_equal(pairs)
}

/// Truncated power series of the motion in time.
type Jets<R> = Jet<R, ORDERS>;

/// The motion that was expanded.
fn motion<R: Number>(expander: &Expander<R>, at: &State<R>) -> State<Jets<R>> {
    let number = |j: usize| R::from_ratio(j as i64, 1);
    let jets = |derivative: usize| -> Vec<Jets<R>> {
        let of = |i: usize| {
            let q = expander.coordinate(i);
            Jet(std::array::from_fn(|k| match derivative {
                0 => q[k],
                1 => number(k + 1) * q[k + 1],
                _ => number(k + 1) * number(k + 2) * q[k + 2],
            }))
        };
        (0..at.q.len()).map(of).collect()
    };
    let constants =
        |list: &[R]| -> Vec<Jets<R>> { list.iter().map(|&x| Jet::constant(x)).collect() };
    State {
        t: Jet::variable(at.t),
        q: jets(0),
        v: jets(1),
        a: jets(2),
        u: constants(&at.u),
        parameters: constants(&at.parameters),
    }
}

/// The generalized force of closed contacts along a direction, where these are the multipliers along their normals and, if they stick, their tangents. Accelerations that
/// have to vanish are added to the others. Nothing if a closed contact is not smooth.
fn forces_of_contacts<'s, R: Number>(
    contacts: impl Iterator<Item = (&'s ContactState, Option<SmoothContact<Jets<R>>>)>,
    multipliers: &mut impl Iterator<Item = Jets<R>>,
    vanishing: &mut Vec<Jets<R>>,
) -> Option<Jets<R>> {
    let zero = Jets::<R>::constant(R::ZERO);
    let (mut forces, mut normal) = (zero, zero);
    for (state, contact) in contacts {
        if *state == ContactState::Open {
            continue;
        }
        let SmoothContact {
            contact,
            is_carried,
        } = contact?;
        if *state == ContactState::SticksAlongTangent {
            normal = zero;
        } else if !is_carried {
            normal = multipliers.next()?;
            forces = forces + normal * contact.gap.along;
            vanishing.push(contact.gap.acceleration);
        }
        let tangential = match *state {
            ContactState::Sticks | ContactState::SticksAlongTangent => {
                vanishing.push(contact.slip.acceleration);
                multipliers.next()?
            }
            ContactState::Slips(sign) => {
                let sign = Jet::constant(R::from_ratio(-i64::from(sign), 1));
                sign * contact.coefficients[2] * normal
            }
            ContactState::Open | ContactState::SticksAlongNormal => zero,
        };
        forces = forces + tangential * contact.slip.along;
    }
    Some(forces)
}

/// Whether the numbers of all pairs are equal, each in terms of a size; nothing if that is not known.
fn are_equal<R: Number>(pairs: Vec<(R, R, f64)>) -> Option<bool> {
    for (found, expected, size) in pairs {
        let left = found - expected;
        if !left.is_finite() {
            return None;
        }
        match left.test_zero(size) {
            ZeroTest::Zero => {}
            ZeroTest::NotZero => return Some(false),
            ZeroTest::Undecided => return None,
        }
    }
    Some(true)
}
