//! Charts: points and lines on two logarithmic axes, with a legend and words below.

use crate::axis::Axis;
use crate::drawing::{Anchor, At, Colour, Drawing, Hand, Shape};

/// How a point looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    Disc,
    Square,
    Triangle,
    Diamond,
}

/// A line of the legend, and what it stands for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) colour: Colour,
    /// Lines without are not marked.
    pub(crate) mark: Option<Mark>,
    /// How wide the line is that joins the points; 0 for none.
    pub(crate) line: f64,
    /// The length of that line's dashes; 0 for none.
    pub(crate) dash: f64,
    /// Values along both axes, and the words beside, if there is room.
    pub(crate) points: Vec<([f64; 2], Option<String>)>,
}

/// A chart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) across: Axis,
    pub(crate) up: Axis,
    /// The first at the bottom, and the last in the legend.
    pub(crate) groups: Vec<Group>,
    /// A point with a ring around it, and what that means.
    pub(crate) ringed: Option<([f64; 2], String)>,
    /// Below all, a line of text or more each.
    pub(crate) notes: Vec<String>,
}

const INK: Colour = [40; 3];
const MINOR: Colour = [240; 3];
const MAJOR: Colour = [218; 3];
const RING: Colour = [200, 30, 30];

const WIDTH: f64 = 860.0;
/// From the top to the upper end of the axis.
const TOP: f64 = 34.0;
const LEFT: f64 = 84.0;
const LEGEND: f64 = 206.0;
const PLOT: [f64; 2] = [WIDTH - LEFT - LEGEND, 400.0];
const LINE: f64 = 17.0;

impl Chart {
    /// What it looks like.
    pub(crate) fn draw(&self) -> Drawing {
        let mut shapes = Vec::new();
        self.draw_axes(&mut shapes);
        self.draw_groups(&mut shapes);
        self.draw_legend(&mut shapes);
        let letters = ((WIDTH - 2.0 * MARGIN) / Hand::Plain.advance()) as usize;
        let mut y = TOP + PLOT[1] + 62.0;
        for line in self.notes.iter().flat_map(|note| wrapped(note, letters)) {
            shapes.push(words([MARGIN, y], line, Hand::Plain, Anchor::Start));
            y += LINE;
        }
        let height = y.max(TOP + LINE * (3 + 2 * self.groups.len()) as f64);
        Drawing { width: WIDTH as u32, height: height as u32, shapes, title: self.title.clone() }
    }

    fn at(&self, [x, y]: [f64; 2]) -> At {
        [LEFT + PLOT[0] * self.across.part(x), TOP + PLOT[1] * (1.0 - self.up.part(y))]
    }

    fn draw_axes(&self, shapes: &mut Vec<Shape>) {
        let [left, bottom] = [LEFT, TOP + PLOT[1]];
        let [right, top] = [LEFT + PLOT[0], TOP];
        shapes.push(words([LEFT, 20.0], &self.title, Hand::Title, Anchor::Start));
        let mut named = Vec::new();
        for (value, name) in self.across.ticks() {
            let x = LEFT + PLOT[0] * self.across.part(value);
            let colour = if name.is_some() { MAJOR } else { MINOR };
            shapes.push(line(vec![[x, top], [x, bottom]], 1.0, colour));
            named.extend(name.map(|n| words([x, bottom + 18.0], n, Hand::Plain, Anchor::Middle)));
        }
        for (value, name) in self.up.ticks() {
            let y = TOP + PLOT[1] * (1.0 - self.up.part(value));
            let colour = if name.is_some() { MAJOR } else { MINOR };
            shapes.push(line(vec![[left, y], [right, y]], 1.0, colour));
            named.extend(name.map(|n| words([left - 7.0, y + 4.0], n, Hand::Plain, Anchor::End)));
        }
        shapes.append(&mut named);
        shapes.push(line(vec![[left, top], [left, bottom], [right, bottom]], 1.0, INK));
        let middle = 0.5 * (left + right);
        shapes.push(words(
            [middle, bottom + 38.0],
            &self.across.title,
            Hand::Plain,
            Anchor::Middle,
        ));
        shapes.push(Shape::Words {
            at: [16.0, 0.5 * (top + bottom)],
            text: self.up.title.clone(),
            hand: Hand::Plain,
            anchor: Anchor::Middle,
            colour: INK,
            upward: true,
        });
    }

