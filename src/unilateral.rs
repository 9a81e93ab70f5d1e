//! Unilateral contacts as a machine describes them, and what can be wrong with them in a run.

/// A unilateral contact of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnilateralContact<'a> {
    /// The name in the description.
    pub name: &'a str,
    /// How it bounces, if it does.
    pub law: ImpactLaw,
    /// Whether with the others or one after the other.
    pub order: ImpactOrder,
    /// What becomes of it where its friction leaves no motion.
    pub painleve: Painleve,
    /// By which law it presses, if it yields.
    pub compliance: Option<Compliance>,
    /// Whether there is friction; without it the slip is 0.
    pub rubs: bool,
    /// Whether it is the rolling of the contact before it, on which it leans: it has the gap and the normal force of that contact,
    /// its slip is how fast one body turns relative to the other, in rad/s, its friction the torque that resists this, in N m,
    /// `|τ| ≤ ρ λₙ`, and its coefficient of friction the length ρ, in m.
    pub rolls: bool,
    /// Whether it is the second tangent of the contact before it, in space, on which it leans: it has the gap, the normal force and
    /// the coefficients of that contact; its slip and its friction are those along the second tangent. Both together obey Coulomb's
    /// law, `|λₜ| ≤ μ λₙ`.
    pub across: bool,
    /// Whether it is a corner on a face of a polygon, which has ends: [`System::contact_faces`](crate::System::contact_faces) says where.
    pub faced: bool,
}

/// Whether contacts that are closed take part in one impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpactOrder {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, the one that closes fastest first, until none closes.
    Sequence,
}

/// What becomes of a contact whose friction leaves no motion: P. Painlevé's paradox.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Painleve {
    /// The run ends.
    #[default]
    Error,
    /// An impact without a collision, along Routh's path, ends the slip: the contact sticks or opens. Where it could
    /// open as well as be pressed, it opens. (F. Génot, B. Brogliato, Eur. J. Mech. A 18 (1999) 653–677.)
    Impact,
}

/// The force in a contact that yields, of the depth `d` of its penetration and of how fast that grows. It is never
/// negative: where it would be the contact opens. Its two parameters stand in the place of the coefficients of
/// restitution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compliance {
    /// `k d + b ḋ`, of a stiffness in N/m and a damping coefficient in N s/m.
    Linear,
    /// `K d^(3/2)`, of a stiffness in N/m^(3/2).
    Hertz,
    /// `K d^(3/2) (1 + c ḋ)`, of a stiffness in N/m^(3/2) and a damping in s/m. (K. H. Hunt, F. R. E. Crossley, J. Appl.
    /// Mech. 42 (1975) 440–445.)
    HuntCrossley,
    /// `k₁ d` where the layer is pressed for the first time; along `k₂` back and up again to the greatest depth `d*` so
    /// far, so that a thickness of `d* (1 − k₁/k₂)` is lost. (O. R. Walton, R. L. Braun, J. Rheol. 30 (1986) 949–980.)
    Layer,
}

/// How rates after an impact follow from those before it. `e` and `eₜ` are the coefficients of restitution along
/// the normal and along the tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImpactLaw {
    /// `0 ≤ Λₙ ⊥ γₙ⁺ + e γₙ⁻ ≥ 0`, `−Λₜ ∈ μ Λₙ Sgn(γₜ⁺ + eₜ γₜ⁻)`; with `eₜ = e` this is Moreau's law. It may
    /// create energy where these differ.
    #[default]
    Newton,
    /// Along Routh's path of impulses; the normal impulse of expansion is `e` times that of compression.
    Poisson,
    /// Poisson's hypothesis in two complementarity problems, for several contacts at once.
    PoissonGlocker,
    /// Along Routh's path; the work of expansion is `−e²` times that of compression. It never creates energy.
    Stronge,
}

/// Why contacts leave a run no way on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ContactTrouble {
    /// The law of friction leaves no motion, or more than one: P. Painlevé's paradox.
    Paradox,
    /// No force along its normal holds it shut: its gap hardly changes with the coordinates, or constraints, walls that move or other
    /// contacts contradict it.
    NotHeld,
    /// No forces were found that obey the law of friction in space, by a method that converges where there are.
    Unsolved,
    /// A gap is negative at the start.
    Penetrates,
    /// The law of impact is for one contact at a time, and several meet.
    SeveralAtOnce,
    /// What is closed, slips and sticks changes again and again at one instant.
    Unsettled,
    /// Moreau's time stepping does not know its law.
    NotStepped,
    /// A [`Stepper`](crate::Stepper) alone does not look for impacts: a [`Simulation`](crate::Simulation) does.
    NotFollowed,
}

impl ContactTrouble {
    /// What is wrong, the subject of the sentence being the contact.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Paradox => {
                "its friction leaves no motion, or more than one (a paradox of P. Painlevé)"
            }
            Self::NotHeld => {
                "no force along its normal holds it shut here: its gap hardly changes with the coordinates, or constraints, walls that move or \
                 other contacts contradict it"
            }
            Self::Unsolved => {
                "no forces were found that obey the law of friction in space: there may be none"
            }
            Self::Penetrates => "it is not open but penetrated",
            Self::SeveralAtOnce => {
                "it meets in one impact with others, and its law is for one contact at a time; the law `poisson_glocker` \
                 is for several"
            }
            Self::Unsettled => "what it does changes again and again at this instant",
            Self::NotStepped => {
                "the method `moreau` knows contacts with the law `newton`, all at once, without `compliance`, and with `static_friction` equal to \
                 `friction`"
            }
            Self::NotFollowed => "impacts are found by a `Simulation`, not by a stepper alone",
        }
    }
}
