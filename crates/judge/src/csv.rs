//! Comparisons as tables of comma-separated values (RFC 4180).

use crate::{Comparison, Place, Series};
use std::fmt::Write;

/// The columns.
const HEAD: &str = "series,peer,setting,seconds,error,predicted,samples,front,knee\r\n";

/// A line for each point: what the series and the setting are, seconds, errors, the number of samples, and
/// whether the point is on the front and at the knee. What is not known is empty.
#[must_use]
pub fn csv(comparison: &Comparison) -> String {
    let (front, knee) = (comparison.front(), comparison.knee());
    let mut text = HEAD.to_owned();
    for place in comparison.places() {
        let Place { series, .. } = place;
        let Series { name, is_peer, .. } = &comparison.series()[series];
        let point = comparison.point(place);
        let predicted = point.predicted.map_or_else(String::new, |v| v.to_string());
        let samples = point.samples.map_or_else(String::new, |v| v.to_string());
        let is_on_front = front.contains(&place);
        let _ = write!(
            text,
            "{},{is_peer},{},{},{},{predicted},{samples},{is_on_front},{}\r\n",
            field(name),
            field(&point.setting),
            point.seconds,
            point.error,
            knee == Some(place),
        );
    }
    text
}

/// A text with quotation marks around it where it needs them.
fn field(text: &str) -> String {
    if text.contains(['"', ',', '\r', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    #[test]
    fn each_point_has_its_line() {
        let known = Point {
            predicted: Some(0.0025),
            samples: Some(480_000),
            ..Point::new("--error 0.002", 0.055, 0.0021)
        };
        let comparison = Comparison::new(vec![
            Series::new("edges", vec![known]),
            Series::peer("a \"b\", c", vec![Point::new("+A0.3", 1.25, 0.0043)]),
        ]);
        assert_eq!(
            csv(&comparison),
            "series,peer,setting,seconds,error,predicted,samples,front,knee\r\n\
             edges,false,--error 0.002,0.055,0.0021,0.0025,480000,true,true\r\n\
             \"a \"\"b\"\", c\",true,+A0.3,1.25,0.0043,,,false,false\r\n"
        );
    }
}
