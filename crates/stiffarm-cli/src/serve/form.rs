//! In which form is an answer wanted?

use stiffarm::plain::on_one_line;
use stiffarm_ask::forms::Form;
use stiffarm_ask::request::Verb;

/// What `as` says: a form, several words with commas between them, which are made of one answer, or what is given without computing one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// It alone.
    One(Form),
    /// Texts under their words in one object of JSON.
    Several(Vec<Form>),
    /// The job file that asks the same.
    Job,
    /// What must be typed, in a shell and in Python, and the job file.
    Command,
}

impl Wanted {
    /// Of a text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn of(text: &str) -> Result<Self, String> {
        let form =
            |word: &str| Form::of_word(word).ok_or_else(|| format!("as={} is no form of an answer", on_one_line(word)));
        match text {
            "job" => return Ok(Self::Job),
            "command" => return Ok(Self::Command),
            one if !one.contains(',') => return form(one).map(Self::One),
            _ => {}
        }
        let mut forms = Vec::new();
        for word in text.split(',') {
            let found = if ["job", "command"].contains(&word) { None } else { Some(form(word)?) };
            let Some(form) = found.filter(|form| !form.is_bytes()) else {
                return Err(format!("{word} is asked alone; expected texts of an answer such as as=json,tables,svg"));
            };
            if forms.contains(&form) {
                return Err(format!("as={} has {word} twice", on_one_line(text)));
            }
            forms.push(form);
        }
        Ok(Self::Several(forms))
    }

    /// It comes as JSON that is no file.
    pub(super) fn is_json(&self) -> bool {
        match self {
            Self::One(form) => form.is_json(),
            Self::Several(_) => true,
            Self::Job | Self::Command => false,
        }
    }

    /// It can stand in a line of JSON.
    pub(super) fn is_text(&self) -> bool {
        !matches!(self, Self::One(form) if form.is_bytes())
    }

    /// As browsers know it.
    pub(super) fn media_type(&self) -> &'static str {
        match self {
            Self::One(form) => form.row().media_type,
            Self::Several(_) | Self::Command => Form::Json.row().media_type,
            Self::Job => Form::RobotFile.row().media_type,
        }
    }

    /// How its file is called.
    pub(super) fn file(&self, verb: Verb) -> String {
        match self {
            Self::One(form) => form.file(verb.function()),
            Self::Several(_) => Form::Json.file(verb.function()),
            Self::Job => "job.toml".into(),
            Self::Command => "command.json".into(),
        }
    }
}
