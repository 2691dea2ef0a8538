// Does this program hold the tolerance? The error along a toolpath, at rolls that are proved best.

import { list, renumber, stateOf, verdict, wordOf, words } from "./answer.js";
import { fields, forms, oneInFlight } from "./ask.js";
import { CellPlan, textOf as standOf } from "./cell.js";
import { button, el, say } from "./dom.js";
import { Picture, Space, takeaway } from "./figure.js";
import { Rolls, pinsOf, textOf } from "./rolls.js";
import { change, question, value } from "./state.js";
import { progress } from "./work.js";

/** @typedef {import("./rolls.js").Pin} Pin */

const rolls = new Rolls({ moving: (pins) => solve(pins), moved: (pins) => change(pinned(pins)) });
const cell = new CellPlan({ moving: (at) => stand(at), moved: (at) => change({ "mill.at": standOf(at) }) });
const space = new Space();
const lobes = new Picture("from which depth the worst cut swings, by the speed of the spindle");
const asksChatter = () => value("mill.chatter") === "true";
const says = el("div", { "aria-live": "polite" });
const shows = /** @type {Record<string, HTMLElement>} */ ({ rolls: rolls.box, cell: cell.box, space: space.box, lobes: el("div", {}, [lobes.image]) });
const tabs = el("div", { class: "tools", role: "toolbar", "aria-label": "what is shown" });
const best = button("best place", () => change({ "mill.at": "", "mill.pin": "" }), { title: "seeks the best place of the part, with a lower bound" });
const pinning = button("pin a roll", () => change(pinned([...pinsOf(value("mill.pin")), middle()])), { title: "holds the roll in the middle of the path; a click on the map of rolls pins it there" });
const unpinning = button("no pins", () => change({ "mill.pin": "" }));
const programs = el("div");
/** @type {any} What was answered last. */
let latest = {};
const shown = () => (value("milled") in shows && (value("milled") !== "lobes" || asksChatter()) ? value("milled") : "rolls");
const asked = () => ({ verb: "mill", question: question("mill") });
/** @type {[string, string][]} */
const PICTURES = [["SVG", "svg"], ["PNG", "png"], ["PDF", "pdf"], ["shop drawing", "shop"], ["CSV of samples", "csv"], ["JSON", "json"], ["report", "report"]];
/** @type {[string, string][]} */
const PROGRAMS = [["KUKA .src", "src"], ["ABB .mod", "mod"], ["Fanuc .ls", "ls"], ["path .nc", "nc"], ["path .apt", "apt"]];

function draw() {
  const names = { rolls: "rolls", cell: "in the cell", space: "in space", ...(asksChatter() ? { lobes: "chatter" } : {}) };
  tabs.replaceChildren(...Object.entries(names).map(([name, label]) => button(label, () => change({ milled: name === "rolls" ? "" : name }), { "aria-pressed": String(name === shown()) })));
  tabs.append(el("span", { class: "gap" }), pinning, unpinning, best);
  for (const [name, box] of Object.entries(shows)) box.hidden = name !== shown();
}

/** Half way along the path, the roll between the smallest and the largest that is taken. @returns {Pin} */
function middle() {
  const { from_deg = 0, to_deg = 0 } = latest.roll ?? {};
  return { mm: 500 * (latest.part?.length_m ?? 0), deg: (from_deg + to_deg) / 2 };
}

/** Pins are of a part that stands somewhere, and leave the rolls between them free. @param {Pin[]} pins */
function pinned(pins) {
  const stands = standing();
  const at = value("mill.at") === "" && stands ? { "mill.at": stands.map((number) => Number(number.toFixed(6))).join(",") } : {};
  return { ...at, "mill.pin": textOf(pins), ...(pins.length > 0 ? { "mill.roll": "" } : {}) };
}

/** @param {string} drawn nothing where the path is not followed */
async function showRolls(drawn) {
  const pins = pinsOf(value("mill.pin"));
  // A pin that nothing holds is dragged away again: the picture stays, and pales.
  const stays = drawn === "" && pins.length > 0;
  rolls.box.toggleAttribute("data-stale", stays);
  await rolls.show(stays ? rolls.picture.svg : drawn, pins);
}

