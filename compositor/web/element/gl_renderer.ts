// Renders views by WebGL 2. The core prepares each view (set-ups and uniforms) and decodes photos, in its worker. Views
// whose photos are not uploaded yet, and all views while the context is lost, are rendered by the core: both give the
// same pixels, so that a change is not visible.

import type { ByteRange, NextRange, ObjectTextures, Orbit, StreamState, ViewInputs } from "./core.js";
import type { GeometryAnswer, GeometryRequest } from "./core_server.js";
import { GlDevice, GlObject } from "./gl_device.js";
import { CoreRenderer, type ViewRenderer } from "./view_renderer.js";

const kRetry_ms = 2000; // after textures did not fit, before they are allocated again
const kRest_ms = 200; // pause after which photos of the views beside are uploaded
const kBeside = Math.PI / 6;
const kBesideSide = 128; // pixels; enough columns to find the photos

export class GlRenderer implements ViewRenderer {
  readonly canvas: HTMLCanvasElement;
  drawnBy: "core" | "webgl" = "core";
  private object?: GlObject;
  private uploading?: Promise<void>;
  private arriving = false; // the object has parts that are missing, for which the core finds substitutes
  private refused_ms = Number.NEGATIVE_INFINITY; // when there was no memory for the textures
  private device?: GlDevice;
  private rest?: ReturnType<typeof setTimeout>;

  /** @param device acquired; the renderer releases it */
  constructor(
    private readonly core: CoreRenderer,
    device: GlDevice,
    private readonly onfailure: (reason: string) => void,
  ) {
    this.canvas = core.canvas;
    this.device = device;
  }

  async beginStream(name: string, size: number): Promise<void> {
    this.arriving = true;
    this.object?.delete();
    this.object = undefined;
    await this.core.beginStream(name, size);
  }

  async addBytes(offset: number, bytes: Uint8Array<ArrayBuffer>): Promise<StreamState> {
    const state = await this.core.addBytes(offset, bytes);
    this.arriving = !state.complete;
    return state;
  }

  ask(request: GeometryRequest): Promise<GeometryAnswer> {
    return this.core.ask(request);
  }

  finishStream(size: number): Promise<void> {
    return this.core.finishStream(size);
  }

  nextRange(width: number, height: number, view: Orbit, requested: ByteRange[]): Promise<NextRange> {
    return this.core.nextRange(width, height, view, requested);
  }

  async render(width: number, height: number, view: Orbit): Promise<void> {
    clearTimeout(this.rest);
    this.drawnBy = (await this.drawByGl(width, height, view)) ? "webgl" : "core";
    if (this.drawnBy === "core") await this.core.render(width, height, view);
    if (this.device && !this.arriving) this.rest = setTimeout(() => this.startUpload(() => this.uploadBeside(view)), kRest_ms);
  }

  /** Resolves when no photo is being uploaded. */
  async settled(): Promise<void> {
    await this.uploading;
  }

  close(): void {
    this.stop();
    this.core.close();
  }

  private async prepare(width: number, height: number, view: Orbit): Promise<ViewInputs> {
    return (await this.core.send({ kind: "prepare", width, height, view })).inputs!;
  }

  // Returns false if the core has to render the view.
  private async drawByGl(width: number, height: number, view: Orbit): Promise<boolean> {
    if (!this.device || this.device.isLost || this.arriving) return false;
    const inputs = await this.prepare(width, height, view);
    const { device, object } = this;
    const rings = inputs.second ? [inputs, inputs.second] : [inputs];
    if (!device || rings.some(({ setups }) => setups.length === 0)) return false;
    const photos = photosOf(inputs);
    if (!object?.isValid || object.missing(photos).length > 0) {
      this.startUpload(() => this.upload(photos));
      return false;
    }
    try {
      rings.forEach((ring, n) => device.draw(object, ring, { target: n }));
      device.present(width, height, inputs);
    } catch (error) {
      if (!device.isLost) this.fail(error);
      return false;
    }
    if (device.isLost) return false;
    const context = this.core.sized(width, height);
    context.globalCompositeOperation = "copy"; // replaces all pixels
    context.drawImage(device.canvas, 0, device.canvas.height - height, width, height, 0, 0, width, height);
    return true;
  }

  // One upload runs at a time.
  private startUpload(upload: () => Promise<void>): void {
    if (performance.now() - this.refused_ms < kRetry_ms) return;
    this.uploading ??= upload()
      .catch((error) => {
        if (this.device && !this.device.isLost) this.fail(error);
      })
      .finally(() => {
        this.uploading = undefined;
      });
  }

  // Uploads photos one at a time, so that views are rendered in between.
  private async upload(photos: Iterable<number>): Promise<void> {
    const { device } = this;
    if (!device || device.isLost) return;
    if (!this.object?.isValid) {
      const { textures } = await this.core.send({ kind: "textures", maxSide: device.maxSide, maxLayers: device.maxLayers });
      if (!this.canUpload()) return;
      this.setTextures(device, textures!);
    }
    const { object } = this;
    for (const photo of object?.missing(photos) ?? []) {
      const answer = await this.core.send({ kind: "photo", photo });
      if (!this.canUpload() || !object!.isValid) return;
      object!.upload(photo, answer.photo!);
    }
  }

  // So that the next turn of a visitor finds its photos.
  private async uploadBeside(view: Orbit): Promise<void> {
    for (const turn of [-kBeside, kBeside]) {
      if (!this.object?.isValid) return;
      const beside = { ...view, azimuth: view.azimuth + turn };
      const inputs = await this.prepare(kBesideSide, kBesideSide, beside).catch(() => undefined);
      if (inputs) await this.upload(photosOf(inputs));
    }
  }

  private setTextures(device: GlDevice, textures: ObjectTextures): void {
    this.object?.delete();
    this.object = GlObject.create(device, textures);
    if (!this.object) this.refused_ms = performance.now();
  }

  private canUpload(): boolean {
    return this.device !== undefined && !this.device.isLost && !this.arriving;
  }

  private fail(error: unknown): void {
    this.onfailure(error instanceof Error ? error.message : String(error));
    this.stop();
  }

  private stop(): void {
    clearTimeout(this.rest);
    this.object?.delete();
    this.object = undefined;
    this.device?.release();
    this.device = undefined;
  }
}

function photosOf(inputs: ViewInputs): Int32Array {
  return Int32Array.from([...inputs.photos, ...(inputs.second?.photos ?? [])]);
}

/** Renderers of the attribute `renderer`. */
export type RendererChoice = "auto" | "webgl" | "core";

/**
 * Creates a renderer. WebGL is chosen by `auto` if it has a graphics processor; the core is faster on the CPU.
 * @param module the WebAssembly module's bytes
 */
export async function createRenderer(choice: RendererChoice, module: ArrayBuffer): Promise<ViewRenderer> {
  const core = await CoreRenderer.create(module);
  if (choice === "core") return core;
  const isRequired = choice === "webgl";
  const warn = (reason: string) => {
    if (isRequired) console.warn(`ray-space: renderer "webgl": ${reason}; the core renders instead`);
  };
  const device = GlDevice.acquire(isRequired);
  if (device) return new GlRenderer(core, device, warn);
  warn("this browser has no WebGL 2");
  return core;
}
