//! Emitted code names the steps of an elimination, each before the statement that computes it.

use std::collections::BTreeMap;

use lagrangian_emit as emit;
use lagrangian_languages as languages;
use lagrangian_mechanics::{Compiled, Proved};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

/// A machine of the library.
fn machine(name: &str) -> Proved {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = format!(
        "{}/../../machines/{name}.machine",
        env!("CARGO_MANIFEST_DIR")
    );
    let (name, text) = Disk.read(&path, None).expect("the library is there");
    let model = lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    let compiled = compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    compiled.program
}

/// The statements that follow comments with this text.
fn after<'t>(text: &'t str, comment: &str) -> Vec<&'t str> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs = lines.windows(2);
    pairs
        .filter(|pair| pair[0].contains(comment))
        .map(|pair| pair[1])
        .collect()
}

#[test]
fn steps_stand_before_their_statements() {
    let program = machine("double_pendulum");
    let rust = emit::rust::module(&program, &emit::rust::Options::default());
    // The pivot is the number that is checked.
    let pivots = after(&rust, "// Row theta2: pivot d[theta2].");
    let [pivot] = pivots.as_slice() else {
        panic!("{pivots:?}");
    };
    let name = pivot
        .strip_prefix("let ")
        .and_then(|rest| rest.split_once(" ="));
    let (name, _) = name.expect("a variable");
    assert!(rust.contains(&format!("PIVOTS.hold({name}, ")), "{name}");
    let solutions = after(&rust, "// Back substitution: a[theta1].");
    assert_eq!(solutions.len(), 1);
    assert!(
        solutions[0].starts_with("let theta1_ddot = "),
        "{solutions:?}"
    );
    let c = languages::c::file(&program, &[], &BTreeMap::new());
    for step in ["pivot d[theta2]", "from row theta2: l[theta2, theta1]"] {
        assert_eq!(after(&rust, step).len(), 1, "{step}");
        assert!(!after(&c, step).is_empty(), "{step}");
        let name = &step[step.find('[').expect("a bracket") - 1..];
        assert!(
            program.to_string().contains(&format!("// {name}")),
            "{name}"
        );
    }
}

#[test]
fn what_needs_no_elimination_has_no_steps() {
    let program = machine("simple_pendulum");
    let rust = emit::rust::module(&program, &emit::rust::Options::default());
    for word in ["Eliminates", "pivot d[", "Back substitution", "sum l["] {
        assert!(!rust.contains(word), "{word}");
    }
}

#[test]
fn the_loops_of_a_mechanism_close_after_its_elimination() {
    let program = machine("andrews_squeezer");
    let rust = emit::rust::module(&program, &emit::rust::Options::default());
    assert!(!after(&rust, "inertia d[delta]").is_empty());
    assert!(rust.contains("`C lambda = gamma - G a0`"));
    // What is found before the loops are closed are not the accelerations.
    assert!(!rust.contains("Back substitution: a["));
}
