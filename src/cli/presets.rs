//! `soapfilm presets`: the built-in scenes.

use clap::Args;
use serde_json::json;

use super::AdapterArguments;
use crate::{
    output::print,
    scene::{preset_names, preset_sentence},
};

/// List the built-in scenes, each with a sentence that describes it
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm presets\n  soapfilm presets --json\n\nEvery command that takes a scene accepts these names. No adapter is used."
)]
pub struct Arguments {
    /// Print a JSON list of `name` and `sentence` instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    _adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let presets = preset_names().map(|name| (name, preset_sentence(name).unwrap_or_default()));
    if arguments.json {
        let list: Vec<_> = presets.map(|(name, sentence)| json!({ "name": name, "sentence": sentence })).collect();
        return Ok(print(format_args!("{}\n", serde_json::to_string_pretty(&list)?))?);
    }
    let width = preset_names().map(str::len).max().unwrap_or(0);
    let lines: String = presets.map(|(name, sentence)| format!("{name:width$}  {sentence}\n")).collect();
    Ok(print(lines)?)
}
