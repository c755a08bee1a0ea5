//! Rays of all sorts, ordinary ones and such as are made to be difficult.

use super::case::Case;
use super::sample::{Curve, Patch, Sample, any_direction, power_of_ten};
use fastrand::Rng;
use lancer_kernel::Hit;
use lancer_math::{Point, Ray, Vector, unit};

/// How a ray was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    /// At the shape or past it.
    Ordinary,
    /// From inside, or between the parts of a tube.
    Inside,
    /// From up to 10^9 sizes away.
    Far,
    /// Along an axis of coordinates.
    Axis,
    /// Along an edge, in a face, or along the axis of the shape.
    InFace,
    /// Between one that meets and one that passes, up to neighbouring numbers.
    Silhouette,
    /// Along a tangent, a little beside the surface.
    Tangent,
    /// At a small angle with the surface.
    Grazing,
    /// At an edge, a little beside it.
    Edge,
    /// At a corner, a little beside it.
    Corner,
    /// Between two cells of a checker, up to neighbouring numbers.
    Cell,
    /// From the surface, or from next to it.
    Near,
    /// From a hit, as mirrors and shadows ask them.
    Leaving,
}

/// The classes of rays that are made: ordinary ones are a third.
const MADE: [Class; 18] = [
    Class::Ordinary,
    Class::Ordinary,
    Class::Ordinary,
    Class::Ordinary,
    Class::Inside,
    Class::Inside,
    Class::Far,
    Class::Far,
    Class::Axis,
    Class::InFace,
    Class::Silhouette,
    Class::Tangent,
    Class::Grazing,
    Class::Edge,
    Class::Corner,
    Class::Cell,
    Class::Near,
    Class::Near,
];

impl Class {
    pub(crate) const ALL: [Self; 13] = [
        Self::Ordinary,
        Self::Inside,
        Self::Far,
        Self::Axis,
        Self::InFace,
        Self::Silhouette,
        Self::Tangent,
        Self::Grazing,
        Self::Edge,
        Self::Corner,
        Self::Cell,
        Self::Near,
        Self::Leaving,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Ordinary => "ordinary",
            Self::Inside => "from inside",
            Self::Far => "from afar",
            Self::Axis => "along coordinates",
            Self::InFace => "in a face",
            Self::Silhouette => "at a silhouette",
            Self::Tangent => "along a tangent",
            Self::Grazing => "grazing",
            Self::Edge => "at an edge",
            Self::Corner => "at a corner",
            Self::Cell => "at a cell's border",
            Self::Near => "from the surface",
            Self::Leaving => "leaving a hit",
        }
    }

    /// Whether it was not made to be difficult.
    pub(crate) const fn is_easy(self) -> bool {
        matches!(self, Self::Ordinary | Self::Inside)
    }
}

/// Where the numbers of a shape are exact, in its own space.
struct Local {
    origin: Point,
    direction: Vector,
}

fn unit_across(rng: &mut Rng, normal: Vector) -> Vector {
    let mut across = normal.cross(&any_direction(rng));
    while across.norm() < 0.01 {
        across = normal.cross(&any_direction(rng));
    }
    across / across.norm()
}

/// 1 or -1.
fn sign(rng: &mut Rng) -> f64 {
    if rng.bool() { 1.0 } else { -1.0 }
}

/// Nothing at times, else any power of ten.
fn little(rng: &mut Rng, from: f64, to: f64) -> f64 {
    if rng.u8(..8) == 0 { 0.0 } else { power_of_ten(rng, from, to) }
}

impl Local {
    fn at(target: Point, direction: Vector, back: f64) -> Self {
        Self { origin: target - direction * back, direction }
    }

    /// At a point, from anywhere.
    fn toward(rng: &mut Rng, target: Point, back: f64) -> Self {
        let origin = target + any_direction(rng) * back;
        Self { origin, direction: (target - origin) / back }
    }

    /// At the shape or past it.
    fn ordinary(rng: &mut Rng, sample: &Sample, back: f64) -> Self {
        Self::at(near(rng, sample), any_direction(rng), back)
    }

    /// Along an edge, in a face, or along the axis of the shape.
    fn in_face(rng: &mut Rng, sample: &Sample, back: f64) -> Self {
        if rng.bool()
            && !sample.curves.is_empty()
            && let Curve::Segment([from, to]) = &sample.curves[rng.usize(..sample.curves.len())]
            && let Some(direction) = unit(to - from)
        {
            return Self::at(*from, direction, back);
        }
        let patch = &sample.patches[rng.usize(..sample.patches.len())];
        let (point, normal) = patch.point(rng);
        let along = match patch {
            Patch::Side([base, top], _) => {
                let from = if rng.bool() { *base } else { point };
                return Self::at(from, unit(top - base).unwrap_or(normal), back);
            }
            Patch::Ring(centre, axis, _) => {
                let from = if rng.bool() { *centre } else { point };
                return Self::at(from, unit(*axis).unwrap_or(normal), back);
            }
            Patch::Ball(..) => unit_across(rng, normal),
            Patch::Parallelogram(_, [u, v]) if rng.bool() => *if rng.bool() { u } else { v },
            _ => patch.point(rng).0 - point,
        };
        Self::at(point, unit(along).unwrap_or(normal), back)
    }
}

