// The custom element <ray-space-scene>: a scene with ray-space objects that visitors walk through, drawn by three.js.
// Attributes, keys and events: docs/web.md.

import * as three from "three";
import { CoreError } from "../element/core.js";
import { fetchFile, fetchModule, fileName } from "../element/object_source.js";
import { RaySpaceObject3D } from "./ray_space_object.js";
import { fogTransmittance, readScene, type SceneFile, type Viewpoint } from "./scene_file.js";
import { directionOf, groupAround, kObjectLayer, kSkyLayer } from "./scene_lights.js";
import { type OpenObject, SceneWorkers } from "./scene_workers.js";
import { template } from "./template.js";
import { visitorAt, sightOf, type Visitor, WalkControls } from "./walk_controls.js";

const kScript = (document.currentScript as HTMLScriptElement | null)?.src;
const kMaxPixelRatio = 2;
const kRest_ms = 150; // pause after which objects are rendered at full resolution
const kNear = 0.03; // scene units
const kDefaultFieldOfView = 0.8; // radians, along the shorter side
const kFirstOrder = -1000; // objects are drawn before glass

interface PlacedObject {
  object: RaySpaceObject3D;
  name: string;
}

export class RaySpaceSceneElement extends HTMLElement {
  static observedAttributes = ["src", "alt"];

  private readonly root = this.attachShadow({ mode: "open" });
  private readonly stage: HTMLElement;
  private readonly controls: WalkControls;
  private readonly camera = new three.PerspectiveCamera(50, 1, kNear, 100);
  private readonly stillMotion = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly resized = new ResizeObserver(() => this.invalidate());
  private readonly seen = new IntersectionObserver((entries) => {
    this.onScreen = entries.at(-1)!.isIntersecting;
    this.schedule();
  });
  private readonly objects: PlacedObject[] = [];
  private renderer?: three.WebGLRenderer;
  private workers?: SceneWorkers;
  private file?: SceneFile;
  private loading?: AbortController;
  private fieldOfView = kDefaultFieldOfView;
  private onScreen = false;
  private loop = 0;
  private lastFrame_ms = 0;
  private lastChange_ms = 0;
  private complete = false;
  private shadowsReady = false;
  private outdated = true;

  constructor() {
    super();
    this.root.append(template().content.cloneNode(true));
    this.stage = this.part_("stage");
    this.controls = new WalkControls(this.stage);
    this.controls.onaction = () => this.invalidate();
    this.controls.onclick = (place) => this.pick(place);
    this.controls.onwalk = () => this.endOrbit();
    this.part_("full-screen").addEventListener("click", () => this.toggleFullScreen());
    this.part_("viewpoints").addEventListener("change", () => this.chooseViewpoint());
    this.part_("objects").addEventListener("change", () => this.chooseObject());
    this.stillMotion.addEventListener("change", () => this.configure());
  }

  /** True after the `load` event. */
  get loaded(): boolean {
    return this.complete;
  }

  /** True if the frame on screen shows everything at full resolution. For tests. */
  get settled(): boolean {
    return this.loaded && !this.outdated && !this.controls.moving;
  }

  get src(): string | null {
    return this.getAttribute("src");
  }

  set src(url: string | null) {
    if (url === null) this.removeAttribute("src");
    else this.setAttribute("src", url);
  }

  /** The visitor: eye in scene units, heading (0: along -Z, increasing to the left) and pitch in radians. */
  getVisitor(): { eye: number[]; heading: number; pitch: number } {
    const { eye, heading, pitch } = this.controls.visitor;
    return { eye: eye.toArray(), heading, pitch };
  }

  /** Places the visitor. */
  setVisitor(eye: [number, number, number], heading: number, pitch: number): void {
    this.controls.walk();
    this.controls.visitor = { eye: new three.Vector3(...eye), heading, pitch };
    this.invalidate();
  }

  /** The names of the scene's viewpoints. */
  get viewpoints(): string[] {
    return this.file?.viewpoints.map(({ name }) => name) ?? [];
  }

  /** The view on screen as an image. */
  toDataURL(type?: string, quality?: number): string {
    this.draw();
    return this.renderer?.domElement.toDataURL(type, quality) ?? "data:,";
  }

