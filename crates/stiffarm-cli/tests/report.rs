//! Is a report one whole file that asks for nothing, says what the answer says, and harms nobody whatever a robot is called?

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

use assert_cmd::Command;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use lopdf::Document;
use scraper::{Html, Selector};
use serde_json::Value;
use sha2::{Digest, Sha256};
use tempfile::TempDir;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// A file that is handed on by mail, bytes.
const MOST_BYTES: usize = 2_000_000;

/// What is asked of every verb that makes a report.
const ASKED: [(&str, &[&str]); 6] = [
    ("rank", &["rank"]),
    (
        "space",
        &[
            "place",
            "KR 210 R2700 extra",
            "--task",
            "rect:0.6x0.4",
            "--model",
            "spatial",
            "--tool-mm",
            "0,0,200",
            "--within",
            "1.0..,0.5..",
            "--tolerance-mm",
            "3",
        ],
    ),
    ("plane", &["place", "BT200L", "--task", "rect:0.5x1.0", "--within", "1.2..,0.4..1.8", "--tolerance-mm", "3.5"]),
    (
        "mill",
        &[
            "mill",
            "raster:rect:0.3x0.2@0.05",
            "--robot",
            "KR 210 R2700 extra",
            "--force-n",
            "300,-120,80",
            "--tool",
            "spindle:250@90",
            "--at",
            "1.6,0,0.8,0",
            "--tolerance-mm",
            "0.3",
            "--compensate",
        ],
    ),
    (
        "identify",
        &[
            "identify",
            "docs/examples/fanuc_r2000ic.csv",
            "--robot",
            "docs/examples/fanuc_r2000ic.toml",
            "--load-mm",
            "6.9,245.3,319.3",
        ],
    ),
    ("calibrate", &["calibrate", "KR 210 R2700 extra", "docs/examples/tracker.csv", "--at", "1.8,0,0.8"]),
];

/// Exit code, standard output and standard error of a run.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut program = Command::cargo_bin("stiffarm").expect("built by cargo");
    let output = program.current_dir(folder).args(arguments).output().expect("runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (output.status.code().expect("an exit code"), text(output.stdout), text(output.stderr))
}

/// The file that a run writes under this name, byte by byte.
fn written(asked: &[&str], name: &str) -> Vec<u8> {
    let [bytes] = all_written(asked, [name]);
    bytes
}

