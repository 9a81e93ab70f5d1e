//! What the parser accepts, and its messages for what it does not.

use lagrangian_spec::diagnostic::Code::{self, *};
use lagrangian_spec::diagnostic::{REPORT_LIMIT, Report};
use lagrangian_spec::source::{SourceId, Sources, Span};
use lagrangian_spec::syntax::*;
use lagrangian_spec::token::{Token, TokenKind, lex};

/// The examples of the language's reference, as printed there.
const EXAMPLES: &[(&str, &str)] = &[
    ("crusher", include_str!("syntax/vibrating_crusher.machine")),
    ("chain", include_str!("syntax/chain.machine")),
    ("crushing", include_str!("syntax/crushing_crusher.machine")),
    ("prisms", include_str!("syntax/prisms.machine")),
    ("everything", include_str!("syntax/everything.machine")),
];

fn parse(text: &str) -> (Spec, Report) {
    let mut report = Report::new();
    let tokens = lex(SourceId(0), text, &mut report);
    let spec = Spec::parse(&tokens, SourceId(0), &mut report);
    (spec, report)
}

/// Parses a spec that must have no mistakes.
#[track_caller]
fn sound(text: &str) -> Spec {
    let (spec, report) = parse(text);
    let mut sources = Sources::new();
    sources.add("test", text);
    assert!(!report.has_errors(), "{}", report.render_short(&sources));
    assert!(!spec.incomplete);
    spec
}

/// Checks that exactly these mistakes are reported, each at exactly these words.
#[track_caller]
fn says(text: &str, expected: &[(Code, &str)]) -> (Spec, Report) {
    let (spec, report) = parse(text);
    let mut sources = Sources::new();
    sources.add("test", text);
    let found: Vec<(Code, &str)> = report
        .diagnostics()
        .iter()
        .map(|diagnostic| (diagnostic.code, sources.words(diagnostic.span)))
        .collect();
    assert_eq!(found, expected, "{}", report.render_short(&sources));
    (spec, report)
}

/// Checks that exactly these mistakes are reported inside a machine.
#[track_caller]
fn inside(text: &str, expected: &[(Code, &str)]) -> (Spec, Report) {
    says(&format!("machine Test in plane {{ {text} }}"), expected)
}

/// The help lines for the inside of a machine.
fn help(text: &str) -> Vec<String> {
    let (_, report) = parse(&format!("machine Test in plane {{ {text} }}"));
    let help = |found: &&lagrangian_spec::diagnostic::Diagnostic| found.help.clone();
    report.diagnostics().iter().filter_map(help).collect()
}

/// An expression with all brackets, which shows how it was parsed.
fn bracketed(expression: &Expression) -> String {
    let list = |list: &[Expression]| list.iter().map(bracketed).collect::<Vec<_>>().join(", ");
    match &expression.kind {
        ExpressionKind::Number(number) => number.clone(),
        ExpressionKind::Name(Reference { base, index }) => match index {
            Some(index) => format!("{}[{}]", base.text, bracketed(index)),
            None => base.text.clone(),
        },
        ExpressionKind::Sum(terms) => {
            let sign = |term: &Term| if term.negative { "-" } else { "+" };
            let term = |term: &Term| format!("{}{}", sign(term), bracketed(&term.value));
            format!("({})", terms.iter().map(term).collect::<String>())
        }
        ExpressionKind::Product(factors) => {
            let sign = |factor: &Factor| if factor.divides { "/" } else { "*" };
            let factor = |factor: &Factor| format!("{}{}", sign(factor), bracketed(&factor.value));
            format!("({})", factors.iter().map(factor).collect::<String>())
        }
        ExpressionKind::Negative(value) => format!("-{}", bracketed(value)),
        ExpressionKind::Power(base, exponent) => {
            format!("({}^{})", bracketed(base), bracketed(exponent))
        }
        ExpressionKind::Call(call) => format!("{}({})", call.function.text, list(&call.arguments)),
        ExpressionKind::Chain(chain) => {
            let link = |link: &Link| match &link.arguments {
                Some(arguments) => format!(".{}({})", link.name.text, list(arguments)),
                None => format!(".{}", link.name.text),
            };
            bracketed(&chain.root) + &chain.links.iter().map(link).collect::<String>()
        }
        ExpressionKind::Tuple(values) => format!("<{}>", list(values)),
        ExpressionKind::Text(text) => format!("{text:?}"),
        ExpressionKind::Error => "error".to_owned(),
    }
}

