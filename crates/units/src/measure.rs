//! Units as they are written, `mm`, `km/h`, `deg`, each with its size in SI units.

use lagrangian_symbolic::{Dag, Expr};

use super::{Rational, Unit};

/// A unit as it is written, with its exact size in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// The SI unit.
    pub unit: Unit,
    /// Its size in SI units, without the power of π in [`Self::pi`].
    pub factor: Rational,
    /// The power of π that multiplies the factor.
    pub pi: i32,
}

/// A named unit: its name, the SI unit, its size in that as a fraction, the power of π that
/// multiplies the fraction, and the prefixes that it takes.
type Named = (&'static str, Unit, (i64, i64), i32, &'static str);

const ANGULAR_RATE: Unit = Unit {
    radian: 1,
    ..Unit::base(0, 0, -1)
};

#[rustfmt::skip]
const NAMES: &[Named] = &[
    ("kg",    Unit::KILOGRAM, (1, 1), 0, ""),
    ("m",     Unit::METRE,    (1, 1), 0, "kdcmun"),
    ("s",     Unit::SECOND,   (1, 1), 0, "mun"),
    ("rad",   Unit::RADIAN,   (1, 1), 0, "m"),
    ("N",     Unit::NEWTON,   (1, 1), 0, "kMm"),
    ("J",     Unit::JOULE,    (1, 1), 0, "kMGm"),
    ("W",     Unit::WATT,     (1, 1), 0, "kMGm"),
    ("Pa",    Unit::PASCAL,   (1, 1), 0, "kMG"),
    ("Hz",    Unit::HERTZ,    (1, 1), 0, "kMG"),
    ("cycle", Unit::TURN,     (1, 1), 0, ""),
    ("A",     Unit::AMPERE,   (1, 1), 0, "kmun"),
    ("V",     Unit::VOLT,     (1, 1), 0, "kmu"),
    ("ohm",   Unit::electric(1, 2, -3, -2),  (1, 1), 0, "kMm"),
    ("Ω",     Unit::electric(1, 2, -3, -2),  (1, 1), 0, "kMm"),
    ("S",     Unit::electric(-1, -2, 3, 2),  (1, 1), 0, "mu"),
    ("H",     Unit::electric(1, 2, -2, -2),  (1, 1), 0, "mun"),
    ("F",     Unit::electric(-1, -2, 4, 2),  (1, 1), 0, "munp"),
    ("C",     Unit::electric(0, 0, 1, 1),    (1, 1), 0, "mun"),
    ("T",     Unit::electric(1, 0, -2, -1),  (1, 1), 0, "mu"),
    ("Wb",    Unit::electric(1, 2, -2, -1),  (1, 1), 0, "m"),
    ("K",     Unit::KELVIN,   (1, 1), 0, "m"),
    // Exact units outside the SI.
    ("g",     Unit::KILOGRAM, (1, 1000), 0, "Mm"),
    ("min",   Unit::SECOND,   (60, 1), 0, ""),
    ("h",     Unit::SECOND,   (3600, 1), 0, ""),
    ("deg",   Unit::RADIAN,   (1, 180), 1, ""),
    ("rev",   Unit::RADIAN,   (2, 1), 1, ""),
    ("rpm",   ANGULAR_RATE,   (1, 30), 1, ""),
    ("bar",   Unit::PASCAL,   (100_000, 1), 0, "m"),
    ("Wh",    Unit::JOULE,    (3600, 1), 0, "kM"),
    ("Ah",    Unit::electric(0, 0, 1, 1), (3600, 1), 0, "m"),
    // 75 kgf*m/s, and the weight of a kilogram at g = 9.80665 m/s².
    ("PS",    Unit::WATT,     (73_549_875, 100_000), 0, ""),
    ("kgf",   Unit::NEWTON,   (980_665, 100_000), 0, ""),
    // The international yard and pound, of 1959.
    ("inch",  Unit::METRE,    (254, 10_000), 0, ""),
    ("ft",    Unit::METRE,    (3048, 10_000), 0, ""),
    ("lb",    Unit::KILOGRAM, (45_359_237, 100_000_000), 0, ""),
    ("lbf",   Unit::NEWTON,   (44_482_216_152_605, 10_000_000_000_000), 0, ""),
];

