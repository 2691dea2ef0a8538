// Which of two setups is better? Two robots side by side, on one scale.

import { list, words } from "./answer.js";
import { Refusal, forms } from "./ask.js";
import { button, el, say } from "./dom.js";
import { Picture, takeaway } from "./figure.js";
import { change, question, value } from "./state.js";
import { progress } from "./work.js";

/** @returns {string[]} */
export const setups = () => value("setups").split("|").filter((name) => name !== "");

/** The latest two are compared. @param {string} name */
export function add(name) {
  change({ setups: [...setups().filter((other) => other !== name), name].slice(-2).join("|") });
  say(`${name} is compared`);
}

/** The two, with what can be done about them. */
export class Comparison {
  constructor() {
    this.box = el("section", { class: "compare", "aria-label": "two setups side by side" });
    this.shown = "";
  }

  question() {
    const [a, b] = setups();
    return question("compare", { a, b });
  }

  /** @param {AbortSignal} signal */
  async update(signal) {
    const [a, b] = setups();
    const now = JSON.stringify([this.question(), setups()]);
    if (now === this.shown) return;
    const drops = setups().map((name) => button(`${name} ×`, () => change({ setups: setups().filter((other) => other !== name).join("|") }), { class: "chip", "aria-label": `do not compare ${name}` }));
    const head = [el("h2", {}, ["Side by side"]), el("div", { class: "chips" }, drops)];
    if (!a || !b) {
      this.box.replaceChildren(...(a ? [...head, el("p", {}, ["add one more robot to compare it with"])] : []));
      this.shown = now;
      return;
    }
    try {
      const { svg, tables: { tables, sentences } } = await forms("compare", this.question(), ["tables", "svg"], signal, progress);
      const picture = new Picture(`maps of ${a} and ${b} on one scale`);
      await picture.show(svg ?? "");
      const sheets = tables.map((/** @type {import("./answer.js").Sheet} */ sheet) => el("div", { class: "wide", tabindex: "0", role: "region", "aria-label": "two setups" }, [list(sheet)]));
      const take = takeaway(() => ({ verb: "compare", question: this.question() }), [["SVG", "svg"], ["PNG", "png"], ["PDF", "pdf"], ["CSV", "csv"], ["JSON", "json"]]);
      this.box.replaceChildren(...head, words(sentences.flat(), "verdict says"), picture.image, ...sheets, take);
      this.shown = now;
    } catch (fault) {
      if (!(fault instanceof Refusal)) throw fault;
      this.box.replaceChildren(...head, el("p", { role: "alert" }, [fault.message]), el("p", {}, [fault.hint]));
    }
  }
}
