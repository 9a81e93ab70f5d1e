//! The meaning of specs, and the messages for specs that are wrong.

use std::collections::BTreeSet;

use lagrangian_spec::diagnostic::Code::{self, *};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::element::{Contribution, Element, Energy, Site};
use lagrangian_spec::model::{Inertia, Model, Rotation};
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::{Dag, Expr, Rational, evaluate};

/// The spec into which most mistakes are put.
const BASE: &str = include_str!("resolve/base.machine");

/// A list of all mistakes that a spec can contain.
const MISTAKES: &str = include_str!("resolve/mistakes.txt");

/// The files that variants extend.
fn files() -> InMemory {
    let variant =
        |name: &str, base: &str| format!("machine {name} extends \"{base}\" {{ gravity (0, 0); }}");
    let files = InMemory::new()
        .with("base.machine", BASE)
        .with("space.machine", include_str!("resolve/space.machine"))
        .with(
            "broken.machine",
            "machine Broken in plane { parameters { m kg } }",
        )
        .with(
            "motor.csv",
            "speed [rpm], torque [N*m], current [A], force [N]\n0, 2, 1, 0\n1500, 0, 3, 1\n",
        )
        .with("broken.csv", "x, y\n1, 2\n2, two\n")
        .with("slash.csv", "angle/deg, torque [N*m]\n0, 2\n90, 0\n")
        .with("round.csv", "angle [deg], torque (N*m)\n0, 2\n90, 0\n")
        .with("self.machine", variant("Itself", "self.machine"))
        .with("there.machine", variant("There", "back.machine"))
        .with("back.machine", variant("Back", "there.machine"));
    // A chain of variants that is too long.
    (0..100).fold(files, |files, i| {
        files.with(
            format!("variant{i}.machine"),
            variant("V", &format!("variant{}.machine", i + 1)),
        )
    })
}

/// Takes a spec with its mistakes marked `«…»`, and returns it without the marks, with the marked ranges in bytes.
fn unmarked(text: &str) -> (String, Vec<(u32, u32)>) {
    let mut plain = String::new();
    let mut marks = Vec::new();
    for part in text.split_inclusive(['«', '»']) {
        plain.push_str(part.trim_end_matches(['«', '»']));
        let here = plain.len() as u32;
        if part.ends_with('«') {
            marks.push((here, here));
        } else if part.ends_with('»') {
            marks
                .iter_mut()
                .rfind(|(a, b)| a == b)
                .expect("a mark begins")
                .1 = here;
        }
    }
    (plain, marks)
}

fn resolve<'d>(
    dag: &'d Dag,
    text: &str,
    constants: &[(&str, Rational)],
    sources: &mut Sources,
) -> (Option<Model<'d>>, Report) {
    let mut report = Report::new();
    let constants: Vec<(String, Rational)> = constants
        .iter()
        .map(|(name, value)| (name.to_string(), value.clone()))
        .collect();
    let files = &mut files();
    let model = lagrangian_spec::model(
        dag,
        "test.machine",
        text,
        &constants,
        files,
        sources,
        &mut report,
    );
    assert_eq!(model.is_some(), !report.has_errors());
    (model, report)
}

/// Checks that exactly the marked words are reported, all with this code, and that the message contains `words`.
fn mistake(code: &str, words: &str, text: &str) -> Result<(), String> {
    let (plain, marks) = unmarked(text);
    let mut sources = Sources::new();
    let dag = Dag::new();
    let (_, report) = resolve(&dag, &plain, &[], &mut sources);
    let shown = report.render_short(&sources);
    let found: Vec<(&str, &str)> = report
        .diagnostics()
        .iter()
        .map(|found| (found.code.as_str(), sources.words(found.span)))
        .collect();
    let expected: Vec<(&str, &str)> = marks
        .iter()
        .map(|&(start, end)| (code, &plain[start as usize..end as usize]))
        .collect();
    if found == expected && shown.contains(words) {
        return Ok(());
    }
    Err(format!("{text}\nis to say {code}: {words}\n{shown}\n"))
}

/// The rows of the list: a code, a whole machine with marks, and a part of the message.
fn listed_mistakes() -> impl Iterator<Item = (&'static str, String, &'static str)> {
    let rows = MISTAKES
        .lines()
        .filter(|line| line.contains(" |") && !line.starts_with(' '));
    rows.map(|line| {
        let mut parts = line.split(" |").map(str::trim);
        let mut part = || parts.next().unwrap_or_default();
        let (code, text, words) = (part(), part(), part());
        let text = if text.starts_with("machine") {
            text.to_owned()
        } else {
            format!("machine Test extends \"base.machine\" {{ {text} }}")
        };
        (code, text, words)
    })
}

#[track_caller]
fn says(code: Code, words: &str, text: &str) {
    mistake(code.as_str(), words, text).unwrap_or_else(|said| panic!("{said}"));
}

#[test]
fn every_mistake_is_told_at_its_words() {
    let mut failures = String::new();
    let mut codes = BTreeSet::new();
    for (code, text, words) in listed_mistakes() {
        codes.insert(code);
        failures.extend(mistake(code, words, &text).err());
    }
    assert!(failures.is_empty(), "{failures}");
    // The codes of this stage, which are contiguous in the list.
    let first = Code::ALL.iter().position(|code| *code == ExtendsItself);
    let last = Code::ALL.iter().position(|code| *code == NoCoordinates);
    let told = |code: &&Code| !codes.contains(code.as_str());
    let in_files = [ExtendsItself, ExtendsTooDeep]; // their mistakes involve several files
    let untold: Vec<&Code> = Code::ALL[first.unwrap()..=last.unwrap()]
        .iter()
        .filter(told)
        .filter(|code| !in_files.contains(code))
        .collect();
    assert!(untold.is_empty(), "no example of {untold:?}");
}

/// The model of a spec that must have no mistakes.
#[track_caller]
fn sound<'d>(dag: &'d Dag, text: &str) -> Model<'d> {
    sized(dag, text, &[])
}

#[track_caller]
fn sized<'d>(dag: &'d Dag, text: &str, constants: &[(&str, Rational)]) -> Model<'d> {
    let mut sources = Sources::new();
    let (model, report) = resolve(dag, text, constants, &mut sources);
    model.unwrap_or_else(|| panic!("{text}\n{}", report.render_short(&sources)))
}

