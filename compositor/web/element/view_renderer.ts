// Renderers of views into a canvas. The element knows them by this interface only.

import workerSource from "worker-source";
import { type ByteRange, CoreError, type NextRange, type Orbit, type StreamState } from "./core.js";
import { type Answer, CoreServer, type GeometryAnswer, type GeometryRequest, type Request, type Result } from "./core_server.js";

export interface ViewRenderer {
  /** Canvas with the last view; the element places it. */
  readonly canvas: HTMLCanvasElement;
  /** Name of the renderer that has drawn the last view. */
  readonly drawnBy: "core" | "webgl";
  /** Renders a view of the given size in pixels into the canvas. One call at a time. */
  render(width: number, height: number, view: Orbit): Promise<void>;
  /** Answers a question about the object's geometry. */
  ask(request: GeometryRequest): Promise<GeometryAnswer>;
  /** Ends the renderer and frees its memory. */
  close(): void;

  /** Begins an object that arrives in parts. `name` begins the messages of errors. @param size of the file; negative if unknown */
  beginStream(name: string, size: number): Promise<void>;
  /** Takes bytes of the file, whose buffer it takes over. Those of one chunk must arrive in order. */
  addBytes(offset: number, bytes: Uint8Array<ArrayBuffer>): Promise<StreamState>;
  /** Fails if parts are missing in a file that ended after `size` bytes. */
  finishStream(size: number): Promise<void>;
  /** Selects the next range that a view needs. @param requested ranges that are being loaded */
  nextRange(width: number, height: number, view: Orbit, requested: ByteRange[]): Promise<NextRange>;
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
  readonly drawnBy = "core";
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

  async render(width: number, height: number, view: Orbit): Promise<void> {
    const { pixels } = await this.send({ kind: "render", width, height, view });
    this.sized(width, height).putImageData(new ImageData(pixels!, width, height), 0, 0);
  }

  /** The context of the canvas, which gets the given size. */
  sized(width: number, height: number): CanvasRenderingContext2D {
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    return this.context;
  }

  ask(request: GeometryRequest): Promise<GeometryAnswer> {
    return this.send(request);
  }

  close(): void {
    this.channel.close();
  }

  async beginStream(name: string, size: number): Promise<void> {
    await this.send({ kind: "begin", name, size });
  }

  async addBytes(offset: number, bytes: Uint8Array<ArrayBuffer>): Promise<StreamState> {
    return (await this.send({ kind: "add", offset, bytes }, [bytes.buffer])).state!;
  }

  async finishStream(size: number): Promise<void> {
    await this.send({ kind: "finish", size });
  }

  async nextRange(width: number, height: number, view: Orbit, requested: ByteRange[]): Promise<NextRange> {
    return (await this.send({ kind: "next", width, height, view, requested })).next!;
  }

  /** Sends a request to the core. */
  async send(request: Request, transfer: Transferable[] = []): Promise<Result> {
    const answer = await this.channel.send(request, transfer);
    if ("error" in answer) throw new CoreError(answer.error);
    return answer;
  }
}
