//! Progress messages of a long command, on standard error.
//!
//! On a terminal a line appears after a second and is updated. Elsewhere lines are added: the first after two seconds, each further
//! one after twice the previous interval, so that a log file stays small; none with `--json`, which is meant for programs.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::numbers::shortest;

/// The time until the line on a terminal appears, and between its updates.
const APPEARS: Duration = Duration::from_millis(1000);
const BETWEEN: Duration = Duration::from_millis(200);

/// The time until the first line elsewhere, and the longest interval.
const FIRST_LINE: Duration = Duration::from_secs(2);
const LONGEST: Duration = Duration::from_secs(600);

/// The resolution of the bar.
const TICKS: u64 = 1000;

/// The reporting thread, and the current activity.
static REPORTER: Mutex<Option<JoinHandle<()>>> = Mutex::new(None);
static WORK: Mutex<Work> = Mutex::new(Work {
    task: "",
    until: None,
    has_ended: false,
});
static CHANGED: Condvar = Condvar::new();

/// The progress of a run: time and completed fraction as bits, and steps.
static TIME: AtomicU64 = AtomicU64::new(0);
static PART: AtomicU64 = AtomicU64::new(0);
static STEPS: AtomicU64 = AtomicU64::new(0);

/// The current activity.
struct Work {
    task: &'static str,
    /// The end of a run, in s.
    until: Option<f64>,
    has_ended: bool,
}

/// Starts reporting.
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
    // If no thread can be created, nothing is reported.
    let thread = std::thread::Builder::new().name("progress".into());
    *lock(&REPORTER) = thread.spawn(speak).ok();
}

/// Sets the activity, which is not a run towards an end: only the time that it has taken is shown.
pub fn now(task: &'static str) {
    let mut work = lock(&WORK);
    (work.task, work.until) = (task, None);
}

/// Sets the activity to a run until this time, in s.
pub fn run(until: f64) {
    let mut work = lock(&WORK);
    (work.task, work.until) = ("simulating", Some(until));
}

/// Records the progress of a run, at almost no cost.
pub fn at(t: f64, part: f64, steps: usize) {
    TIME.store(t.to_bits(), Ordering::Relaxed);
    PART.store(part.to_bits(), Ordering::Relaxed);
    STEPS.store(steps as u64, Ordering::Relaxed);
}

/// Stops reporting, and removes the line.
pub fn end() {
    let Some(speaker) = lock(&REPORTER).take() else {
        return;
    };
    lock(&WORK).has_ended = true;
    CHANGED.notify_all();
    let _ = speaker.join(); // a failure of reporting is not an error
}

/// A panic leaves no inconsistent state here, so poisoning is ignored.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits for a time; returns `None` if reporting has ended meanwhile.
fn wait(time: Duration) -> Option<MutexGuard<'static, Work>> {
    let waiting = CHANGED.wait_timeout_while(lock(&WORK), time, |work| !work.has_ended);
    let (work, _) = waiting.unwrap_or_else(PoisonError::into_inner);
    (!work.has_ended).then_some(work)
}

fn part() -> f64 {
    f64::from_bits(PART.load(Ordering::Relaxed))
}

fn status_line(work: &Work, began: Instant) -> String {
    let seconds = began.elapsed().as_secs();
    let what = work.task;
    let Some(until) = work.until else {
        return format!("{what}, {seconds} s");
    };
    let t = f64::from_bits(TIME.load(Ordering::Relaxed));
    let steps = STEPS.load(Ordering::Relaxed);
    let percent = 100.0 * part();
    // Enough digits that successive lines differ.
    let until = shortest(until);
    format!("{what}: t = {t:.6e} s of {until} s, {percent:.1} %, {steps} steps, {seconds} s")
}

fn in_lines(began: Instant) {
    let mut time = FIRST_LINE;
    let mut next = began + time;
    while let Some(work) = wait(next.saturating_duration_since(Instant::now())) {
        let line = format!("{}\n", status_line(&work, began));
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
        bar.set_message(status_line(&work, began));
        drop(work);
        bar.set_position((part() * TICKS as f64) as u64);
        bar.tick();
    }
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
}
