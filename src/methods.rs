//! Runge–Kutta methods: their published coefficients, and the list of methods to choose from.
//!
//! To add a method, write its [`Tableau`] and add one line to the list of [`METHODS`]. The same tests then check its orders, its dense
//! output, its events, and that it allocates nothing. A method of your own is a `Tableau` passed to [`Method::try_new`].

mod bogacki_shampine;
mod check;
mod digits;
mod dormand_prince_5;
mod dormand_prince_8;
mod gauss;
pub(crate) mod generalized_alpha;
mod moreau;
mod radau_5;
mod radau_9_13;
mod rattle;
mod rk4;
mod scheme;
mod semi_implicit_euler;
mod taylor;

pub use check::{MethodError, Tree, Weights};
pub(crate) use scheme::{Row, Scheme};

/// The largest number of stages of a method, including those for dense output.
pub const MAX_STAGES: usize = 16;

/// The Runge–Kutta methods, the default first: explicit ones for most machines, `radau5` for stiff ones.
pub static METHODS: [Method; 4] = [
    Method::wide(dormand_prince_8::TABLEAU, dormand_prince_8::BEYOND),
    Method::wide(dormand_prince_5::TABLEAU, dormand_prince_5::BEYOND),
    Method::wide(bogacki_shampine::TABLEAU, bogacki_shampine::BEYOND),
    Method::new(radau_5::TABLEAU),
];

/// `radau9` and `radau13`, of orders 9 and 13: like `radau5`, for stiff machines at tolerances finer than about 1e-7 and 1e-10, where order
/// 5 would need many steps.
pub static RADAU_OF_HIGH_ORDER: [Method; 2] = [
    Method::new(radau_9_13::NINTH),
    Method::new(radau_9_13::THIRTEENTH),
];

/// Steps by the Taylor series of the motion, for machines that have one ([`System::check_series`](crate::System::check_series)): the
/// fastest method for smooth machines at fine tolerances.
///
/// Its order is 12 or 20, depending on the tolerance. Dense output and events have the same order and cost no evaluation. A compiled
/// machine has its series if its spec says `methods { taylor }`. While unilateral contacts of a machine are closed, a run goes on by
/// [`Method::DOP853`]. Steps end at the end of the run, not at samples. It needs an allocator,
/// hence the feature `std`, and inputs that keep their defaults.
///
/// It is not a Runge–Kutta method, so it is not among [`METHODS`]; its [`Tableau`] holds the nodes and weights by which work and
/// dissipation are integrated along the motion.
pub static TAYLOR: Method = Method::of_kind(taylor::TABLEAU, MethodKind::Series);

/// Moreau's time stepping, for machines with many contacts that open and close
/// ([`System::unilateral_contacts`](crate::System::unilateral_contacts)), such as piles and mechanisms that chatter.
///
/// Steps have the fixed length [`longest_step`](crate::Simulation::longest_step); tolerances have no effect. Each step solves once for the
/// impulses of the contacts, by the law `newton` with rates at the middle of the step; instants of impacts are not located. The error is of
/// order 1 in the step length after an impact, and of order 2 where nothing touches. It is a method of [`Simulation`](crate::Simulation)s.
pub static MOREAU: Method = Method::of_kind(moreau::TABLEAU, MethodKind::Impulses);

/// Methods whose steps have the fixed length [`longest_step`](crate::Simulation::longest_step); tolerances have no effect. Nothing bounds
/// the error of their steps: halve the length to see it.
///
/// * `rk4`, of order 4, and `semi-implicit-euler`, of order 1: a fixed number of evaluations in each step, for loops of a fixed rate.
///   They need no allocator.
/// * `gauss4`, `gauss6`, `gauss8`, of orders 4, 6 and 8, and `rattle`, of order 2, all with constraints of positions: symplectic and
///   symmetric, so that the energy of a conservative machine does not drift, however long the run.
/// * `generalized-alpha`, of order 2: the implicit method of structural dynamics, which damps motions that are too fast for the step.
pub static FIXED_STEP_METHODS: [Method; 7] = [
    Method::of_kind(rk4::TABLEAU, MethodKind::Fixed(Rule::Explicit)),
    Method::of_kind(
        semi_implicit_euler::TABLEAU,
        MethodKind::Fixed(Rule::SemiImplicitEuler),
    ),
    gauss::FOURTH,
    gauss::SIXTH,
    gauss::EIGHTH,
    Method::of_kind(rattle::TABLEAU, MethodKind::Fixed(Rule::Rattle)),
    Method::of_kind(
        generalized_alpha::TABLEAU,
        MethodKind::Fixed(Rule::GeneralizedAlpha),
    ),
];

