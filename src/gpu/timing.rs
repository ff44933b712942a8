//! What a frame cost: GPU time of each pass where the adapter can tell, and counts of the work asked for.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{
    device::{Gpu, GpuError},
    pipelines::ComputeKey,
};

/// Passes that one query set can time; a submission takes as many sets as it needs.
const PASSES_PER_SET: usize = 64;

/// Name of the passes that move a film.
pub const STEP_FIELD: &str = "step_field";
/// Name of the passes that move a film's flow.
pub const STEP_FLOW: &str = "step_flow";
/// Name of the passes that make a film ready to be drawn.
pub const SHOW_FIELD: &str = "show_field";

/// Name of the pass that ends a picture.
pub const TONEMAP: &str = "tonemap";

/// GPU time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// The pass.
    pub name: &'static str,
    /// Milliseconds; `None` where the adapter does not report them or reports nonsense.
    pub gpu_ms: Option<f64>,
}

/// Steps of films that the device has timed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepTime {
    /// Cells whose liquid was moved.
    pub cells: u64,
    /// Milliseconds on the GPU.
    pub gpu_ms: f64,
}

/// Workgroups of a dispatch.
#[derive(Clone, Copy, Debug)]
pub enum Groups<'a> {
    /// So many.
    Count([u32; 3]),
    /// As many as the device has written at an offset of a buffer.
    From(&'a wgpu::Buffer, u64),
}

impl From<[u32; 3]> for Groups<'_> {
    fn from(groups: [u32; 3]) -> Self {
        Self::Count(groups)
    }
}

/// Counts of the work that was submitted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Compute dispatches.
    pub dispatches: u64,
    /// Draw calls.
    pub draws: u64,
    /// Pixels inside the rectangles that were drawn.
    pub pixels_shaded: u64,
    /// Cells whose liquid was moved.
    pub cells_stepped: u64,
    /// Bytes of the films' states that steps read and wrote, each once.
    pub state_bytes: u64,
    /// Submissions to the queue.
    pub submissions: u64,
}

/// Records passes into one submission, counting and timing them.
pub struct Recorder<'g> {
    /// The device.
    pub gpu: &'g Gpu,
    /// Counts so far.
    pub counts: Counts,
    encoder: wgpu::CommandEncoder,
    /// The compute pass that is still open. Dispatches of one name in a row share it: in each pass, wgpu makes room to track every resource of the
    /// device.
    open: Option<(&'static str, wgpu::ComputePass<'static>)>,
    queries: Vec<wgpu::QuerySet>,
    names: Vec<&'static str>,
}

impl<'g> Recorder<'g> {
    /// An empty submission.
    #[must_use]
    pub fn new(gpu: &'g Gpu) -> Self {
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("soapfilm") });
        Self {
            gpu,
            counts: Counts { submissions: 1, ..Counts::default() },
            encoder,
            open: None,
            queries: Vec::new(),
            names: Vec::new(),
        }
    }

    /// Where the next pass writes when it begins and ends, if the adapter can tell.
    fn next_timestamps(&mut self, name: &'static str) -> Option<(wgpu::QuerySet, u32)> {
        let place = self.names.len();
        self.names.push(name);
        if !self.gpu.can_time() {
            return None;
        }
        if place.is_multiple_of(PASSES_PER_SET) {
            self.queries.push(self.gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * PASSES_PER_SET as u32,
            }));
        }
        let set = self.queries.last()?.clone();
        Some((set, 2 * (place % PASSES_PER_SET) as u32))
    }

    /// One dispatch of a compute pass. Resources are bound by number: entry points of one file need not use all of its bindings.
    pub fn compute(
        &mut self,
        name: &'static str,
        key: &ComputeKey,
        resources: &[(u32, wgpu::BindingResource<'_>)],
        groups: Groups<'_>,
    ) -> Result<(), GpuError> {
        let gpu = self.gpu;
        let ready = gpu.pipelines.compute(&gpu.device, key)?;
        let bindings = ready.bind(&gpu.device, resources);
        self.dispatch(name, &ready.pipeline, &bindings, groups);
        Ok(())
    }

    /// One dispatch of a compute pipeline.
    fn dispatch(
        &mut self,
        name: &'static str,
        pipeline: &wgpu::ComputePipeline,
        bindings: &wgpu::BindGroup,
        groups: Groups<'_>,
    ) {
        let pass = self.compute_pass(name);
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, bindings, &[]);
        match groups {
            Groups::Count([x, y, z]) => pass.dispatch_workgroups(x, y, z),
            Groups::From(arguments, offset) => pass.dispatch_workgroups_indirect(arguments, offset),
        }
        self.counts.dispatches += 1;
    }

    /// The compute pass of a name: the open one, or a new one.
    fn compute_pass(&mut self, name: &'static str) -> &mut wgpu::ComputePass<'static> {
        // Another pass ends here: an encoder has one at a time.
        let open = self.open.take().filter(|(open, _)| *open == name);
        let pass = match open {
            Some(open) => open,
            None => (name, self.begin_compute_pass(name)),
        };
        &mut self.open.insert(pass).1
    }

    fn begin_compute_pass(&mut self, name: &'static str) -> wgpu::ComputePass<'static> {
        let timestamps = self.next_timestamps(name);
        let timestamp_writes = timestamps.as_ref().map(|(query_set, first)| wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(*first),
            end_of_pass_write_index: Some(*first + 1),
        });
        let descriptor = wgpu::ComputePassDescriptor { label: Some(name), timestamp_writes };
        self.encoder.begin_compute_pass(&descriptor).forget_lifetime()
    }

    /// A render pass into one target, which keeps what it holds, or is set to a colour first.
    pub fn render(
        &mut self,
        name: &'static str,
        target: &wgpu::TextureView,
        clear: Option<wgpu::Color>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        self.render_into(name, &[(target, clear)], draw);
    }

    /// A render pass into several targets.
    pub fn render_into(
        &mut self,
        name: &'static str,
        targets: &[(&wgpu::TextureView, Option<wgpu::Color>)],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let timestamps = self.next_timestamps(name);
        let timestamp_writes = timestamps.as_ref().map(|(query_set, first)| wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(*first),
            end_of_pass_write_index: Some(*first + 1),
        });
        let attachments: Vec<_> = targets
            .iter()
            .map(|(view, clear)| {
                Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: clear.map_or(wgpu::LoadOp::Load, wgpu::LoadOp::Clear),
                        store: wgpu::StoreOp::Store,
                    },
                })
            })
            .collect();
        let mut pass = self.encoder().begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(name),
            color_attachments: &attachments,
            timestamp_writes,
            ..Default::default()
        });
        draw(&mut pass);
    }

    /// The encoder, for copies and passes.
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        self.open = None;
        &mut self.encoder
    }

    /// Records that all timestamps come into a buffer: two numbers per pass.
    fn resolve_timestamps(&mut self) -> wgpu::Buffer {
        let size = 16 * self.names.len() as u64;
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let resolved = self.gpu.buffer("resolved pass times", size, usage);
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let readable = self.gpu.buffer("pass times", size, usage);
        for (number, queries) in self.queries.iter().enumerate() {
            let first = number * PASSES_PER_SET;
            let passes = (self.names.len() - first).min(PASSES_PER_SET);
            self.encoder.resolve_query_set(queries, 0..2 * passes as u32, &resolved, 16 * first as u64);
        }
        self.encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, size);
        readable
    }

    /// Submits what was recorded. Times arrive in `times` once the device has done it and was polled.
    pub fn submit(mut self, times: &TimeLog) -> Counts {
        self.open = None;
        let readable = (!self.queries.is_empty()).then(|| self.resolve_timestamps());
        self.gpu.queue.submit([self.encoder.finish()]);
        match readable {
            Some(readable) => {
                let period_ns = self.gpu.queue.get_timestamp_period();
                times.expect(&readable, self.names, (period_ns, self.counts.cells_stepped));
            }
            None => times.add(self.names.into_iter().map(|name| PassTime { name, gpu_ms: None })),
        }
        self.counts
    }
}

