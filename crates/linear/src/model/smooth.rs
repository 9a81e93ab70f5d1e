//! Tests whether the equations are smooth at a state.

use lagrangian_scalar::{DoubleDouble, Dual};

use super::{At, Label, NamedRequest, NoModel, Observed, constants, rate, respond};
use crate::reduced::{Number, Reduced};

/// The distances on both sides of a state at which the search looks for corners, in rad, m, or relative to the coordinate.
const NEAR: [f64; 2] = [1e-10, 1e-13];

/// Numbers below this fraction of the largest are the round-off of 32 digits.
const ROUNDING: f64 = 1e-21;

/// Checks that no term has a corner or a jump at the state, as `abs`, `sign`, `min` and `max` have where their arguments change sides.
///
/// All terms of the equations are evaluated on both sides of the state, with their derivatives, at two distances. For a smooth term
/// the difference of the sides falls with the distance; at a corner it stays. With 32 digits there is no round-off at these distances.
pub(super) fn smooth(
    reduced: &mut Reduced<'_>,
    named_request: &NamedRequest<'_>,
    at: &At<'_>,
) -> Result<(), NoModel> {
    let (q, s) = (constants(&at.place.q), constants(&at.place.s));
    let here = respond(reduced, named_request, at.choice, &q, &s)?;
    let (n, u) = (q.len(), reduced.inputs_mut().to_vec());
    let time = reduced.time();
    let state = [&q[..], &here.rates, &u, &here.all].concat();
    // A generic direction first; then one number after the other, to name the culprit.
    let weight = |k: usize| 0.5 + (k * 29 % 97) as f64 / 97.0;
    let m = reduced.constraints();
    let mut jump = |only: Option<usize>| -> Option<usize> {
        let numbers = |by: f64| -> Vec<Number> {
            let moved = state.iter().enumerate().map(|(k, x)| {
                let weight = match only {
                    Some(one) if one != k => 0.0,
                    _ => weight(k),
                };
                let unit = DoubleDouble::from(x.value.hi().abs().max(1.0) * weight);
                Dual {
                    value: x.value + unit * DoubleDouble::from(by),
                    derivative: unit,
                }
            });
            let moved: Vec<Number> = moved.collect();
            let (q, rest) = moved.split_at(n);
            let (v, rest) = rest.split_at(n);
            let (inputs, a) = rest.split_at(u.len());
            reduced.inputs_mut().copy_from_slice(inputs);
            let mut numbers = reduced.ingredients(q, v, time).concat();
            for observed in &named_request.request.outputs {
                if let Observed::Output(k) = *observed {
                    numbers.push(reduced.output(k, (q, v, a)));
                }
            }
            reduced.inputs_mut().copy_from_slice(&u);
            numbers
        };
        first_corner(numbers)
    };
    let Some(index) = jump(None) else {
        return Ok(());
    };
    let is_output = |pair: &(&Observed, &Label)| matches!(pair.0, Observed::Output(_));
    let outputs = named_request
        .request
        .outputs
        .iter()
        .zip(&named_request.outputs);
    let mut outputs = outputs.filter(is_output).map(|(_, label)| label);
    let equations = numbers_of_equations(n, m);
    if let Some(label) = index
        .checked_sub(equations)
        .and_then(|index| outputs.nth(index))
    {
        return Err(NoModel::OutputKink(label.name.clone()));
    }
    let only = (0..2 * n + u.len()).find(|k| jump(Some(*k)).is_some());
    Err(NoModel::Kink(match only {
        Some(k) if k < n => Some(named_request.coordinates[k].name.clone()),
        Some(k) if k < 2 * n => Some(rate(&named_request.coordinates[k - n], 1).name),
        _ => None,
    }))
}

/// The first of the numbers at a distance from a state that has a corner or a jump there.
fn first_corner(mut numbers: impl FnMut(f64) -> Vec<Number>) -> Option<usize> {
    let here = numbers(0.0);
    let [far, near] = NEAR.map(|by| {
        let (above, below) = (numbers(by), numbers(-by));
        let off = |x: DoubleDouble, y: DoubleDouble| (x - y).hi().abs();
        let differ = above.iter().zip(&below).zip(&here).map(|((x, y), z)| {
            [
                off(x.value, y.value),
                off(x.derivative, y.derivative),
                // At a corner itself dual numbers take some slope between the slopes of the two sides.
                off(x.derivative, z.derivative),
            ]
        });
        differ.collect::<Vec<[f64; 3]>>()
    });
    let all = numbers(NEAR[0]);
    let sizes = all.iter().flat_map(|x| [x.value.hi(), x.derivative.hi()]);
    let largest = sizes.fold(0.0, |largest: f64, x| largest.max(x.abs()));
    (0..all.len()).find(|&i| {
        let pairs = near[i].iter().zip(far[i]);
        let mut stays = pairs.map(|(near, far)| *near > 0.5 * far && *near > ROUNDING * largest);
        stays.any(|stays| stays)
    })
}

/// How many terms precede the outputs.
fn numbers_of_equations(n: usize, m: usize) -> usize {
    n * (n + 1) / 2 + n + m * n + 3 * m
}
