//! The `squeezefilm` program: arguments to command.

fn main() {}