/// A point near the shape, as often near its surface as anywhere.
fn near(rng: &mut Rng, sample: &Sample) -> Point {
    if rng.bool() {
        let by = 1.2 * sample.size * rng.f64();
        sample.centre + any_direction(rng) * by
    } else {
        let by = sample.size * power_of_ten(rng, -4.0, 0.0);
        sample.on_surface(rng).0 + any_direction(rng) * by
    }
}

impl Case {
    /// A random ray, and how it was made.
    pub(crate) fn ray(&self, rng: &mut Rng, number: u64) -> (Ray, Class) {
        let class = MADE[(number % MADE.len() as u64) as usize];
        let item = rng.u32(..self.item_count());
        let (subject, placement) = (self.subject(item), self.placement(item));
        let sample = &subject.sample;
        let size = sample.size;
        let back = match rng.u8(..4) {
            0 if !class.is_easy() => size * power_of_ten(rng, 1.0, 6.0),
            _ => size + size * power_of_ten(rng, -1.0, 1.5),
        };
        let local = match class {
            Class::Inside if !subject.is_flat() => {
                Local { origin: sample.inside(rng), direction: any_direction(rng) }
            }
            Class::Ordinary | Class::Inside | Class::Leaving => Local::ordinary(rng, sample, back),
            Class::Far => {
                let far = size * power_of_ten(rng, 3.0, 9.0);
                Local::ordinary(rng, sample, far)
            }
            Class::Axis => {
                let by = size * little(rng, -17.0, -3.0);
                let target = match rng.u8(..3) {
                    0 => near(rng, sample),
                    1 => sample.on_surface(rng).0 + any_direction(rng) * by,
                    _ => sample.on_edge(rng) + any_direction(rng) * by,
                };
                Local::at(target, Vector::ith(rng.usize(..3), sign(rng)), back)
            }
            Class::InFace => Local::in_face(rng, sample, back),
            Class::Silhouette | Class::Cell => {
                let target = near(rng, sample);
                Local::toward(rng, target, back)
            }
            Class::Tangent => {
                let (point, normal) = sample.on_surface(rng);
                let along = unit_across(rng, normal);
                let beside = normal * (sign(rng) * size * little(rng, -17.0, -3.0));
                Local::at(point + beside, along, back)
            }
            Class::Grazing => {
                let (point, normal) = sample.on_surface(rng);
                let slope = sign(rng) * power_of_ten(rng, -12.0, -1.0);
                Local::at(point, unit_across(rng, normal) + normal * slope, back)
            }
            Class::Edge | Class::Corner => {
                let by = size * little(rng, -17.0, -3.0);
                let aside = any_direction(rng) * by;
                let target = match class {
                    Class::Edge => sample.on_edge(rng),
                    _ => sample.on_corner(rng),
                };
                Local::toward(rng, target + aside, back)
            }
            Class::Near => {
                let (point, normal) = sample.on_surface(rng);
                let off = if rng.u8(..4) == 0 { 0.0 } else { power_of_ten(rng, -16.0, -2.0) };
                let off = size * off * sign(rng);
                Local { origin: point + normal * off, direction: any_direction(rng) }
            }
        };
        let (origin, direction) = if placement.is_identity() {
            (local.origin, local.direction)
        } else {
            (placement.point(&local.origin), placement.vector(&local.direction))
        };
        let direction = match class {
            Class::Silhouette | Class::Cell => {
                let target = placement.point(&near(rng, sample));
                let hit =
                    |direction| self.prepared.nearest(&Ray::new(origin, direction), f64::INFINITY);
                let other = unit(target - origin).unwrap_or(direction);
                if class == Class::Silhouette {
                    let seen = |direction| hit(direction).map(|hit| hit.item);
                    border(rng, seen, direction, other)
                } else {
                    let seen =
                        |direction| hit(direction).map(|hit| self.colour(origin, direction, &hit));
                    border(rng, seen, direction, other)
                }
            }
            _ => direction,
        };
        let length = if rng.u8(..4) == 0 { 1.0 } else { power_of_ten(rng, -3.0, 3.0) };
        (Ray::new(origin, direction * length), class)
    }

    /// What is seen of a checker at a hit.
    fn colour(&self, origin: Point, direction: Vector, hit: &Hit) -> [f64; 3] {
        self.prepared.expand(&Ray::new(origin, direction), hit).albedo
    }
}

/// Between two directions in which different things are seen one of two, no farther
/// from each other than roundings, in which that is so, too.
fn border<T: PartialEq>(
    rng: &mut Rng,
    seen: impl Fn(Vector) -> T,
    mut one: Vector,
    mut other: Vector,
) -> Vector {
    let at_one = seen(one);
    for _ in 0..56 {
        let middle = (one + other) * 0.5;
        if seen(middle) == at_one {
            one = middle;
        } else {
            other = middle;
        }
    }
    if rng.bool() { one } else { other }
}
