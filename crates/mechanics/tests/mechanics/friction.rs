//! Guided contacts: their normal reactions compared with formulas typed in by hand, and guides that are
//! refused because they guide nothing.

use lagrangian_mechanics::{Carrying, Equations};
use lagrangian_print::compare::compare;
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Dag, Expr};

use crate::harness::{derived, residues, resolved, text_of};

/// Asserts that pairs of expressions are equal at points of the prime field.
fn assert_equal<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    pairs: &[(&str, Expr<'d>, Expr<'d>)],
) {
    let differences: Vec<Expr<'d>> = pairs.iter().map(|(_, a, b)| *a - *b).collect();
    for values in residues(model, equations, &differences, false) {
        for ((name, ..), value) in pairs.iter().zip(values) {
            assert!(value == Residue::ZERO, "{name}");
        }
    }
}

fn symbol<'d>(model: &Model<'d>, name: &str) -> Expr<'d> {
    let parameters = model.parameters.iter();
    let mut found = parameters.filter(|p| p.name.to_string() == name);
    found.next().expect("a parameter").symbol
}

#[test]
fn the_prisms_have_the_coefficients_of_the_paper() {
    derived(&text_of("prisms"), |model, equations| {
        let dag: &Dag = model.dag;
        let of = |name| symbol(model, name);
        let (m, big, g) = (of("m"), of("M"), of("g"));
        let (mu1, mu2, tan) = (of("mu1"), of("mu2"), of("alpha").tan());
        let contacts = &equations.sliding;
        // P = −b q̇ − d q̇ q̈: b_i = Σ μ ν τ_i, d_ij = Σ μ τ_i ρ_j.
        let b = |i: usize| {
            dag.sum(
                contacts
                    .iter()
                    .map(|c| c.friction * c.reactions[0].load * c.row[i]),
            )
        };
        let d = |i: usize, j: usize| {
            dag.sum(
                contacts
                    .iter()
                    .map(|c| c.friction * c.row[i] * c.reactions[0].by_accelerations[j]),
            )
        };
        let zero = dag.zero();
        assert_equal(
            model,
            equations,
            &[
                ("b1", b(0), mu2 * (m + big) * g),
                ("b2", b(1), mu1 * m * g),
                ("d11", d(0, 0), zero),
                ("d12", d(0, 1), -(m * mu2 * tan)),
                ("d21", d(1, 0), -(m * mu1 * tan)),
                ("d22", d(1, 1), zero),
            ],
        );
    });
}

#[test]
fn the_bracket_that_the_paper_drops_is_found() {
    derived(&text_of("prisms"), |model, equations| {
        let found = compare(model, equations);
        let verdicts: Vec<(&str, bool)> =
            found.iter().map(|c| (c.item.as_str(), c.agrees)).collect();
        assert_eq!(
            verdicts,
            [
                ("potential_energy", true),
                ("friction q1", false),
                ("friction q2", true)
            ]
        );
        // −μ₂ [(m + M) g − m q̈₂ tan α], printed without the bracket: the term that remains is positive and has the factor μ₂.
        let m = |name| symbol(model, name);
        let right = m("mu2") * m("m") * model.coordinates[1].a * m("alpha").tan();
        let printed = -(m("m") * model.coordinates[1].a * m("alpha").tan());
        let sum = |terms: &[Expr<'_>]| terms.len();
        let mend = &found[1].corrections[0];
        assert_eq!((sum(&mend.add), sum(&mend.drop)), (1, 1));
        assert_equal(
            model,
            equations,
            &[("add", mend.add[0], right), ("drop", mend.drop[0], printed)],
        );
    });
}

/// A piston that a moving wedge lifts. It slides between walls that are not perpendicular to the face of
/// the wedge, so both press on it.
const LIFTED: &str = "machine Lifted in plane {
    parameters { m: kg = 1, M: kg = 2, alpha: rad = 0.4, mu: 1 = 0.2, nu: 1 = 0.1, g: m/s^2 = 9.81 }
    coordinates { x: m }
    frames { wedge = ground.shift(x, 0), piston = ground.shift(0, x*tan(alpha)) }
    bodies { wedge { mass: M, frame: wedge }, piston { mass: m, frame: piston } }
    gravity (0, -g);
    sliding {
        face { body: piston, on: wedge, direction: (-cos(alpha), sin(alpha)), friction: mu },
        slot { body: piston, on: ground, direction: (0, 1), friction: nu },
    }
}";

