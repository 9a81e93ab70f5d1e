//! Printed formulas read like those of a textbook, and parse back to the same expressions.

use crate::support::markup;
use crate::support::parser::parse;
use crate::support::{SYMBOLS, SplitMix, Tree, all_functions, same, symbols};
use lagrangian_symbolic::{
    Dag, Expr, Rational, Stage, latex, math, math_as_built, math_name, mathml_name, text,
};

#[test]
fn text_reads_back_as_the_same_node() {
    let mut random = SplitMix(21);
    let functions = all_functions();
    for case in 0..4_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e = Tree::random(&mut random, 1 + case % 4, &functions).build(&dag, &symbols);
        let names: Vec<_> = SYMBOLS.iter().map(|(name, _)| *name).zip(symbols).collect();
        let printed = text(e, &dag);
        let read = parse(&dag, &names, &printed);
        assert_eq!(read, e, "case {case}: {printed}\nread as {read}");
    }
}

/// The coordinates of the crusher and some parameters.
struct Crusher<'d> {
    dag: &'d Dag,
    m1: Expr<'d>,
    m2: Expr<'d>,
    cx: Expr<'d>,
    yc: Expr<'d>,
    omega: Expr<'d>,
    t: Expr<'d>,
    x: Expr<'d>,
    theta: Expr<'d>,
    s1: Expr<'d>,
    phi1: Expr<'d>,
    phi2: Expr<'d>,
    der_x: Expr<'d>,
    der_phi1: Expr<'d>,
}

fn crusher(dag: &Dag) -> Crusher<'_> {
    let [m1, m2, cx, yc, omega] =
        ["m1", "m2", "cx", "yc", "omega"].map(|name| dag.symbol(name, Stage::PARAMETER));
    let t = dag.symbol("t", Stage(2));
    let [x, theta, s1, phi1, phi2] =
        ["x", "theta", "s1", "phi1", "phi2"].map(|name| dag.symbol(name, Stage(3)));
    let [der_x, der_phi1] = ["der(x)", "der(phi1)"].map(|name| dag.symbol(name, Stage(4)));
    Crusher {
        dag,
        m1,
        m2,
        cx,
        yc,
        omega,
        t,
        x,
        theta,
        s1,
        phi1,
        phi2,
        der_x,
        der_phi1,
    }
}

#[test]
fn text_is_written_as_by_hand() {
    let dag = Dag::new();
    let Crusher {
        m1,
        m2,
        cx,
        yc,
        omega,
        t,
        x,
        theta,
        s1,
        phi1,
        phi2,
        der_x,
        der_phi1,
        ..
    } = crusher(&dag);
    let expect = |e: Expr, expected: &str| assert_eq!(text(e, e.dag()), expected);
    expect(m1 * der_x.square() / 2, "1/2*m1*der(x)^2");
    expect(
        cx * (x - yc * theta).square() / 2,
        "1/2*cx*(x - yc*theta)^2",
    );
    expect(
        (m1 + m2) * s1 * phi1.sin() * der_phi1,
        "(m1 + m2)*s1*sin(phi1)*der(phi1)",
    );
    expect(-(m2 * (phi2 - phi1).cos()), "-m2*cos(phi2 - phi1)");
    expect(1 - phi1.cos(), "1 - cos(phi1)");
    expect((omega * t).cos() * omega.square(), "omega^2*cos(omega*t)");
    expect(x / (2 * m1 * m2), "1/2*x/(m1*m2)");
    expect(1 / (2 * m1), "1/(2*m1)");
    expect(
        x * dag.constant(Rational::parse_decimal("9.81").expect("a number")),
        "9.81*x",
    );
    expect(x.pow(yc + 1), "x^(yc + 1)");
    expect(x + (s1 + phi1), "x + (s1 + phi1)");
    expect(-2 * (x + s1), "-2*(x + s1)");
    expect(dag.zero(), "0");
    expect(dag.undefined(), "1/0");
    expect(-dag.pi() / 3, "-1/3*pi");
    expect(dag.sum([dag.one(), x, x.square()]), "x^2 + x + 1");
    expect(x.abs().min(s1.sqrt()), "min(abs(x), sqrt(s1))");
}

