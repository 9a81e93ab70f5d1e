//! Time that work takes: seconds of the thread's own on the processor, so that what else runs there
//! does not count.
#![allow(dead_code, reason = "each bench uses some of it")]

use cpu_time::ThreadTime;

/// Processor time of a call, in s.
pub fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let clock = ThreadTime::now();
    let result = work();
    (clock.elapsed().as_secs_f64(), result)
}

/// The number in the middle.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    quantile(&numbers, 0.5)
}

/// The median time of several calls, in s: at least `least` of them, and more until half a second
/// is spent.
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

/// A sample takes about so long: long beside the clock's own time, short beside the time between
/// two interruptions.
const SAMPLE: f64 = 200e-6;
const SAMPLES: usize = 500;

/// The time of one of many short calls, in s: `work(n)` makes n of them.
///
/// The median over samples of about 200 µs; up to four series, while the median exceeds the first
/// quartile by more than 5 %; of these the quietest.
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
