//! O: from values to files. One bad pixel spoils no other, and codes are the nearest.

use crate::pictures::{FILM, assert_near, built, by, codes, eye, floor, scene, shining, white};
use lancer_film::{Display, Film, LightMeter, Size};
use lancer_integrator::Trouble;
use lancer_output::{Bits, Format, decode, encode, to_rgb8};
use lancer_scene::{Camera, Light, Shape};

/// A film that is shown as it is, of one row.
fn shown(values: &[f32]) -> Vec<u8> {
    let film = film(values);
    to_rgb8(&film).expect("the exposure is known").into_raw().into_iter().step_by(3).collect()
}

fn film(values: &[f32]) -> Film {
    let frame = Size::new(values.len() as u32, 1);
    let mut film = Film::new(frame, frame.window(), Display::Exposed).expect("it fits");
    let pixels: Vec<_> = values.iter().map(|v| [*v; 3]).collect();
    film.put(frame.window(), &pixels);
    film.set_stops(0.0);
    film
}

const BAD: [f32; 5] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, f32::MAX];

/// Pass: exactly the bad pixels differ, in each format.
#[test]
fn o1_a_bad_pixel_spoils_no_other() {
    let good = [0.5_f32; 9];
    for (place, bad) in BAD.into_iter().enumerate() {
        let mut values = good;
        values[place] = bad;
        for (i, (a, b)) in shown(&values).iter().zip(shown(&good)).enumerate() {
            assert_eq!(*a == b, i != place, "{bad} at {place}: {i}");
        }
        for (format, _) in Format::ALL {
            for bits in [Bits::Eight, Bits::Sixteen] {
                // 16 bits are not for all; JPEG spreads errors by its nature.
                if *format == Format::Jpeg || (bits == Bits::Sixteen && !format.has_16_bits()) {
                    continue;
                }
                let [a, b] =
                    [&values, &good].map(|v| encode(&film(v), *format, bits).expect("fits"));
                let [a, b] = [a, b].map(|bytes| decode(&bytes).expect("it was written here"));
                for i in 0..good.len() {
                    let same = a.levels(i)[..3] == b.levels(i)[..3];
                    assert_eq!(same, i != place, "{format:?} {bits:?}: {bad} at {place}: {i}");
                }
            }
        }
    }
    // What is too bright is white, and what is no brightness is black.
    assert_eq!(shown(&[f32::INFINITY, f32::MAX, f32::NAN, -1.0]), [255, 255, 0, 0]);
}

/// The exposure that is found is that without the bad pixels.
#[test]
fn o1_a_bad_pixel_does_not_change_the_exposure() {
    let mut values: Vec<[f32; 3]> = (0..400_u16).map(|i| [f32::from(i) / 100.0; 3]).collect();
    let stops = |values: &[[f32; 3]]| {
        let mut meter = LightMeter::new();
        meter.see(values);
        meter.stops()
    };
    let expected = stops(&values);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
        values.push([bad; 3]);
        values.insert(0, [bad, bad, 0.0]);
        assert_eq!(stops(&values), expected, "{bad}");
    }
}

/// Pass: a pixel that is no number is dropped and counted, the others keep their bytes.
/// The original's picture is black.
#[test]
fn o1_pixels_that_are_no_numbers_are_counted() {
    let camera = || {
        Camera::new([0.0, 0.0, 5.0], [0.0; 3], 8.0, [8, 8])
            .and_then(|camera| camera.orthographic(8.0))
            .and_then(|camera| camera.stops(0.0))
    };
    let plain = || scene(camera(), 0.0).shape(floor(0.0, shining(0.5)));
    let bright = Shape::disc([0.5, 0.5, 1.0], [0.0, 0.0, 1.0], 0.25, shining(1e39));
    let without = by("whitted", &built(plain()));
    let with = by("whitted", &built(plain().shape(bright)));
    let expected = Trouble { count: 1, first: Some((4, 3)) };
    assert_eq!(with.counts.troubles.not_finite, expected);
    assert_eq!(without.counts.troubles.not_finite.count, 0);
    let [a, b] = [codes(&with), codes(&without)];
    let differ: Vec<_> = (0..64).filter(|i| a[3 * i..][..3] != b[3 * i..][..3]).collect();
    assert_eq!(differ, [3 * 8 + 4]);
}

/// Pass: a highlight of any brightness elsewhere changes nothing.
/// The original's 121 becomes 3 and 0.
#[test]
fn o2_a_highlight_elsewhere_changes_no_other_pixel() {
    let lit = |highlight: f64, stops: Option<f64>| {
        let camera = Camera::new([0.0, 0.0, 5.0], [0.0; 3], 16.0, [16, 16])
            .and_then(|camera| camera.orthographic(16.0))
            .and_then(|camera| match stops {
                Some(stops) => camera.stops(stops),
                None => Ok(camera),
            });
        let spot = Shape::disc([0.5, 0.5, 1.0], [0.0, 0.0, 1.0], 0.25, shining(highlight));
        codes(&by(
            "whitted",
            &built(scene(camera, 0.0).shape(floor(0.0, shining(0.2))).shape(spot)),
        ))
    };
    for stops in [Some(0.0), Some(-2.0), None] {
        let plain = lit(0.2, stops);
        for highlight in [4.0, 20.0, 1000.0, 1e30] {
            let with = lit(highlight, stops);
            let differ = (0..256).filter(|i| with[3 * i..][..3] != plain[3 * i..][..3]).count();
            // Where nobody has chosen one, too: the usual rule lets one pixel in a hundred be
            // over-exposed.
            assert_eq!(differ, 1, "{highlight} {stops:?}");
        }
    }
}

