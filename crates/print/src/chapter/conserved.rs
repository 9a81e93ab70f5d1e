//! Conserved quantities and absent terms; every statement has been decided for this machine.

use lagrangian_symbolic::{Expr, Math, math_as_built, substitute};

use super::kinematics::particles;
use super::{Chapter, READABLE, capitalized, code, counted, listed, words};
use crate::document::{Block, Row, Words};
use lagrangian_mechanics::equations::groups::{Term, compact};
use lagrangian_mechanics::equations::integrals::{Cyclic, EnergyBalance};
use lagrangian_spec::model::{Space, stage};

/// The most names in a sentence.
const LONGEST_LIST: usize = 12;

impl<'d> Chapter<'_, 'd> {
    pub(super) fn conserved(&self) -> Vec<Block> {
        let mut blocks = self.energy_balance();
        for cyclic in self.properties.cyclic.iter().take(LONGEST_LIST) {
            blocks.extend(self.cyclic(cyclic));
        }
        if self.properties.cyclic.len() > LONGEST_LIST {
            let more = counted(
                self.properties.cyclic.len() - LONGEST_LIST,
                "more coordinate",
            );
            blocks.push(Block::Paragraph(words![format!("Cyclic as well: {more}.")]));
        }
        let absent = self.absent_terms();
        if !absent.is_empty() {
            blocks.push(Block::Paragraph(words![
                "What is absent costs nothing to compute:"
            ]));
            blocks.push(Block::List(absent));
        }
        blocks
    }

    fn energy_balance(&self) -> Vec<Block> {
        let letter = Math::letter;
        let equations = &self.compiled.equations;
        let stores = !equations.state_energy.is_zero();
        let sum = || {
            if stores {
                letter('T') + letter('V') + letter('E')
            } else {
                letter('T') + letter('V')
            }
        };
        match &self.properties.energy {
            EnergyBalance::Conserved => {
                if let Some(touching) = self.extra_forces() {
                    let text = format!(
                        "Energy is changed by {touching} alone: nothing else drives or damps the machine."
                    );
                    return vec![Block::Paragraph(words![text])];
                }
                let text =
                    "Energy is conserved: nothing drives or damps the machine. Along every motion";
                let constant = sum().equals(Math::text("constant"));
                vec![Block::Paragraph(words![text]), Block::formula(&constant)]
            }
            EnergyBalance::Jacobi(integral) => {
                let conserved = match self.extra_forces() {
                    None => "conserved".to_owned(),
                    Some(touching) => format!("changed by {touching} alone"),
                };
                let text = format!(
                    "Energy is not conserved, since the machine is driven; but the energies do not depend explicitly on time, and \
                     Jacobi's integral is {conserved}:"
                );
                let rows = self.equality(Math::letter('E'), *integral, "");
                vec![Block::Paragraph(words![text]), Block::Formula(rows)]
            }
            EnergyBalance::Balance => {
                let rate = Math::fraction(letter('d'), letter('d') * letter('t'));
                let mut rows = Vec::new();
                let mut right = Math::default();
                let mut explain = |letter: char, value: Expr<'d>, note: &str| {
                    rows.extend(self.equality(Math::letter(letter), value, note));
                };
                if stores {
                    explain('E', equations.state_energy, "stored in states");
                }
                if !equations.work_rate.is_zero() {
                    right = Math::letter('P');
                    explain('P', equations.work_rate, "power supplied");
                }
                if !equations.dissipation_rate.is_zero() {
                    let damped = Math::letter('R');
                    right = if right.is_empty() {
                        -damped
                    } else {
                        right - damped
                    };
                    explain('R', equations.dissipation_rate, "power dissipated");
                }
                let balance = (rate * sum().in_parentheses()).equals(right);
                let mut lines = Row::lines(&balance, 0, "");
                lines.extend(rows);
                let text = match self.extra_forces() {
                    None => "Energy is not conserved. Along every motion".to_owned(),
                    Some(touching) => {
                        format!(
                            "Energy is not conserved. Apart from the effect of {touching}, along every motion"
                        )
                    }
                };
                vec![Block::Paragraph(words![text]), Block::Formula(lines)]
            }
        }
    }

    fn cyclic(&self, cyclic: &Cyclic<'d>) -> Vec<Block> {
        let coordinate = &self.model.coordinates[cyclic.coordinate];
        let q = || self.name(coordinate.q);
        let p = || Math::letter('p').with_index(q());
        let (t, v) = (Math::letter('T'), Math::letter('V'));
        let mut words = words![q(), " is cyclic: neither ", t, " nor ", v, " depends on it"];
        let touching = self
            .extra_forces()
            .filter(|_| self.has_extra_force(cyclic.coordinate));
        words.extend(match (cyclic.force.is_zero(), touching) {
            (true, Some(touching)) => {
                words![format!(
                    ", and {touching} alone acts on it. Its momentum is"
                )]
            }
            (false, Some(touching)) => {
                words![format!(
                    ". Apart from the effect of {touching}, its momentum changes as follows:"
                )]
            }
            (true, None) => words![", and nothing else acts on it. Its momentum is conserved:"],
            (false, None) if self.compiled.equations.constraints.is_empty() => {
                words![". Its momentum is changed by applied forces and damping alone:"]
            }
            (false, None) => {
                words![
                    ". Its momentum is changed by applied forces, damping and constraints alone:"
                ]
            }
        });
        let momentum = self.momentum(cyclic);
        let mut rows = Row::lines(&p().equals(momentum), 0, "");
        if !cyclic.force.is_zero() {
            let rate = Math::letter('p').dotted().with_index(q());
            // The generalized force by sources, of which those that cancel are set to 0.
            let forces = self
                .shares
                .iter()
                .map(|part| part.forces[cyclic.coordinate]);
            let reactions = self.compiled.equations.constraints.iter();
            let reactions = reactions.map(|c| c.row[cyclic.coordinate] * c.multiplier);
            let all = self.model.dag.sum(forces.chain(reactions));
            rows.extend(self.equality(rate, all, ""));
        }
        vec![Block::Paragraph(words), Block::Formula(rows)]
    }

    /// Forces besides those in the equations, such as sliding friction. Unilateral contacts are not mentioned here: their own
    /// section states that the rest of the chapter applies while they are open.
    fn extra_forces(&self) -> Option<&'static str> {
        let mut sliding = self.compiled.equations.sliding.iter();
        let rubs = sliding.any(|one| !one.friction.is_zero());
        rubs.then_some("friction in the guides")
    }

    /// Whether they act on a coordinate.
    fn has_extra_force(&self, coordinate: usize) -> bool {
        let mut sliding = self.compiled.equations.sliding.iter();
        sliding.any(|one| !one.friction.is_zero() && !one.row[coordinate].is_zero())
    }

    /// `Σ Mᵢⱼ vⱼ`, with the contribution of drives.
    fn momentum(&self, cyclic: &Cyclic<'d>) -> Math {
        let model = self.model;
        let dag = model.dag;
        let at_rest: Vec<_> = model
            .coordinates
            .iter()
            .filter_map(|c| Some((c.v.as_symbol()?, dag.zero())))
            .collect();
        let driven = substitute(dag, &[cyclic.momentum], &at_rest)[0];
        let row = model
            .coordinates
            .iter()
            .enumerate()
            .map(|(j, coordinate)| Term {
                coefficient: *self
                    .compiled
                    .equations
                    .mass_matrix
                    .get(cyclic.coordinate, j),
                factor: coordinate.v,
            });
        let driven = Term {
            coefficient: driven,
            factor: dag.one(),
        };
        let terms: Vec<Term<'d>> = row
            .chain([driven])
            .map(|term| Term {
                coefficient: compact(term.coefficient),
                ..term
            })
            .filter(|term| !term.coefficient.is_zero())
            .collect();
        let size = terms.iter().fold(0, |size: u64, term| {
            size.saturating_add(term.value().size())
        });
        if size > READABLE {
            return Math::text(format!("{size} symbols, not shown"));
        }
        let mut sum = Math::default();
        for (position, term) in terms.iter().enumerate() {
            let term = self.term(term);
            sum = if position == 0 { term } else { sum + term };
        }
        if sum.is_empty() { Math::number(0) } else { sum }
    }

    /// What the machine lacks, and what is at rest.
    fn absent_terms(&self) -> Vec<Words> {
        let model = self.model;
        let equations = &self.compiled.equations;
        let mut items = self.simple_entries();
        if self.properties.blocks.len() > 1 {
            items.push(self.blocks());
        }
        if equations.bias.iter().all(|h| h.is_zero()) {
            items.push(words![
                "No velocity terms: the inertia forces are linear in the accelerations."
            ]);
        } else {
            let free: Vec<usize> = (0..equations.bias.len())
                .filter(|&i| model.coordinates[i].rate.is_none())
                .filter(|&i| equations.bias[i].is_zero())
                .collect();
            if !free.is_empty() {
                let mut words = words!["No velocity terms in the inertia forces of "];
                words.extend(self.coordinates(&free));
                words.extend(words!["."]);
                items.push(words);
            }
        }
        if self.properties.autonomous {
            items.push(words![
                "No explicit time: neither energies nor forces depend on it."
            ]);
        }
        if equations.potential_energy.is_zero() {
            items.push(words!["No potential energy."]);
        }
        if equations.dissipation.is_zero() {
            items.push(words!["No dissipation."]);
        }
        if model.loads().next().is_none() {
            items.push(words!["No applied forces or torques."]);
        }
        items.extend(self.particles());
        items
    }

    /// What is simple in the mass matrix: entries that are constant or zero.
    fn simple_entries(&self) -> Vec<Words> {
        let equations = &self.compiled.equations;
        let matrix = equations.mass_matrix.lower();
        let mut items = Vec::new();
        let zeros = matrix.iter().filter(|entry| entry.is_zero()).count();
        let constants = matrix
            .iter()
            .filter(|entry| entry.stage() <= stage::PARAMETER)
            .count()
            - zeros;
        if self.properties.constant_mass_matrix {
            items.push(words![
                "The mass matrix is constant: it is known when the parameters are."
            ]);
        } else if constants > 0 {
            let verb = if constants == 1 { "depends" } else { "depend" };
            let entries = capitalized(&counted(constants, "entry"));
            items.push(words![format!(
                "{entries} of the mass matrix, on and below the diagonal, {verb} on parameters only."
            )]);
        }
        if zeros > 0 {
            let verb = if zeros == 1 { "is" } else { "are" };
            let entries = capitalized(&counted(zeros, "entry"));
            items.push(words![format!(
                "{entries} of the mass matrix, out of {} on and below the diagonal, {verb} zero.",
                matrix.len()
            )]);
        }
        items
    }

    /// Which bodies have no rotational inertia, if any.
    fn particles(&self) -> Option<Words> {
        let particles = particles(&self.model.bodies);
        if particles.is_empty() {
            return None;
        }
        let names = particles
            .iter()
            .take(LONGEST_LIST)
            .map(|body| words![code(&body.name)]);
        let mut words = words!["No rotational inertia: "];
        words.extend(listed(names));
        let more = particles.len().saturating_sub(LONGEST_LIST);
        words.extend(words![match (more, particles.len(), self.model.space) {
            (0, 1, _) => " is a particle.".to_owned(),
            (0, _, Space::Plane | Space::Space) => " are particles.".to_owned(),
            (more, ..) => format!(" and {more} more are particles."),
        }]);
        Some(words)
    }

    /// Which accelerations are coupled.
    fn blocks(&self) -> Words {
        let (alone, together): (Vec<&Vec<usize>>, Vec<_>) = self
            .properties
            .blocks
            .iter()
            .partition(|block| block.len() == 1);
        let mut sentences: Vec<Words> = Vec::new();
        for block in together {
            let mut words = words!["the accelerations of "];
            words.extend(self.coordinates(block));
            words.extend(words![" are coupled"]);
            sentences.push(words);
        }
        if !alone.is_empty() {
            let alone: Vec<usize> = alone.into_iter().flatten().copied().collect();
            let (begin, verb) = if alone.len() == 1 {
                ("the acceleration of ", " is decoupled from all others")
            } else {
                (
                    "the accelerations of ",
                    " are each decoupled from all others",
                )
            };
            let mut words = words![begin];
            words.extend(self.coordinates(&alone));
            words.extend(words![verb]);
            sentences.push(words);
        }
        let mut words = words!["Inertial coupling: "];
        words.extend(listed(sentences));
        words.extend(words!["."]);
        words
    }

    /// The names of these coordinates.
    fn coordinates(&self, indices: &[usize]) -> Words {
        let name = |&i: &usize| words![math_as_built(self.model.coordinates[i].q, self.model.dag)];
        let mut words = listed(indices.iter().take(LONGEST_LIST).map(name));
        if indices.len() > LONGEST_LIST {
            words.extend(words![format!(
                " and {} more",
                indices.len() - LONGEST_LIST
            )]);
        }
        words
    }
}
