//! Shaders as the browser's own compiler gets them: debug builds let tests compile all of them.

use wasm_bindgen::prelude::*;

use crate::gpu::{
    kernel::Kernel,
    passes::kernels,
    pipelines::SHARED_CONSTANTS,
    shaders::{Composed, Library},
    specialise::specialised,
};

/// A kernel's shaders.
#[wasm_bindgen]
pub struct Shader {
    composed: Composed,
    /// Entry points, each with values for its constants.
    variants: Vec<(&'static str, Vec<(&'static str, u32)>)>,
}

#[wasm_bindgen]
impl Shader {
    /// Those of all kernels.
    ///
    /// # Errors
    /// A pass imports what there is not.
    pub fn all() -> Result<Vec<Shader>, JsError> {
        kernels().iter().map(|kernel| Ok(Self::of(kernel, Library::Embedded.compose(kernel.pass)?))).collect()
    }

    fn of(kernel: &Kernel, composed: Composed) -> Self {
        let declares = |name: &str| composed.declares(name);
        let shared: Vec<_> = SHARED_CONSTANTS.iter().copied().filter(|(name, _)| declares(name)).collect();
        let entries = kernel.entries.names();
        let mut variants = Vec::new();
        for constants in kernel.specialisations(declares) {
            let constants: Vec<_> = constants.into_iter().chain(shared.iter().copied()).collect();
            variants.extend(entries.iter().map(|entry| (*entry, constants.clone())));
        }
        Self { composed, variants }
    }

    /// Its variants: entry points and values for their constants, in words.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn variants(&self) -> Vec<String> {
        let words = |constants: &[(&str, u32)]| {
            constants.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
        };
        self.variants.iter().map(|(entry, constants)| format!("{entry} {}", words(constants))).collect()
    }

    /// The WGSL of a variant.
    ///
    /// # Errors
    /// A constant has no value.
    pub fn text(&self, variant: usize) -> Result<String, JsError> {
        let (entry, constants) = &self.variants[variant];
        Ok(specialised(&self.composed, entry, constants)?.wgsl)
    }

    /// The file and line behind a line of the text, counted from 1.
    #[must_use]
    pub fn place(&self, line: usize) -> String {
        self.composed.place(line)
    }
}