#[test]
fn two_guides_of_one_body_share_what_it_takes_to_hold_it() {
    let text = LIFTED.replace("(-cos(alpha), sin(alpha))", "(-cos(alpha), -sin(alpha))");
    // The wedge that lifts it slopes up to the left: relative to the wedge, the piston moves to the left and up.
    for (text, fits) in [(LIFTED, true), (text.as_str(), false)] {
        let refused = codes(text);
        assert_eq!(refused.is_empty(), fits, "{refused:?}");
    }
    derived(LIFTED, |model, equations| {
        let of = |name| symbol(model, name);
        let (m, g, alpha) = (of("m"), of("g"), of("alpha"));
        let (sin, cos, a) = (alpha.sin(), alpha.cos(), model.coordinates[0].a);
        let [face, slot] = &equations.sliding[..] else {
            panic!("two contacts");
        };
        // The normals are the directions turned left: n_face = (−sin α, −cos α), n_slot = (−1, 0). Newton's law for the piston:
        // N_face n_face + N_slot n_slot + (0, −m g) = (0, m ẍ tan α).
        let normal = -(m * (g + a * alpha.tan()) / cos);
        assert_equal(
            model,
            equations,
            &[
                ("face", face.pressing(model), normal),
                ("slot", slot.pressing(model), -(normal * sin)),
                // Friction on the face, along (−cos α, sin α), lifts too: N_face cos α = … + F sin α.
                (
                    "face by face",
                    face.reactions[0].by_friction_forces[0],
                    sin / cos,
                ),
                (
                    "face by slot",
                    face.reactions[0].by_friction_forces[1],
                    model.dag.one() / cos,
                ),
            ],
        );
    });
}

fn codes(text: &str) -> Vec<(Code, String)> {
    resolved(text, |model| {
        let mut report = Report::new();
        let _ = Equations::derive(model, &mut report);
        let diagnostics = report.diagnostics();
        diagnostics
            .iter()
            .map(|d| (d.code, d.message.clone()))
            .collect()
    })
}

#[test]
fn guides_that_are_none_are_refused() {
    let cart = |sliding: &str| {
        format!(
            "machine Cart in plane {{
                parameters {{ m: kg = 1, M: kg = 2, alpha: rad = 0.4, w: rad/s = 2 }}
                coordinates {{ x: m, y: m }}
                frames {{
                    cart = ground.shift(x, 0),
                    box = cart.shift(y, 0),
                    piston = ground.shift(0, x*tan(alpha)),
                }}
                bodies {{
                    cart {{ mass: M, frame: cart }}, box {{ mass: m, frame: box }},
                    piston {{ mass: m, frame: piston }}, still {{ mass: m, at: (0, 1) }},
                }}
                sliding {{ {sliding} }}
            }}"
        )
    };
    let of = |fields: &str| format!("a {{ {fields}, friction: 0.1 }}");
    for (sliding, said) in [
        (
            of("body: cart, on: ground, direction: (0, 1)"),
            "let the body of `a` leave",
        ),
        (
            of("body: cart, on: ground, direction: direction(w*t)"),
            "let the body of `a` leave",
        ),
        (
            of("body: still, on: ground, direction: (1, 0)"),
            "`a` does not slide",
        ),
        (
            of("body: cart, on: ground, direction: (0, 0)"),
            "has no length",
        ),
        (
            of("body: cart, on: ground, direction: (1, 0), normal: (1, 1)"),
            "not at a right angle",
        ),
        (
            of("body: piston, on: cart, direction: (-cos(alpha), sin(alpha))"),
            "held by more than this guide",
        ),
        (
            of("body: box, on: cart, direction: (1, 0)")
                + ","
                + &of("body: box, on: ground, direction: (1, 0)").replacen('a', "b", 1),
            "is not determined",
        ),
    ] {
        let refused = codes(&cart(&sliding));
        let [(code, message)] = &refused[..] else {
            panic!("{sliding}: {refused:?}");
        };
        assert_eq!(*code, Code::NoGuide);
        assert!(message.contains(said), "{sliding}: {message}");
    }
    assert!(codes(&cart(&of("body: box, on: cart, direction: (2, 0)"))).is_empty());
}

