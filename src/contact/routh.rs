//! The impact of one contact along Routh's path: the normal impulse grows, and the slip stops, reverses or stays at
//! rest on the way.
//!
//! E. J. Routh, *Dynamics of a System of Rigid Bodies*, Elementary Part, 1905, chapter V; W. J. Stronge, *Impact
//! Mechanics*, 2000, chapter 4.

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
                Expansion::Work => {
                    // The work that is missing is normal p + ½ normal_rate p².
                    let missing = (work_end - work).max(0.0);
                    let root = (normal * normal + 2.0 * normal_rate * missing).max(0.0);
                    match normal + root.sqrt() {
                        sum if sum > 0.0 => 2.0 * missing / sum,
                        _ => 0.0,
                    }
                }
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
