//! A machine in another chart: polar coordinates about a point, replaced by Cartesian ones about the same point.
//!
//! Where `s = 0`, polar coordinates `(s, φ)` do not determine a direction, and the mass matrix is singular. For a body that
//! may pass through this point, a spec names a second pair of coordinates,
//!
//! ```text
//! x = s cos φ,   y = s sin φ
//! ```
//!
//! and this module writes the same machine in them. Into every expression of the model it puts
//!
//! ```text
//! s = √(x² + y²),   cos φ = x/s,   sin φ = y/s,   ṡ = (x ẋ + y ẏ)/s,   φ̇ = (x ẏ − y ẋ)/s²
//! ```
//!
//! and the accelerations that follow. The equations are then derived from positions like those of any machine, and so is their proof.
//! In `s cos φ` the root cancels, so a position is a polynomial in `x` and `y`, and its equations hold at the centre as elsewhere.
//!
//! The angle itself is not a function of `x` and `y`: it grows by 2π with every turn. So it may occur only in sines and cosines, also
//! with an integer factor and beside other angles. An expression that contains it otherwise is refused.

use std::collections::BTreeMap;

use lagrangian_symbolic::{Dag, Expr, Function, Id, Node, Rational, Symbol, reachable};

use super::element::{Contribution, Element, Load};
use super::{
    Body, Contact, ContactGeometry, Coordinate, Inertia, Model, Name, PoseChange, Response,
    Rotation, Stages, stage,
};
use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::Span;
use crate::unit::{Variable, rate_name};

/// The largest factor of an angle in a sine or cosine: its power is a polynomial of this degree.
const LARGEST_FACTOR: i64 = 16;

/// Two charts for one point.
#[derive(Clone, Debug)]
pub struct Charts {
    /// The name that the spec gives them.
    pub name: Name,
    /// The indices of two coordinates: a distance, and the angle of its direction.
    pub polar: [usize; 2],
    /// The names of the components of the distance, the coordinates in the other chart.
    pub cartesian: [Name; 2],
    /// Where the spec says it.
    pub span: Span,
}

/// The polar coordinates of a pair, and the Cartesian ones that replace them.
struct Pair<'d> {
    charts: Charts,
    /// The symbols of distance and angle, of their rates, and of their accelerations.
    polar: [[Symbol; 3]; 2],
    /// The symbols of the components, of their rates, and of their accelerations.
    cartesian: [[Expr<'d>; 3]; 2],
    /// `√(x² + y²)`
    distance: Expr<'d>,
    /// Stands for the angle where it is not in a sine or cosine.
    angle: Expr<'d>,
}

impl<'d> Pair<'d> {
    fn new(model: &Model<'d>, charts: &Charts) -> Option<Pair<'d>> {
        let dag = model.dag;
        let symbols = |name: &Name| {
            let (q, v) = (name.to_string(), rate_name(&name.to_string(), ""));
            let a = rate_name(&v, "");
            [
                dag.symbol(&q, stage::POSITION),
                dag.symbol(&v, stage::VELOCITY),
                dag.symbol(&a, stage::ACCELERATION),
            ]
        };
        let old = |index: usize| {
            let Coordinate { q, v, a, .. } = &model.coordinates[index];
            Some([q.as_symbol()?, v.as_symbol()?, a.as_symbol()?])
        };
        let cartesian = [symbols(&charts.cartesian[0]), symbols(&charts.cartesian[1])];
        let [[x, ..], [y, ..]] = cartesian;
        let angle = &model.coordinates[charts.polar[1]].name;
        Some(Pair {
            charts: charts.clone(),
            polar: [old(charts.polar[0])?, old(charts.polar[1])?],
            cartesian,
            distance: (x.square() + y.square()).sqrt(),
            angle: dag.symbol(&format!("turned({angle})"), stage::POSITION),
        })
    }

    /// The polar coordinates, their rates and accelerations, in the Cartesian ones; but the angle itself.
    fn meanings(&self) -> [(Symbol, Expr<'d>); 6] {
        let [[x, vx, ax], [y, vy, ay]] = self.cartesian;
        let s = self.distance;
        let (along, across) = (x * vx + y * vy, x * vy - y * vx);
        let (rate, turning) = (along / s, across / s.square());
        // The derivative of s ṡ = x ẋ + y ẏ, and that of s² φ̇ = x ẏ − y ẋ.
        let radial = (vx.square() + vy.square() + x * ax + y * ay - rate.square()) / s;
        let angular = (x * ay - y * ax - 2 * along * turning) / s.square();
        let [[q0, v0, a0], [q1, v1, a1]] = self.polar;
        [
            (q0, s),
            (v0, rate),
            (a0, radial),
            (q1, self.angle),
            (v1, turning),
            (a1, angular),
        ]
    }

    /// What a generalized force on one of the polar coordinates is on each component: its work is the same.
    fn shares(&self, which: usize) -> [Expr<'d>; 2] {
        let [[x, ..], [y, ..]] = self.cartesian;
        let s = self.distance;
        match which {
            0 => [x / s, y / s],
            _ => [-y / s.square(), x / s.square()],
        }
    }
}

/// Writes a machine in the Cartesian coordinates of all its pairs; nothing if an error was reported. The last outputs are this many
/// formulas of the caller.
pub fn in_cartesian<'d>(
    model: &Model<'d>,
    formulas: usize,
    report: &mut Report,
) -> Option<Model<'d>> {
    let pairs: Option<Vec<Pair<'d>>> = (model.charts.iter())
        .map(|charts| Pair::new(model, charts))
        .collect();
    let pairs = pairs?;
    let mut rewriting = Rewriting {
        dag: model.dag,
        meanings: pairs.iter().flat_map(Pair::meanings).collect(),
        pairs: &pairs,
        formulas,
        report,
        uncharted: Vec::new(),
        is_refused: false,
    };
    rewriting.check_names(model);
    let mut machine = rewriting.machine(model);
    machine.uncharted = rewriting.uncharted;
    (!rewriting.is_refused).then_some(machine)
}

/// The work in progress.
struct Rewriting<'p, 'd, 'r> {
    dag: &'d Dag,
    pairs: &'p [Pair<'d>],
    meanings: BTreeMap<Symbol, Expr<'d>>,
    /// How many of the last outputs are formulas of the caller.
    formulas: usize,
    report: &'r mut Report,
    /// The errors of a run whose formulas contain an angle.
    uncharted: Vec<Diagnostic>,
    is_refused: bool,
}

