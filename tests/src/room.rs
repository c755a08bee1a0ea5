//! A closed room with columns and arches, to be looked at from inside: what a
//! ray meets there is never far from much else.

use lancer_math::sin_cos_degrees;
use lancer_scene::Mesh;

/// Half of its length, its width and its height.
const HALF: [f64; 3] = [12.0, 6.0, 4.0];

/// Where columns stand along the room, and how far from its middle.
const COLUMNS: [f64; 6] = [-10.0, -6.0, -2.0, 2.0, 6.0, 10.0];
const ASIDE: f64 = 3.5;

/// How high arches begin.
const SPRING: f64 = 0.5;

/// About 66,000 triangles; z is up, the middle is the origin, and lengths are
/// up to 24.
///
/// # Panics
/// Never: its triangles have areas.
#[must_use]
pub fn room() -> Mesh {
    let mut patches = Patches::default();
    let [x, y, z] = HALF;
    for side in [-1.0, 1.0] {
        patches.add([60, 40], |u, v| [x * u, y * v, z * side]);
        patches.add([60, 30], |u, v| [x * u, y * side, z * v]);
        patches.add([40, 30], |u, v| [x * side, y * u, z * v]);
        for at in COLUMNS {
            patches.add([32, 32], |u, v| column([at, ASIDE * side], u, v));
        }
        for pair in COLUMNS.windows(2) {
            let (middle, radius) = ((pair[0] + pair[1]) / 2.0, (pair[1] - pair[0]) / 2.0);
            patches.add([32, 16], |u, v| {
                let [along, up, across] = arch(radius, u, v);
                [middle + along, ASIDE * side + across, SPRING + up]
            });
        }
    }
    for at in COLUMNS {
        patches.add([48, 16], |u, v| {
            let [along, up, across] = arch(ASIDE, u, v);
            [at + across, along, SPRING - 0.2 + up]
        });
    }
    Mesh::new(patches.positions, patches.triangles).expect("its triangles have areas")
}

/// A column that is thinner in the middle, with u around it and v along it.
fn column([x, y]: [f64; 2], u: f64, v: f64) -> [f64; 3] {
    let (sin, cos) = sin_cos_degrees(180.0 * u);
    let radius = 0.3 + 0.2 * v * v * v * v;
    [x + radius * cos, y + radius * sin, HALF[2] * v]
}

/// Half a ring of that radius on its ends, with u along it and v around it: along
/// the row, up, and across.
fn arch(radius: f64, u: f64, v: f64) -> [f64; 3] {
    let ((up, along), (sin, cos)) = (sin_cos_degrees(90.0 + 90.0 * u), sin_cos_degrees(180.0 * v));
    let from_middle = radius + 0.25 * cos;
    [from_middle * along, from_middle * up, 0.25 * sin]
}

/// Surfaces cut into triangles.
#[derive(Default)]
struct Patches {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Patches {
    /// A surface over the square from -1 to 1, cut so often along each side.
    fn add(&mut self, [across, along]: [u32; 2], place: impl Fn(f64, f64) -> [f64; 3]) {
        let first = self.positions.len() as u32;
        let part = |i: u32, of: u32| 2.0 * f64::from(i) / f64::from(of) - 1.0;
        for j in 0..=along {
            for i in 0..=across {
                self.positions.push(place(part(i, across), part(j, along)));
            }
        }
        let at = |i: u32, j: u32| first + j * (across + 1) + i;
        for j in 0..along {
            for i in 0..across {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_as_large_as_it_says() {
        let room = room();
        assert!((60_000..70_000).contains(&room.triangle_count()), "{room:?}");
        let (min, max) = room.bounds();
        // Arches reach a little into the ceiling.
        let half = lancer_math::Vector::from(HALF);
        assert!((min.coords + half).amax() <= 0.1 && (max.coords - half).amax() <= 0.1);
    }
}
