//! Every method of the list is as published: its coefficients obey the order conditions, and its steps and dense output
//! converge at the stated orders.

use crate::by_hand::toy::{Toy, oscillator};
use lagrangian::methods::{Conjugates, MethodError, Tableau, Tree as Rooted, Weights};
use lagrangian::{
    DefaultInputs, InputFunction, InputLaw, METHODS, Method, NoBalance, RADAU_OF_HIGH_ORDER,
    Simulation, Stepper, Tolerance,
};

#[test]
fn steps_obey_every_order_condition() {
    for method in &METHODS {
        let tableau = &method.tableau;
        let b = tableau.a[tableau.stages];
        let failures = failed_conditions(tableau, b, tableau.order, 1.0);
        assert!(failures.is_empty(), "{}: {failures:?}", tableau.name);
        // The order is not higher: some conditions of the next order fail.
        assert!(!failed_conditions(tableau, b, tableau.order + 1, 1.0).is_empty());
    }
}

/// Uses the trees of the library, which other tests show to be complete; the trees of this file would take too long
/// to generate up to 13 vertices.
#[test]
fn radau_of_high_order_is_what_it_says_and_no_more() {
    for method in &RADAU_OF_HIGH_ORDER {
        let tableau = &method.tableau;
        assert_eq!(method.check(), Ok(()), "{}", tableau.name);
        for wrong in [
            Tableau {
                order: tableau.order + 1,
                ..copy(tableau)
            },
            Tableau {
                dense_order: tableau.dense_order + 1,
                ..copy(tableau)
            },
            Tableau {
                error_power: tableau.error_power + 1,
                ..copy(tableau)
            },
        ] {
            assert!(Method::try_new(wrong).is_err(), "{}", tableau.name);
        }
    }
}

/// Gauss methods have the highest order that their stages allow, and the classical method has order 4.
#[test]
fn methods_of_fixed_steps_obey_their_order_conditions() {
    for name in ["rk4", "gauss4", "gauss6", "gauss8"] {
        let tableau = &Method::named(name).unwrap().tableau;
        let b = tableau.a[tableau.stages];
        let failures = failed_conditions(tableau, b, tableau.order, 1.0);
        assert!(failures.is_empty(), "{name}: {failures:?}");
        assert!(!failed_conditions(tableau, b, tableau.order + 1, 1.0).is_empty());
    }
}

#[test]
fn dense_output_obeys_every_order_condition() {
    for method in &METHODS {
        let tableau = &method.tableau;
        for theta in [0.1, 0.25, 0.5, 0.7, 0.95, 1.0] {
            let b = dense_weights(tableau, theta);
            let failures = failed_conditions(tableau, &b, tableau.dense_order, theta);
            assert!(
                failures.is_empty(),
                "{} at {theta}: {failures:?}",
                tableau.name
            );
        }
    }
}

#[test]
fn error_estimates_vanish_for_motions_that_a_lower_order_follows() {
    for method in &METHODS {
        let tableau = &method.tableau;
        // The weights b − b̂ of methods of orders p and p̂ give 0 for every tree of at most p̂ vertices.
        let fine = tableau.error_power.min(6) - 1;
        let mut estimates = vec![(tableau.error, fine)];
        estimates.extend(tableau.coarse_error.map(|coarse| (coarse, 3)));
        for (weights, order) in estimates {
            for tree in (1..=order).flat_map(trees) {
                let (sum, roundoff) = elementary_weight(tableau, weights, &tree);
                assert!(
                    sum.abs() <= roundoff,
                    "{}: {tree:?} gives {sum:e}",
                    tableau.name
                );
            }
            let some = trees(order + 1)
                .iter()
                .any(|tree| elementary_weight(tableau, weights, tree).0.abs() > 1e-6);
            assert!(some, "{}: estimates nothing", tableau.name);
        }
    }
}

