//! What is laid over the picture, drawn anew when the picture or a film has changed.

use std::time::Duration;

use super::{Due, View, readbacks::FETCH};
use crate::{
    app::{
        model::Model,
        overlay::{FalseColour, Map, Streamlines},
    },
    plan::{DrawKey, TonemapKey},
    studio::FilmView,
};

/// What an overlay was made of.
pub(super) struct Overlaid {
    draw: DrawKey,
    /// How many films had been read, what the colours show, whether there are streamlines, and the line of a profile.
    made_of: (u64, FalseColour, bool, Option<[glam::DVec2; 2]>),
}

impl View {
    /// Reads the films in sight, and draws what is laid over them.
    pub(super) fn overlay(&mut self, model: &mut Model, due: &mut Due) {
        let Some(TonemapKey { draw, .. }) = self.shown.as_ref().filter(|_| model.overlay.reads()) else {
            (model.overlay.map, model.overlay.streamlines, self.overlaid) = (None, Streamlines::default(), None);
            return;
        };
        let Some(renderer) = self.stage.drawing.renderer() else { return };
        if !self.reader.read_all(renderer, draw, due.now) {
            return due.after(FETCH);
        }
        let line = model.overlay.profile.as_ref().map(|profile| profile.ends);
        let made_of = (self.reader.reads(), model.overlay.of, model.overlay.shows_streamlines, line);
        if self.overlaid.as_ref().is_some_and(|known| known.made_of == made_of && known.draw == *draw) {
            return;
        }
        let view = FilmView::new(draw, self.reader.films());
        let time_s = model.clock.time_s(&model.scene.motion);
        let overlay = &mut model.overlay;
        overlay.map =
            Some(overlay.of).filter(|of| *of != FalseColour::None).and_then(|of| Map::new(of, &view, draw.size));
        overlay.streamlines =
            if overlay.shows_streamlines { Streamlines::new(&view, draw.size) } else { Streamlines::default() };
        if let Some(profile) = &mut overlay.profile {
            let bubbles = &model.scene.bubbles;
            profile.read(&view, draw.size, time_s, |film| {
                bubbles.get(film).map_or(0.0, |bubble| bubble.film.thickness_nm)
            });
        }
        self.overlaid = Some(Overlaid { draw: draw.clone(), made_of });
        // The panels have not shown it yet.
        due.after(Duration::ZERO);
    }
}
