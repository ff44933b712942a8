//! What a browser has: tasks of one thread, a dialog for files, and files by name alone.

pub mod worker;

use std::{
    cell::RefCell,
    collections::BTreeMap,
    io,
    path::{Path, PathBuf},
    sync::Arc,
};

use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{File, HtmlInputElement, Response};
use winit::{
    event_loop::ActiveEventLoop,
    window::{Window, WindowAttributes},
};

use crate::{
    app::{link::fragment, request::Target},
    gpu::{AdapterChoice, Gpu, GpuError},
    input::{LightNamed, keep_environment},
    plan::{Product, Work},
    scene::Light,
};

/// The device that all canvases of a page share.
struct Shared {
    device: Option<Result<Gpu, GpuError>>,
    /// Fulfilled once the device is there.
    opening: Option<js_sys::Promise>,
}

thread_local! {
    static SHARED: RefCell<Shared> = const { RefCell::new(Shared { device: None, opening: None }) };
}

/// The device for a canvas: all canvases of a page share one, until it is lost.
pub async fn device(
    instance: wgpu::Instance,
    choice: &AdapterChoice,
    surface: &wgpu::Surface<'_>,
) -> Result<Gpu, GpuError> {
    let is_there = || SHARED.with_borrow(|shared| matches!(&shared.device, Some(Ok(gpu)) if !gpu.is_lost()));
    let opening = SHARED.with_borrow(|shared| shared.opening.clone().filter(|_| shared.device.is_none()));
    if let Some(opening) = opening {
        // Without its answer: what was opened, or why nothing could be, is kept.
        let _ = JsFuture::from(opening).await;
    } else if !is_there() {
        let mut opened = None;
        let opening = js_sys::Promise::new(&mut |resolve, _| opened = Some(resolve));
        SHARED.set(Shared { device: None, opening: Some(opening) });
        let device = Gpu::on_instance(instance, choice, Some(surface)).await;
        SHARED.with_borrow_mut(|shared| shared.device = Some(device));
        let _ = opened.map(|opened| opened.call0(&JsValue::NULL));
    }
    let device = SHARED.with_borrow(|shared| shared.device.clone());
    device.unwrap_or_else(|| Err(GpuError::NoAdapter(String::new())))
}

/// Puts a link to this page that shows a scene on the clipboard, and tells whether it is there.
pub fn copy_link(toml: &str, told: impl FnOnce(Result<(), String>) + 'static) {
    let writing = link(toml)
        .and_then(|link| Ok(web_sys::window().ok_or("there is no page")?.navigator().clipboard().write_text(&link)));
    spawn_local(async move {
        let written = match writing {
            Ok(writing) => JsFuture::from(writing).await.map(drop),
            Err(reason) => Err(reason),
        };
        told(written.map_err(|reason| format!("the link is not copied: {reason:?}")));
    });
}

fn link(toml: &str) -> Result<String, JsValue> {
    let href = web_sys::window().ok_or("there is no page")?.location().href()?;
    let page = href.split(['?', '#']).next().unwrap_or(&href);
    Ok(format!("{page}{}", fragment(toml)))
}

/// The page gives its canvas a size.
pub fn sized(_: &ActiveEventLoop, attributes: WindowAttributes, _: [f64; 2]) -> WindowAttributes {
    attributes
}

/// Leaves the end to the browser, which closes its pages itself.
pub fn end(_: &ActiveEventLoop) {}

/// Goes on when a device that is being opened is there.
pub fn finish(opening: impl Future<Output = ()> + 'static) {
    spawn_local(opening);
}

/// Runs a piece of work in a task of its own, after the page has shown that it has begun.
pub fn spawn(job: impl FnOnce() + 'static) -> io::Result<()> {
    spawn_after(50, job)
}

/// Runs a piece of work in a task of its own, in some milliseconds.
pub fn spawn_after(wait_ms: i32, job: impl FnOnce() + 'static) -> io::Result<()> {
    let refused = |reason: JsValue| io::Error::other(format!("{reason:?}"));
    let window = web_sys::window().ok_or_else(|| io::Error::other("there is no page"))?;
    let task = Closure::once_into_js(job);
    window
        .set_timeout_with_callback_and_timeout_and_arguments_0(task.unchecked_ref(), wait_ms)
        .map(drop)
        .map_err(refused)
}

/// Does work in the page's worker, or here if there is none.
pub fn compute(work: Work, answer: impl FnOnce(Product) + 'static) -> io::Result<()> {
    let asked = worker::Task::of(&work);
    worker::ask(&asked, move |product| answer(product.unwrap_or_else(|| work.done())))
}

