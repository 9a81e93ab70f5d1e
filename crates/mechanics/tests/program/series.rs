//! Taylor series obey the literal equations, wrong ones are found, and the number of their products is as expected.

use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_program::series::{Composition, NoSeries, Row, Series, Source};

use super::harness::{all_machines, compiled, machine};

/// The series of a machine of the library.
fn of(name: &str, constants: &[(&str, i64)]) -> Result<ProvedSeries, NoSeries> {
    machine(name, constants, |machine| {
        ProvedSeries::derive(&machine.model)
    })
}

/// A ball on a line that a force pushes.
fn pushed(force: &str) -> String {
    format!(
        "machine Pushed in plane {{
            parameters {{ m: kg = 1.25, c: 1 = 0.75, k: N = 1, w: 1/s = 3, l: m = 1, beat: s = 1 }}
            inputs {{ u: 1 = 0.5 }}
            coordinates {{ x: rad = 0.5, y: rad = 0.25 }}
            bodies {{ ball {{ mass: m, at: l*(x, sin(y)) }}, other {{ mass: m, at: l*(0, y) }} }}
            forces {{ push {{ at: l*(x, y), force: k*({force}, 1) }} }}
        }}"
    )
}

/// Every machine of the library has a series, proved over the prime field or over balls, or is known to have none.
#[test]
fn every_machine_has_a_proved_series_or_a_reason() {
    let mut found = 0;
    for name in all_machines() {
        match of(&name, &[]) {
            Ok(series) => {
                found += 1;
                println!(
                    "{name}: {} products, {} rows",
                    series.products(),
                    series.rows.len()
                );
            }
            Err(
                reason @ (NoSeries::Constraints | NoSeries::Approximations | NoSeries::Friction),
            ) => println!("{name}: none, since {reason}"),
            Err(reason @ NoSeries::Function(_)) => println!("{name}: none, since {reason}"),
            Err(reason) => panic!("{name}: {reason}"),
        }
    }
    assert!(found >= 25, "{found}");
}

/// The time of a step with 12 and with 20 coefficients over a twelfth of the time of one of DOP853, measured with compiled code
/// (`cargo bench --bench time_against_error -- --costs`); machines that differ by a factor of 10, with and without constraints.
#[test]
fn costs_of_steps_are_those_measured_to_within_a_factor_of_two() {
    let measured = [
        ("double_pendulum", 0, [5.0, 7.0]),
        ("crusher9", 0, [6.3, 9.8]),
        ("chain", 8, [8.7, 13.4]),
        ("chain", 16, [17.3, 25.3]),
        ("heavy_top", 0, [3.5, 5.0]),
        ("six_joint_arm", 0, [38.7, 73.4]),
        ("spherical_pendulum", 0, [4.7, 6.8]),
        ("elastic_pendulum", 0, [5.4, 7.7]),
        ("two_body_orbit", 0, [5.8, 8.5]),
        ("closed_pendulum", 0, [7.2, 10.2]),
        ("andrews_squeezer", 0, [17.2, 23.5]),
        ("flyball_governor", 0, [7.3, 10.9]),
    ];
    for (name, links, measured) in measured {
        let constants: &[_] = if name == "chain" {
            &[("N", links)]
        } else {
            &[]
        };
        let costs = machine(name, constants, |machine| {
            let series = ProvedSeries::derive(&machine.model).expect("a series");
            series.cost(&machine.program).expect("accelerations")
        });
        println!("{name} {links}: {costs:.1?}; measured {measured:?}");
        assert!(costs[0] < costs[1]);
        for (cost, measured) in costs.into_iter().zip(measured) {
            assert!((0.5..2.0).contains(&(cost / measured)), "{name}: {cost}");
        }
    }
}