#[test]
fn latex_is_written_as_by_hand() {
    let dag = Dag::new();
    let Crusher {
        m1,
        m2,
        cx,
        yc,
        omega,
        t,
        x,
        theta,
        s1,
        phi1,
        phi2,
        der_x,
        der_phi1,
        dag,
    } = crusher(&dag);
    let expect = |e: Expr, expected: &str| assert_eq!(latex(e, e.dag()), expected);
    expect(m1 * der_x.square() / 2, r"\frac{1}{2} m_{1} \dot{x}^{2}");
    expect(
        cx * (x - yc * theta).square() / 2,
        r"\frac{1}{2} c_{x} \left(x - y_{c} \theta\right)^{2}",
    );
    expect(
        m1 * s1 * phi1.sin() * der_phi1 + m2 * s1 * phi1.sin() * der_phi1,
        r"\left(m_{1} + m_{2}\right) s_{1} \dot{\varphi}_{1} \sin \varphi_{1}",
    );
    expect(
        -(m2 * s1 * (phi1.cos() * phi2.cos() + phi1.sin() * phi2.sin())),
        r"-m_{2} s_{1} \cos\left(\varphi_{2} - \varphi_{1}\right)",
    );
    expect(phi1.sin().square() * m1, r"m_{1} \sin^{2} \varphi_{1}");
    expect(
        omega.square() * (omega * t).cos(),
        r"\omega^{2} \cos\left(\omega t\right)",
    );
    expect(x / (2 * m1), r"\frac{x}{2 m_{1}}");
    expect((x + (s1 - phi1)) + t, r"x + s_{1} - \varphi_{1} + t");
    expect(
        (x.square() + s1.square()).sqrt(),
        r"\sqrt{x^{2} + s_{1}^{2}}",
    );
    expect(x.abs() * x.exp(), r"\left\vert x\right\vert e^{x}");
    expect(dag.zero(), "0");
    expect(x / m1 - 1, r"\frac{x}{m_{1}} - 1");
    expect(
        dag.constant(Rational::parse_decimal("2.1e11").expect("a number")) * x,
        r"2.1 \cdot 10^{11} x",
    );
    expect(dag.pi() * x, r"\pi x");
    assert_eq!(
        math_as_built(phi1.cos() * (x + 1), dag).latex(),
        r"\left(x + 1\right) \cos \varphi_{1}"
    );
}

#[test]
fn a_deep_expression_prints_without_stack() {
    let dag = Dag::new();
    let x = dag.symbol("x", Stage(3));
    let e = (0..30_000).fold(x, |e, _| (e + 1).abs());
    assert_eq!(text(e, &dag).len(), 1 + 30_000 * "abs( + 1)".len());
    assert!(latex(e, &dag).len() > 300_000);
    assert_eq!(e.size(), 1 + 30_000 * 4);
}

#[test]
fn readable_forms_keep_their_value() {
    let mut random = SplitMix(22);
    let mut decided = 0;
    for case in 0..1_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e =
            Tree::random(&mut random, 1 + case % 4, &crate::support::SMOOTH).build(&dag, &symbols);
        let readable = lagrangian_symbolic::normal::readable(e, 200);
        assert!(readable.size() <= 2 * e.size(), "{e}\nbecame {readable}");
        if let Some(same) = same(&dag, readable, e) {
            decided += 1;
            assert!(same, "case {case}: {e}\nbecame {readable}");
        }
    }
    assert!(decided > 900, "{decided}");
}

