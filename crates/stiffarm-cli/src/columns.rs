//! Typed columns in one Parquet file, for pandas, polars and the like.

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
use stiffarm_ask::answer::{Cell, Column, ColumnKind, ORIGIN, Rows, SCHEMA};

/// Rows that are written at once.
const GROUP: usize = 1 << 18;

fn field(column: &Column) -> Result<TypePtr> {
    let (physical, logical) = match column.kind {
        ColumnKind::Number => (Physical::DOUBLE, None),
        ColumnKind::Count => (Physical::INT64, None),
        ColumnKind::Truth => (Physical::BOOLEAN, None),
        ColumnKind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let builder = Type::primitive_type_builder(&column.name, physical).with_logical_type(logical);
    Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).build()?))
}

/// Writes all rows, numbers to the last bit, what is absent as null, group by group; the file says which command made it, and what
/// its columns mean.
pub(crate) fn write_parquet(rows: &Rows, command: &str, out: &mut (impl Write + Send)) -> io::Result<()> {
    write(rows, command, out).map_err(|error| match error {
        // What the system says of the file, not what the format makes of it.
        ParquetError::External(error) => error.downcast().map_or_else(io::Error::other, |error| *error),
        error => io::Error::other(error),
    })
}

fn write(rows: &Rows, command: &str, out: &mut (impl Write + Send)) -> Result<()> {
    let fields: Result<Vec<TypePtr>> = rows.columns().iter().map(field).collect();
    let schema = Type::group_type_builder("stiffarm").with_fields(fields?).build()?;
    let version = env!("CARGO_PKG_VERSION");
    let keys = [
        ("stiffarm_command", command.to_owned()),
        ("stiffarm_version", version.to_owned()),
        ("stiffarm_schema", SCHEMA.to_string()),
        ("stiffarm_origin", format!("{ORIGIN}; of two links alone their joint-2 axis")),
        ("stiffarm_units", "the ending of each column".to_owned()),
    ];
    let properties = WriterProperties::builder()
        .set_created_by(format!("stiffarm version {version}"))
        .set_key_value_metadata(Some(keys.map(|(key, value)| KeyValue::new(key.into(), value)).into()))
        .build();
    let mut file = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
    for first in (0..rows.len()).step_by(GROUP) {
        let group_rows: Vec<_> = (first..rows.len().min(first + GROUP)).map(|i| rows.at(i)).collect();
        let mut group = file.next_row_group()?;
        for i in 0..rows.columns().len() {
            let cells: Vec<&Cell> = group_rows.iter().map(|row| row.get(i).unwrap_or(&Cell::Absent)).collect();
            let mut writer = group.next_column()?.expect("as many columns as the schema has");
            write_cells(&mut writer, &cells)?;
            writer.close()?;
        }
        group.close()?;
    }
    file.close()?;
    Ok(())
}

