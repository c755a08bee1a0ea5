//! Random scenes of one kind of shape.

use super::figure::Crossing;
use super::kind::Kind;
use super::sample::{any_direction, between, power_of_ten};
use super::space::{Frame, Line, Long};
use super::subject::Subject;
use fastrand::Rng;
use lancer_kernel::Prepared;
use lancer_math::{Placement, Point, Ray, Vector};
use lancer_scene::{Camera, Group, Placed, Scene, SceneBuilder, Shape};
use std::sync::Arc;

/// A scene, prepared by the kernel and known to the test.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) scene: Scene,
    pub(crate) prepared: Prepared,
    subjects: Vec<Subject>,
    stands: Vec<Stand>,
    /// The number of the subject and of the stand of each item.
    items: Vec<(usize, usize)>,
}

/// Where the subjects stand once.
#[derive(Debug)]
struct Stand {
    /// The placements of groups within groups, the innermost first.
    chain: Vec<Placement>,
    /// All of them together.
    placement: Placement,
    frame: Frame,
}

impl Stand {
    fn new(chain: Vec<Placement>) -> Self {
        let outward = chain.iter().rev();
        let placement = outward.fold(Placement::IDENTITY, |outer, p| p.then(&outer));
        Self { chain, placement, frame: Frame::new(&placement) }
    }
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

fn builder() -> SceneBuilder {
    Scene::builder().camera(Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3]))
}

/// Adds shapes, within so many groups.
fn stand(builder: SceneBuilder, shapes: &Arc<Group>, chain: &[Placement]) -> SceneBuilder {
    let Some((last, inner)) = chain.split_last() else {
        return shapes.shapes().iter().fold(builder, |builder, s| builder.shape(Ok(s.clone())));
    };
    let around = |group: Arc<Group>, placement: &Placement| {
        let placed = vec![Placed { placement: *placement, group }];
        Arc::new(Group::new(None, Vec::new(), placed).expect("a group"))
    };
    builder.group(*last, inner.iter().fold(Arc::clone(shapes), around))
}

fn group(shapes: Vec<Shape>) -> Arc<Group> {
    Arc::new(Group::new(None, shapes, Vec::new()).expect("a group"))
}

impl Case {
    /// Of eight scenes four stand as they are, two of them as a shell of a second
    /// copy that is moved by little; the others are placed once or twice, half of them in groups
    /// within groups.
    pub(crate) fn new(kind: Kind, seed: u64, number: u64) -> Self {
        let mut rng = Rng::with_seed(seed);
        let rng = &mut rng;
        let count = match number % 5 {
            _ if kind == Kind::Mixed => rng.usize(4..=24),
            4 => 3,
            _ => 1,
        };
        let subjects: Vec<_> = (0..count).map(|_| Subject::random(kind, rng)).collect();
        let mut stands = Vec::new();
        match number % 4 {
            0 => stands.push(Stand::new(Vec::new())),
            2 => {
                let size = subjects[0].sample.size;
                let gap = any_direction(rng) * (size * power_of_ten(rng, -16.0, -1.0));
                stands.push(Stand::new(Vec::new()));
                stands.push(Stand::new(vec![Placement::translate(gap)]));
            }
            odd => {
                let depth = if odd == 1 { 0 } else { rng.usize(1..=3) };
                for _ in 0..rng.usize(1..=2) {
                    let chain = (0..=depth).map(|_| random_placement(rng)).collect();
                    stands.push(Stand::new(chain));
                }
            }
        }
        let shared = group(subjects.iter().map(|subject| subject.shape.clone()).collect());
        let all = stands.iter();
        let scene = all.fold(builder(), |builder, s| stand(builder, &shared, &s.chain));
        let scene = scene.build().expect("a scene");
        let items = 0..stands.len();
        let items = items.flat_map(|stand| (0..count).map(move |s| (s, stand))).collect();
        Self { prepared: Prepared::new(&scene), scene, subjects, stands, items }
    }

    /// The item alone, where it stands.
    pub(crate) fn alone(&self, item: u32, shape: Shape) -> Scene {
        let chain = &self.stands[self.items[item as usize].1].chain;
        stand(builder(), &group(vec![shape]), chain).build().expect("a scene")
    }

    pub(crate) fn placement(&self, item: u32) -> &Placement {
        &self.stands[self.items[item as usize].1].placement
    }

    pub(crate) fn item_count(&self) -> u32 {
        self.items.len() as u32
    }

    pub(crate) fn subject(&self, item: u32) -> &Subject {
        &self.subjects[self.items[item as usize].0]
    }

    /// How many placements are one within the other where an item stands.
    pub(crate) fn depth(&self, item: u32) -> usize {
        self.stands[self.items[item as usize].1].chain.len()
    }

    pub(crate) fn frame(&self, item: u32) -> &Frame {
        &self.stands[self.items[item as usize].1].frame
    }

    /// What makes an item again, to the last bit.
    pub(crate) fn describe(&self, item: u32) -> String {
        let geometry = &self.subject(item).shape.geometry;
        format!("{geometry:?} placed by {:?}", self.placement(item))
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

    /// Whether a ray passes the ball around an item by much more than all roundings.
    pub(crate) fn is_clear_of(&self, item: u32, ray: &Ray) -> bool {
        self.subject(item).is_clear_of(&self.line(item, ray))
    }

    /// All crossings of a ray's line, nearest first.
    pub(crate) fn crossings(&self, ray: &Ray) -> Vec<Entry> {
        let mut entries = Vec::new();
        let mut found = Vec::new();
        for item in 0..self.item_count() {
            let (line, subject) = (self.line(item, ray), self.subject(item));
            if subject.is_clear_of(&line) {
                continue;
            }
            let figure = &subject.figure;
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
