//! The motion as stored on the page: as few states as needed, in 32 bits.
//!
//! Between two stored states the page interpolates by the Hermite cubic of coordinates and rates, whose error is of fourth
//! order in the interval. States are recorded densely, and every other one is dropped as long as the cubic reproduces it.

use std::fmt::Write;

use crate::recording::{Column, ColumnKind, ROUNDING, Recording, extent};

/// The most bytes for the states, before encoding.
const STATE_BYTES: usize = 1_050_000;

/// More states than this make no visible difference.
const MOST: usize = 65_536;

/// With fewer states than this curves would look like polygons.
const FEWEST: usize = 256;

/// The allowed error of the cubic: relative to the range of the coordinate, a quarter of a pixel of a large plot, and
/// relative to the range of the rate. Round-off need not be reproduced.
const POSITION: f64 = 2e-4;
const RATE: f64 = 2e-3;

/// The allowed error of an angle, in rad, however many turns it makes.
const ANGLE: f64 = 2e-4;

/// The most states that a page stores for a machine with this number of coordinates.
pub fn most(coordinates: usize) -> usize {
    (STATE_BYTES / (8 * coordinates.max(1))).clamp(2, MOST)
}

/// By which factor a run of this length must be recorded more densely than every `interval` for a page. It is a power of
/// two if the recording is shared, so that the coarser instants are exactly among the finer ones.
pub fn recording_refinement(coordinates: usize, length: f64, interval: f64, shared: bool) -> u32 {
    let fits = (most(coordinates) as f64 * (interval / length).abs()).min(1e6) as u32;
    // At least the recording itself, however dense.
    let fits = fits.max(1);
    if shared { 1 << fits.ilog2() } else { fits }
}

/// The stored states of a page.
pub struct Samples {
    /// The recorded instants that are kept: every `stride`-th one, and the last.
    pub stride: usize,
    /// The number of states.
    pub count: usize,
    /// The greatest interpolation error, relative to the range of coordinates with the same unit.
    pub error: f64,
    /// `q` and `v` of one instant after the other, as 32-bit numbers in little-endian order, in base 64.
    pub states: String,
    /// What was subtracted from each of them before; empty if that is 0 for all.
    pub bases: Vec<f64>,
}

impl Samples {
    /// Selects the states.
    pub fn new(recording: &Recording) -> Samples {
        let rows = recording.times.len();
        let q: Vec<&Column> = recording.of_kind(ColumnKind::Coordinate).collect();
        let v: Vec<&Column> = recording.of_kind(ColumnKind::Rate).collect();
        let most = most(q.len());
        let count = |stride: usize| rows.saturating_sub(1).div_ceil(stride) + 1;
        let mut stride = 1;
        while count(stride) > most.max(3) {
            stride *= 2;
        }
        // The last instant may not be on the grid.
        let grid = rows.saturating_sub(1);
        let motion = RecordedMotion::new(&recording.times[..grid], &q, &v);
        while count(2 * stride) >= FEWEST && motion.finds_again(2 * stride) {
            stride *= 2;
        }
        let thinned = recording.each(stride);
        let columns = || {
            let of = |kind| thinned.of_kind(kind);
            of(ColumnKind::Coordinate).chain(of(ColumnKind::Rate))
        };
        let mut bases: Vec<f64> = columns().map(|column| base(&column.values)).collect();
        let mut bytes = Vec::with_capacity(thinned.times.len() * columns().count() * 4);
        for row in 0..thinned.times.len() {
            for (column, base) in columns().zip(&bases) {
                let value = column.values.get(row).copied().unwrap_or(f64::NAN);
                bytes.extend(((value - base) as f32).to_le_bytes());
            }
        }
        if bases.iter().all(|base| *base == 0.0) {
            bases.clear();
        }
        Samples {
            stride,
            count: thinned.times.len(),
            error: motion.error(stride),
            states: base64(&bytes),
            bases,
        }
    }
}

/// Quantities whose range is below this fraction of their size, but more than round-off, are stored relative to the middle of the
/// range: 32 bits have seven digits, and a motion by 0.1 m at 6 378 km has none in them.
const NARROW: f64 = 0.01;

/// What is subtracted from values before they are rounded to 32 bits.
pub fn base(values: &[f64]) -> f64 {
    let Some([low, high]) = extent(values.iter().copied()) else {
        return 0.0;
    };
    let (span, size) = (high - low, low.abs().max(high.abs()));
    if (ROUNDING * size..NARROW * size).contains(&span) {
        low + span / 2.0
    } else {
        0.0
    }
}

/// The recorded motion, and the range of each quantity.
struct RecordedMotion<'a> {
    times: &'a [f64],
    quantities: Vec<Quantity<'a>>,
}