#[test]
fn every_stage_is_where_it_says() {
    for method in &METHODS {
        let Tableau { a, c, name, .. } = method.tableau;
        for (i, row) in a.iter().enumerate() {
            let sum: f64 = row.iter().sum();
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            assert!(
                (sum - c[i]).abs() <= 16.0 * f64::EPSILON * size,
                "{name}: stage {i}"
            );
        }
    }
}

#[test]
fn steps_and_dense_output_converge_at_their_order() {
    for method in &METHODS {
        // Equal steps until t = 2, then half as long: errors at the end, and the largest error within a step.
        let coarse = 2.0 / if method.tableau.order == 8 { 6.0 } else { 40.0 };
        let [end_1, within_1] = errors_of_equal_steps(method, coarse);
        let [end_2, within_2] = errors_of_equal_steps(method, coarse / 2.0);
        let order = (end_1 / end_2).log2();
        let dense_order = (within_1 / within_2).log2();
        let Tableau {
            name,
            order: step_claimed,
            dense_order: dense_claimed,
            ..
        } = method.tableau;
        // Halving the steps once gives the order up to a term of relative size h.
        assert!(
            (order - f64::from(step_claimed)).abs() < 0.5,
            "{name}: order {order}"
        );
        // Relative to the beginning of its step, the error of dense output is O(h^(dense order + 1)).
        let expected = f64::from(dense_claimed + 1);
        assert!(
            (dense_order - expected).abs() < 0.5,
            "{name}: dense order {dense_order}"
        );
    }
}

#[test]
fn motions_that_a_method_follows_exactly_are_followed_exactly() {
    // x'' = (k)(k − 1) t^(k − 2): a method of order p integrates v = k t^(k−1) exactly for k ≤ p,
    // and x = t^k with it.
    for method in &METHODS {
        for power in 2..=i32::try_from(method.tableau.order).unwrap() {
            let toy = Toy {
                p: f64::from(power),
                ..Toy::new(([0.0], [0.0]), |t, _, _, _, k| {
                    [k * (k - 1.0) * t.powf(k - 2.0)]
                })
            };
            let run = Simulation::new(&toy)
                .method(method)
                .first_step(0.5)
                .longest_step(0.5)
                .tolerance(0.5)
                .until(1.0)
                .run(toy.start())
                .unwrap();
            let error = (run.end().q[0] - 1.0).abs();
            assert!(
                error <= 64.0 * f64::EPSILON,
                "{} t^{power}: {error:e}",
                method.tableau.name
            );
        }
    }
}

#[test]
fn a_step_costs_the_evaluations_that_it_says() {
    let explicit = |method: &&Method| method.tableau.spectrum.is_none();
    for method in METHODS.iter().filter(explicit) {
        let oscillator = oscillator();
        let law = InputFunction(|_, _: &[f64; 1], _: &[f64; 1], _: &mut f64| {});
        let mut stepper = stepper(&oscillator, law, method, 0.1);
        let before = stepper.work().evaluations;
        while !stepper.is_done() {
            stepper.step().unwrap();
        }
        let work = stepper.work();
        assert_eq!(work.rejected, 0);
        let stages = method.tableau.stages;
        // The last evaluation of a step is the first of the next one.
        assert_eq!(work.evaluations - before, work.steps * stages);
        stepper.interpolant().unwrap();
        let extra = method.tableau.a.len() - stages - 1;
        assert_eq!(stepper.work().evaluations, work.evaluations + extra);
    }
}

