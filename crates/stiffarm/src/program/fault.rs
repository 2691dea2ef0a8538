//! Why is no program written, and of which line?

use crate::toolpath::of_line;

/// What a program cannot hold: the line of the path or the key, what was found, and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProgramFault {
    /// Nothing to write.
    #[error("{stations} places of the robot; expected at least 2, from where to where")]
    TooFew {
        /// That there are.
        stations: usize,
    },
    /// The name of the program.
    #[error("the program's name '{name}': expected a letter, then letters, digits and _, at most {most} of them")]
    Name {
        /// As it was given, on one line.
        name: String,
        /// How many signs.
        most: usize,
    },
    /// An option of the writer.
    #[error("{key} = {value}: expected {expected}")]
    Option {
        /// Which.
        key: &'static str,
        /// As it was given.
        value: String,
        /// What makes sense.
        expected: &'static str,
    },
    /// Joints that nobody may give a controller.
    #[error(
        "{robot}: no joints are written: it is not known whether the pendant shows the joints as the robot file counts them; \
         expected pendant = \"as-file\" with its source, or [verified], in the robot file, or pendant-as-file"
    )]
    Pendant {
        /// Which.
        robot: String,
    },
    /// A tool that is not there.
    #[error("{}tool {tool} of {tools}; expected one of those of the setup, counted from 0", of_line(*line))]
    NoTool {
        /// Of the path.
        line: usize,
        /// From 0.
        tool: usize,
        /// How many there are.
        tools: usize,
    },
    /// Several tools where nothing can stop for a change.
    #[error("a table or trajectory of joints does not stop where the tool is changed; expected the path of one tool")]
    Tools,
    /// A joint angle.
    #[error("{}joint {joint} at {} deg: expected a number of at most {most_deg} deg", of_line(*line), angle.to_degrees())]
    Joint {
        /// Of the path.
        line: usize,
        /// From 1.
        joint: usize,
        /// rad.
        angle: f64,
        /// deg.
        most_deg: f64,
    },
    /// A cutting move without a feed rate.
    #[error(
        "{}no feed rate: expected one in the path (F, FEDRAT, a column feed_mm_per_min), or feed-mm-per-min for all of it",
        of_line(*line)
    )]
    NoFeed {
        /// Of the path.
        line: usize,
    },
    /// A feed rate that the language cannot say.
    #[error(
        "{}a feed rate of {} mm/s: expected {} to {} mm/s for {language}",
        of_line(*line), feed * 1e3, least * 1e3, most * 1e3
    )]
    Feed {
        /// Of the path.
        line: usize,
        /// m/s.
        feed: f64,
        /// m/s.
        least: f64,
        /// m/s.
        most: f64,
        /// Which.
        language: &'static str,
    },
}
