//! `squeezefilm-bindgen PROGRAM.wasm FOLDER NAME` writes the program for a page, with the JavaScript that loads it. It does the same as
//! `wasm-bindgen --target web`, which would have to be installed in the matching version.
//!
//! `squeezefilm-bindgen pack FILE PACKED`: packs a file for `squeezefilm-unpack`.

use lzma_rust2::{LzmaOptions, LzmaWriter};
use std::error::Error;
use std::io::Write;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["pack", file, packed] => {
            let bytes = std::fs::read(file)?;
            let mut options = LzmaOptions::with_preset(9);
            (options.nice_len, options.pb) = (273, 0);
            // The unpacker allocates a dictionary of this size.
            options.dict_size = u32::try_from(bytes.len())?.next_power_of_two();
            let mut writer = LzmaWriter::new_use_header(Vec::new(), &options, Some(bytes.len() as u64))?;
            writer.write_all(&bytes)?;
            Ok(std::fs::write(packed, writer.finish()?)?)
        }
        [program, folder, name] => {
            let mut bindgen = Bindgen::new();
            bindgen.input_path(program).web(true)?.typescript(false).omit_default_module_path(false).out_name(name);
            Ok(bindgen.generate(folder)?)
        }
        _ => Err("PROGRAM.wasm FOLDER NAME, or pack FILE PACKED".into()),
    }
}
