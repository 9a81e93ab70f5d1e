//! Resolves the items of sections of elements, by a table of these sections.

use super::Resolver;
use super::value::MemberId;
use crate::model::Name;
use crate::model::element::{Contribution, Drawing, Element};
use crate::syntax::{Expression, Section, SectionKind, Spec};

/// A section of elements: its syntax, and the resolution of its items.
#[derive(Clone, Copy)]
pub(crate) struct Row {
    /// Its syntax, and the words for its items.
    pub section: &'static Section,
    /// Its resolution.
    pub meaning: Meaning,
}

/// How a section is resolved; the functions return none if an error was reported.
#[derive(Clone, Copy)]
pub(crate) enum Meaning {
    /// Item by item.
    Items(for<'a, 'd, 'r> fn(&mut Resolver<'a, 'd, 'r>, MemberId) -> Option<Resolved<'d>>),
    /// As the expression of a single statement.
    Statement(
        for<'a, 'd, 'r> fn(&mut Resolver<'a, 'd, 'r>, &'a Expression) -> Option<Resolved<'d>>,
    ),
}

/// The contributions of an element, and its drawing.
pub(crate) struct Resolved<'d> {
    contributions: Vec<Contribution<'d>>,
    drawing: Option<Drawing<'d>>,
}

impl<'d> Resolved<'d> {
    /// An element without a drawing.
    pub fn of(contributions: impl IntoIterator<Item = Contribution<'d>>) -> Resolved<'d> {
        Resolved {
            contributions: contributions.into_iter().collect(),
            drawing: None,
        }
    }

    /// This element with a drawing.
    pub fn drawn(self, drawing: Drawing<'d>) -> Resolved<'d> {
        Resolved {
            drawing: Some(drawing),
            ..self
        }
    }
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// All elements of the machine, in the order of the list.
    pub fn elements(&mut self, layers: &'a [Spec]) -> Vec<Element<'d>> {
        let mut elements = Vec::new();
        for row in self.language.elements {
            match row.meaning {
                Meaning::Items(resolve) => {
                    let section = SectionKind::Element(row.section);
                    elements.extend(self.resolve_each(section, |resolver, member| {
                        let Resolved {
                            contributions,
                            drawing,
                        } = resolve(resolver, member)?;
                        Some(Element {
                            section: row.section,
                            name: resolver.name(member),
                            docs: resolver.docs(member),
                            contributions,
                            drawing,
                            span: resolver.span(member),
                        })
                    }));
                }
                Meaning::Statement(resolve) => {
                    elements.extend(self.statement(layers, row.section, resolve));
                }
            }
        }
        elements
    }

    /// The element of a section that is a single statement, as given by the last variant.
    fn statement(
        &mut self,
        layers: &'a [Spec],
        section: &'static Section,
        resolve: impl Fn(&mut Self, &'a Expression) -> Option<Resolved<'d>>,
    ) -> Option<Element<'d>> {
        let mut written = None;
        for spec in layers {
            let mut removed = spec.remove.iter().map(|remove| remove.section.value);
            if removed.any(|kind| kind == SectionKind::Element(section)) {
                written = None;
            }
            written = spec.statement(section.word).or(written);
        }
        let written = written?;
        let value = written.value.as_ref()?;
        let resolved = self.repeat_until_resolved(|resolver| resolve(resolver, value))?;
        Some(Element {
            section,
            name: Name {
                base: section.word.to_owned(),
                index: None,
            },
            docs: written.docs.clone(),
            contributions: resolved.contributions,
            drawing: resolved.drawing,
            span: written.span,
        })
    }
}
