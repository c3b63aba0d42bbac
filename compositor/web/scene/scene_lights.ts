// Lights of a scene that rs-view has exported (compositor/scene/export/gltf_file.hpp). Lights of limited scope light only
// the nodes that list them: nodes with the same lights form a group, which is rendered in a pass of its own, with its
// layers of three.js.

import * as three from "three";

interface LightExtras {
  ambient?: number[];
  everywhere?: boolean;
  leastAttenuation?: number;
  castsShadows?: boolean;
}

/** Nodes with the same lights. Its layers hold nodes that hide others, and nodes that are blended over them. */
export interface LightGroup {
  opaque: number;
  blended: number;
  /** Bounds of the nodes that hide others. */
  box: three.Box3;
  /** Lights that cast shadows. */
  suns: three.DirectionalLight[];
}

export const kObjectLayer = 1; // ray-space objects
export const kSkyLayer = 2;
const kFirstGroupLayer = 3;
const kMostGroups = 14; // of 32 layers
const kMostShadows = 1; // per group
const kShadowMap_px = 2048;

// Attenuation of VRML97: none beyond the radius, at most the light's own strength near it.
function setNearAttenuation(least: number): void {
  const chunk = three.ShaderChunk.lights_pars_begin;
  three.ShaderChunk.lights_pars_begin = chunk
    .replace("max( pow( lightDistance, decayExponent ), 0.01 )", `max( pow( lightDistance, decayExponent ), ${least.toFixed(6)} )`)
    .replace("pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) )", "step( lightDistance, cutoffDistance )");
}

function isBlended(mesh: three.Mesh): boolean {
  return [mesh.material].flat().some((material) => material.transparent);
}

/**
 * Assigns layers to lights and meshes, adds ambient lights, and lets the strongest directional lights of each group
 * cast shadows.
 * @param lights in the order of the file
 */
export function groupByLights(scene: three.Object3D, lights: three.Light[]): LightGroup[] {
  const extras = lights.map((light) => (light.userData.RaySpaceLight ?? {}) as LightExtras);
  const least = extras.map((extra) => extra.leastAttenuation).filter((value) => value !== undefined);
  if (least.length > 0) setNearAttenuation(Math.max(0.01, Math.min(...least)));
  const everywhere = lights.map((_, n) => n).filter((n) => extras[n].everywhere !== false);
  const groups = new Map<string, { group: LightGroup; members: number[]; meshes: three.Mesh[] }>();
  scene.traverse((node) => {
    if (!(node instanceof three.Mesh || node instanceof three.Line || node instanceof three.Points)) return;
    const mesh = node as three.Mesh;
    let at: three.Object3D | null = mesh; // primitives are children of their node
    while (at && !at.userData.RaySpaceLights) at = at.parent;
    const scoped = ((at?.userData.RaySpaceLights ?? []) as number[]).filter((n) => extras[n]?.everywhere === false);
    const members = [...scoped, ...everywhere];
    const key = members.join();
    if (!groups.has(key)) {
      const layer = kFirstGroupLayer + 2 * Math.min(groups.size, kMostGroups - 1);
      groups.set(key, { group: { opaque: layer, blended: layer + 1, box: new three.Box3(), suns: [] }, members, meshes: [] });
    }
    const { group, meshes } = groups.get(key)!;
    mesh.layers.set(isBlended(mesh) ? group.blended : group.opaque);
    meshes.push(mesh);
  });
  for (const light of lights) light.layers.disableAll();
  for (const { group, members, meshes } of groups.values()) {
    addGroupLights(scene, group, members.map((n) => lights[n]), members.map((n) => extras[n]));
    castShadows(scene, group, members.filter((n) => extras[n].castsShadows !== false).map((n) => lights[n]), meshes);
  }
  return [...groups.values()].map(({ group }) => group);
}

function addGroupLights(scene: three.Object3D, group: LightGroup, lights: three.Light[], extras: LightExtras[]): void {
  const sum = new three.Color(0, 0, 0);
  for (const [n, light] of lights.entries()) {
    light.layers.enable(group.opaque);
    light.layers.enable(group.blended);
    const [r, g, b] = extras[n].ambient ?? [0, 0, 0];
    sum.add(new three.Color(r, g, b));
  }
  if (sum.r + sum.g + sum.b === 0) return;
  const ambient = new three.AmbientLight(sum, Math.PI);
  ambient.layers.set(group.opaque);
  ambient.layers.enable(group.blended);
  scene.add(ambient);
}

function castShadows(scene: three.Object3D, group: LightGroup, lights: three.Light[], meshes: three.Mesh[]): void {
  const strength = (light: three.Light) => light.intensity * (light.color.r + light.color.g + light.color.b);
  for (const mesh of meshes) {
    if (mesh.layers.mask === 1 << group.opaque) group.box.expandByObject(mesh);
  }
  const suns = lights.filter((light) => light instanceof three.DirectionalLight && light.layers.mask === layersOf(group));
  group.suns = (suns as three.DirectionalLight[]).sort((a, b) => strength(b) - strength(a)).slice(0, kMostShadows);
  if (group.box.isEmpty()) return;
  for (const mesh of meshes) {
    if (mesh.layers.mask !== 1 << group.opaque) continue;
    mesh.castShadow = mesh.receiveShadow = true;
    // Walls and ceilings with one side let light in from behind.
    for (const material of [mesh.material].flat()) material.shadowSide = material.side;
  }
  const sphere = group.box.getBoundingSphere(new three.Sphere());
  for (const sun of group.suns) coverWithShadows(scene, sun, sphere);
}

function coverWithShadows(scene: three.Object3D, sun: three.DirectionalLight, { center, radius }: three.Sphere): void {
  const towards = directionOf(sun);
  scene.add(sun, sun.target);
  sun.quaternion.identity();
  sun.position.copy(center).addScaledVector(towards, -radius);
  sun.target.position.copy(center);
  sun.castShadow = true;
  const { camera } = sun.shadow;
  camera.left = camera.bottom = -radius;
  camera.right = camera.top = radius;
  camera.near = 0;
  camera.far = 2 * radius;
  sun.shadow.mapSize.set(kShadowMap_px, kShadowMap_px);
  sun.shadow.normalBias = (2 * radius) / kShadowMap_px;
  sun.shadow.bias = -0.0005;
}

/** Direction of travel, unit length. */
export function directionOf(light: three.DirectionalLight): three.Vector3 {
  return light.target.getWorldPosition(new three.Vector3()).sub(light.getWorldPosition(new three.Vector3())).normalize();
}

/** The smallest group around a point; undefined if there is none. */
export function groupAround(groups: LightGroup[], point: three.Vector3): LightGroup | undefined {
  const volume = ({ box }: LightGroup) => box.getSize(new three.Vector3()).toArray().reduce((product, side) => product * side, 1);
  return groups.filter(({ box }) => box.containsPoint(point)).sort((a, b) => volume(a) - volume(b))[0];
}

function layersOf(group: LightGroup): number {
  return (1 << group.opaque) | (1 << group.blended);
}