#[test]
fn a_family_is_unrolled_in_order() {
    let dag = Dag::new();
    let text = "machine Test extends \"base.machine\" { assume { q[i] > -i for i in 1..N } }";
    let model = sized(&dag, text, &[("N", Rational::from(5))]);
    let names = listed(model.coordinates.iter().map(|q| &q.name));
    assert_eq!(names, "x y phi q[1] q[2] q[3] q[4] q[5]");
    assert_eq!(model.assumptions[4].text, "q[4] > -4");
    assert_eq!(model.constants[0].value, dag.int(5));
}

#[test]
fn constants_from_outside() {
    let text = |name: &str| {
        let mut sources = Sources::new();
        let dag = Dag::new();
        let (_, report) = resolve(&dag, BASE, &[(name, Rational::from(4))], &mut sources);
        let errors = report.diagnostics().into_iter();
        errors
            .map(|error| error.render_short(&sources) + "\n")
            .collect::<String>()
    };
    assert_eq!(text("N"), "");
    assert!(
        text("n").contains("the machine has no constant `n` to set"),
        "{}",
        text("n")
    );
    assert!(text("n").contains("did you mean `N`?"), "{}", text("n"));
    assert!(text("l").contains("`l` is a parameter"), "{}", text("l"));
    assert!(
        text("zzz").contains("its constants are `N`"),
        "{}",
        text("zzz")
    );
    let huge = {
        let mut sources = Sources::new();
        let dag = Dag::new();
        let (_, report) = resolve(
            &dag,
            BASE,
            &[("N", Rational::from(1_000_000_000))],
            &mut sources,
        );
        report.render_short(&sources)
    };
    assert!(huge.contains("[too-large]"), "{huge}");
    // A family may have no members.
    let dag = Dag::new();
    assert_eq!(
        sized(&dag, BASE, &[("N", Rational::ZERO)])
            .coordinates
            .len(),
        3
    );
}

/// The parameters of a model that can be set, the derived parameters with their values at these, and the
/// mass of the first body at these.
fn parameters(model: &Model<'_>, values: &[f64]) -> (String, String, f64) {
    let value = |symbol| {
        let mut known = model.parameters.iter().zip(values);
        let found = known.find(|(parameter, _)| parameter.symbol.as_symbol() == Some(symbol));
        found.map_or(f64::NAN, |(_, value)| *value)
    };
    let derived = model.derived_parameters.iter().map(|parameter| {
        let number = evaluate(model.dag, &[parameter.value], value)[0];
        format!("{} = {number} {}", parameter.name, parameter.unit_text)
    });
    let derived: Vec<String> = derived.collect();
    let mass = evaluate(model.dag, &[model.bodies[0].mass], value)[0];
    let own = listed(model.parameters.iter().map(|parameter| &parameter.name));
    (own, derived.join(", "), mass)
}

/// A mass derived from a density, a length in mm and a definition; a family of stiffnesses; and a value that depends on constants
/// only, which is a default.
const DERIVED: &str = "machine Test in plane {
    constants { N = 2, f = 3 }
    define { area = d*w, twice = 2*f }
    parameters { M: kg = rho*area*L, rho: kg/m^3 = 1024, d: mm = w/4, w: m = 0.25, L: m = 0.5, c: 1 = twice,
        k[i in 1..N]: N/m = i*k0*c, k0: N/m = 10 }
    coordinates { x: m }
    bodies { b { mass: M, at: (x, 0) } }
    springs { s[i in 1..N] { stiffness: k[i], stretch: x } }
}";

#[test]
fn parameters_follow_from_others() {
    let dag = Dag::new();
    let model = sound(&dag, DERIVED);
    let defaults = [1024.0, 0.25, 0.5, 6.0, 10.0];
    let found: Vec<f64> = model
        .parameters
        .iter()
        .map(|parameter| lagrangian_symbolic::nearest(parameter.default.expect("a default")))
        .collect();
    assert_eq!(found, defaults);
    // ρ d w L with d = w/4 = 62.5 mm: 1024 * 0.0625 * 0.25 * 0.5, which is exact in doubles.
    let (own, derived, mass) = parameters(&model, &defaults);
    assert_eq!(own, "rho w L c k0");
    assert_eq!(
        derived,
        "M = 8 kg, d = 62.5 mm, k[1] = 60 N/m, k[2] = 120 N/m"
    );
    assert_eq!(mass, 8.0);
    // The width acts twice, as d depends on it.
    let (_, derived, mass) = parameters(&model, &[1024.0, 0.5, 0.5, 6.0, 1.0]);
    assert_eq!(
        derived,
        "M = 32 kg, d = 125 mm, k[1] = 6 N/m, k[2] = 12 N/m"
    );
    assert_eq!(mass, 32.0);
}

#[test]
fn a_parameter_that_is_given_follows_no_more() {
    let dag = Dag::new();
    // A value given outside the spec, in the declared unit, becomes the default.
    let model = sized(&dag, DERIVED, &[("d", Rational::from(125))]);
    assert_eq!(model.parameters[1].default, Some(dag.int(125)));
    let values = [1024.0, 125.0, 0.25, 0.5, 6.0, 10.0];
    let (own, derived, mass) = parameters(&model, &values);
    assert_eq!(own, "rho d w L c k0");
    assert_eq!(derived, "M = 16 kg, k[1] = 60 N/m, k[2] = 120 N/m");
    assert_eq!(mass, 16.0);
    // A name alone removes the value; removing it for one member of a family leaves the others.
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let spec = lagrangian_spec::parse(&mut sources, "test.machine", DERIVED, &mut report);
    let spec = spec.with_given(["M", "k[2]", "rho", "nothing"].map(str::to_owned));
    let model = Model::resolve(spec, &dag, &[], &mut files(), &mut sources, &mut report);
    let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let (own, derived, mass) = parameters(&model, &[7.0, 1.0, 0.25, 0.5, 6.0, 3.0, 10.0]);
    assert_eq!(own, "M rho w L c k[2] k0");
    assert_eq!(derived, "d = 62.5 mm, k[1] = 60 N/m");
    assert_eq!(mass, 7.0);
    assert_eq!(model.parameters[0].default, None);
    // A parameter used only by the replaced formula is not reported as unused.
    assert!(
        report.diagnostics().is_empty(),
        "{}",
        report.render_short(&sources)
    );
    // A variant may give a number or another formula.
    for (said, expected) in [("9", 9.0), ("2*rho*L*d*w", 16.0)] {
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let variant =
            format!("machine V extends \"derived.machine\" {{ parameters {{ M: kg = {said} }} }}");
        let files = &mut InMemory::new().with("derived.machine", DERIVED);
        let spec = lagrangian_spec::parse(&mut sources, "v.machine", &variant, &mut report);
        let model = Model::resolve(spec, &dag, &[], files, &mut sources, &mut report);
        let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        let values: Vec<f64> = model
            .parameters
            .iter()
            .map(|parameter| lagrangian_symbolic::nearest(parameter.default.expect("a default")))
            .collect();
        assert_eq!(parameters(&model, &values).2, expected);
    }
}

