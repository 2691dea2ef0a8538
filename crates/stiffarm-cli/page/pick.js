// Which robots are meant? A search through the whole catalogue, and robot files that are opened.

import { call, get } from "./ask.js";
import { button, el, say } from "./dom.js";
import { opener } from "./open.js";
import { change, files, forget, value } from "./state.js";

/** @typedef {{robot: string, vendor: string, payload_kg: number | null, reach_m: number | null, architecture: string, status: string}} Entry */

/** @type {Promise<Entry[]> | undefined} */
let whole;

/** The whole catalogue, asked once. */
const catalogue = () => (whole ??= get("/api/robots"));

/** @param {string} text @returns {Promise<Entry[]>} */
async function found(text) {
  const wanted = text.toLowerCase().split(/\s+/).filter((word) => word !== "");
  const named = (/** @type {Entry} */ { robot, vendor, architecture }) => `${vendor} ${robot} ${architecture}`.toLowerCase();
  return (await catalogue()).filter((/** @type {Entry} */ entry) => wanted.every((word) => named(entry).includes(word))).slice(0, 40);
}

/** @param {Entry} entry */
function about({ payload_kg, reach_m, status }) {
  return [payload_kg && `${payload_kg} kg`, reach_m && `${reach_m} m`, status].filter(Boolean).join(", ");
}

/**
 * One robot or several, chosen by typing a part of the name.
 * @param {import("./table.js").Row} row @param {string} key @param {Record<string, string>} described @returns {HTMLElement[]}
 */
export function pickRobots(row, key, described) {
  const id = described["id"] ?? "";
  const chosen = () => value(key).split(",").filter((name) => name !== "");
  const hint = row.list ? (row.means ?? "") : "";
  const input = el("input", {
    ...described, type: "text", role: "combobox", "aria-expanded": "false", "aria-autocomplete": "list", "aria-controls": `${id}.list`,
    autocomplete: "off", spellcheck: "false", value: row.list ? "" : value(key), placeholder: row.list ? `search; else ${hint}` : "search",
  });
  const list = el("ul", { id: `${id}.list`, role: "listbox", "aria-label": `robots found for ${row.name}`, hidden: true });
  const chips = el("div", { class: "chips" });
  const report = el("div", { class: "checked", role: "status" });
  let at = -1;

  const close = () => {
    list.hidden = true;
    at = -1;
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
  };
  /** @param {string} name */
  const take = (name) => {
    close();
    input.value = row.list ? "" : name;
    change({ [key]: row.list ? [...new Set([...chosen(), name])].join(",") : name });
    draw();
  };
  const draw = () => {
    if (!row.list) return;
    const drop = (/** @type {string} */ name) => {
      change({ [key]: chosen().filter((other) => other !== name).join(",") });
      draw();
      input.focus();
    };
    chips.replaceChildren(...chosen().map((name) => button(`${name} ×`, () => drop(name), { "aria-label": `leave out ${name}`, class: "chip" })));
  };
  const search = async () => {
    const text = input.value;
    const entries = await found(text);
    if (text !== input.value || document.activeElement !== input) return;
    const own = [...files.keys()].filter((name) => /\.(toml|urdf|ya?ml)$/.test(name) && name.toLowerCase().includes(text.toLowerCase()));
    const sets = row.list ? ["paper", "all"].filter((name) => name.startsWith(text.toLowerCase())) : [];
    const names = [...own.map((name) => [name, "opened file"]), ...sets.map((name) => [name, "a set"]), ...entries.map((entry) => [entry.robot, `${entry.vendor}, ${about(entry)}`])];
    list.replaceChildren(
      ...names.map(([name = "", note = ""], index) =>
        el("li", { role: "option", id: `${id}.${index}`, "aria-selected": "false", "data-name": name, mousedown: (event) => { event.preventDefault(); take(name); } }, [name, el("small", {}, [note])]),
      ),
    );
    at = -1;
    list.hidden = names.length === 0;
    input.setAttribute("aria-expanded", String(names.length > 0));
  };
  /** @param {number} step */
  const move = (step) => {
    const items = [...list.children];
    at = items.length === 0 ? -1 : (at + step + items.length + (at < 0 && step < 0 ? 1 : 0)) % items.length;
    items.forEach((item, index) => item.setAttribute("aria-selected", String(index === at)));
    items[at]?.scrollIntoView({ block: "nearest" });
    input.setAttribute("aria-activedescendant", items[at]?.id ?? "");
  };
  input.addEventListener("input", search);
  input.addEventListener("focus", () => { input.select(); });
  input.addEventListener("click", search);
  input.addEventListener("blur", () => { close(); if (!row.list && input.value.trim() !== value(key)) change({ [key]: input.value.trim() }); });
  input.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      if (list.hidden) search();
      else move(event.key === "ArrowDown" ? 1 : -1);
    } else if (event.key === "Escape") close();
    else if (event.key === "Enter") {
      event.preventDefault();
      const item = /** @type {HTMLElement | undefined} */ (list.children[at]);
      const name = item?.dataset["name"] ?? input.value.trim();
      if (name !== "") take(name);
    } else if (event.key === "Backspace" && row.list && input.value === "") {
      change({ [key]: chosen().slice(0, -1).join(",") });
      draw();
    }
  });
  const open = opener(`open a robot file for ${row.name}`, id, async (name, text) => {
    report.replaceChildren(...(await checked(name, text)));
    if (files.has(name)) take(name);
  });
  draw();
  return [el("div", { class: row.list ? "picker many" : "picker" }, [chips, input, list]), open, report];
}

/** What the checker says of a robot file; one with faults is not kept. @param {string} name @param {string} text */
async function checked(name, text) {
  const result = await call("/api/robots/check", { name, text }).catch((fault) => ({ robot: null, faults: `${fault.message}\n${fault.hint ?? ""}`, notes: [] }));
  const faults = Array.isArray(result.faults) ? result.faults.map(line) : [String(result.faults)].filter((fault) => fault !== "");
  const notes = (result.notes ?? []).map(line);
  if (!result.robot) forget(name);
  say(result.robot ? `${name} can be used` : `${name} cannot be used`);
  const head = el("p", { class: result.robot ? "" : "fail" }, [result.robot ? `${name}: ${result.robot.robot} can be used` : `${name} cannot be used`]);
  return [head, ...[...faults, ...notes].map((words) => el("p", {}, [words]))];
}

/** @param {string | {line?: number | null, text?: string, key?: string, message?: string}} fault */
function line(fault) {
  if (typeof fault === "string") return fault;
  const words = fault.text ?? [fault.key, fault.message].filter(Boolean).join(": ");
  return fault.line ? `line ${fault.line}: ${words}` : words;
}
