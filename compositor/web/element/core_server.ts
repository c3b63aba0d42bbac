// Requests to the core as messages, so that it can run in a worker.

import { type ByteRange, Core, type NextRange, type ObjectDescription, type Orbit, type StreamState } from "./core.js";

/** Requests to the worker, in the order of their answers. */
export type Request =
  | { kind: "create"; module: ArrayBuffer }
  | { kind: "open"; file: ArrayBuffer; name: string }
  | { kind: "render"; width: number; height: number; view: Orbit }
  | { kind: "begin"; name: string; size: number }
  | { kind: "add"; offset: number; bytes: Uint8Array }
  | { kind: "finish"; size: number }
  | { kind: "next"; width: number; height: number; view: Orbit; requested: ByteRange[] };

export type Answer =
  | { error: string }
  | { description?: ObjectDescription; pixels?: Uint8ClampedArray<ArrayBuffer>; state?: StreamState; next?: NextRange };

/** Answers requests in the worker, or in the page where workers are not allowed. */
export class CoreServer {
  private core?: Core;

  async answer(request: Request): Promise<Answer> {
    try {
      if (request.kind === "create") {
        this.core = await Core.create(request.module);
        return {};
      }
      if (request.kind === "open") return { description: this.core!.open(new Uint8Array(request.file), request.name) };
      if (request.kind === "render") {
        return { pixels: this.core!.render(request.width, request.height, request.view).slice() };
      }
      return this.stream(this.core!, request);
    } catch (error) {
      return { error: error instanceof Error ? error.message : String(error) };
    }
  }

  private stream(core: Core, request: Request): Answer {
    if (request.kind === "add") return { state: core.addBytes(request.offset, request.bytes) };
    if (request.kind === "next") return { next: core.nextRange(request.width, request.height, request.view, request.requested) };
    if (request.kind === "begin") core.beginStream(request.name, request.size);
    if (request.kind === "finish") core.finishStream(request.size);
    return {};
  }
}
