//! The tables that the C runtime reads besides the equations: defaults, names, the start.

use std::fmt::Write as _;

use lagrangian_program::Program;
use lagrangian_units::rate_name;

use super::Unit;
use crate::call::UnitKind;

/// The tables, which follow the machine's own file.
pub fn text(unit: &Unit<'_>) -> String {
    let program = unit.program;
    let starts: Vec<f64> = unit.start.iter().map(|(x, _)| *x).collect();
    let is_given = unit
        .start
        .iter()
        .map(|(_, given)| u8::from(*given).to_string());
    let names = program.coordinates.iter().map(|slot| slot.name.to_string());
    let facts = program.assumptions.iter().map(|fact| fact.text.clone());
    let strict = program.assumptions.iter();
    let strict = strict.map(|fact| u8::from(fact.strict).to_string());
    let mut text = String::from(
        "\n/* Values until somebody sets others; in the units of the description. */\n",
    );
    numbers(
        &mut text,
        "PARAMETER_DEFAULTS",
        unit.machine.parameter_values(),
    );
    numbers(&mut text, "INPUT_DEFAULTS", &unit.inputs);
    text.push_str("\n/* Where states start that do not follow the parameters. */\n");
    numbers(&mut text, "START", &starts);
    list(&mut text, "unsigned char", "START_IS_SET", is_given, "0");
    text.push_str("\n/* For messages. */\n");
    let quoted = |text: String| quoted(&text);
    list(
        &mut text,
        "char *const",
        "COORDINATE_NAMES",
        names.map(quoted),
        "0",
    );
    list(
        &mut text,
        "char *const",
        "FACT_TEXTS",
        facts.map(quoted),
        "0",
    );
    list(&mut text, "unsigned char", "FACT_IS_STRICT", strict, "0");
    let coordinates = program.coordinates.iter().enumerate();
    let angles: Vec<String> = coordinates
        .filter(|(_, slot)| slot.unit.is_one())
        .map(|(index, _)| index.to_string())
        .collect();
    let events = unit.events.iter().map(|event| event.name.clone());
    list(
        &mut text,
        "char *const",
        "EVENT_NAMES",
        events.map(quoted),
        "0",
    );
    text.push_str("\n/* Which start values stay where the start does not obey the constraints, and which constraints are of positions. */\n");
    let kept = kept(program).into_iter().map(|x| u8::from(x).to_string());
    list(&mut text, "unsigned char", "IS_KEPT", kept, "0");
    let holonomic = program.constraints.iter();
    let holonomic = holonomic.map(|constraint| u8::from(constraint.holonomic).to_string());
    list(&mut text, "unsigned char", "IS_HOLONOMIC", holonomic, "0");
    text.push_str("\n/* Which coordinates are angles, or pure numbers, which may be angles. */\n");
    let _ = writeln!(text, "enum {{ ANGLES = {} }};", angles.len()); // writing to a String cannot fail
    list(&mut text, "int", "ANGLE", angles.into_iter(), "0");
    if let Some(run) = &unit.run {
        text.push_str("\n/* The motion is that of a run: see the runtime. */\n#define HAS_RUN\n");
        let _ = writeln!(text, "enum {{ CONTACTS = {} }};", run.contacts.len()); // cannot fail
    } else {
        text.push_str("\nenum { CONTACTS = 0 };\n");
    }
    let has = |kind| u8::from(unit.kinds.contains(&kind));
    let _ = write!(
        text,
        "\n/* How many of the last outputs are formulas of events. */\nenum {{ EVENTS = {} }};\n\n\
         enum {{ HAS_MODEL_EXCHANGE = {}, HAS_CO_SIMULATION = {} }};\n\n#define TOLERANCE {:?}\n",
        unit.events.len(),
        has(UnitKind::ModelExchange),
        has(UnitKind::CoSimulation),
        unit.tolerance
    ); // writing to a String cannot fail
    text
}

/// For each state whether the projection onto the constraints keeps its start.
fn kept(program: &Program) -> Vec<bool> {
    let coordinates = program.coordinates.iter();
    let names = coordinates.map(|slot| slot.name.to_string());
    let names: Vec<String> = names.collect();
    let rates = names.iter().map(|name| rate_name(name, ""));
    let all: Vec<String> = names.iter().cloned().chain(rates).collect();
    all.iter().map(|name| program.kept.contains(name)).collect()
}

fn numbers(text: &mut String, name: &str, values: &[f64]) {
    list(
        text,
        "double",
        name,
        values.iter().map(|x| format!("{x:?}")),
        "0.0",
    );
}

/// An array with one extra entry, because C has no empty arrays.
fn list(
    text: &mut String,
    of: &str,
    name: &str,
    entries: impl Iterator<Item = String>,
    last: &str,
) {
    let entries: Vec<String> = entries.chain([last.to_owned()]).collect();
    let _ = writeln!(
        text,
        "static const {of} {name}[] = {{{}}};",
        entries.join(", ")
    ); // writing to a String cannot fail
}

/// A C string literal in ASCII.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for byte in text.bytes() {
        match byte {
            b'"' | b'\\' => {
                quoted.push('\\');
                quoted.push(char::from(byte));
            }
            b' '..=b'~' => quoted.push(char::from(byte)),
            // Always three digits, so that a digit after the escape is not taken as part of it.
            byte => {
                let _ = write!(quoted, "\\{byte:03o}"); // writing to a String cannot fail
            }
        }
    }
    // Prevents trigraphs.
    quoted.push('"');
    quoted.replace("??", "?\\?")
}

/// The token of a machine: the 128-bit FNV-1a hash of its text, formatted as a GUID (G. Fowler, L. C. Noll, K.-P. Vo, D.
/// Eastlake, *The FNV Non-Cryptographic Hash Algorithm*).
pub fn token(texts: &[&str]) -> String {
    const BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    let bytes = texts.iter().flat_map(|text| text.bytes());
    let step = |hash: u128, byte: u8| (hash ^ u128::from(byte)).wrapping_mul(PRIME);
    let digits = format!("{:032x}", bytes.fold(BASIS, step));
    let part = |from: usize, to: usize| digits.get(from..to).unwrap_or_default();
    format!(
        "{{{}-{}-{}-{}-{}}}",
        part(0, 8),
        part(8, 12),
        part(12, 16),
        part(16, 20),
        part(20, 32)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The authors' 128-bit test vector for "a".
    #[test]
    fn the_hash_is_that_of_its_authors() {
        assert_eq!(token(&["a"]), "{d228cb69-6f1a-8caf-7891-2b704e4a8964}");
    }

    #[test]
    fn a_literal_has_plain_letters() {
        assert_eq!(quoted("a\"\\θ1??/"), "\"a\\\"\\\\\\316\\2701?\\?/\"");
    }
}
