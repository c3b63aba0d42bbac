// Moves a camera about an object by mouse, touch, wheel and keyboard, with inertia, and animates it to a goal.

import type { Orbit } from "./core.js";

export interface OrbitLimits {
  lowestElevation: number;
  highestElevation: number;
  nearest: number;
  farthest: number;
}

const kTurnPerWidth = 2 * Math.PI; // radians for a drag over the element's width
const kTiltPerHeight = Math.PI / 2;
const kKeyStep = Math.PI / 24; // radians
const kZoomPerKey = 1.15;
const kZoomPerWheel = 1.0015; // per pixel of scrolling
const kDoubleTapZoom = 0.55;
const kDoubleTap_ms = 350;
const kDoubleTap_px = 24;
const kInertia_ms = 180; // time constant
const kSlowest = 0.02; // radians per second, below which motion ends
const kArrived = 1e-3; // radians, and part of the distance, below which the goal is reached
export const kDecay_ms = 100;

/** Distance and middle of the pointers. */
interface Grip {
  x: number;
  y: number;
  spread: number;
}

export class OrbitControls {
  /** Called after each change; `byUser` is false for inertia. */
  onchange: (byUser: boolean) => void = () => {};
  /** Inertia and animation; off for visitors who prefer reduced motion. */
  smooth = true;
  /** Time constant of the animation to a goal. */
  decay_ms = kDecay_ms;
  /** No zoom by wheel, pinch, double tap and keys. */
  fixedZoom = false;
  view: Orbit = { azimuth: 0, elevation: 0, distance: 1 };
  home: Orbit = this.view;
  limits: OrbitLimits = { lowestElevation: 0, highestElevation: 0, nearest: 1, farthest: 1 };

  private readonly pointers = new Map<number, PointerEvent>();
  private readonly stop = new AbortController();
  private goal?: Orbit;
  private grip?: Grip;
  private velocity = { azimuth: 0, elevation: 0 }; // radians per second
  private lastMove_ms = 0;
  private lastTap?: PointerEvent;
  private pressed?: PointerEvent;

