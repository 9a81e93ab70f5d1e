//! Frozen and small coordinates, compared with the formulas of textbooks and papers.

use lagrangian_mechanics::Route;
use lagrangian_print::compare::compare;
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::evaluate;

use crate::harness::{derived, text_of};

/// Everything that the machine publishes agrees.
fn assert_agreement(text: &str) {
    derived(text, |model, equations| {
        assert_eq!(equations.route, Route::Lagrange);
        for item in compare(model, equations) {
            assert!(item.agrees, "{}", item.item);
        }
    });
}

#[test]
fn a_small_pendulum_is_an_oscillator() {
    assert_agreement(
        "machine Pendulum in plane {
            parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81, b: N*m*s = 0.1 }
            coordinates { theta: rad }
            bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
            gravity (0, -g);
            dissipations { hinge: b/2*der(theta)^2*cos(theta) }
            approximations { theta: small }
            published \"linear\" {
                kinetic_energy = m*l^2*der(theta)^2/2,
                potential_energy = m*g*l*theta^2/2,
                dissipation = b*der(theta)^2/2,
                equation theta: der(der(theta)) + b/(m*l^2)*der(theta) + g/l*theta = 0,
            }
        }",
    );
}

#[test]
fn small_keeps_products_of_small_and_large() {
    // The product of the small angle's rate and the large motion stays, that with the
    // small angle's square does not: x′ θ′ is of first order in the small quantities, θ θ′
    // x′ of second, θ² θ′ x′ of third.
    assert_agreement(
        "machine Crane in plane {
            parameters { M: kg = 5, m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
            coordinates { x: m, theta: rad }
            bodies {
                cart { mass: M, at: (x, 0) },
                load { mass: m, at: (x, 0) + l*(sin(theta), -cos(theta)) },
            }
            gravity (0, -g);
            approximations { theta: small }
            published \"linear\" {
                kinetic_energy = (M + m)*der(x)^2/2 + m*l*der(x)*der(theta) + m*l^2*der(theta)^2/2,
                equation x: (M + m)*der(der(x)) + m*l*der(der(theta)) = 0,
                equation theta: der(der(x)) + l*der(der(theta)) + g*theta = 0,
            }
        }",
    );
}

#[test]
fn the_papers_platform_is_frozen() {
    // The paper's own kinetic energy of the debalance, with its two misprints
    // corrected: e^2 printed for x0^2 + y0^2, and a missing constant. The equations of
    // the platform follow from it.
    assert_agreement(
        "machine PaperCrusher extends \"vibrating_crusher.machine\" {
            remove springs.x_right; remove springs.y_left;
            remove dampers.x_right; remove dampers.y_left;
            approximations { theta: frozen }
            published \"corrected\" {
                velocity debalance = (
                    der(x) - (x0*sin(theta) + y0*cos(theta))*der(theta) - e*omega*sin(omega*t),
                    der(y) + (x0*cos(theta) - y0*sin(theta))*der(theta) + e*omega*cos(omega*t)
                ),
                kinetic_energy debalance = m0/2*(der(x)^2 + der(y)^2) + m0/2*(x0^2 + y0^2)*der(theta)^2
                    + J0/2*omega^2 + m0/2*(e*omega)^2 + m0*x0*der(y)*der(theta) - m0*y0*der(x)*der(theta)
                    - m0*e*omega*sin(omega*t)*der(x) + m0*e*omega*cos(omega*t)*der(y)
                    + m0*e*omega*(y0*sin(omega*t) + x0*cos(omega*t))*der(theta),
                equation theta: -m0*y0*der(der(x)) + m0*x0*der(der(y)) + (J + m0*(x0^2 + y0^2))*der(der(theta))
                    + m0*e*omega^2*(y0*cos(omega*t) - x0*sin(omega*t))
                    - yc*(cx*(x - yc*theta) + bx*(der(x) - yc*der(theta)))
                    + xc*(cy*(y + xc*theta) + by*(der(y) + xc*der(theta))) = 0,
                equation s2: cos(phi2)*der(der(x)) + sin(phi2)*der(der(y)) + cos(phi2 - phi1)*der(der(s1))
                    + s1*sin(phi2 - phi1)*der(der(phi1)) + der(der(s2))
                    + 2*sin(phi2 - phi1)*der(s1)*der(phi1) - s1*cos(phi2 - phi1)*der(phi1)^2 - s2*der(phi2)^2 = 0,
            }
        }",
    );
}

