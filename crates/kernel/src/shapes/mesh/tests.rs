use super::*;
use crate::Culling;
use crate::lanes::Width;
use crate::primitive::Cell;
use crate::shapes::testing::{
    all, assert_sound, check_leaving, check_pairs, check_scaling, direction, ray, ray_to,
};
use fastrand::Rng;
use lancer_scene::Colour;

/// A ball of 8 * 4^halvings triangles, each corner a vertex of its own, out
/// of the rounding of midpoints; and a twisted, folded copy that is not convex.
fn ball(halvings: u32, twist: f64) -> Arc<Mesh> {
    let mut faces = Vec::new();
    for i in 0..8 {
        let s = [1, 2, 4].map(|bit| if i & bit == 0 { 1.0 } else { -1.0 });
        let (x, y, z) = (Vector::x() * s[0], Vector::y() * s[1], Vector::z() * s[2]);
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
    let place = |p: &Vector| {
        let (s, c) = lancer_math::sin_cos_degrees(twist * p.z);
        let wide = 1.0 + 0.4 * twist / 90.0 * (p.x * p.y * p.z);
        [wide * (c * p.x - s * p.y), wide * (s * p.x + c * p.y), p.z + 0.3]
    };
    let positions = faces.iter().flatten().map(place).collect();
    let triangles = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let mesh = Mesh::new(positions, triangles.collect()).unwrap();
    assert!(mesh.is_closed());
    Arc::new(mesh)
}

/// At points of edges, at vertices, and anywhere.
fn aimed(mesh: &Mesh, rng: &mut Rng) -> Ray {
    let [a, b, c] = mesh.corners(rng.usize(0..mesh.triangle_count()));
    let target = match rng.u8(0..4) {
        0 => a,
        1 => a + (b - a) * rng.f64(),
        2 => a + (b - a) * 0.5,
        _ => a + (b - a) * (0.5 * rng.f64()) + (c - a) * (0.5 * rng.f64()),
    };
    ray_to(rng, &target, 1.0)
}

/// Atlas T1: edges and vertices of closed meshes have no gap, and counting
/// crossings says what is inside.
#[test]
fn closed_meshes_do_not_leak() {
    for (halvings, twist) in [(0, 0.0), (2, 0.0), (3, 90.0), (4, 200.0)] {
        let mesh = ball(halvings, twist);
        let shape = Facets::new(&mesh, &KernelSettings::default());
        let mut rng = Rng::with_seed(1);
        let rays: Vec<Ray> = (0..100_000).map(|_| aimed(&mesh, &mut rng)).collect();
        let met = check_pairs(&shape, rays.iter().copied());
        assert!(met > 70_000, "{met}");
        // From the middle of a ball, each ray goes out once.
        for ray in rays.iter().filter(|_| twist == 0.0) {
            let out = Ray::new(Point::new(0.0, 0.0, 0.3), ray.direction);
            let mut count = 0;
            shape.each(&out, 0.0, f64::INFINITY, &mut |_| count += 1);
            assert_eq!(count, 1, "{out:?}");
        }
    }
}

/// Atlas T1: two triangles at an edge, fans around a vertex, and a field of
/// whole heights seen from above, with whole numbers.
#[test]
fn each_ray_meets_one_of_the_triangles_around() {
    let mut rng = Rng::with_seed(3);
    let side = 33_u32;
    let mut positions = Vec::new();
    for y in 0..side {
        for x in 0..side {
            positions.push([f64::from(x), f64::from(y), f64::from(rng.u8(0..30))]);
        }
    }
    let mut triangles = Vec::new();
    for y in 0..side - 1 {
        for x in 0..side - 1 {
            let a = y * side + x;
            let (b, c, d) = (a + 1, a + side, a + side + 1);
            let halves = if rng.bool() { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] };
            for mut half in halves {
                half.rotate_left(rng.usize(0..3));
                triangles.push(half);
            }
        }
    }
    let shape = Facets::new(
        &Arc::new(Mesh::new(positions, triangles).unwrap()),
        &KernelSettings::default(),
    );
    // At vertices, at the middles of edges, and at others of their points.
    for y in 4..=124 {
        for x in 4..=124 {
            let o = [f64::from(x) / 4.0, f64::from(y) / 4.0, 100.0];
            for d in [[0.0, 0.0, -1.0], [-0.0, 0.0, -3.0], [0.0, -0.0, -1e-5]] {
                assert_eq!(all(&shape, &ray(o, d)).len(), 1, "{o:?}");
            }
        }
    }
    for case in 0..100_000 {
        let mut c = || 20.0 * rng.f64() - 10.0;
        let [mut a, mut b] = [[c(), c(), c()], [c(), c(), c()]];
        if case % 2 == 0 {
            (a, b) = (a.map(f64::round), b.map(f64::round));
        }
        // One to the left, one to the right of the edge as the ray sees it.
        let (p, q) = ([c(), c(), c()], [c(), c(), c()]);
        let [va, vb, vp, vq] = [a, b, p, q].map(Vector::from);
        let share = if case % 4 < 2 { 0.5 } else { rng.f64() };
        let target = va + (vb - va) * share;
        let way = direction(&mut rng);
        let side = |v: Vector| way.cross(&(vb - va)).dot(&(v - va));
        if (side(vp) < 0.0) == (side(vq) < 0.0) {
            continue;
        }
        let mut corners = [[0, 1, 2], [1, 0, 3]];
        corners[0].rotate_left(rng.usize(0..3));
        corners[1].rotate_left(rng.usize(0..3));
        let Ok(mesh) = Mesh::new(vec![a, b, p, q], corners.to_vec()) else { continue };
        if mesh.triangle_count() < 2 {
            continue;
        }
        let shape = Facets::new(&Arc::new(mesh), &KernelSettings::default());
        let ray = Ray::new(Point::from(target - way * 30.0), way);
        assert_eq!(all(&shape, &ray).len(), 1, "case {case}: {a:?} {b:?} {p:?} {q:?} {ray:?}");
    }
}

