//! Random scenes of one kind of shape, and random rays to ask them with.

use super::figure::Crossing;
use super::sample::{any_direction, between, power_of_ten};
use super::space::{Frame, Line, Long};
use super::subject::{Kind, Subject};
use fastrand::Rng;
use lancer_kernel::Prepared;
use lancer_math::{Placement, Point, Ray, Vector};
use lancer_scene::{Camera, Group, Placed, Scene};
use std::sync::Arc;

/// A scene, prepared by the kernel and known to the test.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) prepared: Prepared,
    subjects: Vec<Subject>,
    frames: Vec<(Placement, Frame)>,
    /// The number of the subject and of the frame of each item.
    items: Vec<(usize, usize)>,
}

/// A crossing in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    pub(crate) item: u32,
    pub(crate) crossing: Crossing,
    /// |cos| at the crossing in the space of the shape, and in the world.
    pub(crate) local_cosine: f64,
    pub(crate) cosine: f64,
    /// How far the continued surface is from the ray's origin, and how many times
    /// farther small distances from it are in the space of the shape.
    pub(crate) from_origin: f64,
    pub(crate) shrinking: f64,
    pub(crate) line: Line,
}

fn random_placement(rng: &mut Rng) -> Placement {
    let mut factor = || power_of_ten(rng, -0.5, 0.5) * if rng.u8(..4) == 0 { -1.0 } else { 1.0 };
    let factors = Vector::from([(); 3].map(|()| factor()));
    let axis = any_direction(rng);
    let turn = Placement::rotate(axis, between(rng, 0.0, 360.0)).expect("an axis");
    let stretch = Placement::scale(factors).expect("not flat");
    let by = power_of_ten(rng, -1.0, 2.0);
    let step = Placement::translate(any_direction(rng) * by);
    if rng.bool() { turn.then(&stretch).then(&step) } else { stretch.then(&turn).then(&step) }
}

