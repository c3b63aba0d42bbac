// Requests to the objects of a scene as messages, so that they can run in workers.

import { type ObjectBounds, SceneCore, type SceneView, type Sight } from "./scene_core.js";

/** Requests are answered in their order. */
export type SceneRequest =
  | { kind: "open"; object: number; module: ArrayBuffer; file: ArrayBuffer; name: string }
  | { kind: "render"; object: number; sight: Sight };

export type SceneAnswer = { error: string } | { bounds?: ObjectBounds; view?: SceneView };

/** Answers requests in a worker, or in the page where workers are not allowed. */
export class SceneServer {
  private readonly cores = new Map<number, SceneCore>();

  async answer(request: SceneRequest): Promise<SceneAnswer> {
    try {
      if (request.kind === "render") return { view: this.cores.get(request.object)!.render(request.sight) };
      const core = await SceneCore.open(request.module, new Uint8Array(request.file), request.name);
      this.cores.set(request.object, core);
      return { bounds: core.bounds };
    } catch (error) {
      return { error: error instanceof Error ? error.message : String(error) };
    }
  }
}
