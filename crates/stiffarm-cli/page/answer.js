// How are the words of an answer shown? Its tables and sentences come as the library has them.

import { button, el, say } from "./dom.js";

/** @typedef {{value: string, means: string, rests_on: string, rows: number[]}} Lead the line that decides, and the rows that say no more */
/** @typedef {{headings: string[], rows: string[][], lead?: Lead | null}} Sheet */
/** @typedef {{tables: Sheet[], sentences: string[][]}} AnswerText sentences: one list before the first table and one behind every table */

/** The words of a verdict, and how each looks. @type {Record<string, string>} */
const LOOKS = { pass: "pass", "pass, not sure": "pass unsure", fail: "fail", collision: "fail", "load exceeded": "fail", chatter: "fail" };

/** Verdicts are marked, and nothing else is red. @param {string} text */
function marked(text) {
  // What bars an answer comes before what its deflection alone would be.
  const barred = /(\b(?:collision|load exceeded|chatter)(?=; by the deflection)|\bCOLLISION\b|\bLOAD EXCEEDED\b|\bCHATTER\b)/;
  const parts = text.split(barred.test(text) ? barred : /(\bpass, not sure\b|\bpass\b|\bfail\b)/);
  return parts.map((part, i) => (i % 2 === 1 ? el("b", { class: LOOKS[part] ?? "fail" }, [part]) : part));
}

/** @param {string} text */
function copies(text) {
  const press = async () => {
    await navigator.clipboard.writeText(text);
    say(`copied: ${text}`);
  };
  return { click: press, title: "click copies" };
}

/** Labels and what is said of them, but for what its lead says. @param {Sheet} sheet */
export function list(sheet) {
  const table = el("table", { class: "told" });
  for (const [row, [label = "", ...rest]] of sheet.rows.entries()) {
    if (sheet.lead?.rows.includes(row)) continue;
    table.append(el("tr", {}, [el("th", { scope: "row" }, [label]), ...rest.map((text) => el("td", copies(text), marked(text)))]));
  }
  if (sheet.headings.some((name) => name !== "")) {
    table.prepend(el("thead", {}, [el("tr", {}, sheet.headings.map((name) => el("th", { scope: "col" }, [name])))]));
  }
  return table;
}

/**
 * A table whose columns sort; `act` gives what can be done with the row of a number.
 * @param {Sheet} sheet @param {string} caption @param {(index: number) => Node[]} [act]
 */
export function sortable(sheet, caption, act) {
  const body = el("tbody");
  const rows = sheet.rows.map((cells, index) => {
    const row = el("tr", {}, cells.map((text) => el("td", copies(text), marked(text))));
    if (act) row.append(el("td", { class: "acts" }, act(index)));
    return { cells, row };
  });
  body.append(...rows.map(({ row }) => row));
  const heads = sheet.headings.map((name, column) => {
    const head = el("th", { scope: "col" });
    head.append(button(name, () => sort(column, head)));
    return head;
  });
  /** @param {number} column @param {HTMLElement} head */
  function sort(column, head) {
    const turned = head.getAttribute("aria-sort") === "ascending";
    for (const other of heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", turned ? "descending" : "ascending");
    const sorted = [...rows].sort((a, b) => compared(a.cells[column] ?? "", b.cells[column] ?? ""));
    body.append(...(turned ? sorted.reverse() : sorted).map(({ row }) => row));
  }
  const row = el("tr", {}, act ? [...heads, el("th", { scope: "col" }, [el("span", { class: "unseen" }, ["what to do"])])] : heads);
  const table = el("table", { class: "sheet" }, [el("caption", { class: "unseen" }, [caption]), el("thead", {}, [row]), body]);
  return el("div", { class: "wide", tabindex: "0", role: "region", "aria-label": caption }, [table]);
}

/** @param {string} a @param {string} b */
function compared(a, b) {
  const [x, y] = [Number.parseFloat(a), Number.parseFloat(b)];
  if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) && Number.isNaN(y) ? a.localeCompare(b) : Number.isNaN(x) ? 1 : -1;
  return x - y;
}

/** @param {string[]} sentences @param {string} [name] */
export function words(sentences, name = "notes") {
  return el("div", { class: name }, sentences.map((sentence) => el("p", {}, marked(sentence))));
}

/** @typedef {{verdict?: string | null, probability?: number | null, feasible?: boolean | null, overloaded?: boolean | null, wrist_exceeded?: boolean | null}} Judged */

/** The verdict of an answer in a word or two; where no tolerance was given, that nobody may carry this. @param {Judged | null} answer @returns {string} */
export function wordOf(answer) {
  if (typeof answer?.verdict === "string") return answer.verdict;
  return answer?.overloaded || answer?.wrist_exceeded ? "load exceeded" : "";
}

/** How what stands there looks: held, not held, not reached, or nothing of it. @param {Judged} answer */
export function stateOf(answer) {
  if (!answer.feasible) return "none";
  const word = wordOf(answer);
  return word === "" ? "" : word.startsWith("pass") ? "pass" : "fail";
}

/** The same with how likely it is held, where that is known. @param {Judged | null} answer */
function judged(answer) {
  const word = wordOf(answer);
  if (word === "") return [];
  const known = answer?.probability;
  // What forbids a place is sure, and a probability beside it is not of it.
  const isOfDeflection = word.startsWith("pass") || (word === "fail" && answer?.feasible !== false);
  const sure = typeof known === "number" ? ` (P = ${Math.floor(100 * known + 1e-9)} %)` : word.includes(",") ? " (P not known)" : "";
  return [el("b", { class: LOOKS[word] ?? "" }, [word + (isOfDeflection ? sure : "")])];
}

/**
 * The number that decides, and beside it in the same size what it rests on.
 * @param {string} number @param {string} means @param {Judged | null} answer @param {string} rests
 */
export function verdict(number, means, answer, rests) {
  return el("div", { class: "verdict" }, [
    el("p", { class: "means" }, [means]),
    el("p", { class: "number" }, [el("output", { id: "number" }, [number]), " ", ...judged(answer)]),
    el("p", { class: "rests" }, [rests]),
  ]);
}

/** Another number while the hand moves, with the verdict on it. @param {string} number @param {Judged} answer */
export function renumber(number, answer) {
  const output = document.getElementById("number");
  if (!output) return;
  output.textContent = number;
  output.parentElement?.replaceChildren(output, " ", ...judged(answer));
}
