//! Unilateral contacts in the description of a machine, what they do in a run, and the errors that they can cause there.

/// A unilateral contact of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnilateralContact<'a> {
    /// The name in the description.
    pub name: &'a str,
    /// The law of its impacts.
    pub law: ImpactLaw,
    /// Whether its impacts are simultaneous with others or one after the other.
    pub order: ImpactOrder,
    /// What happens if its friction permits no motion.
    pub painleve: Painleve,
    /// The law of its force, if it is compliant.
    pub compliance: Option<Compliance>,
    /// Whether there is friction; without it the slip is 0.
    pub has_friction: bool,
    /// Whether it is the rolling resistance of the contact before it, on which it depends: it has the gap and the normal force of that contact, its
    /// slip is the angular rate of one body relative to the other, in rad/s, its friction the resisting torque, in N m, `|τ| ≤ ρ λₙ`, and
    /// its coefficient of friction the length ρ, in m.
    pub is_rolling_resistance: bool,
    /// Whether it is the second tangent of the contact before it, in space, on which it depends: it has the gap, the normal force and the
    /// coefficients of that contact; its slip and its friction are those along the second tangent. The two obey Coulomb's law together,
    /// `|λₜ| ≤ μ λₙ`.
    pub is_second_tangent: bool,
    /// Whether it is a corner on a face of a polygon, which has ends, given by [`System::contact_faces`](crate::System::contact_faces).
    pub has_face: bool,
}

/// What a closed contact does, or that it is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactMode {
    /// It does not touch.
    Open,
    /// It touches and slips, forward or backward; 0 where it has no friction.
    Slides(f64),
    /// It touches and slips in space, in this direction, of length 1: that of the slip when the step began. A slip that passes through
    /// rest is continued as if it went backwards along it.
    SlidesAlong([f64; 2]),
    /// It touches and does not slip.
    Sticks,
}

impl ContactMode {
    /// Whether contacts do the same, in whatever direction they slip.
    pub fn is_like(self, other: ContactMode) -> bool {
        match (self, other) {
            (ContactMode::SlidesAlong(_), ContactMode::SlidesAlong(_)) => true,
            _ => self == other,
        }
    }

    /// The direction of the slip along both tangents; 0 where there is none.
    pub fn direction(self) -> [f64; 2] {
        match self {
            ContactMode::Slides(sign) => [sign, 0.0],
            ContactMode::SlidesAlong(heading) => heading,
            ContactMode::Open | ContactMode::Sticks => [0.0; 2],
        }
    }
}

/// A quantity of unilateral contacts, see [`System::of_contacts`](crate::System::of_contacts).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContactQuantity {
    /// Its gap: one number, of [`System::gaps`](crate::System::gaps).
    Gap,
    /// The rates at which it opens and slips: two numbers, of [`System::contact_rates`](crate::System::contact_rates).
    Rates,
    /// The derivatives of these: two rows, of [`System::contact_matrix`](crate::System::contact_matrix).
    Rows,
    /// Their time derivatives without accelerations: two numbers, of [`System::contact_bias`](crate::System::contact_bias).
    Bias,
    /// Its coefficients: four numbers, of [`System::contact_coefficients`](crate::System::contact_coefficients).
    Coefficients,
    /// Where it is on a face of a polygon: three numbers, of [`System::contact_faces`](crate::System::contact_faces).
    Face,
}

impl ContactQuantity {
    /// How many numbers of it a contact has, with so many coordinates.
    pub(crate) fn width(self, coordinates: usize) -> usize {
        match self {
            ContactQuantity::Gap => 1,
            ContactQuantity::Rates | ContactQuantity::Bias => 2,
            ContactQuantity::Rows => 2 * coordinates,
            ContactQuantity::Coefficients => 4,
            ContactQuantity::Face => 3,
        }
    }
}

/// How closed contacts take part in an impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpactOrder {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, the one that closes fastest first, until none closes.
    Sequence,
}

