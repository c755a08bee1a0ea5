//! Random meshes: lumpy balls, boxes in small pieces, and hilly sheets.

use super::facets::Facets;
use super::sample::{Curve, Patch, any_direction, between, power_of_ten};
use super::subject::Subject;
use fastrand::Rng;
use lancer_math::{Point, Vector, unit};
use lancer_scene::{Mesh, Shape, Surface};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Positions, and triples of their indices.
#[derive(Debug, Default)]
pub(crate) struct Soup {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Vertices by where they are on a lattice, so that neighbours share them.
#[derive(Default)]
struct Lattice {
    soup: Soup,
    known: BTreeMap<[i32; 3], u32>,
}

impl Lattice {
    fn vertex(&mut self, at: [i32; 3]) -> u32 {
        *self.known.entry(at).or_insert_with(|| {
            self.soup.positions.push(at.map(f64::from));
            self.soup.positions.len() as u32 - 1
        })
    }

    fn triangle(&mut self, corners: [[i32; 3]; 3]) {
        let triangle = corners.map(|at| self.vertex(at));
        self.soup.triangles.push(triangle);
    }

    fn quadrangle(&mut self, [a, b, c, d]: [[i32; 3]; 4], other_diagonal: bool) {
        let [p, q] = if other_diagonal { [[b, c, d], [b, d, a]] } else { [[a, b, c], [a, c, d]] };
        self.triangle(p);
        self.triangle(q);
    }
}

/// The sides of an octahedron, cut into n^2 triangles each.
fn octahedron(n: i32) -> Soup {
    let mut lattice = Lattice::default();
    for octant in 0..8 {
        let signs = [0, 1, 2].map(|axis| if octant >> axis & 1 == 0 { 1 } else { -1 });
        let at = |i: i32, j: i32| [signs[0] * i, signs[1] * j, signs[2] * (n - i - j)];
        let mut add = |corners: [[i32; 3]; 3]| {
            let [a, b, c] = corners;
            lattice.triangle(if signs.iter().product::<i32>() > 0 { [a, b, c] } else { [a, c, b] });
        };
        for i in 0..n {
            for j in 0..n - i {
                add([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j < n - 1 {
                    add([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
    }
    lattice.soup
}

/// The sides of a cube, cut into n^2 squares each.
fn cube(rng: &mut Rng, n: i32) -> Soup {
    let mut lattice = Lattice::default();
    for (axis, level) in [(0, 0), (0, n), (1, 0), (1, n), (2, 0), (2, n)] {
        let at = |u: i32, v: i32| {
            let mut at = [level; 3];
            (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (u, v);
            at
        };
        for (u, v) in (0..n).flat_map(|u| (0..n).map(move |v| (u, v))) {
            let [a, b, c, d] = [at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)];
            lattice.quadrangle(if level == n { [a, b, c, d] } else { [a, d, c, b] }, rng.bool());
        }
    }
    lattice.soup
}

fn sheet(rng: &mut Rng, n: i32) -> Soup {
    let mut lattice = Lattice::default();
    for (u, v) in (0..n).flat_map(|u| (0..n).map(move |v| (u, v))) {
        let corners = [[u, v, 0], [u + 1, v, 0], [u + 1, v + 1, 0], [u, v + 1, 0]];
        lattice.quadrangle(corners, rng.bool());
    }
    lattice.soup
}

pub(crate) fn random_mesh(rng: &mut Rng, is_closed: bool) -> Soup {
    let n = rng.i32(2..=6);
    // Some keep their flat sides and right angles.
    let lumps = if rng.u8(..3) == 0 { 0.0 } else { power_of_ten(rng, -9.0, -1.0) };
    let mut soup = match (is_closed, rng.bool()) {
        (true, true) => {
            let mut soup = octahedron(n);
            for p in &mut soup.positions {
                let out = unit(Vector::from(*p)).expect("not the centre");
                *p = (out * (1.0 + between(rng, 0.0, lumps))).into();
            }
            soup
        }
        (true, false) => {
            let mut soup = cube(rng, n);
            jitter(&mut soup, rng, lumps);
            soup
        }
        (false, _) => {
            let mut soup = sheet(rng, n);
            jitter(&mut soup, rng, 3.0 * lumps);
            soup
        }
    };
    let size = power_of_ten(rng, -2.0, 2.0);
    let stretch = [(); 3].map(|()| size * between(rng, 0.3, 1.0));
    let (reach, to) = (power_of_ten(rng, -1.0, 2.0), any_direction(rng));
    let is_single = rng.bool();
    for p in &mut soup.positions {
        *p = [0, 1, 2].map(|k| p[k] * stretch[k] + reach * to[k]);
        if is_single {
            *p = p.map(|c| f64::from(c as f32));
        }
    }
    soup
}

fn jitter(soup: &mut Soup, rng: &mut Rng, by: f64) {
    for c in soup.positions.iter_mut().flatten() {
        *c += between(rng, -by, by);
    }
}

impl Soup {
    pub(crate) fn subject(self, surface: Surface) -> Subject {
        let figure = Facets::new(&self.positions, &self.triangles);
        let corner = |vertex: u32| Point::from(self.positions[vertex as usize]);
        let faces: Vec<_> = self.triangles.iter().map(|t| t.map(corner)).collect();
        let edges = |[a, b, c]: &[Point; 3]| [[*a, *b], [*b, *c], [*c, *a]].map(Curve::Segment);
        let curves = faces.iter().flat_map(edges).collect();
        let patches = faces.iter().map(|face| Patch::Triangle(*face)).collect();
        let mesh = Mesh::new(self.positions, self.triangles).expect("a mesh");
        assert_eq!(mesh.dropped(), 0, "figure and mesh have other triangles");
        let (min, max) = mesh.bounds();
        let centre = min + (max - min) * 0.5;
        let shape = Shape::mesh(Arc::new(mesh), surface);
        super::subject::subject(
            shape,
            figure,
            (patches, curves),
            (centre, (max - min).norm() * 0.5),
        )
    }
}
