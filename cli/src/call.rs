//! The command line: commands and options.

mod orbit;
mod runs;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use lagrangian::LEAST_RELATIVE_TOLERANCE;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;
use lagrangian_spec::token::normalized;
use lagrangian_symbolic::Rational;

pub use orbit::{Orbit, Sensitivities};
pub use runs::{Compare, Direction, Interpolation, Part, Peaks, Runs, Section, Spectrum, Windows};

/// Derives, evaluates and simulates the equations of motion of machines described by specs.
#[derive(Debug, Parser)]
#[command(name = "lagrangian", version, disable_help_subcommand = true)]
pub struct Call {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// One command for each question.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Report everything that is wrong with a spec, and compare published equations with the derived ones.
    Check(Check),
    /// Print the derived equations, or the code, with operation counts.
    Derive(Derive),
    /// Build a shared library that C, Python and others can call.
    Library(Library),
    /// Build a functional mock-up unit for tools that import FMI 3.0 or 2.0.
    Fmu(Fmu),
    /// Compute numbers at given states, as JSON.
    Evaluate(Evaluate),
    /// Integrate the equations of motion.
    Simulate(Simulate),
    /// Integrate many times, over parameters, inputs and start values, with one row for each run.
    Sweep(Box<Sweep>),
    /// Plot a sweep: curves over one parameter, a colour map over two.
    Map(Map),
    /// Find an equilibrium, and print eigenfrequencies, damping ratios and mode shapes about it.
    Modes(Modes),
    /// Compute the linear model about an equilibrium, a steady motion or any state: A, B, C, D; poles, zeros, frequency response.
    Linearize(Box<Linearize>),
    /// Find a periodic motion: its period, monodromy matrix and Floquet multipliers, and whether it is stable.
    Orbit(Box<Orbit>),
    /// Compute the derivatives of a motion with respect to parameters, inputs and start values.
    Sensitivities(Box<Sensitivities>),
    /// Report how far two runs, given as tables or specs, are apart.
    Compare(Box<Compare>),
    /// Find the frequencies in a run, with their amplitudes.
    Spectrum(Box<Spectrum>),
    /// Find the maxima and minima of a run, with period and decrement.
    Peaks(Box<Peaks>),
    /// Sample a run once in each period, or where a quantity passes a value: a Poincaré section.
    Section(Box<Section>),
    /// Estimate parameters and start values from measured motions, with standard errors and the parameters that cannot be told apart.
    Fit(Box<Fit>),
    /// Find the fastest motion from rest at one position to another, under control forces that do no work.
    Brachistochrone(Brachistochrone),
    /// Convert a URDF or MJCF file of a robot to a spec.
    Import(Import),
}

impl Command {
    /// The spec of the call, if it has one.
    fn spec(&self) -> Option<&Spec> {
        Some(match self {
            Command::Check(call) => &call.spec,
            Command::Derive(call) => &call.spec,
            Command::Library(call) => &call.spec,
            Command::Fmu(call) => &call.spec,
            Command::Evaluate(call) => &call.spec,
            Command::Simulate(call) => &call.spec,
            Command::Sweep(call) => &call.spec,
            Command::Orbit(call) => &call.spec,
            Command::Sensitivities(call) => &call.spec,
            Command::Map(_) | Command::Import(_) => return None,
            Command::Compare(_)
            | Command::Spectrum(_)
            | Command::Peaks(_)
            | Command::Section(_) => return None,
            Command::Modes(call) => &call.spec,
            Command::Linearize(call) => &call.spec,
            Command::Fit(call) => &call.spec,
            Command::Brachistochrone(call) => &call.spec,
        })
    }

    /// The spec of the call, for modification.
    fn spec_mut(&mut self) -> Option<&mut Spec> {
        Some(match self {
            Command::Check(call) => &mut call.spec,
            Command::Derive(call) => &mut call.spec,
            Command::Library(call) => &mut call.spec,
            Command::Fmu(call) => &mut call.spec,
            Command::Evaluate(call) => &mut call.spec,
            Command::Simulate(call) => &mut call.spec,
            Command::Sweep(call) => &mut call.spec,
            Command::Orbit(call) => &mut call.spec,
            Command::Sensitivities(call) => &mut call.spec,
            Command::Map(_) | Command::Import(_) => return None,
            Command::Compare(_)
            | Command::Spectrum(_)
            | Command::Peaks(_)
            | Command::Section(_) => return None,
            Command::Modes(call) => &mut call.spec,
            Command::Linearize(call) => &mut call.spec,
            Command::Fit(call) => &mut call.spec,
            Command::Brachistochrone(call) => &mut call.spec,
        })
    }

    /// The names that the call sets, varies or fits: a parameter with such a name does not follow from others.
    fn given(&self) -> Result<Vec<String>, String> {
        let sets = ["--set", "--set-second"];
        let named = self.named().into_iter();
        let named = named.filter(|(option, _)| sets.contains(option));
        let mut all_names: Vec<String> = named.map(|(_, name)| name.to_owned()).collect();
        let along = match self {
            Command::Modes(call) => call.vary.as_ref(),
            Command::Linearize(call) => call.along.as_ref(),
            Command::Orbit(call) => call.along.as_ref(),
            _ => None,
        };
        all_names.extend(along.map(|along| along.name.clone()));
        match self {
            Command::Sweep(call) => {
                let ends = ['=', '~'];
                let varied = call.vary.iter().filter_map(|text| text.split(ends).next());
                all_names.extend(varied.map(|name| name.trim().to_owned()));
                let table = call.table.iter();
                all_names.extend(table.flat_map(|path| crate::heading::names_in(path)));
            }
            Command::Fit(call) => all_names.extend(names_of(&call.sought)?),
            Command::Sensitivities(call) => all_names.extend(names_of(&call.by)?),
            _ => {}
        }
        Ok(all_names)
    }

    /// Whether its result is to be JSON.
    pub fn json(&self) -> bool {
        match self {
            Command::Import(call) => call.json,
            _ => match self.runs() {
                Some(runs) => runs.json,
                None => self.spec().is_some_and(|spec| spec.json),
            },
        }
    }

    /// The settings for running specs, for commands that accept specs instead of tables.
    fn runs(&self) -> Option<&Runs> {
        Some(match self {
            Command::Compare(call) => &call.runs,
            Command::Spectrum(call) => &call.part.runs,
            Command::Peaks(call) => &call.part.runs,
            Command::Section(call) => &call.part.runs,
            _ => return None,
        })
    }

