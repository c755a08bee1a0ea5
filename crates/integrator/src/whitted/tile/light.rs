//! The light of lamps, spots and suns that falls on the points of a batch.

use super::buffers::{Buffers, Hiding};
use super::places::Places;
use super::shade::Around;
use super::{Batch, dot};
use crate::whitted::lights::{From, Source};
use crate::whitted::media::Media;
use crate::whitted::signature::{Signing, Spot, Way};
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors, lanes_of};
use lancer_kernel::{Candidates, Goal, LEAN, Rays, Which, not_lean};
use lancer_math::Vector;
use lancer_scene::Falloff;

/// The points of a register.
#[derive(Clone, Copy)]
pub(super) struct Lit<L: Lanes> {
    /// The place of the first one in the group.
    pub(super) at: usize,
    /// Those that light matters to.
    pub(super) matter: L::Mask,
    pub(super) point: Vectors<L::Real>,
    pub(super) facet: Vectors<L::Real>,
    pub(super) shading: Vectors<L::Real>,
    /// Where rays to what is above the facet start.
    pub(super) origin: Vectors<L::Real>,
}

impl<P: Places> Batch<'_, P> {
    /// Adds what light makes of the matte part of what the group sees, whose share is `matte`:
    /// the radiance of a white surface is what each lane computes as
    /// [`Lights::gather`](crate::whitted::lights::Lights::gather) does.
    #[inline(always)]
    pub(super) fn gather<L: Lanes>(
        &mut self,
        lanes: L,
        matte: f64,
        (item, way): (u32, Way),
        around: &Around,
    ) {
        let tracer = self.tracer;
        let sources = &tracer.lights.lights;
        // Opaque surfaces leave light its colour.
        let is_grey = !tracer.prepared.has_transparent();
        self.hide(item, around);
        let in_order = self.is_in_order();
        let zero = lanes.splat(0.0);
        let count = self.buffers.group.count;
        for at in (0..count).step_by(L::WIDTH) {
            let Buffers { group, sights, .. } = &*self.buffers;
            let share = group.share.load(lanes, at) * lanes.splat(matte);
            let albedo = sights.albedo.load(lanes, at);
            let share =
                Vectors { x: share.x * albedo.x, y: share.y * albedo.y, z: share.z * albedo.z };
            let nothing = share.x.eq(zero) & share.y.eq(zero) & share.z.eq(zero);
            let matter = lanes.first(count - at) & !nothing;
            if !matter.any() {
                continue;
            }
            let (point, facet) = (sights.point.load(lanes, at), sights.facet.load(lanes, at));
            let shading = if sights.is_smooth { sights.shading.load(lanes, at) } else { facet };
            // As `SurfacePoint::leave` has it.
            let origin = point + facet * (lanes.load(&sights.error[at..]) * 2.0);
            let lit = Lit { at, matter, point, facet, shading, origin };
            let mut light = Vectors::splat(lanes, &Vector::zeros());
            let mut marks = lanes.load(&sights.lit[at..]);
            for (index, source) in sources.iter().enumerate() {
                self.shine(lanes, (source, index, way), &lit, is_grey, (&mut light, &mut marks));
            }
            if P::Signing::SIGNED {
                marks.store(&mut self.buffers.sights.lit[at..]);
            }
            if is_grey {
                (light.y, light.z) = (light.x, light.x);
            }
            let Buffers { group, radiance, .. } = &mut *self.buffers;
            let lights = [(share.x, light.x), (share.y, light.y), (share.z, light.z)];
            for (radiance, (share, light)) in radiance.0.iter_mut().zip(lights) {
                // Nothing of something infinite is nothing.
                let nothing = share.eq(zero) | light.eq(zero);
                let seen = nothing.select(zero, share * light);
                if in_order {
                    // What is added beyond the last pixel is never looked at.
                    let sum = lanes.load(&radiance[at..]) + seen;
                    sum.store(&mut radiance[at..]);
                    continue;
                }
                for k in 0..L::WIDTH.min(count - at) {
                    radiance[usize::from(group.pixel[at + k])] += seen.lane(k);
                }
            }
        }
    }

    /// Whether the group has a ray for each pixel, in their order.
    #[inline(always)]
    fn is_in_order(&self) -> bool {
        let group = &self.buffers.group;
        group.count == self.places.count()
            && group.pixel[..group.count].iter().zip(0..).fold(true, |all, (p, k)| all & (*p == k))
    }

    /// Finds what may hide each light from the points of the group.
    fn hide(&mut self, item: u32, around: &Around) {
        let prepared = &self.tracer.prepared;
        let culling = &self.tracer.kernel.culling;
        let Around { centre, radius, .. } = around;
        let leaving = around.side.filter(|_| culling.idle_planes).map(|side| (item, side));
        self.buffers.hiding.clear();
        for source in &self.tracer.lights.lights {
            let goal = match &source.place {
                From::Point(point) => Goal::Point(*point),
                From::Direction(direction) => Goal::Direction(*direction),
                From::Ball(centre, radius) => Goal::Ball(*centre, *radius),
            };
            let among = if culling.shadow_candidates {
                prepared.candidates_between(centre, *radius, &goal, leaving)
            } else {
                Candidates::ALL
            };
            let is_clear = prepared.is_clear(Which::Opaque, &among);
            let outside = around.outside;
            self.buffers.hiding.push(Hiding { among, outside, is_clear });
        }
    }

    /// Adds the light of one source, all of it to the first colour if it is grey, and where it
    /// arrives its marks.
    #[inline(always)]
    fn shine<L: Lanes>(
        &mut self,
        lanes: L,
        (source, index, met_on): (&Source, usize, Way),
        lit: &Lit<L>,
        is_grey: bool,
        (light, marks): (&mut Vectors<L::Real>, &mut L::Real),
    ) {
        let zero = lanes.splat(0.0);
        let (way, squared, lamp) = match &source.place {
            From::Direction(direction) => {
                (Vectors::splat(lanes, direction), lanes.splat(1.0), None)
            }
            From::Point(lamp) => {
                let way = Vectors::splat_point(lanes, lamp) - lit.point;
                (way, dot(&way, &way), Some(lamp))
            }
            From::Ball(centre, radius) => {
                not_lean();
                let numbers = source.dimension(met_on);
                let ball = (source, index, (centre, *radius));
                // By value, so that they may stay in registers elsewhere.
                let to = (*light, *marks);
                (*light, *marks) = self.shine_from_ball(lanes, ball, numbers, *lit, is_grey, to);
                return;
            }
        };
        let along = dot(&way, &lit.shading);
        let is_lit = along.gt(zero) & dot(&way, &lit.facet).gt(zero);
        let asked = lit.matter & is_lit;
        if !asked.any() {
            return;
        }
        let distance = squared.sqrt();
        let bright = lanes.splat(source.brightness) * along;
        let mut strength = match source.falloff {
            Falloff::Square => bright / (squared * distance),
            Falloff::None => bright / distance,
        };
        let mut mark = lanes.splat(source.marks[0]);
        if let Some(beam) = source.beam.as_ref().filter(|_| !LEAN) {
            let mut shares = [0.0; MOST];
            for k in lanes_of(asked.bits()) {
                shares[k] = beam.share(&(way.lane(k) / -distance.lane(k)));
            }
            let shares = lanes.load(&shares);
            // Nothing of something infinite is nothing.
            strength = shares.eq(zero).select(zero, strength * shares);
            let all = shares.eq(lanes.splat(1.0));
            mark = all.select(mark, lanes.splat(source.marks[1]));
        }
        let asked = asked & !strength.eq(zero);
        self.counts.shadow += u64::from(asked.bits().count_ones());
        if is_grey && self.buffers.hiding[index].is_clear {
            light.x = asked.select(light.x + strength, light.x);
            *marks = asked.select(*marks + mark, *marks);
            return;
        }
        let (direction, t_max) = match lamp {
            None => (way, f64::INFINITY),
            Some(lamp) => (Vectors::splat_point(lanes, lamp) - lit.origin, 1.0),
        };
        let rays = Rays::new(lanes, lit.origin, direction);
        let to = (light, marks);
        self.cast(lanes, (&rays, t_max, asked), (strength, mark), (lit.at, index), is_grey, to);
    }

    /// Adds what arrives of light of a strength that comes along rays, against them, from `t_max`.
    #[inline(always)]
    pub(super) fn cast<L: Lanes>(
        &mut self,
        lanes: L,
        (rays, t_max, asked): (&Rays<L>, f64, L::Mask),
        (strength, mark): (L::Real, L::Real),
        (at, index): (usize, usize),
        is_grey: bool,
        (light, marks): (&mut Vectors<L::Real>, &mut L::Real),
    ) {
        let Hiding { among, outside, .. } = &self.buffers.hiding[index];
        let prepared = &self.tracer.prepared;
        let hidden = prepared.any_in_lanes(rays, t_max, asked, Which::Opaque, (among, *outside));
        let arrives = asked & !hidden;
        if is_grey {
            light.x = arrives.select(light.x + strength, light.x);
            *marks = arrives.select(*marks + mark, *marks);
            return;
        }
        let mut more = [[0.0; MOST]; 3];
        let mut some = 0;
        for k in lanes_of(arrives.bits()) {
            let pixel = self.places.pixel(self.buffers.group.pixel[at + k]);
            let (ray, media, mut spot) = (rays.lane(k), Media::default(), Spot::default());
            let (on, to) = ((&ray, t_max), (&mut spot, &mut *self.counts));
            let through = self.tracer.lights.through::<P::Signing>(prepared, on, &media, to, pixel);
            if P::Signing::SIGNED && through != [0.0; 3] {
                some |= 1 << k;
                let piece = &mut self.buffers.sights.piece[at + k];
                *piece = piece.wrapping_add(spot.piece);
            }
            for (more, through) in more.iter_mut().zip(through) {
                // Nothing of something infinite is nothing.
                if through != 0.0 {
                    more[k] = strength.lane(k) * through;
                }
            }
        }
        *light = *light + Vectors::load(lanes, more.each_ref().map(|more| &more[..]));
        *marks = lanes.mask(some).select(*marks + mark, *marks);
    }
}
