//! Charts on logarithmic axes, as SVG with the same bytes on every run.

use crate::{Failure, fail};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;
use std::path::Path;

/// A method that a line stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Line {
    TextbookSingle,
    TextbookDouble,
    OursSingle,
    OursDouble,
    /// One unit in the last place of a double.
    Rounding,
}

impl Line {
    pub(super) const ALL: [Self; 5] = [
        Self::TextbookSingle,
        Self::TextbookDouble,
        Self::OursSingle,
        Self::OursDouble,
        Self::Rounding,
    ];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::TextbookSingle => "textbook, single",
            Self::TextbookDouble => "textbook, double",
            Self::OursSingle => "our form in single",
            Self::OursDouble => "Lancer (double)",
            Self::Rounding => "one unit of t's last place, double",
        }
    }

    const fn colour(self) -> RGBColor {
        match self {
            Self::TextbookSingle => RGBColor(236, 150, 60),
            Self::TextbookDouble => RGBColor(190, 40, 40),
            Self::OursSingle => RGBColor(110, 170, 225),
            Self::OursDouble => RGBColor(20, 80, 170),
            Self::Rounding => RGBColor(140, 140, 140),
        }
    }

    const fn width(self) -> u32 {
        match self {
            Self::OursDouble => 3,
            Self::Rounding => 1,
            _ => 2,
        }
    }
}

/// Points of a line, from left to right.
pub(super) type Points = Vec<(f64, f64)>;

/// One pair of axes.
pub(super) struct Panel {
    pub(super) title: &'static str,
    pub(super) x: &'static str,
    pub(super) y: &'static str,
    pub(super) x_range: Range<f64>,
    /// What is outside is drawn at the border.
    pub(super) y_range: Range<f64>,
    pub(super) fails: Fails,
    pub(super) lines: Vec<(Line, Points)>,
}

/// Where it is difficult.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fails {
    Left,
    Right,
}

impl Panel {
    /// Up to where a line stays at or below a thousandth, if it goes above.
    pub(super) fn holds_to(&self, line: Line) -> Option<Option<f64>> {
        const MOST: f64 = 1e-3;
        let (_, points) = self.lines.iter().find(|(l, _)| *l == line)?;
        let holds = |(_, y): &&(f64, f64)| *y <= MOST;
        let (held, end) = match self.fails {
            Fails::Right => (points.iter().take_while(holds).last(), points.last()),
            Fails::Left => (points.iter().rev().take_while(holds).last(), points.first()),
        };
        match held {
            None => Some(Some(f64::NAN)),
            held if held == end => Some(None),
            held => Some(held.map(|(x, _)| *x)),
        }
    }
}

const PANEL: (u32, u32) = (400, 360);
const LEGEND: u32 = 34;
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(40, 40, 40);

/// Panels side by side, with one legend below.
pub(super) fn draw(path: &Path, panels: &[Panel]) -> Result<(), Failure> {
    let size = (PANEL.0 * panels.len() as u32, PANEL.1 + LEGEND);
    let root = SVGBackend::new(path, size).into_drawing_area();
    // A card of its own, so that it can be read on pages of any colour.
    root.fill(&WHITE).map_err(fail)?;
    let (charts, legend) = root.split_vertically(PANEL.1);
    for (area, panel) in charts.split_evenly((1, panels.len())).iter().zip(panels) {
        chart(area, panel)?;
    }
    let used = |line: &&Line| panels.iter().any(|p| p.lines.iter().any(|(l, _)| l == *line));
    let mut x = 20;
    for line in Line::ALL.iter().filter(used) {
        let style = line.colour().stroke_width(line.width() + 1);
        legend.draw(&PathElement::new(vec![(x, 14), (x + 26, 14)], style)).map_err(fail)?;
        let text = (FONT, 13).into_font().color(&INK);
        legend.draw(&Text::new(line.name(), (x + 32, 7), text)).map_err(fail)?;
        x += 60 + 7 * line.name().len() as i32;
    }
    root.present().map_err(fail)
}

fn chart(area: &DrawingArea<SVGBackend<'_>, Shift>, panel: &Panel) -> Result<(), Failure> {
    let mut chart = ChartBuilder::on(area)
        .caption(panel.title, (FONT, 15).into_font().color(&INK))
        .margin(8)
        .margin_right(16)
        .x_label_area_size(42)
        .y_label_area_size(62)
        .build_cartesian_2d(panel.x_range.clone().log_scale(), panel.y_range.clone().log_scale())
        .map_err(fail)?;
    let text = (FONT, 12).into_font().color(&INK);
    chart
        .configure_mesh()
        .x_labels(8)
        .y_labels(10)
        .x_desc(panel.x)
        .y_desc(panel.y)
        .x_label_formatter(&|x| power(*x))
        .y_label_formatter(&|y| power(*y))
        .label_style(text.clone())
        .axis_desc_style(text)
        .axis_style(INK)
        .bold_line_style(RGBColor(215, 215, 215))
        .light_line_style(WHITE)
        .draw()
        .map_err(fail)?;
    let Range { start, end } = panel.y_range;
    for (line, points) in &panel.lines {
        let points = points.iter().map(|&(x, y)| (x, if y > start { y.min(end) } else { start }));
        let style = line.colour().stroke_width(line.width());
        if *line == Line::Rounding {
            chart.draw_series(DashedLineSeries::new(points, 4, 4, style)).map_err(fail)?;
        } else {
            chart.draw_series(LineSeries::new(points, style)).map_err(fail)?;
        }
    }
    Ok(())
}

/// 10 with a raised exponent.
fn power(value: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let exponent = libm::rint(libm::log10(value)) as i32;
    let digits = exponent.abs().to_string();
    let raised = digits.bytes().map(|digit| RAISED[usize::from(digit - b'0')]);
    let sign = (exponent < 0).then_some('⁻');
    "10".chars().chain(sign).chain(raised).collect()
}
