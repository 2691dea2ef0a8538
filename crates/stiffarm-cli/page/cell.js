// How is a part taken through the cell? The drawing of where it stands, with its outline from above to be dragged.

import { svg } from "./dom.js";
import { Picture, boxOf, scaleOf, spotUnder } from "./figure.js";
import { grasped } from "./hand.js";
import { rounded } from "./zone.js";

/** @typedef {[number, number, number, number]} Stand x, y, z in m from the base and the yaw in deg of the path's origin */

/**
 * @typedef {object} Hand
 * @property {(at: Stand) => void} moving while it is dragged
 * @property {(at: Stand) => void} moved when it is let go
 */

/** @param {Stand} at */
export const textOf = ([x, y, z, yaw]) => [...[x, y, z].map(rounded), String(Math.round(yaw * 100) / 100)].join(",");

/** The shop drawing of a path at its place. */
export class CellPlan {
  /** @param {Hand} hand */
  constructor(hand) {
    this.hand = hand;
    this.picture = new Picture("where the part stands, from the side and from above");
    /** @type {Stand | null} */
    this.at = null;
    /** @type {ReturnType<typeof scaleOf>} */
    this.scale = null;
    this.rect = svg("rect", {});
    this.body = svg("g", { class: "zone", tabindex: "0", role: "application", "aria-label": "the part" });
    this.body.append(this.rect);
    this.root = svg("svg", { class: "over", "aria-hidden": "false" });
    this.root.append(this.body);
    this.box = document.createElement("div");
    this.box.className = "section";
    this.box.append(this.picture.image, this.root);
    this.isHeld = false;
    grasped(this.body, { take: (event) => this.taken(event), move: (start, event) => this.dragged(start, event), drop: () => this.dropped() });
    this.body.addEventListener("keydown", (event) => this.keyed(/** @type {KeyboardEvent} */ (event)));
  }

  /** @param {string} state how what stands there looks */
  mark(state) {
    this.body.setAttribute("data-state", ["fail", "none"].includes(state) ? "fail" : "");
  }

  /** @param {string} drawn @param {Stand | null} at @param {string} state how what stands there looks */
  async show(drawn, at, state) {
    if (this.isHeld) return;
    await this.picture.show(drawn);
    this.at = at;
    this.scale = drawn === "" ? null : scaleOf(drawn);
    const work = boxOf(drawn, "work");
    this.root.setAttribute("display", work && at ? "inline" : "none");
    if (!work || !at) return;
    this.root.setAttribute("viewBox", `0 0 ${work.width} ${work.height}`);
    const pad = 4;
    const lies = { x: work.left - pad, y: work.top - pad, width: work.right - work.left + 2 * pad, height: work.bottom - work.top + 2 * pad };
    for (const [key, value] of Object.entries(lies)) this.rect.setAttribute(key, String(value));
    this.body.setAttribute("transform", "");
    this.mark(state);
    this.body.setAttribute("aria-label", `the part, its origin at ${textOf(at)}; arrow keys move it by 1 cm, Page Up and Page Down lift and lower it, with Shift by 10 cm, [ and ] turn it by 5 degrees`);
  }

  /** @param {PointerEvent} event */
  taken(event) {
    if (!this.scale || !this.at) return null;
    this.isHeld = true;
    return { ...spotUnder(this.root, this.scale, event), at: this.at };
  }

  /** @param {{x: number, z: number, at: Stand}} start @param {PointerEvent} event */
  dragged(start, event) {
    const { scale } = this;
    if (!scale) return;
    const spot = spotUnder(this.root, scale, event);
    const [dx, dy] = [spot.x - start.x, spot.z - start.z];
    const [x, y, z, yaw] = start.at;
    this.at = [x + dx, y + dy, z, yaw];
    this.body.setAttribute("transform", `translate(${dx * scale.perM} ${-dy * scale.perM})`);
    this.hand.moving(this.at);
  }

  dropped() {
    this.isHeld = false;
    if (this.at) this.hand.moved(this.at);
  }

  /** @param {KeyboardEvent} event */
  keyed(event) {
    const ways = /** @type {Record<string, Stand>} */ ({
      ArrowLeft: [-1, 0, 0, 0], ArrowRight: [1, 0, 0, 0], ArrowUp: [0, 1, 0, 0], ArrowDown: [0, -1, 0, 0],
      PageUp: [0, 0, 1, 0], PageDown: [0, 0, -1, 0], "[": [0, 0, 0, 5], "]": [0, 0, 0, -5],
    });
    const way = ways[event.key];
    if (!way || !this.at) return;
    event.preventDefault();
    const step = event.shiftKey ? 0.1 : 0.01;
    const [x, y, z, yaw] = this.at;
    this.at = [x + way[0] * step, y + way[1] * step, z + way[2] * step, yaw + way[3]];
    this.hand.moved(this.at);
  }
}
