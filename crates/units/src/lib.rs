//! Units: powers of kilogram, metre, second, ampere and kelvin, and of the cycle. The radian is 1.
//!
//! A radian must be 1 and not a unit of its own: `x - yc*theta` subtracts a length times an angle
//! from a length, as is customary in mechanics. A unit only records that a radian was written, so that
//! messages contain `rad/s` instead of `1/s`; two units that differ in nothing else are equal.
//!
//! A cycle is not a radian: Hz, which is cycle/s, and rad/s differ by 2π, and confusing them gives
//! results that are wrong by that factor. So the cycle is a base unit like metre and second, and a factor
//! `pi` cancels it: `2*pi*f` is in rad/s if `f` is in Hz, and `w/(2*pi)` is in Hz if `w` is in rad/s.
//!
//! A [`Measure`] is a unit as it is written, with its size in SI units: `km/h`, `deg`.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

use lagrangian_symbolic::Rational;

mod measure;
mod names;

pub use measure::Measure;
pub use names::{
    Compliance, ImpactLaw, ImpactOrder, Name, Painleve, Stages, Variable, integral_name, rate_name,
    rate_unit, state_of,
};

/// The base units.
const BASES: [&str; 6] = ["kg", "m", "s", "A", "K", "cycle"];

/// The index of the cycle in [`BASES`].
const CYCLE: usize = 5;

/// An SI unit, as powers of its base units.
///
/// Powers are stored doubled, so that the root of a unit is a unit: √(N/m/kg) is 1/s, and √m, which
/// may be an intermediate value in a formula, is not an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unit {
    /// Twice the powers of the base units.
    twice: [i16; BASES.len()],
    /// The power of the radian, only for display.
    radian: i8,
    /// The number of factors `pi` beside it that have not yet turned a cycle into radians.
    pi: i8,
    /// Whether part of it was not given in SI units, so that its number is not the one that was written.
    scaled: bool,
}

impl PartialEq for Unit {
    fn eq(&self, other: &Unit) -> bool {
        self.twice == other.twice
    }
}

impl Eq for Unit {}

impl PartialOrd for Unit {
    fn partial_cmp(&self, other: &Unit) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Unit {
    fn cmp(&self, other: &Unit) -> Ordering {
        self.twice.cmp(&other.twice)
    }
}

impl Hash for Unit {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.twice.hash(state);
    }
}

impl Unit {
    /// The unit of a pure number, and of an angle.
    pub const ONE: Unit = Unit::base(0, 0, 0);
    /// Kilogram.
    pub const KILOGRAM: Unit = Unit::base(1, 0, 0);
    /// Metre.
    pub const METRE: Unit = Unit::base(0, 1, 0);
    /// Second.
    pub const SECOND: Unit = Unit::base(0, 0, 1);
    /// Newton.
    pub const NEWTON: Unit = Unit::base(1, 1, -2);
    /// Joule, and newton metre.
    pub const JOULE: Unit = Unit::base(1, 2, -2);
    /// Watt.
    pub const WATT: Unit = Unit::base(1, 2, -3);
    /// Pascal.
    pub const PASCAL: Unit = Unit::base(1, -1, -2);
    /// Hertz: cycles per second.
    pub const HERTZ: Unit = Unit {
        twice: [0, 0, -2, 0, 0, 2],
        ..Unit::ONE
    };
    /// Radian: equal to [`Unit::ONE`].
    pub const RADIAN: Unit = Unit {
        radian: 1,
        ..Unit::ONE
    };
    /// Ampere.
    pub const AMPERE: Unit = Unit::electric(0, 0, 0, 1);
    /// Volt.
    pub const VOLT: Unit = Unit::electric(1, 2, -3, -1);
    /// Kelvin.
    pub const KELVIN: Unit = Unit::of_base(4);
    /// A counted turn: not an angle until it is multiplied by 2π.
    pub const TURN: Unit = Unit::of_base(CYCLE);

