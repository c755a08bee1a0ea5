//! Drawings as SVG.

use super::{Anchor, At, Colour, Drawing, Hand, Shape};
use std::fmt::Write;

impl Drawing {
    /// The drawing as a file in the format SVG. The same drawing has the same bytes.
    #[must_use]
    pub fn svg(&self) -> String {
        let Self { width, height, shapes, title } = self;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" \
             role=\"img\">\n<title>{}</title>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
            escaped(title)
        );
        for shape in shapes {
            write_shape(&mut svg, shape);
        }
        svg.push_str("</svg>\n");
        svg
    }
}

fn write_shape(svg: &mut String, shape: &Shape) {
    // Writing to a string does not fail.
    let _ = match shape {
        Shape::Line { points, width, colour, dash } => {
            let dashes = match *dash {
                0.0 => String::new(),
                dash => format!(" stroke-dasharray=\"{dash}\""),
            };
            writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" \
                 stroke-linecap=\"round\" stroke-linejoin=\"round\"{dashes}/>",
                list(points),
                hex(*colour)
            )
        }
        Shape::Disc { centre: [x, y], radius, colour } => {
            let fill = hex(*colour);
            writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\"/>")
        }
        Shape::Ring { centre: [x, y], radius, width, colour } => writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"none\" stroke=\"{}\" \
             stroke-width=\"{width}\"/>",
            hex(*colour)
        ),
        Shape::Polygon { corners, colour } => {
            writeln!(svg, "<polygon points=\"{}\" fill=\"{}\"/>", list(corners), hex(*colour))
        }
        Shape::Words { at: [x, y], text, hand, anchor, colour, upward } => {
            let anchor = match anchor {
                Anchor::Start => "",
                Anchor::Middle => " text-anchor=\"middle\"",
                Anchor::End => " text-anchor=\"end\"",
            };
            let weight = if *hand == Hand::Title { " font-weight=\"bold\"" } else { "" };
            let turned = match upward {
                true => format!(" transform=\"rotate(-90 {x:.1} {y:.1})\""),
                false => String::new(),
            };
            writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{}\" fill=\"{}\"{anchor}{weight}{turned}>{}</text>",
                hand.size(),
                hex(*colour),
                escaped(text)
            )
        }
    };
}

fn list(points: &[At]) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

fn hex([red, green, blue]: Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A text as it stands in XML and HTML. What these do not allow at all becomes a question mark.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('?'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_cannot_break_out() {
        assert_eq!(escaped("a<b>\"&\u{1b}\n"), "a&lt;b&gt;&quot;&amp;??");
    }

    #[test]
    fn each_shape_is_an_element() {
        let drawing = Drawing {
            width: 20,
            height: 10,
            title: "T & U".to_owned(),
            shapes: vec![
                Shape::Line {
                    points: vec![[0.0, 1.0], [2.0, 3.5]],
                    width: 2.0,
                    colour: [255, 0, 16],
                    dash: 3.0,
                },
                Shape::Words {
                    at: [5.0, 6.0],
                    text: "<up>".to_owned(),
                    hand: Hand::Title,
                    anchor: Anchor::Middle,
                    colour: [0; 3],
                    upward: true,
                },
            ],
        };
        let svg = drawing.svg();
        let lines: Vec<_> = svg.lines().collect();
        assert_eq!(lines[1], "<title>T &amp; U</title>");
        assert_eq!(
            lines[3],
            "<polyline points=\"0.0,1.0 2.0,3.5\" fill=\"none\" stroke=\"#ff0010\" \
             stroke-width=\"2\" stroke-linecap=\"round\" stroke-linejoin=\"round\" \
             stroke-dasharray=\"3\"/>"
        );
        assert_eq!(
            lines[4],
            "<text x=\"5.0\" y=\"6.0\" font-size=\"12\" fill=\"#000000\" text-anchor=\"middle\" \
             font-weight=\"bold\" transform=\"rotate(-90 5.0 6.0)\">&lt;up&gt;</text>"
        );
        assert_eq!(lines.last(), Some(&"</svg>"));
    }
}
