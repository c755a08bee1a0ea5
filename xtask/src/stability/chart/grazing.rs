//! Error against how flat a ray comes in.

use super::draw::{Fails, Line, Panel, Points};
use super::judge::{self, Subject, direction, distance, matte, parts, rounded};
use super::{stable, textbook};
use fastrand::Rng;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;
use std::sync::Arc;

/// What the textbook takes for parallel.
const PARALLEL_SINGLE: f32 = 1e-6;
const PARALLEL_DOUBLE: f64 = 1e-10;

pub(super) fn panels() -> Vec<Panel> {
    vec![spheres(), planes(), edges()]
}

/// Rays that pass a sphere just below where they would touch it, from 1000 radii away.
fn spheres() -> Panel {
    const RAYS: u64 = 60;
    const FAR: f64 = 1e3;
    let all = [Line::TextbookSingle, Line::TextbookDouble, Line::OursSingle, Line::OursDouble];
    let mut lines = all.map(|line| (line, Points::new()));
    let subject = Subject::new(Shape::sphere([0.0; 3], 1.0, matte()));
    for half in (0..=32).rev() {
        let depth = libm::exp10(-0.5 * f64::from(half));
        let mut worst = [None; 4];
        for seed in 0..RAYS {
            let rng = &mut Rng::with_seed(seed);
            let way = direction(rng);
            let across = way.cross(&direction(rng)).normalize();
            let ray = Ray::new(Point::from(across * (1.0 - depth) - way * FAR), way);
            for ((line, _), worst) in lines.iter().zip(&mut worst) {
                let is_single = matches!(line, Line::TextbookSingle | Line::OursSingle);
                let ray = if is_single { rounded(&ray) } else { ray };
                let found = match line {
                    Line::TextbookSingle => {
                        textbook::sphere::<f32>(parts(&ray), [0.0; 3], 1.0, 0.0).map(f64::from)
                    }
                    Line::TextbookDouble => {
                        textbook::sphere::<f64>(parts(&ray), [0.0; 3], 1.0, 0.0)
                    }
                    Line::OursSingle => {
                        stable::sphere::<f32>(parts(&ray), [0.0; 3], 1.0).map(f64::from)
                    }
                    _ => subject.ours(&ray),
                };
                let off = distance(found, subject.truth(&ray).as_ref(), &ray);
                *worst = judge::worse(*worst, off);
            }
        }
        for ((_, points), worst) in lines.iter_mut().zip(worst) {
            points.extend(worst.map(|worst| (depth, worst)));
        }
    }
    Panel {
        title: "Sphere from 1000 radii away",
        x: "how deep below touching a ray passes, in radii",
        y: "worst error of the hit, in radii (1: lost)",
        x_range: 1e-16..1.0,
        y_range: 1e-17..1.0,
        fails: Fails::Left,
        lines: lines.into(),
    }
}

/// Rays from height 1 to a floor.
fn planes() -> Panel {
    let all = [Line::TextbookSingle, Line::TextbookDouble, Line::OursSingle, Line::OursDouble];
    let mut lines = all.map(|line| (line, Points::new()));
    let normal = [0.0, 0.0, 1.0];
    let subject = Subject::new(Shape::plane([0.0; 3], normal, matte()));
    for half in (0..=40).rev() {
        let slope = libm::exp10(-0.5 * f64::from(half));
        let ray = Ray::new(Point::new(0.25, 0.5, 1.0), Vector::new(1.0, 0.3, -slope));
        for (line, points) in &mut lines {
            let is_single = matches!(line, Line::TextbookSingle | Line::OursSingle);
            let ray = if is_single { rounded(&ray) } else { ray };
            let n = [0.0, 0.0, 1.0];
            let found = match line {
                Line::TextbookSingle => {
                    let n = n.map(|c| c as f32);
                    textbook::plane(parts(&ray), n, 0.0, PARALLEL_SINGLE).map(f64::from)
                }
                Line::TextbookDouble => textbook::plane(parts(&ray), n, 0.0, PARALLEL_DOUBLE),
                Line::OursSingle => {
                    let n = n.map(|c| c as f32);
                    stable::plane(parts(&ray), n, [0.0_f32; 3]).map(f64::from)
                }
                _ => subject.ours(&ray),
            };
            let truth = subject.truth(&ray);
            let length = truth.as_ref().map_or(1.0, |c| c.t.to_f64() * ray.direction.norm());
            let relative = match found {
                Some(_) => distance(found, truth.as_ref(), &ray).map(|off| off / length),
                None => Some(judge::LOST),
            };
            points.extend(relative.map(|relative| (slope, relative)));
        }
    }
    Panel {
        title: "Plane",
        x: "slope of the ray",
        y: "relative error of t (1: lost)",
        x_range: 1e-20..1.0,
        y_range: 1e-17..1.0,
        fails: Fails::Left,
        lines: lines.into(),
    }
}

