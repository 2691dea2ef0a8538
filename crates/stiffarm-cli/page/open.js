// How is a file of the user opened, so that questions can name it?

import { button, el, say } from "./dom.js";
import { files } from "./state.js";

/** A button that opens a file, and keeps its text. @param {string} label @param {string} id @param {(name: string, text: string) => void} then @param {string} [shown] */
export function opener(label, id, then, shown = "open file") {
  const file = el("input", { type: "file", class: "unseen", "aria-label": label, id: `${id}.file`, tabindex: "-1" });
  file.addEventListener("change", async () => {
    const [chosen] = file.files ?? [];
    if (!chosen) return;
    const text = await chosen.text();
    files.set(chosen.name, text);
    say(`opened ${chosen.name}`);
    then(chosen.name, text);
    file.value = "";
  });
  return el("span", { class: "opener" }, [button(shown, () => file.click(), { "aria-label": label }), file]);
}
