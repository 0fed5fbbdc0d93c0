//! AV1 in an MP4: one track, the index before the data, so that it plays while it arrives.
//!
//! A player does not repeat by itself, so the packets of a cycle stand in the file several times. The boxes are those of
//! ISO/IEC 14496-12 and of the AV1 binding to it; what is known of the pictures is a comment as Apple's programs write it,
//! which nearly all readers know.

use shiguredo_mp4::boxes::{
    Av01Box, Av1cBox, Brand, DinfBox, FtypBox, HdlrBox, MdhdBox, MdiaBox, MediaHeader, MinfBox, MoovBox, MvhdBox,
    SampleEntry, StblBox, StcoBox, StscBox, StscEntry, StsdBox, StssBox, StszBox, SttsBox, SttsEntry, TkhdBox, TrakBox,
    UnknownBox, VisualSampleEntryFields, VmhdBox,
};
use shiguredo_mp4::{BoxSize, BoxType, Either, Encode, FixedPointNumber, LanguageCode, Mp4FileTime, Uint};
use squeezefilm_video::Video;
use std::io::{self, Write};
use std::num::NonZeroU32;

/// OBU types.
const SEQUENCE_HEADER: u8 = 1;
const TEMPORAL_DELIMITER: u8 = 2;

/// How a video is shown.
pub(super) struct Timing {
    /// Units of a second.
    pub(super) timescale: u32,
    /// Units that a frame stays.
    pub(super) step: u32,
    /// How often the cycle is there.
    pub(super) cycles: u32,
}

/// Writes a video, with a comment unless it is empty.
pub(super) fn write(video: &Video, timing: &Timing, comment: &str, out: &mut dyn Write) -> io::Result<()> {
    let samples = video.packets.iter().map(|packet| sample(packet)).collect::<Option<Vec<Vec<u8>>>>();
    let samples = samples.ok_or_else(|| io::Error::other("a packet is no AV1"))?;
    let brands = vec![Brand::ISOM, Brand::ISO6, Brand::AV01, Brand::MP41];
    let ftyp = FtypBox { major_brand: Brand::ISOM, minor_version: 0x200, compatible_brands: brands };
    let ftyp = ftyp.encode_to_vec().map_err(failed)?;
    // The index is as long wherever the data begin.
    let ahead = ftyp.len() + moov(video, timing, &samples, comment, 0)?.len() + 8;
    let moov = moov(video, timing, &samples, comment, ahead)?;
    let cycle: usize = samples.iter().map(Vec::len).sum();
    let data = narrow(8 + cycle * timing.cycles as usize)?;
    out.write_all(&ftyp)?;
    out.write_all(&moov)?;
    out.write_all(&data.to_be_bytes())?;
    out.write_all(b"mdat")?;
    for _ in 0..timing.cycles {
        samples.iter().try_for_each(|sample| out.write_all(sample))?;
    }
    Ok(())
}

/// A packet without delimiters, which a container has no use for.
fn sample(packet: &[u8]) -> Option<Vec<u8>> {
    let kept = obus(packet)?.into_iter().filter(|(kind, _)| *kind != TEMPORAL_DELIMITER);
    Some(kept.map(|(_, obu)| obu).collect::<Vec<_>>().concat())
}

/// The OBUs of a packet, each with its type; `None` if they do not end where the packet does.
fn obus(mut packet: &[u8]) -> Option<Vec<(u8, &[u8])>> {
    let mut obus = Vec::new();
    while let [header, rest @ ..] = packet {
        // With an extension, or without its size, none leaves our encoder.
        if header & 0b1000_0110 != 0b10 {
            return None;
        }
        let digits = 1 + rest.iter().position(|byte| byte & 0x80 == 0)?;
        let size = rest[..digits]
            .iter()
            .rev()
            .try_fold(0usize, |size, byte| size.checked_mul(128).map(|size| size + usize::from(byte & 0x7f)))?;
        let (obu, after) = packet.split_at_checked(size.checked_add(1 + digits)?)?;
        obus.push((header >> 3, obu));
        packet = after;
    }
    Some(obus)
}

