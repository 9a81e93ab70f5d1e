//! Guided contacts with Coulomb friction: their slip velocities and normal reactions.
//!
//! ```text
//! slip             w = e·(ẋ_body − ẋ_on − ω_on×r) = τ v + b(q, t),   τ = ∂w/∂v         (E32)
//! normal reaction  N = n·(M a − f − Gᵀλ − Σ τᵀF)_δ                                      (E33)
//!                    = ν + ρ·a + χ·λ + Σ κ F
//! friction         F = −μ |N| sgn w while it slides, |F| ≤ μ₀ |N| while it sticks       (E34)
//!                  M a = f + Gᵀλ + Σ τᵀ F
//! ```
//!
//! The reaction is found by releasing the guide: δ displaces the body with everything built on its frame, and the row of δ in
//! Lagrange's equations gives the force along δ that keeps it at zero. It depends on the accelerations, so friction changes the
//! matrix in front of them. Displacements δ are in ground axes. In the plane only the row along the normal `n` is needed, where
//! `n` is `e` turned left. In space a guide holds its body in two directions, and all three rows are used: the reaction is a
//! vector in ground axes. Forces along the guide that are written in coordinates appear in its component along `e`; `|N|` is
//! the length of the rest.
//!
//! On a surface in space, which holds a body from both sides, the slip has two components (E76). They are two contacts, one
//! after the other, with one displacement and one reaction.
//!
//! If several guides hold one body, each displacement is opposed by the reactions of all of them: the
//! rows are solved for the reactions here, symbolically. Guides that constrain the same displacement
//! cannot be told apart, and are refused.

use lagrangian_symbolic::{Expr, Tangent, substitute};

use super::carrying;
use super::constraints;
use super::guide::{Guide, base, dot, guide, is_zero, relative, unit};
use super::kinematics::{Variables, cross, gradient};
use super::projected::Projection;
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::{self, Sliding};
use lagrangian_spec::model::{Model, Space, stage};

/// The largest number of contacts of a machine: which of them are second tangents of surfaces is a mask of 64 bits, and the response to the
/// friction of each contact is evaluated in every step.
pub const MOST_CONTACTS: usize = 64;

/// A guided contact with Coulomb friction.
#[derive(Clone, Debug)]
pub struct SlidingEquation<'d> {
    /// Its name.
    pub name: String,
    /// `w(q, v, t)`, in m/s: the velocity of the body along the direction, minus that of its base.
    pub slip: Expr<'d>,
    /// `τ(q, t) = ∂w/∂v`.
    pub row: Vec<Expr<'d>>,
    /// `dw/dt` at `a = 0`.
    pub bias: Expr<'d>,
    /// The direction `e(q, t)`, of length 1.
    pub direction: Vec<Expr<'d>>,
    /// The normal `n(q, t)` of the surface on which it slides, of any length, and which of its tangents the direction is; none
    /// if it slides along a line or a curve.
    pub surface: Option<(Vec<Expr<'d>>, element::SurfaceTangent)>,
    /// The components of the normal reaction: one in the plane, along the normal; three in space, in ground axes.
    pub reactions: Vec<Reaction<'d>>,
    /// `μ`.
    pub friction: Expr<'d>,
    /// `μ₀`, which applies while it sticks.
    pub static_friction: Expr<'d>,
}

/// A component of a normal reaction, as a linear form.
#[derive(Clone, Debug)]
pub struct Reaction<'d> {
    /// `ν(q, v, t, u)`, in N: its value without accelerations.
    pub load: Expr<'d>,
    /// `ρ(q, t)`, the coefficients of the accelerations.
    pub by_accelerations: Vec<Expr<'d>>,
    /// `χ(q, t)`, the coefficients of the multipliers of the constraints.
    pub by_multipliers: Vec<Expr<'d>>,
    /// `κ(q, t)`, the coefficients of the friction forces of the contacts.
    pub by_friction_forces: Vec<Expr<'d>>,
    /// The coefficients of the forces of unilateral contacts, two of each: along its normal and along its tangent. Beside unilateral contacts
    /// guides are contacts behind them, and friction forces stand here.
    pub by_contact_forces: Vec<Expr<'d>>,
}

