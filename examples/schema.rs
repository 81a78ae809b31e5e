//! Writes the schemas of the JSON reports to `docs/`: `cargo run --example schema`.

use slopegen::report::schema::PUBLISHED;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    PUBLISHED.iter().try_for_each(|published| std::fs::write(docs.join(published.file()), published.text()))
}
