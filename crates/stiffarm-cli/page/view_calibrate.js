// Does the file speak as the pendant does, and where does this very arm stand? Two tables, what follows of each, and the robot file.

import { list, sortable, verdict, words } from "./answer.js";
import { forms } from "./ask.js";
import { button, el, say } from "./dom.js";
import { Picture, takeaway } from "./figure.js";
import { useRobot } from "./open.js";
import { question, value } from "./state.js";
import { progress } from "./work.js";

const READINGS = "verify.data";
const POINTS = "calibrate.data";
const VERIFY = "robots verify";
const pendant = el("div", { "aria-live": "polite" });
const tracker = el("div", { "aria-live": "polite" });
const rows = el("section", { "aria-label": "what was read and measured" });
const picture = new Picture("every row's error, as drawn and calibrated");

/** @type {import("./page.js").View} */
export const calibrate = {
  get verb() {
    return value(POINTS) === "" && value(READINGS) !== "" ? VERIFY : "calibrate";
  },
  parts: () => [
    { verb: VERIFY, title: "At the pendant", first: ["robot", "data", "any"] },
    { verb: "calibrate", title: "With a tracker", first: ["data", "level", "at", "controller-model"] },
  ],
  mount(look, decide) {
    look.replaceChildren(rows);
    decide.replaceChildren(pendant, tracker);
  },
  async update(signal) {
    const shown = [await verified(signal), await calibrated(signal)].flat();
    rows.replaceChildren(...shown);
    if (shown.length > 0) return;
    const asked = "Open a table of six postures read from the pendant, or of points that a tracker measured.";
    pendant.replaceChildren(verdict("no table yet", "whether the file counts as the robot does, and by how much the arm errs", null, asked));
  },
};

/** @param {AbortSignal} signal @returns {Promise<Node[]>} */
async function verified(signal) {
  pendant.replaceChildren();
  if (value(READINGS) === "") return [];
  const now = question(VERIFY);
  const { json: answer, tables: { tables, sentences } } = await forms(VERIFY, now, ["json", "tables"], signal, progress);
  // Of all robots there is the table of them alone.
  const isOfOne = "robot" in answer;
  const about = isOfOne ? tables[0] : undefined;
  const fits = tables[isOfOne ? 1 : 0];
  const label = answer.verified ? "verified" : isOfOne ? "NOT verified" : String(answer.fits[0]?.robot ?? "none");
  pendant.append(
    verdict(label, isOfOne ? "the file counts the joints as they were read" : "the robot that fits best", null, about?.lead?.rests_on ?? ""),
    ...(about ? [list(about)] : []),
    words(sentences.flat()),
    ...(answer.verified ? [button("use this file in the other views", () => useRobot(VERIFY, "verified.toml"), { class: "main" })] : []),
    takeaway(() => ({ verb: VERIFY, question: question(VERIFY) }), [...(isOfOne ? [/** @type {[string, string]} */ (["robot file", "toml"])] : []), ["CSV", "csv"], ["JSON", "json"]]),
  );
  say(label);
  return fits ? [el("h2", {}, ["Ways of counting the joints"]), sortable(fits, "ways of counting the joints")] : [el("h2", {}, ["At the pendant"]), words([`${value(READINGS)}: nothing fits better than the file.`])];
}

/** @param {AbortSignal} signal @returns {Promise<Node[]>} */
async function calibrated(signal) {
  tracker.replaceChildren();
  if (value(POINTS) === "") return [];
  const now = question("calibrate");
  const { tables: { tables, sentences }, svg } = await forms("calibrate", now, ["json", "tables", "svg"], signal, progress);
  const [about, levels] = tables;
  await picture.show(svg ?? "");
  const { value: label, means, rests_on: atWork } = about.lead;
  tracker.append(
    verdict(label, means, null, `at the work: ${atWork}`),
    list(about),
    words(sentences.flat()),
    button("use this robot in the other views", () => useRobot("calibrate", "calibrated.toml"), { class: "main" }),
    takeaway(() => ({ verb: "calibrate", question: question("calibrate") }), [["robot file", "toml"], ["CSV", "csv"], ["SVG", "svg"], ["PNG", "png"], ["JSON", "json"], ["report", "report"]]),
  );
  say(label);
  return [el("h2", {}, ["Every row, as drawn and calibrated"]), picture.image, ...(levels ? [sortable(levels, "what each level leaves")] : [])];
}
