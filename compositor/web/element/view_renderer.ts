// Renderers of views into a canvas. The element knows them by this interface only.

import workerSource from "worker-source";
import { CoreError, type ObjectDescription, type Orbit } from "./core.js";
import { type Answer, CoreServer, type GeometryAnswer, type GeometryRequest, type Request } from "./core_server.js";

export interface ViewRenderer {
  /** Canvas with the last view; the element places it. */
  readonly canvas: HTMLCanvasElement;
  /** Opens an .rso file, whose buffer it takes over. `name` begins the messages of errors. */
  open(file: ArrayBuffer, name: string): Promise<ObjectDescription>;
  /** Renders a view of the given size in pixels into the canvas. One call at a time. */
  render(width: number, height: number, view: Orbit): Promise<void>;
  /** Answers a question about the object's geometry. */
  ask(request: GeometryRequest): Promise<GeometryAnswer>;
  /** Ends the renderer and frees its memory. */
  close(): void;
}

interface Channel {
  send(request: Request, transfer: Transferable[]): Promise<Answer>;
  close(): void;
}

function workerChannel(): Channel {
  const url = URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));
  const worker = new Worker(url);
  const waiting: ((answer: Answer) => void)[] = [];
  worker.onmessage = (event: MessageEvent<Answer>) => waiting.shift()?.(event.data);
  worker.onerror = (event) => {
    event.preventDefault();
    for (const resolve of waiting.splice(0)) resolve({ error: "the renderer has stopped" });
  };
  return {
    send: (request, transfer) =>
      new Promise((resolve) => {
        waiting.push(resolve);
        worker.postMessage(request, transfer);
      }),
    close: () => {
      worker.terminate();
      URL.revokeObjectURL(url);
    },
  };
}

function pageChannel(): Channel {
  const server = new CoreServer();
  return { send: (request) => server.answer(request), close: () => {} };
}

/** The WebAssembly core in a worker, into a 2D canvas: the same pixels as the engine's, bit for bit. */
export class CoreRenderer implements ViewRenderer {
  readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d")!;

  private constructor(private readonly channel: Channel) {}

  /** @param module the WebAssembly module's bytes */
  static async create(module: ArrayBuffer): Promise<CoreRenderer> {
    try {
      return await CoreRenderer.over(workerChannel(), module);
    } catch {
      return CoreRenderer.over(pageChannel(), module); // a content security policy without worker-src blob:
    }
  }

  private static async over(channel: Channel, module: ArrayBuffer): Promise<CoreRenderer> {
    const renderer = new CoreRenderer(channel);
    await renderer.send({ kind: "create", module });
    return renderer;
  }

  async open(file: ArrayBuffer, name: string): Promise<ObjectDescription> {
    return (await this.send({ kind: "open", file, name }, [file])).description!;
  }

  async render(width: number, height: number, view: Orbit): Promise<void> {
    const { pixels } = await this.send({ kind: "render", width, height, view });
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.context.putImageData(new ImageData(pixels!, width, height), 0, 0);
  }

  ask(request: GeometryRequest): Promise<GeometryAnswer> {
    return this.send(request);
  }

  close(): void {
    this.channel.close();
  }

  private async send(request: Request, transfer: Transferable[] = []) {
    const answer = await this.channel.send(request, transfer);
    if ("error" in answer) throw new CoreError(answer.error);
    return answer;
  }
}
