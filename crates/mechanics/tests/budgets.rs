//! What a text may cost: deep, wide and shared definitions end in equations or in a clear error,
//! within bounded memory and work, however large they are.
//!
//! Memory is counted by the allocator. Work is bounded by the same count: whatever any stage makes
//! it allocates, so bytes allocated altogether stand for time and are the same on every machine.

use allocation_counter::{AllocationInfo, measure};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::{Code, Report, Severity};
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::Dag;

/// The most memory, in bytes.
const MEMORY: u64 = 1 << 30;

/// The most bytes that are allocated altogether: 10 s at the gigabyte a second that derivation
/// allocates.
const WORK: u64 = 10 << 30;

/// Compiles a text; what was allocated, and the codes of the errors.
fn compile(text: &str) -> (AllocationInfo, Vec<Code>) {
    let mut codes = Vec::new();
    let used = measure(|| {
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let model = lagrangian_spec::model(
            &dag,
            "budget.machine",
            text,
            &[],
            &mut InMemory::new(),
            &mut sources,
            &mut report,
        );
        let compiled = model.and_then(|model| Compiled::new(model, &mut report));
        assert_eq!(compiled.is_none(), report.has_errors(), "{text}");
        let errors = report.diagnostics().into_iter().map(|d| d.code);
        codes = errors
            .filter(|code| code.severity() == Severity::Error)
            .collect();
    });
    (used, codes)
}

/// Compiles a text within the bounds; whether it was derived. If not, it is said to be too large.
fn is_derived(what: &str, text: &str) -> bool {
    let (used, codes) = compile(text);
    let megabytes = |bytes: u64| bytes >> 20;
    let (most, total) = (megabytes(used.bytes_max), megabytes(used.bytes_total));
    println!("{what}: {most} MB at once, {total} MB altogether, {codes:?}");
    assert!(used.bytes_max < MEMORY, "{what} takes {most} MB");
    assert!(used.bytes_total < WORK, "{what} allocates {total} MB");
    assert!(
        codes.iter().all(|code| *code == Code::TooLarge),
        "{what}: {codes:?}"
    );
    codes.is_empty()
}

/// One coordinate, and a body whose height is the last of `n` definitions, each made from the one
/// before.
fn chained(first: &str, rule: &str, n: usize) -> String {
    format!(
        "machine Chained in plane {{
            parameters {{ a: m = 1, k: 1 = 0.7 }}
            coordinates {{ x: m = 0.3 }}
            define {{ f[0] = {first}, f[i in 1..{n}] = {rule} }}
            bodies {{ b {{ mass: 1, at: (x, a*f[{n}]) }} }}
            gravity (0, -9.81);
        }}"
    )
}

/// Rules by which definitions grow.
const RULES: [(&str, &str, &str); 9] = [
    ("nested sines", "x/a", "sin(f[i-1])"),
    ("nested squares", "x/a", "f[i-1]^2 + k"),
    ("Horner's scheme", "k", "f[i-1]*x/a + k"),
    ("a continued fraction", "2 + x/a", "2 + k/f[i-1]"),
    (
        "products of sums",
        "x/a",
        "(f[i-1] + sin(x/a))*(f[i-1] + cos(x/a))/4",
    ),
    (
        "nested sums of two functions",
        "x/a",
        "sin(cos(f[i-1]) + f[i-1]*x/a)",
    ),
    (
        "a product of many factors",
        "2 + x/a",
        "f[i-1]*(2 + sin(i*x/a))/3",
    ),
    ("a sum of many terms", "x/a", "f[i-1] + sin(i*x/a)/i^2"),
    ("nested roots", "x/a", "sqrt(1 + f[i-1]^2)"),
];

#[test]
fn moderate_definitions_are_derived() {
    for (what, first, rule) in RULES {
        assert!(is_derived(what, &chained(first, rule, 60)), "{what}");
    }
}

#[test]
fn long_definitions_end_within_bounds() {
    for (what, first, rule) in RULES {
        is_derived(what, &chained(first, rule, 300));
    }
}

#[test]
fn the_longest_definitions_end_within_bounds() {
    let (what, first, rule) = RULES[0];
    assert!(!is_derived(what, &chained(first, rule, 40_000)), "{what}");
    // One coordinate and one body: nothing in this is large but its length.
    let (what, first, rule) = RULES[2];
    is_derived(what, &chained(first, rule, 10_000));
}

#[test]
fn products_of_many_factors_end_within_bounds() {
    is_derived(
        "500 factors",
        &chained("2 + x/a", "f[i-1]*(2 + sin(i*x/a))", 500),
    );
    is_derived(
        "500 thirds",
        &chained("2 + x/a", "f[i-1]*(2 + sin(i*x/a))/3", 500),
    );
}

#[test]
fn coordinates_that_all_depend_on_each_other_end_within_bounds() {
    let dense = |n: usize| {
        format!(
            "machine Dense in plane {{
                parameters {{ a: m = 1 }}
                coordinates {{ q[1..{n}]: rad = 0.1 }}
                define {{ s[0] = 2, s[i in 1..{n}] = s[i-1]*(2 + sin(q[i])) }}
                bodies {{ b[i in 1..{n}] {{ mass: 1, at: (a*s[{n}]*i, a*q[i]) }} }}
            }}"
        )
    };
    assert!(is_derived("10 dense coordinates", &dense(10)));
    assert!(is_derived("100 dense coordinates", &dense(100)));
    is_derived("256 dense coordinates", &dense(256));
}

#[test]
fn many_constraints_end_within_bounds() {
    let constrained = |n: usize| {
        format!(
            "machine Held in plane {{
                parameters {{ a: m = 1 }}
                coordinates {{ x: m = 0.3, y: m }}
                bodies {{ b {{ mass: 1, at: (x, y) }} }}
                constraints {{ c[i in 1..{n}]: sin(i*x/a) = sin(0.3*i) + y/a }}
            }}"
        )
    };
    is_derived("200 constraints", &constrained(200));
    is_derived("2000 constraints", &constrained(2000));
}