impl<'d> SlidingEquation<'d> {
    /// The unit vector that determines the pressing part of the reaction: the normal of a surface, along which all of it presses, or
    /// the tangent of a curve, along which nothing presses.
    pub fn reference_direction(&self) -> Vec<Expr<'d>> {
        match &self.surface {
            Some((normal, _)) => unit(normal),
            None => self.direction.clone(),
        }
    }

    /// Whether it is the second tangent of the surface of the preceding contact.
    pub fn is_second(&self) -> bool {
        matches!(self.surface, Some((_, element::SurfaceTangent::Second)))
    }

    /// The components of the normal reaction over the symbols of the accelerations and of the multipliers, in their order: in space
    /// three in ground axes, and on a surface one, along its normal. The friction of other contacts is left out; the contact's own
    /// friction acts along the direction and has no component in it.
    pub fn normal(&self, model: &Model<'d>, multipliers: &[Expr<'d>]) -> Vec<Expr<'d>> {
        let dag = model.dag;
        // With accelerations of an arbitrary motion the vector has a component along the direction in
        // space, the friction.
        let across = |part: Vec<Expr<'d>>| {
            if part.len() == 1 {
                return part;
            }
            if self.surface.is_some() {
                let mut part = vec![dot(&self.reference_direction(), &part)];
                identity::remove_spurious_symbols(dag, &mut part);
                return part;
            }
            let along = dot(&self.direction, &part);
            let pairs = part.into_iter().zip(&self.direction);
            let mut part: Vec<Expr<'d>> = pairs.map(|(x, &e)| x - along * e).collect();
            identity::remove_spurious_symbols(dag, &mut part);
            part
        };
        let part = |of: &dyn Fn(&Reaction<'d>) -> Expr<'d>| {
            across(self.reactions.iter().map(of).collect())
        };
        let load = part(&|reaction| reaction.load);
        let inertia = model.coordinates.iter().enumerate();
        let inertia = inertia.map(|(i, c)| (c.a, part(&|reaction| reaction.by_accelerations[i])));
        let held = multipliers.iter().enumerate();
        let held = held.map(|(i, &by)| (by, part(&|reaction| reaction.by_multipliers[i])));
        let parts: Vec<(Expr<'d>, Vec<Expr<'d>>)> = inertia.chain(held).collect();
        let sum = |(axis, load): (usize, Expr<'d>)| {
            let terms = parts.iter().map(|(by, part)| *by * part[axis]);
            dag.sum(std::iter::once(load).chain(terms))
        };
        load.into_iter().enumerate().map(sum).collect()
    }

    /// The pressing force in a machine without constraints and with friction left out, over the symbols of the
    /// accelerations: the normal reaction in the plane, its magnitude in space.
    pub fn pressing(&self, model: &Model<'d>) -> Expr<'d> {
        match &self.normal(model, &[])[..] {
            [normal] => *normal,
            all => model.dag.sum(all.iter().map(|one| one.square())).sqrt(),
        }
    }
}

impl<'d> Reaction<'d> {
    /// The coefficients, in the order in which a program states them.
    pub fn coefficients(&self) -> impl Iterator<Item = Expr<'d>> {
        let lists = [
            &self.by_accelerations,
            &self.by_multipliers,
            &self.by_friction_forces,
            &self.by_contact_forces,
        ];
        lists.into_iter().flatten().copied()
    }

    /// The same reaction where guides are contacts behind the others, whose forces along their normals it does not depend on.
    pub(super) fn with_friction_of_contacts(mut self, zero: Expr<'d>) -> Self {
        let by_friction = std::mem::take(&mut self.by_friction_forces);
        let of_guides = by_friction.into_iter().flat_map(|by| [zero, by]);
        self.by_contact_forces.extend(of_guides);
        self
    }

    fn parts(&mut self) -> impl Iterator<Item = &mut Expr<'d>> {
        let lists = self
            .by_accelerations
            .iter_mut()
            .chain(&mut self.by_multipliers)
            .chain(&mut self.by_friction_forces)
            .chain(&mut self.by_contact_forces);
        std::iter::once(&mut self.load).chain(lists)
    }
}

