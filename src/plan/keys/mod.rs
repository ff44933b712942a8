//! The keys of products: for each, exactly what its pass reads.

mod bubble;
mod camera;
mod environment;
mod film;
mod history;
mod optics;
mod parts;
mod picture;
mod plate;
mod rest;
mod step;

pub(in crate::plan) use bubble::samples;
pub use bubble::{Body, BodyKind, BubbleKey, LentFilm, SmallBubble};
pub use camera::CameraKey;
pub use environment::{DefocusKey, EnvironmentKey};
pub use film::{FieldKey, FilmBoundary, FilmKey, OpenHoleKey};
pub use optics::{OpticsKey, QuadratureKey, TableKey, range_nm};
pub use picture::{BackdropKey, DrawKey, FilmColours, LightKey, Lighting, Rendering, TonemapKey, exposed_ev};
pub use plate::PlateKey;
pub use rest::RestingFilm;

pub use crate::physics::{
    bubble::Opening,
    film::{
        FlowLaw, FreeFlow,
        model::{MAX_RIM_PATCHES, remaining_nm},
        properties::BLACK_FILM_NM,
    },
    timeline::Moment,
};
