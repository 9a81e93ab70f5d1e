//! All chunks of a sweep, over the cores of one machine.

use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

use crate::folder::{Folder, Trouble};
use crate::plan::LONGEST_CHUNK;
use crate::sweep::Sweep;

/// How long a chunk is to take.
const CHUNK: Duration = Duration::from_secs(1);

/// How many runs fill the lanes of a processor twice, and how long a chunk may take alone so that they do.
const FILLS_LANES: u64 = 16;
const LONGEST: Duration = Duration::from_secs(10);

/// How many runs tell how long one takes.
const TRIED: u64 = 8;

/// Chunks for each core, so that none waits long for the others at the end.
const CHUNKS_A_CORE: u64 = 4;

/// How often progress is reported.
const BETWEEN: Duration = Duration::from_millis(100);

/// How far a sweep is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// How many runs are done, those of before among them.
    pub done: u64,
    /// How many of those that were done now have failed.
    pub failed: u64,
}

/// How many threads there are where nobody says it.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// A length of chunks: as many runs as take about a second, by the first of them, and more where lanes wait for them; a power of
/// two.
pub fn chunk_length(sweep: &Sweep) -> u64 {
    let runs = sweep.plan().runs();
    let most = (runs / (CHUNKS_A_CORE * cores() as u64)).clamp(1, LONGEST_CHUNK);
    if most == 1 {
        return 1;
    }
    let is_over = AtomicBool::new(false);
    let (tell, told) = mpsc::channel::<()>();
    let began = Instant::now();
    let mut done = 0;
    std::thread::scope(|scope| {
        let is_over = &is_over;
        scope.spawn(move || {
            if told.recv_timeout(CHUNK) == Err(mpsc::RecvTimeoutError::Timeout) {
                is_over.store(true, Ordering::Relaxed);
            }
        });
        while done < TRIED.min(runs) {
            if sweep.run(done..done + 1, is_over, &|_| ()).is_none() {
                break;
            }
            done += 1;
        }
        drop(tell);
    });
    let each = began.elapsed().as_secs_f64() / done.max(1) as f64;
    let mut fit = (CHUNK.as_secs_f64() / each.max(1e-9)) as u64;
    if sweep.may_run_in_lanes() && each * FILLS_LANES as f64 <= LONGEST.as_secs_f64() {
        fit = fit.max(FILLS_LANES);
    }
    let length = fit.clamp(1, most);
    1 << (63 - length.leading_zeros())
}

/// Makes all chunks that are not there yet, and keeps them. Stops where `stop` is set, or after as many runs as `limit` says and
/// the chunks under way; `watch` is told ten times a second. How many runs were made.
///
/// # Errors
/// If a chunk cannot be kept. Those that are there stay.
pub fn run_all(
    sweep: &Sweep,
    folder: &Folder,
    (threads, limit): (usize, Option<u64>),
    stop: &AtomicBool,
    watch: &mut dyn FnMut(Progress),
) -> Result<u64, Trouble> {
    let plan = sweep.plan();
    let length = |chunk: u64| {
        let runs = plan.runs_of(chunk);
        runs.end - runs.start
    };
    let (there, missing): (Vec<u64>, Vec<u64>) =
        (0..plan.chunks()).partition(|&chunk| folder.has(sweep, chunk));
    let before: u64 = there.into_iter().map(length).sum();
    let mut begun = 0;
    let wanted = missing.iter().take_while(|&&chunk| {
        let is_wanted = limit.is_none_or(|limit| begun < limit);
        begun += length(chunk);
        is_wanted
    });
    let wanted: Vec<u64> = wanted.copied().collect();

    let next = AtomicUsize::new(0);
    let (done, failed) = (AtomicU64::new(before), AtomicU64::new(0));
    let trouble = Mutex::new(None);
    let count = |is_failed: bool| {
        done.fetch_add(1, Ordering::Relaxed);
        failed.fetch_add(u64::from(is_failed), Ordering::Relaxed);
    };
    let work = || {
        while let Some(&chunk) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) {
            let Some(made) = sweep.run(plan.runs_of(chunk), stop, &count) else {
                return;
            };
            if let Err(error) = folder.keep(chunk, &made) {
                let mut trouble = trouble.lock().unwrap_or_else(PoisonError::into_inner);
                trouble.get_or_insert(error);
                stop.store(true, Ordering::Relaxed);
                return;
            }
        }
    };
    std::thread::scope(|scope| {
        let (tell, told) = mpsc::channel::<()>();
        for _ in 0..threads.clamp(1, wanted.len().max(1)) {
            let tell = tell.clone();
            scope.spawn(move || {
                let _lives = tell;
                work();
            });
        }
        drop(tell);
        while told.recv_timeout(BETWEEN) == Err(mpsc::RecvTimeoutError::Timeout) {
            watch(Progress {
                done: done.load(Ordering::Relaxed),
                failed: failed.load(Ordering::Relaxed),
            });
        }
    });
    match trouble.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(done.into_inner() - before),
    }
}
