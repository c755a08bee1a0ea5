//! Checkers, cell for cell: where the cells are cubes of space by the pattern of that
//! name, elsewhere by functions.

use super::{matrix, rgb};
use crate::frame::{Frame, sides, slope};
use crate::text::Number;
use lancer_scene::{Checker, Direction, Geometry, Mesh, Pattern, Surface};
use std::fmt::Write;

/// What the patterns below call. `LancerCell` is 1 where one of two counts is odd and the
/// other is not, `LancerTurn` an angle from 0 to 360 degrees.
pub(super) const FUNCTIONS: &str = "\
#declare LancerCell = function(A, B) { abs(mod(floor(A) + floor(B), 2)) }
#declare LancerTurn = function(A, B) { degrees(atan2(B, A)) + select(atan2(B, A), 360, 0) }
#declare LancerBall = function(x, y, z, A) {
  LancerCell(LancerTurn(x, y) / A, degrees(atan2(z, sqrt(x*x + y*y))) / A) }
#declare LancerRing = function(x, y, z, R, A) {
  LancerCell(LancerTurn(x, y) / A, LancerTurn(sqrt(x*x + y*y) - R, z) / A) }
#declare LancerTube = function(x, y, z, L, A) { LancerCell(z / L, LancerTurn(x, y) / A) }
#declare LancerLids = function(x, y, z, R, S, H, L, A) {
  LancerCell(select(min(abs(z), abs(H - z)) - abs(sqrt(x*x + y*y) - R - S*z), sqrt(x*x + y*y), z) / L,
    LancerTurn(x, y) / A) }
#declare LancerFace = function(x, y, z, X, Y, Z, L) {
  select(min(Y, Z) - X, select(Z - Y, LancerCell(x / L, y / L), LancerCell(z / L, x / L)),
    LancerCell(y / L, z / L)) }
#declare LancerBox = function(x, y, z, W, D, H, L) {
  LancerFace(x, y, z, min(abs(x), abs(W - x)), min(abs(y), abs(D - y)), min(abs(z), abs(H - z)), L) }
";

/// Which of two things is where.
pub(super) struct Cells {
    /// `checker`, or a function that is 1 where the second one is.
    pattern: String,
    transform: String,
}

impl Cells {
    /// Squares of a side along the first two axes of a frame; its plane is in the middle
    /// of a cell of the third.
    fn squares(side: f64, frame: &Frame) -> Self {
        Self {
            pattern: "checker".to_owned(),
            transform: format!("translate <0, 0, -0.5> scale {} {}", Number(side), matrix(frame)),
        }
    }

    fn function(call: String, frame: &Frame) -> Self {
        Self { pattern: format!("function {{ {call} }}"), transform: matrix(frame) }
    }

    pub(super) fn pigment(&self, first: [f64; 3], second: [f64; 3]) -> String {
        let inside = self.inside("color_map", &rgb(first, 1.0), &rgb(second, 1.0));
        format!("pigment {{ {inside} }}")
    }

    /// What stands in the braces of a texture that shows one of two.
    pub(super) fn texture(&self, first: &str, second: &str) -> String {
        if self.pattern == "checker" {
            let [first, second] = [first, second].map(|own| format!("texture {{ {own} }}"));
            return self.inside("", &first, &second);
        }
        self.inside("texture_map", first, second)
    }

    fn inside(&self, map: &str, first: &str, second: &str) -> String {
        let Self { pattern, transform } = self;
        if pattern == "checker" {
            return format!("checker {first} {second} {transform}");
        }
        format!("{pattern} {map} {{ [0.5 {first}] [0.5 {second}] }} {transform}")
    }
}

/// The cells of each part of a shape: one for most, one for each face of a tetrahedron and for
/// the triangles of a mesh that face most along each axis.
pub(super) fn cells(geometry: &Geometry, surface: &Surface) -> Vec<Cells> {
    let Pattern::Checker(checker) = surface.pattern else { return Vec::new() };
    let Checker { length, angle, .. } = checker;
    let (length, angle) = (length.get(), angle.get());
    let (l, a) = (Number(length), Number(angle));
    vec![match geometry {
        Geometry::Sphere(sphere) => {
            Cells::function(format!("LancerBall(x, y, z, {a})"), &Frame::at(sphere.centre.get()))
        }
        Geometry::Plane(plane) => {
            Cells::squares(length, &Frame::around(plane.normal.get(), plane.origin.get()))
        }
        Geometry::Disc(disc) => {
            Cells::squares(length, &Frame::around(disc.normal.get(), disc.centre.get()))
        }
        Geometry::Rectangle(rectangle) => {
            let sides = rectangle.sides().map(Direction::get);
            Cells::squares(length, &Frame::of_sides(rectangle.corner(), sides))
        }
        Geometry::Triangle(triangle) => {
            let [a, b, c] = triangle.corners();
            Cells::squares(length, &Frame::of_sides(a, [b - a, c - a]))
        }
        Geometry::Cuboid(cuboid) => {
            let s = sides(cuboid);
            let [w, d, h] = [s.x, s.y, s.z].map(Number);
            let call = format!("LancerBox(x, y, z, {w}, {d}, {h}, {l})");
            Cells::function(call, &Frame::at(cuboid.min()))
        }
        Geometry::Cone(cone) => {
            let frame = Frame::around(cone.top() - cone.base(), cone.base());
            let (slope, height) = slope(cone);
            let call = if cone.open {
                format!("LancerTube(x, y, z, {l}, {a})")
            } else {
                let [r, s, h] = [cone.base_radius(), slope, height].map(Number);
                format!("LancerLids(x, y, z, {r}, {s}, {h}, {l}, {a})")
            };
            Cells::function(call, &frame)
        }
        Geometry::Torus(torus) => {
            let frame = Frame::around(torus.axis.get(), torus.centre.get());
            Cells::function(format!("LancerRing(x, y, z, {}, {a})", Number(torus.ring())), &frame)
        }
        Geometry::Tetrahedron(tetrahedron) => {
            let corners = tetrahedron.corners();
            let of_face = |face: &[usize; 3]| {
                let [a, b, c] = face.map(|corner| corners[corner]);
                Cells::squares(length, &Frame::of_sides(a, [b - a, c - a]))
            };
            return super::shape::FACES.iter().map(of_face).collect();
        }
        Geometry::Mesh(_) => {
            let calls = ["LancerCell(y, z)", "LancerCell(z, x)", "LancerCell(x, y)"];
            let of_axis = |call: &str| Cells {
                pattern: format!("function {{ {call} }}"),
                transform: format!("scale {l}"),
            };
            return calls.into_iter().map(of_axis).collect();
        }
        Geometry::Custom(_) => return Vec::new(),
    }]
}

/// Which of the three cells of a mesh a triangle has: by the axis that its normal has
/// most of.
pub(crate) fn axis(mesh: &Mesh, triangle: usize) -> usize {
    let [a, b, c] = mesh.corners(triangle);
    let scale = (b - a).amax().max((c - a).amax());
    ((b - a) / scale).cross(&((c - a) / scale)).iamax()
}

/// A list of textures, as meshes have it.
pub(super) fn texture_list(textures: &[String]) -> String {
    let mut list = format!(" texture_list {{ {}", textures.len());
    for inside in textures {
        let _ = write!(list, " texture {{ {inside} }}");
    }
    list + " }"
}
