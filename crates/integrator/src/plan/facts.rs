//! What can be told of a scene before a ray is followed.

use lancer_kernel::figure;
use lancer_math::Bounds;
use lancer_scene::{Geometry, Group, Light, Pattern, Placed, Projection, Scene, Shape};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What is in a scene, counted as often as it is placed.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Facts {
    /// How many shapes there are.
    pub shapes: u64,
    /// How many there are of each kind; no triangles of meshes.
    pub kinds: BTreeMap<String, u64>,
    /// How many triangles meshes have.
    pub triangles: u64,
    /// How many groups are placed, and how deeply they are nested.
    pub groups: u64,
    /// The deepest nesting of groups.
    pub depth: usize,
    /// How many lights there are of each kind.
    pub lights: LightCounts,
    /// How many lamps and spots are balls.
    pub balls: u64,
    /// How many shapes mirror, and what part of the light the best mirror throws back, 0 to 1.
    pub mirrors: u64,
    /// That part.
    pub best_mirror: f64,
    /// How many shapes let light through, and how many of them are filled with a medium.
    pub transparent: u64,
    /// Those that are filled.
    pub media: u64,
    /// In how many media at once a point can be, at most: as many boxes around filled shapes have
    /// a point in common.
    pub nested_media: u64,
    /// How many shapes have a checker.
    pub checkers: u64,
    /// How many shapes glow.
    pub glowing: u64,
    /// How many shapes have no end.
    pub endless: u64,
    /// A box around the others, if there are any.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::written::corners"))]
    pub around: Option<Bounds>,
    /// The largest coordinate of shapes with an end, lamps and the eye.
    pub reach: f64,
    /// Whether the camera has a lens.
    pub lens: bool,
    /// Whether rays start at one point.
    pub perspective: bool,
}

/// How many lights there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LightCounts {
    /// Suns.
    pub suns: u64,
    /// Lamps.
    pub lamps: u64,
    /// Spots.
    pub spots: u64,
}

impl Facts {
    /// Those of a scene. What stands in groups is looked at once for each group.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let mut known = BTreeMap::new();
        let mut all = Part::of(&scene.shapes, &scene.groups, &mut known);
        let around = all.around.take();
        let mut facts = Self {
            nested_media: most_at_once(&all.filled),
            around,
            lens: scene.camera.aperture.is_some(),
            perspective: !matches!(scene.camera.projection, Projection::Orthographic(_)),
            ..all.facts
        };
        let mut points = vec![scene.camera.origin().get(), scene.camera.target().get()];
        for light in &scene.lights {
            match light {
                Light::Sun { .. } => facts.lights.suns += 1,
                Light::Lamp { point, .. } => {
                    points.push(point.get());
                    facts.lights.lamps += 1;
                }
                Light::Spot { point, .. } => {
                    points.push(point.get());
                    facts.lights.spots += 1;
                }
            }
            facts.balls += u64::from(light.radius().is_some());
        }
        facts.reach = points.iter().map(|point| point.coords.amax()).fold(0.0, f64::max);
        if let Some(around) = &facts.around {
            facts.reach = facts.reach.max(around.reach());
        }
        facts
    }

    /// How many lights there are.
    #[must_use]
    pub fn all_lights(&self) -> u64 {
        let LightCounts { suns, lamps, spots } = self.lights;
        suns + lamps + spots
    }
}

/// What is known of the scene, or of a group, in its own space.
#[derive(Debug, Clone, Default)]
struct Part {
    facts: Facts,
    around: Option<Bounds>,
    /// Boxes around filled shapes, as far as they are few.
    filled: Vec<Option<Bounds>>,
}

/// More filled shapes are not compared with each other: all may be in one place, then.
const MOST_FILLED: usize = 1000;

type Known = BTreeMap<*const Group, Arc<Part>>;

