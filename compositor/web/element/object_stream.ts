// Loads an object in parts by HTTP range requests (RFC 9110, 14), what the view shows first; the core selects the
// ranges. From servers without ranges, and from data: and blob: addresses, the whole file is read as a stream.

import { type ByteRange, CoreError, type ObjectDescription, type Orbit } from "./core.js";
import { fileName, refused, unreachable } from "./object_source.js";
import type { ViewRenderer } from "./view_renderer.js";

const kFirst_bytes = 16 * 1024; // table, geometry and RS maps of most objects
const kRequests = 3; // at the same time
const kPauses_ms = [500, 2000]; // before a lost connection is tried again
const kUnknown = -1;

export interface StreamListener {
  /** The view on screen, which is loaded first. */
  view(): { width: number; height: number; orbit: Orbit };
  /** The geometry is there. Called once. */
  described(object: ObjectDescription): void;
  /** Photos have arrived. @param ready the view can be rendered */
  arrived(photos: number[], ready: boolean): Promise<void>;
  progress(fraction: number): void;
}

class LostConnection extends Error {}

interface Loading {
  range: ByteRange;
  done: Promise<void>;
}

export class ObjectStream {
  private readonly name: string;
  private readonly hasRanges: boolean; // may be tried
  private readonly isSameOrigin: boolean;
  private readonly abort = new AbortController();
  private readonly signal: AbortSignal;
  private renderer!: ViewRenderer;
  private first!: Response;
  private whole = false; // the server sends no ranges
  private size = kUnknown;
  private arrived_bytes = 0;
  private object?: ObjectDescription;
  private ready = false;
  private complete = false;
  private wake: () => void = () => {};

  /** @param signal ends all requests */
  constructor(
    private readonly url: string,
    signal: AbortSignal,
    private readonly listener: StreamListener,
  ) {
    this.name = fileName(url);
    const { origin, protocol } = new URL(url, document.baseURI);
    this.hasRanges = protocol === "http:" || protocol === "https:";
    this.isSameOrigin = origin === location.origin;
    this.signal = this.abort.signal;
    signal.addEventListener("abort", () => this.abort.abort());
  }

  /** Sends the first request; needs no renderer. */
  async open(): Promise<void> {
    // Other origins may refuse requests with a range.
    const first = { begin: 0, end: kFirst_bytes };
    let attempts = 0;
    this.first = await this.retried(() => this.request(this.isSameOrigin || attempts++ === 0 ? first : undefined));
    this.whole = this.first.status !== 206;
    const total = this.whole ? this.first.headers.get("content-length") : contentRange(this.first)?.total;
    if (total && !this.first.headers.get("content-encoding")) this.size = Number(total);
  }

  /** Loads the object into the renderer. Fails with what a visitor may read; what was loaded before stays. */
  async load(renderer: ViewRenderer): Promise<void> {
    this.renderer = renderer;
    await renderer.beginStream(this.name, this.size);
    try {
      if (this.whole) await this.loadWhole();
      else await this.loadRanges();
    } finally {
      this.abort.abort();
    }
  }

  private async loadWhole(): Promise<void> {
    let response: Response | undefined = this.first;
    const size = await this.retried(async () => {
      const answer = response ?? (await this.request());
      response = undefined;
      this.arrived_bytes = 0;
      return this.receive(answer, 0);
    });
    await this.renderer.finishStream(size);
  }

  private async loadRanges(): Promise<void> {
    const end = this.size < 0 ? kFirst_bytes : Math.min(kFirst_bytes, this.size);
    const loading: Loading[] = [];
    const start = (range: ByteRange, response?: Response) => {
      const done = this.loadRange(range, response);
      done.catch(() => {}); // the first failure ends all
      loading.push({ range, done });
    };
    start({ begin: 0, end }, this.first);
    while (loading.length > 0) {
      const woken = new Promise<void>((resolve) => (this.wake = resolve));
      await Promise.race([woken, ...loading.map((each) => each.done)]);
      for (const each of [...loading]) {
        if (await settled(each.done)) loading.splice(loading.indexOf(each), 1);
      }
      while (loading.length < kRequests && !this.complete) {
        const { range } = await this.next(loading.map((each) => each.range));
        if (!range || (this.size >= 0 && range.end > this.size)) break; // the file is shorter than its table states
        start(range);
      }
    }
    if (!this.complete) await this.renderer.finishStream(this.size < 0 ? this.arrived_bytes : this.size);
  }

