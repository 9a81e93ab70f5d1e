//! Refuses machines that cannot be derived, and says why.

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_symbolic::Expr;

use super::Equations;
use super::constraints::{self, ConstraintEquation};
use super::kinematics::Variables;
use super::sliding::MOST_CONTACTS;
use super::symmetric::Symmetric;
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::polygons::Corner;
use lagrangian_spec::model::{
    Circle, Contact, ContactGeometry, FrameOrBody, ImpactLaw, MOST_UNILATERAL, Model, Name,
    Painleve, Rotation, Space, Surface, Touching, circles,
};
use lagrangian_spec::source::Span;
use lagrangian_spec::syntax::SectionKind;

/// Refuses what is understood but not derived yet, with one message for each section. Returns true
/// if anything is refused. Circles alone are geometry: they add nothing to the equations, and
/// reports draw them.
pub(super) fn refuse_unsupported(model: &Model<'_>, report: &mut Report) -> bool {
    let refused = refuse_contacts(model, report);
    refuse_sliding(model, report) || refused
}

/// Reports what is refused.
struct Refusals<'r> {
    report: &'r mut Report,
    /// Whether anything was refused.
    any: bool,
}

impl<'r> Refusals<'r> {
    fn new(report: &'r mut Report) -> Self {
        Refusals { report, any: false }
    }

    fn refuse(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let diagnostic = Diagnostic::new(code, span, message.into());
        self.report.push(diagnostic.help(help.into()));
        self.any = true;
    }

    /// Refuses the sections that guides are not derived with.
    fn refuse_sections(&mut self, model: &Model<'_>) {
        let sections = [
            (SectionKind::Approximations, model.approximations.is_empty()),
            (SectionKind::Derivatives, model.derivatives.is_empty()),
            (SectionKind::Stages, model.stages.is_empty()),
        ];
        for (section, _) in sections.into_iter().filter(|(_, is_empty)| !is_empty) {
            let span = model.section(section).unwrap_or(model.span);
            let message = format!("`{section}` of a machine with `sliding` cannot be derived yet");
            let help = format!("without `{section}`, or without `sliding`, it can be derived");
            self.refuse(Code::NotSupported, span, message, help);
        }
    }
}

/// Refuses what is not yet supported together with unilateral contacts. Returns true if anything is refused.
fn refuse_contacts(model: &Model<'_>, report: &mut Report) -> bool {
    if model.contacts.is_empty() {
        return false;
    }
    let mut refusals = Refusals::new(report);
    if let Some(sliding) = model.sliding().first() {
        refuse_guides_beside_contacts(model, sliding, &mut refusals);
    }
    let contacts = model.contacts.iter();
    for contact in contacts.filter(|c| c.has_two_tangents(model.space)) {
        refuse_laws_of_two_tangents(contact, &mut refusals);
    }
    let contacts = model.contacts.iter();
    for contact in contacts.filter(|c| c.rolling_resistance.is_some()) {
        refuse_laws_of_rolling_resistance(contact, &mut refusals);
        if let ContactGeometry::Circles(touching) = &contact.geometry {
            refuse_circles_that_do_not_turn(model, contact.span, touching, &mut refusals);
        }
    }
    refuse_many_contacts(model, &mut refusals);
    refuse_different_impacts(model, &mut refusals);
    refusals.any
}

/// Refuses what guides beside unilateral contacts do not support.
fn refuse_guides_beside_contacts(
    model: &Model<'_>,
    first: &Sliding<'_>,
    refusals: &mut Refusals<'_>,
) {
    if model.space == Space::Space {
        let message = "in space `sliding` of a machine with `contacts` cannot be derived yet";
        let help =
            "in the plane it can be derived; in space without `sliding`, or without `contacts`";
        refusals.refuse(Code::NotSupported, first.span, message, help);
    }
    for contact in &model.contacts {
        if contact.response.painleve() == Painleve::Impact {
            let message = "`painleve: impact` does not support `sliding`";
            let help =
                "leave it out: the run then ends with an error where friction admits no motion";
            refusals.refuse(Code::NotSupported, contact.span, message, help);
        }
    }
}

