//! Declarations: items, families and their members, over all layers of a variant.

mod declare;
mod unknown;

use std::collections::BTreeMap;

use lagrangian_symbolic::Expr;
use lagrangian_symbolic::sorting::sort_by_key;

use super::Resolver;
use super::text::show;
use super::value::{MemberId, Scalar, Scope, Value, limits};
use super::work::{Need, State};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Name, stage};
use crate::source::Span;
use crate::syntax::{
    Approximation, Charts, Declared, Equation, Expression, Ident, Index, Quantity, Range, Record,
    Reference, Remove, SectionKind, Spanned,
};
use crate::unit::{Measure, Unit, rate_name};

pub(super) use unknown::{suggestion, with_help};

/// The largest total number of members of all families of a machine.
///
/// A chain of ten thousand links has fifty thousand. A larger number is a typing error in a size,
/// and would only fill the memory.
pub const MEMBER_LIMIT: usize = 100_000;

const MEMBERS: &str = "a machine has at most 100000 members, all families together";

/// Names with a fixed meaning in every expression.
pub(super) const RESERVED_VALUES: [(&str, &str); 2] = [("t", "the time"), ("pi", "the number π")];

/// The advice for a branch.
pub(super) const NO_BRANCHES: &str = crate::syntax::NO_BRANCHES;

/// A namespace; within it a name has one meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Namespace {
    /// Parameters, constants, coordinates, inputs and definitions.
    Values,
    /// Every other section has its own: a frame and a body may share a name.
    Section(SectionKind),
}

impl Namespace {
    pub const FRAMES: Namespace = Namespace::Section(SectionKind::Frames);
    pub const BODIES: Namespace = Namespace::Section(SectionKind::Bodies);
    pub const CIRCLES: Namespace = Namespace::Section(SectionKind::Circles);
    pub const SPHERES: Namespace = Namespace::Section(SectionKind::Spheres);

    pub fn of(section: SectionKind) -> Namespace {
        match section {
            SectionKind::Parameters
            | SectionKind::Constants
            | SectionKind::Coordinates
            | SectionKind::States
            | SectionKind::Inputs
            | SectionKind::Define => Namespace::Values,
            _ => Namespace::Section(section),
        }
    }
}

/// One item as written: a single declaration, or members of a family.
#[derive(Clone, Copy)]
pub(super) struct Declaration<'a> {
    /// The layer that it belongs to; 0 is the base of all.
    pub layer: usize,
    pub section: SectionKind,
    pub name: &'a Declared,
    pub docs: &'a str,
    pub content: Content<'a>,
}