/// A bead on the parabola y = k z²/2: N = m (g + k ż²)/√(1 + k² z²) upwards, whatever the lengths of the
/// vectors that describe the guide.
#[test]
fn the_side_of_a_normal_does_not_depend_on_lengths() {
    let guides = [
        ("(1, k*z)", "(-k*z, 1)"),
        ("(0.5, 0.5*k*z)", "(-k*z, 1)"),
        ("(1.5, 1.5*k*z)", "(-k*z, 1)"),
        ("(2, 2*k*z)", "(-3*k*z, 3)"),
        ("(3, 3*k*z)", "(-k*z, 1)"),
        ("(-3, -3*k*z)", "(-k*z, 1)"),
        ("(5/7, 5/7*k*z)", "(-11*k*z, 11)"),
        ("(sqrt(3), sqrt(3)*k*z)", "(-k*z, 1)"),
        ("(-pi, -pi*k*z)", "(-2*k*z, 2)"),
        ("(1 + z^2*k^2, (1 + z^2*k^2)*k*z)", "(-k*z, 1)"),
        ("(s*(1, k*z))", "(-k*z, 1)"),
        ("(-s*(1, k*z))", "(-k*z, 1)"),
        ("(1, k*z)", "(s^2*(-k*z, 1))"),
        ("(cos(k*z)*(1, k*z))", "(-k*z, 1)"),
    ];
    for (direction, normal) in guides {
        let text = format!(
            "machine Bead in plane {{
                parameters {{ m: kg = 2, k: 1/m = 0.7, g: m/s^2 = 9.81, mu: 1 = 0.2, s: 1 = 3 }}
                coordinates {{ z: m }}
                frames {{ bead = ground.shift(z, k*z^2/2) }}
                bodies {{ bead {{ mass: m, frame: bead }} }}
                gravity (0, -g);
                sliding {{ wire {{ body: bead, on: ground, direction: {direction}, normal: {normal}, friction: mu }} }}
            }}"
        );
        derived(&text, |model, equations| {
            let (z, v) = (model.coordinates[0].q, model.coordinates[0].v);
            let [normal_of_bead] = &equations.sliding[..] else {
                panic!("one guide");
            };
            let normal_of_bead = normal_of_bead.pressing(model);
            for (z_at, v_at, s_at) in [
                (0.3, 1.2, 3.0),
                (-1.4, 0.5, 3.0),
                (-0.2, -2.0, 0.4),
                (1.1, 0.1, -1.7),
            ] {
                let (m, k, g) = (2.0, 0.7, 9.81);
                let value = |symbol| match Some(symbol) {
                    of if of == z.as_symbol() => z_at,
                    of if of == v.as_symbol() => v_at,
                    of if of == model.coordinates[0].a.as_symbol() => 0.8,
                    of => {
                        let known = [("m", m), ("k", k), ("g", g), ("s", s_at), ("mu", 0.2)];
                        let is_it =
                            |(name, _): &&(&str, f64)| self::symbol(model, name).as_symbol() == of;
                        known.iter().find(is_it).expect("a parameter").1
                    }
                };
                let found = lagrangian_symbolic::evaluate(model.dag, &[normal_of_bead], value)[0];
                let expected = m * (g + k * v_at * v_at) / (1.0 + k * k * z_at * z_at).sqrt();
                assert!(
                    (found - expected).abs() < 1e-12 * expected,
                    "{direction} {normal}: {found} {expected}"
                );
            }
        });
    }
}

/// A machine with a cart on a rail and further bodies.
fn on_a_cart(coordinates: &str, rest: &str) -> String {
    format!(
        "machine Cart in plane {{
            parameters {{ m: kg = 1, M: kg = 2, l: m = 1, k: N/m = 9, P: N = 2, mu: 1 = 0.2, g: m/s^2 = 9.81 }}
            coordinates {{ x: m, {coordinates} }}
            frames {{ cart = ground.shift(x, 0) }}
            gravity (0, -g);
            {rest}
        }}"
    )
}

const RAIL: &str = "rail { body: cart, on: ground, direction: (1, 0), friction: mu }";

