//! The equations of motion in groups, and the mass matrix.

use lagrangian_symbolic::print::{Form, Sign};
use lagrangian_symbolic::{Expr, Math, Node, math_as_built};

use super::{Chapter, READABLE, Shown, code, paragraph, shown, words};
use crate::document::{Block, LINE, Row};
use lagrangian_mechanics::Route;
use lagrangian_mechanics::equations::groups::{self, Group, Term, TermKind};
use lagrangian_spec::model::stage;

/// In an equation that is too long to read, groups of a greater size get a name or are left out.
const LONG_GROUP: u64 = 750;

/// In such an equation entries of the mass matrix of a greater size get a name.
const LONG_ENTRY: u64 = 100;

/// The most rows of a mass matrix that is written out.
const LARGEST_MATRIX: usize = 9;

/// The most entries that are named and written below the matrix; the equations contain further ones as well.
const MOST_NAMES: usize = 24;

/// The widest entry that is written inside a matrix of names, in em.
const SHORT_ENTRY: f32 = 3.5;

impl<'d> Chapter<'_, 'd> {
    pub(super) fn motion(&self) -> Vec<Block> {
        let model = self.model;
        let begin = match self.compiled.equations.route {
            Route::Projected => "Lagrange's equations of the second kind",
            Route::Lagrange => {
                "Lagrange's equations of the second kind, of the approximated energies,"
            }
        };
        let mut blocks = vec![
            Block::Paragraph(words![
                begin,
                " (J. L. Lagrange, Mécanique analytique, 1788; H. Goldstein, C. Poole, J. Safko, Classical Mechanics, \
                 3rd ed. 2002, ch. 1)",
            ]),
            Block::formula(&self.lagrange()),
            Block::Paragraph(words![
                "give one equation for each coordinate; notes name the sources of its terms. Where an equation is too \
                 long to be read, ",
                entry_name(0, 1),
                " stands for an entry of the mass matrix and ",
                Math::letter('h').with_index(Math::number(1)),
                " for all terms in the velocities and in explicit time; ",
                code("derive --as program"),
                " shows how they are computed.",
            ]),
        ];
        for shown in shown(model.coordinates.iter().map(|coordinate| &coordinate.name)) {
            match shown {
                Shown::Item(index) => blocks.extend(self.equation(index)),
                Shown::Omitted(from, count) => {
                    let base = &model.coordinates[from].name.base;
                    let text = format!(
                        "{count} more equations, of the family {base}, are left out here; "
                    );
                    let words = words![
                        text,
                        code("derive --as program"),
                        " shows everything that is computed."
                    ];
                    blocks.push(Block::Paragraph(words));
                }
            }
        }
        blocks
    }

    /// d/dt ∂T/∂q̇ᵢ − ∂T/∂qᵢ + ∂V/∂qᵢ + ∂D/∂q̇ᵢ = Fᵢ, without what the machine lacks.
    fn lagrange(&self) -> Math {
        let letter = Math::letter;
        let i = || letter('i');
        let q = || letter('q').with_index(i());
        let v = || letter('q').dotted().with_index(i());
        let partial =
            |of: char, by: Math| Math::fraction(letter('∂') * letter(of), letter('∂') * by);
        let rate = Math::fraction(letter('d'), letter('d') * letter('t'));
        let mut left = rate * partial('T', v()) - partial('T', q());
        if !self.compiled.equations.potential_energy.is_zero() {
            left = left + partial('V', q());
        }
        if !self.compiled.equations.dissipation.is_zero() {
            left = left + partial('D', v());
        }
        left.equals(match self.model.loads().next() {
            None => Math::number(0),
            Some(_) => letter('F').with_index(i()),
        })
    }

    fn equation(&self, index: usize) -> Vec<Block> {
        let coordinate = &self.model.coordinates[index];
        let heading = Block::Heading(match coordinate.rate {
            Some(_) => words!["Rate of ", self.name(coordinate.v)],
            None => words!["Equation of ", self.name(coordinate.q)],
        });
        let groups = groups::equation(self.model, &self.compiled.equations, &self.shares, index);
        let size = groups
            .iter()
            .fold(0, |size: u64, group| size.saturating_add(size_of(group)));
        let rows = if size > READABLE {
            self.long_rows(index, &groups)
        } else {
            self.rows(&groups)
        };
        vec![heading, Block::Formula(rows)]
    }

    /// Group by group, with names for long parts: entries of the mass matrix and the bias.
    fn long_rows(&self, index: usize, groups: &[Group<'d>]) -> Vec<Row> {
        let is_velocity = |group: &&Group<'d>| {
            use TermKind::{Centrifugal, Coriolis, Drive, Velocity};
            matches!(group.kind, Centrifugal | Coriolis | Drive | Velocity)
        };
        let velocity = groups.iter().filter(is_velocity);
        let velocity = velocity.fold(0, |size: u64, group| size.saturating_add(size_of(group)));
        let mut named = Vec::new();
        let mut has_bias = false;
        for group in groups {
            if is_velocity(&group) && velocity > LONG_GROUP {
                if !has_bias {
                    let bias = Math::letter('h').with_index(Math::number(index as i64 + 1));
                    named.push((bias, "velocity terms"));
                }
                has_bias = true;
                continue;
            }
            let math = match group.kind {
                TermKind::Inertia => self.inertia_terms(index, group),
                _ if size_of(group) > LONG_GROUP => {
                    Math::text(format!("({} symbols, not shown)", size_of(group)))
                }
                _ => self.sum(group),
            };
            named.push((math, self.title(group.kind)));
        }
        let is_applied = groups
            .last()
            .is_some_and(|group| group.kind == TermKind::Applied);
        arranged(named, is_applied)
    }

    /// The inertia terms, with long entries of the mass matrix by name.
    fn inertia_terms(&self, index: usize, group: &Group<'d>) -> Math {
        let mut sum = Math::default();
        for (position, term) in group.terms.iter().enumerate() {
            let column = self
                .model
                .coordinates
                .iter()
                .position(|c| c.a == term.factor);
            let term = match column {
                Some(column) if term.coefficient.size() > LONG_ENTRY => {
                    entry_name(index, column) * self.name(term.factor)
                }
                _ => self.term(term),
            };
            sum = if position == 0 { term } else { sum + term };
        }
        sum
    }

    /// Group by group, the right side last.
    fn rows(&self, groups: &[Group<'d>]) -> Vec<Row> {
        let is_applied = groups
            .last()
            .is_some_and(|group| group.kind == TermKind::Applied);
        let sums = groups
            .iter()
            .map(|group| (self.sum(group), self.title(group.kind)));
        arranged(sums.collect(), is_applied)
    }

    fn sum(&self, group: &Group<'d>) -> Math {
        let mut sum = Math::default();
        for (position, term) in group.terms.iter().enumerate() {
            let term = self.term(term);
            sum = if position == 0 { term } else { sum + term };
        }
        sum
    }

    /// A coefficient with its factor; a sum that depends on the motion keeps its parentheses and comes first.
    pub(super) fn term(&self, term: &Term<'d>) -> Math {
        let dag = self.model.dag;
        let (coefficient, factor) = (term.coefficient, term.factor);
        let before = || math_as_built(coefficient, dag);
        if factor.is_one() || coefficient.stage() <= stage::PARAMETER {
            return math_as_built(term.value(), dag);
        }
        match coefficient.node() {
            Node::Sum(terms) if terms.len() > 1 => {
                before().in_parentheses() * math_as_built(factor, dag)
            }
            Node::Sum(terms) if ends_in_a_sum(dag.expr(terms[0].0)) => {
                before() * math_as_built(factor, dag)
            }
            _ if ends_in_a_sum(coefficient) => before() * math_as_built(factor, dag),
            _ => math_as_built(term.value(), dag),
        }
    }

    fn title(&self, kind: TermKind) -> &'static str {
        match kind {
            TermKind::Inertia => "inertia",
            TermKind::Centrifugal => "centrifugal",
            TermKind::Coriolis => "Coriolis",
            TermKind::Velocity if self.properties.autonomous => "velocity terms",
            TermKind::Velocity => "velocity terms, drive",
            TermKind::Drive => "drive",
            TermKind::Gravity => "gravity",
            TermKind::Springs => "springs",
            TermKind::Potentials => "potentials",
            TermKind::Dissipation => "damping",
            TermKind::Applied => "applied",
        }
    }

    pub(super) fn mass_matrix(&self) -> Vec<Block> {
        let matrix = &self.compiled.equations.mass_matrix;
        let n = matrix.dimension();
        if !(2..=LARGEST_MATRIX).contains(&n) {
            return Vec::new();
        }
        let places = || (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let all = |cell: &dyn Fn(usize, usize) -> Math| {
            let cells = places().map(|(i, j)| cell(i, j));
            Math::bold('M').equals(Math::form(Form::Matrix(n), cells))
        };
        let written = matrix.map(|&entry| match entry.size() {
            0..=READABLE => math_as_built(groups::compact(entry), self.model.dag),
            size => Math::text(format!("{size} symbols, not shown")),
        });
        let whole = all(&|i, j| written.get(i, j).clone());
        let order = self.model.coordinates.iter().map(|c| self.name(c.q));
        let order = Math::joined(order, Sign::Comma);
        let intro = words![
            "The coefficients of the accelerations, with rows and columns in the order ",
            order,
            ":"
        ];
        if whole.width() <= LINE {
            return vec![Block::Paragraph(intro), Block::formula(&whole)];
        }
        let is_short = |i: usize, j: usize| written.get(i, j).width() <= SHORT_ENTRY;
        let short = all(&|i, j| {
            if is_short(i, j) {
                written.get(i, j).clone()
            } else {
                entry_name(i, j)
            }
        });
        let long: Vec<_> = places()
            .filter(|&(i, j)| i <= j && !is_short(i, j))
            .collect();
        if long.len() > MOST_NAMES {
            return Vec::new();
        }
        let rows = long
            .into_iter()
            .map(|(i, j)| entry_name(i, j).equals(written.get(i, j).clone()));
        let rows = rows
            .flat_map(|formula| Row::lines(&formula, 0, ""))
            .collect();
        vec![
            paragraph([intro]),
            Block::formula(&short),
            Block::Paragraph(words!["where the matrix is symmetric and"]),
            Block::Formula(rows),
        ]
    }
}

