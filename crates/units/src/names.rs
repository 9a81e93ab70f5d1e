//! What the parts of a machine are called, and what its equations are asked for by these names.

use std::fmt;

/// The name of an item, or of a member of a family: `link[3]`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Name {
    /// The name as declared.
    pub base: String,
    /// The member of the family, where it is one.
    pub index: Option<i64>,
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.index {
            Some(index) => write!(f, "{}[{index}]", self.base),
            None => f.write_str(&self.base),
        }
    }
}

/// The name of the rate of a coordinate, or of a member of a family of them: `der(theta)`, `der(q[3])`.
pub fn rate_name(coordinate: &str, index: impl fmt::Display) -> String {
    format!("der({coordinate}{index})")
}

/// What accelerations depend on, and can be differentiated by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Variable {
    /// A coordinate, by its index in the list of coordinates.
    Coordinate(usize),
    /// The rate of a coordinate.
    Rate(usize),
    /// An input, by its index in that of inputs.
    Input(usize),
    /// A parameter, by its index in that of parameters.
    Parameter(usize),
}

impl Variable {
    /// Every coordinate, then every rate: what a linearization needs.
    pub fn of_state(coordinates: usize) -> Vec<Variable> {
        let q = (0..coordinates).map(Variable::Coordinate);
        q.chain((0..coordinates).map(Variable::Rate)).collect()
    }
}

/// What may stay while the rest changes, so that its work is not done again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// Time.
    pub time: bool,
    /// Time and coordinates.
    pub coordinates: bool,
}

impl Stages {
    /// Whether nothing is asked for.
    pub fn is_empty(self) -> bool {
        self == Stages::default()
    }
}

/// The force in a contact that yields, of its depth `d` and how fast that grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Compliance {
    /// `k d + b ḋ`.
    Linear,
    /// `K d^(3/2)`.
    Hertz,
    /// `K d^(3/2) (1 + c ḋ)`.
    HuntCrossley,
    /// `k₁ d` where it is pressed for the first time, and `k₂` along what it yields before that and back.
    Layer,
}

impl Compliance {
    /// All of them.
    pub const ALL: [Compliance; 4] = [
        Compliance::Linear,
        Compliance::Hertz,
        Compliance::HuntCrossley,
        Compliance::Layer,
    ];

    /// As a spec writes it.
    pub fn name(self) -> &'static str {
        match self {
            Compliance::Linear => "linear",
            Compliance::Hertz => "hertz",
            Compliance::HuntCrossley => "hunt_crossley",
            Compliance::Layer => "layer",
        }
    }

    /// What its parameters are called in messages and in the names of what programs give, in their order.
    pub fn parameters(self) -> &'static [&'static str] {
        match self {
            Compliance::Linear => &["stiffness", "damping"],
            Compliance::Hertz => &["stiffness"],
            Compliance::HuntCrossley => &["stiffness", "damping"],
            Compliance::Layer => &["loading", "unloading"],
        }
    }
}

/// Whether contacts that are closed take part in one impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImpactOrder {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, the one that closes fastest first, until none closes.
    Sequence,
}

impl ImpactOrder {
    /// Both of them.
    pub const ALL: [ImpactOrder; 2] = [ImpactOrder::AtOnce, ImpactOrder::Sequence];

    /// As a spec writes it.
    pub fn name(self) -> &'static str {
        match self {
            ImpactOrder::AtOnce => "at_once",
            ImpactOrder::Sequence => "sequence",
        }
    }
}

/// What becomes of a contact whose friction leaves no motion: P. Painlevé's paradox.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Painleve {
    /// The run ends.
    #[default]
    Error,
    /// An impact without a collision ends the slip.
    Impact,
}

impl Painleve {
    /// Both of them.
    pub const ALL: [Painleve; 2] = [Painleve::Error, Painleve::Impact];

    /// As a spec writes it.
    pub fn name(self) -> &'static str {
        match self {
            Painleve::Error => "error",
            Painleve::Impact => "impact",
        }
    }
}

/// How rates after an impact follow from those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImpactLaw {
    /// `0 ≤ Λₙ ⊥ γₙ⁺ + e γₙ⁻ ≥ 0`.
    #[default]
    Newton,
    /// The impulse of expansion is `e` times that of compression, along Routh's path; one contact at a
    /// time.
    Poisson,
    /// Poisson's hypothesis for several contacts at once, in two complementarity problems.
    PoissonGlocker,
    /// The work of expansion is `−e²` times that of compression, along Routh's path; one contact at a
    /// time.
    Stronge,
}

impl ImpactLaw {
    /// All of them.
    pub const ALL: [ImpactLaw; 4] = [
        ImpactLaw::Newton,
        ImpactLaw::Poisson,
        ImpactLaw::PoissonGlocker,
        ImpactLaw::Stronge,
    ];

    /// As a spec writes it.
    pub fn name(self) -> &'static str {
        match self {
            ImpactLaw::Newton => "newton",
            ImpactLaw::Poisson => "poisson",
            ImpactLaw::PoissonGlocker => "poisson_glocker",
            ImpactLaw::Stronge => "stronge",
        }
    }
}
