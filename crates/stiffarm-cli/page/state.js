// What is asked, and how do the address and a job file hold it?

import { recalled, remember, unpacked } from "./files.js";
import { asked, keyOf, row, rows, typed } from "./table.js";

/** @typedef {import("./ask.js").Question} Question */

export const VIEWS = ["robots", "place", "mill", "measure", "calibrate"];

/** Files that were opened, by name: they go with every question that names them. @type {Map<string, string>} */
export const files = new Map(recalled());

/** @param {[string, string][]} opened */
export function keep(opened) {
  for (const [name, text] of opened) files.set(name, text);
  remember(files);
}

/** @param {string} name */
export function forget(name) {
  files.delete(name);
  remember(files);
}

/** @type {Map<string, string>} */
const values = new Map();
/** What is asked before anything was said: the address does not tell it. @type {Map<string, string>} */
const first = new Map();
/** @type {(() => void)[]} */
const listeners = [];
let shown = "robots";
/** What was changed last: while one thing changes again and again, by key or hand, Back leads to before. */
let changed = "";

/** @returns {string} */
export function view() {
  return shown;
}

/** @param {string} key @returns {string} */
export function value(key) {
  return values.get(key) ?? first.get(key) ?? "";
}

/** @param {() => void} listener */
export function onChange(listener) {
  listeners.push(listener);
}

/** @param {Record<string, string>} changes @param {string} [next] the view that is shown then */
export function change(changes, next = shown) {
  for (const [key, text] of Object.entries(changes)) {
    if (text === (first.get(key) ?? "")) values.delete(key);
    else values.set(key, text);
  }
  // The angle at which a rectangle was left by hand turns no circle.
  if (/^(circle|A):/i.test(changes.task ?? "")) values.delete("angle");
  const what = next === shown ? Object.keys(changes).sort().join() : next;
  shown = next;
  history[what === changed ? "replaceState" : "pushState"](null, "", address());
  changed = what;
  for (const listener of listeners) listener();
}

/** @returns {string} */
export function address() {
  const query = new URLSearchParams([...values].sort(([a], [b]) => (a < b ? -1 : 1)));
  return `#${shown}${values.size === 0 ? "" : `?${query}`}`;
}

/** Under which name files go along with an address. */
const FILES = "files";

/** Takes the state from the address, and what came along with it. */
export async function readAddress() {
  const [name = "", query = ""] = location.hash.slice(1).split(/\?(.*)/s);
  values.clear();
  for (const [key, text] of new URLSearchParams(query)) values.set(key, text);
  shown = VIEWS.includes(name) ? name : "robots";
  changed = "";
  const along = values.get(FILES);
  if (along === undefined) return;
  values.delete(FILES);
  keep(Object.entries(await unpacked(along)));
  history.replaceState(null, "", address());
}

/** The address with what goes along. @param {string} along */
export function addressWith(along) {
  const whole = new URL(address(), location.href).href;
  return along === "" ? whole : `${whole}${values.size === 0 ? "?" : "&"}${FILES}=${along}`;
}

/** What must be given is first asked with the example of its row, so that the first picture needs no click. */
export function firstQuestion() {
  for (const [verb = "", name = ""] of [["place", "robot"], ["place", "task"], ["mill", "path"], ["mill", "force-n"], ["mill", "at"]]) {
    const found = row(verb, name);
    if (found) first.set(keyOf(verb, found), found.example);
  }
}

/** Is the row one of the model that is asked for? @param {string} verb @param {import("./table.js").Row} of */
export function isOfModel(verb, of) {
  const model = row(verb, "model");
  if (!model || !model.choices.some((choice) => choice.word === "planar")) return true;
  return of.models.includes(value(keyOf(verb, model)) || model.default || "planar");
}

/** The page has pictures of its own size, and mills with one robot. @param {string} verb @param {string} name */
export function isAskedHere(verb, name) {
  return name !== "width-mm" && !(verb === "mill" && name === "robots");
}

/** An example that was given before anything was said gives way to what excludes it. @param {string} verb @param {import("./table.js").Row} of */
function givesWay(verb, of) {
  if (values.has(keyOf(verb, of))) return false;
  return rows(verb).some((other) => other.excludes.includes(of.name) && (values.get(keyOf(verb, other)) ?? "") !== "" && isAskedHere(verb, other.name));
}

/** The question of a verb, with what is changed of it. @param {string} verb @param {Record<string, unknown>} [changed] @returns {Question} */
export function question(verb, changed = {}) {
  /** @type {Record<string, unknown>} */
  const options = {};
  for (const of of rows(verb)) {
    const text = value(keyOf(verb, of));
    if (text !== "" && isOfModel(verb, of) && isAskedHere(verb, of.name) && !givesWay(verb, of)) options[of.name] = asked(of, text);
  }
  for (const [name, text] of Object.entries(changed)) {
    if (text === undefined) delete options[name];
    else options[name] = text;
  }
  for (const name of Object.keys(options)) {
    const left = row(verb, name)?.excludes ?? [];
    if (name === "at" || name in changed) for (const other of left) if (!(other in changed)) delete options[other];
  }
  return { options, files: named(JSON.stringify(options)) };
}

/** The files that a question names, and those that they name themselves: a process its table of forces. @param {string} json */
function named(json) {
  /** @type {Record<string, string>} */
  const found = {};
  const texts = [json];
  for (const text of texts) {
    for (const [name, content] of files) {
      const written = text === json ? JSON.stringify(name).slice(1, -1) : name;
      if (name in found || !text.includes(written)) continue;
      found[name] = content;
      texts.push(content);
    }
  }
  return found;
}

/** In which view a job is asked. @type {Record<string, string>} */
const VIEW_OF = { rank: "robots", place: "place", map: "place", study: "place", mill: "mill", measure: "measure", identify: "measure", calibrate: "calibrate", "robots verify": "calibrate" };

/** Takes the state from what a job file asks. @param {{verb: string, options: Record<string, unknown>}} job */
export function readJob({ verb, options }) {
  const of = VIEW_OF[verb];
  const other = Object.keys(options).find((name) => name !== "width-mm" && !isAskedHere(verb, name));
  if (of === undefined || other !== undefined) throw new Error(`a job of ${verb}${other === undefined ? "" : ` with ${other}`} has no view here: stiffarm ${verb} job.toml answers it`);
  const changes = Object.fromEntries(rows(verb).map((of) => [keyOf(verb, of), ""]));
  for (const [name, given] of Object.entries(options)) {
    const known = row(verb, name);
    if (known) changes[keyOf(verb, known)] = typed(given);
  }
  change(changes, of);
}
