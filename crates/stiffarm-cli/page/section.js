// What does the section map show, and which value lies under the pointer?

import { stateOf } from "./answer.js";
import { Newest, fields, forms } from "./ask.js";
import { el } from "./dom.js";
import { Picture, boxOf, scaleOf, spotUnder } from "./figure.js";
import { question, value } from "./state.js";
import { rows } from "./table.js";
import { WindowEdges, windowOf } from "./window.js";
import { ZoneObject, rounded, zoneOf } from "./zone.js";

/** What the map is asked, without a zone. @param {Record<string, unknown>} [more] */
function mapped(more = {}) {
  const ofZone = rows("map").filter((row) => row.name === "zone" || row.needs?.includes("zone"));
  const asked = question("map", { ...Object.fromEntries(ofZone.map((row) => [row.name, undefined])), ...more });
  // What the place is asked besides says something of a map only beside other options.
  for (let left = -1; left !== Object.keys(asked.options).length; ) {
    left = Object.keys(asked.options).length;
    for (const row of rows("map")) if ((row.needs ?? []).some((name) => !(name in asked.options))) delete asked.options[row.name];
  }
  return asked;
}

/** The map with the zone and the window over it. */
export class Section {
  /** @param {import("./zone.js").Hand} hand @param {import("./window.js").Hand} ofWindow */
  constructor(hand, ofWindow) {
    this.window = new WindowEdges(ofWindow);
    this.zone = new ZoneObject({ ...hand, resized: (zone) => hand.resized(this.unfolded(zone)) });
    /** @type {{zone: import("./zone.js").Zone, deg: number} | null} A flat zone that is seen from the side. */
    this.folded = null;
    this.picture = new Picture("section map with the arm and the zone");
    this.tip = el("output", { class: "tip", hidden: true });
    this.box = el("div", { class: "section" }, [this.picture.image, this.window.root, this.zone.root, this.tip]);
    /** @type {ReturnType<typeof scaleOf>} */
    this.scale = null;
    /** @type {{of: string, x: number[], z: number[], mm: (number | null)[][]} | null} */
    this.grid = null;
    this.newest = new Newest();
    this.box.addEventListener("pointermove", (event) => this.hover(event));
    this.box.addEventListener("pointerleave", () => (this.tip.hidden = true));
  }

  /** @param {any} here the fields of the place that is shown @param {any} best @param {string} drawn */
  async update(here, best, drawn) {
    await this.picture.show(drawn, here.feasible ? `section map: the zone at x ${rounded(here.x_m)} m, z ${rounded(here.z_m)} m` : "section map");
    this.scale = scaleOf(this.picture.svg);
    // Behind a mount heights count from another floor than those of the map.
    this.window.show(this.scale, boxOf(this.picture.svg, "map"), value("mount") === "" ? windowOf(value("within")) : null);
    this.lay(here, best);
  }

  /** Lays the zone where an answer has it. @param {any} here @param {any} best */
  lay(here, best) {
    const isFlat = value("model") === "spatial";
    const given = value("at").split(",").map(Number);
    const [x = NaN, z = NaN] = here.feasible ? [here.x_m, here.z_m] : given;
    const zone = zoneOf(String(here.task ?? ""));
    const deg = Number(here.angle_deg ?? (Number(value("angle")) || 0));
    const at = Number.isFinite(x) && Number.isFinite(z) ? { x, z } : this.middle(best);
    this.folded = zone && isFlat ? { zone, deg } : null;
    this.zone.show(this.scale, zone && isFlat ? { ...zone, a: seenFromTheSide(zone, deg) } : zone, at, deg, isFlat);
    this.zone.mark(stateOf(here));
  }

  /** The zone whose side was pulled: the edge that is seen grows, of a zone that stands askew both do. @param {import("./zone.js").Zone} pulled */
  unfolded(pulled) {
    if (!this.folded || pulled.shape === "circle") return pulled;
    const { zone, deg } = this.folded;
    const grown = pulled.a / seenFromTheSide(zone, deg);
    const [along, across] = [Math.abs(Math.cos((deg * Math.PI) / 180)), Math.abs(Math.sin((deg * Math.PI) / 180))];
    return { ...zone, a: across > 0.99 ? zone.a : zone.a * grown, b: along > 0.99 ? zone.b : zone.b * grown };
  }

  /** Where the zone is laid when it has no place at all: where it can be taken. @param {any} best */
  middle(best) {
    const { scale } = this;
    if (best.feasible || !scale) return best.feasible ? { x: best.x_m, z: best.z_m } : null;
    return { x: scale.x(scale.width * 0.55), z: scale.z(scale.height * 0.5) };
  }

  /** The map alone, where there is no place to draw. @param {AbortSignal} signal @returns {Promise<string>} */
  async map(signal) {
    return (await forms("map", mapped(), ["svg"], signal)).svg ?? "";
  }

  /** Values under the pointer, from a grid that is asked when the pointer first comes. @param {PointerEvent} event */
  async hover(event) {
    const { scale } = this;
    if (!scale || this.zone.isHeld || this.window.isHeld) return;
    const box = this.picture.image.getBoundingClientRect();
    const { x, z } = spotUnder(this.picture.image, scale, event);
    this.tip.style.left = `${event.clientX - box.left}px`;
    this.tip.style.top = `${event.clientY - box.top}px`;
    const asked = mapped({ size: value("model") === "spatial" ? 60 : 200 });
    const of = JSON.stringify(asked);
    if (this.grid?.of !== of) {
      this.grid = { of, x: [], z: [], mm: [] };
      const answer = await this.newest.run((signal) => fields("map", asked, signal)).catch(() => undefined);
      if (!answer) return;
      this.grid = { of, x: answer.x_m, z: answer.z_m, mm: answer.worst_mm ?? answer.deflection_mm };
    }
    const [i, j] = [nearest(this.grid.x, x), nearest(this.grid.z, z)];
    const mm = j < 0 || i < 0 ? null : this.grid.mm[j]?.[i];
    this.tip.hidden = typeof mm !== "number";
    if (typeof mm === "number") this.tip.textContent = `${mm.toFixed(3)} mm at x ${(this.grid.x[i] ?? 0).toFixed(2)}, z ${(this.grid.z[j] ?? 0).toFixed(2)} m`;
  }
}

/** @param {import("./zone.js").Zone} zone @param {number} deg */
function seenFromTheSide(zone, deg) {
  const angle = (deg * Math.PI) / 180;
  return zone.shape === "circle" ? zone.a : Math.abs(Math.cos(angle)) * zone.a + Math.abs(Math.sin(angle)) * zone.b;
}

/** The index of the grid line next to a value, -1 outside. @param {number[]} lines @param {number} at */
function nearest(lines, at) {
  const [first, second] = lines;
  if (first === undefined || second === undefined) return -1;
  const index = Math.round((at - first) / (second - first));
  return index < 0 || lines.length <= index ? -1 : index;
}
