//! The command line: commands and options.

mod arguments;
mod brachistochrone;
mod derive;
mod export;
mod fit;
mod import;
mod linear;
mod orbit;
mod runs;
mod simulate;
mod spec;
mod sweep;
mod values;

use std::ffi::OsString;

use clap::{Parser, Subcommand};

pub use arguments::{Arguments, SetName};
pub use brachistochrone::Brachistochrone;
pub use derive::{Check, Derive, Form};
pub use export::{Fmu, Library, Names, UnitKind, UnitMethod};
pub use fit::{Bounds, Fit, SigmaOption, names_of_option, refuse_twice};
pub use import::{Ball, Base, Friction, Import, Limits};
pub use linear::{Linearize, Modes, Search, Steady, SteadyRate, Vary};
use linear::{observed, vary};
pub use orbit::{Orbit, Sensitivities};
pub use runs::{Compare, Direction, Interpolation, Part, Peaks, Section, Spectrum, Windows};
pub use simulate::{Evaluate, Simulate};
pub use spec::{Engine, Keep, Precision, Running, Runs, Spec, Start};
pub use sweep::{Design, Map, Sweep};
pub use values::{Assignment, assignment, count, number};
use values::{constant, interval, lanes, positive, steps, tolerance, wide_tolerance};

/// Derives, evaluates and simulates the equations of motion of machines described by specs.
#[derive(Debug, Parser)]
#[command(name = "lagrangian", version, disable_help_subcommand = true)]
pub struct Call {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// Defines the commands, each with a struct of its arguments.
macro_rules! commands {
    ($($(#[doc = $docs:literal])+ $command:ident,)+) => {
        /// One command for each question.
        #[derive(Debug, Subcommand)]
        pub enum Command {
            $($(#[doc = $docs])+ $command(Box<$command>),)+
        }

        impl Command {
            /// The arguments of the command.
            pub fn arguments(&self) -> &dyn Arguments {
                match self {
                    $(Command::$command(call) => &**call,)+
                }
            }

            fn arguments_mut(&mut self) -> &mut dyn Arguments {
                match self {
                    $(Command::$command(call) => &mut **call,)+
                }
            }
        }
    };
}

commands! {
    /// Report everything that is wrong with a spec, and compare published equations with the derived ones.
    Check,
    /// Print the derived equations, or the code, with operation counts.
    Derive,
    /// Build a shared library that C, Python and others can call.
    Library,
    /// Build a functional mock-up unit for tools that import FMI 3.0 or 2.0.
    Fmu,
    /// Compute numbers at given states, as JSON.
    Evaluate,
    /// Integrate the equations of motion.
    Simulate,
    /// Integrate many times, over parameters, inputs and start values, with one row for each run.
    Sweep,
    /// Plot a sweep: curves over one parameter, a colour map over two.
    Map,
    /// Find an equilibrium, and print eigenfrequencies, damping ratios and mode shapes about it.
    Modes,
    /// Compute the linear model about an equilibrium, a steady motion or any state: A, B, C, D; poles, zeros, frequency response.
    Linearize,
    /// Find a periodic motion: its period, monodromy matrix and Floquet multipliers, and whether it is stable.
    Orbit,
    /// Compute the derivatives of a motion with respect to parameters, inputs and start values.
    Sensitivities,
    /// Report how far two runs, given as tables or specs, are apart.
    Compare,
    /// Find the frequencies in a run, with their amplitudes.
    Spectrum,
    /// Find the maxima and minima of a run, with period and decrement.
    Peaks,
    /// Sample a run once in each period, or where a quantity passes a value: a Poincaré section.
    Section,
    /// Estimate parameters and start values from measured motions, with standard errors and the parameters that cannot be told apart.
    Fit,
    /// Find the fastest motion from rest at one position to another, under control forces that do no work.
    Brachistochrone,
    /// Convert a URDF or MJCF file of a robot to a spec.
    Import,
}

impl Command {
    /// The names that the call sets, varies or fits: a parameter with such a name does not follow from others.
    fn given(&self) -> Result<Vec<String>, String> {
        let sets = ["--set", "--set-second"];
        let named = self.named().into_iter();
        let named = named.filter(|(option, _)| sets.contains(option));
        let mut all_names: Vec<String> = named.map(|(_, name)| name.to_owned()).collect();
        all_names.extend(self.arguments().varied()?);
        Ok(all_names)
    }

    /// Every name that the call sets, with the option that sets it.
    fn named(&self) -> Vec<SetName<'_>> {
        let arguments = self.arguments();
        let mut named = arguments.own_names();
        named.extend(arguments.runs().into_iter().flat_map(Runs::names));
        let constants = arguments
            .spec()
            .into_iter()
            .flat_map(|spec| &spec.constants);
        named.extend(constants.map(|(name, _)| ("--const", name.as_str())));
        named
    }
}

impl Call {
    /// Parses the words of a call, of which the first is the name of the program.
    ///
    /// # Errors
    /// If they are not a valid call; the message is to be printed, and may be the requested help.
    pub fn read<T: Into<OsString> + Clone>(
        words: impl IntoIterator<Item = T>,
    ) -> Result<Call, clap::Error> {
        let mut call = Call::try_parse_from(words)?;
        // An invalid list is refused later, where its names are needed.
        let given = call.command.given().unwrap_or_default();
        if let Some(spec) = call.command.arguments_mut().spec_mut() {
            spec.given = given;
        }
        Ok(call)
    }

    /// Checks that nothing is set twice, because it would not be clear which value is meant.
    ///
    /// # Errors
    /// If something is set twice: what.
    pub fn check(&self) -> Result<(), String> {
        let mut named = self.command.named();
        named.sort_unstable();
        let twice = named.windows(2).find(|pair| pair[0] == pair[1]);
        if let Some(&[(option, name), _]) = twice {
            return Err(format!("{option} sets `{name}` more than once"));
        }
        let mut events = named.iter().filter(|(option, _)| *option == "--event");
        if let Some((_, name)) = events.find(|(_, name)| named.contains(&("--until-event", name))) {
            return Err(format!(
                "--event and --until-event both name an event `{name}`"
            ));
        }
        // An input that is driven, as a member of a family too, has no other value.
        let inputs = named.iter().filter(|(option, _)| *option == "--input");
        let is_driven = |set: &str| {
            let mut inputs = inputs.clone();
            inputs.any(|(_, input)| {
                let member = set.strip_prefix(input);
                member.is_some_and(|index| index.is_empty() || index.starts_with('['))
            })
        };
        let is_set = |option: &str| ["--set", "--set-second"].contains(&option);
        let mut sets = named.iter().filter(|(option, _)| is_set(option));
        if let Some((option, name)) = sets.find(|(_, name)| is_driven(name)) {
            return Err(format!(
                "`{name}` is driven by --input and also set to a constant by {option}"
            ));
        }
        if let Command::Library(call) = &self.command {
            let mut lanes = call.lanes.clone();
            lanes.sort_unstable();
            if let Some(pair) = lanes.windows(2).find(|pair| pair[0] == pair[1]) {
                return Err(format!("--lanes names {} more than once", pair[0]));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_may_hold_pi() {
        let pi = std::f64::consts::PI;
        assert_eq!(number("50*pi"), Ok(50.0 * pi));
        assert_eq!(number("-pi/2"), Ok(-pi / 2.0));
        assert_eq!(number("2*pi/3"), Ok(2.0 * pi / 3.0));
        assert_eq!(number("1e-3"), Ok(1e-3));
        for text in [
            "",
            "2*",
            "two",
            "nan",
            "inf",
            "-inf",
            "1e999",
            "1/0",
            "0/0",
            "1e300*1e300",
            "--1",
        ] {
            assert!(number(text).is_err(), "{text}");
        }
    }

    #[test]
    fn settings_that_make_no_sense_are_refused() {
        assert_eq!(tolerance("1e-9"), Ok(1e-9));
        assert_eq!(tolerance("2.3e-15"), Ok(2.3e-15));
        for text in ["0", "-1e-9", "1", "2", "1e-15", "1e-300", "nan"] {
            assert!(tolerance(text).is_err(), "{text}");
        }
        assert_eq!(interval("0.001"), Ok(0.001));
        for text in ["0", "-0", "-1", "inf", "nan"] {
            assert!(interval(text).is_err(), "{text}");
        }
        assert_eq!(steps("1e8"), Ok(100_000_000));
        for text in ["0", "-1", "1.5", "1e16", "nan"] {
            assert!(steps(text).is_err(), "{text}");
        }
    }

    fn checked(arguments: &[&str]) -> Result<(), String> {
        let call = Call::try_parse_from([&["lagrangian"], arguments].concat());
        call.map_err(|error| error.to_string())?.check()
    }

    #[test]
    fn what_is_said_twice_is_an_error() {
        let until = ["simulate", "a.machine", "--until", "1"];
        for (first, second) in [
            (["--set", "m=1"], ["--set", "m=2"]),
            (["--set", "m=1"], ["--set", " m =1"]),
            (["--const", "N=3"], ["--const", "N=4"]),
            (["--start", "q[2]=3"], ["--start", "q[2]=4"]),
            (["--rate", "q=3"], ["--rate", "q=4"]),
            (["--out", "a.csv"], ["--out", "b.csv"]),
            (["--tolerance", "1e-6"], ["--tolerance", "1e-7"]),
            (["--max-steps", "6"], ["--max-steps", "7"]),
        ] {
            let once = [&until[..], &first].concat();
            assert_eq!(checked(&once), Ok(()), "{first:?}");
            let twice = [&once[..], &second].concat();
            assert!(checked(&twice).is_err(), "{first:?} {second:?}");
        }
        // A coordinate and its rate are different, and so are a family and a member.
        let both = ["--start", "q=1", "--rate", "q=2", "--start", "q[2]=3"];
        assert_eq!(checked(&[&until[..], &both].concat()), Ok(()));
        let steady = ["modes", "a.machine", "--steady", "a=1", "--steady", "a"];
        assert!(checked(&steady).is_err());
        for option in ["--from", "--to"] {
            let call = ["brachistochrone", "a.machine", option, "a=1,b=2,a=3"];
            assert!(checked(&call).is_err());
        }
        let library = ["library", "a.machine", "--out", "a.so", "--lanes", "2,4,2"];
        assert!(checked(&library).is_err());
    }

    #[test]
    fn an_assignment_has_a_name() {
        assert_eq!(
            assignment("q[3]=0.5"),
            Ok(Assignment {
                name: "q[3]".into(),
                value: "0.5".into()
            })
        );
        assert!(assignment("q= ").is_err());
        assert!(assignment("omega").is_err());
        assert!(assignment("=3").is_err());
    }

    /// Values by the definitions of the units; `None` is an error whose message contains these words.
    #[test]
    fn a_value_has_the_unit_of_its_name() {
        use std::f64::consts::{PI, TAU};
        let value = |text: &str, unit: &str| {
            let set = assignment(&format!("w={text}")).expect("an assignment");
            set.value("--set", unit)
        };
        for (text, unit, known) in [
            ("1500*rpm", "rad/s", 50.0 * PI),
            ("30*deg", "rad", PI / 6.0),
            ("-30*deg", "rad", -PI / 6.0),
            ("2*rev", "rad", 2.0 * TAU),
            ("3*cm", "mm", 30.0),
            ("36*km/h", "m/s", 10.0),
            ("90*deg/s", "rad/s", PI / 2.0),
            ("1500*rpm", "rpm", 1500.0),
            ("50*pi", "rad/s", 50.0 * PI),
            ("2*(1 + sqrt(4))", "m", 6.0),
            ("2.5e-3", "kg*m^2/s^2", 2.5e-3),
            ("1_000", "1", 1000.0),
        ] {
            let found = value(text, unit);
            let error = found.as_ref().map(|found| (found - known).abs());
            assert!(
                error.is_ok_and(|error| error <= 1e-15 * known.abs()),
                "{text}: {found:?}"
            );
        }
        for (text, unit, words) in [
            ("3*m", "rad/s", "--set w=3*m: expected rad/s, found m"),
            ("5*Hz", "rad/s", "expected rad/s, found Hz"),
            ("3*mm", "1", "found m"),
            ("two", "m", "nothing is named `two`"),
            ("t", "s", "cannot depend on time"),
            ("1/0", "m", "zero"),
            ("1e999", "m", "number"),
            ("nan", "m", "nothing is named `nan`"),
            ("inf", "m", "nothing is named `inf`"),
            ("2*", "m", "expected"),
            ("30 deg", "rad", "30*deg"),
            ("--", "m", "expected"),
            ("1 } bodies {", "m", "expected"),
            ("(1, 2)", "m", "a number is expected here"),
            ("1500*rmp", "rad/s", "did you mean the unit `rpm`?"),
        ] {
            let found = value(text, unit).expect_err(text);
            assert!(found.contains(words), "{text}: {found}");
        }
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Call::command().debug_assert();
    }
}
