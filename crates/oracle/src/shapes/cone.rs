//! Cylinders, cones and frusta: rho <= r(h) between the ends, with h the height along
//! the axis, from 0 to its square, and r the radius there. All is multiplied by
//! powers of the square of the axis.

use crate::crossing::{Found, Local, ratio, sine};
use crate::quadratic::{Quadratic, Root};
use crate::{Line, Number, Passage, Place, Space, Triple};
use lancer_scene::Cone;
use std::cmp::Ordering;

struct Frustum {
    base: Triple,
    /// From base to top, and its square.
    axis: Triple,
    tall: Number,
    /// At base and top.
    radii: [Number; 2],
    open: bool,
}

impl Frustum {
    fn new(cone: &Cone, space: &Space) -> Self {
        let base = space.point(cone.base());
        let axis = &space.point(cone.top()) - &base;
        let radii = [cone.base_radius(), cone.top_radius()].map(|r| space.length(r));
        Self { base, tall: axis.norm_squared(), axis, radii, open: cone.open }
    }

    /// The radius at height `h`, times the square of the axis.
    fn radius(&self, h: &Number) -> Number {
        let [base, top] = &self.radii;
        base * &self.tall + (top - base) * h
    }

    /// Below 0 nearer to the axis than the side, if between the ends; `p` is seen
    /// from the base.
    fn value(&self, p: &Triple) -> Number {
        let h = p.dot(&self.axis);
        let around = p.norm_squared() * &self.tall - h.squared();
        around * &self.tall - self.radius(&h).squared()
    }

    /// Half its gradient.
    fn gradient(&self, p: &Triple) -> Triple {
        let h = p.dot(&self.axis);
        let around = &p.times(&self.tall) - &self.axis.times(&h);
        let widens = (&self.radii[1] - &self.radii[0]) * self.radius(&h);
        &around.times(&self.tall) - &self.axis.times(&widens)
    }

    /// Its values along a line seen from the base.
    fn along(&self, line: &Line) -> Quadratic {
        let Line { origin: o, direction: d } = line;
        let (h, dh) = (o.dot(&self.axis), d.dot(&self.axis));
        let (r, dr) = (self.radius(&h), (&self.radii[1] - &self.radii[0]) * &dh);
        Quadratic {
            a: (d.norm_squared() * &self.tall - dh.squared()) * &self.tall - dr.squared(),
            b: (o.dot(d) * &self.tall - &h * &dh) * &self.tall - &r * &dr,
            c: (o.norm_squared() * &self.tall - h.squared()) * &self.tall - r.squared(),
        }
    }

    fn widest(&self) -> Number {
        self.radii.iter().max().cloned().unwrap_or_else(Number::zero)
    }
}

/// Where a line passes the plane of an end: at n / d, with d above 0.
struct End {
    n: Number,
    d: Number,
}

pub(super) fn meet(cone: &Cone, space: &Space, line: &Line, bits: usize) -> Found {
    let cone = Frustum::new(cone, space);
    let line = Line { origin: &line.origin - &cone.base, direction: line.direction.clone() };
    let side = cone.along(&line);
    let (h, dh) = (line.origin.dot(&cone.axis), line.direction.dot(&cone.axis));
    let ends = [Number::zero(), cone.tall.clone()].map(|end| {
        let n = &end - &h;
        match dh.signum() {
            0 => None,
            1 => Some(End { n, d: dh.clone() }),
            _ => Some(End { n: -n, d: -&dh }),
        }
    });
    let mut list = vec![];
    for root in side.roots() {
        if let Some(local) = on_side(&cone, &line, &side, &root, &ends, &h, bits) {
            list.push(local);
        }
    }
    for (k, end) in ends.iter().enumerate() {
        let Some(end) = end else { continue };
        let lid = !cone.open && !cone.radii[k].is_zero();
        if lid && side.value(&end.n, &end.d).signum() <= 0 {
            let normal = if k == 0 { -&cone.axis } else { cone.axis.clone() };
            list.push(Local {
                t: end.n.over(&end.d, bits),
                passage: Passage::through(&normal, &line.direction),
                normal,
                shading_normal: None,
                face: k + 1,
                seam: from_rim(&cone, &side, end),
            });
        }
    }
    list.sort_by(|a, b| a.t.cmp(&b.t));
    if !cone.open {
        // It is convex: of two crossings the first enters and the second leaves.
        let passages: &[Passage] = match list.len() {
            2 => &[Passage::Enters, Passage::Leaves],
            _ => &[Passage::Touches],
        };
        for (local, passage) in list.iter_mut().zip(passages) {
            local.passage = *passage;
        }
    }
    Found { list, margin: margin(&cone, &line, &side, &ends, &h) }
}