#[test]
fn values_for_which_a_derived_parameter_is_no_number_are_refused() {
    let dag = Dag::new();
    let text = "machine Test in plane {
        parameters { a: m = 2, b: m = 1, M: kg = (1*kg*m)/(a - b), w: 1 = sqrt(a/b) }
        coordinates { x: m }
        bodies { b { mass: w*M, at: (x, 0) } }
    }";
    let model = sound(&dag, text);
    let refused = |values: &[f64]| -> Vec<String> {
        let said = model.parameter_diagnostics(values).into_iter();
        said.map(|diagnostic| diagnostic.message).collect()
    };
    assert_eq!(refused(&[2.0, 1.0]), Vec::<String>::new());
    assert_eq!(
        refused(&[1.0, 1.0]),
        ["a derived parameter must be a finite number, found inf"]
    );
    assert_eq!(
        refused(&[1.0, -1.0]),
        ["a derived parameter must be a finite number, found NaN"]
    );
    // Unknown values cause no message.
    assert_eq!(refused(&[f64::NAN, 1.0]), Vec::<String>::new());
}

#[test]
fn a_long_chain_of_derived_parameters_is_read_in_time() {
    let chain: String = (1..=20_000)
        .map(|i| format!("p{}: m = p{i}, ", i - 1))
        .collect();
    let dag = Dag::new();
    let text = format!(
        "machine Test in plane {{ parameters {{ {chain} p20000: m = 3 }} coordinates {{ x: m }}
         bodies {{ b {{ mass: 1, at: (x + p0, 0) }} }} }}"
    );
    let model = sound(&dag, &text);
    assert_eq!(model.parameters.len(), 1);
    assert_eq!(model.derived_parameters.len(), 20_000);
    assert_eq!(
        model.derived_parameters[0].value,
        model.parameters[0].symbol
    );
}

#[test]
fn definitions_stand_in_any_order() {
    let forward: String = (1..=2000)
        .map(|i| format!("g{i} = g{}.turn(q).shift(l, 0), ", i - 1))
        .collect();
    let backward: String = (1..=2000)
        .rev()
        .map(|i| format!("g{i} = g{}.turn(q).shift(l, 0), ", i - 1))
        .collect();
    let machine = |frames: &str| {
        format!(
        "machine Test in plane {{ bodies {{ b {{ mass: 1, at: g2000.origin }} }} frames {{ {frames} g0 = ground }}
         parameters {{ l: m = 1 }} coordinates {{ q: rad }} }}"
    )
    };
    let dag = Dag::new();
    let ends = [forward, backward].map(|frames| sound(&dag, &machine(&frames)).bodies[0].at.len());
    assert_eq!(ends, [2, 2]);
    // A family that counts down, deeper than any stack.
    let text =
        "machine Test in plane { constants { N = 20000 } coordinates { q: rad } parameters { l: m }
        bodies { b { mass: 1, at: g[1].origin } }
        frames { g[i in 1..N] = g[i+1].shift(l, 0), g[N+1] = ground.turn(q) } }";
    sound(&dag, text);
    // A circular definition of the same length.
    says(
        CircularDefinition,
        "",
        &text
            .replace("g[N+1] = ground", "g[N+1] = «g[1]»")
            .replace("m }\n", "m = 1 }\n"),
    );
}

#[test]
fn deep_formulas_need_no_stack() {
    // Nesting as deep as the parser allows, on the stack of a test thread.
    let depth = lagrangian_spec::syntax::NESTING_LIMIT;
    for (open, close) in [
        ("(", ")"),
        ("sin(", ")"),
        ("-(", ")"),
        ("(1 + ", ")"),
        ("2*(", ")"),
        ("min(1, ", ")"),
        ("f.point(0*l + ", ", 0*l)"),
    ] {
        let text = format!(
            "define {{ a = {}phi{} }}",
            open.repeat(depth),
            close.repeat(depth)
        );
        let mut sources = Sources::new();
        let dag = Dag::new();
        resolve(
            &dag,
            &format!("machine Test extends \"base.machine\" {{ {text} }}"),
            &[],
            &mut sources,
        );
    }
}

