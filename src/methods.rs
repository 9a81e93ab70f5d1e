//! Runge–Kutta methods: what is published of each, and the list of those to choose from.
//!
//! To add a method, write its [`Tableau`] and put one line into the list of [`METHODS`].
//! The same tests then hold it to its orders, its dense output, its events and to allocating
//! nothing. A method of one's own is a `Tableau` given to [`Method::try_new`].

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

/// The most stages that a method may have, those for dense output counted.
pub const MAX_STAGES: usize = 16;

/// Every method, the default first: explicit ones for most machines, `radau5` for stiff ones.
pub static METHODS: [Method; 4] = [
    Method::wide(dormand_prince_8::TABLEAU, dormand_prince_8::BEYOND),
    Method::wide(dormand_prince_5::TABLEAU, dormand_prince_5::BEYOND),
    Method::wide(bogacki_shampine::TABLEAU, bogacki_shampine::BEYOND),
    Method::new(radau_5::TABLEAU),
];

/// `radau9` and `radau13`, of orders 9 and 13: as `radau5`, for stiff machines at tolerances finer than about 1e-7 and 1e-10, where steps of order 5
/// are many.
pub static RADAU_OF_HIGH_ORDER: [Method; 2] = [
    Method::new(radau_9_13::NINTH),
    Method::new(radau_9_13::THIRTEENTH),
];

/// Steps by the Taylor series of the motion, for machines that have one
/// ([`System::check_series`](crate::System::check_series)): to fine tolerances the fastest method of smooth machines.
///
/// Its order is 12 or 20, by the tolerance. Dense output and events are of the same order and cost nothing of the
/// machine. A compiled machine has its series where its spec says `methods { taylor }`. Steps end where a run ends, not at samples. It needs an allocator, hence the feature `std`, and inputs that keep
/// their defaults.
///
/// It is no Runge–Kutta method, so it is not among [`METHODS`]; its [`Tableau`] holds the nodes and weights by which work and
/// dissipation are integrated along the motion.
pub static TAYLOR: Method = Method::of_kind(taylor::TABLEAU, Kind::Series);

/// Moreau's time stepping, for machines with many contacts that open and close
/// ([`System::unilateral_contacts`](crate::System::unilateral_contacts)): piles, and whatever chatters.
///
/// Steps have the fixed length [`longest_step`](crate::Simulation::longest_step), and tolerances play no part. Contacts are asked once
/// in each which impulses they give, by the law `newton` with rates of the middle of the step; no instant of an impact is looked for. The
/// error after an impact is of order 1 in the length of steps, and of order 2 where nothing touches. It is a method of
/// [`Simulation`](crate::Simulation)s.
pub static MOREAU: Method = Method::of_kind(moreau::TABLEAU, Kind::Impulses);

/// Methods whose steps have the fixed length [`longest_step`](crate::Simulation::longest_step), and no part in which a tolerance decides.
/// Nothing bounds the error of their steps: halve the length to see it.
///
/// * `rk4`, of order 4, and `semi-implicit-euler`, of order 1: so many evaluations in each step, for loops of a fixed rate. They
///   need no allocator.
/// * `gauss4`, `gauss6`, `gauss8`, of orders 4, 6 and 8, and `rattle`, of order 2, which keeps constraints of positions as well:
///   symplectic and symmetric, so that the energy of a machine that loses nothing does not drift, however long the run.
/// * `generalized-alpha`, of order 2: as structural dynamics has it, implicit, damping what is too fast for the step.
pub static FIXED_STEP_METHODS: [Method; 7] = [
    Method::of_kind(rk4::TABLEAU, Kind::Fixed(Rule::Explicit)),
    Method::of_kind(
        semi_implicit_euler::TABLEAU,
        Kind::Fixed(Rule::SemiImplicitEuler),
    ),
    gauss::FOURTH,
    gauss::SIXTH,
    gauss::EIGHTH,
    Method::of_kind(rattle::TABLEAU, Kind::Fixed(Rule::Rattle)),
    Method::of_kind(
        generalized_alpha::TABLEAU,
        Kind::Fixed(Rule::GeneralizedAlpha),
    ),
];

/// Nodes and weights of the midpoint rule, for the work and the dissipation in steps that have no stages.
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
    /// Stages in momenta that depend on each other.
    Gauss,
    Rattle,
    GeneralizedAlpha,
}

