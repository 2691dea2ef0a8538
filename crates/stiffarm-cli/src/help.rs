//! What does help tell of a command besides its options? Examples, and which files `-o` writes.

use clap::{Args, Command};

use crate::common::Common;

/// What stands at the end of the program's own help.
pub(crate) const EXIT_CODES: &str = "\
Exit codes:
  0  the answer is given
  1  no answer: a file, a robot, a search
  2  wrong usage
  3  with --check (rank, place, mill): the tolerance is not held, there is no place, or with --chatter a cut surely swings";

/// Of one command.
pub(crate) struct About {
    /// As it is typed behind `stiffarm`.
    name: &'static str,
    /// What `-o` writes; empty where it writes nothing.
    files: &'static str,
    /// It shares out its work on threads.
    is_long: bool,
    /// What can be typed, and what that does.
    examples: &'static [(&'static str, &'static str)],
}

const TABLES: &str = "the table as .csv, .parquet, .json, .md or .txt";

const ABOUT: [About; 23] = [
    About {
        name: "rank",
        files: "a report to hand on as .html or report.pdf, the ranking as .csv, .parquet, .json, .md or .txt, deflection against task size (planar) or bars with what is proved \
                (spatial) as .svg, .pdf or .png",
        is_long: true,
        examples: &[
            ("stiffarm rank", "the paper's ten robots on its six tasks"),
            ("stiffarm rank --task rect:0.6x0.4 --tolerance-mm 2 -o report.html", "a report: verdict, places, sources"),
            (
                "stiffarm rank --payload-kg 200.. --task rect:0.6x0.4 --tolerance-mm 2",
                "every robot for 200 kg and more",
            ),
            ("stiffarm rank --robots \"KR 210*,BT200L\" --task A:0.5 -o ranking.csv", "some robots, to a spreadsheet"),
            (
                "stiffarm rank --model spatial --task rect:0.6x0.4 --tool spindle:250@90",
                "all six drives, with a spindle",
            ),
        ],
    },
    About {
        name: "place",
        files: "a report to hand on as .html or report.pdf, the placement as .csv, .parquet, .json, .md or .txt, the arm, the zone and a map as \
                .svg, .pdf or .png, where the work must stand as shop.svg, a view in space that can be turned as view.html, its lines and faces for ParaView as .vtp",
        is_long: true,
        examples: &[
            (
                "stiffarm place BT200L --task rect:0.5x1.0 --within 1.2..,0.4..1.8 --tolerance-mm 3",
                "a table in front of it",
            ),
            ("stiffarm place BT200L --task A:0.5 --tolerance-mm 3 --check", "for scripts: exit code 3 where it fails"),
            (
                "stiffarm place \"KR 210 R2700 extra\" --task rect:0.6x0.4 --model spatial --tool spindle:250@90 -o place.view.html",
                "all six drives, a spindle across the flange, and a view in space",
            ),
            ("stiffarm place BT200L --task A:0.5 --stiffness-nm-per-rad 2e6", "with joints of known stiffness"),
        ],
    },
    About {
        name: "map",
        files: "the cells as .csv, .parquet or .json, the answer as .md or .txt, the map as .svg, .pdf or .png, a view in space that can be \
                turned as .html, for ParaView the cells as .vti and the view as .vtp",
        is_long: true,
        examples: &[
            (
                "stiffarm map \"KR 210 R2700 extra\" --zone B:0.5 -o map.png",
                "the arm plane, and the best place of a zone",
            ),
            ("stiffarm map BT200L --direction-deg 30", "a force of known direction"),
            (
                "stiffarm map BT200L --model spatial --tool-mm 0,0,200 --layer limit-margin -o margin.svg",
                "how near the limits are",
            ),
        ],
    },
    About {
        name: "modes",
        is_long: false,
        files: "the modes as .csv or .parquet, of one posture their shapes as .svg, .pdf or .png, the answer as .json, .md or .txt",
        examples: &[
            (
                "stiffarm modes \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,45,0",
                "the arm alone; stiffness by the prior, with intervals",
            ),
            (
                "stiffarm modes \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,45,0 --tool-mass-kg 60 --tool-com-mm 0,0,200",
                "with a spindle of 60 kg, its centre 200 mm before the flange",
            ),
            (
                "stiffarm modes \"KR 210 R2700-2\" --task rect:0.4x0.6 --at 1.5,0.8 --tool-mm 0,0,200 --tool-mass-kg 60 --tool-com-mm 0,0,200",
                "over a zone at one place, with a proved least first frequency",
            ),
        ],
    },
    About {
        name: "chatter",
        is_long: true,
        files: "depth over the speed of the spindle as .csv, .parquet, .svg, .pdf or .png, the answer as .json, .md or .txt",
        examples: &[
            (
                "stiffarm chatter endmill.toml --robot \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,90,0 --feed 1,0,0",
                "a process file, at one posture, feeding forward",
            ),
            (
                "stiffarm chatter endmill.toml --robot \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,90,0 --feed 1,0,0 --damping-ratio 0.05 -o lobes.svg",
                "with a damping that was measured, and the lobes as a figure",
            ),
        ],
    },
    About {
        name: "compliance",
        files: "the 6 x 6 matrix as .csv or .parquet, the answer as .json, .md or .txt, a view in space that can be turned as .html, its lines for ParaView as .vtp",
        is_long: false,
        examples: &[(
            "stiffarm compliance \"KR 210 R2700 extra\" --joints-deg 0,-90,90,0,45,0 --tool-mm 0,0,150 --force-n 0,1000,0",
            "one posture under a force to the left",
        )],
    },
    About {
        name: "study",
        files: "every accuracy as .csv, .parquet, .json, .md or .txt, the paper's Fig. 4 to 9 as .svg, .pdf or .png",
        is_long: true,
        examples: &[
            ("stiffarm study --tasks A,rect:1x3 --sizes 0.1,0.5", "two shapes"),
            ("stiffarm study --compare serial,serial --k3 1,0.5 -o study.png", "one architecture, a stiffer drive 3"),
        ],
    },
    About {
        name: "compare",
        files: "both placements as .csv, .parquet, .json, .md or .txt, both maps on one scale of colour as .svg, .pdf or .png",
        is_long: true,
        examples: &[
            (
                "stiffarm compare \"KR 210 R2700 extra\" BT200L --task rect:0.6x0.4 --tolerance-mm 2 -o both.png",
                "two robots, one task",
            ),
            (
                "stiffarm compare short.toml long.toml --task rect:0.6x0.4 --model spatial",
                "one robot with two tools: short.toml holds `verb = \"place\"`, `robot = \"BT200L\"` and `tool = \"spindle:250@90\"`; \
                 what a job file says comes before what is asked of both",
            ),
        ],
    },
    About {
        name: "measure",
        files: "the table to be filled in as .csv or .parquet, the plan as .json, .md or .txt, the postures as .svg, .pdf or .png",
        is_long: true,
        examples: &[
            (
                "stiffarm measure \"KR 210 R2700 extra\" --load-mm 0,0,200 -o plan.csv",
                "twenty runs with a weight; a table to be filled in",
            ),
            (
                "stiffarm measure \"KR 210 R2700 extra\" --loads down,left --runs 30 --task rect:0.6x0.4 --compare mine.csv",
                "with a pulley, for one work, and what your own choice is worth",
            ),
        ],
    },
    About {
        name: "identify",
        files: "a report to hand on as .html or report.pdf, the robot file as .toml, the drives as .csv, .parquet, .json, .md or .txt, what remains of every row as .svg, .pdf or .png",
        is_long: false,
        examples: &[
            (
                "stiffarm identify measurements.csv --robot mine.toml --load-mm 0,50,200 -o identified.toml",
                "a robot file that knows its drives, and how well",
            ),
            (
                "stiffarm identify measurements.csv --robot \"R-2000iC/165F\" --marker-mm \"top=0,100,150;side=0,-100,150\" -o fit.svg",
                "two markers, and a figure of what remains",
            ),
        ],
    },
    About {
        name: "force",
        files: "the force over a revolution as .csv or .parquet, the answer as .json, .md or .txt, the force across the tool axis as .svg, \
                .pdf or .png",
        is_long: false,
        examples: &[("stiffarm force endmill.toml -o force.svg", "a process file, and its figure")],
    },
    About {
        name: "mill",
        files: "a report to hand on as .html or report.pdf, every sample as .csv or .parquet, the answer as .json, .md or .txt, error, rolls and path as .svg, .pdf or .png, \
                where the part must stand as shop.svg, with --chatter from which depth cuts swing as lobes.svg, the robot and the path in space as view.html, robot programs \
                as .src (KUKA), .mod (ABB) or .ls (Fanuc), a script for RoboDK as .py, a trajectory for ROS 2 as .yaml, lines for ParaView as .vtp, with --compensate the path itself as .nc, .gcode, .ngc, .tap, .apt or .cls",
        is_long: true,
        examples: &[
            ("stiffarm mill part.nc --dry", "lengths, moves, extents, feed rates, what was assumed and what ignored"),
            (
                "stiffarm mill part.nc --robot \"KR 210 R2700 extra\" --tool spindle:250@90 --process endmill.toml --tolerance-mm 0.3",
                "the best place of the part, the best rolls, and whether the tolerance is held",
            ),
            (
                "stiffarm mill part.nc --robot cell.toml --force-n 300,-120,80 --at 1.6,0,0.8,30 --compensate -o part.src -o part.svg",
                "the part where it stands, its deflection taken out, and a KRL program",
            ),
        ],
    },
    About {
        name: "calibrate",
        files: "a report to hand on as .html or report.pdf, the robot file with its [calibration] as .toml, every row's error as .csv or .parquet, the answer as .json, .md or .txt, both errors along the rows as \
                .svg, .pdf or .png",
        is_long: false,
        examples: &[
            (
                "stiffarm calibrate mine.toml tracker.csv --at 1.8,0,0.8 -o calibrated.toml -o errors.svg",
                "from forty wide postures, with the error that remains about the work",
            ),
            (
                "stiffarm calibrate \"R-2000iC/165F\" export.csv --columns joint_1_deg=J1,x1_mm=X --frame-by station --level geometry",
                "a tracker's export, the tracker moved once",
            ),
        ],
    },
    About {
        name: "robots",
        files: TABLES,
        is_long: false,
        examples: &[("stiffarm robots", "all of them; `list` chooses, `show` tells one")],
    },
    About {
        name: "robots list",
        files: "the list as .csv, .parquet, .json, .md or .txt",
        is_long: false,
        examples: &[("stiffarm robots list abb 6700 --reach-m ..2.8", "some of one maker")],
    },
    About {
        name: "robots show",
        files: "what is known as .csv, .parquet, .json, .md or .txt, the robot file as .toml, what it reaches as .svg, .pdf or .png",
        is_long: false,
        examples: &[
            ("stiffarm robots show BT200L", "lengths, limits, stiffness and sources"),
            ("stiffarm robots show BT200L -o mine.toml", "its robot file, to be changed"),
        ],
    },
    About {
        name: "robots check",
        files: "the faults as .csv, .parquet, .json, .md or .txt",
        is_long: false,
        examples: &[("stiffarm robots check mine.toml robots/", "a file, and all of a folder")],
    },
    About {
        name: "robots import",
        files: "the robot file as .toml, what was understood as .csv, .parquet, .json, .md or .txt",
        is_long: false,
        examples: &[("stiffarm robots import arm.urdf --payload-kg 210 -o arm.toml", "a robot file from a URDF")],
    },
    About {
        name: "robots verify",
        files: "the robot file that counts as the readings do as .toml, the ways of counting that fit best as .csv, .parquet, .json, .md or .txt",
        is_long: true,
        examples: &[
            (
                "stiffarm robots verify \"KR 210 R2700 extra\" pendant.csv -o mine.toml",
                "a robot file of which programs no longer warn that its joints may count otherwise; exit code 1 where it is not verified",
            ),
            ("stiffarm robots verify pendant.csv --any", "which robot is it?"),
        ],
    },
    About {
        name: "paper",
        files: "a folder, which is made, with a file for every table and figure, and an index.md",
        is_long: true,
        examples: &[
            ("stiffarm paper -o paper", "every table and figure of the paper, with the command of each"),
            ("stiffarm paper -o paper --pictures pdf --width-mm 170", "for print, texts 8 pt high"),
        ],
    },
    About {
        name: "serve",
        files: "",
        is_long: true,
        examples: &[
            ("stiffarm serve --open", "the page, on this machine alone, on a free port"),
            (
                "stiffarm serve --port 8080 --threads 8",
                "a port that is known, and eight questions at once; GET /openapi.json describes what can be asked",
            ),
        ],
    },
    About {
        name: "validate",
        files: "the ledger as .csv, .parquet, .json, .md or .txt",
        is_long: false,
        examples: &[("stiffarm validate -o ledger.csv", "every published number beside the computed one")],
    },
    About {
        name: "completions",
        files: "",
        is_long: false,
        examples: &[
            ("stiffarm completions bash > ~/.local/share/bash-completion/completions/stiffarm", "bash"),
            ("stiffarm completions zsh > ~/.zfunc/_stiffarm", "zsh, where ~/.zfunc stands in fpath"),
            ("stiffarm completions fish > ~/.config/fish/completions/stiffarm.fish", "fish"),
        ],
    },
];