/** Where the path's origin stands, as was answered last and as `at` counts it: in the cell, where there is one. @returns {import("./cell.js").Stand | null} */
function standing() {
  const [[x, y, z], yaw] = latest.cell_m ? [latest.cell_m, latest.cell_yaw_deg] : [latest.at_m ?? [], latest.at_yaw_deg];
  return [x, y, z, yaw].every((number) => typeof number === "number") ? [x, y, z, yaw] : null;
}

/** The value while the part is in the hand. */
const stand = oneInFlight(async (/** @type {import("./cell.js").Stand} */ at) => {
  const found = await fields("mill", question("mill", { at: standOf(at).split(",").map(Number) }));
  renumber(found.feasible ? `${found.worst_mm.toFixed(4)} mm` : "not followed", found);
  cell.mark(stateOf(found));
});

/** The rolls while a pin is in the hand. */
const solve = oneInFlight(async (/** @type {Pin[]} */ pins) => {
  const { "mill.at": at = value("mill.at") } = /** @type {Record<string, string>} */ (pinned(pins));
  const now = question("mill", { at: at.split(",").map(Number), pin: textOf(pins), roll: undefined });
  await rolls.show((await forms("mill", now, ["svg"])).svg ?? "", pins);
});

/** @type {import("./page.js").View} */
export const mill = {
  verb: "mill",
  parts: () => [
    { verb: "mill", title: "Does the program hold it?", first: ["path", "robot", "process", "force-n", "at", "part", "fixture", "stick-out-mm", "tolerance-mm", "roll", "pin", "compensate", "tool", "chatter", "tool-mass-kg", "tool-com-mm"] },
  ],
  mount(look, decide) {
    draw();
    look.replaceChildren(tabs, ...Object.values(shows));
    decide.replaceChildren(says, takeaway(asked, PICTURES), programs);
  },
  async update(signal) {
    draw();
    const now = question("mill");
    if (now.options["robot"] === undefined || now.options["dry"] === true) return dry(signal);
    const wanted = ["json", "tables", "svg", "shop", ...(asksChatter() ? ["lobes"] : [])];
    const { json: answer, tables: { tables, sentences }, svg, shop, lobes: depths } = await forms("mill", now, wanted, signal, progress);
    latest = answer;
    // Of several tools no table of one decides.
    const { lead } = tables.find((/** @type {import("./answer.js").Sheet} */ sheet) => sheet.lead) ?? {};
    const label = answer.feasible ? lead.value : value("mill.at") === "" ? "no place" : "not followed";
    const means = answer.feasible ? lead.means : String(answer.reason ?? "");
    says.replaceChildren(verdict(label, means, answer, lead?.rests_on ?? ""), ...tables.map(list), words(sentences.flat()));
    programs.replaceChildren(...(answer.compensation ? [takeaway(asked, PROGRAMS)] : [el("p", { class: "notes" }, ["with “compensate” programs for KUKA, ABB and Fanuc, and the path led aside, can be downloaded"])]));
    say([label, wordOf(answer)].filter(Boolean).join(", "));
    best.toggleAttribute("disabled", value("mill.at") === "");
    pinning.toggleAttribute("disabled", !answer.feasible);
    unpinning.toggleAttribute("disabled", value("mill.pin") === "");
    if (shown() === "rolls") await showRolls(answer.feasible ? (svg ?? "") : "");
    if (shown() === "cell") await cell.show(shop ?? "", standing(), stateOf(answer));
    if (shown() === "lobes") await lobes.show(depths ?? "");
    if (shown() === "space") space.show({ verb: "mill", question: now });
    else space.clear();
  },
};

/** What was understood of the path, where no robot is asked. @param {AbortSignal} signal */
async function dry(signal) {
  const now = question("mill", { dry: true });
  const { tables: { tables, sentences } } = await forms("mill", now, ["json", "tables"], signal, progress);
  await rolls.show("", []);
  says.replaceChildren(...tables.map(list), words(sentences.flat()));
}
