//! What an adapter must be able to do. One that lacks something is refused when it is opened, with the name of what it lacks: some backends
//! would draw nothing instead, and report it only in a log.

use wgpu::{DownlevelFlags, TextureFormat, TextureUsages};

/// Beyond what textures and buffers need: flows are computed, a remap that the device decides is an indirect dispatch, and environments have
/// sizes that are no powers of two.
const FLAGS: DownlevelFlags = DownlevelFlags::COMPUTE_SHADERS
    .union(DownlevelFlags::INDIRECT_EXECUTION)
    .union(DownlevelFlags::NON_POWER_OF_TWO_MIPMAPPED_TEXTURES);

/// A format, what is done with its textures, and whether they are filtered.
struct FormatNeed {
    format: TextureFormat,
    usages: TextureUsages,
    filtered: bool,
}

const DRAWN: TextureUsages = TextureUsages::RENDER_ATTACHMENT.union(TextureUsages::TEXTURE_BINDING);
const COMPUTED: TextureUsages = TextureUsages::STORAGE_BINDING.union(TextureUsages::TEXTURE_BINDING);

/// The linear picture for measurements, which windows do without.
const MEASURED: FormatNeed = FormatNeed { format: TextureFormat::Rgba32Float, usages: DRAWN, filtered: false };

/// The linear picture; the table as it is baked and as it is read; the shown film; the finished picture; the environment.
const FORMATS: [FormatNeed; 6] = [
    FormatNeed { format: TextureFormat::Rgba16Float, usages: DRAWN, filtered: true },
    FormatNeed { format: TextureFormat::Rgba32Float, usages: COMPUTED, filtered: false },
    FormatNeed { format: TextureFormat::Rgba32Uint, usages: COMPUTED, filtered: false },
    FormatNeed { format: TextureFormat::R32Float, usages: COMPUTED, filtered: false },
    FormatNeed { format: TextureFormat::Rgba8Unorm, usages: DRAWN, filtered: true },
    FormatNeed { format: TextureFormat::Rgb9e5Ufloat, usages: TextureUsages::TEXTURE_BINDING, filtered: true },
];

/// The first thing that an adapter cannot do and must, in words.
pub(super) fn missing_ability(adapter: &wgpu::Adapter) -> Option<String> {
    let missing = FLAGS - adapter.get_downlevel_capabilities().flags;
    if !missing.is_empty() {
        let names: Vec<_> = missing.iter_names().map(|(name, _)| name.to_lowercase().replace('_', " ")).collect();
        return Some(format!("it lacks {}", names.join(", ")));
    }
    FORMATS.iter().find_map(|need| need.missing(adapter.get_texture_format_features(need.format)))
}

/// What an adapter cannot do for pictures in full precision, in words.
pub(super) fn missing_for_measurement(adapter: &wgpu::Adapter) -> Option<String> {
    MEASURED.missing(adapter.get_texture_format_features(MEASURED.format))
}

impl FormatNeed {
    fn missing(&self, features: wgpu::TextureFormatFeatures) -> Option<String> {
        let missing = self.usages - features.allowed_usages;
        let is_filterable = features.flags.contains(wgpu::TextureFormatFeatureFlags::FILTERABLE);
        let what = if missing.contains(TextureUsages::RENDER_ATTACHMENT) {
            "draw into"
        } else if missing.contains(TextureUsages::STORAGE_BINDING) {
            "compute into"
        } else if missing.contains(TextureUsages::TEXTURE_BINDING) {
            "read"
        } else if self.filtered && !is_filterable {
            "filter"
        } else {
            return None;
        };
        Some(format!("it cannot {what} textures of the format {:?}", self.format))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_abilities_of_a_format_are_named() {
        let need = &FORMATS[0];
        let all = wgpu::TextureFormatFeatures {
            allowed_usages: TextureUsages::all(),
            flags: wgpu::TextureFormatFeatureFlags::FILTERABLE,
        };
        assert_eq!(need.missing(all), None);
        let lacks = |usage| wgpu::TextureFormatFeatures { allowed_usages: TextureUsages::all() - usage, ..all };
        let told = |features| need.missing(features).unwrap();
        assert!(told(lacks(TextureUsages::RENDER_ATTACHMENT)).contains("draw into textures of the format Rgba16Float"));
        let computed = &FORMATS[1];
        assert!(computed.missing(lacks(TextureUsages::STORAGE_BINDING)).unwrap().contains("compute into"));
        assert!(told(lacks(TextureUsages::TEXTURE_BINDING)).contains("read"));
        let unfiltered = wgpu::TextureFormatFeatures { flags: wgpu::TextureFormatFeatureFlags::empty(), ..all };
        assert!(told(unfiltered).contains("filter"));
        assert_eq!(FORMATS[1].missing(unfiltered), None, "nothing is filtered there");
    }
}
