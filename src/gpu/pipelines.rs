//! Pipelines, made on first use and kept: a pass, an entry point, the constants it was specialised for, and the targets' formats.
//!
//! Shaders get their constants here and not from the driver: see `specialise`.

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
    specialise::{Specialised, specialised},
};
use crate::physics::sphere::HALO;

/// Constants that all passes share. A shader declares those it needs as `override NAME: T;` without a default.
pub const SHARED_CONSTANTS: &[(&str, u32)] = &[("HALO", HALO as u32)];

/// What the stages of a pipeline are compiled from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SourceKey {
    /// File in `shaders/pass/`, without the ending.
    pub pass: &'static str,
    /// Numbers of the bindings that its entry points may use, and what each takes.
    pub bindings: &'static [(u32, wgpu::BindingType)],
    /// Values of the pass's own overridable constants.
    pub constants: Vec<(&'static str, u32)>,
}

/// Key of a compute pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ComputeKey {
    /// What it is compiled from.
    pub source: SourceKey,
    /// Entry point.
    pub entry: &'static str,
}

/// Key of a render pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RenderKey {
    /// What it is compiled from.
    pub source: SourceKey,
    /// Vertex shader, which makes its own vertices.
    pub vertex: &'static str,
    /// Fragment shader.
    pub fragment: &'static str,
    /// Formats of the targets.
    pub formats: Vec<wgpu::TextureFormat>,
}

/// A pipeline, and what to bind for it.
#[derive(Clone, Debug)]
pub struct Ready<P> {
    /// The pipeline.
    pub pipeline: P,
    layout: wgpu::BindGroupLayout,
    /// Numbers of the bindings that its constants leave a use for.
    bindings: Vec<u32>,
}

impl<P> Ready<P> {
    /// Binds resources by their numbers, but for those that the pipeline has no use for.
    pub fn bind(&self, device: &wgpu::Device, resources: &[(u32, wgpu::BindingResource<'_>)]) -> wgpu::BindGroup {
        let is_used = |number: &u32| self.bindings.contains(number);
        let entry = |(binding, resource): &(u32, _)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: wgpu::BindingResource::clone(resource),
        };
        let entries: Vec<_> = resources.iter().filter(|(number, _)| is_used(number)).map(entry).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &self.layout, entries: &entries })
    }
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
    compute: HashMap<ComputeKey, Ready<wgpu::ComputePipeline>>,
    render: HashMap<RenderKey, Ready<wgpu::RenderPipeline>>,
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
    pub fn compute(
        &self,
        device: &wgpu::Device,
        key: &ComputeKey,
    ) -> Result<Ready<wgpu::ComputePipeline>, ShaderError> {
        if let Some(pipeline) = self.made().compute.get(key) {
            return Ok(pipeline.clone());
        }
        let pipeline = make_compute(device, (&self.library(), &self.late), key)?;
        self.count.fetch_add(1, Ordering::Relaxed);
        self.made().compute.insert(key.clone(), pipeline.clone());
        Ok(pipeline)
    }

    /// The render pipeline of a key, made now if need be.
    pub fn render(&self, device: &wgpu::Device, key: &RenderKey) -> Result<Ready<wgpu::RenderPipeline>, ShaderError> {
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
    (library, late): (&Library, &LateErrors),
    key: &ComputeKey,
) -> Result<Ready<wgpu::ComputePipeline>, ShaderError> {
    let source = PassSource::new(device, library, &key.source)?;
    let scopes = Scopes::open(device);
    let shader = source.stage(key.entry)?;
    let layout = source.layout(&[(wgpu::ShaderStages::COMPUTE, &shader)]);
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(key.entry),
        layout: Some(&source.pipeline_layout(&layout)),
        module: &shader.module,
        entry_point: Some(key.entry),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    source.ready(scopes, late, [shader], (pipeline, layout))
}

fn make_render(
    device: &wgpu::Device,
    (library, late): (&Library, &LateErrors),
    key: &RenderKey,
) -> Result<Ready<wgpu::RenderPipeline>, ShaderError> {
    let source = PassSource::new(device, library, &key.source)?;
    let scopes = Scopes::open(device);
    let vertex = source.stage(key.vertex)?;
    let fragment = source.stage(key.fragment)?;
    let layout = source.layout(&[(wgpu::ShaderStages::VERTEX, &vertex), (wgpu::ShaderStages::FRAGMENT, &fragment)]);
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(key.fragment),
        layout: Some(&source.pipeline_layout(&layout)),
        vertex: wgpu::VertexState {
            module: &vertex.module,
            entry_point: Some(key.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &fragment.module,
            entry_point: Some(key.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &key.formats.iter().map(|format| Some((*format).into())).collect::<Vec<_>>(),
        }),
        multiview_mask: None,
        cache: None,
    });
    source.ready(scopes, late, [vertex, fragment], (pipeline, layout))
}

