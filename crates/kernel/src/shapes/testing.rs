//! What the tests of several shapes share: rays, checks of properties that
//! every shape has, and arithmetic with twice the digits.

use crate::Crossing;
use crate::primitive::{Contact, Primitive};
use fastrand::Rng;
use lancer_math::{Point, Ray, Vector, unit};
use std::ops::{Add, Div, Mul, Sub};

/// About 32 digits: the sum of two doubles of which the second is small.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Double(pub(crate) f64, pub(crate) f64);

impl From<f64> for Double {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}

fn sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, e) = sum(self.0, other.0);
        let (s, e) = sum(s, e + (self.1 + other.1));
        Self(s, e)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self(-other.0, -other.1)
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = self.0 * other.0;
        let e = self.0.mul_add(other.0, -p) + (self.0 * other.1 + self.1 * other.0);
        let (p, e) = sum(p, e);
        Self(p, e)
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let q = Self::from(self.0 / other.0);
        let q = q + Self::from((self - q * other).0 / other.0);
        q + Self::from((self - q * other).0 / other.0)
    }
}

impl Double {
    pub(crate) fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self(0.0, 0.0);
        }
        let root = Self::from(self.0.sqrt());
        let root = root + Self::from((self - root * root).0 / (2.0 * root.0));
        root + Self::from((self - root * root).0 / (2.0 * root.0))
    }
}

/// A vector of them.
pub(crate) type Doubles = [Double; 3];

pub(crate) fn doubles(v: &Vector) -> Doubles {
    [v.x, v.y, v.z].map(Double::from)
}

/// a - b, exactly enough.
pub(crate) fn between(a: &Point, b: &Point) -> Doubles {
    std::array::from_fn(|i| Double::from(a[i]) - Double::from(b[i]))
}

pub(crate) fn dot(a: Doubles, b: Doubles) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn minus(a: Doubles, b: Doubles) -> Doubles {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(crate) fn times(a: Doubles, k: Double) -> Doubles {
    a.map(|c| c * k)
}

/// One of all directions.
pub(crate) fn direction(rng: &mut Rng) -> Vector {
    loop {
        let v = Vector::new(0.0, 0.0, 0.0).map(|_: f64| 2.0 * rng.f64() - 1.0);
        if (0.01..=1.0).contains(&v.norm_squared())
            && let Some(v) = unit(v)
        {
            return v;
        }
    }
}

/// A ray through `target`, from a distance of up to a million times `size`, as
/// often from near or behind it, whose direction has any length.
pub(crate) fn ray_to(rng: &mut Rng, target: &Point, size: f64) -> Ray {
    let mut way = direction(rng);
    // Along axes, too, and in planes of axes.
    for axis in 0..3 {
        if rng.u8(0..8) == 0 {
            way[axis] = if rng.bool() { 0.0 } else { -0.0 };
        }
    }
    if way == Vector::zeros() {
        way = Vector::z();
    }
    let exponents = [-2, -1, 0, 0, 0, 1, 2, 4, 6];
    let decade = exponents[rng.usize(0..exponents.len())];
    let distance = size * libm::pow(10.0, f64::from(decade)) * (2.0 * rng.f64() - 0.5);
    let length = libm::scalbn(0.5 + rng.f64(), [0, 0, -30, 20][rng.usize(0..4)]);
    Ray::new(target - way * distance, way * length)
}

/// All crossings of the ray's line, nearest first.
pub(crate) fn all(shape: &dyn Primitive, ray: &Ray) -> Vec<Crossing> {
    let mut list = Vec::new();
    shape.each(ray, f64::NEG_INFINITY, f64::INFINITY, &mut |c| list.push(c));
    list.sort_by(|a, b| a.t.total_cmp(&b.t));
    list
}

pub(crate) fn ts(shape: &dyn Primitive, ray: &Ray) -> Vec<f64> {
    all(shape, ray).iter().map(|c| c.t).collect()
}

/// The ray from `o` along `d`.
pub(crate) fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
    Ray::new(Point::from(o), Vector::from(d))
}

/// How many rays met the shape, each an even number of times.
pub(crate) fn check_pairs(shape: &dyn Primitive, rays: impl Iterator<Item = Ray>) -> usize {
    let mut met = 0;
    for (case, ray) in rays.enumerate() {
        let list = all(shape, &ray);
        assert!(
            list.len().is_multiple_of(2),
            "case {case}: {} by {ray:?} of {shape:?}",
            list.len()
        );
        assert!(list.iter().all(|c| c.t.is_finite()), "case {case}: {list:?}");
        met += usize::from(!list.is_empty());
    }
    met
}

