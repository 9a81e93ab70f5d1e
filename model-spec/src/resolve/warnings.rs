//! Warnings about specs that are valid but perhaps unintended: names that nothing uses, and bodies without weight.

use lagrangian_symbolic::{Expr, evaluate};

use super::Resolver;
use super::names::Namespace;
use crate::diagnostic::{Code, Diagnostic};
use crate::identity;
use crate::model::element::{Contribution, Deformation, Energy, Load};
use crate::model::{Model, Space, stage};
use crate::syntax::{SectionKind, Spec};
use crate::unit::Unit;

/// The section that gives bodies their weight.
const GRAVITY: &str = "gravity";

/// The largest product of the numbers of bodies and coordinates that are examined: a larger machine
/// has gravity, or is a test of something else.
const MOST_PAIRS: usize = 4096;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Reports parameters, constants, inputs, definitions and frames that nothing uses. A name that
    /// begins with an underscore is unused on purpose.
    pub fn warn_about_unused(&mut self, layers: &'a [Spec]) {
        let has_gravity = layers.iter().any(|spec| spec.statement(GRAVITY).is_some());
        let mut unused = Vec::new();
        for (index, group) in self.groups.iter().enumerate() {
            let is_checked = matches!(group.namespace, Namespace::Values | Namespace::FRAMES);
            if !is_checked || self.used.contains(&index) || group.base.starts_with('_') {
                continue;
            }
            let Some(&member) = group.members.values().next() else {
                continue;
            };
            let declaration = self.declaration(member);
            if declaration.section != SectionKind::Coordinates {
                unused.push((group.base, declaration));
            }
        }
        for (base, declaration) in unused {
            let section = declaration.section;
            let message = format!("nothing uses {} `{base}`", item_with_article(section));
            let span = declaration.name.base.span;
            let diagnostic = Diagnostic::new(Code::Unused, span, message);
            let acceleration = Unit::METRE.rate().rate();
            let is_acceleration = match declaration.content {
                super::names::Content::Quantity(quantity) => {
                    super::names::declared_unit(quantity) == Some(acceleration)
                }
                _ => false,
            };
            self.push(diagnostic.help(if is_acceleration && !has_gravity {
                format!("is it gravity? write `gravity (0, -{base});`")
            } else if declaration.layer + 1 < self.layer_count {
                format!("remove it with `remove {section}.{base};`")
            } else {
                format!("if this is intended, call it `_{base}`")
            }));
        }
    }

    /// Reports a machine whose bodies hang or are carried by springs, but that has no gravity.
    pub fn warn_about_missing_gravity(&mut self, model: &Model<'d>, layers: &'a [Spec]) {
        let says = |spec: &Spec| {
            let mut removed = spec.remove.iter().map(|remove| remove.section.value);
            spec.statement(GRAVITY).is_some() || removed.any(|section| section.as_str() == GRAVITY)
        };
        // A potential or a force at a point may be the weight.
        let is_weight = |one: &Contribution<'_>| {
            matches!(
                one,
                Contribution::Stored(Energy::Given(_)) | Contribution::Load(Load::Point { .. })
            )
        };
        if layers.iter().any(says) || model.contributions().any(|(_, one)| is_weight(one)) {
            return;
        }
        let Some((span, what)) = hanging_body(model).or_else(|| body_on_springs(model)) else {
            return;
        };
        let message = format!("{what}, and the machine has no gravity");
        let diagnostic = Diagnostic::new(Code::NoGravity, span, message);
        let down = match model.space {
            Space::Plane => "gravity (0, -9.81);",
            Space::Space => "gravity (0, 0, -9.81);",
        };
        self.push(diagnostic.help(format!(
            "write `{down}`, or `gravity none;` if that is intended"
        )));
    }
}

/// An item of a section, with its article.
fn item_with_article(section: SectionKind) -> &'static str {
    match section {
        SectionKind::Parameters => "the parameter",
        SectionKind::Constants => "the constant",
        SectionKind::Inputs => "the input",
        SectionKind::Frames => "the frame",
        _ => "the definition",
    }
}

/// The height of a body and its horizontal coordinates.
fn height<'a, 'd>(at: &'a [Expr<'d>]) -> Option<(Expr<'d>, &'a [Expr<'d>])> {
    at.split_last().map(|(height, sides)| (*height, sides))
}

/// A body whose height is stationary where an angle is zero, and is not constant: it hangs or
/// stands there. A body that turns in a horizontal plane, with an angle measured from an axis, does
/// not do so.
fn hanging_body<'d>(model: &Model<'d>) -> Option<(crate::source::Span, String)> {
    if model.bodies.len() * model.coordinates.len() > MOST_PAIRS {
        return None;
    }
    for body in &model.bodies {
        let (height, _) = height(&body.at)?;
        for angle in model.coordinates.iter().filter(|q| q.unit.is_one()) {
            let symbol = angle.q.as_symbol();
            let Some(symbol) = symbol.filter(|&symbol| height.depends_on(symbol)) else {
                continue;
            };
            let slope = height.diff(symbol);
            let curvature = slope.diff(symbol);
            let stationary = (0..4).all(|point| {
                let value = |other| {
                    if other == symbol {
                        0.0
                    } else {
                        identity::sample_value(point, other)
                    }
                };
                let values = evaluate(model.dag, &[slope, curvature], value);
                values[0].abs() <= 1e-12 * values[1].abs()
            });
            if stationary {
                let subject = format!(
                    "the body `{}` hangs or stands at {} = 0",
                    body.name, angle.name
                );
                return Some((body.span, subject));
            }
        }
    }
    None
}

/// A machine whose bodies move only vertically, carried by springs.
fn body_on_springs(model: &Model<'_>) -> Option<(crate::source::Span, String)> {
    let moves = |e: Expr<'_>| e.stage() >= stage::POSITION;
    let mut bodies = model.bodies.iter();
    let rests = bodies.all(|body| {
        height(&body.at).is_some_and(|(_, sides)| !sides.iter().any(|&side| moves(side)))
    });
    let mut bodies = model.bodies.iter();
    let body = bodies.find(|body| height(&body.at).is_some_and(|(height, _)| moves(height)))?;
    let carries = |one: &Contribution<'_>| {
        let length = |of: &Deformation<'_>| !of.torsional;
        matches!(one, Contribution::Stored(Energy::Quadratic(of)) if length(of))
    };
    let (element, _) = model.contributions().find(|(_, one)| carries(one))?;
    let subject = format!(
        "the {} `{}` carries the body `{}`",
        element.section.noun, element.name, body.name
    );
    rests.then_some((body.span, subject))
}
