//! The machine: its description, its assumptions, its simplifications.

use lagrangian_symbolic::print::Mark;
use lagrangian_symbolic::{Expr, Math, math_as_built};

use super::{Chapter, Shown, code, counted, head, listed, paragraph, prose, shown, unit, words};
use crate::document::{Block, Inline, Row, Words, of_docs};
use lagrangian_mechanics::{Freedom, Independent, equations::freedom};
use lagrangian_spec::model::{ApproximationKind, Coordinate, Name, Space};
use lagrangian_units::rate_unit;

/// A row of a table of symbols.
struct Entry<'a, 'd> {
    symbol: Option<Expr<'d>>,
    name: &'a Name,
    unit: &'a str,
    value: Option<Expr<'d>>,
    docs: &'a str,
}

impl<'d> Chapter<'_, 'd> {
    pub(super) fn machine(&self) -> Vec<Block> {
        let model = self.model;
        let mut blocks = prose(&model.docs);
        blocks.extend(self.degrees_of_freedom());
        blocks.push(self.table(
            &["", "coordinate", "unit", "start", ""],
            self.places().map(|c| Entry {
                symbol: Some(c.q),
                name: &c.name,
                unit: &c.unit_text,
                value: Some(c.start),
                docs: &c.docs,
            }),
        ));
        blocks.extend(self.rates());
        let states = model.coordinates.iter().filter(|c| c.rate.is_some());
        let states: Vec<_> = states
            .map(|c| {
                let name = Name {
                    base: c.name.word().to_owned(),
                    index: c.name.index,
                };
                (c, name, rate_unit(&c.name.to_string(), &c.unit_text))
            })
            .collect();
        if !states.is_empty() {
            blocks.push(self.table(
                &["", "state", "unit", "start", ""],
                states.iter().map(|(c, name, unit)| Entry {
                    symbol: Some(c.v),
                    name,
                    unit,
                    value: Some(c.start_rate),
                    docs: &c.docs,
                }),
            ));
        }
        blocks.extend(self.given_values());
        blocks.extend(self.assumptions());
        blocks.extend(self.approximations());
        blocks.extend(self.outputs());
        blocks
    }

    /// The number of degrees of freedom.
    fn degrees_of_freedom(&self) -> Vec<Block> {
        let model = self.model;
        let mut blocks = Vec::new();
        let place = match model.space {
            Space::Plane => "in the plane",
            Space::Space => "in space",
        };
        let states = model
            .coordinates
            .iter()
            .filter(|c| c.rate.is_some())
            .count();
        let n = model.coordinates.len() - states;
        let mut freedom = freedom(model, &self.compiled.equations);
        freedom.coordinates -= states;
        let text = match (freedom.constraints, freedom.lengths) {
            (0, 1..) => format!(
                "The machine moves {place}. It has {} of freedom and {}.",
                counted(n - freedom.lengths, "degree"),
                counted(n, "generalized coordinate"),
            ),
            (0, 0) => format!(
                "The machine moves {place}. It has {} of freedom, as many as generalized coordinates.",
                counted(n, "degree"),
            ),
            _ => format!("The machine moves {place}. {}", constrained(freedom)),
        };
        blocks.push(paragraph([words![text]]));
        if freedom.lengths > 0 {
            let text = "Only the ratios of the four numbers of a quaternion that turns a frame have a meaning. Its length is not a degree of \
                        freedom: an equation of its own, (E74) and (E75), returns it to 1; the inertia and the load of that equation are in \
                        the mass matrix, the bias and the forces, and in no energy.";
            blocks.push(paragraph([words![text]]));
        }
        blocks
    }

    /// The tables of parameters, constants and inputs.
    fn given_values(&self) -> Vec<Block> {
        let model = self.model;
        let mut blocks = Vec::new();
        if !model.parameters.is_empty() {
            blocks.push(self.table(
                &["", "parameter", "unit", "default", ""],
                model.parameters.iter().map(|p| Entry {
                    symbol: Some(p.symbol),
                    name: &p.name,
                    unit: &p.unit_text,
                    value: p.default,
                    docs: &p.docs,
                }),
            ));
        }
        if !model.derived_parameters.is_empty() {
            blocks.push(self.table(
                &["", "derived parameter", "unit", "value", ""],
                model.derived_parameters.iter().map(|p| Entry {
                    symbol: None,
                    name: &p.name,
                    unit: &p.unit_text,
                    value: Some(p.value),
                    docs: &p.docs,
                }),
            ));
        }
        if !model.constants.is_empty() {
            blocks.push(self.table(
                &["", "constant", "unit", "value", ""],
                model.constants.iter().map(|c| Entry {
                    symbol: None,
                    name: &c.name,
                    unit: &c.unit_text,
                    value: Some(c.value),
                    docs: &c.docs,
                }),
            ));
        }
        if !model.inputs.is_empty() {
            blocks.push(self.table(
                &["", "input", "unit", "default", ""],
                model.inputs.iter().map(|input| Entry {
                    symbol: Some(input.symbol),
                    name: &input.name,
                    unit: &input.unit_text,
                    value: Some(input.default),
                    docs: &input.docs,
                }),
            ));
        }
        blocks
    }

    /// The facts that the machine assumes.
    fn assumptions(&self) -> Option<Block> {
        let model = self.model;
        if model.assumptions.is_empty() {
            return None;
        }
        let facts = model
            .assumptions
            .iter()
            .take(12)
            .map(|fact| words![code(&fact.text)]);
        let more = match model.assumptions.len() {
            0..=12 => words!["."],
            all => words![format!(", and {} more.", all - 12)],
        };
        let begin = words!["It is assumed, and checked during a run, that "];
        Some(paragraph([begin, listed(facts), more]))
    }

    /// The coordinates other than integrals of states.
    fn places(&self) -> impl Iterator<Item = &Coordinate<'d>> {
        let coordinates = self.model.coordinates.iter();
        coordinates.filter(|c| c.rate.is_none())
    }

    /// The initial rates, if the machine does not start at rest.
    fn rates(&self) -> Option<Block> {
        const MOST: usize = 12;
        let moving = || self.places().filter(|c| !c.start_rate.is_zero());
        let count = moving().count();
        let rates = moving().take(MOST).map(|c| {
            let rate = self.name(c.v).equals(self.value(c.start_rate));
            let per_second = rate_unit(&c.name.to_string(), &c.unit_text);
            let mut words = words![rate, " "];
            words.extend(unit(&per_second));
            words
        });
        let more = match count.saturating_sub(MOST) {
            0 => words!["."],
            more => words![format!(", and so on for {more} more.")],
        };
        let begin = words!["It starts with "];
        (count > 0).then(|| paragraph([begin, listed(rates), more]))
    }

    fn table<'t>(&self, titles: &[&str], entries: impl Iterator<Item = Entry<'t, 'd>>) -> Block
    where
        'd: 't,
    {
        let entries: Vec<Entry<'t, 'd>> = entries.collect();
        let row = |entry: &Entry<'_, 'd>| {
            let value = entry.value.map(|value| self.value(value));
            vec![
                entry
                    .symbol
                    .map_or_else(Words::new, |symbol| words![self.name(symbol)]),
                words![code(entry.name)],
                unit(entry.unit),
                value.map_or_else(Words::new, |value| words![value]),
                of_docs(entry.docs),
            ]
        };
        let rows = shown(entries.iter().map(|entry| entry.name))
            .into_iter()
            .map(|shown| match shown {
                Shown::Item(index) => row(&entries[index]),
                Shown::Omitted(from, count) => {
                    let base = &entries[from].name.base;
                    let text = format!("{count} more of {base}");
                    vec![words!["…"], words![text], words![], words![], words![]]
                }
            });
        let rows: Vec<Vec<Words>> = rows.collect();
        // Columns that are blank in every row are left out.
        let keep: Vec<bool> = (0..titles.len())
            .map(|k| !titles[k].is_empty() || rows.iter().any(|row| !is_blank(&row[k])))
            .collect();
        let without_empty = |cells: Vec<Words>| -> Vec<Words> {
            let cells = cells.into_iter().zip(&keep);
            cells
                .filter(|(_, keep)| **keep)
                .map(|(cell, _)| cell)
                .collect()
        };
        Block::Table(
            without_empty(head(titles)),
            rows.into_iter().map(without_empty).collect(),
        )
    }

    /// A default value, as a decimal if it was probably written so.
    fn value(&self, value: Expr<'d>) -> Math {
        let decimal = value.as_constant().and_then(|number| {
            let (above, below) = (number.numerator()?, number.denominator()?);
            // The denominator has only the prime factors two and five, and the numerator few enough digits.
            let is_decimal = 10_i64.pow(6) % below == 0 && above.abs() < 1_000_000_000;
            (below > 1 && is_decimal).then(|| above as f64 / below as f64)
        });
        match decimal {
            Some(number) if number < 0.0 => -Math::mark(Mark::Number((-number).to_string())),
            Some(number) => Math::mark(Mark::Number(number.to_string())),
            None => math_as_built(value, self.model.dag),
        }
    }

    fn approximations(&self) -> Vec<Block> {
        let of_kind = |kind: ApproximationKind| {
            let list = self.model.approximations.iter();
            let list = list.filter(|approximation| approximation.kind == kind);
            let names = list.map(|a| words![self.name(self.model.coordinates[a.coordinate].q)]);
            names.collect::<Vec<Words>>()
        };
        let mut blocks = Vec::new();
        let frozen = of_kind(ApproximationKind::Frozen);
        if !frozen.is_empty() {
            blocks.push(paragraph([
                words!["Approximation: in the velocities of the bodies, the sine of "],
                listed(frozen),
                words![
                    " is taken as 0 and its cosine as 1, after differentiation. This neglects that the directions of \
                     velocities turn with the angle. Positions, potentials and forces remain exact."
                ],
            ]));
        }
        let small = of_kind(ApproximationKind::Small);
        if !small.is_empty() {
            blocks.push(paragraph([
                words!["Approximation: "],
                listed(small),
                words![
                    " and rates are small. Energies and dissipation are kept to second order in both together, and the \
                     equations of motion to first order; the neglected terms of the energies fall with the cube of the angle."
                ],
            ]));
        }
        blocks
    }

    fn outputs(&self) -> Vec<Block> {
        let outputs = &self.model.outputs;
        if outputs.is_empty() {
            return Vec::new();
        }
        let mut blocks = vec![Block::Paragraph(words!["Outputs:"])];
        let mut rows: Vec<Row> = Vec::new();
        let mut items = Vec::new();
        for shown in shown(outputs.iter().map(|output| &output.name)) {
            match shown {
                Shown::Item(index) => {
                    let output = &outputs[index];
                    let left = Math::text(output.name.to_string());
                    rows.extend(self.equality(left, output.value, ""));
                    if !output.docs.is_empty() {
                        let mut item = words![code(&output.name), " in "];
                        item.extend(unit(&output.unit_text));
                        item.extend(words![": "]);
                        item.extend(of_docs(&output.docs));
                        items.push(item);
                    }
                }
                Shown::Omitted(from, count) => {
                    let text = format!("and {count} more of {}", outputs[from].name.base);
                    rows.extend(Row::lines(&Math::text(text), 0, ""));
                }
            }
        }
        if !items.is_empty() {
            blocks.push(Block::List(items));
        }
        blocks.push(Block::Formula(rows));
        blocks
    }
}

