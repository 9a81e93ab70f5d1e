//! The cost of a text: deep, wide and shared definitions end in equations or in a clear error, with bounded memory
//! and work, however large they are.
//!
//! The allocator counts the memory. The same count bounds the work: every stage allocates in proportion to its work,
//! so the total of allocated bytes stands for time and is the same on every computer.

use allocation_counter::{AllocationInfo, measure};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::{Code, Report, Severity};
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::Dag;

/// The bound on the memory in use, in bytes.
const MEMORY: u64 = 1 << 30;

/// The bound on the total of allocated bytes: 10 s at the gigabyte per second that derivation allocates.
const WORK: u64 = 10 << 30;

/// Compiles a text and returns the allocations and the codes of the errors.
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

/// Compiles a text within the bounds and returns whether it was derived; the only error may be that it is too large.
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

/// A machine with one coordinate and a body whose height is the last of `n` definitions,
/// each made from the one before.
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

/// Rules by which the definitions grow: a name, the first definition, and the next one.
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
    // A machine with one coordinate and one body, of which only the chain of definitions is long.
    let (what, first, rule) = RULES[2];
    is_derived(what, &chained(first, rule, 10_000));
}

/// The longest chains that `docs/limits.md` names, and longer ones, which are refused.
#[test]
#[ignore = "15 s of work, for the figures in docs/limits.md"]
fn the_longest_chains_that_are_derived() {
    for ((what, first, rule), n, more) in [(RULES[2], 20_000, 25_000), (RULES[3], 6_000, 7_000)] {
        assert!(is_derived(what, &chained(first, rule, n)), "{what}");
        assert!(!is_derived(what, &chained(first, rule, more)), "{what}");
    }
}

/// Definitions nested four times as deep take four times the memory and work, not sixteen times.
#[test]
fn nested_definitions_take_memory_in_proportion() {
    for (what, first, rule) in [RULES[0], RULES[3], RULES[5]] {
        let [short, long] = [150, 600].map(|n| {
            let (used, codes) = compile(&chained(first, rule, n));
            assert!(codes.is_empty(), "{what}: {codes:?}");
            [used.bytes_max, used.bytes_total]
        });
        println!("{what}: {short:?} and {long:?} bytes");
        for (short, long) in short.into_iter().zip(long) {
            assert!(long < 6 * short, "{what}: {long} bytes after {short}");
        }
    }
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

/// Discs that may all touch each other, in a bowl: so many, and as many contacts as there are pairs and discs.
fn pile(discs: usize) -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = path.join("../../machines/contacts/pile.machine");
    let text = std::fs::read_to_string(path).expect("the library is there");
    assert!(text.contains("N = 20"));
    text.replace("N = 20", &format!("N = {discs}"))
}

/// Four times as many contacts take about four times the memory and work; only their rows have as many columns as there are coordinates.
#[test]
fn contacts_take_memory_in_proportion() {
    let [few, many] = [20, 40].map(|discs| {
        let (used, codes) = compile(&pile(discs));
        assert!(codes.is_empty(), "{discs} discs: {codes:?}");
        [used.bytes_max, used.bytes_total]
    });
    println!("210 contacts: {few:?} bytes; 820: {many:?}");
    for (few, many) in few.into_iter().zip(many) {
        // 820/210 for what is proportional, twice that for rows.
        assert!(many < 6 * few, "{many} bytes after {few}");
    }
}

/// Spheres with three angles each, whose contacts have the longest formulas: the bound on the size of equations comes before that on contacts.
fn spheres(count: usize) -> String {
    format!(
        "machine Spheres in space {{
            constants {{ N = {count} }}
            parameters {{ m: kg = 0.05, r: m = 0.05, d: m = 0.12, mu: 1 = 0.3 }}
            coordinates {{
                x[i in 1..N]: m = d*i, y[i in 1..N]: m, z[i in 1..N]: m = 0.1*d*i,
                a[i in 1..N]: rad, b[i in 1..N]: rad = 0.5, c[i in 1..N]: rad,
            }}
            frames {{ axes[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(x, a[i]).turn(y, b[i]).turn(z, c[i]) }}
            bodies {{ ball[i in 1..N] {{ mass: m, inertia: (0.4*m*r^2, 0.4*m*r^2, 0.4*m*r^2), frame: axes[i] }} }}
            spheres {{ s[i in 1..N] {{ on: ball[i], center: (0, 0, 0), radius: r }} }}
            contacts {{ pair {{ spheres: s, restitution: 0, friction: mu }} }}
        }}"
    )
}

