//! The plan of a sweep: everything that its rows depend on, as a value that can be written down.

use std::ops::Range;

use lagrangian::{Between, Beyond};
use lagrangian_spec::source::Files;
use lagrangian_symbolic::Rational;
use serde::{Deserialize, Serialize};

use crate::design::{self, Factor};

/// The version of the format.
pub const VERSION: u32 = 1;

/// The longest chunk, in runs.
pub const LONGEST_CHUNK: u64 = 65_536;

/// A machine, how it is run, which runs there are, and what is kept of them. Row i of a sweep depends on this and on i alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The version of the format.
    pub version: u32,
    /// The machine.
    pub spec: SpecText,
    /// Parameters and inputs that every run has, in the units that the spec declares.
    pub set: Vec<(String, f64)>,
    /// Coordinates at the start.
    pub start: Vec<(String, f64)>,
    /// Rates at the start.
    pub rate: Vec<(String, f64)>,
    /// Numbers of the start that stay as they are; those that the spec keeps where nothing is said.
    pub keep: Option<Vec<String>>,
    /// The end of a run, in s.
    pub until: f64,
    /// Relative and absolute tolerance of each step.
    pub tolerance: f64,
    /// The method of integration.
    pub method: String,
    /// How many steps a run may take.
    pub max_steps: u64,
    /// What inputs do while the machine runs.
    pub inputs: Vec<(String, Law)>,
    /// What is watched for.
    pub events: Vec<Watch>,
    /// Instants whose states are recorded, in s.
    pub at: Vec<f64>,
    /// The interval at which samples are recorded, in s.
    pub every: Option<f64>,
    /// Events, by name, whose states are samples.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at_events: Vec<String>,
    /// What is made of each motion.
    pub reduce: Vec<Reduction>,
    /// From when on, in s.
    pub after: Option<f64>,
    /// Which runs there are: all combinations of these, the last one fastest.
    pub design: Vec<Factor>,
    /// How many runs a chunk has.
    pub chunk: u64,
}

/// A spec with everything that it is made from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpecText {
    /// What messages call it, and what paths in it are relative to.
    pub name: String,
    /// The text.
    pub text: String,
    /// The texts that it extends.
    pub files: Vec<ReadFile>,
    /// Values of constants.
    pub constants: Vec<(String, String)>,
    /// Parameters that have values of their own, though the spec has formulas for them; a plan knows those that it sets itself.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given: Vec<String>,
}

/// A file that a spec has named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReadFile {
    /// The path as it was written.
    pub path: String,
    /// In which file.
    pub from: Option<String>,
    /// The name by which the file is known.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// What an input does while the machine runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Law {
    /// An expression of the spec's language in time and state.
    Formula(String),
    /// A formula that is evaluated at the start and at a period after it, to act after a delay and to hold until the next.
    Sampled {
        /// The expression.
        formula: String,
        /// The time between two looks, in s.
        every: f64,
        /// How long after a look what is set begins to act, in s.
        #[serde(default)]
        delay: f64,
    },
    /// Values at times.
    Table {
        /// Times, in s, each greater than the one before it.
        times: Vec<f64>,
        /// The value at each, in the unit of the input.
        values: Vec<f64>,
        /// What is between them; straight lines where nothing is said.
        #[serde(default)]
        between: Between,
        /// What is before the first and behind the last; their values where nothing is said.
        #[serde(default)]
        beyond: Beyond,
    },
}

/// A function of time and state whose changes of sign are events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Watch {
    /// Its name.
    pub name: String,
    /// The function.
    pub formula: String,
    /// Whether its first event ends the run.
    pub ends: bool,
}

/// A number made of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reduction {
    /// The name of its column.
    pub name: String,
    /// What is made of the motion.
    pub function: Function,
    /// Of which expression, or of which event.
    pub of: String,
}

/// What can be made of an expression along a motion, or of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "they say what they are")]
pub enum Function {
    Max,
    Min,
    Range,
    Mean,
    Rms,
    Integral,
    First,
    Last,
    WhenMax,
    WhenMin,
    /// How often an event happens.
    Count,
    /// When an event happens first.
    FirstEvent,
    /// When an event happens last.
    LastEvent,
    /// How often an event happens a second.
    Frequency,
    /// What a unilateral contact takes a second, by impacts, friction, damping and crushing.
    Power,
}

impl Function {
    /// Their names; `first` and `last` are of events where an event has the name that stands behind.
    pub const NAMES: [(&'static str, Function); 13] = [
        ("max", Function::Max),
        ("min", Function::Min),
        ("range", Function::Range),
        ("mean", Function::Mean),
        ("rms", Function::Rms),
        ("integral", Function::Integral),
        ("first", Function::First),
        ("last", Function::Last),
        ("when_max", Function::WhenMax),
        ("when_min", Function::WhenMin),
        ("count", Function::Count),
        ("frequency", Function::Frequency),
        ("power", Function::Power),
    ];

    /// Whether it is of an event.
    pub fn is_of_event(self) -> bool {
        matches!(
            self,
            Function::Count | Function::FirstEvent | Function::LastEvent | Function::Frequency
        )
    }

    /// Whether it is of an expression along the motion, and neither of an event nor of a contact.
    pub(crate) fn is_of_formula(self) -> bool {
        !self.is_of_event() && self != Function::Power
    }
}

impl Plan {
    /// One run of a spec until an instant, in s, as its start says, with the settings that the command has where nothing is said:
    /// `dop853` to a tolerance of 1e-9, rows of the end alone.
    pub fn new(spec: SpecText, until: f64) -> Self {
        Plan {
            version: VERSION,
            spec,
            set: Vec::new(),
            start: Vec::new(),
            rate: Vec::new(),
            keep: None,
            until,
            tolerance: 1e-9,
            method: "dop853".into(),
            max_steps: 10_000_000,
            inputs: Vec::new(),
            events: Vec::new(),
            at: Vec::new(),
            every: None,
            at_events: Vec::new(),
            reduce: Vec::new(),
            after: None,
            design: Vec::new(),
            chunk: 1,
        }
    }