#[test]
fn the_hierarchy_finds_what_a_loop_over_all_finds() {
    let mesh = ball(3, 140.0);
    let shape = Facets::new(&mesh, &KernelSettings::default());
    let mut rng = Rng::with_seed(2);
    for case in 0..5000 {
        let ray = aimed(&mesh, &mut rng);
        let shear = Shear::new(&ray);
        let mut list: Vec<f64> = (0..mesh.triangle_count())
            .filter_map(|i| shear.meet(&mesh.corners(i)).map(|met| met.t))
            .collect();
        list.sort_by(f64::total_cmp);
        let found: Vec<f64> = all(&shape, &ray).iter().map(|c| c.t).collect();
        assert_eq!(found, list, "case {case}");
        let nearest = shape.nearest(&ray, f64::INFINITY).map(|c| c.t);
        assert_eq!(nearest, list.into_iter().find(|t| *t > 0.0), "case {case}");
    }
}

#[test]
fn rays_leave_the_surface_they_start_from() {
    for (mesh, convex) in [(ball(3, 0.0), true), (ball(3, 140.0), false)] {
        let shape = Facets::new(&mesh, &KernelSettings::default());
        let mut rng = Rng::with_seed(11);
        let mut aim = Rng::with_seed(12);
        let rays = (0..20_000).map(|_| {
            let [a, b, c] = mesh.corners(aim.usize(0..mesh.triangle_count()));
            let (v, w) = (0.1 + 0.4 * aim.f64(), 0.1 + 0.3 * aim.f64());
            let target = a + (b - a) * v + (c - a) * w;
            ray_to(&mut aim, &target, 1.0)
        });
        // Rays from afar hit edges within their rounding, where beside one
        // facet is not outside of the next.
        let rays = rays.filter(|ray| ray.origin.coords.norm() < 30.0);
        let wrong = check_leaving(&shape, convex, &mut rng, rays);
        assert!(wrong == 0, "{wrong}");
    }
}

