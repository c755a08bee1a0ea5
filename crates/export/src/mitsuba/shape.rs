use super::ply::{Corner, Triangles};
use super::{Writer, matrix, round, surface};
use crate::frame::Frame;
use crate::text::Number;
use lancer_math::{Placement, Point, Vector};
use lancer_scene::{
    Checker, Colour, Cuboid, Direction, Geometry, Mesh, Pattern, Plane, Shadows, Shape, Surface,
    Tetrahedron,
};
use std::fmt::Write;

/// A plane is a square so many times as wide as what the camera is about.
const WIDE: f64 = 1000.0;

/// Lengths that differ by no more than this fraction are the same to single precision.
const ROUNDING: f64 = 1e-9;

impl Writer<'_> {
    pub(super) fn shape(&mut self, shape: &Shape, placement: &Placement, place: &str) {
        self.note(&shape.surface, place);
        let checker = match shape.surface.pattern {
            Pattern::Checker(checker) => Some(checker),
            Pattern::Solid => None,
        };
        match &shape.geometry {
            Geometry::Sphere(sphere) if is_similarity(placement) => {
                let radius = Vector::repeat(sphere.radius.get());
                let own = Frame { axes: axes(&radius), origin: sphere.centre.get() };
                let to_uv = checker.map_or_else(String::new, |checker| globe(&checker));
                self.add("sphere", &own.placed(placement), "", &shape.surface, &to_uv);
            }
            Geometry::Plane(plane) => self.plane(plane, shape, placement, place),
            Geometry::Disc(disc) if checker.is_none() => {
                let Frame { axes: [x, y, z], origin } =
                    Frame::around(disc.normal.get(), disc.centre.get());
                let radius = disc.radius.get();
                let own = Frame { axes: [x * radius, y * radius, z], origin };
                self.add("disk", &own.placed(placement), "", &shape.surface, "");
            }
            Geometry::Rectangle(rectangle) if checker.is_none() => {
                // From -1 to 1.
                let [a, b] = rectangle.sides().map(|side| side.get() / 2.0);
                let normal = Frame::of_sides(Point::origin(), [a, b]).axes[2];
                let own = Frame { axes: [a, b, normal], origin: rectangle.corner() + a + b };
                self.add("rectangle", &own.placed(placement), "", &shape.surface, "");
            }
            Geometry::Cuboid(cuboid) if checker.is_none() => {
                let half = (cuboid.max() - cuboid.min()) / 2.0;
                let own = Frame { axes: axes(&half), origin: cuboid.min() + half };
                self.add("cube", &own.placed(placement), "", &shape.surface, "");
            }
            _ => self.mesh(shape, placement, place),
        }
    }

    /// What cannot be said of a surface.
    fn note(&mut self, surface: &Surface, place: &str) {
        self.is_matte &= surface.gloss.get() == 0.0 && !surface.is_transparent();
        let omissions = &mut *self.omissions;
        if !surface.emission.is_none() {
            omissions.add(
                place,
                "what shines lights other surfaces too, and is seen from the side of its normal alone",
                "",
            );
        }
        if !surface.is_transparent() {
            return;
        }
        if self.scene.shadows == Shadows::Tinted {
            omissions.add(
                place,
                "clear things let no light of lamps and suns through to a surface",
                "say shadows=\"opaque\", which can be said",
            );
        }
        if !surface.medium.absorption.is_none() && !surface.thin {
            omissions.add(place, "its absorption is left out", "");
        }
        if surface.has_medium() {
            omissions.add(
                place,
                "where clear solids touch or overlap, or the camera is in one, light is bent as if \
                 each were alone in the air; what is seen in denser ones is dimmer by the square of \
                 the index",
                "let them be apart, and the camera in the air",
            );
        }
        if surface.gloss.get() > 0.0 || surface.transparency.get() < 1.0 {
            omissions.add(
                place,
                "the matte and the mirroring part of a clear surface are there on one side alone",
                "",
            );
        }
    }

    /// A square of it, as far as the camera is likely to see.
    fn plane(&mut self, plane: &Plane, shape: &Shape, placement: &Placement, place: &str) {
        self.omissions.add(
            place,
            "a plane is a square, 2000 times as wide as the camera is far from its target or from \
             the origin",
            "",
        );
        let frame = Frame::around(plane.normal.get(), plane.origin.get());
        let factor = libm::cbrt(placement.volume_factor());
        let wide = WIDE * self.reach / factor;
        let eye = placement.local_point(&self.scene.camera.origin().get()) - frame.origin;
        // Whole pairs of cells from the origin to the middle, and from there to the edge.
        let pair = match shape.surface.pattern {
            Pattern::Checker(checker) => 2.0 * checker.length.get(),
            Pattern::Solid => wide,
        };
        let pairs = (wide / pair).ceil();
        let whole = |axis: &Vector| (axis.dot(&eye) / pair).round() * pair;
        let [x, y, z] = frame.axes;
        let half = pairs * pair;
        let own = Frame {
            axes: [x * half, y * half, z],
            origin: frame.origin + x * whole(&x) + y * whole(&y),
        };
        let to_uv = scaled([2.0 * pairs; 2]);
        self.add("rectangle", &own.placed(placement), "", &shape.surface, &to_uv);
    }

    /// A shape as triangles from a file.
    fn mesh(&mut self, shape: &Shape, placement: &Placement, place: &str) {
        let key = std::ptr::from_ref(shape);
        let (file, is_flat) = match self.known.get(&key) {
            Some(known) => *known,
            None => {
                let Some(triangles) = triangles(shape) else {
                    let what = "a shape of your own, which is left out";
                    return self.omissions.add(place, what, "");
                };
                let known = (self.file(triangles.to_bytes()), !triangles.is_smooth);
                self.known.insert(key, known);
                known
            }
        };
        let is_round = matches!(
            shape.geometry,
            Geometry::Sphere(_) | Geometry::Disc(_) | Geometry::Cone(_) | Geometry::Torus(_)
        );
        if is_round {
            self.omissions.add(
                place,
                "what is round is a mesh of 512 flats around, which is off by 0.00002 of its radius",
                "",
            );
        }
        let name = &self.files[file].name;
        let mut own = format!("<string name=\"filename\" value=\"{name}\"/>");
        let _ = write!(own, "<boolean name=\"face_normals\" value=\"{is_flat}\"/>");
        let [x, y, z] = Frame::of(placement).axes;
        if is_flat && x.cross(&y).dot(&z) < 0.0 {
            own += "<boolean name=\"flip_normals\" value=\"true\"/>";
        }
        self.add("ply", &Frame::of(placement), &own, &shape.surface, "");
    }

    fn add(&mut self, kind: &str, frame: &Frame, own: &str, surface: &Surface, to_uv: &str) {
        let emitter = if surface.emission.is_none() {
            String::new()
        } else {
            let radiance = super::rgb("radiance", surface.emission.get(), self.exposure);
            format!("<emitter type=\"area\">{radiance}</emitter>")
        };
        let _ = writeln!(
            self.body,
            "<shape type=\"{kind}\">{own}{}{}{emitter}</shape>",
            matrix(&frame.axes, &frame.origin),
            surface::bsdf(surface, to_uv),
        );
    }
}

