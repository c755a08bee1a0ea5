//! A comparison as a drawing, and as a page with the drawing and a table.

use crate::axis::{Axis, Measure};
use crate::chart::{Chart, Group, Mark};
use crate::compared::{Comparison, Place, Series, error, time};
use crate::drawing::{Colour, Drawing, escaped};
use std::fmt::Write;

/// What is said around a comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caption {
    /// Which scene and how large.
    pub title: String,
    /// More lines: the reference, the machine, what was left out.
    pub notes: Vec<String>,
    /// The command that made it.
    pub command: String,
}

const OWN: [(Colour, Mark); 4] = [
    ([20, 80, 170], Mark::Disc),
    ([30, 140, 90], Mark::Square),
    ([150, 90, 180], Mark::Triangle),
    ([0, 140, 170], Mark::Diamond),
];
const PEERS: [(Colour, Mark); 4] = [
    ([190, 60, 30], Mark::Diamond),
    ([210, 130, 20], Mark::Triangle),
    ([120, 90, 60], Mark::Square),
    ([160, 40, 100], Mark::Disc),
];
const FRONT: Colour = [190, 210, 240];

/// Draws time against error.
#[must_use]
pub fn draw(comparison: &Comparison, caption: &Caption) -> Drawing {
    let front = comparison.front();
    let knee = comparison.knee();
    let value = |place: Place| {
        let point = comparison.point(place);
        [point.seconds, point.error]
    };
    let all = || comparison.places().map(value);
    let mut groups = vec![Group {
        name: "front: none is both faster and more exact".to_owned(),
        colour: FRONT,
        mark: None,
        line: 9.0,
        dash: 0.0,
        points: front.iter().map(|place| (value(*place), None)).collect(),
    }];
    // Peers are seldom on top of anything, and those named first in the legend are ours.
    let order = comparison.series().iter().enumerate();
    let (peers, own): (Vec<_>, Vec<_>) = order.partition(|(_, series)| series.is_peer);
    for (kinds, looks) in [(peers, PEERS), (own, OWN)] {
        let looks = looks.iter().cycle();
        let drawn = kinds.into_iter().zip(looks).map(|((index, series), (colour, mark))| {
            let named = |point: usize| {
                let is_on_front = front.contains(&Place { series: index, point });
                (series.is_peer || is_on_front).then(|| series.points[point].setting.clone())
            };
            let places = (0..series.points.len()).map(|point| Place { series: index, point });
            Group {
                name: series.name.clone(),
                colour: *colour,
                mark: Some(*mark),
                line: 1.5,
                dash: 0.0,
                points: places.map(|place| (value(place), named(place.point))).collect(),
            }
        });
        groups.extend(drawn.collect::<Vec<_>>().into_iter().rev());
    }
    let mut notes: Vec<String> = comparison.advice().into_iter().collect();
    notes.extend(caption.notes.iter().cloned());
    notes.push(caption.command.clone());
    Chart {
        title: caption.title.clone(),
        across: Axis::over("wall time of the rendering", Measure::Time, all().map(|[x, _]| x)),
        up: Axis::over(
            "true error (RMS, linear; 1 is display white)",
            Measure::Number,
            all().map(|[_, y]| y),
        ),
        groups,
        ringed: knee.map(|place| (value(place), "the knee".to_owned())),
        notes,
    }
    .draw()
}

