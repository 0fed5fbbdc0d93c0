//! Unpacks the program of the page while it is loaded. Packed by LZMA it is a third smaller than in a format that browsers unpack themselves.
#![cfg(target_arch = "wasm32")]

use lzma_rust2::{Action, LzmaStream, Status};
use wasm_bindgen::prelude::wasm_bindgen;

/// The buffer for unpacked bytes grows by this much at a time \[bytes\].
const PIECE: usize = 1 << 18;

/// Unpacks a file that `squeezefilm-bindgen` has packed, piece by piece.
#[wasm_bindgen]
pub struct Unpacker(LzmaStream);

#[wasm_bindgen]
impl Unpacker {
    /// An unpacker that has not received any bytes yet.
    #[wasm_bindgen(constructor)]
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(LzmaStream::new_mem_limit(u32::MAX, None))
    }

    /// Takes the next piece of the packed file, and returns the bytes that are unpacked then.
    pub fn push(&mut self, mut packed: &[u8]) -> Result<Vec<u8>, String> {
        let mut unpacked = Vec::new();
        loop {
            let start = unpacked.len();
            unpacked.resize(start + PIECE, 0);
            let done =
                self.0.process(packed, &mut unpacked[start..], Action::Run).map_err(|error| error.to_string())?;
            unpacked.truncate(start + done.bytes_produced);
            packed = &packed[done.bytes_consumed..];
            let stuck = done.bytes_consumed == 0 && done.bytes_produced == 0;
            if done.status == Status::StreamEnd || stuck {
                return Ok(unpacked);
            }
        }
    }

    /// Whether the whole file has been unpacked.
    pub fn is_finished(&self) -> bool {
        self.0.is_finished()
    }
}
