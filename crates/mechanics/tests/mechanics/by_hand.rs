//! The derived equations equal equations typed in by hand from a paper and from textbooks, and the comparison finds a single
//! wrong sign anywhere in these.

use lagrangian_print::compare::compare;
use lagrangian_spec::model::{Model, PublishedItem, stage};
use lagrangian_symbolic::{Dag, Expr, Id, Node, Rational, reachable};

use crate::harness::derived;

/// Vibrating crusher, with the single pair of springs and dampers of the paper and the exact platform angle. These
/// are the nine equations of the paper, corrected: `(ax, ay)` is the axis of the debalance in ground axes, which
/// the paper takes at `theta = 0`.
const CRUSHER: &str = r#"
machine PaperCrusher extends "vibrating_crusher.machine" {
    remove springs.x_right; remove springs.y_left;
    remove dampers.x_right; remove dampers.y_left;
    define {
        ax = x0*cos(theta) - y0*sin(theta),
        ay = x0*sin(theta) + y0*cos(theta),
    }
    published "by hand" {
        equation x:
            (m0 + m1 + m2 + m)*der(der(x)) - m0*ay*der(der(theta)) - m0*ax*der(theta)^2
            + (m1 + m2)*cos(phi1)*der(der(s1)) - (m1 + m2)*s1*sin(phi1)*der(der(phi1))
            + m2*cos(phi2)*der(der(s2)) - m2*s2*sin(phi2)*der(der(phi2))
            - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*cos(phi1)*der(phi1)^2
            - 2*m2*sin(phi2)*der(s2)*der(phi2) - m2*s2*cos(phi2)*der(phi2)^2
            + cx*(x - yc*theta) + bx*(der(x) - yc*der(theta))
            = m0*e*omega^2*cos(omega*t),
        equation y:
            (m0 + m1 + m2 + m)*der(der(y)) + m0*ax*der(der(theta)) - m0*ay*der(theta)^2
            + (m1 + m2)*sin(phi1)*der(der(s1)) + (m1 + m2)*s1*cos(phi1)*der(der(phi1))
            + m2*sin(phi2)*der(der(s2)) + m2*s2*cos(phi2)*der(der(phi2))
            + 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*sin(phi1)*der(phi1)^2
            + 2*m2*cos(phi2)*der(s2)*der(phi2) - m2*s2*sin(phi2)*der(phi2)^2
            + cy*(y + xc*theta) + by*(der(y) + xc*der(theta))
            = m0*e*omega^2*sin(omega*t),
        equation theta:
            - m0*ay*der(der(x)) + m0*ax*der(der(y)) + (J + m0*(x0^2 + y0^2))*der(der(theta))
            - cx*(x - yc*theta)*yc - bx*(der(x) - yc*der(theta))*yc
            + cy*(y + xc*theta)*xc + by*(der(y) + xc*der(theta))*xc
            = m0*e*omega^2*(ax*sin(omega*t) - ay*cos(omega*t)),
        equation theta1: J1*der(der(theta1)) = 0,
        equation theta2: J2*der(der(theta2)) = 0,
        equation s1:
            (m1 + m2)*cos(phi1)*der(der(x)) + (m1 + m2)*sin(phi1)*der(der(y)) + (m1 + m2)*der(der(s1))
            + m2*cos(phi2 - phi1)*der(der(s2)) - m2*s2*sin(phi2 - phi1)*der(der(phi2))
            - (m1 + m2)*s1*der(phi1)^2 - m2*s2*cos(phi2 - phi1)*der(phi2)^2
            - 2*m2*sin(phi2 - phi1)*der(phi2)*der(s2)
            = 0,
        equation s2:
            m2*cos(phi2)*der(der(x)) + m2*sin(phi2)*der(der(y)) + m2*cos(phi2 - phi1)*der(der(s1))
            + m2*sin(phi2 - phi1)*s1*der(der(phi1)) + m2*der(der(s2))
            + 2*m2*sin(phi2 - phi1)*der(s1)*der(phi1) - m2*cos(phi2 - phi1)*s1*der(phi1)^2
            - m2*s2*der(phi2)^2
            = 0,
        equation phi1:
            - (m1 + m2)*s1*sin(phi1)*der(der(x)) + (m1 + m2)*s1*cos(phi1)*der(der(y))
            + (m1 + m2)*s1^2*der(der(phi1)) + m2*sin(phi2 - phi1)*s1*der(der(s2))
            + 2*(m1 + m2)*s1*der(s1)*der(phi1) + m2*s1*s2*cos(phi2 - phi1)*der(der(phi2))
            + 2*m2*cos(phi2 - phi1)*s1*der(s2)*der(phi2) - m2*s2*sin(phi2 - phi1)*s1*der(phi2)^2
            = 0,
        equation phi2:
            - m2*s2*sin(phi2)*der(der(x)) + m2*s2*cos(phi2)*der(der(y))
            - m2*s2*sin(phi2 - phi1)*der(der(s1)) + m2*cos(phi2 - phi1)*s1*s2*der(der(phi1))
            + m2*s2^2*der(der(phi2)) + 2*m2*s2*cos(phi2 - phi1)*der(s1)*der(phi1)
            + m2*sin(phi2 - phi1)*s1*s2*der(phi1)^2 + 2*m2*s2*der(s2)*der(phi2)
            = 0,
    }
}
"#;