/// One expression as it was parsed, with all brackets.
fn understood(text: &str) -> String {
    let spec = sound(&format!(
        "machine Test in plane {{ define {{ x = {text} }} }}"
    ));
    bracketed(&spec.define[0].content)
}

#[test]
fn every_example_of_the_reference_is_read_as_printed() {
    for (_, text) in EXAMPLES {
        sound(text);
    }
}

#[test]
fn a_machine_is_what_its_text_says() {
    let spec = sound(EXAMPLES[0].1);
    assert_eq!(spec.name.text, "VibratingCrusher");
    assert_eq!(spec.space.map(|space| space.value), Some(Space::Plane));
    assert_eq!(
        spec.docs,
        "A vibrating crusher in a horizontal plane: a platform on springs and dampers, shaken by a\n\
         rotating debalance; a mortar inside the platform's cylinder, and a pestle inside the mortar."
    );
    let names = |items: &[Item<Quantity>]| -> Vec<String> {
        items
            .iter()
            .map(|item| item.name.base.text.clone())
            .collect()
    };
    assert_eq!(
        names(&spec.coordinates),
        [
            "x", "y", "theta", "s1", "phi1", "theta1", "s2", "phi2", "theta2"
        ]
    );
    assert_eq!(spec.parameters.len(), 18);
    assert_eq!(spec.parameters[1].docs, "Mass of the debalance.");
    assert_eq!(spec.bodies.len(), 4);
    let at = spec.bodies[1].content.get("at").map(bracketed);
    assert_eq!(
        at.as_deref(),
        Some("(+platform.point(x0, y0)+polar(e, (*omega*t)))")
    );
    assert_eq!(
        (
            count(&spec, "springs"),
            count(&spec, "dampers"),
            spec.assume.len()
        ),
        (4, 4, 2)
    );
    let headings: Vec<&str> = spec
        .sections
        .iter()
        .map(|heading| heading.value.as_str())
        .collect();
    assert_eq!(
        headings,
        [
            "parameters",
            "coordinates",
            "assume",
            "frames",
            "bodies",
            "springs",
            "dampers"
        ]
    );
}

/// The number of elements of a section.
fn count(spec: &Spec, word: &str) -> usize {
    spec.elements_of(word).count()
}

#[test]
fn families_keep_their_ranges() {
    let spec = sound(EXAMPLES[1].1);
    let Index::Range(range) = &spec.coordinates[0].name.index else {
        panic!("{:?}", spec.coordinates[0]);
    };
    assert!(range.variable.is_none());
    assert_eq!(
        (bracketed(&range.low), bracketed(&range.high)),
        ("1".into(), "N".into())
    );
    assert!(matches!(spec.frames[0].name.index, Index::One(_)));
    assert_eq!(
        bracketed(&spec.frames[1].content),
        "link[(+i-1)].turn(q[i]).shift(l, 0)"
    );
    let Index::Range(range) = &spec.bodies[0].name.index else {
        panic!("{:?}", spec.bodies[0]);
    };
    assert_eq!(
        range
            .variable
            .as_ref()
            .map(|variable| variable.text.as_str()),
        Some("i")
    );
    assert_eq!(
        spec.statement("gravity")
            .and_then(|gravity| gravity.value.as_ref().map(bracketed)),
        Some("<0, -g>".into())
    );
}

