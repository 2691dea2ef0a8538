//! In which other language is a line written that is no G-code, and what is to be chosen in the CAM program instead?

/// What is said of lines of a language that is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Language {
    HeidenhainConversational,
    HeidenhainIso,
    Siemens,
    Okuma,
    Fagor,
    Macros,
    LinuxCnc,
    OpenSbp,
    Hpgl,
}

impl Language {
    /// What it is, and what to choose.
    pub(in super::super) const fn explained(self) -> &'static str {
        match self {
            Self::HeidenhainConversational => {
                "Heidenhain's conversational language, which is not read; choose a post of plain G-code (Fanuc) in the CAM program, or APT"
            }
            Self::HeidenhainIso => {
                "Heidenhain's DIN/ISO, whose codes mean other things; choose a post of plain G-code (Fanuc) in the CAM program, or APT"
            }
            Self::Siemens => {
                "the language of Siemens Sinumerik; of it plain G-code is read: switch off its cycles, frames and variables in the CAM program, or choose a post for Fanuc"
            }
            Self::Okuma => {
                "the language of Okuma, whose codes mean other things; choose a post for Fanuc in the CAM program, or APT"
            }
            Self::Fagor => {
                "the language of Fagor; of it plain G-code is read: switch its # statements off in the CAM program, or choose a post for Fanuc"
            }
            Self::Macros => {
                "variables, expressions and macros are not computed; expected numbers: switch macros off in the post of the CAM program, so that it writes every move"
            }
            Self::LinuxCnc => {
                "O-words of LinuxCNC with conditions, loops or arguments are not computed; expected every move, or sub and call without arguments"
            }
            Self::OpenSbp => "OpenSBP of ShopBot, which is not read; choose a post of G-code in the CAM program",
            Self::Hpgl => "HPGL of plotters, which is not read; choose a post of G-code in the CAM program",
        }
    }

    /// The language of a line that could not be read.
    pub(super) fn of(line: &[u8]) -> Option<Self> {
        let text = bare(line);
        let text = text.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
        let words = || text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '$'));
        let begins = |all: &[&str]| all.iter().any(|one| text.starts_with(one));
        let holds = |all: &[&str]| all.iter().any(|one| text.contains(one));
        let says = |all: &[&str]| words().any(|word| all.contains(&word));
        if begins(&HEIDENHAIN) || says(&["FMAX"]) || is_heidenhain_line(text) {
            return Some(Self::HeidenhainConversational);
        }
        if text.ends_with('*') || (text.starts_with('%') && says(&["G70", "G71"])) {
            return Some(Self::HeidenhainIso);
        }
        if begins(&["IN;", "PU", "PD", "PA", "SP1"]) {
            return Some(Self::Hpgl);
        }
        if is_open_sbp(text) {
            return Some(Self::OpenSbp);
        }
        if begins(&["CALL O"]) || says(&["MODIN", "MODOUT"]) || has_numbered(text, "VC") || holds(&["VZOF", "VTOF"]) {
            return Some(Self::Okuma);
        }
        if is_o_word(text) {
            return Some(Self::LinuxCnc);
        }
        if let Some(behind) = text.split('#').nth(1) {
            let is_fagor = text.starts_with('#') && behind.starts_with(|c: char| c.is_ascii_alphabetic());
            return Some(if is_fagor { Self::Fagor } else { Self::Macros });
        }
        let is_siemens = says(&SIEMENS)
            || holds(&["%_N_", "$P_", "$TC_", "$A", "$M", "MSG(", "=IC(", "=AC(", "=DC(", "CR="])
            || has_numbered(text, "CYCLE")
            || has_numbered(text, "HOLES")
            || (text.contains('=') && !text.contains('['));
        if is_siemens {
            return Some(Self::Siemens);
        }
        (text.contains('[') || begins(&["IF", "WHILE", "GOTO", "POPEN", "DPRNT"])).then_some(Self::Macros)
    }
}

/// What begins lines of Heidenhain's conversational language.
const HEIDENHAIN: [&str; 17] = [
    "BEGIN PGM",
    "END PGM",
    "BLK FORM",
    "TOOL CALL",
    "TOOL DEF",
    "CYCL DEF",
    "CYCL CALL",
    "CALL LBL",
    "CALL PGM",
    "LBL ",
    "FN ",
    "PLANE ",
    "APPR ",
    "DEP ",
    "CHF ",
    "RND ",
    "CC ",
];

/// Words of Sinumerik that stand alone in a block.
const SIEMENS: [&str; 37] = [
    "TRANS",
    "ATRANS",
    "ROT",
    "AROT",
    "MIRROR",
    "AMIRROR",
    "SCALE",
    "ASCALE",
    "SUPA",
    "WORKPIECE",
    "DEF",
    "PROC",
    "RET",
    "MCALL",
    "GOTOF",
    "GOTOB",
    "TRAORI",
    "TRAFOOF",
    "FFWON",
    "FFWOF",
    "SOFT",
    "BRISK",
    "COMPCAD",
    "COMPCURV",
    "COMPOF",
    "CUT2D",
    "DIAMOF",
    "STOPRE",
    "EXTCALL",
    "REPEAT",
    "ORIWKS",
    "ORIMKS",
    "ORIAXES",
    "CFC",
    "CFTCP",
    "CFIN",
    "NORM",
];

