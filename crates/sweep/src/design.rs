//! The design of a sweep: the values of each run, as a function of the plan and the run's index alone.

use serde::{Deserialize, Serialize};

use crate::normal::quantile;
use crate::philox::{Purpose, between, bits};
use crate::sobol::Sobol;

/// A sweep of more runs than this is assumed to be a mistake.
pub const MOST_RUNS: u64 = 1 << 40;

/// A factor of a design: a list of sets of values, which is crossed with the other factors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Factor {
    /// Values from one end to the other, both included.
    Grid {
        /// The varied name.
        name: String,
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// The number of values.
        count: u64,
        /// Whether the values are spaced logarithmically instead of linearly.
        log: bool,
    },
    /// Listed values.
    List {
        /// The varied names.
        names: Vec<String>,
        /// For each set, a value for each name.
        rows: Vec<Vec<f64>>,
    },
    /// Values drawn from distributions.
    Sample {
        /// The sampling design.
        design: Sampling,
        /// The number of sets.
        count: u64,
        /// The seed.
        seed: u64,
        /// The varied names with their distributions.
        variables: Vec<(String, Distribution)>,
    },
    /// Several factors of equal length, varied together.
    Together(
        /// The factors.
        Vec<Factor>,
    ),
}

/// How sets of values are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// Independently of each other.
    Random,
    /// Latin hypercube: each variable has one value in each of as many equally probable strata as there are sets.
    Latin,
    /// The sequence of I. M. Sobol, which fills the unit cube evenly.
    Sobol,
}

/// The distribution of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Uniform between two ends.
    Uniform(f64, f64),
    /// Log-uniform between two ends of the same sign.
    LogUniform(f64, f64),
    /// Normal: mean and standard deviation.
    Normal(f64, f64),
    /// Triangular: the two ends and the mode.
    Triangular(f64, f64, f64),
}

impl Distribution {
    /// The quantile: the value below which the fraction `u` lies.
    pub fn value(self, u: f64) -> f64 {
        match self {
            Distribution::Uniform(a, b) => a + (b - a) * u,
            Distribution::LogUniform(a, b) => a * libm::exp(u * libm::log(b / a)),
            Distribution::Normal(mean, deviation) => mean + deviation * quantile(u),
            Distribution::Triangular(a, b, peak) => {
                if u * (b - a) < peak - a {
                    a + libm::sqrt(u * (b - a) * (peak - a))
                } else {
                    b - libm::sqrt((1.0 - u) * (b - a) * (b - peak))
                }
            }
        }
    }

    /// Why there is no such distribution, if so.
    pub fn fault(self) -> Option<&'static str> {
        match self {
            Distribution::Uniform(a, b) | Distribution::LogUniform(a, b) if a >= b => {
                Some("the first end must be below the second one")
            }
            Distribution::LogUniform(a, b) if a * b <= 0.0 => {
                Some("both ends must have the same sign, and neither may be 0")
            }
            Distribution::Normal(_, deviation) if deviation <= 0.0 => {
                Some("a standard deviation must be greater than 0")
            }
            Distribution::Triangular(a, b, peak) if a >= b || !(a..=b).contains(&peak) => {
                Some("the first end must be below the second one, and the peak between them")
            }
            _ => None,
        }
    }

    /// Whether its range is unbounded.
    fn is_unbounded(self) -> bool {
        matches!(self, Distribution::Normal(..))
    }
}

impl Factor {
    /// The varied names.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Factor::Grid { name, .. } => vec![name],
            Factor::List { names, .. } => names.iter().map(String::as_str).collect(),
            Factor::Sample { variables, .. } => {
                variables.iter().map(|(name, _)| name.as_str()).collect()
            }
            Factor::Together(parts) => parts.iter().flat_map(Factor::names).collect(),
        }
    }

    /// Why it is no design, if so: its values do not belong to its names, or there are none for them.
    pub fn fault(&self) -> Option<String> {
        if self.names().is_empty() {
            return Some("a factor of the design varies nothing".into());
        }
        match self {
            Factor::Grid {
                name,
                from,
                to,
                log: true,
                ..
            } if from * to <= 0.0 => Some(format!(
                "{name}: both ends of a geometric grid must have the same sign, and neither may be 0"
            )),
            Factor::Grid { .. } => None,
            Factor::Sample { variables, .. } => {
                let mut variables = variables.iter();
                let fault = |(name, of): &(String, Distribution)| {
                    let fault = of.fault()?;
                    Some(format!("{name}: {fault}"))
                };
                variables.find_map(fault)
            }
            Factor::List { names, rows } => {
                let row = rows.iter().position(|row| row.len() != names.len())?;
                let (found, expected) = (rows[row].len(), names.len());
                Some(format!(
                    "set {row} of a list of the design has {found} values for {expected} names"
                ))
            }
            Factor::Together(parts) => {
                let count = self.count();
                let differs = parts.iter().find(|part| part.count() != count);
                let differs = differs.map(|part| {
                    let found = part.count();
                    format!("factors of the design that are varied together have {count} and {found} values")
                });
                differs.or_else(|| parts.iter().find_map(Factor::fault))
            }
        }
    }

    /// The number of sets of values.
    pub fn count(&self) -> u64 {
        match self {
            Factor::Grid { count, .. } | Factor::Sample { count, .. } => *count,
            Factor::List { rows, .. } => rows.len() as u64,
            Factor::Together(parts) => parts.first().map_or(1, Factor::count),
        }
    }

    /// Appends the set with this index.
    fn values(&self, index: u64, to: &mut Vec<f64>) {
        match self {
            &Factor::Grid {
                from,
                to: last,
                count,
                log,
                ..
            } => to.push(match (index, log) {
                (0, _) => from,
                _ if index + 1 == count => last,
                (_, false) => from + (last - from) * (index as f64 / (count - 1) as f64),
                (_, true) => {
                    let part = index as f64 / (count - 1) as f64;
                    from * libm::exp(libm::log(last / from) * part)
                }
            }),
            Factor::List { rows, .. } => {
                to.extend(rows.get(index as usize).into_iter().flatten().copied());
            }
            Factor::Sample {
                design,
                count,
                seed,
                variables,
            } => {
                for (k, (_, distribution)) in variables.iter().enumerate() {
                    let k = k as u32;
                    let u = share((*design, *count, *seed), index, k, *distribution);
                    to.push(distribution.value(u));
                }
            }
            Factor::Together(parts) => parts.iter().for_each(|part| part.values(index, to)),
        }
    }
}

