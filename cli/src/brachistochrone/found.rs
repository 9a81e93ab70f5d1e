//! The result, and the coordinates in which it is reported.

use std::f64::consts::{PI, TAU};

use lagrangian_brachistochrone::direct::{FastestMotion, Sought, Terrain, Trial};
use lagrangian_brachistochrone::{Brachistochrone, Lapse, Moment, Problem};
use lagrangian_units::rate_unit;
use serde_json::{Map, Value, json};

use super::tried;
use crate::numbers::shortest;
use crate::output;
use crate::recording::{Column, ColumnKind, Recording};

/// The number of intervals in which the motion is reported: equal parts of the turn of its direction, or of the time.
const MOMENTS: u32 = 200;

/// A fastest motion, from either method.
pub enum Motion<'d> {
    /// In closed form, under the conditions (17).
    Closed(Box<Brachistochrone>),
    /// By the direct method, if these are not met.
    Direct(Box<FastestMotion<'d>>),
}

impl Motion<'_> {
    /// The duration, in s.
    pub fn time(&self) -> f64 {
        match self {
            Self::Closed(motion) => motion.time(),
            Self::Direct(motion) => motion.sought().time(),
        }
    }

    /// The motion at a time, in s.
    pub fn at(&self, time: f64) -> Moment {
        match self {
            Self::Closed(motion) => motion.at(time),
            Self::Direct(motion) => motion.at(time),
        }
    }

    fn after_part(&self, part: f64) -> Moment {
        match self {
            Self::Closed(motion) => motion.after_part(part),
            Self::Direct(motion) => motion.at(part * motion.sought().time()),
        }
    }

    /// The problem, if its coefficients are constant.
    pub fn problem(&self) -> Option<&Problem> {
        match self {
            Self::Closed(motion) => Some(motion.problem()),
            Self::Direct(_) => None,
        }
    }

    /// Names of the guides.
    fn guides(&self) -> Vec<String> {
        match self {
            Self::Closed(motion) => {
                let guides = motion.problem().guides().iter();
                guides.map(|guide| guide.name.clone()).collect()
            }
            Self::Direct(motion) => motion.sought().terrain().guides(),
        }
    }

    fn violations(&self) -> Vec<Lapse> {
        match self {
            Self::Closed(motion) => motion.violations(),
            Self::Direct(motion) => motion.violations(),
        }
    }

    fn best_among_turns(&self) -> [f64; 2] {
        match self {
            Self::Closed(motion) => motion.best_among_turns(),
            Self::Direct(motion) => motion.best_among_turns(),
        }
    }
}

/// The end of the simulated motion.
#[derive(Clone, Debug)]
pub struct Arrival {
    /// The distance from the end, relative to the displacement, of the coordinate that is furthest off.
    pub off: f64,
}

/// The result, and the coordinates in which it is reported.
pub struct FastestResult<'d> {
    pub motion: Motion<'d>,
    pub moments: Vec<Moment>,
    /// ε of (30), in rad, at each moment, for two normal coordinates.
    pub angles: Option<Vec<f64>>,
    pub names: Vec<String>,
    units: Vec<String>,
    guides: Vec<String>,
    seconds: f64,
    best_among_turns: [f64; 2],
    /// Why there is no closed form.
    pub because: Vec<String>,
    /// The end of the motion simulated under the control forces.
    pub arrival: Result<Arrival, String>,
}