/// Refuses the laws that friction along two tangents does not support.
fn refuse_laws_of_two_tangents(contact: &Contact<'_>, refusals: &mut Refusals<'_>) {
    let law = contact.response.impact_law();
    if let Some(law @ (ImpactLaw::Poisson | ImpactLaw::Stronge)) = law {
        let message = format!("`law: {}` with friction is for the plane only", law.name());
        let help = "Routh's path along two tangents has no closed form: the laws `newton` and `poisson_glocker` support them";
        refusals.refuse(Code::NotSupported, contact.span, message, help);
    }
    if contact.response.painleve() == Painleve::Impact {
        let message = "`painleve: impact` is for contacts with one direction of slip";
        let help = "leave it out: the run then ends with an error where friction admits no motion";
        refusals.refuse(Code::NotSupported, contact.span, message, help);
    }
}

/// Refuses the laws that rolling resistance does not support.
fn refuse_laws_of_rolling_resistance(contact: &Contact<'_>, refusals: &mut Refusals<'_>) {
    let law = contact.response.impact_law();
    if let Some(law @ (ImpactLaw::Poisson | ImpactLaw::Stronge)) = law {
        let message = format!(
            "`law: {}` does not support `rolling_resistance`",
            law.name()
        );
        let help = "Routh's path is that of one point, which slips: the laws `newton` and `poisson_glocker` support it";
        refusals.refuse(Code::NotSupported, contact.span, message, help);
    }
    if contact.response.painleve() == Painleve::Impact {
        let message = "`painleve: impact` does not support `rolling_resistance`";
        let help = "leave out one of the two";
        refusals.refuse(Code::NotSupported, contact.span, message, help);
    }
}

/// Refuses rolling resistance between circles that do not turn relative to each other.
fn refuse_circles_that_do_not_turn(
    model: &Model<'_>,
    span: Span,
    touching: &Touching,
    refusals: &mut Refusals<'_>,
) {
    let x = Variables::of(model);
    let rate = circles::rolling_rate(model, touching, &mut x.without_acceleration(model));
    if identity::is_zero(rate) == Some(true) {
        let message = "neither of these circles turns";
        let help = "`rolling_resistance` resists turning: give the body an `angle`";
        refusals.refuse(Code::MissingRotation, span, message, help);
    }
}

/// Refuses more than [`MOST_UNILATERAL`] contacts, at the first one too many. Rolling resistance and second tangents count as
/// contacts.
fn refuse_many_contacts(model: &Model<'_>, refusals: &mut Refusals<'_>) {
    let has_rolling_resistance = |c: &Contact<'_>| c.rolling_resistance.is_some();
    let further = |contact: &Contact<'_>| {
        usize::from(has_rolling_resistance(contact))
            + usize::from(contact.has_two_tangents(model.space))
    };
    let further: usize = model.contacts.iter().map(further).sum();
    let most = MOST_UNILATERAL - further.min(MOST_UNILATERAL);
    if let Some(contact) = model.contacts.get(most) {
        let count = model.contacts.len() + further;
        let message = format!("{count} unilateral contacts are too many");
        let help = format!("a machine may have at most {MOST_UNILATERAL} of them");
        refusals.refuse(Code::TooLarge, contact.span, message, help);
    }
}

/// Refuses contacts that may take part in the same impact and have different laws, or different orders of impacts.
fn refuse_different_impacts(model: &Model<'_>, refusals: &mut Refusals<'_>) {
    let mut bouncing = (model.contacts.iter())
        .filter_map(|contact| Some((contact, contact.response.impact_law()?)));
    if let Some((first, law)) = bouncing.next()
        && let Some((other, of_other)) = bouncing.find(|(_, of_other)| *of_other != law)
    {
        let message = format!(
            "`{}` has the law `{}` and `{}` the law `{}`",
            first.name,
            law.name(),
            other.name,
            of_other.name()
        );
        let help = "contacts that may take part in the same impact must have the same `law`";
        refusals.refuse(Code::ConflictingFields, other.span, message, help);
    }
    let mut bouncing =
        (model.contacts.iter()).filter_map(|contact| Some((contact, contact.response.order()?)));
    if let Some((first, order)) = bouncing.next()
        && let Some((other, _)) = bouncing.find(|(_, of_other)| *of_other != order)
    {
        let message = format!(
            "`{}` and `{}` take part in impacts in different orders",
            first.name, other.name
        );
        let help = "contacts that may take part in the same impact must have the same `order`";
        refusals.refuse(Code::ConflictingFields, other.span, message, help);
    }
}

