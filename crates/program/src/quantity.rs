//! The table of quantities: one row for everything that a machine can compute.
//!
//! A row gives the name of a quantity, its symbol in formulas, the arrangement of its numbers
//! and the arguments that it may depend on. Emitters, the interpreter, the listing, proofs
//! and `docs/quantities.md` read these rows, and `cargo xtask generate` writes the methods of the
//! trait `System`, their documentation, and how interpreted machines and wrappers implement them.
//! A new quantity is one row here, and one file in `crates/mechanics/src/quantities/` with its
//! expressions and what proves them.

use super::{FrictionLayout, Program, Shape};
use lagrangian_units::Variable;

/// The kinds of items that a quantity can have one number for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemKind {
    /// The generalized coordinates.
    Coordinate,
    /// The bilateral constraints.
    Constraint,
    /// The guided contacts with friction.
    Contact,
    /// The unilateral contacts.
    Unilateral,
    /// The unilateral contacts with faces of polygons, three numbers for each.
    Face,
    /// The directions of unilateral contacts: for each its normal, then its tangent.
    Direction,
    /// The coefficients of unilateral contacts: for each its restitution along the normal and along the tangent,
    /// its friction and its static friction.
    Coefficient,
    /// The guides among the unilateral contacts.
    Guide,
    /// What the reaction of a guide depends on: the accelerations of the coordinates, the multipliers of the constraints, and the forces along
    /// the directions of the unilateral contacts.
    OnGuide,
}

/// The arrangement of the results of a function, independent of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// One number.
    Number,
    /// One number for each item of a kind.
    Each(ItemKind),
    /// A symmetric matrix with a row for each item of a kind.
    Symmetric(ItemKind),
    /// A matrix with a row for each of one kind and a column for each of another, row by row.
    Rows(ItemKind, ItemKind),
    /// For each coordinate its acceleration, then the derivatives of that by each variable.
    Differentials,
    /// The response to friction forces, see [`FrictionLayout`].
    Responses,
    /// The coordinates, followed by their rates if any of these is not 0.
    State,
    /// An arrangement that the compiler chooses.
    Chosen,
}

/// An argument that a quantity may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// The time t.
    Time,
    /// The coordinates q.
    Coordinates,
    /// Their rates v.
    Velocities,
    /// The accelerations a.
    Accelerations,
    /// The inputs u.
    Inputs,
}

impl Argument {
    /// The letter in equations and in code.
    pub fn letter(self) -> &'static str {
        match self {
            Argument::Time => "t",
            Argument::Coordinates => "q",
            Argument::Velocities => "v",
            Argument::Accelerations => "a",
            Argument::Inputs => "u",
        }
    }
}

/// The machines that have a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// All of them.
    Nothing,
    /// Machines with bilateral constraints.
    Constraints,
    /// Machines with guided contacts.
    Contacts,
    /// Machines with unilateral contacts.
    Unilateral,
    /// Machines with unilateral contacts of polygons.
    Faces,
    /// Machines with guides beside unilateral contacts.
    Guides,
    /// Machines whose first-order states store energy.
    Stores,
    /// Machines whose spec requests it.
    Request,
}

impl Needs {
    /// Whether a machine of these sizes has the quantity, or may request it.
    pub fn are_met(self, sizes: Sizes) -> bool {
        match self {
            Needs::Nothing | Needs::Request => true,
            Needs::Constraints => sizes.constraints > 0,
            Needs::Contacts => sizes.contacts > 0,
            Needs::Unilateral => sizes.unilateral > 0,
            Needs::Faces => sizes.faces > 0,
            Needs::Guides => sizes.guides > 0,
            Needs::Stores => sizes.stores,
        }
    }
}

/// How a function is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Called now and then; if all its results are zero, the function does not exist.
    Seldom,
    /// Called as seldom, to observe a motion: no motion depends on it.
    Observed,
    /// Called at every stage of a step: it uses all instructions that the processor has.
    Often,
    /// Called as often, and solves for accelerations: it has no value if the mass matrix
    /// is singular.
    Solves,
}

