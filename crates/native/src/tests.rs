//! Every register type gives the same bits, lanes do not influence each other, and the polynomials are as
//! accurate as claimed.

use std::vec;
use std::vec::Vec;

use lagrangian_scalar::{DoubleDouble, Kernel, Scalar, series};

use crate::vector::Register;
use crate::x86::{self, Eight, Four, FourOfMany, Native, One, TwiceFour, Two};
use crate::{Fused, Lanes, Number, sincos};

/// The xorshift generator of G. Marsaglia, with the same numbers in every run.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Uniform in [0, 1).
    fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number of any magnitude that occurs, and of some that should not.
    fn number(&mut self) -> f64 {
        match self.bits() % 16 {
            0 => EXTREMES[self.bits() as usize % EXTREMES.len()],
            1 => f64::from_bits(self.bits()),
            2 => (self.bits() % 9) as f64 - 4.0,
            _ => 100.0 * (self.uniform() - 0.5),
        }
    }
}

const EXTREMES: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e300,
    -1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    99_999.999,
    -1e22,
];

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Sines and cosines of many angles, each by itself.
struct Sines<'a, T>(&'a [T]);

impl<T: Copy> Kernel<T> for Sines<'_, T> {
    type Output = Vec<(T, T)>;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> Vec<(T, T)> {
        let mut all = Vec::with_capacity(self.0.len());
        for angle in self.0 {
            let (sin, cos) = N::load(*angle).sin_cos();
            all.push((sin.store(), cos.store()));
        }
        all
    }
}

/// Sines and cosines of the K angles of each state.
struct States<'a, const K: usize>(&'a [f64]);

impl<const K: usize> Kernel<f64> for States<'_, K> {
    type Output = Vec<(f64, f64)>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Vec<(f64, f64)> {
        let mut all = Vec::with_capacity(self.0.len());
        for state in self.0.as_chunks::<K>().0 {
            let mut angles = [N::ZERO; K];
            for (angle, stored) in angles.iter_mut().zip(state) {
                *angle = N::load(*stored);
            }
            for (sin, cos) in N::sin_cos_all(angles) {
                all.push((sin.store(), cos.store()));
            }
        }
        all
    }
}

/// The sums of products of two times `P` lists, of growing length.
struct Sums<'a, const P: usize>([&'a [[f64; P]]; 2]);

impl<const P: usize> Kernel<f64> for Sums<'_, P> {
    type Output = Vec<[f64; P]>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Vec<[f64; P]> {
        let [a, b] = self.0;
        let mut all = Vec::new();
        for count in 0..=a.len() {
            let sums = N::convolve_all::<P>(&a[..count], &b[..count]);
            let mut stored = [0.0; P];
            for (to, sum) in stored.iter_mut().zip(sums) {
                *to = sum.store();
            }
            all.push(stored);
        }
        all
    }
}

/// Lists that fill registers and lists that do not give the same bits packed and one by one; and the sums are those
/// of the products.
#[test]
fn sums_of_products_have_the_same_bits_in_every_register() {
    fn check<const P: usize>(random: &mut Random) {
        let mut rows = || -> Vec<[f64; P]> {
            (0..25)
                .map(|_| core::array::from_fn(|_| random.uniform() - 0.5))
                .collect()
        };
        let (a, b) = (rows(), rows());
        let lists = [&a[..], &b[..]];
        let packed = <f64 as Number>::run(Sums(lists));
        assert_eq!(packed, Sums(lists).run::<Fused>(), "{P}");
        for (count, sums) in packed.iter().enumerate() {
            for (p, sum) in sums.iter().enumerate() {
                let exact: f64 = (0..count).map(|j| a[j][p] * b[count - 1 - j][p]).sum();
                assert!((sum - exact).abs() < 1e-14, "{P} {count} {p}");
            }
        }
    }
    let mut random = Random(0x5eed_0007);
    check::<1>(&mut random);
    check::<2>(&mut random);
    check::<3>(&mut random);
    check::<4>(&mut random);
    check::<6>(&mut random);
    check::<8>(&mut random);
    check::<12>(&mut random);
    check::<16>(&mut random);
    check::<20>(&mut random);
    check::<24>(&mut random);
    check::<29>(&mut random);
}

