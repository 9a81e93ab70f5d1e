//! Replaces the inertia of bars in the plane by masses at their joints.
//!
//! A bar turns at the rate `ω` about a moving joint `H`, and carries something else at a point `T`,
//! `u_T = u_H + l ω` with `l` across the bar. The velocity of a body on the line through both is
//! `u = (1 − λ) u_H + λ u_T`, and because `(u_T − u_H)² = l² ω²`,
//!
//! ```text
//! m u² = (1 − λ) m u_H² + λ m u_T² − λ (1 − λ) m l² ω²
//! ```
//!
//! So two masses and a remaining inertia are equivalent to the body in every motion. They are
//! computed in the parameter stage, after which only `H` and `T` occur in the equations. In a chain
//! of bars each joint has one mass. A centre of mass between the joints would cost each link ten
//! operations; this removes them all.
//!
//! The replacement is made if `λ` is known to be between 0 and 1: a number, as for the middle of a
//! uniform bar, or `c/l` if the spec assumes `c > 0` and `c <= l`. Then the terms are of the size of
//! those that they replace. The quotient of two arbitrary parameters may be large: for a short bar
//! with a distant centre of mass the masses would be large and of opposite signs, and the rotational
//! inertia would lose as many digits. A bar of length zero would be a valid machine, but the quotient
//! would be undefined.
//!
//! `equations/composite.rs` makes the same substitution in space; the idea is from W. Khalil and
//! J.-F. Bennis, *Symbolic calculation of the base inertial parameters of closed-loop robots*, Int.
//! J. Robotics Res. 14 (1995) 112–128.

use std::collections::BTreeMap;

use lagrangian_symbolic::{Expr, Id, Node, Rational, Stage};

use crate::{InertialPair, Unprojected};
use lagrangian_spec::model::Assumption;

/// A component of the velocity of a point on a bar: `u = u_H + c ω`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm<'d> {
    /// `u_H`.
    pub joint: Id,
    /// `ω`.
    pub angular_velocity: Id,
    /// `c`.
    pub lever: Expr<'d>,
    /// Whether other velocities are built from it.
    pub has_dependents: bool,
}

/// Replaces bodies by masses at the joints of their bars.
///
/// `arms` are the velocity components of points on bars. `None` if there is nothing to replace.
pub(super) fn replaced<'d>(
    machine: &Unprojected<'d>,
    arms: &BTreeMap<Id, Arm<'d>>,
    assumptions: &[Assumption<'d>],
) -> Option<Unprojected<'d>> {
    if !machine.has_bias_accelerations {
        return None;
    }
    let mut replaced = machine.clone();
    let carried = dependents_of_bars(arms);
    let mut gone: Vec<Bar<'d>> = Vec::new();
    replaced.inertia.clear();
    let mut rest = machine.inertia.as_slice();
    while let Some((&first, others)) = rest.split_first() {
        rest = others;
        let on_bar = others
            .first()
            .and_then(|&second| bar([first, second], arms, &carried, assumptions));
        let Some(bar) = on_bar else {
            replaced.inertia.push(first);
            continue;
        };
        rest = &others[1..];
        let mass = first.weight;
        let dag = mass.dag();
        let (near, far) = (mass * (1 - bar.share), mass * bar.share);
        // A load on the body, including its fall, is divided between the ends in these proportions.
        let falls = [first.free_fall, others[0].free_fall];
        for ((joint, tip), fall) in bar.joint.iter().zip(&bar.tip).zip(falls) {
            for (end, mass) in [(joint, near), (tip, far)] {
                let end = dag.expr(*end);
                replaced.inertia.push(InertialPair {
                    free_fall: fall,
                    ..InertialPair::without_gravity(end, end, mass)
                });
            }
        }
        let turning = dag.expr(bar.angular_velocity);
        // λ² l² and λ l² are products of lengths, without a quotient.
        let [squared, single] = [2, 1].map(|power| bar.share.powi(power) * bar.length_squared);
        let left = mass * (squared - single);
        let left = InertialPair::without_gravity(turning, turning, left);
        replaced.inertia.push(left);
        gone.push(bar);
    }
    if gone.is_empty() {
        return None;
    }
    let on = |u: Expr<'d>| {
        gone.iter().find_map(|bar| {
            let component = bar.body.iter().position(|id| *id == u.id())?;
            let ends = [bar.joint[component], bar.tip[component]];
            Some((bar, ends.map(|id| u.dag().expr(id))))
        })
    };
    replaced.loads.clear();
    for &(u, load) in &machine.loads {
        match on(u) {
            Some((bar, [joint, tip])) => {
                let parts = [(joint, load * (1 - bar.share)), (tip, load * bar.share)];
                replaced.loads.extend(parts);
            }
            None => replaced.loads.push((u, load)),
        }
    }
    Some(replaced)
}

