//! Pages that hold code cannot be written.

use std::sync::Arc;

use lagrangian_jit::{Level, Library, SeriesCode};

use super::library::{defaults, program_and_series};

#[test]
#[cfg(target_os = "linux")]
fn no_page_is_writable_and_executable_at_once() {
    if Level::here().is_none() {
        println!("no machine code on this processor, or not in this build");
        return;
    }
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../machines/double_pendulum.machine"
    );
    let (program, series) = program_and_series(path);
    let program = Arc::new(program);
    assert!(!defaults(&program).is_empty());
    let library = Library::new(program.clone()).expect("there are pages");
    let mut codes: Vec<_> = program
        .functions
        .iter()
        .map(|function| {
            library
                .code(function.role)
                .expect("it compiles")
                .addresses()
        })
        .collect();
    let series = SeriesCode::new(&series.expect("it has a series")).expect("it compiles");
    codes.extend(series.addresses());
    let maps = std::fs::read_to_string("/proc/self/maps").expect("Linux has it");
    let mut found = 0;
    for line in maps.lines() {
        let (range, rest) = line.split_once(' ').expect("a range, then its rights");
        let (from, to) = range.split_once('-').expect("two addresses");
        let number = |text: &str| usize::from_str_radix(text, 16).expect("a number");
        let (from, to) = (number(from), number(to));
        let rights = rest.split(' ').next().unwrap_or_default();
        assert!(
            !(rights.contains('w') && rights.contains('x')),
            "writable and executable: {line}"
        );
        for code in &codes {
            if from <= code.start && code.start < to {
                assert!(code.end <= to, "{line}");
                assert!(rights.starts_with("r-x"), "{line}");
                found += 1;
            }
        }
    }
    assert_eq!(
        found,
        codes.len(),
        "every function lies in pages of its own"
    );
}
