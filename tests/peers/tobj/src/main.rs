//! Reads an OBJ file with tobj and prints the sum of its heights.

use std::io::BufReader;
use std::{env, fs::File};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = env::args().nth(1).ok_or("no file")?;
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut BufReader::new(File::open(path)?), &tobj::LoadOptions::default(), no_materials)?;
    let sum: f64 = models.iter().flat_map(|model| model.mesh.positions.iter().skip(2).step_by(3)).sum();
    println!("{sum}");
    Ok(())
}
