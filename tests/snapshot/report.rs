//! A page that shows what differs.

use std::path::{Path, PathBuf};

use soapfilm::{
    output::{Metadata, OutputError, PngPicture, write_text},
    physics::colour::Gamut,
};

use crate::compare::Comparison;

/// How much the difference is amplified, so that one step can be seen.
const AMPLIFIED: u8 = 32;

/// Writes both pictures, their difference and a page with all three, and returns the page.
pub fn write(
    name: &str,
    size: [u32; 2],
    golden: &[u8],
    now: &[u8],
    comparison: &Comparison,
) -> Result<PathBuf, OutputError> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("snapshot");
    // If this fails, writing the first picture says why.
    let _ = std::fs::create_dir_all(&folder);
    let difference = difference(golden, now);
    let parts = [("golden", golden), ("now", now), ("difference", &difference)];
    for (part, rgba) in parts {
        let metadata = Metadata::new();
        let picture = PngPicture { width: size[0], height: size[1], gamut: Gamut::Srgb, rgba, metadata: &metadata };
        picture.save(&folder.join(format!("{name}.{part}.png")))?;
    }
    let figures: String = parts
        .iter()
        .map(|(part, _)| format!("<figure><img src=\"{name}.{part}.png\"><figcaption>{part}</figcaption></figure>\n"))
        .collect();
    let style = "body{background:#222;color:#ddd;font-family:sans-serif}img{image-rendering:pixelated;width:640px}";
    let text = format!(
        "<!doctype html><meta charset=\"utf-8\"><title>{name}</title><style>{style}</style>\n\
         <h1>{name}</h1><p>{comparison} (difference times {AMPLIFIED})</p>\n{figures}"
    );
    let page = folder.join(format!("{name}.html"));
    write_text(&page, &text)?;
    Ok(page)
}

fn difference(golden: &[u8], now: &[u8]) -> Vec<u8> {
    let amplified = golden.iter().zip(now).map(|(a, b)| a.abs_diff(*b).saturating_mul(AMPLIFIED));
    amplified.enumerate().map(|(k, value)| if k % 4 == 3 { u8::MAX } else { value }).collect()
}

mod tests {
    use super::{Comparison, write};

    #[test]
    fn a_report_shows_all_three_pictures() {
        let (golden, now) = ([10; 8], [10, 11, 10, 10, 10, 10, 10, 10]);
        let comparison = Comparison::of([2, 1], &golden, [2, 1], &now).unwrap();
        let page = write("planted", [2, 1], &golden, &now, &comparison).unwrap();
        let text = std::fs::read_to_string(&page).unwrap();
        for part in ["golden", "now", "difference"] {
            assert!(text.contains(&format!("planted.{part}.png")));
            assert!(page.with_file_name(format!("planted.{part}.png")).exists());
        }
        let shown = soapfilm::output::read_back::read_png(&page.with_file_name("planted.difference.png")).unwrap();
        assert_eq!(shown.rgba, [0, 32, 0, 255, 0, 0, 0, 255]);
    }
}
