//! Triangles and meshes: shared edges and vertices, small ones, needles, far
//! from the origin, without area. What is decided is compared with whole numbers.

use super::asked::{Asked, GREY, assert_near, direction, ray, signs_of_zeros};
use super::films::{bits, film};
use fastrand::Rng;
use lancer_kernel::Which;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Light, Mesh, Scene, Shape, Surface};
use std::sync::Arc;

fn mesh(corners: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Asked {
    let mesh = Mesh::new(corners, triangles).expect("it has an area");
    Asked::one(Shape::mesh(Arc::new(mesh), GREY))
}

type Whole = [i128; 3];

fn minus(a: Whole, b: Whole) -> Whole {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Six times the signed volume of the tetrahedron with these edges.
fn volume(a: Whole, b: Whole, c: Whole) -> i128 {
    let cross = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
    a[0] * cross(1, 2) + a[1] * cross(2, 0) + a[2] * cross(0, 1)
}

/// How often a ray meets a mesh, asked in each way for some of the cases.
fn count(asked: &Asked, ray: &Ray, case: usize) -> usize {
    if case.is_multiple_of(50) {
        asked.line(ray).len()
    } else {
        asked.prepared().all(ray, (f64::NEG_INFINITY, f64::INFINITY), Which::All).len()
    }
}

/// Two triangles with an edge that both are on different sides of, as the eye sees
/// it, and rays at points of the edge: exactly, in whole numbers, or rounded. Each
/// meets one of them.
fn check_edges(single: bool, rays: usize) {
    let mut rng = Rng::with_seed(1);
    let mut done = 0;
    while done < rays {
        let mut whole = |n: i32| i128::from(rng.i32(-n..=n));
        // So few digits that single precision holds them, or many.
        let size = if single { 1 << 10 } else { 1 << 26 };
        let mut point = || [whole(size), whole(size), whole(size)];
        let (a, c, d, eye) = (point(), point(), point(), point());
        let edge = point();
        let b: Whole = std::array::from_fn(|i| a[i] + 16 * edge[i]);
        let sides = [c, d].map(|p| volume(minus(a, eye), minus(b, eye), minus(p, eye)));
        if sides[0].signum() * sides[1].signum() != -1 {
            continue;
        }
        // In any order, each from any of its corners.
        let turn = |[p, q, r]: [u32; 3], k: usize| [[p, q, r], [q, r, p], [r, p, q]][k % 3];
        let first = turn(if rng.bool() { [0, 1, 2] } else { [0, 2, 1] }, rng.usize(0..3));
        let second = turn(if rng.bool() { [0, 1, 3] } else { [3, 1, 0] }, rng.usize(0..3));
        let corners = [a, b, c, d].map(|p| p.map(|c| c as f64)).to_vec();
        let both = mesh(corners, vec![first, second]);
        for case in 0..20 {
            let steps = if case < 10 { 1 + rng.i128(0..15) } else { 0 };
            let share = rng.f64();
            let target: [f64; 3] = std::array::from_fn(|i| {
                let exact = a[i] + steps * edge[i];
                if steps > 0 { exact as f64 } else { a[i] as f64 + 16.0 * edge[i] as f64 * share }
            });
            let origin = eye.map(|c| c as f64);
            let ray = ray(origin, std::array::from_fn(|i| target[i] - origin[i]));
            assert_eq!(count(&both, &ray, done), 1, "{a:?} {b:?} {c:?} {d:?} {ray:?}");
            done += 1;
        }
    }
}

#[test]
fn t1_shared_edges() {
    check_edges(false, 40_000);
    check_edges(true, 15_000);
}

/// Triangles all around a vertex, from which the eye sees every one of them from the
/// same side: a ray at the vertex meets one.
#[test]
fn t1_fans() {
    let mut rng = Rng::with_seed(2);
    for case in 0..2000 {
        let spokes = rng.u32(3..12);
        let mut corners = vec![[3.0, -7.0, 5.0]];
        for k in 0..spokes {
            let (s, c) = lancer_math::sin_cos_degrees(360.0 / f64::from(spokes) * f64::from(k));
            let reach = 0.1 + rng.f64();
            corners.push([3.0 + reach * c, -7.0 + reach * s, 5.0 + 0.02 * rng.f64()]);
        }
        let triangles = (0..spokes).map(|k| [0, 1 + k, 1 + (k + 1) % spokes]).collect();
        let fan = mesh(corners, triangles);
        for _ in 0..10 {
            let away = Vector::from_fn(|_, _| f64::from(rng.i32(-5..=5)));
            let away = Vector::new(away.x, away.y, 80.0);
            let ray = Ray::new(Point::new(3.0, -7.0, 5.0) + away, -away);
            assert_eq!(count(&fan, &ray, case), 1, "{case}: {ray:?}");
            assert_near(fan.prepared().nearest(&ray, 9.0).map(|hit| hit.t), 1.0, 1e-15);
        }
    }
}

/// A field of whole heights, seen along its z at vertices, at middles of edges and
/// diagonals and elsewhere: each ray meets one triangle, with all signs of zero.
#[test]
fn t1_height_field() {
    const SIDE: u32 = 24;
    let mut rng = Rng::with_seed(3);
    let mut corners = Vec::new();
    for y in 0..=SIDE {
        for x in 0..=SIDE {
            corners.push([f64::from(x), f64::from(y), f64::from(rng.i32(-9..=9))]);
        }
    }
    let at = |x: u32, y: u32| y * (SIDE + 1) + x;
    let mut triangles = Vec::new();
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
        triangles.extend(if rng.bool() { [[a, b, c], [a, c, d]] } else { [[b, c, d], [d, a, b]] });
    }
    let field = mesh(corners, triangles);
    for (x, y) in (1..8 * SIDE).flat_map(|y| (1..8 * SIDE).map(move |x| (x, y))) {
        let origin = [f64::from(x) / 8.0, f64::from(y) / 8.0, 50.0];
        let down = ray(origin, [0.0, -0.0, -1.0]);
        assert_eq!(count(&field, &down, (x * y) as usize), 1, "{origin:?}");
    }
    for d in signs_of_zeros([0.0, 0.0, -1.0]) {
        assert_eq!(field.line(&ray([5.0, 7.0, 50.0], d)).len(), 1, "{d:?}");
    }
}

/// No threshold: triangles and meshes of any size are met.
#[test]
fn t2_small_ones() {
    for s in [1e-2, 1e-3, 2e-4, 1e-5, 1e-8, 1e-20, 1e-60, 1e60] {
        let corners = [[0.0; 3], [s, 0.0, 0.0], [0.0, s, 0.0]];
        let eye = ray([s / 3.0, s / 3.0, -1.0], [0.0, 0.0, 1.0]);
        let by_itself = Asked::one(Shape::triangle(corners, GREY));
        assert_eq!(by_itself.ts(&eye), [1.0], "{s}");
        assert_eq!(mesh(corners.to_vec(), vec![[0, 1, 2]]).ts(&eye), [1.0], "{s}");
    }
}

/// Twelve faces around a cube and a bit, with a vertex at a time moved inwards.
fn bumpy(size: f64) -> Mesh {
    let mut rng = Rng::with_seed(22);
    let mut corners = Vec::new();
    for bits in 0..8_u32 {
        corners.push(std::array::from_fn(|i| {
            let side = if bits >> i & 1 == 1 { 1.0 } else { -1.0 };
            size * side * (0.6 + 0.4 * rng.f64())
        }));
    }
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, c, b], [a, d, c]]).collect();
    Mesh::new(corners, triangles).expect("it has areas")
}

