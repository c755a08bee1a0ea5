//! Spheres and planes that stand by themselves, if they are few: whole registers
//! of rays are held against each, so that for them no hierarchy is needed.

mod candidates;

use crate::Which;
use crate::checker::{self, LaneCells};
use crate::lanes::{Lanes, Mask, Real, Vectors};
use crate::rays::Rays;
use crate::shapes::plane::{HalfSpace, HalfSpaces};
use crate::shapes::sphere::{Ball, Balls};
pub use candidates::{Candidates, Goal};
use lancer_scene::Checker;

/// As many of a kind as there are bits.
pub(crate) const MOST_LISTED: usize = 64;

/// The shapes, each with the number of its item; numbers rise.
#[derive(Debug, Default)]
pub(crate) struct Listed {
    balls: Vec<(u32, Ball)>,
    planes: Vec<(u32, HalfSpace)>,
    transparent_balls: u64,
    transparent_planes: u64,
}

/// The nearest hits of a register of rays.
#[derive(Debug, Clone, Copy)]
pub struct LaneHits<R> {
    /// How many directions away; as far as was asked for where there is none.
    pub t: R,
    /// The numbers of the items; -1 where there is none.
    pub item: R,
    /// The parts.
    pub part: R,
}

/// Points of a surface with what shading needs.
#[derive(Debug, Clone, Copy)]
pub struct LanePoints<R> {
    /// Where they are.
    pub point: Vectors<R>,
    /// As [`SurfacePoint::error`](crate::SurfacePoint::error).
    pub error: R,
    /// The unit normals: outward where the shape is closed.
    pub normal: Vectors<R>,
}

/// A shape that is met in lanes.
#[derive(Debug, Clone, Copy)]
pub struct ListedShape<'a>(Kind<'a>);

#[derive(Debug, Clone, Copy)]
enum Kind<'a> {
    Ball(&'a Ball),
    Plane(&'a HalfSpace),
}

impl ListedShape<'_> {
    /// The points of hits that a register of rays has with it;
    /// [`Prepared::expand`](crate::Prepared::expand) gives the same, one by one.
    #[inline(always)]
    pub fn points<L: Lanes>(&self, rays: &Rays<L>, t: L::Real) -> LanePoints<L::Real> {
        let (point, error, normal) = match self.0 {
            Kind::Ball(ball) => Balls::splat(rays.lanes, ball).contacts(rays, t),
            Kind::Plane(plane) => HalfSpaces::splat(rays.lanes, plane).contacts(rays, t),
        };
        LanePoints { point, error, normal }
    }

    /// Which colours of a checker those points show.
    #[inline(always)]
    pub fn cells<L: Lanes>(
        &self,
        lanes: L,
        points: &LanePoints<L::Real>,
        checker: &Checker,
    ) -> LaneCells<L::Mask> {
        match self.0 {
            Kind::Ball(_) => checker::on_globe(lanes, &points.normal, checker.angle.get()),
            Kind::Plane(plane) => {
                let (first, second) = plane.squares(lanes, &points.point, checker);
                let slack = checker::slacks(lanes, points.error, checker.length.get());
                checker::cells(lanes, first, second, slack)
            }
        }
    }
}

impl Listed {
    pub(crate) fn add_ball(&mut self, item: u32, ball: Ball, transparent: bool) {
        self.transparent_balls |= u64::from(transparent) << self.balls.len();
        self.balls.push((item, ball));
    }

    pub(crate) fn add_plane(&mut self, item: u32, plane: HalfSpace, transparent: bool) {
        self.transparent_planes |= u64::from(transparent) << self.planes.len();
        self.planes.push((item, plane));
    }

    pub(crate) fn all(&self) -> Candidates {
        let ones = |count: usize| (1_u128 << count).wrapping_sub(1) as u64;
        Candidates { balls: ones(self.balls.len()), planes: ones(self.planes.len()) }
    }

    fn of(&self, which: Which) -> Candidates {
        let all = self.all();
        let (balls, planes) = (self.transparent_balls, self.transparent_planes);
        match which {
            Which::All => all,
            Which::Transparent => Candidates { balls, planes },
            Which::Opaque => Candidates { balls: all.balls & !balls, planes: all.planes & !planes },
        }
    }

