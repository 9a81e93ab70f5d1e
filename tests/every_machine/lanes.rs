//! Several systems at once: each lane equals the system alone, bit for bit, whatever the other lanes hold.

use crate::support::sampling::{Random, Sample};
use crate::support::states::vector;
use lagrangian::{Batch, Batched, Lanes, Machine, Number, Singular, SomeSingular, System, Vector};

/// Values in neighbouring lanes that must not affect a lane.
const HOSTILE: [f64; 6] = [f64::NAN, f64::INFINITY, -1e300, 1e22, 5e-324, -0.0];

/// Compares lanes with systems alone, with other parameters and states in every lane, some of them absurd. Returns
/// how many had no accelerations.
fn check<M: Machine, const N: usize>(name: &str, machines: [M; N], random: &mut Random<M>) -> usize
where
    Lanes<N>: Number,
    M::System: Batched<N>,
{
    let systems = machines.map(|machine| machine.prepare());
    let several = Batch::new(systems.each_ref());
    let u = several.default_inputs(&systems[0]);
    let (mut compared, mut stopped) = (0, 0);
    for round in 0..50 {
        let mut samples: [Sample; N] = std::array::from_fn(|_| random.sample());
        // From the second round on, one lane is filled with hostile values; in every third
        // round all lanes but one are.
        for lane in 0..N {
            if round > 0 && (lane == round % N) != (round % 3 == 0) {
                let absurd = HOSTILE[(round + lane) % HOSTILE.len()];
                match round % 4 {
                    0 => samples[lane].q.fill(absurd),
                    1 => samples[lane].v.fill(absurd),
                    2 => samples[lane].t = absurd,
                    _ => samples[lane].q[0] = absurd,
                }
            }
        }
        let q: [<M::System as System>::Vector; N] =
            samples.each_ref().map(|at| vector::<M::System>(&at.q));
        let v: [<M::System as System>::Vector; N] =
            samples.each_ref().map(|at| vector::<M::System>(&at.v));
        let t = Lanes(samples.each_ref().map(|at| at.t));
        let mut found = several.vectors(q.each_ref());
        let is_whole = several.accelerations(
            t,
            &several.vectors(q.each_ref()),
            &several.vectors(v.each_ref()),
            &u,
            &mut found,
        );
        let refused = match is_whole {
            Ok(()) => [None; N],
            Err(SomeSingular { lanes }) => lanes,
        };
        for lane in 0..N {
            let system = &systems[lane];
            let mut alone = q[lane].zeros_like();
            let (t, u) = (samples[lane].t, system.default_inputs());
            let is_defined = system.accelerations(t, &q[lane], &v[lane], &u, &mut alone);
            let row: Vec<f64> = found.as_ref().iter().map(|numbers| numbers[lane]).collect();
            let at = format!("{name}, lane {lane} of {N}, {:?}", samples[lane]);
            // Where the system alone refuses, its lane reports the same error. The comparison is by text, because NaN
            // is not equal to itself.
            let said = |singular: Option<Singular>| format!("{singular:?}");
            assert_eq!(said(refused[lane]), said(is_defined.err()), "{at}");
            if is_defined.is_err() {
                stopped += 1;
                assert!(row.iter().all(|x| x.is_nan()), "{at}: {row:?}");
                continue;
            }
            compared += 1;
            for (found, alone) in row.iter().zip(alone.as_slice()) {
                let is_same = found.to_bits() == alone.to_bits()
                    // The sign and the payload of a NaN mean nothing.
                    || found.is_nan() && alone.is_nan();
                assert!(is_same, "{at}: {row:?} instead of {alone:?}");
            }
        }
    }
    // In each round at least one lane holds ordinary values.
    assert!(compared >= 50, "{name}: {compared}");
    stopped
}

macro_rules! check_machine {
    ($machine:ident, $name:literal, $($lanes:literal)*) => {{
        use lagrangian_machines::$machine;
        let mut random = Random::new(&$machine::default(), 20_260_004);
        // Each lane has parameters of its own, all near those of the spec.
        let machine = |lane: usize| {
            let factor = 1.0 + lane as f64 / 64.0;
            $machine::default().map(|x| x * factor)
        };
        0 $(+ check::<_, $lanes>($name, std::array::from_fn(machine), &mut random))*
    }};
}

