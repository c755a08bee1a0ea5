//! Groups in groups against the same written out by hand: each shape as a scene of
//! its own, asked with the ray that the product of its placements brings it.

use fastrand::Rng;
use lancer_kernel::lanes::Width;
use lancer_kernel::{Culling, Hit, KernelSettings, Prepared, Which};
use lancer_math::{Placement, Point, Ray, Vector, unit};
use lancer_scene::{
    Camera, Colour, CustomShape, Group, Mesh, Placed, Scene, SceneBuilder, Shape, Surface,
};
use std::sync::Arc;

/// A shape where it stands.
struct Item {
    alone: Arc<Prepared>,
    placement: Placement,
    surface: Surface,
    /// Its number in the description.
    shape: u32,
}

/// All items in the order that is documented.
#[derive(Default)]
struct Flat {
    items: Vec<Item>,
    /// Groups that were met, and the numbers of their first shapes.
    known: Vec<(*const Group, u32)>,
    shapes: u32,
}

fn alone(shape: &Shape) -> Arc<Prepared> {
    let scene = scene_builder().shape(Ok(shape.clone())).build().expect("valid");
    Arc::new(Prepared::new(&scene))
}

fn scene_builder() -> SceneBuilder {
    Scene::builder().camera(Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]))
}

impl Flat {
    fn new(scene: &Scene) -> Self {
        let mut flat = Self::default();
        flat.put(&scene.shapes, 0, &Placement::IDENTITY);
        flat.shapes = scene.shapes.len() as u32;
        flat.groups(&scene.groups, &Placement::IDENTITY);
        flat
    }

    fn put(&mut self, shapes: &[Shape], first: u32, placement: &Placement) {
        for (shape, number) in shapes.iter().zip(first..) {
            let (surface, placement) = (shape.surface, *placement);
            self.items.push(Item { alone: alone(shape), placement, surface, shape: number });
        }
    }

    fn groups(&mut self, groups: &[Placed], outer: &Placement) {
        for placed in groups {
            let placement = placed.placement.then(outer);
            let address = Arc::as_ptr(&placed.group);
            let known = self.known.iter().find(|(known, _)| *known == address);
            let first = known.map_or(self.shapes, |(_, first)| *first);
            if first == self.shapes && known.is_none() {
                self.known.push((address, first));
                self.shapes += placed.group.shapes().len() as u32;
            }
            self.put(placed.group.shapes(), first, &placement);
            self.groups(placed.group.groups(), &placement);
        }
    }

    fn asked(&self, which: Which) -> impl Iterator<Item = (u32, &Item)> {
        (0..).zip(&self.items).filter(move |(_, item)| match which {
            Which::All => true,
            Which::Opaque => !item.surface.is_transparent(),
            Which::Transparent => item.surface.is_transparent(),
        })
    }

    fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        for (number, item) in self.asked(Which::All) {
            if let Some(hit) = item.alone.nearest(&item.local(ray), t_max)
                && best.is_none_or(|best| hit.t < best.t)
            {
                best = Some(Hit { item: number, ..hit });
            }
        }
        best
    }

    fn all(&self, ray: &Ray, stretch: (f64, f64), which: Which) -> Vec<Hit> {
        let mut hits = Vec::new();
        for (number, item) in self.asked(which) {
            let own = item.alone.all(&item.local(ray), stretch, which);
            hits.extend(own.into_iter().map(|hit| Hit { item: number, ..hit }));
        }
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then((a.item, a.part).cmp(&(b.item, b.part))));
        hits
    }
}

impl Item {
    fn local(&self, ray: &Ray) -> Ray {
        let origin = self.placement.local_point(&ray.origin);
        Ray::new(origin, self.placement.local_vector(&ray.direction))
    }
}

/// A slab between z = -h and h, as a user would write it.
#[derive(Debug)]
struct Pane;

impl CustomShape for Pane {
    fn name(&self) -> &str {
        "pane"
    }

    fn nearest(&self, ray: &Ray) -> Option<f64> {
        Some(-ray.origin.z / ray.direction.z).filter(|t| *t > 0.0)
    }

    fn normal(&self, _point: &Point) -> Vector {
        Vector::z()
    }
}

/// Whole numbers and halves, so that much coincides; or any.
struct Choice {
    rng: Rng,
    whole: bool,
}

impl Choice {
    fn number(&mut self, size: i32) -> f64 {
        match self.whole {
            true => f64::from(self.rng.i32(-2 * size..=2 * size)) / 2.0,
            false => f64::from(size) * (2.0 * self.rng.f64() - 1.0),
        }
    }

    fn xyz(&mut self, size: i32) -> [f64; 3] {
        std::array::from_fn(|_| self.number(size))
    }