fn picture_of(mesh: Mesh, surface: Surface, size: f64) -> Vec<[u32; 3]> {
    let scene = Scene::builder()
        .camera(Camera::new([3.0 * size, 1.0 * size, 2.0 * size], [0.0; 3], 1.2 * size, [48, 48]))
        .light(Light::sun([-0.2, 0.3, -1.0], 0.8))
        .light(Light::sun([-1.0, 0.1, 0.2], 0.4))
        .shape(Shape::mesh(Arc::new(mesh), surface));
    bits(&film(&scene.build().expect("valid"), "whitted"))
}

/// A picture of a mesh that is 2^20 times smaller, or larger, has the same bits.
#[test]
fn t2_small_meshes_look_the_same() {
    for smooth in [false, true] {
        let picture = |exponent| {
            let size = libm::scalbn(1.0, exponent);
            let mesh = bumpy(size);
            let mesh = if smooth { mesh.with_smooth_normals() } else { mesh };
            picture_of(mesh, GREY.gloss(0.3).expect("in range"), size)
        };
        let expected = picture(0);
        assert!(expected.iter().filter(|pixel| pixel[0] != 0).count() > 300);
        for exponent in [-100, -20, 20, 100] {
            assert_eq!(picture(exponent), expected, "{exponent}");
        }
    }
}