/// What happens to a contact whose friction permits no motion: P. Painlevé's paradox.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Painleve {
    /// The run ends.
    #[default]
    Error,
    /// An impact without collision, along Routh's path, ends the slip: the contact sticks or opens. If it could either open or be
    /// pressed, it opens. (F. Génot, B. Brogliato, Eur. J. Mech. A 18 (1999) 653–677.)
    Impact,
}

/// The force in a compliant contact, as a function of its penetration depth `d` and of the rate of `d`. It is never negative: where the
/// law would make it negative, the contact opens. Its two parameters take the place of the coefficients of restitution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compliance {
    /// `k d + b ḋ`, with a stiffness in N/m and a damping coefficient in N s/m.
    Linear,
    /// `K d^(3/2)`, with a stiffness in N/m^(3/2).
    Hertz,
    /// `K d^(3/2) (1 + c ḋ)`, with a stiffness in N/m^(3/2) and a damping in
    /// s/m. (K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440–445.)
    HuntCrossley,
    /// `k₁ d` when the layer is pressed for the first time; along `k₂` back and up again to the greatest depth `d*` so far, so that a
    /// thickness of `d* (1 − k₁/k₂)` is lost. (O. R. Walton, R. L. Braun, J. Rheol. 30 (1986) 949–980.)
    Layer,
}

/// How rates after an impact follow from those before it. `e` and `eₜ` are the coefficients of restitution along
/// the normal and along the tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImpactLaw {
    /// `0 ≤ Λₙ ⊥ γₙ⁺ + e γₙ⁻ ≥ 0`, `−Λₜ ∈ μ Λₙ Sgn(γₜ⁺ + eₜ γₜ⁻)`; with
    /// `eₜ = e` this is Moreau's law. It may create energy if these differ.
    #[default]
    Newton,
    /// Along Routh's path of impulses; the normal impulse of expansion is `e` times that of compression.
    Poisson,
    /// Poisson's hypothesis in two complementarity problems, for several contacts at once.
    PoissonGlocker,
    /// Along Routh's path; the work of expansion is `−e²` times that of compression. It never creates energy.
    Stronge,
}

/// Why a run cannot continue with its contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ContactTrouble {
    /// The law of friction permits no motion, or several: P. Painlevé's paradox.
    Paradox,
    /// The friction of this contact and of others that are closed with it permits no motion of all of them together, or none was found.
    Jammed,
    /// No force along its normal holds it shut: its gap hardly depends on the
    /// coordinates, or constraints, moving walls or other contacts contradict it.
    NotHeld,
    /// No forces were found that satisfy the law of friction in space, by a method that converges if there are any.
    Unsolved,
    /// A gap is negative at the start.
    Penetrates,
    /// The law of impact supports one contact at a time, and several meet.
    SeveralAtOnce,
    /// The states of contacts change again and again at one instant.
    Unsettled,
    /// Moreau's time stepping does not support contacts that yield.
    NotStepped,
    /// A [`Stepper`](crate::Stepper) alone does not search for impacts; a [`Simulation`](crate::Simulation) does.
    NotFollowed,
}

impl ContactTrouble {
    /// The error as a predicate whose subject is the contact.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Paradox => {
                "its friction law admits no motion, or more than one (Painlevé's paradox)"
            }
            Self::Jammed => {
                "its friction and that of the contacts that are closed with it admit no motion of all of them together, or none was found"
            }
            Self::NotHeld => {
                "no force along its normal keeps it closed here: its gap hardly changes with the coordinates, or constraints, moving walls or \
                 other contacts contradict it"
            }
            Self::Unsolved => {
                "no forces were found that obey the law of friction in space: there may be none"
            }
            Self::Penetrates => "its gap is negative, which is penetration",
            Self::SeveralAtOnce => {
                "it takes part in one impact with others, and its law is for one contact at a time; the law `poisson_glocker` \
                 is for several"
            }
            Self::Unsettled => "its state changes again and again at this instant",
            Self::NotStepped => {
                "the method `moreau` supports rigid contacts, with any law, and none with `compliance`"
            }
            Self::NotFollowed => "impacts are found by a `Simulation`, not by a stepper alone",
        }
    }
}
