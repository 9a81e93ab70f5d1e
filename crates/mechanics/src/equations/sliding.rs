//! Guided contacts with Coulomb friction: how fast they slide, and what presses.
//!
//! ```text
//! slip             w = e·(ẋ_body − ẋ_on − ω_on×r) = τ v + b(q, t),   τ = ∂w/∂v         (E32)
//! normal reaction  N = n·(M a − f − Gᵀλ − Σ τᵀF)_δ                                      (E33)
//!                    = ν + ρ·a + χ·λ + Σ κ F
//! friction         F = −μ |N| sgn w while it slides, |F| ≤ μ₀ |N| while it sticks       (E34)
//!                  M a = f + Gᵀλ + Σ τᵀ F
//! ```
//!
//! The reaction is that of a guide that is let go: δ displaces the body, with all that is built on
//! its frame, and the row of δ in Lagrange's equations says which force along it keeps δ at zero. It
//! depends on the accelerations, so friction changes the matrix in front of them. Displacements δ are
//! in ground axes. In the plane what counts is the row along the normal `n`, which is `e` turned left. In space a guide
//! holds its body in two directions, and all three rows are taken: the reaction is a vector in ground axes. What acts along the
//! guide and is written in coordinates is in its part along `e`; `|N|` is the length of the rest.
//!
//! On a surface in space, which holds a body from both sides, the slip has two components (E76). They stand as two contacts, the
//! second behind the first, with one displacement and one reaction.
//!
//! Where several guides hold one body, each displacement meets the reactions of all of them: the rows
//! are solved for the reactions, here and symbolically. Guides that hold the same cannot be told
//! apart, and are refused.

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

/// The most contacts of a machine: at a stop, every way in which they may stick or slide is looked at,
/// and of six contacts there are 46 656.
pub const MOST_CONTACTS: usize = 6;

/// A guided contact with Coulomb friction.
#[derive(Clone, Debug)]
pub struct SlidingEquation<'d> {
    /// Its name.
    pub name: String,
    /// `w(q, v, t)`, in m/s: the velocity of the body along the direction, less that of what it
    /// slides on.
    pub slip: Expr<'d>,
    /// `τ(q, t) = ∂w/∂v`.
    pub row: Vec<Expr<'d>>,
    /// `dw/dt` at `a = 0`.
    pub drift: Expr<'d>,
    /// The direction `e(q, t)`, of length 1.
    pub direction: Vec<Expr<'d>>,
    /// The normal `n(q, t)` of the surface that it slides on, of any length, and which of its tangents the direction is; none of
    /// what slides along a line or a curve.
    pub surface: Option<(Vec<Expr<'d>>, element::Tangent)>,
    /// The components of the normal reaction: one in the plane, along the normal; three in space, along the axes of the
    /// ground.
    pub reactions: Vec<Reaction<'d>>,
    /// `μ`.
    pub friction: Expr<'d>,
    /// `μ₀`, of what sticks.
    pub static_friction: Expr<'d>,
}

/// A component of a normal reaction, as a linear form.
#[derive(Clone, Debug)]
pub struct Reaction<'d> {
    /// `ν(q, v, t, u)`, in N: what it is where nothing accelerates.
    pub load: Expr<'d>,
    /// `ρ(q, t)`, by acceleration.
    pub by_accelerations: Vec<Expr<'d>>,
    /// `χ(q, t)`, by the multipliers of the constraints.
    pub by_multipliers: Vec<Expr<'d>>,
    /// `κ(q, t)`, by the friction of each contact.
    pub by_friction_forces: Vec<Expr<'d>>,
}

impl<'d> SlidingEquation<'d> {
    /// The direction by which the part of the reaction is told that presses, of length 1: the normal of a surface, along which all of
    /// it does, or the tangent of a curve, along which nothing does.
    pub fn telling(&self) -> Vec<Expr<'d>> {
        match &self.surface {
            Some((normal, _)) => unit(normal),
            None => self.direction.clone(),
        }
    }

    /// Whether it is the second tangent of the surface that the contact before it is on.
    pub fn is_second(&self) -> bool {
        matches!(self.surface, Some((_, element::Tangent::Second)))
    }

    /// The components of the normal reaction over the symbols of the accelerations and of the multipliers, in their order: in space
    /// three in ground axes, and on a surface one, along its normal. The friction of other contacts is left out; the contact's own,
    /// which is along the direction, has none.
    pub fn normal(&self, model: &Model<'d>, multipliers: &[Expr<'d>]) -> Vec<Expr<'d>> {
        let dag = model.dag;
        // With the accelerations of any motion there is a part along the direction in space: the friction.
        let across = |part: Vec<Expr<'d>>| {
            if part.len() == 1 {
                return part;
            }
            if self.surface.is_some() {
                let mut part = vec![dot(&self.telling(), &part)];
                identity::settle(dag, &mut part);
                return part;
            }
            let along = dot(&self.direction, &part);
            let pairs = part.into_iter().zip(&self.direction);
            let mut part: Vec<Expr<'d>> = pairs.map(|(x, &e)| x - along * e).collect();
            identity::settle(dag, &mut part);
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

    /// What presses in a machine that has no constraints and no friction on the way, over the symbols of the accelerations:
    /// the normal reaction in the plane, its size in space.
    pub fn pressing(&self, model: &Model<'d>) -> Expr<'d> {
        match &self.normal(model, &[])[..] {
            [normal] => *normal,
            all => model.dag.sum(all.iter().map(|one| one.square())).sqrt(),
        }
    }
}