#[test]
fn the_eigenvectors_of_implicit_methods_are_those_of_their_stages() {
    let implicit = METHODS.iter().filter_map(|method| {
        let spectrum = method.tableau.spectrum?;
        Some((method.tableau.a, spectrum))
    });
    let mut count = 0;
    for (a, spectrum) in implicit {
        count += 1;
        let real = |x: f64| [x, 0.0];
        let of_real = [spectrum.left_of_real, spectrum.right_of_real];
        let [left, right] = of_real.map(|vector| vector.iter().copied().map(real).collect());
        let [pair] = spectrum.pairs else {
            panic!("three stages have one pair");
        };
        let pairs: [(_, Vec<_>, Vec<_>); 2] = [
            (real(spectrum.real), left, right),
            (pair.value, pair.left.to_vec(), pair.right.to_vec()),
        ];
        let sum = |terms: &mut dyn Iterator<Item = [f64; 2]>| {
            terms.fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]])
        };
        let product = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
        let is = |x: [f64; 2], y: [f64; 2]| {
            // Sums of three products of rounded numbers of size up to 5.
            (x[0] - y[0]).hypot(x[1] - y[1]) <= 3.0 * 3.0 * 5.0 * f64::EPSILON
        };
        for (mu, left, right) in pairs {
            for i in 0..3 {
                let along = |j: usize| {
                    (
                        real(a[j + 1][i + 1]),
                        real(a[i + 1][j + 1]),
                        left[j],
                        right[j],
                    )
                };
                let w = sum(&mut (0..3).map(|j| product(along(j).0, along(j).2)));
                assert!(is(w, product(mu, left[i])), "{w:?}");
                let u = sum(&mut (0..3).map(|j| product(along(j).1, along(j).3)));
                assert!(is(u, product(mu, right[i])), "{u:?}");
            }
            let one = sum(&mut (0..3).map(|j| product(left[j], right[j])));
            assert!(is(one, [1.0, 0.0]), "{one:?}");
        }
        // Left and right eigenvectors of different eigenvalues are orthogonal.
        let other =
            sum(&mut (0..3).map(|j| product(real(spectrum.left_of_real[j]), pair.right[j])));
        assert!(is(other, [0.0; 2]), "{other:?}");
    }
    assert_eq!(count, 1);
}

#[test]
fn methods_have_names() {
    for method in &METHODS {
        let named = Method::named(method.tableau.name).unwrap();
        assert_eq!(named.tableau.title, method.tableau.title);
    }
    assert!(Method::named("euler").is_none());
    assert_eq!(<&Method>::default().tableau.name, "dop853");
}

/// A stepper with equal steps `h` to t = 2.
fn stepper<'s, L: InputLaw<Toy<1>>>(
    toy: &'s Toy<1>,
    law: L,
    method: &'static Method,
    h: f64,
) -> Stepper<'s, Toy<1>, L> {
    let tolerance = Tolerance {
        relative: 0.5,
        absolute: [1e3],
    };
    let start = (0.0, toy.start.0, toy.start.1);
    let mut stepper = Stepper::new(toy, law, NoBalance, method, tolerance, start, 2.0).unwrap();
    stepper.set_first_step(h);
    stepper.set_longest_step(h);
    stepper
}

/// The error at the end, and the largest error within a step, for `x'' = −x` with equal steps.
fn errors_of_equal_steps(method: &'static Method, h: f64) -> [f64; 2] {
    let oscillator = oscillator();
    let mut stepper = stepper(&oscillator, DefaultInputs, method, h);
    let mut within = 0.0_f64;
    while !stepper.is_done() {
        stepper.step().unwrap();
        let piece = stepper.interpolant().unwrap();
        for i in 1..10 {
            let theta = f64::from(i) / 10.0;
            let (q, v) = piece.state_at(theta);
            let t = piece.time_at(theta);
            let [q0, v0] = [stepper.q_before()[0], stepper.v_before()[0]];
            let (sin, cos) = (t - stepper.t_before()).sin_cos();
            within = within.max((q[0] - (q0 * cos + v0 * sin)).abs());
            within = within.max((v[0] - (v0 * cos - q0 * sin)).abs());
        }
    }
    let end = (stepper.q()[0] - 2.0_f64.cos()).hypot(stepper.v()[0] + 2.0_f64.sin());
    [end, within]
}