/// The sums of products of `L` pairs of lists of growing length, with one number given for each pair.
struct Swept<'a, T, const P: usize, const L: usize> {
    numbers: [&'a [[T; P]]; 2],
    places: [&'a [usize; L]; 2],
}

impl<T: Copy, const P: usize, const L: usize> Kernel<T> for Swept<'_, T, P, L> {
    type Output = Vec<[T; L]>;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> Vec<[T; L]> {
        let ([of_a, of_b], [first, second]) = (self.places, self.numbers);
        // Numbers that were not stored must not be read.
        let nothing = N::from_f64(f64::NAN).store();
        let mut a = vec![[nothing; P]; first.len()];
        let mut b = a.clone();
        let mut all = Vec::new();
        for order in 2..first.len() {
            series::keep::<N, P, L>(&mut a, order, first[order], of_a);
            series::keep::<N, P, L>(&mut b, order, second[order], of_b);
            let mut stored = [nothing; L];
            let sums = series::sweep::<N, P, L>([&a, &b], order, [of_a, of_b]);
            for (to, sum) in stored.iter_mut().zip(sums) {
                *to = sum.store();
            }
            all.push(stored);
        }
        all
    }
}

/// Lists that occur in several pairs: stored once in registers of several states, and once per pair where one
/// state is computed.
#[test]
fn sums_of_products_have_the_same_bits_in_lanes() {
    fn check<const W: usize, V: Native<Stored = Lanes<W>>, const P: usize, const L: usize>(
        random: &mut Random,
    ) {
        let mut places = || -> [usize; L] {
            let mut count = 0;
            core::array::from_fn(|_| {
                let place = (random.uniform() * (count + 1) as f64) as usize;
                count = count.max(place + 1);
                place
            })
        };
        let places = [places(), places()];
        let rows = places.map(|places| -> Vec<[Lanes<W>; P]> {
            let mut row = || {
                let mut lists = [Lanes([0.0; W]); P];
                for list in &mut lists {
                    *list = Lanes(core::array::from_fn(|_| random.uniform() - 0.5));
                }
                let number = |p: usize| places.get(p).map_or(Lanes([0.0; W]), |at| lists[*at]);
                core::array::from_fn(number)
            };
            (0..24).map(|_| row()).collect()
        });
        let [a, b] = &rows;
        let of = [&places[0], &places[1]];
        let swept = || Swept {
            numbers: [&a[..], &b[..]],
            places: of,
        };
        let by_array = swept().run::<Register<[f64; W]>>();
        let by_register = x86::run::<V, _>(swept()).ok();
        for lane in 0..W {
            let alone = rows.each_ref().map(|rows| -> Vec<[f64; P]> {
                rows.iter()
                    .map(|row| row.map(|lanes| lanes[lane]))
                    .collect()
            });
            let one = <f64 as Number>::run(Swept {
                numbers: [&alone[0][..], &alone[1][..]],
                places: of,
            });
            for found in [Some(&by_array), by_register.as_ref()]
                .into_iter()
                .flatten()
            {
                let found: Vec<[f64; L]> = found
                    .iter()
                    .map(|row| row.map(|lanes| lanes[lane]))
                    .collect();
                assert_eq!(found, one, "{L} of {P} in lane {lane} of {W}");
            }
        }
    }
    fn check_all<const W: usize, V: Native<Stored = Lanes<W>>>(random: &mut Random) {
        check::<W, V, 2, 1>(random);
        check::<W, V, 4, 3>(random);
        check::<W, V, 8, 8>(random);
        check::<W, V, 12, 10>(random);
        check::<W, V, 20, 20>(random);
        check::<W, V, 24, 24>(random);
    }
    let mut random = Random(0x5eed_0008);
    check_all::<2, Two>(&mut random);
    check_all::<4, Four>(&mut random);
    check_all::<4, FourOfMany>(&mut random);
    check_all::<8, TwiceFour>(&mut random);
    check_all::<8, Eight>(&mut random);
}