/// Needles seen at half a degree, from up to 600 lengths, in whole numbers of 2^-16:
/// what is decided is what signed volumes say, and where is their quotient.
#[test]
fn t3_needles() {
    for single in [false, true] {
        let mut rng = Rng::with_seed(4);
        let (mut met, mut clear) = (0, 0);
        for case in 0..6000 {
            let grid = if single { 1024.0 } else { 65_536.0 };
            let whole =
                |v: Vector| -> Whole { [v.x, v.y, v.z].map(|c| (c * grid).round() as i128) };
            // Edges of 11.2, 9.7 and 1.6 to within the grid.
            let (along, other) = (direction(&mut rng), direction(&mut rng));
            let across = (other - along * other.dot(&along)).normalize();
            let x = (11.2 * 11.2 + 9.7 * 9.7 - 1.6 * 1.6) / (2.0 * 11.2);
            let y = (9.7_f64 * 9.7 - x * x).sqrt();
            let place = direction(&mut rng) * 5.0;
            let corners = [Vector::zeros(), along * 11.2, along * x + across * y];
            let corners = corners.map(|corner| whole(corner + place));
            // At it, or beside it, by less than half of its width.
            let share = [rng.f64() * 1.2 - 0.1, rng.f64() * 0.6 - 0.1];
            let target = place + along * (11.2 * share[0]) + across * (y * share[1]);
            let (s, c) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
            let flat = along * c + across * s;
            let up = along.cross(&across) * 0.009_076;
            let eye = whole(target - (flat + up) * (600.0 * rng.f64()));
            let way = minus(whole(target), eye);
            let [a, b, c] = corners.map(|corner| minus(corner, eye));
            // All of one sign: it is met.
            let volumes = [volume(way, b, c), volume(way, c, a), volume(way, a, b)];
            let sum: i128 = volumes.iter().sum();
            let inside = volumes.iter().all(|v| *v > 0) || volumes.iter().all(|v| *v < 0);
            let squared = |v: Whole| v.iter().map(|c| (c * c) as f64).sum::<f64>();
            let scale = squared(way).sqrt() * squared(a).max(squared(b)).max(squared(c));
            let margin = volumes.iter().map(|v| (*v as f64).abs()).fold(f64::MAX, f64::min) / scale;
            if margin <= 1e-12 || sum == 0 {
                continue;
            }
            clear += 1;
            let float = |v: Whole| v.map(|c| c as f64 / grid);
            let needle = Asked::one(Shape::triangle(corners.map(float), GREY));
            let in_mesh = mesh(corners.map(float).to_vec(), vec![[0, 1, 2]]);
            let ray = ray(float(eye), float(way));
            let found = needle.ts(&ray);
            assert_eq!(in_mesh.ts(&ray), found, "{case}");
            assert_eq!(found.len(), usize::from(inside), "{case}: {margin:e} {ray:?}");
            if let [t] = found[..] {
                // With n across the plane, n . a over n . way.
                let (u, v) = (minus(b, a), minus(c, a));
                let expected = volume(a, u, v) as f64 / volume(way, u, v) as f64;
                assert_near(Some(t), expected, 1e-12 * expected.abs());
                let depths = [a, b, c]
                    .map(|p| (0..3).map(|i| p[i] * way[i]).sum::<i128>() as f64 / squared(way));
                let [least, most] = [f64::min, f64::max].map(|f| depths.into_iter().reduce(f));
                let slack = 1e-13 * depths.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
                let range = least.expect("three") - slack..=most.expect("three") + slack;
                assert!(range.contains(&t), "{case}: {t} {range:?}");
                met += 1;
            }
        }
        assert!(met > 500 && clear > 4000, "{met} of {clear}");
    }
}

/// No digit of a coordinate is lost, in a mesh either.
#[test]
fn t4_far_from_the_origin() {
    for x in [1e6 + 0.3, 16_777_217.0, 1e8 + 0.3, 1e15 + 0.3] {
        let corners = [[x, -1.0, -1.0], [x, 2.0, 0.3], [x, 0.1, 1.7]];
        let eye = ray([0.0; 3], [1.0, 0.0, 0.0]);
        assert_eq!(Asked::one(Shape::triangle(corners, GREY)).ts(&eye), [x]);
        let in_mesh = mesh(corners.to_vec(), vec![[0, 1, 2]]);
        assert_eq!(in_mesh.ts(&eye), [x]);
        assert_eq!(in_mesh.point(&eye).expect("it is ahead").point.x, x);
    }
}

