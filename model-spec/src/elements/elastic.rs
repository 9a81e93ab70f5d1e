//! The common parts of springs and dampers: a coefficient and a stretch.

use lagrangian_symbolic::Expr;

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

/// The limit of a stretch and a twist.
pub(super) static STRETCH: Limit = limit(stage::POSITION, "a stretch", POSITIONS);

/// An element with a term ½ c x² or ½ b ẋ² in an energy.
pub(super) struct Elastic {
    /// The field of the coefficient.
    pub coefficient: &'static str,
    /// The unit of the coefficient for a stretch in m.
    pub translational_unit: Unit,
    /// The unit of coefficient times stretch squared.
    pub energy_unit: Unit,
    /// The limit of the coefficient.
    pub limit: &'static Limit,
    /// The bound that it must obey.
    pub bound: BoundKind<'static>,
    /// Its drawing.
    pub shape: Shape,
}

/// A stretch, with its place in the spec.
struct Stretch<'d> {
    value: Scalar<'d>,
    span: Span,
    site: Site<'d>,
}

impl Elastic {
    /// The deformation of an item with a coefficient and either `stretch`, or `from` and `to`.
    pub fn resolve<'a, 'd>(
        &self,
        resolver: &mut Resolver<'a, 'd, '_>,
        member: MemberId,
    ) -> Option<(Deformation<'d>, Drawing<'d>)> {
        let record = resolver.record(member)?;
        let coefficient = resolver.field(member, record, self.coefficient);
        let coefficient = coefficient.map(|coefficient| {
            let scope = resolver
                .scope(member, self.limit)
                .with_expected_unit(self.translational_unit);
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

    /// Checks that the coefficient times the square of the stretch is an energy, or with rates a
    /// power. If it is not, the unit that is unusual for a spring or damper is reported.
    fn check_units<'d>(
        &self,
        resolver: &mut Resolver<'_, 'd, '_>,
        (coefficient, span): (&Scalar<'d>, Span),
        stretch: &Stretch<'d>,
    ) {
        let (Some(c), Some(x)) = (coefficient.unit, stretch.value.unit) else {
            return; // a bare number takes any unit
        };
        if c.times(x).times(x) == self.energy_unit {
            return;
        }
        let reason = format!(
            "`{}` is in {} for a stretch in m",
            self.coefficient, self.translational_unit
        );
        if c == self.translational_unit {
            resolver.require_unit(Some(x), Unit::METRE, stretch.span, &reason);
        } else {
            let expected = self.energy_unit.over(x.times(x));
            let expected = if x == Unit::METRE {
                self.translational_unit
            } else {
                expected
            };
            let diagnostic = resolver.unit_mismatch(c, expected, span, &reason);
            let note = format!("the stretch is in {}", unit_text(x));
            resolver.push(diagnostic.note(stretch.span, note));
        }
    }
}

/// `stretch`, or the distance of `from` and `to` minus the free `length`.
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
            let scope = resolver
                .scope(member, &STRETCH)
                .with_expected_unit(Unit::METRE);
            let value = resolver.scalar(stretch, scope)?;
            Some(Stretch {
                value,
                span: stretch.span,
                site: Site::Stretch(value.expr),
            })
        }
        (None, Some(from), Some(to)) => stretch_between(resolver, member, record, [from, to]),
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
fn stretch_between<'a, 'd>(
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
        expr: elongation(resolver, &line, length),
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

/// The distance between two points minus a free length: √(u·u), or an expression with that square
/// that is assumed to be nonnegative.
///
/// So the distance of the ends of a spring in polar coordinates is `r`, and that of two
/// points on a line `b − a`: no root remains, and no division by it in the force. The run
/// checks the assumption.
fn elongation<'d>(resolver: &Resolver<'_, 'd, '_>, line: &[Expr<'d>], free: Expr<'d>) -> Expr<'d> {
    let length = resolver.distance(line);
    // Added as one sum, so that a free length in it cancels.
    resolver.dag.sum(terms(length).into_iter().chain([-free]))
}
