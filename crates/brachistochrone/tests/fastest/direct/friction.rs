//! Strong friction: the search follows the motion without friction while friction is added. The closed form is the reference.
use super::{G, Polar, Wire, close};
use lagrangian_brachistochrone::direct::{Outcome, Search, Start, Terrain};
use lagrangian_brachistochrone::{Brachistochrone, Problem, Unsolved};
use lagrangian_scalar::Scalar;

use crate::terrains::Any;

/// The closed form (Ashby's curve) from (0, 0).
fn closed(friction: f64, to: [f64; 2]) -> Brachistochrone {
    let mass = [vec![1.0, 0.0], vec![0.0, 1.0]];
    let skew = [vec![0.0, -friction], vec![friction, 0.0]];
    Problem::new(&mass, &[0.0, -G])
        .and_then(|wire| wire.with_friction(&[friction * G, 0.0], &skew))
        .and_then(|wire| wire.solve(&[0.0, 0.0], &to))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The wire in polar coordinates, with its ends; the path does not go round the centre.
fn polar(friction: f64, to: [f64; 2], centre: [f64; 2]) -> (Polar, [f64; 2], [f64; 2]) {
    let wire = Wire { friction };
    let polar = Polar { wire, centre };
    let (from, mut end) = (polar.of(0.0, 0.0), polar.of(to[0], to[1]));
    let turn = std::f64::consts::TAU;
    end[1] += ((from[1] - end[1]) / turn).round() * turn;
    (polar, from, end)
}

/// Of 182 random wires, these are the ones that no start solved without this continuation.
const ROUGH: [(f64, [f64; 2], [f64; 2]); 3] = [
    (
        1.087,
        [0.5495279137413522, 1.7318035410245118],
        [-2.799938530742315, 2.9486150028661156],
    ),
    (
        0.983,
        [1.1271756048304464, 1.4090972484499507],
        [-0.7762770022835519, 0.336972747926759],
    ),
    (
        0.901,
        [0.7090183343849854, 0.7542475311861618],
        [-2.1405617169629316, -1.51252461807651],
    ),
];

#[test]
fn friction_that_is_added_in_steps_leads_to_the_closed_form() {
    let mut alone = 0;
    for (friction, to, centre) in ROUGH {
        let (polar, from, end) = polar(friction, to, centre);
        let found = Search::new().solve(Any::from(polar), &from, &end);
        let found = found.unwrap_or_else(|error| panic!("{friction}, {to:?}: {error}"));
        let followed = found.trials().iter().find_map(|trial| match trial.start {
            Start::Frictionless { time: Some(time) } => Some((time, trial)),
            _ => None,
        });
        let Some((time, trial)) = followed else {
            panic!("{friction}, {to:?}: {:?}", found.trials());
        };
        match trial.outcome {
            Outcome::Found { .. } => alone += 1,
            Outcome::Same { .. } => {}
            _ => panic!("{friction}, {to:?}: {trial}"),
        }
        // On eight intervals the start is accurate to a few digits.
        close("without friction", time, closed(0.0, to).time(), 1e-5);
        let time = closed(friction, to).time();
        // The search accepts a result that the last halving of its intervals changes by less than a millionth.
        close("with friction", found.time(), time, 1e-6);
        assert!((found.time() - time).abs() <= found.change(), "{friction}");
    }
    assert!(alone > 0, "other starts led to all of them");
}

/// If friction exceeds the limit up to which a smooth motion is the fastest, the error reports how far the continuation came, which
/// is not beyond the limit of the closed form.
#[test]
fn too_much_friction_is_told_with_what_was_reached() {
    let to = [1.0, 1.0];
    let (polar, from, end) = polar(2.0, to, [2.0, -1.0]);
    let error = Search::new().solve(Any::from(polar), &from, &end);
    let error = error.map(|found| found.time()).expect_err("a motion");
    let Unsolved::NotFound { tried } = &error else {
        panic!("{error}");
    };
    let lost = tried.iter().find_map(|trial| match trial {
        trial if !matches!(trial.start, Start::Frictionless { .. }) => None,
        trial => match trial.outcome {
            Outcome::Lost { part } => Some(part),
            _ => None,
        },
    });
    let lost = lost.unwrap_or_else(|| panic!("{error}"));
    // Motions end where κ tan(δ/2) = 1, which bisection finds.
    let is_there = |share: f64| {
        let friction = 2.0 * share;
        let mass = [vec![1.0, 0.0], vec![0.0, 1.0]];
        let skew = [vec![0.0, -friction], vec![friction, 0.0]];
        let wire = Problem::new(&mass, &[0.0, -G])
            .and_then(|wire| wire.with_friction(&[friction * G, 0.0], &skew));
        wire.is_ok_and(|wire| wire.solve(&[0.0, 0.0], &to).is_ok())
    };
    let [mut low, mut high] = [0.0, 1.0];
    assert!(is_there(low) && !is_there(high));
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if is_there(middle) {
            low = middle
        } else {
            high = middle
        }
    }
    println!("lost at {lost}, {low} is the greatest share");
    assert!(lost <= low && lost > 0.5 * low, "{lost} of {low}");
    let text = error.to_string();
    let said = "with friction added in steps: lost at";
    assert!(text.contains(said), "{text}");
}

/// A wire whose friction is not known apart.
#[derive(Clone, Debug)]
pub struct Whole(Polar);

impl Terrain for Whole {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        self.0.inertia(q)
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        self.0.resistance(q, v)
    }
}

/// Without a separate friction term there is no continuation, and the search proceeds as without it.
#[test]
fn friction_that_is_not_known_apart_is_not_taken_away() {
    let (friction, to, centre) = ROUGH[0];
    let (polar, from, end) = polar(friction, to, centre);
    let found = Search::new()
        .budget(400_000)
        .solve(Any::from(Whole(polar)), &from, &end);
    let tried = match &found {
        Ok(found) => found.trials(),
        Err(Unsolved::NotFound { tried }) => tried,
        Err(error) => panic!("{error}"),
    };
    let followed = |start: &Start| matches!(start, Start::Frictionless { .. });
    assert!(
        tried.iter().all(|trial| !followed(&trial.start)),
        "{tried:?}"
    );
}
