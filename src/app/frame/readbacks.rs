//! What a redraw reads back from the device: films for the probe, pictures to compare and to save.

use std::{path::PathBuf, sync::Arc, time::Duration};

use glam::DVec2;

use super::{Due, View, pictures::Purpose};
use crate::{
    app::{
        capture::{self, Capture},
        compare::{Pixels, Want},
        figure,
        files::Files,
        model::Model,
        panels,
        probe::{Plot, Reading, pin::Sample},
    },
    plan::TonemapKey,
    studio::{thickness_at, walls_in_sight},
};

/// Time between two polls of what is being read back.
pub(super) const FETCH: Duration = Duration::from_millis(8);

impl View {
    /// Reads what is asked of the device, and takes what has arrived.
    pub(super) fn read_back(&mut self, model: &mut Model, files: &Files, due: &mut Due) {
        // What is drawn meanwhile is read once it is there, which wakes the window.
        if self.stage.drawing.renderer().is_some() {
            self.probe(model, due);
            self.record(model, due);
            self.overlay(model, due);
        }
        self.compare(model, files, due);
        self.fetch(model, files, due);
    }

    /// Reads the film under the pointer, if the pointer asks.
    fn probe(&mut self, model: &mut Model, due: &mut Due) {
        let (Some(place), Some(TonemapKey { draw, .. })) = (model.probe.asked(), &self.shown) else { return };
        let Some(renderer) = self.stage.drawing.renderer() else { return };
        let [width, height] = draw.size.map(f64::from);
        let position = 0.5 * DVec2::new(width, height) + height * DVec2::new(place.x, -place.y);
        let walls = walls_in_sight(draw, self.reader.films(), position);
        let is_read = walls.first().is_none_or(|wall| {
            self.reader.read(renderer, wall.film, due.now).unwrap_or_else(|error| {
                model.messages.problem(format!("the film cannot be read: {error}"));
                true
            })
        });
        // What arrived just now counts.
        let walls = walls_in_sight(draw, self.reader.films(), position);
        let clock = model.clock.moment(&model.scene.motion);
        let moment = walls.first().map_or(clock, |wall| self.reader.time(renderer, draw, wall.film, clock));
        let time_s = moment.ticks() * model.scene.motion.tick_s;
        let reading = Reading::new(&walls, time_s, model.scene.bubbles.len());
        let is_new = model.answer_probe(reading, &walls, is_read);
        if !is_read {
            due.after(FETCH);
        } else if is_new {
            // The panels have not shown it yet.
            due.after(Duration::ZERO);
        }
    }

    /// Reads pictures back, to keep them, to compare them or to copy them.
    fn compare(&mut self, model: &mut Model, files: &Files, due: &mut Due) {
        if let Some(want) = model.compare.wants.take()
            && let Err(text) = self.begin_compare(model, files, want, due)
        {
            model.messages.problem(text);
        }
        let Some((want, size, readback)) = &self.compared else { return };
        // A loss is told elsewhere.
        let _ = self.stage.drawing.gpu.device.poll(wgpu::PollType::Poll);
        let (want, size) = (*want, *size);
        let Some(bytes) = readback.try_take() else { return due.after(FETCH) };
        self.compared = None;
        match bytes {
            Ok(rgba) if want == Want::Copy => {
                let size = size.map(|length| length as usize);
                self.egui.egui_ctx().copy_image(egui::ColorImage::from_rgba_unmultiplied(size, &rgba));
                model.messages.note("The picture is on the clipboard");
            }
            Ok(rgba) => files.compare(model, want, Pixels { size, rgba: Arc::new(rgba) }),
            Err(error) => model.messages.problem(format!("the picture cannot be read: {error}")),
        }
        due.after(Duration::ZERO);
    }

