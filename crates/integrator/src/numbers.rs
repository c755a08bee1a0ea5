//! Numbers for sampling: a function of seed, pixel, set, index and dimension.

use std::ops::Range;

/// The numbers of one sample of a pixel.
///
/// A pixel's samples come in *sets* that are independent of one another. Within a set
/// they are points of Sobol's sequence, in pairs of dimensions, scrambled after Owen as
/// Burley does it (*Practical Hash-based Owen Scrambling*, JCGT 9(4), 2020, with the
/// constants of Vegdahl, 2021): any 2^k first ones are spread evenly, and each alone is
/// uniformly distributed. The same numbers are drawn on any machine, in any order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stream {
    set: u64,
    index: u32,
}

impl Stream {
    /// The numbers of the sample with that index in a set of the pixel at that column
    /// and row. Another seed gives other numbers.
    #[must_use]
    pub fn new(seed: u64, (x, y): (u32, u32), set: u32, index: u32) -> Self {
        let pixel = u64::from(x) << 32 | u64::from(y);
        Self { set: mixed(mixed(mixed(seed) ^ pixel) ^ u64::from(set)), index }
    }

    /// Those of another sample of the same set.
    #[must_use]
    pub const fn at(self, index: u32) -> Self {
        Self { index, ..self }
    }

    /// The first sample of a set that has nothing to do with this one, nor with those of other
    /// indices.
    #[must_use]
    pub(crate) const fn apart(self, index: u32) -> Self {
        Self { set: mixed(self.set ^ mixed(index as u64)), index: 0 }
    }

    /// Two numbers of at least 0 and below 1 for that use; those for 0 are the place in
    /// the pixel.
    #[must_use]
    pub fn pair(self, dimension: u32) -> [f64; 2] {
        let scrambling = self.scrambling(dimension);
        // In other dimensions the points come in another order, or else they would be the
        // same in all but the scrambling.
        let index = match (dimension, scrambling) {
            (0, _) => self.index,
            (_, [first, second]) => {
                scrambled(self.index.reverse_bits(), first ^ second).reverse_bits()
            }
        };
        point(index, scrambling)
    }

    /// The places in the pixel of the samples of this set with those indices: the pairs for 0.
    pub(crate) fn places(self, indices: Range<u32>) -> impl Iterator<Item = [f64; 2]> {
        let scrambling = self.scrambling(0);
        indices.map(move |index| point(index, scrambling))
    }

    /// What is the same for all samples of the set.
    fn scrambling(self, dimension: u32) -> [u32; 2] {
        halves(mixed(self.set.wrapping_add(u64::from(dimension))))
    }
}

fn point(index: u32, [first, second]: [u32; 2]) -> [f64; 2] {
    let across = scrambled(index, first);
    let down = scrambled(second_of_sobol(index), second);
    [across, down].map(|bits| f64::from(bits.reverse_bits()) / 4_294_967_296.0)
}

/// The second dimension of Sobol's sequence, lowest bit first; the first one is the
/// index itself.
///
/// Its direction numbers are the powers of 1 + x, as polynomials over the integers modulo 2, so it
/// puts 1 + x for x. Since (1 + x)^n is 1 + x^n for n = 2^k, the upper n coefficients of each 2n
/// are added to the lower ones.
const fn second_of_sobol(index: u32) -> u32 {
    let mut sum = index;
    sum ^= (sum >> 16) & 0x0000_ffff;
    sum ^= (sum >> 8) & 0x00ff_00ff;
    sum ^= (sum >> 4) & 0x0f0f_0f0f;
    sum ^= (sum >> 2) & 0x3333_3333;
    sum ^= (sum >> 1) & 0x5555_5555;
    sum
}

/// Turns each bit over or not by what the lower ones and the seed are.
fn scrambled(mut bits: u32, seed: u32) -> u32 {
    bits ^= bits.wrapping_mul(0x3d20_adea);
    bits = bits.wrapping_add(seed);
    bits = bits.wrapping_mul((seed >> 16) | 1);
    bits ^= bits.wrapping_mul(0x0552_6c56);
    bits ^= bits.wrapping_mul(0x53a2_2864);
    bits
}