/// The implementation that the trait `System` of the runtime has of the method for a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefaultMethod {
    /// The numbers are unknown: NaN.
    Unknown,
    /// The number is 0.
    Zero,
    /// It writes nothing: a machine without the items has no numbers of them.
    Nothing,
    /// The numbers of single contacts, one contact after the other; the variant of `ContactQuantity` in the runtime.
    OfContacts(&'static str),
    /// The trait itself has it, since it is computed from other quantities.
    Written,
}

/// The method of the trait `System` that a quantity is. `cargo xtask generate` writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    /// Its implementation in the trait.
    pub default: DefaultMethod,
    /// What its documentation states after the sentences of the row, as lines of Markdown.
    pub remarks: &'static [&'static str],
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuantityRow {
    /// The name of its function.
    pub name: &'static str,
    /// Its symbol in formulas, ASCII; empty if it has none.
    pub symbol: &'static str,
    /// The names of its numbers in code, with `*` for the name or the index of each.
    pub code: &'static str,
    /// The arrangement of its numbers.
    pub extent: Extent,
    /// The arguments that it may depend on.
    pub of: &'static [Argument],
    /// The machines that have it.
    pub needs: Needs,
    /// How it is used.
    pub called: Use,
    /// Its equation in `docs/equations.md`; empty if the name is the definition.
    pub equation: &'static str,
    /// Its description, with units: a sentence in ASCII, symbols between backticks.
    pub docs: &'static str,
    /// The method of `System` that it is, if it is one that is generated.
    pub method: Option<Method>,
}

/// The numbers of items of a machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Coordinates.
    pub coordinates: usize,
    /// Constraints.
    pub constraints: usize,
    /// Contacts.
    pub contacts: usize,
    /// Components of the normal reaction of each.
    pub reaction_axes: usize,
    /// Unilateral contacts.
    pub unilateral: usize,
    /// Unilateral contacts with faces of polygons.
    pub faces: usize,
    /// Guides among the unilateral contacts, which stand behind the others.
    pub guides: usize,
    /// Variables that accelerations are differentiated by.
    pub derivatives: usize,
    /// Whether first-order states store energy.
    pub stores: bool,
}

/// The method of a row, of which there is one or none.
const fn only(methods: &[Method]) -> Option<Method> {
    match methods {
        [method] => Some(*method),
        _ => None,
    }
}

