//! Takes plotly.js alone out of the crate that carries it together with what sets formulas, and packs it: views hold it, and few commands make views.

use std::io::Write;
use std::path::PathBuf;
use std::{env, fs};

use flate2::Compression;
use flate2::write::GzEncoder;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let scripts = plotly::Plot::offline_js_sources();
    let (_, rest) = scripts.split_once('>').expect("a script has a tag");
    let (plotly, _) = rest.split_once("</script>").expect("a script ends");
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(plotly.as_bytes()).expect("memory is written to");
    let folder = env::var_os("OUT_DIR").expect("cargo names a folder");
    fs::write(PathBuf::from(folder).join("plotly.js.gz"), packed.finish().expect("it ends"))
        .expect("the folder is there");
}