#[test]
fn variants() {
    let nowhere = r#"machine Test extends «"nowhere.machine"» { define { a = unknown } }"#;
    says(
        UnreadableFile,
        "cannot read `nowhere.machine`: there is no such file",
        nowhere,
    );
    let space = r#"machine Test «in space» extends "base.machine" { gravity (0, 0); }"#;
    says(
        SpaceChanged,
        "a variant must move in the plane or in space, as its base does",
        space,
    );
    // Mistakes of a base are reported in the base.
    let broken = errors(r#"machine Test extends "broken.machine" { gravity (0, 0); }"#);
    assert!(broken.starts_with("broken.machine:1:"), "{broken}");
    let chain = errors(r#"machine Test extends "there.machine" { gravity (0, 0); }"#);
    assert!(
        chain.contains("`there.machine` extends `back.machine` extends `there.machine`"),
        "{chain}"
    );
    let itself = errors(r#"machine Test extends "self.machine" { gravity (0, 0); }"#);
    assert!(itself.contains("[extends-itself]"), "{itself}");
    let endless = errors(r#"machine Test extends "variant0.machine" { gravity (0, 0); }"#);
    assert!(endless.contains("[extends-too-deep]"), "{endless}");
}

#[test]
fn what_is_kept_of_a_start_is_by_coordinate() {
    use lagrangian_spec::model::Variable::{Coordinate, Rate};
    let dag = Dag::new();
    let kept = variant(&dag, "keep { der(q[2]), q, phi, der(x) }").kept;
    let q = (3..6).map(Coordinate);
    let known = [Coordinate(2)]
        .into_iter()
        .chain(q)
        .chain([Rate(0), Rate(4)]);
    assert_eq!(kept, known.collect::<Vec<_>>());
    assert_eq!(
        variant(&dag, "keep { der(q[i in 2..3]) }").kept,
        [Rate(4), Rate(5)]
    );
    assert_eq!(variant(&dag, "").kept, []);
}

/// The error messages for a text.
fn errors(text: &str) -> String {
    let mut sources = Sources::new();
    let dag = Dag::new();
    let (_, report) = resolve(&dag, text, &[], &mut sources);
    report.render_short(&sources)
}

/// A variant of [`BASE`].
#[track_caller]
fn variant<'d>(dag: &'d Dag, text: &str) -> Model<'d> {
    sound(
        dag,
        &format!("machine Test extends \"base.machine\" {{ {text} }}"),
    )
}

fn listed<'m>(names: impl Iterator<Item = &'m lagrangian_spec::model::Name>) -> String {
    names.map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

#[test]
fn a_variant_adds_replaces_and_removes() {
    let dag = Dag::new();
    let coordinates = |text: &str| listed(variant(&dag, text).coordinates.iter().map(|q| &q.name));
    let parameters = |text: &str| listed(variant(&dag, text).parameters.iter().map(|p| &p.name));
    assert_eq!(coordinates("gravity (0, 0);"), "x y phi q[1] q[2] q[3]");
    // A redeclared coordinate keeps its place; a new one is last.
    assert_eq!(
        coordinates("coordinates { z: m, y: m = 5 }"),
        "x y phi q[1] q[2] q[3] z"
    );
    assert_eq!(
        coordinates("coordinates { q[2]: rad = 5 }"),
        "x y phi q[1] q[2] q[3]"
    );
    assert_eq!(
        coordinates("coordinates { q[4]: rad = 5 }"),
        "x y phi q[1] q[2] q[3] q[4]"
    );
    assert_eq!(coordinates("constants { N = 1 }"), "x y phi q[1]");
    assert_eq!(coordinates("coordinates { q: rad }"), "x y phi q");
    assert_eq!(coordinates("remove coordinates.q;"), "x y phi");
    assert_eq!(coordinates("remove coordinates.q[2];"), "x y phi q[1] q[3]");
    assert_eq!(coordinates("remove coordinates.q[2..N];"), "x y phi q[1]");
    assert_eq!(
        coordinates("remove coordinates.q; coordinates { q: m }"),
        "x y phi q"
    );
    // A coordinate may become a parameter, and a parameter a coordinate.
    assert_eq!(
        coordinates("parameters { phi: rad = 0.1 }"),
        "x y q[1] q[2] q[3]"
    );
    assert_eq!(
        parameters("parameters { phi: rad = 0.1 }"),
        "m l k b J w mu phi"
    );
    assert_eq!(coordinates("define { phi = w*t }"), "x y q[1] q[2] q[3]");
    let model = variant(
        &dag,
        "springs { left { stiffness: 2*k, stretch: x } } remove springs.left;",
    );
    assert_eq!(
        listed(of(&model, "springs").map(|spring| &spring.name)),
        "left"
    );
    let model = variant(&dag, "parameters { l: m = 7 }");
    assert_eq!(model.parameters[1].default, Some(dag.int(7)));
    assert_eq!(model.name, "Test");
    assert!(
        variant(&dag, "gravity (0, -g); parameters { g: m/s^2 = 9.81 }")
            .gravity()
            .is_some()
    );
    let model = variant(
        &dag,
        "remove springs; springs { s { stiffness: k, stretch: y } }",
    );
    assert_eq!(of(&model, "springs").count(), 1);
    // If the base uses a removed name, the mistake is reported in the base.
    let gone = errors(r#"machine Test extends "base.machine" { remove frames.f; }"#);
    assert!(gone.starts_with("base.machine:"), "{gone}");
}

#[test]
fn coordinates_have_rates_at_the_start() {
    let dag = Dag::new();
    let rates = |text: &str| {
        let model = variant(&dag, text);
        let rates = model.coordinates.iter().map(|q| q.start_rate);
        let rates: Vec<Expr> = rates.collect();
        numbers(&dag, &rates, &[("w", 2.0), ("l", 5.0)])
    };
    assert_eq!(rates("gravity (0, 0);"), [0.0; 6]);
    assert_eq!(
        rates("coordinates { der(x): m/s = w*l, der(phi): rad/s = -pi }"),
        [10.0, 0.0, -std::f64::consts::PI, 0.0, 0.0, 0.0]
    );
    assert_eq!(
        rates("coordinates { der(q[i in 1..N]): rad/s = i*w, der(y): m/s = 1 }"),
        [0.0, 1.0, 0.0, 2.0, 4.0, 6.0]
    );
    assert_eq!(
        rates("coordinates { der(q): rad/s = w }"),
        [0.0, 0.0, 0.0, 2.0, 2.0, 2.0]
    );
    // A coordinate may have any name, even `der`.
    assert_eq!(
        rates("coordinates { der: m = 1, der(der): m/s = 3 }"),
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0]
    );
}

#[test]
fn a_variant_replaces_rates_and_drops_those_of_what_it_removes() {
    let base = "machine Base in plane {
        parameters { m: kg = 1 }
        coordinates { x: m, der(x): m/s = 1, y: m, der(y): m/s = 2 }
        bodies { b { mass: m, at: (x, y) } }
    }";
    let rates = |text: &str| {
        let dag = Dag::new();
        let mut sources = Sources::new();
        let mut report = Report::new();
        let mut files = InMemory::new().with("base.machine", base);
        let text = format!("machine Test extends \"base.machine\" {{ {text} }}");
        let name = "test.machine";
        let model = lagrangian_spec::model(
            &dag,
            name,
            &text,
            &[],
            &mut files,
            &mut sources,
            &mut report,
        );
        let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        let rates = model.coordinates.iter().map(|q| q.start_rate);
        let rates: Vec<Expr> = rates.collect();
        numbers(&dag, &rates, &[])
    };
    assert_eq!(rates("gravity (0, 0);"), [1.0, 2.0]);
    assert_eq!(rates("coordinates { der(y): m/s = 5 }"), [1.0, 5.0]);
    assert_eq!(rates("parameters { x: m = 3 }"), [2.0]);
    assert_eq!(rates("remove coordinates.x; define { x = 0 }"), [2.0]);
}

#[test]
fn a_variant_moves_the_end_of_the_fastest_motion_and_forgets_what_it_removes() {
    let base = "machine Base in plane {
        parameters { m: kg = 1, l: m = 3 }
        coordinates { x: m, y: m, s[1..2]: m }
        bodies { b { mass: m, at: (x, y) }, c[i in 1..2] { mass: m, at: (s[i], 0) } }
        brachistochrone { x = 1, y = -l, s[i in 1..2] = i*l }
    }";
    let ends = |text: &str| {
        let dag = Dag::new();
        let mut sources = Sources::new();
        let mut report = Report::new();
        let mut files = InMemory::new().with("base.machine", base);
        let text = format!("machine Test extends \"base.machine\" {{ {text} }}");
        let name = "test.machine";
        let model = lagrangian_spec::model(
            &dag,
            name,
            &text,
            &[],
            &mut files,
            &mut sources,
            &mut report,
        );
        let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        numbers(&dag, &model.destination, &[("l", 3.0)])
    };
    assert_eq!(ends("gravity (0, 0);"), [1.0, -3.0, 3.0, 6.0]);
    assert_eq!(
        ends("brachistochrone { y = l/3, s[2] = 0 }"),
        [1.0, 1.0, 3.0, 0.0]
    );
    assert_eq!(ends("parameters { x: m = 3 }"), [-3.0, 3.0, 6.0]);
    assert_eq!(ends("remove brachistochrone;"), [0.0; 0]);
}

