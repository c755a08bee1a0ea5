use super::ball::Ball;
use super::fresnel::{mirrored_by_sheet, mirrored_of_unbent};
use super::media::{Media, medium, transmittance};
use super::record::Notes;
use super::signature::{self, Signing, Spot, Way};
use super::stops::Stops;
use super::tracer::{Place, Rgb64, Task, times};
use crate::{Plan, RayCounts};
use lancer_kernel::{Prepared, SurfacePoint, Which, not_lean};
use lancer_math::{Point, Ray, Vector, sin_cos_degrees, unit};
use lancer_scene::{Beam, Falloff, Length, Light, Position, Scene, Shadows};

/// The lights of a scene, in its order.
#[derive(Debug)]
pub(super) struct Lights {
    pub(super) lights: Vec<Source>,
    shadows: Shadows,
}

/// A light made ready.
#[derive(Debug)]
pub(super) struct Source {
    /// Its number in the scene.
    number: usize,
    pub(super) brightness: f64,
    pub(super) place: From,
    pub(super) falloff: Falloff,
    pub(super) beam: Option<Cone>,
    /// Its marks in a signature: where all its light arrives, and where it does between the angles
    /// of its beam.
    pub(super) marks: [f64; 2],
}

/// Where light comes from.
#[derive(Debug)]
pub(super) enum From {
    Point(Point),
    /// The direction to a sun, of length 1.
    Direction(Vector),
    /// The surface of a ball.
    Ball(Point, f64),
}

impl From {
    fn new(point: Position, radius: Option<Length>) -> Self {
        match radius {
            Some(radius) => Self::Ball(point.get(), radius.get()),
            None => Self::Point(point.get()),
        }
    }
}

/// The cone of a spot.
#[derive(Debug)]
pub(super) struct Cone {
    axis: Vector,
    /// The cosines of its angles.
    inner: f64,
    outer: f64,
}

impl Cone {
    fn new(axis: Vector, beam: &Beam) -> Self {
        let (_, inner) = sin_cos_degrees(beam.inner().get());
        let (_, outer) = sin_cos_degrees(beam.outer().get());
        // Never zero in a scene.
        Self { axis: unit(axis).unwrap_or_else(Vector::z), inner, outer }
    }

    /// The fraction of the light in a direction of length 1 away from the spot:
    /// between the angles a smooth step of the cosine.
    pub(super) fn share(&self, direction: &Vector) -> f64 {
        let cosine = self.axis.dot(direction);
        if cosine >= self.inner {
            1.0
        } else if cosine > self.outer {
            let s = (cosine - self.outer) / (self.inner - self.outer);
            s * s * (3.0 - 2.0 * s)
        } else {
            0.0
        }
    }
}

/// Which side of a surface is seen, and where the ray was that sees it.
pub(super) struct Seen<'a> {
    pub(super) point: &'a SurfacePoint<'a>,
    /// How much farther off than its own error rays must start from it.
    pub(super) more: f64,
    pub(super) from_behind: bool,
    /// The normals on the side that is seen.
    pub(super) facet: Vector,
    pub(super) shading: Vector,
    /// What is on that side.
    pub(super) media: &'a Media,
}

/// What a source makes of a white matte surface, if nothing hides it.
struct Shining {
    strength: f64,
    mark: f64,
    /// The ray to it; none where what was drawn of it is behind the surface.
    ray: Option<Ray>,
    t_max: f64,
}

impl Source {
    /// What comes from that way, at whose end is the lamp, or none for a sun. None where there is no
    /// light.
    fn shine(&self, seen: &Seen<'_>, way: Vector, lamp: Option<&Point>) -> Option<Shining> {
        let along = way.dot(&seen.shading);
        // Not for NaN either: a lamp in the very point lights nothing.
        if !(along > 0.0 && way.dot(&seen.facet) > 0.0) {
            return None;
        }
        let squared = if lamp.is_some() { way.norm_squared() } else { 1.0 };
        let distance = squared.sqrt();
        // The cosine, over the square where light falls off, by one division.
        let strength = match self.falloff {
            Falloff::Square => self.brightness * along / (squared * distance),
            Falloff::None => self.brightness * along / distance,
        };
        let (strength, mark) = self.in_beam(strength, || way / -distance)?;
        let mut ray = seen.leave(way);
        let mut t_max = f64::INFINITY;
        if let Some(lamp) = lamp {
            // From where the ray starts it is 1 to the lamp.
            (ray.direction, t_max) = (lamp - ray.origin, 1.0);
        }
        Some(Shining { strength, mark, ray: Some(ray), t_max })
    }