/// Times that have arrived.
#[derive(Clone, Debug, Default)]
pub struct TimeLog(Arc<Mutex<Arrived>>);

/// Sums since they were taken last.
#[derive(Debug, Default)]
struct Arrived {
    passes: Vec<PassTime>,
    steps: StepTime,
}

impl TimeLog {
    /// Takes the times of all passes that have arrived since the last call, summed by pass, in the order in which passes first ran.
    #[must_use]
    pub fn take(&self) -> Vec<PassTime> {
        std::mem::take(&mut self.arrived().passes)
    }

    /// Takes what steps of films have taken since the last call.
    #[must_use]
    pub fn take_steps(&self) -> StepTime {
        std::mem::take(&mut self.arrived().steps)
    }

    fn arrived(&self) -> MutexGuard<'_, Arrived> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn add(&self, times: impl Iterator<Item = PassTime>) {
        let log = &mut self.arrived().passes;
        for time in times {
            match log.iter_mut().find(|known| known.name == time.name) {
                Some(known) => known.gpu_ms = known.gpu_ms.zip(time.gpu_ms).map(|(a, b)| a + b),
                None => log.push(time),
            }
        }
    }

    /// Enters the times of one submission, which moves the liquid of some cells or of none.
    fn expect(&self, readable: &wgpu::Buffer, names: Vec<&'static str>, (period_ns, cells): (f32, u64)) {
        let log = self.clone();
        let buffer = readable.clone();
        readable.map_async(wgpu::MapMode::Read, .., move |mapped| {
            let ticks: Vec<u64> = match (mapped, buffer.get_mapped_range(..)) {
                (Ok(()), Ok(bytes)) => bytemuck::pod_collect_to_vec(&bytes),
                _ => Vec::new(),
            };
            let span = |slot: usize| {
                let ticks = ticks.get(2 * slot + 1)?.checked_sub(ticks[2 * slot])?;
                // Some drivers answer zero where they do not know.
                (ticks > 0).then(|| ticks as f64 * f64::from(period_ns) * 1e-6)
            };
            let spans: Vec<Option<f64>> = (0..names.len()).map(span).collect();
            log.add_steps(cells, spans.iter().copied().sum());
            log.add(names.into_iter().zip(spans).map(|(name, gpu_ms)| PassTime { name, gpu_ms }));
        });
    }

    fn add_steps(&self, cells: u64, gpu_ms: Option<f64>) {
        if let Some(gpu_ms) = gpu_ms.filter(|_| cells > 0) {
            let steps = &mut self.arrived().steps;
            *steps = StepTime { cells: steps.cells + cells, gpu_ms: steps.gpu_ms + gpu_ms };
        }
    }
}
