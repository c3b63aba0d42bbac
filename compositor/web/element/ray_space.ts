// The custom element <ray-space>: shows a ray-space object (.rso) and lets visitors turn it. Attributes, methods and
// events are named as those of <model-viewer>: docs/web.md.

import { coreAddress } from "core-address";
import { describeView, formatOrbit, parseAngle, parseDescriptions, parseOrbit, type SideDescriptions } from "./camera_orbit.js";
import type { ObjectDescription, Orbit } from "./core.js";
import { createRenderer, type RendererChoice } from "./gl_renderer.js";
import { GroundShadow } from "./ground_shadow.js";
import { type HotspotConfiguration, type HotspotData, Hotspots, type Vector, vector } from "./hotspots.js";
import { InteractionPrompt } from "./interaction_prompt.js";
import { fetchModule } from "./object_source.js";
import { ObjectStream } from "./object_stream.js";
import { kDecay_ms, OrbitControls } from "./orbit_controls.js";
import { Poster } from "./poster.js";
import { template } from "./template.js";
import { ViewProjection } from "./view_projection.js";
import type { ViewRenderer } from "./view_renderer.js";

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
const kDefaultPromptDelay_ms = 3000;
const kNear = "300px"; // distance to the visible part of the page at which an object is loaded

export type CameraChangeSource = "user-interaction" | "none";

export class RaySpaceElement extends HTMLElement {
  static observedAttributes = [
    "src", "alt", "poster", "camera-orbit", "min-camera-orbit", "max-camera-orbit", "camera-controls", "auto-rotate", "disable-zoom",
    "touch-action", "renderer", "loading", "reveal", "shadow-intensity", "shadow-softness", "interaction-prompt",
    "interpolation-decay", "a11y",
  ];

