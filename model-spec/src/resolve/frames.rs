//! Frames of reference: how each is made from its parent, and the points that it provides.
//!
//! A pose is built on the expressions of its parent, never on their expansion: in a chain of links
//! each origin is one term in the next, and each angle one term in the next angle.

use lagrangian_symbolic::sorting::sort_by;
use lagrangian_symbolic::{Expr, Id};

use super::Resolver;
use super::names::{Content, Namespace, suggestion, with_help};
use super::text;
use super::value::{MemberId, Scope, Value, Vector, limits};
use super::work::{Need, State};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::quaternion::{self, Quaternion};
use crate::model::{Coordinate, Pose, PoseChange, PoseId, Space, stage};
use crate::source::Span;
use crate::syntax::{Chain, Expression, ExpressionKind, Link, Reference, SectionKind};
use crate::unit::Unit;

/// The operations and points of a frame.
const FRAME_MEMBERS: [&str; 8] = [
    "origin",
    "point",
    "vector",
    "shift",
    "turn",
    "with_origin",
    "spin",
    "velocity",
];

/// The members of a body that is turned by an angle and has no frame.
const BODY_MEMBERS: [&str; 3] = ["at", "spin", "velocity"];

/// The largest number of points that a help line lists.
const LISTED: usize = 8;

/// The largest number of names that are searched for points.
const COMPARED: usize = 1000;