/// A cell that is not of its column's kind is a fault of the answer, and refused.
fn write_cells(writer: &mut SerializedColumnWriter, cells: &[&Cell]) -> Result<()> {
    let known: Vec<i16> = cells.iter().map(|cell| i16::from(**cell != Cell::Absent)).collect();
    let known = Some(known.as_slice());
    let cells = || cells.iter().filter(|cell| ***cell != Cell::Absent);
    let odd = |cell: &Cell| ParquetError::General(format!("{cell:?} is not of the kind of its column"));
    match writer.untyped() {
        ColumnWriter::DoubleColumnWriter(writer) => {
            let number = |cell: &&&Cell| if let Cell::Number(x) = cell { Ok(*x) } else { Err(odd(cell)) };
            writer.write_batch(&cells().map(|cell| number(&cell)).collect::<Result<Vec<f64>>>()?, known, None)
        }
        ColumnWriter::Int64ColumnWriter(writer) => {
            let count = |cell: &&&Cell| if let Cell::Count(n) = cell { Ok(*n) } else { Err(odd(cell)) };
            writer.write_batch(&cells().map(|cell| count(&cell)).collect::<Result<Vec<i64>>>()?, known, None)
        }
        ColumnWriter::BoolColumnWriter(writer) => {
            let truth = |cell: &&&Cell| if let Cell::Truth(x) = cell { Ok(*x) } else { Err(odd(cell)) };
            writer.write_batch(&cells().map(|cell| truth(&cell)).collect::<Result<Vec<bool>>>()?, known, None)
        }
        ColumnWriter::ByteArrayColumnWriter(writer) => {
            let text =
                |cell: &&&Cell| if let Cell::Text(x) = cell { Ok(ByteArray::from(x.as_str())) } else { Err(odd(cell)) };
            writer.write_batch(&cells().map(|cell| text(&cell)).collect::<Result<Vec<ByteArray>>>()?, known, None)
        }
        _ => unreachable!("columns have one of four physical types"),
    }?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use bytes::Bytes;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    use super::*;

    fn read(rows: &Rows) -> SerializedFileReader<Bytes> {
        let mut bytes = Vec::new();
        write_parquet(rows, "place", &mut bytes).unwrap();
        SerializedFileReader::new(Bytes::from(bytes)).unwrap()
    }

    fn columns() -> Vec<Column> {
        vec![
            Column::new("x_m", ColumnKind::Number),
            Column::new("status", ColumnKind::Text),
            Column::new("rank", ColumnKind::Count),
            Column::new("pass", ColumnKind::Truth),
        ]
    }

    #[test]
    fn numbers_keep_every_bit_and_what_is_absent_is_null() {
        let values = [0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1e22, -1.0 / 3.0];
        let text = "\u{2264} \"derived\",\n";
        let row = |value: f64| vec![Cell::Number(value), Cell::Text(text.into()), Cell::Count(3), Cell::Truth(true)];
        let mut kept: Vec<Vec<Cell>> = values.map(row).into();
        kept.push(vec![Cell::Absent; 4]);
        let file = read(&Rows::new(columns(), kept));
        let rows: Vec<Vec<Field>> = file
            .get_row_iter(None)
            .unwrap()
            .map(|row| row.unwrap().into_columns().into_iter().map(|(_, field)| field).collect())
            .collect();
        assert_eq!(rows.len(), values.len() + 1);
        for (row, value) in rows.iter().zip(values) {
            let Field::Double(found) = row[0] else { panic!("{row:?}") };
            assert_eq!(found.to_bits(), value.to_bits());
            assert_eq!(row[1..], [Field::Str(text.into()), Field::Long(3), Field::Bool(true)]);
        }
        assert!(rows[values.len()].iter().all(|field| *field == Field::Null));
    }

    #[test]
    fn a_type_does_not_depend_on_the_values() {
        let types = |cells: Vec<Cell>| {
            let schema = read(&Rows::new(columns(), vec![cells]));
            let columns = schema.metadata().file_metadata().schema_descr().columns().to_vec();
            columns.iter().map(|column| column.physical_type()).collect::<Vec<_>>()
        };
        let expected = [Physical::DOUBLE, Physical::BYTE_ARRAY, Physical::INT64, Physical::BOOLEAN];
        assert_eq!(types(vec![Cell::Absent; 4]), expected);
        assert_eq!(
            types(vec![Cell::Number(2.0), Cell::Text("1".into()), Cell::Count(1), Cell::Truth(false)]),
            expected
        );
        let mut bytes = Vec::new();
        let odd = vec![Cell::Text("2".into()), Cell::Absent, Cell::Absent, Cell::Absent];
        assert!(write_parquet(&Rows::new(columns(), vec![odd]), "place", &mut bytes).is_err());
    }

    #[test]
    fn a_file_says_who_made_it_and_what_it_counts_from_and_an_empty_table_keeps_its_columns() {
        let file = read(&Rows::new(columns(), Vec::new()));
        let about = file.metadata().file_metadata();
        let keys: Vec<(String, Option<String>)> =
            about.key_value_metadata().unwrap().iter().map(|pair| (pair.key.clone(), pair.value.clone())).collect();
        assert_eq!(keys[0], ("stiffarm_command".into(), Some("place".into())));
        assert_eq!(keys[1], ("stiffarm_version".into(), Some(env!("CARGO_PKG_VERSION").into())));
        assert_eq!(keys[2], ("stiffarm_schema".into(), Some(SCHEMA.to_string())));
        assert!(keys[3].0 == "stiffarm_origin" && keys[3].1.as_ref().is_some_and(|origin| origin.starts_with(ORIGIN)));
        assert_eq!((about.num_rows(), about.schema_descr().num_columns()), (0, 4));
    }

    #[test]
    fn more_rows_than_one_group_holds_are_all_written() {
        let columns = vec![Column::new("x_m", ColumnKind::Number)];
        let file = read(&Rows::made(columns, GROUP + 3, |i| vec![Cell::Number(i as f64)]));
        assert_eq!(file.num_row_groups(), 2);
        let last = file.get_row_iter(None).unwrap().last().unwrap().unwrap().into_columns();
        assert_eq!(last[0].1, Field::Double((GROUP + 2) as f64));
    }
}
