// How are elements written in one line?

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} name @param {Record<string, string | boolean | ((event: any) => void)>} [has] @param {(Node | string)[]} [within]
 * @returns {HTMLElementTagNameMap[K]}
 */
export function el(name, has = {}, within = []) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(has)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false) element.setAttribute(key, value);
  }
  element.append(...within);
  return element;
}

/** @param {string} id @returns {HTMLElement} */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found;
}

/** @param {string} label @param {() => void} press @param {Record<string, string>} [has] */
export function button(label, press, has = {}) {
  return el("button", { type: "button", click: press, ...has }, [label]);
}

/** @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const url = URL.createObjectURL(blob);
  el("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Says something once to those who hear the page. @param {string} words */
export function say(words) {
  byId("status").textContent = words;
}

const NS = "http://www.w3.org/2000/svg";

/** @param {string} name @param {Record<string, string | number>} has */
export function svg(name, has) {
  const element = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(has)) element.setAttribute(key, String(value));
  return element;
}
