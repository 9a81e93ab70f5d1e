//! What these tests share: machines from texts and files, and points at which to evaluate them.

use std::path::{Path, PathBuf};

use lagrangian_mechanics::{Equations, Symmetric};
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Expr, Symbol, Tangent, evaluate};

/// The number of points at which identities are checked.
pub const POINTS: usize = 3;

/// Resolves and derives a machine whose files are in the library; panics with the messages if there are errors.
pub fn derived<R>(text: &str, look: impl for<'d> FnOnce(&Model<'d>, &Equations<'d>) -> R) -> R {
    resolved(text, |model| {
        let mut report = Report::new();
        let equations = Equations::derive(model, &mut report);
        let messages = report.diagnostics();
        look(model, &equations.unwrap_or_else(|| panic!("{messages:?}")))
    })
}

/// Resolves a machine.
pub fn resolved<R>(text: &str, look: impl for<'d> FnOnce(&Model<'d>) -> R) -> R {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let name = library()
        .join("test.machine")
        .to_string_lossy()
        .into_owned();
    let files = &mut Disk;
    let model = lagrangian_spec::model(&dag, &name, text, &[], files, &mut sources, &mut report);
    look(&model.unwrap_or_else(|| panic!("{}", report.render_short(&sources))))
}

/// The text of a machine of the library, or of these tests.
pub fn text_of(name: &str) -> String {
    let found = all_files()
        .into_iter()
        .find(|path| path.file_stem().is_some_and(|stem| stem == name));
    let path = found.unwrap_or_else(|| panic!("no machine {name}"));
    std::fs::read_to_string(path).expect("machines can be read")
}

/// Every machine of the library and of these tests, with its name.
pub fn all_machines() -> Vec<(String, String)> {
    let name = |path: &PathBuf| {
        path.file_stem()
            .expect("a file")
            .to_string_lossy()
            .into_owned()
    };
    let text = |path: &PathBuf| std::fs::read_to_string(path).expect("machines can be read");
    all_files()
        .iter()
        .map(|path| (name(path), text(path)))
        .collect()
}

fn all_files() -> Vec<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mechanics/tests/mechanics/machines");
    let entries =
        [library(), here].map(|folder| std::fs::read_dir(folder).expect("a folder of machines"));
    let paths = entries
        .into_iter()
        .flatten()
        .map(|entry| entry.expect("an entry").path());
    let mut machines: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "machine"))
        .collect();
    machines.sort();
    machines
}

/// The folder of the machines of the library.
pub fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines")
}