/// What the steps of a method are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Stages, of an explicit or an implicit method.
    RungeKutta,
    /// The Taylor series of the motion.
    Series,
    /// Impulses of contacts, in steps of a fixed length.
    Impulses,
    /// Steps of a fixed length.
    Fixed(Rule),
}

/// A method of integration, ready to run.
#[derive(Debug)]
pub struct Method {
    /// What is published of it.
    pub tableau: Tableau,
    pub(crate) scheme: Scheme,
    pub(crate) kind: Kind,
}

impl Method {
    /// Dormand and Prince's method of order 8, the default.
    pub const DOP853: &'static Self = &METHODS[0];
    /// Dormand and Prince's method of order 5: for coarse tolerances, and steps that are short anyhow.
    pub const DOPRI5: &'static Self = &METHODS[1];
    /// Bogacki and Shampine's method of order 3.
    pub const BS32: &'static Self = &METHODS[2];
    /// The implicit method of Radau of order 5, for stiff machines.
    pub const RADAU5: &'static Self = &METHODS[3];
    /// Steps by [Taylor series](TAYLOR).
    pub const TAYLOR: &'static Self = &TAYLOR;
    /// [Moreau's time stepping](MOREAU).
    pub const MOREAU: &'static Self = &MOREAU;

    /// Prepares a published method for machines, whose positions follow from their velocities, if its
    /// tableau is what it says: rows have their lengths and add up to their nodes, and the weights of
    /// the new point, of the estimates of the error and of dense output meet every order condition up
    /// to the stated orders, to rounding.
    ///
    /// A simulation borrows its method for good: keep it in a `static`, or leak it.
    ///
    /// # Errors
    /// Which row does not meet which condition.
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

    /// Whether the tableau is what it says: the check of [`try_new`](Self::try_new).
    ///
    /// # Errors
    /// Which row does not meet which condition.
    pub fn check(&self) -> Result<(), MethodError> {
        check::check(&self.tableau)
    }

    /// Whether dense output asks for accelerations beyond those of a step.
    pub(crate) fn dense_needs_evaluations(&self) -> bool {
        self.scheme.length > self.tableau.stages + 1
    }

    /// Prepares a tableau of which tests know that it is what it says.
    const fn new(tableau: Tableau) -> Self {
        let scheme = Scheme::new(&tableau, None);
        Self {
            tableau,
            scheme,
            kind: Kind::RungeKutta,
        }
    }

    /// Prepares a tableau of another kind than Runge and Kutta's.
    const fn of_kind(tableau: Tableau, kind: Kind) -> Self {
        Self {
            kind,
            ..Self::new(tableau)
        }
    }

    /// Prepares a tableau of which the difference between its published coefficients and their `f64` is known.
    const fn wide(tableau: Tableau, beyond: digits::Beyond) -> Self {
        let scheme = Scheme::new(&tableau, Some(beyond));
        Self {
            scheme,
            ..Self::new(tableau)
        }
    }

    /// Every method that has a name: the [`METHODS`] of Runge and Kutta, [`TAYLOR`], [`MOREAU`], the
    /// [`FIXED_STEP_METHODS`] and [`RADAU_OF_HIGH_ORDER`].
    pub fn all() -> impl Iterator<Item = &'static Self> {
        let others = [&TAYLOR, &MOREAU];
        let fixed = FIXED_STEP_METHODS.iter();
        let high = RADAU_OF_HIGH_ORDER.iter();
        METHODS.iter().chain(others).chain(fixed).chain(high)
    }

    /// Whether its steps have a fixed length, and not one that a tolerance asks for.
    pub fn has_fixed_steps(&self) -> bool {
        matches!(self.kind, Kind::Impulses | Kind::Fixed(_))
    }

    /// Whether its steps need no memory beyond that of every stepper.
    #[cfg(not(feature = "std"))]
    pub(crate) fn needs_no_allocator(&self) -> bool {
        let plain = [Rule::Explicit, Rule::SemiImplicitEuler].map(Kind::Fixed);
        self.kind == Kind::RungeKutta || plain.contains(&self.kind)
    }

    /// Whether the motion within a step is the quintic through both ends, and not the cubic and what stages add to it.
    pub(crate) fn is_quintic(&self) -> bool {
        matches!(self.kind, Kind::Fixed(_)) && self.tableau.dense_order > 3
    }

    /// Whether its steps ask contacts for impulses, so that no instant of an impact is looked for.
    #[cfg(feature = "std")]
    pub(crate) fn is_by_impulses(&self) -> bool {
        self.kind == Kind::Impulses
    }

    /// The method of that short name: `dop853`, `dopri5`, `bs32`, `radau5`, `taylor`, `moreau`, `rk4`, `semi-implicit-euler`, `gauss4`,
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