impl Part {
    fn of(shapes: &[Shape], groups: &[Placed], known: &mut Known) -> Self {
        let mut part = Self::default();
        shapes.iter().for_each(|shape| part.shape(shape));
        for placed in groups {
            let address = Arc::as_ptr(&placed.group);
            let inside = known.get(&address).cloned().unwrap_or_else(|| {
                let inside = Self::of(placed.group.shapes(), placed.group.groups(), known);
                let inside = Arc::new(inside);
                known.insert(address, Arc::clone(&inside));
                inside
            });
            part.place(placed, &inside);
        }
        part
    }

    fn shape(&mut self, shape: &Shape) {
        let facts = &mut self.facts;
        let surface = &shape.surface;
        facts.shapes += 1;
        *facts.kinds.entry(shape.geometry.kind().to_owned()).or_default() += 1;
        if let Geometry::Mesh(mesh) = &shape.geometry {
            facts.triangles += mesh.triangle_count() as u64;
        }
        facts.mirrors += u64::from(surface.gloss.get() > 0.0);
        facts.best_mirror = facts.best_mirror.max(surface.gloss.get());
        facts.transparent += u64::from(surface.is_transparent());
        facts.checkers += u64::from(matches!(surface.pattern, Pattern::Checker(_)));
        facts.glowing += u64::from(surface.emission.get() != [0.0; 3]);
        let bounds = figure::bounds(shape);
        match bounds {
            Some(bounds) => self.around = union(self.around, Some(bounds)),
            None => facts.endless += 1,
        }
        if surface.has_medium() {
            facts.media += 1;
            if self.filled.len() < MOST_FILLED {
                self.filled.push(bounds);
            }
        }
    }

    fn place(&mut self, placed: &Placed, inside: &Self) {
        let (facts, more) = (&mut self.facts, &inside.facts);
        facts.shapes = facts.shapes.saturating_add(more.shapes);
        for (kind, count) in &more.kinds {
            let all = facts.kinds.entry(kind.clone()).or_default();
            *all = all.saturating_add(*count);
        }
        for (all, more) in [
            (&mut facts.triangles, more.triangles),
            (&mut facts.mirrors, more.mirrors),
            (&mut facts.transparent, more.transparent),
            (&mut facts.media, more.media),
            (&mut facts.checkers, more.checkers),
            (&mut facts.glowing, more.glowing),
            (&mut facts.endless, more.endless),
            (&mut facts.groups, more.groups.saturating_add(1)),
        ] {
            *all = all.saturating_add(more);
        }
        facts.best_mirror = facts.best_mirror.max(more.best_mirror);
        facts.depth = facts.depth.max(more.depth + 1);
        let outside = |bounds: &Bounds| placed.placement.bounds(bounds);
        self.around = union(self.around, inside.around.as_ref().map(outside));
        let room = MOST_FILLED - self.filled.len();
        let filled = inside.filled.iter().take(room);
        self.filled.extend(filled.map(|bounds| bounds.as_ref().map(outside)));
    }
}

fn union(a: Option<Bounds>, b: Option<Bounds>) -> Option<Bounds> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(b)),
        (a, b) => a.or(b),
    }
}

