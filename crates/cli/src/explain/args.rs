//! What may be written about explanations.

use crate::args::{number, parse_cutoff, parse_exposure, parse_size};
use clap::Args;
use lancer_film::Size;
use lancer_integrator::{Sampling, Whitted};
use lancer_scene::Exposure;
use std::path::PathBuf;

/// What to explain, and how.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The scene file; `-` is standard input
    pub scene: PathBuf,

    /// Show the rays of this pixel, and not what is done for the scene: column and row, 0,0 being the
    /// top left one
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel, allow_hyphen_values = true)]
    pub pixel: Option<(u32, u32)>,

    /// The error that a plan is for, as of render
    #[arg(long, value_name = "E", default_value_t = Sampling::ERROR, value_parser = parse_error,
          conflicts_with = "pixel", allow_hyphen_values = true)]
    pub error: f64,

    /// Leave nothing out, as render does
    #[arg(long, conflicts_with = "pixel")]
    pub full_model: bool,

    /// Print the plan, or all rays, as JSON
    #[arg(long)]
    pub json: bool,

    /// Show all rays as text, however many there are
    #[arg(long, conflicts_with = "json", requires = "pixel")]
    pub all: bool,

    /// Write the rays as lines to an OBJ file, to be seen in space
    #[arg(long, value_name = "FILE", requires = "pixel")]
    pub obj: Option<PathBuf>,

    /// Write a drawing of the rays, seen from where they spread most
    #[arg(long, value_name = "FILE", requires = "pixel")]
    pub svg: Option<PathBuf>,

    /// How bright the picture is shown: a number of stops, or auto; how the pixel is shown is told then.
    /// Else the camera's own, if that is a number
    #[arg(long, value_name = "STOPS", value_parser = parse_exposure, allow_hyphen_values = true)]
    pub exposure: Option<Exposure>,

    /// Do not follow rays that together could change the pixel by no more than this part of display
    /// white (a fifth of the error that a plan is for; 0.0001 for a pixel)
    #[arg(long, value_name = "C", value_parser = parse_cutoff, allow_hyphen_values = true)]
    pub cutoff: Option<Whitted>,

    /// Take the picture to be so many pixels large, whatever the scene says
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub size: Option<Size>,

    /// Say nothing but errors beside the rays
    #[arg(short, long)]
    pub quiet: bool,

    /// Refuse pictures of more pixels
    #[arg(long, value_name = "N", default_value_t = lancer_xml::MAX_PIXELS)]
    pub max_pixels: u64,
}

fn parse_pixel(text: &str) -> Result<(u32, u32), String> {
    let pixel = text.split_once(',').and_then(|(x, y)| number(x).zip(number(y)));
    pixel.ok_or_else(|| "expected a column and a row, such as 200,150".to_owned())
}

fn parse_error(text: &str) -> Result<f64, String> {
    let error = text.parse().ok().filter(|error: &f64| *error > 0.0 && error.is_finite());
    error.ok_or_else(|| "expected a number above 0".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_read_or_refused() {
        assert_eq!(parse_pixel("0,299"), Ok((0, 299)));
        for bad in ["", "1", "1,", ",1", "-1,2", "1,2,3", "1.5,2", "1, 2", "4294967296,0"] {
            assert!(parse_pixel(bad).is_err(), "{bad}");
        }
    }
}
