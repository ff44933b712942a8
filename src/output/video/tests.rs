//! Videos that are written and read again.

use super::*;

fn video(format: VideoFormat) -> Video {
    Video {
        format,
        size: [48, 30],
        rate: "24000/1001".parse().unwrap(),
        frames: 3,
        gamut: Gamut::Srgb,
        has_alpha: false,
        metadata: Metadata::new().with("Scene", "tent"),
    }
}

/// A smooth frame with all colours, and another one for each index.
fn frame([width, height]: [u32; 2], index: u32) -> Vec<u8> {
    let pixel = |k: u32| {
        let (x, y) = (k % width, k / width);
        [(255 * x / width) as u8, (255 * y / height) as u8, (80 * index) as u8, 255]
    };
    (0..width * height).flat_map(pixel).collect()
}

/// Peak signal-to-noise ratio of two pictures, dB.
fn psnr_db(a: &[u8], b: &[u8]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2));
    // Alpha is the same.
    let mean = squares.sum::<f64>() / (0.75 * a.len() as f64);
    10.0 * (255.0_f64.powi(2) / mean).log10()
}

fn write(video: &Video, path: &Path) {
    let mut writer = video.begin(path).unwrap();
    (0..video.frames).for_each(|index| writer.add(&frame(video.size, index)).unwrap());
    writer.finish().unwrap();
}

#[test]
fn an_animated_png_holds_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (path, video) = (folder.path().join("a.apng"), video(VideoFormat::Apng));
    write(&video, &path);
    let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let control = reader.info().animation_control.unwrap();
    assert_eq!((control.num_frames, control.num_plays), (3, 0));
    for index in 0..3 {
        let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut rgba).unwrap();
        assert!(rgba == frame(video.size, index), "frame {index}");
        let control = reader.info().frame_control.unwrap();
        assert_eq!((control.delay_num, control.delay_den), (1001, 24000));
    }
    assert_eq!(reader.info().uncompressed_latin1_text[0].text, "tent");
}

#[test]
fn a_gif_is_near_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let (path, video) = (folder.path().join("a.gif"), Video { size: [160, 100], ..video(VideoFormat::Gif) });
    write(&video, &path);
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut reader = options.read_info(std::fs::File::open(&path).unwrap()).unwrap();
    assert_eq!(reader.repeat(), ::gif::Repeat::Infinite);
    for (index, delay) in [(0, 4), (1, 4), (2, 5)] {
        let read = reader.read_next_frame().unwrap().unwrap();
        assert_eq!((read.delay, u32::from(read.width), u32::from(read.height)), (delay, 160, 100));
        // 32.5 dB for a dithered gradient through all colours; frames that are mixed up are below 20.
        let near_db = psnr_db(&read.buffer, &frame(video.size, index));
        assert!(near_db > 31.0, "frame {index}: {near_db}");
    }
    assert!(reader.read_next_frame().unwrap().is_none());
}

#[test]
fn a_video_that_is_not_finished_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for format in [VideoFormat::Gif, VideoFormat::Apng] {
        let video = video(format);
        let mut writer = video.begin(&folder.path().join("a")).unwrap();
        writer.add(&frame(video.size, 0)).unwrap();
        drop(writer);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{format:?}");
    }
}

#[test]
fn what_a_format_cannot_hold_is_refused() {
    let refused = |format, change: &dyn Fn(&mut Video)| {
        let mut video = video(format);
        change(&mut video);
        video.check().unwrap_err().to_string()
    };
    assert!(refused(VideoFormat::Mp4, &|video| video.size = [49, 31]).contains("use 48x30"));
    assert!(refused(VideoFormat::Mp4, &|video| video.has_alpha = true).contains(".webm"));
    assert!(refused(VideoFormat::Gif, &|video| video.has_alpha = true).contains(".apng"));
    assert!(refused(VideoFormat::Gif, &|video| video.gamut = Gamut::DisplayP3).contains("sRGB"));
    assert!(refused(VideoFormat::Gif, &|video| video.rate = "60".parse().unwrap()).contains("--fps 50"));
    assert!(refused(VideoFormat::Gif, &|video| video.size = [70_000, 2]).contains("65535"));
}