/// Of how many boxes some point is inside of, at most; those without an end are everywhere. A point
/// that is in the most boxes can be moved, each of its coordinates alone, down to where one of
/// them begins.
fn most_at_once(boxes: &[Option<Bounds>]) -> u64 {
    let endless = boxes.iter().filter(|bounds| bounds.is_none()).count() as u64;
    let with_end: Vec<&Bounds> = boxes.iter().flatten().collect();
    if boxes.len() >= MOST_FILLED {
        return boxes.len() as u64;
    }
    let begins = |axis: usize, among: &[&Bounds]| -> Vec<f64> {
        let mut begins: Vec<f64> = among.iter().map(|bounds| bounds.min[axis]).collect();
        begins.sort_by(f64::total_cmp);
        begins.dedup();
        begins
    };
    let over = |axis: usize, at: f64, among: &[&'_ Bounds]| {
        among.iter().filter(|b| b.min[axis] <= at && at <= b.max[axis]).count()
    };
    let mut most = 0;
    for x in begins(0, &with_end) {
        let there: Vec<&Bounds> =
            with_end.iter().copied().filter(|b| b.min.x <= x && x <= b.max.x).collect();
        if there.len() <= most {
            continue;
        }
        for y in begins(1, &there) {
            let there: Vec<&Bounds> =
                there.iter().copied().filter(|b| b.min.y <= y && y <= b.max.y).collect();
            if there.len() > most {
                let counts = begins(2, &there).into_iter().map(|z| over(2, z, &there));
                most = most.max(counts.max().unwrap_or(0));
            }
        }
    }
    endless + most as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;
    use lancer_math::{Placement, Point, Vector};
    use lancer_scene::{Camera, Colour, Surface};

    fn camera() -> lancer_scene::Camera {
        Camera::new([0.0, -9.0, 1.0], [0.0, -8.0, 1.0], 1.0, [4, 3]).expect("valid")
    }

    #[test]
    fn what_is_in_groups_counts_as_often_as_it_stands() {
        let glass = Surface::glass(1.5).expect("in range");
        let mirror = Surface::new(Colour::WHITE).gloss(0.25).expect("in range");
        let ball = Shape::sphere([0.0; 3], 1.0, glass).expect("valid");
        let inner = Group::new(None, vec![ball], vec![]).expect("small");
        let inner = Arc::new(inner);
        let at = |x: f64| Placed {
            placement: Placement::translate(Vector::new(x, 0.0, 0.0)),
            group: Arc::clone(&inner),
        };
        let outer = Group::new(None, vec![], vec![at(0.0), at(1.5), at(9.0)]).expect("small");
        let scene = Scene::builder()
            .camera(Ok::<_, lancer_scene::InvalidField>(camera()))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], mirror))
            .group(Placement::translate(Vector::new(0.0, 0.0, 5.0)), Arc::new(outer))
            .build()
            .expect("valid");
        let facts = Facts::of(&scene);
        assert_eq!((facts.shapes, facts.kinds["sphere"], facts.groups, facts.depth), (4, 3, 4, 2));
        assert_eq!((facts.transparent, facts.media, facts.nested_media), (3, 3, 2));
        assert_eq!((facts.mirrors, facts.best_mirror, facts.endless), (1, 0.25, 1));
        let around = facts.around.expect("there are balls");
        assert!((around.min - Point::new(-1.0, -1.0, 4.0)).amax() < 1e-9);
        assert!((around.max - Point::new(10.0, 1.0, 6.0)).amax() < 1e-9);
        assert_eq!(
            (facts.lights, facts.perspective, facts.lens),
            (LightCounts { suns: 1, ..LightCounts::default() }, true, false)
        );
    }

    /// Against all points of a grid that is finer than the boxes.
    #[test]
    fn boxes_in_one_place_are_counted() {
        let mut rng = Rng::with_seed(5);
        for _ in 0..200 {
            let boxes: Vec<Option<Bounds>> = (0..rng.usize(1..7))
                .map(|_| {
                    let mut side = || {
                        let from = rng.i32(0..6);
                        (f64::from(from), f64::from(from + rng.i32(1..4)))
                    };
                    let [x, y, z] = [side(), side(), side()];
                    let (min, max) = (Point::new(x.0, y.0, z.0), Point::new(x.1, y.1, z.1));
                    Some(Bounds { min, max })
                })
                .collect();
            let count = |p: &Point| boxes.iter().flatten().filter(|b| b.contains(p)).count() as u64;
            let cells = (0..1000).map(|k| {
                let [x, y, z] = [k % 10, k / 10 % 10, k / 100].map(f64::from);
                count(&Point::new(x, y, z))
            });
            assert_eq!(most_at_once(&boxes), cells.max().expect("there are some"));
        }
    }
}