    /// Every name that the call sets, with the option that sets it.
    fn named<'a>(&'a self) -> Vec<(&'static str, &'a str)> {
        let mut named = Vec::new();
        let mut add = |option: &'static str, list: &'a [Assignment]| {
            named.extend(list.iter().map(|set| (option, set.name.as_str())));
        };
        match self {
            Command::Check(_) | Command::Derive(_) | Command::Library(_) | Command::Import(_) => {}
            Command::Map(call) => add("--only", &call.only),
            Command::Fmu(call) => {
                add("--set", &call.parameters);
                add("--start", &call.coordinates);
                add("--rate", &call.rates);
            }
            Command::Evaluate(Evaluate { start, .. })
            | Command::Simulate(Simulate { start, .. }) => {
                add("--set", &start.parameters);
                add("--start", &start.coordinates);
                add("--rate", &start.rates);
            }
            Command::Modes(Modes { search, .. }) => search.named(&mut named),
            Command::Linearize(call) => call.search.named(&mut named),
            Command::Sweep(call) => {
                add("--set", &call.start.parameters);
                add("--start", &call.start.coordinates);
                add("--rate", &call.start.rates);
            }
            Command::Orbit(call) => {
                add("--advance", &call.advance);
                add("--set", &call.start.parameters);
                add("--start", &call.start.coordinates);
                add("--rate", &call.start.rates);
            }
            Command::Sensitivities(call) => {
                add("--set", &call.start.parameters);
                add("--start", &call.start.coordinates);
                add("--rate", &call.start.rates);
            }
            Command::Compare(call) => {
                add("--set-second", &call.second_parameters);
                add("--start-second", &call.second_coordinates);
                add("--rate-second", &call.second_rates);
            }
            Command::Spectrum(_) | Command::Peaks(_) | Command::Section(_) => {}
            Command::Fit(call) => {
                add("--set", &call.start.parameters);
                add("--start", &call.start.coordinates);
                add("--rate", &call.start.rates);
                add("--input", &call.inputs);
            }
            Command::Brachistochrone(call) => {
                add("--set", &call.parameters);
                add("--from", &call.from);
                add("--to", &call.to);
            }
        }
        if let Command::Simulate(call) = self {
            named.extend(call.inputs.iter().map(|set| ("--input", set.name.as_str())));
        }
        if let Command::Sweep(call) = self {
            let mut add = |option: &'static str, list: &'a [Assignment]| {
                named.extend(list.iter().map(|set| (option, set.name.as_str())));
            };
            add("--input", &call.inputs);
            add("--event", &call.events);
            add("--until-event", &call.ends);
            add("--reduce", &call.reductions);
        }
        if let Command::Fmu(call) = self {
            named.extend(call.events.iter().map(|set| ("--event", set.name.as_str())));
        }
        if let Some(runs) = self.runs() {
            let mut add = |option: &'static str, list: &'a [Assignment]| {
                named.extend(list.iter().map(|set| (option, set.name.as_str())));
            };
            add("--set", &runs.start.parameters);
            add("--start", &runs.start.coordinates);
            add("--rate", &runs.start.rates);
            add("--input", &runs.inputs);
            let constants = runs.constants.iter();
            named.extend(constants.map(|(name, _)| ("--const", name.as_str())));
        }
        if let Command::Fit(call) = self {
            named.extend(call.bounds.iter().map(|b| ("--bounds", b.name.as_str())));
            named.extend(call.sigmas.iter().map(|sigma| match sigma {
                SigmaOption::Estimated => ("--sigma", "auto"),
                SigmaOption::Given(set) => ("--sigma", set.name.as_str()),
            }));
        }
        let constants = self.spec().into_iter().flat_map(|spec| &spec.constants);
        named.extend(constants.map(|(name, _)| ("--const", name.as_str())));
        named
    }
}

impl Call {
    /// Parses the words of a call, of which the first is the name of the program.
    ///
    /// # Errors
    /// If they are not a valid call; the message is to be printed, and may be the requested help.
    pub fn read<T: Into<OsString> + Clone>(
        words: impl IntoIterator<Item = T>,
    ) -> Result<Call, clap::Error> {
        let mut call = Call::try_parse_from(words)?;
        // An invalid list is refused later, where its names are needed.
        let given = call.command.given().unwrap_or_default();
        if let Some(spec) = call.command.spec_mut() {
            spec.given = given;
        }
        Ok(call)
    }

    /// Checks that nothing is set twice, because it would not be clear which value is meant.
    ///
    /// # Errors
    /// If something is set twice: what.
    pub fn check(&self) -> Result<(), String> {
        let mut named = self.command.named();
        named.sort_unstable();
        let twice = named.windows(2).find(|pair| pair[0] == pair[1]);
        if let Some(&[(option, name), _]) = twice {
            return Err(format!("{option} sets `{name}` more than once"));
        }
        let driven = named.iter().filter(|(option, _)| *option == "--input");
        let mut driven = driven.filter(|(_, name)| named.contains(&("--set", name)));
        if let Some((_, name)) = driven.next() {
            return Err(format!(
                "`{name}` is driven by --input and also set to a constant by --set"
            ));
        }
        if let Command::Library(call) = &self.command {
            let mut lanes = call.lanes.clone();
            lanes.sort_unstable();
            if let Some(pair) = lanes.windows(2).find(|pair| pair[0] == pair[1]) {
                return Err(format!("--lanes names {} more than once", pair[0]));
            }
        }
        Ok(())
    }
}

/// Which machine, of which size.
#[derive(Debug, Args)]
pub struct Spec {
    /// The spec, a `.machine` file.
    #[arg(value_name = "SPEC")]
    pub path: PathBuf,
    /// Derive the machine with another value of a constant, as in `--const N=8`.
    #[arg(long = "const", value_name = "NAME=VALUE", value_parser = constant)]
    pub constants: Vec<(String, Rational)>,
    /// The parameters to which the call gives values: none of them follows from others.
    #[arg(skip)]
    pub given: Vec<String>,
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

/// Which parameters the machine has, and where it starts.
#[derive(Debug, Args)]
pub struct Start {
    /// Set a parameter, as in `--set omega=120` or `--set omega=1500*rpm`, or an input; a bare number is in the unit that the
    /// spec declares.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub parameters: Vec<Assignment>,
    /// Set a coordinate at the start, as in `--start phi=30*deg`; the name of a family sets every member.
    #[arg(long = "start", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub coordinates: Vec<Assignment>,
    /// Set the velocity of a coordinate at the start; 0 if not given.
    #[arg(long = "rate", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub rates: Vec<Assignment>,
    #[command(flatten)]
    pub running: Running,
}

/// How it is run.
#[derive(Clone, Copy, Debug, Args)]
pub struct Running {
    /// How the equations are evaluated; the results are the same to the last bit.
    #[arg(long, value_enum, default_value_t = Engine::Auto)]
    pub engine: Engine,
}

/// What runs the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// The interpreter until machine code is worth compiling, or throughout where machine code is not available.
    Auto,
    /// The interpreter.
    Interpreter,
    /// Machine code from the first call on.
    Jit,
}

/// The numbers that a run is made in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// Double precision, with 53 bits.
    F64,
    /// Double-double: sums of two such numbers, with about 106 bits or 32 digits.
    Dd,
}

