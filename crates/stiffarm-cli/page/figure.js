// How is a picture of the server shown, and how does what it shows come to the user's disk?

import { Refusal, addressOf, call, written } from "./ask.js";
import { button, byId, el, save, say } from "./dom.js";

/** @typedef {import("./ask.js").Question} Question */
/** @typedef {{verb: string, question: Question}} Asked */

/** A picture that stays until the next one is there. */
export class Picture {
  /** @param {string} alt */
  constructor(alt) {
    this.image = el("img", { alt, class: "picture" });
    this.svg = "";
  }

  /** @param {string} svg @param {string} [alt] */
  async show(svg, alt = this.image.alt) {
    this.svg = svg;
    const before = this.image.src;
    this.image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
    this.image.alt = alt;
    await this.image.decode().catch(() => undefined);
    if (before) URL.revokeObjectURL(before);
  }
}

/** What a picture says of itself. @param {string} svg */
const rootOf = (svg) => new DOMParser().parseFromString(svg.slice(0, svg.indexOf(">") + 1).replace(/\/?>$/, "/>"), "image/svg+xml").documentElement;

/** Where something stands in the picture, px, with two numbers more, if the picture says so. @param {string} svg @param {string} name */
export function boxOf(svg, name) {
  if (svg === "") return null;
  const root = rootOf(svg);
  const [left, top, right, bottom, from, to] = (root.getAttribute(`data-${name}`) ?? "").split(" ").map(Number);
  const [, , width, height] = (root.getAttribute("viewBox") ?? "").split(/\s+/).map(Number);
  if (left === undefined || top === undefined || right === undefined || bottom === undefined || from === undefined || to === undefined || !width || !height) return null;
  return { left, top, right, bottom, from, to, width, height };
}

/** @typedef {NonNullable<ReturnType<typeof boxOf>>} Box */

/** Where the pixels of a map lie in metres, if the picture says so. @param {string} svg */
export function scaleOf(svg) {
  const root = rootOf(svg);
  const read = (/** @type {string} */ name) => Number.parseFloat(root.getAttribute(name) ?? "");
  const [x0, x0m, perM, z0, z0m] = ["data-x0-px", "data-x0-m", "data-px-per-m", "data-z0-px", "data-z0-m"].map(read);
  const [, , width, height] = (root.getAttribute("viewBox") ?? "").split(/\s+/).map(Number);
  if (x0 === undefined || x0m === undefined || !perM || z0 === undefined || z0m === undefined || !width || !height) return null;
  if ([x0, x0m, perM, z0, z0m].some(Number.isNaN)) return null;
  return {
    width, height, perM,
    px: (/** @type {number} */ x) => x0 + (x - x0m) * perM,
    py: (/** @type {number} */ z) => z0 - (z - z0m) * perM,
    x: (/** @type {number} */ px) => x0m + (px - x0) / perM,
    z: (/** @type {number} */ py) => z0m - (py - z0) / perM,
  };
}

/** @typedef {NonNullable<ReturnType<typeof scaleOf>>} Scale */

/** The place under the pointer, m. @param {Element} over what lies over the whole picture @param {Scale} scale @param {PointerEvent} event */
export function spotUnder(over, scale, event) {
  const box = over.getBoundingClientRect();
  const per = scale.width / box.width;
  return { x: scale.x((event.clientX - box.left) * per), z: scale.z((event.clientY - box.top) * per) };
}

/** @param {Asked} asked @param {string} as @param {HTMLElement} refused where it is said that there is none */
async function download({ verb, question }, as, refused) {
  refused.textContent = "";
  try {
    const reply = await written(verb, question, as);
    const named = /filename="?([^";]+)"?/.exec(reply.headers.get("Content-Disposition") ?? "")?.[1] ?? `${verb}.${as}`;
    save(await reply.blob(), named);
    say(`${named} is downloaded`);
  } catch (fault) {
    refused.textContent = wordsOf(fault);
  }
}

/** @param {unknown} fault */
function wordsOf(fault) {
  return fault instanceof Refusal ? [fault.message, fault.hint].filter(Boolean).join("\n") : String(fault instanceof Error ? fault.message : fault);
}

/** @param {unknown} fault */
export function tellFault(fault) {
  byId("fault").textContent = wordsOf(fault);
}

/** What can be taken away of an answer. @param {() => Asked} asked @param {[string, string][]} kinds label and form */
export function takeaway(asked, kinds) {
  const box = el("div", { class: "takeaway" });
  const code = el("div", { class: "code" });
  const refused = el("p", { class: "fault", role: "alert" });
  const show = async () => {
    try {
      const { verb, question } = asked();
      const { command, python } = await call(`${addressOf(verb)}?as=command`, question);
      code.replaceChildren(snippet("as command", command), snippet("as Python", python));
    } catch (fault) {
      refused.textContent = wordsOf(fault);
    }
  };
  box.append(el("h2", {}, ["Take it along"]));
  const buttons = kinds.map(([label, as]) => button(label, () => download(asked(), as, refused), { "aria-label": `download ${label}` }));
  box.append(el("div", { class: "buttons" }, [...buttons, button("as command, as Python", show)]), refused, code);
  return box;
}

/** @param {string} label @param {string} text */
function snippet(label, text) {
  const copy = async () => {
    await navigator.clipboard.writeText(text);
    say(`${label} is copied`);
  };
  return el("figure", {}, [el("figcaption", {}, [label, " ", button("copy", copy, { "aria-label": `copy ${label}` })]), el("pre", { tabindex: "0" }, [el("code", {}, [text])])]);
}

/** The view in space, in a frame of its own that may run the scripts which it carries and reaches nothing else. */
export class Space {
  constructor() {
    this.box = el("div", { class: "space" });
    this.shown = "";
  }

  clear() {
    this.box.replaceChildren();
    this.shown = "";
  }

  /** @param {Asked} asked */
  show({ verb, question }) {
    const now = JSON.stringify(question);
    if (this.shown === now) return;
    this.shown = now;
    const frame = el("iframe", { sandbox: "allow-scripts", name: `space-of-${verb}`, title: "view in space" });
    const form = el("form", { method: "post", action: `/view/${verb}`, target: frame.name, hidden: true }, [el("input", { type: "hidden", name: "question", value: now })]);
    this.box.replaceChildren(frame, form);
    form.submit();
  }
}
