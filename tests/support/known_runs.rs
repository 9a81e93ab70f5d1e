//! Runs whose end states are known to 30 digits, read from `tests/data/references/`, and the
//! errors of computed end states.

use lagrangian_scalar::DoubleDouble;
use lagrangian_symbolic::Rational;

/// A run of a machine from a start.
pub struct KnownRun {
    /// The file name of the machine in `machines/`.
    pub machine: String,
    /// Parameters and constants that differ from their defaults.
    pub settings: Vec<(String, f64)>,
    /// The end time, in s.
    pub until: f64,
    /// Coordinates, then rates, at the start.
    pub start: Vec<f64>,
    /// Coordinates, then rates, at the end.
    pub end: Vec<DoubleDouble>,
    /// The scale of each number: an error is relative to this plus the number's size.
    scales: Vec<f64>,
}

impl KnownRun {
    /// Reads the run of this name.
    pub fn named(name: &str) -> Self {
        let folder = super::root().join("tests/data/references");
        let path = format!("{}/{name}.txt", folder.display());
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        Self::read(&text)
    }

    /// Parses a file: each line begins with the name of its content, and the lines after `end` hold one number each.
    fn read(text: &str) -> Self {
        let mut run = Self {
            machine: String::new(),
            settings: Vec::new(),
            until: f64::NAN,
            start: Vec::new(),
            end: Vec::new(),
            scales: Vec::new(),
        };
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("machine") => {
                    run.machine = words.next().expect("a machine").to_owned();
                    let settings = words.filter_map(|word| word.split_once('='));
                    run.settings = settings
                        .map(|(name, x)| (name.to_owned(), number(x)))
                        .collect();
                }
                Some("until") => run.until = words.map(number).sum(),
                Some("start") => run.start = words.map(number).collect(),
                Some("scales") => run.scales = words.map(number).collect(),
                Some("end") => {}
                Some(digits) => run.end.push(exact(digits)),
                None => {}
            }
        }
        if run.scales.is_empty() {
            run.scales = vec![1.0; run.end.len()];
        }
        assert_eq!(run.start.len(), run.end.len());
        assert_eq!(run.scales.len(), run.end.len());
        run
    }

    /// The greatest `|y − exact| / (scale + |exact|)` over the numbers of an end state, given
    /// as coordinates and then rates.
    pub fn error<'y>(&self, end: impl IntoIterator<Item = &'y f64>) -> f64 {
        let end: Vec<f64> = end.into_iter().copied().collect();
        assert_eq!(end.len(), self.end.len());
        let errors = end.iter().zip(&self.end).zip(&self.scales);
        errors
            .map(|((y, exact), scale)| {
                let off = DoubleDouble::from(*y) - *exact;
                off.hi().abs() / (scale + exact.hi().abs())
            })
            .fold(0.0, |worst, error| {
                if error.is_nan() {
                    f64::NAN
                } else {
                    f64::max(worst, error)
                }
            })
    }
}

fn number(word: &str) -> f64 {
    word.parse()
        .unwrap_or_else(|_| panic!("{word} is no number"))
}

fn exact(digits: &str) -> DoubleDouble {
    let number = Rational::parse_decimal(digits);
    number
        .unwrap_or_else(|| panic!("{digits} is no number"))
        .evaluate()
}
