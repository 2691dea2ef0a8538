//! Lines of a toolpath a second, one thread: what a user waits for before anything is computed.

use std::fmt::Write as _;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use stiffarm::toolpath::{Format, ReadOptions, Steps, Survey, read};

const LINES: usize = 1_000_000;

/// A surface in short lines with an arc now and then, as CAM programs write them.
fn gcode() -> String {
    let mut text = String::from("%\nO1\nG21 G90 G94 G17\nG0 X0. Y0. Z5.\nG1 Z0. F1000.\n");
    let mut rng = fastrand::Rng::with_seed(1);
    let (mut x, mut y) = (0.0, 0.0);
    for i in 0..LINES {
        if i % 50 == 49 {
            writeln!(text, "G3 X{:.4} Y{y:.4} I0.5 J0.", x + 1.0).expect("memory");
            writeln!(text, "G1 X{x:.4} Y{y:.4}").expect("memory");
        } else {
            x += rng.f64() - 0.5;
            y += rng.f64() - 0.5;
            writeln!(text, "N{} X{x:.4} Y{y:.4} Z{:.4}", 10 * i, -rng.f64()).expect("memory");
        }
    }
    text + "M30\n%\n"
}

/// The same number of points, with tool axes.
fn apt() -> String {
    let mut text = String::from("UNIT/MM\nCSYS/1,0,0,0,0,1,0,0,0,0,1,0\nFEDRAT/1000,MMPM\n");
    let mut rng = fastrand::Rng::with_seed(2);
    for _ in 0..LINES {
        writeln!(text, "GOTO/{:.4},{:.4},{:.4},0.1,0.,0.99", rng.f64(), rng.f64(), rng.f64()).expect("memory");
    }
    text + "FINI\n"
}

fn csv() -> String {
    let mut text = String::from("x_mm,y_mm,z_mm,i,j,k\n");
    let mut rng = fastrand::Rng::with_seed(3);
    for _ in 0..LINES {
        writeln!(text, "{:.4},{:.4},{:.4},0.1,0.,0.99", rng.f64(), rng.f64(), rng.f64()).expect("memory");
    }
    text
}

fn lines(c: &mut Criterion) {
    let mut group = c.benchmark_group("toolpath_1M_lines");
    group.sample_size(10);
    let options = ReadOptions { feed: Some(0.01), ..ReadOptions::default() };
    for (name, format, text) in
        [("gcode", Format::GCode, gcode()), ("apt", Format::Apt, apt()), ("csv", Format::Csv, csv())]
    {
        group.throughput(Throughput::Elements(text.lines().count() as u64));
        group.bench_function(format!("{name}_moves"), |b| {
            b.iter(|| {
                let mut count = 0_usize;
                let understood =
                    read(&mut text.as_bytes(), "a", format, &options, &mut |_| count += 1, &mut |_| Ok(()));
                black_box((understood.expect("a path"), count))
            });
        });
        group.bench_function(format!("{name}_survey"), |b| {
            b.iter(|| {
                let mut survey = Survey::new(Steps::USUAL);
                let understood =
                    read(&mut text.as_bytes(), "a", format, &options, &mut |one| survey.add(one), &mut |_| Ok(()));
                black_box((understood.expect("a path"), survey))
            });
        });
    }
    group.finish();
}

criterion_group!(toolpath, lines);
criterion_main!(toolpath);
