// Where must the work stand? The zone is moved by hand, and the best place is proved.

import { list, stateOf, verdict, wordOf, words } from "./answer.js";
import { fields, forms, oneInFlight } from "./ask.js";
import { Comparison, add } from "./compare.js";
import { button, el, say } from "./dom.js";
import { Picture, Space, takeaway } from "./figure.js";
import { Section } from "./section.js";
import { change, question, value } from "./state.js";
import { progress } from "./work.js";
import { textOf } from "./window.js";
import { rounded, taskOf, zoneOf } from "./zone.js";

/** @typedef {import("./zone.js").Spot} Spot */

const section = new Section({ moving, moved, resized, turned }, { moving: limiting, moved: limited });
const comparison = new Comparison();
const space = new Space();
const study = new Picture("serial against quasi-serial: which architecture at which link ratio and size");
const shows = /** @type {Record<string, HTMLElement>} */ ({ section: section.box, space: space.box, compare: comparison.box, study: el("div", {}, [study.image]) });
const tabs = el("div", { class: "tools", role: "toolbar", "aria-label": "what is shown" });
const live = el("div", { class: "live", "aria-live": "polite", "aria-atomic": "true" });
const says = el("div");
const best = button("best place", () => change({ at: "", angle: "" }), { class: "main" });
const asked = () => ({ verb: "place", question: question("place") });
/** @type {any} */
let proved = {};
let provedOf = "";
let studied = "";

const shown = () => (value("shows") in shows ? value("shows") : "section");

const hasSides = () => zoneOf(value("task"))?.shape !== "circle";

/** What stands under the hand has no other place to go. @param {Spot} at */
const here = ({ x, z }) => ({ at: [x, z], ...(hasSides() && value("angle") === "" && typeof proved.angle_deg === "number" ? { angle: String(proved.angle_deg) } : {}) });

const evaluate = oneInFlight(async (/** @type {Spot} */ at) => {
  tell(await fields("place", question("place", here(at))), at);
});

/** @param {Spot} at */
function moving(at) {
  evaluate(at);
}

/** @param {Spot} at */
function moved(at) {
  const { angle } = here(at);
  change({ at: `${rounded(at.x)},${rounded(at.z)}`, ...(angle ? { angle } : {}) });
}

/** @param {import("./zone.js").Zone} zone */
function resized(zone) {
  change({ task: taskOf(zone) });
}

/** @param {number} deg */
function turned(deg) {
  if (!hasSides()) return;
  const given = Number.parseFloat(value("angle"));
  const now = Number.isFinite(given) ? given : Number(proved.angle_deg) || 0;
  change({ angle: String((now + deg + 180) % 180) });
}

/** What is asked of the best place within a window, which no place by hand is. @param {string} within */
const bestWithin = (within) => ({ within, at: "", ...(value("at") === "" ? {} : { angle: "" }) });

const search = oneInFlight(async (/** @type {string} */ within) => {
  const asked = Object.fromEntries(Object.entries(bestWithin(within)).map(([name, text]) => [name, text === "" ? undefined : text]));
  const found = await fields("place", question("place", asked));
  if (!section.window.isHeld) return;
  tell(found, null, false);
  section.lay(found, found);
});

/** @param {import("./window.js").Window} window */
function limiting(window) {
  search(textOf(window));
}

/** @param {import("./window.js").Window} window */
function limited(window) {
  change(bestWithin(textOf(window)));
}