  private async loadRange(range: ByteRange, response?: Response): Promise<void> {
    let { begin } = range;
    await this.retried(async () => {
      const answer = response ?? (await this.request({ begin, end: range.end }));
      response = undefined;
      await this.receive(answer, begin, (end) => (begin = end));
      if (begin < range.end && (this.size >= 0 || begin === range.begin)) throw new LostConnection();
    });
  }

  // Repeats work that a lost connection has ended.
  private async retried<T>(work: () => Promise<T>): Promise<T> {
    for (let attempt = 0; ; ++attempt) {
      try {
        return await work();
      } catch (error) {
        if (!(error instanceof LostConnection) || this.signal.aborted) throw error;
        if (attempt === kPauses_ms.length || location.protocol === "file:") {
          throw this.object ? new CoreError(`${this.name}: the connection was lost; reload the page`) : unreachable(this.name);
        }
        await new Promise((resolve) => setTimeout(resolve, kPauses_ms[attempt]));
        this.signal.throwIfAborted();
      }
    }
  }

  private async request(range?: ByteRange): Promise<Response> {
    const headers: Record<string, string> = {};
    if (range && this.hasRanges) headers.range = `bytes=${range.begin}-${range.end - 1}`;
    const validator = this.first && this.isSameOrigin && validatorOf(this.first);
    if (headers.range && validator) headers["if-range"] = validator;
    let response: Response;
    try {
      response = await fetch(this.url, { headers, signal: this.signal });
    } catch {
      throw new LostConnection();
    }
    if (response.status === 416 && !this.first) return this.request(); // an empty file
    if (!response.ok) throw refused(this.name, response.status);
    if (headers.range && this.first) this.checkPart(response, range!);
    return response;
  }

  // A file may be replaced on the server while its parts are loaded.
  private checkPart(response: Response, range: ByteRange): void {
    const part = contentRange(response);
    const before = this.first.headers.get("etag");
    const after = response.headers.get("etag");
    const changed = response.status !== 206 || (before && after && before !== after) || (part && this.size >= 0 && part.total !== this.size);
    if (changed) throw new CoreError(`${this.name}: was changed on the server while it was loaded; reload the page`);
    if (part && part.begin !== range.begin) throw new CoreError(`${this.name}: the server sends other bytes than requested`);
  }

  // Hands over a body as it arrives. Returns its end in the file.
  private async receive(response: Response, begin: number, onend: (end: number) => void = () => {}): Promise<number> {
    const reader = response.body!.getReader();
    let end = begin;
    for (;;) {
      let part: ReadableStreamReadResult<Uint8Array<ArrayBuffer>>;
      try {
        part = await reader.read();
      } catch {
        throw new LostConnection();
      }
      if (part.done) return end;
      const bytes = part.value;
      const size = bytes.length;
      await this.add(end, bytes);
      end += size;
      onend(end);
    }
  }

  private async add(offset: number, bytes: Uint8Array<ArrayBuffer>): Promise<void> {
    this.arrived_bytes += bytes.length;
    const { object, complete, photos } = await this.renderer.addBytes(offset, bytes);
    if (this.size > 0) this.listener.progress(Math.min(this.arrived_bytes / this.size, 1));
    this.complete = complete;
    if (object && !this.object) {
      this.object = object;
      this.listener.described(object);
      this.wake();
    }
    if (photos.length === 0) return;
    const wasReady = this.ready;
    this.ready ||= (await this.next([])).ready;
    await this.listener.arrived(photos, this.ready);
    if (this.ready !== wasReady) this.wake();
  }

  private next(requested: ByteRange[]) {
    const { width, height, orbit } = this.listener.view();
    return this.renderer.nextRange(width, height, orbit, requested);
  }
}

async function settled(promise: Promise<void>): Promise<boolean> {
  const pending = Symbol();
  return (await Promise.race([promise, Promise.resolve(pending)])) !== pending;
}

// First byte and size of the file, of an answer with a part. Other origins must expose the header.
function contentRange(response: Response): { begin: number; total: number } | undefined {
  const parts = /^bytes (\d+)-\d+\/(\d+)$/.exec(response.headers.get("content-range") ?? "");
  return parts ? { begin: Number(parts[1]), total: Number(parts[2]) } : undefined;
}

// Weak validators do not identify bytes.
function validatorOf(response: Response): string | null {
  const tag = response.headers.get("etag");
  return tag?.startsWith('"') ? tag : response.headers.get("last-modified");
}
