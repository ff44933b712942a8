//! The probe of the window says what the command line says.

use soapfilm::{
    app::probe::{Pin, Plot, Reading},
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
            flow_deg: None,
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
        one_wall(&desk, &reading, cos_theta, light);
        strip(&desk, reading, cos_theta, light);
    }
}

/// Reflectance and transmittance of the front wall alone, of s and p light together.
fn one_wall(desk: &Desk, reading: &Reading, cos_theta: f64, light: &str) {
    let nm = reading.walls[0].thickness_nm;
    let run = desk.run(&format!("colour --thickness {nm} --cos {cos_theta} --illuminant {light} --spectrum rows"));
    let rows = run.out.lines().skip(1).map(|line| line.split(',').map(|value| value.parse::<f64>().unwrap()).collect());
    let rows: Vec<Vec<f64>> = rows.collect();
    assert_eq!(rows.len(), reading.spectrum().len());
    for (row, told) in reading.spectrum().iter().zip(&rows) {
        let off = (row.r.mean() - told[1]).abs().max((row.t.mean() - told[2]).abs());
        assert!(off < 1e-9, "{row:?} {told:?}");
    }
}

/// Newton's strip and the curve of chromaticities, as they are saved.
fn strip(desk: &Desk, reading: Reading, cos_theta: f64, light: &str) {
    let pin = Pin::new(reading, (0, Vec::new()));
    let table = |plot: Plot| -> Vec<Vec<f64>> {
        let csv = pin.csv(plot);
        let rows = csv.lines().filter(|line| !line.starts_with('#')).skip(1);
        rows.map(|row| row.split(',').map(|value| value.parse().unwrap()).collect()).collect()
    };
    let (colours, chromaticities) = (table(Plot::Strip), table(Plot::Chromaticity));
    for point in [20, 64, 171, 300] {
        let nm = colours[point][0];
        let told = xyz(desk, &format!("--thickness {nm} --cos {cos_theta} --illuminant {light}"));
        let found = DVec3::from_slice(&colours[point][1..4]);
        assert!((found - told).abs().max_element() < 1e-9, "{nm} nm: {found} {told}");
        let sum = told.element_sum();
        let [x, y] = [chromaticities[point][1], chromaticities[point][2]];
        assert!((x - told.x / sum).abs() < 1e-9 && (y - told.y / sum).abs() < 1e-9, "{nm} nm: {x} {y}");
    }
}
