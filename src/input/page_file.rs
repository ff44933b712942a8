//! Files that a page was given: a browser shows a program no others.

use std::{
    cell::RefCell,
    collections::BTreeMap,
    io::Cursor,
    path::{Path, PathBuf},
    rc::Rc,
};

use super::InputError;

thread_local! {
    static FILES: RefCell<BTreeMap<PathBuf, Rc<[u8]>>> = const { RefCell::new(BTreeMap::new()) };
}

/// Keeps a file that a user has chosen or dropped, so that scenes find it by its name.
pub fn keep_file(name: &str, bytes: &[u8]) {
    FILES.with_borrow_mut(|files| files.insert(name.into(), bytes.into()));
}

/// Opens a file that the page has.
pub(super) fn open(path: &Path) -> Result<Cursor<Rc<[u8]>>, InputError> {
    let bytes = FILES.with_borrow(|files| files.get(path).cloned());
    bytes.map(Cursor::new).ok_or_else(|| InputError::NotFound { path: path.to_owned() })
}