#[test]
fn every_section_of_the_language_reaches_the_tree() {
    let spec = sound(EXAMPLES[4].1);
    let mut headings: Vec<SectionKind> =
        spec.sections.iter().map(|heading| heading.value).collect();
    headings.sort();
    headings.dedup();
    let mut all = SectionKind::ALL.to_vec();
    all.sort();
    assert_eq!(headings, all);
    let extends = spec.extends.as_ref().map(|file| file.value.as_str());
    assert_eq!(extends, Some("base.machine"));
    let sizes = [
        spec.inputs.len(),
        spec.outputs.len(),
        count(&spec, "torsion_springs"),
        count(&spec, "potentials"),
        count(&spec, "dissipations"),
        count(&spec, "forces"),
        count(&spec, "torques"),
        count(&spec, "constraints"),
        count(&spec, "sliding"),
        spec.circles.len(),
        count(&spec, "rolling"),
        spec.contacts.len(),
        spec.approximations.len(),
        spec.derivatives.len(),
        spec.stages.len(),
        spec.methods.len(),
        spec.charts.len(),
        spec.keep.len(),
        spec.brachistochrone.len(),
        spec.remove.len(),
    ];
    assert_eq!(
        sizes,
        [1, 1, 1, 1, 1, 2, 1, 2, 1, 2, 1, 3, 2, 3, 2, 1, 1, 4, 1, 4]
    );
    assert!(spec.remove[2].name.is_none() && spec.remove[3].name.is_none());
    let printed = &spec.published[0];
    assert_eq!(printed.title.value, "Part I");
    let kinds: Vec<PublishedKind> = printed.items.iter().map(|item| item.kind.value).collect();
    assert_eq!(kinds.len(), 7);
    assert_eq!(kinds[0], PublishedKind::KineticEnergy);
    assert!(printed.items[0].of.is_some() && printed.items[1].of.is_none());
    assert!(matches!(printed.items[6].statement, Statement::Equation(_)));
    assert!(spec.assume[1].range.is_some());
}

#[test]
fn operators_bind_as_in_a_book() {
    assert_eq!(understood("-x^2"), "-(x^2)");
    assert_eq!(understood("2^-1"), "(2^-1)");
    assert_eq!(understood("a^b^c"), "(a^(b^c))");
    assert_eq!(understood("a - b + c"), "(+a-b+c)");
    assert_eq!(understood("a/b*c"), "(*a/b*c)");
    assert_eq!(understood("-a*b - -c"), "(+(*-a*b)--c)");
    assert_eq!(understood("a*-b^2"), "(*a*-(b^2))");
    assert_eq!(understood("(a + b)*c"), "(*(+a+b)*c)");
    assert_eq!(understood("der(der(x))^2/2"), "(*(der(der(x))^2)/2)");
    assert_eq!(understood("q[i-1].at.x(1)"), "q[(+i-1)].at.x(1)");
    assert_eq!(understood("(a, b, c,)"), "<a, b, c>");
    assert_eq!(understood("1_000.5e-3"), "1000.5e-3");
}

#[test]
fn every_expression_knows_its_place() {
    let text = "machine T in plane { define { x = a*(b + c[1]) - f.turn(d).at^2 } }";
    let spec = sound(text);
    let words = |span: Span| &text[span.start as usize..span.end as usize];
    let value = &spec.define[0].content;
    assert_eq!(words(spec.span), text);
    assert_eq!(
        words(spec.define[0].span),
        "x = a*(b + c[1]) - f.turn(d).at^2"
    );
    assert_eq!(words(value.span), "a*(b + c[1]) - f.turn(d).at^2");
    let ExpressionKind::Sum(terms) = &value.kind else {
        panic!("{value:?}");
    };
    assert_eq!(words(terms[0].value.span), "a*(b + c[1])");
    let ExpressionKind::Product(factors) = &terms[0].value.kind else {
        panic!("{value:?}");
    };
    assert_eq!(words(factors[1].value.span), "(b + c[1])");
    let ExpressionKind::Power(base, _) = &terms[1].value.kind else {
        panic!("{value:?}");
    };
    assert_eq!(words(base.span), "f.turn(d).at");
    let ExpressionKind::Chain(chain) = &base.kind else {
        panic!("{value:?}");
    };
    let links: Vec<&str> = chain.links.iter().map(|link| words(link.span)).collect();
    assert_eq!(
        (words(chain.root.span), links),
        ("f", vec!["turn(d)", "at"])
    );
}

#[test]
fn units_are_products_of_powers() {
    let unit = |text: &str| -> Vec<(String, i32)> {
        let spec = sound(&format!(
            "machine T in plane {{ parameters {{ x: {text} }} }}"
        ));
        let unit = spec.parameters[0].content.unit.clone().unwrap_or_default();
        let factors = unit.factors.into_iter();
        factors
            .map(|factor| (factor.name.text, factor.power))
            .collect()
    };
    let powers = |list: &[(&str, i32)]| -> Vec<(String, i32)> {
        list.iter()
            .map(|&(name, power)| (name.to_owned(), power))
            .collect()
    };
    assert_eq!(unit("1"), []);
    assert_eq!(unit("kg*m^2/s"), powers(&[("kg", 1), ("m", 2), ("s", -1)]));
    assert_eq!(unit("1/s^2"), powers(&[("s", -2)]));
    assert_eq!(
        unit("N/(m*rad^2)^2"),
        powers(&[("N", 1), ("m", -2), ("rad", -4)])
    );
    assert_eq!(unit("m^-1*s^(-2)"), powers(&[("m", -1), ("s", -2)]));
}

