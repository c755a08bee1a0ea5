//! What a pixel sees: Whitted's tree of rays, with nothing kept from one ray for
//! the next but where it starts and which way it goes.

use crate::light::{Lit, light, transmittance};
use crate::optics::{Refraction, reflect, refract, sheet};
use crate::pattern::albedo;
use crate::stops::{Stop, medium, top, way};
use crate::{Crossing, Hit, Line, Number, Triple, World, pixel_line};
use lancer_scene::{Scene, Surface};

/// Red, green and blue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb(pub [Number; 3]);

impl Rgb {
    pub(crate) fn black() -> Self {
        Self([Number::zero(), Number::zero(), Number::zero()])
    }

    pub(crate) fn white() -> Self {
        Self([Number::one(), Number::one(), Number::one()])
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([a + x, b + y, c + z])
    }

    /// Component by component.
    pub(crate) fn filtered(&self, other: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (&self.0, &other.0);
        Self([a * x, b * y, c * z])
    }

    pub(crate) fn times(&self, factor: &Number) -> Self {
        Self(self.0.each_ref().map(|c| c * factor))
    }

    pub(crate) fn rounded(&self, bits: usize) -> Self {
        Self(self.0.each_ref().map(|c| c.rounded(bits)))
    }

    /// The nearest doubles.
    #[must_use]
    pub fn to_f64(&self) -> [f64; 3] {
        self.0.each_ref().map(Number::to_f64)
    }
}

/// What a ray comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The eye.
    Primary,
    /// A surface that mirrors.
    Reflected,
    /// A surface that lets light through.
    Transmitted,
}

/// A ray, what it meets, and the rays that begin there.
#[derive(Clone, Debug)]
pub struct Branch {
    /// What it comes from.
    pub kind: Kind,
    /// Where it goes; of length 1, so that t is a distance.
    pub line: Line,
    /// How much of what it sees is in the pixel.
    pub share: Rgb,
    /// The solid whose medium it goes through, by its number; `None` in the air.
    pub medium: Option<usize>,
    /// What it meets; `None` where there is nothing.
    pub stop: Option<Stop>,
    /// What is added to the pixel there: emission and matte light, or the background.
    pub added: Rgb,
    /// The rays that begin there.
    pub branches: Vec<Branch>,
}

/// What a pixel sees, and how.
#[derive(Clone, Debug)]
pub struct Pixel {
    /// The radiance of its centre's ray.
    pub radiance: Rgb,
    /// The sum of the shares of rays that were not followed: where none of those would
    /// have seen anything brighter than 1, so much is missing at most.
    pub missing: f64,
    /// The least margin of all decisions on the way, each as its own function says;
    /// 0 where two surfaces are too near to each other for doubles.
    pub margin: f64,
    /// The rays.
    pub tree: Branch,
}

/// Follows rays through a scene.
#[derive(Clone, Debug)]
pub struct Tracer<'a> {
    scene: &'a Scene,
    world: World<'a>,
    least_share: f64,
    most_rays: u32,
}

/// What is noted while a pixel is followed.
struct Notes {
    radiance: Rgb,
    missing: f64,
    margin: f64,
    rays: u32,
}

impl<'a> Tracer<'a> {
    /// For a scene, with so many bits. Rays are followed if their share of the
    /// pixel is at least `least_share`, and no more than `most_rays` of them.
    #[must_use]
    pub fn new(scene: &'a Scene, bits: usize, least_share: f64, most_rays: u32) -> Self {
        Self { scene, world: World::new(scene, bits), least_share, most_rays }
    }

