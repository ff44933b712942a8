//! Random scenes and random texts.

use super::super::*;
use crate::Words;
use proptest::prelude::*;

fn film() -> impl Strategy<Value = Film> {
    let named = "(glycerol [0-9]{1,2}%|[a-z]{1,6}\\.csv)".prop_map(FilmIndexName::Named);
    let index = prop_oneof![Just(FilmIndexName::Water), (1.0..4.0).prop_map(FilmIndexName::Constant), named];
    (any_of(), 1.0..10_000.0, -5.0..5.0, index, 0.0..5.0, any::<u64>(), 16u32..=1024, any_of()).prop_map(
        |(state, thickness_nm, stratification, index, skin_nm, seed, cells, detail)| Film {
            state,
            thickness_nm,
            stratification,
            index,
            skin_nm,
            seed,
            cells,
            detail,
        },
    )
}

fn bubble() -> impl Strategy<Value = Bubble> {
    let rim = (30.0..175.0, 0.0..20.0, 0.0..10.0, 0.1..100.0);
    (prop::array::uniform3(-1e3..1e3), 0.1..5e3, rim, film()).prop_map(
        |(center_m, radius_mm, (rim_deg, wire_mm, regeneration, patch_mm), film)| Bubble {
            center_m,
            radius_mm,
            boundary: Boundary::Free,
            rim_deg,
            wire_mm,
            regeneration,
            patch_mm,
            film,
        },
    )
}

fn camera() -> impl Strategy<Value = Camera> {
    let lens = (prop::option::of(1.0..5000.0), 1.0..500.0, keyframes());
    (prop::array::uniform3(-1e3..1e3), -1e9..1e9, -90.0..90.0, 0.0..1e3, 1.0..170.0, 0.0..180.0, lens).prop_map(
        |(
            target_m,
            azimuth_deg,
            elevation_deg,
            distance_m,
            fov_y_deg,
            follow_deg,
            (focal_mm, sensor_mm, keyframes),
        )| Camera {
            focal_mm,
            sensor_mm,
            follow_deg,
            target_m,
            azimuth_deg,
            elevation_deg,
            distance_m,
            fov_y_deg,
            keyframes,
        },
    )
}

/// Some keyframes a second apart, each with some of the numbers.
fn keyframes() -> impl Strategy<Value = Vec<Keyframe>> {
    let numbers = (prop::option::of(-1e6..1e6), prop::option::of(-90.0..90.0), prop::option::of(0.0..1e3));
    let lens = prop::option::of(1.0..5000.0);
    let keyframe = (0.0..0.9, prop::option::of(prop::array::uniform3(-1e3..1e3)), numbers, lens, any_of());
    let keyframe = keyframe.prop_map(|(time_s, target_m, (azimuth_deg, elevation_deg, distance_m), focal_mm, ease)| {
        Keyframe { time_s, target_m, azimuth_deg, elevation_deg, distance_m, focal_mm, fov_y_deg: None, ease }
    });
    prop::collection::vec(keyframe, 0..4).prop_map(|mut keyframes| {
        keyframes.iter_mut().zip(0..).for_each(|(keyframe, second)| keyframe.time_s += f64::from(second));
        keyframes
    })
}

fn lens() -> impl Strategy<Value = Lens> {
    let finish = (0.0..0.5, 0.0..4.0, 0.0..0.5);
    (0.0..200.0, prop::option::of(0.01..1e3), 0u32..=16, 0.0..10.0, finish).prop_map(
        |(aperture_mm, focus_m, blades, shutter_s, (glare, vignetting_ev, grain))| Lens {
            aperture_mm,
            focus_m,
            blades,
            shutter_s,
            glare,
            vignetting_ev,
            grain,
        },
    )
}

fn radiance() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(0.0..65504.0)
}

fn light() -> impl Strategy<Value = Light> {
    let file = "[a-z \\\\\"'é/]{0,8}\\.(exr|hdr)".prop_map(Environment::File);
    let environment = prop_oneof![
        Just(Environment::Tent),
        Just(Environment::Windows),
        Just(Environment::Park),
        Just(Environment::Studio),
        file
    ];
    let patches = (prop::collection::vec(patch(), 0..3), prop::collection::vec(lamp(), 0..3));
    let spectrum = prop::option::of(spectrum());
    (environment, (illuminant(), spectrum), prop::option::of(radiance()), -1e9..1e9, 0.0..1e4, patches).prop_map(
        |(environment, (illuminant, spectrum), constant, rotation_deg, intensity, (patches, lamps))| Light {
            environment,
            illuminant,
            spectrum,
            constant,
            rotation_deg,
            intensity,
            patches,
            lamps,
        },
    )
}

