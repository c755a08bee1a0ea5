//! Random shapes, each with its own description of itself.

use super::cone::Side;
use super::convex::{Convex, Face};
use super::dd::Dd;
use super::figure::Figure;
use super::kind::Kind;
use super::mesh::random_mesh;
use super::sample::{Curve, Patch, Sample, across, any_direction, between, power_of_ten};
use super::sheets::{Flat, Outline, Tube};
use super::space::{Line, Long};
use super::torus::Ring;
use fastrand::Rng;
use lancer_math::{Point, Vector};
use lancer_scene::{Colour, Geometry, InvalidField, Shape, Surface};

/// A shape and what is known of it.
#[derive(Debug)]
pub(crate) struct Subject {
    pub(crate) shape: Shape,
    pub(crate) figure: Box<dyn Figure>,
    pub(crate) sample: Sample,
    /// Whether it reaches beyond the ball of `sample`.
    is_endless: bool,
}

/// Cells of two colours, for what is told of their borders.
pub(crate) fn surface() -> Surface {
    Surface::new(Colour::GREY).checker(Colour::RED)
}

fn size(rng: &mut Rng) -> f64 {
    power_of_ten(rng, -2.0, 2.0)
}

/// A point up to 100 from the origin, as often near it as far.
fn place(rng: &mut Rng) -> Point {
    let reach = power_of_ten(rng, -1.0, 2.0);
    Point::from([(); 3].map(|()| between(rng, -reach, reach)))
}

/// Of any length; sometimes along an axis of coordinates.
fn axis(rng: &mut Rng) -> Vector {
    let length = power_of_ten(rng, -2.0, 2.0);
    let direction = match rng.u8(..8) {
        k @ 0..3 => Vector::ith(usize::from(k), if rng.bool() { 1.0 } else { -1.0 }),
        _ => any_direction(rng),
    };
    direction * length
}

fn corners<const N: usize>(rng: &mut Rng) -> [Point; N] {
    let (middle, reach) = (place(rng), size(rng));
    [(); N].map(|()| middle + Vector::from([(); 3].map(|()| between(rng, -reach, reach))))
}

fn middle_of(points: &[Point]) -> (Point, f64) {
    let middle = points.iter().map(|p| p.coords).sum::<Vector>() / points.len() as f64;
    (Point::from(middle), points.iter().map(|p| (p.coords - middle).norm()).fold(0.0, f64::max))
}

fn segments(points: &[Point]) -> Vec<Curve> {
    let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| Curve::Segment([points[i], points[j]])).collect()
}

pub(crate) fn subject(
    shape: Result<Shape, InvalidField>,
    figure: impl Figure + 'static,
    (patches, curves): (Vec<Patch>, Vec<Curve>),
    (centre, size): (Point, f64),
) -> Subject {
    let shape = shape.expect("its numbers are in range");
    let sample = Sample { patches, curves, centre, size };
    let is_endless = matches!(shape.geometry, Geometry::Plane(_));
    Subject { shape, figure: Box::new(figure), sample, is_endless }
}

impl Subject {
    /// Whether a line passes it by much more than all roundings.
    pub(crate) fn is_clear_of(&self, line: &Line) -> bool {
        if self.is_endless {
            return false;
        }
        let Sample { centre, size, .. } = self.sample;
        let (to_centre, direction) =
            (centre - Point::from(line.origin.round()), line.direction.round());
        let along = to_centre.dot(&direction) / direction.norm_squared();
        let aside = (to_centre - direction * along).norm();
        aside > 1.001 * size + 1e-11 * line.scale
    }

    /// Whether it has neither an inside nor the hollow of a tube.
    pub(crate) fn is_flat(&self) -> bool {
        !self.figure.is_closed() && !matches!(self.sample.patches[..], [Patch::Side(..)])
    }