/// A rooted tree, as the list of the trees attached to its root.
///
/// E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., 1993,
/// section II.2.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Tree(Vec<Tree>);

impl Tree {
    fn vertices(&self) -> u32 {
        1 + self.0.iter().map(Tree::vertices).sum::<u32>()
    }

    /// γ: the product of the sizes of all subtrees.
    fn density(&self) -> f64 {
        f64::from(self.vertices()) * self.0.iter().map(Tree::density).product::<f64>()
    }
}

/// All rooted trees with this number of vertices.
fn trees(vertices: u32) -> Vec<Tree> {
    if vertices == 0 {
        return Vec::new();
    }
    if vertices == 1 {
        return vec![Tree(Vec::new())];
    }
    // Each tree is a smaller tree with one more tree attached to its root.
    let mut all = Vec::new();
    for branch in 1..vertices {
        for trunk in trees(vertices - branch) {
            for twig in trees(branch) {
                let mut branches = trunk.0.clone();
                branches.push(twig);
                branches.sort();
                all.push(Tree(branches));
            }
        }
    }
    all.sort();
    all.dedup();
    all
}

/// `Σ bᵢ Φᵢ(tree)`, and a bound on its round-off, including that of the coefficients.
fn elementary_weight(tableau: &Tableau, b: &[f64], tree: &Tree) -> (f64, f64) {
    // Φᵢ of a tree is the product of Σⱼ aᵢⱼ Φⱼ over its branches.
    fn phi(a: &[&[f64]], tree: &Tree) -> Vec<f64> {
        let mut product = vec![1.0; a.len()];
        for branch in &tree.0 {
            let inner = phi(a, branch);
            for (product, row) in product.iter_mut().zip(a) {
                *product *= row.iter().zip(&inner).map(|(a, phi)| a * phi).sum::<f64>();
            }
        }
        product
    }
    let sizes: Vec<Vec<f64>> = tableau
        .a
        .iter()
        .map(|row| row.iter().map(|a| a.abs()).collect())
        .collect();
    let sizes: Vec<&[f64]> = sizes.iter().map(Vec::as_slice).collect();
    let sum = b
        .iter()
        .zip(phi(tableau.a, tree))
        .map(|(b, phi)| b * phi)
        .sum();
    let size: f64 = b
        .iter()
        .zip(phi(&sizes, tree))
        .map(|(b, phi)| b.abs() * phi)
        .sum();
    // Each vertex contributes a rounded coefficient, a rounded product, and sums of up to 16 terms.
    (
        sum,
        f64::from(tree.vertices()) * 18.0 * 0.5 * f64::EPSILON * size,
    )
}

/// The trees of at most `order` vertices that violate `Σ bᵢ Φᵢ = θ^vertices / γ`.
fn failed_conditions(tableau: &Tableau, b: &[f64], order: u32, theta: f64) -> Vec<Tree> {
    let all = (1..=order).flat_map(trees);
    all.filter(|tree| {
        let (sum, roundoff) = elementary_weight(tableau, b, tree);
        let exact = theta.powi(i32::try_from(tree.vertices()).unwrap()) / tree.density();
        (sum - exact).abs() > roundoff + f64::EPSILON
    })
    .collect()
}

/// The weights `b(θ)` of dense output: the polynomial of `Interpolant`, term by term.
fn dense_weights(tableau: &Tableau, theta: f64) -> Vec<f64> {
    let eta = 1.0 - theta;
    let weight = |row: &[f64], j: usize| row.get(j).copied().unwrap_or(0.0);
    let is = |j: usize, stage: usize| if j == stage { 1.0 } else { 0.0 };
    (0..tableau.a.len())
        .map(|j| {
            let rise = weight(tableau.a[tableau.stages], j);
            let bend = is(j, 0) - rise;
            let twist = rise - is(j, tableau.stages) - bend;
            let mut rest = 0.0;
            for (i, row) in tableau.dense.iter().enumerate().rev() {
                rest = weight(row, j) + if i % 2 == 0 { theta } else { eta } * rest;
            }
            theta * (rise + eta * (bend + theta * (twist + eta * rest)))
        })
        .collect()
}

