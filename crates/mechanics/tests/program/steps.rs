//! The steps of an elimination are what their labels say: pivots, multiples of rows, right-hand sides and solutions, compared with
//! an elimination of `M a = f` in numbers.

use std::collections::{BTreeMap, HashSet};

use lagrangian_program::{Arguments, EliminationStep, Interpreter, Program, Role, Shape};
use lagrangian_scalar::{DoubleDouble, Scalar};

use crate::harness::{machine, smooth_machines};

type Steps = BTreeMap<EliminationStep, DoubleDouble>;

/// A state and the inputs.
struct State {
    q: Vec<DoubleDouble>,
    v: Vec<DoubleDouble>,
    u: Vec<DoubleDouble>,
}

/// The default parameters.
fn parameters(program: &Program) -> Vec<DoubleDouble> {
    let defaults = program.parameters.iter().map(|slot| &slot.default);
    let values = defaults.map(|default| default.as_ref().map_or(1.5, |default| default.value));
    values.map(DoubleDouble::from_f64).collect()
}

/// The results of a function.
fn call(program: &Program, role: Role, state: &State) -> Vec<DoubleDouble> {
    let mut interpreter = Interpreter::new(program, &parameters(program));
    let len = program.function(role).map_or(0, |f| f.shape.len());
    let mut results = vec![DoubleDouble::ZERO; len];
    let arguments = Arguments {
        t: DoubleDouble::from_f64(0.3),
        q: &state.q,
        v: &state.v,
        u: &state.u,
        a: &[],
    };
    let done = interpreter.call(role, arguments, &mut results);
    assert_eq!(done, Ok(()), "{}: {}", program.name, role.name());
    results
}

/// States near the start, no two alike.
fn states(program: &Program) -> Vec<State> {
    let n = program.dimension();
    let mut interpreter = Interpreter::new(program, &parameters(program));
    let mut start = vec![DoubleDouble::ZERO; n];
    interpreter.start(&mut start, &mut vec![DoubleDouble::ZERO; n]);
    let number =
        |k: usize, i: usize| DoubleDouble::from_f64((1.7 * k as f64 + 2.3 * i as f64).sin());
    let state = |k: usize| State {
        q: (0..n)
            .map(|i| start[i] + number(k, i) * DoubleDouble::from_f64(0.2))
            .collect(),
        v: (0..n).map(|i| number(k, n + i)).collect(),
        u: vec![DoubleDouble::from_f64(0.7); program.inputs.len()],
    };
    (1..=3).map(state).collect()
}

/// The values of the accelerations that have a label.
fn labelled(program: &Program, state: &State) -> Steps {
    let mut only = program.clone();
    let accelerations = only
        .functions
        .iter_mut()
        .find(|f| f.role == Role::Accelerations);
    let accelerations = accelerations.expect("every machine has them");
    let steps = accelerations.steps.clone();
    accelerations.results = steps.iter().map(|(value, _)| *value).collect();
    accelerations.shape = Shape::Vector(steps.len());
    let values = call(&only, Role::Accelerations, state);
    steps.iter().map(|(_, step)| *step).zip(values).collect()
}

/// `M = L D Lᵀ` and `M a = f` by the formulas of the documentation, in this order of the rows.
fn eliminated(program: &Program, state: &State, order: &[usize]) -> Steps {
    let m = call(program, Role::MassMatrix, state);
    let f = call(program, Role::Forces, state);
    let n = order.len();
    let zero = DoubleDouble::ZERO;
    let (mut l, mut d) = (vec![vec![zero; n]; n], vec![zero; n]);
    let (mut z, mut a) = (vec![zero; n], vec![zero; n]);
    let mut steps = Steps::new();
    for (place, &j) in order.iter().enumerate() {
        let before = &order[..place];
        let reduced = |i: usize| {
            let products = before.iter().map(|&k| l[i][k] * l[j][k] * d[k]);
            products.fold(m[Shape::index(i, j)], |sum, product| sum - product)
        };
        let column: Vec<(usize, DoubleDouble)> =
            order[place..].iter().map(|&i| (i, reduced(i))).collect();
        d[j] = column[0].1;
        z[j] = before.iter().fold(f[j], |sum, &k| sum - l[j][k] * z[k]);
        for &(i, u) in &column[1..] {
            let x = u / d[j];
            l[i][j] = x;
            steps.insert(EliminationStep::Factor(i, j), x);
        }
    }
    for (place, &i) in order.iter().enumerate().rev() {
        let later = &order[place + 1..];
        a[i] = later
            .iter()
            .fold(z[i] / d[i], |sum, &k| sum - l[k][i] * a[k]);
        steps.insert(EliminationStep::Solution(i), a[i]);
        steps.insert(EliminationStep::Load(i), z[i]);
        steps.insert(EliminationStep::Pivot(i), d[i]);
        steps.insert(EliminationStep::Inertia(i), d[i]);
    }
    steps
}

