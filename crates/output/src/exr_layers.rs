//! A film and the layers beside it in one OpenEXR file.

use crate::Format;
use crate::display::linear_value;
use crate::encode::EncodeError;
use exr::block::lines::LineRefMut;
use exr::image::write::WritableImage;
use exr::image::write::samples::{SamplesWriter, WritableSamples};
use exr::image::{AnyChannel, AnyChannels, Encoding, Image};
use exr::math::{RoundingMode, Vec2};
use exr::meta::attribute::{LevelMode, SampleType};
use exr::meta::header::Header;
use image::ImageError;
use image::error::{EncodingError, ImageFormatHint};
use lancer_film::{Film, LayerKind, LayerPixel, Layers, PixelQuality, Quality};
use std::io::Cursor;

/// Blocks of 16 lines, packed with zlib: nothing is lost, and all programs read
/// it. The runs of equal bytes that the plain file has are faster (a picture of
/// 2000 x 1500 with all layers takes 0.3 s instead of 0.9 s), but layers are
/// smooth rather than flat, and the file is three times as large (93 MB instead
/// of 30 MB).
const ENCODING: Encoding = Encoding::SMALL_LOSSLESS;

/// The bytes of an OpenEXR file with the film's red, green and blue, the same
/// values that [`encode`](crate::encode) writes, and those of the layers that
/// `kinds` names, in any order, as far as what they are read from is given.
///
/// All are channels of one part, named the way other programs group them:
///
/// | kind | channels | sample |
/// |---|---|---|
/// | (the film) | `R` `G` `B` | 32-bit float |
/// | depth | `depth.axis` `depth.ray` | 32-bit float; infinite where nothing is hit |
/// | normal | `normal.X` `normal.Y` `normal.Z` | 32-bit float |
/// | albedo | `albedo.R` `albedo.G` `albedo.B` | 32-bit float |
/// | shape | `shape.id` | 32-bit unsigned; 0 where nothing is hit |
/// | instance | `instance.id` | 32-bit unsigned; 0 where nothing is hit |
/// | error | `error.rms` `error.interval` | 32-bit float |
/// | samples | `samples.count` | 32-bit unsigned |
///
/// Every sample is kept bit for bit. As in a plain file, both of the file's
/// windows are the film's, moved to 0,0: a crop does not say where in its frame
/// it was. The bytes depend on the arguments alone.
///
/// # Errors
/// Where the layers or the quality are of another window or frame than the film, or the
/// format cannot hold the picture.
///
/// # Panics
/// Never: the lines have the lengths that the windows say.
pub fn encode_exr_with_layers(
    film: &Film,
    layers: Option<&Layers>,
    quality: Option<&Quality>,
    kinds: &[LayerKind],
) -> Result<Vec<u8>, EncodeError> {
    let place = (film.frame(), film.window());
    let others = [
        layers.map(|layers| (layers.frame(), layers.window())),
        quality.map(|quality| (quality.frame(), quality.window())),
    ];
    if let Some(other) = others.into_iter().flatten().find(|other| *other != place) {
        return Err(EncodeError::OtherWindow { film: place, layers: other });
    }
    let radiance = ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(|(component, name)| AnyChannel::new(name, Samples::Film { film, component }));
    let asked = LayerKind::ALL.iter().filter(|kind| kinds.contains(kind));
    let beside = asked.flat_map(|kind| channels(*kind)).filter_map(|(name, read)| {
        let samples = match read {
            Read::FirstHit(sample) => Samples::Layer(layers?, *sample),
            Read::Quality(sample) => Samples::Quality(quality?, *sample),
        };
        Some(AnyChannel::new(*name, samples))
    });
    let channels = AnyChannels::sort(radiance.chain(beside).collect());
    let size = (film.window().width as usize, film.window().height as usize);
    let mut file = Cursor::new(Vec::new());
    // On several threads the blocks would come in the order of their completion.
    Image::from_encoded_channels(size, ENCODING, channels)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(|reason| {
            let hint = ImageFormatHint::Exact(image::ImageFormat::OpenExr);
            let reason = ImageError::Encoding(EncodingError::new(hint, reason));
            EncodeError::Encoder { format: Format::Exr, reason }
        })?;
    Ok(file.into_inner())
}

