//! What can go wrong with adapters and devices.

use super::shaders::ShaderError;

/// Why there is no GPU to draw with, or why it failed.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// The backend's name is not one that exists.
    #[error("unknown graphics backend `{0}`: use vulkan, metal, dx12 or gl")]
    UnknownBackend(String),
    /// No driver at all.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        error(
            "no graphics adapter found{0}: install a Vulkan, Metal, DX12 or OpenGL ES driver (on Linux without a GPU: Mesa's lavapipe)"
        )
    )]
    #[cfg_attr(
        target_arch = "wasm32",
        error(
            "the browser gives no graphics adapter{0}: switch hardware acceleration on in its settings, and load the page again"
        )
    )]
    NoAdapter(String),
    /// An adapter was named, and is not there.
    #[error("no graphics adapter is named `{name}`; found: {found}")]
    NoSuchAdapter {
        /// The name asked for.
        name: String,
        /// The adapters that exist.
        found: String,
    },
    /// The adapter cannot do what the program needs.
    #[error("adapter {adapter} cannot be used: {reason}; choose another with --adapter or --backend")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// The message of the driver.
        reason: String,
    },
    /// The adapter cannot make pictures in full precision, as EXR files have it.
    #[error(
        "adapter {adapter} cannot make pictures in full precision: {reason}; write a .png, or choose another adapter with --adapter or --backend"
    )]
    NoFullPrecision {
        /// The adapter's name.
        adapter: String,
        /// What it lacks.
        reason: String,
    },
    /// More bubbles are in sight than the adapter can bind at once.
    #[error(
        "{count} bubbles are in sight, and this adapter holds {most} at once; lower `count` in [[generator]], or move the camera closer"
    )]
    TooManyBubbles {
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: u64,
    },
    /// Who watches the work wants no more of it.
    #[error("cancelled")]
    Cancelled,
    /// The device went away while in use.
    #[error("the graphics device was lost: {0}")]
    Lost(String),
    /// Something did not fit the device's memory any more.
    #[error(
        "the memory of the graphics device is full; make the picture smaller, lower `cells`, or show fewer bubbles"
    )]
    OutOfMemory,
    /// The driver refused something that the program recorded.
    #[error("the graphics driver refused a command: {0}")]
    Refused(String),
    /// A picture larger than the adapter can hold.
    #[error("a picture of {width}x{height} pixels does not fit this adapter: {limit}")]
    TooLarge {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Which limit is passed.
        limit: String,
    },
    /// A shader does not compile.
    #[error(transparent)]
    Shader(#[from] ShaderError),
}