    /// What comes from a ball, of which two numbers draw a point.
    fn shine_as_ball(
        &self,
        seen: &Seen<'_>,
        (centre, radius): (&Point, f64),
        numbers: impl FnOnce() -> [f64; 2],
    ) -> Option<Shining> {
        let point = seen.point.point;
        let (ball, strength, mark) =
            self.ball(centre - point, radius, [seen.shading, seen.facet])?;
        let ray = ball.point(numbers()).map(|way| {
            let mut ray = seen.leave(way);
            ray.direction = (point + way) - ray.origin;
            ray
        });
        Some(Shining { strength, mark, ray, t_max: 1.0 })
    }

    /// Which of a sample's numbers draw a point of it, for the surface that the ray on that way
    /// met. The first two are taken.
    pub(super) fn dimension(&self, way: Way) -> u32 {
        signature::hash(way.end() ^ signature::hash(self.number as u64)) as u32 | 2
    }

    /// The ball lamp that it is, that way from a point of a surface with a normal to shade
    /// with and a facet's, on the side that is seen; its strength there, and its mark. None where
    /// there is no light.
    pub(super) fn ball(
        &self,
        way: Vector,
        radius: f64,
        normals: [Vector; 2],
    ) -> Option<(Ball, f64, f64)> {
        let ball = Ball::new(way, radius, normals);
        let strength = ball.strength(self.brightness, self.falloff);
        if strength == 0.0 {
            return None;
        }
        // In its very centre there is no direction, and no beam.
        let direction = || unit(-way).unwrap_or_else(Vector::zeros);
        let (strength, mark) = self.in_beam(strength, direction)?;
        Some((ball, strength, mark))
    }

    /// Whether it shines in the direction of a surface, be it behind it or not.
    fn shines_towards(&self, seen: &Seen<'_>) -> bool {
        let from = match &self.place {
            From::Direction(_) => None,
            From::Point(lamp) | From::Ball(lamp, _) => unit(seen.point.point - lamp),
        };
        let is_in = |cone: &Cone| from.is_none_or(|direction| cone.share(&direction) != 0.0);
        self.brightness != 0.0 && self.beam.as_ref().is_none_or(is_in)
    }

    /// What its beam leaves of a strength in that direction from the source, and the mark of
    /// that; none where there is no light.
    fn in_beam(&self, strength: f64, direction: impl FnOnce() -> Vector) -> Option<(f64, f64)> {
        let (mut strength, mut mark) = (strength, self.marks[0]);
        if let Some(beam) = &self.beam {
            let share = beam.share(&direction());
            // Nothing of something infinite is nothing.
            if share == 0.0 {
                return None;
            }
            strength *= share;
            if share != 1.0 {
                mark = self.marks[1];
            }
        }
        (strength != 0.0).then_some((strength, mark))
    }
}

impl Lights {
    pub(super) fn new(scene: &Scene, plan: &Plan) -> Self {
        let source = |(number, light): (usize, &Light)| {
            let marks = [2 * number, 2 * number + 1].map(|mark| signature::mark(mark as u64));
            if !matches!(light, Light::Lamp { radius: None, .. }) {
                not_lean();
            }
            match light {
                Light::Lamp { point, radius, brightness, falloff } => Source {
                    number,
                    brightness: brightness.get(),
                    place: From::new(*point, *radius),
                    falloff: *falloff,
                    beam: None,
                    marks,
                },
                Light::Spot { point, radius, axis, beam, brightness, falloff } => Source {
                    number,
                    brightness: brightness.get(),
                    place: From::new(*point, *radius),
                    falloff: *falloff,
                    beam: Some(Cone::new(axis.get(), beam)),
                    marks,
                },
                Light::Sun { direction, brightness } => Source {
                    number,
                    brightness: brightness.get(),
                    // Never zero in a scene.
                    place: From::Direction(unit(-direction.get()).unwrap_or_else(Vector::z)),
                    falloff: Falloff::None,
                    beam: None,
                    marks,
                },
            }
        };
        let asked = (0..).zip(&scene.lights).filter(|(number, _)| plan.asks(*number));
        let lights = asked.map(source).collect();
        Self { lights, shadows: scene.shadows }
    }