#[test]
fn many_long_contacts_end_within_bounds() {
    assert!(is_derived("120 contacts of spheres", &spheres(16)));
    assert!(!is_derived("861 contacts of spheres", &spheres(42)));
}

/// The most contacts that `docs/limits.md` names, and more, which are refused.
#[test]
#[ignore = "10 s of work, for the figures in docs/limits.md"]
fn the_most_contacts_that_are_derived() {
    assert!(is_derived("3655 contacts", &pile(85)));
    assert!(!is_derived("4005 contacts", &pile(90)));
    for count in [20, 24, 28, 32] {
        is_derived(&format!("{count} spheres"), &spheres(count));
    }
}

/// Words that are put into damaged texts, in addition to their own words.
const WORDS: [&str; 30] = [
    "0", "1", "-1", "1/0", "1e9", "1e308", "-", "+", "*", "/", "^", "(", ")", "[", "]", "{", "}",
    ",", "..", "t", "pi", "N", "der", "sqrt", "norm", "ground", ".at", ".turn", "500", "é",
];

/// A machine of the library with a few words left out, doubled, exchanged or replaced, or with a few letters damaged.
fn damaged(text: &str, random: &mut impl FnMut(usize) -> usize) -> String {
    if random(4) == 0 {
        let mut letters: Vec<char> = text.chars().collect();
        for _ in 0..=random(4) {
            let (at, other) = (random(letters.len()), random(letters.len()));
            match random(3) {
                0 => drop(letters.remove(at)),
                1 => letters.swap(at, other),
                _ => letters[at] = char::from_u32(random(0x2_0000) as u32).unwrap_or('\0'),
            }
        }
        return letters.into_iter().collect();
    }
    let mut report = Report::new();
    let tokens = lagrangian_spec::token::lex(Default::default(), text, &mut report);
    let mut words: Vec<&str> = tokens
        .iter()
        .map(|token| &text[token.span.start as usize..token.span.end as usize])
        .collect();
    for _ in 0..=random(3) {
        let (at, other) = (random(words.len()), random(words.len()));
        match random(5) {
            0 => drop(words.remove(at)),
            1 => words.insert(at, words[at]),
            2 => words.swap(at, other),
            3 => words[at] = words[other],
            _ => words[at] = WORDS[random(WORDS.len())],
        }
    }
    words.join(" ")
}

/// `SEED=… DAMAGES=…` repeats a seed with this many damaged texts.
#[test]
fn damaged_machines_end_within_bounds() {
    let number = |name: &str| std::env::var(name).ok().and_then(|n| n.parse::<u64>().ok());
    let clock = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let clock = clock.map_or(1, |clock| clock.as_nanos() as u64);
    let (seed, count) = (
        number("SEED").unwrap_or(clock),
        number("DAMAGES").unwrap_or(60),
    );
    println!("SEED={seed}");
    let machines = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let files = std::fs::read_dir(machines).expect("the library is there");
    let mut texts: Vec<(std::path::PathBuf, String)> = files
        .filter_map(|file| Some(file.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "machine"))
        .filter_map(|path| Some((path.clone(), std::fs::read_to_string(path).ok()?)))
        // Other machines take seconds if the damage leaves them valid.
        .filter(|(_, text)| text.len() < 4000 && !text.contains("const"))
        .collect();
    texts.sort();
    assert!(texts.len() > 10);
    let mut state = seed;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut derived = 0;
    for round in 0..count {
        let (path, text) = &texts[random(texts.len())];
        let text = damaged(text, &mut random);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let outcome = std::panic::catch_unwind(|| compile(&text));
        let what = || format!("round {round} of SEED={seed}, {name}:\n{text}");
        let Ok((used, codes)) = outcome else {
            panic!("{}", what());
        };
        assert!(
            used.bytes_max < MEMORY,
            "{} bytes: {}",
            used.bytes_max,
            what()
        );
        assert!(
            used.bytes_total < WORK,
            "{} bytes: {}",
            used.bytes_total,
            what()
        );
        assert!(!codes.contains(&Code::Internal), "{}", what());
        derived += usize::from(codes.is_empty());
    }
    println!("{derived} of {count} were derived");
}