    fn surface(&mut self) -> Surface {
        let (_, colour) = Colour::NAMED[self.rng.usize(0..Colour::NAMED.len())];
        let surface = match self.rng.u8(0..4) {
            0 => Surface::glass(1.5).expect("in range"),
            1 => Surface::glass(1.3).expect("in range").priority(self.rng.i32(-1..2)),
            _ => Surface::new(colour),
        };
        match self.rng.u8(0..3) {
            0 => surface.checker(colour.complement()),
            1 if self.rng.bool() => surface.thin(),
            _ => surface,
        }
    }

    fn shape(&mut self) -> Shape {
        loop {
            let surface = self.surface();
            let (a, b, c, d) = (self.xyz(2), self.xyz(2), self.xyz(2), self.xyz(2));
            let size = 0.5 + self.number(1).abs();
            let shape = match self.rng.u8(0..24) {
                0 => Shape::plane(a, b, surface),
                1 => Shape::disc(a, b, size, surface),
                2 => Shape::rectangle(a, [b, c], surface),
                3 => Shape::triangle([a, b, c], surface),
                4..8 => Shape::cuboid(a, b, surface),
                8 => Shape::tetrahedron([a, b, c, d], surface),
                9 => Shape::cylinder(a, b, size, surface),
                10 => Shape::frustum((a, size), (b, 0.5), surface),
                11 => Shape::torus(a, b, [size, 0.4 * size], surface),
                12 | 13 => Shape::mesh(octahedron(), surface),
                14 if self.rng.u8(0..4) == 0 => Shape::custom(Pane, surface),
                _ => Shape::sphere(a, size, surface),
            };
            if let Ok(shape) = shape {
                return shape;
            }
        }
    }

    fn placement(&mut self) -> Placement {
        let step = Placement::translate(Vector::from(self.xyz(3)));
        let turned = match self.rng.u8(0..7) {
            0 => Some(Placement::IDENTITY),
            1 => Placement::rotate(Vector::from(self.xyz(1)), 90.0 * self.number(2)),
            2 => Placement::scale(Vector::new(-1.0, 1.0, 1.0)),
            3 => Placement::scale(Vector::from(self.xyz(2))),
            4 => {
                let [x, y, z] = self.xyz(1);
                let shear = [[1.0, x, y, 0.0], [0.0, 1.0, z, 0.0], [0.0, 0.0, 1.0, 0.5]];
                Placement::from_rows(shear)
            }
            5 => {
                let rows = [self.xyz(2), self.xyz(2), self.xyz(2)];
                Placement::from_rows(rows.map(|[x, y, z]| [x, y, z, 1.0]))
            }
            _ => None,
        };
        match turned {
            Some(turned) if self.rng.bool() => turned.then(&step),
            Some(turned) => turned,
            None => step,
        }
    }

    fn placed(&mut self, below: &[Arc<Group>], most: usize) -> Vec<Placed> {
        let mut placed = Vec::new();
        for _ in 0..self.rng.usize(0..=most).min(4 * below.len()) {
            let group = Arc::clone(&below[self.rng.usize(0..below.len())]);
            let placement = self.placement();
            placed.push(Placed { placement, group });
            if self.rng.u8(0..5) == 0 {
                // Twice the same.
                placed.push(placed[placed.len() - 1].clone());
            }
        }
        placed
    }
}

