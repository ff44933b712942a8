//! Pipelines, made on first use and kept: a pass, an entry point, the constants it was specialised for, and the target's format.

use std::{
    collections::HashMap,
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
};

use super::{
    late_errors::LateErrors,
    shaders::{Composed, Library, ShaderError},
};
use crate::physics::sphere::HALO;

/// Constants that all passes share. A shader declares those it needs as `override NAME: T;` without a default.
pub const SHARED_CONSTANTS: &[(&str, u32)] = &[("HALO", HALO as u32)];

/// Key of a compute pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ComputeKey {
    /// File in `shaders/pass/`, without the ending.
    pub pass: &'static str,
    /// Entry point.
    pub entry: &'static str,
    /// Values of the pass's own overridable constants.
    pub constants: Vec<(&'static str, u32)>,
}

/// Key of a render pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RenderKey {
    /// File in `shaders/pass/`, without the ending.
    pub pass: &'static str,
    /// Vertex shader, which makes its own vertices.
    pub vertex: &'static str,
    /// Fragment shader.
    pub fragment: &'static str,
    /// Format of the one target.
    pub format: wgpu::TextureFormat,
    /// Values of the pass's own overridable constants.
    pub constants: Vec<(&'static str, u32)>,
}

/// All pipelines of a device.
pub struct Pipelines {
    library: Mutex<Library>,
    made: Mutex<Made>,
    late: LateErrors,
    count: AtomicU32,
}

#[derive(Default)]
struct Made {
    compute: HashMap<ComputeKey, wgpu::ComputePipeline>,
    render: HashMap<RenderKey, wgpu::RenderPipeline>,
}

impl Pipelines {
    pub(super) fn new() -> Self {
        Self {
            library: Mutex::default(),
            made: Mutex::default(),
            late: LateErrors::default(),
            count: AtomicU32::new(0),
        }
    }

    /// How many pipelines were made so far.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count.load(Ordering::Relaxed)
    }

    /// Messages of the compiler about a shader since the pipeline was made, as in browsers.
    pub fn late_error(&self) -> Option<ShaderError> {
        self.late.take()
    }

    /// The compute pipeline of a key, made now if need be.
    pub fn compute(&self, device: &wgpu::Device, key: &ComputeKey) -> Result<wgpu::ComputePipeline, ShaderError> {
        if let Some(pipeline) = self.made().compute.get(key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make_compute(device, (&self.library(), &self.late), key)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.made().compute.insert(key.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// The render pipeline of a key, made now if need be.
    pub fn render(&self, device: &wgpu::Device, key: &RenderKey) -> Result<wgpu::RenderPipeline, ShaderError> {
        if let Some(pipeline) = self.made().render.get(key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make_render(device, (&self.library(), &self.late), key)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.made().render.insert(key.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// Recreates all pipelines from another library. If one fails, everything stays as it was.
    pub fn reload(&self, device: &wgpu::Device, library: Library) -> Result<(), ShaderError> {
        let mut fresh = Made::default();
        for key in self.made().compute.keys() {
            fresh.compute.insert(key.clone(), make_compute(device, (&library, &self.late), key)?);
        }
        for key in self.made().render.keys() {
            fresh.render.insert(key.clone(), make_render(device, (&library, &self.late), key)?);
        }
        self.count.fetch_add((fresh.compute.len() + fresh.render.len()) as u32, Ordering::Relaxed);
        *self.made() = fresh;
        *self.library.lock().unwrap_or_else(PoisonError::into_inner) = library;
        Ok(())
    }

    // The maps stay whole whatever happened while another thread held them, so a poisoned lock is still good.
    fn made(&self) -> MutexGuard<'_, Made> {
        self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn library(&self) -> Library {
        self.library.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

fn make_compute(
    device: &wgpu::Device,
    source: (&Library, &LateErrors),
    key: &ComputeKey,
) -> Result<wgpu::ComputePipeline, ShaderError> {
    make(device, source, key.pass, &key.constants, |module, compilation_options| {
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(key.entry),
            layout: None,
            module,
            entry_point: Some(key.entry),
            compilation_options,
            cache: None,
        })
    })
}

fn make_render(
    device: &wgpu::Device,
    source: (&Library, &LateErrors),
    key: &RenderKey,
) -> Result<wgpu::RenderPipeline, ShaderError> {
    make(device, source, key.pass, &key.constants, |module, compilation_options| {
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(key.fragment),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(key.vertex),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(key.fragment),
                compilation_options,
                targets: &[Some(key.format.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    })
}

/// Composes a pass and builds a pipeline of it. What the compiler or the driver refuses comes back as an error, here or later from
/// [`Pipelines::late_error`].
fn make<P>(
    device: &wgpu::Device,
    (library, late): (&Library, &LateErrors),
    pass: &'static str,
    constants: &[(&'static str, u32)],
    build: impl FnOnce(&wgpu::ShaderModule, wgpu::PipelineCompilationOptions<'_>) -> P,
) -> Result<P, ShaderError> {
    let composed = library.compose(pass)?;
    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass),
        source: wgpu::ShaderSource::Wgsl(composed.wgsl.as_str().into()),
    });
    // Shared constants only where the text declares them: an unknown name would be refused.
    let shared = SHARED_CONSTANTS.iter().filter(|(name, _)| composed.declares(name));
    let constants: Vec<(&str, f64)> =
        constants.iter().chain(shared).map(|(name, value)| (*name, f64::from(*value))).collect();
    let pipeline = build(&module, wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() });
    let errors = scope.pop();
    let answer = async move {
        let error = errors.await?;
        let messages = module.get_compilation_info().await.messages;
        Some(shader_error(pass, &composed, messages, &error))
    };
    match late.ask(Box::pin(answer)) {
        Some(error) => Err(error),
        None => Ok(pipeline),
    }
}

/// The first message of the compiler, with its file and line.
fn shader_error(
    pass: &str,
    composed: &Composed,
    messages: Vec<wgpu::CompilationMessage>,
    error: &wgpu::Error,
) -> ShaderError {
    let told = messages.into_iter().find_map(|message| {
        let line = message.location?.line_number as usize;
        Some(ShaderError { place: composed.place(line), message: one_line(&message.message) })
    });
    told.unwrap_or_else(|| ShaderError { place: format!("pass/{pass}.wgsl"), message: one_line(&error.to_string()) })
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
