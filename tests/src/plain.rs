//! The original program's two engines, transcribed from their description
//! line by line: no shortcut, no sharing with the product's engines, slow.
//!
//! What the product computes is compared bit for bit with the transcription in
//! which the points where `classic` has defined its own arithmetic
//! (ARCHITECTURE.md lists them) are written the same way; and picture by
//! picture with the one in which they are written as the original has them.

use lancer_math::{Point, Vector, elementary};
use lancer_scene::{Colour, Geometry, Light, Pattern, Scene};

/// Which of the original's engines, and how its glow is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plain {
    /// Recursive, with glow ending where `classic` ends it.
    Classic,
    /// The same, with glow from lights at any angle below 90 degrees.
    ClassicEndlessGlow,
    /// Recursive, all as the original's description has it: a light is hidden
    /// if the nearest hit along the unit ray to it is nearer, checkers by the
    /// arc sine and cosine of a mathematical library.
    Original,
    /// Not recursive.
    Direct,
}

struct Ball {
    centre: Point,
    radius: f64,
    surface: usize,
}

struct Flat {
    origin: Point,
    normal: Vector,
    surface: usize,
}

struct Surface {
    colour: [f32; 3],
    second: Option<[f32; 3]>,
    gloss: f32,
}

struct Hit {
    squared_distance: f64,
    point: Point,
    normal: Vector,
    second: bool,
    surface: usize,
}

struct World {
    balls: Vec<Ball>,
    flats: Vec<Flat>,
    surfaces: Vec<Surface>,
    lights: Vec<Light>,
    engine: Plain,
}