#[test]
fn what_moves_with_a_guided_body_and_is_tied_to_it_by_nothing_is_refused() {
    let hung = |bob: &str| {
        let bodies =
            format!("bodies {{ cart {{ mass: M, frame: cart }}, bob {{ mass: m, {bob} }} }}");
        on_a_cart("phi: rad", &format!("{bodies} sliding {{ {RAIL} }}"))
    };
    for (bob, is_right) in [
        ("at: cart.at + l*(sin(phi), -cos(phi))", true),
        ("at: cart.point(l*sin(phi), -l*cos(phi))", true),
        ("frame: cart.turn(phi).shift(0, -l)", true),
        ("at: (x + l*sin(phi), -l*cos(phi))", false),
        ("frame: ground.shift(x, -l).turn(phi)", false),
        // The frame of the cart, written out again.
        ("frame: ground.shift(x, 0).turn(phi).shift(0, -l)", true),
        // It moves freely relative to the rail, but its position contains the coordinate of the rail.
        ("at: (x + l*phi, l)", false),
        ("at: (l*phi, l)", true),
        ("at: cart.at + (l*phi, l)", true),
        // A rope over a pulley, which may pull in any direction.
        ("at: (l*phi, -x)", false),
        // Built on the cart, with a displacement that depends on the cart's coordinate.
        ("at: cart.at + l*(phi, x/l)", false),
    ] {
        let found = codes(&hung(bob));
        match (&found[..], is_right) {
            ([], true) => {}
            ([(Code::Untied, message)], false) => {
                assert!(
                    message.contains("`bob`") || message.contains("`cart`"),
                    "{message}"
                );
            }
            _ => panic!("{bob}: {found:?}"),
        }
    }
}

#[test]
fn guides_that_share_a_coordinate_are_refused_and_a_rod_between_them_is_not() {
    let guides = format!(
        "sliding {{ {RAIL}, wall {{ body: b, on: ground, direction: (0, 1), friction: mu }} }}"
    );
    let bodies = |b: &str| {
        format!(
            "bodies {{ cart {{ mass: M, frame: cart }}, b {{ mass: m, frame: ground.shift(0, {b}) }} }}"
        )
    };
    let shared = on_a_cart("", &format!("{} {guides}", bodies("sqrt(l^2 - x^2)")));
    let found = codes(&shared);
    assert!(
        !found.is_empty() && found.iter().all(|(code, _)| *code == Code::Untied),
        "{found:?}"
    );
    for (rod, is_right) in [
        ("norm(cart.at - b.at) = l", true),
        ("x^2 + y^2 = l^2", false),
        // A rope along both guides.
        ("x + y = l", true),
    ] {
        let rest = format!("{} {guides} constraints {{ rod: {rod} }}", bodies("y"));
        let found = codes(&on_a_cart("y: m", &rest));
        match (&found[..], is_right) {
            ([], true) => {}
            ([(Code::Untied, message)], false) => assert!(message.contains("`rod`"), "{message}"),
            _ => panic!("{rod}: {found:?}"),
        }
    }
}

#[test]
fn what_is_written_in_coordinates_must_act_along_the_guide() {
    let with = |section: &str| {
        on_a_cart(
            "",
            &format!("bodies {{ cart {{ mass: M, frame: cart }} }} sliding {{ {RAIL} }} {section}"),
        )
    };
    for (section, is_right) in [
        ("springs { s { stiffness: k, stretch: x } }", true),
        ("springs { s { stiffness: k, stretch: 2*l - x } }", true),
        (
            "springs { s { stiffness: k, stretch: sqrt(x^2 + l^2) - l } }",
            false,
        ),
        (
            "springs { s { stiffness: k, from: cart.at, to: (0, l), length: l } }",
            true,
        ),
        (
            "springs { s { stiffness: k, from: (x, 0), to: (0, l), length: l } }",
            false,
        ),
        (
            "springs { s { stiffness: k, from: (x, 0), to: (3*l, 0), length: l } }",
            true,
        ),
        ("forces { f { at: cart.at, force: (P, P) } }", true),
        ("forces { f { at: (x, 0), force: (P, P) } }", false),
        ("forces { f { at: (x, 0), force: (P, 0) } }", true),
        ("forces { f { on: x, value: P } }", true),
        ("potentials { v: k*x^4/l^2 }", true),
    ] {
        let found = codes(&with(section));
        match (&found[..], is_right) {
            ([], true) => {}
            ([(Code::Untied, _)], false) => {}
            _ => panic!("{section}: {found:?}"),
        }
    }
}