    /// The nearest hits with 0 < t < `t_max`, those of the first item where several
    /// are equally near. A ray leaves the outside of the ball of the number in `outside`, if
    /// that is one, by more than the error of its point. Cases may be `plain`:
    /// [`Culling::plain_cases`](crate::Culling::plain_cases).
    #[inline(always)]
    pub(crate) fn nearest<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: L::Real,
        (among, outside): (&Candidates, Option<L::Real>),
        plain: bool,
    ) -> LaneHits<L::Real> {
        let lanes = rays.lanes;
        let (zero, every) = (lanes.splat(0.0), lanes.first(L::WIDTH));
        let mut best = LaneHits { t: t_max, item: lanes.splat(-1.0), part: zero };
        let all = self.all();
        let mut asked = among.planes & all.planes;
        while let Some(k) = next_bit(&mut asked) {
            let (item, plane) = &self.planes[k];
            let (ahead, slope) = HalfSpaces::splat(lanes, plane).slopes(rays);
            let may = if plain { may_reach(ahead, slope, best.t, zero) } else { every };
            if may.any() {
                let t = ahead / slope;
                best.consider(t, lanes.splat(f64::from(*item)), may & t.gt(zero));
            }
        }
        let mut asked = among.balls & all.balls;
        if asked == 0 {
            return best;
        }
        let tame = rays.tame();
        while let Some(k) = next_bit(&mut asked) {
            let (item, ball) = &self.balls[k];
            let balls = Balls::splat(lanes, ball);
            let item = lanes.splat(f64::from(*item));
            let mut may = if plain { balls.may_meet(rays, &tame) } else { every };
            if let Some(outside) = outside {
                may = may & (balls.may_come_back(rays, &tame) | !outside.eq(item));
            }
            if may.any() {
                let t = balls.crossings(rays, &tame).ahead(zero);
                best.consider(t, item, may & t.gt(zero));
            }
        }
        best
    }

    /// Which rays hit one of some shapes with 0 < t < `t_max`. All leave the outside of the
    /// ball `outside`, if that is one, by more than the error of their points. Cases
    /// may be `plain` as for [`nearest`](Self::nearest).
    #[inline(always)]
    pub(crate) fn any<L: Lanes>(
        &self,
        rays: &Rays<L>,
        (t_max, which): (f64, Which),
        (among, outside): (&Candidates, Option<u32>),
        plain: bool,
    ) -> L::Mask {
        let (lanes, every) = (rays.lanes, rays.lanes.first(L::WIDTH));
        let (zero, t_max) = (lanes.splat(0.0), lanes.splat(t_max));
        let of = self.of(which);
        let mut met = lanes.mask(0);
        let mut asked = among.planes & of.planes;
        while let Some(k) = next_bit(&mut asked) {
            let (ahead, slope) = HalfSpaces::splat(lanes, &self.planes[k].1).slopes(rays);
            let may = if plain { may_reach(ahead, slope, t_max, zero) } else { every };
            if may.any() {
                let t = ahead / slope;
                met = met | (t.gt(zero) & t.lt(t_max));
            }
        }
        let mut asked = among.balls & of.balls;
        if asked == 0 {
            return met;
        }
        let tame = rays.tame();
        while let Some(k) = next_bit(&mut asked) {
            let (item, ball) = &self.balls[k];
            let balls = Balls::splat(lanes, ball);
            let may = if Some(*item) == outside {
                balls.may_come_back(rays, &tame)
            } else if !plain {
                every
            } else {
                let may = balls.may_meet(rays, &tame);
                if !may.any() {
                    continue;
                }
                met = met | balls.surely_meet(rays, &tame, t_max);
                may & !met
            };
            if may.any() {
                let t = balls.crossings(rays, &tame).ahead(zero);
                met = met | (may & t.gt(zero) & t.lt(t_max));
            }
        }
        met
    }

    /// The shape of that number, if it is listed.
    pub(crate) fn shape(&self, item: u32) -> Option<ListedShape<'_>> {
        if let Ok(k) = self.planes.binary_search_by_key(&item, |(item, _)| *item) {
            return Some(ListedShape(Kind::Plane(&self.planes[k].1)));
        }
        let k = self.balls.binary_search_by_key(&item, |(item, _)| *item).ok()?;
        Some(ListedShape(Kind::Ball(&self.balls[k].1)))
    }

    /// Whether there is nothing of some kind among candidates.
    pub(crate) fn has_none(&self, which: Which, among: &Candidates) -> bool {
        let of = self.of(which);
        among.balls & of.balls == 0 && among.planes & of.planes == 0
    }
}

impl<R: Real> LaneHits<R> {
    #[inline(always)]
    fn consider(&mut self, t: R, item: R, met: R::Mask) {
        let nearer = met & (t.lt(self.t) | (t.eq(self.t) & item.lt(self.item)));
        self.t = nearer.select(t, self.t);
        self.item = nearer.select(item, self.item);
    }
}

/// Where a plane that is so far ahead may be met before `t` by a ray of that slope: never
/// too few.
#[inline(always)]
fn may_reach<R: Real>(ahead: R, slope: R, t: R, zero: R) -> R::Mask {
    // Of different signs it is behind.
    let is_ahead = (ahead.gt(zero) & slope.gt(zero)) | (ahead.lt(zero) & slope.lt(zero));
    // More than the product and the quotient may be rounded, and lose near 0.
    let reach = slope.abs() * (t * (1.0 + 4.0 * f64::EPSILON)) + 1e-300;
    is_ahead & ahead.abs().lt(reach)
}

/// Takes the lowest bit that is set, and says where it was.
#[inline(always)]
fn next_bit(bits: &mut u64) -> Option<usize> {
    if *bits == 0 {
        return None;
    }
    let place = bits.trailing_zeros() as usize;
    *bits &= *bits - 1;
    Some(place)
}
