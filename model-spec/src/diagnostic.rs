//! Diagnostics: messages about errors in a spec, which tell a mechanic what to change.
//!
//! A message marks the smallest culprit, says what was expected and what was found, and ends with a
//! help line. Every kind of message has a [`Code`] that stays the same across versions.

use std::collections::BTreeSet;

use crate::source::{SourceId, Span};
use lagrangian_symbolic::sorting::sort_by_key;

mod render;

/// The largest number of messages that one report keeps.
///
/// Nobody reads more, and a file that is not a spec at all would give one for each of its characters.
pub const REPORT_LIMIT: usize = 256;

macro_rules! codes {
    ($($(#[$doc:meta])+ $code:ident => $text:literal,)+) => {
        /// The kinds of messages. Their texts are stable: scripts and tests may rely on them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code { $($(#[$doc])+ $code,)+ }

        impl Code {
            /// Every code, in the order of the stages that report them.
            pub const ALL: &[Code] = &[$(Code::$code,)+];

            /// The code as it is printed: `unknown-name`.
            pub fn as_str(self) -> &'static str {
                match self { $(Code::$code => $text,)+ }
            }
        }
    };
}

codes! {
    // Files.
    /// The text is larger than any spec.
    SourceTooLarge => "source-too-large",
    /// A file that `extends` names cannot be read.
    UnreadableFile => "unreadable-file",

    // Characters.
    /// A character with which no token begins.
    UnknownCharacter => "unknown-character",
    /// A string, a comment or a quoted character that does not end.
    Unterminated => "unterminated",
    /// A number in a notation that the language does not have: `0x1F`, `1.5f32`.
    MalformedNumber => "malformed-number",
    /// A number beyond what a floating-point number can hold.
    NumberOutOfRange => "number-out-of-range",
    /// A string with an escape that does not exist.
    MalformedText => "malformed-text",

    // Grammar.
    /// A bracket without its partner.
    UnbalancedBracket => "unbalanced-bracket",
    /// A token other than the expected one.
    UnexpectedToken => "unexpected-token",
    /// Brackets or operators nested deeper than any formula.
    NestedTooDeeply => "nested-too-deeply",
    /// The source contains no machine.
    NoMachine => "no-machine",
    /// A machine without content.
    EmptyMachine => "empty-machine",
    /// More than one machine in one source.
    SecondMachine => "second-machine",
    /// A machine without `in plane` or `in space`.
    MissingSpace => "missing-space",
    /// A repeated part of a machine: a field, `gravity`, `in plane`.
    SaidTwice => "said-twice",
    /// A section that the language does not have.
    UnknownSection => "unknown-section",
    /// A field that this kind of item does not have.
    UnknownField => "unknown-field",
    /// A unit that the language does not have.
    UnknownUnit => "unknown-unit",
    /// An approximation other than `frozen` and `small`.
    UnknownApproximation => "unknown-approximation",
    /// A published quantity that the language does not have.
    UnknownQuantity => "unknown-quantity",
    /// A quantity without its unit.
    MissingUnit => "missing-unit",
    /// An item without the expression that it needs.
    MissingValue => "missing-value",
    /// `remove` in a machine that extends nothing.
    NothingToRemove => "nothing-to-remove",
    /// A family where a single thing is needed, or an index where none is allowed.
    MisplacedIndex => "misplaced-index",

    // Variants.
    /// A file that extends itself, directly or through others.
    ExtendsItself => "extends-itself",
    /// A chain of variants that is too long.
    ExtendsTooDeep => "extends-too-deep",
    /// A variant in the plane with a base in space, or the other way round.
    SpaceChanged => "space-changed",

    // Names.
    /// A name that is not declared.
    UnknownName => "unknown-name",
    /// A point that a frame or a body does not have.
    UnknownPoint => "unknown-point",
    /// A function, or an operation on a frame, that the language does not have.
    UnknownFunction => "unknown-function",
    /// A name that is declared twice.
    DuplicateName => "duplicate-name",
    /// A name that has another meaning already, or that is not allowed as a Rust field.
    ReservedName => "reserved-name",
    /// A name of a machine that is not allowed as a Rust type.
    MachineName => "machine-name",
    /// A definition that needs itself.
    CircularDefinition => "circular-definition",

    // Families.
    /// A family where one of its members is needed.
    MissingIndex => "missing-index",
    /// An index on a name that is not a family.
    NotAFamily => "not-a-family",
    /// An index that is not an integer.
    IndexNotWhole => "index-not-whole",
    /// An index that no member of the family has.
    IndexOutOfRange => "index-out-of-range",
    /// More members, or longer formulas, than are allowed.
    TooLarge => "too-large",

    // Kinds of values.
    /// A value of the wrong kind: a number instead of a vector, or a frame instead of a number.
    WrongKind => "wrong-kind",
    /// A vector with too few or too many components.
    WrongDimension => "wrong-dimension",
    /// A function with too few or too many arguments.
    WrongArguments => "wrong-arguments",
    /// Something that exists only in the plane, used in space, or the other way round.
    WrongSpace => "wrong-space",
    /// A body that is used as a frame without having one.
    NoFrame => "no-frame",

    // Units.
    /// Two units that should be equal.
    UnitMismatch => "unit-mismatch",
    /// A power whose unit cannot be determined.
    UnitOfPower => "unit-of-power",
    /// A coordinate that is not declared in an SI unit.
    UnitOfState => "unit-of-state",

    // Numbers.
    /// A division by zero.
    DivisionByZero => "division-by-zero",
    /// A root, a logarithm or an inverse function outside its domain.
    OutsideDomain => "outside-domain",
    /// A mass, an inertia or a radius that is not positive.
    NotPositive => "not-positive",
    /// An assumption that never holds.
    FalseAssumption => "false-assumption",

    // Dependencies.
    /// A mass or an inertia that varies along the motion.
    VariableMass => "variable-mass",
    /// A quantity that depends on something that is not allowed here.
    ForbiddenDependence => "forbidden-dependence",
    /// A derivative that does not exist: of an input, of an acceleration.
    CannotDifferentiate => "cannot-differentiate",
    /// A constraint that is not linear in the velocities.
    NotLinear => "not-linear",

    // Items.
    /// An item without a field that it needs.
    MissingField => "missing-field",
    /// Conflicting fields.
    ConflictingFields => "conflicting-fields",
    /// A body whose orientation is not given.
    MissingRotation => "missing-rotation",
    /// A machine without a body.
    NoBodies => "no-bodies",
    /// A machine without a coordinate.
    NoCoordinates => "no-coordinates",

    // Derivation.
    /// Something that the language has but that cannot be derived yet.
    NotSupported => "not-supported",
    /// A coordinate that moves no mass.
    NoInertia => "no-inertia",
    /// A sliding body that its guide does not hold, or that something else holds too.
    NoGuide => "no-guide",
    /// A body that moves with a guided body without being tied to it by anything that the spec names.
    Untied => "untied",
    /// A small coordinate about whose zero an energy has no expansion.
    NoExpansion => "no-expansion",
    /// An energy or an equation that has no value anywhere.
    Undefined => "undefined",
    /// A program that disagrees with Lagrange's equations: a bug of the compiler.
    Internal => "internal-error",

    // Warnings.
    /// A declaration that nothing uses.
    Unused => "unused",
    /// An angle that looks like degrees where radians are expected.
    LooksLikeDegrees => "looks-like-degrees",
    /// A machine with hanging bodies and without gravity.
    NoGravity => "no-gravity",
    /// A spring that pushes away, or a damper that drives.
    NegativeCoefficient => "negative-coefficient",
    /// A tensor of inertia that no body has.
    ImpossibleInertia => "impossible-inertia",
    /// Constraints that contradict each other at the start.
    Contradiction => "contradiction",
}

/// The severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The spec is wrong, and no machine results.
    Error,
    /// The spec is valid, but perhaps not what was intended.
    Warning,
}