/// Checks that rays which start just beside the surface, twice the error of a
/// contact away, do not meet it again where they leave it and come out exactly
/// once where they enter it; and that contacts are finite. How many did not.
pub(crate) fn check_leaving(
    shape: &dyn Primitive,
    convex: bool,
    rng: &mut Rng,
    rays: impl Iterator<Item = Ray>,
) -> usize {
    let mut wrong = 0;
    for ray in rays {
        for crossing in all(shape, &ray) {
            let contact = shape.contact(&ray, &crossing);
            assert_sound(&contact);
            let offset = contact.normal * (2.0 * contact.error);
            let mut way = direction(rng);
            if convex && rng.bool() {
                // Grazing.
                let across = way - contact.normal * way.dot(&contact.normal);
                let bit = libm::pow(10.0, -12.0 * rng.f64());
                way = across + contact.normal * if rng.bool() { bit } else { -bit };
            }
            let out = if way.dot(&contact.normal) > 0.0 { way } else { -way };
            let ahead = |origin: Point, direction| {
                let mut list = Vec::new();
                shape.each(&Ray::new(origin, direction), 0.0, f64::INFINITY, &mut |c| {
                    list.push(c.t);
                });
                list
            };
            let outside = ahead(contact.point + offset, out);
            let inside = ahead(contact.point - offset, -out);
            let fine = if convex {
                outside.is_empty() && inside.len() == 1
            } else {
                let near = 1000.0 * contact.error;
                outside.len().is_multiple_of(2)
                    && outside.iter().all(|t| *t > near)
                    && inside.len() % 2 == 1
            };
            let known = shape.contains(&(contact.point - offset))
                && !shape.contains(&(contact.point + offset));
            wrong += usize::from(!(fine && known));
        }
    }
    wrong
}

pub(crate) fn assert_sound(contact: &Contact) {
    let Contact { point, error, normal, shading } = contact;
    assert!(point.coords.iter().all(|c| c.is_finite()), "{contact:?}");
    assert!(*error > 0.0 && error.is_finite(), "{contact:?}");
    assert!((normal.norm() - 1.0).abs() < 1e-15, "{contact:?}");
    assert!((shading.norm() - 1.0).abs() < 1e-15, "{contact:?}");
    assert!(shading.dot(normal) > 0.0, "{contact:?}");
}

/// The largest distance of contacts from the exact surface as a share of the
/// error that they state, and how many contacts there were.
pub(crate) fn worst_error(
    shape: &dyn Primitive,
    rays: impl Iterator<Item = Ray>,
    distance: impl Fn(&Point, u32) -> f64,
) -> (f64, usize) {
    let (mut worst, mut count) = (0.0_f64, 0);
    let bounds = shape.bounds();
    for ray in rays {
        for crossing in all(shape, &ray) {
            let contact = shape.contact(&ray, &crossing);
            assert_sound(&contact);
            worst = worst.max(distance(&contact.point, crossing.part).abs() / contact.error);
            count += 1;
            if let Some(bounds) = bounds {
                let grown = bounds.grown(Vector::repeat(contact.error));
                assert!(grown.contains(&contact.point), "{contact:?} in {bounds:?}");
            }
        }
    }
    (worst, count)
}

/// Checks that no crossing is farther outside of the shape's box than a place along a ray is
/// rounded, so that it is found whatever boxes are around that. How many there were.
pub(crate) fn check_kept_in_box(shape: &dyn Primitive, rays: impl Iterator<Item = Ray>) -> usize {
    let bounds = shape.bounds().expect("a shape with an end");
    let mut met = 0;
    for (case, ray) in rays.enumerate() {
        for crossing in all(shape, &ray) {
            let by = ray.origin.coords.abs() + ray.direction.abs() * crossing.t.abs();
            let grown = bounds.grown((by + Vector::repeat(bounds.reach())) * (12.0 * f64::EPSILON));
            let place = ray.at(crossing.t);
            assert!(grown.contains(&place), "case {case}: {place:?} of {ray:?} and {shape:?}");
            met += 1;
        }
    }
    met
}

/// Checks that a scene of another size gives the same bits: `build` makes the
/// shape with all its lengths times a power of two.
pub(crate) fn check_scaling(build: impl Fn(f64) -> Box<dyn Primitive>, rays: &[Ray]) {
    let plain = build(1.0);
    for k in [-40, 40].map(|e| libm::scalbn(1.0, e)) {
        let scaled = build(k);
        assert_eq!(plain.volume() * k * k * k, scaled.volume());
        if let (Some(a), Some(b)) = (plain.bounds(), scaled.bounds()) {
            assert_eq!((a.min * k, a.max * k), (b.min, b.max));
        }
        for ray in rays {
            let larger = Ray::new(ray.origin * k, ray.direction);
            let (one, other) = (all(&*plain, ray), all(&*scaled, &larger));
            assert_eq!(one.len(), other.len());
            for (one, other) in one.iter().zip(&other) {
                assert_eq!((one.t * k).to_bits(), other.t.to_bits(), "{ray:?}");
                assert_eq!(one.part, other.part, "{ray:?}");
                let (a, b) = (plain.contact(ray, one), scaled.contact(&larger, other));
                assert_eq!((a.point * k, a.error * k), (b.point, b.error));
                assert_eq!((a.normal, a.shading), (b.normal, b.shading));
            }
        }
    }
}