  constructor(private readonly surface: HTMLElement) {
    const listen = <K extends keyof HTMLElementEventMap>(type: K, act: (event: HTMLElementEventMap[K]) => void) =>
      surface.addEventListener(type, act, { signal: this.stop.signal, passive: false });
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.release(event));
    listen("pointercancel", (event) => this.release(event));
    listen("wheel", (event) => this.turnWheel(event));
    listen("keydown", (event) => this.pressKey(event));
  }

  dispose(): void {
    this.stop.abort();
  }

  /** True while a visitor holds the object, or it moves on by inertia or to a goal. */
  get moving(): boolean {
    return this.pointers.size > 0 || this.goal !== undefined || this.velocity.azimuth !== 0 || this.velocity.elevation !== 0;
  }

  /** True while a visitor holds the object. */
  get held(): boolean {
    return this.pointers.size > 0;
  }

  clamp(): void {
    for (const orbit of this.goal ? [this.view, this.goal] : [this.view]) {
      const { limits } = this;
      orbit.elevation = Math.min(Math.max(orbit.elevation, limits.lowestElevation), limits.highestElevation);
      orbit.distance = Math.min(Math.max(orbit.distance, limits.nearest), limits.farthest);
    }
  }

  /** Moves to a view, animated if motion is smooth, the shorter way around. */
  moveTo(goal: Orbit, byUser: boolean): void {
    this.halt();
    this.goal = { ...goal };
    this.clamp();
    if (this.smooth) this.onchange(byUser);
    else this.jumpToGoal(byUser);
  }

  /** Turns the side with a normal to the viewer. */
  face([x, y, z]: [number, number, number]): void {
    const level = Math.hypot(x, z);
    const azimuth = level > 1e-6 ? Math.atan2(x, z) : this.view.azimuth;
    const elevation = Math.abs(y) > level ? Math.atan2(y, level) : this.view.elevation;
    this.moveTo({ ...this.view, azimuth, elevation }, true);
  }

  /** Ends an animation at its goal. */
  jumpToGoal(byUser = false): void {
    if (!this.goal) return;
    this.view = this.goal;
    this.goal = undefined;
    this.onchange(byUser);
  }

  /** Advances inertia or the animation by a frame. */
  advance(elapsed_ms: number): void {
    if (this.held || !this.moving) return;
    if (this.goal) return this.approach(this.goal, 1 - Math.exp(-elapsed_ms / Math.max(this.decay_ms, 1)));
    const elapsed_s = elapsed_ms / 1000;
    this.turn(this.velocity.azimuth * elapsed_s, this.velocity.elevation * elapsed_s, false);
    const rest = Math.exp(-elapsed_ms / kInertia_ms);
    this.velocity.azimuth *= rest;
    this.velocity.elevation *= rest;
    if (Math.hypot(this.velocity.azimuth, this.velocity.elevation) < kSlowest) this.halt();
  }

  private halt(): void {
    this.velocity = { azimuth: 0, elevation: 0 };
    this.goal = undefined;
  }

  private approach(goal: Orbit, part: number): void {
    const { view } = this;
    const azimuth = shorterTurn(goal.azimuth - view.azimuth);
    const elevation = goal.elevation - view.elevation;
    const nearer = Math.log(goal.distance / view.distance);
    if (Math.max(Math.abs(azimuth), Math.abs(elevation), Math.abs(nearer)) < kArrived) return this.jumpToGoal();
    view.azimuth += part * azimuth;
    view.elevation += part * elevation;
    view.distance *= Math.exp(part * nearer);
    this.onchange(false);
  }

  private turn(azimuth: number, elevation: number, byUser: boolean): void {
    this.view.azimuth = (this.view.azimuth + azimuth) % (2 * Math.PI);
    this.view.elevation += elevation;
    this.clamp();
    this.onchange(byUser);
  }

  private zoom(factor: number): void {
    if (this.fixedZoom) return;
    this.view.distance *= factor;
    this.clamp();
    this.onchange(true);
  }

  private gripOf(): Grip {
    const all = [...this.pointers.values()];
    const [first, second] = [all[0], all[1] ?? all[0]];
    return {
      x: (first.clientX + second.clientX) / 2,
      y: (first.clientY + second.clientY) / 2,
      spread: Math.hypot(first.clientX - second.clientX, first.clientY - second.clientY),
    };
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    if (this.pointers.size === 0) this.pressed = event;
    this.pointers.set(event.pointerId, event);
    this.surface.setPointerCapture(event.pointerId);
    this.grip = this.gripOf();
    this.halt();
  }

  private move(event: PointerEvent): void {
    if (!this.pointers.has(event.pointerId) || !this.grip) return;
    this.pointers.set(event.pointerId, event);
    const from = this.grip;
    this.grip = this.gripOf();
    if (this.pointers.size > 1 && from.spread > 0) this.zoom(from.spread / Math.max(this.grip.spread, 1));
    const azimuth = (-(this.grip.x - from.x) / this.surface.clientWidth) * kTurnPerWidth;
    const elevation = ((this.grip.y - from.y) / this.surface.clientHeight) * kTiltPerHeight;
    const elapsed_s = Math.max(event.timeStamp - this.lastMove_ms, 4) / 1000;
    this.lastMove_ms = event.timeStamp;
    this.turn(azimuth, elevation, true);
    if (this.smooth) this.velocity = { azimuth: azimuth / elapsed_s, elevation: elevation / elapsed_s };
  }

  private release(event: PointerEvent): void {
    if (!this.pointers.delete(event.pointerId)) return;
    this.grip = this.pointers.size > 0 ? this.gripOf() : undefined;
    if (event.type === "pointercancel" || event.timeStamp - this.lastMove_ms > 80) this.halt(); // held still, then released
    if (event.type === "pointerup" && this.pointers.size === 0 && near(this.pressed, event)) this.tap(event);
  }

  // The second tap zooms in, or back to the first view if the view is zoomed already.
  private tap(event: PointerEvent): void {
    const last = this.lastTap;
    this.lastTap = event;
    if (!last || event.timeStamp - last.timeStamp > kDoubleTap_ms || !near(last, event)) return;
    this.lastTap = undefined;
    if (this.fixedZoom) return;
    const { view, home } = this;
    this.moveTo({ ...view, distance: view.distance < 0.9 * home.distance ? home.distance : kDoubleTapZoom * view.distance }, true);
  }

  // An element without focus leaves the wheel to the page; a pinch on a touch pad comes with ctrlKey.
  private turnWheel(event: WheelEvent): void {
    const focused = (this.surface.getRootNode() as ShadowRoot).activeElement === this.surface;
    if (this.fixedZoom || (!focused && !event.ctrlKey && !document.fullscreenElement)) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1) * (event.ctrlKey ? 8 : 1);
    this.zoom(kZoomPerWheel ** pixels);
  }

  private pressKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act: Record<string, () => void> = {
      ArrowLeft: () => this.turn(-kKeyStep, 0, true),
      ArrowRight: () => this.turn(kKeyStep, 0, true),
      ArrowUp: () => this.turn(0, kKeyStep, true),
      ArrowDown: () => this.turn(0, -kKeyStep, true),
      PageUp: () => this.zoom(1 / kZoomPerKey),
      PageDown: () => this.zoom(kZoomPerKey),
      "+": () => this.zoom(1 / kZoomPerKey),
      "-": () => this.zoom(kZoomPerKey),
      Home: () => this.moveTo(this.home, true),
    };
    if (!(event.key in act)) return;
    event.preventDefault();
    this.halt();
    act[event.key]();
  }
}

function shorterTurn(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

function near(a: PointerEvent | undefined, b: PointerEvent): boolean {
  return a !== undefined && Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY) < kDoubleTap_px;
}
