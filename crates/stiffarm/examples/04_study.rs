//! From which size on does a quasi-serial arm suit a circle better than a serial one?

use stiffarm::study::{StudyOptions, study};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let found = study(&StudyOptions::paper())?;
    for boundary in found.boundaries.iter().filter(|boundary| boundary.task == 0) {
        let ratio = boundary.mu.map_or_else(|| "the best ratio of each".into(), |mu| format!("l3/l2 = {mu}"));
        let better = found.options.contenders[boundary.below].architecture;
        println!("{ratio}: {better} is better below d/(l2+l3) = {:.4}", boundary.size);
    }
    Ok(())
}
