//! Compares random machines with equivalent descriptions of themselves, and with a numerical evaluation that shares nothing
//! with the compiler but its arithmetic.
//!
//! Every run takes a new seed and prints it. `METAMORPHIC_SEED=… METAMORPHIC_MACHINE=…` repeats one machine of that seed, and
//! `METAMORPHIC_COUNT` sets the number of machines.
#![allow(
    clippy::needless_range_loop,
    clippy::type_complexity,
    reason = "sums over i and j read like the formulas"
)]
#![allow(
    clippy::too_many_lines,
    reason = "what is drawn, written or evaluated for each kind stands in one place"
)]

#[path = "../../../jit/tests/agreement/check.rs"]
mod check;
mod commands;
mod evaluation;
mod generate;
mod jet;
mod machine;
#[path = "../../../crates/mechanics/tests/mechanics/random_machines/random.rs"]
mod random;
mod rewrite;
mod simulation;
mod text;
mod truth;
mod turns;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use random::Random;

/// The number of random machines in a run.
const MACHINES: usize = 800;
/// The numbers of machines that are simulated, and whose modes are computed.
const RUNS: usize = 200;
const MODES: usize = 60;
/// The number of solids with two descriptions of their rotation, and of surfaces in two frames.
const TURNS: usize = 60;

/// The result of one task: how many times each feature occurred, and the failures.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) counts: BTreeMap<String, usize>,
    pub(crate) failures: Vec<String>,
}

impl Tally {
    pub(crate) fn count(&mut self, what: impl Into<String>) {
        *self.counts.entry(what.into()).or_default() += 1;
    }

    fn add(&mut self, other: Tally) {
        for (what, count) in other.counts {
            *self.counts.entry(what).or_default() += count;
        }
        self.failures.extend(other.failures);
    }
}

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|text| text.parse().ok())
}

/// The seed of this run.
fn seed() -> u64 {
    static SEED: OnceLock<u64> = OnceLock::new();
    *SEED.get_or_init(|| {
        let clock = || SystemTime::now().duration_since(UNIX_EPOCH);
        let by_clock = || clock().map_or(1, |time| time.as_nanos() as u64 % 1_000_000_007);
        variable("METAMORPHIC_SEED").unwrap_or_else(by_clock)
    })
}

/// Runs the tasks on as many threads as there are processors, and prints their results.
fn each(name: &str, count: usize, task: impl Fn(Random, usize, &mut Tally) + Sync) -> Tally {
    let (seed, only) = (seed(), variable("METAMORPHIC_MACHINE"));
    let count = variable("METAMORPHIC_COUNT").map_or(count, |count| count as usize);
    println!("{name}: METAMORPHIC_SEED={seed}");
    let (next, total) = (AtomicUsize::new(0), Mutex::new(Tally::default()));
    let start = Instant::now();
    let work = || {
        let mut own = Tally::default();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count {
                break;
            }
            if only.is_some_and(|only| only != number as u64) {
                continue;
            }
            let random = Random(seed.wrapping_mul(1_000_003).wrapping_add(number as u64));
            let before = own.failures.len();
            let done = catch_unwind(AssertUnwindSafe(|| task(random, number, &mut own)));
            if done.is_err() {
                own.failures.push("it panicked".into());
            }
            for failure in &mut own.failures[before..] {
                *failure =
                    format!("METAMORPHIC_SEED={seed} METAMORPHIC_MACHINE={number}: {failure}");
            }
        }
        let mut total = total.lock().expect("no thread panics while it adds");
        total.add(own);
    };
    let threads = std::thread::available_parallelism()
        .map_or(1, usize::from)
        .min(4);
    std::thread::scope(|scope| {
        (0..threads).for_each(|_| {
            scope.spawn(work);
        });
    });
    let total = total.into_inner().expect("no thread panics while it adds");
    println!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    for (what, count) in &total.counts {
        println!("{count:7}  {what}");
    }
    let failures = total.failures.len();
    for failure in &total.failures {
        let lines: Vec<&str> = failure.lines().take(2).collect();
        println!("{}", lines.join(" "));
    }
    for failure in total.failures.iter().take(8) {
        println!("\n{failure}");
    }
    assert!(failures == 0, "{failures} failures; the seed is {seed}");
    total
}

/// Whether a run covers all machines, so that a feature that never occurs is an error of the generator.
fn is_full() -> bool {
    variable("METAMORPHIC_MACHINE").is_none() && variable("METAMORPHIC_COUNT").is_none()
}

#[test]
fn random_machines_said_otherwise_are_the_same() {
    let total = each("evaluation", MACHINES, evaluation::task);
    if is_full() {
        let expected = evaluation::parts();
        let missing: Vec<&String> = expected
            .iter()
            .filter(|part| !total.counts.contains_key(*part))
            .collect();
        assert!(missing.is_empty(), "these never took part: {missing:?}");
        let count = |what: &str| total.counts.get(what).copied().unwrap_or(0);
        let (guided, refused) = (count("Guided"), count("Guided: refused"));
        assert!(
            guided > 3 * refused,
            "{refused} guided machines are refused, {guided} are not"
        );
    }
}

#[test]
fn their_runs_end_where_each_other_do() {
    let total = each("simulation", RUNS, simulation::task);
    let runs = |(what, count): (&String, &usize)| what.starts_with("run:").then_some(*count);
    let runs: usize = total.counts.iter().filter_map(runs).sum();
    assert!(!is_full() || runs > RUNS / 4, "only {runs} runs");
}

#[test]
fn solids_by_four_numbers_are_those_by_three_angles() {
    let total = each("turns", TURNS, turns::solids);
    for what in ["first axis again", "three axes"] {
        let count = total.counts.get(what).copied().unwrap_or(0);
        assert!(!is_full() || count > TURNS / 8, "only {count} times {what}");
    }
}

#[test]
fn surfaces_are_the_same_in_every_frame() {
    each("surfaces", TURNS, turns::surfaces);
}

#[test]
fn the_command_prints_the_same_modes_and_accelerations() {
    let total = each("commands", MODES, commands::modes);
    for (what, least) in [("modes", 9), ("evaluate", 9), ("guided", 4)] {
        let count = total.counts.get(what).copied().unwrap_or(0);
        assert!(!is_full() || count > least, "only {count} times {what}");
    }
}

#[test]
fn they_are_the_same_in_c() {
    println!("C: METAMORPHIC_SEED={}", seed());
    commands::as_c();
}

#[test]
fn they_are_the_same_as_shared_libraries() {
    println!("libraries: METAMORPHIC_SEED={}", seed());
    commands::as_libraries();
}
