//! Which of several programs for one function is taken.
//!
//! There is no form of the equations that is the best for every machine: multiplied out they are
//! the cheapest for a double pendulum, never for a long chain; eliminating along the machine is for
//! whatever has free bodies or long chains, the mass matrix for what is small and tightly coupled.
//! So each function is made in the ways that may be the best, and of those that are exact enough
//! the one of the least [cost](Cost) is taken. What was made, what it would have cost and what
//! rounding would have done stays on record.
//!
//! Exact enough is what loses no more than one bit: a candidate whose [rounding](Rounding) is at
//! most [`MOST_ROUNDING`] times that of the most exact one.

use std::cmp::Ordering;
use std::fmt;

use super::{Cost, Counts, Program, Role, Rounding};

/// How many times the rounding of the most exact candidate that of another may be.
///
/// Rounding is the whole error of a run once its tolerance is small: no tolerance takes it back, whereas time can be bought. But what is below this factor, a bit, is not worth
/// any time, and could not be told for certain: a [`Rounding`] is the median of a few states, and
/// the ratio of two is right to a factor of one and a half. So whatever is taken is truly at most
/// three times as far off as the most exact candidate, which tests hold for every machine of the
/// library, and whatever is left aside for its rounding truly is farther off.
pub const MOST_ROUNDING: u64 = 2;

/// What a function is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The equations as they were derived.
    Derived,
    /// The equations, multiplied out.
    Expanded,
    /// Inertia and loads where they are, eliminated from the tips of the machine to the ground.
    Along,
    /// As [`Basis::Along`], with as little as there can be between one division and the next.
    Ahead,
}

/// A way to make a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// What it computes.
    pub role: Role,
    /// What it is made from.
    pub basis: Basis,
    /// Whether coordinates that constraints settle are put in before anything is derived.
    pub reduced: bool,
    /// Whether factors are taken out of sums before common pairs are shared.
    pub factored: bool,
}

/// A program that was made for a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// How it was made.
    pub form: Form,
    /// Its operations.
    pub counts: Counts,
    /// How long it takes.
    pub cost: Cost,
    /// What rounding does to its results, where that is known: it is for all candidates or none.
    pub rounding: Option<Rounding>,
}

impl Candidate {
    /// Which of two is the cheaper one; of two that cost the same, the one of fewer operations where
    /// none is contracted.
    pub fn compare(&self, other: &Candidate) -> Ordering {
        let ops = |candidate: &Candidate| candidate.counts.ops();
        let by_cost = self.cost.compare(other.cost);
        by_cost.then(ops(self).cmp(&ops(other)))
    }
}

/// The programs that were made for one function, and which of them was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// All of them, two or more, no two of them the same.
    pub candidates: Vec<Candidate>,
    /// The index of the one that was taken.
    pub chosen: usize,
}

impl Choice {
    /// What the function computes.
    pub fn role(&self) -> Role {
        self.chosen().form.role
    }

    /// The program that was taken.
    pub fn chosen(&self) -> &Candidate {
        &self.candidates[self.chosen]
    }

    /// The others, the best first.
    pub fn others(&self) -> Vec<&Candidate> {
        ranked(&self.candidates)
            .into_iter()
            .filter(|index| *index != self.chosen)
            .map(|index| &self.candidates[index])
            .collect()
    }
}

impl Program {
    /// What was chosen from for a function; `None` if there was only one way to make it.
    pub fn choice(&self, role: Role) -> Option<&Choice> {
        self.choices.iter().find(|choice| choice.role() == role)
    }
}

/// The index of the best: the cheapest of those that are exact enough; of several, the first. Where
/// nothing is known of rounding, all of them are.
pub fn best(candidates: &[Candidate]) -> usize {
    ranked(candidates).first().copied().unwrap_or(0)
}

/// The indices from the best to the worst: those that are exact enough, then the others, each from
/// the cheapest to the dearest.
fn ranked(candidates: &[Candidate]) -> Vec<usize> {
    let least = candidates.iter().filter_map(|c| c.rounding).min();
    let is_rough = |candidate: &Candidate| match (candidate.rounding, least) {
        (Some(rounding), Some(least)) => !rounding.is_within(MOST_ROUNDING, least),
        // At these states it has no value, as where it divides by a length that is zero.
        (None, Some(_)) => true,
        (_, None) => false,
    };
    let mut ranked: Vec<usize> = (0..candidates.len()).collect();
    ranked.sort_by(|&a, &b| {
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

/// What was taken, and what the next best would have been: one line for the head of a module.
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

    /// Candidates of these costs, in cycles, and roundings.
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
