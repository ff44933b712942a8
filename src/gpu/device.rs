//! The device that everything runs on, and what can go wrong with it.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, AtomicU64, Ordering},
};

use super::{
    abilities::missing_ability,
    adapter::{AdapterChoice, adapter_name, find_adapter},
    pipelines::Pipelines,
    uniform_buffer::UniformBuffer,
};

pub use super::error::GpuError;

/// Adapter, device, queue, and the pipelines made so far. A clone is another handle to the same device and pipelines.
#[derive(Clone)]
pub struct Gpu {
    /// The instance that the adapter came from; windows make their surfaces with it.
    pub instance: wgpu::Instance,
    /// The adapter in use.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Pipelines, made on first use.
    pub pipelines: Arc<Pipelines>,
    lost: Arc<Loss>,
    failure: Arc<Mutex<Option<GpuError>>>,
    uploaded_bytes: Arc<AtomicU64>,
    point_sampler: wgpu::Sampler,
}

impl Gpu {
    /// Opens the chosen adapter without a window.
    pub async fn headless(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = choice.backends()?;
        descriptor.flags = instance_flags();
        let instance = wgpu::Instance::new(descriptor);
        Self::on_instance(instance, choice, None).await
    }

    /// The instance for a choice, for use with a window system's display.
    pub fn instance_for(
        choice: &AdapterChoice,
        display: Box<dyn wgpu::wgt::WgpuHasDisplayHandle>,
    ) -> Result<wgpu::Instance, GpuError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_with_display_handle(display);
        descriptor.backends = choice.backends()?;
        descriptor.flags = instance_flags();
        Ok(wgpu::Instance::new(descriptor))
    }

    /// Opens the chosen adapter of an instance; with a surface, one that can present to it.
    pub async fn on_instance(
        instance: wgpu::Instance,
        choice: &AdapterChoice,
        surface: Option<&wgpu::Surface<'_>>,
    ) -> Result<Self, GpuError> {
        let adapter = find_adapter(&instance, choice, surface).await?;
        Self::on_adapter(instance, adapter).await
    }

    /// Another device on the same adapter, with nothing on it.
    pub async fn another(&self) -> Result<Self, GpuError> {
        Self::on_adapter(self.instance.clone(), self.adapter.clone()).await
    }

    async fn on_adapter(instance: wgpu::Instance, adapter: wgpu::Adapter) -> Result<Self, GpuError> {
        let info = adapter.get_info();
        if let Some(reason) = missing_ability(&adapter) {
            return Err(GpuError::NoDevice { adapter: adapter_name(&info), reason });
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("soapfilm"),
            required_features: adapter.features() & OPTIONAL_FEATURES,
            required_limits: limits_for(&adapter.limits()),
            ..Default::default()
        };
        let (device, queue) = adapter
            .request_device(&descriptor)
            .await
            .map_err(|error| GpuError::NoDevice { adapter: adapter_name(&info), reason: error.to_string() })?;
        let lost = Arc::new(Loss::default());
        let failure = Arc::new(Mutex::new(None));
        watch(&device, &lost, &failure);
        #[cfg_attr(target_arch = "wasm32", expect(clippy::arc_with_non_send_sync, reason = "a page has one thread"))]
        let (pipelines, uploaded_bytes) = (Arc::new(Pipelines::new()), Arc::default());
        let point_sampler = device.create_sampler(&wgpu::SamplerDescriptor::default());
        Ok(Self { instance, adapter, device, queue, pipelines, lost, failure, uploaded_bytes, point_sampler })
    }

    /// Name of the adapter, with its backend: what every command prints.
    #[must_use]
    pub fn adapter_name(&self) -> String {
        adapter_name(&self.adapter.get_info())
    }

    /// A sampler that filters nothing.
    #[must_use]
    pub fn point_sampler(&self) -> &wgpu::Sampler {
        &self.point_sampler
    }

    /// The driver's name and version.
    #[must_use]
    pub fn driver(&self) -> String {
        let info = self.adapter.get_info();
        format!("{} {}", info.driver, info.driver_info).trim().to_owned()
    }

    /// Refuses a picture that the adapter cannot hold before anything is made for it.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] for one with a side that is too long.
    pub fn check_picture_size(&self, [width, height]: [u32; 2]) -> Result<(), GpuError> {
        let side = self.device.limits().max_texture_dimension_2d;
        if width.max(height) > side {
            let limit = format!("its textures have at most {side} pixels per side");
            return Err(GpuError::TooLarge { width, height, limit });
        }
        Ok(())
    }

    /// Whether passes can be timed on the GPU.
    #[must_use]
    pub fn can_time(&self) -> bool {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Fails if the device was lost, ran out of memory, or refused a command or a shader, since the last call.
    pub fn check(&self) -> Result<(), GpuError> {
        let failure = self.failure.lock().map_or(None, |mut failure| failure.take());
        if failure.is_some() {
            // A lost device refuses everything. That it is lost is told when it is polled.
            let _ = self.device.poll(wgpu::PollType::Poll);
        }
        if self.is_lost() {
            return Err(GpuError::Lost("make a new one".to_owned()));
        }
        match failure {
            Some(error) => Err(error),
            None => self.pipelines.late_error().map_or(Ok(()), |error| Err(error.into())),
        }
    }

    /// Whether the device is gone and everything on it with it.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.lost.is_told.load(Ordering::Relaxed)
    }

    /// Calls a function once the device is lost, from any thread: who draws only when something has changed must be told.
    pub fn when_lost(&self, call: impl FnOnce() + Send + 'static) {
        self.lost.waiting.lock().unwrap_or_else(PoisonError::into_inner).push(Box::new(call));
    }

    /// Bytes sent to the device so far.
    #[must_use]
    pub fn uploaded_bytes(&self) -> u64 {
        self.uploaded_bytes.load(Ordering::Relaxed)
    }

    /// Counts bytes that are about to be sent by other means than [`Gpu::upload`].
    pub fn count_upload(&self, bytes: usize) {
        self.uploaded_bytes.fetch_add(bytes as u64, Ordering::Relaxed);
    }

    /// Writes to a texture.
    pub fn upload_texture(
        &self,
        to: wgpu::TexelCopyTextureInfo<'_>,
        bytes: &[u8],
        layout: wgpu::TexelCopyBufferLayout,
        size: wgpu::Extent3d,
    ) {
        self.count_upload(bytes.len());
        self.queue.write_texture(to, bytes, layout, size);
    }

    /// Writes plain data to the start of a buffer.
    pub fn upload<T: bytemuck::NoUninit>(&self, buffer: &wgpu::Buffer, data: &[T]) {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        self.count_upload(bytes.len());
        self.queue.write_buffer(buffer, 0, bytes);
    }

    /// Layers to make of a texture that is seen as an array of some. wgpu's OpenGL backend tells what a texture is from its size: it takes one
    /// layer for a plain texture and squares in sixes for a cube map, so that there it gets a layer more.
    #[must_use]
    pub fn array_layers(&self, layers: u32) -> u32 {
        let is_mistaken = layers == 1 || layers.is_multiple_of(6);
        layers + u32::from(is_mistaken && self.adapter.get_info().backend == wgpu::Backend::Gl)
    }

    /// A buffer of a given size and use, filled with zeros.
    #[must_use]
    pub fn buffer(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// A uniform buffer that holds one value.
    #[must_use]
    pub fn uniform<T: bytemuck::NoUninit>(&self, label: &str, value: &T) -> UniformBuffer<T> {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(label, size_of::<T>() as u64, usage);
        self.upload(&buffer, std::slice::from_ref(value));
        UniformBuffer::of(buffer)
    }

    /// A storage buffer that holds a list, which must not be empty.
    #[must_use]
    pub fn storage<T: bytemuck::NoUninit>(&self, label: &str, values: &[T]) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(label, size_of_val(values) as u64, usage);
        self.upload(&buffer, values);
        buffer
    }

    /// How many values of a type a shader can read from one storage buffer.
    #[must_use]
    pub fn most_values<T>(&self) -> u64 {
        let limits = self.device.limits();
        limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) / size_of::<T>() as u64
    }

    /// Waits until the device has done all that was submitted. Not for browsers, where nothing may block.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn wait(&self) -> Result<(), GpuError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| GpuError::Lost(error.to_string()))?;
        self.check()
    }
}