#[test]
fn both_languages_of_a_page_say_the_same() {
    let mut random = SplitMix(23);
    let functions = all_functions();
    let mut seen = 0;
    for case in 0..2_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e = Tree::random(&mut random, 1 + case % 4, &functions).build(&dag, &symbols);
        let formula = math_as_built(e, &dag);
        let atoms = markup::atoms_of_latex(&formula.latex());
        seen += atoms.len();
        assert_eq!(
            atoms,
            markup::atoms_of_mathml(&formula.mathml()),
            "case {case}: {e}"
        );
    }
    assert!(seen > 10_000, "{seen}");
}

#[test]
fn lines_say_what_the_formula_says() {
    let mut random = SplitMix(24);
    let mut broken = 0;
    for case in 0..2_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e =
            Tree::random(&mut random, 2 + case % 4, &crate::support::SMOOTH).build(&dag, &symbols);
        let formula = math_as_built(e, &dag);
        let lines = formula.lines(12.0, 10.0);
        broken += usize::from(lines.len() > 1);
        // Each line is complete by itself, and a broken formula has the
        // same content on several lines.
        let atoms: Vec<String> = lines
            .iter()
            .flat_map(|line| markup::atoms_of_mathml(&line.mathml()))
            .collect();
        assert_eq!(
            atoms,
            markup::atoms_of_mathml(&formula.mathml()),
            "case {case}: {e}"
        );
        for line in &lines {
            assert_eq!(
                markup::atoms_of_latex(&line.latex()),
                markup::atoms_of_mathml(&line.mathml()),
                "case {case}: {e}"
            );
        }
    }
    assert!(broken > 500, "{broken}");
}

#[test]
fn a_line_ends_between_terms_and_within_its_width() {
    let dag = Dag::new();
    let symbol = |name: &str| dag.symbol(name, Stage(3));
    let sum = |names: [&str; 3]| dag.sum(names.map(symbol));
    let e = sum(["a", "b", "c"]) * sum(["u", "v", "w"]);
    let formula = math_as_built(e, &dag) + math(symbol("x"), &dag);
    let whole = formula.width();
    assert_eq!(formula.lines(whole + 0.1, 1.0).len(), 1);
    let lines: Vec<String> = formula
        .lines(whole - 0.1, whole)
        .iter()
        .map(lagrangian_symbolic::Math::latex)
        .collect();
    assert_eq!(
        lines,
        [r"\left(a + b + c\right) \left(u + v + w\right)", "+ x"]
    );
    // A sum in parentheses, with its power, is broken only if nothing else helps.
    let e = sum(["a", "b", "c"]).square();
    let lines: Vec<String> = math(e, &dag)
        .lines(4.5, 9.0)
        .iter()
        .map(lagrangian_symbolic::Math::latex)
        .collect();
    assert_eq!(lines, [r"\bigl(a + b", r"+ c\bigr)^{2}"]);
}

#[test]
fn names_of_any_kind_can_be_set() {
    for (name, mathml) in [
        (
            "q[-1]",
            "<msub><mi>q</mi><mrow><mo>\u{2212}</mo><mn>1</mn></mrow></msub>",
        ),
        ("_", "<mi>_</mi>"),
        ("θ", "<mi>θ</mi>"),
        ("Ä", "<mi>Ä</mi>"),
        (
            "der(x_left)",
            "<msub><mover><mi>x</mi><mo>˙</mo></mover><mi>left</mi></msub>",
        ),
    ] {
        assert_eq!(mathml_name(name), format!("<math>{mathml}</math>"));
    }
    assert_eq!(math_name("_").latex(), r"\_");
    assert_eq!(math_name("θ").latex(), r"\theta");
    assert_eq!(math_name("Ä").latex(), r"\text{Ä}");
    assert_eq!(math_name("der(q[2])").squared().latex(), r"\dot{q}_{2}^{2}");
    assert_eq!(
        math_name("lambda(ball.x)").latex(),
        r"\lambda_{\mathrm{ball}, x}"
    );
}
