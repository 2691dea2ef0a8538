//! How is a study reported?

use serde_json::{Value, json};

use super::words::fixed;
use super::{Datum, Record, Rows, Table, field, shape, with_schema};
use stiffarm::study::{Boundary, Contender, Mark, Row, Study};
use stiffarm::task::{Task, Zone};

/// The answer of `study`; normalised as Table I of the paper.
#[derive(Clone, Debug)]
pub struct StudyAnswer(pub Study);

impl StudyAnswer {
    fn records(&self) -> impl Iterator<Item = Record> + '_ {
        let Study { options, rows, .. } = &self.0;
        rows.iter().map(|row| {
            let Contender { architecture, k2, k3 } = options.contenders[row.contender];
            let mut record = Record::of(&shape::STUDY_ROW);
            record
                .put(field::TASK, &options.tasks[row.task].label)
                .put(field::SIZE, row.size)
                .put(field::MU, row.ratio.map(|ratio| ratio.mu))
                .put(field::IS_BEST, row.ratio.is_none_or(|ratio| ratio.is_best))
                .put(field::ARCHITECTURE, architecture.name())
                .put(field::K2, k2)
                .put(field::K3, k3)
                .put(field::ACCURACY, row.accuracy);
            record
        })
    }

    fn boundaries(&self) -> Datum {
        let Study { options, boundaries, .. } = &self.0;
        let records = boundaries.iter().map(|boundary| {
            let mut record = Record::of(&shape::BOUNDARY);
            record
                .put(field::TASK, &options.tasks[boundary.task].label)
                .put(field::MU, boundary.mu)
                .put(field::SIZE, boundary.size)
                .put(field::BETTER_BELOW, options.name(boundary.below))
                .put(field::BETTER_ABOVE, options.name(1 - boundary.below));
            record
        });
        records.collect()
    }

    /// Where a robot with its work stands.
    fn mark(&self, mark: &Mark) -> Record {
        let Study { options, marked, .. } = &self.0;
        let mut record = Record::of(&shape::STUDY_MARK);
        record
            .put(field::ROBOT, &mark.robot)
            .put(field::TASK, &options.tasks[mark.task].label)
            .put(field::MU, mark.mu)
            .put(field::SIZE, mark.size)
            .put(field::ACCURACIES, json!(marked))
            .put(field::STIFFER, self.stiffer().map(|contender| options.name(contender)));
        record
    }

    /// Which contender has less where the mark is; `None` where both have the same, or neither anything.
    fn stiffer(&self) -> Option<usize> {
        match self.0.marked {
            [Some(a), Some(b)] => (a != b).then_some(usize::from(b < a)),
            [a, b] => a.map(|_| 0).or(b.map(|_| 1)),
        }
    }

    /// The same as a sentence.
    fn marked(&self, mark: &Mark) -> String {
        let options = &self.0.options;
        let task = &options.tasks[mark.task].label;
        let stands = format!(
            "{} with {task} stands at mu = {}, d/(l2+l3) = {}",
            mark.robot,
            fixed(mark.mu, 3),
            fixed(mark.size, 3)
        );
        let of = |contender: usize| {
            let accuracy = self.0.marked[contender].map_or_else(|| "no place".into(), |value| fixed(value, 4));
            format!("{} {accuracy}", options.name(contender))
        };
        let by = match (self.stiffer(), self.0.marked) {
            (Some(stiffer), [Some(a), Some(b)]) => {
                let less = 1.0 - a.min(b) / a.max(b);
                format!(
                    "; an arm of these links bends {} % less where it is {}",
                    fixed(100.0 * less, 0),
                    options.name(stiffer)
                )
            }
            _ => String::new(),
        };
        format!("{stands}: {}, {}{by}\n", of(0), of(1))
    }

    /// As JSON: every accuracy, and where the better contender changes.
    pub fn json(&self) -> Value {
        let mut record = Record::of(&shape::STUDY);
        record
            .put(field::ROWS, self.records().collect::<Datum>())
            .put(field::BOUNDARIES, self.boundaries())
            .put(field::MARK, self.0.options.mark.as_ref().map(|mark| self.mark(mark)));
        with_schema("study", "none", &record)
    }

    /// Every accuracy, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::STUDY_ROW, self.records())
    }

    /// For people.
    pub fn table(&self) -> Table {
        let Study { options, rows, .. } = &self.0;
        let mut headings = vec!["task".to_owned(), "mu = l3/l2".into(), "architecture".into()];
        headings.extend(options.sizes.iter().map(|size| format!("d = {size}")));
        let mut table = Table::new(headings).with_room(3, &[]);
        let per_ratio = options.sizes.len() * 2;
        for group in rows.chunks(per_ratio) {
            for contender in [0, 1] {
                let of_contender: Vec<&Row> = group.iter().filter(|row| row.contender == contender).collect();
                let Some(first) = of_contender.first() else { continue };
                let is_best = of_contender.iter().any(|row| row.ratio.is_none_or(|ratio| ratio.is_best));
                let ratio = if is_best { "best".into() } else { ratio(first) };
                let mut cells = vec![options.tasks[first.task].label.clone(), ratio, options.name(contender)];
                cells.extend(of_contender.iter().map(|row| accuracy(row)));
                table.row(cells);
            }
        }
        table
    }

    /// What stands above the table.
    pub fn heading(&self) -> String {
        let sizes: String = self.0.options.tasks.iter().filter(|task| task.label.contains(':')).map(sized).collect();
        format!(
            "Worst deflection at the best place over k F (l2+l3)^2, sizes d over l2+l3, no joint limits\n\
             k: compliance of a drive, of the drives 2 and 3 alike where nothing else is named; - does not fit\n{sizes}"
        )
    }

    /// What stands below the table: where the better contender changes.
    pub fn notes(&self) -> String {
        let marked: String = self.0.options.mark.iter().map(|mark| self.marked(mark)).collect();
        if self.0.boundaries.is_empty() {
            return format!("{marked}The order does not change with the size.\n");
        }
        self.0.boundaries.iter().fold(marked, |text, boundary| text + &self.boundary(boundary))
    }

    fn boundary(&self, boundary: &Boundary) -> String {
        let options = &self.0.options;
        let task = &options.tasks[boundary.task].label;
        let ratios = boundary.mu.map_or_else(|| "each at its best ratio".into(), |mu| format!("mu = {mu}"));
        let (below, above) = (options.name(boundary.below), options.name(1 - boundary.below));
        format!("{task}, {ratios}: {below} is better below d/(l2+l3) = {:.4}, {above} above\n", boundary.size)
    }
}

/// What the size of a task that is no letter is of.
fn sized(task: &Task<Zone>) -> String {
    let [first, second] = task.work.sides().map(|side| format!("{} d", fixed(side, 3)));
    let is_round = task.work.is_round();
    let sides = if is_round { format!("a circle of {first}") } else { format!("sides of {first} and {second}") };
    format!("{}: {sides}\n", task.label)
}

fn ratio(row: &Row) -> String {
    match row.ratio {
        Some(ratio) if ratio.is_best => format!("best {}", fixed(ratio.mu, 3)),
        Some(ratio) => ratio.mu.to_string(),
        None => "best -".into(),
    }
}

/// With the link ratio where it is the best.
fn accuracy(row: &Row) -> String {
    let at = row.ratio.filter(|ratio| ratio.is_best).map(|ratio| format!(" (mu {:.3})", ratio.mu));
    row.accuracy.map_or_else(|| "-".into(), |value| fixed(value, 4)) + &at.unwrap_or_default()
}
