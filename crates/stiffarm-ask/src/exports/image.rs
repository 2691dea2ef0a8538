//! A map as an image in the plane straight ahead (`.vti`): every layer at every point of its grid.

use stiffarm::model::Model;

use super::{Numbers, array, file};
use crate::answer::MapAnswer;

/// The file.
pub(crate) fn image(answer: &MapAnswer) -> String {
    let grid = &answer.map.deflection;
    let (x, z) = (&grid.x, &grid.z);
    let layers = answer.layers();
    let y = if let Model::Planar(model) = &answer.model { model.aside() } else { 0.0 };
    let arrays: String =
        layers.iter().map(|layer| array(layer.field.key, 1, Numbers::Float64(&layer.cells()))).collect();
    let extent = format!("0 {} 0 0 0 {}", x.count - 1, z.count - 1);
    let shown = layers.first().map_or("", |layer| layer.field.key);
    file(
        "ImageData",
        &format!(
            "<ImageData WholeExtent=\"{extent}\" Origin=\"{} {y} {}\" Spacing=\"{} 1 {}\">\n<Piece Extent=\"{extent}\">\n\
             <PointData Scalars=\"{shown}\">\n{arrays}</PointData>\n</Piece>\n</ImageData>\n",
            x.at(0),
            z.at(0),
            x.step,
            z.step
        ),
    )
}
