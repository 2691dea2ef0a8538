// How do the files that were opened outlive a reload, and go along with a link?

/** Longer addresses are cut off on the way: what does not go in is said to be missing. */
const LONGEST = 16_000;
const KEPT = "stiffarm.files";

/** @param {Map<string, string>} files */
export function remember(files) {
  try {
    sessionStorage.setItem(KEPT, JSON.stringify([...files]));
  } catch {
    // There is no room, or the browser keeps nothing: a reload then asks for the files again.
  }
}

/** @returns {[string, string][]} */
export function recalled() {
  try {
    const kept = JSON.parse(sessionStorage.getItem(KEPT) ?? "[]");
    return Array.isArray(kept) ? kept : [];
  } catch {
    return [];
  }
}

/** Texts as a part of an address; nothing where there are none, null where they are too long. @param {Record<string, string>} texts @returns {Promise<string | null>} */
export async function packed(texts) {
  if (Object.keys(texts).length === 0) return "";
  const bytes = new Uint8Array(await through(new Blob([JSON.stringify(texts)]), new CompressionStream("deflate-raw")));
  if (LONGEST < (bytes.length * 4) / 3) return null;
  return btoa(String.fromCharCode(...bytes)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** @param {string} text @returns {Promise<Record<string, string>>} */
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
  const texts = JSON.parse(new TextDecoder().decode(await through(new Blob([bytes]), new DecompressionStream("deflate-raw"))));
  return Object.fromEntries(Object.entries(texts).filter(([, content]) => typeof content === "string"));
}

/** @param {Blob} blob @param {CompressionStream | DecompressionStream} way */
const through = (blob, way) => new Response(blob.stream().pipeThrough(way)).arrayBuffer();
