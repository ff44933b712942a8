//! In a browser a file that is written is downloaded.

use std::io::{self, Cursor};
use std::path::Path;

use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, HtmlAnchorElement, Url};

use super::OutputError;

/// Hands what `write` writes to the browser, which saves it under the path's file name where it saves downloads.
///
/// # Errors
/// `write` fails, or the browser refuses the download.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut Cursor<Vec<u8>>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut content = Cursor::new(Vec::new());
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let refused = |reason: JsValue| io::Error::other(format!("the browser refuses the download: {reason:?}"));
    let written = write(&mut content).and_then(|()| download(&name, content.get_ref()).map_err(refused));
    written.map_err(|reason| OutputError::Write { path: path.to_owned(), reason })
}

/// Clicks a link to the bytes, as a page does that offers a file.
fn download(name: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let parts = js_sys::Array::of1(&js_sys::Uint8Array::from(bytes));
    let url = Url::create_object_url_with_blob(&Blob::new_with_u8_array_sequence(&parts)?)?;
    let document = web_sys::window().and_then(|window| window.document()).ok_or("there is no page")?;
    let link: HtmlAnchorElement = document.create_element("a")?.unchecked_into();
    link.set_href(&url);
    link.set_download(name);
    link.click();
    Url::revoke_object_url(&url)
}