/// Each bit depends on all of `x`: the finaliser of SplitMix64 (Steele, Lea and Flood,
/// *Fast Splittable Pseudorandom Number Generators*, 2014).
pub(crate) const fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

const fn halves(x: u64) -> [u32; 2] {
    [(x >> 32) as u32, x as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_sobols_sequence() {
        // From Joe and Kuo's tables: 0, 1/2, 3/4, 1/4, 5/8, 1/8, 3/8, 7/8 by index.
        let right = [0.0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875];
        for (index, right) in (0..).zip(right) {
            let found = f64::from(second_of_sobol(index).reverse_bits()) / 4_294_967_296.0;
            assert_eq!(found, right, "{index}");
        }
        // By their own rule: each is the last one, and the last one shifted up.
        let mut direction = 1_u32;
        for bit in 0..32 {
            assert_eq!(second_of_sobol(1 << bit), direction, "{bit}");
            direction ^= direction << 1;
        }
        assert_eq!(second_of_sobol(0b1011), 0b1 ^ 0b11 ^ 0b1111);
    }

    /// Of 2^k points there is one in each of 2^k boxes of equal size, of whatever shape.
    #[test]
    fn points_are_spread_evenly_in_all_dimensions() {
        for dimension in [0, 1, 2, 77] {
            for power in 0..9_u32 {
                let points: Vec<[f64; 2]> = (0..1 << power)
                    .map(|index| Stream::new(7, (3, 5), 1, index).pair(dimension))
                    .collect();
                for across in 0..=power {
                    let (wide, high) = (1_u32 << across, 1_u32 << (power - across));
                    let mut seen = vec![false; 1 << power];
                    for [u, v] in &points {
                        let at = (u * f64::from(wide)) as u32 * high + (v * f64::from(high)) as u32;
                        assert!(!seen[at as usize], "{dimension} {power} {across}");
                        seen[at as usize] = true;
                    }
                }
            }
        }
    }

    /// Mean, second moment and product of the first points of many sets, which are
    /// independent: within five standard errors of those of uniform numbers.
    #[test]
    fn each_point_alone_is_uniform() {
        for (index, dimension) in [(0, 0), (1, 0), (5, 0), (0, 3), (2, 9)] {
            let (mut sum, mut square, mut product, n) = (0.0, 0.0, 0.0, 40_000_u32);
            for set in 0..n {
                let [u, v] = Stream::new(1, (set % 200, set / 200), 0, index).pair(dimension);
                let (u, v) = (u - 0.5, v - 0.5);
                sum += u;
                square += u * u - 1.0 / 12.0;
                product += u * v;
            }
            let n = f64::from(n);
            assert!(sum.abs() < 5.0 * (n / 12.0).sqrt(), "{index} {dimension} {sum}");
            assert!(square.abs() < 5.0 * (n / 180.0).sqrt(), "{index} {dimension} {square}");
            assert!(product.abs() < 5.0 * (n / 144.0).sqrt(), "{index} {dimension} {product}");
        }
    }

    #[test]
    fn seeds_pixels_sets_and_dimensions_are_independent() {
        let [u, v] = Stream::new(0, (0, 0), 0, 0).pair(0);
        let others = [
            Stream::new(1, (0, 0), 0, 0).pair(0),
            Stream::new(0, (1, 0), 0, 0).pair(0),
            Stream::new(0, (0, 1), 0, 0).pair(0),
            Stream::new(0, (0, 0), 1, 0).pair(0),
            Stream::new(0, (0, 0), 0, 1).pair(0),
            Stream::new(0, (0, 0), 0, 0).pair(1),
        ];
        assert!(others.iter().all(|[a, b]| *a != u && *b != v));
        assert_eq!([u, v], Stream::new(0, (0, 0), 0, 0).pair(0));
    }
}
