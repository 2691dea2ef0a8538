// How is the zone taken in the hand? An outline over the map that is dragged, resized and moved by keys.

import { svg } from "./dom.js";
import { spotUnder } from "./figure.js";
import { grasped } from "./hand.js";

/** @typedef {import("./figure.js").Scale} Scale */
/** @typedef {{shape: "circle" | "rect", a: number, b: number, prefix: string}} Zone sizes along x and z before it is turned, m */
/** @typedef {{x: number, z: number}} Spot */

/** The zone that a task names, where it is one that can be drawn. @param {string} task @returns {Zone | null} */
export function zoneOf(task) {
  const number = "([0-9]*\\.?[0-9]+)";
  const round = new RegExp(`^(?:circle|A):${number}$`, "i").exec(task);
  if (round) return { shape: "circle", a: Number(round[1]), b: Number(round[1]), prefix: task.split(":")[0] ?? "" };
  const rect = new RegExp(`^rect:${number}x${number}$`, "i").exec(task);
  if (rect) return { shape: "rect", a: Number(rect[1]), b: Number(rect[2]), prefix: "rect" };
  const long = new RegExp(`^([BC]):${number}$`, "i").exec(task);
  if (!long) return null;
  const d = Number(long[2]);
  return { shape: "rect", a: d, b: d * (long[1]?.toUpperCase() === "B" ? 2 : 10), prefix: "rect" };
}

/** The task that stands for a zone, sizes to the millimetre. @param {Zone} zone */
export function taskOf({ shape, a, b, prefix }) {
  return shape === "circle" ? `${prefix}:${rounded(a)}` : `rect:${rounded(a)}x${rounded(b)}`;
}

/** Metres to the millimetre. @param {number} m */
export const rounded = (m) => String(Math.round(m * 1000) / 1000);

/**
 * @typedef {object} Hand
 * @property {(at: Spot) => void} moving while it is dragged
 * @property {(at: Spot) => void} moved when it is let go
 * @property {(zone: Zone) => void} resized when it is let go
 * @property {(deg: number) => void} turned
 */

/** The zone over the map. */
export class ZoneObject {
  /** @param {Hand} hand */
  constructor(hand) {
    this.hand = hand;
    /** @type {Scale | null} */
    this.scale = null;
    /** @type {Zone | null} */
    this.zone = null;
    this.at = { x: 0, z: 0 };
    this.deg = 0;
    this.isFlat = false;
    this.root = svg("svg", { class: "over", "aria-hidden": "false" });
    this.body = svg("g", { class: "zone", tabindex: "0", role: "application" });
    this.corner = svg("circle", { class: "handle", r: 9, tabindex: "0", role: "slider", "aria-label": "size of the zone", "aria-valuemin": 1, "aria-valuemax": 10000 });
    this.root.append(this.body, this.corner);
    this.grab(this.body, (start, at) => {
      this.at = { x: start.at.x + at.x - start.x, z: start.at.z + at.z - start.z };
      this.draw();
      this.hand.moving(this.at);
    }, () => this.hand.moved(this.at));
    this.grab(this.corner, (_, at) => {
      this.size(at);
      this.draw();
    }, () => this.zone && this.hand.resized(this.zone));
    this.body.addEventListener("keydown", (event) => this.keyed(/** @type {KeyboardEvent} */ (event)));
    this.corner.addEventListener("keydown", (event) => this.keyedSize(/** @type {KeyboardEvent} */ (event)));
  }

  /** @param {Scale | null} scale @param {Zone | null} zone @param {Spot | null} at @param {number} deg @param {boolean} isFlat */
  show(scale, zone, at, deg, isFlat) {
    this.root.toggleAttribute("hidden", !scale || !zone || !at);
    this.root.setAttribute("display", scale && zone && at ? "inline" : "none");
    if (!scale || !zone || !at || this.isHeld) return;
    Object.assign(this, { scale, zone: { ...zone }, at: { ...at }, deg, isFlat });
    this.root.setAttribute("viewBox", `0 0 ${scale.width} ${scale.height}`);
    this.draw();
  }

  /** From the state of an answer: the zone holds or does not. @param {"pass" | "fail" | "none" | ""} state */
  mark(state) {
    this.body.setAttribute("data-state", state);
  }