    fn draw_groups(&self, shapes: &mut Vec<Shape>) {
        let mut taken: Vec<Room> = Vec::new();
        let mut lines: Vec<Room> = Vec::new();
        for group in &self.groups {
            let points: Vec<At> = group.points.iter().map(|(point, _)| self.at(*point)).collect();
            if group.line > 0.0 {
                shapes.push(Shape::Line {
                    points: points.clone(),
                    width: group.line,
                    colour: group.colour,
                    dash: group.dash,
                });
                lines.extend(points.windows(2).flat_map(|ends| along(ends[0], ends[1])));
            }
            if let Some(mark) = group.mark {
                shapes.extend(points.iter().map(|at| mark.at(*at, 4.0, group.colour)));
                taken.extend(points.iter().map(|[x, y]| [x - 5.0, y - 5.0, x + 5.0, y + 5.0]));
            }
        }
        if let Some((ringed, _)) = &self.ringed {
            shapes.push(ring(self.at(*ringed)));
        }
        // The last groups are the ones on top, so they have the first choice.
        for group in self.groups.iter().rev() {
            for (point, name) in &group.points {
                let Some(name) = name else { continue };
                let is_ringed = self.ringed.as_ref().is_some_and(|(ringed, _)| ringed == point);
                let gap = if is_ringed { 13.0 } else { 8.0 };
                let at = self.at(*point);
                // Rather on a line than nowhere.
                let beside = room_beside(at, gap, name, &[&taken, &lines])
                    .or_else(|| room_beside(at, gap, name, &[&taken]));
                if let Some((room, place)) = beside {
                    taken.push(room);
                    let colour = group.colour.map(|part| (u16::from(part) * 3 / 4) as u8);
                    shapes.push(Shape::Words {
                        at: place,
                        text: name.clone(),
                        hand: Hand::Small,
                        anchor: Anchor::Start,
                        colour,
                        upward: false,
                    });
                }
            }
        }
    }

    fn draw_legend(&self, shapes: &mut Vec<Shape>) {
        let x = LEFT + PLOT[0] + 14.0;
        let mut y = TOP + 8.0;
        for group in self.groups.iter().rev() {
            let ends = vec![[x, y], [x + 22.0, y]];
            if group.line > 0.0 {
                let Group { line: width, colour, dash, .. } = *group;
                shapes.push(Shape::Line { points: ends, width, colour, dash });
            }
            shapes.extend(group.mark.map(|mark| mark.at([x + 11.0, y], 4.0, group.colour)));
            let letters = ((LEGEND - 48.0) / Hand::Plain.advance()) as usize;
            for line in wrapped(&group.name, letters) {
                shapes.push(words([x + 30.0, y + 4.0], line, Hand::Plain, Anchor::Start));
                y += LINE;
            }
            y += 3.0;
        }
        if let Some((_, name)) = &self.ringed {
            shapes.push(ring([x + 11.0, y + 2.0]));
            shapes.push(words([x + 30.0, y + 6.0], name, Hand::Plain, Anchor::Start));
        }
    }
}

fn ring(centre: At) -> Shape {
    Shape::Ring { centre, radius: 9.0, width: 2.0, colour: RING }
}

/// Small rectangles along a straight line.
fn along([ax, ay]: At, [bx, by]: At) -> impl Iterator<Item = Room> {
    const STEP: f64 = 4.0;
    let steps = (libm::hypot(bx - ax, by - ay) / STEP) as u32 + 1;
    (0..=steps).map(move |step| {
        let part = f64::from(step) / f64::from(steps);
        let [x, y] = [ax + part * (bx - ax), ay + part * (by - ay)];
        [x - 1.0, y - 1.0, x + 1.0, y + 1.0]
    })
}

const MARGIN: f64 = 16.0;

/// Left, top, right and bottom of a rectangle.
type Room = [f64; 4];

/// Where there is room for words beside a point: all of it, and where they begin.
fn room_beside([x, y]: At, gap: f64, name: &str, taken: &[&[Room]]) -> Option<(Room, At)> {
    let (width, height) = (Hand::Small.width(name), Hand::Small.size());
    let half = 0.5 * width;
    let places = [
        [x + gap, y + 4.0],
        [x + gap - 2.0, y + 3.0 - gap],
        [x + gap - 2.0, y + 5.0 + gap],
        [x - half, y - 1.0 - gap],
        [x - width - gap, y + 4.0],
        [x - width - gap + 2.0, y + 5.0 + gap],
        [x - width - gap + 2.0, y + 3.0 - gap],
        [x - half, y + 9.0 + gap],
    ];
    let fits = |[left, top, right, bottom]: Room| {
        let is_inside = left > LEFT
            && right < LEFT + PLOT[0] + 8.0
            && top > TOP - 6.0
            && bottom < TOP + PLOT[1] - 2.0;
        is_inside
            && taken
                .iter()
                .copied()
                .flatten()
                .all(|[l, t, r, b]| right < *l || *r < left || bottom < *t || *b < top)
    };
    let rooms = places.map(|[x, y]| ([x, y - 0.8 * height, x + width, y + 0.2 * height], [x, y]));
    rooms.into_iter().find(|(room, _)| fits(*room))
}