    /// kg^`kilogram` m^`metre` s^`second`.
    pub const fn base(kilogram: i16, metre: i16, second: i16) -> Unit {
        Unit::electric(kilogram, metre, second, 0)
    }

    /// kg^`kilogram` m^`metre` s^`second` A^`ampere`.
    pub const fn electric(kilogram: i16, metre: i16, second: i16, ampere: i16) -> Unit {
        Unit {
            twice: [2 * kilogram, 2 * metre, 2 * second, 2 * ampere, 0, 0],
            radian: 0,
            pi: 0,
            scaled: false,
        }
    }

    /// The base unit at an index.
    const fn of_base(place: usize) -> Unit {
        let mut twice = [0; BASES.len()];
        twice[place] = 2;
        Unit { twice, ..Unit::ONE }
    }

    /// The unit of a product.
    pub fn times(self, other: Unit) -> Unit {
        Unit {
            twice: zip(self.twice, other.twice, i16::saturating_add),
            radian: self.radian.saturating_add(other.radian),
            pi: self.pi.saturating_add(other.pi),
            scaled: self.scaled || other.scaled,
        }
        .turned()
    }

    /// The unit of a quotient.
    pub fn over(self, other: Unit) -> Unit {
        Unit {
            twice: zip(self.twice, other.twice, i16::saturating_sub),
            radian: self.radian.saturating_sub(other.radian),
            pi: self.pi.saturating_sub(other.pi),
            scaled: self.scaled || other.scaled,
        }
        .turned()
    }

    /// The unit of a product with π to a power.
    pub fn times_pi(self, power: i32) -> Unit {
        let power = i8::try_from(power).unwrap_or(0); // a power this large is meaningless
        Unit {
            pi: self.pi.saturating_add(power),
            ..self
        }
        .turned()
    }

    /// Each factor π cancels a cycle, and leaves a radian.
    fn turned(mut self) -> Unit {
        let cycles = self.twice[CYCLE] / 2;
        let turns = match (cycles > 0, self.pi > 0) {
            (true, true) => cycles.min(self.pi.into()),
            (false, false) => cycles.max(self.pi.into()),
            _ => 0,
        };
        self.twice[CYCLE] -= 2 * turns;
        let turns = turns as i8; // at most `pi`
        self.pi -= turns;
        self.radian = self.radian.saturating_add(turns);
        self
    }

    /// The unit of a power, `self^(numerator/denominator)`; `None` if the power of a base unit
    /// would not be a multiple of one half, or would be absurdly large.
    pub fn power(self, numerator: i64, denominator: i64) -> Option<Unit> {
        let mut twice = [0; BASES.len()];
        for (to, from) in twice.iter_mut().zip(self.twice) {
            let scaled = i64::from(from).checked_mul(numerator)?;
            if scaled.checked_rem(denominator)? != 0 {
                return None;
            }
            *to = i16::try_from(scaled / denominator).ok()?;
        }
        // Counts this large are meaningless and are dropped.
        let remembered = |count: i8| {
            let count = i64::from(count).saturating_mul(numerator);
            let is_integer = count.checked_rem(denominator) == Some(0);
            let count = i8::try_from(count.checked_div(denominator).unwrap_or(0));
            if is_integer { count.unwrap_or(0) } else { 0 }
        };
        let unit = Unit {
            twice,
            radian: remembered(self.radian),
            pi: remembered(self.pi),
            scaled: self.scaled,
        };
        Some(unit.turned())
    }

    /// Whether a value in this unit may be used where another unit is required: they are equal, or
    /// a quotient by `pi` turns radians into cycles.
    pub fn fits(self, other: Unit) -> bool {
        let cycles = |unit: Unit| i32::from(unit.twice[CYCLE]);
        let counted = |unit: Unit| cycles(unit) - 2 * i32::from(unit.pi);
        let alike = cycles(self) == cycles(other)
            || counted(self) == cycles(other)
            || cycles(self) == counted(other);
        alike && self.without_cycles() == other.without_cycles()
    }

