//! A feature that a machine lacks leaves neither an operation nor a name in its code.
//!
//! Every row of [`rows`] is a machine with a feature and the machine without it, written in two ways:
//! with a constant 0, or without the feature. The program, the Rust and the C of these two must be the
//! same text. The cost of the feature is printed in `docs/skipping.md` and checked here, and so is a
//! textbook's count of the operations that must be left, where there is one.

use std::path::Path;

use lagrangian_emit as emit;
use lagrangian_languages as languages;
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::{Counts, Op, Program, Role, Source};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

/// A feature, with the machines that have it and that do not.
struct Row {
    /// The name of the feature.
    feature: &'static str,
    /// The text that is absent, as the page shows it.
    shown: String,
    /// The function whose operations are counted.
    role: Role,
    with: String,
    /// The machine with the feature switched off by a constant.
    off: String,
    /// The machine without the text of the feature.
    never: String,
    /// Words that no emitted line contains without the feature, but some line contains with it.
    gone: &'static [&'static str],
}

/// Emitted text, and the program that it was made from.
struct Made {
    program: Proved,
    rust: String,
    c: String,
}

fn made(text: &str) -> Made {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "skipping",
        text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    let Some(Compiled { program, .. }) = &compiled else {
        panic!("{}\n{text}", report.render_short(&sources));
    };
    Made {
        rust: emit::rust::module(program, &emit::rust::Options::default()),
        c: languages::c::file(program, &[], &Default::default()),
        program: program.clone(),
    }
}

fn counts(program: &Program, role: Role) -> Counts {
    let function = program.function(role);
    function.map_or_else(Counts::default, |function| function.counts())
}

/// The spec with this name on the page.
fn on_the_page(name: &str) -> String {
    let page = page();
    let head = format!("machine {name} in plane {{\n");
    let start = page.find(&head).expect("the page has the machine");
    let length = page[start..].find("```").expect("the block ends");
    page[start..start + length].to_owned()
}

fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/skipping.md");
    std::fs::read_to_string(path).expect("the page is there")
}

/// The machines whose stages the page shows.
const STAGED: [&str; 6] = [
    "crusher9",
    "double_pendulum",
    "two_joint_arm",
    "six_joint_arm",
    "gyroscope_in_gimbals",
    "kapitza_pendulum",
];

/// The text of a machine of the library.
fn library(name: &str) -> String {
    let path = format!(
        "{}/../../machines/{name}.machine",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).expect("the library is there")
}

/// A machine's text with sections added.
fn plus(machine: &str, sections: &str) -> String {
    let end = machine.rfind('}').expect("a machine ends");
    format!("{}{sections}\n}}\n", &machine[..end])
}

/// A section that declares names, as parameters or as constants, all with the same value.
fn numbers(section: &str, list: &[(&str, &str)], value: &str) -> String {
    let items: Vec<String> = list
        .iter()
        .map(|(name, unit)| format!("{name}: {unit} = {value}"))
        .collect();
    format!("{section} {{ {} }}\n", items.join(", "))
}

/// A feature that is a section, switched off by a number in it.
fn section(
    feature: &'static str,
    (name, unit): (&str, &str),
    section: &str,
    gone: &'static [&'static str],
) -> Row {
    let base = on_the_page("Cart");
    let number = |kind, value| numbers(kind, &[(name, unit)], value);
    Row {
        feature,
        shown: format!("`{section}`, {name} = 0"),
        role: Role::Accelerations,
        with: plus(&base, &(number("parameters", "3") + section)),
        off: plus(&base, &(number("constants", "0") + section)),
        never: base,
        gone,
    }
}

/// A feature that replaces one text by another, switched off by numbers in it.
fn instead(
    feature: &'static str,
    list: &[(&str, &str)],
    (before, after): (&str, &str),
    gone: &'static [&'static str],
) -> Row {
    let base = on_the_page("Cart");
    assert!(base.contains(before), "{before}");
    let changed = base.replace(before, after);
    Row {
        feature,
        shown: format!("`{after}`, {} = 0", list[0].0),
        role: Role::Accelerations,
        with: plus(&changed, &numbers("parameters", list, "3")),
        off: plus(&changed, &numbers("constants", list, "0")),
        never: base,
        gone,
    }
}