/// All orders of some rows.
fn orders(rows: &[usize]) -> Vec<Vec<usize>> {
    if rows.is_empty() {
        return vec![Vec::new()];
    }
    let each = rows.iter().flat_map(|&last| {
        let others: Vec<usize> = rows.iter().copied().filter(|row| *row != last).collect();
        orders(&others).into_iter().map(move |mut order| {
            order.push(last);
            order
        })
    });
    each.collect()
}

/// The labels whose values are not those of an elimination in this order, up to a factor that is the same at all states.
fn wrong(program: &Program, states: &[State], order: &[usize]) -> Vec<EliminationStep> {
    let all: Vec<[Steps; 2]> = states
        .iter()
        .map(|state| [labelled(program, state), eliminated(program, state, order)])
        .collect();
    // The velocities that couplings and loads along the machine refer to are not all those of coordinates.
    let is_tested = |step: &&EliminationStep| {
        !matches!(
            step,
            EliminationStep::Coupling(_) | EliminationStep::Free(_)
        )
    };
    let steps = all[0][0].keys().filter(is_tested);
    let is_wrong = |step: &&EliminationStep| {
        // A factor of a row that this order eliminates later has no true value.
        let ratio =
            |[label, truth]: &[Steps; 2]| truth.get(*step).map(|truth| label[*step] / *truth);
        let Some(ratios) = all.iter().map(ratio).collect::<Option<Vec<DoubleDouble>>>() else {
            return true;
        };
        // Double-doubles have 32 digits; eliminations of a few rows lose fewer than 12 of them.
        let tolerance = 1e-20 * ratios[0].to_f64().abs();
        let error = |x: &DoubleDouble| (*x - ratios[0]).to_f64().abs();
        !ratios.iter().all(|x| error(x) <= tolerance)
    };
    steps.filter(is_wrong).copied().collect()
}

#[test]
fn steps_are_what_their_labels_say() {
    let (mut machines, mut kinds) = (0, HashSet::new());
    for name in smooth_machines() {
        machine(&name, &[], |compiled| {
            let program: &Program = &compiled.program;
            let is_plain = program.constraints.is_empty() && program.unilateral.is_empty();
            let choice = program.choice(Role::Accelerations);
            let is_reduced = choice.is_some_and(|choice| choice.chosen().form.reduced);
            if !is_plain || is_reduced || program.dimension() > 5 || !program.quaternions.is_empty()
            {
                return;
            }
            let Some(accelerations) = program.function(Role::Accelerations) else {
                return;
            };
            if accelerations.steps.is_empty() {
                return;
            }
            let rows: Vec<usize> = (0..program.dimension()).collect();
            let states = states(program);
            let wrong = orders(&rows)
                .into_iter()
                .map(|order| wrong(program, &states, &order));
            let least = wrong.min_by_key(Vec::len).expect("there is an order");
            assert_eq!(least, [], "{name}: {:?}", accelerations.steps);
            machines += 1;
            for (_, step) in &accelerations.steps {
                kinds.insert(std::mem::discriminant(step));
            }
        });
    }
    println!("{machines} machines");
    assert!(machines >= 6, "{machines} machines");
    assert!(kinds.len() >= 4, "{kinds:?}");
}
