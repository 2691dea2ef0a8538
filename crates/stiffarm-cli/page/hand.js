// How is something over a picture taken, moved and let go?

/**
 * @template T
 * @typedef {object} Grip
 * @property {(event: PointerEvent) => T | null} take what is remembered of where it was taken; nothing where it cannot be
 * @property {(taken: T, event: PointerEvent) => void} move while it is dragged
 * @property {() => void} drop when it is let go
 */

/** @template T @param {Element} what @param {Grip<T>} grip */
export function grasped(what, { take, move, drop }) {
  const element = /** @type {SVGElement} */ (what);
  /** @type {T | null} */
  let taken = null;
  element.addEventListener("pointerdown", (event) => {
    taken = take(event);
    if (taken === null) return;
    event.preventDefault();
    element.focus();
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener("pointermove", (event) => {
    if (taken !== null) move(taken, event);
  });
  const release = () => {
    if (taken === null) return;
    taken = null;
    drop();
  };
  element.addEventListener("pointerup", release);
  element.addEventListener("pointercancel", release);
}