/// Writes the enumeration and the table from the same rows.
macro_rules! quantities {
    ($($(#[doc = $docs:literal])+ $role:ident $(($index:ty))? => {
        $name:literal, $symbol:literal, $code:literal, $extent:expr, [$($of:ident)*], $needs:ident, $called:ident,
        $equation:literal
    } $(System($default:expr) { $(#[doc = $remark:literal])* })?)+) => {
        /// What a function computes.
        ///
        /// The order is that of functions in a program.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Role {
            $($(#[doc = $docs])+ $role $(($index))?),+
        }

        impl Role {
            /// The row of the table.
            pub fn row(self) -> &'static QuantityRow {
                match self {
                    $(Role::$role { .. } => {
                        const ROW: &QuantityRow = &QuantityRow {
                            name: $name,
                            symbol: $symbol,
                            code: $code,
                            extent: $extent,
                            of: &[$(Argument::$of),*],
                            needs: Needs::$needs,
                            called: Use::$called,
                            equation: $equation,
                            docs: concat!($($docs),+),
                            method: only(&[$(Method {
                                default: $default,
                                remarks: &[$($remark),*],
                            })?]),
                        };
                        ROW
                    })+
                }
            }

            /// Every quantity; of those that are numbered the first.
            pub fn all() -> impl Iterator<Item = Role> {
                [$(Role::$role $((<$index>::MIN))?),+].into_iter()
            }
        }
    };
}

use DefaultMethod::{Nothing, OfContacts, Unknown, Written, Zero};
use Extent::{Chosen, Differentials, Each, Number, Responses, Rows, State, Symmetric};
use ItemKind::{
    Coefficient, Constraint, Contact, Coordinate, Direction, Face, Guide, OnGuide, Unilateral,
};

quantities! {
    /// Prepared values: everything that depends on parameters alone.
    Prepare => { "prepare", "", "k*", Chosen, [], Nothing, Seldom, "" }
    /// The coordinates at the start, followed by their rates if any of these is not 0.
    Start => { "start", "", "s*", State, [], Nothing, Seldom, "" }
    /// Mass matrix `M`.
    MassMatrix => {
        "mass_matrix", "M", "m*", Symmetric(Coordinate), [Time Coordinates], Nothing, Seldom, "E4"
    } System(Unknown) {
        /// It is written in full, row after row. By default unknown: NaN.
        ///
        /// Needed for constraints, for contacts and wherever the equations are used without being solved.
    }
    /// Bias `h`: velocity products and explicit time in the inertia forces.
    Bias => {
        "bias", "h", "h_*", Each(Coordinate), [Time Coordinates Velocities], Nothing, Seldom, "E5"
    } System(Unknown) {
        /// By default unknown: NaN.
    }
    /// Applied generalized forces `Q`.
    Applied => {
        "applied", "Q", "q_*", Each(Coordinate), [Time Coordinates Velocities Inputs], Nothing, Seldom, "E6"
    } System(Unknown) {
        /// They are `−∂V/∂q − ∂D/∂v + …`. By default unknown: NaN.
    }
    /// Right-hand side `f = Q - h` of `M a = f`.
    Forces => {
        "forces", "f", "f_*", Each(Coordinate), [Time Coordinates Velocities Inputs], Nothing, Seldom, "E7"
    } System(Written) {}
    /// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
    ConstraintPositions => {
        "constraint_positions", "g", "g*", Each(Constraint), [Time Coordinates], Constraints, Seldom, "E29"
    } System(Nothing) {
        /// There is one for each constraint, and all are 0 if the state satisfies the constraints.
    }
    /// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
    ConstraintRates => {
        "constraint_rates", "phi", "phi*", Each(Constraint), [Time Coordinates Velocities], Constraints, Seldom, "E29"
    } System(Nothing) {
        /// There is one for each constraint, and all are 0 if the state satisfies the constraints.
    }
    /// Constraint matrix `G`, the derivatives of `phi` by the rates.
    ConstraintMatrix => {
        "constraint_matrix", "G", "g*", Rows(Constraint, Coordinate), [Time Coordinates], Constraints, Seldom, "E30"
    } System(Nothing) {
        /// It is written row after row.
    }
    /// Right-hand side `gamma` of `G a = gamma`.
    ConstraintBias => {
        "constraint_bias", "gamma", "gamma*", Each(Constraint), [Time Coordinates Velocities], Constraints, Seldom,
        "E30"
    } System(Nothing) {
        /// It is the condition on the accelerations under which the rates of the constraints stay constant.
    }
    /// Accelerations `a`.
    Accelerations => {
        "accelerations", "a", "*_ddot", Each(Coordinate), [Time Coordinates Velocities Inputs], Nothing, Solves, "E7"
    }
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
    Multipliers => {
        "multipliers", "lambda", "lambda*", Each(Constraint), [Time Coordinates Velocities Inputs], Constraints, Solves,
        "E31"
    }
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the constraints, and how independent these are. Only for
    /// machines whose constraints are independent.
    Projection => {
        "projection", "", "r*", Chosen, [Time Coordinates Velocities], Request, Solves, "E31"
    }
    /// Slips `w` of the guided contacts, in m/s.
    Slips => {
        "slips", "w", "w*", Each(Contact), [Time Coordinates Velocities], Contacts, Seldom, "E32"
    } System(Nothing) {
        /// There is one for each contact, along its direction.
    }
    /// Slip matrix `tau`, the derivatives of the slips by the rates.
    SlipMatrix => {
        "slip_matrix", "tau", "tau*", Rows(Contact, Coordinate), [Time Coordinates], Contacts, Seldom, "E32"
    } System(Nothing) {
        /// It is written row after row.
    }
    /// Rates `dw/dt` of the slips where all accelerations are 0.
    SlipBias => {
        "slip_bias", "sigma", "bias*", Each(Contact), [Time Coordinates Velocities], Contacts, Seldom, "E32"
    } System(Nothing) {}
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without friction, and the change of each
    /// by a unit of each friction force; followed by the coefficients of friction. A machine with guided contacts has
    /// this in place of accelerations and multipliers.
    Friction => {
        "friction", "", "r*", Responses, [Time Coordinates Velocities Inputs], Contacts, Solves, "E34"
    }
    /// Gaps `g` of the unilateral contacts, in m: positive where they are open.
    Gaps => {
        "gaps", "", "gap*", Each(Unilateral), [Time Coordinates], Unilateral, Seldom, "E51"
    } System(OfContacts("Gap")) {
        ///
        /// By default this, and each quantity of all contacts that follows, is that of [`of_contacts`](Self::of_contacts), one contact after the other, if
        /// [`single_contacts`](Self::single_contacts) are known.
    }
    /// Rates `gamma` at which the gaps of unilateral contacts open and at which these slip, in m/s.
    ContactRates => {
        "contact_rates", "", "rate*", Each(Direction), [Time Coordinates Velocities], Unilateral, Seldom, "E51"
    } System(OfContacts("Rates")) {
        /// There are two for each contact: `dg/dt`, at which its gap opens, and its slip rate.
    }
    /// Derivatives of the rates of unilateral contacts by the rates of the coordinates.
    ContactMatrix => {
        "contact_matrix", "", "w*", Rows(Direction, Coordinate), [Time Coordinates], Unilateral, Seldom, "E52"
    } System(OfContacts("Rows")) {
        /// They are written row after row, in the order of [`contact_rates`](Self::contact_rates).
    }
    /// Rates `dgamma/dt` of unilateral contacts where all accelerations are 0.
    ContactBias => {
        "contact_bias", "", "bias*", Each(Direction), [Time Coordinates Velocities], Unilateral, Seldom, "E53"
    } System(OfContacts("Bias")) {}
    /// Coefficients of unilateral contacts: restitution along the normal and along the tangent (for compliant contacts
    /// the parameters of their force), friction, static friction.
    ContactCoefficients => {
        "contact_coefficients", "", "c*", Each(Coefficient), [Time Coordinates Velocities], Unilateral, Seldom, ""
    } System(OfContacts("Coefficients")) {
        /// The law of a compliant contact is its [`Compliance`](crate::Compliance).
    }
    /// For each unilateral contact of a corner with a face of a polygon: the distance of the corner outside the face, and its
    /// distance beyond the ends of the face, negative between them, both in m; the rate of the second, in m/s.
    ContactFaces => {
        "contact_faces", "", "face*", Each(Face), [Time Coordinates Velocities], Faces, Seldom, "E77"
    } System(OfContacts("Face")) {
        /// There are three numbers for each contact that is [with a face](UnilateralContact::has_face). The [gap](Self::gaps) is the larger of the first two;
        /// [rates](Self::contact_rates) are those of the face.
    }
    /// What a unit of each acceleration, of each multiplier, and of a force along each direction of the unilateral contacts adds to the
    /// normal reactions of guides beside these.
    GuideMatrix => {
        "guide_matrix", "", "n*", Rows(Guide, OnGuide), [Time Coordinates], Guides, Seldom, "E81"
    } System(Nothing) {
        /// For each guide its `ρ`, with a number for each coordinate, its `χ`, with one for each constraint, and its `κ`, with two for each
        /// unilateral contact, along the normal and the tangent. There, the numbers for normals of guides are 0. [`guides`](Self::guides) defines these letters.
    }
    /// The normal reactions of guides beside unilateral contacts where all accelerations, multipliers and forces of contacts are 0, in N.
    GuideLoads => {
        "guide_loads", "", "nu*", Each(Guide), [Time Coordinates Velocities Inputs], Guides, Seldom, "E81"
    } System(Nothing) {
        /// They are the `ν` of [`guides`](Self::guides).
    }
    /// Accelerations `a` with their derivatives by each requested `x`, the solutions of
    /// `M da/dx = d(f - M a)/dx` with `a` held constant.
    Derivatives => {
        "derivatives", "", "d*", Differentials, [Time Coordinates Velocities Inputs], Request, Solves, "E26"
    }
    /// Derivatives of a weighted sum of accelerations by coordinates, rates, parameters and inputs; the weights are additional
    /// inputs after those of the machine.
    Adjoint => {
        "adjoint", "", "g*", Chosen, [Time Coordinates Velocities Inputs], Request, Solves, ""
    }
    /// Derivatives of an output, by its index among the outputs, by coordinates, rates, parameters, inputs and accelerations.
    Gradient(usize) => {
        "gradient", "", "g*", Chosen, [Time Coordinates Velocities Accelerations Inputs], Request, Observed, ""
    }
    /// Numbers of one unilateral contact, without those that are 0, with its arguments in place of the coordinates.
    ContactPart(usize) => {
        "contact_part", "", "r*", Chosen, [Time Coordinates], Request, Seldom, ""
    }
    /// The part of the accelerations that depends on time alone.
    AtTime => { "at_time", "", "r*", Chosen, [Time], Request, Often, "" }
    /// The part of the accelerations that depends on time and coordinates.
    AtPosition => { "at_position", "", "r*", Chosen, [Time Coordinates], Request, Solves, "" }
    /// Accelerations `a`, from the results of the previous stage.
    AccelerationsAt => {
        "accelerations_at", "a", "*_ddot", Each(Coordinate), [Time Coordinates Velocities Inputs], Request, Solves, "E7"
    }
    /// Kinetic energy `T`, in J.
    KineticEnergy => {
        "kinetic_energy", "T", "", Number, [Time Coordinates Velocities], Nothing, Observed, "E1"
    } System(Unknown) {
        /// By default unknown, NaN, and then a run has no energy balance.
    }
    /// Potential energy `V`, in J.
    PotentialEnergy => {
        "potential_energy", "V", "", Number, [Time Coordinates Inputs], Nothing, Observed, "E2"
    } System(Unknown) {
        /// By default unknown, NaN, and then a run has no energy balance.
    }
    /// Energy `E` that states of first order store, in J.
    StateEnergy => {
        "state_energy", "E", "", Number, [Time Coordinates Velocities], Stores, Observed, "E59"
    } System(Zero) {
        /// It is known as far as the description states it; by default it is 0.
    }
    /// Dissipation function `D`, in W.
    Dissipation => {
        "dissipation", "D", "", Number, [Time Coordinates Velocities Inputs], Nothing, Observed, "E3"
    } System(Zero) {
        /// It is that of Rayleigh. By default 0: nothing is damped.
    }
    /// Power `P` supplied by drives, forces and inputs, in W.
    WorkRate => {
        "work_rate", "P", "", Number, [Time Coordinates Velocities Accelerations Inputs], Nothing, Observed, "E19"
    } System(Zero) {
        /// It is the power of everything that is neither in `T + V` nor in `D`: drives (explicit time), applied forces, inputs, moving constraints (`−λ·∂g/∂t`, with the
        /// multipliers that belong to these accelerations), and the supply of first-order states that store energy. Along every motion
        /// `d(T + V + E)/dt = work_rate − dissipation_rate`. By default 0; if that is wrong, the energy balance shows it.
    }
    /// Power `R` dissipated by dampers, in W.
    DissipationRate => {
        "dissipation_rate", "R", "", Number, [Time Coordinates Velocities Inputs], Nothing, Observed, "E18"
    } System(Zero) {
        /// It is `Σ vᵢ ∂D/∂vᵢ`, and the losses that the description names. By default 0.
    }
    /// A quantity to observe, by its index among the outputs.
    Output(usize) => {
        "output", "", "", Number, [Time Coordinates Velocities Accelerations Inputs], Request, Observed, ""
    }
    /// The expression that an assumption states to be positive, by its index among the assumptions.
    Assumption(usize) => { "assumption", "", "", Number, [Time Coordinates Velocities Inputs], Request, Seldom, "" }
}

impl Role {
    /// The name of a function of this role; outputs, their gradients, assumptions and parts of contacts are numbered.
    pub fn name(self) -> String {
        match self {
            Role::Output(index)
            | Role::Assumption(index)
            | Role::Gradient(index)
            | Role::ContactPart(index) => {
                format!("{}_{index}", self.row().name)
            }
            _ => self.row().name.into(),
        }
    }

    /// Whether a function of this role inverts the mass matrix: it has no value if that is singular.
    pub fn inverts(self) -> bool {
        self.row().called == Use::Solves
    }

    /// Whether a function of this role is called so often that it should use all instructions that the
    /// processor has.
    pub fn is_fast(self) -> bool {
        matches!(self.row().called, Use::Often | Use::Solves)
    }

    /// Whether functions of this role only observe a motion, which does not depend on them.
    pub fn is_observed(self) -> bool {
        self.row().called == Use::Observed
    }

    /// Whether the function exists even if all its results are zero.
    pub fn is_kept(self) -> bool {
        self.is_fast()
            || matches!(
                self,
                Role::Output(_) | Role::Gradient(_) | Role::Assumption(_)
            )
    }
}

impl Sizes {
    /// The arrangement of the response to friction forces.
    pub fn friction_layout(self) -> FrictionLayout {
        FrictionLayout {
            coordinates: self.coordinates,
            constraints: self.constraints,
            contacts: self.contacts,
            axes: self.reaction_axes,
        }
    }

    /// The number of items of a kind.
    pub fn of(self, kind: ItemKind) -> usize {
        match kind {
            ItemKind::Coordinate => self.coordinates,
            ItemKind::Constraint => self.constraints,
            ItemKind::Contact => self.contacts,
            ItemKind::Unilateral => self.unilateral,
            ItemKind::Face => 3 * self.faces,
            ItemKind::Direction => 2 * self.unilateral,
            ItemKind::Coefficient => 4 * self.unilateral,
            ItemKind::Guide => self.guides,
            ItemKind::OnGuide => self.coordinates + self.constraints + 2 * self.unilateral,
        }
    }
}

impl Extent {
    /// The arrangement of the results for a machine; `None` if the compiler chooses it.
    pub fn shape(self, sizes: Sizes) -> Option<Shape> {
        Some(match self {
            Number => Shape::Scalar,
            Each(kind) => Shape::Vector(sizes.of(kind)),
            Symmetric(kind) => Shape::Symmetric(sizes.of(kind)),
            Rows(kind, other) => Shape::Vector(sizes.of(kind) * sizes.of(other)),
            Differentials => Shape::Matrix(sizes.coordinates, 1 + sizes.derivatives),
            Responses => Shape::Vector(sizes.friction_layout().len()),
            State | Chosen => return None,
        })
    }
}

/// What a result of a function refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// The whole machine: there is only one result.
    Whole,
    /// An item of a kind.
    Of(ItemKind, usize),
    /// An entry of a matrix, by an item of one kind and an item of another.
    At((ItemKind, usize), (ItemKind, usize)),
    /// The rate of a coordinate.
    Rate(usize),
    /// The derivative of the acceleration of a coordinate by a variable.
    Derivative(usize, Variable),
    /// The result of this index.
    Index(usize),
}

impl Program {
    /// The numbers of items of this machine.
    pub fn sizes(&self) -> Sizes {
        Sizes {
            coordinates: self.coordinates.len(),
            constraints: self.constraints.len(),
            contacts: self.contacts.len(),
            reaction_axes: self.reaction_axes,
            unilateral: self.unilateral.len(),
            faces: self.unilateral.iter().filter(|one| one.has_face).count(),
            guides: self.unilateral.iter().filter(|one| one.is_guide).count(),
            derivatives: self.derivatives.len(),
            stores: self.function(Role::StateEnergy).is_some(),
        }
    }

    /// What a result of a function refers to, by its index.
    pub fn entry(&self, role: Role, index: usize) -> Entry {
        let n = self.dimension();
        match role.row().extent {
            Number => Entry::Whole,
            Each(kind) => Entry::Of(kind, index),
            Symmetric(kind) => {
                let (i, j) = Shape::place(index);
                Entry::At((kind, i), (kind, j))
            }
            Rows(kind, other) => {
                let width = self.sizes().of(other).max(1);
                Entry::At((kind, index / width), (other, index % width))
            }
            Differentials => {
                let width = 1 + self.derivatives.len();
                let column = (index % width).checked_sub(1);
                match column.and_then(|column| self.derivatives.get(column)) {
                    Some(variable) => Entry::Derivative(index / width, *variable),
                    None => Entry::Of(Coordinate, index / width),
                }
            }
            State if index >= n => Entry::Rate(index - n),
            State => Entry::Of(Coordinate, index),
            Responses | Chosen => Entry::Index(index),
        }
    }

    /// The name of an item as the spec writes it, or its number if it has no name.
    pub fn member(&self, (kind, index): (ItemKind, usize)) -> String {
        let name = match kind {
            Coordinate => self
                .coordinates
                .get(index)
                .map(|slot| slot.name.to_string()),
            Constraint => self.constraints.get(index).map(|one| one.name.clone()),
            Contact => self.contacts.get(index).cloned(),
            Unilateral => self.unilateral.get(index).map(|one| one.name.clone()),
            Face => {
                let part = ["height", "beyond", "beyond_rate"][index % 3];
                let one = self
                    .unilateral
                    .iter()
                    .filter(|one| one.has_face)
                    .nth(index / 3);
                one.map(|one| format!("{}.{part}", one.name))
            }
            Direction => {
                let part = ["gap", "slip"][index % 2];
                let one = self.unilateral.get(index / 2);
                one.map(|one| format!("{}.{part}", one.name))
            }
            Guide => {
                let mut guides = self.unilateral.iter().filter(|one| one.is_guide);
                guides.nth(index).map(|one| one.name.clone())
            }
            OnGuide => {
                let (n, m) = (self.coordinates.len(), self.constraints.len());
                return match index {
                    _ if index < n => self.member((Coordinate, index)),
                    _ if index < n + m => self.member((Constraint, index - n)),
                    _ => self.member((Direction, index - n - m)),
                };
            }
            Coefficient => {
                let one = self.unilateral.get(index / 4);
                one.map(|one| {
                    let of_force = one.compliance.map_or(
                        &["restitution", "tangential_restitution"][..],
                        |compliance| compliance.parameters(),
                    );
                    let part = match index % 4 {
                        2 => "friction",
                        3 => "static_friction",
                        i => of_force.get(i).unwrap_or(&"nothing"),
                    };
                    format!("{}.{part}", one.name)
                })
            }
        };
        name.unwrap_or_else(|| index.to_string())
    }

    /// The description of a function, in a sentence or two: ASCII, symbols between backticks.
    pub fn docs(&self, role: Role) -> String {
        match role {
            Role::Accelerations => {
                let equations = if self.constraints.is_empty() {
                    "`M a = f`"
                } else {
                    "`M a = f + G^T lambda`, `G a = gamma`"
                };
                let form = match self.choice(role) {
                    Some(choice) => format!(" {}", choice.chosen().form),
                    None => String::new(),
                };
                format!("Accelerations `a`, the solution of {equations}{form}.")
            }
            Role::Output(index) => match self.outputs.get(index) {
                Some(slot) => slot.docs.clone(),
                None => String::new(),
            },
            Role::Assumption(index) => match self.assumptions.get(index) {
                Some(fact) => format!("By how much `{}` holds.", fact.text),
                None => String::new(),
            },
            role => role.row().docs.trim().to_owned(),
        }
    }
}
