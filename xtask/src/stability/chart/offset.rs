//! Error against how far from the world's origin things stand.

use super::draw::{Fails, Line, Panel, Points};
use super::float::{Float, along, minus, triple};
use super::judge::{self, Subject, direction, from_afar, matte, parts, rounded};
use super::{stable, textbook, xs};
use fastrand::Rng;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;

const RAYS: u64 = 60;

/// How far along its surface a shadow ray of the textbook starts.
const STEP_SINGLE: f64 = 1e-4;
const STEP_DOUBLE: f64 = 1e-9;

pub(super) fn panels() -> Vec<Panel> {
    let x = "distance from the world's origin, in radii";
    let x_range = 1.0..1e14;
    vec![
        Panel {
            title: "Sphere: its normal",
            x,
            y: "worst error of the normal, in radians",
            x_range: x_range.clone(),
            y_range: 1e-17..1.0,
            fails: Fails::Right,
            lines: collected(Line::ALL[..4].to_vec(), &normals),
        },
        Panel {
            title: "Plane seen from distance 10",
            x: "distance from the world's origin",
            y: "worst error of the hit (1: lost)",
            x_range: x_range.clone(),
            y_range: 1e-17..1.0,
            fails: Fails::Right,
            lines: collected(Line::ALL[..4].to_vec(), &planes),
        },
        Panel {
            title: "Rays that leave a sphere",
            x,
            y: "share that meets it again (bottom: none)",
            x_range,
            y_range: 1e-3..1.0,
            fails: Fails::Right,
            lines: collected(
                vec![Line::TextbookSingle, Line::TextbookDouble, Line::OursDouble],
                &leaving,
            ),
        },
    ]
}

/// A number for each line at a distance, if there is one.
type Measure<'a> = &'a dyn Fn(f64, &[Line]) -> Vec<Option<f64>>;

/// That at each distance.
fn collected(lines: Vec<Line>, measure: Measure<'_>) -> Vec<(Line, Points)> {
    let mut found: Vec<(Line, Points)> = lines.iter().map(|l| (*l, Points::new())).collect();
    for x in xs(0.0, 14.0) {
        let values = measure(x, &lines);
        for ((_, points), value) in found.iter_mut().zip(values) {
            points.extend(value.map(|value| (x, value)));
        }
    }
    found
}

/// A place so far away, in single precision, that both know the same sphere.
fn place(rng: &mut Rng, offset: f64) -> Point {
    let away = direction(rng) * offset;
    away.map(|c| f64::from(c as f32)).into()
}

fn normals(offset: f64, lines: &[Line]) -> Vec<Option<f64>> {
    let mut worst = vec![None; lines.len()];
    for seed in 0..RAYS {
        let rng = &mut Rng::with_seed(seed);
        let centre = place(rng, offset);
        let subject = Subject::new(Shape::sphere(centre.coords.into(), 1.0, matte()));
        let ray = from_afar(centre + direction(rng) * (0.9 * rng.f64()), direction(rng), 10.0);
        for (line, worst) in lines.iter().zip(&mut worst) {
            let is_single = matches!(line, Line::TextbookSingle | Line::OursSingle);
            let ray = if is_single { rounded(&ray) } else { ray };
            // What is rounded so far away may pass it.
            let Some(truth) = subject.truth(&ray) else { continue };
            let c = centre.coords.into();
            let found = match line {
                Line::TextbookSingle => textbook_normal::<f32>(&ray, c),
                Line::TextbookDouble => textbook_normal::<f64>(&ray, c),
                Line::OursSingle => stable_normal::<f32>(&ray, c),
                _ => subject.point(&ray).map(|point| point.normal.into()),
            };
            let off = found.map_or(judge::LOST, |n| judge::normal(n, &truth));
            *worst = judge::worse(*worst, Some(off));
        }
    }
    worst
}

fn textbook_normal<F: Float>(ray: &Ray, centre: [f64; 3]) -> Option<[f64; 3]> {
    let (o, d) = parts::<F>(ray);
    let centre = triple(centre);
    let t = textbook::sphere((o, d), centre, F::of(1.0), F::ZERO)?;
    Some(minus(along(o, t, d), centre).map(F::get))
}

