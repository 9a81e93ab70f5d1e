//! `lagrangian map`: tables of sweeps as drawings.

use crate::support::{Scratch, lagrangian};

/// a·b over three values of `a` and four of `b`; the run at (2, 30) failed.
fn table() -> Scratch {
    let mut text = "run,a,b,status,error,t,product\n".to_owned();
    for (run, (a, b)) in (1..=3)
        .flat_map(|a| (1..=4).map(move |b| (a, 10 * b)))
        .enumerate()
    {
        let row = match (a, b) {
            (2, 30) => format!("{run},{a}.0,{b}.0,failed,\"no, not so\",0.1,\n"),
            _ => format!("{run},{a}.0,{b}.0,ended,,1.0,{}.0\n", a * b),
        };
        text += &row;
    }
    Scratch::new("rows.csv", &text)
}

fn map(table: &Scratch, arguments: &[&str]) -> (i32, String, String) {
    let drawing = table.0.with_file_name("map.svg");
    let plot = drawing.to_str().expect("text");
    let output = lagrangian(&[&["map", table.path(), "--plot", plot], arguments].concat());
    let error = String::from_utf8(output.stderr).expect("text");
    let svg = std::fs::read_to_string(&drawing).unwrap_or_default();
    (output.status.code().expect("no signal"), svg, error)
}

#[test]
fn two_parameters_make_cells_of_colours() {
    let (status, svg, error) = map(&table(), &["--of", "product"]);
    assert_eq!(status, 0, "{error}");
    let filled = |colour: &str| svg.matches(&format!("fill=\"#{colour}\"")).count();
    // The least value, 10, the greatest, 120, and the failed run; the first and last steps of the scale
    // contain its ends.
    assert_eq!(filled("440154"), 1, "{svg}");
    assert_eq!(filled("FDE725"), 1);
    assert_eq!(filled("BEBEBE"), 1);
    for label in ["product", ">a<", ">b<", ">10<", ">120<"] {
        assert!(svg.contains(label.trim_matches(['>', '<'])), "{label}");
    }
    // Twelve cells, sixty-four steps of the scale, and the background.
    assert_eq!(svg.matches("<rect").count(), 12 + 64 + 1);
}

#[test]
fn one_parameter_makes_a_curve_for_each_value_of_the_other() {
    let table = table();
    let (status, svg, error) = map(&table, &["--of", "product,t", "--over", "a"]);
    assert_eq!(status, 0, "{error}");
    // Eleven products, and a time for each of the twelve runs.
    assert_eq!(svg.matches("<circle").count(), 11 + 12);
    assert!(svg.contains("b = 30"));
    let (status, svg, error) = map(
        &table,
        &["--of", "product", "--over", "a", "--only", "b=20"],
    );
    assert_eq!(status, 0, "{error}");
    assert_eq!(svg.matches("<circle").count(), 3);
    assert!(!svg.contains("b = "));
    // The run between the two others failed: no line joins them.
    let (status, svg, error) = map(
        &table,
        &["--of", "product", "--over", "a", "--only", "b=30"],
    );
    assert_eq!(status, 0, "{error}");
    assert_eq!(svg.matches("<circle").count(), 2);
    let lines = svg.lines().filter(|line| line.starts_with("<polyline"));
    let mut own = lines.filter(|line| line.contains("#0072B2"));
    assert!(own.all(|line| line.matches(',').count() == 1), "{svg}");
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let table = table();
    for (arguments, words) in [
        (&["--of", "produkt"][..], "did you mean `product`?"),
        (&["--of", "error"], "does not contain numbers"),
        (&["--of", "product,t"], "shows one quantity"),
        (
            &["--of", "product", "--over", "a,b,t"],
            "over one or two parameters",
        ),
        (
            &["--of", "t", "--over", "a,product"],
            "select one by --only b=VALUE",
        ),
        (
            &["--of", "product", "--only", "b=25"],
            "no row has this value",
        ),
    ] {
        let (status, _, error) = map(&table, arguments);
        assert_eq!(status, 2, "{arguments:?}: {error}");
        assert!(error.contains(words), "{arguments:?}: {error}");
    }
    let other = Scratch::new("run.csv", "t [s],x [m]\n0,1\n");
    let (status, _, error) = map(&other, &["--of", "x"]);
    assert!(
        status == 2 && error.contains("it is not the table of a sweep"),
        "{error}"
    );
}

