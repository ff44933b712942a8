//! What is refused, and in which words.

use super::{documented, setting, with_version};
use crate::scene::{Flow, Scene};

/// Text of a scene below its version, and the message after the scene's name.
type Case = (&'static str, &'static str);

/// The documented keys that hold numbers: section, key and default.
fn numbers() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let holds_numbers =
        |default: &str| default == "absent" || default.starts_with(['[', '-']) || default.parse::<f64>().is_ok();
    let rows = documented().into_iter().filter(move |row| holds_numbers(row.default) && row.key != "version");
    // Radiances are absent unless given, and hold three numbers like all lists.
    rows.map(|row| match row.key {
        "constant" | "radiance" | "target_m" => (row.section, row.key, "[]"),
        _ => (row.section, row.key, row.default),
    })
}

pub(super) fn refusal(text: &str) -> String {
    Scene::from_toml(text, "s.toml").expect_err("this scene must be refused").to_string()
}

pub(super) fn assert_refused(cases: &[Case]) {
    for (text, message) in cases {
        assert_eq!(refusal(&with_version(text)), format!("s.toml:{message}"), "{text}");
    }
}

#[test]
fn version_is_required_and_known() {
    let unknown = |found: &str| format!("version {found} is not supported; this program reads `version = 1`");
    assert_eq!(refusal(""), "s.toml:1: no version; add `version = 1` at the top");
    assert_eq!(refusal("\nversion = 2\nnew_in_2 = 1"), format!("s.toml:2: {}", unknown("2")));
    assert_eq!(refusal("version = \"1\""), format!("s.toml:1: {}", unknown("\"1\"")));
}

#[test]
fn text_must_be_toml() {
    assert_refused(&[
        ("radius_mm 3", "2: key with no value, expected `=`"),
        ("[[bubble]]\nradius_mm = 1\nradius_mm = 2", "4: duplicate key: `radius_mm`"),
        ("[camera]\n[camera]", "3: duplicate key: `camera`"),
    ]);
}

#[test]
fn unknown_keys_name_the_nearest_known_one() {
    assert_refused(&[
        (
            "[[bubble]]\n[bubble.film]\nthicknes_nm = 300",
            "4: unknown key `thicknes_nm` in [bubble.film]; did you mean `thickness_nm`?",
        ),
        ("[camera]\nfov = 3", "3: unknown key `fov` in [camera]; did you mean `fov_y_deg`?"),
        ("[lihgt]", "2: unknown key `lihgt`; did you mean `light`?"),
        (
            "[[bubble]]\n[[bubble]]\nradius = 3",
            "4: unknown key `radius` in [[bubble]] number 2; did you mean `radius_mm`?",
        ),
        (
            "[[bubble]]\nqqq = 3",
            "3: unknown key `qqq` in [[bubble]]; known here: `boundary`, `center_m`, `film`, `patch_mm`, `radius_mm`, `regeneration`, `rim_deg`, `wire_mm`",
        ),
        (
            "[[event]]\nkind = \"stir\"\nvelocity = 2",
            "4: unknown key `velocity` in [[event]]; did you mean `velocity_m_s`?",
        ),
        (
            "[[event]]\nkind = \"drag\"\nflow = \"free\"",
            "4: unknown key `flow` in [[event]]; known here: `bubble`, `kind`, `tick`, `to_m`",
        ),
        ("[[event]]\nkind = \"motion\"\nspeed = 2", "4: unknown key `speed` in [[event]]; did you mean `seed`?"),
        (
            "[light]\nx.y = 1\n[camera]\nfov = 3",
            "3: unknown key `x` in [light]; known here: `constant`, `environment`, `illuminant`, `intensity`, `lamp`, `patch`, `rotation_deg`, `spectrum`",
        ),
        (
            "\"a\\nb\" = 1",
            "2: unknown key `a\\nb`; known here: `bubble`, `camera`, `event`, `generator`, `lens`, `light`, `motion`, `version`, `view`",
        ),
    ]);
}

