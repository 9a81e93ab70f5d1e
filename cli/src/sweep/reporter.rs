//! Progress messages of a sweep, on standard error.

use std::collections::VecDeque;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use lagrangian_sweep::Progress;

/// The interval between two lines if there is no terminal.
const BETWEEN: Duration = Duration::from_secs(10);

/// The remaining time is estimated from the progress in this time.
const WINDOW: Duration = Duration::from_secs(30);

/// The progress of a sweep, reported while it runs.
pub struct Reporter {
    runs: u64,
    is_silent: bool,
    bar: Option<ProgressBar>,
    began: Instant,
    next: Instant,
    /// The number of finished runs at recent instants.
    seen: VecDeque<(Instant, u64)>,
}

impl Reporter {
    /// Starts reporting for this number of runs.
    pub fn new(runs: u64, json: bool) -> Reporter {
        let is_terminal = io::stderr().is_terminal();
        let now = Instant::now();
        let bar = is_terminal.then(|| {
            let bar = ProgressBar::new(runs);
            if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}") {
                bar.set_style(style);
            }
            bar
        });
        Reporter {
            runs,
            is_silent: json && !is_terminal,
            bar,
            began: now,
            next: now + BETWEEN,
            seen: VecDeque::new(),
        }
    }

    /// Records progress, and prints it when it is time to.
    pub fn report(&mut self, progress: Progress) {
        let now = Instant::now();
        self.seen.push_back((now, progress.done));
        while self.seen.len() > 2
            && self
                .seen
                .get(1)
                .is_some_and(|(then, _)| now - *then > WINDOW)
        {
            self.seen.pop_front();
        }
        if self.is_silent || (self.bar.is_none() && now < self.next) {
            return;
        }
        let (then, before) = self.seen.front().copied().unwrap_or((self.began, 0));
        let seconds = (now - then).as_secs_f64();
        let done = progress.done - before.min(progress.done);
        let speed = if seconds > 0.0 {
            done as f64 / seconds
        } else {
            0.0
        };
        let left = (self.runs - progress.done.min(self.runs)) as f64 / speed;
        let left = if left.is_finite() {
            format!("{} left", duration(left))
        } else {
            "remaining time unknown".to_owned()
        };
        let Progress { done, failed } = progress;
        let line = format!(
            "{done} of {} runs, {failed} failed, {speed:.0} runs per second, {left}",
            self.runs
        );
        match &self.bar {
            Some(bar) => {
                bar.set_position(done);
                bar.set_message(line);
            }
            None => {
                let _ = io::stderr().lock().write_all((line + "\n").as_bytes());
                self.next = now + BETWEEN;
            }
        }
    }

    /// Removes the line.
    pub fn end(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

/// `40 s`, `12 min`, `3.5 h`, `2.1 d`.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 48.0 * 3600.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} d", s / 86400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_told_in_units_that_fit() {
        let told = [5.0, 90.0, 600.0, 9000.0, 864_000.0].map(duration);
        assert_eq!(told, ["5 s", "90 s", "10 min", "2.5 h", "10.0 d"]);
    }
}