fn in_lanes<const N: usize>(angles: &[f64]) -> Vec<Lanes<N>> {
    angles
        .as_chunks::<N>()
        .0
        .iter()
        .map(|x| Lanes(*x))
        .collect()
}

/// The pairs of all lanes, one after another.
fn flat<const N: usize>(pairs: Vec<(Lanes<N>, Lanes<N>)>) -> Vec<(f64, f64)> {
    pairs
        .iter()
        .flat_map(|(sin, cos)| (0..N).map(|lane| (sin[lane], cos[lane])))
        .collect()
}

fn by_register<const N: usize, V: Native<Stored = Lanes<N>>>(
    angles: &[f64],
) -> Option<Vec<(f64, f64)>> {
    x86::run::<V, _>(Sines(&in_lanes(angles))).ok().map(flat)
}

fn by_array<const N: usize>(angles: &[f64]) -> Option<Vec<(f64, f64)>> {
    Some(flat(Sines(&in_lanes(angles)).run::<Register<[f64; N]>>()))
}

/// Four million angles: uniform up to slightly beyond the range of the polynomials, of all magnitudes, and extremes.
#[test]
fn sines_have_the_same_bits_in_every_register() {
    let mut random = Random(0x5eed_0001);
    for _ in 0..100 {
        let angles: Vec<f64> = (0..40_000)
            .map(|i| match i % 4 {
                0 => 2.02e5 * (random.uniform() - 0.5),
                1 => 20.0 * (random.uniform() - 0.5),
                2 => random.number(),
                _ => f64::from_bits(random.bits()),
            })
            .collect();
        let expected = Sines(&angles).run::<Fused>();
        let registers = [
            ("One", x86::run::<One, _>(Sines(&angles)).ok()),
            ("Two", by_register::<2, Two>(&angles)),
            ("Four", by_register::<4, Four>(&angles)),
            ("FourOfMany", by_register::<4, FourOfMany>(&angles)),
            ("TwiceFour", by_register::<8, TwiceFour>(&angles)),
            ("Eight", by_register::<8, Eight>(&angles)),
            ("[f64; 2]", by_array::<2>(&angles)),
            ("[f64; 4]", by_array::<4>(&angles)),
            ("[f64; 8]", by_array::<8>(&angles)),
        ];
        for (name, results) in registers {
            // `None` where the processor lacks the register.
            let Some(results) = results else { continue };
            assert_eq!(results.len(), expected.len());
            for ((x, found), expected) in angles.iter().zip(&results).zip(&expected) {
                assert!(
                    same(found.0, expected.0) && same(found.1, expected.1),
                    "{name} at {x:e}: {found:?} instead of {expected:?}"
                );
            }
        }
    }
}

/// For any number of angles: a full register, a part of one, and more than fit into registers.
#[test]
fn a_state_may_have_any_number_of_angles() {
    fn check<const K: usize>() {
        let mut random = Random(0x5eed_0005);
        let angles: Vec<f64> = (0..K * 100).map(|_| random.number()).collect();
        let Ok(found) = x86::run::<One, _>(States::<K>(&angles)) else {
            return;
        };
        let expected = Sines(&angles).run::<Fused>();
        assert_eq!(found.len(), expected.len());
        for ((x, found), expected) in angles.iter().zip(found).zip(expected) {
            assert!(
                same(found.0, expected.0) && same(found.1, expected.1),
                "{x:e} of {K}"
            );
        }
    }
    check::<1>();
    check::<2>();
    check::<3>();
    check::<4>();
    check::<5>();
    check::<6>();
    check::<7>();
    check::<8>();
    check::<17>();
    check::<31>();
    check::<32>();
    check::<33>();
    check::<64>();
    check::<71>();
}

/// Every operation of a scalar on three numbers; truth values as 0 and 1.
struct Everything<T>([T; 3]);

/// The number of results.
const RESULTS: usize = 36;

