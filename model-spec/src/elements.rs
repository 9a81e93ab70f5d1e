//! The elements of the language: what may stand in a machine beside its bodies, and contributes to the
//! equations.
//!
//! Each is one file with all that is known of it: how its section is written, units and stages of its
//! fields, what it contributes, how it is called and drawn, what can be wrong with it. A new one is a
//! file more, and a row of [`ROWS`]. The parser and the resolver are given this list and name none of
//! it; behind them an element is what [`element`](crate::model::element) says, a few contributions that
//! mechanics knows.

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

/// The sections of elements, in the order in which their items are worked out and listed.
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

/// Those of elements stand behind the bodies.
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
    /// All sections, in the order of the reference.
    pub const ALL: &[SectionKind] = SECTIONS;

    /// The section that a word heads.
    pub fn named(word: &str) -> Option<SectionKind> {
        SectionKind::named_among(SectionKind::ALL, word)
    }
}

impl Spec {
    /// Reads the tokens of `source`. Whatever is wrong is reported, all at once.
    pub fn parse(tokens: &[Token], source: SourceId, report: &mut Report) -> Spec {
        Spec::read(tokens, source, SectionKind::ALL, report)
    }
}

impl<'d> Model<'d> {
    /// Finds out what a spec means.
    ///
    /// `constants` replaces the values of constants, by name: `N = 64`. `files` is where `extends`
    /// finds the base. There is a model only if the report has no errors.
    pub fn resolve(
        spec: Spec,
        dag: &'d Dag,
        constants: &[(String, Rational)],
        files: &mut dyn Files,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Option<Model<'d>> {
        let language = Language {
            sections: SectionKind::ALL,
            elements: ROWS,
        };
        resolve::resolve(
            spec,
            language,
            dag,
            constants,
            Vec::new(),
            (files, sources),
            report,
        )
    }

    /// Resolves a spec with formulas that are to be computed beside what the spec says: further outputs, behind its own.
    pub fn resolve_with(
        spec: Spec,
        dag: &'d Dag,
        constants: &[(String, Rational)],
        formulas: &[Formula<'_>],
        files: &mut dyn Files,
        sources: &mut Sources,
        report: &mut Report,
    ) -> Option<Model<'d>> {
        let language = Language {
            sections: SectionKind::ALL,
            elements: ROWS,
        };
        let formulas = formulas::items(formulas, sources, report);
        resolve::resolve(
            spec,
            language,
            dag,
            constants,
            formulas,
            (files, sources),
            report,
        )
    }
}
