//! What must be typed to ask the same again?

use super::{Kind, Request, Setting, parts};

impl Request {
    /// The command line that asks the same, for a POSIX shell, in the folder in which it was asked.
    pub fn command(&self) -> String {
        self.command_words().join(" ")
    }

    /// The same in lines of no more than so many letters, where no option is longer: broken between options alone, as a shell takes it.
    pub fn command_in_lines(&self, letters: usize) -> String {
        let mut lines: Vec<String> = Vec::new();
        for word in self.command_words() {
            match lines.last_mut() {
                // With the sign that the command goes on.
                Some(line) if line.chars().count() + word.chars().count() + 3 <= letters => {
                    line.push(' ');
                    line.push_str(&word);
                }
                None => lines.push(word),
                Some(_) => lines.push(format!("  {word}")),
            }
        }
        lines.join(" \\\n")
    }

    /// The words of a command, an option with its value as one.
    fn command_words(&self) -> Vec<String> {
        let mut words = vec!["stiffarm".to_owned(), self.verb.name().to_owned()];
        for given in self.given.iter().filter(|given| given.setting.is_positional) {
            words.extend(given.texts.iter().map(|text| quoted(text.trim())));
        }
        for given in self.given.iter().filter(|given| !given.setting.is_positional) {
            let name = given.setting.name;
            for text in typed(given.setting, &given.texts) {
                words.push(match given.setting.kind {
                    Kind::Flag if text == "true" => format!("--{name}"),
                    Kind::Flag => continue,
                    // A value that begins with a minus is no option.
                    _ if text.starts_with('-') => format!("--{name}={}", quoted(&text)),
                    _ => format!("--{name} {}", quoted(&text)),
                });
            }
        }
        words
    }
}

/// Values as they are typed: with commas between where that is how they are distinguished.
fn typed(setting: &Setting, texts: &[String]) -> Vec<String> {
    let trimmed: Vec<String> = texts.iter().map(|text| text.trim().to_owned()).collect();
    let is_joined = setting.is_list() && trimmed.iter().all(|text| !text.contains([',', ';']));
    if is_joined && parts(setting, &trimmed.join(",")).count() == trimmed.len() {
        vec![trimmed.join(",")]
    } else {
        trimmed
    }
}

/// A word as a shell takes it for itself, whatever it holds.
fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:=+,@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.into();
    }
    format!("'{}'", text.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::super::{Pair, Spelling, Verb};
    use super::*;

    #[test]
    fn a_command_asks_the_same_and_nothing_in_it_is_run() {
        let pair = |name: &str, text: &str| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
        let pairs = [
            pair("robot", "KR 210 R2700 extra"),
            pair("task", "rect:0.6x0.4"),
            pair("model", "spatial"),
            pair("tool-mm", "-5,0,200"),
            pair("within", "1.0..,0.5.."),
        ];
        let asked = Request::read(Verb::Place, &pairs, Spelling::Typed).unwrap();
        assert_eq!(
            asked.command(),
            "stiffarm place 'KR 210 R2700 extra' --task rect:0.6x0.4 --model spatial --tool-mm=-5,0,200 --within 1.0..,0.5.."
        );
        // Broken between options, and whole again for a shell, which takes the sign and the end of a line for nothing.
        let lines = asked.command_in_lines(60);
        assert!(lines.lines().all(|line| line.chars().count() <= 60) && 1 < lines.lines().count(), "{lines}");
        assert_eq!(lines.replace(" \\\n  ", " "), asked.command());
        let tasks = [pair("task", "A:0.5"), pair("task", "rect:0.1x0.2"), pair("robots", "BT200L,KR 210*")];
        let asked = Request::read(Verb::Rank, &tasks, Spelling::Typed).unwrap();
        assert_eq!(asked.command(), "stiffarm rank --task A:0.5,rect:0.1x0.2 --robots 'BT200L,KR 210*'");
        assert_eq!(quoted("a'b; rm $(x) `y`\n\"&<"), "'a'\\''b; rm $(x) `y`\n\"&<'");
        assert_eq!(quoted(""), "''");
    }
}
