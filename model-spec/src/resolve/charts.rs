//! Pairs of charts: `charts { mortar: polar(s1, phi1) | cartesian(x1, y1) }`.

use super::Resolver;
use super::names::{Content, Namespace};
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Name;
use crate::model::charts::Charts;
use crate::syntax::{self, Ident, Index, SectionKind};
use crate::unit::Unit;

impl<'a> Resolver<'a, '_, '_> {
    /// The charts of an item.
    ///
    /// If a variant removes one of the coordinates, the charts of its base are dropped too.
    pub fn charts(&mut self, member: MemberId) -> Option<Charts> {
        let declaration = self.declaration(member);
        let Content::Charts(syntax::Charts { polar, cartesian }) = declaration.content else {
            return None;
        };
        let name = declaration.name;
        if name.index != Index::None {
            let message = "charts of a family cannot be read yet";
            let diagnostic = Diagnostic::new(Code::NotAFamily, name.span, message);
            self.push(diagnostic.help("give each point an item of its own"));
            return None;
        }
        let is_inherited = declaration.layer + 1 < self.layer_count;
        let is_gone = |ident: &Ident| !self.is_declared(Namespace::Values, ident);
        if is_inherited && polar.iter().any(is_gone) {
            return None;
        }
        let scope = self.scope(member, &super::value::limits::DEFINITION);
        let [distance, angle] = [&polar[0], &polar[1]];
        let s = self.coordinate_named(distance, None, scope);
        let phi = self.coordinate_named(angle, None, scope);
        let new = [self.new_name(&cartesian[0]), self.new_name(&cartesian[1])];
        let (s, phi) = (s?, phi?);
        if s == phi || cartesian[0].text == cartesian[1].text {
            let second = if s == phi { angle } else { &cartesian[1] };
            let message = format!("`{}` is named twice", second.text);
            self.error(Code::DuplicateName, second.span, message);
            return None;
        }
        let reason = "the second of two polar coordinates is an angle";
        self.require_unit(self.unit_of(phi), Unit::RADIAN, angle.span, reason);
        if self.unit_of(s).is_some_and(Unit::is_angle) {
            let message = "expected a distance, found an angle";
            let diagnostic = Diagnostic::new(Code::UnitMismatch, distance.span, message);
            self.push(diagnostic.help("write `polar(s, phi)`, the distance first"));
        }
        let [x, y] = new;
        Some(Charts {
            name: self.name(member),
            polar: [self.ordinal(s)?, self.ordinal(phi)?],
            cartesian: [x?, y?],
            span: name.span,
        })
    }

    /// Whether anything has this name; a variant may have removed what had it in the base.
    fn is_declared(&self, namespace: Namespace, ident: &Ident) -> bool {
        let group = self.find_group(namespace, &ident.text);
        group.is_some_and(|group| !self.groups[group].members.is_empty())
    }

    /// The name of a coordinate that only the other chart has.
    fn new_name(&mut self, ident: &'a Ident) -> Option<Name> {
        let taken = [Namespace::Values, Namespace::Section(SectionKind::Outputs)];
        let is_taken = |namespace| self.is_declared(namespace, ident);
        let is_reserved = matches!(ident.text.as_str(), "t" | "pi" | "ground");
        if is_reserved || taken.into_iter().any(is_taken) {
            let message = format!("`{}` has another meaning already", ident.text);
            let diagnostic = Diagnostic::new(Code::DuplicateName, ident.span, message);
            let help = "the Cartesian coordinates of a chart need names that nothing else has";
            self.push(diagnostic.help(help));
            return None;
        }
        Some(Name {
            base: ident.text.clone(),
            index: None,
        })
    }

    /// Refuses pairs that share a coordinate or a new name.
    pub(super) fn check_charts(&mut self, all: &[Charts]) {
        for (k, charts) in all.iter().enumerate() {
            let is_shared = |other: &&Charts| {
                let polar = other.polar.iter().any(|q| charts.polar.contains(q));
                polar || other.cartesian.iter().any(|x| charts.cartesian.contains(x))
            };
            if let Some(other) = all[..k].iter().find(is_shared) {
                let message = format!("`{}` and `{}` share a coordinate", other.name, charts.name);
                let diagnostic = Diagnostic::new(Code::DuplicateName, charts.span, message);
                let help = "each coordinate belongs to one pair of charts";
                self.push(diagnostic.note(other.span, "the other pair").help(help));
            }
        }
    }
}