impl Severity {
    /// `error` or `warning`.
    pub fn as_str(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

impl Code {
    /// The severity of messages of this kind.
    pub fn severity(self) -> Severity {
        match self {
            Code::Unused
            | Code::LooksLikeDegrees
            | Code::NoGravity
            | Code::NegativeCoefficient
            | Code::ImpossibleInertia
            | Code::Contradiction => Severity::Warning,
            _ => Severity::Error,
        }
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}

/// One message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The kind of error.
    pub code: Code,
    /// What is wrong: expected and found.
    pub message: String,
    /// What to change.
    pub help: Option<String>,
    /// The smallest stretch of the text that is wrong.
    pub span: Span,
    /// Other places that explain it.
    pub notes: Vec<(Span, String)>,
}

impl Diagnostic {
    /// A message without help and notes.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            message: message.into(),
            help: None,
            span,
            notes: Vec::new(),
        }
    }

    /// Adds a help line.
    pub fn help(mut self, help: impl Into<String>) -> Diagnostic {
        self.help = Some(help.into());
        self
    }

    /// Adds another place that explains it.
    pub fn note(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.notes.push((span, text.into()));
        self
    }
}

/// All errors and warnings of a spec.
#[derive(Clone, Debug, Default)]
pub struct Report {
    diagnostics: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
    /// The messages that were reported already: the members of a family all have the same error at
    /// the same place.
    reported: BTreeSet<(Span, Code, String)>,
    omitted: usize,
}

impl Report {
    /// A report without messages.
    pub fn new() -> Report {
        Report::default()
    }

