//! Determines which bodies a guide carries, and on which bodies a force on a coordinate acts.
//!
//! The normal reaction of a guide is found by releasing its body (E33), and accounts for whatever
//! the spec builds on that body. Another body may move with the same coordinates without being
//! built on it. Then something that the spec does not name ties the two, and whether it pulls
//! across the guide cannot be known. This is detected by displacing the guided body *along* its
//! guide, where it can move anyway:
//!
//! ```text
//! J_δ e = J_q c + Σ α n_δ                                                  (E38)
//! ```
//!
//! `J` are the velocities of all bodies, by the rates of the coordinates (`q`) or by the displacements
//! of the guided bodies (`δ`). If a displacement along the guide is a motion of the machine, apart from
//! guides that open, then Newton's law along the guide holds for what the guide carries with the forces
//! that the spec names. If it is not, some force that the spec does not name has to act there. Both
//! sides are compared in the prime field, so the form of an expression does not matter.
//!
//! A body may also be free to move along the guide independently, and yet have its position expressed by the
//! coordinate of the guided body. Then (E38) holds, but what holds the body across the guide is just as undetermined.
//! So a body that moves with a coordinate of a guide must satisfy one of three conditions: this guide carries it;
//! another guide that moves with that coordinate carries it; or it can be moved across the guide while everything
//! else rests, alone or together with others of its kind. In the last case whatever ties it has no component across
//! the guide (virtual work), in whatever combination of coordinates its position is written.
//!
//! Everything else that depends on coordinates (constraints, springs, points of forces) is tested with
//! the same `c` and `α`. What depends on the position of the guided body changes by (E38) as the bodies
//! do. What does not is written in coordinates, and acts along the guide; if it cannot act along the
//! guide alone, it must be written in positions. A force on a coordinate acts on the bodies that the
//! coordinate moves. If the guide carries only some of them, and the force could not act on these alone,
//! its distribution among the bodies is undetermined.

mod coordinates;
mod numbers;
mod parts;

use lagrangian_scalar::{Dual, Residue};
use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Expr, Symbol, evaluate};

use super::guide;
use super::kinematics::{Variables, gradient};
use coordinates::CoordinateTests;
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::{FrameOrBody, Model};
use numbers::{Number, Numbers, Value, combination, dot};
use parts::{Part, PartKind, is_a_base, parts};

/// The number of points of the prime field that are tried until all expressions have a value at one
/// of them: each square root exists at every second point.
const TRIALS: u64 = 256;

/// The largest number of multiplications for testing (E38), if nothing is zero: some seconds.
const WORK_LIMIT: usize = 500_000_000;

/// The largest number of multiplications for finding the bodies that the spec does not connect.
const BODY_SEARCH_WORK_LIMIT: usize = 100_000_000;

/// The bodies that the guides of a machine carry, and the bodies on which forces on its coordinates act.
///
/// All lists are of indices, ascending: bodies as in [`Model::bodies`], guides as in [`Model::sliding`], where a
/// surface occurs twice, once for each tangent, coordinates as in [`Model::coordinates`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Carrying {
    /// For each guide, the bodies that move off with it: the guided body, and everything built on it.
    /// Their weight and inertia, with all forces on them in the spec, determine the normal reaction;
    /// if another guide lies between them and a further body, it transmits the load of that body.
    pub carried: Vec<Vec<usize>>,
    /// For each coordinate, the bodies that move while it changes and all other coordinates rest. A
    /// force on the coordinate acts on these.
    pub moved: Vec<Vec<usize>>,
    /// For each guide, the coordinates whose change is part of a displacement along it, the `c` of (E38): a
    /// force on such a coordinate pushes what the guide carries. If the coordinate moves nothing of that, or
    /// moves other bodies too in a way that forces on the carried ones alone cannot, it pushes through a tie
    /// whose pull across the guide is unknown, and the reaction is undetermined while a force acts on that
    /// coordinate. None if (E38) does not hold.
    pub coordinates_along: Vec<Option<Vec<usize>>>,
    /// For each guide, those among `coordinates_along` for which the reaction is undetermined.
    undetermined: Vec<Vec<usize>>,
}