fn unit(v: Vector) -> Vector {
    v / (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

/// The product as the product's engines define it: fused, from the first
/// coordinate to the last.
fn fused(a: Vector, b: Vector) -> f64 {
    a.z.mul_add(b.z, a.y.mul_add(b.y, a.x * b.x))
}

/// `from` and `steps` times `direction`, fused.
fn after(from: Vector, steps: f64, direction: Vector) -> Vector {
    Vector::new(
        direction.x.mul_add(steps, from.x),
        direction.y.mul_add(steps, from.y),
        direction.z.mul_add(steps, from.z),
    )
}

/// `v` times the inverse of its length.
fn inverse_unit(v: Vector) -> Vector {
    v * (1.0 / fused(v, v).sqrt())
}

fn rgb(colour: Colour) -> [f32; 3] {
    colour.codes().map(f32::from)
}

/// All pixels of the frame, row by row.
#[must_use]
pub fn render(scene: &Scene, engine: Plain) -> Vec<[f32; 3]> {
    let world = World::new(scene, engine);
    let camera = &scene.camera;
    let (origin, target) = (camera.origin().get(), camera.target().get());
    let (columns, rows) = (camera.px_width.get(), camera.px_height.get());
    let (px_width, px_height) = (f64::from(columns), f64::from(rows));
    let width = camera.plane_width();
    let height = px_height * width / px_width;
    let p = unit(target - origin);
    let n1 = unit(Vector::new(p.y, -p.x, 0.0));
    let n2 = n1.cross(&p);
    let mut pixels = Vec::new();
    for y in 0..rows {
        for x in 0..columns {
            let direction = match engine {
                Plain::Original => {
                    let lat = (px_height / 2.0 - f64::from(y)) * height / px_height;
                    let lon = (f64::from(x) - (px_width / 2.0).floor()) * width / px_width;
                    unit(target + n1 * lon + n2 * lat - origin)
                }
                _ => {
                    let lat = (px_height / 2.0 - f64::from(y)) * (height / px_height);
                    let lon = (f64::from(x) - (px_width / 2.0).floor()) * (width / px_width);
                    inverse_unit(after(after(target - origin, lat, n2), lon, n1))
                }
            };
            pixels.push(match engine {
                Plain::Direct => world.direct(origin, direction),
                _ => world.trace(origin, direction, 1.0, 0),
            });
        }
    }
    pixels
}

impl World {
    fn new(scene: &Scene, engine: Plain) -> Self {
        let mut world =
            Self { balls: vec![], flats: vec![], surfaces: vec![], lights: vec![], engine };
        for (surface, shape) in scene.shapes.iter().enumerate() {
            world.surfaces.push(Surface {
                colour: rgb(shape.surface.colour),
                second: match shape.surface.pattern {
                    Pattern::Solid => None,
                    Pattern::Checker(checker) => Some(rgb(checker.second)),
                },
                gloss: shape.surface.gloss.get() as f32,
            });
            match &shape.geometry {
                Geometry::Sphere(s) => world.balls.push(Ball {
                    centre: s.centre.get(),
                    radius: s.radius.get(),
                    surface,
                }),
                Geometry::Plane(p) => world.flats.push(Flat {
                    origin: p.origin.get(),
                    normal: unit(p.normal.get()),
                    surface,
                }),
                _ => unreachable!("the original has no such shape"),
            }
        }
        let is_sun = |light: &&Light| matches!(light, Light::Sun { .. });
        world.lights.extend(scene.lights.iter().filter(is_sun));
        world.lights.extend(scene.lights.iter().filter(|light| !is_sun(light)));
        world
    }

    fn nearest(&self, origin: Point, direction: Vector) -> Option<Hit> {
        match self.engine {
            Plain::Original => self.nearest_as_original(origin, direction),
            _ => self.nearest_as_defined(origin, direction),
        }
    }

    fn nearest_as_original(&self, origin: Point, direction: Vector) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        for ball in &self.balls {
            let pc = ball.centre - origin;
            let b = pc.dot(&direction);
            if b < 0.0 {
                continue;
            }
            let k = ball.radius * ball.radius - (pc.norm_squared() - b * b);
            if k < 0.0 || k.is_nan() {
                continue;
            }
            let t = b - k.sqrt();
            if best.as_ref().is_none_or(|best| t * t < best.squared_distance) {
                let point = origin + direction * t;
                let normal = unit(point - ball.centre);
                best = Some(Hit {
                    squared_distance: t * t,
                    point,
                    normal,
                    second: second_by_arcs(normal),
                    surface: ball.surface,
                });
            }
        }
        for flat in &self.flats {
            let slope = direction.dot(&flat.normal);
            if slope >= 0.0 || slope.is_nan() {
                continue;
            }
            let o_n = origin.coords.dot(&flat.normal);
            let t = (o_n - flat.origin.coords.dot(&flat.normal)) / slope;
            if best.as_ref().is_none_or(|best| t * t < best.squared_distance) {
                let point = origin - direction * t;
                best = Some(Hit {
                    squared_distance: t * t,
                    point,
                    normal: flat.normal,
                    second: second_on_flat(point - flat.origin, flat.normal, Vector::dot),
                    surface: flat.surface,
                });
            }
        }
        best
    }

    fn nearest_as_defined(&self, origin: Point, direction: Vector) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut nearest = f64::INFINITY;
        for ball in &self.balls {
            let pc = ball.centre - origin;
            let b = fused(pc, direction);
            let k = b.mul_add(b, -tangent_squared(pc, ball.radius));
            if !(b >= 0.0 && k >= 0.0) {
                continue;
            }
            let t = b - k.sqrt();
            if t * t < nearest {
                nearest = t * t;
                let point = Point::from(after(origin.coords, t, direction));
                let normal = inverse_unit(point - ball.centre);
                best = Some(Hit {
                    squared_distance: t * t,
                    point,
                    normal,
                    second: second_on_ball(normal),
                    surface: ball.surface,
                });
            }
        }
        for flat in &self.flats {
            let slope = fused(direction, flat.normal);
            let below = fused(flat.origin.coords, flat.normal) - fused(origin.coords, flat.normal);
            let t = below / slope;
            if slope < 0.0 && t * t < nearest {
                nearest = t * t;
                let point = Point::from(after(origin.coords, t, direction));
                best = Some(Hit {
                    squared_distance: t * t,
                    point,
                    normal: flat.normal,
                    second: second_on_flat(point - flat.origin, flat.normal, |a, b| fused(*a, *b)),
                    surface: flat.surface,
                });
            }
        }
        best
    }

    /// The vector to the light (a unit vector to a sun) and whether anything
    /// is met before it.
    fn look_at(&self, light: &Light, point: Point) -> (Vector, bool) {
        match light {
            Light::Sun { direction, .. } if self.engine == Plain::Original => {
                let way = unit(-direction.get());
                (way, self.nearest(point, way).is_some())
            }
            Light::Lamp { point: lamp, .. } if self.engine == Plain::Original => {
                let way = lamp.get() - point;
                let hit = self.nearest(point, unit(way));
                (way, hit.is_some_and(|hit| hit.squared_distance < way.norm_squared()))
            }
            Light::Sun { direction, .. } => {
                let way = unit(-direction.get());
                (way, self.hides_sun(point, way))
            }
            Light::Lamp { point: lamp, .. } | Light::Spot { point: lamp, .. } => {
                let way = lamp.get() - point;
                (way, self.hides_lamp(point, way, lamp.get()))
            }
        }
    }

    fn hides_sun(&self, point: Point, way: Vector) -> bool {
        let by_ball = self.balls.iter().any(|ball| {
            let pc = ball.centre - point;
            let b = fused(way, pc);
            b >= 0.0 && b.mul_add(b, -tangent_squared(pc, ball.radius)) >= 0.0
        });
        by_ball || self.flats.iter().any(|flat| fused(way, flat.normal) < 0.0)
    }

    /// Whether anything is met on the way, in units of which, with a square of
    /// `reach`, a ball is met at b - root(k).
    fn hides_lamp(&self, point: Point, way: Vector, lamp: Point) -> bool {
        let reach = fused(way, way);
        let by_ball = self.balls.iter().any(|ball| {
            let pc = ball.centre - point;
            let b = fused(way, pc);
            let tangent = tangent_squared(pc, ball.radius);
            let k = b.mul_add(b, -(reach * tangent));
            let inside = lamp - ball.centre;
            let before = b < reach || fused(inside, inside) < ball.radius * ball.radius;
            b >= 0.0 && k >= 0.0 && before && b.mul_add(2.0, reach) > -tangent
        });
        by_ball
            || self.flats.iter().any(|flat| {
                let offset = fused(flat.origin.coords, flat.normal);
                (fused(point.coords, flat.normal) - offset).abs() < -fused(way, flat.normal)
            })
    }

    fn lit(&self, hit: &Hit) -> [f32; 3] {
        let mut sum = 0.0_f64;
        for light in &self.lights {
            let (way, hidden) = self.look_at(light, hit.point);
            let along = fused(way, hit.normal);
            if self.engine == Plain::Original && !hidden {
                let cosine = unit(way).dot(&hit.normal);
                sum += if cosine >= 0.0 { light.brightness().get() * cosine } else { 0.0 };
            } else if along >= 0.0 && !hidden {
                let cosine = along / length_squared(light, way).sqrt();
                sum = light.brightness().get().mul_add(cosine, sum);
            }
        }
        let surface = &self.surfaces[hit.surface];
        let base = match surface.second {
            Some(second) if hit.second => second,
            _ => surface.colour,
        };
        base.map(|c| c * sum as f32)
    }

    fn glow(&self, origin: Point, direction: Vector) -> f32 {
        let mut sum = 0.0_f64;
        for light in &self.lights {
            let (way, hidden) = self.look_at(light, origin);
            let along = match self.engine {
                Plain::Original => way.dot(&direction),
                _ => fused(way, direction),
            };
            if along <= 0.0 || along.is_nan() || hidden {
                continue;
            }
            if self.engine == Plain::Classic {
                let brightness = light.brightness().get();
                let mut bits = -1022;
                while bits <= 1023 && brightness >= two_to(bits) {
                    bits += 1;
                }
                let end = 1.0 - f64::from(58 + bits) * std::f64::consts::LN_2 / 100.0;
                if along * along < end * length_squared(light, way) {
                    continue;
                }
            }
            if self.engine == Plain::Original {
                let c = unit(way).dot(&direction);
                sum += light.brightness().get() * libm::exp(-100.0 * (1.0 - c * c));
                continue;
            }
            let c_squared = along * along / (length_squared(light, way));
            let glow = elementary::exp((c_squared - 1.0) * 100.0);
            sum = light.brightness().get().mul_add(glow, sum);
        }
        255.0 * sum as f32
    }

    fn trace(&self, origin: Point, direction: Vector, coeff: f32, counter: u32) -> [f32; 3] {
        let glow = self.glow(origin, direction);
        let Some(hit) = self.nearest(origin, direction) else { return [glow; 3] };
        let own = self.lit(&hit).map(|c| c + glow);
        let gloss = self.surfaces[hit.surface].gloss;
        if gloss == 0.0 || f64::from(coeff) < 0.01 || counter > 3 {
            return own;
        }
        let reflected = match self.engine {
            Plain::Original => direction - hit.normal * (2.0 * direction.dot(&hit.normal)),
            _ => after(direction, fused(direction, hit.normal) * -2.0, hit.normal),
        };
        let other = self.trace(hit.point, reflected, coeff * gloss, counter + 1);
        [0, 1, 2].map(|i| other[i] * gloss + own[i] * (1.0 - gloss))
    }

    fn direct(&self, origin: Point, direction: Vector) -> [f32; 3] {
        self.nearest(origin, direction).map_or([0.0; 3], |hit| self.lit(&hit))
    }
}