#[test]
fn tables_and_lists_are_told_apart() {
    assert_refused(&[
        ("[light.patch]\nradius_deg = 3", "2: `patch` in [light] has the wrong kind of table; write [[patch]]"),
        ("[[light.patch]]\nradius_deg = 0", "3: `radius_deg` in [[light.patch]] is 0; it must be within 1 ..= 180"),
        (
            "[[light.patch]]\n[[light.patch]]\nilluminant = \"\"",
            "4: `illuminant` in [[light.patch]] number 2 is empty; name one, as in `illuminant = \"D65\"`",
        ),
        ("[[light.patch]]\nradius = 3", "3: unknown key `radius` in [[light.patch]]; did you mean `radius_deg`?"),
        ("[bubble]\nradius_mm = 3", "2: `bubble` has the wrong kind of table; write [[bubble]]"),
        ("[[camera]]", "2: `camera` has the wrong kind of table; write [camera]"),
        ("camera = 3", "2: `camera` is wrong: invalid type: integer `3`, expected the table Camera"),
        ("bubble = 3", "2: `bubble` is wrong: invalid type: integer `3`, expected a list"),
        (
            "bubble = [{film = 3}]",
            "2: `film` in [[bubble]] is wrong: invalid type: integer `3`, expected the table Film",
        ),
        ("[camera.fov_y_deg]", "2: `fov_y_deg` in [camera] is wrong: invalid type: table, expected a number"),
    ]);
}

#[test]
fn an_unknown_word_is_answered_with_the_known_words() {
    let known: Vec<_> = Flow::ALL.iter().map(|flow| format!("`{}`", flow.name())).collect();
    let message = refusal(&with_version("[motion]\nflow = \"windy\""));
    let told = format!("unknown word `windy`, expected one of {}", known.join(", "));
    assert_eq!(message, format!("s.toml:3: `flow` in [motion] is wrong: {told}"));
}

#[test]
fn values_have_their_type() {
    assert_refused(&[
        (
            "[[bubble]]\nradius_mm = \"big\"",
            "3: `radius_mm` in [[bubble]] is wrong: invalid type: string \"big\", expected a number",
        ),
        (
            "[motion]\nseed = -1",
            "3: `seed` in [motion] is wrong: invalid value: integer `-1`, expected a whole number, 0 or more",
        ),
        ("[motion]\nflow = 3", "3: `flow` in [motion] is wrong: expected a word in quotes"),
        ("[camera]\ntarget_m = [\n0, 0]", "3: `target_m` in [camera] is a list of 2; it must hold 3 numbers"),
        ("[camera]\ntarget_m = [0, 0, 0, 7]", "3: `target_m` in [camera] is a list of 4; it must hold 3 numbers"),
        ("[view]\nbackdrop = [1, 2]", "3: `backdrop` in [view] is a list of 2; it must hold 3 numbers"),
        (
            "[view]\nbackdrop = 2",
            "3: `backdrop` in [view] is wrong: expected \"environment\" or three numbers [r, g, b]",
        ),
        (
            "[[event]]\nkind = \"stir\"\nat = [1, 0, 0, 0]",
            "4: `at` in [[event]] is a list of 4; it must hold 3 numbers",
        ),
        ("bubble = [{}, 3]", "2: [[bubble]] number 2 must be a table, but is a value of the type integer"),
        ("bubble = [[[0, 0, 0], 50]]", "2: [[bubble]] must be a table, but is a value of the type array"),
        (
            "[camera]\ntarget_m = 3",
            "3: `target_m` in [camera] is wrong: invalid type: integer `3`, expected a list of three numbers",
        ),
        (
            "[[bubble]]\n[bubble.film]\nindex = \"watr\"",
            "4: `index` in [bubble.film] is \"watr\"; use \"water\", \"water 25C\", \"glycerol 30%\", the path of a .csv file, or a number",
        ),
        (
            "[[event]]\nkind = \"motion\"\ntick = 0.5",
            "4: `tick` in [[event]] is wrong: invalid type: floating point `0.5`, expected a whole number, 0 or more",
        ),
        (
            "[[event]]\nkind = \"dance\"",
            "3: `kind` in [[event]] is wrong: unknown word `dance`, expected one of `motion`, `stir`, `blow`, `drag`, `prick`",
        ),
        ("[[event]]\ntick = 3", "2: [[event]] is wrong: missing field `kind`"),
    ]);
}

