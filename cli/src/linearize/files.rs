//! The output files of `linearize`.

use std::io::{self, Write};
use std::path::PathBuf;

use lagrangian_linear::DMatrix;
use lagrangian_units::rate_name;

use super::arrays::{arrays, names as names_of_labels};
use super::{Linearization, as_json, frequencies, mat, npz};
use crate::call;
use crate::failure::Failure;
use crate::output::{self, Destination, MODEL, SVG, TABLE, keep_apart};

/// The files that a call requests.
#[derive(Default)]
pub struct Files {
    /// The model in a single file.
    model: Option<Destination>,
    /// One file for each matrix.
    matrices: Vec<(&'static str, Destination)>,
    /// The table along a range.
    pub table: Option<Destination>,
    bode: Option<Destination>,
    nyquist: Option<Destination>,
}

/// The matrices that have separate files if the extension is `.csv`.
const MATRICES: [&str; 6] = ["A", "B", "C", "D", "drift", "basis"];

impl Files {
    /// Checks all files before anything is derived.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn new(call: &call::Linearize) -> Result<Files, Failure> {
        let mut files = Files {
            bode: Destination::of("--bode", call.bode.as_ref(), SVG)?,
            nyquist: Destination::of("--nyquist", call.nyquist.as_ref(), SVG)?,
            ..Files::default()
        };
        match (&call.out, &call.along) {
            (Some(path), Some(_)) => files.table = Some(Destination::new("--out", path, TABLE)?),
            (Some(path), None) => {
                let out = Destination::new("--out", path, MODEL)?;
                match out.ending() {
                    "csv" => {
                        for name in MATRICES {
                            let path: PathBuf = path.with_extension(format!("{name}.csv"));
                            let file = Destination::new("--out", &path, &["csv"])?;
                            files.matrices.push((name, file));
                        }
                    }
                    _ => files.model = Some(out),
                }
            }
            (None, _) => {}
        }
        output::keep_document_apart(files.all(), call.spec.json)?;
        keep_apart(files.all(), &[(&call.spec.path, "the spec")])?;
        Ok(files)
    }

    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &Destination> {
        let matrices = self.matrices.iter().map(|(_, file)| file);
        let others = [&self.model, &self.table, &self.bode, &self.nyquist];
        others.into_iter().flatten().chain(matrices)
    }

    /// Writes a model.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn write(
        &self,
        title: &str,
        names: &[Vec<String>; 2],
        result: &Linearization,
    ) -> Result<(), Failure> {
        let model = &result.model;
        if let Some(file) = &self.model {
            match file.ending() {
                "npz" => file.write(|to| to.write_all(&npz::bytes(&arrays(&result.model))?))?,
                "mat" => file.write(|to| to.write_all(&mat::bytes(&arrays(&result.model))))?,
                _ => file.write_text(&format!("{:#}\n", as_json(names, result)))?,
            }
        }
        let coordinates = names[0].iter().cloned();
        let rates = names[0].iter().map(|name| rate_name(name, ""));
        let all: Vec<String> = coordinates.chain(rates).collect();
        let [states, inputs, outputs] =
            [&model.states, &model.inputs, &model.outputs].map(|labels| names_of_labels(labels));
        for (name, file) in &self.matrices {
            let drift = DMatrix::from_column_slice(model.drift.len(), 1, &model.drift);
            let (rows, columns, matrix) = match *name {
                "A" => (&states, &states, &model.a),
                "B" => (&states, &inputs, &model.b),
                "C" => (&outputs, &states, &model.c),
                "D" => (&outputs, &inputs, &model.d),
                "basis" => (&all, &states, &model.basis),
                _ => (&states, &vec!["drift".to_owned()], &drift),
            };
            file.write(|to| csv(rows, columns, matrix, to))?;
        }
        if let Some(file) = &self.bode {
            file.write_text(&frequencies::bode(title, result).map_err(Failure::Run)?)?;
        }
        if let Some(file) = &self.nyquist {
            file.write_text(&frequencies::nyquist(title, result).map_err(Failure::Run)?)?;
        }
        Ok(())
    }
}

/// A cell of comma-separated text; `der(x,2)` contains a comma.
fn cell(text: &str) -> String {
    if text.contains(',') {
        format!("\"{text}\"")
    } else {
        text.to_owned()
    }
}

/// A matrix with the names of its columns above it and those of its rows in front.
fn csv(
    rows: &[String],
    columns: &[String],
    matrix: &DMatrix<f64>,
    to: &mut (dyn Write + Send),
) -> io::Result<()> {
    for column in columns {
        write!(to, ",{}", cell(column))?;
    }
    writeln!(to)?;
    for (i, row) in rows.iter().enumerate() {
        write!(to, "{}", cell(row))?;
        for x in matrix.row(i).iter() {
            write!(to, ",{x:?}")?;
        }
        writeln!(to)?;
    }
    Ok(())
}
