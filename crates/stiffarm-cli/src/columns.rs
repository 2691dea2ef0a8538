//! A table as typed columns in one Parquet file, for pandas, polars and the like.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::table::Table;

/// Rows that are written at once.
const GROUP: usize = 1 << 18;

/// Headings that count, answer yes or no, or name something, whatever their cells look like.
const COUNTS: [&str; 2] = ["line", "rank"];
const TRUTHS: [&str; 6] = ["agrees", "below_base", "best", "feasible", "pass", "usable"];
const TEXTS: [&str; 19] = [
    "architecture",
    "cell",
    "elbow",
    "file",
    "item",
    "key",
    "message",
    "note",
    "printed",
    "reason",
    "robot",
    "row",
    "shoulder",
    "source",
    "status",
    "task",
    "value",
    "vendor",
    "wrist",
];

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Count,
    Truth,
    Text,
}

impl Kind {
    /// Of a column: by its heading, so that the type does not change with the values; by its cells where the heading is
    /// not known, or they do not agree with it. Other headings are those of numbers.
    fn of(heading: &str, cells: &[&str]) -> Self {
        let all = |fits: fn(&str) -> bool| cells.iter().all(|cell| is_blank(cell) || fits(cell));
        let is_number = |cell: &str| cell.parse::<f64>().is_ok();
        if TEXTS.contains(&heading) {
            Self::Text
        } else if COUNTS.contains(&heading) && all(|cell| cell.parse::<u32>().is_ok()) {
            Self::Count
        } else if TRUTHS.contains(&heading) && all(is_truth) {
            Self::Truth
        } else if all(is_number) {
            Self::Number
        } else if all(is_truth) {
            Self::Truth
        } else {
            Self::Text
        }
    }

    fn field(self, heading: &str) -> Result<TypePtr> {
        let (physical, logical) = match self {
            Self::Number => (Physical::DOUBLE, None),
            Self::Count => (Physical::INT64, None),
            Self::Truth => (Physical::BOOLEAN, None),
            Self::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let builder = Type::primitive_type_builder(heading, physical).with_logical_type(logical);
        Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).build()?))
    }
}

fn is_truth(cell: &str) -> bool {
    matches!(cell, "true" | "false")
}

/// Nothing is known: null.
fn is_blank(cell: &str) -> bool {
    matches!(cell, "" | "-")
}

/// Writes the columns of the CSV, numbers to the last bit, blanks as null, group by group; the file says which command made it.
pub(crate) fn write_parquet(table: &Table, command: &str, out: &mut (impl Write + Send)) -> io::Result<()> {
    write(table, command, out).map_err(|error| match error {
        // What the system says of the file, not what the format makes of it.
        ParquetError::External(error) => error.downcast().map_or_else(io::Error::other, |error| *error),
        error => io::Error::other(error),
    })
}

