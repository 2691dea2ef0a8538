//! How thick is a robot? Radii of the capsules that stand for its links.

/// Of the capsules along the links, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// About the joint-1 axis, up to the height of the joint-2 axis.
    pub column: f64,
    /// Joint-2 axis to elbow.
    pub upper_arm: f64,
    /// Elbow to wrist centre.
    pub forearm: f64,
    /// Wrist centre to flange.
    pub wrist: f64,
}

impl Body {
    /// A guess where no radius is known: a column of `0.085 (m L)^(1/4)`, m, with the payload `m` in kg and the reach `L` in m, or of
    /// `0.15 L` where no payload is known; upper arm, forearm and wrist of 0.55, 0.45 and 0.33 of that.
    ///
    /// Coarse: half the width of the base plates of common robots lies within a third of it, from 90 mm (3 kg, 0.6 m) to 400 mm (500 kg,
    /// 2.6 m).
    pub fn estimated(payload_kg: Option<f64>, reach: f64) -> Self {
        let column = payload_kg.map_or(0.15 * reach, |kg| 0.085 * (kg * reach).sqrt().sqrt());
        Self { column, upper_arm: 0.55 * column, forearm: 0.45 * column, wrist: 0.33 * column }
    }

    /// Of a spindle that fits the wrist: six tenths of its radius, m.
    pub fn spindle(&self) -> f64 {
        0.6 * self.wrist
    }
}

impl From<[f64; 4]> for Body {
    fn from([column, upper_arm, forearm, wrist]: [f64; 4]) -> Self {
        Self { column, upper_arm, forearm, wrist }
    }
}

impl From<Body> for [f64; 4] {
    fn from(body: Body) -> Self {
        [body.column, body.upper_arm, body.forearm, body.wrist]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the width of the base plate, m, by payload, kg, and reach, m, of robots from the smallest to the largest.
    #[test]
    fn an_estimated_column_is_about_as_thick_as_base_plates_are() {
        for (kg, reach, half_width) in
            [(3.0, 0.58, 0.09), (20.0, 1.65, 0.256), (185.0, 2.8, 0.36), (500.0, 2.55, 0.395)]
        {
            for body in [Body::estimated(Some(kg), reach), Body::estimated(None, reach)] {
                assert!((body.column / half_width - 1.0).abs() < 0.35, "{kg} kg: {body:?}");
            }
        }
        // 0.085 x (81 x 1)^(1/4) = 0.255.
        let body = Body::estimated(Some(81.0), 1.0);
        let by_hand = [0.255, 0.14025, 0.11475, 0.08415];
        assert!(<[f64; 4]>::from(body).iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-12), "{body:?}");
        assert!((body.spindle() - 0.05049).abs() < 1e-12);
    }
}
