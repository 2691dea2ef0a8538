//! Which lengths does a shop drawing have, each once?

use super::super::words::fixed;
use super::Layout;

/// A length on a drawing, along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// Along which axis: 0 ahead, 1 to the left, 2 up.
    pub axis: usize,
    /// From where to where along it, m.
    pub ends: [f64; 2],
    /// What it is.
    pub name: String,
    /// How long, in millimetres.
    pub text: String,
}

fn dimension(axis: usize, ends: [f64; 2], name: String) -> Dimension {
    Dimension { axis, ends, name, text: fixed((ends[1] - ends[0]).abs() * 1e3, 1) }
}

fn side(ahead: f64, [positive, negative]: [&'static str; 2]) -> &'static str {
    if ahead < -1e-9 { negative } else { positive }
}

fn is_flat([low, high]: [f64; 2]) -> bool {
    high - low < 1e-9
}

/// What heights count from, and its name.
fn ground(layout: &Layout) -> (f64, &'static str) {
    layout.base.floor.map_or((layout.base.foot[2], "base"), |floor| (floor, "floor"))
}

/// Where the origin of a path or a part stands, and how far that reaches.
pub(super) fn from_an_origin(layout: &Layout, origin: &str, whole: &str) -> Vec<Dimension> {
    let ([x, y, z], [ahead, left, _], (floor, ground)) = (layout.centre, layout.base.foot, ground(layout));
    let datum = layout.base.datum();
    let above = side(z - floor, ["above", "below"]);
    let mut dimensions = vec![
        dimension(2, [floor, z], format!("height of {origin} {above} the {ground}")),
        dimension(0, [ahead, x], format!("{datum} to {origin}, {}", side(x - ahead, ["ahead", "behind"]))),
        dimension(1, [left, y], format!("{origin} to the {} of the {datum}", side(y - left, ["left", "right"]))),
    ];
    for (axis, way) in [(0, "ahead"), (1, "sideways"), (2, "upwards")] {
        let ends = layout.extent(axis);
        if !is_flat(ends) {
            dimensions.push(dimension(axis, ends, format!("extent of {whole} {way}")));
        }
    }
    dimensions
}

/// Where a zone stands.
pub(super) fn of_a_zone(layout: &Layout) -> Vec<Dimension> {
    let [across, aside, up] = [0, 1, 2].map(|axis| layout.extent(axis));
    let (floor, ground) = ground(layout);
    let above = |z: f64| side(z - floor, ["above", "below"]);
    let beside = side(layout.centre[1] - layout.base.foot[1], ["left", "right"]);
    let datum = layout.base.datum();
    let mut dimensions = Vec::new();
    if is_flat(up) {
        dimensions.push(dimension(
            2,
            [floor, up[0]],
            format!("height of the worked face {} the {ground}", above(up[0])),
        ));
    } else {
        dimensions.push(dimension(
            2,
            [floor, up[0]],
            format!("height of its lowest edge {} the {ground}", above(up[0])),
        ));
        dimensions.push(dimension(2, up, "from there to its highest edge".into()));
    }
    dimensions.push(dimension(
        0,
        [layout.base.foot[0], across[0]],
        format!("{datum} to its near edge, {}", side(across[0] - layout.base.foot[0], ["ahead", "behind"])),
    ));
    if is_flat(across) {
        return dimensions;
    }
    dimensions.push(dimension(
        0,
        [layout.base.foot[0], layout.centre[0]],
        format!("{datum} to its centre, {}", side(layout.centre[0] - layout.base.foot[0], ["ahead", "behind"])),
    ));
    dimensions.push(dimension(0, across, "its extent ahead".into()));
    dimensions.push(dimension(
        1,
        [layout.base.foot[1], layout.centre[1]],
        format!("its centre to the {beside} of the {datum}"),
    ));
    if !is_flat(aside) {
        dimensions.push(dimension(1, aside, "its extent sideways".into()));
    }
    dimensions
}