  connectedCallback(): void {
    this.seen.observe(this);
    this.resized.observe(this);
    document.addEventListener("visibilitychange", this.schedule);
    this.configure();
    if (this.hasAttribute("src") && !this.file) void this.load();
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
    else this.configure();
  }

  private part_(name: string): HTMLElement {
    return this.root.querySelector(`[part~="${name}"]`)!;
  }

  private configure(): void {
    const alt = this.getAttribute("alt") ?? "Scene";
    this.stage.setAttribute("aria-label", `${alt}. Walk with the arrow keys or W, A, S, D; drag to look around.`);
    this.controls.smooth = !this.stillMotion.matches;
    this.part_("full-screen").hidden = !document.fullscreenEnabled;
  }

  // Files inside the page are listed by address in the JSON of the script element that `files` names.
  private addressOf(url: string): string {
    const list = this.getAttribute("files");
    const text = list ? document.getElementById(list)?.textContent : undefined;
    const files = (text ? JSON.parse(text) : {}) as Record<string, string>;
    return files[url] ?? new URL(url, new URL(this.src!, document.baseURI)).href;
  }

  private async load(): Promise<void> {
    this.unload();
    const { signal } = (this.loading = new AbortController());
    this.part_("message").textContent = "";
    try {
      this.progress(0.02);
      const source = this.addressOf(this.src!);
      const core = this.getAttribute("core") ?? new URL("ray-space.wasm", kScript ?? document.baseURI).href;
      const [module, glb] = await Promise.all([
        fetchModule(core, signal),
        fetchFile(source, signal, (fraction) => this.progress(0.5 * fraction)),
      ]);
      const file = await readScene(glb, fileName(source));
      if (signal.aborted) return;
      this.begin(file);
      await this.openObjects(file, module, signal);
      if (signal.aborted) return;
      this.complete = true;
      this.progress(1);
      this.dispatchEvent(new CustomEvent("load", { detail: { url: this.src } }));
    } catch (error) {
      if (!signal.aborted) this.fail(error);
    }
  }

  private begin(file: SceneFile): void {
    this.file = file;
    this.renderer = newRenderer();
    this.stage.append(this.renderer.domElement);
    this.shadowsReady = false;
    if (file.headlight) {
      const light = new three.DirectionalLight(0xffffff, Math.PI);
      light.layers.enableAll();
      this.camera.add(light, light.target);
      light.position.set(0, 0, 0);
      light.target.position.set(0, 0, -1);
    }
    file.scene.add(this.camera);
    const size = file.box.isEmpty() ? 10 : file.box.getSize(new three.Vector3()).length();
    this.camera.far = Math.max(50, 3 * size);
    this.controls.speed = file.speed;
    const list = this.part_("viewpoints") as HTMLSelectElement;
    list.replaceChildren(...file.viewpoints.map(({ name }, n) => new Option(name, String(n))));
    list.parentElement!.hidden = file.viewpoints.length < 2;
    if (file.viewpoints[0]) this.stand(file.viewpoints[0]);
    else this.frame_(file.box);
    this.invalidate();
  }

  private stand(viewpoint: Viewpoint): Visitor {
    this.fieldOfView = viewpoint.fieldOfView;
    const visitor = visitorOf(viewpoint);
    this.controls.visitor = visitor;
    return visitor;
  }

  // Without viewpoints, from the front of everything.
  private frame_(box: three.Box3): void {
    const sphere = box.getBoundingSphere(new three.Sphere());
    const distance = sphere.radius / Math.sin(this.fieldOfView / 2);
    const eye = sphere.center.clone().add(new three.Vector3(0, 0.25 * distance, distance));
    this.controls.visitor = visitorAt(eye, sphere.center.clone().sub(eye));
  }