impl<'d> Rewriting<'_, 'd, '_> {
    fn refuse(&mut self, pair: usize, message: String, note: (Span, &str), help: &str) {
        self.is_refused = true;
        let span = self.pairs[pair].charts.span;
        let diagnostic = Diagnostic::new(Code::NotSupported, span, message);
        self.report.push(diagnostic.note(note.0, note.1).help(help));
    }

    /// Refuses sections that name a coordinate that the other chart does not have.
    fn check_names(&mut self, model: &Model<'d>) {
        for (k, pair) in self.pairs.iter().enumerate() {
            let is_polar = |coordinate: usize| pair.charts.polar.contains(&coordinate);
            let name = |coordinate: usize| &model.coordinates[coordinate].name;
            for approximation in &model.approximations {
                let coordinate = approximation.coordinate;
                if is_polar(coordinate) {
                    let message = format!(
                        "`{}` is approximated, and the Cartesian chart has no such coordinate",
                        name(coordinate)
                    );
                    let help = "leave out `charts`, or the approximation";
                    self.refuse(
                        k,
                        message,
                        (approximation.span, "it is approximated here"),
                        help,
                    );
                }
            }
            for kept in &model.kept {
                if let Variable::Coordinate(coordinate) | Variable::Rate(coordinate) = *kept
                    && is_polar(coordinate)
                {
                    let message = format!(
                        "a start value of `{}` is kept, and the Cartesian chart has no such coordinate",
                        name(coordinate)
                    );
                    let help = "leave out `charts`, or take it out of `keep`";
                    let place = model.coordinates[coordinate].span;
                    self.refuse(k, message, (place, "the coordinate"), help);
                }
            }
        }
    }