impl Carrying {
    /// The analysis of a machine; nothing if it has no guides, or if its expressions have no values
    /// at any point tried.
    pub fn of(model: &Model<'_>) -> Option<Carrying> {
        let motion = PartVelocities::of(model, Numbers::OfField)
            .or_else(|| PartVelocities::of(model, Numbers::Real));
        motion.map(|motion| motion.carrying(model))
    }

    /// The coordinates on which a force would push what a guide carries through a tie whose pull
    /// across the guide the spec does not determine.
    pub fn undetermined(&self, guide: usize) -> &[usize] {
        &self.undetermined[guide]
    }
}

/// Reports for every guide what leaves its reaction undetermined. Returns true if anything does.
pub(super) fn refuse_undetermined_reactions(model: &Model<'_>, report: &mut Report) -> bool {
    let mut tested = Vec::new();
    let mut errors = PartVelocities::of(model, Numbers::OfField)
        .map_or_else(Vec::new, |motion| motion.errors(model, &mut tested));
    // Ordinary numbers are used if the prime field has no values for the motion, or for some of the forces.
    if errors.is_empty() && (tested.is_empty() || tested.contains(&false)) {
        errors = PartVelocities::of(model, Numbers::Real)
            .map_or_else(Vec::new, |motion| motion.errors(model, &mut tested));
    }
    let refused = !errors.is_empty();
    errors.into_iter().for_each(|found| report.push(found));
    refused
}

/// The velocities of all parts at a point: rows are components of velocities; columns are
/// coordinates, followed by the displacements of each guide, two in the plane and three in space.
struct PartVelocities {
    numbers: Numbers,
    parts: Vec<Part>,
    columns: Vec<Vec<Value>>,
    /// The directions of the guides, unnormalized, as in the spec.
    directions: Vec<Vec<Value>>,
    /// The normals of surfaces, unnormalized, as in the spec.
    normals: Vec<Option<Vec<Value>>>,
    /// The guide of each contact: a surface has two contacts, one for each tangent.
    guide_of_contact: Vec<usize>,
    coordinates: usize,
    /// The number of components of a vector.
    dimension: usize,
    /// The size of the entries.
    size: f64,
    point: u64,
}

/// A displacement along a guide as a motion of the machine: the coefficient of each column, minus the displacement itself.
struct DisplacementAlongGuide(Vec<Value>);

impl DisplacementAlongGuide {
    /// The difference between the change of an expression by the displacement along the guide and
    /// its change by the motion of the machine, given its derivatives.
    fn mismatch(&self, derivatives: impl Iterator<Item = Value>) -> Value {
        let pairs = self.0.iter().zip(derivatives);
        pairs.fold(Value::ZERO, |sum, (&c, x)| sum + c * x)
    }
}

/// The positions of the guides.
#[derive(Clone, Copy, PartialEq)]
enum GuideDisplacements {
    /// At zero.
    Zero,
    /// At arbitrary displacements. Whatever moves off with a body moves by the displacement itself, so
    /// (E38) holds with the same `c` and `α`. A force between two points shows that it depends on both,
    /// even if it does no work while the guides are at zero, like a spring straight across one.
    Arbitrary,
}

/// The machine with relaxed guides, and the values of its symbols at a point.
struct Relaxed<'m, 'd> {
    numbers: Numbers,
    model: &'m Model<'d>,
    x: Variables<'d>,
    coordinates: usize,
}

impl<'m, 'd> Relaxed<'m, 'd> {
    fn of(model: &'m Model<'d>, numbers: Numbers) -> Option<Relaxed<'m, 'd>> {
        let relaxed = model.relaxed.as_deref()?;
        Some(Relaxed {
            numbers,
            model: relaxed,
            x: Variables::of(relaxed),
            coordinates: model.coordinates.len(),
        })
    }

