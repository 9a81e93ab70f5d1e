//! The variables by which accelerations are to be differentiated.

use super::Resolver;
use super::names::{Namespace, suggestion, with_help};
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Variable;
use crate::syntax::{Index, SectionKind};

/// The words for all variables of a kind, with the sections that declare these.
const WORDS: [(&str, SectionKind); 4] = [
    ("coordinates", SectionKind::Coordinates),
    ("rates", SectionKind::Coordinates),
    ("inputs", SectionKind::Inputs),
    ("parameters", SectionKind::Parameters),
];

impl Resolver<'_, '_, '_> {
    /// The variables that an item of `derivatives` refers to: all of a kind, one parameter, or
    /// those of a family.
    pub fn differentiated_by(&mut self, member: MemberId) -> Vec<Variable> {
        let name = self.declaration(member).name;
        let word = name.base.text.as_str();
        if let Some((_, section)) = WORDS.iter().find(|(known, _)| *known == word) {
            if name.index != Index::None {
                let message = format!("`{word}` stands for all of them and has no index");
                self.error(Code::NotAFamily, name.span, message);
                return Vec::new();
            }
            let variable = match word {
                "coordinates" => Variable::Coordinate,
                "rates" => Variable::Rate,
                "inputs" => Variable::Input,
                _ => Variable::Parameter,
            };
            let members = self.members_of(*section).into_iter();
            let mut count = members.filter(|&member| !self.is_derived(member)).count();
            if *section == SectionKind::Coordinates {
                // A state is the rate of a coordinate.
                count += self.members_of(SectionKind::States).len();
            }
            return (0..count).map(variable).collect();
        }
        self.parameters_named(member)
    }

    fn parameters_named(&mut self, member: MemberId) -> Vec<Variable> {
        let name = self.declaration(member).name;
        let base = &name.base;
        let Some(group) = self.find_group(Namespace::Values, &base.text) else {
            self.unknown_variable(member);
            return Vec::new();
        };
        let index = self.members[member].index;
        let members = self.members_under(group, index);
        self.check_members(&members, group, (&base.text, index), name.span);
        let mut variables = Vec::new();
        for member in members {
            let section = self.declaration(member).section;
            if self.is_derived(member) {
                self.refuse_derivative_by_derived(member, name.span);
                continue;
            }
            if section == SectionKind::Parameters {
                variables.extend(self.ordinal(member).map(Variable::Parameter));
                continue;
            }
            let message = format!(
                "a parameter is expected here, and `{}` is {}",
                base.text,
                section.item()
            );
            let help = match section {
                SectionKind::Coordinates => {
                    "`coordinates` and `rates` stand for all coordinates and their rates"
                }
                SectionKind::Inputs => "`inputs` stands for all inputs",
                _ => {
                    "accelerations can be differentiated with respect to what is declared under `parameters`"
                }
            };
            self.push(Diagnostic::new(Code::WrongKind, name.span, message).help(help));
        }
        variables
    }

    fn unknown_variable(&mut self, member: MemberId) {
        let base = &self.declaration(member).name.base;
        if self.incomplete || base.text.is_empty() {
            return;
        }
        let parameters = self
            .declarations
            .iter()
            .filter(|declaration| declaration.section == SectionKind::Parameters)
            .map(|declaration| declaration.name.base.text.as_str());
        let words = WORDS.iter().map(|(word, _)| *word);
        let help = suggestion(&base.text, words.chain(parameters));
        let message = format!("no parameter is named `{}`", base.text);
        let unknown = Diagnostic::new(Code::UnknownName, base.span, message);
        self.push(with_help(unknown, help));
    }
}
