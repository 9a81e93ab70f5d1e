//! Coordinates that are approximated, to match a paper or a linear theory.
//!
//! Approximations act on energies, before Lagrange's equations are formed: equations derived from
//! an energy conserve it, while equations truncated one by one need not. Forces, torques, outputs
//! and positions stay exact. If both kinds occur, velocities are frozen first; the energies built
//! from them are then truncated to second order.

use lagrangian_symbolic::{Dag, Expr, Function, Id, Node, Symbol, Tangent, reachable, substitute};

use super::kinematics::{Motion, Variables};
use lagrangian_spec::model::{ApproximationKind, Model, stage};

/// The approximations of a machine.
pub(super) struct Approximations<'d> {
    dag: &'d Dag,
    /// Coordinates whose sine is replaced by 0 and whose cosine by 1 in velocities.
    frozen: Vec<Symbol>,
    /// Coordinates and their rates in which energies are expanded to second order.
    small: Vec<Symbol>,
}

impl<'d> Approximations<'d> {
    pub fn of(model: &Model<'d>) -> Approximations<'d> {
        let x = Variables::of(model);
        let coordinates = |kind: ApproximationKind| {
            let list = model.approximations.iter().filter(move |a| a.kind == kind);
            list.map(|a| a.coordinate).collect::<Vec<_>>()
        };
        let small = coordinates(ApproximationKind::Small);
        Approximations {
            dag: model.dag,
            frozen: coordinates(ApproximationKind::Frozen)
                .iter()
                .map(|&i| x.q[i])
                .collect(),
            small: small.iter().flat_map(|&i| [x.q[i], x.v[i]]).collect(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.frozen.is_empty() && self.small.is_empty()
    }

    /// Frozen coordinates, eq. (E16): `sin θ → 0` and `cos θ → 1` in velocities, after differentiating.
    ///
    /// In angles like `θ + φ` this is `θ → 0`, by the addition theorems. Elsewhere `θ` stays.
    pub fn motion(&self, motion: &Motion<'d>) -> Motion<'d> {
        if self.frozen.is_empty() {
            return motion.clone();
        }
        let freeze = |list: &[Expr<'d>]| freeze_angles(self.dag, list, &self.frozen);
        Motion {
            linear: freeze(&motion.linear),
            angular: freeze(&motion.angular),
        }
    }

    /// Small coordinates, eq. (E17): energies to second order in coordinates and rates together,
    /// `f(εθ, εθ̇) = f₀ + ε f₁ + ½ ε² f₂ + …` at `ε = 1`.
    ///
    /// Undefined if an energy has no such expansion: a distance that vanishes at `θ = 0` is not differentiable there.
    pub fn energies(&self, energies: &[Expr<'d>]) -> Vec<Expr<'d>> {
        if self.small.is_empty() {
            return energies.to_vec();
        }
        let dag = self.dag;
        let epsilon = dag.symbol("ε", stage::PARAMETER);
        let epsilon_symbol = epsilon.as_symbol().expect("just made as a symbol");
        let scale: Vec<_> = self
            .small
            .iter()
            .map(|&s| (s, epsilon * dag.expr_of(s)))
            .collect();
        let mut slope = Tangent::new(dag, &[(epsilon_symbol, dag.one())]);
        let expansion = |&energy: &Expr<'d>| {
            let scaled = substitute(dag, &[energy], &scale)[0];
            let first = slope.of(scaled);
            let second = slope.of(first);
            let orders = [scaled, first, second];
            let at_zero = substitute(dag, &orders, &[(epsilon_symbol, dag.zero())]);
            dag.sum([at_zero[0], at_zero[1], at_zero[2] / 2])
        };
        energies.iter().map(expansion).collect()
    }

    /// [`Self::energies`] of one energy.
    pub fn energy(&self, energy: Expr<'d>) -> Expr<'d> {
        self.energies(&[energy])[0]
    }
}

/// Sets symbols to 0 inside sines and cosines, and nowhere else.
fn freeze_angles<'d>(dag: &'d Dag, roots: &[Expr<'d>], frozen: &[Symbol]) -> Vec<Expr<'d>> {
    let to_zero: Vec<_> = frozen.iter().map(|&symbol| (symbol, dag.zero())).collect();
    let mut replaced: std::collections::BTreeMap<Id, Expr<'d>> = Default::default();
    for id in reachable(dag, roots) {
        let new = |child: &Id| replaced.get(child).copied().unwrap_or(dag.expr(*child));
        let expression = match dag.node(id) {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => continue,
            Node::Sum(terms) => dag.sum(terms.iter().map(|(x, c)| new(x) * c.clone())),
            Node::Product(factors) => dag.product(factors.iter().map(|(x, n)| new(x).powi(*n))),
            Node::Function(function @ (Function::Sin | Function::Cos), arguments) => {
                let angle = substitute(dag, &[dag.expr(arguments[0])], &to_zero)[0];
                dag.function(function, &[angle])
            }
            Node::Function(function, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(new).collect();
                dag.function(function, &arguments)
            }
        };
        if expression.id() != id {
            replaced.insert(id, expression);
        }
    }
    roots
        .iter()
        .map(|root| replaced.get(&root.id()).copied().unwrap_or(*root))
        .collect()
}
