//! The page of a map: the drawing, the values under the pointer, and zooming.

use plotters::style::RGBColor;
use serde_json::{Value, json};

use super::{Curves, Heat, Picture, VIRIDIS};
use crate::plot::COLOURS;
use crate::report::html::{self, text as safe};
use crate::report::{STYLE, base64};

const PAGE: &str = include_str!("page.html");
const SCRIPT: &str = include_str!("page.js");

/// The page as one HTML file, from the title, the name of the table, and the drawing.
pub fn text(title: &str, table: &str, picture: &Picture<'_>) -> String {
    let data = match picture {
        Picture::Curves(curves) => of_curves(curves),
        Picture::Heat(heat) => of_heat(heat),
    };
    html::fill(PAGE, |part| match part {
        "title" => safe(title),
        "table" => safe(table),
        "style" => STYLE.to_owned(),
        "data" => html::json(&data),
        "script" => SCRIPT.to_owned(),
        _ => String::new(),
    })
}

/// Numbers as 64-bit values in little-endian order, in base 64: the page shows the exact values of the table.
fn numbers(values: impl Iterator<Item = f64>) -> String {
    base64(&values.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
}

fn of_heat(heat: &Heat<'_>) -> Value {
    let edges = [&heat.columns, &heat.lines].map(|values| super::edges(values));
    json!({
        "kind": "heat",
        "names": heat.names,
        "name": heat.name,
        "columns": numbers(heat.columns.iter().copied()),
        "lines": numbers(heat.lines.iter().copied()),
        "edges": [numbers(edges[0].iter().copied()), numbers(edges[1].iter().copied())],
        "cells": numbers(heat.cells.iter().copied()),
        "scale": heat.scale(),
        "colours": VIRIDIS,
    })
}

fn of_curves(curves: &Curves<'_>) -> Value {
    let colour = |RGBColor(r, g, b): &RGBColor| format!("rgb({r},{g},{b})");
    let sets = |values: &[f64]| -> Vec<Value> {
        let sets = 0..curves.legends.len();
        let points = sets.map(|set| curves.points(set, values));
        let shown = points.zip(&curves.legends).enumerate();
        shown
            .map(|(set, (points, legend))| {
                json!({
                    "legend": legend,
                    "colour": colour(&COLOURS[set % COLOURS.len()]),
                    "x": numbers(points.iter().map(|point| point.0)),
                    "y": numbers(points.iter().map(|point| point.1)),
                })
            })
            .collect()
    };
    let panels = curves.quantities.iter();
    let panels = panels.map(|(name, values)| json!({ "name": name, "sets": sets(values) }));
    json!({
        "kind": if curves.are_dots { "dots" } else { "curves" },
        "x": curves.x,
        "panels": panels.collect::<Vec<Value>>(),
    })
}