    /// The machine in the Cartesian charts.
    fn machine(&mut self, model: &Model<'d>) -> Model<'d> {
        let mut machine = model.clone();
        machine.charts = Vec::new();
        machine.cartesian = None;
        machine.published = Vec::new();
        machine.destination = Vec::new();
        machine.derivatives = Vec::new();
        machine.stages = Stages::default();
        machine.taylor = None;
        // That a distance is positive is said of the polar chart, and no other chart needs it.
        let distances: Vec<Symbol> = self.pairs.iter().map(|pair| pair.polar[0][0]).collect();
        machine.assumptions.retain(|fact| {
            let symbol = fact.excess.as_symbol();
            symbol.is_none_or(|symbol| !distances.contains(&symbol))
        });
        for pair in self.pairs {
            self.replace_coordinates(&mut machine, pair);
        }
        for coordinate in &mut machine.coordinates {
            let what = format!("the state `{}`", coordinate.name);
            self.put(coordinate.rate.as_mut(), &what, coordinate.span);
        }
        self.rewrite_frames(&mut machine);
        for body in &mut machine.bodies {
            let (what, span) = (format!("the body `{}`", body.name), body.position_span);
            self.put(expressions_of_body(body), &what, span);
        }
        for element in &mut machine.elements {
            self.share_loads(element);
            let what = format!("{} `{}`", element.section.item, element.name);
            let span = element.span;
            self.put(element.expressions_mut(), &what, span);
        }
        for fact in &mut machine.assumptions {
            let what = format!("the assumption `{}`", fact.text);
            self.put([&mut fact.excess], &what, fact.span);
        }
        for circle in &mut machine.circles {
            let what = format!("the circle `{}`", circle.name);
            let places = circle.center.iter_mut().chain([&mut circle.radius]);
            self.put(places, &what, circle.span);
        }
        for contact in &mut machine.contacts {
            let (what, span) = (format!("the contact `{}`", contact.name), contact.span);
            self.put(expressions_of_contact(contact), &what, span);
        }
        let own = machine.outputs.len().saturating_sub(self.formulas);
        let (outputs, formulas) = machine.outputs.split_at_mut(own);
        for output in outputs {
            let what = format!("the output `{}`", output.name);
            self.put([&mut output.value], &what, output.span);
        }
        for formula in formulas {
            if let Some((pair, angle)) = self.place([&mut formula.value]) {
                self.refuse_formula(pair, &angle, formula.span);
            }
        }
        if let Some(relaxed) = machine.relaxed.take()
            && !self.is_refused
        {
            machine.relaxed = Some(Box::new(self.machine(&relaxed)));
        }
        machine
    }

    /// Puts the components in the places of the polar coordinates.
    fn replace_coordinates(&self, machine: &mut Model<'d>, pair: &Pair<'d>) {
        let [s, phi] = pair.charts.polar;
        let [distance, angle] = [s, phi].map(|index| &machine.coordinates[index]);
        let (s0, ds0) = (distance.start, distance.start_rate);
        let (phi0, dphi0) = (angle.start, angle.start_rate);
        let starts = [
            (s0 * phi0.cos(), ds0 * phi0.cos() - s0 * dphi0 * phi0.sin()),
            (s0 * phi0.sin(), ds0 * phi0.sin() + s0 * dphi0 * phi0.cos()),
        ];
        let (unit, unit_text) = (distance.unit, distance.unit_text.clone());
        let components = pair.cartesian.iter().zip(starts);
        let named = components.zip(&pair.charts.cartesian);
        for (index, (([q, v, a], (start, start_rate)), name)) in [s, phi].into_iter().zip(named) {
            machine.coordinates[index] = Coordinate {
                name: name.clone(),
                docs: String::new(),
                unit,
                unit_text: unit_text.clone(),
                start,
                start_rate,
                rate: None,
                q: *q,
                v: *v,
                a: *a,
                span: pair.charts.span,
            };
        }
    }

    fn rewrite_frames(&mut self, machine: &mut Model<'d>) {
        for index in 0..machine.poses.len() {
            let mut frames = machine.frames.iter();
            let built = frames.find(|frame| frame.pose.index() >= index);
            let (what, span) = match built {
                Some(frame) => (format!("the frame `{}`", frame.name), frame.span),
                None => ("a frame".to_owned(), machine.span),
            };
            let pose = &mut machine.poses[index];
            let mut places: Vec<&mut Expr<'d>> = pose.origin.iter_mut().collect();
            places.extend(pose.axes.iter_mut().flatten());
            places.push(&mut pose.angle);
            match &mut pose.step {
                PoseChange::Ground => {}
                PoseChange::Shift(by) => places.extend(by),
                PoseChange::Turn { angle, .. } => places.push(angle),
                PoseChange::Quaternion(e) => places.extend(e),
            }
            self.put(places, &what, span);
        }
    }

    /// Distributes a generalized force on a polar coordinate among the components.
    fn share_loads(&self, element: &mut Element<'d>) {
        let all = std::mem::take(&mut element.contributions);
        for one in all {
            let Contribution::Load(Load::Coordinate { coordinate, value }) = one else {
                element.contributions.push(one);
                continue;
            };
            let place = |pair: &Pair<'d>| pair.charts.polar.iter().position(|q| *q == coordinate);
            let found = self
                .pairs
                .iter()
                .find_map(|pair| Some((pair, place(pair)?)));
            let Some((pair, which)) = found else {
                let load = Load::Coordinate { coordinate, value };
                element.contributions.push(Contribution::Load(load));
                continue;
            };
            for (share, coordinate) in pair.shares(which).into_iter().zip(pair.charts.polar) {
                let value = value * share;
                let load = Load::Coordinate { coordinate, value };
                element.contributions.push(Contribution::Load(load));
            }
        }
    }

    /// Rewrites the expressions of one part of the machine, or refuses them if they contain an angle itself.
    fn put<'e>(
        &mut self,
        places: impl IntoIterator<Item = &'e mut Expr<'d>>,
        what: &str,
        span: Span,
    ) where
        'd: 'e,
    {
        let Some((pair, angle)) = self.place(places) else {
            return;
        };
        let message = format!(
            "{what} contains the angle `{angle}` other than in a sine or cosine: it is not a function of Cartesian coordinates, \
             for it grows with every turn"
        );
        let help = format!(
            "leave out `charts` if the distance never becomes 0; otherwise write positions as `polar(s, {angle})`, and frames, \
             springs and outputs without the angle"
        );
        self.refuse(pair, message, (span, "here"), &help);
    }

