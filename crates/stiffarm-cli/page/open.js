// How does a file come into the questions: opened by the user, or made by an answer?

import { written } from "./ask.js";
import { button, el, say } from "./dom.js";
import { tellFault } from "./figure.js";
import { change, keep, question } from "./state.js";

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

/** The robot file that the answer of a verb has, used at once. @param {string} verb @param {string} name */
export async function useRobot(verb, name) {
  try {
    const text = await (await written(verb, question(verb), "toml")).text();
    keep([[name, text]]);
    change({ robot: name }, "place");
  } catch (fault) {
    tellFault(fault);
  }
}
