//! Resolution, from a [`Spec`] to a [`Model`]: finds names, checks units, unrolls families, merges variants.
//!
//! Sections stand in any order, and a declaration may be needed before the place where it stands.
//! So each definition is resolved when it is needed ([`work`]), without recursion from one
//! definition to the next. Errors are reported as they are found, each once, and resolution
//! continues; there is a model only if there are no errors.
//!
//! | file | resolves |
//! | --- | --- |
//! | [`layers`] | the files that a variant extends |
//! | [`names`] | the declarations of a name, and the members of families |
//! | [`work`] | the order in which definitions are resolved |
//! | [`expression`] | the value and the unit of an expression |
//! | [`tables`] | functions given by tables |
//! | [`frames`] | frames and points |
//! | [`motion`] | angular velocities of frames, velocities of points fixed to frames |
//! | [`fields`] | the fields of records |
//! | [`items`] | parameters, coordinates, bodies, circles, … |
//! | [`outlines`] | the shapes of bodies |
//! | [`element`] | the elements, by the list of their sections |
//! | [`rates`] | rates at the start |
//! | [`states`] | first-order states and their rates |
//! | [`bounds`] | bounds on numbers, such as positive masses |
//! | [`warnings`] | constructs that are probably unintended |
//! | [`relaxation`] | the same machine with its guides relaxed |
//! | [`derivatives`] | the variables by which accelerations are to be differentiated |
//! | [`stages`] | the stages of the accelerations that are to be computed separately |
//! | [`methods`] | the integration methods for which emitted code needs more functions |
//! | [`charts`] | coordinates of a second chart |
//! | [`keep`] | the start values that a correction of the start keeps |
//! | [`brachistochrone`] | the end of the fastest motion |
//! | [`outside`] | values supplied by the caller |
//! | [`formulas`] | formulas supplied by the caller |
//! | [`published`] | assumptions and published equations |

mod bounds;
mod brachistochrone;
mod charts;
mod contacts;
mod derivatives;
mod derived;
pub(crate) mod element;
pub(crate) mod expression;
mod fields;
pub(crate) mod formulas;
mod frames;
mod items;
mod keep;
mod layers;
mod methods;
pub(crate) mod motion;
mod names;
mod outlines;
mod outside;
mod published;
mod rates;
mod relaxation;
mod stages;
mod states;
mod tables;
mod text;
pub(crate) mod value;
mod warnings;
mod work;

pub use formulas::Formula;
pub use names::MEMBER_LIMIT;
pub use outside::value_in;

use std::collections::BTreeSet;

use lagrangian_symbolic::{Dag, Expr, Rational, Symbol, Tangent};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::{Code, Diagnostic, Report, most_similar};
use crate::model::bounds::Bound;
use crate::model::charts::Charts;
use crate::model::charts::in_cartesian;
use crate::model::element::Element;
use crate::model::{
    Approximation, Assumption, Body, Circle, Contact, Frame, Model, Output, Pose, PoseId, Space,
    Variable, quaternion, stage,
};
use crate::source::{Files, Sources, Span};
use crate::syntax::{self, Item, Quantity, SectionKind, Spec};

use element::Row;
use expression::HiddenUnit;
use frames::PoseKey;
use layers::Layers;
use names::{Declaration, Group, Member, Namespace};
use outlines::Outline;
use relaxation::RelaxedGuide;
use tables::Tables;
use value::MemberId;
use work::Need;

/// The largest number of nodes that the expressions of one machine may have.
///
/// A chain of ten thousand links has a third of this. A larger machine would take minutes in later
/// stages, and most often comes from a size with a digit too many.
pub const NODE_LIMIT: usize = 500_000;

/// The largest number of parts of expressions that are visited, with families unrolled.
///
/// Members with equal meaning create no new nodes, but visiting them still takes time.
const STEP_LIMIT: usize = 2_000_000;

/// The largest number of constants of the base that a message lists.
const SHOWN_CONSTANTS: usize = 8;

