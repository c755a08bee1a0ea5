//! The light of lamps, spots and suns that falls on the points of a batch.

use super::buffers::Buffers;
use super::shade::{Around, leaving};
use super::{Tile, dot};
use crate::whitted::lights::{From, Source};
use crate::whitted::media::Media;
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors, lanes_of};
use lancer_kernel::{Candidates, Goal, Rays, Which};
use lancer_scene::Falloff;

impl Tile<'_> {
    /// The radiance of a white matte surface at each point of the group: each lane
    /// computes what [`Lights::gather`](crate::whitted::lights::Lights::gather) does.
    #[inline(always)]
    pub(super) fn gather<L: Lanes>(&mut self, lanes: L, item: u32, around: &Around) {
        let Buffers { group, sights, .. } = &mut *self.buffers;
        // Opaque surfaces leave light its colour.
        sights.is_grey = !self.tracer.prepared.has_transparent();
        let colours = if sights.is_grey { 1 } else { 3 };
        for light in &mut sights.light.0[..colours] {
            light[..group.count].fill(0.0);
        }
        for index in 0..self.tracer.lights.lights.len() {
            let source = &self.tracer.lights.lights[index];
            let goal = match &source.place {
                From::Point(point) => Goal::Point(*point),
                From::Direction(direction) => Goal::Direction(*direction),
            };
            let culling = &self.tracer.kernel.culling;
            let among = if culling.shadow_candidates {
                let leaving = around.side.filter(|_| culling.idle_planes).map(|side| (item, side));
                let Around { centre, radius, .. } = around;
                self.tracer.prepared.candidates_between(centre, *radius, &goal, leaving)
            } else {
                Candidates::ALL
            };
            for at in (0..self.buffers.group.count).step_by(L::WIDTH) {
                self.shine(lanes, source, at, (&among, around.outside));
            }
        }
    }

    /// Adds the light of one source at the points of a register.
    #[inline(always)]
    fn shine<L: Lanes>(
        &mut self,
        lanes: L,
        source: &Source,
        at: usize,
        (among, outside): (&Candidates, Option<u32>),
    ) {
        let zero = lanes.splat(0.0);
        let prepared = &self.tracer.prepared;
        let Buffers { group, sights, .. } = &mut *self.buffers;
        let point = sights.point.load(lanes, at);
        let facet = sights.facet.load(lanes, at);
        let shading = if sights.is_smooth { sights.shading.load(lanes, at) } else { facet };
        let (way, squared, t_max) = match &source.place {
            From::Direction(direction) => {
                (Vectors::splat(lanes, direction), lanes.splat(1.0), f64::INFINITY)
            }
            From::Point(lamp) => {
                let way = Vectors::splat_point(lanes, lamp) - point;
                (way, dot(&way, &way), 1.0)
            }
        };
        let along = dot(&way, &shading);
        let is_lit = along.gt(zero) & dot(&way, &facet).gt(zero);
        let mut asked = lanes.first(group.count - at) & is_lit;
        if !sights.all_matter {
            let matte = sights.matte.load(lanes, at);
            asked = asked & !(matte.x.eq(zero) & matte.y.eq(zero) & matte.z.eq(zero));
        }
        if !asked.any() {
            return;
        }
        let distance = squared.sqrt();
        let bright = lanes.splat(source.brightness) * along;
        let mut strength = match source.falloff {
            Falloff::Square => bright / (squared * distance),
            Falloff::None => bright / distance,
        };
        if let Some(beam) = &source.beam {
            let mut shares = [0.0; MOST];
            for k in lanes_of(asked.bits()) {
                shares[k] = beam.share(&(way.lane(k) / -distance.lane(k)));
            }
            strength = strength * lanes.load(&shares);
        }
        let asked = asked & !strength.eq(zero);
        self.counts.shadow += u64::from(asked.bits().count_ones());
        let away = leaving(lanes, &way, &facet, lanes.load(&sights.error[at..]));
        let origin = point + facet * away;
        let direction = match &source.place {
            From::Direction(_) => way,
            From::Point(lamp) => Vectors::splat_point(lanes, lamp) - origin,
        };
        let rays = Rays::new(lanes, origin, direction);
        let hidden = prepared.any_in_lanes(&rays, t_max, asked, Which::Opaque, (among, outside));
        let arrives = asked & !hidden;
        if sights.is_grey {
            let sum = lanes.load(&sights.light.0[0][at..]);
            arrives.select(sum + strength, sum).store(&mut sights.light.0[0][at..]);
            return;
        }
        for k in lanes_of(arrives.bits()) {
            let place = super::Places::place(&self.window, group.pixel[at + k]);
            let through = self.tracer.lights.through(
                prepared,
                &rays.lane(k),
                t_max,
                &Media::default(),
                self.counts,
                place,
            );
            for (light, through) in sights.light.0.iter_mut().zip(through) {
                if through != 0.0 {
                    light[at + k] += strength.lane(k) * through;
                }
            }
        }
    }
}