/// The groups below each other, with the last on the right-hand side if it `is_applied`.
fn arranged(mut groups: Vec<(Math, &str)>, is_applied: bool) -> Vec<Row> {
    let applied = groups.pop_if(|_| is_applied);
    if groups.is_empty() {
        groups.push((Math::number(0), ""));
    }
    let last = groups.len() - 1;
    let mut rows = Vec::new();
    for (position, (mut math, note)) in groups.into_iter().enumerate() {
        if position > 0 {
            math = Math::default() + math;
        }
        if position == last && applied.is_none() {
            math = math.equals(Math::number(0));
        }
        rows.extend(Row::lines(&math, usize::from(position > 0), note));
    }
    if let Some((math, note)) = applied {
        rows.extend(Row::lines(&Math::default().equals(math), 1, note));
    }
    rows
}

/// The name of an entry of the mass matrix, by its position in the upper triangle.
fn entry_name(i: usize, j: usize) -> Math {
    let place = [i.min(j), i.max(j)].map(|k| Math::number(k as i64 + 1));
    Math::letter('M').with_index(match i.max(j) {
        0..9 => Math::row(place),
        _ => Math::joined(place, Sign::Comma),
    })
}

/// The number of symbols in a group when written out.
fn size_of(group: &Group<'_>) -> u64 {
    let terms = group.terms.iter();
    terms.fold(0, |size: u64, term| {
        size.saturating_add(term.value().size())
    })
}

/// Whether a product ends with a sum that depends on the motion: then nothing after it can be read as an argument.
fn ends_in_a_sum(product: Expr<'_>) -> bool {
    let dag = product.dag();
    let Node::Product(factors) = product.node() else {
        return false;
    };
    let is = |wanted: &dyn Fn(&Node) -> bool| {
        let mut factors = factors.iter();
        factors.any(|&(id, power)| {
            power > 0 && wanted(&dag.node(id)) && dag.expr(id).stage() > stage::PARAMETER
        })
    };
    is(&|node| matches!(node, Node::Sum(_))) && !is(&|node| matches!(node, Node::Function(..)))
}