#[test]
fn documentation_of_a_macro_is_that_of_a_file() {
    // In the form in which the compiler hands `///` and `/** … */` to a macro.
    let spec = sound(
        "#[doc = r\" First.\"] #[doc = \"\"] #[doc = \" Second.\"] #![doc = \"no\"] machine T in plane { parameters { \
         #[doc = \"\\n * Mass.\\n *  - of it\\n \"] m: kg, /// Length.\n///\n/// Of it.\n l: m } }",
    );
    assert_eq!(spec.docs, "First.\n\nSecond.");
    let docs: Vec<&str> = spec
        .parameters
        .iter()
        .map(|item| item.docs.as_str())
        .collect();
    assert_eq!(docs, ["Mass.\n - of it", "Length.\n\nOf it."]);
}

#[test]
fn no_machine() {
    says("", &[(NoMachine, "")]);
    says("// nothing\n", &[(NoMachine, "")]);
    says("bodies { }", &[(NoMachine, "bodies")]);
    says(
        "/// docs\nmachne A in plane { bodies {} }",
        &[(NoMachine, "machne")],
    );
}

#[test]
fn empty_machine() {
    says("machine A in plane { }", &[(EmptyMachine, "{ }")]);
}

#[test]
fn second_machine() {
    says(
        "machine A in plane { bodies {} } /// docs\nmachine B in plane { x }",
        &[(SecondMachine, "machine")],
    );
    inside(
        "machine B in plane { bodies {} } bodies { 1 }",
        &[(SecondMachine, "machine"), (UnexpectedToken, "1")],
    );
}

#[test]
fn missing_space() {
    says("machine A { bodies {} }", &[(MissingSpace, "A")]);
    says(
        "machine A in plan { bodies {} }",
        &[(UnexpectedToken, "plan")],
    );
    says(
        "machine in plane { bodies {} x }",
        &[(UnexpectedToken, "in"), (UnknownSection, "x")],
    );
}

#[test]
fn said_twice() {
    says(
        "machine A in plane in space { bodies {} }",
        &[(SaidTwice, "in space")],
    );
    says(
        "machine A extends \"a\" extends \"b\" { bodies {} }",
        &[(SaidTwice, "\"b\"")],
    );
    inside("gravity (0, 1); gravity (1, 0);", &[(SaidTwice, "gravity")]);
    inside(
        "bodies { a { mass: 1, at: (0, 0), mass: 2 } }",
        &[(SaidTwice, "mass")],
    );
}

#[test]
fn unknown_section() {
    // The misspelled section is still read, so that its names are declared.
    let (spec, _) = inside("paramters { m: kg }", &[(UnknownSection, "paramters")]);
    assert_eq!(spec.parameters.len(), 1);
    let (spec, _) = inside(
        "frobnicate { m: kg } bodies { 1 }",
        &[(UnknownSection, "frobnicate"), (UnexpectedToken, "1")],
    );
    assert!(spec.incomplete);
}

#[test]
fn unknown_field() {
    inside(
        "springs { a { stifness: k, mass: 1 } }",
        &[(UnknownField, "stifness"), (UnknownField, "mass")],
    );
    assert_eq!(
        help("springs { a { stifness: k } }"),
        ["did you mean `stiffness`?"]
    );
    assert_eq!(
        help("torques { a { x: k } }"),
        ["its fields are `on` or `torque`"]
    );
}

#[test]
fn unknown_unit() {
    let (spec, _) = inside(
        "parameters { a: kgg*Nm = 2, b: tonne }",
        &[
            (UnknownUnit, "kgg"),
            (UnknownUnit, "Nm"),
            (UnknownUnit, "tonne"),
        ],
    );
    assert!(spec.parameters[0].content.unit.is_none());
    assert!(spec.parameters[0].content.value.is_some());
}

#[test]
fn missing_unit_and_missing_value() {
    inside(
        "parameters { a = 2, b } coordinates { q }",
        &[(MissingUnit, "a"), (MissingUnit, "b"), (MissingUnit, "q")],
    );
    inside(
        "constants { N = 2, a: m } outputs { x: m }",
        &[(MissingValue, "a"), (MissingValue, "x")],
    );
}