/// The index, for data that begin at `ahead`.
fn moov(video: &Video, timing: &Timing, samples: &[Vec<u8>], comment: &str, ahead: usize) -> io::Result<Vec<u8>> {
    let in_cycle = narrow(samples.len())?;
    let count = in_cycle.checked_mul(timing.cycles).ok_or_else(too_large)?;
    let duration = u64::from(count) * u64::from(timing.step);
    let timescale = NonZeroU32::new(timing.timescale).ok_or_else(|| io::Error::other("there is no unit of time"))?;
    let cycle: usize = samples.iter().map(Vec::len).sum();
    let sizes = samples.iter().map(|sample| narrow(sample.len())).collect::<io::Result<Vec<u32>>>()?;
    let offsets = (0..timing.cycles).map(|i| narrow(ahead + i as usize * cycle)).collect::<io::Result<Vec<u32>>>()?;
    let starts = (0..timing.cycles).filter_map(|i| NonZeroU32::new(i * in_cycle + 1)).collect();
    // Two runs of a program give the same file: it has no time of its own.
    let time = Mp4FileTime::from_secs(0);
    let stbl_box = StblBox {
        stsd_box: StsdBox { entries: vec![SampleEntry::Av01(av01(video, samples)?)] },
        stts_box: SttsBox { entries: vec![SttsEntry { sample_count: count, sample_delta: timing.step }] },
        ctts_box: None,
        cslg_box: None,
        stsc_box: StscBox {
            entries: vec![StscEntry {
                first_chunk: NonZeroU32::MIN,
                sample_per_chunk: in_cycle,
                sample_description_index: NonZeroU32::MIN,
            }],
        },
        stsz_box: StszBox::Variable { entry_sizes: sizes.repeat(timing.cycles as usize) },
        stco_or_co64_box: Either::A(StcoBox { chunk_offsets: offsets }),
        stss_box: Some(StssBox { sample_numbers: starts }),
        sdtp_box: None,
        unknown_boxes: Vec::new(),
    };
    let mdia_box = MdiaBox {
        mdhd_box: MdhdBox {
            creation_time: time,
            modification_time: time,
            timescale,
            duration,
            language: LanguageCode::UNDEFINED,
        },
        hdlr_box: HdlrBox { handler_type: HdlrBox::HANDLER_TYPE_VIDE, name: b"squeezefilm\0".to_vec() },
        minf_box: MinfBox {
            media_header: Some(MediaHeader::Vmhd(VmhdBox::default())),
            dinf_box: DinfBox::LOCAL_FILE,
            stbl_box,
            unknown_boxes: Vec::new(),
        },
        unknown_boxes: Vec::new(),
    };
    let side =
        |length: usize| i16::try_from(length).map(|length| FixedPointNumber::new(length, 0)).map_err(|_| too_large());
    let tkhd_box = TkhdBox {
        flag_track_enabled: true,
        flag_track_in_movie: true,
        flag_track_in_preview: false,
        flag_track_size_is_aspect_ratio: false,
        creation_time: time,
        modification_time: time,
        track_id: 1,
        duration,
        layer: TkhdBox::DEFAULT_LAYER,
        alternate_group: TkhdBox::DEFAULT_ALTERNATE_GROUP,
        volume: TkhdBox::DEFAULT_VIDEO_VOLUME,
        matrix: TkhdBox::DEFAULT_MATRIX,
        width: side(video.width)?,
        height: side(video.height)?,
    };
    let moov = MoovBox {
        mvhd_box: MvhdBox {
            creation_time: time,
            modification_time: time,
            timescale,
            duration,
            rate: MvhdBox::DEFAULT_RATE,
            volume: MvhdBox::DEFAULT_VOLUME,
            matrix: MvhdBox::DEFAULT_MATRIX,
            next_track_id: 2,
        },
        trak_boxes: vec![TrakBox { tkhd_box, edts_box: None, mdia_box, unknown_boxes: Vec::new() }],
        mvex_box: None,
        unknown_boxes: if comment.is_empty() { Vec::new() } else { vec![about(comment)?] },
    };
    moov.encode_to_vec().map_err(failed)
}

