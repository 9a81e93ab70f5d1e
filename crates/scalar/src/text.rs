//! The source text of modules of this crate, for libraries that are written as one file.

/// The trait `Scalar`.
pub const LIB: &str = include_str!("lib.rs");
/// Functions that are called often.
pub const KERNEL: &str = include_str!("kernel.rs");
/// The plain numbers.
pub const REAL: &str = include_str!("real.rs");
/// Sums of products.
pub const SERIES: &str = include_str!("series.rs");