fn axes(lengths: &Vector) -> [Vector; 3] {
    [Vector::x() * lengths.x, Vector::y() * lengths.y, Vector::z() * lengths.z]
}

/// Whether spheres stay spheres.
fn is_similarity(placement: &Placement) -> bool {
    let [x, y, z] = Frame::of(placement).axes;
    let size = x.norm_squared();
    let same = |length: f64| (length - size).abs() <= ROUNDING * size;
    let square = |product: f64| product.abs() <= ROUNDING * size;
    same(y.norm_squared())
        && same(z.norm_squared())
        && [x.dot(&y), y.dot(&z), z.dot(&x)].into_iter().all(square)
}

fn scaled([u, v]: [f64; 2]) -> String {
    let (u, v) = (Number(u), Number(v));
    format!("<transform name=\"to_uv\"><scale x=\"{u}\" y=\"{v}\"/></transform>")
}

/// Longitude from 0 to 1, and the angle from the north pole as well.
fn globe(checker: &Checker) -> String {
    let pairs = 90.0 / checker.angle.get();
    format!(
        "<transform name=\"to_uv\"><scale x=\"{}\" y=\"{}\"/><translate x=\"0\" y=\"{}\"/></transform>",
        Number(2.0 * pairs),
        Number(-pairs),
        Number(pairs / 2.0)
    )
}

