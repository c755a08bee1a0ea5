//! Plans as they are written down and read again, by the feature `serde`. Lights, shapes and groups
//! are counted from 1, as in all that people read.

use super::{Dropped, Plan, Reason};
use lancer_kernel::lanes::{NoSuchLanes, Width};
use lancer_kernel::{Absent, Culling, KernelSettings};
use serde::{Deserialize, Serialize, Serializer};

/// A [`Plan`] in writing.
#[derive(Serialize, Deserialize)]
pub(super) struct Written {
    lanes: String,
    shortcuts: Culling,
    dropped_lights: Vec<WrittenLight>,
    absent: WrittenAbsent,
    /// For readers: it follows from the lights.
    #[serde(skip_deserializing)]
    most: f64,
}

#[derive(Serialize, Deserialize)]
struct WrittenLight {
    light: usize,
    why: Why,
    /// Where it is behind one.
    plane: Option<usize>,
    most: f64,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Why {
    NoLight,
    Behind,
    Aside,
    Dim,
}

#[derive(Serialize, Deserialize)]
struct WrittenAbsent {
    shapes: Vec<usize>,
    groups: Vec<usize>,
}

/// A plan cannot be read.
#[derive(Debug, thiserror::Error)]
pub(super) enum Unreadable {
    #[error(transparent)]
    Lanes(#[from] NoSuchLanes),
    #[error("{0} are counted from 1")]
    Number(&'static str),
    #[error("there are no {0} {1}")]
    TooLarge(usize, &'static str),
    #[error("light {0} is behind a plane that is not named")]
    NoPlane(usize),
}

impl From<Plan> for Written {
    fn from(plan: Plan) -> Self {
        let light = |dropped: &Dropped| {
            let (why, plane) = match dropped.why {
                Reason::NoLight => (Why::NoLight, None),
                Reason::Behind(plane) => (Why::Behind, Some(plane + 1)),
                Reason::Aside => (Why::Aside, None),
                Reason::Dim => (Why::Dim, None),
            };
            WrittenLight { light: dropped.light + 1, why, plane, most: dropped.most }
        };
        Self {
            lanes: plan.kernel.lanes.name().to_owned(),
            shortcuts: plan.kernel.culling,
            dropped_lights: plan.dropped.iter().map(light).collect(),
            absent: WrittenAbsent {
                shapes: plan.absent.shapes().map(|number| number + 1).collect(),
                groups: plan.absent.groups().map(|number| number + 1).collect(),
            },
            most: plan.most(),
        }
    }
}

impl TryFrom<Written> for Plan {
    type Error = Unreadable;

    fn try_from(written: Written) -> Result<Self, Unreadable> {
        let light = |light: &WrittenLight| {
            let from_0 =
                |number: usize, what| number.checked_sub(1).ok_or(Unreadable::Number(what));
            let why = match (&light.why, light.plane) {
                (Why::NoLight, _) => Reason::NoLight,
                (Why::Behind, Some(plane)) => Reason::Behind(from_0(plane, "planes")?),
                (Why::Behind, None) => return Err(Unreadable::NoPlane(light.light)),
                (Why::Aside, _) => Reason::Aside,
                (Why::Dim, _) => Reason::Dim,
            };
            Ok(Dropped { light: from_0(light.light, "lights")?, why, most: light.most })
        };
        let lanes = Width::by_name(&written.lanes)?;
        Ok(Self {
            kernel: KernelSettings { lanes, culling: written.shortcuts },
            dropped: written.dropped_lights.iter().map(light).collect::<Result<_, _>>()?,
            absent: Absent::new(
                marks(&written.absent.shapes, "shapes")?,
                marks(&written.absent.groups, "groups")?,
            ),
        })
    }
}

/// More shapes, and more places of groups, there are in no scene.
const MOST: usize = 1 << 28;

/// Marks for numbers from 1.
fn marks(numbers: &[usize], what: &'static str) -> Result<Vec<bool>, Unreadable> {
    let most = numbers.iter().copied().max().unwrap_or(0);
    if most > MOST {
        return Err(Unreadable::TooLarge(most, what));
    }
    let mut marks = vec![false; most];
    for number in numbers {
        let from_0 = number.checked_sub(1).ok_or(Unreadable::Number(what))?;
        marks[from_0] = true;
    }
    Ok(marks)
}

/// The two corners of a box.
pub(super) fn corners<S: Serializer>(
    bounds: &Option<lancer_math::Bounds>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let corners = bounds.map(|b| [b.min, b.max].map(|p| [p.x, p.y, p.z]));
    corners.serialize(serializer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_is_read_as_it_was_written() {
        let dropped = [
            (0, Reason::NoLight, 0.0),
            (2, Reason::Behind(4), 0.0),
            (3, Reason::Aside, 0.0),
            (7, Reason::Dim, 0.25),
        ];
        let culling = Culling { idle_planes: false, ..Culling::ALL };
        for lanes in Width::available() {
            let plan = Plan {
                kernel: KernelSettings { lanes, culling },
                dropped: dropped.map(|(light, why, most)| Dropped { light, why, most }).to_vec(),
                absent: Absent::new(vec![false, true, true, false], vec![true]),
            };
            let text = serde_json::to_string(&plan).expect("it can be written");
            let read: Plan = serde_json::from_str(&text).expect("it can be read");
            assert_eq!(read.kernel.lanes.name(), lanes.name());
            assert_eq!(read.kernel.culling, culling);
            assert_eq!((&read.dropped, &read.absent), (&plan.dropped, &plan.absent));
            assert!(text.contains(r#"{"light":3,"why":"behind","plane":5,"most":0.0}"#), "{text}");
            assert!(
                text.contains(r#""shapes":[2,3]"#) && text.contains(r#""most":0.25}"#),
                "{text}"
            );
        }
    }

    #[test]
    fn what_is_no_plan_is_refused() {
        let good = serde_json::to_string(&Plan::default()).expect("it can be written");
        let lanes = format!("\"{}\"", Width::best().name());
        for (from, to, why) in [
            (lanes.as_str(), "\"many\"", "no lanes `many`"),
            ("\"shapes\":[]", "\"shapes\":[3,0]", "shapes are counted from 1"),
            (
                "\"groups\":[]",
                "\"groups\":[18446744073709551615]",
                "there are no 18446744073709551615 groups",
            ),
            (
                "\"dropped_lights\":[]",
                "\"dropped_lights\":[{\"light\":1,\"why\":\"behind\",\"plane\":null,\"most\":0}]",
                "a plane that is not named",
            ),
        ] {
            assert!(good.contains(from), "{good}");
            let error = serde_json::from_str::<Plan>(&good.replace(from, to)).expect_err(why);
            assert!(error.to_string().contains(why), "{error}");
        }
    }
}