/// The values of expressions at some points of the prime field at which all of them are defined, with the accelerations of
/// `M a = f` if `moving`.
pub fn residues(
    model: &Model<'_>,
    equations: &Equations<'_>,
    expressions: &[Expr<'_>],
    moving: bool,
) -> Vec<Vec<Residue>> {
    let mut found = Vec::new();
    for seed in 0..4096 {
        let random = |symbol: Symbol| Residue::random(seed, symbol.index() as u64);
        let known = if moving {
            motion(model, equations, random)
        } else {
            Some(Vec::new())
        };
        let Some(known) = known else {
            continue;
        };
        let value = |symbol: Symbol| among(&known, symbol).unwrap_or_else(|| random(symbol));
        let values = evaluate(model.dag, expressions, value);
        if values.iter().all(|value| value.is_finite()) {
            found.push(values);
        }
        if found.len() == POINTS {
            return found;
        }
    }
    panic!("{}: no point at which everything has a value", model.name)
}

/// The values of symbols that the equations determine at a point.
type Known = Vec<(Symbol, Residue)>;

fn among(known: &Known, symbol: Symbol) -> Option<Residue> {
    let found = known.iter().find(|(known, _)| *known == symbol);
    found.map(|&(_, value)| value)
}

/// Velocities that satisfy the constraints, with the accelerations and multipliers there.
fn motion(
    model: &Model<'_>,
    equations: &Equations<'_>,
    random: impl Fn(Symbol) -> Residue,
) -> Option<Known> {
    let dag = model.dag;
    let constraints = &equations.constraints;
    let symbol = |e: Expr<'_>| e.as_symbol().expect("a symbol");
    // Projects velocities onto the constraints with the impulse that it takes: M Δv = Gᵀ μ and G Δv = −φ.
    let nothing = vec![dag.zero(); model.coordinates.len()];
    let rates = constraints.iter().map(|c| c.rate);
    let stopped = balanced(model, equations, nothing.into_iter().chain(rates), &random)?;
    let velocities = model.coordinates.iter().map(|c| symbol(c.v)).zip(stopped);
    let mut known: Known = velocities.map(|(v, by)| (v, random(v) + by)).collect();
    let value = |symbol: Symbol| among(&known, symbol).unwrap_or_else(|| random(symbol));
    // M a = f + Gᵀ λ and G a = γ.
    let drifts = constraints.iter().map(|c| -c.bias);
    let right = equations.forces.iter().copied().chain(drifts);
    let solution = balanced(model, equations, right, value)?;
    let symbols = model.coordinates.iter().map(|c| c.a);
    let symbols = symbols.chain(constraints.iter().map(|c| c.multiplier));
    let found: Known = symbols.map(symbol).zip(solution).collect();
    known.extend(found);
    Some(known)
}

/// Solves for x and y the system whose rows are `M x − Gᵀ y` and `−G x`.
fn balanced<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    right: impl Iterator<Item = Expr<'d>>,
    value: impl Fn(Symbol) -> Residue,
) -> Option<Vec<Residue>> {
    let dag = model.dag;
    let constraints = &equations.constraints;
    let rows = constraints.iter().enumerate().flat_map(|(k, c)| {
        let zeros = std::iter::repeat_n(dag.zero(), k + 1);
        c.row.iter().map(|&g| -g).chain(zeros)
    });
    let entries = equations.mass_matrix.lower().iter().copied().chain(rows);
    let entries = evaluate(dag, &entries.collect::<Vec<_>>(), &value);
    let mut entries = entries.into_iter();
    let size = model.coordinates.len() + constraints.len();
    let matrix = Symmetric::from_lower(size, |_, _| entries.next().expect("one for each"));
    solve(&matrix, &evaluate(dag, &right.collect::<Vec<_>>(), &value))
}

/// Gauß–Jordan elimination.
fn solve(matrix: &Symmetric<Residue>, right: &[Residue]) -> Option<Vec<Residue>> {
    let n = right.len();
    let row = |i| {
        (0..n)
            .map(move |j| *matrix.get(i, j))
            .chain([right[i]])
            .collect()
    };
    let mut rows: Vec<Vec<Residue>> = (0..n).map(row).collect();
    for k in 0..n {
        let pivot = (k..n).find(|&i| rows[i][k].is_finite() && rows[i][k] != Residue::ZERO)?;
        rows.swap(k, pivot);
        let scaled: Vec<Residue> = rows[k].iter().map(|&entry| entry / rows[k][k]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[k];
            for (entry, &pivot) in row.iter_mut().zip(&scaled) {
                *entry = if i == k {
                    pivot
                } else {
                    *entry - factor * pivot
                };
            }
        }
    }
    Some(rows.iter().map(|row| row[n]).collect())
}

/// The total time derivative.
pub fn total<'d>(model: &Model<'d>) -> Tangent<'d> {
    let symbol = |e: Expr| e.as_symbol().expect("a symbol");
    let of_coordinate =
        |c: &lagrangian_spec::model::Coordinate<'d>| [(symbol(c.q), c.v), (symbol(c.v), c.a)];
    let mut rates = vec![(symbol(model.time), model.dag.one())];
    rates.extend(model.coordinates.iter().flat_map(of_coordinate));
    Tangent::new(model.dag, &rates)
}