/// A Runge–Kutta method as it is published, for `y' = f(t, y)`:
///
/// ```text
/// kᵢ = f(t + cᵢ h, y + h Σⱼ aᵢⱼ kⱼ)
/// ```
///
/// `stages` of them make a step, the row of `a` after those holds the weights `b` of the new point,
/// and its `k` is the first of the next step (first same as last). Rows after that are stages that
/// only dense output needs. In explicit methods a stage depends on those before it; in implicit ones,
/// which have a [`spectrum`](Self::spectrum), all stages after the first depend on each other, and
/// the new point is the last of them.
#[derive(Debug)]
pub struct Tableau {
    /// The short name by which it is chosen.
    pub name: &'static str,
    /// Its name in the literature.
    pub title: &'static str,
    /// Order of the step: the error of one step is `O(h^(order + 1))`.
    pub order: u32,
    /// The power of `h` by which the estimate of the error falls.
    pub error_power: u32,
    /// Order of the dense output: its error within a step is `O(h^(dense_order + 1))`.
    pub dense_order: u32,
    /// Evaluations of one step, if the method is explicit.
    pub stages: usize,
    /// Where in the step each stage is.
    pub c: &'static [f64],
    /// What each stage takes from the others; row `stages` is the new point.
    pub a: &'static [&'static [f64]],
    /// Weights `e` of the error estimate `h Σ eⱼ kⱼ`.
    pub error: &'static [f64],
    /// Weights of a second, coarser estimate, in methods that have one. The two make `error² /
    /// √(error² + 0.01 coarse²)`: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary
    /// Differential Equations I*, 2nd ed., 1993, section II.10, eq. (10.17).
    pub coarse_error: Option<&'static [f64]>,
    /// Weights of the coefficients of dense output beyond those of the cubic through both ends (see
    /// [`Interpolant`](crate::Interpolant)).
    pub dense: &'static [&'static [f64]],
    /// The least and the greatest factor by which one step may follow another.
    pub step_change: (f64, f64),
    /// Weight β of the step before in the choice of the next one, `h · 0.9 err^(3β/4 − 1/k)
    /// err_before^β` with `k = error_power`; 0, or about 0.04 for a smoother sequence of steps (K.
    /// Gustafsson's controller, section IV.2 of the second volume).
    pub smoothing: f64,
    /// Where the region of stability ends on the negative real axis. Not given in methods whose
    /// last stage is not at the end of the step, since they have no cheap test of stiffness.
    pub stability: Option<f64>,
    /// How the stages of an implicit method are solved for; none in explicit ones. Needs an allocator,
    /// hence the feature `std`: without it, a run by such a method is refused at its start.
    pub spectrum: Option<Spectrum>,
}

/// Eigenvalues `μ` of the matrix `A` of the stages that depend on each other, one real and pairs that are
/// conjugate, with left and right eigenvectors `w A = μ w`, `A u = μ u`, `w u = 1`.
///
/// With them the linear systems of Newton's method for all stages fall apart into one for each
/// eigenvalue: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., 1996,
/// section IV.8.
#[derive(Clone, Copy, Debug)]
pub struct Spectrum {
    /// The real eigenvalue. Estimates of the error go through `(I − h μ J)⁻¹` with it, `J` the
    /// derivatives of `f`: so they are bounded however stiff the machine is.
    pub real: f64,
    /// `w` of the real one, a number for each stage.
    pub left_of_real: &'static [f64],
    /// `u` of the real one.
    pub right_of_real: &'static [f64],
    /// The complex ones, of each pair that with the positive imaginary part.
    pub pairs: &'static [Conjugates],
}

/// An eigenvalue that is not real, with its eigenvectors: those of its conjugate are theirs.
#[derive(Clone, Copy, Debug)]
pub struct Conjugates {
    /// The eigenvalue.
    pub value: [f64; 2],
    /// `w`, a number for each stage.
    pub left: &'static [[f64; 2]],
    /// `u`.
    pub right: &'static [[f64; 2]],
}
