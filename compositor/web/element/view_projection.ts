// Projection of an orbit camera, as ObjectView::camera_of of the core computes it (compositor/web/view/object_view.cpp).
// Object frame: Y up, lengths in object radii.

import type { ObjectDescription, Orbit } from "./core.js";

export type Point = [number, number, number];

/** Parses "x y z"; undefined if the text is none. */
export function parsePoint(text: string | null | undefined): Point | undefined {
  const numbers = (text ?? "").trim().split(/\s+/).map(Number);
  return numbers.length === 3 && text?.trim() && numbers.every(Number.isFinite) ? (numbers as Point) : undefined;
}

export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

export class ViewProjection {
  readonly eye: Point;
  private readonly right: Point;
  private readonly up: Point;
  private readonly forward: Point;
  private readonly focal_px: number;

  /** @param width size of the image, in pixels of any kind */
  constructor(view: Orbit, object: ObjectDescription, readonly width: number, readonly height: number) {
    const { tanHalfX, tanHalfY } = object.lens;
    const [sine, cosine] = [Math.sin(view.azimuth), Math.cos(view.azimuth)];
    const [rise, level] = [Math.sin(view.elevation), Math.cos(view.elevation)];
    const back: Point = [level * sine, rise, level * cosine];
    this.eye = [view.distance * back[0], object.rings[0].targetHeight + view.distance * rise, view.distance * back[2]];
    this.right = [cosine, 0, -sine];
    this.up = [-rise * sine, level, -rise * cosine];
    this.forward = [-back[0], -back[1], -back[2]];
    this.focal_px = width / (2 * Math.max(tanHalfX, (tanHalfY * width) / height));
  }

  /** Homogeneous pixel position (x w, y w, w) of a vector from the eye; w is the axial depth. */
  private homogeneous(direction: Point): Point {
    const depth = dot(direction, this.forward);
    return [
      (this.width / 2) * depth + this.focal_px * dot(direction, this.right),
      (this.height / 2) * depth - this.focal_px * dot(direction, this.up),
      depth,
    ];
  }

  /** Pixel position and axial depth of a point; x and y are valid only if the depth is above 0. */
  project(point: Point): { x: number; y: number; depth: number } {
    const [x, y, depth] = this.homogeneous(minus(point, this.eye));
    return { x: x / depth, y: y / depth, depth };
  }

  /**
   * CSS transform of an element with the transform-origin 0 0 onto a plane of the object frame.
   * @param origin point of the element's top left corner
   * @param across step for a pixel to the right
   * @param down step for a pixel downwards
   */
  planeTransform(origin: Point, across: Point, down: Point): string {
    const column = ([x, y, w]: Point) => `${x},${y},0,${w}`;
    const corner = this.homogeneous(minus(origin, this.eye));
    return `matrix3d(${column(this.homogeneous(across))},${column(this.homogeneous(down))},0,0,1,0,${column(corner)})`;
  }
}