#[test]
fn what_guides_carry_and_coordinates_move_is_known() {
    let carrying = |text: &str| resolved(text, |model| Carrying::of(model).expect("it has guides"));
    // The wedge is body 0, the slider body 1; the floor is guide 0.
    let built = carrying(&text_of("prisms"));
    assert_eq!(built.carried, [vec![0, 1], vec![1]]);
    assert_eq!(built.moved, [vec![0, 1], vec![1]]);
    assert_eq!(built.coordinates_along, [Some(vec![0]), Some(vec![1])]);
    assert!((0..2).all(|guide| built.undetermined(guide).is_empty()));
    let absolute = text_of("prisms").replace("wedge.shift(-q2", "ground.shift(q1 - q2");
    assert!(codes(&absolute).is_empty());
    let absolute = carrying(&absolute);
    assert_eq!(absolute.carried, [vec![0], vec![1]]);
    assert_eq!(absolute.moved, built.moved);
    // The force on the slider also acts on the wedge, and the spec does not determine its component across the floor.
    assert_eq!(absolute.undetermined(0), [1]);
    assert!(absolute.undetermined(1).is_empty());
    let forced = text_of("prisms")
        .replace("wedge.shift(-q2", "ground.shift(q1 - q2")
        .replace(
            "gravity (0, -g);",
            "gravity (0, -g); forces { f { on: q2, value: m*g } }",
        );
    assert!(matches!(&codes(&forced)[..], [(Code::Untied, _)]));
}

#[test]
fn what_acts_from_a_place_that_moves_with_the_body_and_is_none_of_it_is_refused_straight_across_too()
 {
    // Places above the cart, beside it at its height, and in between: described by its frame they belong to the cart; described
    // by formulas they belong to no body.
    let with = |place: &str, section: &str| {
        let text = format!(
            "machine Above in plane {{
                parameters {{ m: kg = 1, mu: 1 = 0.1, l: m = 1, k: N/m = 30 }}
                coordinates {{ x: m = 0.2 }}
                frames {{ floor = ground.shift(x, 0) }}
                bodies {{ cart {{ mass: m, frame: floor }} }}
                gravity (0, -k*l/m);
                sliding {{ rail {{ body: cart, on: ground, direction: (1, 0), friction: mu }} }}
                {section}
            }}"
        );
        text.replace("PLACE", place)
    };
    let spring = "springs { s { stiffness: k, from: PLACE, to: cart.at, length: l/2 } }";
    let potential = "potentials { v: k/2*(norm(PLACE - cart.at) - l/2)^2 }";
    for section in [spring, potential] {
        for (place, is_right) in [
            ("floor.point(0, l)", true),
            ("floor.point(l, 2*l)", true),
            ("(2*l, l)", true),
            ("(x, l)", false),
            ("(x + l, 2*l)", false),
            ("(x + l, 0)", true),
        ] {
            match (&codes(&with(place, section))[..], is_right) {
                ([], true) | ([(Code::Untied, _)], false) => {}
                (found, _) => panic!("{place}, {section}: {found:?}"),
            }
        }
    }
}

#[test]
fn a_force_on_a_coordinate_that_moves_more_than_a_guide_carries_is_refused_in_any_coordinates() {
    // A block on the slope of a cart on which it is not built, in any two coordinates. A force on a coordinate that pushes the
    // block along the slope may or may not react on the cart, so it is refused; a force on the cart alone is accepted.
    let written = |x: &str, s: &str, section: &str| {
        format!(
            "machine Block in plane {{
                parameters {{ m: kg = 1, mu: 1 = 0.1, l: m = 1, P: N = 3, w: s = 1 }}
                coordinates {{ a: 1 = 1.3, b: 1 = 0.7 }}
                frames {{
                    floor = ground.shift(l*({x}), 0),
                    slope = floor.turn(0.4),
                    top = ground.shift(l*({x}) + l*({s})*cos(0.4), l*({s})*sin(0.4)),
                }}
                bodies {{ cart {{ mass: m, frame: floor }}, block {{ mass: m, frame: top }} }}
                gravity (0, -P/m);
                sliding {{
                    rail {{ body: cart, on: ground, direction: (1, 0), friction: mu }},
                    ramp {{ body: block, on: slope, direction: slope.vector(1, 0), friction: mu }},
                }}
                {section}
            }}"
        )
    };
    let on = |coordinate: &str| format!("forces {{ f {{ on: {coordinate}, value: P*l }} }}");
    let (x, s) = ("a*cos(b)", "a*sin(b)");
    for (text, is_right) in [
        (written("a", "b", ""), true),
        (written("a", "b", &on("a")), true),
        (written("a", "b", &on("b")), false),
        (written(x, s, ""), true),
        (written(x, s, &on("a")), false),
        (written(x, s, &on("b")), false),
        (written(x, s, "potentials { v: P*l*a*cos(b) }"), true),
        (written(x, s, "potentials { v: P*l*a*sin(b) }"), false),
        (
            written(x, s, "dissipations { d: P*l*der(a*cos(b))^2*w }"),
            true,
        ),
        (
            written(x, s, "dissipations { d: P*l*der(a*sin(b))^2*w }"),
            false,
        ),
    ] {
        match (&codes(&text)[..], is_right) {
            ([], true) | ([(Code::Untied, _)], false) => {}
            (found, _) => panic!("{found:?}, {text}"),
        }
    }
}