/// A body on a bar.
struct Bar<'d> {
    body: [Id; 2],
    joint: [Id; 2],
    tip: [Id; 2],
    angular_velocity: Id,
    /// `λ`.
    share: Expr<'d>,
    /// `l²`.
    length_squared: Expr<'d>,
}

/// The points on each bar that carry something, with one component each.
fn dependents_of_bars(arms: &BTreeMap<Id, Arm<'_>>) -> BTreeMap<(Id, Id), Vec<Id>> {
    let mut carried: BTreeMap<(Id, Id), Vec<Id>> = BTreeMap::new();
    for (id, arm) in arms.iter().filter(|(_, arm)| arm.has_dependents) {
        carried
            .entry((arm.joint, arm.angular_velocity))
            .or_default()
            .push(*id);
    }
    carried
}

/// The bar that a point is on, if there is another point in the same direction from its joint.
fn bar<'d>(
    inertia: [InertialPair<'d>; 2],
    arms: &BTreeMap<Id, Arm<'d>>,
    carried: &BTreeMap<(Id, Id), Vec<Id>>,
    assumptions: &[Assumption<'d>],
) -> Option<Bar<'d>> {
    let [first, second] = inertia;
    let (x, y, weight) = (first.u, second.u, first.weight);
    let is_point = x == first.w && y == second.w && weight == second.weight;
    if !is_point || weight.stage() > Stage::PARAMETER {
        return None;
    }
    let body = [x.id(), y.id()];
    let [at_x, at_y] = [arms.get(&body[0])?, arms.get(&body[1])?];
    if at_x.angular_velocity != at_y.angular_velocity || at_x.joint == at_y.joint {
        return None;
    }
    let fixed = |e: Expr<'d>| e.stage() <= Stage::PARAMETER;
    let others = |arm: &Arm<'d>| {
        let points = carried.get(&(arm.joint, arm.angular_velocity));
        points.into_iter().flatten().copied()
    };
    for tip_x in others(at_x).filter(|id| !body.contains(id)) {
        let share = at_x.lever / arms[&tip_x].lever;
        if !is_share(share, assumptions) {
            continue;
        }
        let is_tip = |id: &Id| at_y.lever == share * arms[id].lever;
        let Some(tip_y) = others(at_y).filter(|id| !body.contains(id)).find(is_tip) else {
            continue;
        };
        let length_squared = arms[&tip_x].lever.square() + arms[&tip_y].lever.square();
        if fixed(length_squared) {
            return Some(Bar {
                body,
                joint: [at_x.joint, at_y.joint],
                tip: [tip_x, tip_y],
                angular_velocity: at_x.angular_velocity,
                share,
                length_squared,
            });
        }
    }
    None
}

/// Whether a quotient of lengths is known to be in [0, 1]: it is `c/l`, and `c > 0` and `c <= l` are assumed.
fn is_share(share: Expr<'_>, assumptions: &[Assumption<'_>]) -> bool {
    if let Node::Constant(share) = share.node() {
        return (Rational::ZERO..=Rational::ONE).contains(&share);
    }
    if share.stage() > Stage::PARAMETER {
        return false;
    }
    let symbols = share.symbols();
    let positive = assumptions
        .iter()
        .filter(|fact| fact.strict && fact.excess.symbols().is_subset(&symbols));
    positive.map(|fact| fact.excess).any(|part| {
        let rest = part / share - part;
        assumptions.iter().any(|fact| fact.excess == rest)
    })
}