/// Refuses what is not yet supported together with friction. Returns true if anything is refused.
fn refuse_sliding(model: &Model<'_>, report: &mut Report) -> bool {
    let sliding = model.sliding();
    let Some(first) = sliding.first() else {
        return false;
    };
    let mut refusals = Refusals::new(report);
    for contact in sliding
        .iter()
        .filter(|s| model.space == Space::Space && s.normal.is_some() && s.tangent.is_none())
    {
        let message = "in space a guide has no sides, and therefore no normal";
        let help = "leave `normal` out: along a curve the reaction is a vector, in any direction across; or leave `direction` out: then the body \
             slides on a surface";
        refusals.refuse(Code::NotSupported, contact.span, message, help);
    }
    refusals.refuse_sections(model);
    if let Some(contact) = sliding.get(MOST_CONTACTS) {
        let count = sliding.len();
        let message = format!("{count} contacts that stick or slide are too many");
        let help = if sliding.iter().any(|s| s.is_second()) {
            format!(
                "a machine may have at most {MOST_CONTACTS} of them, and a surface counts as two"
            )
        } else {
            format!("a machine may have at most {MOST_CONTACTS} of them")
        };
        refusals.refuse(Code::TooLarge, contact.span, message, help);
    }
    match &model.relaxed {
        Some(relaxed) => refuse_shared_loads(model, relaxed, &mut refusals),
        None => {
            let message = "the equations of this machine with its guides relaxed are too large";
            let help = "they are derived a second time, with one more coordinate for each component of a displacement";
            refusals.refuse(Code::TooLarge, first.span, message, help);
        }
    }
    refusals.any
}

/// Refuses what holds a guided body exactly where its guide holds it, as a wheel that always touches the ground does. It is a
/// constraint of the machine with its guides relaxed, but none of the machine itself, so that it has no multiplier.
fn refuse_shared_loads(model: &Model<'_>, relaxed: &Model<'_>, refusals: &mut Refusals<'_>) {
    let own = model.constraints();
    let is_own = |name: &Name| own.iter().any(|constraint| constraint.name == *name);
    let mut shared = relaxed.constraints().into_iter();
    if let Some(constraint) = shared.find(|one| !is_own(&one.name)) {
        let name = &constraint.name;
        let message = format!(
            "`{name}` holds what a guide holds already: the load of each is not determined"
        );
        let help = "leave out one of the two";
        refusals.refuse(Code::Untied, constraint.span, message, help);
    }
}

/// Refuses bodies that roll or rub without a given orientation. Returns true if anything is refused.
pub(super) fn refuse_unoriented(model: &Model<'_>, report: &mut Report) -> bool {
    let mut refused = false;
    let mut refuse = |circle: &Circle<'_>, surface: Surface, span: Span| {
        let other = match surface {
            Surface::Inside(other) | Surface::Outside(other) => Some(&model.circles[other]),
            Surface::Along(_) => None,
        };
        for circle in [Some(circle), other].into_iter().flatten() {
            let FrameOrBody::Body(body) = circle.on else {
                continue;
            };
            let body = &model.bodies[body];
            let in_space = model.space == Space::Space;
            // In space an angle turns a rotor, about an axis that contacts do not know.
            let is_rotor = in_space && matches!(body.rotation, Rotation::Angle(_));
            if matches!(body.rotation, Rotation::Unspecified) || is_rotor {
                let message = format!("the rotation of the body `{}` is not given", body.name);
                let help = if in_space {
                    format!("`{}` is on it: give it a `frame`", circle.name)
                } else {
                    format!(
                        "the circle `{}` is on it: give it an `angle` or a `frame`",
                        circle.name
                    )
                };
                report.push(Diagnostic::new(Code::MissingRotation, span, message).help(help));
                refused = true;
            }
        }
    };
    for rolling in model.rolling() {
        let Touching { circle, surface } = rolling.circles;
        refuse(&model.circles[circle], surface, rolling.span);
    }
    for contact in &model.contacts {
        match &contact.geometry {
            ContactGeometry::Circles(Touching { circle, surface })
                if contact.friction.is_some() =>
            {
                refuse(&model.circles[*circle], *surface, contact.span);
            }
            // The position of a point of a body depends on its orientation, with or without friction.
            ContactGeometry::Point { point, surface } => refuse(point, *surface, contact.span),
            ContactGeometry::Circles(_)
            | ContactGeometry::Corner(_)
            | ContactGeometry::Expressions { .. } => {}
        }
    }
    refuse_unoriented_polygons(model, report) || refused
}