    /// How many more cycles this unit has than another one that is otherwise equal.
    pub fn cycles_beyond(self, other: Unit) -> Option<i16> {
        let more = (self.twice[CYCLE] - other.twice[CYCLE]) / 2;
        (more != 0 && self.without_cycles() == other.without_cycles()).then_some(more)
    }

    fn without_cycles(mut self) -> Unit {
        self.twice[CYCLE] = 0;
        self
    }

    /// Whether it was written as an angle: `rad`, and no other pure number.
    pub fn is_angle(self) -> bool {
        self.is_one() && self.radian == 1
    }

    /// Whether part of it was not given in SI units.
    pub fn is_scaled(self) -> bool {
        self.scaled
    }

    /// This unit with a record of whether the quantity was given in other than SI units.
    pub fn as_written(self, scaled: bool) -> Unit {
        Unit { scaled, ..self }
    }

    /// The unit of a derivative with respect to time.
    pub fn rate(self) -> Unit {
        self.over(Unit::SECOND)
    }

    /// Twice the power of each base unit, by its name.
    pub fn twice_the_powers(self) -> [(&'static str, i16); BASES.len()] {
        std::array::from_fn(|k| (BASES[k], self.twice[k]))
    }

    /// Whether it is the unit of a pure number or an angle.
    pub fn is_one(self) -> bool {
        self == Unit::ONE
    }
}

type Powers = [i16; BASES.len()];

fn zip(mut a: Powers, b: Powers, operation: fn(i16, i16) -> i16) -> Powers {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = operation(*a, b));
    a
}

