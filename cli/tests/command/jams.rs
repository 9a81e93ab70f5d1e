//! Contacts that meet, stop and jam together: many feet, a disc in a groove, a body in a guide.

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::Scratch;

/// A body that slides on many feet at one height stops after v²/(2 μ g), as one on two feet does, whatever the law of its impacts is.
#[test]
fn many_feet_come_to_rest_together() {
    for (feet, law) in [
        (2, "newton"),
        (7, "newton"),
        (9, "poisson_glocker"),
        (12, "newton"),
    ] {
        let corners: Vec<String> = (0..feet)
            .map(|i| {
                format!(
                    "({}*m, -0.2*m)",
                    -0.15 + 0.3 * f64::from(i) / f64::from(feet - 1)
                )
            })
            .collect();
        let spec = Scratch::new(
            "feet.machine",
            &format!(
                "machine Feet in plane {{
                    parameters {{ mu: 1 = 0.3, v: m/s = 1.1, g: m/s^2 = 9.81 }}
                    coordinates {{ x: m, y: m = 0.2, p: rad, der(x): m/s = v }}
                    frames {{ held = ground.shift(x, y).turn(p) }}
                    bodies {{ table {{ mass: 1.3, inertia: 0.02, frame: held }} }}
                    gravity (0, -g);
                    contacts {{ foot {{ corners: ({}), on: held, along: ground, law: {law}, restitution: 0.4, friction: mu }} }}
                }}",
                corners.join(", ")
            ),
        );
        let run = simulate(spec.path(), 0.6, &[]);
        is_good(&run);
        close(
            number(&run["q"]["x"]),
            1.1 * 1.1 / (2.0 * 0.3 * 9.81),
            1e-12,
        );
        close(number(&run["v"]["x"]), 0.0, 1e-14);
        assert_eq!(
            events(&run, "sticks").len(),
            feet as usize,
            "{law}: {run:#}"
        );
    }
}

fn says_jammed(run: &Value) -> bool {
    let warnings = run["warnings"].as_array().expect("warnings");
    let mut texts = warnings.iter().filter_map(Value::as_str);
    texts.any(|text| text.starts_with("the friction of") && text.contains("admitted no motion"))
}

/// A disc falls into a groove whose sides have the angle α to the vertical and hits both at once. Where friction is less than tan α, it opens on both sides with
/// e times its speed: the rates are those of a frictionless impact, since it can only rise. Where it is more, no impulses lift the disc, for friction along the
/// sides holds what presses it out: it is wedged in, and stays.
#[test]
fn a_disc_is_wedged_into_a_narrow_groove() {
    let spec = Scratch::new(
        "groove.machine",
        "machine Groove in plane {
            parameters { m: kg = 0.4, r: m = 0.05, fall: m = 0.1, alpha: rad = 0.35, e: 1 = 0.6, mu: 1 = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = r/sin(alpha) + fall, p: rad }
            frames { right = ground.turn(pi/2*rad - alpha), left = ground.turn(alpha - pi/2*rad) }
            bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: p } }
            circles { rim { on: disc, center: (0, 0), radius: r } }
            gravity (0, -g);
            contacts {
                right { circle: rim, along: right, restitution: e, friction: mu },
                left { circle: rim, along: left, restitution: e, friction: mu },
            }
        }",
    );
    let (g, fall, e) = (9.81_f64, 0.1, 0.6);
    let speed = (2.0 * g * fall).sqrt();
    let deepest = 0.05 / 0.35_f64.sin();
    // Until the middle of the flight after the impact.
    let (until, rises) = (speed / g * (1.0 + e), e * e * fall);
    let run = simulate(spec.path(), until, &["mu=0.3"]);
    is_good(&run);
    close(number(&run["q"]["y"]), deepest + rises, 1e-12);
    let run = simulate(spec.path(), until, &["mu=0.5"]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    assert!(says_jammed(&run), "{run:#}");
    close(number(&run["q"]["y"]), deepest, 1e-14);
    close(number(&run["v"]["y"]), 0.0, 1e-14);
    close(number(&run["impact_loss"]), 0.4 * g * fall, 1e-13);
}

/// A body slides in a guide, with one point below a ceiling, 0.05 m below its centre of mass, and another one on a floor, 0.55 m below it, 0.3 m before that. The
/// moment of the friction presses both: with `N − m g` at the ceiling for N on the floor, N − m g = m g (0.1 + 0.55 μ)/(0.3 − 0.6 μ). From μ = 1/2 on
/// no forces keep it in the guide while it slides, and it stops at once.
#[test]
fn a_body_jams_in_a_guide() {
    let spec = Scratch::new(
        "guide.machine",
        "machine Guide in plane {
            parameters { M: kg = 2, mu: 1 = 0.3, v: m/s = 0.8, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m, p: rad, der(x): m/s = v }
            frames {
                held = ground.shift(x, y).turn(p),
                floor = ground.shift(0, -0.55*m), ceiling = ground.shift(0, -0.05*m).turn(pi*rad),
            }
            bodies { body { mass: M, inertia: 0.05, frame: held } }
            gravity (0, -g);
            contacts {
                below { point: (-0.1*m, -0.55*m), on: held, along: floor, restitution: 0, friction: mu },
                above { point: (-0.4*m, -0.05*m), on: held, along: ceiling, restitution: 0, friction: mu },
            }
        }",
    );
    let (g, mu) = (9.81_f64, 0.3);
    let above = (0.1 + 0.55 * mu) / (0.3 - 0.6 * mu);
    let braked = mu * g * (1.0 + 2.0 * above);
    let run = simulate(spec.path(), 0.2, &[]);
    is_good(&run);
    close(number(&run["q"]["x"]), 0.8 * 0.8 / (2.0 * braked), 1e-12);
    close(number(&run["v"]["x"]), 0.0, 1e-14);
    let run = simulate(spec.path(), 0.2, &["mu=0.7"]);
    assert_eq!(run["error"], Value::Null, "{run:#}");
    assert!(says_jammed(&run), "{run:#}");
    for coordinate in ["x", "y", "p"] {
        close(number(&run["q"][coordinate]), 0.0, 1e-14);
        close(number(&run["v"][coordinate]), 0.0, 1e-14);
    }
    close(number(&run["impact_loss"]), 0.5 * 2.0 * 0.8 * 0.8, 1e-14);
    close(number(&run["energy_residual"]), 0.0, 1e-13);
}
