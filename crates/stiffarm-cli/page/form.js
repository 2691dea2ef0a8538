// How is the question asked? One control for each row of the table of options, the essential ones first.

import { byId, el } from "./dom.js";
import { opener } from "./open.js";
import { change, isAskedHere, isOfModel, value } from "./state.js";
import { pickRobots } from "./pick.js";
import { keyOf, rows } from "./table.js";

/** @typedef {import("./table.js").Row} Row */
/** @typedef {{verb: string, title: string, first: string[]}} Part */

/** What an option is called where a control stands under it. @param {Row} row */
function labelled(row) {
  const unit = row.unit === "" ? "" : ` [${row.unit}]`;
  const name = row.name.replace(/-(mm|n|deg|m|kg|urad-per-nm|nm-per-rad|mm-per-min)$/, "").replaceAll("-", " ");
  return `${name}${unit}`;
}

/** @param {HTMLElement} form @param {Part[]} parts */
export function build(form, parts) {
  const focused = document.activeElement?.id ?? "";
  /** @type {Set<string>} What is shared by two parts is asked once. */
  const met = new Set();
  form.replaceChildren(
    ...parts.map(({ verb, title, first }) => {
      const of = rows(verb).filter((row) => isOfModel(verb, row) && isAskedHere(verb, row.name) && !met.has(keyOf(verb, row)));
      for (const row of of) met.add(keyOf(verb, row));
      const begin = first.flatMap((name) => of.filter((row) => row.name === name));
      const rest = of.filter((row) => !first.includes(row.name));
      const set = el("fieldset", {}, [el("legend", {}, [title]), ...begin.map((row) => control(verb, row))]);
      if (rest.length > 0) set.append(more(verb, title, rest));
      const unasked = rows(verb).filter((row) => value(keyOf(verb, row)) !== "" && !isOfModel(verb, row) && !met.has(keyOf(verb, row)));
      if (unasked.length > 0) set.append(el("p", { class: "unasked", role: "note" }, [`given, and not asked in this model: ${unasked.map(labelled).join(", ")}`]));
      return set;
    }),
  );
  if (focused !== "") document.getElementById(focused)?.focus();
}

/** @type {Set<string>} */
const opened = new Set();

/** @param {string} verb @param {string} title @param {Row[]} rest */
function more(verb, title, rest) {
  const headings = [...new Set(rest.map((row) => row.heading))];
  const within = headings.flatMap((heading) => [
    ...(heading === "" ? [] : [el("h3", {}, [heading])]),
    ...rest.filter((row) => row.heading === heading).map((row) => control(verb, row)),
  ]);
  const given = rest.filter((row) => value(keyOf(verb, row)) !== "").length;
  const summary = el("summary", {}, [given === 0 ? "more" : `more (${given} given)`]);
  const details = el("details", { open: opened.has(verb), "aria-label": `more of ${title}` }, [summary, ...within]);
  details.addEventListener("toggle", () => (details.open ? opened.add(verb) : opened.delete(verb)));
  return details;
}

/** @param {string} verb @param {Row} row */
function control(verb, row) {
  const key = keyOf(verb, row);
  const id = `${verb.replaceAll(" ", "-")}.${row.name}`;
  const help = el("p", { class: "help", id: `${id}.help` }, [row.help]);
  const label = el("label", { for: id }, [labelled(row)]);
  const field = el("div", { class: `field of-${row.kind}`, "data-option": row.name, "data-key": key }, [label, ...entry(row, key, id), help]);
  field.append(el("p", { class: "fault", id: `${id}.fault`, role: "alert" }));
  return field;
}

/** @param {Row} row @param {string} key @param {string} id @returns {HTMLElement[]} */
function entry(row, key, id) {
  const described = { id, name: id, "aria-describedby": `${id}.help ${id}.fault` };
  const given = value(key);
  const absent = row.default ?? row.means ?? (row.example === "" ? "" : `such as ${row.example}`);
  if (row.kind === "flag") {
    const pressed = (/** @type {Event} */ event) => change({ [key]: /** @type {HTMLInputElement} */ (event.target).checked ? "true" : "" });
    return [el("input", { ...described, type: "checkbox", checked: given === "true", change: pressed })];
  }
  const isOne = ["number", "integer"].includes(row.kind) && !row.list;
  const typed = (/** @type {Event} */ event) => {
    const text = /** @type {HTMLInputElement} */ (event.target).value.trim();
    // Where one number is expected a comma is a decimal one; of a force three numbers have two. In 1,000 it may mean either, and that is refused.
    const isDecimal = (isOne || row.kind === "force") && !/^[-+]?[1-9]\d{0,2},\d{3}$/.test(text);
    change({ [key]: isDecimal ? text.replace(/^([-+]?\d*),(\d+)$/, "$1.$2") : text });
  };
  if (row.kind === "choice" && !row.list) {
    const options = row.choices.map(({ word, help }) => el("option", { value: word, title: help, selected: word === given }, [word]));
    if (!row.required) options.unshift(el("option", { value: "" }, [absent === "" ? "not asked" : absent]));
    return [el("select", { ...described, change: typed }, options)];
  }
  if (row.kind === "robot") return pickRobots(row, key, described);
  const input = el("input", { ...described, type: "text", inputmode: isOne ? "decimal" : "text", value: given, placeholder: absent, spellcheck: "false", autocomplete: "off", input: typed });
  return ["file", "file-of-tool"].includes(row.kind) ? [input, opener(`open a file for ${row.name}`, input.id, (name) => change({ [key]: name }))] : [input];
}

/** Values that changed elsewhere come into the controls; what is being typed is left alone. */
export function refresh() {
  for (const field of document.querySelectorAll("#ask [data-key]")) {
    const control = field.querySelector("input:not([type=file]), select");
    const now = value(/** @type {HTMLElement} */ (field).dataset["key"] ?? "");
    if (control instanceof HTMLInputElement && control.type === "checkbox") control.checked = now === "true";
    else if ((control instanceof HTMLInputElement || control instanceof HTMLSelectElement) && !field.classList.contains("many") && control !== document.activeElement) control.value = now;
  }
}

/** Says what was refused at the control that the words name, else above the form. @param {{message: string, hint?: string} | null} fault */
export function faulty(fault) {
  for (const shown of document.querySelectorAll("#ask .fault")) shown.textContent = "";
  for (const marked of document.querySelectorAll("#ask [aria-invalid]")) marked.removeAttribute("aria-invalid");
  const whole = byId("fault");
  whole.textContent = "";
  if (!fault) return;
  const text = [fault.message, fault.hint].filter(Boolean).join("\n");
  const named = [...document.querySelectorAll("#ask [data-option]")].filter((field) => field instanceof HTMLElement && names(text, field));
  const at = named.find((field) => field.querySelector("input, select")?.checkVisibility());
  if (at) at.querySelector("input, select")?.setAttribute("aria-invalid", "true");
  (at?.querySelector(".fault") ?? whole).textContent = text;
}

/** @param {string} text @param {HTMLElement} field */
function names(text, field) {
  const { option = "", key = "" } = field.dataset;
  const before = option.includes("-") ? "" : '(--|[`"]|^)';
  const given = value(key);
  return new RegExp(`${before}\\b${option}(?![-\\w])`).test(text) || (given.length > 2 && text.includes(given));
}