/// H. Goldstein, C. Poole, J. Safko, *Classical Mechanics*, ch. 1 and 6; here each equation is divided by its length.
const DOUBLE_PENDULUM: &str = r#"
machine Textbook extends "double_pendulum.machine" {
    published "by hand" {
        kinetic_energy = 1/2*(m1 + m2)*l1^2*der(theta1)^2 + 1/2*m2*l2^2*der(theta2)^2
            + m2*l1*l2*der(theta1)*der(theta2)*cos(theta1 - theta2),
        potential_energy = -(m1 + m2)*g*l1*cos(theta1) - m2*g*l2*cos(theta2),
        equation theta1:
            (m1 + m2)*l1*der(der(theta1)) + m2*l2*cos(theta1 - theta2)*der(der(theta2))
            + m2*l2*sin(theta1 - theta2)*der(theta2)^2 + (m1 + m2)*g*sin(theta1) = 0,
        equation theta2:
            l2*der(der(theta2)) + l1*cos(theta1 - theta2)*der(der(theta1))
            - l1*sin(theta1 - theta2)*der(theta1)^2 + g*sin(theta2) = 0,
    }
}
"#;

/// R. V. Florian, *Correct equations for the dynamics of the cart-pole system*, 2007, with a general inertia of
/// the pole and viscous friction.
const CART_POLE: &str = r#"
machine Textbook extends "cart_pole.machine" {
    published "by hand" {
        velocity pole = (der(x) + l*cos(theta)*der(theta), -l*sin(theta)*der(theta)),
        equation x:
            (cart + pole)*der(der(x)) + pole*l*cos(theta)*der(der(theta)) - pole*l*sin(theta)*der(theta)^2
            + rail*der(x) = push,
        equation theta:
            (J + pole*l^2)*der(der(theta)) + pole*l*cos(theta)*der(der(x)) - pole*g*l*sin(theta)
            + hinge*der(theta) = 0,
        force x = push - rail*der(x),
        dissipation = 1/2*rail*der(x)^2 + 1/2*hinge*der(theta)^2,
    }
}
"#;

/// H. Goldstein, C. Poole, J. Safko, *Classical Mechanics*, 3rd ed. 2002, section 5.7, from the Lagrangian (5.52), with the
/// inertia about the fixed point `A + m l²`.
const HEAVY_TOP: &str = r#"
machine Textbook extends "heavy_top.machine" {
    define { I1 = A + m*l^2 }
    published "by hand" {
        kinetic_energy = 1/2*I1*(der(theta)^2 + der(psi)^2*sin(theta)^2) + 1/2*C*(der(phi) + der(psi)*cos(theta))^2,
        potential_energy = m*g*l*cos(theta),
        equation psi:
            (I1*sin(theta)^2 + C*cos(theta)^2)*der(der(psi)) + C*cos(theta)*der(der(phi))
            + 2*(I1 - C)*sin(theta)*cos(theta)*der(psi)*der(theta) - C*sin(theta)*der(theta)*der(phi) = 0,
        equation theta:
            I1*der(der(theta)) - I1*sin(theta)*cos(theta)*der(psi)^2
            + C*(der(phi) + der(psi)*cos(theta))*sin(theta)*der(psi) - m*g*l*sin(theta) = 0,
        equation phi:
            der(der(phi)) + cos(theta)*der(der(psi)) - sin(theta)*der(psi)*der(theta) = 0,
    }
}
"#;

#[test]
fn the_papers_nine_equations_of_the_crusher_are_right_once_corrected() {
    assert_agreement(CRUSHER, 9);
}

#[test]
fn the_double_pendulum_is_the_textbooks() {
    assert_agreement(DOUBLE_PENDULUM, 4);
}

