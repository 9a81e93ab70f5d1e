//! The choice between an expression as it stands and the expression multiplied out.
//!
//! Multiplied out, terms that cancel by identities vanish, and gaps of circles become short. But where the terms are large numbers whose sum is small,
//! round-off grows: `(x − 4000)²` near x = 4000 is a small square, and `x² − 8000 x + 16 000 000` a difference of large numbers. What matters is the
//! neighbourhood of states where the gap is closed, since impacts are found there.

use lagrangian_program::rounding::State;
use lagrangian_scalar::{Ball, Scalar};
use lagrangian_symbolic::{Evaluation, Expr, Symbol, normal};

use super::kinematics::gradient;
use crate::states::{Symbols, around_start};
use lagrangian_spec::model::Model;

/// The largest number of terms of a gap or a slip that is multiplied out to find what cancels: the distance of two circles in
/// polar coordinates has a dozen.
const TERMS: usize = 200;

/// The number of states at which round-off is compared.
const STATES: usize = 4;

/// The Newton steps from such a state towards one where the gap is closed.
const STEPS: usize = 6;

/// How many times as much round-off the multiplied-out form may have: as many terms as it has add as many errors.
const MORE: f64 = 8.0;

/// An expression as it is or multiplied out, whichever is shorter, if that is as accurate where `gap` is closed.
pub(super) fn shorter<'d>(model: &Model<'d>, (e, gap): (Expr<'d>, Expr<'d>)) -> Expr<'d> {
    let other = normal::readable(e, TERMS);
    if is_as_accurate(model, [e, other], Some(gap)) {
        other
    } else {
        e
    }
}

/// Whether the second of two forms of an expression has no more round-off than the first, at states around the start, and where a gap is closed near them.
///
/// Round-off is the radius of a [`Ball`], which bounds the error of all operations; the operations of both forms are those of the compiler's
/// graph, before common parts are shared.
pub(crate) fn is_as_accurate<'d>(
    model: &Model<'d>,
    [e, other]: [Expr<'d>; 2],
    gap: Option<Expr<'d>>,
) -> bool {
    if other.id() == e.id() {
        return true;
    }
    let symbols = Symbols::of(model);
    let around = around_start(model, 1, STATES);
    let value = |state: &State, symbol: Symbol| symbols.value(symbol, &around.parameters, state);
    let both = Evaluation::new(model.dag, &[e, other]);
    let is_so = |state: &State| {
        let balls = both.values(|symbol| Ball::from_f64(value(state, symbol)));
        let [e, other] = [balls[0], balls[1]];
        // A state at which the expression has no value tells nothing.
        !e.is_finite() || other.is_finite() && other.radius() <= MORE * e.radius()
    };
    let places: Vec<Symbol> = (model.coordinates.iter())
        .filter_map(|coordinate| coordinate.q.as_symbol())
        .collect();
    let gap = gap.map(|gap| {
        let slopes = gradient(model.dag, gap, &places);
        let all: Vec<Expr<'d>> = [gap].into_iter().chain(slopes).collect();
        Evaluation::new(model.dag, &all)
    });
    around.states.iter().all(|state| {
        let mut state = state.clone();
        let is_here = is_so(&state);
        let Some(gap) = &gap else {
            return is_here;
        };
        for _ in 0..STEPS {
            let values = gap.values(|symbol| value(&state, symbol));
            let (gap, slopes) = (values[0], &values[1..]);
            let square: f64 = slopes.iter().map(|slope| slope * slope).sum();
            let step = gap / square;
            if !step.is_finite() {
                break;
            }
            for (q, slope) in state.q.iter_mut().zip(slopes) {
                *q -= step * slope;
            }
        }
        is_here && is_so(&state)
    })
}
