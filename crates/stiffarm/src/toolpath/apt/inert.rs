//! Which statements move nothing, and which move all that follows?

/// What is known of a statement that is no motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Inert {
    /// It tells of the tool, the job, the control or the post, by this name.
    Known(&'static str),
    /// It shifts, turns or copies the path.
    Shifts,
    Unknown,
}

/// What they tell of tools and spindles, whoever writes them: SOLIDWORKS CAM, `CAMWorks`, NX, CATIA, Creo, and posts for `CAMplete` and Vericut.
const TOOLS: [&str; 18] = [
    "TLDATA", "LOAD", "LOADTL", "UNLOAD", "SELECT", "SELCTL", "CUTTER", "TOOLNO", "TPRINT", "TLCHG", "OFSTNO", "CLAMP",
    "COOLNT", "CATMAT", "HOLDER", "TLONPS", "TURRET", "AIR",
];

/// Of the job, its remarks and its stops.
const JOB: [&str; 30] = [
    "TOOL PATH",
    "PARTNO",
    "PPRINT",
    "INSERT",
    "REMARK",
    "PAINT",
    "DISPLY",
    "LETTER",
    "PLOT",
    "PPLOT",
    "PLABEL",
    "LEADER",
    "SETUP",
    "STOP",
    "OPSTOP",
    "OPSKIP",
    "BREAK",
    "DELAY",
    "END",
    "REWIND",
    "TMARK",
    "SEQNO",
    "ISN",
    "PROGRM",
    "HEADER",
    "LIBRY",
    "SAVEL",
    "TIME",
    "STOCK",
    "FIXTURE",
];

/// Of tolerances, the machine and the post.
const POST: [&str; 31] = [
    "MACHIN", "AUXFUN", "PREFUN", "PPFUN", "INTOL", "OUTTOL", "TOLER", "LINTOL", "MCHTOL", "PPTOL", "TOLTBL", "MODE",
    "MULTAX", "AUTOPS", "CHECK", "PROTOL", "CLPRNT", "NOPOST", "CLEARP", "OPTYPE", "SET", "SLOWDN", "PSIS", "THICK",
    "CANON", "VERIFY", "DRAFT", "POSTN", "COUPLE", "MAXDPM", "CONTRL",
];

/// What moves all points behind it.
const SHIFTS: [&str; 10] =
    ["TRACUT", "TRANS", "ORIGIN", "ROTABL", "ROTATE", "ROTHED", "COPY", "INDEX", "SCALE", "MIRROR"];

/// Of those that hold a text, blanks part it from the name, not only the stroke.
const TEXTS: [&str; 6] = ["PARTNO", "PPRINT", "INSERT", "REMARK", "TPRINT", "LETTER"];

/// What a statement of this name does.
pub(super) fn meaning_of(name: &str) -> Inert {
    let first = name.split_ascii_whitespace().next().unwrap_or_default();
    let name = if TEXTS.contains(&first) { first } else { name };
    if let Some(known) = TOOLS.iter().chain(&JOB).chain(&POST).find(|known| **known == name) {
        return Inert::Known(known);
    }
    // CSI_SET_FLUTE_LENGTH, CSI_SET_EXTENSION_LENGTH and their like tell CAMplete of the tool.
    if name.starts_with("CSI_SET_") {
        return Inert::Known("CSI_SET_..");
    }
    if SHIFTS.contains(&name) { Inert::Shifts } else { Inert::Unknown }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_known_by_name_and_texts_need_no_stroke() {
        for (name, expected) in [
            ("SETUP", Inert::Known("SETUP")),
            ("PARTNO BRACKET 3", Inert::Known("PARTNO")),
            ("CSI_SET_FLUTE_LENGTH", Inert::Known("CSI_SET_..")),
            ("TOOL PATH", Inert::Known("TOOL PATH")),
            ("TRACUT", Inert::Shifts),
            ("SETUP 3", Inert::Unknown),
            ("GOBACK", Inert::Unknown),
        ] {
            assert_eq!(meaning_of(name), expected, "{name}");
        }
    }
}
