use super::*;

/// The corners of [0, side]^3, shifted; corner i has bit k of i along axis k.
fn cube_corners(side: f64, shift: [f64; 3]) -> Vec<[f64; 3]> {
    (0..8).map(|i| [0, 1, 2].map(|k| shift[k] + if i >> k & 1 == 1 { side } else { 0.0 })).collect()
}

fn cube_triangles() -> Vec<[u32; 3]> {
    let quads =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect()
}

fn cube() -> Mesh {
    Mesh::new(cube_corners(2.0, [-1.0; 3]), cube_triangles()).unwrap()
}

/// An octahedron whose triangles are halved and blown up to the unit sphere.
/// No vertex is shared, as in an STL file.
fn ball(halvings: u32) -> Mesh {
    let v = |x: f64, y: f64, z: f64| Vector::new(x, y, z);
    let mut faces = Vec::new();
    for i in 0..8 {
        let s = [1, 2, 4].map(|bit| if i & bit == 0 { 1.0 } else { -1.0 });
        let (x, y, z) = (v(s[0], 0.0, 0.0), v(0.0, s[1], 0.0), v(0.0, 0.0, s[2]));
        faces.push(if s[0] * s[1] * s[2] > 0.0 { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..halvings {
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| unit(p + q).unwrap());
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let positions = faces.iter().flatten().map(|p| [p.x, p.y, p.z]).collect();
    let triangles = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    Mesh::new(positions, triangles.collect()).unwrap()
}

#[test]
fn volumes_are_those_of_closed_forms() {
    assert_eq!(cube().signed_volume(), 8.0);
    let far = Mesh::new(cube_corners(2.0, [1e6, -3e6, 5e5]), cube_triangles()).unwrap();
    assert_eq!(far.signed_volume(), 8.0);
    let inside_out = cube_triangles().iter().map(|[a, b, c]| [*c, *b, *a]).collect();
    let inside_out = Mesh::new(cube_corners(2.0, [-1.0; 3]), inside_out).unwrap();
    assert_eq!(inside_out.signed_volume(), -8.0);
    assert!(inside_out.is_closed());
    // Regular, with edges of the square root of 8: 8^(3/2) / (6 sqrt 2) = 8/3.
    let corners = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let faces = vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let tetrahedron = Mesh::new(corners, faces).unwrap();
    assert!((tetrahedron.signed_volume() - 8.0 / 3.0).abs() < 1e-15);
    // The error of an inscribed polyhedron falls with the square of its edges.
    let full = 4.0 / 3.0 * std::f64::consts::PI;
    let missing = [4, 5].map(|halvings| full - ball(halvings).signed_volume());
    assert!(missing[1] > 0.0 && (missing[0] / missing[1] - 4.0).abs() < 0.05, "{missing:?}");
}

#[test]
fn closed_is_without_hole_and_of_one_sense() {
    assert!(cube().is_closed());
    assert!(ball(3).is_closed());
    let change = |change: fn(&mut Vec<[u32; 3]>)| {
        let mut triangles = cube_triangles();
        change(&mut triangles);
        Mesh::new(cube_corners(2.0, [-1.0; 3]), triangles).unwrap()
    };
    assert!(!change(|t| t.truncate(11)).is_closed());
    assert!(!change(|t| t[0].swap(1, 2)).is_closed());
    assert!(!change(|t| t.push(t[0])).is_closed());
    // Twice the same cube: each edge has as many of one kind as of the other.
    assert!(change(|t| t.extend_from_within(..)).is_closed());
}

#[test]
fn zeros_of_both_signs_are_one_place() {
    let mut positions = cube_corners(1.0, [0.0; 3]);
    let mut triangles = cube_triangles();
    positions.push([-0.0, 0.0, -0.0]);
    triangles[0][0] = 8;
    assert!(Mesh::new(positions, triangles).unwrap().is_closed());
}

#[test]
fn single_precision_exactly_where_nothing_is_lost() {
    let with = |x: f64| {
        Mesh::new(vec![[x, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap()
    };
    for x in [0.0, -0.0, f64::from(0.1_f32), 1e-45_f32.into(), f32::MAX.into()] {
        let mesh = with(x);
        assert!(mesh.is_single_precision(), "{x}");
        assert_eq!(mesh.corner(0, 0).x.to_bits(), x.to_bits());
    }
    for x in [0.1, 1e-46, 1e39, 1.0 + f64::EPSILON] {
        let mesh = with(x);
        assert!(!mesh.is_single_precision(), "{x}");
        assert_eq!(mesh.corners(0)[0].x.to_bits(), x.to_bits());
    }
    assert!(with(0.1).bytes() - with(0.5).bytes() == 3 * 12);
}

#[test]
fn triangles_without_area_are_left_out_and_no_others() {
    let points = |k: f64| {
        [[0, 0, 0], [1, 1, 1], [3, 3, 3], [1, 0, 0], [0, 1, 0]]
            .map(|p: [i32; 3]| p.map(|c| k * f64::from(c)))
            .to_vec()
    };
    for k in [1.0, 1e-320, 1e-200, 1e200, 5e307] {
        let given = vec![[0, 1, 2], [0, 3, 4], [3, 3, 4], [0, 3, 0], [4, 3, 0]];
        let mesh = Mesh::new(points(k), given).unwrap();
        assert_eq!((mesh.triangle_count(), mesh.dropped()), (2, 3), "{k}");
        assert_eq!(mesh.corner(0, 1).x, k);
    }
    // Edges longer than the largest number.
    let far = vec![[-1.7e308, 0.0, 0.0], [1.7e308, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(Mesh::new(far, vec![[0, 1, 2]]).unwrap().dropped(), 0);
    assert_eq!(
        Mesh::new(points(1.0), vec![[0, 1, 2], [3, 3, 3]]).unwrap_err().to_string(),
        "none of the 2 triangles has an area"
    );
    // A needle that closes the seam between one edge and its two halves.
    let mut positions = cube_corners(2.0, [-1.0; 3]);
    positions.push([0.0, -1.0, -1.0]); // Between corners 0 and 1.
    let mut triangles = cube_triangles();
    let split = triangles.iter().position(|t| *t == [0, 1, 5]).unwrap();
    triangles[split] = [0, 8, 5];
    triangles.push([8, 1, 5]);
    assert!(!Mesh::new(positions.clone(), triangles.clone()).unwrap().is_closed());
    triangles.push([0, 1, 8]);
    let mesh = Mesh::new(positions, triangles).unwrap();
    assert_eq!((mesh.dropped(), mesh.is_closed()), (1, true));
}

#[test]
fn mistakes_are_named() {
    let message = |positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>| {
        Mesh::new(positions, triangles).unwrap_err().to_string()
    };
    let corners = cube_corners(1.0, [0.0; 3]);
    assert_eq!(message(corners.clone(), vec![]), "the mesh has no triangle");
    assert_eq!(
        message(corners.clone(), vec![[0, 1, 2], [7, 8, 0]]),
        "triangle 1 has vertex 8, but there are only 8"
    );
    let mut bad = corners;
    bad[3][1] = f64::NAN;
    assert_eq!(
        message(bad, cube_triangles()),
        "vertex 3 is (1, NaN, 0), expected finite coordinates"
    );
    let message = |normals: Vec<[f32; 3]>, indices: Option<Vec<[u32; 3]>>| {
        cube().with_normals(normals, indices).unwrap_err().to_string()
    };
    assert_eq!(message(vec![[0.0; 3]; 7], None), "there are 7 normals, expected 8");
    assert_eq!(
        message(vec![[0.0; 3]], Some(vec![[0; 3]; 3])),
        "there are 3 triples of normals, expected 12"
    );
    assert_eq!(
        message(vec![[0.0; 3]], Some(vec![[0, 0, 1]; 12])),
        "triangle 0 has normal 1, but there are only 1"
    );
    assert_eq!(
        message(vec![[f32::INFINITY, 0.0, 0.0]; 8], None),
        "normal 0 is (inf, 0, 0), expected finite coordinates"
    );
}

#[test]
fn normals_of_dropped_triangles_are_dropped_with_them() {
    let positions = cube_corners(1.0, [0.0; 3]);
    let mesh = Mesh::new(positions, vec![[0, 0, 1], [0, 1, 2], [3, 3, 3], [1, 2, 4]]).unwrap();
    assert!(mesh.corner_normals(0).is_none());
    let normals = (0..4_u8).map(|i| [f32::from(i), 0.0, 0.0]).collect();
    let corners = (0..4).map(|i| [i; 3]).collect();
    let mesh = mesh.with_normals(normals, Some(corners)).unwrap();
    assert_eq!(mesh.corner_normals(0).unwrap()[2].x, 1.0);
    assert_eq!(mesh.corner_normals(1).unwrap()[0].x, 3.0);
}

#[test]
fn smooth_normals_of_a_cube_do_not_depend_on_its_diagonals() {
    let mesh = cube().with_smooth_normals();
    let third = 1.0 / 3.0_f64.sqrt();
    for triangle in 0..12 {
        for (p, n) in mesh.corners(triangle).iter().zip(mesh.corner_normals(triangle).unwrap()) {
            assert!((n - p.coords * third).norm() < 1e-7, "{p} {n}");
        }
    }
    // Those that are there stay.
    let up = cube().with_normals(vec![[0.0, 0.0, 2.0]; 8], None).unwrap();
    assert_eq!(up.with_smooth_normals().corner_normals(0).unwrap()[0].z, 2.0);
}

#[test]
fn smooth_normals_of_a_ball_are_radial() {
    // Every vertex is there up to six times; if places were not shared, the
    // normals would be off by as much as the faces are, here 0.028.
    let mesh = ball(5).with_smooth_normals();
    for triangle in 0..mesh.triangle_count() {
        for (p, n) in mesh.corners(triangle).iter().zip(mesh.corner_normals(triangle).unwrap()) {
            assert!((n - p.coords).norm() < 6e-3, "{p} {n}");
        }
    }
}

#[test]
fn bounds_are_those_of_corners_that_are_used() {
    let mut positions = cube_corners(1.0, [2.0; 3]);
    positions.push([-9.0; 3]);
    let mesh = Mesh::new(positions, cube_triangles()).unwrap();
    assert_eq!(mesh.bounds(), (Point::new(2.0, 2.0, 2.0), Point::new(3.0, 3.0, 3.0)));
}
