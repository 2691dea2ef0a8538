// How far is the work, how is it called off, and what does a fault say?

import { byId, button } from "./dom.js";
import { Newest } from "./ask.js";
import { faulty } from "./form.js";

/** @typedef {import("./ask.js").Progress} Progress */

const newest = new Newest();
let running = 0;

/** @param {Progress} at */
export function progress({ doing, done, total }) {
  byId("doing").textContent = total === null ? `${doing} ${done}` : `${doing} ${done} of ${total}`;
  const bar = /** @type {HTMLProgressElement} */ (byId("done"));
  bar.removeAttribute("value");
  if (total === null) return;
  bar.max = total;
  bar.value = done;
}

/** The question of the view: a new one cancels the one before; what it says stands where it belongs. @param {(signal: AbortSignal) => Promise<void>} task */
export async function work(task) {
  const mine = ++running;
  const strip = byId("working");
  const soon = setTimeout(() => {
    byId("doing").textContent = "computing";
    byId("done").removeAttribute("value");
    strip.hidden = false;
  }, 250);
  document.body.setAttribute("aria-busy", "true");
  let isAnswered = false;
  try {
    await newest.run(async (signal) => {
      await task(signal);
      if (signal.aborted) return;
      faulty(null);
      isAnswered = true;
    });
  } catch (fault) {
    if (mine === running) faulty(/** @type {Error} */ (fault));
  }
  clearTimeout(soon);
  if (mine !== running) return;
  // Refused or called off: what is seen answers another question.
  document.body.toggleAttribute("data-stale", !isAnswered);
  strip.hidden = true;
  document.body.removeAttribute("aria-busy");
}

export function cancellable() {
  byId("working").append(button("cancel", () => newest.cancel(), { "aria-label": "cancel the work" }));
}