impl Case {
    /// The first and third of four scenes stand as they are; the second is placed once
    /// or twice, and the fourth in groups within groups.
    pub(crate) fn new(kind: Kind, number: u64) -> Self {
        let mut rng = Rng::with_seed(number);
        let count = if number % 5 == 4 { 3 } else { 1 };
        let subjects: Vec<_> = (0..count).map(|_| Subject::random(kind, &mut rng)).collect();
        let shapes: Vec<_> = subjects.iter().map(|subject| subject.shape.clone()).collect();
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3]);
        let mut builder = Scene::builder().camera(camera);
        let mut placements = Vec::new();
        if number.is_multiple_of(2) {
            builder = shapes.into_iter().fold(builder, |builder, s| builder.shape(Ok(s)));
            placements.push(Placement::IDENTITY);
        } else {
            let depth = if number % 4 == 1 { 0 } else { rng.usize(1..=3) };
            let shared = Arc::new(Group::new(None, shapes, Vec::new()).expect("a group"));
            for _ in 0..rng.usize(1..=2) {
                let (mut group, mut chain) = (shared.clone(), vec![random_placement(&mut rng)]);
                for _ in 0..depth {
                    let placement = chain[chain.len() - 1];
                    let placed = vec![Placed { placement, group }];
                    group = Arc::new(Group::new(None, Vec::new(), placed).expect("a group"));
                    chain.push(random_placement(&mut rng));
                }
                builder = builder.group(chain[chain.len() - 1], group);
                let whole = chain.iter().rev();
                placements.push(whole.fold(Placement::IDENTITY, |outer, p| p.then(&outer)));
            }
        }
        let scene = builder.build().expect("a scene");
        let frames = 0..placements.len();
        let items = frames.flat_map(|frame| (0..count).map(move |s| (s, frame))).collect();
        let frames = placements.into_iter().map(|p| (p, Frame::new(&p))).collect();
        Self { prepared: Prepared::new(&scene), subjects, frames, items }
    }

    pub(crate) fn item_count(&self) -> u32 {
        self.items.len() as u32
    }

    pub(crate) fn subject(&self, item: u32) -> &Subject {
        &self.subjects[self.items[item as usize].0]
    }

    pub(crate) fn frame(&self, item: u32) -> &Frame {
        &self.frames[self.items[item as usize].1].1
    }

    /// What makes an item again, to the last bit.
    pub(crate) fn describe(&self, item: u32) -> String {
        let (subject, frame) = self.items[item as usize];
        let geometry = &self.subjects[subject].shape.geometry;
        format!("{geometry:?} placed by {:?}", self.frames[frame].0)
    }

    /// The ray as an item sees it.
    fn line(&self, item: u32, ray: &Ray) -> Line {
        let frame = self.frame(item);
        let (origin, direction) = frame.local(ray);
        let sample = &self.subject(item).sample;
        // What stands as it is may be seen from its own middle, without any loss;
        // what is placed has its numbers in the space of its group.
        let size = (origin.round() - sample.centre.coords).norm() + sample.size;
        let scale = if frame.is_identity {
            size
        } else {
            let reach = sample.centre.coords.norm() + sample.size;
            frame.growth * (origin.round().norm() + reach)
        };
        let (length, growth) = (direction.round().norm(), frame.growth);
        Line { origin, direction, length, scale, growth, size }
    }

    /// All crossings of a ray's line, nearest first.
    pub(crate) fn crossings(&self, ray: &Ray) -> Vec<Entry> {
        let mut entries = Vec::new();
        let mut found = Vec::new();
        for item in 0..self.item_count() {
            let (line, figure) = (self.line(item, ray), &self.subject(item).figure);
            figure.crossings(&line, &mut found);
            entries.extend(found.drain(..).map(|crossing| {
                let normal = figure.normal(crossing.part, line.at(crossing.t));
                let outside = self.frame(item).normal(normal).round();
                let shrinking = outside.norm();
                let across = normal.dot(line.direction).round().abs();
                let cosine = across / (shrinking * ray.direction.norm());
                let local_cosine = across / line.length;
                let from_origin = figure.side(crossing.part, line.origin).round().abs();
                Entry { item, crossing, local_cosine, cosine, from_origin, shrinking, line }
            }));
        }
        entries.sort_by(|a, b| a.crossing.t.partial_cmp(&b.crossing.t).expect("no NaN"));
        entries
    }

    /// A random ray, and whether it was not made to be difficult.
    pub(crate) fn ray(&self, rng: &mut Rng, number: u64) -> (Ray, bool) {
        let item = rng.usize(..self.items.len());
        let (subject, frame) = self.items[item];
        let subject = &self.subjects[subject];
        let sample = &subject.sample;
        let (centre, size) = (sample.centre, sample.size);
        let aside = |rng: &mut Rng, by: f64| any_direction(rng) * by;
        let away = |rng: &mut Rng| size * power_of_ten(rng, -1.0, 1.5);
        let mut is_easy = number % 6 < 3;
        let (origin, direction) = match number % 6 {
            // From inside, or between the parts of a tube.
            2 if !subject.is_flat() => (sample.inside(rng), any_direction(rng)),
            // At the shape or past it, some along an axis of coordinates.
            0..3 => {
                let target = if rng.bool() {
                    let by = 1.2 * size * rng.f64();
                    centre + aside(rng, by)
                } else {
                    let by = size * power_of_ten(rng, -4.0, 0.0);
                    sample.on_surface(rng).0 + aside(rng, by)
                };
                let direction = if rng.u8(..8) == 0 {
                    is_easy = false;
                    Vector::ith(rng.usize(..3), if rng.bool() { 1.0 } else { -1.0 })
                } else {
                    any_direction(rng)
                };
                let back = size + away(rng);
                (target - direction * back, direction)
            }
            // Along a tangent, a little beside the surface.
            3 => {
                let (point, normal) = sample.on_surface(rng);
                let along = unit_across(rng, normal);
                let beside = size * power_of_ten(rng, -17.0, -3.0);
                let beside = normal * if rng.bool() { beside } else { -beside };
                let back = size + away(rng);
                (point + beside - along * back, along)
            }
            // At an edge or a corner, a little beside it.
            4 => {
                let by = if rng.u8(..8) == 0 { 0.0 } else { power_of_ten(rng, -17.0, -3.0) };
                let target = sample.on_edge(rng) + aside(rng, size * by);
                let back = size + away(rng);
                let origin = target + aside(rng, back);
                (origin, (target - origin) / back)
            }
            // From the surface, or from next to it.
            _ => {
                let (point, normal) = sample.on_surface(rng);
                let off = if rng.u8(..4) == 0 { 0.0 } else { power_of_ten(rng, -16.0, -2.0) };
                let off = size * if rng.bool() { off } else { -off };
                (point + normal * off, any_direction(rng))
            }
        };
        let placement = &self.frames[frame].0;
        let (origin, direction): (Point, Vector) = if placement.is_identity() {
            (origin, direction)
        } else {
            (placement.point(&origin), placement.vector(&direction))
        };
        let length = if rng.u8(..4) == 0 { 1.0 } else { power_of_ten(rng, -3.0, 3.0) };
        (Ray::new(origin, direction * length), is_easy)
    }
}

fn unit_across(rng: &mut Rng, normal: Vector) -> Vector {
    let mut across = normal.cross(&any_direction(rng));
    while across.norm() < 0.01 {
        across = normal.cross(&any_direction(rng));
    }
    across / across.norm()
}

impl Entry {
    /// The signed distance of a point of the world from a continued part, in
    /// the space of the shape, and the normal in the world that goes with it.
    pub(crate) fn side(&self, case: &Case, part: usize, point: Point) -> (f64, Vector) {
        let (figure, frame) = (&case.subject(self.item).figure, case.frame(self.item));
        let local = frame.local_point(Long::from(point));
        let normal = figure.normal(part, local);
        (figure.side(part, local).round(), frame.normal(normal).round())
    }
}
