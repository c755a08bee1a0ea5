use super::build::DEPTH;
use super::node::{CHILDREN, LEAF};
use super::{Hierarchy, Stack};
use crate::lanes::{Lanes, Width, Work, dispatch};
use fastrand::Rng;
use lancer_math::{Bounds, Point, Ray, Vector};
use std::ops::{ControlFlow, Range};

impl Hierarchy {
    /// What is wrong with it, as the hierarchy over these boxes in that order.
    pub(crate) fn validate(&self, boxes: &[Bounds], order: &[u32]) -> Result<(), String> {
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        if !sorted.into_iter().eq(0..boxes.len() as u32) {
            return Err("the order is none".to_owned());
        }
        let mut seen = vec![false; order.len()];
        let mut visited = vec![false; self.nodes.len()];
        let everywhere = [[f32::NEG_INFINITY; 3], [f32::INFINITY; 3]];
        let mut open: Vec<_> =
            (!self.nodes.is_empty()).then_some((0, 1, everywhere)).into_iter().collect();
        while let Some((number, depth, around)) = open.pop() {
            if depth > DEPTH {
                return Err(format!("node {number} is at depth {depth}"));
            }
            if std::mem::replace(&mut visited[number], true) {
                return Err(format!("node {number} has two parents"));
            }
            for slot in 0..CHILDREN {
                let Some((sides, child)) = self.nodes[number].child(slot) else { continue };
                let holds = |outer: &[[f32; 3]; 2], inner: &[[f32; 3]; 2]| {
                    (0..3).all(|i| outer[0][i] <= inner[0][i] && inner[1][i] <= outer[1][i])
                };
                if !holds(&around, &sides) {
                    return Err(format!("child {slot} of node {number} is not in it"));
                }
                if !child.is_leaf() {
                    open.push((child.0 as usize, depth + 1, sides));
                    continue;
                }
                if child.places().len() > LEAF {
                    return Err(format!("leaf {slot} of node {number} is too large"));
                }
                for place in child.places() {
                    if std::mem::replace(&mut seen[place], true) {
                        return Err(format!("place {place} is in two leaves"));
                    }
                    if !holds(&sides, &self.space.outward(&boxes[order[place] as usize])) {
                        return Err(format!("place {place} is not in its leaf's box"));
                    }
                }
            }
        }
        match (seen.iter().position(|seen| !seen), visited.iter().position(|seen| !seen)) {
            (Some(place), _) => Err(format!("place {place} is in no leaf")),
            (_, Some(number)) => Err(format!("node {number} has no parent")),
            _ => Ok(()),
        }
    }
}

struct Visit<'a> {
    hierarchy: &'a Hierarchy,
    ray: Ray,
    stretch: (f64, f64),
}

impl Work for Visit<'_> {
    type Output = Vec<Range<usize>>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Vec<Range<usize>> {
        let mut leaves = Vec::new();
        self.hierarchy.visit(
            lanes,
            &mut Stack::new(),
            &self.ray,
            0.0,
            self.stretch,
            #[inline(always)]
            |places, to| {
                leaves.push(places);
                ControlFlow::Continue(to)
            },
        );
        leaves
    }
}

/// The numbers of the boxes that a ray is held against, which are the same at
/// every width.
fn met(hierarchy: &Hierarchy, order: &[u32], ray: Ray, stretch: (f64, f64)) -> Vec<u32> {
    let visit = |width| dispatch(width, Visit { hierarchy, ray, stretch });
    let leaves = visit(Width::best());
    for width in Width::available() {
        assert_eq!(visit(width), leaves, "{}", width.name());
    }
    leaves.into_iter().flatten().map(|place| order[place]).collect()
}

fn boxes(rng: &mut Rng, count: usize, grid: bool) -> Vec<Bounds> {
    let mut point = |size: f64| {
        let mut c = || {
            let c = size * (2.0 * rng.f64() - 1.0);
            if grid { c.round() } else { c }
        };
        Vector::new(c(), c(), c())
    };
    (0..count)
        .map(|_| {
            let a = Point::from(point(8.0));
            Bounds::around([a, a + point(2.0)])
        })
        .collect()
}

