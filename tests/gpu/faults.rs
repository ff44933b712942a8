//! What is lost when a device fails in the middle of a frame: the frame, and nothing that cannot be made again.

use soapfilm::{
    gpu::{Gpu, GpuError, Renderer, passes::bubble::OtherBubble},
    input::LoadedScene,
    plan::{FrameRequest, Plan},
};

use crate::support::{display, gpu, load, short_or_long, still};

const SIZE: [u32; 2] = [96, 54];
/// When the film is looked at first, and again, in seconds.
const TIMES_S: [f64; 2] = [0.2, 0.4];

/// Bubbles that move, over and in one another.
fn scene() -> LoadedScene {
    let mut loaded = load("trio");
    loaded.scene.bubbles.iter_mut().for_each(|bubble| bubble.film.cells = short_or_long(16, 64));
    loaded
}

/// A device of its own for a test that breaks it.
fn device() -> Option<Gpu> {
    gpu().map(|gpu| pollster::block_on(gpu.another()).unwrap())
}

/// What a scene shows at a time, from the side.
fn seen(loaded: &LoadedScene, time_s: f64, azimuth_deg: f64) -> FrameRequest {
    let mut turned = loaded.clone();
    turned.scene.camera.azimuth_deg += azimuth_deg;
    still(&turned, SIZE, time_s)
}

/// Renders a frame in whose middle something happens to the device: after its first submission that is waited for.
fn fail(renderer: &mut Renderer, request: &FrameRequest, happens: impl Fn(&Gpu) + Send + 'static) -> GpuError {
    let gpu = renderer.gpu.clone();
    renderer.watcher = Some(Box::new(move |_| {
        happens(&gpu);
        true
    }));
    let failed = renderer.render(request).map(|plan| passes(&plan)).unwrap_err();
    renderer.watcher = None;
    failed
}

fn passes(plan: &Plan) -> Vec<&'static str> {
    plan.steps.iter().map(|(pass, _)| pass.name()).collect()
}

/// Asks for more memory than any machine has.
fn exhaust(gpu: &Gpu) {
    let side = gpu.device.limits().max_texture_dimension_2d;
    let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 256 };
    let _ = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("more than there is"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
}

#[test]
fn a_picture_that_memory_does_not_suffice_for_is_lost_alone() {
    let Some(gpu) = device() else { return };
    let (loaded, mut renderer) = (scene(), Renderer::new(gpu.clone()));
    let [time_s, _] = TIMES_S;
    let truth = display(&mut Renderer::new(gpu), &seen(&loaded, time_s, 20.0));
    renderer.render(&seen(&loaded, time_s, 0.0)).unwrap();
    let turned = seen(&loaded, time_s, 20.0);
    let error = fail(&mut renderer, &turned, exhaust);
    assert!(matches!(error, GpuError::OutOfMemory), "{error}");
    // The films are there still.
    let plan = renderer.render(&turned).unwrap();
    assert_eq!(passes(&plan), ["draw", "tonemap"]);
    assert!(display(&mut renderer, &turned) == truth);
}

#[test]
fn a_film_that_memory_does_not_suffice_for_is_made_again() {
    let Some(gpu) = device() else { return };
    let (loaded, mut renderer) = (scene(), Renderer::new(gpu.clone()));
    let [early, late] = TIMES_S.map(|time_s| seen(&loaded, time_s, 0.0));
    let truth = display(&mut Renderer::new(gpu), &late);
    renderer.render(&early).unwrap();
    let error = fail(&mut renderer, &late, exhaust);
    assert!(matches!(error, GpuError::OutOfMemory), "{error}");
    assert!(display(&mut renderer, &late) == truth);
}

#[test]
fn a_lost_device_costs_a_frame_and_another_makes_the_same_picture() {
    let Some(gpu) = device() else { return };
    let loaded = scene();
    let [early, late] = TIMES_S.map(|time_s| seen(&loaded, time_s, 0.0));
    let turned = seen(&loaded, TIMES_S[0], 20.0);
    let truth = display(&mut Renderer::new(gpu.clone()), &late);
    // In the middle of a step of the films, and of a picture.
    for request in [&late, &turned] {
        let mut renderer = Renderer::new(pollster::block_on(gpu.another()).unwrap());
        renderer.render(&early).unwrap();
        let error = fail(&mut renderer, request, |gpu| gpu.device.destroy());
        assert!(matches!(error, GpuError::Lost(_)), "{error}");
        assert!(renderer.gpu.is_lost());
        assert!(matches!(renderer.render(&late), Err(GpuError::Lost(_))), "it stays lost, and says so");
        let mut another = Renderer::new(pollster::block_on(renderer.gpu.another()).unwrap());
        assert!(display(&mut another, &late) == truth);
    }
}

#[test]
fn more_bubbles_than_the_device_can_hold_are_refused_and_fewer_are_drawn() {
    let Some(mut renderer) = gpu().map(Renderer::new) else { return };
    let loaded = load("cloud");
    let fits = still(&loaded, SIZE, 0.0);
    let small = fits.picture.draw.small.clone();
    let many = renderer.gpu.most_values::<OtherBubble>() as usize + 1;
    let mut too_many = fits.clone();
    too_many.picture.draw.small = small.iter().copied().cycle().take(many).collect();
    let error = renderer.render(&too_many).map(|plan| passes(&plan)).unwrap_err();
    assert!(matches!(error, GpuError::TooManyBubbles { count, .. } if count == many), "{error}");
    assert!(renderer.render(&fits).unwrap().complete);
}

#[test]
fn a_picture_larger_than_textures_is_refused_before_anything_is_made_for_it() {
    let Some(gpu) = gpu() else { return };
    let side = gpu.device.limits().max_texture_dimension_2d;
    assert!(gpu.check_picture_size([side, 1]).is_ok());
    let error = gpu.check_picture_size([1, side + 1]).unwrap_err();
    assert!(error.to_string().contains(&format!("1x{} pixels does not fit", side + 1)), "{error}");
}
