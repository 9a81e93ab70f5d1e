//! Programs as machine code, made while the program runs that asks for it: compiled speed without a compiler.
//!
//! A [`Program`](lagrangian_program::Program) is straight-line arithmetic, so its code is written down in one walk, a fifth of a
//! microsecond for an operation. It gives **the bits of the interpreter**, and so those of the code that rustc compiles:
//! functions that are called often are contracted as `fusion.rs` says and take their sines from `lagrangian-native`; all
//! others do every operation by itself and take `libm`'s. (An undefined result is undefined in both; which of the many
//! undefined numbers it is, no arithmetic says.)
//!
//! # The way
//!
//! | file | from | to |
//! | --- | --- | --- |
//! | `lower.rs` | operations of a program | instructions and calls, in phases |
//! | `emit.rs`, `encodings.rs` | instructions | bytes: registers, places in memory, encodings |
//! | `code.rs` | bytes | pages that are written, then executable, never both |
//! | `running.rs`, `several.rs` | calls of one state, of 4 or 8 states | calls of that code, where it pays |
//!
//! # Where there is none
//!
//! On processors other than x86-64 with AVX2 and fused multiply-add; in builds with `strict-libm`, whose arithmetic is
//! another; and where the system does not let pages be executable. [`Level::here`] and [`Library::new`] say so, and the
//! caller interprets: the same bits.
//!
//! # Unsafe code
//!
//! A call of bytes that were just written cannot be anything else. It is in `code.rs`, and in `external.rs`, which that
//! code calls back.

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
mod several;
mod unavailable;
mod work;

#[cfg(not(target_arch = "x86_64"))]
use nowhere as code;

pub use arguments::SeveralArguments;
pub use code::{Code, Layout, Workspace};
pub use library::Library;
pub use running::{Running, When};
pub use several::Several;
pub use unavailable::Unavailable;
pub use work::Work;

use lagrangian_native::Number;
use lagrangian_scalar::{Kernel, Scalar};

/// Which instructions code is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Level {
    /// AVX2 and fused multiply-add: 16 registers of four numbers.
    Avx2,
    /// AVX-512: 32 registers of eight numbers, and one number from memory as an operand of all lanes.
    Avx512,
}

impl Level {
    /// The best that the processor has and that gives the bits of the interpreter; none where there is none.
    pub fn here() -> Option<Level> {
        Level::all().last()
    }

    /// All that the processor has, the best last.
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

/// Whether functions that are called often run with fused operations here: not where the build wants the same bits
/// everywhere.
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