impl Mark {
    /// The mark at a place.
    fn at(self, centre: At, radius: f64, colour: Colour) -> Shape {
        let [x, y] = centre;
        let polygon = |offsets: &[At]| Shape::Polygon {
            corners: offsets.iter().map(|[dx, dy]| [x + radius * dx, y + radius * dy]).collect(),
            colour,
        };
        match self {
            Self::Disc => Shape::Disc { centre, radius, colour },
            Self::Square => polygon(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]),
            Self::Triangle => polygon(&[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]]),
            Self::Diamond => polygon(&[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]]),
        }
    }
}

fn words(at: At, text: impl Into<String>, hand: Hand, anchor: Anchor) -> Shape {
    Shape::Words { at, text: text.into(), hand, anchor, colour: INK, upward: false }
}

fn line(points: Vec<At>, width: f64, colour: Colour) -> Shape {
    Shape::Line { points, width, colour, dash: 0.0 }
}

/// Lines of at most so many letters, if words are no longer.
fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Measure;

    fn chart(points: Vec<([f64; 2], Option<String>)>) -> Chart {
        let values = |i: usize| points.iter().map(move |(point, _)| point[i]);
        Chart {
            title: "T".to_owned(),
            across: Axis::over("x", Measure::Time, values(0)),
            up: Axis::over("y", Measure::Number, values(1)),
            groups: vec![Group {
                name: "a name that is long enough to be wrapped".to_owned(),
                colour: [0, 0, 200],
                mark: Some(Mark::Diamond),
                line: 1.0,
                dash: 0.0,
                points,
            }],
            ringed: None,
            notes: vec!["a note".to_owned()],
        }
    }

    fn texts(drawing: &Drawing) -> Vec<(&str, Room)> {
        let text = |shape: &'_ Shape| match shape {
            Shape::Words { at: [x, y], hand, anchor, upward: false, text, .. } => {
                let width = hand.width(text);
                let left = match anchor {
                    Anchor::Start => *x,
                    Anchor::Middle => x - 0.5 * width,
                    Anchor::End => x - width,
                };
                let size = hand.size();
                Some((text.clone(), [left, y - 0.8 * size, left + width, y + 0.2 * size]))
            }
            _ => None,
        };
        let all: Vec<_> = drawing.shapes.iter().filter_map(text).collect();
        let find = |text: &str| {
            drawing.shapes.iter().find_map(|shape| match shape {
                Shape::Words { text: own, .. } if own == text => Some(own.as_str()),
                _ => None,
            })
        };
        all.into_iter().filter_map(|(text, room)| Some((find(&text)?, room))).collect()
    }

    /// However crowded the points are, no words are on others, nor outside.
    #[test]
    fn words_do_not_overlap() {
        let points = (0..60).map(|i| {
            let (i, j) = (f64::from(i % 8), f64::from(i / 8));
            let place = [0.01 * libm::exp2(0.3 * i), 0.001 * libm::exp2(0.2 * j + 0.05 * i)];
            (place, Some(format!("--error 0.00{i}{j}")))
        });
        let drawing = chart(points.collect()).draw();
        let texts = texts(&drawing);
        let beside = texts.iter().filter(|(text, _)| text.starts_with("--error")).count();
        assert!((8..60).contains(&beside), "{beside}");
        for (i, (text, [left, top, right, bottom])) in texts.iter().enumerate() {
            let (width, height) = (f64::from(drawing.width), f64::from(drawing.height));
            assert!(*left > 0.0 && *top > 0.0 && *right < width && *bottom < height, "{text}");
            for (other, [l, t, r, b]) in &texts[..i] {
                let apart = right < l || r < left || bottom < t || b < top;
                assert!(apart, "{text} is on {other}");
            }
        }
    }

    #[test]
    fn lines_are_as_short_as_words_allow() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("extraordinary", 3), ["extraordinary"]);
        assert!(wrapped(" ", 3).is_empty());
    }

    #[test]
    fn an_empty_chart_can_be_drawn() {
        let drawing = chart(Vec::new()).draw();
        assert!(drawing.svg().contains("a note"));
        assert!(drawing.raster().bytes.iter().any(|byte| *byte < 128));
    }
}
