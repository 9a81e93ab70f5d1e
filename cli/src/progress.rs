//! What a command that takes long says meanwhile, on standard error.
//!
//! On a terminal a line that shows how far it is appears after a second and is kept up to date. Elsewhere lines are added: the first
//! after two seconds, each after twice the time of the one before, so that a file does not fill with them; none with
//! `--json`, where nobody reads along.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::numbers::shortest;

/// Until the line on a terminal appears, and between two of its states.
const APPEARS: Duration = Duration::from_millis(1000);
const BETWEEN: Duration = Duration::from_millis(200);

/// Until the first line elsewhere, and the longest time between two.
const FIRST_LINE: Duration = Duration::from_secs(2);
const LONGEST: Duration = Duration::from_secs(600);

/// Ticks of the bar.
const TICKS: u64 = 1000;

/// The thread that speaks, and what it does.
static SPEAKER: Mutex<Option<JoinHandle<()>>> = Mutex::new(None);
static WORK: Mutex<Work> = Mutex::new(Work {
    what: "",
    until: None,
    has_ended: false,
});
static CHANGED: Condvar = Condvar::new();

/// How far a run is: time and part of it that is done as bits, and steps.
static TIME: AtomicU64 = AtomicU64::new(0);
static PART: AtomicU64 = AtomicU64::new(0);
static STEPS: AtomicU64 = AtomicU64::new(0);

/// What is being done.
struct Work {
    what: &'static str,
    /// Of a run, when it ends, in s.
    until: Option<f64>,
    has_ended: bool,
}

/// Starts to speak.
pub fn begin(json: bool) {
    let is_terminal = io::stderr().is_terminal();
    if json && !is_terminal {
        return;
    }
    let began = Instant::now();
    let speak = move || {
        if is_terminal {
            on_terminal(began)
        } else {
            in_lines(began)
        }
    };
    // Without a thread nothing is said.
    let thread = std::thread::Builder::new().name("progress".into());
    *lock(&SPEAKER) = thread.spawn(speak).ok();
}

/// Says what is being done from now on.
pub fn now(what: &'static str) {
    lock(&WORK).what = what;
}

/// Says that a run is being made, to this time, in s.
pub fn run(until: f64) {
    let mut work = lock(&WORK);
    (work.what, work.until) = ("simulating", Some(until));
}

/// Takes note of how far a run is; costs next to nothing.
pub fn at(t: f64, part: f64, steps: usize) {
    TIME.store(t.to_bits(), Ordering::Relaxed);
    PART.store(part.to_bits(), Ordering::Relaxed);
    STEPS.store(steps as u64, Ordering::Relaxed);
}

/// Ends it, and takes the line away.
pub fn end() {
    let Some(speaker) = lock(&SPEAKER).take() else {
        return;
    };
    lock(&WORK).has_ended = true;
    CHANGED.notify_all();
    let _ = speaker.join(); // what it had to say is no result
}

/// Nothing here is left half done by a panic.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits, unless it ends before; then there is nothing to be said any more.
fn wait(time: Duration) -> Option<MutexGuard<'static, Work>> {
    let waiting = CHANGED.wait_timeout_while(lock(&WORK), time, |work| !work.has_ended);
    let (work, _) = waiting.unwrap_or_else(PoisonError::into_inner);
    (!work.has_ended).then_some(work)
}

fn part() -> f64 {
    f64::from_bits(PART.load(Ordering::Relaxed))
}

fn said(work: &Work, began: Instant) -> String {
    let seconds = began.elapsed().as_secs();
    let what = work.what;
    let Some(until) = work.until else {
        return format!("{what}, {seconds} s");
    };
    let t = f64::from_bits(TIME.load(Ordering::Relaxed));
    let steps = STEPS.load(Ordering::Relaxed);
    let percent = 100.0 * part();
    // As many digits as two lines in a row need to differ.
    let until = shortest(until);
    format!("{what}: t = {t:.6e} s of {until} s, {percent:.1} %, {steps} steps, {seconds} s")
}

fn in_lines(began: Instant) {
    let mut time = FIRST_LINE;
    let mut next = began + time;
    while let Some(work) = wait(next.saturating_duration_since(Instant::now())) {
        let line = format!("{}\n", said(&work, began));
        drop(work);
        let _ = io::stderr().lock().write_all(line.as_bytes());
        next += time;
        time = (2 * time).min(LONGEST);
    }
}

fn on_terminal(began: Instant) {
    let mut bar: Option<ProgressBar> = None;
    let mut time = APPEARS;
    let style = |template: &str| ProgressStyle::with_template(template).ok();
    while let Some(work) = wait(time) {
        time = BETWEEN;
        let bar = bar.get_or_insert_with(|| ProgressBar::new(TICKS));
        let style = match work.until {
            Some(_) => style("{bar:30} {msg}"),
            None => style("{msg}"),
        };
        if let Some(style) = style {
            bar.set_style(style);
        }
        bar.set_message(said(&work, began));
        drop(work);
        bar.set_position((part() * TICKS as f64) as u64);
        bar.tick();
    }
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
}
