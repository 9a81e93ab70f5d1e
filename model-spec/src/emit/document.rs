//! A derivation as a text to read: what the machine is, its energies, its equations of motion, and what the code costs.
//!
//! [`markdown`](super::markdown), [`latex`](super::latex) and [`html`](super::html) print the same [`Document`]. Formulas
//! in it are values, not texts in one of these languages.

use lagrangian_symbolic::{Expr, Math, Names, Symbol, math};

use crate::compile::Compiled;
use crate::mechanics::Route;
use crate::model::{ApproximationKind, Coordinate, Model, Space};

/// Expressions of a greater [`size`](Expr::size) are not printed: they would fill pages, and nobody reads them.
const READABLE: u64 = 3000;

/// The width of a line of a formula, in the size of its font (em): that of A4 paper with margins of 2 cm.
const LINE: f32 = 44.0;

/// What lines are indented by that continue a formula, in em.
const INDENT: f32 = 2.0;

/// A derivation to read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document {
    /// The machine's name.
    pub title: String,
    /// Its chapters.
    pub sections: Vec<Section>,
}

/// A chapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// What it is about.
    pub title: String,
    /// What it says.
    pub blocks: Vec<Block>,
}

/// A piece of a chapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// A heading below that of the section.
    Heading(Words),
    /// Words.
    Paragraph(Words),
    /// Items, one below the other.
    List(Vec<Words>),
    /// A formula, line by line.
    Formula(Vec<Row>),
    /// A table: its head, its rows.
    Table(Vec<Words>, Vec<Vec<Words>>),
}

/// Words with mathematics and code among them.
pub type Words = Vec<Run>;

/// A piece of a line of words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Run {
    /// Words, nothing in them escaped.
    Text(String),
    /// Mathematics.
    Math(Math),
    /// What a program or a spec would say.
    Code(String),
}

/// A line of a formula.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The line.
    pub math: Math,
    /// Whether it continues the line before it; then it is indented.
    pub continues: bool,
    /// What is said about it at the right margin; nothing if empty.
    pub note: String,
}

impl From<&str> for Run {
    fn from(text: &str) -> Run {
        Run::Text(text.to_owned())
    }
}

impl From<String> for Run {
    fn from(text: String) -> Run {
        Run::Text(text)
    }
}

impl From<Math> for Run {
    fn from(math: Math) -> Run {
        Run::Math(math)
    }
}

/// A line of words from its pieces.
macro_rules! words {
    ($($run:expr),* $(,)?) => { vec![$(Run::from($run)),*] };
}

impl Document {
    /// The derivation of a machine.
    pub fn new(compiled: &Compiled<'_>) -> Document {
        let sections = [
            machine(compiled),
            bodies(compiled),
            energies(compiled),
            motion(compiled),
            code(compiled),
        ];
        Document {
            title: compiled.model.name.clone(),
            sections: sections.into(),
        }
    }
}

fn section(title: &str, blocks: Vec<Block>) -> Section {
    Section {
        title: title.into(),
        blocks,
    }
}

fn paragraph(words: Words) -> Block {
    Block::Paragraph(words)
}

fn head(titles: &[&str]) -> Vec<Words> {
    titles.iter().map(|title| words![*title]).collect()
}

fn machine(compiled: &Compiled<'_>) -> Section {
    let Compiled { model, program, .. } = compiled;
    let mut blocks = Vec::new();
    if !model.docs.is_empty() {
        blocks.push(paragraph(words![model.docs.clone()]));
    }
    let rows = model.coordinates.iter().map(|coordinate| {
        vec![
            words![name(model, coordinate.q)],
            words![Run::Code(coordinate.name.to_string())],
            words![coordinate.unit_text.clone()],
            words![coordinate.docs.clone()],
        ]
    });
    blocks.push(paragraph(words!["Generalized coordinates:"]));
    blocks.push(Block::Table(
        head(&["", "name", "unit", ""]),
        rows.collect(),
    ));
    if !model.parameters.is_empty() {
        let slots = model.parameters.iter().zip(&program.parameters);
        let rows = slots.map(|(parameter, slot)| {
            let default = slot.default.as_ref();
            let default = default.map_or_else(String::new, |default| default.text.clone());
            vec![
                words![name(model, parameter.symbol)],
                words![Run::Code(parameter.name.to_string())],
                words![parameter.unit_text.clone()],
                words![default],
                words![parameter.docs.clone()],
            ]
        });
        blocks.push(paragraph(words!["Parameters:"]));
        blocks.push(Block::Table(
            head(&["", "name", "unit", "default", ""]),
            rows.collect(),
        ));
    }
    if !model.assumptions.is_empty() {
        let facts: Vec<&str> = model
            .assumptions
            .iter()
            .map(|fact| fact.text.as_str())
            .collect();
        blocks.push(paragraph(words![format!("Assumed: {}.", facts.join(", "))]));
    }
    for approximation in &model.approximations {
        let coordinate = &model.coordinates[approximation.coordinate];
        let what = match approximation.kind {
            ApproximationKind::Frozen => {
                "sine taken as 0 and cosine as 1 in the velocities of the bodies"
            }
            ApproximationKind::Small => {
                "energies and dissipation to second order in it and its rate"
            }
        };
        blocks.push(paragraph(words![
            "Approximated: ",
            name(model, coordinate.q),
            format!(", {what}.")
        ]));
    }
    section("The machine", blocks)
}