#[test]
fn there_are_as_many_trees_as_cayley_counted() {
    let counts: Vec<usize> = (1..=8).map(|n| trees(n).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
}

#[test]
fn the_trees_of_a_check_are_all_trees() {
    for vertices in 1..=8 {
        let counted: Vec<Rooted> = Rooted::of(vertices).collect();
        let expected = trees(u32::try_from(vertices).unwrap());
        assert_eq!(counted.len(), expected.len());
        // Each value of the density occurs equally often.
        let mut densities: Vec<f64> = counted.iter().map(Rooted::density).collect();
        let mut exact: Vec<f64> = expected.iter().map(Tree::density).collect();
        densities.sort_by(f64::total_cmp);
        exact.sort_by(f64::total_cmp);
        assert_eq!(densities, exact);
        for (i, tree) in counted.iter().enumerate() {
            assert_eq!(tree.vertices(), vertices);
            assert!(!counted[..i].contains(tree), "{tree}");
        }
    }
    // A. Cayley's counts for more vertices.
    assert_eq!([9, 10, 12].map(|n| Rooted::of(n).count()), [286, 719, 4766]);
    assert_eq!(Rooted::of(0).count() + Rooted::of(17).count(), 0);
    assert_eq!(
        Rooted::of(3)
            .map(|tree| tree.to_string())
            .collect::<Vec<_>>(),
        ["[[[]]]", "[[][]]"]
    );
}

/// A copy of a method's tableau, for a test to modify.
fn copy(tableau: &Tableau) -> Tableau {
    Tableau {
        coarse_error: tableau.coarse_error,
        spectrum: tableau.spectrum,
        ..*tableau
    }
}

/// The reason why a tableau is refused, if it is.
fn refused(tableau: Tableau) -> Option<MethodError> {
    Method::try_new(tableau).err()
}

fn changed(row: &[f64], entry: usize, by: f64) -> &'static [f64] {
    let mut row = row.to_vec();
    row[entry] += by;
    row.leak()
}

fn with_row(
    rows: &[&'static [f64]],
    index: usize,
    row: &'static [f64],
) -> &'static [&'static [f64]] {
    let mut rows = rows.to_vec();
    rows[index] = row;
    rows.leak()
}

#[test]
fn every_method_of_the_list_is_what_it_says() {
    for method in &METHODS {
        method.check().unwrap();
        assert!(Method::try_new(copy(&method.tableau)).is_ok());
    }
}

