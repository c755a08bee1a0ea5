//! Where the rays of a batch come from, and where what they see goes.

use super::buffers::Bundle;
use crate::enclose::{fold, max};
use crate::whitted::signature::{Signed, Signing, Unsigned};
use crate::whitted::tracer::Task;
use crate::whitted::view::View;
use crate::{RayCounts, Rgb, Sample, Seen};
use lancer_film::Window;
use lancer_kernel::lanes::{Lanes, MOST, smaller};

/// The places of a picture that are seen together, no more than a tile has pixels.
pub(super) trait Places {
    type Signing: Signing<Notes = ()>;

    fn count(&self) -> usize;

    /// Column and row of the pixel that a place is for.
    fn pixel(&self, place: u16) -> (u32, u32);

    /// What the ray of a place is followed for.
    fn task(&self, place: u16) -> Task;

    /// Where it is in the picture.
    fn at(&self, place: u16) -> [f64; 2];

    /// Their rays where there is no lens, and the rectangle of the picture that they are in: its left, top, right and
    /// bottom.
    fn rays<L: Lanes>(&self, lanes: L, view: &View, rays: &mut Bundle) -> [f64; 4];

    /// Their rays through a lens.
    #[inline(never)]
    fn through_lens(&self, view: &View, rays: &mut Bundle) {
        for k in 0..self.count() {
            let place = k as u16;
            let ray = view.ray_of_sample(self.at(place), self.task(place).stream);
            for axis in 0..3 {
                rays.origin.0[axis][k] = ray.origin[axis];
                rays.direction.0[axis][k] = ray.direction[axis];
            }
        }
    }

    /// Keeps what is seen at each, with its signature if that is asked for.
    fn keep(&mut self, seen: impl Iterator<Item = (Rgb, u64)>, counts: &mut RayCounts);
}

/// A tile's pixels, seen at their centres.
pub(super) struct Pixels<'a> {
    pub(super) window: Window,
    pub(super) colours: &'a mut [Rgb],
}

impl Places for Pixels<'_> {
    type Signing = Unsigned;

    #[inline(always)]
    fn count(&self) -> usize {
        self.window.pixels() as usize
    }

    fn pixel(&self, place: u16) -> (u32, u32) {
        let place = u32::from(place);
        (self.window.x + place % self.window.width, self.window.y + place / self.window.width)
    }

    fn task(&self, place: u16) -> Task {
        Task::of_pixel(self.pixel(place))
    }

    fn at(&self, place: u16) -> [f64; 2] {
        let (x, y) = self.pixel(place);
        [f64::from(x) + 0.5, f64::from(y) + 0.5]
    }

    #[inline(always)]
    fn rays<L: Lanes>(&self, lanes: L, view: &View, rays: &mut Bundle) -> [f64; 4] {
        let Window { x, y, width, height, .. } = self.window;
        let steps: [f64; MOST] = std::array::from_fn(|k| k as f64);
        let steps = lanes.load(&steps);
        for row in 0..height {
            let at_y = lanes.splat(f64::from(y + row) + 0.5);
            for column in (0..width).step_by(L::WIDTH) {
                // The last ones of a row are overwritten by the next row.
                let at_x = steps + (f64::from(x + column) + 0.5);
                let (origin, direction) = view.rays(lanes, at_x, at_y);
                let at = (row * width + column) as usize;
                rays.origin.store(lanes, at, &origin);
                rays.direction.store(lanes, at, &direction);
            }
        }
        [x, y, x + width, y + height].map(f64::from)
    }

    #[inline(always)]
    fn keep(&mut self, seen: impl Iterator<Item = (Rgb, u64)>, counts: &mut RayCounts) {
        let mut all_finite = true;
        for (colour, (seen, _)) in self.colours.iter_mut().zip(seen) {
            *colour = seen;
            all_finite &= is_finite(seen);
        }
        if all_finite {
            return;
        }
        for k in 0..self.colours.len() {
            if !is_finite(self.colours[k]) {
                counts.troubles.not_finite.at(self.pixel(k as u16));
                self.colours[k] = [0.0; 3];
            }
        }
    }
}

/// Samples, and what they see.
pub(super) struct Samples<'a> {
    pub(super) samples: &'a [Sample],
    pub(super) seen: &'a mut [Seen],
}

impl Places for Samples<'_> {
    type Signing = Signed;

    #[inline(always)]
    fn count(&self) -> usize {
        self.samples.len()
    }

    fn pixel(&self, place: u16) -> (u32, u32) {
        self.samples[usize::from(place)].pixel
    }

    fn task(&self, place: u16) -> Task {
        Task::of_sample(&self.samples[usize::from(place)])
    }

    fn at(&self, place: u16) -> [f64; 2] {
        self.samples[usize::from(place)].place
    }

    #[inline(always)]
    fn rays<L: Lanes>(&self, lanes: L, view: &View, rays: &mut Bundle) -> [f64; 4] {
        // Beyond the last one there may be anything that is no stranger than the others.
        let [first_x, first_y] = self.samples.first().map_or([0.0; 2], |sample| sample.place);
        let (mut x, mut y) = ([first_x; MOST], [first_y; MOST]);
        let far = lanes.splat(f64::INFINITY);
        let (mut least, mut most) = ([far; 2], [-far; 2]);
        for (samples, at) in self.samples.chunks(L::WIDTH).zip((0..).step_by(L::WIDTH)) {
            for (sample, (to_x, to_y)) in samples.iter().zip(x.iter_mut().zip(&mut y)) {
                [*to_x, *to_y] = sample.place;
            }
            let (at_x, at_y) = (lanes.load(&x), lanes.load(&y));
            least = [smaller(at_x, least[0]), smaller(at_y, least[1])];
            most = [max(at_x, most[0]), max(at_y, most[1])];
            let (origin, direction) = view.rays(lanes, at_x, at_y);
            rays.origin.store(lanes, at, &origin);
            rays.direction.store(lanes, at, &direction);
        }
        // That of whole pixels, so that it has a size.
        let [left, top] = least.map(|least| fold(lanes, least, f64::min).floor());
        let [right, bottom] = most.map(|most| fold(lanes, most, f64::max).floor() + 1.0);
        [left, top, right, bottom]
    }

    #[inline(always)]
    fn keep(&mut self, seen: impl Iterator<Item = (Rgb, u64)>, counts: &mut RayCounts) {
        for ((to, sample), (radiance, signature)) in
            self.seen.iter_mut().zip(self.samples).zip(seen)
        {
            *to = Seen { radiance, signature };
            if !is_finite(radiance) {
                counts.troubles.not_finite.at(sample.pixel);
                to.radiance = [0.0; 3];
            }
        }
    }
}

#[inline(always)]
fn is_finite(colour: Rgb) -> bool {
    // Nothing times what is infinite or not a number is not a number.
    (colour[0] + colour[1] + colour[2]) * 0.0 == 0.0
}
