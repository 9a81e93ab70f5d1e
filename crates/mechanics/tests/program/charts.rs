//! A machine in Cartesian coordinates is accepted only if it is the machine in polar ones.

use lagrangian_mechanics::{Compiled, Uncharted, prove_charts};
use lagrangian_program::Role;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

const SPEC: &str = "machine Pair in plane {
    parameters { m: kg = 2, kx: N/m = 8, ky: N/m = 18, l: m = 0.5, b: N*s/m = 0.3, F: N = 0.7, g: m/s^2 = 9.81, mu: 1 = 0.2 }
    coordinates { s: m = 0.5, phi: rad = 0.1, theta: rad = 0.4, y: m = 0.3, der(phi): rad/s = 2 }
    bodies {
        first { mass: m, at: polar(s, phi) },
        second { mass: m/2, at: first.at + polar(l, 2*phi - theta) },
        third { mass: m/3, at: (y, s^2*cos(phi)/l) },
    }
    gravity (0, -g);
    springs { along { stiffness: kx, stretch: s*cos(phi) }, across { stiffness: ky, stretch: s*sin(phi) } }
    dampers { radial { damping: b, stretch: s } }
    forces { turning { on: phi, value: F*s^2/l } }
    constraints { tied: y = s*sin(phi)/2 }
    contacts { wall { gap: l - s*cos(phi), slip: der(s*sin(phi)), restitution: 0.5, friction: mu } }
    outputs { rate: m^2/s = s^2*der(phi), out: m/s^2 = der(der(s*cos(phi))) }
    charts { first: polar(s, phi) | cartesian(xi, eta) }
}";

/// The machine of a spec in both charts, each proved for itself.
fn compiled<'d>(dag: &'d Dag, text: &str) -> [Compiled<'d>; 2] {
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let model =
        lagrangian_spec::model(dag, "pair", text, &[], &mut Disk, &mut sources, &mut report);
    let compiled = model.and_then(|model| Compiled::in_charts(model, &mut report));
    let (polar, cartesian) =
        compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    [polar, cartesian.expect("a second chart")]
}

#[test]
fn another_machine_is_not_taken_for_the_other_chart() {
    let dag = Dag::new();
    let [polar, own] = compiled(&dag, SPEC);
    let points = polar.chart_points();
    assert_eq!(points, [[0, 1]]);
    assert_eq!(prove_charts(&polar.program, &own.program, &points), Ok(()));
    // Each of these is a proved machine, but another one.
    for (from, to, expected) in [
        ("mass: m/2", "mass: m/4", Some(Role::Forces)),
        ("stiffness: kx", "stiffness: 2*kx", Some(Role::Forces)),
        ("damping: b", "damping: b/2", Some(Role::Forces)),
        ("value: F*s^2/l", "value: -F*s^2/l", Some(Role::Forces)),
        ("2*phi - theta", "2*phi + theta", None),
        ("y = s*sin(phi)/2", "y = s*sin(phi)/3", None),
        (
            "gap: l - s*cos(phi)",
            "gap: 2*l - s*cos(phi)",
            Some(Role::Gaps),
        ),
        (
            "restitution: 0.5",
            "restitution: 0.6",
            Some(Role::ContactCoefficients),
        ),
        ("= s^2*der(phi)", "= 2*s^2*der(phi)", Some(Role::Output(0))),
        ("phi: rad = 0.1", "phi: rad = 0.2", Some(Role::Start)),
        (
            "der(phi): rad/s = 2",
            "der(phi): rad/s = 3",
            Some(Role::Start),
        ),
    ] {
        let text = SPEC.replacen(from, to, 1);
        assert_ne!(text, SPEC, "{from}");
        let [_, other] = compiled(&dag, &text);
        let verdict = prove_charts(&polar.program, &other.program, &points);
        let Err(Uncharted::Differs { role, .. }) = verdict else {
            panic!("{to}: {verdict:?}");
        };
        assert!(
            expected.is_none_or(|expected| expected == role),
            "{to}: {role:?}"
        );
    }
}
