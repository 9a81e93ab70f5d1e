//! Which published formulas count as the same, and the messages about those that do not.

use lagrangian_print::compare::compare;

use crate::harness::derived;

/// The result for items that a pendulum publishes: the terms to add and to drop, or
/// nothing for an item that agrees.
fn said(items: &str) -> Vec<Option<(Vec<String>, Vec<String>)>> {
    derived(&pendulum(items), |model, equations| {
        let said =
            |c: lagrangian_print::compare::Comparison| (!c.agrees).then(|| (c.add(), c.drop()));
        compare(model, equations).into_iter().map(said).collect()
    })
}

/// A pendulum that publishes these items.
fn pendulum(items: &str) -> String {
    format!(
        "machine Pendulum in plane {{
            parameters {{ m: kg = 1, l: m = 1, g: m/s^2 = 9.81, b: N*m*s = 1, k: N*m = 1 }}
            coordinates {{ theta: rad }}
            inputs {{ u: N*m = 0 }}
            bodies {{ bob {{ mass: m, at: l*(sin(theta), -cos(theta)) }} }}
            gravity (0, -g);
            dissipations {{ hinge: b/2*der(theta)^2 }}
            potentials {{ well: k*ln(1 + theta^2) }}
            forces {{ motor {{ on: theta, value: u }} }}
            published \"as printed\" {{ {items} }}
        }}"
    )
}

/// The terms reported as changes, as printed and as they should be, and the number of terms left to
/// add and to drop.
fn changes(machine: &str) -> (Vec<(String, String)>, usize) {
    derived(machine, |model, equations| {
        let [comparison] = &compare(model, equations)[..] else {
            panic!("one item is published");
        };
        let (add, drop) = (comparison.add(), comparison.drop());
        let pairs = comparison.changes().into_iter();
        let pairs: Vec<_> = pairs
            .map(|(i, j)| (drop[i].clone(), add[j].clone()))
            .collect();
        let left = add.len() + drop.len() - 2 * pairs.len();
        (pairs, left)
    })
}

/// The mistakes in a single item that is wrong.
fn mistakes(item: &str) -> (Vec<String>, Vec<String>) {
    said(item).swap_remove(0).expect("it is wrong")
}

#[test]
fn a_factor_of_parameters_does_not_change_an_equation() {
    let rest = "b*der(theta) + m*g*l*sin(theta) + 2*k*theta/(1 + theta^2)";
    for equation in [
        format!("equation theta: m*l^2*der(der(theta)) + {rest} = u"),
        format!("equation theta: u = m*l^2*der(der(theta)) + {rest}"),
        format!("equation theta: -m*l^2*der(der(theta)) = {rest} - u"),
        format!("equation theta: der(der(theta)) + ({rest})/(m*l^2) = u/(m*l^2)"),
        format!("equation theta: (2*m*l^2*der(der(theta)) + 2*({rest} - u))*(m + m*l^2)/g = 0"),
    ] {
        assert_eq!(said(&equation), [None], "{equation}");
    }
}

#[test]
fn a_factor_that_moves_does() {
    let rest = "b*der(theta) + m*g*l*sin(theta) + 2*k*theta/(1 + theta^2)";
    let equation = format!("equation theta: (m*l^2*der(der(theta)) + {rest} - u)*theta = 0");
    assert!(said(&equation)[0].is_some());
}

#[test]
fn nothing_is_no_equation() {
    assert!(said("equation theta: 0 = 0")[0].is_some());
    assert!(said("equation theta: sin(theta)^2 + cos(theta)^2 - 1 = 0")[0].is_some());
}

#[test]
fn mistakes_are_told_in_the_scale_of_the_print() {
    let (add, drop) = mistakes(
        "equation theta: der(der(theta)) + b/(m*l^2)*der(theta) - g/l*sin(theta) \
         + 2*k*theta/(1 + theta^2)/(m*l^2) - u/(m*l^2) = 0",
    );
    assert_eq!(
        (add, drop),
        (
            vec!["g/l*sin(theta)".to_owned()],
            vec!["-g/l*sin(theta)".to_owned()]
        )
    );
}

#[test]
fn a_constant_of_the_potential_energy_is_nobodys_mistake() {
    assert_eq!(
        said("potential_energy = m*g*l*(1 - cos(theta)) + k*ln(1 + theta^2)"),
        [None]
    );
    let (add, drop) = mistakes("potential_energy = m*g*l*(1 + cos(theta)) + k*ln(1 + theta^2)");
    assert_eq!((add.len(), drop.len()), (1, 1));
}

#[test]
fn theorems_of_logarithms_are_known_by_their_numbers() {
    assert_eq!(
        said("potential_energy = k/2*ln((1 + theta^2)^2) - m*g*l*cos(theta)"),
        [None]
    );
}

#[test]
fn a_constant_of_the_kinetic_energy_is_a_mistake() {
    let (add, drop) = mistakes("kinetic_energy = m*l^2*der(theta)^2/2 + b*g/l");
    assert_eq!((add, drop), (vec![], vec!["b*g/l".to_owned()]));
}

/// Two masses on one spring, whose names differ only by an index.
fn masses(kinetic_energy: &str) -> String {
    format!(
        "machine Masses in plane {{
            parameters {{ m1: kg = 1, m2: kg = 2, k: N/m = 3, l: m = 1 }}
            coordinates {{ x1: m, x2: m }}
            bodies {{ one {{ mass: m1, at: (x1, 0) }}, two {{ mass: m2, at: (x2, 0) }} }}
            springs {{ between {{ stiffness: k, stretch: x2 - x1 - l }} }}
            published \"as printed\" {{ kinetic_energy = {kinetic_energy} }}
        }}"
    )
}

