//! Lines that a sender of grbl has between blocks: `$H`, `$G`, `?` and their like.

use super::super::fault::Wrong;
use super::Reader;

impl Reader<'_> {
    /// Whether a line is one of a sender; `$H` leads the tool home.
    ///
    /// # Errors
    /// What moves the tool, or changes how it moves, as only the machine knows.
    pub(super) fn take_sender(&mut self, text: &[u8], line: usize) -> Result<bool, Wrong> {
        let Some(b'$' | b'?' | b'!' | b'~') = text.first() else { return Ok(false) };
        let upper = String::from_utf8_lossy(text).to_ascii_uppercase();
        let word = upper.split([';', '(']).next().unwrap_or_default().trim_end();
        let refused = |why: &str| Err(Wrong::new(word, why));
        match word {
            "$H" => {
                self.machine.leaves_home(line);
                self.machine.notes.assume(line, "$H leads the tool to the machine's home");
            }
            "$" | "$$" | "$#" | "$G" | "$I" | "$N" | "$X" | "?" | "!" | "~" => {
                self.machine.notes.ignore(line, &format!("{word} (of the sender)"));
            }
            "$C" => return refused("the sender only checks what follows, and nothing moves"),
            _ if word.starts_with("$J=") => return refused("a jog of the sender; expected moves as G-code"),
            _ if word.starts_with("%_N_") || word.starts_with("$P") || word.starts_with("$TC") => return Ok(false),
            _ if word.contains('=') => {
                return refused(
                    "a setting of the machine is written, which may change how it moves; expected it in a file of its own",
                );
            }
            _ => return refused("what this line of a sender does is not known"),
        }
        Ok(true)
    }
}
