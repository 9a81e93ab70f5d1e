//! Guides beside contacts by the laws `poisson` and `stronge`, whose impulses go along a path: closed forms, springs that become ever stiffer, and energy.

use crate::support::random::SplitMix;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{ContactEventKind, ContactTrouble, Error, Solution};

use super::guides_and_contacts::{
    BLOCK_AND_STOP, OBLIQUE, PENDULUM_AND_WALL, assert_near, machine, never_gains_energy, q, run,
    run_to, v,
};

fn impact(run: &Solution<InterpretedMachine>, name: &str) -> lagrangian::ContactImpact {
    let mut own = run.contact_events().iter();
    let own = own.find(|event| event.contact == name && event.impact.is_some());
    own.and_then(|event| event.impact).expect("an impact")
}

/// A block on a rail hits a wall that stands obliquely. Slip and gap change in proportion: in compression the rail brakes with `μ |cos β|` of the impulse P on the wall, and in expansion it resists
/// the slip back. With `s = sin β` and `c = μ |cos β|`
///
/// ```text
/// m v = P_c (s + c),    m v⁺ = −P_e (s − c)
/// ```
///
/// with `P_e = e P_c` by Poisson's law, and by Stronge's `P_e v⁺ = −e² P_c v`, so that `v⁺ = −e v √((s − c)/(s + c))`. The rail takes `N = −P cos β`.
#[test]
fn an_oblique_wall_loads_the_rail_along_a_path() {
    let (m, mu, e) = (2.0, 0.2, 0.7);
    for slope in [1.2_f64, 2.0, 2.6] {
        for law in ["poisson", "stronge"] {
            let text = OBLIQUE.replace("LAW", &format!(", law: {law}"));
            let run = run(&machine(&text, &[("slope", slope)]), 0.5);
            let v1 = (9.0 - 2.0 * mu * 9.81_f64).sqrt();
            let (sin, cos) = slope.sin_cos();
            let (braking, pushing) = (sin + mu * cos.abs(), sin - mu * cos.abs());
            let compression = m * v1 / braking;
            let expansion = match law {
                "poisson" => e * compression,
                _ => e * compression * (braking / pushing).sqrt(),
            };
            let after = -expansion * pushing / m;
            let (wall, rail) = (impact(&run, "stop"), impact(&run, "rail"));
            let both = compression + expansion;
            assert_near(wall.impulse[0], both, 1e-11 * both);
            assert_near(rail.impulse[0], -both * cos, 1e-11 * both);
            let rubbed = mu * cos.abs() * (expansion - compression);
            assert_near(rail.impulse[1], rubbed, 1e-11 * both);
            assert_near(rail.slip[0], v1, 1e-11);
            assert_near(rail.slip[1], after, 1e-11);
            assert_eq!(rail.gap_rate, [0.0; 2]);
            let lost = 0.5 * m * (v1 * v1 - after * after);
            assert_near(wall.loss + rail.loss, lost, 1e-11 * lost);
        }
    }
}

