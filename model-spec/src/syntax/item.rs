//! Parses items of sections, by their content.

use crate::diagnostic::{Code, Diagnostic, most_similar, one_of};
use crate::source::Span;
use crate::syntax::ast::*;
use crate::syntax::brackets::Word;
use crate::syntax::parse::{Group, Parser};
use crate::syntax::rate_name;
use crate::syntax::section::{Form, Section};
use crate::token::{Delimiter, TokenKind, shown};
use crate::unit::Measure;

impl Parser<'_> {
    /// The items of a section: documentation, a name, and the content that `content` parses.
    fn items<C>(
        &mut self,
        kind: SectionKind,
        items: &mut Vec<Item<C>>,
        mut content: impl FnMut(&mut Self, &Declared) -> Option<C>,
    ) {
        self.each_item(kind, |parser, docs| {
            let start = parser.next_span();
            let name = parser.declared(&format!("the name of {}", kind.item()))?;
            let content = content(parser, &name)?;
            let span = start.to(parser.previous_span());
            items.push(Item {
                docs,
                name,
                content,
                span,
            });
            Some(())
        });
    }

    /// Parses each item of a section, after its documentation; `None` is an item that cannot be parsed.
    fn each_item(
        &mut self,
        kind: SectionKind,
        mut item: impl FnMut(&mut Self, String) -> Option<()>,
    ) {
        let Some(group) = self.enter_section(kind) else {
            return;
        };
        let close = group.close;
        self.list(group, Parser::begins_item, |parser| {
            let docs = parser.docs();
            if parser.at >= close {
                return parser.report_misplaced_docs();
            }
            item(parser, docs);
        });
    }

    /// The brace after a heading.
    pub(super) fn enter_section(&mut self, kind: SectionKind) -> Option<Group> {
        let brace_follows = self
            .peek_second()
            .is_some_and(|word| word.kind == TokenKind::Open(Delimiter::Brace));
        let mark = self.is_mark(':') || self.is_mark('=');
        if mark && brace_follows {
            let help = format!("write `{kind} {{ … }}`");
            self.unexpected_because("`{`", Some(help));
            self.failed = false;
            self.at += 1;
        }
        self.enter(Delimiter::Brace)
    }

    /// Whether an item begins here: documentation, or `name:`, `name =`, `name {`, `name[…]`, `der(…)`.
    fn begins_item(&self) -> bool {
        let follows = |kind| {
            matches!(
                kind,
                TokenKind::Punct(':' | '=')
                    | TokenKind::Open(Delimiter::Brace | Delimiter::Bracket)
            )
        };
        match self.peek().map(|word| word.kind) {
            Some(TokenKind::Doc) => true,
            Some(TokenKind::Ident) => {
                self.begins_rate() || self.peek_second().is_some_and(|word| follows(word.kind))
            }
            _ => self.doc_attribute().is_some(),
        }
    }

    /// Whether the rate of a coordinate begins here: `der(`.
    fn begins_rate(&self) -> bool {
        let bracket = TokenKind::Open(Delimiter::Parenthesis);
        self.is_word("der") && self.peek_second().is_some_and(|word| word.kind == bracket)
    }

    /// A name in a declaration: `theta`, `link[0]`, `q[1..N]`, `bob[i in 1..N]`.
    pub(super) fn declared(&mut self, noun: &str) -> Option<Declared> {
        let base = self.ident(noun)?;
        let mut declared = Declared {
            span: base.span,
            base,
            index: Index::None,
        };
        if self.is_open(Delimiter::Bracket)
            && let Some(group) = self.enter(Delimiter::Bracket)
        {
            declared.span = declared.span.to(group.span);
            declared.index = self.index();
            self.leave(group, "`]`");
        }
        self.refuse_second_index();
        Some(declared)
    }

    /// Refuses an index behind an index.
    pub(super) fn refuse_second_index(&mut self) {
        if self.is_open(Delimiter::Bracket) {
            let message = "a family has one index";
            self.fail(Diagnostic::new(
                Code::MisplacedIndex,
                self.next_span(),
                message,
            ));
        }
    }

    /// The content of the brackets of a declaration.
    fn index(&mut self) -> Index {
        let second_is_in = self
            .peek_second()
            .is_some_and(|word| word.kind == TokenKind::Ident && word.text == "in");
        if self.is(TokenKind::Ident) && second_is_in {
            return match self.range() {
                Some(range) => Index::Range(range),
                None => Index::None,
            };
        }
        let low = self.expression();
        if !self.is_pair('.', '.') {
            return Index::One(low);
        }
        Index::Range(self.range_above(None, low.span, low))
    }

    /// `i in 1..N`
    fn range(&mut self) -> Option<Range> {
        let variable = self.ident("the name of an index")?;
        if !self.eat_word("in") {
            self.unexpected_because("`in`", Some("write `i in 1..N`".to_owned()));
            return None;
        }
        let start = variable.span;
        let low = self.expression();
        if !self.is_pair('.', '.') {
            if !self.failed {
                self.unexpected_because("`..`", Some("write `i in 1..N`".to_owned()));
            }
            return None;
        }
        Some(self.range_above(Some(variable), start, low))
    }

    /// `..N`, after the first index.
    fn range_above(&mut self, variable: Option<Ident>, start: Span, low: Expression) -> Range {
        self.at += 2;
        if self.is_mark('=') || self.is_mark('.') {
            let message = "a range is written `1..N` and includes both ends";
            let wrong = Diagnostic::new(Code::UnexpectedToken, self.next_span(), message);
            self.report_error(wrong.help("write `1..N`"));
            self.at += 1;
        }
        let high = self.expression();
        let span = start.to(high.span);
        Range {
            variable,
            low,
            high,
            span,
        }
    }

    /// Items `name: unit = value`.
    pub(super) fn quantities(&mut self, kind: SectionKind, items: &mut Vec<Item<Quantity>>) {
        let needs_value = matches!(kind, SectionKind::Constants | SectionKind::Outputs);
        self.items(kind, items, |parser, name| {
            Some(parser.quantity(kind, &name.base.text, name.span, needs_value))
        });
    }

    /// Items `name: unit = start`, and `der(name): unit = rate`.
    pub(super) fn coordinates(&mut self, spec: &mut Spec) {
        let kind = SectionKind::Coordinates;
        self.each_item(kind, |parser, docs| {
            let start = parser.next_span();
            let is_rate = parser.begins_rate();
            let name = if is_rate {
                parser.rate_of()?
            } else {
                parser.declared(&format!("the name of {}", kind.item()))?
            };
            let word = if is_rate {
                format!("der({})", name.base.text)
            } else {
                name.base.text.clone()
            };
            let content = parser.quantity(kind, &word, name.span, is_rate);
            let items = if is_rate {
                &mut spec.rates
            } else {
                &mut spec.coordinates
            };
            items.push(Item {
                docs,
                name,
                content,
                span: start.to(parser.previous_span()),
            });
            Some(())
        });
    }

    /// Items `name: unit = start`, and `der(name) = expression`.
    pub(super) fn states(&mut self, spec: &mut Spec) {
        let kind = SectionKind::States;
        self.each_item(kind, |parser, docs| {
            let start = parser.next_span();
            let is_rate = parser.begins_rate();
            let (name, content) = if is_rate {
                let name = parser.rate_of()?;
                let unit = if parser.eat_mark(':') {
                    parser.unit()
                } else {
                    None
                };
                parser.expect_equals();
                let value = Some(parser.expression());
                (name, Quantity { unit, value })
            } else {
                let name = parser.declared(&format!("the name of {}", kind.item()))?;
                let content = parser.quantity(kind, &name.base.text, name.span, false);
                (name, content)
            };
            let items = if is_rate {
                &mut spec.state_rates
            } else {
                &mut spec.states
            };
            items.push(Item {
                docs,
                name,
                content,
                span: start.to(parser.previous_span()),
            });
            Some(())
        });
    }

    /// `der(phi)`, `der(q[1..N])`: the coordinate; its span covers the whole.
    fn rate_of(&mut self) -> Option<Declared> {
        let start = self.next_span();
        self.at += 1;
        let group = self.enter(Delimiter::Parenthesis)?;
        let declared = self.declared("the name of a coordinate");
        self.leave(group, "`)`");
        let span = start.to(self.previous_span());
        declared.map(|declared| Declared { span, ..declared })
    }

    /// `: unit = value`, after the name.
    fn quantity(
        &mut self,
        kind: SectionKind,
        word: &str,
        name: Span,
        needs_value: bool,
    ) -> Quantity {
        let mut has_unit = self.eat_mark(':');
        let is_unit = |word: Word| Measure::named(word.text).is_some();
        if !has_unit && self.peek().is_some_and(is_unit) {
            let help = Some(format!(
                "write `{word}: {}`",
                self.peek().map_or("", |unit| unit.text)
            ));
            self.unexpected_because("`:`", help);
            self.failed = false;
            has_unit = true;
        }
        let unit = has_unit.then(|| self.unit()).flatten();
        let has_value = self.is_mark('=');
        if !has_unit && kind != SectionKind::Constants && !self.failed {
            let message = format!("`{word}` has no unit");
            let missing = Diagnostic::new(Code::MissingUnit, name, message);
            let is_rate = kind == SectionKind::Coordinates && needs_value;
            self.report_error(missing.help(if is_rate {
                format!("write `{word}: m/s`, or the unit of its coordinate over `s`")
            } else {
                format!("write `{word}: m`, or whatever its unit is; a pure number is `{word}: 1`")
            }));
        }
        let value = if has_value {
            self.expect_equals();
            Some(self.expression())
        } else {
            if needs_value && !self.failed {
                let message = format!("`{word}` has no value");
                let missing = Diagnostic::new(Code::MissingValue, name, message);
                self.report_error(missing.help(format!("write `{word}: unit = expression`")));
            }
            None
        };
        Quantity { unit, value }
    }

    /// Items `name = value`, or `name: value`.
    pub(super) fn values(
        &mut self,
        kind: SectionKind,
        items: &mut Vec<Item<Expression>>,
        mark: char,
    ) {
        let (other, help) = match mark {
            '=' => (':', format!("an item of `{kind}` is `name = expression`")),
            _ => ('=', format!("an item of `{kind}` is `name: expression`")),
        };
        self.items(kind, items, |parser, _| {
            parser.expect_mark_not(mark, other, &help);
            Some(parser.expression())
        });
    }

    /// Items `name { field: value, … }`.
    pub(super) fn records(&mut self, kind: SectionKind, items: &mut Vec<Item<Record>>) {
        self.items(kind, items, |parser, _| {
            parser.enter_section_item(kind);
            let Some(group) = parser.enter(Delimiter::Brace) else {
                parser.skipped_names = true;
                return None;
            };
            let mut fields = Vec::new();
            let span = parser.list(group, Parser::begins_item, |parser| {
                parser.docs();
                parser.field(kind, &mut fields);
            });
            Some(Record { fields, span })
        });
    }

    /// `name: { … }` is parsed like `name { … }`.
    fn enter_section_item(&mut self, kind: SectionKind) {
        if (self.is_mark(':') || self.is_mark('='))
            && self
                .peek_second()
                .is_some_and(|word| word.kind == TokenKind::Open(Delimiter::Brace))
        {
            let message = format!("expected `{{`, found {}", self.found());
            let wrong = Diagnostic::new(Code::UnexpectedToken, self.next_span(), message);
            self.report_error(wrong.help(format!("{} is `name {{ … }}`", kind.item())));
            self.at += 1;
        }
    }

    /// `field: value`
    fn field(&mut self, kind: SectionKind, fields: &mut Vec<Field>) {
        let Some(name) = self.ident("the name of a field") else {
            return;
        };
        self.expect_mark_not(':', '=', "a field is `name: expression`");
        let value = self.expression();
        let known = kind.fields().iter().copied();
        let mut meant = name.clone();
        if !kind.fields().contains(&name.text.as_str()) {
            let message = format!("{} has no field {}", kind.item(), shown(&name.text));
            let mut unknown = Diagnostic::new(Code::UnknownField, name.span, message);
            let near = most_similar(&name.text, known.clone());
            unknown.help = Some(match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("its fields are {}", one_of(known)),
            });
            self.report_always(unknown);
            // The intended field is present, so it need not be reported as missing.
            match near {
                Some(near) => meant.text = near.to_owned(),
                None => return,
            }
        }
        match fields.iter().find(|field| field.name.text == meant.text) {
            None => fields.push(Field { name: meant, value }),
            Some(first) if meant == name => {
                let first = first.name.span;
                self.report_duplicate(name.span, &format!("`{}`", name.text), first);
            }
            Some(_) => {}
        }
    }

    /// The items of a section of elements.
    pub(super) fn elements(&mut self, section: &'static Section, spec: &mut Spec) {
        let kind = SectionKind::Element(section);
        match section.form {
            Form::Records(_) => {
                let mut items = Vec::new();
                self.records(kind, &mut items);
                spec.add_elements(section, items, ElementContent::Record);
            }
            Form::Expressions => {
                let mut items = Vec::new();
                self.values(kind, &mut items, ':');
                spec.add_elements(section, items, ElementContent::Expression);
            }
            Form::Equations => {
                let mut items = Vec::new();
                self.equations(kind, &mut items);
                spec.add_elements(section, items, ElementContent::Equation);
            }
            // A single-statement section has no items.
            Form::Statement => {}
        }
    }

    /// Items `name: left = right`.
    fn equations(&mut self, kind: SectionKind, items: &mut Vec<Item<Equation>>) {
        self.items(kind, items, |parser, _| {
            parser.expect_mark(':');
            Some(parser.equation())
        });
    }

    /// `left = right`
    fn equation(&mut self) -> Equation {
        let left = self.expression();
        if !self.failed {
            self.expect_equals();
        }
        let right = self.expression();
        Equation { left, right }
    }

    /// Items `coordinate: frozen`, or `small`.
    pub(super) fn approximations(&mut self, items: &mut Vec<Item<Spanned<Approximation>>>) {
        let kind = SectionKind::Approximations;
        self.items(kind, items, |parser, _| {
            parser.expect_mark(':');
            let word = parser.ident("`frozen` or `small`")?;
            let value = match word.text.as_str() {
                "frozen" => Approximation::Frozen,
                "small" => Approximation::Small,
                other => {
                    let message = format!("there is no approximation {}", shown(other));
                    let unknown = Diagnostic::new(Code::UnknownApproximation, word.span, message);
                    let help = match most_similar(other, ["frozen", "small"]) {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => "a coordinate can be `frozen` or `small`".to_owned(),
                    };
                    parser.report_error(unknown.help(help));
                    return None;
                }
            };
            Some(Spanned {
                value,
                span: word.span,
            })
        });
    }

    /// Items `coordinates`, `rates`, `m`.
    pub(super) fn words(&mut self, kind: SectionKind, items: &mut Vec<Item<()>>) {
        self.items(kind, items, |_, _| Some(()));
    }

    /// Items `name: polar(s, phi) | cartesian(x, y)`.
    pub(super) fn charts(&mut self, items: &mut Vec<Item<Charts>>) {
        self.items(SectionKind::Charts, items, |parser, _| {
            parser.expect_mark(':');
            let polar = parser.chart("polar")?;
            if !parser.eat_mark('|') {
                let help = "write `name: polar(s, phi) | cartesian(x, y)`";
                parser.unexpected_because("`|`", Some(help.to_owned()));
                return None;
            }
            let cartesian = parser.chart("cartesian")?;
            Some(Charts { polar, cartesian })
        });
    }

    /// `polar(s, phi)`, or another word with two names.
    fn chart(&mut self, word: &str) -> Option<[Ident; 2]> {
        if self.failed {
            return None;
        }
        if !self.eat_word(word) {
            let help = "write `name: polar(s, phi) | cartesian(x, y)`";
            self.unexpected_because(&format!("`{word}(`"), Some(help.to_owned()));
            return None;
        }
        let group = self.enter(Delimiter::Parenthesis)?;
        let first = self.ident("the name of a coordinate");
        if first.is_some() {
            self.expect_mark(',');
        }
        let second = if self.failed {
            None
        } else {
            self.ident("the name of a coordinate")
        };
        self.leave(group, "`)`");
        Some([first?, second?])
    }

    /// Items `theta`, `der(theta)`, `q[1..N]`.
    pub(super) fn kept(&mut self, items: &mut Vec<Item<()>>) {
        self.each_item(SectionKind::Keep, |parser, docs| {
            let start = parser.next_span();
            let name = parser.kept_start()?;
            if parser.is_mark('=') || parser.is_mark(':') {
                let help = "start values belong under `coordinates`: `theta: rad = 0.3`, \
                            `der(theta): rad/s = 2`";
                parser.unexpected_because("`,` or `}`", Some(help.to_owned()));
                return None;
            }
            let span = start.to(parser.previous_span());
            items.push(Item {
                docs,
                name,
                content: (),
                span,
            });
            Some(())
        });
    }

    /// A coordinate, or the rate of one, whose base is then `der(theta)`.
    pub(super) fn kept_start(&mut self) -> Option<Declared> {
        if !self.begins_rate() {
            return self.declared("the name of a coordinate");
        }
        let mut rate = self.rate_of()?;
        if !rate.base.text.is_empty() {
            rate.base.text = rate_name(&rate.base.text, "");
        }
        Some(rate)
    }

    /// Facts `left > right`, and `… for i in 1..N`.
    pub(super) fn assume(&mut self, facts: &mut Vec<Relation>) {
        let Some(group) = self.enter_section(SectionKind::Assume) else {
            return;
        };
        let close = group.close;
        self.list(
            group,
            |_| false,
            |parser| {
                parser.docs();
                if parser.at < close {
                    facts.extend(parser.relation());
                }
            },
        );
    }

    fn relation(&mut self) -> Option<Relation> {
        let left = self.expression();
        let operator = self.comparison()?;
        let right = self.expression();
        if self.is_mark('<') || self.is_mark('>') {
            let help = "write two facts: `0 < s, s < l`".to_owned();
            self.unexpected_because("`,`", Some(help));
        }
        let range = if self.eat_word("for") {
            self.range()
        } else {
            None
        };
        let span = left.span.to(self.previous_span());
        Some(Relation {
            left,
            operator,
            right,
            range,
            span,
        })
    }

    /// `>`, `>=`, `<` or `<=`
    fn comparison(&mut self) -> Option<Spanned<Comparison>> {
        let start = self.next_span();
        let strict = match self.peek().map(|word| word.kind) {
            Some(TokenKind::Punct('>')) => Comparison::Greater,
            Some(TokenKind::Punct('<')) => Comparison::Less,
            _ => {
                if !self.failed {
                    let help = "a fact is `s > 0`".to_owned();
                    self.unexpected_because("`>`, `>=`, `<` or `<=`", Some(help));
                }
                return None;
            }
        };
        let or_equal = self.peek().is_some_and(|word| word.joint)
            && self
                .peek_second()
                .is_some_and(|word| word.kind == TokenKind::Punct('='));
        self.at += 1 + usize::from(or_equal);
        let value = match (strict, or_equal) {
            (Comparison::Greater, true) => Comparison::GreaterOrEqual,
            (Comparison::Less, true) => Comparison::LessOrEqual,
            (strict, _) => strict,
        };
        let span = start.to(self.previous_span());
        Some(Spanned { value, span })
    }

    /// `published "title" { … }`, after its first word.
    pub(super) fn published(&mut self, spec: &mut Spec, heading: Span, docs: String) {
        let mut title = Spanned {
            value: String::new(),
            span: heading,
        };
        if let Some(word) = self.peek().filter(|word| word.kind == TokenKind::Text) {
            self.at += 1;
            title.value = word.text.to_owned();
            title.span = word.span;
        } else {
            let help = "state where it was published: `published \"Part I\" { … }`".to_owned();
            self.unexpected_because("a title in quotes", Some(help));
            // Continue without a title, but with the equations.
            self.failed = !self.is_open(Delimiter::Brace);
        }
        if self.failed {
            return;
        }
        let Some(group) = self.enter(Delimiter::Brace) else {
            return;
        };
        let close = group.close;
        let mut items = Vec::new();
        let begins = |parser: &Self| {
            let known = |word: Word| {
                PublishedKind::ALL
                    .iter()
                    .any(|kind| kind.as_str() == word.text)
            };
            parser.is(TokenKind::Doc) || parser.peek().is_some_and(known)
        };
        let span = self.list(group, begins, |parser| {
            let docs = parser.docs();
            if parser.at >= close {
                return parser.report_misplaced_docs();
            }
            items.extend(parser.published_item(docs));
        });
        let span = heading.to(span);
        spec.published.push(Published {
            docs,
            title,
            items,
            span,
        });
    }

    /// `force theta = …`, `equation s1: … = 0`
    fn published_item(&mut self, docs: String) -> Option<PublishedItem> {
        let word = self.ident("a quantity")?;
        let names = || PublishedKind::ALL.iter().map(|kind| kind.as_str());
        let kind = PublishedKind::ALL
            .iter()
            .find(|kind| kind.as_str() == word.text);
        let Some(&kind) = kind else {
            let message = format!("no quantity {} is derived", shown(&word.text));
            let mut unknown = Diagnostic::new(Code::UnknownQuantity, word.span, message);
            unknown.help = Some(match most_similar(&word.text, names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("these can be published: {}", one_of(names())),
            });
            self.fail(unknown);
            return None;
        };
        let of = match kind {
            PublishedKind::PotentialEnergy | PublishedKind::Dissipation => None,
            PublishedKind::KineticEnergy if !self.is(TokenKind::Ident) => None,
            PublishedKind::KineticEnergy | PublishedKind::Position | PublishedKind::Velocity => {
                Some(self.declared("the name of a body")?)
            }
            PublishedKind::Force | PublishedKind::Friction | PublishedKind::Equation => {
                Some(self.declared("the name of a coordinate")?)
            }
        };
        let statement = if kind == PublishedKind::Equation {
            self.expect_mark_not(':', '=', "an equation is `equation s1: left = right`");
            Statement::Equation(self.equation())
        } else {
            self.expect_mark_not('=', ':', "write `kinetic_energy = …`");
            Statement::Value(self.expression())
        };
        let span = word.span.to(self.previous_span());
        let kind = Spanned {
            value: kind,
            span: word.span,
        };
        Some(PublishedItem {
            docs,
            kind,
            of,
            statement,
            span,
        })
    }
}
