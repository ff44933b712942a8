//! A log-log plot as SVG.

use std::fmt::Write;

/// Points of one kind.
pub struct Series {
    /// What they are.
    pub name: String,
    /// Run time and error of each, both above zero.
    pub points: Vec<[f64; 2]>,
}

const SIZE: [f64; 2] = [720.0, 480.0];
const MARGIN: [f64; 2] = [70.0, 45.0];
const COLOURS: [&str; 6] = ["#7a3b8f", "#c0582a", "#1f7a5c", "#2a5fa8", "#8a7a1f", "#a02850"];

/// One axis: powers of ten from the one below the smallest value to the one above the largest.
struct Axis {
    decades: [i32; 2],
    pixels: [f64; 2],
}

impl Axis {
    fn over(values: impl Iterator<Item = f64> + Clone, pixels: [f64; 2]) -> Self {
        let low = values.clone().fold(f64::MAX, f64::min).log10().floor() as i32;
        let high = values.fold(f64::MIN, f64::max).log10().ceil() as i32;
        Self { decades: [low, high.max(low + 1)], pixels }
    }

    fn at(&self, value: f64) -> f64 {
        let [low, high] = self.decades.map(f64::from);
        let part = (value.log10() - low) / (high - low);
        self.pixels[0] + part * (self.pixels[1] - self.pixels[0])
    }
}

/// Draws error over run time, with a legend.
pub fn svg(labels: [&str; 2], series: &[Series]) -> String {
    let values = |axis: usize| series.iter().flat_map(|series| &series.points).map(move |point| point[axis]);
    let x = Axis::over(values(0), [MARGIN[0], SIZE[0] - 160.0]);
    let y = Axis::over(values(1), [SIZE[1] - MARGIN[1], 20.0]);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        SIZE[0], SIZE[1]
    );
    // Writing to a string cannot fail.
    let mut line = |from: [f64; 2], to: [f64; 2], label: &str, place: [f64; 2]| {
        let _ = writeln!(
            text,
            "<path d=\"M{} {}L{} {}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{label}</text>",
            from[0], from[1], to[0], to[1], place[0], place[1]
        );
    };
    for decade in x.decades[0]..=x.decades[1] {
        let at = x.at(10f64.powi(decade));
        line([at, y.pixels[0]], [at, y.pixels[1]], &format!("1e{decade}"), [at + 12.0, y.pixels[0] + 16.0]);
    }
    for decade in y.decades[0]..=y.decades[1] {
        let at = y.at(10f64.powi(decade));
        line([x.pixels[0], at], [x.pixels[1], at], &format!("1e{decade}"), [x.pixels[0] - 6.0, at + 4.0]);
    }
    for (series, colour) in series.iter().zip(COLOURS.iter().cycle()) {
        for [time, error] in &series.points {
            let _ = writeln!(
                text,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4\" fill=\"{colour}\"/>",
                x.at(*time),
                y.at(*error)
            );
        }
    }
    for (row, (series, colour)) in series.iter().zip(COLOURS.iter().cycle()).enumerate() {
        let (left, top) = (x.pixels[1] + 16.0, 30.0 + 18.0 * row as f64);
        let _ = writeln!(text, "<circle cx=\"{left}\" cy=\"{}\" r=\"4\" fill=\"{colour}\"/>", top - 4.0);
        let _ = writeln!(text, "<text x=\"{}\" y=\"{top}\">{}</text>", left + 10.0, series.name);
    }
    let _ = writeln!(text, "<text x=\"{}\" y=\"{}\">{}</text>", MARGIN[0], SIZE[1] - 8.0, labels[0]);
    let _ = writeln!(text, "<text x=\"8\" y=\"14\">{}</text>\n</svg>", labels[1]);
    text
}
