//! The start values that are kept when a start that violates the constraints is corrected.

use super::Resolver;
use super::names::Namespace;
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Variable;
use crate::syntax::{Ident, SectionKind, coordinate_of_rate};

impl Resolver<'_, '_, '_> {
    /// The coordinates or rates that an item of `keep` refers to: one, or those of a family.
    ///
    /// If a variant removes a coordinate, the `keep` of its base for that coordinate is dropped too.
    pub fn kept(&mut self, member: MemberId) -> Vec<Variable> {
        let declaration = self.declaration(member);
        let (name, is_inherited) = (declaration.name, declaration.layer + 1 < self.layer_count);
        let rate_of = coordinate_of_rate(&name.base.text);
        let base = rate_of.unwrap_or(&name.base.text);
        let Some(group) = self.find_group(Namespace::Values, base) else {
            if !is_inherited {
                self.unknown_coordinate(&Ident {
                    text: base.to_owned(),
                    span: name.base.span,
                });
            }
            return Vec::new();
        };
        let index = self.members[member].index;
        let members = self.members_under(group, index);
        let is_coordinate =
            |&member: &MemberId| self.declaration(member).section == SectionKind::Coordinates;
        if is_inherited && !members.iter().any(is_coordinate) {
            return Vec::new();
        }
        self.check_members(&members, group, (base, index), name.span);
        let mut kept = Vec::new();
        for member in members {
            let section = self.declaration(member).section;
            if section != SectionKind::Coordinates {
                let found = section.item();
                let message = format!("a coordinate is expected here, and `{base}` is {found}");
                let wrong = Diagnostic::new(Code::WrongKind, name.base.span, message);
                self.push(
                    wrong.help("the start has a value for each coordinate, and for its rate"),
                );
                continue;
            }
            kept.extend(self.ordinal(member).map(match rate_of {
                Some(_) => Variable::Rate,
                None => Variable::Coordinate,
            }));
        }
        kept
    }
}