#[test]
fn a_lane_is_the_system_alone_in_every_machine_of_the_library() {
    let mut stopped = 0;
    macro_rules! four {
        ($machine:ident, $name:literal) => {
            stopped += check_machine!($machine, $name, 4);
        };
    }
    crate::for_each_machine!(four);
    // Undefined coordinates leave no valid pivot in any machine that checks pivots, so the lanes
    // beside them have been compared.
    assert!(stopped >= 200, "{stopped}");
}

/// Each machine takes long to compile for each width, so a few stand for the others, which do not differ in anything
/// that depends on the width. (The tests of `native` cover every operation in every width.)
#[test]
fn there_may_be_two_or_eight_lanes() {
    let stopped = check_machine!(CartPole, "cart_pole", 2 8);
    assert!(stopped > 0);
    let stopped = check_machine!(VibratingCrusher, "vibrating_crusher", 2 8);
    assert!(stopped > 0);
}

/// Without mass there are no accelerations: that lane reports it, and the other lane goes on.
#[test]
fn a_system_without_accelerations_is_undefined_in_its_lane_only() {
    use lagrangian_machines::CartPole;
    let broken = CartPole {
        cart: 0.0,
        pole: 0.0,
        ..Default::default()
    };
    let systems = [CartPole::default().prepare(), broken.prepare()];
    let two = Batch::new(systems.each_ref());
    let (q, v) = ([0.1, 0.2], [0.3, 0.4]);
    let mut a = [Lanes::splat(0.0); 2];
    let refused = two.accelerations(
        Lanes::splat(0.0),
        &q.map(Lanes::splat),
        &v.map(Lanes::splat),
        &two.default_inputs(&systems[0]),
        &mut a,
    );
    let mut alone = [0.0; 2];
    let u = systems[0].default_inputs();
    let mut at =
        |system: &<CartPole as Machine>::System| system.accelerations(0.0, &q, &v, &u, &mut alone);
    let singular = at(&systems[1]).expect_err("it has no mass");
    at(&systems[0]).expect("it has mass");
    assert_eq!(a.map(|row| row[0]), alone);
    assert!(a.iter().all(|row| row[1].is_nan()));
    let lanes = [None, Some(singular)];
    assert_eq!(refused, Err(SomeSingular { lanes }));
    assert!(refused.is_err_and(|e| e.to_string().starts_with("lane 1: the mass matrix")));
}

/// The angle of a polar coordinate is undefined at radius 0. The crusher's code does not divide by the pivot of that
/// angle: it only checks it.
#[test]
fn a_pose_without_accelerations_is_refused_though_nothing_is_divided_by_its_pivot() {
    use lagrangian_machines::Crusher9;
    let system = Crusher9::default().prepare();
    let four = Batch::of(&system);
    let v = [0.1; 9];
    let poses: [[f64; 9]; 4] = std::array::from_fn(|lane| {
        let mut q = Crusher9::default().start().q.to_array();
        q[6] = if lane == 2 { 0.0 } else { q[6] };
        q[1] = lane as f64;
        q
    });
    let mut a = four.vectors(poses.each_ref());
    let refused = four.accelerations(
        Lanes::splat(0.25),
        &four.vectors(poses.each_ref()),
        &four.vectors([&v; 4]),
        &four.default_inputs(&system),
        &mut a,
    );
    for (lane, q) in poses.iter().enumerate() {
        let mut alone = [0.0; 9];
        let result = system.accelerations(0.25, q, &v, &system.default_inputs(), &mut alone);
        let row = a.map(|row| row[lane]);
        match result {
            Ok(()) => assert_eq!(
                row.map(f64::to_bits),
                alone.map(f64::to_bits),
                "lane {lane}"
            ),
            Err(singular) => {
                assert_eq!(lane, 2);
                assert_eq!(refused.map_err(|e| e.lanes[2]), Err(Some(singular)));
                assert!(row.iter().all(|x| x.is_nan()), "{row:?}");
            }
        }
    }
    assert!(refused.is_err());
}
