//! Tests that elements written in coordinates act along the guides alone.

use lagrangian_spec::diagnostic::{Code, Diagnostic};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::{Contribution, Element, Energy, Load};
use lagrangian_spec::model::{Contact, ContactGeometry, Model};
use lagrangian_spec::source::Span;
use lagrangian_symbolic::{Expr, Node, Symbol};

use super::numbers::{Value, dot};
use super::{DisplacementAlongGuide, GuideDisplacements, PartVelocities, Relaxed};
use crate::equations::constraints::{self, ConstraintEquation};

/// The result of testing a force: nothing if it has no value, otherwise the error in it, if any.
type TestResult = Option<Option<Diagnostic>>;

/// The terms of a sum; an expression that is not a sum is its only term.
fn addends(value: Expr<'_>) -> Vec<Expr<'_>> {
    match value.node() {
        Node::Sum(terms) => terms.iter().map(|(id, _)| value.dag().expr(*id)).collect(),
        _ => vec![value],
    }
}

/// Tests what is written in coordinates against the motion along the guides.
pub(super) struct CoordinateTests<'s, 'm, 'd> {
    pub(super) motion: &'s PartVelocities,
    pub(super) relaxed: &'s Relaxed<'m, 'd>,
    pub(super) model: &'m Model<'d>,
    pub(super) displacements: &'s [(usize, DisplacementAlongGuide)],
    /// The guides along which (E38) also holds if the guides are displaced.
    pub(super) displaceable: Vec<usize>,
}