/// A cart at `a + b` along the floor, and other bodies, in coordinates none of which belongs to the cart or to the bob alone.
fn mixed(bodies: &str, guides: &str) -> String {
    format!(
        "machine Mixed in plane {{
            parameters {{ m: kg = 1, M: kg = 2, l: m = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }}
            coordinates {{ a: m, b: m, c: m = 0.3, phi: rad = 0.2 }}
            frames {{ cart = ground.shift(a + b, 0) }}
            bodies {{ cart {{ mass: M, frame: cart }}, pin {{ mass: m, at: (0, c) }}, {bodies} }}
            gravity (0, -g);
            sliding {{ {RAIL} {guides} }}
        }}"
    )
}

#[test]
fn bodies_that_nothing_holds_across_a_guide_may_share_its_coordinates() {
    let away = "arm { mass: m, at: (0, l*phi) }";
    for (bodies, is_right) in [
        // A free particle, and one that is held at a height without a body or guide that holds it.
        ("bob { mass: m, at: (a - b, l*phi) }".to_owned(), true),
        (format!("bob {{ mass: m, at: (a - b, l) }}, {away}"), false),
        // Vertical motion is across the guide, horizontal motion is not.
        (format!("bob {{ mass: m, at: (l, a - b) }}, {away}"), true),
        // Two bodies on a rod: neither can move alone.
        (
            "bob { mass: m, at: (a - b, 2*c) }, hand { mass: m, at: (a - b + l*sin(phi), 2*c - l*cos(phi)) }"
                .to_owned(),
            false,
        ),
    ] {
        let found = codes(&mixed(&bodies, ""));
        let are_untied = found.iter().all(|(code, _)| *code == Code::Untied);
        assert!(are_untied && found.is_empty() == is_right, "{bodies}: {found:?}");
    }
    // The same two bodies, with nothing else that moves with c.
    let rod = mixed(
        "bob { mass: m, at: (a - b, c) }, hand { mass: m, at: (a - b + l*sin(phi), c - l*cos(phi)) }",
        "",
    );
    let rod = rod.replace("pin { mass: m, at: (0, c) }, ", "");
    assert!(codes(&rod).is_empty(), "{:?}", codes(&rod));
    // The guide carries only the cart.
    for text in [rod, mixed("bob { mass: m, at: (a - b, l*phi) }", "")] {
        derived(&text, |model, equations| {
            let [big, g] = ["M", "g"].map(|name| symbol(model, name));
            let contact = &equations.sliding[0];
            let zero = model.dag.zero();
            let mut pairs = vec![("load", contact.reactions[0].load, big * g)];
            let by = contact.reactions[0].by_accelerations.iter();
            pairs.extend(by.map(|by| ("acceleration", *by, zero)));
            assert_equal(model, equations, &pairs);
        });
    }
}

#[test]
fn one_motion_has_several_reactions_where_nobody_says_what_holds_a_body() {
    // A block that has the same positions when it is on the cart and when it has a rail of its own; written by
    // formulas alone it is refused.
    let on_cart = "block { mass: m, at: cart.point(-2*b, l) }, arm { mass: m, at: (0, l*phi) }";
    let on_rail = "block { mass: m, at: (a - b, l) }, arm { mass: m, at: (0, l*phi) }";
    let rail = ", upper { body: block, on: ground, direction: (1, 0), friction: mu }";
    assert!(!codes(&mixed(on_rail, "")).is_empty());
    for (text, carries_both) in [(mixed(on_cart, ""), true), (mixed(on_rail, rail), false)] {
        derived(&text, |model, equations| {
            let [m, big, g] = ["m", "M", "g"].map(|name| symbol(model, name));
            let carried = if carries_both { m + big } else { big };
            let pairs = [("load", equations.sliding[0].reactions[0].load, carried * g)];
            assert_equal(model, equations, &pairs);
        });
    }
}

