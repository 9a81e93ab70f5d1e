//! Runs of machines for which the spec names a second chart: they are made in Cartesian coordinates, in which nothing is singular at
//! the centre, and shown in the polar coordinates of the spec. Commands and sweeps share it.
//!
//! A distance and the direction of an angle follow from the components at each instant. How often the angle has turned does not, so
//! an observer follows it through every step.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lagrangian::interpreted::{
    Column, ColumnKind, InterpretedMachine, InterpretedSystem, Named, Recording,
};
use lagrangian::{Error, InputLaw, Solution, State, StepMotion};
use lagrangian_spec::model::Model;
use lagrangian_spec::unit::{rate_name, rate_unit};

/// The parts of a step between which the angle is looked at, at least; a step by series is longer.
const PARTS: u32 = 8;
const PARTS_OF_SERIES: u32 = 64;

/// The largest turn from one look to the next, in rad.
const LARGEST_TURN: f64 = 0.5;

/// The shortest part of a step. A body that turns by more within it goes through the centre, to rounding.
const SHORTEST: f64 = 1e-15;

/// The largest turn from a mark to an instant that is referred to it, in rad.
const BETWEEN_MARKS: f64 = 1.0;

/// The points of a machine that are given in two charts.
#[derive(Clone, Debug)]
pub struct ChartedPoints(Arc<[Point]>);

/// The points of a machine that are given in two charts, and how far each has turned in a run.
#[derive(Debug)]
pub struct Charts {
    points: ChartedPoints,
    /// The start as the call gives it, in the coordinates of the spec, and the same in those of the run.
    stated: State<Named>,
    start: State<Named>,
    turned: Mutex<Vec<Turned>>,
}

/// A point in two charts.
#[derive(Debug)]
struct Point {
    /// The indices of its coordinates, in both charts.
    places: [usize; 2],
    /// Names and units of its polar coordinates.
    polar: [(String, String); 2],
    /// The names of its Cartesian ones.
    cartesian: [String; 2],
}

/// How far a point has turned about its centre.
#[derive(Debug)]
struct Turned {
    /// The direction in which it was seen last; the centre itself is in none.
    direction: [f64; 2],
    /// The angle of this direction, with all its turns.
    angle: f64,
    /// Angles with the times from which they may be referred to: from one to the next the point turns by less than half a turn.
    marks: Vec<(f64, f64)>,
}

impl ChartedPoints {
    /// Those of a machine in the coordinates of the spec.
    pub fn of(model: &Model<'_>) -> ChartedPoints {
        let points = model.charts.iter().map(|charts| Point {
            places: charts.polar,
            polar: charts.polar.map(|index| {
                let coordinate = &model.coordinates[index];
                (coordinate.name.to_string(), coordinate.unit_text.clone())
            }),
            cartesian: [0, 1].map(|k| charts.cartesian[k].to_string()),
        });
        ChartedPoints(points.collect())
    }

    /// Checks the names of start values that are kept, coordinates and `der(…)` of these.
    ///
    /// # Errors
    /// If one is a polar coordinate, which the run does not have: which.
    pub fn check_kept(&self, names: &[String]) -> Result<(), String> {
        for name in names {
            let rate = name.strip_prefix("der(");
            let coordinate = rate.and_then(|rest| rest.strip_suffix(')'));
            let coordinate = coordinate.unwrap_or(name);
            let mut polar = self.0.iter().flat_map(|point| &point.polar);
            if polar.any(|(polar, _)| polar == coordinate) {
                return Err(format!(
                    "--keep {name}: the run is in the Cartesian coordinates that `charts` names, so it cannot keep this value alone; \
                     keep others, or leave `charts` out of the spec"
                ));
            }
        }
        Ok(())
    }
}

impl Charts {
    /// The charts of a run that begins at `stated` in the coordinates of the spec, and the same start in those of the run. `start` is any
    /// state of the machine in Cartesian coordinates.
    ///
    /// # Errors
    /// If a distance is negative at the start.
    pub fn begin(
        points: &ChartedPoints,
        mut start: State<Named>,
        stated: &State<Named>,
    ) -> Result<(Charts, State<Named>), String> {
        start.t = stated.t;
        start.q.values.clone_from(&stated.q.values);
        start.v.values.clone_from(&stated.v.values);
        let mut turned = Vec::new();
        for Point {
            places: [i, j],
            polar,
            ..
        } in &*points.0
        {
            let (q, v) = (&stated.q.values, &stated.v.values);
            let (s, phi) = (q[*i], q[*j]);
            if s < 0.0 {
                // The opposite point, with a positive distance, is the same place, but a force of `s` would be another one there.
                let [(distance, unit), (angle, _)] = polar;
                return Err(format!(
                    "the distance `{distance}` is {s:?} {unit} at the start: the run is in the Cartesian coordinates that `charts` names, in which \
                     it is not negative; start from the positive distance with `{angle}` changed by pi, or leave `charts` out of the spec"
                ));
            }
            let (sin, cos) = phi.sin_cos();
            start.q.values[*i] = s * cos;
            start.q.values[*j] = s * sin;
            start.v.values[*i] = v[*i] * cos - s * v[*j] * sin;
            start.v.values[*j] = v[*i] * sin + s * v[*j] * cos;
            turned.push(Turned {
                direction: [cos, sin],
                angle: phi,
                marks: vec![(stated.t, phi)],
            });
        }
        let charts = Charts {
            points: points.clone(),
            stated: stated.clone(),
            start: start.clone(),
            turned: Mutex::new(turned),
        };
        Ok((charts, start))
    }