/// 2 to the power `e`, for normal numbers.
fn two_to(e: i32) -> f64 {
    f64::from_bits(((e + 1023) as u64) << 52)
}

/// The square of the length of the tangents to a ball whose centre is that far.
fn tangent_squared(to_centre: Vector, radius: f64) -> f64 {
    let v = to_centre;
    v.z.mul_add(v.z, v.y.mul_add(v.y, v.x.mul_add(v.x, -(radius * radius))))
}

fn length_squared(light: &Light, way: Vector) -> f64 {
    match light {
        Light::Sun { .. } => 1.0,
        _ => fused(way, way),
    }
}

fn second_by_arcs(p: Vector) -> bool {
    let s = p.z;
    let lat = (2.0 * libm::asin(s).abs()) as i32 + i32::from(s < 0.0);
    let lon = (2.0 * libm::acos(unit(p - Vector::new(0.0, 0.0, 1.0) * s).x)) as i32;
    (lat + lon) % 2 != 0
}

fn second_on_ball(p: Vector) -> bool {
    let s = p.z;
    let mut lat = 0;
    for k in 1..=3_u8 {
        lat += i32::from(s.abs() >= sine_of_half(k));
    }
    if s < 0.0 {
        lat += 1;
    }
    let c = p.x / p.y.mul_add(p.y, p.x * p.x).sqrt();
    let mut lon = 0;
    for k in 1..=6_u8 {
        lon += i32::from(c <= cosine_of_half(k));
    }
    (lat + lon) % 2 != 0
}

