//! Machines that have no equations are refused, with the error at the word that causes it.

use lagrangian_mechanics::Equations;
use lagrangian_spec::diagnostic::{Code, Report};

use crate::harness::resolved;

/// The codes and messages of a machine that cannot be derived.
fn refused(text: &str) -> Vec<(Code, String)> {
    resolved(text, |model| {
        let mut report = Report::new();
        assert!(Equations::derive(model, &mut report).is_none());
        report
            .diagnostics()
            .iter()
            .map(|d| (d.code, d.message.clone()))
            .collect()
    })
}

#[test]
fn sections_that_are_not_derived_yet_are_named() {
    let codes = refused(
        "machine Held in plane {
            parameters { m: kg = 1, r: m = 1 }
            coordinates { x: m, y: m }
            frames { table = ground.shift(x, y) }
            bodies { ball { mass: m, inertia: m*r^2, frame: table } }
            circles {
                rim { on: ball, center: (0, 0), radius: r },
                bowl { on: ground, center: (0, 0), radius: 2*r },
            }
            sliding { guide { body: ball, on: ground, direction: (1, 0), friction: 0.1 } }
            derivatives { coordinates }
            contacts { inside { circle: rim, inside: bowl, restitution: 0.5, friction: 0.1 } }
        }",
    );
    // Circles alone are only a drawing, beside contacts alone there may be derivatives, and in the plane contacts may stand beside guides.
    let [(Code::NotSupported, message)] = &codes[..] else {
        panic!("{codes:?}");
    };
    assert!(message.starts_with("`derivatives`"), "{message}");
}

#[test]
fn guides_beside_contacts_are_refused_in_space_and_with_impacts_without_collision() {
    let in_space = refused(
        "machine Bead in space {
            parameters { l: m = 1 }
            coordinates { x: m }
            bodies { bead { mass: 1, at: (x, 0*l, 0*l) } }
            sliding { wire { body: bead, on: ground, direction: (1, 0, 0), friction: 0.1 } }
            contacts { stop { gap: l - x, restitution: 0.5 } }
        }",
    );
    let [(Code::NotSupported, message)] = &in_space[..] else {
        panic!("{in_space:?}");
    };
    assert!(message.starts_with("in space `sliding`"), "{message}");
    for (law, named) in [
        ("friction: 0.1, painleve: impact", "`painleve: impact`"),
        ("law: stronge, painleve: impact", "`painleve: impact`"),
    ] {
        let refused = refused(&format!(
            "machine Block in plane {{
                parameters {{ l: m = 1 }}
                coordinates {{ x: m }}
                frames {{ seat = ground.shift(x, 0) }}
                bodies {{ block {{ mass: 1, frame: seat }} }}
                sliding {{ rail {{ body: block, on: ground, direction: (1, 0), friction: 0.1 }} }}
                contacts {{ stop {{ gap: l - x, slip: der(x), restitution: 0.5, {law} }} }}
            }}"
        ));
        let [(Code::NotSupported, message)] = &refused[..] else {
            panic!("{law}: {refused:?}");
        };
        assert_eq!(message, &format!("{named} does not support `sliding`"));
    }
}

#[test]
fn contacts_that_are_not_derived_yet_are_named() {
    let in_space = refused(
        "machine Bead in space {
            coordinates { x: m, y: m, z: m }
            bodies { bead { mass: 1, at: (x, y, z) } }
            contacts { stop { gap: z, slip: (der(x), der(y)), restitution: 0.5, friction: 0.1, law: stronge } }
        }",
    );
    assert_eq!(in_space.len(), 1);
    assert_eq!(in_space[0].0, Code::NotSupported);
    let of_two_laws = refused(
        "machine Bead in plane {
            coordinates { x: m, y: m }
            bodies { bead { mass: 1, at: (x, y) } }
            contacts {
                floor { gap: y, restitution: 0.5 },
                wall { gap: x, restitution: 0.5, law: stronge },
            }
        }",
    );
    assert_eq!(of_two_laws.len(), 1);
    assert_eq!(of_two_laws[0].0, Code::ConflictingFields);
    assert!(of_two_laws[0].1.contains("`wall`"), "{of_two_laws:?}");
}

#[test]
fn a_coordinate_that_moves_nothing_is_named() {
    let codes = refused(
        "machine Idle in plane {
            parameters { m: kg = 1, k: N*m = 1 }
            coordinates { x: m, psi: rad }
            bodies { ball { mass: m, at: (x, 0) } }
            torsion_springs { idle { stiffness: k, twist: psi } }
        }",
    );
    assert_eq!(codes.len(), 1);
    assert_eq!(codes[0].0, Code::NoInertia);
    assert!(codes[0].1.contains("`psi`"), "{codes:?}");
}

#[test]
fn turning_a_particle_moves_nothing() {
    let codes = refused(
        "machine Turned in plane {
            parameters { m: kg = 1 }
            coordinates { x: m, psi: rad }
            frames { here = ground.shift(x, 0).turn(psi) }
            bodies { ball { mass: m, frame: here } }
        }",
    );
    assert_eq!(codes[0].0, Code::NoInertia);
}

#[test]
fn a_kink_has_no_expansion() {
    let codes = refused(
        "machine Kink in plane {
            parameters { m: kg = 1, k: N/m = 1, l: m = 1 }
            coordinates { theta: rad }
            bodies { bob { mass: m, at: polar(l, theta) } }
            springs { rope { stiffness: k, from: (l, 0), to: bob.at, length: l/2 } }
            approximations { theta: small }
        }",
    );
    assert_eq!(codes[0].0, Code::NoExpansion);
    assert!(codes[0].1.contains("theta"), "{codes:?}");
}

#[test]
fn too_many_coordinates_are_counted() {
    let text = crate::harness::text_of("chain").replace("N = 8", "N = 300");
    let codes = refused(&text);
    assert_eq!(codes.len(), 1);
    assert_eq!(codes[0].0, Code::TooLarge);
    assert!(codes[0].1.contains("300"), "{codes:?}");
}

#[test]
fn too_many_contacts_are_counted() {
    let codes = refused(
        "machine Steps in plane {
            parameters { m: kg = 1, a: m = 1 }
            coordinates { x: m, y: m }
            bodies { ball { mass: m, at: (x, y) } }
            contacts { step[i in 1..4100] { gap: y + i*a - x, restitution: 0 } }
        }",
    );
    assert_eq!(codes.len(), 1, "{codes:?}");
    assert_eq!(codes[0].0, Code::TooLarge);
    assert!(codes[0].1.contains("4100"), "{codes:?}");
}

#[test]
fn equations_that_outgrow_every_computer_are_refused() {
    // Each of many bodies depends on each of many coordinates in its own way.
    let codes = refused(
        "machine Dense in plane {
            constants { N = 200, B = 2000 }
            parameters { m: kg = 1, l: m = 1 }
            coordinates { q[1..N]: rad }
            define { sum[0] = 0, sum[i in 1..N] = sum[i-1] + sin(q[i]) }
            bodies { body[i in 1..B] { mass: i*m, at: (l*sin(i*sum[N]), l*cos(sum[N]/i)) } }
        }",
    );
    assert_eq!(codes[0].0, Code::TooLarge, "{codes:?}");
}
