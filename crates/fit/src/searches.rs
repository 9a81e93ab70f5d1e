//! Several searches from several places, with standard deviations that are given, or found on the way.

use crate::least_squares::{Minimum, Trouble};
use crate::motion::{Fit, Found, Sought};

/// Standard deviations of the measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sigmas {
    /// In the proportions of [`Fit::sigmas`], and otherwise not known.
    Equal,
    /// Those of [`Fit::sigmas`].
    Given,
    /// Found with the fit, from these on: searches and estimates take turns until neither changes.
    Estimated,
}

/// Where one of several searches ended.
#[derive(Clone, Debug)]
pub struct Search {
    /// Where it began.
    pub from: Vec<f64>,
    /// The end, or why there is none.
    pub end: Result<Minimum, String>,
}

/// What several searches found.
#[derive(Clone, Debug)]
pub struct Searched {
    /// The least of the minima.
    pub found: Found,
    /// All of them, with the standard deviations from which estimates go on.
    pub searches: Vec<Search>,
    /// The number of the one that found it.
    pub best: usize,
}

/// Why nothing was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failed {
    /// No search had a motion to begin with; why the first had none.
    NoStart(String),
    /// Estimates of standard deviations do not settle.
    Unsettled,
    /// A motion that was there is not, or somebody asked to stop.
    Trouble(Trouble),
}

/// Standard deviations have settled when none changes by more than this share any more.
const SETTLED: f64 = 1e-6;

/// They are given up after so many turns.
const MOST_TURNS: usize = 50;

/// The least of the minima to which so many searches lead: the first from where the search is to begin, others from the points
/// of [`spread`].
///
/// # Errors
/// If there is none.
pub fn search(fit: &mut Fit<'_>, count: usize, sigmas: Sigmas) -> Result<Searched, Failed> {
    let mut searches = Vec::new();
    for index in 0..count.max(1) {
        let from = spread(&fit.sought, index);
        let end = match fit.search(&from) {
            Ok(minimum) => Ok(minimum),
            Err(Trouble::NoValue(why)) => Err(why),
            Err(Trouble::Stopped) => return Err(Failed::Trouble(Trouble::Stopped)),
        };
        searches.push(Search { from, end });
    }
    let sum = |search: &Search| match &search.end {
        Ok(minimum) => minimum.sums.last().copied().unwrap_or(f64::INFINITY),
        Err(_) => f64::INFINITY,
    };
    let best = (0..searches.len())
        .min_by(|a, b| sum(&searches[*a]).total_cmp(&sum(&searches[*b])))
        .unwrap_or(0);
    let mut minimum = match &searches[best].end {
        Ok(minimum) => minimum.clone(),
        Err(why) => return Err(Failed::NoStart(why.clone())),
    };
    if sigmas == Sigmas::Estimated {
        minimum = settled(fit, minimum)?;
    }
    let found = fit
        .found(minimum, sigmas == Sigmas::Equal)
        .map_err(Failed::Trouble)?;
    Ok(Searched {
        found,
        searches,
        best,
    })
}

/// The minimum with the standard deviations that its own residuals have.
fn settled(fit: &mut Fit<'_>, mut minimum: Minimum) -> Result<Minimum, Failed> {
    for _ in 0..MOST_TURNS {
        let estimated = fit.estimated_sigmas(&minimum);
        let pairs = estimated.iter().zip(&fit.sigmas);
        let change = pairs.map(|(new, old)| (new / old - 1.0).abs());
        let change = change.fold(0.0, f64::max);
        fit.sigmas = estimated;
        minimum = fit.search(&minimum.x).map_err(Failed::Trouble)?;
        if change <= SETTLED {
            return Ok(minimum);
        }
    }
    Err(Failed::Unsettled)
}

/// Where a search begins: the first where it is to, others between the bounds, or within a factor of 3 where there are none.
///
/// They are the points of the additive sequence of the generalized golden ratio, which fill a box evenly and are the same in
/// every run (M. Roberts, *The unreasonable effectiveness of quasirandom sequences*, 2018). Between bounds that are positive and more than a
/// decade apart logarithms are spread.
pub fn spread(sought: &[Sought], index: usize) -> Vec<f64> {
    if index == 0 {
        return sought.iter().map(|one| one.from).collect();
    }
    // The root of g^(d + 1) = g + 1.
    let mut golden = 2.0_f64;
    for _ in 0..64 {
        golden = (1.0 + golden).powf(1.0 / (sought.len() as f64 + 1.0));
    }
    let place = |(j, one): (usize, &Sought)| {
        let step = golden.powi(-(j as i32 + 1));
        let share = (0.5 + step * index as f64).fract();
        let [low, high] = one.bounds;
        if low.is_finite() && high.is_finite() {
            return if low > 0.0 && high > 10.0 * low {
                low * (high / low).powf(share)
            } else {
                low + (high - low) * share
            };
        }
        let x = if one.from == 0.0 {
            2.0 * share - 1.0
        } else {
            one.from * 3.0_f64.powf(2.0 * share - 1.0)
        };
        x.clamp(low, high)
    };
    sought.iter().enumerate().map(place).collect()
}