/// The least double not below sin(k / 2).
fn sine_of_half(k: u8) -> f64 {
    [0.479_425_538_604_203, 0.841_470_984_807_896_6, 0.997_494_986_604_054_4][usize::from(k) - 1]
}

/// The largest double not above cos(k / 2).
fn cosine_of_half(k: u8) -> f64 {
    [
        0.877_582_561_890_372_6,
        0.540_302_305_868_139_7,
        0.070_737_201_667_702_9,
        -0.416_146_836_547_142_4,
        -0.801_143_615_546_933_8,
        -0.989_992_496_600_445_5,
    ][usize::from(k) - 1]
}

fn second_on_flat(offset: Vector, n: Vector, dot: impl Fn(&Vector, &Vector) -> f64) -> bool {
    let x = Vector::new(1.0, 0.0, 0.0);
    let y = Vector::new(0.0, 1.0, 0.0);
    let v1 = unit(if n == x || n == -x { n.cross(&y) } else { n.cross(&x) });
    let v2 = n.cross(&v1);
    let cell = |i: f64| {
        // What a conversion to int gives on x86.
        let whole = if i.abs() < 2_147_483_648.0 { i.abs() as i64 } else { -2_147_483_648 };
        whole + i64::from(i < 0.0)
    };
    (cell(dot(&v1, &offset)) + cell(dot(&v2, &offset))) % 2 != 0
}