/// Files of one answer: what takes long is asked once.
fn all_written<const N: usize>(asked: &[&str], names: [&str; N]) -> [Vec<u8>; N] {
    let folder = TempDir::new().expect("a folder");
    let files = names.map(|name| folder.path().join(name));
    let mut words = [asked, &["-q"]].concat().into_iter().map(str::to_owned).collect::<Vec<_>>();
    words.extend(files.iter().flat_map(|file| ["-o".into(), file.to_string_lossy().into_owned()]));
    let (code, _, errors) = run(Path::new(ROOT), &words.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(code, 0, "{asked:?}: {errors}");
    files.map(|file| fs::read(file).expect("written"))
}

/// The report of a question, which is asked once for all tests.
fn page(asked: &[&str]) -> String {
    static PAGES: Mutex<BTreeMap<String, String>> = Mutex::new(BTreeMap::new());
    let known = || PAGES.lock().expect("no test ends within");
    let question = asked.join(" ");
    if let Some(page) = known().get(&question) {
        return page.clone();
    }
    let page = String::from_utf8(written(asked, "report.html")).expect("text");
    known().insert(question, page.clone());
    page
}

fn json(asked: &[&str]) -> Value {
    let (code, out, errors) = run(Path::new(ROOT), &[asked, &["-q", "--format", "json"]].concat());
    assert_eq!(code, 0, "{asked:?}: {errors}");
    serde_json::from_str(&out).expect("JSON")
}

fn texts(page: &Html, selector: &str) -> Vec<String> {
    let selector = Selector::parse(selector).expect("a selector");
    page.select(&selector).map(|found| found.text().collect::<String>().trim().to_owned()).collect()
}

/// All that a reader reads.
fn read(page: &str) -> String {
    texts(&Html::parse_document(page), "body").concat()
}

/// The verdict in a word.
fn verdict(asked: &[&str]) -> (String, String) {
    let page = Html::parse_document(&page(asked));
    let word = texts(&page, ".verdict .word").concat();
    (word, texts(&page, ".verdict p").join(" "))
}

#[test]
fn every_report_is_one_whole_page_that_asks_for_nothing() {
    for (name, asked) in ASKED {
        let text = page(asked);
        assert!(text.len() < MOST_BYTES, "{name}: {} bytes", text.len());
        let page = Html::parse_document(&text);
        assert!(page.errors.is_empty(), "{name}: {:?}", page.errors);
        let mut ids = Vec::new();
        for element in page.tree.values().filter_map(|node| node.as_element()) {
            assert!(
                !["link", "img", "iframe", "object", "embed", "image", "use", "a:href"].contains(&element.name()),
                "{name}"
            );
            for (key, value) in element.attrs() {
                assert!(
                    !key.starts_with("on") && !["src", "srcset", "style", "action"].contains(&key),
                    "{name}: {key}"
                );
                assert!(key != "href" || value.starts_with('#'), "{name}: {value}");
                assert!(!value.contains("url(") || value.starts_with("url(#f"), "{name}: {value}");
                if key == "id" {
                    ids.push(value.to_owned());
                }
            }
        }
        let count = ids.len();
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), count, "{name}: an id stands twice");
        for target in text.split("url(#").skip(1).chain(text.split("href=\"#").skip(1)) {
            let target: String = target.chars().take_while(char::is_ascii_alphanumeric).collect();
            assert!(ids.contains(&target), "{name}: {target}");
        }
        let style = texts(&page, "style").concat();
        assert!(!style.contains("url(") && !style.contains("@import"));
    }
}

#[test]
fn the_policy_of_a_page_knows_its_style_and_its_script_and_lets_nothing_else_run() {
    let text = page(ASKED[2].1);
    let page = Html::parse_document(&text);
    let policy = Selector::parse("meta[http-equiv=Content-Security-Policy]").expect("a selector");
    let policy = page.select(&policy).next().expect("a policy").attr("content").expect("a content").to_owned();
    let inside = |tag: &str| {
        let start = text.find(&format!("<{tag}>")).expect("it has one") + tag.len() + 2;
        &text[start..text.find(&format!("</{tag}>")).expect("it ends")]
    };
    for tag in ["style", "script"] {
        let digest = BASE64_STANDARD.encode(Sha256::digest(inside(tag)));
        let expected = format!("{tag}-src 'sha256-{digest}'");
        assert!(policy.contains(&expected), "put '{digest}' into report/html.rs, of the {tag}: {policy}");
        assert_eq!(texts(&page, tag).len(), 1);
    }
    assert!(policy.starts_with("default-src 'none';") && !policy.contains("unsafe"), "{policy}");
}