fn octahedron() -> Arc<Mesh> {
    let positions = (0..6).map(|i| {
        let mut corner = [0.0; 3];
        corner[i / 2] = if i % 2 == 0 { 1.0 } else { -1.0 };
        corner
    });
    let mut triangles = Vec::new();
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                let turn = (x + y + z) % 2 == 0;
                triangles.push(if turn { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    Arc::new(Mesh::new(positions.collect(), triangles).expect("valid"))
}

/// Groups of groups of groups, most of which stand in several places.
fn scene(seed: u64) -> Scene {
    let mut choice = Choice { rng: Rng::with_seed(seed), whole: seed.is_multiple_of(2) };
    let mut groups: Vec<Arc<Group>> = Vec::new();
    for _ in 0..choice.rng.usize(0..7) {
        let shapes = (0..choice.rng.usize(0..4)).map(|_| choice.shape()).collect();
        let placed = choice.placed(&groups, 3);
        if let Ok(group) = Group::new(None, shapes, placed)
            && group.shape_count() < 100
        {
            groups.push(Arc::new(group));
        }
    }
    let mut builder = scene_builder();
    for _ in 0..choice.rng.usize(0..20) {
        builder = builder.shape(Ok(choice.shape()));
    }
    for placed in choice.placed(&groups, 4) {
        builder = builder.group(placed.placement, placed.group);
    }
    builder.build().expect("valid")
}

fn ray(choice: &mut Choice) -> Ray {
    let far = if choice.rng.u8(0..8) == 0 { 1e6 } else { 1.0 };
    let target = Point::from(choice.xyz(3));
    let mut direction = Vector::from(choice.xyz(2));
    if choice.rng.u8(0..4) == 0 {
        direction[choice.rng.usize(0..3)] = 0.0;
    }
    Ray::new(target - direction * (4.0 * far * choice.rng.f64()).round(), direction)
}

/// Each bit of every answer, with every width.
#[test]
fn groups_are_met_as_if_they_were_written_out() {
    let cases = std::env::var("LANCER_CASES").map_or(300, |n| n.parse().expect("a number"));
    let (mut most, mut hits, mut deepest) = (0, 0, 0);
    for case in 0..cases {
        let scene = scene(case);
        let flat = Flat::new(&scene);
        assert_eq!(flat.items.len() as u64, scene.shape_count());
        most = most.max(flat.items.len());
        deepest = deepest.max(depth(&scene.groups));
        for width in Width::available() {
            let settings = KernelSettings { lanes: width, culling: Culling::ALL };
            let prepared = Prepared::with(&scene, &settings);
            let mut choice = Choice { rng: Rng::with_seed(!case), whole: case.is_multiple_of(2) };
            for _ in 0..40 {
                let ray = ray(&mut choice);
                let t_max = if choice.rng.bool() { f64::INFINITY } else { choice.number(9).abs() };
                let note = format!("case {case}, {}, {ray:?} to {t_max}", width.name());
                let nearest = flat.nearest(&ray, t_max);
                assert_eq!(prepared.nearest(&ray, t_max), nearest, "{note}");
                hits += usize::from(nearest.is_some());
                for which in [Which::All, Which::Opaque, Which::Transparent] {
                    let from = if choice.rng.bool() { 0.0 } else { choice.number(3) };
                    let all = flat.all(&ray, (from, t_max), which);
                    assert_eq!(prepared.all(&ray, (from, t_max), which), all, "{note}");
                    let any = flat
                        .asked(which)
                        .any(|(_, item)| item.alone.any(&item.local(&ray), t_max, which));
                    assert_eq!(prepared.any(&ray, t_max, which), any, "{note}");
                    for hit in &all {
                        check_point(&prepared, &flat, &ray, hit, &note);
                    }
                }
                check_solids(&prepared, &flat, &ray.at(1.0), &note);
            }
        }
    }
    assert!(most > 100 && hits > 10_000 && deepest >= 4, "{most} {hits} {deepest}");
}

fn depth(groups: &[Placed]) -> usize {
    groups.iter().map(|placed| 1 + depth(placed.group.groups())).max().unwrap_or(0)
}

fn check_point(prepared: &Prepared, flat: &Flat, ray: &Ray, hit: &Hit, note: &str) {
    let item = &flat.items[hit.item as usize];
    let found = prepared.expand(ray, hit);
    let local = item.local(ray);
    let own = item.alone.expand(&local, &Hit { item: 0, ..*hit });
    let point = item.placement.point(&own.point);
    let normal = unit(item.placement.normal(&own.normal)).expect("a direction");
    assert_eq!((found.item, found.shape), (hit.item, item.shape), "{note}");
    assert_eq!(found.point, point, "{note}");
    assert_eq!((found.albedo, found.surface), (own.albedo, &item.surface), "{note}");
    if item.placement.is_identity() {
        assert_eq!((found.normal, found.error), (own.normal, own.error), "{note}");
    } else {
        let error = item.placement.error_of(&own.point, &point, own.error);
        assert_eq!((found.normal, found.error), (normal, error), "{note}");
    }
    assert_eq!(prepared.surface(hit.item), &item.surface, "{note}");
}

fn check_solids(prepared: &Prepared, flat: &Flat, point: &Point, note: &str) {
    let holds = |item: &Item| {
        item.surface.has_medium()
            && !item.alone.solids_at(&item.placement.local_point(point)).is_empty()
    };
    let expected: Vec<u32> =
        (0..).zip(&flat.items).filter(|(_, item)| holds(item)).map(|(i, _)| i).collect();
    assert_eq!(prepared.solids_at(point), expected, "{note}");
    for pair in expected.windows(2) {
        assert_eq!(prepared.rank(pair[0], pair[1]), prepared.rank(pair[1], pair[0]).reverse());
    }
}

/// What the error is measured by is never less than what it is for any shape.
#[test]
fn no_point_is_less_certain_than_the_least_certain() {
    for case in 0..300 {
        let scene = scene(case);
        let flat = Flat::new(&scene);
        let prepared = Prepared::new(&scene);
        let coarsest = prepared.coarsest();
        for item in &flat.items {
            let own = item.alone.coarsest();
            let far = Point::from(Vector::repeat(own / (76.0 * f64::EPSILON)));
            let error = item.placement.error_of(&far, &item.placement.point(&far), own);
            assert!(coarsest > 0.2 * error, "case {case}: {coarsest:e} for {error:e}");
        }
    }
}