/** The values of a place that stands, or is under the hand. @param {any} found @param {Spot | null} at @param {boolean} [isHere] it was set by hand */
function tell(found, at, isHere = at !== null || value("at") !== "") {
  const mm = (/** @type {unknown} */ number, digits = 4) => (typeof number === "number" ? number.toFixed(digits) : "");
  const inCell = (/** @type {number[]} */ [x, y, z]) => `x ${mm(x, 3)}, y ${mm(y, 3)}, z ${mm(z, 3)} m in the cell`;
  const point = (/** @type {number[]} */ [x, , z]) => `x ${mm(x, 3)}, z ${mm(z, 3)} m`;
  const told = found.cell_m ? inCell : point;
  const where = found.cell_m ? inCell(found.cell_m) : at ? point([at.x, 0, at.z]) : point([found.x_m, 0, found.z_m]);
  /** @type {[string, string][]} */
  const rows = found.feasible
    ? [
        ["deflection", `${mm(found.deflection_mm)} mm`], ["stands at", where], ["worst point", told(found.worst_point_m ?? [])],
        ["smallest margin", `${mm(found.smallest_margin_deg, 1)} deg, ${found.smallest_margin_of ?? ""}`],
      ]
    : [["deflection", "not reached"], ["stands at", at || typeof found.x_m === "number" ? where : "no place"], ["why", String(found.reason ?? "")]];
  if (found.feasible && typeof found.clearance_mm === "number") rows.push(["clearance", `${mm(found.clearance_mm, 0)} mm, ${found.clearance_of ?? ""}`]);
  if (isHere && typeof proved.deflection_mm === "number") rows.push(["best place", `${mm(proved.deflection_mm)} mm, x ${mm(proved.x_m, 3)}, z ${mm(proved.z_m, 3)} m`]);
  if (isHere && value("within") !== "") rows.push(["window", "left out: the place is set by hand"]);
  live.replaceChildren(
    verdict(rows.shift()?.[1] ?? "", `worst deflection in the zone ${isHere ? "here" : "at its best place"}`, found, rests),
    el("dl", {}, rows.flatMap(([name, text]) => [el("dt", {}, [name]), el("dd", {}, [text])])),
  );
  section.zone.mark(stateOf(found));
}

let rests = "";

function draw() {
  const names = { section: "section", space: "in space", compare: "side by side", study: "architectures" };
  tabs.replaceChildren(...Object.entries(names).map(([name, label]) => button(label, () => change({ shows: name === "section" ? "" : name }), { "aria-pressed": String(name === shown()) })));
  tabs.append(el("span", { class: "gap" }), button("add to compare", () => add(value("robot"))), best);
  for (const [name, box] of Object.entries(shows)) box.hidden = name !== shown();
  best.toggleAttribute("disabled", value("at") === "");
}

/** @param {AbortSignal} signal */
async function drawStudy(signal) {
  const now = question("study");
  if (studied === JSON.stringify(now)) return;
  await study.show((await forms("study", now, ["svg"], signal, progress)).svg ?? "");
  studied = JSON.stringify(now);
}

/** @type {import("./page.js").View} */
export const place = {
  verb: "place",
  parts: () => [
    { verb: "place", title: "Where must the work stand?", first: ["robot", "task", "force-n", "tolerance-mm", "model", "tool", "within", "at", "angle"] },
    ...(shown() === "study" ? [{ verb: "study", title: "Architectures", first: ["tasks", "ratios", "compare"] }] : []),
  ],
  mount(look, decide) {
    draw();
    look.replaceChildren(tabs, ...Object.values(shows));
    /** @type {[string, string][]} */
    const kinds = [["SVG", "svg"], ["PNG", "png"], ["PDF", "pdf"], ["shop drawing", "shop"], ["CSV", "csv"], ["JSON", "json"], ["in space", "view"], ["report", "report"]];
    decide.replaceChildren(live, says, takeaway(asked, kinds));
  },
  async update(signal) {
    draw();
    const anywhere = question("place", { at: undefined, ...(value("at") === "" ? {} : { angle: undefined }) });
    const [now, ofBest] = [question("place"), JSON.stringify(anywhere)];
    const isBest = value("at") === "";
    if (!isBest && provedOf !== ofBest) {
      provedOf = "";
      proved = (await forms("place", anywhere, ["json"], signal, progress)).json;
    }
    const isDrawn = shown() === "section";
    const { json: answer, tables: { tables, sentences }, svg } = await forms("place", now, ["json", "tables", ...(isDrawn ? ["svg"] : [])], signal, progress);
    if (isBest) proved = answer;
    provedOf = ofBest;
    const { lead } = tables[0];
    rests = lead.rests_on;
    tell(answer, null);
    says.replaceChildren(...tables.map(list), words(sentences.flat()));
    say([answer.feasible ? lead.value : "no place", wordOf(answer)].filter(Boolean).join(", "));
    if (isDrawn) await section.update(answer, proved, svg ?? (await section.map(signal)));
    if (shown() === "space") space.show(asked());
    if (shown() === "compare") await comparison.update(signal);
    if (shown() === "study") await drawStudy(signal);
  },
};
