//! Gauss methods of orders 4, 6 and 8, in steps of a fixed length, for long runs of conservative machines.

use super::{Method, MethodKind, Rule, Tableau};

/// Collocation at the zeros of the Legendre polynomial of degree `s`, of order `2 s`.
///
/// E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006: section II.1.3 (table 1.1 has orders 4 and 6),
/// section VI.4 (symplectic), section V.2 (symmetric). The stages are those of the equations in momenta, for which the step is
/// symplectic (`stepper/of_fixed_length/gauss.rs`); constraints of positions hold at the nodes of Lobatto's quadrature
/// (`stepper/of_fixed_length/lobatto.rs`).
const fn of(tableau: Tableau) -> Method {
    Method::of_kind(tableau, MethodKind::Fixed(Rule::Gauss))
}

const COMMON: Tableau = Tableau {
    name: "",
    title: "",
    order: 0,
    error_power: 1,
    // The motion within a step is the quintic through its ends, their rates and accelerations; at order 4 it is the cubic.
    dense_order: 5,
    stages: 0,
    c: &[],
    a: &[],
    error: &[],
    coarse_error: None,
    dense: &[],
    step_change: (1.0, 1.0),
    smoothing: 0.0,
    stability: None,
    spectrum: None,
};

pub(super) const FOURTH: Method = of(Tableau {
    name: "gauss4",
    title: "Gauss–Legendre 4",
    order: 4,
    dense_order: 3,
    stages: 3,
    c: &[0.0, 0.2113248654051871, 0.7886751345948129, 1.0],
    a: &[
        &[],
        &[0.0, 0.25, -0.03867513459481288],
        &[0.0, 0.5386751345948129, 0.25],
        &[0.0, 0.5, 0.5],
    ],
    ..COMMON
});

pub(super) const SIXTH: Method = of(Tableau {
    name: "gauss6",
    title: "Gauss–Legendre 6",
    order: 6,
    dense_order: 5,
    stages: 4,
    c: &[0.0, 0.11270166537925831, 0.5, 0.8872983346207417, 1.0],
    a: &[
        &[],
        &[
            0.0,
            0.1388888888888889,
            -0.0359766675249389,
            0.009789444015308325,
        ],
        &[
            0.0,
            0.30026319498086457,
            0.2222222222222222,
            -0.022485417203086815,
        ],
        &[
            0.0,
            0.26798833376246944,
            0.48042111196938336,
            0.1388888888888889,
        ],
        &[
            0.0,
            0.2777777777777778,
            0.4444444444444444,
            0.2777777777777778,
        ],
    ],
    ..COMMON
});

pub(super) const EIGHTH: Method = of(Tableau {
    name: "gauss8",
    title: "Gauss–Legendre 8",
    order: 8,
    dense_order: 5,
    stages: 5,
    c: &[
        0.0,
        0.06943184420297371,
        0.33000947820757187,
        0.6699905217924281,
        0.9305681557970263,
        1.0,
    ],
    a: &[
        &[],
        &[
            0.0,
            0.08696371128436346,
            -0.026604180084998794,
            0.012627462689404725,
            -0.0035551496857956833,
        ],
        &[
            0.0,
            0.18811811749986806,
            0.16303628871563652,
            -0.027880428602470895,
            0.006735500594538156,
        ],
        &[
            0.0,
            0.16719192197418878,
            0.35395300603374397,
            0.16303628871563652,
            -0.014190694931141144,
        ],
        &[
            0.0,
            0.1774825722545226,
            0.31344511474186837,
            0.35267675751627187,
            0.08696371128436346,
        ],
        &[
            0.0,
            0.17392742256872692,
            0.32607257743127305,
            0.32607257743127305,
            0.17392742256872692,
        ],
    ],
    ..COMMON
});