/// The triangles of a shape, with its checker in their coordinates; `None` of one of the user's own.
fn triangles(shape: &Shape) -> Option<Triangles> {
    let checker = match shape.surface.pattern {
        Pattern::Checker(checker) => checker,
        // Of any size, since it is not seen.
        Pattern::Solid => Checker::new(Colour::BLACK),
    };
    Some(match &shape.geometry {
        Geometry::Sphere(sphere) => round::sphere(sphere, &checker),
        Geometry::Disc(disc) => round::disc(disc, &checker),
        Geometry::Cone(cone) => round::cone(cone, &checker),
        Geometry::Torus(torus) => round::torus(torus, &checker),
        Geometry::Rectangle(rectangle) => {
            let [a, b] = rectangle.sides().map(Direction::get);
            let corner = rectangle.corner();
            flat(&[[corner, corner + a, corner + a + b, corner + b].to_vec()], &checker)
        }
        Geometry::Triangle(triangle) => flat(&[triangle.corners().to_vec()], &checker),
        Geometry::Tetrahedron(tetrahedron) => flat(&faces(tetrahedron), &checker),
        Geometry::Cuboid(cuboid) => cube(cuboid, &checker),
        Geometry::Mesh(mesh) => mesh_of(mesh, &checker),
        Geometry::Plane(_) | Geometry::Custom(_) => return None,
    })
}

fn faces(tetrahedron: &Tetrahedron) -> Vec<Vec<Point>> {
    let corners = tetrahedron.corners();
    crate::pov::FACES.iter().map(|face| face.map(|corner| corners[corner]).to_vec()).collect()
}

/// Polygons, each with squares from its first corner along its first side.
fn flat(polygons: &[Vec<Point>], checker: &Checker) -> Triangles {
    let pair = 2.0 * checker.length.get();
    let mut mesh = Triangles::default();
    for polygon in polygons {
        let sides = [polygon[1] - polygon[0], polygon[polygon.len() - 1] - polygon[0]];
        let Frame { axes: [x, y, normal], origin } = Frame::of_sides(polygon[0], sides);
        let add = |point: &Point| {
            let at = point - origin;
            let uv = [x.dot(&at) / pair, y.dot(&at) / pair];
            mesh.add(Corner { point: *point, normal, uv })
        };
        let indices: Vec<u32> = polygon.iter().map(add).collect();
        let rest = indices.windows(2).skip(1);
        mesh.faces.extend(rest.map(|pair| [indices[0], pair[0], pair[1]]));
    }
    mesh
}

/// Squares on each face from the corner with the smallest coordinates.
fn cube(cuboid: &Cuboid, checker: &Checker) -> Triangles {
    let pair = 2.0 * checker.length.get();
    let sides = cuboid.max() - cuboid.min();
    let mut mesh = Triangles::default();
    for axis in 0..3 {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        for far in [false, true] {
            let corner = |u: bool, v: bool| {
                let mut at = Vector::zeros();
                for (i, is_far) in [(axis, far), (first, u), (second, v)] {
                    at[i] = if is_far { sides[i] } else { 0.0 };
                }
                let uv = [at[first] / pair, at[second] / pair];
                Corner { point: cuboid.min() + at, normal: Vector::zeros(), uv }
            };
            let [a, b, c, d] = [(false, false), (true, false), (true, true), (false, true)]
                .map(|(u, v)| corner(u, v));
            let [a, b, c, d] = [a, b, c, d].map(|corner| mesh.add(corner));
            // Counterclockwise from outside.
            let faces = [[a, b, c], [a, c, d]];
            mesh.faces.extend(faces.map(|[a, b, c]| if far { [a, b, c] } else { [a, c, b] }));
        }
    }
    mesh
}

/// Squares by the two coordinates that a facet's normal has least of.
fn mesh_of(mesh: &Mesh, checker: &Checker) -> Triangles {
    let pair = 2.0 * checker.length.get();
    let mut all = Triangles { is_smooth: mesh.has_normals(), ..Triangles::default() };
    for triangle in 0..mesh.triangle_count() {
        let points = mesh.corners(triangle);
        let facet = (points[1] - points[0]).cross(&(points[2] - points[0]));
        let axis = crate::pov::axis(mesh, triangle);
        let normals = mesh.corner_normals(triangle).unwrap_or([facet; 3]);
        let corner = |i: usize| {
            let (point, normal) = (points[i], normals[i]);
            let uv = [point[(axis + 1) % 3] / pair, point[(axis + 2) % 3] / pair];
            Corner { point, normal: if normal == Vector::zeros() { facet } else { normal }, uv }
        };
        let face = [0, 1, 2].map(|i| all.add(corner(i)));
        all.faces.push(face);
    }
    all
}