#[test]
fn freezing_leaves_sums_of_angles_their_other_part() {
    assert_agreement(
        "machine Links in plane {
            parameters { m: kg = 1, l: m = 1, J: kg*m^2 = 1 }
            coordinates { theta: rad, phi: rad }
            frames { upper = ground.turn(theta), lower = upper.shift(l, 0).turn(phi) }
            bodies {
                upper { mass: m, inertia: J, frame: upper },
                bob { mass: m, at: lower.point(l, 0) },
            }
            approximations { theta: frozen }
            published \"by hand\" {
                kinetic_energy = J/2*der(theta)^2
                    + m/2*l^2*(sin(phi)*(der(theta) + der(phi)))^2
                    + m/2*l^2*(der(theta) + cos(phi)*(der(theta) + der(phi)))^2,
                position bob = l*(cos(theta) + cos(theta + phi), sin(theta) + sin(theta + phi)),
            }
        }",
    );
}

#[test]
fn gravity_and_springs_know_nothing_of_freezing() {
    assert_agreement(
        "machine Pendulum in plane {
            parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
            coordinates { theta: rad }
            bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
            gravity (0, -g);
            approximations { theta: frozen }
            published \"by hand\" { equation theta: l*der(der(theta)) + g*sin(theta) = 0 }
        }",
    );
}

/// T, V and D of a machine of the library whose platform has the angle and the rate scaled by
/// `epsilon`, with the other coordinates and rates unchanged.
fn energies(machine: &str, epsilon: f64) -> [DoubleDouble; 3] {
    derived(&text_of(machine), |model, equations| {
        let number = DoubleDouble::from_f64;
        let mut known = vec![(model.time, number(0.3))];
        for (k, c) in model.coordinates.iter().enumerate() {
            let scale = if c.name.base == "theta" { epsilon } else { 1.0 };
            known.push((c.q, number(scale * (0.3 + 0.05 * k as f64))));
            known.push((c.v, number(scale * (2.0 - 0.3 * k as f64))));
        }
        for p in &model.parameters {
            let default = p.default.expect("every parameter has one");
            known.push((
                p.symbol,
                evaluate(model.dag, &[default], |_| DoubleDouble::ZERO)[0],
            ));
        }
        let value = |symbol| {
            let found = known.iter().find(|(e, _)| e.as_symbol() == Some(symbol));
            found.expect("all symbols are known").1
        };
        let energies = [
            equations.kinetic_energy,
            equations.potential_energy,
            equations.dissipation,
        ];
        let values = evaluate(model.dag, &energies, value);
        [values[0], values[1], values[2]]
    })
}

#[test]
fn what_a_small_angle_leaves_out_is_its_cube() {
    let mut differences = Vec::new();
    for k in 4..14 {
        let epsilon = 0.5_f64.powi(k);
        let exact = energies("vibrating_crusher", epsilon);
        let small = energies("small_angle_crusher", epsilon);
        // Springs and dampers are of second order already, so they stay exact.
        for e in 1..3 {
            let limit = DoubleDouble::from_f64(1e-29) * exact[e].abs();
            assert!(!(exact[e] - small[e]).abs().exceeds(limit));
        }
        differences.push((epsilon, (exact[0] - small[0]).to_f64()));
    }
    for pair in differences.windows(2) {
        let [(epsilon, full), (_, half)] = *pair else {
            continue;
        };
        // full/half = 8 (1 + ½ ε c₄/c₃ + …) for ε³ c₃ + ε⁴ c₄ + …. With (a, b) the velocity of the
        // debalance without the part from θ̇, the series is θ̇ [½ θ² (a y₀ − b x₀) + ⅙ θ³ (a x₀ + b
        // y₀) + …], and c₄/c₃ is −0.06 at this state.
        assert!(
            (full / half - 8.0).abs() <= 8.0 * epsilon,
            "{epsilon}: {}",
            full / half
        );
    }
}

#[test]
fn what_freezing_leaves_out_is_of_second_order() {
    // −θ̇ [θ (a x₀ + b y₀) − ½ θ² (a y₀ − b x₀) + …]: the cubic term is 0.5 ε of the
    // quadratic one at this state.
    let off = |epsilon: f64| {
        let [exact, frozen] =
            ["vibrating_crusher", "frozen_crusher"].map(|m| energies(m, epsilon)[0]);
        (exact - frozen).to_f64()
    };
    for k in 4..14 {
        let epsilon = 0.5_f64.powi(k);
        let ratio = off(epsilon) / off(epsilon / 2.0);
        assert!((ratio - 4.0).abs() <= 4.0 * epsilon, "{epsilon}: {ratio}");
    }
}