    /// Begins to make a picture that is asked for.
    fn begin_compare(&mut self, model: &mut Model, files: &Files, want: Want, due: &mut Due) -> Result<(), String> {
        let Some(shown) = &self.shown else { return Ok(()) };
        let Some(renderer) = self.stage.drawing.renderer() else {
            // Asked again once it is back, which wakes the window.
            model.compare.wants = Some(want);
            return Ok(());
        };
        let size = shown.draw.size;
        match want {
            Want::Reference(side) => {
                // The film must stand until it is read.
                model.clock.running = false;
                if model.behind_ticks > 0 || !self.reader.read_all(renderer, &shown.draw, due.now) {
                    model.compare.wants = Some(want);
                    due.after(FETCH);
                    return Ok(());
                }
                let films = self.reader.films().thickness_nm.clone();
                files.compute_reference(model, side, shown.clone(), films);
            }
            Want::Draw(_, quality) => {
                model.follow_keyframes();
                let request = capture::request_in(model, size, quality)?;
                self.ask_for_picture(request, Purpose::Compare(want));
                due.after(Duration::ZERO);
            }
            Want::Map if model.compare.other.is_some() => {
                let other = model.compare.other.clone();
                other.into_iter().for_each(|(pixels, _)| files.compare(model, want, pixels));
            }
            Want::Keep | Want::Map | Want::Copy => {
                self.compared = renderer.read_picture().map(|readback| (want, size, readback));
            }
        }
        Ok(())
    }

    /// Notes how thick the film is at the pinned place.
    fn record(&mut self, model: &mut Model, due: &mut Due) {
        let moment = model.clock.moment(&model.scene.motion);
        let (Some(pin), Some(TonemapKey { draw, .. })) = (&mut model.probe.pinned, &self.shown) else { return };
        let Some(renderer) = self.stage.drawing.renderer() else { return };
        let (film, places) = &pin.places;
        // A failure is told by the probe itself.
        let is_read = self.reader.read(renderer, *film, due.now).unwrap_or(true);
        if !is_read {
            return due.after(FETCH);
        }
        let Some(thickness_nm) = thickness_at(draw, self.reader.films(), *film, places) else { return };
        let time_s = self.reader.time(renderer, draw, *film, moment).ticks() * model.scene.motion.tick_s;
        let wall = |index: usize| thickness_nm.get(index).copied();
        if pin.record(Sample { time_s, thickness_nm: [wall(0), wall(1)] }) {
            due.after(Duration::ZERO);
        }
    }

    /// Starts to save a plot of the pinned point as a picture.
    pub fn capture_plot(&mut self, model: &Model, plot: Plot, path: PathBuf) {
        let Some(pin) = &model.probe.pinned else { return };
        let is_uniform = model.probe.is_uniform;
        self.capture_figure(model, path, |ui| {
            panels::pin_plots::show(ui, pin, plot, is_uniform, ui.available_size());
        });
    }

    /// Starts to save the plot of the profile as a picture.
    pub fn capture_profile(&mut self, model: &Model, path: PathBuf) {
        let Some(profile) = &model.overlay.profile else { return };
        self.capture_figure(model, path, |ui| {
            // Two lines of text stand below the plot.
            panels::overlay::chart(ui, profile, ui.available_height() - 44.0);
        });
    }

    fn capture_figure(&mut self, model: &Model, path: PathBuf, content: impl Fn(&mut egui::Ui)) {
        let (readback, size) = figure::draw(&self.stage.drawing.gpu, content);
        self.captures.push(Capture { readback, size, radiance: false, path, metadata: capture::metadata(model) });
    }

    fn fetch(&mut self, model: &mut Model, files: &Files, due: &mut Due) {
        let gpu = &self.stage.drawing.gpu;
        self.captures.retain(|capture| {
            capture.poll(gpu, files).unwrap_or_else(|error| {
                model.messages.problem(format!("the picture is not saved: {error}"));
                false
            })
        });
        if !self.captures.is_empty() {
            due.after(FETCH);
        }
    }
}