/// The prefixes with their powers of ten. `µ` occurs as a sign of its own and as the Greek letter.
const PREFIXES: [(&str, char, i32); 11] = [
    ("G", 'G', 9),
    ("M", 'M', 6),
    ("k", 'k', 3),
    ("d", 'd', -1),
    ("c", 'c', -2),
    ("m", 'm', -3),
    ("u", 'u', -6),
    ("µ", 'u', -6),
    ("μ", 'u', -6),
    ("n", 'n', -9),
    ("p", 'p', -12),
];

impl Measure {
    /// A pure number.
    pub const ONE: Measure = Measure {
        unit: Unit::ONE,
        factor: Rational::ONE,
        pi: 0,
    };

    /// The unit with the name `name` in a spec.
    pub fn named(name: &str) -> Option<Measure> {
        let (&(_, unit, (above, below), pi, _), exponent) = find(name)?;
        let ten = Rational::from(10).pow(exponent)?;
        let factor = Rational::new(above, below)?.checked_mul(&ten)?;
        let is_si = factor.is_one() && pi == 0;
        let unit = unit.as_written(!is_si);
        Some(Measure { unit, factor, pi })
    }

    /// The names of units, without those with prefixes.
    pub fn names() -> impl Iterator<Item = &'static str> + Clone {
        NAMES.iter().map(|(name, ..)| *name)
    }

    /// The unit of a product; none if its size overflows.
    pub fn times(&self, other: &Measure) -> Option<Measure> {
        Some(Measure {
            unit: self.unit.times(other.unit),
            factor: self.factor.checked_mul(&other.factor)?,
            pi: self.pi + other.pi,
        })
    }

    /// The unit of a power; none if its size overflows.
    pub fn power(&self, power: i32) -> Option<Measure> {
        Some(Measure {
            unit: self.unit.power(power.into(), 1)?,
            factor: self.factor.pow(power)?,
            pi: self.pi.checked_mul(power)?,
        })
    }

    /// The unit of the power `power/2` of an SI unit; none for other units, the roots of whose
    /// sizes are not rational.
    pub fn half_power(&self, power: i32) -> Option<Measure> {
        self.is_si().then_some(())?;
        Some(Measure {
            unit: self.unit.power(power.into(), 2)?,
            ..self.clone()
        })
    }

    /// Whether it is an SI unit, so that a number needs no conversion.
    pub fn is_si(&self) -> bool {
        self.factor.is_one() && self.pi == 0
    }

    /// Its size in SI units, rounded.
    pub fn to_f64(&self) -> f64 {
        self.factor.to_f64() * std::f64::consts::PI.powi(self.pi)
    }

    /// Its size in SI units.
    pub fn in_si<'d>(&self, dag: &'d Dag) -> Expr<'d> {
        dag.constant(self.factor.clone()) * dag.pi().powi(self.pi)
    }

    /// The size of an SI unit in this unit.
    pub fn of_si<'d>(&self, dag: &'d Dag) -> Expr<'d> {
        let factor = self.factor.recip().unwrap_or(Rational::ONE); // no unit is zero
        dag.constant(factor) * dag.pi().powi(-self.pi)
    }
}

