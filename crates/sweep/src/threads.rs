//! Runs all chunks of a sweep on the cores of one computer.

use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use crate::folder::{Folder, FolderError};
use crate::plan::LONGEST_CHUNK;
use crate::sweep::Sweep;

/// The time that a chunk should take.
const CHUNK_DURATION: Duration = Duration::from_secs(1);

/// The number of runs that fills the lanes of a processor twice, and the longest time that a chunk may take
/// for this purpose.
const FILLS_LANES: u64 = 16;
const LONGEST_CHUNK_DURATION: Duration = Duration::from_secs(10);

/// How many runs are timed to choose the length of chunks.
const TIMED_RUNS: u64 = 8;

/// The number of chunks per core, so that no core idles for long at the end.
const CHUNKS_PER_CORE: u64 = 4;

/// The interval between progress reports.
const REPORT_INTERVAL: Duration = Duration::from_millis(100);

/// The progress of a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// The number of finished runs, including those of earlier sessions.
    pub done: u64,
    /// The number of failed runs of this session.
    pub failed: u64,
}

/// The default number of threads.
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Chooses a length of chunks: as many runs as take about a second, judged by the first ones, and more where this fills
/// lanes; a power of two.
pub fn chunk_length(sweep: &Sweep) -> u64 {
    let runs = sweep.plan().runs();
    let most = (runs / (CHUNKS_PER_CORE * cores() as u64)).clamp(1, LONGEST_CHUNK);
    if most == 1 {
        return 1;
    }
    let is_over = AtomicBool::new(false);
    let (sender, receiver) = mpsc::channel::<()>();
    let began = Instant::now();
    let mut done = 0;
    thread::scope(|scope| {
        let is_over = &is_over;
        scope.spawn(move || {
            if receiver.recv_timeout(CHUNK_DURATION) == Err(mpsc::RecvTimeoutError::Timeout) {
                is_over.store(true, Ordering::Relaxed);
            }
        });
        while done < TIMED_RUNS.min(runs) {
            if sweep.run(done..done + 1, is_over, &|_| ()).is_none() {
                break;
            }
            done += 1;
        }
        drop(sender);
    });
    let each = began.elapsed().as_secs_f64() / done.max(1) as f64;
    let mut fit = (CHUNK_DURATION.as_secs_f64() / each.max(1e-9)) as u64;
    if sweep.may_run_in_lanes() && each * FILLS_LANES as f64 <= LONGEST_CHUNK_DURATION.as_secs_f64()
    {
        fit = fit.max(FILLS_LANES);
    }
    let length = fit.clamp(1, most);
    1 << (63 - length.leading_zeros())
}

/// Makes and stores all missing chunks. Stops when `stop` is set or, after finishing the chunks under way, when `limit` runs are
/// done; `watch` is called ten times a second. Returns the number of runs made.
///
/// # Errors
/// If a chunk cannot be stored. Chunks stored before remain.
pub fn run_all(
    sweep: &Sweep,
    folder: &Folder,
    (threads, limit): (usize, Option<u64>),
    stop: &AtomicBool,
    watch: &mut dyn FnMut(Progress),
) -> Result<u64, FolderError> {
    let plan = sweep.plan();
    let length = |chunk: u64| {
        let runs = plan.runs_of(chunk);
        runs.end - runs.start
    };
    let there = folder.chunks(sweep);
    let before: u64 = there.iter().map(|&chunk| length(chunk)).sum();
    // One after the other: a plan may have far more chunks than a list in memory.
    let missing = (0..plan.chunks()).filter(|chunk| there.binary_search(chunk).is_err());
    let mut begun = 0;
    let wanted = Mutex::new(missing.take_while(move |&chunk| {
        let is_wanted = limit.is_none_or(|limit| begun < limit);
        begun += length(chunk);
        is_wanted
    }));
    let next = || {
        let mut wanted = wanted.lock().unwrap_or_else(PoisonError::into_inner);
        wanted.next()
    };

    let (done, failed) = (AtomicU64::new(before), AtomicU64::new(0));
    let trouble = Mutex::new(None);
    let count = |is_failed: bool| {
        done.fetch_add(1, Ordering::Relaxed);
        failed.fetch_add(u64::from(is_failed), Ordering::Relaxed);
    };
    let work = || {
        while let Some(chunk) = next() {
            let Some(made) = sweep.run(plan.runs_of(chunk), stop, &count) else {
                return;
            };
            if let Err(error) = folder.store(chunk, &made) {
                let mut trouble = trouble.lock().unwrap_or_else(PoisonError::into_inner);
                trouble.get_or_insert(error);
                stop.store(true, Ordering::Relaxed);
                return;
            }
        }
    };
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel::<()>();
        let most = usize::try_from(plan.chunks()).unwrap_or(usize::MAX);
        for count in 0..threads.clamp(1, most.max(1)) {
            let tell = sender.clone();
            let thread = thread::Builder::new().spawn_scoped(scope, move || {
                let _lives = tell;
                work();
            });
            // A system permits only so many threads: those that have begun do the work, or else this one.
            if thread.is_err() {
                if count == 0 {
                    work();
                }
                break;
            }
        }
        drop(sender);
        while receiver.recv_timeout(REPORT_INTERVAL) == Err(mpsc::RecvTimeoutError::Timeout) {
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