/// A bead at `c(u)` with a load on it.
fn in_space(more: &str) -> String {
    format!(
        "machine Bead in space {{
            parameters {{ m: kg, M: kg, r: m, h: m, l: m, mu: 1, g: m/s^2, k: N/m }}
            coordinates {{ u: rad, w: rad }}
            bodies {{
                bead {{ mass: m, at: (r*cos(u), r*sin(u), -h*u) }},
                {more}
            }}
            gravity (0, 0, -g);
            sliding {{ wire {{ body: bead, on: ground, direction: (-r*sin(u), r*cos(u), -h), friction: mu }} }}
        }}"
    )
}

#[test]
fn in_space_a_guide_carries_the_weight_and_the_inertia_across_it() {
    // A load on a rod of length l below the bead, turned by w about x.
    let hung = in_space("load { mass: M, at: bead.at + l*(0, sin(w), -cos(w)) }");
    derived(&hung, |model, equations| {
        let of = |name| symbol(model, name);
        let (m, big, r, h, l, g) = (of("m"), of("M"), of("r"), of("h"), of("l"), of("g"));
        let ([u, w], dag) = ([0, 1].map(|i| &model.coordinates[i]), model.dag);
        let (sin, cos) = (u.q.sin(), u.q.cos());
        let total = m + big;
        // N = (m + M) c̈ + M ρ̈ + (m + M) g e_z, without its component along the wire.
        let curve = [
            -(r * (cos * u.v.square() + sin * u.a)),
            r * (cos * u.a - sin * u.v.square()),
            -(h * u.a),
        ];
        let rod = [
            dag.zero(),
            l * (w.q.cos() * w.a - w.q.sin() * w.v.square()),
            l * (w.q.sin() * w.a + w.q.cos() * w.v.square()),
        ];
        let mut force: Vec<Expr<'_>> = (0..3).map(|i| total * curve[i] + big * rod[i]).collect();
        force[2] = force[2] + total * g;
        let tangent = [-(r * sin), r * cos, -h];
        let square = r.square() + h.square();
        let part = dag.sum(tangent.iter().zip(&force).map(|(&e, &f)| e * f)) / square;
        let wire = &equations.sliding[0];
        let found = wire.normal(model, &[]);
        let names = ["along x", "along y", "along z"];
        let pairs: Vec<_> = (0..3)
            .map(|i| (names[i], found[i], force[i] - part * tangent[i]))
            .collect();
        assert_equal(model, equations, &pairs);
        // The guide's own friction acts along it.
        let own: Vec<_> = (0..3)
            .map(|i| {
                let by = wire.reactions[i].by_friction_forces[0] * square.sqrt();
                (names[i], by, -tangent[i])
            })
            .collect();
        assert_equal(model, equations, &own);
    });
}

/// A disk that always touches the ground on which it rolls: its weight is the sum of what the ground and the guide of its centre
/// carry, and nothing else says how much of it is whose.
#[test]
fn a_wheel_on_the_ground_whose_centre_is_guided_is_refused() {
    let machine = |coordinates: &str, disk: &str, guided: &str| {
        format!(
            "machine Disk in space {{
                parameters {{ m: kg = 2, R: m = 0.3, J: kg*m^2 = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81 }}
                coordinates {{ {coordinates} }}
                frames {{ disk = {disk}.turn(y, phi), cart = ground.shift(s, 0, 0) }}
                bodies {{ disk {{ mass: m, inertia: (J, J, J), frame: disk }}, cart {{ mass: m, frame: cart }} }}
                gravity (0, 0, -g);
                wheels {{ roll {{ wheel: disk, on: ground, radius: R, axis: y }} }}
                sliding {{ rail {{ body: {guided}, on: ground, direction: (1, 0, 0), friction: mu }} }}
            }}"
        )
    };
    // The disk rolls by a constraint, and by its coordinates.
    let constrained = ("x: m, phi: rad, s: m", "ground.shift(x, 1, R)");
    let embedded = ("phi: rad, s: m", "ground.shift(R*phi, 1, R)");
    for (coordinates, disk) in [constrained, embedded] {
        let found = codes(&machine(coordinates, disk, "disk"));
        match &found[..] {
            [(Code::Untied, message)] => assert!(message.contains("`roll.gap`"), "{message}"),
            _ => panic!("{disk}: {found:?}"),
        }
        // What does not touch the ground may be guided.
        let found = codes(&machine(coordinates, disk, "cart"));
        assert!(found.is_empty(), "{disk}: {found:?}");
    }
}

