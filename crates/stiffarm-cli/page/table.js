// Which rows has the table of options, and under which key is each kept?

/**
 * @typedef {object} Row
 * @property {string} name
 * @property {string} help
 * @property {string} heading
 * @property {string} value
 * @property {string} unit
 * @property {string} kind
 * @property {{word: string, help: string}[]} choices
 * @property {string | null} default
 * @property {string | null} means
 * @property {boolean} required
 * @property {boolean} list
 * @property {string[]} models
 * @property {string[]} excludes
 * @property {string[]} [needs]
 * @property {string} example
 */

/** @type {Map<string, Row[]>} */
const verbs = new Map();

/** @param {{verbs: {verb: string, options: Row[]}[]}} table */
export function learn(table) {
  for (const { verb, options } of table.verbs) verbs.set(verb, options);
}

/** @param {string} verb @returns {Row[]} */
export function rows(verb) {
  return verbs.get(verb) ?? [];
}

/** @param {string} verb @param {string} name @returns {Row | undefined} */
export function row(verb, name) {
  return rows(verb).find((row) => row.name === name);
}

/** Two rows that take the same mean the same. @param {Row} a @param {Row} b */
function isSame(a, b) {
  const looks = (/** @type {Row} */ row) => [row.kind, row.unit, ...row.choices.map((choice) => choice.word)].join();
  return looks(a) === looks(b) && (a.value === b.value || a.kind === "robot" || a.kind === "task");
}

/** What is asked alike of several verbs is kept once, so the question stays when the view changes. @param {string} verb @param {Row} row */
export function keyOf(verb, row) {
  const alike = (/** @type {string} */ other) => rows(other).some((shared) => shared.name === row.name && isSame(shared, row));
  if (alike("place")) return row.name;
  const before = { identify: "measure", "robots verify": "calibrate" }[verb];
  return `${before !== undefined && alike(before) ? before : verb.split(" ").at(-1)}.${row.name}`;
}

/** A text as a job file has it: numbers as numbers. @param {Row} row @param {string} text @returns {unknown} */
export function asked(row, text) {
  if (row.kind === "flag") return text === "true";
  const parts = text.split(",").map((part) => part.trim());
  if (["number", "integer", "force"].includes(row.kind)) {
    const numbers = parts.map((part) => (part === "" ? NaN : Number(part)));
    if (!numbers.every(Number.isFinite)) return text;
    return numbers.length === 1 && !(row.list && row.name === "at") ? numbers[0] : numbers;
  }
  if (row.list && ["robot", "task"].includes(row.kind)) return parts.filter((part) => part !== "");
  return row.kind === "task" && !text.startsWith("part") ? (parts[0] ?? "") : text;
}

/** A value of a job file as it is typed. @param {unknown} value @returns {string} */
export function typed(value) {
  return Array.isArray(value) ? value.map(typed).join(",") : String(value);
}
