//! Finds the brachistochrone problem of a machine, and tests conditions (17) on it.
//!
//! ```text
//! a_αβ constant    Q_α = −c_α constant    slip τ, load ν, weights ρ and μ of every guide constant
//! ```
//!
//! The letters are those of D. Đurić, *On Brachistochronic Motion of a Multibody System with Real Constraints*: `b_α = Σ μ
//! ν τ_α` and `d_αβ = Σ μ τ_α ρ_β` belong to the power of friction `−b·v − v·d a`. Constant forces other than gravity
//! count as gradients of a potential.
//!
//! Without these conditions masses, forces and friction may depend on coordinates, and forces on velocities too; then
//! `−Q_α` includes the inertia forces due to velocities.

use std::fmt;

use lagrangian_symbolic::{Expr, Symbol};

use super::{Equations, SlidingEquation};
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;

/// The brachistochrone problem of a machine, over symbols of parameters.
#[derive(Clone, Debug)]
pub struct Brachistochronic<'d> {
    /// `a_αβ`, by rows.
    pub mass: Vec<Vec<Expr<'d>>>,
    /// `c_α = −Q_α`, inertia forces included.
    pub slope: Vec<Expr<'d>>,
    /// The guides that slide.
    pub guides: Vec<SlidingGuide<'d>>,
}

/// A guide that slides, with its normal reaction `N = ν + ρ·a + Σ κ F`, where `F = −μ N` is the
/// friction of each guide.
#[derive(Clone, Debug)]
pub struct SlidingGuide<'d> {
    /// Its name.
    pub name: String,
    /// `τ`.
    pub along: Vec<Expr<'d>>,
    /// `ν`, in N.
    pub load: Expr<'d>,
    /// `ρ`.
    pub weights: Vec<Expr<'d>>,
    /// `κ`, one for each guide in order.
    pub by_friction_forces: Vec<Expr<'d>>,
    /// `μ`.
    pub friction: Expr<'d>,
}

/// A condition that a machine does not meet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnmetCondition {
    /// A coefficient depends on something that changes along the motion.
    Varies {
        /// The coefficient.
        coefficient: String,
        /// The coordinate, its rate as `der(q)`, the input, or `t`.
        variable: String,
    },
    /// The normal reaction of a guide in space is the magnitude of a vector.
    SpatialGuide {
        /// The guide.
        guide: String,
    },
    /// The machine has constraints, so its coordinates are not independent.
    Constrained,
    /// A quaternion turns a frame, and its length is not part of the motion.
    Quaternion,
    /// There are no coordinates.
    NoCoordinates,
}

impl fmt::Display for UnmetCondition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Varies {
                coefficient: what,
                variable: with,
            } => write!(f, "{what} depends on `{with}`"),
            Self::SpatialGuide { guide } => write!(
                f,
                "friction of the guide `{guide}` is proportional to the magnitude of a vector, and not to a force along one normal"
            ),
            Self::Constrained => {
                write!(
                    f,
                    "the machine has constraints, so its coordinates are not independent"
                )
            }
            Self::Quaternion => write!(
                f,
                "a frame is turned by a quaternion, whose length is not part of the motion: turn it by angles"
            ),
            Self::NoCoordinates => write!(f, "the machine has no coordinates"),
        }
    }
}

impl<'d> Brachistochronic<'d> {
    /// The problem under (17).
    ///
    /// # Errors
    /// Every condition that is not met, each with the first variable on which a coefficient depends.
    pub fn of(model: &Model<'d>, equations: &Equations<'d>) -> Result<Self, Vec<UnmetCondition>> {
        Self::with_dependences(model, equations, [Dependence::Parameters; 2])
    }

    /// The problem with masses and friction that depend on coordinates, and forces and loads that depend on velocities too.
    ///
    /// # Errors
    /// As for [`of`](Self::of): constraints, explicit time, inputs, and friction that depends
    /// on velocities.
    pub fn position_dependent(
        model: &Model<'d>,
        equations: &Equations<'d>,
    ) -> Result<Self, Vec<UnmetCondition>> {
        Self::with_dependences(
            model,
            equations,
            [Dependence::Coordinates, Dependence::Rates],
        )
    }

