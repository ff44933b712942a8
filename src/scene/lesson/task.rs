//! Tasks: what a student is asked, and how an answer is judged.

use crate::{
    physics::{
        colour::Illuminant,
        film::properties::{DENSITY, GRAVITY, VISCOSITY},
        optics::{FilmMaterial, cos_refracted},
    },
    scene::{
        check::{Checked, Fault},
        section::section,
    },
    words::words,
};

use super::{FilmPoint, Quantity};

words! {
    /// How a task is answered.
    pub enum Kind: "kind" {
        Number = "number", "A number is typed";
        Pin = "pin", "A point of the film is pinned with the probe";
    }
}

section! {
    /// What a step asks for: `[step.task]`.
    pub struct Task, TaskKeys:
    ask: String = String::new(), ["text"], "Question", "", "the question";
    hint: String = String::new(), ["text"], "Hint", "", "what is said beside a wrong answer";
    kind: Kind = Kind::Number, [word], "Kind", "", "how it is answered";
    quantity: Quantity = Quantity::Thickness, [word], "Quantity", "", "what is asked for";
    answer: Option<f64> = None, [finite], "Answer", "", "the right answer; without it, what follows from the keys below, and where `thickness_nm` is left out, what the probe has measured at the pinned point";
    tolerance: f64 = 0.0, [0.0 ..= 1000000.0], "Tolerance", "", "how far an answer may be off, in the unit of the quantity";
    thickness_nm: Option<f64> = None, [0.0 ..= 30000.0], "Thickness", " nm", "thickness of the film in question, nm";
    angle_deg: f64 = 0.0, [0.0 ..= 89.0], "Angle", "°", "angle of incidence in air";
    wavelength_nm: f64 = 550.0, [360.0 ..= 780.0], "Wavelength", " nm", "wavelength of the light, for quantities of one wavelength";
    order: u32 = 1, [1 ..= 100], "Order", "", "order of interference, for `bright-thickness` and `dark-thickness`";
    illuminant: String = "D65".to_owned(), ["a name"], "Illuminant", "", "the light, for quantities of colour";
    to_nm: Option<f64> = None, [1.0 ..= 30000.0], "To", " nm", "thickness at the end, for times, nm";
    radius_mm: f64 = 50.0, [0.1 ..= 5000.0], "Radius", " mm", "radius of the bubble, for `drainage-time`, mm";
    evaporation_nm_s: f64 = 10.0, [0.001 ..= 1000.0], "Evaporation", " nm/s", "loss of thickness, for `evaporation-time`, nm/s";
}

/// What becomes of an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// It is right: the answer that was checked.
    Right(f64),
    /// It is wrong by this much: positive if it is too large.
    Off(f64),
}

impl Task {
    pub(super) fn check(&self) -> Checked {
        self.check_ranges()?;
        self.illuminant.parse::<Illuminant>().map_err(|error| Fault::unusable("illuminant", error))?;
        let quantity = self.quantity.name();
        match (self.kind, self.answer, self.computed()) {
            (Kind::Pin, _, _) if !self.quantity.is_of_point() => Err(Fault::new(
                "quantity",
                format!("is \"{quantity}\", which no point of a film has; ask for a number"),
            )),
            (Kind::Pin, None, _) => Err(Fault::new("answer", "is missing; say what the pinned point must have")),
            (Kind::Number, None, None) if !self.quantity.is_of_point() => {
                Err(Fault::new("quantity", format!("is \"{quantity}\"; give `thickness_nm` and, for a time, `to_nm`")))
            }
            (Kind::Number, Some(answer), Some(truth)) if (answer - truth).abs() > self.tolerance => {
                Err(Fault::new("answer", format!("is {answer}, but the physics of films says {truth:.6}")))
            }
            _ => Ok(()),
        }
    }

    /// What the optics and mechanics say is the answer, about the film that the keys describe; `None` if they leave the film open.
    fn computed(&self) -> Option<f64> {
        let (water, nm) = (FilmMaterial::default(), self.wavelength_nm);
        let n = water.index.n(nm);
        let fringe_nm = nm / (2.0 * n * cos_refracted(n, self.cos_theta()));
        Some(match self.quantity {
            Quantity::BrightThickness => (f64::from(self.order) - 0.5) * fringe_nm,
            Quantity::DarkThickness => f64::from(self.order) * fringe_nm,
            Quantity::BrewsterAngle => n.atan().to_degrees(),
            Quantity::DrainageTime => drainage_s(self.thickness_nm?, self.to_nm?, self.radius_mm),
            Quantity::EvaporationTime => (self.thickness_nm? - self.to_nm?) / self.evaporation_nm_s,
            quantity => self.film()?.measure(quantity, nm)?,
        })
    }

    /// The right answer; `None` if it is what the probe has measured, and nothing is pinned.
    #[must_use]
    pub fn right_answer(&self, pinned: Option<&FilmPoint>) -> Option<f64> {
        let measured = || pinned?.measure(self.quantity, self.wavelength_nm);
        self.answer.or_else(|| self.computed()).or_else(measured)
    }

    /// Judges a number that was typed; `None` if a point must be pinned first.
    #[must_use]
    pub fn judge_number(&self, typed: f64, pinned: Option<&FilmPoint>) -> Option<Verdict> {
        Some(self.judge(typed, self.right_answer(pinned)?))
    }

    /// Judges a pinned point; `None` for tasks of numbers.
    #[must_use]
    pub fn judge_pin(&self, pinned: &FilmPoint) -> Option<Verdict> {
        let answer = self.answer.filter(|_| self.kind == Kind::Pin)?;
        Some(self.judge(pinned.measure(self.quantity, self.wavelength_nm)?, answer))
    }

    fn judge(&self, given: f64, answer: f64) -> Verdict {
        let off = given - answer;
        // A typed decimal fraction is rounded when it is read.
        if off.abs() <= self.tolerance + 1e-9 * answer.abs() { Verdict::Right(given) } else { Verdict::Off(off) }
    }

    fn cos_theta(&self) -> f64 {
        self.angle_deg.to_radians().cos()
    }

    /// The film of water that the keys describe; `None` if they leave its thickness open.
    fn film(&self) -> Option<FilmPoint> {
        let (thickness_nm, cos_theta) = (self.thickness_nm?, self.cos_theta());
        let illuminant = self.illuminant.parse().ok()?;
        Some(FilmPoint { film: FilmMaterial::default(), illuminant, thickness_nm, cos_theta })
    }

    /// A task where no key is absent.
    pub(super) fn with_every_key() -> Self {
        Self { answer: Some(0.0), thickness_nm: Some(0.0), to_nm: Some(1.0), ..Self::default() }
    }
}

/// Time in which the top of a bubble drains between immobile surfaces from one thickness to another, s: `dh/dt = −(ρ g / 6 μ R) h³` integrated.
fn drainage_s(from_nm: f64, to_nm: f64, radius_mm: f64) -> f64 {
    let inverse_square = |nm: f64| (1e-9 * nm).powi(-2);
    let (mu, weight) = (VISCOSITY, DENSITY * GRAVITY);
    3.0 * mu * 1e-3 * radius_mm / weight * (inverse_square(to_nm) - inverse_square(from_nm))
}