/// Rays through the common edge of two triangles: one of them must be met, and one alone.
fn edges() -> Panel {
    const RAYS: u64 = 20_000;
    let all = [Line::TextbookSingle, Line::TextbookDouble, Line::OursSingle, Line::OursDouble];
    let mut lines = all.map(|line| (line, Points::new()));
    // In one plane, exactly, also in single precision.
    let corners = [[-0.875, -0.6875], [0.8125, 0.90625], [-0.625, 0.75], [0.6875, -0.78125]]
        .map(|[x, y]: [f64; 2]| [x, y, 0.5 * x + 0.25 * y]);
    let normal = Vector::new(-0.5, -0.25, 1.0).normalize();
    let triangles = [[0, 1, 2], [1, 0, 3]];
    let mesh = lancer_scene::Mesh::new(corners.to_vec(), triangles.to_vec());
    let mesh = Arc::new(mesh.expect("both have an area"));
    let subject = Subject::new(Shape::mesh(mesh, matte()));
    let singles = triangles.map(|t| t.map(|i| corners[i as usize].map(|c| c as f32)));
    let doubles = triangles.map(|t| t.map(|i| corners[i as usize]));
    for half in (0..=16).rev() {
        let sine = libm::exp10(-0.5 * f64::from(half));
        let mut lost = [0_u64; 4];
        for seed in 0..RAYS {
            let rng = &mut Rng::with_seed(seed);
            let [a, b] = [corners[0], corners[1]].map(Vector::from);
            let target = Point::from(a + (b - a) * (0.05 + 0.9 * rng.f64()));
            // Across the edge, as flat to both.
            let along = (b - a).normalize();
            let way = along.cross(&normal) + along * (rng.f64() - 0.5);
            let way = way.normalize() - normal * sine;
            let ray = Ray::new(target - way * (2.0 + rng.f64()), way);
            let single = rounded(&ray);
            for ((line, _), lost) in lines.iter().zip(&mut lost) {
                let meets = match line {
                    Line::TextbookSingle => {
                        singles.iter().any(|t| textbook::triangle(parts(&single), *t).is_some())
                    }
                    Line::TextbookDouble => {
                        doubles.iter().any(|t| textbook::triangle(parts(&ray), *t).is_some())
                    }
                    Line::OursSingle => singles.iter().any(|t| stable::meets(parts(&single), *t)),
                    _ => subject.is_met(&ray),
                };
                *lost += u64::from(!meets);
            }
        }
        let shares = lost.map(|lost| lost as f64 / RAYS as f64);
        lines.iter_mut().zip(shares).for_each(|((_, points), share)| points.push((sine, share)));
    }
    Panel {
        title: "Two triangles: rays through their edge",
        x: "slope of the ray",
        y: "share that goes through (bottom: none)",
        x_range: 1e-8..1.0,
        y_range: 1e-5..1.0,
        fails: Fails::Left,
        lines: lines.into(),
    }
}