#[test]
fn unknown_approximation() {
    inside(
        "approximations { a: frozn, b: tiny, c: small }",
        &[
            (UnknownApproximation, "frozn"),
            (UnknownApproximation, "tiny"),
        ],
    );
}

#[test]
fn unknown_quantity() {
    inside(
        "published \"x\" { kinetik_energy a = 1, power = 2, force q = 3 }",
        &[
            (UnknownQuantity, "kinetik_energy"),
            (UnknownQuantity, "power"),
        ],
    );
}

#[test]
fn nothing_to_remove() {
    inside("remove springs.x;", &[(NothingToRemove, "remove")]);
    says(
        "machine A extends \"a\" { remove assume.x; bodies { 1 } }",
        &[(NothingToRemove, "assume"), (UnexpectedToken, "1")],
    );
}

#[test]
fn misplaced_index() {
    inside(
        "define { a = q[1..2], b = q[1][2], c[1][2] = 3 }",
        &[
            (MisplacedIndex, ".."),
            (MisplacedIndex, "["),
            (MisplacedIndex, "["),
        ],
    );
}

#[test]
fn nested_too_deeply() {
    let deep = |open: &str, close: &str| {
        let (open, close) = (open.repeat(100_000), close.repeat(100_000));
        format!("machine T in plane {{ define {{ x = {open}1{close}, y = 2 }} }}")
    };
    for (open, close, place) in [
        ("(", ")", "("),
        ("-", "", "-"),
        ("sin(", ")", "("),
        ("a[", "]", "["),
    ] {
        let (spec, _) = says(&deep(open, close), &[(NestedTooDeeply, place)]);
        assert_eq!(spec.define.len(), 2, "{open}");
    }
    says(&deep("2^", ""), &[(NestedTooDeeply, "^")]);
    let units = format!(
        "machine T in plane {{ parameters {{ x: {}m }} }}",
        "(".repeat(1000)
    );
    assert!(parse(&units).1.has_errors());
    // Wide expressions, unlike deep ones, are accepted.
    for part in ["+a", "*a", ".turn(a)", "-a*b"] {
        sound(&format!(
            "machine T in plane {{ define {{ x = a{} }} }}",
            part.repeat(100_000)
        ));
    }
}

#[test]
fn the_deepest_expression_fits_into_a_small_stack() {
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(|| {
        for (open, close) in [
            ("(", ")"),
            ("-", ""),
            ("f(", ")"),
            ("a[", "]"),
            ("a.f(", ")"),
            ("2^", ""),
        ] {
            let (open, close) = (open.repeat(NESTING_LIMIT), close.repeat(NESTING_LIMIT));
            let text = format!("machine T in plane {{ define {{ x = {open}1{close} }} }}");
            assert_eq!(sound(&text), sound(&text).clone());
        }
    });
    thread.expect("a thread").join().expect("no overflow");
}

#[test]
fn an_unclosed_bracket_is_reported_once_where_it_opens() {
    inside(
        "bodies { a { at: polar(s, phi, angle: theta }, b { mass: } }",
        &[(UnbalancedBracket, "("), (UnexpectedToken, "}")],
    );
    inside(
        "bodies { a { mass: 1 } springs { b { stifness: 1 } }",
        &[(UnbalancedBracket, "{"), (UnknownField, "stifness")],
    );
    inside("bodies { a { at: (1, 2] } }", &[(UnbalancedBracket, "]")]);
    inside("bodies { a { at: (1, 2)) } }", &[(UnbalancedBracket, ")")]);
    inside(
        "bodies { a { mass: 1 } } } springs { b { stifness: 1 } }",
        &[(UnbalancedBracket, "}"), (UnknownField, "stifness")],
    );
    says(
        "machine A in plane { bodies { a { at: (1, 2",
        &[(UnbalancedBracket, "(")],
    );
    says(
        "machine A in plane { bodies { a { mass: 1 } }",
        &[(UnbalancedBracket, "{")],
    );
}

