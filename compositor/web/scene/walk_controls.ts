// Walks a visitor through a scene, or around one object, by keyboard, mouse, wheel and touch. Steps and angles are those
// of rs-view's window (compositor/viewer/views/navigation.hpp).

import * as three from "three";

const kRadiansPerPixel = 0.004;
const kTurn_rad_s = 1.4;
const kMaxPitch = 1.5;
const kFast = 4;
const kWheelSeconds = 0.25; // of walking per notch
const kWheelNotch_px = 100;
const kTouchMetres = 0.006; // per pixel of two fingers, at speed 1
const kZoomPerNotch = 0.88;
const kClick_px = 6;
const kTransition_s = 0.9;

/** Heading 0 looks along -Z and increases to the left; pitch is positive upwards. */
export interface Visitor {
  eye: three.Vector3;
  heading: number;
  pitch: number;
}

export function sightOf({ heading, pitch }: Visitor): three.Vector3 {
  return new three.Vector3(-Math.sin(heading) * Math.cos(pitch), Math.sin(pitch), -Math.cos(heading) * Math.cos(pitch));
}

/** The visitor at a place who looks along a direction. */
export function visitorAt(eye: three.Vector3, sight: three.Vector3): Visitor {
  const along = sight.clone().normalize();
  return { eye: eye.clone(), heading: Math.atan2(-along.x, -along.z), pitch: clampPitch(Math.asin(along.y)) };
}

function clampPitch(pitch: number): number {
  return Math.min(Math.max(pitch, -kMaxPitch), kMaxPitch);
}

const kForward = ["KeyW", "ArrowUp"];
const kBack = ["KeyS", "ArrowDown"];
const kLeft = ["KeyA"];
const kRight = ["KeyD"];
const kTurnLeft = ["ArrowLeft", "KeyQ"];
const kTurnRight = ["ArrowRight", "KeyE"];
const kUp = ["PageUp"];
const kDown = ["PageDown"];
const kKeys = new Set([kForward, kBack, kLeft, kRight, kTurnLeft, kTurnRight, kUp, kDown].flat());

export class WalkControls {
  visitor: Visitor = { eye: new three.Vector3(0, 1.6, 5), heading: 0, pitch: 0 };
  /** Scene units per second. */
  speed = 1.5;
  /** Visitors who prefer reduced motion jump to viewpoints. */
  smooth = true;
  /** Called when an action needs a frame. */
  onaction: () => void = () => {};
  /** Called for a click or tap, with its place in the element, -1 to 1 to the right and upwards. */
  onclick: (place: three.Vector2) => void = () => {};
  /** Called when the orbit around an object ends. */
  onwalk: () => void = () => {};

  private pivot?: { point: three.Vector3; nearest: number };
  private readonly keys = new Set<string>();
  private readonly pointers = new Map<number, PointerEvent>();
  private readonly stop = new AbortController();
  private pressed?: PointerEvent;
  private fast = false;
  private transition?: { from: Visitor; to: Visitor; elapsed_s: number };