/// Refuses polygons on bodies without a given orientation, once for each pair. Returns true if anything is refused.
fn refuse_unoriented_polygons(model: &Model<'_>, report: &mut Report) -> bool {
    let mut refused = false;
    for contact in &model.contacts {
        let ContactGeometry::Corner(Corner {
            corner,
            polygon: own,
            ..
        }) = &contact.geometry
        else {
            continue;
        };
        // Each polygon is checked at the contact of its own first corner.
        let (0, FrameOrBody::Body(body)) = (*corner, own.on) else {
            continue;
        };
        let body = &model.bodies[body];
        if matches!(body.rotation, Rotation::Unspecified) {
            let message = format!("the rotation of the body `{}` is not given", body.name);
            let help = "corners are on it: give it an `angle` or a `frame`";
            report.push(Diagnostic::new(Code::MissingRotation, contact.span, message).help(help));
            refused = true;
        }
    }
    refused
}

/// The largest number of coordinates of a machine: with 256 the mass matrix has 32 896 different
/// entries, and eliminating it takes three million operations.
pub const MOST_COORDINATES: usize = 256;

/// The largest number of nodes and operands of the expressions of a machine: including everything made from them on
/// the way to a program, each takes 100 to 350 bytes and some 2 µs, so a gigabyte and 10 s suffice.
pub(super) const MOST_SIZE: usize = 2_500_000;

/// Refuses machines of more than [`MOST_COORDINATES`] coordinates, at the first one too many.
/// Returns true if refused.
pub(super) fn refuse_many_coordinates(model: &Model<'_>, report: &mut Report) -> bool {
    let Some(coordinate) = model.coordinates.get(MOST_COORDINATES) else {
        return false;
    };
    let count = model.coordinates.len();
    let message = format!("equations of {count} coordinates are too large to be derived");
    let help = format!("a machine may have at most {MOST_COORDINATES} coordinates");
    report.push(Diagnostic::new(Code::TooLarge, coordinate.span, message).help(help));
    true
}

/// The largest number of constraint equations; rolling circles count two each.
const MOST_CONSTRAINTS: usize = 256;

/// Refuses machines of more than [`MOST_CONSTRAINTS`] constraints, at the first one too many.
/// Returns true if refused.
pub(super) fn refuse_many_constraints(model: &Model<'_>, report: &mut Report) -> bool {
    let spans = constraints::spans(model);
    let Some(&span) = spans.get(MOST_CONSTRAINTS) else {
        return false;
    };
    let message = format!("{} constraint equations are too many", spans.len());
    let help = format!("a machine may have at most {MOST_CONSTRAINTS} of them");
    report.push(Diagnostic::new(Code::TooLarge, span, message).help(help));
    true
}

/// Reports that the equations are too large.
pub(crate) fn refuse_large(model: &Model<'_>, report: &mut Report) {
    let message = "the equations of this machine are too large to be derived";
    let help = format!("written out they may have at most {MOST_SIZE} terms and factors");
    report.push(Diagnostic::new(Code::TooLarge, model.span, message).help(help));
}

/// Reports that the equations are too large with the contacts up to this one.
pub(super) fn refuse_large_contact(model: &Model<'_>, contact: &Contact<'_>, report: &mut Report) {
    let message = format!(
        "the gaps and slips of {} unilateral contacts are too large to be derived; those up to `{}` are as large as is possible",
        model.contacts.len(),
        contact.name
    );
    let help = format!(
        "written out, the equations of a machine may have at most {MOST_SIZE} terms and factors: make fewer contacts, or simpler ones"
    );
    report.push(Diagnostic::new(Code::TooLarge, contact.span, message).help(help));
}

