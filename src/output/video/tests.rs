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
    let (path, video) = (folder.path().join("a.gif"), video(VideoFormat::Gif));
    write(&video, &path);
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut reader = options.read_info(std::fs::File::open(&path).unwrap()).unwrap();
    assert_eq!(reader.repeat(), ::gif::Repeat::Infinite);
    for (index, delay) in [(0, 4), (1, 4), (2, 5)] {
        let read = reader.read_next_frame().unwrap().unwrap();
        assert_eq!((read.delay, u32::from(read.width), u32::from(read.height)), (delay, 48, 30));
        let shown = frame(video.size, index);
        let means = |rgba: &[u8]| -> Vec<f64> {
            let block = |x: usize, y: usize, c: usize| {
                let pixels = (0..36).map(|k| rgba[4 * ((6 * y + k / 6) * 48 + 6 * x + k % 6) + c]);
                pixels.map(f64::from).sum::<f64>() / 36.0
            };
            (0..40).flat_map(|k| (0..3).map(move |c| block(k % 8, k / 8, c))).collect()
        };
        // Dithering keeps the means: 256 of the 1440 colours without it are farther off.
        let furthest = means(&read.buffer).iter().zip(means(&shown)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(furthest < 4.0, "frame {index}: {furthest}");
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