  // Each file is opened once; its nodes share it. A file that cannot be opened is missing in the scene.
  private async openObjects(file: SceneFile, module: ArrayBuffer, signal: AbortSignal): Promise<void> {
    const workers = (this.workers = new SceneWorkers(module));
    const opened = new Map<string, Promise<OpenObject>>();
    const failures: string[] = [];
    let done = 0;
    const open = async (url: string) => workers.open(await fetchFile(this.addressOf(url), signal), decodeURIComponent(fileName(url)));
    await Promise.all(
      file.objects.map(async ({ node, url, standing, description }) => {
        if (!opened.has(url)) opened.set(url, open(url));
        try {
          const object = new RaySpaceObject3D(await opened.get(url)!, standing);
          if (signal.aborted) return;
          object.layers.set(kObjectLayer);
          for (const quad of object.children) quad.layers.set(kObjectLayer);
          object.onchange = () => this.schedule();
          object.onfailure = (error) => this.note(messageOf(error));
          node.add(object);
          this.objects.push({ object, name: description });
          object.updateWorldMatrix(true, false);
          await this.castShadow(file, object);
        } catch (error) {
          if (!failures.includes(messageOf(error))) failures.push(messageOf(error));
        }
        this.progress(0.5 + (0.49 * ++done) / file.objects.length);
        this.invalidate();
      }),
    );
    if (failures.length > 0) this.note(`Objects are missing: ${failures.join("; ")}`);
    const list = this.part_("objects") as HTMLSelectElement;
    const names = this.objects.map(({ name }, n) => new Option(name, String(n)));
    list.replaceChildren(new Option("none", ""), ...names);
    list.parentElement!.hidden = names.length === 0;
  }

  private async castShadow(file: SceneFile, object: RaySpaceObject3D): Promise<void> {
    const group = groupAround(file.groups, object.sphere().center);
    for (const sun of group?.suns ?? []) {
      const caster = await object.shadowFrom(directionOf(sun));
      if (!caster || this.file !== file) return;
      caster.layers.set(group!.opaque);
      file.scene.add(caster);
    }
    this.shadowsReady = false;
  }

  private unload(): void {
    this.loading?.abort();
    cancelAnimationFrame(this.loop);
    this.loop = 0;
    this.workers?.close();
    for (const { object } of this.objects.splice(0)) object.dispose();
    this.camera.clear();
    this.renderer?.domElement.remove();
    this.renderer?.dispose();
    this.renderer = this.file = this.workers = undefined;
    this.complete = false;
  }

  private fail(error: unknown): void {
    this.unload();
    const message = messageOf(error);
    this.progress(1);
    this.part_("message").textContent = message;
    this.dispatchEvent(new CustomEvent("error", { detail: { type: "loadfailure", sourceError: error, message } }));
  }

  private note(text: string): void {
    this.part_("notice").textContent = text;
  }

  private progress(fraction: number): void {
    const bar = this.part_("progress") as HTMLProgressElement;
    bar.value = fraction;
    bar.hidden = fraction >= 1;
    this.dispatchEvent(new CustomEvent("progress", { detail: { totalProgress: fraction } }));
  }

  private chooseViewpoint(): void {
    const viewpoint = this.file?.viewpoints[Number((this.part_("viewpoints") as HTMLSelectElement).value)];
    if (!viewpoint) return;
    this.controls.walk();
    this.fieldOfView = viewpoint.fieldOfView;
    this.controls.goTo(visitorOf(viewpoint));
  }

  private chooseObject(): void {
    const { value } = this.part_("objects") as HTMLSelectElement;
    if (value === "") this.controls.walk();
    else this.orbit(this.objects[Number(value)]);
  }

  // A click on an object orbits it; any other click ends the orbit.
  private pick(place: three.Vector2): void {
    if (!this.file) return;
    const caster = new three.Raycaster();
    caster.layers.enableAll();
    caster.setFromCamera(place, this.camera);
    const hit = caster.intersectObject(this.file.scene).find(({ object }) => object !== this.file!.sky);
    const found = this.objects.find(({ object }) => object === hit?.object);
    if (found) this.orbit(found);
    else this.controls.walk();
  }

  private orbit(placed: PlacedObject): void {
    const { center, radius } = placed.object.sphere();
    this.controls.orbit(center, 1.4 * radius);
    (this.part_("objects") as HTMLSelectElement).value = String(this.objects.indexOf(placed));
    this.note(`${placed.name}: drag or use the keys to look at it from all sides; Escape ends this.`);
  }

  private endOrbit(): void {
    (this.part_("objects") as HTMLSelectElement).value = "";
    this.note("");
    this.invalidate();
  }

  private invalidate(): void {
    this.outdated = true;
    this.lastChange_ms = performance.now();
    this.schedule();
  }

  // Frames are requested only while the element is visible and something changes.
  private readonly schedule = (): void => {
    if (this.loop || !this.file || !this.onScreen || document.hidden) return;
    this.loop = requestAnimationFrame((now) => {
      this.loop = 0;
      this.frame(now);
    });
  };

