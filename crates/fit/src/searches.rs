//! Several searches from several starts, with standard deviations that are given or estimated on the way.

use crate::least_squares::{Minimum, Trouble};
use crate::motion::{Fit, FitResult, Sought};

/// How standard deviations of the measurements are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sigmas {
    /// In the proportions of [`Fit::sigmas`], up to an unknown common factor.
    Equal,
    /// Those of [`Fit::sigmas`].
    Given,
    /// Estimated with the fit, starting from [`Fit::sigmas`]: searches and estimates alternate until neither changes.
    Estimated,
}

/// The outcome of one of several searches.
#[derive(Clone, Debug)]
pub struct Search {
    /// The start of the search.
    pub from: Vec<f64>,
    /// The minimum, or why there is none.
    pub end: Result<Minimum, String>,
}

/// The results of several searches.
#[derive(Clone, Debug)]
pub struct SearchResults {
    /// The lowest minimum.
    pub found: FitResult,
    /// All searches; their minima are those before standard deviations were estimated.
    pub searches: Vec<Search>,
    /// The index of the search that found the lowest minimum.
    pub best: usize,
}

/// Why nothing was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failed {
    /// No search had a motion at its start; why the first had none.
    NoStart(String),
    /// The estimates of standard deviations do not converge.
    Unsettled,
    /// A motion failed, or the search was interrupted.
    Trouble(Trouble),
}

/// Standard deviations have converged when none changes by more than this fraction.
const SETTLED: f64 = 1e-6;

/// The most alternations of searches and estimates.
const MOST_TURNS: usize = 50;

/// The lowest minimum of several searches: the first from the initial guess, the others from the points of [`distributed_starts`].
///
/// # Errors
/// If there is no minimum.
pub fn search(fit: &mut Fit<'_>, count: usize, sigmas: Sigmas) -> Result<SearchResults, Failed> {
    let mut searches = Vec::new();
    for index in 0..count.max(1) {
        let from = distributed_starts(&fit.sought, index);
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
        minimum = with_estimated_deviations(fit, minimum)?;
    }
    let result = fit
        .result(minimum, sigmas == Sigmas::Equal)
        .map_err(Failed::Trouble)?;
    Ok(SearchResults {
        found: result,
        searches,
        best,
    })
}

/// The minimum with the standard deviations estimated from its own residuals.
fn with_estimated_deviations(fit: &mut Fit<'_>, mut minimum: Minimum) -> Result<Minimum, Failed> {
    for _ in 0..MOST_TURNS {
        let estimated = fit.estimated_sigmas(&minimum);
        let pairs = estimated.iter().zip(&fit.sigmas);
        let change = pairs.map(|(new, old)| (new / old - 1.0).abs());
        let change = change.fold(0.0, f64::max);
        fit.sigmas = estimated;
        let before = minimum;
        minimum = fit.search(&before.x).map_err(Failed::Trouble)?;
        // The cost is that of all searches.
        minimum.steps += before.steps;
        minimum.evaluations += before.evaluations;
        minimum.derivatives += before.derivatives;
        if change <= SETTLED {
            return Ok(minimum);
        }
    }
    Err(Failed::Unsettled)
}

/// The start of a search: the first is the initial guess, the others lie between the bounds, or within a factor of 3 where there are none.
///
/// They are the points of the additive sequence of the generalized golden ratio, which fill a box evenly and are the same in every
/// run (M. Roberts, *The unreasonable effectiveness of quasirandom sequences*, 2018). Between positive bounds more than a decade
/// apart the logarithms are distributed evenly.
pub fn distributed_starts(sought: &[Sought], index: usize) -> Vec<f64> {
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