impl<'d> FastestResult<'d> {
    pub fn new(
        motion: Motion<'d>,
        names: Vec<String>,
        units: Vec<String>,
        seconds: f64,
    ) -> FastestResult<'d> {
        let moments = (0..=MOMENTS).map(|k| motion.after_part(f64::from(k) / f64::from(MOMENTS)));
        let moments: Vec<Moment> = moments.collect();
        let problem = motion.problem().filter(|_| names.len() == 2);
        let angles = problem.map(|problem| angles(problem, &moments));
        FastestResult {
            guides: motion.guides(),
            best_among_turns: motion.best_among_turns(),
            motion,
            moments,
            angles,
            names,
            units,
            seconds,
            because: Vec::new(),
            arrival: Err("it was not simulated".into()),
        }
    }

    /// The trials of the search.
    fn trials(&self) -> &[Trial] {
        match &self.motion {
            Motion::Closed(_) => &[],
            Motion::Direct(motion) => motion.sought().trials(),
        }
    }

    /// The constants C* of (22), in normal coordinates; otherwise the multipliers of the coordinates at the start.
    fn constants(&self) -> Vec<f64> {
        match &self.motion {
            Motion::Closed(motion) => {
                let c = motion.constants();
                let columns = motion.problem().normal_coordinates();
                let along = |k: &Vec<f64>| k.iter().zip(&c).map(|(k, c)| k * c).sum();
                columns.iter().map(along).collect()
            }
            Motion::Direct(motion) => motion.sought().costs().to_vec(),
        }
    }

    /// The friction constant of the closed form, and the total turn of the direction.
    fn turn(&self) -> Option<[f64; 2]> {
        match &self.motion {
            Motion::Closed(motion) => Some([motion.kappa(), motion.turn()]),
            Motion::Direct(_) => None,
        }
    }

    /// The largest power of all control forces together, in W, which should be round-off.
    fn power(&self) -> f64 {
        let power = |moment: &Moment| {
            let parts = moment.control.iter().zip(&moment.v);
            parts.map(|(u, v)| u * v).sum::<f64>().abs()
        };
        self.moments.iter().map(power).fold(0.0, f64::max)
    }

    /// The least normal reaction of a guide, in N, and its time.
    fn least_reaction(&self, guide: usize) -> (f64, f64) {
        let values = self.moments.iter();
        let values = values.map(|moment| (moment.contacts[guide].reaction, moment.time));
        let less = |a: (f64, f64), b: (f64, f64)| if b.0 < a.0 { b } else { a };
        values.fold((f64::INFINITY, 0.0), less)
    }

    /// Numbers that describe the motion, with their units in their names.
    pub fn numbers(&self) -> Vec<(String, f64)> {
        let mut numbers = vec![("time [s]".to_owned(), self.motion.time())];
        let mut add = |name: String, value: f64| numbers.push((name, value));
        if let Some(angles) = &self.angles {
            add("ε at the start [rad]".into(), angles[0]);
            add("ε at the end [rad]".into(), angles[angles.len() - 1]);
        }
        for (k, c) in self.constants().iter().enumerate() {
            add(format!("C{}", k + 1), *c);
        }
        if let Some([kappa, turn]) = self.turn() {
            add("κ".into(), kappa);
            add("turn of the direction [rad]".into(), turn);
        }
        for (guide, name) in self.guides.iter().enumerate() {
            let (least, _) = self.least_reaction(guide);
            add(format!("least normal reaction of {name} [N]"), least);
        }
        let friction = self.moments.iter().map(|moment| moment.friction_power);
        add(
            "least power of friction [W]".into(),
            friction.fold(0.0, f64::min),
        );
        add(
            "greatest power of the control forces [W]".into(),
            self.power(),
        );
        if let Ok(arrival) = &self.arrival {
            add(
                "simulated, it misses the end by [of the distance]".into(),
                arrival.off,
            );
        }
        numbers
    }

    /// Whether it is a motion of the machine: the guides obey Coulomb's law, and the machine arrives under the control
    /// forces. Otherwise the computed time means nothing.
    pub fn is_motion(&self) -> bool {
        self.motion.violations().is_empty() && self.arrival.is_ok()
    }

    /// Warnings about guides that violate Coulomb's law, and about motions that may be faster.
    pub fn warnings(&self) -> Vec<String> {
        let describe = |lapse: &Lapse| {
            if lapse.backwards {
                format!(
                    "`{}` slides backwards from t = {} s: friction was taken to act against its `direction`",
                    lapse.guide,
                    shortest(lapse.time)
                )
            } else {
                format!(
                    "the normal reaction of `{}` is negative from t = {} s, with a minimum of {:.6} N: it would have to pull",
                    lapse.guide,
                    shortest(lapse.time),
                    lapse.least
                )
            }
        };
        let arrival = self.arrival.as_ref().err();
        let lost = arrival.map(|why| format!("simulated under the control forces, {why}"));
        let lapses = self.motion.violations();
        let lapses = lapses.iter().map(describe).chain(lost);
        lapses.chain(self.warning_of_unfinished()).collect()
    }

    /// A warning about candidates that may be faster but were not continued to a motion.
    fn warning_of_unfinished(&self) -> Option<String> {
        let Motion::Direct(motion) = &self.motion else {
            return None;
        };
        let least = motion
            .sought()
            .doubts()
            .into_iter()
            .min_by(f64::total_cmp)?;
        Some(format!(
            "there may be a faster motion: straight pieces, or an extremal that is not the fastest of its neighbours, take {least:.6} s; \
             `--guess` may help to find it"
        ))
    }

    fn by_name(&self, values: &[f64]) -> Value {
        let values = values.iter().map(|x| x + 0.0); // avoids −0 for coordinates at rest
        let pairs = self.names.iter().zip(values);
        pairs
            .map(|(name, x)| (name.clone(), json!(x)))
            .collect::<Map<_, _>>()
            .into()
    }

    pub fn document(&self) -> Value {
        let [less, more] = self.best_among_turns;
        let mut parameters = Map::new();
        if let Some([kappa, turn]) = self.turn() {
            parameters.insert("kappa".into(), json!(kappa));
            parameters.insert("turn".into(), json!(turn));
        }
        parameters.insert("best_among_turns".into(), json!([less, more]));
        if let Some(angles) = &self.angles {
            parameters.insert("epsilon_start".into(), json!(angles[0]));
            parameters.insert("epsilon_end".into(), json!(angles[angles.len() - 1]));
        }
        for (k, c) in self.constants().iter().enumerate() {
            parameters.insert(format!("C{}", k + 1), json!(c));
        }
        let path: Vec<Value> = (0..self.moments.len()).map(|k| self.moment(k)).collect();
        json!({
            "time": self.motion.time(),
            "is_motion": self.is_motion(),
            "parameters": parameters,
            "start": path[0],
            "end": path[path.len() - 1],
            "path": path,
            "warnings": self.warnings(),
            "seconds": self.seconds,
            "control_power": self.power(),
            "arrival": self.arrival.as_ref().ok().map(|arrival| arrival.off),
            "method": match &self.motion {
                Motion::Closed(_) => "closed form",
                Motion::Direct(_) => "direct",
            },
            "because": self.because,
            "tried": tried::document(self.trials(), &self.names),
        })
    }

    fn moment(&self, index: usize) -> Value {
        let moment = &self.moments[index];
        let mut document = json!({
            "t": moment.time,
            "q": self.by_name(&moment.q),
            "v": self.by_name(&moment.v),
            "a": self.by_name(&moment.a),
            "control": self.by_name(&moment.control),
            "friction_power": moment.friction_power + 0.0,
            "multiplier": moment.multiplier,
        });
        let guides = self.guides.iter().zip(&moment.contacts);
        let reactions: Map<String, Value> = guides
            .map(|(guide, contact)| (guide.clone(), json!(contact.reaction)))
            .collect();
        if let Some(fields) = document.as_object_mut() {
            fields.insert("reactions".into(), reactions.into());
            if let Some(angles) = &self.angles {
                fields.insert("epsilon".into(), json!(angles[index]));
            }
        }
        document
    }

    /// A table with one row for each moment.
    pub fn recording(&self) -> Recording {
        self.recorded(&self.moments, self.angles.as_deref())
    }

    /// The motion at equal intervals of time after the start.
    pub fn at_equal_times(&self, count: u32) -> Recording {
        let time = |k: u32| self.motion.time() * f64::from(k) / f64::from(count);
        let moments: Vec<Moment> = (0..=count).map(|k| self.motion.at(time(k))).collect();
        let problem = self.motion.problem().filter(|_| self.angles.is_some());
        let angles = problem.map(|problem| angles(problem, &moments));
        self.recorded(&moments, angles.as_deref())
    }

    fn recorded(&self, moments: &[Moment], angles: Option<&[f64]>) -> Recording {
        let column = |name: String, unit: String, kind, value: &dyn Fn(usize) -> f64| Column {
            name,
            unit,
            kind,
            values: (0..moments.len()).map(value).collect(),
        };
        let mut columns = Vec::new();
        let named = || self.names.iter().zip(&self.units).enumerate();
        for (i, (name, unit)) in named() {
            columns.push(column(
                name.clone(),
                unit.clone(),
                ColumnKind::Coordinate,
                &|k| moments[k].q[i],
            ));
        }
        for (i, (name, unit)) in named() {
            let unit = rate_unit(name, unit);
            columns.push(column(
                format!("der({name})"),
                unit,
                ColumnKind::Rate,
                &|k| moments[k].v[i],
            ));
        }
        for (i, (name, unit)) in named() {
            let unit = if unit == "m" {
                "N".into()
            } else {
                format!("J/{unit}")
            };
            columns.push(column(
                format!("control {name}"),
                unit,
                ColumnKind::Output,
                &|k| moments[k].control[i],
            ));
        }
        for (i, guide) in self.guides.iter().enumerate() {
            let name = format!("reaction {guide}");
            columns.push(column(name, "N".into(), ColumnKind::Output, &|k| {
                moments[k].contacts[i].reaction
            }));
        }
        columns.push(column(
            "friction power".into(),
            "W".into(),
            ColumnKind::Output,
            &|k| moments[k].friction_power,
        ));
        if let Some(angles) = angles {
            columns.push(column(
                "epsilon".into(),
                "rad".into(),
                ColumnKind::Output,
                &|k| angles[k],
            ));
        }
        Recording {
            times: moments.iter().map(|moment| moment.time).collect(),
            columns,
        }
    }

    pub fn print(&self, machine: &str) {
        let motion = &self.motion;
        let time = shortest(motion.time());
        if !self.is_motion() {
            output::line(format_args!(
                "{machine}: no least time is claimed; the equations give {time} s, but the machine does not move that way"
            ));
        } else if self.warning_of_unfinished().is_some() {
            output::line(format_args!("{machine}: {time} s is the least time found"));
        } else {
            output::line(format_args!("{machine}: {time} s is the least time"));
        }
        output::line(format_args!("  found in {:.1} µs", 1e6 * self.seconds));
        self.print_search();
        self.print_ends();
        let constants: Vec<String> = self.constants().iter().map(|c| shortest(*c)).collect();
        let quantity = match motion {
            Motion::Closed(_) => "constants of Euler's equations",
            Motion::Direct(_) => "multipliers of the coordinates at the start",
        };
        output::line(format_args!("  {quantity}: {}", constants.join(", ")));
        for (i, guide) in self.guides.iter().enumerate() {
            let (reaction, time) = self.least_reaction(i);
            output::line(format_args!(
                "  least normal reaction of {guide}: {reaction:.6} N, at t = {time:.6} s"
            ));
        }
        self.print_checks();
        for warning in self.warnings() {
            output::line(format_args!("  warning: {warning}"));
        }
    }

    /// Prints why the direct method was used, and how it searched.
    fn print_search(&self) {
        if let Motion::Direct(direct) = &self.motion {
            let direct = direct.sought();
            output::line(format_args!(
                "  by the direct method, since {}",
                self.because.join("; ")
            ));
            output::line(format_args!(
                "  on {} intervals; halving them changed the time by {:.1e} s",
                direct.stretches(),
                direct.change()
            ));
            output::line(format_args!("  {}", alternatives(direct)));
        }
    }

    /// Prints coordinates and rates where the motion begins and where it ends.
    fn print_ends(&self) {
        let width = self
            .names
            .iter()
            .map(|name| name.chars().count())
            .max()
            .unwrap_or(0);
        let ends = [("from", 0), ("to", self.moments.len() - 1)];
        for (what, index) in ends {
            output::line(format_args!("  {what}"));
            let moment = &self.moments[index];
            for (i, name) in self.names.iter().enumerate() {
                let pad = " ".repeat(width - name.chars().count());
                output::line(format_args!(
                    "    {name}{pad} = {:<24} der({name}){pad} = {}",
                    shortest(moment.q[i]),
                    shortest(moment.v[i] + 0.0)
                ));
            }
        }
        if let Some(angles) = &self.angles {
            output::line(format_args!(
                "  direction in normal coordinates: from ε = {} to {} rad",
                shortest(angles[0]),
                shortest(angles[angles.len() - 1])
            ));
        }
    }

    /// Prints what bounds the motion: the power of friction and of the control forces, how far a simulation misses the end, and the turns that
    /// would be slower.
    fn print_checks(&self) {
        let friction = self.moments.iter().map(|moment| moment.friction_power);
        if !self.guides.is_empty() {
            output::line(format_args!(
                "  greatest power of friction: {:.6} W",
                -friction.fold(0.0, f64::min)
            ));
        }
        output::line(format_args!(
            "  greatest power of the control forces, by round-off: {:.1e} W",
            self.power()
        ));
        if let Ok(arrival) = &self.arrival {
            output::line(format_args!(
                "  simulated under the control forces, the machine misses the end by {:.1e} of the distance",
                arrival.off
            ));
        }
        let [less, more] = self.best_among_turns;
        if less > -PI || more < PI {
            output::line(format_args!(
                "  faster than with sudden turns between {:.1}° and {:.1}°; beyond this range, a turn could save more friction than it costs",
                less.to_degrees(),
                more.to_degrees()
            ));
        }
    }
}

/// The alternatives with which the motion was compared.
fn alternatives<T: Terrain>(motion: &Sought<T>) -> String {
    let starts = motion.trials().len();
    let starts = match starts {
        1 => "1 start".to_owned(),
        _ => format!("{starts} starts"),
    };
    let others: Vec<String> = motion.others().into_iter().map(shortest).collect();
    if others.is_empty() {
        format!(
            "the only motion found from {starts}; it is not proved that no motion far from it is faster"
        )
    } else {
        format!(
            "the fastest found from {starts}; others take {} s; it is not proved that no motion far from these is faster",
            others.join(", ")
        )
    }
}

/// ε at each moment, without jumps; the first is between −π and π.
fn angles(problem: &Problem, moments: &[Moment]) -> Vec<f64> {
    let mut before = 0.0;
    let angle = |moment: &Moment| {
        let e = problem.to_normal(&moment.direction);
        let angle = e[1].atan2(e[0]);
        before = angle + ((before - angle) / TAU).round() * TAU;
        before
    };
    moments.iter().map(angle).collect()
}