/// The position of a variable of a set between 0 and 1.
fn share(
    (design, count, seed): (Sampling, u64, u64),
    index: u64,
    variable: u32,
    distribution: Distribution,
) -> f64 {
    match design {
        Sampling::Random => between(bits(seed, index, variable, Purpose::Value)),
        Sampling::Latin => {
            let stratum = permuted(index, count, (seed, variable));
            let place = between(bits(seed, index, variable, Purpose::Position));
            // Stays below 1 even where the sum is rounded up to the count.
            ((stratum as f64 + place) / count as f64).min(1.0 - f64::EPSILON / 2.0)
        }
        Sampling::Sobol => {
            let digits = Sobol::digits(index, variable);
            let unit = 1.0 / (1u64 << Sobol::BITS) as f64;
            if seed == 0 {
                let u = digits as f64 * unit;
                // The sequence begins at 0, where an unbounded distribution has no value: so each point is moved to
                // the middle of its cell from the corner.
                let cell = 1.0 / count.next_power_of_two() as f64;
                return u + if distribution.is_unbounded() {
                    0.5 * cell
                } else {
                    0.0
                };
            }
            let shift = bits(seed, 0, variable, Purpose::Shift) >> (64 - Sobol::BITS);
            ((digits ^ shift) as f64 + 0.5) * unit
        }
    }
}

/// The image of a number below `count` under a random permutation: a Feistel network over a power of 4 whose cycle
/// is followed until the result is below `count` again.
fn permuted(index: u64, count: u64, (seed, variable): (u64, u32)) -> u64 {
    let half = (64 - count.saturating_sub(1).leading_zeros())
        .div_ceil(2)
        .max(1);
    let mask = (1u64 << half) - 1;
    let mut at = index;
    loop {
        let [mut left, mut right] = [at >> half, at & mask];
        for round in 0..7 {
            let word = right | round << 32;
            let mixed = bits(seed, word, variable, Purpose::Round) & mask;
            [left, right] = [right, left ^ mixed];
        }
        at = left << half | right;
        if at < count {
            return at;
        }
    }
}

/// The number of runs of crossed factors; `None` if there are too many.
pub fn runs(factors: &[Factor]) -> Option<u64> {
    let product = factors
        .iter()
        .try_fold(1u64, |product, factor| product.checked_mul(factor.count()));
    product.filter(|runs| *runs <= MOST_RUNS)
}