/// Which numbers of a start stay as they are.
#[derive(Debug, Args)]
pub struct Keep {
    /// If the start does not satisfy the constraints, keep these values, as in `--keep theta,der(phi)`, and correct the others: in
    /// place of those that the spec keeps; `none` keeps no value.
    #[arg(long = "keep", value_name = "NAME,…", value_delimiter = ',', value_parser = kept)]
    pub names: Vec<String>,
}

fn kept(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("expected the name of a coordinate, or der(NAME)".into()),
        name => Ok(normalized(name).into_owned()),
    }
}

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub spec: Spec,
    /// Exit with status 1 if there are warnings.
    #[arg(long)]
    pub deny_warnings: bool,
    /// Exit with status 1 if a published formula differs from the derived one.
    #[arg(long)]
    pub strict: bool,
    /// Measure the accuracy of the machine's program by comparison with arithmetic of 30 digits.
    #[arg(long)]
    pub accuracy: bool,
}

/// Arguments of `derive`.
#[derive(Debug, Args)]
pub struct Derive {
    #[command(flatten)]
    pub spec: Spec,
    /// The form of the output.
    #[arg(long = "as", value_enum, default_value_t = Form::Markdown)]
    pub form: Form,
    /// Write it to a file instead of standard output.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// The forms of a derivation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Form {
    /// The equations, for reading.
    Markdown,
    /// The equations, for typesetting.
    Latex,
    /// The equations, as a page for a browser.
    Html,
    /// The code that `machine!` emits.
    Rust,
    /// The operations, one on each line, with their counts.
    Program,
    /// The code as C99.
    C,
    /// The operations as Python for SymPy, for numbers and symbols.
    Sympy,
    /// The operations as MATLAB, for Octave too.
    Matlab,
    /// The operations as Julia.
    Julia,
    /// The operations as JavaScript.
    #[value(name = "javascript")]
    JavaScript,
}

/// Arguments of `library`.
#[derive(Debug, Args)]
pub struct Library {
    #[command(flatten)]
    pub spec: Spec,
    /// Where to write the library; its C header is written beside it.
    #[arg(long, value_name = "FILE.so")]
    pub out: PathBuf,
    /// The numbers of states that further functions besides `eval` evaluate at once: 2, 4, 8, or several of them, as in
    /// `--lanes 4,8`.
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "4", value_parser = lanes)]
    pub lanes: Vec<u8>,
    /// The processor to compile for, as rustc names it: x86-64-v3 for any processor with AVX2.
    #[arg(long, value_name = "NAME", default_value = "native")]
    pub target_cpu: String,
    /// Also write the single Rust file from which it is compiled.
    #[arg(long, value_name = "FILE.rs")]
    pub source: Option<PathBuf>,
    /// Write repeated parts out instead of as loops: longer code with bitwise the same results.
    #[arg(long)]
    pub straight: bool,
}

/// Arguments of `fmu`.
#[derive(Debug, Args)]
pub struct Fmu {
    #[command(flatten)]
    pub spec: Spec,
    /// Where to write the unit.
    #[arg(long, value_name = "FILE.fmu")]
    pub out: PathBuf,
    /// Which version of the interface: 3 or 2.
    #[arg(long, value_name = "VERSION", default_value = "3", value_parser = clap::value_parser!(u8).range(2..=3))]
    pub fmi: u8,
    /// The kind of importer: one that integrates itself (`me`), one that lets the unit integrate (`cs`), or both.
    #[arg(long, value_name = "KIND,…", value_enum, value_delimiter = ',', default_values_t = [UnitKind::ModelExchange, UnitKind::CoSimulation])]
    pub kind: Vec<UnitKind>,
    /// The variables that are outputs, as in `--outputs theta1,energy.kinetic`, in place of the outputs of the spec or the coordinates.
    #[arg(long, value_name = "NAME,…", value_parser = names)]
    pub outputs: Option<Names>,
    /// Watch for sign changes of a formula, as in `--event low=theta1`: an event indicator for importers that integrate, and an output
    /// `event.low` that counts them.
    #[arg(long = "event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub events: Vec<Assignment>,
    /// The integration method of the unit in co-simulation: `dop853` of order 8, or `dopri5` of order 5, whose steps are cheaper, for
    /// communication points that are close together.
    #[arg(long, value_enum, default_value_t = UnitMethod::Dop853)]
    pub method: UnitMethod,
    /// Relative and absolute tolerance of co-simulation, unless the importer gives one.
    #[arg(long, default_value_t = 1e-9, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// Change the default of a parameter or an input, as in `--set omega=120`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub parameters: Vec<Assignment>,
    /// Change the start value of a coordinate.
    #[arg(long = "start", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub coordinates: Vec<Assignment>,
    /// Change the velocity of a coordinate at the start.
    #[arg(long = "rate", value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub rates: Vec<Assignment>,
    /// The C compiler, in place of `cc` or the one that the variable CC names.
    #[arg(long, value_name = "COMMAND")]
    pub cc: Option<String>,
    /// Build libraries for these platforms instead of this one, as in `--target x86_64-linux-gnu,x86_64-windows-gnu`: the compiler is
    /// called with `--target=TRIPLE`, as Clang expects it, or with the triple in place of `{}` in --cc, as in `--cc '{}-gcc'`.
    #[arg(
        long,
        value_name = "TRIPLE,…",
        value_delimiter = ',',
        conflicts_with = "sources_only"
    )]
    pub target: Vec<String>,
    /// Include no library, for importers that compile the sources.
    #[arg(long, conflicts_with = "cc")]
    pub sources_only: bool,
}

/// Names separated by commas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names(pub Vec<String>);

/// Parses names separated by commas; `der(q,2)` and quoted text are one name.
fn names(text: &str) -> Result<Names, String> {
    let (mut names, mut depth, mut quoted) = (vec![String::new()], 0, false);
    for c in text.chars() {
        match c {
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth -= 1,
            '\'' => quoted = !quoted,
            ',' if !quoted && depth == 0 => {
                names.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(name) = names.last_mut() {
            name.push(c);
        }
    }
    let names: Vec<String> = names.iter().map(|name| name.trim().to_owned()).collect();
    if names.iter().any(String::is_empty) {
        Err("expected names, with commas between them".into())
    } else {
        Ok(Names(names))
    }
}

/// Who integrates a functional mock-up unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitKind {
    /// The importer.
    #[value(name = "me")]
    ModelExchange,
    /// The unit.
    #[value(name = "cs")]
    CoSimulation,
}

impl UnitKind {
    /// The name in `--kind`.
    pub fn name(self) -> &'static str {
        match self {
            UnitKind::ModelExchange => "me",
            UnitKind::CoSimulation => "cs",
        }
    }

    /// The name in the standard.
    pub fn words(self) -> &'static str {
        match self {
            UnitKind::ModelExchange => "model exchange",
            UnitKind::CoSimulation => "co-simulation",
        }
    }
}

/// Arguments of `evaluate`.
#[derive(Debug, Args)]
pub struct Evaluate {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// A JSON list of points {"t", "q", "v", "states", "parameters", "inputs"}, or `-` for standard input; without it, the only point is
    /// the start.
    #[arg(long, value_name = "POINTS.json")]
    pub at: Option<PathBuf>,
}

