// What does the page do first, and what when the question changes?

import { addressOf, call, get } from "./ask.js";
import { byId, button, el, save, say } from "./dom.js";
import { tellFault } from "./figure.js";
import { packed } from "./files.js";
import { build, faulty, refresh } from "./form.js";
import { opener } from "./open.js";
import { addressWith, change, firstQuestion, forget, onChange, question, readAddress, readJob, value, view } from "./state.js";
import { learn } from "./table.js";
import { calibrate } from "./view_calibrate.js";
import { measure } from "./view_measure.js";
import { mill } from "./view_mill.js";
import { place } from "./view_place.js";
import { robots } from "./view_robots.js";
import { cancellable, work } from "./work.js";

/**
 * @typedef {object} View
 * @property {string} verb the verb of its job file
 * @property {() => import("./form.js").Part[]} parts what is asked
 * @property {(look: HTMLElement, decide: HTMLElement) => void} mount
 * @property {(signal: AbortSignal) => Promise<void>} update
 */

/** @type {Record<string, View>} */
const views = { robots, place, mill, measure, calibrate };
let mounted = "";
let soon = 0;

/** @returns {View} */
const current = () => views[view()] ?? robots;

function show() {
  const form = byId("ask");
  const kind = `${view()} ${value("model")}`;
  if (mounted === kind) refresh();
  else build(form, current().parts());
  if (mounted.split(" ")[0] !== view()) {
    byId("look").replaceChildren();
    byId("decide").replaceChildren();
    faulty(null);
    current().mount(byId("look"), byId("decide"));
    document.title = `stiffarm: ${view()}`;
  }
  mounted = kind;
  for (const link of document.querySelectorAll("nav a")) {
    if (!(link instanceof HTMLElement)) continue;
    if (link.dataset["view"] === view()) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

function later() {
  show();
  clearTimeout(soon);
  document.body.dataset["later"] = "";
  soon = setTimeout(() => {
    work((signal) => current().update(signal));
    delete document.body.dataset["later"];
  }, 120);
}

async function fromAddress() {
  await readAddress();
  mounted = `${mounted.split(" ")[0]} anew`;
  later();
}

async function saveJob() {
  try {
    const { verb } = current();
    const { job } = await call(`${addressOf(verb)}?as=command`, question(verb));
    save(new Blob([job], { type: "application/toml" }), `${verb}.toml`);
    say("the job file is downloaded");
  } catch (fault) {
    tellFault(fault);
  }
}

/** @param {string} name @param {string} text */
async function openJob(name, text) {
  try {
    forget(name);
    const job = await call("/api/job", { name, text });
    mounted = `${mounted.split(" ")[0]} anew`;
    readJob(job);
  } catch (fault) {
    tellFault(fault);
  }
}

async function share() {
  const { files } = question(current().verb);
  const along = await packed(files);
  await navigator.clipboard.writeText(addressWith(along ?? ""));
  const names = Object.keys(files).join(", ");
  const note = along === null ? `without ${names}, too long for an address: hand that on beside it` : "it holds the whole question";
  byId("shared").textContent = `copied: ${note}`;
}

async function begin() {
  learn(await get("/api/options"));
  firstQuestion();
  byId("job").append(button("copy link", share), el("output", { id: "shared" }), button("save job", saveJob), opener("open a job file", "job", openJob, "open job"));
  for (const link of document.querySelectorAll("nav a")) {
    link.addEventListener("click", (event) => {
      event.preventDefault();
      const next = link instanceof HTMLElement ? link.dataset["view"] : undefined;
      change({}, next);
    });
  }
  byId("ask").addEventListener("submit", (event) => event.preventDefault());
  cancellable();
  onChange(later);
  addEventListener("popstate", fromAddress);
  await readAddress().catch((fault) => say(`the files in the address are broken: ${fault.message}`));
  show();
  await work((signal) => current().update(signal));
}

begin().catch((fault) => byId("look").replaceChildren(el("p", {}, [String(fault.message ?? fault)])));
