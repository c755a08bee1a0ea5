//! The light of ball lamps that falls on the points of a batch.

use super::Batch;
use super::light::Lit;
use super::places::Places;
use crate::whitted::lights::Source;
use lancer_kernel::Rays;
use lancer_kernel::lanes::{Lanes, MOST, Mask, Vectors, lanes_of};
use lancer_math::Point;

impl<P: Places> Batch<'_, P> {
    /// Adds the light of a ball lamp to what there is, with its mark: each lane finds alone what
    /// [`Lights::gather`](crate::whitted::lights::Lights::gather) does, but for what hides the lamp.
    #[inline(never)]
    pub(super) fn shine_from_ball<L: Lanes>(
        &mut self,
        lanes: L,
        lamp: (&Source, usize, (&Point, f64)),
        dimension: u32,
        lit: Lit<L>,
        is_grey: bool,
        mut to: (Vectors<L::Real>, L::Real),
    ) -> (Vectors<L::Real>, L::Real) {
        lanes.vectorize(
            #[inline(always)]
            || {
                self.look_at_ball(lanes, lamp, dimension, &lit, is_grey, (&mut to.0, &mut to.1));
            },
        );
        to
    }

    #[inline(always)]
    fn look_at_ball<L: Lanes>(
        &mut self,
        lanes: L,
        (source, index, (centre, radius)): (&Source, usize, (&Point, f64)),
        dimension: u32,
        lit: &Lit<L>,
        is_grey: bool,
        (light, marks): (&mut Vectors<L::Real>, &mut L::Real),
    ) {
        let is_clear = is_grey && self.buffers.hiding[index].is_clear;
        let (mut strengths, mut own, mut ends) = ([0.0; MOST], [0.0; MOST], [[0.0; MOST]; 3]);
        let (mut clear, mut asked) = (0, 0);
        for k in lanes_of(lit.matter.bits()) {
            let point = Point::from(lit.point.lane(k));
            let normals = [lit.shading.lane(k), lit.facet.lane(k)];
            let Some((ball, strength, mark)) = source.ball(centre - point, radius, normals) else {
                continue;
            };
            self.counts.shadow += 1;
            (strengths[k], own[k]) = (strength, mark);
            if is_clear && ball.is_before_facet() {
                clear |= 1 << k;
                continue;
            }
            let stream = self.places.task(self.buffers.group.pixel[lit.at + k]).stream;
            let Some(way) = ball.point(stream.pair(dimension)) else { continue };
            asked |= 1 << k;
            for (end, axis) in ends.iter_mut().zip(0..) {
                end[k] = (point + way)[axis];
            }
        }
        let (strength, mark) = (lanes.load(&strengths), lanes.load(&own));
        if clear != 0 {
            let clear = lanes.mask(clear);
            light.x = clear.select(light.x + strength, light.x);
            *marks = clear.select(*marks + mark, *marks);
        }
        if asked == 0 {
            return;
        }
        let ends = Vectors::load(lanes, ends.each_ref().map(|end| &end[..]));
        let rays = Rays::new(lanes, lit.origin, ends - lit.origin);
        let asked = (&rays, 1.0, lanes.mask(asked));
        self.cast(lanes, asked, (strength, mark), (lit.at, index), is_grey, (light, marks));
    }
}