/// The parent, step and arguments of a pose, so that equal poses are made only once.
pub(super) type PoseKey = (PoseId, Option<usize>, Vec<Id>);

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The ground: origin 0, axes along itself.
    pub fn ground(&self) -> Pose<'d> {
        let n = self.space.dimension();
        let unit = |k: usize, i: usize| {
            if k == i {
                self.dag.one()
            } else {
                self.dag.zero()
            }
        };
        Pose {
            parent: PoseId::GROUND,
            step: PoseChange::Ground,
            origin: vec![self.dag.zero(); n],
            axes: (0..n)
                .map(|k| (0..n).map(|i| unit(k, i)).collect())
                .collect(),
            angle: self.dag.zero(),
        }
    }

    /// An existing pose.
    pub fn pose(&self, id: PoseId) -> &Pose<'d> {
        &self.poses[id.0 as usize]
    }

    fn add_pose(&mut self, key: PoseKey, make: impl FnOnce(&Self) -> Pose<'d>) -> PoseId {
        if let Some(&known) = self.pose_of.get(&key) {
            return known;
        }
        let mut pose = make(self);
        // There are fewer poses than steps of evaluation, which are limited.
        let id = PoseId(u32::try_from(self.poses.len()).unwrap_or(u32::MAX));
        self.relax_pose(id, &mut pose);
        self.poses.push(pose);
        self.pose_of.insert(key, id);
        id
    }

    /// The origin of a frame.
    pub fn origin(&self, frame: PoseId) -> Vector<'d> {
        Vector {
            components: self.pose(frame).origin.clone(),
            unit: Some(Unit::METRE),
            local: Some((frame, vec![self.dag.zero(); self.space.dimension()])),
        }
    }

    /// The frame whose origin is shifted in the axes of its parent.
    fn shifted(&mut self, parent: PoseId, by: Vec<Expr<'d>>) -> PoseId {
        let key = (parent, None, by.iter().map(|c| c.id()).collect());
        self.add_pose(key, |resolver| Pose {
            parent,
            origin: resolver.point_of(parent, &by),
            axes: resolver.pose(parent).axes.clone(),
            angle: resolver.pose(parent).angle,
            step: PoseChange::Shift(by),
        })
    }

    /// The frame that is turned about one of its axes.
    fn rotated(&mut self, parent: PoseId, axis: usize, angle: Expr<'d>) -> PoseId {
        let key = (parent, Some(axis), vec![angle.id()]);
        self.add_pose(key, |resolver| {
            let from = resolver.pose(parent);
            let (axes, total) = match resolver.space {
                // From the sum of all turns, so that a chain of turns has one sine for each link.
                Space::Plane => {
                    let total = from.angle + angle;
                    let (c, s) = (total.cos(), total.sin());
                    (vec![vec![c, s], vec![-s, c]], total)
                }
                Space::Space => {
                    // The two axes after that of the turn, in cyclic order: y, z after x.
                    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
                    let (c, s) = (angle.cos(), angle.sin());
                    let mut axes = from.axes.clone();
                    let pairs = from.axes[i].iter().zip(&from.axes[j]);
                    (axes[i], axes[j]) =
                        pairs.map(|(&x, &y)| (x * c + y * s, y * c - x * s)).unzip();
                    (axes, from.angle)
                }
            };
            Pose {
                parent,
                step: PoseChange::Turn { axis, angle },
                origin: from.origin.clone(),
                axes,
                angle: total,
            }
        })
    }

    /// The frame that is turned by a quaternion.
    fn turned_by_quaternion(&mut self, parent: PoseId, e: [Expr<'d>; 4]) -> PoseId {
        // A number beyond those of the three axes.
        let key = (parent, Some(3), e.map(|e| e.id()).to_vec());
        self.add_pose(key, |resolver| {
            let from = resolver.pose(parent);
            let axes = quaternion::axes(&e);
            Pose {
                parent,
                step: PoseChange::Quaternion(e),
                origin: from.origin.clone(),
                axes: (axes.iter().map(|axis| resolver.vector_of(parent, axis))).collect(),
                angle: from.angle,
            }
        })
    }

    /// The vector with these components in the axes of a frame, in ground axes.
    pub(super) fn vector_of(&self, frame: PoseId, components: &[Expr<'d>]) -> Vec<Expr<'d>> {
        let axes = &self.pose(frame).axes;
        let along = |i: usize| {
            let terms = axes.iter().zip(components);
            self.dag
                .sum(terms.map(|(axis, &component)| component * axis[i]))
        };
        (0..self.space.dimension()).map(along).collect()
    }

    /// The point with these coordinates in a frame: its origin, and the vector to the point.
    fn point_of(&self, frame: PoseId, coordinates: &[Expr<'d>]) -> Vec<Expr<'d>> {
        let Pose { origin, axes, .. } = self.pose(frame);
        let along = |i: usize| {
            let terms = axes.iter().zip(coordinates);
            let vector = terms.map(|(axis, &coordinate)| coordinate * axis[i]);
            self.dag.sum(std::iter::once(origin[i]).chain(vector))
        };
        (0..self.space.dimension()).map(along).collect()
    }

    /// A frame, or an error that says what was found instead.
    pub fn frame(&mut self, expression: &'a Expression, scope: Scope<'a>) -> Option<PoseId> {
        let value = match &expression.kind {
            ExpressionKind::Name(reference) => {
                self.frame_or_body(reference, expression.span, "origin", scope)
            }
            _ => self.value(expression, scope),
        };
        match value {
            Value::Frame(pose) => Some(pose),
            Value::Body(body) => self.frame_of_body(body, expression.span),
            Value::Unknown => None,
            other => {
                self.wrong_kind("a frame", &other, expression);
                None
            }
        }
    }

    /// The meaning of a name before a dot: a frame or a body; if both have the name, the one that
    /// has the `member`.
    pub fn frame_or_body(
        &mut self,
        reference: &'a Reference,
        span: Span,
        member: &str,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let name = &reference.base;
        let frames = self.find_group(Namespace::FRAMES, &name.text);
        let bodies = self.find_group(Namespace::BODIES, &name.text);
        if frames.is_none() && bodies.is_none() && name.text == "ground" {
            return match &reference.index {
                None => Value::Frame(PoseId::GROUND),
                Some(index) => {
                    self.not_a_family(name, index.span);
                    Value::Unknown
                }
            };
        }
        let body_first = member == "at";
        let group = if body_first {
            bodies.or(frames)
        } else {
            frames.or(bodies)
        };
        let Some(group) = group else {
            let declared = self.find_group(Namespace::Values, &name.text);
            if declared.is_some() || scope.index.is_some_and(|(word, _)| word == name.text) {
                let message = format!("`{}` is neither a frame nor a body", name.text);
                self.error(Code::WrongKind, name.span, message);
            } else {
                let namespaces = [Namespace::FRAMES, Namespace::BODIES];
                self.unknown_name("no frame or body is", name, &namespaces);
            }
            return Value::Unknown;
        };
        let index = reference.index.as_deref();
        match self.member(group, name, index, scope) {
            None => Value::Unknown,
            Some(member) if Some(group) == bodies => Value::Body(member),
            Some(member) => self.value_of(member, span),
        }
    }

    /// `root.link.link…`
    pub fn chain(&mut self, chain: &'a Chain, span: Span, scope: Scope<'a>) -> Value<'d> {
        let first = chain
            .links
            .first()
            .map_or("", |link| link.name.text.as_str());
        let mut value = match &chain.root.kind {
            ExpressionKind::Name(reference) => {
                self.frame_or_body(reference, chain.root.span, first, scope)
            }
            _ => self.value(&chain.root, scope),
        };
        for link in &chain.links {
            let so_far = chain.root.span.to(link.span);
            value = match value {
                Value::Frame(pose) => self.frame_member(pose, link, chain, scope),
                Value::Body(body) => self.body_member(body, link, chain, scope),
                Value::Scalar(_) | Value::Vector(_) => {
                    let message = format!("{} has no `.{}`", value.kind(), link.name.text);
                    let diagnostic = Diagnostic::new(Code::WrongKind, link.span, message);
                    let help = "the part of a vector along an axis is `dot(u, (1, 0))`";
                    self.push(match self.space {
                        Space::Plane => diagnostic.help(help),
                        Space::Space => diagnostic.help(help.replace("(1, 0)", "(1, 0, 0)")),
                    });
                    Value::Unknown
                }
                // Errors in arguments are still reported.
                Value::Unknown => {
                    for argument in link.arguments.iter().flatten() {
                        if !is_axis(argument) {
                            self.value(argument, scope);
                        }
                    }
                    Value::Unknown
                }
            };
            value = self.check_stage(value, so_far, scope);
        }
        if value.is_unknown() {
            return Value::Unknown;
        }
        self.check_stage(value, span, scope)
    }

    fn body_member(
        &mut self,
        body: MemberId,
        link: &'a Link,
        chain: &'a Chain,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let word = link.name.text.as_str();
        if word == "at" {
            self.no_arguments(link);
            return self.value_of(body, chain.root.span);
        }
        if !FRAME_MEMBERS.contains(&word) {
            self.unknown_member(link, chain, &["at"], true);
            return Value::Unknown;
        }
        if BODY_MEMBERS.contains(&word) && !self.has_frame(body) {
            return self.motion_of_body(body, link, chain.root.span, scope);
        }
        match self.frame_of_body(body, chain.root.span) {
            Some(pose) => self.frame_member(pose, link, chain, scope),
            None => Value::Unknown,
        }
    }

    fn has_frame(&self, body: MemberId) -> bool {
        let record = self.record(body);
        record.is_some_and(|record| record.field("frame").is_some())
    }

    /// The frame of a body, or an error if it has none.
    pub fn frame_of_body(&mut self, body: MemberId, span: Span) -> Option<PoseId> {
        if !self.has_frame(body) {
            let name = self.name(body);
            let message = format!("the body `{name}` has no frame");
            let diagnostic = Diagnostic::new(Code::NoFrame, span, message);
            let help = format!("give it one, `frame: …`; its mass centre is `{name}.at`");
            self.push(diagnostic.help(help));
            return None;
        }
        if self.members[body].frame_state != State::Done {
            self.need(Need::Frame(body), span);
            return None;
        }
        match self.members[body].frame {
            Value::Frame(pose) => Some(pose),
            _ => None,
        }
    }

    fn frame_member(
        &mut self,
        frame: PoseId,
        link: &'a Link,
        chain: &'a Chain,
        scope: Scope<'a>,
    ) -> Value<'d> {
        match link.name.text.as_str() {
            "origin" => {
                self.no_arguments(link);
                Value::Vector(self.origin(frame))
            }
            "point" => match self.components(link, Some(Unit::METRE), scope) {
                Some(place) => Value::Vector(Vector {
                    components: self.point_of(frame, &place.components),
                    unit: Some(Unit::METRE),
                    local: Some((frame, place.components)),
                }),
                None => Value::Unknown,
            },
            "vector" => match self.components(link, None, scope) {
                Some(vector) => {
                    let components = self.vector_of(frame, &vector.components);
                    Value::Vector(Vector::new(components, vector.unit))
                }
                None => Value::Unknown,
            },
            "shift" => match self.components(link, Some(Unit::METRE), Self::frame_scope(scope)) {
                Some(by) => Value::Frame(self.shifted(frame, by.components)),
                None => Value::Unknown,
            },
            "turn" => match link.arguments.as_deref() {
                Some(four) if four.len() == 4 => {
                    match self.quaternion_components(link, four, Self::frame_scope(scope)) {
                        Some(e) => Value::Frame(self.turned_by_quaternion(frame, e)),
                        None => Value::Unknown,
                    }
                }
                _ => match self.turn(link, Self::frame_scope(scope)) {
                    Some((axis, angle)) => Value::Frame(self.rotated(frame, axis, angle)),
                    None => Value::Unknown,
                },
            },
            "with_origin" => match self.point_of_link(link, Self::frame_scope(scope)) {
                Some(point) => {
                    let by = self.local_coordinates(frame, &point);
                    Value::Frame(self.shifted(frame, by))
                }
                None => Value::Unknown,
            },
            "spin" | "velocity" => self.motion_of_frame(frame, link, scope),
            _ => {
                self.unknown_member(link, chain, &FRAME_MEMBERS, false);
                Value::Unknown
            }
        }
    }

    pub(super) fn no_arguments(&mut self, link: &'a Link) {
        if link.arguments.is_some() {
            let message = format!("`.{}` is written without brackets", link.name.text);
            self.error(Code::WrongArguments, link.span, message);
        }
    }

    /// The scope of the arguments that make a frame: in any context, a frame is placed by positions.
    fn frame_scope(scope: Scope<'a>) -> Scope<'a> {
        if scope.limit.stage > stage::POSITION {
            scope.with_limit(&limits::FRAME)
        } else {
            scope
        }
    }

    /// The arguments of `point`, `vector` and `shift`: components in the frame's axes.
    fn components(
        &mut self,
        link: &'a Link,
        unit: Option<Unit>,
        scope: Scope<'a>,
    ) -> Option<Vector<'d>> {
        let arguments = link.arguments.as_deref().unwrap_or(&[]);
        let dimension = self.space.dimension();
        if arguments.len() != dimension {
            let word = &link.name.text;
            let message = format!(
                "`.{word}` takes {}, found {}",
                super::value::dimension_text(self.space),
                arguments.len()
            );
            let code = if link.arguments.is_some() {
                Code::WrongDimension
            } else {
                Code::WrongArguments
            };
            self.error(code, link.span, message);
            for argument in arguments {
                self.scalar(argument, scope);
            }
            return None;
        }
        let mut components = Vec::with_capacity(dimension);
        let mut units = Vec::with_capacity(dimension);
        let mut bare = Vec::with_capacity(dimension);
        for argument in arguments {
            let scalar = self.scalar(argument, scope.with_expected_unit(unit));
            if let (Some(scalar), Some(unit)) = (scalar, unit) {
                let reason = "a frame measures lengths along its axes";
                self.require_unit(scalar.unit, unit, argument.span, reason);
            }
            components.push(scalar.map(|scalar| scalar.expr));
            units.push((scalar.and_then(|scalar| scalar.unit), argument.span));
            bare.push((scalar.is_some_and(|scalar| scalar.is_bare()), argument.span));
        }
        let mut written = units.iter().filter_map(|(unit, _)| *unit);
        let scaled = written.find(|unit| unit.is_scaled());
        self.refuse_bare_numbers(bare.into_iter(), scaled);
        let unit = match unit {
            Some(unit) => Some(unit),
            None => self.common_unit(
                units.into_iter(),
                None,
                "the components of a vector must have the same unit",
            ),
        };
        let components = components.into_iter().collect::<Option<Vec<_>>>()?;
        Some(Vector::new(components, unit))
    }

    /// The arguments of `turn`: an angle in the plane, an axis and an angle in space.
    fn turn(&mut self, link: &'a Link, scope: Scope<'a>) -> Option<(usize, Expr<'d>)> {
        let arguments = link.arguments.as_deref().unwrap_or(&[]);
        let (axis, angle) = match (self.space, arguments) {
            (Space::Plane, [angle]) => (Some(2), angle),
            (Space::Space, [axis, angle]) => (self.axis(axis), angle),
            (Space::Plane, [axis, _]) if is_axis(axis) => {
                let message = "in the plane a frame turns only about the normal";
                let diagnostic = Diagnostic::new(Code::WrongSpace, link.span, message);
                self.push(diagnostic.help("write `turn(angle)`"));
                return None;
            }
            (Space::Space, [_]) => {
                let message = "in space a frame turns about one of its axes, and none is given";
                let diagnostic = Diagnostic::new(Code::WrongSpace, link.span, message);
                self.push(diagnostic.help("write `turn(x, angle)`, with `x`, `y` or `z`"));
                return None;
            }
            (space, arguments) => {
                let (takes, help) = match space {
                    Space::Plane => ("an angle", "write `turn(angle)`"),
                    Space::Space => (
                        "an axis and an angle, or four coordinates",
                        "one rotation follows another: `turn(z, psi).turn(x, theta)`",
                    ),
                };
                let count = arguments.len();
                let message = format!("`.turn` takes {takes}, found {count} arguments");
                let diagnostic = Diagnostic::new(Code::WrongArguments, link.span, message);
                self.push(diagnostic.help(help));
                return None;
            }
        };
        let axis = axis?;
        let reason = "a frame turns by an angle in rad";
        let angle = self.scalar_in(angle, Unit::RADIAN, reason, scope)?;
        Some((axis, angle.expr))
    }

    /// The four arguments of a `turn` by a quaternion: coordinates of their own.
    ///
    /// Formulas of coordinates are refused, because the length of the quaternion has an equation of motion of its own,
    /// which could not be separated from other effects of these coordinates.
    fn quaternion_components(
        &mut self,
        link: &'a Link,
        arguments: &'a [Expression],
        scope: Scope<'a>,
    ) -> Option<[Expr<'d>; 4]> {
        if self.space == Space::Plane {
            let message = "in the plane a frame turns only about the normal";
            let diagnostic = Diagnostic::new(Code::WrongSpace, link.span, message);
            self.push(diagnostic.help("write `turn(angle)`"));
            return None;
        }
        let reason = "a frame is turned by the four pure numbers of a quaternion, or about an axis by an angle";
        let all: Vec<_> = arguments
            .iter()
            .map(|argument| self.scalar_in(argument, Unit::ONE, reason, scope))
            .collect();
        let mut e = Vec::with_capacity(4);
        for (scalar, argument) in all.into_iter().zip(arguments) {
            let scalar = scalar?;
            let is_coordinate =
                scalar.expr.as_symbol().is_some() && scalar.expr.stage() == stage::POSITION;
            let message = if !is_coordinate {
                "the four components of a quaternion must be coordinates, and this is not one"
            } else if e.contains(&scalar.expr) {
                "the four components of a quaternion must be four different coordinates"
            } else {
                e.push(scalar.expr);
                continue;
            };
            let diagnostic = Diagnostic::new(Code::WrongArguments, argument.span, message);
            self.push(diagnostic.help("declare `coordinates { e[0]: 1 = 1, e[1..3]: 1 }`, and write `.turn(e[0], e[1], e[2], e[3])`"));
            return None;
        }
        let e: [Expr<'d>; 4] = e.try_into().ok()?;
        let before = self
            .quaternions
            .iter()
            .find(|(other, _)| other.iter().any(|x| e.contains(x)));
        match before {
            None => self.quaternions.push((e, link.span)),
            Some((other, _)) if *other == e => {}
            Some(&(_, span)) => {
                let message = "one of these four coordinates is also part of the quaternion of another frame, together with other coordinates";
                let diagnostic = Diagnostic::new(Code::WrongArguments, link.span, message);
                let help = "give each quaternion four coordinates of its own, or the same four in the same order";
                self.push(
                    diagnostic
                        .note(span, "the other frame is turned here")
                        .help(help),
                );
                return None;
            }
        }
        Some(e)
    }

    /// The quaternions that turn frames. Their start values must not all be 0, since these describe no rotation.
    pub(super) fn all_quaternions(
        &mut self,
        coordinates: &[Coordinate<'d>],
    ) -> Vec<Quaternion<'d>> {
        let all = std::mem::take(&mut self.quaternions);
        for (e, span) in &all {
            let four = e.map(|e| coordinates.iter().find(|c| c.q == e));
            if !four.iter().all(|c| c.is_some_and(|c| c.start.is_zero())) {
                continue;
            }
            let Some(first) = four[0] else { continue };
            let name = &first.name;
            let message =
                "all four components of this quaternion start at 0, where they define no rotation";
            let diagnostic = Diagnostic::new(Code::DivisionByZero, *span, message);
            let diagnostic = diagnostic.note(first.span, "the first of them");
            self.push(diagnostic.help(format!("`{name}: 1 = 1` starts it without rotation")));
        }
        let zero = self.dag.zero();
        let four = |(e, span)| Quaternion {
            e,
            inertia: zero,
            span,
        };
        all.into_iter().map(four).collect()
    }

    /// `x`, `y` or `z`: an axis of a frame, by its index.
    pub fn axis(&mut self, expression: &'a Expression) -> Option<usize> {
        if let ExpressionKind::Name(Reference { base, index: None }) = &expression.kind
            && let Some(axis) = ["x", "y", "z"].iter().position(|name| *name == base.text)
        {
            return Some(axis);
        }
        let message = "an axis is `x`, `y` or `z` here, an axis of the frame itself";
        self.error(Code::WrongKind, expression.span, message);
        None
    }

    /// Reports a member that a frame or a body does not have.
    fn unknown_member(&mut self, link: &'a Link, chain: &'a Chain, has: &[&str], body: bool) {
        let word = &link.name.text;
        if word.is_empty() {
            return;
        }
        let known = has.iter().copied().chain(FRAME_MEMBERS);
        if link.arguments.is_some() {
            let message = format!("there is no operation `{word}` on a frame");
            let help = suggestion(word, known);
            let diagnostic = Diagnostic::new(Code::UnknownFunction, link.name.span, message);
            return self.push(with_help(diagnostic, help));
        }
        let help = match &chain.root.kind {
            _ if word == "at" && !body => {
                Some("a frame has an `.origin`, a body is `.at`".to_owned())
            }
            ExpressionKind::Name(reference) if chain.links.len() == 1 => {
                let root = &reference.base.text;
                let near = suggestion(word, ["at", "origin"]).filter(|help| help.contains('?'));
                near.or_else(|| self.declared_points(root))
            }
            _ => suggestion(word, known),
        };
        let root = match &chain.root.kind {
            ExpressionKind::Name(reference) => {
                let index = if reference.index.is_some() {
                    "[…]"
                } else {
                    ""
                };
                format!("{}{index}", reference.base.text)
            }
            _ => "…".to_owned(),
        };
        let span = chain.root.span.to(link.span);
        let message = format!("no point named `{root}.{word}`");
        self.push(with_help(
            Diagnostic::new(Code::UnknownPoint, span, message),
            help,
        ));
    }

    /// The points that can be named: bodies and origins, those of `root` first.
    fn declared_points(&self, root: &str) -> Option<String> {
        if self.report.omitted() > 0 {
            return None; // the message will be omitted anyway
        }
        let member_of = |namespace| match namespace {
            Namespace::BODIES => Some("at"),
            Namespace::FRAMES => Some("origin"),
            _ => None,
        };
        let mut points: Vec<(bool, String)> = Vec::new();
        for group in self.groups.iter().take(COMPARED) {
            if let (Some(member), Some((index, _))) =
                (member_of(group.namespace), group.members.first_key_value())
            {
                let name = text::show(group.base, *index);
                points.push((group.base != root, format!("`{name}.{member}`")));
            }
        }
        sort_by(&mut points, Ord::cmp);
        let more = points.len() > LISTED;
        points.truncate(LISTED);
        let mut list: Vec<String> = points.into_iter().map(|(_, point)| point).collect();
        if more {
            list.push("…".to_owned());
        }
        (!list.is_empty()).then(|| format!("points declared here: {}", list.join(", ")))
    }

    /// Resolves the value of a member when something needs it.
    pub fn member_value(&mut self, member: MemberId) -> Value<'d> {
        let declaration = self.declaration(member);
        match (declaration.section, declaration.content) {
            (SectionKind::Constants, Content::Quantity(quantity)) => {
                self.constant_value(member, quantity)
            }
            (SectionKind::Parameters, Content::Quantity(quantity)) => {
                self.derived_value(member, quantity)
            }
            (SectionKind::Define, Content::Quantity(quantity)) => {
                self.shared_output(member, quantity)
            }
            (SectionKind::Define, Content::Expression(expression)) => {
                let scope = self.scope(member, &limits::DEFINITION);
                match self.value(expression, scope) {
                    frame @ (Value::Frame(_) | Value::Body(_)) => {
                        let message = format!(
                            "a definition is a number, a vector or a point, found {}",
                            frame.kind()
                        );
                        let diagnostic = Diagnostic::new(Code::WrongKind, expression.span, message);
                        self.push(diagnostic.help("a frame is named under `frames`"));
                        Value::Unknown
                    }
                    value => value,
                }
            }
            (SectionKind::Frames, Content::Expression(expression)) => {
                let scope = self.scope(member, &limits::FRAME);
                match self.frame(expression, scope) {
                    Some(pose) => Value::Frame(pose),
                    None => Value::Unknown,
                }
            }
            (SectionKind::Bodies, Content::Record(record)) => self.mass_centre(member, record),
            _ => Value::Unknown,
        }
    }
}

/// Whether an argument is an axis, which is not an expression.
fn is_axis(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Name(Reference { base, index: None }) => {
            ["x", "y", "z"].contains(&base.text.as_str())
        }
        _ => false,
    }
}
