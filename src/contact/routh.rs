//! The impact of one contact along Routh's path: the normal impulse grows, and the slip stops, reverses or stays at
//! rest on the way.
//!
//! E. J. Routh, *Dynamics of a System of Rigid Bodies*, Elementary Part, 1905, chapter V; W. J. Stronge, *Impact
//! Mechanics*, 2000, chapter 4.
//!
//! Guides that the impact loads take part in the same path. Their reactions grow with the impulse of the contact that meets, and each rubs with μ |dN| against its slip: with the normal
//! impulse p of the contact as the parameter, what sticks, slips and presses is the complementarity problem of contacts for the increments,
//!
//! ```text
//! dγ/dp = G (dΛ/dp),    dΛₙ/dp = 1 of the contact,    dN/dp = K (dΛ/dp),    −dΛₜ/dp ∈ μ |dN/dp| Sgn γₜ of a guide
//! ```
//!
//! which is constant until a slip stops, compression ends, or expansion does.

use std::vec;
use std::vec::Vec;

use super::problem::{self, ContactUnknowns, SATURATED};

/// Slips that change by less than this with the normal impulse, relative to the terms of that, stay 0.
const STUCK: f64 = 1e-11;

/// How large the residual of increments may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// How often a slip may stop along the path, at most, for the contact and each guide.
const MOST_STOPS: usize = 32;

/// When the expansion ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum Expansion {
    /// At `e` times the normal impulse of compression.
    Impulse,
    /// At `−e²` times the work of the normal impulse in compression.
    Work,
}

/// One contact that meets.
#[derive(Clone, Copy, Debug)]
pub(super) struct SingleImpact {
    /// `Gₙₙ`, `Gₙₜ` and `Gₜₜ`.
    pub inverse_masses: [f64; 3],
    /// `γₙ` and `γₜ` before.
    pub rates: [f64; 2],
    /// `e`.
    pub restitution: f64,
    /// `μ` and `μ₀`.
    pub friction: [f64; 2],
}

/// Normal and tangential impulse; none where the normal impulse has no end.
pub(super) fn impulse(single_impact: SingleImpact, expansion: Expansion) -> Option<[f64; 2]> {
    let SingleImpact {
        inverse_masses: [nn, nt, tt],
        rates: [mut normal, mut slip],
        restitution,
        friction: [friction, static_friction],
    } = single_impact;
    let mut impulse = [0.0; 2];
    let mut work = 0.0;
    // These are the normal impulse at which expansion ends, and the work, once compression is over.
    let mut until: Option<[f64; 2]> = None;
    // The contact slips one way, rests, and slips the other way, in compression and beyond.
    for _ in 0..8 {
        let is_stuck = slip == 0.0 && tt > 0.0 && (nt / tt).abs() <= static_friction;
        let share = match slip {
            _ if tt <= 0.0 => 0.0,
            _ if is_stuck => -nt / tt,
            0.0 => -friction * nt.signum(),
            slip => -friction * f64::signum(slip),
        };
        let normal_rate = nn + share * nt;
        let slip_rate = nt + share * tt;
        let to_rest = if slip * slip_rate < 0.0 {
            -slip / slip_rate
        } else {
            f64::INFINITY
        };
        let to_end = match until {
            None if normal_rate > 0.0 => -normal / normal_rate,
            None => f64::INFINITY,
            Some([end, work_end]) => match expansion {
                Expansion::Impulse => end - impulse[0],
                Expansion::Work => expansion_of_work((normal, normal_rate), work_end - work),
            },
        };
        let by = to_rest.min(to_end);
        if !by.is_finite() {
            return None;
        }
        work += by * (normal + 0.5 * normal_rate * by);
        impulse[0] += by;
        impulse[1] += share * by;
        slip = if to_rest <= to_end || is_stuck {
            0.0
        } else {
            slip + slip_rate * by
        };
        normal += normal_rate * by;
        if to_end <= to_rest {
            if until.is_some() {
                return Some(impulse);
            }
            normal = 0.0;
            until = Some([
                (1.0 + restitution) * impulse[0],
                work - restitution * restitution * work,
            ]);
        }
    }
    None
}

/// The normal impulse p with which the work of expansion that is missing, `normal p + ½ slope p²`, is done.
fn expansion_of_work((normal, slope): (f64, f64), missing: f64) -> f64 {
    let missing = missing.max(0.0);
    let root = (normal * normal + 2.0 * slope * missing).max(0.0);
    match normal + root.sqrt() {
        sum if sum > 0.0 => 2.0 * missing / sum,
        _ => 0.0,
    }
}

