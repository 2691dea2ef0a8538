// How is the roll of the tool taken in the hand? Pins on the map of rolls that are set, dragged and moved by keys.

import { svg } from "./dom.js";
import { Picture, boxOf } from "./figure.js";

/** @typedef {{mm: number, deg: number}} Pin so far along the path, and the roll there */
/** @param {string} text such as 120@45,300@20 @returns {Pin[]} */
export function pinsOf(text) {
  const read = text.split(",").map((part) => part.split("@").map(Number));
  return read.flatMap(([mm, deg]) => (mm !== undefined && deg !== undefined && Number.isFinite(mm) && Number.isFinite(deg) ? [{ mm, deg: turned(deg) }] : []));
}

/** @param {Pin[]} pins */
export const textOf = (pins) => pins.map(({ mm, deg }) => `${Math.round(mm * 10) / 10}@${Math.round(deg * 10) / 10}`).join(",");

/** Within a turn. @param {number} deg */
const turned = (deg) => ((deg % 360) + 360) % 360;

/**
 * @typedef {object} Hand
 * @property {(pins: Pin[]) => void} moving while one is dragged
 * @property {(pins: Pin[]) => void} moved when it is let go
 */

/** The picture of a path that is milled, with its pins over the map of rolls. */
export class Rolls {
  /** @param {Hand} hand */
  constructor(hand) {
    this.hand = hand;
    this.picture = new Picture("error along the path, every roll of the tool, and the path from above");
    /** @type {import("./figure.js").Box | null} From where to where its way goes, mm. */
    this.frame = null;
    /** @type {Pin[]} */
    this.pins = [];
    /** @type {number | null} */
    this.held = null;
    this.ground = svg("rect", { class: "ground" });
    this.handles = svg("g", {});
    this.root = svg("svg", { class: "over", "aria-hidden": "false" });
    this.root.append(this.ground, this.handles);
    this.box = document.createElement("div");
    this.box.className = "rolls";
    this.box.append(this.picture.image, this.root);
    const root = /** @type {SVGElement} */ (this.root);
    root.addEventListener("pointerdown", (event) => this.taken(event));
    root.addEventListener("pointermove", (event) => this.dragged(event));
    for (const end of ["pointerup", "pointercancel"]) root.addEventListener(end, () => this.dropped());
    root.addEventListener("dblclick", (event) => this.removed(this.indexOf(event.target)));
    root.addEventListener("keydown", (event) => this.keyed(event));
  }

  /** @param {string} drawn @param {Pin[]} pins */
  async show(drawn, pins) {
    await this.picture.show(drawn);
    if (this.held !== null) return;
    this.frame = boxOf(drawn, "rolls");
    this.pins = pins.map((pin) => ({ ...pin }));
    this.draw();
  }

  draw() {
    const { frame } = this;
    this.root.setAttribute("display", frame ? "inline" : "none");
    if (!frame) return;
    const { left, top, right, bottom, width, height } = frame;
    this.root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    for (const [key, value] of Object.entries({ x: left, y: top, width: right - left, height: bottom - top })) this.ground.setAttribute(key, String(value));
    const focused = this.indexOf(document.activeElement);
    this.handles.replaceChildren(...this.pins.map((pin, index) => this.handle(pin, index, frame)));
    if (focused >= 0) /** @type {SVGElement | undefined} */ (this.handles.children[focused])?.focus();
  }

  /** @param {Pin} pin @param {number} index @param {import("./figure.js").Box} frame */
  handle({ mm, deg }, index, { left, top, right, bottom, from, to }) {
    const says = `${Math.round(deg * 10) / 10} deg at ${Math.round(mm * 10) / 10} mm`;
    return svg("circle", {
      class: "handle pin", "data-pin": index, r: 8, tabindex: 0, role: "slider",
      cx: left + ((mm - from) / (to - from)) * (right - left), cy: bottom - (deg / 360) * (bottom - top),
      "aria-label": `pinned roll ${index + 1} of ${this.pins.length}; arrow keys move it by 1 mm and 1 deg, with Shift by 10, Delete takes it away`,
      "aria-valuemin": 0, "aria-valuemax": 360, "aria-valuenow": Math.round(deg), "aria-valuetext": says,
    });
  }

  /** @param {EventTarget | null} target */
  indexOf(target) {
    const at = target instanceof Element ? target.getAttribute("data-pin") : null;
    return at === null ? -1 : Number(at);
  }

  /** What lies under the pointer. @param {PointerEvent} event @returns {Pin | null} */
  under(event) {
    const { frame } = this;
    if (!frame) return null;
    const box = this.root.getBoundingClientRect();
    const per = frame.width / box.width;
    const within = (/** @type {number} */ share) => Math.min(1, Math.max(0, share));
    const across = within(((event.clientX - box.left) * per - frame.left) / (frame.right - frame.left));
    const up = within((frame.bottom - (event.clientY - box.top) * per) / (frame.bottom - frame.top));
    return { mm: frame.from + across * (frame.to - frame.from), deg: Math.min(359.9, 360 * up) };
  }

  /** A pin is taken, or a new one set. @param {PointerEvent} event */
  taken(event) {
    const at = this.under(event);
    if (!at) return;
    event.preventDefault();
    const index = this.indexOf(event.target);
    this.held = index < 0 ? this.pins.push(at) - 1 : index;
    /** @type {SVGElement} */ (this.root).setPointerCapture(event.pointerId);
    this.draw();
    /** @type {SVGElement | undefined} */ (this.handles.children[this.held])?.focus();
    if (index < 0) this.hand.moving(this.pins);
  }

  /** @param {PointerEvent} event */
  dragged(event) {
    const at = this.held === null ? null : this.under(event);
    if (this.held === null || !at) return;
    this.pins[this.held] = at;
    this.draw();
    this.hand.moving(this.pins);
  }

  dropped() {
    if (this.held === null) return;
    this.held = null;
    this.hand.moved(this.pins);
  }

  /** @param {number} index */
  removed(index) {
    if (index < 0) return;
    this.pins.splice(index, 1);
    this.draw();
    this.hand.moved(this.pins);
  }

  /** @param {KeyboardEvent} event */
  keyed(event) {
    const index = this.indexOf(event.target);
    const pin = this.pins[index];
    if (!pin || !this.frame) return;
    if (event.key === "Delete" || event.key === "Backspace") {
      event.preventDefault();
      return this.removed(index);
    }
    const way = /** @type {Record<string, [number, number]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] })[event.key];
    if (!way) return;
    event.preventDefault();
    const step = event.shiftKey ? 10 : 1;
    pin.mm = Math.min(this.frame.to, Math.max(this.frame.from, pin.mm + way[0] * step));
    pin.deg = turned(pin.deg + way[1] * step);
    this.draw();
    this.hand.moved(this.pins);
  }
}
