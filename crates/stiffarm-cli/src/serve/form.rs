//! In which form is an answer wanted, and what is that to a browser?

use stiffarm_ask::request::Verb;

use super::named;

/// What `as` says.
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
            ending => {
                let is_ending =
                    !ending.is_empty() && ending.len() <= 8 && ending.bytes().all(|byte| byte.is_ascii_lowercase());
                is_ending.then(|| Self::File(ending.into()))
            }
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
        }
    }

    /// As browsers know it.
    pub(super) fn media_type(&self) -> &'static str {
        match self {
            Self::View | Self::Report => "text/html; charset=utf-8",
            Self::PrintedReport => "application/pdf",
            Self::Job => "application/toml",
            Self::Command => "application/json",
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

    /// It is a report, which not every verb makes.
    pub(super) fn is_report(&self) -> bool {
        matches!(self, Self::Report | Self::PrintedReport)
    }

    pub(super) fn is_json(&self) -> bool {
        matches!(self, Self::File(ending) if ending == "json")
    }
}
