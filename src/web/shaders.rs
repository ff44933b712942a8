//! Shaders as the browser's own compiler gets them: debug builds let tests compile all of them.

use wasm_bindgen::prelude::*;

use crate::gpu::{
    kernel::Kernel,
    passes::kernels,
    pipelines::SHARED_CONSTANTS,
    shaders::{Composed, Library},
};

/// A kernel's shader.
#[wasm_bindgen]
pub struct Shader {
    kernel: Kernel,
    composed: Composed,
}

#[wasm_bindgen]
impl Shader {
    /// Those of all kernels.
    ///
    /// # Errors
    /// A pass imports what there is not.
    pub fn all() -> Result<Vec<Shader>, JsError> {
        let shader = |kernel: Kernel| Ok(Shader { composed: Library::Embedded.compose(kernel.pass)?, kernel });
        kernels().into_iter().map(shader).collect()
    }

    /// Its WGSL.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn text(&self) -> String {
        self.composed.wgsl.clone()
    }

    /// The file and line behind a line of the text, counted from 1.
    #[must_use]
    pub fn place(&self, line: usize) -> String {
        self.composed.place(line)
    }

    /// Values for its constants, a line for each specialisation: `NAME=1 OTHER=0`.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn specialisations(&self) -> Vec<String> {
        let declares = |name: &str| self.composed.declares(name);
        let shared = SHARED_CONSTANTS.iter().copied().filter(|(name, _)| declares(name));
        let every = self.kernel.specialisations(declares).into_iter();
        let line = |constants: std::collections::BTreeMap<&'static str, u32>| {
            let words = constants.into_iter().chain(shared.clone()).map(|(name, value)| format!("{name}={value}"));
            words.collect::<Vec<_>>().join(" ")
        };
        every.map(line).collect()
    }
}
