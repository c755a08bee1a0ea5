//! Round shapes as meshes.

use super::ply::{Corner, Triangles};
use crate::frame::{Frame, slope};
use lancer_math::{Vector, sin_cos_degrees};
use lancer_scene::{Checker, Cone, Disc, Sphere, Torus};

/// How many flats there are around an axis, and around the tube of a ring or from pole to pole:
/// a flat is off by the radius times 1 - cos(180 degrees / AROUND) at most, 2e-5 of it.
const AROUND: u32 = 512;
const ALONG: u32 = 256;

/// From the centre of a lid to its edge.
const OUTWARD: u32 = 2;

/// The angle of one of so many steps of a whole turn, with its sine and cosine.
fn step(i: u32, of: u32, whole: f64) -> (f64, f64, f64) {
    let degrees = whole * f64::from(i) / f64::from(of);
    let (sine, cosine) = sin_cos_degrees(degrees);
    (degrees, sine, cosine)
}

/// A corner of a frame's own coordinates.
fn corner(frame: &Frame, at: Vector, normal: Vector, uv: [f64; 2]) -> Corner {
    let [x, y, z] = frame.axes;
    let out = |v: Vector| x * v.x + y * v.y + z * v.z;
    Corner { point: frame.origin + out(at), normal: out(normal), uv }
}

pub(super) fn cone(cone: &Cone, checker: &Checker) -> Triangles {
    let frame = Frame::around(cone.top() - cone.base(), cone.base());
    let (slope, length) = slope(cone);
    let (l, a) = (2.0 * checker.length.get(), 2.0 * checker.angle.get());
    let radii = [cone.base_radius(), cone.top_radius()];
    let mut mesh = Triangles { is_smooth: true, ..Triangles::default() };
    mesh.grid(2, AROUND + 1, |row, column| {
        let (degrees, sine, cosine) = step(column, AROUND, 360.0);
        let (radius, z) = (radii[row as usize], length * f64::from(row));
        let normal = Vector::new(cosine, sine, -slope);
        corner(&frame, Vector::new(cosine * radius, sine * radius, z), normal, [z / l, degrees / a])
    });
    if cone.open {
        return mesh;
    }
    for (radius, z, up) in [(radii[0], 0.0, -1.0), (radii[1], length, 1.0)] {
        lid(&mut mesh, &frame, [radius, z, up], |radius, _, _, degrees| [radius / l, degrees / a]);
    }
    mesh
}

/// A circle across a frame's axis at a height, facing up or down.
fn lid(
    mesh: &mut Triangles,
    frame: &Frame,
    [radius, z, up]: [f64; 3],
    uv: impl Fn(f64, f64, f64, f64) -> [f64; 2],
) {
    if radius == 0.0 {
        return;
    }
    mesh.grid(OUTWARD, AROUND + 1, |row, column| {
        let column = if up > 0.0 { column } else { AROUND - column };
        let (degrees, sine, cosine) = step(column, AROUND, 360.0);
        let r = radius * f64::from(row) / f64::from(OUTWARD - 1);
        let (x, y) = (r * cosine, r * sine);
        corner(frame, Vector::new(x, y, z), Vector::z() * up, uv(r, x, y, degrees))
    });
    // Rows go outward, so that columns must go the other way around.
    let faces = mesh.faces.len() - ((OUTWARD - 1) * AROUND * 2) as usize;
    mesh.faces[faces..].iter_mut().for_each(|face| face.swap(1, 2));
}

/// Its checker is squares of the plane.
pub(super) fn disc(disc: &Disc, checker: &Checker) -> Triangles {
    let frame = Frame::around(disc.normal.get(), disc.centre.get());
    let l = 2.0 * checker.length.get();
    let mut mesh = Triangles { is_smooth: true, ..Triangles::default() };
    lid(&mut mesh, &frame, [disc.radius.get(), 0.0, 1.0], |_, x, y, _| [x / l, y / l]);
    mesh
}

pub(super) fn torus(torus: &Torus, checker: &Checker) -> Triangles {
    let frame = Frame::around(torus.axis.get(), torus.centre.get());
    let a = 2.0 * checker.angle.get();
    let mut mesh = Triangles { is_smooth: true, ..Triangles::default() };
    mesh.grid(ALONG + 1, AROUND + 1, |row, column| {
        let (turn, sine, cosine) = step(column, AROUND, 360.0);
        let (around, up, out) = step(row, ALONG, 360.0);
        let across = torus.ring() + torus.tube() * out;
        let at = Vector::new(across * cosine, across * sine, torus.tube() * up);
        corner(&frame, at, Vector::new(out * cosine, out * sine, up), [turn / a, around / a])
    });
    mesh
}

pub(super) fn sphere(sphere: &Sphere, checker: &Checker) -> Triangles {
    let frame = Frame::at(sphere.centre.get());
    let a = 2.0 * checker.angle.get();
    let mut mesh = Triangles { is_smooth: true, ..Triangles::default() };
    mesh.grid(ALONG + 1, AROUND + 1, |row, column| {
        let (turn, sine, cosine) = step(column, AROUND, 360.0);
        let (up, z, across) = step(row, ALONG, 180.0);
        // From the south pole to the north pole.
        let (z, across) = (-across, z);
        let normal = Vector::new(across * cosine, across * sine, z);
        corner(&frame, normal * sphere.radius.get(), normal, [turn / a, (up - 90.0) / a])
    });
    mesh
}
