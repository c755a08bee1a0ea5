//! Groups, definitions and their uses.

mod common;

use common::{BALL, dump, messages, scene, text};
use lancer_math::Point;
use lancer_scene::Group;
use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;

/// Where a group with these transforms puts the point (1, 2, 3).
fn moved(transforms: &str) -> [f64; 3] {
    let scene = scene(&text("", &format!("<group>{BALL}{transforms}</group>")));
    let p = scene.groups[0].placement.point(&Point::new(1.0, 2.0, 3.0));
    [p.x, p.y, p.z]
}

const STEP: &str = r#"<translate x="10" y="0" z="0"/>"#;
const TURN: &str = r#"<rotate x="0" y="0" z="2" angle="90"/>"#;

#[test]
fn transforms_apply_in_the_order_written() {
    assert_eq!(moved(""), [1.0, 2.0, 3.0]);
    assert_eq!(moved(STEP), [11.0, 2.0, 3.0]);
    assert_eq!(moved(TURN), [-2.0, 1.0, 3.0]);
    assert_eq!(moved(r#"<scale by="2"/>"#), [2.0, 4.0, 6.0]);
    assert_eq!(moved(r#"<scale x="1" y="-1" z="0.5"/>"#), [1.0, -2.0, 1.5]);
    assert_eq!(
        moved(r#"<matrix rows="1 0 0 5  0 0 1 6  0 2 0 7"/>"#),
        [6.0, 9.0, 11.0],
        "row by row, offsets last"
    );
    assert_eq!(moved(&format!("{TURN}{STEP}")), [8.0, 1.0, 3.0]);
    assert_eq!(moved(&format!("{STEP}{TURN}")), [-2.0, 11.0, 3.0]);
    assert_eq!(moved(&format!("{STEP}<scale by=\"2\"/>{TURN}")), [-4.0, 22.0, 6.0]);
}

#[test]
fn transforms_stand_anywhere_among_the_shapes() {
    let around = |text: String| dump("", &text);
    let before = around(format!("<group>{TURN}{STEP}{BALL}{BALL}</group>"));
    assert_eq!(around(format!("<group>{TURN}{BALL}{STEP}{BALL}</group>")), before);
    assert_eq!(around(format!("<group>{BALL}{BALL}{TURN}{STEP}</group>")), before);
    assert_ne!(around(format!("<group>{BALL}{STEP}{BALL}{TURN}</group>")), before);
}

#[test]
fn groups_hold_groups_and_uses() {
    let define = format!("<define name=\"pair\">{BALL}<group>{STEP}{BALL}</group></define>");
    let shapes = format!(
        "<use name=\"pair\"/>{BALL}<group><use name=\"pair\">{STEP}{TURN}</use>{BALL}</group>"
    );
    assert_eq!(
        dump(&define, &shapes),
        "sphere centre 1 2 3 radius 1 colour #ff0000 gloss 0\n\
         use \"pair\"\n  \
           sphere centre 1 2 3 radius 1 colour #ff0000 gloss 0\n  \
           group x 1 0 0 y 0 1 0 z 0 0 1 at 10 0 0\n    \
             sphere centre 1 2 3 radius 1 colour #ff0000 gloss 0\n\
         group\n  \
           sphere centre 1 2 3 radius 1 colour #ff0000 gloss 0\n  \
           use \"pair\" x 0 1 0 y -1 0 0 z 0 0 1 at 0 10 0"
    );
}

#[test]
fn uses_share_one_group_in_memory() {
    let defines = format!(
        "<define name=\"four\"><use name=\"two\"/><use name=\"two\"/></define>\
         <define name=\"two\"><use name=\"one\"/><use name=\"one\"/></define>\
         <define name=\"one\">{BALL}</define>"
    );
    let shapes = format!("<use name=\"four\"/><use name=\"four\">{STEP}</use><use name=\"one\"/>");
    let scene = scene(&text(&defines, &shapes));
    assert_eq!(scene.shape_count(), 9);
    let [first, second, one] = &scene.groups[..] else { panic!("three uses") };
    assert!(Arc::ptr_eq(&first.group, &second.group));
    let twos = first.group.groups();
    assert!(Arc::ptr_eq(&twos[0].group, &twos[1].group));
    assert!(Arc::ptr_eq(&twos[0].group.groups()[1].group, &one.group));
    assert_eq!(one.group.name(), Some("one"));
}

fn laughs(levels: usize) -> String {
    let mut defines = format!("<define name=\"l0\">{BALL}</define>");
    for level in 1..=levels {
        let uses = format!("<use name=\"l{}\"/>", level - 1).repeat(10);
        let _ = write!(defines, "<define name=\"l{level}\">{uses}</define>");
    }
    defines
}

#[test]
fn a_billion_laughs_are_answered_at_once() {
    let begun = Instant::now();
    assert_eq!(
        messages(&text(&laughs(11), "<use name=\"l11\"/>")),
        ["the definition `l10` shows 10000000000 shapes"]
    );
    // As many as are allowed, and one more.
    let allowed = scene(&text(&laughs(9), "<use name=\"l9\"/>"));
    assert_eq!(allowed.shape_count(), Group::MOST_SHAPES);
    let one_more = text(&laughs(9), &format!("<use name=\"l9\"/>{BALL}"));
    assert_eq!(messages(&one_more), ["<shapes> shows 1000000001 shapes"]);
    // Nothing at all, two to the power of a thousand times.
    let mut nothing = "<define name=\"l0\"/>".to_owned();
    for level in 1..=1000 {
        let uses = format!("<use name=\"l{}\"/>", level - 1).repeat(2);
        let _ = write!(nothing, "<define name=\"l{level}\">{uses}</define>");
    }
    let shapes = format!("<use name=\"l1000\"/>{BALL}");
    let parsed = common::parse(&text(&nothing, &shapes));
    assert_eq!(common::messages_of(&parsed), ["warning: <define> is empty"]);
    assert!(parsed.scene.is_some_and(|scene| scene.groups.is_empty()));
    let seconds = begun.elapsed().as_secs_f64();
    assert!(seconds < 2.0, "{seconds} s");
}

#[test]
fn groups_are_nested_as_deep_as_a_scene_allows() {
    let nested = |depth: usize| {
        text("", &(["<group>"; 99][..depth].concat() + BALL + &"</group>".repeat(depth)))
    };
    // The scene counts as a level.
    let deepest = Group::DEEPEST - 1;
    scene(&nested(deepest));
    assert_eq!(messages(&nested(deepest + 1)), ["groups are nested too deeply in <shapes>"]);
    assert_eq!(messages(&nested(deepest + 2)), ["groups are nested too deeply in <group>"]);
}

#[test]
fn definitions_that_use_themselves_are_found_however_long_the_way() {
    let chain = |count: usize, last: &str| {
        let mut defines = String::new();
        for i in 0..count {
            let _ = write!(defines, "<define name=\"d{i}\"><use name=\"d{}\"/></define>", i + 1);
        }
        let _ = write!(defines, "<define name=\"d{count}\">{last}</define>");
        messages(&text(&defines, "<use name=\"d0\"/>"))
    };
    assert_eq!(chain(0, "<use name=\"d0\"/>"), ["the definition `d0` uses itself"]);
    assert_eq!(
        chain(2, "<use name=\"d0\"/>"),
        ["the definition `d0` uses itself through `d1`, `d2`"]
    );
    assert_eq!(
        chain(50_000, "<use name=\"d7\"/>"),
        ["the definition `d7` uses itself through `d8`, `d9`, `d10`, `d11`, ..."]
    );
    let too_deep = chain(50_000, BALL);
    assert_eq!(
        too_deep,
        [format!("groups are nested too deeply in the definition `d{}`", 50_000 - 64)]
    );
    // Twice the same, but no round.
    let both = format!(
        "<define name=\"a\"><use name=\"b\"/><use name=\"c\"/></define>\
         <define name=\"b\"><use name=\"c\"/></define><define name=\"c\">{BALL}</define>"
    );
    assert!(messages(&text(&both, "<use name=\"a\"/>")).is_empty());
}

#[test]
fn what_is_wrong_in_a_definition_is_said_once() {
    let define = "<define name=\"d\"><sphere color=\"red\" size=\"0\"><point x=\"0\" y=\"0\" z=\"0\"/>\
                  </sphere></define>";
    let uses = "<use name=\"d\"/>".repeat(3);
    assert_eq!(messages(&text(define, &uses)), ["`size` of <sphere> is 0"]);
    let nameless = define.replace("name=\"d\"", "");
    assert_eq!(
        messages(&text(&nameless, BALL)),
        ["<define> lacks the attribute `name`", "`size` of <sphere> is 0"]
    );
}

#[test]
fn placements_are_finite_at_any_depth() {
    let scale = r#"<scale by="1e200"/>"#;
    let back = r#"<scale by="1e-200"/>"#;
    let define = format!("<define name=\"d\"><group>{BALL}{scale}</group></define>");
    // Large and small cancel.
    scene(&text(&define, &format!("<use name=\"d\">{back}</use>")));
    for transform in [scale, r#"<translate x="1.7e308" y="0" z="0"/><scale by="1.1"/>"#] {
        let shapes = format!("<group><use name=\"d\">{transform}</use></group>");
        let found = messages(&text(&define, &shapes));
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].ends_with("multiply to numbers that are not finite"), "{found:?}");
    }
}
