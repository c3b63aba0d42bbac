// Renders the objects of a scene in a few workers; each object belongs to one of them.

import workerSource from "scene-worker-source";
import { CoreError } from "../element/core.js";
import type { ObjectBounds, SceneView, Sight } from "./scene_core.js";
import { type SceneAnswer, type SceneRequest, SceneServer } from "./scene_server.js";

const kMostWorkers = 4;

type Send = (request: SceneRequest) => Promise<SceneAnswer>;

/** An object that is open in a worker. Nodes may share it. */
export interface OpenObject {
  readonly bounds: ObjectBounds;
  /** Renders a view; undefined if nothing is seen. */
  render(sight: Sight): Promise<SceneView | undefined>;
}

export class SceneWorkers {
  private readonly channels: Send[] = [];
  private readonly workers: Worker[] = [];
  private readonly url = URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));
  private opened = 0;

  /** @param module the WebAssembly module's bytes */
  constructor(private readonly module: ArrayBuffer) {}

  /** Opens an .rso file. `name` begins the messages of errors. */
  async open(file: ArrayBuffer, name: string): Promise<OpenObject> {
    const object = this.opened++;
    const send = this.channel(object);
    const { bounds } = checked(await send({ kind: "open", object, module: this.module, file, name }));
    return {
      bounds: bounds!,
      render: async (sight) => checked(await send({ kind: "render", object, sight })).view,
    };
  }

  close(): void {
    for (const worker of this.workers) worker.terminate();
    URL.revokeObjectURL(this.url);
  }

  private channel(object: number): Send {
    const most = Math.min(kMostWorkers, Math.max(1, (navigator.hardwareConcurrency ?? 2) - 1));
    if (this.channels.length < most) this.channels.push(this.newChannel());
    return this.channels[object % this.channels.length];
  }

  // A content security policy without worker-src blob: leaves the page's own thread.
  private newChannel(): Send {
    let worker: Worker;
    try {
      worker = new Worker(this.url);
    } catch {
      const server = new SceneServer();
      return (request) => server.answer(request);
    }
    this.workers.push(worker);
    const waiting: { request: SceneRequest; resolve: (answer: SceneAnswer | Promise<SceneAnswer>) => void }[] = [];
    let inPage: SceneServer | undefined;
    worker.onmessage = (event: MessageEvent<SceneAnswer>) => waiting.shift()?.resolve(event.data);
    worker.onerror = (event) => {
      event.preventDefault();
      const server = (inPage = new SceneServer());
      for (const { request, resolve } of waiting.splice(0)) resolve(server.answer(request));
    };
    return (request) =>
      inPage
        ? inPage.answer(request)
        : new Promise((resolve) => {
            waiting.push({ request, resolve });
            worker.postMessage(request);
          });
  }
}

function checked(answer: SceneAnswer) {
  if ("error" in answer) throw new CoreError(answer.error);
  return answer;
}
