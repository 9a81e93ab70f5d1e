//! Chooses among several programs for one function.
//!
//! No form of the equations is best for every machine: multiplied out they are cheapest for a
//! double pendulum, but never for a long chain; elimination along the machine is best with free
//! bodies or long chains, the mass matrix for small, tightly coupled machines. So each function is
//! made in every form that may be the best, and among those that are accurate enough the one with the
//! lowest [cost](Cost) is chosen. All candidates are recorded with their costs and roundings.
//!
//! Accurate enough means a loss of at most one bit: a candidate whose [rounding](Rounding) is at
//! most [`MOST_ROUNDING`] times that of the most accurate one.

use std::cmp::Ordering;
use std::fmt;

use super::{Cost, Counts, Program, Role, Rounding};
use lagrangian_symbolic::sorting::sort_by;

/// The largest acceptable ratio of the rounding of a candidate to that of the most accurate one.
///
/// Rounding is the whole error of a run once its tolerance is small: no tolerance removes it, whereas time can be bought. But a difference below this factor,
/// one bit, is not worth any time, and could not be measured reliably: a [`Rounding`] is the median of a few states, and the ratio of two is accurate to a
/// factor of one and a half. So the error of the chosen candidate is at most three times that of the most accurate one, as tests check for every machine of the
/// library, and every candidate rejected for its rounding is truly less accurate.
pub const MOST_ROUNDING: u64 = 2;

/// The equations that a function is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The equations as they were derived.
    Derived,
    /// The equations, multiplied out.
    Expanded,
    /// Inertia and loads on velocities, eliminated from the tips of the machine to the ground.
    Along,
    /// Like [`Basis::Along`], with as few operations as possible between one division and the next.
    Ahead,
}

/// A form in which a function is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// Its role.
    pub role: Role,
    /// The equations it is made from.
    pub basis: Basis,
    /// Whether coordinates that constraints determine are substituted before anything is derived.
    pub reduced: bool,
    /// Whether factors are taken out of sums before common pairs are shared.
    pub factored: bool,
}

/// A program that was made for a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// Its form.
    pub form: Form,
    /// Its operation counts.
    pub counts: Counts,
    /// Its cost.
    pub cost: Cost,
    /// Its rounding, if known; it is known for all candidates or for none.
    pub rounding: Option<Rounding>,
}

impl Candidate {
    /// Orders two candidates by cost; at equal cost, by the number of operations without contraction.
    pub fn compare(&self, other: &Candidate) -> Ordering {
        let ops = |candidate: &Candidate| candidate.counts.ops();
        let by_cost = self.cost.compare(other.cost);
        by_cost.then(ops(self).cmp(&ops(other)))
    }
}

/// The programs that were made for one function, and the one that was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// All candidates, two or more, no two of them equal.
    pub candidates: Vec<Candidate>,
    /// The index of the chosen one.
    pub chosen: usize,
}

impl Choice {
    /// The role of the function.
    pub fn role(&self) -> Role {
        self.chosen().form.role
    }

    /// The chosen candidate.
    pub fn chosen(&self) -> &Candidate {
        &self.candidates[self.chosen]
    }

    /// The others, best first.
    pub fn others(&self) -> Vec<&Candidate> {
        ranked(&self.candidates)
            .into_iter()
            .filter(|index| *index != self.chosen)
            .map(|index| &self.candidates[index])
            .collect()
    }
}

impl Program {
    /// The choice that was made for a function; `None` if there was only one form.
    pub fn choice(&self, role: Role) -> Option<&Choice> {
        self.choices.iter().find(|choice| choice.role() == role)
    }
}

/// The index of the best candidate: the cheapest of those that are accurate enough; the first in
/// case of a tie. If the rounding is unknown, all count as accurate enough.
pub fn best(candidates: &[Candidate]) -> usize {
    ranked(candidates).first().copied().unwrap_or(0)
}

/// The indices from best to worst: those that are accurate enough, then the others, each by increasing cost.
fn ranked(candidates: &[Candidate]) -> Vec<usize> {
    let least = candidates.iter().filter_map(|c| c.rounding).min();
    let is_rough = |candidate: &Candidate| match (candidate.rounding, least) {
        (Some(rounding), Some(least)) => !rounding.is_within(MOST_ROUNDING, least),
        // It has no value at these states, for instance because it divides by a length that is zero.
        (None, Some(_)) => true,
        (_, None) => false,
    };
    let mut ranked: Vec<usize> = (0..candidates.len()).collect();
    sort_by(&mut ranked, |&a, &b| {
        let (a, b) = (&candidates[a], &candidates[b]);
        is_rough(a).cmp(&is_rough(b)).then(a.compare(b))
    });
    ranked
}

/// `eliminated along the machine, factored`.
impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (self.role, self.basis) {
            (_, Basis::Along) => "eliminated along the machine",
            (_, Basis::Ahead) => "eliminated along the machine, pivots ahead",
            (Role::Accelerations | Role::AccelerationsAt | Role::Friction, Basis::Derived) => {
                "from the mass matrix"
            }
            (Role::Accelerations | Role::AccelerationsAt | Role::Friction, Basis::Expanded) => {
                "from the mass matrix multiplied out"
            }
            (_, Basis::Derived) => "as derived",
            (_, Basis::Expanded) => "multiplied out",
        })?;
        if self.reduced {
            f.write_str(", without the coordinates that constraints settle")?;
        }
        if self.factored {
            f.write_str(", factored")?;
        }
        Ok(())
    }
}

/// `eliminated along the machine: 84 mul, 55 add, 2 div, 4 sincos; 138 cycles alone, 63 among
/// others; rounding 1.8`.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.form, self.counts, self.cost)?;
        match self.rounding {
            Some(rounding) => write!(f, "; rounding {rounding}"),
            None => Ok(()),
        }
    }
}

/// The chosen candidate and the next best one, in one line for the head of a module.
impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.chosen())?;
        match self.others().first() {
            Some(next) => write!(f, " (next best, {next})"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Candidates with these costs, in cycles, and roundings.
    fn candidates(of: &[(u64, Option<f64>)]) -> Vec<Candidate> {
        let candidate = |&(cycles, rounding): &(u64, Option<f64>)| Candidate {
            form: Form {
                role: Role::Accelerations,
                basis: Basis::Derived,
                reduced: false,
                factored: false,
            },
            counts: Counts::default(),
            cost: Cost {
                throughput: 10 * cycles,
                path: 10 * cycles,
            },
            rounding: rounding.map(Rounding::of_units),
        };
        of.iter().map(candidate).collect()
    }

    #[test]
    fn the_cheapest_of_those_that_lose_at_most_a_bit_is_taken() {
        let all = [
            (90, Some(3.0)),
            (50, Some(6.0)),
            (40, Some(6.1)),
            (60, Some(3.5)),
        ];
        assert_eq!(ranked(&candidates(&all)), [1, 3, 0, 2]);
        assert_eq!(best(&candidates(&all)), 1);
    }

    #[test]
    fn without_knowledge_of_rounding_the_cheapest_is_taken() {
        let all = candidates(&[(90, None), (50, None), (50, None), (60, None)]);
        assert_eq!(ranked(&all), [1, 2, 3, 0]);
    }
}
