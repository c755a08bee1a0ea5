//! Closed meshes to be looked at from inside.

use super::mesh::{cube, octahedron};
use fastrand::Rng;
use lancer_math::{Vector, sin_cos_degrees, unit};
use lancer_scene::Mesh;

/// The sides of an octahedron, cut into `cuts`^2 triangles each, on a ball.
///
/// # Panics
/// Where `cuts` is not above 0.
#[must_use]
pub fn ball(cuts: i32) -> Mesh {
    let soup = octahedron(cuts);
    let out = |p: [f64; 3]| unit(Vector::from(p)).expect("not the centre").into();
    let positions = soup.positions.into_iter().map(out).collect();
    Mesh::new(positions, soup.triangles).expect("a ball")
}

/// A cube with sides of `cuts`^2 squares of 2 triangles each.
///
/// # Panics
/// Where `cuts` is not above 0.
#[must_use]
pub fn block(cuts: i32) -> Mesh {
    let soup = cube(&mut Rng::with_seed(1), cuts);
    Mesh::new(soup.positions, soup.triangles).expect("a cube")
}

/// A ring of `cuts` by `cuts` / 2 squares of 2 triangles each, its tube half as thick
/// as its hole is wide.
///
/// # Panics
/// Where `cuts` is not at least 6.
#[must_use]
pub fn ring(cuts: u32) -> Mesh {
    let around = cuts / 2;
    let turn = |k: u32, of: u32| sin_cos_degrees(360.0 * f64::from(k % of) / f64::from(of));
    let corner = |i: u32, j: u32| {
        let ((sin, cos), (up, out)) = (turn(i, cuts), turn(j, around));
        let radius = 1.0 + out / 3.0;
        [cos * radius, sin * radius, up / 3.0]
    };
    let number = |i: u32, j: u32| i % cuts * around + j % around;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (i, j) in (0..cuts).flat_map(|i| (0..around).map(move |j| (i, j))) {
        positions.push(corner(i, j));
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Mesh::new(positions, triangles).expect("a ring")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_closed_and_look_outward() {
        for mesh in [ball(3), block(2), ring(12)] {
            assert!(mesh.is_closed() && mesh.signed_volume() > 0.0 && mesh.dropped() == 0);
        }
    }
}