/// Triangles without area are refused by themselves and dropped from meshes: the
/// picture is that without them.
#[test]
fn t5_without_area() {
    let none = [
        [[0.0; 3]; 3],
        [[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]],
        [[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]],
        [[0.1, 0.2, 0.3], [0.1, 0.2, 0.3], [0.1, 0.2, 0.3]],
    ];
    for corners in none {
        assert!(Shape::triangle(corners, GREY).is_err(), "{corners:?}");
        assert!(Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).is_err(), "{corners:?}");
    }
    let clean = bumpy(1.0);
    let corner = |k: usize, i: usize| <[f64; 3]>::from(clean.corner(k, i));
    let mut corners: Vec<[f64; 3]> =
        (0..clean.triangle_count()).flat_map(|k| [0, 1, 2].map(|i| corner(k, i))).collect();
    let mut triangles: Vec<[u32; 3]> =
        (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let expected =
        picture_of(Mesh::new(corners.clone(), triangles.clone()).expect("valid"), GREY, 1.0);
    for (k, degenerate) in none.iter().enumerate() {
        let first = corners.len() as u32;
        corners.extend(degenerate.map(|p| p.map(|c| 1.5 * c)));
        triangles.insert(k * 3, [first, first + 1, first + 2]);
    }
    let dirty = Mesh::new(corners, triangles).expect("valid");
    assert_eq!(dirty.dropped(), none.len());
    assert_eq!(picture_of(dirty, GREY, 1.0), expected);
}

/// Where opposite normals at the ends of an edge cancel, it is the facet's that is
/// shaded with; and whatever the normals, it is one of length 1 on the ray's side.
#[test]
fn t5_normals_that_cancel() {
    let corners = vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for normals in [
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        vec![[0.0; 3]; 3],
    ] {
        let flat = Mesh::new(corners.clone(), vec![[0, 1, 2]]).expect("valid");
        let mesh = flat.with_normals(normals, None).expect("valid");
        let asked = Asked::one(Shape::mesh(Arc::new(mesh), GREY));
        for (x, y) in [(0.0, 0.0), (0.0, 0.5), (0.25, 0.125), (0.0, 0.999)] {
            let point = asked.point(&ray([x, y, 3.0], [0.0, 0.0, -1.0])).expect("it is there");
            assert!((point.shading.norm() - 1.0).abs() < 1e-15, "{}", point.shading);
            assert!(point.shading.dot(&point.normal) > 0.0, "{}", point.shading);
        }
        let middle = asked.point(&ray([0.0, 0.0, 3.0], [0.0, 0.0, -1.0])).expect("it is there");
        assert_eq!(middle.shading, middle.normal);
    }
}

/// A smooth mirror seen at a flat angle: reflections that would go below the facet go
/// up from it, so that it never shows what is behind it.
#[test]
fn t5_smooth_mirrors_do_not_look_through_themselves() {
    let corners = vec![[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [9.0, 9.0, 0.0], [-9.0, 9.0, 0.0]];
    let flat = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("valid");
    let outward = [[-1.0, -1.0, 0.3], [1.0, -1.0, 0.3], [1.0, 1.0, 0.3], [-1.0, 1.0, 0.3]];
    let smooth = flat.with_normals(outward.to_vec(), None).expect("valid");
    let scene = |below: f64| {
        let lamp = GREY.emission([below; 3]).expect("in range");
        Scene::builder()
            .camera(Camera::new([0.0, -8.0, 0.5], [0.0; 3], 1.5, [64, 64]))
            .background(Ok(lancer_scene::Spectrum::new([0.5; 3]).expect("in range")))
            .shape(Shape::mesh(Arc::new(smooth.clone()), GREY.gloss(1.0)))
            // All that is below the mirror shines, or does not.
            .shape(Shape::rectangle(
                [-9.0, -9.0, -1e-3],
                [[18.0, 0.0, 0.0], [0.0, 18.0, 0.0]],
                lamp,
            ))
            .build()
            .expect("valid")
    };
    let (dark, bright) = (film(&scene(0.0), "whitted"), film(&scene(7.0), "whitted"));
    assert_eq!(bits(&dark), bits(&bright));
    assert!(dark.pixels().iter().flatten().all(|v| v.is_finite()));
}
