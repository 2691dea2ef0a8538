//! Is every table of measurements that makes no sense refused, with the row, the column and what was expected?

use stiffarm::catalogue::measurements::{Points, read};

const HEAD: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,fx_n,fy_n,fz_n,dx_mm,dy_mm,dz_mm";
const ROWS: [&str; 3] = [
    "0,-90,90,0,45,0,500,0,0,1.1,0.2,-0.1",
    "20,-80,85,10,-45,5,0,600,0,0.1,2.2,-0.1",
    "-30,-70,60,20,50,9,0,0,-700,0.3,0.2,-1.1",
];

fn table(head: &str, rows: &[&str]) -> String {
    format!("{head}\n{}\n", rows.join("\n"))
}

fn refused(text: &str) -> String {
    read(text, "t.csv", &Points::default()).expect_err("refused").to_string()
}

#[test]
fn a_table_that_makes_sense_is_read_in_any_unit_and_with_any_delimiter() {
    let usual = read(&table(HEAD, &ROWS), "t.csv", &Points::default()).unwrap();
    assert_eq!(usual.readings.len(), 3);
    assert_eq!((usual.readings[2].row, usual.readings[2].posture), (3, 2));
    assert!((usual.readings[0].q[1] + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((usual.readings[0].moved.x - 1.1e-3).abs() < 1e-18);
    assert!(usual.remarks[0].contains("the flange centre is taken"), "{:?}", usual.remarks);
    for other in [
        table(HEAD, &ROWS).replace(',', ";"),
        table(HEAD, &ROWS).replace(',', "\t"),
        format!("# measured on a Monday\n{}", table(&HEAD.to_uppercase(), &ROWS)),
        table(
            &HEAD.replace("_mm", "_um"),
            &ROWS.map(|row| row.replace(",1.1,0.2,-0.1", ",1100,200,-100")).each_ref().map(String::as_str),
        )
        .replace("0.1,2.2,-0.1", "100,2200,-100")
        .replace("0.3,0.2,-1.1", "300,200,-1100"),
    ] {
        let found = read(&other, "t.csv", &Points::default()).unwrap();
        for (a, b) in found.readings.iter().zip(&usual.readings) {
            assert!((a.moved - b.moved).norm() < 1e-15 && a.q == b.q && a.load == b.load, "{other}");
        }
    }
    let again = ROWS[1].replace("0.1,2.2,-0.1", "0.1,2.3,-0.1");
    let named = format!("posture,{HEAD}\na,{}\np,{}\np,{again}\n", ROWS[0], ROWS[1]);
    let postures: Vec<usize> =
        read(&named, "t.csv", &Points::default()).unwrap().readings.iter().map(|one| one.posture).collect();
    assert_eq!(postures, [0, 1, 1]);
    let elsewhere = refused(&format!("posture,{HEAD}\na,{}\np,{}\np,{}\n", ROWS[0], ROWS[1], ROWS[2]));
    assert!(
        elsewhere.contains("t.csv:4: row 3, posture: is that of row 2, and its joints are up to 95.0 deg"),
        "{elsewhere}"
    );
}

#[test]
fn every_fault_is_named_with_its_row_and_column() {
    let cell = |from: &str, to: &str| table(HEAD, &ROWS).replacen(from, to, 1);
    for (text, expected) in [
        (cell("600", "nan"), "t.csv:3: row 2, fy_n: nan is no number that can be measured"),
        (cell("600", "inf"), "t.csv:3: row 2, fy_n: inf is no number"),
        (cell("600", "6OO"), "t.csv:3: row 2, fy_n: '6OO' is not a number"),
        (cell("600", ""), "t.csv:3: row 2, fy_n: the cell is empty"),
        (cell("600", "6e7"), "t.csv:3: row 2, fy_n: 60000000; expected a number from -1000000 to 1000000"),
        (cell("500,0,0,", "0,0,0,"), "t.csv:2: row 1, fx_n: no load: fx_n, fy_n and fz_n are all 0"),
        (cell("2.2", "2000"), "t.csv:3: row 2, dy_mm: 2000; expected a number from -1000 to 1000"),
        (cell("-80", "2000"), "t.csv:3: row 2, q2_deg: 2000; expected a number from -1080 to 1080"),
        (cell("600,", ""), "t.csv:3: row 2: 11 cells; expected 12, as many as headings"),
        // Each row has its own number, and a comma is no decimal point between commas.
        (
            table(HEAD, &[&format!("{},5", ROWS[0]), &format!("{},5", ROWS[1])]),
            "t.csv:2: row 1: 13 cells; expected 12, as many as headings; decimal commas go with semicolons between the cells\nt.csv:3: row 2: 13",
        ),
        (
            cell("fz_n", "fz"),
            "t.csv:1: fz_n: the column is missing; expected fx_n, fy_n, fz_n, the force on the load point in N; is it the column fz?",
        ),
        (cell("q4_deg", "a4"), "t.csv:1: q4_deg: the column is missing; expected q1_deg"),
        (cell("dz_mm", "dx_mm"), "t.csv:1: dx_mm: stands twice"),
        (cell("q6_deg", "q6_rad"), "t.csv:1: q1_rad: beside q1_deg: expected joint angles in one unit"),
        (cell("dz_mm", "dz_um"), "t.csv:1: dx_um: beside the same in another unit"),
        (table(HEAD, &[ROWS[0], ROWS[1], ROWS[0]]), "t.csv:4: row 3: repeats row 1 in every number"),
        (table(HEAD, &[ROWS[0], &ROWS[0].replace("500", "400")]), "t.csv:2: 2 rows, all of one posture"),
        (table(HEAD, &[]), "t.csv:1: no row holds a measurement"),
        (String::new(), "t.csv:1: the table is empty; expected a line of headings"),
        (table(&format!("{HEAD},sigma_mm"), &[&format!("{},0", ROWS[0])]), "t.csv:2: row 1, sigma_mm: is not positive"),
        (
            table(&format!("{HEAD},sigma_um"), &[&format!("{},5", ROWS[0])]),
            "t.csv:1: sigma_um: in another unit; expected sigma_mm",
        ),
        (
            table(&format!("{HEAD},marker_x_m"), &[&format!("{},5", ROWS[0])]),
            "t.csv:1: marker_x_m: in another unit; expected marker_x_mm",
        ),
        (
            table(&format!("{HEAD},mx_knm"), &[&format!("{},5", ROWS[0])]),
            "t.csv:1: mx_knm: in another unit; expected mx_nm",
        ),
        (
            table(&format!("{HEAD},load_x_mm"), &[&format!("{},0", ROWS[0])]),
            "t.csv:1: load_y_mm: the column is missing",
        ),
    ] {
        let found = refused(&text);
        assert!(found.starts_with(expected), "{found}\n is not\n{expected}");
    }
}

/// By a thousand, or by 57: nobody is answered with numbers that are as wrong.
#[test]
fn units_that_are_wrong_by_all_appearance_are_asked_for() {
    let rows = |scale: f64, angle: f64| {
        let of = |row: &str| {
            let cells = row.split(',').enumerate().map(|(i, cell)| {
                let number: f64 = cell.parse().unwrap();
                (number
                    * if i < 6 {
                        angle
                    } else if 9 <= i {
                        scale
                    } else {
                        1.0
                    })
                .to_string()
            });
            cells.collect::<Vec<_>>().join(",")
        };
        table(HEAD, &ROWS.map(of).each_ref().map(String::as_str))
    };
    let metres = refused(&rows(1e-3, 1.0));
    assert!(
        metres.contains("half of the rows move less than") && metres.contains("name the columns dx_um or dx_m"),
        "{metres}"
    );
    let micrometres = refused(&rows(900.0, 1.0).replace("1980", "900"));
    assert!(micrometres.contains("half of the rows move more than"), "{micrometres}");
    let radians = refused(&rows(1.0, 0.0174));
    assert!(
        radians.contains("q1_deg to q6_deg: no angle of any row is beyond 1.566 deg: are these radians?"),
        "{radians}"
    );
    let degrees = refused(&table(&HEAD.replace("_deg", "_rad"), &ROWS));
    assert!(degrees.starts_with("t.csv:2: row 1, q2_rad: -90 rad is -14.3 turns: are these degrees?"), "{degrees}");
    let still = refused(&rows(0.0, 1.0));
    assert!(still.contains("displacements of 0; were they measured?"), "{still}");
}