fn illuminant() -> impl Strategy<Value = String> {
    "[A-Z][A-Z0-9\"]{0,4}"
}

fn spectrum() -> impl Strategy<Value = LightSpectrum> {
    prop::collection::btree_map(360u16..=780, 0.1..1e12, 2..30).prop_map(|points| LightSpectrum {
        wavelengths_nm: points.keys().map(|nm| f64::from(*nm)).collect(),
        power: points.into_values().collect(),
    })
}

fn patch() -> impl Strategy<Value = LightPatch> {
    let place = (-1e9..1e9, -90.0..90.0, 1.0..180.0, 0.0..90.0);
    (place, illuminant(), prop::option::of(radiance())).prop_map(
        |((azimuth_deg, elevation_deg, radius_deg, edge_deg), illuminant, radiance)| LightPatch {
            azimuth_deg,
            elevation_deg,
            radius_deg,
            edge_deg,
            illuminant,
            radiance,
        },
    )
}

fn lamp() -> impl Strategy<Value = LightLamp> {
    let place = (-1e9..1e9, -90.0..90.0, -1e9..1e9);
    let size = (0.05..120.0, 0.05..120.0, 0.0..30.0);
    (any_of(), place, size, 0.0..1e6, prop::option::of(1e3..25e3)).prop_map(
        |(shape, (azimuth_deg, elevation_deg, roll_deg), (width_deg, height_deg, edge_deg), luminance, kelvin)| {
            LightLamp {
                shape,
                azimuth_deg,
                elevation_deg,
                roll_deg,
                width_deg,
                height_deg,
                edge_deg,
                luminance,
                kelvin,
            }
        },
    )
}

fn view() -> impl Strategy<Value = View> {
    let backdrop = prop_oneof![Just(Backdrop::Environment), radiance().prop_map(Backdrop::Radiance)];
    let look = (any_of(), prop::option::of(-1e9..1e9), any::<bool>());
    let plate = prop::option::of("[a-z \\\\\"'é/]{0,8}\\.(png|jpg|exr|hdr)");
    (-20.0..20.0, (backdrop, plate), look, any::<bool>(), any::<u64>()).prop_map(
        |(exposure_ev, (backdrop, plate), (quality, polariser_deg, white_balance), dither, dither_seed)| View {
            exposure_ev,
            backdrop,
            plate,
            quality,
            polariser_deg,
            white_balance,
            dither,
            dither_seed,
        },
    )
}

fn any_of<T: Words + std::fmt::Debug>() -> impl Strategy<Value = T> {
    prop::sample::select(T::CHOICES)
}

fn motion() -> impl Strategy<Value = Motion> {
    let spins = (spin(), 0.0..1000.0, any_of());
    let ends = (0.0..1.0, 0.0..10.0, 0.0..1e6, 1.0..1e4, 0.0..1e6);
    let forces = (gravity(), 0.0..1000.0, 0.0..10.0, 0.0..1e6, 0.0..1000.0, 0.0..1e4, 0.0..1000.0);
    (1e-4..0.1, any_of(), 0.0..10.0, any::<u64>(), spins, forces, ends, 1u32..=1000, 0.01..100.0).prop_map(
        |(tick_s, flow, strength, seed, (spin_deg_s, evaporation_nm_s, scheme), forces, ends, remap_ticks, speed)| {
            Motion {
                tick_s,
                flow,
                strength,
                seed,
                gravity_m_s2: forces.0,
                drag_1_s: forces.1,
                air_drag: forces.2,
                viscosity_mm2_s: forces.3,
                diffusion_mm2_s: forces.4,
                drainage: forces.5,
                surface_viscosity_upa_s_m: forces.6,
                spin_deg_s,
                evaporation_nm_s,
                humidity: ends.0,
                air_speed_m_s: ends.1,
                black_film_life_s: ends.2,
                burst_slowdown: ends.3,
                renew_s: ends.4,
                scheme,
                remap_ticks,
                speed,
            }
        },
    )
}

fn spin() -> impl Strategy<Value = [f64; 3]> {
    [-3600.0..3600.0, -3600.0..3600.0, -3600.0..3600.0]
}

fn gravity() -> impl Strategy<Value = [f64; 3]> {
    [-1000.0..1000.0, -1000.0..1000.0, -1000.0..1000.0]
}

