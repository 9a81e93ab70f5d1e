//! Assumptions, and published equations.

use lagrangian_symbolic::{Expr, nearest};

use super::Resolver;
use super::expression::unit_text;
use super::names::Namespace;
use super::text::show;
use super::value::{Scope, Vector, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    Assumption, PrintedFactor, PrintedTerm, Published, PublishedItem, PublishedQuantity, stage,
};
use crate::source::Span;
use crate::syntax::{
    self, Comparison, Declared, Equation, Expression, ExpressionKind, Index, PublishedKind, Range,
    Relation, SectionKind, Spec, Statement,
};
use crate::unit::Unit;

const VELOCITY: Unit = Unit::base(0, 1, -1);

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The assumptions of all layers.
    pub fn assumptions(&mut self, layers: &'a [Spec]) -> Vec<Assumption<'d>> {
        let mut assumptions = Vec::new();
        for relation in layers.iter().flat_map(|spec| &spec.assume) {
            for index in self.unrolled(relation.range.as_ref()) {
                let scope = Scope {
                    index: variable(relation.range.as_ref(), index),
                    limit: &limits::ASSUMPTION,
                    expected_unit: None,
                };
                assumptions.extend(
                    self.repeat_until_resolved(|resolver| resolver.assumption(relation, scope)),
                );
            }
        }
        assumptions
    }

    /// The indices of a range; a single "no index" if there is no range.
    pub fn unrolled(&mut self, range: Option<&'a Range>) -> Vec<Option<i64>> {
        let Some(range) = range else {
            return vec![None];
        };
        self.check_index_variable(range);
        match self.repeat_until_resolved(|resolver| resolver.range(range)) {
            Some(indices) => indices.map(Some).collect(),
            None => Vec::new(),
        }
    }

    fn assumption(&mut self, relation: &'a Relation, scope: Scope<'a>) -> Option<Assumption<'d>> {
        let ([left, right], _) = self.sides(&relation.left, &relation.right, scope)?;
        let (excess, strict) = match relation.operator.value {
            Comparison::Greater => (left - right, true),
            Comparison::GreaterOrEqual => (left - right, false),
            Comparison::Less => (right - left, true),
            Comparison::LessOrEqual => (right - left, false),
        };
        if excess.stage() == stage::CONSTANT && self.needs.is_empty() {
            let number = nearest(excess);
            if number < 0.0 || (strict && number == 0.0) {
                let message = "this never holds";
                self.error(Code::FalseAssumption, relation.span, message);
            }
        }
        let index = scope.index;
        Some(Assumption {
            text: format!(
                "{} {} {}",
                super::text::shown(&relation.left, index),
                sign(relation.operator.value),
                super::text::shown(&relation.right, index)
            ),
            excess,
            strict,
            span: relation.span,
        })
    }

    /// The published blocks of all layers; a block replaces an earlier one with the same title.
    pub fn published(&mut self, layers: &'a [Spec]) -> Vec<Published<'d>> {
        let mut blocks: Vec<&'a syntax::Published> = Vec::new();
        for spec in layers {
            let inherited = blocks.len();
            for block in &spec.published {
                let mut bases = blocks[..inherited].iter_mut();
                match bases.find(|base| base.title.value == block.title.value) {
                    Some(base) => *base = block,
                    None => blocks.push(block),
                }
            }
        }
        blocks
            .into_iter()
            .map(|block| self.published_block(block))
            .collect()
    }

    fn published_block(&mut self, block: &'a syntax::Published) -> Published<'d> {
        let mut items = Vec::new();
        for item in &block.items {
            let range = match item.of.as_ref().map(|of| &of.index) {
                Some(Index::Range(range)) => Some(range),
                _ => None,
            };
            for index in self.unrolled(range) {
                let scope = Scope {
                    index: variable(range, index),
                    limit: &limits::PUBLISHED,
                    expected_unit: None,
                };
                let found = self.repeat_until_resolved(|resolver| {
                    resolver.remarks = Some(Vec::new());
                    let found = resolver.published_item(item, index, scope);
                    let remarks = resolver.remarks.take().unwrap_or_default();
                    found.map(|found| PublishedItem { remarks, ..found })
                });
                items.extend(found);
            }
        }
        Published {
            title: block.title.value.clone(),
            items,
            span: block.span,
        }
    }

    fn published_item(
        &mut self,
        item: &'a syntax::PublishedItem,
        index: Option<i64>,
        scope: Scope<'a>,
    ) -> Option<PublishedItem<'d>> {
        let of = item.of.as_ref();
        let shown = of.map(|of| {
            let index = index.or(match &of.index {
                Index::One(one) => self.integer(one, Some(scope)),
                _ => None,
            });
            (of, index)
        });
        let text = match shown {
            Some((of, index)) => {
                format!(
                    "{} {}",
                    item.kind.value.as_str(),
                    show(&of.base.text, index)
                )
            }
            None => item.kind.value.as_str().to_owned(),
        };
        let (quantity, unit) = self.quantity_of(item.kind.value, item.kind.span, shown, scope)?;
        let printed = match (&item.statement, quantity) {
            (Statement::Value(value), PublishedQuantity::Velocity(_)) => {
                self.printed_vector(value, VELOCITY, "a velocity is in m/s", scope)?
            }
            (Statement::Value(value), PublishedQuantity::Position(_)) => {
                self.printed_vector(value, Unit::METRE, "a position is in m", scope)?
            }
            (Statement::Value(value), _) => {
                let reason = format!("it is in {}", unit_text(unit));
                vec![self.scalar_in(value, unit, &reason, scope)?.expr]
            }
            (Statement::Equation(equation), _) => {
                vec![self.difference(&equation.left, &equation.right, scope)?]
            }
        };
        // Every factor is evaluated once more; its units were already reported.
        let remarks = self.remarks.take();
        self.remarks = Some(Vec::new());
        let terms = self.printed_terms(&item.statement, printed.len(), scope);
        self.remarks = remarks;
        Some(PublishedItem {
            quantity,
            printed,
            terms: terms.unwrap_or_default(),
            text,
            remarks: Vec::new(),
            span: item.span,
        })
    }

    /// The terms of each component of a printed formula, as printed.
    fn printed_terms(
        &mut self,
        statement: &'a Statement,
        dimension: usize,
        scope: Scope<'a>,
    ) -> Option<Vec<Vec<PrintedTerm<'d>>>> {
        let mut components = Vec::new();
        match statement {
            Statement::Equation(Equation { left, right }) => {
                components.push(vec![(false, false, left), (true, true, right)]);
            }
            Statement::Value(value) => match &value.kind {
                ExpressionKind::Tuple(parts) => {
                    components.extend(parts.iter().map(|part| vec![(false, false, part)]));
                }
                _ if dimension == 1 => components.push(vec![(false, false, value)]),
                _ => return None,
            },
        }
        let mut all = Vec::new();
        for mut open in components {
            let mut terms = Vec::new();
            open.reverse();
            while let Some((negative, right, expression)) = open.pop() {
                match &expression.kind {
                    ExpressionKind::Sum(inner) => {
                        let inner = inner.iter().rev();
                        let term = |term: &'a syntax::Term| {
                            (negative != term.negative, right, &term.value)
                        };
                        open.extend(inner.map(term));
                    }
                    ExpressionKind::Negative(inner) => open.push((!negative, right, inner)),
                    _ => {
                        let term = self.printed_term(negative, expression, scope)?;
                        terms.push(PrintedTerm {
                            on_the_right: right,
                            ..term
                        });
                    }
                }
            }
            all.push(terms);
        }
        Some(all)
    }

    fn printed_term(
        &mut self,
        negative: bool,
        expression: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<PrintedTerm<'d>> {
        let factors: Vec<(bool, &'a Expression)> = match &expression.kind {
            ExpressionKind::Product(factors) => {
                let factors = factors.iter();
                factors
                    .map(|factor| (factor.divides, &factor.value))
                    .collect()
            }
            _ => vec![(false, expression)],
        };
        let mut negative = negative;
        let mut printed = Vec::new();
        for (divides, mut factor) in factors {
            // -a*b is a product whose first factor is -a.
            while let ExpressionKind::Negative(inner) = &factor.kind {
                (negative, factor) = (!negative, inner);
            }
            printed.push(PrintedFactor {
                text: super::text::shown_factor(factor, scope.index),
                divides,
                value: self.scalar(factor, scope)?.expr,
            });
        }
        Some(PrintedTerm {
            negative,
            on_the_right: false,
            factors: printed,
        })
    }

    fn printed_vector(
        &mut self,
        value: &'a Expression,
        unit: Unit,
        reason: &str,
        scope: Scope<'a>,
    ) -> Option<Vec<Expr<'d>>> {
        let Vector { components, .. } = self.vector_in(value, "a vector", unit, reason, scope)?;
        Some(components)
    }

    /// The quantity of a printed formula, and its unit.
    fn quantity_of(
        &mut self,
        kind: PublishedKind,
        span: Span,
        of: Option<(&'a Declared, Option<i64>)>,
        scope: Scope<'a>,
    ) -> Option<(PublishedQuantity, Unit)> {
        use PublishedQuantity as Quantity;
        match kind {
            PublishedKind::PotentialEnergy => Some((Quantity::PotentialEnergy, Unit::JOULE)),
            PublishedKind::Dissipation => Some((Quantity::Dissipation, Unit::WATT)),
            PublishedKind::KineticEnergy => {
                let body = match of {
                    Some(of) => Some(self.printed_body(of)?),
                    None => None,
                };
                Some((Quantity::KineticEnergy(body), Unit::JOULE))
            }
            PublishedKind::Velocity => {
                Some((Quantity::Velocity(self.printed_body(of?)?), VELOCITY))
            }
            PublishedKind::Position => {
                Some((Quantity::Position(self.printed_body(of?)?), Unit::METRE))
            }
            PublishedKind::Force | PublishedKind::Friction | PublishedKind::Equation => {
                let (name, index) = of?;
                let group = self.find_group(Namespace::Values, &name.base.text);
                let found = group.and_then(|group| self.groups[group].members.get(&index).copied());
                let coordinate = match found {
                    Some(member) => member,
                    // Not found: look it up once more, to report why.
                    None => self.coordinate_named(&name.base, index_of(name), scope)?,
                };
                let section = self.declaration(coordinate).section;
                let Some(ordinal) = self
                    .ordinal(coordinate)
                    .filter(|_| section == SectionKind::Coordinates)
                else {
                    let found = section.item();
                    let message = format!(
                        "a coordinate is expected here, and `{}` is {found}",
                        name.base.text
                    );
                    self.error(Code::WrongKind, name.base.span, message);
                    return None;
                };
                let unit = Unit::JOULE.over(self.unit_of(coordinate)?);
                Some(match kind {
                    PublishedKind::Force => (Quantity::Force(ordinal), unit),
                    PublishedKind::Friction => (Quantity::Friction(ordinal), unit),
                    _ => (Quantity::Equation(ordinal), unit),
                })
            }
        }
        .or_else(|| {
            if of.is_none() {
                let message = format!("`{}` needs the name of a coordinate or body", kind.as_str());
                self.push(Diagnostic::new(Code::MissingField, span, message));
            }
            None
        })
    }

    fn printed_body(&mut self, (name, index): (&'a Declared, Option<i64>)) -> Option<usize> {
        let group = self.known_group(Namespace::BODIES, "no body is", &name.base)?;
        let member = match self.groups[group].members.get(&index) {
            Some(&member) => member,
            None => {
                let scope = Scope {
                    index: None,
                    limit: &limits::PUBLISHED,
                    expected_unit: None,
                };
                self.member(group, &name.base, index_of(name), scope)?
            }
        };
        self.ordinal(member)
    }
}

fn sign(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Greater => ">",
        Comparison::GreaterOrEqual => ">=",
        Comparison::Less => "<",
        Comparison::LessOrEqual => "<=",
    }
}

/// The index variable of a family with its value.
pub(super) fn variable(range: Option<&Range>, index: Option<i64>) -> Option<(&str, i64)> {
    let variable = range?.variable.as_ref()?;
    Some((variable.text.as_str(), index?))
}

/// The index after a name, if there is one.
fn index_of(name: &Declared) -> Option<&Expression> {
    match &name.index {
        Index::One(index) => Some(index),
        Index::Range(range) => Some(&range.low),
        Index::None => None,
    }
}
