//! Compiles programs to machine code at run time: compiled speed without a compiler.
//!
//! A [`Program`](lagrangian_program::Program) is straight-line arithmetic, so its code is generated in one pass, which takes a
//! fifth of a microsecond per operation. It gives **the bits of the interpreter**, and so those of the code that rustc compiles:
//! functions that are called often are contracted by the rule of `fusion.rs` and use the sines of `lagrangian-native`; all
//! others execute every operation separately and use those of `libm`. (A NaN is NaN in both; which of the many NaN bit patterns
//! it has is unspecified.)
//!
//! # How it works
//!
//! | file | from | to |
//! | --- | --- | --- |
//! | `lower.rs` | operations of a program | instructions and calls, in phases |
//! | `emit.rs`, `encodings.rs` | instructions | bytes: registers, places in memory, encodings |
//! | `code.rs` | bytes | pages that are written, then executable, never both |
//! | `series.rs` and its folder | recurrences of a Taylor series | the same for a step by series |
//! | `running.rs`, `several.rs` | calls of one state, of 4 or 8 states | calls of that code, where it pays |
//!
//! # Limits
//!
//! There is no machine code on processors other than x86-64 with AVX2 and fused multiply-add, in builds with
//! `strict-libm`, whose arithmetic is different, and where the system does not allow executable pages. [`Level::here`]
//! and [`Library::new`] report this, and the caller interprets instead, with the same bits.
//!
//! # Unsafe code
//!
//! A call of bytes that were just written is necessarily unsafe. The unsafe code is in `code.rs`, and in `external.rs`,
//! whose functions the generated code calls.

mod arguments;
#[cfg(target_arch = "x86_64")]
mod code;
#[cfg(target_arch = "x86_64")]
mod emit;
#[cfg(target_arch = "x86_64")]
mod encodings;
#[cfg(target_arch = "x86_64")]
mod external;
mod library;
#[cfg(target_arch = "x86_64")]
mod lower;
#[cfg(not(target_arch = "x86_64"))]
mod nowhere;
mod running;
#[cfg(target_arch = "x86_64")]
mod series;
mod series_library;
mod several;
mod unavailable;
mod work;

#[cfg(not(target_arch = "x86_64"))]
use nowhere as code;
#[cfg(not(target_arch = "x86_64"))]
pub use nowhere::{SeriesCode, SeriesRunning, SeriesSeveral};

pub use arguments::SeveralArguments;
pub use code::{Code, Layout, Workspace};
pub use library::Library;
pub use running::{Running, When};
#[cfg(target_arch = "x86_64")]
pub use series::{SeriesCode, SeriesRunning, SeriesSeveral};
pub use series_library::SeriesLibrary;
pub use several::Several;
pub use unavailable::Unavailable;
pub use work::Work;

use lagrangian_native::Number;
use lagrangian_scalar::{Kernel, Scalar};

/// The instruction set of generated code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// AVX2 and fused multiply-add: 16 registers of four numbers.
    Avx2,
    /// AVX-512: 32 registers of eight numbers, with broadcast of one number from memory to all lanes.
    Avx512,
}

impl Level {
    /// The best level of the processor that gives the bits of the interpreter; `None` if there is none.
    pub fn here() -> Option<Level> {
        Level::all().last()
    }

    /// All levels of the processor, the best last.
    pub fn all() -> impl Iterator<Item = Level> {
        let [avx2, avx512] = if is_fused() { levels() } else { [false; 2] };
        let avx2 = avx2.then_some(Level::Avx2);
        avx2.into_iter().chain(avx512.then_some(Level::Avx512))
    }
}

#[cfg(target_arch = "x86_64")]
fn levels() -> [bool; 2] {
    use std::arch::is_x86_feature_detected as has;
    let avx2 = has!("avx2") && has!("fma");
    let avx512 = avx2 && has!("avx512f") && has!("avx512dq") && has!("avx512vl");
    [avx2, avx512]
}

#[cfg(not(target_arch = "x86_64"))]
fn levels() -> [bool; 2] {
    [false; 2]
}

/// Whether functions that are called often use fused operations here; builds that want the same bits everywhere do not.
fn is_fused() -> bool {
    struct Probe;
    impl Kernel<f64> for Probe {
        type Output = bool;

        #[inline(always)]
        fn run<N: Scalar<Stored = f64>>(self) -> bool {
            let x = N::from_f64(1.0 + f64::EPSILON);
            let square = x.mul_sub(x, N::from_f64(1.0 + 2.0 * f64::EPSILON));
            square.to_f64() != 0.0
        }
    }
    f64::run(Probe)
}
