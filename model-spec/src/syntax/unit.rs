//! Parses units: `kg*m^2/s`.

use crate::diagnostic::{Code, Diagnostic, most_similar};
use crate::syntax::ast::{Unit, UnitFactor};
use crate::syntax::parse::Parser;
use crate::token::{Delimiter, TokenKind, shown};
use crate::unit::Measure;

impl Parser<'_> {
    /// `kg*m^2/s`; none if a part of it is unknown.
    pub(super) fn unit(&mut self) -> Option<Unit> {
        let start = self.next_span();
        let mut factors = Vec::new();
        let mut known = self.unit_product(1, &mut factors);
        known &= !self.failed;
        let span = start.to(self.previous_span());
        known.then_some(Unit { factors, span })
    }

    /// Factors separated by `*` and `/`, all to the power `sign`.
    fn unit_product(&mut self, sign: i32, factors: &mut Vec<UnitFactor>) -> bool {
        let mut known = self.unit_power(sign, factors);
        loop {
            let divides = self.is_mark('/');
            if self.failed || !(self.is_mark('*') || divides) {
                return known;
            }
            self.at += 1;
            known &= self.unit_power(if divides { -sign } else { sign }, factors);
        }
    }

    /// `m^2`, `1`, `(kg*m)`
    fn unit_power(&mut self, sign: i32, factors: &mut Vec<UnitFactor>) -> bool {
        let first = factors.len();
        let known = self.unit_name(sign, factors);
        if self.failed || !self.eat_mark('^') {
            return known;
        }
        let Some((power, halves)) = self.unit_exponent() else {
            return false;
        };
        for factor in factors.get_mut(first..).unwrap_or_default() {
            factor.power = factor.power.saturating_mul(power);
            if !halves {
                continue;
            }
            // The square root of a non-SI unit has no rational size, and quarters of powers are not supported.
            let measure = Measure::named(&factor.name.text);
            if factor.halved || measure.is_some_and(|measure| !measure.is_si()) {
                let name = &factor.name.text;
                let message = format!("{} cannot have this power here", shown(name));
                let unknown = Diagnostic::new(Code::UnknownUnit, factor.name.span, message);
                let help = "only SI units can have half-integer powers: `N/m^(3/2)`";
                self.report_error(unknown.help(help));
                return false;
            }
            factor.halved = true;
        }
        known
    }

    fn unit_name(&mut self, sign: i32, factors: &mut Vec<UnitFactor>) -> bool {
        if self.is_open(Delimiter::Parenthesis) {
            let Some(group) = self.enter_nested(Delimiter::Parenthesis) else {
                return false;
            };
            let known = self.unit_product(sign, factors);
            self.leave_nested(group, "`)`");
            return known;
        }
        let one = self
            .peek()
            .is_some_and(|word| word.kind == TokenKind::Number && word.text == "1");
        if one {
            self.at += 1;
            return true;
        }
        if !self.is(TokenKind::Ident) {
            let help = "a unit is `m`, `kg*m^2`, `N/m`, …; a pure number has the unit `1`";
            self.unexpected_because("a unit", Some(help.to_owned()));
            return false;
        }
        let Some(name) = self.ident("a unit") else {
            return false;
        };
        let known = Measure::named(&name.text).is_some();
        if !known {
            let message = format!("there is no unit {}", shown(&name.text));
            let unknown = Diagnostic::new(Code::UnknownUnit, name.span, message);
            self.report_error(unknown.help(unit_help(&name.text)));
        }
        factors.push(UnitFactor {
            name,
            power: sign,
            halved: false,
        });
        known
    }

    /// An integer with an optional sign; in brackets it may be followed by `/2`, which the second part reports.
    fn unit_exponent(&mut self) -> Option<(i32, bool)> {
        /// No mechanical quantity has a higher power of a unit.
        const HIGHEST: i32 = 12;
        let brackets = if self.is_open(Delimiter::Parenthesis) {
            self.enter(Delimiter::Parenthesis)
        } else {
            None
        };
        let negative = self.eat_mark('-');
        let number = self.peek().filter(|word| word.kind == TokenKind::Number);
        let power = number
            .and_then(|word| word.text.parse::<i32>().ok())
            .filter(|&power| power <= HIGHEST);
        if power.is_none() {
            self.unexpected(&format!("a whole number up to {HIGHEST}"));
        } else {
            self.at += 1;
        }
        let mut halves = false;
        if let Some(group) = brackets {
            if power.is_some() && self.eat_mark('/') {
                let two = self.peek().is_some_and(|word| word.text == "2");
                if two {
                    self.at += 1
                } else {
                    self.unexpected("`2`: powers of units are integers or half-integers")
                }
                halves = two;
            }
            self.leave(group, "`)`");
        }
        // 4/2 is 2.
        let power = power.map(|power| if negative { -power } else { power })?;
        Some(if halves && power % 2 == 0 {
            (power / 2, false)
        } else {
            (power, halves)
        })
    }
}

/// The help for a unit that the language does not have.
fn unit_help(name: &str) -> String {
    let known = || Measure::names().chain(["mm", "cm", "km", "kN", "MPa", "kW", "ms", "kHz"]);
    let help = match name {
        "Nm" => "write `N*m`",
        "Nms" => "write `N*m*s`",
        "rads" => "write `rad/s`",
        "kmh" | "kph" => "write `km/h`",
        "mps" => "write `m/s`",
        "t" | "to" | "ton" | "tonne" => "`t` is the time: a tonne is `Mg`, or `1000*kg`",
        "l" | "L" | "liter" | "litre" => "a litre is `dm^3`",
        "sec" | "second" | "seconds" => "write `s`",
        "hour" | "hours" => "write `h`",
        "minute" | "minutes" => "write `min`",
        "meter" | "metre" | "meters" => "write `m`",
        "degree" | "degrees" | "grad" | "°" => "write `deg`",
        "radian" | "radians" => "write `rad`",
        "turn" | "turns" | "U" => "write `rev`, which is 2π rad",
        "rps" => "write `rev/s`, or `Hz` for turns that are counted",
        "kp" => "write `kgf`",
        "hp" => "there are several: write `PS`, or `550*lbf*ft/s`",
        "in" => "write `inch`",
        "psi" => "write `lbf/inch^2`",
        "degC" | "celsius" | "Celsius" => "temperatures are in `K`",
        "Ohm" => "write `ohm`",
        _ => {
            return match most_similar(name, known()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => {
                    let names: Vec<&str> = Measure::names().collect();
                    format!(
                        "the units are {} and `1`, many with prefixes: `mm`, `kN`, `MPa`",
                        names.join(", ")
                    )
                }
            };
        }
    };
    help.to_owned()
}
