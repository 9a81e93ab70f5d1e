//! Compares series as machine code with the interpreter of series.

use std::sync::Arc;

use lagrangian_jit::{Level, Library, SeriesCode, SeriesRunning, SeriesSeveral};
use lagrangian_native::{Lanes, Number};
use lagrangian_program::Singular;
use lagrangian_program::series::{Expander, Series};
use lagrangian_scalar::{Kernel, Scalar};

use super::check::Numbers;

/// Numbers of coefficients of the accelerations: those of steps, and the fewest.
const ORDERS: [usize; 4] = [12, 20, 3, 2];

/// The number of states for each machine and number of coefficients; a quarter of them have numbers that are huge, tiny, NaN or infinite.
const STATES: usize = 16;

/// An expansion by the interpreter in the arithmetic of compiled machines.
struct Expand<'a> {
    expander: &'a mut Expander<f64>,
    at: ([f64; 2], [&'a [f64]; 3]),
}

impl Kernel<f64> for Expand<'_> {
    type Output = Result<(), Singular>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        let (t, [q, v, u]) = self.at;
        self.expander.expand_in::<N>(t, q, v, u)
    }
}

/// Compares the coefficients at random states, and returns how many were compared.
///
/// # Errors
/// The first difference.
pub fn agrees(
    series: &Arc<Series>,
    parameters: &[f64],
    level: Level,
    seed: u64,
) -> Result<usize, String> {
    let code = Arc::new(SeriesCode::at(series, level).map_err(|error| error.to_string())?);
    let mut numbers = Numbers(seed);
    let n = series.dimension();
    let mut compared = 0;
    for order in ORDERS {
        let mut expander = Expander::<f64>::new(series.clone(), parameters, order);
        let mut running = SeriesRunning::new(code.clone(), &expander);
        for state in 0..STATES {
            let mut take = |count: usize| -> Vec<f64> {
                let wild = state % 4 == 3;
                (0..count).map(|_| numbers.of_state(wild)).collect()
            };
            let (t, q, v, u) = (take(2), take(n), take(n), take(series.inputs));
            let (t, state) = ([t[0], t[1] * f64::EPSILON], [&q[..], &v[..], &u[..]]);
            let mut found = vec![vec![0.0; n]; order + 2];
            let is_found = running.expand(t, state, &mut found);
            let expanded = f64::run(Expand {
                expander: &mut expander,
                at: (t, state),
            });
            // Zeros are positive, except in the state itself.
            let zero = |j: usize| if j < 2 { -0.0 } else { 0.0 };
            let expected = |j: usize, i: usize| expander.coordinate(i)[j] + zero(j);
            let all = (0..order + 2).flat_map(|j| (0..n).map(move |i| (j, i)));
            let has_value =
                expanded.is_ok() && all.clone().all(|(j, i)| expected(j, i).is_finite());
            let what = format!("{level:?}, seed {seed}, {order} coefficients");
            if has_value != is_found {
                return Err(format!(
                    "{what}: found {is_found}, interpreted {expanded:?} {has_value}"
                ));
            }
            if !has_value {
                continue;
            }
            for (j, i) in all {
                let (expected, found) = (expected(j, i), found[j][i]);
                let is_same = expected.to_bits() == found.to_bits();
                if !is_same {
                    return Err(format!(
                        "{what}: coefficient {j} of {i} is {found:e}, interpreted {expected:e}"
                    ));
                }
                compared += 1;
            }
        }
    }
    Ok(compared)
}

/// Compares the coefficients of N states at once, each with its own parameters near the given ones, and returns how many were compared. In a quarter of
/// the groups, every second state has numbers that are huge, tiny, NaN or infinite.
///
/// # Errors
/// The first difference.
pub fn agrees_in_lanes<const N: usize>(
    series: &Arc<Series>,
    parameters: &[f64],
    level: Level,
    seed: u64,
) -> Result<usize, String>
where
    Lanes<N>: Number,
{
    let layout = Library::several(level, N, false).ok_or("no such layout")?;
    let code = SeriesCode::of(series, layout).map_err(|error| error.to_string())?;
    let code = Arc::new(code);
    let mut numbers = Numbers(seed);
    let n = series.dimension();
    let mut compared = 0;
    for order in ORDERS {
        let mut expanders: Vec<Expander<f64>> = (0..N)
            .map(|_| {
                let near = parameters.iter();
                let near: Vec<f64> = near.map(|p| p * (1.0 + numbers.small() / 8.0)).collect();
                Expander::new(series.clone(), &near, order)
            })
            .collect();
        let mut several = SeriesSeveral::<N>::new(code.clone(), &expanders[0]).ok_or("no lanes")?;
        for (lane, expander) in expanders.iter().enumerate() {
            several.put(lane, expander);
        }
        for group in 0..STATES {
            let mut take = |count: usize| -> Vec<Lanes<N>> {
                let mut each = || {
                    Lanes(std::array::from_fn(|lane| {
                        numbers.of_state(group % 4 == 3 && lane % 2 == 1)
                    }))
                };
                (0..count).map(|_| each()).collect()
            };
            let (mut t, q, v, u) = (take(2), take(n), take(n), take(series.inputs));
            for low in &mut t[1].0 {
                *low *= f64::EPSILON;
            }
            let mut found = vec![vec![Lanes::splat(0.0); n]; order + 2];
            let mask = several.expand([t[0], t[1]], [&q, &v, &u], &mut found);
            let mut is_singular = false;
            let mut has_value = [false; N];
            for (lane, expander) in expanders.iter_mut().enumerate() {
                let own =
                    |rows: &[Lanes<N>]| -> Vec<f64> { rows.iter().map(|row| row[lane]).collect() };
                let (q, v, u) = (own(&q), own(&v), own(&u));
                let expanded = f64::run(Expand {
                    expander,
                    at: ([t[0][lane], t[1][lane]], [&q, &v, &u]),
                });
                is_singular |= expanded.is_err();
                let zero = |j: usize| if j < 2 { -0.0 } else { 0.0 };
                let expected = |j: usize, i: usize| expander.coordinate(i)[j] + zero(j);
                let all = (0..order + 2).flat_map(|j| (0..n).map(move |i| (j, i)));
                has_value[lane] =
                    expanded.is_ok() && all.clone().all(|(j, i)| expected(j, i).is_finite());
                if mask >> lane & 1 == 0 {
                    continue;
                }
                let what =
                    format!("{level:?}, lane {lane} of {N}, seed {seed}, {order} coefficients");
                if !has_value[lane] {
                    return Err(format!("{what}: a value, interpreted {expanded:?}"));
                }
                for (j, i) in all {
                    let (expected, found) = (expected(j, i), found[j][i][lane]);
                    if expected.to_bits() != found.to_bits() {
                        return Err(format!(
                            "{what}: coefficient {j} of {i} is {found:e}, interpreted {expected:e}"
                        ));
                    }
                    compared += 1;
                }
            }
            let with_values = (has_value.iter().enumerate())
                .fold(0, |mask, (lane, has)| mask | u32::from(*has) << lane);
            // Where the matrix of one state cannot be inverted, none has a value.
            if mask != with_values && !(mask == 0 && is_singular) {
                return Err(format!(
                    "{level:?}, {N} lanes, seed {seed}, {order} coefficients: {mask:b} have values, interpreted {with_values:b}"
                ));
            }
        }
    }
    Ok(compared)
}
