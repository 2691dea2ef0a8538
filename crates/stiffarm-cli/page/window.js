// How is the window taken in the hand, within which the zone may stand? Its four edges over the map, dragged and moved by keys.

import { svg } from "./dom.js";
import { spotUnder } from "./figure.js";
import { grasped } from "./hand.js";
import { rounded } from "./zone.js";

/** @typedef {[number, number, number, number]} Window least and largest x, least and largest z, m; infinite where an end is open */

/** In front of the joint-1 axis: what holds where nothing is asked. @type {Window} */
const ABSENT = [0, Infinity, -Infinity, Infinity];

/** The window that a text names, where it is one of x and z. @param {string} text @returns {Window | null} */
export function windowOf(text) {
  if (text === "") return [...ABSENT];
  const number = "\\s*(-?[0-9]*\\.?[0-9]*)\\s*";
  const found = new RegExp(`^${number}\\.\\.${number}(?:,${number}\\.\\.${number})?$`).exec(text);
  if (!found) return null;
  const end = (/** @type {number} */ index) => (found[index + 1] ? Number(found[index + 1]) : index % 2 === 0 ? -Infinity : Infinity);
  const read = /** @type {Window} */ ([0, 1, 2, 3].map(end));
  return read.some(Number.isNaN) ? null : read;
}

/** @param {Window} window */
export function textOf(window) {
  if (window.every((end, index) => end === ABSENT[index])) return "";
  const [x0, x1, z0, z1] = window.map((end) => (Number.isFinite(end) ? rounded(end) : ""));
  return `${x0}..${x1},${z0}..${z1}`;
}

/**
 * @typedef {object} Hand
 * @property {(window: Window) => void} moving while an edge is dragged
 * @property {(window: Window) => void} moved when it is let go
 */

const NAMES = ["least x", "largest x", "least z", "largest z"];
/** An edge is open as soon as it is this near to the edge of the map, px. */
const OPEN = 6;
/** What must be left between two edges, m. */
const ROOM = 0.01;

/** The four edges over the map. */
export class WindowEdges {
  /** @param {Hand} hand */
  constructor(hand) {
    this.hand = hand;
    /** @type {import("./figure.js").Scale | null} */
    this.scale = null;
    /** @type {import("./figure.js").Box | null} */
    this.frame = null;
    this.window = ABSENT;
    this.isHeld = false;
    this.root = svg("svg", { class: "over window", "aria-hidden": "false" });
    this.edges = NAMES.map((_, index) => this.edge(index));
    this.root.append(...this.edges.flatMap(({ line, handle }) => [line, handle]));
  }

  /** @param {number} index */
  edge(index) {
    const isOfX = index < 2;
    const size = isOfX ? { x: -5, y: -18, width: 10, height: 36 } : { x: -18, y: -5, width: 36, height: 10 };
    const line = svg("path", { class: "edge" });
    const handle = svg("rect", {
      ...size, rx: 5, class: `grip ${isOfX ? "across" : "up"}`, tabindex: 0, role: "slider",
      "aria-orientation": isOfX ? "horizontal" : "vertical",
      "aria-label": `${NAMES[index]} of the window; arrow keys move it by 1 cm, with Shift by 10 cm, Delete opens it`,
    });
    grasped(handle, {
      take: () => {
        this.isHeld = this.scale !== null;
        return this.scale;
      },
      move: (scale, event) => {
        const { x, z } = spotUnder(this.root, scale, event);
        this.move(index, isOfX ? x : z);
        this.hand.moving(this.window);
      },
      drop: () => {
        this.isHeld = false;
        this.hand.moved(this.window);
      },
    });
    handle.addEventListener("keydown", (event) => this.keyed(index, /** @type {KeyboardEvent} */ (event)));
    return { line, handle };
  }

  /** @param {import("./figure.js").Scale | null} scale @param {import("./figure.js").Box | null} frame @param {Window | null} window */
  show(scale, frame, window) {
    const isShown = scale && frame && window;
    this.root.setAttribute("display", isShown ? "inline" : "none");
    if (!isShown || this.isHeld) return;
    Object.assign(this, { scale, frame, window: [...window] });
    this.root.setAttribute("viewBox", `0 0 ${frame.width} ${frame.height}`);
    this.draw();
  }

  /** The ends of the map on the axis of an edge, m. @param {number} index @returns {[number, number]} */
  ends(index) {
    const { scale, frame } = this;
    if (!scale || !frame) return [0, 0];
    return index < 2 ? [scale.x(frame.left), scale.x(frame.right)] : [scale.z(frame.bottom), scale.z(frame.top)];
  }

  /** Where an edge is seen, m: open ones lie on the edge of the map. @param {number} index */
  seen(index) {
    const [low, high] = this.ends(index);
    return Math.min(high, Math.max(low, this.window[index] ?? 0));
  }

  draw() {
    const { scale } = this;
    if (!scale) return;
    const [left = 0, right = 0, bottom = 0, top = 0] = [0, 1, 2, 3].map((index) => (index < 2 ? scale.px(this.seen(index)) : scale.py(this.seen(index))));
    const [middle, half] = [(left + right) / 2, (top + bottom) / 2];
    const ways = [[left, bottom, left, top], [right, bottom, right, top], [left, bottom, right, bottom], [left, top, right, top]];
    const stands = [[left, half], [right, half], [middle, bottom], [middle, top]];
    this.edges.forEach(({ line, handle }, index) => {
      const isOpen = !Number.isFinite(this.window[index]);
      const [x0, y0, x1, y1] = ways[index] ?? [];
      const [x, y] = stands[index] ?? [];
      line.setAttribute("d", isOpen ? "" : `M${x0} ${y0}L${x1} ${y1}`);
      handle.setAttribute("transform", `translate(${x} ${y})`);
      handle.toggleAttribute("data-open", isOpen);
      const [low, high] = this.ends(index);
      const at = { "aria-valuemin": low, "aria-valuemax": high, "aria-valuenow": this.seen(index) };
      for (const [name, value] of Object.entries(at)) handle.setAttribute(name, rounded(value));
      handle.setAttribute("aria-valuetext", isOpen ? "open" : `${rounded(this.seen(index))} m`);
    });
  }

  /** Sets an edge, which never passes the one across and is open at the edge of the map. @param {number} index @param {number} at */
  move(index, at) {
    const { scale } = this;
    if (!scale) return;
    const [low, high] = this.ends(index);
    const isLow = index % 2 === 0;
    const across = this.seen(isLow ? index + 1 : index - 1);
    const near = OPEN / scale.perM;
    const isOpen = isLow ? at <= low + near : high - near <= at;
    const kept = isLow ? Math.min(at, across - ROOM) : Math.max(at, across + ROOM);
    this.window[index] = isOpen ? (isLow ? -Infinity : Infinity) : Math.round(kept * 1000) / 1000;
    this.draw();
  }

  /** @param {number} index @param {KeyboardEvent} event */
  keyed(index, event) {
    const step = event.shiftKey ? 0.1 : 0.01;
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    const isDeleted = event.key === "Delete" || event.key === "Backspace";
    if (!way && !isDeleted) return;
    event.preventDefault();
    const outside = index % 2 === 0 ? -Infinity : Infinity;
    // From the edge of the map the first step must come away from it.
    const { scale } = this;
    const first = way && scale && !Number.isFinite(this.window[index]) ? (way * (OPEN + 1)) / scale.perM : 0;
    this.move(index, isDeleted ? outside : this.seen(index) + first + (way ?? 0) * step);
    this.hand.moved(this.window);
  }
}