    /// The value of a symbol with all guides at zero, or displaced.
    fn value<T: Number>(&self, (point, guides): (u64, GuideDisplacements), symbol: Symbol) -> T {
        let open = |symbols: &[Symbol]| symbols[self.coordinates..].contains(&symbol);
        if guides == GuideDisplacements::Zero && (open(&self.x.q) || open(&self.x.v)) {
            T::ZERO
        } else {
            T::random(point, symbol)
        }
    }

    /// The values of some expressions.
    fn values(&self, at: (u64, GuideDisplacements), expressions: &[Expr<'d>]) -> Vec<Value> {
        match self.numbers {
            Numbers::OfField => self.values_in::<Residue>(at, expressions),
            Numbers::Real => self.values_in::<f64>(at, expressions),
        }
    }

    fn values_in<T: Number>(
        &self,
        at: (u64, GuideDisplacements),
        expressions: &[Expr<'d>],
    ) -> Vec<Value> {
        let values = evaluate(self.model.dag, expressions, |symbol| {
            self.value::<T>(at, symbol)
        });
        values.into_iter().map(T::into).collect()
    }

    /// The derivatives of some expressions with respect to the coordinates, or to their rates: one
    /// list for each column.
    fn derivatives(
        &self,
        at: (u64, GuideDisplacements),
        expressions: &[Expr<'d>],
        by: &[Symbol],
    ) -> Vec<Vec<Value>> {
        let column = |&variable: &Symbol| match self.numbers {
            Numbers::OfField => self.derivatives_in::<Residue>(at, expressions, variable),
            Numbers::Real => self.derivatives_in::<f64>(at, expressions, variable),
        };
        by.iter().map(column).collect()
    }

    fn derivatives_in<T: Number>(
        &self,
        at: (u64, GuideDisplacements),
        expressions: &[Expr<'d>],
        variable: Symbol,
    ) -> Vec<Value> {
        let values = evaluate(self.model.dag, expressions, |symbol| {
            let value = self.value::<T>(at, symbol);
            if symbol == variable {
                Dual::variable(value)
            } else {
                Dual::constant(value)
            }
        });
        values.into_iter().map(|x| x.derivative.into()).collect()
    }
}

impl Relaxed<'_, '_> {
    /// The guides along which (E38) also holds if the guides are displaced: bodies that are not built from frames
    /// and points alone may move off by more than the displacement.
    fn guides_that_may_be_displaced(
        &self,
        motion: &PartVelocities,
        displacements: &[(usize, DisplacementAlongGuide)],
    ) -> Vec<usize> {
        let (_, places) = parts(self.model);
        let columns = self.derivatives(
            (motion.point, GuideDisplacements::Arbitrary),
            &places,
            &self.x.q,
        );
        let is_met = |along: &DisplacementAlongGuide, row: usize| {
            let mismatch = along.mismatch(columns.iter().map(|column| column[row]));
            mismatch.is_finite() && mismatch.size_relative_to(motion.size) == 0.0
        };
        let hold = displacements
            .iter()
            .filter(|(_, along)| (0..places.len()).all(|row| is_met(along, row)));
        hold.map(|(guide, _)| *guide).collect()
    }
}

impl PartVelocities {
    fn of(model: &Model<'_>, numbers: Numbers) -> Option<PartVelocities> {
        PartVelocities::at_first_valid_point(model, numbers, 0..TRIALS)
    }

    /// The motion at the first of some points where everything has a value.
    fn at_first_valid_point(
        model: &Model<'_>,
        numbers: Numbers,
        mut points: std::ops::Range<u64>,
    ) -> Option<PartVelocities> {
        if model.sliding().is_empty() {
            return None;
        }
        let relaxed = Relaxed::of(model, numbers)?;
        let (parts, expressions) = parts(relaxed.model);
        let directions: Vec<Expr<'_>> = model
            .sliding()
            .into_iter()
            .flat_map(|s| s.direction.iter().copied())
            .collect();
        let normals: Vec<Expr<'_>> = (model.sliding().into_iter())
            .filter(|s| s.tangent.is_some())
            .flat_map(|s| s.normal.iter().flatten().copied())
            .collect();
        let all = expressions.iter().chain(&directions).chain(&normals);
        let all: Vec<Expr<'_>> = all.copied().collect();
        let values = |point| relaxed.values((point, GuideDisplacements::Zero), &all);
        let (point, values) = points
            .by_ref()
            .map(|point| (point, values(point)))
            .find(|(_, values)| values.iter().all(|x| x.is_finite()))?;
        let at_zero = (point, GuideDisplacements::Zero);
        let columns = relaxed.derivatives(at_zero, &expressions, &relaxed.x.q);
        let entries = columns.iter().flatten();
        let size = entries.map(|x| x.size_relative_to(0.0)).fold(0.0, f64::max);
        Some(PartVelocities {
            numbers,
            parts,
            columns,
            guide_of_contact: guide::guides_of(model),
            normals: {
                let of_surfaces = &values[expressions.len() + directions.len()..];
                let mut of_surfaces = of_surfaces.chunks_exact(model.space.dimension());
                let normal = |s: &Sliding<'_>| s.tangent.and_then(|_| of_surfaces.next());
                let normals = model.sliding().into_iter().map(normal);
                normals
                    .map(|normal| normal.map(<[Value]>::to_vec))
                    .collect()
            },
            directions: values[expressions.len()..][..directions.len()]
                .chunks_exact(model.space.dimension())
                .map(<[Value]>::to_vec)
                .collect(),
            coordinates: relaxed.coordinates,
            dimension: model.space.dimension(),
            size,
            point,
        })
    }

    /// The columns of the displacements of a guide, which are the same for both tangents of a surface.
    fn columns_of(&self, guide: usize) -> Vec<usize> {
        let first = self.coordinates + self.dimension * self.guide_of_contact[guide];
        (first..first + self.dimension).collect()
    }

    /// A combination of the displacements of a guide.
    fn displaced(&self, guide: usize, by: &[Value], row: usize) -> Value {
        let own = self.columns_of(guide).into_iter().zip(by);
        own.map(|(column, &by)| by * self.columns[column][row])
            .fold(Value::ZERO, |sum, term| sum + term)
    }

    /// Vectors that span the directions across a guide: one in the plane and for a surface; for a curve in space three, one of which
    /// depends on the others.
    fn across(&self, guide: usize) -> Vec<Vec<Value>> {
        let zero = Value::ZERO;
        if let Some(normal) = &self.normals[guide] {
            return vec![normal.clone()];
        }
        match self.directions[guide][..] {
            [x, y] => vec![vec![-y, x]],
            [x, y, z] => vec![vec![-y, x, zero], vec![-z, zero, x], vec![zero, -z, y]],
            _ => Vec::new(),
        }
    }

    /// Whether a pull has a component across a guide.
    fn is_across(&self, guide: usize, pull: &[Value]) -> bool {
        let across = self.across(guide);
        across
            .iter()
            .any(|n| dot(n, pull).size_relative_to(1.0) != 0.0)
    }

    /// The displacement along a guide as a motion of the machine with guides that may open,
    /// compared in some rows; none if it is not such a motion.
    fn along(&self, guide: usize, rows: &[usize]) -> Option<DisplacementAlongGuide> {
        let e = &self.directions[guide];
        let target: Vec<Value> = rows
            .iter()
            .map(|&row| self.displaced(guide, e, row))
            .collect();
        let mut columns: Vec<Vec<Value>> = self.columns[..self.coordinates]
            .iter()
            .map(|column| rows.iter().map(|&row| column[row]).collect())
            .collect();
        let guides = 0..self.directions.len();
        let normals = guides.flat_map(|other| {
            let across = self.across(other).into_iter();
            across.map(move |normal| (other, normal))
        });
        let normals: Vec<(usize, Vec<Value>)> = normals.collect();
        for (other, normal) in &normals {
            let opened = |&row: &usize| self.displaced(*other, normal, row);
            columns.push(rows.iter().map(opened).collect());
        }
        let solved = match self.by_single_coordinate(&columns, &target) {
            Some(solved) => solved,
            None => combination(columns, target, self.size)?,
        };
        // Converts coefficients of normals to displacements along the axes.
        let mut all = solved[..self.coordinates].to_vec();
        all.resize(self.columns.len(), Value::ZERO);
        for ((other, normal), &alpha) in normals.iter().zip(&solved[self.coordinates..]) {
            for (column, &n) in self.columns_of(*other).into_iter().zip(normal) {
                all[column] = all[column] + alpha * n;
            }
        }
        for (column, &e) in self.columns_of(guide).into_iter().zip(e) {
            all[column] = all[column] - e;
        }
        Some(DisplacementAlongGuide(all))
    }

    /// The common case: the displacement is that of a single coordinate.
    fn by_single_coordinate(&self, columns: &[Vec<Value>], target: &[Value]) -> Option<Vec<Value>> {
        let is_zero = |x: Value| x.size_relative_to(self.size) == 0.0;
        let row = target.iter().position(|&x| !is_zero(x))?;
        let fits = |column: &Vec<Value>| {
            if is_zero(column[row]) {
                return false;
            }
            let factor = target[row] / column[row];
            let mut pairs = target.iter().zip(column);
            pairs.all(|(&x, &y)| is_zero(x - factor * y))
        };
        let fitting = columns[..self.coordinates].iter().position(fits)?;
        let mut solved = vec![Value::ZERO; columns.len()];
        solved[fitting] = target[row] / columns[fitting][row];
        Some(solved)
    }

    /// The rows of some parts.
    fn rows(&self, of: impl Fn(usize) -> bool) -> Vec<usize> {
        let parts = self.parts.iter().enumerate().filter(|(k, _)| of(*k));
        parts.flat_map(|(_, part)| part.rows.clone()).collect()
    }

    /// Whether a part moves by one of these columns.
    fn moves(&self, part: &Part, columns: &[usize]) -> bool {
        columns.iter().any(|&column| {
            let mut rows = self.columns[column][part.rows.clone()].iter();
            rows.any(|x| x.size_relative_to(self.size) != 0.0)
        })
    }

    fn bodies_moved_by(&self, columns: &[usize]) -> Vec<usize> {
        let moving = self.parts.iter().filter(|part| self.moves(part, columns));
        let bodies = moving.filter_map(|part| match part.kind {
            PartKind::Body(body) => Some(body),
            PartKind::Base(_) => None,
        });
        bodies.collect()
    }

    fn work(&self) -> usize {
        let rows = self.parts.last().map_or(0, |part| part.rows.end);
        let columns = self.columns.len();
        rows.saturating_mul(columns).saturating_mul(columns)
    }

    fn carrying(&self, model: &Model<'_>) -> Carrying {
        let guides = 0..model.sliding().len();
        let rows = self.rows(|_| true);
        let is_in = |x: Value| x.size_relative_to(self.size) != 0.0;
        Carrying {
            carried: guides
                .clone()
                .map(|k| self.bodies_moved_by(&self.columns_of(k)))
                .collect(),
            moved: (0..self.coordinates)
                .map(|i| self.bodies_moved_by(&[i]))
                .collect(),
            coordinates_along: guides
                .clone()
                .map(|k| {
                    let DisplacementAlongGuide(along) = self.along(k, &rows)?;
                    Some((0..self.coordinates).filter(|&i| is_in(along[i])).collect())
                })
                .collect(),
            undetermined: guides
                .map(|k| {
                    let along = self.along(k, &rows);
                    let undetermined = |i: &usize| {
                        let mut forces = vec![Value::ZERO; self.coordinates];
                        forces[*i] = Value::ONE;
                        let undetermined = |along| self.is_undetermined(k, along, &forces);
                        along.as_ref().is_some_and(undetermined)
                    };
                    (0..self.coordinates).filter(undetermined).collect()
                })
                .collect(),
        }
    }

    /// Whether forces on the coordinates push what a guide carries along it, with an undetermined pull
    /// across the guide; `along` gives the coordinates by which it moves. This is so if such a coordinate
    /// moves nothing that is carried, or if it moves other bodies too and the forces are not equivalent
    /// to forces on the carried bodies alone, so that an unknown part of them acts on the others.
    fn is_undetermined(
        &self,
        guide: usize,
        along: &DisplacementAlongGuide,
        forces: &[Value],
    ) -> bool {
        let carried = self.bodies_moved_by(&self.columns_of(guide));
        let is_carried = |body: &usize| carried.contains(body);
        let is_in = |x: Value| x.size_relative_to(self.size) != 0.0;
        // Scaled to the size of the entries of the matrix.
        let sizes = forces.iter().map(|x| x.size_relative_to(0.0));
        let scale = self
            .numbers
            .number(self.size / sizes.fold(f64::MIN_POSITIVE, f64::max));
        let forces: Vec<Value> = forces.iter().map(|&x| scale * x).collect();
        let mut moves_others = false;
        for i in (0..self.coordinates).filter(|&i| is_in(forces[i]) && is_in(along.0[i])) {
            let moved = self.bodies_moved_by(&[i]);
            if !moved.iter().any(is_carried) {
                return true;
            }
            moves_others |= !moved.iter().all(is_carried);
        }
        if !moves_others {
            return false;
        }
        // Forces on the carried bodies are combinations of the derivatives of their positions.
        let rows = self.rows(|k| match self.parts[k].kind {
            PartKind::Body(body) => carried.contains(&body),
            PartKind::Base(_) => false,
        });
        let places = rows.iter().map(|&row| {
            let columns = self.columns[..self.coordinates].iter();
            columns.map(|column| column[row]).collect()
        });
        combination(places.collect(), forces, self.size).is_none()
    }

    /// A message for each thing that leaves a reaction undetermined. `tested` records which forces
    /// were tested; those without a value at any point were not.
    fn errors(&self, model: &Model<'_>, tested: &mut Vec<bool>) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let Some(relaxed) = Relaxed::of(model, self.numbers) else {
            return found;
        };
        let rows = self.rows(|_| true);
        let mut displacements = Vec::new();
        for (guide, sliding) in model.sliding().into_iter().enumerate() {
            match self.along(guide, &rows) {
                Some(along) => displacements.push((guide, along)),
                None if self.work() > WORK_LIMIT => {
                    let message = format!(
                        "what the guide `{}` carries cannot be determined: there are too many bodies",
                        sliding.name_in_spec()
                    );
                    found.push(Diagnostic::new(Code::TooLarge, sliding.span, message).help(
                        "it can be determined if everything that moves with the guided body is built on its frame",
                    ));
                }
                // For a surface it was reported with the first tangent.
                None if sliding.is_second() && !found.is_empty() => {}
                None => found.extend(self.unconnected_parts(model, guide, sliding)),
            }
        }
        // The remaining tests may pass once the bodies are connected, so they wait.
        if found.is_empty() {
            found = self.free_bodies(model);
        }
        if !found.is_empty() {
            return found;
        }
        let written = |motion: &Self,
                       displacements: &[(usize, DisplacementAlongGuide)],
                       tested: &mut Vec<bool>| {
            let written = CoordinateTests {
                motion,
                relaxed: &relaxed,
                model,
                displacements,
                displaceable: relaxed.guides_that_may_be_displaced(motion, displacements),
            };
            written.errors(tested)
        };
        found = written(self, &displacements, tested);
        // A distance has a value at every second point.
        let mut next = self.point + 1;
        for _ in 0..self.numbers.force_trials() {
            if !found.is_empty() || !tested.contains(&false) {
                break;
            }
            let points = next..next + TRIALS;
            let Some(motion) = PartVelocities::at_first_valid_point(model, self.numbers, points)
            else {
                break;
            };
            next = motion.point + 1;
            let displacements: Option<Vec<(usize, DisplacementAlongGuide)>> = displacements
                .iter()
                .map(|(guide, _)| Some((*guide, motion.along(*guide, &rows)?)))
                .collect();
            if let Some(displacements) = displacements {
                found = written(&motion, &displacements, tested);
            }
        }
        found
    }

    /// Bodies that are free along a guide, have positions expressed by its coordinate, and are held
    /// across it by something that the spec does not name.
    fn free_bodies(&self, model: &Model<'_>) -> Vec<Diagnostic> {
        let sliding = model.sliding();
        let guides: Vec<usize> = (0..sliding.len()).collect();
        let slides: Vec<Vec<bool>> = guides
            .iter()
            .map(|&k| coordinates_in_slip(model, k))
            .collect();
        let is_carried = |part: &Part, guide: usize| self.moves(part, &self.columns_of(guide));
        let base_moves = |guide: usize, i: usize| {
            let base = self.parts.iter().find(|part| match part.kind {
                PartKind::Body(body) => sliding[guide].on == FrameOrBody::Body(body),
                PartKind::Base(of) => of == guide,
            });
            base.is_some_and(|base| self.moves(base, &[i]))
        };
        let mut found: Vec<(usize, usize)> = Vec::new();
        for (index, part) in self.parts.iter().enumerate() {
            let PartKind::Body(body) = part.kind else {
                continue;
            };
            if is_a_base(model, body) {
                continue;
            }
            let is_loose = |&guide: &usize, i: usize| {
                let holds = |&other: &usize| {
                    is_carried(part, other) && (slides[other][i] || base_moves(other, i))
                };
                slides[guide][i]
                    && self.moves(part, &[i])
                    && !is_carried(part, guide)
                    && !guides.iter().any(holds)
            };
            let of_guide = |guide: &&usize| (0..self.coordinates).any(|i| is_loose(guide, i));
            let of_guides = guides.iter().filter(of_guide);
            found.extend(of_guides.map(|&guide| (index, guide)));
        }
        // Bodies that are tied to each other move together.
        let all: Vec<usize> = found.iter().map(|(part, _)| *part).collect();
        found.retain(|&(part, guide)| {
            !self.is_free_across(guide, &[part]) && !self.is_free_across(guide, &all)
        });
        found.dedup_by_key(|(part, _)| *part);
        let to_diagnostic =
            |(part, guide): (usize, usize)| unconnected_part(model, guide, self.parts[part].kind);
        found.into_iter().map(to_diagnostic).collect()
    }

    /// Whether some parts can be moved across a guide as one while everything else rests and no guide opens.
    /// Then, by virtual work, the forces that tie them to each other and to everything else have no resultant
    /// across the guide.
    fn is_free_across(&self, guide: usize, parts: &[usize]) -> bool {
        let is_free = |by: Vec<Value>| {
            let mut target = Vec::new();
            for (index, part) in self.parts.iter().enumerate() {
                // The components of a position, and the orientation if it matters.
                let is_moved = parts.contains(&index);
                target.extend((0..part.rows.len()).map(|row| match by.get(row) {
                    Some(&by) if is_moved => by,
                    _ => Value::ZERO,
                }));
            }
            let columns = self.columns[..self.coordinates].to_vec();
            combination(columns, target, self.size).is_some()
        };
        self.across(guide).into_iter().all(is_free)
    }

    /// The bodies that the spec does not tie to what a guide carries: without them (E38) holds.
    fn unconnected_parts(
        &self,
        model: &Model<'_>,
        guide: usize,
        sliding: &Sliding<'_>,
    ) -> Vec<Diagnostic> {
        let body = &model.bodies[sliding.body].name;
        let name = sliding.name_in_spec();
        let own = self.columns_of(guide);
        let is_own = |part: &Part| matches!(part.kind, PartKind::Body(b) if b == sliding.body);
        let mut unconnected: Vec<bool> = self.parts.iter().map(|part| !is_own(part)).collect();
        let is_right = |unconnected: &[bool]| {
            let rows = self.rows(|k| !unconnected[k]);
            self.along(guide, &rows).is_some()
        };
        let affordable = self.work().saturating_mul(self.parts.len()) <= BODY_SEARCH_WORK_LIMIT;
        if affordable && is_right(&unconnected) {
            // Parts that the guide carries are named last.
            let mut order: Vec<usize> = (0..self.parts.len()).collect();
            sort_by_key(&mut order, |&k| !self.moves(&self.parts[k], &own));
            for k in order {
                let before = std::mem::replace(&mut unconnected[k], false);
                if before && !is_right(&unconnected) {
                    unconnected[k] = true;
                }
            }
        } else {
            unconnected.fill(false);
        }
        let pairs = self.parts.iter().zip(&unconnected);
        let diagnostics: Vec<Diagnostic> = pairs
            .filter(|(_, unconnected)| **unconnected)
            .map(|(part, _)| unconnected_part(model, guide, part.kind))
            .collect();
        if !diagnostics.is_empty() {
            return diagnostics;
        }
        let message = format!(
            "something moves with `{body}`, but the spec does not state what connects them: what the guide `{name}` carries is not determined"
        );
        let help = "build what it carries on its frame; or give that coordinates of its own and connect it by `constraints`";
        vec![Diagnostic::new(Code::Untied, sliding.span, message).help(help)]
    }
}

/// The message for a part that moves with the body of a guide without being tied to it.
fn unconnected_part(model: &Model<'_>, guide: usize, part: PartKind) -> Diagnostic {
    let sliding = model.sliding()[guide];
    let (body, name) = (&model.bodies[sliding.body].name, sliding.name_in_spec());
    let message = |subject: &str| {
        format!(
            "{subject} moves with `{body}`, but the spec does not state what connects them: what the guide `{name}` carries is not determined"
        )
    };
    let diagnostic = match part {
        PartKind::Body(other) => {
            let other = &model.bodies[other];
            let message = message(&format!("`{}`", other.name));
            Diagnostic::new(Code::Untied, other.position_span, message).help(format!(
                "build `{}` on the frame of `{body}`, so that the guide carries it; or give it coordinates of its own, and connect it by `constraints`",
                other.name
            ))
        }
        PartKind::Base(other) => {
            let other = model.sliding()[other];
            let message = message(&format!("what `{}` slides on", other.name_in_spec()));
            Diagnostic::new(Code::Untied, other.span, message).help(format!(
                "write `on: {body}`, or build that frame on the frame of `{body}`"
            ))
        }
    };
    diagnostic.note(sliding.span, "this guide")
}

/// For each coordinate whether its rate occurs in the slip of a guide.
fn coordinates_in_slip(model: &Model<'_>, guide: usize) -> Vec<bool> {
    let x = Variables::of(model);
    let sliding = model.sliding()[guide];
    let directions = guide::guide(model, sliding);
    let slip = guide::relative(
        model,
        sliding,
        &directions,
        &mut x.without_acceleration(model),
    )
    .slip;
    let row = gradient(model.dag, slip, &x.v);
    row.into_iter()
        .map(|entry| identity::is_zero(entry) != Some(true))
        .collect()
}
