//! The Sobol sequence, with the direction numbers of S. Joe and F. Y. Kuo.

use std::sync::OnceLock;

/// Polynomials and initial direction numbers.
const TABLE: &str = include_str!("sobol.txt");

/// The most variables of a design.
pub const MOST_VARIABLES: usize = 256;

/// Points of the sequence.
pub(crate) struct Sobol;

impl Sobol {
    /// The number of binary digits of each coordinate; 2 to this power is the number of distinct points.
    pub const BITS: u32 = 52;

    /// The digits of a coordinate of the point with this index, in Gray code order; the first 2ᵏ points are the same set
    /// as in natural order.
    pub fn digits(index: u64, variable: u32) -> u64 {
        let gray = index ^ index >> 1;
        let numbers = directions().get(variable as usize);
        let numbers = numbers.map_or(&[][..], |numbers| numbers.as_slice());
        let set = numbers
            .iter()
            .enumerate()
            .filter(|(k, _)| gray >> k & 1 == 1);
        set.fold(0, |digits, (_, number)| digits ^ number)
    }
}

/// The direction numbers of each variable; the most significant digit of a coordinate is the highest bit.
fn directions() -> &'static [Vec<u64>] {
    static DIRECTIONS: OnceLock<Vec<Vec<u64>>> = OnceLock::new();
    DIRECTIONS.get_or_init(|| {
        let rows = TABLE.lines().filter(|line| !line.starts_with('#'));
        let rows = rows.map(|line| {
            let numbers = line.split(' ').filter_map(|word| word.parse().ok());
            numbers.collect::<Vec<u64>>()
        });
        // The first coordinate is the van der Corput sequence, for which every m is 1.
        let first = vec![1; Sobol::BITS as usize];
        let others = rows.map(|row| initial(&row));
        std::iter::once(first).chain(others).map(scaled).collect()
    })
}

/// All m from a polynomial and the initial ones: `mₖ = 2 a₁ mₖ₋₁ ⊕ … ⊕ 2ˢ mₖ₋ₛ ⊕ mₖ₋ₛ`.
fn initial(row: &[u64]) -> Vec<u64> {
    let Some((&polynomial, first)) = row.split_first() else {
        return Vec::new();
    };
    let degree = first.len();
    let mut m = first.to_vec();
    while m.len() < Sobol::BITS as usize {
        let k = m.len();
        let mut next = m[k - degree];
        for i in 1..=degree {
            if polynomial >> (degree - i) & 1 == 1 {
                next ^= m[k - i] << i;
            }
        }
        m.push(next);
    }
    m
}

fn scaled(m: Vec<u64>) -> Vec<u64> {
    let numbered = m.into_iter().enumerate();
    numbered
        .map(|(k, m)| m << (Sobol::BITS - 1 - k as u32))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of `scipy.stats.qmc.Sobol(256, scramble=False)` of SciPy 1.17.1, in coordinates 0, 1, 2, 9, 50 and 255.
    #[test]
    fn points_are_those_of_scipy() {
        const COORDINATES: [u32; 6] = [0, 1, 2, 9, 50, 255];
        for (index, point) in [
            (0, [0.0; 6]),
            (1, [0.5; 6]),
            (2, [0.75, 0.25, 0.25, 0.75, 0.25, 0.75]),
            (3, [0.25, 0.75, 0.75, 0.25, 0.75, 0.25]),
            (7, [0.125, 0.625, 0.375, 0.875, 0.875, 0.125]),
            (
                100,
                [
                    0.4140625, 0.2578125, 0.7734375, 0.6953125, 0.8828125, 0.5703125,
                ],
            ),
            (
                1023,
                [
                    0.0009765625,
                    0.7529296875,
                    0.6123046875,
                    0.8505859375,
                    0.2587890625,
                    0.8427734375,
                ],
            ),
            (
                4095,
                [
                    0.000244140625,
                    0.941162109375,
                    0.334228515625,
                    0.246337890625,
                    0.465087890625,
                    0.613037109375,
                ],
            ),
        ] {
            let found = COORDINATES.map(|variable| {
                Sobol::digits(index, variable) as f64 / (1u64 << Sobol::BITS) as f64
            });
            assert_eq!(found, point, "{index}");
        }
    }

    /// In each coordinate the first 2ᵏ points are in different cells of 2⁻ᵏ.
    #[test]
    fn every_coordinate_is_a_permutation_of_cells() {
        assert_eq!(directions().len(), MOST_VARIABLES);
        for variable in 0..MOST_VARIABLES as u32 {
            let mut cells: Vec<u64> = (0..256)
                .map(|index| Sobol::digits(index, variable) >> (Sobol::BITS - 8))
                .collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..256).collect::<Vec<_>>());
        }
    }
}