/// How a unit integrates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum UnitMethod {
    /// Dormand and Prince's method of order 8.
    Dop853,
    /// Dormand and Prince's method of order 5.
    Dopri5,
}

/// Arguments of `import`.
#[derive(Debug, Args)]
pub struct Import {
    /// The robot: a URDF file with the ending `.urdf`, or a MuJoCo model with the ending `.xml` or `.mjcf`.
    #[arg(value_name = "ROBOT")]
    pub path: PathBuf,
    /// Write the spec to a file instead of standard output.
    #[arg(long, value_name = "FILE.machine")]
    pub out: Option<PathBuf>,
    /// Whether the root link is fixed to the ground or moves with six coordinates.
    #[arg(long, value_enum, default_value_t = Base::Fixed)]
    pub base: Base,
    /// The angles of spherical and floating joints, named after their rotation axes, or a quaternion, which is singular nowhere; by
    /// default xyz for spherical joints and zyx for floating ones.
    #[arg(long, value_enum)]
    pub ball: Option<Ball>,
    /// The treatment of Coulomb friction, which is rejected if this option is not given: `none` leaves it out, `smooth=1e-3` makes it
    /// smooth below that rate, in rad/s or m/s.
    #[arg(long, value_name = "none|smooth=RATE", value_parser = friction)]
    pub friction: Option<Friction>,
    /// The treatment of joint limits: they are written as comments, a run reports when it leaves them, or they stop the joint.
    #[arg(long, value_enum, default_value_t = Limits::None)]
    pub limits: Limits,
    /// Leave out joints that move no mass, together with everything attached to them.
    #[arg(long)]
    pub drop_massless: bool,
    /// Leave out these elements and attributes, which are unknown or may change the motion.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub ignore: Vec<String>,
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

/// What the root of a robot does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Base {
    /// It is fixed to the ground.
    Fixed,
    /// It moves with six coordinates.
    Floating,
}

/// What turns: three angles, by the axes about which they turn, or four numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ball {
    /// About x, y and z: Cardan angles.
    Xyz,
    /// Yaw, pitch and roll.
    Zyx,
    /// Precession, nutation and spin: Euler's angles.
    Zxz,
    /// A quaternion, which is singular nowhere.
    Quaternion,
}

/// The treatment of Coulomb friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// It is left out.
    None,
    /// It is smooth below a rate.
    Smooth(f64),
}

fn friction(text: &str) -> Result<Friction, String> {
    let rate = text.strip_prefix("smooth=").map(str::parse::<f64>);
    match (text, rate) {
        ("none", _) => Ok(Friction::None),
        (_, Some(Ok(rate))) if rate.is_normal() && rate > 0.0 => Ok(Friction::Smooth(rate)),
        _ => Err("expected `none`, or `smooth=` and a rate above 0, as in `smooth=1e-3`".into()),
    }
}

/// What becomes of the limits of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Limits {
    /// They are written as comments.
    None,
    /// A run reports when it leaves them.
    Assume,
    /// Stops: unilateral contacts at both ends.
    Stop,
}

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Drive an input while the machine runs: by a formula in time, coordinates, rates, parameters, other inputs and outputs,
    /// `--input 'u=0.5*N*sin(10*rad/s*t)'`; by a controller that evaluates one every so often, `--input
    /// 'u=-5*N*s/m*der(x),every=1*ms,delay=0.2*ms'`; or by a table `.csv` or `.parquet` with columns `t` and the input's name,
    /// `--input u=table.csv[:COLUMN][,hold|linear|cubic][,end=hold|error|repeat]`.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// Integrate to this time, in s; before 0 backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: f64,
    /// Relative and absolute tolerance of each step; by default 1e-9, and in double-double what its digits allow.
    #[arg(long, value_parser = wide_tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// The arithmetic of the run; in double-double the end is printed with 30 digits, for machines without constraints and contacts.
    #[arg(long, value_enum, value_name = "NUMBERS", default_value_t = Precision::F64)]
    pub precision: Precision,
    /// Enclose the motion: print bounds that are proved to contain it, for machines with a Taylor series and without constraints
    /// and contacts.
    #[arg(long, conflicts_with = "precision")]
    pub validated: bool,
    /// Estimate the error at the end of the run, from a run in double-double where the machine allows one, otherwise from a run at a
    /// finer tolerance.
    #[arg(long)]
    pub global_error: bool,
    /// The integration method: auto, which begins with dop853, continues with radau5, radau9 or radau13 where the machine is stiff, and
    /// with moreau where contacts meet too often for each instant to be found; dop853, dopri5, bs32; radau5, radau9 and radau13 for stiff
    /// machines; taylor for smooth ones; or, in steps of --longest-step, moreau for many contacts that open and close, rk4,
    /// semi-implicit-euler, gauss4, gauss6, gauss8, rattle or generalized-alpha.
    #[arg(long, value_name = "NAME", default_value = "auto")]
    pub method: String,
    /// The longest step, in s; the length of all steps of methods that have no tolerance.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub longest_step: Option<f64>,
    /// The maximum number of steps of the run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Record the motion at this interval, in s; without it, 1000 times.
    #[arg(long, value_name = "SECONDS", value_parser = interval, allow_hyphen_values = true)]
    pub every: Option<f64>,
    /// Write the motion to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the motion as SVG: coordinates, outputs, energies, and the residual of the energy balance.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Write a page with an animation of the machine, its curves, parameters and equations; one file, for any browser.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Embed the machine in the page of --report, where sliders for parameters, inputs and start values run it again.
    #[arg(long, requires = "report")]
    pub live: bool,
}

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Integrate each run to this time, in s; before 0 backward in time.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub until: Option<f64>,
    /// Relative and absolute tolerance of each step.
    #[arg(long, default_value_t = 1e-9, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// The integration method: dop853, dopri5, bs32, radau5 for stiff machines, or taylor for smooth ones.
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    pub method: String,
    /// The maximum number of steps of each run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Vary a parameter, an input, `start(q)` or `rate(q)`: `omega=50..150:101` (101 values; append `:log` for a geometric grid),
    /// `omega=50,60,90`, or, to be sampled, `omega=50..150`, `omega~normal(100,5)`, `~uniform(a,b)`, `~loguniform(a,b)`,
    /// `~triangular(a,b,peak)`. Several are combined as a full grid, in which the last one changes fastest.
    #[arg(long, value_name = "NAME=VALUES", allow_hyphen_values = true)]
    pub vary: Vec<String>,
    /// The number of sets of values to sample from the given ranges and distributions.
    #[arg(long, value_name = "N", value_parser = count)]
    pub samples: Option<u64>,
    /// How values are sampled.
    #[arg(long, value_enum, default_value_t = Design::Sobol)]
    pub design: Design,
    /// The seed of the sampling; 0 gives the Sobol sequence itself.
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Take the values of these together, the first with the first and so on, instead of crossing them, as in `--together m,omega`.
    #[arg(long, value_name = "NAME,…")]
    pub together: Vec<String>,
    /// Take the runs from a table `.csv` or `.parquet`: one row for each run, with columns named after what is varied.
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Drive an input while the machine runs: by a formula in time, coordinates, rates, parameters, other inputs and outputs,
    /// `--input 'u=0.5*N*sin(10*rad/s*t)'`; by a controller that evaluates one every so often, `--input
    /// 'u=-5*N*s/m*der(x),every=1*ms,delay=0.2*ms'`; or by a table `.csv` or `.parquet` with columns `t` and the input's name,
    /// `--input u=table.csv[:COLUMN][,hold|linear|cubic][,end=hold|error|repeat]`.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// Watch for sign changes of a formula, as in `--event top=theta-pi`.
    #[arg(long = "event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub events: Vec<Assignment>,
    /// End the run at the first instant at which a formula changes sign.
    #[arg(long = "until-event", value_name = "NAME=FORMULA", value_parser = assignment, allow_hyphen_values = true)]
    pub ends: Vec<Assignment>,
    /// What is recorded of the motion besides its end: `at=0.5,1` records the states at these times; `every=0.01` writes samples to a
    /// second file, and `event=NAME` a sample at every event of that name.
    #[arg(long, value_name = "end|at=T,…|every=T|event=NAME,…")]
    pub record: Vec<String>,
    /// Reduce each motion to a number, as in `--reduce 'peak = max(abs(x))'`: max, min, range, mean, rms, integral, first, last,
    /// when_max, when_min of a formula; count, first, last of an event.
    #[arg(long = "reduce", value_name = "NAME=F(FORMULA)", value_parser = assignment, allow_hyphen_values = true)]
    pub reductions: Vec<Assignment>,
    /// Ignore the motion before this time, in s, in these reductions.
    #[arg(long, value_name = "SECONDS", value_parser = number, allow_hyphen_values = true)]
    pub after: Option<f64>,
    /// Where the rows are written: a table `.csv` or `.parquet`, or a folder, in which the chunks remain. An interrupted sweep is resumed.
    #[arg(long, value_name = "FILE|FOLDER")]
    pub out: Option<PathBuf>,
    /// Start over, even if part of the sweep already exists.
    #[arg(long)]
    pub fresh: bool,
    /// The number of threads; by default one for each core.
    #[arg(long, value_name = "N", value_parser = count)]
    pub threads: Option<u64>,
    /// Stop after this many runs, rounded up to whole chunks; the same command resumes the sweep.
    #[arg(long, value_name = "RUNS", value_parser = count)]
    pub limit: Option<u64>,
    /// Write the plan without running it. `lagrangian sweep PLAN.json` then runs it.
    #[arg(long, value_name = "FILE.json")]
    pub plan: Option<PathBuf>,
    /// Run only this chunk of a plan, for job arrays: `lagrangian sweep PLAN.json --chunk 17 --out FOLDER`.
    #[arg(long, value_name = "K")]
    pub chunk: Option<u64>,
    /// Exit with status 1 if a run failed.
    #[arg(long)]
    pub strict: bool,
}