/// Spreadsheets write a mark before the first name, and other separators than commas.
#[test]
fn tables_that_other_programs_wrote_are_read_or_named() {
    let text = "run,a,status,error,b\n0,1,ended,,2\n1,2,ended,,3\n";
    let marked = Scratch::new("marked.csv", &format!("\u{feff}{text}"));
    let (status, svg, error) = map(&marked, &["--of", "b"]);
    assert_eq!(status, 0, "{error}");
    assert!(svg.contains("<svg"), "{svg}");
    for (separator, name) in [("\t", "tabs"), (";", "semicolons")] {
        let table = Scratch::new("separated.csv", &text.replace(',', separator));
        let (status, _, error) = map(&table, &["--of", "b"]);
        let words = format!("separated by commas, not by {name}");
        assert!(status == 2 && error.contains(&words), "{error}");
    }
    let table = Scratch::new("short.csv", &text.replace("ended,,3", "ended"));
    let (status, _, error) = map(&table, &["--of", "b"]);
    assert!(
        status == 2 && error.contains("row 2 does not have"),
        "{error}"
    );
}

#[test]
fn many_cells_are_one_image() {
    let side = 150;
    let mut text = "run,a,b,status,error,product\n".to_owned();
    for run in 0..side * side {
        let (a, b) = (run / side, run % side);
        text += &format!("{run},{a},{b},ended,,{}\n", a * b);
    }
    let table = Scratch::new("rows.csv", &text);
    let (status, svg, error) = map(&table, &["--of", "product"]);
    assert_eq!(status, 0, "{error}");
    assert_eq!(svg.matches("<image ").count(), 1);
    assert!(svg.contains("href=\"data:image/png;base64,iVBOR"));
    // The scale and the background.
    assert_eq!(svg.matches("<rect").count(), 64 + 1);
    assert!(svg.trim_end().ends_with("</svg>"));
}

/// A mass on a spring of 4 N/m, driven by a force F cos(w t).
const DRIVEN: &str = "machine Driven in plane {
    parameters { F: N = 1, w: rad/s = 3 }
    coordinates { x: m = 1 }
    bodies { mass { mass: 1, at: (x, 0) } }
    springs { spring { stiffness: 4, stretch: x } }
    forces { drive { on: x, value: F*cos(w*t) } }
    gravity none;
}";