    fn with_dependences(
        model: &Model<'d>,
        equations: &Equations<'d>,
        [of_place, of_motion]: [Dependence; 2],
    ) -> Result<Self, Vec<UnmetCondition>> {
        let mut unmet = Vec::new();
        let n = model.coordinates.len();
        if n == 0 {
            unmet.push(UnmetCondition::NoCoordinates);
        }
        if !equations.constraints.is_empty() || !model.contacts.is_empty() {
            unmet.push(UnmetCondition::Constrained);
        }
        if !model.quaternions.is_empty() {
            unmet.push(UnmetCondition::Quaternion);
        }
        let name = |i: usize| model.coordinates[i].name.to_string();
        let mass = (0..n).map(|i| {
            let entries = (0..n).map(|j| {
                let entry_name = format!(
                    "the mass a of `{}` and `{}`",
                    name(i.max(j)),
                    name(i.min(j))
                );
                let entry = *equations.mass_matrix.get(i.max(j), i.min(j));
                checked(model, entry, &entry_name, of_place, &mut unmet)
            });
            entries.collect()
        });
        let mass: Vec<Vec<Expr<'d>>> = mass.collect();
        let slope = (0..n).map(|i| {
            let force = format!("the force on `{}`", name(i));
            // Inertia forces due to explicit time or a changing mass count as forces too.
            let drive = format!("the inertia force on `{}`", name(i));
            let applied = checked(model, equations.applied[i], &force, of_motion, &mut unmet);
            let bias = checked(model, equations.bias[i], &drive, of_motion, &mut unmet);
            bias - applied
        });
        let slope = slope.collect();
        let guides = equations.sliding.iter();
        let guides = guides
            .filter_map(|sliding| sliding_guide(model, sliding, [of_place, of_motion], &mut unmet))
            .collect();
        // The matrix is symmetric, and each entry is reported once.
        let mut distinct = Vec::new();
        for condition in unmet {
            if !distinct.contains(&condition) {
                distinct.push(condition);
            }
        }
        if distinct.is_empty() {
            Ok(Brachistochronic {
                mass,
                slope,
                guides,
            })
        } else {
            Err(distinct)
        }
    }
}

fn sliding_guide<'d>(
    model: &Model<'d>,
    sliding: &SlidingEquation<'d>,
    [of_place, of_motion]: [Dependence; 2],
    unmet: &mut Vec<UnmetCondition>,
) -> Option<SlidingGuide<'d>> {
    let name = &sliding.name;
    let [normal] = &sliding.reactions[..] else {
        unmet.push(UnmetCondition::SpatialGuide {
            guide: name.clone(),
        });
        return None;
    };
    let mut of = |value: Expr<'d>, coefficient: &str, reach: Dependence| {
        checked(
            model,
            value,
            &format!("{coefficient} of `{name}`"),
            reach,
            unmet,
        )
    };
    let mut each = |list: &[Expr<'d>], coefficient: &str| -> Vec<Expr<'d>> {
        list.iter()
            .map(|&value| of(value, coefficient, of_place))
            .collect()
    };
    let along = each(&sliding.row, "the direction");
    let weights = each(&normal.by_accelerations, "the reaction to accelerations");
    let by_friction_forces = each(&normal.by_friction_forces, "the reaction to friction");
    let load = of(normal.load, "the reaction at rest", of_motion);
    let friction = of(sliding.friction, "the coefficient of friction", of_place);
    // The base on which it slides may be driven.
    let moving = model.coordinates.iter().zip(&sliding.row);
    let moving = model.dag.sum(moving.map(|(c, &row)| row * c.v));
    if identity::equal(sliding.slip, moving) != Some(true) {
        unmet.push(UnmetCondition::Varies {
            coefficient: format!("the slip of `{name}` while the machine is at rest"),
            variable: "t".to_owned(),
        });
    }
    Some(SlidingGuide {
        name: name.clone(),
        along,
        load,
        weights,
        by_friction_forces,
        friction,
    })
}

/// The variables that a coefficient may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Dependence {
    Parameters,
    Coordinates,
    Rates,
}

/// The coefficient, if it depends only on what its reach allows; otherwise the violation is recorded.
fn checked<'d>(
    model: &Model<'d>,
    value: Expr<'d>,
    coefficient: &str,
    reach: Dependence,
    unmet: &mut Vec<UnmetCondition>,
) -> Expr<'d> {
    if let Some(settled) = identity::as_function_of_parameters(value) {
        return settled;
    }
    let changes = |symbol: &Expr<'d>| {
        let symbol: Option<Symbol> = symbol.as_symbol();
        symbol.is_some_and(|symbol| {
            value.depends_on(symbol)
                && identity::equal(value.diff(symbol), model.dag.zero()) != Some(true)
        })
    };
    let coordinates = model.coordinates.iter().map(|c| (c.q, c.name.to_string()));
    let rates = model.coordinates.iter();
    let rates = rates.map(|c| (c.v, format!("der({})", c.name)));
    let inputs = model.inputs.iter();
    let inputs = inputs.map(|input| (input.symbol, input.name.to_string()));
    let named = coordinates
        .filter(|_| reach < Dependence::Coordinates)
        .chain(rates.filter(|_| reach < Dependence::Rates))
        .chain(inputs)
        .chain([(model.time, "t".to_owned())]);
    let found = named.into_iter().find(|(symbol, _)| changes(symbol));
    if found.is_some() || reach == Dependence::Parameters {
        unmet.push(UnmetCondition::Varies {
            coefficient: coefficient.to_owned(),
            variable: found.map_or_else(|| "the motion".to_owned(), |(_, name)| name),
        });
    }
    value
}
