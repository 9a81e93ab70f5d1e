//! Evaluates the same machine at several states, or with several sets of parameters, at once.

use core::fmt::{self, Display};

use lagrangian_native::{Lanes, Number};

use crate::scalar::Kernel;
use crate::system::SERIES_ROWS;
use crate::{Singular, System, Vector};

/// `N` systems of one type, evaluated at once in the lanes of vector registers: for sweeps over parameters or start values, in which
/// evaluations do not wait for each other. `N` is 2, 4 or 8.
///
/// The result of a lane has the bits of the system alone, whatever the other lanes hold. No lane stops the others: a lane without
/// accelerations has its error, which is that of the system alone, and the others have their numbers. (They are then evaluated one
/// by one, which takes `N` times as long.)
///
/// ```
/// use lagrangian::{Batch, Lanes};
/// use lagrangian_machines::DoublePendulum;
///
/// // Four pendulums, each with another upper rod, in the same state.
/// let lengths = [0.5, 1.0, 1.5, 2.0];
/// let systems = lengths.map(|l1| DoublePendulum { l1, ..Default::default() }.prepare());
/// let four = Batch::new(systems.each_ref());
///
/// let q = [Lanes::splat(0.3), Lanes::splat(-0.2)];
/// let v = [Lanes::splat(0.0); 2];
/// let u = four.default_inputs(&systems[0]);
/// let mut a = v;
/// four.accelerations(Lanes::splat(0.0), &q, &v, &u, &mut a)?;
/// assert!(a[0][0].abs() > a[0][3].abs()); // the shortest starts fastest
/// # Ok::<(), lagrangian::SomeSingular<4>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Batch<S: Batched<N>, const N: usize> {
    equations: S::Batch,
    /// The individual systems, used when one of them has no accelerations.
    systems: [S; N],
    /// The lanes whose parameters leave them without accelerations, if there are any.
    singular: Option<[bool; N]>,
}

/// Some of several systems have no accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SomeSingular<const N: usize> {
    /// The error of each lane; the accelerations of such a lane are NaN.
    pub lanes: [Option<Singular>; N],
}

impl<const N: usize> Display for SomeSingular<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lanes = self.lanes.iter().enumerate();
        let stopped = lanes.filter_map(|(lane, singular)| Some((lane, singular.as_ref()?)));
        for (place, (lane, singular)) in stopped.enumerate() {
            let separator = if place == 0 { "" } else { "; " };
            write!(f, "{separator}lane {lane}: {singular}")?;
        }
        Ok(())
    }
}

impl<const N: usize> core::error::Error for SomeSingular<N> {}

impl<S: Batched<N>, const N: usize> Batch<S, N> {
    /// A system for each lane.
    pub fn new(systems: [&S; N]) -> Self {
        let singular = systems.map(S::is_singular);
        // Systems without accelerations cannot be evaluated together with others; a regular one takes their place.
        let substitute = systems.into_iter().find(|system| !system.is_singular());
        let stand_in = |system: &S| {
            if system.is_singular() {
                substitute
            } else {
                None
            }
        };
        let evaluated = systems.map(|system| stand_in(system).unwrap_or(system));
        Batch {
            equations: S::batch(evaluated),
            systems: systems.map(|system| *system),
            singular: singular.contains(&true).then_some(singular),
        }
    }

    /// The system of a lane.
    #[cfg(feature = "std")]
    pub(crate) fn system(&self, lane: usize) -> &S {
        &self.systems[lane]
    }

    /// One system in every lane.
    pub fn of(system: &S) -> Self {
        Batch::new([system; N])
    }

    /// The data that emitted functions take for these systems. A system without accelerations is represented by another one.
    pub fn equations(&self) -> &S::Batch {
        &self.equations
    }

