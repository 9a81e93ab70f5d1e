//! Many discs of different sizes and masses that collide and pile up: what holds for all of them, whatever they do. Gaps, energies and momenta are those of discs,
//! written down here.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{ContactEventKind, Machine, Method, Simulation, Solution};

use crate::support::random::SplitMix;

/// Restitution and friction of all contacts.
const RESTITUTION: f64 = 0.8;
const FRICTION: f64 = 0.3;

/// Below which a gap is closed, and a rate is rest, relative to the numbers that it is made of.
const ROUNDING: f64 = 1e-12;

/// Discs of which any two may touch, in a bowl or free.
struct Discs {
    machine: InterpretedMachine,
    radii: Vec<f64>,
    masses: Vec<f64>,
    /// The radius of the bowl.
    bowl: Option<f64>,
    gravity: f64,
}

/// What a state of the discs amounts to.
struct Totals {
    least_gap: f64,
    kinetic: f64,
    potential: f64,
    /// Along x and y, and about the origin.
    momentum: [f64; 3],
    /// The sizes of the terms of these.
    momentum_terms: [f64; 3],
}

impl Discs {
    /// So many discs of random sizes and masses.
    fn new(count: usize, bowl: Option<f64>, restitution: f64, random: &mut SplitMix) -> Discs {
        let gravity = if bowl.is_some() { 9.81 } else { 0.0 };
        let (circle, wall) = match bowl {
            Some(radius) => (
                format!("bowl {{ on: ground, center: (0, 0), radius: {radius} }},"),
                "wall[i in 1..N] { circle: rim[i], inside: bowl, restitution: e, friction: mu },",
            ),
            None => (String::new(), ""),
        };
        let text = format!(
            "machine Discs in plane {{
                constants {{ N = {count} }}
                parameters {{ m[i in 1..N]: kg = 1, r[i in 1..N]: m = 0.05, e: 1 = {restitution}, mu: 1 = {FRICTION}, g: m/s^2 = {gravity} }}
                coordinates {{ x[i in 1..N]: m, y[i in 1..N]: m, theta[i in 1..N]: rad }}
                bodies {{ disc[i in 1..N] {{ mass: m[i], inertia: m[i]*r[i]^2/2, at: (x[i], y[i]), angle: theta[i] }} }}
                circles {{ {circle} rim[i in 1..N] {{ on: disc[i], center: (0, 0), radius: r[i] }} }}
                gravity (0, -g);
                contacts {{ {wall} pair {{ circles: rim, restitution: e, friction: mu }} }}
            }}"
        );
        let machine = InterpretedMachine::from_text(&text).build();
        let mut machine = machine.unwrap_or_else(|error| panic!("{error}"));
        let mut drawn = |name: &str, [from, to]: [f64; 2]| -> Vec<f64> {
            let each = (1..=count).map(|i| {
                let value = random.uniform(from, to);
                machine
                    .set(&format!("{name}[{i}]"), value)
                    .expect("a parameter");
                value
            });
            each.collect()
        };
        let (radii, masses) = (drawn("r", [0.03, 0.06]), drawn("m", [0.02, 0.2]));
        Discs {
            machine,
            radii,
            masses,
            bowl,
            gravity,
        }
    }

    fn totals(&self, q: &[f64], v: &[f64]) -> Totals {
        let n = self.radii.len();
        let mut totals = Totals {
            least_gap: f64::INFINITY,
            kinetic: 0.0,
            potential: 0.0,
            momentum: [0.0; 3],
            momentum_terms: [0.0; 3],
        };
        for i in 0..n {
            let (x, y, m, r) = (q[i], q[n + i], self.masses[i], self.radii[i]);
            let (vx, vy, omega) = (v[i], v[n + i], v[2 * n + i]);
            let inertia = 0.5 * m * r * r;
            totals.kinetic += 0.5 * m * (vx * vx + vy * vy) + 0.5 * inertia * omega * omega;
            totals.potential += m * self.gravity * y;
            let terms = [
                [m * vx, 0.0, 0.0],
                [m * vy, 0.0, 0.0],
                [m * x * vy, -m * y * vx, inertia * omega],
            ];
            for (k, terms) in terms.into_iter().enumerate() {
                totals.momentum[k] += terms.iter().sum::<f64>();
                totals.momentum_terms[k] += terms.iter().map(|term| term.abs()).sum::<f64>();
            }
            let to_bowl = self.bowl.map(|bowl| bowl - r - x.hypot(y));
            let to_others = (0..i).map(|j| {
                let distance = (x - q[j]).hypot(y - q[n + j]);
                distance - r - self.radii[j]
            });
            totals.least_gap = to_others.chain(to_bowl).fold(totals.least_gap, f64::min);
        }
        totals
    }

    /// A run from these coordinates and rates.
    fn run(
        &self,
        (q, v): (Vec<f64>, Vec<f64>),
        until: f64,
        time_step: Option<f64>,
    ) -> Solution<InterpretedMachine> {
        let mut start = self.machine.start();
        (start.q.values, start.v.values) = (q, v);
        let name = if time_step.is_some() {
            "moreau"
        } else {
            "dop853"
        };
        let method = Method::named(name).expect("a method");
        let mut simulation = Simulation::new(&self.machine).method(method).until(until);
        if let Some(step) = time_step {
            simulation = simulation.longest_step(step);
        }
        simulation
            .run(start)
            .unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Places in rows at this distance, each of them moved a little.
fn in_rows(count: usize, distance: f64, random: &mut SplitMix) -> [Vec<f64>; 2] {
    let columns = count.isqrt() + 1;
    let middle = 0.5 * (columns - 1) as f64;
    let mut moved = || 0.15 * distance * random.uniform(-1.0, 1.0);
    let place = |k: usize| {
        let (column, row) = ((k % columns) as f64, (k / columns) as f64);
        (
            distance * (column - middle) + moved(),
            distance * (row - middle) + moved(),
        )
    };
    let (x, y) = (0..count).map(place).unzip();
    [x, y]
}

/// 45 free discs, 990 pairs, that fly through each other: no gap falls below 0, each impact obeys the laws of Newton and Coulomb, energy is lost in impacts only, and
/// momentum and angular momentum stay. Flights are straight lines, which every step follows to rounding.
#[test]
fn free_discs_keep_their_momentum_and_never_gain_energy() {
    const COUNT: usize = 45;
    for seed in [1, 2] {
        let mut random = SplitMix::new(seed);
        let discs = Discs::new(COUNT, None, RESTITUTION, &mut random);
        let [mut q, y] = in_rows(COUNT, 0.2, &mut random);
        q.extend(y);
        q.extend([0.0; COUNT]);
        // Towards the middle, and in any direction.
        let rate = |x: &f64| random.uniform(-0.7, 0.7) - x;
        let mut v: Vec<f64> = q[..2 * COUNT].iter().map(rate).collect();
        v.extend((0..COUNT).map(|_| random.uniform(-10.0, 10.0)));
        let before = discs.totals(&q, &v);
        assert!(before.least_gap > 0.0);
        let run = discs.run((q, v), 1.0, None);
        assert_eq!(run.warnings(), []);

        let mut impacts = 0;
        for event in run.contact_events() {
            let Some(impact) = event.impact else {
                continue;
            };
            assert_eq!(event.kind, ContactEventKind::Impact);
            impacts += 1;
            // Rates are sums of terms of some m/s, and impulses what these take to change.
            let [closing, opening] = impact.gap_rate;
            let [normal, tangential] = impact.impulse;
            assert!(closing < 0.0 && normal > 0.0, "{event:?}");
            let size = 8.0 * ROUNDING;
            assert!((opening + RESTITUTION * closing).abs() <= size, "{event:?}");
            let most = FRICTION * normal;
            assert!(tangential.abs() <= most * (1.0 + size), "{event:?}");
            let slip = impact.slip[1];
            if slip.abs() > size {
                let sliding = tangential + most * slip.signum();
                assert!(sliding.abs() <= size * most, "{event:?}");
            }
        }
        assert!(impacts > COUNT / 2, "{impacts} impacts");
        println!("{impacts} impacts");

        let (mut energy, mut steps) = (before.kinetic, 0);
        for state in run.steps() {
            let now = discs.totals(&state.q.values, &state.v.values);
            steps += 1;
            // Places of up to 1 m, two in each of two directions.
            assert!(now.least_gap >= -4.0 * ROUNDING, "{:e}", now.least_gap);
            // Each step and each impact rounds every rate a few times.
            let rounding = 16.0 * f64::EPSILON * (steps + impacts) as f64;
            assert!(now.kinetic <= energy * (1.0 + rounding), "{}", state.t);
            energy = now.kinetic;
            for k in 0..3 {
                let error = now.momentum[k] - before.momentum[k];
                let most = rounding * (now.momentum_terms[k] + before.momentum_terms[k]);
                assert!(error.abs() <= most, "{k} at {}: {error:e}", state.t);
            }
        }
        let lost: f64 = run.impact_losses().iter().sum();
        let rounding = 16.0 * f64::EPSILON * (steps + impacts) as f64 * before.kinetic;
        let missing = before.kinetic - energy - lost;
        assert!(missing.abs() <= rounding, "{missing:e} of {lost}");
    }
}

/// 50 discs that fall into a bowl, 1275 contacts, by time stepping: after each step none penetrates another beyond rounding, and there is never more energy than at
/// the start.
#[test]
fn a_pile_by_time_stepping_penetrates_nothing_and_gains_no_energy() {
    const COUNT: usize = 50;
    let mut random = SplitMix::new(5);
    let discs = Discs::new(COUNT, Some(1.0), 0.0, &mut random);
    let [mut q, y] = in_rows(COUNT, 0.18, &mut random);
    q.extend(y);
    q.extend([0.0; COUNT]);
    let before = discs.totals(&q, &[0.0; 3 * COUNT]);
    assert!(before.least_gap > 0.0, "{}", before.least_gap);
    let run = discs.run((q, vec![0.0; 3 * COUNT]), 0.5, Some(2e-3));
    let (mut steps, mut has_fallen) = (0, false);
    let size: f64 = discs.masses.iter().sum::<f64>() * discs.gravity;
    for state in run.steps() {
        let now = discs.totals(&state.q.values, &state.v.values);
        steps += 1;
        assert!(
            now.least_gap >= -4.0 * ROUNDING,
            "{:e} at {}",
            now.least_gap,
            state.t
        );
        let gained = now.kinetic + now.potential - before.potential;
        // Heights of up to 1 m, rounded in each step.
        let rounding = 16.0 * f64::EPSILON * size * f64::from(steps);
        assert!(gained <= rounding, "{gained:e} at {}", state.t);
        has_fallen |= now.kinetic < 0.5 * (before.potential - now.potential);
    }
    assert!(steps >= 250 && has_fallen, "impacts have taken half of it");
    let closed = run.closed_contacts(run.end().t);
    assert!(closed.iter().filter(|closed| **closed).count() > COUNT / 2);
}
