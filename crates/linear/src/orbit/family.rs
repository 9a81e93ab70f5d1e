//! Families of orbits along a parameter, and where their stability changes.

use super::{NoOrbit, Orbit, Period, Side, Sought, find};
use lagrangian::interpreted::InterpretedMachine;
use nalgebra::Complex;

/// An orbit at one value of the varied quantity.
#[derive(Clone, Debug)]
pub struct Point {
    /// The value.
    pub value: f64,
    /// The orbit there.
    pub orbit: Result<Orbit, NoOrbit>,
}

/// What happens to an orbit where multipliers cross the unit circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// One crosses 1: the branch turns back, or another branch meets it or branches off.
    Fold,
    /// One crosses −1: an orbit of twice the period branches off.
    Doubling,
    /// A pair crosses the circle elsewhere: a torus branches off.
    Torus,
}

impl Change {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Change::Fold => "fold or branching",
            Change::Doubling => "period doubling",
            Change::Torus => "torus",
        }
    }
}

/// Where the number of multipliers outside the unit circle changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changed {
    /// The two values of the varied quantity between which it happens, brought together by bisection.
    pub between: [f64; 2],
    /// The kind of change.
    pub change: Change,
    /// The multiplier outside that is nearest to the circle.
    pub multiplier: Complex<f64>,
}

/// Orbits along a range of values.
#[derive(Clone, Debug)]
pub struct Trace {
    /// An orbit for each value, or why there is none.
    pub points: Vec<Point>,
    /// The changes along the range.
    pub changes: Vec<Changed>,
}

/// How many times a step from one value to the next is halved where no orbit is found.
const MOST_BETWEEN: u32 = 6;

/// How many times an interval in which the number of multipliers outside the circle changes is bisected.
const HALVINGS: usize = 20;

/// Follows an orbit along a range of values. `make` returns the machine at a value, and the period there if one is given. Each
/// search starts from the linear extrapolation of the last two orbits, or from the last orbit.
///
/// # Errors
/// Why there is no orbit at the first value.
pub fn follow<E>(
    make: impl Fn(f64) -> Result<(InterpretedMachine, Option<f64>), E>,
    sought: &Sought,
    values: &[f64],
) -> Result<Trace, E>
where
    E: From<NoOrbit>,
{
    let solve = |value: f64, from: &Sought| -> Result<Result<Orbit, NoOrbit>, E> {
        let (machine, period) = make(value)?;
        let mut from = from.clone();
        if let Some(period) = period {
            from.period = Period::Given(period);
        }
        Ok(find(&machine, &from))
    };
    let mut known: Vec<(f64, Orbit)> = Vec::new();
    let (mut points, mut changes) = (Vec::new(), Vec::new());
    for (k, &value) in values.iter().enumerate() {
        let mut solution = solve(value, &extrapolated(sought, &known, value))?;
        if solution.is_err()
            && let Some(orbit) = in_shorter_steps(&solve, sought, &known, value)?
        {
            solution = Ok(orbit);
        }
        if let (Err(none), 0) = (&solution, k) {
            return Err(none.clone().into());
        }
        if let Ok(orbit) = &solution {
            if let Some((before, older)) = known.last()
                && older.outside() != orbit.outside()
            {
                let ends = [(*before, older.clone()), (value, orbit.clone())];
                changes.push(located(&solve, sought, ends)?);
            }
            known.push((value, orbit.clone()));
            if known.len() > 2 {
                known.remove(0);
            }
        }
        points.push(Point {
            value,
            orbit: solution,
        });
    }
    Ok(Trace { points, changes })
}

/// What to search for at a value: an orbit near the extrapolation of the known ones.
fn extrapolated(sought: &Sought, known: &[(f64, Orbit)], value: f64) -> Sought {
    let mut from = sought.clone();
    let Some((at, last)) = known.last() else {
        return from;
    };
    from.start = last.start.clone();
    let mut period = last.period;
    if let [.., (before, older), _] = known
        && before != at
    {
        let share = (value - at) / (at - before);
        let ahead = |to: &mut Vec<f64>, older: &[f64]| {
            for (x, older) in to.iter_mut().zip(older) {
                *x += share * (*x - older);
            }
        };
        ahead(&mut from.start.q.values, &older.start.q.values);
        ahead(&mut from.start.v.values, &older.start.v.values);
        let ahead = period + share * (period - older.period);
        period = if ahead > 0.5 * period { ahead } else { period };
    }
    from.period = match from.period {
        Period::Given(given) => Period::Given(given),
        _ => Period::Near(period),
    };
    from
}

/// The orbit at a value, by shorter steps that begin at the last known orbit; `None` if there is none, or if even short steps do
/// not lead to it.
fn in_shorter_steps<E>(
    solve: &impl Fn(f64, &Sought) -> Result<Result<Orbit, NoOrbit>, E>,
    sought: &Sought,
    known: &[(f64, Orbit)],
    value: f64,
) -> Result<Option<Orbit>, E> {
    let Some(&(mut at, _)) = known.last() else {
        return Ok(None);
    };
    let mut step = 0.5 * (value - at);
    let mut orbits = known.to_vec();
    let mut halved = 1;
    while halved <= MOST_BETWEEN {
        let next = if ((value - at) / step) < 1.5 {
            value
        } else {
            at + step
        };
        match solve(next, &extrapolated(sought, &orbits, next))? {
            Ok(orbit) if next == value => return Ok(Some(orbit)),
            Ok(orbit) => {
                orbits.push((next, orbit));
                at = next;
            }
            Err(_) => {
                step *= 0.5;
                halved += 1;
            }
        }
    }
    Ok(None)
}

/// Where between two orbits the number of multipliers outside the circle changes.
fn located<E>(
    solve: &impl Fn(f64, &Sought) -> Result<Result<Orbit, NoOrbit>, E>,
    sought: &Sought,
    [mut low, mut high]: [(f64, Orbit); 2],
) -> Result<Changed, E> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low.0 + high.0);
        let mut from = sought.clone();
        from.start = low.1.start.clone();
        if !matches!(from.period, Period::Given(_)) {
            from.period = Period::Near(0.5 * (low.1.period + high.1.period));
        }
        let Ok(orbit) = solve(middle, &from)? else {
            break;
        };
        if orbit.outside() == low.1.outside() {
            low = (middle, orbit)
        } else {
            high = (middle, orbit)
        }
    }
    let outer = if low.1.outside() > high.1.outside() {
        &low.1
    } else {
        &high.1
    };
    let outside = outer
        .multipliers
        .iter()
        .filter(|one| one.side() == Side::Grows);
    let nearest = outside.min_by(|a, b| a.value.norm().total_cmp(&b.value.norm()));
    let multiplier = nearest.map_or(Complex::new(1.0, 0.0), |one| one.value);
    let is_real = multiplier.im.abs() <= 1e-6;
    let change = if !is_real {
        Change::Torus
    } else if multiplier.re > 0.0 {
        Change::Fold
    } else {
        Change::Doubling
    };
    Ok(Changed {
        between: [low.0, high.0],
        change,
        multiplier,
    })
}
