//! Processor time of this thread, so that other work on the processor does not count.
#![allow(dead_code, reason = "each bench uses some of it")]

use cpu_time::ThreadTime;

/// Processor time of a call, in s.
pub fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let clock = ThreadTime::now();
    let result = work();
    (clock.elapsed().as_secs_f64(), result)
}

/// The median.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    quantile(&numbers, 0.5)
}

/// The median time of several calls, in s: at least `least` calls, and more until half a second is spent.
pub fn median_of<R>(least: usize, mut work: impl FnMut() -> R) -> (f64, R) {
    let (first, mut result) = seconds(&mut work);
    let mut times = vec![first];
    while times.len() < least || (times.iter().sum::<f64>() < 0.5 && times.len() < 1000) {
        let (time, last) = seconds(&mut work);
        times.push(time);
        result = last;
    }
    (median(times), result)
}

/// The approximate duration of a sample, in s: long compared with the clock's own time, short
/// compared with the time between two interruptions.
const SAMPLE: f64 = 200e-6;
const SAMPLES: usize = 500;

/// The time of one of many short calls, in s: `work(n)` makes n of them.
///
/// The result is the median over samples of about 200 µs. If the median exceeds the first quartile
/// by more than 5 %, the series is repeated, up to four in all, and the smallest median counts.
pub fn per_call(mut work: impl FnMut(usize)) -> f64 {
    let mut calls = 16;
    while seconds(|| work(calls)).0 < SAMPLE {
        calls *= 2;
    }
    let mut best = f64::INFINITY;
    for _ in 0..4 {
        let mut samples: Vec<f64> = (0..SAMPLES)
            .map(|_| seconds(|| work(calls)).0 / calls as f64)
            .collect();
        samples.sort_by(f64::total_cmp);
        let median = quantile(&samples, 0.5);
        best = best.min(median);
        if median <= 1.05 * quantile(&samples, 0.25) {
            break;
        }
    }
    best
}

fn quantile(sorted: &[f64], part: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * part).round() as usize]
}