  constructor(private readonly surface: HTMLElement) {
    const listen = <K extends keyof HTMLElementEventMap>(type: K, act: (event: HTMLElementEventMap[K]) => void) =>
      surface.addEventListener(type, act, { signal: this.stop.signal, passive: false });
    listen("keydown", (event) => this.pressKey(event));
    listen("keyup", (event) => this.releaseKey(event));
    listen("blur", () => this.keys.clear());
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => this.release(event));
    listen("pointercancel", (event) => this.release(event));
    listen("wheel", (event) => this.turnWheel(event));
  }

  dispose(): void {
    this.stop.abort();
  }

  /** A key or pointer is held, or the visitor is on the way to a viewpoint. */
  get moving(): boolean {
    return this.keys.size > 0 || this.pointers.size > 0 || this.transition !== undefined;
  }

  get orbiting(): boolean {
    return this.pivot !== undefined;
  }

  /** Goes to a place, in an arc of time unless motion is reduced. */
  goTo(to: Visitor): void {
    this.pivot = undefined;
    this.travel(to);
  }

  /** Turns to a point and orbits around it until Escape or a step. */
  orbit(point: three.Vector3, nearest: number): void {
    const sight = point.clone().sub(this.visitor.eye);
    const distance = Math.max(sight.length(), nearest);
    const eye = point.clone().addScaledVector(sight.normalize(), -distance);
    this.travel(visitorAt(eye, sight));
    this.pivot = { point: point.clone(), nearest };
  }

  walk(): void {
    if (!this.pivot) return;
    this.pivot = undefined;
    this.onwalk();
  }

  /** Advances held keys and transitions. */
  advance(elapsed_s: number): void {
    if (this.transition) return this.advanceTransition(elapsed_s);
    const axis = (plus: string[], minus: string[]) =>
      Number(plus.some((key) => this.keys.has(key))) - Number(minus.some((key) => this.keys.has(key)));
    const pace = this.speed * elapsed_s * (this.fast ? kFast : 1);
    const forward = axis(kForward, kBack);
    const right = axis(kRight, kLeft);
    const up = axis(kUp, kDown);
    const turn = axis(kTurnLeft, kTurnRight) * kTurn_rad_s * elapsed_s;
    if (this.pivot) {
      if (forward !== 0) this.approach(Math.exp(-forward * elapsed_s));
      this.look(turn + right * kTurn_rad_s * elapsed_s, -up * kTurn_rad_s * elapsed_s);
      return;
    }
    this.look(turn, 0);
    const length = Math.max(1, Math.hypot(forward, right));
    this.step((pace * forward) / length, (pace * right) / length, pace * up);
  }

  private travel(to: Visitor): void {
    this.keys.clear();
    if (this.smooth) this.transition = { from: { ...this.visitor, eye: this.visitor.eye.clone() }, to, elapsed_s: 0 };
    else this.visitor = to;
    this.onaction();
  }

  private advanceTransition(elapsed_s: number): void {
    const { from, to } = this.transition!;
    this.transition!.elapsed_s += elapsed_s;
    const t = Math.min(1, this.transition!.elapsed_s / kTransition_s);
    const eased = t * t * (3 - 2 * t);
    const turn = Math.atan2(Math.sin(to.heading - from.heading), Math.cos(to.heading - from.heading));
    this.visitor = {
      eye: from.eye.clone().lerp(to.eye, eased),
      heading: from.heading + eased * turn,
      pitch: from.pitch + eased * (to.pitch - from.pitch),
    };
    if (t === 1) this.transition = undefined;
  }

  // Along the ground.
  private step(forward: number, right: number, up: number): void {
    const { heading, eye } = this.visitor;
    eye.x += -Math.sin(heading) * forward + Math.cos(heading) * right;
    eye.z += -Math.cos(heading) * forward - Math.sin(heading) * right;
    eye.y += up;
  }

  private look(left: number, up: number): void {
    const { visitor, pivot } = this;
    const distance = pivot ? visitor.eye.distanceTo(pivot.point) : 0;
    visitor.heading += left;
    visitor.pitch = clampPitch(visitor.pitch + up);
    if (pivot) visitor.eye.copy(pivot.point).addScaledVector(sightOf(visitor), -distance);
  }

  private approach(factor: number): void {
    const { point, nearest } = this.pivot!;
    const distance = Math.max(this.visitor.eye.distanceTo(point) * factor, nearest);
    this.visitor.eye.copy(point).addScaledVector(sightOf(this.visitor), -distance);
  }

  private pressKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    this.fast = event.shiftKey;
    if (event.code === "Escape" && this.pivot) this.walk();
    else if (kKeys.has(event.code)) this.keys.add(event.code);
    else return;
    event.preventDefault();
    this.onaction();
  }

  private releaseKey(event: KeyboardEvent): void {
    this.fast = event.shiftKey;
    this.keys.delete(event.code);
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.pressed = this.pointers.size === 0 ? event : undefined;
    this.pointers.set(event.pointerId, event);
    this.surface.setPointerCapture(event.pointerId);
    this.transition = undefined;
    this.onaction();
  }

  private move(event: PointerEvent): void {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const before = this.grip();
    this.pointers.set(event.pointerId, event);
    const now = this.grip();
    const [dx, dy] = [now.x - before.x, now.y - before.y];
    if (this.pressed && Math.hypot(event.clientX - this.pressed.clientX, event.clientY - this.pressed.clientY) > kClick_px) {
      this.pressed = undefined;
    }
    if (this.pointers.size === 1) this.look(kRadiansPerPixel * dx, kRadiansPerPixel * dy * (this.pivot ? -1 : 1));
    else if (this.pivot) this.approach(before.spread / Math.max(now.spread, 1));
    else {
      const metres = kTouchMetres * this.speed;
      this.step(metres * (now.spread - before.spread - dy), -metres * dx, 0);
    }
    this.onaction();
  }

  private release(event: PointerEvent): void {
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && this.pressed) {
      const box = this.surface.getBoundingClientRect();
      const x = (2 * (event.clientX - box.left)) / box.width - 1;
      const y = 1 - (2 * (event.clientY - box.top)) / box.height;
      this.onclick(new three.Vector2(x, y));
    }
    this.pressed = undefined;
    this.onaction();
  }

  // Middle and distance of the pointers.
  private grip(): { x: number; y: number; spread: number } {
    const all = [...this.pointers.values()];
    const [a, b] = [all[0], all[1] ?? all[0]];
    return {
      x: (a.clientX + b.clientX) / 2,
      y: (a.clientY + b.clientY) / 2,
      spread: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY),
    };
  }

  // An element without focus leaves the wheel to the page.
  private turnWheel(event: WheelEvent): void {
    const focused = (this.surface.getRootNode() as ShadowRoot).activeElement === this.surface;
    if (!focused && !document.fullscreenElement) return;
    event.preventDefault();
    const notches = -(event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1)) / kWheelNotch_px;
    if (this.pivot) this.approach(kZoomPerNotch ** notches);
    else this.step(this.speed * kWheelSeconds * notches, 0, 0);
    this.onaction();
  }
}