fn bodies(compiled: &Compiled<'_>) -> Section {
    let Compiled {
        model, equations, ..
    } = compiled;
    let axes: &[char] = match model.space {
        Space::Plane => &['x', 'y'],
        Space::Space => &['x', 'y', 'z'],
    };
    let mut blocks = Vec::new();
    for (body, derived) in model.bodies.iter().zip(&equations.bodies) {
        let label = || Math::text(body.name.to_string());
        blocks.push(paragraph(words![format!(
            "Position, velocity and kinetic energy of {}:",
            body.name
        )]));
        for (&axis, position) in axes.iter().zip(&derived.position) {
            let axis = Math::letter(axis).with_index(label());
            blocks.push(equation(model, axis, *position));
        }
        for (&axis, velocity) in axes.iter().zip(&derived.velocity) {
            let rate = Math::letter(axis).dotted().with_index(label());
            blocks.push(equation(model, rate, *velocity));
        }
        let energy = Math::letter('T').with_index(label());
        blocks.push(equation(model, energy, derived.kinetic_energy));
    }
    section("The bodies", blocks)
}

fn energies(compiled: &Compiled<'_>) -> Section {
    let Compiled {
        model, equations, ..
    } = compiled;
    let mut blocks = vec![equation(model, Math::letter('T'), equations.kinetic_energy)];
    let mut absent = Vec::new();
    for (what, letter, value) in [
        ("potential energy", 'V', equations.potential_energy),
        ("dissipation", 'D', equations.dissipation),
    ] {
        match value.is_zero() {
            true => absent.push(what),
            false => blocks.push(equation(model, Math::letter(letter), value)),
        }
    }
    if !absent.is_empty() {
        let text = format!(
            "The machine has no {}; the code has none either.",
            absent.join(" and no ")
        );
        blocks.push(paragraph(words![text]));
    }
    section("Energies and dissipation", blocks)
}

/// Σⱼ Mᵢⱼ q̈ⱼ + hᵢ = Qᵢ, coordinate by coordinate.
fn motion(compiled: &Compiled<'_>) -> Section {
    let Compiled {
        model, equations, ..
    } = compiled;
    let mut blocks = Vec::new();
    let route = match equations.route {
        Route::Projected => "Lagrange's equations of the second kind,",
        Route::Lagrange => "Lagrange's equations of the second kind, of the approximated energies,",
    };
    blocks.push(paragraph(words![
        format!("{route} "),
        lagrange(),
        ": inertia and velocity terms on the left, applied forces on the right.",
    ]));
    for (i, coordinate) in model.coordinates.iter().enumerate() {
        let inertia = model.coordinates.iter().enumerate();
        let inertia = inertia.map(|(j, other)| *equations.mass_matrix.get(i, j) * other.a);
        let left = model.dag.sum(inertia.chain([equations.bias[i]]));
        let right = equations.applied[i];
        blocks.push(paragraph(words!["For ", name(model, coordinate.q), ":"]));
        blocks.push(match (printable(left), printable(right)) {
            (true, true) => formula(math(left, model.dag).equals(math(right, model.dag))),
            _ => too_long(coordinate, left.size().saturating_add(right.size())),
        });
    }
    section("Equations of motion", blocks)
}

/// d/dt ∂T/∂q̇ᵢ − ∂T/∂qᵢ = Qᵢ.
fn lagrange() -> Math {
    let letter = Math::letter;
    let q = || letter('q').with_index(letter('i'));
    let q_rate = letter('q').dotted().with_index(letter('i'));
    let partial = |of: char, by: Math| Math::fraction(letter('∂') * letter(of), letter('∂') * by);
    let rate = Math::fraction(letter('d'), letter('d') * letter('t'));
    (rate * partial('T', q_rate) - partial('T', q())).equals(letter('Q').with_index(letter('i')))
}

fn code(compiled: &Compiled<'_>) -> Section {
    let program = &compiled.program;
    let head = head(&[
        "",
        "multiplications",
        "additions",
        "divisions",
        "sine–cosine pairs",
        "other",
    ]);
    let functions = program
        .all_functions()
        .filter(|function| !function.results.is_empty());
    let rows = functions.map(|function| {
        let counts = function.counts();
        let numbers = [
            counts.multiplications,
            counts.additions,
            counts.divisions,
            counts.sincos,
            counts.other,
        ];
        let name = words![Run::Code(program.title(function.role))];
        [name]
            .into_iter()
            .chain(numbers.map(|n| words![n.to_string()]))
            .collect()
    });
    let table = Block::Table(head, rows.collect());
    let words = words![
        "What one call of each function costs; ",
        Run::Code("prepare".into()),
        " is called once for a set of parameters.",
    ];
    section("The code", vec![paragraph(words), table])
}

fn printable(expression: Expr<'_>) -> bool {
    expression.size() <= READABLE
}

fn too_long(coordinate: &Coordinate<'_>, size: u64) -> Block {
    paragraph(words![format!(
        "The equation of {} has {size} symbols written out, and is shown as a program only.",
        coordinate.name
    )])
}

/// `label = expression`, or how long it would be.
fn equation(model: &Model<'_>, label: Math, expression: Expr<'_>) -> Block {
    if !printable(expression) {
        let size = expression.size();
        let text = format!(" has {size} symbols written out, and is shown as a program only.");
        return paragraph(words![label, text]);
    }
    formula(label.equals(math(expression, model.dag)))
}

/// A formula in lines.
fn formula(math: Math) -> Block {
    let lines = math.lines(LINE, LINE - INDENT).into_iter().enumerate();
    let rows = lines.map(|(index, math)| Row {
        math,
        continues: index > 0,
        note: String::new(),
    });
    Block::Formula(rows.collect())
}

fn name(model: &Model<'_>, symbol: Expr<'_>) -> Math {
    let symbol: Option<Symbol> = symbol.as_symbol();
    symbol.map_or_else(Math::default, |symbol| model.dag.math(symbol))
}
