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
    // The least, 10, the greatest, 120, and the one that failed; the scale begins and ends within a step of its ends.
    assert_eq!(filled("440154"), 1, "{svg}");
    assert_eq!(filled("FDE725"), 1);
    assert_eq!(filled("BEBEBE"), 1);
    for label in ["product", ">a<", ">b<", ">10<", ">120<"] {
        assert!(svg.contains(label.trim_matches(['>', '<'])), "{label}");
    }
    // Twelve cells, sixty-four steps of the scale, and the sheet.
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
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let table = table();
    for (arguments, words) in [
        (&["--of", "produkt"][..], "did you mean `product`?"),
        (&["--of", "error"], "holds no numbers"),
        (&["--of", "product,t"], "shows one quantity"),
        (
            &["--of", "product", "--over", "a,b,t"],
            "over one or two parameters",
        ),
        (
            &["--of", "t", "--over", "a,product"],
            "choose one by --only b=VALUE",
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
        status == 2 && error.contains("it is no table of a sweep"),
        "{error}"
    );
}
