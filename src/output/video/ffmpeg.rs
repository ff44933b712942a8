//! MP4 and WebM through an `ffmpeg` of the system, which takes raw frames through a pipe.

use std::{
    io::{self, Read, Write},
    path::Path,
    process::{Child, ChildStdin, Command, Stdio},
    thread::JoinHandle,
};

use super::{Encoder, Video, VideoError, VideoFormat};
use crate::physics::colour::Gamut;

/// Whether there is an ffmpeg with the encoder that a video needs.
pub fn check(video: &Video) -> Result<(), VideoError> {
    let encoder = encoder(video.format);
    let asked = Command::new("ffmpeg").args(["-hide_banner", "-encoders"]).stdin(Stdio::null()).output();
    let listed = asked.map_err(|_| VideoError::NoFfmpeg(video.format.ending()))?.stdout;
    if String::from_utf8_lossy(&listed).split_whitespace().any(|word| word == encoder) {
        return Ok(());
    }
    let ending = video.format.ending();
    Err(VideoError::Unable(format!(
        "the ffmpeg of this system cannot write .{ending} files, for it lacks the encoder {encoder}: install a full ffmpeg, or write a .gif or .apng"
    )))
}

fn encoder(format: VideoFormat) -> &'static str {
    if format == VideoFormat::WebM { "libvpx-vp9" } else { "libx264" }
}

/// The arguments of ffmpeg for a video that it writes to a file.
fn arguments(video: &Video) -> Vec<String> {
    let ([width, height], [numerator, denominator]) = (video.size, video.rate.ratio());
    let from = if video.has_alpha { "rgba" } else { "rgb0" };
    let to = if video.has_alpha { "yuva420p" } else { "yuv420p" };
    let primaries = if video.gamut == Gamut::DisplayP3 { "smpte432" } else { "bt709" };
    let input = format!(
        "-hide_banner -loglevel error -y -f rawvideo -pixel_format {from} -video_size {width}x{height} -framerate {numerator}/{denominator} -i pipe:0"
    );
    // Without the matrix, ffmpeg takes that of old television; without the tags, players guess by the size.
    let filter = format!(
        "-vf scale=in_range=full:out_range=limited:out_color_matrix=bt709:flags=accurate_rnd+full_chroma_int,format={to},setparams=range=limited:colorspace=bt709:color_primaries={primaries}:color_trc=bt709"
    );
    let tags = format!("-color_range tv -colorspace bt709 -color_primaries {primaries} -color_trc bt709");
    let encoder = encoder(video.format);
    let quality = match video.format {
        VideoFormat::WebM => format!("-c:v {encoder} -crf 20 -b:v 0 -row-mt 1 -deadline good -cpu-used 3 -f webm"),
        _ => format!("-c:v {encoder} -crf 15 -preset medium -movflags +faststart -f mp4"),
    };
    let words = [input, filter, tags, quality];
    let mut arguments: Vec<String> = words.iter().flat_map(|words| words.split(' ')).map(str::to_owned).collect();
    for (key, value) in video.metadata.entries() {
        arguments.extend(["-metadata".to_owned(), format!("{}={value}", key.to_ascii_lowercase())]);
    }
    arguments
}

/// A run of ffmpeg.
pub struct Ffmpeg {
    program: Child,
    frames: Option<ChildStdin>,
    told: Option<JoinHandle<String>>,
}

impl Ffmpeg {
    /// Starts ffmpeg, which writes to a file.
    pub fn begin(video: &Video, file: &Path) -> io::Result<Self> {
        let mut command = Command::new("ffmpeg");
        command.args(arguments(video)).arg(file);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // An interrupt at the terminal is for this program: ffmpeg ends when its frames do.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut program = command.spawn()?;
        let frames = program.stdin.take();
        let mut errors = program.stderr.take();
        // Read while it writes: it would wait for a full pipe.
        let told = std::thread::spawn(move || {
            let mut told = Vec::new();
            let _ = errors.as_mut().map(|errors| errors.read_to_end(&mut told));
            String::from_utf8_lossy(&told).into_owned()
        });
        Ok(Self { program, frames, told: Some(told) })
    }

    /// Waits for its end; why it failed, if it did.
    fn end(&mut self) -> io::Result<()> {
        drop(self.frames.take());
        let status = self.program.wait()?;
        let told = self.told.take().and_then(|told| told.join().ok()).unwrap_or_default();
        if status.success() {
            return Ok(());
        }
        let last = told.lines().rfind(|line| !line.trim().is_empty()).unwrap_or("it does not say why").trim();
        Err(io::Error::other(format!("ffmpeg failed ({status}): {last}")))
    }
}

impl Encoder for Ffmpeg {
    fn add(&mut self, rgba: &[u8]) -> io::Result<()> {
        let Some(frames) = &mut self.frames else { return Ok(()) };
        match frames.write_all(rgba) {
            // It has ended, and says why.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => self.end().and(Err(error)),
            written => written,
        }
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.end()
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        // After its end both do nothing.
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}
