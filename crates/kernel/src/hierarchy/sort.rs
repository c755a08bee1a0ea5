//! An order of rays in which neighbours go through the same boxes: by the signs
//! of the direction, and then by where the ray enters the box around all, along
//! Morton's curve. So what one ray has brought near is there for the next.

use super::Hierarchy;
use lancer_math::{Bounds, Ray};

/// Rays fewer than this are not worth it.
const FEW: usize = 256;

/// Rays are fetched so many at a time.
const BLOCK: usize = 64;

/// Bits of a place along each axis.
const BITS: u32 = 9;

/// Bits of a key: those of the place and three signs.
const KEY_BITS: u32 = 3 * BITS + 3;

/// Bits that are sorted by at a time.
const DIGIT: u32 = 10;
const _: () = assert!(KEY_BITS.is_multiple_of(DIGIT));

impl Hierarchy {
    /// The numbers of the rays in an order in which they are better followed;
    /// nothing where the order they have is as good.
    pub(crate) fn order_of(&self, rays: &[Ray]) -> Option<Vec<u32>> {
        order(&Keys::new(&self.bounds, 0), rays)
    }
}

/// The same for rays that start all over a box and soon meet something: first by a
/// cell of an eighth of the box's sides, as the rays of all directions there go
/// through the same shapes.
pub(crate) fn order_in(bounds: &Bounds, rays: &[Ray]) -> Option<Vec<u32>> {
    order(&Keys::new(bounds, 3), rays)
}

fn order(keys: &Keys, rays: &[Ray]) -> Option<Vec<u32>> {
    if rays.len() < FEW || keys.is_ordered(rays) {
        return None;
    }
    let mut list: Vec<u64> = (0_u32..)
        .zip(rays)
        .map(|(number, ray)| u64::from(keys.of(ray)) << 32 | u64::from(number))
        .collect();
    let mut other = vec![0; list.len()];
    for pass in 0..KEY_BITS / DIGIT {
        let shift = 32 + pass * DIGIT;
        let digit = |entry: u64| (entry >> shift) as usize & ((1 << DIGIT) - 1);
        let mut starts = [0_u32; 1 << DIGIT];
        for &entry in &list {
            starts[digit(entry)] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += std::mem::replace(start, sum);
        }
        for &entry in &list {
            let place = &mut starts[digit(entry)];
            other[*place as usize] = entry;
            *place += 1;
        }
        std::mem::swap(&mut list, &mut other);
    }
    Some(list.into_iter().map(|entry| entry as u32).collect())
}

/// The answer for each ray, put where it belongs; they are asked for in that order,
/// or as they come.
#[inline(always)]
pub(crate) fn answer_each<A>(
    order: Option<&[u32]>,
    rays: &[Ray],
    answers: &mut [A],
    mut answer: impl FnMut(&Ray) -> A,
) {
    let Some(order) = order else {
        for (ray, to) in rays.iter().zip(answers) {
            *to = answer(ray);
        }
        return;
    };
    // There are some, as there is an order.
    let mut block = [rays[0]; BLOCK];
    for numbers in order.chunks(BLOCK) {
        for (ray, &number) in block.iter_mut().zip(numbers) {
            *ray = rays[number as usize];
        }
        for (ray, &number) in block.iter().zip(numbers) {
            answers[number as usize] = answer(ray);
        }
    }
}

impl Keys {
    /// Whether most rays are near the one before, by a sample.
    fn is_ordered(&self, rays: &[Ray]) -> bool {
        let step = rays.len() / 128;
        let pairs = rays.chunks_exact(step).filter_map(|chunk| chunk.first_chunk());
        let (mut near, mut all) = (0, 0);
        for [a, b] in pairs {
            // The same octant, and a cell of an eighth of the box's sides.
            near += usize::from((self.of(a) ^ self.of(b)) >> (3 * (BITS - 3)) == 0);
            all += 1;
        }
        4 * near >= 3 * all
    }

    fn new(bounds: &Bounds, coarse: u32) -> Self {
        let sides = bounds.sides();
        let scale = sides.map(|side| if side > 0.0 { f64::from(1 << BITS) / side } else { 0.0 });
        Self {
            low: [0, 1, 2].map(|i| bounds.min[i]),
            high: [0, 1, 2].map(|i| bounds.max[i]),
            scale: [scale.x, scale.y, scale.z],
            below: 3 * (BITS - coarse),
        }
    }
}

struct Keys {
    low: [f64; 3],
    high: [f64; 3],
    scale: [f64; 3],
    /// How many bits of the place come after the signs.
    below: u32,
}

impl Keys {
    /// Any number for what is no ray: it decides nothing but the order.
    #[inline(always)]
    fn of(&self, ray: &Ray) -> u32 {
        let (o, d) = (ray.origin, ray.direction);
        let mut enter = 0.0_f64;
        let mut signs = 0;
        for axis in 0..3 {
            let is_negative = d[axis] < 0.0;
            let face = if is_negative { self.high[axis] } else { self.low[axis] };
            let t = (face - o[axis]) / d[axis];
            enter = if t > enter { t } else { enter };
            signs = signs << 1 | u32::from(is_negative);
        }
        let mut key = 0;
        for axis in 0..3 {
            let place = (o[axis] + enter * d[axis] - self.low[axis]) * self.scale[axis];
            // Saturates.
            let cell = (place as u32).min((1 << BITS) - 1);
            key |= spread(cell) << axis;
        }
        let above = key >> self.below;
        above << (self.below + 3) | signs << self.below | key & ((1 << self.below) - 1)
    }
}

/// Two zeros behind each of at most ten bits.
#[inline(always)]
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00FF;
    let x = (x | x << 8) & 0x0300_F00F;
    let x = (x | x << 4) & 0x030C_30C3;
    (x | x << 2) & 0x0924_9249
}