/// What an energy balance adds to an evaluation of the crusher, and to a step with 12 and with 20 coefficients, in evaluations: from the times of runs with and without
/// it, compiled, as of `cargo bench --bench time_against_error`, at the tolerances 1e-4 and 1e-9. Machines without powers pay nothing.
#[test]
fn costs_of_powers_are_those_measured_to_within_a_factor_of_two() {
    let costs = |name: &str| {
        machine(name, &[], |machine| {
            let series = ProvedSeries::derive(&machine.model).expect("a series");
            let series = series.series();
            series
                .cost_of_powers(&machine.program)
                .expect("accelerations")
        })
    };
    for (cost, measured) in costs("crusher9").into_iter().zip([0.36, 15.7, 13.8]) {
        println!("{cost:.1}; measured {measured}");
        assert!((0.5..2.0).contains(&(cost / measured)), "{cost}");
    }
    assert_eq!(
        machine("heavy_top", &[], |machine| machine
            .program
            .costs_of_powers()
            .count()),
        0
    );
}

/// Counts by hand: each link has a sine, a cosine and two projections; the crusher's nine coordinates rotate four
/// bodies and carry spring forces, which are linear in the rest.
#[test]
fn products_are_those_counted_by_hand() {
    assert_eq!(of("double_pendulum", &[]).unwrap().products(), 8.0);
    for links in [2, 3, 8] {
        let series = of("chain", &[("N", links)]).unwrap();
        assert_eq!(series.products(), 4.0 * links as f64, "{links} links");
    }
    // Relative angles cost no more.
    let series = of("chain_relative", &[("N", 8)]).unwrap();
    assert!(series.products() <= 32.0, "{}", series.products());
}

/// The form is chosen for each machine: momenta where velocities are products along axes of their own, positions where velocities add up. Counted by
/// hand from the printed kinetic energies: the spherical pendulum with T = ½ m l² (sin² θ φ̇² + θ̇²) has a sine and a cosine, sin² θ (½), its product with φ̇,
/// sin θ cos θ, φ̇² (½), and their product; the top has in addition cos θ ψ̇, the spin times cos θ, sin θ ψ̇, and that times the spin.
#[test]
fn the_form_with_the_fastest_steps_is_chosen() {
    let is_by_momenta = |name: &str| of(name, &[]).unwrap().rates_are_ahead;
    for (name, products) in [("spherical_pendulum", 6.0), ("heavy_top", 10.0)] {
        assert!(is_by_momenta(name), "{name}");
        assert_eq!(of(name, &[]).unwrap().products(), products, "{name}");
    }
    for name in ["double_pendulum", "crusher9", "chain", "four_bar"] {
        assert!(!is_by_momenta(name), "{name}");
    }
    // Neither precession nor spin, which may turn by many radians in a step, occurs in a sine.
    let series = of("heavy_top", &[]).unwrap();
    let angles = series.rows.iter().filter_map(|row| match row {
        Row::Sin(a, _) | Row::Cos(a, _) => Some(&series.rows[a.index()]),
        _ => None,
    });
    let angles: Vec<&Row> = angles.collect();
    assert!(
        !angles.is_empty() && angles.iter().all(|angle| **angle == Row::Coordinate(1)),
        "{angles:?}"
    );
}

/// The compositions of a machine's unknowns.
fn compositions(name: &str, constants: &[(&str, i64)]) -> Vec<Option<Composition>> {
    let series = of(name, constants).unwrap();
    let blocks = series.blocks().into_iter();
    blocks.map(|members| series.composition(&members)).collect()
}

/// Counted by hand: the unknowns of two links are sums of the second derivatives of two sines and two cosines, and of the projections of two
/// forces on each link. Those of the outer link act on it alone, with its length, and are added first. An order takes 14 products for both
/// unknowns, where residuals and solution take 22.
#[test]
fn accelerations_of_two_links_are_sums_of_seven_terms() {
    let all = compositions("double_pendulum", &[]);
    let [Some(composition)] = &all[..] else {
        panic!("{all:?}");
    };
    let of_kind = |is_kind: fn(&Source) -> bool| -> Vec<usize> {
        let groups = composition.sources.iter();
        let groups = groups.filter(|group| group.iter().all(is_kind));
        groups.map(Vec::len).collect()
    };
    let second = of_kind(|source| matches!(source, Source::Derivative(_)));
    let mut sums = of_kind(|source| matches!(source, Source::Sum(_)));
    sums.sort_unstable();
    assert_eq!(second, [1; 4]);
    assert_eq!(sums, [1, 1, 2]);
    assert_eq!(composition.residuals.len(), 2);
    // A matrix for many unknowns would have more elements than their equations have terms.
    for (name, constants) in [("crusher9", &[][..]), ("chain", &[("N", 8)])] {
        assert!(compositions(name, constants).contains(&None), "{name}");
    }
    // A wrong coefficient would be a wrong motion: the proof expands the series with its compositions.
    let composed = all_machines().into_iter().filter(|name| {
        of(name, &[]).is_ok() && compositions(name, &[]).iter().any(Option::is_some)
    });
    let composed: Vec<String> = composed.collect();
    println!("{composed:?}");
    assert!(composed.len() >= 5, "{composed:?}");
}