  private frame(now: number): void {
    const elapsed_s = Math.min(now - this.lastFrame_ms, 100) / 1000;
    this.lastFrame_ms = now;
    const { moving } = this.controls;
    if (moving) {
      this.controls.advance(elapsed_s);
      this.lastChange_ms = performance.now();
    }
    const waits = moving || performance.now() - this.lastChange_ms < kRest_ms;
    const pending = this.draw(waits);
    this.outdated = waits || pending;
    if (this.outdated) this.schedule();
  }

  // Returns true if images of objects are outdated.
  private draw(moving = false): boolean {
    const { renderer, file } = this;
    if (!renderer || !file) return false;
    this.placeCamera(renderer);
    file.scene.updateMatrixWorld();
    const { height } = renderer.getDrawingBufferSize(new three.Vector2()).floor();
    let pending = false;
    for (const { object } of this.objects) pending = object.update(this.camera, height, moving) || pending;
    this.sortObjects(file);
    this.drawPasses(renderer, file);
    return pending;
  }

  private placeCamera(renderer: three.WebGLRenderer): void {
    const { width, height } = this.stage.getBoundingClientRect();
    renderer.setPixelRatio(Math.min(devicePixelRatio, kMaxPixelRatio));
    const size = renderer.getSize(new three.Vector2());
    if (size.x !== Math.round(width) || size.y !== Math.round(height)) renderer.setSize(Math.round(width), Math.round(height), false);
    const { camera } = this;
    camera.aspect = Math.max(width, 1) / Math.max(height, 1);
    const vertical = camera.aspect >= 1 ? this.fieldOfView : 2 * Math.atan(Math.tan(this.fieldOfView / 2) / camera.aspect);
    camera.fov = three.MathUtils.radToDeg(vertical);
    camera.updateProjectionMatrix();
    const { eye } = this.controls.visitor;
    camera.position.copy(eye);
    camera.up.set(0, 1, 0);
    camera.lookAt(eye.clone().add(sightOf(this.controls.visitor)));
  }

  private sortObjects(file: SceneFile): void {
    const { eye } = this.controls.visitor;
    const distances = this.objects.map(({ object }) => ({ object, distance: object.sphere().center.distanceTo(eye) }));
    distances.sort((a, b) => b.distance - a.distance);
    for (const [n, { object, distance }] of distances.entries()) {
      object.order = kFirstOrder + n;
      if (file.fog && file.scene.fog) object.setFog(file.scene.fog.color, fogTransmittance(file.fog, distance));
    }
  }

  // Nodes with the same lights, then objects, then what is blended over both.
  private drawPasses(renderer: three.WebGLRenderer, file: SceneFile): void {
    const { camera } = this;
    const pass = (layer: number) => {
      camera.layers.set(layer);
      renderer.render(file.scene, camera);
    };
    renderer.clear();
    if (file.sky) {
      file.sky.position.copy(this.controls.visitor.eye);
      file.sky.scale.setScalar(this.camera.far / 2);
      file.sky.updateMatrixWorld();
      pass(kSkyLayer);
    }
    for (const group of file.groups) {
      renderer.shadowMap.needsUpdate = !this.shadowsReady; // nothing moves
      pass(group.opaque);
    }
    this.shadowsReady = true;
    pass(kObjectLayer);
    for (const group of file.groups) pass(group.blended);
  }

  private toggleFullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void this.requestFullscreen();
  }
}

function newRenderer(): three.WebGLRenderer {
  let renderer: three.WebGLRenderer;
  try {
    renderer = new three.WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
  } catch {
    throw new CoreError("this browser has no WebGL 2; update it, or switch on its hardware acceleration");
  }
  renderer.autoClear = false;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}

function visitorOf({ worldFromCamera }: Viewpoint): Visitor {
  const eye = new three.Vector3().setFromMatrixPosition(worldFromCamera);
  return visitorAt(eye, new three.Vector3().setFromMatrixColumn(worldFromCamera, 2).negate());
}

function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

if (!customElements.get("ray-space-scene")) customElements.define("ray-space-scene", RaySpaceSceneElement);

declare global {
  interface HTMLElementTagNameMap {
    "ray-space-scene": RaySpaceSceneElement;
  }
}
