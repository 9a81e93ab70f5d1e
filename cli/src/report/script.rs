//! Expressions as JavaScript: one assignment for each node of the graph, with shared nodes assigned once.

use std::fmt::Write;

use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, Function, Id, Node, Rational, Symbol, reachable};

/// A function `kinematics(t, q, p, x)` that writes the values into `x`: `t` is the time, `q` the coordinates, `p` the
/// parameters, all in SI units and in the order of the model.
///
/// Names of the spec do not occur in the text. The values must be positions: they must not depend on velocities
/// or later stages.
pub fn kinematics(model: &Model<'_>, values: &[Expr<'_>]) -> String {
    let mut text = String::from("function kinematics(t, q, p, x) {\n");
    for id in reachable(model.dag, values) {
        let node = model.dag.node(id);
        if let Some(value) = assigned(model, &node) {
            let _ = writeln!(text, "  const {} = {value};", name(id));
        }
    }
    for (place, value) in values.iter().enumerate() {
        let value = operand(model, value.id());
        let _ = writeln!(text, "  x[{place}] = {value};");
    }
    text.push_str("}\n");
    text
}

fn name(id: Id) -> String {
    format!("n{}", id.index())
}

/// The text of a node where it is used: a leaf is written out, any other node by its name.
fn operand(model: &Model<'_>, id: Id) -> String {
    match model.dag.node(id) {
        Node::Constant(value) => number(&value),
        Node::Pi => "Math.PI".into(),
        Node::Symbol(symbol) => read(model, symbol),
        _ => name(id),
    }
}

/// The text that reads the value of a symbol.
fn read(model: &Model<'_>, symbol: Symbol) -> String {
    let is = |expression: Expr<'_>| expression.as_symbol() == Some(symbol);
    if is(model.time) {
        return "t".into();
    }
    if let Some(i) = model.coordinates.iter().position(|c| is(c.q)) {
        return format!("q[{i}]");
    }
    match model.parameters.iter().position(|p| is(p.symbol)) {
        Some(i) => format!("p[{i}]"),
        // Positions do not depend on velocities and inputs.
        None => "NaN".into(),
    }
}

/// A number in JavaScript, in parentheses if its sign could meet an operator.
fn number(value: &Rational) -> String {
    let value = value.to_f64();
    match value {
        _ if !value.is_finite() => "NaN".into(),
        _ if value < 0.0 => format!("({value:?})"),
        _ => format!("{value:?}"),
    }
}

/// The expression that computes a node; `None` for leaves, which are written where they are used.
fn assigned(model: &Model<'_>, node: &Node) -> Option<String> {
    let of = |id: Id| operand(model, id);
    Some(match node {
        Node::Constant(_) | Node::Pi | Node::Symbol(_) => return None,
        Node::Sum(terms) => {
            let mut sum = String::new();
            for (id, coefficient) in terms.iter() {
                let sign = match (coefficient.is_negative(), sum.is_empty()) {
                    (true, _) => " - ",
                    (false, true) => "",
                    (false, false) => " + ",
                };
                let size = coefficient.abs();
                sum.push_str(sign);
                if !size.is_one() {
                    let _ = write!(sum, "{} * ", number(&size));
                }
                sum.push_str(&of(*id));
            }
            sum.trim_start().to_owned()
        }
        Node::Product(factors) => {
            let with = |positive: bool| {
                let powers = factors.iter().filter(|(_, n)| (*n > 0) == positive);
                let powers: Vec<String> = powers
                    .map(|(id, n)| power(&of(*id), n.unsigned_abs()))
                    .collect();
                powers.join(" * ")
            };
            match (with(true), with(false)) {
                (above, below) if below.is_empty() => above,
                (above, below) if above.is_empty() => format!("1 / ({below})"),
                (above, below) => format!("{above} / ({below})"),
            }
        }
        Node::Function(function, arguments) => {
            let arguments: Vec<String> = arguments.iter().map(|id| of(*id)).collect();
            format!(
                "Math.{}({})",
                function_name(*function),
                arguments.join(", ")
            )
        }
    })
}

fn power(x: &str, n: u32) -> String {
    match n {
        1 => x.to_owned(),
        2 => format!("{x} * {x}"),
        _ => format!("Math.pow({x}, {n})"),
    }
}

fn function_name(function: Function) -> &'static str {
    match function {
        Function::Ln => "log",
        // The other functions have the same names.
        other => other.name(),
    }
}

#[cfg(test)]
mod tests {
    use lagrangian_spec::diagnostic::Report;
    use lagrangian_spec::source::{InMemory, Sources};
    use lagrangian_symbolic::Dag;

    use super::*;

    #[test]
    fn every_node_is_one_assignment_and_shared_parts_are_computed_once() {
        let text = "machine M in plane {
            parameters { l: m = 2 }
            coordinates { x: m, q: rad }
            bodies { b { mass: 1, at: (x + l*sin(q), -x*cos(q)^3*l/(l + x)) } }
        }";
        let dag = Dag::new();
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let files = &mut InMemory::new();
        let model = lagrangian_spec::model(&dag, "m", text, &[], files, &mut sources, &mut report);
        let model = model.expect("a good spec");
        let script = kinematics(&model, &model.bodies[0].at);
        for part in [
            "Math.sin(q[1])",
            "Math.cos(q[1])",
            "Math.pow(",
            "/ (",
            "p[0] * ",
            "x[0] = ",
            "x[1] = ",
        ] {
            assert!(script.contains(part), "{part}: {script}");
        }
        assert_eq!(script.matches("Math.cos").count(), 1);
    }
}
