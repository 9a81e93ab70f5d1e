//! A machine with two charts is emitted in both, and code for one chart is unchanged.

use lagrangian_emit::rust::{self, Options};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

const PARTICLE: &str = "machine Particle in plane {
    parameters { m: kg = 2, k: N/m = 8 }
    coordinates { s: m = 1, phi: rad, l[1..2]: m }
    bodies { particle { mass: m, at: polar(s, phi) }, other[i in 1..2] { mass: m, at: (l[i], s*sin(phi)) } }
    gravity none;
    springs { along { stiffness: k, stretch: s*cos(phi) } }
    CHARTS
}";

const CHARTS: &str = "charts { particle: polar(s, phi) | cartesian(x, y) }";

#[test]
fn a_second_chart_adds_a_module_and_changes_no_line() {
    let emitted = |charts: &str| {
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let text = PARTICLE.replace("CHARTS", charts);
        let model =
            lagrangian_spec::model(&dag, "p", &text, &[], &mut Disk, &mut sources, &mut report);
        let compiled = model.and_then(|model| Compiled::in_charts(model, &mut report));
        let (compiled, cartesian) = compiled.expect("a machine");
        assert_eq!(cartesian.is_some(), !charts.is_empty());
        rust::module(
            &compiled.program,
            &Options::of(&compiled, cartesian.as_ref()),
        )
    };
    let (one, both) = (emitted(""), emitted(CHARTS));
    let more = both.strip_prefix(&one).expect("the same lines");
    assert!(more.contains("pub mod cartesian {"), "{more}");
    let call = "machine Particle { m, k } in cartesian::Particle;\n    points [[0, 1]]\n";
    assert!(more.contains(call), "{more}");
}

#[test]
fn the_placeholder_for_a_spec_with_errors_has_both_charts() {
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let text = PARTICLE.replace("CHARTS", CHARTS).replace("mass: m,", "");
    let spec = lagrangian_spec::parse(&mut sources, "p", &text, &mut report);
    let stub = rust::stub(&spec, &Options::default());
    assert!(stub.contains("pub mod cartesian {"), "{stub}");
    assert!(stub.contains("in cartesian::Particle;\n"), "{stub}");
}
