//! Buffers that say what they hold.

use std::{marker::PhantomData, ops::Deref};

/// A buffer that holds a `T` and may be bound as a uniform.
#[derive(Debug)]
pub struct UniformBuffer<T> {
    buffer: wgpu::Buffer,
    holds: PhantomData<T>,
}

impl<T> UniformBuffer<T> {
    /// A buffer of the size of a `T`, made for use as a uniform.
    #[must_use]
    pub fn of(buffer: wgpu::Buffer) -> Self {
        Self { buffer, holds: PhantomData }
    }
}

impl<T> Deref for UniformBuffer<T> {
    type Target = wgpu::Buffer;

    fn deref(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}