impl<T: Copy> Kernel<T> for Everything<T> {
    type Output = [T; RESULTS];

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> [T; RESULTS] {
        let [a, b, c] = self.0.map(N::load);
        let [(sin1, cos1), (sin2, cos2), (sin3, cos3)] = N::sin_cos_all([a, b, c]);
        let (sin, cos) = a.sin_cos();
        [
            a + b,
            a - b,
            a * b,
            a / b,
            -a,
            a.mul_add(b, c),
            a.mul_sub(b, c),
            a.neg_mul_add(b, c),
            a.product_error(b),
            a.sqrt(),
            a.abs(),
            a.sign(),
            a.min(b),
            a.max(b),
            a.powi(3),
            a.powi(-2),
            sin,
            cos,
            sin1,
            cos1,
            sin2,
            cos2,
            sin3,
            cos3,
            a.tan(),
            a.asin(),
            a.acos(),
            a.atan(),
            a.atan2(b),
            a.sinh(),
            a.cosh(),
            a.tanh(),
            a.exp(),
            a.ln(),
            a.powf(b),
            N::from_ratio(1, 3) + N::pi() * N::from_f64(2.0) + N::ONE + N::ZERO,
        ]
        .map(N::store)
    }
}

fn lanes_are_strangers<const N: usize>(
    run: impl Fn(Everything<Lanes<N>>) -> Option<[Lanes<N>; RESULTS]>,
) {
    let mut random = Random(0x5eed_0002);
    for _ in 0..20_000 {
        let operands = [(); 3].map(|()| Lanes([(); N].map(|()| random.number())));
        // `None` where the processor lacks the register.
        let Some(results) = run(Everything(operands)) else {
            return;
        };
        for lane in 0..N {
            let alone = operands.map(|x| x[lane]);
            for (i, expected) in Everything(alone).run::<Fused>().into_iter().enumerate() {
                let found = results[i][lane];
                assert!(
                    same(found, expected),
                    "result {i} of {alone:?}: {found:e} instead of {expected:e}"
                );
            }
        }
    }
}

#[test]
fn a_lane_is_a_number_alone_whatever_its_neighbours_hold() {
    lanes_are_strangers::<2>(|all| x86::run::<Two, _>(all).ok());
    lanes_are_strangers::<4>(|all| x86::run::<Four, _>(all).ok());
    lanes_are_strangers::<4>(|all| x86::run::<FourOfMany, _>(all).ok());
    lanes_are_strangers::<8>(|all| x86::run::<TwiceFour, _>(all).ok());
    lanes_are_strangers::<8>(|all| x86::run::<Eight, _>(all).ok());
    lanes_are_strangers::<4>(|all| Some(all.run::<Register<[f64; 4]>>()));
    let one = |all: Everything<f64>| x86::run::<One, _>(all).ok();
    let mut random = Random(0x5eed_0003);
    for _ in 0..20_000 {
        let operands = [(); 3].map(|()| random.number());
        let Some(found) = one(Everything(operands)) else {
            return;
        };
        let expected = Everything(operands).run::<Fused>();
        assert!(
            (0..RESULTS).all(|i| same(found[i], expected[i])),
            "{operands:?}"
        );
    }
}

/// Predicates that hold for all lanes at once.
struct Questions<T>([T; 2]);

impl<T: Copy> Kernel<T> for Questions<T> {
    type Output = (bool, bool, bool, f64);

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> Self::Output {
        let [a, b] = self.0.map(N::load);
        (a.is_finite(), a.exceeds(b), a == b, a.to_f64())
    }
}

#[test]
fn a_question_to_lanes_is_answered_by_all_of_them() {
    fn ask<const N: usize>(random: &mut Random)
    where
        Lanes<N>: Number,
    {
        for _ in 0..20_000 {
            let a = Lanes([(); N].map(|()| random.number()));
            let b = match random.bits() % 3 {
                0 => a,
                1 => Lanes(a.0.map(|x| x - 1.0)),
                _ => Lanes([(); N].map(|()| random.number())),
            };
            let (finite, exceeds, equal, first) = Lanes::<N>::run(Questions([a, b]));
            assert_eq!(finite, a.0.iter().all(|x| x.is_finite()));
            assert_eq!(
                exceeds,
                a.0.iter().zip(&b.0).all(|(a, b)| a > b),
                "{a:?} > {b:?}"
            );
            assert_eq!(equal, a.0.iter().zip(&b.0).all(|(a, b)| a == b));
            assert!(same(first, a[0]));
        }
    }
    let mut random = Random(0x5eed_0004);
    ask::<2>(&mut random);
    ask::<4>(&mut random);
    ask::<8>(&mut random);
}

