//! Parses the machine: its heading, its sections, and the statements between them.

use crate::diagnostic::{Code, Diagnostic, most_similar, one_of};
use crate::source::Span;
use crate::syntax::ast::*;
use crate::syntax::parse::Parser;
use crate::syntax::section::{Form, Section};
use crate::token::{Delimiter, TokenKind, shown};

impl Parser<'_> {
    /// `machine … { … }`, and nothing else.
    pub(super) fn source(&mut self) -> Spec {
        let docs = self.docs();
        if !self.find_machine() {
            return Spec {
                incomplete: true,
                ..Spec::default()
            };
        }
        let spec = self.machine(docs);
        self.docs();
        if self.is_word("machine") {
            let message = "this is a second machine";
            let second = Diagnostic::new(Code::SecondMachine, self.next_span(), message);
            self.report_error(
                second.help("a spec contains only one machine: move this one to a file of its own"),
            );
        } else if self.peek().is_some() {
            let help = "the machine ended at the previous brace; sections belong inside its braces";
            self.unexpected_because("the end", Some(help.to_owned()));
        }
        spec
    }

    /// Advances to the word `machine`, or to one that was probably meant as such.
    fn find_machine(&mut self) -> bool {
        if self.eat_word("machine") {
            return true;
        }
        let help = "a spec is `machine Name in plane { … }`, or `in space`";
        let Some(word) = self.peek() else {
            if !self.report.has_errors() {
                let message = "there is no machine here";
                let nothing = Diagnostic::new(Code::NoMachine, self.end, message);
                self.report_error(nothing.help(help));
            }
            return false;
        };
        let message = format!("expected `machine`, found {}", self.found());
        let wrong = Diagnostic::new(Code::NoMachine, word.span, message);
        let is_slip = most_similar(word.text, ["machine"]).is_some();
        let is_variant = word.text == "extends";
        self.report_error(wrong.help(match (is_slip, is_variant) {
            (true, _) => "did you mean `machine`?",
            (_, true) => "give it a name: `machine Name extends \"base.machine\" { … }`",
            _ => help,
        }));
        while self.peek().is_some() && !self.is_word("machine") && !is_slip {
            self.skip_word();
        }
        let found = self.peek().is_some();
        self.at += usize::from(found);
        found
    }

    fn machine(&mut self, docs: String) -> Spec {
        let start = self.previous_span();
        let mut spec = Spec {
            docs,
            ..Spec::default()
        };
        if self.is_word("in") || self.is_word("extends") {
            let help = if self.is_word("in") {
                "write `machine Name in plane { … }`"
            } else {
                "give it a name: `machine Name extends \"base.machine\" { … }`"
            };
            self.unexpected_because("the name of the machine", Some(help.to_owned()));
            self.failed = false;
        } else if let Some(name) = self.ident("the name of the machine") {
            spec.name = name;
        }
        while self.header_clause(&mut spec) {}
        // After any error in the heading, the content of the braces is still parsed.
        while self.failed && self.peek().is_some() && !self.is_open(Delimiter::Brace) {
            self.skip_word();
        }
        let heading_failed = std::mem::take(&mut self.failed);
        if spec.space.is_none() && spec.extends.is_none() && !heading_failed {
            let message = "this machine does not state whether it moves in the plane or in space";
            let missing = Diagnostic::new(Code::MissingSpace, spec.name.span, message);
            let help = format!(
                "write `machine {} in plane {{ … }}`, or `in space`",
                spec.name.text
            );
            self.report_error(missing.help(help));
        }
        let Some(group) = self.enter(Delimiter::Brace) else {
            self.failed = false;
            self.at = self.words.len();
            spec.incomplete = true;
            spec.span = start.to(spec.name.span);
            return spec;
        };
        spec.span = start.to(group.span);
        // A variant that changes nothing is its base under another name, which is allowed.
        if self.at >= group.close && spec.extends.is_none() {
            let message = "this machine is empty";
            let empty = Diagnostic::new(Code::EmptyMachine, group.span, message);
            self.report_error(empty.help("a machine has `coordinates { … }` and `bodies { … }`"));
        }
        while self.at < group.close {
            self.entry(&mut spec, group.close);
        }
        self.leave(group, "");
        spec
    }

    /// `in plane`, `in space` or `extends "…"`.
    fn header_clause(&mut self, spec: &mut Spec) -> bool {
        let start = self.next_span();
        if self.eat_word("in") {
            let Some(value) = self.space() else {
                return false;
            };
            let span = start.to(self.previous_span());
            match spec.space {
                Some(first) => {
                    self.report_duplicate(span, "the choice between plane and space", first.span)
                }
                None => spec.space = Some(Spanned { value, span }),
            }
            return true;
        }
        if self.eat_word("extends") {
            let Some(word) = self.peek().filter(|word| word.kind == TokenKind::Text) else {
                let help = "write `extends \"base.machine\"`".to_owned();
                self.unexpected_because("the name of a file in quotes", Some(help));
                return false;
            };
            self.at += 1;
            let (value, span) = (word.text.to_owned(), word.span);
            match &spec.extends {
                Some(first) => self.report_duplicate(span, "the base", first.span),
                None => spec.extends = Some(Spanned { value, span }),
            }
            return true;
        }
        if !self.failed && !self.is_open(Delimiter::Brace) {
            self.unexpected("`in plane`, `in space`, `extends \"…\"` or `{`");
        }
        false
    }

    /// `plane` or `space`
    fn space(&mut self) -> Option<Space> {
        let word = self.peek().filter(|word| word.kind == TokenKind::Ident);
        let space = match word.map(|word| word.text) {
            Some("plane") => Space::Plane,
            Some("space") => Space::Space,
            other => {
                let near = other.and_then(|word| most_similar(word, ["plane", "space"]));
                let help = near.map(|near| format!("did you mean `{near}`?"));
                self.unexpected_because("`plane` or `space`", help);
                return None;
            }
        };
        self.at += 1;
        Some(space)
    }

    /// A section, or a statement that ends with `;`.
    fn entry(&mut self, spec: &mut Spec, close: usize) {
        let docs = self.docs();
        if self.at >= close {
            return self.report_misplaced_docs();
        }
        if self.is_mark(',') || self.is_mark(';') {
            let help = "nothing is allowed between sections".to_owned();
            self.unexpected_because("a section", Some(help));
            self.failed = false;
            self.at += 1;
            return;
        }
        let Some(heading) = self.ident("a section") else {
            return self.skip_to_heading(close);
        };
        if heading.text == "remove" {
            return self.remove(spec, heading.span, close);
        }
        if heading.text == "machine" {
            let message = "a machine cannot be inside another";
            let inner = Diagnostic::new(Code::SecondMachine, heading.span, message);
            self.fail(inner.help("a spec contains only one machine; a variant `extends` a file"));
            return self.skip_to_heading(close);
        }
        match SectionKind::named_among(self.sections, &heading.text)
            .or_else(|| self.unknown_section(&heading))
        {
            Some(kind) => {
                spec.sections.push(Spanned {
                    value: kind,
                    span: heading.span,
                });
                self.section(spec, kind, heading.span, docs);
            }
            None => self.failed = true,
        }
        if self.failed {
            self.skip_to_heading(close);
        }
    }

    /// Reports an unknown section; returns the one that was meant.
    fn unknown_section(&mut self, heading: &Ident) -> Option<SectionKind> {
        let message = format!("there is no section {}", shown(&heading.text));
        let mut unknown = Diagnostic::new(Code::UnknownSection, heading.span, message);
        let sections = self.sections;
        let names = || sections.iter().map(|kind| kind.as_str());
        let meant = SectionKind::meant_by(&heading.text).map(SectionKind::as_str);
        let near = meant.or_else(|| most_similar(&heading.text, names().chain(["remove"])));
        unknown.help = Some(match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the sections are {}", one_of(names())),
        });
        self.report_error(unknown);
        near.and_then(|near| SectionKind::named_among(sections, near))
    }

    /// Continues at the next heading, or after the next section.
    fn skip_to_heading(&mut self, close: usize) {
        let start = self.at;
        while self.at < close {
            let is_section = self.is_open(Delimiter::Brace);
            let is_end = self.is_mark(';');
            self.skip_word();
            if is_section || is_end {
                break;
            }
            let next = self.peek().filter(|word| word.kind == TokenKind::Ident);
            if next.is_some_and(|word| SectionKind::named_among(self.sections, word.text).is_some())
            {
                break;
            }
        }
        self.note_skipped(start, self.at);
        self.failed = false;
    }

    /// The content after a heading.
    fn section(&mut self, spec: &mut Spec, kind: SectionKind, heading: Span, docs: String) {
        match kind {
            SectionKind::Parameters => self.quantities(kind, &mut spec.parameters),
            SectionKind::Constants => self.quantities(kind, &mut spec.constants),
            SectionKind::Coordinates => self.coordinates(spec),
            SectionKind::States => self.states(spec),
            SectionKind::Inputs => self.quantities(kind, &mut spec.inputs),
            SectionKind::Outputs => self.quantities(kind, &mut spec.outputs),
            SectionKind::Define => self.values(kind, &mut spec.define, '='),
            SectionKind::Frames => self.values(kind, &mut spec.frames, '='),
            SectionKind::Bodies => self.records(kind, &mut spec.bodies),
            SectionKind::Circles => self.records(kind, &mut spec.circles),
            SectionKind::Spheres => self.records(kind, &mut spec.spheres),
            SectionKind::Contacts => self.records(kind, &mut spec.contacts),
            SectionKind::Approximations => self.approximations(&mut spec.approximations),
            SectionKind::Derivatives => self.words(kind, &mut spec.derivatives),
            SectionKind::Stages => self.words(kind, &mut spec.stages),
            SectionKind::Methods => self.words(kind, &mut spec.methods),
            SectionKind::Charts => self.charts(&mut spec.charts),
            SectionKind::Keep => self.kept(&mut spec.keep),
            SectionKind::Brachistochrone => self.values(kind, &mut spec.brachistochrone, '='),
            SectionKind::Assume => self.assume(&mut spec.assume),
            SectionKind::Element(section) => match section.form {
                Form::Statement => self.statement(spec, section, heading, docs),
                _ => self.elements(section, spec),
            },
            SectionKind::Published => self.published(spec, heading, docs),
        }
    }

    /// `gravity (0, -g);`
    fn statement(
        &mut self,
        spec: &mut Spec,
        section: &'static Section,
        heading: Span,
        docs: String,
    ) {
        let help = section.help;
        if !self.is_open(Delimiter::Parenthesis) && !self.is(TokenKind::Ident) {
            self.unexpected_because("a vector", Some(help.to_owned()));
            return;
        }
        let value = if self.eat_word("none") {
            None
        } else {
            Some(self.expression())
        };
        let span = heading.to(self.previous_span());
        match spec.statement(section.word) {
            Some(first) => self.report_duplicate(heading, section.item, first.span),
            None => spec.statements.push(SectionStatement {
                section,
                docs,
                value,
                span,
            }),
        }
        self.end_of_statement(help);
    }

    /// `;`
    fn end_of_statement(&mut self, help: &str) {
        if self.failed || self.eat_mark(';') {
            return;
        }
        let next_is_entry = self.is(TokenKind::Ident) || self.is(TokenKind::Doc);
        self.unexpected_because("`;`", Some(help.to_owned()));
        // Only the semicolon is missing.
        self.failed = !next_is_entry;
    }

    /// `remove springs.x_left;`, after its first word.
    fn remove(&mut self, spec: &mut Spec, start: Span, close: usize) {
        let help = "write `remove springs.x_left;`";
        if spec.extends.is_none() {
            let message = "this machine extends nothing from which anything could be removed";
            let wrong = Diagnostic::new(Code::NothingToRemove, start, message);
            self.report_error(
                wrong.help("`machine Variant extends \"base.machine\" { … }` has a base"),
            );
        }
        let section = self.ident("a section").and_then(|heading| {
            let value = SectionKind::named_among(self.sections, &heading.text)
                .or_else(|| self.unknown_section(&heading))?;
            Some(Spanned {
                value,
                span: heading.span,
            })
        });
        let mut name = None;
        match section.map(|section| section.value) {
            None => self.failed = true,
            Some(SectionKind::Element(Section {
                form: Form::Statement,
                ..
            })) => {}
            Some(kind @ (SectionKind::Assume | SectionKind::Published)) => {
                let message = format!("the items of `{kind}` have no names and cannot be removed");
                self.fail(Diagnostic::new(
                    Code::NothingToRemove,
                    self.previous_span(),
                    message,
                ));
            }
            // `remove springs;` takes all of them.
            Some(_) if self.is_mark(';') => {}
            Some(kind) => {
                if !self.eat_mark('.') {
                    self.unexpected_because("`.` or `;`", Some(help.to_owned()));
                }
                name = match kind {
                    SectionKind::Keep => self.kept_start(),
                    _ => self.declared(&format!("the name of {}", kind.item())),
                };
            }
        }
        self.end_of_statement(help);
        let span = start.to(self.previous_span());
        if self.failed {
            return self.skip_to_heading(close);
        }
        if let Some(section) = section
            && spec.extends.is_some()
        {
            spec.remove.push(Remove {
                section,
                name,
                span,
            });
        }
    }
}