/// Nodes and weights of the midpoint rule, for work and dissipation in steps without stages.
const AT_MIDDLE: Tableau = Tableau {
    name: "",
    title: "",
    order: 0,
    error_power: 1,
    dense_order: 0,
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

/// How a step of fixed length is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// The stages of an explicit method.
    Explicit,
    SemiImplicitEuler,
    /// Coupled stages in momenta.
    Gauss,
    Rattle,
    GeneralizedAlpha,
}

/// The kind of steps of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MethodKind {
    /// Stages of an explicit or an implicit method.
    RungeKutta,
    /// The Taylor series of the motion.
    Series,
    /// Impulses of contacts, in steps of fixed length.
    Impulses,
    /// Steps of a fixed length.
    Fixed(Rule),
}

/// A method of integration, ready to run.
#[derive(Debug)]
pub struct Method {
    /// Its published coefficients.
    pub tableau: Tableau,
    pub(crate) scheme: Scheme,
    pub(crate) kind: MethodKind,
}

impl Method {
    /// Dormand and Prince's method of order 8, the default.
    pub const DOP853: &'static Self = &METHODS[0];
    /// Dormand and Prince's method of order 5: for coarse tolerances, and where steps are short for other reasons.
    pub const DOPRI5: &'static Self = &METHODS[1];
    /// Bogacki and Shampine's method of order 3.
    pub const BS32: &'static Self = &METHODS[2];
    /// The implicit method of Radau of order 5, for stiff machines.
    pub const RADAU5: &'static Self = &METHODS[3];
    /// Steps by [Taylor series](TAYLOR).
    pub const TAYLOR: &'static Self = &TAYLOR;
    /// [Moreau's time stepping](MOREAU).
    pub const MOREAU: &'static Self = &MOREAU;

    /// Prepares a published method for mechanical systems, in which positions follow from velocities, after a check that its tableau is
    /// consistent: rows have the right lengths and add up to their nodes, and the weights of the new point, of the error estimates and of
    /// dense output satisfy all order conditions up to the stated orders, to rounding.
    ///
    /// A simulation borrows its method for `'static`: keep it in a `static`, or leak it.
    ///
    /// # Errors
    /// If a row violates a condition; the error names both.
    ///
    /// ```
    /// use lagrangian::methods::{Method, MethodError, Tableau};
    ///
    /// /// The classical fourth order, with the third-order weights (1/6, 1/3, 1/3, 0, 1/6) beside it.
    /// fn classical() -> Tableau {
    ///     Tableau {
    ///         name: "rk4",
    ///         title: "Runge–Kutta 4(3)",
    ///         order: 4,
    ///         error_power: 4,
    ///         dense_order: 3,
    ///         stages: 4,
    ///         c: &[0.0, 0.5, 0.5, 1.0, 1.0],
    ///         a: &[
    ///             &[],
    ///             &[0.5],
    ///             &[0.0, 0.5],
    ///             &[0.0, 0.0, 1.0],
    ///             &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    ///         ],
    ///         error: &[0.0, 0.0, 0.0, 1.0 / 6.0, -1.0 / 6.0],
    ///         coarse_error: None,
    ///         dense: &[],
    ///         step_change: (0.2, 5.0),
    ///         smoothing: 0.0,
    ///         stability: None,
    ///         spectrum: None,
    ///     }
    /// }
    ///
    /// let method: &'static Method = Box::leak(Box::new(Method::try_new(classical())?));
    /// assert_eq!(method.tableau.order, 4);
    ///
    /// let fifth = Tableau { order: 5, stages: 5, ..classical() };
    /// assert!(matches!(Method::try_new(fifth), Err(MethodError::Field { field: "a", .. })));
    /// let slip = Tableau { c: &[0.0, 0.5, 0.6, 1.0, 1.0], ..classical() };
    /// assert!(matches!(Method::try_new(slip), Err(MethodError::Node { row: 2, .. })));
    /// # Ok::<(), MethodError>(())
    /// ```
    pub fn try_new(tableau: Tableau) -> Result<Self, MethodError> {
        check::check(&tableau)?;
        Ok(Self::new(tableau))
    }

