//! A steady motion as found by the search, and the small motions about it.
//!
//! A motion is steady if nothing accelerates along it, `ṡ = 0`, and if the equations do not change where the machine moves. A
//! deviation δz of the coordinates and δs of the rates then obeys equations with constant coefficients,
//!
//! ```text
//! δṡ = (Tᵀ M T)⁻¹ (∂r/∂z δz + ∂r/∂s δs)
//! δż_F = ∂v_F/∂z δz + T_F δs                                                        (E40)
//! ```
//!
//! Coordinates that only record how far the machine has moved, such as the position on a table around which a coin circles,
//! are an exception: their coefficients rotate with the motion. Nothing depends on them, and they are left out.

use lagrangian_eigen::spectrum::{self, Linear, Mode, Modes};
use nalgebra::{Complex, DMatrix};

use crate::reduced::{Choice, Fault, Linearized, Reduced, ReducedState, divided};
use crate::search::{Stationary, without_roundoff};

/// By how much moving coordinates are shifted, in rad, m or relative to the coordinate, to test whether anything
/// depends on them.
const SHIFTS: [f64; 2] = [0.0625, -0.21875];

/// Numbers of 32 digits that differ by at most this fraction of the largest number beside them differ by round-off.
pub(crate) const SAME: f64 = 1e-22;

/// A steady motion and the small motions about it.
#[derive(Clone)]
pub struct SteadyMotion {
    /// The state.
    pub found: Stationary,
    /// Rates of all coordinates, states of first order among them; set to 0 within round-off.
    pub v: Vec<f64>,
    /// The modes about the motion; their shapes have an entry for each coordinate.
    pub modes: Modes,
    /// Coordinates that only record how far the machine has moved: they have no part in shapes. The integrals of states
    /// of first order are among them; in their place shapes have the amplitude of the state.
    pub records: Vec<bool>,
}

/// Why a motion is not steady.
pub enum Unsteady {
    /// The equations depend on this coordinate, which moves.
    Depends(usize),
    /// They depend on the first coordinate, whose rate changes while the second one moves.
    Follows(usize, usize),
    /// The equations cannot be evaluated.
    Fault(Fault),
    /// The eigenvalue iteration failed.
    NoEigenvalues,
}

/// A state to be tested for steadiness.
pub struct State<'a> {
    /// Which coordinates follow from which constraints.
    pub choice: &'a Choice,
    /// The state.
    pub place: &'a ReducedState,
    /// The equations there.
    pub here: &'a Linearized,
    /// Bounds on the effect of rounding on them.
    pub bounds: &'a Linearized,
}

impl Stationary {
    /// The state in the form in which it is tested for steadiness.
    pub fn state(&self) -> State<'_> {
        State {
            choice: &self.choice,
            place: &self.place,
            here: &self.here,
            bounds: &self.bounds,
        }
    }
}

/// Positions to which a coordinate may have moved, together with those that follow by constraints on positions; none
/// where the constraints cannot be met there.
pub(crate) fn elsewhere(
    reduced: &mut Reduced<'_>,
    choice: &Choice,
    place: &ReducedState,
    j: usize,
) -> Vec<ReducedState> {
    let moved = SHIFTS.into_iter().filter_map(|shift| {
        let mut there = place.clone();
        let by = shift * there.q[j].hi().abs().max(1.0);
        there.q[j] = there.q[j] + by.into();
        let projected = reduced.project(&mut there.q, &|i| choice.position_dependent.contains(&i));
        projected.is_ok().then_some(there)
    });
    moved.collect()
}

/// The equations at two positions, with bounds on the effect of rounding.
struct Compared<'a> {
    here: &'a Linearized,
    there: &'a Linearized,
    bounds: &'a Linearized,
}

impl Compared<'_> {
    /// Whether an entry of a matrix is the same at both positions. Entries that are 0 but for round-off are differences of numbers of
    /// this size.
    fn is_same(
        &self,
        of: fn(&Linearized) -> &DMatrix<f64>,
        place: (usize, usize),
        size: f64,
    ) -> bool {
        let limit = of(self.bounds)[place].max(SAME * size);
        (of(self.here)[place] - of(self.there)[place]).abs() <= limit
    }

    /// Whether forces and their derivatives are the same.
    fn have_same_equations(&self) -> bool {
        let all = |of: fn(&Linearized) -> &DMatrix<f64>, size: f64| {
            let (rows, columns) = of(self.here).shape();
            let mut each = (0..rows).flat_map(|i| (0..columns).map(move |k| (i, k)));
            each.all(|place| self.is_same(of, place, size))
        };
        let greater = |of: fn(&Linearized) -> &DMatrix<f64>| {
            largest(of(self.here)).max(largest(of(self.there)))
        };
        let rate = greater(|it| &it.by_rates);
        let force = greater(|it| &it.by_places) + rate * largest(&self.here.rates);
        all(|it| &it.forces, force)
            && all(|it| &it.by_places, force)
            && all(|it| &it.by_rates, rate)
    }

    /// Whether the rate of a coordinate that follows by constraints on rates is the same.
    fn has_same_rate(&self, row: usize, coordinate: usize) -> bool {
        let (by, along) = (&self.here.rate_dependent_by_places, &self.here.along);
        let size = largest(by) + largest(&self.here.rates);
        (0..by.ncols()).all(|k| self.is_same(|it| &it.rate_dependent_by_places, (row, k), size))
            && (0..along.ncols())
                .all(|k| self.is_same(|it| &it.along, (coordinate, k), largest(along)))
    }

    /// Whether a coordinate that follows by constraints on positions moves alike.
    fn has_same_tangent(&self, coordinate: usize) -> bool {
        let tangent = &self.here.tangent;
        (0..tangent.ncols())
            .all(|k| self.is_same(|it| &it.tangent, (coordinate, k), largest(tangent)))
    }
}