#[test]
fn in_space_too_what_a_guide_carries_is_said_or_asked_for() {
    // Loads that are built on the bead; that contain its coordinate, without a description of what holds
    // them; and that are free of it.
    let built = in_space("load { mass: M, at: bead.at + l*(0, sin(w), -cos(w)) }");
    let written =
        in_space("load { mass: M, at: (r*cos(u), r*sin(u) + l*sin(w), -h*u - l*cos(w)) }");
    let apart = in_space("load { mass: M, at: (0, 0, l*w) }");
    assert!(codes(&built).is_empty(), "{:?}", codes(&built));
    assert!(codes(&apart).is_empty(), "{:?}", codes(&apart));
    assert!(
        matches!(&codes(&written)[..], [(Code::Untied, _)]),
        "{:?}",
        codes(&written)
    );
    // A direction that is not tangent to the wire.
    let off = apart.replace("-h), friction", "h), friction");
    assert!(
        matches!(&codes(&off)[..], [(Code::NoGuide, _)]),
        "{:?}",
        codes(&off)
    );
    // A second guide of the same body, and a guide with a side.
    let guide = "friction: mu }";
    let twice = apart.replace(
        guide,
        "friction: mu }, same { body: bead, on: ground, direction: (-r*sin(u), r*cos(u), -h), friction: mu }",
    );
    assert!(
        matches!(&codes(&twice)[..], [(Code::NoGuide, _)]),
        "{:?}",
        codes(&twice)
    );
    let sided = apart.replace(guide, "friction: mu, normal: (0, 0, 1) }");
    let found = codes(&sided);
    assert!(matches!(&found[..], [(Code::NotSupported, _)]), "{found:?}");
}

/// A puck at a place, guided on a surface with this normal.
fn on_surface(place: &str, normal: &str, more: &str) -> String {
    format!(
        "machine Puck in space {{
            parameters {{ m: kg, r: m, mu: 1, g: m/s^2 }}
            coordinates {{ x: m, y: m, z: m }}
            bodies {{ puck {{ mass: m, at: {place} }}, other {{ mass: m, at: (0, 0, z) }} {more} }}
            gravity (0, 0, -g);
            sliding {{ slot {{ body: puck, on: ground, normal: {normal}, friction: mu }} }}
        }}"
    )
}

#[test]
fn a_surface_that_is_none_is_refused_once_and_by_its_name() {
    for (place, normal, code, words) in [
        ("(x, y, 0)", "(0, 0, 2)", None, ""),
        ("(x, y, (x^2 + y^2)/r)", "(-2*x/r, -2*y/r, 1)", None, ""),
        (
            "(x, y, x)",
            "(0, 0, 1)",
            Some(Code::NoGuide),
            "leave its surface",
        ),
        (
            "(x, y, 0)",
            "(x - x, 0, 0)",
            Some(Code::NoGuide),
            "has no length",
        ),
        (
            "(x, 0, 0)",
            "(0, 0, 1)",
            Some(Code::NoGuide),
            "along a line of its surface",
        ),
        (
            "(x, 2*x, 0)",
            "(0, 0, 1)",
            Some(Code::NoGuide),
            "along a line of its surface",
        ),
        // The other body moves with it, but the spec does not say what ties them.
        (
            "(x, z, 0)",
            "(0, 0, 1)",
            Some(Code::Untied),
            "the guide `slot`",
        ),
    ] {
        let found = codes(&on_surface(place, normal, ""));
        match code {
            None => assert!(found.is_empty(), "{place}: {found:?}"),
            Some(code) => {
                let [(known, message)] = &found[..] else {
                    panic!("{place}: {found:?}");
                };
                assert_eq!(*known, code, "{place}: {message}");
                assert!(message.contains(words), "{place}: {message}");
            }
        }
    }
}
