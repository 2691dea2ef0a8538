//! Is the table of options consistent, and does every reader of it get the same answers and the same refusals?

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use stiffarm::catalogue::paper_robots;
use stiffarm::drive::Architecture;
use stiffarm::place::Orientation;
use stiffarm::robot::Status;
use stiffarm::task::Zone;
use stiffarm_ask::request::{Absent, Of, Pair, Refusal, Request, SETTINGS, Setting, Spelling, Verb, job};

fn pair(name: &str, text: &str, at: &Spelling) -> Pair {
    Pair { name: name.into(), text: text.into(), at: at.clone() }
}

/// What is asked with these options, as it is typed.
fn asked(verb: Verb, given: &[(&str, &str)]) -> Result<Request, Refusal> {
    let pairs: Vec<Pair> = given.iter().map(|(name, text)| pair(name, text, &Spelling::Typed)).collect();
    Request::read(verb, &pairs, Spelling::Typed)
}

/// An option with its example, and with what it needs: another option, a model.
fn alone(verb: Verb, setting: &'static Setting) -> Vec<(&'static str, &'static str)> {
    let mut given = vec![(setting.name, setting.example)];
    let mut is_spatial = setting.of == Of::Spatial;
    let mut last = setting;
    while let Some(name) = last.needed_by(verb).next() {
        last = verb.setting(name).expect("a row");
        is_spatial |= last.of == Of::Spatial && verb != Verb::Modes;
        given.push((name, last.example));
    }
    given.extend(is_spatial.then_some(("model", "spatial")));
    if setting.name == "faces" {
        given.push(("task", "box:0.3x0.2x0.1"));
    }
    if setting.name == "regions" {
        given.push(("model", "regions"));
    }
    // A mass centre is of a mass.
    let has = |name: &str| given.iter().any(|(given, _)| *given == name);
    let (has_centre, has_mass) = (has("tool-com-mm"), has("tool-mass-kg"));
    // What held a tip is of its table.
    let (has_holder, has_table) = (has("frf-on"), has("frf"));
    given.extend((has_centre && !has_mass).then_some(("tool-mass-kg", "60")));
    given.extend((has_holder && !has_table).then_some(("frf", "tip.csv")));
    // A zone swings at a place.
    if verb == Verb::Modes && given.iter().any(|(name, _)| *name == "task") && setting.name != "at" {
        given.push(("at", "1.5,0.8"));
    }
    // What is asked of a cut goes with its feed.
    if verb == Verb::Chatter && setting.name != "feed" {
        given.push(("feed", "1,0,0"));
    }
    // A cone is about a direction, and a force has a size unless another is given.
    if setting.name == "force-cone-deg" && verb != Verb::Compliance {
        given.push(("force-n", "300,0,-50"));
    }
    given
}

#[test]
fn a_cone_goes_with_a_direction_whatever_the_size_of_the_force() {
    for verb in [Verb::Rank, Verb::Place, Verb::Map] {
        assert!(asked(verb, &[("direction-deg", "30"), ("force-cone-deg", "20")]).is_ok(), "{verb:?}");
    }
}

#[test]
fn what_is_switched_off_is_as_if_it_were_not_there() {
    let off = asked(Verb::Place, &[("allow-contact", "false")]).expect("it needs nothing");
    assert!(!off.is_given("allow-contact"));
    let on = asked(Verb::Place, &[("allow-contact", "true")]).expect_err("nothing is kept free").to_string();
    assert!(on.starts_with("--allow-contact needs "), "{on}");
}