fn write(table: &Table, command: &str, out: &mut (impl Write + Send)) -> Result<()> {
    let kinds = kinds(table);
    let fields: Result<Vec<TypePtr>> =
        table.headings().iter().zip(&kinds).map(|(heading, kind)| kind.field(heading)).collect();
    let schema = Type::group_type_builder("stiffarm").with_fields(fields?).build()?;
    let version = env!("CARGO_PKG_VERSION");
    let keys = [("stiffarm_command", command), ("stiffarm_version", version)];
    let properties = WriterProperties::builder()
        .set_created_by(format!("stiffarm version {version}"))
        .set_key_value_metadata(Some(keys.map(|(key, value)| KeyValue::new(key.into(), value.to_owned())).into()))
        .build();
    let mut file = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
    for first in (0..table.len()).step_by(GROUP) {
        let rows: Vec<_> = (first..table.len().min(first + GROUP)).map(|i| table.at(i)).collect();
        let mut group = file.next_row_group()?;
        for (i, kind) in kinds.iter().enumerate() {
            let cells: Vec<&str> = rows.iter().map(|row| row.get(i).map_or("", String::as_str)).collect();
            let mut writer = group.next_column()?.expect("as many columns as the schema has");
            write_cells(&mut writer, *kind, &cells)?;
            writer.close()?;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

/// Of every column: by its heading, and where rows are kept by its cells, too.
fn kinds(table: &Table) -> Vec<Kind> {
    let kept = if table.is_made() { 0 } else { table.len() };
    let rows: Vec<_> = (0..kept).map(|i| table.at(i)).collect();
    let cells = |i: usize| rows.iter().map(|row| row.get(i).map_or("", String::as_str)).collect::<Vec<_>>();
    table.headings().iter().enumerate().map(|(i, heading)| Kind::of(heading, &cells(i))).collect()
}

fn write_cells(writer: &mut SerializedColumnWriter, kind: Kind, cells: &[&str]) -> Result<()> {
    let known: Vec<i16> = cells.iter().map(|cell| i16::from(!is_blank(cell))).collect();
    let texts = || cells.iter().copied().filter(|cell| !is_blank(cell));
    let known = Some(known.as_slice());
    match writer.untyped() {
        ColumnWriter::DoubleColumnWriter(writer) => {
            writer.write_batch(&texts().filter_map(|cell| cell.parse().ok()).collect::<Vec<f64>>(), known, None)
        }
        ColumnWriter::Int64ColumnWriter(writer) => {
            writer.write_batch(&texts().filter_map(|cell| cell.parse().ok()).collect::<Vec<i64>>(), known, None)
        }
        ColumnWriter::BoolColumnWriter(writer) => {
            writer.write_batch(&texts().map(|cell| cell == "true").collect::<Vec<bool>>(), known, None)
        }
        ColumnWriter::ByteArrayColumnWriter(writer) => {
            writer.write_batch(&texts().map(ByteArray::from).collect::<Vec<_>>(), known, None)
        }
        _ => unreachable!("{kind:?} has one of four physical types"),
    }?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use bytes::Bytes;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    fn read(table: &Table) -> SerializedFileReader<Bytes> {
        let mut bytes = Vec::new();
        write_parquet(table, "place", &mut bytes).unwrap();
        SerializedFileReader::new(Bytes::from(bytes)).unwrap()
    }

    fn rows(table: &Table) -> Vec<Vec<Field>> {
        let file = read(table);
        let rows = file.get_row_iter(None).unwrap();
        rows.map(|row| row.unwrap().into_columns().into_iter().map(|(_, field)| field).collect()).collect()
    }

    #[test]
    fn numbers_keep_every_bit_and_blanks_are_null() {
        let values = [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1e22, -1.0 / 3.0];
        let mut table = Table::new(["x_m", "status", "rank", "pass"]);
        for value in values {
            table.row([value.to_string().as_str(), "\u{2264} \"derived\",\n", "3", "true"]);
        }
        table.row(["", "", "", ""]);
        table.row(["-", "-", "-", "-"]);
        let rows = rows(&table);
        assert_eq!(rows.len(), values.len() + 2);
        for (row, value) in rows.iter().zip(values) {
            let Field::Double(found) = row[0] else { panic!("{row:?}") };
            assert_eq!(found.to_bits(), value.to_bits());
            assert_eq!(row[1..], [Field::Str("\u{2264} \"derived\",\n".into()), Field::Long(3), Field::Bool(true)]);
        }
        assert!(rows[values.len()..].iter().flatten().all(|field| *field == Field::Null));
    }

    #[test]
    fn a_type_does_not_depend_on_the_values() {
        let types = |cells: [&str; 6]| {
            let mut table = Table::new(["force_n", "elbow", "rank", "pass", "robot", "new"]);
            table.row(cells);
            let schema = read(&table);
            let columns = schema.metadata().file_metadata().schema_descr().columns().to_vec();
            columns.iter().map(|column| column.physical_type()).collect::<Vec<_>>()
        };
        let expected = [
            Physical::DOUBLE,
            Physical::BYTE_ARRAY,
            Physical::INT64,
            Physical::BOOLEAN,
            Physical::BYTE_ARRAY,
            Physical::DOUBLE,
        ];
        assert_eq!(types(["1000", "up", "1", "true", "210", "2"]), expected);
        assert_eq!(types(["0.5", "", "", "", "KR 210", ""]), expected);
        // Nothing is lost where a cell is not what its heading promises.
        let text = Physical::BYTE_ARRAY;
        assert_eq!(types(["many", "up", "first", "maybe", "", "some"]), [text; 6]);
        assert_eq!(types(["1", "up", "1.5", "2", "", "true"])[2..4], [Physical::DOUBLE; 2]);
    }

    #[test]
    fn a_file_says_who_made_it_and_an_empty_table_keeps_its_columns() {
        let file = read(&Table::new(["x_m", "z_m"]));
        let about = file.metadata().file_metadata();
        let keys: Vec<(String, Option<String>)> =
            about.key_value_metadata().unwrap().iter().map(|pair| (pair.key.clone(), pair.value.clone())).collect();
        assert_eq!(keys[0], ("stiffarm_command".into(), Some("place".into())));
        assert_eq!(keys[1], ("stiffarm_version".into(), Some(env!("CARGO_PKG_VERSION").into())));
        assert_eq!((about.num_rows(), about.schema_descr().num_columns()), (0, 2));
    }

    #[test]
    fn more_rows_than_one_group_holds_are_all_written() {
        let file = read(&Table::made(["x_m"], GROUP + 3, |i| [i.to_string()]));
        assert_eq!(file.num_row_groups(), 2);
        let last = file.get_row_iter(None).unwrap().last().unwrap().unwrap().into_columns();
        assert_eq!(last[0].1, Field::Double((GROUP + 2) as f64));
    }
}