    /// The shapes.
    #[must_use]
    pub fn world(&self) -> &World<'a> {
        &self.world
    }

    /// What pixel (`x`, `y`) sees. Through a lens, and where a lamp with a radius may shine,
    /// nothing is sure: the margin is 0.
    #[must_use]
    pub fn follow(&self, x: u32, y: u32) -> Pixel {
        let line = pixel_line(&self.scene.camera, x, y, self.world.bits());
        let margin = if self.scene.camera.aperture.is_some() { 0.0 } else { f64::INFINITY };
        let mut notes = Notes { radiance: Rgb::black(), missing: 0.0, margin, rays: 0 };
        let tree = self.branch(Kind::Primary, line, Rgb::white(), &mut notes);
        Pixel { radiance: notes.radiance, missing: notes.missing, margin: notes.margin, tree }
    }

    fn branch(&self, kind: Kind, line: Line, share: Rgb, notes: &mut Notes) -> Branch {
        notes.rays += 1;
        let (world, bits) = (&self.world, self.world.bits());
        let mut way = way(world, &line, None, true);
        notes.margin = notes.margin.min(way.margin);
        let mut branch = Branch {
            kind,
            line,
            share,
            medium: None,
            stop: None,
            added: Rgb::black(),
            branches: vec![],
        };
        if way.stops.is_empty() {
            branch.medium = top(world, &way.last);
            let left = transmittance(&medium(world, branch.medium), None, bits);
            let background = Rgb(self.scene.background.get().map(Number::from));
            branch.added = branch.share.filtered(&left).filtered(&background);
            notes.radiance = notes.radiance.plus(&branch.added).rounded(2 * bits);
            return branch;
        }
        let stop = way.stops.remove(0);
        branch.medium = top(world, &stop.before);
        let left = transmittance(&medium(world, branch.medium), Some(&stop.t), bits);
        let arriving = branch.share.filtered(&left).rounded(bits);
        let mut at = At { tracer: self, line: &branch.line, stop: &stop, next: vec![], notes };
        let added = at.surfaces(&arriving);
        let next = std::mem::take(&mut at.next);
        notes.radiance = notes.radiance.plus(&added).rounded(2 * bits);
        branch.added = added;
        for (kind, line, share) in next {
            let size = share.to_f64().into_iter().fold(0.0, f64::max);
            if size >= self.least_share && notes.rays < self.most_rays {
                branch.branches.push(self.branch(kind, line, share, notes));
            } else {
                notes.missing += size;
            }
        }
        branch.stop = Some(stop);
        branch
    }
}

/// A ray at a stop.
struct At<'t, 'a, 'n> {
    tracer: &'t Tracer<'a>,
    line: &'t Line,
    stop: &'t Stop,
    /// The rays that begin here.
    next: Vec<(Kind, Line, Rgb)>,
    notes: &'n mut Notes,
}

/// The normals of a crossing on the side that is seen.
struct Sides {
    facet: Triple,
    shading: Triple,
}

/// How a surface shares light out: to mirror whatever the angle, as a clear
/// surface, and matte.
struct Parts {
    gloss: Number,
    clear: Number,
    matte: Number,
}

impl Parts {
    fn new(surface: &Surface) -> Self {
        let gloss = Number::from(surface.gloss.get());
        let clear = Number::from(surface.transparency.get());
        let rest = Number::one() - &gloss;
        Self { matte: &rest * (Number::one() - &clear), clear: rest * clear, gloss }
    }
}

