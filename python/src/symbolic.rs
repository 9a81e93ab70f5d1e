//! The equations as expressions, for computer algebra systems.

use lagrangian_mechanics::Equations;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, Node, Symbol, reachable};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::program::Program;

/// A node: its kind, its name, and the indices of its operands, each with a number: the coefficient of a term or the exponent of a factor.
type Shown = (&'static str, String, Vec<(usize, String)>);

/// A quantity: its name, and the indices of its entries among the nodes.
type Quantity = (&'static str, Vec<usize>);

/// The nodes of the equations, operands first, and the quantities: names with the indices of their entries.
#[pyfunction]
pub fn symbolic(py: Python<'_>, program: &Program) -> PyResult<(Vec<Shown>, Vec<Quantity>)> {
    let made = py.detach(|| {
        program.derived.with_model(|model, report| {
            let equations = Equations::derive(&model, report)?;
            Some(quantities(&model, &equations))
        })
    });
    let made = made.map_err(|trouble| trouble.raise(py))?;
    made.ok_or_else(|| {
        PyRuntimeError::new_err("the machine was derived before, but cannot be derived again")
    })
}

fn quantities<'d>(model: &Model<'d>, equations: &Equations<'d>) -> (Vec<Shown>, Vec<Quantity>) {
    let n = model.coordinates.len();
    let mass = (0..n * n).map(|k| *equations.mass_matrix.get(k / n, k % n));
    let constraints = || equations.constraints.iter();
    let quantities: [(&'static str, Vec<Expr<'d>>); 11] = [
        ("mass_matrix", mass.collect()),
        ("bias", equations.bias.clone()),
        ("applied", equations.applied.clone()),
        ("forces", equations.forces.clone()),
        ("kinetic_energy", vec![equations.kinetic_energy]),
        ("potential_energy", vec![equations.potential_energy]),
        ("dissipation", vec![equations.dissipation]),
        (
            "constraints",
            constraints()
                .map(|c| c.position.unwrap_or(c.rate))
                .collect(),
        ),
        ("rows", constraints().flat_map(|c| c.row.clone()).collect()),
        ("biases", constraints().map(|c| c.bias).collect()),
        ("outputs", equations.outputs.clone()),
    ];
    let roots: Vec<Expr<'d>> = quantities.iter().flat_map(|(_, of)| of.clone()).collect();
    let ids = reachable(model.dag, &roots);
    let mut places = std::collections::HashMap::new();
    let mut nodes = Vec::with_capacity(ids.len());
    for id in ids {
        let node = match model.dag.node(id) {
            Node::Constant(value) => ("number", value.to_string(), Vec::new()),
            Node::Pi => ("pi", String::new(), Vec::new()),
            Node::Symbol(symbol) => symbol_of(model, symbol),
            Node::Sum(terms) => {
                let terms = terms.iter();
                let terms = terms.map(|(id, coefficient)| (places[id], coefficient.to_string()));
                ("sum", String::new(), terms.collect())
            }
            Node::Product(factors) => {
                let factors = factors.iter();
                let factors = factors.map(|(id, power)| (places[id], power.to_string()));
                ("product", String::new(), factors.collect())
            }
            Node::Function(function, arguments) => {
                let arguments = arguments.iter().map(|id| (places[id], String::new()));
                ("function", function.name().to_owned(), arguments.collect())
            }
        };
        places.insert(id, nodes.len());
        nodes.push(node);
    }
    let quantities = quantities.into_iter().map(|(name, of)| {
        let of = of.iter().map(|expression| places[&expression.id()]);
        (name, of.collect())
    });
    (nodes, quantities.collect())
}

/// The kind of a symbol, and its name.
fn symbol_of(model: &Model<'_>, symbol: Symbol) -> Shown {
    let is = |expression: Expr<'_>| expression.as_symbol() == Some(symbol);
    let shown = |kind, name: String| (kind, name, Vec::new());
    if is(model.time) {
        return shown("t", "t".to_owned());
    }
    for coordinate in &model.coordinates {
        let name = || coordinate.name.to_string();
        match () {
            () if is(coordinate.q) => return shown("q", name()),
            () if is(coordinate.v) => return shown("v", name()),
            () if is(coordinate.a) => return shown("a", name()),
            () => {}
        }
    }
    if let Some(parameter) = model.parameters.iter().find(|p| is(p.symbol)) {
        return shown("parameter", parameter.name.to_string());
    }
    match model.inputs.iter().find(|input| is(input.symbol)) {
        Some(input) => shown("input", input.name.to_string()),
        None => shown("other", model.dag.name(symbol).to_string()),
    }
}
