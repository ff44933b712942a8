//! Links that hold a scene: its TOML, deflated, as base64url in the fragment of an address, which no server sees.

use miniz_oxide::{deflate::compress_to_vec, inflate::decompress_to_vec_with_limit};

/// What the fragment begins with.
const KEY: &str = "#scene=";

/// The longest scene that a link may hold, bytes: a short link can claim to hold a great deal.
const MAX_BYTES: usize = 4 << 20;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// The fragment that holds a scene.
#[must_use]
pub fn fragment(toml: &str) -> String {
    format!("{KEY}{}", to_base64url(&compress_to_vec(toml.as_bytes(), 9)))
}

/// The scene's TOML in a fragment, if it is one that holds a scene.
///
/// # Errors
/// The fragment is damaged.
pub fn scene_of(fragment: &str) -> Result<Option<String>, &'static str> {
    let Some(text) = fragment.strip_prefix(KEY) else { return Ok(None) };
    let toml = from_base64url(text)
        .and_then(|bytes| decompress_to_vec_with_limit(&bytes, MAX_BYTES).ok())
        .and_then(|bytes| String::from_utf8(bytes).ok());
    toml.map(Some).ok_or("the scene in this link is damaged: copy the whole link again")
}

/// Base64 with the alphabet for addresses, without padding (RFC 4648, section 5).
fn to_base64url(bytes: &[u8]) -> String {
    let group = |chunk: &[u8]| {
        let bits = (0..3).fold(0, |bits, k| bits << 8 | u32::from(chunk.get(k).copied().unwrap_or(0)));
        let digits = (0..=chunk.len()).map(move |k| DIGITS[(bits >> (18 - 6 * k) & 63) as usize]);
        digits.map(char::from).collect::<String>()
    };
    bytes.chunks(3).map(group).collect()
}

fn from_base64url(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() * 3 / 4);
    for group in text.as_bytes().chunks(4) {
        let digit = |character: &u8| DIGITS.iter().position(|digit| digit == character);
        let digits = group.iter().map(digit).collect::<Option<Vec<_>>>()?;
        let bits = (0..4).fold(0, |bits, k| bits << 6 | digits.get(k).copied().unwrap_or(0) as u32);
        // n digits hold n − 1 bytes.
        bytes.extend(&bits.to_be_bytes()[1..group.len().max(1)]);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_comes_back_from_its_link() {
        for name in crate::scene::preset_names() {
            let toml = crate::scene::preset_toml(name).unwrap_or_default();
            let link = fragment(toml);
            assert!(link.bytes().all(|byte| byte == b'#' || byte == b'=' || DIGITS.contains(&byte)), "{link}");
            assert_eq!(scene_of(&link).as_ref().map(Option::as_deref), Ok(Some(toml)), "{name}");
        }
    }

    #[test]
    fn base64url_is_that_of_the_standard() {
        // RFC 4648, section 10, and the two digits that differ from plain Base64.
        for (bytes, text) in
            [("", ""), ("f", "Zg"), ("fo", "Zm8"), ("foo", "Zm9v"), ("foob", "Zm9vYg"), ("~~?", "fn4_")]
        {
            assert_eq!(to_base64url(bytes.as_bytes()), text);
            assert_eq!(from_base64url(text).as_deref(), Some(bytes.as_bytes()));
        }
    }

    #[test]
    fn damaged_links_are_told_from_other_fragments() {
        assert_eq!(scene_of("#panels"), Ok(None));
        assert_eq!(scene_of(""), Ok(None));
        let whole = fragment("version = 1\n");
        for damaged in [&whole[..whole.len() - 4], "#scene=%%%%", "#scene=A"] {
            assert!(scene_of(damaged).is_err(), "{damaged}");
        }
    }
}
