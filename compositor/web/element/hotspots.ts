// Hotspots as <model-viewer> has them: children with slot="hotspot-NAME" and data-position="x y z" are shown at a point of
// the object. Object frame, lengths in object radii.

import { dot, minus, parsePoint, type Point, type ViewProjection } from "./view_projection.js";

/** New position or normal of a hotspot, as texts "x y z". `name` is the value of `slot`. */
export interface HotspotConfiguration {
  name: string;
  position?: string;
  normal?: string;
}

export interface HotspotData {
  position: Vector;
  normal: Vector;
  /** CSS pixels from the element's top left corner; z is the depth in object radii. */
  canvasPosition: Vector;
  facingCamera: boolean;
}

export interface Vector {
  x: number;
  y: number;
  z: number;
  toString(): string;
}

export function vector(p: Point): Vector {
  return { x: p[0], y: p[1], z: p[2], toString: () => p.map((value) => Number(value.toFixed(4))).join(" ") };
}

interface Hotspot {
  child: HTMLElement;
  holder: HTMLElement;
  position?: Point;
  normal: Point;
  source?: string; // texts of both
  at: Point;
  visible?: boolean;
}

export class Hotspots {
  /** Called when a hotspot that faces away receives the focus, with its normal. */
  onfocusHidden: (normal: Point) => void = () => {};
  private readonly spots = new Map<string, Hotspot>();
  private view?: ViewProjection;
  private readonly watched = new MutationObserver(() => this.collect());

  /** @param layer element of the shadow tree, above the view */
  constructor(
    private readonly host: HTMLElement,
    private readonly layer: HTMLElement,
  ) {
    host.addEventListener("focusin", (event) => {
      const spot = [...this.spots.values()].find(({ child }) => child.contains(event.target as Node));
      if (spot?.visible === false) this.onfocusHidden(spot.normal);
    });
  }

  /** True while a hotspot has the focus. */
  get focused(): boolean {
    return this.host.querySelector('[slot^="hotspot"]:focus-within') !== null;
  }

  /** Follows the children of the element, until disconnect(). */
  connect(): void {
    this.watched.observe(this.host, {
      childList: true, subtree: true, attributes: true, attributeFilter: ["slot", "data-position", "data-normal"],
    });
    this.collect();
  }

  disconnect(): void {
    this.watched.disconnect();
  }

  update({ name, position, normal }: HotspotConfiguration): void {
    const child = this.spots.get(name)?.child;
    if (child && position !== undefined) child.dataset.position = position;
    if (child && normal !== undefined) child.dataset.normal = normal;
    this.collect();
  }

  query(name: string): HotspotData | null {
    const spot = this.spots.get(name);
    if (!spot?.position) return null;
    const { position, normal, at, visible } = spot;
    return { position: vector(position), normal: vector(normal), canvasPosition: vector(at), facingCamera: visible ?? false };
  }

  /** Moves all hotspots to their places in a view whose pixels are CSS pixels. */
  place(view: ViewProjection): void {
    this.view = view;
    for (const spot of this.spots.values()) {
      if (!spot.position) continue;
      const { x, y, depth } = view.project(spot.position);
      const visible = depth > 0 && dot(minus(view.eye, spot.position), spot.normal) >= 0;
      spot.at = [x, y, depth];
      spot.holder.style.transform = depth > 0 ? `translate(${x}px, ${y}px) translate(-50%, -50%)` : "translate(-100vw, 0)";
      spot.holder.style.zIndex = String(Math.round(10000 / Math.max(depth, 0.1)));
      if (visible !== spot.visible) show(spot, visible);
    }
  }

  // Holders are in the order of the children, which is the order of the focus. The first child of a name counts.
  private collect(): void {
    const before = new Map(this.spots);
    this.spots.clear();
    for (const child of this.host.children) {
      if (!(child instanceof HTMLElement) || !child.slot.startsWith("hotspot") || this.spots.has(child.slot)) continue;
      const known = before.get(child.slot);
      const spot = known?.child === child ? known : { child, holder: holder(child.slot), normal: [0, 0, 0] as Point, at: [0, 0, 0] as Point };
      readPlace(spot);
      this.spots.set(child.slot, spot);
    }
    const holders = [...this.spots.values()].map((spot) => spot.holder);
    if (holders.length !== this.layer.children.length || holders.some((each, n) => this.layer.children[n] !== each)) {
      this.layer.replaceChildren(...holders);
    }
    if (this.view) this.place(this.view);
  }
}

function holder(slot: string): HTMLElement {
  const made = document.createElement("div");
  made.className = "hotspot";
  made.append(Object.assign(document.createElement("slot"), { name: slot }));
  return made;
}

// Without a normal, a hotspot faces away from the axis; on the axis, it is always visible.
function readPlace(spot: Hotspot): void {
  const { position, normal } = spot.child.dataset;
  const source = `${position}, ${normal}`;
  if (source === spot.source) return;
  spot.source = source;
  spot.position = parsePoint(position);
  spot.holder.hidden = !spot.position;
  if (!spot.position) {
    console.warn(`ray-space: ${spot.child.slot}: data-position "${position ?? ""}" is no point; write "0 0.5 0.3", in object radii`);
    return;
  }
  const given = parsePoint(normal);
  if (normal && !given) console.warn(`ray-space: ${spot.child.slot}: data-normal "${normal}" is no direction; write "0 0 1"`);
  spot.normal = given ?? [spot.position[0], 0, spot.position[2]];
}

function show(spot: Hotspot, visible: boolean): void {
  spot.visible = visible;
  spot.holder.classList.toggle("hide", !visible);
  const attribute = spot.child.dataset.visibilityAttribute;
  if (attribute) spot.child.toggleAttribute(`data-${attribute}`, visible);
  spot.child.dispatchEvent(new CustomEvent("hotspot-visibility", { detail: { visible } }));
}