fn stable_normal<F: Float>(ray: &Ray, centre: [f64; 3]) -> Option<[f64; 3]> {
    let centre = triple(centre);
    let t = stable::sphere(parts::<F>(ray), centre, F::of(1.0))?;
    let v = stable::stepped(parts::<F>(ray), centre, t);
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    Some(v.map(|c| (c / length).get()))
}

fn planes(offset: f64, lines: &[Line]) -> Vec<Option<f64>> {
    let mut worst = vec![None; lines.len()];
    for seed in 0..RAYS {
        let rng = &mut Rng::with_seed(seed);
        let origin = place(rng, offset);
        // A normal with few digits: the same plane for both.
        let normal = direction(rng).map(|c| f64::from((c * 64.0).round() as i32));
        let subject = Subject::new(Shape::plane(origin.coords.into(), normal.into(), matte()));
        let way = -normal / normal.norm() + direction(rng) * 0.7;
        let ray = from_afar(origin, way / way.norm(), 10.0);
        for (line, worst) in lines.iter().zip(&mut worst) {
            let is_single = matches!(line, Line::TextbookSingle | Line::OursSingle);
            let ray = if is_single { rounded(&ray) } else { ray };
            let truth = subject.truth(&ray);
            let (n, o) = (normal.into(), origin.coords.into());
            let found = match line {
                Line::TextbookSingle => textbook_plane::<f32>(&ray, n, o),
                Line::TextbookDouble => textbook_plane::<f64>(&ray, n, o),
                Line::OursSingle => {
                    stable::plane::<f32>(parts(&ray), triple(n), triple(o)).map(f64::from)
                }
                _ => subject.ours(&ray),
            };
            *worst = judge::worse(*worst, judge::distance(found, truth.as_ref(), &ray));
        }
    }
    worst
}

fn textbook_plane<F: Float>(ray: &Ray, normal: [f64; 3], origin: [f64; 3]) -> Option<f64> {
    let n = triple::<F>(normal);
    let k = super::float::dot(n, triple(origin));
    textbook::plane(parts(ray), n, k, F::ZERO).map(F::get)
}

fn leaving(offset: f64, lines: &[Line]) -> Vec<Option<f64>> {
    const RAYS: u64 = 1000;
    let mut met = vec![0_u64; lines.len()];
    for seed in 0..RAYS {
        let rng = &mut Rng::with_seed(seed);
        let centre = place(rng, offset);
        let subject = Subject::new(Shape::sphere(centre.coords.into(), 1.0, matte()));
        let ray = from_afar(centre + direction(rng) * (0.9 * rng.f64()), direction(rng), 10.0);
        let way = direction(rng);
        for (line, met) in lines.iter().zip(&mut met) {
            let c = centre.coords.into();
            *met += u64::from(match line {
                Line::TextbookSingle => meets_again::<f32>(&rounded(&ray), c, way, STEP_SINGLE),
                Line::TextbookDouble => meets_again::<f64>(&ray, c, way, STEP_DOUBLE),
                _ => subject.point(&ray).is_some_and(|point| {
                    let outward = if way.dot(&point.normal) < 0.0 { -way } else { way };
                    subject.is_met(&point.leave(outward))
                }),
            });
        }
    }
    met.iter().map(|met| Some(*met as f64 / RAYS as f64)).collect()
}

/// Whether a ray that leaves outward, with hits nearer than `step` left out, meets the sphere.
fn meets_again<F: Float>(ray: &Ray, centre: [f64; 3], way: Vector, step: f64) -> bool {
    let (o, d) = parts::<F>(ray);
    let centre = triple(centre);
    textbook::sphere((o, d), centre, F::of(1.0), F::ZERO).is_some_and(|t| {
        let point = along(o, t, d);
        let normal = minus(point, centre);
        let way = triple::<F>(way.into());
        let way = if super::float::dot(way, normal) < F::ZERO { way.map(|c| -c) } else { way };
        textbook::sphere((point, way), centre, F::of(1.0), F::of(step)).is_some()
    })
}