/// The command with what help tells besides; `name` is what is typed behind `stiffarm`.
pub(crate) fn with_help(command: Command, name: &str) -> Command {
    let Some(about) = ABOUT.iter().find(|about| about.name == name) else { return command };
    let command = command.after_help(examples(about));
    if about.files.is_empty() {
        return without_common(command);
    }
    let command = Common::augment_args(command);
    let files = format!("Write to a file, as often as wanted; its ending chooses what: {}", about.files);
    command.mut_arg("output", |arg| arg.help(files)).mut_arg("threads", |arg| arg.hide(!about.is_long))
}

/// A command that writes one text and does nothing else.
pub(crate) fn without_common(command: Command) -> Command {
    let hidden = ["format", "output", "threads", "quiet"];
    hidden.into_iter().fold(Common::augment_args(command), |command, name| command.mut_arg(name, |arg| arg.hide(true)))
}

fn examples(about: &About) -> String {
    let each = about.examples.iter().map(|(line, says)| format!("  {line}\n      {says}"));
    format!("Examples:\n{}", each.collect::<Vec<_>>().join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{command, read};

    /// Words of a command line as a shell would have them: quotes keep blanks, what is redirected is no argument.
    fn words(line: &str) -> Vec<String> {
        let line = line.split(" > ").next().unwrap_or(line);
        let of = |(i, piece): (usize, &str)| -> Vec<String> {
            if i % 2 == 1 { vec![piece.into()] } else { piece.split_whitespace().map(Into::into).collect() }
        };
        line.split('"').enumerate().flat_map(of).collect()
    }

    #[test]
    fn every_example_can_be_typed() {
        for About { examples, name, .. } in &ABOUT {
            assert!(!examples.is_empty(), "{name}");
            for (line, _) in *examples {
                let words = words(line);
                assert_eq!(words[..=name.split(' ').count()].join(" "), format!("stiffarm {name}"));
                let matches = command().try_get_matches_from(&words).unwrap_or_else(|why| panic!("{line}: {why}"));
                read(&matches).unwrap_or_else(|why| panic!("{line}: {why}"));
            }
        }
    }

    #[test]
    fn help_shows_what_applies_and_nothing_else() {
        let help = |words: &[&str]| {
            let all = [&["stiffarm"], words, &["--help"]].concat();
            command().try_get_matches_from(all).unwrap_err().to_string()
        };
        assert!(help(&["rank"]).contains("--threads") && help(&["rank"]).contains("--check"));
        assert!(!help(&["compliance"]).contains("--threads") && !help(&["compliance"]).contains("--within"));
        assert!(help(&["compliance"]).contains(".html") && !help(&["compliance"]).contains(".svg"));
        assert!(!help(&["completions"]).contains("--format"));
        assert!(help(&[]).contains("Exit codes:"));
    }
}
