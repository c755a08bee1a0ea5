//! Whole paths against closed forms.

use lancer_oracle::{Branch, Kind, Number, Pixel, Tracer};
use lancer_scene::{Camera, Colour, InvalidField, Light, Scene, Shape, Spectrum, Surface};

const BITS: usize = 200;

type Shapes = Vec<Result<Shape, InvalidField>>;

/// What a camera of one pixel at `origin` sees that looks at `target`.
fn look(origin: [f64; 3], target: [f64; 3], shapes: Shapes, light: Option<Light>) -> Pixel {
    let mut builder = Scene::builder()
        .camera(Camera::new(origin, target, 1.0, [1, 1]))
        .background(Spectrum::new([0.5; 3]));
    for shape in shapes {
        builder = builder.shape(shape);
    }
    if let Some(light) = light {
        builder = builder.light(Ok(light));
    }
    let scene = builder.build().unwrap_or_else(|e| panic!("{e}"));
    Tracer::new(&scene, BITS, 1e-3, 10_000).follow(0, 0)
}

fn glass(ior: f64) -> Surface {
    Surface::glass(ior).expect("an index")
}

/// The last ray of those that go straight through.
fn through(branch: &Branch) -> &Branch {
    let next = branch.branches.iter().find(|b| b.kind == Kind::Transmitted);
    next.map_or(branch, through)
}

/// Its angle with the x axis, in degrees.
fn angle(branch: &Branch) -> f64 {
    let [x, _, z] = &branch.line.direction.0;
    z.turn(x, 100).to_f64()
}

#[test]
fn d7_a_ball_lens() {
    let ball = Shape::sphere([0.0; 3], 1.0, glass(1.5));
    let pixel = look([-5.0, 0.0, 0.5], [5.0, 0.0, 0.5], vec![ball], None);
    let out = through(&pixel.tree);
    assert!((angle(out) + 21.057_558_731_018_6).abs() < 1e-12);
    // Where it crosses the axis.
    let [x, _, z] = out.line.origin.to_f64();
    let [dx, _, dz] = out.line.direction.to_f64();
    assert!((x - z / dz * dx - 1.391_572_948_889_31).abs() < 1e-13);
}

#[test]
fn d6_lossless_glass_cannot_be_seen_in_a_furnace() {
    for height in [0.0, 0.3, 0.9] {
        let ball = Shape::sphere([0.0; 3], 1.0, glass(1.5));
        let pixel = look([-5.0, 0.0, height], [5.0, 0.0, height], vec![ball], None);
        for c in pixel.radiance.to_f64() {
            assert!(c - 0.5 <= 1e-15 && c > 0.5 - 2e-3, "{c}");
        }
    }
}

/// The product of index, radius and sine is the same in all shells.
#[test]
fn d4_water_in_a_glass_ball() {
    let shells =
        vec![Shape::sphere([0.0; 3], 1.0, glass(1.33)), Shape::sphere([0.0; 3], 1.1, glass(1.5))];
    let out = look([-5.0, 0.0, 0.5], [5.0, 0.0, 0.5], shells, None);
    let out = through(&out.tree);
    assert!((angle(out).abs() - 13.569_595_670_389_4).abs() < 1e-12, "{}", angle(out));
    let [x, _, z] = out.line.origin.to_f64();
    let [dx, _, dz] = out.line.direction.to_f64();
    assert!((z + (4.0 - x) / dx * dz + 0.451_097_304_8).abs() < 1e-9);
}

#[test]
fn d7_absorption_along_a_chord() {
    let ball = glass(1.0).absorption([0.5, 0.0, 2.0]).expect("in range");
    let ball = Shape::sphere([0.0; 3], 1.0, ball);
    let pixel = look([-5.0, 0.0, 0.6], [5.0, 0.0, 0.6], vec![ball], None);
    // exp(-0.8) / 2 and exp(-3.2) / 2: the chord is 1.6 long.
    let expected = [0.224_664_482_058_610_8, 0.5, 0.020_381_101_989_183_1];
    for (found, expected) in pixel.radiance.to_f64().iter().zip(expected) {
        assert!((found - expected).abs() < 1e-15);
    }
}

#[test]
fn d5_eight_sheets_pass_a_256th() {
    let sheet = || glass(1.0).thin().gloss(0.5).expect("in range");
    let sheets = |gap: f64| -> Shapes {
        let x = |k: usize| [gap * k as f64, 0.0, 0.0];
        (0..8).map(|k| Shape::disc(x(k), [1.0, 0.0, 0.0], 1.0, sheet())).collect()
    };
    for gap in [1e-2, 1e-4, 1e-6] {
        let pixel = look([-5.0, 0.0, 0.0], [5.0, 0.0, 0.0], sheets(gap), None);
        assert_eq!(through(&pixel.tree).share.to_f64(), [1.0 / 256.0; 3]);
    }
}

#[test]
fn h2_contact_shadows() {
    let white = || Surface::new(Colour::WHITE);
    let sun = || Light::sun([0.0, 0.0, -1.0], 1.0).expect("a sun");
    let floor = || Shape::plane([0.0; 3], [0.0, 0.0, 1.0], white());
    let bright = look([-5.0, 0.0, 5.0], [0.0; 3], vec![floor()], Some(sun()));
    assert_eq!(bright.radiance.to_f64(), [1.0; 3]);
    for gap in [1e-1, 1e-3, 1e-6, 1e-12] {
        let disc = Shape::disc([0.0, 0.0, gap], [0.0, 0.0, 1.0], 1.0, white());
        // From between the two.
        let pixel = look([0.5, 0.0, gap / 2.0], [0.0; 3], vec![disc, floor()], Some(sun()));
        assert_eq!(pixel.radiance.to_f64(), [0.0; 3]);
        let small = Shape::disc([0.0, 0.0, gap], [0.0, 0.0, 1.0], 1e-3, white());
        let aside = look([-5.0, 0.0, 5.0], [0.25, 0.0, 0.0], vec![small, floor()], Some(sun()));
        assert_eq!(aside.radiance.to_f64(), [1.0; 3]);
    }
}

#[test]
fn r2_light_of_lamps_falls_off() {
    let floor = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], Surface::new(Colour::WHITE));
    let lamp = Light::lamp([0.0, 3.0, 4.0], 2.0).expect("a lamp");
    let pixel = look([-5.0, 0.0, 5.0], [0.0; 3], vec![floor], Some(lamp));
    // 2 cos / d^2 with d = 5 and cos = 4/5; where the ray meets the floor is rounded.
    assert!((pixel.radiance.to_f64()[0] - 2.0 * 0.8 / 25.0).abs() < 1e-16);
    assert_eq!(pixel.missing, 0.0);
    assert!(pixel.tree.branches.is_empty() && pixel.margin > 0.1);
    assert_eq!(pixel.tree.share.0[0], Number::one());
}