    /// Checks that the tableau is consistent, as [`try_new`](Self::try_new) does.
    ///
    /// # Errors
    /// If a row violates a condition; the error names both.
    pub fn check(&self) -> Result<(), MethodError> {
        check::check(&self.tableau)
    }

    /// Whether dense output needs evaluations beyond those of a step.
    pub(crate) fn dense_needs_evaluations(&self) -> bool {
        self.scheme.length > self.tableau.stages + 1
    }

    /// Prepares a tableau that tests have checked.
    const fn new(tableau: Tableau) -> Self {
        let scheme = Scheme::new(&tableau, None);
        Self {
            tableau,
            scheme,
            kind: MethodKind::RungeKutta,
        }
    }

    /// Prepares the tableau of a method that is not a Runge–Kutta method.
    const fn of_kind(tableau: Tableau, kind: MethodKind) -> Self {
        Self {
            kind,
            ..Self::new(tableau)
        }
    }

    /// Prepares a tableau together with the differences between its published coefficients and their `f64`.
    const fn wide(tableau: Tableau, beyond: digits::Beyond) -> Self {
        let scheme = Scheme::new(&tableau, Some(beyond));
        Self {
            scheme,
            ..Self::new(tableau)
        }
    }

    /// Every method that has a name: the Runge–Kutta [`METHODS`], [`TAYLOR`], [`MOREAU`], the [`FIXED_STEP_METHODS`]
    /// and [`RADAU_OF_HIGH_ORDER`].
    pub fn all() -> impl Iterator<Item = &'static Self> {
        let others = [&TAYLOR, &MOREAU];
        let fixed = FIXED_STEP_METHODS.iter();
        let high = RADAU_OF_HIGH_ORDER.iter();
        METHODS.iter().chain(others).chain(fixed).chain(high)
    }

    /// Whether its steps have a fixed length, which does not depend on a tolerance.
    pub fn has_fixed_steps(&self) -> bool {
        matches!(self.kind, MethodKind::Impulses | MethodKind::Fixed(_))
    }

    /// Whether its steps need no memory beyond that of every stepper.
    #[cfg(not(feature = "std"))]
    pub(crate) fn needs_no_allocator(&self) -> bool {
        let plain = [Rule::Explicit, Rule::SemiImplicitEuler].map(MethodKind::Fixed);
        self.kind == MethodKind::RungeKutta || plain.contains(&self.kind)
    }

    /// Whether the motion within a step is the quintic through both ends, and not the cubic with corrections from the stages.
    pub(crate) fn is_quintic(&self) -> bool {
        matches!(self.kind, MethodKind::Fixed(_)) && self.tableau.dense_order > 3
    }

    /// Whether its steps solve for impulses of contacts, so that instants of impacts are not located.
    #[cfg(feature = "std")]
    pub(crate) fn is_time_stepping(&self) -> bool {
        self.kind == MethodKind::Impulses
    }

    /// The method with this short name: `dop853`, `dopri5`, `bs32`, `radau5`, `taylor`, `moreau`, `rk4`, `semi-implicit-euler`, `gauss4`,
    /// `gauss6`, `gauss8`, `rattle`, `generalized-alpha`, `radau9`, `radau13`.
    /// `gauss6`, `gauss8`, `rattle`, `generalized-alpha`, `radau9`, `radau13`.
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::all().find(|method| method.tableau.name == name)
    }
}

impl Default for &'static Method {
    fn default() -> Self {
        &METHODS[0]
    }
}