/// The polynomials are evaluated with 106 bits, so that the error is their own.
#[test]
fn the_polynomials_are_as_near_as_their_bounds() {
    let horner = |c: [f64; 6], z: DoubleDouble| {
        c.iter().rev().fold(DoubleDouble::ZERO, |sum, c| {
            sum * z + DoubleDouble::from(*c)
        })
    };
    let (mut worst_sin, mut worst_cos) = (0.0, 0.0);
    const POINTS: u32 = 20_000;
    for i in 1..=POINTS {
        let r = core::f64::consts::FRAC_PI_4 * (1.0 + 0.5_f64.powi(36)) * f64::from(i)
            / f64::from(POINTS);
        let r = DoubleDouble::from(r);
        let z = r * r;
        let (sin, cos) = r.sin_cos();
        let by_sin = r + r * z * horner(sincos::SIN, z);
        let by_cos =
            DoubleDouble::ONE - z / DoubleDouble::from(2.0) + z * z * horner(sincos::COS, z);
        worst_sin = f64::max(worst_sin, ((by_sin - sin) / sin).hi().abs());
        worst_cos = f64::max(worst_cos, ((by_cos - cos) / cos).hi().abs());
    }
    println!(
        "relative errors: sine 2^{:.2}, cosine 2^{:.2}",
        worst_sin.log2(),
        worst_cos.log2()
    );
    assert!(worst_sin < 2.0_f64.powf(-57.8));
    assert!(worst_cos < 2.0_f64.powf(-63.9));
}

/// The assumption of the reduction: the smallest distance of a number up to 10⁵ from a multiple of π/2.
#[test]
fn no_number_comes_too_near_to_a_multiple_of_a_right_angle() {
    let right = DoubleDouble::pi() / DoubleDouble::from(2.0);
    let distance = |k: u32| (right * DoubleDouble::from(f64::from(k))).lo().abs();
    let nearest = (1..=63_662).map(distance).fold(f64::INFINITY, f64::min);
    println!("nearest: 2^{:.2}", nearest.log2());
    assert!(nearest > 2.0_f64.powi(-61));
}

/// All operations on pairs of numbers, for every pair from three lists.
struct Each<'a, T>([&'a [T]; 3]);

impl<T: Copy> Kernel<T> for Each<'_, T> {
    type Output = Vec<[[T; 2]; 2]>;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> Self::Output {
        let mut all = Vec::new();
        let store = |pair: [N; 2]| pair.map(N::store);
        let [first, second, third] = self.0;
        for ((a, b), c) in first
            .windows(2)
            .zip(second.windows(2))
            .zip(third.windows(2))
        {
            let [a, b, c] = [a, b, c].map(|pair| [N::load(pair[0]), N::load(pair[1])]);
            let alone = |f: fn(N, N) -> N| [f(a[0], b[0]), f(a[1], b[1])];
            let contracted = |f: fn(N, N, N) -> N| [f(a[0], b[0], c[0]), f(a[1], b[1], c[1])];
            for (at_once, alone) in [
                (N::add_each(a, b), alone(N::add)),
                (N::sub_each(a, b), alone(N::sub)),
                (N::mul_each(a, b), alone(N::mul)),
                (N::div_each(a, b), alone(N::div)),
                (N::mul_add_each(a, b, c), contracted(N::mul_add)),
                (N::mul_sub_each(a, b, c), contracted(N::mul_sub)),
                (N::neg_mul_add_each(a, b, c), contracted(N::neg_mul_add)),
            ] {
                all.push([store(at_once), store(alone)]);
            }
        }
        all
    }
}

