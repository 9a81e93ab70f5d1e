//! What springs and dampers have in common: a coefficient, and what it stretches.

use lagrangian_symbolic::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::circles::terms;
use crate::model::element::{Deformation, Drawing, Shape, Site};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::expression::unit_text;
use crate::resolve::value::{Limit, MemberId, POSITIONS, Scalar, limit};
use crate::source::Span;
use crate::syntax::{Expression, Record};
use crate::unit::Unit;

/// What a stretch and a twist may depend on.
pub(super) static STRETCH: Limit = limit(stage::POSITION, "a stretch", POSITIONS);

/// The share of an element in an energy: ½ c x² or ½ b ẋ².
pub(super) struct Elastic {
    /// The field of the coefficient.
    pub coefficient: &'static str,
    /// The unit of the coefficient for a stretch in m.
    pub linear: Unit,
    /// The unit of coefficient times stretch squared.
    pub product: Unit,
    /// What the coefficient may depend on.
    pub limit: &'static Limit,
    /// What it has to obey.
    pub bound: BoundKind<'static>,
    /// What is drawn.
    pub shape: Shape,
}

/// A stretch, where it was read.
struct Stretch<'d> {
    value: Scalar<'d>,
    span: Span,
    site: Site<'d>,
}

impl Elastic {
    /// What an item with a coefficient, and `stretch` or `from` and `to`, deforms.
    pub fn resolve<'a, 'd>(
        &self,
        resolver: &mut Resolver<'a, 'd, '_>,
        member: MemberId,
    ) -> Option<(Deformation<'d>, Drawing<'d>)> {
        let record = resolver.record(member)?;
        let coefficient = resolver.field(member, record, self.coefficient);
        let coefficient = coefficient.map(|coefficient| {
            let scope = resolver.scope(member, self.limit).hinting(self.linear);
            (resolver.scalar(coefficient, scope), coefficient.span)
        });
        let stretch = stretch(resolver, member, record)?;
        let (coefficient, span) = coefficient?;
        let coefficient = coefficient?;
        self.check_units(resolver, (&coefficient, span), &stretch);
        resolver.bound(self.bound, coefficient.expr, span);
        let deformation = Deformation {
            coefficient: coefficient.expr,
            measure: stretch.value.expr,
            torsional: false,
        };
        let drawing = Drawing {
            shape: self.shape,
            site: stretch.site,
        };
        Some((deformation, drawing))
    }

    /// Coefficient times stretch squared is an energy, or a power over the rates. If it is not, the
    /// one that is unlike any spring or damper is wrong.
    fn check_units<'d>(
        &self,
        resolver: &mut Resolver<'_, 'd, '_>,
        (coefficient, span): (&Scalar<'d>, Span),
        stretch: &Stretch<'d>,
    ) {
        let (Some(c), Some(x)) = (coefficient.unit, stretch.value.unit) else {
            return; // a bare number takes any unit
        };
        if c.times(x).times(x) == self.product {
            return;
        }
        let why = format!(
            "`{}` is in {} for a stretch in m",
            self.coefficient, self.linear
        );
        if c == self.linear {
            resolver.demand(Some(x), Unit::METRE, stretch.span, &why);
        } else {
            let expected = self.product.over(x.times(x));
            let expected = if x == Unit::METRE {
                self.linear
            } else {
                expected
            };
            let message = format!("expected {}, found {}", unit_text(expected), unit_text(c));
            let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
            let note = format!("the stretch is in {}", unit_text(x));
            resolver.push(diagnostic.help(why).note(stretch.span, note));
        }
    }
}

/// `stretch`, or the distance of `from` and `to` less the free `length`.
fn stretch<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
) -> Option<Stretch<'d>> {
    match (record.get("stretch"), record.get("from"), record.get("to")) {
        (Some(stretch), ..) => {
            for field in ["from", "to", "length"] {
                resolver.conflict(record, field, "stretch");
            }
            let scope = resolver.scope(member, &STRETCH).hinting(Unit::METRE);
            let value = resolver.scalar(stretch, scope)?;
            Some(Stretch {
                value,
                span: stretch.span,
                site: Site::Stretch(value.expr),
            })
        }
        (None, Some(from), Some(to)) => between(resolver, member, record, [from, to]),
        (None, from, to) => {
            let base = resolver.base_name(member);
            let message = match (from, to) {
                (Some(_), None) => format!("`{base}` has a `from` and no `to`"),
                (None, Some(_)) => format!("`{base}` has a `to` and no `from`"),
                _ => {
                    let item = resolver.item(member);
                    format!("{item} needs `stretch`, or `from` and `to`; `{base}` has neither")
                }
            };
            resolver.missing_field(member, message);
            None
        }
    }
}

/// The stretch between two points.
fn between<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    ends: [&'a Expression; 2],
) -> Option<Stretch<'d>> {
    let span = ends[0].span.to(ends[1].span);
    let [from, to] = ends.map(|end| resolver.point(member, end));
    let length = free_length(resolver, member, record);
    let (from, to, length) = (from?, to?, length?);
    let line: Vec<Expr<'d>> = to.iter().zip(&from).map(|(&to, &from)| to - from).collect();
    let value = Scalar {
        expr: distance_less(resolver, &line, length),
        unit: Some(Unit::METRE),
        number: None,
    };
    Some(Stretch {
        value,
        span,
        site: Site::Between([from, to]),
    })
}

/// The free length of a spring between two points: zero if it is not given.
fn free_length<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
) -> Option<Expr<'d>> {
    let Some(length) = record.get("length") else {
        return Some(resolver.dag.zero());
    };
    let scope = resolver.scope(member, &STRETCH);
    let length = resolver.scalar_in(length, Unit::METRE, "a length is in m", scope)?;
    Some(length.expr)
}

/// How far apart two points are, less a free length: √(u·u), or what is assumed not to be negative
/// and has that square.
///
/// So the ends of a spring in polar coordinates are `r` apart, and points of one line `b − a`: no
/// root is left, and no quotient by it in the force. The run checks what is assumed.
fn distance_less<'d>(
    resolver: &Resolver<'_, 'd, '_>,
    line: &[Expr<'d>],
    free: Expr<'d>,
) -> Expr<'d> {
    let length = resolver.distance(line);
    // Added up as one sum, so that a free length in it cancels.
    resolver.dag.sum(terms(length).into_iter().chain([-free]))
}
