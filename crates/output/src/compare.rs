use crate::Picture;

/// How much two pictures differ. Differences are in levels of 255 of one
/// component: red, green, blue or opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// How many pixels each picture has.
    pub pixels: u64,
    /// How many pixels differ at all.
    pub differing: u64,
    /// The largest difference; infinite where a component is a number in one
    /// picture only.
    pub largest: f64,
    /// Column and row of the first pixel with the largest difference.
    pub largest_at: Option<(u32, u32)>,
    /// The root of the mean square of all differences of red, green and blue.
    pub rmse: f64,
    /// The mean of second minus first over red, green and blue: a drift that
    /// squares do not show.
    pub mean_signed: f64,
}

/// Pictures of different sizes cannot be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the pictures have different sizes: {}x{} and {}x{}", .0[0], .0[1], .0[2], .0[3])]
pub struct SizesDiffer([u32; 4]);

/// Compares two pictures pixel by pixel.
///
/// # Errors
/// Where their sizes differ.
pub fn compare(a: &Picture, b: &Picture) -> Result<Comparison, SizesDiffer> {
    let pixels = pixel_count(a, b)?;
    let mut result = Comparison {
        pixels: pixels as u64,
        differing: 0,
        largest: 0.0,
        largest_at: None,
        rmse: 0.0,
        mean_signed: 0.0,
    };
    let (mut squares, mut sum) = (0.0, 0.0);
    for index in 0..pixels {
        let signed = differences(a, b, index);
        for difference in &signed[..3] {
            squares += difference * difference;
            sum += difference;
        }
        let size = size(signed);
        if size > 0.0 {
            result.differing += 1;
        }
        if size > result.largest {
            result.largest = size;
            result.largest_at = Some((
                (index as u64 % u64::from(a.width)) as u32,
                (index as u64 / u64::from(a.width)) as u32,
            ));
        }
    }
    let components = 3.0 * pixels as f64;
    result.rmse = (squares / components).sqrt();
    result.mean_signed = sum / components;
    Ok(result)
}

/// A picture of the differences: where there is none the first picture, dark
/// and grey; where there is one red, the brighter the larger it is.
///
/// # Errors
/// Where the sizes of the pictures differ.
pub fn difference_picture(a: &Picture, b: &Picture) -> Result<image::RgbImage, SizesDiffer> {
    let pixels = pixel_count(a, b)?;
    let sizes: Vec<f64> = (0..pixels).map(|index| size(differences(a, b, index))).collect();
    let largest = sizes.iter().copied().filter(|size| size.is_finite()).fold(0.0, f64::max);
    let mut image = image::RgbImage::new(a.width, a.height);
    for (index, (pixel, size)) in image.pixels_mut().zip(sizes).enumerate() {
        pixel.0 = if size > 0.0 {
            let share = if size < largest { size / largest } else { 1.0 };
            [(96.0 + 159.0 * share) as u8, 0, 0]
        } else {
            let [red, green, blue, _] = a.levels(index);
            [((red + 2.0 * green + blue) / 16.0) as u8; 3]
        };
    }
    Ok(image)
}

fn pixel_count(a: &Picture, b: &Picture) -> Result<usize, SizesDiffer> {
    if (a.width, a.height) != (b.width, b.height) {
        return Err(SizesDiffer([a.width, a.height, b.width, b.height]));
    }
    Ok(a.width as usize * a.height as usize)
}

/// Second minus first. Equal infinities do not differ, and neither do two that
/// are not numbers; one that is not a number differs infinitely from any.
fn differences(a: &Picture, b: &Picture, index: usize) -> [f64; 4] {
    let (a, b) = (a.levels(index), b.levels(index));
    std::array::from_fn(|channel| {
        let (a, b) = (a[channel], b[channel]);
        match (a.is_nan(), b.is_nan()) {
            (true, true) => 0.0,
            (false, false) if a == b => 0.0,
            (false, false) => b - a,
            _ => f64::INFINITY,
        }
    })
}

fn size(signed: [f64; 4]) -> f64 {
    signed.iter().fold(0.0, |size, difference| difference.abs().max(size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, decode, encode_rgb8};

    fn picture(pixels: &[[u8; 3]]) -> Picture {
        let image = image::RgbImage::from_raw(pixels.len() as u32, 1, pixels.concat());
        let image = image.expect("three codes for each pixel");
        decode(&encode_rgb8(&image, Format::Png).expect("it encodes")).expect("it decodes")
    }

    #[test]
    fn equal_pictures_do_not_differ() {
        let a = picture(&[[1, 2, 3], [255, 0, 7]]);
        let comparison = compare(&a, &a).expect("same size");
        assert_eq!((comparison.differing, comparison.largest), (0, 0.0));
        assert_eq!(comparison.largest_at, None);
    }

    #[test]
    fn differences_are_counted_by_hand() {
        let a = picture(&[[10, 20, 30], [0, 0, 0], [5, 5, 5], [9, 9, 9]]);
        let b = picture(&[[10, 20, 30], [0, 3, 0], [5, 5, 1], [9, 9, 9]]);
        let comparison = compare(&a, &b).expect("same size");
        assert_eq!(comparison.pixels, 4);
        assert_eq!(comparison.differing, 2);
        assert_eq!(comparison.largest, 4.0);
        assert_eq!(comparison.largest_at, Some((2, 0)));
        assert!((comparison.rmse - (25.0_f64 / 12.0).sqrt()).abs() < 1e-12);
        assert!((comparison.mean_signed - -1.0 / 12.0).abs() < 1e-12);
        let image = difference_picture(&a, &b).expect("same size");
        assert_eq!(image.get_pixel(2, 0).0, [255, 0, 0]);
        assert_eq!(image.get_pixel(1, 0).0, [215, 0, 0]);
        assert_eq!(image.get_pixel(3, 0).0, [2, 2, 2]);
    }

    #[test]
    fn sizes_must_agree() {
        let error = compare(&picture(&[[0; 3]]), &picture(&[[0; 3]; 2])).expect_err("they differ");
        assert_eq!(error.to_string(), "the pictures have different sizes: 1x1 and 2x1");
    }
}