  draw() {
    const { scale, zone, at, deg } = this;
    if (!scale || !zone) return;
    const [w, h] = [zone.a * scale.perM, (this.isFlat ? 0 : zone.b) * scale.perM];
    const shape = this.isFlat
      ? svg("rect", { x: -w / 2, y: -5, width: w, height: 10, rx: 5 })
      : zone.shape === "circle" ? svg("circle", { r: w / 2 }) : svg("rect", { x: -w / 2, y: -h / 2, width: w, height: h });
    const cross = svg("path", { d: "M-6 0H6M0 -6V6" });
    this.body.replaceChildren(shape, cross);
    const turn = this.isFlat ? 0 : -deg;
    this.body.setAttribute("transform", `translate(${scale.px(at.x)} ${scale.py(at.z)}) rotate(${turn})`);
    this.body.setAttribute("aria-label", `zone, middle at x ${rounded(at.x)} m, z ${rounded(at.z)} m; arrow keys move it by 1 mm, with Shift by 1 cm`);
    const angle = (turn * Math.PI) / 180;
    const [u, v] = zone.shape === "circle" && !this.isFlat ? [w / 2 / Math.SQRT2, -w / 2 / Math.SQRT2] : [w / 2, -h / 2];
    const [x, y] = [u * Math.cos(angle) - v * Math.sin(angle), u * Math.sin(angle) + v * Math.cos(angle)];
    this.corner.setAttribute("cx", String(scale.px(at.x) + x));
    this.corner.setAttribute("cy", String(scale.py(at.z) + y));
    this.corner.setAttribute("aria-valuenow", String(Math.round(zone.a * 1000)));
    this.corner.setAttribute("aria-valuetext", taskOf(zone));
  }

  /** The corner under the hand says how large the zone is. @param {Spot} spot */
  size(spot) {
    if (!this.zone) return;
    const [dx, dz] = [spot.x - this.at.x, spot.z - this.at.z];
    const angle = this.isFlat ? 0 : (this.deg * Math.PI) / 180;
    const [u, v] = [dx * Math.cos(angle) + dz * Math.sin(angle), -dx * Math.sin(angle) + dz * Math.cos(angle)];
    const least = (/** @type {number} */ m) => Math.max(0.01, Math.abs(m));
    if (this.zone.shape === "circle") this.zone.a = this.zone.b = least(2 * Math.hypot(u, v));
    else {
      this.zone.a = least(2 * u);
      if (!this.isFlat) this.zone.b = least(2 * v);
    }
  }

  isHeld = false;

  /** @param {Element} what @param {(start: Spot & {at: Spot}, at: Spot) => void} move @param {() => void} end */
  grab(what, move, end) {
    grasped(what, {
      take: (event) => {
        this.isHeld = this.scale !== null;
        return this.scale && { ...spotUnder(this.root, this.scale, event), at: { ...this.at } };
      },
      move: (start, event) => {
        if (this.scale) move(start, spotUnder(this.root, this.scale, event));
      },
      drop: () => {
        this.isHeld = false;
        end();
      },
    });
  }

  /** @param {KeyboardEvent} event */
  keyed(event) {
    const step = event.shiftKey ? 0.01 : 0.001;
    const ways = /** @type {Record<string, [number, number]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] });
    const way = ways[event.key];
    if (event.key === "[" || event.key === "]") this.hand.turned(event.key === "[" ? 5 : -5);
    if (!way) return;
    event.preventDefault();
    this.at = { x: this.at.x + way[0] * step, z: this.at.z + way[1] * step };
    this.draw();
    this.hand.moved(this.at);
  }

  /** @param {KeyboardEvent} event */
  keyedSize(event) {
    const sign = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (!sign || !this.zone) return;
    event.preventDefault();
    const step = sign * (event.shiftKey ? 0.1 : 0.01);
    const isTall = event.key === "ArrowUp" || event.key === "ArrowDown";
    if (this.zone.shape === "circle" || !isTall) this.zone.a = Math.max(0.01, this.zone.a + step);
    if (this.zone.shape === "circle" || (isTall && !this.isFlat)) this.zone.b = Math.max(0.01, this.zone.b + step);
    this.draw();
    this.hand.resized(this.zone);
  }
}