/// How a channel is read from what is known of a pixel.
#[derive(Clone, Copy)]
enum Sample<P> {
    Float(fn(&P) -> f32),
    Whole(fn(&P) -> u32),
}

impl<P> Sample<P> {
    const fn sample_type(&self) -> SampleType {
        match self {
            Self::Float(_) => SampleType::F32,
            Self::Whole(_) => SampleType::U32,
        }
    }

    fn write(&self, pixels: &[P], line: LineRefMut<'_>) -> exr::error::UnitResult {
        match self {
            Self::Float(read) => line.write_samples(|index| read(&pixels[index])),
            Self::Whole(read) => line.write_samples(|index| read(&pixels[index])),
        }
    }
}

/// What a channel is read from, and how.
#[derive(Clone, Copy)]
enum Read {
    FirstHit(Sample<LayerPixel>),
    Quality(Sample<PixelQuality>),
}

/// The channels of a kind, with their names in the file.
fn channels(kind: LayerKind) -> &'static [(&'static str, Read)] {
    use Read::{FirstHit, Quality};
    use Sample::{Float, Whole};
    match kind {
        LayerKind::Depth => &[
            ("depth.axis", FirstHit(Float(|pixel| pixel.axis_depth))),
            ("depth.ray", FirstHit(Float(|pixel| pixel.ray_depth))),
        ],
        LayerKind::Normal => &[
            ("normal.X", FirstHit(Float(|pixel| pixel.normal[0]))),
            ("normal.Y", FirstHit(Float(|pixel| pixel.normal[1]))),
            ("normal.Z", FirstHit(Float(|pixel| pixel.normal[2]))),
        ],
        LayerKind::Albedo => &[
            ("albedo.R", FirstHit(Float(|pixel| pixel.albedo[0]))),
            ("albedo.G", FirstHit(Float(|pixel| pixel.albedo[1]))),
            ("albedo.B", FirstHit(Float(|pixel| pixel.albedo[2]))),
        ],
        LayerKind::Shape => &[("shape.id", FirstHit(Whole(|pixel| pixel.shape)))],
        LayerKind::Instance => &[("instance.id", FirstHit(Whole(|pixel| pixel.instance)))],
        LayerKind::Error => &[
            ("error.rms", Quality(Float(|pixel| pixel.error))),
            ("error.interval", Quality(Float(|pixel| pixel.interval))),
        ],
        LayerKind::Samples => &[("samples.count", Quality(Whole(|pixel| pixel.samples)))],
    }
}

