// How stiff is my robot really? What to measure, and what follows of it.

import { fields, watched, written } from "./ask.js";
import { button, el, say } from "./dom.js";
import { Picture, takeaway } from "./figure.js";
import { opener, useRobot } from "./open.js";
import { change, question, value } from "./state.js";
import { list, read, sortable, under, verdict, words } from "./told.js";
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
    const answer = await watched("measure", now, signal, progress);
    const told = read(await (await written("measure", now, "md", signal)).text());
    const [about, runs] = told.sheets;
    const label = under(about, /^precision/);
    says.replaceChildren(
      verdict(label, `precision that ${answer.runs?.length ?? 0} measurements give`, null, under(about, /^stiffness$/)),
      ...(about ? [list(about, /^(stiffness|precision)/)] : []),
      words(told.sentences.flat()),
    );
    if (runs) plan.replaceChildren(sortable(runs, "postures to measure"), drawn.image);
    await drawn.show(await (await written("measure", now, "svg", signal)).text());
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
  await fields("identify", now, signal);
  const [markdown, svg] = await Promise.all(["md", "svg"].map(async (as) => (await written("identify", now, as, signal)).text()));
  const told = read(markdown ?? "");
  const [about, drives] = told.sheets;
  await picture.show(svg ?? "");
  fit.replaceChildren(el("h2", {}, ["What the measurements say"]), picture.image, ...(drives ? [sortable(drives, "drives as found")] : []));
  const label = under(about, /^not explained/);
  found.replaceChildren(
    verdict(label, "not explained by the drives as found", null, under(about, /^fit$/)),
    ...(about ? [list(about, /^(fit|not explained)$/)] : []),
    words(told.sentences.flat()),
    button("use this robot in the other views", () => useRobot("identify", "identified.toml"), { class: "main" }),
    takeaway(identified, [["robot file", "toml"], ["CSV", "csv"], ["SVG", "svg"], ["PNG", "png"], ["JSON", "json"], ["report", "report", "html"]]),
  );
  say(label);
}