/// The impact of a rigid contact that loses nothing along its normal is the limit of that with a spring that becomes ever stiffer: the cart sticks, slips, reverses and is pressed to either side on
/// its rail meanwhile, and the bob rubs on the wall. The spring takes a time of `π √(m/k)`, in which other forces act and the machine moves.
#[test]
fn an_impact_by_stronges_law_is_that_of_a_stiff_spring() {
    let head = PENDULUM_AND_WALL.replace("phi0: rad", "k: N/m = 1e8, d: N*s/m = 0, phi0: rad");
    let friction = ", slip: dot(der(bob.at), (-sin(b), cos(b))), friction: mu2";
    let head = head.replace("mu: 1 = 0.2,", "mu: 1 = 0.2, mu2: 1 = 0.3,");
    let rigid = head.replace("LAW", &format!("{friction}, law: stronge"));
    let yielding = head
        .replace("restitution: e", "compliance: linear(k, d)")
        .replace("LAW", friction);
    let mut random = SplitMix::new(17);
    let (mut sums, mut met, mut stuck) = ([0.0; 2], 0, 0);
    for case in 0..16 {
        let b = random.uniform(-0.9, 0.9);
        let settings = [
            ("M", random.uniform(0.5, 3.0)),
            ("b", b),
            ("mu", random.uniform(0.1, 0.7)),
            ("mu2", [0.0, random.uniform(0.1, 0.5)][case % 2]),
            ("phi0", random.uniform(-1.5, 0.2).min(b + 0.4)),
            ("v0", random.uniform(-1.0, 2.0)),
            ("e", 1.0),
        ];
        let exact = run_to(&machine(&rigid, &settings), 1.0).expect("it runs");
        let Some(hit) = (exact.contact_events().iter())
            .find(|event| event.contact == "wall" && event.kind == ContactEventKind::Impact)
        else {
            continue;
        };
        met += 1;
        let slip = impact(&exact, "rail").slip;
        stuck += usize::from(slip[1].abs() < 1e-12);
        for (k, sum) in [1e8, 1e10].into_iter().zip(&mut sums) {
            let mut settings = settings.to_vec();
            settings.push(("k", k));
            let soft = run_to(&machine(&yielding, &settings), 1.0).expect("it runs");
            let opens = (soft.contact_events().iter())
                .find(|event| event.contact == "wall" && event.kind == ContactEventKind::Opens)
                .expect("it opens");
            let mut error = 0.0_f64;
            for name in ["x", "phi"] {
                error = error.max((v(&opens.state, name) - v(&hit.state, name)).abs());
                error = error.max((q(&opens.state, name) - q(&hit.state, name)).abs());
            }
            // Rates change by less than 300 m/s² and rad/s² in the time of the spring, of a mass of at most 1 kg.
            let bound = 300.0 * std::f64::consts::PI / k.sqrt();
            assert!(error <= bound, "{error:e} of {bound:e} {settings:?}");
            *sum += error;
        }
    }
    println!("{sums:?} {met} {stuck}");
    assert!(met >= 8 && sums[1] < 0.2 * sums[0], "{met}: {sums:?}");
}

/// No impact by these laws creates energy, and all losses are booked.
#[test]
fn random_carts_never_gain_energy_along_paths() {
    let mut random = SplitMix::new(23);
    let mut impacts = 0;
    for case in 0..16 {
        let law = [
            ", law: stronge",
            ", slip: dot(der(bob.at), (-sin(b), cos(b))), friction: 0.3, law: stronge",
            ", law: poisson",
            ", slip: dot(der(bob.at), (-sin(b), cos(b))), friction: 0.3, law: poisson",
        ][case % 4];
        let b = random.uniform(-0.9, 0.9);
        let settings = [
            ("M", random.uniform(0.5, 3.0)),
            ("b", b),
            ("mu", random.uniform(0.0, 0.7)),
            ("phi0", random.uniform(-1.5, 0.2).min(b + 0.4)),
            ("v0", random.uniform(-1.0, 2.0)),
            ("e", random.uniform(0.0, 1.0)),
        ];
        impacts += never_gains_energy(&PENDULUM_AND_WALL.replace("LAW", law), &settings, 3.0);
    }
    assert!(impacts > 16, "{impacts}");
}

/// Two stops that a block hits at once have no path, as without a guide.
#[test]
fn several_contacts_that_meet_at_once_are_refused() {
    let text = BLOCK_AND_STOP.replace(
        "stop { gap: L - x, restitution: e }",
        "stop { gap: L - x, restitution: e, law: stronge }, other { gap: L - x, restitution: e, law: stronge }",
    );
    let result = run_to(&machine(&text, &[]), 1.0);
    let Err(Error::Contact {
        trouble: ContactTrouble::SeveralAtOnce,
        ..
    }) = result
    else {
        panic!("{:?}", result.map(|run| run.end().t));
    };
}