    /// Notes that a formula of the caller contains an angle itself, which is an error only of a run in the Cartesian coordinates.
    fn refuse_formula(&mut self, pair: usize, angle: &str, span: Span) {
        if self.uncharted.iter().any(|other| other.span == span) {
            return;
        }
        let message = format!(
            "the run is in the Cartesian coordinates that `charts` names, of which the angle `{angle}` is no function, for it grows \
             with every turn; only its sine and cosine are"
        );
        let diagnostic = Diagnostic::new(Code::NotSupported, span, message);
        let diagnostic = diagnostic.note(self.pairs[pair].charts.span, "the charts");
        let help = "write the formula without the angle, or leave `charts` out of the spec";
        self.uncharted.push(diagnostic.help(help));
    }

    /// Rewrites the expressions of one part of the machine. If one contains an angle itself, returns its pair and its name.
    fn place<'e>(
        &mut self,
        places: impl IntoIterator<Item = &'e mut Expr<'d>>,
    ) -> Option<(usize, String)>
    where
        'd: 'e,
    {
        let places: Vec<&mut Expr<'d>> = places.into_iter().collect();
        let before: Vec<Expr<'d>> = places.iter().map(|place| **place).collect();
        let after = self.rewritten(&before);
        let contains = |pair: &Pair<'d>| {
            let angle = pair.angle.as_symbol();
            angle.is_some_and(|angle| after.iter().any(|e| e.depends_on(angle)))
        };
        let found = self.pairs.iter().position(contains);
        for (place, value) in places.into_iter().zip(after) {
            *place = value;
        }
        let pair = found?;
        let [_, angle] = self.pairs[pair].polar;
        Some((pair, self.dag.name(angle[0])))
    }

    /// The expressions in the Cartesian charts.
    fn rewritten(&self, before: &[Expr<'d>]) -> Vec<Expr<'d>> {
        let mut new: BTreeMap<Id, Expr<'d>> = BTreeMap::new();
        for id in reachable(self.dag, before) {
            let old = self.dag.expr(id);
            let of = |child: Id| new.get(&child).copied().unwrap_or(self.dag.expr(child));
            let mut is_changed = false;
            let node = old.node();
            node.for_each_child(|child| is_changed |= new.contains_key(&child));
            let value = match &node {
                Node::Symbol(symbol) => match self.meanings.get(symbol) {
                    Some(meaning) => *meaning,
                    None => continue,
                },
                _ if !is_changed => continue,
                Node::Constant(_) | Node::Pi => continue,
                Node::Sum(terms) => {
                    let terms = terms.iter();
                    self.dag
                        .sum(terms.map(|(x, c)| of(*x) * self.dag.constant(c.clone())))
                }
                Node::Product(factors) => {
                    let factors = factors.iter();
                    self.dag.product(factors.map(|(x, n)| of(*x).powi(*n)))
                }
                Node::Function(Function::Sin, x) => self.circular(x[0], &of)[1],
                Node::Function(Function::Cos, x) => self.circular(x[0], &of)[0],
                Node::Function(function, arguments) => {
                    let arguments: Vec<_> = arguments.iter().map(|x| of(*x)).collect();
                    self.dag.function(*function, &arguments)
                }
            };
            new.insert(id, value);
        }
        let of = |e: &Expr<'d>| new.get(&e.id()).copied().unwrap_or(*e);
        before.iter().map(of).collect()
    }

    /// Cosine and sine of a sum in which the angle of a chart may be a term: `cos(φ + α) = (x cos α − y sin α)/s`. The distance is a
    /// factor of its own, so that it cancels against that of a position.
    fn circular(&self, angle: Id, of: &impl Fn(Id) -> Expr<'d>) -> [Expr<'d>; 2] {
        let terms: Vec<(Id, Rational)> = match self.dag.node(angle) {
            Node::Sum(terms) => terms.to_vec(),
            _ => vec![(angle, Rational::ONE)],
        };
        let mut rest = Vec::new();
        let mut turns = Vec::new();
        for (id, coefficient) in terms {
            let symbol = self.dag.expr(id).as_symbol();
            let is_angle = |pair: &&Pair<'d>| symbol == Some(pair.polar[1][0]);
            let pair = self.pairs.iter().find(is_angle);
            let factor = coefficient.as_integer();
            match (pair, factor.filter(|n| n.abs() <= LARGEST_FACTOR)) {
                (Some(pair), Some(factor)) => turns.push((pair, factor)),
                _ => rest.push(of(id) * self.dag.constant(coefficient)),
            }
        }
        let rest = self.dag.sum(rest);
        let (mut cos, mut sin) = (rest.cos(), rest.sin());
        let mut scale = self.dag.one();
        for (pair, factor) in turns {
            let [[x, ..], [y, ..]] = pair.cartesian;
            let y = if factor < 0 { -y } else { y };
            for _ in 0..factor.abs() {
                (cos, sin) = (cos * x - sin * y, sin * x + cos * y);
                scale = scale / pair.distance;
            }
        }
        [cos * scale, sin * scale]
    }
}

/// The expressions of a body.
fn expressions_of_body<'m, 'd>(body: &'m mut Body<'d>) -> Vec<&'m mut Expr<'d>> {
    let mut places: Vec<&mut Expr<'d>> = body.at.iter_mut().collect();
    places.push(&mut body.mass);
    places.extend(body.local.iter_mut().flat_map(|local| &mut local.point));
    places.extend(body.outline.iter_mut().flatten());
    match &mut body.inertia {
        Inertia::Particle => {}
        Inertia::Planar(inertia) => places.push(inertia),
        Inertia::Tensor(inertia) => places.extend(inertia),
    }
    if let Rotation::Angle(angle) = &mut body.rotation {
        places.push(angle);
    }
    places
}

/// The expressions of a contact.
fn expressions_of_contact<'m, 'd>(contact: &'m mut Contact<'d>) -> Vec<&'m mut Expr<'d>> {
    let mut places: Vec<&mut Expr<'d>> = Vec::new();
    match &mut contact.geometry {
        ContactGeometry::Circles(_) | ContactGeometry::Corner(_) => {}
        ContactGeometry::Point { point, .. } => {
            places.extend(point.center.iter_mut().chain([&mut point.radius]));
        }
        ContactGeometry::Expressions { gap, slip, across } => {
            places.extend([gap, slip]);
            places.extend(across);
        }
    }
    match &mut contact.response {
        Response::Rigid { restitution, .. } => places.extend(restitution),
        Response::Compliant { parameters, .. } => places.extend(parameters),
    }
    places.extend(&mut contact.friction);
    places.extend(&mut contact.static_friction);
    places.extend(&mut contact.rolling_resistance);
    places
}
