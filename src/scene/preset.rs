//! The built-in scenes of `assets/scenes/`.

use super::Scene;

macro_rules! presets {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../assets/scenes/", $name, ".toml")))),*]
    };
}

const PRESETS: [(&str, &str); 32] = presets![
    "default",
    "tent",
    "fresh",
    "bands",
    "draining",
    "black",
    "bursting",
    "life",
    "stirred",
    "glycerol",
    "bath",
    "ring",
    "drop",
    "weightless",
    "giant",
    "windows",
    "park",
    "studio",
    "bright",
    "lamplight",
    "sodium",
    "two_lights",
    "polarised",
    "trio",
    "pair",
    "stream",
    "cloud",
    "swarm",
    "origin",
    "inside",
    "far",
    "furnace",
];

/// The names of the presets, `default` first.
pub fn preset_names() -> impl ExactSizeIterator<Item = &'static str> {
    PRESETS.iter().map(|(name, _)| *name)
}

/// The presets as people look for them: each group with its title.
pub const PRESET_GROUPS: [(&str, &[&str]); 5] = [
    ("One bubble", &["default", "tent", "fresh", "bands", "draining", "stirred", "glycerol", "weightless", "giant"]),
    ("Its life", &["life", "black", "bursting"]),
    ("Where a film ends", &["bath", "ring", "drop"]),
    ("Light", &["windows", "park", "studio", "bright", "lamplight", "sodium", "two_lights", "polarised"]),
    ("Many bubbles", &["stream", "cloud", "swarm", "origin", "trio", "pair"]),
];

/// Presets that show how the program works rather than bubbles.
pub const TEST_PRESETS: [&str; 3] = ["inside", "far", "furnace"];

/// The TOML of a preset with its comments, or `None` if no preset has this name.
pub fn preset_toml(name: &str) -> Option<&'static str> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// What a preset shows: the first sentence of the comment that its TOML begins with, or `None` if no preset has this name.
pub fn preset_sentence(name: &str) -> Option<String> {
    let comment = preset_toml(name)?.lines().map_while(|line| line.strip_prefix('#')).map(str::trim);
    let text = comment.collect::<Vec<_>>().join(" ");
    let end = text.find(". ").map_or(text.len(), |dot| dot + 1);
    Some(text[..end].to_owned())
}

/// A preset, or `None` if none has this name.
pub fn preset(name: &str) -> Option<Scene> {
    // A test reads every preset, so an error cannot hide here.
    preset_toml(name).and_then(|text| Scene::from_toml(text, name).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_in_one_group() {
        let mut grouped: Vec<_> =
            PRESET_GROUPS.iter().flat_map(|(_, names)| *names).chain(&TEST_PRESETS).copied().collect();
        let mut names: Vec<_> = preset_names().collect();
        grouped.sort_unstable();
        names.sort_unstable();
        assert_eq!(grouped, names);
    }
}
