//! Moreau's time stepping, for machines whose contacts open and close.

use super::Tableau;

/// Steps of a fixed length, each of which solves once for the impulses of the contacts.
///
/// J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988, section 8; V. Acary, B. Brogliato,
/// *Numerical Methods for Nonsmooth Dynamical Systems*, 2008, section 10.1.1, with θ = 1/2. Where no contact touches it is
/// the explicit midpoint rule, whose tableau this is; work and dissipation are integrated by its weights as well.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "moreau",
    title: "Moreau's time stepping",
    order: 2,
    error_power: 3,
    dense_order: 2,
    stages: 2,
    c: &[0.0, 0.5, 1.0],
    a: &[&[], &[0.5], &[0.0, 1.0]],
    error: &[],
    coarse_error: None,
    dense: &[],
    step_change: (1.0, 1.0),
    smoothing: 0.0,
    stability: None,
    spectrum: None,
};