fn event() -> impl Strategy<Value = Event> {
    let change = prop_oneof![motion_change(), stir(), blow(), drag(), prick()];
    (any::<u64>(), change).prop_map(|(tick, change)| Event { tick, change })
}

/// Some of the keys that an event can change.
fn motion_change() -> impl Strategy<Value = Change> {
    let seed = |(motion, keeps): (Motion, bool)| {
        let start =
            if keeps { Motion { strength: 3.0, seed: motion.seed, ..motion.clone() } } else { Motion::default() };
        Change::Motion(MotionChange { seed: Some(motion.seed), ..MotionChange::between(&start, &motion) })
    };
    (motion(), any::<bool>()).prop_map(seed)
}

fn direction() -> impl Strategy<Value = [f64; 3]> {
    [0.1..1.0, -1.0..1.0, -1.0..1.0]
}

fn stir() -> impl Strategy<Value = Change> {
    (direction(), [-10.0..10.0, -10.0..10.0, -10.0..10.0], 3.0..90.0, 1u64..=100_000).prop_map(
        |(at, velocity_m_s, radius_deg, ticks)| Change::Stir(Stir { bubble: 0, at, velocity_m_s, radius_deg, ticks }),
    )
}

fn blow() -> impl Strategy<Value = Change> {
    (direction(), direction(), 0.0..30.0, 3.0..90.0, 1u64..=100_000).prop_map(
        |(at, toward, speed_m_s, radius_deg, ticks)| {
            Change::Blow(Blow { bubble: 0, at, toward, speed_m_s, radius_deg, ticks })
        },
    )
}

fn drag() -> impl Strategy<Value = Change> {
    prop::array::uniform3(-1e3..1e3).prop_map(|to_m| Change::Drag(Drag { bubble: 0, to_m }))
}

fn prick() -> impl Strategy<Value = Change> {
    direction().prop_map(|at| Change::Prick(Prick { bubble: 0, at }))
}

fn generator() -> impl Strategy<Value = Generator> {
    let place =
        (prop::array::uniform3(-1e3..1e3), prop::array::uniform3(0.0..1e3), any_of(), 1u32..10_000, any::<u64>());
    let look = (0.1..5e3, 0.0..0.95, 1u32..=16, 0.0..0.9, 0.0..0.3);
    let way = (0.1..1e6, direction(), 0.0..20.0, 0.0..180.0, prop::array::uniform3(-50.0..50.0), -10.0..10.0, 0.0..1e4);
    (place, look, way, film()).prop_map(|(place, look, way, film)| {
        let (center_m, size_m, layout, count, seed) = place;
        let (radius_mm, radius_spread, films, thickness_spread, wobble) = look;
        let (life_s, direction, speed_m_s, spread_deg, wind_m_s, rise_m_s, wander_mm) = way;
        Generator {
            layout,
            count,
            seed,
            center_m,
            size_m,
            radius_mm,
            radius_spread,
            films,
            thickness_spread,
            life_s,
            direction,
            speed_m_s,
            spread_deg,
            wobble,
            wind_m_s,
            rise_m_s,
            wander_mm,
            film: Film { cells: film.cells.min(128), thickness_nm: film.thickness_nm.max(10.0), ..film },
        }
    })
}

fn scene() -> impl Strategy<Value = Scene> {
    let lists = (
        prop::collection::vec(bubble(), 0..4),
        prop::collection::vec(generator(), 0..3),
        prop::collection::vec(event(), 0..4),
    );
    (lists, (camera(), lens()), light(), view(), motion()).prop_map(
        |((bubbles, generators, mut events), (camera, lens), light, view, motion)| {
            events.sort_by_key(|event| event.tick);
            if bubbles.is_empty() {
                events.retain(|event| event.change.bubble().is_none());
            }
            Scene { version: VERSION, bubbles, generators, camera, lens, light, view, motion, events }
        },
    )
}

proptest! {
    #[test]
    fn random_scenes_round_trip(scene in scene()) {
        prop_assert_eq!(scene.validate(), Ok(()));
        prop_assert_eq!(Scene::from_toml(&scene.to_toml(), "random"), Ok(scene));
    }

    /// Whatever the text, reading ends in a scene or in one line.
    #[test]
    fn random_texts_never_panic(text in "(version = 1\n)?([\\[\\]a-z_.=\"0-9 \n{},é-]|bubble|film|event|\\[\\[){0,40}") {
        if let Err(error) = Scene::from_toml(&text, "random") {
            prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error);
        }
    }
}
