// Requests to the core as messages, so that it can run in a worker.

import { Core, type ObjectDescription, type Orbit } from "./core.js";

/** Requests to the worker, in the order of their answers. */
export type Request =
  | { kind: "create"; module: ArrayBuffer }
  | { kind: "open"; file: ArrayBuffer; name: string }
  | { kind: "render"; width: number; height: number; view: Orbit };

export type Answer = { error: string } | { description?: ObjectDescription; pixels?: Uint8ClampedArray<ArrayBuffer> };

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
      return { pixels: this.core!.render(request.width, request.height, request.view).slice() };
    } catch (error) {
      return { error: error instanceof Error ? error.message : String(error) };
    }
  }
}
