// The custom element <ray-space>: shows a ray-space object (.rso) and lets visitors turn it. Attributes, methods and
// events are named as those of <model-viewer>: docs/web.md.

import { describeView, formatOrbit, parseAngle, parseOrbit } from "./camera_orbit.js";
import type { ObjectDescription, Orbit } from "./core.js";
import { createRenderer, type RendererChoice } from "./gl_renderer.js";
import { fetchModule } from "./object_source.js";
import { ObjectStream } from "./object_stream.js";
import { OrbitControls } from "./orbit_controls.js";
import { template } from "./template.js";
import type { ViewRenderer } from "./view_renderer.js";

const kScript = (document.currentScript as HTMLScriptElement | null)?.src;
const kBeyondCaptured = (15 * Math.PI) / 180;
const kSteepest = (80 * Math.PI) / 180;
const kFrame_ms = 40; // aim for views in motion, which are rendered smaller where needed
const kSmallestScale = 0.3;
const kRest_ms = 150; // pause after which a view is rendered at full size
const kRefresh_ms = 250; // between views while photos arrive
const kMaxPixelRatio = 2;
const kMaxPixels = 2_500_000;
const kDefaultTurn = Math.PI / 16; // radians per second
const kDefaultTurnDelay_ms = 3000;

export type CameraChangeSource = "user-interaction" | "none";

export class RaySpaceElement extends HTMLElement {
  static observedAttributes = [
    "src", "alt", "poster", "camera-orbit", "min-camera-orbit", "max-camera-orbit", "camera-controls", "auto-rotate", "disable-zoom",
    "touch-action", "renderer",
  ];

  private readonly root = this.attachShadow({ mode: "open" });
  private readonly stage: HTMLElement;
  private readonly controls: OrbitControls;
  private readonly stillMotion = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly seen = new IntersectionObserver((entries) => this.showOnScreen(entries.at(-1)!.isIntersecting));
  private readonly resized = new ResizeObserver(() => this.invalidate());
  private renderer?: ViewRenderer;
  private object?: ObjectDescription;
  private captured: Orbit = { azimuth: 0, elevation: 0, distance: 1 };
  private loading?: AbortController;
  private shown = false; // a view is on screen
  private complete = false;
  private refresh = 0;
  private onScreen = false;
  private loop = 0;
  private lastFrame_ms = 0;
  private lastChange_ms = 0;
  private lastUser_ms = Number.NEGATIVE_INFINITY;
  private scale = 1; // of views in motion
  private drawnScale = 0; // of the view on screen; 0: outdated
  private drawing = false;

  constructor() {
    super();
    this.root.append(template().content.cloneNode(true));
    this.stage = this.part_("stage");
    this.controls = new OrbitControls(this.stage);
    this.controls.onchange = (byUser) => this.changed(byUser ? "user-interaction" : "none");
    this.part_("full-screen").addEventListener("click", () => this.toggleFullScreen());
    this.stillMotion.addEventListener("change", () => this.configure());
  }

  /** True after the `load` event: all photos are there. */
  get loaded(): boolean {
    return this.complete;
  }

  /** Renderer in use; undefined until the object is loaded. For tests. */
  get viewRenderer(): ViewRenderer | undefined {
    return this.renderer;
  }

  get src(): string | null {
    return this.getAttribute("src");
  }

  set src(url: string | null) {
    if (url === null) this.removeAttribute("src");
    else this.setAttribute("src", url);
  }

  get cameraOrbit(): string {
    return formatOrbit(this.controls.view, this.captured);
  }

  set cameraOrbit(orbit: string) {
    this.setAttribute("camera-orbit", orbit);
  }

  /** The current camera: angles in radians, radius in object radii. */
  getCameraOrbit(): { theta: number; phi: number; radius: number; toString(): string } {
    const { azimuth, elevation, distance } = this.controls.view;
    const text = this.cameraOrbit;
    return { theta: azimuth, phi: Math.PI / 2 - elevation, radius: distance, toString: () => text };
  }

