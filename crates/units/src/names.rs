//! Names of the parts of a machine, and the variables and options that its equations refer to by name.

use std::fmt;

/// The name of an item, or of a member of a family: `link[3]`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Name {
    /// The name as declared.
    pub base: String,
    /// The index of the member of the family, if it is one.
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
    /// The name of the time integral of this: `integral(i)`, `integral(T)[3]`.
    pub fn integral(&self) -> Name {
        Name {
            base: format!("integral({})", self.base),
            index: self.index,
        }
    }

    /// The base, or for an integral the base of the integrand: a word that may name a field.
    pub fn word(&self) -> &str {
        integrand(&self.base).map_or(&self.base, |(base, _)| base)
    }
}

/// The integrand, and the text after the bracket: `integral(T)[3]` is (`T`, `[3]`).
fn integrand(name: &str) -> Option<(&str, &str)> {
    let (base, index) = name.strip_prefix("integral(")?.split_once(')')?;
    let is_index = index.is_empty() || (index.starts_with('[') && index.ends_with(']'));
    is_index.then_some((base, index))
}

/// The first-order state whose time integral a coordinate is, if it is one: no spec can give a coordinate the name `integral(i)`.
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

/// The name of the time integral of a state: `integral(T)[3]` for `T[3]`.
pub fn integral_name(state: &str) -> String {
    match state.split_once('[') {
        Some((base, index)) => format!("integral({base})[{index}"),
        None => format!("integral({state})"),
    }
}

/// The unit of the rate of a coordinate, as text: `m/s` for `m`; for the time integral of a state the unit of the state,
/// `A` for `A*s`.
pub fn rate_unit(coordinate: &str, unit: &str) -> String {
    match (integrand(coordinate), unit) {
        (Some(_), "s") => "1".to_owned(),
        (Some(_), unit) => unit.strip_suffix("*s").unwrap_or(unit).to_owned(),
        (None, "1") => "1/s".to_owned(),
        (None, unit) => format!("{unit}/s"),
    }
}

/// The name of the rate of a coordinate, or of a member of a family: `der(theta)`, `der(q[3])`; for the time
/// integral of a state the state: `i` for `integral(i)`.
pub fn rate_name(coordinate: &str, index: impl fmt::Display) -> String {
    let name = format!("{coordinate}{index}");
    state_of(&name).unwrap_or_else(|| format!("der({name})"))
}

/// A variable by which accelerations can be differentiated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Variable {
    /// A coordinate, by its index in the list of coordinates.
    Coordinate(usize),
    /// The rate of a coordinate.
    Rate(usize),
    /// An input, by its index in the list of inputs.
    Input(usize),
    /// A parameter, by its index in the list of parameters.
    Parameter(usize),
}

impl Variable {
    /// Every coordinate, then every rate, as needed for a linearization.
    pub fn of_state(coordinates: usize) -> Vec<Variable> {
        let q = (0..coordinates).map(Variable::Coordinate);
        q.chain((0..coordinates).map(Variable::Rate)).collect()
    }
}

/// The arguments that may stay constant while others change, so that their work need not be repeated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// Time.
    pub time: bool,
    /// Time and coordinates.
    pub coordinates: bool,
}

impl Stages {
    /// Whether no stages are requested.
    pub fn is_empty(self) -> bool {
        self == Stages::default()
    }
}

/// The force law of a compliant contact, as a function of its depth `d` and the rate of that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Compliance {
    /// `k d + b ḋ`.
    Linear,
    /// `K d^(3/2)`.
    Hertz,
    /// `K d^(3/2) (1 + c ḋ)`.
    HuntCrossley,
    /// `k₁ d` when it is pressed for the first time, and `k₂` for unloading and reloading below the previous maximum.
    Layer,
}

impl Compliance {
    /// All force laws.
    pub const ALL: [Compliance; 4] = [
        Compliance::Linear,
        Compliance::Hertz,
        Compliance::HuntCrossley,
        Compliance::Layer,
    ];

    /// The name in a spec.
    pub fn name(self) -> &'static str {
        match self {
            Compliance::Linear => "linear",
            Compliance::Hertz => "hertz",
            Compliance::HuntCrossley => "hunt_crossley",
            Compliance::Layer => "layer",
        }
    }

    /// The names of its parameters in messages and in the values of programs, in their order.
    pub fn parameters(self) -> &'static [&'static str] {
        match self {
            Compliance::Linear => &["stiffness", "damping"],
            Compliance::Hertz => &["stiffness"],
            Compliance::HuntCrossley => &["stiffness", "damping"],
            Compliance::Layer => &["loading", "unloading"],
        }
    }
}

/// How closed contacts take part in an impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImpactOrder {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, the one that closes fastest first, until none closes.
    Sequence,
}

impl ImpactOrder {
    /// Both orders.
    pub const ALL: [ImpactOrder; 2] = [ImpactOrder::AtOnce, ImpactOrder::Sequence];

    /// The name in a spec.
    pub fn name(self) -> &'static str {
        match self {
            ImpactOrder::AtOnce => "at_once",
            ImpactOrder::Sequence => "sequence",
        }
    }
}

/// The treatment of a contact whose friction leaves no consistent motion (Painlevé's paradox).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Painleve {
    /// The run ends.
    #[default]
    Error,
    /// An impact without collision ends the slip.
    Impact,
}

impl Painleve {
    /// Both treatments.
    pub const ALL: [Painleve; 2] = [Painleve::Error, Painleve::Impact];

    /// The name in a spec.
    pub fn name(self) -> &'static str {
        match self {
            Painleve::Error => "error",
            Painleve::Impact => "impact",
        }
    }
}

/// The impact law: how rates after an impact follow from those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ImpactLaw {
    /// `0 ≤ Λₙ ⊥ γₙ⁺ + e γₙ⁻ ≥ 0`.
    #[default]
    Newton,
    /// The impulse of expansion is `e` times that of compression, along Routh's path; one contact at a time.
    Poisson,
    /// Poisson's hypothesis for several contacts at once, in two complementarity problems.
    PoissonGlocker,
    /// The work of expansion is `−e²` times that of compression, along Routh's path; one contact at a time.
    Stronge,
}

impl ImpactLaw {
    /// All impact laws.
    pub const ALL: [ImpactLaw; 4] = [
        ImpactLaw::Newton,
        ImpactLaw::Poisson,
        ImpactLaw::PoissonGlocker,
        ImpactLaw::Stronge,
    ];

    /// The name in a spec.
    pub fn name(self) -> &'static str {
        match self {
            ImpactLaw::Newton => "newton",
            ImpactLaw::Poisson => "poisson",
            ImpactLaw::PoissonGlocker => "poisson_glocker",
            ImpactLaw::Stronge => "stronge",
        }
    }
}