    fn turned(&self) -> MutexGuard<'_, Vec<Turned>> {
        self.turned.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Follows the angles through a step of a run that is recorded every `interval` seconds.
    ///
    /// # Errors
    /// If the motion within the step cannot be evaluated.
    pub fn follow(
        &self,
        step: &mut dyn StepMotion<InterpretedMachine>,
        interval: f64,
    ) -> Result<(), Error> {
        let n = self.start.q.values.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        let mut turned = self.turned();
        let parts = if step.is_series() {
            PARTS_OF_SERIES
        } else {
            PARTS
        };
        let mut at = 0.0;
        // The next one is last.
        let ends = (1..=parts).rev();
        let mut ends: Vec<f64> = ends
            .map(|part| f64::from(part) / f64::from(parts))
            .collect();
        while let Some(theta) = ends.pop() {
            let t = step.state_at(theta, &mut q, &mut v)?;
            let pairs = self.points.0.iter().zip(&*turned);
            let turns: Vec<f64> = pairs
                .map(|(point, turned)| turned.turn_to(point.components(&q)))
                .collect();
            let middle = 0.5 * (at + theta);
            let is_far = turns.iter().any(|turn| turn.abs() > LARGEST_TURN);
            if is_far && theta - at > SHORTEST && at < middle && middle < theta {
                ends.extend([theta, middle]);
                continue;
            }
            let begin = self.start.t;
            for ((point, turned), turn) in self.points.0.iter().zip(&mut *turned).zip(turns) {
                turned.advance(point.components(&q), turn, t, (begin, interval));
            }
            at = theta;
        }
        Ok(())
    }

    /// A state of the run in the coordinates of the spec. The distance is not negative. At the centre itself, where the polar coordinates
    /// have no other value, the angle is that of the last direction, the rate of the distance is the speed, and that of the angle is 0.
    pub fn shown(&self, state: &State<Named>) -> State<Named> {
        let mut shown = self.stated.clone();
        let is_start = *state == self.start;
        let is_positive = |point: &Point| shown.q.values[point.places[0]] > 0.0;
        if is_start && self.points.0.iter().all(is_positive) {
            return shown;
        }
        shown.t = state.t;
        shown.q.values.clone_from(&state.q.values);
        shown.v.values.clone_from(&state.v.values);
        for (point, turned) in self.points.0.iter().zip(&*self.turned()) {
            let [i, j] = point.places;
            let ([x, y], [vx, vy]) = (
                point.components(&state.q.values),
                point.components(&state.v.values),
            );
            let s = x.hypot(y);
            let polar = if s > 0.0 {
                let (cos, sin) = (x / s, y / s);
                let angle = turned.angle_of([x, y], state.t);
                // The sum with 0 makes -0 an ordinary 0.
                [
                    (s, cos * vx + sin * vy),
                    (angle, (cos * vy - sin * vx) / s + 0.0),
                ]
            } else {
                [(s, vx.hypot(vy)), (turned.last_mark(state.t), 0.0)]
            };
            for (place, (q, v)) in [i, j].into_iter().zip(polar) {
                shown.q.values[place] = q;
                shown.v.values[place] = v;
            }
        }
        shown
    }

    /// A recording of these states with the polar coordinates in the places of the Cartesian ones.
    pub fn in_polar(&self, recording: &Recording, states: &[State<Named>]) -> Recording {
        let mut shown = recording.clone();
        let polar: Vec<State<Named>> = states.iter().map(|state| self.shown(state)).collect();
        for point in &*self.points.0 {
            for ((name, unit), (of, place)) in
                (point.polar.iter()).zip(point.cartesian.iter().zip(point.places))
            {
                for column in &mut shown.columns {
                    let values = |numbers: fn(&State<Named>) -> &Named| -> Vec<f64> {
                        let values = polar.iter().map(|state| numbers(state).values[place]);
                        values.collect()
                    };
                    if column.kind == ColumnKind::Coordinate && column.name == *of {
                        *column = Column {
                            name: name.clone(),
                            unit: unit.clone(),
                            kind: ColumnKind::Coordinate,
                            values: values(|state| &state.q),
                        };
                    } else if column.kind == ColumnKind::Rate && column.name == rate_name(of, "") {
                        *column = Column {
                            name: rate_name(name, ""),
                            unit: rate_unit(name, unit),
                            kind: ColumnKind::Rate,
                            values: values(|state| &state.v),
                        };
                    }
                }
            }
        }
        shown
    }