/// The content of an item.
#[derive(Clone, Copy)]
pub(super) enum Content<'a> {
    Quantity(&'a Quantity),
    Expression(&'a Expression),
    Record(&'a Record),
    Equation(&'a Equation),
    Approximation(&'a Spanned<Approximation>),
    Charts(&'a Charts),
    /// A name alone.
    Nothing,
}

/// All declarations of one name.
pub(super) struct Group<'a> {
    pub namespace: Namespace,
    pub base: &'a str,
    /// In the order of layers and of the text.
    pub declarations: Vec<usize>,
    pub removals: Vec<(usize, &'a Remove)>,
    pub state: State,
    /// Whether its members could not be determined, so that a missing one need not be reported.
    pub incomplete: bool,
    pub members: BTreeMap<Option<i64>, MemberId>,
}

/// A single thing, or one member of a family.
pub(super) struct Member<'d> {
    pub group: usize,
    pub declaration: usize,
    pub index: Option<i64>,
    /// Its position among the members of its section, given by its first declaration.
    pub place: (usize, i64),
    pub state: State,
    /// Its value or its frame; for a body its mass centre.
    pub value: Value<'d>,
    /// For a body: its frame.
    pub frame_state: State,
    pub frame: Value<'d>,
    /// For a coordinate: position, velocity, acceleration; for a state: its time integral, itself, its
    /// rate; for a parameter or input: itself, three times.
    pub symbols: Option<[Expr<'d>; 3]>,
}

/// A member before it is numbered.
#[derive(Clone, Copy)]
struct UnnumberedMember {
    declaration: usize,
    place: (usize, i64),
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Refuses an index that hides a reserved name.
    pub fn check_index_variable(&mut self, range: &'a Range) {
        if let Some(variable) = &range.variable {
            self.check_reserved(variable);
        }
    }

    /// Refuses an output with a name under which tables and plots show something else: the time, a coordinate or a state.
    pub fn check_output_name(&mut self, member: MemberId) {
        let Member { group, index, .. } = self.members[member];
        let (base, name) = (self.groups[group].base, self.declaration(member).name);
        let shown = show(base, index);
        let (known, first) = if shown == "t" {
            ("the time", None)
        } else {
            let values = self.find_group(Namespace::Values, base);
            let same = values.and_then(|values| self.groups[values].members.get(&index));
            let Some(&same) = same else {
                return;
            };
            let first = self.declaration(same);
            let known = match first.section {
                SectionKind::Coordinates => "a coordinate",
                SectionKind::States => "a state",
                _ => return,
            };
            (known, Some(first.name.span))
        };
        let message = format!("the output `{shown}` has the name of {known}");
        let code = match first {
            Some(_) => Code::DuplicateName,
            None => Code::ReservedName,
        };
        let mut diagnostic = Diagnostic::new(code, name.span, message);
        if let Some(first) = first {
            diagnostic = diagnostic.note(first, format!("{known} of this name"));
        }
        self.push(diagnostic.help(format!(
            "tables and plots show {} anyway: give the output another name, or leave it out",
            known.replace("a ", "the ")
        )));
    }

    fn check_reserved(&mut self, name: &'a Ident) {
        if let Some((_, meaning)) = RESERVED_VALUES.iter().find(|(word, _)| *word == name.text) {
            let message = format!("`{}` is {meaning} and cannot be declared", name.text);
            self.error(Code::ReservedName, name.span, message);
        }
    }

    fn group(&mut self, namespace: Namespace, base: &'a str) -> usize {
        *self.group_of.entry((namespace, base)).or_insert_with(|| {
            self.groups.push(Group {
                namespace,
                base,
                declarations: Vec::new(),
                removals: Vec::new(),
                state: State::Pending,
                incomplete: false,
                members: BTreeMap::new(),
            });
            self.groups.len() - 1
        })
    }

    /// The group of a name.
    pub(super) fn find_group(&self, namespace: Namespace, base: &str) -> Option<usize> {
        self.group_of.get(&(namespace, base)).copied()
    }

    /// The members that a name with this index refers to: one, or all of a family if there is no index.
    pub fn members_under(&self, group: usize, index: Option<i64>) -> Vec<MemberId> {
        let members = self.groups[group].members.iter();
        members
            .filter(|(other, _)| index.is_none() || **other == index)
            .map(|(_, &member)| member)
            .collect()
    }

    /// Refuses a name that refers to none of the existing members. The name of a family alone refers to all of its members, of which
    /// a size of 0 leaves none.
    pub fn check_members(
        &mut self,
        members: &[MemberId],
        group: usize,
        (base, index): (&str, Option<i64>),
        span: Span,
    ) {
        let Group {
            declarations,
            removals,
            incomplete: broken,
            ..
        } = &self.groups[group];
        let is_family = |&declaration: &usize| {
            matches!(self.declarations[declaration].name.index, Index::Range(_))
        };
        let is_all = index.is_none() && removals.is_empty() && declarations.iter().any(is_family);
        if members.is_empty() && !broken && !is_all {
            let message = format!("there is no `{}`", show(base, index));
            self.error(Code::IndexOutOfRange, span, message);
        }
    }

    /// Determines the members of a name; later layers replace the declarations of earlier ones.
    pub fn expand(&mut self, group: usize) {
        let declarations = self.groups[group].declarations.clone();
        let removals = self.groups[group].removals.clone();
        for &declaration in &declarations {
            self.indices(&self.declarations[declaration].name.index);
        }
        if !self.needs.is_empty() {
            return; // a size that depends on something not yet resolved
        }
        let mut found: BTreeMap<Option<i64>, UnnumberedMember> = BTreeMap::new();
        let mut broken = false;
        for layer in 0..self.layer_count {
            for (_, remove) in removals.iter().filter(|(at, _)| *at == layer) {
                broken |= self.remove_members(&mut found, remove, broken).is_none();
            }
            for &declaration in &declarations {
                if self.declarations[declaration].layer == layer {
                    broken |= self.add_members(&mut found, declaration).is_none();
                }
            }
        }
        if !self.needs.is_empty() {
            return; // a removal depends on something not yet resolved
        }
        let members = found
            .into_iter()
            .map(|(index, found)| (index, self.add_member(group, index, found)))
            .collect();
        self.groups[group].members = members;
        self.groups[group].incomplete = broken;
    }

    /// The indices of a declaration; `None` if an error was reported.
    fn indices(&mut self, index: &'a Index) -> Option<Vec<Option<i64>>> {
        match index {
            Index::None => Some(vec![None]),
            Index::One(index) => Some(vec![Some(self.integer(index, None)?)]),
            Index::Range(range) => {
                let range = self.range(range)?;
                Some(range.map(Some).collect())
            }
        }
    }

    /// The indices of a range, both ends included; none if it ends before it begins.
    pub fn range(&mut self, range: &'a Range) -> Option<std::ops::RangeInclusive<i64>> {
        let low = self.integer(&range.low, None);
        let high = self.integer(&range.high, None);
        let (low, high) = (low?, high?);
        let size = i128::from(high) - i128::from(low) + 1;
        if size > MEMBER_LIMIT as i128 {
            self.too_many(range.span, size);
            return None;
        }
        Some(low..=high)
    }

    fn too_many(&mut self, span: Span, size: i128) {
        let message = format!("a family of {size} members is too large");
        self.push(Diagnostic::new(Code::TooLarge, span, message).help(MEMBERS));
    }

    fn add_members(
        &mut self,
        found: &mut BTreeMap<Option<i64>, UnnumberedMember>,
        declaration: usize,
    ) -> Option<()> {
        let Declaration {
            layer,
            section,
            name,
            ..
        } = self.declarations[declaration];
        let indices = self.indices(&name.index)?;
        let alone = indices == [None];
        // A single thing replaces a family of the same name, and vice versa.
        let other_kind = found.iter().find(|(index, _)| index.is_none() != alone);
        if let Some((_, &other)) = other_kind {
            if self.declarations[other.declaration].layer == layer {
                self.duplicate(name, &name.base.text, other.declaration);
                return Some(());
            }
            found.clear();
        }
        for index in indices {
            let mut place = (declaration, index.unwrap_or(0));
            if let Some(before) = found.get(&index) {
                let other = self.declarations[before.declaration];
                if other.layer == layer {
                    let shown = show(&name.base.text, index);
                    self.duplicate(name, &shown, before.declaration);
                    continue;
                }
                if other.section == section {
                    place = before.place;
                }
            }
            found.insert(index, UnnumberedMember { declaration, place });
        }
        Some(())
    }

    fn duplicate(&mut self, name: &'a Declared, shown: &str, first: usize) {
        let first = self.declarations[first];
        let message = format!("`{shown}` is declared twice");
        let note = format!("first here, as {}", first.section.item());
        let diagnostic = Diagnostic::new(Code::DuplicateName, name.span, message);
        self.push(diagnostic.note(first.name.span, note));
    }

    fn remove_members(
        &mut self,
        found: &mut BTreeMap<Option<i64>, UnnumberedMember>,
        remove: &'a Remove,
        broken: bool,
    ) -> Option<()> {
        let section = remove.section.value;
        let keep = |resolver: &Self, found: &UnnumberedMember| {
            resolver.declarations[found.declaration].section != section
        };
        let named = remove.name.as_ref();
        let Some(name) = named.filter(|name| name.index != Index::None) else {
            found.retain(|_, found| keep(self, found));
            return Some(());
        };
        for index in self.indices(&name.index)? {
            match found.get(&index) {
                Some(member) if !keep(self, member) => {
                    found.remove(&index);
                }
                _ if broken => {}
                _ => {
                    let shown = show(&name.base.text, index);
                    let message = format!("the base has no `{shown}` under `{section}`");
                    self.error(Code::IndexOutOfRange, name.span, message);
                }
            }
        }
        Some(())
    }

    fn add_member(
        &mut self,
        group: usize,
        index: Option<i64>,
        found: UnnumberedMember,
    ) -> MemberId {
        if self.members.len() == MEMBER_LIMIT {
            let span = self.declarations[found.declaration].name.span;
            let message = "with this the machine has too many members";
            let diagnostic = Diagnostic::new(Code::TooLarge, span, message);
            self.push(diagnostic.help(MEMBERS));
            self.exhausted = true;
        }
        self.members.push(Member {
            group,
            declaration: found.declaration,
            index,
            place: found.place,
            state: State::Pending,
            value: Value::Unknown,
            frame_state: State::Pending,
            frame: Value::Unknown,
            symbols: None,
        });
        let member = self.members.len() - 1;
        self.make_symbols(member);
        member
    }

    /// Makes the symbols of parameters, coordinates and inputs, which are known as soon as they are declared; a parameter that
    /// follows from others has none.
    fn make_symbols(&mut self, member: MemberId) {
        if self.is_derived(member) {
            return;
        }
        let Declaration {
            section, content, ..
        } = self.declaration(member);
        let stage = match section {
            SectionKind::Parameters => stage::PARAMETER,
            SectionKind::Coordinates | SectionKind::States => stage::POSITION,
            SectionKind::Inputs => stage::INPUT,
            _ => return,
        };
        let is_state = section == SectionKind::States;
        let name = if is_state {
            self.name(member).integral().to_string()
        } else {
            self.name(member).to_string()
        };
        let mut symbols = [self.symbol(&name, stage); 3];
        if is_state || section == SectionKind::Coordinates {
            let rate = rate_name(&name, "");
            symbols[1] = self.symbol(&rate, stage::VELOCITY);
            symbols[2] = self.symbol(&rate_name(&rate, ""), stage::ACCELERATION);
        }
        let measure = match content {
            Content::Quantity(quantity) => declared_measure(quantity),
            _ => None,
        };
        let dag = self.dag;
        let member = &mut self.members[member];
        member.symbols = Some(symbols);
        member.state = State::Done;
        if let Some(measure) = measure {
            // The symbol is in the declared unit, and so are all values that the user gives and
            // sees; formulas are in SI units.
            let is_si = measure.is_si() || is_state || section == SectionKind::Coordinates;
            member.value = Value::Scalar(Scalar {
                expr: if is_si {
                    symbols[usize::from(is_state)]
                } else {
                    measure.in_si(dag) * symbols[0]
                },
                unit: Some(measure.unit),
                number: None,
            });
        }
    }

    /// The declaration that a member comes from.
    pub(super) fn declaration(&self, member: MemberId) -> Declaration<'a> {
        self.declarations[self.members[member].declaration]
    }

    /// The name of a member.
    pub fn name(&self, member: MemberId) -> Name {
        let member = &self.members[member];
        Name {
            base: self.groups[member.group].base.to_owned(),
            index: member.index,
        }
    }

    /// The scope of the expressions of a member.
    pub fn scope(&self, member: MemberId, limit: &'static super::value::Limit) -> Scope<'a> {
        let index = match &self.declaration(member).name.index {
            Index::Range(Range {
                variable: Some(variable),
                ..
            }) => self.members[member]
                .index
                .map(|index| (variable.text.as_str(), index)),
            _ => None,
        };
        Scope {
            index,
            limit,
            expected_unit: None,
        }
    }

    /// The members of a section in their order, once every family is expanded.
    pub fn members_of(&self, section: SectionKind) -> Vec<MemberId> {
        let mut members: Vec<MemberId> = self
            .groups
            .iter()
            .filter(|group| group.namespace == Namespace::of(section))
            .flat_map(|group| group.members.values().copied())
            .filter(|&member| self.declaration(member).section == section)
            .collect();
        sort_by_key(&mut members, |&member| self.members[member].place);
        members
    }

    /// The member that a reference refers to, if the family is expanded and has it.
    pub fn member(
        &mut self,
        group: usize,
        name: &'a Ident,
        index: Option<&'a Expression>,
        scope: Scope<'a>,
    ) -> Option<MemberId> {
        if self.groups[group].state != State::Done {
            self.need(Need::Group(group), name.span);
            // A wrong index is reported, whatever the members of the family turn out to be.
            if let Some(index) = index {
                self.integer(index, Some(scope));
            }
            return None;
        }
        self.used.insert(group);
        let alone = self.groups[group].members.get(&None).copied();
        let Some(index) = index else {
            if alone.is_none() {
                self.missing_index(group, name);
            }
            return alone;
        };
        let value = self.integer(index, Some(scope));
        if alone.is_some() {
            self.not_a_family(name, index.span);
            return None;
        }
        let value = value?;
        let member = self.groups[group].members.get(&Some(value)).copied();
        if member.is_none() {
            self.index_out_of_range(group, index.span, value);
        }
        member
    }

    fn missing_index(&mut self, group: usize, name: &'a Ident) {
        if self.groups[group].incomplete {
            return;
        }
        let base = &name.text;
        let members: Vec<i64> = self.groups[group]
            .members
            .keys()
            .flatten()
            .copied()
            .collect();
        let diagnostic = match (members.first(), members.last()) {
            (Some(first), Some(last)) => Diagnostic::new(
                Code::MissingIndex,
                name.span,
                format!("`{base}` is a family, and one of its members is needed here"),
            )
            .help(format!(
                "its members are `{base}[{first}]` to `{base}[{last}]`"
            )),
            _ => Diagnostic::new(
                Code::UnknownName,
                name.span,
                format!("`{base}` has no members, or none that remain"),
            ),
        };
        self.push(diagnostic);
    }

    /// Reports an index on a name that is not a family.
    pub fn not_a_family(&mut self, name: &Ident, index: Span) {
        let message = format!("`{}` is not a family and takes no index", name.text);
        self.error(Code::NotAFamily, index, message);
    }

    fn index_out_of_range(&mut self, group: usize, span: Span, index: i64) {
        if self.groups[group].incomplete {
            return;
        }
        let base = self.groups[group].base;
        let members: Vec<i64> = self.groups[group]
            .members
            .keys()
            .flatten()
            .copied()
            .collect();
        let help = match (members.first(), members.last()) {
            (Some(first), Some(last)) => {
                let span = i128::from(*last) - i128::from(*first) + 1;
                let is_complete = span == members.len() as i128;
                let gaps = if is_complete { "" } else { ", with gaps" };
                format!("the members are `{base}[{first}]` to `{base}[{last}]`{gaps}")
            }
            _ => "the family has no members".to_owned(),
        };
        let message = format!("there is no `{base}[{index}]`");
        self.push(Diagnostic::new(Code::IndexOutOfRange, span, message).help(help));
    }

    /// An integer that is known when the machine is derived: an index, or the end of a range.
    pub fn integer(&mut self, expression: &'a Expression, scope: Option<Scope<'a>>) -> Option<i64> {
        let scope = Scope {
            index: scope.and_then(|scope| scope.index),
            limit: &limits::INDEX,
            expected_unit: Some(Unit::ONE),
        };
        let scalar = self.scalar(expression, scope)?;
        self.require_unit(
            scalar.unit,
            Unit::ONE,
            expression.span,
            "an index has no unit",
        );
        let value = scalar.expr.as_constant();
        let integer = value.as_ref().and_then(|value| value.as_integer());
        if integer.is_none() {
            let message = match (value, scalar.number) {
                (Some(value), _) if value.is_integer() => {
                    "an index has at most 18 digits, and this has more".to_owned()
                }
                (Some(value), _) => format!("an index is a whole number, found {value}"),
                (None, Some(number)) => format!("an index is a whole number, found {number}"),
                (None, None) => "an index is a whole number".to_owned(),
            };
            self.error(Code::IndexNotWhole, expression.span, message);
        }
        integer
    }

    /// The group that a reference names; an unknown name is reported.
    pub(super) fn known_group(
        &mut self,
        namespace: Namespace,
        noun: &str,
        name: &'a Ident,
    ) -> Option<usize> {
        let group = self.find_group(namespace, &name.text);
        if group.is_none() {
            self.unknown_name(noun, name, &[namespace]);
        }
        group
    }

    /// The member that a plain name, `x` or `q[i]`, refers to in a namespace.
    pub(super) fn named_member(
        &mut self,
        namespace: Namespace,
        noun: &str,
        reference: &'a Reference,
        scope: Scope<'a>,
    ) -> Option<MemberId> {
        let group = self.known_group(namespace, noun, &reference.base)?;
        self.member(group, &reference.base, reference.index.as_deref(), scope)
    }
}

/// The unit of a declaration; `None` if it is missing or unknown, which was reported.
pub(super) fn declared_unit(quantity: &Quantity) -> Option<Unit> {
    Some(declared_measure(quantity)?.unit)
}

/// The unit of a declaration, with its size in SI units.
pub(super) fn declared_measure(quantity: &Quantity) -> Option<Measure> {
    let mut measure = Measure::ONE;
    for factor in &quantity.unit.as_ref()?.factors {
        let named = Measure::named(&factor.name.text)?;
        let power = if factor.halved {
            named.half_power(factor.power)?
        } else {
            named.power(factor.power)?
        };
        measure = measure.times(&power)?;
    }
    // `km/m` is not an SI unit, but `mm*km/m` is one.
    measure.unit = measure.unit.as_written(!measure.is_si());
    Some(measure)
}