fn moved(boxes: &[Bounds], scale: f64, by: f64) -> Vec<Bounds> {
    let place = |p: Point| Point::from(p.coords * scale + Vector::new(by, -by, by));
    boxes.iter().map(|b| Bounds { min: place(b.min), max: place(b.max) }).collect()
}

/// With whole numbers everything is exact, so a ray through a corner is in: near the
/// origin and far from it, large and small, and from far away.
#[test]
fn no_box_that_a_ray_goes_through_is_lost() {
    for case in 0..400 {
        let mut rng = Rng::with_seed(case);
        let scale = libm::scalbn(1.0, rng.i32(-90..90));
        let by = scale * [0.0, 0.0, 1e6, 1e9][rng.usize(0..4)];
        let boxes = moved(&boxes(&mut rng, 1 + case as usize % 60, true), scale, by);
        let (hierarchy, order) = Hierarchy::new(&boxes);
        for _ in 0..60 {
            let target = rng.usize(0..boxes.len());
            let corner = boxes[target].corners()[rng.usize(0..8)];
            let mut whole = || [0.0, -0.0, 1.0, -1.0, 2.0, -3.0, 3.0][rng.usize(0..7)];
            let direction = Vector::new(whole(), whole(), whole());
            if direction.norm_squared() == 0.0 {
                continue;
            }
            let back = [0.0, 4.0, 1e3, 1e5][rng.usize(0..4)];
            let unit = libm::scalbn(1.0, rng.i32(-90..90));
            let ray = Ray::new(corner - direction * (scale * back), direction * unit);
            let t = scale * back / unit;
            let mut stretches = vec![(0.0, f64::INFINITY), (0.0, t), (t, t), (-1.0, t)];
            if back == 0.0 {
                stretches.push((f64::NEG_INFINITY, 0.0));
            }
            for stretch in stretches {
                let met = met(&hierarchy, &order, ray, stretch);
                let number = target as u32;
                assert!(met.contains(&number), "case {case}: {number} {ray:?} {stretch:?}");
            }
        }
    }
}

/// Of random boxes and rays each box is met that a test in doubles, made larger by
/// no more than its roundings, says is met; and not many others.
#[test]
fn few_boxes_are_met_that_need_not_be() {
    let (mut needed, mut all, mut count) = (0, 0, 0);
    for case in 0..100 {
        let mut rng = Rng::with_seed(case);
        let boxes = boxes(&mut rng, 500, false);
        let (hierarchy, order) = Hierarchy::new(&boxes);
        for _ in 0..40 {
            let mut c = || 2.0 * rng.f64() - 1.0;
            let origin = Point::new(c(), c(), c()) * 20.0;
            let ray = Ray::new(origin, Vector::new(c(), c(), c()));
            let met = met(&hierarchy, &order, ray, (0.0, f64::INFINITY));
            for (number, bounds) in (0..).zip(&boxes) {
                let inverse = ray.direction.map(|d| 1.0 / d);
                let low = (bounds.min - ray.origin).component_mul(&inverse);
                let high = (bounds.max - ray.origin).component_mul(&inverse);
                let (enter, leave) = (low.inf(&high).max().max(0.0), low.sup(&high).min());
                if enter < leave * (1.0 - 1e-14) {
                    assert!(met.contains(&number), "case {case}: {ray:?} {bounds:?}");
                    needed += 1;
                }
            }
            all += met.len();
            count += boxes.len();
        }
    }
    assert!(all < 12 * needed && all < count / 100, "{all} for {needed} of {count}");
}

#[test]
fn each_box_is_in_one_leaf_and_its_parents_hold_it() {
    for (count, case) in [0, 1, 2, 4, 5, 8, 9, 1000, 5000, 30_000].into_iter().zip(0..) {
        let mut rng = Rng::with_seed(case);
        for grid in [true, false] {
            let boxes = boxes(&mut rng, count, grid);
            let (hierarchy, order) = Hierarchy::new(&boxes);
            hierarchy.validate(&boxes, &order).unwrap();
            assert_eq!(hierarchy.leaves().map(|places| places.len()).sum::<usize>(), count);
        }
    }
}