/// The contacts of a machine; nothing, and a message for each reason, if a guide is invalid or its
/// reaction is undetermined. `of_contacts` are the rows of all directions of the unilateral contacts of the relaxed machine.
pub(super) fn sliding<'d>(
    model: &Model<'d>,
    of_contacts: &[Vec<Expr<'d>>],
    report: &mut Report,
) -> Option<Vec<SlidingEquation<'d>>> {
    let all = model.sliding();
    if all.is_empty() {
        return Some(Vec::new());
    }
    let guides: Vec<Guide<'d>> = all.iter().map(|s| guide(model, s)).collect();
    let mut refused = false;
    for (sliding, guide) in all.iter().zip(&guides) {
        if let Some(diagnostic) = guide_error(model, sliding, guide) {
            report.push(diagnostic);
            refused = true;
        }
    }
    if refused {
        return None;
    }
    let x = Variables::of(model);
    let relaxed = model.relaxed.as_deref()?;
    let reactions = Reactions::of(model, relaxed, &guides, of_contacts);
    let Some(solved) = reactions.solved() else {
        let names = all.iter().filter(|s| !s.is_second());
        let names = names.map(|s| format!("`{}`", s.name));
        let names = names.collect::<Vec<_>>().join(", ");
        let message = format!("what each of {names} carries is not determined");
        let diagnostic = Diagnostic::new(Code::NoGuide, all[0].span, message);
        report.push(diagnostic.help(match model.space {
            Space::Plane => "guides that hold a body in the same direction share its load in unknown proportions: declare only one of them",
            Space::Space => "in space a body has one guide, a curve or a surface: for something that slides at several places declare a body at each, and connect them by `constraints`",
        }));
        return None;
    };
    if carrying::refuse_undetermined_reactions(model, report) {
        return None;
    }
    let mut coasting = x.without_acceleration(model);
    let mut equations = Vec::with_capacity(guides.len());
    let mut solved = solved.into_iter();
    for (sliding, guide) in all.iter().zip(&guides) {
        let slip = relative(model, sliding, guide, &mut coasting).slip;
        let (slip, row) = simplified(model, &x, slip);
        let reactions = if sliding.is_second() {
            // Both tangents share one reaction.
            equations
                .last()
                .map_or_else(Vec::new, |first: &SlidingEquation<'d>| {
                    first.reactions.clone()
                })
        } else {
            solved.by_ref().take(guide.axes.len()).collect()
        };
        equations.push(SlidingEquation {
            name: sliding.name.to_string(),
            slip,
            row,
            bias: coasting.of(slip),
            direction: guide.along.clone(),
            surface: (sliding.normal.clone().zip(sliding.tangent)),
            reactions,
            friction: sliding.friction,
            static_friction: sliding.static_friction.unwrap_or(sliding.friction),
        });
    }
    Some(equations)
}

/// A slip and its derivatives by the rates. Constant or zero parts are written as constants: a body at
/// rest on a moving rail has the slip 0, and not the round-off of differences.
fn simplified<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    slip: Expr<'d>,
) -> (Expr<'d>, Vec<Expr<'d>>) {
    let dag = model.dag;
    let derived = gradient(dag, slip, &x.v);
    let at_rest: Vec<_> = x.v.iter().map(|&v| (v, dag.zero())).collect();
    let of_base = substitute(dag, &[slip], &at_rest)[0];
    let mut parts: Vec<Expr<'d>> = derived.iter().copied().chain([of_base]).collect();
    identity::remove_spurious_symbols(dag, &mut parts);
    let rows = &parts[..x.v.len()];
    let is_constant = rows.iter().all(|entry| entry.stage() <= stage::PARAMETER);
    if !is_constant && rows == &derived[..] && parts[x.v.len()] == of_base {
        return (slip, derived);
    }
    let of_base = parts.pop().unwrap_or(dag.zero());
    let rates = model.coordinates.iter().zip(&parts);
    let rates = rates.map(|(coordinate, &entry)| entry * coordinate.v);
    (dag.sum(rates.chain([of_base])), parts)
}

/// Why a contact is not a valid guide.
fn guide_error<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    guide: &Guide<'d>,
) -> Option<Diagnostic> {
    let name = &sliding.name;
    let error = |message: String, help: &str| {
        Some(Diagnostic::new(Code::NoGuide, sliding.span, message).help(help))
    };
    if let (Some(tangent), Some(normal)) = (sliding.tangent, &sliding.normal) {
        return match tangent {
            element::SurfaceTangent::First => surface_error(model, sliding, normal),
            // It was reported for the first tangent.
            element::SurfaceTangent::Second => None,
        };
    }
    if is_zero(model.dag.sum(sliding.direction.iter().map(|x| x.square()))) {
        return error(
            format!("the direction of `{name}` has no length"),
            "it is the direction in which the body slides",
        );
    }
    if let Some(normal) = &sliding.normal
        && !is_zero(dot(normal, &guide.along))
    {
        return error(
            format!("the normal of `{name}` is not at a right angle to its direction"),
            "it only determines on which side of the guide the body is",
        );
    }
    let mut coasting = Variables::of(model).without_acceleration(model);
    let relative = relative(model, sliding, guide, &mut coasting);
    let (slip, off) = (
        relative.slip,
        across(&sliding.direction, &relative.normal_velocity),
    );
    if !off.into_iter().all(is_zero) {
        return error(
            format!("the coordinates let the body of `{name}` leave its guide"),
            "the origin of its frame, or the mass centre of a body without one, may move only along the direction, relative to what it slides on",
        );
    }
    if is_zero(slip) {
        return error(
            format!(
                "the body of `{name}` does not slide: no coordinate moves it along the direction"
            ),
            "friction acts only where something moves or could move",
        );
    }
    if is_only_guide(model, sliding) && is_base_motion(model, sliding, slip, &mut coasting) {
        return error(
            format!("the body of `{name}` is held by more than this guide"),
            FURTHER_GUIDES_HELP,
        );
    }
    None
}