#[test]
fn a_tableau_with_any_one_coefficient_changed_is_refused() {
    // Changes each coefficient by 10⁻⁹ of itself, which is small but far above rounding.
    for method in &METHODS {
        let tableau = &method.tableau;
        let name = tableau.name;
        for (i, row) in tableau.a.iter().enumerate() {
            for (j, entry) in row.iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                let by = 1e-9 * entry;
                let a = with_row(tableau.a, i, changed(row, j, by));
                let wrong = refused(Tableau { a, ..copy(tableau) });
                match wrong {
                    Some(MethodError::Node { row, .. }) => assert_eq!(row, i, "{name}"),
                    // In implicit methods the last row is a copy, which is checked first.
                    Some(MethodError::Field { field: "a", .. }) => {}
                    other => panic!("{name} a[{i}][{j}]: {other:?}"),
                }
                // If the sum of the row is kept, only an order condition can detect the change.
                let Some(k) = (0..row.len()).find(|k| *k != j && row[*k] != 0.0) else {
                    continue;
                };
                let by = 1e-5 * entry;
                let a = with_row(tableau.a, i, changed(changed(row, j, by), k, -by));
                let wrong = refused(Tableau { a, ..copy(tableau) });
                assert!(
                    matches!(
                        wrong,
                        Some(MethodError::Order { .. } | MethodError::Field { .. })
                    ),
                    "{name} a[{i}][{j}], a[{i}][{k}]: {wrong:?}"
                );
            }
        }
        for (i, node) in tableau.c.iter().enumerate() {
            let c = changed(tableau.c, i, 1e-9 * node.max(0.1));
            let wrong = refused(Tableau { c, ..copy(tableau) });
            let is_refused = matches!(
                wrong,
                Some(MethodError::Node { row, .. }) if row == i
            ) || matches!(
                wrong,
                Some(MethodError::Field {
                    field: "c" | "stability",
                    ..
                })
            );
            assert!(is_refused, "{name} c[{i}]: {wrong:?}");
        }
        let weights = |row: &'static [f64]| {
            let entries = row.iter().enumerate().filter(|(_, entry)| **entry != 0.0);
            entries
                .map(|(j, entry)| changed(row, j, 1e-9 * entry))
                .collect::<Vec<_>>()
        };
        for error in weights(tableau.error) {
            let wrong = refused(Tableau {
                error,
                ..copy(tableau)
            });
            let is_refused = matches!(
                wrong,
                Some(
                    MethodError::Order {
                        weights: Weights::Error,
                        ..
                    } | MethodError::ErrorPower { .. }
                )
            );
            assert!(is_refused, "{name}: {wrong:?}");
        }
        for coarse in tableau.coarse_error.into_iter().flat_map(weights) {
            let wrong = refused(Tableau {
                coarse_error: Some(coarse),
                ..copy(tableau)
            });
            assert!(
                matches!(wrong, Some(MethodError::ErrorPower { stated: 8, .. })),
                "{wrong:?}"
            );
        }
        for (i, row) in tableau.dense.iter().enumerate() {
            for row in weights(row) {
                let dense = with_row(tableau.dense, i, row);
                let wrong = refused(Tableau {
                    dense,
                    ..copy(tableau)
                });
                assert!(
                    matches!(
                        wrong,
                        Some(MethodError::Order {
                            weights: Weights::Dense(_),
                            ..
                        })
                    ),
                    "{name}: {wrong:?}"
                );
            }
        }
        let higher = Tableau {
            order: tableau.order + 1,
            ..copy(tableau)
        };
        assert!(Method::try_new(higher).is_err(), "{name}");
        let denser = Tableau {
            dense_order: tableau.dense_order + 1,
            ..copy(tableau)
        };
        assert!(Method::try_new(denser).is_err(), "{name}");
    }
}

#[test]
fn a_spectrum_that_is_not_that_of_the_stages_is_refused() {
    let radau = &Method::named("radau5").unwrap().tableau;
    let spectrum = radau.spectrum.unwrap();
    let pair = spectrum.pairs[0];
    let with = |pair: Conjugates| -> &'static [Conjugates] { vec![pair].leak() };
    let mut wrong = vec![spectrum; 5];
    wrong[0].real += 1e-9;
    let mut value = pair.value;
    value[1] += 1e-9;
    wrong[1].pairs = with(Conjugates { value, ..pair });
    let mut left = spectrum.left_of_real.to_vec();
    left[1] += 1e-9;
    wrong[2].left_of_real = left.leak();
    let mut right = pair.right.to_vec();
    right[0][1] += 1e-9;
    let right = right.leak();
    wrong[3].pairs = with(Conjugates { right, ..pair });
    let left = pair.left.iter().map(|w| w.map(|x| 2.0 * x));
    let left = left.collect::<Vec<_>>().leak();
    wrong[4].pairs = with(Conjugates { left, ..pair });
    for spectrum in wrong {
        let tableau = Tableau {
            spectrum: Some(spectrum),
            ..copy(radau)
        };
        let refused = refused(tableau);
        assert!(
            matches!(refused, Some(MethodError::Spectrum { .. })),
            "{refused:?}"
        );
    }
}

