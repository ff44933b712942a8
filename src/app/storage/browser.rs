//! The browser's storage for this page.

use super::{Settings, Unsaved};

const SETTINGS: &str = "soapfilm settings";
const UNSAVED: &str = "soapfilm unsaved";
/// What an earlier visit left, while nobody has decided what becomes of it.
const LEFT: &str = "soapfilm left";

/// The page's storage; without one, as in private windows of some browsers, nothing is kept.
#[derive(Debug, Default)]
pub struct Storage(Option<web_sys::Storage>);

impl Storage {
    /// What the browser keeps for this page.
    #[must_use]
    pub fn of_user() -> Self {
        Self(web_sys::window().and_then(|window| window.local_storage().ok().flatten()))
    }

    /// The settings of the last visit; those that cannot be read are the normal ones.
    #[must_use]
    pub fn settings(&self) -> Settings {
        self.read(SETTINGS).unwrap_or_default()
    }

    /// Keeps the settings. Where that fails, the log says so: nothing is lost that a user has made.
    pub fn keep_settings(&self, settings: &Settings) {
        if let Err(error) = self.write(SETTINGS, settings) {
            log::warn!("the settings are not kept: {error}");
        }
    }

    /// Keeps work in case the page is closed without a question.
    ///
    /// # Errors
    /// The browser has no room left, in a line.
    pub fn keep(&mut self, work: &Unsaved) -> Result<(), String> {
        self.write(UNSAVED, work)
    }

    /// Removes the kept work, because it is saved or was given up.
    pub fn drop_kept(&mut self) {
        self.remove(UNSAVED);
    }

    /// Work that an earlier visit left.
    pub fn take_left(&mut self) -> Option<Unsaved> {
        let work: Option<Unsaved> = self.read(UNSAVED).or_else(|| self.read(LEFT));
        if work.as_ref().is_some_and(|work| self.write(LEFT, work).is_ok()) {
            self.remove(UNSAVED);
        }
        work
    }

    /// Removes the work that an earlier visit left.
    pub fn drop_left(&mut self) {
        self.remove(LEFT);
    }

    /// Leaves it for another time.
    pub fn leave(&mut self) {}

    fn remove(&self, key: &str) {
        self.0.iter().for_each(|storage| drop(storage.remove_item(key)));
    }

    fn read<T: serde::de::DeserializeOwned>(&self, key: &str) -> Option<T> {
        toml::from_str(&self.0.as_ref()?.get_item(key).ok()??).ok()
    }

    fn write(&self, key: &str, value: &impl serde::Serialize) -> Result<(), String> {
        let Some(storage) = &self.0 else { return Ok(()) };
        let text = toml::to_string(value).map_err(|error| error.to_string())?;
        storage.set_item(key, &text).map_err(|reason| format!("{reason:?}"))
    }
}
