//! The motion as the page stores it: as few states as show it, in 32 bits.
//!
//! Between two stored states the page takes the cubic through positions and velocities, whose error falls as the fourth
//! power of the interval. States are recorded closely, and every other one is left out as long as the cubic finds it again.

use std::fmt::Write;

use crate::recording::{Column, Kind, ROUNDING, Recording, extent};

/// What the states may fill, in bytes before they are encoded.
const STATE_BYTES: usize = 1_050_000;

/// More states than this show nothing more.
const MOST: usize = 65_536;

/// As few as this would make curves of straight lines.
const FEWEST: usize = 256;

/// How far the cubic may be from the motion: as a part of what the coordinate spans, a quarter of a pixel of a large plot;
/// and of what the rate spans. It need not follow rounding.
const POSITION: f64 = 2e-4;
const RATE: f64 = 2e-3;

/// An angle may be wrong by this much, however many turns it makes, in rad.
const ANGLE: f64 = 2e-4;

/// How many states a page holds of a machine with so many coordinates.
pub fn most(coordinates: usize) -> usize {
    (STATE_BYTES / (8 * coordinates.max(1))).clamp(2, MOST)
}

/// How many times more often than every `interval` a run of that length is to be recorded for a page. A power of two where
/// others read the record, too: then the instants of the coarser one are among those of the finer to the last bit.
pub fn finer(coordinates: usize, length: f64, interval: f64, shared: bool) -> u32 {
    let fits = (most(coordinates) as f64 * (interval / length).abs()).min(1e6) as u32;
    // At least the record itself, however fine.
    let fits = fits.max(1);
    if shared { 1 << fits.ilog2() } else { fits }
}

/// The states of a page.
pub struct Samples {
    /// The recorded instants that are kept: every so many, and the last.
    pub stride: usize,
    /// Their number.
    pub count: usize,
    /// The greatest error of the cubic between them, as a part of what coordinates of that unit span.
    pub error: f64,
    /// `q` and `v` of one instant after the other, as 32-bit numbers in little-endian order, in base 64.
    pub states: String,
}

impl Samples {
    /// Chooses the states.
    pub fn new(recording: &Recording) -> Samples {
        let rows = recording.times.len();
        let q: Vec<&Column> = recording.of_kind(Kind::Coordinate).collect();
        let v: Vec<&Column> = recording.of_kind(Kind::Rate).collect();
        let most = most(q.len());
        let count = |stride: usize| rows.saturating_sub(1).div_ceil(stride) + 1;
        let mut stride = 1;
        while count(stride) > most.max(3) {
            stride *= 2;
        }
        // The last instant is not on the grid.
        let grid = rows.saturating_sub(1);
        let motion = Motion::new(&recording.times[..grid], &q, &v);
        while count(2 * stride) >= FEWEST && motion.finds_again(2 * stride) {
            stride *= 2;
        }
        let kept = recording.each(stride);
        let columns = || {
            let of = |kind| kept.of_kind(kind);
            of(Kind::Coordinate).chain(of(Kind::Rate))
        };
        let mut bytes = Vec::with_capacity(kept.times.len() * columns().count() * 4);
        for row in 0..kept.times.len() {
            for column in columns() {
                let value = column.values.get(row).copied().unwrap_or(f64::NAN);
                bytes.extend((value as f32).to_le_bytes());
            }
        }
        Samples {
            stride,
            count: kept.times.len(),
            error: motion.error(stride),
            states: base64(&bytes),
        }
    }
}

/// The recorded motion, and what each quantity spans.
struct Motion<'a> {
    times: &'a [f64],
    quantities: Vec<Quantity<'a>>,
}

struct Quantity<'a> {
    q: &'a [f64],
    v: &'a [f64],
    /// What is allowed.
    position: f64,
    rate: f64,
    /// By what an error of the coordinate is measured: the most that any of its unit spans, unless that is rounding.
    measure: f64,
}