#[test]
fn a_slip_is_told_as_a_change() {
    for slip in [
        "-1/2*m1*der(x1)^2",     // the sign
        "m1*der(x1)^2",          // the number
        "1/2*der(x1)^2",         // a factor missing
        "1/2*m1*l*der(x1)^2",    // a superfluous factor
        "1/2*m1*der(x1)",        // the power
        "1/2*m1*x1^2",           // a dot missing
        "1/2*m1*der(der(x1))^2", // a superfluous dot
        "1/2*m2*der(x1)^2",      // the index of a parameter
        "1/2*k*der(x1)^2",       // another factor
        "-m1*der(x1)^2",         // two mistakes
    ] {
        let (pairs, left) = changes(&masses(&format!("{slip} + 1/2*m2*der(x2)^2")));
        assert_eq!(pairs.len(), 1, "{slip}: {pairs:?}");
        let right = "1/2*m1*der(x1)^2";
        assert_eq!((pairs[0].1.as_str(), left), (right, 0), "{slip}: {pairs:?}");
    }
}

#[test]
fn what_is_no_slip_is_dropped_and_added() {
    for (other, left) in [
        ("-1/2*k*der(x1)^2", 2), // a sign and another factor
        ("k*l", 2),              // nothing in common
        ("0", 1),                // empty
    ] {
        let told = changes(&masses(&format!("{other} + 1/2*m2*der(x2)^2")));
        assert_eq!(told, (vec![], left), "{other}");
    }
}

#[test]
fn changes_take_the_fewest_slips_together() {
    // Either could be the first term with a mistake; the second one is the
    // second term with another mistake.
    let (pairs, left) = changes(&masses("-1/2*m1*der(x1)^2 + 1/2*m2*der(x1)*der(x2)"));
    let expected = [
        ("-1/2*m1*der(x1)^2", "1/2*m1*der(x1)^2"),
        ("1/2*m2*der(x1)*der(x2)", "1/2*m2*der(x2)^2"),
    ];
    let expected = expected.map(|(from, to)| (from.to_owned(), to.to_owned()));
    assert_eq!((pairs, left), (expected.to_vec(), 0));
}

#[test]
fn brackets_are_told_as_printed() {
    let printed = |energy: &str| {
        let published = format!("potential_energy = {energy}");
        masses("0").replace("kinetic_energy = 0", &published)
    };
    let change = |energy: &str| changes(&printed(energy));
    let right = "1/2*k*(x2 - x1 - l)^2";
    for wrong in [
        "1/2*k*(x2 + x1 - l)^2",
        "-1/2*k*(x2 - x1 - l)^2",
        "1/2*k*(x2 - x1 - l)",
    ] {
        let (pairs, left) = change(wrong);
        assert_eq!((pairs.len(), left), (1, 0), "{wrong}: {pairs:?}");
        // The order of the terms in the bracket does not matter.
        let same = format!(
            "potential_energy = {right} + ({}) - ({})",
            pairs[0].0, pairs[0].1
        );
        let wrong = masses("0").replace("kinetic_energy = 0", &same);
        let (again, _) = changes(&wrong);
        assert_eq!(again, pairs);
    }
    // Multiplied out it still agrees, and a mistake in it is reported for a term.
    let open = "1/2*k*x1^2 + 1/2*k*x2^2 - k*x1*x2 + k*l*x1";
    let (pairs, left) = change(&format!("{open} + k*l*x2"));
    assert_eq!((pairs.len(), left), (1, 0), "{pairs:?}");
    assert_eq!(pairs[0].1, "-k*l*x2");
}

#[test]
fn units_that_do_not_fit_are_remarks() {
    let remarks = |energy: &str| {
        derived(&masses(energy), |model, equations| {
            let comparison = compare(model, equations).swap_remove(0);
            comparison.remarks.len()
        })
    };
    assert_eq!(remarks("1/2*m1*der(x1)^2 + 1/2*m2*der(x2)^2"), 0);
    assert_eq!(remarks("1/2*m1*der(x1)^2 + 1/2*m2*der(x2)*x2"), 1);
}

#[test]
fn a_term_is_told_in_the_words_of_the_print() {
    for (wrong, right) in [
        ("1/2*der(x1)^2*m2", "1/2*der(x1)^2*m1"), // another index, in its place
        ("-1/2*der(x1)^2*m1", "1/2*der(x1)^2*m1"), // the sign
        ("m1*der(x1)^2/4", "1/2*m1*der(x1)^2"),   // the number, which goes to the front
        ("der(x1)^2/2", "m1*der(x1)^2/2"),        // a factor that was missing
        ("1/2*m1*l*der(x1)^2", "1/2*m1*der(x1)^2"), // and a superfluous one
        ("m1*der(x1)^2/(2*l)", "1/2*m1*der(x1)^2"), // in the denominator, together with the number
    ] {
        let (pairs, left) = changes(&masses(&format!("{wrong} + 1/2*m2*der(x2)^2")));
        let expected = vec![(wrong.to_owned(), right.to_owned())];
        assert_eq!((pairs, left), (expected, 0));
    }
    // A term that does not occur in the printed order is written in the usual order.
    let (pairs, _) = changes(&masses("1/2*(m1*der(x1)^2 - der(x2)^2*m2)"));
    let expected = vec![(
        "-1/2*m2*der(x2)^2".to_owned(),
        "1/2*m2*der(x2)^2".to_owned(),
    )];
    assert_eq!(pairs, expected);
}
