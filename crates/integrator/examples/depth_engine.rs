//! An engine of one's own: how far away things are, near ones white.
//!
//!     cargo run --release -p lancer-integrator --example depth_engine > depth.pgm

use lancer_film::Display;
use lancer_integrator::{Engine, PinholeCamera, Plan, RayCounts, RenderSettings};
use lancer_integrator::{Rgb, Tracer, World, render};
use lancer_scene::{Camera, Colour, Scene, Shape, Surface};
use std::io::Write;

/// Shows a surface at distance d as 3 / (1 + d).
struct Depth;

struct DepthTracer {
    camera: PinholeCamera,
    world: World,
}

impl Engine for Depth {
    fn name(&self) -> &str {
        "depth"
    }

    fn summary(&self) -> &str {
        "how far away things are"
    }

    fn display(&self) -> Display {
        Display::Brightest { white: 1.0 }
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, _plan: &Plan) -> Box<dyn Tracer + 's> {
        let camera = PinholeCamera::new(&scene.camera);
        Box::new(DepthTracer { camera, world: World::new(scene) })
    }
}

impl Tracer for DepthTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        counts.primary += 1;
        let hit = self.world.nearest(&self.camera.ray(x, y));
        [hit.map_or(0.0, |hit| 3.0 / (1.0 + hit.distance as f32)); 3]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -4.0, 1.5], [0.0, 0.0, 1.0], 4.0, [320, 240]))
        .shape(Shape::sphere([0.0, 1.0, 1.0], 1.0, Surface::new(Colour::RED)))
        .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], Surface::new(Colour::GREY)))
        .build()?;
    let film = render(&scene, &Depth, &RenderSettings::default())?.film;
    let codes: Vec<u8> = film.pixels().iter().map(|p| (p[0] * 255.0) as u8).collect();
    std::io::stdout().write_all(b"P5\n320 240\n255\n")?;
    Ok(std::io::stdout().write_all(&codes)?)
}