impl At<'_, '_, '_> {
    fn bits(&self) -> usize {
        self.tracer.world.bits()
    }

    /// All that is seen here of a ray with that share; notes the rays that begin.
    fn surfaces(&mut self, share: &Rgb) -> Rgb {
        let world = &self.tracer.world;
        if let Some(hit) = self.stop.opaque(world) {
            return self.opaque(hit, share);
        }
        let mut share = share.clone();
        let mut added = Rgb::black();
        let here = medium(world, top(world, &self.stop.before));
        for hit in self.stop.sheets(world) {
            let surface = world.items()[hit.item].surface();
            let sides = self.sides(&hit.crossing);
            let cosine = sides.facet.dot(&self.line.direction).abs();
            let (n1, n2) = (here.ior.get(), surface.medium.ior.get());
            let mirrored = sheet(&cosine, n1, n2, self.bits());
            let parts = Parts::new(surface);
            added = added.plus(&self.own(hit.item, &hit.crossing, &sides, &share, &parts));
            self.mirror(&sides, &share.times(&(&parts.gloss + &parts.clear * &mirrored)));
            share = share.times(&(&parts.clear * (Number::one() - mirrored))).rounded(self.bits());
        }
        let Some((item, crossing)) = self.stop.border(world) else {
            self.push(Kind::Transmitted, self.line.direction.clone(), &share);
            return added;
        };
        let surface = world.items()[item].surface();
        let sides = self.sides(crossing);
        let parts = Parts::new(surface);
        added = added.plus(&self.own(item, crossing, &sides, &share, &parts));
        let behind = medium(world, top(world, &self.stop.after));
        match self.refraction(&sides, here.ior.get(), behind.ior.get()) {
            Refraction::Total => {
                self.mirror(&sides, &share.times(&(&parts.gloss + &parts.clear)));
            }
            Refraction::Part { mirrored, direction } => {
                self.mirror(&sides, &share.times(&(&parts.gloss + &parts.clear * &mirrored)));
                let through = share.times(&(&parts.clear * (Number::one() - mirrored)));
                self.push(Kind::Transmitted, direction, &through);
            }
        }
        added
    }

    /// By the normal that light is computed with, unless the ray comes from behind
    /// it or would stay on this side.
    fn refraction(&mut self, sides: &Sides, n1: f64, n2: f64) -> Refraction {
        let direction = &self.line.direction;
        if direction.dot(&sides.shading).signum() < 0 {
            let (bent, sure) = refract(direction, &sides.shading, n1, n2, self.bits());
            self.notes.margin = self.notes.margin.min(sure);
            match &bent {
                Refraction::Part { direction, .. } if direction.dot(&sides.facet).signum() >= 0 => {
                }
                _ => return bent,
            }
        }
        let (bent, sure) = refract(direction, &sides.facet, n1, n2, self.bits());
        self.notes.margin = self.notes.margin.min(sure);
        bent
    }

    fn opaque(&mut self, hit: &Hit, share: &Rgb) -> Rgb {
        let surface = self.tracer.world.items()[hit.item].surface();
        let gloss = Number::from(surface.gloss.get());
        // Whatever its transparency: with a gloss of 1 nothing of it is left.
        let matte = Number::one() - &gloss;
        let parts = Parts { matte, clear: Number::zero(), gloss };
        let sides = self.sides(&hit.crossing);
        let added = self.own(hit.item, &hit.crossing, &sides, share, &parts);
        self.mirror(&sides, &share.times(&parts.gloss));
        added
    }

    fn sides(&mut self, crossing: &Crossing) -> Sides {
        let (facet, shading) = (crossing.normal.clone(), crossing.shading_normal.clone());
        self.notes.margin = self.notes.margin.min(crossing.seam);
        match facet.dot(&self.line.direction).signum() {
            1 => Sides { facet: -&facet, shading: -&shading },
            _ => Sides { facet, shading },
        }
    }

    /// Emission and matte light.
    fn own(
        &mut self,
        item: usize,
        crossing: &Crossing,
        sides: &Sides,
        share: &Rgb,
        parts: &Parts,
    ) -> Rgb {
        let Tracer { scene, world, .. } = self.tracer;
        let of = &world.items()[item];
        let emission = share.filtered(&Rgb(of.surface().emission.get().map(Number::from)));
        if parts.matte.is_zero() {
            return emission;
        }
        let (albedo, border) = albedo(of, &crossing.point, crossing.face, &crossing.normal);
        let lit = Lit { point: &crossing.point, facet: &sides.facet, shading: &sides.shading };
        let (light, sure) = light(scene, world, &lit);
        self.notes.margin = self.notes.margin.min(border).min(sure);
        let matte = share.filtered(&Rgb(albedo)).filtered(&light).times(&parts.matte);
        emission.plus(&matte).rounded(self.bits())
    }

    fn mirror(&mut self, sides: &Sides, share: &Rgb) {
        let bits = self.bits();
        let mut direction = reflect(&self.line.direction, &sides.shading, bits);
        // Not below the surface itself, as another normal might have it.
        if direction.dot(&sides.facet).signum() < 0 {
            direction = reflect(&direction, &sides.facet, bits);
        }
        self.push(Kind::Reflected, direction, share);
    }

    fn push(&mut self, kind: Kind, direction: Triple, share: &Rgb) {
        let origin = self.line.at(&self.stop.t).rounded(self.bits());
        let share = share.rounded(self.bits());
        if share != Rgb::black() {
            self.next.push((kind, Line { origin, direction }, share));
        }
    }
}
