//! Normal forces that rigid bodies leave undetermined, (E79).
//!
//! If contacts depend on each other, as the four feet of a table do, there are forces that are in equilibrium among themselves: with the rows wₙ
//! of gaps and wₜ of slips that are held at 0, `Σ wₙᵀ κₙ + Σ wₜᵀ κₜ = 0`. They may be added to any solution of the equations of motion. Where
//! contacts slip, their friction depends on their normal forces, so that the motion itself depends on the forces that are added. The rule is that of
//! contacts that are all equally stiff, in the limit of infinite stiffness: a normal force is proportional to the penetration that a small motion of the
//! bodies causes, and 0 where that motion opens the contact,
//!
//! ```text
//! λₙᵢ = max(0, cᵢ),      κₙ·c = 0  for all κ
//! ```
//!
//! Where all contacts press, these are the normal forces with the least sum of squares of all that are in equilibrium with the same forces.
//! They depend neither on the coordinates nor on the order in which contacts are listed.

mod distribution;

use std::vec;
use std::vec::Vec;

use super::lcp::{self, Unsolved};
use super::problem::{self, Answer, ContactUnknowns};
use crate::contact_law::shares::{self, PARTS};
pub(super) use distribution::OpenForces;

/// What counts as zero in forces that keep each other in equilibrium, relative to the greatest of them.
const ZERO: f64 = 1e-10;

/// Forces whose effect on accelerations is below this, relative to the sum of the effects of each, are in equilibrium.
const EQUILIBRIUM: f64 = 1e-9;

/// The compliance of contacts, relative to the least inverse mass that they act on: the first one, the share of it with which the next problem is
/// solved, and the last one. Soft contacts are easily solved for and tell near which forces the solution of stiffer ones is. Each time the rates that are
/// left fall by about the compliance; rounding of the normal forces is that of the rates divided by it.
const COMPLIANCE: [f64; 3] = [1.0, 0.2, 1e-4];

/// Where rates fall slowly, because the contacts have short levers and move what is light along them, they become stiffer than that, up to this. Rounding of
/// the normal forces is then up to 1e-8 of them.
const STIFFEST: f64 = 1e-8;

/// How often a problem is solved with a compliance.
const ROUNDS: usize = 60;

/// A search that returns to its last solution ends where the compliance is closer to that than this.
const NEAREST: f64 = 0.9;

/// Rates that a compliance leaves, relative to the greatest rate: no more than rounding.
const RIGID: f64 = 1e-14;

/// Rates that are 0 where a contact is held, relative to the greatest rate.
const HELD: f64 = 1e-9;

/// What the rounding of gaps makes of the rates that close them in a step of time stepping, at most, relative to the greatest rate.
const ROUNDING_OF_GAPS: f64 = 1e-8;

/// With rates up to this a distribution is still one.
const TOLERABLE: f64 = 1e-11;

/// Memory for problems of contacts whose forces may be undetermined.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    problem: problem::Memory,
    rates: Vec<f64>,
    following: Vec<usize>,
    sharing: SharingMemory,
}

#[derive(Clone, Debug, Default)]
struct SharingMemory {
    directions: Vec<usize>,
    part: Vec<f64>,
    scale: Vec<f64>,
    none: Vec<f64>,
    solution: Vec<f64>,
    order: lcp::Order,
}

/// The forces that keep each other in equilibrium: a basis of the null space of `G = Wᵀ M⁻¹ W` for some directions of contacts.
pub(super) fn in_equilibrium(g: &[f64], n: usize) -> Vec<Vec<f64>> {
    let mut memory = SharingMemory::default();
    memory.part.extend_from_slice(g);
    memory.in_equilibrium(n)
}

