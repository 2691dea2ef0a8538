// How is a file of the user opened, so that questions can name it?

import { button, el, say } from "./dom.js";
import { keep } from "./state.js";

/** Bytes that may be no text, as an address that holds them. @param {File} file @returns {Promise<string>} */
function bytesOf(file) {
  const reader = new FileReader();
  return new Promise((then, otherwise) => {
    reader.addEventListener("load", () => then(String(reader.result)));
    reader.addEventListener("error", () => otherwise(reader.error));
    reader.readAsDataURL(file);
  });
}

/** A button that opens files, and keeps their texts: the one that no other of them names is the one that is asked for. @param {string} label @param {string} id @param {(name: string, text: string) => void} then @param {string} [shown] */
export function opener(label, id, then, shown = "open file") {
  const file = el("input", { type: "file", multiple: true, class: "unseen", "aria-label": label, id: `${id}.file`, tabindex: "-1" });
  file.addEventListener("change", async () => {
    const chosen = await Promise.all([...(file.files ?? [])].map(async (one) => ({ name: one.name, text: await (/\.stl$/i.test(one.name) ? bytesOf(one) : one.text()) })));
    file.value = "";
    const first = chosen.find(({ name }) => !chosen.some((other) => other.name !== name && other.text.includes(name))) ?? chosen[0];
    if (!first) return;
    keep(chosen.map(({ name, text }) => [name, text]));
    say(`opened ${chosen.map(({ name }) => name).join(", ")}`);
    then(first.name, first.text);
  });
  return el("span", { class: "opener" }, [button(shown, () => file.click(), { "aria-label": label }), file]);
}