/// The values of the run with this index, in the order of the names of all factors; the last factor varies fastest.
pub fn values(factors: &[Factor], mut run: u64) -> Vec<f64> {
    let mut indices = vec![0; factors.len()];
    for (index, factor) in indices.iter_mut().zip(factors).rev() {
        let count = factor.count().max(1);
        *index = run % count;
        run /= count;
    }
    let mut values = Vec::new();
    for (factor, index) in factors.iter().zip(indices) {
        factor.values(index, &mut values);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(name: &str, from: f64, to: f64, count: u64, log: bool) -> Factor {
        Factor::Grid {
            name: name.into(),
            from,
            to,
            count,
            log,
        }
    }

    #[test]
    fn the_last_factor_is_the_fastest() {
        let list = Factor::List {
            names: vec!["b".into(), "c".into()],
            rows: vec![vec![7.0, 8.0], vec![5.0, 6.0]],
        };
        let factors = [grid("a", 1.0, 2.0, 3, false), list];
        assert_eq!(runs(&factors), Some(6));
        let all: Vec<_> = (0..6).map(|run| values(&factors, run)).collect();
        assert_eq!(all[0], [1.0, 7.0, 8.0]);
        assert_eq!(all[1], [1.0, 5.0, 6.0]);
        assert_eq!(all[2], [1.5, 7.0, 8.0]);
        assert_eq!(all[5], [2.0, 5.0, 6.0]);
    }

    #[test]
    fn sets_that_do_not_belong_to_the_names_are_found() {
        let list = |rows: &[&[f64]]| Factor::List {
            names: vec!["b".into(), "c".into()],
            rows: rows.iter().map(|row| row.to_vec()).collect(),
        };
        assert_eq!(list(&[&[1.0, 2.0], &[3.0, 4.0]]).fault(), None);
        for wrong in [
            list(&[&[1.0, 2.0], &[3.0]]),
            list(&[&[1.0, 2.0, 3.0]]),
            Factor::Together(vec![grid("a", 0.0, 1.0, 3, false), list(&[&[1.0, 2.0]])]),
            Factor::Together(vec![list(&[&[1.0]])]),
        ] {
            assert!(wrong.fault().is_some(), "{wrong:?}");
        }
    }

    #[test]
    fn ends_of_grids_are_exact() {
        for (from, to, log) in [(0.1, 0.7, false), (1e-3, 1e3, true), (-5.0, -0.2, true)] {
            let factors = [grid("a", from, to, 101, log)];
            assert_eq!(values(&factors, 0), [from]);
            assert_eq!(values(&factors, 100), [to]);
        }
        let decades = [grid("a", 1e-3, 1e3, 7, true)];
        for (run, known) in (0..7).zip([1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0, 1e3]) {
            // exp and log have an error of one unit in the last place each, here for an exponent of 14.
            assert!((values(&decades, run)[0] / known - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn too_many_runs_are_none() {
        let huge = vec![grid("a", 0.0, 1.0, 1 << 20, false); 3];
        assert_eq!(runs(&huge[..2]), Some(MOST_RUNS));
        assert_eq!(runs(&huge), None);
        assert_eq!(runs(&vec![grid("a", 0.0, 1.0, u64::MAX, false); 2]), None);
    }

    #[test]
    fn a_latin_hypercube_has_one_value_in_each_stratum() {
        for count in [1, 2, 3, 10, 64, 1000] {
            let factor = [Factor::Sample {
                design: Sampling::Latin,
                count,
                seed: 5,
                variables: vec![
                    ("a".into(), Distribution::Uniform(0.0, 1.0)),
                    ("b".into(), Distribution::Uniform(0.0, 1.0)),
                ],
            }];
            for variable in 0..2 {
                let mut strata: Vec<u64> = (0..count)
                    .map(|run| (values(&factor, run)[variable] * count as f64) as u64)
                    .collect();
                strata.sort_unstable();
                assert_eq!(strata, (0..count).collect::<Vec<_>>(), "{count}");
            }
        }
    }

    /// Means and variances of the distributions in closed form. N points of an evenly filling sequence integrate a function
    /// of bounded variation to about 1/N.
    #[test]
    fn distributions_have_their_moments() {
        const COUNT: u64 = 1 << 14;
        let ln = |x: f64| x.ln();
        for (distribution, mean, variance) in [
            (Distribution::Uniform(2.0, 5.0), 3.5, 9.0 / 12.0),
            (Distribution::Normal(3.0, 0.5), 3.0, 0.25),
            (
                Distribution::LogUniform(1.0, 8.0),
                7.0 / ln(8.0),
                63.0 / (2.0 * ln(8.0)) - (7.0 / ln(8.0)).powi(2),
            ),
            (
                Distribution::Triangular(1.0, 4.0, 2.0),
                7.0 / 3.0,
                (1.0 + 16.0 + 4.0 - 4.0 - 2.0 - 8.0) / 18.0,
            ),
        ] {
            for seed in [0, 3] {
                let factor = [Factor::Sample {
                    design: Sampling::Sobol,
                    count: COUNT,
                    seed,
                    variables: vec![("a".into(), distribution)],
                }];
                let all: Vec<f64> = (0..COUNT).map(|run| values(&factor, run)[0]).collect();
                let found = all.iter().sum::<f64>() / COUNT as f64;
                let square = |x: &f64| (x - mean) * (x - mean);
                let spread = all.iter().map(square).sum::<f64>() / COUNT as f64;
                let case = format!("{distribution:?} {seed}: {found} {spread}");
                assert!((found - mean).abs() < 20.0 / COUNT as f64, "{case}");
                assert!((spread - variance).abs() < 100.0 / COUNT as f64, "{case}");
            }
        }
    }

    #[test]
    fn seeds_make_other_designs() {
        let value = |design, seed| {
            let factor = [Factor::Sample {
                design,
                count: 8,
                seed,
                variables: vec![("a".into(), Distribution::Uniform(0.0, 1.0))],
            }];
            (0..8)
                .map(|run| values(&factor, run)[0])
                .collect::<Vec<_>>()
        };
        for design in [Sampling::Random, Sampling::Latin, Sampling::Sobol] {
            assert_ne!(value(design, 0), value(design, 1));
            assert_eq!(value(design, 7), value(design, 7));
        }
    }
}
