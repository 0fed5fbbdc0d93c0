//! Frames as AV1: 8 bits, 4:2:0, main profile, which every player of AV1 has.
//!
//! Colours become luma and chroma by BT.709 in the limited range, and the bitstream says so; their transfer stays that of
//! sRGB. A chroma sample stands at the left edge of its four pixels, half-way down, where players expect it: the mean of
//! both rows, weighted 1 2 1 along them.
//!
//! A crate of its own: the encoder is generic, and is compiled as the crate that calls it. The program is compiled to be small, and took four times as
//! long.

use rav1e::prelude::{
    ChromaSamplePosition, ColorDescription, ColorPrimaries, Config, Context, EncoderConfig, EncoderStatus, Frame,
    MatrixCoefficients, PixelRange, Rational, SceneDetectionSpeed, TransferCharacteristics, Tune,
};
use rayon::prelude::*;
use std::borrow::Cow;
use std::io;
use std::ops::Range;
use std::sync::{Arc, mpsc};
use std::thread;

/// Of rav1e's 0 to 10. Measured without assembler, 10 frames of 1280 × 1145: 8 takes three times as long for 0.4 times the space.
const SPEED: u8 = 10;
/// Of 0 to 255: the motor's animation 1280 pixels across stays above 45 dB.
const QUANTIZER: usize = 32;
/// Parts of a frame that are encoded at the same time. Not the number of cores: a file is the same everywhere.
const TILES: usize = 4;
/// Frames that are worth a key frame of their own, so that they are encoded at the same time as others.
const PART: usize = 24;
/// Most parts of a cycle that are encoded at the same time.
const PARTS: usize = 4;
/// No side is shorter, says the encoder.
const SHORTEST: usize = 16;
/// The figure's, for what is added at the right and below.
const BACKGROUND: [u8; 3] = [255; 3];

/// A frame by its number, from 0: red, green, blue, a byte each, row by row from the top. Called from several threads.
pub type FrameSource<'a> = dyn Fn(usize) -> io::Result<Cow<'a, [u8]>> + Sync + 'a;

/// Encodes `count` frames of `size` pixels (across, down), each shown for `step` \[s\], a fraction: of each the OBUs. The first can be decoded
/// alone, and the first of each later part of a long cycle; all others refer to those before. `done` is called after each; once `cancelled` says
/// so, no other is encoded.
///
/// # Errors
/// Those of the encoder; an interruption if it was cancelled.
pub fn encode(
    count: usize,
    picture: &FrameSource<'_>,
    size: [u32; 2],
    step: [u32; 2],
    done: &dyn Fn(),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> io::Result<Vec<Vec<u8>>> {
    let source = size.map(|length| length as usize);
    let [width, height] = source.map(|length| length.next_multiple_of(2).max(SHORTEST));
    let level = level([width, height], f64::from(step[1]) / f64::from(step[0].max(1)));
    let mut settings = EncoderConfig {
        width,
        height,
        time_base: Rational { num: step[0].into(), den: step[1].into() },
        pixel_range: PixelRange::Limited,
        color_description: Some(ColorDescription {
            color_primaries: ColorPrimaries::BT709,
            transfer_characteristics: TransferCharacteristics::SRGB,
            matrix_coefficients: MatrixCoefficients::BT709,
        }),
        chroma_sample_position: ChromaSamplePosition::Vertical,
        level_idx: Some(level),
        // A key frame at the beginning alone, and every packet is one frame, in order: the cycle can be written again and again.
        low_latency: true,
        min_key_frame_interval: 0,
        max_key_frame_interval: count as u64,
        quantizer: QUANTIZER,
        // Of drawings, not of what a camera sees.
        tune: Tune::Psnr,
        tiles: TILES,
        ..EncoderConfig::with_speed_preset(SPEED)
    };
    settings.speed_settings.scene_detection_mode = SceneDetectionSpeed::None;
    // Takes a seventh of the time, and is for what a camera saw.
    settings.speed_settings.cdef = false;
    // What a block would take is guessed from its transform, not tried: 0.73 of the time.
    settings.speed_settings.transform.tx_domain_rate = true;
    let parts = (count / PART).clamp(1, PARTS);
    let (told, tell) = mpsc::channel();
    let encoded: Vec<io::Result<Vec<Vec<u8>>>> = thread::scope(|scope| {
        let each = count.div_ceil(parts).max(1);
        let begin = |first: usize| {
            let frames = first..(first + each).min(count);
            let (settings, told) = (settings.clone(), told.clone());
            let work = move || part(frames, picture, source, settings, &told, cancelled);
            thread::Builder::new().name("video".to_owned()).spawn_scoped(scope, work)
        };
        let workers: Vec<_> = (0..count).step_by(each).map(begin).collect();
        drop(told);
        tell.iter().for_each(|()| done());
        let end = |worker: thread::ScopedJoinHandle<'_, io::Result<Vec<Vec<u8>>>>| {
            worker.join().unwrap_or_else(|_| Err(io::Error::other("the encoder has failed")))
        };
        workers.into_iter().map(|worker| worker.and_then(end)).collect()
    });
    Ok(encoded.into_iter().collect::<io::Result<Vec<_>>>()?.concat())
}

