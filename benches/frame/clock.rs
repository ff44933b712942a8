//! The clock that costs are read from.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use soapfilm::gpu::{Gpu, Renderer};

/// A GPU that has waited runs slowly at first: for so long it works before it is measured.
const WARM_UP: Duration = Duration::from_millis(300);

/// What counts as the cost of some work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// CPU time of the process. Where a program draws in place of a GPU, it holds all that is drawn, and it is steadier than wall time.
    Process,
    /// Time of the passes on the GPU.
    Gpu,
}

impl Clock {
    /// The clocks that tell something on a device, the one that holds all that is drawn first.
    pub fn all(gpu: &Gpu) -> &'static [Self] {
        let is_program = gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        if is_program || !gpu.can_time() { &[Self::Process] } else { &[Self::Gpu, Self::Process] }
    }

    /// The clock that holds all that is drawn on a device.
    pub fn of(gpu: &Gpu) -> Self {
        Self::all(gpu)[0]
    }

    /// What the clock shows, for headings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Process => "CPU time",
            Self::Gpu => "GPU time",
        }
    }

    /// The median cost of some work in milliseconds, once the device is warm. The work must end with a wait for the device.
    pub fn median_ms(self, renderer: &mut Renderer, rounds: usize, mut work: impl FnMut(&mut Renderer)) -> f64 {
        self.warm_up(|| work(renderer));
        median((0..rounds).map(|_| self.ms(renderer, &mut work)).collect())
    }

    /// Does some work once, and on a GPU until that is warm.
    pub fn warm_up(self, mut work: impl FnMut()) {
        let start = Instant::now();
        work();
        while self == Self::Gpu && start.elapsed() < WARM_UP {
            work();
        }
    }

    /// Milliseconds of work that no pass times, which must end with a wait for the device: CPU time, or the time until a GPU has done it.
    pub fn ms_of(self, work: impl FnOnce()) -> f64 {
        let (start, cpu_start) = (Instant::now(), ProcessTime::now());
        work();
        let taken = match self {
            Self::Process => cpu_start.elapsed(),
            Self::Gpu => start.elapsed(),
        };
        taken.as_secs_f64() * 1e3
    }

    /// Milliseconds of some work, which must end with a wait for the device.
    pub fn ms(self, renderer: &mut Renderer, work: impl FnOnce(&mut Renderer)) -> f64 {
        drop(renderer.times.take());
        let start = ProcessTime::now();
        work(renderer);
        let cpu_ms = start.elapsed().as_secs_f64() * 1e3;
        match self {
            Self::Process => cpu_ms,
            Self::Gpu => renderer.times.take().iter().filter_map(|pass| pass.gpu_ms).sum(),
        }
    }
}

/// The middle one of some values.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