/// A feature that is a section without a number that could switch it off.
fn asked(feature: &'static str, section: &str, role: Role, gone: &'static [&'static str]) -> Row {
    let base = on_the_page("Cart");
    Row {
        feature,
        shown: format!("`{section}`"),
        role,
        with: plus(&base, section),
        off: base.clone(),
        never: base,
        gone,
    }
}

fn rows() -> Vec<Row> {
    let inputs = "inputs { u: N } forces { motor { on: x, value: u } }";
    let crusher = library("vibrating_crusher");
    // The same numbers in the same place, so that the two machines differ in nothing else.
    let undamped = crusher.replace(" bx: N*s/m = 1500, by: N*s/m = 1500,", "");
    assert_ne!(undamped, crusher);
    let zero = plus(&undamped, "constants { bx: N*s/m = 0, by: N*s/m = 0 }");
    let (before, dampers) = zero.split_once("    dampers {").expect("there are dampers");
    let (_, after) = dampers.split_once("\n    }\n").expect("the section ends");
    let never = format!("{before}{after}");
    vec![
        section("gravity", ("g", "m/s^2"), "gravity (0, -g);", &["pub g:"]),
        section(
            "a spring",
            ("k", "N/m"),
            "springs { buffer { stiffness: k, stretch: x } }",
            &["pub k:"],
        ),
        section(
            "a torsion spring",
            ("k", "N*m/rad"),
            "torsion_springs { hinge { stiffness: k, twist: theta } }",
            &["pub k:"],
        ),
        section(
            "a damper",
            ("b", "N*s/m"),
            "dampers { track { damping: b, stretch: x } }",
            &["pub b:", "pub fn dissipation<"],
        ),
        section(
            "a dissipation function",
            ("c", "N*m*s"),
            "dissipations { air: c*der(theta)^2/2 }",
            &["pub c:", "pub fn dissipation_rate<"],
        ),
        section(
            "a potential",
            ("c", "J/m^4"),
            "potentials { well: c*x^4 }",
            &["pub c:", "pub fn potential_energy<"],
        ),
        section(
            "a load",
            ("F", "N"),
            "forces { wind { on: x, value: F } }",
            &["pub F:", "pub fn applied<", "pub fn work_rate<"],
        ),
        instead(
            "motion prescribed in time",
            &[("e", "m"), ("w", "rad/s")],
            ("at: (x, 0)", "at: (x + e*cos(w*t), 0)"),
            &["pub e:", "pub w:", "pub fn work_rate<"],
        ),
        Row {
            // In the accelerations it costs nothing, as it is added to m l²
            // when parameters are prepared.
            role: Role::KineticEnergy,
            ..instead(
                "the inertia of a body, in `kinetic_energy`",
                &[("J", "kg*m^2")],
                ("bob { mass: m,", "bob { mass: m, inertia: J, angle: theta,"),
                &["pub J:"],
            )
        },
        instead(
            "an offset",
            &[("d", "m")],
            ("l*sin(theta)", "l*sin(theta) + d*cos(theta)"),
            &["pub d:"],
        ),
        Row {
            feature: "all dampers of a large machine",
            shown: "`vibrating_crusher`, bx = by = 0".into(),
            role: Role::Accelerations,
            with: crusher,
            off: zero,
            never,
            gone: &["pub bx:", "pub fn dissipation<"],
        },
        asked("inputs", inputs, Role::Accelerations, &["pub u:", "u: &"]),
        asked(
            "an output",
            "outputs { height: m = -l*cos(theta) }",
            Role::Output(0),
            &["height"],
        ),
        asked(
            "an assumption",
            "assume { l*cos(theta) > 0 }",
            Role::Assumption(0),
            &["pub fn assumption_0<"],
        ),
        asked(
            "derivatives",
            "derivatives { coordinates, rates }",
            Role::Derivatives,
            &["by_rates", "Linearize"],
        ),
        asked(
            "stages",
            "stages { time, coordinates }",
            Role::AccelerationsAt,
            &["at_position", "Staged"],
        ),
        asked(
            "frames, definitions and circles that nothing uses",
            "define { h = l*cos(theta) } frames { f = ground.shift(h, x).turn(theta) } \
             circles { wheel { on: f, center: (l, 0), radius: l } }",
            Role::Accelerations,
            &[],
        ),
    ]
}

#[test]
fn what_is_switched_off_is_what_was_never_written() {
    for row in rows() {
        let [with, off, never] = [&row.with, &row.off, &row.never].map(|text| made(text));
        let feature = row.feature;
        assert_eq!(off.program, never.program, "{feature}");
        assert_eq!(off.rust, never.rust, "{feature}");
        assert_eq!(off.c, never.c, "{feature}");
        for name in row.gone {
            let says = |text: &str| text.lines().any(|line| line.contains(name));
            assert!(says(&with.rust), "{feature}: {name} is never said");
            assert!(!says(&never.rust), "{feature}: {name} is still there");
        }
        let (dear, cheap) = (
            counts(&with.program, row.role),
            counts(&never.program, row.role),
        );
        if row.gone.is_empty() {
            assert_eq!(with.program, never.program, "{feature}");
        } else {
            assert!(cheap.cost() < dear.cost(), "{feature}: {cheap} of {dear}");
        }
    }
}

/// Outputs, assumptions and derivatives do not change the accelerations.
#[test]
fn what_is_asked_beside_the_accelerations_does_not_change_them() {
    let asked = |row: &Row| matches!(row.role, Role::Output(_) | Role::Assumption(_));
    let rows: Vec<Row> = rows().into_iter().filter(asked).collect();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let [with, never] = [&row.with, &row.never].map(|text| made(text));
        let of = |made: &Made| counts(&made.program, Role::Accelerations);
        assert_eq!(of(&with), of(&never), "{}", row.feature);
    }
}

