//! Unpacks the program of the page: LZMA makes it a third smaller than what browsers unpack themselves.
#![cfg(target_arch = "wasm32")]

use lzma_rust2::LzmaReader;
use std::io::Read;
use wasm_bindgen::prelude::wasm_bindgen;

/// The bytes that were packed by `squeezefilm-bindgen`.
#[wasm_bindgen]
pub fn unpack(packed: &[u8]) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut reader = LzmaReader::new_mem_limit(packed, u32::MAX, None).map_err(|error| error.to_string())?;
    reader.read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}