#[test]
fn every_row_has_a_name_of_its_own_and_refers_to_rows_that_are_there() {
    for verb in Verb::ALL {
        let names: Vec<&str> = verb.settings().map(|setting| setting.name).collect();
        let keywords: Vec<String> = verb.settings().map(Setting::keyword).collect();
        for (i, setting) in verb.settings().enumerate() {
            assert!(!names[..i].contains(&setting.name), "{verb:?}: {} stands twice", setting.name);
            assert!(!keywords[..i].contains(&setting.keyword()), "{verb:?}: {} stands twice", setting.keyword());
            assert!(!setting.help.is_empty() && !setting.value.is_empty(), "{}", setting.name);
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(setting.name.chars().all(plain) && !job::PROGRAM.contains(&setting.name), "{}", setting.name);
            for other in setting.needed_by(verb) {
                assert!(names.contains(&other), "{verb:?}: {} needs {other}, which is not there", setting.name);
            }
            for other in setting.excludes {
                let back = verb.setting(other).is_some_and(|other| other.excludes.contains(&setting.name));
                assert!(back, "{verb:?}: {} excludes {other}, but not the other way round", setting.name);
            }
        }
    }
    assert!(SETTINGS.iter().all(|setting| !setting.verbs.is_empty()));
}

/// A long side lies or stands on all that leans; only on a level table none of the sides is the upper one.
#[test]
fn a_long_side_is_refused_where_the_tool_is_vertical_and_nowhere_else() {
    let options = |direction: &str| {
        let given = [("model", "spatial"), ("tool-direction", direction), ("angle", "horizontal")];
        let request = asked(Verb::Place, &given).expect("understood");
        request.place_options(Some(Zone::Rectangle { width: 1.0, height: 0.5 })).map(|options| options.orientation)
    };
    for direction in ["-89", "-87", "-86", "-80", "0", "87"] {
        assert_eq!(options(direction), Ok(Orientation::Fixed(90_f64.to_radians())), "{direction}");
    }
    for direction in ["down", "-90", "up", "90"] {
        let refused = options(direction).expect_err(direction).to_string();
        assert!(refused.starts_with("--angle horizontal and vertical mean the long side on a wall"), "{refused}");
    }
}

#[test]
fn examples_and_defaults_are_understood() {
    for verb in Verb::ALL {
        for setting in verb.settings() {
            let name = setting.name;
            let request = asked(verb, &alone(verb, setting)).unwrap_or_else(|why| panic!("{verb:?}, {name}: {why}"));
            assert!(request.is_given(name));
            if let Absent::Default(text) = setting.absent {
                let mut given = alone(verb, setting);
                given[0].1 = text;
                let explicit = asked(verb, &given).unwrap_or_else(|why| panic!("{verb:?}, {name} {text}: {why}"));
                let implicit = asked(verb, &given[1..]).expect("the same without it");
                assert_eq!(
                    understood(&explicit),
                    understood(&implicit),
                    "{verb:?}: {name} is not {text} where it is left out"
                );
            }
        }
    }
}

