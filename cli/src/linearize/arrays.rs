//! A model as named arrays, independent of the file format.

use lagrangian_linear::DMatrix;
use lagrangian_linear::model::{Label, LinearModel};

/// A named array.
pub struct Array {
    pub name: &'static str,
    pub content: Content,
}

/// The content of an array.
pub enum Content {
    Matrix(DMatrix<f64>),
    Vector(Vec<f64>),
    Text(Vec<String>),
}

/// Names without units.
pub fn names(labels: &[Label]) -> Vec<String> {
    labels.iter().map(|label| label.name.clone()).collect()
}

/// The arrays in `.npz` and `.mat` files.
pub fn arrays(model: &LinearModel) -> Vec<Array> {
    let matrix = |name, matrix: &DMatrix<f64>| Array {
        name,
        content: Content::Matrix(matrix.clone()),
    };
    let text = |name, labels: &[Label]| Array {
        name,
        content: Content::Text(names(labels)),
    };
    vec![
        matrix("A", &model.a),
        matrix("B", &model.b),
        matrix("C", &model.c),
        matrix("D", &model.d),
        Array {
            name: "drift",
            content: Content::Vector(model.drift.clone()),
        },
        matrix("basis", &model.basis),
        text("states", &model.states),
        text("inputs", &model.inputs),
        text("outputs", &model.outputs),
    ]
}