    /// The parameters and inputs that it gives values to: none of these parameters follows from others.
    pub(crate) fn given(&self) -> Vec<String> {
        let set = self.set.iter().map(|(name, _)| name.as_str());
        let varied = self.design.iter().flat_map(Factor::names);
        set.chain(varied).map(str::to_owned).collect()
    }

    /// How many runs there are.
    pub fn runs(&self) -> u64 {
        design::runs(&self.design).unwrap_or(0)
    }

    /// How many chunks.
    pub fn chunks(&self) -> u64 {
        self.runs().div_ceil(self.chunk.max(1))
    }

    /// The runs of a chunk.
    pub fn runs_of(&self, chunk: u64) -> Range<u64> {
        let runs = self.runs();
        let at = |chunk: u64| chunk.saturating_mul(self.chunk).min(runs);
        at(chunk)..at(chunk.saturating_add(1))
    }

    /// Whether there are samples beside the rows.
    pub fn has_samples(&self) -> bool {
        self.every.is_some() || !self.at_events.is_empty()
    }

    /// What is varied, in the order of the columns.
    pub fn varied(&self) -> Vec<&str> {
        self.design.iter().flat_map(Factor::names).collect()
    }

    /// The plan as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// A plan from JSON.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn from_json(text: &str) -> Result<Plan, String> {
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| error.to_string())?;
        let version = value.get("version").and_then(serde_json::Value::as_u64);
        if version.is_some_and(|version| version != u64::from(VERSION)) {
            return Err(format!(
                "it is of another version of the format than {VERSION}"
            ));
        }
        let plan: Plan = serde_json::from_value(value).map_err(|error| error.to_string())?;
        match plan.chunk {
            1..=LONGEST_CHUNK => Ok(plan),
            chunk => Err(format!(
                "a chunk has from 1 to {LONGEST_CHUNK} runs, not {chunk}"
            )),
        }
    }

    /// What of another plan differs, as sentences; how the runs are cut into chunks does not matter.
    pub fn differences(&self, was: &Plan) -> Vec<String> {
        let value = |plan: &Plan| serde_json::to_value(plan).unwrap_or_default();
        let (now, was) = (value(self), value(was));
        let Some(fields) = now.as_object() else {
            return Vec::new();
        };
        let other = fields
            .iter()
            .filter(|(name, value)| *name != "chunk" && was.get(name.as_str()) != Some(value));
        let said = other.map(|(name, value)| {
            let before = was.get(name).cloned().unwrap_or_default();
            let [value, before] = [value, &before].map(ToString::to_string);
            match name.as_str() {
                "spec" => "the spec is another one".to_owned(),
                _ if value.len() + before.len() > 200 => format!("{name} is another one"),
                _ => format!("{name}: {value}, was {before}"),
            }
        });
        said.collect()
    }
}

impl SpecText {
    /// The values of its constants.
    ///
    /// # Errors
    /// Which one is no number.
    pub fn constants(&self) -> Result<Vec<(String, Rational)>, String> {
        let constant = |(name, text): &(String, String)| {
            let (sign, digits) = match text.strip_prefix('-') {
                Some(digits) => (-1, digits),
                None => (1, text.as_str()),
            };
            let (above, below) = digits.split_once('/').unwrap_or((digits, "1"));
            let value = Rational::parse_decimal(above).zip(Rational::parse_decimal(below));
            let value = value.and_then(|(above, below)| above.checked_div(&below));
            let value = value.map(|value| &value * &Rational::from(sign));
            let value = value.ok_or_else(|| format!("`{text}` is not a number"))?;
            Ok((name.clone(), value))
        };
        self.constants.iter().map(constant).collect()
    }
}

/// Files as they were read, instead of those that are there now.
#[derive(Clone, Copy, Debug)]
pub struct Kept<'a>(pub &'a [ReadFile]);

impl Files for Kept<'_> {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let found = self
            .0
            .iter()
            .find(|file| file.path == path && file.from.as_deref() == from);
        let found = found.ok_or_else(|| "it is not in the plan".to_owned())?;
        Ok((found.name.clone(), found.text.clone()))
    }
}

/// Files, and what was read of them.
pub struct Recorded<'a> {
    files: &'a mut dyn Files,
    /// What was read.
    pub read: Vec<ReadFile>,
}

impl<'a> Recorded<'a> {
    /// Nothing was read yet.
    pub fn new(files: &'a mut dyn Files) -> Self {
        Recorded {
            files,
            read: Vec::new(),
        }
    }
}

impl Files for Recorded<'_> {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let (name, text) = self.files.read(path, from)?;
        self.read.push(ReadFile {
            path: path.to_owned(),
            from: from.map(str::to_owned),
            name: name.clone(),
            text: text.clone(),
        });
        Ok((name, text))
    }
}
