//! Accelerations evaluated in stages, in emitted code and interpreted, equal those
//! evaluated at once up to rounding.

use lagrangian::{Batch, Lanes, Machine, Staged, System, Vector};

lagrangian::machine! {
    machine Crusher extends "../../machines/crusher9.machine" { stages { time, coordinates } }
}

lagrangian::machine! {
    machine Arm extends "../../machines/two_joint_arm.machine" { stages { coordinates } }
}

lagrangian::machine! {
    machine Shaken extends "../../machines/kapitza_pendulum.machine" { stages { time } }
}

lagrangian::machine! {
    machine Train extends "../../machines/spring_mass_train.machine" { stages { coordinates, time } }
}

lagrangian::machine! {
    /// Long enough that its stages are split into several functions.
    machine Chain extends "../../machines/chain_relative.machine" {
        constants { N = 24 }
        stages { time, coordinates }
    }
}

/// The bound on the difference that rounding of every operation may cause: a few hundred roundings
/// of 2⁻⁵³, of numbers a hundred times as large as their sums.
const ROUNDING: f64 = 1e4 * f64::EPSILON;

/// Compares evaluation in stages with evaluation at once, with rates that change while coordinates
/// and time stay, and coordinates that change while the time stays.
fn check<M: Machine>(machine: &M, seed: usize)
where
    M::System: Staged,
{
    let system = machine.prepare();
    let u = system.default_inputs();
    let start = machine.start();
    let number = |i: usize| 0.1 + (((seed + 13 * i) * 7919) % 101) as f64 / 97.0;
    let (mut q, mut v) = (system.to_vector(&start.q), system.to_vector(&start.v));
    let (mut found, mut expected) = (v.clone(), v.clone());
    let mut compared = 0;
    for moment in 0..3 {
        let t = number(moment);
        let at_time = system.at_time(t);
        for place in 0..3 {
            let numbers = q.as_mut_slice().iter_mut().enumerate();
            numbers.for_each(|(i, x)| *x = number(5 * i + place + moment));
            let Ok(at) = system.at_position(&at_time, &q) else {
                panic!("{}: there are accelerations", machine.name());
            };
            for pace in 0..3 {
                let numbers = v.as_mut_slice().iter_mut().enumerate();
                numbers.for_each(|(i, x)| *x = number(3 * i + 7 * pace + place) - 0.5);
                let in_stages = system.accelerations_at(&at, &v, &u, &mut found);
                let at_once = system.accelerations(t, &q, &v, &u, &mut expected);
                assert_eq!((in_stages, at_once), (Ok(()), Ok(())), "{}", machine.name());
                let (found, expected) = (found.as_slice(), expected.as_slice());
                let scale = expected.iter().fold(1.0_f64, |scale, a| scale.max(a.abs()));
                for (found, expected) in found.iter().zip(expected) {
                    let error = (found - expected).abs();
                    assert!(
                        error <= ROUNDING * scale,
                        "{}: {found} and {expected}",
                        machine.name()
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared >= 27);
}

#[test]
fn emitted_machines_accelerate_in_stages_as_at_once() {
    for seed in 0..5 {
        check(&Crusher::default(), seed);
        check(&Arm::default(), seed);
        check(&Shaken::default(), seed);
        check(&Train::default(), seed);
        check(&Chain::default(), seed);
    }
}

/// Lanes at a common time share the work of the time stage, and each equals
/// the system alone, bit for bit.
#[test]
fn lanes_share_a_time() {
    let system = Crusher::default().prepare();
    let lengths = [0.11, 0.12, 0.13, 0.17];
    let q = |s: f64| [0.01, -0.02, 0.03, s, 0.4, 0.5, 0.12, 1.3, -0.6];
    let v = |s: f64| [0.3, 0.1, -0.2, 10.0 * s, 2.0, -1.0, 0.4, 3.0, s];
    let at_time = crusher::at_time(&system, 0.37);
    let several: Batch<_, 4> = Batch::of(&system);
    let (many_q, many_v) = (lengths.map(q), lengths.map(v));
    let at = crusher::at_position(
        several.equations(),
        &at_time.map(Lanes::splat),
        &several.vectors(many_q.each_ref()),
    )
    .expect("the mortar is somewhere");
    let together = crusher::accelerations_at(
        several.equations(),
        &at,
        &several.vectors(many_v.each_ref()),
    );
    for (lane, length) in lengths.into_iter().enumerate() {
        let at = crusher::at_position(&system, &at_time, &q(length)).expect("the same");
        let alone = crusher::accelerations_at(&system, &at, &v(length));
        let lane: Vec<u64> = together.iter().map(|row| row[lane].to_bits()).collect();
        assert_eq!(lane, alone.map(f64::to_bits));
    }
}

/// A pose without accelerations is refused when the coordinates are set, before any rates are given.
#[test]
fn singular_poses_are_refused_with_the_coordinates() {
    let system = Crusher::default().prepare();
    let mut q = system.to_vector(&Crusher::default().start().q);
    let at_time = system.at_time(0.0);
    assert!(system.at_position(&at_time, &q).is_ok());
    q[3] = 0.0;
    let refused = system.at_position(&at_time, &q).expect_err("s1 = 0");
    let (v, u) = ([0.5; 9], system.default_inputs());
    let mut a = [0.0; 9];
    let at_once = system.accelerations(0.0, &q, &v, &u, &mut a);
    assert_eq!(at_once.expect_err("the same").at, refused.at);
}

/// The interpreter gives the same bits as compiled machines; a machine whose spec requests no stages
/// is evaluated at once.
#[test]
fn interpreted_stages_are_those_that_are_compiled() {
    let interpreted = |asked: &str| match asked {
        "" => crate::support::library::interpreted("crusher9"),
        _ => crate::support::library::machine(&format!(
            "machine Crusher extends \"crusher9.machine\" {{ {asked} }}"
        )),
    };
    let compiled = Crusher::default().prepare();
    let (q, v) = ([0.15; 9], [0.7; 9]);
    let mut expected = [0.0; 9];
    let at = compiled.at_position(&compiled.at_time(0.37), &q);
    let at = at.expect("the mortar is somewhere");
    let u = compiled.default_inputs();
    compiled
        .accelerations_at(&at, &v, &u, &mut expected)
        .expect("it has accelerations");
    let bits = |a: &[f64]| a.iter().map(|a| a.to_bits()).collect::<Vec<_>>();
    for asked in [
        "stages { time, coordinates }",
        "stages { time }",
        "stages { coordinates }",
        "",
    ] {
        let machine = interpreted(asked);
        check(&machine, 3);
        let system = machine.prepare();
        let mut a = vec![0.0; 9];
        let at = system.at_position(&system.at_time(0.37), &q.to_vec());
        let at = at.expect("the mortar is somewhere");
        let u = system.default_inputs();
        system
            .accelerations_at(&at, &v.to_vec(), &u, &mut a)
            .expect("it has accelerations");
        if asked == "stages { time, coordinates }" {
            assert_eq!(bits(&a), bits(&expected));
        }
        if asked.is_empty() {
            let mut at_once = vec![0.0; 9];
            let called = system.accelerations(0.37, &q.to_vec(), &v.to_vec(), &u, &mut at_once);
            assert_eq!(called, Ok(()));
            assert_eq!(bits(&a), bits(&at_once));
        }
    }
}
