//! `squeezefilm-bindgen PROGRAM.wasm FOLDER`: writes the program as a page wants it, with the JavaScript that loads it. The same as
//! `wasm-bindgen --target web`, without a program to install whose version has to fit.

use std::error::Error;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [program, folder] = &arguments[..] else { return Err("two arguments: PROGRAM.wasm FOLDER".into()) };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(program).web(true)?.typescript(false).omit_default_module_path(false).out_name("squeezefilm");
    Ok(bindgen.generate(folder)?)
}
