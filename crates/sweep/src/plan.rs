//! The plan of a sweep: everything on which its rows depend, as a value that can be serialized.

use std::ops::Range;

use lagrangian::{Extrapolation, Interpolation};
use lagrangian_mechanics::series::SeriesText;
use lagrangian_spec::source::{Files, ReadTexts};
use lagrangian_symbolic::Rational;
use serde::{Deserialize, Serialize};

use crate::design::{self, Factor};

/// The version of the format.
pub const VERSION: u32 = 1;

/// The name of the method where each run chooses its methods.
pub const AUTO: &str = "auto";

/// The longest chunk, in runs.
pub const LONGEST_CHUNK: u64 = 65_536;

/// A machine, how to run it, which runs to make, and what to record of them. Row i of a sweep depends on
/// this and on i alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The version of the format.
    pub version: u32,
    /// The spec of the machine.
    pub spec: SpecText,
    /// Parameters and inputs that are the same in every run, in the units that the spec declares.
    pub set: Vec<(String, f64)>,
    /// Coordinates at the start.
    pub start: Vec<(String, f64)>,
    /// Rates at the start.
    pub rate: Vec<(String, f64)>,
    /// Numbers of the start that the projection onto the constraints keeps; those of the spec where this is `None`.
    pub keep: Option<Vec<String>>,
    /// The end of a run, in s.
    pub until: f64,
    /// Relative and absolute tolerance of each step.
    pub tolerance: f64,
    /// The method of integration; [`AUTO`] if each run chooses its methods, as one of all runs of the plan, which share the derivation of a series.
    pub method: String,
    /// The most steps of a run.
    pub max_steps: u64,
    /// The laws that drive inputs during a run.
    pub inputs: Vec<(String, Law)>,
    /// The functions whose zeros are events.
    pub events: Vec<Watch>,
    /// Instants at which states are recorded, in s.
    pub at: Vec<f64>,
    /// The interval at which samples are recorded, in s.
    pub every: Option<f64>,
    /// Events, by name, at which samples are recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at_events: Vec<String>,
    /// The reductions of each motion to a number.
    pub reduce: Vec<Reduction>,
    /// The start of reductions, in s; from the start of the run where this is `None`.
    pub after: Option<f64>,
    /// The design: all combinations of these factors, the last one varying fastest.
    pub design: Vec<Factor>,
    /// The number of runs in a chunk.
    pub chunk: u64,
}

/// A spec with everything from which it is made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpecText {
    /// Its name in messages, to which paths in it are relative.
    pub name: String,
    /// The text.
    pub text: String,
    /// The texts that it extends or reads.
    pub files: Vec<ReadFile>,
    /// Values of constants.
    pub constants: Vec<(String, String)>,
    /// Parameters that are given values although the spec has formulas for them. Those that the plan itself sets
    /// need not be listed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given: Vec<String>,
}

/// A file that a spec names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReadFile {
    /// The path as written in the spec.
    pub path: String,
    /// The file that names it.
    pub from: Option<String>,
    /// The resolved name of the file.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The law of an input during a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Law {
    /// An expression of the spec's language in time and state.
    Formula(String),
    /// A formula that is evaluated at the start and once in each period; its value takes effect after a delay and
    /// holds until the next one.
    Sampled {
        /// The expression.
        formula: String,
        /// The sampling period, in s.
        every: f64,
        /// The delay after a sample until its value takes effect, in s.
        #[serde(default)]
        delay: f64,
    },
    /// Values at times.
    Table {
        /// Times, in s, each greater than the one before it.
        times: Vec<f64>,
        /// The value at each, in the unit of the input.
        values: Vec<f64>,
        /// The interpolation between the times; linear by default.
        #[serde(default)]
        between: Interpolation,
        /// The extrapolation before the first and after the last time; constant by default.
        #[serde(default)]
        beyond: Extrapolation,
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

/// A reduction of a motion to one number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reduction {
    /// The name of its column.
    pub name: String,
    /// The function applied.
    pub function: Function,
    /// The expression, event or contact to which it is applied.
    pub of: String,
}

/// The reductions of an expression along a motion, of an event, or of a contact.
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
    /// How often an event occurs.
    Count,
    /// The time of the first occurrence of an event.
    FirstEvent,
    /// The time of the last occurrence of an event.
    LastEvent,
    /// The number of occurrences of an event per second.
    Frequency,
    /// The mean power that a unilateral contact dissipates by impacts, friction, damping and crushing.
    Power,
}

impl Function {
    /// Their names. `first` and `last` apply to an event if their argument names one.
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

    /// Whether it applies to an event.
    pub fn is_of_event(self) -> bool {
        matches!(
            self,
            Function::Count | Function::FirstEvent | Function::LastEvent | Function::Frequency
        )
    }

    /// Whether it applies to an expression along the motion, not to an event or a contact.
    pub(crate) fn is_of_formula(self) -> bool {
        !self.is_of_event() && self != Function::Power
    }
}

