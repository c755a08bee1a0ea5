use super::lights::Lights;
use super::tile::{Stage, Tile};
use crate::engine::in_parts;
use crate::{Engine, PinholeCamera, Plan, RayCounts, Rgb, Tracer, World};
use lancer_film::Window;
use lancer_kernel::KernelSettings;
use lancer_kernel::lanes::{Width, dispatch};
use lancer_scene::Scene;

/// The original program's recursive engine: lit surfaces, shadows, mirrors to
/// a depth of four, and a glow around visible lights.
///
/// It computes what the original does and in its precision: geometry and sums
/// of light in double, colours in single.
#[derive(Debug, Clone, Copy, Default)]
pub struct Classic;

impl Engine for Classic {
    fn name(&self) -> &str {
        "classic"
    }

    fn summary(&self) -> &str {
        "the original's recursive engine: mirrors, shadows, glow around lights"
    }

    fn warnings(&self, scene: &Scene) -> Vec<crate::Lint> {
        super::warnings(scene)
    }

    fn refusals(&self, scene: &Scene) -> Vec<String> {
        super::refusals(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, plan: &Plan) -> Box<dyn Tracer + 's> {
        Box::new(OriginalTracer::new(scene, &plan.kernel, true))
    }
}

/// The tracer of both of the original's engines.
pub(crate) struct OriginalTracer {
    stage: Stage,
    lanes: Width,
}

impl OriginalTracer {
    /// With mirrors and glow, or without either.
    pub(crate) fn new(scene: &Scene, kernel: &KernelSettings, is_recursive: bool) -> Self {
        let world = World::new(scene);
        let camera = PinholeCamera::new(&scene.camera);
        let lights = Lights::new(scene, &world, &kernel.culling);
        let beacons =
            if is_recursive { lights.beacons(camera.origin(), &world) } else { Vec::new() };
        let own_colour_is_finite = lights.is_finite();
        let stage = Stage {
            camera,
            world,
            lights,
            beacons,
            has_mirrors: is_recursive,
            own_colour_is_finite,
            culling: kernel.culling,
        };
        Self { stage, lanes: kernel.lanes }
    }
}

impl Tracer for OriginalTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        let mut pixel = [[0.0; 3]];
        self.tile(Window { x, y, width: 1, height: 1 }, &mut pixel, counts);
        pixel[0]
    }

    fn tile(&self, window: Window, pixels: &mut [Rgb], counts: &mut RayCounts) {
        let stage = &self.stage;
        in_parts(window, pixels, |window, pixels| {
            dispatch(self.lanes, Tile { stage, window, pixels, counts });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_scene::{Camera, Colour, Light, Shape, Surface};

    #[test]
    fn large_tiles_are_put_together_from_small_ones() {
        let scene = Scene::builder()
            .camera(Camera::new([0.0, -4.0, 0.0], [0.0, -3.0, 0.0], 1.0, [50, 40]))
            .light(Light::sun([0.2, 1.0, -0.3], 1.0))
            .shape(Shape::sphere([0.0; 3], 1.0, Surface::new(Colour::RED)))
            .build()
            .expect("valid");
        let tracer = Classic.prepare(&scene, &Plan::default());
        let mut counts = RayCounts::default();
        let window = Window { x: 3, y: 2, width: 41, height: 35 };
        let mut pixels = vec![[0.0; 3]; 41 * 35];
        tracer.tile(window, &mut pixels, &mut counts);
        assert_eq!(counts.primary, 41 * 35);
        for y in 0..35 {
            for x in 0..41 {
                let pixel = tracer.pixel(3 + x, 2 + y, &mut counts);
                assert_eq!(pixels[(y * 41 + x) as usize], pixel, "{x},{y}");
            }
        }
    }
}
