//! How is a study told?

use serde_json::{Value, json};

use crate::study::{Contender, Study};

/// Every accuracy, and where the better contender changes; normalised as Table I of the paper.
pub fn study(study: &Study) -> Value {
    let Study { options, rows, boundaries } = study;
    let rows = rows.iter().map(|row| {
        let Contender { architecture, k2, k3 } = options.contenders[row.contender];
        json!({
            "task": options.tasks[row.task].label,
            "d": row.size,
            "mu_l3_over_l2": row.ratio.map(|ratio| ratio.mu),
            "best": row.ratio.is_none_or(|ratio| ratio.is_best),
            "architecture": architecture.name(),
            "k2": k2,
            "k3": k3,
            "accuracy": row.accuracy,
        })
    });
    let boundaries = boundaries.iter().map(|boundary| {
        json!({
            "task": options.tasks[boundary.task].label,
            "mu_l3_over_l2": boundary.mu,
            "d": boundary.size,
            "better_below": options.name(boundary.below),
            "better_above": options.name(1 - boundary.below),
        })
    });
    json!({ "rows": rows.collect::<Value>(), "boundaries": boundaries.collect::<Value>() })
}