const STYLE: &str = "\
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 60em; padding: 0 1em; color: #282828; background: #fff }
table { border-collapse: collapse }
th, td { padding: 0.2em 0.8em; text-align: right; border-bottom: 1px solid #ddd }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2) { text-align: left }
tr.front { background: #e6eefa }
tr.knee { font-weight: bold }
svg { max-width: 100%; height: auto }
code { background: #f2f2f2; padding: 0.1em 0.3em }
";

/// The drawing and all of its points in a page of its own that needs nothing else.
#[must_use]
pub fn html(comparison: &Comparison, caption: &Caption) -> String {
    let title = escaped(&caption.title);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{}",
        draw(comparison, caption).svg()
    );
    for text in comparison.advice().iter().chain(&caption.notes) {
        // Writing to a string does not fail.
        let _ = writeln!(page, "<p>{}</p>", escaped(text));
    }
    page.push_str(
        "<table>\n<tr><th>series</th><th>setting</th><th>time</th><th>error</th><th>predicted</th><th>samples</th></tr>\n",
    );
    let (front, knee) = (comparison.front(), comparison.knee());
    for place in comparison.places() {
        let Series { name, .. } = &comparison.series()[place.series];
        let point = comparison.point(place);
        let class = match (front.contains(&place), knee == Some(place)) {
            (true, true) => " class=\"front knee\"",
            (true, false) => " class=\"front\"",
            _ => "",
        };
        let _ = writeln!(
            page,
            "<tr{class}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escaped(name),
            escaped(&point.setting),
            time(point.seconds),
            error(point.error),
            point.predicted.map(error).unwrap_or_default(),
            point.samples.map(|samples| samples.to_string()).unwrap_or_default(),
        );
    }
    let _ = write!(
        page,
        "</table>\n<p>The front is shaded, the knee bold. Made by <code>{}</code></p>\n</body>\n</html>\n",
        escaped(&caption.command)
    );
    page
}

/// Predicted against true errors, a line of the legend for each level that was asked for.
#[must_use]
pub fn scatter(levels: &[(String, Vec<[f64; 2]>)], caption: &Caption) -> Drawing {
    let values = || levels.iter().flat_map(|(_, points)| points.iter().flatten().copied());
    let across = Axis::over("predicted error", Measure::Number, values());
    let up = Axis::over("true error", Measure::Number, values());
    let (least, most) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
    // Within the axes, from the least to the largest true error.
    let straight = |name: &str, factor: f64, dash: f64| Group {
        name: name.to_owned(),
        colour: [150; 3],
        mark: None,
        line: 1.0,
        dash,
        points: [least / factor, most].map(|v| ([v, v * factor], None)).into(),
    };
    let mut groups = Vec::new();
    if least <= most {
        groups.push(straight("true is half of predicted", 0.5, 4.0));
        groups.push(straight("true is as predicted", 1.0, 0.0));
    }
    let looks = OWN.iter().cycle();
    groups.extend(levels.iter().zip(looks).map(|((name, points), (colour, mark))| Group {
        name: name.clone(),
        colour: *colour,
        mark: Some(*mark),
        line: 0.0,
        dash: 0.0,
        points: points.iter().map(|point| (*point, None)).collect(),
    }));
    let mut notes = caption.notes.clone();
    notes.push(caption.command.clone());
    Chart { title: caption.title.clone(), across, up, groups, ringed: None, notes }.draw()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    fn comparison() -> Comparison {
        Comparison::new(vec![
            Series::new(
                "edges",
                vec![
                    Point::new("--error 0.004", 0.03, 0.0041),
                    Point::new("--error 0.001", 0.1, 0.001),
                ],
            ),
            Series::new("sobol", vec![Point::new("--samples 16", 0.5, 0.003)]),
            Series::peer("POV-Ray <3.7>", vec![Point::new("+A0.3", 1.1, 0.0043)]),
        ])
    }

    fn caption() -> Caption {
        Caption {
            title: "scene.xml, 800x600".to_owned(),
            notes: vec!["The reference is off by 0.00003 itself.".to_owned()],
            command: "lancer chart scene.xml -o chart.svg".to_owned(),
        }
    }

    #[test]
    fn the_drawing_says_everything() {
        let svg = draw(&comparison(), &caption()).svg();
        for text in [
            "scene.xml, 800x600",
            "wall time of the rendering",
            "true error (RMS, linear; 1 is display white)",
            "--error 0.001",
            "+A0.3",
            "At the knee: --error 0.001 (edges)",
            "The reference is off by",
            "lancer chart scene.xml -o chart.svg",
            "POV-Ray",
            "&lt;3.7&gt;",
            "front:",
            "100 ms",
        ] {
            assert!(svg.contains(text), "{text} is missing");
        }
        assert!(!svg.contains("--samples 16"), "only the front and peers have words beside");
    }

    #[test]
    fn the_page_stands_alone() {
        let page = html(&comparison(), &caption());
        assert!(page.contains("<td>sobol</td><td>--samples 16</td><td>500 ms</td><td>0.0030</td>"));
        assert!(page.contains("<tr class=\"front knee\"><td>edges</td><td>--error 0.001</td>"));
        assert_eq!(page.matches("<svg").count(), 1);
        for outside in ["src=", "href=", "@import", "url("] {
            assert!(!page.contains(outside), "{outside}");
        }
        let open = page.matches("<p>").count();
        assert_eq!(page.matches("</p>").count(), open);
    }

    #[test]
    fn a_scatter_has_its_diagonal() {
        let levels = [
            ("0.004".to_owned(), vec![[0.004, 0.0035]]),
            ("0.001".to_owned(), vec![[0.001, 8e-4]]),
        ];
        let svg = scatter(&levels, &caption()).svg();
        assert!(svg.contains("true is as") && svg.contains("predicted error"));
        assert!(!scatter(&[], &caption()).svg().contains("true is"));
    }
}
