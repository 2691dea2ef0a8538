// How is the server asked, so that the newest question wins?

/** @typedef {{options: Record<string, unknown>, files: Record<string, string>}} Question */
/** @typedef {{doing: string, done: number, total: number | null}} Progress */

/** What the server refused, with what it says would help. */
export class Refusal extends Error {
  /** @param {string} message @param {string} hint */
  constructor(message, hint) {
    super(message);
    this.hint = hint;
  }
}

/** @param {unknown} body @returns {Refusal} */
function refusal(body) {
  const { error, hint } = /** @type {{error?: string, hint?: string}} */ (body ?? {});
  return new Refusal(error ?? "the server gave no reason", hint ?? "");
}

/** @param {string} path @param {unknown} body @param {AbortSignal | undefined} signal @param {Record<string, string>} [more] */
async function post(path, body, signal, more = {}) {
  const headers = { "Content-Type": "application/json", ...more };
  const reply = await reached(fetch(path, { method: "POST", headers, body: JSON.stringify(body), signal: signal ?? null }));
  if (!reply.ok) throw refusal(await reply.json().catch(() => ({ error: `the server answered ${reply.status}` })));
  return reply;
}

/** @param {Promise<Response>} asked */
async function reached(asked) {
  try {
    return await asked;
  } catch (fault) {
    if (fault instanceof DOMException && fault.name === "AbortError") throw fault;
    throw new Refusal("the server is not reached", "is `stiffarm serve` still running?");
  }
}

/** @param {string} path @returns {Promise<any>} */
export async function get(path) {
  const reply = await reached(fetch(path));
  if (!reply.ok) throw refusal(await reply.json().catch(() => null));
  return reply.json();
}

/** A call that is no verb, such as the check of a robot file. @param {string} path @param {unknown} body @returns {Promise<any>} */
export async function call(path, body) {
  return (await post(path, body, undefined)).json();
}

/** Where a verb is asked. @param {string} verb */
export const addressOf = (verb) => `/api/${verb.replaceAll(" ", "/")}`;

/** The fields of the answer. @param {string} verb @param {Question} question @param {AbortSignal} [signal] @returns {Promise<any>} */
export async function fields(verb, question, signal) {
  return (await post(addressOf(verb), question, signal)).json();
}

/** An answer as a file, however long it takes. @param {string} verb @param {Question} question @param {string} as */
export async function written(verb, question, as) {
  return post(`${addressOf(verb)}?as=${as}`, question, undefined, { Prefer: `wait=${24 * 3600}` });
}

/**
 * Forms of an answer that may take long, which tells how far it is.
 * @param {string} verb @param {Question} question @param {string} as @param {AbortSignal} [signal] @param {(at: Progress) => void} [tell] @returns {Promise<any>}
 */
async function watched(verb, question, as, signal, tell) {
  const reply = await post(`${addressOf(verb)}?as=${as}`, question, signal, { Accept: "application/x-ndjson" });
  if (!reply.body) throw refusal(null);
  const reader = reply.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    rest += value ?? "";
    const lines = rest.split("\n");
    rest = done ? "" : (lines.pop() ?? "");
    for (const line of lines.filter((line) => line.trim() !== "")) {
      const message = JSON.parse(line);
      if (message.progress) tell?.(message.progress);
      else if ("answer" in message) return message.answer;
      else throw refusal(message);
    }
    if (done) throw new Refusal("the answer broke off", "");
  }
}

/** What was asked last of each verb, and what it was answered. @type {Map<string, {of: string, forms: any}>} */
const last = new Map();

/**
 * Several forms of one answer, which is computed once: who looks at another of its pictures asks nothing again. A form is null where there is nothing to show.
 * @param {string} verb @param {Question} question @param {string[]} wanted @param {AbortSignal} [signal] @param {(at: Progress) => void} [tell] @returns {Promise<any>}
 */
export async function forms(verb, question, wanted, signal, tell) {
  const of = JSON.stringify(question);
  const kept = last.get(verb);
  if (kept?.of === of && wanted.every((form) => form in kept.forms)) return kept.forms;
  // One alone would come by itself, and not under its name.
  const words = wanted.length === 1 ? [...wanted, "tables"] : wanted;
  const answer = await watched(verb, question, words.join(","), signal, tell);
  last.set(verb, { of, forms: answer });
  return answer;
}

/** Runs one task at a time: a new one cancels the one before, which then yields nothing. */
export class Newest {
  /** @type {AbortController | undefined} */
  #running;

  /** @template T @param {(signal: AbortSignal) => Promise<T>} task @returns {Promise<T | undefined>} */
  async run(task) {
    this.#running?.abort();
    const running = (this.#running = new AbortController());
    try {
      const result = await task(running.signal);
      return running.signal.aborted ? undefined : result;
    } catch (fault) {
      if (running.signal.aborted) return undefined;
      throw fault;
    } finally {
      if (this.#running === running) this.#running = undefined;
    }
  }

  cancel() {
    this.#running?.abort();
    this.#running = undefined;
  }
}

/**
 * One in flight and at most one waiting: while the hand moves, places between are left out and none is late.
 * @template T @param {(what: T) => Promise<void>} task @returns {(what: T) => void}
 */
export function oneInFlight(task) {
  let busy = false;
  /** @type {{what: T} | undefined} */
  let next;
  return async function offer(what) {
    next = { what };
    if (busy) return;
    busy = true;
    while (next) {
      const { what: now } = next;
      next = undefined;
      await task(now).catch(() => undefined);
    }
    busy = false;
  };
}
