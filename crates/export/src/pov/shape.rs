use super::checker::{self, texture_list};
use super::matrix;
use super::surface::Look;
use crate::frame::Frame;
use crate::text::{Number, angled, angled_point};
use lancer_math::{Point, Vector, unit};
use lancer_scene::{Cone, Direction, Geometry, Mesh, Shape, Torus};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The corners of each face of a tetrahedron, counterclockwise from outside; a face's
/// checker begins at the first.
pub(crate) const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];

/// A shape with its textures, up to what stands before its closing brace. `None` for one of the
/// user's own.
pub(super) fn object(shape: &Shape, look: &Look<'_>) -> Option<String> {
    let cells = look.cells(&shape.geometry);
    let textures: Vec<String> = if cells.is_empty() {
        vec![look.texture(None)]
    } else {
        cells.iter().map(|cells| look.texture(Some(cells))).collect()
    };
    let solid = match &shape.geometry {
        Geometry::Sphere(sphere) => {
            let centre = angled_point(&sphere.centre.get());
            format!("sphere {{ {centre}, {}", Number(sphere.radius.get()))
        }
        Geometry::Plane(plane) => {
            let normal = unit(plane.normal.get())?;
            let distance = normal.dot(&plane.origin.get().coords);
            format!("plane {{ {}, {}", angled(&normal), Number(distance))
        }
        Geometry::Disc(disc) => {
            let (centre, normal) = (angled_point(&disc.centre.get()), unit(disc.normal.get())?);
            format!("disc {{ {centre}, {}, {}", angled(&normal), Number(disc.radius.get()))
        }
        Geometry::Rectangle(rectangle) => {
            let [a, b] = rectangle.sides().map(Direction::get);
            let normal = Frame::of_sides(Point::origin(), [a, b]).axes[2];
            let place = Frame { axes: [a, b, normal], origin: rectangle.corner() };
            format!(
                "polygon {{ 5, <0, 0, 0>, <1, 0, 0>, <1, 1, 0>, <0, 1, 0>, <0, 0, 0> {}",
                matrix(&place)
            )
        }
        Geometry::Triangle(triangle) => {
            let corners = triangle.corners().map(|corner| angled_point(&corner));
            format!("triangle {{ {}", corners.join(", "))
        }
        Geometry::Cuboid(cuboid) => {
            format!("box {{ {}, {}", angled_point(&cuboid.min()), angled_point(&cuboid.max()))
        }
        Geometry::Cone(cone) => lathe(cone),
        Geometry::Torus(torus) => ring(torus),
        Geometry::Tetrahedron(tetrahedron) => {
            let corners = tetrahedron.corners();
            let faces: Vec<_> = (0..).zip(FACES).map(|(part, face)| (face, None, part)).collect();
            return Some(mesh2(&corners, &[], &faces, &textures, true));
        }
        Geometry::Mesh(mesh) => return Some(triangles(mesh, &textures)),
        Geometry::Custom(_) => return None,
    };
    Some(format!("{solid} texture {{ {} }}", textures[0]))
}

fn lathe(cone: &Cone) -> String {
    let (base, top) = (angled_point(&cone.base()), angled_point(&cone.top()));
    let (first, second) = (Number(cone.base_radius()), Number(cone.top_radius()));
    let open = if cone.open { " open" } else { "" };
    if cone.base_radius() == cone.top_radius() {
        format!("cylinder {{ {base}, {top}, {first}{open}")
    } else {
        format!("cone {{ {base}, {first}, {top}, {second}{open}")
    }
}

/// Its own axis is y.
fn ring(torus: &Torus) -> String {
    let Frame { axes: [first, second, axis], origin } =
        Frame::around(torus.axis.get(), torus.centre.get());
    let place = Frame { axes: [first, axis, second], origin };
    format!("torus {{ {}, {} sturm {}", Number(torus.ring()), Number(torus.tube()), matrix(&place))
}

/// Indices of corners, those of normals, and which texture.
type Face = ([usize; 3], Option<[usize; 3]>, usize);

fn triangles(mesh: &Mesh, textures: &[String]) -> String {
    let (mut corners, mut normals) = (Pool::default(), Pool::default());
    let faces: Vec<Face> = (0..mesh.triangle_count())
        .map(|triangle| {
            let points = mesh.corners(triangle);
            let part = if textures.len() > 1 { checker::axis(mesh, triangle) } else { 0 };
            let shading = mesh.corner_normals(triangle).map(|own| {
                let [a, b, c] = points;
                let facet = (b - a).cross(&(c - a));
                own.map(|n| normals.index(unit(n).or_else(|| unit(facet)).unwrap_or(facet)))
            });
            (points.map(|point| corners.index(point.coords)), shading, part)
        })
        .collect();
    let points: Vec<Point> = corners.list.into_iter().map(Point::from).collect();
    mesh2(&points, &normals.list, &faces, textures, mesh.is_closed())
}

/// Vectors, each once.
#[derive(Default)]
struct Pool {
    list: Vec<Vector>,
    known: BTreeMap<[u64; 3], usize>,
}

impl Pool {
    fn index(&mut self, v: Vector) -> usize {
        let next = self.list.len();
        let index = *self.known.entry([v.x, v.y, v.z].map(f64::to_bits)).or_insert(next);
        if index == next {
            self.list.push(v);
        }
        index
    }
}

fn mesh2(
    corners: &[Point],
    normals: &[Vector],
    faces: &[Face],
    textures: &[String],
    closed: bool,
) -> String {
    let vectors = |list: &mut dyn Iterator<Item = String>| list.collect::<Vec<_>>().join(",");
    let mut text = format!("mesh2 {{ vertex_vectors {{ {},", corners.len());
    text += &vectors(&mut corners.iter().map(angled_point));
    text += " }";
    if !normals.is_empty() {
        let _ = write!(text, " normal_vectors {{ {},", normals.len());
        text += &vectors(&mut normals.iter().map(angled));
        text += " }";
    }
    if textures.len() > 1 {
        text += &texture_list(textures);
    }
    let triple = |[a, b, c]: [usize; 3]| format!("<{a},{b},{c}>");
    let _ = write!(text, " face_indices {{ {}", faces.len());
    for (corners, _, part) in faces {
        let _ = write!(text, ",{}", triple(*corners));
        if textures.len() > 1 {
            let _ = write!(text, ",{part}");
        }
    }
    text += " }";
    if !normals.is_empty() {
        let _ = write!(text, " normal_indices {{ {}", faces.len());
        for (_, shading, _) in faces {
            let _ = write!(text, ",{}", triple(shading.unwrap_or_default()));
        }
        text += " }";
    }
    if closed {
        text += " inside_vector <0.1, 0.2, 0.97>";
    }
    if let [only] = textures {
        let _ = write!(text, " texture {{ {only} }}");
    }
    text
}