#[test]
fn the_head_of_a_model_is_that_of_the_variant() {
    let dag = Dag::new();
    let model = sound(
        &dag,
        "/// What it is.\nmachine Other extends \"base.machine\" { outputs { a: rad = phi } }",
    );
    assert_eq!(
        (model.name.as_str(), model.docs.trim()),
        ("Other", "What it is.")
    );
    assert_eq!(
        listed(model.outputs.iter().map(|output| &output.name)),
        "height a"
    );
    assert_eq!(model.outputs[1].unit_text, "rad");
    let springs = lagrangian_spec::syntax::SectionKind::named("springs").expect("a section");
    assert!(model.section(springs).is_some());
    assert!(
        model
            .section(lagrangian_spec::syntax::SectionKind::Contacts)
            .is_none()
    );
}

#[test]
fn published_formulas() {
    let dag = Dag::new();
    let model = variant(
        &dag,
        "published \"Part I\" {
            kinetic_energy = 1/2*m*der(x)^2 + J*der(phi),
            kinetic_energy cart = 1/2*m*der(x)^2,
            potential_energy = 1/2*k*x^2,
            dissipation = 0,
            force phi = -k*x*l,
            position cart = (x, 0),
            velocity cart = (der(x), x),
            equation x: m*der(der(x)) + k*x = u,
            equation q[i in 1..N]: J*der(der(q[i])) = 0,
        }",
    );
    let texts: Vec<&str> = model.published[0]
        .items
        .iter()
        .map(|item| item.text.as_str())
        .collect();
    assert_eq!(
        texts.join(", "),
        "kinetic_energy, kinetic_energy cart, potential_energy, dissipation, force phi, position cart, \
         velocity cart, equation x, equation q[1], equation q[2], equation q[3]"
    );
    // A published formula may have wrong units: the comparison with it finds that, and here it is only a remark.
    let remarks: Vec<usize> = model.published[0]
        .items
        .iter()
        .map(|item| item.remarks.len())
        .collect();
    assert_eq!(remarks, [1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]);
    assert_eq!(
        model.published[0].items[0].remarks[0].message,
        "expected N*m, found N*m*s"
    );
}

#[test]
fn limits_on_size_end_in_messages() {
    let grows = |size: usize| {
        let terms: String = (0..size)
            .map(|i| format!("a{} = a{i}*sin(a{i} + {i}*x), ", i + 1))
            .collect();
        errors(&format!(
            "machine T extends \"base.machine\" {{ define {{ a0 = phi, {terms} }} }}"
        ))
    };
    assert_eq!(
        grows(100)
            .lines()
            .next()
            .map(|line| line.contains("unit-mismatch")),
        Some(true)
    );
    // Derivatives of nested sines, each several times longer than the previous one.
    let rates: String = (1..60)
        .map(|i| format!("a{i} = der(a{}), ", i - 1))
        .collect();
    let text = errors(&format!(
        "machine T extends \"base.machine\" {{ define {{ a0 = sin(sin(sin(t*w)*w*t)*exp(sin(t*w))), {rates} }} }}"
    ));
    assert!(text.contains("[too-large]"), "{text}");
    // Many members that share one expression take no memory, but the limit still ends them.
    let sum = vec!["sin(phi)"; 2000].join(" + ");
    let text = errors(&format!(
        "machine T extends \"base.machine\" {{ define {{ a[1..90000] = {sum} }} }}"
    ));
    assert!(text.contains("[too-large]"), "{text}");
}

/// Evaluates expressions, with the value of each symbol by its name.
fn numbers(dag: &Dag, expressions: &[Expr], values: &[(&str, f64)]) -> Vec<f64> {
    evaluate(dag, expressions, |symbol| {
        let name = dag.name(symbol);
        let known = values.iter().find(|(known, _)| *known == name);
        known.unwrap_or_else(|| panic!("no value for {name}")).1
    })
}

#[track_caller]
fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!(
            (a - b).abs() < 1e-13 * (1.0 + b.abs()),
            "{found:?} is not {expected:?}"
        );
    }
}