/// Everything that a request can be asked for, in words.
fn understood(request: &Request) -> String {
    let mut parts = vec![format!("{:?} {:?}", request.robots(), (request.tasks(), request.flat_task().ok()))];
    let verb = request.verb;
    if [Verb::Rank, Verb::Place, Verb::Map].contains(&verb) {
        let zone = Zone::Rectangle { width: 1.0, height: 2.0 };
        parts.push(format!("{:?} {:?}", request.model(), request.tool_pose()));
        parts.push(format!("{:?} {:?}", request.place_options(Some(zone)).ok(), request.place_options(None).ok()));
    }
    parts.push(format!("{:?}", request.equipped(paper_robots().swap_remove(0))));
    parts.push(format!("{:?} {:?}", request.scale().ok(), request.width_mm()));
    parts.push(match verb {
        Verb::Rank | Verb::List => format!("{:?} {:?}", request.filter(Vec::new()), request.tolerance_mm()),
        Verb::Place => format!("{:?} {:?} {:?}", request.robot().ok(), request.task().ok(), request.tolerance_mm()),
        Verb::Map => {
            let (robot, tolerance) = (request.robot().ok(), request.tolerance_mm());
            let swings = (request.maps_frequency(), request.held_tool().ok());
            let (options, layer) = (request.map_options(), request.layer());
            format!("{robot:?} {tolerance:?} {options:?} {layer:?} {:?} {swings:?}", request.zone())
        }
        Verb::Compliance => {
            let (robot, joints) = (request.robot().ok(), request.joints_deg().ok());
            format!("{robot:?} {joints:?} {:?} {:?}", request.posture_load(), request.tool_pose())
        }
        Verb::Modes => {
            let (robot, joints, tool) = (request.robot().ok(), request.joints_deg().ok(), request.held_tool());
            let zone = request.swinging_zone().ok();
            format!("{robot:?} {joints:?} {tool:?} {:?} {} {zone:?}", request.damping(), request.mode_count())
        }
        Verb::Chatter => {
            let (robot, joints, tool) = (request.robot().ok(), request.joints_deg().ok(), request.held_tool());
            format!(
                "{robot:?} {joints:?} {tool:?} {:?} {:?}",
                request.process().ok(),
                (request.chatter(None).ok(), request.frf())
            )
        }
        Verb::Study => {
            let robot = paper_robots().swap_remove(3);
            format!("{:?} {:?}", request.study(Some(&robot)), request.is_given("robot"))
        }
        Verb::Compare => {
            let side = request.of_robot("BT200L").ok().map(|side| self::understood(&side));
            format!("{:?} {side:?}", ["a", "b"].map(|name| request.is_given(name)))
        }
        Verb::Measure => {
            let (robot, task) = (request.robot().ok(), request.task().ok());
            format!(
                "{robot:?} {task:?} {:?} {:?} {:?} {}",
                request.points(),
                request.measurement_plan(),
                request.compared(),
                request.plans_geometry()
            )
        }
        Verb::Identify => {
            let (data, robot) = (request.data().ok(), request.robot().ok());
            format!("{data:?} {robot:?} {:?} {:?}", request.points(), request.identification())
        }
        Verb::Calibrate => {
            let (data, robot) = (request.data().ok(), request.robot().ok());
            format!("{data:?} {robot:?} {:?} {:?} {:?}", request.reading("KUKA"), request.calibration(), request.date())
        }
        Verb::Verify => {
            let (data, robot, reading) = (request.data().ok(), request.robot().ok(), request.reading("KUKA"));
            let asked = (request.verification(), request.tries_all(), request.date());
            format!("{data:?} {robot:?} {reading:?} {asked:?}")
        }
        Verb::Mill => {
            let (path, format) = (request.path().ok(), request.path_format("a").ok());
            let reading = format!("{} {:?} {:?}", request.is_dry(), request.read_options(), request.steps());
            let (robot, process, acting) = (request.robot().ok(), request.given_process(), request.acting().ok());
            let (at, stock, window) = (
                (request.at(), request.pins(), request.only_tool(), request.tip_of(Some(1))),
                request.stock(),
                request.path_ground().ok(),
            );
            let left = (
                request.is_compensated(),
                request.stiffness_uncertainty(),
                request.tolerance_mm(),
                (request.allows_contact(), request.work_frame(), request.stick_out(None)),
                (request.part(), request.fixture(), request.stl_unit()),
                (request.path_chatter(None).ok(), request.frf()),
            );
            let milling = format!("{robot:?} {process:?} {acting:?} {at:?} {stock:?} {window:?} {left:?}");
            format!("{path:?} {format:?} {reading} {milling} {:?} {:?}", request.mill_options(), request.tool_pose())
        }
        Verb::Force => format!("{:?}", request.process().ok()),
    });
    parts.join(" ")
}

/// An option that nothing reads would be an option that does nothing.
#[test]
fn every_option_changes_what_is_understood() {
    for verb in Verb::ALL {
        for setting in verb.settings() {
            let with = alone(verb, setting);
            // A mass and its centre go together, a zone and its place, a table and what held the tip.
            let go_together = [Verb::Modes, Verb::Chatter, Verb::Map].contains(&verb)
                && ["tool-mass-kg", "tool-com-mm", "task"].contains(&setting.name)
                || ["frf", "frf-on"].contains(&setting.name);
            let left = if go_together { &[] } else { &with[1..] };
            let without = asked(verb, left).expect("the same without it");
            let with = asked(verb, &with).expect("an example");
            assert_ne!(understood(&with), understood(&without), "{verb:?}: {} changes nothing", setting.name);
        }
    }
}