/// Neither a hang nor a deep hierarchy, and none is lost.
#[test]
fn boxes_that_cannot_be_told_apart_are_halved() {
    let around = |corner: Point| Bounds::around([Point::origin(), corner]);
    let mut side = 1e300;
    let mut halves = Vec::new();
    for _ in 0..1900 {
        side /= 2.0;
        halves.push(around(Point::new(side, side, side)));
    }
    let mut points = Vec::new();
    for i in 0..3000 {
        // Each half as far from the corner of all as the one before.
        let at = libm::scalbn(1.0, -(i / 8));
        points.push(Bounds::around([Point::new(at, 0.0, 0.0)]));
    }
    for boxes in [
        vec![around(Point::new(1.0, 1.0, 1.0)); 10_000],
        vec![around(Point::origin()); 10_000],
        vec![around(Point::new(f64::MAX, 1.0, f64::MAX)); 100],
        vec![around(Point::new(1e-310, 1e-310, 0.0)); 100],
        halves,
        points,
    ] {
        let (hierarchy, order) = Hierarchy::new(&boxes);
        hierarchy.validate(&boxes, &order).unwrap();
        let ray = Ray::new(Point::new(0.0, 0.0, -1.0), Vector::z());
        let mut met = met(&hierarchy, &order, ray, (0.0, f64::INFINITY));
        met.sort_unstable();
        let expected = (0..boxes.len() as u32).filter(|i| boxes[*i as usize].min.x <= 0.0);
        let missing: Vec<_> = expected.filter(|i| met.binary_search(i).is_err()).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}

#[test]
fn what_is_no_ray_meets_nothing() {
    let (hierarchy, order) = Hierarchy::new(&boxes(&mut Rng::with_seed(1), 50, false));
    for (o, d) in [
        ([0.0; 3], [0.0; 3]),
        ([0.0; 3], [f64::NAN, 0.0, 1.0]),
        ([0.0, f64::NAN, 0.0], [0.0, 0.0, 1.0]),
        ([0.0, f64::INFINITY, 0.0], [0.0, -1.0, 1.0]),
        ([0.0; 3], [0.0, 0.0, f64::NEG_INFINITY]),
    ] {
        let ray = Ray::new(Point::from(o), Vector::from(d));
        assert!(met(&hierarchy, &order, ray, (0.0, f64::INFINITY)).is_empty(), "{ray:?}");
    }
    let (hierarchy, order) = Hierarchy::new(&[]);
    let ray = Ray::new(Point::origin(), Vector::z());
    assert!(met(&hierarchy, &order, ray, (0.0, f64::INFINITY)).is_empty());
}

/// Every leaf whose box holds the point, and few others.
#[test]
fn points_find_their_boxes() {
    let mut rng = Rng::with_seed(3);
    let boxes = boxes(&mut rng, 2000, true);
    let (hierarchy, order) = Hierarchy::new(&boxes);
    let mut found = 0;
    for case in 0..2000 {
        let mut c = || f64::from(rng.i32(-22..23)) / 2.0;
        let point = Point::new(c(), c(), c());
        let mut near = Vec::new();
        hierarchy.visit_around(&point, |places| near.extend(places.map(|place| order[place])));
        let holding: Vec<u32> =
            (0..).zip(&boxes).filter(|(_, b)| b.contains(&point)).map(|(i, _)| i).collect();
        assert!(holding.iter().all(|i| near.contains(i)), "case {case}");
        found += near.len();
    }
    assert!(found < 2000 * 100, "{found}");
}

/// The same with one thread and with several.
#[test]
fn threads_do_not_matter() {
    let boxes = boxes(&mut Rng::with_seed(9), 50_000, false);
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (hierarchy, order) = pool.install(|| Hierarchy::new(&boxes));
        (format!("{:?}", hierarchy.nodes), order)
    };
    let one = build(1);
    assert!([2, 3, 7].into_iter().all(|threads| build(threads) == one));
}