/// One contact that meets, and guides that its impact may load.
pub(super) struct GuidedImpact<'a> {
    /// The products of images, with two rows and columns for the contact and for each guide after it, as in the problem of contacts.
    pub g: &'a [f64],
    /// Rates before, two for the contact and for each guide. Those along the normals of guides are 0.
    pub rates: Vec<f64>,
    /// `e`.
    pub restitution: f64,
    /// `μ` and `μ₀` of the contact and of each guide.
    pub friction: Vec<[f64; 2]>,
}

impl GuidedImpact<'_> {
    /// Normal and tangential impulses of the contact and of all guides, whose normal ones are left out: they follow from the others.
    ///
    /// # Errors
    /// The place of what admits no increments of the impulses, or several, or whose normal impulse has no end.
    pub fn impulses(mut self, expansion: Expansion) -> Result<Vec<[f64; 2]>, usize> {
        let count = self.friction.len();
        let mut impulses = vec![[0.0; 2]; count];
        let mut work = 0.0;
        let mut until: Option<[f64; 2]> = None;
        for _ in 0..MOST_STOPS * count {
            let (increments, slopes) = self.increments()?;
            let to_rest: Vec<f64> = (0..count)
                .map(
                    |place| match [&self.rates, &slopes].map(|of| of[2 * place + 1]) {
                        [slip, slope] if slip * slope < 0.0 => -slip / slope,
                        _ => f64::INFINITY,
                    },
                )
                .collect();
            let first_rest = to_rest.iter().copied().fold(f64::INFINITY, f64::min);
            let (normal, slope) = (self.rates[0], slopes[0]);
            let to_end = match until {
                None if slope > 0.0 => -normal / slope,
                None => f64::INFINITY,
                Some([end, work_end]) => match expansion {
                    Expansion::Impulse => end - impulses[0][0],
                    Expansion::Work => expansion_of_work((normal, slope), work_end - work),
                },
            };
            let by = first_rest.min(to_end);
            if !by.is_finite() {
                return Err(0);
            }
            work += by * (normal + 0.5 * slope * by);
            for (sum, increment) in impulses.iter_mut().zip(&increments) {
                *sum = [sum[0] + by * increment[0], sum[1] + by * increment[1]];
            }
            for (rate, slope) in self.rates.iter_mut().zip(&slopes) {
                *rate += by * slope;
            }
            for place in (0..count).filter(|place| to_rest[*place] <= by) {
                self.rates[2 * place + 1] = 0.0;
            }
            if to_end <= first_rest {
                if until.is_some() {
                    impulses[1..]
                        .iter_mut()
                        .for_each(|of_guide| of_guide[0] = 0.0);
                    return Ok(impulses);
                }
                self.rates[0] = 0.0;
                until = Some([
                    (1.0 + self.restitution) * impulses[0][0],
                    work - self.restitution * self.restitution * work,
                ]);
            }
        }
        Err(0)
    }

    /// The impulses for a unit of the normal impulse of the contact, and what they add to the rates: to those of slips that stay 0, nothing.
    fn increments(&self) -> Result<(Vec<[f64; 2]>, Vec<f64>), usize> {
        let count = self.friction.len();
        let width = 2 * count;
        let sign = |slip: f64| (slip != 0.0).then(|| slip.signum());
        let mut slipping: Vec<Option<f64>> = (0..count)
            .map(|place| sign(self.rates[2 * place + 1]))
            .collect();
        // Each that begins to slip does so once.
        for _ in 0..=count {
            let unknowns = self.unknowns(&slipping)?;
            let mut forces = vec![[0.0; 2]; count];
            forces[0] = [
                1.0,
                slipping[0].map_or(0.0, |sign| -sign * self.friction[0][0]),
            ];
            let product = |row: usize, forces: &[[f64; 2]]| -> [f64; 2] {
                let terms = self.g[row * width..][..width].iter();
                let terms = terms.zip(forces.as_flattened()).map(|(g, force)| g * force);
                terms.fold([0.0; 2], |[sum, size], term| {
                    [sum + term, size + term.abs()]
                })
            };
            let b: Vec<f64> = (0..width).map(|row| product(row, &forces)[0]).collect();
            let found = problem::solve(&unknowns, self.g, &b, None);
            let found = found
                .ok()
                .filter(|found| found.residual <= MOST_RESIDUAL)
                .ok_or(0_usize)?;
            for (force, found) in forces.iter_mut().zip(&found.forces) {
                *force = [force[0] + found[0], force[1] + found[1]];
            }
            let mut slopes: Vec<f64> = (0..width).map(|row| product(row, &forces)[0]).collect();
            let mut breaks_away = false;
            for place in 0..count {
                let normal = if place == 0 {
                    1.0
                } else {
                    let unit = self.g[2 * place * width + 2 * place];
                    slopes[2 * place] / unit - forces[place][0]
                };
                if place > 0 {
                    // Nothing moves along the normal of a guide.
                    slopes[2 * place] = 0.0;
                }
                if slipping[place].is_some() {
                    continue;
                }
                let [slope, size] = product(2 * place + 1, &forces);
                let [kinetic, at_rest] = self.friction[place];
                let (most, used) = (at_rest * normal.abs(), forces[place][1]);
                if used.abs() < most * (1.0 - SATURATED) || slope.abs() <= STUCK * size {
                    slopes[2 * place + 1] = 0.0;
                } else if kinetic != at_rest {
                    let slips = if used == 0.0 {
                        slope.signum()
                    } else {
                        -used.signum()
                    };
                    slipping[place] = Some(slips);
                    breaks_away = true;
                }
            }
            if !breaks_away {
                return Ok((forces, slopes));
            }
        }
        Err(0)
    }

    /// What is asked of the contact and the guides, some of which slip.
    ///
    /// # Errors
    /// The place of a guide whose friction changes its reaction by as much as that is, or more: it has no reaction, or several.
    fn unknowns(&self, slipping: &[Option<f64>]) -> Result<Vec<ContactUnknowns>, usize> {
        let width = 2 * slipping.len();
        let of = |place: usize| {
            let [kinetic, at_rest] = self.friction[place];
            if place == 0 {
                return Ok(match slipping[0] {
                    Some(_) => ContactUnknowns::Nothing,
                    None => ContactUnknowns::Tangent {
                        friction: at_rest,
                        normal: 1.0,
                    },
                });
            }
            let row = &self.g[2 * place * width..][..width];
            let friction = slipping[place].map_or(at_rest, |_| kinetic);
            if row[2 * place] <= friction * row[2 * place + 1].abs() {
                return Err(place);
            }
            Ok(match slipping[place] {
                Some(sign) => ContactUnknowns::SlidingGuide {
                    friction,
                    forward: sign > 0.0,
                },
                None => ContactUnknowns::Guide { friction },
            })
        };
        (0..slipping.len()).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slanting rod of length 2 and mass 1 at the angle θ, whose lower end meets the ground.
    fn rod(angle: f64) -> [f64; 3] {
        let (sin, cos) = angle.sin_cos();
        [
            1.0 + 3.0 * cos * cos,
            -3.0 * sin * cos,
            1.0 + 3.0 * sin * sin,
        ]
    }

    fn energy_lost(single_impact: SingleImpact, [normal, tangential]: [f64; 2]) -> f64 {
        let [nn, nt, tt] = single_impact.inverse_masses;
        let [a, b] = single_impact.rates;
        let after = [
            a + nn * normal + nt * tangential,
            b + nt * normal + tt * tangential,
        ];
        -0.5 * (normal * (a + after[0]) + tangential * (b + after[1]))
    }

    #[test]
    fn without_friction_both_laws_are_newtons() {
        let single_impact = SingleImpact {
            inverse_masses: rod(0.7),
            rates: [-2.0, 0.5],
            restitution: 0.6,
            friction: [0.0; 2],
        };
        for expansion in [Expansion::Impulse, Expansion::Work] {
            let [normal, tangential] = impulse(single_impact, expansion).unwrap_or_default();
            let newton = 1.6 * 2.0 / single_impact.inverse_masses[0];
            assert!((normal - newton).abs() < 1e-14 && tangential == 0.0);
        }
    }

    #[test]
    fn work_of_expansion_is_what_stronge_says_and_energy_is_never_gained() {
        for k in 0..400 {
            let angle = 0.05 + 0.0037 * f64::from(k);
            let slip = 0.013 * f64::from(k % 97) - 0.6;
            let single_impact = SingleImpact {
                inverse_masses: rod(angle),
                rates: [-1.0, slip],
                restitution: 0.9,
                friction: [0.3; 2],
            };
            let found = impulse(single_impact, Expansion::Work);
            let lost = found.map(|found| energy_lost(single_impact, found));
            assert!(lost.is_some_and(|lost| lost >= -1e-13), "{k}: {lost:?}");
        }
    }

    #[test]
    fn a_rod_that_cannot_slip_on_is_stopped_by_an_impulse() {
        // Beyond Painlevé's μ = 4/3 the normal rate falls while it slips: the slip ends first.
        let single_impact = SingleImpact {
            inverse_masses: rod(1.1),
            rates: [0.0, -1.0],
            restitution: 0.0,
            friction: [2.0; 2],
        };
        let [nn, nt, _] = single_impact.inverse_masses;
        assert!(nn + 2.0 * nt < 0.0 || nn - 2.0 * nt < 0.0);
        let found = impulse(single_impact, Expansion::Impulse);
        assert!(found.is_some_and(|[normal, _]| normal >= 0.0));
    }
}