impl<'d> Reaction<'d> {
    fn parts(&mut self) -> impl Iterator<Item = &mut Expr<'d>> {
        let lists = self
            .by_accelerations
            .iter_mut()
            .chain(&mut self.by_multipliers)
            .chain(&mut self.by_friction_forces);
        std::iter::once(&mut self.load).chain(lists)
    }
}

/// The contacts of a machine; nothing, and a message for each reason, where a guide is
/// none, or its reaction is not determined.
pub(super) fn sliding<'d>(
    model: &Model<'d>,
    report: &mut Report,
) -> Option<Vec<SlidingEquation<'d>>> {
    let all = model.sliding();
    if all.is_empty() {
        return Some(Vec::new());
    }
    let guides: Vec<Guide<'d>> = all.iter().map(|s| guide(model, s)).collect();
    let mut refused = false;
    for (sliding, guide) in all.iter().zip(&guides) {
        if let Some(diagnostic) = what_is_wrong(model, sliding, guide) {
            report.push(diagnostic);
            refused = true;
        }
    }
    if refused {
        return None;
    }
    let x = Variables::of(model);
    let relaxed = model.relaxed.as_deref()?;
    let reactions = Reactions::of(model, relaxed, &guides);
    let Some(solved) = reactions.solved() else {
        let names = all.iter().filter(|s| !s.is_second());
        let names = names.map(|s| format!("`{}`", s.name));
        let names = names.collect::<Vec<_>>().join(", ");
        let message = format!("what each of {names} carries is not determined");
        let diagnostic = Diagnostic::new(Code::NoGuide, all[0].span, message);
        report.push(diagnostic.help(match model.space {
            Space::Plane => "guides that hold a body in the same direction share its load in unknown parts: say it of one of them",
            Space::Space => "in space a body has one guide, a curve or a surface: give what slides at several places a body at each, and tie these by `constraints`",
        }));
        return None;
    };
    if carrying::refuse_untied(model, report) {
        return None;
    }
    let mut coasting = x.coasting(model);
    let mut equations = Vec::with_capacity(guides.len());
    let mut solved = solved.into_iter();
    for (sliding, guide) in all.iter().zip(&guides) {
        let slip = relative(model, sliding, guide, &mut coasting).slip;
        let (slip, row) = settled(model, &x, slip);
        let reactions = if sliding.is_second() {
            // Both tangents have one reaction.
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
            drift: coasting.of(slip),
            direction: guide.along.clone(),
            surface: (sliding.normal.clone().zip(sliding.tangent)),
            reactions,
            friction: sliding.friction,
            static_friction: sliding.static_friction.unwrap_or(sliding.friction),
        });
    }
    Some(equations)
}

/// A slip and its derivatives by the rates. What of it is constant, or zero, is written as such: a body
/// at rest on a rail that moves has the slip 0, and not what rounding makes of differences.
fn settled<'d>(model: &Model<'d>, x: &Variables<'d>, slip: Expr<'d>) -> (Expr<'d>, Vec<Expr<'d>>) {
    let dag = model.dag;
    let derived = gradient(dag, slip, &x.v);
    let at_rest: Vec<_> = x.v.iter().map(|&v| (v, dag.zero())).collect();
    let of_base = substitute(dag, &[slip], &at_rest)[0];
    let mut parts: Vec<Expr<'d>> = derived.iter().copied().chain([of_base]).collect();
    identity::settle(dag, &mut parts);
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

/// Why a contact is no guide.
fn what_is_wrong<'d>(
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
            element::Tangent::First => what_is_wrong_on_surface(model, sliding, normal),
            // It has been said of the first.
            element::Tangent::Second => None,
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
            "it only says on which side of the guide the body is",
        );
    }
    let mut coasting = Variables::of(model).coasting(model);
    let relative = relative(model, sliding, guide, &mut coasting);
    let (slip, off) = (relative.slip, across(&sliding.direction, &relative.off));
    if !off.into_iter().all(is_zero) {
        return error(
            format!("the coordinates let the body of `{name}` leave its guide"),
            "the origin of its frame, or the mass centre of a body without one, may move only along the direction, seen from what it slides on",
        );
    }
    if is_zero(slip) {
        return error(
            format!(
                "the body of `{name}` does not slide: no coordinate moves it along the direction"
            ),
            "friction acts where something moves, or could",
        );
    }
    if is_alone(model, sliding) && follows(model, sliding, slip, &mut coasting) {
        return error(
            format!("the body of `{name}` is held by more than this guide"),
            HELD_BY_MORE,
        );
    }
    None
}

