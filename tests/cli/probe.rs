//! The probe of the window says what the command line says.

use soapfilm::{
    app::probe::Reading,
    glam::DVec3,
    physics::{colour::Illuminant, optics::FilmMaterial},
    plan::OpticsKey,
    studio::WallInSight,
};

use super::*;

/// The columns X, Y and Z of a command's one row.
fn xyz(desk: &Desk, arguments: &str) -> DVec3 {
    let run = desk.run(&format!("colour {arguments} --quality reference"));
    assert!(run.success, "{}", run.err);
    let mut lines = run.out.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (header, row) = (lines.next().unwrap(), lines.next().unwrap());
    let first = header.iter().position(|name| *name == "X").unwrap();
    DVec3::from_slice(&[0, 1, 2].map(|k| row[first + k].parse().unwrap()))
}

#[test]
fn the_probe_says_what_the_command_says() {
    let desk = Desk::new();
    for (front_nm, back_nm, angle_deg, light) in
        [(320.0, 500.0, 45.0, "D65"), (12.5, 1750.0, 80.0, "A"), (104.0, 104.0, 0.0, "LED-B1")]
    {
        let illuminant: Illuminant = light.parse().unwrap();
        let optics = OpticsKey { film: FilmMaterial::default(), illuminant: illuminant.into() };
        let cos_theta = f64::to_radians(angle_deg).cos();
        let wall = |thickness_nm| WallInSight {
            film: 0,
            place: DVec3::X,
            cos_theta,
            thickness_nm: Some(thickness_nm),
            speed_m_s: None,
            optics: optics.clone(),
        };
        let reading = Reading::new(&[wall(front_nm), wall(back_nm)], 0.0, 1).unwrap();
        for (wall, nm) in reading.walls.iter().zip([front_nm, back_nm]) {
            let told = xyz(&desk, &format!("--thickness {nm} --cos {cos_theta} --illuminant {light}"));
            assert!((wall.xyz - told).abs().max_element() < 1e-9, "{nm} nm: {} {told}", wall.xyz);
        }
        let run =
            desk.run(&format!("colour --thickness {front_nm} --cos {cos_theta} --back {back_nm} --spectrum rows"));
        let rows: Vec<Vec<f64>> =
            run.out.lines().skip(1).map(|line| line.split(',').map(|value| value.parse().unwrap()).collect()).collect();
        let spectrum = reading.spectrum();
        assert_eq!(spectrum.len(), rows.len());
        for (row, told) in spectrum.iter().zip(&rows) {
            assert_eq!(row.wavelength_nm, told[0]);
            let (r, t) = (row.r_both.mean(), row.t_both.mean());
            assert!((r - told[1]).abs() < 1e-9 && (t - told[2]).abs() < 1e-9, "{row:?} {told:?}");
        }
    }
}
