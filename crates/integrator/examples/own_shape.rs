//! A shape of one's own: a disc, seen and lit from both sides.
//!
//!     cargo run --release -p lancer-integrator --example own_shape > disc.ppm

use lancer_integrator::{Classic, RenderSettings, render};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Colour, CustomShape, Light, Scene, Shape, Surface};
use std::io::Write;

/// A disc in a horizontal plane.
#[derive(Debug)]
struct Disc {
    centre: Point,
    radius: f64,
}

impl CustomShape for Disc {
    fn name(&self) -> &str {
        "disc"
    }

    fn nearest(&self, ray: &Ray) -> Option<f64> {
        let distance = (self.centre.z - ray.origin.z) / ray.direction.z;
        // Not the point that a reflected or a shadow ray leaves, which is off
        // the plane by no more than rounding. Nor NaN, for rays in the plane.
        let ahead = distance > 1e-9 * (1.0 + self.centre.coords.norm());
        let inside = (ray.at(distance) - self.centre).norm() <= self.radius;
        (ahead && inside).then_some(distance)
    }

    fn normal(&self, _point: &Point) -> Vector {
        Vector::z()
    }

    fn shows_second_colour(&self, point: &Point) -> bool {
        let rings = (point - self.centre).norm() * 4.0;
        rings as i64 % 2 == 1
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let disc = Disc { centre: Point::new(0.0, 1.0, 0.5), radius: 1.5 };
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -4.0, 2.5], [0.0, 0.0, 0.6], 4.0, [320, 240]))
        .light(Light::lamp([2.0, -2.0, 5.0], 1.0))
        .shape(Shape::custom(disc, Surface::new(Colour::ORANGE).checker(Colour::WHITE).gloss(0.2)))
        .shape(Shape::sphere([0.0, 1.0, 1.1], 0.6, Surface::new(Colour::GREY).gloss(0.6)))
        .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], Surface::new(Colour::BLUE)))
        .build()?;
    let film = render(&scene, &Classic, &RenderSettings::default())?.film;
    let codes = film.pixels().iter().flatten().map(|v| v.clamp(0.0, 255.0) as u8);
    std::io::stdout().write_all(b"P6\n320 240\n255\n")?;
    Ok(std::io::stdout().write_all(&codes.collect::<Vec<_>>())?)
}