    pub(crate) fn random(kind: Kind, rng: &mut Rng) -> Self {
        let surface = surface();
        match kind {
            Kind::Sphere => {
                let (centre, radius) = (place(rng), size(rng));
                let ball = Face::Ball(Long::from(centre), Dd::from(radius));
                let patches = vec![Patch::Ball(centre, radius)];
                let shape = Shape::sphere(centre.into(), radius, surface);
                let around = (centre, radius);
                let figure = Convex::new(vec![ball], around);
                subject(shape, figure, (patches, vec![]), around)
            }
            Kind::Plane | Kind::Disc => {
                let (centre, normal, radius) = (place(rng), axis(rng), size(rng));
                let is_disc = kind == Kind::Disc;
                let flat = Flat {
                    point: Long::from(centre),
                    normal: Long::from(normal).unit(),
                    outline: if is_disc {
                        Outline::Circle(Dd::from(radius))
                    } else {
                        Outline::Endless
                    },
                };
                let patches = vec![Patch::Disc(centre, normal, radius)];
                let mut curves = vec![Curve::Circle(centre, normal, radius)];
                let shape = if is_disc {
                    Shape::disc(centre.into(), normal.into(), radius, surface)
                } else {
                    curves.clear();
                    Shape::plane(centre.into(), normal.into(), surface)
                };
                subject(shape, flat, (patches, curves), (centre, radius))
            }
            Kind::Rectangle => {
                let corner = place(rng);
                let u = axis(rng);
                let v = if rng.bool() { across(u)[0] * size(rng) } else { axis(rng) };
                let shape = Shape::rectangle(corner.into(), [u.into(), v.into()], surface);
                if shape.is_err() {
                    // Both along the same axis.
                    return Self::random(kind, rng);
                }
                let [o, a, b] = [Long::from(corner), Long::from(u), Long::from(v)];
                let ends = [corner, corner + u, corner + u + v, corner + v];
                let curves = (0..4).map(|k| Curve::Segment([ends[k], ends[(k + 1) % 4]]));
                let patches = vec![Patch::Parallelogram(corner, [u, v])];
                let figure = Flat::polygon(&[o, o + a, o + a + b, o + b]);
                subject(shape, figure, (patches, curves.collect()), middle_of(&ends))
            }
            Kind::Triangle => {
                let mut corners = corners::<3>(rng);
                if rng.u8(..4) == 0 {
                    corners[1] = corners[0] + (corners[1] - corners[0]) * 0.01;
                }
                let shape = Shape::triangle(corners.map(Into::into), surface);
                let pieces = (vec![Patch::Triangle(corners)], segments(&corners));
                let figure = Flat::polygon(&corners.map(Long::from));
                subject(shape, figure, pieces, middle_of(&corners))
            }
            Kind::Cuboid | Kind::Cube => {
                let from = place(rng);
                let shape = if kind == Kind::Cube {
                    Shape::cube(from.into(), size(rng), surface)
                } else {
                    let sides = Vector::from([(); 3].map(|()| size(rng)));
                    Shape::cuboid(from.into(), (from + sides).into(), surface)
                };
                cuboid(shape.expect("sides are far above roundings"))
            }
            Kind::Tetrahedron => tetrahedron(corners::<4>(rng)),
            Kind::Torus => {
                let (centre, axis) = (place(rng), axis(rng));
                let (a, b) = (size(rng), size(rng));
                // One in ten has no hole.
                let tube = if rng.u8(..10) == 0 { a.max(b) } else { a.min(b) };
                let radii = [a.max(b), tube];
                let [ring, tube] = radii.map(Dd::from);
                let long = Long::from(axis).unit();
                let figure = Ring { centre: Long::from(centre), axis: long, ring, tube };
                let shape = Shape::torus(centre.into(), axis.into(), radii, surface);
                let patches = vec![Patch::Ring(centre, axis, radii)];
                // Where tangents touch in a whole circle, and the ends of the hole.
                let inner = Curve::Circle(centre, axis, (radii[0] - radii[1]).max(1e-9));
                let outer = Curve::Circle(centre, axis, radii[0] + radii[1]);
                let ball = (centre, radii[0] + radii[1]);
                subject(shape, figure, (patches, vec![inner, outer]), ball)
            }
            Kind::ClosedMesh | Kind::OpenMesh => {
                random_mesh(rng, kind == Kind::ClosedMesh).subject(surface)
            }
            Kind::Mixed => Self::random(Kind::SHAPES[rng.usize(..Kind::SHAPES.len())], rng),
            _ => cone(kind, rng),
        }
    }
}