impl<'a> Motion<'a> {
    fn new(times: &'a [f64], q: &[&'a Column], v: &[&'a Column]) -> Motion<'a> {
        // Of all columns with the unit of this one: the most that one spans, and what is rounding there.
        let measure = |columns: &[&'a Column], unit: &str| {
            let same = columns.iter().filter(|column| column.unit == unit);
            let sizes = same.map(|column| (span(&column.values), largest(&column.values)));
            let (spans, sizes): (Vec<f64>, Vec<f64>) = sizes.unzip();
            let rounding = ROUNDING * sizes.into_iter().fold(1.0, f64::max);
            (spans.into_iter().fold(rounding, f64::max), rounding)
        };
        let quantity = |(column, rates): (&&'a Column, &&'a Column)| {
            let span = span(&column.values);
            let position = match column.unit.as_str() {
                "rad" => (POSITION * span).min(ANGLE),
                _ => POSITION * span,
            };
            let (measure_of_unit, rounding) = measure(q, &column.unit);
            let (_, rounding_of_rates) = measure(v, &rates.unit);
            Quantity {
                q: &column.values,
                v: &rates.values,
                position: position.max(rounding),
                rate: (RATE * span_of_rates(&rates.values)).max(rounding_of_rates),
                measure: measure_of_unit,
            }
        };
        Motion {
            times,
            quantities: q.iter().zip(v).map(quantity).collect(),
        }
    }

    /// Whether the middle of every `stride` instants is where the cubic through its ends has it.
    fn finds_again(&self, stride: usize) -> bool {
        self.quantities.iter().all(|quantity| {
            self.middles(stride).all(|[a, m, b]| {
                let (q, v) = quantity.middle([a, b], self.times);
                let (there, rate) = (quantity.q[m], quantity.v[m]);
                (q - there).abs() <= quantity.position && (v - rate).abs() <= quantity.rate
            })
        })
    }

    /// The greatest error in a middle, as a part of what coordinates of that unit span. Where nothing is left out it is estimated from
    /// every other instant: the cubic is of order 4.
    fn error(&self, stride: usize) -> f64 {
        if stride < 2 {
            return self.error(2) / 16.0;
        }
        let of = |quantity: &Quantity| {
            let errors = self.middles(stride).map(|[a, m, b]| {
                let (q, _) = quantity.middle([a, b], self.times);
                (q - quantity.q[m]).abs()
            });
            errors.fold(0.0, f64::max) / quantity.measure
        };
        self.quantities.iter().map(of).fold(0.0, f64::max)
    }

    /// Beginning, middle and end of every `stride` instants.
    fn middles(&self, stride: usize) -> impl Iterator<Item = [usize; 3]> {
        let rows = if stride < 2 { 0 } else { self.times.len() };
        let starts = (0..rows).step_by(stride.max(1));
        let parts = starts.map(move |a| [a, a + stride / 2, a + stride]);
        parts.take_while(move |[_, _, b]| *b < rows)
    }
}

impl Quantity<'_> {
    /// The cubic through two instants, and its slope, in the middle between them.
    fn middle(&self, [a, b]: [usize; 2], times: &[f64]) -> (f64, f64) {
        let h = times[b] - times[a];
        let (q0, q1, v0, v1) = (self.q[a], self.q[b], self.v[a], self.v[b]);
        (
            0.5 * (q0 + q1) + 0.125 * h * (v0 - v1),
            1.5 * (q1 - q0) / h - 0.25 * (v0 + v1),
        )
    }
}

fn span(values: &[f64]) -> f64 {
    extent(values.iter().copied()).map_or(0.0, |[low, high]| high - low)
}

fn largest(values: &[f64]) -> f64 {
    extent(values.iter().map(|value| value.abs())).map_or(0.0, |[_, largest]| largest)
}

/// A constant rate spans nothing, and is still only known to roundoff of what it is made from.
fn span_of_rates(values: &[f64]) -> f64 {
    span(values).max(1e-6 * largest(values))
}

/// 32-bit numbers in little-endian order, in base 64.
pub fn encoded(values: impl IntoIterator<Item = f64>) -> String {
    let bytes = values.into_iter().map(|value| (value as f32).to_le_bytes());
    base64(&bytes.flatten().collect::<Vec<u8>>())
}