const HELD_BY_MORE: &str = "where it is on the guide follows from how the guide moves: say under `sliding` what else it slides in, with `friction: 0` where that is smooth";

/// Whether a body has no other guide.
fn is_alone(model: &Model<'_>, sliding: &Sliding<'_>) -> bool {
    let guides = model.sliding().into_iter().filter(|s| !s.is_second());
    guides.filter(|s| s.body == sliding.body).count() == 1
}

/// Why what is said by a normal is no surface on which a body slides.
fn what_is_wrong_on_surface<'d>(
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
    let mut coasting = x.coasting(model);
    let velocity = super::guide::velocity(model, sliding, &mut coasting);
    if !is_zero(dot(normal, &velocity)) {
        return error(
            format!("the coordinates let the body of `{name}` leave its surface"),
            "the origin of its frame, or the mass centre of a body without one, may move only at right angles to the normal, seen from what it \
             slides on: write it by two coordinates on the surface, or let it touch the surface by `contacts`",
        );
    }
    let rows: Vec<Vec<Expr<'d>>> = (velocity.iter())
        .map(|&velocity| gradient(model.dag, velocity, &x.v))
        .collect();
    // The velocity is at right angles to the normal, so it has one or two independent components.
    let cross = |i: usize, j: usize| {
        let minor = |k: usize, l: usize| rows[k][i] * rows[l][j] - rows[k][j] * rows[l][i];
        [(1, 2), (2, 0), (0, 1)]
            .into_iter()
            .all(|(k, l)| is_zero(minor(k, l)))
    };
    let n = x.v.len();
    if (0..n).all(|i| (0..i).all(|j| cross(i, j))) {
        return error(
            format!("the body of `{name}` can move along a line of its surface at most"),
            "something else holds it, of which nothing is known: along a curve it slides by `direction` in place of `normal`",
        );
    }
    if is_alone(model, sliding)
        && velocity
            .iter()
            .any(|&along| !is_zero(along) && follows(model, sliding, along, &mut coasting))
    {
        return error(
            format!("the body of `{name}` is held by more than this surface"),
            HELD_BY_MORE,
        );
    }
    None
}

/// What of a velocity is across a guide: in the plane the velocity is given by its component along the normal, in space by
/// all of them, and the cross product with the direction is zero where nothing is across.
fn across<'d>(direction: &[Expr<'d>], off: &[Expr<'d>]) -> Vec<Expr<'d>> {
    match (direction, off) {
        (&[x, y, z], &[u, v, w]) => cross(&[x, y, z], &[u, v, w]).to_vec(),
        _ => off.to_vec(),
    }
}

/// Whether a slip is decided by the motion of what the body slides on: then something else holds the
/// body, of which nothing is known.
fn follows<'d>(
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
    /// What the reactions along each displacement add up to.
    rows: Vec<Reaction<'d>>,
    /// By each normal reaction.
    shares: Vec<Vec<Expr<'d>>>,
}

impl<'d> Reactions<'d> {
    fn of(model: &Model<'d>, relaxed: &Model<'d>, guides: &[Guide<'d>]) -> Reactions<'d> {
        let dag = model.dag;
        let x = Variables::of(relaxed);
        let n = model.coordinates.len();
        let dimension = model.space.dimension();
        let numbers = super::guide::guides_of(model);
        let own = |k: usize| n + dimension * numbers[k]..n + dimension * (numbers[k] + 1);

        let unbalanced = Projection::of(relaxed, &x).unbalanced();
        let constraints = constraints::constraints(relaxed);
        let mut coasting = x.coasting(relaxed);
        let (mut slips, mut offs) = (Vec::new(), Vec::new());
        for (sliding, guide) in relaxed.sliding().into_iter().zip(guides) {
            let relative = relative(relaxed, sliding, guide, &mut coasting);
            slips.push(gradient(dag, relative.slip, &x.v));
            if sliding.is_second() {
                continue;
            }
            offs.extend(
                relative
                    .off
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
            let whole = along(k, &|i| -unbalanced[i]);
            let at_rest: Vec<_> = x.a[..n].iter().map(|&a| (a, dag.zero())).collect();
            rows.push(Reaction {
                load: substitute(dag, &[whole], &at_rest)[0],
                by_accelerations: gradient(dag, whole, &x.a[..n]),
                by_multipliers: constraints
                    .iter()
                    .map(|c| along(k, &|i| -c.row[i]))
                    .collect(),
                by_friction_forces: slips.iter().map(|slip| along(k, &|i| -slip[i])).collect(),
            });
            let share = offs.iter().map(|off| along(k, &|i| off[i]));
            shares.push(share.collect());
        }
        let mut reactions = Reactions { rows, shares };
        reactions.settle();
        reactions
    }

    /// Writes 0 and 1 for what is 0 and 1.
    fn settle(&mut self) {
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

    /// The reactions, by elimination; none where a row is a combination of others.
    ///
    /// No rows are exchanged: every diagonal entry is 1, and its pivot is 0 only where two
    /// guides hold the same.
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
        self.settle();
        Some(self.rows)
    }
}