#[test]
fn two_at_once_have_the_bits_of_each_by_itself() {
    let mut random = Random(11);
    let lists: [Vec<f64>; 3] = std::array::from_fn(|_| (0..500).map(|_| random.number()).collect());
    let lists = lists.each_ref().map(Vec::as_slice);
    let check = |found: Vec<[[f64; 2]; 2]>| {
        assert_eq!(found.len(), 7 * 499);
        for (place, [at_once, alone]) in found.into_iter().enumerate() {
            let is_same = at_once.iter().zip(alone).all(|(a, b)| same(*a, b));
            assert!(is_same, "{place}: {at_once:?} for {alone:?}");
        }
    };
    check(f64::run(Each(lists)));
    check(Each(lists).run::<Fused>());
    check(Each(lists).run::<f64>());
}

/// Numbers over a divisor.
struct Over<'a, T>(&'a [T], i64);

impl<T: Copy> Kernel<T> for Over<'_, T> {
    type Output = Vec<T>;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> Vec<T> {
        let divisor = N::divisor(self.1);
        let mut all = Vec::with_capacity(self.0.len());
        for x in self.0 {
            all.push(N::load(*x).over(divisor).store());
        }
        all
    }
}

#[test]
fn numbers_over_a_divisor_are_quotients() {
    let mut random = Random(0x6c07_8965_9b13_77f1);
    let orders = (2..=40).flat_map(|j| [j, j * (j - 1)]);
    for n in orders.chain([1_000_003, (1 << 40) - 1]) {
        let mut numbers = Vec::new();
        for _ in 0..500 {
            let mantissa = 1.0 + random.uniform();
            numbers.push(mantissa * 2_f64.powi((random.bits() % 600) as i32 - 300));
            // Multiples of numbers halfway between two neighbours, and what is next to these: the quotients that are the
            // hardest to round.
            let halfway = u128::from(random.bits() >> 11 | 1 << 53 | 1);
            let multiple = (n as u128 * halfway) as f64;
            numbers.extend([multiple, multiple.next_up(), multiple.next_down()]);
        }
        let negative: Vec<f64> = numbers.iter().map(|x| -x).collect();
        numbers.extend(negative);
        for x in f64::run(Over(&[0.0, -0.0], n)) {
            assert_eq!(x, 0.0, "{n}");
        }
        for x in f64::run(Over(&[f64::INFINITY, f64::NAN], n)) {
            assert!(!x.is_finite(), "{n}: {x}");
        }
        let found = f64::run(Over(&numbers, n));
        for (x, found) in numbers.iter().zip(found) {
            let quotient = x / n as f64;
            assert!(same(found, quotient), "{x:e}/{n}: {found:e} {quotient:e}");
        }
        let lanes: Vec<Lanes<4>> = (numbers.chunks_exact(4))
            .map(|x| Lanes([x[0], x[1], x[2], x[3]]))
            .collect();
        for (x, found) in lanes.iter().zip(Lanes::run(Over(&lanes, n))) {
            for lane in 0..4 {
                let quotient = x[lane] / n as f64;
                assert!(same(found[lane], quotient), "{:e}/{n}", x[lane]);
            }
        }
    }
}

/// A solution with the factors of a matrix of `K` rows: in registers, and in memory.
struct Solution<'a, const K: usize> {
    factors: &'a [f64],
    right: [f64; K],
}

impl<const K: usize> Kernel<f64> for Solution<'_, K> {
    type Output = [[f64; K]; 2];

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> [[f64; K]; 2] {
        let mut right = [N::ZERO; K];
        for (x, right) in right.iter_mut().zip(self.right) {
            *x = N::load(right);
        }
        let found = series::solved::<N, K>(self.factors, right);
        let mut in_registers = [0.0; K];
        for (x, found) in in_registers.iter_mut().zip(found) {
            *x = found.store();
        }
        let (mut in_memory, mut scratch) = (self.right, [0.0; K]);
        series::solve::<N>(K, self.factors, &mut in_memory, &mut scratch);
        [in_registers, in_memory]
    }
}