/// Base 64 with `+` and `/`, padded: RFC 4648, section 4.
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let byte = |i: usize| part.get(i).copied().map_or(0, u32::from);
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * i)) as usize & 63];
            let _ = text.write_char(if i > part.len() {
                '='
            } else {
                char::from(letter)
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base64_is_that_of_the_standard() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    fn vibration(hertz: f64, rows: usize) -> Recording {
        let omega = std::f64::consts::TAU * hertz;
        let times: Vec<f64> = (0..=rows).map(|i| i as f64 / rows as f64).collect();
        let column = |kind, values| Column {
            name: "x".into(),
            unit: "m".into(),
            kind,
            values,
        };
        Recording {
            columns: vec![
                column(
                    Kind::Coordinate,
                    times.iter().map(|t| (omega * t).sin()).collect(),
                ),
                column(
                    Kind::Rate,
                    times.iter().map(|t| omega * (omega * t).cos()).collect(),
                ),
            ],
            times,
        }
    }

    /// The cubic is wrong by (ωh)⁴/384 of the amplitude, 2·10⁻⁴ of the span at ωh = 0.62; its slope by (ωh)³/(72√3) of ω
    /// off the middle: what is kept lies between that interval and half of it.
    #[test]
    fn as_many_states_are_kept_as_the_motion_needs() {
        for hertz in [1.0, 8.0, 40.0] {
            let recording = vibration(hertz, 16_000);
            let samples = Samples::new(&recording);
            let per_turn = samples.count as f64 / hertz;
            let needed = std::f64::consts::TAU / 0.62;
            let fewest = FEWEST as f64 / hertz;
            assert!(per_turn >= needed.max(fewest) * 0.99, "{hertz}: {per_turn}");
            assert!(per_turn <= 2.2 * needed.max(fewest), "{hertz}: {per_turn}");
            assert!(samples.error <= POSITION, "{hertz}: {}", samples.error);
        }
    }

    /// A second coordinate that rests but for rounding, which no cubic finds again, costs no states and is no error.
    #[test]
    fn rounding_is_not_followed() {
        let alone = vibration(1.0, 16_000);
        let mut both = alone.clone();
        for (kind, size) in [(Kind::Coordinate, 1e-16), (Kind::Rate, 1e-14)] {
            let values = (0..=16_000).map(|i| size * f64::from(i * i % 7));
            both.columns.push(Column {
                name: "y".into(),
                unit: "m".into(),
                kind,
                values: values.collect(),
            });
        }
        let (alone, both) = (Samples::new(&alone), Samples::new(&both));
        assert_eq!(both.count, alone.count);
        assert!((both.error - alone.error).abs() <= 1e-3 * alone.error);
    }

    /// Where there is no room for more, the error is told: (ωh)⁴/384 of the amplitude, half of the span.
    #[test]
    fn what_is_stored_too_coarsely_is_estimated() {
        let recording = vibration(400.0, 4000);
        let samples = Samples::new(&recording);
        assert_eq!(samples.stride, 1);
        let step = std::f64::consts::TAU * 400.0 / 4000.0;
        let truth = step.powi(4) / 768.0;
        assert!(
            (samples.error / truth - 1.0).abs() < 0.25,
            "{} {truth}",
            samples.error
        );
    }

    #[test]
    fn no_run_fills_more_than_its_share() {
        let recording = vibration(3000.0, 100_000);
        let samples = Samples::new(&recording);
        assert!(samples.count <= most(1) && samples.states.len() <= STATE_BYTES * 4 / 3 + 4);
    }

    #[test]
    fn a_page_is_recorded_as_often_as_it_has_room_for() {
        assert_eq!(finer(2, 5.0, 0.005, true), 64);
        assert_eq!(finer(9, 60.0, 0.06, true), 8);
        assert_eq!(finer(9, 60.0, 0.06, false), 14);
        assert_eq!(finer(2, 5.0, 1e-6, true), 1);
        for interval in [1e300, f64::INFINITY, f64::NAN] {
            assert!((1..=1_000_000).contains(&finer(2, 1.0, interval, true)));
        }
    }
}
