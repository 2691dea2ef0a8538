// How are the words of an answer shown? Its tables and sentences are read as the library wrote them.

import { button, el, say } from "./dom.js";

/** @typedef {{head: string[], body: string[][]}} Sheet */
/** @typedef {{sheets: Sheet[], sentences: string[][]}} Told sentences: one list before the first table and one behind every table */

/** @param {string} text */
const plain = (text) => text.replace(/\\([\\`*_[\]|~<>#])/g, "$1").trim();

/** @param {string} line */
const cells = (line) => line.replace(/^\||\|\s*$/g, "").split(/(?<!\\)\|/).map(plain);

/** @param {string} markdown @returns {Told} */
export function read(markdown) {
  /** @type {Told} */
  const told = { sheets: [], sentences: [[]] };
  /** @type {Sheet | undefined} */
  let sheet;
  for (const line of markdown.split("\n")) {
    if (!line.startsWith("|")) {
      sheet = undefined;
      if (line.trim() !== "") told.sentences.at(-1)?.push(plain(line));
    } else if (!sheet) {
      sheet = { head: cells(line), body: [] };
      told.sheets.push(sheet);
      told.sentences.push([]);
    } else if (!/^\|[-:| ]+\|?$/.test(line)) {
      sheet.body.push(cells(line));
    }
  }
  return told;
}

/** What a sheet of two columns says under a label. @param {Sheet | undefined} sheet @param {RegExp} label */
export function under(sheet, label) {
  return sheet?.body.find(([name = ""]) => label.test(name))?.[1] ?? "";
}

/** Fails are marked, and nothing else is red. @param {string} text */
function marked(text) {
  const parts = text.split(/\b(pass|fail)\b/);
  return parts.map((part) => (part === "pass" || part === "fail" ? el("b", { class: part }, [part]) : part));
}

/** @param {string} text */
function copies(text) {
  const press = async () => {
    await navigator.clipboard.writeText(text);
    say(`copied: ${text}`);
  };
  return { click: press, title: "click copies" };
}

/** Labels and what is said of them, but for what is told elsewhere. @param {Sheet} sheet @param {RegExp} [but] */
export function list(sheet, but) {
  const table = el("table", { class: "told" });
  for (const [label = "", ...rest] of sheet.body) {
    if (but?.test(label)) continue;
    table.append(el("tr", {}, [el("th", { scope: "row" }, [label]), ...rest.map((text) => el("td", copies(text), marked(text)))]));
  }
  if (sheet.head.some((name) => name !== "")) {
    table.prepend(el("thead", {}, [el("tr", {}, sheet.head.map((name) => el("th", { scope: "col" }, [name])))]));
  }
  return table;
}

/**
 * A table whose columns sort; `act` gives what can be done with the row of a number.
 * @param {Sheet} sheet @param {string} caption @param {(index: number) => Node[]} [act]
 */
export function sortable(sheet, caption, act) {
  const body = el("tbody");
  const rows = sheet.body.map((cells, index) => {
    const row = el("tr", {}, cells.map((text) => el("td", copies(text), marked(text))));
    if (act) row.append(el("td", { class: "acts" }, act(index)));
    return { cells, row };
  });
  body.append(...rows.map(({ row }) => row));
  const heads = sheet.head.map((name, column) => {
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

/**
 * The verdict of an answer in its three words, with how likely it is held where that is known.
 * @param {{verdict?: string | null, probability?: number | null} | null} answer
 */
function judged(answer) {
  const word = answer?.verdict;
  if (typeof word !== "string") return [];
  const known = answer?.probability;
  const sure = typeof known === "number" ? ` (P = ${Math.floor(100 * known + 1e-9)} %)` : word.includes(",") ? " (P not known)" : "";
  return [el("b", { class: word === "fail" ? "fail" : word === "pass" ? "pass" : "pass unsure" }, [word + sure])];
}

/**
 * The number that decides, and beside it in the same size what it rests on.
 * @param {string} number @param {string} means @param {{verdict?: string | null, probability?: number | null} | null} answer @param {string} rests
 */
export function verdict(number, means, answer, rests) {
  const says = judged(answer);
  return el("div", { class: "verdict" }, [
    el("p", { class: "means" }, [means]),
    el("p", { class: "number" }, [el("output", { id: "number" }, [number]), " ", ...says]),
    el("p", { class: "rests" }, [rests]),
  ]);
}
