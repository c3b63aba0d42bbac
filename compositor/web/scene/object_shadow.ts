// Shadow of a ray-space object in the shadow map of a directional light: a quad with the object's image as the light sees
// it, of which only the shadow is drawn.

import * as three from "three";
import type { SceneView } from "./scene_core.js";

/** Position of a point of the virtual screen at the depth of the object's axis, in scene coordinates. */
export function onAxis(view: SceneView, x: number, y: number): three.Vector3 {
  const [left, top, width, height] = view.rectangle;
  const middle = new three.Vector3(left + width / 2, top + height / 2, 1);
  const inverseDepth = new three.Vector3().fromArray(view.facing).dot(middle);
  const depth = inverseDepth > 0 ? 1 / inverseDepth : view.distance;
  const ray = new three.Vector3(x, y, 1).applyMatrix3(new three.Matrix3().fromArray(view.rays));
  return ray.multiplyScalar(depth).add(new three.Vector3().fromArray(view.eye));
}

/** Corners of the screen rectangle: upper left, lower left, upper right, lower right. */
export function cornersOf(view: SceneView): number[][] {
  const [x, y, width, height] = view.rectangle;
  return [[x, y], [x, y + height], [x + width, y], [x + width, y + height]];
}

export const kQuadIndices = [0, 1, 2, 2, 1, 3];

/**
 * @param view from a distant point towards the light
 * @param offset moves the quad towards the light, so that no part of it is below the ground; the shadow stays in place
 */
export function shadowCaster(view: SceneView, offset: three.Vector3): three.Mesh {
  const imageFromScreen = new three.Matrix3().fromArray(view.imageFromScreen);
  const positions: number[] = [];
  const places: number[] = [];
  for (const [x, y] of cornersOf(view)) {
    positions.push(...onAxis(view, x, y).add(offset).toArray());
    const at = new three.Vector3(x, y, 1).applyMatrix3(imageFromScreen);
    places.push(at.x / at.z / view.width, at.y / at.z / view.height);
  }
  const geometry = new three.BufferGeometry();
  geometry.setIndex(kQuadIndices);
  geometry.setAttribute("position", new three.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("uv", new three.Float32BufferAttribute(places, 2));
  const map = new three.DataTexture(view.pixels, view.width, view.height);
  map.needsUpdate = true;
  const material = new three.MeshBasicMaterial({ map, alphaTest: 0.5, colorWrite: false, depthWrite: false, side: three.DoubleSide });
  const caster = new three.Mesh(geometry, material);
  caster.castShadow = true;
  caster.raycast = () => {};
  return caster;
}
