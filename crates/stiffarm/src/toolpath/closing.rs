//! Do both ends of an arc lie on one radius, as far as rounded files can say it?

/// By how much the radii at both ends may differ whatever the arc, m: 0.0005 in, as `LinuxCNC` has it.
const CLOSES: f64 = 1.27e-5;

/// Where that is less than this share of the radius, they may differ more, as `LinuxCNC` has it ..
const SHARE: f64 = 1e-3;

/// .. up to 0.05 in, m.
const MOST: f64 = 1.27e-3;

/// By how much the radii at both ends of an arc may differ.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Closing {
    /// What the decimals of the file make of them, m.
    rounding: f64,
}

impl Closing {
    /// Of a file that writes lengths of a unit, in m, with so many decimals at most; no file is taken to be coarser than `least` decimals:
    /// what it writes so far may be whole by chance. Both ends and the centre are rounded, which moves the radii apart by two of the last decimal.
    pub(super) fn of_decimals(unit: f64, decimals: u8, least: u8) -> Self {
        Self { rounding: 2.0 * unit * 0.1_f64.powi(i32::from(decimals.max(least))) }
    }

    /// They are one, whatever the radius.
    pub(super) fn is_tight(self, miss: f64) -> bool {
        miss <= CLOSES.max(self.rounding)
    }

    /// They are one for an arc of this radius, m.
    pub(super) fn holds(self, miss: f64, radius: f64) -> bool {
        self.is_tight(miss) || miss <= MOST.min(SHARE * radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INCH: f64 = 25.4e-3;

    /// The limits of `LinuxCNC`: 0.0005 in, and up to 0.05 in under 0.1 % of the radius.
    #[test]
    fn radii_may_differ_as_linuxcnc_has_it_and_by_what_rounding_makes() {
        let fine = Closing::of_decimals(INCH, 4, 3);
        for (miss, radius, expected) in [
            (0.000_49, 0.1, true),
            (0.000_51, 0.1, false),
            (0.001, 2.0, true),
            (0.001, 0.9, false),
            (0.049, 60.0, true),
            (0.051, 600.0, false),
        ] {
            assert_eq!(fine.holds(miss * INCH, radius * INCH), expected, "{miss} of {radius}");
        }
        // 0.01 mm is 0.02 mm at both ends; without decimals nobody knows, and it is taken so.
        for (decimals, miss, expected) in
            [(2, 1.9e-5, true), (2, 2.1e-5, false), (0, 2.1e-5, false), (3, 1.4e-5, false)]
        {
            assert_eq!(Closing::of_decimals(1e-3, decimals, 2).is_tight(miss), expected, "{decimals} {miss}");
        }
        assert!(!fine.is_tight(f64::NAN) && !fine.holds(f64::NAN, 1.0));
    }
}