/// What O-words of `LinuxCNC` do.
const O_WORDS: [&str; 12] =
    ["SUB", "ENDSUB", "CALL", "RETURN", "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE", "DO", "REPEAT", "ENDREPEAT"];

/// The text in capitals, without comments, blanks about it and the number of its block.
fn bare(line: &[u8]) -> String {
    let mut text = String::new();
    let mut depth = 0_usize;
    let mut is_call = false;
    for c in String::from_utf8_lossy(line).to_ascii_uppercase().chars() {
        match c {
            ';' if depth == 0 && !text.starts_with("IN") => break,
            // Parentheses right behind a word are arguments, all others are remarks.
            '(' => {
                is_call |= depth == 0 && text.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '=');
                depth += 1;
                if is_call {
                    text.push(c);
                }
            }
            ')' if 0 < depth => depth -= 1,
            _ if depth == 0 || is_call => text.push(c),
            _ => {}
        }
    }
    let text = text.trim().trim_start_matches('/').trim_start();
    let without_number = text.strip_prefix('N').filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    let text = without_number.map_or(text, |rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    text.trim_start().to_owned()
}

/// `L X+1 Y+2 R0`, `C X+1 DR+`, `LP PR+1`: straight lines and arcs of Heidenhain.
fn is_heidenhain_line(text: &str) -> bool {
    let Some((first, rest)) = text.split_once(' ') else { return false };
    matches!(first, "L" | "C" | "CR" | "CT" | "LP" | "CP" | "CTP")
        && rest.trim_start().starts_with(|c: char| "XYZABCIP+-RM".contains(c))
}

/// `M3,1.5,2`: a command of two signs and its numbers behind commas.
fn is_open_sbp(text: &str) -> bool {
    let mut signs = text.chars();
    let is_command = signs.next().is_some_and(|c| c.is_ascii_uppercase())
        && signs.next().is_some_and(|c| c.is_ascii_uppercase() || ('1'..='6').contains(&c));
    is_command && signs.next() == Some(',')
}

/// `O100 CALL`, `O<NAME> SUB`.
pub(super) fn is_o_word(text: &str) -> bool {
    let Some(rest) = text.strip_prefix(['O', 'o']) else { return false };
    let rest = rest.trim_start();
    rest.starts_with('<') || {
        let behind = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        let what = behind.trim_start().to_ascii_uppercase();
        behind.len() < rest.len() && O_WORDS.iter().any(|word| what.starts_with(word))
    }
}

/// A word with a number right behind it.
fn has_numbered(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| text[at + word.len()..].starts_with(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_known_by_their_language() {
        use Language::*;
        for (line, expected) in [
            ("0 BEGIN PGM 11 MM", Some(HeidenhainConversational)),
            ("5 TOOL CALL 3 Z S3263", Some(HeidenhainConversational)),
            ("6 L X-80.6 Y+95.2 R0 F237 M3", Some(HeidenhainConversational)),
            ("7 L Z+100 R0 FMAX", Some(HeidenhainConversational)),
            ("12 C X+10 Y+5 DR-", Some(HeidenhainConversational)),
            ("%PART G71 *", Some(HeidenhainIso)),
            ("N10 G30 G17 X+0 Y+0 Z-40*", Some(HeidenhainIso)),
            ("%_N_PART_MPF", Some(Siemens)),
            ("N20 MSG(\"a (b) ; c\")", Some(Siemens)),
            ("N30 CYCLE81(10,0,2,-5)", Some(Siemens)),
            ("TRANS X10 Y5", Some(Siemens)),
            ("R1=5", Some(Siemens)),
            ("G0 SUPA Z0 D0", Some(Siemens)),
            ("G2 X1 Y2 CR=5", Some(Siemens)),
            ("G0 X=IC(5)", Some(Siemens)),
            ("T=\"MILL 8\"", Some(Siemens)),
            ("IF R1>5 GOTOF END", Some(Siemens)),
            ("CALL O1000", Some(Okuma)),
            ("VC1=5", Some(Okuma)),
            ("#HSC ON", Some(Fagor)),
            ("#1=3", Some(Macros)),
            ("N5 IF [#1 EQ 1] GOTO 3", Some(Macros)),
            ("X[1+2]", Some(Macros)),
            ("GOTO 10", Some(Macros)),
            ("o100 if [1 GT 0]", Some(LinuxCnc)),
            ("O<hole> call [1]", Some(LinuxCnc)),
            ("M3,1.5,2.0,-0.1", Some(OpenSbp)),
            ("IN;PU100,200;", Some(Hpgl)),
            ("(MSG(x) CYCLE81) hello", None),
            ("G1 X", None),
            ("O100 (NAME)", None),
            ("O0001 G21 G90", None),
        ] {
            assert_eq!(Language::of(line.as_bytes()), expected, "{line}");
        }
    }
}