/// Runs work that loads the environment of a light, once the page's worker has made that.
pub fn spawn_lit(
    light: impl FnOnce() -> Option<(Light, PathBuf)> + 'static,
    job: impl FnOnce() + 'static,
) -> io::Result<()> {
    spawn_local(async move {
        if let Some((light, folder)) = light() {
            make_environment(light, folder).await;
        }
        job();
    });
    Ok(())
}

/// Has the page's worker make the environment of a light, whose paths start from a folder. What fails there fails again where the light is loaded,
/// which says why.
pub async fn make_environment(light: Light, folder: PathBuf) {
    if let Some(made) = worker::environment(LightNamed::new(&light, &folder)).await {
        keep_environment(light, folder, made);
    }
}

thread_local! {
    /// Small pictures of presets that were asked for; none while they are on their way.
    static THUMBNAILS: RefCell<BTreeMap<String, Option<Arc<[u8]>>>> = const { RefCell::new(BTreeMap::new()) };
}

/// The small picture of a preset, a PNG file; empty if there is none. A page fetches it when it is first asked for.
pub fn thumbnail(name: &str) -> Option<Arc<[u8]>> {
    let known = THUMBNAILS.with_borrow(|thumbnails| thumbnails.get(name).cloned());
    known.unwrap_or_else(|| {
        let name = name.to_owned();
        THUMBNAILS.with_borrow_mut(|thumbnails| thumbnails.insert(name.clone(), None));
        spawn_local(async move {
            let png = fetch(&format!("thumbnails/{name}.png")).await.unwrap_or_default();
            THUMBNAILS.with_borrow_mut(|thumbnails| thumbnails.insert(name, Some(png.into())));
        });
        None
    })
}

/// The bytes at an address.
async fn fetch(address: &str) -> Result<Vec<u8>, JsValue> {
    let window = web_sys::window().ok_or("there is no page")?;
    let response: Response = JsFuture::from(window.fetch_with_str(address)).await?.unchecked_into();
    let bytes = JsFuture::from(response.array_buffer()?).await?;
    Ok(js_sys::Uint8Array::new(&bytes).to_vec())
}

/// A page forgets its files.
pub const FILES_LAST: bool = false;

/// Pages know files by their names alone.
pub fn whole_path(path: &Path) -> PathBuf {
    path.to_owned()
}

/// The system has no dialog for files; all browsers have one.
pub struct NoDialog;

/// Asks for a file: `answer` gets its name, or none if the user wants none. A file that is written is a download, which the browser asks for itself.
pub fn choose_file(
    target: Target,
    _: &Path,
    name: String,
    _: &Window,
    answer: impl FnOnce(Result<Option<PathBuf>, NoDialog>) + 'static,
) {
    if !target.is_read() {
        return answer(Ok(Some(name.into())));
    }
    // A scene is opened together with the files that it names.
    let named: &[&str] = if target == Target::OpenScene { &["exr", "hdr", "csv", "png", "jpg", "jpeg"] } else { &[] };
    let endings = target.file_type().1.iter().chain(named);
    let accepted: Vec<String> = endings.map(|ending| format!(".{ending}")).collect();
    spawn_local(async move {
        let kept = pick(&accepted.join(",")).await;
        answer(Ok(kept.unwrap_or_else(|reason| {
            log::error!("the browser opens no file: {reason:?}");
            None
        })));
    });
}

/// Shows the browser's dialog, and keeps all files that are chosen; the name of the scene among them, or of the first.
async fn pick(accepted: &str) -> Result<Option<PathBuf>, JsValue> {
    let document = web_sys::window().and_then(|window| window.document()).ok_or("there is no page")?;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(accepted);
    input.set_multiple(true);
    let chosen = js_sys::Promise::new(&mut |resolve, _| {
        input.set_onchange(Some(&resolve));
        let _ = input.add_event_listener_with_callback("cancel", &resolve);
    });
    input.click();
    JsFuture::from(chosen).await?;
    let Some(files) = input.files() else { return Ok(None) };
    let mut names = Vec::new();
    for file in (0..files.length()).filter_map(|index| files.get(index)) {
        keep(&file).await?;
        names.push(PathBuf::from(file.name()));
    }
    let scene = names.iter().position(|name| name.extension().is_some_and(|ending| ending == "toml"));
    Ok(names.into_iter().nth(scene.unwrap_or(0)))
}

async fn keep(file: &File) -> Result<(), JsValue> {
    let bytes = JsFuture::from(file.array_buffer()).await?;
    worker::keep_file(&file.name(), &js_sys::Uint8Array::new(&bytes).to_vec());
    Ok(())
}