/// A machine, and the same machine without a feature.
struct Pair {
    feature: &'static str,
    shown: [&'static str; 2],
    role: Role,
    with: String,
    without: String,
    /// The multiplications, additions and divisions of the textbook's formula, and its sines: an upper bound on those of the program.
    by_hand: Option<([usize; 4], &'static str)>,
}

fn pairs() -> Vec<Pair> {
    let [orbit, cart] = ["Orbit", "Cart"].map(on_the_page);
    let elastic = cart
        .replace(", l: m = 0.8", "")
        .replace("theta: rad = 0.3", "theta: rad = 0.3, l: m = 0.8");
    let train = on_the_page("Train");
    let hung = plus(
        &train,
        "coordinates { phi: rad = 1 } parameters { l: m = 1 }
         bodies { bob { mass: m, at: (x + l*sin(phi), -l*cos(phi)) } }",
    );
    let polar = orbit.clone();
    let cartesian = orbit
        .replace("r: m = 1, phi: rad", "x: m = 1, y: m")
        .replace("polar(r, phi)", "(x, y)")
        .replace("assume { r > 0 }", "")
        .replace("stretch: r - l", "stretch: x - l");
    assert_ne!(polar, cartesian);
    let weighted = plus(&orbit, "parameters { g: m/s^2 = 9.81 } gravity (0, -g);");
    let damped = plus(
        &train,
        "parameters { b: N*s/m = 2 } dampers { slip { damping: b, stretch: x } }",
    );
    let apart = on_the_page("Apart");
    let joined = plus(
        &apart,
        "springs { rope { stiffness: k, stretch: phi - psi } } parameters { k: N*m = 2 }",
    );
    vec![
        Pair {
            feature: "constant entries of M",
            shown: ["`Cart`, l a coordinate", "`Cart`"],
            role: Role::MassMatrix,
            with: elastic,
            without: cart,
            by_hand: Some(([1, 0, 0, 1], "M + m, m l cos θ, m l²")),
        },
        Pair {
            feature: "a constant M, factored with the parameters",
            shown: ["`Train` with a pendulum", "`Train`"],
            role: Role::Accelerations,
            with: hung,
            without: train.clone(),
            by_hand: Some(([4, 2, 0, 0], "(k₂ (y − x) − k₁ x)/m, k₂/M (x − y)")),
        },
        Pair {
            feature: "velocities in the forces",
            shown: ["`Train` with a damper", "`Train`"],
            role: Role::Accelerations,
            with: damped,
            without: train,
            by_hand: None,
        },
        Pair {
            feature: "coupling of coordinates",
            shown: ["`Apart` with a spring", "`Apart`"],
            role: Role::Accelerations,
            with: joined,
            without: apart,
            by_hand: Some(([2, 0, 0, 2], "−(g/l) sin φ, −(g/l) sin ψ")),
        },
        Pair {
            feature: "dependence on an angle",
            shown: ["`Orbit` with gravity", "`Orbit`: φ is ignorable"],
            role: Role::Accelerations,
            with: weighted,
            without: orbit,
            by_hand: None,
        },
        Pair {
            feature: "curved coordinates",
            shown: ["`Orbit`", "the same in x and y, which enter linearly"],
            role: Role::Accelerations,
            with: polar,
            without: cartesian,
            by_hand: Some(([1, 1, 0, 0], "k/m (l − x), 0")),
        },
    ]
}

#[test]
fn what_has_a_simple_structure_has_a_short_program() {
    for pair in pairs() {
        let (with, without) = (made(&pair.with), made(&pair.without));
        let (dear, cheap) = (
            counts(&with.program, pair.role),
            counts(&without.program, pair.role),
        );
        println!("{}: {dear} | {cheap}", pair.feature);
        assert!(cheap.cost() < dear.cost(), "{}", pair.feature);
        if let Some((most, formula)) = pair.by_hand {
            let found = [
                cheap.multiplications,
                cheap.additions,
                cheap.divisions,
                cheap.sincos,
            ];
            assert_eq!(found, most, "{}: {formula}", pair.feature);
            assert_eq!((cheap.other, cheap.guards), (0, 0), "{}", pair.feature);
        }
    }
}

/// Quantities without influence are not read.
#[test]
fn nothing_is_read_that_does_not_matter() {
    let reads = |spec: &str, role| {
        let made = made(spec);
        made.program.function(role).map(|function| {
            let sources = function.code.iter().filter_map(|op| match op {
                Op::Read(source) => Some(*source),
                _ => None,
            });
            (function.reads(), sources.collect::<Vec<_>>())
        })
    };
    let [cart, orbit, train] = ["Cart", "Orbit", "Train"].map(on_the_page);
    let accelerations = |spec: &str| reads(spec, Role::Accelerations).expect("they are there");
    let (of_cart, sources) = accelerations(&cart);
    assert!(!of_cart.time && !of_cart.inputs);
    // The accelerations do not depend on the cart's position and velocity.
    assert!(!sources.contains(&Source::Coordinate(0)) && !sources.contains(&Source::Velocity(0)));
    let (of_orbit, sources) = accelerations(&orbit);
    assert!(of_orbit.velocities && !sources.contains(&Source::Coordinate(1)));
    let (of_train, _) = accelerations(&train);
    assert!(!of_train.velocities && !of_train.time && of_train.coordinates);
    // A drive makes time an argument.
    let driven = cart.replace("at: (x, 0)", "at: (x + l*cos(pi*sqrt(k/m)*t), 0)");
    let driven = plus(&driven, "parameters { k: N/m = 2 }");
    assert!(accelerations(&driven).0.time);
}

#[test]
fn the_page_says_what_is_counted() {
    let mut expected = Vec::new();
    for row in rows() {
        let [with, never] = [&row.with, &row.never].map(|text| made(text));
        expected.push(format!(
            "| {} | {} | {} | {} |",
            row.feature,
            row.shown,
            counts(&with.program, row.role),
            counts(&never.program, row.role),
        ));
    }
    for pair in pairs() {
        let (with, without) = (made(&pair.with), made(&pair.without));
        let [more, less] = pair.shown;
        expected.push(format!(
            "| {} | {more} | {} | {less} | {} |",
            pair.feature,
            counts(&with.program, pair.role),
            counts(&without.program, pair.role),
        ));
    }
    for name in STAGED {
        let made = made(&plus(&library(name), "stages { time, coordinates }"));
        let roles = [
            Role::Accelerations,
            Role::AtTime,
            Role::AtPosition,
            Role::AccelerationsAt,
        ];
        let counts = roles.map(|role| counts(&made.program, role).to_string());
        expected.push(format!("| `{name}` | {} |", counts.join(" | ")));
    }
    let page = page();
    let missing: Vec<&String> = expected
        .iter()
        .filter(|row| !page.lines().any(|line| line == *row))
        .collect();
    assert!(missing.is_empty(), "not on the page:\n{missing:#?}");
    // The page has no row that is not counted here.
    let is_row = |line: &&str| {
        line.starts_with("| ")
            && !line.contains("---")
            && !line.contains("| with")
            && !line.contains("| at once")
    };
    let shown = page.lines().filter(is_row).count();
    assert_eq!(shown, expected.len());
}