/// What a cube's corners are, its own rounding decides, so they are taken from it.
fn cuboid(shape: Shape) -> Subject {
    let Geometry::Cuboid(cuboid) = shape.geometry else { panic!("no box: {shape:?}") };
    let (min, max) = (cuboid.min(), cuboid.max());
    let faces = (0..3).flat_map(|axis| {
        let out = Vector::ith(axis, 1.0);
        [(max, out), (min, -out)].map(|(p, out)| Face::plane(Long::from(p), Long::from(out)))
    });
    let sides = max - min;
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
        Point::new(pick(0), pick(1), pick(2))
    };
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(corner);
    let mut patches = Vec::new();
    let mut curves = Vec::new();
    for axis in 0..3 {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3].map(|k| Vector::ith(k, sides[k]));
        patches.push(Patch::Parallelogram(min, [v, u]));
        patches.push(Patch::Parallelogram(max, [-u, -v]));
        for i in (0..8).filter(|i| i >> axis & 1 == 0) {
            curves.push(Curve::Segment([corners[i], corners[i | 1 << axis]]));
        }
    }
    let ball = middle_of(&corners);
    subject(Ok(shape), Convex::new(faces.collect(), ball), (patches, curves), ball)
}

fn tetrahedron(corners: [Point; 4]) -> Subject {
    let [a, b, c, d] = corners;
    let opposite = [([b, c, d], a), ([c, d, a], b), ([d, a, b], c), ([a, b, c], d)];
    let faces = opposite.map(|(face, inside)| {
        let [p, q, r] = face.map(Long::from);
        let normal = (q - p).cross(r - p);
        let is_outward = normal.dot(Long::from(inside) - p).is_negative();
        Face::plane(p, if is_outward { normal } else { -normal })
    });
    // The normals are only there to start off the surface: either side will do.
    let patches = opposite.map(|(face, _)| Patch::Triangle(face)).to_vec();
    let shape = Shape::tetrahedron(corners.map(Into::into), surface());
    let ball = middle_of(&corners);
    let figure = Convex::new(faces.into(), ball);
    subject(shape, figure, (patches, segments(&corners)), ball)
}

fn cone(kind: Kind, rng: &mut Rng) -> Subject {
    let surface = surface();
    let (base, radius) = (place(rng), size(rng));
    let top = base + axis(rng);
    let ends = [base.into(), top.into()];
    let (shape, radii) = match kind {
        Kind::Cylinder | Kind::OpenCylinder => {
            (Shape::cylinder(ends[0], ends[1], radius, surface), [radius; 2])
        }
        Kind::Cone | Kind::OpenCone => {
            (Shape::cone(ends[0], ends[1], radius, surface), [radius, 0.0])
        }
        _ => {
            // Some widen so little that their tip is far away.
            let other = if rng.u8(..5) == 0 {
                radius * (1.0 + power_of_ten(rng, -15.0, -3.0))
            } else {
                size(rng)
            };
            (Shape::frustum((ends[0], radius), (ends[1], other), surface), [radius, other])
        }
    };
    let along = top - base;
    let side = Side::new(Long::from(base), Long::from(top), radii);
    let mut patches = vec![Patch::Side([base, top], radii)];
    let rims = [(base, -along, radii[0]), (top, along, radii[1])].into_iter();
    let curves: Vec<_> = rims
        .clone()
        .map(|(centre, out, radius)| match radius {
            0.0 => Curve::Segment([centre; 2]),
            _ => Curve::Circle(centre, out, radius),
        })
        .collect();
    let ball = (base + along * 0.5, along.norm() * 0.5 + radii[0].max(radii[1]));
    if matches!(kind, Kind::OpenCylinder | Kind::OpenCone | Kind::OpenFrustum) {
        let shape = shape.map(Shape::without_lids);
        return subject(shape, Tube(side), (patches, curves), ball);
    }
    let mut faces = vec![Face::Round(side)];
    for (centre, out, radius) in rims.filter(|(_, _, radius)| *radius > 0.0) {
        faces.push(Face::plane(Long::from(centre), Long::from(out)));
        patches.push(Patch::Disc(centre, out, radius));
    }
    subject(shape, Convex::new(faces, ball), (patches, curves), ball)
}