/// Every smooth function of the language, of positions and of rates.
#[test]
fn every_smooth_function_has_a_recurrence() {
    let forces = [
        "sin(x)*cos(x + c*y)",
        "tan(x)",
        "asin(c*sin(x))",
        "acos(c*sin(x))",
        "atan(x*y)",
        "atan2(y + 2, cos(x))",
        "sinh(x) - cosh(y)^3",
        "tanh(x + y) + tanh(c)",
        "exp(-x)*x",
        "ln(2 + sin(x))",
        "sqrt(2 + x^2)",
        "(2 + cos(x))^c",
        "(2 + cos(x))^(sin(y) + 2)",
        "1/(2 + x^2)^3 + u",
        "sin(w*t)*x + abs(c)*min(c, 1)",
        "(beat*der(x))^2*sin(x)",
        "tanh(beat*der(x))*u",
        "sqrt(1 + (beat*der(x) - beat*w)^2)",
    ];
    for force in forces {
        let text = pushed(force);
        let series = compiled(&text, &[], |machine| ProvedSeries::derive(&machine.model));
        assert!(series.is_ok(), "{force}: {series:?}");
    }
}

/// Functions with a kink are refused by name.
#[test]
fn what_has_a_kink_is_refused_by_name() {
    for function in ["abs(x)", "sign(x)", "min(x, y)", "max(x, 2*y)"] {
        let series = compiled(&pushed(function), &[], |m| ProvedSeries::derive(&m.model));
        let name = function.split('(').next().unwrap();
        let message = series.unwrap_err().to_string();
        assert!(message.contains(&format!("`{name}`")), "{message}");
    }
}

/// A series with one wrong row is not proved: a lost term or sign, a wrong operand, a sine instead of a cosine.
#[test]
fn damaged_series_are_not_proved() {
    let texts = [
        "tanh(beat*der(x))*sqrt(2 + x^2)",
        "atan2(y + 2, cos(x))/(2 + exp(x))",
        "(2 + cos(x))^c*sin(w*t)",
    ];
    let mut count = 0;
    let mut damage = |model: &lagrangian_spec::model::Model<'_>| {
        let good: Series = (**ProvedSeries::derive(model).unwrap().series()).clone();
        for index in 0..good.rows.len() {
            let mut wrong = good.clone();
            let row = &mut wrong.rows[index];
            *row = match row.clone() {
                Row::Sum(mut terms) if terms.len() > 1 => {
                    terms.pop();
                    Row::Sum(terms)
                }
                Row::Product(a, b) if a != b => Row::Square(a),
                Row::Square(_) | Row::Number(_) => continue,
                Row::Quotient(a, b) => Row::Product(a, b),
                Row::Sin(a, b) => Row::Cos(a, b),
                Row::Cos(a, b) => Row::Sin(a, b),
                Row::Sqrt(a) | Row::Exp(a) => Row::Square(a),
                Row::Power(a, _) => Row::Sqrt(a),
                Row::Tanh(a, b) => Row::Sinh(a, b),
                Row::TanhSlope(a) => Row::Square(a),
                Row::Second(_) => Row::Number(2.into()),
                Row::Atan2(y, x, over) => Row::Atan2(x, y, over),
                _ => continue,
            };
            count += 1;
            let name = format!("{:?} for {:?}", wrong.rows[index], good.rows[index]);
            assert_eq!(
                ProvedSeries::new(wrong, model),
                Err(NoSeries::Unproved),
                "{name}"
            );
        }
    };
    machine("double_pendulum", &[], |machine| damage(&machine.model));
    for force in texts {
        compiled(&pushed(force), &[], |machine| damage(&machine.model));
    }
    assert!(count > 40, "{count}");
}
