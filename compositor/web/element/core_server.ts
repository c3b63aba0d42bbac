// Requests to the core as messages, so that it can run in a worker.

import { Core, type Footprint, type ObjectDescription, type Orbit, type SurfacePoint } from "./core.js";

/** Requests to the worker, in the order of their answers. */
export type Request =
  | { kind: "create"; module: ArrayBuffer }
  | { kind: "open"; file: ArrayBuffer; name: string }
  | { kind: "render"; width: number; height: number; view: Orbit }
  | GeometryRequest;

/** Requests about the opened object's geometry. */
export type GeometryRequest = { kind: "footprint" } | { kind: "surface"; width: number; height: number; view: Orbit; x: number; y: number };
export type GeometryAnswer = { footprint?: Footprint; surface?: SurfacePoint };

export type Answer = { error: string } | ({ description?: ObjectDescription; pixels?: Uint8ClampedArray<ArrayBuffer> } & GeometryAnswer);

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
      if (request.kind === "footprint") return { footprint: this.core!.footprint() };
      if (request.kind === "surface") {
        return { surface: this.core!.surfacePoint(request.width, request.height, request.view, request.x, request.y) };
      }
      return { pixels: this.core!.render(request.width, request.height, request.view).slice() };
    } catch (error) {
      return { error: error instanceof Error ? error.message : String(error) };
    }
  }
}
