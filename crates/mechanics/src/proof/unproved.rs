//! The messages about a program that could not be proved.

use std::fmt;

use super::Disagreement;
use crate::equations::literal::Lagrange;
use lagrangian_program::quantity::{Entry, ItemKind};
use lagrangian_program::{Program, Role};
use lagrangian_spec::diagnostic::{Code, Diagnostic};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Node, reachable};

/// Why a program is not emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Unproved {
    /// What is wrong.
    pub disagreement: Disagreement,
    /// Where it was seen.
    pub witness: Witness,
    /// What is wrong, in the names of the spec.
    pub(super) description: String,
}

/// The numbers in which a program was found to differ from the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Witness {
    /// The numbers of the prime field.
    Field,
    /// The numbers of the prime field alone, since round-off left the states in double-doubles undecided. The field does not know
    /// every identity (see `lagrangian_scalar::residue`), so the program may be right.
    FieldAlone,
    /// Double-doubles with a bound of their error.
    States,
}

impl Unproved {
    /// The message for the user, at the name of the machine.
    pub fn diagnostic(&self, model: &Model<'_>) -> Diagnostic {
        match self.disagreement {
            Disagreement::Undefined => Diagnostic::new(
                Code::Undefined,
                model.span,
                "no state was found at which the equations of motion have a value",
            )
            .help("something divides by zero, or takes a root or a logarithm that does not exist; if there are such states, give the coordinates start values near one of them"),
            Disagreement::Exhausted { comparisons } => Diagnostic::new(
                Code::TooLarge,
                model.span,
                format!("this machine could not be proved: {comparisons} states were compared, and too few of them have accelerations"),
            )
            .help("the size of its equations limits the number of states that are compared; if it is singular at most states, state what holds it, or make it smaller"),
            _ if self.witness == Witness::FieldAlone => self.undecided(model),
            _ => Diagnostic::new(Code::Internal, model.span, self.to_string()).help(
                "this is a defect of lagrangian, not of the spec: nothing was emitted; please report it together with the spec",
            ),
        }
    }

    /// The message where the prime field says something that round-off in double-doubles does not confirm.
    fn undecided(&self, model: &Model<'_>) -> Diagnostic {
        match distant_numbers(model) {
            Some([least, greatest]) => Diagnostic::new(
                Code::TooLarge,
                model.span,
                format!("{self}: its equations contain numbers from {least:e} to {greatest:e}"),
            )
            .help(
                "numbers so many orders of magnitude apart cancel each other's digits: give positions relative to a point near the machine, and leave out what has no effect beside the rest; angles of more than 20 decimals are another reason, which fractions of `pi` avoid",
            ),
            None => Diagnostic::new(Code::Internal, model.span, self.to_string()).help(
                "the prime field knows angles of at most 20 decimals, and round-off is small where the parameters of the machine are not many orders of magnitude apart: shorten such angles or write them as fractions of `pi`, or scale the parameters; if neither is the reason, please report the spec",
            ),
        }
    }
}

/// The least and the greatest size of the numbers in the equations of a machine, and of the defaults of its parameters, other than 0, where they are further apart than numbers with
/// 53 bits can be in one sum.
fn distant_numbers(model: &Model<'_>) -> Option<[f64; 2]> {
    let machine = Lagrange::of(model, |_| true);
    let nodes = reachable(model.dag, &machine.roots);
    let in_equations = nodes.iter().filter_map(|id| match model.dag.node(*id) {
        Node::Constant(value) => Some(value.to_f64()),
        _ => None,
    });
    let defaults = model.parameters.iter().filter_map(|p| p.default);
    let defaults = defaults.filter_map(|value| Some(value.as_constant()?.to_f64()));
    let sizes = in_equations.chain(defaults).map(f64::abs);
    let [least, greatest] = sizes
        .filter(|size| *size > 0.0)
        .fold([f64::INFINITY, 0.0_f64], |[least, greatest], size| {
            [least.min(size), greatest.max(size)]
        });
    (greatest * f64::EPSILON > least).then_some([least, greatest])
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let witness = match self.witness {
            Witness::Field | Witness::FieldAlone => "point",
            Witness::States => "state",
        };
        let seed = match self.disagreement {
            Disagreement::Result { point, .. }
            | Disagreement::Motion { point, .. }
            | Disagreement::Constraint { point, .. }
            | Disagreement::Reaction { point, .. }
            | Disagreement::Eliminated { point, .. }
            | Disagreement::Pivots { point } => format!(" (random {witness} {point})"),
            Disagreement::Singular(_)
            | Disagreement::Undefined
            | Disagreement::NotCompared { .. }
            | Disagreement::Exhausted { .. } => String::new(),
        };
        let description = &self.description;
        match self.witness {
            Witness::Field | Witness::States => write!(
                f,
                "the program generated for this machine is wrong: {description} what Lagrange's equations say{seed}"
            ),
            Witness::FieldAlone => write!(
                f,
                "the program generated for this machine could not be proved: in the prime field {description} what Lagrange's equations say{seed}, and in double-double arithmetic round-off leaves it undecided"
            ),
        }
    }
}