/// The transfer function of sRGB (IEC 61966-2-1), by another library.
fn srgb(v: f64) -> f64 {
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * libm::pow(v, 1.0 / 2.4) - 0.055 }
}

/// Pass: the nearest codes, so that the mean error of a ramp is nothing; truncated it would
/// be half a level.
#[test]
fn o2_codes_are_the_nearest() {
    let steps = 200_000_u32;
    let values: Vec<f32> = (0..=steps).map(|i| i as f32 / steps as f32).collect();
    let (mut sum, mut largest) = (0.0, 0.0);
    for (v, code) in values.iter().zip(shown(&values)) {
        let error = f64::from(code) - 255.0 * srgb(f64::from(*v));
        sum += error;
        largest = f64::max(largest, error.abs());
    }
    assert!(largest <= 0.5 + 1e-5, "{largest}");
    // By brightness the codes are evenly spread only where the curve is straight, so this
    // is as near to nothing as the sum of 256 halves of its bends.
    assert!((sum / f64::from(steps)).abs() < 2e-3, "{}", sum / f64::from(steps));
    assert_eq!(shown(&[0.5]), [188], "187.516");
    assert_eq!(shown(&[0.0, 1.0, 2.0]), [0, 255, 255]);
}

/// Pass: 0 of 256 codes change when they are decoded and encoded.
#[test]
fn o2_each_code_comes_back() {
    let linear = |code: u8| {
        let v = f64::from(code) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
    };
    let values: Vec<f32> = (0..=255).map(|code| linear(code) as f32).collect();
    let expected: Vec<u8> = (0..=255).collect();
    assert_eq!(shown(&values), expected);
    // As colours of a scene, seen as they shine.
    for code in [0, 1, 10, 11, 54, 127, 188, 254, 255] {
        let colour = lancer_scene::Colour::from_name("white").expect("a name");
        assert_eq!(colour.codes(), [255; 3]);
        let lit = scene(eye([0.0, 0.0, 1.0], [0.0; 3]).and_then(|camera| camera.stops(0.0)), 0.0)
            .shape(floor(0.0, shining(linear(code))));
        assert_eq!(codes(&by("whitted", &built(lit))), [code; 3]);
    }
    // The knee of the curve: no jump that a code would show.
    let below = 0.003_130_8_f32;
    assert_eq!(shown(&[below.next_down(), below, below.next_up()]), [10; 3]);
}

/// Pass: 70000 x 70000 pixels are counted, 4.9e9, which 32 bits do not hold, and a picture
/// that has no room is an error.
#[test]
fn o2_large_pictures_are_counted_in_64_bits() {
    let frame = Size::new(70_000, 70_000);
    assert_eq!(frame.pixels(), 4_900_000_000);
    assert_eq!(frame.window().pixels(), 4_900_000_000);
    assert_eq!(Size::new(u32::MAX, u32::MAX).pixels(), 18_446_744_065_119_617_025);
    let text = crate::pictures::text(
        "numbers",
        &[("pxwidth=\"12\" pxheight=\"9\"", "pxwidth=\"70000\" pxheight=\"70000\"")],
    );
    let parsed = lancer_xml::parse(text.as_bytes(), &lancer_xml::Options::default());
    assert!(
        parsed.scene.is_none()
            && parsed.diagnostics.iter().any(|d| d.message.contains("4900000000")),
        "{:?}",
        parsed.diagnostics
    );
}

/// A pixel is summed in double precision. Pass: 1e-9, of which a film shows 6e-8: a sum in
/// single precision is off by 1e-5 of it or more.
#[test]
fn o3_the_light_of_many_lamps_is_summed_in_double_precision() {
    let count = 1 << 16;
    let mut lit = scene(eye([0.0, 0.5, 1.0], [0.0; 3]), 0.0).shape(floor(0.0, white()));
    let brightness = 0.1;
    let (mut single, mut exact) = (0.0_f32, 0.0);
    for _ in 0..count {
        lit = lit.light(Light::lamp([0.0, 0.0, 1.0], brightness));
        single += brightness as f32;
        exact += brightness;
    }
    let found = f64::from(by("whitted", &built(lit)).film.pixel(0, 0)[0]);
    let right = f64::from(count) * 0.1;
    assert_near(found, right, FILM, "the sum");
    assert_near(exact, right, 1e-9, "in double precision");
    assert!((f64::from(single) / right - 1.0).abs() > 1e-5, "else this shows nothing: {single}");
}

/// The light of ten thousand mirrors, one after another: a sum that goes on for long and
/// ends at the series.
#[test]
fn o3_the_light_of_many_mirrors_is_summed_in_double_precision() {
    let text = crate::pictures::text("mirror_room", &[("gloss=\"0.9\"", "gloss=\"0.9990234375\"")]);
    let scene = crate::pictures::parsed(&text);
    // e / (1 - rho) with 1 - rho = 1/1024, and the part that is left at the cutoff.
    let found = crate::pictures::middle_with(&scene, 1e-4);
    let missing = 1.0 - found / 102.4;
    assert!((-FILM..=1e-4).contains(&missing), "{missing}");
}