const FURTHER_GUIDES_HELP: &str = "its position on the guide follows from the motion of the guide: declare under `sliding` the other guides in which it slides, with `friction: 0` where they are smooth";

/// Whether this is the only guide of its body.
fn is_only_guide(model: &Model<'_>, sliding: &Sliding<'_>) -> bool {
    let guides = model.sliding().into_iter().filter(|s| !s.is_second());
    guides.filter(|s| s.body == sliding.body).count() == 1
}

/// Why a contact given by a normal is not a valid surface for a body to slide on.
fn surface_error<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    normal: &[Expr<'d>],
) -> Option<Diagnostic> {
    let name = &sliding.name;
    let error = |message: String, help: &str| {
        Some(Diagnostic::new(Code::NoGuide, sliding.span, message).help(help))
    };
    if is_zero(dot(normal, normal)) {
        return error(
            format!("the normal of `{name}` has no length"),
            "it is at right angles to the surface on which the body slides",
        );
    }
    let x = Variables::of(model);
    let mut coasting = x.without_acceleration(model);
    let velocity = super::guide::velocity(model, sliding, &mut coasting);
    if !is_zero(dot(normal, &velocity)) {
        return error(
            format!("the coordinates let the body of `{name}` leave its surface"),
            "the origin of its frame, or the mass centre of a body without one, may move only at right angles to the normal, relative to what \
             it slides on: describe it by two coordinates on the surface, or let it touch the surface through `contacts`",
        );
    }
    let rows: Vec<Vec<Expr<'d>>> = (velocity.iter())
        .map(|&velocity| gradient(model.dag, velocity, &x.v))
        .collect();
    // The velocity is perpendicular to the normal, so it has one or two independent components.
    let cross = |i: usize, j: usize| {
        let minor = |k: usize, l: usize| rows[k][i] * rows[l][j] - rows[k][j] * rows[l][i];
        [(1, 2), (2, 0), (0, 1)]
            .into_iter()
            .all(|(k, l)| is_zero(minor(k, l)))
    };
    let n = x.v.len();
    if (0..n).all(|i| (0..i).all(|j| cross(i, j))) {
        return error(
            format!("the body of `{name}` can move at most along a line of its surface"),
            "something else holds it that the spec does not describe: for sliding along a curve give `direction` in place of `normal`",
        );
    }
    if is_only_guide(model, sliding)
        && velocity
            .iter()
            .any(|&along| !is_zero(along) && is_base_motion(model, sliding, along, &mut coasting))
    {
        return error(
            format!("the body of `{name}` is held by more than this surface"),
            FURTHER_GUIDES_HELP,
        );
    }
    None
}

/// The components of a velocity across a guide: in the plane the velocity is given by its component along the normal; in
/// space by all components, and its cross product with the direction is zero if it has no part across.
fn across<'d>(direction: &[Expr<'d>], off: &[Expr<'d>]) -> Vec<Expr<'d>> {
    match (direction, off) {
        (&[x, y, z], &[u, v, w]) => cross(&[x, y, z], &[u, v, w]).to_vec(),
        _ => off.to_vec(),
    }
}

/// Whether the motion of the base alone determines a slip: then something else, which is unknown,
/// holds the body.
fn is_base_motion<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    slip: Expr<'d>,
    rate: &mut Tangent<'d>,
) -> bool {
    let dag = model.dag;
    let x = Variables::of(model);
    let (origin, turning) = base(model, sliding, rate);
    let motion = origin.iter().map(|&o| rate.of(o)).chain(turning);
    let mut rows: Vec<Vec<Expr<'d>>> = motion.map(|u| gradient(dag, u, &x.v)).collect();
    rows.push(gradient(dag, slip, &x.v));
    identity::is_combination(dag, &rows)
}

/// The rows of all displacements along the normals, before they are solved for the reactions.
struct Reactions<'d> {
    /// The sum of the reactions along each displacement.
    rows: Vec<Reaction<'d>>,
    /// The coefficients of each normal reaction.
    shares: Vec<Vec<Expr<'d>>>,
}

