use super::eye::Eye;
use super::lanes::LANES;
use super::lighting::Lighting;
use crate::{Engine, Hit, PinholeCamera, RayCounts, Rgb, Tracer, World};
use lancer_film::Window;
use lancer_kernel::KernelSettings;
use lancer_math::{Ray, Vector};
use lancer_scene::Scene;

/// The original program's recursive engine: lit surfaces, shadows, mirrors to
/// a depth of four, and a glow around visible lights.
///
/// It computes what the original does and in its precision: geometry and sums
/// of light in double, colours in single. Three shortcuts change no bit: a
/// reflected ray's glow reuses what is known of the lights from the point that
/// it leaves, planes that cannot hide a light are not asked, and a perfect
/// mirror's own colour is not computed.
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

    fn refusals(&self, scene: &Scene) -> Vec<String> {
        super::refusals(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, _kernel: &KernelSettings) -> Box<dyn Tracer + 's> {
        let world = World::new(scene);
        let lighting = Lighting::new(scene, &world);
        let eye = Eye::new(PinholeCamera::new(&scene.camera), &world, &lighting);
        let own_colour_is_finite = lighting.is_finite();
        Box::new(ClassicTracer { eye, world, lighting, own_colour_is_finite })
    }
}

struct ClassicTracer {
    eye: Eye,
    world: World,
    lighting: Lighting,
    own_colour_is_finite: bool,
}

/// A mirror whose share of the pixel is smaller is shown matte.
const LEAST_SHARE: f64 = 0.01;

/// How many mirrors a ray is followed through.
const MOST_MIRRORS: u32 = 4;

impl Tracer for ClassicTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        let mut pixel = [[0.0; 3]];
        self.neighbours(x, y, &mut pixel, counts);
        pixel[0]
    }

    fn tile(&self, tile: Window, pixels: &mut [Rgb], counts: &mut RayCounts) {
        for (row, y) in pixels.chunks_mut(tile.width as usize).zip(tile.y..) {
            for (neighbours, x) in row.chunks_mut(LANES).zip((tile.x..).step_by(LANES)) {
                self.neighbours(x, y, neighbours, counts);
            }
        }
    }
}

impl ClassicTracer {
    /// The colours of up to four pixels from column `x` of row `y` on.
    fn neighbours(&self, x: u32, y: u32, pixels: &mut [Rgb], counts: &mut RayCounts) {
        let views = self.eye.look(&self.world, x, y);
        counts.primary += pixels.len() as u64;
        for (k, pixel) in pixels.iter_mut().enumerate() {
            let (ray, hit) = views.lane(&self.eye, k);
            *pixel = self.colour(&ray, hit, views.glow[k], 1.0, 0, counts);
        }
    }

    /// The colour of a ray that meets that and along which the lights glow so
    /// brightly; `share` is its share of the pixel, `depth` the number of
    /// mirrors before it.
    fn colour(
        &self,
        ray: &Ray,
        hit: Option<Hit>,
        glow: f32,
        share: f32,
        depth: u32,
        counts: &mut RayCounts,
    ) -> Rgb {
        let glow = 255.0 * glow;
        let Some(hit) = hit else { return [glow; 3] };
        let surface = self.world.expand(ray, hit);
        let gloss = surface.gloss;
        if gloss == 0.0 || f64::from(share) < LEAST_SHARE || depth >= MOST_MIRRORS {
            let light = self.lighting.gather(&self.world, &surface, true, None, counts);
            return surface.colour.map(|c| c * light.lit + glow);
        }

        let mirrored = Ray::new(surface.point, reflect(ray.direction, surface.normal));
        // What a perfect mirror adds of its own is 0 times a finite number.
        let want_own = !(gloss == 1.0 && self.own_colour_is_finite && glow.is_finite());
        let light = self.lighting.gather(
            &self.world,
            &surface,
            want_own,
            Some(&mirrored.direction),
            counts,
        );
        counts.reflected += 1;
        let hit = self.world.nearest(&mirrored);
        let reflected = self.colour(&mirrored, hit, light.glow, share * gloss, depth + 1, counts);
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