/// The degrees of freedom of a machine with constraints.
fn constrained(freedom: Freedom) -> String {
    let coordinates = counted(freedom.coordinates, "generalized coordinate");
    let constraints = counted(freedom.constraints, "constraint");
    let Some(Independent { generic, at_start }) = freedom.independent else {
        return format!(
            "It has {coordinates} and {constraints}; it is not known how many of these are independent."
        );
    };
    let left = counted(freedom.degrees().unwrap_or_default(), "degree");
    let mut text = format!("It has {coordinates} and {constraints}");
    if generic < freedom.constraints {
        text.push_str(&format!(", of which {} independent", of_all(generic)));
    }
    text.push_str(&format!(": {left} of freedom."));
    if at_start < generic {
        text.push_str(&format!(
            " At the start only {} independent, and motions may fork there.",
            of_all(at_start)
        ));
    }
    text
}

/// `one is`, `two are`.
fn of_all(count: usize) -> String {
    let number = counted(count, "");
    let number = number.trim_end_matches(['s', ' ']);
    format!("{number} {}", if count == 1 { "is" } else { "are" })
}

fn is_blank(words: &Words) -> bool {
    words.iter().all(|run| match run {
        Inline::Text(text) | Inline::Code(text) | Inline::Emphasis(text) => text.is_empty(),
        Inline::Math(math) => math.is_empty(),
    })
}
