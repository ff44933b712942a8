//! The program in a browser. A page makes a [`SoapBubble`] for each canvas that is to show one; what it shows, its panels and its files are those
//! of [`app`](crate::app), and the event loop of all canvases is in `page`.
//!
//! JavaScript around it (`web/`) reads the address, shows messages, and makes elements.

mod page;
#[cfg(debug_assertions)]
mod shaders;

use std::{cell::RefCell, rc::Rc};

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;
use web_sys::HtmlCanvasElement;

use self::page::{Bubble, add};
use crate::{
    app::{
        model::Model,
        system::{make_environment, worker},
    },
    input::{LoadedScene, light_of_scene, load_scene},
};

/// Prepares messages of errors for the browser's console.
#[wasm_bindgen(start)]
fn prepare() {
    console_error_panic_hook::set_once();
    // A second logger would be an error, and there is none.
    let _ = console_log::init_with_level(log::Level::Warn);
}

/// Keeps a file, so that scenes find it by its name.
#[wasm_bindgen(js_name = keepFile)]
pub fn keep_file(name: &str, bytes: &[u8]) {
    worker::keep_file(name, bytes);
}

/// The scene's TOML in the fragment of an address; none if the fragment holds no scene.
///
/// # Errors
/// The fragment is damaged.
#[wasm_bindgen(js_name = sceneOfLink)]
pub fn scene_of_link(fragment: &str) -> Result<Option<String>, JsError> {
    crate::app::link::scene_of(fragment).map_err(JsError::new)
}

/// Gives the page a worker, which answers each message by `work`.
#[wasm_bindgen]
pub fn employ(worker: web_sys::Worker) {
    worker::employ(worker);
}

/// Names this tab of the browser, and all open tabs that show the page, so that they keep their unsaved work apart.
#[wasm_bindgen(js_name = nameTabs)]
pub fn name_tabs(own: String, open: Vec<String>) {
    crate::app::storage::name_tabs(own, open);
}

/// What the worker answers to a message of the page.
#[wasm_bindgen]
#[must_use]
pub fn work(message: &[u8]) -> Vec<u8> {
    worker::done(message)
}

/// The names of the built-in scenes.
#[wasm_bindgen(js_name = presetNames)]
#[must_use]
pub fn preset_names() -> Vec<String> {
    crate::scene::preset_names().map(str::to_owned).collect()
}

/// A scene on a canvas.
#[wasm_bindgen]
pub struct SoapBubble {
    bubble: Rc<RefCell<Bubble>>,
}

#[wasm_bindgen]
impl SoapBubble {
    /// Shows a scene, by a preset's or a kept file's name, on a canvas, with the panels around it or without. `told` is called with `loading`, `ready` or
    /// `error`, and the error's text, whenever that changes: the picture is ready once all that it consists of is drawn.
    ///
    /// # Errors
    /// The scene cannot be loaded.
    pub async fn show(
        canvas: HtmlCanvasElement,
        scene: String,
        panels: bool,
        told: js_sys::Function,
    ) -> Result<SoapBubble, JsError> {
        let mut model = Model::new(load(&scene).await?);
        (model.stands_alone, model.presents) = (!panels, !panels);
        Ok(Self { bubble: add(model, canvas, told)? })
    }

    /// Shows another scene, by a preset's or a kept file's name.
    ///
    /// # Errors
    /// The scene cannot be loaded; the one before stays.
    pub fn load(&self, scene: String) -> js_sys::Promise {
        let bubble = self.bubble.clone();
        future_to_promise(async move {
            let loaded = load(&scene).await?;
            change(&bubble, |model| model.adopt(loaded));
            Ok(JsValue::UNDEFINED)
        })
    }

    /// Opens a kept file: a scene, or an environment for the scene.
    pub fn open(&self, name: &str) {
        let handler = &mut self.bubble.borrow_mut().handler;
        handler.open_file(name.as_ref());
        handler.ask_for_redraw();
    }

    /// Goes to the last tick before a time in seconds.
    pub fn seek(&self, time_s: f64) {
        self.change(|model| model.clock.seek((time_s / model.scene.motion.tick_s + 1e-6) as u64));
    }

    /// Stops time, or lets it run.
    pub fn pause(&self, pauses: bool) {
        self.change(|model| model.clock.running = !pauses);
    }

    /// Film time, s: while it runs, that of the picture.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn time(&self) -> f64 {
        let model = &self.bubble.borrow().handler.model;
        model.shown_tick() as f64 * model.scene.motion.tick_s
    }

    /// The scene with its history, as a scene file has it.
    #[wasm_bindgen(js_name = toToml)]
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.bubble.borrow().handler.model.scene.to_toml()
    }

    /// The fragment of an address that holds the scene with its history: see `sceneOfLink`.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn fragment(&self) -> String {
        crate::app::link::fragment(&self.to_toml())
    }

    /// Debug builds lose the device, so that tests can see it come back.
    #[cfg(debug_assertions)]
    #[wasm_bindgen(js_name = loseDevice)]
    pub fn lose_device(&self) {
        self.bubble.borrow_mut().handler.lose_device();
    }

    /// Takes the scene off its canvas.
    pub fn remove(&self) {
        page::remove(&self.bubble);
    }

    fn change(&self, changed: impl FnOnce(&mut Model)) {
        change(&self.bubble, changed);
    }
}

fn change(bubble: &RefCell<Bubble>, change: impl FnOnce(&mut Model)) {
    let handler = &mut bubble.borrow_mut().handler;
    change(&mut handler.model);
    handler.ask_for_redraw();
}

/// Loads a scene, its environment in the worker.
async fn load(scene: &str) -> Result<LoadedScene, JsError> {
    let (light, folder) = light_of_scene(scene)?;
    make_environment(light, folder).await;
    Ok(load_scene(scene)?)
}