#[test]
fn a_missing_or_wrong_separator_costs_nothing_else() {
    let (spec, _) = inside(
        "parameters { a: m = 1 b: m, /// docs\n c: m /// docs\n d: m; e: m }",
        &[
            (UnexpectedToken, "b"),
            (UnexpectedToken, "/// docs"),
            (UnexpectedToken, ";"),
        ],
    );
    assert_eq!(spec.parameters.len(), 5);
    let (spec, _) = inside(
        "bodies { a { mass: 1 at: (0, 0) } b { mass: 1 } }; gravity (0, 1) springs {}",
        &[
            (UnexpectedToken, "at"),
            (UnexpectedToken, "b"),
            (UnexpectedToken, ";"),
            (UnexpectedToken, "springs"),
        ],
    );
    assert_eq!(spec.bodies.len(), 2);
    assert_eq!(spec.bodies[0].content.fields.len(), 2);
}

#[test]
fn a_slip_in_one_item_hides_none_in_another() {
    let (spec, _) = inside(
        "define { a = 2 x, b = +1, c = , d = (1, , 2), e = f(1 2, ), f: 1, g = 3 } \
         assume { 0 < a < 1, b = 2, c > 0 } constraints { x: a == b, y: a }",
        &[
            (UnexpectedToken, "x"),
            (UnexpectedToken, "+"),
            (UnexpectedToken, ","),
            (UnexpectedToken, ","),
            (UnexpectedToken, "2"),
            (UnexpectedToken, ":"),
            (UnexpectedToken, "<"),
            (UnexpectedToken, "="),
            (UnexpectedToken, "=="),
            (UnexpectedToken, "}"),
        ],
    );
    assert_eq!(spec.define.len(), 7);
    assert!(!spec.incomplete);
}

#[test]
fn help_says_what_to_write() {
    assert_eq!(
        help("define { a = 2(x + 1) }"),
        ["a product needs its `*`: `2*(…)`"]
    );
    assert_eq!(
        help("define { a = 2x }"),
        ["a product needs its `*`: `2*x`"]
    );
    assert_eq!(help("define { a = x**2 }"), ["a power is written `x^2`"]);
    assert_eq!(
        help("define { a = |x| }"),
        ["the absolute value is `abs(x)`"]
    );
    assert_eq!(help("parameters { J kg = 1 }"), ["write `J: kg`"]);
    assert_eq!(
        help("assume { 0 < a < 1 }"),
        ["write two facts: `0 < s, s < l`"]
    );
    assert_eq!(help("gravity { x: 1 }"), ["write `gravity (0, -g);`"]);
    assert_eq!(help("coordinates { q[1..=N]: m }"), ["write `1..N`"]);
}

#[test]
fn a_broken_character_is_reported_once() {
    inside(
        "define { a = 2 § 3, b = x² + 1, c = 0x1F, d = 'a' }",
        &[
            (UnknownCharacter, "§"),
            (UnknownCharacter, "²"),
            (MalformedNumber, "0x1F"),
            (UnexpectedToken, "'a'"),
        ],
    );
    inside("define { a = \"x\n }", &[(Unterminated, "\"")]);
    says(
        "machine A in plane { bodies { /* }",
        &[(Unterminated, "/*")],
    );
    inside("define { a = 1e999 }", &[(NumberOutOfRange, "1e999")]);
    inside(
        "published \"\\q\" { force x = 1 }",
        &[(MalformedText, "\"\\q\"")],
    );
}

/// A generator of random numbers that is the same on every platform: G. Marsaglia, *Xorshift RNGs*,
/// J. Stat. Softw. 8 (2003) 14.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

/// Checks that nothing panics, and that every message has a position in the text.
fn survives(text: &str) {
    let (_, report) = parse(text);
    let mut sources = Sources::new();
    sources.add("test", text);
    assert!(report.diagnostics().len() <= REPORT_LIMIT);
    for diagnostic in report.diagnostics() {
        let Span { start, end, .. } = diagnostic.span;
        assert!(
            text.get(start as usize..end as usize).is_some(),
            "{diagnostic:?}\n{text}"
        );
    }
    report.render_short(&sources);
}

#[test]
fn spoiled_characters_are_survived() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for round in 0..2000 {
        let mut letters: Vec<char> = EXAMPLES[round % EXAMPLES.len()].1.chars().collect();
        for _ in 0..1 + random.below(6) {
            let at = random.below(letters.len());
            let other = random.below(letters.len());
            if letters.len() < 2 {
                break;
            }
            match random.below(5) {
                0 => drop(letters.remove(at)),
                1 => letters.insert(at, letters[other]),
                2 => letters.swap(at, other),
                3 => letters.truncate(at.max(1)),
                _ => {
                    letters[at] =
                        ['{', ')', '"', '\'', '/', '*', '#', 'θ', '\\', '0'][random.below(10)]
                }
            }
        }
        survives(&letters.into_iter().collect::<String>());
    }
}