/// The table row of a name, and the power of ten of its prefix.
fn find(name: &str) -> Option<(&'static Named, i32)> {
    let row = |word: &str| NAMES.iter().find(|(known, ..)| *known == word);
    if let Some(found) = row(name) {
        return Some((found, 0));
    }
    PREFIXES.iter().find_map(|&(written, prefix, exponent)| {
        let found = row(name.strip_prefix(written)?)?;
        found.4.contains(prefix).then_some((found, exponent))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(name: &str, above: i64, below: i64, pi: i32, unit: Unit) {
        let found = Measure::named(name).unwrap_or_else(|| panic!("{name} is a unit"));
        assert_eq!(
            (found.factor, found.pi, found.unit),
            (Rational::new(above, below).unwrap(), pi, unit),
            "{name}"
        );
    }

    /// From the SI brochure, 9th edition, tables 5, 7 and 8, and from the definitions of the others.
    #[test]
    fn a_unit_is_as_many_si_units_as_it_is_defined_to_be() {
        is("mm", 1, 1000, 0, Unit::METRE);
        is("µm", 1, 1_000_000, 0, Unit::METRE);
        is("km", 1000, 1, 0, Unit::METRE);
        is("g", 1, 1000, 0, Unit::KILOGRAM);
        is("Mg", 1000, 1, 0, Unit::KILOGRAM);
        is("h", 3600, 1, 0, Unit::SECOND);
        is("deg", 1, 180, 1, Unit::RADIAN);
        is("rpm", 1, 30, 1, Unit::RADIAN.rate());
        is("kN", 1000, 1, 0, Unit::NEWTON);
        is("MPa", 1_000_000, 1, 0, Unit::PASCAL);
        is("GPa", 1_000_000_000, 1, 0, Unit::PASCAL);
        is("kWh", 3_600_000, 1, 0, Unit::JOULE);
        is("kHz", 1000, 1, 0, Unit::HERTZ);
        is(
            "mH",
            1,
            1000,
            0,
            Unit::JOULE.over(Unit::AMPERE.times(Unit::AMPERE)),
        );
        is(
            "uF",
            1,
            1_000_000,
            0,
            Unit::AMPERE.times(Unit::SECOND).over(Unit::VOLT),
        );
        is("kohm", 1000, 1, 0, Unit::VOLT.over(Unit::AMPERE));
        is("Wb", 1, 1, 0, Unit::VOLT.times(Unit::SECOND));
        is(
            "T",
            1,
            1,
            0,
            Unit::VOLT
                .times(Unit::SECOND)
                .over(Unit::METRE.power(2, 1).unwrap()),
        );
    }

    #[test]
    fn a_pound_weighs_a_pound_force() {
        let [pound, force] = ["lb", "lbf"].map(|name| Measure::named(name).unwrap().factor);
        let gravity = Rational::parse_decimal("9.80665").unwrap();
        assert_eq!(&pound * &gravity, force);
        // 550 lbf*ft/s is a horsepower of 745.699871582… W.
        let foot = Measure::named("ft").unwrap().factor;
        let power = &(&Rational::from(550) * &force) * &foot;
        assert_eq!(
            power,
            Rational::parse_decimal("745.69987158227022").unwrap()
        );
    }

    #[test]
    fn only_names_with_sensible_prefixes_are_units() {
        for name in [
            "t", "kkg", "cs", "kdeg", "Nm", "Gm", "mmin", "in", "d", "l", "",
        ] {
            assert_eq!(Measure::named(name), None, "{name}");
        }
        // No name has two meanings.
        for name in Measure::names() {
            let rows = NAMES.iter().filter(|(other, ..)| *other == name).count();
            let prefixed = PREFIXES.iter().filter(|(written, prefix, _)| {
                let rest = name.strip_prefix(*written);
                let row = rest.and_then(|rest| NAMES.iter().find(|(other, ..)| *other == rest));
                row.is_some_and(|row| row.4.contains(*prefix))
            });
            assert_eq!((rows, prefixed.count()), (1, 0), "{name}");
        }
    }

    #[test]
    fn there_and_back_is_exact() {
        let dag = Dag::new();
        for (name, ..) in NAMES {
            for power in [-3, -1, 1, 2, 5] {
                let unit = Measure::named(name)
                    .and_then(|unit| unit.power(power))
                    .unwrap();
                assert!(
                    (unit.in_si(&dag) * unit.of_si(&dag)).is_one(),
                    "{name}^{power}"
                );
            }
        }
    }
}
