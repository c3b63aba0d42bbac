// Reads a scene that rs-view has exported as GLB: the three.js scene, its viewpoints, and the nodes of its ray-space
// objects (compositor/scene/export/gltf_file.hpp).

import * as three from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { CoreError } from "../element/core.js";
import { groupByLights, kSkyLayer, type LightGroup } from "./scene_lights.js";

export interface Viewpoint {
  name: string;
  worldFromCamera: three.Matrix4;
  /** Full angle along the shorter side of the image, radians. */
  fieldOfView: number;
}

/** A node with a ray-space object. */
export interface ObjectNode {
  node: three.Object3D;
  url: string;
  standing: boolean;
  description: string;
}

export interface Fog {
  kind: "linear" | "exponential";
  colour: number[];
  visibility: number;
}

interface Surroundings {
  background?: { sky: number[][]; skyAngles: number[]; ground: number[][]; groundAngles: number[] };
  fog?: Fog;
  navigation?: { types: string[]; speed: number; headlight: boolean; eyeHeight: number };
}

export interface SceneFile {
  scene: three.Scene;
  groups: LightGroup[];
  viewpoints: Viewpoint[];
  objects: ObjectNode[];
  fog?: Fog;
  sky?: three.Mesh;
  speed: number;
  headlight: boolean;
  /** Bounds of the surfaces. */
  box: three.Box3;
}

interface RaySpaceExtras {
  url: string;
  standing?: boolean;
  size?: number;
  description?: string;
}

/** @param name begins the messages of errors */
export async function readScene(glb: ArrayBuffer, name: string): Promise<SceneFile> {
  const gltf = await new GLTFLoader().parseAsync(glb, "").catch((error: unknown) => {
    throw new CoreError(`${name}: is not a scene in binary glTF 2.0 (${error instanceof Error ? error.message : error})`);
  });
  const scene = new three.Scene();
  scene.add(gltf.scene);
  const json = gltf.parser.json as { cameras?: { name?: string }[] };
  scene.updateMatrixWorld(true);
  const surroundings = (gltf.scene.userData.RaySpaceScene ?? {}) as Surroundings;
  const box = new three.Box3().setFromObject(gltf.scene);
  prepareMaterials(gltf.scene);
  const lights: three.Light[] = [];
  gltf.scene.traverse((node) => {
    if (node instanceof three.Light) lights.push(node);
  });
  const file: SceneFile = {
    scene,
    groups: groupByLights(scene, lights),
    viewpoints: gltf.cameras.map((camera, n) => ({
      name: json.cameras?.[n]?.name ?? `Viewpoint ${n + 1}`,
      worldFromCamera: camera.matrixWorld.clone(),
      fieldOfView: three.MathUtils.degToRad((camera as three.PerspectiveCamera).fov),
    })),
    objects: objectsOf(gltf.scene),
    fog: surroundings.fog,
    speed: surroundings.navigation?.speed ?? 1.5,
    headlight: surroundings.navigation?.headlight ?? lights.length === 0,
    box,
  };
  if (file.fog) scene.fog = fogOf(file.fog);
  if (surroundings.background) scene.add((file.sky = skyOf(surroundings.background)));
  return file;
}

/** Share of a surface's light that is left at a distance, as in the desktop compositor. */
export function fogTransmittance(fog: Fog, distance: number): number {
  const left = fog.visibility - distance;
  if (left <= 0) return 0;
  return fog.kind === "linear" ? left / fog.visibility : Math.exp(-distance / left);
}

function fogOf(fog: Fog): three.Fog {
  const [r, g, b] = fog.colour;
  const result = new three.Fog(0, 0, fog.visibility);
  result.color.setRGB(r, g, b);
  // A smooth step from 0 to the distance of 63 % is near to the exponential form of VRML97.
  if (fog.kind === "exponential") result.far = fog.visibility / 2;
  return result;
}

function objectsOf(root: three.Object3D): ObjectNode[] {
  const objects: ObjectNode[] = [];
  root.traverse((node) => {
    const extras = node.userData.RaySpace as RaySpaceExtras | undefined;
    if (!extras?.url) return;
    const inner = new three.Group();
    inner.scale.setScalar(extras.size ?? 1);
    node.add(inner);
    objects.push({ node: inner, url: extras.url, standing: extras.standing ?? true, description: extras.description || node.name });
  });
  return objects;
}

// Glass is blended, as by the desktop's raster renderer; transmission would need another pass. Materials without highlights
// are simpler to shade.
function prepareMaterials(root: three.Object3D): void {
  const matt = new Map<three.Material, three.Material>();
  const prepared = (material: three.Material): three.Material => {
    if (!(material instanceof three.MeshStandardMaterial)) return material;
    if (matt.has(material)) return matt.get(material)!;
    const result = material.userData.RaySpaceMaterial?.matt ? mattOf(material) : material;
    matt.set(material, result);
    if (material instanceof three.MeshPhysicalMaterial && material.transmission > 0) {
      material.transmission = 0;
      material.transparent = true;
      material.opacity = Math.min(material.opacity, 0.25);
      material.depthWrite = false;
    }
    material.metalness *= 0.5; // without surroundings to reflect, metals would be black
    return result;
  };
  root.traverse((node) => {
    const { material } = node as three.Mesh;
    if (material) (node as three.Mesh).material = Array.isArray(material) ? material.map(prepared) : prepared(material);
  });
}

function mattOf(material: three.MeshStandardMaterial): three.MeshLambertMaterial {
  const { name, color, map, emissive, emissiveMap, emissiveIntensity, normalMap, normalScale } = material;
  const { side, transparent, opacity, alphaTest, depthWrite, vertexColors, flatShading } = material;
  return new three.MeshLambertMaterial({
    name, color, map, emissive, emissiveMap, emissiveIntensity, normalMap, normalScale, side, transparent, opacity, alphaTest, depthWrite,
    vertexColors, flatShading,
  });
}

// Sphere around the camera with the gradients of ISO/IEC 14772-1, 6.5.
function skyOf(background: NonNullable<Surroundings["background"]>): three.Mesh {
  const kRows = 180;
  const geometry = new three.SphereGeometry(1, 24, kRows);
  const positions = geometry.getAttribute("position");
  const colours: number[] = [];
  for (let i = 0; i < positions.count; ++i) {
    const fromZenith = Math.acos(Math.min(1, Math.max(-1, positions.getY(i))));
    const fromNadir = Math.PI - fromZenith;
    const { sky, skyAngles, ground, groundAngles } = background;
    const overGround = ground.length > 0 && fromNadir <= (groundAngles.at(-1) ?? 0);
    colours.push(...(overGround ? gradient(ground, groundAngles, fromNadir) : gradient(sky, skyAngles, fromZenith)));
  }
  geometry.setAttribute("color", new three.Float32BufferAttribute(colours, 3));
  const material = new three.MeshBasicMaterial({ vertexColors: true, side: three.BackSide, depthTest: false, depthWrite: false, fog: false });
  const mesh = new three.Mesh(geometry, material);
  mesh.layers.set(kSkyLayer);
  mesh.frustumCulled = false;
  return mesh;
}

function gradient(colours: number[][], angles: number[], angle: number): number[] {
  const next = angles.findIndex((end) => angle < end);
  if (next < 0) return colours[Math.min(angles.length, colours.length - 1)];
  const begin = next === 0 ? 0 : angles[next - 1];
  const share = (angle - begin) / Math.max(angles[next] - begin, 1e-9);
  return colours[next].map((value, n) => value + share * (colours[next + 1][n] - value));
}