impl std::error::Error for Unproved {}

/// The subject of the sentence that a message completes with what Lagrange's equations say.
pub(super) fn subject_text(disagreement: &Disagreement, program: &Program) -> String {
    let member = |(kind, index): (ItemKind, usize)| {
        let name = program.member((kind, index));
        match kind {
            ItemKind::Coordinate => format!("`{name}`"),
            ItemKind::Constraint => format!("the constraint `{name}`"),
            ItemKind::Contact | ItemKind::Guide => format!("the guide `{name}`"),
            ItemKind::OnGuide => format!("`{name}`"),
            ItemKind::Unilateral | ItemKind::Face | ItemKind::Direction | ItemKind::Coefficient => {
                format!("the contact `{name}`")
            }
        }
    };
    let coordinate = |i: usize| member((ItemKind::Coordinate, i));
    let constraint = |k: usize| member((ItemKind::Constraint, k));
    let contact = |k: usize| member((ItemKind::Contact, k));
    match *disagreement {
        Disagreement::Result { role, index, .. } => {
            let of = match program.entry(role, index) {
                Entry::Whole => match role {
                    Role::Output(_) | Role::Assumption(_) => {
                        format!(" (`{}`)", program.title(role))
                    }
                    _ => String::new(),
                },
                Entry::Of(ItemKind::Coordinate, i) => format!(", in {},", coordinate(i)),
                Entry::Of(kind, i) => format!(", of {},", member((kind, i))),
                Entry::At(row @ (ItemKind::Coordinate, _), column) => {
                    format!(", in {} and {},", member(row), member(column))
                }
                Entry::At(row, column) => {
                    format!(", of {} by {},", member(row), member(column))
                }
                Entry::Rate(i) => format!(", the rate of {},", coordinate(i)),
                Entry::Derivative(i, variable) => {
                    let by = program.variable_name(variable);
                    format!(", in {}, by `{by}`,", coordinate(i))
                }
                Entry::Index(index) => format!(", result {index},"),
            };
            format!("`{}`{of} is not", role.name())
        }
        Disagreement::Motion { coordinate: i, .. } => format!(
            "`{}` violates the equation of motion of {}, contrary to",
            program.solving().name(),
            coordinate(i)
        ),
        Disagreement::Constraint { constraint: k, .. } => format!(
            "`{}` violates {}, contrary to",
            program.solving().name(),
            constraint(k)
        ),
        Disagreement::Reaction { contact: k, .. } => {
            format!("the normal reaction of {} is not", contact(k))
        }
        Disagreement::Eliminated {
            coordinate: i,
            constraint: k,
            ..
        } => format!(
            "{} was taken to settle {}, which is not",
            constraint(k),
            coordinate(i)
        ),
        Disagreement::Pivots { .. } => "the guard of the elimination is not".into(),
        Disagreement::Singular(singular) => format!(
            "the elimination stops at {}, contrary to",
            coordinate(singular.coordinate)
        ),
        Disagreement::NotCompared { role } => format!("nothing compares `{}` with", role.name()),
        Disagreement::Undefined | Disagreement::Exhausted { .. } => {
            "no state was found to compare it with".into()
        }
    }
}