#[test]
fn an_option_of_another_verb_is_refused_in_the_spelling_of_every_reader() {
    let key = Spelling::Key { file: "job.toml".into(), line: Some(3) };
    for verb in Verb::ALL {
        for setting in SETTINGS.iter().filter(|setting| verb.setting(setting.name).is_none()) {
            for at in [Spelling::Typed, Spelling::Keyword, key.clone(), Spelling::Sent] {
                let name = if at == Spelling::Keyword { setting.keyword() } else { setting.name.to_owned() };
                if at == Spelling::Keyword && verb.settings().any(|known| known.keyword() == name) {
                    continue;
                }
                let error = Request::read(verb, &[pair(&name, setting.example, &at)], at.clone()).expect_err("refused");
                assert!(matches!(error, Refusal::Verb { .. }), "{error:?}");
                let text = error.to_string();
                let start = match at {
                    Spelling::Typed => format!("--{name} does not go with {}", verb.name()),
                    Spelling::Keyword | Spelling::Sent => format!("{name} does not go with {}", verb.name()),
                    Spelling::Key { .. } => format!("job.toml:3: {name} does not go with {}", verb.name()),
                };
                assert!(text.starts_with(&start), "{text}");
            }
        }
    }
}

#[test]
fn an_option_of_another_model_is_refused() {
    for verb in [Verb::Rank, Verb::Place, Verb::Map] {
        for setting in verb.settings() {
            let given = alone(verb, setting);
            let without_model: Vec<_> = given.iter().copied().filter(|(name, _)| *name != "model").collect();
            match setting.of {
                Of::Spatial => {
                    let text = asked(verb, &without_model).expect_err("of the spatial model").to_string();
                    assert_eq!(text, format!("--{} needs --model spatial", setting.name));
                }
                Of::Planar => {
                    let text = asked(verb, &[&given[..], &[("model", "spatial")]].concat()).expect_err("planar");
                    assert!(text.to_string().starts_with(&format!("--{} is of the planar", setting.name)), "{text}");
                }
                Of::Any => {}
            }
        }
    }
}