/// The unit in its customary form: `N/m`, `rad/s`, `kg*m^2`; `1` for a pure number.
impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const OWN_NAMES: [(&str, Unit); 15] = [
            ("N", Unit::NEWTON),
            ("N*m", Unit::JOULE),
            ("W", Unit::WATT),
            ("Pa", Unit::PASCAL),
            // Stiffness, linear damping and torsional damping.
            ("N/m", Unit::base(1, 0, -2)),
            ("N*s/m", Unit::base(1, 0, -1)),
            ("N*m*s", Unit::base(1, 2, -1)),
            ("Hz", Unit::HERTZ),
            ("V", Unit::VOLT),
            ("ohm", Unit::electric(1, 2, -3, -2)),
            ("H", Unit::electric(1, 2, -2, -2)),
            ("F", Unit::electric(-1, -2, 4, 2)),
            // The constants of a motor: torque per current, and voltage per angular velocity. Also the weber.
            ("N*m/A", Unit::electric(1, 2, -2, -1)),
            ("T", Unit::electric(1, 0, -2, -1)),
            ("C", Unit::electric(0, 0, 1, 1)),
        ];
        if let Some((name, _)) = OWN_NAMES.iter().find(|(_, unit)| unit == self) {
            return f.write_str(name);
        }
        let factor = |name: &str, twice: i16| match (twice, twice % 2) {
            (2, _) => name.to_owned(),
            (_, 0) => format!("{name}^{}", twice / 2),
            _ => format!("{name}^({twice}/2)"),
        };
        let powers = || BASES.into_iter().zip(self.twice);
        let mut over: Vec<String> = powers()
            .filter(|(_, twice)| *twice > 0)
            .map(|(name, twice)| factor(name, twice))
            .collect();
        let under = powers().filter(|(_, twice)| *twice < 0);
        // The radian is only worth showing in angles and their rates.
        if over.is_empty() {
            let only_time = (0..BASES.len()).all(|k| k == 2 || self.twice[k] == 0);
            let angle = self.radian == 1 && only_time;
            over.push(if angle { "rad" } else { "1" }.to_owned());
        }
        f.write_str(&over.join("*"))?;
        under
            .map(|(name, twice)| factor(name, -twice))
            .try_for_each(|factor| write!(f, "/{factor}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_newton_is_what_newton_says() {
        let newton = Unit::KILOGRAM
            .times(Unit::METRE)
            .over(Unit::SECOND.power(2, 1).unwrap());
        assert_eq!(newton, Unit::NEWTON);
        assert_eq!(newton.to_string(), "N");
    }

    #[test]
    fn the_root_of_stiffness_over_mass_is_a_frequency() {
        let stiffness = Unit::NEWTON.over(Unit::METRE);
        assert_eq!(
            stiffness.over(Unit::KILOGRAM).power(1, 2),
            Some(Unit::ONE.rate())
        );
        assert_eq!(Unit::METRE.power(1, 2).unwrap().to_string(), "m^(1/2)");
        assert_eq!(Unit::METRE.power(1, 3), None);
    }

    #[test]
    fn units_are_printed_as_a_spec_writes_them() {
        assert_eq!(Unit::ONE.to_string(), "1");
        assert_eq!(Unit::METRE.rate().rate().to_string(), "m/s^2");
        assert_eq!(Unit::NEWTON.over(Unit::METRE).to_string(), "N/m");
        assert_eq!(Unit::ONE.rate().to_string(), "1/s");
        assert_eq!(Unit::base(1, 2, 0).to_string(), "kg*m^2");
    }

    #[test]
    fn a_radian_is_remembered_and_means_nothing() {
        let radian = Unit::RADIAN;
        assert_eq!(radian, Unit::ONE);
        assert_eq!(radian.to_string(), "rad");
        assert_eq!(radian.rate().rate().to_string(), "rad/s^2");
        assert_eq!(radian.times(Unit::METRE).to_string(), "m");
        assert_eq!(radian.power(2, 1).unwrap().rate().to_string(), "1/s");
    }

    #[test]
    fn no_exponent_is_too_large_for_an_answer() {
        assert_eq!(Unit::METRE.power(i64::MAX, 1), None);
        assert_eq!(Unit::METRE.power(1, 0), None);
        assert_eq!(Unit::METRE.power(1 << 40, 1), None);
        assert_eq!(Unit::ONE.power(1 << 40, 3), Some(Unit::ONE));
    }

    #[test]
    fn a_factor_pi_makes_radians_of_cycles_and_nothing_else_does() {
        let (hertz, omega) = (Unit::HERTZ, Unit::RADIAN.rate());
        assert_ne!(hertz, omega);
        assert!(!hertz.fits(omega) && !omega.fits(hertz));
        assert!(hertz.times_pi(1).fits(omega));
        assert_eq!(hertz.times_pi(1).to_string(), "rad/s");
        assert!(omega.times_pi(-1).fits(hertz));
        assert!(!omega.times_pi(1).fits(hertz));
        assert!(!hertz.times_pi(-1).fits(omega));
        // 1/(2*pi*f), and (2*pi*f)^2 in both orders.
        assert!(Unit::ONE.over(hertz).times_pi(-1).fits(Unit::SECOND));
        let square = omega.times(omega);
        assert!(hertz.power(2, 1).unwrap().times_pi(2).fits(square));
        assert!(hertz.times_pi(1).power(2, 1).unwrap().fits(square));
        assert!(!hertz.power(2, 1).unwrap().times_pi(1).fits(square));
        // A circumference is a length.
        assert!(Unit::METRE.times_pi(1).fits(Unit::METRE));
        assert_eq!(hertz.times(Unit::SECOND).to_string(), "cycle");
        assert_eq!(hertz.cycles_beyond(omega), Some(1));
        assert_eq!(omega.cycles_beyond(hertz), Some(-1));
        assert_eq!(hertz.cycles_beyond(Unit::METRE), None);
    }

    #[test]
    fn the_units_of_a_motor_agree() {
        let torque_constant = Unit::JOULE.over(Unit::AMPERE);
        assert_eq!(torque_constant.times(Unit::RADIAN.rate()), Unit::VOLT);
        assert_eq!(Unit::VOLT.times(Unit::AMPERE), Unit::WATT);
        assert_eq!(Unit::VOLT.over(Unit::AMPERE).to_string(), "ohm");
        assert_eq!(Unit::KELVIN.rate().to_string(), "K/s");
    }
}