    /// Adds a message, unless it is there already or [`REPORT_LIMIT`] is reached.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let key = (diagnostic.span, diagnostic.code, diagnostic.message.clone());
        if self.reported.contains(&key) {
            return;
        }
        let is_error = diagnostic.code.severity() == Severity::Error;
        let list = if is_error {
            &mut self.diagnostics
        } else {
            &mut self.warnings
        };
        if list.len() >= REPORT_LIMIT {
            self.omitted += usize::from(is_error);
            return;
        }
        self.reported.insert(key);
        list.push(diagnostic);
    }

    /// Whether there are any errors; warnings do not count.
    pub fn has_errors(&self) -> bool {
        !self.diagnostics.is_empty()
    }

    /// Whether an error of this kind was found in this text.
    pub fn has(&self, source: SourceId, code: Code) -> bool {
        let mut list = self.diagnostics.iter();
        list.any(|diagnostic| diagnostic.code == code && diagnostic.span.source == source)
    }

    /// The errors by position: file after file, from top to bottom.
    pub fn diagnostics(&self) -> Vec<&Diagnostic> {
        by_position(&self.diagnostics)
    }

    /// The warnings by position. A valid spec may have some.
    pub fn warnings(&self) -> Vec<&Diagnostic> {
        by_position(&self.warnings)
    }

    /// Errors and warnings by position.
    pub fn messages(&self) -> Vec<&Diagnostic> {
        by_position(self.diagnostics.iter().chain(&self.warnings))
    }

    /// The number of errors that were omitted because of [`REPORT_LIMIT`].
    pub fn omitted(&self) -> usize {
        self.omitted
    }
}

fn by_position<'a>(list: impl IntoIterator<Item = &'a Diagnostic>) -> Vec<&'a Diagnostic> {
    let mut list: Vec<&Diagnostic> = list.into_iter().collect();
    sort_by_key(&mut list, |diagnostic| (diagnostic.span, diagnostic.code));
    list
}

/// The candidate that is most similar to `name`, if one is similar enough.
///
/// Similar means equal except for case, or at most one slip in three characters, where a slip is a
/// missing, extra or wrong letter, or two neighbouring letters exchanged. In case of a tie the first wins.
pub fn most_similar<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    /// Longer names are not compared, since the work is the product of the lengths.
    const LONGEST: usize = 64;
    let letters: Vec<char> = name
        .chars()
        .flat_map(char::to_lowercase)
        .take(LONGEST + 1)
        .collect();
    if letters.len() > LONGEST {
        return None;
    }
    let allowed = (letters.len() / 3).max(1);
    let mut best: Option<(usize, &'a str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate
            .chars()
            .flat_map(char::to_lowercase)
            .take(LONGEST + 1)
            .collect();
        if other.len() > LONGEST || letters.len().abs_diff(other.len()) > allowed {
            continue;
        }
        let slips = edit_distance(&letters, &other);
        // A single letter is one slip away from every other letter, which means nothing.
        let tells = slips == 0 || letters.len() > 1 || other.len() > 1;
        let better = best.is_none_or(|(least, _)| slips < least);
        if slips <= allowed && tells && better && candidate != name {
            best = Some((slips, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The number of slips between two words (optimal string alignment distance).
///
/// F. J. Damerau, *A technique for computer detection and correction of spelling errors*,
/// Comm. ACM 7 (1964) 171–176.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let replaced = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

/// A list for a sentence: `a`, `b` or `c`, each in backquotes.
pub fn one_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_distinct_kebab_case() {
        let texts: BTreeSet<&str> = Code::ALL.iter().map(|code| code.as_str()).collect();
        assert_eq!(texts.len(), Code::ALL.len());
        for text in texts {
            assert!(
                text.chars().all(|c| c.is_ascii_lowercase() || c == '-'),
                "{text}"
            );
        }
    }

    #[test]
    fn a_near_miss_is_found() {
        let names = ["stiffness", "stretch", "from", "to", "length"];
        assert_eq!(most_similar("stifness", names), Some("stiffness"));
        assert_eq!(most_similar("strecth", names), Some("stretch"));
        assert_eq!(most_similar("Length", names), Some("length"));
        assert_eq!(most_similar("form", names), Some("from"));
        assert_eq!(most_similar("mass", names), None);
        assert_eq!(most_similar("x", ["y", "z"]), None);
        assert_eq!(most_similar("M", ["m"]), Some("m"));
        assert_eq!(most_similar("m1", ["m0", "J"]), Some("m0"));
    }

    #[test]
    fn the_same_mistake_is_reported_once() {
        let mut report = Report::new();
        for _ in 0..3 {
            report.push(Diagnostic::new(
                Code::UnknownUnit,
                Span::default(),
                "no unit `q`",
            ));
        }
        assert_eq!(report.diagnostics().len(), 1);
    }

    #[test]
    fn a_report_stays_readable() {
        let mut report = Report::new();
        for at in 0..1000 {
            let span = Span {
                start: at,
                end: at + 1,
                ..Span::default()
            };
            report.push(Diagnostic::new(Code::UnknownCharacter, span, "no"));
        }
        assert_eq!(report.diagnostics().len(), REPORT_LIMIT);
        assert_eq!(report.omitted(), 1000 - REPORT_LIMIT);
    }

    #[test]
    fn lists_read_like_a_sentence() {
        assert_eq!(one_of(["a"]), "`a`");
        assert_eq!(one_of(["a", "b", "c"]), "`a`, `b` or `c`");
    }
}
