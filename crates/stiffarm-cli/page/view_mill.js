// Does this program hold the tolerance? The error along a toolpath, at rolls that are proved best.

import { fields, watched, written } from "./ask.js";
import { button, el, say } from "./dom.js";
import { Picture, Space, takeaway } from "./figure.js";
import { change, question, value } from "./state.js";
import { list, read, under, verdict, words } from "./told.js";
import { progress } from "./work.js";

const picture = new Picture("error along the path, every roll of the tool, and the path from above");
const space = new Space();
const says = el("div", { "aria-live": "polite" });
const path = el("div");
const inSpace = button("in space", () => change({ space: value("space") === "" ? "yes" : "" }), { "aria-pressed": "false" });
const best = button("best place", () => change({ "mill.at": "" }), { title: "seeks the best place of the part, with a lower bound" });
const programs = el("div");
const asked = () => ({ verb: "mill", question: question("mill") });
/** @type {[string, string, string?][]} */
const PICTURES = [["SVG", "svg"], ["PNG", "png"], ["PDF", "pdf"], ["CSV of samples", "csv"], ["JSON", "json"], ["report", "report", "html"]];
/** @type {[string, string, string?][]} */
const PROGRAMS = [["KUKA .src", "src"], ["ABB .mod", "mod"], ["Fanuc .ls", "ls"], ["path .nc", "nc"], ["path .apt", "apt"]];

/** @type {import("./page.js").View} */
export const mill = {
  verb: "mill",
  parts: () => [
    { verb: "mill", title: "Does the program hold it?", first: ["path", "robot", "process", "force-n", "at", "tolerance-mm", "roll", "compensate", "tool"] },
  ],
  mount(look, decide) {
    look.replaceChildren(el("div", { class: "tools", role: "toolbar", "aria-label": "what is shown" }, [best, inSpace]), space.box, picture.image, path);
    decide.replaceChildren(says, takeaway(asked, PICTURES), programs);
  },
  async update(signal) {
    const now = question("mill");
    if (now.options["robot"] === undefined || now.options["dry"] === true) return dry(signal);
    const answer = await watched("mill", now, signal, progress);
    const markdown = await (await written("mill", now, "md", signal)).text();
    const told = read(markdown);
    const [sheet] = told.sheets;
    const label = answer.feasible ? under(sheet, /^largest error/) : "no place";
    const means = answer.feasible ? "largest error of the tool along the path" : String(answer.reason ?? "");
    says.replaceChildren(
      verdict(label, means, answer.pass, under(sheet, /^stiffness$/)),
      ...told.sheets.map((sheet) => list(sheet, /^(stiffness|largest error)$/)),
      words(told.sentences.flat()),
    );
    programs.replaceChildren(...(answer.compensation ? [takeaway(asked, PROGRAMS)] : [el("p", { class: "notes" }, ["with “compensate” programs for KUKA, ABB and Fanuc, and the path led aside, can be downloaded"])]));
    say(`${label} ${answer.pass === false ? "fail" : ""}`);
    best.toggleAttribute("disabled", value("mill.at") === "");
    inSpace.setAttribute("aria-pressed", String(value("space") !== ""));
    await picture.show(await (await written("mill", now, "svg", signal)).text().catch(() => ""));
    if (value("space") === "") space.clear();
    else space.show({ verb: "mill", question: now });
  },
};

/** What was understood of the path, where no robot is asked. @param {AbortSignal} signal */
async function dry(signal) {
  const now = question("mill", { dry: true });
  await fields("mill", now, signal);
  const told = read(await (await written("mill", now, "md", signal)).text());
  says.replaceChildren(...told.sheets.map((sheet) => list(sheet)), words(told.sentences.flat()));
}
