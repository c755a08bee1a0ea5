use crate::classic::lighting::Lighting;
use crate::{Engine, PinholeCamera, RayCounts, Rgb, Tracer, World};
use lancer_kernel::KernelSettings;
use lancer_scene::Scene;

/// The original program's non-recursive engine: the lit colour of the nearest
/// surface, and black where there is none. No mirrors, no glow.
#[derive(Debug, Clone, Copy, Default)]
pub struct Direct;

impl Engine for Direct {
    fn name(&self) -> &str {
        "direct"
    }

    fn summary(&self) -> &str {
        "the original's simple engine: lit surfaces and shadows, no mirrors, no glow"
    }

    fn warnings(&self, scene: &Scene) -> Vec<String> {
        crate::classic::warnings(scene)
    }

    fn refusals(&self, scene: &Scene) -> Vec<String> {
        crate::classic::refusals(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, _kernel: &KernelSettings) -> Box<dyn Tracer + 's> {
        let world = World::new(scene);
        Box::new(DirectTracer {
            camera: PinholeCamera::new(&scene.camera),
            lighting: Lighting::new(scene, &world),
            world,
        })
    }
}

struct DirectTracer {
    camera: PinholeCamera,
    world: World,
    lighting: Lighting,
}

impl Tracer for DirectTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        let ray = self.camera.ray(x, y);
        counts.primary += 1;
        let Some(hit) = self.world.nearest(&ray) else { return [0.0; 3] };
        let surface = self.world.expand(&ray, hit);
        let light = self.lighting.gather(&self.world, &surface, true, None, counts);
        surface.colour.map(|c| c * light.lit)
    }
}