    /// Accelerations `a = M⁻¹ f` of every lane at its time `t`, coordinates `q`, rates `v` and inputs `u`.
    ///
    /// # Errors
    /// If some lanes have none. The results of all others are valid.
    #[inline]
    pub fn accelerations(
        &self,
        t: Lanes<N>,
        q: &S::Vectors,
        v: &S::Vectors,
        u: &S::BatchInputs,
        a: &mut S::Vectors,
    ) -> Result<(), SomeSingular<N>> {
        let evaluated = S::batch_accelerations(&self.equations, t, q, v, u, a);
        match (evaluated, self.singular) {
            (Ok(()), None) => Ok(()),
            (Ok(()), Some(singular)) => self.one_by_one(singular, t, (q, v, u), a),
            (Err(_), _) => self.one_by_one([true; N], t, (q, v, u), a),
        }
    }

    /// The accelerations of all lanes, evaluated one by one.
    #[cold]
    fn one_by_one(
        &self,
        lanes: [bool; N],
        t: Lanes<N>,
        (q, v, u): (&S::Vectors, &S::Vectors, &S::BatchInputs),
        a: &mut S::Vectors,
    ) -> Result<(), SomeSingular<N>> {
        let mut singular = [None; N];
        for (lane, system) in self.systems.iter().enumerate().filter(|(k, _)| lanes[*k]) {
            let (q, v) = (q.lane(lane), v.lane(lane));
            let u = S::inputs_of_lane(u, lane);
            let mut own = q.zeros_like();
            singular[lane] = system.accelerations(t[lane], &q, &v, &u, &mut own).err();
            for (row, number) in a.as_mut().iter_mut().zip(own.as_slice()) {
                row[lane] = if singular[lane].is_some() {
                    f64::NAN
                } else {
                    *number
                };
            }
        }
        if singular.iter().any(Option::is_some) {
            Err(SomeSingular { lanes: singular })
        } else {
            Ok(())
        }
    }

    /// The Taylor series of the motion of every lane through its state, as in [`System::series`], with at most 24 rows. The time is
    /// the sum of two numbers. Call it only if [`System::check_series`] succeeds. `lists` is a buffer of some kilobytes with any
    /// content; a caller that keeps it between steps saves the time of clearing it.
    ///
    /// # Errors
    /// If some lanes have none. The results of all others are valid.
    #[inline]
    pub fn series(
        &self,
        t: [Lanes<N>; 2],
        q: &S::Vectors,
        v: &S::Vectors,
        u: &S::BatchInputs,
        lists: &mut S::SeriesLists,
        coefficients: &mut [S::Vectors],
    ) -> Result<(), SomeSingular<N>> {
        match S::batch_series(&self.equations, t, q, v, u, lists, coefficients) {
            Ok(()) if self.singular.is_none() => Ok(()),
            _ => self.series_one_by_one(t, (q, v, u), coefficients),
        }
    }

    /// The series of all lanes, evaluated one by one.
    #[cold]
    fn series_one_by_one(
        &self,
        t: [Lanes<N>; 2],
        (q, v, u): (&S::Vectors, &S::Vectors, &S::BatchInputs),
        coefficients: &mut [S::Vectors],
    ) -> Result<(), SomeSingular<N>> {
        let mut singular = [None; N];
        for (lane, system) in self.systems.iter().enumerate() {
            let (q, v) = (q.lane(lane), v.lane(lane));
            let u = S::inputs_of_lane(u, lane);
            let mut own: [S::Vector; SERIES_ROWS] = q.several_zeros_like();
            let count = coefficients.len().min(SERIES_ROWS);
            let t = t.map(|t| t[lane]);
            singular[lane] = match self.singular {
                Some(which) if which[lane] => {
                    let mut a = q.zeros_like();
                    system.accelerations(t[0], &q, &v, &u, &mut a).err()
                }
                _ => system.series(t, &q, &v, &u, &mut own[..count]).err(),
            };
            for (rows, own) in coefficients.iter_mut().zip(&own) {
                for (row, number) in rows.as_mut().iter_mut().zip(own.as_slice()) {
                    row[lane] = match singular[lane] {
                        Some(_) => f64::NAN,
                        None => *number,
                    };
                }
            }
        }
        if singular.iter().any(Option::is_some) {
            Err(SomeSingular { lanes: singular })
        } else {
            Ok(())
        }
    }

