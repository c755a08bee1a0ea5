//! Which of its two colours a checker shows.

use super::naive_unit;
use lancer_math::Vector;

/// The smallest double not below sin(k / 2), for k = 1, 2, 3: from there on
/// trunc(2 |asin s|) is at least k.
const SINES: [f64; 3] = [0.479_425_538_604_203, 0.841_470_984_807_896_6, 0.997_494_986_604_054_4];

/// The largest double not above cos(k / 2), for k = 1 to 6: up to there
/// trunc(2 acos c) is at least k.
const COSINES: [f64; 6] = [
    0.877_582_561_890_372_6,
    0.540_302_305_868_139_7,
    0.070_737_201_667_702_9,
    -0.416_146_836_547_142_4,
    -0.801_143_615_546_933_8,
    -0.989_992_496_600_445_5,
];

/// Whether the point of a sphere with that normal shows the second colour.
///
/// The original's cells are trunc(2 |asin z|), plus 1 below the equator, and
/// trunc(2 acos x) of the normal turned into the equator's plane; odd sums show
/// the second colour. Comparing with sines and cosines of the cells' borders
/// decides the same without the system's `asin` and `acos`.
pub(super) fn on_sphere(normal: Vector) -> bool {
    let sine = normal.z;
    let latitude = SINES.iter().filter(|&&border| sine.abs() >= border).count();
    let south = usize::from(sine < 0.0);
    let on_equator = naive_unit(normal - Vector::z() * sine);
    let longitude = COSINES.iter().filter(|&&border| on_equator.x <= border).count();
    (latitude + south + longitude) % 2 == 1
}

/// The directions along which cells are counted on a plane.
pub(super) fn axes_on_plane(normal: Vector) -> [Vector; 2] {
    let first = if normal == Vector::x() || normal == -Vector::x() {
        normal.cross(&Vector::y())
    } else {
        normal.cross(&Vector::x())
    };
    let first = naive_unit(first);
    [first, normal.cross(&first)]
}

/// Whether the point at that offset from the plane's origin shows the second
/// colour.
pub(super) fn on_plane(offset: Vector, axes: &[Vector; 2]) -> bool {
    cell_is_odd(axes[0].dot(&offset)) != cell_is_odd(axes[1].dot(&offset))
}

/// Whether trunc|i|, plus 1 where i is negative, is odd.
///
/// The original truncates to a 32-bit whole number, which on its machine gave
/// -2^31, an even number, for all that does not fit.
fn cell_is_odd(i: f64) -> bool {
    let size = i.abs();
    let odd = size < 2_147_483_648.0 && (size as u32) % 2 == 1;
    odd != (i < 0.0)
}
