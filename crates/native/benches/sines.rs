//! The cost of sines and cosines, in ns per angle: for all angles of a
//! state together, and in lanes.
//!
//! ```text
//! cargo bench -p lagrangian-native
//! ```

use std::hint::black_box;
use std::time::Instant;

use lagrangian_native::{Lanes, Number};
use lagrangian_scalar::{Kernel, Scalar};

/// Arrays of K angles, one for each state.
struct Sines<'a, T, const K: usize>(&'a [[T; K]]);

/// Sums all sines and cosines: the sums depend on one another, the sines do not.
impl<T: Copy, const K: usize> Kernel<T> for Sines<'_, T, K> {
    type Output = T;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> T {
        let mut sum = N::ZERO;
        for state in self.0 {
            for (sin, cos) in N::sin_cos_all(state.map(N::load)) {
                sum = sum + (sin - cos);
            }
        }
        sum.store()
    }
}

/// The angles of each state depend on the sines of the previous one.
struct Chained<'a, T, const K: usize>(&'a [[T; K]]);

impl<T: Copy, const K: usize> Kernel<T> for Chained<'_, T, K> {
    type Output = T;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> T {
        let mut last = N::ZERO;
        for state in self.0 {
            for (sin, cos) in N::sin_cos_all(state.map(|x| N::load(x) + last)) {
                last = (sin - cos) * N::from_f64(1e-200);
            }
        }
        last.store()
    }
}

/// Evaluates them by the functions of the standard library.
struct Plain<'a, const K: usize>(&'a [[f64; K]]);

impl<const K: usize> Plain<'_, K> {
    fn run(self, sin_cos: impl Fn(f64) -> (f64, f64)) -> f64 {
        let mut sum = 0.0;
        for state in self.0 {
            for x in state {
                let (sin, cos) = sin_cos(*x);
                sum += sin - cos;
            }
        }
        sum
    }
}

/// The least time of many calls, in ns per call, since disturbances only add time.
fn least<R>(mut f: impl FnMut() -> R) -> f64 {
    let once = |f: &mut dyn FnMut()| {
        let start = Instant::now();
        f();
        start.elapsed().as_nanos() as f64
    };
    let mut f = || {
        black_box(f());
    };
    (0..2000).fold(f64::INFINITY, |least, _| least.min(once(&mut f)))
}

const STATES: usize = 240;

fn angles<const K: usize>() -> Vec<[f64; K]> {
    let mut x = 0.5_f64;
    let mut next = || {
        x = (x * 997.0 + 0.123).fract();
        20.0 * x - 10.0
    };
    (0..STATES)
        .map(|_| core::array::from_fn(|_| next()))
        .collect()
}

fn alone<const K: usize>() {
    let states = angles::<K>();
    let each = (STATES * K) as f64;
    let row = [
        least(|| f64::run(Sines(black_box(&states)))) / each,
        least(|| f64::run(Chained(black_box(&states)))) / STATES as f64,
        least(|| Plain(black_box(&states)).run(f64::sin_cos)) / each,
        least(|| Plain(black_box(&states)).run(Scalar::sin_cos)) / each,
    ];
    println!(
        "| {K} | {:.2} | {:.1} | {:.2} | {:.2} |",
        row[0], row[1], row[2], row[3]
    );
}

fn in_lanes<const N: usize>()
where
    Lanes<N>: Number,
{
    let states: Vec<[Lanes<N>; 4]> = angles::<N>()
        .chunks_exact(4)
        .map(|x| [Lanes(x[0]), Lanes(x[1]), Lanes(x[2]), Lanes(x[3])])
        .collect();
    let each = (STATES * N) as f64;
    let cost = least(|| Lanes::<N>::run(Sines(black_box(&states)))) / each;
    println!("| {N} | {cost:.2} |");
}

fn main() {
    println!(
        "| angles of a state | ns an angle | ns a state that waits for the last | std | libm |"
    );
    println!("| --: | --: | --: | --: | --: |");
    alone::<1>();
    alone::<2>();
    alone::<3>();
    alone::<4>();
    alone::<5>();
    alone::<6>();
    alone::<8>();
    alone::<12>();
    alone::<16>();
    alone::<32>();
    alone::<64>();
    println!("\n| lanes | ns an angle |\n| --: | --: |");
    in_lanes::<2>();
    in_lanes::<4>();
    in_lanes::<8>();
}
