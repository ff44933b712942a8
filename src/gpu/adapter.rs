//! The adapter that a user asks for.

use super::error::GpuError;

/// What a user asked for; without a name or backend the best adapter there is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AdapterChoice {
    /// Part of the adapter's name, in any case.
    pub name: Option<String>,
    /// `vulkan`, `metal`, `dx12` or `gl`.
    pub backend: Option<String>,
}

impl AdapterChoice {
    /// The choice of the environment variables `WGPU_ADAPTER_NAME` and `WGPU_BACKEND`, for whatever this one leaves open.
    #[must_use]
    pub fn or_env(self) -> Self {
        let read = |key| std::env::var(key).ok().filter(|value: &String| !value.is_empty());
        Self {
            name: self.name.or_else(|| read("WGPU_ADAPTER_NAME")),
            backend: self.backend.or_else(|| read("WGPU_BACKEND")),
        }
    }

    pub(super) fn backends(&self) -> Result<wgpu::Backends, GpuError> {
        let Some(names) = &self.backend else { return Ok(wgpu::Backends::all()) };
        let mut backends = wgpu::Backends::empty();
        for name in names.split(',') {
            backends |= match name.trim().to_ascii_lowercase().as_str() {
                "vulkan" | "vk" => wgpu::Backends::VULKAN,
                "metal" | "mtl" => wgpu::Backends::METAL,
                "dx12" | "d3d12" => wgpu::Backends::DX12,
                "gl" | "gles" | "opengl" => wgpu::Backends::GL,
                _ => return Err(GpuError::UnknownBackend(name.trim().to_owned())),
            };
        }
        Ok(backends)
    }
}

/// The adapter of an instance that a choice names; with a surface, one that can present to it.
pub(super) async fn find_adapter(
    instance: &wgpu::Instance,
    choice: &AdapterChoice,
    surface: Option<&wgpu::Surface<'_>>,
) -> Result<wgpu::Adapter, GpuError> {
    let backends = choice.backends()?;
    let Some(name) = &choice.name else {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        };
        let backend = choice.backend.as_ref().map(|name| format!(" for backend {name}")).unwrap_or_default();
        return instance.request_adapter(&options).await.map_err(|_| GpuError::NoAdapter(backend));
    };
    let adapters = instance.enumerate_adapters(backends).await;
    let found = adapters.iter().map(|adapter| adapter.get_info().name).collect::<Vec<_>>().join(", ");
    adapters
        .into_iter()
        .find(|adapter| {
            let matches = adapter.get_info().name.to_lowercase().contains(&name.to_lowercase());
            matches && surface.is_none_or(|surface| adapter.is_surface_supported(surface))
        })
        .ok_or_else(|| GpuError::NoSuchAdapter {
            name: name.clone(),
            found: if found.is_empty() { "none at all".to_owned() } else { found },
        })
}

/// Name of an adapter, with its backend.
pub(super) fn adapter_name(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({:?})", info.name, info.backend)
}
