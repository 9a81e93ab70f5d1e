//! The derivation for readers: a chapter on a machine as [`markdown`], [`latex`] and [`html`], and the [comparison](compare) of
//! its equations with published ones.

pub mod compare;
pub mod document;
pub mod html;
pub mod latex;
pub mod markdown;

mod chapter;