/// The crossing at a root of the side's equation, if it is between the ends. On
/// the rim of a lid it is the lid's.
fn on_side(
    cone: &Frustum,
    line: &Line,
    side: &Quadratic,
    root: &Root,
    ends: &[Option<End>; 2],
    h: &Number,
    bits: usize,
) -> Option<Local> {
    let mut order = [Ordering::Equal; 2];
    for (k, end) in ends.iter().enumerate() {
        order[k] = match end {
            Some(End { n, d }) => side.compare(root, n, d),
            None if k == 0 => h.cmp(&Number::zero()),
            None => h.cmp(&cone.tall),
        };
        let lid = !cone.open && !cone.radii[k].is_zero();
        if end.is_some() && order[k] == Ordering::Equal && lid {
            return None;
        }
    }
    // Not before both ends nor behind both.
    if order[0] == order[1] && order[0] != Ordering::Equal {
        return None;
    }
    let t = side.place(root, bits);
    let place = line.at(&t);
    let gradient = cone.gradient(&place);
    let out = if cone.radii[0] < cone.radii[1] { -&cone.axis } else { cone.axis.clone() };
    // An apex has no normal of its own.
    let apex = gradient.is_zero() || (*root == Root::Double && order.contains(&Ordering::Equal));
    let normal = if apex { out } else { gradient };
    let height = place.dot(&cone.axis);
    let seam = [height.abs(), (&cone.tall - &height).abs()].map(|away| ratio(&away, &cone.tall));
    Some(Local {
        t,
        passage: Passage::through(&normal, &line.direction),
        normal,
        shading_normal: None,
        face: 0,
        seam: seam[0].min(seam[1]),
    })
}

/// How far a place in the plane of an end is from the rim, as a fraction of the
/// larger one of its distance from the middle and the largest radius.
fn from_rim(cone: &Frustum, side: &Quadratic, end: &End) -> f64 {
    let gap = side.value(&end.n, &end.d);
    let widest = (cone.widest() * &cone.tall * &end.d).squared();
    let size = if gap.signum() > 0 { &widest + &gap } else { widest };
    ratio(&gap, &size) / 2.0
}

fn margin(
    cone: &Frustum,
    line: &Line,
    side: &Quadratic,
    ends: &[Option<End>; 2],
    h: &Number,
) -> f64 {
    let mut margin = f64::INFINITY;
    let tilt = sine(&cone.axis, &line.direction);
    let widest = cone.widest();
    for (k, end) in ends.iter().enumerate() {
        margin = margin.min(match end {
            Some(end) => from_rim(cone, side, end) * tilt,
            None => {
                let away = if k == 0 { h.clone() } else { h - &cone.tall };
                ratio(&away, &(&cone.tall + widest.squared()))
            }
        });
    }
    if side.a.is_zero() {
        return margin;
    }
    // Where the line comes nearest to the side, or is deepest behind it.
    let turn = (-&side.b).over(&side.a, 80);
    let place = line.at(&turn);
    let height = ratio(&place.dot(&cone.axis), &cone.tall);
    if height < 3.0 {
        let gap = cone.value(&place);
        let size = (&widest * &cone.tall).squared();
        let size = if gap.signum() > 0 { &size + &gap } else { size };
        margin = margin.min(ratio(&gap, &size) / 2.0);
    }
    margin
}

pub(super) fn place(cone: &Cone, space: &Space, p: &Triple) -> Place {
    let cone = Frustum::new(cone, space);
    let p = p - &cone.base;
    let h = p.dot(&cone.axis);
    let beyond = (-&h).signum().max((&h - &cone.tall).signum());
    match beyond.max(cone.value(&p).signum()) {
        -1 => Place::Inside,
        0 => Place::Border,
        _ => Place::Outside,
    }
}
