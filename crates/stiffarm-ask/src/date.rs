//! On which day was it asked?

use std::time::{SystemTime, UNIX_EPOCH};

/// Seconds of a day.
const DAY: u64 = 86_400;

/// Today as year-month-day, UTC; where `SOURCE_DATE_EPOCH` is set (reproducible-builds.org), the day of that.
pub fn today() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.trim().parse().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    day(given.unwrap_or_else(now))
}

/// Of seconds since 1970, by the calendar of Gregory: 400 years have 146097 days, and years begin in March, so that a leap day comes last.
fn day(seconds: u64) -> String {
    let days = seconds / DAY + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let of_month = of_year - (153 * month + 2) / 5 + 1;
    let (year, month) = if month < 10 { (year, month + 3) } else { (year + 1, month - 9) };
    format!("{:04}-{month:02}-{of_month:02}", 400 * era + year)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every day of four hundred years by counting the days of months one after the other.
    #[test]
    fn every_day_of_four_hundred_years_is_as_counted() {
        let (mut year, mut month, mut of_month) = (1970, 1, 1);
        for days in 0..146_097 {
            assert_eq!(day(days * DAY + 4711), format!("{year:04}-{month:02}-{of_month:02}"));
            let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
            let length = [31, if is_leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31][month - 1];
            of_month += 1;
            if length < of_month {
                (of_month, month) = (1, month + 1);
            }
            if 12 < month {
                (month, year) = (1, year + 1);
            }
        }
    }
}
