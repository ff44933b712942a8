//! Which of a file's layers is the picture.

use std::path::Path;

use ::exr::meta::header::Header;

use crate::input::InputError;

/// Names of red, green and blue channels.
const RGB: [[&str; 3]; 4] = [["R", "G", "B"], ["r", "g", "b"], ["red", "green", "blue"], ["Red", "Green", "Blue"]];

/// Names that renderers give the finished picture.
const PICTURES: [&str; 11] =
    ["combined", "composite", "beauty", "rgba", "rgb", "color", "colour", "final", "main", "master", "default"];

/// Words in the names of layers that hold no light.
const DATA: [&str; 15] = [
    "normal",
    "occlusion",
    "depth",
    "position",
    "vector",
    "velocity",
    "motion",
    "crypto",
    "mask",
    "matte",
    "shadow",
    "mist",
    "index",
    "albedo",
    "denois",
];

/// Short names of such layers.
const SHORT_DATA: [&str; 8] = ["ao", "n", "p", "z", "uv", "st", "id", "alpha"];

/// Layers that a note names, besides the one that was taken.
const MAX_NAMED: usize = 4;

/// Channels that make colours.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layer {
    /// Index of the part, which has a header of its own.
    pub part: usize,
    /// Indices of the red, green and blue channel in the part: one channel three times where the picture is grey.
    pub channels: [usize; 3],
    /// Its name; empty for the one that has none, which OpenEXR means as the picture itself.
    name: String,
}

/// Chooses among the flat layers with colours, and notes which it was where there could be doubt.
pub(super) fn choose(path: &Path, headers: &[Header]) -> Result<(Layer, Option<String>), InputError> {
    let flat = || headers.iter().enumerate().filter(|(_, header)| !header.deep);
    let several = headers.len() > 1;
    let mut layers: Vec<Layer> = flat().flat_map(|(part, header)| coloured(part, header, several)).collect();
    if layers.is_empty() {
        layers = flat().flat_map(|(part, header)| grey(part, header, several)).collect();
    }
    // Sorting is stable: of layers that are as good, the first in the file is taken.
    layers.sort_by_key(|layer| rank(&layer.name));
    let chosen = layers.first().cloned().ok_or_else(|| no_colour(path, headers))?;
    Ok((chosen, note(&layers)))
}

/// The layers of a part that have red, green and blue, the shortest names first.
fn coloured(part: usize, header: &Header, several: bool) -> Vec<Layer> {
    let names = channel_names(header);
    let find = |prefix: &str, ending: &str| names.iter().position(|name| name.strip_prefix(prefix) == Some(ending));
    let mut layers = Vec::new();
    for [red, green, blue] in RGB {
        for prefix in names.iter().filter_map(|name| name.strip_suffix(red)) {
            if let (Some(r), Some(g), Some(b)) = (find(prefix, red), find(prefix, green), find(prefix, blue)) {
                layers.push(Layer { part, channels: [r, g, b], name: full_name(header, prefix, several) });
            }
        }
    }
    layers.sort_by_key(|layer| layer.name.len());
    layers
}

/// The layers of a part that have luminance alone. Beside X, a Y is no luminance.
fn grey(part: usize, header: &Header, several: bool) -> Vec<Layer> {
    let names = channel_names(header);
    let luminances = names.iter().enumerate().filter_map(|(channel, name)| Some((channel, name.strip_suffix('Y')?)));
    let alone = luminances.filter(|(_, prefix)| {
        let lacks = |other: &str| !names.contains(&format!("{prefix}{other}"));
        (prefix.is_empty() || prefix.ends_with('.')) && ["X", "RY", "BY"].into_iter().all(lacks)
    });
    alone
        .map(|(channel, prefix)| Layer { part, channels: [channel; 3], name: full_name(header, prefix, several) })
        .collect()
}

fn channel_names(header: &Header) -> Vec<String> {
    header.channels.list.iter().map(|channel| channel.name.to_string()).collect()
}

/// A layer's name, of the part's where there are several, and of what stands before its channels' letters.
fn full_name(header: &Header, prefix: &str, several: bool) -> String {
    let part = header.own_attributes.layer_name.as_ref().filter(|_| several);
    let part = part.map(ToString::to_string).unwrap_or_default();
    let prefix = prefix.trim_end_matches('.');
    match (part.as_str(), prefix) {
        (part, "") => part.to_owned(),
        (part, prefix) if part.is_empty() || prefix.starts_with(part) => prefix.to_owned(),
        (part, prefix) => format!("{part}.{prefix}"),
    }
}

/// How likely a layer of this name is the picture: the lower the likelier.
fn rank(name: &str) -> usize {
    let name = name.to_lowercase();
    let words: Vec<&str> = name.split(['.', ' ', '_', '-']).collect();
    if name.is_empty() {
        0
    } else if name.split('.').any(|part| PICTURES.contains(&part)) {
        1
    } else if DATA.iter().any(|word| name.contains(word)) || words.iter().any(|word| SHORT_DATA.contains(word)) {
        3
    } else {
        2
    }
}

/// Tells which layer was taken, the first of these, and which were not. The only one without a name needs no word.
fn note(layers: &[Layer]) -> Option<String> {
    let (taken, others) = layers.split_first()?;
    let called = |layer: &Layer| match layer.name.as_str() {
        "" => "the layer without a name".to_owned(),
        name => format!("the layer `{name}`"),
    };
    let named: Vec<String> = others.iter().take(MAX_NAMED).map(called).collect();
    match others.len().saturating_sub(MAX_NAMED) {
        _ if others.is_empty() => (!taken.name.is_empty()).then(|| format!("shows {}", called(taken))),
        0 => Some(format!("shows {}, not {}", called(taken), named.join(", "))),
        more => Some(format!("shows {}, not {} and {more} more", called(taken), named.join(", "))),
    }
}

fn no_colour(path: &Path, headers: &[Header]) -> InputError {
    let names: Vec<String> = headers.iter().filter(|header| !header.deep).flat_map(channel_names).take(8).collect();
    let found = if names.is_empty() { "deep data alone, which is not flattened".to_owned() } else { names.join(", ") };
    InputError::NoColour { path: path.to_owned(), found }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_before_data() {
        let better = |a: &str, b: &str| assert!(rank(a) < rank(b), "{a} {b}");
        for picture in ["", "View Layer.Combined", "beauty", "rgba", "RGBA", "RGBA.left", "Composite.Combined"] {
            for other in ["View Layer.DiffCol", "diffuse_color", "specular", "View.AO", "N"] {
                better(picture, other);
            }
        }
        for data in ["View.AO", "AmbientOcclusion", "world_normal", "N", "CryptoObject00", "Denoising Depth"] {
            better("diffuse", data);
        }
        better("", "beauty");
    }
}
