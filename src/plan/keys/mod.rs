//! The keys of products: for each, exactly what its pass reads.

mod film;
mod history;
mod optics;
mod picture;
mod rest;

pub use film::{
    BLACK_FILM_NM, FieldKey, FilmEnd, FilmKey, FlowLaw, FlowSegment, FreeFlow, HoleKey, MAX_RIM_PATCHES, Moment,
    OpenHoleKey, PushKey, evaporated_nm, left_nm,
};
pub use optics::{BandsKey, OpticsKey, TableKey, range_nm};
pub use picture::{
    BackdropKey, BubbleKey, CameraKey, DrawKey, EnvironmentKey, LightKey, Lighting, TonemapKey, exposed_ev,
};
pub use rest::RestingFilm;
