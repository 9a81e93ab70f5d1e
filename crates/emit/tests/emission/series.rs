//! Taylor series in emitted code appear only where the spec requests them, and change nothing else.

use lagrangian_emit::rust::{self, Options};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

#[test]
fn code_without_the_section_is_unchanged() {
    for name in [
        "heavy_top",
        "elastic_pendulum",
        "two_body_orbit",
        "four_bar",
    ] {
        let path = format!(
            "{}/../../machines/{name}.machine",
            env!("CARGO_MANIFEST_DIR")
        );
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let (path, text) = Disk.read(&path, None).unwrap();
        let model = lagrangian_spec::model(
            &dag,
            &path,
            &text,
            &[],
            &mut Disk,
            &mut sources,
            &mut report,
        );
        let compiled = model
            .and_then(|model| Compiled::new(model, &mut report))
            .unwrap();
        assert_eq!(compiled.series, None);
        let without = rust::module(&compiled.program, &Options::default());
        assert!(!without.contains("series"), "{name}");
        let series = ProvedSeries::derive(&compiled.model).unwrap();
        let with = rust::module(
            &compiled.program,
            &Options {
                series: Some(series),
                ..Options::default()
            },
        );
        // The series add lines and change none of the others.
        let mut lines = with.lines();
        for line in without.lines() {
            assert!(lines.any(|other| other == line), "{name}: {line}");
        }
        assert!(
            with.contains("series_in_lists series(p, t, q, v, u, lists, coefficients) ="),
            "{name}"
        );
    }
}

#[test]
fn a_machine_without_a_series_that_asks_is_told_why() {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let text = "machine Kinked in plane {
        parameters { m: kg = 1, k: N/m = 1 }
        coordinates { x: m = 1 }
        bodies { ball { mass: m, at: (x, 0) } }
        forces { push { on: x, value: -k*abs(x) } }
        methods { taylor }
    }";
    let model = lagrangian_spec::model(
        &dag,
        "kinked",
        text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    assert!(compiled.is_none());
    let codes: Vec<Code> = report.diagnostics().iter().map(|said| said.code).collect();
    assert_eq!(codes, [Code::NotSupported]);
    let said = report.render_short(&sources);
    assert!(
        said.contains("`abs`") && said.contains("`taylor`"),
        "{said}"
    );
}