/// The sections that a spec may have, and the meaning of those that hold elements.
#[derive(Clone, Copy)]
pub(crate) struct Language {
    /// All sections, in the order of the reference manual.
    pub sections: &'static [SectionKind],
    /// The sections of elements, in the order in which they are resolved.
    pub elements: &'static [Row],
}

impl Language {
    /// The language of bare values, which has no sections.
    const WITHOUT_SECTIONS: Language = Language {
        sections: &[],
        elements: &[],
    };
}

/// Resolves a spec. Returns a model only if the report has no errors.
pub(crate) fn resolve<'d>(
    spec: Spec,
    language: Language,
    dag: &'d Dag,
    constants: &[(String, Rational)],
    formulas: Vec<Item<Quantity>>,
    (files, sources): (&mut dyn Files, &mut Sources),
    report: &mut Report,
) -> Option<Model<'d>> {
    let mut layers = Layers::load(spec, language.sections, files, sources, report);
    let formula_count = formulas.len();
    if !formulas.is_empty() {
        formulas::add(formulas, &mut layers.specs, report);
    }
    let tables = Tables::load(&layers.specs, files, sources);
    let mut resolver = Resolver::new(&layers, language, dag, constants, report);
    resolver.tables = Some(&tables);
    let mut model = resolver.resolve(&layers.specs)?;
    if !model.sliding().is_empty() {
        // Once more, with displacements; `relaxation` says why this is not the only time. Errors of the same spec were already
        // reported the first time.
        let mut unread = Report::new();
        let mut resolver = Resolver::new(&layers, language, dag, constants, &mut unread);
        resolver.tables = Some(&tables);
        resolver.guides = relaxation::guides(&model);
        resolver.time = model.time;
        resolver.symbols = relaxation::symbols(&model);
        model.relaxed = resolver.resolve(&layers.specs).map(Box::new);
    }
    if !model.charts.is_empty() {
        let cartesian = in_cartesian(&model, formula_count, report)?;
        model.cartesian = Some(Box::new(cartesian));
    }
    Some(model)
}

