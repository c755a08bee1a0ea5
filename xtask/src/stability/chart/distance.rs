//! Error against how far away a shape is.

use super::draw::{Fails, Line, Panel, Points};
use super::judge::{self, Subject, direction, distance, from_afar, matte, parts, rounded};
use super::{stable, textbook, xs};
use fastrand::Rng;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;

const TUBE: f64 = 0.25;

pub(super) fn panels() -> Vec<Panel> {
    let sphere = Subject::new(Shape::sphere([0.0; 3], 1.0, matte()));
    let inside = |rng: &mut Rng| Point::from(direction(rng) * (0.95 * rng.f64()));
    let spheres = lines(
        &sphere,
        100,
        &|rng, d| from_afar(inside(rng), direction(rng), d),
        &[
            (Line::TextbookSingle, &|ray| {
                textbook::sphere::<f32>(parts(ray), [0.0; 3], 1.0, 0.0).map(f64::from)
            }),
            (Line::TextbookDouble, &|ray| textbook::sphere::<f64>(parts(ray), [0.0; 3], 1.0, 0.0)),
            (Line::OursSingle, &|ray| {
                stable::sphere::<f32>(parts(ray), [0.0; 3], 1.0).map(f64::from)
            }),
        ],
    );

    // Rays that meet the side, a long way from the lids.
    let cylinder = Subject::new(
        Shape::cylinder([0.0, 0.0, -1e4], [0.0, 0.0, 1e4], 1.0, matte()).map(Shape::without_lids),
    );
    let across = |rng: &mut Rng, d: f64| {
        let target = Vector::new(0.6 * rng.f64(), 0.6 * rng.f64(), rng.f64());
        let slope = 1e3 / d;
        let way = direction(rng);
        let way = Vector::new(way.x, way.y, way.z * slope.min(0.5));
        from_afar(Point::from(target), way / way.norm(), d)
    };
    let cylinders = lines(
        &cylinder,
        100,
        &across,
        &[
            (Line::TextbookSingle, &|ray| textbook::cylinder::<f32>(parts(ray)).map(f64::from)),
            (Line::TextbookDouble, &|ray| textbook::cylinder::<f64>(parts(ray))),
        ],
    );

    let torus = Subject::new(Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, TUBE], matte()));
    let into_tube = |rng: &mut Rng, d: f64| {
        let around = direction(rng);
        let circle = Vector::new(around.x, around.y, 0.0);
        let target = circle / circle.norm() + direction(rng) * (0.9 * TUBE * rng.f64());
        from_afar(Point::from(target), direction(rng), d)
    };
    let tori = lines(
        &torus,
        30,
        &into_tube,
        &[
            (Line::TextbookSingle, &|ray| textbook::torus::<f32>(parts(ray), 0.25).map(f64::from)),
            (Line::TextbookDouble, &|ray| textbook::torus::<f64>(parts(ray), TUBE)),
        ],
    );
    [("Sphere", spheres), ("Cylinder, side", cylinders), ("Torus", tori)]
        .map(|(title, lines)| Panel {
            title,
            x: "distance of the ray's origin, in radii",
            y: "worst error of the hit, in radii (1: lost)",
            x_range: 1.0..1e12,
            y_range: 1e-17..1.0,
            fails: Fails::Right,
            lines,
        })
        .into()
}

type Form<'a> = (Line, &'a dyn Fn(&Ray) -> Option<f64>);

fn lines(
    subject: &Subject,
    rays: u64,
    make: &dyn Fn(&mut Rng, f64) -> Ray,
    forms: &[Form<'_>],
) -> Vec<(Line, Points)> {
    let xs: Vec<f64> = xs(0.5, 12.0).collect();
    let ours = |ray: &Ray| subject.ours(ray);
    let ours: Form<'_> = (Line::OursDouble, &ours);
    let mut found: Vec<(Line, Points)> =
        forms.iter().chain([&ours]).map(|(line, _)| (*line, Points::new())).collect();
    for &x in &xs {
        let mut worst: Vec<Option<f64>> = vec![None; found.len()];
        for seed in 0..rays {
            let ray = make(&mut Rng::with_seed(seed), x);
            let truth = [rounded(&ray), ray].map(|ray| (subject.truth(&ray), ray));
            for ((line, form), worst) in forms.iter().chain([&ours]).zip(&mut worst) {
                let is_single = matches!(line, Line::TextbookSingle | Line::OursSingle);
                let (truth, ray) = &truth[usize::from(!is_single)];
                *worst = judge::worse(*worst, distance(form(ray), truth.as_ref(), ray));
            }
        }
        for ((_, points), worst) in found.iter_mut().zip(worst) {
            points.extend(worst.map(|worst| (x, worst)));
        }
    }
    found.push((Line::Rounding, xs.iter().map(|&x| (x, x.next_up() - x)).collect()));
    found
}
