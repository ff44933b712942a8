//! The browser's storage for this page.

use std::cell::RefCell;

use super::{Settings, Unsaved};

const SETTINGS: &str = "soapfilm settings";
/// What precedes the name of a tab.
const UNSAVED: &str = "soapfilm unsaved ";

/// The tabs that show this page.
#[derive(Debug, Default)]
struct Tabs {
    own: String,
    /// The open ones.
    open: Vec<String>,
}

thread_local! {
    static TABS: RefCell<Tabs> = RefCell::default();
}

/// Names this tab, and all that are open, so that unsaved work of another one is not taken for left.
pub fn name_tabs(own: String, open: Vec<String>) {
    TABS.set(Tabs { own, open });
}

/// The page's storage; without one, as in private windows of some browsers, nothing is kept.
#[derive(Debug, Default)]
pub struct Storage {
    storage: Option<web_sys::Storage>,
    /// Where work of this tab is kept.
    own: String,
    /// Where work is that a closed tab has left.
    left: Option<String>,
}

impl Storage {
    /// What the browser keeps for this page.
    #[must_use]
    pub fn of_user() -> Self {
        let storage = web_sys::window().and_then(|window| window.local_storage().ok().flatten());
        let Tabs { own, open } = TABS.take();
        let keys = (0..).map_while(|index| storage.as_ref()?.key(index).ok()?);
        let is_left =
            |key: &String| key.strip_prefix(UNSAVED).is_some_and(|tab| tab == own || !open.contains(&tab.to_owned()));
        let left = keys.into_iter().find(is_left);
        Self { own: format!("{UNSAVED}{own}"), left, storage }
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
        self.write(&self.own, work)
    }

    /// Removes the kept work, because it is saved or was given up.
    pub fn drop_kept(&mut self) {
        self.remove(&self.own);
    }

    /// Work that a closed tab has left. Where it lies, another tab that opens now may find it too; it is removed once somebody decides.
    pub fn take_left(&mut self) -> Option<Unsaved> {
        self.read(self.left.as_ref()?)
    }

    /// Removes the work that a closed tab has left.
    pub fn drop_left(&mut self) {
        self.left.take().iter().for_each(|key| self.remove(key));
    }

    /// Leaves it for another time.
    pub fn leave(&mut self) {}

    fn remove(&self, key: &str) {
        self.storage.iter().for_each(|storage| drop(storage.remove_item(key)));
    }

    fn read<T: serde::de::DeserializeOwned>(&self, key: &str) -> Option<T> {
        toml::from_str(&self.storage.as_ref()?.get_item(key).ok()??).ok()
    }

    fn write(&self, key: &str, value: &impl serde::Serialize) -> Result<(), String> {
        let Some(storage) = &self.storage else { return Ok(()) };
        let text = toml::to_string(value).map_err(|error| error.to_string())?;
        storage.set_item(key, &text).map_err(|reason| format!("{reason:?}"))
    }
}