    /// A recording of these states with the polar coordinates after its outputs, for the page of a run, whose drawing needs the
    /// coordinates of the run.
    pub fn with_polar(&self, recording: &Recording, states: &[State<Named>]) -> Recording {
        let mut shown = recording.clone();
        let outputs = |column: &Column| column.kind == ColumnKind::Output;
        let after = shown.columns.iter().rposition(outputs);
        let rates = |column: &Column| column.kind == ColumnKind::Rate;
        let after = after.or(shown.columns.iter().rposition(rates));
        let mut place = after.map_or(0, |place| place + 1);
        let polar: Vec<State<Named>> = states.iter().map(|state| self.shown(state)).collect();
        for point in &*self.points.0 {
            for ((name, unit), index) in point.polar.iter().zip(point.places) {
                let column = Column {
                    name: name.clone(),
                    unit: unit.clone(),
                    kind: ColumnKind::Output,
                    values: polar.iter().map(|state| state.q.values[index]).collect(),
                };
                shown.columns.insert(place, column);
                place += 1;
            }
        }
        shown
    }
}

/// A state of a run in the coordinates of the spec.
pub fn shown(charts: Option<&Charts>, state: &State<Named>) -> State<Named> {
    match charts {
        Some(charts) => charts.shown(state),
        None => state.clone(),
    }
}

/// The recording of a run at these states, in the coordinates of the spec.
pub fn record<L: InputLaw<InterpretedSystem>>(
    run: &Solution<InterpretedMachine, L>,
    states: &[State<Named>],
    charts: Option<&Charts>,
) -> Recording {
    let recording = Recording::of(run, states);
    match charts {
        Some(charts) => charts.in_polar(&recording, states),
        None => recording,
    }
}

impl Point {
    fn components(&self, values: &[f64]) -> [f64; 2] {
        self.places.map(|place| values[place])
    }
}

impl Turned {
    /// The angle from the last direction to that of a point, within half a turn; 0 for the centre.
    fn turn_to(&self, [x, y]: [f64; 2]) -> f64 {
        let [a, b] = self.direction;
        // Scaled, so that products of small numbers do not vanish.
        let size = x.abs().max(y.abs());
        if size == 0.0 {
            return 0.0;
        }
        let (x, y) = (x / size, y / size);
        (a * y - b * x).atan2(a * x + b * y)
    }

    /// Goes on to the direction of a point, after a turn.
    fn advance(&mut self, [x, y]: [f64; 2], turn: f64, t: f64, (begin, interval): (f64, f64)) {
        let size = x.hypot(y);
        if size == 0.0 {
            return;
        }
        self.direction = [x / size, y / size];
        // The whole turns are counted, and the rest is exact, so that no error is summed.
        let angle = y.atan2(x);
        let sum = self.angle + turn;
        self.angle = nearest(angle, sum);
        let (since, marked) = self.marks.last().copied().unwrap_or((t, self.angle));
        if (self.angle - marked).abs() < BETWEEN_MARKS {
            return;
        }
        // A mark after which nothing is recorded before the next one is not needed.
        let periods = |t: f64| ((t - begin) / interval).abs();
        let is_used = (periods(t) + 1e-6).floor() >= (periods(since) - 1e-6).ceil();
        let is_kept = self.marks.len() < 2 || (interval.is_finite() && is_used);
        if !is_kept {
            self.marks.pop();
        }
        self.marks.push((t, self.angle));
    }

    /// The mark that a time of the run is referred to.
    fn last_mark(&self, t: f64) -> f64 {
        let (first, last) = (self.marks[0], self.marks[self.marks.len() - 1]);
        let direction = (last.0 - first.0).signum();
        let is_before = |(since, _): &(f64, f64)| (since - t) * direction <= 0.0;
        let after = self.marks.partition_point(is_before);
        self.marks[after.saturating_sub(1)].1
    }

    /// The angle of a point at a time of the run.
    fn angle_of(&self, [x, y]: [f64; 2], t: f64) -> f64 {
        nearest(y.atan2(x), self.last_mark(t))
    }
}

/// The angle that differs from `angle` by whole turns and is nearest to another.
fn nearest(angle: f64, other: f64) -> f64 {
    use std::f64::consts::TAU;
    angle + TAU * ((other - angle) / TAU).round()
}