#[test]
fn planar_frames_are_where_trigonometry_puts_them() {
    let dag = Dag::new();
    let model = sound(
        &dag,
        "machine Test in plane {
            coordinates { x: m, y: m, a: rad, b: rad }
            frames { f = ground.shift(x, y).turn(a), g = f.shift(2, 1).turn(b) }
            bodies {
                one { mass: 1, at: g.point(3, 0) + polar(2, a) },
                two { mass: 1, inertia: 1, frame: g },
            }
            outputs {
                v: m/s = der(dot(one.at, (1, 0))), u: 1 = dot(g.vector(0, 1), f.vector(1, 0)),
                c: m = cross((1, 0), two.at), d: m = norm(two.at - f.origin),
            }
        }",
    );
    let (x, y, a, b, da, db): (f64, f64, f64, f64, f64, f64) = (0.3, -0.7, 0.4, 1.1, 0.9, -0.2);
    let values = [
        ("x", x),
        ("y", y),
        ("a", a),
        ("b", b),
        ("der(x)", 0.5),
        ("der(a)", da),
        ("der(b)", db),
    ];
    let g = [x + 2.0 * a.cos() - a.sin(), y + 2.0 * a.sin() + a.cos()];
    let one = [
        g[0] + 3.0 * (a + b).cos() + 2.0 * a.cos(),
        g[1] + 3.0 * (a + b).sin() + 2.0 * a.sin(),
    ];
    close(&numbers(&dag, &model.bodies[0].at, &values), &one);
    close(&numbers(&dag, &model.bodies[1].at, &values), &g);
    let outputs: Vec<Expr> = model.outputs.iter().map(|output| output.value).collect();
    let v = 0.5 - (2.0 * a.sin() + a.cos() + 2.0 * a.sin()) * da - 3.0 * (a + b).sin() * (da + db);
    close(
        &numbers(&dag, &outputs, &values),
        &[v, -b.sin(), g[1], 5f64.sqrt()],
    );
    let Rotation::Frame(pose) = model.bodies[1].rotation else {
        panic!("a frame was given");
    };
    close(
        &numbers(&dag, &[model.poses[pose.0 as usize].angle], &values),
        &[a + b],
    );
    let local = model.bodies[1].local.as_ref().map(|local| local.pose);
    assert_eq!(local, Some(pose));
    assert!(model.bodies[0].local.is_none());
    assert!(matches!(model.bodies[1].inertia, Inertia::Planar(one) if one == dag.one()));
}

#[test]
fn spatial_frames_turn_as_rotation_matrices_do() {
    let dag = Dag::new();
    let model = sound(
        &dag,
        "machine Test in space {
            coordinates { a: rad, b: rad, c: rad }
            frames { f = ground.turn(x, a).shift(1, 2, 3).turn(y, b).turn(z, c) }
            bodies { one { mass: 1, inertia: (1, 2, 3, 4, 5, 6), frame: f, at: f.point(4, 5, 6) } }
            outputs { d: m = dot(cross(one.at, (0, 1, 0)), (1, 0, 0)) }
        }",
    );
    type Matrix = [[f64; 3]; 3];
    let times = |a: Matrix, b: Matrix| -> Matrix {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    };
    let apply = |a: Matrix, v: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| (0..3).map(|k| a[i][k] * v[k]).sum())
    };
    let (a, b, c): (f64, f64, f64) = (0.4, -1.3, 2.2);
    let about_x = [
        [1.0, 0.0, 0.0],
        [0.0, a.cos(), -a.sin()],
        [0.0, a.sin(), a.cos()],
    ];
    let about_y = [
        [b.cos(), 0.0, b.sin()],
        [0.0, 1.0, 0.0],
        [-b.sin(), 0.0, b.cos()],
    ];
    let about_z = [
        [c.cos(), -c.sin(), 0.0],
        [c.sin(), c.cos(), 0.0],
        [0.0, 0.0, 1.0],
    ];
    let turned = times(times(about_x, about_y), about_z);
    let origin = apply(about_x, [1.0, 2.0, 3.0]);
    let arm = apply(turned, [4.0, 5.0, 6.0]);
    let at: Vec<f64> = (0..3).map(|i| origin[i] + arm[i]).collect();
    let values = [("a", a), ("b", b), ("c", c)];
    close(&numbers(&dag, &model.bodies[0].at, &values), &at);
    close(
        &numbers(&dag, &[model.outputs[0].value], &values),
        &[-at[2]],
    );
    let pose = &model.poses[model.frames[0].pose.0 as usize];
    for (k, axis) in pose.axes.iter().enumerate() {
        close(
            &numbers(&dag, axis, &values),
            &[turned[0][k], turned[1][k], turned[2][k]],
        );
    }
    for (id, pose) in model.poses.iter().enumerate().skip(1) {
        assert!((pose.parent.0 as usize) < id, "parents stand first");
    }
    let Inertia::Tensor(entries) = model.bodies[0].inertia else {
        panic!("six entries were given");
    };
    close(
        &numbers(&dag, &entries, &values),
        &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
    );
}

#[test]
fn a_chain_stays_short() {
    // Each link adds a constant number of terms, so the equations grow linearly with the number of links.
    let nodes = |n: i64| {
        let dag = Dag::new();
        sized(
            &dag,
            include_str!("../../../machines/chain_relative.machine"),
            &[("N", n.into())],
        );
        dag.len()
    };
    assert!(nodes(100) < 2 * nodes(50));
}

/// The elements of a section.
fn of<'m, 'd>(model: &'m Model<'d>, word: &'static str) -> impl Iterator<Item = &'m Element<'d>> {
    let all = model.elements.iter();
    all.filter(move |element| element.section.word == word)
}

/// The stretches of the elements of a section.
fn stretches<'d>(model: &Model<'d>, word: &'static str) -> Vec<Expr<'d>> {
    let contributions = of(model, word).flat_map(|element| &element.contributions);
    let stretches = contributions.filter_map(|contribution| match contribution {
        Contribution::Stored(Energy::Quadratic(of))
        | Contribution::Dissipated(Energy::Quadratic(of)) => Some(of.measure),
        _ => None,
    });
    stretches.collect()
}

