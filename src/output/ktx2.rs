//! KTX 2.0 textures: what a GPU takes as it stands in the file (Khronos, "KTX File Format Specification", version 2.0).

use std::io;

use ::ktx2::{ColorPrimaries, Format, Header, Index, LevelIndex, TransferFunction, dfd};

/// An array texture of four channels, one level, not compressed. Linear light with the primaries of BT.2020.
pub struct Ktx2<'a> {
    /// Texels in a row, rows, and layers.
    pub size: [u32; 3],
    /// Bytes of a channel: 2 for half floats, 4 for single ones.
    pub channel_bytes: u8,
    /// Keys and values, in any order; keys that begin with `KTX` are the format's own.
    pub entries: Vec<(String, String)>,
    /// Layer by layer, row by row from the top left, channels R, G, B, A, little-endian.
    pub texels: &'a [u8],
}

/// Where the data format descriptor begins: after the header and the place of one level.
const DESCRIPTOR_AT: usize = Header::LENGTH + LevelIndex::LENGTH;

impl Ktx2<'_> {
    /// The file.
    ///
    /// # Errors
    /// The descriptor of the format is not known.
    pub fn to_bytes(&self) -> io::Result<Vec<u8>> {
        let (descriptor, entries) = (self.descriptor()?, self.key_values());
        let entries_at = DESCRIPTOR_AT + descriptor.len();
        let texels_at = (entries_at + entries.len()).next_multiple_of(4 * usize::from(self.channel_bytes));
        let index = Index {
            dfd_byte_offset: DESCRIPTOR_AT as u32,
            dfd_byte_length: descriptor.len() as u32,
            kvd_byte_offset: entries_at as u32,
            kvd_byte_length: entries.len() as u32,
            sgd_byte_offset: 0,
            sgd_byte_length: 0,
        };
        let length = self.texels.len() as u64;
        let level = LevelIndex { byte_offset: texels_at as u64, byte_length: length, uncompressed_byte_length: length };
        let mut file = [&self.header(index).as_bytes()[..], &level.as_bytes(), &descriptor, &entries].concat();
        file.resize(texels_at, 0);
        file.extend(self.texels);
        Ok(file)
    }

    fn format(&self) -> Format {
        if self.channel_bytes == 2 { Format::R16G16B16A16_SFLOAT } else { Format::R32G32B32A32_SFLOAT }
    }

    fn header(&self, index: Index) -> Header {
        let [pixel_width, pixel_height, layer_count] = self.size;
        Header {
            format: Some(self.format()),
            type_size: self.channel_bytes.into(),
            pixel_width,
            pixel_height,
            pixel_depth: 0,
            layer_count,
            face_count: 1,
            level_count: 1,
            supercompression_scheme: None,
            index,
        }
    }

    fn descriptor(&self) -> io::Result<Vec<u8>> {
        let (mut basic, _) = dfd::Basic::from_format(self.format()).map_err(io::Error::other)?;
        basic.color_primaries = Some(ColorPrimaries::BT2020);
        basic.transfer_function = Some(TransferFunction::Linear);
        let block = dfd::Block::Basic(basic).to_vec();
        Ok([&(4 + block.len() as u32).to_le_bytes()[..], &block].concat())
    }

    /// Keys and values as the format has them: sorted, ended by zeros, each filled up to whole words.
    fn key_values(&self) -> Vec<u8> {
        let mut sorted: Vec<_> = self.entries.iter().collect();
        sorted.sort();
        let mut bytes = Vec::new();
        for (key, value) in sorted {
            bytes.extend((key.len() as u32 + value.len() as u32 + 2).to_le_bytes());
            bytes.extend([key.as_bytes(), &[0], value.as_bytes(), &[0]].concat());
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comes_back_as_it_was_written() {
        for channel_bytes in [2_u8, 4] {
            let texels: Vec<u8> = (0..u32::from(channel_bytes) * 4 * 30).map(|k| k as u8).collect();
            let entries = [("KTXwriter", "soapfilm"), ("Film", "water"), ("KTXorientation", "rd")];
            let entries = entries.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec();
            let file = Ktx2 { size: [3, 5, 2], channel_bytes, entries, texels: &texels }.to_bytes().unwrap();
            let read = ::ktx2::Reader::new(&file).unwrap();
            let header = read.header();
            assert_eq!([header.pixel_width, header.pixel_height, header.layer_count], [3, 5, 2]);
            assert_eq!(read.levels().next().unwrap().data, texels);
            let keys: Vec<_> = read.key_value_data().collect();
            let expected: [(&str, &[u8]); 3] =
                [("Film", b"water\0"), ("KTXorientation", b"rd\0"), ("KTXwriter", b"soapfilm\0")];
            assert_eq!(keys, expected);
            assert_eq!(read.color_primaries(), Some(ColorPrimaries::BT2020));
            assert_eq!(read.transfer_function(), Some(TransferFunction::Linear));
        }
    }

    /// The header word by word, as the specification has it: what is read must not only agree with what wrote it.
    #[test]
    fn the_header_is_that_of_the_specification() {
        let file = Ktx2 { size: [3, 5, 2], channel_bytes: 2, entries: Vec::new(), texels: &[7; 240] }.to_bytes();
        let file = file.unwrap();
        assert_eq!(file[..12], *b"\xABKTX 20\xBB\r\n\x1A\n");
        let word = |at: usize| u32::from_le_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]]);
        // VK_FORMAT_R16G16B16A16_SFLOAT is 97; one face, one level, no supercompression.
        let words: Vec<u32> = (0..9).map(|k| word(12 + 4 * k)).collect();
        assert_eq!(words, [97, 2, 3, 5, 0, 2, 1, 1, 0]);
        assert_eq!([word(48), word(52), word(104)], [104, 92, 92], "one basic block of four samples");
        assert_eq!((word(80) as usize, word(88)), (file.len() - 240, 240));
        assert_eq!(word(80) % 8, 0, "texels begin at a whole texel");
    }
}
