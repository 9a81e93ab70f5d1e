//! Refuses machines that depend on the length of a quaternion that turns a frame.
//!
//! The length has an equation of motion of its own, (E74) and (E75), which is not part of the machine: everything that carries inertia,
//! acts or constrains must be the same for every multiple of the quaternion. This holds for everything built on frames. A formula that
//! contains the four numbers themselves need not satisfy it, and the machine would do work on a length that no body has. So it is
//! tested in the prime field: the derivative of positions along `δe = e`, and of expressions in rates along `δė = e`, must be 0. An
//! expression that only gives the magnitude of a load may contain the numbers, because the power of the load is that of positions.

use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::{Contribution, Energy, Load};
use lagrangian_spec::model::{ContactGeometry, Model, PoseChange, Rotation, stage};
use lagrangian_spec::source::Span;
use lagrangian_spec::syntax::SectionKind;
use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::Variables;

/// Refuses dependence on the lengths of quaternions, and approximations in a machine that has any. Returns true if
/// anything is refused.
pub(super) fn report_dependence_on_lengths(model: &Model<'_>, report: &mut Report) -> bool {
    let Some(first) = model.quaternions.first() else {
        return false;
    };
    let mut refused = false;
    if !model.approximations.is_empty() {
        let span = model
            .section(SectionKind::Approximations)
            .unwrap_or(first.span);
        let message = "`approximations` of a machine with a frame turned by a quaternion cannot be derived yet";
        let help = "turn the frame by angles, which may be small, or leave `approximations` out";
        report.push(Diagnostic::new(Code::NotSupported, span, message).help(help));
        refused = true;
    }
    let x = Variables::of(model);
    for four in &model.quaternions {
        let places = four.coordinates(model);
        let along = |symbols: &[lagrangian_symbolic::Symbol]| {
            let pairs = places.iter().zip(four.e).map(|(&i, e)| (symbols[i], e));
            Tangent::new(model.dag, &pairs.collect::<Vec<_>>())
        };
        let mut longer = LengthVariation {
            positions: along(&x.q),
            rates: along(&x.v),
        };
        let name = &model.coordinates[places[0]].name;
        for (what, span) in longer.dependent_expressions(model, &places) {
            let message =
                format!("{what} depends on the length of the quaternion that begins with `{name}`");
            let help = "a quaternion turns a frame, and its length has no meaning: express this by the frame, its `point`, `vector` or `spin`";
            let diagnostic = Diagnostic::new(Code::ForbiddenDependence, span, message);
            let note = "the quaternion turns a frame here";
            report.push(diagnostic.note(four.span, note).help(help));
            refused = true;
        }
    }
    refused
}

/// Variations of expressions if a quaternion becomes longer.
struct LengthVariation<'d> {
    positions: Tangent<'d>,
    /// The variation if its rates grow along it.
    rates: Tangent<'d>,
}

impl<'d> LengthVariation<'d> {
    fn depends_on_length(&mut self, e: Expr<'d>) -> bool {
        identity::is_zero(self.positions.of(e)) == Some(false)
    }

    fn depends_on_length_rate(&mut self, e: Expr<'d>) -> bool {
        identity::is_zero(self.rates.of(e)) == Some(false)
    }

    /// The expressions that depend on the length, with their spans in the spec.
    fn dependent_expressions(
        &mut self,
        model: &Model<'d>,
        four: &[usize; 4],
    ) -> Vec<(String, Span)> {
        let mut found = Vec::new();
        for (index, pose) in model.poses.iter().enumerate() {
            let moves = match &pose.step {
                PoseChange::Ground | PoseChange::Quaternion(_) => false,
                PoseChange::Shift(by) => by.iter().any(|&x| self.depends_on_length(x)),
                PoseChange::Turn { angle, .. } => self.depends_on_length(*angle),
            };
            if !moves {
                continue;
            }
            let mut frames = model.frames.iter();
            let frame = frames.find(|frame| frame.pose.index() >= index);
            found.push(match frame {
                Some(frame) => (format!("the frame `{}`", frame.name), frame.span),
                None => ("a frame".to_owned(), model.span),
            });
        }
        if !found.is_empty() {
            // Everything built on such a frame depends on the length too.
            return found;
        }
        for body in &model.bodies {
            let turns = match body.rotation {
                Rotation::Angle(angle) => self.depends_on_length(angle),
                Rotation::Frame(_) | Rotation::Unspecified => false,
            };
            if turns || body.at.iter().any(|&x| self.depends_on_length(x)) {
                found.push((
                    format!("the pose of the body `{}`", body.name),
                    body.position_span,
                ));
            }
        }
        for (element, contribution) in model.contributions() {
            if self.works_on_length(contribution, four) {
                let item = element.section.item;
                let noun = item.split_once(' ').map_or(item, |(_article, noun)| noun);
                found.push((format!("the {noun} `{}`", element.name), element.span));
            }
        }
        for circle in &model.circles {
            if circle.center.iter().any(|&x| self.depends_on_length(x)) {
                found.push((format!("the position of `{}`", circle.name), circle.span));
            }
        }
        for contact in &model.contacts {
            let moves = match &contact.geometry {
                // Polygons exist only in the plane, where no quaternion turns anything.
                ContactGeometry::Circles(_) | ContactGeometry::Corner(_) => false,
                ContactGeometry::Point { point, .. } => {
                    point.center.iter().any(|&x| self.depends_on_length(x))
                }
                ContactGeometry::Expressions { gap, slip, across } => {
                    let slips = [Some(*slip), *across];
                    self.depends_on_length(*gap)
                        || slips
                            .into_iter()
                            .flatten()
                            .any(|x| self.depends_on_length_rate(x))
                }
            };
            if moves {
                found.push((format!("the contact `{}`", contact.name), contact.span));
            }
        }
        found
    }

    /// Whether a contribution would do work on the length.
    fn works_on_length(&mut self, contribution: &Contribution<'d>, four: &[usize; 4]) -> bool {
        match contribution {
            Contribution::Stored(Energy::Quadratic(of)) => {
                self.depends_on_length(of.measure) || self.depends_on_length(of.coefficient)
            }
            Contribution::Stored(Energy::Given(energy)) => self.depends_on_length(*energy),
            Contribution::Dissipated(Energy::Quadratic(of)) => {
                self.depends_on_length(of.measure) || self.depends_on_length_rate(of.coefficient)
            }
            Contribution::Dissipated(Energy::Given(power)) => self.depends_on_length_rate(*power),
            Contribution::Load(Load::Point { at, .. }) => {
                at.iter().any(|&x| self.depends_on_length(x))
            }
            Contribution::Load(Load::Along { measure, .. }) => self.depends_on_length(*measure),
            Contribution::Load(Load::Coordinate { coordinate, .. }) => four.contains(coordinate),
            Contribution::Constraint(constraint) => {
                let expression = constraint.expression;
                if expression.stage() > stage::POSITION {
                    self.depends_on_length_rate(expression)
                } else {
                    self.depends_on_length(expression)
                }
            }
            // These act on frames and bodies, or are not part of the equations of motion.
            Contribution::Load(Load::Torque { .. })
            | Contribution::Gravity(_)
            | Contribution::Rolling(_)
            | Contribution::Sliding(_)
            | Contribution::StateEnergy(_)
            | Contribution::PowerLoss(_) => false,
        }
    }
}