#[expect(
    clippy::needless_range_loop,
    reason = "both triangles are written by their indices"
)]
fn solutions_agree<const K: usize>(random: &mut Random) {
    // Dominated by its diagonal, so that it is well conditioned.
    let mut matrix = [[0.0; K]; K];
    for i in 0..K {
        for j in 0..i {
            matrix[i][j] = random.uniform() - 0.5;
            matrix[j][i] = matrix[i][j];
        }
        matrix[i][i] = K as f64 + random.uniform();
    }
    let mut factors = matrix.concat();
    series::factor::<f64>(K, K, &mut factors).unwrap();
    let mut right = [0.0; K];
    right.fill_with(|| random.uniform() - 0.5);
    let factors = &factors;
    let [in_registers, in_memory] = f64::run(Solution { factors, right });
    assert_eq!(in_registers, in_memory, "{K}");
    for (row, right) in matrix.iter().zip(right) {
        let product: f64 = row.iter().zip(in_registers).map(|(m, x)| m * x).sum();
        // K rounding errors each of the inverse, of the solution and of the product here, of terms whose sum is below 3.
        let bound = 9.0 * K as f64 * f64::EPSILON;
        assert!((product - right).abs() < bound, "{K}: {product} {right}");
    }
}

#[test]
fn solutions_in_registers_have_the_bits_of_those_in_memory() {
    let mut random = Random(0x27d4_eb2f_1656_67c5);
    for _ in 0..20 {
        solutions_agree::<4>(&mut random);
        solutions_agree::<5>(&mut random);
        solutions_agree::<7>(&mut random);
        solutions_agree::<12>(&mut random);
        solutions_agree::<24>(&mut random);
    }
}

/// Factors a matrix of `K` rows, of which those from `held` on are constraints. Returns the inverse, or the row whose pivot vanishes.
struct Factor<T, const K: usize> {
    matrix: Vec<T>,
    held: usize,
}

impl<T: Copy, const K: usize> Kernel<T> for Factor<T, K> {
    type Output = Result<Vec<T>, usize>;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(mut self) -> Self::Output {
        match series::factor::<N>(K, self.held, &mut self.matrix) {
            Ok(()) => Ok(self.matrix),
            Err(vanished) => Err(vanished.row),
        }
    }
}

fn inverses_agree<const K: usize>(random: &mut Random, held: usize, vanishing: Option<usize>) {
    let mut matrix = vec![0.0; K * K];
    for i in 0..K {
        for j in 0..i {
            // Constraints meet each other in no element, and some elements vanish.
            let is_zero = j >= held || random.bits().is_multiple_of(4);
            matrix[i * K + j] = if is_zero { 0.0 } else { random.uniform() - 0.5 };
        }
        matrix[i * K + i] = if i < held {
            K as f64 + random.uniform()
        } else {
            0.0
        };
    }
    if let Some(row) = vanishing {
        matrix[row * K..][..row].fill(0.0);
        matrix[row * K + row] = 0.0;
    }
    let in_lanes = matrix.iter().map(|x| Lanes::<4>::splat(*x)).collect();
    let alone = f64::run(Factor::<f64, K> { matrix, held });
    let in_lanes = Lanes::<4>::run(Factor::<Lanes<4>, K> {
        matrix: in_lanes,
        held,
    });
    match (alone, in_lanes) {
        (Ok(alone), Ok(in_lanes)) => {
            assert_eq!(vanishing, None);
            for (one, all) in alone.into_iter().zip(in_lanes) {
                assert!(
                    all.0.iter().all(|x| x.to_bits() == one.to_bits()),
                    "{K}: {one}"
                );
            }
        }
        (alone, in_lanes) => assert_eq!([alone.err(), in_lanes.err()], [vanishing; 2], "{K}"),
    }
}

/// Rows in registers are those of the loop over elements, which lanes go through.
#[test]
fn inverses_in_registers_have_the_bits_of_those_in_lanes() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for _ in 0..20 {
        inverses_agree::<5>(&mut random, 5, None);
        inverses_agree::<9>(&mut random, 9, None);
        inverses_agree::<12>(&mut random, 8, None);
        inverses_agree::<13>(&mut random, 7, None);
        inverses_agree::<13>(&mut random, 7, Some(3));
        inverses_agree::<13>(&mut random, 7, Some(10));
        inverses_agree::<16>(&mut random, 16, None);
        inverses_agree::<19>(&mut random, 15, None);
        inverses_agree::<24>(&mut random, 24, None);
    }
}