#[test]
fn a_tableau_of_a_wrong_shape_is_refused_in_words() {
    let euler = || Tableau {
        name: "heun",
        title: "Heun 2(1)",
        order: 2,
        error_power: 2,
        dense_order: 2,
        stages: 2,
        c: &[0.0, 1.0, 1.0],
        a: &[&[], &[1.0], &[0.5, 0.5]],
        error: &[-0.5, 0.5],
        coarse_error: None,
        dense: &[],
        step_change: (0.2, 5.0),
        smoothing: 0.0,
        stability: None,
        spectrum: None,
    };
    assert!(Method::try_new(euler()).is_ok());
    let long: &'static [&'static [f64]] = vec![&[0.0_f64; 3] as &[f64]; 20].leak();
    let cases: Vec<(Tableau, &str)> = vec![
        // Weights with the sum 2.
        (
            Tableau {
                a: &[&[], &[1.0], &[1.0, 1.0]],
                ..euler()
            },
            "row 2 of `a` adds up to 2, and its node `c` is 1",
        ),
        (
            Tableau {
                a: &[&[], &[0.5, 0.5], &[0.5, 0.5]],
                ..euler()
            },
            "row 1 of `a`",
        ),
        (
            Tableau {
                a: &[&[], &[f64::NAN], &[0.5, 0.5]],
                ..euler()
            },
            "row 1 of `a`",
        ),
        (
            Tableau {
                a: &[&[], &[1.0]],
                ..euler()
            },
            "`a` must be",
        ),
        (Tableau { a: &[], ..euler() }, "`a` must be"),
        (
            Tableau { a: long, ..euler() },
            "`a` must be at most 16 rows",
        ),
        (
            Tableau {
                c: &[0.0, 1.0],
                ..euler()
            },
            "`c` must be as long",
        ),
        (
            Tableau {
                c: &[0.1, 1.0, 1.0],
                ..euler()
            },
            "`c` must be 0",
        ),
        (
            Tableau {
                stages: 0,
                ..euler()
            },
            "`stages`",
        ),
        (
            Tableau {
                stages: usize::MAX,
                ..euler()
            },
            "`a`",
        ),
        (
            Tableau {
                order: 0,
                ..euler()
            },
            "`order`",
        ),
        (
            Tableau {
                order: u32::MAX,
                ..euler()
            },
            "`order`",
        ),
        (
            Tableau {
                dense_order: u32::MAX,
                ..euler()
            },
            "`dense_order`",
        ),
        (
            Tableau {
                dense_order: 3,
                ..euler()
            },
            "dense output",
        ),
        (
            Tableau {
                error_power: u32::MAX,
                ..euler()
            },
            "`error`",
        ),
        (
            Tableau {
                error: &[0.0; 2],
                ..euler()
            },
            "estimates nothing",
        ),
        (
            Tableau {
                error: &[0.5; 4],
                ..euler()
            },
            "row 0 of `error`",
        ),
        (
            Tableau {
                dense: &[&[0.0; 4]],
                ..euler()
            },
            "row 0 of `dense`",
        ),
        (
            Tableau {
                step_change: (1.0, 0.5),
                ..euler()
            },
            "`step_change`",
        ),
        (
            Tableau {
                smoothing: f64::NAN,
                ..euler()
            },
            "`smoothing`",
        ),
        (
            Tableau {
                stability: Some(-1.0),
                ..euler()
            },
            "`stability`",
        ),
        (
            Tableau {
                a: &[&[], &[1.0], &[0.25, 0.75]],
                ..euler()
            },
            "the condition of order 2 with the tree [[]]: Σ b Φ is 0.75, and must be 0.5",
        ),
    ];
    for (tableau, words) in cases {
        let error = Method::try_new(tableau).unwrap_err().to_string();
        assert!(error.contains(words), "{error} — {words}");
    }
}
