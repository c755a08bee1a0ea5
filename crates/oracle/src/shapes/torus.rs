//! Tori: (|p|^2 + ring^2 - tube^2)^2 = 4 ring^2 rho^2 with rho the distance from the
//! axis. All is multiplied by the square of the axis, whose length is any.

use crate::crossing::{Found, Local, ratio};
use crate::{Line, Number, Passage, Place, Polynomial, Space, Triple};
use lancer_scene::Torus;

struct Ring {
    centre: Triple,
    axis: Triple,
    axis_squared: Number,
    ring_squared: Number,
    tube_squared: Number,
}

impl Ring {
    fn new(torus: &Torus, space: &Space) -> Self {
        let axis: Triple = torus.axis.get().into();
        Self {
            centre: space.point(torus.centre.get()),
            axis_squared: axis.norm_squared(),
            axis,
            ring_squared: space.length(torus.ring()).squared(),
            tube_squared: space.length(torus.tube()).squared(),
        }
    }

    /// Below 0 inside; `p` is seen from the centre.
    fn value(&self, p: &Triple) -> Number {
        let sum = p.norm_squared() + &self.ring_squared - &self.tube_squared;
        let height = p.dot(&self.axis);
        let around = p.norm_squared() * &self.axis_squared - height.squared();
        sum.squared() * &self.axis_squared - Number::from(4) * &self.ring_squared * around
    }

    /// Its values along a line seen from the centre.
    fn along(&self, line: &Line) -> Polynomial {
        let squared = Polynomial::new(vec![
            line.origin.norm_squared(),
            line.origin.dot(&line.direction) * Number::from(2),
            line.direction.norm_squared(),
        ]);
        let height =
            Polynomial::new(vec![line.origin.dot(&self.axis), line.direction.dot(&self.axis)]);
        let constant = Polynomial::new(vec![&self.ring_squared - &self.tube_squared]);
        let sum = squared.plus(&constant);
        let minus = Number::from(-1);
        let around = squared.scaled(&self.axis_squared).plus(&height.times(&height).scaled(&minus));
        let factor = Number::from(-4) * &self.ring_squared;
        sum.times(&sum).scaled(&self.axis_squared).plus(&around.scaled(&factor))
    }

    /// The gradient over 4.
    fn gradient(&self, p: &Triple) -> Triple {
        let sum = p.norm_squared() + &self.ring_squared - &self.tube_squared;
        let height = p.dot(&self.axis);
        let around = &p.times(&self.axis_squared) - &self.axis.times(&height);
        let double = Number::from(2) * &self.ring_squared;
        &p.times(&(sum * &self.axis_squared)) - &around.times(&double)
    }
}

/// The ring, the line seen from its centre, and the ring's values along that.
fn seen(torus: &Torus, space: &Space, line: &Line) -> (Ring, Line, Polynomial) {
    let ring = Ring::new(torus, space);
    let line = Line { origin: &line.origin - &ring.centre, direction: line.direction.clone() };
    let quartic = ring.along(&line);
    (ring, line, quartic)
}

pub(super) fn meet(torus: &Torus, space: &Space, line: &Line, bits: usize) -> Found {
    let (ring, line, quartic) = seen(torus, space, line);
    // How deep the line dips in or how high it rises between crossings: values
    // grow by about 8 ring^2 tube for each unit of length.
    let tube_fourth = &ring.tube_squared * &ring.ring_squared * &ring.axis_squared;
    let unit = Number::from(8) * tube_fourth;
    let turns = quartic.derivative().roots(80);
    let depths = turns.iter().map(|turn| ratio(&quartic.value(&turn.place), &unit));
    let margin = depths.fold(f64::INFINITY, f64::min);
    Found { list: crossed(&ring, &line, &quartic, bits), margin }
}

/// Without the margin.
pub(super) fn list(torus: &Torus, space: &Space, line: &Line, bits: usize) -> Vec<Local> {
    let (ring, line, quartic) = seen(torus, space, line);
    crossed(&ring, &line, &quartic, bits)
}

fn crossed(ring: &Ring, line: &Line, quartic: &Polynomial, bits: usize) -> Vec<Local> {
    let list = quartic.roots(bits).into_iter().map(|root| {
        let gradient = ring.gradient(&line.at(&root.place));
        // Where a tube as wide as the ring closes the hole it has no normal.
        let normal = if gradient.is_zero() { ring.axis.clone() } else { gradient };
        let passage = match root.signs {
            [1, -1] => Passage::Enters,
            [-1, 1] => Passage::Leaves,
            _ => Passage::Touches,
        };
        let t = root.place;
        Local { t, normal, shading_normal: None, passage, face: 0, seam: f64::INFINITY }
    });
    list.collect()
}

pub(super) fn place(torus: &Torus, space: &Space, p: &Triple) -> Place {
    let ring = Ring::new(torus, space);
    Place::of_sign(&ring.value(&(p - &ring.centre)))
}