impl<'d> Reactions<'d> {
    fn of(
        model: &Model<'d>,
        relaxed: &Model<'d>,
        guides: &[Guide<'d>],
        of_contacts: &[Vec<Expr<'d>>],
    ) -> Reactions<'d> {
        let dag = model.dag;
        let x = Variables::of(relaxed);
        let n = model.coordinates.len();
        let dimension = model.space.dimension();
        let numbers = super::guide::guides_of(model);
        let own = |k: usize| n + dimension * numbers[k]..n + dimension * (numbers[k] + 1);

        let unbalanced = Projection::of(relaxed, &x).residual();
        let constraints = constraints::constraints(relaxed);
        let mut coasting = x.without_acceleration(relaxed);
        let (mut slips, mut offs) = (Vec::new(), Vec::new());
        for (sliding, guide) in relaxed.sliding().into_iter().zip(guides) {
            let relative = relative(relaxed, sliding, guide, &mut coasting);
            slips.push(gradient(dag, relative.slip, &x.v));
            if sliding.is_second() {
                continue;
            }
            offs.extend(
                relative
                    .normal_velocity
                    .into_iter()
                    .map(|rate| gradient(dag, rate, &x.v)),
            );
        }

        let shut: Vec<_> = (n..x.q.len())
            .flat_map(|i| [x.q[i], x.v[i], x.a[i]])
            .map(|symbol| (symbol, dag.zero()))
            .collect();
        let closed = |values: &[Expr<'d>]| substitute(dag, values, &shut);
        let along = |(k, axis): (usize, &[Expr<'d>]), column: &dyn Fn(usize) -> Expr<'d>| {
            let pairs = own(k).zip(axis);
            let row = dag.sum(pairs.map(|(i, &normal)| normal * column(i)));
            closed(&[row])[0]
        };
        let contacts = model.sliding();
        let axes = guides.iter().enumerate();
        let axes = axes.filter(|(k, _)| !contacts[*k].is_second());
        let axes = axes.flat_map(|(k, guide)| guide.axes.iter().map(move |axis| (k, &axis[..])));
        let mut rows = Vec::with_capacity(offs.len());
        let mut shares = Vec::with_capacity(offs.len());
        for k in axes {
            let component = along(k, &|i| -unbalanced[i]);
            let at_rest: Vec<_> = x.a[..n].iter().map(|&a| (a, dag.zero())).collect();
            rows.push(Reaction {
                load: substitute(dag, &[component], &at_rest)[0],
                by_accelerations: gradient(dag, component, &x.a[..n]),
                by_multipliers: constraints
                    .iter()
                    .map(|c| along(k, &|i| -c.row[i]))
                    .collect(),
                by_friction_forces: slips.iter().map(|slip| along(k, &|i| -slip[i])).collect(),
                by_contact_forces: (of_contacts.iter())
                    .map(|row| along(k, &|i| -row[i]))
                    .collect(),
            });
            let share = offs.iter().map(|off| along(k, &|i| off[i]));
            shares.push(share.collect());
        }
        let mut reactions = Reactions { rows, shares };
        reactions.simplify_coefficients();
        reactions
    }

    /// Replaces coefficients that are identically 0 or 1 by these constants.
    fn simplify_coefficients(&mut self) {
        let known = |e: &mut Expr<'d>| {
            let dag = e.dag();
            for value in [dag.zero(), dag.one()] {
                if identity::equal(*e, value) == Some(true) {
                    *e = value;
                }
            }
        };
        self.rows
            .iter_mut()
            .flat_map(Reaction::parts)
            .for_each(known);
        self.shares.iter_mut().flatten().for_each(known);
    }

    /// The reactions, by elimination; none if a row is a linear combination of others.
    ///
    /// No rows are exchanged: every diagonal entry is 1, and its pivot is 0 only if two guides
    /// constrain the same displacement.
    fn solved(mut self) -> Option<Vec<Reaction<'d>>> {
        let count = self.rows.len();
        for k in 0..count {
            let pivot = self.shares[k][k];
            if is_zero(pivot) {
                return None;
            }
            for i in (0..count).filter(|i| *i != k) {
                let factor = self.shares[i][k] / pivot;
                if factor.is_zero() {
                    continue;
                }
                let (row, share) = (self.rows[k].clone(), self.shares[k].clone());
                for (to, &mut from) in self.rows[i].parts().zip(row.clone().parts()) {
                    *to = *to - factor * from;
                }
                for (to, from) in self.shares[i].iter_mut().zip(share) {
                    *to = *to - factor * from;
                }
            }
        }
        for k in 0..count {
            let pivot = self.shares[k][k];
            self.rows[k].parts().for_each(|part| *part = *part / pivot);
        }
        self.simplify_coefficients();
        Some(self.rows)
    }
}
