//! Colours, and the cells of checkers.

use crate::{Item, Number, Triple};
use lancer_math::Vector;
use lancer_scene::{Checker, Colour, Geometry, Pattern};

/// Digits that tell a cell; what is nearer to a border is undecided anyway.
const BITS: usize = 128;

/// Two coordinates of a shape's surface, each in cells.
type Cells = [Number; 2];

/// The shares of red, green and blue that an item's matte part shows at a point
/// on it, and how far that is from a border of cells, in cells. `face` and `normal`
/// (in the world) are those of the crossing there.
pub(crate) fn albedo(
    item: &Item<'_>,
    point: &Triple,
    face: usize,
    normal: &Triple,
) -> ([Number; 3], f64) {
    let surface = item.surface();
    let Pattern::Checker(checker) = surface.pattern else {
        return (shares(surface.colour), f64::INFINITY);
    };
    let local = item.space.local_point(point).over(item.space.stretch(), 2 * BITS);
    let Some(cells) = cells(item, &local, face, normal, &checker) else {
        // Where its cells begin is not said.
        return (shares(surface.colour), 0.0);
    };
    let two = Number::from(2);
    let odd = cells.each_ref().map(|cell| {
        let whole = cell.floor();
        (&whole * Number::power_of_two(-1)).floor() * &two != whole
    });
    let borders = cells.iter().map(|cell| {
        let fraction = (cell - cell.floor()).to_f64();
        fraction.min(1.0 - fraction)
    });
    let margin = borders.fold(f64::INFINITY, f64::min);
    let colour = if odd[0] == odd[1] { surface.colour } else { checker.second };
    (shares(colour), margin)
}

fn cells(
    item: &Item<'_>,
    p: &Triple,
    face: usize,
    normal: &Triple,
    checker: &Checker,
) -> Option<Cells> {
    let in_lengths = |x: Number| x.over(&Number::from(checker.length.get()), BITS);
    let in_angles = |x: Number| x.over(&Number::from(checker.angle.get()), BITS);
    let flat = |origin: Triple, first: &Triple, n: &Triple| {
        let second = n.cross(first);
        let from = p - &origin;
        Some([first, &second].map(|axis| in_lengths(from.dot(&axis.unit(BITS)))))
    };
    match item.geometry() {
        Geometry::Sphere(sphere) => {
            let [x, y, z] = (p - &sphere.centre.get().into()).0;
            let across = (x.squared() + y.squared()).root(BITS);
            Some([in_angles(z.turn(&across, BITS)), in_angles(y.turn(&x, BITS))])
        }
        Geometry::Plane(plane) => {
            let n = plane.normal.get().into();
            flat(plane.origin.get().into(), &across(&n)[0], &n)
        }
        Geometry::Disc(disc) => {
            let n = disc.normal.get().into();
            flat(disc.centre.get().into(), &across(&n)[0], &n)
        }
        Geometry::Rectangle(rectangle) => {
            let [u, v] = rectangle.sides().map(|side| Triple::from(side.get()));
            flat(rectangle.corner().into(), &u, &u.cross(&v))
        }
        Geometry::Triangle(triangle) => {
            let [a, b, c] = triangle.corners().map(Triple::from);
            let side = &b - &a;
            flat(a.clone(), &side, &side.cross(&(&c - &a)))
        }
        Geometry::Cuboid(cuboid) => {
            let from = p - &cuboid.min().into();
            let [i, j] = other_axes(face % 3);
            Some([i, j].map(|k| in_lengths(from.0[k].clone())))
        }
        Geometry::Cone(cone) => {
            let base = cone.base().into();
            let axis = &Triple::from(cone.top()) - &base;
            let from = p - &base;
            let height = from.dot(&axis.unit(BITS));
            let [first, second] = across(&axis).map(|axis| from.dot(&axis.unit(BITS)));
            let angle = in_angles(second.turn(&first, BITS));
            let length =
                if face == 0 { height } else { (first.squared() + second.squared()).root(BITS) };
            Some([in_lengths(length), angle])
        }
        Geometry::Torus(torus) => {
            let axis = torus.axis.get().into();
            let from = p - &torus.centre.get().into();
            let [first, second] = across(&axis).map(|axis| from.dot(&axis.unit(BITS)));
            let around = second.turn(&first, BITS);
            let outward =
                (first.squared() + second.squared()).root(BITS) - Number::from(torus.ring());
            let tube = from.dot(&axis.unit(BITS)).turn(&outward, BITS);
            Some([in_angles(around), in_angles(tube)])
        }
        Geometry::Mesh(_) => {
            // Of the triangle as it is in the file.
            let n = item.space.local_normal(normal);
            let mut longest = 0;
            for k in 1..3 {
                if n.0[k].abs() > n.0[longest].abs() {
                    longest = k;
                }
            }
            let [i, j] = other_axes(longest);
            Some([i, j].map(|k| in_lengths(p.0[k].clone())))
        }
        Geometry::Tetrahedron(_) | Geometry::Custom(_) => None,
    }
}

fn other_axes(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

/// The two axes across `n`: n times x, or n times y where n is along x, and n times
/// that one; of any length.
fn across(n: &Triple) -> [Triple; 2] {
    let mut first = n.cross(&Vector::x().into());
    if first.is_zero() {
        first = n.cross(&Vector::y().into());
    }
    let second = n.cross(&first);
    [first, second]
}

/// Shares of the light, by the definition of sRGB (IEC 61966-2-1) where a colour is
/// given in its codes.
fn shares(colour: Colour) -> [Number; 3] {
    match colour {
        Colour::Codes(codes) => codes.map(|code| {
            let v = Number::from(f64::from(code)).over(&Number::from(255), BITS);
            let thousandths = |k: i32| Number::from(k).over(&Number::from(1000), BITS);
            if code <= 10 {
                // Up to 0.04045.
                return v.over(&thousandths(12_920), BITS);
            }
            let base = (v + thousandths(55)).over(&thousandths(1055), BITS);
            base.power(&thousandths(2400), BITS)
        }),
        Colour::Linear(_) => colour.shares().map(Number::from),
    }
}
