//! How is a robot drawn in every figure, so that no other is drawn the same beside it?

use stiffarm::catalogue::paper_names;
use stiffarm::drive::Architecture;
use stiffarm::palette::{QUASI_SERIAL_CURVES, SERIAL_CURVES};

/// So many robots of each architecture are distinguished in one figure.
const STYLES: usize = SERIAL_CURVES.len();

/// The colour and the mark of one robot: warm where it is serial, cool where it is quasi-serial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RobotStyle {
    /// Of its lines, bars and marks.
    pub colour: &'static str,
    /// Which of six marks, 0 to 5, so that it stays apart in a print without colour.
    pub mark: usize,
}

/// The styles of the robots of one figure, the most important first: `None` for those that find no style that nobody has yet.
///
/// A robot has the style of its name wherever that is free, so it is drawn the same in every figure: the paper's ten always
/// among themselves. Where another has it, it takes the next.
pub fn styles(robots: &[(&str, Architecture)]) -> Vec<Option<RobotStyle>> {
    let mut found = vec![None; robots.len()];
    for (architecture, colours) in
        [(Architecture::Serial, SERIAL_CURVES), (Architecture::QuasiSerial, QUASI_SERIAL_CURVES)]
    {
        let members: Vec<usize> = (0..robots.len()).filter(|&i| robots[i].1 == architecture).take(STYLES).collect();
        let numbers: Vec<usize> = members.iter().map(|&i| number(robots[i].0)).collect();
        let mut taken = [false; STYLES];
        // Whose own style nobody before it has keeps it; the others take what is left.
        let is_first = |k: &usize| !numbers[..*k].contains(&numbers[*k]);
        let (first, others): (Vec<usize>, Vec<usize>) = (0..members.len()).partition(is_first);
        for k in first.into_iter().chain(others) {
            let free = (0..STYLES).map(|step| (numbers[k] + step) % STYLES).find(|&style| !taken[style]);
            if let Some(style) = free {
                taken[style] = true;
                found[members[k]] = Some(RobotStyle { colour: colours[style], mark: style });
            }
        }
    }
    found
}

/// The number of a robot's own style.
fn number(name: &str) -> usize {
    // The paper lists the architectures in turn: five pairs, which are five numbers for each.
    if let Some(at) = paper_names().iter().position(|known| *known == name) {
        return at / 2;
    }
    // FNV-1a: the same in every build.
    let hash = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    (hash % STYLES as u64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm::catalogue::{paper_robots, robots};

    #[test]
    fn the_papers_robots_look_the_same_in_every_order_and_choice() {
        let ten = paper_robots();
        let named: Vec<(&str, Architecture)> =
            ten.iter().map(|robot| (robot.name.as_str(), robot.architecture)).collect();
        let all = styles(&named);
        assert!(all.iter().all(Option::is_some));
        let turned: Vec<_> = named.iter().rev().copied().collect();
        assert!(styles(&turned).into_iter().rev().eq(all.iter().copied()));
        for (i, one) in named.iter().enumerate() {
            assert_eq!(styles(&[*one]), [all[i]], "{}", one.0);
        }
    }

    #[test]
    fn no_two_robots_of_a_figure_look_the_same() {
        let known = robots();
        let named: Vec<(&str, Architecture)> =
            known.iter().map(|robot| (robot.name.as_str(), robot.architecture)).collect();
        for chunk in named.chunks(23).chain([&named[..]]) {
            let found: Vec<RobotStyle> = styles(chunk).into_iter().flatten().collect();
            for (i, style) in found.iter().enumerate() {
                assert!(!found[..i].contains(style), "{style:?} stands twice");
            }
            for architecture in Architecture::ALL {
                let members = chunk.iter().filter(|(_, of)| *of == architecture).count();
                let given = styles(chunk);
                let with = given.iter().zip(chunk).filter(|(style, (_, of))| style.is_some() && *of == architecture);
                assert_eq!(with.count(), members.min(STYLES));
            }
        }
    }
}