/// The samples of a channel. They are read where they are when their block is
/// written, so that no channel is copied.
#[derive(Clone, Copy)]
enum Samples<'a> {
    Film { film: &'a Film, component: usize },
    Layer(&'a Layers, Sample<LayerPixel>),
    Quality(&'a Quality, Sample<PixelQuality>),
}

impl WritableSamples<'_> for Samples<'_> {
    type Writer = Self;

    fn sample_type(&self) -> SampleType {
        match self {
            Self::Film { .. } => SampleType::F32,
            Self::Layer(_, sample) => sample.sample_type(),
            Self::Quality(_, sample) => sample.sample_type(),
        }
    }

    fn infer_level_modes(&self) -> (LevelMode, RoundingMode) {
        (LevelMode::Singular, RoundingMode::Down)
    }

    fn create_samples_writer(&self, _: &Header) -> Self {
        *self
    }
}

impl SamplesWriter for Samples<'_> {
    fn extract_line(&self, line: LineRefMut<'_>) {
        let Vec2(x, y) = line.location.position;
        let count = line.location.sample_count;
        let from = |width: u32| y * width as usize + x;
        match *self {
            Self::Film { film, component } => {
                let pixels = &film.pixels()[from(film.window().width)..][..count];
                let display = film.display();
                line.write_samples(|index| linear_value(display, pixels[index][component]))
            }
            Self::Layer(layers, sample) => {
                let pixels = &layers.pixels()[from(layers.window().width)..][..count];
                sample.write(pixels, line)
            }
            Self::Quality(quality, sample) => {
                let pixels = &quality.pixels()[from(quality.window().width)..][..count];
                sample.write(pixels, line)
            }
        }
        .expect("a line has room for its samples");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bits, compare, decode, encode};
    use exr::image::FlatSamples;
    use lancer_film::{Display, Size, Window};
    use std::collections::BTreeMap;

    /// A film, layers and quality of a crop that is several blocks high, the last of them
    /// not whole, and full of odd bits.
    fn picture(display: Display) -> (Film, Layers, Quality) {
        let frame = Size::new(150, 100);
        let window = Window { x: 7, y: 9, width: 131, height: 70 };
        let mut film = Film::new(frame, window, display).expect("it fits");
        let mut layers = Layers::new(frame, window).expect("it fits");
        let mut quality = Quality::new(frame, window).expect("it fits");
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state
        };
        for y in 9..79 {
            for x in 7..138 {
                let mut float = || f32::from_bits(random());
                let here = Window { x, y, width: 1, height: 1 };
                film.put(here, &[[float().abs(), 0.25, float()]]);
                if x % 9 != 0 {
                    let pixel = LayerPixel {
                        axis_depth: float(),
                        ray_depth: float(),
                        normal: [float(), float(), float()],
                        albedo: [float(), float(), float()],
                        shape: random(),
                        instance: u32::MAX - x * y,
                    };
                    layers.put(here, &[pixel]);
                }
                let error = f32::from_bits(random());
                let interval = f32::from_bits(random());
                quality.put(here, &[PixelQuality { error, interval, samples: random() }]);
            }
        }
        (film, layers, quality)
    }

    fn encode_all(
        (film, layers, quality): &(Film, Layers, Quality),
        kinds: &[LayerKind],
    ) -> Vec<u8> {
        encode_exr_with_layers(film, Some(layers), Some(quality), kinds).expect("it encodes")
    }

    /// The channels of a file with the bits of their samples, through the
    /// library's own reader; `true` for numbers that are not floats.
    fn read(bytes: &[u8]) -> BTreeMap<String, (bool, Vec<u32>)> {
        use exr::prelude::{ReadChannels, ReadLayers};
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .expect("it decodes");
        assert_eq!(image.layer_data.len(), 1, "one part");
        assert_eq!(image.layer_data[0].size, Vec2(131, 70));
        let list = image.layer_data[0].channel_data.list.iter();
        list.map(|channel| {
            let samples = match &channel.sample_data {
                FlatSamples::F32(values) => (false, values.iter().map(|v| v.to_bits()).collect()),
                FlatSamples::U32(values) => (true, values.clone()),
                FlatSamples::F16(_) => panic!("no channel has 16 bits"),
            };
            (channel.name.to_string(), samples)
        })
        .collect()
    }

    #[test]
    fn every_sample_is_kept_bit_for_bit() {
        let all = picture(Display::Exposed);
        let file = read(&encode_all(&all, LayerKind::ALL));
        let (film, layers, quality) = all;
        let pixels = layers.pixels();
        let mut expected = BTreeMap::new();
        let mut add = |name: &str, id, samples: Vec<u32>| {
            expected.insert(name.to_owned(), (id, samples));
        };
        for (index, name) in ["R", "G", "B"].into_iter().enumerate() {
            add(name, false, film.pixels().iter().map(|v| v[index].to_bits()).collect());
            let albedo = pixels.iter().map(|v| v.albedo[index].to_bits()).collect();
            add(&format!("albedo.{name}"), false, albedo);
            let normal = pixels.iter().map(|v| v.normal[index].to_bits()).collect();
            add(&format!("normal.{}", ["X", "Y", "Z"][index]), false, normal);
        }
        add("depth.axis", false, pixels.iter().map(|v| v.axis_depth.to_bits()).collect());
        add("depth.ray", false, pixels.iter().map(|v| v.ray_depth.to_bits()).collect());
        let known = quality.pixels();
        add("error.rms", false, known.iter().map(|v| v.error.to_bits()).collect());
        add("error.interval", false, known.iter().map(|v| v.interval.to_bits()).collect());
        add("samples.count", true, known.iter().map(|v| v.samples).collect());
        add("shape.id", true, pixels.iter().map(|v| v.shape).collect());
        add("instance.id", true, pixels.iter().map(|v| v.instance).collect());
        assert_eq!(file.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
        for (name, samples) in &expected {
            assert!(file[name] == *samples, "{name}");
        }
    }

    #[test]
    fn the_picture_in_it_is_that_of_the_plain_file() {
        for display in [Display::Exposed, Display::Brightest { white: 255.0 }] {
            let all = picture(display);
            let plain = encode(&all.0, Format::Exr, Bits::Eight).expect("it encodes");
            let plain = decode(&plain).expect("it decodes");
            for kinds in [&[][..], &[LayerKind::Shape], LayerKind::ALL] {
                let picture = decode(&encode_all(&all, kinds)).expect("it decodes");
                assert_eq!((picture.width, picture.height), (131, 70));
                let comparison = compare(&plain, &picture).expect("same size");
                assert_eq!((comparison.differing, comparison.largest), (0, 0.0));
            }
        }
    }

    #[test]
    fn only_the_kinds_asked_for_are_written() {
        let all = picture(Display::Exposed);
        let whole = read(&encode_all(&all, LayerKind::ALL));
        let mut seen = 3;
        for kind in LayerKind::ALL {
            let file = read(&encode_all(&all, &[*kind]));
            let group = format!("{}.", kind.name());
            for (name, samples) in &file {
                assert!(name.starts_with(&group) || ["R", "G", "B"].contains(&&**name), "{name}");
                assert!(whole[name] == *samples, "{name}");
            }
            seen += file.len() - 3;
        }
        assert_eq!((seen, whole.len()), (16, 16));
        // What is not there is not written.
        let (film, layers, quality) = &all;
        let without = |layers, quality| {
            let bytes = encode_exr_with_layers(film, layers, quality, LayerKind::ALL);
            read(&bytes.expect("it encodes")).len()
        };
        assert_eq!((without(None, Some(quality)), without(Some(layers), None)), (6, 13));
    }

    #[test]
    fn the_bytes_depend_on_the_arguments_alone() {
        let mut all = picture(Display::Exposed);
        let once = encode_all(&all, LayerKind::ALL);
        let mut kinds = LayerKind::ALL.to_vec();
        kinds.reverse();
        kinds.push(LayerKind::Depth);
        for _ in 0..3 {
            let again = encode_all(&all, &kinds);
            assert!(again == once, "neither time nor the order or number of names counts");
        }
        all.0.set_stops(3.0);
        let again = encode_all(&all, &kinds);
        assert!(again == once, "the exposure does not count");
    }

    #[test]
    fn layers_of_another_window_are_refused() {
        let (film, _, quality) = picture(Display::Exposed);
        let with = |layers| encode_exr_with_layers(&film, Some(layers), Some(&quality), &[]);
        let layers = Layers::new(film.frame(), film.frame().window()).expect("it fits");
        let error = with(&layers).expect_err("another window");
        assert_eq!(
            error.to_string(),
            "the layers are of the window 0,0,150,100 (x,y,width,height) of 150x100 pixels, the \
             film of 7,9,131,70 of 150x100"
        );
        let layers = Layers::new(Size::new(151, 100), film.window()).expect("it fits");
        assert!(with(&layers).is_err(), "another frame");
        let quality = Quality::new(film.frame(), film.frame().window()).expect("it fits");
        assert!(encode_exr_with_layers(&film, None, Some(&quality), &[]).is_err());
    }
}