/// The work in progress.
pub(crate) struct Resolver<'a, 'd, 'r> {
    pub(crate) dag: &'d Dag,
    pub(crate) space: Space,
    language: Language,
    /// The values that the caller sets for constants, and for parameters that would otherwise be derived.
    overrides: &'r [(String, Rational)],
    /// The parameters that the caller will set later.
    given: Vec<String>,
    /// Indices of the declarations of parameters whose values depend on other parameters.
    derived: FxHashSet<usize>,
    report: &'r mut Report,
    /// What was reported where, since all members of a family make the same error.
    reported: FxHashSet<(Span, Code)>,
    /// Quantities after a number whose names are those of units too: the `m` in `2*m` if `m` is a mass.
    hidden_units: Vec<HiddenUnit<'a>>,
    /// Diagnostics of wrong units while a published formula is read; these are not errors of the spec.
    remarks: Option<Vec<Diagnostic>>,
    /// Whether declarations are missing, so that an unknown name need not be reported.
    incomplete: bool,
    layer_count: usize,

    declarations: Vec<Declaration<'a>>,
    groups: Vec<Group<'a>>,
    group_of: FxHashMap<(Namespace, &'a str), usize>,
    members: Vec<Member<'d>>,
    /// The index of each member within its section, once the order is known.
    ordinals: FxHashMap<MemberId, usize>,
    needs: Vec<(Need, Span)>,

    time: Expr<'d>,
    tangent: Option<Tangent<'d>>,
    /// Expressions that are assumed to be nonnegative, with the symbols in them.
    facts: Vec<(Expr<'d>, BTreeSet<Symbol>)>,
    /// The outlines of bodies that have one.
    outlines: Vec<Outline<'d>>,
    poses: Vec<Pose<'d>>,
    pose_of: FxHashMap<PoseKey, PoseId>,
    /// The quaternions that turn frames, and the span where each does so first.
    quaternions: Vec<([Expr<'d>; 4], Span)>,
    /// The guides that are relaxed.
    guides: Vec<RelaxedGuide<'d>>,
    /// Symbols to reuse, by name.
    symbols: FxHashMap<String, Expr<'d>>,

    /// Rotors: bodies that turn and have no position, listed after all bodies.
    rotors: Vec<Body<'d>>,
    /// The tables of the spec, if it is read together with its files.
    tables: Option<&'r Tables>,
    /// Facts that the spec implies but does not state: tables are not evaluated beyond their ends, ropes lie on their pulleys.
    further_facts: Vec<Assumption<'d>>,

    /// The groups that have a member in use.
    used: FxHashSet<usize>,
    /// Bounded numbers.
    bounds: Vec<Bound<'d>>,

    /// The number of nodes before resolution began.
    first_node: usize,
    steps: usize,
    /// Whether a limit was reached, so that nothing more is resolved.
    exhausted: bool,
}

/// What has mass and what acts on it, and the facts that are assumed.
struct Parts<'d> {
    frames: Vec<Frame>,
    bodies: Vec<Body<'d>>,
    elements: Vec<Element<'d>>,
    circles: Vec<Circle<'d>>,
    contacts: Vec<Contact<'d>>,
    assumptions: Vec<Assumption<'d>>,
}

/// What is asked of the machine.
struct Requests<'d> {
    approximations: Vec<Approximation>,
    outputs: Vec<Output<'d>>,
    derivatives: Vec<Variable>,
    stages: crate::model::Stages,
    taylor: Option<Span>,
    charts: Vec<Charts>,
    kept: Vec<Variable>,
}

/// Sets the inertia of the lengths of quaternions, which follows from the rest of the model.
fn give_inertia_to_quaternions(model: &mut Model<'_>) {
    for k in 0..model.quaternions.len() {
        let e = model.quaternions[k].e;
        model.quaternions[k].inertia = quaternion::inertia(model, &e);
    }
}

impl<'a, 'd, 'r> Resolver<'a, 'd, 'r> {
    fn new(
        layers: &Layers,
        language: Language,
        dag: &'d Dag,
        overrides: &'r [(String, Rational)],
        report: &'r mut Report,
    ) -> Self {
        Resolver {
            dag,
            space: space_of(&layers.specs),
            language,
            overrides,
            given: layers
                .specs
                .last()
                .map_or_else(Vec::new, |spec| spec.given.clone()),
            derived: FxHashSet::default(),
            report,
            reported: FxHashSet::default(),
            hidden_units: Vec::new(),
            remarks: None,
            incomplete: layers.incomplete || layers.specs.iter().any(|spec| spec.incomplete),
            layer_count: layers.specs.len(),
            declarations: Vec::new(),
            groups: Vec::new(),
            group_of: FxHashMap::default(),
            members: Vec::new(),
            ordinals: FxHashMap::default(),
            needs: Vec::new(),
            first_node: dag.len(),
            time: dag.symbol("t", stage::TIME),
            tangent: None,
            facts: Vec::new(),
            outlines: Vec::new(),
            poses: Vec::new(),
            pose_of: FxHashMap::default(),
            quaternions: Vec::new(),
            guides: Vec::new(),
            symbols: FxHashMap::default(),
            rotors: Vec::new(),
            tables: None,
            further_facts: Vec::new(),
            used: FxHashSet::default(),
            bounds: Vec::new(),
            steps: 0,
            exhausted: false,
        }
    }

    fn resolve(mut self, layers: &'a [Spec]) -> Option<Model<'d>> {
        use SectionKind::*;
        let machine = layers.last()?;
        self.check_machine(machine, layers);
        self.poses.push(self.ground());
        self.declare_all(layers);
        self.find_derived();
        self.check_overrides(machine);
        self.expand_all();
        // Members are resolved in this order, in which their errors are reported.
        let parameters = self.resolve_each(Parameters, |resolver, member| {
            Some((member, resolver.parameter(member)?))
        });
        let derived_parameters = self.resolve_each(Parameters, Self::derived_parameter);
        let constants = self.resolve_each(Constants, Self::constant);
        let mut coordinates = self.resolve_each(Coordinates, Self::coordinate);
        self.start_rates(layers, &mut coordinates);
        let states = self.states(layers);
        let inputs = self.resolve_each(Inputs, Self::input);
        self.resolve_each(Define, |resolver, member| {
            resolver.definition(member);
            None::<()>
        });
        let mut parts = self.parts(layers);
        let requests = self.requests();
        let destination = self.destination(layers, &coordinates);
        let published = self.published(layers);

        coordinates.extend(states);
        coordinates.extend(self.relaxed_coordinates());
        parts.assumptions.append(&mut self.further_facts);

        let bounds = self.check_bounds(&parts.assumptions, &parameters);
        let quaternions = self.all_quaternions(&coordinates);
        self.check_not_empty(machine);
        if self.report.has_errors() {
            return None;
        }
        self.warn_about_unused(layers);
        let mut model = Model {
            dag: self.dag,
            name: machine.name.text.clone(),
            docs: machine.docs.clone(),
            space: self.space,
            span: machine.name.span,
            time: self.time,
            parameters: parameters.into_iter().map(|(_, of)| of).collect(),
            derived_parameters,
            constants,
            coordinates,
            inputs,
            assumptions: parts.assumptions,
            poses: std::mem::take(&mut self.poses),
            quaternions,
            frames: parts.frames,
            bodies: parts.bodies,
            elements: parts.elements,
            relaxed: None,
            circles: parts.circles,
            contacts: parts.contacts,
            approximations: requests.approximations,
            outputs: requests.outputs,
            derivatives: requests.derivatives,
            stages: requests.stages,
            taylor: requests.taylor,
            projects: false,
            charts: requests.charts,
            cartesian: None,
            uncharted: Vec::new(),
            kept: requests.kept,
            destination,
            published,
            bounds,
            sections: self.sections_of(layers),
        };
        give_inertia_to_quaternions(&mut model);
        self.warn_about_missing_gravity(&model, layers);
        Some(model)
    }

    /// What has mass and what acts on it, and the facts that are assumed.
    fn parts(&mut self, layers: &'a [Spec]) -> Parts<'d> {
        use SectionKind::*;
        let frames = self.resolve_each(Frames, Self::named_frame);
        let mut bodies = self.resolve_each(Bodies, Self::body);
        self.outlines = bodies.iter().enumerate().filter_map(Outline::of).collect();
        let assumptions = self.assumptions(layers);
        let facts = assumptions.iter().map(|fact| fact.excess);
        self.facts = facts.map(|fact| (fact, fact.symbols())).collect();
        let elements = self.elements(layers);
        bodies.append(&mut self.rotors);
        let mut circles = self.resolve_each(Circles, Self::circle);
        circles.extend(self.resolve_each(Spheres, Self::sphere));
        let contacts = self.resolve_each(Contacts, Self::contacts);
        let contacts = contacts.into_iter().flatten().collect();
        Parts {
            frames,
            bodies,
            elements,
            circles,
            contacts,
            assumptions,
        }
    }

    /// What is asked of the machine.
    fn requests(&mut self) -> Requests<'d> {
        use SectionKind::*;
        let approximations = self.resolve_each(Approximations, |resolver, member| {
            Some(resolver.approximation(member))
        });
        let outputs = self.resolve_each(Outputs, Self::output);
        let derivatives = self.variables(Derivatives, Self::differentiated_by);
        let methods = self.resolve_each(Methods, Self::method);
        let stages = self.resolve_each(Stages, |resolver, member| Some(resolver.stage(member)));
        let charts = self.resolve_each(SectionKind::Charts, Self::charts);
        self.check_charts(&charts);
        let kept = self.variables(Keep, Self::kept);
        Requests {
            approximations: approximations.into_iter().flatten().collect(),
            outputs,
            derivatives,
            stages: crate::model::Stages {
                time: stages.iter().any(|stages| stages.time),
                coordinates: stages.iter().any(|stages| stages.coordinates),
            },
            taylor: methods.into_iter().next(),
            charts,
            kept,
        }
    }

    /// Resolves each member of a section, in order.
    fn resolve_each<T>(
        &mut self,
        section: SectionKind,
        resolve: impl Fn(&mut Self, MemberId) -> Option<T>,
    ) -> Vec<T> {
        let members = self.members_of(section);
        members
            .into_iter()
            .filter_map(|member| self.repeat_until_resolved(|resolver| resolve(resolver, member)))
            .collect()
    }

    /// The variables that the members of a section name, each once and in order.
    fn variables(
        &mut self,
        section: SectionKind,
        named: impl Fn(&mut Self, MemberId) -> Vec<Variable>,
    ) -> Vec<Variable> {
        let all = self.resolve_each(section, |resolver, member| Some(named(resolver, member)));
        let all: BTreeSet<Variable> = all.into_iter().flatten().collect();
        all.into_iter().collect()
    }

    /// Unrolls every family, and numbers the members of every section.
    fn expand_all(&mut self) {
        for group in 0..self.groups.len() {
            let span = match self.groups[group].declarations.first() {
                Some(&first) => self.declarations[first].name.span,
                None => continue,
            };
            self.repeat_until_resolved(|resolver| {
                if resolver.groups[group].state != work::State::Done {
                    resolver.need(Need::Group(group), span);
                }
            });
        }
        for section in self.language.sections {
            let mut members = self.members_of(*section);
            members.retain(|&member| !self.is_derived(member));
            for (ordinal, member) in members.into_iter().enumerate() {
                self.ordinals.insert(member, ordinal);
            }
        }
    }

    /// Adds a rotor.
    pub(crate) fn add_rotor(&mut self, rotor: Body<'d>) {
        self.rotors.push(rotor);
    }

    /// The index of a member within its section.
    pub(crate) fn ordinal(&self, member: MemberId) -> Option<usize> {
        self.ordinals.get(&member).copied()
    }

    /// The headings of all sections, each where it occurs first.
    fn sections_of(&self, layers: &[Spec]) -> Vec<(SectionKind, Span)> {
        let heading = |&kind: &SectionKind| {
            let span = layers.iter().find_map(|spec| spec.section(kind))?;
            Some((kind, span))
        };
        self.language.sections.iter().filter_map(heading).collect()
    }

    /// Checks the head of a machine.
    fn check_machine(&mut self, machine: &'a Spec, layers: &'a [Spec]) {
        /// Rust's keywords and primitive types: a type with such a name is not allowed, or hides a
        /// type that every program needs.
        #[rustfmt::skip]
        const NO_TYPE_NAMES: [&str; 71] = [
            "_", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
            "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen",
            "if", "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override",
            "priv", "pub", "ref", "return", "self", "Self", "static", "struct", "super", "trait",
            "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where",
            "while", "yield", "bool", "char", "str", "f32", "f64", "i8", "i16", "i32", "i64",
            "i128", "isize", "u8", "u16", "u32", "u64", "u128", "usize", "union",
        ];
        let name = &machine.name;
        if NO_TYPE_NAMES.contains(&name.text.as_str()) {
            let message = format!("a machine cannot be named `{}`", name.text);
            let diagnostic = Diagnostic::new(Code::MachineName, name.span, message);
            self.push(
                diagnostic.help("it becomes a type in Rust: write it like `VibratingCrusher`"),
            );
        }
        let mut before: Option<syntax::Spanned<syntax::Space>> = None;
        for space in layers.iter().filter_map(|spec| spec.space) {
            if let Some(before) = before.filter(|before| before.value != space.value) {
                let message = "a variant must move in the plane or in space, as its base does";
                let diagnostic = Diagnostic::new(Code::SpaceChanged, space.span, message);
                self.push(diagnostic.note(before.span, "the base declares it here"));
            }
            before = before.or(Some(space));
        }
    }

    /// Checks that the constants set by the caller exist.
    fn check_overrides(&mut self, machine: &'a Spec) {
        if self.incomplete {
            return;
        }
        let is_constant = |(_, declaration): &(usize, &Declaration<'a>)| {
            declaration.section == SectionKind::Constants
        };
        let all = || self.declarations.iter().enumerate();
        let constants: Vec<&'a str> = all()
            .filter(is_constant)
            .map(|(_, declaration)| declaration.name.base.text.as_str())
            .collect();
        let derived: Vec<&'a str> = all()
            .filter(|(place, _)| self.derived.contains(place))
            .map(|(_, declaration)| declaration.name.base.text.as_str())
            .collect();
        for (name, _) in self.overrides {
            let base = name.split('[').next().unwrap_or(name);
            if constants.contains(&base) || derived.contains(&base) {
                continue;
            }
            let message = format!("the machine has no constant `{name}` to set");
            let diagnostic = Diagnostic::new(Code::UnknownName, machine.name.span, message);
            let help = match most_similar(base, constants.iter().copied()) {
                Some(near) => Some(format!("did you mean `{near}`?")),
                None => self.find_group(Namespace::Values, base).map(|group| {
                    let first = self.groups[group].declarations.first();
                    let section = first.map(|&first| self.declarations[first].section);
                    let item = section.map_or("something else", SectionKind::item);
                    format!("`{base}` is {item}")
                }),
            };
            let help = help.or_else(|| {
                let few = (1..=SHOWN_CONSTANTS).contains(&constants.len());
                few.then(|| format!("its constants are `{}`", constants.join("`, `")))
            });
            self.report.push(names::with_help(diagnostic, help)); // each unknown name is an error of its own
        }
    }

    /// Checks that the machine has coordinates and something that moves with them.
    fn check_not_empty(&mut self, machine: &'a Spec) {
        if self.report.has_errors() {
            return; // what seems to be missing may be what could not be read
        }
        let name = &machine.name;
        if self.members_of(SectionKind::Coordinates).is_empty() {
            let message = "this machine has no coordinates";
            let diagnostic = Diagnostic::new(Code::NoCoordinates, name.span, message);
            self.push(diagnostic.help("a coordinate is `coordinates { x: m }`"));
        }
        if self.members_of(SectionKind::Bodies).is_empty() {
            let message = "this machine has no bodies";
            let diagnostic = Diagnostic::new(Code::NoBodies, name.span, message);
            self.push(diagnostic.help("a body is `bodies { cart { mass: m, at: (x, 0) } }`"));
        }
    }

    /// Reports a diagnostic, once at each place.
    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        let about_units = matches!(diagnostic.code, Code::UnitMismatch | Code::UnitOfPower);
        match &mut self.remarks {
            Some(remarks) if about_units => remarks.push(diagnostic),
            _ => {
                if self.reported.insert((diagnostic.span, diagnostic.code)) {
                    self.report.push(diagnostic);
                }
            }
        }
    }

    /// Reports an error that needs no further explanation.
    pub(crate) fn error(&mut self, code: Code, span: Span, message: impl Into<String>) {
        self.push(Diagnostic::new(code, span, message));
    }

    /// Counts a step of work; returns false if a limit is reached.
    fn step(&mut self, span: Span) -> bool {
        if self.exhausted {
            return false;
        }
        self.steps += 1;
        if self.steps > STEP_LIMIT || self.dag.len() - self.first_node > NODE_LIMIT {
            self.exhausted = true;
            let message = "the formulas of this machine are too large";
            let diagnostic = Diagnostic::new(Code::TooLarge, span, message);
            let help =
                format!("with every family unrolled they may have at most {NODE_LIMIT} terms");
            self.push(diagnostic.help(help));
        }
        !self.exhausted
    }
}

/// Plane or space, as given by the first layer that says it.
fn space_of(layers: &[Spec]) -> Space {
    let written = layers.iter().find_map(|spec| spec.space);
    match written.map(|space| space.value) {
        Some(syntax::Space::Space) => Space::Space,
        _ => Space::Plane, // if no layer says it, the parser has reported that
    }
}