#[test]
fn springs_between_points_stretch_by_their_distance() {
    let dag = Dag::new();
    let model = variant(
        &dag,
        "springs { s { stiffness: k, from: (0, 0), to: (x, y), length: l } }
         dampers { d { damping: b, from: (0, 0), to: (x, y) } }",
    );
    let (springs, dampers) = (stretches(&model, "springs"), stretches(&model, "dampers"));
    let stretches = [springs[1], dampers[0]];
    let values = [("x", 3.0), ("y", -4.0), ("l", 2.0)];
    close(&numbers(&dag, &stretches, &values), &[3.0, 5.0]);
    let between = |element: &Element| {
        let drawing = element.drawing.as_ref().expect("drawn");
        matches!(drawing.site, Site::Between(_))
    };
    let between: Vec<bool> = of(&model, "springs").map(between).collect();
    assert_eq!(between, [false, true]);
}

#[test]
fn a_distance_that_is_assumed_to_be_positive_has_no_root() {
    let dag = Dag::new();
    let model = sound(
        &dag,
        "machine Test in plane {
            parameters { k: N/m = 1, b: N*s/m = 1, l: m = 3 }
            coordinates { r: m = 1, phi: rad, x: m, y: m = 2, z: m }
            assume { r > 0, x < y, der(x) >= 0, l + z - x > 0 }
            bodies { one { mass: 1, at: polar(r, phi) }, two { mass: 1, at: (x, y) } }
            springs {
                radial { stiffness: k, from: (0, 0), to: one.at, length: l },
                back { stiffness: k, from: (y, 1), to: (x, 1) },
                train { stiffness: k, from: (x, 1), to: (l + z, 1), length: l },
                other { stiffness: k, from: (0, 0), to: (x, 0) },
            }
            dampers { radial { damping: b, from: one.at, to: (0, 0) } }
        }",
    );
    let [r, x, y, z] = [0, 2, 3, 4].map(|i| model.coordinates[i].q);
    let l = model.parameters[2].symbol;
    let springs = stretches(&model, "springs");
    assert_eq!(springs[..3], [r - l, y - x, z - x]);
    assert_eq!(stretches(&model, "dampers"), [r]);
    // The side of 0 on which it starts is not known.
    close(&numbers(&dag, &springs[3..], &[("x", -2.0)]), &[2.0]);
}

/// The examples of the language's reference.
const EXAMPLES: [(&str, &str); 5] = [
    (
        "vibrating_crusher.machine",
        include_str!("syntax/vibrating_crusher.machine"),
    ),
    ("chain.machine", include_str!("syntax/chain.machine")),
    (
        "crushing_crusher.machine",
        include_str!("syntax/crushing_crusher.machine"),
    ),
    ("prisms.machine", include_str!("syntax/prisms.machine")),
    (
        "heavy_top.machine",
        include_str!("../../../machines/heavy_top.machine"),
    ),
];

/// The error messages for an example of the reference, or for a damaged one.
fn example(text: &str) -> String {
    let files = EXAMPLES
        .into_iter()
        .fold(files(), |files, (name, text)| files.with(name, text));
    let (dag, mut files, mut sources, mut report) =
        (Dag::new(), files, Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "test.machine",
        text,
        &[],
        &mut files,
        &mut sources,
        &mut report,
    );
    assert_eq!(model.is_some(), !report.has_errors());
    report.render_short(&sources)
}

#[test]
fn the_examples_of_the_reference_resolve() {
    for (_, text) in EXAMPLES {
        assert_eq!(example(text), "");
    }
}

#[test]
fn the_machines_of_the_library_resolve() {
    let mut sources = Sources::new();
    let dag = Dag::new();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../machines");
    for entry in std::fs::read_dir(folder).expect("the library is there") {
        let path = entry.expect("it can be read").path();
        if path.extension().is_none_or(|ending| ending != "machine") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("it is text");
        let (mut report, name) = (Report::new(), path.to_string_lossy());
        let disk = &mut lagrangian_spec::source::Disk;
        lagrangian_spec::model(&dag, &name, &text, &[], disk, &mut sources, &mut report);
        assert_eq!(report.render_short(&sources), "");
    }
}

#[test]
fn damaged_examples_end_in_messages() {
    const WORDS: [&str; 24] = [
        "0", "1", "-", "*", "/", "^", "(", ")", "[", "]", "N", "x", "t", "i", "der", ".at",
        ".origin", ".turn", "1e9", "ground", "platform", "..", ",", "q",
    ];
    // Removes, doubles, exchanges or replaces a word.
    let number = |name: &str| std::env::var(name).ok().and_then(|n| n.parse::<u64>().ok());
    let (seed, rounds) = (
        number("SEED").unwrap_or(20_260_001),
        number("DAMAGES").unwrap_or(100),
    );
    println!("SEED={seed}");
    let mut state = seed;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    // The examples, and in fewer rounds every mistake of the list.
    let examples = EXAMPLES
        .into_iter()
        .map(|(_, text)| (text.to_owned(), rounds));
    let mistakes = listed_mistakes().map(|(_, text, _)| (unmarked(&text).0, rounds / 50 + 1));
    for (text, rounds) in examples.chain(mistakes) {
        let mut report = Report::new();
        let tokens = lagrangian_spec::token::lex(Default::default(), &text, &mut report);
        let words: Vec<&str> = tokens
            .iter()
            .map(|token| &text[token.span.start as usize..token.span.end as usize])
            .collect();
        for round in 0..rounds {
            let mut damaged = words.clone();
            for _ in 0..=random(3) {
                let (at, other) = (random(damaged.len()), random(damaged.len()));
                match random(5) {
                    0 => drop(damaged.remove(at)),
                    1 => damaged.insert(at, damaged[at]),
                    2 => damaged.swap(at, other),
                    3 => damaged[at] = damaged[other],
                    _ => damaged[at] = WORDS[random(WORDS.len())],
                }
            }
            let damaged = damaged.join(" ");
            let outcome = std::panic::catch_unwind(|| example(&damaged));
            assert!(outcome.is_ok(), "round {round}:\n{damaged}");
        }
    }
}

/// Pairs of units of the same dimension, and their ratio as a quotient of two decimal fractions.
const CONVERSIONS: [(&str, &str, &str, &str); 8] = [
    // One of the first unit is this many of the second.
    ("mm", "m", "1", "1000"),
    ("km", "inch", "1000", "0.0254"),
    ("kg", "lb", "1", "0.45359237"),
    ("h", "ms", "3600000", "1"),
    ("kN", "lbf", "1000", "4.4482216152605"),
    ("rev", "deg", "360", "1"),
    ("kWh", "MJ", "3.6", "1"),
    ("mA", "uA", "1000", "1"),
];

