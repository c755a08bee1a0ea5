//! What must hold of any answer: that a root is one, that precision does not matter,
//! that a solid is inside between where it is entered and left.

use fastrand::Rng;
use lancer_math::{Placement, Vector};
use lancer_oracle::{Line, Number, Passage, Place, Polynomial, Space, Triple, crossings, inside};
use lancer_scene::{Colour, Geometry, Mesh, Shape, Surface};
use std::sync::Arc;

const BITS: usize = 300;

fn some(rng: &mut Rng, size: f64) -> [f64; 3] {
    [(); 3].map(|()| (rng.f64() - 0.5) * size)
}

/// The world and a space in it, with the places of their origins.
fn spaces(rng: &mut Rng) -> Vec<(Space, Triple)> {
    let turn = Placement::rotate(Vector::from(some(rng, 2.0)), 77.0).expect("an axis");
    let mirror = Placement::scale(Vector::new(2.0, -0.5, 1.5)).expect("not flat");
    let away = Placement::translate(Vector::new(0.1, 3.0, -1.0));
    let world = Space::world();
    let nested = world.inside(&away).inside(&mirror).inside(&turn);
    vec![(world, Triple::zero()), (nested, [0.1, 3.0, -1.0].into())]
}

/// A line that comes near to a point.
fn aimed(rng: &mut Rng, at: &Triple) -> Line {
    let origin = Triple::from(some(rng, 10.0));
    let target = at + &some(rng, 2.0).into();
    Line { direction: &target - &origin, origin }
}

/// Closed shapes within about 2 of the origin.
fn solids() -> Vec<Geometry> {
    let red = || Surface::new(Colour::RED);
    let corners = [[-1.1, -0.3, -1.0], [1.3, 1.0, 1.2], [0.3, 0.7, -0.1], [0.2, -0.9, 1.9]];
    let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mesh = Mesh::new(corners.to_vec(), faces).expect("a valid mesh");
    assert!(mesh.is_closed());
    let shapes = [
        Shape::sphere([0.1, 0.2, 0.3], 1.3, red()),
        Shape::cuboid([-1.1, -0.3, -1.0], [1.3, 1.0, 1.2], red()),
        Shape::tetrahedron(corners, red()),
        Shape::cylinder([-1.1, -0.3, -1.0], [1.3, 1.0, 1.2], 0.7, red()),
        Shape::frustum(([-1.1, -0.3, -1.0], 0.7), ([1.3, 1.0, 1.2], 0.2), red()),
        Shape::cone([-1.1, -0.3, -1.0], [1.3, 1.0, 1.2], 0.7, red()),
        Shape::torus([0.1, 0.2, 0.3], [0.3, 0.1, -1.2], [1.1, 0.5], red()),
        Shape::plane([0.1, 0.2, 0.3], [0.3, 0.1, -1.2], red()),
        Shape::mesh(Arc::new(mesh), red()),
    ];
    shapes.into_iter().map(|shape| shape.expect("valid").geometry).collect()
}

#[test]
fn solids_are_inside_between_where_they_are_entered_and_left() {
    let mut rng = Rng::with_seed(1);
    let half = Number::power_of_two(-1);
    for (space, middle) in spaces(&mut rng) {
        for solid in solids() {
            let mut met = 0;
            for _ in 0..60 {
                let line = aimed(&mut rng, &middle);
                let found = crossings(&solid, &space, &line, BITS);
                assert!(found.margin > 0.0, "{solid:?}");
                let mut edges = vec![Number::from(-1000)];
                edges.extend(found.list.iter().map(|crossing| crossing.t.clone()));
                edges.push(Number::from(1000));
                let places: Vec<Place> = edges
                    .windows(2)
                    .map(|pair| {
                        let between = line.at(&((&pair[0] + &pair[1]) * &half));
                        inside(&solid, &space, &between).expect("it has an inside")
                    })
                    .collect();
                for (crossing, sides) in found.list.iter().zip(places.windows(2)) {
                    let expected = match sides {
                        [Place::Outside, Place::Inside] => Passage::Enters,
                        [Place::Inside, Place::Outside] => Passage::Leaves,
                        _ => panic!("{sides:?} at {:?} of {solid:?}", crossing.t),
                    };
                    assert_eq!(crossing.passage, expected, "{solid:?}");
                    let along = crossing.normal.dot(&line.direction).signum();
                    assert_eq!(along == -1, expected == Passage::Enters, "{solid:?}");
                    met += 1;
                }
            }
            assert!(met > 20, "{solid:?} is hardly met");
        }
    }
}

#[test]
fn the_precision_makes_no_difference_to_what_is_met() {
    let mut rng = Rng::with_seed(2);
    for (space, middle) in spaces(&mut rng) {
        for solid in solids() {
            for _ in 0..10 {
                let line = aimed(&mut rng, &middle);
                let [rough, fine] =
                    [120, 700].map(|bits| crossings(&solid, &space, &line, bits).list);
                assert_eq!(rough.len(), fine.len());
                for (a, b) in rough.iter().zip(&fine) {
                    let slack = b.t.abs() * Number::power_of_two(-118);
                    assert!((&a.t - &b.t).abs() <= slack, "{solid:?}");
                    assert!((&a.normal - &b.normal).norm(64).to_f64() < 1e-30);
                    assert_eq!((a.passage, a.face), (b.passage, b.face));
                }
            }
        }
    }
}