/// Arguments of `map`.
#[derive(Debug, Args)]
pub struct Map {
    /// The rows of a sweep, `.csv` or `.parquet`.
    #[arg(value_name = "TABLE")]
    pub table: PathBuf,
    /// The columns of the table to plot, as in `--of peak,effort`.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    pub of: Vec<String>,
    /// The varied parameters to plot over: curves over one, colours over two; all of them if not given.
    #[arg(long, value_name = "NAME[,NAME]", value_delimiter = ',')]
    pub over: Vec<String>,
    /// Plot only the rows with this value, as in `--only m2=0.5`.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    pub only: Vec<Assignment>,
    /// Plot the samples that belong to the table, one dot each: a bifurcation diagram if they were recorded at events.
    #[arg(long)]
    pub samples: bool,
    /// The drawing.
    #[arg(long, value_name = "FILE.svg", required_unless_present = "report")]
    pub plot: Option<PathBuf>,
    /// A page that shows the numbers under the pointer and can enlarge parts of the drawing.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
}

/// How values are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Design {
    /// Independent random samples.
    Random,
    /// A Latin hypercube: as many strata of each variable as there are sets, with one value in each.
    Latin,
    /// The Sobol sequence, which fills the range evenly.
    Sobol,
}

/// Where an equilibrium or a steady motion is sought.
#[derive(Debug, Args)]
pub struct Search {
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// Let a coordinate turn at a constant rate, as in `--steady phi=150`; without a number, at its rate at the start; with
    /// `phi=solve`, at a rate that is to be found.
    #[arg(long = "steady", value_name = "NAME[=RATE]", value_parser = steady, allow_hyphen_values = true)]
    pub steady: Vec<Steady>,
}

impl Search {
    /// Every name that it sets, with the option that sets it.
    fn named<'a>(&'a self, named: &mut Vec<(&'static str, &'a str)>) {
        let lists = [
            ("--set", &self.start.parameters),
            ("--start", &self.start.coordinates),
            ("--rate", &self.start.rates),
        ];
        for (option, list) in lists {
            named.extend(list.iter().map(|set| (option, set.name.as_str())));
        }
        named.extend(self.steady.iter().map(|s| ("--steady", s.name.as_str())));
    }
}

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub struct Modes {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub search: Search,
    /// Follow the motion along a range of a parameter, an input, or the rate of a coordinate, as in `--vary roll=0..10:101`, and report
    /// the values at which modes change their kind.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true)]
    pub vary: Option<Vary>,
    /// Write the motions along `--vary` to a table, `.csv` or `.parquet`, with a row for each mode.
    #[arg(long, value_name = "FILE", requires = "vary")]
    pub out: Option<PathBuf>,
    /// Draw frequencies and growth rates along `--vary`, and the root locus, as SVG.
    #[arg(long, value_name = "FILE.svg", requires = "vary")]
    pub plot: Option<PathBuf>,
}

/// Arguments of `linearize`.
#[derive(Debug, Args)]
pub struct Linearize {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub search: Search,
    /// Linearize about the start as it is, with its rates, whether or not the machine stays there.
    #[arg(long, conflicts_with_all = ["steady", "along"])]
    pub here: bool,
    /// The inputs of the model; all inputs of the machine if not given.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = observed)]
    pub inputs: Vec<String>,
    /// The outputs of the model: outputs of the spec, coordinates, `der(x)`, `der(x,2)`, `multiplier(rod)`; by default the outputs of the
    /// spec or, if it has none, its coordinates.
    #[arg(long, value_name = "NAME,…")]
    pub outputs: Vec<String>,
    /// Write the model: `.json`, `.npz` for NumPy, `.mat` for MATLAB, or `.csv`, a file for each matrix, NAME.A.csv and so on.
    /// With `--along`, a table `.csv` or `.parquet` with a row for each eigenvalue.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw gain and phase over the frequency, from each input to each output, as SVG.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "along")]
    pub bode: Option<PathBuf>,
    /// Draw the frequency response in the complex plane, from each input to each output, as SVG.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "along")]
    pub nyquist: Option<PathBuf>,
    /// Follow the eigenvalues along a range of a parameter, an input, or the rate of a coordinate, as in
    /// `--along omega=10..300:200`.
    #[arg(long, value_name = "NAME=FROM..TO:COUNT", value_parser = vary, allow_hyphen_values = true, requires = "out",
        conflicts_with_all = ["inputs", "outputs"])]
    pub along: Option<Vary>,
}