#[test]
fn what_faces_inwards_is_turned() {
    let outside = ball(1, 0.0);
    let positions: Vec<[f64; 3]> = (0..outside.triangle_count())
        .flat_map(|i| outside.corners(i).map(|p| [p.x, p.y, p.z]))
        .collect();
    let turned = (0..positions.len() as u32 / 3).map(|i| [3 * i + 2, 3 * i + 1, 3 * i]);
    let mesh = Mesh::new(positions, turned.collect()).unwrap();
    let down = ray([0.1, 0.2, 9.0], [0.0, 0.0, -1.0]);
    for mesh in [Arc::new(mesh.clone()), Arc::new(mesh.with_smooth_normals())] {
        let shape = Facets::new(&mesh, &KernelSettings::default());
        let contact = shape.contact(&down, &shape.nearest(&down, f64::INFINITY).unwrap());
        assert!(contact.normal.z > 0.5 && contact.shading.z > 0.5);
        assert!(shape.contains(&Point::new(0.0, 0.1, 0.2)));
        assert!(shape.volume() > 0.0);
    }
}

/// Those of a ball with smooth normals point away from its middle.
#[test]
fn shading_normals_are_interpolated() {
    let mesh = Arc::new(Mesh::clone(&ball(4, 0.0)).with_smooth_normals());
    let shape = Facets::new(&mesh, &KernelSettings::default());
    let mut rng = Rng::with_seed(5);
    let mut worst = 0.0_f64;
    for _ in 0..10_000 {
        let ray = Ray::new(Point::new(0.0, 0.0, 0.3), direction(&mut rng));
        let crossing = shape.nearest(&ray, f64::INFINITY).unwrap();
        let contact = shape.contact(&ray, &crossing);
        assert_sound(&contact);
        worst = worst.max((contact.shading - ray.direction).norm());
    }
    assert!(worst < 0.012, "{worst}");
    // A normal of zero is that of the facet, and so is a sum that cancels.
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let flat = Mesh::new(corners, vec![[0, 1, 2]]).unwrap();
    let down = ray([0.2, 0.2, 1.0], [0.0, 0.0, -1.0]);
    for (normals, expected) in [
        ([[0.0; 3]; 3], [0.0, 0.0, 1.0]),
        ([[0.0, 0.0, -5.0]; 3], [0.0, 0.0, 1.0]),
        ([[3.0, 0.0, 0.0]; 3], [0.0, 0.0, 1.0]),
        ([[3.0, 0.0, 4.0]; 3], [0.6, 0.0, 0.8]),
    ] {
        let mesh = flat.clone().with_normals(normals.to_vec(), None).unwrap();
        let shape = Facets::new(&Arc::new(mesh), &KernelSettings::default());
        let contact = shape.contact(&down, &shape.nearest(&down, 9.0).unwrap());
        assert!((contact.shading - Vector::from(expected)).norm() < 1e-7, "{normals:?}");
    }
}

#[test]
fn open_meshes_have_no_inside_and_checkers_squares() {
    let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.5]].to_vec();
    let shape = Facets::new(
        &Arc::new(Mesh::new(corners, vec![[0, 1, 2]]).unwrap()),
        &KernelSettings::default(),
    );
    assert!(!shape.contains(&Point::new(0.5, 0.5, 0.01)));
    let checker = Checker::new(Colour::RED);
    for (x, y, expected) in
        [(0.5, 0.5, Cell::First), (1.5, 0.5, Cell::Second), (1.5, 1.5, Cell::First)]
    {
        let ray = ray([x, y, 9.0], [0.0, 0.0, -1.0]);
        let crossing = shape.nearest(&ray, 10.0).unwrap();
        let contact = shape.contact(&ray, &crossing);
        assert_eq!(shape.square(&contact, crossing.part, &checker).cell, expected, "{x} {y}");
    }
}

#[test]
fn scaled_by_powers_of_two_the_bits_are_the_same() {
    let mesh = Mesh::clone(&ball(2, 77.0)).with_smooth_normals();
    let mut rng = Rng::with_seed(7);
    let rays: Vec<Ray> = (0..2000).map(|_| aimed(&mesh, &mut rng)).collect();
    let normals: Vec<[f32; 3]> = (0..mesh.triangle_count())
        .flat_map(|i| mesh.corner_normals(i).unwrap().map(|n| [n.x, n.y, n.z]))
        .map(|n| n.map(|c| c as f32))
        .collect();
    check_scaling(
        |k| {
            let positions: Vec<[f64; 3]> = (0..mesh.triangle_count())
                .flat_map(|i| mesh.corners(i).map(|p| [p.x * k, p.y * k, p.z * k]))
                .collect();
            let triangles = (0..positions.len() as u32 / 3).map(|i| [0, 1, 2].map(|j| 3 * i + j));
            let scaled = Mesh::new(positions, triangles.collect()).unwrap();
            let scaled = scaled.with_normals(normals.clone(), None).unwrap();
            Box::new(Facets::new(&Arc::new(scaled), &KernelSettings::default()))
        },
        &rays,
    );
}