/// Refuses equations that contain an undefined value. Returns true if refused.
pub(super) fn refuse_undefined(
    model: &Model<'_>,
    equations: &Equations<'_>,
    report: &mut Report,
) -> bool {
    let energies = [
        ("kinetic energy", equations.kinetic_energy),
        ("potential energy", equations.potential_energy),
        ("dissipation", equations.dissipation),
    ];
    let slopes = equations.residual_derivatives.iter().flatten();
    let undefined = energies.iter().find(|(_, energy)| energy.is_undefined());
    let all = equations.forces.iter().chain(equations.mass_matrix.lower());
    let subject = match undefined {
        Some((name, _)) => format!("the {name}"),
        None if all.clone().any(|entry| entry.is_undefined()) => "an equation of motion".to_owned(),
        None if slopes.clone().any(|entry| entry.is_undefined()) => {
            "a derivative of an acceleration".to_owned()
        }
        None => return false,
    };
    let diagnostic = match model.approximations.first() {
        Some(approximation) => {
            let name = &model.coordinates[approximation.coordinate].name;
            let message = format!("{subject} has no expansion about `{name} = 0`");
            Diagnostic::new(Code::NoExpansion, approximation.span, message)
                .help("a distance that vanishes there has a kink: treat the coordinate exactly")
        }
        None => Diagnostic::new(
            Code::Undefined,
            model.span,
            format!("{subject} has no value"),
        )
        .help("something divides by zero, or takes a root or a logarithm that does not exist"),
    };
    report.push(diagnostic);
    true
}

/// Refuses coordinates that can move without moving any inertia and that no constraint stops: they
/// have no accelerations. Returns true if refused.
pub(super) fn refuse_massless<'d>(
    model: &Model<'d>,
    mass_matrix: &Symmetric<Expr<'d>>,
    constraints: &[ConstraintEquation<'d>],
    report: &mut Report,
) -> bool {
    let n = model.coordinates.len();
    let row = |i: usize| (0..n).map(move |j| *mass_matrix.get(i, j)).collect();
    let rows = constraints.iter().map(|constraint| constraint.row.clone());
    let rows: Vec<Vec<Expr<'d>>> = (0..n).map(row).chain(rows).collect();
    let free = identity::null_space(model.dag, &rows).unwrap_or_default();
    for direction in &free {
        let moving = (0..n).filter(|&i| direction[i] != Residue::ZERO);
        let moving: Vec<usize> = moving.collect();
        let names: Vec<String> = moving
            .iter()
            .map(|&i| format!("`{}`", model.coordinates[i].name))
            .collect();
        let Some((&last, name)) = moving.last().zip(names.last()) else {
            continue;
        };
        let (message, help) = match &names[..] {
            [_] => (
                format!("no body's motion depends on {name}: its equation has no acceleration"),
                format!("give a body that {name} moves a mass, or an inertia if it turns one"),
            ),
            all => (
                format!(
                    "no body's motion depends on how {} change together: their equations have no accelerations of their own",
                    all.join(", ")
                ),
                format!(
                    "leave {name} out, or give a mass to a body that it moves differently from how these move it together"
                ),
            ),
        };
        let span = model.coordinates[last].span;
        report.push(Diagnostic::new(Code::NoInertia, span, message).help(help));
    }
    !free.is_empty()
}

/// Refuses contacts of a machine with coordinates that move no mass and that constraints determine: what contact forces do follows from
/// the inverse of the mass matrix alone, which does not exist. Returns true if refused.
pub(super) fn refuse_massless_contacts<'d>(
    model: &Model<'d>,
    mass_matrix: &Symmetric<Expr<'d>>,
    report: &mut Report,
) -> bool {
    let Some(contact) = model.contacts.first() else {
        return false;
    };
    let n = model.coordinates.len();
    let row = |i: usize| (0..n).map(move |j| *mass_matrix.get(i, j)).collect();
    let rows: Vec<Vec<Expr<'d>>> = (0..n).map(row).collect();
    let free = identity::null_space(model.dag, &rows).unwrap_or_default();
    let moves = |i: &usize| free.iter().any(|direction| direction[*i] != Residue::ZERO);
    let moving: Vec<usize> = (0..n).filter(moves).collect();
    let Some(last) = moving.last() else {
        return false;
    };
    let names = moving
        .iter()
        .map(|i| format!("`{}`", model.coordinates[*i].name));
    let names: Vec<String> = names.collect();
    let all = names.join(", ");
    let (subject, them) = match names.len() {
        1 => (format!("the coordinate {all}, which moves no mass,"), "it"),
        _ => (
            format!("the coordinates {all}, which can change without moving any mass,"),
            "them",
        ),
    };
    let message = format!("`contacts` of a machine with {subject} cannot be derived yet");
    let help = format!(
        "give an inertia to what {all} turns or moves, or describe the machine without {them}"
    );
    let diagnostic = Diagnostic::new(Code::NotSupported, contact.span, message).help(help);
    let place = model.coordinates[*last].span;
    report.push(diagnostic.note(place, "constraints determine it, but no mass"));
    true
}