/// Error scopes for all that may be wrong with a shader: wgpu refuses it, or the driver does, as OpenGL's do when they link.
struct Scopes {
    /// Opened last.
    validation: wgpu::ErrorScopeGuard,
    internal: wgpu::ErrorScopeGuard,
}

impl Scopes {
    fn open(device: &wgpu::Device) -> Self {
        let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
        Self { validation: device.push_error_scope(wgpu::ErrorFilter::Validation), internal }
    }

    /// The first error. The driver's own comes before those that it caused.
    fn close(self) -> impl Future<Output = Option<wgpu::Error>> {
        let validation = self.validation.pop();
        let internal = self.internal.pop();
        async move {
            let internal = internal.await;
            let validation = validation.await;
            internal.or(validation)
        }
    }
}

/// A composed pass, and a value for each of its constants.
struct PassSource<'a> {
    device: &'a wgpu::Device,
    pass: &'static str,
    bindings: &'static [(u32, wgpu::BindingType)],
    composed: Composed,
    constants: Vec<(&'static str, u32)>,
}

/// The shader of one stage of a pipeline.
struct StageShader {
    module: wgpu::ShaderModule,
    /// As in [`Ready`].
    bindings: Vec<u32>,
}

impl<'a> PassSource<'a> {
    fn new(device: &'a wgpu::Device, library: &Library, key: &SourceKey) -> Result<Self, ShaderError> {
        let SourceKey { pass, bindings, ref constants } = *key;
        let composed = library.compose(pass)?;
        // Shared constants only where the text declares them: an unknown name would be refused.
        let shared = SHARED_CONSTANTS.iter().filter(|(name, _)| composed.declares(name));
        let constants = constants.iter().chain(shared).copied().collect();
        Ok(Self { device, pass, bindings, composed, constants })
    }

    /// The layout of what some stages use of the kernel's bindings.
    fn layout(&self, stages: &[(wgpu::ShaderStages, &StageShader)]) -> wgpu::BindGroupLayout {
        let entry = |&(binding, ty): &(u32, wgpu::BindingType)| {
            let users = stages.iter().filter(|(_, shader)| shader.bindings.contains(&binding));
            let visibility = users.fold(wgpu::ShaderStages::NONE, |all, (stage, _)| all | *stage);
            wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
        };
        let entries: Vec<_> = self.bindings.iter().map(entry).filter(|entry| !entry.visibility.is_empty()).collect();
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(self.pass), entries: &entries };
        self.device.create_bind_group_layout(&descriptor)
    }

    fn pipeline_layout(&self, bindings: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.pass),
            bind_group_layouts: &[Some(bindings)],
            immediate_size: 0,
        })
    }

    fn stage(&self, entry: &str) -> Result<StageShader, ShaderError> {
        let Specialised { wgsl, bindings } = specialised(&self.composed, entry, &self.constants)?;
        let source = wgpu::ShaderSource::Wgsl(wgsl.into());
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(self.pass), source });
        Ok(StageShader { module, bindings })
    }

    /// A pipeline, if nothing was refused since error scopes were opened. What the compiler or the driver refuses comes back as an error, here
    /// or later from [`Pipelines::late_error`].
    fn ready<P, const STAGES: usize>(
        self,
        scopes: Scopes,
        late: &LateErrors,
        shaders: [StageShader; STAGES],
        (pipeline, layout): (P, wgpu::BindGroupLayout),
    ) -> Result<Ready<P>, ShaderError> {
        let bindings = shaders.iter().flat_map(|shader| shader.bindings.iter().copied()).collect();
        let (Self { pass, composed, .. }, errors) = (self, scopes.close());
        let answer = async move {
            let error = errors.await?;
            let mut messages = Vec::new();
            for shader in shaders {
                messages.extend(shader.module.get_compilation_info().await.messages);
            }
            Some(shader_error(pass, &composed, messages, &error))
        };
        match late.ask(Box::pin(answer)) {
            Some(error) => Err(error),
            None => Ok(Ready { pipeline, layout, bindings }),
        }
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
