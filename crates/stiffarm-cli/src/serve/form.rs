//! In which form is an answer wanted, and what is that to a browser?

use stiffarm::plain::on_one_line;
use stiffarm_ask::request::Verb;

use super::named;

/// What `as` says: one form, or several words with commas between them, which are made of one answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// It alone.
    One(Form),
    /// Texts under their words in one object of JSON.
    Several(Vec<Form>),
}

impl Wanted {
    /// Of a text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn of(text: &str) -> Result<Self, String> {
        let form =
            |word: &str| Form::of(word).ok_or_else(|| format!("as={} is no form of an answer", on_one_line(word)));
        if !text.contains(',') {
            return form(text).map(Self::One);
        }
        let mut forms = Vec::new();
        for word in text.split(',') {
            let form = form(word)?;
            if !form.is_text() || form.is_of_question() {
                return Err(format!("{word} is asked alone; expected texts of an answer such as as=json,tables,svg"));
            }
            if forms.contains(&form) {
                return Err(format!("as={} has {word} twice", on_one_line(text)));
            }
            forms.push(form);
        }
        Ok(Self::Several(forms))
    }

    /// All of them.
    pub(super) fn forms(&self) -> &[Form] {
        match self {
            Self::One(form) => std::slice::from_ref(form),
            Self::Several(forms) => forms,
        }
    }

    /// It comes as JSON that is no file.
    pub(super) fn is_json(&self) -> bool {
        matches!(self, Self::Several(_)) || self.forms()[0].is_json()
    }

    /// It can stand in a line of JSON.
    pub(super) fn is_text(&self) -> bool {
        self.forms().iter().all(Form::is_text)
    }

    /// As browsers know it.
    pub(super) fn media_type(&self) -> &'static str {
        if self.is_json() { "application/json" } else { self.forms()[0].media_type() }
    }
}

/// One of these forms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// A file as `-o` writes it, by its ending.
    File(String),
    /// What can be turned in space.
    View,
    /// What is handed on.
    Report,
    /// The same as pages.
    PrintedReport,
    /// The job file that asks the same.
    Job,
    /// What must be typed, in a shell and in Python, and the job file; nothing is computed.
    Command,
    /// What people read, as JSON.
    Tables,
}

impl Form {
    /// Of a word, where it may be one.
    pub(super) fn of(word: &str) -> Option<Self> {
        match word {
            "view" => Some(Self::View),
            "report" => Some(Self::Report),
            "shop" => Some(Self::File("shop.svg".into())),
            "lobes" => Some(Self::File("lobes.svg".into())),
            "report-pdf" => Some(Self::PrintedReport),
            "job" => Some(Self::Job),
            "command" => Some(Self::Command),
            "tables" => Some(Self::Tables),
            ending => {
                let is_ending =
                    !ending.is_empty() && ending.len() <= 8 && ending.bytes().all(|byte| byte.is_ascii_lowercase());
                is_ending.then(|| Self::File(ending.into()))
            }
        }
    }

    /// The word that asks for it.
    pub(super) fn word(&self) -> &str {
        match self {
            Self::View => "view",
            Self::Report => "report",
            Self::PrintedReport => "report-pdf",
            Self::Job => "job",
            Self::Command => "command",
            Self::Tables => "tables",
            Self::File(ending) => ending.strip_suffix(".svg").unwrap_or(ending),
        }
    }

    /// The name of the file that the command line would write.
    pub(super) fn file(&self, verb: Verb) -> String {
        match self {
            Self::File(ending) => named(verb.function(), ending),
            Self::View => named(verb.function(), "view.html"),
            Self::Report => named(verb.function(), "html"),
            Self::PrintedReport => named(verb.function(), "report.pdf"),
            Self::Job => "job.toml".into(),
            Self::Command => "command.json".into(),
            Self::Tables => named(verb.function(), "tables.json"),
        }
    }

    /// As browsers know it.
    pub(super) fn media_type(&self) -> &'static str {
        match self {
            Self::View | Self::Report => "text/html; charset=utf-8",
            Self::PrintedReport => "application/pdf",
            Self::Job => "application/toml",
            Self::Command | Self::Tables => "application/json",
            Self::File(ending) => match ending.as_str() {
                "json" => "application/json",
                "csv" => "text/csv; charset=utf-8",
                "md" => "text/markdown; charset=utf-8",
                "svg" | "shop.svg" | "lobes.svg" => "image/svg+xml",
                "png" => "image/png",
                "pdf" => "application/pdf",
                "html" => "text/html; charset=utf-8",
                "parquet" => "application/vnd.apache.parquet",
                "toml" => "application/toml",
                _ => "text/plain; charset=utf-8",
            },
        }
    }

    /// It is text, which can stand in JSON.
    pub(super) fn is_text(&self) -> bool {
        !matches!(self, Self::File(ending) if matches!(ending.as_str(), "png" | "pdf" | "parquet"))
            && *self != Self::PrintedReport
    }

    /// It is told without asking anything.
    pub(super) fn is_of_question(&self) -> bool {
        matches!(self, Self::Job | Self::Command)
    }

    /// It is the fields of an answer, or what people read of it.
    pub(super) fn is_json(&self) -> bool {
        *self == Self::Tables || matches!(self, Self::File(ending) if ending == "json")
    }
}