/// What each width says of single rays and of batches, sorted or not, is what a loop
/// over all triangles says: the first of those at the same t.
#[test]
fn batches_and_widths_do_not_matter() {
    for (mesh, rays) in [(ball(3, 140.0), 3000), (heights(24), 3000)] {
        let mut rng = Rng::with_seed(21);
        let mut rays: Vec<Ray> = (0..rays).map(|_| aimed(&mesh, &mut rng)).collect();
        for odd in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
            rays.push(ray([0.0; 3], odd));
            rays.push(ray(odd, [0.0, 0.0, 1.0]));
        }
        for t_max in [f64::INFINITY, 1.0, 0.3] {
            let expected: Vec<Option<Crossing>> =
                rays.iter().map(|ray| first_of_all(&mesh, ray, t_max)).collect();
            let met = expected.iter().flatten().count();
            assert!(met > 10, "{met}");
            for lanes in Width::available() {
                for culling in [Culling::ALL, Culling::NONE] {
                    let shape = Facets::new(&mesh, &KernelSettings { lanes, culling });
                    let mut nearest = vec![None; rays.len()];
                    shape.nearest_each(&rays, t_max, &mut nearest);
                    assert_eq!(nearest, expected, "{}", lanes.name());
                    let mut any = vec![false; rays.len()];
                    shape.any_each(&rays, t_max, &mut any);
                    assert!(any.iter().zip(&expected).all(|(any, one)| *any == one.is_some()));
                    for (ray, expected) in rays.iter().zip(&expected) {
                        assert_eq!(shape.nearest(ray, t_max), *expected, "{ray:?}");
                        assert_eq!(shape.any(ray, t_max), expected.is_some(), "{ray:?}");
                    }
                }
            }
        }
    }
}

fn first_of_all(mesh: &Mesh, ray: &Ray, t_max: f64) -> Option<Crossing> {
    let shear = Shear::new(ray);
    let mut first: Option<Crossing> = None;
    for triangle in 0..mesh.triangle_count() {
        if let Some(met) = shear.meet(&mesh.corners(triangle))
            && met.t > 0.0
            && met.t < first.map_or(t_max, |first| first.t)
        {
            first = Some(Crossing { t: met.t, part: triangle as u32 });
        }
    }
    first
}

/// A field of whole heights, twice: each triangle is there two times.
fn heights(side: u32) -> Arc<Mesh> {
    let mut rng = Rng::with_seed(4);
    let mut positions = Vec::new();
    for y in 0..side {
        for x in 0..side {
            positions.push([f64::from(x), f64::from(y), f64::from(rng.u8(0..5))].map(|c| c / 8.0));
        }
    }
    let mut triangles = Vec::new();
    for _ in 0..2 {
        for a in (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| y * side + x)) {
            triangles.extend([[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]);
        }
    }
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// All that a mesh of many triangles keeps, the scene's own part included.
#[test]
fn memory_is_small() {
    for (scale, most) in [(1.0, 100), (0.1, 145)] {
        let side = 220_u32;
        let height = |x: u32, y: u32| f64::from(x * y % 7);
        let positions = (0..side)
            .flat_map(|y| (0..side).map(move |x| [f64::from(x), f64::from(y), height(x, y)]))
            .map(|p| p.map(|c| c * scale))
            .collect();
        let corners = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| y * side + x));
        let triangles =
            corners.flat_map(|a| [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]).collect();
        let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
        let shape = Facets::new(&mesh, &KernelSettings::default());
        let bytes = (shape.bytes() + mesh.bytes()) / mesh.triangle_count();
        assert!(bytes <= most, "{bytes} bytes a triangle");
    }
}
