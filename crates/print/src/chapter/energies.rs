//! Energies, dissipation and applied forces, by their sources.

use lagrangian_symbolic::print::Sign;
use lagrangian_symbolic::{Expr, Math};

use super::{Chapter, Shown, code, label, listed, paragraph, shown, words};
use crate::document::{Block, Row, Words};
use lagrangian_mechanics::equations::groups::{Share, TermKind};
use lagrangian_spec::model::element::Element;
use lagrangian_spec::model::{Name, Space};

/// A sum of energies longer than this is not written out, since its terms precede it.
const LONGEST_SUM: u64 = 400;

impl<'d> Chapter<'_, 'd> {
    pub(super) fn energies(&self) -> Vec<Block> {
        let mut blocks = self.kinetic_energy();
        let is_potential = |kind: TermKind| {
            matches!(
                kind,
                TermKind::Gravity | TermKind::Springs | TermKind::Potentials
            )
        };
        let is_dissipation = |kind: TermKind| kind == TermKind::Dissipation;
        let equations = &self.compiled.equations;
        blocks.extend(self.energy(
            'V',
            "Potential energy",
            is_potential,
            equations.potential_energy,
        ));
        blocks.extend(self.energy(
            'D',
            "Rayleigh's dissipation function",
            is_dissipation,
            equations.dissipation,
        ));
        blocks.extend(self.forces());
        blocks
    }

    fn kinetic_energy(&self) -> Vec<Block> {
        let bodies = &self.model.bodies;
        if bodies.is_empty() {
            return Vec::new();
        }
        let letter = Math::letter;
        let k = || letter('k');
        let half = || Math::fraction(Math::number(1), Math::number(2));
        let r = || Math::bold('r').dotted().with_index(k());
        let linear = half() * letter('m').with_index(k()) * r().then(Sign::Dot, r());
        let angular = match self.model.space {
            Space::Plane => {
                half() * letter('J').with_index(k()) * letter('ω').with_index(k()).squared()
            }
            Space::Space => {
                let omega = || Math::bold('ω').with_index(k());
                half() * omega().then(Sign::Dot, Math::bold('J').with_index(k()) * omega())
            }
        };
        let sum = Math::form(
            lagrangian_symbolic::print::Form::Under,
            [Math::sign(Sign::Sum), k()],
        );
        let general = letter('T').equals(sum * (linear + angular).in_parentheses());
        let mut blocks = vec![
            Block::Paragraph(words!["Kinetic energy, summed over all bodies:"]),
            Block::formula(&general),
        ];
        let of_body = |name: &Name| letter('T').with_index(label(name));
        let mut rows = Vec::new();
        let mut sum = Math::default();
        for (position, shown) in shown(bodies.iter().map(|body| &body.name))
            .into_iter()
            .enumerate()
        {
            let term = match shown {
                Shown::Item(index) => {
                    let energy = self.compiled.equations.bodies[index].kinetic_energy;
                    rows.extend(self.equality(of_body(&bodies[index].name), energy, ""));
                    of_body(&bodies[index].name)
                }
                Shown::Omitted(..) => Math::sign(Sign::Dots),
            };
            sum = if position == 0 { term } else { sum + term };
        }
        let total = self.compiled.equations.kinetic_energy;
        if bodies.len() > 1 {
            if total.size() <= LONGEST_SUM {
                sum = sum.equals(self.math(total));
            }
            rows.extend(Row::lines(&letter('T').equals(sum), 0, ""));
        }
        blocks.push(Block::Formula(rows));
        blocks
    }

    /// An energy by sources, then its sum.
    fn energy(
        &self,
        letter: char,
        title: &str,
        is_part: impl Fn(TermKind) -> bool,
        total: Expr<'d>,
    ) -> Vec<Block> {
        let parts = self.shares.iter().filter(|part| is_part(part.kind));
        let parts: Vec<(&Element<'d>, Expr<'d>)> = parts
            .filter_map(|part| Some((self.element(part), part.energy?)))
            .collect();
        if parts.is_empty() {
            return Vec::new();
        }
        let mut rows = Vec::new();
        for shown in shown(parts.iter().map(|(element, _)| &element.name)) {
            match shown {
                Shown::Item(index) => {
                    let (element, energy) = parts[index];
                    let left = Math::letter(letter).with_index(label(&element.name));
                    rows.extend(self.equality(left, energy, element.section.noun));
                }
                Shown::Omitted(from, count) => {
                    let text = format!("and {count} more of {}", parts[from].0.name.base);
                    rows.extend(Row::lines(&Math::text(text), 0, ""));
                }
            }
        }
        if parts.len() > 1 && total.size() <= LONGEST_SUM {
            let total = Math::letter(letter).equals(self.math(total));
            rows.extend(Row::lines(&total, 0, "total"));
        }
        vec![
            Block::Paragraph(words![format!("{title}, by source:")]),
            Block::Formula(rows),
        ]
    }

    /// Applied forces and torques, with their generalized forces.
    fn forces(&self) -> Vec<Block> {
        let parts = self.shares.iter().filter(|part| part.energy.is_none());
        let parts: Vec<(&Element<'d>, &Share<'d>)> =
            parts.map(|part| (self.element(part), part)).collect();
        if parts.is_empty() {
            return Vec::new();
        }
        let mut rows = Vec::new();
        let mut idle: Vec<Words> = Vec::new();
        for shown in shown(parts.iter().map(|(element, _)| &element.name)) {
            match shown {
                Shown::Item(index) => {
                    let (element, part) = parts[index];
                    let name = &element.name;
                    let acting = part.forces.iter().zip(&self.model.coordinates);
                    let acting: Vec<_> = acting.filter(|(force, _)| !force.is_zero()).collect();
                    if acting.is_empty() {
                        idle.push(words![code(name)]);
                    }
                    let note = format!("{} {name}", element.section.noun);
                    for (position, (force, coordinate)) in acting.into_iter().enumerate() {
                        let left = Math::letter('Q').with_index(self.name(coordinate.q));
                        let note = if position == 0 { note.as_str() } else { "" };
                        rows.extend(self.equality(left, *force, note));
                    }
                }
                Shown::Omitted(from, count) => {
                    let text = format!("and {count} more of {}", parts[from].0.name.base);
                    rows.extend(Row::lines(&Math::text(text), 0, ""));
                }
            }
        }
        let text = "Contributions of applied forces and torques to the generalized forces, from their virtual work; those not \
                    listed are zero:";
        let mut blocks = vec![Block::Paragraph(words![text]), Block::Formula(rows)];
        if !idle.is_empty() {
            blocks.push(paragraph([
                words!["No work is done by "],
                listed(idle),
                words!["."],
            ]));
        }
        blocks
    }

    /// The element that contributes a share.
    fn element(&self, share: &Share<'d>) -> &Element<'d> {
        &self.model.elements[share.element]
    }
}
