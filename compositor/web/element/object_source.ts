// Loads files by URL, with progress and errors that a visitor can read.

import { CoreError } from "./core.js";

/** Name of a URL's file for messages. */
export function fileName(url: string): string {
  if (url.startsWith("data:") || url.startsWith("blob:")) return "the object";
  const path = new URL(url, document.baseURI).pathname;
  return decodeURIComponent(path.slice(path.lastIndexOf("/") + 1)) || url;
}

/** Error for a file that cannot be requested. */
export function unreachable(name: string): CoreError {
  const hint = location.protocol === "file:" ? "; a page opened from disk needs its object inside (rs-view page)" : "";
  return new CoreError(`${name}: cannot be fetched${hint}`);
}

/** Error for an answer with another status than success. */
export function refused(name: string, status: number): CoreError {
  const reason = status === 404 ? "does not exist on the server" : "is not delivered by the server";
  return new CoreError(`${name}: ${reason} (${status})`);
}

/**
 * Fetches a whole file.
 * @param onprogress called with the fraction that has arrived, where the server states the size
 */
export async function fetchFile(
  url: string,
  signal: AbortSignal,
  onprogress: (fraction: number) => void = () => {},
): Promise<ArrayBuffer> {
  const name = fileName(url);
  let response: Response;
  try {
    response = await fetch(url, { signal });
  } catch (error) {
    if (signal.aborted) throw error;
    throw unreachable(name);
  }
  if (!response.ok) throw refused(name, response.status);
  const expected = Number(response.headers.get("content-length"));
  const encoded = response.headers.get("content-encoding");
  if (!response.body || !expected || encoded) return response.arrayBuffer();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let arrived = 0;
  const reader = response.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    arrived += part.value.length;
    onprogress(Math.min(arrived / expected, 1));
  }
  return new Blob(parts).arrayBuffer();
}

/** Fetches the WebAssembly module, which may be compressed with gzip. */
export async function fetchModule(url: string, signal: AbortSignal): Promise<ArrayBuffer> {
  const bytes = await fetchFile(url, signal);
  const start = new Uint8Array(bytes, 0, Math.min(2, bytes.byteLength));
  if (start[0] !== 0x1f || start[1] !== 0x8b) return bytes;
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
