//! Which runs there are: a function of a run's number and of the plan alone.

use serde::{Deserialize, Serialize};

use crate::normal::quantile;
use crate::philox::{Purpose, between, bits};
use crate::sobol::Sobol;

/// More runs than this are a slip of the hand.
pub const MOST_RUNS: u64 = 1 << 40;

/// One of the things that are crossed with each other: so many sets of values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Factor {
    /// Values from one end to the other, both included.
    Grid {
        /// What is varied.
        name: String,
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// How many there are.
        count: u64,
        /// Whether their quotients are equal, and not their differences.
        log: bool,
    },
    /// Values as they are listed.
    List {
        /// What is varied.
        names: Vec<String>,
        /// For each of the sets a value for each name.
        rows: Vec<Vec<f64>>,
    },
    /// Values drawn from distributions.
    Sample {
        /// By which design.
        design: Sampling,
        /// How many sets.
        count: u64,
        /// Which of the many designs of this kind.
        seed: u64,
        /// What is varied, and how its values are distributed.
        variables: Vec<(String, Distribution)>,
    },
    /// Several of equal length, side by side.
    Together(
        /// These.
        Vec<Factor>,
    ),
}

/// How sets of values are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// Each by itself.
    Random,
    /// Each variable has one value in each of as many equally probable strata as there are sets.
    Latin,
    /// The sequence of I. M. Sobol, which fills the cube evenly.
    Sobol,
}

/// How the values of a variable are distributed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Evenly between two ends.
    Uniform(f64, f64),
    /// With a logarithm that is evenly distributed, between two ends of the same sign.
    LogUniform(f64, f64),
    /// Normally: mean and standard deviation.
    Normal(f64, f64),
    /// Between two ends, with a density that rises to the third number and falls from there.
    Triangular(f64, f64, f64),
}

impl Distribution {
    /// The value below which a share `u` of all lies.
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

    /// Whether it has values beyond every bound.
    fn is_unbounded(self) -> bool {
        matches!(self, Distribution::Normal(..))
    }
}

impl Factor {
    /// What it varies.
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

    /// How many sets of values there are.
    pub fn count(&self) -> u64 {
        match self {
            Factor::Grid { count, .. } | Factor::Sample { count, .. } => *count,
            Factor::List { rows, .. } => rows.len() as u64,
            Factor::Together(parts) => parts.first().map_or(1, Factor::count),
        }
    }

    /// Adds set number `index`.
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

/// Where between 0 and 1 a variable of a set is.
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
            let place = between(bits(seed, index, variable, Purpose::Place));
            // Below 1 even where the sum is rounded up to the count.
            ((stratum as f64 + place) / count as f64).min(1.0 - f64::EPSILON / 2.0)
        }
        Sampling::Sobol => {
            let digits = Sobol::digits(index, variable);
            let unit = 1.0 / (1u64 << Sobol::BITS) as f64;
            if seed == 0 {
                let u = digits as f64 * unit;
                // The sequence begins at 0, which is no value of a distribution without end: then each point is in the
                // middle of its cell and not at its corner.
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

/// Where a number below `count` goes in a permutation of them: a Feistel network over a power of 4, walked along its
/// cycle until it is below `count` again.
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

/// How many runs factors make, crossed; none where there are too many.
pub fn runs(factors: &[Factor]) -> Option<u64> {
    let product = factors
        .iter()
        .try_fold(1u64, |product, factor| product.checked_mul(factor.count()));
    product.filter(|runs| *runs <= MOST_RUNS)
}

/// The values of run number `run`, in the order of the names of all factors; the last factor is the fastest.
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
    fn ends_of_grids_are_exact() {
        for (from, to, log) in [(0.1, 0.7, false), (1e-3, 1e3, true), (-5.0, -0.2, true)] {
            let factors = [grid("a", from, to, 101, log)];
            assert_eq!(values(&factors, 0), [from]);
            assert_eq!(values(&factors, 100), [to]);
        }
        let decades = [grid("a", 1e-3, 1e3, 7, true)];
        for (run, known) in (0..7).zip([1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0, 1e3]) {
            // exp and log within a unit in the last place each, of an exponent of 14.
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

    /// Means and variances of the distributions in closed form, by a sequence that fills evenly: N points of it integrate a
    /// function of bounded variation to about 1/N.
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