#[test]
fn a_ranking_has_every_robot_and_every_number_in_the_digits_of_its_table() {
    let (asked, answer) = (ASKED[0].1, json(ASKED[0].1));
    let text = read(&page(asked));
    let rows = answer["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 10);
    for row in rows {
        let name = format!("{} {}", row["vendor"].as_str().unwrap(), row["robot"].as_str().unwrap());
        // In the ranking, over its own part, and where its numbers come from.
        assert!(3 <= text.matches(&name).count(), "{name}");
        for cell in row["cells"].as_array().expect("cells") {
            for (key, digits) in
                [("deflection_mm", 3), ("lower_bound_mm", 3), ("x_m", 3), ("z_m", 3), ("smallest_margin_deg", 1)]
            {
                let number = cell[key].as_f64().unwrap_or_else(|| panic!("{name}: {key}"));
                let rounded = format!("{number:.digits$}").replace("-0.000", "0.000");
                assert!(text.contains(&rounded), "{name}: {key} {rounded}");
            }
        }
    }
    for sentence in answer["summary"].as_array().expect("sentences") {
        assert!(text.contains(sentence.as_str().unwrap()), "{sentence}");
    }
    assert!(text.contains("Serial or quasi-serial?") && text.contains("is better below d/(l2+l3) = "));
    assert!(text.contains("joint-1 axis to its near edge"));
    // Places stand in each robot's part, and in no narrow column beside the values.
    assert!(1 < rows[0]["cells"].as_array().expect("cells").len() && !text.contains("at [m, deg]"));
}

#[test]
fn a_place_a_path_and_an_identification_have_their_numbers() {
    let fixed = |value: &Value, digits: usize| format!("{:.digits$}", value.as_f64().expect("a number"));
    for (_, asked) in &ASKED[1..3] {
        let (text, answer) = (read(&page(asked)), json(asked));
        for (key, digits) in
            [("deflection_mm", 4), ("lower_bound_mm", 4), ("margin_mm", 4), ("x_m", 4), ("z_m", 4), ("clearance_mm", 0)]
        {
            assert!(text.contains(&fixed(&answer[key], digits)), "{key} {}", answer[key]);
        }
        let height = format!("{:.1} mm", answer["z_m"].as_f64().unwrap() * 1e3);
        // The face of the one lies level, that of the other stands, half a metre up and down.
        let lowest = format!("{:.1} mm", answer["z_m"].as_f64().unwrap() * 1e3 - 500.0);
        assert!(text.contains(&height) || text.contains(&lowest), "{height}");
    }
    let (text, answer) = (read(&page(ASKED[3].1)), json(ASKED[3].1));
    for (key, digits) in [("worst_mm", 4), ("rms_mm", 4), ("lower_bound_mm", 4), ("roll_lower_bound_mm", 4)] {
        assert!(text.contains(&fixed(&answer[key], digits)), "{key} {}", answer[key]);
    }
    for share in answer["worst_shares"].as_array().expect("shares") {
        // What rounds to zero has no sign.
        let percent = format!("{:.1} %", 100.0 * share.as_f64().unwrap()).replace("-0.0", "0.0");
        assert!(text.contains(&percent), "{percent}");
    }
    let (text, answer) = (read(&page(ASKED[4].1)), json(ASKED[4].1));
    for drive in answer["drives"].as_array().expect("drives") {
        let urad: f64 = format!("{:.2e}", drive["compliance_urad_per_nm"].as_f64().expect("found")).parse().unwrap();
        assert!(text.contains(&urad.to_string()), "{urad}");
    }
    let outliers = answer["outliers"].as_array().expect("outliers");
    assert!(!outliers.is_empty() && text.contains("What does not fit") && text.contains("6.8 sigma"));
    assert!(text.contains("status = \"identified\""), "the robot file stands in it");
}

/// A box of 100 mm whose top and front are machined.
#[test]
fn a_part_has_its_shop_drawing() {
    let robot = ["place", "KR 210 R2700 extra", "--model", "spatial", "--tool", "spindle:250@90", "--force-n", "400"];
    let asked = [&robot[..], &["--task", "box:0.4x0.3x0.1", "--faces", "top,front"]].concat();
    let [page, drawn, answer] = all_written(&asked, ["report.html", "shop.svg", "answer.json"]);
    let answer: Value = serde_json::from_slice(&answer).expect("JSON");
    let z_mm = answer["z_m"].as_f64().unwrap() * 1e3;
    let text = read(&String::from_utf8(page).expect("text"));
    for words in [
        "height of the middle of its underside above the base",
        &format!("{z_mm:.1} mm"),
        "the part's x axis from straight ahead, counterclockwise from above",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let drawn = String::from_utf8(drawn).unwrap();
    for length in [format!(">{z_mm:.1}<"), ">100.0<".into(), ">x<".into()] {
        assert!(drawn.contains(&length), "{length}: {drawn}");
    }
}

#[test]
fn the_verdict_is_in_words_and_by_how_much() {
    let place = |tolerance: &'static str, task: &'static str| {
        verdict(&["place", "BT200L", "--task", task, "--within", "1.2..,0.4..1.8", "--tolerance-mm", tolerance])
    };
    let (word, says) = place("3.5", "rect:0.5x1.0");
    // Nothing is known of drives that are assumed.
    assert!(word == "pass, not sure" && says.contains("nothing is known of the drives"), "{word}: {says}");
    assert!(
        says.contains("holds 3.5 mm on rect:0.5x1.0: 3.1963 mm at worst") && says.contains("0.3037 mm less"),
        "{says}"
    );
    let (word, says) = place("3", "rect:0.5x1.0");
    assert_eq!(word, "fail");
    assert!(says.contains("does not hold 3 mm") && says.contains("0.1963 mm more"), "{says}");
    assert!(says.contains("none has less than 3.1960 mm, which is proved"), "{says}");
    let (word, says) = place("3", "rect:5x5");
    assert!(word == "no place" && says.contains("has no place for rect:5x5: "), "{word}: {says}");
    // Drives as published may be softer by more than the tolerance leaves.
    let (word, says) = verdict(ASKED[1].1);
    assert_eq!(word, "pass, not sure");
    assert!(says.contains("the 90 % interval (drive stiffness) is 1.008 to 3.352 mm"), "{says}");
    let twins = "IRB 7600-400/2.55,IRB 7600-500/2.55";
    let (word, says) = verdict(&["rank", "--robots", twins, "--task", "B:0.5"]);
    assert!(word == "tie" && says.contains("no robot is advised") && !says.contains("Proved at"), "{word}: {says}");
    let (word, says) = verdict(ASKED[0].1);
    assert_eq!(word, "advised");
    // IRB 6650S-200 on C:0.15 against the bound of KR 210: 1.7839 / 1.7193 = 1.0375.
    assert!(says.contains("every other robot gives way at least 3.7 % more"), "{says}");
    let (word, says) = verdict(&["rank", "--tolerance-mm", "1"]);
    assert!(
        word == "fail" && says.contains("No robot of published geometry holds 1 mm on every task"),
        "{word}: {says}"
    );
    assert_eq!(verdict(&["rank", "--tolerance-mm", "9"]).0, "pass, not sure");
    let (word, says) = verdict(&["rank", "--task", "rect:9x9"]);
    assert!(word == "no place", "{word}: {says}");
    // Who compensates mills what is left: 0.196 mm in the median of the draws, and not 0.504.
    let (word, says) = verdict(ASKED[3].1);
    assert!(word == "pass, not sure" && says.contains("does not hold 0.3 mm along"), "{word}: {says}");
    assert!(says.contains("without compensation: ") && says.contains("Compensated, "), "{says}");
    let (_, uncompensated) = ASKED[3].1.split_last().expect("an option");
    let (word, says) = verdict(uncompensated);
    assert!(word == "fail" && says.contains("Turning the tool does not help"), "{word}: {says}");
    // A bound of some rolls says nothing of the others.
    for (option, value, bounded) in [
        ("--roll", "constant", "proved lower bound of constant rolls is"),
        ("--roll", "150", "lower bound at this roll is"),
        ("--pin", "100@150", "lower bound of rolls through the pins is"),
    ] {
        let (word, says) = verdict(&[uncompensated, &[option, value]].concat());
        assert!(word == "fail" && says.contains(bounded) && says.contains("other rolls may"), "{option}: {says}");
        assert!(!says.contains("does not help"), "{option}: {says}");
    }
    let mut beyond = ASKED[3].1.to_vec();
    beyond[9] = "9,0,0.8,0";
    assert_eq!(verdict(&beyond).0, "not followed");
    let (word, says) = verdict(ASKED[4].1);
    assert!(word == "identified in part" && says.contains("5 of 6 compliances"), "{word}: {says}");
}

#[test]
fn a_name_is_a_name_whatever_it_holds() {
    const NAME: &str = "<script>alert(1)</script><img src=x onerror=alert(2)>\" onload='x' & ]]> </style></title> url(#clip1) `$(x)` é中";
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("mine.toml");
    let (code, _, errors) = run(Path::new(ROOT), &["robots", "show", "BT200L", "-q", "-o", &file.to_string_lossy()]);
    assert_eq!(code, 0, "{errors}");
    let text = fs::read_to_string(&file).expect("written");
    fs::write(&file, text.replacen("BT200L", &NAME.replace('"', "\\\""), 1)).expect("a file");
    let file = file.to_string_lossy().into_owned();
    for asked in [
        &["place", &file, "--task", "A:0.3", "--tolerance-mm", "3"][..],
        &["rank", "--robots", &file, "--task", "A:0.3"],
        &["mill", "circle:0.2", "--robot", &file, "--force-n", "300", "--at", "1.6,0,0.8,0"],
    ] {
        let text = page(asked);
        let page = Html::parse_document(&text);
        assert_eq!([texts(&page, "script").len(), texts(&page, "style").len(), texts(&page, "img").len()], [1, 1, 0]);
        for element in page.tree.values().filter_map(|node| node.as_element()) {
            assert!(element.attrs().all(|(key, _)| !key.starts_with("on")), "{asked:?}: {element:?}");
        }
        assert!(page.errors.is_empty(), "{:?}", page.errors);
        assert!(texts(&page, "title")[0].contains(NAME) && texts(&page, "h1").concat().contains(NAME), "{asked:?}");
        let paper = Document::load_mem(&written(asked, "a-report.pdf")).expect("a PDF");
        assert!(paper.extract_text(&[1]).expect("text").replace('\n', "").contains("<script>alert(1)</script>"));
    }
}

#[test]
fn what_stands_at_the_end_asks_the_same_again() {
    for (name, asked) in ASKED {
        let page = Html::parse_document(&page(asked));
        let code = texts(&page, "pre");
        let [.., command, job] = code.as_slice() else { panic!("{name}: no command") };
        let answer = json(asked);
        let folder = TempDir::new().expect("a folder");
        // Files in a job count from its folder.
        std::os::unix::fs::symlink(Path::new(ROOT).join("docs"), folder.path().join("docs")).expect("a link");
        fs::write(folder.path().join("job.toml"), job).expect("a file");
        let verb = asked[0];
        let (code, out, errors) = run(folder.path(), &[verb, "job.toml", "-q", "--format", "json"]);
        assert_eq!(code, 0, "{name}: {errors}");
        assert_eq!(serde_json::from_str::<Value>(&out).expect("JSON"), answer, "{name}: {job}");
        let program = assert_cmd::cargo::cargo_bin("stiffarm");
        let line = format!("stiffarm() {{ '{}' \"$@\" -q --format json; }}; {command}", program.display());
        let output =
            std::process::Command::new("sh").args(["-c", &line]).current_dir(folder.path()).output().expect("runs");
        assert!(output.status.success(), "{name}: {command}: {}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(serde_json::from_slice::<Value>(&output.stdout).expect("JSON"), answer, "{name}: {command}");
    }
}

#[test]
fn a_long_ranking_has_ten_parts_and_says_so() {
    let asked = ["rank", "--vendor", "KUKA", "--payload-kg", "100..", "--task", "A:0.5"];
    let (page, answer) = (page(&asked), json(&asked));
    let all = answer["rows"].as_array().expect("rows").len();
    assert!(12 < all && page.len() < MOST_BYTES, "{all} {}", page.len());
    let text = read(&page);
    assert!(text.contains(&format!("{} more robots have no part of their own here", all - 10)), "{all}");
    let page = Html::parse_document(&page);
    // A row for each in the ranking, which is sorted where there are scripts.
    assert_eq!(texts(&page, "table.sortable tbody tr").len(), all);
    let best = answer["winners"][0]["best"].as_str().expect("a winner").to_owned();
    assert!(texts(&page, "h2").iter().any(|heading| heading.ends_with(&best)), "{best} has a part");
}

#[test]
fn on_paper_it_has_pages_and_its_texts_are_texts() {
    for (name, asked) in ASKED {
        let bytes = written(asked, "report.pdf");
        assert!(bytes.len() < MOST_BYTES, "{name}: {}", bytes.len());
        let paper = Document::load_mem(&bytes).expect("a PDF");
        let pages: Vec<u32> = paper.get_pages().into_keys().collect();
        assert!(3 < pages.len(), "{name}: {} pages", pages.len());
        let texts: Vec<String> = pages.iter().map(|&page| paper.extract_text(&[page]).expect("text")).collect();
        for (page, text) in pages.iter().zip(&texts) {
            assert!(text.contains(&format!("{page} / {}", pages.len())), "{name}: {page}");
        }
        let (word, says) = verdict(asked);
        let blank = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let first = blank(&texts[0]);
        assert!(first.contains(&word.to_uppercase()) && first.contains(&blank(&says)), "{name}: {first}");
        let all = texts.concat();
        for text in
            ["What this rests on", "Where the numbers come from", "To ask the same again", "verb = ", "checked by"]
        {
            assert!(all.contains(text), "{name}: {text}");
        }
    }
}

#[test]
fn the_view_that_can_be_turned_has_its_own_name_and_figures_keep_theirs() {
    let place = ["place", "BT200L", "--task", "A:0.3"];
    for name in ["view.html", "a.view.html", "A.VIEW.HTML"] {
        assert!(String::from_utf8(written(&place, name)).expect("text").contains("Plotly.newPlot"), "{name}");
    }
    for name in ["a.html", "review.html", "view.a.html"] {
        let text = String::from_utf8(written(&place, name)).expect("text");
        assert!(!text.contains("Plotly") && text.contains("class=\"verdict"), "{name}");
    }
    let map = ["map", "BT200L", "--size", "40"];
    for name in ["a.html", "a.view.html"] {
        assert!(String::from_utf8(written(&map, name)).expect("text").contains("Plotly.newPlot"), "{name}");
    }
    let pages = |name: &str| Document::load_mem(&written(&place, name)).expect("a PDF").get_pages().len();
    assert_eq!(["a.pdf", "myreport.pdf", "report.figure.pdf"].map(pages), [1, 1, 1]);
    assert!(["report.pdf", "a.report.pdf", "a-report.pdf"].iter().all(|name| 1 < pages(name)));
    // A map has no report, and its figure is none.
    let folder = TempDir::new().expect("a folder");
    let (code, _, errors) = run(folder.path(), &[&map[..], &["-o", "report.pdf"]].concat());
    assert!(code == 2 && errors.contains("map cannot write report.pdf"), "{errors}");
    let (code, _, errors) = run(folder.path(), &["rank", "--task", "A:0.3", "-o", "view.html"]);
    assert!(code == 2 && errors.contains("rank cannot write view.html: expected a name that ends in"), "{errors}");
    assert!(errors.contains(".html") && errors.contains("report.pdf"), "{errors}");
    let (code, _, errors) = run(folder.path(), &["compare", "BT200L", "ZX200U", "--task", "A:0.3", "-o", "x.html"]);
    assert!(code == 2 && errors.contains("compare cannot write x.html"), "{errors}");
}
