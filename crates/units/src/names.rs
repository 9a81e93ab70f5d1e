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

impl Name {
    /// The name of the integral of this over time: `integral(i)`, `integral(T)[3]`.
    pub fn integral(&self) -> Name {
        Name {
            base: format!("integral({})", self.base),
            index: self.index,
        }
    }

    /// The base, or of an integral the base of what is integrated: a word that may name a field.
    pub fn word(&self) -> &str {
        integrand(&self.base).map_or(&self.base, |(base, _)| base)
    }
}

/// What is integrated, and what stands behind the bracket: `integral(T)[3]` is (`T`, `[3]`).
fn integrand(name: &str) -> Option<(&str, &str)> {
    let (base, index) = name.strip_prefix("integral(")?.split_once(')')?;
    let is_index = index.is_empty() || (index.starts_with('[') && index.ends_with(']'));
    is_index.then_some((base, index))
}

/// The state of first order of which a coordinate is the integral over time, if it is that: no spec can give a
/// coordinate the name `integral(i)`.
///
/// ```
/// use lagrangian_units::state_of;
///
/// assert_eq!(state_of("integral(i)"), Some("i".to_owned()));
/// assert_eq!(state_of("integral(T)[3]"), Some("T[3]".to_owned()));
/// assert_eq!(state_of("phi"), None);
/// ```
pub fn state_of(coordinate: &str) -> Option<String> {
    integrand(coordinate).map(|(base, index)| format!("{base}{index}"))
}

/// The name of the integral of a state over time: `integral(T)[3]` of `T[3]`.
pub fn integral_name(state: &str) -> String {
    match state.split_once('[') {
        Some((base, index)) => format!("integral({base})[{index}"),
        None => format!("integral({state})"),
    }
}

/// The unit of the rate of a coordinate, as text: `m/s` of `m`; of the integral of a state the unit of the state, `A` of
/// `A*s`.
pub fn rate_unit(coordinate: &str, unit: &str) -> String {
    match (integrand(coordinate), unit) {
        (Some(_), "s") => "1".to_owned(),
        (Some(_), unit) => unit.strip_suffix("*s").unwrap_or(unit).to_owned(),
        (None, "1") => "1/s".to_owned(),
        (None, unit) => format!("{unit}/s"),
    }
}

/// The name of the rate of a coordinate, or of a member of a family of them: `der(theta)`, `der(q[3])`; of the
/// integral of a state the state: `i` of `integral(i)`.
pub fn rate_name(coordinate: &str, index: impl fmt::Display) -> String {
    let whole = format!("{coordinate}{index}");
    state_of(&whole).unwrap_or_else(|| format!("der({whole})"))
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
