//! Runs of machines for which the spec names a second chart: they are made in Cartesian coordinates, in which nothing is singular at
//! the centre, and shown in the polar coordinates of the spec. Commands and sweeps share it.
//!
//! The maps between the two, and the turns of the angles, are those of the runtime ([`Turns`]).

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lagrangian::interpreted::{
    Column, ColumnKind, InterpretedMachine, InterpretedSystem, Named, Recording,
};
use lagrangian::{Error, InputLaw, Solution, State, StepMotion, Turns, to_cartesian};
use lagrangian_spec::model::Model;
use lagrangian_spec::unit::{rate_name, rate_unit};

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
    turns: Mutex<Turns>,
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

    /// The indices of the coordinates of each.
    pub fn places(&self) -> Vec<[usize; 2]> {
        self.0.iter().map(|point| point.places).collect()
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
        for Point { places, polar, .. } in &*points.0 {
            let s = stated.q.values[places[0]];
            if s < 0.0 {
                // The opposite point, with a positive distance, is the same place, but a force of `s` would be another one there.
                let [(distance, unit), (angle, _)] = polar;
                return Err(format!(
                    "the distance `{distance}` is {s:?} {unit} at the start: the run is in the Cartesian coordinates that `charts` names, in which \
                     it is not negative; start from the positive distance with `{angle}` changed by pi, or leave `charts` out of the spec"
                ));
            }
        }
        let places = points.places();
        to_cartesian(&places, &mut start.q.values, &mut start.v.values);
        let turns = Turns::begin(&places, stated.t, &stated.q.values);
        let charts = Charts {
            points: points.clone(),
            stated: stated.clone(),
            start: start.clone(),
            turns: Mutex::new(turns),
        };
        Ok((charts, start))
    }

    fn turns(&self) -> MutexGuard<'_, Turns> {
        self.turns.lock().unwrap_or_else(PoisonError::into_inner)
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
        self.turns().follow(step, interval)
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
        self.turns()
            .to_polar(state.t, &mut shown.q.values, &mut shown.v.values);
        shown
    }

    /// The state of the run with these coordinates and rates of the spec.
    pub fn in_run(&self, t: f64, q: &[f64], v: &[f64]) -> State<Named> {
        let mut state = self.start.clone();
        state.t = t;
        state.q.values.copy_from_slice(q);
        state.v.values.copy_from_slice(v);
        let places = self.points.places();
        to_cartesian(&places, &mut state.q.values, &mut state.v.values);
        state
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