#[test]
fn values_lie_in_their_range() {
    assert_refused(&[
        ("[[bubble]]\n\nradius_mm = 9e3", "4: `radius_mm` in [[bubble]] is 9000; it must be within 0.1 ..= 5000"),
        ("[camera]\nazimuth_deg = nan", "3: `azimuth_deg` in [camera] is NaN; it must be a finite number"),
        ("[camera]\nazimuth_deg = -inf", "3: `azimuth_deg` in [camera] is -inf; it must be a finite number"),
        (
            "[light]\nconstant = [1, nan, 1]",
            "3: `constant` in [light] holds a number that is NaN; it must be within 0 ..= 65504",
        ),
        (
            "[[bubble]]\n[bubble.film]\nthickness_nm = 0",
            "4: `thickness_nm` in [bubble.film] is 0; only a film with `state = \"uniform\"` may be thinner than 1",
        ),
        (
            "[light]\nenvironment = \"tnt\"",
            "3: `environment` in [light] is \"tnt\"; use \"tent\", \"windows\", \"park\", \"studio\" or the path of an .exr or .hdr file",
        ),
        ("[light]\nilluminant = \"\"", "3: `illuminant` in [light] is empty; name one, as in `illuminant = \"D65\"`"),
    ]);
}

#[test]
fn absurd_numbers_are_refused_with_the_memory_that_they_need() {
    let crowd = with_version(&"[[bubble]]\n".repeat(10_001));
    assert!(refusal(&crowd).contains("of memory, of 16.0 GB that are allowed; lower `cells`"));
    assert_refused(&[
        (
            "[[generator]]\ncount = 100000000",
            "3: `count` in [[generator]] is 100000000, which takes the scene to 50.3 GB of memory, of 16.0 GB that are allowed; ask for fewer bubbles",
        ),
        ("[[generator]]\ncount = 0", "3: `count` in [[generator]] is 0; it must be within 1 ..= 10000000"),
        (
            "[[generator]]\nlayout = \"wand\"",
            "2: `life_s` in [[generator]] is 0; a wand goes on blowing, so its bubbles need an end",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\n[[generator]]",
            "4: `layout` in [[generator]] makes bubbles over a bath, which cannot be drawn yet; leave out the bath or the generator",
        ),
    ]);
    assert!(
        Scene::from_toml(&with_version(&"[[bubble]]\n[bubble.film]\nstate = \"uniform\"\n".repeat(10_001)), "s")
            .is_ok()
    );
}

#[test]
fn films_end_where_they_can() {
    assert_refused(&[
        (
            "[[bubble]]\nboundary = \"pond\"",
            "3: `boundary` in [[bubble]] is wrong: unknown word `pond`, expected one of `free`, `bath`, `ring`, `drop`",
        ),
        (
            "[[bubble]]\nboundary = \"ring\"\nrim_deg = 160",
            "4: `rim_deg` in [[bubble]] is 160; for a ring it must be within 30 ..= 150",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\nradius_mm = 5",
            "2: `patch_mm` in [[bubble]] is 3, which is more than a quarter of the bubble's radius",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\n[[bubble]]\ncenter_m = [0, 1, 0]",
            "4: `boundary` in [[bubble]] number 2 is not on the bath that others stand on; give all bubbles `boundary = \"bath\"` and the same height",
        ),
        (
            "[[bubble]]\nboundary = \"ring\"\n[motion]\nspin_deg_s = [1, 0, 0]",
            "5: `spin_deg_s` in [motion] turns over films that have a rim; only a turn about the vertical, [0, 0, z], leaves the rim in place",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\n[motion]\nflow = \"stirred\"",
            "5: `flow` in [motion] would carry film across a rim; films with a rim move only by `\"free\"` or `\"rest\"`",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\n[[event]]\ntick = 3\nkind = \"motion\"\nflow = \"stirred\"",
            "7: `flow` in [[event]] would carry film across a rim; films with a rim move only by `\"free\"` or `\"rest\"`",
        ),
        (
            "[[bubble]]\nboundary = \"bath\"\n[[event]]\nkind = \"drag\"\nto_m = [0, 0, 1]",
            "6: `to_m` in [[event]] takes a bubble off its bath; end at its height, 0",
        ),
    ]);
}