#[test]
fn cart_and_pole_are_the_textbooks() {
    assert_agreement(CART_POLE, 5);
}

#[test]
fn the_heavy_top_is_the_textbooks() {
    assert_agreement(HEAVY_TOP, 5);
}

#[test]
fn every_wrong_sign_and_coefficient_is_found() {
    for (text, least) in [
        (CRUSHER, 300),
        (DOUBLE_PENDULUM, 60),
        (CART_POLE, 40),
        (HEAVY_TOP, 50),
    ] {
        let (made, survivors) = mutate(text);
        assert!(survivors.is_empty(), "not found: {survivors:?}");
        assert!(made >= least, "{made} mutants");
    }
}

/// Everything that a machine publishes agrees, and there are `items` of it.
pub fn assert_agreement(text: &str, items: usize) {
    derived(text, |model, equations| {
        let comparisons = compare(model, equations);
        let wrong: Vec<_> = comparisons
            .iter()
            .filter(|item| !item.agrees)
            .map(|c| &c.item)
            .collect();
        assert!(wrong.is_empty(), "{wrong:?}");
        assert_eq!(comparisons.len(), items);
    });
}

/// Makes one mistake after another in what a machine publishes. Returns the number of mistakes, and those that
/// the comparison did not find.
pub fn mutate(text: &str) -> (usize, Vec<String>) {
    derived(text, |model, equations| {
        let mut wrong: Model = model.clone();
        let (mut made, mut survivors) = (0, Vec::new());
        let items: Vec<PublishedItem> = model
            .published
            .iter()
            .flat_map(|block| block.items.clone())
            .collect();
        for item in &items {
            for (component, &printed) in item.printed.iter().enumerate() {
                for mutant in mutants(model.dag, printed) {
                    let mut item = item.clone();
                    item.printed[component] = mutant;
                    let text = item.text.clone();
                    wrong.published[0].items = vec![item];
                    made += 1;
                    if compare(&wrong, equations)
                        .iter()
                        .all(|comparison| comparison.agrees)
                    {
                        survivors.push(format!("{text}: mutant {made}"));
                    }
                }
            }
        }
        (made, survivors)
    })
}

/// Copies of the formula with one sign flipped, one coefficient doubled, or one power raised, for each
/// place where that is possible.
fn mutants<'d>(dag: &'d Dag, formula: Expr<'d>) -> Vec<Expr<'d>> {
    let mut mutants = Vec::new();
    let nodes = reachable(dag, &[formula]);
    for &id in &nodes {
        let changed: Vec<Expr<'d>> = match dag.node(id) {
            // A formula of one term multiplied by a factor is the same equation.
            Node::Sum(terms) if terms.len() > 1 => (0..terms.len())
                .flat_map(|k| [(k, Rational::MINUS_ONE), (k, Rational::from(2))])
                .map(|(k, factor)| {
                    dag.sum(terms.iter().enumerate().map(|(i, (x, c))| {
                        let term = dag.expr(*x) * c.clone();
                        if i == k { term * factor.clone() } else { term }
                    }))
                })
                .collect(),
            Node::Product(factors) => (0..factors.len())
                // So is a formula that is a product, multiplied by a parameter.
                .filter(|&k| {
                    id != formula.id() || dag.expr(factors[k].0).stage() > stage::PARAMETER
                })
                .map(|k| dag.expr(id) * dag.expr(factors[k].0))
                .collect(),
            _ => Vec::new(),
        };
        mutants.extend(
            changed
                .into_iter()
                .map(|new| replaced(dag, formula, &nodes, id, new)),
        );
    }
    mutants
}

/// The formula with one node replaced.
fn replaced<'d>(dag: &'d Dag, formula: Expr<'d>, nodes: &[Id], old: Id, new: Expr<'d>) -> Expr<'d> {
    let mut map = std::collections::BTreeMap::from([(old, new)]);
    for &id in nodes.iter().filter(|&&id| id > old) {
        let at = |child: &Id| map.get(child).copied().unwrap_or(dag.expr(*child));
        let rebuilt = match dag.node(id) {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => continue,
            Node::Sum(terms) => dag.sum(terms.iter().map(|(x, c)| at(x) * c.clone())),
            Node::Product(factors) => dag.product(factors.iter().map(|(x, n)| at(x).powi(*n))),
            Node::Function(function, arguments) => {
                dag.function(function, &arguments.iter().map(at).collect::<Vec<_>>())
            }
        };
        map.insert(id, rebuilt);
    }
    map.get(&formula.id()).copied().unwrap_or(formula)
}