fn largest(m: &DMatrix<f64>) -> f64 {
    m.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

/// Which coordinates only record how far the machine has moved.
///
/// # Errors
/// If the equations change where the machine moves.
pub fn records(reduced: &mut Reduced<'_>, state: &State<'_>) -> Result<Vec<bool>, Unsteady> {
    let State {
        choice,
        place,
        here,
        bounds,
    } = state;
    let places = choice.places();
    let mut records = vec![false; reduced.dimension()];
    // The index of the coordinate that moved when the rate of each one changed.
    let mut because = vec![0; reduced.dimension()];
    let moves = |j: &usize| here.rates[*j].abs() > bounds.rates[*j];
    for &j in places.iter().filter(|j| moves(j)) {
        for there in elsewhere(reduced, choice, place, j) {
            // Positions at which the equations cannot be evaluated are skipped.
            let Ok(there) = reduced.linearized_only(choice, &there) else {
                continue;
            };
            let both = Compared {
                here,
                there: &there,
                bounds,
            };
            if !both.have_same_equations() {
                return Err(Unsteady::Depends(j));
            }
            let rates = choice.rate_dependent.iter().enumerate();
            let rates = rates.filter(|(row, i)| !both.has_same_rate(*row, **i));
            let changed = choice.position_dependent.iter();
            let changed = changed.filter(|i| !both.has_same_tangent(**i));
            for &i in rates.map(|(_, i)| i).chain(changed) {
                if !std::mem::replace(&mut records[i], true) {
                    because[i] = j;
                }
            }
        }
    }
    // Nothing may depend on a coordinate that only records.
    for (column, &j) in places.iter().enumerate().filter(|(_, j)| records[**j]) {
        let depends = (0..here.by_places.nrows())
            .any(|i| here.by_places[(i, column)].abs() > bounds.by_places[(i, column)]);
        let drives = choice.rate_dependent.iter().enumerate().any(|(row, i)| {
            let entry = here.rate_dependent_by_places[(row, column)].abs();
            !records[*i] && entry > bounds.rate_dependent_by_places[(row, column)]
        });
        if depends || drives {
            return Err(Unsteady::Follows(j, because[j]));
        }
    }
    Ok(records)
}

/// The small motions about a steady one.
///
/// # Errors
/// If the motion is not steady, or the eigenvalue iteration fails.
pub fn near(
    reduced: &mut Reduced<'_>,
    found: Stationary,
    steady: &[bool],
) -> Result<SteadyMotion, Unsteady> {
    let mut records = records(reduced, &found.state())?;
    let Stationary { here, bounds, .. } = &found;
    let places = found.choice.places();
    let kept: Vec<usize> = (0..places.len()).filter(|c| !records[places[*c]]).collect();
    let linear = linear(&found, &kept)?;
    let mut modes = spectrum::modes(&linear).ok_or(Unsteady::NoEigenvalues)?;
    modes.free += places.len() - kept.len();
    let tangent = columns(&without_roundoff(&here.tangent, &bounds.tangent), &kept);
    for mode in &mut modes.modes {
        mode.shape = in_coordinates(&tangent, &records, mode);
    }
    let integrals = reduced.integrals();
    let modes = of_states(modes, &integrals);
    for (record, is_integral) in records.iter_mut().zip(&integrals) {
        *record |= is_integral;
    }
    let v = (0..reduced.dimension()).map(|j| {
        let v = here.rates[j];
        if v.abs() <= bounds.rates[j] && !steady[j] {
            0.0
        } else {
            v
        }
    });
    Ok(SteadyMotion {
        v: v.collect(),
        modes,
        records,
        found,
    })
}

/// The linear equations of the small motions of the coordinates that do not only record, those with the columns `kept`.
fn linear(found: &Stationary, kept: &[usize]) -> Result<Linear, Unsteady> {
    let Stationary {
        choice,
        here,
        bounds,
        ..
    } = found;
    let moving = choice.independent.len();
    let rate_dependent: Vec<usize> = kept
        .iter()
        .filter(|c| **c >= moving)
        .map(|c| c - moving)
        .collect();
    let singular = || {
        Unsteady::Fault(Fault::Singular(
            choice.independent.first().copied().unwrap_or(0),
        ))
    };
    let by_places = without_roundoff(&here.by_places, &bounds.by_places);
    let by_rates = without_roundoff(&here.by_rates, &bounds.by_rates);
    let k = divided(&here.mass, &by_places).ok_or_else(singular)?;
    let c = divided(&here.mass, &by_rates).ok_or_else(singular)?;
    let inverse = divided(&here.mass, &DMatrix::identity(moving, moving)).ok_or_else(singular)?;
    let inverse = inverse.abs();
    let k_bounds = &inverse * (&bounds.by_places + &bounds.mass * k.abs());
    let c_bounds = &inverse * (&bounds.by_rates + &bounds.mass * c.abs());
    let p = without_roundoff(
        &here.rate_dependent_by_places,
        &bounds.rate_dependent_by_places,
    );
    let p = columns(&p, kept);
    let p_bounds = columns(&bounds.rate_dependent_by_places, kept);
    let b = DMatrix::from_fn(rate_dependent.len(), moving, |i, j| {
        let row = choice.rate_dependent[rate_dependent[i]];
        let (x, bound) = (here.along[(row, j)], bounds.along[(row, j)]);
        if x.abs() <= bound { 0.0 } else { x }
    });
    let k_bounds = columns(&k_bounds, kept);
    Ok(Linear {
        k: columns(&k, kept),
        c,
        p: DMatrix::from_fn(rate_dependent.len(), kept.len(), |i, j| {
            p[(rate_dependent[i], j)]
        }),
        b,
        k_bounds: DMatrix::from_fn(kept.len(), kept.len(), |i, j| {
            if i < moving {
                k_bounds[(i, j)]
            } else {
                p_bounds[(rate_dependent[i - moving], j)]
            }
        }),
        c_bounds,
    })
}

/// These columns of a matrix.
fn columns(m: &DMatrix<f64>, kept: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(m.nrows(), kept.len(), |i, j| m[(i, kept[j])])
}

/// Shapes in which the amplitudes of states of first order replace those of their integrals. Modes in which only
/// integrals are displaced do not belong to the machine and are removed.
fn of_states(mut modes: Modes, integrals: &[bool]) -> Modes {
    let count = integrals.iter().filter(|is| **is).count();
    if count == 0 {
        return modes;
    }
    modes.free = modes.free.saturating_sub(count);
    let zero = Complex::new(0.0, 0.0);
    let mut free: Vec<Vec<Complex<f64>>> = Vec::new();
    modes.modes.retain_mut(|mode| {
        let is_free = mode.lambda == zero;
        for (x, _) in mode.shape.iter_mut().zip(integrals).filter(|(_, is)| **is) {
            *x = if is_free { zero } else { *x * mode.lambda };
        }
        if is_free {
            for other in &free {
                let pairs = mode.shape.iter().zip(other);
                let along = pairs.fold(zero, |sum, (x, y)| sum + x * y.conj());
                let pairs = mode.shape.iter_mut().zip(other);
                pairs.for_each(|(x, y)| *x -= along * y);
            }
            let norm = mode.shape.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
            // The shapes are of size 1, so the remainder of a dependent one is round-off.
            if norm <= 1e-9 {
                return false;
            }
            free.push(mode.shape.iter().map(|x| x / norm).collect());
        }
        let largest = mode.shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
        let first = mode
            .shape
            .iter()
            .find(|x| x.norm() >= (1.0 - 1e-9) * largest);
        if let Some(unit) = first.copied().filter(|_| largest > 0.0) {
            mode.shape.iter_mut().for_each(|x| *x /= unit);
        }
        true
    });
    modes
}

/// Converts a shape in z into one in coordinates, scaled to a largest entry of 1.
fn in_coordinates(tangent: &DMatrix<f64>, records: &[bool], mode: &Mode) -> Vec<Complex<f64>> {
    let is_own = |row: usize| {
        let mut row = tangent.row(row).into_iter().filter(|x| **x != 0.0);
        row.next().copied() == Some(1.0) && row.next().is_none()
    };
    let zero = Complex::new(0.0, 0.0);
    let shape = (0..tangent.nrows()).map(|row| {
        let terms = tangent.row(row).into_owned();
        let terms = terms.iter().zip(&mode.shape);
        if records[row] {
            zero
        } else {
            terms.fold(zero, |sum, (t, x)| sum + x * *t)
        }
    });
    let shape: Vec<Complex<f64>> = shape.collect();
    if (0..shape.len()).all(|row| records[row] || is_own(row)) {
        return shape;
    }
    let largest = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let first = shape
        .iter()
        .find(|x| x.norm() >= (1.0 - 1e-9) * largest && largest > 0.0);
    let unit = first.copied().unwrap_or(Complex::new(1.0, 0.0));
    // Round-off relative to 1.
    let settle = |x: f64| if x.abs() <= 1e-12 { 0.0 } else { x };
    let scaled = shape.iter().map(|x| x / unit);
    scaled
        .map(|x| Complex::new(settle(x.re), settle(x.im)))
        .collect()
}