#[test]
fn events_change_something_in_order() {
    assert_refused(&[
        (
            "[[event]]\nkind = \"motion\"",
            "3: `kind` in [[event]] is \"motion\" but nothing changes; set `flow` or another key of [motion]",
        ),
        (
            "[[event]]\nkind = \"stir\"\nbubble = 1",
            "4: `bubble` in [[event]] is 1; the scene has bubbles from 0 to below 1",
        ),
        (
            "[[event]]\nkind = \"blow\"\ntoward = [0, 0, 0]",
            "4: `toward` in [[event]] has no direction; make one of its numbers at least 0.001",
        ),
        (
            "[[event]]\ntick = 9\nkind = \"motion\"\nseed = 2\n[[event]]\ntick = 8\nkind = \"motion\"\nseed = 3",
            "7: `tick` in [[event]] number 2 is 8 after an event at tick 9; sort the events by tick",
        ),
    ]);
}

/// In TOML a path of Windows between double quotes is broken, or worse, means something else.
#[test]
fn backslashes_that_are_escapes_are_explained() {
    let advice = "a backslash in \"…\" begins an escape: write a path as '…', or with / for each \\";
    for path in
        [r"C:\Users\me\room.hdr", r"\\server\share\a.hdr", r"D:\", r"C:\xy.hdr", r"C:\temp\new.hdr", r"C:\rooms\a.exr"]
    {
        for key in ["environment", "illuminant"] {
            let message = refusal(&with_version(&format!("[light]\n{key} = \"{path}\"")));
            assert!(message.starts_with("s.toml:3: ") && message.ends_with(advice), "{path}: {message}");
        }
    }
    let message = refusal(&with_version("[[bubble]]\n[bubble.film]\nindex = \"C:\\new.csv\""));
    assert!(message.starts_with("s.toml:4: `index`") && message.ends_with(advice), "{message}");
    assert!(!refusal(&with_version("[light]\nenvironment = 'C:\\x.hdr' 3")).contains("backslash"));
}

/// No line of a file is so long that the message cannot be read.
#[test]
fn messages_are_short_whatever_the_file_holds() {
    let long = "x".repeat(1_000_000);
    for text in [
        format!("{long} = 3"),
        long.clone(),
        format!("[{long}]"),
        format!("[camera]\n{long} = 3"),
        format!("[camera]\nazimuth_deg = \"{long}\""),
        format!("[motion]\nflow = \"{long}\""),
        format!("[light]\nenvironment = \"{long}\""),
        format!("[[bubble]]\n[bubble.film]\nindex = \"{long}\""),
        format!("[camera]\nazimuth_deg = {}", "1".repeat(1_000_000)),
        format!("[{long}.{long}]\n[{long}]\n[{long}]"),
    ] {
        let message = refusal(&with_version(&text));
        assert!(message.chars().count() < 1000, "{} characters: {}", message.len(), &message[..100]);
    }
    assert!(refusal(&format!("version = \"{long}\"")).len() < 1000);
}

/// Whatever the key, neither NaN nor an infinity gets through, alone or in a list.
#[test]
fn numbers_are_finite_everywhere() {
    for (section, key, default) in numbers() {
        for odd in ["nan", "inf", "-inf"] {
            let value = if default.starts_with('[') { format!("[0.5, {odd}, 0.5]") } else { odd.to_owned() };
            let message = refusal(&setting(section, key, &value));
            assert!(message.contains(&format!("`{key}`")), "{section} {key} = {value}: {message}");
        }
    }
}

#[test]
fn deep_nesting_is_refused_without_overflowing_the_stack() {
    for text in [
        format!("x = {}", "[".repeat(100_000)),
        format!("x{} = 1", ".x".repeat(100_000)),
        format!("x = {}", "{x=".repeat(100_000)),
    ] {
        assert!(refusal(&with_version(&text)).contains("recurs"));
    }
}