#[test]
fn spoiled_tokens_are_survived() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let words = |text: &str| -> Vec<String> {
        let mut report = Report::new();
        let tokens = lex(SourceId(0), text, &mut report);
        let word =
            |token: &Token| text[token.span.start as usize..token.span.end as usize].to_owned();
        let end = |token: &Token| {
            if token.kind == TokenKind::Doc {
                "\n"
            } else {
                " "
            }
        };
        tokens
            .iter()
            .map(|token| word(token) + end(token))
            .collect()
    };
    let examples: Vec<Vec<String>> = EXAMPLES.iter().map(|(_, text)| words(text)).collect();
    for round in 0..3000 {
        let mut words = examples[round % examples.len()].clone();
        for _ in 0..1 + random.below(8) {
            let at = random.below(words.len());
            let other = random.below(words.len());
            if words.len() < 2 {
                break;
            }
            match random.below(4) {
                0 => drop(words.remove(at)),
                1 => words.insert(at, words[other].clone()),
                2 => words.swap(at, other),
                _ => drop(words.drain(at..(at + random.below(9)).min(words.len()))),
            }
        }
        survives(&words.concat());
    }
}

#[test]
fn long_nonsense_takes_linear_time() {
    // Each of these would take a careless lexer or parser quadratic time, and then minutes.
    let head = "machine A in plane { define { x = ";
    for piece in [
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        "([",
        "(]",
        "\"",
        "\\\"\n",
        "/*",
        "/*\n",
        "r#\"",
        "'",
        "§",
        ";",
        ",",
        ", ,",
        "x y ",
        "x: ",
        "x = ",
        "///\n",
        "} ///\n",
        "1..",
        ">",
        "a[",
        "springs {",
        "} springs {",
        "-",
        "a.",
        "a^",
    ] {
        let count = (1 << 16) / piece.len();
        survives(&(head.to_owned() + &piece.repeat(count)));
        survives(&piece.repeat(count));
    }
}

#[test]
fn the_reference_prints_what_the_parser_reads() {
    let page = include_str!("../../../docs/spec-language.md");
    let mut machines = 0;
    for block in page.split("```machine\n").skip(1) {
        let text = block.split("```").next().unwrap_or("");
        // The page shows published equations without their content.
        if !text.contains('…') {
            sound(text);
            machines += 1;
        }
    }
    assert_eq!(machines, 4);
}

#[test]
fn habits_of_other_languages_are_answered() {
    let branch = "expressions have no branches: write them with `max`, `min`, `abs` or `sign`";
    for (text, expected) in [
        (
            "body { a { mass: 1, at: (x, 0) } }",
            "did you mean `bodies`?",
        ),
        ("define { a = x\' + 1 }", "the time derivative is `der(x)`"),
        ("define { a = if x > 0 { 1 } else { 2 } }", branch),
        ("define { a = if(x > 0, 1, 2) }", branch),
        ("define { a = x > 0 ? 1 : 2 }", branch),
        ("define { a = 30 deg }", "a product needs its `*`: `30*deg`"),
        ("define { a = 30deg }", "a product needs its `*`: `30*deg`"),
    ] {
        let said = help(text);
        assert!(said.iter().any(|help| help == expected), "{text}: {said:?}");
    }
    let nameless = "give it a name: `machine Name extends \"base.machine\" { … }`";
    for text in [
        "extends \"b\" { }",
        "machine extends \"b\" { gravity none; }",
    ] {
        let (mut sources, mut report) = (Sources::new(), Report::new());
        lagrangian_spec::parse(&mut sources, "test", text, &mut report);
        let shown = report.render_short(&sources);
        assert!(shown.contains(nameless), "{text}: {shown}");
    }
}

#[test]
fn two_spellings_of_a_letter_are_one_name() {
    let mut report = Report::new();
    let text = "m\u{e9} me\u{301} q\u{307} \u{2126}";
    let tokens = lagrangian_spec::token::lex(Default::default(), text, &mut report);
    let texts: Vec<&str> = tokens.iter().map(|token| &*token.text).collect();
    assert_eq!(texts, ["m\u{e9}", "m\u{e9}", "q\u{307}", "\u{3a9}"]);
    assert!(!report.has_errors());
}