impl SharingMemory {
    /// As [`in_equilibrium`], of the matrix `part`, which is overwritten.
    fn in_equilibrium(&mut self, n: usize) -> Vec<Vec<f64>> {
        let Self {
            part,
            scale,
            none,
            solution,
            order,
            ..
        } = self;
        // Of bodies with very different masses each contact is compared with its own terms.
        scale.clear();
        scale.extend((0..n).map(|i| {
            let own = part[i * n + i];
            if own > 0.0 { 1.0 / own.sqrt() } else { 0.0 }
        }));
        for (k, entry) in part.iter_mut().enumerate() {
            *entry = scale[k / n] * *entry * scale[k % n];
        }
        none.clear();
        none.resize(n, 0.0);
        lcp::eliminate_into(part, none, (solution, order));
        let mut basis = order.null_space(part);
        for vector in &mut basis {
            for (x, scale) in vector.iter_mut().zip(&*scale) {
                *x *= scale;
            }
            without_rounding(vector);
        }
        basis
    }
}

/// Sets what is rounding beside the greatest entry to 0.
pub(super) fn without_rounding(vector: &mut [f64]) {
    let most = greatest(vector);
    for x in vector.iter_mut().filter(|x| x.abs() <= ZERO * most) {
        *x = 0.0;
    }
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The effect of forces along images, in axes in which the square of its length is twice the power that goes into it, and the sum of the sizes of its terms.
pub(super) fn effect(images: &[Vec<f64>], forces: &[f64]) -> (Vec<f64>, f64) {
    let mut sum = vec![0.0; images.first().map_or(0, Vec::len)];
    let mut size = 0.0;
    for (image, force) in images.iter().zip(forces) {
        for (sum, y) in sum.iter_mut().zip(image) {
            *sum += force * y;
        }
        size += force.abs() * dot(image, image).sqrt();
    }
    (sum, size)
}

/// The combinations of undetermined forces that change no acceleration; `effects` holds the [`effect`] of each force.
pub(super) fn without_effect(by: Vec<Vec<f64>>, effects: &[(Vec<f64>, f64)]) -> Vec<Vec<f64>> {
    let scaled: Vec<Vec<f64>> = (effects.iter())
        .map(|(effect, size)| {
            let scale = if *size > 0.0 { 1.0 / size } else { 0.0 };
            effect.iter().map(|x| scale * x).collect()
        })
        .collect();
    if scaled
        .iter()
        .all(|effect| dot(effect, effect).sqrt() <= EQUILIBRIUM)
    {
        return by;
    }
    let d = by.len();
    let mut products: Vec<f64> = (0..d * d)
        .map(|k| dot(&scaled[k / d], &scaled[k % d]))
        .collect();
    let (_, order) = lcp::eliminate(&mut products, &mut vec![0.0; d]);
    let combinations = order.null_space(&products).into_iter();
    combinations
        .map(|combination| {
            let mut sum = vec![0.0; by[0].len()];
            for ((share, by), (_, size)) in combination.iter().zip(&by).zip(effects) {
                let share = if *size > 0.0 { share / size } else { *share };
                for (sum, by) in sum.iter_mut().zip(by) {
                    *sum += share * by;
                }
            }
            without_rounding(&mut sum);
            sum
        })
        .collect()
}

/// The contacts of a problem whose normal forces depend on each other, group by group; none if no normal force does. Forces may be in equilibrium along
/// directions that `may_be_held`.
fn sharing_contacts(
    contacts: &[ContactUnknowns],
    g: &[f64],
    may_be_held: impl Fn(usize) -> bool,
    memory: &mut SharingMemory,
) -> Vec<Vec<usize>> {
    let m = contacts.len();
    let SharingMemory {
        directions, part, ..
    } = &mut *memory;
    directions.clear();
    let mut has_friction = false;
    for (k, unknowns) in contacts.iter().enumerate() {
        let (normal, tangent) = match unknowns {
            ContactUnknowns::Both { friction, .. } => (true, *friction > 0.0),
            ContactUnknowns::Normal { .. } => (true, false),
            ContactUnknowns::Tangent { friction, normal } => (false, friction * normal > 0.0),
            ContactUnknowns::OnCarrier { friction, .. } => (false, *friction > 0.0),
            ContactUnknowns::SecondTangent => (false, has_friction),
            // The reaction of a guide is not undetermined, and how its friction is shared is a question of its own.
            ContactUnknowns::Nothing
            | ContactUnknowns::ShareOfCarrier { .. }
            | ContactUnknowns::Guide { .. }
            | ContactUnknowns::SlidingGuide { .. } => (false, false),
        };
        has_friction = tangent;
        directions.extend((normal && may_be_held(2 * k)).then_some(2 * k));
        directions.extend((tangent && may_be_held(2 * k + 1)).then_some(2 * k + 1));
    }
    part.clear();
    for i in &*directions {
        part.extend(directions.iter().map(|j| g[i * 2 * m + j]));
    }
    let n = directions.len();
    let mut basis = memory.in_equilibrium(n);
    let directions = &memory.directions;
    basis.retain(|vector| {
        let mut entries = directions.iter().zip(vector);
        entries.any(|(direction, x)| direction % 2 == 0 && *x != 0.0)
    });
    let free = basis.len();
    if free == 0 {
        return Vec::new();
    }
    let mut by = vec![0.0; PARTS * free * m];
    for (column, vector) in basis.iter().enumerate() {
        for (direction, x) in directions.iter().zip(vector) {
            by[PARTS * free * (direction / 2) + free * (direction % 2) + column] = *x;
        }
    }
    let mut groups = vec![0; free];
    shares::group(&by, &mut groups);
    let members = |group: usize| -> Vec<usize> {
        let is_member = |k: &usize| {
            let own = &by[PARTS * free * k..][..PARTS * free];
            shares::is_in(own, &groups, group) && own[..free].iter().any(|x| *x != 0.0)
        };
        (0..m).filter(is_member).collect()
    };
    let groups = (0..free).filter(|group| groups[*group] == *group);
    groups.map(members).collect()
}

/// The least inverse mass on which the contacts act that depend on each other, for each contact in one of these groups, and 0 for the rest.
fn inverse_masses(groups: &[Vec<usize>], g: &[f64], contacts: usize) -> Vec<f64> {
    let mut inverse_masses = vec![0.0; contacts];
    for members in groups {
        let own = members.iter().map(|k| g[2 * k * 2 * contacts + 2 * k]);
        let least = own.fold(f64::INFINITY, f64::min);
        members.iter().for_each(|k| inverse_masses[*k] = least);
    }
    inverse_masses
}

/// Solves for normal and tangential forces or impulses of each contact, as [`problem::solve`]; if normal forces depend on each other, with the
/// distribution of the rule.
///
/// With the compliance ε a contact presses with `λ = max(0, c − γ/ε)`. That is the solution of a problem with ε added to the diagonal, and of
/// rigid contacts where γ is 0: c is followed until it is. Where rounding prevents that, the answer is any solution, which says so if the motion depends
/// on it.
pub(super) fn solve(
    contacts: &[ContactUnknowns],
    g: &[f64],
    b: &[f64],
) -> Result<Answer, Unsolved> {
    let mut memory = Memory::default();
    let mut answer = Answer::default();
    let some = problem::solve_into(contacts, (g, b), None, (&mut answer, &mut memory.problem));
    let groups = sharing_contacts(contacts, g, |_| true, &mut memory.sharing);
    if groups.is_empty() {
        return some.map(|()| answer);
    }
    let start = some.is_ok().then_some(answer.forces.as_slice());
    let problem = (g, b, &groups[..]);
    if let Some(found) = distributed(contacts, problem, (start, false), TOLERABLE, &mut memory) {
        return Ok(found);
    }
    some?;
    answer.shared_otherwise = motion_depends_on(contacts, (g, b), &answer.forces, &mut memory);
    Ok(answer)
}

/// As [`solve`], but with the distribution of the rule only if the motion depends on it. The search begins `near` these forces.
pub(super) fn solve_for_motion(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    near: &[[f64; 2]],
    answer: &mut Answer,
    memory: &mut Memory,
) -> Result<(), Unsolved> {
    let mut some = problem::solve_into(
        contacts,
        (g, b),
        Some(near),
        (&mut *answer, &mut memory.problem),
    );
    // In the plane the first search has already looked for a solution anywhere.
    if some.is_err() && is_in_space(contacts) {
        some = problem::solve_into(contacts, (g, b), None, (&mut *answer, &mut memory.problem));
    }
    let mut rates_of_a_motion = None;
    let mut b = b;
    if some.is_err() {
        rates_of_a_motion = without_rounding_of_gaps(contacts, (g, b), memory);
        if let Some(rates) = &rates_of_a_motion {
            b = rates;
            let near = Some(near);
            some = problem::solve_into(contacts, (g, b), near, (&mut *answer, &mut memory.problem));
        }
    }
    let mut depends = Vec::new();
    if some.is_ok() {
        depends = motion_depends_on(contacts, (g, b), &answer.forces, memory);
        if depends.is_empty() {
            return Ok(());
        }
    }
    let groups = sharing_contacts(contacts, g, |_| true, &mut memory.sharing);
    if groups.is_empty() {
        return some;
    }
    let start = some.is_ok().then_some(answer.forces.as_slice());
    let problem = (g, b, &groups[..]);
    let mut found = distributed(contacts, problem, (start, true), HELD, memory);
    if found.is_none() && some.is_ok() {
        found = distributed_among_held(contacts, (g, b), &answer.forces, memory);
    }
    if found.is_none() && rates_of_a_motion.is_none() {
        rates_of_a_motion = without_rounding_of_gaps(contacts, (g, b), memory);
        if let Some(rates) = &rates_of_a_motion {
            let problem = (g, &rates[..], &groups[..]);
            found = distributed(contacts, problem, (start, true), HELD, memory);
        }
    }
    if let Some(found) = found {
        *answer = found;
        return Ok(());
    }
    answer.shared_otherwise = depends;
    some
}

/// The solution with the distribution of the rule among the contacts that do not open with these forces, if it leaves the others open. Of feet of a rigid body whose rates are almost those of a
/// motion one opens so slowly that contacts which yield would press there all the same, until they are very stiff.
fn distributed_among_held(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    forces: &[[f64; 2]],
    memory: &mut Memory,
) -> Option<Answer> {
    let least = HELD * greatest(b);
    let rows = || b.iter().zip(g.chunks_exact(b.len())).step_by(2);
    let rates = |forces: &[[f64; 2]]| -> Vec<f64> {
        rows()
            .map(|(b, row)| b + dot(row, forces.as_flattened()))
            .collect()
    };
    let (mut held, mut opens) = (contacts.to_vec(), vec![false; contacts.len()]);
    for (k, rate) in rates(forces).into_iter().enumerate() {
        opens[k] = match contacts[k] {
            ContactUnknowns::Both { .. } | ContactUnknowns::Normal { .. } => {
                forces[k][0] == 0.0 && rate > least
            }
            ContactUnknowns::OnCarrier { on, .. } | ContactUnknowns::ShareOfCarrier { on, .. } => {
                opens[on]
            }
            ContactUnknowns::SecondTangent => opens[k - 1],
            _ => false,
        };
        if opens[k] {
            held[k] = ContactUnknowns::Nothing;
        }
    }
    if !opens.contains(&true) {
        return None;
    }
    let groups = sharing_contacts(&held, g, |_| true, &mut memory.sharing);
    if groups.is_empty() {
        return None;
    }
    let found = distributed(&held, (g, b, &groups), (Some(forces), true), HELD, memory)?;
    let mut stay = rates(&found.forces).into_iter().zip(&opens);
    stay.all(|(rate, opens)| !opens || rate >= -least)
        .then_some(found)
}

/// The rates of contacts, with those of their normals as a motion of the machine makes them; none if they are so already, or differ by more than rounding.
///
/// Gaps are known up to rounding. In a step of time stepping the rates are to close them, which divides that by the length of the step: four feet of a rigid body,
/// one of which is a little too high, cannot all be closed, and which of them opens would be a question of rounding, on which the motion may depend.
fn without_rounding_of_gaps(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    memory: &mut Memory,
) -> Option<Vec<f64>> {
    let SharingMemory {
        directions, part, ..
    } = &mut memory.sharing;
    let is_normal = |k: &usize| {
        matches!(
            contacts[*k],
            ContactUnknowns::Both { .. } | ContactUnknowns::Normal { .. }
        )
    };
    directions.clear();
    directions.extend((0..contacts.len()).filter(is_normal).map(|k| 2 * k));
    part.clear();
    for i in &*directions {
        part.extend(directions.iter().map(|j| g[i * b.len() + j]));
    }
    let mut basis = memory
        .sharing
        .in_equilibrium(memory.sharing.directions.len());
    let directions = &memory.sharing.directions;
    let mut rates = b.to_vec();
    for k in 0..basis.len() {
        let (known, rest) = basis.split_at_mut(k);
        let own = &mut rest[0];
        for known in &*known {
            let share = dot(known, own);
            own.iter_mut().zip(known).for_each(|(x, y)| *x -= share * y);
        }
        let length = dot(own, own).sqrt();
        own.iter_mut().for_each(|x| *x /= length);
        let along: f64 = directions
            .iter()
            .zip(&*own)
            .map(|(i, x)| rates[*i] * x)
            .sum();
        for (i, x) in directions.iter().zip(&*own) {
            rates[*i] -= along * x;
        }
    }
    let changes = rates.iter().zip(b).map(|(rate, b)| (rate - b).abs());
    let most = changes.fold(0.0, f64::max);
    (most > 0.0 && most <= ROUNDING_OF_GAPS * greatest(b)).then_some(rates)
}

/// Whether some contact has a second tangent.
fn is_in_space(contacts: &[ContactUnknowns]) -> bool {
    (contacts.iter()).any(|k| matches!(k, ContactUnknowns::SecondTangent))
}

/// The contacts on whose distribution of a load the motion depends: those of which one slips whose normal force others depend on, along the directions
/// that are held with these forces.
fn motion_depends_on(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    forces: &[[f64; 2]],
    memory: &mut Memory,
) -> Vec<usize> {
    let (width, rate) = (b.len(), greatest(b));
    if rate == 0.0 {
        return Vec::new();
    }
    let Memory {
        rates,
        following,
        sharing,
        ..
    } = memory;
    rates.clear();
    let rows = b.iter().zip(g.chunks_exact(width));
    rates.extend(rows.map(|(b, row)| b + dot(row, forces.as_flattened())));
    let is_held = |direction: usize| rates[direction].abs() <= HELD * rate;
    following.clear();
    following.extend(contacts_that_are_followed(contacts, is_held));
    if following.is_empty() {
        return Vec::new();
    }
    let groups = sharing_contacts(contacts, g, is_held, sharing).into_iter();
    let depends = |members: &Vec<usize>| members.iter().any(|k| following.contains(k));
    groups.filter(depends).flatten().collect()
}

/// The contacts whose normal force a friction force follows, because something slips there or would if the contact pressed.
fn contacts_that_are_followed(
    contacts: &[ContactUnknowns],
    is_held: impl Fn(usize) -> bool,
) -> impl Iterator<Item = usize> {
    let slips = move |k: usize| !is_held(2 * k + 1);
    let follows = move |k: usize| match contacts[k] {
        ContactUnknowns::Both { friction, .. } => (friction > 0.0 && slips(k)).then_some(k),
        ContactUnknowns::OnCarrier { friction, on, .. } => {
            (friction > 0.0 && slips(k)).then_some(on)
        }
        ContactUnknowns::Normal { share } => (share != 0.0).then_some(k),
        ContactUnknowns::ShareOfCarrier { share, on } => (share != 0.0).then_some(on),
        ContactUnknowns::SecondTangent => (k > 0 && slips(k)).then(|| k - 1),
        ContactUnknowns::Tangent { .. }
        | ContactUnknowns::Nothing
        | ContactUnknowns::Guide { .. }
        | ContactUnknowns::SlidingGuide { .. } => None,
    };
    (0..contacts.len()).filter_map(follows)
}

/// The solution with the distribution of the rule, if rounding permits it: if no rate that it leaves is above `tolerable`, relative to the greatest one. The search
/// starts with these forces, if there are any, which may be near.
fn distributed(
    contacts: &[ContactUnknowns],
    (g, b, groups): (&[f64], &[f64], &[Vec<usize>]),
    (start, is_near): (Option<&[[f64; 2]]>, bool),
    tolerable: f64,
    memory: &mut Memory,
) -> Option<Answer> {
    if greatest(b) == 0.0 {
        return None;
    }
    let yielding = Yielding {
        contacts,
        g,
        b,
        inverse_masses: &inverse_masses(groups, g, contacts.len()),
    };
    // Whether it is led from soft contacts to stiff ones, and whether it returns to the last better solution: only the search on friction cones may need that.
    let searches: &[(bool, bool)] = match (is_in_space(contacts), is_near) {
        (false, _) => &[(false, false)],
        (true, false) => &[(true, false), (true, true)],
        (true, true) => &[(false, false), (true, false), (true, true)],
    };
    searches.iter().find_map(|search| {
        let found = yielding.stiffened(start, *search, tolerable, memory);
        found.filter(|answer| answer.residual <= tolerable)
    })
}

/// A problem of contacts that yield.
struct Yielding<'a> {
    contacts: &'a [ContactUnknowns],
    g: &'a [f64],
    b: &'a [f64],
    /// 0 for contacts that do not yield.
    inverse_masses: &'a [f64],
}

