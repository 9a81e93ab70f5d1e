//! The elements of the language: everything in a machine besides its bodies that contributes to the equations.
//!
//! Each element is one file with all knowledge about it: the syntax of its section, units and stages
//! of its fields, its contributions, its names and drawing, its errors. A new element is one more
//! file and a row of [`ROWS`]. The parser and the resolver receive this list and name none of its
//! entries; after them an element is described by [`element`](crate::model::element), as a few
//! mechanical contributions.

mod actuator;
mod bushing;
pub(crate) mod constraint;
mod damper;
mod dissipation;
mod drag;
mod elastic;
mod energy;
mod force;
mod gravity;
mod loss;
mod potential;
mod rolling;
mod rope;
mod rotor;
mod sliding;
mod spring;
mod stop;
mod torque;
mod torsion_spring;
mod transmission;
mod wheel;

use lagrangian_symbolic::{Dag, Rational};

use crate::diagnostic::Report;
use crate::model::Model;
use crate::resolve::element::Row;
use crate::resolve::formulas::{self, Formula};
use crate::resolve::{self, Language};
use crate::source::{Files, SourceId, Sources};
use crate::syntax::{SectionKind, Spec};
use crate::token::Token;

/// The language of specs.
const LANGUAGE: Language = Language {
    sections: SectionKind::ALL,
    elements: ROWS,
};

/// The sections of elements, in the order in which their items are resolved and listed.
const ROWS: &[Row] = &[
    rotor::ROW,
    spring::ROW,
    torsion_spring::ROW,
    gravity::ROW,
    damper::ROW,
    bushing::ROW,
    stop::ROW,
    potential::ROW,
    dissipation::ROW,
    force::ROW,
    torque::ROW,
    actuator::ROW,
    drag::ROW,
    constraint::ROW,
    transmission::ROW,
    rope::ROW,
    wheel::ROW,
    sliding::ROW,
    rolling::ROW,
    energy::ROW,
    loss::ROW,
];

/// All sections.
const SECTIONS: &[SectionKind] = &sections::<{ ROWS.len() + SectionKind::OF_OTHERS.len() }>();

/// The sections of elements come after the bodies.
const fn sections<const COUNT: usize>() -> [SectionKind; COUNT] {
    let mut all = [SectionKind::Bodies; COUNT];
    let (mut from, mut to) = (0, 0);
    while from < SectionKind::OF_OTHERS.len() {
        all[to] = SectionKind::OF_OTHERS[from];
        to += 1;
        if matches!(SectionKind::OF_OTHERS[from], SectionKind::Bodies) {
            let mut row = 0;
            while row < ROWS.len() {
                all[to] = SectionKind::Element(ROWS[row].section);
                to += 1;
                row += 1;
            }
        }
        from += 1;
    }
    all
}

impl SectionKind {
    /// All sections, in the order of the reference manual.
    pub const ALL: &[SectionKind] = SECTIONS;

    /// The section with a heading word.
    pub fn named(word: &str) -> Option<SectionKind> {
        SectionKind::named_among(SectionKind::ALL, word)
    }
}

impl Spec {
    /// Parses the tokens of `source`. All errors are reported at once.
    pub fn parse(tokens: &[Token], source: SourceId, report: &mut Report) -> Spec {
        Spec::read(tokens, source, SectionKind::ALL, report)
    }
}

impl<'d> Model<'d> {
    /// Resolves a spec into a model.
    ///
    /// `constants` replaces the values of constants, by name: `N = 64`. `files` is where `extends`
    /// finds the base. Returns a model only if the report has no errors.
    pub fn resolve(
        spec: Spec,
        dag: &'d Dag,
        constants: &[(String, Rational)],
        files: &mut dyn Files,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Option<Model<'d>> {
        resolve::resolve(
            spec,
            LANGUAGE,
            dag,
            constants,
            Vec::new(),
            (files, sources),
            report,
        )
    }

    /// Resolves a spec with additional formulas as further outputs, after its own.
    pub fn resolve_with(
        spec: Spec,
        dag: &'d Dag,
        constants: &[(String, Rational)],
        formulas: &[Formula<'_>],
        files: &mut dyn Files,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Option<Model<'d>> {
        let formulas = formulas::items(formulas, sources, report);
        resolve::resolve(
            spec,
            LANGUAGE,
            dag,
            constants,
            formulas,
            (files, sources),
            report,
        )
    }
}
