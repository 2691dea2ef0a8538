// How stiff is my robot really? What to measure, and what follows of it.

import { list, sortable, verdict, words } from "./answer.js";
import { forms } from "./ask.js";
import { button, el, say } from "./dom.js";
import { Picture, takeaway } from "./figure.js";
import { opener, useRobot } from "./open.js";
import { change, question, value } from "./state.js";
import { progress } from "./work.js";

const DATA = "identify.data";
const plan = el("div", { class: "plan" });
const fit = el("section", { "aria-label": "what the measurements say" });
const says = el("div", { "aria-live": "polite" });
const found = el("div");
const picture = new Picture("what remains of the measurements, by the model");
const drawn = new Picture("the postures to measure, each from the side of the arm");
const measured = () => ({ verb: "measure", question: question("measure") });
const identified = () => ({ verb: "identify", question: question("identify") });

/** @type {import("./page.js").View} */
export const measure = {
  verb: "measure",
  parts: () => [
    { verb: "measure", title: "What to measure", first: ["robot", "task", "runs", "loads", "force-n", "load-mm"] },
    { verb: "identify", title: "What was measured", first: ["data", "model", "fit", "prior"] },
  ],
  mount(look, decide) {
    look.replaceChildren(fit, el("h2", {}, ["Postures to measure"]), el("div", { class: "tools" }, [button("print", () => print()), opener("open the filled-in table", "filled", (name) => change({ [DATA]: name }), "open the filled-in table")]), plan);
    decide.replaceChildren(found, says, takeaway(measured, [["table to fill in", "csv"], ["SVG", "svg"], ["PDF", "pdf"], ["JSON", "json"]]));
  },
  async update(signal) {
    await identify(signal);
    const now = question("measure");
    const { tables: { tables, sentences }, svg } = await forms("measure", now, ["json", "tables", "svg"], signal, progress);
    const [about, runs] = tables;
    const { value: label, means, rests_on } = about.lead;
    says.replaceChildren(
      verdict(label, means, null, rests_on),
      list(about),
      words(sentences.flat()),
    );
    if (runs) plan.replaceChildren(sortable(runs, "postures to measure"), drawn.image);
    await drawn.show(svg ?? "");
    if (value(DATA) === "") say(label);
  },
};

/** @param {AbortSignal} signal */
async function identify(signal) {
  if (value(DATA) === "") {
    fit.replaceChildren();
    found.replaceChildren();
    return;
  }
  const now = question("identify");
  const { tables: { tables, sentences }, svg } = await forms("identify", now, ["json", "tables", "svg"], signal, progress);
  const [about, drives] = tables;
  await picture.show(svg ?? "");
  fit.replaceChildren(el("h2", {}, ["What the measurements say"]), picture.image, ...(drives ? [sortable(drives, "drives as found")] : []));
  const { value: label, means, rests_on } = about.lead;
  found.replaceChildren(
    verdict(label, means, null, rests_on),
    list(about),
    words(sentences.flat()),
    button("use this robot in the other views", () => useRobot("identify", "identified.toml"), { class: "main" }),
    takeaway(identified, [["robot file", "toml"], ["CSV", "csv"], ["SVG", "svg"], ["PNG", "png"], ["JSON", "json"], ["report", "report"]]),
  );
  say(label);
}
