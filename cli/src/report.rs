//! A run as a page to look at: one HTML file that needs nothing else.
//!
//! The page holds the motion ([`samples`]), the geometry as a function of it ([`scene`] and [`script`]), the curves that do
//! not follow from it, and text ([`page`]). So a position on the page is the model's own expression at interpolated
//! coordinates, explicit time included, and the size of the file does not depend on how much is drawn. What draws and plays
//! is hand-written and stands in the files beside this one, as a browser gets it.

pub mod html;
mod page;
mod places;
mod samples;
mod scene;
pub mod script;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::methods::Method;
use lagrangian::{Error, State};
use lagrangian_mechanics::Compiled;
use lagrangian_symbolic::Symbol;
use serde_json::{Value, json};

use crate::call;
use crate::contacts::Found;
use crate::recording::Run;
use crate::recording::{Column, Kind, Recording, panels, thin};

pub use page::{DRAWING, STYLE};
pub use samples::{Samples, encoded, finer};
pub use scene::Scene;

/// What the curves may fill that are stored as such, in bytes before they are encoded; and the most points of one.
const CURVE_BYTES: usize = 320_000;
const CURVE_POINTS: usize = 1600;

/// A run, and everything that a page says about it.
pub struct Report<'a, 'd> {
    pub call: &'a call::Simulate,
    pub compiled: &'a Compiled<'d>,
    pub machine: &'a InterpretedMachine,
    pub method: &'a Method,
    pub run: &'a Run,
    /// The run, recorded as closely as [`finer`] says.
    pub recording: &'a Recording,
    /// What it has shown of rolling contacts.
    pub contacts: &'a [Found],
    /// What ended it early.
    pub error: Option<&'a Error>,
}

impl Report<'_, '_> {
    /// The page.
    pub fn page(&self) -> String {
        let scene = self.scene();
        let samples = Samples::new(self.recording);
        let data = self.data(&scene, &samples);
        let kinematics = script::kinematics(&self.compiled.model, &scene.values);
        page::text(self, &scene, &samples, &data, &kinematics)
    }

    fn scene(&self) -> Scene<'_> {
        scene(self.compiled, self.machine, self.run.start())
    }

    /// What the scripts read.
    fn data(&self, scene: &Scene<'_>, samples: &Samples) -> Value {
        let kinds = [
            Kind::Coordinate,
            Kind::Rate,
            Kind::Output,
            Kind::Input,
            Kind::Multiplier,
            Kind::Contact,
            Kind::Energy,
            Kind::Residual,
        ];
        let panels = panels(self.recording, &kinds);
        let stored = panels
            .iter()
            .filter(|panel| !matches!(panel.kind, Kind::Coordinate | Kind::Rate))
            .map(|panel| panel.columns.len())
            .sum::<usize>();
        let points = (CURVE_BYTES / 8 / stored.max(1)).clamp(16, CURVE_POINTS);
        let panels: Vec<Value> = panels
            .iter()
            .map(|panel| {
                let curves: Vec<Value> = panel
                    .columns
                    .iter()
                    .map(|column| self.curve(column, points))
                    .collect();
                let rounding = panel.rounding();
                json!({ "label": panel.label(), "unit": panel.unit, "rounding": rounding, "curves": curves })
            })
            .collect();
        let mut data = motion(self.recording, samples, self.machine, scene);
        data["picture"] = json!(scene.picture);
        data["panels"] = panels.into();
        data
    }

    /// A curve: of a coordinate or a rate its index, since the states have it; of anything else its points.
    fn curve(&self, column: &Column, points: usize) -> Value {
        let of_kind = || self.recording.of_kind(column.kind);
        let index = of_kind().position(|other| std::ptr::eq(other, column));
        match column.kind {
            Kind::Coordinate => json!({ "name": column.name, "coordinate": index }),
            Kind::Rate => json!({ "name": column.name, "rate": index }),
            _ => {
                let points = thin(&self.recording.times, &column.values, points);
                let times = samples::encoded(points.iter().map(|(time, _)| *time));
                let values = samples::encoded(points.iter().map(|(_, value)| *value));
                json!({ "name": column.name, "times": times, "values": values })
            }
        }
    }
}

/// What a machine looks like, that starts in this state.
pub fn scene<'d>(
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

/// A motion as the scripts read it: its states, and what places are computed from beside them.
pub fn motion(
    recording: &Recording,
    samples: &Samples,
    machine: &InterpretedMachine,
    scene: &Scene<'_>,
) -> Value {
    let times = &recording.times;
    json!({
        "from": times.first(),
        "interval": match times.as_slice() {
            [first, .., _] => times.get(samples.stride).map(|next| next - first),
            _ => None,
        },
        "to": times.last(),
        "count": samples.count,
        "coordinates": recording.of_kind(Kind::Coordinate).count(),
        "states": samples.states,
        "parameters": machine.parameter_values(),
        "values": scene.values.len(),
    })
}
