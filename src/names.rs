//! Unknown names, with the name that was probably meant.

use core::fmt::{self, Display};
use std::string::String;
use std::vec::Vec;

/// No parameter, coordinate or input has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct UnknownName {
    /// The name.
    pub name: String,
    /// The name that was probably meant, if there is a similar one.
    pub near: Option<String>,
    /// The existing names.
    pub known: Vec<String>,
}

impl UnknownName {
    /// The error that there is no `name` among the `known` ones.
    pub fn new<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        let known: Vec<String> = known.into_iter().map(String::from).collect();
        // Similar names differ only in case, or by at most one edit in three characters.
        let allowed = (name.chars().count() / 3).max(1);
        let slips =
            |known: &&String| strsim::osa_distance(&known.to_lowercase(), &name.to_lowercase());
        // The cost is the product of the lengths; and a single letter is one edit away from every other.
        let near = known
            .iter()
            .filter(|known| name.len() <= LONGEST && known.len() <= LONGEST)
            // Among equally similar names, prefer the one in the same case.
            .min_by_key(|known| (slips(known), strsim::osa_distance(known, name)))
            .filter(|known| slips(known) <= allowed)
            .filter(|known| {
                slips(known) == 0 || name.chars().count().max(known.chars().count()) > 1
            });
        Self {
            name: name.into(),
            near: near.cloned(),
            known,
        }
    }
}

/// Longer names, in bytes, are not compared.
const LONGEST: usize = 256;

impl Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no `{}`; ", self.name)?;
        match &self.near {
            Some(near) => write!(f, "did you mean `{near}`?"),
            None if self.known.is_empty() => write!(f, "nothing can be set by name"),
            None => write!(f, "available: {}", self.known.join(", ")),
        }
    }
}

impl core::error::Error for UnknownName {}

/// The name of the rate of a coordinate: `der(phi)`. For the integral of a first-order state, `integral(i)` or
/// `integral(T)[3]`, it is the name of the state: `i`, `T[3]`.
pub(crate) fn rate_name(coordinate: &str) -> std::string::String {
    let integral = coordinate.strip_prefix("integral(");
    match integral.and_then(|integral| integral.split_once(')')) {
        Some((base, index)) => std::format!("{base}{index}"),
        None => std::format!("der({coordinate})"),
    }
}