/// The packets of some frames, the first a key frame. `told` gets a message for each.
fn part(
    mut frames: Range<usize>,
    picture: &FrameSource<'_>,
    source: [usize; 2],
    settings: EncoderConfig,
    told: &mpsc::Sender<()>,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> io::Result<Vec<Vec<u8>>> {
    let size @ [width, _] = [settings.width, settings.height];
    let mut context: Context<u8> =
        Config::new().with_encoder_config(settings).new_context().map_err(io::Error::other)?;
    let mut packets = Vec::with_capacity(frames.len());
    loop {
        if cancelled() {
            return Err(io::ErrorKind::Interrupted.into());
        }
        match context.receive_packet() {
            Ok(packet) => {
                packets.push(packet.data);
                // Whoever waits for it is gone only if all is given up.
                let _ = told.send(());
            }
            Err(EncoderStatus::Encoded) => (),
            Err(EncoderStatus::NeedMoreData) => match frames.next() {
                Some(number) => {
                    let mut frame: Frame<u8> = context.new_frame();
                    let planes = planes(&picture(number)?, source, size);
                    for ((plane, samples), across) in
                        frame.planes.iter_mut().zip(&planes).zip([width, width / 2, width / 2])
                    {
                        plane.copy_from_raw_u8(samples, across, 1);
                    }
                    context.send_frame(Arc::new(frame)).map_err(io::Error::other)?;
                }
                None => context.flush(),
            },
            Err(EncoderStatus::LimitReached) => return Ok(packets),
            Err(error) => return Err(io::Error::other(error)),
        }
    }
}

/// The lowest level of AV1 that has pictures of this size at this rate \[1/s\]; 31 is above all.
fn level([width, height]: [usize; 2], rate: f64) -> u8 {
    // Index, samples of a picture, of its sides, and of a second: the specification's annex A.3.
    const LEVELS: [(u8, usize, [usize; 2], f64); 9] = [
        (0, 147_456, [2048, 1152], 4_423_680.0),
        (1, 278_784, [2816, 1584], 8_363_520.0),
        (4, 665_856, [4352, 2448], 19_975_680.0),
        (5, 1_065_024, [5504, 3096], 31_950_720.0),
        (8, 2_359_296, [6144, 3456], 70_778_880.0),
        (9, 2_359_296, [6144, 3456], 141_557_760.0),
        (12, 8_912_896, [8192, 4352], 267_386_880.0),
        (13, 8_912_896, [8192, 4352], 534_773_760.0),
        (16, 35_651_584, [16_384, 8704], 1_069_547_520.0),
    ];
    let samples = width * height;
    let fits = |(_, most, sides, per_second): &&(u8, usize, [usize; 2], f64)| {
        samples <= *most && width <= sides[0] && height <= sides[1] && samples as f64 * rate <= *per_second
    };
    LEVELS.iter().find(fits).map_or(31, |(index, ..)| *index)
}

/// Luma and both chromas of a picture, with background where it is larger than its source.
fn planes(rgb: &[u8], [across, down]: [usize; 2], [width, height]: [usize; 2]) -> [Vec<u8>; 3] {
    let rows: Vec<&[[u8; 3]]> = rgb.as_chunks().0.chunks_exact(across).take(down).collect();
    let mut planes = [vec![0; width * height], vec![0; width * height / 4], vec![0; width * height / 4]];
    let [grey, blue, red] = &mut planes;
    let chroma = blue.par_chunks_mut(width / 2).zip(red.par_chunks_mut(width / 2));
    grey.par_chunks_mut(2 * width).zip(chroma).enumerate().for_each(|(pair, (grey, (blue, red)))| {
        // Of both rows.
        let mut sums = vec![[0; 3]; width];
        for (row, grey) in grey.chunks_mut(width).enumerate() {
            let convert = |sample: &mut u8, sum: &mut [i32; 3], colour: [u8; 3]| {
                let colour = colour.map(i32::from);
                *sample = LUMA.of(colour, 0);
                (0..3).for_each(|k| sum[k] += colour[k]);
            };
            let known = rows.get(2 * pair + row).copied().unwrap_or_default();
            let (source, added) = grey.split_at_mut(known.len());
            source
                .iter_mut()
                .zip(&mut sums)
                .zip(known)
                .for_each(|((sample, sum), colour)| convert(sample, sum, *colour));
            added.iter_mut().zip(&mut sums[known.len()..]).for_each(|(sample, sum)| convert(sample, sum, BACKGROUND));
        }
        for (x, (blue, red)) in blue.iter_mut().zip(red).enumerate() {
            let near = [(2 * x).saturating_sub(1), 2 * x, 2 * x + 1].map(|column| sums[column]);
            let sum: [i32; 3] = std::array::from_fn(|k| near[0][k] + 2 * near[1][k] + near[2][k]);
            *blue = BLUE.of(sum, 3);
            *red = RED.of(sum, 3);
        }
    });
    planes
}

/// A sample as a sum of red, green and blue, in units of 2⁻¹⁶, and what it is of black.
struct Weights {
    of: [i32; 3],
    black: i32,
}

/// BT.709 in the limited range.
const LUMA: Weights = Weights { of: [11_966, 40_254, 4064], black: 16 };
const BLUE: Weights = Weights { of: [-6596, -22_189, 28_785], black: 128 };
const RED: Weights = Weights { of: [28_784, -26_145, -2639], black: 128 };

impl Weights {
    /// Of the sum of 2^`doubled` colours.
    fn of(&self, sum: [i32; 3], doubled: u32) -> u8 {
        let [r, g, b] = self.of;
        let half = 1 << (15 + doubled);
        ((r * sum[0] + g * sum[1] + b * sum[2] + (self.black << (16 + doubled)) + half) >> (16 + doubled)) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_bt_709() {
        // Bars of 100 %: white, red, green, blue, black, as ITU-R BT.709-6 has them in 8 bits.
        let bars: [([u8; 3], [u8; 3]); 5] = [
            ([255, 255, 255], [235, 128, 128]),
            ([255, 0, 0], [63, 102, 240]),
            ([0, 255, 0], [173, 42, 26]),
            ([0, 0, 255], [32, 240, 118]),
            ([0, 0, 0], [16, 128, 128]),
        ];
        for (rgb, expected) in bars {
            let found = planes(&rgb.repeat(4), [2, 2], [2, 2]);
            assert_eq!([found[0][3], found[1][0], found[2][0]], expected, "{rgb:?}");
        }
    }

    #[test]
    fn what_is_added_is_white_and_chroma_stands_at_the_left() {
        // Three columns, red red white, and one row, in a picture of 4 × 2.
        let [luma, _, red] = planes(&[255, 0, 0, 255, 0, 0, 255, 255, 255], [3, 1], [4, 2]);
        assert_eq!(luma, [63, 63, 235, 235, 235, 235, 235, 235]);
        // Half of either sample is the white row below; of the second a quarter of the rest is red.
        assert_eq!(red, [184, 142]);
    }

    #[test]
    fn levels_are_the_lowest_that_fit() {
        assert_eq!(level([200, 160], 2.0), 0);
        assert_eq!(level([720, 644], 9.0), 4);
        assert_eq!(level([1920, 1080], 30.0), 8);
        assert_eq!(level([1920, 1080], 60.0), 9);
        assert_eq!(level([720, 644], 300.0), 9);
        assert_eq!(level([4000, 3600], 15.0), 16);
        assert_eq!(level([20_000, 16], 15.0), 31);
    }
}