impl Yielding<'_> {
    /// The best solution as the contacts become ever stiffer. Friction in space may permit several, between which the search may jump. Then it either goes
    /// on from any, or it goes on only from better ones and `returns` to the last one of these, with contacts that have become less stiff. A residual that
    /// is `tolerable` does not need stiffer ones than usual.
    fn stiffened(
        &self,
        start: Option<&[[f64; 2]]>,
        (is_led, returns): (bool, bool),
        tolerable: f64,
        memory: &mut Memory,
    ) -> Option<Answer> {
        let [first_part, share, last_part] = COMPLIANCE;
        let mut part = if is_led { first_part } else { last_part };
        let mut c = vec![0.0; self.contacts.len()];
        let mut forces = start.map(<[_]>::to_vec);
        let (mut best, mut part_of_best): (Option<Answer>, f64) = (None, f64::INFINITY);
        for _ in 0..ROUNDS {
            let known = best.as_ref().map_or(f64::INFINITY, |best| best.residual);
            let found = self.solve(part, &c, forces.as_deref(), memory);
            let Some((answer, next)) =
                found.filter(|(answer, _)| !returns || answer.residual < known)
            else {
                if !returns || best.is_none() || part > NEAREST * part_of_best {
                    break;
                }
                part = (part * part_of_best).sqrt();
                continue;
            };
            let is_slow = part <= last_part && answer.residual > 0.5 * known;
            let suffices = part <= STIFFEST || answer.residual <= tolerable;
            let is_last = answer.residual <= RIGID || (is_slow && suffices);
            c = next;
            forces = Some(answer.forces.clone());
            if answer.residual < known {
                (best, part_of_best) = (Some(answer), part);
            }
            if is_last {
                break;
            }
            part = if is_slow {
                (share * part).max(STIFFEST)
            } else {
                (share * part).max(last_part).min(part)
            };
        }
        best
    }

    /// A solution with contacts that yield by this part of the greatest compliance and press with c where they do not move, and c for the next problem. Its
    /// residual is that of rigid contacts.
    fn solve(
        &self,
        part: f64,
        c: &[f64],
        near: Option<&[[f64; 2]]>,
        memory: &mut Memory,
    ) -> Option<(Answer, Vec<f64>)> {
        let Self { contacts, g, b, .. } = *self;
        let (width, rate) = (b.len(), greatest(b));
        let yields = || (0..c.len()).filter(|k| self.inverse_masses[*k] > 0.0);
        let compliance = |k: usize| part * self.inverse_masses[k];
        let (mut yielding, mut shifted) = (g.to_vec(), b.to_vec());
        for k in yields() {
            yielding[2 * k * width + 2 * k] += compliance(k);
            shifted[2 * k] -= compliance(k) * c[k];
        }
        let mut answer = Answer::default();
        let of_problem = (&mut answer, &mut memory.problem);
        problem::solve_into(contacts, (&yielding, &shifted), near, of_problem).ok()?;
        let (mut left, mut next) = (0.0_f64, c.to_vec());
        for k in yields() {
            let row = &g[2 * k * width..][..width];
            let opens = b[2 * k] + dot(row, answer.forces.as_flattened());
            next[k] -= opens / compliance(k);
            // A contact that does not press may open at any rate.
            let presses = answer.forces[k][0] > 0.0;
            left = left.max(if presses { opens.abs() } else { -opens });
        }
        answer.residual = answer.residual.max(left / rate);
        Some((answer, next))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three feet of a body of unit mass and inertia, at these levers and below it by `height`, that slide on a plane with friction: the products of their
    /// rows, and the rates of gaps and slips.
    fn three_feet(levers: [f64; 3], height: f64) -> (Vec<ContactUnknowns>, Vec<f64>, Vec<f64>) {
        let rows = levers.map(|lever| [[0.0, 1.0, lever], [1.0, 0.0, height]]);
        let rows = rows.as_flattened();
        let product = |a: &[f64; 3], b: &[f64; 3]| dot(a, b);
        let g = rows
            .iter()
            .flat_map(|a| rows.iter().map(move |b| product(a, b)));
        (
            vec![ContactUnknowns::Normal { share: -0.1 }; 3],
            g.collect(),
            [[-1.0, 0.5]; 3].as_flattened().to_vec(),
        )
    }

    /// Feet at the height of the centre of mass have normal forces `a + b x` with `Σ N = 1` and `Σ N x = 0`, however short their levers x are.
    #[test]
    fn short_levers_share_a_load_as_long_ones_do() {
        for size in [1.0, 0.1, 1e-2, 1e-3, 1e-4] {
            let x = [-size, 0.3 * size, size];
            let (contacts, g, b) = three_feet(x, 0.0);
            let answer = solve(&contacts, &g, &b).expect("solved");
            assert!(answer.shared_otherwise.is_empty(), "{size}: {answer:?}");
            // The forces solve 3 a + 0.3 b = 1 and 0.3 a + 2.09 b = 0, with b in units of 1/size.
            let (a, slope) = (2.09 / 6.18, -0.3 / 6.18);
            for (force, x) in answer.forces.iter().zip(x) {
                let expected = a + slope * x / size;
                // Rates that are 0 to within 1e-11 determine forces at levers of this size.
                let error = (force[0] - expected).abs();
                assert!(error <= 1e-11 / (size * size), "{size}: {answer:?}");
            }
        }
    }

    /// If the rates of the levers are too small to determine forces, but larger than rounding, the answer states that another distribution was taken.
    #[test]
    fn another_distribution_is_reported() {
        let (contacts, g, b) = three_feet([-1e-9, 3e-10, 1e-9], 0.3);
        let answer = solve(&contacts, &g, &b).expect("solved");
        assert_eq!(answer.shared_otherwise, [0, 1, 2]);
        let sum: f64 = answer.forces.iter().map(|force| force[0]).sum();
        assert!((sum - 1.0).abs() <= 1e-9, "{answer:?}");
        // Without friction no motion depends on it.
        let smooth = vec![ContactUnknowns::Normal { share: 0.0 }; 3];
        let answer = solve(&smooth, &g, &b).expect("solved");
        assert!(answer.shared_otherwise.is_empty());
    }
}
