// Which robot? A ranking that follows what is typed.

import { sortable, words } from "./answer.js";
import { forms } from "./ask.js";
import { Comparison, add } from "./compare.js";
import { button, el, say } from "./dom.js";
import { Picture, takeaway } from "./figure.js";
import { change, question } from "./state.js";
import { progress } from "./work.js";

const picture = new Picture("deflection of each robot against the size of the task");
const comparison = new Comparison();
const table = el("div", { class: "ranking" });
const verdict = el("div", { "aria-live": "polite" });
const asked = () => ({ verb: "rank", question: question("rank") });

/** @param {string} name @returns {Node[]} */
function actions(name) {
  return [
    button("place", () => change({ robot: name }, "place"), { "aria-label": `place the work at ${name}` }),
    button("compare", () => add(name), { "aria-label": `add ${name} to compare` }),
  ];
}

/** The columns of the tasks come next to the names. @param {import("./answer.js").Sheet} sheet @param {string[]} tasks */
function valuesFirst(sheet, tasks) {
  const rank = (/** @type {string} */ name) => (name === "#" || name === "robot" ? 0 : tasks.includes(name) ? 1 : 2);
  const order = sheet.headings.map((name, column) => ({ column, rank: rank(name) })).sort((a, b) => a.rank - b.rank || a.column - b.column);
  const led = (/** @type {string[]} */ cells) => order.map(({ column }) => cells[column] ?? "");
  return { headings: led(sheet.headings), rows: sheet.rows.map(led) };
}

/** @type {import("./page.js").View} */
export const robots = {
  verb: "rank",
  parts: () => [
    { verb: "rank", title: "Which robot?", first: ["robots", "task", "force-n", "tolerance-mm", "model", "stiffness", "tool"] },
  ],
  mount(look, decide) {
    look.replaceChildren(picture.image, table, comparison.box);
    const kinds = /** @type {[string, string][]} */ ([["SVG", "svg"], ["PNG", "png"], ["PDF", "pdf"], ["CSV", "csv"], ["JSON", "json"], ["report", "report"]]);
    decide.replaceChildren(verdict, takeaway(asked, kinds));
  },
  async update(signal) {
    const now = question("rank");
    const { json: answer, tables: { tables, sentences }, svg } = await forms("rank", now, ["json", "tables", "svg"], signal, progress);
    const summary = /** @type {string[]} */ (answer.summary ?? []);
    const notes = sentences.slice(1).flat().filter((/** @type {string} */ words) => !summary.includes(words));
    const [first = "", ...rest] = summary;
    const [question_ = "", ...assumed] = sentences[0] ?? [];
    verdict.replaceChildren(
      el("div", { class: "verdict says" }, [el("p", { class: "means" }, [question_]), el("p", { class: "number" }, [first]), el("p", { class: "rests" }, [assumed.join("; ")])]),
      words(rest, "words"),
      el("details", { class: "fine" }, [el("summary", {}, ["how to read the table"]), words(notes)]),
    );
    const [sheet] = tables;
    if (sheet) table.replaceChildren(sortable(valuesFirst(sheet, answer.tasks ?? []), "robots in order", (index) => actions(answer.rows[index]?.robot ?? "")));
    await picture.show(svg ?? "");
    say(first);
    await comparison.update(signal);
  },
};
