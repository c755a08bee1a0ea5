use super::lighting::{Lighting, Seen};
use crate::{Engine, PinholeCamera, RayCounts, Rgb, Tracer, World};
use lancer_math::{Ray, Vector};
use lancer_scene::Scene;

/// The original program's recursive engine: lit surfaces, shadows, mirrors to
/// a depth of four, and a glow around visible lights.
///
/// It computes what the original does and in its precision: geometry and sums
/// of light in double, colours in single. Three shortcuts are exact: a
/// reflected ray's glow reuses what is known of the lights from the point that
/// it leaves; a glow too faint to change a bit of the colour that it is added
/// to is not computed; a perfect mirror's own colour is not computed.
#[derive(Debug, Clone, Copy, Default)]
pub struct Classic;

impl Engine for Classic {
    fn name(&self) -> &str {
        "classic"
    }

    fn summary(&self) -> &str {
        "the original's recursive engine: mirrors, shadows, glow around lights"
    }

    fn warnings(&self, scene: &Scene) -> Vec<String> {
        super::warnings(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene) -> Box<dyn Tracer + 's> {
        let camera = PinholeCamera::new(&scene.camera);
        let world = World::new(scene);
        let lighting = Lighting::new(scene, &world);
        let seen_from_eye = lighting.seen_from(camera.origin(), &world);
        Box::new(ClassicTracer {
            own_colour_is_finite: lighting.is_finite(),
            camera,
            world,
            lighting,
            seen_from_eye,
        })
    }
}

struct ClassicTracer {
    camera: PinholeCamera,
    world: World,
    lighting: Lighting,
    seen_from_eye: Seen,
    own_colour_is_finite: bool,
}

/// A mirror whose share of the pixel is smaller is shown matte.
const LEAST_SHARE: f64 = 0.01;

/// How many mirrors a ray is followed through.
const DEEPEST: u32 = 3;

impl Tracer for ClassicTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        counts.primary += 1;
        let ray = self.camera.ray(x, y);
        let glow = self.lighting.glow(&self.seen_from_eye, &ray.direction);
        self.colour(&ray, glow, 1.0, 0, counts)
    }
}

impl ClassicTracer {
    /// The colour of a ray along which the lights glow so brightly; `share` is
    /// its share of the pixel, `depth` the number of mirrors before it.
    fn colour(&self, ray: &Ray, glow: f32, share: f32, depth: u32, counts: &mut RayCounts) -> Rgb {
        let glow = 255.0 * glow;
        let Some(hit) = self.world.nearest(ray) else { return [glow; 3] };
        let surface = self.world.expand(ray, hit);
        let gloss = surface.gloss;
        if gloss == 0.0 || f64::from(share) < LEAST_SHARE || depth > DEEPEST {
            let light = self.lighting.gather(&self.world, &surface, true, None, counts);
            return surface.colour.map(|c| c * light.lit + glow);
        }

        let mirrored = Ray::new(surface.point, reflect(ray.direction, surface.normal));
        // What a perfect mirror adds of its own is 0 times a finite number.
        let want_own = !(gloss == 1.0 && self.own_colour_is_finite);
        let light = self.lighting.gather(
            &self.world,
            &surface,
            want_own,
            Some(&mirrored.direction),
            counts,
        );
        counts.reflected += 1;
        let reflected = self.colour(&mirrored, light.glow, share * gloss, depth + 1, counts);
        if !want_own {
            return reflected;
        }
        let own = surface.colour.map(|c| c * light.lit + glow);
        std::array::from_fn(|i| reflected[i] * gloss + own[i] * (1.0 - gloss))
    }
}

/// The direction in which a mirror with that unit normal sends a ray.
fn reflect(direction: Vector, normal: Vector) -> Vector {
    direction - normal * (2.0 * direction.dot(&normal))
}
