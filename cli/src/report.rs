//! The page of a run: a single HTML file without external references.
//!
//! The page contains the motion (`samples`), the geometry as a function of it (`scene` and `script`), the curves that do
//! not follow from it, and text (`page`). A position on the page is therefore the model's own expression at interpolated
//! coordinates, including explicit time, and the file size does not depend on how much is drawn. The scripts that draw and
//! play are hand-written files beside this one, included unchanged.

pub(crate) mod html;
pub(crate) mod live;
mod page;
mod places;
mod samples;
mod scene;
pub(crate) mod script;
mod touching;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::methods::Method;
use lagrangian::{ContactEvent, EnergyBalance, Event, Solution, State, Statistics, Warning};
use lagrangian_mechanics::Compiled;
use lagrangian_symbolic::Symbol;
use lagrangian_units::state_of;
use serde_json::{Value, json};

use crate::collisions;
use crate::contacts::ContactSummary;
use crate::recording::{Column, ColumnKind, Recording, panels, steady, thin};

pub(crate) use live::Live;
pub(crate) use page::{DRAWING, STYLE};
pub use samples::recording_refinement;
pub(crate) use samples::{Samples, base64, encoded};
pub(crate) use scene::Scene;

/// The most bytes for stored curves, before encoding, and the most points of one curve.
const CURVE_BYTES: usize = 320_000;
const CURVE_POINTS: usize = 1600;

/// The most impacts whose impulses are stored; the greatest are kept.
const IMPACTS: usize = 12_000;

/// A run with all data for its page.
pub struct Report<'a, 'd> {
    /// The settings of the caller.
    pub asked: &'a CallSettings,
    /// The derived machine.
    pub compiled: &'a Compiled<'d>,
    /// The machine with its parameters.
    pub machine: &'a InterpretedMachine,
    /// The integration method.
    pub method: &'a Method,
    /// The result of the run.
    pub run: Outcome<'a>,
    /// The run, recorded as densely as [`recording_refinement`] requires.
    pub recording: &'a Recording,
    /// The results on rolling contacts.
    pub contacts: &'a [ContactSummary],
    /// The error that ended it early.
    pub error: Option<String>,
    /// Whether the user interrupted it.
    pub is_interrupted: bool,
}

/// The settings of a call, as text.
pub struct CallSettings {
    /// The name of the spec's file.
    pub file: String,
    /// The relative and absolute tolerance of a step.
    pub tolerance: String,
    /// The names of constants whose values override those of the spec.
    pub constants: Vec<String>,
    /// The laws of inputs, by name.
    pub inputs: Vec<(String, String)>,
}

/// The result of a run, whatever its type of inputs.
pub struct Outcome<'a> {
    system: &'a InterpretedSystem,
    start: &'a State<Named>,
    end: &'a State<Named>,
    events: &'a [Event<Named>],
    contact_events: &'a [ContactEvent<Named>],
    warnings: &'a [Warning],
    statistics: Statistics,
    energy: Option<EnergyBalance>,
    /// The energy that each unilateral contact took, by cause, in J.
    taken_by_contacts: Vec<(String, f64)>,
}

impl<'a, L> From<&'a Solution<InterpretedMachine, L>> for Outcome<'a> {
    fn from(run: &'a Solution<InterpretedMachine, L>) -> Outcome<'a> {
        Outcome {
            system: run.system(),
            start: run.start(),
            end: run.end(),
            events: run.events(),
            contact_events: run.contact_events(),
            warnings: run.warnings(),
            statistics: run.statistics(),
            energy: run.energy_balance(),
            taken_by_contacts: collisions::losses(run.system(), run.contact_energies()),
        }
    }
}

impl Report<'_, '_> {
    /// The page.
    pub fn page(&self) -> String {
        self.page_with(None)
    }

    /// The page with a program of the machine, which can run it again; see [`live::reason_not_live`] for machines that cannot.
    pub(crate) fn page_that_runs(&self, live: &Live) -> String {
        self.page_with(Some(live))
    }

    fn page_with(&self, live: Option<&Live>) -> String {
        let scene = self.scene();
        let samples = Samples::new(self.recording);
        let data = self.data(&scene, &samples, live.is_some());
        let kinematics = script::kinematics(&self.compiled.model, &scene.values);
        page::text(self, &scene, &samples, &data, &kinematics, live)
    }