impl Plan {
    /// One run of a spec from its own start until an instant, in s, with the defaults of the command: by the methods that each run chooses ([`AUTO`]), with a tolerance
    /// of 1e-9, recording the end only.
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
            method: AUTO.into(),
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

    /// The names of parameters and inputs to which it gives values: such a parameter does not follow from others.
    pub(crate) fn given(&self) -> Vec<String> {
        let set = self.set.iter().map(|(name, _)| name.as_str());
        let varied = self.design.iter().flat_map(Factor::names);
        set.chain(varied).map(str::to_owned).collect()
    }

    /// The number of runs.
    pub fn runs(&self) -> u64 {
        design::runs(&self.design).unwrap_or(0)
    }

    /// The number of chunks.
    pub fn chunks(&self) -> u64 {
        self.runs().div_ceil(self.chunk.max(1))
    }

    /// The range of runs of a chunk.
    pub fn runs_of(&self, chunk: u64) -> Range<u64> {
        let runs = self.runs();
        let at = |chunk: u64| chunk.saturating_mul(self.chunk).min(runs);
        at(chunk)..at(chunk.saturating_add(1))
    }

    /// Whether there are samples besides the rows.
    pub fn has_samples(&self) -> bool {
        self.every.is_some() || !self.at_events.is_empty()
    }

    /// The varied names, in the order of the columns.
    pub fn varied(&self) -> Vec<&str> {
        self.design.iter().flat_map(Factor::names).collect()
    }

    /// The plan as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// Reads a plan from JSON.
    ///
    /// # Errors
    /// If the text is not a valid plan: what is wrong with it.
    pub fn from_json(text: &str) -> Result<Plan, String> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| error.to_string())?;
        let version = value.get("version").and_then(serde_json::Value::as_u64);
        if version.is_some_and(|version| version != u64::from(VERSION)) {
            return Err(format!("the version of its format is not {VERSION}"));
        }
        let plan: Plan = serde_json::from_value(value).map_err(|error| error.to_string())?;
        match plan.chunk {
            1..=LONGEST_CHUNK => Ok(plan),
            chunk => Err(format!(
                "a chunk has from 1 to {LONGEST_CHUNK} runs, not {chunk}"
            )),
        }
    }

    /// How another plan differs, as sentences; the length of chunks does not count.
    pub fn differences(&self, was: &Plan) -> Vec<String> {
        let value = |plan: &Plan| serde_json::to_value(plan).unwrap_or_default();
        let (now, was) = (value(self), value(was));
        let Some(fields) = now.as_object() else {
            return Vec::new();
        };
        let other = fields
            .iter()
            .filter(|(name, value)| *name != "chunk" && was.get(name.as_str()) != Some(value));
        let differences = other.map(|(name, value)| {
            let before = was.get(name).cloned().unwrap_or_default();
            let [value, before] = [value, &before].map(ToString::to_string);
            match name.as_str() {
                "spec" => "the spec is different".to_owned(),
                _ if value.len() + before.len() > 200 => format!("{name} is different"),
                _ => format!("{name}: {value}, was {before}"),
            }
        });
        differences.collect()
    }
}

impl SpecText {
    /// What the series of its machine is derived from, or of that in the other charts of the spec.
    ///
    /// # Errors
    /// As for [`constants`](Self::constants).
    pub fn of_series(&self, in_charts: bool) -> Result<SeriesText, String> {
        let mut files = ReadTexts::default();
        for file in &self.files {
            let read = (file.name.clone(), file.text.clone());
            files.insert((&file.path, file.from.as_deref()), read);
        }
        Ok(SeriesText {
            name: self.name.clone(),
            text: self.text.clone(),
            constants: self.constants()?,
            given: self.given.clone(),
            files,
            in_charts,
        })
    }

    /// The values of its constants.
    ///
    /// # Errors
    /// If a value is not a number: which one.
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

/// A file system of recorded files, instead of the files on disk.
#[derive(Clone, Copy, Debug)]
pub struct RecordedFiles<'a>(pub &'a [ReadFile]);

impl Files for RecordedFiles<'_> {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let found = self
            .0
            .iter()
            .find(|file| file.path == path && file.from.as_deref() == from);
        let found = found.ok_or_else(|| "it is not in the plan".to_owned())?;
        Ok((found.name.clone(), found.text.clone()))
    }
}

/// A file system that records what is read from it.
pub struct FileRecorder<'a> {
    files: &'a mut dyn Files,
    /// The files read so far.
    pub read: Vec<ReadFile>,
}

impl<'a> FileRecorder<'a> {
    /// A recorder that has read nothing yet.
    pub fn new(files: &'a mut dyn Files) -> Self {
        FileRecorder {
            files,
            read: Vec::new(),
        }
    }
}

impl Files for FileRecorder<'_> {
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