    /// The vectors of all lanes, side by side.
    pub fn vectors(&self, vectors: [&S::Vector; N]) -> S::Vectors {
        let mut rows = S::Vectors::ZEROS;
        for (lane, vector) in vectors.iter().enumerate() {
            for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
                row[lane] = *number;
            }
        }
        rows
    }

    /// The inputs of all lanes, side by side.
    pub fn inputs(&self, inputs: [&S::Inputs; N]) -> S::BatchInputs {
        S::batch_inputs(inputs)
    }

    /// The default inputs in every lane.
    pub fn default_inputs(&self, system: &S) -> S::BatchInputs {
        S::batch_inputs([&system.default_inputs(); N])
    }
}

/// Equations of motion that [`Batch`] can evaluate `N` at a time. Emitted code implements it.
pub trait Batched<const N: usize>: System + Copy {
    /// The equations of `N` systems.
    type Batch: Clone + Copy + core::fmt::Debug;
    /// One row of lanes per coordinate, in the order of the description.
    type Vectors: LaneVector<N, Vector = Self::Vector>;
    /// The inputs of `N` systems by name.
    type BatchInputs;
    /// Memory for [`batch_series`](Self::batch_series): coefficients whose products it computes; `()` if there is no series.
    type SeriesLists: Default;

    /// The equations of these systems.
    fn batch(systems: [&Self; N]) -> Self::Batch;

    /// Inputs for each of them.
    fn batch_inputs(inputs: [&Self::Inputs; N]) -> Self::BatchInputs;

    /// The inputs of one of them; `lane` is less than N.
    fn inputs_of_lane(inputs: &Self::BatchInputs, lane: usize) -> Self::Inputs;

    /// Whether the parameters alone leave the system without accelerations.
    fn is_singular(&self) -> bool;

    /// [`System::accelerations`] of every lane, or an error if one of them has none.
    fn batch_accelerations(
        several: &Self::Batch,
        t: Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::BatchInputs,
        a: &mut Self::Vectors,
    ) -> Result<(), Singular>;

    /// [`System::series`] of every lane, with at most 24 rows, or an error if one of them has none. Call it only if
    /// [`System::check_series`] succeeds. The content of `lists` before the call does not matter.
    fn batch_series(
        _several: &Self::Batch,
        _t: [Lanes<N>; 2],
        _q: &Self::Vectors,
        _v: &Self::Vectors,
        _u: &Self::BatchInputs,
        _lists: &mut Self::SeriesLists,
        _coefficients: &mut [Self::Vectors],
    ) -> Result<(), Singular> {
        Ok(())
    }
}

/// `[Lanes<N>; D]`: a row of `N` lanes for each of D coordinates.
pub trait LaneVector<const N: usize>:
    Copy + Vector<Lanes<N>> + AsRef<[Lanes<N>]> + AsMut<[Lanes<N>]>
{
    /// One number for each coordinate.
    type Vector: Vector;

    /// Zeros everywhere.
    const ZEROS: Self;

    /// The numbers of a lane, which is less than N.
    fn lane(&self, lane: usize) -> Self::Vector;

    /// Runs a computation on lanes in the widest registers of the processor: [`Number::run`].
    fn run<K: Kernel<Lanes<N>>>(kernel: K) -> K::Output;
}

impl<const N: usize, const D: usize> LaneVector<N> for [Lanes<N>; D]
where
    Lanes<N>: Number,
{
    type Vector = [f64; D];

    const ZEROS: Self = [Lanes::splat(0.0); D];

    fn lane(&self, lane: usize) -> [f64; D] {
        self.map(|row| row[lane])
    }

    #[inline(always)]
    fn run<K: Kernel<Lanes<N>>>(kernel: K) -> K::Output {
        <Lanes<N> as Number>::run(kernel)
    }
}