    /// The radiance of a white matte surface there, which the ray on that way met. Which
    /// lights arrive, and through what, is added to the spot.
    pub(super) fn gather<S: Signing>(
        &self,
        prepared: &Prepared,
        seen: &Seen<'_>,
        (spot, counts, notes): (&mut Spot, &mut RayCounts, &mut S::Notes),
        (task, way): (&Task, Way),
    ) -> Rgb64 {
        let mut sum = [0.0; 3];
        for light in &self.lights {
            let shining = match &light.place {
                From::Direction(direction) => light.shine(seen, *direction, None),
                From::Point(lamp) => light.shine(seen, lamp - seen.point.point, Some(lamp)),
                From::Ball(centre, radius) => light.shine_as_ball(seen, (centre, *radius), || {
                    task.stream.pair(light.dimension(way))
                }),
            };
            let Some(Shining { strength, mark, ray, t_max }) = shining else {
                notes.note(|record| record.no_light(light.number, !light.shines_towards(seen)));
                continue;
            };
            counts.shadow += 1;
            let Some(ray) = ray else {
                notes.note(|record| record.no_light(light.number, false));
                continue;
            };
            if prepared.any(&ray, t_max, Which::Opaque) {
                notes.note(|record| record.hidden(light.number, prepared, &ray, t_max));
                continue;
            }
            let (on, to) = ((&ray, t_max), (&mut *spot, &mut *counts));
            let arrives = self.through::<S>(prepared, on, seen.media, to, task.pixel);
            if S::SIGNED && arrives != [0.0; 3] {
                spot.lit += mark;
            }
            notes.note(|record| {
                record.light(
                    light.number,
                    (prepared, self.shadows),
                    (&ray, t_max),
                    (strength, arrives),
                );
            });
            for (sum, arrives) in sum.iter_mut().zip(arrives) {
                // Nothing of something infinite is nothing.
                if arrives != 0.0 {
                    *sum += strength * arrives;
                }
            }
        }
        sum
    }

    /// What of the light arrives that goes along a ray, against it, from `t_max`, where
    /// nothing opaque is in the way. What is, is added to the spot.
    pub(super) fn through<S: Signing>(
        &self,
        prepared: &Prepared,
        (ray, t_max): (&Ray, f64),
        media: &Media,
        (spot, counts): (&mut Spot, &mut RayCounts),
        place: Place,
    ) -> Rgb64 {
        if !prepared.has_transparent() {
            return [1.0; 3];
        }
        if self.shadows == Shadows::Opaque && prepared.any(ray, t_max, Which::Transparent) {
            return [0.0; 3];
        }
        let hits = prepared.all(ray, (0.0, t_max), Which::Transparent);
        let length = ray.direction.norm();
        let mut media = media.clone();
        let (mut left, mut last) = ([1.0; 3], 0.0);
        let mut ways = Way::EYE;
        let mut passed = |point: &SurfacePoint<'_>, border: u64| {
            if S::SIGNED {
                ways = ways.then(border).then(u64::from(point.item)).then(prepared.patch(point));
            }
        };
        for stop in Stops::new(prepared, ray, &hits) {
            let here = medium(media.top(prepared), prepared);
            left = times(left, transmittance(&here, (stop.t - last) * length));
            last = stop.t;
            for (point, cosine) in stop.sheets() {
                let surface = point.surface;
                let mirrored = mirrored_by_sheet(cosine, here.ior.get(), surface.medium.ior.get());
                let passes = passing(point) * (1.0 - mirrored);
                left = left.map(|left| left * passes);
                passed(point, 0);
            }
            let Some(border) = stop.border(prepared, &mut media) else { continue };
            if !border.makes_sense {
                counts.troubles.media.at(place);
            }
            if let Some((point, cosine)) = border.surface {
                let n1 = medium(border.before, prepared).ior.get();
                let n2 = medium(border.after, prepared).ior.get();
                let passes = passing(point) * (1.0 - mirrored_of_unbent(cosine, n1, n2));
                left = left.map(|left| left * passes);
                passed(point, 1 + u64::from(border.after == Some(point.item)));
            }
            if left == [0.0; 3] {
                return left;
            }
        }
        if S::SIGNED && !hits.is_empty() {
            spot.piece = spot.piece.wrapping_add(ways.end());
        }
        let here = medium(media.top(prepared), prepared);
        times(left, transmittance(&here, (t_max - last) * length))
    }
}

/// The fraction of light that is neither mirrored by gloss nor matte.
fn passing(point: &SurfacePoint<'_>) -> f64 {
    (1.0 - point.surface.gloss.get()) * point.surface.transparency.get()
}
