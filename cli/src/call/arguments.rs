//! What the arguments of all commands have in common.

use super::{Assignment, Runs, Spec, Start};

/// A name that a call sets, with the option that sets it.
pub type SetName<'a> = (&'static str, &'a str);

/// The arguments of a command.
pub trait Arguments {
    /// The spec of the call, if it has one.
    fn spec(&self) -> Option<&Spec> {
        None
    }

    /// The spec of the call, for modification.
    fn spec_mut(&mut self) -> Option<&mut Spec> {
        None
    }

    /// The settings for running specs, for commands that accept specs instead of tables.
    fn runs(&self) -> Option<&Runs> {
        None
    }

    /// The names that the options of this command set, without those of [`spec`](Self::spec) and [`runs`](Self::runs).
    fn own_names(&self) -> Vec<SetName<'_>> {
        Vec::new()
    }

    /// The names that the call varies or fits.
    ///
    /// # Errors
    /// If a list of names is invalid.
    fn varied(&self) -> Result<Vec<String>, String> {
        Ok(Vec::new())
    }

    /// Whether the result is to be JSON.
    fn json(&self) -> bool {
        match self.runs() {
            Some(runs) => runs.json,
            None => self.spec().is_some_and(|spec| spec.json),
        }
    }
}

/// Implements the methods of [`Arguments`] for a command with a field `spec`.
macro_rules! with_spec {
    () => {
        fn spec(&self) -> Option<&crate::call::Spec> {
            Some(&self.spec)
        }

        fn spec_mut(&mut self) -> Option<&mut crate::call::Spec> {
            Some(&mut self.spec)
        }
    };
}
pub(super) use with_spec;

/// The names in lists of assignments, each list with its option.
pub(super) fn names_in<'a, const COUNT: usize>(
    lists: [(&'static str, &'a Vec<Assignment>); COUNT],
) -> Vec<SetName<'a>> {
    let names = lists.into_iter().flat_map(|(option, list)| {
        let names = list.iter().map(|set| set.name.as_str());
        names.map(move |name| (option, name))
    });
    names.collect()
}

impl Start {
    /// The names that it sets.
    pub(super) fn names(&self) -> Vec<SetName<'_>> {
        names_in([
            ("--set", &self.parameters),
            ("--start", &self.coordinates),
            ("--rate", &self.rates),
        ])
    }
}

impl Runs {
    /// The names that it sets.
    pub(super) fn names(&self) -> Vec<SetName<'_>> {
        let mut names = self.start.names();
        names.extend(names_in([("--input", &self.inputs)]));
        let constants = self.constants.iter();
        names.extend(constants.map(|(name, _)| ("--const", name.as_str())));
        names
    }
}