/// What a decoder has to know before it sees a packet.
fn av01(video: &Video, samples: &[Vec<u8>]) -> io::Result<Av01Box> {
    let first = samples.first().and_then(|sample| obus(sample)).unwrap_or_default();
    let header = first.into_iter().find(|(kind, _)| *kind == SEQUENCE_HEADER);
    let (_, header) = header.ok_or_else(|| io::Error::other("the first packet has no sequence header"))?;
    let side = |length: usize| u16::try_from(length).map_err(|_| too_large());
    // As in the bitstream: BT.709, the transfer of sRGB, limited range.
    let colour = [b"nclx".as_slice(), &[0, 1, 0, 13, 0, 1, 0]].concat();
    Ok(Av01Box {
        visual: VisualSampleEntryFields {
            data_reference_index: VisualSampleEntryFields::DEFAULT_DATA_REFERENCE_INDEX,
            width: side(video.width)?,
            height: side(video.height)?,
            horizresolution: VisualSampleEntryFields::DEFAULT_HORIZRESOLUTION,
            vertresolution: VisualSampleEntryFields::DEFAULT_VERTRESOLUTION,
            frame_count: VisualSampleEntryFields::DEFAULT_FRAME_COUNT,
            compressorname: VisualSampleEntryFields::NULL_COMPRESSORNAME,
            depth: VisualSampleEntryFields::DEFAULT_DEPTH,
        },
        av1c_box: Av1cBox {
            seq_profile: Uint::new(0),
            seq_level_idx_0: Uint::new(video.level),
            seq_tier_0: Uint::new(0),
            high_bitdepth: Uint::new(0),
            twelve_bit: Uint::new(0),
            monochrome: Uint::new(0),
            chroma_subsampling_x: Uint::new(1),
            chroma_subsampling_y: Uint::new(1),
            chroma_sample_position: Uint::new(1),
            initial_presentation_delay_minus_one: None,
            config_obus: header.to_vec(),
        },
        unknown_boxes: vec![plain(*b"colr", colour)],
    })
}

fn about(comment: &str) -> io::Result<UnknownBox> {
    let bytes = |inner: UnknownBox| inner.encode_to_vec().map_err(failed);
    // Text in UTF-8, of no country.
    let text = [&[0, 0, 0, 1, 0, 0, 0, 0], comment.as_bytes()].concat();
    let item = plain(*b"\xa9cmt", bytes(plain(*b"data", text))?);
    let list = plain(*b"ilst", bytes(item)?);
    let handler = plain(*b"hdlr", [[0; 8].as_slice(), b"mdirappl", &[0; 9]].concat());
    let meta = plain(*b"meta", [vec![0; 4], bytes(handler)?, bytes(list)?].concat());
    Ok(plain(*b"udta", bytes(meta)?))
}

fn plain(kind: [u8; 4], payload: Vec<u8>) -> UnknownBox {
    let box_type = BoxType::Normal(kind);
    UnknownBox { box_type, box_size: BoxSize::with_payload_size(box_type, payload.len() as u64), payload }
}

fn narrow(number: usize) -> io::Result<u32> {
    u32::try_from(number).map_err(|_| too_large())
}

fn too_large() -> io::Error {
    io::Error::other("the video is too large for an MP4")
}

fn failed(error: shiguredo_mp4::Error) -> io::Error {
    io::Error::other(error.reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_are_taken_apart_and_broken_ones_are_refused() {
        // A delimiter, a sequence header of three bytes, a frame of 130 (two digits of its size).
        let frame = [vec![0x32, 0x82, 0x01], vec![7; 130]].concat();
        let packet = [[0x12, 0x00, 0x0a, 0x03, 1, 2, 3].as_slice(), &frame].concat();
        assert_eq!(sample(&packet).unwrap(), packet[2..]);
        let kinds: Vec<_> = obus(&packet).unwrap().into_iter().map(|(kind, obu)| (kind, obu.len())).collect();
        assert_eq!(kinds, [(2, 2), (1, 5), (6, 133)]);
        for broken in [&packet[..20], &[0x12], &[0x10, 0], &[0x16, 0, 0], &[0x0a, 0xff, 0xff]] {
            assert!(obus(broken).is_none(), "{broken:?}");
        }
        assert!(obus(&[0x0a, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]).is_none());
        let video = Video { width: 16, height: 16, level: 0, packets: vec![vec![0x12]] };
        let timing = Timing { timescale: 1, step: 1, cycles: 1 };
        assert!(write(&video, &timing, "", &mut Vec::new()).unwrap_err().to_string().contains("no AV1"));
        let video = Video { packets: vec![vec![0x12, 0]], ..video };
        assert!(write(&video, &timing, "", &mut Vec::new()).unwrap_err().to_string().contains("no sequence header"));
    }
}