impl<'d> CoordinateTests<'_, '_, 'd> {
    /// The errors in everything that has values at this point and was not tested before.
    pub(super) fn errors(&self, tested: &mut Vec<bool>) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let mut number = 0;
        let mut test = |refused: &dyn Fn() -> TestResult| {
            if tested.len() <= number {
                tested.push(false);
            }
            if !tested[number]
                && let Some(refused) = refused()
            {
                tested[number] = true;
                found.extend(refused);
            }
            number += 1;
        };
        let relaxed = self.relaxed.model;
        let equations = constraints::constraints(relaxed);
        for (equation, span) in equations.iter().zip(constraints::spans(self.model)) {
            test(&|| self.constraint(equation, span));
        }
        for (element, one) in relaxed.contributions() {
            self.test_element(element, one, &mut test);
        }
        for contact in &relaxed.contacts {
            self.test_contact(contact, &mut test);
        }
        found
    }

    /// Tests what an element contributes other than constraints.
    fn test_element(
        &self,
        element: &Element<'d>,
        contribution: &Contribution<'d>,
        test: &mut impl FnMut(&dyn Fn() -> TestResult),
    ) {
        let Element { name, span, .. } = element;
        let by_place = &self.relaxed.x.q;
        let owner = format!("the {} `{name}`", element.section.noun);
        let mut acting = |expression, by, subject: &str| {
            test(&|| self.force_of_expression((expression, by), subject, *span));
        };
        match contribution {
            Contribution::Stored(Energy::Quadratic(of))
            | Contribution::Dissipated(Energy::Quadratic(of)) => {
                if of.torsional {
                    acting(of.measure, by_place, &format!("the twist of `{name}`"))
                } else {
                    let subject = format!("the stretch of {owner}");
                    test(&|| self.stretch(of.measure, &subject, *span));
                }
            }
            Contribution::Stored(Energy::Given(value)) => {
                let parts = addends(*value).into_iter();
                parts.for_each(|part| acting(part, by_place, &owner));
            }
            Contribution::Dissipated(Energy::Given(value)) => {
                let parts = addends(*value).into_iter();
                parts.for_each(|part| acting(part, &self.relaxed.x.v, &owner));
            }
            Contribution::Load(Load::Point { at, force }) => {
                test(&|| self.force_at_point(&owner, (at, force), *span));
            }
            Contribution::Load(Load::Coordinate { coordinate, .. }) => {
                let on = self.relaxed.model.coordinates[*coordinate].q;
                acting(on, by_place, &owner);
            }
            Contribution::Load(Load::Along {
                measure, torsional, ..
            }) => {
                if *torsional {
                    acting(*measure, by_place, &owner)
                } else {
                    test(&|| self.stretch(*measure, &owner, *span))
                }
            }
            // A torque acts on a body that is known to turn; the others act on bodies directly.
            Contribution::Load(Load::Torque { .. })
            | Contribution::Gravity(_)
            | Contribution::Constraint(_)
            | Contribution::Rolling(_)
            | Contribution::StateEnergy(_)
            | Contribution::PowerLoss(_)
            | Contribution::Sliding(_) => {}
        }
    }

    /// Tests a contact that is given by expressions: its normal force acts like that of a stretch, and its friction like one between rates.
    fn test_contact(&self, contact: &Contact<'d>, test: &mut impl FnMut(&dyn Fn() -> TestResult)) {
        let ContactGeometry::Expressions { gap, slip, .. } = &contact.geometry else {
            return;
        };
        let Contact { name, span, .. } = contact;
        test(&|| self.stretch(*gap, &format!("the gap of the contact `{name}`"), *span));
        if contact.friction.is_some() {
            let subject = format!("the slip of the contact `{name}`");
            test(&|| self.force_of_expression((*slip, &self.relaxed.x.v), &subject, *span));
        }
    }

    fn is_zero(&self, x: Value) -> bool {
        x.size_relative_to(1.0) == 0.0
    }

    /// The derivatives of an expression with respect to all columns, with the guides at zero; nothing if
    /// it has none.
    fn derivatives(&self, expression: Expr<'d>, by: &[Symbol]) -> Option<Vec<Value>> {
        self.derivatives_at(GuideDisplacements::Zero, expression, by)
    }

    fn derivatives_at(
        &self,
        guides: GuideDisplacements,
        expression: Expr<'d>,
        by: &[Symbol],
    ) -> Option<Vec<Value>> {
        let of = |list: Vec<Value>| list[0];
        let point = (self.motion.point, guides);
        let columns = self.relaxed.derivatives(point, &[expression], by);
        let slopes: Vec<Value> = columns.into_iter().map(of).collect();
        slopes.iter().all(|x| x.is_finite()).then_some(slopes)
    }

    /// The guides along which an expression does not change as the bodies do, with the difference.
    fn mismatches<'w>(&'w self, slopes: &'w [Value]) -> impl Iterator<Item = (usize, Value)> + 'w {
        self.displacements.iter().filter_map(|(guide, along)| {
            let mismatch = along.mismatch(slopes.iter().copied());
            (!self.is_zero(mismatch)).then_some((*guide, mismatch))
        })
    }

    /// The first guide along which the force of an expression does not change as the bodies do and
    /// acts across it on what is carried, or for which `undetermined` holds of its change along the guide.
    fn first_undetermined(
        &self,
        expression: Expr<'d>,
        by: &[Symbol],
        undetermined: impl Fn(&[Value], usize, Value) -> bool,
    ) -> Option<Option<usize>> {
        let slopes = self.derivatives(expression, by)?;
        let on_bodies = &slopes[self.motion.coordinates..];
        let depends_on_bodies = on_bodies.iter().any(|&pull| !self.is_zero(pull));
        let mut otherwise: Vec<usize> = Vec::new();
        if depends_on_bodies {
            let displaced = self.derivatives_at(GuideDisplacements::Arbitrary, expression, by)?;
            otherwise.extend(self.mismatches(&slopes).map(|(guide, _)| guide));
            let mismatch = self.mismatches(&displaced).map(|(guide, _)| guide);
            otherwise.extend(mismatch.filter(|guide| self.displaceable.contains(guide)));
        }
        let pulls_across = |&guide: &usize| {
            let mut pulls = on_bodies.chunks_exact(self.motion.dimension).enumerate();
            pulls.any(|(other, pull)| {
                if other == self.motion.guide_of_contact[guide] {
                    self.motion.is_across(guide, pull)
                } else {
                    pull.iter().any(|&pull| !self.is_zero(pull))
                }
            })
        };
        let across = otherwise.into_iter().find(pulls_across);
        Some(across.or_else(|| {
            let mut mismatch = self.mismatches(&slopes);
            let found = mismatch.find(|&(guide, mismatch)| undetermined(&slopes, guide, mismatch));
            found.map(|(guide, _)| guide)
        }))
    }

    fn diagnostic(&self, guide: usize, span: Span, subject: &str, help: &str) -> Diagnostic {
        let sliding = self.model.sliding()[guide];
        let body = &self.model.bodies[sliding.body].name;
        let message = format!(
            "{subject} moves with `{body}` but is not expressed by the position of `{body}`: its force across the guide `{}` is not determined",
            sliding.name_in_spec()
        );
        let diagnostic = Diagnostic::new(Code::Untied, span, message);
        diagnostic.help(help).note(sliding.span, "this guide")
    }

    /// Tests a constraint in coordinates. With constant coefficients it is a rope or a gear; with
    /// varying ones it is the geometry of something that pulls in a direction.
    fn constraint(&self, equation: &ConstraintEquation<'d>, span: Span) -> TestResult {
        let x = &self.relaxed.x;
        let slopes = match equation.position {
            Some(position) => self.derivatives(position, &x.q),
            None => self.derivatives(equation.rate, &x.v),
        }?;
        let Some((guide, _)) = self.mismatches(&slopes).next() else {
            return Some(None);
        };
        let mut entries = equation.row.iter().filter(|entry| !entry.is_zero());
        let Some(&first) = entries.next() else {
            return Some(None);
        };
        let is_constant = |&entry: &Expr<'d>| identity::is_free_of_motion(entry / first);
        if entries.all(is_constant) {
            return Some(None);
        }
        let subject = format!("the constraint `{}`", equation.name);
        let help = "express it by positions of bodies, such as `norm(a.at - b.at) = l`";
        Some(Some(self.diagnostic(guide, span, &subject, help)))
    }

    /// Tests a stretch in coordinates: along a spring that lies along the guide it grows by a metre
    /// for each metre of displacement.
    fn stretch(&self, stretch: Expr<'d>, subject: &str, span: Span) -> TestResult {
        let across =
            self.first_undetermined(stretch, &self.relaxed.x.q, |_, guide, mismatch| {
                let e = &self.motion.directions[guide];
                !self.is_zero(mismatch * mismatch - dot(e, e))
            })?;
        let help = "give it `from` and `to`, points of bodies; or, if it acts only along the guide, give its energy under `potentials`";
        Some(across.map(|guide| self.diagnostic(guide, span, subject, help)))
    }

    /// Tests a force that is the derivative of an expression: an energy, a dissipation by its rates, or a
    /// coordinate on which a force acts. Written in coordinates it acts along the guides, and must act on
    /// what the guide carries directly, not through something else. A force between a body and a place in
    /// coordinates pulls on that place too, and what holds the place across the guide is unknown.
    fn force_of_expression(
        &self,
        (expression, by): (Expr<'d>, &[Symbol]),
        subject: &str,
        span: Span,
    ) -> TestResult {
        let undetermined = self.first_undetermined(expression, by, |slopes, guide, _| {
            let along = self.displacements.iter().find(|(k, _)| *k == guide);
            let forces = &slopes[..self.motion.coordinates];
            along.is_some_and(|(_, along)| self.motion.is_undetermined(guide, along, forces))
        })?;
        let help = "express it by positions of bodies; or build one body on the frame of the other, so that the guide carries what acts between them";
        Some(undetermined.map(|guide| self.diagnostic(guide, span, subject, help)))
    }

    /// Tests a force at a point in coordinates, which must act along the guide.
    fn force_at_point(
        &self,
        subject: &str,
        (at, value): (&[Expr<'d>], &[Expr<'d>]),
        span: Span,
    ) -> TestResult {
        let slopes: Vec<Vec<Value>> = at
            .iter()
            .map(|&x| self.derivatives(x, &self.relaxed.x.q))
            .collect::<Option<_>>()?;
        let at = (self.motion.point, GuideDisplacements::Zero);
        let value = self.relaxed.values(at, value);
        if !value.iter().all(|x| x.is_finite()) {
            return None;
        }
        let across = self.displacements.iter().find(|(guide, along)| {
            let moves = slopes
                .iter()
                .any(|slopes| !self.is_zero(along.mismatch(slopes.iter().copied())));
            moves && self.motion.is_across(*guide, &value)
        });
        let subject = format!("the point of {subject}");
        let help =
            "express it by the position of the body, such as `body.at`, or by a point of its frame";
        Some(across.map(|(guide, _)| self.diagnostic(*guide, span, &subject, help)))
    }
}