/// The distance of each point from its surface, by what the surface is.
#[test]
fn points_are_on_their_surfaces() {
    let mut rng = Rng::with_seed(3);
    let world = Space::world();
    let (centre, axis) = (Triple::from([0.1, 0.2, 0.3]), Triple::from([0.3, 0.1, -1.2]));
    for solid in solids() {
        for _ in 0..40 {
            let line =
                Line { origin: some(&mut rng, 8.0).into(), direction: some(&mut rng, 2.0).into() };
            for crossing in crossings(&solid, &world, &line, BITS).list {
                let p = &line.at(&crossing.t) - &centre;
                let off = match &solid {
                    Geometry::Sphere(sphere) => p.norm(400) - Number::from(sphere.radius.get()),
                    Geometry::Plane(_) => p.dot(&axis),
                    Geometry::Torus(torus) => {
                        let height = p.dot(&axis.unit(400));
                        let around = (p.norm_squared() - height.squared()).root(400);
                        let outward = around - Number::from(torus.ring());
                        let away = (outward.squared() + height.squared()).root(400);
                        away - Number::from(torus.tube())
                    }
                    Geometry::Cone(cone) if crossing.face == 0 => {
                        let p = &line.at(&crossing.t) - &cone.base().into();
                        let axis = &Triple::from(cone.top()) - &cone.base().into();
                        let height = p.dot(&axis.unit(400));
                        let around = (p.norm_squared() - height.squared()).root(400);
                        let part = height.over(&axis.norm(400), 400);
                        let (low, high) =
                            (Number::from(cone.base_radius()), Number::from(cone.top_radius()));
                        around - (&low + (high - &low) * part)
                    }
                    _ => continue,
                };
                assert!(off.to_f64().abs() < 1e-85, "{off:?} of {solid:?}");
            }
        }
    }
}

/// Products of factors whose roots are known.
#[test]
fn sturm_finds_each_root_once() {
    let factor = |root: f64| Polynomial::new(vec![Number::from(-root), Number::one()]);
    let no_root = Polynomial::new(vec![Number::from(0.25), Number::zero(), Number::one()]);
    for (roots, multiple) in [
        (vec![-3.0, 0.0, 1e-9, 2.0], vec![false; 4]),
        (vec![1.0, 1.0, 5.0, 7.0], vec![true, false, false]),
        (vec![-2.0, -2.0, -2.0, 0.1], vec![true, false]),
        (vec![1.0, 1.0, 4.0, 4.0], vec![true, true]),
        (vec![3.0; 4], vec![true]),
        (vec![1e-200, 1e200], vec![false, false]),
    ] {
        for with in [false, true] {
            let mut p = roots.iter().fold(factor(0.5).derivative(), |p, r| p.times(&factor(*r)));
            if with {
                p = p.times(&no_root).scaled(&Number::from(-3.5));
            }
            let found = p.roots(BITS);
            let mut distinct = roots.clone();
            distinct.dedup();
            assert_eq!(found.len(), distinct.len(), "{roots:?}");
            for ((found, root), multiple) in found.iter().zip(&distinct).zip(&multiple) {
                assert_eq!(found.place.to_f64(), *root);
                assert_eq!(found.multiple, *multiple, "{roots:?}");
                let count = roots.iter().filter(|r| *r == root).count();
                assert_eq!(found.signs[0] == found.signs[1], count % 2 == 0, "{roots:?}");
            }
        }
    }
}

/// A triangle's decision is that of whole numbers: volumes of 64-bit integers.
#[test]
fn triangles_are_decided_as_by_whole_numbers() {
    let mut rng = Rng::with_seed(4);
    let mut met = 0;
    for _ in 0..3000 {
        let mut point = || [(); 3].map(|()| i64::from(rng.i32(-4..=4)));
        let (corners, o, d) = ([point(), point(), point()], point(), point());
        let as_f64 = |p: [i64; 3]| p.map(|c| c as f64);
        let Ok(shape) = Shape::triangle(corners.map(as_f64), Surface::new(Colour::RED)) else {
            continue;
        };
        if d == [0; 3] {
            continue;
        }
        let line = Line { origin: as_f64(o).into(), direction: as_f64(d).into() };
        let found = crossings(&shape.geometry, &Space::world(), &line, 64);
        let [a, b, c] = corners.map(|p| [0, 1, 2].map(|k| p[k] - o[k]));
        let det = |u: [i64; 3], v: [i64; 3], w: [i64; 3]| {
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                + u[2] * (v[0] * w[1] - v[1] * w[0])
        };
        let volumes = [det(d, b, c), det(d, c, a), det(d, a, b)];
        let sum: i64 = volumes.iter().sum();
        let expected = sum != 0 && volumes.iter().all(|v| v * sum >= 0);
        assert_eq!(found.list.len(), usize::from(expected));
        if expected {
            assert_eq!(found.list[0].t.to_f64(), det(a, b, c) as f64 / sum as f64);
            assert_eq!(found.margin == 0.0, volumes.contains(&0));
            met += 1;
        }
    }
    assert!(met > 100, "{met}");
}
