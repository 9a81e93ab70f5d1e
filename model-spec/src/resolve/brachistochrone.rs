//! The end of the fastest motion: `brachistochrone { x = 8, y = h/2 }`.

use lagrangian_symbolic::Expr;

use super::Resolver;
use super::names::{Content, Namespace};
use super::value::{MemberId, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Coordinate;
use crate::syntax::{SectionKind, Spec};

/// The largest number of coordinates without an end that a message lists.
const LISTED: usize = 6;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The end of every coordinate; nothing if neither the machine nor its bases have the section.
    pub fn destination(
        &mut self,
        layers: &'a [Spec],
        coordinates: &[Coordinate<'d>],
    ) -> Vec<Expr<'d>> {
        let mut ends = vec![None; coordinates.len()];
        let members = self.members_of(SectionKind::Brachistochrone);
        if members.is_empty() {
            return Vec::new();
        }
        // Ends that could not be resolved were reported, and are not reported as missing.
        let mut failed = coordinates.len() != self.members_of(SectionKind::Coordinates).len();
        for member in members {
            if self.is_left_over(member) {
                continue;
            }
            let found = self.repeat_until_resolved(|resolver| resolver.end(member));
            failed |= found.as_ref().is_none_or(Vec::is_empty);
            for (coordinate, end) in found.into_iter().flatten() {
                if let Some(place) = ends.get_mut(coordinate) {
                    *place = Some(end);
                }
            }
        }
        let missing = coordinates
            .iter()
            .zip(&ends)
            .filter(|(_, end)| end.is_none());
        let missing: Vec<String> = missing.map(|(q, _)| format!("`{}`", q.name)).collect();
        let heading = layers
            .iter()
            .rev()
            .find_map(|spec| spec.section(SectionKind::Brachistochrone));
        if let Some(heading) = heading
            && !missing.is_empty()
            && !failed
        {
            let shown = missing[..missing.len().min(LISTED)].join(", ");
            let more = if missing.len() > LISTED { ", …" } else { "" };
            let message = format!("no end value is given for {shown}{more}");
            let incomplete = Diagnostic::new(Code::MissingValue, heading, message);
            let help = "the fastest motion ends at one position: give every coordinate a value";
            self.push(incomplete.help(help));
        }
        ends.into_iter().collect::<Option<_>>().unwrap_or_default()
    }

    /// Whether a variant removed the coordinate whose end its base gives.
    fn is_left_over(&self, member: MemberId) -> bool {
        let declaration = self.declaration(member);
        let base = declaration.name.base.text.as_str();
        let group = self.find_group(Namespace::Values, base);
        let index = self.members[member].index;
        let remains = group.is_some_and(|group| {
            let mut members = self.groups[group].members.iter();
            members.any(|(other, &member)| {
                (index.is_none() || *other == index)
                    && self.declaration(member).section == SectionKind::Coordinates
            })
        });
        let is_inherited = declaration.layer + 1 < self.layer_count;
        let was_declared = self
            .declarations
            .iter()
            .any(|other| other.section == SectionKind::Coordinates && other.name.base.text == base);
        is_inherited && was_declared && !remains
    }

    /// The coordinates of an item, each with its end.
    fn end(&mut self, member: MemberId) -> Option<Vec<(usize, Expr<'d>)>> {
        let Content::Expression(written) = self.declaration(member).content else {
            return None;
        };
        let mut ends = Vec::new();
        for coordinate in self.coordinates_named(member) {
            let scope = self.scope(member, &limits::DESTINATION);
            let unit = self.unit_of(coordinate)?;
            let reason = "it has the unit of its coordinate";
            let end = self.scalar_in(written, unit, reason, scope)?.expr;
            ends.extend(self.ordinal(coordinate).map(|coordinate| (coordinate, end)));
        }
        Some(ends)
    }
}