#[test]
fn a_number_with_a_unit_is_converted_exactly() {
    let mut seed = 7u64;
    let mut random = move |below: u64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % below
    };
    for case in 0..200 {
        let number =
            Rational::new(1 + random(1000) as i64, 1 + random(9) as i64).expect("a number");
        let (mut from, mut to, mut expected) = (Vec::new(), Vec::new(), number.clone());
        for _ in 0..1 + random(3) {
            let (first, second, above, below) = CONVERSIONS[random(8) as usize];
            let power = [1, 2, -1, -2, 3][random(5) as usize];
            let decimal = |text| Rational::parse_decimal(text).expect("a number");
            let ratio = decimal(above).checked_div(&decimal(below));
            let ratio = ratio
                .and_then(|ratio| ratio.pow(power))
                .expect("no unit is zero");
            expected = &expected * &ratio;
            from.push(format!("{first}^({power})"));
            to.push(format!("{second}^({power})"));
        }
        let (from, to) = (from.join("*"), to.join("*"));
        // As a default, as a value with a unit, and set from outside.
        let text = format!(
            "machine Test in plane {{
                parameters {{ a: {to} = {number}*{from}, b: {from} = {number} }}
                constants {{ c: {from} = 1 }}
                coordinates {{ x: m }}
                bodies {{ cart {{ mass: 1, at: (x, 0) }} }}
                outputs {{ d: {to} = b, e: {to} = c, f: {from} = c }}
            }}"
        );
        let (dag, mut sources) = (Dag::new(), Sources::new());
        let (model, report) = resolve(&dag, &text, &[("c", number.clone())], &mut sources);
        let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
        let default = model.parameters[0]
            .default
            .and_then(|default| default.as_constant());
        assert_eq!(default, Some(expected.clone()), "case {case}: {text}");
        let symbol = model.parameters[1].symbol;
        let ratio = expected.checked_div(&number).expect("a number");
        assert_eq!(
            model.outputs[0].value / symbol,
            dag.constant(ratio),
            "{text}"
        );
        assert_eq!(
            model.outputs[1].value.as_constant(),
            Some(expected),
            "{text}"
        );
        assert_eq!(model.outputs[2].value.as_constant(), Some(number), "{text}");
    }
}

/// `acos` and the like are angles also of bare numbers and of vectors of bare numbers: converted where degrees are declared.
#[test]
fn an_inverse_function_is_an_angle_in_rad() {
    let text = "machine Test in plane {
        coordinates { x: m, phi: rad }
        frames { f = ground.turn(phi) }
        bodies { cart { mass: 1, at: (x, 0) } }
        define {
            a = acos(dot(f.vector(0, 1), (0, 1))), b = atan2(dot(f.vector(0, 1), (0, 1)), 2), c = asin(1/3), d = atan(2),
        }
        outputs {
            a_deg: deg = a, b_deg: deg = b, c_deg: deg = c, d_deg: deg = d,
            a_rad: rad = a, b_rad: rad = b, c_rad: rad = c, d_rad: rad = d,
        }
    }";
    let (dag, mut sources) = (Dag::new(), Sources::new());
    let (model, report) = resolve(&dag, text, &[], &mut sources);
    let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let (degrees, radians) = model.outputs.split_at(4);
    for (in_degrees, in_radians) in degrees.iter().zip(radians) {
        let half_turn = dag.int(180);
        assert_eq!(
            in_degrees.value * dag.pi(),
            half_turn * in_radians.value,
            "{}",
            in_degrees.name
        );
    }
}

#[test]
fn a_number_that_would_be_a_quantity_if_its_name_were_a_unit_is_refused() {
    let refused = |parts: &str| {
        errors(&format!(
            "machine Test in plane {{
                constants {{ N = 3, m = 2 }}
                parameters {{ k: N/m = 1 }}
                coordinates {{ x[1..N]: m }}
                bodies {{ cart[i in 1..N] {{ mass: m, at: (x[i], 0) }} }}
                springs {{ s {{ stiffness: k, stretch: x[1] }} }}
                gravity none;
                {parts}
            }}"
        ))
    };
    // 15 N and 5 N, 1 m and 0.5 m look alike.
    for parts in [
        "forces { f { on: x[1], value: 5*N } }",
        "forces { f { on: x[1], value: k*x[2] - 2*5*N } }",
        "forces { f { at: cart[1].at, force: (5*N, k*x[2]) } }",
        "parameters { push: N = 5*N } forces { f { on: x[1], value: push } }",
        "outputs { far: m = x[1] + 0.5*m }",
        "outputs { near: m = -(0.5*m) }",
    ] {
        let said = refused(parts);
        let unit = if parts.contains("outputs") { "m" } else { "N" };
        let message = format!("`{unit}` is a number declared here, and a unit that fits here too");
        assert!(
            said.contains(&message) && said.matches("error:").count() == 1,
            "{parts}: {said}"
        );
    }
    // Numbers of members, other orders of the factors, and numbers where the unit does not fit.
    for parts in [
        "forces { f { on: x[1], value: N*5 } }",
        // Both texts have the same meaning.
        "constants { kN = 1000 } forces { f { on: x[1], value: 5*kN } }",
        "outputs { last: m = x[2*N - 3], share: m = x[1]/N, count: 1 = 2*N, angle: rad = 2*pi/N }",
    ] {
        assert_eq!(refused(parts), "", "{parts}");
    }
}

#[test]
fn a_family_without_members_may_be_named() {
    let named = |parts: &str| {
        errors(&format!(
            "machine Test in plane {{
                constants {{ K = 0 }}
                coordinates {{ x: m, p[1..K]: m }}
                states {{ w[1..K]: 1, der(w) = 1 }}
                bodies {{ cart {{ mass: 1, at: (x, 0) }} }}
                gravity none;
                {parts}
            }}"
        ))
    };
    for parts in [
        "coordinates { der(p): m/s = 1 }",
        "approximations { p: small }",
        "keep { p, der(p) }",
    ] {
        assert_eq!(named(parts), "", "{parts}");
    }
    let said = named("coordinates { der(p[1]): m/s = 1 }");
    assert!(said.contains("there is no `p[1]`"), "{said}");
}