struct Quantity<'a> {
    q: &'a [f64],
    v: &'a [f64],
    /// The allowed errors of coordinate and rate.
    position: f64,
    rate: f64,
    /// The scale of an error: the largest range of a coordinate with the same unit, unless that is round-off.
    measure: f64,
}

impl<'a> RecordedMotion<'a> {
    fn new(times: &'a [f64], q: &[&'a Column], v: &[&'a Column]) -> RecordedMotion<'a> {
        // Over all columns with the unit of this one: the largest range, and the round-off.
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
        RecordedMotion {
            times,
            quantities: q.iter().zip(v).map(quantity).collect(),
        }
    }

    /// Whether the cubic through the ends of every `stride` instants reproduces their middle.
    fn finds_again(&self, stride: usize) -> bool {
        self.quantities.iter().all(|quantity| {
            self.middles(stride).all(|[a, m, b]| {
                let (q, v) = quantity.middle([a, b], self.times);
                let (there, rate) = (quantity.q[m], quantity.v[m]);
                (q - there).abs() <= quantity.position && (v - rate).abs() <= quantity.rate
            })
        })
    }

    /// The greatest error at a middle, relative to the range of coordinates with the same unit. If no instants are dropped it is
    /// estimated from every other instant, because the cubic is of order 4.
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

    /// The first, middle and last index of every `stride` instants.
    fn middles(&self, stride: usize) -> impl Iterator<Item = [usize; 3]> {
        let rows = if stride < 2 { 0 } else { self.times.len() };
        let starts = (0..rows).step_by(stride.max(1));
        let parts = starts.map(move |a| [a, a + stride / 2, a + stride]);
        parts.take_while(move |[_, _, b]| *b < rows)
    }
}

impl Quantity<'_> {
    /// The value and the slope of the cubic through two instants, half-way between them.
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

/// The range of rates: a constant rate has no range, and is only known to its round-off.
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

    /// An orbit's height above its mean is kept in 32 bits relative to the radius; what is wide, constant or round-off is stored as it is.
    #[test]
    fn what_varies_little_far_from_zero_has_a_base() {
        let radii = [6_377_999.9, 6_378_000.1, f64::NAN, 6_378_000.05];
        let base = base(&radii);
        assert!((base - 6_378_000.0).abs() < 1e-8, "{base}");
        for radius in radii.into_iter().filter(|radius| radius.is_finite()) {
            let stored = (radius - base) as f32;
            assert!((base + f64::from(stored) - radius).abs() < 1e-8, "{radius}");
        }
        for values in [
            &[-1.0, 2.0][..],
            &[5.0, 5.0],
            &[300.0, 300.0 + 1e-13],
            &[f64::NAN],
            &[],
        ] {
            assert_eq!(super::base(values), 0.0, "{values:?}");
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
                    ColumnKind::Coordinate,
                    times.iter().map(|t| (omega * t).sin()).collect(),
                ),
                column(
                    ColumnKind::Rate,
                    times.iter().map(|t| omega * (omega * t).cos()).collect(),
                ),
            ],
            times,
        }
    }

    /// The error of the cubic is (ωh)⁴/384 of the amplitude, 2·10⁻⁴ of the range at ωh = 0.62; that of its slope, away
    /// from the middle, is (ωh)³/(72√3) of ω. The stored interval lies between that one and half of it.
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

    /// A second coordinate at rest within round-off, which no cubic reproduces, requires no additional states and
    /// counts as exact.
    #[test]
    fn rounding_is_not_followed() {
        let alone = vibration(1.0, 16_000);
        let mut recording = alone.clone();
        for (kind, size) in [(ColumnKind::Coordinate, 1e-16), (ColumnKind::Rate, 1e-14)] {
            let values = (0..=16_000).map(|i| size * f64::from(i * i % 7));
            recording.columns.push(Column {
                name: "y".into(),
                unit: "m".into(),
                kind,
                values: values.collect(),
            });
        }
        let (alone, both) = (Samples::new(&alone), Samples::new(&recording));
        assert_eq!(both.count, alone.count);
        assert!((both.error - alone.error).abs() <= 1e-3 * alone.error);
    }

    /// If there is no room for more states, the error is reported: (ωh)⁴/384 of the amplitude, which is half of the range.
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
        assert_eq!(recording_refinement(2, 5.0, 0.005, true), 64);
        assert_eq!(recording_refinement(9, 60.0, 0.06, true), 8);
        assert_eq!(recording_refinement(9, 60.0, 0.06, false), 14);
        assert_eq!(recording_refinement(2, 5.0, 1e-6, true), 1);
        for interval in [1e300, f64::INFINITY, f64::NAN] {
            assert!((1..=1_000_000).contains(&recording_refinement(2, 1.0, interval, true)));
        }
    }
}