fn observed(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("expected a name".into()),
        name => Ok(normalized(name).into_owned()),
    }
}

/// The names in a list of outputs; the comma in `der(x,2)` is inside brackets.
pub fn names_of(lists: &[String]) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    for list in lists {
        let (mut depth, mut start) = (0_usize, 0);
        for (place, letter) in list.char_indices().chain([(list.len(), ',')]) {
            match letter {
                '(' | '[' => depth += 1,
                ')' | ']' => depth = depth.saturating_sub(1),
                ',' if depth == 0 || place == list.len() => {
                    names.push(observed(&list[start..place])?);
                    start = place + 1;
                }
                _ => {}
            }
        }
    }
    Ok(names)
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct Fit {
    #[command(flatten)]
    pub spec: Spec,
    #[command(flatten)]
    pub start: Start,
    #[command(flatten)]
    pub keep: Keep,
    /// A measured motion: a table `.csv` or `.parquet` with `t` and columns named like those of a run, in which an empty cell means no
    /// measurement; repeat the option for each experiment. Values that apply to this experiment alone may follow: `--data
    /// 'run.csv,start(phi)=30*deg,load=2,torque=run.csv:u'`.
    #[arg(long, value_name = "FILE[,NAME=VALUE…]", required = true)]
    pub data: Vec<String>,
    /// What is fitted: parameters, and start values of coordinates as `start(phi)` and of rates as `rate(phi)`, separately for
    /// each experiment.
    #[arg(long = "fit", value_name = "NAME,…", required = true)]
    pub sought: Vec<String>,
    /// The range within which a fitted number is sought, as in `--bounds k=100..1e4`; one end may be omitted, as in `k=0..`.
    #[arg(long, value_name = "NAME=LEAST..GREATEST", value_parser = bounds, allow_hyphen_values = true)]
    pub bounds: Vec<Bounds>,
    /// The standard deviation of a measured column, as in `--sigma phi=0.5*deg`; or `--sigma auto`, which estimates those of all
    /// columns from their residuals.
    #[arg(long = "sigma", value_name = "NAME=VALUE|auto", value_parser = sigma)]
    pub sigmas: Vec<SigmaOption>,
    /// The columns to fit to; by default all that are coordinates, rates or outputs.
    #[arg(long, value_name = "NAME,…")]
    pub columns: Vec<String>,
    /// Drive an input in all experiments, as in `simulate`: by a formula, a controller or a table.
    #[arg(long = "input", value_name = "NAME=FORMULA|FILE", value_parser = assignment, allow_hyphen_values = true)]
    pub inputs: Vec<Assignment>,
    /// The number of searches: the first from the values of the spec and the call, the others from values between the bounds, or within
    /// a factor of 3; the best result is reported.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = count)]
    pub starts: u64,
    /// Relative and absolute tolerance of each step.
    #[arg(long, default_value_t = 1e-9, value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// The integration method: dop853, dopri5, bs32, or radau5 for stiff machines.
    #[arg(long, value_name = "NAME", default_value = "dop853")]
    pub method: String,
    /// The maximum number of steps of each run.
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = steps, allow_hyphen_values = true)]
    pub max_steps: usize,
    /// Write a variant of the spec with the fitted values.
    #[arg(long, value_name = "FILE.machine")]
    pub out: Option<PathBuf>,
    /// Write measured and computed values and their residuals to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Draw measured and computed values, and the residuals, as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

/// `name=least..greatest`.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// The name of the bounded number.
    pub name: String,
    /// The lower and the upper bound, if given.
    pub ends: [Option<Assignment>; 2],
}

fn bounds(text: &str) -> Result<Bounds, String> {
    let wanted = "expected NAME=LEAST..GREATEST, as in k=100..1e4, or k=0..";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (low, high) = range.split_once("..").ok_or(wanted)?;
    let name = match name.trim() {
        "" => return Err(wanted.into()),
        name => normalized(name).into_owned(),
    };
    let end = |value: &str| match value.trim() {
        "" => None,
        value => Some(Assignment {
            name: name.clone(),
            value: value.to_owned(),
        }),
    };
    let ends = [end(low), end(high)];
    match ends {
        [None, None] => Err(wanted.into()),
        ends => Ok(Bounds { name, ends }),
    }
}

/// A parsed `--sigma`.
#[derive(Clone, Debug, PartialEq)]
pub enum SigmaOption {
    /// Standard deviations are estimated.
    Estimated,
    /// One standard deviation is given.
    Given(Assignment),
}

fn sigma(text: &str) -> Result<SigmaOption, String> {
    match text.trim() {
        "auto" => Ok(SigmaOption::Estimated),
        text => Ok(SigmaOption::Given(
            assignment(text).map_err(|_| "expected NAME=VALUE, or `auto`")?,
        )),
    }
}

/// Arguments of `brachistochrone`.
#[derive(Debug, Args)]
pub struct Brachistochrone {
    #[command(flatten)]
    pub spec: Spec,
    /// Set a parameter, as in `--set mu1=0.1`, or an input.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub parameters: Vec<Assignment>,
    /// Where the motion starts, as in `--from q1=0,q2=0`; by default at the spec's start values.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, allow_hyphen_values = true)]
    pub from: Vec<Assignment>,
    /// Where the motion ends, as in `--to q1=8,q2=4.75`; coordinates that are not given take their values from `brachistochrone { … }`
    /// in the spec or, without that section, from the start.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = assignment, allow_hyphen_values = true)]
    pub to: Vec<Assignment>,
    /// Take the values of `--from` and `--to` as normal coordinates, in the order of the coordinates.
    #[arg(long)]
    pub natural: bool,
    /// Also search near this path: a table `.csv` with a column for each coordinate and a row for each position, as written by `--out`
    /// here and in `simulate`. Its ends are moved to the requested ones.
    #[arg(long, value_name = "FILE.csv")]
    pub guess: Option<PathBuf>,
    /// Write the motion to a table, `.csv` or `.parquet`.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the path, the power of friction, and the control forces as SVG.
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Write a page that shows the motion beside that of the machine without control forces.
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    #[command(flatten)]
    pub running: Running,
}

/// `name=from..to:count`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// The name of the varied quantity.
    pub name: String,
    /// The first and the last value.
    pub ends: [Assignment; 2],
    /// The number of values; at least 2.
    pub count: usize,
}