/// What is used where it exists and done without elsewhere.
pub const OPTIONAL_FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY;

/// WebGPU's guaranteed limits, which every shader keeps to, with pictures as large as the adapter can hold.
fn limits_for(adapter: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_texture_dimension_2d: adapter.max_texture_dimension_2d,
        max_buffer_size: adapter.max_buffer_size,
        ..Default::default()
    }
}

/// wgpu would look at the arguments of each indirect dispatch in a dispatch of its own. Ours are none, or what a direct dispatch would have.
fn instance_flags() -> wgpu::InstanceFlags {
    wgpu::InstanceFlags::default() - wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL
}

/// Whether a device is lost, and who waits to hear of it.
#[derive(Default)]
struct Loss {
    is_told: AtomicBool,
    waiting: Mutex<Vec<Box<dyn FnOnce() + Send>>>,
}

impl Loss {
    fn tell(&self) {
        self.is_told.store(true, Ordering::Relaxed);
        let waiting = std::mem::take(&mut *self.waiting.lock().unwrap_or_else(PoisonError::into_inner));
        waiting.into_iter().for_each(|call| call());
    }
}

/// Keeps what the device reports by callback, so that the next [`Gpu::check`] returns it as an error.
fn watch(device: &wgpu::Device, lost: &Arc<Loss>, failure: &Arc<Mutex<Option<GpuError>>>) {
    let gone = lost.clone();
    device.set_device_lost_callback(move |_, message| {
        log::warn!("graphics device lost: {message}");
        gone.tell();
    });
    let failure = failure.clone();
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        let text = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        log::error!("{text}");
        let error = if matches!(error, wgpu::Error::OutOfMemory { .. }) {
            GpuError::OutOfMemory
        } else {
            GpuError::Refused(text)
        };
        if let Ok(mut failure) = failure.lock() {
            failure.get_or_insert(error);
        }
    }));
}
