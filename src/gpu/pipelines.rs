//! Pipelines, made on first use and kept: a pass, an entry point, the constants it was specialised for, and the target's format.

use std::{
    collections::HashMap,
    sync::{
        Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
};

use super::{
    Gpu, GpuError,
    shaders::{Composed, Library, ShaderError},
};
use crate::physics::sphere::HALO;

/// Constants that several passes share. A shader declares those it needs as `override NAME: T;` without a default.
const SHARED_CONSTANTS: &[(&str, u32)] = &[("HALO", HALO as u32)];

/// What tells one compute pipeline from another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ComputeKey {
    /// File in `shaders/pass/`, without the ending.
    pub pass: &'static str,
    /// Entry point.
    pub entry: &'static str,
    /// Values of the pass's own overridable constants.
    pub constants: Vec<(&'static str, u32)>,
}

/// What tells one render pipeline from another.
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
    count: AtomicU32,
}

#[derive(Default)]
struct Made {
    compute: HashMap<ComputeKey, wgpu::ComputePipeline>,
    render: HashMap<RenderKey, wgpu::RenderPipeline>,
}

impl Pipelines {
    pub(super) fn new() -> Self {
        Self { library: Mutex::default(), made: Mutex::default(), count: AtomicU32::new(0) }
    }

    /// How many pipelines were made so far.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count.load(Ordering::Relaxed)
    }

    /// The compute pipeline of a key, made now if need be.
    pub fn compute(&self, gpu: &Gpu, key: &ComputeKey) -> Result<wgpu::ComputePipeline, GpuError> {
        if let Some(pipeline) = self.made().compute.get(key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make_compute(gpu, &self.library(), key)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.made().compute.insert(key.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// The render pipeline of a key, made now if need be.
    pub fn render(&self, gpu: &Gpu, key: &RenderKey) -> Result<wgpu::RenderPipeline, GpuError> {
        if let Some(pipeline) = self.made().render.get(key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make_render(gpu, &self.library(), key)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.made().render.insert(key.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// Makes all pipelines anew from another library. If one fails, everything stays as it was.
    pub fn reload(&self, gpu: &Gpu, library: Library) -> Result<(), GpuError> {
        let mut fresh = Made::default();
        for key in self.made().compute.keys() {
            fresh.compute.insert(key.clone(), make_compute(gpu, &library, key)?);
        }
        for key in self.made().render.keys() {
            fresh.render.insert(key.clone(), make_render(gpu, &library, key)?);
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

fn make_compute(gpu: &Gpu, library: &Library, key: &ComputeKey) -> Result<wgpu::ComputePipeline, GpuError> {
    make(gpu, library, key.pass, &key.constants, |module, compilation_options| {
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(key.entry),
            layout: None,
            module,
            entry_point: Some(key.entry),
            compilation_options,
            cache: None,
        })
    })
}

fn make_render(gpu: &Gpu, library: &Library, key: &RenderKey) -> Result<wgpu::RenderPipeline, GpuError> {
    make(gpu, library, key.pass, &key.constants, |module, compilation_options| {
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
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

/// Composes a pass and builds a pipeline of it; what the compiler or the driver refuses comes back as an error.
fn make<P>(
    gpu: &Gpu,
    library: &Library,
    pass: &'static str,
    constants: &[(&'static str, u32)],
    build: impl FnOnce(&wgpu::ShaderModule, wgpu::PipelineCompilationOptions<'_>) -> P,
) -> Result<P, GpuError> {
    let composed = library.compose(pass)?;
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass),
        source: wgpu::ShaderSource::Wgsl(composed.wgsl.as_str().into()),
    });
    // Shared constants only where the text declares them: an unknown name would be refused.
    let shared = SHARED_CONSTANTS.iter().filter(|(name, _)| composed.declares(name));
    let constants: Vec<(&str, f64)> =
        constants.iter().chain(shared).map(|(name, value)| (*name, f64::from(*value))).collect();
    let pipeline = build(&module, wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() });
    match ready(scope.pop()).flatten() {
        Some(error) => Err(shader_error(pass, &composed, &module, &error).into()),
        None => Ok(pipeline),
    }
}

/// The first thing the compiler said, with the file and line it means.
fn shader_error(pass: &str, composed: &Composed, module: &wgpu::ShaderModule, error: &wgpu::Error) -> ShaderError {
    let messages = ready(module.get_compilation_info()).map(|info| info.messages).unwrap_or_default();
    let told = messages.into_iter().find_map(|message| {
        let line = message.location?.line_number as usize;
        Some(ShaderError { place: composed.place(line), message: one_line(&message.message) })
    });
    told.unwrap_or_else(|| ShaderError { place: format!("pass/{pass}.wgsl"), message: one_line(&error.to_string()) })
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The value of a future that is ready at once, as error scopes and compilation messages are outside browsers.
fn ready<T>(future: impl Future<Output = T>) -> Option<T> {
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    match std::pin::pin!(future).poll(&mut context) {
        std::task::Poll::Ready(value) => Some(value),
        std::task::Poll::Pending => None,
    }
}