/// The most values of a continuation: more than a drawing can resolve.
const MOST_VALUES: f64 = 1e5;

/// Reads `name=from..to:count`.
fn vary(text: &str) -> Result<Vary, String> {
    let wanted = "expected NAME=FROM..TO:COUNT, as in roll=0..10:101";
    let (name, range) = text.split_once('=').ok_or(wanted)?;
    let (range, count) = range.rsplit_once(':').ok_or(wanted)?;
    let (from, to) = range.split_once("..").ok_or(wanted)?;
    let end = |value: &str| assignment(&format!("{name}={value}"));
    let ends = [end(from)?, end(to)?];
    let values = number(count)?;
    if !(2.0..=MOST_VALUES).contains(&values) || values.fract() != 0.0 {
        return Err(format!(
            "`{}` is not a valid number of values: expected a whole number from 2 to {MOST_VALUES}",
            count.trim()
        ));
    }
    Ok(Vary {
        name: ends[0].name.clone(),
        ends,
        count: values as usize,
    })
}

/// `name`, `name=rate` or `name=solve`.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// The name of a coordinate.
    pub name: String,
    /// Its rate.
    pub rate: SteadyRate,
}

/// The rate of a coordinate that moves steadily.
#[derive(Clone, Debug, PartialEq)]
pub enum SteadyRate {
    /// The rate of the start.
    Start,
    /// A value.
    Given(Assignment),
    /// The rate that balances the machine, which is to be found.
    Solved,
}

fn steady(text: &str) -> Result<Steady, String> {
    if !text.contains('=') {
        let name = normalized(text.trim()).into_owned();
        let rate = SteadyRate::Start;
        return if name.is_empty() {
            Err("expected the name of a coordinate".into())
        } else {
            Ok(Steady { name, rate })
        };
    }
    let set = assignment(text)?;
    let name = set.name.clone();
    let rate = match set.value.as_str() {
        "solve" => SteadyRate::Solved,
        _ => SteadyRate::Given(set),
    };
    Ok(Steady { name, rate })
}

/// `name=value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The name, possibly of a member of a family: `q[3]`.
    pub name: String,
    /// The value: an expression of numbers and units in the syntax of a spec.
    pub value: String,
}

impl Assignment {
    /// The value in a unit, interpreted like the default of a parameter with that unit in a spec.
    ///
    /// # Errors
    /// If the value is invalid, with the message that a spec would give.
    pub fn value(&self, option: &str, unit: &str) -> Result<f64, String> {
        // Most values are plain numbers.
        if let Ok(value) = self.value.parse::<f64>()
            && value.is_finite()
        {
            return Ok(value);
        }
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let value = value_in(&self.value, unit, &mut sources, &mut report);
        value.ok_or_else(|| {
            let wrong = report
                .diagnostics()
                .into_iter()
                .map(|wrong| match &wrong.help {
                    Some(help) => format!("{}; {help}", wrong.message),
                    None => wrong.message.clone(),
                });
            let wrong: Vec<String> = wrong.collect();
            format!(
                "{option} {}={}: {}",
                self.name,
                self.value,
                wrong.join("; ")
            )
        })
    }
}

/// Reads `name=value`.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    let name = name.trim();
    if name.is_empty() {
        return Err("expected a name before `=`".into());
    }
    if value.trim().is_empty() {
        return Err("expected a value after `=`".into());
    }
    Ok(Assignment {
        name: normalized(name).into_owned(),
        value: value.trim().to_owned(),
    })
}

/// Reads `name=value` for a constant, exactly.
fn constant(text: &str) -> Result<(String, Rational), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    let (sign, digits) = match value.trim().strip_prefix('-') {
        Some(digits) => (Rational::from(-1), digits),
        None => (Rational::ONE, value.trim()),
    };
    let name = name.trim();
    if name.is_empty() {
        return Err("expected a name before `=`".into());
    }
    match Rational::parse_decimal(digits) {
        Some(value) => Ok((normalized(name).into_owned(), &value * &sign)),
        None => Err(format!("`{value}` is not a number (as in 8, 2.5, 1e-3)")),
    }
}

/// Parses the number of states that a function evaluates at once.
fn lanes(text: &str) -> Result<u8, String> {
    match text.trim() {
        "2" => Ok(2),
        "4" => Ok(4),
        "8" => Ok(8),
        _ => Err("expected 2, 4 or 8".into()),
    }
}

/// Parses a tolerance, which must be larger than round-off.
fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance = number(text)?;
    let least = LEAST_RELATIVE_TOLERANCE;
    match tolerance {
        _ if tolerance <= 0.0 => Err("a tolerance must be greater than 0".into()),
        _ if tolerance < least => Err(format!(
            "the least tolerance is {least:.1e}, which is the limit of round-off"
        )),
        _ if tolerance >= 1.0 => Err("a tolerance must be less than 1".into()),
        _ => Ok(tolerance),
    }
}

/// Parses a tolerance for numbers that may have more digits than `f64`.
fn wide_tolerance(text: &str) -> Result<f64, String> {
    match number(text)? {
        least if least > 0.0 && least < LEAST_WIDE_TOLERANCE => Err(format!(
            "the least tolerance in double-double is {LEAST_WIDE_TOLERANCE:.1e}, which is the limit of round-off"
        )),
        wide if wide > 0.0 && wide < LEAST_RELATIVE_TOLERANCE => Ok(wide),
        _ => tolerance(text),
    }
}

/// Ten roundings of a sum of double-doubles.
const LEAST_WIDE_TOLERANCE: f64 = 10.0 * f64::EPSILON * f64::EPSILON;

/// Parses the recording interval.
fn interval(text: &str) -> Result<f64, String> {
    let interval = number(text)?;
    if interval > 0.0 {
        Ok(interval)
    } else {
        Err("an interval must be greater than 0".into())
    }
}

/// Parses a positive number.
fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err("expected a number greater than 0".into())
    }
}

/// Parses a limit of steps.
fn steps(text: &str) -> Result<usize, String> {
    // `1e8` is accepted as an integer.
    let steps = number(text)?;
    if (1.0..=1e15).contains(&steps) && steps.fract() == 0.0 {
        Ok(steps as usize)
    } else {
        Err("expected a whole number from 1 to 1e15".into())
    }
}

/// Parses a count.
pub fn count(text: &str) -> Result<u64, String> {
    let count = number(text)?;
    if (1.0..=(1u64 << 40) as f64).contains(&count) && count.fract() == 0.0 {
        Ok(count as u64)
    } else {
        Err("expected a whole number from 1 to 2^40".into())
    }
}

/// Parses a finite number, or a product or quotient of numbers and `pi`: `50*pi`, `-pi/2`.
pub fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let value = product(text)
        .ok_or_else(|| format!("`{text}` is not a number (as in 2.5, 1e-3, 50*pi, -pi/2)"))?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(format!("`{text}` is not a finite number"))
    }
}