/// A Runge–Kutta method as published, for `y' = f(t, y)`:
///
/// ```text
/// kᵢ = f(t + cᵢ h, y + h Σⱼ aᵢⱼ kⱼ)
/// ```
///
/// A step consists of `stages` stages. The next row of `a` holds the weights `b` of the new point, and its `k` is the first of the next
/// step (first same as last). Further rows are stages that only dense output needs. In explicit methods a stage depends on those before
/// it. In implicit ones, which have a [`spectrum`](Self::spectrum), all stages after the first are coupled, and the new point is the
/// last of them.
#[derive(Debug)]
pub struct Tableau {
    /// The short name by which it is chosen.
    pub name: &'static str,
    /// Its name in the literature.
    pub title: &'static str,
    /// Order of the step: the error of one step is `O(h^(order + 1))`.
    pub order: u32,
    /// The order of the error estimate in `h`.
    pub error_power: u32,
    /// Order of the dense output: its error within a step is `O(h^(dense_order + 1))`.
    pub dense_order: u32,
    /// Evaluations of one step, if the method is explicit.
    pub stages: usize,
    /// The position of each stage within the step.
    pub c: &'static [f64],
    /// The weights of the other stages in each stage; row `stages` is the new point.
    pub a: &'static [&'static [f64]],
    /// Weights `e` of the error estimate `h Σ eⱼ kⱼ`.
    pub error: &'static [f64],
    /// Weights of a second, coarser estimate, in methods that have one. The two combine to `error² / √(error² + 0.01 coarse²)`: E. Hairer,
    /// S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., 1993, section II.10, eq. (10.17).
    pub coarse_error: Option<&'static [f64]>,
    /// Weights of the coefficients of dense output beyond those of the cubic through both ends (see
    /// [`Interpolant`](crate::Interpolant)).
    pub dense: &'static [&'static [f64]],
    /// The smallest and the largest ratio of a step to the one before.
    pub step_change: (f64, f64),
    /// Weight β of the previous step in the choice of the next one, `h · 0.9 err^(3β/4 − 1/k) err_before^β` with `k = error_power`; 0, or
    /// about 0.04 for a smoother sequence of steps (K. Gustafsson's controller, section IV.2 of the second volume).
    pub smoothing: f64,
    /// Where the stability region ends on the negative real axis. `None` in methods whose last stage is not at the end of the step, since
    /// they have no cheap stiffness test.
    pub stability: Option<f64>,
    /// Data to solve for the stages of an implicit method; `None` in explicit ones. Solving needs an allocator, hence the feature `std`:
    /// without it, a run by such a method is refused at its start.
    pub spectrum: Option<Spectrum>,
}

/// Eigenvalues `μ` of the matrix `A` of the coupled stages, one real and conjugate pairs, with left and right eigenvectors `w A = μ w`,
/// `A u = μ u`, `w u = 1`.
///
/// They decouple the linear systems of Newton's method for all stages into one for each eigenvalue: E. Hairer, G. Wanner, *Solving Ordinary
/// Differential Equations II*, 2nd ed., 1996, section IV.8.
#[derive(Clone, Copy, Debug)]
pub struct Spectrum {
    /// The real eigenvalue. Error estimates are filtered by `(I − h μ J)⁻¹` with it, where `J` is the Jacobian of `f`, so they are bounded
    /// however stiff the machine is.
    pub real: f64,
    /// `w` of the real one, a number for each stage.
    pub left_of_real: &'static [f64],
    /// `u` of the real one.
    pub right_of_real: &'static [f64],
    /// The complex ones: of each pair the one with positive imaginary part.
    pub pairs: &'static [Conjugates],
}

/// A complex eigenvalue with its eigenvectors. Those of its conjugate are the conjugates.
#[derive(Clone, Copy, Debug)]
pub struct Conjugates {
    /// The eigenvalue.
    pub value: [f64; 2],
    /// `w`, a number for each stage.
    pub left: &'static [[f64; 2]],
    /// `u`.
    pub right: &'static [[f64; 2]],
}