#[test]
fn samples_at_periods_make_a_diagram() {
    let spec = Scratch::new("driven.machine", DRIVEN);
    let rows = spec.0.with_file_name("rows.csv");
    let rows = rows.to_str().expect("text");
    let output = lagrangian(&[
        "sweep",
        spec.path(),
        "--vary",
        "w=3..5:3",
        "--until",
        "20",
        "--after",
        "4",
        "--tolerance",
        "1e-11",
        "--event",
        "period=sin(w*t/2)",
        "--record",
        "event=period",
        "--out",
        rows,
    ]);
    assert!(output.status.success(), "{output:?}");
    let samples = spec.0.with_file_name("rows.samples.csv");
    let text = std::fs::read_to_string(&samples).expect("samples");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("run,t,x,der(x),event"));
    let mut expected = Vec::new();
    for (run, w) in [3.0_f64, 4.0, 5.0].into_iter().enumerate() {
        let period = std::f64::consts::TAU / w;
        let times = (1..)
            .map(|k| f64::from(k) * period)
            .take_while(|t| *t < 20.0);
        expected.extend(times.filter(|t| *t >= 4.0).map(|t| (run, w, t)));
    }
    let found: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(found.len(), expected.len());
    for (cells, (run, w, t)) in found.iter().zip(expected) {
        let number = |k: usize| cells[k].parse::<f64>().expect("a number");
        assert_eq!((cells[0], cells[4]), (run.to_string().as_str(), "period"));
        // x = (1 - c) cos 2t + c cos wt with c = 1/(4 - w²).
        let c = 1.0 / (4.0 - w * w);
        let x = (1.0 - c) * (2.0 * t).cos() + c * (w * t).cos();
        // Some hundred steps, each with an error of 1e-11.
        assert!(
            (number(1) - t).abs() < 1e-9 && (number(2) - x).abs() < 1e-8,
            "{cells:?}"
        );
    }

    // One dot for each of them, at the frequency of its run; the page contains the same.
    let drawing = spec.0.with_file_name("map.svg");
    let page = spec.0.with_file_name("map.html");
    let output = lagrangian(&[
        "map",
        rows,
        "--samples",
        "--of",
        "x",
        "--plot",
        drawing.to_str().expect("text"),
        "--report",
        page.to_str().expect("text"),
    ]);
    assert!(output.status.success(), "{output:?}");
    let svg = std::fs::read_to_string(&drawing).expect("a drawing");
    assert_eq!(svg.matches("<circle").count(), found.len());
    assert!(
        !svg.contains("<polyline") || svg.matches("<polyline").count() < 40,
        "no curve joins dots"
    );
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("\"kind\":\"dots\"") && html.contains("rows.csv"));

    let output = lagrangian(&[
        "map",
        rows,
        "--samples",
        "--of",
        "y",
        "--plot",
        drawing.to_str().expect("text"),
    ]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(2) && error.contains("no column named `y`"),
        "{error}"
    );
}

#[test]
fn a_page_holds_the_values_of_the_table() {
    let table = table();
    let page = table.0.with_file_name("map.html");
    let output = lagrangian(&[
        "map",
        table.path(),
        "--of",
        "product",
        "--report",
        page.to_str().expect("text"),
    ]);
    assert!(output.status.success(), "{output:?}");
    let html = std::fs::read_to_string(&page).expect("a page");
    assert!(html.contains("\"kind\":\"heat\"") && html.contains("\"names\":[\"a\",\"b\"]"));
    // 10, the first cell, as eight bytes in little-endian order.
    assert!(html.contains("\"cells\":\"AAAAAAAAJEA"), "{html}");
    // An input table is not overwritten, and one of the two outputs must be requested.
    let output = lagrangian(&["map", table.path(), "--of", "product"]);
    assert_eq!(output.status.code(), Some(2));
    let samples = lagrangian(&[
        "map",
        table.path(),
        "--of",
        "t",
        "--samples",
        "--report",
        page.to_str().expect("text"),
    ]);
    let error = String::from_utf8_lossy(&samples.stderr).into_owned();
    assert!(
        samples.status.code() == Some(2) && error.contains("the table has no file of samples"),
        "{error}"
    );
}

/// A value of a grid is selected as it is said, not as it is rounded: 0.1 + 0.4·2/4 is 0.30000000000000004.
#[test]
fn a_value_of_a_grid_is_selected_by_its_decimals() {
    let mut text = "run,a,b,status,error,t,product\n".to_owned();
    for (run, (a, b)) in ["0.1", "0.30000000000000004", "0.5"]
        .iter()
        .flat_map(|a| [1, 2].map(|b| (a, b)))
        .enumerate()
    {
        text += &format!("{run},{a},{b}.0,ended,,1.0,{run}.0\n");
    }
    let table = Scratch::new("rows.csv", &text);
    let only = |value: &str| map(&table, &["--of", "product", "--over", "b", "--only", value]);
    let (status, svg, error) = only("a=0.3");
    assert_eq!(status, 0, "{error}");
    assert_eq!(svg.matches("<circle").count(), 2);
    let (status, _, error) = only("a=0.3000001");
    assert_eq!(status, 2, "{error}");
    assert!(error.contains("no row has this value"), "{error}");
}
