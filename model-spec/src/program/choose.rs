//! Which of several programs for one function is taken.
//!
//! There is no form of the equations that is the cheapest for every machine: multiplied out they
//! are for a double pendulum, never for a long chain; eliminating along the machine is for whatever
//! has free bodies or long chains, the mass matrix for what is small and tightly coupled. So each
//! function is made in the ways that may be the best, and the one of the least [cost](Cost) is
//! taken. What was made and what it would have cost stays on record.

use std::cmp::Ordering;
use std::fmt;

use super::{Cost, Counts, Program, Role};

/// What a function is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The equations as they were derived.
    Derived,
    /// The equations, multiplied out.
    Expanded,
    /// Inertia and loads where they are, eliminated from the tips of the machine to the ground.
    Along,
}

/// A way to make a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// What it computes.
    pub role: Role,
    /// What it is made from.
    pub basis: Basis,
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
}

impl Candidate {
    /// Which of two is the better one.
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

    /// The others, the cheapest first.
    pub fn others(&self) -> Vec<&Candidate> {
        let others = self.candidates.iter().enumerate();
        let mut others: Vec<&Candidate> = others
            .filter(|(index, _)| *index != self.chosen)
            .map(|(_, candidate)| candidate)
            .collect();
        others.sort_by(|a, b| a.compare(b));
        others
    }
}

impl Program {
    /// What was chosen from for a function; `None` if there was only one way to make it.
    pub fn choice(&self, role: Role) -> Option<&Choice> {
        self.choices.iter().find(|choice| choice.role() == role)
    }
}

/// The index of the cheapest; of several, that of the fewest operations where none is contracted;
/// of several, the first.
pub fn cheapest(candidates: &[Candidate]) -> usize {
    let indices = 0..candidates.len();
    let least = indices.min_by(|&a, &b| candidates[a].compare(&candidates[b]));
    least.unwrap_or(0)
}

/// `eliminated along the machine, factored`.
impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match (self.role, self.basis) {
            (_, Basis::Along) => "eliminated along the machine",
            (Role::Accelerations | Role::AccelerationsAt, Basis::Derived) => "from the mass matrix",
            (Role::Accelerations | Role::AccelerationsAt, Basis::Expanded) => {
                "from the mass matrix multiplied out"
            }
            (_, Basis::Derived) => "as derived",
            (_, Basis::Expanded) => "multiplied out",
        })?;
        if self.factored {
            f.write_str(", factored")?;
        }
        Ok(())
    }
}

/// `eliminated along the machine: 84 mul, 55 add, 2 div, 4 sincos; 138 cycles alone, 63 among
/// others`.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.form, self.counts, self.cost)
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