  private readonly root = this.attachShadow({ mode: "open" });
  private readonly stage: HTMLElement;
  private readonly controls: OrbitControls;
  private readonly stillMotion = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly seen = new IntersectionObserver((entries) => this.showOnScreen(entries.at(-1)!.isIntersecting));
  private readonly approached = new IntersectionObserver(
    (entries) => {
      this.near = entries.at(-1)!.isIntersecting;
      this.loadIfNear();
    },
    { rootMargin: kNear },
  );
  private readonly hotspots: Hotspots;
  private readonly shadow: GroundShadow;
  private readonly prompt: InteractionPrompt;
  private readonly poster: Poster;
  private readonly resized = new ResizeObserver(() => this.invalidate());
  private renderer?: ViewRenderer;
  private object?: ObjectDescription;
  private captured: Orbit = { azimuth: 0, elevation: 0, distance: 1 };
  private loading?: AbortController;
  private shown = false; // a view is on screen
  private showing?: Promise<void>; // the first one is being drawn
  private complete = false;
  private refresh = 0;
  private onScreen = false;
  private near = false;
  private waits = false; // for the page to be scrolled to the object before it is loaded
  private shadowLook = { intensity: 0, softness: 1 };
  private shadowSoftness = -1; // of the painted shadow; -1: not painted
  private descriptions: SideDescriptions = {};
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
    const layer = this.root.querySelector<HTMLElement>(".hotspots")!;
    this.hotspots = new Hotspots(this, layer);
    this.hotspots.onfocusHidden = (normal) => {
      if (this.object) this.controls.face(normal);
    };
    this.shadow = new GroundShadow(this.part_("ground-shadow") as HTMLCanvasElement);
    this.prompt = new InteractionPrompt(this.part_("interaction-prompt"));
    this.poster = new Poster(this, this.root.querySelector<HTMLElement>(".cover")!, [this.stage, layer]);
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
    this.controls.moveTo(this.controls.home, false);
  }

  /** The point that the camera looks at, in object radii. */
  getCameraTarget(): Vector {
    return vector([0, this.object?.rings[0].targetHeight ?? 0, 0]);
  }

  /** Ends the animation to a view at its goal. */
  jumpCameraToGoal(): void {
    this.controls.jumpToGoal();
  }

  /** The view on screen as an image, without shadow and hotspots. */
  toDataURL(type?: string, quality?: number): string {
    return this.renderer?.canvas.toDataURL(type, quality) ?? "data:,";
  }

  /** As toDataURL(), as a Blob. */
  toBlob({ mimeType, qualityArgument }: { mimeType?: string; qualityArgument?: number } = {}): Promise<Blob> {
    return new Promise((resolve, reject) => {
      const done = (blob: Blob | null) => (blob ? resolve(blob) : reject(new Error("ray-space: there is no view yet; wait for load")));
      if (this.renderer && this.object) this.renderer.canvas.toBlob(done, mimeType, qualityArgument);
      else done(null);
    });
  }

  /** True while the object is shown, not its poster. */
  get modelIsVisible(): boolean {
    return !this.poster.shown;
  }

  /** Shows the object instead of its poster, with reveal="manual". */
  dismissPoster(): void {
    this.poster.dismiss(this.shown);
    this.revealed();
  }

  /** Shows the poster again, until dismissPoster(). */
  showPoster(): void {
    this.poster.show();
    this.prompt.stop();
  }

  /** Moves a hotspot, or turns its normal. */
  updateHotspot(configuration: HotspotConfiguration): void {
    this.hotspots.update(configuration);
  }

  /** Place and visibility of the hotspot with a name, the value of `slot`; null if there is none. */
  queryHotspot(name: string): HotspotData | null {
    return this.hotspots.query(name);
  }

  /** Surface at a position in the window (clientX, clientY), in object radii; null beside the object. */
  async positionAndNormalFromPoint(x: number, y: number): Promise<{ position: Vector; normal: Vector } | null> {
    if (!this.renderer || !this.object) return null;
    const box = this.stage.getBoundingClientRect();
    const size = { width: Math.max(1, Math.round(box.width)), height: Math.max(1, Math.round(box.height)) };
    const at = { x: ((x - box.left) / box.width) * size.width, y: ((y - box.top) / box.height) * size.height };
    const { surface } = await this.renderer.ask({ kind: "surface", ...size, ...at, view: { ...this.controls.view } });
    return surface ? { position: vector(surface.position), normal: vector(surface.normal) } : null;
  }

  connectedCallback(): void {
    this.seen.observe(this);
    this.resized.observe(this);
    document.addEventListener("visibilitychange", this.schedule);
    this.hotspots.connect();
    this.approached.observe(this);
    this.configure();
    if (!this.loading) this.expect();
  }

  disconnectedCallback(): void {
    this.seen.disconnect();
    this.approached.disconnect();
    this.hotspots.disconnect();
    this.near = false;
    this.resized.disconnect();
    document.removeEventListener("visibilitychange", this.schedule);
    this.unload();
  }

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (before === after) return;
    if (name === "src" && this.isConnected) this.expect();
    else if (name === "renderer" && this.isConnected && this.loading) this.expect();
    else if (name === "camera-orbit" && this.object) this.moveToAttribute();
    else if (name.endsWith("-camera-orbit") && this.object) this.limit();
    else this.configure();
    if (name === "loading") this.loadIfNear();
  }

  // Begins with another `src`: now, or as soon as the page is scrolled to it.
  private expect(): void {
    this.unload();
    this.waits = this.hasAttribute("src");
    this.part_("message").textContent = "";
    this.configure();
    this.loadIfNear();
  }

  private loadIfNear(): void {
    if (!this.waits || !this.isConnected || !(this.near || this.getAttribute("loading") === "eager")) return;
    this.waits = false;
    void this.load();
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
    poster.hidden = !image;
    this.controls.decay_ms = this.number("interpolation-decay", kDecay_ms);
    this.shadowLook = {
      intensity: Math.min(this.number("shadow-intensity", 0), 1),
      softness: Math.min(this.number("shadow-softness", 1), 1),
    };
    const descriptions = parseDescriptions(this.getAttribute("a11y") ?? "{}");
    if (!descriptions) console.warn('ray-space: a11y is no JSON object of texts, such as {"front": "Front with the logo"}');
    this.descriptions = descriptions ?? {};
    this.root.querySelector(".hint")!.textContent = this.descriptions["interaction-prompt"] ?? "Drag to turn";
    if (this.getAttribute("interaction-prompt") === "none" || !interactive) this.prompt.stop();
    if (this.poster.shown && this.shown) this.poster.ready();
    this.revealed();
    this.invalidate();
  }

  // A number of an attribute; the default if it is missing or wrong.
  private number(name: string, preset: number): number {
    const text = this.getAttribute(name);
    const value = Number(text);
    if (text === null) return preset;
    if (text.trim() !== "" && value >= 0 && Number.isFinite(value)) return value;
    console.warn(`ray-space: ${name} "${text}" is no number from 0`);
    return preset;
  }

  // Begins to draw and to wait for the prompt, if the object is shown.
  private revealed(): void {
    if (this.poster.shown) return;
    if (this.hasAttribute("camera-controls") && this.getAttribute("interaction-prompt") !== "none") {
      this.prompt.start(this.number("interaction-prompt-threshold", kDefaultPromptDelay_ms));
    }
    this.schedule();
  }

  private unload(): void {
    this.loading?.abort();
    this.loading = undefined;
    this.renderer?.close();
    this.renderer?.canvas.remove();
    this.renderer = undefined;
    this.object = undefined;
    this.shown = false;
    this.showing = undefined;
    this.complete = false;
    clearTimeout(this.refresh);
    this.refresh = 0;
    this.waits = false;
    this.shadowSoftness = -1;
    this.shadow.clear();
    this.prompt.stop();
    this.poster.reset();
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
        else if (ready && !signal.aborted) await (this.showing ??= this.showFirst());
      },
      progress: (fraction) => this.progress(Math.min(fraction, 0.99)),
    });
    try {
      const core = this.getAttribute("core") ?? coreAddress;
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
      this.placeInView(this.controls.view);
      this.progress(1);
      this.dispatchEvent(new CustomEvent("load", { detail: { url: src } }));
      this.revealed();
    } catch (error) {
      await this.showing?.catch(() => {}); // a view that is being drawn stays
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
    this.placeInView(this.controls.view);
    this.poster.ready();
    this.revealed();
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
    this.controls.jumpToGoal();
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
    this.controls.moveTo(this.orbitAttribute("camera-orbit", this.captured), false);
  }

  private changed(source: CameraChangeSource): void {
    const now = performance.now();
    this.lastChange_ms = now;
    if (source === "user-interaction") {
      this.lastUser_ms = now;
      this.prompt.dismiss();
      const direction = this.part_("direction");
      const text = describeView(this.controls.view, this.captured, this.descriptions);
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
    if (this.loop || !this.shown || !this.onScreen || document.hidden || this.poster.shown) return;
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
      const view = { ...this.controls.view };
      try {
        await this.draw(scale);
        this.placeInView(view);
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
    if (!this.hasAttribute("auto-rotate") || this.stillMotion.matches || this.controls.moving || this.hotspots.focused) {
      return false;
    }
    const delay = Number(this.getAttribute("auto-rotate-delay") ?? kDefaultTurnDelay_ms);
    if (now - this.lastUser_ms < delay) return false;
    const rate = parseAngle(this.getAttribute("rotation-per-second") ?? "") ?? kDefaultTurn;
    this.controls.view.azimuth = (this.controls.view.azimuth + (rate * elapsed_ms) / 1000) % (2 * Math.PI);
    this.drawnScale = 0;
    this.dispatchEvent(new CustomEvent("camera-change", { detail: { source: "none" } }));
    return true;
  }

  // Moves hotspots and shadow into the view that has been drawn.
  private placeInView(view: Orbit): void {
    if (!this.object) return;
    const { width, height } = getComputedStyle(this.stage); // not rounded, and before transforms of the page
    const projection = new ViewProjection(view, this.object, Number.parseFloat(width), Number.parseFloat(height));
    this.hotspots.place(projection);
    const { intensity, softness } = this.shadowLook;
    if (intensity > 0) void this.paintShadow(softness);
    this.shadow.place(projection, intensity);
  }

  private async paintShadow(softness: number): Promise<void> {
    if (softness === this.shadowSoftness || !this.renderer || !this.complete) return; // needs the shape maps
    this.shadowSoftness = softness;
    const { renderer } = this;
    try {
      const { footprint } = await renderer.ask({ kind: "footprint" });
      if (renderer !== this.renderer) return;
      this.shadow.paint(footprint!, softness);
      this.invalidate();
    } catch (error) {
      console.warn("ray-space: the shadow cannot be computed:", error);
    }
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