  /** Returns to the first view. */
  resetTurntableRotation(): void {
    this.controls.view = { ...this.controls.home };
    this.changed("none");
  }

  /** The view on screen as an image. */
  toDataURL(type?: string, quality?: number): string {
    return this.renderer?.canvas.toDataURL(type, quality) ?? "data:,";
  }

  connectedCallback(): void {
    this.seen.observe(this);
    this.resized.observe(this);
    document.addEventListener("visibilitychange", this.schedule);
    this.configure();
    if (this.hasAttribute("src") && !this.loading) void this.load();
  }

  disconnectedCallback(): void {
    this.seen.disconnect();
    this.resized.disconnect();
    document.removeEventListener("visibilitychange", this.schedule);
    this.unload();
  }

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (before === after) return;
    if (name === "src" && this.isConnected) void this.load();
    else if (name === "renderer" && this.isConnected && this.loading) void this.load();
    else if (name === "camera-orbit" && this.object) this.moveToAttribute();
    else if (name.endsWith("-camera-orbit") && this.object) this.limit();
    else this.configure();
  }

  private part_(name: string): HTMLElement {
    return this.root.querySelector(`[part~="${name}"]`)!;
  }

  // Applies attributes that need no loading.
  private configure(): void {
    const interactive = this.hasAttribute("camera-controls");
    const alt = this.getAttribute("alt") ?? "Object that can be viewed from all sides";
    this.stage.style.pointerEvents = interactive ? "auto" : "none";
    this.stage.tabIndex = interactive ? 0 : -1;
    this.stage.setAttribute("role", interactive ? "application" : "img");
    this.stage.setAttribute("aria-label", interactive ? `${alt}. Drag or use the arrow keys to turn it.` : alt);
    this.stage.style.touchAction = this.getAttribute("touch-action") ?? "pan-y";
    this.part_("full-screen").hidden = !interactive || !document.fullscreenEnabled;
    this.controls.fixedZoom = this.hasAttribute("disable-zoom");
    this.controls.smooth = !this.stillMotion.matches;
    const poster = this.part_("poster") as HTMLImageElement;
    const image = this.getAttribute("poster");
    if (image) poster.src = image;
    poster.hidden = !image || this.shown;
    this.invalidate();
  }

  private unload(): void {
    this.loading?.abort();
    this.loading = undefined;
    this.renderer?.close();
    this.renderer?.canvas.remove();
    this.renderer = undefined;
    this.object = undefined;
    this.shown = false;
    this.complete = false;
    clearTimeout(this.refresh);
    this.refresh = 0;
    cancelAnimationFrame(this.loop);
    this.loop = 0;
  }

  private async load(): Promise<void> {
    this.unload();
    this.part_("message").textContent = "";
    const src = this.src;
    if (!src) return;
    this.loading = new AbortController();
    const { signal } = this.loading;
    this.configure();
    this.progress(0);
    const stream = new ObjectStream(src, signal, {
      view: () => ({ ...this.viewSize(1), orbit: { ...this.controls.view } }),
      described: (object) => this.begin(object),
      arrived: async (_, ready) => {
        if (this.shown) this.refreshSoon();
        else if (ready && !signal.aborted) await this.showFirst();
      },
      progress: (fraction) => this.progress(Math.min(fraction, 0.99)),
    });
    try {
      const core = this.getAttribute("core") ?? new URL("ray-space.wasm", kScript ?? document.baseURI).href;
      const [module] = await Promise.all([fetchModule(core, signal), stream.open()]);
      const renderer = await createRenderer(this.rendererChoice(), module);
      if (signal.aborted) return renderer.close();
      this.renderer = renderer;
      await stream.load(renderer);
      if (signal.aborted) return;
      if (this.shown) await this.draw(1);
      else await this.showFirst();
      if (signal.aborted) return;
      this.complete = true;
      this.progress(1);
      this.dispatchEvent(new CustomEvent("load", { detail: { url: src } }));
      this.schedule();
    } catch (error) {
      if (!signal.aborted) this.fail(error, this.shown);
    }
  }

  private rendererChoice(): RendererChoice {
    const text = this.getAttribute("renderer") ?? "auto";
    if (text === "auto" || text === "webgl" || text === "core") return text;
    console.warn(`ray-space: renderer "${text}" is unknown; write auto, webgl or core`);
    return "auto";
  }

  // Replaces the poster by the first view, perhaps of few photos.
  private async showFirst(): Promise<void> {
    const { renderer } = this;
    await this.draw(1);
    if (!renderer || this.renderer !== renderer) return;
    this.shown = true;
    this.stage.prepend(renderer.canvas);
    this.part_("poster").hidden = true;
    this.dispatchEvent(new CustomEvent("poster-dismissed"));
    this.schedule();
  }

  private refreshSoon(): void {
    if (this.refresh) return;
    this.refresh = window.setTimeout(() => {
      this.refresh = 0;
      this.invalidate();
    }, kRefresh_ms);
  }

  /** @param keep what is shown stays, with the message below it */
  private fail(error: unknown, keep = false): void {
    if (keep) this.loading?.abort();
    else this.unload();
    const message = error instanceof Error ? error.message : String(error);
    this.progress(1);
    this.part_("message").toggleAttribute("data-below", keep);
    this.part_("message").textContent = message;
    this.dispatchEvent(new CustomEvent("error", { detail: { type: "loadfailure", sourceError: error, message } }));
  }

  private progress(fraction: number): void {
    const bar = this.part_("progress") as HTMLProgressElement;
    bar.value = fraction;
    bar.hidden = fraction >= 1;
    this.dispatchEvent(new CustomEvent("progress", { detail: { totalProgress: fraction } }));
  }

  private begin(object: ObjectDescription): void {
    this.object = object;
    const { azimuth, elevation, distance } = object.rings[0];
    this.captured = { azimuth, elevation, distance };
    this.moveToAttribute();
    this.controls.home = { ...this.controls.view };
  }

  // An orbit of an attribute; `auto` if it is missing or wrong.
  private orbitAttribute(name: string, auto: Orbit): Orbit {
    const text = this.getAttribute(name);
    if (text === null) return auto;
    const orbit = parseOrbit(text, this.captured, auto);
    if (!orbit) console.warn(`ray-space: ${name} "${text}" is no orbit; write it as "30deg 70deg 100%", each may be auto`);
    return orbit ?? auto;
  }

  // Limits as <model-viewer> names them: the smallest angle from the vertical is the highest elevation.
  private setLimits(): void {
    const { azimuth, distance } = this.captured;
    const elevations = this.object!.rings.map((ring) => ring.elevation);
    const lowest = Math.max(Math.min(...elevations) - kBeyondCaptured, -kSteepest);
    const highest = Math.min(Math.max(...elevations) + kBeyondCaptured, kSteepest);
    const nearest = Math.max(0.35 * distance, Math.min(1.6, distance));
    const near = this.orbitAttribute("min-camera-orbit", { azimuth, elevation: highest, distance: nearest });
    const far = this.orbitAttribute("max-camera-orbit", { azimuth, elevation: lowest, distance: 2.5 * distance });
    if (near.azimuth !== azimuth || far.azimuth !== azimuth) {
      console.warn("ray-space: min-camera-orbit and max-camera-orbit limit no turn; write auto as the first angle");
    }
    this.controls.limits = {
      lowestElevation: Math.min(far.elevation, near.elevation),
      highestElevation: Math.max(far.elevation, near.elevation),
      nearest: Math.min(near.distance, far.distance),
      farthest: Math.max(near.distance, far.distance),
    };
  }

  private limit(): void {
    this.setLimits();
    this.controls.clamp();
    this.changed("none");
  }

  private moveToAttribute(): void {
    this.setLimits();
    this.controls.view = { ...this.orbitAttribute("camera-orbit", this.captured) };
    this.controls.clamp();
    this.changed("none");
  }

  private changed(source: CameraChangeSource): void {
    const now = performance.now();
    this.lastChange_ms = now;
    if (source === "user-interaction") {
      this.lastUser_ms = now;
      const direction = this.part_("direction");
      const text = describeView(this.controls.view, this.captured);
      if (direction.textContent !== text) direction.textContent = text; // read aloud after each change
    }
    this.dispatchEvent(new CustomEvent("camera-change", { detail: { source } }));
    this.invalidate();
  }

  private invalidate(): void {
    this.drawnScale = 0;
    this.schedule();
  }

  private showOnScreen(onScreen: boolean): void {
    this.onScreen = onScreen;
    this.schedule();
  }

  // Frames are requested only while the element is visible and something changes.
  private readonly schedule = (): void => {
    if (this.loop || !this.shown || !this.onScreen || document.hidden) return;
    this.loop = requestAnimationFrame((now) => {
      this.loop = 0;
      void this.frame(now);
    });
  };

  private async frame(now: number): Promise<void> {
    if (this.drawing || !this.renderer) return;
    const elapsed_ms = Math.min(now - this.lastFrame_ms, 100);
    this.lastFrame_ms = now;
    this.controls.advance(elapsed_ms);
    const turns = this.turnTable(now, elapsed_ms);
    const waits = now - this.lastChange_ms < kRest_ms || this.controls.moving;
    const scale = waits || turns ? this.scale : 1;
    if (this.drawnScale < scale) {
      this.drawing = true;
      try {
        await this.draw(scale);
      } catch (error) {
        return this.fail(error);
      } finally {
        this.drawing = false;
      }
    }
    if (turns || waits || this.drawnScale < 1 || this.hasAttribute("auto-rotate")) this.schedule();
  }

  // Rotates the view slowly while no visitor does.
  private turnTable(now: number, elapsed_ms: number): boolean {
    if (!this.hasAttribute("auto-rotate") || this.stillMotion.matches || this.controls.held) return false;
    const delay = Number(this.getAttribute("auto-rotate-delay") ?? kDefaultTurnDelay_ms);
    if (now - this.lastUser_ms < delay) return false;
    const rate = parseAngle(this.getAttribute("rotation-per-second") ?? "") ?? kDefaultTurn;
    this.controls.view.azimuth = (this.controls.view.azimuth + (rate * elapsed_ms) / 1000) % (2 * Math.PI);
    this.drawnScale = 0;
    this.dispatchEvent(new CustomEvent("camera-change", { detail: { source: "none" } }));
    return true;
  }

  private async draw(scale: number): Promise<void> {
    const { width, height } = this.viewSize(scale);
    this.drawnScale = scale;
    const begun = performance.now();
    await this.renderer?.render(width, height, { ...this.controls.view });
    const took_ms = performance.now() - begun;
    // Time is proportional to the pixels; half a step at a time, since other work disturbs the measurement.
    const wanted = scale * Math.sqrt(kFrame_ms / Math.max(took_ms, 1));
    this.scale = Math.min(1, Math.max(kSmallestScale, (this.scale + wanted) / 2));
  }

  // Size of a view in pixels.
  private viewSize(scale: number): { width: number; height: number } {
    const box = this.stage.getBoundingClientRect();
    const ratio = Math.min(devicePixelRatio, kMaxPixelRatio);
    const fit = Math.min(1, Math.sqrt(kMaxPixels / Math.max(1, box.width * box.height * ratio * ratio)));
    const side = (length: number) => Math.max(1, Math.round(length * ratio * fit * scale));
    return { width: side(box.width), height: side(box.height) };
  }

  private toggleFullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void this.requestFullscreen();
  }
}

if (!customElements.get("ray-space")) customElements.define("ray-space", RaySpaceElement);

declare global {
  interface HTMLElementTagNameMap {
    "ray-space": RaySpaceElement;
  }
}