fn product(text: &str) -> Option<f64> {
    let (sign, mut rest) = match text.strip_prefix('-') {
        Some(rest) if rest.starts_with('-') => return None,
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let mut value = sign;
    let mut divide = false;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let factor = match rest.get(..end)?.trim() {
            "pi" => std::f64::consts::PI,
            other => other.parse().ok()?,
        };
        value = if divide {
            value / factor
        } else {
            value * factor
        };
        match rest.get(end..).and_then(|rest| rest.chars().next()) {
            None => return Some(value),
            Some(operator) => divide = operator == '/',
        }
        rest = rest.get(end + 1..)?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_may_hold_pi() {
        let pi = std::f64::consts::PI;
        assert_eq!(number("50*pi"), Ok(50.0 * pi));
        assert_eq!(number("-pi/2"), Ok(-pi / 2.0));
        assert_eq!(number("2*pi/3"), Ok(2.0 * pi / 3.0));
        assert_eq!(number("1e-3"), Ok(1e-3));
        for text in [
            "",
            "2*",
            "two",
            "nan",
            "inf",
            "-inf",
            "1e999",
            "1/0",
            "0/0",
            "1e300*1e300",
            "--1",
        ] {
            assert!(number(text).is_err(), "{text}");
        }
    }

    #[test]
    fn settings_that_make_no_sense_are_refused() {
        assert_eq!(tolerance("1e-9"), Ok(1e-9));
        assert_eq!(tolerance("2.3e-15"), Ok(2.3e-15));
        for text in ["0", "-1e-9", "1", "2", "1e-15", "1e-300", "nan"] {
            assert!(tolerance(text).is_err(), "{text}");
        }
        assert_eq!(interval("0.001"), Ok(0.001));
        for text in ["0", "-0", "-1", "inf", "nan"] {
            assert!(interval(text).is_err(), "{text}");
        }
        assert_eq!(steps("1e8"), Ok(100_000_000));
        for text in ["0", "-1", "1.5", "1e16", "nan"] {
            assert!(steps(text).is_err(), "{text}");
        }
    }

    fn checked(arguments: &[&str]) -> Result<(), String> {
        let call = Call::try_parse_from([&["lagrangian"], arguments].concat());
        call.map_err(|error| error.to_string())?.check()
    }

    #[test]
    fn what_is_said_twice_is_an_error() {
        let until = ["simulate", "a.machine", "--until", "1"];
        for (first, second) in [
            (["--set", "m=1"], ["--set", "m=2"]),
            (["--set", "m=1"], ["--set", " m =1"]),
            (["--const", "N=3"], ["--const", "N=4"]),
            (["--start", "q[2]=3"], ["--start", "q[2]=4"]),
            (["--rate", "q=3"], ["--rate", "q=4"]),
            (["--out", "a.csv"], ["--out", "b.csv"]),
            (["--tolerance", "1e-6"], ["--tolerance", "1e-7"]),
            (["--max-steps", "6"], ["--max-steps", "7"]),
        ] {
            let once = [&until[..], &first].concat();
            assert_eq!(checked(&once), Ok(()), "{first:?}");
            let twice = [&once[..], &second].concat();
            assert!(checked(&twice).is_err(), "{first:?} {second:?}");
        }
        // A coordinate and its rate are different, and so are a family and a member.
        let both = ["--start", "q=1", "--rate", "q=2", "--start", "q[2]=3"];
        assert_eq!(checked(&[&until[..], &both].concat()), Ok(()));
        let steady = ["modes", "a.machine", "--steady", "a=1", "--steady", "a"];
        assert!(checked(&steady).is_err());
        for option in ["--from", "--to"] {
            let call = ["brachistochrone", "a.machine", option, "a=1,b=2,a=3"];
            assert!(checked(&call).is_err());
        }
        let library = ["library", "a.machine", "--out", "a.so", "--lanes", "2,4,2"];
        assert!(checked(&library).is_err());
    }

    #[test]
    fn a_comma_between_brackets_is_part_of_a_name() {
        let list = |text: &str| names(text).map(|Names(names)| names);
        let three = ["q", "der(q,2)", "'assume(max(a, b) > 0)'"].map(str::to_owned);
        assert_eq!(
            list("q, der(q,2),'assume(max(a, b) > 0)'"),
            Ok(three.to_vec())
        );
        assert!(list("q,,v").is_err());
    }

    #[test]
    fn an_assignment_has_a_name() {
        assert_eq!(
            assignment("q[3]=0.5"),
            Ok(Assignment {
                name: "q[3]".into(),
                value: "0.5".into()
            })
        );
        assert!(assignment("q= ").is_err());
        assert!(assignment("omega").is_err());
        assert!(assignment("=3").is_err());
    }

    /// Values by the definitions of the units; `None` is an error whose message contains these words.
    #[test]
    fn a_value_has_the_unit_of_its_name() {
        use std::f64::consts::{PI, TAU};
        let value = |text: &str, unit: &str| {
            let set = assignment(&format!("w={text}")).expect("an assignment");
            set.value("--set", unit)
        };
        for (text, unit, known) in [
            ("1500*rpm", "rad/s", 50.0 * PI),
            ("30*deg", "rad", PI / 6.0),
            ("-30*deg", "rad", -PI / 6.0),
            ("2*rev", "rad", 2.0 * TAU),
            ("3*cm", "mm", 30.0),
            ("36*km/h", "m/s", 10.0),
            ("90*deg/s", "rad/s", PI / 2.0),
            ("1500*rpm", "rpm", 1500.0),
            ("50*pi", "rad/s", 50.0 * PI),
            ("2*(1 + sqrt(4))", "m", 6.0),
            ("2.5e-3", "kg*m^2/s^2", 2.5e-3),
            ("1_000", "1", 1000.0),
        ] {
            let found = value(text, unit);
            let error = found.as_ref().map(|found| (found - known).abs());
            assert!(
                error.is_ok_and(|error| error <= 1e-15 * known.abs()),
                "{text}: {found:?}"
            );
        }
        for (text, unit, words) in [
            ("3*m", "rad/s", "--set w=3*m: expected rad/s, found m"),
            ("5*Hz", "rad/s", "expected rad/s, found Hz"),
            ("3*mm", "1", "found m"),
            ("two", "m", "nothing is named `two`"),
            ("t", "s", "cannot depend on time"),
            ("1/0", "m", "zero"),
            ("1e999", "m", "number"),
            ("nan", "m", "nothing is named `nan`"),
            ("inf", "m", "nothing is named `inf`"),
            ("2*", "m", "expected"),
            ("30 deg", "rad", "30*deg"),
            ("--", "m", "expected"),
            ("1 } bodies {", "m", "expected"),
            ("(1, 2)", "m", "a number is expected here"),
            ("1500*rmp", "rad/s", "did you mean the unit `rpm`?"),
        ] {
            let found = value(text, unit).expect_err(text);
            assert!(found.contains(words), "{text}: {found}");
        }
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Call::command().debug_assert();
    }
}
