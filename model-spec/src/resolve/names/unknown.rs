//! Names that are not declared, with help from those that are.

use super::{NO_BRANCHES, Namespace};
use crate::diagnostic::{Code, Diagnostic, most_similar};
use crate::resolve::Resolver;
use crate::syntax::{Form, Ident, SectionKind};
use crate::unit::Measure;

/// The largest number of names that a help line lists.
const LISTED: usize = 12;

/// The largest number of names that are compared with an unknown one.
const COMPARED: usize = 1000;

impl<'a> Resolver<'a, '_, '_> {
    /// Reports a name that is not declared.
    pub(in crate::resolve) fn unknown_name(
        &mut self,
        noun: &str,
        name: &'a Ident,
        namespaces: &[Namespace],
    ) {
        if self.incomplete || name.text.is_empty() {
            return;
        }
        let is_formula = |section: &SectionKind| match section {
            SectionKind::Element(section) => matches!(section.form, Form::Expressions),
            section => *section == SectionKind::Outputs,
        };
        let mut formulas = self.language.sections.iter().copied().filter(is_formula);
        let elsewhere = formulas.find(|&section| {
            let group = self.find_group(Namespace::of(section), &name.text);
            group.is_some()
        });
        let candidates = self
            .groups
            .iter()
            .filter(|group| namespaces.contains(&group.namespace))
            .map(|group| group.base);
        let habit = if namespaces.contains(&Namespace::Values) {
            self.foreign_word_help(&name.text)
        } else {
            None
        };
        let help = match elsewhere {
            _ if self.report.omitted() > 0 => None, // the message will be omitted anyway
            _ if habit.is_some() => habit,
            Some(section) if namespaces.contains(&Namespace::Values) => Some(format!(
                "`{}` is {}, which formulas cannot use: put what they share under `define`",
                name.text,
                section.item()
            )),
            _ => {
                let word = name.text.as_str();
                let is_value = namespaces.contains(&Namespace::Values);
                let unit = Measure::named(word).filter(|_| is_value && word.len() > 1);
                let candidates: Vec<&str> = candidates.take(COMPARED).collect();
                let near = most_similar(word, candidates.iter().copied());
                match (unit, near) {
                    (Some(_), Some(near)) => Some(format!(
                        "did you mean `{near}`? `{word}` is a unit too: it is written after a number, `2*{word}`"
                    )),
                    (Some(_), None) => Some(format!(
                        "`{word}` is a unit: it is written after a number, `2*{word}`"
                    )),
                    // A single letter is more often a name than a unit.
                    (None, None) if is_value && Measure::named(word).is_some() => {
                        let as_unit =
                            format!("the unit `{word}` is written after a number, `2*{word}`");
                        Some(match suggestion(word, candidates) {
                            Some(names) => format!("{names}; {as_unit}"),
                            None => as_unit,
                        })
                    }
                    (None, _) if is_value => with_unit(word, suggestion(word, candidates)),
                    (None, _) => suggestion(word, candidates),
                }
            }
        };
        let message = format!("{noun} named `{}`", name.text);
        self.push(with_help(
            Diagnostic::new(Code::UnknownName, name.span, message),
            help,
        ));
    }

    /// The help for a word that is common in other languages.
    fn foreign_word_help(&self, word: &str) -> Option<String> {
        let is_coordinate = |base: &str| {
            let mut declarations = self.declarations.iter();
            declarations.any(|declaration| {
                declaration.section == SectionKind::Coordinates
                    && declaration.name.base.text == base
            })
        };
        let twice = ["_ddot", "ddot", "dotdot", "_dotdot"];
        let ends = twice.map(|end| (end, 2)).into_iter();
        for (end, order) in ends.chain([("_dot", 1), ("dot", 1)]) {
            let base = word.strip_suffix(end);
            if let Some(base) = base.filter(|base| is_coordinate(base)) {
                return Some(match order {
                    1 => format!("the rate of `{base}` is `der({base})`"),
                    _ => format!("the acceleration of `{base}` is `der(der({base}))`"),
                });
            }
        }
        match word {
            "time" => Some("the time is `t`".to_owned()),
            "PI" | "Pi" | "π" => Some("the number π is `pi`".to_owned()),
            "if" | "else" | "then" | "where" => Some(NO_BRANCHES.to_owned()),
            _ => None,
        }
    }
}

/// The help line for an unknown word: the most similar word, or all possible ones if there are few.
pub(in crate::resolve) fn suggestion<'n>(
    word: &str,
    candidates: impl IntoIterator<Item = &'n str>,
) -> Option<String> {
    let mut names: Vec<&str> = candidates.into_iter().take(COMPARED).collect();
    let mut seen = std::collections::BTreeSet::new();
    names.retain(|name| seen.insert(*name));
    if let Some(near) = most_similar(word, names.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    match names.len() {
        0 => None,
        1..=LISTED => Some(format!("declared here: `{}`", names.join("`, `"))),
        _ => None,
    }
}

/// The help for an unknown word that may also have been a unit: `degs` is near `deg`.
fn with_unit(word: &str, help: Option<String>) -> Option<String> {
    let unit = match word.chars().count() {
        // One different letter out of two is no similarity.
        0..=2 => None,
        _ => most_similar(word, Measure::names()),
    };
    match (unit, help) {
        (Some(unit), Some(help)) => Some(format!(
            "{}, or the unit `{unit}`? A unit is written after a number: `2*{unit}`",
            help.trim_end_matches('?')
        )),
        (Some(unit), None) => Some(format!(
            "did you mean the unit `{unit}`? It is written after a number: `2*{unit}`"
        )),
        (None, help) => help,
    }
}

/// A message with a help line, if there is one.
pub(in crate::resolve) fn with_help(diagnostic: Diagnostic, help: Option<String>) -> Diagnostic {
    match help {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}