/// What places a zone belongs to the zone, and with it to its model: nobody is sent for an option that is refused then.
#[test]
fn a_map_takes_what_places_a_zone_only_with_one() {
    for (name, text) in [("within", "1..2,.."), ("angle", "30"), ("gap", "0.01")] {
        assert_eq!(asked(Verb::Map, &[(name, text)]).unwrap_err().to_string(), format!("--{name} needs --zone"));
        assert!(asked(Verb::Map, &[(name, text), ("zone", "rect:0.3x0.2")]).is_ok());
        for zone in [&[][..], &[("zone", "A:0.3")]] {
            let given = [&[(name, text), ("model", "spatial")], zone].concat();
            let expected = format!("--{name} is of the planar model; it does not go with --model spatial, in space");
            assert_eq!(asked(Verb::Map, &given).unwrap_err().to_string(), expected);
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused_with_option_value_and_what_is_expected() {
    for (verb, given, expected) in [
        (Verb::Place, &[("forse-n", "1")][..], "--forse-n is no option of place; did you mean force-n?"),
        (Verb::Place, &[("force-n", "1"), ("force-n", "2")], "--force-n is given twice; expected one value"),
        (Verb::Place, &[("force-n", "nan")], "invalid value 'nan' for '--force-n <N>': expected a number from 0.001"),
        (Verb::Map, &[("size", "9"), ("step-m", "0.1")], "--size and --step-m exclude each other; give one of them"),
        (Verb::Map, &[("force-cone-deg", "9")], "--force-cone-deg is the doubt about where a force points"),
        (
            Verb::Compliance,
            &[("force-cone-deg", "9"), ("joints-deg", "1,2,3,4,5,6")],
            "--force-cone-deg needs --force-n",
        ),
        (
            Verb::Map,
            &[("force-cone-deg", "9"), ("force-n", "4")],
            "--force-cone-deg is the doubt about where a force points",
        ),
        (Verb::Map, &[("component", "normal")], "--component normal to the face needs the spatial model"),
        (Verb::Place, &[("force-n", "3,-4,5")], "--force-n pushes with -4 N across the arm plane"),
        (
            Verb::Rank,
            &[("force-n", "3,0,5"), ("direction-deg", "9")],
            "--direction-deg is the direction of a force that",
        ),
        (
            Verb::Place,
            &[("force-n", "3,4")],
            "invalid value '3,4' for '--force-n <N>': expected a number from 0.001 to 1000000 N, or three",
        ),
        (
            Verb::Compliance,
            &[("force-n", "3,4,5"), ("force-axes", "base"), ("feed-deg", "9")],
            "--feed-deg turns nothing",
        ),
        (Verb::Map, &[("elbow", "left")], "invalid value 'left' for '--elbow <ELBOW>': expected up or down"),
        (Verb::Compliance, &[("joints-deg", "1,2")], "--joints-deg has 2 angles; expected six, separated by commas"),
        (Verb::Study, &[("k2", "1,2,3")], "--k2 has 3 values; expected one for both architectures, or two"),
        (Verb::Rank, &[("angle", "vertical")], "--angle horizontal or vertical means the long side of one task; give"),
        (
            Verb::Place,
            &[("task", "circle:0.3"), ("angle", "30")],
            "--angle turns no circle; the feed of a force counts",
        ),
        (Verb::Rank, &[("task", "A:0.3,circle:0.1"), ("angle", "free")], "--angle turns no circle"),
        (Verb::Map, &[("zone", "circle:0.3"), ("angle", "90")], "--angle turns no circle"),
        (Verb::Modes, &[("task", "A:0.3"), ("at", "1,1"), ("angle", "0")], "--angle turns no circle"),
        (
            Verb::Place,
            &[("drive-urad-per-nm", "1,2")],
            "--drive-urad-per-nm has 2 values; expected one for every drive, or six",
        ),
        (
            Verb::Map,
            &[("drive-urad-per-nm", "1e-6")],
            "invalid value '1e-6' for '--drive-urad-per-nm <K>': expected a number from 0.001 to 10000 urad/(N m), or 0",
        ),
        (
            Verb::Rank,
            &[("stiffness-nm-per-rad", "0")],
            "invalid value '0' for '--stiffness-nm-per-rad <K>': expected a number from 100",
        ),
        (
            Verb::Compliance,
            &[("stiffness-nm-per-rad", "1e6"), ("drive-urad-per-nm", "1")],
            "--stiffness-nm-per-rad and --drive-urad-per-nm exclude each other",
        ),
        (Verb::Place, &[("force-n", "1\n2")], "invalid value '1\\n2' for"),
    ] {
        let text = asked(verb, given).unwrap_err().to_string();
        assert!(text.starts_with(expected), "{text}");
    }
    let none = asked(Verb::Place, &[]).expect("nothing is wrong yet");
    assert!(none.task().unwrap_err().to_string().starts_with("--task <TASK> is missing; expected circle:D"));
    assert!(none.robot().unwrap_err().to_string().starts_with("<ROBOT> is missing; expected a robot's name"));
}

#[test]
fn a_stiffness_that_is_given_is_that_of_every_robot() {
    let robot = || paper_robots().swap_remove(4);
    let given = |name: &str, text: &str| asked(Verb::Place, &[(name, text)]).unwrap().equipped(robot());
    // By hand: 1 / (2e6 N m/rad) = 0.5e-6 rad/(N m).
    let softer = given("stiffness-nm-per-rad", "2e6").unwrap();
    assert_eq!(softer.drive_compliance(), [Some(0.5e-6); 6]);
    assert_eq!(softer, given("drive-urad-per-nm", "0.5").unwrap());
    let each = given("drive-urad-per-nm", "0.5,1,0,2,3,4").unwrap();
    assert_eq!(each.drive_compliance(), [0.5e-6, 1e-6, 0.0, 2e-6, 3e-6, 4e-6].map(Some));
    assert_eq!(asked(Verb::Place, &[]).unwrap().equipped(robot()).unwrap(), robot());
    let rigid = given("drive-urad-per-nm", "0").unwrap_err().to_string();
    assert!(
        rigid.starts_with("--drive-urad-per-nm makes no sense of KR 210 R2700 extra: every drive is rigid"),
        "{rigid}"
    );
}

#[test]
fn words_of_the_table_are_the_names_of_what_they_stand_for() {
    let words = |verb: Verb, name: &str| -> Vec<&str> {
        verb.setting(name).expect("a row").kind.words().iter().map(|(word, _)| *word).collect()
    };
    assert_eq!(words(Verb::List, "architecture"), Architecture::ALL.map(Architecture::name));
    assert_eq!(words(Verb::List, "status"), Status::ALL.map(Status::name));
}

fn read_job(text: &str) -> Result<(job::Job, Request), Refusal> {
    let job = job::read(text, Path::new("job.toml"))?;
    let request = Request::read(job.verb, &job.pairs, Spelling::Key { file: "job.toml".into(), line: None })?;
    Ok((job, request))
}

#[test]
fn a_job_says_the_same_with_dashes_tables_and_lists() {
    let typed = asked(
        Verb::Place,
        &[
            ("robot", "BT200L"),
            ("task", "B:0.5"),
            ("force-n", "500"),
            ("model", "spatial"),
            ("tool-mm", "0,0,-200.5"),
            ("tool-direction", "-30"),
            ("yaw-deg", "any"),
            ("within", "1..2,0.5.."),
        ],
    )
    .unwrap();
    let job = "verb = 'place'\nrobot = 'BT200L'\ntask = 'B:0.5'\nforce_n = 5_00.0\nmodel = 'spatial'\nyaw-deg = 'any'\n\
               within = ['1..2', '0.5..']\nthreads = 2\nquiet = true\n[tool]\nmm = [0, 0, -200.5]\ndirection = -30\n";
    let (job, request) = read_job(job).unwrap();
    assert_eq!(understood(&request), understood(&typed));
    let program: Vec<(&str, &str)> = job.program.iter().map(|pair| (pair.name.as_str(), pair.text.as_str())).collect();
    assert_eq!(program, [("threads", "2"), ("quiet", "true")]);
}

#[test]
fn a_fault_of_a_job_names_file_line_key_value_and_what_was_expected() {
    for (text, expected) in [
        ("task = 'A:0.1'", "job.toml: verb is missing; expected rank, place, map, compliance, modes, chatter, study"),
        ("verb = 'plaice'", "job.toml:1: invalid value 'plaice' for 'verb': expected rank, place"),
        ("verb = 'rank'\ntask = [", "job.toml:2: "),
        ("verb = 'rank'\n\nforcen = 1", "job.toml:3: forcen is no option of rank; did you mean force-n?"),
        (
            "verb = 'rank'\nforce-n = '1'",
            "job.toml:2: invalid value '1' for 'force-n': expected a number, without quotes",
        ),
        ("verb = 'rank'\ntask = 1", "job.toml:2: invalid value '1' for 'task': expected a text in quotes"),
        ("verb = 'rank'\nforce-n = true", "job.toml:2: invalid value 'true' for 'force-n': expected a number"),
        ("verb = 'rank'\nforce-n = [1, 2]", "job.toml:2: invalid value '1,2' for 'force-n': expected a number from"),
        ("verb = 'rank'\ntask = []", "job.toml:2: invalid value 'a list' for 'task': expected at least one value"),
        ("verb = 'rank'\nforce-n = nan", "job.toml:2: invalid value 'nan' for 'force-n': expected a number from"),
        ("verb = 'rank'\nforce-n = 0x10", "job.toml:2: invalid value '10' for 'force-n': expected a number"),
        ("verb = 'rank'\nforce-n = 1\nforce_n = 1", "job.toml:3: force-n is given twice"),
        ("verb = 'rank'\ntool-mm = [0,0,100]\n[tool]\nmm = [0,0,2]", "job.toml:4: tool-mm is given twice"),
        ("verb = 'rank'\n[cell]\nfloor-m = 0", "job.toml:3: floor-m is no option of rank"),
        ("verb = 'study'\n[tool]\nmm = [0,0,2]", "job.toml:3: tool-mm does not go with study"),
        ("verb = 'rank'\ntool-mm = [0,0,100]", "job.toml:2: tool-mm needs model = \"spatial\""),
        ("verb = 'rank'\n\"a\\nb\" = 1", "job.toml:2: a\\nb is no option of rank"),
    ] {
        let text = read_job(text).unwrap_err().to_string();
        assert!(text.starts_with(expected), "{text}\n{expected}");
    }
}

#[test]
fn only_a_file_with_a_verb_at_its_top_is_a_job() {
    assert!(job::is_job("verb = 'rank'") && job::is_job("\"verb\" = 1") && job::is_job("verb = 'rank'\ntask = ["));
    assert!(!job::is_job("name = 'a'\n[source]\nverb = 'rank'") && !job::is_job("name = [\n[source]\nverb = 1"));
}

#[test]
fn robots_in_a_job_count_from_its_folder_and_names_stay_names() {
    let text = "verb = 'rank'\nrobots = ['mine.toml', 'M-900iA/200P', 'KR*/x', 'all', 'cell/', '/a/b.urdf', 'BT200L']\n\
                output = 'rank.png'";
    let job = job::read(text, Path::new("jobs/job.toml")).unwrap();
    let robots: Vec<&str> = job.pairs.iter().map(|pair| pair.text.as_str()).collect();
    assert_eq!(robots, ["jobs/mine.toml", "M-900iA/200P", "KR*/x", "all", "jobs/cell/", "/a/b.urdf", "BT200L"]);
    assert_eq!(job.program[0].text, "jobs/rank.png");
}

/// Some options of a verb that go together, with values as people may write them.
fn questions() -> impl Strategy<Value = (Verb, Vec<(&'static str, String)>)> {
    let verb = prop::sample::select(Verb::jobs().collect::<Vec<_>>());
    (verb, prop::collection::vec(any::<bool>(), 40), any::<bool>(), -1e3..1e3_f64).prop_map(
        |(verb, picks, spatial, x)| {
            let mut given: Vec<(&'static str, String)> = Vec::new();
            let wanted = verb.settings().zip(picks).filter(|(_, pick)| *pick).map(|(setting, _)| setting);
            for setting in wanted.filter(|setting| setting.name != "model") {
                given.extend(alone(verb, setting).into_iter().map(|(name, text)| (name, text.to_owned())));
            }
            let of_numbers =
                [("force-n", x.abs() + 1e-3), ("roll-deg", x / 3.0), ("angle", x / 3.0), ("direction-deg", x / 3.0)];
            for (name, text) in &mut given {
                if let Some((_, x)) = of_numbers.iter().find(|(known, _)| known == name && verb != Verb::Compliance) {
                    *text = format!(" {x:e} ");
                }
            }
            if spatial && verb.setting("model").is_some() {
                given.push(("model", "spatial".into()));
            }
            let mut once: Vec<(&'static str, String)> = Vec::new();
            for one in given {
                if once.iter().all(|(name, _)| *name != one.0) {
                    once.push(one);
                }
            }
            (verb, once)
        },
    )
}

/// Whether a question that can be asked is asked once more, to the letter, by the job file that is written of it.
fn same_once_saved(verb: Verb, given: &[(&'static str, String)]) -> Result<(), TestCaseError> {
    let pairs: Vec<(&str, &str)> = given.iter().map(|(name, text)| (*name, text.as_str())).collect();
    if let Ok(request) = asked(verb, &pairs) {
        let text = job::write(&request, &[], Path::new("job.toml"));
        let (_, again) = read_job(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        prop_assert_eq!(understood(&again), understood(&request), "{}", text);
        prop_assert_eq!(job::write(&again, &[], Path::new("job.toml")), text);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn a_saved_job_asks_exactly_the_same((verb, given) in questions()) {
        same_once_saved(verb, &given)?;
    }
}

#[test]
fn a_saved_job_without_options_asks_the_same() {
    for verb in Verb::jobs() {
        same_once_saved(verb, &[]).unwrap();
    }
}