    fn scene(&self) -> Scene<'_> {
        scene(self.compiled, self.machine, self.run.start)
    }

    /// The data that the scripts read.
    fn data(&self, scene: &Scene<'_>, samples: &Samples, is_live: bool) -> Value {
        let kinds = [
            ColumnKind::Coordinate,
            ColumnKind::Rate,
            ColumnKind::Output,
            ColumnKind::Input,
            ColumnKind::Multiplier,
            ColumnKind::Contact,
            ColumnKind::Energy,
            ColumnKind::Residual,
        ];
        let panels = panels(self.recording, &kinds);
        let stored = panels
            .iter()
            .filter(|panel| !matches!(panel.kind, ColumnKind::Coordinate | ColumnKind::Rate))
            .map(|panel| panel.columns.len())
            .sum::<usize>();
        let points = (CURVE_BYTES / 8 / stored.max(1)).clamp(16, CURVE_POINTS);
        let panels: Vec<Value> = panels
            .iter()
            .map(|panel| {
                let curves: Vec<Value> = panel
                    .columns
                    .iter()
                    .map(|column| self.curve(column, points, is_live))
                    .collect();
                let rounding = panel.rounding();
                json!({ "label": panel.label(), "unit": panel.unit, "rounding": rounding, "curves": curves })
            })
            .collect();
        let mut data = motion(self.recording, samples, self.machine, scene);
        data["picture"] = json!(scene.picture);
        if !scene.picture.contacts.is_empty() {
            data["impacts"] = self.impacts(scene);
        }
        data["panels"] = panels.into();
        data
    }

    /// The impacts of drawn contacts: time, contact, and the impulse along each of its directions.
    fn impacts(&self, scene: &Scene<'_>) -> Value {
        let place = |name: &str| {
            let mut drawn = scene.picture.contacts.iter();
            drawn.position(|contact| contact.name == name)
        };
        let mut impacts: Vec<(f64, usize, [f64; 3])> = (self.run.contact_events.iter())
            .filter_map(|event| {
                let impact = event.impact?;
                let [normal, tangential] = impact.impulse;
                let across = impact.across.map_or(0.0, |across| across.impulse);
                let contact = place(&event.contact)?;
                Some((event.state.t, contact, [normal, tangential, across]))
            })
            .collect();
        let size = |(_, _, impulse): &(f64, usize, [f64; 3])| {
            impulse.iter().map(|part| part * part).sum::<f64>()
        };
        if impacts.len() > IMPACTS {
            impacts.sort_by(|a, b| size(b).total_cmp(&size(a)));
            impacts.truncate(IMPACTS);
            impacts.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        }
        json!({
            "times": samples::encoded(impacts.iter().map(|(t, ..)| *t)),
            "contacts": samples::encoded(impacts.iter().map(|(_, contact, _)| *contact as f64)),
            "impulses": samples::encoded(impacts.iter().flat_map(|(.., impulse)| *impulse)),
        })
    }

    /// A curve: for a coordinate or a rate its index, since the stored states contain it; for other quantities its points.
    fn curve(&self, column: &Column, points: usize, is_live: bool) -> Value {
        let of_kind = || self.recording.of_kind(column.kind);
        let index = of_kind().position(|other| std::ptr::eq(other, column));
        match column.kind {
            ColumnKind::Coordinate => json!({ "name": column.name, "coordinate": index }),
            ColumnKind::Rate => json!({ "name": column.name, "rate": index }),
            kind => {
                let points = match kind {
                    // Most contacts are open most of the time, so constant stretches are thinned.
                    ColumnKind::Contact => {
                        let (times, values) = steady(&self.recording.times, &column.values);
                        thin(&times, &values, points)
                    }
                    _ => thin(&self.recording.times, &column.values, points),
                };
                let times = samples::encoded(points.iter().map(|(time, _)| *time));
                let values: Vec<f64> = points.iter().map(|(_, value)| *value).collect();
                let base = samples::base(&values);
                let values = samples::encoded(values.iter().map(|value| value - base));
                let mut curve = json!({ "name": column.name, "times": times, "values": values });
                if base != 0.0 {
                    curve["base"] = base.into();
                }
                if is_live {
                    // States of first order precede the outputs of the spec.
                    let slots = self.compiled.program.coordinates.iter();
                    let states = slots.filter(|slot| state_of(&slot.name.to_string()).is_some());
                    let states = states.count();
                    curve["live"] = match kind {
                        ColumnKind::Output if index.is_some_and(|index| index < states) => {
                            json!({ "state": index })
                        }
                        ColumnKind::Output => {
                            json!({ "output": index.map(|index| index - states) })
                        }
                        ColumnKind::Multiplier => json!({ "multiplier": index }),
                        ColumnKind::Energy => json!({ "energy": column.name.split(' ').next() }),
                        _ => Value::Null,
                    };
                }
                curve
            }
        }
    }
}

/// The scene of a machine that starts in this state.
pub(crate) fn scene<'d>(
    compiled: &Compiled<'d>,
    machine: &InterpretedMachine,
    start: &State<Named>,
) -> Scene<'d> {
    let model = &compiled.model;
    let mut known: Vec<(Symbol, f64)> = Vec::new();
    let mut know = |symbol: Option<Symbol>, value| known.extend(symbol.map(|s| (s, value)));
    know(model.time.as_symbol(), start.t);
    for (parameter, value) in model.parameters.iter().zip(machine.parameter_values()) {
        know(parameter.symbol.as_symbol(), *value);
    }
    for (coordinate, value) in model.coordinates.iter().zip(&start.q.values) {
        know(coordinate.q.as_symbol(), *value);
    }
    known.sort_unstable_by_key(|(symbol, _)| *symbol);
    let value = |symbol: Symbol| {
        let found = known.binary_search_by_key(&symbol, |(symbol, _)| *symbol);
        found.map_or(0.0, |place| known[place].1)
    };
    Scene::new(model, &value)
}

/// A motion in the form that the scripts read: its states, and the other inputs of the geometry.
pub(crate) fn motion(
    recording: &Recording,
    samples: &Samples,
    machine: &InterpretedMachine,
    scene: &Scene<'_>,
) -> Value {
    let times = &recording.times;
    let mut motion = json!({
        "from": times.first(),
        "interval": match times.as_slice() {
            [first, .., _] => times.get(samples.stride).map(|next| next - first),
            _ => None,
        },
        "to": times.last(),
        "count": samples.count,
        "coordinates": recording.of_kind(ColumnKind::Coordinate).count(),
        "states": samples.states,
        "parameters": machine.parameter_values(),
        "values": scene.values.len(),
    });
    if !samples.bases.is_empty() {
        motion["bases"] = json!(samples.bases);
    }
    motion
}
