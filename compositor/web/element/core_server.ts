// Requests to the core as messages, so that it can run in a worker.

import {
  type ByteRange,
  Core,
  type Footprint,
  type NextRange,
  type ObjectTextures,
  type Orbit,
  type PhotoTexels,
  type StreamState,
  type SurfacePoint,
  type ViewInputs,
} from "./core.js";

/** Requests to the worker, in the order of their answers. */
export type Request =
  | { kind: "create"; module: ArrayBuffer }
  | { kind: "render"; width: number; height: number; view: Orbit }
  | { kind: "textures"; maxSide: number; maxLayers: number }
  | { kind: "photo"; photo: number }
  | { kind: "prepare"; width: number; height: number; view: Orbit }
  | { kind: "begin"; name: string; size: number }
  | { kind: "add"; offset: number; bytes: Uint8Array }
  | { kind: "finish"; size: number }
  | { kind: "next"; width: number; height: number; view: Orbit; requested: ByteRange[] }
  | GeometryRequest;

/** Requests about the opened object's geometry. */
export type GeometryRequest = { kind: "footprint" } | { kind: "surface"; width: number; height: number; view: Orbit; x: number; y: number };
export interface GeometryAnswer {
  footprint?: Footprint;
  surface?: SurfacePoint;
}

export interface Result extends GeometryAnswer {
  pixels?: Uint8ClampedArray<ArrayBuffer>;
  textures?: ObjectTextures;
  photo?: PhotoTexels;
  inputs?: ViewInputs;
  state?: StreamState;
  next?: NextRange;
}
export type Answer = { error: string } | Result;

/** Buffers of an answer that a message may hand over. */
export function buffersOf(answer: Answer): ArrayBuffer[] {
  if ("error" in answer) return [];
  const { pixels, textures, photo, inputs } = answer;
  const arrays = [pixels, photo?.colours, photo?.details, inputs?.setups, inputs?.uniforms, inputs?.photos, inputs?.rows];
  arrays.push(...(textures?.cells ?? []).map(({ texels }) => texels));
  return arrays.filter((array) => array !== undefined).map((array) => array.buffer);
}

/** Answers requests in the worker, or in the page where workers are not allowed. */
export class CoreServer {
  private core?: Core;

  async answer(request: Request): Promise<Answer> {
    try {
      if (request.kind === "create") {
        this.core = await Core.create(request.module);
        return {};
      }
      return this.answerOf(this.core!, request);
    } catch (error) {
      return { error: error instanceof Error ? error.message : String(error) };
    }
  }

  private answerOf(core: Core, request: Exclude<Request, { kind: "create" }>): Result {
    switch (request.kind) {
      case "render":
        return { pixels: core.render(request.width, request.height, request.view).slice() };
      case "textures":
        return { textures: core.textures(request.maxSide, request.maxLayers) };
      case "photo":
        return { photo: core.photo(request.photo) };
      case "prepare":
        return { inputs: core.prepare(request.width, request.height, request.view) };
      case "begin":
        core.beginStream(request.name, request.size);
        return {};
      case "add":
        return { state: core.addBytes(request.offset, request.bytes) };
      case "footprint":
        return { footprint: core.footprint() };
      case "surface":
        return { surface: core.surfacePoint(request.width, request.height, request.view, request.x, request.y) };
      case "finish":
        core.finishStream(request.size);
        return {};
      case "next":
        return { next: core.nextRange(request.width, request.height, request.view, request.requested) };
    }
  }
}
