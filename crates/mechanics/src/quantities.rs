//! The quantities of the table (`lagrangian_program::quantity`) as expressions, together with the numbers that prove them.
//!
//! A quantity whose numbers the literal equations give one by one is a [`Definition`], in a file of `quantities/`: its expressions, and the
//! numbers with which a proof compares the program. A new quantity is such a file with its line in `definitions!`, and a row of the table;
//! everything that evaluates, emits, prints or forwards quantities reads the row.
//!
//! The others are compared in combinations, by the modules of `proof`: `M`, `h` and `Q` along a direction, the rows of constraints and contacts
//! along it, accelerations by substitution. Their expressions are those of the [`Equations`].

mod constraints;
mod contact_faces;
mod energies;
mod power;

use lagrangian_program::quantity::Sizes;
use lagrangian_program::{Role, Shape};
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use crate::Equations;
use crate::equations::literal::{Lagrange, Literal, State};

/// A quantity of a machine as expressions.
#[derive(Clone, Debug)]
pub struct Quantity<'d> {
    /// Its role.
    pub role: Role,
    /// How the values are arranged.
    pub shape: Shape,
    /// The values, [`Shape::len`] of them, over the symbols of the model.
    pub values: Vec<Expr<'d>>,
}

/// The literal equations at a state.
pub(crate) struct LiterallyAt<'a, 'd, R> {
    /// The equations, for what they do not compute at every state.
    pub machine: &'a Lagrange<'a, 'd>,
    /// The state.
    pub state: &'a State<R>,
    /// What they compute at every state.
    pub literal: &'a Literal<R>,
}

/// A quantity whose numbers are proved one by one.
trait Definition {
    /// Its row in the table.
    const ROLE: Role;

    /// Its numbers as expressions over the symbols of the model.
    fn expressions<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>>;

    /// Its numbers from the literal equations, which share neither a velocity nor a derivative nor a simplification with the expressions.
    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R>;
}

/// Writes the functions that go through all definitions.
macro_rules! definitions {
    ($($definition:ty),+ $(,)?) => {
        /// The numbers of a quantity as expressions, if it is a [`Definition`].
        fn of_definition<'d>(
            role: Role,
            model: &Model<'d>,
            equations: &Equations<'d>,
        ) -> Option<Vec<Expr<'d>>> {
            $(if role == <$definition>::ROLE {
                return Some(<$definition>::expressions(model, equations));
            })+
            None
        }

        /// The numbers of all quantities that are a [`Definition`], from the literal equations.
        pub(crate) fn literal_values<R: Scalar>(
            at: &LiterallyAt<'_, '_, R>,
        ) -> Vec<(Role, Vec<R>)> {
            vec![$((<$definition>::ROLE, <$definition>::literal(at))),+]
        }
    };
}

definitions! {
    energies::KineticEnergy,
    energies::PotentialEnergy,
    energies::StateEnergy,
    energies::Dissipation,
    power::DissipationRate,
    constraints::ConstraintPositions,
    constraints::ConstraintRates,
    contact_faces::ContactFaces,
}

/// The quantities of a machine, in the order of [`Role`]; accelerations follow from them.
pub fn quantities<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    let outputs = (0..equations.outputs.len()).map(Role::Output);
    let facts = (0..model.assumptions.len()).map(Role::Assumption);
    let own = Role::all().filter(|role| !matches!(role, Role::Output(_) | Role::Assumption(_)));
    let roles = own.chain(outputs).chain(facts);
    roles
        .filter_map(|role| quantity(model, equations, role))
        .collect()
}

/// A quantity as expressions; `None` if the machine does not have it, or if it follows from others.
pub(crate) fn quantity<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    role: Role,
) -> Option<Quantity<'d>> {
    let sizes = sizes(model, equations);
    if !role.row().needs.are_met(sizes) {
        return None;
    }
    let values =
        of_definition(role, model, equations).or_else(|| of_equations(role, model, equations))?;
    Some(Quantity {
        role,
        shape: role.row().extent.shape(sizes)?,
        values,
    })
}

/// The numbers of items of a machine.
fn sizes(model: &Model<'_>, equations: &Equations<'_>) -> Sizes {
    let unilateral = equations.unilateral.iter();
    Sizes {
        coordinates: model.coordinates.len(),
        constraints: equations.constraints.len(),
        contacts: equations.sliding.len(),
        reaction_axes: model.space.reaction_axes(),
        unilateral: equations.unilateral.len(),
        faces: unilateral.filter(|u| u.face.is_some()).count(),
        guides: equations.guides.len(),
        derivatives: model.derivatives.len(),
        stores: model.energies_of_states().next().is_some(),
    }
}

/// The numbers of a quantity that is proved together with others; `None` if it is no expression of the equations.
fn of_equations<'d>(
    role: Role,
    model: &Model<'d>,
    equations: &Equations<'d>,
) -> Option<Vec<Expr<'d>>> {
    let (constraints, sliding) = (equations.constraints.iter(), equations.sliding.iter());
    let (unilateral, guides) = (equations.unilateral.iter(), equations.guides.iter());
    let directions = equations.unilateral.iter().flat_map(|u| &u.directions);
    Some(match role {
        Role::MassMatrix => equations.mass_matrix.lower().to_vec(),
        Role::Bias => equations.bias.clone(),
        Role::Applied => equations.applied.clone(),
        Role::Forces => equations.forces.clone(),
        Role::WorkRate => vec![equations.work_rate],
        Role::ConstraintMatrix => constraints.flat_map(|c| c.row.iter().copied()).collect(),
        Role::ConstraintBias => constraints.map(|c| c.bias).collect(),
        Role::Slips => sliding.map(|s| s.slip).collect(),
        Role::SlipMatrix => sliding.flat_map(|s| s.row.iter().copied()).collect(),
        Role::SlipBias => sliding.map(|s| s.bias).collect(),
        Role::Gaps => unilateral.map(|u| u.gap).collect(),
        Role::ContactRates => directions.map(|d| d.rate).collect(),
        Role::ContactMatrix => directions.flat_map(|d| d.row.iter().copied()).collect(),
        Role::ContactBias => directions.map(|d| d.bias).collect(),
        Role::ContactCoefficients => unilateral.flat_map(|u| u.coefficients).collect(),
        Role::GuideMatrix => guides
            .flat_map(|reaction| reaction.coefficients())
            .collect(),
        Role::GuideLoads => guides.map(|reaction| reaction.load).collect(),
        Role::Output(index) => vec![equations.outputs[index]],
        Role::Assumption(index) => vec![model.assumptions[index].excess],
        // These are found by elimination, or are not expressions of the equations.
        _ => return None,
    })
}
